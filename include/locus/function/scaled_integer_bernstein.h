// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_SCALED_INTEGER_BERNSTEIN_H
#define LOCUS_FUNCTION_SCALED_INTEGER_BERNSTEIN_H

#include <locus/function/bernstein_operations.h>

namespace locus {

/// Tag of the exact coefficient type of the solver: integers that share one positive rational scale.
struct Scaled_integer {};

namespace detail {

template <int D>
Integer gcd_of(const Bernstein<Integer, D>& f)
{
  Integer g = 0;
  for (const Integer& c : f.coefficients()) {
    if (g == 1) break;
    g = gcd(g, c);
  }
  return g;
}

} // namespace detail

/// Bernstein form with exact coefficients scale·integer. Fractions are cleared once, when it is made; subdivision
/// then only adds and shifts integers and never reduces a fraction, and a sign is read off the integer.
template <int D>
class Bernstein<Scaled_integer, D> {
public:
  static constexpr int dimension = D;

  Bernstein() = default;
  Bernstein(Bernstein<Integer, D> values, Rational scale) : values_(std::move(values)), scale_(std::move(scale)) {}

  explicit Bernstein(const Bernstein<Rational, D>& f)
  {
    Integer denominator = 1;
    for (const Rational& c : f.coefficients()) denominator = lcm(denominator, c.get_den());
    values_ = converted<Integer>(f, [&](const Rational& c) {
      const Rational cleared = c * denominator;
      return Integer(cleared.get_num());
    });
    scale_ = Rational(1) / denominator;
  }

  const Bernstein<Integer, D>& values() const { return values_; }
  const Degrees<D>& degrees() const { return values_.degrees(); }
  int degree(int variable = 0) const { return values_.degree(variable); }
  std::size_t size() const { return values_.size(); }
  const Rational& scale() const { return scale_; }

  Rational operator[](std::size_t i) const { return Rational(values_[i] * scale_); }
  Sign sign(std::size_t i) const { return sign_of(values_[i]); }

  bool is_zero() const
  {
    for (const Integer& c : values_.coefficients())
      if (c != 0) return false;
    return true;
  }

  Bernstein<Rational, D> rational() const
  {
    return converted<Rational>(values_, [&](const Integer& c) { return Rational(c * scale_); });
  }

  /// Moves the integers' common power of two into the scale.
  void normalize()
  {
    mp_bitcnt_t common = 0;
    bool found = false;
    for (const Integer& c : values_.coefficients()) {
      if (c == 0) continue;
      const mp_bitcnt_t zeros = mpz_scan1(c.get_mpz_t(), 0);
      common = found ? std::min(common, zeros) : zeros;
      found = true;
      if (common == 0) return;
    }
    if (!found) return;
    for (std::size_t i = 0; i < values_.size(); ++i)
      mpz_tdiv_q_2exp(values_[i].get_mpz_t(), values_[i].get_mpz_t(), common);
    mpq_mul_2exp(scale_.get_mpq_t(), scale_.get_mpq_t(), common);
  }

private:
  Bernstein<Integer, D> values_;
  Rational scale_ = 1;
};

/// Parts of `f` below and above `at` = p/q in one variable. Costs n² additions a row; exact.
template <int D>
std::pair<Bernstein<Scaled_integer, D>, Bernstein<Scaled_integer, D>> split(const Bernstein<Scaled_integer, D>& f,
                                                                            int variable, const Rational& at)
{
  const Integer p = at.get_num(), q = at.get_den(), rest = q - p;
  const Layout layout = layout_along(f.degrees(), variable);
  Bernstein<Integer, D> left(f.degrees()), right(f.degrees());
  const bool half = rest == p;
  detail::split_kernel(f.values().data(), left.data(), right.data(), layout,
                       [&](const Integer& a, const Integer& b) {
                         if (half) return Integer(a + b);
                         return Integer(rest * a + p * b);
                       });
  const Integer base = half ? Integer(2) : q;
  std::vector<Integer> power{Integer(1)};
  for (std::size_t j = 1; j < layout.count; ++j) power.push_back(Integer(power.back() * base));
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t j = 0; j < layout.count; ++j)
      for (std::size_t i = 0; i < layout.inner; ++i) {
        const std::size_t k = (o * layout.count + j) * layout.inner + i;
        left[k] *= power[layout.count - 1 - j];
        right[k] *= power[j];
      }
  const Rational scale = f.scale() / power.back();
  std::pair<Bernstein<Scaled_integer, D>, Bernstein<Scaled_integer, D>> parts{{std::move(left), scale},
                                                                              {std::move(right), scale}};
  parts.first.normalize();
  parts.second.normalize();
  return parts;
}

