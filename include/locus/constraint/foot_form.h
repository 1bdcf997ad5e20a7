// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_FOOT_FORM_H
#define LOCUS_CONSTRAINT_FOOT_FORM_H

#include <locus/shape/derivative_vectors.h>

namespace locus {

/// ρ = (X - aW, Y - bW): a piece of a curve as seen from q = (a, b), times its weight.
inline Polynomial_vector<1, 2> offset_from(const Curve_piece<2>& piece, const Exact_point<2>& q)
{
  return detail::vector_of<2>([&](std::size_t k) {
    return at_true_degree(subtract(piece.numerator[k], multiply(piece.weight, q[k])));
  });
}

/// P_perp of Farouki & Johnstone (1994), (12) and (15): -⟨ρ, D1⟩ with D1 = W·(X, Y)' - W'·(X, Y), in a piece's local
/// coordinate. It is (q - r)·r' times W³, so that the distance from q decreases where it is positive; its zeros are where a
/// line from q meets the curve at a right angle, and where the curve stands still.
/// Of degree 2n-1 for a polynomial piece, 3n-2 for a rational one: the products of degree 3n-1 that (15) adds have leading
/// coefficients n and -n times the same one, as those of D1 have, of degree 2n-2. Zero all along exactly for an arc of a
/// circle about q. With N = |ρ|² it is also N·W' - W·N'/2.
/// Of a curve f(x, y) = 0, the points that satisfy (18), (a-x)f_y - (b-y)f_x = 0, are the same ones, with f's singular points:
/// (f_y, -f_x) is along r', so that (18) at r(u) is P_perp(u) times a polynomial in u.
inline Bernstein<Rational, 1> foot_form(const Curve_piece<2>& piece, const Exact_point<2>& q)
{
  return multiply(dot(offset_from(piece, q), Derivative_vectors<2>(piece).d1()), Rational(-1));
}

namespace detail {

/// What f has no root in common with g, up to a positive factor on the unit interval, inside which g has no zero.
inline Integer_polynomial without_roots_of(Integer_polynomial f, Integer_polynomial g)
{
  for (g = gcd(f, g); degree(f) > 0 && degree(g) > 0; g = gcd(f, g)) {
    if (sign_at(bernstein_form(g), Rational(1, 2)) == Sign::negative)
      for (Integer& c : g) c = -c;
    f = exact_quotient(std::move(f), g);
  }
  return f;
}

} // namespace detail

/// P_perp in powers of the local coordinate, up to a positive factor inside the piece and without the roots that it has in
/// common with W; none of those is a foot. On a curve through the circular points at infinity, as on a circle, they are not
/// real; on a piece that reaches infinity they are at its end. Empty where P_perp is zero all along.
inline Integer_polynomial foot_polynomial(const Curve_piece<2>& piece, const Exact_point<2>& q)
{
  const Bernstein<Rational, 1> form = foot_form(piece, q);
  if (detail::is_zero(form)) return {};
  const Integer_polynomial f = monomial_form(Bernstein<Scaled_integer, 1>(form));
  if (piece.is_polynomial()) return f;
  return detail::without_roots_of(f, monomial_form(Bernstein<Scaled_integer, 1>(piece.weight)));
}

} // namespace locus

#endif
