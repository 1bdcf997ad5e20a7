// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_PLANE_H
#define LOCUS_IO_SVG_PLANE_H

#include <locus/io/svg_point.h>

namespace locus {

namespace detail {

/// The inputs; of a point's bisector also trim vertices and their feet that are not far away.
inline Picture_box essential_box(const Picture_scene& scene)
{
  Picture_box box;
  for (const Pictured_curve& curve : scene.curves)
    for (const Picture_point& p : curve.essential_points(scene.has_point)) box.add(p);
  for (const Picture_point& p : scene.points) box.add(p);
  if (box.empty() || !scene.has_point) return box;
  Picture_box limit = box;
  limit.grow(1.2 * box.size());
  for (const Locus_vertex<2>& v : scene.locus.vertices()) {
    if (!v.point || !limit.contains(scene.placed(*v.point))) continue;
    box.add(scene.placed(*v.point));
    for (const Foot& foot : v.feet)
      if (const auto p = scene.point_of(foot); p && limit.contains(*p)) box.add(*p);
  }
  return box;
}

/// The inputs and what of the locus is near them, in a box of the given width : height.
inline Picture_box plane_box(const Picture_scene& scene, double aspect)
{
  Picture_box box = essential_box(scene);
  if (box.empty() || !(box.size() > 0)) {
    const double r = 0.35 * scene.locus.scale();
    box.add({-r, -r});
    box.add({r, r});
  }
  Picture_box limit = box;
  const bool is_narrow = scene.locus.compute() == "evolute" || scene.is_true();
  limit.grow((is_narrow ? 0.3 : scene.has_point ? 0.8 : 0.6) * box.size());
  for (const Picture_scene::Drawn_arc& arc : scene.arcs)
    for (std::size_t i = 1; i < arc.plane.size(); ++i) {
      Picture_point p = arc.plane[i - 1], q = arc.plane[i];
      if (!limit.clip(p, q)) continue;
      box.add(p);
      box.add(q);
    }
  box.grow(0.15 * box.size(), (scene.has_point ? 0.15 : 0.08) * box.size()); // room for labels
  const double wanted = std::max(box.width(), box.height() * aspect);
  box.grow(0.5 * (wanted - box.width()), 0.5 * (wanted / aspect - box.height()));
  return box;
}

/// Draws the plane: inputs, arcs, lines to the feet, asymptotes and vertices.
class Plane_drawing {
public:
  Plane_drawing(std::ostream& out, const Picture_scene& scene, const Panel& panel) : out_(out), scene_(scene), panel_(panel) {}

  void write()
  {
    out_ << "<g clip-path=\"url(#clip-" << panel_.name() << ")\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    Point_drawing point(out_, scene_, panel_);
    if (scene_.has_point) point.write_cell();
    else write_two_cells();
    for (const Asymptote<2>& asymptote : scene_.asymptotes()) write_asymptote(asymptote);
    if (scene_.has_point) point.write_behind();
    else if (scene_.foot_curve(1)) write_feet();
    for (std::size_t k = 0; k < scene_.curves.size(); ++k) write_curve(k);
    for (std::size_t a = 0; a < scene_.arcs.size(); ++a) write_arc(a);
    write_vertices();
    write_marks();
    out_ << "</g>\n";
    for (std::size_t k = 0; k < scene_.curves.size(); ++k) write_ends(k);
    point.write_points();
    svg_frame(out_, panel_);
    write_scale();
  }

private:
  static const char* input_colour(std::size_t k) { return picture::input[k % 2]; }

  /// The points that are nearer to either curve, in the curves' own tints.
  void write_two_cells()
  {
    const auto& outline = scene_.locus.outline();
    if (!outline) return;
    Picture_box near = panel_.box();
    near.grow(0.05 * near.size());
    const auto fill = [](std::size_t input) { return std::string("fill=\"") + picture::input_cell[input] + "\""; };
    svg_rectangle(out_, {panel_.left(), panel_.top()}, panel_.width(), panel_.height(), fill(1 - outline->input));
    svg_path(out_, panel_.polygon(Cell_polygon(scene_, near).points()), fill(outline->input));
  }

  void write_asymptote(const Asymptote<2>& asymptote)
  {
    const double far = 4 * panel_.box().size();
    const Picture_point p = scene_.placed(asymptote.point), d{asymptote.direction[0], asymptote.direction[1]};
    svg_path(out_, panel_.path({{p.x - far * d.x, p.y - far * d.y}, {p.x + far * d.x, p.y + far * d.y}}),
             stroke(picture::foot, 1.2, picture::dashes));
  }

