// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_ARC_CIRCLES_H
#define LOCUS_CONSTRUCT_ARC_CIRCLES_H

#include <locus/construct/arc_steps.h>
#include <locus/construct/contact_search.h>

namespace locus {
namespace detail {

/// The circles of a part of an arc: those about its points through both feet.
struct Arc_circles {
  Circle circle;
  std::array<Contact_foot, 2> feet;
  bool is_by_centre = true; ///< the first coefficient is 1
};

/// Encloses the circles of one step of an arc.
class Step_circles {
public:
  Step_circles(const Arc_steps& steps, std::size_t step, const std::array<std::size_t, 2>& inputs, const Contact_sites& sites)
    : steps_(steps), stretch_(steps.stretch(step)), scale_(steps.solution().scale)
  {
    const Planar_patch& patch = steps_.patch(stretch_);
    for (std::size_t k = 0; k < 2; ++k) site_[k] = sites.site(inputs[k], patch.piece[k]);
    if (!stretch_.piece->is_half_branch) evaluator_.emplace(*stretch_.form, stretch_.piece->base);
    orientation_ = find_orientation();
  }

  const Arc_stretch& stretch() const { return stretch_; }
  bool is_half_branch() const { return stretch_.piece->is_half_branch; }
  /// Base values from end to end.
  Interval base_range() const { return {stretch_.lo.inf(), stretch_.hi.sup()}; }

  /// At a base value, and over a range of them; at the piece's ends, of its vertices.
  Arc_circles at(double base) const
  {
    if (base <= stretch_.lo.sup()) return circles(steps_.place_vertex(stretch_, stretch_.piece->from));
    if (base >= stretch_.hi.inf()) return circles(steps_.place_vertex(stretch_, stretch_.piece->to));
    return circles(Arc_steps::parameters(*evaluator_, base, guess(base)));
  }
  Arc_circles over(double lo, double hi) const
  {
    const auto base = static_cast<std::size_t>(evaluator_->base()), pivot = static_cast<std::size_t>(evaluator_->pivot());
    const Interval at_lo = pivot_at(lo), at_hi = pivot_at(hi);
    std::array<Interval, 2> box;
    box[base] = Interval(lo, hi);
    const auto jet = evaluator_->jet_over(lo, hi, at_lo, at_hi);
    if (!jet) {
      box[pivot] = evaluator_->range_over(lo, hi, at_lo, at_hi);
      return circles(box);
    }
    box[pivot] = jet->value;
    Arc_circles result = circles(box);
    std::array<Jet<Interval>, 2> jets;
    jets[base] = {box[base], Interval(1), Interval(0)};
    jets[pivot] = {jet->value, jet->first, jet->second};
    narrow(result, lo, hi, jets);
    return result;
  }
  /// In a node's cell.
  Arc_circles over_half_branch() const
  {
    return circles(steps_.over_half_branch(stretch_, steps_.place_vertex(stretch_, stretch_.piece->from)));
  }
  Arc_circles at_outer_end() const { return circles(steps_.place_vertex(stretch_, stretch_.piece->to)); }

  Placed placed_over(double lo, double hi) const
  {
    const auto base = static_cast<std::size_t>(evaluator_->base()), pivot = static_cast<std::size_t>(evaluator_->pivot());
    const Interval at_lo = pivot_at(lo), at_hi = pivot_at(hi);
    const auto jet = evaluator_->jet_over(lo, hi, at_lo, at_hi);
    std::array<Interval, 2> box;
    box[base] = Interval(lo, hi);
    box[pivot] = jet ? jet->value : evaluator_->range_over(lo, hi, at_lo, at_hi);
    return steps_.place_on(stretch_, box);
  }

private:
  /// Circles about points farther than this multiple of the inputs' diameter are given by curvature and normal.
  static constexpr double far = 4;

  Interval pivot_at(double base) const
  {
    const auto pivot = static_cast<std::size_t>(evaluator_->pivot());
    if (base <= stretch_.lo.sup()) return steps_.vertex(stretch_, stretch_.piece->from).at[pivot];
    if (base >= stretch_.hi.inf()) return steps_.vertex(stretch_, stretch_.piece->to).at[pivot];
    return evaluator_->pivot_at(base, guess(base));
  }

  double guess(double base) const
  {
    const auto pivot = static_cast<std::size_t>(evaluator_->pivot());
    const double lo = stretch_.lo.sup(), hi = stretch_.hi.inf(), g = hi > lo ? std::min(1.0, std::max(0.0, (base - lo) / (hi - lo))) : 0.5;
    return midpoint(steps_.vertex(stretch_, stretch_.piece->from).at[pivot]) * (1 - g) + midpoint(steps_.vertex(stretch_, stretch_.piece->to).at[pivot]) * g;
  }

  Arc_circles circles(const std::array<Interval, 2>& at) const { return circles(steps_.place_on(stretch_, at)); }

  Arc_circles circles(const Placed& p) const
  {
    const Bisector_map_2& map = p.patch->map;
    const std::array<Interval, 2> local = map.chart()(p.at);
    Arc_circles result{Circle(), {Contact_foot{site_[0], local[0]}, Contact_foot{site_[1], local[1]}}, is_near(p)};
    result.circle = Circle(result.is_by_centre ? by_centre(map, local, p.point) : by_curvature(map, local));
    return result;
  }

  bool is_near(const Placed& p) const { return magnitude(p.radius) < far * scale_ && width(p.point.x) < scale_ && width(p.point.y) < scale_; }

