// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_UNTRIMMED_BISECTOR_2_H
#define LOCUS_CONSTRUCT_UNTRIMMED_BISECTOR_2_H

#include <locus/constraint/f3_system.h>
#include <locus/construct/planar_arc.h>
#include <locus/zero_set/curve_solver.h>
#include <locus/zero_set/overlay.h>

#include <chrono>

namespace locus {

struct Bisector_options {
  Solve_control control;
  bool keep_cells = false; ///< keep the cells of the subdivision in the result, for pictures
};

namespace detail {

/// Keeps the leaves of a solve for pictures.
class Cell_keeper final : public Claim_observer<2> {
public:
  explicit Cell_keeper(const std::array<Parameter_range, 2>& domain) : domain_(domain) {}

  void on_claim(const Claim<2>& claim) override
  {
    const char* name = name_of(claim.kind);
    if (!name) return;
    Cell_picture cell;
    for (std::size_t v = 0; v < 2; ++v)
      cell.box.push_back(domain_[v].at(Interval(claim.box.lo[v], claim.box.hi[v])));
    cell.claim = name;
    cells.push_back(std::move(cell));
  }

  std::vector<Cell_picture> cells;

private:
  static const char* name_of(Claim_kind kind)
  {
    switch (kind) {
    case Claim_kind::empty: return "empty";
    case Claim_kind::graph: return "graph";
    case Claim_kind::crossing: return "crossing";
    case Claim_kind::undecided: return "undecided";
    case Claim_kind::split:
    case Claim_kind::isolated_box: return nullptr;
    }
    return nullptr;
  }

  std::array<Parameter_range, 2> domain_;
};

/// Corners of the inputs' control polygons: the frame and the scale are taken from them.
inline void collect_control_points(const Curve_2& curve, std::vector<Exact_point<2>>& points)
{
  for (const auto& piece : curve.pieces())
    for (std::size_t i = 0; i < piece.numerator[0].size(); ++i) {
      const Rational w = piece.is_polynomial() ? piece.weight[0] : i < piece.weight.size() ? piece.weight[i] : Rational(0);
      if (w == 0) continue;
      points.push_back({Rational(piece.numerator[0][i] / w), Rational(piece.numerator[1][i] / w)});
    }
}

inline void measure_inputs(const std::vector<Exact_point<2>>& points, Planar_solution& solution)
{
  std::array<Interval, 2> extent, middle;
  for (std::size_t k = 0; k < 2; ++k) {
    Interval lo(0), hi(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Interval x = enclosing(solution.frame.into(points[i][k], k));
      lo = i == 0 ? x : Interval(std::min(lo.inf(), x.inf()), std::min(lo.sup(), x.sup()));
      hi = i == 0 ? x : Interval(std::max(hi.inf(), x.inf()), std::max(hi.sup(), x.sup()));
    }
    extent[k] = hi - lo;
    middle[k] = hull(lo, hi);
  }
  solution.scale = std::hypot(midpoint(extent[0]), midpoint(extent[1]));
  solution.cut_radius = 10 * solution.scale;
  solution.centre = {midpoint(middle[0]), midpoint(middle[1])};
}

/// Strict sign of t - r (or t + r - 1) somewhere on a piece that does not meet that line between its ends.
inline Sign side_of_axis(const Curve_graph& graph, std::size_t piece, bool reversed)
{
  const Graph_piece& p = graph.pieces[piece];
  const auto base = static_cast<std::size_t>(p.base);
  const Interval from = graph.vertices[p.from].at[base], to = graph.vertices[p.to].at[base];
  const Piece_evaluator e(graph.forms[piece], p.base);
  for (const double f : {0.5, 0.25, 0.75, 0.0625, 0.9375}) {
    const double s = from.sup() + f * (to.inf() - from.sup());
    std::array<Interval, 2> at;
    at[base] = Interval(s);
    at[1 - base] = e.pivot_at(s, 0.5 * (midpoint(graph.vertices[p.from].at[1 - base]) + midpoint(graph.vertices[p.to].at[1 - base])));
    const Sign sign = sign_of(reversed ? at[0] + at[1] - Interval(1) : at[0] - at[1]);
    if (is_strict(sign)) return sign;
  }
  return Sign::unknown;
}

inline Curve_graph solve_f3(const F3_problem& problem, const Solve_control& control, Claim_observer<2>* observer)
{
  Curve_graph graph = solve_curves(problem.system, control, observer);
  if (!problem.axis) return graph;
  const bool reversed = problem.axis_reversed;
  Curve_graph axis = solve_curves(*problem.axis, control);
  return Overlay(std::move(graph), std::move(axis),
                 [reversed](const Curve_graph& g, std::size_t piece) { return side_of_axis(g, piece, reversed); })
    .run();
}

/// Turns a solved zero set into the result that users see.
class Planar_result {
public:
  Planar_result(std::shared_ptr<const Planar_solution> solution, const F3_problem& problem) : s_(std::move(solution))
  {
    data_.compute = "bisector";
    data_.equations.push_back({problem.system.name, {problem.degrees[0], problem.degrees[1]}});
    if (problem.axis) data_.equations.push_back({problem.axis_reversed ? "t + r = 1" : "t = r", {1, 1}});
    data_.scale = s_->frame.length(Interval(s_->scale)).sup();
    data_.cut_radius = s_->frame.length(Interval(s_->cut_radius)).sup();
    data_.centre[0] = midpoint(s_->frame.out_of(Interval(s_->centre.x), 0));
    data_.centre[1] = midpoint(s_->frame.out_of(Interval(s_->centre.y), 1));
    for (const Degenerate_component& d : problem.degenerate) add_degenerate(d);
    if (s_->graph.identically_zero) add_degenerate(Degenerate_component{});
    add_vertices();
    add_arcs();
    for (const Undecided_box& u : s_->graph.undecided) {
      Undecided_piece piece;
      for (std::size_t v = 0; v < 2; ++v) piece.box.push_back(s_->domain[v].at(Interval(u.box.lo[v], u.box.hi[v])));
      piece.reason = u.reason;
      data_.undecided.push_back(std::move(piece));
    }
    data_.statistics.cells = s_->graph.statistics.cells;
    data_.statistics.exact_cells = s_->graph.statistics.exact_cells;
    data_.statistics.filter = s_->graph.statistics.filter;
  }

