// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_OVERLAY_H
#define LOCUS_ZERO_SET_OVERLAY_H

#include <locus/zero_set/curve_graph.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace locus {

/// Joins the zero sets of two factors of one equation into that of the product. Both graphs carry the solutions of
/// cause 0, the points where the factors vanish together, as marks; there each pair becomes one node.
/// `side` gives the strict sign of the second factor on a piece of the first graph next to such a point, so that the
/// half-branches come in cyclic order.
class Overlay {
public:
  using Side = std::function<Sign(const Curve_graph& first, std::size_t piece)>;

  Overlay(Curve_graph first, Curve_graph second, Side side)
    : graph_(std::move(first)), second_(std::move(second)), side_(std::move(side))
  {
  }

  Curve_graph run()
  {
    const Curve_graph first = graph_;
    const std::size_t vertices = graph_.vertices.size(), pieces = graph_.pieces.size();
    append();
    std::vector<std::size_t> rename(graph_.vertices.size());
    for (std::size_t v = 0; v < rename.size(); ++v) rename[v] = v;
    for (std::size_t k = 0; k < graph_.special.size(); ++k) {
      if (graph_.special[k].cause != 0) continue;
      const std::size_t a = vertex_of(0, vertices, k), b = vertex_of(vertices, graph_.vertices.size(), k);
      if (a == none || b == none) {
        report(k);
        continue;
      }
      rename[b] = a;
      Graph_vertex& node = graph_.vertices[a];
      node.is_mark = false;
      node.half_branches = cyclic(first, a, b, pieces);
      node.kind = node.half_branches.size() > 1 ? Graph_vertex::Kind::node : Graph_vertex::Kind::end;
    }
    for (Graph_piece& p : graph_.pieces) {
      p.from = rename[p.from];
      p.to = rename[p.to];
    }
    for (Graph_arc& arc : graph_.arcs) {
      arc.source = rename[arc.source];
      arc.target = rename[arc.target];
    }
    return std::move(graph_);
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void append()
  {
    const std::size_t vertices = graph_.vertices.size(), pieces = graph_.pieces.size();
    const int special = static_cast<int>(graph_.special.size());
    // The shared cause comes first in both lists and with equal results; the second's other causes follow.
    std::vector<int> index(second_.special.size());
    std::size_t shared = 0;
    for (std::size_t k = 0; k < second_.special.size(); ++k) {
      if (second_.special[k].cause == 0) {
        index[k] = static_cast<int>(shared++);
      } else {
        index[k] = special + static_cast<int>(k - shared);
        graph_.special.push_back(second_.special[k]);
      }
    }
    for (Graph_vertex v : second_.vertices) {
      if (v.cause >= 0) v.cause = index[static_cast<std::size_t>(v.cause)];
      for (std::size_t& h : v.half_branches) h += pieces;
      graph_.vertices.push_back(std::move(v));
    }
    for (Graph_piece p : second_.pieces) {
      p.from += vertices;
      p.to += vertices;
      graph_.pieces.push_back(p);
    }
    for (Graph_arc arc : second_.arcs) {
      for (auto& step : arc.steps) step.piece += pieces;
      arc.source += vertices;
      arc.target += vertices;
      graph_.arcs.push_back(std::move(arc));
    }
    graph_.forms.insert(graph_.forms.end(), second_.forms.begin(), second_.forms.end());
    graph_.undecided.insert(graph_.undecided.end(), second_.undecided.begin(), second_.undecided.end());
    graph_.statistics += second_.statistics;
  }

  std::size_t vertex_of(std::size_t begin, std::size_t end, std::size_t special) const
  {
    for (std::size_t v = begin; v < end; ++v)
      if (graph_.vertices[v].cause == static_cast<int>(special)) return v;
    return none;
  }

  std::vector<std::size_t> pieces_at(std::size_t vertex) const
  {
    std::vector<std::size_t> found;
    for (std::size_t p = 0; p < graph_.pieces.size(); ++p)
      if (graph_.pieces[p].from == vertex || graph_.pieces[p].to == vertex) found.push_back(p);
    return found;
  }

  /// Pieces of the second curve and of the first take turns; the first's are told apart by their side.
  std::vector<std::size_t> cyclic(const Curve_graph& first, std::size_t a, std::size_t b, std::size_t first_pieces) const
  {
    std::vector<std::size_t> order;
    std::array<std::vector<std::size_t>, 2> across;
    for (const std::size_t p : pieces_at(a))
      if (p < first_pieces) across[side_(first, p) == Sign::positive ? 0 : 1].push_back(p);
    const std::vector<std::size_t> along = pieces_at(b);
    for (std::size_t k = 0; k < 2; ++k) {
      if (k < along.size()) order.push_back(along[k]);
      order.insert(order.end(), across[k].begin(), across[k].end());
    }
    return order;
  }

  void report(std::size_t k)
  {
    Undecided_box u;
    for (std::size_t v = 0; v < 2; ++v) {
      u.box.lo[v] = std::max(0.0, graph_.special[k].box[v].inf());
      u.box.hi[v] = std::min(1.0, graph_.special[k].box[v].sup());
    }
    u.reason = "cannot place a crossing of two factors on both";
    graph_.undecided.push_back(std::move(u));
  }

  Curve_graph graph_, second_;
  Side side_;
};

} // namespace locus

#endif