  void write_arc(std::size_t a)
  {
    const Picture_scene::Drawn_arc& arc = scene_.arcs[a];
    svg_path(out_, panel_.path(arc.plane), arc_style(component_colour(scene_.components.of_arc[a]), arc.look));
  }

  /// Length in pixels between two samples that are both visible, else 0.
  double visible_length(const Arc_point<2>& from, const Arc_point<2>& to) const
  {
    const Picture_point p = scene_.placed(from.point()), q = scene_.placed(to.point());
    if (!panel_.box().contains(p) || !panel_.box().contains(q)) return 0;
    return std::hypot(panel_.at(q).x - panel_.at(p).x, panel_.at(q).y - panel_.at(p).y);
  }

  /// From points of each arc, about equally spaced where it is visible, to their feet.
  void write_feet()
  {
    double total = 0;
    for (const Picture_scene::Drawn_arc& arc : scene_.arcs)
      for (std::size_t i = 1; i < arc.samples.size(); ++i) total += visible_length(arc.samples[i - 1], arc.samples[i]);
    constexpr double least_spacing = 42, most_lines = 64; // pixels
    const double spacing = std::max(least_spacing, total / most_lines);
    std::string d;
    for (const Picture_scene::Drawn_arc& arc : scene_.arcs) {
      double since = 0.5 * spacing;
      for (std::size_t i = 1; i < arc.samples.size(); ++i) {
        since += visible_length(arc.samples[i - 1], arc.samples[i]);
        if (since < spacing || !panel_.box().contains(scene_.placed(arc.samples[i].point()))) continue;
        since = 0;
        d += feet_of(arc.samples[i]);
      }
    }
    svg_path(out_, d, stroke(picture::foot, 0.8, " stroke-opacity=\"0.75\""));
  }

  std::string feet_of(const Arc_point<2>& p) const
  {
    std::vector<Picture_point> line{{}, scene_.placed(p.point()), {}};
    for (std::size_t k = 0; k < 2 && k < p.parameters().size(); ++k)
      line[2 * k] = scene_.foot_curve(k)->at(picked(p.parameters()[k]));
    return panel_.path(line);
  }

  void write_curve(std::size_t k)
  {
    const Pictured_curve& curve = scene_.curves[k];
    for (const std::vector<Picture_point>& part : curve.parts()) svg_path(out_, panel_.path(part), stroke(input_colour(k), 2.5));
    constexpr double beside = 1e-3;
    for (std::size_t j = 0; j < curve.joints().size(); ++j) {
      const bool seam = j + 1 == static_cast<std::size_t>(curve.size());
      const double before = static_cast<double>(j) + 1, after = seam ? 0 : before;
      const Picture_point at = curve.at_place(after), p = curve.at_place(before - beside), q = curve.at_place(after + beside);
      if (curve.joints()[j].kind == Joint_kind::pole || !panel_.box().contains(at)) continue;
      const Picture_point from = panel_.at(p), to = panel_.at(q);
      const bool corner = curve.joints()[j].kind == Joint_kind::corner;
      svg_joint(out_, panel_.at(at), {to.x - from.x, to.y - from.y}, corner, input_colour(k));
    }
  }

  void write_vertices()
  {
    for (std::size_t v = 0; v < scene_.locus.vertices().size(); ++v) {
      const Locus_vertex<2>& vertex = scene_.locus.vertices()[v];
      if (!vertex.point) continue;
      const Picture_point p = scene_.placed(*vertex.point);
      if (panel_.box().contains(p)) svg_vertex(out_, panel_.at(p), vertex.kind, component_colour(scene_.components.of_vertex[v]));
    }
  }

  /// Marked points of the first input, joined with their centres of curvature where those can be seen.
  void write_marks()
  {
    std::string d;
    for (const Curvature_point<2>& p : scene_.marks)
      if (p.centre) d += panel_.path({scene_.placed(p.point), scene_.placed(*p.centre)});
    svg_path(out_, d, stroke(picture::foot, 1, picture::dashes));
    for (const Curvature_point<2>& p : scene_.marks)
      if (panel_.box().contains(scene_.placed(p.point))) svg_curvature_point(out_, panel_.at(scene_.placed(p.point)), p.kind);
  }

  // ------------------------------------------------------------------------------------------------ ends of the inputs

