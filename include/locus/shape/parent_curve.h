// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_PARENT_CURVE_H
#define LOCUS_SHAPE_PARENT_CURVE_H

#include <locus/shape/constructors_2.h>
#include <locus/shape/monomial_curve.h>

#include <algorithm>

namespace locus {

/// One range of a parent curve, with its forms; it may hold poles.
struct Parent_piece {
  Curve_piece<2> forms;
  Piece range;
  bool is_own = false; ///< part of the given curve
};

namespace detail {

/// Coefficients of 1, u, u², … of a form on a range, up to a factor that depends on the range and the degree alone.
inline Coefficient_list on_line(const Piece& range, const Bernstein<Rational, 1>& f)
{
  const Homogeneous_parameter start = start_of(range), finish = finish_of(range);
  Coefficient_list c;
  for (int i = 0; i <= f.degree(); ++i) c.push_back(f[static_cast<std::size_t>(i)] * binomial<Rational>(f.degree(), i));
  return substitute_lines(c, {Rational(-finish.x), finish.y}, {start.x, Rational(-start.y)});
}

} // namespace detail

/// The whole line's curve of which a curve is a part: its rational functions for all parameters, in ranges that are cut at the
/// given curve's own. Poles are not looked for. Throws Invalid_input where the pieces are not of one rational function.
inline std::vector<Parent_piece> parent_pieces(const Curve_2& curve)
{
  const Chain& chain = curve.chain();
  for (std::size_t k = 0; k + 1 < chain.pieces.size(); ++k)
    if (chain.joints[k].kind != Joint_kind::pole && chain.joints[k].order != Joint::any_order)
      throw Invalid_input("", "a curve of several functions has no continuation beyond its ends", "give a single Bézier curve or one in monomial form");
  const Curve_piece<2> first = detail::homogenised(curve.pieces()[0]);
  detail::Monomial_forms<2> forms;
  for (std::size_t k = 0; k < 2; ++k) forms.numerator[k] = detail::on_line(chain.pieces[0], first.numerator[k]);
  forms.weight = detail::on_line(chain.pieces[0], first.weight);
  std::vector<Rational> cuts;
  for (const Piece& p : chain.pieces) {
    if (!p.lo_infinite) cuts.push_back(p.lo);
    if (!p.hi_infinite) cuts.push_back(p.hi);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<Parent_piece> pieces;
  for (const Piece& range : detail::ranges_over({}, cuts)) {
    Parent_piece piece{detail::piece_over(range, forms), range, false};
    const Rational inside = *range.at(Rational(1, 2));
    piece.is_own = std::any_of(chain.pieces.begin(), chain.pieces.end(), [&](const Piece& p) { return p.contains(inside); });
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

} // namespace locus

#endif
