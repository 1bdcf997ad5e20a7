// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_REAL_ROOTS_H
#define LOCUS_ZERO_SET_REAL_ROOTS_H

#include <locus/zero_set/roots.h>

#include <array>

namespace locus {

/// A real root: the only one in the closed interval [lo, hi], whose ends are no roots; or exactly lo where lo == hi.
struct Real_root {
  Rational lo, hi;
  int multiplicity = 1;

  bool is_exact() const { return lo == hi; }
};

namespace detail {

/// One of the four parts of the line between -∞, -1, 0, 1 and ∞: x = ±u or x = ±1/u for 0 < u < 1.
struct Line_part {
  bool negative, reversed;

  /// The power of x whose coefficient is that of u^j.
  std::size_t power(std::size_t j, std::size_t degree) const { return reversed ? degree - j : j; }
  bool changes_sign(std::size_t power) const { return negative && power % 2 == 1; }
};

inline Integer_polynomial seen_from(const Line_part& part, const Integer_polynomial& f)
{
  Integer_polynomial g;
  for (std::size_t j = 0; j < f.size(); ++j) {
    const std::size_t k = part.power(j, f.size() - 1);
    g.push_back(part.changes_sign(k) ? Integer(-f[k]) : f[k]);
  }
  return g;
}

/// All roots of a polynomial on the line, but for 0 and ±1, which it must not have.
class Line_isolator {
public:
  explicit Line_isolator(const Integer_polynomial& f) : f_(f), n_(f.size() - 1), binomials_(f.size())
  {
    Integer weight = 1;
    for (std::size_t i = 0; 2 * i <= n_; ++i) {
      binomials_[i] = binomials_[n_ - i] = weight.get_d();
      weight *= n_ - i;
      mpz_divexact_ui(weight.get_mpz_t(), weight.get_mpz_t(), i + 1);
    }
  }

  /// In doubles. False where they leave a sign open, as at every multiple root.
  bool by_filter(const Line_part& part, std::vector<Isolated_root<Rational>>& roots)
  {
    if (n_ > 1000) return false; // its binomial coefficients overflow
    // Coefficients of u^i·(1-u)^(n-i), exactly: a Taylor shift of the reversed polynomial, by additions only.
    const std::size_t words = (bit_size(f_) + n_ + 3) / GMP_NUMB_BITS + 1;
    Word_array c(n_ + 1, words);
    for (std::size_t j = 0; j <= n_; ++j) {
      const std::size_t k = part.power(j, n_);
      c.set(j, f_[k]);
      if (part.changes_sign(k)) c.negate(j);
    }
    for (std::size_t last = n_; last > 0; --last)
      for (std::size_t i = 1; i <= last; ++i) c.add(i, i - 1);

    std::vector<std::pair<double, int>> rounded(n_ + 1);
    int greatest = 0;
    for (std::size_t i = 0; i <= n_; ++i) {
      rounded[i] = c.rounded(i);
      greatest = std::max(greatest, rounded[i].second);
    }
    std::vector<double> values(n_ + 1);
    double norm = 0;
    for (std::size_t i = 0; i <= n_; ++i) {
      const auto [mantissa, exponent] = rounded[i];
      values[i] = (exponent == greatest ? mantissa : std::ldexp(mantissa, exponent - greatest)) / binomials_[i];
      norm = std::max(norm, std::abs(values[i]));
    }
    const auto sign = [&](std::size_t i) { return c.is_negative(i) ? Sign::negative : Sign::positive; };
    found_.clear();
    const double error = accumulated_error(0, 8, norm);
    if (!Filtered_isolator(static_cast<int>(n_)).run(values.data(), error, {sign(0), sign(n_)}, 0, 1, found_)) return false;
    for (const auto& root : found_) roots.push_back({Rational(root.lo), Rational(root.hi), 1, nullptr});
    return true;
  }

  /// With as many digits as it takes, where doubles did not do; the polynomial must be square-free.
  void exactly(const Line_part& part, std::vector<Isolated_root<Rational>>& roots) const
  {
    isolate_square_free(bernstein_form(seen_from(part, f_)), Rational(0), Rational(1), roots, false);
  }

  /// Moves the ends of an interval in u away from 0, and from 1 if asked for, and writes it in terms of x.
  Real_root on_line(Isolated_root<Rational> root, const Line_part& part, bool leave_one) const
  {
    if (root.lo == 0) root.lo = smallest_root(part);
    while (leave_one && root.hi == 1)
      bisect_exactly(bernstein_form(seen_from(part, f_)), Rational(0), Rational(1), root);
    Real_root result{std::move(root.lo), std::move(root.hi), 1};
    if (part.reversed) {
      const Rational lo = 1 / result.hi;
      result.hi = 1 / result.lo;
      result.lo = lo;
    }
    if (part.negative) {
      swap(result.lo, result.hi);
      mpq_neg(result.lo.get_mpq_t(), result.lo.get_mpq_t());
      mpq_neg(result.hi.get_mpq_t(), result.hi.get_mpq_t());
    }
    return result;
  }

private:
  /// A power of two below the moduli of all roots in u, by Cauchy's bound.
  Rational smallest_root(const Line_part& part) const
  {
    const Integer& last = f_[part.power(0, n_)];
    Rational bound = 1;
    mpq_div_2exp(bound.get_mpq_t(), bound.get_mpq_t(), bit_size(f_) - mpz_sizeinbase(last.get_mpz_t(), 2) + 2);
    return bound;
  }

