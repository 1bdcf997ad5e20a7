// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_KNOTS_H
#define LOCUS_FUNCTION_KNOTS_H

#include <locus/number/rational.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace locus {

/// Knots of one variable: a degree and non-decreasing values, not necessarily clamped. With n control coefficients there
/// are n + degree + 1 values; the domain is [values[degree], values[n]]. Span s is [values[s], values[s+1]], for s from
/// degree to n-1; it may have length zero. No value stands more than degree + 1 times; one that does, inside the domain,
/// lets the function jump there.
struct Knots {
  int degree = 0;
  std::vector<Rational> values;

  /// Continuity where there is no knot.
  static constexpr int unlimited = std::numeric_limits<int>::max();

  int control_count() const { return static_cast<int>(values.size()) - degree - 1; }
  const Rational& value(int i) const { return values[static_cast<std::size_t>(i)]; }
  Rational domain_lo() const { return value(degree); }
  Rational domain_hi() const { return value(control_count()); }
  bool contains(const Rational& u) const { return value(degree) <= u && u <= value(control_count()); }

  /// How often `u` stands among the values.
  int multiplicity(const Rational& u) const
  {
    const auto range = std::equal_range(values.begin(), values.end(), u);
    return static_cast<int>(range.second - range.first);
  }

  /// The k for which every function on these knots is C^k at `u` inside the domain: degree minus multiplicity, -1 for a
  /// jump, `unlimited` where no knot is.
  int continuity(const Rational& u) const
  {
    const int m = multiplicity(u);
    return m == 0 ? unlimited : degree - m;
  }

  /// The distinct values in the domain, its ends included.
  std::vector<Rational> breaks() const
  {
    std::vector<Rational> distinct(values.begin() + degree, values.begin() + control_count() + 1);
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    return distinct;
  }

  /// The span of positive length that holds `u`: the upper one at a knot, the last one at the domain's upper end.
  /// Throws std::invalid_argument outside the domain.
  int span_of(const Rational& u) const
  {
    if (!contains(u))
      throw std::invalid_argument("Knots: " + u.get_str() + " is outside the domain [" + domain_lo().get_str() + ", " +
                                  domain_hi().get_str() + "]");
    const auto first = values.begin() + degree, last = values.begin() + control_count() + 1;
    const auto above = u == domain_hi() ? std::lower_bound(first, last, u) : std::upper_bound(first, last, u);
    return static_cast<int>(above - values.begin()) - 1;
  }

  friend bool operator==(const Knots& a, const Knots& b) { return a.degree == b.degree && a.values == b.values; }
};

/// Throws std::invalid_argument, with the reason, unless the knots are as `Knots` describes and the domain has a length.
inline void require_valid(const Knots& knots)
{
  const auto reject = [](const std::string& reason) { throw std::invalid_argument("Knots: " + reason); };
  if (knots.degree < 0) reject("the degree " + std::to_string(knots.degree) + " is negative");
  const auto order = static_cast<std::size_t>(knots.degree) + 1;
  if (knots.values.size() < 2 * order)
    reject("degree " + std::to_string(knots.degree) + " needs at least " + std::to_string(2 * order) + " values, not " +
           std::to_string(knots.values.size()));
  for (std::size_t i = 1; i < knots.values.size(); ++i)
    if (knots.values[i] < knots.values[i - 1])
      reject("value " + knots.values[i].get_str() + " follows the greater " + knots.values[i - 1].get_str());
  for (std::size_t i = order; i < knots.values.size(); ++i)
    if (knots.values[i] == knots.values[i - order])
      reject("value " + knots.values[i].get_str() + " stands more than degree + 1 times");
  if (knots.domain_lo() == knots.domain_hi()) reject("the domain has length zero");
}

/// Clamped knots over increasing `breaks`: each end degree + 1 times, each break between as often as `continuity(u)`
/// (-1 a jump, `degree` or more no knot at all) asks.
template <class Continuity>
Knots knots_over(int degree, const std::vector<Rational>& breaks, Continuity continuity)
{
  assert(breaks.size() >= 2);
  Knots knots{degree, {}};
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const bool end = i == 0 || i + 1 == breaks.size();
    const int c = end ? -1 : std::clamp(continuity(breaks[i]), -1, degree);
    knots.values.insert(knots.values.end(), static_cast<std::size_t>(degree - c), breaks[i]);
  }
  return knots;
}

/// The same knots inside the domain, each end of which stands degree + 1 times; values outside it are gone.
inline Knots clamped(const Knots& knots)
{
  return knots_over(knots.degree, knots.breaks(), [&](const Rational& u) { return knots.continuity(u); });
}

/// The knots mapped by the increasing affine map that takes their domain to [lo, hi]. Throws std::invalid_argument
/// unless lo < hi.
inline Knots reparametrised(Knots knots, const Rational& lo, const Rational& hi)
{
  if (lo >= hi) throw std::invalid_argument("Knots: a domain cannot be [" + lo.get_str() + ", " + hi.get_str() + "]");
  const Rational from = knots.domain_lo();
  const Rational scale = (hi - lo) / (knots.domain_hi() - from);
  for (Rational& u : knots.values) u = lo + scale * (u - from);
  return knots;
}

namespace detail {

/// Numbers w with f(u_1, …, u_n) = Σ w[j]·c[span - n + j], where f(·, …, ·) is the polar form of the polynomial that the
/// control coefficients c give on a span of positive length: symmetric, affine in each argument, and f(u, …, u) is the
/// value at u. De Boor's recursion, run from the value down to the coefficients; O(n²).
inline std::vector<Rational> polar_weights(const Knots& knots, int span, const Rational* arguments)
{
  std::vector<Rational> weights{1};
  for (int level = knots.degree; level >= 1; --level) {
    std::vector<Rational> finer(weights.size() + 1, Rational(0));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Rational& lo = knots.value(span - knots.degree + level + static_cast<int>(i));
      const Rational& hi = knots.value(span + 1 + static_cast<int>(i));
      const Rational upper = weights[i] * (arguments[level - 1] - lo) / (hi - lo);
      finer[i] += weights[i] - upper;
      finer[i + 1] += upper;
    }
    weights = std::move(finer);
  }
  return weights;
}

/// The span of positive length whose polynomial gives control coefficient i: of those that the coefficient acts on, the
/// nearest to the middle. Where it acts on none inside the domain, the nearest span there is.
inline int middle_span(const Knots& knots, int i)
{
  int best = -1, least = 0;
  for (int s = knots.degree; s < knots.control_count(); ++s) {
    if (knots.value(s) == knots.value(s + 1)) continue;
    const int distance = std::abs(2 * s - (2 * i + knots.degree));
    if (best >= 0 && distance >= least) continue;
    best = s;
    least = distance;
  }
  return best;
}

} // namespace detail

} // namespace locus

#endif
