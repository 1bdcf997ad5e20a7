// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_SPLINE_CURVE_H
#define LOCUS_SHAPE_SPLINE_CURVE_H

#include <locus/shape/cusps.h>
#include <locus/shape/knot_rules.h>

namespace locus {

namespace detail {

/// "between knots[3] and knots[4]": the span that starts at `lo`.
inline std::string named_span(const Knots& knots, const Rational& lo)
{
  const auto above = std::upper_bound(knots.values.begin(), knots.values.end(), lo) - knots.values.begin();
  return "between knots[" + std::to_string(above - 1) + "] and knots[" + std::to_string(above) + "]";
}

/// Rows of the matrix that takes the control coefficients that act on a span of positive length to the Bernstein ones:
/// values of the polar form with j arguments at the span's end and the others at its start. Shared by all coordinates.
inline std::vector<std::vector<Rational>> span_matrix(const Knots& knots, int span)
{
  std::vector<Rational> arguments(static_cast<std::size_t>(knots.degree), knots.value(span));
  std::vector<std::vector<Rational>> rows{polar_weights(knots, span, arguments.data())};
  for (Rational& x : arguments) {
    x = knots.value(span + 1);
    rows.push_back(polar_weights(knots, span, arguments.data()));
  }
  return rows;
}

/// The Bézier pieces of a spline, as homogeneous forms, and their ranges. No weights: polynomial pieces.
template <int Dim>
void extract_pieces(const Knots& knots, const std::vector<Exact_point<Dim>>& points, const std::vector<Rational>& weights,
                    std::vector<Curve_piece<Dim>>& pieces, std::vector<Piece>& ranges)
{
  const Degrees<1> degrees{knots.degree};
  for (int span = knots.degree; span < knots.control_count(); ++span) {
    if (knots.value(span) == knots.value(span + 1)) continue;
    const auto matrix = span_matrix(knots, span);
    const auto first = static_cast<std::size_t>(span - knots.degree);
    // `coefficient(i)` is that of control point i.
    const auto form = [&](auto coefficient) {
      Bernstein<Rational, 1> f(degrees);
      for (std::size_t j = 0; j < f.size(); ++j)
        for (std::size_t i = 0; i < f.size(); ++i) f[j] += matrix[j][i] * coefficient(first + i);
      return f;
    };
    Curve_piece<Dim> piece;
    for (std::size_t v = 0; v < piece.numerator.size(); ++v)
      piece.numerator[v] =
        form([&](std::size_t i) { return weights.empty() ? points[i][v] : Rational(points[i][v] * weights[i]); });
    piece.weight = weights.empty() ? Bernstein<Rational, 1>(Degrees<1>{0}, {Rational(1)})
                                   : form([&](std::size_t i) { return weights[i]; });
    pieces.push_back(std::move(piece));
    ranges.push_back(finite_range(knots.value(span), knots.value(span + 1)));
  }
}

/// Throws Invalid_input where the weight of a span vanishes: names a weight that is not positive.
inline void reject_poles_of_span(const Bernstein<Rational, 1>& weight, const Piece& range, const Knots& knots,
                                 const std::vector<Rational>& weights)
{
  const bool zero = is_zero(weight);
  const auto pole = zero ? Rational(1, 2) : near_pole(weight);
  if (!pole) return;
  auto i = static_cast<std::size_t>(std::upper_bound(knots.values.begin(), knots.values.end(), range.lo) -
                                    knots.values.begin() - 1 - knots.degree);
  while (i + 1 < weights.size() && weights[i] > 0) ++i;
  throw Invalid_input(".weights[" + std::to_string(i) + "]",
                      "the denominator vanishes on the domain near u = " + std::to_string(range.at(*pole)->get_d()) +
                        " (a pole), " + named_span(knots, range.lo),
                      "use positive weights");
}

inline void require_control_numbers(int degree, std::size_t points, std::size_t weights)
{
  if (degree < 1)
    throw Invalid_input(".degree", "the degree must be a whole number from 1 on, not " + std::to_string(degree),
                        "use 1 for a polyline, 3 for most curves");
  if (points < static_cast<std::size_t>(degree) + 1)
    throw Invalid_input(".control_points", std::to_string(points) + " control points for degree " + std::to_string(degree),
                        "give at least degree + 1 = " + std::to_string(degree + 1));
  if (weights != 0 && weights != points)
    throw Invalid_input(".weights", std::to_string(weights) + " weights for " + std::to_string(points) + " control points",
                        "give one weight for each control point, or none");
}

/// Throws Invalid_input where the curve, or a span of it, is a single point.
template <int Dim>
void reject_single_points(const std::vector<Curve_piece<Dim>>& pieces, const std::vector<Piece>& ranges, const Knots& knots)
{
  std::vector<bool> single;
  for (const auto& piece : pieces) single.push_back(is_single_point(piece));
  const auto first = std::find(single.begin(), single.end(), true);
  if (first == single.end()) return;
  if (std::find(single.begin(), single.end(), false) == single.end())
    throw Invalid_input(".control_points", "the curve is a single point", "use a point input instead");
  throw Invalid_input(".control_points",
                      "the curve stands still " + named_span(knots, ranges[static_cast<std::size_t>(first - single.begin())].lo),
                      "take out the control points that repeat one point, with as many knots");
}

/// Throws Invalid_input where the curve jumps, as it may at a knot inside the domain that stands degree + 1 times.
template <int Dim>
void reject_jumps(const std::vector<Curve_piece<Dim>>& pieces, const std::vector<Piece>& ranges, const Knots& knots)
{
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const Rational& u = ranges[k].lo;
    if (knots.continuity(u) >= 0 || meet(pieces[k - 1], ranges[k - 1], pieces[k], ranges[k])) continue;
    const auto at = std::upper_bound(knots.values.begin(), knots.values.end(), u) - knots.values.begin() - 1;
    throw Invalid_input(".knots[" + std::to_string(at) + "]",
                        "the inner knot " + u.get_str() + " is repeated degree + 1 times, and the curve jumps there",
                        "repeat it at most degree times, or let the two control points there coincide");
  }
}

} // namespace detail

