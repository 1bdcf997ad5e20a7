// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_CONSTRUCTORS_3_H
#define LOCUS_SHAPE_CONSTRUCTORS_3_H

#include <locus/shape/constructors_2.h>
#include <locus/shape/rational_surface.h>

namespace locus {

// Curves and surfaces in space in one line, with coordinates as users write them. All are exact.

using Curve_3 = Rational_curve<3>;

/// Coordinates as users write them: {0, 1, 2}, {0.5, "1/3", 0}.
struct Coordinates_3 {
  Number x, y, z;

  Exact_point<3> exact() const { return {x.value(), y.value(), z.value()}; }
};

/// Bézier curve in space, e.g. `bezier_3({{0, 0, 0}, {1, 2, 0}, {2, "1/2", 1}})`; see `bezier_curve`.
inline Curve_3 bezier_3(const std::vector<Coordinates_3>& points, const std::vector<Number>& weights = {})
{
  return bezier_curve<3>(detail::exact(points), detail::exact(weights));
}

/// The straight segment from a to b.
inline Curve_3 segment_3(const Coordinates_3& a, const Coordinates_3& b) { return bezier_3({a, b}); }

/// B-spline curve in space; see `bspline_curve`.
inline Curve_3 bspline_3(int degree, const std::vector<Coordinates_3>& points, const std::vector<Number>& knots,
                         const std::vector<Number>& weights = {}, bool closed = false)
{
  return bspline_curve<3>(degree, detail::exact(points), detail::exact(knots), detail::exact(weights), closed);
}

/// Polyline in space; see `polyline_curve`.
inline Curve_3 polyline_3(const std::vector<Coordinates_3>& points, bool closed = false)
{
  return polyline_curve<3>(detail::exact(points), closed);
}

/// Bézier surface on the unit square, control points row by row, e.g.
/// `bezier_surface_3({1, 1}, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}})`; see `bezier_surface`.
inline Rational_surface bezier_surface_3(const Degrees<2>& degrees, const std::vector<Coordinates_3>& points,
                                         const std::vector<Number>& weights = {})
{
  return bezier_surface(degrees, detail::exact(points), detail::exact(weights));
}

/// B-spline surface, control points row by row, knots for each parameter; see `bspline_surface`.
inline Rational_surface bspline_surface_3(const Degrees<2>& degrees, const std::vector<Coordinates_3>& points,
                                          const std::array<std::vector<Number>, 2>& knots,
                                          const std::vector<Number>& weights = {})
{
  return bspline_surface(degrees, detail::exact(points), {detail::exact(knots[0]), detail::exact(knots[1])},
                         detail::exact(weights));
}

} // namespace locus

#endif
