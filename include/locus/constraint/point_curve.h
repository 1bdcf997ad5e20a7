// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_POINT_CURVE_H
#define LOCUS_CONSTRAINT_POINT_CURVE_H

#include <locus/function/enclosed_vector.h>
#include <locus/function/wronskian.h>
#include <locus/shape/rational_curve.h>
#include <locus/shape/velocity.h>

namespace locus {
namespace detail {

/// f·g' - f'·g at the degree that it always has: leading terms cancel where both have one degree.
template <class T>
Bernstein<T, 1> turning(const Bernstein<T, 1>& f, const Bernstein<T, 1>& g)
{
  if (f.degree() == g.degree() && f.degree() > 0) return velocity_numerator(g, f);
  if (f.degree() == 0) return multiply(derivative(g), f[0]);
  if (g.degree() == 0) return multiply(derivative(f), T(-g[0]));
  return subtract(multiply(f, derivative(g)), multiply(derivative(f), g));
}

template <class T>
using Lift = std::array<Bernstein<T, 1>, 3>;

/// (2Wρ, |ρ|²), see Point_curve_forms.
template <class T>
Lift<T> lift_of(const std::array<Bernstein<T, 1>, 2>& offset, const Bernstein<T, 1>& weight)
{
  const auto scaled = [&](const Bernstein<T, 1>& x) {
    return weight.degree() == 0 ? multiply(x, T(T(2) * weight[0])) : multiply(multiply(weight, x), T(2));
  };
  return {scaled(offset[0]), scaled(offset[1]), add(multiply(offset[0], offset[0]), multiply(offset[1], offset[1]))};
}

/// ℓ × ℓ'.
template <class T>
Lift<T> tangent_of(const Lift<T>& lift)
{
  return {turning(lift[1], lift[2]), turning(lift[2], lift[0]), turning(lift[0], lift[1])};
}

/// a(u)·b(v) of vectors whose components have one degree.
template <class T>
Bernstein<T, 2> product_form(const std::vector<Bernstein<T, 1>>& a, const std::vector<Bernstein<T, 1>>& b)
{
  const int n = a[0].degree(), m = b[0].degree();
  Bernstein<T, 2> product(Degrees<2>{n, m});
  for (std::size_t k = 0; k < a.size(); ++k)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= m; ++j) product.at({i, j}) += a[k][static_cast<std::size_t>(i)] * b[k][static_cast<std::size_t>(j)];
  return product;
}

} // namespace detail

/// A piece of a curve as seen from a point p: with ρ = (X - αW, Y - βW), the *lift*
///   ℓ(u) = (2Wρ, |ρ|²), of degree 2n.
/// A point p + q, with q = (qx : qy : qw), is not nearer to the curve's point r(u) than to p exactly where
///   (-qx, -qy, qw)·ℓ(u) / qw ≥ 0,
/// so ℓ is, in homogeneous coordinates, the curve inverted at the circle of radius √2 about p, and the points nearer to p
/// than to any r(u) are the polar set of its convex hull. What Farouki & Johnstone (1994) say of circles then reads: the
/// untrimmed bisector is dual to the inverted curve, its self-intersections are bitangents, its points at infinity tangents
/// through p, its cusps inflections, all of it free of the redundant factor w of (37) and (59).
class Point_curve_forms {
public:
  using Form = Bernstein<Rational, 1>;
  using Form_3 = Polynomial_vector<1, 3>;

  Point_curve_forms(const Curve_piece<2>& piece, const Exact_point<2>& point) : weight_(at_true_degree(piece.weight))
  {
    offset_ = detail::vector_of<2>([&](std::size_t k) {
      return at_true_degree(subtract(piece.numerator[k], multiply(piece.weight, point[k])));
    });
    lift_ = at_true_degree(detail::lift_of(offset_, weight_));
  }

  const Form& weight() const { return weight_; }
  /// ρ.
  const Polynomial_vector<1, 2>& offset() const { return offset_; }
  const Form_3& lift() const { return lift_; }

  /// ℓ × ℓ' = (-qx, -qy, qw) of the untrimmed bisector's point: (38), (39) relative to p, times -2. Degree 4n-2, 3n-1 for a
  /// polynomial curve. The tangent of the inverted curve.
  Form_3 tangent() const { return cross(lift_, derivative(lift_)); }

  /// [ρ ρ'], of degree 2n-2: zero at *class points*, whose tangent passes through p, where the bisector goes to infinity.
  /// (36), and (37) without its factor w; qw is 4w² times it.
  Form class_form() const { return bracket(offset_, derivative(offset_)); }

  /// det(ℓ, ℓ', ℓ''), of degree 6n-6, 4n-4 for a polynomial curve: zero at *circular points*, whose circle of curvature passes
  /// through p, where the bisector has its cusps. Proportional to (58), and to (59) without its factor w.
  Form circular_form() const { return wronskian(lift_); }

private:
  Form weight_;
  Polynomial_vector<1, 2> offset_;
  Form_3 lift_;
};

/// a(u)·b(v). For a tangent a and a lift b it says on which side of a bisector point's circle the curve's point r(v) lies:
/// outside where it has the sign of the tangent's last component.
inline Bernstein<Rational, 2> paired(const Polynomial_vector<1, 3>& a, const Polynomial_vector<1, 3>& b)
{
  return detail::product_form(of_one_degree(a), of_one_degree(b));
}

} // namespace locus

#endif
