// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANAR_ARC_H
#define LOCUS_CONSTRUCT_PLANAR_ARC_H

#include <locus/construct/arc_steps.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>

namespace locus {
namespace detail {

/// One arc of a planar bisector, evaluated on the cells of its zero set.
class Planar_arc final : public Arc_geometry<2> {
public:
  Planar_arc(std::shared_ptr<const Planar_solution> solution, std::size_t arc) : s_(solution), steps_(std::move(solution), arc), part_(steps_.whole()) {}
  /// A part of it, whose ends may be `end_error` away from what they stand for, in the inputs' units.
  Planar_arc(std::shared_ptr<const Planar_solution> solution, std::size_t arc, const Arc_part& part, double end_error)
    : s_(solution), steps_(std::move(solution), arc), part_(part), end_error_(end_error)
  {
  }

  Arc_point<2> at(double x) const override
  {
    return with_upward_rounding([&] {
      const std::vector<Stretch>& all = stretches();
      const auto [step, f] = locate(x, all.size());
      return finished(*s_, placed_on(all[step], f, nullptr));
    });
  }

  Arc_differential<2> differential(double x) const override
  {
    return with_upward_rounding([&] { return differential_at(x); });
  }

  std::vector<Arc_point<2>> samples(std::size_t n) const override
  {
    return with_upward_rounding([&] { return spread(std::max<std::size_t>(n, 2)); });
  }

  Polyline<2> polyline(double relative_tolerance) const override
  {
    return with_upward_rounding([&] { return polyline_within(relative_tolerance); });
  }

  Irregular_points<2> irregular() const override
  {
    return with_upward_rounding([&] { return find_irregular(); });
  }

private:
  using Stretch = Arc_stretch;

  const Planar_patch& patch(const Stretch& s) const { return steps_.patch(s); }
  const Graph_vertex& vertex(const Stretch& s, std::size_t v) const { return steps_.vertex(s, v); }
  bool is_pole(const Stretch& s, std::size_t v) const { return steps_.is_pole(s, v); }
  Placed place_vertex(const Stretch& s, std::size_t v) const { return steps_.place_vertex(s, v); }
  Placed place_on(const Stretch& s, const std::array<Interval, 2>& at) const { return steps_.place_on(s, at); }
  static Placed place_beside(const Placed& p, const std::array<Interval, 2>& at) { return place(*p.patch, at, p.between); }
  static std::array<Interval, 2> parameters(const Piece_evaluator& e, double base, double guess, double wanted_width = 5e-13)
  {
    return Arc_steps::parameters(e, base, guess, wanted_width);
  }

  /// The arc's steps, cut on the way from each pole until the arc comes within the cut radius. Never none; found out once.
  const std::vector<Stretch>& stretches() const
  {
    std::call_once(once_, [&] { stretches_ = cut_stretches(); });
    return stretches_;
  }

  std::vector<Stretch> cut_stretches() const
  {
    std::vector<Stretch> all = steps_.stretches(part_), near;
    cut_from_pole(all.begin(), all.end(), false);
    cut_from_pole(all.rbegin(), all.rend(), true);
    std::copy_if(all.begin(), all.end(), std::back_inserter(near), [](const Stretch& s) { return !s.is_beyond; });
    if (near.empty()) near.push_back(single_point(all[all.size() / 2]));
    return near;
  }

  /// A stretch outside the cut radius is left as one point.
  static Stretch single_point(Stretch s)
  {
    s.is_beyond = false;
    if (s.piece->is_half_branch) return s;
    s.lo = s.hi = Interval(0.5 * (s.lo.sup() + s.hi.inf()));
    s.lo_cut = s.hi_cut = true;
    return s;
  }

  template <class Iterator>
  void cut_from_pole(Iterator first, Iterator last, bool backward) const
  {
    if (first == last || (backward ? part_.to : part_.from) || !(first->piece->is_half_branch || is_pole(*first, entrance(*first, backward)))) return;
    const auto end = std::prev(last);
    const bool has_end = (backward ? part_.from : part_.to) || !is_pole(*end, entrance(*end, !backward)); // a finite end is drawn wherever it is
    for (; first != last; ++first)
      if (!cut_at(*first, entrance(*first, backward) == first->piece->from, first != end || !has_end)) return;
  }

