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
  bool is_loose = false;    ///< the arc is enclosed much more widely than it runs
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
  /// A point of the step: its base value, which at an end of the step is only enclosed, and the chart's coordinates.
  struct Place {
    double base = 0;
    std::array<Interval, 2> at;
    bool is_end = false;
  };

  std::array<Place, 2> ends() const
  {
    const auto end = [&](std::size_t vertex, double base) { return Place{base, steps_.vertex(stretch_, vertex).at, true}; };
    return {end(stretch_.piece->from, stretch_.lo.inf()), end(stretch_.piece->to, stretch_.hi.sup())};
  }
  /// Nothing where no double lies between.
  std::optional<Place> between(const Place& a, const Place& b, double f = 0.5) const
  {
    const double lo = a.is_end ? stretch_.lo.sup() : a.base, hi = b.is_end ? stretch_.hi.inf() : b.base, base = lo + f * (hi - lo);
    if (!(lo < base && base < hi)) return std::nullopt;
    const auto pivot = static_cast<std::size_t>(evaluator_->pivot());
    return Place{base, Arc_steps::parameters(*evaluator_, base, midpoint(a.at[pivot]) * (1 - f) + midpoint(b.at[pivot]) * f), false};
  }

  Arc_circles at(const Place& p) const
  {
    if (p.is_end) return circles(steps_.place_vertex(stretch_, p.base <= stretch_.lo.sup() ? stretch_.piece->from : stretch_.piece->to));
    return circles(steps_.place_on(stretch_, p.at));
  }

  /// Over all from one place to another, with one between if there is one.
  Arc_circles over(const Place& a, const Place& b, const std::optional<Place>& middle) const
  {
    const auto pivot = static_cast<std::size_t>(evaluator_->pivot());
    const auto [box, jet] = box_over(a, b);
    Arc_circles result = circles(steps_.place_on(stretch_, box));
    result.is_loose = !jet || width(box[pivot]) > 2 * width(hull(a.at[pivot], b.at[pivot]));
    if (!jet || !middle) return result;
    std::array<Jet<Interval>, 2> jets;
    jets[1 - pivot] = {box[1 - pivot], Interval(1), Interval(0)};
    jets[pivot] = {jet->value, jet->first, jet->second};
    narrow(result, *middle, std::max(b.base - middle->base, middle->base - a.base) * (1 + 4 * operation_error), jets);
    return result;
  }
  /// In a node's cell.
  Arc_circles over_half_branch() const { return circles(placed_over_half_branch()); }
  /// A disc that holds all circles in a node's cell; much smaller than the coefficients' errors tell where they are small themselves,
  /// as at a corner. Nothing where they are not enclosed.
  std::optional<Circle> disc_of_half_branch() const
  {
    const Placed p = placed_over_half_branch();
    const Bisector_map_2& map = p.patch->map;
    const double x = midpoint(p.point.x), y = midpoint(p.point.y);
    const Vector_2<Interval> foot = map.first().point(map.chart()(p.at)[0]);
    const auto greatest = [](const Interval& dx, const Interval& dy) { return sqrt(Interval((dx * dx + dy * dy).sup())); };
    const Interval r = greatest(foot.x - p.point.x, foot.y - p.point.y) + greatest(p.point.x - Interval(x), p.point.y - Interval(y));
    if (!std::isfinite(r.sup())) return std::nullopt;
    const Interval cx(x), cy(y);
    return Circle({Interval(1), Interval(-2) * cx, Interval(-2) * cy, cx * cx + cy * cy - r * r});
  }
  Arc_circles at_outer_end() const { return circles(steps_.place_vertex(stretch_, stretch_.piece->to)); }

  /// The same step to be evaluated from one place to another only: what is enclosed loosely on all of it is not there. Nothing for
  /// a part that is not short.
  std::optional<Step_circles> restricted(const Place& a, const Place& b) const
  {
    const auto base = static_cast<std::size_t>(evaluator_->base()), pivot = static_cast<std::size_t>(evaluator_->pivot());
    const Curve_graph::Cell_form& form = own_form_ ? *own_form_ : *stretch_.form;
    if (!(b.base - a.base < 0.3 * (form.box.hi[base] - form.box.lo[base]))) return std::nullopt;
    Step_circles part(*this);
    part.own_form_ = std::make_shared<const Curve_graph::Cell_form>(evaluator_->restricted_form(a.base, b.base, a.at[pivot], b.at[pivot]));
    part.evaluator_.emplace(*part.own_form_, stretch_.piece->base);
    return part;
  }

  Placed placed_over(const Place& a, const Place& b) const
  {
    return steps_.place_on(stretch_, box_over(a, b).at);
  }

