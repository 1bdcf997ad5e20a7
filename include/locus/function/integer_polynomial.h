// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_INTEGER_POLYNOMIAL_H
#define LOCUS_FUNCTION_INTEGER_POLYNOMIAL_H

#include <locus/function/scaled_integer_bernstein.h>

#include <cstdint>
#include <optional>
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
  for (auto c = f.rbegin(); c != f.rend() && g != 1; ++c) mpz_gcd(g.get_mpz_t(), g.get_mpz_t(), c->get_mpz_t());
  return g;
}

inline Integer_polynomial primitive_part(Integer_polynomial f)
{
  trim(f);
  if (f.empty()) return f;
  Integer g = content(f);
  if (f.back() < 0) g = -g;
  if (g == 1) return f;
  for (Integer& c : f) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), g.get_mpz_t());
  return f;
}

// Products, quotients and common divisors are formed of integers: the values at a power of two so large that the
// coefficients do not meet.

inline std::size_t bit_size(const Integer_polynomial& f)
{
  std::size_t bits = 0;
  for (const Integer& c : f) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
  return bits;
}

/// Words of a power of two above twice any number of so many bits.
inline std::size_t words_for(std::size_t bits) { return (bits + 1) / GMP_NUMB_BITS + 1; }

/// Bits that no coefficient of f·g exceeds.
inline std::size_t product_bit_size(const Integer_polynomial& f, const Integer_polynomial& g)
{
  const Integer terms(static_cast<unsigned long>(std::min(f.size(), g.size())));
  return bit_size(f) + bit_size(g) + mpz_sizeinbase(terms.get_mpz_t(), 2);
}

/// f(2^(bits of `words` machine words)).
inline Integer packed(const Integer_polynomial& f, std::size_t words)
{
  static_assert(GMP_NAIL_BITS == 0);
  Integer positive, negative;
  const auto size = static_cast<mp_size_t>(f.size() * words);
  mp_limb_t* const p = mpz_limbs_write(positive.get_mpz_t(), size);
  mp_limb_t* const n = mpz_limbs_write(negative.get_mpz_t(), size);
  mpn_zero(p, size);
  mpn_zero(n, size);
  for (std::size_t i = 0; i < f.size(); ++i) {
    const mpz_srcptr c = f[i].get_mpz_t();
    if (mpz_sgn(c) != 0)
      mpn_copyi((mpz_sgn(c) > 0 ? p : n) + i * words, mpz_limbs_read(c), static_cast<mp_size_t>(mpz_size(c)));
  }
  mpz_limbs_finish(positive.get_mpz_t(), size);
  mpz_limbs_finish(negative.get_mpz_t(), size);
  positive -= negative;
  return positive;
}

/// The polynomial whose value x is, with coefficients of magnitude at most half the power of two.
inline Integer_polynomial unpacked(const Integer& x, std::size_t words)
{
  Integer_polynomial f;
  const std::size_t size = mpz_size(x.get_mpz_t());
  bool carry = false;
  for (std::size_t at = 0; at < size || carry; at += words) {
    Integer c;
    if (at < size) {
      const std::size_t used = std::min(words, size - at);
      const auto length = static_cast<mp_size_t>(used);
      mpn_copyi(mpz_limbs_write(c.get_mpz_t(), length), mpz_limbs_read(x.get_mpz_t()) + at, length);
      mpz_limbs_finish(c.get_mpz_t(), length);
    }
    if (carry) ++c;
    const std::size_t bits = words * GMP_NUMB_BITS;
    carry = mpz_sizeinbase(c.get_mpz_t(), 2) >= bits;
    if (carry) {
      Integer whole;
      mpz_setbit(whole.get_mpz_t(), bits);
      c -= whole;
    }
    f.push_back(std::move(c));
  }
  if (x < 0)
    for (Integer& c : f) mpz_neg(c.get_mpz_t(), c.get_mpz_t());
  trim(f);
  return f;
}

/// f/g, nothing where g does not divide f over the integers. Neither is zero.
inline std::optional<Integer_polynomial> quotient(const Integer_polynomial& f, const Integer_polynomial& g)
{
  if (f.size() < g.size()) return std::nullopt;
  const std::size_t terms = f.size() - g.size() + 1;
  for (std::size_t words = words_for(std::max(bit_size(f), bit_size(g)));; words += words) {
    const Integer x = packed(f, words), y = packed(g, words);
    if (!mpz_divisible_p(x.get_mpz_t(), y.get_mpz_t())) return std::nullopt;
    Integer z;
    mpz_divexact(z.get_mpz_t(), x.get_mpz_t(), y.get_mpz_t());
    Integer_polynomial q = unpacked(z, words);
    // The values agree: so do the polynomials, if the product's coefficients are small enough to be read off.
    if (q.size() == terms && words_for(product_bit_size(q, g)) <= words) return q;
  }
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

inline Integer_polynomial multiply(const Integer_polynomial& f, const Integer_polynomial& g)
{
  if (f.empty() || g.empty()) return {};
  const std::size_t words = detail::words_for(detail::product_bit_size(f, g));
  return detail::unpacked(Integer(detail::packed(f, words) * detail::packed(g, words)), words);
}

/// Greatest common divisor, primitive, with positive leading coefficient. A modular test answers the usual case
/// (coprime) at once; else it is read off the common divisor of the two values at a large power of two (Char, Geddes &
/// Gonnet 1989) and proved by division.
inline Integer_polynomial gcd(Integer_polynomial f, Integer_polynomial g)
{
  f = detail::primitive_part(std::move(f));
  g = detail::primitive_part(std::move(g));
  if (f.empty()) return g;
  if (g.empty()) return f;
  if (detail::certainly_coprime(f, g)) return {Integer(1)};
  // The power exceeds 2 + 2·max|coefficient|, so that what divides both is the greatest common divisor: a further
  // factor of it would be greater there than half the power, which bounds the integer that was read as content.
  const std::size_t bits = std::max(detail::bit_size(f), detail::bit_size(g));
  for (std::size_t words = detail::words_for(bits + 2);; words += 1 + words / 4) {
    const Integer x = detail::packed(f, words), y = detail::packed(g, words);
    Integer_polynomial h = detail::primitive_part(detail::unpacked(Integer(::gcd(x, y)), words));
    if (detail::quotient(f, h) && detail::quotient(g, h)) return h;
  }
}

/// f/g for g dividing f over the rationals, as a primitive polynomial (its sign follows f and g).
inline Integer_polynomial exact_quotient(Integer_polynomial f, const Integer_polynomial& g)
{
  detail::trim(f);
  if (f.empty()) return f;
  if (g.empty()) throw std::domain_error("exact_quotient: division by zero");
  const bool negative = (f.back() < 0) != (g.back() < 0);
  // Of primitive polynomials the quotient is integral, by Gauss.
  auto q = detail::quotient(detail::primitive_part(std::move(f)), detail::primitive_part(g));
  if (!q) throw std::domain_error("exact_quotient: the divisor does not divide");
  if (negative)
    for (Integer& c : *q) mpz_neg(c.get_mpz_t(), c.get_mpz_t());
  return std::move(*q);
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
    if (degree(repeated) == 0) {
      result.push_back({std::move(product), multiplicity});
      break;
    }
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
