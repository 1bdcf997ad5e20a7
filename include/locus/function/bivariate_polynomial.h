// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BIVARIATE_POLYNOMIAL_H
#define LOCUS_FUNCTION_BIVARIATE_POLYNOMIAL_H

#include <locus/function/integer_polynomial.h>

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

} // namespace locus

#endif
