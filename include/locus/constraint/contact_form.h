// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_CONTACT_FORM_H
#define LOCUS_CONSTRAINT_CONTACT_FORM_H

#include <locus/constraint/f3_problem.h>
#include <locus/function/diagonal.h>

#include <optional>

namespace locus {

/// What gives the bisector point where the two feet come together, on the diagonal of a self-bisector or at a blown-up
/// corner: with δ = t - r or the distance from the corner, e = δ^k·chord and Im(e ā) = δ^l·turn. The point lies at
/// -|e|²/(2 w1 w2 Im(e ā)) times iā from the first foot, and both vanish with δ; their quotients do not, unless the
/// curvature does. Exact coefficients in the problem's chart, with their scale.
struct Contact_form {
  std::array<Bernstein<Rational, 2>, 2> chord;
  Bernstein<Rational, 2> turn;
  int power = 0; ///< 2k - l, so that |e|²/Im(e ā) = δ^power·|chord|²/turn; only on charts other than zero
};

namespace detail {

template <class Form>
Bernstein<Scaled_integer, 2> exact_form(const F3_problem& p)
{
  return Bernstein<Scaled_integer, 2>(expand(Form::build(p.first->exact(), p.second->exact())));
}

inline std::optional<Contact_form> contact_at_corner(const F3_problem& p)
{
  const Corner_expansion x(exact_form<Difference_form<false>>(p), p.chart.corner), y(exact_form<Difference_form<true>>(p), p.chart.corner),
    turn(exact_form<First_tangent_form>(p), p.chart.corner);
  const int chord_order = std::min(x.order(), y.order()), power = 2 * chord_order - turn.order();
  if (turn.is_zero() || power < 0) return std::nullopt;
  return Contact_form{{x.on(p.chart.kind, chord_order).rational(), y.on(p.chart.kind, chord_order).rational()},
                      turn.on(p.chart.kind, turn.order()).rational(), power};
}

inline std::optional<Contact_form> contact_on_diagonal(const F3_problem& p, bool reversed)
{
  const auto x = divided_by_diagonal(exact_form<Difference_form<false>>(p), reversed, 1);
  const auto y = divided_by_diagonal(exact_form<Difference_form<true>>(p), reversed, 1);
  const auto turn = divided_by_diagonal(exact_form<First_tangent_form>(p), reversed, 2);
  if (x.multiplicity != 1 || y.multiplicity != 1 || turn.multiplicity != 2) return std::nullopt;
  return Contact_form{{x.rest.rational(), y.rest.rational()}, turn.rest.rational(), 0};
}

} // namespace detail

/// The contact form of a problem whose feet can come together; nothing for others, and where the chord's square
/// vanishes to a lower order than the turn (the bisector then goes to infinity there).
inline std::optional<Contact_form> contact_form(const F3_problem& p)
{
  if (!p.chart.is_plain()) return detail::contact_at_corner(p);
  if (p.is_self) return detail::contact_on_diagonal(p, false);
  for (const Degenerate_component& d : p.degenerate)
    if (d.kind == Degenerate_component::Kind::overlap) return detail::contact_on_diagonal(p, d.reversed);
  return std::nullopt;
}

} // namespace locus

#endif
