// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_ENCLOSED_VECTOR_H
#define LOCUS_FUNCTION_ENCLOSED_VECTOR_H

#include <locus/function/bounded_bernstein.h>

#include <array>
#include <vector>

namespace locus {

/// Polynomials in one variable as the components of a vector, all of one degree, exactly.
using Vector_form = std::vector<Bernstein<Rational, 1>>;

/// The same degree for all components.
template <class T>
std::vector<Bernstein<T, 1>> of_one_degree(std::vector<Bernstein<T, 1>> f)
{
  int n = 0;
  for (const auto& x : f) n = std::max(n, x.degree());
  for (auto& x : f)
    if (x.degree() < n) x = elevate(x, 0, n - x.degree());
  return f;
}
template <class T>
std::vector<Bernstein<T, 1>> of_one_degree(const std::array<Bernstein<T, 1>, 3>& f)
{
  return of_one_degree(std::vector<Bernstein<T, 1>>(f.begin(), f.end()));
}

/// A vector of Bernstein polynomials in doubles with one error bound for all coefficients: component r's coefficients are
/// the (degree + 1) numbers from r·(degree + 1) on. Holds in any rounding mode.
class Enclosed_vector {
public:
  Enclosed_vector() = default;

  /// Upward rounding needed.
  explicit Enclosed_vector(const Vector_form& f) : Enclosed_vector(enclosures(f)) {}

  explicit Enclosed_vector(const std::vector<Bernstein<Interval, 1>>& f) : rank_(f.size()), degree_(f.empty() ? 0 : f[0].degree())
  {
    c_.reserve(rank_ * count());
    for (const auto& x : f)
      for (const Interval& c : x.coefficients()) {
        const Bounded b = bounded(c);
        c_.push_back(b.value);
        error_ = std::max(error_, b.error);
      }
    measure();
  }

  /// From doubles, component after component, with one bound of their errors.
  Enclosed_vector(std::size_t rank, int degree, std::vector<double> coefficients, double error)
    : c_(std::move(coefficients)), rank_(rank), degree_(degree), error_(error)
  {
    measure();
  }

  std::size_t rank() const { return rank_; }
  int degree() const { return degree_; }
  std::size_t count() const { return static_cast<std::size_t>(degree_) + 1; }
  const double* component(std::size_t r) const { return c_.data() + r * count(); }
  /// A component as intervals (upward rounding needed).
  Bernstein<Interval, 1> interval_form(std::size_t r) const
  {
    Bernstein<double, 1> values(Degrees<1>{degree_}, std::vector<double>(component(r), component(r) + count()));
    return enclosing(Bernstein<Bounded, 1>(std::move(values), error_));
  }
  double error() const { return error_; }
  /// Bound of the coefficients' absolute values.
  double norm() const { return norm_; }

