// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SYSTEM_JACOBIAN_H
#define LOCUS_ZERO_SET_SYSTEM_JACOBIAN_H

#include <locus/zero_set/system.h>

namespace locus {
namespace detail {

/// Range of a partial derivative's coefficients for a form on a box of that width.
template <int D>
Interval slope_over(const Bernstein<Interval, D>& f, int variable, double width)
{
  const Layout layout = layout_along(f.degrees(), variable);
  if (layout.count == 1) return Interval(0);
  const std::size_t block = layout.count * layout.inner;
  Interval range = f[layout.inner] - f[0];
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t k = 0; k + layout.inner < block; ++k)
      range = hull(range, f[o * block + k + layout.inner] - f[o * block + k]);
  return range * Interval(f.degree(variable)) / Interval(width);
}

template <int K, int D>
using System_jacobian = std::array<std::array<Interval, static_cast<std::size_t>(D)>, static_cast<std::size_t>(K)>;

/// Enclosure of the Jacobian of K equations over a box of positive width in every variable. Needs upward rounding.
template <int K, int D>
System_jacobian<K, D> jacobian_over(const System<K, D>& system, const Box<D>& box)
{
  System_jacobian<K, D> j;
  for (std::size_t k = 0; k < static_cast<std::size_t>(K); ++k) {
    const Bernstein<Interval, D> f = system.equations[k]->enclosure(box);
    for (int v = 0; v < D; ++v) j[k][static_cast<std::size_t>(v)] = slope_over(f, v, box.width(v));
  }
  return j;
}

} // namespace detail
} // namespace locus

#endif
