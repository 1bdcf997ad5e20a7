// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CONTROL_HULL_H
#define LOCUS_ZERO_SET_CONTROL_HULL_H

#include <locus/function/bounded_bernstein.h>

#include <limits>
#include <optional>
#include <vector>

namespace locus {

/// Part [lo, hi] of the unit interval.
struct Unit_range {
  double lo = 0, hi = 1;

  double width() const { return hi - lo; }
};

namespace detail {

/// What the walk along a hull may lose to rounding, as part of the unit interval; the true loss is below degree²·2^-48.
inline constexpr double hull_slack = 0x1p-20;

/// Where the lower hull of the points (i, height(i)), i = 0…n, first comes down to zero from height(0) > 0, divided by n.
/// Nothing if all heights are positive. O(n·corners of the hull).
template <class Height>
std::optional<double> first_descent(int n, Height height)
{
  for (int i = 0;;) {
    int lowest = -1;
    double steepest = std::numeric_limits<double>::infinity();
    for (int j = i + 1; j <= n; ++j)
      if (const double slope = (height(j) - height(i)) / (j - i); slope < steepest) {
        steepest = slope;
        lowest = j;
      }
    if (lowest < 0) return std::nullopt;
    if (height(lowest) <= 0) return (i + (lowest - i) * (height(i) / (height(i) - height(lowest)))) / n;
    i = lowest;
  }
}

/// Where, seen from one end, the hull of the points (i, [low_i, high_i]) first meets the axis.
inline std::optional<double> first_meeting(const std::vector<double>& low, const std::vector<double>& high,
                                           bool from_end)
{
  const int n = static_cast<int>(low.size()) - 1;
  const auto at = [&](int i) { return static_cast<std::size_t>(from_end ? n - i : i); };
  if (low[at(0)] > 0) return first_descent(n, [&](int i) { return low[at(i)]; });
  if (high[at(0)] < 0) return first_descent(n, [&](int i) { return -high[at(i)]; });
  return 0.0;
}

} // namespace detail

/// The part of a variable's range outside of which f has no zero on the unit box: where the convex hull of the control
/// polygon, projected along the other variables, meets the axis (Sherbrooke & Patrikalakis 1993). Nothing if f has no zero.
/// Wider than the truth by some 2^-20. O(size + degree²).
template <int D>
std::optional<Unit_range> zero_range(const Bernstein<Bounded, D>& f, int variable)
{
  const Layout layout = layout_along(f.degrees(), variable);
  std::vector<double> low(layout.count, std::numeric_limits<double>::infinity()), high(layout.count, -low[0]);
  const double* c = f.values().data();
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t j = 0; j < layout.count; ++j)
      for (std::size_t i = 0; i < layout.inner; ++i, ++c) {
        low[j] = std::min(low[j], *c);
        high[j] = std::max(high[j], *c);
      }
  const double error = detail::accumulated_error(f.error(), 4, f.norm());
  if (!(error < std::numeric_limits<double>::infinity())) return Unit_range{};
  for (std::size_t j = 0; j < layout.count; ++j) {
    low[j] -= error;
    high[j] += error;
  }
  const auto from_low = detail::first_meeting(low, high, false), from_high = detail::first_meeting(low, high, true);
  if (!from_low || !from_high) return std::nullopt;
  return Unit_range{std::max(0.0, *from_low - detail::hull_slack), std::min(1.0, 1 - *from_high + detail::hull_slack)};
}

} // namespace locus

#endif
