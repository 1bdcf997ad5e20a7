// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_RATIONAL_CURVE_H
#define LOCUS_SHAPE_RATIONAL_CURVE_H

#include <locus/function/domain.h>
#include <locus/function/rational_root.h>
#include <locus/shape/invalid_input.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace locus {

template <int Dim>
using Exact_point = std::array<Rational, static_cast<std::size_t>(Dim)>;

/// One polynomial piece of a rational curve in Bernstein form on the unit interval: the point is numerator / weight.
/// A polynomial curve has a weight of degree 0.
template <int Dim>
struct Curve_piece {
  std::array<Bernstein<Rational, 1>, static_cast<std::size_t>(Dim)> numerator;
  Bernstein<Rational, 1> weight;

  bool is_polynomial() const { return weight.degree() == 0; }
  int degree() const { return std::max(numerator[0].degree(), weight.degree()); }
};

/// A rational curve in Dim dimensions with exact rational coefficients: Bézier pieces in order over a chain of domain
/// pieces. Valid by construction: weights positive inside the pieces and, but where the curve reaches infinity, at their
/// ends; no piece is a single point. Immutable.
template <int Dim>
class Rational_curve {
public:
  using Piece_form = Curve_piece<Dim>;

  Rational_curve(std::vector<Piece_form> pieces, Chain chain) : pieces_(std::move(pieces)), chain_(std::move(chain)) {}

  const std::vector<Piece_form>& pieces() const { return pieces_; }
  const Chain& chain() const { return chain_; }

private:
  std::vector<Piece_form> pieces_;
  Chain chain_;
};

namespace detail {

inline bool all_of_one_sign(const Bernstein<Rational, 1>& f)
{
  for (const Rational& c : f.coefficients())
    if (sgn(c) == 0 || sgn(c) != sgn(f[0])) return false;
  return true;
}

/// Where on the unit interval a weight, not identically zero, has its first zero: within 2^-40 of it.
inline std::optional<Rational> near_pole(const Bernstein<Rational, 1>& weight)
{
  if (all_of_one_sign(weight)) return std::nullopt;
  const auto set = exact_roots(Bernstein<Scaled_integer, 1>(weight), Rational(0), Rational(1));
  if (set.roots.empty()) return std::nullopt;
  return near_value(set.roots[0]);
}

inline bool is_zero(const Bernstein<Rational, 1>& f)
{
  return std::all_of(f.coefficients().begin(), f.coefficients().end(), [](const Rational& c) { return c == 0; });
}

inline void reject_poles(const Bernstein<Rational, 1>& weight)
{
  if (is_zero(weight))
    throw Invalid_input(".weights", "all weights are zero", "give at least the end points positive weights");
  if (const auto u = near_pole(weight))
    throw Invalid_input(".weights",
                        "the denominator vanishes on the domain near u = " + std::to_string(u->get_d()) + " (a pole)",
                        "use positive weights");
}

/// Divides numerator and weight by their common polynomial factor, if they have one.
template <int Dim>
void remove_common_factor(Curve_piece<Dim>& piece)
{
  if (piece.is_polynomial()) return;
  Integer_polynomial common = monomial_form(Bernstein<Scaled_integer, 1>(piece.weight));
  for (const auto& x : piece.numerator) {
    if (degree(common) < 1) return;
    common = gcd(common, monomial_form(Bernstein<Scaled_integer, 1>(x)));
  }
  if (degree(common) < 1) return;
  const Bernstein<Rational, 1> divisor = bernstein_form(common).rational();
  for (auto& x : piece.numerator) x = divide_exactly(x, divisor);
  piece.weight = divide_exactly(piece.weight, divisor);
}

/// Homogeneous coordinates may change their common sign: a weight without zeros is made positive.
template <int Dim>
void make_weight_positive(Curve_piece<Dim>& piece)
{
  if (evaluate_at(piece.weight, Rational(1, 2)) >= 0) return;
  for (auto& x : piece.numerator) x = multiply(x, Rational(-1));
  piece.weight = multiply(piece.weight, Rational(-1));
}

template <int Dim>
bool is_single_point(const Curve_piece<Dim>& piece)
{
  const int n = piece.degree();
  for (const auto& x : piece.numerator) {
    // x/w constant: x·w(0) = w·x(0).
    const Bernstein<Rational, 1> left = multiply(x, Rational(piece.weight[0])), right = multiply(piece.weight, Rational(x[0]));
    const Bernstein<Rational, 1> difference = subtract(elevate(left, 0, n - left.degree()), elevate(right, 0, n - right.degree()));
    for (const Rational& c : difference.coefficients())
      if (c != 0) return false;
  }
  return true;
}

} // namespace detail

