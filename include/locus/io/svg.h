// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_H
#define LOCUS_IO_SVG_H

#include <locus/construct/locus.h>
#include <locus/number/interval.h>
#include <locus/shape/rational_curve.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace locus {

namespace detail {

// -------------------------------------------------------------------------------------------------- what is drawn

struct Picture_point {
  double x = 0, y = 0;
};

struct Picture_box {
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;

  bool empty() const { return !(x0 <= x1 && y0 <= y1); }
  void add(const Picture_point& p)
  {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
    x0 = std::min(x0, p.x);
    x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y);
    y1 = std::max(y1, p.y);
  }
  void grow(double margin)
  {
    x0 -= margin;
    x1 += margin;
    y0 -= margin;
    y1 += margin;
  }
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  double size() const { return std::max(width(), height()); }
  bool contains(const Picture_point& p) const { return x0 <= p.x && p.x <= x1 && y0 <= p.y && p.y <= y1; }
  /// The point, or the nearest one of the box.
  Picture_point nearest(const Picture_point& p) const
  {
    return {std::min(x1, std::max(x0, p.x)), std::min(y1, std::max(y0, p.y))};
  }
  /// Do two points lie beyond one and the same side?
  bool beyond(const Picture_point& p, const Picture_point& q) const
  {
    return std::max(p.x, q.x) < x0 || std::min(p.x, q.x) > x1 || std::max(p.y, q.y) < y0 || std::min(p.y, q.y) > y1;
  }
};

/// An input curve in plain doubles, relative to the middle of the picture; good for pictures only.
class Pictured_curve {
public:
  Pictured_curve(const Curve_2& curve, const std::array<Rational, 2>& origin)
  {
    for (std::size_t k = 0; k < curve.pieces().size(); ++k) {
      const Piece& range = curve.chain().pieces[k];
      if (!range.is_finite()) continue; // a half line has no size that a picture could show
      Span span;
      span.lo = nearest_double(range.lo);
      span.hi = nearest_double(range.hi);
      const Curve_piece<2>& piece = curve.pieces()[k];
      Rational largest = 0;
      for (const Rational& w : piece.weight.coefficients()) largest = std::max(largest, Rational(abs(w)));
      for (const Rational& w : piece.weight.coefficients()) span.weight.push_back(nearest_double(w / largest));
      for (std::size_t v = 0; v < 2; ++v) {
        const Bernstein<Rational, 1> x = subtract(piece.numerator[v], multiply(piece.weight, origin[v]));
        for (const Rational& c : x.coefficients()) span.numerator[v].push_back(nearest_double(c / largest));
      }
      spans_.push_back(std::move(span));
    }
  }

  bool empty() const { return spans_.empty(); }
  double start() const { return spans_.front().lo; }
  double finish() const { return spans_.back().hi; }

  Picture_point at(double u) const
  {
    std::size_t k = 0;
    while (k + 1 < spans_.size() && u > spans_[k].hi) ++k;
    const Span& s = spans_[k];
    const double f = std::min(1.0, std::max(0.0, (u - s.lo) / (s.hi - s.lo)));
    const double w = casteljau(s.weight, f);
    return {casteljau(s.numerator[0], f) / w, casteljau(s.numerator[1], f) / w};
  }

  std::vector<Picture_point> points() const
  {
    constexpr int steps = 160;
    std::vector<Picture_point> out;
    for (const Span& s : spans_)
      for (int i = out.empty() ? 0 : 1; i <= steps; ++i) out.push_back(at(s.lo + (s.hi - s.lo) * i / steps));
    return out;
  }

private:
  struct Span {
    double lo = 0, hi = 1;
    std::array<std::vector<double>, 2> numerator;
    std::vector<double> weight;
  };

  static double casteljau(std::vector<double> c, double f)
  {
    for (std::size_t n = c.size(); n > 1; --n)
      for (std::size_t i = 0; i + 1 < n; ++i) c[i] += f * (c[i + 1] - c[i]);
    return c[0];
  }

  std::vector<Span> spans_;
};

/// To which connected component each arc and each vertex belongs; numbered in the order of the arcs.
struct Component_numbers {
  std::vector<std::size_t> of_arc, of_vertex;
  std::size_t count = 0;
};

