// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_BISECTOR_MAPS_3_H
#define LOCUS_CONSTRUCT_BISECTOR_MAPS_3_H

#include <locus/construct/plane_cylinder.h>
#include <locus/construct/plane_pencil.h>
#include <locus/shape/derivative_vectors.h>
#include <locus/shape/rational_surface.h>
#include <locus/shape/tangent_plane.h>

namespace locus {

// Bisectors in space that are rational (Chen, Riesenfeld & Cohen §5; Elber & Kim): points at equal distance from two feet, on
// the normal planes of curves, the normals of surfaces. All solutions, not only the nearest feet.

namespace detail {

/// A curve piece seen from a point; degrees stay, since numerators and weight must keep theirs in common.
inline Curve_piece<3> seen_from(Curve_piece<3> piece, const Exact_point<3>& origin)
{
  for (std::size_t k = 0; k < 3; ++k) piece.numerator[k] = subtract(piece.numerator[k], multiply(piece.weight, origin[k]));
  return piece;
}

/// What was computed around a point, moved back. The rulings of a chart are moved with it where they are told by a coordinate.
inline Rational_map_piece<3, 2> moved_by(Rational_map_piece<3, 2> piece, const Exact_point<3>& origin)
{
  for (std::size_t k = 0; k < 3; ++k) piece.numerator[k] = add(piece.numerator[k], multiply(piece.weight, origin[k]));
  return piece;
}

/// The planes whose common lines are the rulings of the bisector of a curve piece and the origin, (5.9) without denominators:
/// the normal plane ⟨D1, X⟩ = ⟨D1,p⟩/w, and the points as far from p/w as from the origin, ⟨p, X⟩ = ⟨p,p⟩/(2w).
inline Plane_pencil point_curve_planes(const Curve_piece<3>& piece)
{
  using namespace operators;
  Plane_pencil planes;
  planes.normal = {Derivative_vectors<3>(piece).d1(), piece.numerator};
  planes.side = {2 * dot(planes.normal[0], piece.numerator), square(piece.numerator)};
  planes.denominator = 2 * piece.weight;
  return planes;
}

} // namespace detail

/// The ruled bisector of a point and a curve by the direct approach: degree 4d-2 (3d-1 for a polynomial curve) and 1, in as
/// many charts as it needs, each over a coordinate; together they cover it. Where the tangent passes through the point the
/// rulings are at infinity. A piece on a line through the point has none.
inline std::vector<Ruled_chart> point_curve_bisector_charts(const Exact_point<3>& point, const Rational_curve<3>& curve,
                                                            const Coordinate_ranges& coordinates)
{
  Coordinate_ranges relative = coordinates;
  for (std::size_t k = 0; k < 3; ++k) {
    relative[k].lo -= point[k];
    relative[k].hi -= point[k];
  }
  std::vector<Ruled_chart> charts;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i)
    collect_charts(i, detail::seen_from(curve.pieces()[i], point), curve.chain().pieces[i], detail::point_curve_planes, relative, charts);
  for (Ruled_chart& chart : charts) {
    chart.map = detail::moved_by(std::move(chart.map), point);
    chart.map.range[1] = detail::finite_piece(coordinates[chart.coordinate].lo, coordinates[chart.coordinate].hi);
  }
  return charts;
}

/// The same by the explicit approach (5.10): directrix and generator, one piece for each piece of the curve. The directrix is
/// the point of each ruling next to the given point, of degree 6d-4 (5d-3 for a polynomial curve); λ multiplies the generator
/// p'×p, without common factor, over the directrix's denominator.
inline Rational_map<3, 2> point_curve_bisector_by_directrix(const Exact_point<3>& point, const Rational_curve<3>& curve,
                                                            const Ruling_range& rulings = {})
{
  using namespace operators;
  std::vector<Rational_map_piece<3, 2>> pieces;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
    const Plane_pencil planes = detail::point_curve_planes(detail::seen_from(curve.pieces()[i], point));
    if (planes.is_degenerate()) continue;
    const detail::Ruled_forms forms = planes.forms_by_directrix();
    pieces.push_back(detail::moved_by(forms.over(curve.chain().pieces[i], rulings), point));
  }
  return Rational_map<3, 2>(std::move(pieces));
}

namespace detail {

/// The denominator of the bisector surface: the volume spanned by both tangents and the feet's difference. Identically zero
/// exactly where the curves lie in one plane.
struct Curve_pair_forms {
  Polynomial_vector<2, 3> first_tangent, second_tangent, difference; ///< D1, D̂1 and pŵ - p̂w
  Bernstein<Rational, 2> first_weight, second_weight, volume;
  Polynomial_vector<2, 3> first_point, second_point;

  Curve_pair_forms(const Curve_piece<3>& a, const Curve_piece<3>& b)
  {
    using namespace operators;
    first_point = lifted(a.numerator, 0);
    second_point = lifted(b.numerator, 1);
    first_weight = lifted(a.weight, 0);
    second_weight = lifted(b.weight, 1);
    first_tangent = lifted(Derivative_vectors<3>(a).d1(), 0);
    second_tangent = lifted(Derivative_vectors<3>(b).d1(), 1);
    difference = second_weight * first_point - first_weight * second_point;
    volume = bracket(first_tangent, second_tangent, difference);
  }
};

} // namespace detail

