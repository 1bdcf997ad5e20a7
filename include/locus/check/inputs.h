// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_INPUTS_H
#define LOCUS_CHECK_INPUTS_H

#include <locus/check/certificate.h>

namespace locus {
namespace check {

using Fractions = std::vector<Rational>;

inline std::string name(const Rational& x) { return x.get_str(); }

/// What the inputs' pieces are, from the job's own numbers; and that the certificate's pieces are these.
class Input_check {
public:
  Input_check(const Curve& curve, std::size_t index) : curve_(curve), where_("curve " + std::to_string(index)) {}

  void run() const
  {
    if (curve_.pieces.empty()) throw Refused(where_ + ": no pieces");
    check_ranges();
    for (std::size_t k = 0; k < curve_.pieces.size(); ++k) check_piece(k);
    check_joints();
  }

private:
  [[noreturn]] void refuse(std::size_t piece, const std::string& what) const
  {
    throw Refused(where_ + ", piece " + std::to_string(piece) + ": " + what);
  }

  // ------------------------------------------------------------------------------------------------ the domain

  std::array<std::optional<Rational>, 2> domain() const
  {
    const Input& in = curve_.input;
    if (in.is_monomial) return {in.lo, in.hi};
    if (in.knots.empty()) return {Rational(0), Rational(1)};
    return {in.knots[cast(in.degree)], in.knots[in.points.size()]};
  }

  void check_ranges() const
  {
    const auto whole = domain();
    const auto& pieces = curve_.pieces;
    if (pieces.front().lo != whole[0] || pieces.back().hi != whole[1]) throw Refused(where_ + ": the pieces do not cover its domain");
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (k > 0 && (!pieces[k].lo || pieces[k].lo != pieces[k - 1].hi)) refuse(k, "does not begin where the piece before it ends");
      if (!pieces[k].lo && !pieces[k].hi) refuse(k, "is infinite at both ends");
      if (pieces[k].lo && pieces[k].hi ? *pieces[k].lo >= *pieces[k].hi : pieces[k].lo ? *pieces[k].lo <= 0 : *pieces[k].hi >= 0)
        refuse(k, "its range is none");
    }
  }

  // ----------------------------------------------------------------------------------------- polynomials of an input

  static Fractions times_line(const Fractions& f, const Rational& constant, const Rational& slope)
  {
    Fractions g(f.size() + 1);
    for (std::size_t i = 0; i < f.size(); ++i) {
      g[i] += f[i] * constant;
      g[i + 1] += f[i] * slope;
    }
    return g;
  }

  /// Powers of u of the B-spline basis functions that do not vanish on the span before knot `span + 1`, by their recurrence.
  static std::vector<Fractions> basis(const Fractions& u, std::size_t span, std::size_t degree)
  {
    std::vector<Fractions> b{{Rational(1)}};
    for (std::size_t k = 1; k <= degree; ++k) {
      std::vector<Fractions> next(k + 1, Fractions(k + 1));
      for (std::size_t j = 0; j < k; ++j) { // b[j] belongs to the knots from span - k + 1 + j on
        const Rational &lo = u[span - k + 1 + j], &hi = u[span + 1 + j], w = 1 / (hi - lo);
        const Fractions up = times_line(b[j], Rational(-lo * w), w), down = times_line(b[j], Rational(hi * w), Rational(-w));
        for (std::size_t i = 0; i <= k; ++i) {
          next[j + 1][i] += up[i];
          next[j][i] += down[i];
        }
      }
      b = std::move(next);
    }
    return b;
  }

  /// Knots of a Bézier curve are those of [0, 1].
  Fractions knots() const
  {
    if (!curve_.input.knots.empty()) return curve_.input.knots;
    Fractions u(cast(curve_.input.degree) + 1, Rational(0));
    u.resize(2 * u.size(), Rational(1));
    return u;
  }

  /// x, y and w in powers of the input's parameter on a piece.
  std::array<Fractions, 3> forms(std::size_t piece) const
  {
    const Input& in = curve_.input;
    if (in.is_monomial) return in.power;
    const Fractions u = knots();
    const std::size_t degree = cast(in.degree);
    std::size_t span = degree;
    while (span + 1 < in.points.size() && u[span + 1] <= *curve_.pieces[piece].lo) ++span;
    if (*curve_.pieces[piece].hi > u[span + 1]) refuse(piece, "reaches over a knot");
    const auto b = basis(u, span, degree);
    std::array<Fractions, 3> f;
    for (auto& x : f) x.resize(degree + 1);
    for (std::size_t j = 0; j <= degree; ++j) {
      const std::size_t i = span - degree + j;
      const Rational w = in.weights.empty() ? Rational(1) : in.weights[i];
      for (std::size_t k = 0; k <= degree; ++k) {
        for (std::size_t v = 0; v < 2; ++v) f[v][k] += b[j][k] * in.points[i][v] * w;
        f[2][k] += b[j][k] * w;
      }
    }
    return f;
  }

  /// The same in powers of the local coordinate s, as integers with one factor: u = lo + s(hi - lo), or u = lo/(1-s), u = hi/s.
  std::array<Powers, 3> local_forms(std::size_t piece) const
  {
    std::array<Fractions, 3> f = forms(piece);
    std::size_t size = 1;
    Integer d = 1;
    for (const auto& x : f) size = std::max(size, x.size());
    for (auto& x : f) {
      x.resize(size);
      d = lcm(d, common_denominator(x));
    }
    std::array<Powers, 3> local;
    for (std::size_t k = 0; k < 3; ++k) {
      Powers g;
      for (const Rational& x : f[k]) g.push_back(x.get_num() * (d / x.get_den()));
      local[k] = in_local_coordinate(g, curve_.pieces[piece]);
    }
    return local;
  }

