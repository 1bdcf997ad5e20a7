// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_ELEMENTS_H
#define LOCUS_IO_SVG_ELEMENTS_H

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace locus {

namespace detail {

struct Picture_point {
  double x = 0, y = 0;

  bool is_finite() const { return std::isfinite(x) && std::isfinite(y); }
};

inline double distance_to_segment(const Picture_point& at, const Picture_point& p, const Picture_point& q)
{
  const double dx = q.x - p.x, dy = q.y - p.y, square = dx * dx + dy * dy;
  const double share = square > 0 ? ((at.x - p.x) * dx + (at.y - p.y) * dy) / square : 0;
  const double nearest = std::min(1.0, std::max(0.0, share));
  return std::hypot(at.x - p.x - nearest * dx, at.y - p.y - nearest * dy);
}

struct Picture_box {
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;

  bool empty() const { return !(x0 <= x1 && y0 <= y1); }
  void add(const Picture_point& p)
  {
    if (!p.is_finite()) return;
    x0 = std::min(x0, p.x);
    x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y);
    y1 = std::max(y1, p.y);
  }
  void grow(double margin) { grow(margin, margin); }
  void grow(double wide, double high)
  {
    x0 -= wide;
    x1 += wide;
    y0 -= high;
    y1 += high;
  }
  /// Counterclockwise.
  std::vector<Picture_point> corners() const { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
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
  /// Shortens a segment to the part in the box; false if there is none.
  bool clip(Picture_point& p, Picture_point& q) const
  {
    if (!p.is_finite() || !q.is_finite() || beyond(p, q)) return false;
    if (contains(p) && contains(q)) return true;
    const Picture_point from = p, step{q.x - p.x, q.y - p.y};
    double first = 0, last = 1;
    const auto keep = [&](double start, double slope, double lo, double hi) {
      if (slope == 0) return;
      const double a = (lo - start) / slope, b = (hi - start) / slope;
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    };
    keep(from.x, step.x, x0, x1);
    keep(from.y, step.y, y0, y1);
    if (!(first <= last)) return false;
    p = {from.x + first * step.x, from.y + first * step.y};
    q = {from.x + last * step.x, from.y + last * step.y};
    return true;
  }
};

namespace picture {
inline constexpr const char* ink = "#1f2933";
inline constexpr const char* faint_ink = "#66717e";
inline constexpr const char* frame = "#c5ccd4";
inline constexpr const char* knot = "#8b97a4";
inline constexpr const char* foot = "#9fa9b5";
inline constexpr const char* alarm = "#d00000";
inline constexpr const char* degenerate = "#7d5ba6";
inline constexpr std::array<const char*, 2> input{"#12355b", "#6b1f45"};
inline constexpr std::array<const char*, 8> component{"#e4572e", "#1b998b", "#8f3fb0", "#c98a00",
                                                      "#2878d0", "#5a8f29", "#d0408a", "#7a5c43"};
inline constexpr const char* empty_cell = "#f4f5f7";
inline constexpr const char* graph_cell = "#dfeaf6";
inline constexpr const char* crossing_cell = "#ffd9a8";
inline constexpr const char* point_cell = "#f7ebf1";
inline constexpr std::array<const char*, 2> input_cell{"#e6edf5", "#f7ebf1"};
inline constexpr const char* untrimmed = "#d18e74";
inline constexpr const char* undecided_hatch = "url(#hatch)";
inline constexpr const char* degenerate_hatch = "url(#degenerate-hatch)";
inline constexpr const char* dashes = " stroke-dasharray=\"7 5\"";
} // namespace picture

inline const char* component_colour(std::size_t component) { return picture::component[component % picture::component.size()]; }

/// Shortest decimal of a coordinate to a hundredth of a pixel, whatever the locale.
inline std::string pixels(double x)
{
  constexpr double far = 1e5; // beyond this nothing is visible
  if (!(std::abs(x) < far)) x = x > 0 ? far : -far;
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), std::round(100 * x) / 100 + 0.0).ptr;
  return {digits.data(), end};
}
inline std::string pixels(const Picture_point& p) { return pixels(p.x) + " " + pixels(p.y); }

/// A number for a label.
inline std::string label_of(double x, int digits_shown = 4)
{
  if (std::isinf(x)) return x > 0 ? "∞" : "−∞";
  std::array<char, 32> digits;
  const auto end =
    std::to_chars(digits.data(), digits.data() + digits.size(), x, std::chars_format::general, digits_shown).ptr;
  return {digits.data(), end};
}

/// Number of characters of a text in UTF-8.
inline double letters(std::string_view s)
{
  const auto is_first_byte = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  return static_cast<double>(std::count_if(s.begin(), s.end(), is_first_byte));
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
  double right() const { return x_ + width_; }
  double bottom() const { return y_ + height_; }
  double width() const { return width_; }
  double height() const { return height_; }
  Picture_point at(const Picture_point& p) const
  {
    return {x_ + (p.x - box_.x0) / box_.width() * width_, y_ + height_ - (p.y - box_.y0) / box_.height() * height_};
  }
  std::string text(const Picture_point& p) const { return pixels(at(p)); }

  /// Path through points, without what lies outside the panel.
  std::string path(const std::vector<Picture_point>& points) const
  {
    Picture_box near = box_;
    near.grow(0.05 * box_.size());
    std::string out, last;
    for (std::size_t i = 1; i < points.size(); ++i) {
      Picture_point p = points[i - 1], q = points[i];
      if (!near.clip(p, q)) continue;
      const std::string from = text(p), to = text(q);
      if (last != from) out += "M" + from;
      if (to != from) out += "L" + to;
      last = to;
    }
    return out;
  }

  std::string polygon(const std::vector<Picture_point>& points) const
  {
    std::string out;
    for (const Picture_point& p : points) out += (out.empty() ? "M" : "L") + text(p);
    return out.empty() ? out : out + "Z";
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
  out << "<circle" << attribute("cx", at.x) << attribute("cy", at.y) << attribute("r", radius) << ' ' << style << "/>\n";
}
inline void svg_rectangle(std::ostream& out, const Picture_point& at, double width, double height, const std::string& style)
{
  out << "<rect" << attribute("x", at.x) << attribute("y", at.y) << attribute("width", width) << attribute("height", height)
      << ' ' << style << "/>\n";
}
inline void svg_text(std::ostream& out, const Picture_point& at, std::string_view text, const std::string& style)
{
  out << "<text" << attribute("x", at.x) << attribute("y", at.y) << ' ' << style << '>' << escaped(text) << "</text>\n";
}
inline std::string stroke(const char* colour, double width, const char* more = "")
{
  return std::string("fill=\"none\" stroke=\"") + colour + "\" stroke-width=\"" + pixels(width) + "\"" + more;
}
inline std::string filled(const char* fill, const char* edge, double width)
{
  return std::string("fill=\"") + fill + "\" stroke=\"" + edge + "\" stroke-width=\"" + pixels(width) + "\"";
}
/// Style of a label that stays readable across lines.
inline std::string label_style(const char* colour, const char* anchor)
{
  return std::string("font-size=\"13\" text-anchor=\"") + anchor + "\" fill=\"" + colour +
         "\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"";
}
inline void svg_frame(std::ostream& out, const Panel& panel)
{
  svg_rectangle(out, {panel.left(), panel.top()}, panel.width(), panel.height(), stroke(picture::frame, 1));
}

} // namespace detail

} // namespace locus

#endif
