// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_RATIONAL_SURFACE_H
#define LOCUS_SHAPE_RATIONAL_SURFACE_H

#include <locus/function/polynomial_vector.h>
#include <locus/function/spline.h>
#include <locus/shape/knot_rules.h>
#include <locus/shape/parameter_form.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace locus {

/// One polynomial piece of a rational surface in Bernstein form on the unit square: the point is numerator / weight.
/// A polynomial piece has a weight of degrees 0.
struct Surface_piece {
  std::array<Bernstein<Rational, 2>, 3> numerator;
  Bernstein<Rational, 2> weight;

  bool is_polynomial() const { return weight.degrees() == Degrees<2>{}; }
  Degrees<2> degrees() const { return detail::max_degrees<2>(numerator[0].degrees(), weight.degrees()); }
};

/// A rational surface in space with exact rational coefficients: Bézier pieces in a grid over finite ranges of both
/// parameters, in order, the second parameter fastest. Valid by construction: weights positive on the pieces, corners and
/// sides included; no piece is a single point or a curve. A common factor of a piece's numerators and weight may be there.
/// Neighbours meet; how smoothly is not classified yet: the chains have no joints. Immutable.
class Rational_surface {
public:
  Rational_surface(std::vector<Surface_piece> pieces, std::array<Chain, 2> chains)
    : pieces_(std::move(pieces)), chains_(std::move(chains))
  {
  }

  const std::vector<Surface_piece>& pieces() const { return pieces_; }
  const std::array<Chain, 2>& chains() const { return chains_; }

private:
  std::vector<Surface_piece> pieces_;
  std::array<Chain, 2> chains_;
};

namespace detail {

// --------------------------------------------------------------------------------------------------- numbers that fit

inline void require_surface_degrees(const Degrees<2>& degrees)
{
  for (std::size_t k = 0; k < degrees.size(); ++k)
    if (degrees[k] < 1)
      throw Invalid_input(".degrees[" + std::to_string(k) + "]",
                          "the degree must be a whole number from 1 on, not " + std::to_string(degrees[k]),
                          "use 1 where the surface is ruled, 3 for most surfaces");
}

/// `wanted`: rows times points in a row.
inline void require_surface_points(std::size_t points, const std::array<std::size_t, 2>& wanted, const std::string& reason)
{
  if (points == wanted[0] * wanted[1]) return;
  throw Invalid_input(".control_points", std::to_string(points) + " control points for " + reason,
                      "give " + std::to_string(wanted[0]) + " rows of " + std::to_string(wanted[1]) +
                        ", the first index running with the first parameter");
}

inline void require_surface_weights(const std::vector<Rational>& weights, std::size_t points)
{
  if (weights.empty()) return;
  if (weights.size() != points)
    throw Invalid_input(".weights", std::to_string(weights.size()) + " weights for " + std::to_string(points) + " control points",
                        "give one weight for each control point, or none");
  if (std::all_of(weights.begin(), weights.end(), [](const Rational& w) { return w == 0; }))
    throw Invalid_input(".weights", "all weights are zero", "use positive weights");
}

/// The number of control points that each parameter's knots ask for.
inline std::array<std::size_t, 2> control_counts(const Knot_array<2>& knots)
{
  std::array<std::size_t, 2> counts{};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const std::string place = ".knots[" + std::to_string(k) + "]", degree = std::to_string(knots[k].degree);
    const auto order = static_cast<std::size_t>(knots[k].degree) + 1, size = knots[k].values.size();
    if (size < 2 * order)
      throw Invalid_input(place, std::to_string(size) + " knots for degree " + degree,
                          "give at least 2·(degree + 1) = " + std::to_string(2 * order));
    counts[k] = size - order;
    require_knots(knots[k], counts[k], knots[k].degree, place);
  }
  return counts;
}

// --------------------------------------------------------------------------------------------------------- pieces

/// The Bézier pieces of a spline, as homogeneous forms.
inline std::vector<Surface_piece> extract_pieces(const Knot_array<2>& knots, const std::vector<Exact_point<3>>& points,
                                                 const std::vector<Rational>& weights)
{
  const auto weight = [&](std::size_t i) { return weights.empty() ? Rational(1) : weights[i]; };
  const auto spans_of = [&](auto coefficient) {
    std::vector<Rational> coefficients;
    for (std::size_t i = 0; i < points.size(); ++i) coefficients.push_back(coefficient(i));
    return bezier_spans(Spline<Rational, 2>(knots, std::move(coefficients)));
  };
  std::vector<Surface_piece> pieces;
  for (auto& span : spans_of(weight)) {
    pieces.emplace_back();
    pieces.back().weight = std::move(span.form);
  }
  for (std::size_t v = 0; v < 3; ++v) {
    auto spans = spans_of([&](std::size_t i) { return Rational(points[i][v] * weight(i)); });
    for (std::size_t n = 0; n < spans.size(); ++n) pieces[n].numerator[v] = std::move(spans[n].form);
  }
  return pieces;
}