  /// The parts on the two halves of the unit interval.
  std::pair<Enclosed_vector, Enclosed_vector> halves() const
  {
    std::pair<Enclosed_vector, Enclosed_vector> parts{*this, *this};
    for (std::size_t r = 0; r < rank_; ++r) {
      double* const left = parts.first.c_.data() + r * count();
      double* const right = parts.second.c_.data() + r * count();
      const auto n = static_cast<std::size_t>(degree_);
      for (std::size_t level = 0; level <= n; ++level) {
        left[level] = right[0];
        for (std::size_t i = 0; i + level < n; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
      }
    }
    const double error = detail::accumulated_error(error_, 2.0 * degree_, norm_);
    for (Enclosed_vector* part : {&parts.first, &parts.second}) {
      part->error_ = error;
      part->measure();
    }
    return parts;
  }

  /// Values of all components at u in [0,1], as a vector of degree 0.
  Enclosed_vector at(double u) const
  {
    Enclosed_vector value;
    value.rank_ = rank_;
    for (std::size_t r = 0; r < rank_; ++r) {
      std::vector<double> b(component(r), component(r) + count());
      for (std::size_t n = b.size() - 1; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i) b[i] = (1 - u) * b[i] + u * b[i + 1];
      value.c_.push_back(b[0]);
    }
    value.error_ = detail::accumulated_error(error_, 4.0 * degree_, norm_);
    value.measure();
    return value;
  }

  /// The same over a short part [lo, hi] of the unit interval.
  Enclosed_vector over(double lo, double hi) const
  {
    Enclosed_vector value = at(lo + 0.5 * (hi - lo));
    value.error_ = (value.error_ + 2.0 * degree_ * norm_ * (hi - lo)) * (1 + 8 * operation_error);
    value.measure();
    return value;
  }

private:
  static std::vector<Bernstein<Interval, 1>> enclosures(const Vector_form& f)
  {
    std::vector<Bernstein<Interval, 1>> all;
    for (const auto& x : f) all.push_back(enclosing(x));
    return all;
  }

  void measure()
  {
    norm_ = 0;
    for (const double x : c_) norm_ = std::max(norm_, std::abs(x));
    norm_ = (norm_ + error_) * (1 + 2 * operation_error);
  }

  std::vector<double> c_;
  std::size_t rank_ = 0;
  int degree_ = 0;
  double error_ = 0, norm_ = 0;
};

/// factor·a + c, for a and c of the same rank and degree.
inline Enclosed_vector combined(const Bernstein<Bounded, 1>& factor, const Enclosed_vector& a, const Enclosed_vector& c)
{
  const auto form = [](const Enclosed_vector& x, std::size_t r) {
    return Bernstein<Bounded, 1>(Bernstein<double, 1>(Degrees<1>{x.degree()}, std::vector<double>(x.component(r), x.component(r) + x.count())), x.error());
  };
  std::vector<double> values;
  double error = 0;
  for (std::size_t r = 0; r < a.rank(); ++r) {
    const Bernstein<Bounded, 1> sum = add(multiply(factor, form(a, r)), form(c, r));
    values.insert(values.end(), sum.values().coefficients().begin(), sum.values().coefficients().end());
    error = std::max(error, sum.error());
  }
  return {a.rank(), a.degree() + factor.degree(), std::move(values), error};
}

/// The same vector written with a higher degree.
inline Enclosed_vector elevated(const Enclosed_vector& a, int by)
{
  if (by == 0) return a;
  std::vector<double> values;
  for (std::size_t r = 0; r < a.rank(); ++r) {
    const auto x = elevate(Bernstein<double, 1>(Degrees<1>{a.degree()}, std::vector<double>(a.component(r), a.component(r) + a.count())), 0, by);
    values.insert(values.end(), x.coefficients().begin(), x.coefficients().end());
  }
  return {a.rank(), a.degree() + by, std::move(values), detail::accumulated_error(a.error(), 5.0 * by, a.norm())};
}

/// The Bernstein coefficients of a(u)·b(v), those of one power of u in a row.
struct Product_table {
  std::size_t rows = 0, columns = 0;
  std::vector<double> c;
  double error = 0;

  double at(std::size_t i, std::size_t j) const { return c[i * columns + j]; }

  void make(const Enclosed_vector& a, const Enclosed_vector& b)
  {
    rows = a.count();
    columns = b.count();
    c.assign(rows * columns, 0.0);
    for (std::size_t r = 0; r < a.rank(); ++r) {
      const double *x = a.component(r), *y = b.component(r);
      for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) c[i * columns + j] += x[i] * y[j];
    }
    const auto rank = static_cast<double>(a.rank());
    const double inherited = rank * (a.error() * b.norm() + a.norm() * b.error());
    error = detail::accumulated_error(inherited, rank * (rank + 1), a.norm() * b.norm());
    if (!(std::max(a.norm(), b.norm()) < detail::overflow_guard)) error = std::numeric_limits<double>::infinity();
  }
};

} // namespace locus

#endif
