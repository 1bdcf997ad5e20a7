// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_F3_FACTORS_H
#define LOCUS_CONSTRAINT_F3_FACTORS_H

#include <locus/constraint/f3_problem.h>
#include <locus/function/diagonal.h>

namespace locus {
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

inline void replace_equation(F3_problem& p, Bernstein<Scaled_integer, 2> f)
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
  replace_equation(p, Bernstein<Scaled_integer, 2>(divide_exactly(f.rational(), divisor)));
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

/// Whether a solution of two equations lies on a line, exactly: on that line both have a common root.
inline bool lies_on_diagonal(const Isolated_solution<2>& p, const std::array<std::shared_ptr<const Equation<2>>, 2>& equations,
                             const Diagonal& line)
{
  if (is_strict(line.side(p.box))) return false;
  Integer_polynomial common;
  for (const auto& equation : equations) common = gcd(common, monomial_form(on_diagonal(equation->exact(), line)));
  if (degree(common) < 1) return common.empty();
  return has_root_within(common, Rational(p.box[0].inf()), Rational(p.box[0].sup()));
}

/// F3 = L·G with L the axis: the axis and G = 0 are solved apart and joined where they cross. The curves' common points on
/// the axis are such crossings; common tangent lines belong to the factor on which they lie.
inline void split_off_axis(F3_problem& p, const Bernstein<Scaled_integer, 2>& rest, const Diagonal& axis)
{
  const auto line = std::make_shared<Polynomial_equation<2>>(axis.polynomial());
  p.whole = p.system;
  Cause<2> meeting = p.system.causes[0], bitangent = p.system.causes[1], crossing;
  const auto on_axis = [axis](const Cause<2>& cause) {
    return [equations = cause.equations, axis](const Isolated_solution<2>& s) { return lies_on_diagonal(s, equations, axis); };
  };
  replace_equation(p, rest);
  crossing.name = "the axis meets the other factor";
  crossing.equations = {line, p.system.equations[0]};
  crossing.proves = Claim_kind::isolated_box;
  crossing.tag = tag_of(F3_cause::axis);
  Cause<2> node = crossing; // of both factors together
  node.proves = Claim_kind::crossing;
  node.includes = {0};
  p.whole->causes.push_back(std::move(node));
  p.axis.emplace();
  p.axis->name = "axis";
  p.axis->equations[0] = line;
  p.axis_line = axis;

  Cause<2> axis_bitangent = bitangent;
  axis_bitangent.includes.clear();
  axis_bitangent.leave_out = [test = on_axis(bitangent), meet = on_axis(meeting)](const Isolated_solution<2>& s) { return !test(s) || meet(s); };
  p.axis->causes = {crossing, axis_bitangent};
  meeting.leave_out = on_axis(meeting);
  bitangent.leave_out = on_axis(bitangent);
  bitangent.includes = {1};
  p.system.causes = {crossing, meeting, bitangent};
}

/// The curves meet all along an overlap; only what is left of the causes can explain other points.
inline void divide_causes_by_diagonal(F3_problem& p, const Diagonal& line)
{
  std::vector<Diagonal_quotient> rest;
  for (Cause<2>& cause : p.system.causes)
    for (auto& equation : cause.equations) {
      rest.push_back(equation->exact().is_zero() ? Diagonal_quotient{equation->exact(), 0} : divided_by_diagonal(equation->exact(), line));
      equation = std::make_shared<Polynomial_equation<2>>(rest.back().rest);
    }
  // On the line itself the curves' inflections have a tangent in common, which is no pole.
  for (Cause<2>& cause : p.system.causes)
    cause.leave_out = [equations = cause.equations, line](const Isolated_solution<2>& s) { return lies_on_diagonal(s, equations, line); };
  // The equations of both causes: both coordinates of e, Im(e ā), Im(e b̄).
  if (rest[0].multiplicity == 1 && rest[1].multiplicity == 1 && rest[2].multiplicity == 2)
    p.contact = Contact_form{{std::move(rest[0].rest), std::move(rest[1].rest)}, std::move(rest[2].rest), {0, 0}};
}

/// |C'|² at an end of a piece, by the piece's own parameter; zero where the end is infinite.
inline Rational squared_speed(const Planar_curve& c, int end)
{
  const auto value = [end](const Bernstein<Rational, 1>& f) { return f[end == 0 ? 0 : f.size() - 1]; };
  const Rational w = value(c.weight());
  if (w == 0) return 0;
  Rational sum = 0;
  for (std::size_t v = 0; v < 2; ++v) {
    const Rational d = value(velocity_numerator(c.numerator(v), c.weight()));
    sum += d * d;
  }
  return Rational(sum / (w * w * w * w));
}

/// The ratio of the Möbius map along which one curve could be the other's image by a congruence: its square is that of the
/// squared speeds at 0, and the inverse of that at 1. Nothing where they contradict each other or make it irrational; 1 where
/// the curves stand still at both ends.
inline std::optional<Rational> matching_ratio(const Planar_curve& first, const Planar_curve& second, bool reversed)
{
  const Rational a0 = squared_speed(first, 0), a1 = squared_speed(first, 1);
  const Rational b0 = squared_speed(second, reversed ? 1 : 0), b1 = squared_speed(second, reversed ? 0 : 1);
  if ((a0 == 0) != (b0 == 0) || (a1 == 0) != (b1 == 0)) return std::nullopt;
  if (a0 == 0 && a1 == 0) return Rational(1);
  const Rational square = a0 == 0 ? Rational(b1 / a1) : Rational(a0 / b0);
  if (a0 != 0 && square * a1 != b1) return std::nullopt;
  if (!mpz_perfect_square_p(square.get_num_mpz_t()) || !mpz_perfect_square_p(square.get_den_mpz_t())) return std::nullopt;
  Rational ratio;
  mpz_sqrt(ratio.get_num_mpz_t(), square.get_num_mpz_t());
  mpz_sqrt(ratio.get_den_mpz_t(), square.get_den_mpz_t());
  return ratio;
}

/// Mirror images have an axis as a factor of F3, and the other factor crosses it in nodes; equal curves have its fourth power,
/// which is the curves' overlap. `overlaps` says which of the two is looked for: overlaps come first, for an axis may remain
/// beside one.
inline void divide_out_diagonal(F3_problem& p, bool reversed, bool overlaps)
{
  if (p.axis) return; // a second axis stays in the other factor, which it crosses in a declared node
  const auto enclosure = p.system.equations[0]->enclosure(Box<2>::unit());
  const int n = enclosure.degree(0), m = enclosure.degree(1);
  if (!contains_zero(enclosure.at({0, reversed ? m : 0})) || !contains_zero(enclosure.at({n, reversed ? 0 : m}))) return;
  const std::optional<Rational> ratio = matching_ratio(*p.first, *p.second, reversed);
  if (!ratio) return;
  const Diagonal line{reversed, *ratio};
  const Bernstein<Scaled_integer, 2>& f = p.system.equations[0]->exact();
  if (f.is_zero()) return;
  const auto [rest, multiplicity] = divided_by_diagonal(f, line);
  if (multiplicity == 0 || overlaps != (multiplicity > 1)) return;
  if (multiplicity == 1) return split_off_axis(p, rest, line);
  Degenerate_component d;
  d.kind = Degenerate_component::Kind::overlap;
  d.multiplicity = multiplicity;
  d.line = line;
  p.degenerate.push_back(d);
  for (int k = 0; k < multiplicity; ++k) note_known_factor(p, line.polynomial());
  replace_equation(p, rest);
  divide_causes_by_diagonal(p, line);
}

} // namespace detail
} // namespace locus

#endif
