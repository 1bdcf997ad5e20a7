// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_ARC_STEPS_H
#define LOCUS_CONSTRUCT_ARC_STEPS_H

#include <locus/construct/planar_solution.h>
#include <locus/zero_set/piece_evaluation.h>

namespace locus {
namespace detail {

/// A step of an arc of a planar bisector: a piece in one cell, or a part of it.
struct Arc_stretch {
  std::size_t patch = 0;
  const Graph_piece* piece = nullptr;
  const Curve_graph::Cell_form* form = nullptr;
  bool reversed = false;
  Interval lo, hi;                     ///< base values at the piece's own ends
  bool lo_cut = false, hi_cut = false; ///< `lo` or `hi` has been moved inward from the piece's end
  bool is_beyond = false;              ///< on the way from a pole, and proved to lie outside the cut radius
};

/// A part of an arc: `count` of its steps from the `first` one on, in a closed arc beyond the last one too; it begins and ends inside
/// the first and the last of them where base values are given.
struct Arc_part {
  std::size_t first = 0, count = 0;
  std::optional<double> from, to;
};

/// What an arc is evaluated with, step by step.
class Arc_steps {
public:
  Arc_steps(std::shared_ptr<const Planar_solution> solution, std::size_t arc) : s_(std::move(solution)), arc_(arc) {}

  const Planar_solution& solution() const { return *s_; }
  const Patchwork_arc& graph_arc() const { return s_->work.arcs[arc_]; }
  std::size_t size() const { return graph_arc().steps.size(); }
  Arc_part whole() const { return {0, size(), {}, {}}; }

  const Planar_patch& patch(const Arc_stretch& s) const { return s_->patches[s.patch]; }
  const Graph_vertex& vertex(const Arc_stretch& s, std::size_t v) const { return s_->work.patches[s.patch].graph.vertices[v]; }
  bool is_pole(const Arc_stretch& s, std::size_t v) const { return s_->work.patches[s.patch].is_pole[v]; }

  /// Where branches lie between curves that touch: as Planar_patch::at_contact.
  int between(const Arc_stretch& s) const
  {
    const int from = patch(s).contact_at(s.piece->from);
    return from != 0 ? from : patch(s).contact_at(s.piece->to);
  }

  Placed place_vertex(const Arc_stretch& s, std::size_t v) const
  {
    Placed p = detail::place_vertex(patch(s), v, vertex(s, v).at);
    p.between = between(s);
    return p;
  }
  Placed place_on(const Arc_stretch& s, const std::array<Interval, 2>& at) const { return place(patch(s), at, between(s)); }

  static std::array<Interval, 2> parameters(const Piece_evaluator& e, double base, double guess, double wanted_width = 5e-13)
  {
    std::array<Interval, 2> at;
    at[static_cast<std::size_t>(e.base())] = Interval(base);
    at[static_cast<std::size_t>(e.pivot())] = e.pivot_at(base, guess, wanted_width);
    return at;
  }

  Arc_stretch stretch(std::size_t step) const
  {
    const Patchwork_arc::Step& at = graph_arc().steps[step % size()];
    const Curve_graph& graph = s_->work.patches[at.patch].graph;
    Arc_stretch s;
    s.patch = at.patch;
    s.piece = &graph.pieces[at.piece];
    s.form = &graph.forms[at.piece];
    s.reversed = at.reversed;
    if (s.piece->is_half_branch) return s;
    const auto base = static_cast<std::size_t>(s.piece->base);
    s.lo = vertex(s, s.piece->from).at[base];
    s.hi = vertex(s, s.piece->to).at[base];
    return s;
  }

  std::vector<Arc_stretch> stretches(const Arc_part& part) const
  {
    std::vector<Arc_stretch> all;
    for (std::size_t k = 0; k < part.count; ++k) all.push_back(stretch(part.first + k));
    const auto cut = [](Arc_stretch& s, double at, bool low) {
      (low ? s.lo : s.hi) = Interval(at);
      (low ? s.lo_cut : s.hi_cut) = true;
    };
    if (part.from) cut(all.front(), *part.from, !all.front().reversed);
    if (part.to) cut(all.back(), *part.to, all.back().reversed);
    return all;
  }

  std::size_t piece_index(const Arc_stretch& s) const { return static_cast<std::size_t>(s.piece - s_->work.patches[s.patch].graph.pieces.data()); }

  /// In the cell of a node: the branch is only enclosed, by the whole cell, or in its cone.
  Placed over_half_branch(const Arc_stretch& s, const Placed& near) const
  {
    std::array<Interval, 2> cell;
    for (std::size_t v = 0; v < 2; ++v) cell[v] = hull(near.at[v], Interval(s.form->box.lo[v], s.form->box.hi[v]));
    return place(patch(s), cell, between(s), piece_index(s));
  }

private:
  std::shared_ptr<const Planar_solution> s_;
  std::size_t arc_;
};

} // namespace detail
} // namespace locus

#endif
