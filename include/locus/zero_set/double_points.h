// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_DOUBLE_POINTS_H
#define LOCUS_ZERO_SET_DOUBLE_POINTS_H

#include <locus/zero_set/local_forms.h>
#include <locus/zero_set/system.h>

#include <optional>

namespace locus {
namespace detail {

inline Interval range_of(const Bernstein<Interval, 2>& f)
{
  Interval range = f[0];
  for (const Interval& c : f.coefficients()) range = hull(range, c);
  return range;
}

/// Whether a·x² + 2b·xy + c·y² is not zero for any (x, y) ≠ 0 with g·x + h·y = 0, given that 0 is not in g.
inline bool is_definite_along(const Interval& a, const Interval& b, const Interval& c, const Interval& g,
                              const Interval& h)
{
  const Interval s = -h / g; // x = s·y
  return !contains_zero(a * CGAL::square(s) + Interval(2) * b * s + c);
}

} // namespace detail

/// Whether f and g have one common zero in a box at most, on which they are given, if they have one where f is of second
/// order. With x the way there from another, the mean value theorem says that a gradient of g is normal to x, and Taylor's
/// that a Hessian of f vanishes on x; the box has no such pair.
inline bool has_one_common_zero(const Bernstein<Interval, 2>& f, const Bernstein<Interval, 2>& g)
{
  using detail::range_of;
  const auto f0 = derivative(f, 0), f1 = derivative(f, 1);
  const Interval f00 = range_of(derivative(f0, 0)), f01 = range_of(derivative(f0, 1)),
                 f11 = range_of(derivative(f1, 1));
  const Interval g0 = range_of(derivative(g, 0)), g1 = range_of(derivative(g, 1));
  return (!contains_zero(g0) && detail::is_definite_along(f00, f01, f11, g0, g1)) ||
         (!contains_zero(g1) && detail::is_definite_along(f11, f01, f00, g1, g0));
}

/// A box around p in which p is the only solution of f = g = 0, although it is not a regular one. p must be known to solve
/// them and f's gradient to vanish there: a node of f = 0, for example, from the regular system that is its cause. Nothing
/// if the test above fails also on small boxes (upward rounding needed).
inline std::optional<Box<2>> box_of_double_point(const Equation<2>& f, const Equation<2>& g,
                                                 const Isolated_solution<2>& p)
{
  for (double reach = 0x1p-2; reach > 0x1p-20; reach *= 0.5) {
    Box<2> box;
    for (std::size_t v = 0; v < 2; ++v) {
      box.lo[v] = detail::grid_below(p.box[v].inf() - reach);
      box.hi[v] = detail::grid_above(p.box[v].sup() + reach);
    }
    if (has_one_common_zero(f.enclosure(box), g.enclosure(box))) return box;
  }
  return std::nullopt;
}

} // namespace locus

#endif
