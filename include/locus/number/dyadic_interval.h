// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_NUMBER_DYADIC_INTERVAL_H
#define LOCUS_NUMBER_DYADIC_INTERVAL_H

#include <locus/number/interval.h>

#include <mpfr.h>

#include <algorithm>
#include <utility>

namespace locus {

/// Interval arithmetic with as many bits as it takes (MPFR), in any rounding mode of the processor: the rung between
/// doubles and exactness. Every number has a precision of its own; a result has the greater one of its operands, so
/// that short constants do not spoil long numbers. Overflow and underflow lie beyond 2^±(2^62).
class Dyadic_interval {
public:
  /// The integer x, exactly.
  Dyadic_interval(int x = 0) : Dyadic_interval(short_precision, Unset{})
  {
    mpfr_set_si(lo_, x, MPFR_RNDN);
    mpfr_set_si(hi_, x, MPFR_RNDN);
  }
  /// The double x, exactly, as a number of `bits` bits (53 at least).
  Dyadic_interval(double x, mpfr_prec_t bits) : Dyadic_interval(std::max(bits, short_precision), Unset{})
  {
    mpfr_set_d(lo_, x, MPFR_RNDN);
    mpfr_set_d(hi_, x, MPFR_RNDN);
  }
  /// Encloses x·2^-exponent.
  Dyadic_interval(const Integer& x, long exponent, mpfr_prec_t bits)
    : Dyadic_interval(std::max(bits, short_precision), Unset{})
  {
    mpfr_set_z_2exp(lo_, x.get_mpz_t(), -exponent, MPFR_RNDD);
    mpfr_set_z_2exp(hi_, x.get_mpz_t(), -exponent, MPFR_RNDU);
  }
  Dyadic_interval(const Dyadic_interval& other) : Dyadic_interval(other.precision(), Unset{})
  {
    mpfr_set(lo_, other.lo_, MPFR_RNDN);
    mpfr_set(hi_, other.hi_, MPFR_RNDN);
  }
  Dyadic_interval(Dyadic_interval&& other) : Dyadic_interval(short_precision, Unset{}) { swap(other); }
  Dyadic_interval& operator=(Dyadic_interval other)
  {
    swap(other);
    return *this;
  }
  ~Dyadic_interval()
  {
    mpfr_clear(lo_);
    mpfr_clear(hi_);
  }

  void swap(Dyadic_interval& other) noexcept
  {
    mpfr_swap(lo_, other.lo_);
    mpfr_swap(hi_, other.hi_);
  }

  mpfr_prec_t precision() const { return mpfr_get_prec(lo_); }

  /// The tightest interval of doubles around this·2^exponent.
  Interval enclosing_interval(long exponent = 0) const
  {
    return Interval(scaled_double(lo_, exponent, MPFR_RNDD), scaled_double(hi_, exponent, MPFR_RNDU));
  }

  /// The least e such that |x| < 2^e for all numbers x of the interval; `zero_exponent` for the number zero.
  long exponent() const
  {
    long e = zero_exponent;
    for (const auto* x : {&lo_, &hi_})
      if (mpfr_regular_p(*x)) e = std::max(e, static_cast<long>(mpfr_get_exp(*x)));
    return e;
  }
  static constexpr long zero_exponent = std::numeric_limits<long>::min() / 4;