inline std::array<Chain, 2> chains_over(const Knot_array<2>& knots)
{
  std::array<Chain, 2> chains;
  for (std::size_t k = 0; k < chains.size(); ++k) {
    const std::vector<Rational> breaks = knots[k].breaks();
    chains[k].pieces.clear();
    for (std::size_t i = 1; i < breaks.size(); ++i) chains[k].pieces.push_back(finite_range(breaks[i - 1], breaks[i]));
  }
  return chains;
}

/// The ranges of a piece of the grid.
inline std::array<Piece, 2> ranges_of(const std::array<Chain, 2>& chains, std::size_t piece)
{
  const std::size_t row = chains[1].pieces.size();
  return {chains[0].pieces[piece / row], chains[1].pieces[piece % row]};
}

inline void multiply_all(Surface_piece& piece, const Rational& factor)
{
  for (auto& x : piece.numerator) x = multiply(x, factor);
  piece.weight = multiply(piece.weight, factor);
}

/// Makes a constant weight one of degrees 0, and 1.
inline void settle_weight(Surface_piece& piece)
{
  const Rational first = piece.weight[0];
  const auto& w = piece.weight.coefficients();
  if (!std::all_of(w.begin(), w.end(), [&](const Rational& x) { return x == first; })) return;
  multiply_all(piece, Rational(1 / first));
  piece.weight = Bernstein<Rational, 2>(Degrees<2>{}, {Rational(1)});
}

// ---------------------------------------------------------------------------------------------------------- poles

using Square_point = std::array<Rational, 2>;

/// A place of the unit square where a weight is not positive, or not proved to be.
struct Weight_doubt {
  Square_point at;
  bool vanishes = false; ///< proved, within 2^-40 of the place
};

/// A polynomial on a part of the unit square, in Bernstein form on that part.
struct Weight_part {
  Bernstein<Rational, 2> form;
  Square_point lo{Rational(0), Rational(0)}, hi{Rational(1), Rational(1)};
  int depth = 0;

  const Rational& least() const { return *std::min_element(form.coefficients().begin(), form.coefficients().end()); }

  /// A corner where the polynomial is not positive.
  std::optional<Square_point> corner() const
  {
    for (const bool i : {false, true})
      for (const bool j : {false, true})
        if (form.at({i ? form.degree(0) : 0, j ? form.degree(1) : 0}) <= 0)
          return Square_point{i ? hi[0] : lo[0], j ? hi[1] : lo[1]};
    return std::nullopt;
  }

  /// Halves, in the variables by turns; the one with the lesser coefficient last.
  std::array<Weight_part, 2> halves() const
  {
    const auto k = static_cast<std::size_t>(depth % 2);
    const Rational middle = (lo[k] + hi[k]) / 2;
    auto forms = split(form, static_cast<int>(k), Rational(1, 2));
    std::array<Weight_part, 2> parts{Weight_part{std::move(forms.first), lo, hi, depth + 1},
                                     Weight_part{std::move(forms.second), lo, hi, depth + 1}};
    parts[0].hi[k] = parts[1].lo[k] = middle;
    if (parts[0].least() < parts[1].least()) std::swap(parts[0], parts[1]);
    return parts;
  }
};

/// Between the origin, where a polynomial is positive, and a point where it is not: a place near a zero.
inline Square_point near_zero(const Bernstein<Rational, 2>& f, const Square_point& to)
{
  const auto on_way = [&](const Rational& s) { return Square_point{Rational(s * to[0]), Rational(s * to[1])}; };
  Rational lo = 0, hi = 1;
  for (int i = 0; i < 40; ++i) {
    const Rational middle = (lo + hi) / 2;
    (evaluate(f, on_way(middle)) > 0 ? lo : hi) = middle;
  }
  return on_way(hi);
}

