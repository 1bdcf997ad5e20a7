// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_ALGEBRAIC_NUMBER_H
#define LOCUS_ZERO_SET_ALGEBRAIC_NUMBER_H

#include <locus/function/descartes.h>

#include <memory>
#include <mutex>
#include <utility>

namespace locus {

/// A real algebraic number: a square-free integer polynomial and an interval with rational ends that holds exactly one
/// of its roots. Copies share what they learn. `enclosure` and `compare` refine on demand, are const, and may be called
/// from several threads at once.
class Algebraic_number {
public:
  using Enclosure = std::pair<Rational, Rational>;

  /// The rational number x.
  explicit Algebraic_number(const Rational& x)
    : Algebraic_number(Integer_polynomial{Integer(-x.get_num()), Integer(x.get_den())}, x, x)
  {
  }

  /// The only root of `polynomial` in [lo, hi]; its square-free part is kept.
  /// Throws std::invalid_argument unless there is exactly one (multiplicities aside).
  Algebraic_number(const Integer_polynomial& polynomial, const Rational& lo, const Rational& hi) : state_(std::make_shared<State>())
  {
    state_->polynomial = exact_quotient(detail::primitive_part(polynomial), gcd(polynomial, derivative(polynomial)));
    if (degree(state_->polynomial) < 1 || hi < lo) throw std::invalid_argument("Algebraic_number: no polynomial with a root");
    state_->lo = lo;
    state_->hi = hi;
    if (lo == hi) {
      if (sign_of_polynomial(lo) != Sign::zero) throw std::invalid_argument("Algebraic_number: the given number is no root");
      return;
    }
    const auto roots = exact_roots(restrict_to(bernstein_form(state_->polynomial), 0, lo, hi), Rational(0), Rational(1)).roots;
    if (roots.size() != 1) throw std::invalid_argument("Algebraic_number: the interval does not hold exactly one root");
    const Rational width = hi - lo;
    state_->lo = lo + roots[0].lo * width;
    state_->hi = lo + roots[0].hi * width;
  }

  const Integer_polynomial& polynomial() const { return state_->polynomial; }

  /// An interval of at most `width` > 0 around the number: a point where the number is found to be rational.
  /// Costs a bisection step a bit.
  Enclosure enclosure(const Rational& width) const
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    while (Rational(state_->hi - state_->lo) > width) bisect();
    return {state_->lo, state_->hi};
  }

  /// What is known so far.
  Enclosure enclosure() const
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    return {state_->lo, state_->hi};
  }

  /// -1, 0 or 1 as this number is below, equal to or above x; always decided.
  int compare(const Rational& x) const
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    while (state_->lo <= x && x <= state_->hi) {
      if (sign_of_polynomial(x) == Sign::zero) return 0; // x is a root, and the interval holds only one
      bisect();
    }
    return state_->hi < x ? -1 : 1;
  }

  /// The same for another number; always decided: a common root of both polynomials where both numbers are is both.
  int compare(const Algebraic_number& other) const
  {
    if (state_ == other.state_) return 0;
    const Integer_polynomial common = gcd(polynomial(), other.polynomial());
    for (bool is_first = true;; is_first = false) {
      const Enclosure a = enclosure(), b = other.enclosure();
      if (a.second < b.first) return -1;
      if (b.second < a.first) return 1;
      if (a.first == a.second) return -other.compare(a.first);
      if (b.first == b.second) return compare(b.first);
      if (is_first && degree(common) > 0 && has_root(common, std::max(a.first, b.first), std::min(a.second, b.second))) return 0;
      enclosure((a.second - a.first) / 4);
      other.enclosure((b.second - b.first) / 4);
    }
  }

  double to_double() const
  {
    const Enclosure e = enclosure(Rational(1, Integer(1) << 80));
    return Rational((e.first + e.second) / 2).get_d();
  }

private:
  struct State {
    Integer_polynomial polynomial;
    std::mutex mutex;
    Rational lo, hi;
  };

  static bool has_root(const Integer_polynomial& f, const Rational& lo, const Rational& hi)
  {
    if (lo == hi) return evaluate_at(bernstein_form(f).rational(), lo) == 0;
    return !exact_roots(restrict_to(bernstein_form(f), 0, lo, hi), Rational(0), Rational(1)).roots.empty();
  }

  Sign sign_of_polynomial(const Rational& x) const
  {
    Integer sum = 0, power = 1; // Σ c_k p^k q^(n-k)
    for (auto c = state_->polynomial.rbegin(); c != state_->polynomial.rend(); ++c) {
      sum = sum * x.get_num() + *c * power;
      power *= x.get_den();
    }
    return sign_of(sum);
  }

  /// Halves the interval; the caller holds the lock.
  void bisect() const
  {
    if (state_->lo == state_->hi) return;
    const Rational mid = (state_->lo + state_->hi) / 2;
    const Sign at_mid = sign_of_polynomial(mid);
    if (at_mid == Sign::zero) state_->lo = state_->hi = mid;
    else if (const Sign at_hi = sign_of_polynomial(state_->hi); at_hi == Sign::zero) state_->lo = state_->hi;
    else (at_mid == at_hi ? state_->hi : state_->lo) = mid;
  }

  std::shared_ptr<State> state_;
};

} // namespace locus

#endif