  static Powers in_local_coordinate(const Powers& f, const Piece& range)
  {
    if (range.lo && range.hi) {
      const Integer d = lcm(range.lo->get_den(), range.hi->get_den());
      const Integer a = range.lo->get_num() * (d / range.lo->get_den());
      return on_line(f, a, range.hi->get_num() * (d / range.hi->get_den()) - a, d);
    }
    // Σ f_i·c^i·s^(n-i) for u = c/s, and 1 - s for s where the other end is infinite.
    const Rational& c = range.lo ? *range.lo : *range.hi;
    Powers g(f.size());
    Integer numerator = 1;
    for (std::size_t i = 0; i < f.size(); ++i, numerator *= c.get_num()) g[f.size() - 1 - i] = f[i] * numerator;
    Integer denominator = 1;
    for (Integer& x : g) x *= denominator, denominator *= c.get_den();
    return range.lo ? on_line(g, 1, -1, 1) : g;
  }

  // ------------------------------------------------------------------------------------------------------- pieces

  static Powers difference(const Powers& f, const Powers& g) { return sum(f, g, -1); }

  void check_piece(std::size_t k) const
  {
    const Piece& p = curve_.pieces[k];
    const std::array<Powers, 3> in = local_forms(k);
    for (std::size_t v = 0; v < 2; ++v)
      if (!difference(product(p.point[v], in[2]), product(in[v], p.point[2])).empty()) refuse(k, "is not the input on its range");
    if (!is_positive_inside(p.point[2])) refuse(k, "its denominator is not positive");
    std::array<Powers, 2> d; // p'w - pw'
    for (std::size_t v = 0; v < 2; ++v)
      d[v] = difference(product(derivative(p.point[v]), p.point[2]), product(p.point[v], derivative(p.point[2])));
    if (!difference(product(d[0], p.tangent[1]), product(d[1], p.tangent[0])).empty()) refuse(k, "its tangent is another one");
    if (!is_positive_inside(sum(product(d[0], p.tangent[0]), product(d[1], p.tangent[1])))) refuse(k, "its tangent reverses");
    if (!has_no_zero(bernstein(in_variable(sum(product(p.tangent[0], p.tangent[0]), product(p.tangent[1], p.tangent[1])), 0)), 40))
      refuse(k, "its tangent vanishes");
    for (int end = 0; end < 2; ++end)
      if (at_end(p.point[2], end) == 0 && at_end(p.point[0], end) == 0 && at_end(p.point[1], end) == 0) refuse(k, "is 0/0 at an end");
  }

  /// Positive on the open unit interval; zeros at the ends do not count.
  static bool is_positive_inside(const Powers& f)
  {
    if (f.empty()) return false;
    Powers c = on_half_line(bernstein(in_variable(f, 0)).c);
    while (c.back() == 0) c.pop_back();
    while (c.front() == 0) c.erase(c.begin());
    return c.front() > 0 && (variations(c) == 0 || Sturm_chain(c).positive() == 0);
  }

  static Integer at_end(const Powers& f, int end) { return f.empty() ? Integer(0) : homogeneous_value(f, end, 1); }

  /// Joints are smooth just where they are said to be; what a tolerance joins meets at least.
  void check_joints() const
  {
    const std::size_t n = curve_.pieces.size(), count = curve_.joints.size();
    // A whole line is closed through infinity if the curve has a point there.
    const bool is_whole_line = curve_.input.is_monomial && !curve_.input.lo && !curve_.input.hi;
    const bool is_closed = curve_.input.closed || (is_whole_line && meet(curve_.pieces.back(), curve_.pieces.front()));
    if (count + !is_closed != n) throw Refused(where_ + ": its joints are too many or too few");
    for (std::size_t k = 0; k < count; ++k) {
      const Piece &a = curve_.pieces[k], &b = curve_.pieces[(k + 1) % n];
      if ((curve_.joints[k] == Joint::smooth) != is_smooth(a, b)) refuse(k, "its joint is not as it is said to be");
      if (curve_.joints[k] == Joint::tolerance && !meet(a, b)) refuse(k, "does not meet the next one");
    }
  }

  /// One finite point on both sides.
  static bool meet(const Piece& a, const Piece& b)
  {
    std::array<Integer, 3> p, q;
    for (std::size_t v = 0; v < 3; ++v) p[v] = at_end(a.point[v], 1), q[v] = at_end(b.point[v], 0);
    return p[2] != 0 && q[2] != 0 && p[0] * q[2] == q[0] * p[2] && p[1] * q[2] == q[1] * p[2];
  }

  /// One direction of travel, too.
  static bool is_smooth(const Piece& a, const Piece& b)
  {
    std::array<Integer, 2> s, t;
    for (std::size_t v = 0; v < 2; ++v) s[v] = at_end(a.tangent[v], 1), t[v] = at_end(b.tangent[v], 0);
    return meet(a, b) && s[0] * t[1] == s[1] * t[0] && s[0] * t[0] + s[1] * t[1] > 0;
  }

  const Curve& curve_;
  std::string where_;
};

} // namespace check
} // namespace locus

#endif
