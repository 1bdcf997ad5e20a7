// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_SQUARE_FREE_H
#define LOCUS_FUNCTION_SQUARE_FREE_H

#include <locus/function/bivariate_polynomial.h>
#include <locus/number/interval.h>

#include <stdexcept>

#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_mpoly_factor.h>

namespace locus {

/// A factor of a polynomial in two variables, of which the polynomial has that power.
struct Repeated_factor {
  Bivariate_polynomial f;
  int multiplicity = 1;
};

namespace detail {

/// FLINT's polynomials in two variables, with their life time.
class Flint_ring {
public:
  Flint_ring() { fmpz_mpoly_ctx_init(context, 2, ORD_LEX); }
  Flint_ring(const Flint_ring&) = delete;
  Flint_ring& operator=(const Flint_ring&) = delete;
  ~Flint_ring() { fmpz_mpoly_ctx_clear(context); }

  fmpz_mpoly_ctx_t context;
};

inline Bivariate_polynomial from_flint(const fmpz_mpoly_t f, const Flint_ring& ring)
{
  Bivariate_polynomial g;
  Integer c;
  for (slong k = 0; k < fmpz_mpoly_length(f, ring.context); ++k) {
    std::array<ulong, 2> power{};
    fmpz_t value;
    fmpz_init(value);
    fmpz_mpoly_get_term_coeff_fmpz(value, f, k, ring.context);
    fmpz_mpoly_get_term_exp_ui(power.data(), f, k, ring.context);
    fmpz_get_mpz(c.get_mpz_t(), value);
    fmpz_clear(value);
    if (g.row.size() <= power[1]) g.row.resize(power[1] + 1);
    if (g.row[power[1]].size() <= power[0]) g.row[power[1]].resize(power[0] + 1);
    g.row[power[1]][power[0]] = c;
  }
  g.trim();
  return g;
}

inline std::vector<Repeated_factor> square_free_by_flint(const Bivariate_polynomial& f)
{
  const Flint_ring ring;
  fmpz_mpoly_t polynomial;
  fmpz_mpoly_init(polynomial, ring.context);
  for (std::size_t j = 0; j < f.row.size(); ++j)
    for (std::size_t i = 0; i < f.row[j].size(); ++i) {
      fmpz_t c;
      fmpz_init(c);
      fmpz_set_mpz(c, f.row[j][i].get_mpz_t());
      const std::array<ulong, 2> power{i, j};
      fmpz_mpoly_set_coeff_fmpz_ui(polynomial, c, power.data(), ring.context);
      fmpz_clear(c);
    }
  fmpz_mpoly_factor_t found;
  fmpz_mpoly_factor_init(found, ring.context);
  std::vector<Repeated_factor> factors;
  if (fmpz_mpoly_factor_squarefree(found, polynomial, ring.context))
    for (slong k = 0; k < found->num; ++k)
      factors.push_back({from_flint(found->poly + k, ring), static_cast<int>(fmpz_get_si(found->exp + k))});
  fmpz_mpoly_factor_clear(found, ring.context);
  fmpz_mpoly_clear(polynomial, ring.context);
  return factors;
}

} // namespace detail

/// Square-free factors without common zeros along a curve, with their powers: their product is f up to a constant, which is
/// checked. Factors that are constant are left out. By FLINT.
inline std::vector<Repeated_factor> square_free_factors(const Bivariate_polynomial& f)
{
  if (f.is_zero()) return {};
  auto factors = with_nearest_rounding([&] { return detail::square_free_by_flint(f); });
  Bivariate_polynomial product{{{Integer(1)}}};
  for (const Repeated_factor& factor : factors)
    for (int k = 0; k < factor.multiplicity; ++k) product = multiply(product, factor.f);
  if (!are_proportional(product, f)) throw std::logic_error("locus: square-free factors whose product is another polynomial");
  factors.erase(std::remove_if(factors.begin(), factors.end(),
                               [](const Repeated_factor& x) { return x.f.degree_x() < 1 && x.f.degree_y() < 1; }),
                factors.end());
  return factors;
}

} // namespace locus

#endif
