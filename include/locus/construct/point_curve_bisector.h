// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_POINT_CURVE_BISECTOR_H
#define LOCUS_CONSTRUCT_POINT_CURVE_BISECTOR_H

#include <locus/construct/cell_boundary.h>
#include <locus/construct/cell_contacts.h>
#include <locus/construct/path_ends.h>
#include <locus/construct/point_curve_map.h>
#include <locus/construct/seen_curve.h>

#include <chrono>

namespace locus {

struct Point_bisector_options {
  Solve_control control;
  bool keep_rational = false;  ///< keep the exact untrimmed curve in the result, with its events
  /// Reading (70) of Farouki & Johnstone 1994 instead of (71): the nearest point of the curve's continuation over the whole line
  /// must lie on the curve itself. For one Bézier piece or a curve in monomial form.
  bool beyond_ends = false;
  double least_cut_radius = 0; ///< arcs to infinity are drawn at least so far from the inputs' middle
};

namespace detail {

/// Makes a locus of a cell's boundary.
class Point_bisector_maker {
public:
  /// `own`: the point as a foot, an input itself or an end or a corner of one; `inputs`: the seen curves' numbers.
  Point_bisector_maker(const Seen_curve& seen, const Point_cell& cell, Foot own, std::vector<std::size_t> inputs, const Point_bisector_options& options)
    : seen_(seen), cell_(cell), own_(std::move(own)), inputs_(std::move(inputs)), work_(std::make_shared<Path_work<2>>())
  {
    work_->frame = seen.frame();
    work_->scale = seen.extent().scale;
    work_->cut_radius = std::max(cut_factor * work_->scale, std::ldexp(options.least_cut_radius, static_cast<int>(-seen.frame().exponent)));
    work_->centre = seen.extent().centre;
  }

  Locus_data<2> make()
  {
    data_.compute = "bisector";
    data_.trimmed = true;
    data_.scale = work_->frame.length(Interval(work_->scale)).sup();
    data_.cut_radius = work_->frame.length(Interval(work_->cut_radius)).sup();
    for (std::size_t k = 0; k < 2; ++k) data_.centre[k] = midpoint(work_->frame.out_of(Interval(work_->centre[k]), k));
    for (const auto& u : cell_.undecided()) note_undecided(u);
    if (cell_.stretches().empty()) {
      if (cell_.undecided().empty()) add_point_alone();
      return std::move(data_);
    }
    const Cell_boundary boundary(cell_);
    for (const Cell_stretch& s : cell_.stretches()) add_work(s);
    make_vertices(boundary);
    make_arcs(boundary);
    if (seen_.is_on_curve() && !seen_.is_on_smooth_place()) {
      Region region;
      for (std::size_t i = 0; i < data_.arcs.size(); ++i) region.arcs.push_back(i);
      region.reason = "the point is an end or a corner of the curve: all points to which it is the nearest one are equidistant";
      data_.regions.push_back(std::move(region));
    }
    return std::move(data_);
  }

  /// The arcs alone, each for itself, of a cell of which not all features are known.
  Locus_data<2> make_arcs_alone()
  {
    for (const auto& u : cell_.undecided()) note_undecided(u);
    const auto& stretches = cell_.stretches();
    for (const Cell_stretch& s : stretches) add_work(s);
    ends_.resize(stretches.size());
    for (std::size_t a = 0; a < stretches.size(); ++a)
      for (std::size_t b = 0; b < stretches.size(); ++b)
        if (ends_[a].next == none && !ends_[b].has_previous && is_one_arc(stretches[a], 1, stretches[b], 0)) {
          ends_[a].next = b;
          ends_[b].has_previous = true;
        }
    for (std::size_t a = 0; a < stretches.size(); ++a) {
      if (!ends_[a].has_previous) ends_[a].vertex[0] = add_loose_vertex(a, 0);
      if (ends_[a].next == none) ends_[a].vertex[1] = add_loose_vertex(a, 1);
    }
    std::vector<char> done(stretches.size(), 0);
    for (const bool closed : {false, true})
      for (std::size_t first = 0; first < stretches.size(); ++first)
        if (!done[first] && (closed || !ends_[first].has_previous)) make_arc(chain_from(first, done), closed);
    return std::move(data_);
  }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  const Cell_feature& feature_of(const Cell_stretch& s) const { return cell_.features()[s.feature]; }

