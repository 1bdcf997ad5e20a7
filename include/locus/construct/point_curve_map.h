// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_POINT_CURVE_MAP_H
#define LOCUS_CONSTRUCT_POINT_CURVE_MAP_H

#include <locus/constraint/point_curve.h>
#include <locus/construct/bisector_events.h>
#include <locus/construct/rational_locus.h>
#include <locus/shape/constructors_2.h>
#include <locus/shape/rational_map.h>

#include <chrono>

namespace locus {

/// The untrimmed bisector of a point and a curve in the plane, exactly: for every u the point of the curve's normal at r(u)
/// that is as far from p as from r(u), (38) and (39) of Farouki & Johnstone 1994 without common factors. Of a piece of degree n
/// its degree is at most 4n-2, 3n-1 for a polynomial one. A piece on a line through p has none: its normals meet the
/// bisector at infinity. Cost: products of polynomials of that degree in rationals, and a gcd.
inline Rational_map<2, 1> untrimmed_bisector_map(const Coordinates_2& point, const Curve_2& curve)
{
  const Exact_point<2> p = point.exact();
  std::vector<Rational_map_piece<2, 1>> pieces;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
    const auto t = Point_curve_forms(curve.pieces()[i], p).tangent();
    if (detail::is_zero(t[2])) continue;
    Polynomial_vector<1, 2> numerator;
    for (std::size_t k = 0; k < 2; ++k) numerator[k] = subtract(multiply(t[2], p[k]), t[k]);
    pieces.push_back(rational_map_piece<2, 1>(std::move(numerator), t[2], {curve.chain().pieces[i]}));
  }
  return Rational_map<2, 1>(std::move(pieces));
}

namespace detail {

inline Locus<2> untrimmed_point_bisector(const Coordinates_2& point, const Curve_2& curve, bool point_first)
{
  return with_upward_rounding([&] {
    const auto start = std::chrono::steady_clock::now();
    auto map = untrimmed_bisector_map(point, curve);
    Locus_labels labels;
    labels.curve_input = point_first ? 1 : 0;
    labels.point_input = 1 - labels.curve_input;
    labels.inputs = {0, 1};
    labels.features = {Feature::interior, Feature::point};
    if (point_first) std::swap(labels.features[0], labels.features[1]);
    Locus_data<2> data = Rational_locus_maker<2>(curve, map, std::move(labels), {point.exact()}).make();
    data.compute = "bisector";
    data.equations.push_back({"untrimmed bisector", {map.degrees()[0]}});
    note_events(bisector_events(point, curve), point_first ? 1 : 0, data);
    data.rational_curve = std::move(map);
    data.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return Locus<2>(std::move(data));
  });
}

} // namespace detail

/// The same as a locus: arcs between its points at infinity, joined where the curve's tangent does not turn; cusps in
/// `irregular`. Inputs are numbered in the order of the arguments.
inline Locus<2> untrimmed_bisector(const Coordinates_2& point, const Curve_2& curve) { return detail::untrimmed_point_bisector(point, curve, true); }
inline Locus<2> untrimmed_bisector(const Curve_2& curve, const Coordinates_2& point) { return detail::untrimmed_point_bisector(point, curve, false); }

} // namespace locus

#endif
