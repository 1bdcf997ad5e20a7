// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_CRITICAL_H
#define LOCUS_CHECK_CRITICAL_H

#include <locus/check/equations.h>

#include <optional>

namespace locus {
namespace check {

// Critical points that no interval-like test can isolate: by resultants of the gradient, which are recomputed here from values
// at integers, and by the gradient's index along a box.

/// The resultant of two polynomials over the rationals, by Euclid's algorithm.
inline Rational resultant(std::vector<Rational> f, std::vector<Rational> g)
{
  Rational r = 1;
  for (;;) {
    while (!g.empty() && g.back() == 0) g.pop_back();
    if (g.empty()) return f.size() == 1 ? r : Rational(0);
    const std::size_t n = f.size() - 1, m = g.size() - 1;
    if (m == 0) {
      for (std::size_t k = 0; k < n; ++k) r *= g[0];
      return r;
    }
    if (n >= m) { // Res(f, g) = (-1)^(nm) lc(g)^(n - deg(f mod g))·Res(g, f mod g)
      while (f.size() >= g.size()) {
        const Rational q = f.back() / g.back();
        for (std::size_t i = 0; i <= m; ++i) f[f.size() - 1 - m + i] -= q * g[i];
        f.pop_back();
      }
      while (!f.empty() && f.back() == 0) f.pop_back();
      if (f.empty()) return 0;
      for (std::size_t k = f.size() - 1; k < n; ++k) r *= g.back();
    }
    if (n * m % 2 == 1) r = -r;
    std::swap(f, g);
  }
}

/// The polynomial through values at the given integers, as integers up to a factor: Newton's divided differences.
inline Powers interpolated(const std::vector<long>& at, std::vector<Rational> value)
{
  const std::size_t n = at.size();
  for (std::size_t k = 1; k < n; ++k)
    for (std::size_t i = n - 1; i >= k; --i) value[i] = (value[i] - value[i - 1]) / Rational(at[i] - at[i - k]);
  std::vector<Rational> f;
  for (std::size_t k = n; k-- > 0;) {
    f.insert(f.begin(), Rational(0));
    for (std::size_t i = 0; i + 1 < f.size(); ++i) f[i] -= f[i + 1] * at[k];
    f[0] += value[k];
  }
  const Integer d = common_denominator(f);
  Powers out;
  for (const Rational& x : f) out.push_back(x.get_num() * (d / x.get_den()));
  make_primitive(out);
  return out;
}

/// The resultant of f and g that eliminates the other variable than `kept`, as a polynomial in that one up to a factor.
inline Powers resultant(const Table& f, const Table& g, int kept)
{
  const std::size_t k = cast(kept), o = 1 - k;
  const int degree = f.degree[o] * g.degree[k] + g.degree[o] * f.degree[k];
  std::vector<long> at;
  std::vector<Rational> values;
  for (long x = 0; static_cast<int>(at.size()) <= degree; x = x > 0 ? -x : 1 - x) {
    const Powers a = on_value(f, kept, x), b = on_value(g, kept, x);
    if (a.size() != cast(f.degree[o] + 1) || b.size() != cast(g.degree[o] + 1)) {
      if (x > 4L * (degree + 1)) return {}; // the leading coefficients vanish
      continue;
    }
    at.push_back(x);
    values.push_back(resultant(std::vector<Rational>(a.begin(), a.end()), std::vector<Rational>(b.begin(), b.end())));
  }
  return interpolated(at, std::move(values));
}

/// Exact quotient by g of a multiple of g, both without a content.
inline Powers quotient(Powers f, const Powers& g)
{
  Powers q(f.size() - g.size() + 1);
  for (std::size_t k = q.size(); k-- > 0;) {
    mpz_divexact(q[k].get_mpz_t(), f[k + g.size() - 1].get_mpz_t(), g.back().get_mpz_t());
    for (std::size_t i = 0; i < g.size(); ++i) f[k + i] -= q[k] * g[i];
  }
  return q;
}

/// Without variables of a degree that does not occur.
inline Table trimmed(const Table& f)
{
  int n = 0, m = 0;
  for (int i = 0; i <= f.degree[0]; ++i)
    for (int j = 0; j <= f.degree[1]; ++j)
      if (f.at(i, j) != 0) n = std::max(n, i), m = std::max(m, j);
  Table g(n, m);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) g.at(i, j) = f.at(i, j);
  return g;
}

/// What is known of a polynomial's critical points by its gradient.
class Critical_check {
public:
  explicit Critical_check(const Table& f) : ft_(trimmed(derivative(f, 0))), fr_(trimmed(derivative(f, 1))) {}

