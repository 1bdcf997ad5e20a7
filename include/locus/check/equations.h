// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_EQUATIONS_H
#define LOCUS_CHECK_EQUATIONS_H

#include <locus/check/certificate.h>

#include <optional>

namespace locus {
namespace check {

/// ratio·t(1-r) - r(1-t) times the ratio's denominator, with 1 - r for r where reversed.
inline Table polynomial_of(const Line& line)
{
  const Integer &p = line.ratio.get_num(), &q = line.ratio.get_den();
  Table f(1, 1);
  if (line.reversed) {
    f.at(0, 0) = -q;
    f.at(1, 0) = f.at(0, 1) = q;
    f.at(1, 1) = p - q;
  } else {
    f.at(1, 0) = p;
    f.at(0, 1) = -q;
    f.at(1, 1) = q - p;
  }
  return f;
}

/// The second parameter on a line.
inline Rational partner_of(const Line& line, const Rational& t)
{
  const Rational r = line.ratio * t / (1 - t + line.ratio * t);
  return line.reversed ? Rational(1 - r) : r;
}

/// A polynomial in the parameters as one in a chart's coordinates.
inline Table in_chart(Table f, const Chart& chart)
{
  if (chart.is_plain) return f;
  for (int v = 0; v < 2; ++v)
    if (chart.corner[cast(v)] == 1) f = mirrored(std::move(f), v);
  const auto& e = chart.exponent;
  Table g(f.degree[0] * e[0][0] + f.degree[1] * e[1][0], f.degree[0] * e[0][1] + f.degree[1] * e[1][1]);
  for (int i = 0; i <= f.degree[0]; ++i)
    for (int j = 0; j <= f.degree[1]; ++j) g.at(i * e[0][0] + j * e[1][0], i * e[0][1] + j * e[1][1]) = f.at(i, j);
  return g;
}

/// An edge x_variable = 0 that is the blown-up corner.
inline bool is_exceptional(const Chart& chart, std::size_t variable)
{
  return !chart.is_plain && chart.exponent[0][variable] > 0 && chart.exponent[1][variable] > 0;
}

/// The polynomials of two pieces, from their coordinates in real notation, with e = p1·w2 - p2·w1 and the tangents a and b.
class Pair {
public:
  Pair(const Piece& p, const Piece& q) : p_(p), q_(q)
  {
    Table zero(0, 0);
    for (std::size_t v = 0; v < 2; ++v) {
      e_[v] = sum(outer_product(p.point[v], q.point[2]), outer_product(p.point[2], q.point[v]), -1);
      zero = sum(zero, Table(e_[v].degree[0], e_[v].degree[1]), 1);
    }
    for (Table& e : e_) e = sum(e, zero, 1); // both of one degree
  }

  const Table& chord(std::size_t axis) const { return e_[axis]; }

  /// -[(a×e)(b·e) + (a·e)(b×e)]
  Table angle_form() const
  {
    return sum(product(cross(p_, 0), dot(q_, 1)), product(dot(p_, 0), cross(q_, 1)), 1);
  }

  /// |a|²(e·b)² - |b|²(e·a)²: the equation (3) of Elber and Kim 1998, with false zeros where W = a×b vanishes.
  Table squared_form() const
  {
    const Table ea = dot(p_, 0), eb = dot(q_, 1);
    return sum(product(in_variable(squared_speed(p_), 0), product(eb, eb)), product(in_variable(squared_speed(q_), 1), product(ea, ea)), -1);
  }

  /// a×b
  Table wronskian() const
  {
    return sum(outer_product(p_.tangent[0], q_.tangent[1]), outer_product(p_.tangent[1], q_.tangent[0]), -1);
  }

