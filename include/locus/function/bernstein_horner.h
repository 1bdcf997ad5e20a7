// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BERNSTEIN_HORNER_H
#define LOCUS_FUNCTION_BERNSTEIN_HORNER_H

#include <locus/function/binomial.h>
#include <locus/number/bounded.h>

#include <vector>

namespace locus {

namespace detail {

/// Σ c_i·B_i^n(u) for 0 ≤ u ≤ 1 in O(n), without storage, where `coefficient(i)` gives c_i: Horner's rule in u/(1-u), or
/// from the other end in (1-u)/u, so that the ratio stays below one.
template <class Coefficient>
double horner_sum(Coefficient coefficient, int n, double u)
{
  const bool low = u <= 0.5;
  const double near = low ? 1 - u : u, ratio = (low ? u : 1 - u) / near;
  const double* const row = n <= last_exact_binomial_row ? binomial_table[static_cast<std::size_t>(n)].data() : nullptr;
  const auto weight = [&](int i) { return row ? row[i] : binomial<double>(n, i); };
  double sum = coefficient(low ? n : 0), power = 1; // the outermost weight is 1
  for (int i = n - 1; i >= 0; --i) {
    sum = sum * ratio + weight(i) * coefficient(low ? i : n - i);
    power *= near;
  }
  return sum * power;
}

/// `stride` steps through `c`.
inline double horner_value(const double* c, int n, double u, std::size_t stride = 1)
{
  return horner_sum([c, stride](int i) { return c[static_cast<std::size_t>(i) * stride]; }, n, u);
}

/// Derivative of the same polynomial.
inline double horner_slope(const double* c, int n, double u)
{
  return n == 0 ? 0.0 : n * horner_sum([c](int i) { return c[i + 1] - c[i]; }, n - 1, u);
}

/// Fills `weight` with the Bernstein basis of degree n at u in [0,1].
inline void bernstein_weights(int n, double u, double* weight)
{
  const double* const row = n <= last_exact_binomial_row ? binomial_table[static_cast<std::size_t>(n)].data() : nullptr;
  double power = 1;
  for (int i = 0; i <= n; ++i, power *= u) weight[i] = (row ? row[i] : binomial<double>(n, i)) * power;
  power = 1;
  for (int i = n; i >= 0; --i, power *= 1 - u) weight[i] *= power;
}

/// Value of a tensor product of degrees n, m at (u, v) in the unit square; at most 6(n+m)+8 roundings a term.
inline double tensor_value(const double* c, int n, int m, double u, double v)
{
  constexpr int small = 64;
  double stack[2 * small];
  std::vector<double> heap;
  double* weights = stack;
  if (n >= small || m >= small) {
    heap.resize(static_cast<std::size_t>(n + m) + 2);
    weights = heap.data();
  }
  double* const row = weights;
  double* const column = weights + n + 1;
  bernstein_weights(n, u, row);
  bernstein_weights(m, v, column);
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    double inner = 0;
    for (int j = 0; j <= m; ++j) inner += *c++ * column[j];
    sum += row[i] * inner;
  }
  return sum;
}

/// Rounding operations that `horner_value` can accumulate, relative to the greatest coefficient: every term is a mean
/// weight times a coefficient, touched by at most this many roundings (binomials from row 57 on are rounded too).
constexpr double horner_operations(int n) { return 5.0 * n + 8; }

} // namespace detail

} // namespace locus

#endif
