// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_PARAMETER_FORM_H
#define LOCUS_SHAPE_PARAMETER_FORM_H

#include <locus/shape/rational_curve.h>

namespace locus {

namespace detail {

// A parameter in homogeneous coordinates: u = x/y, infinity is y = 0. The local coordinate s of any piece, finite or
// not, is then the point (1-s)·start + s·finish of the line, so that all pieces are treated alike.

struct Homogeneous_parameter {
  Rational x, y;
};

inline Homogeneous_parameter start_of(const Piece& p)
{
  return p.lo_infinite ? Homogeneous_parameter{p.hi, 0} : Homogeneous_parameter{p.lo, 1};
}
inline Homogeneous_parameter finish_of(const Piece& p)
{
  return p.hi_infinite ? Homogeneous_parameter{p.lo, 0} : Homogeneous_parameter{p.hi, 1};
}

inline Piece finite_range(Rational lo, Rational hi)
{
  Piece p;
  p.lo = std::move(lo);
  p.hi = std::move(hi);
  return p;
}
/// [lo, ∞) with lo > 0.
inline Piece range_to_infinity(const Rational& lo)
{
  Piece p = finite_range(lo, lo);
  p.hi_infinite = true;
  return p;
}
/// (-∞, hi] with hi < 0.
inline Piece range_from_infinity(const Rational& hi)
{
  Piece p = finite_range(hi, hi);
  p.lo_infinite = true;
  return p;
}

/// Coefficients of 1, x, x², …; of any length.
using Coefficient_list = std::vector<Rational>;

inline Coefficient_list product(const Coefficient_list& f, const Coefficient_list& g)
{
  if (f.empty() || g.empty()) return {};
  Coefficient_list h(f.size() + g.size() - 1, Rational(0));
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) h[i + j] += f[i] * g[j];
  return h;
}

/// Σ c[i]·a^(n-i)·b^i for two linear polynomials a and b, with n + 1 = c.size(); O(n²).
inline Coefficient_list substitute_lines(const Coefficient_list& c, const Coefficient_list& a, const Coefficient_list& b)
{
  // From the highest power of b down: sum = sum·b + c[i]·a^(n-i).
  Coefficient_list sum, power{1};
  for (std::size_t i = c.size(); i-- > 0;) {
    sum = product(sum, b);
    sum.resize(power.size(), Rational(0));
    for (std::size_t k = 0; k < power.size(); ++k) sum[k] += c[i] * power[k];
    if (i > 0) power = product(power, a);
  }
  return sum;
}

/// The Bernstein form of degree n = coefficients.size() - 1 on a piece of Σ a[j]·x^j·y^(n-j), the polynomial with these
/// coefficients of 1, u, u², … made homogeneous.
inline Bernstein<Rational, 1> form_on(const Piece& range, const Coefficient_list& coefficients)
{
  const Homogeneous_parameter e0 = start_of(range), e1 = finish_of(range);
  const int n = static_cast<int>(coefficients.size()) - 1;
  // In the scaled basis (1-s)^(n-i)·s^i a product is that of polynomials in s/(1-s).
  return scaled_by_binomials(
    Bernstein<Rational, 1>(Degrees<1>{n}, substitute_lines(coefficients, {e0.y, e1.y}, {e0.x, e1.x})), true);
}

/// Coefficients of 1, δ, δ², … of a Bernstein form, where δ grows along the curve from 0 at the piece's start or finish:
/// δ = u - u0, or δ = -1/u where u is infinite. Up to a factor that all forms of one degree on a piece share.
inline Coefficient_list form_about(const Piece& range, bool at_finish, const Bernstein<Rational, 1>& f)
{
  const Homogeneous_parameter e0 = start_of(range), e1 = finish_of(range), at = at_finish ? e1 : e0;
  // The homogeneous parameter is constant + δ·slope.
  const Homogeneous_parameter constant = at.y == 0 ? Homogeneous_parameter{1, 0} : Homogeneous_parameter{at.x, 1};
  const Homogeneous_parameter slope = at.y == 0 ? Homogeneous_parameter{0, -1} : Homogeneous_parameter{1, 0};
  const auto cross = [](const Homogeneous_parameter& p, const Homogeneous_parameter& q) {
    return Rational(p.x * q.y - p.y * q.x);
  };
  const Coefficient_list co_s{cross(e1, constant), cross(e1, slope)}, s{cross(constant, e0), cross(slope, e0)};
  return substitute_lines(scaled_by_binomials(f, false).coefficients(), co_s, s);
}

/// f(s) for s = finish·t/(start·(1-t) + finish·t), times (start·(1-t) + finish·t)^degree: the local coordinate changes,
/// the ends stay. Both factors positive.
inline Bernstein<Rational, 1> rescaled(Bernstein<Rational, 1> f, const Rational& start, const Rational& finish)
{
  Rational power = 1;
  for (std::size_t i = 0; i < f.size(); ++i, power *= finish) f[i] *= power;
  power = 1;
  for (std::size_t i = f.size(); i-- > 0; power *= start) f[i] *= power;
  return f;
}

// ------------------------------------------------------------------------------------------- pieces as homogeneous forms

/// A piece whose weight has the numerators' degree.
template <int Dim>
Curve_piece<Dim> homogenised(Curve_piece<Dim> piece)
{
  const int n = piece.degree();
  for (auto& x : piece.numerator) x = elevate(x, 0, n - x.degree());
  piece.weight = elevate(piece.weight, 0, n - piece.weight.degree());
  return piece;
}

/// The same change to each numerator and the weight.
template <int Dim, class Change>
Curve_piece<Dim> changed(const Curve_piece<Dim>& piece, Change change)
{
  Curve_piece<Dim> out;
  for (std::size_t k = 0; k < out.numerator.size(); ++k) out.numerator[k] = change(piece.numerator[k]);
  out.weight = change(piece.weight);
  return out;
}

/// Makes the weight positive inside, a constant one of degree 0. It has no zero inside.
template <int Dim>
void settle_weight(Curve_piece<Dim>& piece)
{
  make_weight_positive(piece);
  const Rational first = piece.weight[0];
  const auto& w = piece.weight.coefficients();
  if (!std::all_of(w.begin(), w.end(), [&](const Rational& x) { return x == first; })) return;
  for (auto& x : piece.numerator) x = multiply(x, Rational(1 / first));
  piece.weight = Bernstein<Rational, 1>(Degrees<1>{0}, {Rational(1)});
}

/// Makes homogeneous forms a piece as `Curve_piece` describes it: no common factor, positive weight inside, a constant
/// weight of degree 0. The weight has no zero inside but common ones.
template <int Dim>
void normalise(Curve_piece<Dim>& piece)
{
  remove_common_factor(piece);
  settle_weight(piece);
}

/// A piece whose ends' parameters, in homogeneous coordinates up to a common factor, go to the ends of the range `to`, and
/// with them all parameters between; the points stay. The weight has no zero inside.
template <int Dim>
Curve_piece<Dim> moved(const Curve_piece<Dim>& piece, const Homogeneous_parameter& start, const Homogeneous_parameter& finish,
                       const Piece& to)
{
  const auto ratio = [](const Homogeneous_parameter& a, const Homogeneous_parameter& b) {
    return b.y == 0 ? Rational(a.x / b.x) : Rational(a.y / b.y);
  };
  const Rational first = ratio(start_of(to), start), last = ratio(finish_of(to), finish);
  if (first == last) return piece;
  const Rational quotient = last / first;
  auto result = changed(homogenised(piece), [&](const Bernstein<Rational, 1>& f) { return rescaled(f, 1, quotient); });
  normalise(result);
  return result;
}

/// The part of a piece over a range inside its own.
template <int Dim>
Curve_piece<Dim> part_over(const Curve_piece<Dim>& piece, const Piece& range, const Piece& part)
{
  const Rational lo = part.lo_infinite ? Rational(0) : range.local(part.lo);
  const Rational hi = part.hi_infinite ? Rational(1) : range.local(part.hi);
  if (lo == 0 && hi == 1) return piece;
  const auto restricted = changed(piece, [&](const Bernstein<Rational, 1>& f) { return restrict_to(f, 0, lo, hi); });
  const Homogeneous_parameter e0 = start_of(range), e1 = finish_of(range);
  const auto at = [&](const Rational& s) {
    return Homogeneous_parameter{Rational(e0.x + s * (e1.x - e0.x)), Rational(e0.y + s * (e1.y - e0.y))};
  };
  return moved(restricted, at(lo), at(hi), part);
}

/// The two parts of a range below and above a value strictly inside.
inline std::array<Piece, 2> split_range(const Piece& range, const Rational& at)
{
  return {range.lo_infinite ? range_from_infinity(at) : finite_range(range.lo, at),
          range.hi_infinite ? range_to_infinity(at) : finite_range(at, range.hi)};
}

} // namespace detail

} // namespace locus

#endif