template <int Dim>
Component_numbers component_numbers(const Locus<Dim>& locus)
{
  const std::size_t arcs = locus.arcs().size(), none = locus.vertices().size() + arcs;
  std::vector<std::size_t> parent(none); // vertices, then arcs
  for (std::size_t i = 0; i < none; ++i) parent[i] = i;
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const std::size_t first_arc = locus.vertices().size();
  for (std::size_t a = 0; a < arcs; ++a) {
    const Arc<Dim>& arc = locus.arcs()[a];
    if (arc.is_closed()) continue;
    parent[root(*arc.source())] = root(first_arc + a);
    parent[root(*arc.target())] = root(first_arc + a);
  }
  Component_numbers numbers;
  std::vector<std::size_t> number(none, none);
  const auto number_of = [&](std::size_t i) {
    std::size_t& n = number[root(i)];
    if (n == none) n = numbers.count++;
    return n;
  };
  for (std::size_t a = 0; a < arcs; ++a) numbers.of_arc.push_back(number_of(first_arc + a));
  for (std::size_t v = 0; v < first_arc; ++v) numbers.of_vertex.push_back(number_of(v));
  return numbers;
}

// --------------------------------------------------------------------------------------------------- SVG elements

namespace picture {
inline constexpr const char* ink = "#1f2933";
inline constexpr const char* faint_ink = "#66717e";
inline constexpr const char* frame = "#c5ccd4";
inline constexpr const char* foot = "#9fa9b5";
inline constexpr const char* alarm = "#d00000";
inline constexpr std::array<const char*, 2> input{"#12355b", "#6b1f45"};
inline constexpr std::array<const char*, 8> component{"#e4572e", "#1b998b", "#8f3fb0", "#c98a00",
                                                      "#2878d0", "#5a8f29", "#d0408a", "#7a5c43"};
inline constexpr const char* empty_cell = "#f4f5f7";
inline constexpr const char* graph_cell = "#dfeaf6";
inline constexpr const char* crossing_cell = "#ffd9a8";
} // namespace picture

/// Shortest decimal of a coordinate to a hundredth of a pixel, whatever the locale.
inline std::string pixels(double x)
{
  constexpr double far = 1e5; // beyond this nothing is visible
  if (!(std::abs(x) < far)) x = x > 0 ? far : -far;
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), std::round(100 * x) / 100 + 0.0).ptr;
  return {digits.data(), end};
}

/// A number for a label.
inline std::string label_of(double x, int digits_shown = 4)
{
  std::array<char, 32> digits;
  const auto end =
    std::to_chars(digits.data(), digits.data() + digits.size(), x, std::chars_format::general, digits_shown).ptr;
  return {digits.data(), end};
}

inline std::string escaped(std::string_view s)
{
  std::string out;
  for (const char c : s) {
    if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '&') out += "&amp;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

/// A panel: a rectangle of the page that shows a box of the plane or of the parameters.
class Panel {
public:
  Panel(std::string name, double x, double y, double width, double height, const Picture_box& box)
    : name_(std::move(name)), x_(x), y_(y), width_(width), height_(height), box_(box)
  {
  }

  const std::string& name() const { return name_; }
  const Picture_box& box() const { return box_; }
  double left() const { return x_; }
  double top() const { return y_; }
  double width() const { return width_; }
  double height() const { return height_; }
  Picture_point at(const Picture_point& p) const
  {
    return {x_ + (p.x - box_.x0) / box_.width() * width_, y_ + height_ - (p.y - box_.y0) / box_.height() * height_};
  }
  std::string text(const Picture_point& p) const
  {
    const Picture_point q = at(p);
    return pixels(q.x) + " " + pixels(q.y);
  }

  /// Path through points; parts that stay on one outer side of the panel are left out.
  std::string path(const std::vector<Picture_point>& points) const
  {
    Picture_box near = box_;
    near.grow(0.05 * box_.size());
    std::string out, last;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (near.beyond(points[i - 1], points[i])) {
        last.clear();
        continue;
      }
      const std::string from = text(points[i - 1]), to = text(points[i]);
      if (last != from) out += "M" + from;
      if (to != from) out += "L" + to;
      last = to;
    }
    return out;
  }

private:
  std::string name_;
  double x_, y_, width_, height_;
  Picture_box box_;
};

