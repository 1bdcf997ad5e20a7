// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_LEAST_ROOT_SIGN_H
#define LOCUS_ZERO_SET_LEAST_ROOT_SIGN_H

#include <locus/zero_set/least_sign.h>

namespace locus {

namespace detail {

/// The sign of q at a root in the unit interval of another polynomial, exactly.
inline Sign sign_at_root(const Bernstein<Rational, 1>& q, Isolated_root<Rational> root)
{
  if (root.is_exact()) return sign_of(evaluate_at(q, root.lo));
  const Integer_polynomial form = monomial_form(Bernstein<Scaled_integer, 1>(q));
  if (has_root_within(gcd(monomial_form(*root.factor), form), root.lo, root.hi)) return Sign::zero;
  while (!root.is_exact() && has_root_within(form, root.lo, root.hi)) bisect_exactly(*root.factor, Rational(0), Rational(1), root);
  return sign_of(evaluate_at(q, root.lo));
}

} // namespace detail

/// The sign of the least value of √s·p + q on the closed unit interval, exactly, for s > 0 and p that is nowhere negative there:
/// zero where it is nowhere negative and vanishes somewhere. It is negative exactly where s·p² - q² and q both are.
inline Sign least_root_sign(const Rational& s, const Bernstein<Rational, 1>& p, const Bernstein<Rational, 1>& q)
{
  const Bernstein<Scaled_integer, 1> f(subtract(multiply(multiply(p, p), s), multiply(q, q)));
  if (f.is_zero()) return least_sign(q) == Sign::positive ? Sign::positive : Sign::zero; // the sum is 0 or 2q
  const auto set = exact_roots(f, Rational(0), Rational(1));
  const std::size_t n = set.roots.size();
  for (std::size_t i = 0; i < set.gaps.size(); ++i) {
    const bool outside = (i == 0 && n > 0 && set.roots.front().hi == 0) || (i > 0 && i == n && set.roots.back().lo == 1);
    if (outside || set.gaps[i] != Sign::negative) continue;
    const Rational lo = i == 0 ? Rational(0) : set.roots[i - 1].hi, hi = i == n ? Rational(1) : set.roots[i].lo;
    if (evaluate_at(q, Rational((lo + hi) / 2)) < 0) return Sign::negative;
  }
  for (const auto& root : set.roots)
    if (detail::sign_at_root(q, root) != Sign::positive) return Sign::zero;
  return Sign::positive;
}

} // namespace locus

#endif
