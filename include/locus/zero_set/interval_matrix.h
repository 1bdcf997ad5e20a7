// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_INTERVAL_MATRIX_H
#define LOCUS_ZERO_SET_INTERVAL_MATRIX_H

#include <locus/function/bernstein_horner.h>
#include <locus/function/bounded_bernstein.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace locus {
namespace detail {

template <int K>
using Real_matrix = std::array<std::array<double, static_cast<std::size_t>(K)>, static_cast<std::size_t>(K)>;

/// K polynomials in K variables on the unit box, in bounded doubles.
template <int K>
using Bounded_forms = std::array<Bernstein<Bounded, K>, static_cast<std::size_t>(K)>;

/// An approximate inverse, by Gauss–Jordan elimination with row pivots: good enough or not, nothing is proved by it.
/// Nothing where an entry is no finite number.
template <int K>
std::optional<Real_matrix<K>> approximate_inverse(Real_matrix<K> a)
{
  constexpr auto size = static_cast<std::size_t>(K);
  Real_matrix<K> y{};
  for (std::size_t k = 0; k < size; ++k) y[k][k] = 1;
  for (std::size_t column = 0; column < size; ++column) {
    std::size_t pivot = column;
    for (std::size_t r = column + 1; r < size; ++r)
      if (std::abs(a[r][column]) > std::abs(a[pivot][column])) pivot = r;
    std::swap(a[pivot], a[column]);
    std::swap(y[pivot], y[column]);
    const double scale = 1 / a[column][column];
    if (!std::isfinite(scale)) return std::nullopt;
    for (std::size_t c = 0; c < size; ++c) {
      a[column][c] *= scale;
      y[column][c] *= scale;
    }
    for (std::size_t r = 0; r < size; ++r) {
      const double factor = a[r][column];
      if (r == column || factor == 0) continue;
      for (std::size_t c = 0; c < size; ++c) {
        a[r][c] -= factor * a[column][c];
        y[r][c] -= factor * y[column][c];
      }
    }
  }
  for (const auto& row : y)
    for (const double entry : row)
      if (!std::isfinite(entry)) return std::nullopt;
  return y;
}

/// The mean over the unit box of a partial derivative, without a bound of its error.
template <int K>
double mean_slope(const Bernstein<Bounded, K>& f, int variable)
{
  const Layout layout = layout_along(f.degrees(), variable);
  if (layout.count == 1) return 0;
  double sum = 0;
  for (std::size_t o = 0; o < layout.outer; ++o) {
    const double* const low = f.values().data() + o * layout.count * layout.inner;
    const double* const high = low + (layout.count - 1) * layout.inner;
    for (std::size_t i = 0; i < layout.inner; ++i) sum += high[i] - low[i];
  }
  return sum / static_cast<double>(layout.outer * layout.inner);
}

/// Σ_j y_j·f_j for polynomials of equal degrees.
template <int K>
Bernstein<Bounded, K> combined(const std::array<double, static_cast<std::size_t>(K)>& y, const Bounded_forms<K>& f)
{
  Bernstein<double, K> sum(f[0].degrees());
  double error = 0, norm = 0;
  for (std::size_t j = 0; j < y.size(); ++j) {
    const double* const c = f[j].values().data();
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += y[j] * c[i];
    error += std::abs(y[j]) * f[j].error();
    norm += std::abs(y[j]) * f[j].norm();
  }
  return {std::move(sum), accumulated_error(error * (1 + 8 * K * operation_error), 4.0 * K, norm)};
}

/// The system multiplied by the inverse of its mean Jacobian on the unit box: near a regular solution equation k is nearly
/// x_k minus a constant. Nothing where that matrix is singular. The solutions are the same if the matrix is regular, and
/// among the new system's in any case.
template <int K>
std::optional<Bounded_forms<K>> preconditioned(const Bounded_forms<K>& f)
{
  Real_matrix<K> slopes;
  for (std::size_t k = 0; k < f.size(); ++k)
    for (std::size_t v = 0; v < f.size(); ++v) slopes[k][v] = mean_slope(f[k], static_cast<int>(v));
  const auto y = approximate_inverse<K>(slopes);
  if (!y) return std::nullopt;
  Degrees<K> degrees = f[0].degrees();
  bool alike = true;
  for (const auto& g : f) {
    alike = alike && g.degrees() == degrees;
    degrees = max_degrees<K>(degrees, g.degrees());
  }
  Bounded_forms<K> raised;
  if (!alike)
    for (std::size_t k = 0; k < f.size(); ++k) raised[k] = elevated_to(f[k], degrees);
  Bounded_forms<K> p;
  for (std::size_t k = 0; k < f.size(); ++k) p[k] = combined<K>((*y)[k], alike ? f : raised);
  return p;
}

/// Bound of Σ_v |δ_kv - ∂f/∂x_v| over the unit box, δ being 1 for v = k and else 0: how far f is from x_k plus a
/// constant.
template <int K>
double deviation_from_variable(const Bernstein<Bounded, K>& f, int k)
{
  double sum = 0, operations = 0;
  const double norm = f.norm();
  for (int v = 0; v < K; ++v) {
    const Layout layout = layout_along(f.degrees(), v);
    const double n = f.degree(v), target = v == k ? 1 : 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    if (layout.count == 1) low = high = 0;
    for (std::size_t o = 0; o < layout.outer; ++o) {
      const double* const c = f.values().data() + o * layout.count * layout.inner;
      for (std::size_t i = 0; i < (layout.count - 1) * layout.inner; ++i) {
        const double difference = c[i + layout.inner] - c[i];
        low = std::min(low, difference);
        high = std::max(high, difference);
      }
    }
    sum += std::max(std::abs(target - n * low), std::abs(n * high - target));
    operations += 2 * n;
  }
  return accumulated_error(sum + operations * f.error(), 8 * K + 4 * operations, std::max(1.0, norm));
}

/// The greatest of these over the rows of a system. Below one, the system's Jacobian is strictly diagonally dominant on
/// the whole box as an interval matrix, so that two points of the box never have equal values.
template <int K>
double deviation_from_identity(const Bounded_forms<K>& p)
{
  double most = 0;
  for (std::size_t k = 0; k < p.size(); ++k) most = std::max(most, deviation_from_variable(p[k], static_cast<int>(k)));
  return most;
}

/// Values and derivatives of polynomials of given degrees at one point of the unit box, in doubles.
template <int K>
class Basis_at_point {
public:
  using Point = std::array<double, static_cast<std::size_t>(K)>;
  /// The value, then the partial derivatives.
  using Jet = std::array<double, static_cast<std::size_t>(K) + 1>;