  static std::size_t entrance(const Stretch& s, bool backward) { return s.reversed == backward ? s.piece->from : s.piece->to; }

  /// Cuts a stretch where it comes from a pole, or drops it if it may; tells whether all of it lies outside the cut radius.
  bool cut_at(Stretch& s, bool low, bool may_drop) const
  {
    if (s.is_beyond) return true;
    if (s.piece->is_half_branch || !(s.lo.sup() < s.hi.inf())) return s.is_beyond = may_drop && is_cell_outside(s);
    const Piece_evaluator e(*s.form, s.piece->base);
    const auto pivot = static_cast<std::size_t>(e.pivot());
    const std::size_t v = low ? s.piece->from : s.piece->to;
    const Near_end near{low ? s.lo : s.hi, vertex(s, v).at[pivot], is_pole(s, v)};
    const Interval end = low ? s.hi : s.lo, at_end = vertex(s, low ? s.piece->to : s.piece->from).at[pivot];
    const bool is_cut = low ? s.hi_cut : s.lo_cut;
    const double position = low ? end.sup() : end.inf();
    if (may_drop && is_outside(patch(s), e, near, position, is_cut ? e.pivot_at(position, midpoint(at_end)) : at_end)) return s.is_beyond = true;
    (low ? s.lo : s.hi) = Interval(cut_position(patch(s), e, near, 0.5 * (s.lo.sup() + s.hi.inf())));
    (low ? s.lo_cut : s.hi_cut) = true;
    return false;
  }

  /// Where a stretch comes from a pole, or from a stretch that does.
  struct Near_end {
    Interval base, pivot;
    bool is_pole;
  };

  /// A base value near a pole beyond which (towards the pole) the arc provably stays outside the cut radius.
  double cut_position(const Planar_patch& patch, const Piece_evaluator& e, const Near_end& near, double middle) const
  {
    const double edge = middle > near.base.sup() ? near.base.sup() : near.base.inf();
    double position = middle;
    for (int k = 0; k < 50 && position != edge; ++k, position = 0.5 * (position + edge))
      if (is_outside(patch, e, near, position, e.pivot_at(position, midpoint(near.pivot)))) return position;
    return position;
  }

  /// Whether a stretch provably lies outside the cut radius, by its cell alone.
  bool is_cell_outside(const Stretch& s) const
  {
    const Box<2>& box = s.form->box;
    const std::array<Interval, 2> cell{Interval(box.lo[0], box.hi[0]), Interval(box.lo[1], box.hi[1])};
    const Bisector_map_2& map = patch(s).map;
    if (map.least_distance(cell, s_->centre) > s_->cut_radius) return true;
    for (const Contact_place& node : map.nodes())
      if (const Node_direction* cone = node.cone_of(steps_.piece_index(s)))
        if (map.least_distance(node, cell, *cone, s_->centre) > s_->cut_radius) return true;
    return false;
  }

  /// Whether the arc provably stays outside the cut radius from its near end to a base value.
  bool is_outside(const Planar_patch& patch, const Piece_evaluator& e, const Near_end& near, double position, const Interval& there) const
  {
    const bool above = position > near.base.sup();
    const double lo = above ? near.base.inf() : position, hi = above ? position : near.base.sup();
    if (!(lo < hi)) return false;
    const Interval &at_lo = above ? near.pivot : there, &at_hi = above ? there : near.pivot;
    if (is_part_outside(patch.map, e, lo, hi, at_lo, at_hi, 0)) return true;
    const auto jet = e.jet_over(lo, hi, at_lo, at_hi);
    if (!jet || !near.is_pole) return false; // what vanishes at a pole is bounded by its derivative
    std::array<Jet<Interval>, 2> tail;
    tail[static_cast<std::size_t>(e.pivot())] = {jet->value, jet->first, jet->second};
    tail[static_cast<std::size_t>(e.base())] = {Interval(lo, hi), Interval(1), Interval(0)};
    return patch.map.least_distance(tail, hi - lo, s_->centre) > s_->cut_radius;
  }