  /// The start filled, the finish open, with the parameter's values; a closed curve's seam; where a curve goes to infinity.
  void write_ends(std::size_t k)
  {
    const Pictured_curve& curve = scene_.curves[k];
    const std::string name = scene_.parameter_name(k);
    if (curve.is_closed() && !curve.is_pole(0, false)) {
      const std::string first = curve.is_finite() ? label_of(curve.start(), 3) + ", " : "";
      write_seam(k, name + " = " + first + label_of(curve.finish(), 3));
      return;
    }
    const auto last = static_cast<std::size_t>(curve.size()) - 1;
    for (const bool start : {true, false}) {
      const std::string value = label_of(start ? curve.start() : curve.finish(), 3);
      if (curve.is_pole(start ? 0 : last, !start)) write_departure(k, start, name + " → " + value);
      else write_end(k, start, name + " = " + value);
    }
  }

  /// The label goes away from the middle of the curve.
  void write_seam(std::size_t k, const std::string& text)
  {
    Picture_box box;
    for (const Picture_point& p : scene_.curves[k].essential_points()) box.add(p);
    const Picture_point at = panel_.at(scene_.curves[k].at_place(0));
    const Picture_point middle = panel_.at({0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)});
    svg_circle(out_, at, 4, filled(input_colour(k), input_colour(k), 2));
    write_label(k, at, {at.x - middle.x, at.y - middle.y}, text);
  }

  void write_end(std::size_t k, bool start, const std::string& text)
  {
    const Pictured_curve& curve = scene_.curves[k];
    const char* colour = input_colour(k);
    const double u = start ? 0 : curve.size(), step = curve.size() / 32;
    const Picture_point p = panel_.at(curve.at_place(u)), inner = panel_.at(curve.at_place(start ? u + step : u - step));
    svg_circle(out_, p, 4, filled(start ? colour : "#ffffff", colour, 2));
    write_label(k, p, {p.x - inner.x, p.y - inner.y}, text);
  }

  /// A label that goes on from a point in the given direction.
  void write_label(std::size_t k, const Picture_point& p, const Picture_point& direction, const std::string& text)
  {
    double dx = direction.x, dy = direction.y;
    const double length = std::hypot(dx, dy);
    dx = length > 0 ? dx / length : 1;
    dy = length > 0 ? dy / length : 0;
    const double width = 7.2 * letters(text) + 14;
    const bool sideways = std::abs(dx) > 0.4 && (dx > 0 ? p.x + width < panel_.right() : p.x - width > panel_.left());
    const char* anchor = !sideways ? "middle" : dx > 0 ? "start" : "end";
    const double below = dy < 0 ? -11 : 20;
    const Picture_point at{sideways ? p.x + 10 * dx : p.x, sideways ? p.y + 12 * dy + 4.5 : p.y + below};
    svg_text(out_, at, text, label_style(input_colour(k), anchor));
  }

  /// A label beside the last visible point towards infinity.
  void write_departure(std::size_t k, bool start, const std::string& text)
  {
    const std::vector<std::vector<Picture_point>> parts = scene_.curves[k].parts();
    std::vector<Picture_point> way = start ? parts.front() : parts.back();
    if (!start) std::reverse(way.begin(), way.end());
    const double width = 7.2 * letters(text) + 10;
    for (const Picture_point& point : way) {
      const Picture_point p = panel_.at(point);
      if (!panel_.box().contains(point) || p.y < panel_.top() + 18 || p.y > panel_.bottom() - 12) continue;
      const bool before = p.x + width > panel_.right();
      if (p.x < panel_.left() + 4 || p.x > panel_.right() - 4) continue;
      svg_text(out_, {p.x + (before ? -9 : 9), p.y + 4}, text, label_style(input_colour(k), before ? "end" : "start"));
      return;
    }
  }

  /// A bar of a round length under the panel, instead of axes.
  void write_scale()
  {
    const double unit = panel_.box().width() / panel_.width(); // length of a pixel
    const double wanted = 110 * unit;
    double length = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double f : {5.0, 2.0})
      if (f * length <= wanted) {
        length *= f;
        break;
      }
    if (!(length > 0) || !std::isfinite(length)) return;
    const double x = panel_.left() + 2, y = panel_.bottom() + 18, w = length / unit;
    svg_path(out_, "M" + pixels(x) + " " + pixels(y - 4) + "v8m0 -4h" + pixels(w) + "m0 -4v8", stroke(picture::faint_ink, 1.2));
    svg_text(out_, {x + w + 8, y + 4.5}, label_of(length), std::string("font-size=\"13\" fill=\"") + picture::faint_ink + "\"");
  }

  std::ostream& out_;
  const Picture_scene& scene_;
  const Panel& panel_;
};

} // namespace detail

} // namespace locus

#endif
