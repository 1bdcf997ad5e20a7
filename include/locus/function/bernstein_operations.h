// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BERNSTEIN_OPERATIONS_H
#define LOCUS_FUNCTION_BERNSTEIN_OPERATIONS_H

#include <locus/function/bernstein.h>
#include <locus/function/binomial.h>

#include <stdexcept>

namespace locus {

// ---------------------------------------------------------------------------------------------------- kernels
// They work on raw arrays, without allocating, so that the solver runs them on its own storage.

namespace detail {

/// De Casteljau's algorithm along one variable: `left` and `right` receive the coefficients on both parts.
/// `blend(a, b)` forms one new coefficient. `right` may be `in`.
template <class T, class Blend>
void split_kernel(const T* in, T* left, T* right, const Layout& layout, Blend blend)
{
  const std::size_t block = layout.count * layout.inner;
  for (std::size_t o = 0; o < layout.outer; ++o) {
    T* const l = left + o * block;
    T* const r = right + o * block;
    if (right != in) std::copy(in + o * block, in + (o + 1) * block, r);
    for (std::size_t level = 0; level < layout.count; ++level) {
      std::copy(r, r + layout.inner, l + level * layout.inner);
      const std::size_t n = (layout.count - 1 - level) * layout.inner;
      for (std::size_t i = 0; i < n; ++i) r[i] = blend(r[i], r[i + layout.inner]);
    }
  }
}

/// Coefficients on the face where `layout`'s variable is 0 (`high` false) or 1 (`high` true).
template <class T>
void face_kernel(const T* in, T* out, const Layout& layout, bool high)
{
  const std::size_t offset = high ? (layout.count - 1) * layout.inner : 0;
  for (std::size_t o = 0; o < layout.outer; ++o) {
    const T* from = in + o * layout.count * layout.inner + offset;
    std::copy(from, from + layout.inner, out + o * layout.inner);
  }
}

/// out[i + j] += a[i] * b[j] for all multi-indices: the product in the scaled Bernstein basis.
template <class T, std::size_t N>
void convolve_kernel(const T* a, const std::array<int, N>& da, const T* b, const std::array<int, N>& db, T* out)
{
  std::array<int, N> sum{};
  for (std::size_t k = 0; k < N; ++k) sum[k] = da[k] + db[k];
  std::array<int, N> i{};
  std::size_t ia = 0;
  do {
    std::array<int, N> j{};
    std::size_t jb = 0;
    do {
      std::size_t at = 0;
      for (std::size_t k = 0; k < N; ++k)
        at = at * (static_cast<std::size_t>(sum[k]) + 1) + static_cast<std::size_t>(i[k] + j[k]);
      out[at] += a[ia] * b[jb];
      ++jb;
    } while (advance_index(j, db));
    ++ia;
  } while (advance_index(i, da));
}

} // namespace detail

// ------------------------------------------------------------------------------------------- change of basis

/// Multiplies (`Bernstein` to scaled basis) or divides each coefficient by its product of binomials.
/// In the scaled basis u^i (1-u)^(n-i) a product is a plain convolution.
template <class T, int D>
Bernstein<T, D> scaled_by_binomials(Bernstein<T, D> f, bool divide)
{
  Degrees<D> i{};
  std::size_t at = 0;
  do {
    T weight(1);
    for (int k = 0; k < D; ++k) weight *= binomial<T>(f.degree(k), i[static_cast<std::size_t>(k)]);
    if (divide) f[at] /= weight;
    else f[at] *= weight;
    ++at;
  } while (advance_index(i, f.degrees()));
  return f;
}

/// Bernstein coefficients on [0,1] of the polynomial with these coefficients of 1, u, u², …
template <class T>
Bernstein<T, 1> from_monomial(const std::vector<T>& a)
{
  const int n = static_cast<int>(a.size()) - 1;
  Bernstein<T, 1> f(Degrees<1>{n});
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= i; ++j) {
      T term = binomial<T>(i, j) * a[static_cast<std::size_t>(j)];
      term /= binomial<T>(n, j);
      f[static_cast<std::size_t>(i)] += term;
    }
  return f;
}