/// Where a weight is not proved positive on the unit square; at the origin it is not negative. Decided by exact
/// subdivision, towards the least coefficients first, so that a zero is soon met. A zero that it only touches is never
/// proved: the limits end the search, 2^-20 in each variable, and so many parts that high degrees take seconds.
inline std::optional<Weight_doubt> weight_doubt(const Bernstein<Rational, 2>& weight)
{
  constexpr int max_depth = 40, max_parts = 2000;
  std::vector<Weight_part> open(1);
  open[0].form = weight;
  for (int parts = 0; !open.empty(); ++parts) {
    const Weight_part part = std::move(open.back());
    open.pop_back();
    if (part.least() > 0) continue;
    if (const auto corner = part.corner()) return Weight_doubt{near_zero(weight, *corner), true};
    if (part.depth == max_depth || parts >= max_parts) return Weight_doubt{part.lo, false};
    for (Weight_part& half : part.halves()) open.push_back(std::move(half));
  }
  return std::nullopt;
}

/// Makes all weights positive. Throws Invalid_input where one vanishes on the domain, or comes so near to it that the
/// subdivision cannot tell. Neighbours' weights agree where they meet, so each piece starts where another proved it positive.
inline void make_weights_positive(std::vector<Surface_piece>& pieces, const std::array<Chain, 2>& chains)
{
  if (pieces[0].weight[0] < 0)
    for (Surface_piece& piece : pieces) multiply_all(piece, Rational(-1));
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    const auto doubt = weight_doubt(pieces[n].weight);
    if (!doubt) continue;
    const auto ranges = ranges_of(chains, n);
    const std::string place = "near (u, v) = (" + std::to_string(ranges[0].at(doubt->at[0])->get_d()) + ", " +
                              std::to_string(ranges[1].at(doubt->at[1])->get_d()) + ")";
    throw Invalid_input(".weights",
                        doubt->vanishes
                          ? "the denominator vanishes on the domain " + place + " (a pole)"
                          : "the denominator is not proved positive " + place + ": it touches zero (a pole), or nearly so",
                        "use positive weights");
  }
}

// ----------------------------------------------------------------------------------------------- points and curves

/// Whether the surface's normal is zero all along the line where the first local coordinate is `u`.
inline bool normal_vanishes_along(const Surface_piece& piece, const Rational& u)
{
  using namespace operators;
  const auto along = [&](const Bernstein<Rational, 2>& f) { return face(split(f, 0, u).first, 0, true); };
  const auto p = vector_of<3>([&](std::size_t k) { return along(piece.numerator[k]); });
  const auto slope = vector_of<3>([&](std::size_t k) { return along(derivative(piece.numerator[k], 0)); });
  const Bernstein<Rational, 1> w = along(piece.weight), w_slope = along(derivative(piece.weight, 0));
  const auto across = w * slope - w_slope * p, onwards = w * derivative(p) - derivative(w) * p;
  return locus::is_zero(cross(across, onwards));
}

/// Whether the normal vanishes identically. The 3×3 minors of the point and its derivatives in homogeneous coordinates
/// have a degree below 3·degree in the first parameter: so many lines tell. Mostly the first does.
inline bool has_no_normal(const Surface_piece& piece)
{
  const int lines = 3 * piece.degrees()[0];
  for (int i = 1; i <= lines; ++i)
    if (!normal_vanishes_along(piece, Rational(i) / (lines + 1))) return false;
  return true;
}

inline bool is_single_point(const Surface_piece& piece)
{
  // x/w constant: x·w(0) = w·x(0).
  return locus::is_zero(vector_of<3>([&](std::size_t k) {
    return subtract(multiply(piece.numerator[k], Rational(piece.weight[0])),
                    multiply(piece.weight, Rational(piece.numerator[k][0])));
  }));
}

/// Throws Invalid_input where the surface, or a piece of it, is a single point or a curve.
inline void reject_flat_pieces(const std::vector<Surface_piece>& pieces, const std::array<Chain, 2>& chains)
{
  std::vector<std::size_t> flat;
  for (std::size_t n = 0; n < pieces.size(); ++n)
    if (has_no_normal(pieces[n])) flat.push_back(n);
  if (flat.empty()) return;
  const bool all = flat.size() == pieces.size();
  const bool point = std::all_of(flat.begin(), all ? flat.end() : flat.begin() + 1,
                                 [&](std::size_t n) { return is_single_point(pieces[n]); });
  const std::string kind = point ? "point" : "curve", what = point ? "a single point" : "a curve";
  if (all) throw Invalid_input(".control_points", "the surface is " + what, "use a " + kind + " input instead");
  const auto ranges = ranges_of(chains, flat[0]);
  const auto interval = [](const Piece& p) { return "[" + p.lo.get_str() + ", " + p.hi.get_str() + "]"; };
  throw Invalid_input(".control_points",
                      "the surface is only " + what + " over " + interval(ranges[0]) + " × " + interval(ranges[1]),
                      "take out the control points that repeat others, with as many knots");
}