  /// The same by the parameters' boxes over parts of the stretch.
  bool is_part_outside(const Bisector_map_2& map, const Piece_evaluator& e, double lo, double hi, const Interval& at_lo, const Interval& at_hi, int depth) const
  {
    std::array<Interval, 2> box;
    box[static_cast<std::size_t>(e.base())] = Interval(lo, hi);
    box[static_cast<std::size_t>(e.pivot())] = e.range_over(lo, hi, at_lo, at_hi);
    if (map.least_distance(box, s_->centre) > s_->cut_radius) return true;
    for (const Contact_place& node : map.nodes())
      if (const auto direction = node.direction_to(box))
        if (map.least_distance(node, box, *direction, s_->centre) > s_->cut_radius) return true;
    const double middle = 0.5 * (lo + hi);
    if (depth == 9 || !(lo < middle && middle < hi)) return false;
    const Interval there = e.pivot_at(middle, midpoint(at_lo));
    return is_part_outside(map, e, lo, middle, at_lo, there, depth + 1) && is_part_outside(map, e, middle, hi, there, at_hi, depth + 1);
  }

  // ------------------------------------------------------------------------------------------ single points

  /// Which of n stretches, and where on it.
  static std::pair<std::size_t, double> locate(double x, std::size_t n)
  {
    const double y = std::min(1.0, std::max(0.0, x)) * static_cast<double>(n);
    const std::size_t step = std::min(n - 1, static_cast<std::size_t>(y));
    return {step, y - static_cast<double>(step)};
  }

  /// Where the dependent parameter may be next on the way along an arc: extrapolated from the last two points.
  struct Guess {
    double last = -1, before = -1;

    double next() const { return before < 0 ? last : last + (last - before); }
    void add(double value)
    {
      before = last;
      last = value;
    }
  };

  /// The point at fraction f along the arc's direction; `guess`, if given, starts the search and is updated.
  Placed placed_on(const Stretch& s, double f, Guess* guess, const Piece_evaluator* evaluator = nullptr) const
  {
    const double g = s.reversed ? 1 - f : f;
    if (s.piece->is_half_branch && g < 1) return on_half_branch(s, g);
    if (g <= 0 && !s.lo_cut) return place_vertex(s, s.piece->from);
    if (g >= 1 && !s.hi_cut) return place_vertex(s, s.piece->to);
    if (evaluator) return placed_between(s, *evaluator, g, guess);
    return placed_between(s, Piece_evaluator(*s.form, s.piece->base), g, guess);
  }

  Placed placed_between(const Stretch& s, const Piece_evaluator& e, double g, Guess* guess) const
  {
    double base = s.lo.sup() + g * (s.hi.inf() - s.lo.sup());
    base = std::min(s.hi.inf(), std::max(s.lo.sup(), base));
    const auto pivot = static_cast<std::size_t>(e.pivot());
    const double start = guess && guess->last >= 0 ? guess->next()
                         : midpoint(vertex(s, s.piece->from).at[pivot]) * (1 - g) + midpoint(vertex(s, s.piece->to).at[pivot]) * g;
    const auto at = parameters(e, base, start);
    if (guess) guess->add(midpoint(at[pivot]));
    return place_on(s, at);
  }

  /// Inside a node's cell, no wider than `Solve_control::node_width`, the branch is only enclosed: by the whole cell, or in its
  /// cone. Where the curves touch the branches' images are different at the node, and only the cone tells.
  Placed on_half_branch(const Stretch& s, double g) const
  {
    const bool has_cone = is_in_cone(s);
    if (g <= 0 && !has_cone) return place_vertex(s, s.piece->from);
    Placed p = place_vertex(s, g < 0.5 ? s.piece->from : s.piece->to);
    const Placed all = steps_.over_half_branch(s, p);
    p.point = has_cone ? all.point : Vector_2<Interval>{hull(p.point.x, all.point.x), hull(p.point.y, all.point.y)};
    if (has_cone) p.radius = all.radius;
    if (g > 0) p.at = all.at;
    return p;
  }