inline std::string attribute(const char* name, double value)
{
  return std::string(" ") + name + "=\"" + pixels(value) + "\"";
}

inline void svg_path(std::ostream& out, const std::string& d, const std::string& style)
{
  if (!d.empty()) out << "<path d=\"" << d << "\" " << style << "/>\n";
}
inline void svg_circle(std::ostream& out, const Picture_point& at, double radius, const std::string& style)
{
  out << "<circle" << attribute("cx", at.x) << attribute("cy", at.y) << attribute("r", radius) << ' ' << style
      << "/>\n";
}
inline void svg_text(std::ostream& out, const Picture_point& at, std::string_view text, const std::string& style)
{
  out << "<text" << attribute("x", at.x) << attribute("y", at.y) << ' ' << style << '>' << escaped(text) << "</text>\n";
}
inline std::string stroke(const char* colour, double width, const char* more = "")
{
  return std::string("fill=\"none\" stroke=\"") + colour + "\" stroke-width=\"" + pixels(width) + "\"" + more;
}

// ------------------------------------------------------------------------------------------------------- pictures

/// A locus in the plane on the left, its parameters on the right, a legend below.
class Bisector_picture {
public:
  Bisector_picture(std::ostream& out, const Locus<2>& locus, const std::vector<Curve_2>& inputs)
    : out_(out), locus_(locus), components_(component_numbers(locus))
  {
    for (std::size_t k = 0; k < 2; ++k) {
      const double c = locus.centre()[k];
      centre_[k] = std::isfinite(c) ? c : 0.0;
    }
    for (const Curve_2& curve : inputs)
      curves_.emplace_back(curve, std::array<Rational, 2>{exact_rational(centre_[0]), exact_rational(centre_[1])});
    curves_.erase(std::remove_if(curves_.begin(), curves_.end(), [](const Pictured_curve& c) { return c.empty(); }),
                  curves_.end());
    has_parameters_ =
      std::all_of(locus.arcs().begin(), locus.arcs().end(), [](const Arc<2>& a) { return a.inputs().size() == 2; });
    for (const Arc<2>& arc : locus.arcs()) drawn_.push_back(draw(arc));
  }

  void write()
  {
    constexpr double top = 76, plane_width = 600, plane_height = 500, margin = 40;
    const Panel plane("plane", margin, top, plane_width, plane_height, plane_box(plane_width / plane_height));
    const Panel square("parameters", margin + plane_width + 92, top, plane_height, plane_height, parameter_box());
    const double width = has_parameters_ ? square.left() + square.width() + margin : plane_width + 2 * margin;
    // The legend decides the height of the page, so it is laid out first.
    const double legend_top = top + plane_height + 62;
    const double height = legend_top + legend(legend_top, width, nullptr) + 26;

    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\"" << attribute("width", width) << attribute("height", height)
         << " viewBox=\"0 0 " << pixels(width) << ' ' << pixels(height)
         << "\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" font-size=\"14\" fill=\"" << picture::ink
         << "\">\n<title>" << escaped(title()) << "</title>\n<desc>" << escaped(caption()) << "</desc>\n";
    definitions(plane, square);
    out_ << "<rect" << attribute("width", width) << attribute("height", height) << " fill=\"#ffffff\"/>\n";
    svg_text(out_, {margin, 36}, title(), "font-size=\"20\" font-weight=\"bold\"");
    svg_text(out_, {margin, 60}, caption(),
             std::string("fill=\"") + (locus_.status() == Status::certified ? picture::faint_ink : picture::alarm) +
               "\"");
    write_plane(plane);
    if (has_parameters_) write_parameters(square);
    legend(legend_top, width, &out_);
    out_ << "</svg>\n";
  }

private:
  /// An arc's points in the plane, relative to the centre, and in the square of the parameters.
  struct Drawn_arc {
    std::vector<Picture_point> plane, parameters;
    std::vector<Arc_point<2>> samples;
  };

  Picture_point placed(const Approximate_point<2>& p) const { return {p[0] - centre_[0], p[1] - centre_[1]}; }

