// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_FRAMED_H
#define LOCUS_SHAPE_FRAMED_H

#include <locus/shape/frame.h>
#include <locus/shape/rational_curve.h>

#include <tuple>

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

/// Adds the corners of a piece's control polygon. Where weights are not all positive its hull says nothing: such a piece is
/// halved until they are, or, where it goes to infinity at an end, its finite control points are taken.
template <int Dim>
void collect_control_points(const Curve_piece<Dim>& piece, std::vector<Exact_point<Dim>>& points)
{
  const auto& w = piece.weight.coefficients();
  const bool positive = std::all_of(w.begin(), w.end(), [](const Rational& x) { return x > 0; });
  if (!positive && w.front() > 0 && w.back() > 0) {
    Curve_piece<Dim> halves[2];
    const auto cut = [](const Bernstein<Rational, 1>& f) { return split(f, 0, Rational(1, 2)); };
    for (std::size_t v = 0; v < piece.numerator.size(); ++v) std::tie(halves[0].numerator[v], halves[1].numerator[v]) = cut(piece.numerator[v]);
    std::tie(halves[0].weight, halves[1].weight) = cut(piece.weight);
    for (const auto& half : halves) collect_control_points(half, points);
    return;
  }
  for (std::size_t i = 0; i < piece.numerator[0].size(); ++i) {
    const Rational& weight = piece.weight[piece.is_polynomial() ? 0 : i];
    if (weight == 0) continue;
    Exact_point<Dim> p;
    for (std::size_t v = 0; v < p.size(); ++v) p[v] = piece.numerator[v][i] / weight;
    points.push_back(std::move(p));
  }
}

/// The same for a curve: frames and scales are taken from these points.
template <int Dim>
void collect_control_points(const Rational_curve<Dim>& curve, std::vector<Exact_point<Dim>>& points)
{
  for (const auto& piece : curve.pieces()) collect_control_points(piece, points);
}

} // namespace detail
} // namespace locus

#endif
