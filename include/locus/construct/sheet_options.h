// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_OPTIONS_H
#define LOCUS_CONSTRUCT_SHEET_OPTIONS_H

#include <locus/construct/approximate_point.h>
#include <locus/function/checkpoint.h>
#include <locus/function/domain.h>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

namespace locus {

/// What a vertex of a sheet is given besides its point.
struct Vertex_description {
  std::vector<double> parameters;
  double radius = 0;
};

/// A part of a piece's unit square that need not be drawn, for a reason that the caller knows.
struct Sheet_hole {
  std::size_t piece = 0;
  Box<2> box;
};

/// How `rational_sheets` draws a surface.
struct Sheet_options {
  Approximate_point<3> centre;
  /// What is farther from the centre is left out; no vertex is farther than 9/8 of it and an error.
  double cut_radius = 10;
  double tolerance = 1e-6; ///< of the error, in the inputs' units
  /// To look at, in all; one more may be. First, but for half of the work at most, parts are divided that have no proved
  /// error yet, then always the one with the greatest. So where the cells do not suffice, the error is about even.
  std::size_t max_cells = 400000;
  /// Halvings of each variable, up to 30; a closed variable needs enough for four cells around. A cell that would need more
  /// is left as it is.
  int max_depth = 24;
  /// What is left where `max_cells` or `max_depth` ends the work is drawn if its error is proved to be up to this many
  /// tolerances, by default however great; `Sheet::error` tells it. The rest is undecided: where the weight may vanish, a
  /// vertex would be too far out, or the error is greater.
  double slack = std::numeric_limits<double>::infinity();
  /// The pieces cover a grid, the last index running fastest: piece i0·grid[1] + i1 lies at (i0, i1).
  std::array<std::size_t, 2> grid{1, 1};
  std::array<bool, 2> closed{false, false}; ///< in variable k the grid's last pieces are followed by the first
  /// Called once for each vertex with a piece that has it and its place in the piece's unit square. Without it: the values
  /// of the piece's own variables, and radius 0.
  std::function<Vertex_description(std::size_t piece, double u, double v, const Approximate_point<3>& point)> describe;
  std::vector<Sheet_hole> holes; ///< cells inside one are left out; the boundary there is "singular"
  Checkpoint checkpoint; ///< passed now and then; where it throws `Stopped`, the work ends as at `max_cells`
  /// Called now and then with the number of cells done and open.
  std::function<void(std::size_t done, std::size_t open)> progress;
};

namespace detail {

inline void check_sheet_options(const Sheet_options& o, std::size_t pieces)
{
  if (o.grid[0] == 0 || pieces % o.grid[0] != 0 || o.grid[1] != pieces / o.grid[0])
    throw std::invalid_argument("rational_sheets: the grid does not have as many places as the surface has pieces");
  if (o.max_depth < 0 || o.max_depth > 30) throw std::invalid_argument("rational_sheets: max_depth is from 0 to 30");
  for (std::size_t k = 0; k < 2; ++k)
    if (o.closed[k] && (o.grid[k] << o.max_depth) < 4)
      throw std::invalid_argument("rational_sheets: a closed variable needs four cells, so a greater max_depth");
  if (!(o.cut_radius > 0) || !(o.tolerance > 0))
    throw std::invalid_argument("rational_sheets: the cut radius and the tolerance are positive");
}

} // namespace detail
} // namespace locus

#endif
