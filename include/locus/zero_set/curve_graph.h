// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CURVE_GRAPH_H
#define LOCUS_ZERO_SET_CURVE_GRAPH_H

#include <locus/number/filter_counts.h>
#include <locus/zero_set/cell_tree.h>
#include <locus/zero_set/points.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace locus {

/// A point of a plane zero set where its graph has a vertex.
struct Graph_vertex {
  enum class Kind : unsigned char {
    crossing, ///< a smooth point on a face between two cells; arcs run through it
    boundary, ///< a point on the boundary of the unit cell
    node,     ///< two smooth branches cross
    end,      ///< a crossing on the boundary of the unit cell of which one half-branch lies inside
    mark,     ///< a smooth point that a cause singles out (a pole of the map to the plane)
    isolated, ///< the zero set meets the unit cell's boundary in this point only
    open      ///< an arc ends at an undecided box
  };
  Kind kind = Kind::crossing;
  std::array<Interval, 2> at{Interval(0), Interval(0)}; ///< enclosure, in the unit cell
  int cause = -1;             ///< for nodes and marks: index into the special points
  bool is_mark = false;       ///< a boundary point that is a mark as well
  std::vector<std::size_t> half_branches; ///< pieces in cyclic order, for nodes
};

/// A stretch of an arc in one cell. In a graph cell the arc is a function of variable `base` (1 - pivot) between two
/// vertices; in a node's cell (`is_half_branch`) it joins the node to the cell's boundary.
struct Graph_piece {
  detail::Cell_tree::Index cell = 0;
  int base = 0;
  bool is_half_branch = false;
  std::size_t from = 0, to = 0; ///< vertices
  int multiplicity = 1;         ///< the power of the equation's factor that vanishes on it
};

/// A maximal chain of pieces. Closed arcs have no end vertices.
struct Graph_arc {
  struct Step {
    std::size_t piece;
    bool reversed;
  };
  std::vector<Step> steps;
  bool closed = false;
  std::size_t source = 0, target = 0; ///< vertices; for a closed arc both the one where listing starts
  int multiplicity = 1;               ///< as its pieces'
};

struct Undecided_box {
  Box<2> box;
  std::string reason;
};

struct Solve_statistics {
  std::size_t cells = 0;       ///< cells that were examined
  std::size_t leaves = 0;      ///< cells that were decided or given up
  std::size_t point_cells = 0; ///< cells of the solves for causes
  std::uint64_t exact_cells = 0;
  Filter_counts filter;

  Solve_statistics& operator+=(const Solve_statistics& s)
  {
    cells += s.cells;
    leaves += s.leaves;
    point_cells += s.point_cells;
    exact_cells += s.exact_cells;
    filter += s.filter;
    return *this;
  }
};

/// The zero set of one equation on the unit cell, as an embedded graph, together with the cells that prove it.
struct Curve_graph {
  bool identically_zero = false;
  std::vector<Graph_vertex> vertices;
  std::vector<Graph_piece> pieces;
  std::vector<Graph_arc> arcs;
  std::vector<Isolated_point> special; ///< solutions of the causes
  std::vector<Undecided_box> undecided;
  Solve_statistics statistics;
  std::shared_ptr<const Equation<2>> equation; ///< as solved: without repeated factors
  /// Polynomial on each piece's cell: kept for refinement, read-only.
  struct Cell_form {
    /// Smaller boxes lie near singular points, where doubles tell little: their forms are rounded from exact ones.
    static constexpr double exact_below = 0x1p-12;

    Box<2> box;
    Bernstein<Bounded, 2> f;
    std::shared_ptr<const Equation<2>> equation;
  };
  std::vector<Cell_form> forms; ///< one for each piece

  bool is_certified() const { return undecided.empty(); }
  std::size_t components() const;
};

/// Number of connected components of the graph (nodes connect their branches).
inline std::size_t Curve_graph::components() const
{
  std::vector<std::size_t> parent(vertices.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<char> used(vertices.size(), 0);
  for (const Graph_piece& p : pieces) {
    used[p.from] = used[p.to] = 1;
    parent[find(p.from)] = find(p.to);
  }
  std::size_t n = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) n += used[i] && find(i) == i;
  return n;
}

} // namespace locus

#endif