  // ----------------------------------------------------------------------------------------------------- evaluation

  /// The stretch's curve: p + q, with its feet's distances measured from p, which is as far.
  void add_work(const Cell_stretch& s)
  {
    const Cell_feature& feature = feature_of(s);
    Path_work<2>::Piece_work w;
    const Enclosed_vector& enclosed_tangent = feature.tangent_tree->node(0).f;
    std::array<Bernstein<Interval, 1>, 2> numerator, foot;
    w.weight = enclosed_tangent.interval_form(2);
    for (std::size_t k = 0; k < 2; ++k) {
      const Interval p = enclosing(seen_.point()[k]);
      numerator[k] = subtract(multiply(w.weight, p), enclosed_tangent.interval_form(k));
      w.numerator[k] = subtract(numerator[k], multiply(w.weight, Interval(work_->centre[k])));
      foot[k] = Bernstein<Interval, 1>(Degrees<1>{0}, {p});
    }
    w.image.emplace(numerator, w.weight);
    w.foot.emplace(foot, Bernstein<Interval, 1>(Degrees<1>{0}, {Interval(1)}));
    w.forms = Lazy<Curve_piece<2>>::from([tangent = feature.tangent_tree->lazy_exact(), p = seen_.point()] { return image_of(tangent.get(), p); });
    w.foot_forms = Lazy<Curve_piece<2>>::from([p = seen_.point()] { return constant(p); });
    w.range = feature.kind == Cell_feature::Kind::arc ? seen_.range_of(feature.piece)
                                                      : Parameter_range::constant(seen_.range_of(feature.piece).at(Interval(feature.end)));
    if (!own_.parameters.empty()) {
      w.fixed = own_.parameters[0];
      w.is_fixed_first = is_own_first(s);
    }
    work_->pieces.push_back(std::move(w));
  }

  std::size_t input_of(const Cell_stretch& s) const { return inputs_[seen_.input_of(feature_of(s).piece)]; }

  /// Feet are listed by inputs; two on one input with the greater parameter first.
  bool is_own_first(const Cell_stretch& s) const
  {
    if (own_.input != input_of(s)) return own_.input < input_of(s);
    const Cell_feature& feature = feature_of(s);
    const Range other = seen_.range_of(feature.piece).at(Interval(feature.kind == Cell_feature::Kind::arc ? s.inside : feature.end));
    return own_.parameters[0].lo > other.lo;
  }

  static Curve_piece<2> image_of(const Vector_form& tangent, const Exact_point<2>& point)
  {
    Curve_piece<2> piece;
    for (std::size_t k = 0; k < 2; ++k) piece.numerator[k] = subtract(multiply(tangent[2], point[k]), tangent[k]);
    piece.weight = tangent[2];
    return with_unit_forms(std::move(piece));
  }

  static Curve_piece<2> constant(const Exact_point<2>& point)
  {
    const auto of_degree_0 = [](const Rational& x) { return Bernstein<Rational, 1>(Degrees<1>{0}, {x}); };
    return {{of_degree_0(point[0]), of_degree_0(point[1])}, of_degree_0(Rational(1))};
  }

  static Interval enclosure(const Feasible_end& end) { return Interval(end.lo, end.hi); }

  Foot foot_at(const Cell_stretch& s, const Feasible_end& end) const
  {
    const Cell_feature& feature = feature_of(s);
    Foot foot;
    foot.input = input_of(s);
    const bool at_end = feature.kind != Cell_feature::Kind::arc || end.is_exact();
    const int side = feature.kind != Cell_feature::Kind::arc ? feature.end : end.lo == 0 ? 0 : 1;
    if (at_end && (feature.kind != Cell_feature::Kind::arc || end.lo == 0 || end.lo == 1)) {
      foot.feature = seen_.feature_at(feature.piece, side);
      foot.parameters = {seen_.range_of(feature.piece).at(Interval(side))};
    } else {
      foot.parameters = {seen_.range_of(feature.piece).at(enclosure(end))};
    }
    return foot;
  }

