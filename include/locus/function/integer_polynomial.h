// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_INTEGER_POLYNOMIAL_H
#define LOCUS_FUNCTION_INTEGER_POLYNOMIAL_H

#include <locus/function/scaled_integer_bernstein.h>

#include <cstdint>
#include <vector>

namespace locus {

/// Univariate polynomial with integer coefficients of 1, u, u², …; no leading zeros, empty for the zero polynomial.
using Integer_polynomial = std::vector<Integer>;

namespace detail {

inline void trim(Integer_polynomial& f)
{
  while (!f.empty() && f.back() == 0) f.pop_back();
}

inline Integer content(const Integer_polynomial& f)
{
  Integer g = 0;
  for (const Integer& c : f) g = gcd(g, c);
  return g;
}

inline Integer_polynomial primitive_part(Integer_polynomial f)
{
  trim(f);
  if (f.empty()) return f;
  Integer g = content(f);
  if (f.back() < 0) g = -g;
  for (Integer& c : f) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), g.get_mpz_t());
  return f;
}

/// Remainder of lc(g)^k·f by g, up to a factor.
inline Integer_polynomial pseudo_remainder(Integer_polynomial f, const Integer_polynomial& g)
{
  while (f.size() >= g.size()) {
    const Integer lead = f.back();
    const std::size_t shift = f.size() - g.size();
    for (Integer& c : f) c *= g.back();
    for (std::size_t i = 0; i < g.size(); ++i) f[i + shift] -= lead * g[i];
    trim(f);
    if (f.empty()) break;
  }
  return f;
}

/// Arithmetic modulo a prime below 2^31, to see quickly that two polynomials have no common factor.
inline constexpr std::uint64_t small_prime = 2147483629u;

inline std::uint64_t inverse_mod(std::uint64_t a)
{
  std::uint64_t result = 1, base = a % small_prime;
  for (std::uint64_t e = small_prime - 2; e; e >>= 1) {
    if (e & 1) result = result * base % small_prime;
    base = base * base % small_prime;
  }
  return result;
}

inline std::vector<std::uint64_t> reduced_mod(const Integer_polynomial& f)
{
  std::vector<std::uint64_t> r;
  for (const Integer& c : f) r.push_back(mpz_fdiv_ui(c.get_mpz_t(), small_prime));
  return r;
}

/// True only if f and g are certainly coprime: their images modulo the prime are, and a leading coefficient survives.
inline bool certainly_coprime(const Integer_polynomial& f, const Integer_polynomial& g)
{
  auto a = reduced_mod(f), b = reduced_mod(g);
  if (a.empty() || b.empty() || a.back() == 0 || b.back() == 0) return false;
  while (!b.empty()) {
    const std::uint64_t inverse = inverse_mod(b.back());
    while (a.size() >= b.size()) {
      const std::uint64_t q = a.back() * inverse % small_prime;
      const std::size_t shift = a.size() - b.size();
      for (std::size_t i = 0; i < b.size(); ++i)
        a[i + shift] = (a[i + shift] + (small_prime - b[i]) * q) % small_prime;
      while (!a.empty() && a.back() == 0) a.pop_back();
    }
    std::swap(a, b);
  }
  return a.size() == 1;
}

} // namespace detail

inline int degree(const Integer_polynomial& f) { return static_cast<int>(f.size()) - 1; }

inline Integer_polynomial derivative(const Integer_polynomial& f)
{
  Integer_polynomial d;
  for (std::size_t i = 1; i < f.size(); ++i) d.push_back(Integer(f[i] * static_cast<unsigned long>(i)));
  return d;
}

/// Greatest common divisor, primitive, with positive leading coefficient. A modular test answers the usual case
/// (coprime) at once; else the primitive remainder sequence.
inline Integer_polynomial gcd(Integer_polynomial f, Integer_polynomial g)
{
  f = detail::primitive_part(std::move(f));
  g = detail::primitive_part(std::move(g));
  if (f.empty()) return g;
  if (g.empty()) return f;
  if (detail::certainly_coprime(f, g)) return {Integer(1)};
  if (f.size() < g.size()) std::swap(f, g);
  while (!g.empty()) {
    Integer_polynomial r = detail::primitive_part(detail::pseudo_remainder(std::move(f), g));
    f = std::move(g);
    g = std::move(r);
  }
  return f;
}