  bool is_in_cone(const Stretch& s) const
  {
    const auto& nodes = patch(s).map.nodes();
    return std::any_of(nodes.begin(), nodes.end(), [&](const Contact_place& node) { return node.cone_of(steps_.piece_index(s)) != nullptr; });
  }

  std::vector<Arc_point<2>> spread(std::size_t n) const
  {
    const std::vector<Stretch>& all = stretches();
    std::vector<double> end{0};
    for (const Stretch& s : all) {
      const double length = s.piece->is_half_branch ? 0.0 : std::max(0.0, s.hi.sup() - s.lo.inf());
      end.push_back(end.back() + length);
    }
    std::vector<Arc_point<2>> points;
    points.reserve(n);
    std::size_t k = 0;
    Guess guess;
    std::optional<Piece_evaluator> evaluator;
    const auto evaluator_of = [&](const Stretch& s) { return evaluator.emplace(*s.form, s.piece->base), &*evaluator; };
    const Piece_evaluator* current = evaluator_of(all[0]);
    for (std::size_t i = 0; i < n; ++i) {
      const double x = end.back() * static_cast<double>(i) / static_cast<double>(n - 1);
      while (k + 1 < all.size() && x > end[k + 1]) {
        ++k;
        guess = Guess();
        current = evaluator_of(all[k]);
      }
      const double length = end[k + 1] - end[k];
      double f = length > 0 ? std::min(1.0, (x - end[k]) / length) : 0.0;
      if (i + 1 == n) {
        k = all.size() - 1;
        f = 1;
        current = evaluator_of(all[k]);
      }
      points.push_back(finished(*s_, placed_on(all[k], i == 0 ? 0.0 : f, &guess, current)));
    }
    return points;
  }

  // ----------------------------------------------------------------------------------------------- polyline

  /// A node of the polyline on one piece: base value (enclosed), parameters, point.
  struct Knot {
    Interval base;
    Placed placed;
  };

  /// Jets of both parameters by the base variable over [a.base, b.base].
  std::optional<std::array<Jet<Interval>, 2>> parameter_jets(const Piece_evaluator& e, const Knot& a, const Knot& b) const
  {
    const auto pivot = static_cast<std::size_t>(e.pivot()), base = static_cast<std::size_t>(e.base());
    const double s0 = a.base.inf(), s1 = b.base.sup();
    const auto jet = e.jet_over(s0, s1, a.placed.at[pivot], b.placed.at[pivot]);
    if (!jet) return std::nullopt;
    std::array<Jet<Interval>, 2> result;
    result[base] = {Interval(s0, s1), Interval(1), Interval(0)};
    result[pivot] = {jet->value, jet->first, jet->second};
    return result;
  }

  /// Proved bound of the distance, both ways, between the arc from a to b and its chord (the knots' own errors apart):
  /// h²/8 times the greatest second derivative, comparing equal base values. Where the arc provably advances along the
  /// chord, its projection covers the chord, and the component across the chord is enough. Infinite where nothing is
  /// proved.
  double chord_error(const Piece_evaluator& e, const Knot& a, const Knot& b) const
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const auto jets = parameter_jets(e, a, b);
    if (!jets) return infinite;
    if (width(jets->at(0).value) > 0.25 || width(jets->at(1).value) > 0.25) return infinite;
    const Bisector_map_2& map = a.placed.patch->map;
    const auto image = map.at(*jets, map.choose({midpoint((*jets)[0].value), midpoint((*jets)[1].value)}));
    double bend = std::hypot(magnitude(image.point.x.second), magnitude(image.point.y.second));
    const Vector_2<Interval> first{image.point.x.first, image.point.y.first}, second{image.point.x.second, image.point.y.second};
    const Vector_2<double> step{midpoint(b.placed.point.x) - midpoint(a.placed.point.x), midpoint(b.placed.point.y) - midpoint(a.placed.point.y)};
    if (const double length = std::hypot(step.x, step.y); length > 0 && std::isfinite(bend)) {
      const Vector_2<Interval> along{Interval(step.x / length), Interval(step.y / length)};
      // `along` is of unit length up to roundings, which the factor below covers.
      if (is_strict(sign_of(dot(along, first)))) bend = std::min(bend, magnitude(cross(along, second)) * (1 + 16 * operation_error));
    }
    const double h = b.base.sup() - a.base.inf();
    const double bound = bend * h * h * 0.125 * (1 + 16 * operation_error);
    return std::isfinite(bound) ? bound : infinite;
  }

