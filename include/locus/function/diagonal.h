// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_DIAGONAL_H
#define LOCUS_FUNCTION_DIAGONAL_H

#include <locus/function/scaled_basis.h>

#include <limits>
#include <optional>

namespace locus {

// Factors t - r of bivariate polynomials, or t + r - 1 where `reversed` is said.

namespace detail {

/// t - r, or t + r - 1, in Bernstein form.
inline Bernstein<Rational, 2> diagonal(bool reversed)
{
  if (reversed) return {Degrees<2>{1, 1}, {-1, 0, 0, 1}};
  return {Degrees<2>{1, 1}, {0, -1, 1, 0}};
}

/// f(t, t), or f(t, 1-t), up to a positive factor.
inline Bernstein<Scaled_integer, 1> on_diagonal(const Bernstein<Scaled_integer, 2>& f, bool reversed)
{
  const int n = f.degree(0), m = f.degree(1);
  std::vector<Integer> sum(static_cast<std::size_t>(n + m) + 1, Integer(0));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
      sum[static_cast<std::size_t>(i + j)] += binomial<Integer>(n, i) * binomial<Integer>(m, j) * f.values().at({i, reversed ? m - j : j});
  unscale(sum);
  return {Bernstein<Integer, 1>(Degrees<1>{n + m}, std::move(sum)), Rational(1)};
}

/// One division by t - r of integer coefficients in the scaled basis. There t - r is xv - yu in homogeneous coordinates
/// (x:y), (u:v), so that f_ij = g_(i-1)j - g_i(j-1): additions only. Nothing where t - r does not divide f.
inline std::optional<Bernstein<Integer, 2>> divide_by_diagonal_once(const Bernstein<Integer, 2>& f)
{
  const int n = f.degree(0), m = f.degree(1);
  if (n == 0 || m == 0 || f.at({0, 0}) != 0) return std::nullopt;
  Bernstein<Integer, 2> g(Degrees<2>{n - 1, m - 1});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      Integer& c = g.at({i, j});
      if (i > 0 && j + 1 < m) c = g.at({i - 1, j + 1});
      c -= f.at({i, j + 1});
    }
  for (int i = 1; i < n; ++i)
    if (f.at({i, 0}) != g.at({i - 1, 0})) return std::nullopt;
  for (int j = 1; j <= m; ++j) { // the last row: f_nj = g_(n-1)j
    const Integer last = j < m ? g.at({n - 1, j}) : Integer(0);
    if (f.at({n, j}) != last) return std::nullopt;
  }
  if (f.at({n, 0}) != g.at({n - 1, 0})) return std::nullopt;
  return g;
}

/// Divides t - r (or t + r - 1) out of a nonzero polynomial as often as it goes, but at most `limit` times; returns how
/// often.
inline int divide_by_diagonal(Scaled_form& f, bool reversed, int limit = std::numeric_limits<int>::max())
{
  const int n = f.degree(0), m = f.degree(1);
  if (f.c.at({0, reversed ? m : 0}) != 0 || f.c.at({n, reversed ? 0 : m}) != 0) return 0; // the line's ends
  if (reversed) f.reverse(1);
  int multiplicity = 0;
  for (; multiplicity < limit; ++multiplicity) {
    auto quotient = divide_by_diagonal_once(f.c);
    if (!quotient) break;
    f.c = std::move(*quotient);
  }
  if (reversed) f.reverse(1);
  return multiplicity;
}

struct Diagonal_quotient {
  Bernstein<Scaled_integer, 2> rest;
  int multiplicity = 0;
};

/// The same for the Bernstein form.
inline Diagonal_quotient divided_by_diagonal(const Bernstein<Scaled_integer, 2>& f, bool reversed,
                                             int limit = std::numeric_limits<int>::max())
{
  Scaled_form rest(f);
  const int multiplicity = divide_by_diagonal(rest, reversed, limit);
  if (multiplicity == 0) return {f, 0};
  return {std::move(rest).bernstein(), multiplicity};
}

} // namespace detail

} // namespace locus

#endif