  // -------------------------------------------------------------------------------------------------------- vertices

  struct Stretch_ends {
    std::array<std::size_t, 2> vertex{none, none};
    std::size_t next = none; ///< the stretch with which it makes one arc, counterclockwise
    bool has_previous = false;
  };

  void make_vertices(const Cell_boundary& boundary)
  {
    ends_.resize(boundary.size());
    const auto& stretches = cell_.stretches();
    bounded_ = cell_.undecided().empty();
    for (std::size_t k = 0; k < boundary.size(); ++k) {
      const std::size_t a = boundary[k], b = boundary[k + 1], last = boundary.last_end(a), first = boundary.first_end(b);
      // The two sides of a normal line are not seen from between them.
      const bool is_line = feature_of(stretches[a]).kind == Cell_feature::Kind::normal;
      const bool goes_on = boundary.goes_on(k) && cell_.undecided().empty() && !is_line;
      bounded_ = bounded_ && (is_line ? !stretches[a].infinite[0] && !stretches[a].infinite[1] : goes_on);
      if (!is_own(a) && !is_own(b)) continue;
      if (goes_on && is_own(a) != is_own(b)) {
        const std::size_t v = add_vertex(a, last, b, first);
        (is_own(a) ? ends_[a].vertex[last] : ends_[b].vertex[first]) = v;
        const Feasible_end& end = is_own(a) ? stretches[a].ends[last] : stretches[b].ends[first];
        if (end.is_exact() && (end.lo == 0 || end.lo == 1)) make_boundary(v);
      } else if (goes_on && is_one_arc(stretches[a], last, stretches[b], first)) {
        ends_[a].next = b;
        ends_[b].has_previous = true;
      } else if (goes_on) {
        ends_[a].vertex[last] = ends_[b].vertex[first] = add_vertex(a, last, b, first);
      } else {
        if (is_own(a)) ends_[a].vertex[last] = add_loose_vertex(a, last);
        if (is_own(b)) ends_[b].vertex[first] = add_loose_vertex(b, first);
      }
    }
  }

  bool is_own(std::size_t stretch) const { return seen_.is_own(feature_of(cell_.stretches()[stretch]).piece); }

  /// The curve's own end: beyond it another foot of the same place would only repeat it.
  void make_boundary(std::size_t vertex)
  {
    Locus_vertex<2>& v = data_.vertices[vertex];
    v.kind = Vertex_kind::boundary;
    std::vector<Foot> feet;
    for (Foot& f : v.feet)
      if (f.feature != Feature::interior) feet.push_back(std::move(f));
    v.feet = std::move(feet);
  }

  /// Where an arc passes a joint at which the curve's tangent does not turn.
  bool is_one_arc(const Cell_stretch& a, std::size_t last, const Cell_stretch& b, std::size_t first) const
  {
    const Cell_feature &f = feature_of(a), &g = feature_of(b);
    if (f.kind != Cell_feature::Kind::arc || g.kind != Cell_feature::Kind::arc) return false;
    const Feasible_end &x = a.ends[last], &y = b.ends[first];
    const double side = static_cast<double>(last);
    if (!(x.is_exact() && x.lo == side && y.is_exact() && y.lo == 1 - side)) return false;
    return seen_.goes_on_smoothly(f.piece, static_cast<int>(last), g.piece) || has_one_tangent(f, last, g, first);
  }