/// Coefficients of 1, u, u², … of a polynomial in Bernstein form on [0,1].
template <class T>
std::vector<T> to_monomial(const Bernstein<T, 1>& f)
{
  const int n = f.degree();
  std::vector<T> difference(f.coefficients());
  std::vector<T> a;
  for (int j = 0; j <= n; ++j) {
    a.push_back(T(binomial<T>(n, j) * difference[0]));
    for (std::size_t i = 0; i + 1 < difference.size(); ++i) difference[i] = difference[i + 1] - difference[i];
    difference.pop_back();
  }
  return a;
}

// ------------------------------------------------------------------------------------------------ evaluation

/// Value at a point whose coordinates are of type U (double, Interval or exact); de Casteljau, O(n·∏(degree+1)).
template <class T, int D, class U>
T evaluate(const Bernstein<T, D>& f, const std::array<U, static_cast<std::size_t>(D)>& point)
{
  std::vector<T> work(f.coefficients());
  std::size_t block = work.size();
  for (int k = 0; k < D; ++k) {
    const auto count = static_cast<std::size_t>(f.degree(k)) + 1;
    const std::size_t inner = block / count;
    const T s(point[static_cast<std::size_t>(k)]);
    const T rest = T(1) - s;
    for (std::size_t level = 1; level < count; ++level)
      for (std::size_t i = 0; i < (count - level) * inner; ++i) {
        T sum = rest * work[i];
        sum += s * work[i + inner];
        work[i] = sum;
      }
    block = inner;
  }
  return work[0];
}

template <class T, class U>
T evaluate_at(const Bernstein<T, 1>& f, const U& u)
{
  return evaluate(f, std::array<U, 1>{u});
}

// --------------------------------------------------------------------------------------------------- algebra

template <class T, int D>
Bernstein<T, D> elevate(const Bernstein<T, D>& f, int variable, int by);

namespace detail {

template <class T, int D>
Bernstein<T, D> elevated_to(Bernstein<T, D> f, const Degrees<D>& degrees)
{
  for (int k = 0; k < D; ++k) {
    const int by = degrees[static_cast<std::size_t>(k)] - f.degree(k);
    if (by > 0) f = elevate(f, k, by);
  }
  return f;
}

template <int D>
Degrees<D> max_degrees(Degrees<D> a, const Degrees<D>& b)
{
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = std::max(a[k], b[k]);
  return a;
}

} // namespace detail

/// Sum; the operands are raised to common degrees.
template <class T, int D>
Bernstein<T, D> add(const Bernstein<T, D>& f, const Bernstein<T, D>& g)
{
  const Degrees<D> degrees = detail::max_degrees<D>(f.degrees(), g.degrees());
  Bernstein<T, D> sum = detail::elevated_to(f, degrees);
  const Bernstein<T, D> other = detail::elevated_to(g, degrees);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other[i];
  return sum;
}

template <class T, int D>
Bernstein<T, D> multiply(Bernstein<T, D> f, const T& factor)
{
  for (std::size_t i = 0; i < f.size(); ++i) f[i] *= factor;
  return f;
}

template <class T, int D>
Bernstein<T, D> subtract(const Bernstein<T, D>& f, const Bernstein<T, D>& g)
{
  return add(f, multiply(g, T(-1)));
}

/// Product; degrees add.
template <class T, int D>
Bernstein<T, D> multiply(const Bernstein<T, D>& f, const Bernstein<T, D>& g)
{
  Degrees<D> degrees = f.degrees();
  for (std::size_t k = 0; k < degrees.size(); ++k) degrees[k] += g.degrees()[k];
  const Bernstein<T, D> a = scaled_by_binomials(f, false), b = scaled_by_binomials(g, false);
  Bernstein<T, D> product(degrees);
  detail::convolve_kernel(a.data(), a.degrees(), b.data(), b.degrees(), product.data());
  return scaled_by_binomials(product, true);
}