  /// Whether the circles grow without bound at a pair of parameters: a common tangent line, or feet in one place where both
  /// curvatures vanish.
  bool is_infinite_at(const Rational& t, const Rational& r) const
  {
    const bool is_meeting = sign_at(e_[0], t, r) == 0 && sign_at(e_[1], t, r) == 0;
    if (is_meeting) return bends(p_, t) == 0 && bends(q_, r) == 0;
    return sign_at(cross(p_, 0), t, r) == 0 && sign_at(cross(q_, 1), t, r) == 0;
  }

  /// The equation of a patch times what was divided out of it is the pair's own equation.
  bool has_equation(const Patch& patch) const
  {
    if (patch.vanishes) return angle_form().is_zero();
    const Table parallel = wronskian();
    const bool use_angle = parallel.is_zero();
    Table known = use_angle ? in_variable(Powers{1}, 0) : parallel;
    for (int v = 0; v < 2; ++v) known = product(known, in_variable(patch.factor[cast(v)], v));
    for (const Divided_line& l : patch.lines)
      for (int k = 0; k < l.power; ++k) known = product(known, polynomial_of(l.line));
    return agree(in_chart(use_angle ? angle_form() : squared_form(), patch.chart), product(in_chart(std::move(known), patch.chart), patch.equation),
                 patch.chart);
  }

private:
  static int bends(const Piece& p, const Rational& u)
  {
    return sign_at(sum(product(p.tangent[0], derivative(p.tangent[1])), product(p.tangent[1], derivative(p.tangent[0])), -1), u);
  }

  static Powers squared_speed(const Piece& p) { return sum(product(p.tangent[0], p.tangent[0]), product(p.tangent[1], p.tangent[1])); }

  Table dot(const Piece& p, int variable) const
  {
    return sum(product(e_[0], in_variable(p.tangent[0], variable)), product(e_[1], in_variable(p.tangent[1], variable)), 1);
  }
  Table cross(const Piece& p, int variable) const
  {
    return sum(product(e_[1], in_variable(p.tangent[0], variable)), product(e_[0], in_variable(p.tangent[1], variable)), -1);
  }

  /// Equal up to a constant; on a chart up to powers of the coordinates that vanish only at the corner.
  static bool agree(const Table& whole, const Table& product, const Chart& chart)
  {
    if (whole.is_zero() || product.is_zero()) return false;
    if (chart.is_plain) return are_proportional(whole, {0, 0}, product, {0, 0});
    const auto a = lowest_powers(whole), b = lowest_powers(product);
    for (std::size_t v = 0; v < 2; ++v)
      if (a[v] < b[v] || (a[v] > b[v] && !is_exceptional(chart, v))) return false;
    return are_proportional(whole, a, product, b);
  }

  const Piece &p_, &q_;
  std::array<Table, 2> e_;
};

// ------------------------------------------------------------------------------------------------- singular points

/// Proves that a point with F = 0 and ∇F = 0 exists where a certificate says so.
class Singular_check {
public:
  Singular_check(const Pair& pair, const Patch& patch) : pair_(pair), patch_(patch) {}

  /// An empty reason is a proof.
  std::string refusal(const Singular& s) const
  {
    return s.algebraic ? algebraic_refusal(s) : s.axis ? axis_refusal(s) : meeting_refusal(s);
  }

private:
  /// The curves meet: F is of second order in e, and what was divided out of it does not vanish there.
  std::string meeting_refusal(const Singular& s) const
  {
    const Box box{{{s.at[0].lo, s.at[0].hi}, {s.at[1].lo, s.at[1].hi}}};
    for (std::size_t v = 0; v < 2; ++v)
      if (is_exceptional(patch_.chart, v) && box[v][0] <= 0) return "its box touches the blown-up corner";
    for (int v = 0; v < 2; ++v)
      if (!is_nonzero(in_variable(patch_.factor[cast(v)], v), box)) return "a factor that was divided out may vanish there";
    for (const Divided_line& l : patch_.lines)
      if (!is_nonzero(polynomial_of(l.line), box)) return "a line that was divided out may pass there";
    const Table x = in_chart(pair_.chord(0), patch_.chart), y = in_chart(pair_.chord(1), patch_.chart);
    return vanish_in(s, x, y) ? "" : "the curves are not proved to meet there";
  }

