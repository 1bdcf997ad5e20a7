// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_ROOT_ENCLOSURE_H
#define LOCUS_ZERO_SET_ROOT_ENCLOSURE_H

#include <locus/function/enclosed_vector.h>

#include <array>
#include <cmath>
#include <optional>

namespace locus {

/// A polynomial in doubles near the square root of a positive one on the unit interval, with bounds of how far the root and its
/// derivative are from it.
struct Root_enclosure {
  Bernstein<double, 1> near;
  double error = 0, slope_error = 0;
};

namespace detail {

/// The Bernstein coefficients of the polynomial of degree 4 that has these values at 0, 1/4, …, 1; about, without bounds.
inline std::vector<double> through_five(const std::array<double, 5>& f)
{
  const double g1 = 256 * f[1] - 81 * f[0] - f[4], g2 = 16 * f[2] - f[0] - f[4], g3 = 256 * f[3] - f[0] - 81 * f[4];
  const double middle = (30 * g2 - g1 - g3) / 72, sum = (g2 - 6 * middle) / 4, difference = (g1 - g3) / 96;
  return {f[0], 0.5 * (sum + difference), middle, 0.5 * (sum - difference), f[4]};
}

} // namespace detail

/// For f of one component. Nothing where its coefficients are not all positive. Near is of degree 4 (0 for a constant): with
/// σ² = f, σ - near = (f - near²)/(σ + near), and the coefficients of the numerator bound it. Holds in any rounding mode.
inline std::optional<Root_enclosure> root_enclosure(const Enclosed_vector& f)
{
  const double* const c = f.component(0);
  double least = c[0];
  for (std::size_t i = 1; i < f.count(); ++i) least = std::min(least, c[i]);
  least = (least - f.error()) * (1 - 4 * operation_error);
  if (!(least > 0x1p-900) || !(f.norm() < detail::overflow_guard)) return std::nullopt;
  Root_enclosure root;
  if (f.degree() == 0) {
    root.near = Bernstein<double, 1>(Degrees<1>{0}, {std::sqrt(c[0])});
  } else {
    std::array<double, 5> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sqrt(std::max(least, f.at(0.25 * static_cast<double>(i)).component(0)[0]));
    root.near = Bernstein<double, 1>(Degrees<1>{4}, detail::through_five(values));
  }
  const Bernstein<Bounded, 1> near(root.near, 0);
  const Bernstein<Bounded, 1> square(Bernstein<double, 1>(Degrees<1>{f.degree()}, std::vector<double>(c, c + f.count())), f.error());
  const Bernstein<Bounded, 1> negative(multiply(root.near, -1.0), 0);
  const Bernstein<Bounded, 1> rest = add(square, multiply(negative, near));
  double least_near = root.near[0];
  for (const double x : root.near.coefficients()) least_near = std::min(least_near, x);
  constexpr double more = 1 + 0x1p-40; // for the roundings here
  const double root_least = std::sqrt(least) / more, both = (root_least + least_near) / more;
  if (!(both > 0)) return std::nullopt;
  root.error = rest.norm() / both * more;
  root.slope_error = (derivative(rest).norm() + root.error * (derivative(square).norm() / root_least + derivative(near).norm())) / both * more;
  if (!std::isfinite(root.error) || !std::isfinite(root.slope_error)) return std::nullopt;
  return root;
}

} // namespace locus

#endif
