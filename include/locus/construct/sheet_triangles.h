// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_TRIANGLES_H
#define LOCUS_CONSTRUCT_SHEET_TRIANGLES_H

#include <locus/construct/sheet_cells.h>
#include <locus/construct/sheet_sites.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace locus::detail {

struct Sheet_triangle {
  std::array<std::uint32_t, 3> site;
  std::uint32_t leaf;
};

/// The triangles of all drawn cells. A corner of one cell on a side of another is a vertex of both, so that they fit.
class Sheet_triangles {
public:
  Sheet_triangles(const Sheet_cells& cells, Sheet_sites& sites) : sites_(sites)
  {
    for (std::uint32_t i = 0; i < cells.leaves.size(); ++i) {
      const Sheet_leaf& leaf = cells.leaves[i];
      const Sheet_node& node = cells.trees[leaf.piece][leaf.node];
      find_outline(leaf.piece, node);
      if (outline_.size() == 4) add_two(i);
      else add_fan(i, leaf, node);
    }
  }

  std::vector<Sheet_triangle> take() { return std::move(triangles_); }

private:
  /// All vertices on the sides, turning left.
  void find_outline(std::uint32_t piece, const Sheet_node& n)
  {
    outline_.clear();
    forwards(sites_.on(piece, {1, n.low[1], n.low[0], n.high(0)}));
    forwards(sites_.on(piece, {0, n.high(0), n.low[1], n.high(1)}));
    backwards(sites_.on(piece, {1, n.high(1), n.low[0], n.high(0)}));
    backwards(sites_.on(piece, {0, n.low[0], n.low[1], n.high(1)}));
  }
  // Each side without its last vertex, which is the next one's first.
  void forwards(const Sheet_sites::Entries& side)
  {
    for (auto i = side.first; i + 1 != side.second; ++i) outline_.push_back(i->site);
  }
  void backwards(const Sheet_sites::Entries& side)
  {
    for (auto i = side.second; --i != side.first;) outline_.push_back(i->site);
  }

  /// Along the shorter diagonal, for the look of it.
  void add_two(std::uint32_t leaf)
  {
    const auto& o = outline_;
    const auto length = [&](std::size_t a, std::size_t b) {
      return distance_from(sites_.place(o[a]).at, sites_.place(o[b]).at);
    };
    const std::size_t s = length(0, 2) <= length(1, 3) ? 0 : 1;
    triangles_.push_back({{o[s], o[s + 1], o[s + 2]}, leaf});
    triangles_.push_back({{o[s], o[s + 2], o[(s + 3) % 4]}, leaf});
  }

  void add_fan(std::uint32_t index, const Sheet_leaf& leaf, const Sheet_node& n)
  {
    const std::uint32_t middle =
      sites_.add({leaf.piece, {n.low[0] + n.size[0] / 2, n.low[1] + n.size[1] / 2}, leaf.middle});
    for (std::size_t i = 0; i < outline_.size(); ++i)
      triangles_.push_back({{middle, outline_[i], outline_[(i + 1) % outline_.size()]}, index});
  }

  Sheet_sites& sites_;
  std::vector<std::uint32_t> outline_;
  std::vector<Sheet_triangle> triangles_;
};

} // namespace locus::detail

#endif
