// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_PARAMETERS_H
#define LOCUS_IO_SVG_PARAMETERS_H

#include <locus/io/picked_parameter.h>
#include <locus/io/svg_curve.h>

namespace locus {

namespace detail {

/// Where the values of one parameter are drawn: at themselves, or, if the domain is infinite, each piece one unit long.
class Parameter_axis {
public:
  struct Knot {
    double at = 0;
    double value = 0;
    bool is_corner = false;
  };

  Parameter_axis() : Parameter_axis(0, 1) {}

  explicit Parameter_axis(const Pictured_curve& curve) : curve_(&curve), is_closed_(curve.is_closed())
  {
    const auto n = static_cast<std::size_t>(curve.size());
    for (std::size_t k = 0; k <= n; ++k) {
      const bool inner = k > 0 && k < n;
      const double value = curve.knot(k);
      knots_.push_back({curve.is_finite() ? value : static_cast<double>(k), value,
                        inner && curve.joints()[k - 1].kind == Joint_kind::corner});
    }
  }

  /// Without a curve: a range of values.
  Parameter_axis(double lo, double hi)
  {
    knots_.push_back({lo, lo, false});
    knots_.push_back({hi, hi, false});
  }

  double lo() const { return knots_.front().at; }
  double hi() const { return knots_.back().at; }
  bool is_closed() const { return is_closed_; }
  const std::vector<Knot>& knots() const { return knots_; }

  double at(double u) const
  {
    if (curve_ && !curve_->is_finite()) return curve_->place(u);
    return std::isnan(u) ? lo() : std::min(hi(), std::max(lo(), u));
  }

private:
  const Pictured_curve* curve_ = nullptr;
  bool is_closed_ = false;
  std::vector<Knot> knots_;
};

/// The square of the parameters t (to the right) and r (upwards); of a self-bisector only its triangle t ≥ r counts.
struct Parameter_square {
  std::array<Parameter_axis, 2> axes;
  bool is_self = false;

  Picture_box box() const
  {
    Picture_box b;
    b.add({axes[0].lo(), axes[1].lo()});
    b.add({axes[0].hi(), axes[1].hi()});
    return b;
  }

  Picture_point at(double t, double r) const { return {axes[0].at(t), axes[1].at(r)}; }

  /// Curves through points; where one leaves the square at a closed input's seam, it comes back on the other side.
  std::vector<std::vector<Picture_point>> parts(const std::vector<Picture_point>& points) const
  {
    std::vector<std::vector<Picture_point>> out(1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) {
        Picture_point forward, backward;
        if (crosses_seam(points[i - 1], points[i], forward) && crosses_seam(points[i], points[i - 1], backward)) {
          out.back().push_back(forward);
          out.push_back({backward});
        }
      }
      out.back().push_back(points[i]);
    }
    return out;
  }

private:
  /// Is another image of q, beyond a seam, much nearer to p than q itself? Across the seam of a self-bisector the
  /// parameters change places.
  bool crosses_seam(const Picture_point& p, const Picture_point& q, Picture_point& image) const
  {
    const auto distance = [&](const Picture_point& x) { return std::hypot(x.x - p.x, x.y - p.y); };
    double best = 0.5 * distance(q);
    bool found = false;
    const auto consider = [&](const Picture_point& x) {
      if (!(distance(x) < best)) return;
      best = distance(x);
      image = x;
      found = true;
    };
    for (int i = axes[0].is_closed() ? -1 : 0; i <= (axes[0].is_closed() ? 1 : 0); ++i)
      for (int j = axes[1].is_closed() ? -1 : 0; j <= (axes[1].is_closed() ? 1 : 0); ++j) {
        const double x = i * (axes[0].hi() - axes[0].lo()), y = j * (axes[1].hi() - axes[1].lo());
        consider({q.x + x, q.y + y});
        if (is_self && (i != 0 || j != 0)) consider({q.y + x, q.x + y});
      }
    return found;
  }
};

} // namespace detail

} // namespace locus

#endif