/// Partial derivative; the degree in that variable falls by one (a constant stays of degree 0).
template <class T, int D>
Bernstein<T, D> derivative(const Bernstein<T, D>& f, int variable = 0)
{
  const int n = f.degree(variable);
  if (n == 0) return Bernstein<T, D>(f.degrees());
  Degrees<D> degrees = f.degrees();
  --degrees[static_cast<std::size_t>(variable)];
  Bernstein<T, D> result(degrees);
  const Layout from = layout_along(f.degrees(), variable);
  const std::size_t block = (from.count - 1) * from.inner;
  for (std::size_t o = 0; o < from.outer; ++o)
    for (std::size_t i = 0; i < block; ++i) {
      const T* c = f.data() + o * from.count * from.inner + i;
      T slope = c[from.inner] - c[0];
      slope *= T(n);
      result[o * block + i] = slope;
    }
  return result;
}

/// The same polynomial written with a higher degree in one variable.
template <class T, int D>
Bernstein<T, D> elevate(const Bernstein<T, D>& f, int variable, int by)
{
  Bernstein<T, D> result = f;
  for (int step = 0; step < by; ++step) {
    const Bernstein<T, D> old = std::move(result);
    const Layout from = layout_along(old.degrees(), variable);
    Degrees<D> degrees = old.degrees();
    const int n = ++degrees[static_cast<std::size_t>(variable)];
    result = Bernstein<T, D>(degrees);
    for (std::size_t o = 0; o < from.outer; ++o)
      for (std::size_t j = 0; j <= from.count; ++j)
        for (std::size_t i = 0; i < from.inner; ++i) {
          const T* c = old.data() + o * from.count * from.inner + i;
          T value(0);
          if (j > 0) value += T(static_cast<int>(j)) * c[(j - 1) * from.inner];
          if (j < from.count) value += T(n - static_cast<int>(j)) * c[j * from.inner];
          value /= T(n);
          result[(o * (from.count + 1) + j) * from.inner + i] = value;
        }
  }
  return result;
}

// ----------------------------------------------------------------------------------------------- subdivision

namespace detail {

inline bool not_above_half(double x) { return x <= 0.5; }
inline bool not_above_half(const Rational& x) { return 2 * x <= 1; }
inline bool not_above_half(const Interval& x) { return x.sup() <= 0.5; }

} // namespace detail

/// The two parts of `f` below and above `at` in one variable, each again on the unit box.
template <class T, int D, class U>
std::pair<Bernstein<T, D>, Bernstein<T, D>> split(const Bernstein<T, D>& f, int variable, const U& at)
{
  Bernstein<T, D> left(f.degrees()), right(f.degrees());
  const T s(at);
  const T rest = T(1) - s;
  detail::split_kernel(f.data(), left.data(), right.data(), layout_along(f.degrees(), variable),
                       [&](const T& a, const T& b) {
                         T sum = rest * a;
                         sum += s * b;
                         return sum;
                       });
  return {std::move(left), std::move(right)};
}

/// `f` restricted in one variable to [lo, hi], again on the unit box. 0 ≤ lo ≤ hi ≤ 1 is usual; other ends extend.
template <class T, int D, class U>
Bernstein<T, D> restrict_to(const Bernstein<T, D>& f, int variable, const U& lo, const U& hi)
{
  // The second cut must not divide by a small number: cut off the longer outer part first.
  const U rest = U(1) - lo;
  if (detail::not_above_half(lo)) return split(split(f, variable, lo).second, variable, U((hi - lo) / rest)).first;
  return split(split(f, variable, hi).first, variable, U(lo / hi)).second;
}

/// The face where a variable is 0 or 1, as a polynomial in the remaining variables.
template <class T, int D>
Bernstein<T, D - 1> face(const Bernstein<T, D>& f, int variable, bool high)
{
  static_assert(D > 1, "a face of a univariate polynomial is a number: use its first or last coefficient");
  Degrees<D - 1> degrees{};
  for (int k = 0, j = 0; k < D; ++k)
    if (k != variable) degrees[static_cast<std::size_t>(j++)] = f.degree(k);
  Bernstein<T, D - 1> result(degrees);
  detail::face_kernel(f.data(), result.data(), layout_along(f.degrees(), variable), high);
  return result;
}

// ----------------------------------------------------------------------------------- division, substitution

