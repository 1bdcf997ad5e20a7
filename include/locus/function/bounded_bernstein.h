// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BOUNDED_BERNSTEIN_H
#define LOCUS_FUNCTION_BOUNDED_BERNSTEIN_H

#include <locus/function/bernstein_operations.h>
#include <locus/number/bounded.h>

namespace locus {

/// Bernstein form in doubles whose whole array has one error bound: every true coefficient lies within `error()` of
/// the stored one. All operations run the double version and add a bound of their rounding that holds in any
/// rounding mode, so that a coefficient beyond the bound has a proved sign.
template <int D>
class Bernstein<Bounded, D> {
public:
  static constexpr int dimension = D;

  Bernstein() = default;
  Bernstein(Bernstein<double, D> values, double error) : values_(std::move(values)), error_(error) {}

  const Bernstein<double, D>& values() const { return values_; }
  const Degrees<D>& degrees() const { return values_.degrees(); }
  int degree(int variable = 0) const { return values_.degree(variable); }
  std::size_t size() const { return values_.size(); }
  double error() const { return error_; }
  Bounded operator[](std::size_t i) const { return {values_[i], error_}; }

  /// Bound of the true coefficients' absolute values, and so of the polynomial's on the unit box.
  double norm() const
  {
    double m = 0;
    for (double c : values_.coefficients()) m = std::max(m, std::abs(c));
    return (m + error_) * (1 + 2 * operation_error);
  }

private:
  Bernstein<double, D> values_;
  double error_ = 0;
};

namespace detail {

/// Magnitude from which on intermediate results (scaled by binomials) might overflow: no bound is claimed there.
inline constexpr double overflow_guard = 0x1p900;

/// Error bound after an operation: what the operands carried, `operations` roundings at magnitude `norm`, and
/// underflow, all enlarged at most by `growth`; inflated against the roundings of this very expression.
inline double accumulated_error(double inherited, double operations, double norm, double growth = 1)
{
  if (!(norm * growth < overflow_guard)) return std::numeric_limits<double>::infinity();
  return (inherited + operations * (operation_error * norm + underflow_error)) * growth * (1 + 8 * operation_error);
}

} // namespace detail

/// The interval form as midpoints and the greatest radius.
template <int D>
Bernstein<Bounded, D> bounded(const Bernstein<Interval, D>& f)
{
  double error = 0;
  auto values = converted<double>(f, [&](const Interval& c) {
    const Bounded b = bounded(c);
    error = std::max(error, b.error);
    return b.value;
  });
  return {std::move(values), error};
}

/// The same coefficients as intervals (upward rounding needed).
template <int D>
Bernstein<Interval, D> enclosing(const Bernstein<Bounded, D>& f)
{
  const Interval radius(-f.error(), f.error());
  return converted<Interval>(f.values(), [&](double c) { return Interval(c) + radius; });
}

/// Of an exact form, coefficient by coefficient.
template <int D>
Bernstein<Interval, D> enclosing(const Bernstein<Rational, D>& f)
{
  return converted<Interval>(f, [](const Rational& c) { return enclosing(c); });
}

template <int D>
Bernstein<Bounded, D> add(const Bernstein<Bounded, D>& f, const Bernstein<Bounded, D>& g)
{
  int elevations = 1;
  for (int k = 0; k < D; ++k) elevations += 4 * std::abs(f.degree(k) - g.degree(k));
  const double norm = f.norm() + g.norm();
  return {add(f.values(), g.values()), detail::accumulated_error(f.error() + g.error(), elevations, norm)};
}

template <int D>
Bernstein<Bounded, D> multiply(const Bernstein<Bounded, D>& f, const Bernstein<Bounded, D>& g)
{
  const double nf = f.norm(), ng = g.norm();
  // A coefficient of the product is a mean of products of coefficients, of at most min(size) terms.
  const double terms = static_cast<double>(std::min(f.size(), g.size()));
  int large_binomials = 0;
  for (int k = 0; k < D; ++k)
    if (f.degree(k) + g.degree(k) > detail::last_exact_binomial_row) large_binomials += 3;
  double error = detail::accumulated_error(f.error() * ng + nf * g.error(), terms + 4 + 6 * D + large_binomials, nf * ng);
  if (!(std::max(nf, ng) < detail::overflow_guard)) error = std::numeric_limits<double>::infinity();
  return {multiply(f.values(), g.values()), error};
}

template <int D>
Bernstein<Bounded, D> derivative(const Bernstein<Bounded, D>& f, int variable = 0)
{
  const double n = f.degree(variable);
  return {derivative(f.values(), variable), detail::accumulated_error(2 * n * f.error(), 3, 2 * n * f.norm())};
}

template <int D>
Bernstein<Bounded, D> elevate(const Bernstein<Bounded, D>& f, int variable, int by)
{
  return {elevate(f.values(), variable, by), detail::accumulated_error(f.error(), 5.0 * by, f.norm())};
}

template <int D>
std::pair<Bernstein<Bounded, D>, Bernstein<Bounded, D>> split(const Bernstein<Bounded, D>& f, int variable, double at)
{
  auto [left, right] = split(f.values(), variable, at);
  // Outside [0,1] the combination is no longer a mean: each level may enlarge coefficients and their errors.
  const double growth = std::pow(std::max(1.0, std::abs(at) + std::abs(1 - at)), f.degree(variable));
  const double error = detail::accumulated_error(f.error(), 4.0 * f.degree(variable), f.norm(), growth);
  return {{std::move(left), error}, {std::move(right), error}};
}

template <int D>
Bernstein<Bounded, D> restrict_to(const Bernstein<Bounded, D>& f, int variable, double lo, double hi)
{
  const bool low = detail::not_above_half(lo);
  const Bernstein<Bounded, D> outer = low ? split(f, variable, lo).second : split(f, variable, hi).first;
  const double at = low ? (hi - lo) / (1 - lo) : lo / hi;
  const Bernstein<Bounded, D> part = low ? split(outer, variable, at).first : split(outer, variable, at).second;
  // `at` is rounded up to three times, which moves the second cut; the derivative bounds what that changes.
  const double shift = 4 * operation_error * std::abs(at) * 2 * f.degree(variable) * outer.norm() *
                       std::pow(std::max(1.0, std::abs(at) + std::abs(1 - at)), f.degree(variable));
  return {part.values(), detail::accumulated_error(part.error() + shift, 0, 0)};
}

template <int D>
Bernstein<Bounded, D - 1> face(const Bernstein<Bounded, D>& f, int variable, bool high)
{
  return {face(f.values(), variable, high), f.error()};
}

template <int D>
Bounded evaluate(const Bernstein<Bounded, D>& f, const std::array<double, static_cast<std::size_t>(D)>& point)
{
  double operations = 0, growth = 1;
  for (int k = 0; k < D; ++k) {
    const double u = point[static_cast<std::size_t>(k)];
    operations += 4.0 * f.degree(k);
    growth *= std::pow(std::max(1.0, std::abs(u) + std::abs(1 - u)), f.degree(k));
  }
  return {evaluate(f.values(), point), detail::accumulated_error(f.error(), operations, f.norm(), growth)};
}

/// f(g_1, …, g_D) with the bound obtained by running the interval version (upward rounding needed).
template <int D, int E>
Bernstein<Bounded, E> substitute(const Bernstein<Bounded, D>& f,
                                 const std::array<Bernstein<Bounded, E>, static_cast<std::size_t>(D)>& g)
{
  std::array<Bernstein<Interval, E>, static_cast<std::size_t>(D)> inner;
  for (std::size_t k = 0; k < inner.size(); ++k) inner[k] = enclosing(g[k]);
  return bounded(substitute(enclosing(f), inner));
}

} // namespace locus

#endif