  explicit Basis_at_point(const Degrees<K>& degrees) : degrees_(degrees)
  {
    for (std::size_t v = 0; v < degrees.size(); ++v) {
      weight_[v].resize(static_cast<std::size_t>(degrees[v]) + 1);
      slope_[v].resize(weight_[v].size());
      operations_ += 6.0 * degrees[v] + 4 + 2.0 * K;
    }
  }

  void move_to(const Point& x)
  {
    for (std::size_t v = 0; v < x.size(); ++v) {
      const int n = degrees_[v];
      std::vector<double>& slope = slope_[v];
      slope[0] = 0;
      if (n > 0) { // n·(B_(i-1) - B_i) of degree n-1
        bernstein_weights(n - 1, x[v], slope.data());
        slope[static_cast<std::size_t>(n)] = n * slope[static_cast<std::size_t>(n) - 1];
        for (std::size_t i = static_cast<std::size_t>(n) - 1; i > 0; --i) slope[i] = n * (slope[i - 1] - slope[i]);
        slope[0] *= -n;
      }
      bernstein_weights(n, x[v], weight_[v].data());
    }
  }

  /// `c` are the coefficients of a polynomial of these degrees.
  Jet jet(const double* c) const { return jet_from<0>(c); }

  /// The value with a bound of its error.
  Bounded value(const Bernstein<Bounded, K>& f) const
  {
    return {jet(f.values().data())[0], accumulated_error(f.error(), operations_, f.norm())};
  }

private:
  /// Over the variables from V on; `c` moves past the coefficients that were used.
  template <int V>
  Jet jet_from(const double*& c) const
  {
    Jet sum{};
    if constexpr (V == K) {
      sum[0] = *c++;
    } else {
      const auto& weight = weight_[V];
      const auto& slope = slope_[V];
      for (std::size_t i = 0; i < weight.size(); ++i) {
        const Jet inner = jet_from<V + 1>(c);
        sum[0] += weight[i] * inner[0];
        sum[V + 1] += slope[i] * inner[0];
        for (std::size_t w = V + 2; w <= static_cast<std::size_t>(K); ++w) sum[w] += weight[i] * inner[w];
      }
    }
    return sum;
  }

  Degrees<K> degrees_;
  std::array<std::vector<double>, static_cast<std::size_t>(K)> weight_, slope_;
  double operations_ = 0;
};

} // namespace detail
} // namespace locus

#endif