  /// Diameter of an enclosure of the arc between two knots and of the knots.
  double enclosing_diameter(const Piece_evaluator& e, const Knot& a, const Knot& b) const
  {
    const auto pivot = static_cast<std::size_t>(e.pivot()), base = static_cast<std::size_t>(e.base());
    std::array<Interval, 2> at;
    at[base] = hull(a.base, b.base);
    at[pivot] = e.range_over(a.base.inf(), b.base.sup(), a.placed.at[pivot], b.placed.at[pivot]);
    const Vector_2<Interval> all = place_beside(a.placed, at).point;
    const double d = diameter({hull(hull(all.x, a.placed.point.x), b.placed.point.x), hull(hull(all.y, a.placed.point.y), b.placed.point.y)});
    return std::isfinite(d) ? d : std::numeric_limits<double>::infinity();
  }

  /// Beyond this many points a polyline stops refining and reports the error it has reached.
  static constexpr std::size_t max_points = 1u << 20;

  struct Draft {
    std::vector<Placed> points;
    double bend = 0;
    double tolerance = 0;
    double parameter_width = 0; ///< wanted of the knots: they need not be finer than the polyline
  };

  /// Halvings of a stretch without any proved bound before its polynomial is restricted to it.
  static constexpr int local_depth = 4;

  void draw_between(const Piece_evaluator& e, const Knot& a, const Knot& b, int depth, Draft& draft, bool reversed) const
  {
    const double error = chord_error(e, a, b);
    const double h = b.base.inf() - a.base.sup();
    if (error <= draft.tolerance || depth >= 20 || !(h > 0x1p-46) || draft.points.size() > max_points) {
      draft.bend = std::max(draft.bend, error);
      draft.points.push_back(reversed ? a.placed : b.placed);
      return;
    }
    if (!std::isfinite(error) && depth == local_depth) { // the cell's bounds are too coarse for this part of it
      const auto pivot = static_cast<std::size_t>(e.pivot());
      const Curve_graph::Cell_form part = e.restricted_form(a.base.inf(), b.base.sup(), a.placed.at[pivot], b.placed.at[pivot]);
      return draw_between(Piece_evaluator(part, e.base()), a, b, depth + 1, draft, reversed);
    }
    if (!std::isfinite(error)) { // no bend is proved here: enclose the stretch as a whole
      if (const double whole = enclosing_diameter(e, a, b); whole <= draft.tolerance || (depth >= 8 && std::isfinite(whole))) {
        draft.bend = std::max(draft.bend, whole);
        draft.points.push_back(reversed ? a.placed : b.placed);
        return;
      }
    }
    const double wanted = std::isfinite(error) ? std::ceil(1.1 * std::sqrt(error / draft.tolerance)) : 4.0;
    const int parts = static_cast<int>(std::min(16.0, std::max(2.0, wanted)));
    const auto pivot = static_cast<std::size_t>(e.pivot());
    std::vector<Knot> knots{a};
    for (int k = 1; k < parts; ++k) {
      const double base = a.base.sup() + h * k / parts;
      knots.push_back({Interval(base), place_beside(a.placed, parameters(e, base, midpoint(knots.back().placed.at[pivot]), draft.parameter_width))});
    }
    knots.push_back(b);
    for (int k = 0; k < parts; ++k) {
      const auto i = static_cast<std::size_t>(reversed ? parts - 1 - k : k);
      draw_between(e, knots[i], knots[i + 1], depth + 1, draft, reversed);
    }
  }

