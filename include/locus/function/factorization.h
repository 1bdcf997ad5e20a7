// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_FACTORIZATION_H
#define LOCUS_FUNCTION_FACTORIZATION_H

#include <locus/function/integer_polynomial.h>
#include <locus/number/interval.h>

#include <vector>

#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>

namespace locus {
namespace detail {

/// FLINT's polynomial with its life time.
class Flint_polynomial {
public:
  explicit Flint_polynomial(const Integer_polynomial& f)
  {
    fmpz_poly_init2(value, static_cast<slong>(f.size()));
    for (std::size_t i = 0; i < f.size(); ++i) fmpz_poly_set_coeff_mpz(value, static_cast<slong>(i), f[i].get_mpz_t());
  }
  Flint_polynomial(const Flint_polynomial&) = delete;
  Flint_polynomial& operator=(const Flint_polynomial&) = delete;
  ~Flint_polynomial() { fmpz_poly_clear(value); }

  fmpz_poly_t value;
};

inline Integer_polynomial from_flint(const fmpz_poly_t f)
{
  Integer_polynomial g(static_cast<std::size_t>(fmpz_poly_length(f)));
  for (std::size_t i = 0; i < g.size(); ++i) fmpz_poly_get_coeff_mpz(g[i].get_mpz_t(), f, static_cast<slong>(i));
  return g;
}

} // namespace detail

/// The different irreducible factors over the integers, primitive, in no particular order; none of a constant. By FLINT; what
/// is built on it is proved without it.
inline std::vector<Integer_polynomial> irreducible_factors(const Integer_polynomial& f)
{
  std::vector<Integer_polynomial> factors;
  if (degree(f) < 1) return factors;
  if (degree(f) == 1) return {detail::primitive_part(f)};
  with_nearest_rounding([&] { // FLINT reduces lattices in doubles, and leaves the rounding mode changed
    const detail::Flint_polynomial polynomial(f);
    fmpz_poly_factor_t found;
    fmpz_poly_factor_init(found);
    fmpz_poly_factor(found, polynomial.value);
    for (slong k = 0; k < found->num; ++k) factors.push_back(detail::primitive_part(detail::from_flint(found->p + k)));
    fmpz_poly_factor_clear(found);
  });
  return factors;
}

} // namespace locus

#endif
