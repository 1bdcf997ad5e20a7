// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_NUMBER_INTERVAL_H
#define LOCUS_NUMBER_INTERVAL_H

#ifdef __FAST_MATH__
#error "locus proves its answers with rounding errors: compile without -ffast-math"
#endif

#include <locus/number/rational.h>

#include <CGAL/Interval_nt.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace locus {

/// Interval arithmetic on doubles. `Interval_nt<false>` leaves the rounding mode to the caller: every operation on
/// it must run inside `with_upward_rounding`.
using Interval = CGAL::Interval_nt<false>;

namespace detail {

/// Runs `f` in a frame of its own, so that the compiler cannot move floating-point work across a change of mode.
template <class F>
[[gnu::noinline]] decltype(auto) call_out_of_line(F& f)
{
  return f();
}

[[gnu::noinline]] inline double opaque_sum(double a, double b)
{
  volatile double x = a, y = b;
  return x + y;
}

inline bool rounding_mode_works()
{
  const double tiny = std::numeric_limits<double>::min();
  CGAL::Protect_FPU_rounding<true> upward(CGAL_FE_UPWARD);
  return opaque_sum(1.0, tiny) > 1.0 && opaque_sum(-1.0, tiny) > -1.0;
}

} // namespace detail

/// Runs `f` with the processor rounding upward, as `Interval` needs, and restores the caller's mode, also when `f`
/// throws. Entered once around a whole solve. Throws std::runtime_error if this build or processor ignores the mode.
template <class F>
[[gnu::noinline]] decltype(auto) with_upward_rounding(F&& f)
{
  static const bool works = detail::rounding_mode_works();
  if (!works) throw std::runtime_error("locus: directed rounding does not work on this build; intervals would be wrong");
  CGAL::Protect_FPU_rounding<true> upward(CGAL_FE_UPWARD);
  return detail::call_out_of_line(f);
}

/// Runs `f` (a callback, input/output, a function of the mathematical library) with rounding to nearest inside a
/// solve that rounds upward.
template <class F>
[[gnu::noinline]] decltype(auto) with_nearest_rounding(F&& f)
{
  CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
  return detail::call_out_of_line(f);
}

inline Sign sign_of(const Interval& x)
{
  if (x.inf() > 0) return Sign::positive;
  if (x.sup() < 0) return Sign::negative;
  return x.inf() == 0 && x.sup() == 0 ? Sign::zero : Sign::unknown;
}

inline bool contains_zero(const Interval& x) { return !(x.inf() > 0) && !(x.sup() < 0); }
inline double midpoint(const Interval& x) { return x.inf() + 0.5 * (x.sup() - x.inf()); }
/// A number of the interval to show: zero where it contains zero, else the midpoint.
inline double representative(const Interval& x) { return contains_zero(x) ? 0.0 : midpoint(x); }
inline double magnitude(const Interval& x) { return std::max(-x.inf(), x.sup()); }
inline double mignitude(const Interval& x) { return contains_zero(x) ? 0.0 : std::min(std::abs(x.inf()), std::abs(x.sup())); }
inline double width(const Interval& x) { return x.sup() - x.inf(); }
inline Interval hull(const Interval& a, const Interval& b)
{
  return Interval(std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup()));
}
/// Of two intervals that enclose one number; `a` where `b` is no number.
inline Interval common_part(const Interval& a, const Interval& b)
{
  return Interval(std::max(a.inf(), b.inf()), std::min(a.sup(), b.sup()));
}
inline bool overlap(const Interval& a, const Interval& b) { return a.inf() <= b.sup() && b.inf() <= a.sup(); }
inline bool inside(const Interval& a, const Interval& b) { return b.inf() < a.inf() && a.sup() < b.sup(); }

/// Enclosure, at most one unit in the last place wide, of x·2^-exponent. Independent of the rounding mode.
inline Interval enclosing_scaled(const Integer& x, long exponent)
{
  if (x == 0) return Interval(0);
  long e = 0;
  const double m = mpz_get_d_2exp(&e, x.get_mpz_t()); // |m| in [1/2, 1), rounded towards zero
  e -= exponent;
  if (e < -960) return sgn(x) > 0 ? Interval(0, 0x1p-960) : Interval(-0x1p-960, 0);
  const int power = static_cast<int>(e);
  const double near = std::ldexp(m, power);
  if (mpz_sizeinbase(x.get_mpz_t(), 2) <= 53) return Interval(near);
  const double far = std::ldexp(m > 0 ? m + 0x1p-53 : m - 0x1p-53, power);
  return m > 0 ? Interval(near, far) : Interval(far, near);
}

/// The tightest interval of doubles around a rational; one double where the rational is one.
/// Independent of the rounding mode.
inline Interval enclosing(const Rational& x)
{
  // A short numerator over a power of two is a double; most coordinates are such.
  if (const mpz_srcptr q = x.get_den_mpz_t(); mpz_sizeinbase(x.get_num_mpz_t(), 2) <= 53 && mpz_sizeinbase(q, 2) <= 900 &&
                                              mpz_scan1(q, 0) + 1 == mpz_sizeinbase(q, 2))
    return Interval(std::ldexp(mpz_get_d(x.get_num_mpz_t()), -static_cast<int>(mpz_scan1(q, 0))));
  mpfr_t lo, hi;
  mpfr_init2(lo, 53);
  mpfr_init2(hi, 53);
  mpfr_set_q(lo, x.get_mpq_t(), MPFR_RNDD);
  mpfr_set_q(hi, x.get_mpq_t(), MPFR_RNDU);
  const Interval enclosure(mpfr_get_d(lo, MPFR_RNDD), mpfr_get_d(hi, MPFR_RNDU));
  mpfr_clear(lo);
  mpfr_clear(hi);
  return enclosure;
}

/// A double next to a rational (rounded to nearest).
inline double nearest_double(const Rational& x)
{
  mpfr_t y;
  mpfr_init2(y, 53);
  mpfr_set_q(y, x.get_mpq_t(), MPFR_RNDN);
  const double d = mpfr_get_d(y, MPFR_RNDN);
  mpfr_clear(y);
  return d;
}

} // namespace locus

#endif
