// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_RATIONAL_SHEETS_H
#define LOCUS_CONSTRUCT_RATIONAL_SHEETS_H

#include <locus/construct/locus.h>
#include <locus/construct/sheet.h>
#include <locus/construct/sheet_cells.h>
#include <locus/construct/sheet_clusters.h>
#include <locus/construct/sheet_ends.h>
#include <locus/construct/sheet_grid.h>
#include <locus/construct/sheet_options.h>
#include <locus/construct/sheet_sites.h>
#include <locus/construct/sheet_triangles.h>
#include <locus/construct/sheet_writer.h>
#include <locus/number/interval.h>
#include <locus/shape/rational_map.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace locus {

/// A surface as sheets, and the boxes of its parameters about which nothing is claimed.
struct Sheets {
  std::vector<Sheet> sheets;
  std::vector<Undecided_piece> undecided;
  std::size_t cells = 0; ///< looked at
};

/// Draws a rational surface as triangles with a proved error. All of the surface that is nearer to the centre than the cut
/// radius, except in the holes and the undecided boxes, is within the error of the sheets. Neighbouring pieces are joined
/// where their common side is proved to be the same curve with the same parameter; which triangles hang together is decided
/// by the parameters alone. A side that is one point of space stays a boundary loop of length zero.
inline Sheets rational_sheets(const Rational_map<3, 2>& surface, const Sheet_options& options)
{
  Sheets result;
  const auto& pieces = surface.pieces();
  if (pieces.empty()) return result;
  detail::check_sheet_options(options, pieces.size());
  detail::Sheet_cells cells = with_upward_rounding([&] { return detail::Sheet_cells(pieces, options); });
  const detail::Sheet_grid grid(pieces, options);
  detail::Sheet_sites sites(std::move(cells.corners), grid, pieces.size(), cells.full_size());
  const std::vector<detail::Sheet_triangle> triangles = detail::Sheet_triangles(cells, sites).take();
  const detail::Sheet_clusters clusters(pieces, cells);
  result.sheets =
    detail::Sheet_writer(pieces, options, cells, sites, triangles).write(detail::Sheet_ends(cells, grid, clusters));
  result.undecided = clusters.listed();
  result.cells = cells.count;
  return result;
}

} // namespace locus

#endif
