// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_CELL_H
#define LOCUS_IO_SVG_CELL_H

#include <locus/io/svg_scene.h>

namespace locus {

namespace detail {

/// The part of a polygon in a box; convex if the polygon is.
inline std::vector<Picture_point> clipped(std::vector<Picture_point> polygon, const Picture_box& box)
{
  struct Side {
    double x, y, from; ///< inside x·p.x + y·p.y ≥ from
  };
  for (const Side& side : {Side{1, 0, box.x0}, Side{-1, 0, -box.x1}, Side{0, 1, box.y0}, Side{0, -1, -box.y1}}) {
    const auto depth = [&](const Picture_point& p) { return side.x * p.x + side.y * p.y - side.from; };
    std::vector<Picture_point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Picture_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double a = depth(p), b = depth(q);
      if (a >= 0) kept.push_back(p);
      if ((a >= 0) != (b >= 0)) kept.push_back({p.x + a / (a - b) * (q.x - p.x), p.y + a / (a - b) * (q.y - p.y)});
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// The convex cell of the points that are nearest to one input, as a polygon: its arcs counterclockwise and, where it is not
/// bounded, the way round the picture from the one's direction to infinity to the next one's.
class Cell_polygon {
public:
  Cell_polygon(const Picture_scene& scene, const Picture_box& box) : scene_(scene), box_(box) {}

  /// The part in the box. Empty where the locus bounds no cell, or not all of it is known.
  std::vector<Picture_point> points()
  {
    const auto& outline = scene_.locus.outline();
    if (!outline || !scene_.locus.undecided().empty()) return {};
    const std::size_t n = outline->arcs.size();
    for (std::size_t k = 0; k < n; ++k) {
      add_arc(outline->arcs[k], outline->reversed[k] != 0);
      const Ray out = ray(k, true), in = ray((k + 1) % n, false);
      if (out.direction && in.direction) go_round(out, in);
    }
    const auto is_finite = [](const Picture_point& p) { return p.is_finite(); };
    return std::all_of(polygon_.begin(), polygon_.end(), is_finite) ? clipped(polygon_, box_) : std::vector<Picture_point>{};
  }

private:
  /// An end of an arc of the outline; with a direction where it goes to infinity.
  struct Ray {
    Picture_point start;
    std::optional<Approximate_point<2>> direction;
  };

  void add_arc(std::size_t a, bool reversed)
  {
    std::vector<Picture_point> points = scene_.arcs[a].plane;
    if (reversed) std::reverse(points.begin(), points.end());
    polygon_.insert(polygon_.end(), points.begin(), points.end());
  }

  Ray ray(std::size_t k, bool at_last) const
  {
    const auto& outline = *scene_.locus.outline();
    const std::size_t a = outline.arcs[k];
    const bool at_target = at_last == (outline.reversed[k] == 0);
    const std::vector<Picture_point>& points = scene_.arcs[a].plane;
    const auto vertex = at_target ? scene_.locus.arcs()[a].target() : scene_.locus.arcs()[a].source();
    if (!vertex || points.empty()) return {};
    return {at_target ? points.back() : points.front(), scene_.locus.vertices()[*vertex].direction};
  }

  /// Far from the picture, counterclockwise. A cell's directions to infinity hardly span all of a turn.
  void go_round(const Ray& out, const Ray& in)
  {
    constexpr double pi = 3.14159265358979323846;
    constexpr int steps = 24;
    const auto angle = [](const Ray& r) { return std::atan2((*r.direction)[1], (*r.direction)[0]); };
    double turn = angle(in) - angle(out);
    if (turn < 0) turn += 2 * pi;
    if (turn > 2 * pi - 1e-6) turn = 0; // the same direction, but for rounding
    for (int i = 0; i <= steps; ++i) {
      const double at = angle(out) + turn * i / steps, share = static_cast<double>(i) / steps;
      const Picture_point from{out.start.x + share * (in.start.x - out.start.x), out.start.y + share * (in.start.y - out.start.y)};
      polygon_.push_back({from.x + far() * std::cos(at), from.y + far() * std::sin(at)});
    }
  }

  double far() const { return 16 * box_.size(); }

  const Picture_scene& scene_;
  Picture_box box_;
  std::vector<Picture_point> polygon_;
};

} // namespace detail

} // namespace locus

#endif
