// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_ENDS_H
#define LOCUS_CONSTRUCT_SHEET_ENDS_H

#include <locus/construct/sheet_cells.h>
#include <locus/construct/sheet_clusters.h>
#include <locus/construct/sheet_grid.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace locus::detail {

/// Why there is no triangle across an edge; a loop is named after the greatest.
enum class Sheet_end : unsigned char { domain, undecided, singular, infinity };

constexpr const char* name_of(Sheet_end e)
{
  constexpr const char* names[] = {"domain", "undecided", "singular", "infinity"};
  return names[static_cast<std::size_t>(e)];
}

/// Looks up what lies across a side of a drawn cell.
class Sheet_ends {
public:
  Sheet_ends(const Sheet_cells& cells, const Sheet_grid& grid, const Sheet_clusters& clusters)
    : cells_(cells), grid_(grid), clusters_(clusters)
  {
  }

  Sheet_end across(const Sheet_leaf& leaf, const Sheet_site& a, const Sheet_site& b) const
  {
    const Sheet_node& n = cells_.trees[leaf.piece][leaf.node];
    const std::size_t k = a.at[0] == b.at[0] ? 0 : 1;
    const bool high = a.at[k] == n.high(k);
    Sheet_line line{k, a.at[k], std::min(a.at[1 - k], b.at[1 - k]), std::max(a.at[1 - k], b.at[1 - k])};
    std::uint32_t piece = leaf.piece;
    if (line.at == (high ? cells_.full_size() : 0)) {
      const auto next = grid_.across(piece, k, high);
      if (!next) return Sheet_end::domain;
      piece = *next;
      line.at = high ? 0 : cells_.full_size();
    }
    Sheet_end end = Sheet_end::domain;
    const Sheet_tree& tree = cells_.trees[piece];
    visit_along(tree, 0, line, high, [&](std::uint32_t i) { end = std::max(end, cause(tree[i])); });
    return end;
  }

private:
  Sheet_end cause(const Sheet_node& n) const
  {
    if (n.state == Sheet_cell::outside) return Sheet_end::infinity;
    if (n.state == Sheet_cell::hole) return Sheet_end::singular;
    return is_undecided(n.state) && clusters_[n.link].zero_by_zero ? Sheet_end::singular : Sheet_end::undecided;
  }

  const Sheet_cells& cells_;
  const Sheet_grid& grid_;
  const Sheet_clusters& clusters_;
};

} // namespace locus::detail

#endif