/// A (rational) Bézier curve on [0,1] from its control points and, if given, one weight for each.
/// Throws Invalid_input where there are fewer than two points, the numbers differ, the denominator vanishes on [0,1],
/// or the curve is a single point. Equal weights give a polynomial curve; common factors are divided out.
template <int Dim>
Rational_curve<Dim> bezier_curve(const std::vector<Exact_point<Dim>>& points, const std::vector<Rational>& weights = {})
{
  if (points.size() < 2)
    throw Invalid_input(".control_points", "a curve needs at least 2 control points, not " + std::to_string(points.size()),
                        "list degree + 1 points");
  if (!weights.empty() && weights.size() != points.size())
    throw Invalid_input(".weights", std::to_string(weights.size()) + " weights for " + std::to_string(points.size()) + " control points",
                        "give one weight for each control point, or none");
  const Degrees<1> degrees{static_cast<int>(points.size()) - 1};
  const bool polynomial = std::all_of(weights.begin(), weights.end(), [&](const Rational& w) { return w == weights[0]; });
  Curve_piece<Dim> piece;
  piece.weight = polynomial ? Bernstein<Rational, 1>(Degrees<1>{0}, {Rational(1)}) : Bernstein<Rational, 1>(degrees, weights);
  if (polynomial && !weights.empty() && weights[0] == 0)
    throw Invalid_input(".weights", "all weights are zero", "use positive weights");
  for (auto& x : piece.numerator) x = Bernstein<Rational, 1>(degrees);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < piece.numerator.size(); ++k) {
      piece.numerator[k][i] = points[i][k];
      if (!polynomial) piece.numerator[k][i] *= weights[i];
    }
  detail::remove_common_factor(piece);
  detail::make_weight_positive(piece);
  detail::reject_poles(piece.weight);
  if (detail::is_single_point(piece))
    throw Invalid_input(".control_points", "the curve is a single point", "use a point input instead");
  std::vector<Curve_piece<Dim>> pieces;
  pieces.push_back(std::move(piece));
  return Rational_curve<Dim>(std::move(pieces), Chain());
}

using Curve_2 = Rational_curve<2>;

/// Coordinates as users write them: {0, 1}, {0.5, "1/3"}.
struct Coordinates_2 {
  Number x, y;

  Exact_point<2> exact() const { return {x.value(), y.value()}; }
};

/// Bézier curve in the plane, e.g. `bezier_2({{0, 0}, {1, 2}, {2, "1/2"}})`; see `bezier_curve`.
inline Curve_2 bezier_2(const std::vector<Coordinates_2>& points, const std::vector<Number>& weights = {})
{
  std::vector<Exact_point<2>> exact;
  for (const Coordinates_2& p : points) exact.push_back(p.exact());
  std::vector<Rational> exact_weights;
  for (const Number& w : weights) exact_weights.push_back(w.value());
  return bezier_curve<2>(exact, exact_weights);
}

/// The straight segment from a to b.
inline Curve_2 segment_2(const Coordinates_2& a, const Coordinates_2& b) { return bezier_2({a, b}); }

} // namespace locus

#endif