  /// Whether two features meet in one point of the curve with one tangent, though not as neighbours: a path that is traced again, or
  /// a cusp at the point itself.
  static bool has_one_tangent(const Cell_feature& f, std::size_t last, const Cell_feature& g, std::size_t first)
  {
    const auto at = [](const Vector_form& t, std::size_t end) {
      return std::array<Rational, 3>{t[0][end ? t[0].size() - 1 : 0], t[1][end ? t[1].size() - 1 : 0], t[2][end ? t[2].size() - 1 : 0]};
    };
    return is_one_ray(at(f.tangent(), last), at(g.tangent(), first)) && is_one_ray(at(f.lift->exact(), last), at(g.lift->exact(), first));
  }

  static bool is_one_ray(const std::array<Rational, 3>& a, const std::array<Rational, 3>& b)
  {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < k; ++l)
        if (a[k] * b[l] != a[l] * b[k]) return false;
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0;
  }

  std::size_t add_vertex(std::size_t a, std::size_t last, std::size_t b, std::size_t first)
  {
    const auto& stretches = cell_.stretches();
    Locus_vertex<2> v = finite_vertex(a, stretches[a].ends[last]);
    v.feet.push_back(foot_at(stretches[a], stretches[a].ends[last]));
    add_foot(v, foot_at(stretches[b], stretches[b].ends[first]));
    // More than two are found from an end that is no end of a feature.
    const bool from_b = stretches[a].ends[last].is_exact();
    if (v.feet.size() > 1) add_contacts(v, from_b ? b : a, from_b ? first : last);
    return finished(std::move(v));
  }

  void add_contacts(Locus_vertex<2>& v, std::size_t stretch, std::size_t e)
  {
    const Cell_stretch& s = cell_.stretches()[stretch];
    const auto is_known = [&](const Cell_contact& c) {
      const Range range = seen_.range_of(c.piece).at(Interval(c.lo, c.hi));
      return std::any_of(v.feet.begin(), v.feet.end(), [&](const Foot& f) { return f.input == input_of(c) && may_be_one_place(f, range); });
    };
    for (const Cell_contact& c : Contact_finder(feature_of(s), filter_).at(s.ends[e], static_cast<int>(e), is_known)) {
      Foot foot;
      foot.input = input_of(c);
      foot.parameters = {seen_.range_of(c.piece).at(Interval(c.lo, c.hi))};
      if (c.lo == c.hi && (c.lo == 0 || c.lo == 1)) foot.feature = seen_.feature_at(c.piece, c.lo == 0 ? 0 : 1);
      add_foot(v, std::move(foot));
    }
  }

  std::size_t input_of(const Cell_contact& c) const { return inputs_[seen_.input_of(c.piece)]; }
  bool may_be_one_place(const Foot& foot, const Range& range) const
  {
    const auto seen_input = static_cast<std::size_t>(std::find(inputs_.begin(), inputs_.end(), foot.input) - inputs_.begin());
    return seen_.may_be_one_place(seen_input, foot.parameters[0], range);
  }

  /// Unless one at the same place is there.
  void add_foot(Locus_vertex<2>& v, Foot foot) const
  {
    const auto meets = [&](const Foot& other) { return foot.input == other.input && may_be_one_place(foot, other.parameters[0]); };
    if (std::none_of(v.feet.begin(), v.feet.end(), meets)) v.feet.push_back(std::move(foot));
  }

  std::size_t finished(Locus_vertex<2> v)
  {
    v.feet.push_back(own_);
    std::stable_sort(v.feet.begin(), v.feet.end(), [](const Foot& x, const Foot& y) { return x.input < y.input; });
    data_.vertices.push_back(std::move(v));
    return data_.vertices.size() - 1;
  }

  Locus_vertex<2> finite_vertex(std::size_t stretch, const Feasible_end& end) const
  {
    Locus_vertex<2> v;
    v.kind = Vertex_kind::trim;
    const Arc_point<2> p = work_->at(stretch, Interval(end.lo + 0.5 * (end.hi - end.lo)));
    v.point = p.point();
    v.radius = p.radius();
    v.error = end.is_exact() ? p.error() : p.error() + spread_at(stretch, end);
    return v;
  }

