// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_POLYNOMIAL_H
#define LOCUS_CHECK_POLYNOMIAL_H

#include <locus/number/rational.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace locus {
namespace check {

// The checker's own polynomial arithmetic, in integers. Polynomials count up to positive factors, so that nothing is ever
// divided: denominators are cleared, and subdivision multiplies by the cut's denominator.

/// A claim that does not hold, with what failed and where.
class Refused : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Coefficients of 1, x, x², …
using Powers = std::vector<Integer>;

inline std::size_t cast(int i) { return static_cast<std::size_t>(i); }

inline Integer binomial(int n, int k)
{
  Integer b;
  mpz_bin_uiui(b.get_mpz_t(), static_cast<unsigned long>(n), static_cast<unsigned long>(k));
  return b;
}

/// Common denominator of fractions.
inline Integer common_denominator(const std::vector<Rational>& list)
{
  Integer d = 1;
  for (const Rational& x : list) d = lcm(d, x.get_den());
  return d;
}

inline void trim(Powers& f)
{
  while (!f.empty() && f.back() == 0) f.pop_back();
}

inline Powers product(const Powers& f, const Powers& g)
{
  if (f.empty() || g.empty()) return {};
  Powers h(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) mpz_addmul(h[i + j].get_mpz_t(), f[i].get_mpz_t(), g[j].get_mpz_t());
  return h;
}

/// f + factor·g
inline Powers sum(Powers f, const Powers& g, const Integer& factor = 1)
{
  if (f.size() < g.size()) f.resize(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) f[i] += factor * g[i];
  trim(f);
  return f;
}

inline Powers derivative(const Powers& f)
{
  Powers d;
  for (std::size_t i = 1; i < f.size(); ++i) d.push_back(f[i] * static_cast<unsigned long>(i));
  return d;
}

/// f(x/y)·y^n with n = f.size() - 1.
inline Integer homogeneous_value(const Powers& f, const Integer& x, const Integer& y)
{
  Integer value = 0, power = 1;
  for (std::size_t i = f.size(); i-- > 0;) { // from the highest power of x down, with the power of y that is missing
    value *= x;
    value += f[i] * power;
    power *= y;
  }
  return value;
}

inline int sign_at(const Powers& f, const Rational& x) { return sgn(homogeneous_value(f, x.get_num(), x.get_den())); }

/// f((a + b·x)/d)·d^n
inline Powers on_line(const Powers& f, const Integer& a, const Integer& b, const Integer& d)
{
  Powers g;
  Integer power = 1;
  for (std::size_t i = f.size(); i-- > 0;) {
    if (g.empty()) g.assign(1, Integer(0));
    else g = product(g, {a, b});
    g[0] += f[i] * power;
    power *= d;
  }
  return g;
}

inline void make_primitive(Powers& f)
{
  trim(f);
  Integer common = 0;
  for (const Integer& c : f) common = gcd(common, c);
  if (common > 1)
    for (Integer& c : f) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), common.get_mpz_t());
}

/// A positive multiple of the remainder of f by g.
inline Powers remainder(Powers f, const Powers& g)
{
  const Integer size = abs(g.back());
  const int sign = sgn(g.back());
  trim(f);
  while (f.size() >= g.size()) {
    const Integer lead = f.back() * sign;
    for (Integer& c : f) c *= size;
    const std::size_t shift = f.size() - g.size();
    for (std::size_t i = 0; i < g.size(); ++i) f[i + shift] -= lead * g[i];
    trim(f);
    make_primitive(f);
  }
  return f;
}

inline Powers common_factor(Powers f, Powers g)
{
  make_primitive(f);
  make_primitive(g);
  while (!g.empty()) {
    Powers r = remainder(f, g);
    make_primitive(r);
    f = std::exchange(g, std::move(r));
  }
  return f;
}

// ------------------------------------------------------------------------------------------------- roots on (0, ∞)

inline std::size_t variations(const Powers& c)
{
  std::size_t n = 0;
  int last = 0;
  for (const Integer& x : c) {
    const int s = sgn(x);
    n += s != 0 && last != 0 && s != last;
    if (s != 0) last = s;
  }
  return n;
}

/// Sturm's chain. Also of a polynomial with multiple roots it counts the different ones.
class Sturm_chain {
public:
  explicit Sturm_chain(Powers f)
  {
    make_primitive(f);
    Powers g = derivative(f);
    make_primitive(g);
    chain_.push_back(std::move(f));
    while (!g.empty()) {
      chain_.push_back(g);
      Powers r = remainder(chain_[chain_.size() - 2], g);
      make_primitive(r);
      for (Integer& c : r) c = -c;
      g = std::move(r);
    }
  }