  Drawn_arc draw(const Arc<2>& arc) const
  {
    constexpr double fine_enough = 2e-4; // of the inputs' diameter: a fraction of a pixel
    constexpr std::size_t samples = 129;
    Drawn_arc drawn;
    for (const Arc_point<2>& p : arc.polyline(fine_enough)) drawn.plane.push_back(placed(p.point()));
    drawn.samples = arc.samples(samples);
    if (has_parameters_)
      for (const Arc_point<2>& p : drawn.samples) drawn.parameters.push_back({p.parameter(0), p.parameter(1)});
    return drawn;
  }

  const char* colour(std::size_t component) const { return picture::component[component % picture::component.size()]; }

  /// The inputs and what of the locus is near them.
  Picture_box plane_box(double aspect) const
  {
    Picture_box box;
    for (const Pictured_curve& curve : curves_)
      for (const Picture_point& p : curve.points()) box.add(p);
    if (box.empty() || !(box.size() > 0)) {
      box.add({-0.35 * locus_.scale(), -0.35 * locus_.scale()});
      box.add({0.35 * locus_.scale(), 0.35 * locus_.scale()});
    }
    const double size = box.size();
    Picture_box limit = box;
    limit.grow(0.6 * size);
    for (const Drawn_arc& arc : drawn_)
      for (std::size_t i = 1; i < arc.plane.size(); ++i) {
        const Picture_point &p = arc.plane[i - 1], &q = arc.plane[i];
        if (limit.beyond(p, q)) continue;
        box.add(limit.nearest(p));
        box.add(limit.nearest(q));
      }
    const double wide = 0.13 * box.size(), high = 0.08 * box.size(); // room for labels
    box.x0 -= wide;
    box.x1 += wide;
    box.y0 -= high;
    box.y1 += high;
    const double wanted = std::max(box.width(), box.height() * aspect);
    const double extra_width = wanted - box.width(), extra_height = wanted / aspect - box.height();
    box.x0 -= 0.5 * extra_width;
    box.x1 += 0.5 * extra_width;
    box.y0 -= 0.5 * extra_height;
    box.y1 += 0.5 * extra_height;
    return box;
  }

  Picture_box parameter_box() const
  {
    Picture_box box;
    if (curves_.size() == 2) {
      box.add({curves_[0].start(), curves_[1].start()});
      box.add({curves_[0].finish(), curves_[1].finish()});
      return box;
    }
    for (const Cell_picture& cell : locus_.cells())
      if (cell.box.size() == 2) {
        box.add({cell.box[0].lo, cell.box[1].lo});
        box.add({cell.box[0].hi, cell.box[1].hi});
      }
    if (locus_.cells().empty()) {
      box.add({0, 0});
      box.add({1, 1});
    }
    for (const Drawn_arc& arc : drawn_)
      for (const Picture_point& p : arc.parameters) box.add(p);
    return box;
  }

  bool has_vertex(Vertex_kind kind) const
  {
    return std::any_of(locus_.vertices().begin(), locus_.vertices().end(),
                       [kind](const Locus_vertex<2>& v) { return v.kind == kind; });
  }
  bool has_cell(std::string_view claim) const
  {
    return std::any_of(locus_.cells().begin(), locus_.cells().end(),
                       [claim](const Cell_picture& c) { return c.claim == claim; });
  }

  std::string title() const
  {
    return (locus_.is_trimmed() ? "True " : "Untrimmed ") + locus_.compute() +
           (curves_.size() == 2 ? " of two curves" : "");
  }

  static std::string counted(std::size_t n, const std::string& noun)
  {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
  }

  std::string caption() const
  {
    const std::size_t open = locus_.undecided().size();
    std::string text =
      open == 0 ? "certified" : std::to_string(open) + (open == 1 ? " box undecided" : " boxes undecided");
    text += " · " + counted(locus_.arcs().size(), "arc") + " in " + counted(components_.count, "component");
    std::size_t nodes = 0;
    for (const Locus_vertex<2>& v : locus_.vertices()) nodes += v.kind == Vertex_kind::node;
    if (nodes > 0) text += " · " + counted(nodes, "node");
    if (!locus_.degenerate().empty()) text += " · " + counted(locus_.degenerate().size(), "degenerate piece");
    text += " · " + counted(locus_.statistics().cells, "cell");
    if (locus_.statistics().exact_cells > 0)
      text += ", " + std::to_string(locus_.statistics().exact_cells) + " of them exact";
    return text + " · " + label_of(1e3 * locus_.statistics().seconds, 2) + " ms";
  }

