// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_SCALED_BASIS_H
#define LOCUS_FUNCTION_SCALED_BASIS_H

#include <locus/function/complex_polynomial.h>
#include <locus/function/scaled_integer_bernstein.h>

namespace locus {

// Exact bivariate polynomials in the scaled basis t^i (1-t)^(n-i) r^j (1-r)^(m-j), where products, division by t - r and
// changes to powers need additions of integers only.

namespace detail {

/// Integer coefficients in the scaled basis, without the scale of f.
inline Bernstein<Integer, 2> to_scaled_basis(const Bernstein<Scaled_integer, 2>& f)
{
  return scaled_by_binomials(f.values(), false);
}

/// From integer coefficients in the scaled basis, times `scale`.
inline Bernstein<Scaled_integer, 2> from_scaled_basis(Bernstein<Integer, 2> f, Rational scale)
{
  for (int variable = 0; variable < 2; ++variable) {
    const Layout layout = layout_along(f.degrees(), variable);
    std::vector<Integer> factor(layout.count, Integer(1));
    unscale(factor);
    scale /= factor[0];
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t k = 0; k < layout.count; ++k)
        for (std::size_t i = 0; i < layout.inner; ++i) f[(o * layout.count + k) * layout.inner + i] *= factor[k];
  }
  const Integer common = gcd_of(f);
  if (common > 1) {
    scale *= common;
    for (std::size_t k = 0; k < f.size(); ++k) mpz_divexact(f[k].get_mpz_t(), f[k].get_mpz_t(), common.get_mpz_t());
  }
  return {std::move(f), std::move(scale)};
}

/// Reverses the order of the coefficients in one variable: x becomes 1 - x in the scaled and the Bernstein basis.
template <class T>
Bernstein<T, 2> reversed_along(const Bernstein<T, 2>& f, int variable)
{
  Bernstein<T, 2> g(f.degrees());
  const int n = f.degree(0), m = f.degree(1);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) g.at({i, j}) = variable == 0 ? f.at({n - i, j}) : f.at({i, m - j});
  return g;
}

/// Scaled basis to powers along one variable (`to_powers`), or back: a Taylor shift by additions, O(n²) a row.
inline void shift_basis(Bernstein<Integer, 2>& f, int variable, bool to_powers)
{
  const Layout layout = layout_along(f.degrees(), variable);
  const std::size_t n = layout.count - 1;
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t i = 0; i < layout.inner; ++i) {
      Integer* const c = f.data() + o * layout.count * layout.inner + i;
      if (to_powers) {
        for (std::size_t pass = 0; pass < n; ++pass)
          for (std::size_t k = 1; k <= n - pass; ++k) c[k * layout.inner] -= c[(k - 1) * layout.inner];
      } else {
        for (std::size_t pass = n; pass-- > 0;)
          for (std::size_t k = n - pass; k >= 1; --k) c[k * layout.inner] += c[(k - 1) * layout.inner];
      }
    }
}

} // namespace detail

} // namespace locus

#endif
