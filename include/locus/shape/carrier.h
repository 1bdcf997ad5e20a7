// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_CARRIER_H
#define LOCUS_SHAPE_CARRIER_H

#include <locus/shape/rational_curve.h>

#include <optional>

namespace locus {

/// The line or circle that carries a planar curve piece.
struct Carrier {
  enum class Kind : unsigned char { general, line, circle };
  Kind kind = Kind::general;
  Exact_point<2> direction{};        ///< of a line, in the sense of the parameter
  Exact_point<2> centre{};           ///< of a circle
  Rational squared_radius = 0;       ///< of a circle
};

namespace detail {

inline Rational homogeneous_determinant(const Curve_piece<2>& c, std::size_t i, std::size_t j, std::size_t k)
{
  const auto w = [&](std::size_t n) { return c.is_polynomial() ? c.weight[0] : c.weight[n]; };
  const auto &x = c.numerator[0], &y = c.numerator[1];
  return Rational(x[i] * (y[j] * w(k) - y[k] * w(j)) - y[i] * (x[j] * w(k) - x[k] * w(j)) + w(i) * (x[j] * y[k] - x[k] * y[j]));
}

/// Two points of a piece that differ, in the order of the parameter: the ends where that will do. Of degree + 2 parameters
/// one gives another point than the first does.
inline std::array<Exact_point<2>, 2> two_points_of(const Curve_piece<2>& c)
{
  std::vector<Rational> at{0, 1, Rational(1, 2)};
  const long n = c.degree() + 2;
  for (long i = 1; i < n; ++i) {
    Rational s(i, n);
    s.canonicalize();
    at.push_back(s);
  }
  std::array<Exact_point<2>, 2> found;
  std::optional<Rational> first;
  for (const Rational& s : at) {
    const Rational w = evaluate_at(c.weight, s);
    if (w == 0) continue; // at infinity
    Exact_point<2> p;
    for (std::size_t v = 0; v < 2; ++v) p[v] = evaluate_at(c.numerator[v], s) / w;
    if (!first) {
      first = s;
      found[0] = p;
    } else if (p != found[0]) {
      found[1] = p;
      if (s < *first) std::swap(found[0], found[1]);
      return found;
    }
  }
  throw std::logic_error("locus: a piece that is a single point has no direction");
}

/// A piece lies on a line exactly when its homogeneous control points span a plane.
inline std::optional<Carrier> line_of(const Curve_piece<2>& c)
{
  const auto n = static_cast<std::size_t>(c.degree());
  if (c.numerator[0].degree() != c.numerator[1].degree()) return std::nullopt;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = i + 1; j <= n; ++j)
      for (std::size_t k = j + 1; k <= n; ++k)
        if (homogeneous_determinant(c, i, j, k) != 0) return std::nullopt;
  Carrier line;
  line.kind = Carrier::Kind::line;
  const auto ends = two_points_of(c);
  line.direction = {Rational(ends[1][0] - ends[0][0]), Rational(ends[1][1] - ends[0][1])};
  return line;
}

/// A piece lies on a circle exactly when |p - c·w|² = ρ²·w² identically, for the circle through three of its points.
inline std::optional<Carrier> circle_of(const Curve_piece<2>& c)
{
  if (c.is_polynomial() || c.weight[0] == 0 || c.weight[c.weight.size() - 1] == 0) return std::nullopt; // reaches infinity
  std::array<Exact_point<2>, 4> p;
  for (std::size_t s = 0; s < 4; ++s) {
    const Rational u(static_cast<long>(s), 3);
    for (std::size_t v = 0; v < 2; ++v) p[s][v] = evaluate_at(c.numerator[v], u) / evaluate_at(c.weight, u);
  }
  const Rational ax = p[1][0] - p[0][0], ay = p[1][1] - p[0][1], bx = p[2][0] - p[0][0], by = p[2][1] - p[0][1];
  const Rational det = 2 * (ax * by - ay * bx);
  if (det == 0) return std::nullopt;
  const Rational a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
  const Rational cx = (a2 * by - b2 * ay) / det, cy = (ax * b2 - bx * a2) / det;
  Carrier circle;
  circle.kind = Carrier::Kind::circle;
  circle.centre = {Rational(p[0][0] + cx), Rational(p[0][1] + cy)};
  circle.squared_radius = cx * cx + cy * cy;
  const Rational dx = p[3][0] - circle.centre[0], dy = p[3][1] - circle.centre[1];
  if (Rational(dx * dx + dy * dy) != circle.squared_radius) return std::nullopt;
  const auto zx = subtract(c.numerator[0], multiply(c.weight, circle.centre[0]));
  const auto zy = subtract(c.numerator[1], multiply(c.weight, circle.centre[1]));
  const auto excess = subtract(add(multiply(zx, zx), multiply(zy, zy)),
                               multiply(multiply(c.weight, c.weight), circle.squared_radius));
  for (const Rational& x : excess.coefficients())
    if (x != 0) return std::nullopt;
  return circle;
}

} // namespace detail

/// Recognises a piece on a line or a circle, exactly.
inline Carrier carrier_of(const Curve_piece<2>& piece)
{
  if (auto line = detail::line_of(piece)) return *line;
  if (auto circle = detail::circle_of(piece)) return *circle;
  return {};
}

} // namespace locus

#endif
