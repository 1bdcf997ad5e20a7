// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_CURVATURE_FORMS_H
#define LOCUS_CONSTRAINT_CURVATURE_FORMS_H

#include <locus/shape/derivative_vectors.h>

namespace locus {

/// The curvature of a curve piece by exact polynomials. With D1 = p'w - pw', S = ⟨D1,D1⟩ and the *bend* β with D1×D2 = w·β,
/// which is the Wronskian of X, Y, W in the plane and a vector of three minors of the Wronskian matrix in space:
///   κ = |β|·w³/S^(3/2), in the plane with the sign of β, and
///   dκ/ds = critical·w⁴/S³ by arc length in the plane, critical·w⁴/(|β|·S³) in space, where
///   critical = (⟨β,β'⟩w + 3⟨β,β⟩w')S - 3⟨β,β⟩w⟨D1,D2⟩, divided by β in the plane.
/// So κ² need not be differentiated (Chen, Riesenfeld & Cohen (3.4)), and less than the paper's (3.5) is left: in general
/// critical has degree 8d-12 (4d-7 for a polynomial curve) in the plane, 11d-18 (6d-11) in space. Derivatives are by the
/// piece's local coordinate, in which all forms are.
template <int Dim>
struct Curvature_forms {
  static constexpr std::size_t bends = Dim == 2 ? 1 : 3;

  Polynomial_vector<1, static_cast<std::size_t>(Dim)> first; ///< D1
  Polynomial_vector<1, bends> bend;                           ///< β
  Bernstein<Rational, 1> weight, speed;                       ///< w and S
  Bernstein<Rational, 1> critical;

  explicit Curvature_forms(const Curve_piece<Dim>& piece) : weight(piece.weight)
  {
    using namespace operators;
    const Derivative_vectors<Dim> x(piece);
    first = x.d1();
    speed = square(first);
    if constexpr (Dim == 2) {
      bend[0] = wronskian(x.homogeneous());
    } else {
      const auto minors = wronskian_minors(x.homogeneous());
      bend = {minors[0], minors[1], minors[2]};
    }
    // In the plane one factor β is left out.
    const Bernstein<Rational, 1> size = Dim == 2 ? bend[0] : square(bend);
    const Bernstein<Rational, 1> growth = Dim == 2 ? derivative(bend[0]) : dot(bend, derivative(bend));
    critical = at_true_degree((growth * weight + 3 * (size * derivative(weight))) * speed - 3 * (size * weight * dot(first, derivative(first))));
  }

  /// Curvature and its derivative by arc length, by their signs and squares: what can be compared exactly.
  struct Exact_curvature {
    int sign = 0; ///< in space 0 or 1
    Rational square;
    int slope_sign = 0;
    Rational slope_square;

    bool same_curvature(const Exact_curvature& other) const { return sign == other.sign && square == other.square; }
    bool same_slope(const Exact_curvature& other) const { return slope_sign == other.slope_sign && slope_square == other.slope_square; }
  };

  /// At a rational parameter where the piece is finite and does not stand still. Where a space curve's curvature vanishes it
  /// has no derivative; zero is given.
  Exact_curvature at(const Rational& u) const
  {
    const Rational w = evaluate_at(weight, u), s = evaluate_at(speed, u), c = evaluate_at(critical, u);
    Rational b2 = 0;
    for (const auto& f : bend) {
      const Rational b = evaluate_at(f, u);
      b2 += b * b;
    }
    const Rational s3 = s * s * s, w2 = w * w;
    Exact_curvature k;
    k.sign = Dim == 2 ? sgn(evaluate_at(bend[0], u)) * sgn(w) : sgn(b2);
    k.square = b2 * w2 * w2 * w2 / s3;
    if (Dim == 3 && b2 == 0) return k;
    k.slope_sign = sgn(c);
    k.slope_square = c * c * w2 * w2 * w2 * w2 / (s3 * s3);
    if (Dim == 3) k.slope_square /= b2;
    return k;
  }
};

/// -det(H, H', H'', H''') of the homogeneous coordinates H: τ = w²·torsion/⟨β,β⟩ (4.6), where ⟨x', x''×x'''⟩ = torsion/w⁴. Of
/// degree 4d-12 (3d-9 for a polynomial curve): that of a cubic has no zero. Identically zero for a plane curve.
inline Bernstein<Rational, 1> torsion_form(const Curve_piece<3>& piece)
{
  return multiply(wronskian(Derivative_vectors<3>(piece).homogeneous()), Rational(-1));
}

} // namespace locus

#endif
