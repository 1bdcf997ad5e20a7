// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_SPLINE_OPERATIONS_H
#define LOCUS_FUNCTION_SPLINE_OPERATIONS_H

#include <locus/function/bernstein_operations.h>
#include <locus/function/spline.h>

#include <iterator>

namespace locus {

// ------------------------------------------------------------------------------------------- splines from spans

namespace detail {

/// The breaks of the grid that the spans fill. Throws std::invalid_argument unless they fill one in order, the last
/// variable fastest, without gaps.
template <class T, int D>
Break_array<D> breaks_of(const std::vector<Spline_span<T, D>>& spans)
{
  if (spans.empty()) throw std::invalid_argument("spline_from_spans: there are no spans");
  Break_array<D> breaks;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    for (const Spline_span<T, D>& span : spans) breaks[k].push_back(span.lo[k]);
    breaks[k].push_back(spans.back().hi[k]);
    std::sort(breaks[k].begin(), breaks[k].end());
    breaks[k].erase(std::unique(breaks[k].begin(), breaks[k].end()), breaks[k].end());
  }
  const Degrees<D> last = last_span<D>(breaks);
  bool grid = coefficient_count(last) == spans.size();
  Degrees<D> cell{};
  for (std::size_t n = 0; grid && n < spans.size(); ++n, advance_index(cell, last))
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const auto at = static_cast<std::size_t>(cell[k]);
      grid = grid && spans[n].lo[k] == breaks[k][at] && spans[n].hi[k] == breaks[k][at + 1];
    }
  if (!grid) throw std::invalid_argument("spline_from_spans: the spans do not fill a grid in order");
  return breaks;
}

/// The greatest degrees among the spans.
template <class T, int D>
Degrees<D> max_degrees(const std::vector<Spline_span<T, D>>& spans)
{
  Degrees<D> degrees{};
  for (const Spline_span<T, D>& span : spans) degrees = max_degrees<D>(degrees, span.form.degrees());
  return degrees;
}

/// The spans as a spline of these degrees on `bernstein_knots`.
template <class T, int D>
Spline<T, D> side_by_side(const std::vector<Spline_span<T, D>>& spans, const Break_array<D>& breaks,
                          const Degrees<D>& degrees)
{
  Knot_array<D> knots;
  for (std::size_t k = 0; k < knots.size(); ++k) knots[k] = bernstein_knots(degrees[k], breaks[k]);
  std::vector<T> coefficients(coefficient_count(degrees) * spans.size(), T(0));
  const Degrees<D> last = last_span<D>(breaks);
  Degrees<D> cell{};
  for (const Spline_span<T, D>& span : spans) {
    const Bernstein<T, D> form = elevated_to<T, D>(span.form, degrees);
    std::size_t n = 0;
    for_each_of_span(degrees, last, cell, [&](std::size_t at) { coefficients[at] = form[n++]; });
    advance_index(cell, last);
  }
  return Spline<T, D>(std::move(knots), std::move(coefficients));
}

/// The k for which two neighbouring spans of equal degrees are C^k across the face between them: -1 for a jump, the
/// degree where they are one polynomial. As many derivatives agree, the value counted as one, as there are equal leading
/// coefficients of `above` and of `below` continued there.
template <class T, int D>
int continuity_between(const Spline_span<T, D>& below, const Spline_span<T, D>& above, int variable)
{
  const auto k = static_cast<std::size_t>(variable);
  const Rational end = 1 + (above.hi[k] - above.lo[k]) / (below.hi[k] - below.lo[k]);
  const Bernstein<T, D> continued = restrict_to(below.form, variable, Rational(1), end);
  const Layout layout = layout_along(continued.degrees(), variable);
  std::size_t agree = layout.count;
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t i = 0; i < layout.inner; ++i)
      for (std::size_t j = 0; j < agree; ++j) {
        const std::size_t at = (o * layout.count + j) * layout.inner + i;
        if (continued[at] != above.form[at]) agree = j;
      }
  return static_cast<int>(agree) - 1;
}

