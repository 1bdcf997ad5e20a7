// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_FRAMED_H
#define LOCUS_SHAPE_FRAMED_H

#include <locus/shape/frame.h>
#include <locus/shape/rational_curve.h>

namespace locus {
namespace detail {

/// A piece in the coordinates of a frame.
template <int Dim>
Curve_piece<Dim> in_frame(Curve_piece<Dim> piece, const Frame<Dim>& frame)
{
  for (std::size_t v = 0; v < piece.numerator.size(); ++v) {
    Bernstein<Rational, 1>& x = piece.numerator[v];
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] -= frame.origin[v] * piece.weight[piece.is_polynomial() ? 0 : i];
      if (frame.exponent >= 0) mpq_div_2exp(x[i].get_mpq_t(), x[i].get_mpq_t(), static_cast<mp_bitcnt_t>(frame.exponent));
      else mpq_mul_2exp(x[i].get_mpq_t(), x[i].get_mpq_t(), static_cast<mp_bitcnt_t>(-frame.exponent));
    }
  }
  return piece;
}

/// Adds the corners of a curve's control polygon, from which frames and scales are taken.
template <int Dim>
void collect_control_points(const Rational_curve<Dim>& curve, std::vector<Exact_point<Dim>>& points)
{
  for (const auto& piece : curve.pieces())
    for (std::size_t i = 0; i < piece.numerator[0].size(); ++i) {
      const Rational w = piece.is_polynomial() ? piece.weight[0] : i < piece.weight.size() ? piece.weight[i] : Rational(0);
      if (w == 0) continue;
      Exact_point<Dim> p;
      for (std::size_t v = 0; v < p.size(); ++v) p[v] = piece.numerator[v][i] / w;
      points.push_back(std::move(p));
    }
}

} // namespace detail
} // namespace locus

#endif