  const Integer_polynomial& f_;
  std::size_t n_;
  std::vector<double> binomials_;
  std::vector<Isolated_root<double>> found_;
};

/// Divides f by x - s as often as that goes, s being 1 or -1; returns how often.
inline int divide_out_unit(Integer_polynomial& f, int s)
{
  int times = 0;
  for (;; ++times) {
    Integer even = 0, odd = 0;
    for (std::size_t i = 0; i < f.size(); ++i) (i % 2 ? odd : even) += f[i];
    if (s > 0 ? even != -odd : even != odd) return times;
    for (std::size_t i = f.size() - 1; i-- > 1;) { // the quotient's coefficients, one place too high
      if (s > 0) f[i] += f[i + 1];
      else f[i] -= f[i + 1];
    }
    f.erase(f.begin());
  }
}

inline Sign sign_at(const Integer_polynomial& f, const Rational& x)
{
  Integer sum = 0, power = 1, term;
  for (std::size_t i = f.size(); i-- > 0;) {
    sum *= x.get_num();
    term = f[i] * power;
    sum += term;
    power *= x.get_den();
  }
  return sign_of(sum);
}

/// The multiplicity of a root of f, from f's square-free factors: only the one that has the root changes sign there.
inline int multiplicity_of(const Real_root& root, const std::vector<Square_free_factor>& factors)
{
  for (std::size_t k = 0; k + 1 < factors.size(); ++k) {
    const Sign at_lo = sign_at(factors[k].factor, root.lo);
    if (at_lo == Sign::zero || (!root.is_exact() && at_lo != sign_at(factors[k].factor, root.hi)))
      return factors[k].multiplicity;
  }
  return factors.back().multiplicity;
}

} // namespace detail

/// All real roots of a polynomial, in order, each once, with its multiplicity. Throws std::domain_error for the zero
/// polynomial.
/// Descartes' method on the unit interval, as which each of (-∞,-1), (-1,0), (0,1) and (1,∞) is seen: in doubles
/// with an error bound; where they cannot tell, on the product of the square-free factors with as many digits as it
/// takes.
/// Holds in any rounding mode. Cost: some tens of O(degree²) steps for well separated roots.
inline std::vector<Real_root> real_roots(Integer_polynomial f)
{
  using detail::Line_part;
  detail::trim(f);
  if (f.empty()) throw std::domain_error("real_roots: every number is a root of the zero polynomial");
  int at_zero = 0;
  while (f[static_cast<std::size_t>(at_zero)] == 0) ++at_zero;
  f.erase(f.begin(), f.begin() + at_zero);
  const int at_minus_one = detail::divide_out_unit(f, -1), at_one = detail::divide_out_unit(f, 1);

  constexpr std::array<Line_part, 4> parts{{{true, true}, {true, false}, {false, false}, {false, true}}};
  std::array<std::vector<Isolated_root<Rational>>, 4> found;
  std::vector<Square_free_factor> factors;
  std::optional<detail::Line_isolator> isolator;
  if (degree(f) > 0) {
    isolator.emplace(f);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (isolator->by_filter(parts[k], found[k])) continue;
      if (factors.empty()) {
        factors = square_free_decomposition(f);
        if (degree(factors[0].factor) < degree(f)) { // again from the first part on, with all factors once
          f = detail::product_of(factors);
          isolator.emplace(f);
          for (auto& roots : found) roots.clear();
          k = static_cast<std::size_t>(-1);
          continue;
        }
      }
      isolator->exactly(parts[k], found[k]);
    }
  }

  std::vector<Real_root> roots;
  const auto add = [&](std::size_t k) {
    const Line_part& part = parts[k];
    if (part.negative != part.reversed) std::reverse(found[k].begin(), found[k].end());
    for (auto& root : found[k]) {
      roots.push_back(isolator->on_line(std::move(root), part, (part.negative ? at_minus_one : at_one) > 0));
      if (!factors.empty()) roots.back().multiplicity = detail::multiplicity_of(roots.back(), factors);
    }
  };
  const auto add_exact = [&](int x, int multiplicity) {
    if (multiplicity > 0) roots.push_back({x, x, multiplicity});
  };
  add(0);
  add_exact(-1, at_minus_one);
  add(1);
  add_exact(0, at_zero);
  add(2);
  add_exact(1, at_one);
  add(3);
  return roots;
}

} // namespace locus

#endif
