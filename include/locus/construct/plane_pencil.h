// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANE_PENCIL_H
#define LOCUS_CONSTRUCT_PLANE_PENCIL_H

#include <locus/construct/ruled_surface.h>
#include <locus/shape/parameter_form.h>

namespace locus {

/// For each coordinate the values over which a chart shows a surface whose rulings it parametrises by that coordinate.
using Coordinate_ranges = std::array<Ruling_range, 3>;

/// A part of a ruled surface whose second parameter is one of the coordinates.
struct Ruled_chart {
  std::size_t piece = 0;    ///< of the curve
  std::size_t coordinate = 2;
  Rational_map_piece<3, 2> map;
};

/// Two planes that move with a parameter: ⟨normal[i], X⟩ = side[i]/denominator. Their common lines are the rulings of a ruled
/// surface, which is at infinity where the planes are parallel.
struct Plane_pencil {
  std::array<Polynomial_vector<1, 3>, 2> normal;
  std::array<Bernstein<Rational, 1>, 2> side;
  Bernstein<Rational, 1> denominator;

  /// The planes are parallel all along.
  bool is_degenerate() const { return is_zero(cross(normal[0], normal[1])); }

  /// The direct approach of Chen, Riesenfeld & Cohen (5.13): one coordinate is the ruling parameter. A piece is split until on
  /// each part one component of the planes' line direction, without its common factor, has Bernstein coefficients of one
  /// strict sign, so that the chart of that coordinate covers the part. The components then have no common zero, so this ends.
  /// An infinite range must need one chart only (see `collect_charts`): a part of its local coordinate is no part of a range's.
  std::vector<Ruled_chart> charts(std::size_t piece, const Piece& range, const Coordinate_ranges& coordinates) const
  {
    std::vector<Ruled_chart> found;
    for (const Part& part : parts()) {
      detail::Ruled_forms forms = forms_by_coordinate(part.coordinate);
      const Piece over = part.lo == 0 && part.hi == 1 ? range : detail::finite_piece(*range.at(part.lo), *range.at(part.hi));
      for (auto* vector : {&forms.point, &forms.generator})
        for (auto& f : *vector) f = restrict_to(f, 0, part.lo, part.hi);
      forms.weight = restrict_to(forms.weight, 0, part.lo, part.hi);
      found.push_back({piece, part.coordinate, forms.over(over, coordinates[part.coordinate])});
    }
    return found;
  }

  /// How many charts that needs.
  std::size_t chart_count() const { return parts().size(); }

  /// The explicit approach (5.10): the directrix lies in the plane through the origin across the ruling, so it is the point of
  /// the ruling next to the origin; the generator is the planes' line direction without its common factor.
  detail::Ruled_forms forms_by_directrix() const
  {
    using namespace operators;
    const Polynomial_vector<1, 3> line = cross(normal[0], normal[1]), g = detail::without_common_factor(line);
    detail::Ruled_forms forms{side[0] * cross(normal[1], g) + side[1] * cross(g, normal[0]), g, denominator * dot(line, g)};
    // Together with the generator a common factor is not to be seen: it is scaled by its own.
    const auto reduced = detail::without_common_factor(
      detail::vector_of<4>([&](std::size_t k) { return k < 3 ? forms.point[k] : forms.weight; }));
    for (std::size_t k = 0; k < 3; ++k) forms.point[k] = reduced[k];
    forms.weight = reduced[3];
    return forms;
  }

private:
  struct Part {
    Rational lo, hi;
    std::size_t coordinate;
  };

  std::vector<Part> parts() const
  {
    std::vector<Part> found;
    if (!is_degenerate()) split_by_signs(detail::without_common_factor(cross(normal[0], normal[1])), {0, 1, 0}, found);
    return found;
  }

  /// X = (s₀·n₁×e + s₁·e×n₀ + λ·d·n₀×n₁)/(d·⟨e, n₀×n₁⟩) for the unit vector e of a coordinate.
  detail::Ruled_forms forms_by_coordinate(std::size_t k) const
  {
    using namespace operators;
    Polynomial_vector<1, 3> unit;
    unit[k] = Bernstein<Rational, 1>(Degrees<1>{0}, {Rational(1)});
    const Polynomial_vector<1, 3> line = cross(normal[0], normal[1]);
    detail::Ruled_forms forms{side[0] * cross(normal[1], unit) + side[1] * cross(unit, normal[0]), denominator * line, denominator * line[k]};
    forms.reduce();
    return forms;
  }

  /// Neighbouring parts of one coordinate are one part.
  static void split_by_signs(const Polynomial_vector<1, 3>& direction, const Part& part, std::vector<Part>& parts)
  {
    std::size_t best = 3;
    Rational greatest = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!detail::all_of_one_sign(direction[k])) continue;
      Rational least = abs(direction[k][0]);
      for (const Rational& c : direction[k].coefficients()) least = std::min(least, Rational(abs(c)));
      if (least > greatest) {
        greatest = least;
        best = k;
      }
    }
    // The coordinate of the part before goes on where it can.
    if (!parts.empty() && detail::all_of_one_sign(direction[parts.back().coordinate])) best = parts.back().coordinate;
    if (best < 3) {
      if (!parts.empty() && parts.back().coordinate == best) parts.back().hi = part.hi;
      else parts.push_back({part.lo, part.hi, best});
      return;
    }
    const Rational half(1, 2), mid = (part.lo + part.hi) / 2;
    Polynomial_vector<1, 3> left, right;
    for (std::size_t k = 0; k < 3; ++k) {
      auto both = split(direction[k], 0, half);
      left[k] = std::move(both.first);
      right[k] = std::move(both.second);
    }
    split_by_signs(left, {part.lo, mid, 0}, parts);
    split_by_signs(right, {mid, part.hi, 0}, parts);
  }
};

/// The charts of a curve piece by the pencil that `make_planes` gives for it. Towards infinity the piece is cut in its parameter
/// until each part needs one chart.
template <class Make>
void collect_charts(std::size_t index, const Curve_piece<3>& piece, const Piece& range, const Make& make_planes,
                    const Coordinate_ranges& coordinates, std::vector<Ruled_chart>& charts)
{
  const Plane_pencil planes = make_planes(piece);
  if (range.is_finite() || planes.chart_count() < 2) {
    for (Ruled_chart& chart : planes.charts(index, range, coordinates)) charts.push_back(std::move(chart));
    return;
  }
  for (const Piece& part : detail::split_range(range, *range.at(Rational(1, 2))))
    collect_charts(index, detail::part_over(piece, range, part), part, make_planes, coordinates, charts);
}

} // namespace locus

#endif
