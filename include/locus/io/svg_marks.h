// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_MARKS_H
#define LOCUS_IO_SVG_MARKS_H

#include <locus/construct/curvature_points.h>
#include <locus/construct/locus.h>
#include <locus/io/svg_elements.h>

namespace locus {

namespace detail {

/// A closed polygon given by offsets in pixels.
inline void svg_shape(std::ostream& out, const Picture_point& at, const std::vector<Picture_point>& offsets,
                      const std::string& style)
{
  std::string d;
  for (const Picture_point& o : offsets) d += (d.empty() ? "M" : "L") + pixels(Picture_point{at.x + o.x, at.y + o.y});
  svg_path(out, d + "Z", style);
}

/// The mark of a vertex; each kind has a shape of its own.
inline void svg_vertex(std::ostream& out, const Picture_point& at, Vertex_kind kind, const char* component)
{
  const std::string ring = filled("#ffffff", component, 1.8);
  switch (kind) {
  case Vertex_kind::node:
    svg_circle(out, at, 4.5, filled(picture::ink, "#ffffff", 1.2));
    break;
  case Vertex_kind::isolated:
    svg_circle(out, at, 6.5, ring);
    svg_circle(out, at, 2.5, std::string("fill=\"") + component + "\"");
    break;
  case Vertex_kind::undecided:
    svg_circle(out, at, 5, filled("#ffe3e3", picture::alarm, 1.8));
    break;
  case Vertex_kind::infinity:
    svg_shape(out, at, {{0, -5.5}, {5.5, 0}, {0, 5.5}, {-5.5, 0}}, ring);
    break;
  case Vertex_kind::corner:
    svg_shape(out, at, {{-3.6, -3.6}, {3.6, -3.6}, {3.6, 3.6}, {-3.6, 3.6}}, ring);
    break;
  case Vertex_kind::diagonal:
    svg_shape(out, at, {{0, -5.5}, {5, 3.6}, {-5, 3.6}}, ring);
    break;
  case Vertex_kind::boundary:
  case Vertex_kind::trim:
    svg_circle(out, at, 3.2, ring);
    break;
  }
}

/// The mark of a point of a curve's curvature, after Figure 1 of Chen, Riesenfeld & Cohen.
inline void svg_curvature_point(std::ostream& out, const Picture_point& at, Curvature_event kind)
{
  const auto style = [](const char* colour) { return filled(colour, "#ffffff", 1.2); };
  switch (kind) {
  case Curvature_event::extremum:
    svg_circle(out, at, 5, style(picture::alarm));
    break;
  case Curvature_event::kink:
  case Curvature_event::jump:
    svg_circle(out, at, 5, filled("#ffffff", picture::alarm, 2.2));
    break;
  case Curvature_event::stationary:
    svg_shape(out, at, {{-4.2, -4.2}, {4.2, -4.2}, {4.2, 4.2}, {-4.2, 4.2}}, style(picture::alarm));
    break;
  case Curvature_event::inflection:
    svg_shape(out, at, {{0, -6}, {6, 0}, {0, 6}, {-6, 0}}, style(picture::degenerate));
    break;
  case Curvature_event::torsion_zero:
  case Curvature_event::cusp:
    svg_shape(out, at, {{0, -6}, {5.4, 4}, {-5.4, 4}}, style(picture::ink));
    break;
  }
}

/// A joint of an input: a tick across the curve whose direction in pixels is given, or a square where it turns.
inline void svg_joint(std::ostream& out, const Picture_point& at, const Picture_point& along, bool corner, const char* colour)
{
  if (corner) {
    svg_shape(out, at, {{-3.4, -3.4}, {3.4, -3.4}, {3.4, 3.4}, {-3.4, 3.4}}, std::string("fill=\"") + colour + "\"");
    return;
  }
  const double length = std::hypot(along.x, along.y);
  if (!(length > 0) || !std::isfinite(length)) return;
  const Picture_point across{-5 * along.y / length, 5 * along.x / length};
  const Picture_point from{at.x - across.x, at.y - across.y}, to{at.x + across.x, at.y + across.y};
  svg_path(out, "M" + pixels(from) + "L" + pixels(to), stroke(colour, 1.4));
}

} // namespace detail

} // namespace locus

#endif
