// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_SCALED_BASIS_H
#define LOCUS_FUNCTION_SCALED_BASIS_H

#include <locus/function/complex_polynomial.h>
#include <locus/function/scaled_integer_bernstein.h>

#include <algorithm>

namespace locus {

/// An exact bivariate polynomial scale·Σ c_ij t^i (1-t)^(n-i) r^j (1-r)^(m-j) with integer c_ij. In this basis products,
/// division by t - r and the change to powers need additions of integers only.
struct Scaled_form {
  Bernstein<Integer, 2> c;
  Rational scale = 1;

  Scaled_form() = default;
  Scaled_form(Bernstein<Integer, 2> coefficients, Rational s) : c(std::move(coefficients)), scale(std::move(s)) {}
  explicit Scaled_form(const Bernstein<Scaled_integer, 2>& f) : c(scaled_by_binomials(f.values(), false)), scale(f.scale()) {}

  int degree(int variable) const { return c.degree(variable); }

  bool is_zero() const
  {
    return std::all_of(c.coefficients().begin(), c.coefficients().end(), [](const Integer& x) { return x == 0; });
  }

  /// Replaces a variable x by 1 - x.
  void reverse(int variable)
  {
    const Layout layout = layout_along(c.degrees(), variable);
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t k = 0; 2 * k + 1 < layout.count; ++k)
        for (std::size_t i = 0; i < layout.inner; ++i)
          std::swap(c[(o * layout.count + k) * layout.inner + i], c[(o * layout.count + layout.count - 1 - k) * layout.inner + i]);
  }

  Bernstein<Scaled_integer, 2> bernstein() &&
  {
    for (int variable = 0; variable < 2; ++variable) {
      const Layout layout = layout_along(c.degrees(), variable);
      std::vector<Integer> factor(layout.count, Integer(1));
      detail::unscale(factor);
      scale /= factor[0];
      for (std::size_t o = 0; o < layout.outer; ++o)
        for (std::size_t k = 0; k < layout.count; ++k)
          for (std::size_t i = 0; i < layout.inner; ++i) c[(o * layout.count + k) * layout.inner + i] *= factor[k];
    }
    return {std::move(c), std::move(scale)};
  }
  Bernstein<Scaled_integer, 2> bernstein() const& { return Scaled_form(*this).bernstein(); }
};

namespace detail {

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