  /// An end at infinity; or one beside which something is undecided.
  std::size_t add_loose_vertex(std::size_t stretch, std::size_t e)
  {
    const Cell_stretch& s = cell_.stretches()[stretch];
    Locus_vertex<2> v;
    if (s.infinite[e]) { // (X : Y : 0) points outwards, since the weight is positive on the stretch
      v = Path_ends<2>(*work_).infinite_vertex(work_->pieces[stretch].forms.get(), pole_at(stretch, s.ends[e]));
    } else {
      v = finite_vertex(stretch, s.ends[e]);
      if (!cell_.undecided().empty()) v.kind = Vertex_kind::undecided;
    }
    v.feet.push_back(foot_at(s, s.ends[e]));
    // A normal line ends where another foot is as near as the point itself: there is no stretch beyond.
    const bool is_own_end = s.ends[e].is_exact() && (s.ends[e].lo == 0 || s.ends[e].lo == 1);
    if (v.kind == Vertex_kind::trim && !is_own_end) add_contacts(v, stretch, e);
    return finished(std::move(v));
  }

  /// The weight's zero at an end.
  Isolated_root<Rational> pole_at(std::size_t stretch, const Feasible_end& end) const
  {
    const Bernstein<Rational, 1>& weight = work_->pieces[stretch].forms.get().weight;
    Isolated_root<Rational> root{Rational(end.lo), Rational(end.hi), 1, nullptr};
    if (end.is_exact()) {
      Bernstein<Rational, 1> slope = derivative(weight);
      for (; slope.degree() > 0 && evaluate_at(slope, root.lo) == 0; slope = derivative(slope)) ++root.multiplicity;
      return root;
    }
    auto set = exact_roots(Bernstein<Scaled_integer, 1>(restrict_to(weight, 0, root.lo, root.hi)), Rational(0), Rational(1));
    for (auto& found : set.roots) {
      root.multiplicity = found.multiplicity;
      refine_root(found, 100);
      const Rational length = root.hi - root.lo;
      root = {Rational(root.lo + found.lo * length), Rational(root.lo + found.hi * length), found.multiplicity, nullptr};
      break;
    }
    return root;
  }

  // ------------------------------------------------------------------------------------------------------------ arcs

  void make_arcs(const Cell_boundary& boundary)
  {
    std::vector<char> done(boundary.size(), 0);
    Cell_outline outline;
    outline.input = own_.input;
    outline.bounded = bounded_;
    for (const bool closed : {false, true})
      for (std::size_t k = 0; k < boundary.size(); ++k) {
        const std::size_t first = boundary[k];
        if (done[first] || !is_own(first) || (!closed && ends_[first].has_previous)) continue;
        std::vector<std::size_t> chain = chain_from(first, done);
        const bool reversed = !cell_.stretches()[first].counterclockwise;
        if (reversed) std::reverse(chain.begin(), chain.end());
        outline.arcs.push_back(data_.arcs.size());
        outline.reversed.push_back(reversed);
        make_arc(chain, closed);
      }
    if (!seen_.is_beyond_ends()) data_.outline = std::move(outline);
  }

  /// The stretches of one arc.
  std::vector<std::size_t> chain_from(std::size_t first, std::vector<char>& done) const
  {
    std::vector<std::size_t> chain;
    for (std::size_t s = first; s != none && !done[s]; s = ends_[s].next) {
      done[s] = 1;
      chain.push_back(s);
    }
    return chain;
  }

