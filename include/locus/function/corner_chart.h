// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_CORNER_CHART_H
#define LOCUS_FUNCTION_CORNER_CHART_H

#include <locus/function/scaled_basis.h>

#include <algorithm>

namespace locus {

/// Coordinates (x0, x1) on a unit cell for a pair of local parameters (t, r): the parameters themselves, or a chart that
/// blows a corner of their cell up. With τ and ρ the distances from the corner a chart is τ = x0^a x1^b, ρ = x0^c x1^d of
/// determinant ±1. The first two are τ = x0·x1, ρ = x1, which covers τ ≤ ρ, and τ = x1, ρ = x0·x1, which covers the rest;
/// either can be blown up again at its own corner (0, 0). A chart's edges x0 = 0 and x1 = 0 are the corner or sides of the
/// cell; the edges x0 = 1 and x1 = 1 are other sides, or lines τ^q = ρ^p that two charts share, its rays (p, q).
struct Corner_chart {
  std::array<int, 2> corner{0, 0};                         ///< 0 or 1 for each parameter
  std::array<std::array<int, 2>, 2> exponent{{{1, 0}, {0, 1}}}; ///< [parameter][x]
  bool is_blown_up = false;
  bool is_axis = false; ///< only the line τ = ρ = x1 counts, at x0 = 1/2

  static Corner_chart at(const std::array<int, 2>& corner, bool first)
  {
    if (first) return {corner, {{{1, 1}, {0, 1}}}, true, false};
    return {corner, {{{0, 1}, {1, 1}}}, true, false};
  }
  static Corner_chart axis(const std::array<int, 2>& corner) { return {corner, {{{1, 1}, {0, 1}}}, true, true}; }

  bool is_plain() const { return !is_blown_up; }

  /// The two charts that cover this one with its corner blown up.
  std::array<Corner_chart, 2> blown_up_again() const
  {
    std::array<Corner_chart, 2> parts{*this, *this};
    for (std::size_t v = 0; v < 2; ++v)
      for (std::size_t k = 0; k < 2; ++k) parts[k].exponent[v] = {exponent[v][k], exponent[v][0] + exponent[v][1]};
    return parts;
  }

  /// The line that is the edge x_variable = 1.
  std::array<int, 2> ray(std::size_t variable) const { return {exponent[0][1 - variable], exponent[1][1 - variable]}; }
  /// Whether the chart lies on the side τ ≤ ρ.
  bool is_first_side() const { return exponent[0][0] + exponent[0][1] > exponent[1][0] + exponent[1][1]; }
  /// Whether (x0, x1) is oriented against (t, r).
  bool reverses() const
  {
    const int determinant = exponent[0][0] * exponent[1][1] - exponent[0][1] * exponent[1][0];
    return is_blown_up && (determinant < 0) != (corner[0] != corner[1]);
  }

  /// The local parameters; T is exact, an interval or a jet.
  template <class T>
  std::array<T, 2> operator()(const std::array<T, 2>& x) const
  {
    if (is_plain()) return x;
    std::array<T, 2> p{x[1], x[1]};
    for (std::size_t v = 0; v < 2; ++v) {
      if (!is_axis) p[v] = monomial(x, exponent[v]);
      if (corner[v] == 1) p[v] = T(1) - p[v];
    }
    return p;
  }

private:
  template <class T>
  static T monomial(const std::array<T, 2>& x, const std::array<int, 2>& power)
  {
    T product(1);
    bool any = false;
    for (std::size_t k = 0; k < 2; ++k)
      for (int i = 0; i < power[k]; ++i) {
        product = any ? T(product * x[k]) : x[k];
        any = true;
      }
    return product;
  }
};

/// Powers of the distances from a corner: coefficients of τ^i ρ^j, exact. Made once for all charts. O(n³) additions.
class Corner_expansion {
public:
  Corner_expansion(Scaled_form f, const std::array<int, 2>& corner)
  {
    for (int v = 0; v < 2; ++v) {
      if (corner[static_cast<std::size_t>(v)] == 1) f.reverse(v);
      detail::shift_basis(f.c, v, true);
    }
    powers_ = std::move(f.c);
    scale_ = std::move(f.scale);
    is_zero_ = std::all_of(powers_.coefficients().begin(), powers_.coefficients().end(), [](const Integer& c) { return c == 0; });
  }

  bool is_zero() const { return is_zero_; }

  /// The highest powers of x0 and x1 that divide the polynomial on a chart; zero for the zero polynomial.
  std::array<int, 2> order_on(const Corner_chart& chart) const
  {
    std::array<int, 2> least{0, 0};
    bool any = false;
    for_each_power(chart, [&](const std::array<int, 2>& power, const Integer&) {
      for (std::size_t k = 0; k < 2; ++k) least[k] = any ? std::min(least[k], power[k]) : power[k];
      any = true;
    });
    return least;
  }

  /// The polynomial on a chart, divided by x0^by[0]·x1^by[1], which must divide it. On an axis it is that of the first chart
  /// at 2·x0, so that it can be evaluated around the axis.
  Bernstein<Scaled_integer, 2> on(const Corner_chart& chart, const std::array<int, 2>& by) const
  {
    Degrees<2> degrees{0, 0};
    for_each_power(chart, [&](const std::array<int, 2>& power, const Integer&) {
      for (std::size_t k = 0; k < 2; ++k) degrees[k] = std::max(degrees[k], power[k] - by[k]);
    });
    Bernstein<Integer, 2> g(degrees);
    for_each_power(chart, [&](const std::array<int, 2>& power, const Integer& c) { g.at({power[0] - by[0], power[1] - by[1]}) = c; });
    for (int v = 0; v < 2; ++v) detail::shift_basis(g, v, false);
    Bernstein<Scaled_integer, 2> f = Scaled_form(std::move(g), scale_).bernstein();
    f.normalize();
    return chart.is_axis ? restrict_to(f, 0, Rational(0), Rational(2)) : f;
  }

  /// The same divided as often as it goes.
  Bernstein<Scaled_integer, 2> on(const Corner_chart& chart) const { return on(chart, order_on(chart)); }

  /// Whether the divided polynomial is singular at the chart's corner (0, 0): it has neither a constant nor a linear term.
  bool is_singular_on(const Corner_chart& chart) const
  {
    const std::array<int, 2> least = order_on(chart);
    bool regular = is_zero_;
    for_each_power(chart, [&](const std::array<int, 2>& power, const Integer&) {
      regular = regular || power[0] - least[0] + power[1] - least[1] <= 1;
    });
    return !regular;
  }

private:
  /// Calls f(powers of x0 and x1, coefficient) for every nonzero coefficient.
  template <class F>
  void for_each_power(const Corner_chart& chart, F f) const
  {
    const auto& e = chart.exponent;
    for (int i = 0; i <= powers_.degree(0); ++i)
      for (int j = 0; j <= powers_.degree(1); ++j)
        if (const Integer& c = powers_.at({i, j}); c != 0)
          f(std::array<int, 2>{i * e[0][0] + j * e[1][0], i * e[0][1] + j * e[1][1]}, c);
  }

  Bernstein<Integer, 2> powers_;
  Rational scale_;
  bool is_zero_ = false;
};

} // namespace locus

#endif
