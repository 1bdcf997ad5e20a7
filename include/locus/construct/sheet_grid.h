// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_GRID_H
#define LOCUS_CONSTRUCT_SHEET_GRID_H

#include <locus/construct/sheet_options.h>
#include <locus/function/bernstein_operations.h>
#include <locus/shape/rational_map.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace locus::detail {

inline bool same_end(const Rational& a, bool a_infinite, const Rational& b, bool b_infinite)
{
  return a_infinite || b_infinite ? a_infinite == b_infinite : a == b;
}

/// Whether the side where variable `k` is 1 of one piece is, point by point, the side where it is 0 of the other.
inline bool have_common_side(const Rational_map_piece<3, 2>& a, const Rational_map_piece<3, 2>& b, int k)
{
  const auto wa = face(a.weight, k, true), wb = face(b.weight, k, false);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto off =
      subtract(multiply(face(a.numerator[i], k, true), wb), multiply(face(b.numerator[i], k, false), wa));
    for (const Rational& c : off.coefficients())
      if (c != 0) return false;
  }
  return true;
}

/// Which sides of the pieces are joined.
class Sheet_grid {
public:
  Sheet_grid(const std::vector<Rational_map_piece<3, 2>>& pieces, const Sheet_options& options)
    : pieces_(pieces), size_(options.grid), closed_(options.closed), joined_(pieces.size())
  {
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) joined_[i][k] = is_joint(i, k);
  }

  /// The piece across a side that is joined.
  std::optional<std::uint32_t> across(std::uint32_t piece, std::size_t k, bool high) const
  {
    if (high) return joined_[piece][k] ? std::optional(neighbour(piece, k, 1)) : std::nullopt;
    const std::uint32_t before = neighbour(piece, k, size_[k] - 1);
    return joined_[before][k] ? std::optional(before) : std::nullopt;
  }

private:
  std::size_t index(std::uint32_t piece, std::size_t k) const { return k == 0 ? piece / size_[1] : piece % size_[1]; }
  std::uint32_t neighbour(std::uint32_t piece, std::size_t k, std::size_t step) const
  {
    std::array<std::size_t, 2> at{index(piece, 0), index(piece, 1)};
    at[k] = (at[k] + step) % size_[k];
    return static_cast<std::uint32_t>(at[0] * size_[1] + at[1]);
  }

  bool is_joint(std::uint32_t piece, std::size_t k) const
  {
    const bool last = index(piece, k) + 1 == size_[k];
    if (last && !closed_[k]) return false;
    const auto &a = pieces_[piece], &b = pieces_[neighbour(piece, k, 1)];
    const Piece &along = a.range[1 - k], &along_too = b.range[1 - k];
    if (!same_end(along.lo, along.lo_infinite, along_too.lo, along_too.lo_infinite) ||
        !same_end(along.hi, along.hi_infinite, along_too.hi, along_too.hi_infinite))
      return false;
    if (!last && !same_end(a.range[k].hi, a.range[k].hi_infinite, b.range[k].lo, b.range[k].lo_infinite)) return false;
    return have_common_side(a, b, static_cast<int>(k));
  }

  const std::vector<Rational_map_piece<3, 2>>& pieces_;
  std::array<std::size_t, 2> size_;
  std::array<bool, 2> closed_;
  std::vector<std::array<bool, 2>> joined_;
};

} // namespace locus::detail

#endif