/// f/g for g dividing f over the rationals, as a primitive polynomial (its sign follows f and g).
inline Integer_polynomial exact_quotient(Integer_polynomial f, const Integer_polynomial& g)
{
  Integer_polynomial q(f.size() >= g.size() ? f.size() - g.size() + 1 : 0, Integer(0));
  while (!f.empty() && f.size() >= g.size()) {
    const Integer common = ::gcd(f.back(), g.back());
    const Integer scale = abs(Integer(g.back() / common));
    for (Integer& c : f) c *= scale;
    for (Integer& c : q) c *= scale;
    const Integer factor = f.back() / g.back();
    const std::size_t shift = f.size() - g.size();
    q[shift] += factor;
    for (std::size_t i = 0; i < g.size(); ++i) f[i + shift] -= factor * g[i];
    detail::trim(f);
  }
  if (!f.empty()) throw std::domain_error("exact_quotient: the divisor does not divide");
  const Integer c = detail::content(q);
  if (c != 0)
    for (Integer& x : q) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), c.get_mpz_t());
  return q;
}

/// A square-free factor and how often it divides.
struct Square_free_factor {
  Integer_polynomial factor;
  int multiplicity;
};

/// Yun's square-free decomposition, without the constant factors of degree 0.
inline std::vector<Square_free_factor> square_free_decomposition(const Integer_polynomial& polynomial)
{
  std::vector<Square_free_factor> result;
  Integer_polynomial f = detail::primitive_part(polynomial);
  if (degree(f) < 1) return result;
  const Integer_polynomial common = gcd(f, derivative(f));
  if (degree(common) == 0) {
    result.push_back({std::move(f), 1});
    return result;
  }
  Integer_polynomial product = exact_quotient(f, common), repeated = common;
  for (int multiplicity = 1; degree(product) > 0; ++multiplicity) {
    const Integer_polynomial next = gcd(product, repeated);
    Integer_polynomial factor = exact_quotient(product, next);
    if (degree(factor) > 0) result.push_back({std::move(factor), multiplicity});
    repeated = exact_quotient(repeated, next);
    product = next;
  }
  return result;
}

/// Monomial integer form, up to a positive factor, of an exact Bernstein polynomial on [0,1].
inline Integer_polynomial monomial_form(const Bernstein<Scaled_integer, 1>& f)
{
  Integer_polynomial a = to_monomial(f.values());
  detail::trim(a);
  const Integer c = detail::content(a);
  if (c != 0)
    for (Integer& x : a) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), c.get_mpz_t());
  return a;
}

/// Bernstein form on [0,1] of a polynomial with integer coefficients.
inline Bernstein<Scaled_integer, 1> bernstein_form(const Integer_polynomial& a)
{
  const int n = std::max(0, degree(a));
  // b_i = Σ_j C(i,j)/C(n,j)·a_j; one common denominator for the row of binomials.
  Integer denominator = 1;
  for (int j = 0; j <= n; ++j) denominator = lcm(denominator, binomial<Integer>(n, j));
  std::vector<Integer> difference(static_cast<std::size_t>(n) + 1, Integer(0));
  for (std::size_t j = 0; j < a.size(); ++j) {
    difference[j] = a[j] * denominator;
    mpz_divexact(difference[j].get_mpz_t(), difference[j].get_mpz_t(), binomial<Integer>(n, static_cast<int>(j)).get_mpz_t());
  }
  // Σ_j C(i,j)·d_j for all i at once, by repeated summation.
  for (std::size_t level = difference.size() - 1; level > 0; --level)
    for (std::size_t i = level; i < difference.size(); ++i) difference[i] += difference[i - 1];
  Bernstein<Scaled_integer, 1> f(Bernstein<Integer, 1>(Degrees<1>{n}, std::move(difference)), Rational(1) / denominator);
  f.normalize();
  return f;
}

} // namespace locus

#endif