  /// Of those in (0, ∞): the last of the chain is the common factor with the derivative.
  bool has_simple_roots_only() const { return chain_.back().size() == 1 || Sturm_chain(chain_.back()).positive() == 0; }

  /// Different roots in (0, ∞), none at 0.
  std::size_t positive() const { return changes([](const Powers& f) { return lowest(f); }) - changes([](const Powers& f) { return sgn(f.back()); }); }

  /// Different roots in (a, b], none at the ends.
  std::size_t between(const Rational& a, const Rational& b) const
  {
    return changes([&](const Powers& f) { return sign_at(f, a); }) - changes([&](const Powers& f) { return sign_at(f, b); });
  }

private:
  static int lowest(const Powers& f)
  {
    for (const Integer& c : f)
      if (c != 0) return sgn(c);
    return 0;
  }

  template <class Sign>
  std::size_t changes(Sign sign) const
  {
    std::size_t n = 0;
    int last = 0;
    for (const Powers& f : chain_) {
      const int s = sign(f);
      n += s != 0 && last != 0 && s != last;
      if (s != 0) last = s;
    }
    return n;
  }

  std::vector<Powers> chain_;
};

/// Number of different roots in (a, b), where f does not vanish at either end.
inline std::size_t roots_between(const Powers& f, const Rational& a, const Rational& b)
{
  return Sturm_chain(f).between(a, b);
}

// ---------------------------------------------------------------------------------------------------- two variables

using Box = std::array<std::array<Rational, 2>, 2>; ///< [variable][low, high]

/// A polynomial in two variables: a table of coefficients, of powers or of a Bernstein form.
struct Table {
  std::array<int, 2> degree{0, 0};
  std::vector<Integer> c = std::vector<Integer>(1);

  Table() = default;
  Table(int n, int m) : degree{n, m}, c(cast(n + 1) * cast(m + 1)) {}

  Integer& at(int i, int j) { return c[cast(i) * cast(degree[1] + 1) + cast(j)]; }
  const Integer& at(int i, int j) const { return c[cast(i) * cast(degree[1] + 1) + cast(j)]; }
  bool is_zero() const
  {
    return std::all_of(c.begin(), c.end(), [](const Integer& x) { return x == 0; });
  }
  int count(int variable) const { return degree[cast(variable)] + 1; }
  /// Distance of neighbours along a variable.
  std::size_t step(int variable) const { return variable == 1 ? 1 : cast(degree[1] + 1); }

  /// Row k of those that run along a variable.
  std::size_t row(int variable, int k) const { return variable == 1 ? cast(k) * cast(degree[1] + 1) : cast(k); }
};

inline Table in_variable(const Powers& f, int variable)
{
  const int n = std::max(0, static_cast<int>(f.size()) - 1);
  Table t(variable == 0 ? n : 0, variable == 1 ? n : 0);
  std::copy(f.begin(), f.end(), t.c.begin());
  return t;
}

inline Table outer_product(const Powers& f, const Powers& g)
{
  Table t(std::max(0, static_cast<int>(f.size()) - 1), std::max(0, static_cast<int>(g.size()) - 1));
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) t.c[i * g.size() + j] = f[i] * g[j];
  return t;
}

inline Table product(const Table& f, const Table& g)
{
  Table h(f.degree[0] + g.degree[0], f.degree[1] + g.degree[1]);
  for (int i = 0; i <= f.degree[0]; ++i)
    for (int j = 0; j <= f.degree[1]; ++j) {
      const Integer& a = f.at(i, j);
      if (a == 0) continue;
      for (int k = 0; k <= g.degree[0]; ++k)
        for (int l = 0; l <= g.degree[1]; ++l) mpz_addmul(h.at(i + k, j + l).get_mpz_t(), a.get_mpz_t(), g.at(k, l).get_mpz_t());
    }
  return h;
}

/// f + sign·g
inline Table sum(const Table& f, const Table& g, int sign)
{
  Table h(std::max(f.degree[0], g.degree[0]), std::max(f.degree[1], g.degree[1]));
  for (int i = 0; i <= f.degree[0]; ++i)
    for (int j = 0; j <= f.degree[1]; ++j) h.at(i, j) = f.at(i, j);
  for (int i = 0; i <= g.degree[0]; ++i)
    for (int j = 0; j <= g.degree[1]; ++j)
      if (sign > 0) h.at(i, j) += g.at(i, j);
      else h.at(i, j) -= g.at(i, j);
  return h;
}

inline Table derivative(const Table& f, int variable)
{
  if (f.degree[cast(variable)] == 0) return Table(0, 0);
  Table d(f.degree[0] - (variable == 0), f.degree[1] - (variable == 1));
  for (int i = 0; i <= d.degree[0]; ++i)
    for (int j = 0; j <= d.degree[1]; ++j)
      d.at(i, j) = f.at(i + (variable == 0), j + (variable == 1)) * ((variable == 0 ? i : j) + 1);
  return d;
}