/// For each break between spans in one variable, the least continuity of all the joints there.
template <class T, int D>
std::vector<int> continuities(const std::vector<Spline_span<T, D>>& spans, const Break_array<D>& breaks, int variable)
{
  const auto k = static_cast<std::size_t>(variable);
  const Degrees<D> last = last_span<D>(breaks);
  const std::size_t step = layout_along(last, variable).inner;
  std::vector<int> least(breaks[k].size(), Knots::unlimited);
  Degrees<D> cell{};
  for (std::size_t n = 0; n < spans.size(); ++n, advance_index(cell, last)) {
    if (cell[k] == last[k]) continue;
    int& c = least[static_cast<std::size_t>(cell[k]) + 1];
    c = std::min(c, continuity_between(spans[n], spans[n + step], variable));
  }
  return least;
}

} // namespace detail

/// The spline that consists of these polynomials, on given knots over the same domain: of any continuity that the spans
/// have, clamped or not, with more breaks or fewer. That the spans are so smooth is not checked (no zero is decided, so T
/// may be inexact): where they are not, the result is another function.
/// Throws std::invalid_argument unless the spans fill a grid in order (as from `bezier_spans`), over the knots' domain,
/// and no degree is above that of the knots.
template <class T, int D>
Spline<T, D> spline_from_spans(const std::vector<Spline_span<T, D>>& spans, const Knot_array<D>& knots)
{
  const detail::Break_array<D> breaks = detail::breaks_of<T, D>(spans);
  const Degrees<D> highest = detail::max_degrees<T, D>(spans);
  Degrees<D> degrees{};
  for (std::size_t k = 0; k < knots.size(); ++k) {
    require_valid(knots[k]);
    degrees[k] = knots[k].degree;
    if (degrees[k] < highest[k]) throw std::invalid_argument("spline_from_spans: a span has a degree above the knots'");
    if (knots[k].domain_lo() != breaks[k].front() || knots[k].domain_hi() != breaks[k].back())
      throw std::invalid_argument("spline_from_spans: the spans and the knots have different domains");
  }
  Spline<T, D> f = detail::side_by_side<T, D>(spans, breaks, degrees);
  for (int k = 0; k < D; ++k) f = detail::on_knots(f, k, knots[static_cast<std::size_t>(k)]);
  return f;
}

/// The spline that consists of these polynomials, of their greatest degrees, clamped, each knot as often as the
/// continuity there asks and no more (T exact): none where two spans are one polynomial, degree + 1 times at a jump.
/// In several variables the least smooth of the joints across a break decides. Throws std::invalid_argument unless the
/// spans fill a grid in order. A de Casteljau step for each joint, then a change of knots.
template <class T, int D>
Spline<T, D> spline_from_spans(std::vector<Spline_span<T, D>> spans)
{
  const detail::Break_array<D> breaks = detail::breaks_of<T, D>(spans);
  const Degrees<D> degrees = detail::max_degrees<T, D>(spans);
  for (Spline_span<T, D>& span : spans) span.form = detail::elevated_to<T, D>(std::move(span.form), degrees);
  Knot_array<D> knots;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const std::vector<int> least = detail::continuities<T, D>(spans, breaks, static_cast<int>(k));
    std::size_t i = 0;
    knots[k] = knots_over(degrees[k], breaks[k], [&](const Rational&) { return least[++i]; });
  }
  return spline_from_spans(spans, knots);
}

// --------------------------------------------------------------------------------------------- changes of knots

/// The same function with more knots in one variable: `more`, in any order, equal ones as often as they are to be
/// inserted. Throws std::invalid_argument unless each lies strictly inside the domain and none then stands more than
/// degree + 1 times.
template <class T, int D>
Spline<T, D> insert_knots(const Spline<T, D>& f, int variable, const std::vector<Rational>& more)
{
  Knots knots = f.knots(variable);
  for (const Rational& u : more) {
    if (u <= f.knots(variable).domain_lo() || u >= f.knots(variable).domain_hi())
      throw std::invalid_argument("insert_knots: " + u.get_str() + " is not inside the domain");
    knots.values.insert(std::upper_bound(knots.values.begin(), knots.values.end(), u), u);
  }
  return detail::on_knots(f, variable, knots);
}

