// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_FOLDS_H
#define LOCUS_SHAPE_FOLDS_H

#include <locus/function/bernstein_operators.h>
#include <locus/shape/cusps.h>

namespace locus {

namespace detail {

/// A straight piece: its ends, or nothing if it is not straight or not finite at both ends.
template <int Dim>
std::optional<std::array<Exact_point<Dim>, 2>> ends_of_straight(const Curve_piece<Dim>& piece)
{
  const std::size_t weights = piece.weight.size();
  if (piece.weight[0] == 0 || piece.weight[weights - 1] == 0) return std::nullopt;
  std::array<Exact_point<Dim>, 2> ends;
  for (std::size_t k = 0; k < Dim; ++k) {
    ends[0][k] = piece.numerator[k][0] / piece.weight[0];
    ends[1][k] = piece.numerator[k][piece.numerator[k].size() - 1] / piece.weight[weights - 1];
  }
  // p w-multiples of ends[0] apart from p must be multiples of the chord.
  std::array<Bernstein<Rational, 1>, Dim> off;
  using namespace operators;
  for (std::size_t k = 0; k < Dim; ++k) off[k] = piece.numerator[k] - multiply(piece.weight, ends[0][k]);
  for (std::size_t k = 0; k < Dim; ++k)
    for (std::size_t l = k + 1; l < Dim; ++l) {
      const Bernstein<Rational, 1> cross = multiply(off[k], Rational(ends[1][l] - ends[0][l])) - multiply(off[l], Rational(ends[1][k] - ends[0][k]));
      for (const Rational& c : cross.coefficients())
        if (c != 0) return std::nullopt;
    }
  return ends;
}

/// Whether a straight piece that runs from `from` to `to` holds a point of its line.
template <int Dim>
bool holds(const std::array<Exact_point<Dim>, 2>& ends, const Exact_point<Dim>& p)
{
  Rational along = 0, length = 0, off = 0;
  for (std::size_t k = 0; k < Dim; ++k) {
    const Rational d = ends[1][k] - ends[0][k], x = p[k] - ends[0][k];
    along += d * x;
    length += d * d;
    off += x * x;
  }
  return along >= 0 && along <= length && along * along == off * length;
}

} // namespace detail

/// The same set of points: cut at cusps at rational parameters, and without straight pieces at an open end that only run back over
/// the piece beside them. The ranges of the other pieces stay.
template <int Dim>
Rational_curve<Dim> without_folds(const Rational_curve<Dim>& curve)
{
  std::vector<Curve_piece<Dim>> pieces = curve.pieces();
  std::vector<Piece> ranges = curve.chain().pieces;
  detail::cut_at_cusps(pieces, ranges);
  if (pieces.size() == curve.pieces().size() && (pieces.size() == 1 || curve.chain().is_closed())) return curve;
  bool is_shorter = false;
  const auto is_covered = [&](std::size_t i, std::size_t by) {
    const auto own = detail::ends_of_straight(pieces[i]), other = detail::ends_of_straight(pieces[by]);
    return own && other && detail::holds<Dim>(*other, (*own)[0]) && detail::holds<Dim>(*other, (*own)[1]);
  };
  const auto drop = [&](std::size_t i) {
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(i));
    ranges.erase(ranges.begin() + static_cast<std::ptrdiff_t>(i));
    is_shorter = true;
  };
  if (!curve.chain().is_closed()) {
    while (pieces.size() > 1 && is_covered(pieces.size() - 1, pieces.size() - 2)) drop(pieces.size() - 1);
    while (pieces.size() > 1 && is_covered(0, 1)) drop(0);
  }
  if (!is_shorter && pieces.size() == curve.pieces().size()) return curve;
  return joined_curve(std::move(pieces), std::move(ranges), curve.chain().is_closed());
}

} // namespace locus

#endif
