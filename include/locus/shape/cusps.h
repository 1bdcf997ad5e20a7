// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_CUSPS_H
#define LOCUS_SHAPE_CUSPS_H

#include <locus/function/rational_root.h>
#include <locus/shape/joints.h>
#include <locus/shape/velocity.h>

namespace locus {

namespace detail {

/// The common factor of the coordinates of p'w - pw', as a polynomial in the local coordinate.
template <int Dim>
Integer_polynomial standstill_factor(const Curve_piece<Dim>& piece)
{
  Integer_polynomial common;
  for (const auto& p : piece.numerator) {
    const Bernstein<Rational, 1> d = velocity_numerator(p, piece.weight);
    if (all_of_one_sign(d)) return {Integer(1)};
    common = gcd(common, monomial_form(Bernstein<Scaled_integer, 1>(d)));
    if (degree(common) == 0) return common;
  }
  return common;
}

/// Local coordinates strictly inside a piece, rational ones only, where the first derivative vanishes.
template <int Dim>
std::vector<Rational> rational_cusps(const Curve_piece<Dim>& piece)
{
  std::vector<Rational> cusps;
  const Integer_polynomial common = standstill_factor(piece);
  if (degree(common) < 1) return cusps;
  for (const auto& root : exact_roots(bernstein_form(common), Rational(0), Rational(1)).roots) {
    const auto value = rational_value(root);
    if (value && *value > 0 && *value < 1) cusps.push_back(*value);
  }
  return cusps;
}

/// Cuts the pieces where the curve stands still inside them, at rational parameters.
template <int Dim>
void cut_at_cusps(std::vector<Curve_piece<Dim>>& pieces, std::vector<Piece>& ranges)
{
  std::vector<Curve_piece<Dim>> cut;
  std::vector<Piece> cut_ranges;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    Piece rest = ranges[k];
    for (const Rational& s : rational_cusps(pieces[k])) {
      const auto parts = split_range(rest, *ranges[k].at(s));
      cut.push_back(part_over(pieces[k], ranges[k], parts[0]));
      cut_ranges.push_back(parts[0]);
      rest = parts[1];
    }
    cut.push_back(part_over(pieces[k], ranges[k], rest));
    cut_ranges.push_back(rest);
  }
  pieces = std::move(cut);
  ranges = std::move(cut_ranges);
}

} // namespace detail

/// The same curve, its pieces cut where the first derivative vanishes at a rational parameter inside them: there the curve
/// reverses (a cusp, a corner of the result) or only stands still (a g1 joint). Cusps at irrational parameters stay inside
/// their pieces. Joints are found out anew, without tolerance.
template <int Dim>
Rational_curve<Dim> split_at_cusps(const Rational_curve<Dim>& curve)
{
  std::vector<Curve_piece<Dim>> pieces = curve.pieces();
  std::vector<Piece> ranges = curve.chain().pieces;
  detail::cut_at_cusps(pieces, ranges);
  return joined_curve(std::move(pieces), std::move(ranges), curve.chain().is_closed());
}

} // namespace locus

#endif
