// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_COMPLEX_POLYNOMIAL_H
#define LOCUS_FUNCTION_COMPLEX_POLYNOMIAL_H

#include <locus/function/bernstein_operations.h>

namespace locus {

/// Univariate polynomial with complex coefficients in the scaled Bernstein basis u^i (1-u)^(n-i), in which products
/// are plain convolutions and need no division: any ring T will do, integers included. Real and imaginary parts are
/// kept apart; a real polynomial has no imaginary coefficients.
template <class T>
struct Complex_polynomial {
  std::vector<T> re, im;

  int degree() const { return static_cast<int>(re.size()) - 1; }
  bool is_real() const { return im.empty(); }
};

namespace detail {

/// c += a·b, or c -= a·b, without temporaries.
template <class T>
void add_product(T& c, const T& a, const T& b, bool minus = false)
{
  if constexpr (std::is_same_v<T, Integer>) {
    if (minus) mpz_submul(c.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
    else mpz_addmul(c.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  } else {
    if (minus) c -= a * b;
    else c += a * b;
  }
}

template <class T>
std::vector<T> convolved(const std::vector<T>& a, const std::vector<T>& b)
{
  std::vector<T> c(a.size() + b.size() - 1, T(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) add_product(c[i + j], a[i], b[j]);
  return c;
}

template <class T>
void add_to(std::vector<T>& a, const std::vector<T>& b, int sign)
{
  if (a.empty()) a.assign(b.size(), T(0));
  for (std::size_t i = 0; i < b.size(); ++i)
    if (sign > 0) a[i] += b[i];
    else a[i] -= b[i];
}

} // namespace detail

template <class T>
Complex_polynomial<T> real_polynomial(std::vector<T> re)
{
  return {std::move(re), {}};
}

template <class T>
Complex_polynomial<T> conjugate(Complex_polynomial<T> f)
{
  for (T& c : f.im) c = T(-c);
  return f;
}

template <class T>
Complex_polynomial<T> multiply(const Complex_polynomial<T>& f, const Complex_polynomial<T>& g)
{
  Complex_polynomial<T> product{detail::convolved(f.re, g.re), {}};
  if (!f.is_real() && !g.is_real()) detail::add_to(product.re, detail::convolved(f.im, g.im), -1);
  if (!f.is_real()) product.im = detail::convolved(f.im, g.re);
  if (!g.is_real()) detail::add_to(product.im, detail::convolved(f.re, g.im), 1);
  return product;
}

/// The same polynomial in the scaled basis of a higher degree: times (u + (1-u))^by.
template <class T>
Complex_polynomial<T> elevate(const Complex_polynomial<T>& f, int by)
{
  if (by <= 0) return f;
  std::vector<T> ones;
  for (int i = 0; i <= by; ++i) ones.push_back(binomial<T>(by, i));
  return multiply(f, real_polynomial(std::move(ones)));
}

/// f + sign·g, both raised to the higher degree.
template <class T>
Complex_polynomial<T> combine(const Complex_polynomial<T>& f, const Complex_polynomial<T>& g, int sign)
{
  const int n = std::max(f.degree(), g.degree());
  Complex_polynomial<T> sum = elevate(f, n - f.degree());
  const Complex_polynomial<T> other = elevate(g, n - g.degree());
  detail::add_to(sum.re, other.re, sign);
  if (!other.is_real()) detail::add_to(sum.im, other.im, sign);
  return sum;
}

/// f times a real number.
template <class T>
Complex_polynomial<T> multiply(Complex_polynomial<T> f, const T& x)
{
  for (std::vector<T>* part : {&f.re, &f.im})
    for (T& c : *part) c *= x;
  return f;
}

/// f times the complex number x + iy.
template <class T>
Complex_polynomial<T> multiply(const Complex_polynomial<T>& f, const T& x, const T& y)
{
  return multiply(f, Complex_polynomial<T>{{x}, {y}});
}

/// A bivariate polynomial Σ A_k(t)·B_k(r) of which the real or imaginary part is meant.
template <class T>
struct Separable_sum {
  std::vector<std::pair<Complex_polynomial<T>, Complex_polynomial<T>>> terms;
  bool imaginary = true;

  Degrees<2> degrees() const
  {
    Degrees<2> d{0, 0};
    for (const auto& [a, b] : terms) d = {std::max(d[0], a.degree()), std::max(d[1], b.degree())};
    return d;
  }
};

namespace detail {

/// Coefficients of the scaled basis to those of the Bernstein basis, for a ring with division.
template <class T>
void unscale(std::vector<T>& c)
{
  const int n = static_cast<int>(c.size()) - 1;
  for (int i = 1; i < n; ++i) c[static_cast<std::size_t>(i)] /= binomial<T>(n, i);
}

/// The same times the least common multiple of the binomials, for integers.
inline void unscale(std::vector<Integer>& c)
{
  const int n = static_cast<int>(c.size()) - 1;
  Integer common = 1;
  for (int i = 1; i < n; ++i) common = lcm(common, binomial<Integer>(n, i));
  for (int i = 0; i <= n; ++i) c[static_cast<std::size_t>(i)] *= Integer(common / binomial<Integer>(n, i));
}

} // namespace detail

/// Coefficients of a separable sum in the scaled basis, or (`to_bernstein`) in the Bernstein basis; the latter for
/// integers up to a positive factor.
template <class T>
Bernstein<T, 2> expand(const Separable_sum<T>& sum, bool to_bernstein = true)
{
  const Degrees<2> degrees = sum.degrees();
  Bernstein<T, 2> f(degrees);
  for (const auto& [a, b] : sum.terms) {
    Complex_polynomial<T> ta = elevate(a, degrees[0] - a.degree()), tb = elevate(b, degrees[1] - b.degree());
    for (auto* c : {&ta.re, &ta.im, &tb.re, &tb.im})
      if (to_bernstein && !c->empty()) detail::unscale(*c);
    const auto add_product = [&](const std::vector<T>& x, const std::vector<T>& y, bool minus) {
      if (x.empty() || y.empty()) return;
      for (std::size_t i = 0; i < x.size(); ++i) {
        T* row = f.data() + i * y.size();
        for (std::size_t j = 0; j < y.size(); ++j) detail::add_product(row[j], x[i], y[j], minus);
      }
    };
    if (sum.imaginary) {
      add_product(ta.re, tb.im, false);
      add_product(ta.im, tb.re, false);
    } else {
      add_product(ta.re, tb.re, false);
      add_product(ta.im, tb.im, true);
    }
  }
  return f;
}

} // namespace locus

#endif
