// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_DIAGONAL_H
#define LOCUS_FUNCTION_DIAGONAL_H

#include <locus/function/scaled_basis.h>
#include <locus/number/interval.h>

#include <limits>
#include <optional>

namespace locus {

/// The line t = r, or t = 1 - r where `reversed`; more generally the curve r/(1-r) = ratio·t/(1-t), a Möbius map of the unit
/// interval that keeps its ends. Such a factor of F3 is an axis of symmetry or, as a fourth power, an overlap of two curves.
struct Diagonal {
  bool reversed = false;
  Rational ratio = 1; ///< positive

  /// ratio·t(1-r) - r(1-t), with 1 - r for r where reversed: positive below the line.
  Bernstein<Rational, 2> polynomial() const
  {
    if (reversed) return {Degrees<2>{1, 1}, {-1, 0, 0, ratio}};
    return {Degrees<2>{1, 1}, {0, -1, ratio, 0}};
  }

  /// Its sign on a box.
  Sign side(const std::array<Interval, 2>& at) const
  {
    const Interval one(1), r = reversed ? one - at[1] : at[1];
    if (ratio == 1) return sign_of(at[0] - r);
    return sign_of(enclosing(ratio) * at[0] * (one - r) - r * (one - at[0]));
  }
};

namespace detail {

/// Powers p^j q^(m-j), j = 0…m, of a ratio p/q.
inline std::vector<Integer> ratio_powers(const Rational& ratio, int m)
{
  std::vector<Integer> power(static_cast<std::size_t>(m) + 1, Integer(1));
  for (std::size_t j = 1; j < power.size(); ++j) power[j] = power[j - 1] * ratio.get_num();
  Integer q = 1;
  for (std::size_t j = power.size(); j-- > 0; q *= ratio.get_den()) power[j] *= q;
  return power;
}

/// f along the line, as a polynomial in t, up to a positive factor.
inline Bernstein<Scaled_integer, 1> on_diagonal(const Bernstein<Scaled_integer, 2>& f, const Diagonal& line)
{
  const int n = f.degree(0), m = f.degree(1);
  const std::vector<Integer> power = ratio_powers(line.ratio, m);
  std::vector<Integer> sum(static_cast<std::size_t>(n + m) + 1, Integer(0));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
      sum[static_cast<std::size_t>(i + j)] +=
        binomial<Integer>(n, i) * binomial<Integer>(m, j) * power[static_cast<std::size_t>(j)] * f.values().at({i, line.reversed ? m - j : j});
  unscale(sum);
  return {Bernstein<Integer, 1>(Degrees<1>{n + m}, std::move(sum)), Rational(1)};
}

/// Stretches r/(1-r) by `ratio`: coefficient j is multiplied by its j-th power.
inline void stretch(Scaled_form& f, const Rational& ratio)
{
  if (ratio == 1) return;
  const int m = f.degree(1);
  const std::vector<Integer> power = ratio_powers(ratio, m);
  for (int i = 0; i <= f.degree(0); ++i)
    for (int j = 0; j <= m; ++j) f.c.at({i, j}) *= power[static_cast<std::size_t>(j)];
  Integer common;
  mpz_pow_ui(common.get_mpz_t(), ratio.get_den_mpz_t(), static_cast<unsigned long>(m));
  f.scale /= common;
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

/// f / (t - r) for an f that t - r divides, over any coefficient type. In the scaled basis g_ij is a sum of coefficients of f along
/// i + j, from either end of that line: from the end where the smaller ones are, so that an enclosure stays close.
template <class T>
Bernstein<T, 2> quotient_by_diagonal(const Bernstein<T, 2>& f)
{
  const int n = f.degree(0), m = f.degree(1);
  const Bernstein<T, 2> c = scaled_by_binomials(f, false);
  Bernstein<T, 2> g(Degrees<2>{n - 1, m - 1});
  const auto size_of = [&](int i, int j) { return binomial<double>(n, i) * binomial<double>(m, j); };
  for (int line = 1; line < n + m; ++line) { // f's i + j; g's is one less
    const int first = std::max(0, line - m), last = std::min(n, line);
    double all = 0, below = 0;
    for (int i = first; i <= last; ++i) all += size_of(i, line - i);
    int i = first;
    T sum(0);
    for (; i < last && 2 * (below + size_of(i, line - i)) <= all; ++i) {
      below += size_of(i, line - i);
      sum -= c.at({i, line - i});
      g.at({i, line - 1 - i}) = sum;
    }
    sum = T(0);
    for (int k = last; k > i; --k) {
      sum += c.at({k, line - k});
      g.at({k - 1, line - k}) = sum;
    }
  }
  return scaled_by_binomials(g, true);
}

/// Divides a line's polynomial out of a nonzero polynomial as often as it goes, but at most `limit` times; returns how often.
inline int divide_by_diagonal(Scaled_form& f, const Diagonal& line, int limit = std::numeric_limits<int>::max())
{
  const int n = f.degree(0), m = f.degree(1);
  if (f.c.at({0, line.reversed ? m : 0}) != 0 || f.c.at({n, line.reversed ? 0 : m}) != 0) return 0; // the line's ends
  if (line.reversed) f.reverse(1);
  stretch(f, line.ratio);
  int multiplicity = 0;
  for (; multiplicity < limit; ++multiplicity) {
    auto quotient = divide_by_diagonal_once(f.c);
    if (!quotient) break;
    f.c = std::move(*quotient);
    f.scale /= line.ratio;
  }
  stretch(f, Rational(1 / line.ratio));
  if (line.reversed) f.reverse(1);
  return multiplicity;
}

struct Diagonal_quotient {
  Bernstein<Scaled_integer, 2> rest;
  int multiplicity = 0;
};

/// The same for the Bernstein form.
inline Diagonal_quotient divided_by_diagonal(const Bernstein<Scaled_integer, 2>& f, const Diagonal& line,
                                             int limit = std::numeric_limits<int>::max())
{
  Scaled_form rest(f);
  const int multiplicity = divide_by_diagonal(rest, line, limit);
  if (multiplicity == 0) return {f, 0};
  return {std::move(rest).bernstein(), multiplicity};
}

} // namespace detail

} // namespace locus

#endif
