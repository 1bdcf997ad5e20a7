// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_POINT_CELL_H
#define LOCUS_CONSTRUCT_POINT_CELL_H

#include <locus/construct/point_cell_features.h>
#include <locus/zero_set/feasible_set.h>

namespace locus {

/// A stretch of the boundary of a point's cell: the circles about its points through the point p touch one feature of the
/// curve, and are empty.
struct Cell_stretch {
  std::size_t feature = 0; ///< in Point_cell::features()
  std::array<Feasible_end, 2> ends; ///< in the feature's parameter
  std::array<bool, 2> infinite{}; ///< whether the boundary goes to infinity there
  double inside = 0; ///< a parameter between the ends
  bool counterclockwise = true; ///< as the parameter grows
};

/// The points that are nearer to a point p than to a curve, as they are bounded: a convex set (Remark 3.4 of Farouki &
/// Johnstone 1994), by stretches of the untrimmed bisector and, from ends and corners, of straight lines.
///
/// By duality (see Point_curve_forms) it is the polar set of the convex hull of the inverted curve and p's image at infinity.
/// A place u is on the boundary exactly where the tangent of the inverted curve at u has all of it on one side: the
/// requirements T(u, v) ≥ 0 for all v, and [ρ ρ'](u) ≥ 0, or both with the other sign. They are decided for all u at once
/// (zero_set/feasible_set.h); inflections play no part in it: 1 + κd changes sign at circular and class points only, and
/// T(u, u) is circular_form.
class Point_cell {
public:
  Point_cell(Cell_features features, const Solve_control& control) : features_(std::move(features))
  {
    for (std::size_t k = 0; k < features_.features.size(); ++k) solve(k, control);
  }

  const std::vector<Cell_feature>& features() const { return features_.features; }
  const std::vector<Cell_stretch>& stretches() const { return stretches_; }
  struct Undecided {
    std::size_t feature;
    std::array<double, 2> at;
  };
  const std::vector<Undecided>& undecided() const { return undecided_; }
  std::size_t cells() const { return cells_; }
  std::size_t algebraic_cells() const { return algebraic_cells_; }
  const Filter_counts& filter() const { return filter_; }

private:
  void solve(std::size_t k, const Solve_control& control)
  {
    Cell_feature& feature = features_.features[k];
    Feasible_set set = detail::Feasible_set_solver(feature.requirements, control).run();
    cells_ += set.cells;
    algebraic_cells_ += set.algebraic_cells;
    filter_ += set.filter;
    for (const auto& u : set.undecided) undecided_.push_back({k, u});
    detail::Feasible_end_refiner refiner(feature.requirements, filter_);
    for (Feasible_interval& interval : set.intervals) {
      Cell_stretch stretch;
      stretch.feature = k;
      stretch.counterclockwise = feature.counterclockwise;
      stretch.inside = interval.inside;
      for (int e = 0; e < 2; ++e) {
        const auto i = static_cast<std::size_t>(e);
        refiner.narrow(interval.ends[i], e, end_width);
        stretch.infinite[i] = is_infinite(feature, interval.ends[i], e, refiner);
        if (!stretch.infinite[i] && is_sensitive(feature, interval.ends[i])) refiner.narrow(interval.ends[i], e, 0x1p-52, 0x1p-52);
        stretch.ends[i] = std::move(interval.ends[i]);
      }
      if (!(stretch.ends[0].hi < stretch.inside && stretch.inside < stretch.ends[1].lo))
        stretch.inside = 0.5 * (stretch.ends[0].hi + stretch.ends[1].lo);
      stretches_.push_back(std::move(stretch));
    }
  }

  /// As closely as an end is enclosed before anything is made of it.
  static constexpr double end_width = 0x1p-42;

  /// Whether the boundary's point is far from being known where the parameter is enclosed so closely; about.
  static bool is_sensitive(const Cell_feature& feature, const Feasible_end& end)
  {
    if (end.is_exact()) return false;
    const auto point = [&](double u) {
      const auto fresh = feature.tangent_tree->fresh_at(u);
      const Enclosed_vector rough = feature.tangent_tree->node(0).f.at(u);
      const auto value = [&](std::size_t k) { return midpoint(fresh ? (*fresh)[k] : rough.interval_form(k)[0]); };
      return std::array<double, 2>{value(0) / value(2), value(1) / value(2)};
    };
    const auto a = point(end.lo), b = point(end.hi);
    for (std::size_t k = 0; k < 2; ++k)
      if (!(std::abs(b[k] - a[k]) <= 1e-9 * std::max(1.0, std::abs(a[k])))) return true;
    return false;
  }

  /// Whether the weight vanishes at an end that is no end of the feature: whether it is the weight's requirement, the first one,
  /// that fails beyond it. Where others may fail there as well, exactly.
  static bool is_infinite(const Cell_feature& feature, Feasible_end& end, int side, detail::Feasible_end_refiner& refiner)
  {
    if (end.is_exact()) {
      const Interval weight = feature.tangent_tree->node(0).f.at(end.lo).interval_form(2)[0];
      return contains_zero(weight) && evaluate_at(feature.tangent()[2], Rational(end.lo)) == 0;
    }
    const auto is_of_weight = [](const Open_requirement& r) { return r.requirement == 0; };
    if (!feature.has_weight_requirement || std::none_of(end.open.begin(), end.open.end(), is_of_weight)) return false;
    if (std::all_of(end.open.begin(), end.open.end(), is_of_weight)) return true;
    // Each alone, and elimination only where their boundary points are not told apart.
    std::array<Feasible_end, 2> alone{end, end}; // of the weight, of the others
    for (Feasible_end& e : alone) e.open.clear();
    for (const Open_requirement& r : end.open) alone[is_of_weight(r) ? 0 : 1].open.push_back(r);
    for (double width = end_width; width > 0x1p-48; width *= 0.25) {
      for (Feasible_end& e : alone) refiner.narrow(e, side, width, width);
      if (alone[0].hi < alone[1].lo) return side == 1;
      if (alone[1].hi < alone[0].lo) return side == 0;
    }
    const Bernstein<Rational, 1>& weight = feature.requirements[0].a->exact()[0];
    if (!refiner.make_algebraic(end, side)) throw std::logic_error("locus: the end of a stretch that is no event");
    refiner.narrow(end, side, end_width);
    const Algebraic_end& a = *end.algebraic;
    if (a.lo == a.hi) return evaluate_at(weight, a.lo) == 0;
    const Integer_polynomial common = gcd(monomial_form(Bernstein<Scaled_integer, 1>(weight)), *a.polynomial);
    return degree(common) > 0 && !exact_roots(restrict_to(bernstein_form(common), 0, a.lo, a.hi), Rational(0), Rational(1)).roots.empty();
  }

  Cell_features features_;
  std::vector<Cell_stretch> stretches_;
  std::vector<Undecided> undecided_;
  std::size_t cells_ = 0, algebraic_cells_ = 0;
  Filter_counts filter_;
};

} // namespace locus

#endif
