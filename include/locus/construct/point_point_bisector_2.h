// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_POINT_POINT_BISECTOR_2_H
#define LOCUS_CONSTRUCT_POINT_POINT_BISECTOR_2_H

#include <locus/construct/extent.h>
#include <locus/construct/locus.h>
#include <locus/shape/constructors_2.h>

namespace locus {
namespace detail {

/// The perpendicular bisector of two points up to the cut radius, evaluated exactly and rounded.
class Perpendicular_line final : public Arc_geometry<2> {
public:
  Perpendicular_line(const Exact_point<2>& p, const Exact_point<2>& q, const Rational& reach) : p_(p), reach_(reach)
  {
    for (std::size_t k = 0; k < 2; ++k) middle_[k] = (p[k] + q[k]) / 2;
    direction_ = {Rational(p[1] - q[1]), Rational(q[0] - p[0])};
  }

  Arc_point<2> at(double x) const override
  {
    const Rational s = (2 * Rational(x) - 1) * reach_;
    Approximate_point<2> printed;
    Rational off = 0, square = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Rational exact = middle_[k] + s * direction_[k];
      printed[k] = nearest_double(exact);
      if (!std::isfinite(printed[k])) throw Unsupported_feature("a point with coordinates beyond 1e308");
      off += abs(exact - Rational(printed[k]));
      square += (exact - p_[k]) * (exact - p_[k]);
    }
    return with_upward_rounding([&] { return Arc_point<2>({}, printed, midpoint(CGAL::sqrt(enclosing(square))), enclosing(off).sup()); });
  }

  Arc_differential<2> differential(double) const override { return {unit_direction(), 0}; }

  std::vector<Arc_point<2>> samples(std::size_t n) const override
  {
    std::vector<Arc_point<2>> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(at(n == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(n - 1)));
    return points;
  }

  Polyline<2> polyline(double) const override
  {
    std::vector<Arc_point<2>> points = samples(3);
    double error = 0;
    for (const auto& p : points) error = std::max(error, p.error());
    return {std::move(points), error};
  }

  Irregular_points<2> irregular() const override { return {}; }

  Approximate_point<2> unit_direction() const
  {
    const double x = direction_[0].get_d(), y = direction_[1].get_d(), length = std::hypot(x, y);
    return {x / length, y / length};
  }

private:
  Exact_point<2> p_, middle_;
  std::array<Rational, 2> direction_;
  Rational reach_; ///< in multiples of the direction
};

} // namespace detail

/// The bisector of two points in the plane: their perpendicular line, with p on its right; all of the plane, as a region, where
/// they are equal. Inputs are numbered in the order of the arguments.
inline Locus<2> bisector(const Coordinates_2& p, const Coordinates_2& q)
{
  Locus_data<2> data;
  data.compute = "bisector";
  data.trimmed = true;
  const Exact_point<2> a = p.exact(), b = q.exact();
  double apart = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    apart = std::hypot(apart, Rational(b[k] - a[k]).get_d());
    data.centre[k] = nearest_double(Rational((a[k] + b[k]) / 2));
  }
  data.scale = apart > 0 ? apart : 1;
  data.cut_radius = detail::cut_factor * data.scale;
  if (a == b) {
    data.regions.push_back({{}, "the points are equal: all points are equidistant"});
    return Locus<2>(std::move(data));
  }
  if (!(apart > 0) || !std::isfinite(data.cut_radius)) throw Unsupported_feature("points whose distance no double holds");
  const auto line = std::make_shared<const detail::Perpendicular_line>(a, b, Rational(detail::cut_factor));
  const std::vector<Foot> feet{{0, Feature::point, {}}, {1, Feature::point, {}}};
  for (const double sign : {-1.0, 1.0}) {
    Locus_vertex<2> v;
    v.kind = Vertex_kind::infinity;
    v.feet = feet;
    const Approximate_point<2> d = line->unit_direction();
    v.direction = Approximate_point<2>{sign * d[0], sign * d[1]};
    v.asymptote = Asymptote<2>{line->at(0.5).point(), *v.direction};
    data.vertices.push_back(std::move(v));
  }
  data.arcs.emplace_back(line, 0, 1, std::vector<std::size_t>{0, 1}, std::vector<Feature>{Feature::point, Feature::point});
  return Locus<2>(std::move(data));
}

} // namespace locus

#endif
