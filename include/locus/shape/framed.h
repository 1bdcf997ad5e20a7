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

/// The same point by forms whose greatest coefficient is about one: they may be of any size.
template <int Dim>
Curve_piece<Dim> with_unit_forms(Curve_piece<Dim> piece)
{
  Rational greatest = 0;
  const auto look_at = [&](const Bernstein<Rational, 1>& f) {
    for (const Rational& c : f.coefficients()) greatest = std::max(greatest, Rational(abs(c)));
  };
  for (const auto& f : piece.numerator) look_at(f);
  look_at(piece.weight);
  const long bits = static_cast<long>(mpz_sizeinbase(greatest.get_num_mpz_t(), 2)) - static_cast<long>(mpz_sizeinbase(greatest.get_den_mpz_t(), 2));
  Rational factor = 1;
  if (bits >= 0) mpq_div_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(bits));
  else mpq_mul_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(-bits));
  for (auto& f : piece.numerator) f = multiply(f, factor);
  piece.weight = multiply(piece.weight, factor);
  return piece;
}

/// Throws Unsupported_feature where lengths in a frame have no place among doubles.
template <int Dim>
void require_drawable(const Frame<Dim>& frame)
{
  constexpr long most = 1000; // squares are formed in the frame, lengths outside of it
  bool good = std::abs(frame.exponent) <= most;
  for (const Rational& x : frame.origin)
    good = good && mpz_sizeinbase(x.get_num_mpz_t(), 2) <= mpz_sizeinbase(x.get_den_mpz_t(), 2) + static_cast<std::size_t>(most);
  if (!good) throw Unsupported_feature("coordinates beyond 1e300, or all within 1e-300, in what is to be drawn");
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