/// The same function on clamped knots in every variable; knots inside the domain stay.
template <class T, int D>
Spline<T, D> clamped(Spline<T, D> f)
{
  for (int k = 0; k < D; ++k) f = detail::on_knots(f, k, clamped(f.knots(k)));
  return f;
}

/// The same function, clamped, without any knot that it does not need, and each knot to its least multiplicity (T
/// exact). Two splines of equal degrees are the same function exactly if these are equal.
template <class T, int D>
Spline<T, D> minimal_knots(const Spline<T, D>& f)
{
  return spline_from_spans(bezier_spans(f));
}

/// The part over [lo, hi] in one variable, clamped in that variable. Throws std::invalid_argument unless lo < hi and both
/// lie in the domain.
template <class T, int D>
Spline<T, D> restrict_to(const Spline<T, D>& f, int variable, const Rational& lo, const Rational& hi)
{
  const Knots& old = f.knots(variable);
  if (lo >= hi || !old.contains(lo) || !old.contains(hi))
    throw std::invalid_argument("restrict_to: [" + lo.get_str() + ", " + hi.get_str() + "] is no part of the domain");
  std::vector<Rational> breaks{lo};
  for (const Rational& u : old.breaks())
    if (lo < u && u < hi) breaks.push_back(u);
  breaks.push_back(hi);
  const auto continuity = [&](const Rational& u) { return old.continuity(u); };
  return detail::on_knots(f, variable, knots_over(old.degree, breaks, continuity));
}

/// f after the increasing affine map that takes [lo, hi] to its domain in one variable: the coefficients stay, the knots
/// move. Throws std::invalid_argument unless lo < hi.
template <class T, int D>
Spline<T, D> reparametrised(const Spline<T, D>& f, int variable, const Rational& lo, const Rational& hi)
{
  Knot_array<D> knots = f.knots();
  Knots& moved = knots[static_cast<std::size_t>(variable)];
  moved = reparametrised(std::move(moved), lo, hi);
  return Spline<T, D>(std::move(knots), f.coefficients());
}

// ------------------------------------------------------------------------------------------------------- algebra
// Each operation cuts its operands into Bernstein forms over common breaks, lets the operation of that name work on
// them, and puts the results together. The results are clamped. Unless said otherwise no zero is decided: knots get the
// multiplicity that the continuity of the operands asks, and `minimal_knots` removes what a particular result does not
// need.

namespace detail {

/// All breaks of both. Throws std::invalid_argument where the domains differ.
template <int D>
Break_array<D> common_breaks(const Knot_array<D>& f, const Knot_array<D>& g)
{
  Break_array<D> breaks;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    if (f[k].domain_lo() != g[k].domain_lo() || f[k].domain_hi() != g[k].domain_hi())
      throw std::invalid_argument("splines of different domains cannot be combined");
    const std::vector<Rational> a = f[k].breaks(), b = g[k].breaks();
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(breaks[k]));
  }
  return breaks;
}

template <class T, int D, class Operation>
std::vector<Spline_span<T, D>> combined_spans(const Spline<T, D>& f, const Spline<T, D>& g, Operation operation)
{
  const Break_array<D> breaks = common_breaks<D>(f.knots(), g.knots());
  std::vector<Spline_span<T, D>> spans = spans_between(f, breaks);
  const std::vector<Spline_span<T, D>> others = spans_between(g, breaks);
  for (std::size_t i = 0; i < spans.size(); ++i) spans[i].form = operation(spans[i].form, others[i].form);
  return spans;
}

/// The operation on each span, as continuous at every break as both operands are.
template <class T, int D, class Operation>
Spline<T, D> combined(const Spline<T, D>& f, const Spline<T, D>& g, Operation operation)
{
  const std::vector<Spline_span<T, D>> spans = combined_spans(f, g, operation);
  const Break_array<D> breaks = breaks_of<T, D>(spans);
  Knot_array<D> knots;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const Knots &a = f.knots()[k], &b = g.knots()[k];
    knots[k] = knots_over(spans.front().form.degrees()[k], breaks[k],
                          [&](const Rational& u) { return std::min(a.continuity(u), b.continuity(u)); });
  }
  return spline_from_spans(spans, knots);
}

