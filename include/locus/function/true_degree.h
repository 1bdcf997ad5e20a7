// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_TRUE_DEGREE_H
#define LOCUS_FUNCTION_TRUE_DEGREE_H

#include <locus/function/bernstein_operations.h>

#include <algorithm>
#include <optional>

namespace locus {

/// The same polynomial with its degree in one variable lowered by one; nothing where that degree is needed (T exact).
/// From c[i] = ((n-i)·b[i] + i·b[i-1])/n upwards; the last coefficient tells. O(number of coefficients).
template <class T, int D>
std::optional<Bernstein<T, D>> lowered_by_one(const Bernstein<T, D>& f, int variable)
{
  const int n = f.degree(variable);
  if (n == 0) return std::nullopt;
  Degrees<D> degrees = f.degrees();
  --degrees[static_cast<std::size_t>(variable)];
  Bernstein<T, D> g(degrees);
  const Layout from = layout_along(f.degrees(), variable), to = layout_along(degrees, variable);
  for (std::size_t o = 0; o < from.outer; ++o)
    for (std::size_t k = 0; k < from.inner; ++k) {
      const T* c = f.data() + o * from.count * from.inner + k;
      T* b = g.data() + o * to.count * to.inner + k;
      for (int i = 0; i < n; ++i) {
        T value = T(n) * c[static_cast<std::size_t>(i) * from.inner];
        if (i > 0) value -= T(i) * b[static_cast<std::size_t>(i - 1) * to.inner];
        value /= T(n - i);
        b[static_cast<std::size_t>(i) * to.inner] = value;
      }
      if (b[static_cast<std::size_t>(n - 1) * to.inner] != c[static_cast<std::size_t>(n) * from.inner]) return std::nullopt;
    }
  return g;
}

/// The same polynomial at its least degree in each variable (T exact); zero has degree zero.
template <class T, int D>
Bernstein<T, D> at_true_degree(Bernstein<T, D> f)
{
  const auto& c = f.coefficients();
  if (std::all_of(c.begin(), c.end(), [](const T& x) { return x == T(0); })) return Bernstein<T, D>(Degrees<D>{});
  for (int k = 0; k < D; ++k)
    while (auto g = lowered_by_one(f, k)) f = std::move(*g);
  return f;
}

} // namespace locus

#endif