  friend Dyadic_interval operator+(const Dyadic_interval& a, const Dyadic_interval& b)
  {
    Dyadic_interval sum(std::max(a.precision(), b.precision()), Unset{});
    mpfr_add(sum.lo_, a.lo_, b.lo_, MPFR_RNDD);
    mpfr_add(sum.hi_, a.hi_, b.hi_, MPFR_RNDU);
    return sum;
  }
  friend Dyadic_interval operator-(const Dyadic_interval& a, const Dyadic_interval& b)
  {
    Dyadic_interval difference(std::max(a.precision(), b.precision()), Unset{});
    mpfr_sub(difference.lo_, a.lo_, b.hi_, MPFR_RNDD);
    mpfr_sub(difference.hi_, a.hi_, b.lo_, MPFR_RNDU);
    return difference;
  }
  friend Dyadic_interval operator*(const Dyadic_interval& a, const Dyadic_interval& b)
  {
    // One factor is mostly of one sign (a place in the unit interval): put it first.
    if (mpfr_sgn(a.lo_) >= 0) return product_with_positive(a, b);
    if (mpfr_sgn(b.lo_) >= 0) return product_with_positive(b, a);
    if (mpfr_sgn(a.hi_) <= 0) return -product_with_positive(-a, b);
    if (mpfr_sgn(b.hi_) <= 0) return -product_with_positive(-b, a);
    Dyadic_interval p(std::max(a.precision(), b.precision()), Unset{}), q(p.precision(), Unset{});
    mpfr_mul(p.lo_, a.lo_, b.hi_, MPFR_RNDD);
    mpfr_mul(q.lo_, a.hi_, b.lo_, MPFR_RNDD);
    mpfr_mul(p.hi_, a.lo_, b.lo_, MPFR_RNDU);
    mpfr_mul(q.hi_, a.hi_, b.hi_, MPFR_RNDU);
    mpfr_min(p.lo_, p.lo_, q.lo_, MPFR_RNDD);
    mpfr_max(p.hi_, p.hi_, q.hi_, MPFR_RNDU);
    return p;
  }
  /// a/b for b > 0; throws std::domain_error for other b.
  friend Dyadic_interval operator/(const Dyadic_interval& a, const Dyadic_interval& b)
  {
    if (mpfr_sgn(b.lo_) <= 0) throw std::domain_error("Dyadic_interval: the divisor is not positive");
    Dyadic_interval q(std::max(a.precision(), b.precision()), Unset{});
    mpfr_div(q.lo_, a.lo_, mpfr_sgn(a.lo_) >= 0 ? b.hi_ : b.lo_, MPFR_RNDD);
    mpfr_div(q.hi_, a.hi_, mpfr_sgn(a.hi_) >= 0 ? b.lo_ : b.hi_, MPFR_RNDU);
    return q;
  }
  friend Dyadic_interval operator-(Dyadic_interval a)
  {
    mpfr_neg(a.lo_, a.lo_, MPFR_RNDN);
    mpfr_neg(a.hi_, a.hi_, MPFR_RNDN);
    mpfr_swap(a.lo_, a.hi_);
    return a;
  }
  Dyadic_interval& operator+=(const Dyadic_interval& other) { return *this = *this + other; }
  Dyadic_interval& operator-=(const Dyadic_interval& other) { return *this = *this - other; }
  Dyadic_interval& operator/=(const Dyadic_interval& other) { return *this = *this / other; }

  friend Sign sign_of(const Dyadic_interval& x)
  {
    if (mpfr_sgn(x.lo_) > 0) return Sign::positive;
    if (mpfr_sgn(x.hi_) < 0) return Sign::negative;
    return mpfr_zero_p(x.lo_) && mpfr_zero_p(x.hi_) ? Sign::zero : Sign::unknown;
  }

private:
  struct Unset {};
  static constexpr mpfr_prec_t short_precision = 64;

  Dyadic_interval(mpfr_prec_t bits, Unset)
  {
    mpfr_init2(lo_, bits);
    mpfr_init2(hi_, bits);
  }

  /// a·b for a ≥ 0.
  static Dyadic_interval product_with_positive(const Dyadic_interval& a, const Dyadic_interval& b)
  {
    Dyadic_interval p(std::max(a.precision(), b.precision()), Unset{});
    mpfr_mul(p.lo_, mpfr_sgn(b.lo_) >= 0 ? a.lo_ : a.hi_, b.lo_, MPFR_RNDD);
    mpfr_mul(p.hi_, mpfr_sgn(b.hi_) >= 0 ? a.hi_ : a.lo_, b.hi_, MPFR_RNDU);
    return p;
  }

  static double scaled_double(const mpfr_t& x, long exponent, mpfr_rnd_t towards)
  {
    mpfr_t y;
    mpfr_init2(y, mpfr_get_prec(x));
    mpfr_mul_2si(y, x, exponent, towards);
    const double d = mpfr_get_d(y, towards);
    mpfr_clear(y);
    return d;
  }

  mpfr_t lo_, hi_;
};

} // namespace locus

#endif