private:
  /// The chart's coordinates over all from one place to another, and the pivot's derivatives where they are bounded.
  struct Box {
    std::array<Interval, 2> at;
    std::optional<Dependent_jet> jet;
  };

  Box box_over(const Place& a, const Place& b) const
  {
    const auto pivot = static_cast<std::size_t>(evaluator_->pivot());
    Box box{{}, evaluator_->jet_over(a.base, b.base, a.at[pivot], b.at[pivot])};
    box.at[1 - pivot] = Interval(a.base, b.base);
    box.at[pivot] = box.jet ? box.jet->value : evaluator_->range_over(a.base, b.base, a.at[pivot], b.at[pivot]);
    return box;
  }

  Placed placed_over_half_branch() const { return steps_.over_half_branch(stretch_, steps_.place_vertex(stretch_, stretch_.piece->from)); }

  /// Circles about points farther than this multiple of the inputs' diameter are given by curvature and normal.
  static constexpr double far = 4;

  double guess(double base) const
  {
    const auto pivot = static_cast<std::size_t>(evaluator_->pivot());
    const double lo = stretch_.lo.sup(), hi = stretch_.hi.inf(), g = hi > lo ? std::min(1.0, std::max(0.0, (base - lo) / (hi - lo))) : 0.5;
    return midpoint(steps_.vertex(stretch_, stretch_.piece->from).at[pivot]) * (1 - g) + midpoint(steps_.vertex(stretch_, stretch_.piece->to).at[pivot]) * g;
  }

  Arc_circles circles(const Placed& p) const
  {
    const Bisector_map_2& map = p.patch->map;
    const std::array<Interval, 2> local = map.chart()(p.at);
    Arc_circles result{Circle(), {Contact_foot{site_[0], local[0]}, Contact_foot{site_[1], local[1]}}, is_near(p)};
    if (!result.is_by_centre) {
      result.circle = Circle(by_curvature(map, p.at, local, map.choose({midpoint(p.at[0]), midpoint(p.at[1])})));
      result.is_by_centre = !std::isfinite(result.circle.greatest_error()); // as where both feet run into one place
    }
    if (result.is_by_centre) result.circle = Circle(by_centre(map, local, p.point));
    return result;
  }

  bool is_near(const Placed& p) const { return magnitude(p.radius) < far * scale_ && width(p.point.x) < scale_ && width(p.point.y) < scale_; }

  /// By the circle in the middle and the coefficients' derivatives there and over all of the range, where that tells more.
  void narrow(Arc_circles& all, const Place& middle, double half_width, const std::array<Jet<Interval>, 2>& jets) const
  {
    const std::array<Interval, 2>& at = middle.at;
    const auto pivot = static_cast<std::size_t>(evaluator_->pivot());
    const auto jet = evaluator_->jet_over(middle.base, middle.base, at[pivot], at[pivot]);
    if (!jet) return;
    std::array<Jet<Interval>, 2> here;
    here[1 - pivot] = {at[1 - pivot], Interval(1), Interval(0)};
    here[pivot] = {at[pivot], jet->first, jet->second};
    const Placed placed = steps_.place_on(stretch_, at);
    const bool is_by_centre = is_near(placed) || all.is_by_centre;
    const Map_formula formula = placed.patch->map.choose({midpoint(at[0]), midpoint(at[1])});
    const auto c = coefficients(is_by_centre, here, formula), over = coefficients(is_by_centre, jets, formula);
    const Interval half(half_width);
    std::array<Interval, 4> value, slope, value_alone, no_slope;
    for (std::size_t k = 0; k < 4; ++k) {
      const double first = (Interval(0, magnitude(over[k].first)) * half).sup(), second = (Interval(0, magnitude(over[k].second)) * half * half * Interval(0.5)).sup();
      value_alone[k] = c[k].value + within(first);
      value[k] = c[k].value + within(second);
      slope[k] = c[k].first * half;
      no_slope[k] = Interval(0);
    }
    const Circle linear(value, slope), constant(value_alone, no_slope);
    const Circle& better = linear.greatest_error() < constant.greatest_error() ? linear : constant;
    const double error = better.greatest_error();
    if (!std::isfinite(error) || (is_by_centre == all.is_by_centre && error > 2 * all.circle.greatest_error())) return;
    all.circle = better;
    all.is_by_centre = is_by_centre;
  }

  static Interval within(double reach)
  {
    const double r = reach <= std::numeric_limits<double>::max() ? reach : std::numeric_limits<double>::infinity();
    return Interval(-r, r);
  }

  std::array<Jet<Interval>, 4> coefficients(bool is_by_centre, const std::array<Jet<Interval>, 2>& at, Map_formula formula) const
  {
    const Bisector_map_2& map = steps_.patch(stretch_).map;
    const std::array<Jet<Interval>, 2> local = map.chart()(at);
    return is_by_centre ? by_centre(map, local, map.at(at, formula).point) : by_curvature(map, at, local, formula);
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
  std::array<T, 4> by_curvature(const Bisector_map_2& map, const std::array<T, 2>& at, const std::array<T, 2>& local, Map_formula formula) const
  {
    const Curve_evaluator* curve[2] = {&map.first(), &map.second()};
    const bool is_contact = formula == Map_formula::contact && map.has_regular_contact();
    const std::size_t k = !is_contact && contains_zero(value_of(curve[0]->weight(local[0]))) ? 1 : 0;
    const Vector_2<T> foot = curve[k]->point(local[k]), a = curve[k]->tangent(local[k]);
    const T s{Interval(orientation_[k])}, kappa = s * (is_contact ? map.curvature_by_contact(at) : curvature(map, local, k)), nx = -(s * a.y), ny = s * a.x, two{Interval(2)};
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
  std::shared_ptr<const Curve_graph::Cell_form> own_form_; ///< of a part
  std::optional<Piece_evaluator> evaluator_;
  std::array<double, 2> orientation_{1, 1};
};

} // namespace detail
} // namespace locus

#endif
