// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_DERIVATIVE_VECTORS_H
#define LOCUS_SHAPE_DERIVATIVE_VECTORS_H

#include <locus/function/spline_operations.h>
#include <locus/function/wronskian.h>
#include <locus/shape/rational_curve.h>
#include <locus/shape/velocity.h>

namespace locus {

/// A curve piece x = p/w as polynomials without denominators: what Chen, Riesenfeld and Cohen build everything from, (2.1).
/// With them x' = D1/w², x'' = D2/w² - 2w'D1/w³ and x''' = (D3 + D21)/w² - 4w'D2/w³ + (6w'² - 2ww'')D1/w⁴, (2.2).
/// All have their least degrees, in general 2d-2, 2d-3, 2d-4 and 2d-4, below the paper's since leading terms cancel;
/// d-1, d-2, d-3 and none for a polynomial curve. Derivatives are by the piece's local coordinate.
template <int Dim>
class Derivative_vectors {
public:
  static constexpr auto size = static_cast<std::size_t>(Dim);
  using Vector = Polynomial_vector<1, size>;

  explicit Derivative_vectors(const Curve_piece<Dim>& piece) : point_(piece.numerator), weight_(piece.weight) {}

  const Vector& point() const { return point_; }                       ///< p
  const Bernstein<Rational, 1>& weight() const { return weight_; }     ///< w
  Vector d1() const ///< p'w - pw'
  {
    return detail::vector_of<size>([&](std::size_t k) { return at_true_degree(detail::velocity_numerator(point_[k], weight_)); });
  }
  Vector d2() const { return combination(2, 0); }                      ///< p''w - pw'' = D1'
  Vector d3() const { return combination(3, 0); }                      ///< p'''w - pw'''
  Vector d21() const { return combination(2, 1); }                     ///< p''w' - p'w'', with w·D21 = w'·D2 - w''·D1

  /// The coordinates with the weight: X, Y, (Z,) W.
  Polynomial_vector<1, size + 1> homogeneous() const
  {
    return detail::vector_of<size + 1>([&](std::size_t k) { return k < size ? point_[k] : weight_; });
  }

private:
  static Bernstein<Rational, 1> derived(Bernstein<Rational, 1> f, int order)
  {
    for (; order > 0; --order) f = derivative(f);
    return f;
  }

  /// p⁽ⁱ⁾·w⁽ʲ⁾ - p⁽ʲ⁾·w⁽ⁱ⁾
  Vector combination(int i, int j) const
  {
    const Bernstein<Rational, 1> wi = derived(weight_, i), wj = derived(weight_, j);
    return detail::vector_of<size>([&](std::size_t k) {
      return at_true_degree(subtract(multiply(derived(point_[k], i), wj), multiply(derived(point_[k], j), wi)));
    });
  }

  Vector point_;
  Bernstein<Rational, 1> weight_;
};

/// The polynomial spline in the curve's own parameter whose pieces `form` gives in their local coordinates; `order` counts
/// the derivatives in it, so that each piece's length enters with that power. Its knots have the least multiplicities. Each
/// piece's homogeneous coordinates are as the curve keeps them: where a common factor was divided out of one, or its weights
/// made constant, the spline jumps there by a constant factor, which moves no zero.
/// Throws Invalid_input for an infinite domain: a spline has finite knots.
template <int Dim, class Form>
Spline<Rational, 1> spline_along(const Rational_curve<Dim>& curve, int order, Form form)
{
  std::vector<Spline_span<Rational, 1>> spans;
  for (std::size_t k = 0; k < curve.pieces().size(); ++k) {
    const Piece& range = curve.chain().pieces[k];
    if (!range.is_finite())
      throw Invalid_input("", "the curve's domain is infinite, and a spline's is not", "restrict the domain, or go piece by piece");
    const Rational length = range.hi - range.lo;
    Rational scale = 1;
    for (int i = 0; i < order; ++i) scale /= length;
    spans.push_back({{range.lo}, {range.hi}, multiply(form(curve.pieces()[k]), scale)});
  }
  return spline_from_spans(std::move(spans));
}

} // namespace locus

#endif
