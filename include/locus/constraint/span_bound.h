// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_SPAN_BOUND_H
#define LOCUS_CONSTRAINT_SPAN_BOUND_H

#include <locus/constraint/planar_curve.h>

#include <cmath>

namespace locus {

/// A disk around a planar curve piece and a sector around its tangents: enough to tell of most pairs of pieces that no
/// circle touches both, before any equation is built.
class Span_bound {
public:
  /// Upward rounding needed. Pieces that go to infinity or turn by more than a right angle to either side bound nothing.
  explicit Span_bound(const Planar_curve& c) { usable_ = set_disk(c) && set_sector(c); }

  /// Proves that F3 has no zero on the two pieces, ends included: F3 = 0 says 2·arg e = arg a + arg b (mod π), for the
  /// chord e and the tangents a, b. About 30 operations.
  friend bool are_apart(const Span_bound& p, const Span_bound& q)
  {
    if (!p.usable_ || !q.usable_) return false;
    const double ex = p.x_ - q.x_, ey = p.y_ - q.y_, square = ex * ex + ey * ey, reach = p.radius_ + q.radius_;
    if (!(reach * reach < 0.999 * square)) return false;
    // z = e²·conj(a)·conj(b) has modulus |e|²; its angle to the real line is at least asin|sin| ≥ |sin| + |sin|³/6.
    const double e2x = ex * ex - ey * ey, e2y = 2 * ex * ey;
    const double abx = p.ax_ * q.ax_ - p.ay_ * q.ay_, aby = p.ax_ * q.ay_ + p.ay_ * q.ax_;
    const double sine = std::abs(e2y * abx - e2x * aby) / square;
    const double chord_sine = reach / std::sqrt(square);
    const double angle = sine * (1 + sine * sine / 6);
    return 2 * arc_sine_bound(chord_sine) + p.angle_ + q.angle_ + margin < angle;
  }

private:
  /// Covers all roundings of `are_apart`, whose quantities are of size one and a few operations deep.
  static constexpr double margin = 0x1p-40;

  /// asin x ≤ x + (π/2 - 1)·x³ on [0,1].
  static double arc_sine_bound(double x) { return x + 0.5708 * x * x * x; }

  bool set_disk(const Planar_curve& c)
  {
    const auto &x = c.numerator_enclosure(0), &y = c.numerator_enclosure(1), &w = c.weight_enclosure();
    Interval box_x, box_y;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Interval& weight = w[w.size() == 1 ? 0 : i];
      if (!(weight.inf() > 0)) return false;
      const Interval px = x[i] / weight, py = y[i] / weight;
      box_x = i == 0 ? px : hull(box_x, px);
      box_y = i == 0 ? py : hull(box_y, py);
    }
    x_ = midpoint(box_x);
    y_ = midpoint(box_y);
    radius_ = std::hypot(std::max(box_x.sup() - x_, x_ - box_x.inf()), std::max(box_y.sup() - y_, y_ - box_y.inf())) * (1 + margin);
    return std::isfinite(radius_);
  }

  bool set_sector(const Planar_curve& c)
  {
    const auto &x = c.tangent_enclosure(0), &y = c.tangent_enclosure(1);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double length = std::hypot(midpoint(x[i]), midpoint(y[i]));
      if (!(length > 0)) continue;
      ax_ += midpoint(x[i]) / length;
      ay_ += midpoint(y[i]) / length;
    }
    const double length = std::hypot(ax_, ay_);
    if (!(length > 0)) return false;
    ax_ /= length;
    ay_ /= length;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i].inf() == 0 && x[i].sup() == 0 && y[i].inf() == 0 && y[i].sup() == 0) continue;
      const Interval along = Interval(ax_) * x[i] + Interval(ay_) * y[i], across = Interval(ax_) * y[i] - Interval(ay_) * x[i];
      const double norm = CGAL::sqrt(CGAL::square(x[i]) + CGAL::square(y[i])).inf();
      if (!(along.inf() > 0) || !(norm > 0)) return false;
      const double sine = std::min(1.0, magnitude(across) / norm * (1 + margin));
      angle_ = std::max(angle_, arc_sine_bound(sine) + margin);
    }
    return true;
  }

  bool usable_ = false;
  double x_ = 0, y_ = 0, radius_ = 0, ax_ = 0, ay_ = 0, angle_ = 0;
};

} // namespace locus

#endif
