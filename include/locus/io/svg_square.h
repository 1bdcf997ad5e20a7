// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_SQUARE_H
#define LOCUS_IO_SVG_SQUARE_H

#include <locus/io/svg_marks.h>
#include <locus/io/svg_parameters.h>
#include <locus/io/svg_scene.h>

namespace locus {

namespace detail {

/// The parameters' axes as the inputs have them; without inputs, what cells and arcs need.
inline Parameter_square parameter_square(const Picture_scene& scene)
{
  Parameter_square square;
  square.is_self = scene.is_self;
  Picture_box used;
  for (const Cell_picture& cell : scene.locus.cells())
    if (cell.box.size() == 2) {
      used.add({cell.box[0].lo, cell.box[1].lo});
      used.add({cell.box[0].hi, cell.box[1].hi});
    }
  for (const Picture_scene::Drawn_arc& arc : scene.arcs)
    for (const Arc_point<2>& p : arc.samples)
      if (p.parameters().size() == 2) used.add({picked(p.parameters()[0]), picked(p.parameters()[1])});
  for (std::size_t k = 0; k < 2; ++k) {
    if (const Pictured_curve* curve = scene.foot_curve(k)) square.axes[k] = Parameter_axis(*curve);
    else if (!used.empty()) square.axes[k] = k == 0 ? Parameter_axis(used.x0, used.x1) : Parameter_axis(used.y0, used.y1);
    if (!(square.axes[k].hi() > square.axes[k].lo())) square.axes[k] = Parameter_axis(0, 1);
  }
  return square;
}

/// Has a pair of pieces no cell? Then bounds of the pieces prove that they have no bisector.
inline bool has_purged_pair(const Picture_scene& scene, const Parameter_square& square)
{
  const auto &t = square.axes[0].knots(), &r = square.axes[1].knots();
  const std::size_t n = t.size() - 1, m = r.size() - 1;
  if (scene.locus.cells().empty()) return false;
  std::vector<char> used(n * m, 0);
  const auto use = [&](const std::vector<Range>& box) {
    if (box.size() != 2) return;
    const Picture_point lo = square.at(box[0].lo, box[1].lo), hi = square.at(box[0].hi, box[1].hi);
    const Picture_point middle{0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y)};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < m; ++j)
        if (t[i].at <= middle.x && middle.x <= t[i + 1].at && r[j].at <= middle.y && middle.y <= r[j + 1].at) used[i * m + j] = 1;
  };
  for (const Cell_picture& cell : scene.locus.cells()) use(cell.box);
  for (const Degenerate_piece& d : scene.locus.degenerate()) use(d.box);
  for (const Undecided_piece& u : scene.locus.undecided()) use(u.box);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < (square.is_self ? i + 1 : m); ++j)
      if (!used[i * m + j]) return true;
  return false;
}

/// Draws the square of the parameters: the cells, the zero set, its vertices, and the knots.
class Square_drawing {
public:
  Square_drawing(std::ostream& out, const Picture_scene& scene, const Parameter_square& square, const Panel& panel)
    : out_(out), scene_(scene), square_(square), panel_(panel)
  {
  }

  void write()
  {
    out_ << "<g clip-path=\"url(#clip-" << panel_.name() << ")\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    write_cells("empty", picture::empty_cell);
    write_cells("graph", picture::graph_cell);
    write_cells("crossing", picture::crossing_cell);
    write_cells("undecided", picture::undecided_hatch);
    for (const Degenerate_piece& d : scene_.locus.degenerate()) write_degenerate(d);
    write_knots();
    for (std::size_t a = 0; a < scene_.arcs.size(); ++a) write_arc(a);
    out_ << "</g>\n";
    if (square_.is_self) write_triangle();
    else svg_frame(out_, panel_);
    for (const Undecided_piece& u : scene_.locus.undecided()) write_undecided(u);
    for (std::size_t v = 0; v < scene_.locus.vertices().size(); ++v) write_vertex(v);
    write_axes();
  }

