// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_IMAGE_H
#define LOCUS_IO_SVG_IMAGE_H

#include <locus/io/svg_curve.h>
#include <locus/shape/rational_map.h>

namespace locus {

namespace detail {

/// A piece of a derived rational curve as it passes through a box, in steps as short as are needed to see it smooth. Unlike an
/// input it may have poles anywhere.
class Pictured_image {
public:
  /// Steps end where the curve is within `fine` of its chord.
  Pictured_image(Pictured_forms forms, const Picture_box& box, double fine) : forms_(std::move(forms)), box_(box), fine_(fine)
  {
    constexpr int steps = 64;
    Sample last = sample(0);
    start_at(last);
    for (int i = 1; i <= steps; ++i) {
      const Sample next = sample(static_cast<double>(i) / steps);
      follow(last, next, 24);
      last = next;
    }
  }

  /// Points along it, one list for each part between poles.
  const std::vector<std::vector<Picture_point>>& parts() const { return parts_; }

private:
  struct Sample {
    double s = 0;
    Picture_point point;
    bool positive = true; ///< the weight
  };

  Sample sample(double s) const { return {s, forms_.at(s), forms_.weight_at(s) > 0}; }

  void start_at(const Sample& first) { parts_.push_back({first.point}); }

  void follow(const Sample& from, const Sample& to, int halvings)
  {
    const Sample middle = sample(0.5 * (from.s + to.s));
    if (halvings > 0 && !is_seen(from, middle, to)) {
      follow(from, middle, halvings - 1);
      follow(middle, to, halvings - 1);
    } else if (from.positive == to.positive) {
      parts_.back().push_back(to.point);
    } else { // through infinity, to the opposite side
      start_at(to);
    }
  }

  bool is_seen(const Sample& from, const Sample& middle, const Sample& to) const
  {
    if (from.positive != middle.positive || middle.positive != to.positive) return false;
    const Picture_point &p = from.point, &m = middle.point, &q = to.point;
    if (box_.beyond(p, q) && box_.beyond(p, m) && box_.beyond(m, q)) return true;
    return std::hypot(m.x - 0.5 * (p.x + q.x), m.y - 0.5 * (p.y + q.y)) <= fine_;
  }

  Pictured_forms forms_;
  Picture_box box_;
  double fine_;
  std::vector<std::vector<Picture_point>> parts_;
};

} // namespace detail

} // namespace locus

#endif