  void definitions(const Panel& plane, const Panel& square)
  {
    out_ << "<defs>\n";
    for (const Panel* p : {&plane, &square})
      out_ << "<clipPath id=\"clip-" << p->name() << "\"><rect" << attribute("x", p->left()) << attribute("y", p->top())
           << attribute("width", p->width()) << attribute("height", p->height()) << "/></clipPath>\n";
    out_ << "<pattern id=\"hatch\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
            "patternTransform=\"rotate(45)\">"
         << "<rect width=\"6\" height=\"6\" fill=\"#ffe3e3\"/><rect width=\"2\" height=\"6\" fill=\"" << picture::alarm
         << "\"/></pattern>\n</defs>\n";
  }

  void panel_frame(const Panel& panel)
  {
    out_ << "<rect" << attribute("x", panel.left()) << attribute("y", panel.top()) << attribute("width", panel.width())
         << attribute("height", panel.height()) << ' ' << stroke(picture::frame, 1) << "/>\n";
  }

  // ------------------------------------------------------------------------------------------------- the plane

  void write_plane(const Panel& panel)
  {
    out_ << "<g clip-path=\"url(#clip-plane)\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    for (const Locus_vertex<2>& v : locus_.vertices())
      if (v.asymptote) write_asymptote(panel, *v.asymptote);
    if (curves_.size() == 2) write_feet(panel);
    for (std::size_t k = 0; k < curves_.size(); ++k)
      svg_path(out_, panel.path(curves_[k].points()), stroke(picture::input[k % 2], 2.5));
    for (std::size_t a = 0; a < drawn_.size(); ++a)
      svg_path(out_, panel.path(drawn_[a].plane), stroke(colour(components_.of_arc[a]), 2.5));
    for (std::size_t v = 0; v < locus_.vertices().size(); ++v) {
      const Locus_vertex<2>& vertex = locus_.vertices()[v];
      if (!vertex.point) continue;
      const Picture_point p = placed(*vertex.point);
      if (panel.box().contains(p)) write_vertex(panel.at(p), vertex.kind, colour(components_.of_vertex[v]));
    }
    out_ << "</g>\n";
    for (std::size_t k = 0; k < curves_.size(); ++k) write_ends(panel, k);
    panel_frame(panel);
    write_scale(panel);
  }

  void write_asymptote(const Panel& panel, const Asymptote<2>& asymptote)
  {
    const double far = 4 * panel.box().size();
    const Picture_point p = placed(asymptote.point), d{asymptote.direction[0], asymptote.direction[1]};
    const Picture_point from = panel.at({p.x - far * d.x, p.y - far * d.y}),
                        to = panel.at({p.x + far * d.x, p.y + far * d.y});
    svg_path(out_, "M" + pixels(from.x) + " " + pixels(from.y) + "L" + pixels(to.x) + " " + pixels(to.y),
             stroke(picture::foot, 1.2, " stroke-dasharray=\"7 5\""));
  }

  /// From points of each arc, about equally spaced where it is visible, to their feet.
  void write_feet(const Panel& panel)
  {
    constexpr double spacing = 42; // pixels
    std::string d;
    for (std::size_t a = 0; a < drawn_.size(); ++a) {
      if (locus_.arcs()[a].inputs() != std::vector<std::size_t>{0, 1}) continue;
      double since = 0.5 * spacing;
      const std::vector<Arc_point<2>>& points = drawn_[a].samples;
      for (std::size_t i = 1; i < points.size(); ++i) {
        const Picture_point from = placed(points[i - 1].point()), to = placed(points[i].point());
        if (!panel.box().contains(from) || !panel.box().contains(to)) continue;
        const Picture_point p = panel.at(from), q = panel.at(to);
        since += std::hypot(q.x - p.x, q.y - p.y);
        if (since < spacing) continue;
        since = 0;
        d += "M" + panel.text(curves_[0].at(points[i].parameter(0))) + "L" + panel.text(to) + "L" +
             panel.text(curves_[1].at(points[i].parameter(1)));
      }
    }
    svg_path(out_, d, stroke(picture::foot, 0.8, " stroke-opacity=\"0.75\""));
  }

