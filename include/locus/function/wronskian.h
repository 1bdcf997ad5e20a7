// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_WRONSKIAN_H
#define LOCUS_FUNCTION_WRONSKIAN_H

#include <locus/function/polynomial_vector.h>

namespace locus {

namespace detail {

/// The determinant of the rows from `row` on in the columns that are listed, by its first row.
template <std::size_t N>
Bernstein<Rational, 1> minor_of(const std::vector<Polynomial_vector<1, N>>& rows, std::size_t row,
                                const std::vector<std::size_t>& columns)
{
  if (columns.size() == 1) return at_true_degree(rows[row][columns[0]]);
  Bernstein<Rational, 1> sum(Degrees<1>{0});
  for (std::size_t k = 0; k < columns.size(); ++k) {
    std::vector<std::size_t> others = columns;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const Bernstein<Rational, 1> term = multiply(rows[row][columns[k]], minor_of(rows, row + 1, others));
    sum = k % 2 == 0 ? add(sum, term) : subtract(sum, term);
  }
  return at_true_degree(sum);
}

/// The functions and their derivatives up to the given order, in rows.
template <std::size_t N>
std::vector<Polynomial_vector<1, N>> derivative_rows(const Polynomial_vector<1, N>& f, std::size_t order)
{
  std::vector<Polynomial_vector<1, N>> rows{f};
  while (rows.size() <= order) rows.push_back(derivative(rows.back()));
  return rows;
}

} // namespace detail

/// The minors of the Wronskian matrix of N functions without its last row, with alternating signs: the vector, unique up to
/// a factor, that is orthogonal to f, f', …, f⁽ᴺ⁻²⁾. Its product with f⁽ᴺ⁻¹⁾ is (-1)^(N-1) times the Wronskian. Of N
/// polynomials of degree d its degree is at most (N-1)(d-N+2): formal leading terms cancel.
template <std::size_t N>
Polynomial_vector<1, N> wronskian_minors(const Polynomial_vector<1, N>& f)
{
  const auto rows = detail::derivative_rows(f, N - 2);
  return detail::vector_of<N>([&](std::size_t k) {
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < N; ++j)
      if (j != k) columns.push_back(j);
    const Bernstein<Rational, 1> minor = detail::minor_of(rows, 0, columns);
    return k % 2 == 0 ? minor : multiply(minor, Rational(-1));
  });
}

/// The Wronskian of N functions, det(f, f', …, f⁽ᴺ⁻¹⁾). It vanishes identically where they are linearly dependent. Of N
/// polynomials of degree d its degree is at most N(d-N+1).
template <std::size_t N>
Bernstein<Rational, 1> wronskian(const Polynomial_vector<1, N>& f)
{
  const auto rows = detail::derivative_rows(f, N - 1);
  std::vector<std::size_t> columns(N);
  for (std::size_t j = 0; j < N; ++j) columns[j] = j;
  return detail::minor_of(rows, 0, columns);
}

} // namespace locus

#endif
