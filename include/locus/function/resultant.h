// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_RESULTANT_H
#define LOCUS_FUNCTION_RESULTANT_H

#include <locus/function/bivariate_polynomial.h>
#include <locus/function/checkpoint.h>

#include <cstdint>

namespace locus {
namespace detail {

/// Arithmetic modulo a prime between 2^30 and 2^31.
class Prime_field {
public:
  using Element = std::uint64_t;
  explicit Prime_field(std::uint64_t p) : p_(p), inverse_(~std::uint64_t(0) / p) {}

  Element of(const Integer& x) const { return mpz_fdiv_ui(x.get_mpz_t(), p_); }
  Element add(Element a, Element b) const { return a + b < p_ ? a + b : a + b - p_; }
  Element subtract(Element a, Element b) const { return a < b ? a + p_ - b : a - b; }
  /// By multiplication with a rounded inverse of the prime: the quotient is at most one too small.
  Element multiply(Element a, Element b) const
  {
    const Element product = a * b;
    __extension__ using Wide = unsigned __int128;
    const Element rest = product - static_cast<Element>((Wide(product) * inverse_) >> 64) * p_;
    return rest < p_ ? rest : rest - p_;
  }
  Element power(Element a, std::uint64_t e) const
  {
    Element result = 1;
    for (; e; e >>= 1, a = multiply(a, a))
      if (e & 1) result = multiply(result, a);
    return result;
  }
  Element inverse(Element a) const { return power(a, p_ - 2); }
  std::uint64_t prime() const { return p_; }

private:
  std::uint64_t p_, inverse_;
};

/// Resultant of two univariate polynomials over a prime field, both of the degree that their length says, be the leading
/// coefficients zero or not: then it is the value of one polynomial in the coefficients. Euclid's algorithm, O(n·m).
inline std::uint64_t resultant_mod(std::vector<std::uint64_t> f, std::vector<std::uint64_t> g, const Prime_field& k)
{
  if (f.empty() || g.empty()) return 0;
  std::uint64_t result = 1;
  const auto negate_if = [&](bool odd) { result = odd ? k.subtract(0, result) : result; };
  for (;;) {
    // Res(f, g) of formal degrees n, m: a missing leading term of g costs lc(f), one of f costs ±lc(g).
    if (f.back() == 0 && g.back() == 0 && f.size() > 1 && g.size() > 1) return 0;
    while (g.back() == 0 && g.size() > 1) {
      result = k.multiply(result, f.back());
      g.pop_back();
    }
    while (f.back() == 0 && f.size() > 1) {
      result = k.multiply(result, g.back());
      negate_if((g.size() - 1) % 2 == 1);
      f.pop_back();
    }
    if (g.size() == 1) return k.multiply(result, k.power(g[0], f.size() - 1));
    if (f.size() == 1) return k.multiply(result, k.power(f[0], g.size() - 1));
    if (f.size() < g.size()) {
      negate_if((f.size() - 1) % 2 == 1 && (g.size() - 1) % 2 == 1);
      std::swap(f, g);
    }
    const std::uint64_t q = k.multiply(f.back(), k.inverse(g.back()));
    const std::size_t shift = f.size() - g.size();
    for (std::size_t i = 0; i + 1 < g.size(); ++i) f[i + shift] = k.subtract(f[i + shift], k.multiply(q, g[i]));
    f.back() = 0; // f's formal degree stays: the next round takes the missing terms off
  }
}

/// Coefficients of the polynomial of degree below the number of values that has them at 0, 1, 2, …: Newton's formula.
inline std::vector<std::uint64_t> interpolated(std::vector<std::uint64_t> value, const Prime_field& k)
{
  const std::size_t n = value.size();
  for (std::size_t level = 1; level < n; ++level) {
    const std::uint64_t inverse = k.inverse(level);
    for (std::size_t i = n - 1; i >= level; --i) value[i] = k.multiply(k.subtract(value[i], value[i - 1]), inverse);
  }
  std::vector<std::uint64_t> c(n, 0);
  for (std::size_t i = n; i-- > 0;) { // c = c·(x - i) + value[i]
    for (std::size_t j = n - 1; j > 0; --j) c[j] = k.subtract(c[j - 1], k.multiply(c[j], i));
    c[0] = k.subtract(value[i], k.multiply(c[0], i));
  }
  return c;
}

/// A polynomial known by its residues: Chinese remainders, one prime after the other.
class Residue_reconstruction {
public:
  explicit Residue_reconstruction(std::size_t count) : c_(count) {}

