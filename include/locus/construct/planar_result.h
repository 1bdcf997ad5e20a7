// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANAR_RESULT_H
#define LOCUS_CONSTRUCT_PLANAR_RESULT_H

#include <locus/construct/planar_arc.h>
#include <locus/construct/planar_patches.h>

namespace locus {
namespace detail {

/// Turns a solved zero set into the result that users see.
class Planar_result {
public:
  Planar_result(std::shared_ptr<const Planar_solution> solution, const Planar_pieces& first, const Planar_pieces& second, bool is_self)
    : s_(std::move(solution)), pieces_{&first, &second}, is_self_(is_self)
  {
    data_.compute = "bisector";
    data_.scale = s_->frame.length(Interval(s_->scale)).sup();
    data_.cut_radius = s_->frame.length(Interval(s_->cut_radius)).sup();
    data_.centre[0] = midpoint(s_->frame.out_of(Interval(s_->centre.x), 0));
    data_.centre[1] = midpoint(s_->frame.out_of(Interval(s_->centre.y), 1));
    add_vertices();
    add_arcs();
    add_undecided();
  }

  void add_notes(const std::vector<Patch_maker::Note>& notes)
  {
    for (const auto& note : notes)
      for (const Degenerate_component& d : note.degenerate) add_degenerate(note.patch, d);
  }

  Locus_data<2>& data() { return data_; }

private:
  void add_degenerate(const Planar_patch& patch, const Degenerate_component& d)
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
      piece.reason = std::string("the inputs coincide") + (d.line.reversed ? ", with opposite directions" : "");
      break;
    case Kind::everything:
      piece.kind = "everything";
      piece.reason = "the equation vanishes identically: both inputs lie on one line or one circle";
      break;
    }
    if (d.input >= 0) {
      const auto input = static_cast<std::size_t>(d.input);
      piece.input = input;
      piece.parameter = patch.domain[input].at(Interval(d.lo, d.hi));
    }
    for (const Parameter_range& range : patch.domain) piece.box.push_back({range.at(Interval(0)).lo, range.at(Interval(1)).hi});
    data_.degenerate.push_back(std::move(piece));
  }

  using Member = Patchwork_vertex::Member;

  const Planar_patch& patch(const Member& m) const { return s_->patches[m.patch]; }
  std::array<Interval, 2> place_of(const Member& m) const { return s_->work.patches[m.patch].graph.vertices[m.vertex].at; }

  Vertex_kind kind_of(const Patchwork_vertex& v, const Locus_vertex<2>& vertex) const
  {
    using Kind = Graph_vertex::Kind;
    const auto has = [&](Feature f) { return vertex.feet[0].feature == f || vertex.feet[1].feature == f; };
    if (v.is_pole) return Vertex_kind::infinity;
    if (v.is_final && is_self_) return Vertex_kind::diagonal;
    switch (v.kind) {
    case Kind::boundary:
    case Kind::end: return has(Feature::corner) ? Vertex_kind::corner : Vertex_kind::boundary;
    case Kind::node: return Vertex_kind::node;
    case Kind::mark: return Vertex_kind::infinity;
    case Kind::isolated: return Vertex_kind::isolated;
    case Kind::crossing:
    case Kind::open: return Vertex_kind::undecided;
    }
    return Vertex_kind::undecided;
  }

  void add_vertices()
  {
    const Patchwork& work = s_->work;
    number_.assign(work.vertices.size(), 0);
    std::vector<char> used(work.vertices.size(), 0);
    for (const Patchwork_arc& arc : work.arcs)
      if (!arc.closed) used[arc.source] = used[arc.target] = 1;
    for (std::size_t v = 0; v < work.vertices.size(); ++v) {
      const Patchwork_vertex& from = work.vertices[v];
      if (!used[v] && from.kind != Graph_vertex::Kind::isolated) continue;
      number_[v] = data_.vertices.size();
      add_vertex(from);
    }
  }

  void add_vertex(const Patchwork_vertex& from)
  {
    const Member& member = from.members[0];
    const Planar_patch& patch = this->patch(member);
    const std::array<Interval, 2> at = place_of(member), local = patch.map.chart()(at);
    const std::array<Range, 2> parameters = patch.parameters(at);
    Locus_vertex<2> vertex;
    for (std::size_t k = 0; k < 2; ++k)
      vertex.feet.push_back({is_self_ ? 0 : k, pieces_[k]->feature_at(patch.piece[k], local[k]), {parameters[k]}});
    vertex.kind = kind_of(from, vertex);
    if (vertex.kind == Vertex_kind::infinity) {
      add_asymptote(patch, local, vertex);
    } else if (from.is_corner && vertex.kind == Vertex_kind::node) {
      place_at_contact(patch, local, vertex);
    } else {
      const Placed placed = place_vertex(patch, member.vertex, at);
      const double far = std::hypot(mignitude(placed.point.x - Interval(s_->centre.x)), mignitude(placed.point.y - Interval(s_->centre.y)));
      if (diameter(placed.point) <= largest_vertex_error * std::max(s_->scale, far)) {
        const Arc_point<2> p = finished(*s_, placed);
        vertex.point = p.point();
        vertex.radius = p.radius();
        vertex.error = p.error();
      } else if (is_meeting(member)) {
        place_at_contact(patch, local, vertex);
      } else {
        report(patch, at, "the position in the plane is 0/0 here and is not enclosed");
      }
    }
    data_.vertices.push_back(std::move(vertex));
  }

