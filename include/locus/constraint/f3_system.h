// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_F3_SYSTEM_H
#define LOCUS_CONSTRAINT_F3_SYSTEM_H

#include <locus/constraint/f3_factors.h>

#include <initializer_list>

namespace locus {
namespace detail {

/// What makes F3 singular or the bisector infinite without any coincidence: the curves meet, or share a tangent line.
inline void add_geometric_causes(F3_problem& p)
{
  Cause<2> meeting;
  meeting.name = "C1 = C2";
  meeting.equations = {pair_equation<Difference_form<false>>(p), pair_equation<Difference_form<true>>(p)};
  meeting.proves = Claim_kind::crossing;
  meeting.tag = tag_of(F3_cause::meeting);
  p.system.causes.push_back(std::move(meeting));
  Cause<2> bitangent;
  bitangent.name = "common tangent line";
  bitangent.equations = {pair_equation<First_tangent_form>(p), pair_equation<Second_tangent_form>(p)};
  bitangent.proves = Claim_kind::isolated_box;
  bitangent.tag = tag_of(F3_cause::pole);
  bitangent.includes = {0};
  p.system.causes.push_back(std::move(bitangent));
}

inline F3_problem undivided_f3_problem(std::shared_ptr<const Planar_curve> first, std::shared_ptr<const Planar_curve> second)
{
  F3_problem p;
  p.first = std::move(first);
  p.second = std::move(second);
  p.system.name = F3_form::name;
  p.system.equations[0] = pair_equation<F3_form>(p);
  add_geometric_causes(p);
  for (int variable : {0, 1}) divide_out_tangencies(p, variable);
  return p;
}

/// The diagonal t = r as a place where arcs of a self-bisector end: at zeros of the equation there.
inline Cause<2> diagonal_cause(const std::shared_ptr<const Equation<2>>& equation)
{
  Cause<2> cause;
  cause.name = "the diagonal t = r";
  cause.equations = {equation, std::make_shared<Polynomial_equation<2>>(Diagonal{}.polynomial())};
  cause.proves = Claim_kind::isolated_box;
  cause.tag = tag_of(F3_cause::diagonal);
  return cause;
}

/// Of a self-bisector's causes only what lies in t > r counts, and on the diagonal only its ends.
inline void leave_out_mirror_half(Cause<2>& cause)
{
  const bool off_diagonal = cause.tag != tag_of(F3_cause::diagonal);
  cause.leave_out = [off_diagonal, before = cause.leave_out, equations = cause.equations](const Isolated_solution<2>& s) {
    if (s.box[0].sup() < s.box[1].inf() || (before && before(s))) return true;
    return off_diagonal && lies_on_diagonal(s, equations, Diagonal{});
  };
}

/// A solution on an edge that stands for the corner, or on the axis between two charts, belongs to neither chart.
inline std::function<bool(const Isolated_solution<2>&)> on_chart_edges(const Corner_chart& chart, bool has_axis)
{
  std::array<bool, 2> at_zero{}, at_one{};
  for (std::size_t v = 0; v < 2; ++v) {
    at_zero[v] = chart.exponent[0][v] > 0 && chart.exponent[1][v] > 0; // both distances vanish
    at_one[v] = has_axis && chart.ray(v) == std::array<int, 2>{1, 1};
  }
  return [at_zero, at_one](const Isolated_solution<2>& s) {
    for (std::size_t v = 0; v < 2; ++v)
      if ((s.face[v] == 0 && at_zero[v]) || (s.face[v] == 1 && at_one[v])) return true;
    return false;
  };
}

/// A problem's polynomials in powers of the distances from a corner: F3, both coordinates of e, the equations of the poles,
/// and Im(e ā).
struct Corner_forms {
  Corner_expansion f;
  std::array<Corner_expansion, 2> chord, poles;
  Corner_expansion turn;
};

inline std::optional<Contact_form> contact_at_corner(const Corner_forms& forms, const Corner_chart& chart)
{
  if (forms.turn.is_zero() || (forms.chord[0].is_zero() && forms.chord[1].is_zero())) return std::nullopt;
  const std::array<int, 2> x = forms.chord[0].order_on(chart), y = forms.chord[1].order_on(chart), most = forms.turn.order_on(chart);
  std::array<int, 2> chord{}, turn{}, power{};
  for (std::size_t v = 0; v < 2; ++v) {
    chord[v] = forms.chord[0].is_zero() ? y[v] : forms.chord[1].is_zero() ? x[v] : std::min(x[v], y[v]);
    turn[v] = std::min(most[v], 2 * chord[v]); // what is left of it vanishes where the bisector goes to infinity
    power[v] = 2 * chord[v] - turn[v];
  }
  return Contact_form{{forms.chord[0].on(chart, chord), forms.chord[1].on(chart, chord)}, forms.turn.on(chart, turn), power};
}

/// One chart of a problem whose corner is blown up. Every equation is divided by the chart's coordinates as often as that
/// goes.
inline F3_problem on_chart(const F3_problem& plain, const Corner_forms& forms, const Corner_chart& chart, bool has_axis)
{
  F3_problem p = plain;
  p.chart = chart;
  const auto equation = [&](const Corner_expansion& f) { return std::make_shared<Polynomial_equation<2>>(f.on(chart)); };
  p.system.equations[0] = equation(forms.f);
  for (std::size_t c = 0; c < 2; ++c) {
    const auto& pair = c == 0 ? forms.chord : forms.poles;
    p.system.causes[c].equations = {equation(pair[0]), equation(pair[1])};
    p.system.causes[c].leave_out = [edges = on_chart_edges(chart, has_axis), plain = p.system.causes[c].leave_out, chart](const Isolated_solution<2>& s) {
      if (edges(s) || !plain) return edges(s);
      Isolated_solution<2> local = s;
      local.box = chart(s.box);
      return plain(local);
    };
  }
  p.contact = contact_at_corner(forms, chart);
  return p;
}

/// Charts that cover one of the first two and on which the polynomial is regular at the corner, as far as a few blow-ups
/// lead there.
inline void collect_charts(const Corner_expansion& f, const Corner_chart& chart, int depth, std::vector<Corner_chart>& charts)
{
  constexpr int most = 4;
  if (depth == most || !f.is_singular_on(chart)) return charts.push_back(chart);
  for (const Corner_chart& part : chart.blown_up_again()) collect_charts(f, part, depth + 1, charts);
}

/// The problem on all charts of the wanted sides of a blown-up corner (see Corner_chart::at).
inline std::vector<F3_problem> on_charts(const F3_problem& plain, const Corner_forms& forms, const std::array<int, 2>& corner,
                                         std::initializer_list<bool> sides, bool has_axis)
{
  std::vector<Corner_chart> charts;
  for (const bool first_side : sides) collect_charts(forms.f, Corner_chart::at(corner, first_side), 0, charts);
  std::vector<F3_problem> problems;
  for (const Corner_chart& chart : charts) {
    problems.push_back(on_chart(plain, forms, chart, has_axis));
    problems.back().repeats_degenerate = problems.size() > 1;
  }
  return problems;
}

/// The values of an equation of a chart along the line between the first two charts.
inline Integer_polynomial along_axis(const Equation<2>& f) { return monomial_form(face(f.exact(), 0, true)); }

/// Its different zeros but the corner and those of `without`.
inline Integer_polynomial zeros_along_axis(Integer_polynomial f, const Integer_polynomial& without)
{
  f.erase(f.begin(), std::find_if(f.begin(), f.end(), [](const Integer& c) { return c != 0; }));
  f = exact_quotient(f, gcd(f, derivative(f)));
  return degree(without) > 0 ? exact_quotient(f, gcd(f, without)) : f;
}

/// The axis through a blown-up corner, with its crossings of the other factor and its poles.
inline F3_problem axis_through_corner(const F3_problem& on_first_chart, const Corner_forms& forms)
{
  F3_problem p;
  p.first = on_first_chart.first;
  p.second = on_first_chart.second;
  p.chart = Corner_chart::axis(on_first_chart.chart.corner);
  p.system.name = "axis";
  const auto line = std::make_shared<Polynomial_equation<2>>(Bernstein<Rational, 2>(Degrees<2>{1, 0}, {-1, 1}));
  p.system.equations[0] = line;
  const auto mark = [&](const char* name, F3_cause tag, const Integer_polynomial& zeros) {
    Cause<2> cause;
    cause.name = name;
    cause.equations = {line, std::make_shared<Polynomial_equation<2>>(as_bivariate(bernstein_form(zeros).rational(), 1))};
    cause.proves = Claim_kind::isolated_box;
    cause.tag = tag_of(tag);
    cause.leave_out = on_chart_edges(p.chart, false);
    return cause;
  };
  const auto &meeting = on_first_chart.system.causes[0].equations, &poles = on_first_chart.system.causes[1].equations;
  // Of the two equations of a pole either may contain the axis; both vanish where the curves meet, too.
  const Integer_polynomial pole = along_axis(face(poles[0]->exact(), 0, true).is_zero() ? *poles[1] : *poles[0]);
  const Integer_polynomial meets = zeros_along_axis(along_axis(*on_first_chart.system.equations[0]), {});
  const Integer_polynomial infinite = zeros_along_axis(pole, gcd(along_axis(*meeting[0]), along_axis(*meeting[1]))), both = gcd(meets, infinite);
  p.system.causes = {mark("the axis meets the other factor", F3_cause::axis, exact_quotient(meets, both)),
                     mark("common tangent line on the axis", F3_cause::pole, exact_quotient(infinite, both))};
  if (degree(both) > 0) {
    p.system.causes.push_back(mark("the axis meets the other factor at a common tangent line", F3_cause::axis, both));
    p.system.causes.back().also = tag_of(F3_cause::pole);
  }
  p.degrees = {1, 1};
  p.contact = contact_at_corner(forms, p.chart);
  return p;
}

} // namespace detail

/// The system F3 = 0 of two planar curve pieces in a common frame (upward rounding needed): its equation without the
/// degenerate components, which are listed, and the causes of its singular and infinite points.
inline F3_problem f3_problem(std::shared_ptr<const Planar_curve> first, std::shared_ptr<const Planar_curve> second)
{
  F3_problem p = detail::undivided_f3_problem(std::move(first), std::move(second));
  for (bool overlaps : {true, false})
    for (bool reversed : {false, true}) detail::divide_out_diagonal(p, reversed, overlaps);
  p.degrees = p.system.equations[0]->degrees();
  return p;
}

namespace detail {

inline F3_problem undecorated_self_problem(const std::shared_ptr<const Planar_curve>& piece)
{
  F3_problem p = undivided_f3_problem(piece, piece);
  p.is_self = true;
  if (p.system.equations[0]->exact().is_zero()) return p;
  divide_out_diagonal(p, false, true);
  p.degenerate.clear(); // the diagonal itself
  return p;
}

inline Corner_forms corner_forms(const F3_problem& p, const std::array<int, 2>& corner)
{
  const auto expansion = [&](const Equation<2>& f) { return Corner_expansion(Scaled_form(f.exact()), corner); };
  const auto& c = p.system.causes;
  return {expansion(*p.system.equations[0]),
          {expansion(*c[0].equations[0]), expansion(*c[0].equations[1])},
          {expansion(*c[1].equations[0]), expansion(*c[1].equations[1])},
          expansion(*c[1].equations[0])};
}

} // namespace detail

/// The system of a finite curve piece with itself: F3 without (t - r)^4, each unordered pair once (t > r), ending on the
/// diagonal where the curvature is extremal. Pieces on a line or a circle leave no equation: the result's is zero.
inline F3_problem f3_self_problem(const std::shared_ptr<const Planar_curve>& piece)
{
  F3_problem p = detail::undecorated_self_problem(piece);
  if (p.system.equations[0]->exact().is_zero()) return p;
  detail::divide_out_diagonal(p, true, false);
  p.degrees = p.system.equations[0]->degrees();
  p.system.causes.push_back(detail::diagonal_cause(p.system.equations[0]));
  if (p.axis) p.axis->causes.push_back(detail::diagonal_cause(p.axis->equations[0]));
  if (p.whole) p.whole->causes.push_back(detail::diagonal_cause(p.whole->equations[0]));
  for (System<1, 2>* system : {&p.system, p.axis ? &*p.axis : nullptr, p.whole ? &*p.whole : nullptr}) {
    if (!system) continue;
    for (Cause<2>& cause : system->causes) detail::leave_out_mirror_half(cause);
    system->outside = [](const Box<2>& box) { return box.hi[0] <= box.lo[1]; };
  }
  return p;
}

/// The same for a piece that is infinite or stands still at one end (0 or 1): there the corner of the diagonal is blown up, and
/// the charts cover t ≥ r with the diagonal as an edge.
inline std::vector<F3_problem> f3_self_corner_problems(const std::shared_ptr<const Planar_curve>& piece, int end)
{
  F3_problem p = detail::undecorated_self_problem(piece);
  if (p.system.equations[0]->exact().is_zero()) return {p};
  p.degrees = p.system.equations[0]->degrees();
  return detail::on_charts(p, detail::corner_forms(p, {end, end}), {end, end}, {end == 1}, true);
}

namespace detail {

/// Two pieces that overlap: what is left of F3 is regular where they end regularly, and their other common end is blown up.
inline std::vector<F3_problem> overlap_problems(const std::shared_ptr<const Planar_curve>& first, const std::shared_ptr<const Planar_curve>& second,
                                                bool reversed)
{
  if (!first->is_singular_at(0) && !first->is_singular_at(1)) return {f3_problem(first, second)};
  const int end = first->is_singular_at(1) ? 1 : 0;
  const std::array<int, 2> corner{end, reversed ? 1 - end : end};
  F3_problem p = undivided_f3_problem(first, second);
  divide_out_diagonal(p, reversed, true);
  p.degrees = p.system.equations[0]->degrees();
  return on_charts(p, corner_forms(p, corner), corner, {true, false}, false);
}

} // namespace detail

/// The problems that together cover two pieces which share an end with one tangent there: two charts of the blown-up
/// corner, and the axis of symmetry through it, if there is one. Pieces that overlap leave one plain problem unless they
/// are infinite or stand still at an end.
inline std::vector<F3_problem> f3_corner_problems(std::shared_ptr<const Planar_curve> first, std::shared_ptr<const Planar_curve> second,
                                                  const std::array<int, 2>& corner)
{
  F3_problem plain = detail::undivided_f3_problem(std::move(first), std::move(second));
  const bool as_built = plain.system.known_factors.empty() && !plain.first->is_circle() && !plain.second->is_circle();
  Scaled_form f = as_built ? detail::scaled_form<F3_form>(*plain.first, *plain.second) : Scaled_form(plain.system.equations[0]->exact());
  if (f.is_zero()) return {plain};
  const bool reversed = corner[0] != corner[1];
  const Rational ratio = detail::matching_ratio(*plain.first, *plain.second, reversed).value_or(1);
  Scaled_form rest = f;
  const int multiplicity = detail::divide_by_diagonal(rest, {reversed, ratio});
  if (multiplicity > 1) return detail::overlap_problems(plain.first, plain.second, reversed);
  const bool has_axis = multiplicity == 1 && ratio == 1; // along another curve an axis is no ray of a chart: it stays in F3
  if (has_axis) f = std::move(rest);
  plain.degrees = {f.degree(0), f.degree(1)};
  const auto expansion = [&](Scaled_form g) { return Corner_expansion(std::move(g), corner); };
  const auto of_cause = [&](std::size_t cause, std::size_t k) { return expansion(Scaled_form(plain.system.causes[cause].equations[k]->exact())); };
  const detail::Corner_forms forms{expansion(std::move(f)),
                                   {expansion(detail::scaled_form<Difference_form<false>>(*plain.first, *plain.second)),
                                    expansion(detail::scaled_form<Difference_form<true>>(*plain.first, *plain.second))},
                                   {of_cause(1, 0), of_cause(1, 1)},
                                   expansion(detail::scaled_form<First_tangent_form>(*plain.first, *plain.second))};
  std::vector<F3_problem> problems = detail::on_charts(plain, forms, corner, {true, false}, has_axis);
  if (has_axis)
    problems.push_back(detail::axis_through_corner(detail::on_chart(plain, forms, Corner_chart::at(corner, true), true), forms));
  return problems;
}

} // namespace locus

#endif