  void write_vertex(const Picture_point& at, Vertex_kind kind, const char* component)
  {
    const std::string ring = "fill=\"#ffffff\" stroke=\"" + std::string(component) + "\" stroke-width=\"1.8\"";
    switch (kind) {
    case Vertex_kind::node:
      svg_circle(out_, at, 4.5, std::string("fill=\"") + picture::ink + "\" stroke=\"#ffffff\" stroke-width=\"1.2\"");
      break;
    case Vertex_kind::isolated:
      svg_circle(out_, at, 6.5, ring);
      svg_circle(out_, at, 2.5, std::string("fill=\"") + component + "\"");
      break;
    case Vertex_kind::undecided:
      svg_circle(out_, at, 5, std::string("fill=\"#ffe3e3\" stroke=\"") + picture::alarm + "\" stroke-width=\"1.8\"");
      break;
    case Vertex_kind::infinity: {
      const auto corner = [&](double x, double y) { return pixels(at.x + x) + " " + pixels(at.y + y); };
      svg_path(out_, "M" + corner(0, -5.5) + "L" + corner(5.5, 0) + "L" + corner(0, 5.5) + "L" + corner(-5.5, 0) + "Z",
               ring);
      break;
    }
    case Vertex_kind::boundary:
    case Vertex_kind::corner:
    case Vertex_kind::trim:
    case Vertex_kind::diagonal:
      svg_circle(out_, at, 3.2, ring);
      break;
    }
  }

  /// The ends of a curve: the start filled, the finish open, with the parameter's values.
  void write_ends(const Panel& panel, std::size_t k)
  {
    const std::string colour = picture::input[k % 2];
    const Pictured_curve& curve = curves_[k];
    const std::string name = curves_.size() == 2 ? (k == 0 ? "t" : "r") : "u";
    for (const bool start : {true, false}) {
      const double u = start ? curve.start() : curve.finish(), step = (curve.finish() - curve.start()) / 32;
      const Picture_point p = panel.at(curve.at(u)), inner = panel.at(curve.at(start ? u + step : u - step));
      svg_circle(out_, p, 4,
                 "fill=\"" + (start ? colour : "#ffffff") + "\" stroke=\"" + colour + "\" stroke-width=\"2\"");
      // The label goes on beyond the end.
      double dx = p.x - inner.x, dy = p.y - inner.y;
      const double length = std::hypot(dx, dy);
      dx = length > 0 ? dx / length : 1;
      dy = length > 0 ? dy / length : 0;
      const std::string text = name + " = " + label_of(u, 3);
      const double width = 7.2 * static_cast<double>(text.size()) + 14, right = panel.left() + panel.width();
      const bool sideways = std::abs(dx) > 0.4 && (dx > 0 ? p.x + width < right : p.x - width > panel.left());
      const char* anchor = !sideways ? "middle" : dx > 0 ? "start" : "end";
      const double below = dy < 0 ? -11 : 20;
      const Picture_point at{sideways ? p.x + 10 * dx : p.x, sideways ? p.y + 12 * dy + 4.5 : p.y + below};
      svg_text(out_, at, text,
               "font-size=\"13\" text-anchor=\"" + std::string(anchor) + "\" fill=\"" + colour +
                 "\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
    }
  }

  /// A bar of a round length under the panel, instead of axes.
  void write_scale(const Panel& panel)
  {
    const double unit = panel.box().width() / panel.width(); // length of a pixel
    const double wanted = 110 * unit;
    double length = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double f : {5.0, 2.0})
      if (f * length <= wanted) {
        length *= f;
        break;
      }
    if (!(length > 0) || !std::isfinite(length)) return;
    const double x = panel.left() + 2, y = panel.top() + panel.height() + 18, w = length / unit;
    svg_path(out_, "M" + pixels(x) + " " + pixels(y - 4) + "v8m0 -4h" + pixels(w) + "m0 -4v8",
             stroke(picture::faint_ink, 1.2));
    svg_text(out_, {x + w + 8, y + 4.5}, label_of(length),
             std::string("font-size=\"13\" fill=\"") + picture::faint_ink + "\"");
  }

