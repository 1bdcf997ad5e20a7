// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_DERIVED_CURVES_H
#define LOCUS_CONSTRUCT_DERIVED_CURVES_H

#include <locus/constraint/curvature_forms.h>
#include <locus/shape/rational_map.h>

namespace locus {

// Curves that belong to a curve and are rational with it (Chen, Riesenfeld & Cohen, §3.3 and §4), each at its true degree: the
// formulas are those of (2.2) put in and reduced, and common factors are divided out. A piece of the curve gives a piece of
// the same range, unless nothing is defined there: straight pieces have no evolute, plane ones no focal curve.

namespace detail {

/// One map piece for each curve piece for which `make` gives one.
template <int Dim, class Make>
Rational_map<Dim, 1> map_of_pieces(const Rational_curve<Dim>& curve, Make make)
{
  std::vector<Rational_map_piece<Dim, 1>> pieces;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i)
    if (auto piece = make(curve.pieces()[i], std::array<Piece, 1>{curve.chain().pieces[i]})) pieces.push_back(std::move(*piece));
  return Rational_map<Dim, 1>(std::move(pieces));
}

/// A vector towards the centre of curvature and its factor: N̄/κ = S·normal/(size·w³). In the plane iD1 and β, in space
/// β×D1 and ⟨β,β⟩.
template <int Dim>
struct Normal_form {
  Polynomial_vector<1, static_cast<std::size_t>(Dim)> normal;
  Bernstein<Rational, 1> size;

  explicit Normal_form(const Curvature_forms<Dim>& f)
  {
    if constexpr (Dim == 2) {
      normal = turned_left(f.first);
      size = f.bend[0];
    } else {
      normal = cross(f.bend, f.first);
      size = square(f.bend);
    }
  }
};

} // namespace detail

/// The locus of the centres of curvature, x + N̄/κ, (3.6): (w²·size·p + S·normal)/(size·w³). Degree 6d-6 in the plane (3d-3 for
/// a polynomial curve), 9d-12 in space (5d-7). It is infinite at inflections; a plane curve's stands still where the curvature is
/// stationary.
template <int Dim>
Rational_map<Dim, 1> evolute_map(const Rational_curve<Dim>& curve)
{
  return detail::map_of_pieces(curve, [](const Curve_piece<Dim>& piece, const std::array<Piece, 1>& range) -> std::optional<Rational_map_piece<Dim, 1>> {
    using namespace operators;
    const Curvature_forms<Dim> f(piece);
    if (is_zero(f.bend)) return std::nullopt;
    const detail::Normal_form<Dim> n(f);
    const Bernstein<Rational, 1> w2 = piece.weight * piece.weight;
    return rational_map_piece<Dim, 1>((w2 * n.size) * piece.numerator + f.speed * n.normal, n.size * w2 * piece.weight, range);
  });
}

/// The vector κN̄ = w³·(⟨β,β⟩/size)·normal/S² along the curve: the second derivative by arc length. Degree 8d-8 (4d-4 for a
/// polynomial curve). Defined everywhere; zero on straight pieces.
template <int Dim>
Rational_map<Dim, 1> curvature_vector_map(const Rational_curve<Dim>& curve)
{
  return detail::map_of_pieces(curve, [](const Curve_piece<Dim>& piece, const std::array<Piece, 1>& range) -> std::optional<Rational_map_piece<Dim, 1>> {
    using namespace operators;
    const Curvature_forms<Dim> f(piece);
    const Bernstein<Rational, 1> w3 = piece.weight * piece.weight * piece.weight;
    Polynomial_vector<1, static_cast<std::size_t>(Dim)> normal;
    if constexpr (Dim == 2) normal = f.bend[0] * turned_left(f.first);
    else normal = cross(f.bend, f.first);
    return rational_map_piece<Dim, 1>(w3 * normal, f.speed * f.speed, range);
  });
}

/// The vector N̄/κ from the point to the centre of curvature, (4.4). Of the evolute's degree.
template <int Dim>
Rational_map<Dim, 1> radius_vector_map(const Rational_curve<Dim>& curve)
{
  return detail::map_of_pieces(curve, [](const Curve_piece<Dim>& piece, const std::array<Piece, 1>& range) -> std::optional<Rational_map_piece<Dim, 1>> {
    using namespace operators;
    const Curvature_forms<Dim> f(piece);
    if (is_zero(f.bend)) return std::nullopt;
    const detail::Normal_form<Dim> n(f);
    return rational_map_piece<Dim, 1>(f.speed * n.normal, n.size * piece.weight * piece.weight * piece.weight, range);
  });
}

/// The locus of the centres of the osculating spheres. With σ the arc length it is x + N̄/κ + (1/τ)(d(1/κ)/dσ)B̄, and it *is*
/// rational: the centre c solves three linear equations, ⟨x'⁽ᵏ⁾, c - x⟩ = 0, S/w⁴, 3⟨x',x''⟩, which give
///   (w³·T·p - S·w·β' + 3(w⟨D1,D2⟩ - w'S)β)/(w⁴·T),  T = `torsion_form`,
/// of degree 8d-12 (4d-7 for a polynomial curve). Chen, Riesenfeld & Cohen show of (4.7) that it is not, but with the derivative
/// by the curve's parameter in place of that by arc length; see `Focal_function`. Infinite where the torsion vanishes.
inline Rational_map<3, 1> focal_curve_map(const Rational_curve<3>& curve)
{
  return detail::map_of_pieces(curve, [](const Curve_piece<3>& piece, const std::array<Piece, 1>& range) -> std::optional<Rational_map_piece<3, 1>> {
    using namespace operators;
    const Bernstein<Rational, 1> torsion = torsion_form(piece);
    if (detail::is_zero(torsion)) return std::nullopt;
    const Curvature_forms<3> f(piece);
    const Bernstein<Rational, 1>& w = piece.weight;
    const Bernstein<Rational, 1> w3t = w * w * w * torsion, growth = 3 * (w * dot(f.first, derivative(f.first)) - derivative(w) * f.speed);
    return rational_map_piece<3, 1>(w3t * piece.numerator - (f.speed * w) * derivative(f.bend) + growth * f.bend, w3t * w, range);
  });
}

} // namespace locus

#endif
