// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_DOMAIN_CELLS_H
#define LOCUS_ZERO_SET_DOMAIN_CELLS_H

#include <locus/zero_set/patchwork.h>

#include <optional>
#include <set>

namespace locus {

/// The cells of a domain of two variables, each a pair of pieces, and how they lie beside each other. Where both chains are
/// one (`is_self`), the cells (i, j) with i ≥ j stand for the unordered pairs.
class Domain_cells {
public:
  Domain_cells(Domain<2> domain, bool is_self) : domain_(std::move(domain)), is_self_(is_self) {}

  bool is_self() const { return is_self_; }
  /// Number of the cell of two pieces.
  std::size_t cell(std::size_t i, std::size_t j) const { return i * chain(1).pieces.size() + j; }

  /// All glued sides of the cells that have patches.
  std::vector<Glued_sides> glued(const std::vector<Patch>& patches) const
  {
    std::set<std::size_t> cells;
    for (const Patch& p : patches) cells.insert(p.cell);
    std::vector<Glued_sides> glued;
    for (const std::size_t c : cells)
      for (const int variable : {0, 1})
        for (const int end : {0, 1}) {
          const Glued_sides::Side side{c, variable, end};
          const auto behind = side_behind(side);
          // Two cells with patches find their common side twice.
          if (!behind || (cells.count(behind->cell) != 0 && key(*behind) < key(side))) continue;
          const std::size_t piece = variable == 0 ? c / chain(1).pieces.size() : c % chain(1).pieces.size();
          glued.push_back({side, *behind, chain(variable).joint_at(piece, end)->by_tolerance});
        }
    return glued;
  }

private:
  const Chain& chain(int variable) const { return domain_.chains[static_cast<std::size_t>(variable)]; }

  static std::array<std::size_t, 3> key(const Glued_sides::Side& s)
  {
    return {s.cell, static_cast<std::size_t>(s.variable), static_cast<std::size_t>(s.end)};
  }

  /// The side of another cell that is one line with this one, if the zero set goes on across it.
  std::optional<Glued_sides::Side> side_behind(const Glued_sides::Side& s) const
  {
    const std::size_t i = s.cell / chain(1).pieces.size(), j = s.cell % chain(1).pieces.size();
    // Of a cell (i, i) the sides t = 0 and r = 1 lie beyond the diagonal.
    if (is_self_ && i == j && (s.variable == 0) == (s.end == 0)) return std::nullopt;
    if (!chain(s.variable).goes_on_at(s.variable == 0 ? i : j, s.end)) return std::nullopt;
    const std::size_t n = chain(0).pieces.size();
    // Across the seam of a curve with itself the parameters change places.
    if (is_self_ && s.variable == 0 && s.end == 1 && i + 1 == n) return Glued_sides::Side{cell(j, 0), 1, 0};
    if (is_self_ && s.variable == 1 && s.end == 0 && j == 0) return Glued_sides::Side{cell(n - 1, i), 0, 1};
    if (s.variable == 0) return Glued_sides::Side{cell(chain(0).neighbour(i, s.end), j), 0, 1 - s.end};
    return Glued_sides::Side{cell(i, chain(1).neighbour(j, s.end)), 1, 1 - s.end};
  }

  Domain<2> domain_;
  bool is_self_;
};

} // namespace locus

#endif