  /// The point of the evidence is the only one of the closed box where the gradient vanishes: in each variable the resultant
  /// has no other root than the point's on the box's range.
  bool is_only_one(const Algebraic& a, const Box& box)
  {
    Table m = in_variable(a.m, 0), h(0, static_cast<int>(a.h.size()) - 1);
    std::vector<Rational> all;
    std::size_t size = 1;
    for (const auto& c : a.h) all.insert(all.end(), c.begin(), c.end()), size = std::max(size, c.size());
    const Integer d = common_denominator(all);
    h = Table(static_cast<int>(size) - 1, h.degree[1]);
    for (std::size_t j = 0; j < a.h.size(); ++j)
      for (std::size_t i = 0; i < a.h[j].size(); ++i) h.at(static_cast<int>(i), static_cast<int>(j)) = a.h[j][i].get_num() * (d / a.h[j][i].get_den());
    const Powers second = resultant(m, trimmed(h), 1);
    return has_no_other_root(projection(0), a.m, box[0]) && has_no_other_root(projection(1), second, box[1]);
  }

  /// How often the gradient turns along a box's boundary, on which it must not vanish; from the Cauchy indices of its sides.
  std::optional<int> index(const Box& box) const
  {
    for (const auto& [a, b] : {std::array<int, 2>{0, 1}, {1, 1}, {1, 2}, {1, -1}, {2, 1}, {3, 1}, {1, 3}}) {
      const Table x = sum(scaled(ft_, b), scaled(fr_, a), -1), y = sum(scaled(ft_, a), scaled(fr_, b), 1); // turned: no zero of y at a corner
      bool clear = true;
      for (const Rational& s : box[0])
        for (const Rational& t : box[1]) clear = clear && sign_at(y, s, t) != 0;
      if (!clear) continue;
      // Twice the index: counterclockwise, the bottom and the right side forwards.
      const int turns = side_index(x, y, box, 1, 0) + side_index(x, y, box, 0, 1) - side_index(x, y, box, 1, 1) - side_index(x, y, box, 0, 0);
      return turns / 2;
    }
    return std::nullopt;
  }

private:
  static Table scaled(Table f, int factor)
  {
    for (Integer& c : f.c) c *= factor;
    return f;
  }

  const Powers& projection(int kept)
  {
    auto& p = projection_[cast(kept)];
    if (!p) p = resultant(ft_, fr_, kept);
    return *p;
  }

  static bool has_no_other_root(Powers f, const Powers& of_point, const std::array<Rational, 2>& range)
  {
    if (f.empty() || of_point.size() < 2 || sign_at(of_point, range[0]) == 0 || sign_at(of_point, range[1]) == 0) return false;
    if (roots_between(of_point, range[0], range[1]) != 1) return false;
    for (Powers common = common_factor(f, of_point); common.size() > 1; common = common_factor(f, of_point)) {
      make_primitive(f);
      f = quotient(std::move(f), common);
    }
    return has_no_zero(bernstein_on(in_variable(f, 0), {{range, {Rational(0), Rational(1)}}}), 12);
  }

  /// Jumps of x/y from -∞ to ∞ along a side, less those back.
  static int side_index(const Table& x, const Table& y, const Box& box, int variable, int end)
  {
    const Rational &at = box[cast(variable)][cast(end)], &lo = box[cast(1 - variable)][0], &hi = box[cast(1 - variable)][1];
    std::vector<Powers> chain{on_value(y, variable, at), on_value(x, variable, at)};
    while (!chain.back().empty()) {
      Powers r = remainder(chain[chain.size() - 2], chain.back());
      make_primitive(r);
      for (Integer& c : r) c = -c;
      chain.push_back(std::move(r));
    }
    chain.pop_back();
    return changes(chain, lo) - changes(chain, hi);
  }

  static int changes(const std::vector<Powers>& chain, const Rational& at)
  {
    Powers signs;
    for (const Powers& f : chain) signs.push_back(sign_at(f, at));
    return static_cast<int>(variations(signs));
  }

  Table ft_, fr_;
  std::array<std::optional<Powers>, 2> projection_;
};

} // namespace check
} // namespace locus

#endif
