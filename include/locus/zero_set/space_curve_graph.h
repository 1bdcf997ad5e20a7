// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SPACE_CURVE_GRAPH_H
#define LOCUS_ZERO_SET_SPACE_CURVE_GRAPH_H

#include <locus/zero_set/arc_joining.h>
#include <locus/zero_set/graph_cells.h>

namespace locus {

/// A point of a curve where it passes from one cell to another, or meets the boundary of the unit cell.
template <int D>
struct Space_vertex {
  enum class Kind : unsigned char {
    crossing, ///< on a face between two cells; an arc runs through it
    boundary, ///< on the boundary of the unit cell, where an arc ends
    isolated, ///< the curve meets the unit cell in this point of an edge or a corner only
    open      ///< an arc ends at an undecided box, or where nothing is wanted
  };
  Kind kind = Kind::crossing;
  std::array<Interval, static_cast<std::size_t>(D)> at; ///< enclosure
};

/// A stretch of the curve in one cell, where the pivots are functions of the variable `base`: from the lower to the
/// higher base value, and all of the curve that the cell holds between them.
template <int D>
struct Space_piece {
  Box<D> box;
  Pivot_set<D - 1> pivots;
  int base = 0;
  std::size_t from = 0, to = 0; ///< vertices
};

/// The zero set of D-1 equations in D variables on the unit cell as a graph. Where nothing is undecided it is complete and
/// isotopic to the zero set: each arc is one of its components, closed or between two vertices.
template <int D>
struct Space_curve_graph {
  std::vector<Space_vertex<D>> vertices;
  std::vector<Space_piece<D>> pieces;
  std::vector<Joined_arc> arcs; ///< chains of pieces: `link` is a piece's index
  std::vector<Undecided_cell<D>> undecided;
  Graph_statistics statistics;

  bool is_certified() const { return undecided.empty(); }

  std::size_t closed_arcs() const
  {
    std::size_t n = 0;
    for (const Joined_arc& arc : arcs) n += arc.closed;
    return n;
  }

  std::size_t count(typename Space_vertex<D>::Kind kind) const
  {
    std::size_t n = 0;
    for (const Space_vertex<D>& v : vertices) n += v.kind == kind;
    return n;
  }
};

} // namespace locus

#endif