  /// What is drawn at all: the square, or the triangle under its diagonal.
  static std::vector<Picture_point> outline(const Parameter_square& square)
  {
    const Picture_box b = square.box();
    if (square.is_self) return {{b.x0, b.y0}, {b.x1, b.y0}, {b.x1, b.y1}};
    return b.corners();
  }

private:
  std::string box_path(const std::vector<Range>& box) const
  {
    const Picture_point lo = square_.at(box[0].lo, box[1].lo), hi = square_.at(box[0].hi, box[1].hi);
    return panel_.polygon({lo, {hi.x, lo.y}, hi, {lo.x, hi.y}});
  }

  void write_cells(std::string_view claim, const char* fill)
  {
    std::string d;
    for (const Cell_picture& cell : scene_.locus.cells()) {
      if (cell.claim != claim || cell.box.size() != 2) continue;
      std::vector<Picture_point> polygon;
      for (const auto& corner : cell.corners) polygon.push_back(square_.at(corner[0], corner[1]));
      d += polygon.size() < 3 ? box_path(cell.box) : panel_.polygon(polygon);
    }
    svg_path(out_, d, filled(fill, picture::frame, 0.6));
  }

  /// Hatched where the equation vanishes all over a box; a line where it vanishes along a line.
  void write_degenerate(const Degenerate_piece& d)
  {
    if (d.box.size() != 2) return;
    if (d.kind == "everything") {
      svg_path(out_, box_path(d.box), filled(picture::degenerate_hatch, picture::degenerate, 0.6));
      return;
    }
    Picture_point p = square_.at(d.box[0].lo, d.box[1].lo), q = square_.at(d.box[0].hi, d.box[1].hi);
    if (d.input && d.parameter) {
      const double u = square_.axes[*d.input].at(picked(*d.parameter));
      (*d.input == 0 ? p.x : p.y) = u;
      (*d.input == 0 ? q.x : q.y) = u;
    } else if (run_against(d.box)) {
      std::swap(p.y, q.y);
    }
    svg_path(out_, panel_.path({p, q}), stroke(picture::degenerate, 2.2, picture::dashes));
  }

  /// Do equal pieces of the inputs run in opposite directions?
  bool run_against(const std::vector<Range>& box) const
  {
    const Pictured_curve *first = scene_.foot_curve(0), *second = scene_.foot_curve(1);
    if (!first || !second) return false;
    const Picture_point p = first->at(box[0].lo), same = second->at(box[1].lo), other = second->at(box[1].hi);
    return std::hypot(other.x - p.x, other.y - p.y) < std::hypot(same.x - p.x, same.y - p.y);
  }

  void write_knots()
  {
    const Picture_box& b = panel_.box();
    std::string smooth, corners;
    for (std::size_t v = 0; v < 2; ++v) {
      const auto& knots = square_.axes[v].knots();
      for (std::size_t k = 1; k + 1 < knots.size(); ++k) {
        const double u = knots[k].at;
        (knots[k].is_corner ? corners : smooth) +=
          v == 0 ? panel_.path({{u, b.y0}, {u, b.y1}}) : panel_.path({{b.x0, u}, {b.x1, u}});
      }
    }
    svg_path(out_, smooth, stroke(picture::knot, 0.7));
    svg_path(out_, corners, stroke(picture::knot, 1.8));
  }

  void write_arc(std::size_t a)
  {
    std::vector<Picture_point> points;
    for (const Arc_point<2>& p : scene_.arcs[a].samples)
      points.push_back(square_.at(picked(p.parameters()[0]), picked(p.parameters()[1])));
    std::string d;
    for (const std::vector<Picture_point>& part : square_.parts(points)) d += panel_.path(part);
    svg_path(out_, d, stroke(component_colour(scene_.components.of_arc[a]), 2.2));
  }

  void write_triangle()
  {
    svg_path(out_, panel_.polygon(outline(square_)), stroke(picture::frame, 1));
    const Picture_box& b = panel_.box();
    svg_path(out_, panel_.path({{b.x0, b.y0}, {b.x1, b.y1}}), stroke(picture::faint_ink, 1.2, " class=\"diagonal\""));
  }