  /// By the circle in the middle and the coefficients' derivatives, where that tells more.
  void narrow(Arc_circles& all, double lo, double hi, const std::array<Jet<Interval>, 2>& jets) const
  {
    const double middle = lo + 0.5 * (hi - lo);
    if (!(lo < middle && middle < hi) || middle <= stretch_.lo.sup() || middle >= stretch_.hi.inf()) return;
    const Placed at_middle = steps_.place_on(stretch_, Arc_steps::parameters(*evaluator_, middle, guess(middle)));
    const Bisector_map_2& map = at_middle.patch->map;
    const bool is_by_centre = is_near(at_middle);
    const std::array<Interval, 2> local = map.chart()(at_middle.at);
    const std::array<Jet<Interval>, 2> along = map.chart()(jets);
    const auto c = is_by_centre ? by_centre(map, local, at_middle.point) : by_curvature(map, local);
    const auto slope = is_by_centre ? by_centre(map, along, map.at(jets, map.choose({midpoint(jets[0].value), midpoint(jets[1].value)})).point) : by_curvature(map, along);
    const Interval half = Interval(hi) - Interval(middle);
    std::array<Interval, 4> closer;
    double error = 0, closer_error = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double reach = (Interval(magnitude(slope[k].first)) * half).sup();
      closer[k] = std::isfinite(reach) ? c[k] + Interval(-reach, reach) : Interval(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
      closer_error = std::max(closer_error, width(closer[k]));
      error = std::max(error, all.circle.error[k]);
    }
    if (is_by_centre == all.is_by_centre ? closer_error < 2 * error : std::isfinite(closer_error)) {
      all.circle = Circle(closer);
      all.is_by_centre = is_by_centre;
    }
  }

  /// |x - q|² - ρ², with ρ from the distance to a foot.
  template <class T>
  static std::array<T, 4> by_centre(const Bisector_map_2& map, const std::array<T, 2>& local, const Vector_2<T>& q)
  {
    const T two(Interval(2));
    const Vector_2<T> a = map.first().point(local[0]), b = map.second().point(local[1]);
    const T by_a = two * dot(q, a) - dot(a, a), by_b = two * dot(q, b) - dot(b, b);
    return {T(Interval(1)), -two * q.x, -two * q.y, width_of(by_a) <= width_of(by_b) ? by_a : by_b};
  }

  static double width_of(const Interval& x) { return width(x); }
  static double width_of(const Jet<Interval>& x) { return magnitude(x.first); }

  /// κ|x - A|² - 2⟨n, x - A⟩ for the first foot A with its normal n, which vanishes at the other foot; times a sign so that the inside
  /// is negative. For the second foot where the first one is infinite.
  template <class T>
  std::array<T, 4> by_curvature(const Bisector_map_2& map, const std::array<T, 2>& local) const
  {
    const Curve_evaluator* curve[2] = {&map.first(), &map.second()};
    const std::size_t k = contains_zero(value_of(curve[0]->weight(local[0]))) ? 1 : 0;
    const Vector_2<T> foot = curve[k]->point(local[k]), a = curve[k]->tangent(local[k]);
    const T s{Interval(orientation_[k])}, kappa = s * curvature(map, local, k), nx = -(s * a.y), ny = s * a.x, two{Interval(2)};
    return {kappa, -(two * (kappa * foot.x + nx)), -(two * (kappa * foot.y + ny)), kappa * dot(foot, foot) + two * (nx * foot.x + ny * foot.y)};
  }

  static const Interval& value_of(const Interval& x) { return x; }
  static const Interval& value_of(const Jet<Interval>& x) { return x.value; }

  /// κ = 2⟨n, Δ⟩/|Δ|² at either foot, Δ the chord to the other one; finite where a foot is not.
  template <class T>
  static T curvature(const Bisector_map_2& map, const std::array<T, 2>& local, std::size_t k)
  {
    const Curve_evaluator &first = map.first(), &second = map.second();
    const T w1 = first.weight(local[0]), w2 = second.weight(local[1]);
    const Vector_2<T> p1 = first.numerator(local[0]), p2 = second.numerator(local[1]);
    const Vector_2<T> e{p2.x * w1 - p1.x * w2, p2.y * w1 - p1.y * w2};
    const Vector_2<T> a = k == 0 ? first.tangent(local[0]) : second.tangent(local[1]);
    return T(Interval(k == 0 ? 2 : -2)) * w1 * w2 * cross(a, e) / dot(e, e);
  }

  /// On which side of either curve the circles lie: the signs of κ along the step.
  std::array<double, 2> find_orientation() const
  {
    std::array<double, 2> orientation{1, 1};
    if (is_half_branch() || !(stretch_.lo.sup() < stretch_.hi.inf())) return orientation;
    for (const double f : {0.5, 0.25, 0.75, 0.125, 0.875}) {
      const double base = stretch_.lo.sup() + f * (stretch_.hi.inf() - stretch_.lo.sup());
      const auto local = steps_.patch(stretch_).map.chart()(Arc_steps::parameters(*evaluator_, base, guess(base)));
      bool is_known = true;
      for (std::size_t k = 0; k < 2; ++k) {
        const Sign s = sign_of(curvature(steps_.patch(stretch_).map, local, k));
        is_known = is_known && is_strict(s);
        orientation[k] = s == Sign::negative ? -1 : 1;
      }
      if (is_known) break;
    }
    return orientation;
  }

  const Arc_steps& steps_;
  Arc_stretch stretch_;
  double scale_;
  std::array<std::size_t, 2> site_{};
  std::optional<Piece_evaluator> evaluator_;
  std::array<double, 2> orientation_{1, 1};
};

} // namespace detail
} // namespace locus

#endif