/// The quotient f/g where g divides f exactly (T exact). Throws std::domain_error where it does not.
/// Long division of the scaled coefficients from the first nonzero one of g on; degrees subtract.
template <class T, int D>
Bernstein<T, D> divide_exactly(const Bernstein<T, D>& f, const Bernstein<T, D>& g)
{
  Bernstein<T, D> rest = scaled_by_binomials(f, false);
  const Bernstein<T, D> divisor = scaled_by_binomials(g, false);
  Degrees<D> degrees = f.degrees(), first{};
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    degrees[k] -= g.degrees()[k];
    if (degrees[k] < 0) throw std::domain_error("divide_exactly: the divisor has the higher degree");
  }
  do {
    if (divisor.at(first) != T(0)) break;
  } while (advance_index(first, g.degrees()));
  if (divisor.at(first) == T(0)) throw std::domain_error("divide_exactly: division by zero");

  Bernstein<T, D> quotient(degrees);
  Degrees<D> i{};
  do {
    Degrees<D> at = i;
    for (std::size_t k = 0; k < at.size(); ++k) at[k] += first[k];
    T q = rest.at(at);
    if (q == T(0)) continue;
    q /= divisor.at(first);
    quotient.at(i) = q;
    Degrees<D> j{};
    do {
      for (std::size_t k = 0; k < at.size(); ++k) at[k] = i[k] + j[k];
      rest.at(at) -= q * divisor.at(j);
    } while (advance_index(j, g.degrees()));
  } while (advance_index(i, degrees));
  for (const T& c : rest.coefficients())
    if (c != T(0)) throw std::domain_error("divide_exactly: the divisor does not divide");
  return scaled_by_binomials(quotient, true);
}

/// f(g_1(v), …, g_D(v)): each variable of f replaced by a polynomial in E variables. Degrees multiply.
template <class T, int D, int E>
Bernstein<T, E> substitute(const Bernstein<T, D>& f, const std::array<Bernstein<T, E>, static_cast<std::size_t>(D)>& g)
{
  const Bernstein<T, E> one(Degrees<E>{}, {T(1)});
  std::array<std::vector<Bernstein<T, E>>, static_cast<std::size_t>(D)> basis;
  for (int k = 0; k < D; ++k) {
    const auto kk = static_cast<std::size_t>(k);
    const int n = f.degree(k);
    std::vector<Bernstein<T, E>> power{one}, co_power{one};
    const Bernstein<T, E> rest = subtract(one, g[kk]);
    for (int i = 0; i < n; ++i) {
      power.push_back(multiply(power.back(), g[kk]));
      co_power.push_back(multiply(co_power.back(), rest));
    }
    for (int i = 0; i <= n; ++i)
      basis[kk].push_back(multiply(multiply(power[static_cast<std::size_t>(i)], co_power[static_cast<std::size_t>(n - i)]),
                                   binomial<T>(n, i)));
  }
  Bernstein<T, E> sum;
  Degrees<D> i{};
  do {
    Bernstein<T, E> term = basis[0][static_cast<std::size_t>(i[0])];
    for (std::size_t k = 1; k < i.size(); ++k) term = multiply(term, basis[k][static_cast<std::size_t>(i[k])]);
    sum = add(sum, multiply(term, f.at(i)));
  } while (advance_index(i, f.degrees()));
  return sum;
}

/// Reorders the variables so that variable 0 becomes 1 and 1 becomes 0.
template <class T>
Bernstein<T, 2> transpose(const Bernstein<T, 2>& f)
{
  Bernstein<T, 2> result(Degrees<2>{f.degree(1), f.degree(0)});
  for (int i = 0; i <= f.degree(0); ++i)
    for (int j = 0; j <= f.degree(1); ++j) result.at({j, i}) = f.at({i, j});
  return result;
}

/// The same polynomial with another coefficient type; each coefficient goes through `convert`.
template <class U, class T, int D, class Convert>
Bernstein<U, D> converted(const Bernstein<T, D>& f, Convert convert)
{
  Bernstein<U, D> result(f.degrees());
  for (std::size_t i = 0; i < f.size(); ++i) result[i] = convert(f[i]);
  return result;
}

} // namespace locus

#endif
