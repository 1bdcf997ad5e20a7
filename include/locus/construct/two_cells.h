// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_TWO_CELLS_H
#define LOCUS_CONSTRUCT_TWO_CELLS_H

#include <locus/construct/locus.h>
#include <locus/shape/rational_curve.h>

namespace locus {
namespace detail {

/// Orders the arcs of a bisector that is one simple curve as the outline of one of the two cells that it separates.
class Two_cells {
public:
  Two_cells(const Locus_data<2>& data, const std::vector<const Curve_2*>& curves) : data_(data), curves_(curves) {}

  /// The cell of the input that is inside a closed bisector, or of the first one. Nothing where the bisector is not one simple curve,
  /// closed or infinite at both ends.
  std::optional<Cell_outline> outline() const
  {
    if (data_.arcs.empty() || !data_.regions.empty() || !data_.undecided.empty()) return std::nullopt;
    auto chain = chained();
    if (!chain) return std::nullopt;
    const std::size_t left = input_on_left(*chain);
    if (chain->bounded ? area(*chain) < 0 : left != 0) {
      std::reverse(chain->arcs.begin(), chain->arcs.end());
      std::reverse(chain->reversed.begin(), chain->reversed.end());
      for (char& r : chain->reversed) r = !r;
      chain->input = 1 - left;
    } else {
      chain->input = left;
    }
    return chain;
  }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  bool is_infinite(std::size_t v) const { return data_.vertices[v].kind == Vertex_kind::infinity; }

  std::optional<Cell_outline> chained() const
  {
    const std::size_t n = data_.arcs.size();
    std::vector<std::vector<std::size_t>> at(data_.vertices.size());
    std::size_t first = 0, infinite = 0;
    bool from_target = false;
    for (std::size_t a = 0; a < n; ++a) {
      const Arc<2>& arc = data_.arcs[a];
      if (arc.is_closed()) return n == 1 ? std::optional(Cell_outline{0, {0}, {0}, true}) : std::nullopt;
      for (const bool is_target : {false, true}) {
        const std::size_t v = is_target ? *arc.target() : *arc.source();
        at[v].push_back(a);
        if (!is_infinite(v)) continue;
        ++infinite;
        first = a;
        from_target = is_target;
      }
    }
    for (std::size_t v = 0; v < at.size(); ++v)
      if (at[v].size() > 2 || (!is_infinite(v) && at[v].size() != 2)) return std::nullopt;
    if (infinite != 0 && infinite != 2) return std::nullopt;
    Cell_outline chain;
    chain.bounded = infinite == 0;
    std::size_t a = first;
    for (bool is_reversed = from_target; chain.arcs.size() < n;) {
      chain.arcs.push_back(a);
      chain.reversed.push_back(is_reversed);
      const std::size_t v = is_reversed ? *data_.arcs[a].source() : *data_.arcs[a].target();
      if (is_infinite(v)) break;
      const std::size_t next = at[v][0] == a ? at[v][1] : at[v][0];
      if (next == first) break;
      is_reversed = *data_.arcs[next].source() != v;
      a = next;
    }
    return chain.arcs.size() == n ? std::optional(std::move(chain)) : std::nullopt;
  }

  /// By the chord between the feet, to which the bisector is perpendicular.
  std::size_t input_on_left(const Cell_outline& chain) const
  {
    double best = 0;
    std::size_t left = 0;
    for (std::size_t k = 0; k < chain.arcs.size(); ++k) {
      const Arc<2>& arc = data_.arcs[chain.arcs[k]];
      const double step = chain.reversed[k] ? -1e-3 : 1e-3;
      const Arc_point<2> p = arc.at(0.5), before = arc.at(0.5 - step), after = arc.at(0.5 + step);
      const auto a = foot(arc, p, 0), b = foot(arc, p, 1);
      const double x = (after.point()[0] - before.point()[0]) * (b[1] - a[1]) - (after.point()[1] - before.point()[1]) * (b[0] - a[0]);
      if (!(std::abs(x) > std::abs(best))) continue;
      best = x;
      left = x > 0 ? 1 : 0;
    }
    return left;
  }

  /// The foot on an input, as a double tells its parameter.
  Approximate_point<2> foot(const Arc<2>& arc, const Arc_point<2>& p, std::size_t input) const
  {
    const std::size_t k = arc.inputs()[0] == input ? 0 : 1;
    const Curve_2& curve = *curves_[input];
    const Rational u(p.parameter(k));
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      const Piece& range = curve.chain().pieces[i];
      if (!range.is_finite() || u > range.hi) continue;
      const Rational s = std::max(Rational(0), Rational((u - range.lo) / (range.hi - range.lo))), w = evaluate_at(curve.pieces()[i].weight, s);
      return {Rational(evaluate_at(curve.pieces()[i].numerator[0], s) / w).get_d(), Rational(evaluate_at(curve.pieces()[i].numerator[1], s) / w).get_d()};
    }
    return p.point();
  }

  double area(const Cell_outline& chain) const
  {
    constexpr std::size_t samples = 33;
    double sum = 0;
    std::optional<Approximate_point<2>> last, first;
    for (std::size_t k = 0; k < chain.arcs.size(); ++k) {
      std::vector<Arc_point<2>> points = data_.arcs[chain.arcs[k]].samples(samples);
      if (chain.reversed[k]) std::reverse(points.begin(), points.end());
      for (const Arc_point<2>& p : points) {
        if (last) sum += (*last)[0] * p.point()[1] - (*last)[1] * p.point()[0];
        last = p.point();
        if (!first) first = last;
      }
    }
    return sum + (*last)[0] * (*first)[1] - (*last)[1] * (*first)[0];
  }

  const Locus_data<2>& data_;
  const std::vector<const Curve_2*>& curves_;
};

} // namespace detail
} // namespace locus

#endif
