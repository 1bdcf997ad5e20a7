// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_PIVOT_SETS_H
#define LOCUS_ZERO_SET_PIVOT_SETS_H

#include <array>
#include <cstddef>
#include <string>

namespace locus {

/// K of the variables, in ascending order: those that a graph gives as functions of the others.
template <int K>
using Pivot_set = std::array<int, static_cast<std::size_t>(K)>;

/// The variables of 0, …, D-1 that are no pivots, in ascending order.
template <int D, std::size_t K>
constexpr std::array<int, static_cast<std::size_t>(D) - K> base_variables(const std::array<int, K>& pivots)
{
  std::array<int, static_cast<std::size_t>(D) - K> base{};
  std::size_t next_pivot = 0, n = 0;
  for (int v = 0; v < D; ++v) {
    if (next_pivot < K && pivots[next_pivot] == v) ++next_pivot;
    else base[n++] = v;
  }
  return base;
}

/// A set of pivots as bits, and in words for people.
template <std::size_t K>
constexpr int bits_of(const std::array<int, K>& pivots)
{
  int bits = 0;
  for (const int v : pivots) bits |= 1 << v;
  return bits;
}
template <std::size_t K>
std::string name_of(const std::array<int, K>& pivots)
{
  std::string text;
  for (const int v : pivots) text += (text.empty() ? "x" : " x") + std::to_string(v);
  return text;
}

namespace detail {

constexpr std::size_t choose_number(int n, int k)
{
  std::size_t c = 1;
  for (int i = 1; i <= k; ++i) c = c * static_cast<std::size_t>(n - k + i) / static_cast<std::size_t>(i);
  return c;
}

/// All sets of K out of D variables.
template <int K, int D>
constexpr std::array<Pivot_set<K>, choose_number(D, K)> all_pivot_sets()
{
  std::array<Pivot_set<K>, choose_number(D, K)> sets{};
  Pivot_set<K> current{};
  for (int k = 0; k < K; ++k) current[static_cast<std::size_t>(k)] = k;
  for (auto& set : sets) {
    set = current;
    int k = K - 1;
    while (k > 0 && current[static_cast<std::size_t>(k)] == D - K + k) --k;
    int next = ++current[static_cast<std::size_t>(k)];
    for (int l = k + 1; l < K; ++l) current[static_cast<std::size_t>(l)] = ++next;
  }
  return sets;
}

/// Determinant by expansion along the first row: for small matrices of doubles or intervals.
template <class T, std::size_t N>
T determinant(const std::array<std::array<T, N>, N>& a)
{
  if constexpr (N == 1) {
    return a[0][0];
  } else {
    T sum(0);
    for (std::size_t c = 0; c < N; ++c) {
      std::array<std::array<T, N - 1>, N - 1> minor{};
      for (std::size_t i = 1; i < N; ++i)
        for (std::size_t j = 0, k = 0; j < N; ++j)
          if (j != c) minor[i - 1][k++] = a[i][j];
      const T term = a[0][c] * determinant(minor);
      sum = c % 2 == 0 ? sum + term : sum - term;
    }
    return sum;
  }
}

} // namespace detail
} // namespace locus

#endif