  /// Stretches in the order of the parameter.
  void make_arc(const std::vector<std::size_t>& chain, bool closed)
  {
    std::vector<Path_leg> legs;
    double end_error = 0;
    for (const std::size_t s : chain) {
      const Cell_stretch& stretch = cell_.stretches()[s];
      Path_leg leg{s, stretch.ends[0].hi, stretch.ends[1].lo};
      for (std::size_t e = 0; e < 2; ++e) {
        double& at = e == 0 ? leg.lo : leg.hi;
        if (stretch.infinite[e]) at = stop_before(s, e);
        else if (!stretch.ends[e].is_exact()) end_error = std::max(end_error, spread_at(s, stretch.ends[e]));
      }
      legs.push_back(leg);
    }
    std::optional<std::size_t> source, target;
    if (!closed) {
      source = ends_[chain.front()].vertex[0];
      target = ends_[chain.back()].vertex[1];
    }
    const Cell_feature& feature = feature_of(cell_.stretches()[chain.front()]);
    std::vector<Feature> features{feature.kind == Cell_feature::Kind::arc ? Feature::interior : seen_.feature_at(feature.piece, feature.end), own_.feature};
    std::vector<std::size_t> inputs{input_of(cell_.stretches()[chain.front()]), own_.input};
    if (is_own_first(cell_.stretches()[chain.front()])) {
      std::swap(features[0], features[1]);
      std::swap(inputs[0], inputs[1]);
    }
    data_.arcs.emplace_back(std::make_shared<const Rational_path<2>>(work_, std::move(legs), Irregular_points<2>{}, end_error), source, target,
                            std::move(inputs), std::move(features));
  }

  /// How far apart points of one end's enclosure can be: as control points are, where what is enclosed of the whole piece says less.
  double spread_at(std::size_t s, const Feasible_end& end) const
  {
    const double rough = work_->at(s, enclosure(end)).error();
    if (rough <= 1e-7 * work_->scale) return rough;
    const Curve_piece<2>& forms = work_->pieces[s].forms.get();
    const auto part = [&](const Bernstein<Rational, 1>& f) { return enclosing(restrict_to(f, 0, Rational(end.lo), Rational(end.hi))); };
    const auto weight = part(forms.weight);
    Interval square(0);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto x = part(forms.numerator[k]);
      if (contains_zero(weight[0])) return rough;
      Interval range = x[0] / weight[0];
      for (std::size_t i = 1; i < x.size(); ++i) {
        if (contains_zero(weight[i])) return rough;
        range = hull(range, x[i] / weight[i]);
      }
      square += CGAL::square(Interval(width(range)));
    }
    return std::min(rough, work_->frame.length(CGAL::sqrt(square)).sup());
  }

  double stop_before(std::size_t s, std::size_t e)
  {
    const Cell_stretch& stretch = cell_.stretches()[s];
    const Isolated_root<Rational> pole = pole_at(s, stretch.ends[e]);
    const Rational near = e == 0 ? pole.hi : pole.lo, far(stretch.inside);
    const Path_ends<2> ends(*work_);
    auto at = Path_ends<2>::stop_towards(ends.enclosed_outside_form(s), pole, far, near);
    if (!at) at = Path_ends<2>::stop_towards(ends.outside_form(work_->pieces[s].forms.get()), pole, far, near);
    if (!at) {
      Undecided_piece u;
      u.box = {seen_.range_of(feature_of(stretch).piece).at(enclosure(stretch.ends[e]))};
      u.reason = "the arc could not be followed to infinity in doubles";
      data_.undecided.push_back(std::move(u));
    }
    return at.value_or(stretch.inside);
  }

public:
  /// The parameter intervals of the curve whose bisector points are kept.
  std::vector<Kept_interval> kept_intervals(const Rational_map<2, 1>& map) const
  {
    std::vector<Kept_interval> kept;
    for (const Cell_stretch& s : cell_.stretches()) {
      const Cell_feature& feature = feature_of(s);
      if (feature.kind != Cell_feature::Kind::arc || !seen_.is_own(feature.piece)) continue;
      Kept_interval interval;
      interval.piece = seen_.piece_of_map(feature.piece, map);
      for (std::size_t e = 0; e < 2; ++e) {
        interval.ends[e] = seen_.range_of(feature.piece).at(enclosure(s.ends[e]));
        if (s.ends[e].is_exact()) interval.exact[e] = seen_.parameter_at(feature.piece, Rational(s.ends[e].lo));
        else if (s.ends[e].algebraic && s.ends[e].algebraic->lo == s.ends[e].algebraic->hi)
          interval.exact[e] = seen_.parameter_at(feature.piece, s.ends[e].algebraic->lo);
      }
      kept.push_back(std::move(interval));
    }
    std::sort(kept.begin(), kept.end(), [](const Kept_interval& a, const Kept_interval& b) {
      return a.piece != b.piece ? a.piece < b.piece : a.ends[0].lo < b.ends[0].lo;
    });
    return kept;
  }

private:
  // --------------------------------------------------------------------------------------------------- special cases

