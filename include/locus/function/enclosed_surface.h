// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_ENCLOSED_SURFACE_H
#define LOCUS_FUNCTION_ENCLOSED_SURFACE_H

#include <locus/function/bernstein_horner.h>
#include <locus/function/bounded_bernstein.h>

#include <algorithm>
#include <array>

namespace locus {

/// A bivariate polynomial on the unit cell with bounds of its slopes and its range, for enclosures over small boxes (upward
/// rounding needed).
struct Enclosed_surface {
  Bernstein<Bounded, 2> f;
  double error = 0;
  std::array<double, 2> slope{};
  Interval range{0};

  Enclosed_surface() = default;
  explicit Enclosed_surface(Bernstein<Bounded, 2> g) : f(std::move(g))
  {
    const double operations = 6.0 * (f.degree(0) + f.degree(1)) + 12;
    error = detail::accumulated_error(f.error(), operations, f.norm());
    for (int v = 0; v < 2; ++v) slope[static_cast<std::size_t>(v)] = f.degree(v) == 0 ? 0.0 : derivative(f, v).norm();
    const auto& c = f.values().coefficients();
    const auto [least, greatest] = std::minmax_element(c.begin(), c.end());
    range = Interval(*least, *greatest) + Interval(-f.error(), f.error());
  }

  /// Value at a point; the bound of rounding also covers the few roundings in the point, by the slopes.
  Interval at(const std::array<double, 2>& centre) const
  {
    const double value = detail::tensor_value(f.values().data(), f.degree(0), f.degree(1), centre[0], centre[1]);
    const double r = error + 4 * operation_error * (slope[0] + slope[1]);
    return Interval(value) + Interval(-r, r);
  }

  Interval over(const std::array<double, 2>& centre, const std::array<double, 2>& radius) const
  {
    const double r = slope[0] * radius[0] + slope[1] * radius[1];
    return within_range(at(centre) + Interval(-r, r));
  }

  /// The same by the mean value theorem, from enclosures of both slopes over the box.
  Interval over(const std::array<double, 2>& centre, const std::array<double, 2>& radius, const Interval& slope_0,
                const Interval& slope_1) const
  {
    return within_range(at(centre) + slope_0 * Interval(-radius[0], radius[0]) + slope_1 * Interval(-radius[1], radius[1]));
  }

  Interval within_range(const Interval& x) const
  {
    return {std::min(range.sup(), std::max(range.inf(), x.inf())), std::max(range.inf(), std::min(range.sup(), x.sup()))};
  }
};

} // namespace locus

#endif