/// The bisector surface of two space curves' pieces, (5.6) solved by Cramer's rule: for every pair of feet the common point of
/// both normal planes and the plane half-way, of degree 4d-2 (3d-1 for a polynomial curve) in each parameter. Nothing for
/// pieces in one plane: their bisector in space is the cylinder over the planar one.
inline std::optional<Rational_map_piece<3, 2>> curve_curve_bisector_piece(const Curve_piece<3>& first, const Piece& first_range,
                                                                          const Curve_piece<3>& second, const Piece& second_range)
{
  using namespace operators;
  const detail::Curve_pair_forms f(first, second);
  if (is_zero(Polynomial_vector<2, 1>{f.volume})) return std::nullopt;
  const auto &v = f.first_weight, &w = f.second_weight;
  const Bernstein<Rational, 2> half_way = square(f.first_point) * w * w - square(f.second_point) * v * v;
  const Polynomial_vector<2, 3> point = (2 * (w * dot(f.first_tangent, f.first_point))) * cross(f.second_tangent, f.difference) +
                                        (2 * (v * dot(f.second_tangent, f.second_point))) * cross(f.difference, f.first_tangent) +
                                        half_way * cross(f.first_tangent, f.second_tangent);
  return rational_map_piece<3, 2>(point, 2 * (v * w * f.volume), {first_range, second_range});
}

/// The bisector surface of two space curves: pieces in a grid, the second curve's fastest; pairs that lie in one plane are left
/// out.
inline Rational_map<3, 2> curve_curve_bisector_map(const Rational_curve<3>& first, const Rational_curve<3>& second)
{
  std::vector<Rational_map_piece<3, 2>> pieces;
  for (std::size_t i = 0; i < first.pieces().size(); ++i)
    for (std::size_t j = 0; j < second.pieces().size(); ++j)
      if (auto piece = curve_curve_bisector_piece(first.pieces()[i], first.chain().pieces[i], second.pieces()[j], second.chain().pieces[j]))
        pieces.push_back(std::move(*piece));
  return Rational_map<3, 2>(std::move(pieces));
}

/// The bisector surface of a point and a rational surface p/w: on the normal at the foot, at equal distance. With the point as
/// origin and the tangent plane ⟨M, X⟩ + m = 0 (`tangent_plane`), it is (2mw·p + ⟨p,p⟩M)/(2mw²), of degree 5d-2 in each parameter
/// at most. A piece of the surface whose tangent planes all pass through the
/// point (a cone around it) has none.
inline Rational_map<3, 2> point_surface_bisector_map(const Exact_point<3>& point, const Rational_surface& surface)
{
  using namespace operators;
  std::vector<Rational_map_piece<3, 2>> pieces;
  std::size_t n = 0;
  const auto& chains = surface.chains();
  for (const Surface_piece& s : surface.pieces()) {
    const std::array<Piece, 2> range{chains[0].pieces[n / chains[1].pieces.size()], chains[1].pieces[n % chains[1].pieces.size()]};
    ++n;
    Polynomial_vector<2, 4> h;
    for (std::size_t k = 0; k < 3; ++k) h[k] = subtract(s.numerator[k], multiply(s.weight, point[k]));
    h[3] = s.weight;
    const Polynomial_vector<2, 4> plane = tangent_plane(h);
    const Polynomial_vector<2, 3> p{h[0], h[1], h[2]}, normal{plane[0], plane[1], plane[2]};
    if (is_zero(Polynomial_vector<2, 1>{plane[3]})) continue;
    pieces.push_back(detail::moved_by(
      rational_map_piece<3, 2>((2 * (plane[3] * s.weight)) * p + square(p) * normal, 2 * (plane[3] * s.weight * s.weight), range), point));
  }
  return Rational_map<3, 2>(std::move(pieces));
}

/// The bisector of two different points: the plane across the middle of their segment, as far as `reach` around it in two
/// orthogonal directions (a little farther in each: lengths are rational).
inline Rational_map<3, 2> point_point_bisector_map(const Exact_point<3>& a, const Exact_point<3>& b, const Rational& reach)
{
  const auto constants = [](const Exact_point<3>& p) {
    return detail::vector_of<3>([&](std::size_t k) { return Bernstein<Rational, 2>(Degrees<2>{}, {p[k]}); });
  };
  Exact_point<3> normal, middle, axis{};
  std::size_t shortest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] = b[k] - a[k];
    middle[k] = (a[k] + b[k]) / 2;
    if (abs(normal[k]) < abs(normal[shortest])) shortest = k;
  }
  axis[shortest] = 1;
  // The greatest coordinate is at most the length: divided by it, directions are at least one long.
  const auto at_least_unit = [](Exact_point<3> p) {
    Rational greatest = 0;
    for (const Rational& x : p) greatest = std::max(greatest, Rational(abs(x)));
    for (Rational& x : p) x /= greatest;
    return p;
  };
  const Exact_point<3> first = at_least_unit(detail::cross_product(normal, axis)), second = at_least_unit(detail::cross_product(normal, first));
  using namespace operators;
  const Bernstein<Rational, 1> ramp = detail::ramp(-reach, reach);
  const Piece range = detail::finite_piece(-reach, reach);
  return Rational_map<3, 2>({rational_map_piece<3, 2>(
    constants(middle) + detail::lifted(ramp, 0) * constants(first) + detail::lifted(ramp, 1) * constants(second),
    Bernstein<Rational, 2>(Degrees<2>{}, {Rational(1)}), {range, range})});
}

} // namespace locus

#endif
