// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BIVARIATE_POLYNOMIAL_H
#define LOCUS_FUNCTION_BIVARIATE_POLYNOMIAL_H

#include <locus/function/integer_polynomial.h>
#include <locus/function/scaled_basis.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace locus {

/// Σ_j row[j](x)·y^j with integer coefficients: `row[j]` is a polynomial in x, the last one is not zero; no rows for zero.
struct Bivariate_polynomial {
  std::vector<Integer_polynomial> row;

  bool is_zero() const { return row.empty(); }
  int degree_y() const { return static_cast<int>(row.size()) - 1; }
  int degree_x() const
  {
    int n = -1;
    for (const Integer_polynomial& r : row) n = std::max(n, degree(r));
    return n;
  }

  void trim()
  {
    for (Integer_polynomial& r : row) detail::trim(r);
    while (!row.empty() && row.back().empty()) row.pop_back();
  }

  /// The same polynomial with x and y changing places.
  Bivariate_polynomial swapped() const
  {
    Bivariate_polynomial s;
    s.row.resize(static_cast<std::size_t>(std::max(0, degree_x() + 1)), Integer_polynomial(row.size()));
    for (std::size_t j = 0; j < row.size(); ++j)
      for (std::size_t i = 0; i < row[j].size(); ++i) s.row[i][j] = row[j][i];
    s.trim();
    return s;
  }
};

/// Powers instead of Bernstein polynomials on the unit cell, up to a positive factor; x is variable 0.
inline Bivariate_polynomial bivariate_form(const Bernstein<Scaled_integer, 2>& f)
{
  const auto n = static_cast<std::size_t>(f.degree(0)) + 1, m = static_cast<std::size_t>(f.degree(1)) + 1;
  std::vector<Integer_polynomial> along_y(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Integer* c = f.values().data() + i * m;
    along_y[i] = to_monomial(Bernstein<Integer, 1>(Degrees<1>{f.degree(1)}, std::vector<Integer>(c, c + m)));
  }
  Bivariate_polynomial result;
  Integer common = 0;
  for (std::size_t j = 0; j < m; ++j) {
    std::vector<Integer> column;
    for (std::size_t i = 0; i < n; ++i) column.push_back(along_y[i][j]);
    result.row.push_back(to_monomial(Bernstein<Integer, 1>(Degrees<1>{f.degree(0)}, std::move(column))));
    common = gcd(common, detail::content(result.row.back()));
  }
  if (common > 1)
    for (Integer_polynomial& r : result.row)
      for (Integer& c : r) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), common.get_mpz_t());
  result.trim();
  return result;
}

/// ∂f/∂x.
inline Bivariate_polynomial derivative_x(const Bivariate_polynomial& f)
{
  Bivariate_polynomial d;
  for (const Integer_polynomial& r : f.row) d.row.push_back(derivative(r));
  d.trim();
  return d;
}

/// ∂f/∂y.
inline Bivariate_polynomial derivative_y(const Bivariate_polynomial& f)
{
  Bivariate_polynomial d;
  for (std::size_t j = 1; j < f.row.size(); ++j) {
    d.row.push_back(f.row[j]);
    for (Integer& c : d.row.back()) c *= static_cast<unsigned long>(j);
  }
  d.trim();
  return d;
}

inline Bivariate_polynomial multiply(const Bivariate_polynomial& f, const Bivariate_polynomial& g)
{
  Bivariate_polynomial h;
  if (f.is_zero() || g.is_zero()) return h;
  h.row.resize(f.row.size() + g.row.size() - 1);
  for (std::size_t j = 0; j < f.row.size(); ++j)
    for (std::size_t l = 0; l < g.row.size(); ++l) {
      Integer_polynomial& row = h.row[j + l];
      const Integer_polynomial &a = f.row[j], &b = g.row[l];
      if (a.empty() || b.empty()) continue;
      if (row.size() < a.size() + b.size() - 1) row.resize(a.size() + b.size() - 1);
      for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < b.size(); ++k) row[i + k] += a[i] * b[k];
    }
  h.trim();
  return h;
}

/// Equal up to a factor that is a number. Neither is zero.
inline bool are_proportional(const Bivariate_polynomial& f, const Bivariate_polynomial& g)
{
  if (f.row.size() != g.row.size()) return false;
  const Integer &a = f.row.back().back(), &b = g.row.back().back();
  for (std::size_t j = 0; j < f.row.size(); ++j) {
    if (f.row[j].size() != g.row[j].size()) return false;
    for (std::size_t i = 0; i < f.row[j].size(); ++i)
      if (f.row[j][i] * b != g.row[j][i] * a) return false;
  }
  return true;
}

/// On the unit cell.
inline Bernstein<Scaled_integer, 2> bernstein_form(const Bivariate_polynomial& f)
{
  Bernstein<Integer, 2> g(Degrees<2>{std::max(0, f.degree_x()), std::max(0, f.degree_y())});
  for (std::size_t j = 0; j < f.row.size(); ++j)
    for (std::size_t i = 0; i < f.row[j].size(); ++i) g.at({static_cast<int>(i), static_cast<int>(j)}) = f.row[j][i];
  for (int v = 0; v < 2; ++v) detail::shift_basis(g, v, false);
  return Scaled_form(std::move(g), Rational(1)).bernstein();
}

} // namespace locus

#endif
