// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_TEST_SHAPE_SUPPORT_H
#define LOCUS_TEST_SHAPE_SUPPORT_H

// Curves of several pieces looked at a second way: points from the pieces by the definition of their ranges, derivatives by
// the quotient rule in the parameter, and joints judged by those.

#include <locus/shape/joints.h>

#include "support.h"

namespace locus_test {

using locus::Curve_piece;
using locus::Exact_point;
using locus::Joint;
using locus::Joint_kind;
using locus::Piece;
using locus::Rational_curve;

/// "place | rule | remedy" of an Invalid_input, "unsupported: …", or nothing.
template <class F>
std::string complaint(F f)
{
  try {
    f();
  } catch (const locus::Invalid_input& e) {
    return e.place() + " | " + e.rule() + " | " + e.remedy();
  } catch (const locus::Unsupported_feature& e) {
    return std::string("unsupported: ") + e.what();
  }
  return "";
}

inline bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// ------------------------------------------------------------------------------------------------------------ points

inline Rational local_value(const Piece& p, const Rational& u)
{
  if (p.hi_infinite) return Rational((u - p.lo) / u); // u = lo/(1-s)
  if (p.lo_infinite) return Rational(p.hi / u);       // u = hi/s
  return Rational((u - p.lo) / (p.hi - p.lo));
}

template <int Dim>
Exact_point<Dim> local_point(const Curve_piece<Dim>& piece, const Rational& s)
{
  const Rational w = plain_value<1>(piece.weight, {s});
  Exact_point<Dim> p;
  for (std::size_t v = 0; v < p.size(); ++v) p[v] = plain_value<1>(piece.numerator[v], {s}) / w;
  return p;
}

inline bool covers(const Piece& p, const Rational& u)
{
  return (p.lo_infinite || p.lo <= u) && (p.hi_infinite || u <= p.hi);
}

/// The points that the pieces which hold a parameter give there: one, or where two of them meet twice the same.
template <int Dim>
std::vector<Exact_point<Dim>> points_at(const Rational_curve<Dim>& c, const Rational& u)
{
  std::vector<Exact_point<Dim>> points;
  for (std::size_t k = 0; k < c.pieces().size(); ++k)
    if (covers(c.chain().pieces[k], u)) points.push_back(local_point(c.pieces()[k], local_value(c.chain().pieces[k], u)));
  return points;
}

template <int Dim>
bool passes(const Rational_curve<Dim>& c, const Rational& u, const Exact_point<Dim>& p)
{
  const auto points = points_at(c, u);
  if (points.empty()) return false;
  for (const auto& q : points)
    if (q != p) return false;
  return true;
}

/// Do ranges follow each other without a gap, infinity only at the ends, joints fit in number, forms in degree, and are
/// weights positive?
template <int Dim>
bool is_well_formed(const Rational_curve<Dim>& c)
{
  const auto& ranges = c.chain().pieces;
  const std::size_t n = ranges.size();
  if (c.pieces().size() != n || (c.chain().joints.size() != n && c.chain().joints.size() + 1 != n)) return false;
  for (std::size_t k = 0; k < n; ++k) {
    const Piece& p = ranges[k];
    const Curve_piece<Dim>& piece = c.pieces()[k];
    for (const auto& x : piece.numerator)
      if (x.degree() != piece.degree()) return false;
    if (piece.weight.degree() != 0 && piece.weight.degree() != piece.degree()) return false;
    if (p.lo_infinite && (k > 0 || p.hi >= 0 || p.hi_infinite)) return false;
    if (p.hi_infinite && (k + 1 < n || p.lo <= 0)) return false;
    if (p.is_finite() && p.lo >= p.hi) return false;
    if (k > 0 && ranges[k - 1].hi != p.lo) return false;
    for (int i = 1; i < 8; ++i)
      if (plain_value<1>(piece.weight, {Rational(i) / 8}) <= 0) return false;
  }
  return true;
}

/// Cox and de Boor's recursion for the basis functions; at the last value of the domain from the left.
inline Rational basis(const std::vector<Rational>& u, std::size_t i, int d, const Rational& x, const Rational& last)
{
  if (d == 0) return u[i] < u[i + 1] && u[i] <= x && (x < u[i + 1] || (x == last && x == u[i + 1])) ? 1 : 0;
  const auto k = static_cast<std::size_t>(d);
  Rational sum = 0;
  if (u[i + k] != u[i]) sum += Rational((x - u[i]) / (u[i + k] - u[i])) * basis(u, i, d - 1, x, last);
  if (u[i + k + 1] != u[i + 1])
    sum += Rational((u[i + k + 1] - x) / (u[i + k + 1] - u[i + 1])) * basis(u, i + 1, d - 1, x, last);
  return sum;
}

// ------------------------------------------------------------------------------------------------------------ joints

/// Coefficients of 1, s, s², … of a Bernstein form, from its definition.
inline Polynomial in_powers(const Bernstein<Rational, 1>& f)
{
  Polynomial sum;
  const int n = f.degree();
  for (int i = 0; i <= n; ++i) {
    Polynomial term{Rational(f[static_cast<std::size_t>(i)] * choose(n, i))};
    for (int j = 0; j < n; ++j) term = times(term, j < i ? Polynomial{0, 1} : Polynomial{1, -1});
    sum = plus(sum, term);
  }
  return sum;
}

/// Derivatives of order 0, 1, …, `count` - 1 by the parameter at one end of a finite piece, by the quotient rule
/// x⁽ᵏ⁾ = (p⁽ᵏ⁾ - Σ C(k,j) w⁽ʲ⁾ x⁽ᵏ⁻ʲ⁾)/w.
template <int Dim>
std::vector<Exact_point<Dim>> derivatives_at(const Curve_piece<Dim>& piece, const Piece& range, bool at_finish, int count)
{
  const Rational h = range.hi - range.lo, s = at_finish ? 1 : 0;
  const auto all = [&](const Bernstein<Rational, 1>& f) {
    std::vector<Rational> out;
    Polynomial g = in_powers(f);
    Rational scale = 1;
    for (int k = 0; k < count; ++k) {
      out.push_back(Rational(horner(g, s) * scale));
      g = slope(g);
      scale /= h;
    }
    return out;
  };
  const std::vector<Rational> w = all(piece.weight);
  std::vector<Exact_point<Dim>> x(static_cast<std::size_t>(count));
  for (std::size_t v = 0; v < static_cast<std::size_t>(Dim); ++v) {
    const std::vector<Rational> p = all(piece.numerator[v]);
    for (int k = 0; k < count; ++k) {
      Rational sum = p[static_cast<std::size_t>(k)];
      for (int j = 1; j <= k; ++j)
        sum -= choose(k, j) * w[static_cast<std::size_t>(j)] * x[static_cast<std::size_t>(k - j)][v];
      x[static_cast<std::size_t>(k)][v] = sum / w[0];
    }
  }
  return x;
}

/// Direction of travel: the first derivative that does not vanish; on the left side an even one points backwards.
template <std::size_t N>
std::array<Rational, N> travel(const std::vector<std::array<Rational, N>>& x, bool left)
{
  const std::array<Rational, N> zero{};
  std::size_t k = 1;
  while (k < x.size() && x[k] == zero) ++k;
  if (k == x.size()) throw std::logic_error("travel: a single point");
  std::array<Rational, N> d = x[k];
  if (left && k % 2 == 0)
    for (Rational& c : d) c = -c;
  return d;
}

/// The joint of two finite pieces judged by their derivatives.
template <int Dim>
Joint judged_joint(const Curve_piece<Dim>& a, const Piece& ra, const Curve_piece<Dim>& b, const Piece& rb)
{
  const int count = 2 * std::max(a.degree(), b.degree()) + 3;
  const auto x = derivatives_at(a, ra, true, count), y = derivatives_at(b, rb, false, count);
  Joint joint;
  joint.order = 0;
  const Exact_point<Dim> p = travel(x, true), q = travel(y, false), zero{};
  bool parallel = true;
  Rational along = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    along += p[i] * q[i];
    for (std::size_t j = 0; j < i; ++j) parallel = parallel && Rational(p[i] * q[j]) == Rational(p[j] * q[i]);
  }
  if (!parallel || along <= 0) {
    joint.kind = Joint_kind::corner;
    return joint;
  }
  joint.kind = Joint_kind::g1;
  if (x[1] != y[1] || x[1] == zero) return joint;
  joint.kind = Joint_kind::smooth;
  std::size_t k = 1;
  while (k < x.size() && x[k] == y[k]) ++k;
  joint.order = k == x.size() ? Joint::any_order : static_cast<int>(k) - 1;
  return joint;
}