/// The surface on valid knots with as many control points as they ask for.
inline Rational_surface surface_on(const Knot_array<2>& knots, const std::vector<Exact_point<3>>& points,
                                   const std::vector<Rational>& weights)
{
  require_surface_weights(weights, points.size());
  std::vector<Surface_piece> pieces = extract_pieces(knots, points, weights);
  std::array<Chain, 2> chains = chains_over(knots);
  make_weights_positive(pieces, chains);
  for (Surface_piece& piece : pieces) settle_weight(piece);
  reject_flat_pieces(pieces, chains);
  return Rational_surface(std::move(pieces), std::move(chains));
}

} // namespace detail

/// A (rational) Bézier surface on the unit square from its control points, row by row, the first index running with the
/// first parameter, and, if given, one weight for each.
/// Throws Invalid_input where numbers do not fit, the denominator vanishes on the square or touches zero so nearly that
/// subdivision cannot tell, or the surface is a single point or a curve. Equal weights give a polynomial surface; weights
/// that are all negative change their sign.
/// Time: that of `bezier_spans`, O((p+q)·p·q) operations on rationals for degrees p and q; weights that are not all
/// positive cost up to 2000 subdivisions.
inline Rational_surface bezier_surface(const Degrees<2>& degrees, const std::vector<Exact_point<3>>& points,
                                       const std::vector<Rational>& weights = {})
{
  detail::require_surface_degrees(degrees);
  std::array<std::size_t, 2> counts{};
  Knot_array<2> knots;
  for (std::size_t k = 0; k < 2; ++k) {
    counts[k] = static_cast<std::size_t>(degrees[k]) + 1;
    knots[k] = detail::bernstein_knots(degrees[k], {Rational(0), Rational(1)});
  }
  detail::require_surface_points(points.size(), counts,
                                 "degrees " + std::to_string(degrees[0]) + " and " + std::to_string(degrees[1]));
  return detail::surface_on(knots, points, weights);
}

/// A (rational) B-spline surface: degrees, control points row by row as for `bezier_surface`, and for each parameter its
/// knots, clamped or not, control points in that direction + degree + 1 of them, and, if given, one weight for each point.
/// Each parameter runs from knots[degree] to knots[number of points]. Inner knots stand at most degree times: surfaces do
/// not jump. The pieces are the products of spans of positive length.
/// Throws Invalid_input as `bezier_surface` does, where knots break the rules, and where a piece is a point or a curve.
/// Time: that of `bezier_spans`; poles as for `bezier_surface`, for each piece.
inline Rational_surface bspline_surface(const Degrees<2>& degrees, const std::vector<Exact_point<3>>& points,
                                        const std::array<std::vector<Rational>, 2>& knots,
                                        const std::vector<Rational>& weights = {})
{
  detail::require_surface_degrees(degrees);
  const Knot_array<2> valid{Knots{degrees[0], knots[0]}, Knots{degrees[1], knots[1]}};
  const auto counts = detail::control_counts(valid);
  detail::require_surface_points(points.size(), counts,
                                 "knots that ask for " + std::to_string(counts[0]) + " × " + std::to_string(counts[1]));
  return detail::surface_on(valid, points, weights);
}

namespace detail {

/// Adds the corners of a piece's control net; halved where weights are not all positive, since the hull says nothing then.
inline void collect_control_points(const Surface_piece& piece, std::vector<Exact_point<3>>& points, int variable = 0)
{
  const auto& w = piece.weight.coefficients();
  if (!std::all_of(w.begin(), w.end(), [](const Rational& x) { return x > 0; })) {
    std::array<Surface_piece, 2> halves;
    const auto cut = [&](const Bernstein<Rational, 2>& f) { return split(f, variable, Rational(1, 2)); };
    for (std::size_t k = 0; k < 3; ++k) std::tie(halves[0].numerator[k], halves[1].numerator[k]) = cut(piece.numerator[k]);
    std::tie(halves[0].weight, halves[1].weight) = cut(piece.weight);
    for (const Surface_piece& half : halves) collect_control_points(half, points, 1 - variable);
    return;
  }
  for (std::size_t i = 0; i < piece.numerator[0].size(); ++i) {
    const Rational& weight = piece.weight[piece.is_polynomial() ? 0 : i];
    points.push_back({Rational(piece.numerator[0][i] / weight), Rational(piece.numerator[1][i] / weight), Rational(piece.numerator[2][i] / weight)});
  }
}

} // namespace detail

} // namespace locus

#endif