  Knot knot_at(const Stretch& s, const Piece_evaluator& e, bool high) const
  {
    const bool cut = high ? s.hi_cut : s.lo_cut;
    const Interval& base = high ? s.hi : s.lo;
    if (!cut) return {base, place_vertex(s, high ? s.piece->to : s.piece->from)};
    const auto pivot = static_cast<std::size_t>(e.pivot());
    const double guess = midpoint(vertex(s, high ? s.piece->to : s.piece->from).at[pivot]);
    return {base, place_on(s, parameters(e, base.inf(), guess))};
  }

  Polyline<2> polyline_within(double relative_tolerance) const
  {
    Draft draft;
    draft.tolerance = std::max(relative_tolerance, 0x1p-60) * s_->scale;
    draft.parameter_width = std::max(5e-13, 1e-3 * std::min(relative_tolerance, 1e-3));
    for (const Stretch& s : stretches()) {
      if (s.piece->is_half_branch) {
        const Placed whole = on_half_branch(s, 0.25);
        draft.bend = std::max(draft.bend, diameter(whole.point));
        const Placed ends[2] = {on_half_branch(s, 0), place_vertex(s, s.piece->to)};
        if (draft.points.empty()) draft.points.push_back(ends[s.reversed ? 1 : 0]);
        draft.points.push_back(ends[s.reversed ? 0 : 1]);
        continue;
      }
      const Piece_evaluator e(*s.form, s.piece->base);
      const Knot a = knot_at(s, e, false), b = knot_at(s, e, true);
      if (draft.points.empty()) draft.points.push_back(s.reversed ? b.placed : a.placed);
      draw_between(e, a, b, 0, draft, s.reversed);
    }
    std::vector<Arc_point<2>> points;
    points.reserve(draft.points.size());
    double rounding = 0;
    for (const Placed& p : draft.points) {
      points.push_back(finished(*s_, p));
      rounding = std::max(rounding, points.back().error());
    }
    const double bend = s_->frame.length(Interval(0, draft.bend)).sup();
    return {std::move(points), bend + rounding + end_error_};
  }

  // ---------------------------------------------------------------------------------- differential geometry

  Arc_differential<2> differential_at(double x) const
  {
    const std::vector<Stretch>& all = stretches();
    const auto [step, f] = locate(x, all.size());
    Stretch s = all[step];
    for (std::size_t k = step; s.piece->is_half_branch && k-- > 0;) s = all[k];
    for (std::size_t k = step; s.piece->is_half_branch && ++k < all.size();) s = all[k];
    if (s.piece->is_half_branch) throw std::logic_error("locus: an arc inside one node's cell has no certified tangent");
    const Piece_evaluator e(*s.form, s.piece->base);
    const double g = std::min(1 - 1e-9, std::max(1e-9, s.reversed ? 1 - f : f));
    const double base = s.lo.sup() + g * (s.hi.inf() - s.lo.sup());
    const auto pivot = static_cast<std::size_t>(e.pivot());
    const Knot k{Interval(base), place_on(s, parameters(e, base, midpoint(vertex(s, s.piece->from).at[pivot])))};
    const auto jets = parameter_jets(e, k, k);
    if (!jets) throw std::logic_error("locus: a graph cell without slope");
    const Bisector_map_2& map = patch(s).map;
    const auto image = map.at(*jets, map.choose({midpoint(k.placed.at[0]), midpoint(k.placed.at[1])}));
    const Vector_2<double> d{midpoint(image.point.x.first), midpoint(image.point.y.first)};
    const Vector_2<double> dd{midpoint(image.point.x.second), midpoint(image.point.y.second)};
    const double speed = std::sqrt(dot(d, d)), sign = s.reversed ? -1 : 1;
    Arc_differential<2> result;
    result.tangent[0] = sign * d.x / speed;
    result.tangent[1] = sign * d.y / speed;
    result.curvature = std::ldexp(sign * cross(d, dd) / (speed * speed * speed), static_cast<int>(-s_->frame.exponent));
    return result;
  }

