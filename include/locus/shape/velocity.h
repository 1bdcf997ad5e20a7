// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_VELOCITY_H
#define LOCUS_SHAPE_VELOCITY_H

#include <locus/function/bernstein_operations.h>
#include <locus/number/rational.h>

namespace locus {
namespace detail {

/// D1 = p'w - pw' of a rational curve at its true degree 2d-2: with p = Σ b_i B_i and the shifted and the truncated
/// control points P⁺ = (b_1…b_d), P⁻ = (b_0…b_{d-1}) in degree d-1, Euler's relation gives D1 = d·(P⁺W⁻ - P⁻W⁺).
template <class T>
Bernstein<T, 1> velocity_numerator(const Bernstein<T, 1>& p, const Bernstein<T, 1>& w)
{
  if (w.degree() == 0) return multiply(derivative(p), T(w[0]));
  const auto part = [](const Bernstein<T, 1>& f, std::size_t first) {
    const auto n = static_cast<std::size_t>(f.degree());
    const auto begin = f.coefficients().begin() + static_cast<std::ptrdiff_t>(first);
    return Bernstein<T, 1>(Degrees<1>{f.degree() - 1}, {begin, begin + static_cast<std::ptrdiff_t>(n)});
  };
  return multiply(subtract(multiply(part(p, 1), part(w, 0)), multiply(part(p, 0), part(w, 1))), T(w.degree()));
}

} // namespace detail
} // namespace locus

#endif
