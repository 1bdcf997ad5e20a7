// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_NUMBER_BOUNDED_H
#define LOCUS_NUMBER_BOUNDED_H

#include <locus/number/interval.h>

#include <cmath>

namespace locus {

/// Relative error of one double operation in *any* rounding mode (twice the usual unit roundoff), so that this rung
/// of the ladder and the interval rung run under one mode.
inline constexpr double operation_error = 0x1p-52;

/// Absolute error that gradual underflow may add to one operation.
inline constexpr double underflow_error = 0x1p-1073;

/// First rung of the ladder: doubles of which a whole array carries one error bound. `Bounded` is the tag of that
/// coefficient type (`Bernstein<Bounded, D>`); for a single number it is a value and its bound.
struct Bounded {
  double value = 0;
  double error = 0;
};

inline Sign sign_of(double value, double error)
{
  if (value > error) return Sign::positive;
  if (value < -error) return Sign::negative;
  return error == 0 && value == 0 ? Sign::zero : Sign::unknown;
}

inline Sign sign_of(const Bounded& x) { return sign_of(x.value, x.error); }

/// Midpoint and radius of an interval. The radius is rounded to the safe side in every mode; it is infinite, never
/// NaN, where it overflows.
inline Bounded bounded(const Interval& x)
{
  const double mid = midpoint(x);
  const double radius = std::max(x.sup() - mid, mid - x.inf());
  if (!std::isfinite(mid) || !std::isfinite(radius)) return {0, std::numeric_limits<double>::infinity()};
  return {mid, radius * (1 + 4 * operation_error) + (radius > 0 ? underflow_error : 0.0)};
}

} // namespace locus

#endif
