// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_CORNER_CHART_H
#define LOCUS_FUNCTION_CORNER_CHART_H

#include <locus/function/scaled_basis.h>

namespace locus {

/// Coordinates (x0, x1) on a unit cell for a pair of local parameters (t, r): the parameters themselves, or one of the
/// two charts that blow a corner of the cell up. With τ and ρ the distances from the corner, chart `first` covers
/// τ ≤ ρ by τ = x0·x1, ρ = x1, and chart `second` covers ρ ≤ τ by τ = x1, ρ = x0·x1. The corner becomes the edge x1 = 0;
/// the charts share the edge x0 = 1. On `axis` only this line τ = ρ = x1 counts, at x0 = 1/2.
struct Corner_chart {
  enum class Kind : unsigned char { plain, first, second, axis };
  Kind kind = Kind::plain;
  std::array<int, 2> corner{0, 0}; ///< 0 or 1 for each parameter

  bool is_plain() const { return kind == Kind::plain; }

  /// The local parameters; T is exact, an interval or a jet.
  template <class T>
  std::array<T, 2> operator()(const std::array<T, 2>& x) const
  {
    if (is_plain()) return x;
    std::array<T, 2> p{x[1], x[1]};
    if (kind == Kind::first) p[0] = x[0] * x[1];
    if (kind == Kind::second) p[1] = x[0] * x[1];
    for (std::size_t v = 0; v < 2; ++v)
      if (corner[v] == 1) p[v] = T(1) - p[v];
    return p;
  }
};

/// Powers of the distances from a corner: coefficients of τ^i ρ^j, exact. Made once for both charts. O(n³) additions.
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
    const int n = powers_.degree(0), m = powers_.degree(1);
    order_ = n + m + 1;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= m; ++j)
        if (powers_.at({i, j}) != 0) order_ = std::min(order_, i + j);
  }

  /// Degree of the lowest form; above n + m for the zero polynomial.
  int order() const { return order_; }
  bool is_zero() const { return order_ > powers_.degree(0) + powers_.degree(1); }

  /// The polynomial on a chart, divided by x1^by, where `by` is at most `order()`. On `axis` it is that of chart `first` at
  /// 2·x0, so that it can be evaluated around the axis.
  Bernstein<Scaled_integer, 2> on(Corner_chart::Kind chart, int by) const
  {
    const int n = powers_.degree(0), m = powers_.degree(1);
    const bool first = chart != Corner_chart::Kind::second;
    Bernstein<Integer, 2> g(Degrees<2>{first ? n : m, n + m - std::min(by, n + m)});
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= m; ++j)
        if (powers_.at({i, j}) != 0) g.at({first ? i : j, i + j - by}) = powers_.at({i, j});
    for (int v = 0; v < 2; ++v) detail::shift_basis(g, v, false);
    Bernstein<Scaled_integer, 2> f = Scaled_form(std::move(g), scale_).bernstein();
    f.normalize();
    return chart == Corner_chart::Kind::axis ? restrict_to(f, 0, Rational(0), Rational(2)) : f;
  }

  /// The same divided as often as x1 divides it.
  Bernstein<Scaled_integer, 2> on(Corner_chart::Kind chart) const { return on(chart, order_); }

private:
  Bernstein<Integer, 2> powers_;
  Rational scale_;
  int order_ = 0;
};

} // namespace locus

#endif