  /// Two functions have a common zero in the range of a point.
  static bool vanish_in(const Singular& s, const Table& x, const Table& y)
  {
    const Box box{{{s.at[0].lo, s.at[0].hi}, {s.at[1].lo, s.at[1].hi}}};
    return s.at[0].is_exact()   ? vanish_together(on_value(x, 0, s.at[0].lo), on_value(y, 0, s.at[0].lo), s.at[1])
           : s.at[1].is_exact() ? vanish_together(on_value(x, 1, s.at[1].lo), on_value(y, 1, s.at[1].lo), s.at[0])
                                : meet_inside(bernstein_on(x, box), bernstein_on(y, box));
  }

  /// The equation is zero all along a line, and its first derivative at a point of it: so is the other derivative there.
  std::string axis_refusal(const Singular& s) const
  {
    const Table& f = patch_.equation;
    if (is_exceptional(patch_.chart, 0) || is_exceptional(patch_.chart, 1)) return "an axis is no line of a chart";
    if (s.axis->ratio <= 0) return "an axis has a positive ratio";
    const int degree = f.degree[0] + f.degree[1];
    for (int k = 0; k <= degree; ++k) { // on the line f has at most this degree, and is zero at one place more
      const Rational t = Rational(k) / Rational(degree + 1);
      if (sign_at(f, t, partner_of(*s.axis, t)) != 0) return "the equation does not vanish along the axis";
    }
    const Table slope = derivative(f, 0);
    Table line(slope.degree[0], slope.degree[1]); // as functions of the same degrees
    const Table plain = polynomial_of(*s.axis);
    for (int i = 0; i <= std::min(1, slope.degree[0]); ++i)
      for (int j = 0; j <= std::min(1, slope.degree[1]); ++j) line.at(i, j) = plain.at(i, j);
    if (slope.degree[0] < 1 || slope.degree[1] < 1) return "nothing is proved to cross the axis there";
    return vanish_in(s, line, slope) ? "" : "nothing is proved to cross the axis there";
  }

  bool is_nonzero(const Table& f, const Box& box) const { return has_no_zero(bernstein_on(in_chart(f, patch_.chart), box), 16); }

  /// A common root in a range, or at an exact value: the common factor changes its sign.
  static bool vanish_together(const Powers& f, const Powers& g, const Range& at)
  {
    const Powers common = f.empty() ? g : g.empty() ? f : common_factor(f, g);
    if (at.is_exact()) return sign_at(common, at.lo) == 0;
    return common.size() > 1 && sign_at(common, at.lo) * sign_at(common, at.hi) < 0;
  }

  /// Miranda's theorem: two combinations of f and g have opposite strict signs on opposite sides of the box.
  static bool meet_inside(const Table& f, const Table& g)
  {
    const auto slope = [](const Table& h, int v) -> Integer { return mean(side_of(h, v, 1)) - mean(side_of(h, v, 0)); };
    const Integer a = slope(f, 0), b = slope(f, 1), c = slope(g, 0), d = slope(g, 1);
    return separates(combination(f, d, g, -b), 0) && separates(combination(f, -c, g, a), 1);
  }

  static Integer mean(const Powers& c)
  {
    Integer total = 0;
    for (const Integer& x : c) total += x;
    return total;
  }

  static Table combination(const Table& f, const Integer& p, const Table& g, const Integer& q)
  {
    Table h(f.degree[0], f.degree[1]);
    for (std::size_t i = 0; i < h.c.size(); ++i) h.c[i] = p * f.c[i] + q * g.c[i];
    return h;
  }

  static bool separates(const Table& h, int variable)
  {
    return strict_sign(side_of(h, variable, 0)) * strict_sign(side_of(h, variable, 1)) < 0;
  }

  // ----------------------------------------------------------------------------------------------- algebraic evidence

  using Fractions = std::vector<Rational>;

