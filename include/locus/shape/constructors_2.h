// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_CONSTRUCTORS_2_H
#define LOCUS_SHAPE_CONSTRUCTORS_2_H

#include <locus/shape/monomial_curve.h>
#include <locus/shape/spline_curve.h>

namespace locus {

// Curves in the plane in one line, with coordinates as users write them. All are exact. `bezier_2` and `segment_2` are in
// rational_curve.h.

namespace detail {

/// Points as users write them.
template <class Coordinates>
auto exact(const std::vector<Coordinates>& points)
{
  std::vector<decltype(points[0].exact())> out;
  for (const Coordinates& p : points) out.push_back(p.exact());
  return out;
}

inline std::vector<Rational> exact(const std::vector<Number>& numbers)
{
  std::vector<Rational> out;
  for (const Number& x : numbers) out.push_back(x.value());
  return out;
}

/// centre + X·p + Y·q for three values X, Y of quadratic forms and their weights W.
inline Curve_piece<2> conic_piece(const Exact_point<2>& centre, const Exact_point<2>& p, const Exact_point<2>& q,
                                  const std::array<std::array<int, 3>, 3>& forms)
{
  Curve_piece<2> piece;
  for (auto& x : piece.numerator) x = Bernstein<Rational, 1>(Degrees<1>{2});
  piece.weight = Bernstein<Rational, 1>(Degrees<1>{2});
  for (std::size_t i = 0; i < 3; ++i) {
    piece.weight[i] = forms[2][i];
    for (std::size_t v = 0; v < 2; ++v)
      piece.numerator[v][i] = forms[2][i] * centre[v] + forms[0][i] * p[v] + forms[1][i] * q[v];
  }
  return piece;
}

inline std::vector<Piece> unit_ranges(std::size_t n)
{
  std::vector<Piece> ranges;
  for (std::size_t k = 0; k < n; ++k) ranges.push_back(finite_range(static_cast<long>(k), static_cast<long>(k + 1)));
  return ranges;
}

/// The image of the unit circle under the affine map that takes the unit vectors to p and q. Its quarters are
/// (1-s², 2s)/(1+s²) turned and, in turns, mirrored, so that speeds agree where they meet.
inline Curve_2 conic_around(const Exact_point<2>& centre, const Exact_point<2>& p, const Exact_point<2>& q)
{
  std::vector<Curve_piece<2>> pieces{conic_piece(centre, p, q, {{{1, 1, 0}, {0, 1, 2}, {1, 1, 2}}}),
                                     conic_piece(centre, p, q, {{{0, -1, -1}, {2, 1, 0}, {2, 1, 1}}}),
                                     conic_piece(centre, p, q, {{{-1, -1, 0}, {0, -1, -2}, {1, 1, 2}}}),
                                     conic_piece(centre, p, q, {{{0, 1, 1}, {-2, -1, 0}, {2, 1, 1}}})};
  return joined_curve(std::move(pieces), unit_ranges(4), true);
}

} // namespace detail

/// B-spline curve in the plane; see `bspline_curve`.
inline Curve_2 bspline_2(int degree, const std::vector<Coordinates_2>& points, const std::vector<Number>& knots,
                         const std::vector<Number>& weights = {}, bool closed = false)
{
  return bspline_curve<2>(degree, detail::exact(points), detail::exact(knots), detail::exact(weights), closed);
}

/// The segments from point to point, vertex k at the parameter k; `closed` adds the one from the last to the first.
/// Throws Invalid_input for fewer than two points, or one that repeats the point before it.
template <int Dim>
Rational_curve<Dim> polyline_curve(std::vector<Exact_point<Dim>> vertices, bool closed = false)
{
  const std::size_t given = vertices.size();
  if (given < 2)
    throw Invalid_input(".points", "a polyline needs at least 2 points, not " + std::to_string(given), "add some");
  if (closed) vertices.push_back(vertices[0]);
  for (std::size_t i = 1; i < vertices.size(); ++i)
    if (vertices[i] == vertices[i - 1])
      throw Invalid_input(".points[" + std::to_string(i % given) + "]", "repeats the point before it", "leave it out");
  std::vector<Rational> knots{0};
  for (std::size_t i = 0; i < vertices.size(); ++i) knots.push_back(static_cast<long>(i));
  knots.push_back(knots.back());
  return bspline_curve<Dim>(1, vertices, knots, {}, closed);
}

/// Polyline in the plane; see `polyline_curve`.
inline Curve_2 polyline_2(const std::vector<Coordinates_2>& points, bool closed = false)
{
  return polyline_curve<2>(detail::exact(points), closed);
}

namespace detail {

inline Curve_2 straight_curve(const Coordinates_2& point, const Coordinates_2& direction, const Parameter_domain& domain)
{
  const Exact_point<2> p = point.exact(), d = direction.exact();
  if (d[0] == 0 && d[1] == 0)
    throw Invalid_input(".direction", "a direction must not be zero", "give a vector along the line");
  return monomial_curve<2>({{{p[0], d[0]}, {p[1], d[1]}}}, {}, domain);
}

} // namespace detail

/// The line point + u·direction, u from -∞ to ∞: three pieces, two of them projective. Throws Invalid_input for a zero
/// direction.
inline Curve_2 line_2(const Coordinates_2& point, const Coordinates_2& direction)
{
  return detail::straight_curve(point, direction, {});
}

/// The ray point + u·direction, u from 0 to ∞: two pieces, the second projective. Throws Invalid_input for a zero direction.
inline Curve_2 ray_2(const Coordinates_2& point, const Coordinates_2& direction)
{
  return detail::straight_curve(point, direction, {Rational(0), std::nullopt});
}

/// The ellipse centre + p·cos φ + q·sin φ with conjugate half diameters p and q, starting at centre + p towards
/// centre + q; closed, a quarter for each unit of the parameter on [0,4]. C¹ everywhere, and where it meets the line of p
/// one rational function. Throws Invalid_input if p and q are parallel.
inline Curve_2 ellipse_2(const Coordinates_2& centre, const Coordinates_2& p, const Coordinates_2& q)
{
  const Exact_point<2> a = p.exact(), b = q.exact();
  if (a[0] * b[1] == a[1] * b[0])
    throw Invalid_input(".half_diameters", "the conjugate half diameters of an ellipse must not be parallel",
                        "use a segment instead");
  return detail::conic_around(centre.exact(), a, b);
}

/// The ellipse with axes along the coordinate axes, half as long as `a` and `b`, counterclockwise from centre + (a, 0); see
/// above. Throws Invalid_input unless both are positive.
inline Curve_2 ellipse_2(const Coordinates_2& centre, const Number& a, const Number& b)
{
  if (a.value() <= 0 || b.value() <= 0)
    throw Invalid_input(a.value() <= 0 ? ".a" : ".b", "half an axis must be positive", "use a point or a segment instead");
  return ellipse_2(centre, {a, 0}, {0, b});
}

/// The circle, counterclockwise from centre + (radius, 0), a quarter for each unit of the parameter on [0,4]; see
/// `ellipse_2`. Throws Invalid_input unless the radius is positive.
inline Curve_2 circle_2(const Coordinates_2& centre, const Number& radius)
{
  if (radius.value() <= 0) throw Invalid_input(".radius", "the radius must be positive", "use a point instead");
  return ellipse_2(centre, radius, radius);
}

/// The circular arc from `start` to `end` with bulge = tan(angle/4), the angle positive counterclockwise: a bulge of 1 is
/// half a circle on the right of the way from start to end, 0 the segment. On [0,1], or from a bulge of 1/2 on two pieces
/// on [0,2] that are one rational function. Throws Invalid_input if the ends coincide.
inline Curve_2 arc_2(const Coordinates_2& start, const Coordinates_2& end, const Number& bulge)
{
  const Exact_point<2> a = start.exact(), b = end.exact();
  if (a == b) throw Invalid_input(".end", "the ends of an arc must differ", "use circle_2 for a whole circle");
  const Rational t = bulge.value(), t2 = t * t;
  if (t == 0) return bezier_curve<2>({a, b});
  // The control point of an arc is where its tangents meet, its weight cos(angle/2), all times 1 + t².
  Curve_piece<2> piece;
  piece.weight = Bernstein<Rational, 1>(Degrees<1>{2}, {Rational(1 + t2), Rational(1 - t2), Rational(1 + t2)});
  for (std::size_t v = 0; v < 2; ++v) {
    const Rational right = v == 0 ? Rational(b[1] - a[1]) : Rational(a[0] - b[0]);
    const Rational middle = (1 - t2) * (a[v] + b[v]) / 2 + t * right;
    piece.numerator[v] =
      Bernstein<Rational, 1>(Degrees<1>{2}, {Rational(a[v] * piece.weight[0]), middle, Rational(b[v] * piece.weight[0])});
  }
  if (abs(t) < Rational(1, 2)) return joined_curve<2>({piece}, detail::unit_ranges(1), false);
  const Piece whole = detail::finite_range(0, 2);
  std::vector<Piece> ranges = detail::unit_ranges(2);
  return joined_curve<2>({detail::part_over(piece, whole, ranges[0]), detail::part_over(piece, whole, ranges[1])}, ranges, false);
}

} // namespace locus

#endif
