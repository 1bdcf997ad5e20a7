// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_F3_SYSTEM_H
#define LOCUS_CONSTRAINT_F3_SYSTEM_H

#include <locus/constraint/planar_equations.h>

#include <optional>
#include <vector>

namespace locus {

/// A component of F3 = 0 that is no arc of the bisector.
struct Degenerate_component {
  enum class Kind : unsigned char {
    centre,     ///< maps to one point, the centre of the circle that carries an input
    infinity,   ///< maps to infinity: the curve is tangent there to the line that carries the other input
    overlap,    ///< the inputs coincide along it; every point of it is its own bisector point
    everything  ///< F3 vanishes identically: both inputs lie on one line or one circle
  };
  Kind kind = Kind::everything;
  int input = -1;              ///< whose parameter is constant along it (centre, infinity)
  double lo = 0, hi = 1;       ///< enclosure of that parameter, on the unit interval
  int multiplicity = 1;
  bool reversed = false;       ///< overlap along t + r = 1 instead of t = r
};

/// The bisector of two planar curve pieces as a system in their parameters.
struct F3_problem {
  std::shared_ptr<const Planar_curve> first, second;
  System<1, 2> system;
  /// For mirror images with matching parameters: the axis t = r (or t + r = 1), a factor of F3 that `system` is then
  /// without. Both have the cause number 0 in common, their crossings.
  std::optional<System<1, 2>> axis;
  bool axis_reversed = false;
  Degrees<2> degrees{}; ///< of the equation as solved
  std::vector<Degenerate_component> degenerate;
};

namespace detail {

/// Polynomials whose greatest common divisor is the factor of f that depends on `variable` alone.
inline std::vector<Bernstein<Scaled_integer, 1>> rows_along(const Bernstein<Scaled_integer, 2>& f, int variable)
{
  std::vector<Bernstein<Scaled_integer, 1>> rows;
  const int other = 1 - variable;
  for (int i = 0; i <= f.degree(other); ++i) {
    Bernstein<Integer, 1> row(Degrees<1>{f.degree(variable)});
    for (int j = 0; j <= f.degree(variable); ++j)
      row[static_cast<std::size_t>(j)] = f.values().at(variable == 1 ? Degrees<2>{i, j} : Degrees<2>{j, i});
    rows.emplace_back(std::move(row), Rational(1));
  }
  return rows;
}

inline Integer_polynomial univariate_factor(const Bernstein<Scaled_integer, 2>& f, int variable)
{
  Integer_polynomial common;
  for (const auto& row : rows_along(f, variable)) {
    if (row.is_zero()) continue;
    common = gcd(common, monomial_form(row));
    if (degree(common) == 0) break;
  }
  return common;
}

/// A factor in `variable` alone can have no zero on the unit interval if some coefficient row has none.
inline bool has_row_without_zero(const Bernstein<Interval, 2>& f, int variable)
{
  const int other = 1 - variable;
  for (int i = 0; i <= f.degree(other); ++i) {
    Sign all = Sign::unknown;
    for (int j = 0; j <= f.degree(variable); ++j) {
      const Sign s = sign_of(f.at(variable == 1 ? Degrees<2>{i, j} : Degrees<2>{j, i}));
      all = j == 0 || s == all ? s : Sign::unknown;
      if (!is_strict(all)) break;
    }
    if (is_strict(all)) return true;
  }
  return false;
}

inline Bernstein<Rational, 2> as_bivariate(const Bernstein<Rational, 1>& f, int variable)
{
  return {variable == 0 ? Degrees<2>{f.degree(), 0} : Degrees<2>{0, f.degree()}, f.coefficients()};
}

/// t - r, or t + r - 1, in Bernstein form.
inline Bernstein<Rational, 2> diagonal(bool reversed)
{
  if (reversed) return {Degrees<2>{1, 1}, {-1, 0, 0, 1}};
  return {Degrees<2>{1, 1}, {0, -1, 1, 0}};
}

/// Coefficient k, in the scaled basis, of f(t, t) (or f(t, 1-t)): a sum over i + j = k.
inline Integer diagonal_coefficient(const Bernstein<Scaled_integer, 2>& f, bool reversed, int k)
{
  const int n = f.degree(0), m = f.degree(1);
  Integer sum = 0;
  for (int i = std::max(0, k - m); i <= std::min(n, k); ++i) {
    const int j = k - i;
    sum += binomial<Integer>(n, i) * binomial<Integer>(m, j) * f.values().at({i, reversed ? m - j : j});
  }
  return sum;
}

inline bool vanishes_on_diagonal(const Bernstein<Scaled_integer, 2>& f, bool reversed)
{
  for (int k = 0; k <= f.degree(0) + f.degree(1); ++k)
    if (diagonal_coefficient(f, reversed, k) != 0) return false;
  return true;
}

/// f(t, t), or f(t, 1-t).
inline Bernstein<Scaled_integer, 1> on_diagonal(const Bernstein<Scaled_integer, 2>& f, bool reversed)
{
  const int n = f.degree(0) + f.degree(1);
  Bernstein<Rational, 1> g(Degrees<1>{n});
  for (int k = 0; k <= n; ++k) g[static_cast<std::size_t>(k)] = Rational(diagonal_coefficient(f, reversed, k)) / binomial<Integer>(n, k);
  return Bernstein<Scaled_integer, 1>(g);
}

struct Diagonal_quotient {
  Bernstein<Rational, 2> rest;
  int multiplicity = 0;
};

/// Divides t - r (or t + r - 1) out of a nonzero polynomial as often as it goes.
inline Diagonal_quotient divided_by_diagonal(Bernstein<Scaled_integer, 2> f, bool reversed)
{
  Diagonal_quotient q{f.rational(), 0};
  while (f.degree(0) > 0 && f.degree(1) > 0 && vanishes_on_diagonal(f, reversed)) {
    q.rest = divide_exactly(q.rest, diagonal(reversed));
    f = Bernstein<Scaled_integer, 2>(q.rest);
    ++q.multiplicity;
  }
  return q;
}

template <class Form>
std::shared_ptr<const Equation<2>> pair_equation(const F3_problem& p)
{
  return std::make_shared<Curve_pair_equation<Form>>(p.first, p.second);
}

/// What makes F3 singular or the bisector infinite without any coincidence: the curves meet, or share a tangent line.
inline void add_geometric_causes(F3_problem& p)
{
  Cause<2> meeting;
  meeting.name = "C1 = C2";
  meeting.equations = {pair_equation<Difference_form<false>>(p), pair_equation<Difference_form<true>>(p)};
  meeting.proves = Claim_kind::crossing;
  p.system.causes.push_back(std::move(meeting));
  Cause<2> bitangent;
  bitangent.name = "common tangent line";
  bitangent.equations = {pair_equation<First_tangent_form>(p), pair_equation<Second_tangent_form>(p)};
  bitangent.proves = Claim_kind::isolated_box;
  bitangent.includes = {0};
  p.system.causes.push_back(std::move(bitangent));
}

inline void replace_equation(F3_problem& p, Bernstein<Rational, 2> f)
{
  p.system.equations[0] = std::make_shared<Polynomial_equation<2>>(std::move(f));
}

inline void note_known_factor(F3_problem& p, Bernstein<Rational, 2> factor)
{
  p.system.known_factors.push_back(std::make_shared<Polynomial_equation<2>>(std::move(factor)));
}

/// Where curve `variable` is tangent at r0 to the line or circle that carries the other one, r = r0 is a component of
/// F3 = 0 whose points all map to infinity or to the circle's centre. Divides such factors out and lists them.
inline void divide_out_tangencies(F3_problem& p, int variable)
{
  const Carrier::Kind other = (variable == 0 ? p.second : p.first)->carrier().kind;
  if (other == Carrier::Kind::general) return;
  if (has_row_without_zero(p.system.equations[0]->enclosure(Box<2>::unit()), variable)) return;
  const Bernstein<Scaled_integer, 2> f = p.system.equations[0]->exact();
  const Integer_polynomial factor = univariate_factor(f, variable);
  if (degree(factor) < 1) return;
  const Bernstein<Scaled_integer, 1> factor_form = bernstein_form(factor);
  auto roots = exact_roots(factor_form, 0.0, 1.0).roots;
  if (roots.empty()) return;
  for (auto& root : roots) {
    while (!root.is_exact() && root.hi - root.lo > 0x1p-40)
      if (!bisect_exactly(*root.factor, 0.0, 1.0, root)) break;
    Degenerate_component d;
    d.kind = other == Carrier::Kind::line ? Degenerate_component::Kind::infinity : Degenerate_component::Kind::centre;
    d.input = variable;
    d.lo = root.lo;
    d.hi = root.hi;
    d.multiplicity = root.multiplicity;
    p.degenerate.push_back(d);
  }
  const Bernstein<Rational, 2> divisor = as_bivariate(factor_form.rational(), variable);
  replace_equation(p, divide_exactly(f.rational(), divisor));
  note_known_factor(p, divisor);
  if (other == Carrier::Kind::line) {
    // Im(e ā) is h(r)·w1(t) with a double zero of h at the tangency: its square-free part gives regular poles.
    const auto tangent = variable == 1 ? pair_equation<First_tangent_form>(p) : pair_equation<Second_tangent_form>(p);
    const Integer_polynomial h = univariate_factor(tangent->exact(), variable);
    const Integer_polynomial simple = exact_quotient(h, gcd(h, derivative(h)));
    p.system.causes[1].equations = {p.system.equations[0], std::make_shared<Polynomial_equation<2>>(
                                                             as_bivariate(bernstein_form(simple).rational(), variable))};
  }
}

/// Whether a solution of two equations lies on t = r (or t + r = 1), exactly: on that line both have a common root.
inline bool lies_on_diagonal(const Isolated_solution<2>& p, const std::array<std::shared_ptr<const Equation<2>>, 2>& equations,
                             bool reversed)
{
  if (!overlap(p.box[0], reversed ? Interval(1) - p.box[1] : p.box[1])) return false;
  Integer_polynomial common;
  for (const auto& equation : equations) common = gcd(common, monomial_form(on_diagonal(equation->exact(), reversed)));
  if (degree(common) < 1) return common.empty();
  return has_root_within(common, Rational(p.box[0].inf()), Rational(p.box[0].sup()));
}

/// F3 = (t - r)·G: the axis and G = 0 are solved apart and joined where they cross. The curves' common points on the
/// axis are such crossings; common tangent lines belong to the factor on which they lie.
inline void split_off_axis(F3_problem& p, const Bernstein<Rational, 2>& rest, bool reversed)
{
  const auto line = std::make_shared<Polynomial_equation<2>>(diagonal(reversed));
  Cause<2> meeting = p.system.causes[0], bitangent = p.system.causes[1], crossing;
  const auto on_axis = [reversed](const Cause<2>& cause) {
    return [equations = cause.equations, reversed](const Isolated_solution<2>& s) { return lies_on_diagonal(s, equations, reversed); };
  };
  replace_equation(p, rest);
  crossing.name = reversed ? "the axis t + r = 1 meets the other factor" : "the axis t = r meets the other factor";
  crossing.equations = {line, p.system.equations[0]};
  crossing.proves = Claim_kind::isolated_box;
  p.axis.emplace();
  p.axis->name = "axis";
  p.axis->equations[0] = line;
  p.axis_reversed = reversed;

  Cause<2> axis_bitangent = bitangent;
  axis_bitangent.includes.clear();
  axis_bitangent.leave_out = [test = on_axis(bitangent), meet = on_axis(meeting)](const Isolated_solution<2>& s) { return !test(s) || meet(s); };
  p.axis->causes = {crossing, axis_bitangent};
  meeting.leave_out = on_axis(meeting);
  bitangent.leave_out = on_axis(bitangent);
  bitangent.includes = {1};
  p.system.causes = {crossing, meeting, bitangent};
}

/// Mirror images with matching parameters have the axis t = r (or t + r = 1) as a factor of F3, and the other factor
/// crosses it in nodes; equal curves have its fourth power, which is the curves' overlap.
/// `overlaps` says which of the two is looked for: overlaps come first, for an axis may remain beside one.
inline void divide_out_diagonal(F3_problem& p, bool reversed, bool overlaps)
{
  if (p.axis) return; // a second axis stays in the other factor, which it crosses in a declared node
  const auto enclosure = p.system.equations[0]->enclosure(Box<2>::unit());
  const int n = enclosure.degree(0);
  if (enclosure.degree(1) != n) return;
  if (!contains_zero(enclosure.at({0, reversed ? n : 0})) || !contains_zero(enclosure.at({n, reversed ? 0 : n}))) return;
  const Bernstein<Scaled_integer, 2>& f = p.system.equations[0]->exact();
  if (f.is_zero()) return;
  const auto [rest, multiplicity] = divided_by_diagonal(f, reversed);
  if (multiplicity == 0 || overlaps != (multiplicity > 1)) return;
  if (multiplicity == 1) return split_off_axis(p, rest, reversed);
  Degenerate_component d;
  d.kind = Degenerate_component::Kind::overlap;
  d.multiplicity = multiplicity;
  d.reversed = reversed;
  p.degenerate.push_back(d);
  for (int k = 0; k < multiplicity; ++k) note_known_factor(p, diagonal(reversed));
  replace_equation(p, rest);
  // The curves meet all along the overlap; only what is left of the causes can explain other points.
  for (Cause<2>& cause : p.system.causes)
    for (auto& equation : cause.equations)
      if (!equation->exact().is_zero())
        equation = std::make_shared<Polynomial_equation<2>>(divided_by_diagonal(equation->exact(), reversed).rest);
}

} // namespace detail

/// The system F3 = 0 of two planar curve pieces in a common frame (upward rounding needed): its equation without the
/// degenerate components, which are listed, and the causes of its singular and infinite points.
inline F3_problem f3_problem(std::shared_ptr<const Planar_curve> first, std::shared_ptr<const Planar_curve> second)
{
  F3_problem p;
  p.first = std::move(first);
  p.second = std::move(second);
  p.system.name = F3_form::name;
  p.system.equations[0] = detail::pair_equation<F3_form>(p);
  detail::add_geometric_causes(p);
  for (int variable : {0, 1}) detail::divide_out_tangencies(p, variable);
  for (bool overlaps : {true, false})
    for (bool reversed : {false, true}) detail::divide_out_diagonal(p, reversed, overlaps);
  p.degrees = p.system.equations[0]->degrees();
  return p;
}

} // namespace locus

#endif
