// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SPACE_CURVE_SOLVER_H
#define LOCUS_ZERO_SET_SPACE_CURVE_SOLVER_H

#include <locus/zero_set/curve_faces.h>
#include <locus/zero_set/space_curve_graph.h>

#include <stdexcept>

namespace locus {
namespace detail {

/// Solves D-1 equations in D variables on the unit cell: cuts until every cell is empty or a graph, and joins the
/// stretches of the graph cells at the crossings that neighbours share.
template <int D>
class Space_curve_solver {
public:
  static constexpr int K = D - 1;

  Space_curve_solver(const System<K, D>& system, const Solve_control& control, Claim_observer<D>* observer)
    : tree_(system), faces_(system, tree_, control), cells_(system, tree_, faces_, control, observer)
  {
  }

  Space_curve_graph<D> run()
  {
    cells_.run();
    list_undecided();
    for (const auto& stretch : faces_.stretches) add_piece(stretch);
    for (const Place& p : faces_.touches) graph_.vertices[vertex_at(p)].kind = Kind::isolated;
    settle_vertices();
    join_arcs();
    graph_.statistics = cells_.statistics;
    graph_.statistics.faces = faces_.segments.size();
    graph_.statistics.face_cells = faces_.search_cells;
    return std::move(graph_);
  }

private:
  using Faces = Curve_faces<D>;
  using Place = typename Faces::Place;
  using Kind = typename Space_vertex<D>::Kind;

  void list_undecided()
  {
    for (const auto& [cell, reason] : cells_.undecided) graph_.undecided.push_back({tree_[cell].box, reason});
  }

  std::size_t vertex_at(const Place& p)
  {
    auto& crossing = faces_.at(p);
    if (crossing.vertex < 0) {
      crossing.vertex = static_cast<int>(graph_.vertices.size());
      graph_.vertices.push_back(
        {faces_.segments[p.segment].on_boundary ? Kind::boundary : Kind::crossing, crossing.at});
    }
    return static_cast<std::size_t>(crossing.vertex);
  }

  void add_piece(const typename Faces::Stretch& stretch)
  {
    Space_piece<D> piece;
    piece.box = tree_[stretch.cell].box;
    piece.pivots = stretch.pivots;
    piece.base = base_variables<D>(stretch.pivots)[0];
    piece.from = vertex_at(stretch.from);
    piece.to = vertex_at(stretch.to);
    graph_.pieces.push_back(piece);
  }

  /// Inside the unit cell an arc goes on at each vertex, unless the cell behind it is undecided or not wanted.
  void settle_vertices()
  {
    std::vector<int> degree(graph_.vertices.size(), 0);
    for (const auto& p : graph_.pieces) {
      ++degree[p.from];
      ++degree[p.to];
    }
    for (std::size_t v = 0; v < degree.size(); ++v) {
      Space_vertex<D>& vertex = graph_.vertices[v];
      const int wanted = vertex.kind == Kind::crossing ? 2 : vertex.kind == Kind::boundary ? 1 : 0;
      if (degree[v] == wanted) continue;
      if (degree[v] != 1 || !is_near_gap(vertex.at))
        throw std::logic_error("locus: a curve's arc ends inside the domain");
      vertex.kind = Kind::open;
    }
    check_forgotten_crossings();
  }

  /// A crossing that no graph cell took up can only lie between cells that are undecided or not wanted.
  void check_forgotten_crossings() const
  {
    for (const auto& s : faces_.segments)
      for (const auto& c : s.crossings)
        if (c.vertex < 0 && faces_.is_alone(c) && !is_near_gap(c.at))
          throw std::logic_error("locus: a curve crosses empty cells");
  }

  bool is_near_gap(const std::array<Interval, static_cast<std::size_t>(D)>& at) const
  {
    const auto touches = [&](const Box<D>& b) {
      for (std::size_t v = 0; v < at.size(); ++v)
        if (at[v].sup() < b.lo[v] || at[v].inf() > b.hi[v]) return false;
      return true;
    };
    for (const auto& u : graph_.undecided)
      if (touches(u.box)) return true;
    for (const auto cell : cells_.outside)
      if (touches(tree_[cell].box)) return true;
    return false;
  }

  void join_arcs()
  {
    std::vector<Arc_link> links;
    for (const auto& p : graph_.pieces) links.push_back({p.from, p.to});
    std::vector<char> through;
    for (const auto& v : graph_.vertices) through.push_back(v.kind == Kind::crossing);
    graph_.arcs = join_links(links, through);
  }

  System_tree<K, D> tree_;
  Faces faces_;
  Graph_subdivision<K, D, Faces> cells_;
  Space_curve_graph<D> graph_;
};

} // namespace detail

/// The zero set of D-1 equations in D variables on the unit cell, where it is a curve: all its components, closed ones
/// included, certified; what could not be decided is listed, singular points among it, and tangencies to the boundary of
/// the unit cell. Causes and known factors of the system are not used. Needs upward rounding. A cell costs O(D·K²·n)
/// operations for n coefficients, and one search for points on the face of its cut.
template <int D>
Space_curve_graph<D> solve_space_curves(const System<D - 1, D>& system, const Solve_control& control = {},
                                        Claim_observer<D>* observer = nullptr)
{
  return detail::Space_curve_solver<D>(system, control, observer).run();
}

} // namespace locus

#endif