/// Coefficients of powers on the line where one variable has a value, times the denominator's power.
inline Powers on_value(const Table& f, int variable, const Rational& value)
{
  Powers g;
  for (int k = 0; k < f.count(1 - variable); ++k) {
    Powers row;
    for (int l = 0; l < f.count(variable); ++l) row.push_back(variable == 0 ? f.at(l, k) : f.at(k, l));
    g.push_back(homogeneous_value(row, value.get_num(), value.get_den()));
  }
  trim(g);
  return g;
}

inline int sign_at(const Table& f, const Rational& x, const Rational& y) { return sign_at(on_value(f, 0, x), y); }

/// Replaces a variable x by 1 - x.
inline Table mirrored(Table f, int variable)
{
  for (int k = 0; k < f.count(1 - variable); ++k) {
    Powers row;
    for (int l = 0; l < f.count(variable); ++l) row.push_back(variable == 0 ? f.at(l, k) : f.at(k, l));
    row = on_line(row, 1, -1, 1);
    for (int l = 0; l < f.count(variable); ++l) (variable == 0 ? f.at(l, k) : f.at(k, l)) = row[cast(l)];
  }
  return f;
}

/// The lowest power of each variable that occurs.
inline std::array<int, 2> lowest_powers(const Table& f)
{
  std::array<int, 2> least{f.degree[0], f.degree[1]};
  for (int i = 0; i <= f.degree[0]; ++i)
    for (int j = 0; j <= f.degree[1]; ++j)
      if (f.at(i, j) != 0) least = {std::min(least[0], i), std::min(least[1], j)};
  return least;
}

/// Two polynomials are equal up to a constant factor and shifts of their powers.
inline bool are_proportional(const Table& f, std::array<int, 2> f_shift, const Table& g, std::array<int, 2> g_shift)
{
  const auto entry = [](const Table& t, int i, int j) {
    static const Integer zero = 0;
    return i < 0 || j < 0 || i > t.degree[0] || j > t.degree[1] ? &zero : &t.at(i, j);
  };
  const Integer *f0 = nullptr, *g0 = nullptr;
  const int n = std::max(f.degree[0] - f_shift[0], g.degree[0] - g_shift[0]), m = std::max(f.degree[1] - f_shift[1], g.degree[1] - g_shift[1]);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const Integer *a = entry(f, i + f_shift[0], j + f_shift[1]), *b = entry(g, i + g_shift[0], j + g_shift[1]);
      if ((*a == 0) != (*b == 0)) return false;
      if (*a == 0) continue;
      if (!f0) f0 = a, g0 = b;
      else if (*a * *g0 != *b * *f0) return false;
    }
  return f0 != nullptr;
}

// --------------------------------------------------------------------------------------------------- Bernstein forms

/// Coefficients of powers to those of the basis x^i(1-x)^(n-i): x^k = x^k·(x + (1-x))^(n-k).
inline void to_scaled(Integer* c, int n, std::size_t step)
{
  for (int i = n; i > 0; --i)
    for (int k = 0; k < i; ++k) c[cast(i) * step] += binomial(n - k, i - k) * c[cast(k) * step];
}

/// Makes Bernstein coefficients of those of the scaled basis, times the binomials' common multiple.
inline void unscale(Integer* c, int n, std::size_t step)
{
  Integer common = 1;
  for (int i = 1; i < n; ++i) common = lcm(common, binomial(n, i));
  for (int i = 0; i <= n; ++i) c[cast(i) * step] *= common / binomial(n, i);
}

/// The Bernstein form on the unit square.
inline Table bernstein(Table f)
{
  for (int v = 0; v < 2; ++v)
    for (int k = 0; k < f.count(1 - v); ++k) {
      Integer* const row = f.c.data() + f.row(v, k);
      to_scaled(row, f.count(v) - 1, f.step(v));
      unscale(row, f.count(v) - 1, f.step(v));
    }
  return f;
}

/// The Bernstein form on any box.
inline Table bernstein_on(Table f, const Box& box)
{
  for (int v = 0; v < 2; ++v) {
    const Rational &lo = box[cast(v)][0], &hi = box[cast(v)][1];
    const Integer d = lcm(lo.get_den(), hi.get_den());
    const Integer a = lo.get_num() * (d / lo.get_den()), b = hi.get_num() * (d / hi.get_den()) - a;
    for (int k = 0; k < f.count(1 - v); ++k) {
      Powers row;
      for (int l = 0; l < f.count(v); ++l) row.push_back(f.c[f.row(v, k) + cast(l) * f.step(v)]);
      row = on_line(row, a, b, d);
      for (int l = 0; l < f.count(v); ++l) f.c[f.row(v, k) + cast(l) * f.step(v)] = row[cast(l)];
    }
  }
  return bernstein(std::move(f));
}

