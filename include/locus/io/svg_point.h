// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_POINT_H
#define LOCUS_IO_SVG_POINT_H

#include <locus/io/svg_cell.h>
#include <locus/io/svg_image.h>
#include <locus/io/svg_marks.h>

namespace locus {

namespace detail {

/// How the parts of a point's bisector look, in the picture and in its legend.
struct Point_style {
  static std::string cell() { return std::string("fill=\"") + picture::point_cell + "\""; }
  static std::string region() { return std::string("fill=\"") + picture::degenerate_hatch + "\" fill-opacity=\"0.5\""; }
  static std::string untrimmed() { return stroke(picture::untrimmed, 1.2, " stroke-dasharray=\"4 3.5\""); }
  static std::string feet() { return stroke(picture::foot, 1.1); }
  static std::string undecided() { return stroke(picture::alarm, 8, " stroke-opacity=\"0.35\""); }
};

inline std::string arc_style(const char* colour, Arc_look look)
{
  return stroke(colour, 2.5, look == Arc_look::at_end ? " stroke-dasharray=\"12 4.5\"" : "");
}

/// A point that is an input: a disc.
inline void svg_input_point(std::ostream& out, const Picture_point& at)
{
  svg_circle(out, at, 4.5, filled(picture::input[1], "#ffffff", 1.4));
}

/// What the plane shows of a point's bisector beside its arcs.
class Point_drawing {
public:
  Point_drawing(std::ostream& out, const Picture_scene& scene, const Panel& panel) : out_(out), scene_(scene), panel_(panel) {}

  /// Under all else: the cell of points that are nearer to the point or, where it lies on the curve, as near.
  void write_cell()
  {
    if (!scene_.has_cell() && scene_.locus.regions().empty()) return;
    Picture_box near = panel_.box();
    near.grow(0.05 * near.size());
    svg_path(out_, panel_.polygon(Cell_polygon(scene_, near).points()),
             scene_.has_cell() ? Point_style::cell() : Point_style::region());
  }

  /// Under the arcs.
  void write_behind()
  {
    write_untrimmed();
    write_feet();
    write_undecided();
  }

  void write_points()
  {
    for (std::size_t k = 0; k < scene_.points.size(); ++k) {
      const Picture_point& p = scene_.points[k];
      if (!panel_.box().contains(p)) continue;
      const Picture_point at = panel_.at(p);
      svg_input_point(out_, at);
      const Picture_point label = label_place(at);
      svg_text(out_, {label.x, label.y + 4.5}, k == 0 ? "p" : "q", label_style(picture::input[1], "middle") + " font-style=\"italic\"");
    }
  }

private:
  /// What was trimmed can be seen of the whole untrimmed bisector.
  void write_untrimmed()
  {
    if (!scene_.has_untrimmed()) return;
    constexpr double fine = 0.25; // pixels
    Picture_box near = panel_.box();
    near.grow(0.1 * near.size());
    std::string d;
    for (const auto& piece : scene_.locus.rational_curve()->pieces()) {
      const Pictured_image image(Pictured_forms(piece.numerator, piece.weight, scene_.origin()), near, fine * near.width() / panel_.width());
      for (const std::vector<Picture_point>& part : image.parts()) d += panel_.path(part);
    }
    svg_path(out_, d, Point_style::untrimmed());
  }

  /// Above a point of the page; elsewhere beside it if there is more room between the lines.
  Picture_point label_place(const Picture_point& at) const
  {
    constexpr double away = 14, enough = 11; // pixels
    const std::array<Picture_point, 4> places{{{at.x, at.y - away}, {at.x + away, at.y}, {at.x - away, at.y}, {at.x, at.y + away}}};
    std::array<double, 4> room{};
    for (std::size_t i = 0; i < places.size(); ++i) room[i] = std::min(enough, room_at(places[i]));
    return places[static_cast<std::size_t>(std::max_element(room.begin(), room.end()) - room.begin())];
  }

  double room_at(const Picture_point& place) const
  {
    double least = std::numeric_limits<double>::infinity();
    const auto add = [&](const std::vector<Picture_point>& line) {
      for (std::size_t i = 1; i < line.size(); ++i)
        if (line[i - 1].is_finite() && line[i].is_finite())
          least = std::min(least, distance_to_segment(place, panel_.at(line[i - 1]), panel_.at(line[i])));
    };
    for (const Pictured_curve& curve : scene_.curves)
      for (const std::vector<Picture_point>& part : curve.parts()) add(part);
    for (const Picture_scene::Drawn_arc& arc : scene_.arcs) add(arc.plane);
    return least;
  }

  /// From the trim vertices to all their feet.
  void write_feet()
  {
    std::string d;
    for (const Locus_vertex<2>& v : scene_.locus.vertices()) {
      if (v.kind != Vertex_kind::trim || !v.point || !panel_.box().contains(scene_.placed(*v.point))) continue;
      for (const Foot& foot : v.feet)
        if (const auto at = scene_.point_of(foot)) d += panel_.path({scene_.placed(*v.point), *at});
    }
    svg_path(out_, d, Point_style::feet());
  }

  /// The parts of the curve of which it is not known whether they have a share in the bisector.
  void write_undecided()
  {
    if (scene_.curves.empty()) return;
    std::string d;
    for (const Undecided_piece& piece : scene_.locus.undecided())
      if (piece.box.size() == 1) d += panel_.path(scene_.curves[0].between(piece.box[0].lo, piece.box[0].hi));
    svg_path(out_, d, Point_style::undecided());
  }

  std::ostream& out_;
  const Picture_scene& scene_;
  const Panel& panel_;
};

} // namespace detail

} // namespace locus

#endif