/// A (rational) B-spline curve: its degree, control points, points + degree + 1 knots, clamped or not, and, if given, one
/// weight for each point. The parameter runs from knots[degree] to knots[number of points]. Equal weights give polynomial
/// pieces. `closed`: the curve ends exactly where it starts, and the seam is a joint like others.
/// The pieces are the spans, cut besides where the curve stands still at a rational parameter (see `split_at_cusps`);
/// joints are found out exactly (see `joint_between`), whatever the knots promise.
/// Throws Invalid_input where numbers do not fit or knots break the rules, the curve jumps, the denominator vanishes, the
/// curve or a span of it is a single point, or a closed curve's ends differ.
/// Time: O(spans·degree³) operations on rationals.
template <int Dim>
Rational_curve<Dim> bspline_curve(int degree, const std::vector<Exact_point<Dim>>& points, const std::vector<Rational>& knots,
                                  const std::vector<Rational>& weights = {}, bool closed = false)
{
  detail::require_control_numbers(degree, points.size(), weights.size());
  const Knots valid{degree, knots};
  detail::require_knots(valid, points.size(), degree + 1, ".knots");
  const bool equal = std::all_of(weights.begin(), weights.end(), [&](const Rational& w) { return w == weights[0]; });
  if (equal && !weights.empty() && weights[0] == 0)
    throw Invalid_input(".weights", "all weights are zero", "use positive weights");
  std::vector<Curve_piece<Dim>> pieces;
  std::vector<Piece> ranges;
  detail::extract_pieces(valid, points, equal ? std::vector<Rational>() : weights, pieces, ranges);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    detail::remove_common_factor(pieces[k]);
    detail::reject_poles_of_span(pieces[k].weight, ranges[k], valid, weights);
    detail::settle_weight(pieces[k]);
  }
  detail::reject_single_points(pieces, ranges, valid);
  detail::reject_jumps(pieces, ranges, valid);
  detail::cut_at_cusps(pieces, ranges);
  return joined_curve(std::move(pieces), std::move(ranges), closed);
}

} // namespace locus

#endif
