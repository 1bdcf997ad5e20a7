// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_LEGEND_H
#define LOCUS_IO_SVG_LEGEND_H

#include <locus/io/svg_point.h>

#include <functional>

namespace locus {

namespace detail {

/// A legend in rows: entries are laid out first, for the page's height, and written afterwards.
class Picture_legend {
public:
  /// Draws the symbol of an entry at a place.
  using Symbol = std::function<void(std::ostream&, const Picture_point&)>;

  void add(const std::string& text, Symbol symbol) { entries_.push_back({text, std::move(symbol)}); }

  /// Lays it out from `top` on; writes it if there is a stream. Returns its height.
  double lay_out(double top, double page_width, std::ostream* out) const
  {
    constexpr double row = 26, left = 40, symbol_width = 30, gap = 26;
    Picture_point at{left, top};
    for (const auto& [text, symbol] : entries_) {
      const double text_width = 7.1 * letters(text);
      if (at.x + symbol_width + text_width > page_width - left && at.x > left) at = {left, at.y + row};
      if (out) {
        symbol(*out, at);
        svg_text(*out, {at.x + symbol_width, at.y + 5}, text, "");
      }
      at.x += symbol_width + text_width + gap;
    }
    return at.y - top + 20;
  }

  static Symbol line(const std::string& style)
  {
    return [style](std::ostream& out, const Picture_point& p) { svg_path(out, "M" + pixels(p) + "h22", style); };
  }
  static Symbol square(const std::string& style)
  {
    return [style](std::ostream& out, const Picture_point& p) { svg_rectangle(out, {p.x + 5, p.y - 7}, 14, 14, style); };
  }
  static Symbol vertex(Vertex_kind kind)
  {
    return [kind](std::ostream& out, const Picture_point& p) { svg_vertex(out, {p.x + 12, p.y}, kind, component_colour(0)); };
  }
  static Symbol curvature_point(Curvature_event kind)
  {
    return [kind](std::ostream& out, const Picture_point& p) { svg_curvature_point(out, {p.x + 12, p.y}, kind); };
  }
  static Symbol input_point()
  {
    return [](std::ostream& out, const Picture_point& p) { svg_input_point(out, {p.x + 12, p.y}); };
  }
  static Symbol joint(bool corner)
  {
    return [corner](std::ostream& out, const Picture_point& p) {
      svg_path(out, "M" + pixels(p) + "h22", stroke(picture::input[0], 2.5));
      svg_joint(out, {p.x + 11, p.y}, {1, 0}, corner, picture::input[0]);
    };
  }
  static Symbol nothing()
  {
    return [](std::ostream&, const Picture_point&) {};
  }

private:
  std::vector<std::pair<std::string, Symbol>> entries_;
};

} // namespace detail

} // namespace locus

#endif
