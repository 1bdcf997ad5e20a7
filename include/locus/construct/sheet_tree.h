// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_TREE_H
#define LOCUS_CONSTRUCT_SHEET_TREE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace locus::detail {

using Sheet_unit = std::uint32_t;
/// A place in a piece's square, in units of half a smallest cell, so that cells' middles are whole numbers too.
using Sheet_position = std::array<Sheet_unit, 2>;

enum class Sheet_cell : unsigned char {
  divided,
  outside,
  hole, ///< left out as asked for
  good,
  smallest,  ///< undecided: may not be split further
  unfinished ///< undecided: the limit of cells came first
};

constexpr bool is_undecided(Sheet_cell c) { return c == Sheet_cell::smallest || c == Sheet_cell::unfinished; }

/// A cell of a piece's square. All of a piece's cells make a tree of halves.
struct Sheet_node {
  Sheet_position low{}, size{};
  std::uint32_t link = 0; ///< of a divided cell the first of its two children, of an undecided one its cluster
  Sheet_cell state = Sheet_cell::unfinished;
  std::uint8_t variable = 0;

  Sheet_unit high(std::size_t k) const { return low[k] + size[k]; }
};

using Sheet_tree = std::vector<Sheet_node>;

/// Part of the line where variable `k` is `at`.
struct Sheet_line {
  std::size_t k = 0;
  Sheet_unit at = 0, lo = 0, hi = 0;
};

/// Visits the cells that touch the line on one side.
template <class Visit>
void visit_along(const Sheet_tree& tree, std::uint32_t index, const Sheet_line& line, bool above, const Visit& visit)
{
  const Sheet_node& n = tree[index];
  if (n.state != Sheet_cell::divided) return visit(index);
  const Sheet_unit cut = tree[n.link].high(n.variable);
  if (n.variable == line.k)
    return visit_along(tree, n.link + (above ? line.at >= cut : line.at > cut), line, above, visit);
  if (line.lo < cut) visit_along(tree, n.link, line, above, visit);
  if (line.hi > cut) visit_along(tree, n.link + 1, line, above, visit);
}

} // namespace locus::detail

#endif
