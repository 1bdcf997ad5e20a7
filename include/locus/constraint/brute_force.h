// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_BRUTE_FORCE_H
#define LOCUS_CONSTRAINT_BRUTE_FORCE_H

#include <locus/shape/rational_curve.h>
#include <locus/shape/unreduced_quotient.h>

namespace locus {

/// The forms of curvature, evolute and torsion as symbolic NURBS computation finds them without any reduction, with the
/// degrees that Chen, Riesenfeld & Cohen count for a curve of degree d, first for a polynomial, then for a rational one.
/// They are references to measure `Curvature_forms` and the derived curves against, and slow.
namespace brute_force {

/// x = p/w at the degree of the curve.
template <int Dim>
Unreduced_quotient<static_cast<std::size_t>(Dim)> point(const Curve_piece<Dim>& piece)
{
  return Unreduced_quotient<static_cast<std::size_t>(Dim)>(piece.numerator, piece.weight);
}

/// x, x', x'', x''': 2d, 4d and 8d for a rational curve.
template <int Dim>
struct Derivatives {
  Unreduced_quotient<static_cast<std::size_t>(Dim)> x, first, second, third;

  explicit Derivatives(const Curve_piece<Dim>& piece)
    : x(point(piece)), first(derivative(x)), second(derivative(first)), third(derivative(second))
  {}
};

/// [x' x''], the numerator of the signed curvature (3.1): degree 2d-3 or 6d.
inline Unreduced_scalar inflections(const Curve_piece<2>& piece)
{
  const auto first = derivative(point(piece));
  return bracket(first, derivative(first));
}

/// κ² = [x' x'']²/|x'|⁶ (3.3): degree 6d-6 or 24d. Its derivative has 12(d-1) or 48d; that one's numerator vanishes where
/// the curvature is critical, at inflections, and where a factor was left in: for x = p/w it is 2·w²⁹·S²·β·critical with the
/// names of `Curvature_forms`. Throws std::domain_error if the curve is a point.
inline Unreduced_scalar squared_curvature(const Curve_piece<2>& piece)
{
  const auto first = derivative(point(piece));
  const Unreduced_scalar area = bracket(first, derivative(first)), speed = dot(first, first);
  return divide(multiply(area, area), multiply(speed, multiply(speed, speed)));
}

/// g0 = |x'|²[x' x'''] - 3⟨x',x''⟩[x' x''] (3.4): degree 4d-6 or 26d.
inline Unreduced_scalar critical(const Curve_piece<2>& piece)
{
  const Derivatives<2> at(piece);
  return subtract(multiply(dot(at.first, at.first), bracket(at.first, at.third)),
                  multiply(multiply(dot(at.first, at.second), bracket(at.first, at.second)), Rational(3)));
}

/// x + |x'|²/[x' x'']·x' turned left (3.6): degree 3d-3 or 13d. Throws std::domain_error for a straight line.
inline Unreduced_quotient<2> evolute(const Curve_piece<2>& piece)
{
  const auto x = point(piece), first = derivative(x);
  return add(x, multiply(divide(dot(first, first), bracket(first, derivative(first))), turned_left(first)));
}

/// [x' x'' x''']: degree 3d-6 or 14d.
inline Unreduced_scalar triple_product(const Curve_piece<3>& piece)
{
  const Derivatives<3> at(piece);
  return dot(at.third, cross(at.first, at.second));
}

/// τ = [x' x'' x''']/|x'×x''|² (4.5): degree 4d-6 or 26d. Throws std::domain_error for a straight line.
inline Unreduced_scalar torsion(const Curve_piece<3>& piece)
{
  const Derivatives<3> at(piece);
  const auto binormal = cross(at.first, at.second);
  return divide(dot(at.third, binormal), dot(binormal, binormal));
}

} // namespace brute_force

namespace detail {

/// D_ij = p⁽ⁱ⁾w⁽ʲ⁾ - p⁽ʲ⁾w⁽ⁱ⁾, (2.1), at its formal degree: 2d-i-j, or d-i for a polynomial curve (i > j).
template <int Dim>
Polynomial_vector<1, static_cast<std::size_t>(Dim)> formal_derivative_vector(const Curve_piece<Dim>& piece, int i, int j)
{
  const auto derived = [](Bernstein<Rational, 1> f, int order) {
    for (; order > 0; --order) f = derivative(f);
    return f;
  };
  const Bernstein<Rational, 1> wi = derived(piece.weight, i), wj = derived(piece.weight, j);
  const Degrees<1> degrees{std::max(0, piece.degree() + piece.weight.degree() - i - j)};
  return vector_of<static_cast<std::size_t>(Dim)>([&](std::size_t k) {
    const Bernstein<Rational, 1>& p = piece.numerator[k];
    return elevated_to(formal_minor(derived(p, i), derived(p, j), wi, wj), degrees);
  });
}

} // namespace detail

/// The reduced forms as the paper has them, at the degrees that it counts: leading terms that cancel are not looked for.
/// Where its print is garbled they are as derived anew: (3.3) and (3.4) have x''' for x'' in places.
namespace paper_form {

/// f2 = [p' p'']w - [p p'']w' - [p' p]w'' (3.2), the same as β: degree 2d-3 or 3d-3.
inline Bernstein<Rational, 1> inflections(const Curve_piece<2>& piece)
{
  using namespace detail;
  const Polynomial_vector<1, 2>& p = piece.numerator;
  const auto p1 = derivative(p), p2 = derivative(p1);
  const auto w1 = derivative(piece.weight), w2 = derivative(w1);
  const auto without = formal_difference(formal_product(formal_bracket(p1, p2), piece.weight), formal_product(formal_bracket(p, p2), w1));
  return formal_difference(without, formal_product(formal_bracket(p1, p), w2));
}

/// g2 = ([D1 D3] + [D1 D21])|D1|²w + 2w'[D1 D2]|D1|² - 3⟨D1,D2⟩[D1 D2]w (3.5): degree 4d-6 or 9d-6. A factor w is left in
/// it: g2 = w·critical.
inline Bernstein<Rational, 1> critical(const Curve_piece<2>& piece)
{
  using namespace detail;
  const auto d1 = formal_derivative_vector(piece, 1, 0), d2 = formal_derivative_vector(piece, 2, 0);
  const auto d3 = formal_derivative_vector(piece, 3, 0), d21 = formal_derivative_vector(piece, 2, 1);
  const auto area = formal_bracket(d1, d2), speed = formal_dot(d1, d1);
  const auto third = formal_sum(formal_bracket(d1, d3), formal_bracket(d1, d21));
  const auto growth = formal_sum(formal_product(third, piece.weight), multiply(formal_product(derivative(piece.weight), area), Rational(2)));
  const auto fall = formal_product(formal_product(formal_dot(d1, d2), area), piece.weight);
  return formal_difference(formal_product(growth, speed), multiply(fall, Rational(3)));
}

/// ([D1 D2]·w·p + |D1|²·D1 turned left)/([D1 D2]·w²), after (3.6): degree 3d-3 or 6d-3.
inline Unreduced_quotient<2> evolute(const Curve_piece<2>& piece)
{
  using namespace detail;
  const auto d1 = formal_derivative_vector(piece, 1, 0);
  const auto area = formal_product(formal_bracket(d1, formal_derivative_vector(piece, 2, 0)), piece.weight);
  return Unreduced_quotient<2>(formal_sum(formal_product(area, piece.numerator), formal_product(formal_dot(d1, d1), turned_left(d1))),
                               formal_product(area, piece.weight));
}

/// [D1 D2 D3], below (4.6): degree 3d-6 or 6d-6. For a rational curve w² is left in it.
inline Bernstein<Rational, 1> torsion(const Curve_piece<3>& piece)
{
  using namespace detail;
  const auto d1 = formal_derivative_vector(piece, 1, 0), d2 = formal_derivative_vector(piece, 2, 0);
  return formal_dot(formal_derivative_vector(piece, 3, 0), formal_cross(d1, d2));
}

} // namespace paper_form

} // namespace locus

#endif
