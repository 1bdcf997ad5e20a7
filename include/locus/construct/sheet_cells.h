// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_CELLS_H
#define LOCUS_CONSTRUCT_SHEET_CELLS_H

#include <locus/construct/sheet_bound.h>
#include <locus/construct/sheet_forms.h>
#include <locus/construct/sheet_options.h>
#include <locus/construct/sheet_split.h>
#include <locus/construct/sheet_tree.h>
#include <locus/function/checkpoint.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

namespace locus::detail {

/// A point of a piece that is a vertex.
struct Sheet_site {
  std::uint32_t piece = 0;
  Sheet_position at{};
  Sheet_place place;
};

/// A cell that is drawn.
struct Sheet_leaf {
  std::uint32_t piece = 0, node = 0;
  double error = 0; ///< of any interpolation on it, without its points' rounding
  Sheet_place middle;
};

/// Divides the pieces into cells until each is drawn, left out or undecided. Cells without an error come first, then the
/// greatest error: where the limit of cells ends the work, the error is about even. Upward rounding needed.
class Sheet_cells {
public:
  std::vector<Sheet_tree> trees;
  std::vector<Sheet_leaf> leaves;
  std::vector<Sheet_site> corners; ///< of the leaves, repeated
  std::size_t count = 0;

  Sheet_cells(const std::vector<Rational_map_piece<3, 2>>& pieces, const Sheet_options& options) : options_(options)
  {
    for (std::size_t k = 0; k < 2; ++k) largest_[k] = largest_size(k);
    trees.resize(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      trees[i].emplace_back();
      trees[i][0].size = {full_size(), full_size()};
      look_at(sheet_forms(pieces[i], options.centre), static_cast<std::uint32_t>(i), 0);
    }
    while (!(unsettled_.empty() && coarse_.empty()) && count < options_.max_cells && !stopped_) divide(next());
    for (const Open_cell& cell : coarse_)
      if (may_be_drawn(cell)) draw(cell);
    unsettled_.clear();
    coarse_.clear();
  }

  Sheet_unit full_size() const { return Sheet_unit{2} << options_.max_depth; }

private:
  struct Open_cell {
    Sheet_forms forms;
    std::uint32_t piece, node;
    double error = std::numeric_limits<double>::infinity(); ///< infinite where none is proved that the slack allows
    double rounding = 0;
  };

  /// Progress, and whether to go on: a checkpoint that throws `Stopped` ends the work as the limit of cells does.
  void tell()
  {
    with_nearest_rounding([&] {
      if (options_.progress) options_.progress(count, unsettled_.size() + coarse_.size());
      try {
        pass(options_.checkpoint);
      } catch (const Stopped&) {
        stopped_ = true;
      }
    });
  }

  static bool is_finer(const Open_cell& a, const Open_cell& b) { return a.error < b.error; }

  /// First cells that could not be drawn at all, those that have waited longest, so the larger ones, ahead. They take half of
  /// the work at most while others wait: near a line 0/0 they never end.
  Open_cell next()
  {
    if (!unsettled_.empty() && (2 * settled_ < options_.max_cells || coarse_.empty())) {
      ++settled_;
      Open_cell cell = std::move(unsettled_.front());
      unsettled_.pop_front();
      return cell;
    }
    std::pop_heap(coarse_.begin(), coarse_.end(), is_finer);
    Open_cell cell = std::move(coarse_.back());
    coarse_.pop_back();
    return cell;
  }

  void keep(Open_cell cell)
  {
    if (!std::isfinite(cell.error)) return unsettled_.push_back(std::move(cell));
    coarse_.push_back(std::move(cell));
    std::push_heap(coarse_.begin(), coarse_.end(), is_finer);
  }

  /// Around a closed variable at least four cells are wanted: an edge is known by its ends.
  Sheet_unit largest_size(std::size_t k) const
  {
    Sheet_unit size = full_size();
    if (options_.closed[k])
      for (std::size_t n = options_.grid[k]; n < 4 && size > 2; n *= 2) size /= 2;
    return size;
  }