  void add(const std::vector<std::uint64_t>& residue, const Prime_field& k)
  {
    const std::uint64_t inverse = k.inverse(k.of(modulus_));
    for (std::size_t i = 0; i < c_.size(); ++i) {
      const std::uint64_t step = k.multiply(k.subtract(residue[i], k.of(c_[i])), inverse);
      mpz_addmul_ui(c_[i].get_mpz_t(), modulus_.get_mpz_t(), step);
    }
    modulus_ *= static_cast<unsigned long>(k.prime());
  }

  std::size_t bits() const { return mpz_sizeinbase(modulus_.get_mpz_t(), 2) - 1; }

  /// The coefficients of least magnitude with these residues.
  Integer_polynomial polynomial() const
  {
    Integer_polynomial f = c_;
    for (Integer& c : f)
      if (2 * c > modulus_) c -= modulus_;
    trim(f);
    return f;
  }

private:
  std::vector<Integer> c_;
  Integer modulus_ = 1;
};

/// Bits that bound the coefficients of the resultant: those of a polynomial are at most its values on the unit circle, and
/// for the determinant's values Hadamard's product of row norms holds.
inline std::size_t resultant_bits(const Bivariate_polynomial& f, const Bivariate_polynomial& g)
{
  const auto row_bits = [](const Bivariate_polynomial& p) {
    Integer sum = 0;
    for (const Integer_polynomial& r : p.row)
      for (const Integer& c : r) sum += abs(c);
    return mpz_sizeinbase(sum.get_mpz_t(), 2);
  };
  return row_bits(f) * static_cast<std::size_t>(g.degree_y()) + row_bits(g) * static_cast<std::size_t>(f.degree_y()) + 2;
}

/// Values at x = 0, 1, 2, … of all rows, modulo a prime: one polynomial in y for each x.
inline std::vector<std::vector<std::uint64_t>> values_mod(const Bivariate_polynomial& f, std::size_t count, const Prime_field& k)
{
  std::vector<std::vector<std::uint64_t>> values(count, std::vector<std::uint64_t>(f.row.size(), 0));
  for (std::size_t j = 0; j < f.row.size(); ++j) {
    std::vector<std::uint64_t> c;
    for (const Integer& x : f.row[j]) c.push_back(k.of(x));
    for (std::size_t x = 0; x < count; ++x) {
      std::uint64_t v = 0;
      for (std::size_t i = c.size(); i-- > 0;) v = k.add(k.multiply(v, x), c[i]);
      values[x][j] = v;
    }
  }
  return values;
}

} // namespace detail

/// The resultant in y of two polynomials, a polynomial in x: zero exactly if they have a common factor with y in it. Exact,
/// by values modulo primes of 31 bits, as many as its coefficients can need. With N the resultant's degree and B its bits
/// the cost is O(B·N·(n·m + N)) machine operations.
inline Integer_polynomial resultant_y(const Bivariate_polynomial& f, const Bivariate_polynomial& g, const Checkpoint& checkpoint = {})
{
  if (f.is_zero() || g.is_zero()) return {};
  const int top = f.degree_y() * std::max(0, g.degree_x()) + g.degree_y() * std::max(0, f.degree_x());
  const auto count = static_cast<std::size_t>(top) + 1;
  const std::size_t bits = detail::resultant_bits(f, g);
  detail::Residue_reconstruction result(count);
  for (Integer prime = 1 << 30; result.bits() <= bits + 1;) {
    mpz_nextprime(prime.get_mpz_t(), prime.get_mpz_t());
    const detail::Prime_field k(prime.get_ui());
    const auto f_values = detail::values_mod(f, count, k), g_values = detail::values_mod(g, count, k);
    std::vector<std::uint64_t> values(count);
    pass(checkpoint);
    for (std::size_t x = 0; x < count; ++x) values[x] = detail::resultant_mod(f_values[x], g_values[x], k);
    result.add(detail::interpolated(std::move(values), k), k);
  }
  return result.polynomial();
}

} // namespace locus

#endif
