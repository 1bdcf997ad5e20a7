// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_LEAST_SIGN_H
#define LOCUS_ZERO_SET_LEAST_SIGN_H

#include <locus/function/descartes.h>

namespace locus {

namespace detail {

/// Looks for the sign of a polynomial's minimum by halving the unit interval, in doubles with an error bound.
class Least_sign_filter {
public:
  explicit Least_sign_filter(const Bernstein<Bounded, 1>& f)
    : form_(f.values().data(), f.degree(), f.error()), last_(static_cast<std::size_t>(f.degree()))
  {
  }

  Sign run() { return descend(0, 0); }

private:
  static constexpr int max_depth = 30, max_cuts = 100;

  /// Negative as soon as a value is; unknown where a part stays so.
  Sign descend(std::size_t slot, int depth)
  {
    if (is_negative(slot, 0) || is_negative(slot, last_)) return Sign::negative;
    const bool is_positive = all_of(slot, Sign::positive);
    if (is_positive || all_of(slot, Sign::unknown)) return is_positive ? Sign::positive : Sign::unknown;
    if (depth == max_depth || ++cuts_ > max_cuts) return Sign::unknown;
    const std::size_t parts = 2 * static_cast<std::size_t>(depth) + 1;
    form_.split(slot, parts, 8);
    const Sign low = descend(parts, depth + 1);
    if (low == Sign::negative) return low;
    const Sign high = descend(parts + 1, depth + 1);
    return high == Sign::negative || low == Sign::positive ? high : low;
  }

  bool is_negative(std::size_t slot, std::size_t i) const { return form_.sign(slot, i) == Sign::negative; }

  bool all_of(std::size_t slot, Sign sign) const
  {
    for (std::size_t i = 0; i <= last_; ++i)
      if (form_.sign(slot, i) != sign) return false;
    return true;
  }

  Bounded_coefficients form_;
  std::size_t last_;
  int cuts_ = 0;
};

/// From the roots, their multiplicities and the signs between them.
inline Sign exact_least_sign(const Bernstein<Scaled_integer, 1>& f)
{
  const auto set = exact_roots(f, Rational(0), Rational(1));
  if (set.identically_zero) return Sign::zero;
  for (std::size_t i = 0; i < set.gaps.size(); ++i) {
    const bool outside = (i == 0 && set.roots.size() > 0 && set.roots.front().hi == 0) ||
                         (i > 0 && i == set.roots.size() && set.roots.back().lo == 1);
    if (!outside && set.gaps[i] == Sign::negative) return Sign::negative;
  }
  return set.roots.empty() ? Sign::positive : Sign::zero;
}

} // namespace detail

/// The sign of a polynomial's minimum on the closed unit interval as far as doubles tell: positive or negative where they
/// prove it, else unknown. Never zero. At most about a hundred halvings, O(degree²) operations each. Holds in any rounding
/// mode.
inline Sign filtered_least_sign(const Bernstein<Bounded, 1>& f) { return detail::Least_sign_filter(f).run(); }

/// The sign of a polynomial's minimum on the closed unit interval, exactly: positive where f > 0 on all of it, zero where
/// f ≥ 0 has a zero there (f = 0 among them), negative where f < 0 somewhere. Never unknown.
/// Doubles with an error bound first; then the roots by `exact_roots`, with as many digits as it takes. Holds in any
/// rounding mode.
inline Sign least_sign(const Bernstein<Scaled_integer, 1>& f)
{
  if (f.is_zero()) return Sign::zero;
  const Sign sign = filtered_least_sign(detail::rounded(f.values()));
  return is_certain(sign) ? sign : detail::exact_least_sign(f);
}

inline Sign least_sign(const Bernstein<Rational, 1>& f) { return least_sign(Bernstein<Scaled_integer, 1>(f)); }

/// The same of a polynomial whose coefficients are at hand in doubles, with their common error bound. `make_exact()` gives
/// its exact form, a `Bernstein<Scaled_integer, 1>` or `Bernstein<Rational, 1>`, up to a positive factor; it is called only
/// where doubles cannot tell.
template <class Make_exact>
Sign least_sign(const Bernstein<Bounded, 1>& approximate, Make_exact make_exact)
{
  const Sign sign = filtered_least_sign(approximate);
  return is_certain(sign) ? sign : least_sign(make_exact());
}

} // namespace locus

#endif
