// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_CLUSTERS_H
#define LOCUS_CONSTRUCT_SHEET_CLUSTERS_H

#include <locus/construct/locus.h>
#include <locus/construct/sheet_cells.h>
#include <locus/construct/sheet_classes.h>
#include <locus/function/bernstein_operations.h>
#include <locus/number/interval.h>
#include <locus/shape/rational_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace locus::detail {

/// A box around undecided cells of a piece that hang together.
struct Sheet_cluster {
  std::uint32_t piece = 0;
  Sheet_position low{}, high{};
  bool smallest = false;     ///< some cell may not be split further
  bool zero_by_zero = false; ///< proved to hold a point where the numerator and the weight vanish
};

/// Gathers the undecided cells into clusters, for short lists, and says why they are undecided. An undecided cell's link
/// becomes its cluster.
class Sheet_clusters {
public:
  Sheet_clusters(const std::vector<Rational_map_piece<3, 2>>& pieces, Sheet_cells& cells)
    : pieces_(pieces), full_(cells.full_size())
  {
    for (std::uint32_t i = 0; i < pieces.size(); ++i) gather(i, cells.trees[i]);
  }

  const Sheet_cluster& operator[](std::size_t i) const { return clusters_[i]; }

  std::vector<Undecided_piece> listed() const
  {
    std::vector<Undecided_piece> list;
    for (const Sheet_cluster& c : clusters_) {
      Undecided_piece u;
      for (std::size_t k = 0; k < 2; ++k) u.box.push_back(range(pieces_[c.piece].range[k], c.low[k], c.high[k]));
      u.reason = c.zero_by_zero ? "the surface is 0/0 at a point of this box"
                 : c.smallest   ? "the surface is 0/0, goes to infinity or is too steep in this box"
                                : "the limit of cells or time was reached in this box";
      list.push_back(std::move(u));
    }
    return list;
  }

private:
  void gather(std::uint32_t piece, Sheet_tree& tree)
  {
    const std::vector<std::uint32_t> found = numbered(tree);
    Sheet_classes classes(found.size());
    for (const std::uint32_t i : found) unite_with_next(tree, i, classes);
    std::vector<std::uint32_t> cluster_of(found.size());
    for (std::uint32_t i = 0; i < found.size(); ++i) {
      const std::uint32_t first = classes.find(i);
      cluster_of[i] = first == i ? new_cluster(piece, tree[found[i]]) : cluster_of[first];
      extend(cluster_of[i], tree[found[i]]);
    }
    for (const std::uint32_t i : found) tree[i].link = cluster_of[tree[i].link];
  }

  /// The undecided cells; the link of each becomes its place in the list.
  static std::vector<std::uint32_t> numbered(Sheet_tree& tree)
  {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < tree.size(); ++i)
      if (is_undecided(tree[i].state)) {
        tree[i].link = static_cast<std::uint32_t>(found.size());
        found.push_back(i);
      }
    return found;
  }

  /// With the undecided cells across its high sides.
  void unite_with_next(const Sheet_tree& tree, std::uint32_t i, Sheet_classes& classes) const
  {
    for (std::size_t k = 0; k < 2; ++k) {
      if (tree[i].high(k) == full_) continue;
      const Sheet_line side{k, tree[i].high(k), tree[i].low[1 - k], tree[i].high(1 - k)};
      visit_along(tree, 0, side, true, [&](std::uint32_t j) {
        if (is_undecided(tree[j].state)) classes.unite(tree[i].link, tree[j].link);
      });
    }
  }

  std::uint32_t new_cluster(std::uint32_t piece, const Sheet_node& n)
  {
    Sheet_cluster c;
    c.piece = piece;
    c.low = n.low;
    c.high = {n.high(0), n.high(1)};
    clusters_.push_back(c);
    return static_cast<std::uint32_t>(clusters_.size() - 1);
  }

  void extend(std::uint32_t number, const Sheet_node& n)
  {
    Sheet_cluster& c = clusters_[number];
    for (std::size_t k = 0; k < 2; ++k) {
      c.low[k] = std::min(c.low[k], n.low[k]);
      c.high[k] = std::max(c.high[k], n.high(k));
    }
    if (n.state != Sheet_cell::smallest) return;
    c.smallest = true;
    // Exact and slow, so only a number of times. What is missed is called undecided, which it is.
    if (c.zero_by_zero || trials_ == 0) return;
    --trials_;
    for (const Sheet_unit u : {n.low[0], n.high(0)})
      for (const Sheet_unit v : {n.low[1], n.high(1)})
        c.zero_by_zero = c.zero_by_zero || is_zero_by_zero(c.piece, u, v);
  }

  bool is_zero_by_zero(std::uint32_t piece, Sheet_unit u, Sheet_unit v) const
  {
    const std::array<Rational, 2> at{local(u), local(v)};
    const auto& p = pieces_[piece];
    if (evaluate(p.weight, at) != 0) return false;
    return std::all_of(p.numerator.begin(), p.numerator.end(), [&](const auto& f) { return evaluate(f, at) == 0; });
  }

  Rational local(Sheet_unit at) const
  {
    Rational x(at, full_);
    x.canonicalize();
    return x;
  }

  Range range(const Piece& piece, Sheet_unit low, Sheet_unit high) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto lo = piece.at(local(low)), hi = piece.at(local(high));
    return {lo ? enclosing(*lo).inf() : -infinity, hi ? enclosing(*hi).sup() : infinity};
  }

  const std::vector<Rational_map_piece<3, 2>>& pieces_;
  Sheet_unit full_;
  std::vector<Sheet_cluster> clusters_;
  int trials_ = 256;
};

} // namespace locus::detail

#endif