/// An operation on each span that changes the degree in one variable and costs `loss` orders of continuity there. The
/// other variables keep their knots.
template <class T, int D, class Operation>
Spline<T, D> changed(const Spline<T, D>& f, int variable, int loss, Operation operation)
{
  std::vector<Spline_span<T, D>> spans = bezier_spans(f);
  for (Spline_span<T, D>& span : spans) span.form = operation(span);
  Knot_array<D> knots = f.knots();
  const Knots& old = f.knots(variable);
  const int degree = spans.front().form.degree(variable);
  knots[static_cast<std::size_t>(variable)] =
    knots_over(degree, old.breaks(), [&](const Rational& u) { return old.continuity(u) - loss; });
  return spline_from_spans(spans, knots);
}

} // namespace detail

/// Sum, of the higher degrees. Throws std::invalid_argument where the domains differ.
template <class T, int D>
Spline<T, D> add(const Spline<T, D>& f, const Spline<T, D>& g)
{
  return detail::combined(f, g, [](const Bernstein<T, D>& a, const Bernstein<T, D>& b) { return add(a, b); });
}

/// Difference, of the higher degrees. Throws std::invalid_argument where the domains differ.
template <class T, int D>
Spline<T, D> subtract(const Spline<T, D>& f, const Spline<T, D>& g)
{
  return detail::combined(f, g, [](const Bernstein<T, D>& a, const Bernstein<T, D>& b) { return subtract(a, b); });
}

/// Product; degrees add. Throws std::invalid_argument where the domains differ.
template <class T, int D>
Spline<T, D> multiply(const Spline<T, D>& f, const Spline<T, D>& g)
{
  return detail::combined(f, g, [](const Bernstein<T, D>& a, const Bernstein<T, D>& b) { return multiply(a, b); });
}

/// Multiple on the same knots.
template <class T, int D>
Spline<T, D> multiply(const Spline<T, D>& f, const T& factor)
{
  std::vector<T> coefficients = f.coefficients();
  for (T& c : coefficients) c *= factor;
  return Spline<T, D>(f.knots(), std::move(coefficients));
}

/// The spline h, of degrees deg f - deg g, with f = g·h on every span (T exact), on least knots: h may be smoother than f
/// and g, or jump at a knot where g is zero. Throws std::domain_error where there is no such h or more than one: g does
/// not divide f on a span, has the higher degree in a variable, or vanishes on a whole span; and std::invalid_argument
/// where the domains differ.
template <class T, int D>
Spline<T, D> divide_exactly(const Spline<T, D>& f, const Spline<T, D>& g)
{
  return spline_from_spans(detail::combined_spans(
    f, g, [](const Bernstein<T, D>& a, const Bernstein<T, D>& b) { return divide_exactly(a, b); }));
}

/// The same function written with a degree higher by `by` ≥ 0 in one variable, clamped there: each knot stands `by` times
/// more often.
template <class T, int D>
Spline<T, D> elevate(const Spline<T, D>& f, int variable, int by)
{
  assert(by >= 0);
  return detail::changed(f, variable, 0, [&](const Spline_span<T, D>& s) { return elevate(s.form, variable, by); });
}

/// Partial derivative, span by span: jumps of f leave no trace, where f is only continuous the derivative jumps. The
/// degree in that variable falls by one (degree 0 stays), knots keep their multiplicity up to the new degree + 1; clamped
/// in that variable.
template <class T, int D>
Spline<T, D> derivative(const Spline<T, D>& f, int variable = 0)
{
  const auto k = static_cast<std::size_t>(variable);
  return detail::changed(f, variable, 1, [&](const Spline_span<T, D>& s) {
    return multiply(derivative(s.form, variable), detail::number_from_rational<T>(1 / Rational(s.hi[k] - s.lo[k])));
  });
}

/// The same spline with another coefficient type; each coefficient goes through `convert`.
template <class U, class T, int D, class Convert>
Spline<U, D> converted(const Spline<T, D>& f, Convert convert)
{
  std::vector<U> coefficients;
  for (const T& c : f.coefficients()) coefficients.push_back(convert(c));
  return Spline<U, D>(f.knots(), std::move(coefficients));
}

} // namespace locus

#endif