template <int D>
Bernstein<Scaled_integer, D> restrict_to(const Bernstein<Scaled_integer, D>& f, int variable, const Rational& lo,
                                         const Rational& hi)
{
  if (detail::not_above_half(lo)) return split(split(f, variable, lo).second, variable, Rational((hi - lo) / (1 - lo))).first;
  return split(split(f, variable, hi).first, variable, Rational(lo / hi)).second;
}

template <int D>
Bernstein<Scaled_integer, D - 1> face(const Bernstein<Scaled_integer, D>& f, int variable, bool high)
{
  return {face(f.values(), variable, high), f.scale()};
}

template <int D>
Bernstein<Scaled_integer, D> derivative(const Bernstein<Scaled_integer, D>& f, int variable = 0)
{
  return {derivative(f.values(), variable), f.scale()};
}

template <int D>
Rational evaluate(const Bernstein<Scaled_integer, D>& f, const std::array<Rational, static_cast<std::size_t>(D)>& point)
{
  return evaluate(f.rational(), point);
}

/// The sign that all coefficients have, zero included; unknown where they differ.
template <int D>
Sign common_sign(const Bernstein<Scaled_integer, D>& f)
{
  const Sign sign = f.sign(0);
  for (std::size_t i = 1; i < f.size(); ++i)
    if (f.sign(i) != sign) return Sign::unknown;
  return sign;
}

/// Sign at a rational p/q, from Σ C(n,i)·c_i·p^i·(q-p)^(n-i) in integers: O(n) products, no fractions.
inline Sign sign_at(const Bernstein<Scaled_integer, 1>& f, const Rational& u)
{
  const Integer p = u.get_num(), rest = u.get_den() - p;
  const int n = f.degree();
  Integer sum = 0, power = 1;
  for (int i = n; i >= 0; --i) {
    sum *= p;
    sum += binomial<Integer>(n, i) * f.values()[static_cast<std::size_t>(i)] * power;
    power *= rest;
  }
  return sign_of(sum);
}

// The remaining algebra runs once an equation, not in a loop: it goes through rationals and clears the fractions once.

template <int D>
Bernstein<Scaled_integer, D> add(const Bernstein<Scaled_integer, D>& f, const Bernstein<Scaled_integer, D>& g)
{
  return Bernstein<Scaled_integer, D>(add(f.rational(), g.rational()));
}

template <int D>
Bernstein<Scaled_integer, D> multiply(const Bernstein<Scaled_integer, D>& f, const Bernstein<Scaled_integer, D>& g)
{
  return Bernstein<Scaled_integer, D>(multiply(f.rational(), g.rational()));
}

template <int D>
Bernstein<Scaled_integer, D> elevate(const Bernstein<Scaled_integer, D>& f, int variable, int by)
{
  return Bernstein<Scaled_integer, D>(elevate(f.rational(), variable, by));
}

template <int D>
Bernstein<Scaled_integer, D> divide_exactly(const Bernstein<Scaled_integer, D>& f, const Bernstein<Scaled_integer, D>& g)
{
  return Bernstein<Scaled_integer, D>(divide_exactly(f.rational(), g.rational()));
}

template <int D, int E>
Bernstein<Scaled_integer, E> substitute(const Bernstein<Scaled_integer, D>& f,
                                        const std::array<Bernstein<Scaled_integer, E>, static_cast<std::size_t>(D)>& g)
{
  std::array<Bernstein<Rational, E>, static_cast<std::size_t>(D)> inner;
  for (std::size_t k = 0; k < inner.size(); ++k) inner[k] = g[k].rational();
  return Bernstein<Scaled_integer, E>(substitute(f.rational(), inner));
}

} // namespace locus

#endif