  void note_undecided(const Point_cell::Undecided& undecided)
  {
    const Cell_feature& feature = cell_.features()[undecided.feature];
    const bool is_arc = feature.kind == Cell_feature::Kind::arc;
    Undecided_piece u;
    u.box = {seen_.range_of(feature.piece).at(is_arc ? Interval(undecided.at[0], undecided.at[1]) : Interval(feature.end))};
    u.reason = "whether circles through the point that touch the curve there are empty was not decided within the limits";
    data_.undecided.push_back(std::move(u));
  }

  /// No other point is as near to the point as to the curve: it lies on two of its branches.
  void add_point_alone()
  {
    Locus_vertex<2> v;
    v.kind = Vertex_kind::isolated;
    Approximate_point<2> p;
    for (std::size_t k = 0; k < 2; ++k) p[k] = representative(work_->frame.out_of(enclosing(seen_.point()[k]), k));
    v.point = p;
    v.feet.push_back(own_);
    data_.vertices.push_back(std::move(v));
  }

  const Seen_curve& seen_;
  const Point_cell& cell_;
  Foot own_;
  std::vector<std::size_t> inputs_;
  std::shared_ptr<Path_work<2>> work_;
  std::vector<Stretch_ends> ends_;
  bool bounded_ = false;
  Filter_counts filter_;
  Locus_data<2> data_;
};

inline Locus<2> point_curve_bisector(const Coordinates_2& point, const Curve_2& curve, bool point_first, const Point_bisector_options& options)
{
  return with_upward_rounding([&] {
    const auto start = std::chrono::steady_clock::now();
    const Seen_curve seen(curve, point.exact(), options.beyond_ends);
    const Point_cell cell(seen.features(), options.control);
    const std::size_t point_input = point_first ? 0 : 1;
    Point_bisector_maker maker(seen, cell, {point_input, Feature::point, {}}, {1 - point_input}, options);
    Locus_data<2> data = maker.make();
    if (options.keep_rational) {
      data.rational_curve = untrimmed_bisector_map(point, curve);
      data.kept = maker.kept_intervals(*data.rational_curve);
      note_events(bisector_events(point, curve), point_first ? 1 : 0, data);
      data.equations.push_back({"untrimmed bisector", {data.rational_curve->degrees()[0]}});
    }
    data.statistics.cells = cell.cells();
    data.statistics.exact_cells = cell.algebraic_cells();
    data.statistics.filter = cell.filter();
    data.statistics.pairs = seen.size();
    data.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return Locus<2>(std::move(data));
  });
}

} // namespace detail

/// The true bisector of a point and a curve in the plane, certified: all points whose distance to the point is their least
/// distance to the whole curve, its ends and corners included (reading (71) of Farouki & Johnstone 1994). It bounds the convex
/// cell of the points that are nearer to the point: `outline()` has its arcs counterclockwise. Where the point lies on the curve
/// the answer is the set of points to which it is the nearest point of the curve: a part of the normal line or, at an end or a
/// corner, a region.
/// The curve may have any number of pieces and corners, poles, and a bounded, half-infinite or infinite domain.
/// Cost: for each piece some ten to some hundred cells, each O(degree²) for every piece that is not yet known to be outside of
/// the circles; elimination only in degenerate positions.
/// Inputs are numbered in the order of the arguments.
inline Locus<2> bisector(const Coordinates_2& point, const Curve_2& curve, const Point_bisector_options& options = {})
{
  return detail::point_curve_bisector(point, curve, true, options);
}

inline Locus<2> bisector(const Curve_2& curve, const Coordinates_2& point, const Point_bisector_options& options = {})
{
  return detail::point_curve_bisector(point, curve, false, options);
}

} // namespace locus

#endif