  // -------------------------------------------------------------------------------------------- the parameters

  void write_parameters(const Panel& panel)
  {
    out_ << "<g clip-path=\"url(#clip-parameters)\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    write_cells(panel, "empty", picture::empty_cell);
    write_cells(panel, "graph", picture::graph_cell);
    write_cells(panel, "crossing", picture::crossing_cell);
    write_cells(panel, "undecided", "url(#hatch)");
    for (std::size_t a = 0; a < drawn_.size(); ++a)
      svg_path(out_, panel.path(drawn_[a].parameters), stroke(colour(components_.of_arc[a]), 2.2));
    out_ << "</g>\n";
    panel_frame(panel);
    for (const Undecided_piece& u : locus_.undecided()) write_undecided(panel, u);
    for (std::size_t v = 0; v < locus_.vertices().size(); ++v) {
      const Locus_vertex<2>& vertex = locus_.vertices()[v];
      if (vertex.feet.size() != 2 || vertex.feet[0].parameters.size() != 1 || vertex.feet[1].parameters.size() != 1)
        continue;
      const auto middle = [](const Range& r) { return r.lo + 0.5 * (r.hi - r.lo); };
      const Picture_point p{middle(vertex.feet[0].parameters[0]), middle(vertex.feet[1].parameters[0])};
      write_vertex(panel.at(p), vertex.kind, colour(components_.of_vertex[v]));
    }
    write_axes(panel);
  }

  void write_cells(const Panel& panel, std::string_view claim, const char* fill)
  {
    std::string d;
    for (const Cell_picture& cell : locus_.cells()) {
      if (cell.claim != claim || cell.box.size() != 2) continue;
      const Picture_point a = panel.at({cell.box[0].lo, cell.box[1].hi}),
                          b = panel.at({cell.box[0].hi, cell.box[1].lo});
      d += "M" + pixels(a.x) + " " + pixels(a.y) + "H" + pixels(b.x) + "V" + pixels(b.y) + "H" + pixels(a.x) + "Z";
    }
    svg_path(out_, d, std::string("fill=\"") + fill + "\" stroke=\"" + picture::frame + "\" stroke-width=\"0.6\"");
  }

  /// A ring around undecided boxes that are too small to be seen.
  void write_undecided(const Panel& panel, const Undecided_piece& piece)
  {
    if (piece.box.size() != 2) return;
    const Picture_point a = panel.at({piece.box[0].lo, piece.box[1].hi}),
                        b = panel.at({piece.box[0].hi, piece.box[1].lo});
    if (std::max(b.x - a.x, b.y - a.y) < 10)
      svg_circle(out_, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, 9, stroke(picture::alarm, 1.8));
  }

  void write_axes(const Panel& panel)
  {
    const std::string style = std::string("font-size=\"13\" fill=\"") + picture::faint_ink + "\" text-anchor=\"";
    const double bottom = panel.top() + panel.height();
    for (const double f : {0.0, 0.5, 1.0}) {
      const double t = panel.box().x0 + f * panel.box().width(), r = panel.box().y0 + f * panel.box().height();
      svg_text(out_, {panel.left() + f * panel.width(), bottom + 20}, label_of(t), style + "middle\"");
      svg_text(out_, {panel.left() - 10, bottom - f * panel.height() + 4.5}, label_of(r), style + "end\"");
    }
    const std::string name = "font-size=\"17\" font-style=\"italic\" text-anchor=\"middle\"";
    svg_text(out_, {panel.left() + 0.75 * panel.width(), bottom + 22}, "t", name);
    svg_text(out_, {panel.left() - 18, panel.top() + 0.25 * panel.height() + 5}, "r", name);
  }

  // ------------------------------------------------------------------------------------------------ the legend

