// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_RATIONAL_ROOT_H
#define LOCUS_FUNCTION_RATIONAL_ROOT_H

#include <locus/function/descartes.h>

#include <optional>

namespace locus {

/// The value of a root of an exact polynomial on the unit interval, as `exact_roots` gives it there, if it is rational.
/// A denominator divides the leading coefficient: the root is refined until one multiple of its inverse is left, and that
/// one is tried. As many bisections as the leading coefficient has bits.
inline std::optional<Rational> rational_value(Isolated_root<Rational> root)
{
  if (root.is_exact()) return root.lo;
  const Integer_polynomial f = monomial_form(*root.factor);
  if (degree(f) == 1) {
    Rational value(Integer(-f[0]), f[1]);
    value.canonicalize();
    return value;
  }
  const Integer leading = abs(f.back());
  while (!root.is_exact() && Rational((root.hi - root.lo) * leading) >= 1)
    detail::bisect_exactly(*root.factor, Rational(0), Rational(1), root);
  if (root.is_exact()) return root.lo;
  // The only multiple of 1/leading in the open interval (lo, hi), if any.
  const Rational scaled = root.lo * leading;
  Integer multiple;
  mpz_fdiv_q(multiple.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  Rational candidate(Integer(multiple + 1), leading);
  candidate.canonicalize();
  if (candidate < root.hi && sign_at(*root.factor, candidate) == Sign::zero) return candidate;
  return std::nullopt;
}

/// A number within 2^-40 of a root on the unit interval.
inline Rational near_value(Isolated_root<Rational> root)
{
  const Rational fine(Integer(1), Integer(Integer(1) << 40));
  while (!root.is_exact() && Rational(root.hi - root.lo) > fine)
    detail::bisect_exactly(*root.factor, Rational(0), Rational(1), root);
  return Rational((root.lo + root.hi) / 2);
}

} // namespace locus

#endif