  Locus_data<2>& data() { return data_; }

private:
  void add_degenerate(const Degenerate_component& d)
  {
    using Kind = Degenerate_component::Kind;
    Degenerate_piece piece;
    piece.multiplicity = d.multiplicity;
    switch (d.kind) {
    case Kind::centre:
      piece.kind = "centre";
      piece.reason = "the curve is tangent there to the circle that carries the other input: all points map to its centre";
      break;
    case Kind::infinity:
      piece.kind = "infinity";
      piece.reason = "the curve is tangent there to the line that carries the other input: all points map to infinity";
      break;
    case Kind::overlap:
      piece.kind = "overlap";
      piece.reason = std::string("the inputs coincide along ") + (d.reversed ? "t + r = 1" : "t = r");
      break;
    case Kind::everything:
      piece.kind = "everything";
      piece.reason = "the equation vanishes identically: both inputs lie on one line or one circle";
      break;
    }
    if (d.input >= 0) {
      const auto input = static_cast<std::size_t>(d.input);
      piece.input = input;
      piece.parameter = s_->domain[input].at(Interval(d.lo, d.hi));
    }
    data_.degenerate.push_back(std::move(piece));
  }

  static Feature feature_at(const Interval& u)
  {
    if (u.inf() == 0 && u.sup() == 0) return Feature::start;
    if (u.inf() == 1 && u.sup() == 1) return Feature::end;
    return Feature::interior;
  }

  static Vertex_kind kind_of(const Graph_vertex& v)
  {
    if (v.is_mark) return Vertex_kind::infinity;
    switch (v.kind) {
    case Graph_vertex::Kind::boundary:
    case Graph_vertex::Kind::end: return Vertex_kind::boundary;
    case Graph_vertex::Kind::node: return Vertex_kind::node;
    case Graph_vertex::Kind::mark: return Vertex_kind::infinity;
    case Graph_vertex::Kind::isolated: return Vertex_kind::isolated;
    case Graph_vertex::Kind::crossing:
    case Graph_vertex::Kind::open: return Vertex_kind::undecided;
    }
    return Vertex_kind::undecided;
  }

  void add_vertices()
  {
    const auto& graph = s_->graph;
    number_.assign(graph.vertices.size(), 0);
    std::vector<char> used(graph.vertices.size(), 0);
    for (const Graph_arc& arc : graph.arcs)
      if (!arc.closed) used[arc.source] = used[arc.target] = 1;
    for (std::size_t v = 0; v < graph.vertices.size(); ++v) {
      const Graph_vertex& from = graph.vertices[v];
      if (!used[v] && from.kind != Graph_vertex::Kind::isolated) continue;
      number_[v] = data_.vertices.size();
      Locus_vertex<2> vertex;
      vertex.kind = kind_of(from);
      for (std::size_t k = 0; k < 2; ++k)
        vertex.feet.push_back({k, feature_at(from.at[k]), {s_->domain[k].at(from.at[k])}});
      if (vertex.kind == Vertex_kind::infinity) add_asymptote(from, vertex);
      else {
        const Placed placed = place(*s_, from.at);
        if (diameter(placed.point) <= largest_vertex_error * s_->scale) {
          const Arc_point<2> p = finished(*s_, placed);
          vertex.point = p.point();
          vertex.radius = p.radius();
        } else {
          report_unplaced(from);
        }
      }
      data_.vertices.push_back(std::move(vertex));
    }
  }

