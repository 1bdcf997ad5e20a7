// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_ROOT_VALUE_H
#define LOCUS_FUNCTION_ROOT_VALUE_H

#include <locus/function/descartes.h>
#include <locus/number/interval.h>

namespace locus {
namespace detail {

/// A place on the unit interval that is known to a radius, far below what doubles tell apart.
struct Fine_place {
  Rational at, radius = 0;

  /// Upward rounding needed.
  Interval enclosure() const { return hull(enclosing(Rational(at - radius)), enclosing(Rational(at + radius))); }
};

/// Narrows a root on the unit interval to 2^-`bits`.
inline void refine_root(Isolated_root<Rational>& root, unsigned bits)
{
  const Rational fine(Integer(1), Integer(Integer(1) << bits));
  while (!root.is_exact() && Rational(root.hi - root.lo) > fine)
    if (!bisect_exactly(*root.factor, Rational(0), Rational(1), root)) return;
}

inline Fine_place fine_place(const Isolated_root<Rational>& root)
{
  return {Rational((root.lo + root.hi) / 2), Rational((root.hi - root.lo) / 2)};
}

/// A polynomial's value there, exact but for the place's radius and the last rounding: no cancellation is felt. Upward
/// rounding needed.
inline Interval value_at(const Bernstein<Rational, 1>& f, const Fine_place& place)
{
  const Interval value = enclosing(evaluate_at(f, place.at));
  if (place.radius == 0 || f.degree() == 0) return value;
  Rational slope = 0;
  const Bernstein<Rational, 1> df = derivative(f);
  for (const Rational& c : df.coefficients()) slope = std::max(slope, Rational(abs(c)));
  const double r = enclosing(Rational(slope * place.radius)).sup();
  return value + Interval(-r, r);
}

} // namespace detail
} // namespace locus

#endif