  void look_at(Sheet_forms forms, std::uint32_t piece, std::uint32_t node)
  {
    if ((++count & 1023u) == 0) tell();
    Sheet_node& n = trees[piece][node];
    if (is_outside(forms, options_.cut_radius)) {
      n.state = Sheet_cell::outside;
      return;
    }
    if (is_in_hole(piece, n)) {
      n.state = Sheet_cell::hole;
      return;
    }
    Open_cell cell{std::move(forms), piece, node};
    const int variable = measure(cell, n);
    // A little is left to the rounding of vertices that a neighbour will add.
    if (cell.error + cell.rounding <= options_.tolerance * (1 - 0x1p-10)) return draw(cell);
    n.variable = static_cast<std::uint8_t>(variable);
    if (n.size[n.variable] > 2) keep(std::move(cell));
    else if (may_be_drawn(cell)) draw(cell);
    else n.state = Sheet_cell::smallest;
  }

  bool is_in_hole(std::uint32_t piece, const Sheet_node& n) const
  {
    const double unit = 1.0 / full_size();
    return std::any_of(options_.holes.begin(), options_.holes.end(), [&](const Sheet_hole& h) {
      for (std::size_t k = 0; k < 2; ++k)
        if (n.low[k] * unit < h.box.lo[k] || n.high(k) * unit > h.box.hi[k]) return false;
      return h.piece == piece;
    });
  }

  /// At the limits of the work.
  bool may_be_drawn(const Open_cell& cell) const
  {
    return std::isfinite(cell.error) && cell.error + cell.rounding <= options_.slack * options_.tolerance;
  }

  /// Finds the cell's error and the variable that is better split.
  int measure(Open_cell& cell, const Sheet_node& n)
  {
    if (!cell.forms.weight_has_a_sign()) return Split_choice::by_forms(cell.forms, options_.cut_radius);
    for (int k = 0; k < 2; ++k)
      if (n.size[static_cast<std::size_t>(k)] > largest_[static_cast<std::size_t>(k)]) return k;
    const double farthest = std::min(1.125 * options_.cut_radius, 1e150); // squares must not overflow
    for (std::size_t c = 0; c < 4; ++c) {
      const Sheet_place p = printed(cell.forms.corner(c), options_.centre);
      if (!(distance_from(p.at, options_.centre) <= farthest)) return Split_choice::by_length(cell.forms);
      cell.rounding = std::max(cell.rounding, p.radius);
    }
    cell.error = bound_(cell.forms, options_.slack * options_.tolerance);
    return Split_choice::by_bending(cell.forms);
  }

  void draw(const Open_cell& cell)
  {
    Sheet_node& n = trees[cell.piece][cell.node];
    n.state = Sheet_cell::good;
    leaves.push_back({cell.piece, cell.node, cell.error, printed(cell.forms.middle(), options_.centre)});
    for (std::size_t c = 0; c < 4; ++c)
      corners.push_back({cell.piece,
                         {c & 2 ? n.high(0) : n.low[0], c & 1 ? n.high(1) : n.low[1]},
                         printed(cell.forms.corner(c), options_.centre)});
  }

  void divide(const Open_cell& cell)
  {
    Sheet_tree& tree = trees[cell.piece];
    const auto child = static_cast<std::uint32_t>(tree.size());
    const std::size_t k = tree[cell.node].variable;
    Sheet_node part = tree[cell.node];
    part.size[k] /= 2;
    tree.push_back(part);
    part.low[k] += part.size[k];
    tree.push_back(part);
    tree[cell.node].link = child;
    tree[cell.node].state = Sheet_cell::divided;
    auto forms = cell.forms.split(static_cast<int>(k));
    look_at(std::move(forms.first), cell.piece, child);
    look_at(std::move(forms.second), cell.piece, child + 1);
  }

  const Sheet_options& options_;
  Sheet_position largest_{};
  std::deque<Open_cell> unsettled_; ///< may not be drawn: their error is infinite
  std::vector<Open_cell> coarse_;   ///< a heap, the greatest error on top
  std::size_t settled_ = 0;         ///< cells taken from `unsettled_`; two are looked at for each
  Interpolation_bound bound_;
  bool stopped_ = false;
};

} // namespace locus::detail

#endif