/// De Casteljau's cut at the part p/q of the range, times q^n: `f` becomes the low part, the high one is returned.
inline Table cut(Table& f, int variable, const Integer& p, const Integer& q)
{
  Table high(f.degree[0], f.degree[1]);
  const int n = f.count(variable) - 1;
  const Integer rest = q - p;
  std::vector<Integer> missing(cast(n) + 1, Integer(1)), row(cast(n) + 1); // what a pass lacks of q^n
  for (int pass = n; pass > 0; --pass) missing[cast(pass) - 1] = missing[cast(pass)] * q;
  for (int k = 0; k < f.count(1 - variable); ++k) {
    Integer *low_row = f.c.data() + f.row(variable, k), *high_row = high.c.data() + f.row(variable, k);
    for (int l = 0; l <= n; ++l) row[cast(l)] = low_row[cast(l) * f.step(variable)];
    for (int pass = 0; pass <= n; ++pass) {
      low_row[cast(pass) * f.step(variable)] = row[0] * missing[cast(pass)];
      high_row[cast(n - pass) * f.step(variable)] = row[cast(n - pass)] * missing[cast(pass)];
      for (int l = 0; l < n - pass; ++l) {
        if (q != 2) row[cast(l)] *= rest, mpz_addmul(row[cast(l)].get_mpz_t(), row[cast(l) + 1].get_mpz_t(), p.get_mpz_t());
        else row[cast(l)] += row[cast(l) + 1];
      }
    }
  }
  return high;
}

/// Coefficients along one side of a Bernstein form.
inline Powers side_of(const Table& f, int variable, int end)
{
  Powers s;
  for (int k = 0; k < f.count(1 - variable); ++k) s.push_back(f.c[f.row(variable, k) + (end ? cast(f.count(variable) - 1) * f.step(variable) : 0)]);
  return s;
}

/// The polynomial in x = s/(1-s), on (0, ∞), of Bernstein coefficients in s on (0, 1).
inline Powers on_half_line(Powers c)
{
  const int n = static_cast<int>(c.size()) - 1;
  for (int i = 1; i < n; ++i) c[cast(i)] *= binomial(n, i);
  return c;
}

/// 1 or -1 where all coefficients have that sign, else 0.
inline int strict_sign(const std::vector<Integer>& c)
{
  const int s = sgn(c[0]);
  for (const Integer& x : c)
    if (sgn(x) != s) return 0;
  return s;
}

/// Differences of neighbours along a variable: the derivative's Bernstein coefficients, up to the degree.
inline Table differences(const Table& f, int variable)
{
  if (f.degree[cast(variable)] == 0) return Table(f.degree[0], f.degree[1]);
  Table d(f.degree[0] - (variable == 0), f.degree[1] - (variable == 1));
  for (int i = 0; i <= d.degree[0]; ++i)
    for (int j = 0; j <= d.degree[1]; ++j) d.at(i, j) = f.at(i + (variable == 0), j + (variable == 1)) - f.at(i, j);
  return d;
}

/// Sign of the derivative along a variable where all differences have it strictly, else 0; without making them.
inline int slope_sign(const Table& f, int variable)
{
  if (f.degree[cast(variable)] == 0) return 0;
  int sign = 0;
  for (int i = 0; i + (variable == 0) <= f.degree[0]; ++i)
    for (int j = 0; j + (variable == 1) <= f.degree[1]; ++j) {
      const int c = cmp(f.at(i + (variable == 0), j + (variable == 1)), f.at(i, j)), s = c > 0 ? 1 : c < 0 ? -1 : 0;
      if (s == 0 || (sign != 0 && s != sign)) return 0;
      sign = s;
    }
  return sign;
}

/// Whether a Bernstein form has no zero on its closed square: its cells' coefficients get strict signs after some cuts.
inline bool has_no_zero(Table f, int depth)
{
  if (strict_sign(f.c) != 0) return true;
  for (const Integer* corner : {&f.at(0, f.degree[1]), &f.at(f.degree[0], 0), &f.c.back()}) // values: other signs mean zeros
    if (depth == 0 || sgn(f.c[0]) == 0 || sgn(*corner) != sgn(f.c[0])) return false;
  const int v = f.degree[0] == 0 || (depth % 2 == 0 && f.degree[1] > 0) ? 1 : 0;
  Table high = cut(f, v, 1, 2);
  return has_no_zero(std::move(f), depth - 1) && has_no_zero(std::move(high), depth - 1);
}

} // namespace check
} // namespace locus

#endif
