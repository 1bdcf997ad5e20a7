// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_NUMBER_ZERO_OF_ROOTS_H
#define LOCUS_NUMBER_ZERO_OF_ROOTS_H

#include <locus/number/rational.h>

#include <array>

namespace locus {

/// s·√q with a sign s and q ≥ 0.
struct Signed_root {
  int sign = 0;
  Rational square = 0;

  Signed_root() = default;
  /// factor·√radicand.
  Signed_root(const Rational& factor, const Rational& radicand) : sign(radicand == 0 ? 0 : sgn(factor)), square(factor * factor * radicand) {}
};

namespace detail {

/// The sign of the sum of two.
inline int sign_of_sum(const Signed_root& a, const Signed_root& b)
{
  if (a.sign == 0 || b.sign == 0 || a.sign == b.sign) return a.sign != 0 ? a.sign : b.sign;
  return a.square > b.square ? a.sign : a.square < b.square ? b.sign : 0;
}

/// Whether a + f·√u = 0.
inline bool vanishes(const Rational& a, const Rational& f, const Rational& u) { return sgn(a) == -(u == 0 ? 0 : sgn(f)) && a * a == f * f * u; }

/// Whether a + √-term x = √-term y.
inline bool are_equal(const Rational& a, const Signed_root& x, const Signed_root& y)
{
  if (sign_of_sum(Signed_root(a, 1), x) != y.sign) return false;
  return vanishes(a * a + x.square - y.square, 2 * a * x.sign, x.square);
}

} // namespace detail

/// Whether the sum of four signed square roots is zero, exactly: by squaring two against two, and once more, with the signs compared.
inline bool is_zero_sum(const std::array<Signed_root, 4>& x)
{
  const int left = detail::sign_of_sum(x[0], x[1]), right = detail::sign_of_sum(x[2], x[3]);
  if (left != -right) return false;
  const Rational a = x[0].square + x[1].square - x[2].square - x[3].square;
  return detail::are_equal(a, Signed_root(2 * x[0].sign * x[1].sign, x[0].square * x[1].square), Signed_root(2 * x[2].sign * x[3].sign, x[2].square * x[3].square));
}

} // namespace locus

#endif
