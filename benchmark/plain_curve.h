// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BENCHMARK_PLAIN_CURVE_H
#define LOCUS_BENCHMARK_PLAIN_CURVE_H

// Bézier curves in plain doubles with the distance from a point, to judge what the peers return. Shares no code with
// the library.

#include "cases.h"

#include <cmath>

namespace locus_benchmark {

struct Point {
  double x = 0, y = 0;
};

inline Point middle(const Point& a, const Point& b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}; }
inline double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

class Plain_curve {
public:
  explicit Plain_curve(const Curve_data& data)
  {
    for (const auto& p : data.points) control_.push_back({p.x.value().get_d(), p.y.value().get_d()});
    for (const auto& w : data.weights) weights_.push_back(w.value().get_d());
    weights_.resize(control_.size(), 1.0);
    for (std::size_t i = 0; i <= samples; ++i) sampled_.push_back(at(static_cast<double>(i) / samples));
  }

  const std::vector<Point>& control() const { return control_; }
  const std::vector<double>& weights() const { return weights_; }

  Point at(double u) const
  {
    std::vector<double> x, y, w = weights_;
    for (std::size_t i = 0; i < control_.size(); ++i) {
      x.push_back(control_[i].x * w[i]);
      y.push_back(control_[i].y * w[i]);
    }
    for (std::size_t n = control_.size(); --n > 0;)
      for (std::size_t i = 0; i < n; ++i)
        for (auto* c : {&x, &y, &w}) (*c)[i] = (1 - u) * (*c)[i] + u * (*c)[i + 1];
    return {x[0] / w[0], y[0] / w[0]};
  }

  /// Distance from p: every local minimum of the samples' distances is narrowed by golden sections.
  double distance_from(const Point& p) const
  {
    double least = 1e300;
    for (std::size_t i = 0; i <= samples; ++i) {
      const double here = distance(p, sampled_[i]);
      if (i > 0 && distance(p, sampled_[i - 1]) < here) continue;
      if (i < samples && distance(p, sampled_[i + 1]) < here) continue;
      double lo = static_cast<double>(i > 0 ? i - 1 : 0) / samples, hi = static_cast<double>(std::min(i + 1, samples)) / samples;
      while (hi - lo > 1e-9) {
        const double a = hi - 0.6180339887498949 * (hi - lo), b = lo + 0.6180339887498949 * (hi - lo);
        (distance(p, at(a)) < distance(p, at(b)) ? hi : lo) = distance(p, at(a)) < distance(p, at(b)) ? b : a;
      }
      least = std::min({least, here, distance(p, at(0.5 * (lo + hi)))});
    }
    return least;
  }

private:
  static constexpr std::size_t samples = 500;

  std::vector<Point> control_, sampled_;
  std::vector<double> weights_;
};

/// How far a point is from being equally far from both curves.
inline double residual(const Plain_curve& a, const Plain_curve& b, const Point& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) ? std::abs(a.distance_from(p) - b.distance_from(p)) : 1e300;
}

} // namespace locus_benchmark

#endif