  /// Beyond this part of the inputs' diameter a vertex's point is not given: where the curves touch, both formulas are 0/0.
  static constexpr double largest_vertex_error = 1e-3;

  void report_unplaced(const Graph_vertex& from)
  {
    Undecided_piece piece;
    for (std::size_t k = 0; k < 2; ++k) piece.box.push_back(s_->domain[k].at(from.at[k]));
    piece.reason = "the curves touch here: the position in the plane is 0/0 and is not enclosed";
    data_.undecided.push_back(std::move(piece));
  }

  /// At a common tangent line the locus goes to infinity along the perpendicular bisector of the two contact points.
  void add_asymptote(const Graph_vertex& from, Locus_vertex<2>& vertex) const
  {
    const Vector_2<Interval> x1 = s_->map.first().point(from.at[0]), x2 = s_->map.second().point(from.at[1]);
    const Vector_2<Interval> a = s_->map.first().tangent(from.at[0]);
    const double ax = midpoint(a.x), ay = midpoint(a.y), length = std::hypot(ax, ay);
    Asymptote<2> asymptote;
    const Interval half(0.5);
    asymptote.point[0] = midpoint(s_->frame.out_of(half * (x1.x + x2.x), 0));
    asymptote.point[1] = midpoint(s_->frame.out_of(half * (x1.y + x2.y), 1));
    asymptote.direction[0] = -ay / length;
    asymptote.direction[1] = ax / length;
    vertex.direction = asymptote.direction;
    vertex.asymptote = asymptote;
  }

  void add_arcs()
  {
    const auto& graph = s_->graph;
    for (std::size_t i = 0; i < graph.arcs.size(); ++i) {
      const Graph_arc& arc = graph.arcs[i];
      std::optional<std::size_t> source, target;
      if (!arc.closed) {
        source = number_[arc.source];
        target = number_[arc.target];
      }
      data_.arcs.emplace_back(std::make_shared<Planar_arc>(s_, i), source, target, std::vector<std::size_t>{0, 1},
                              std::vector<Feature>{Feature::interior, Feature::interior});
    }
    for (std::size_t v = 0; v < graph.vertices.size(); ++v)
      for (const std::size_t piece : graph.vertices[v].half_branches)
        data_.vertices[number_[v]].half_branches.push_back(half_branch(v, piece));
  }

  Half_branch half_branch(std::size_t vertex, std::size_t piece) const
  {
    for (std::size_t i = 0; i < s_->graph.arcs.size(); ++i) {
      const Graph_arc& arc = s_->graph.arcs[i];
      if (arc.source == vertex && arc.steps.front().piece == piece) return {i, true};
      if (arc.target == vertex && arc.steps.back().piece == piece) return {i, false};
    }
    throw std::logic_error("locus: a half-branch without its arc");
  }

  std::shared_ptr<const Planar_solution> s_;
  Locus_data<2> data_;
  std::vector<std::size_t> number_;
};

inline Locus<2> untrimmed_bisector_upward(const Curve_2& first, const Curve_2& second, const Bisector_options& options)
{
  const auto start = std::chrono::steady_clock::now();
  if (first.pieces().size() != 1 || second.pieces().size() != 1)
    throw Unsupported_feature("the bisector of splines with several spans");
  std::vector<Exact_point<2>> points;
  collect_control_points(first, points);
  collect_control_points(second, points);
  auto solution = std::make_shared<Planar_solution>();
  solution->frame = fitting_frame<2>(points);
  solution->domain = {Parameter_range(first.chain().pieces[0]), Parameter_range(second.chain().pieces[0])};
  for (std::size_t k = 0; k < 2; ++k) solution->origin[k] = enclosing(solution->frame.origin[k]);
  measure_inputs(points, *solution);
  const F3_problem problem = f3_problem(std::make_shared<const Planar_curve>(first.pieces()[0], solution->frame),
                                        std::make_shared<const Planar_curve>(second.pieces()[0], solution->frame));
  solution->map = Bisector_map_2(*problem.first, *problem.second);
  Cell_keeper keeper(solution->domain);
  solution->graph = solve_f3(problem, options.control, options.keep_cells ? &keeper : nullptr);
  Planar_result result(solution, problem);
  result.data().cells = std::move(keeper.cells);
  result.data().statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return Locus<2>(std::move(result.data()));
}

} // namespace detail

/// All of the zero set of F3 for two rational Bézier curves in the plane, with its image: every pair of feet whose
/// normals meet at equal distance, certified. The true bisector by least distances is a subset of it.
/// F3 is the equation of Elber & Kim 1998 (13), written as -Im(e² ā b̄).
/// Throws Unsupported_feature for a cusp inside an input. Cost: some ten to a hundred cells of O(degree³) each.
inline Locus<2> untrimmed_bisector(const Curve_2& first, const Curve_2& second, const Bisector_options& options = {})
{
  return with_upward_rounding([&] { return detail::untrimmed_bisector_upward(first, second, options); });
}

} // namespace locus

#endif