  std::string algebraic_refusal(const Singular& s) const
  {
    const Algebraic& a = *s.algebraic;
    if (a.m.size() < 2 || a.m.back() == 0 || a.h.size() < 2 || a.h.back() != Fractions{1}) return "its polynomials are none";
    if (s.at[0].lo != a.lo || s.at[0].hi != a.hi || s.at[1].lo != a.r_lo || s.at[1].hi != a.r_hi) return "its box is another one";
    if (a.lo == a.hi ? sign_at(a.m, a.lo) != 0 : sign_at(a.m, a.lo) * sign_at(a.m, a.hi) >= 0) return "m has no root there";
    if (!crosses(a)) return "h has no root there";
    for (const Table& f : {patch_.equation, derivative(patch_.equation, 0), derivative(patch_.equation, 1)})
      if (!reduces_to_zero(f, a)) return "the equation or its gradient does not vanish modulo m and h";
    return "";
  }

  /// h has opposite strict signs at both ends for every x in [lo, hi], or vanishes at an exact end.
  static bool crosses(const Algebraic& a)
  {
    if (a.r_lo == a.r_hi) return reduced(value(a, a.r_lo), a.m).empty();
    return range_sign(value(a, a.r_lo), a) * range_sign(value(a, a.r_hi), a) < 0;
  }

  static Fractions value(const Algebraic& a, const Rational& y)
  {
    Fractions f;
    for (std::size_t j = a.h.size(); j-- > 0;) {
      for (Rational& c : f) c *= y;
      f.resize(std::max(f.size(), a.h[j].size()));
      for (std::size_t i = 0; i < a.h[j].size(); ++i) f[i] += a.h[j][i];
    }
    return f;
  }

  static int range_sign(const Fractions& f, const Algebraic& a)
  {
    const Integer d = common_denominator(f);
    Powers g;
    for (const Rational& x : f) g.push_back(x.get_num() * (d / x.get_den()));
    trim(g);
    if (g.empty()) return 0;
    return strict_sign(bernstein_on(in_variable(g, 0), {{{a.lo, a.hi}, {Rational(0), Rational(1)}}}).c);
  }

  /// Remainder by m.
  static Fractions reduced(Fractions f, const Powers& m)
  {
    while (f.size() >= m.size()) {
      const Rational q = f.back() / m.back();
      for (std::size_t i = 0; i < m.size(); ++i) f[f.size() - m.size() + i] -= q * m[i];
      f.pop_back();
    }
    while (!f.empty() && f.back() == 0) f.pop_back();
    return f;
  }

  /// f is zero modulo m(x) and h(x, y), h with the leading coefficient 1.
  static bool reduces_to_zero(const Table& f, const Algebraic& a)
  {
    std::vector<Fractions> rows; // by powers of y
    for (int j = 0; j <= f.degree[1]; ++j) {
      rows.emplace_back();
      for (int i = 0; i <= f.degree[0]; ++i) rows.back().push_back(Rational(f.at(i, j)));
      rows.back() = reduced(rows.back(), a.m);
    }
    for (; rows.size() >= a.h.size(); rows.pop_back())
      for (std::size_t k = 0; k + 1 < a.h.size(); ++k) subtract_product(rows[rows.size() - a.h.size() + k], rows.back(), a.h[k], a.m);
    return std::all_of(rows.begin(), rows.end(), [](const Fractions& row) { return row.empty(); });
  }

  static void subtract_product(Fractions& from, const Fractions& f, const Fractions& g, const Powers& m)
  {
    if (f.empty() || g.empty()) return;
    from.resize(std::max(from.size(), f.size() + g.size() - 1));
    for (std::size_t i = 0; i < f.size(); ++i)
      for (std::size_t j = 0; j < g.size(); ++j) from[i + j] -= f[i] * g[j];
    from = reduced(from, m);
  }

  const Pair& pair_;
  const Patch& patch_;
};

} // namespace check
} // namespace locus

#endif
