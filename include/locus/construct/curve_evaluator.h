// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CURVE_EVALUATOR_H
#define LOCUS_CONSTRUCT_CURVE_EVALUATOR_H

#include <locus/constraint/planar_curve.h>
#include <locus/function/bernstein_horner.h>
#include <locus/function/bounded_bernstein.h>
#include <locus/function/jet.h>

namespace locus {

/// A univariate polynomial on the unit interval with enclosures of its value and two derivatives over any range.
class Enclosed_function {
public:
  Enclosed_function() = default;

  explicit Enclosed_function(const Bernstein<Rational, 1>& f)
    : Enclosed_function(enclosing(f))
  {
  }

  explicit Enclosed_function(const Bernstein<Interval, 1>& f)
  {
    Bernstein<Bounded, 1> g = bounded(f);
    for (Order& order : orders_) {
      const Bernstein<Bounded, 1> next = derivative(g);
      order.f = g;
      order.error = detail::accumulated_error(g.error(), detail::horner_operations(g.degree()) + 4, g.norm());
      order.slope = g.degree() == 0 ? 0.0 : next.norm();
      g = next;
    }
  }

  /// Enclosure of the k-th derivative (k ≤ 2) over t, by its value in the middle and the next derivative's bound.
  Interval at(const Interval& t, std::size_t k = 0) const
  {
    const Order& order = orders_[k];
    const double lo = std::max(0.0, t.inf()), hi = std::min(1.0, t.sup());
    const double mid = std::min(hi, lo + 0.5 * (hi - lo));
    const double reach = std::max(hi - mid, mid - lo);
    double slope = order.slope;
    if (reach > 0x1p-20 && k + 1 < orders_.size()) { // over a wide range the slope nearby is worth a look
      const Order& next = orders_[k + 1];
      const double there = detail::horner_value(next.f.values().data(), next.f.degree(), mid);
      slope = std::min(slope, std::abs(there) + next.error + next.slope * reach);
    }
    const double radius = order.error + slope * reach;
    const double value = detail::horner_value(order.f.values().data(), order.f.degree(), mid);
    return Interval(value) + Interval(-radius, radius);
  }

  Jet<Interval> along(const Jet<Interval>& t) const { return compose(at(t.value, 0), at(t.value, 1), at(t.value, 2), t); }

private:
  struct Order {
    Bernstein<Bounded, 1> f;
    double error = 0, slope = 0;
  };
  std::array<Order, 3> orders_;
};

/// A planar vector over a field T.
template <class T>
struct Vector_2 {
  T x{0}, y{0};
};

template <class T>
Vector_2<T> operator-(const Vector_2<T>& a, const Vector_2<T>& b)
{
  return {a.x - b.x, a.y - b.y};
}

template <class T>
T dot(const Vector_2<T>& a, const Vector_2<T>& b)
{
  return a.x * b.x + a.y * b.y;
}

template <class T>
T cross(const Vector_2<T>& a, const Vector_2<T>& b)
{
  return a.x * b.y - a.y * b.x;
}

/// Point and tangent direction of a planar curve piece, in frame coordinates.
class Curve_evaluator {
public:
  Curve_evaluator() = default;
  explicit Curve_evaluator(const Planar_curve& c)
    : polynomial_(c.weight().degree() == 0 && c.weight()[0] == 1), x_(c.numerator(0)), y_(c.numerator(1)), w_(c.weight()),
      ax_(c.tangent(0)), ay_(c.tangent(1))
  {
  }

  /// T is Interval or Jet<Interval>.
  template <class T>
  Vector_2<T> point(const T& t) const
  {
    if (polynomial_) return {value(x_, t), value(y_, t)};
    const T w = value(w_, t);
    return {value(x_, t) / w, value(y_, t) / w};
  }

  /// Homogeneous coordinates of the point: `numerator` / `weight`.
  template <class T>
  Vector_2<T> numerator(const T& t) const
  {
    return {value(x_, t), value(y_, t)};
  }
  template <class T>
  T weight(const T& t) const
  {
    return value(w_, t);
  }

  template <class T>
  Vector_2<T> tangent(const T& t) const
  {
    return {value(ax_, t), value(ay_, t)};
  }

private:
  static Interval value(const Enclosed_function& f, const Interval& t) { return f.at(t); }
  static Jet<Interval> value(const Enclosed_function& f, const Jet<Interval>& t) { return f.along(t); }

  bool polynomial_ = true;
  Enclosed_function x_, y_, w_, ax_, ay_;
};

} // namespace locus

#endif