inline bool same_joint(const Joint& a, const Joint& b)
{
  return a.kind == b.kind && a.order == b.order && a.by_tolerance == b.by_tolerance;
}

inline std::string show(const Joint& j)
{
  static const char* const names[] = {"smooth", "g1", "corner", "pole"};
  const std::string kind = names[static_cast<std::size_t>(j.kind)];
  return kind + " " + std::to_string(j.order) + (j.by_tolerance ? " (tolerance)" : "");
}

template <int Dim>
std::string show_curve(const Rational_curve<Dim>& c)
{
  std::string text;
  for (std::size_t k = 0; k < c.pieces().size(); ++k) {
    const Piece& r = c.chain().pieces[k];
    text += "[" + (r.lo_infinite ? "-inf" : r.lo.get_str()) + ", " + (r.hi_infinite ? "inf" : r.hi.get_str()) + "] ";
    for (const auto& x : c.pieces()[k].numerator) text += show(x.coefficients()) + " ";
    text += "/ " + show(c.pieces()[k].weight.coefficients());
    text += k < c.chain().joints.size() ? "; " + show(c.chain().joints[k]) + "\n" : "\n";
  }
  return text;
}

/// Whether all joints of a curve on a bounded domain are what its derivatives say.
template <int Dim>
bool joints_are_true(const Rational_curve<Dim>& c)
{
  const std::size_t n = c.pieces().size();
  for (std::size_t k = 0; k < c.chain().joints.size(); ++k) {
    const std::size_t next = (k + 1) % n;
    const Joint judged = judged_joint(c.pieces()[k], c.chain().pieces[k], c.pieces()[next], c.chain().pieces[next]);
    if (!same_joint(judged, c.chain().joints[k])) return false;
  }
  return true;
}

} // namespace locus_test

#endif