  /// A ring around undecided boxes that are too small to be seen.
  void write_undecided(const Undecided_piece& piece)
  {
    if (piece.box.size() != 2) return;
    const Picture_point a = panel_.at(square_.at(piece.box[0].lo, piece.box[1].hi)),
                        b = panel_.at(square_.at(piece.box[0].hi, piece.box[1].lo));
    if (std::max(b.x - a.x, b.y - a.y) < 10)
      svg_circle(out_, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, 9, stroke(picture::alarm, 1.8));
  }

  void write_vertex(std::size_t v)
  {
    const Locus_vertex<2>& vertex = scene_.locus.vertices()[v];
    if (vertex.feet.size() != 2 || vertex.feet[0].parameters.size() != 1 || vertex.feet[1].parameters.size() != 1) return;
    const Picture_point p = square_.at(picked(vertex.feet[0].parameters[0]), picked(vertex.feet[1].parameters[0]));
    svg_vertex(out_, panel_.at(p), vertex.kind, component_colour(scene_.components.of_vertex[v]));
  }

  // ------------------------------------------------------------------------------------------------------------- axes

  struct Label {
    double at; ///< along the axis, in pixels from its start
    std::string text;
  };

  /// The ends, and of the knots as many as there is room for; in the middle of an axis without knots its value there.
  std::vector<Label> labels(const Parameter_axis& axis, double length, bool wide) const
  {
    const auto room = [wide](const Label& l) { return wide ? 3.6 * letters(l.text) + 7 : 9; };
    const auto label = [&](double at, double value) {
      return Label{(at - axis.lo()) / (axis.hi() - axis.lo()) * length, label_of(value)};
    };
    const auto& knots = axis.knots();
    std::vector<Label> out{label(knots.front().at, knots.front().value)};
    const Label last = label(knots.back().at, knots.back().value);
    const auto add = [&](const Label& l) {
      if (l.at - room(l) >= out.back().at + room(out.back()) && l.at + room(l) <= last.at - room(last)) out.push_back(l);
    };
    if (knots.size() == 2) {
      const double middle = axis.lo() + 0.5 * (axis.hi() - axis.lo());
      add(label(middle, middle));
    }
    for (std::size_t k = 1; k + 1 < knots.size(); ++k) add(label(knots[k].at, knots[k].value));
    out.push_back(last);
    return out;
  }

  void write_axes()
  {
    const std::string style = std::string("font-size=\"13\" fill=\"") + picture::faint_ink + "\" text-anchor=\"";
    for (const Label& l : labels(square_.axes[0], panel_.width(), true))
      svg_text(out_, {panel_.left() + l.at, panel_.bottom() + 20}, l.text, style + "middle\"");
    for (const Label& l : labels(square_.axes[1], panel_.height(), false))
      svg_text(out_, {panel_.left() - 10, panel_.bottom() - l.at + 4.5}, l.text, style + "end\"");
    const std::string name = "font-size=\"17\" font-style=\"italic\" text-anchor=\"middle\"";
    const bool many_t = square_.axes[0].knots().size() > 2, many_r = square_.axes[1].knots().size() > 2;
    svg_text(out_, {panel_.left() + 0.75 * panel_.width(), panel_.bottom() + (many_t ? 40 : 22)}, "t", name);
    svg_text(out_, {panel_.left() - (many_r ? 46 : 18), panel_.top() + 0.25 * panel_.height() + 5}, "r", name);
    if (!square_.is_self) return;
    const Picture_point above{panel_.left() + 0.46 * panel_.width(), panel_.bottom() - 0.54 * panel_.height()};
    svg_text(out_, above, "t = r", style + "end\"");
  }

  std::ostream& out_;
  const Picture_scene& scene_;
  const Parameter_square& square_;
  const Panel& panel_;
};

} // namespace detail

} // namespace locus

#endif