  bool is_meeting(const Member& m) const
  {
    const Curve_graph& graph = s_->work.patches[m.patch].graph;
    const int special = graph.vertices[m.vertex].cause;
    return special >= 0 && graph.special[static_cast<std::size_t>(special)].tag == tag_of(F3_cause::meeting);
  }

  /// Beyond this part of the inputs' diameter, or of its distance if that is greater, the error of a vertex's point is too
  /// great to give it: where the curves touch, both formulas are 0/0.
  static constexpr double largest_vertex_error = 1e-3;

  void report(const Planar_patch& patch, const std::array<Interval, 2>& at, std::string reason)
  {
    Undecided_piece piece;
    for (const Range& range : patch.parameters(at)) piece.box.push_back(range);
    piece.reason = std::move(reason);
    data_.undecided.push_back(std::move(piece));
  }

  void add_undecided()
  {
    for (std::size_t p = 0; p < s_->patches.size(); ++p)
      for (const Undecided_box& u : s_->work.patches[p].graph.undecided)
        report(s_->patches[p], {Interval(u.box.lo[0], u.box.hi[0]), Interval(u.box.lo[1], u.box.hi[1])}, u.reason);
    for (const auto& [member, reason] : s_->work.undecided) report(patch(member), place_of(member), reason);
  }

  /// Where the curves touch, the branches of one place of the parameters have different limits: the vertex is put where the
  /// curves touch, as if the circle had shrunk to that point.
  void place_at_contact(const Planar_patch& patch, const std::array<Interval, 2>& local, Locus_vertex<2>& vertex) const
  {
    const Vector_2<Interval> foot = patch.map.first().point(local[0]);
    vertex.point.emplace();
    (*vertex.point)[0] = representative(s_->frame.out_of(foot.x, 0));
    (*vertex.point)[1] = representative(s_->frame.out_of(foot.y, 1));
  }

  /// At a common tangent line the locus goes to infinity along the perpendicular bisector of the two contact points; at an
  /// infinite foot along the normal of the other one.
  void add_asymptote(const Planar_patch& patch, const std::array<Interval, 2>& local, Locus_vertex<2>& vertex) const
  {
    const Vector_2<Interval> x1 = patch.map.first().point(local[0]), x2 = patch.map.second().point(local[1]);
    const auto finite = [](const Vector_2<Interval>& x) { return std::isfinite(magnitude(x.x)) && std::isfinite(magnitude(x.y)); };
    const Vector_2<Interval> a = finite(x1) ? patch.map.first().tangent(local[0]) : patch.map.second().tangent(local[1]);
    const double ax = midpoint(a.x), ay = midpoint(a.y), length = std::hypot(ax, ay);
    Approximate_point<2> direction;
    direction[0] = -ay / length;
    direction[1] = ax / length;
    vertex.direction = direction;
    if (!finite(x1) || !finite(x2)) return;
    Asymptote<2> asymptote;
    asymptote.direction = direction;
    const Interval half(0.5);
    asymptote.point[0] = midpoint(s_->frame.out_of(half * (x1.x + x2.x), 0));
    asymptote.point[1] = midpoint(s_->frame.out_of(half * (x1.y + x2.y), 1));
    vertex.asymptote = asymptote;
  }

  void add_arcs()
  {
    const Patchwork& work = s_->work;
    for (std::size_t i = 0; i < work.arcs.size(); ++i) {
      const Patchwork_arc& arc = work.arcs[i];
      std::optional<std::size_t> source, target;
      if (!arc.closed) {
        source = number_[arc.source];
        target = number_[arc.target];
      }
      data_.arcs.emplace_back(std::make_shared<Planar_arc>(s_, i), source, target, std::vector<std::size_t>{0, is_self_ ? 0u : 1u},
                              std::vector<Feature>{Feature::interior, Feature::interior});
    }
    for (std::size_t v = 0; v < work.vertices.size(); ++v)
      for (const auto& piece : work.vertices[v].half_branches) data_.vertices[number_[v]].half_branches.push_back(half_branch(v, piece));
  }

  Half_branch half_branch(std::size_t vertex, const Patchwork_vertex::Piece_ref& piece) const
  {
    const auto is_it = [&](const Patchwork_arc::Step& step) { return step.patch == piece.patch && step.piece == piece.piece; };
    for (std::size_t i = 0; i < s_->work.arcs.size(); ++i) {
      const Patchwork_arc& arc = s_->work.arcs[i];
      if (arc.source == vertex && is_it(arc.steps.front())) return {i, true};
      if (arc.target == vertex && is_it(arc.steps.back())) return {i, false};
    }
    throw std::logic_error("locus: a half-branch without its arc");
  }

  std::shared_ptr<const Planar_solution> s_;
  std::array<const Planar_pieces*, 2> pieces_;
  bool is_self_;
  Locus_data<2> data_;
  std::vector<std::size_t> number_;
};

} // namespace detail
} // namespace locus

#endif