  /// Lays the legend out in rows from `top` on; writes it if there is a stream. Returns its height.
  double legend(double top, double width, std::ostream* out)
  {
    constexpr double row = 26, left = 40, symbol = 30, gap = 26;
    const Picture_point start{left, top};
    Picture_point at = start;
    const auto entry = [&](const std::string& text, auto draw_symbol) {
      const double text_width = 7.1 * static_cast<double>(text.size());
      if (at.x + symbol + text_width > width - left && at.x > left) at = {left, at.y + row};
      if (out) {
        draw_symbol(at);
        svg_text(*out, {at.x + symbol, at.y + 5}, text, "");
      }
      at.x += symbol + text_width + gap;
    };
    const auto line = [&](const std::string& style) {
      return
        [&, style](const Picture_point& p) { svg_path(*out, "M" + pixels(p.x) + " " + pixels(p.y) + "h22", style); };
    };
    const auto square = [&](const char* fill) {
      return [&, fill](const Picture_point& p) {
        *out << "<rect" << attribute("x", p.x + 5) << attribute("y", p.y - 7) << " width=\"14\" height=\"14\" fill=\""
             << fill << "\" stroke=\"" << picture::frame << "\"/>\n";
      };
    };
    const auto vertex = [&](Vertex_kind kind) {
      return [&, kind](const Picture_point& p) { write_vertex({p.x + 12, p.y}, kind, colour(0)); };
    };
    if (curves_.size() == 2) {
      entry("first curve", line(stroke(picture::input[0], 2.5)));
      entry("second curve", line(stroke(picture::input[1], 2.5)));
    }
    const std::size_t shown = std::min<std::size_t>(components_.count, 4);
    for (std::size_t c = 0; c < shown; ++c)
      entry(components_.count == 1 ? locus_.compute() : locus_.compute() + ", component " + std::to_string(c + 1),
            line(stroke(colour(c), 2.5)));
    if (components_.count > shown) entry("… of " + std::to_string(components_.count), [](const Picture_point&) {});
    if (curves_.size() == 2 && !drawn_.empty()) entry("to the feet", line(stroke(picture::foot, 0.9)));
    if (std::any_of(locus_.vertices().begin(), locus_.vertices().end(),
                    [](const Locus_vertex<2>& v) { return v.asymptote.has_value(); }))
      entry("asymptote", line(stroke(picture::foot, 1.2, " stroke-dasharray=\"7 5\"")));
    if (has_vertex(Vertex_kind::boundary)) entry("end at a curve's end", vertex(Vertex_kind::boundary));
    if (has_vertex(Vertex_kind::infinity)) entry("to infinity", vertex(Vertex_kind::infinity));
    if (has_vertex(Vertex_kind::node)) entry("node", vertex(Vertex_kind::node));
    if (has_vertex(Vertex_kind::isolated)) entry("isolated point", vertex(Vertex_kind::isolated));
    // Where the equations have a factor that is known, the cells are those of the rest.
    const std::string rest = locus_.equations().size() > 1 ? " but for " + locus_.equations()[1].name : "";
    if (has_cell("empty")) entry("cell proved empty" + rest, square(picture::empty_cell));
    if (has_cell("graph")) entry("cell proved a graph", square(picture::graph_cell));
    if (has_cell("crossing")) entry("cell of a node", square(picture::crossing_cell));
    if (!locus_.undecided().empty()) entry("undecided", square("url(#hatch)"));
    return at.y - start.y + 20;
  }

  std::ostream& out_;
  const Locus<2>& locus_;
  Component_numbers components_;
  std::array<double, 2> centre_{};
  std::vector<Pictured_curve> curves_;
  bool has_parameters_ = true;
  std::vector<Drawn_arc> drawn_;
};

} // namespace detail

/// Draws a locus of the plane: on the left the plane, near the inputs; on the right the square of the parameters t and
/// r, with the cells of the subdivision if the result keeps them (`Bisector_options::keep_cells`). Connected components
/// have one colour each. Given the input curves, they and lines to the feet are drawn too.
inline void write_svg(std::ostream& out, const Locus<2>& locus, const std::vector<Curve_2>& inputs = {})
{
  detail::Bisector_picture(out, locus, inputs).write();
}

/// The same into a file. Throws std::runtime_error if it cannot be written.
inline void write_svg(const std::string& path, const Locus<2>& locus, const std::vector<Curve_2>& inputs = {})
{
  std::ofstream out(path, std::ios::binary);
  if (out) write_svg(out, locus, inputs);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path);
}

} // namespace locus

#endif
