// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_RATIONAL_ROOT_H
#define LOCUS_FUNCTION_RATIONAL_ROOT_H

#include <locus/function/descartes.h>

#include <optional>
#include <vector>

namespace locus {

namespace detail {

/// False only if a polynomial certainly has no rational root: it has none modulo a prime that does not divide its leading
/// coefficient, as a denominator would.
inline bool may_have_rational_root(const Integer_polynomial& f)
{
  for (const unsigned long p : {3ul, 5ul, 7ul, 11ul, 13ul, 17ul, 19ul, 23ul, 29ul, 31ul, 37ul, 41ul, 43ul}) {
    std::vector<unsigned long> residues;
    for (const Integer& c : f) residues.push_back(mpz_fdiv_ui(c.get_mpz_t(), p));
    bool found = residues.back() == 0;
    for (unsigned long x = 0; x < p && !found; ++x) {
      unsigned long value = 0;
      for (std::size_t i = residues.size(); i-- > 0;) value = (value * x + residues[i]) % p;
      found = value == 0;
    }
    if (!found) return false;
  }
  return true;
}

} // namespace detail

/// The value of a root of an exact polynomial on the unit interval, as `exact_roots` gives it there, if it is rational.
/// A denominator divides the leading coefficient: the root is refined until one multiple of its inverse is left, and that
/// one is tried. As many bisections as the leading coefficient has bits, unless small primes tell at once.
inline std::optional<Rational> rational_value(Isolated_root<Rational> root)
{
  if (root.is_exact()) return root.lo;
  const Integer_polynomial f = monomial_form(*root.factor);
  if (degree(f) == 1) {
    Rational value(Integer(-f[0]), f[1]);
    value.canonicalize();
    return value;
  }
  if (!detail::may_have_rational_root(f)) return std::nullopt;
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