  /// Zeros of an input's parameter's derivative along each piece: there that foot stands still. Pieces are halved until
  /// the derivative has one sign, or changes it where its own derivative has one. What stays open after a fixed number of
  /// steps is said to be open.
  Irregular_points<2> find_irregular() const
  {
    Irregular_points<2> all;
    for (const Stretch& s : stretches()) {
      if (s.piece->is_half_branch) continue;
      const Piece_evaluator e(*s.form, s.piece->base);
      const bool plain = patch(s).map.chart().is_plain();
      if (plain && e.has_strict_base_slope()) continue;
      Irregular_search search{{}, max_irregular_steps, 0};
      for (search.input = 0; search.input < 2; ++search.input)
        if (!plain || search.input == static_cast<std::size_t>(e.pivot())) search_irregular(e, knot_at(s, e, false), knot_at(s, e, true), search);
      std::sort(search.found.begin(), search.found.end(), [&](const Found& a, const Found& b) { return (a.base < b.base) != s.reversed; });
      for (Found& f : search.found) all.points.push_back(std::move(f.point));
      all.complete = all.complete && search.steps_left > 0;
    }
    return all;
  }

  static constexpr int max_irregular_steps = 4000;

  struct Found {
    double base;
    Arc_point<2> point;
  };

  struct Irregular_search {
    std::vector<Found> found;
    int steps_left;
    std::size_t input; ///< whose parameter's turns are looked for
  };

  /// First and second derivative of an input's parameter by the base variable over [a.base, b.base].
  std::optional<Jet<Interval>> input_jet(const Piece_evaluator& e, const Knot& a, const Knot& b, std::size_t input) const
  {
    const auto jets = parameter_jets(e, a, b);
    if (!jets) return std::nullopt;
    return a.placed.patch->map.chart()(*jets)[input];
  }

  void search_irregular(const Piece_evaluator& e, const Knot& a, const Knot& b, Irregular_search& search) const
  {
    const auto jet = input_jet(e, a, b, search.input);
    if (jet && !contains_zero(jet->first)) return;
    const double h = b.base.inf() - a.base.sup();
    if (--search.steps_left <= 0 || !(h > 0x1p-50)) {
      search.steps_left = 0;
      return;
    }
    if (jet && !contains_zero(jet->second)) return bisect_irregular(e, a, b, search);
    const Knot m = middle_knot(e, a, b, 1e-10);
    search_irregular(e, a, m, search);
    search_irregular(e, m, b, search);
  }

  Knot middle_knot(const Piece_evaluator& e, const Knot& a, const Knot& b, double wanted_width) const
  {
    const double base = a.base.sup() + 0.5 * (b.base.inf() - a.base.sup());
    return {Interval(base), place_beside(a.placed, parameters(e, base, midpoint(a.placed.at[static_cast<std::size_t>(e.pivot())]), wanted_width))};
  }

  /// The derivative is monotone from a to b: one zero or none, by the signs at the ends.
  void bisect_irregular(const Piece_evaluator& e, Knot a, Knot b, Irregular_search& search) const
  {
    const Sign at_a = slope_sign(e, a, search.input), at_b = slope_sign(e, b, search.input);
    if (is_strict(at_a) && at_a == at_b) return;
    const auto note = [&](const Knot& k) { search.found.push_back({k.base.inf(), finished(*s_, k.placed)}); };
    // A turn on a piece's end: the neighbour finds it too, or it is a boundary point.
    if (!is_strict(at_a) || !is_strict(at_b)) return note(is_strict(at_a) ? b : a);
    for (;;) {
      const double h = b.base.inf() - a.base.sup();
      const Knot m = middle_knot(e, a, b, 5e-13);
      const Sign at_m = slope_sign(e, m, search.input);
      if (!(h > 1e-13) || !is_strict(at_m)) return note(m);
      (at_m == at_a ? a : b) = m;
    }
  }

  Sign slope_sign(const Piece_evaluator& e, const Knot& k, std::size_t input) const
  {
    const auto jet = input_jet(e, k, k, input);
    return jet ? sign_of(jet->first) : Sign::unknown;
  }

  std::shared_ptr<const Planar_solution> s_;
  Arc_steps steps_;
  Arc_part part_;
  double end_error_ = 0;
  mutable std::once_flag once_;
  mutable std::vector<Stretch> stretches_;
};

} // namespace detail
} // namespace locus

#endif
