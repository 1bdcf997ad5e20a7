// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_H
#define LOCUS_IO_SVG_H

#include <locus/io/svg_legend.h>
#include <locus/io/svg_plane.h>
#include <locus/io/svg_square.h>

#include <fstream>
#include <stdexcept>

namespace locus {

namespace detail {

/// A locus in the plane on the left, its parameters on the right, a legend below.
class Bisector_picture {
public:
  Bisector_picture(std::ostream& out, const Locus<2>& locus, const std::vector<Curve_2>& inputs,
                   std::vector<Curvature_point<2>> marks, const std::vector<Exact_point<2>>& points)
    : out_(out), locus_(locus), scene_(locus, inputs, std::move(marks), points), square_(parameter_square(scene_)),
      has_purged_pair_(has_purged_pair(scene_, square_))
  {
  }

  void write()
  {
    constexpr double top = 76, plane_width = 600, plane_height = 500, margin = 40;
    const Panel plane("plane", margin, top, plane_width, plane_height, plane_box(scene_, plane_width / plane_height));
    const Panel square("parameters", margin + plane_width + 92, top, plane_height, plane_height, square_.box());
    const double width = scene_.has_parameters ? square.right() + margin : plane_width + 2 * margin;
    // The legend decides the height of the page, so it is laid out first.
    const Picture_legend key = legend();
    const double legend_top = top + plane_height + 62;
    const double height = legend_top + key.lay_out(legend_top, width, nullptr) + 26;

    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\"" << attribute("width", width) << attribute("height", height)
         << " viewBox=\"0 0 " << pixels(width) << ' ' << pixels(height)
         << "\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" font-size=\"14\" fill=\"" << picture::ink
         << "\">\n<title>" << escaped(title()) << "</title>\n<desc>" << escaped(caption()) << "</desc>\n";
    definitions(plane, square);
    svg_rectangle(out_, {0, 0}, width, height, "fill=\"#ffffff\"");
    svg_text(out_, {margin, 36}, title(), "font-size=\"20\" font-weight=\"bold\"");
    svg_text(out_, {margin, 60}, caption(),
             std::string("fill=\"") + (locus_.status() == Status::certified ? picture::faint_ink : picture::alarm) + "\"");
    Plane_drawing(out_, scene_, plane).write();
    if (scene_.has_parameters) Square_drawing(out_, scene_, square_, square).write();
    key.lay_out(legend_top, width, &out_);
    out_ << "</svg>\n";
  }

private:
  std::string title() const
  {
    if (is_evolute()) return scene_.marks.empty() ? "Evolute of a curve" : "Curvature of a curve, with its evolute";
    const std::string name = (locus_.is_trimmed() ? "True " : "Untrimmed ") + locus_.compute();
    if (scene_.has_point) return name + (is_of_two_points() ? " of two points" : " of a point and a curve");
    if (scene_.is_self) return name + " of a curve with itself";
    return name + (scene_.curves.size() == 2 ? " of two curves" : "");
  }

  bool is_evolute() const { return locus_.compute() == "evolute"; }

  bool is_of_two_points() const
  {
    const auto is_point = [](Feature f) { return f == Feature::point; };
    return scene_.points.size() > 1 || std::any_of(locus_.arcs().begin(), locus_.arcs().end(), [&](const Arc<2>& a) {
             return std::all_of(a.features().begin(), a.features().end(), is_point);
           });
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
    text += " · " + counted(locus_.arcs().size(), "arc") + " in " + counted(scene_.components.count, "component");
    std::size_t nodes = 0;
    for (const Locus_vertex<2>& v : locus_.vertices()) nodes += v.kind == Vertex_kind::node;
    if (nodes > 0) text += " · " + counted(nodes, "node");
    if (!locus_.degenerate().empty()) text += " · " + counted(locus_.degenerate().size(), "degenerate piece");
    for (const Mark_name& mark : mark_names()) {
      const auto n = std::count_if(scene_.marks.begin(), scene_.marks.end(), [&](const auto& p) { return p.kind == mark.kind; });
      if (n > 0) text += " · " + std::to_string(n) + " " + (n == 1 ? mark.short_name : mark.plural);
    }
    if (!is_evolute() && !scene_.is_untrimmed()) text += " · " + counted(locus_.statistics().cells, "cell");
    if (locus_.statistics().exact_cells > 0)
      text += ", " + std::to_string(locus_.statistics().exact_cells) + " of them exact";
    return text + " · " + label_of(1e3 * locus_.statistics().seconds, 2) + " ms";
  }

  struct Mark_name {
    Curvature_event kind;
    const char *name, *short_name, *plural;
  };
  static std::vector<Mark_name> mark_names()
  {
    using Event = Curvature_event;
    return {{Event::extremum, "extremum of the curvature", "extremum", "extrema"},
            {Event::kink, "kink of the curvature", "kink", "kinks"},
            {Event::jump, "jump of the curvature", "jump", "jumps"},
            {Event::stationary, "curvature stationary", "stationary point", "stationary points"},
            {Event::inflection, "inflection", "inflection", "inflections"},
            {Event::cusp, "cusp of the curve", "cusp", "cusps"}};
  }

  void definitions(const Panel& plane, const Panel& square)
  {
    const auto hatch = [&](const char* id, const char* back, const char* lines) {
      out_ << "<pattern id=\"" << id << "\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
           << "patternTransform=\"rotate(45)\"><rect width=\"6\" height=\"6\" fill=\"" << back << "\"/>"
           << "<rect width=\"2\" height=\"6\" fill=\"" << lines
           << "\"/></pattern>\n";
    };
    const auto clip = [&](const Panel& panel, const std::vector<Picture_point>& outline) {
      out_ << "<clipPath id=\"clip-" << panel.name() << "\"><path d=\"" << panel.polygon(outline) << "\"/></clipPath>\n";
    };
    out_ << "<defs>\n";
    clip(plane, plane.box().corners());
    clip(square, Square_drawing::outline(square_));
    hatch("hatch", "#ffe3e3", picture::alarm);
    hatch("degenerate-hatch", "#efe8f6", picture::degenerate);
    out_ << "</defs>\n";
  }

  Picture_legend legend() const
  {
    Picture_legend key;
    add_plane(key);
    add_vertices(key);
    add_cells(key);
    return key;
  }

  void add_plane(Picture_legend& key) const
  {
    if (scene_.curves.size() == 1) key.add("the curve", Picture_legend::line(stroke(picture::input[0], 2.5)));
    if (scene_.curves.size() == 2) {
      key.add("first curve", Picture_legend::line(stroke(picture::input[0], 2.5)));
      key.add("second curve", Picture_legend::line(stroke(picture::input[1], 2.5)));
    }
    if (!scene_.points.empty()) key.add("the point p", Picture_legend::input_point());
    if (scene_.has_joint(false)) key.add("joint", Picture_legend::joint(false));
    if (scene_.has_joint(true)) key.add("corner", Picture_legend::joint(true));
    const std::size_t count = scene_.components.count, shown = std::min<std::size_t>(count, 4);
    for (std::size_t c = 0; c < shown; ++c)
      key.add(count == 1 ? locus_.compute() : locus_.compute() + ", component " + std::to_string(c + 1),
              Picture_legend::line(stroke(component_colour(c), 2.5)));
    if (scene_.has_point) add_point(key);
    if (count > shown) key.add("… of " + std::to_string(count), Picture_legend::nothing());
    for (const auto& mark : mark_names())
      if (scene_.has_mark(mark.kind)) key.add(mark.name, Picture_legend::curvature_point(mark.kind));
    if (scene_.foot_curve(1) && !scene_.arcs.empty()) key.add("to the feet", Picture_legend::line(stroke(picture::foot, 0.9)));
    if (!scene_.asymptotes().empty()) key.add("asymptote", Picture_legend::line(stroke(picture::foot, 1.2, picture::dashes)));
  }

  void add_point(Picture_legend& key) const
  {
    if (scene_.has_arc(Arc_look::at_end))
      key.add("where the foot is an end or a corner", Picture_legend::line(arc_style(component_colour(0), Arc_look::at_end)));
    if (scene_.has_untrimmed()) key.add("untrimmed bisector", Picture_legend::line(Point_style::untrimmed()));
    if (!locus_.regions().empty()) key.add("p is the nearest point of the curve", Picture_legend::square(Point_style::region()));
    if (scene_.has_cell()) key.add("nearer to p", Picture_legend::square(Point_style::cell()));
    if (scene_.has_vertex(Vertex_kind::trim)) key.add("to the feet", Picture_legend::line(Point_style::feet()));
  }

  void add_vertices(Picture_legend& key) const
  {
    const std::pair<Vertex_kind, const char*> names[] = {{Vertex_kind::boundary, "end at a curve's end"},
                                                         {Vertex_kind::corner, "end at a curve's corner"},
                                                         {Vertex_kind::diagonal, "end on the diagonal"},
                                                         {Vertex_kind::infinity, "to infinity"},
                                                         {Vertex_kind::node, "node"},
                                                         {Vertex_kind::trim, "nearest feet change"},
                                                         {Vertex_kind::isolated, "isolated point"}};
    for (const auto& [kind, name] : names)
      if (scene_.has_vertex(kind) && !(scene_.has_point && kind == Vertex_kind::infinity)) key.add(name, Picture_legend::vertex(kind));
  }

  void add_cells(Picture_legend& key) const
  {
    const auto cell = [](const char* fill) { return Picture_legend::square(filled(fill, picture::frame, 1)); };
    // Where the equations have a factor that is known, the cells are those of the rest.
    const std::string rest = locus_.equations().size() > 1 ? " but for " + locus_.equations()[1].name : "";
    if (scene_.has_cell("empty")) key.add("cell proved empty" + rest, cell(picture::empty_cell));
    if (scene_.has_cell("graph")) key.add("cell proved a graph", cell(picture::graph_cell));
    if (scene_.has_cell("crossing")) key.add("cell of a node", cell(picture::crossing_cell));
    if (has_purged_pair_) key.add("pieces proved apart", cell("#ffffff"));
    if (has_degenerate(true))
      key.add("equation vanishes", Picture_legend::square(filled(picture::degenerate_hatch, picture::degenerate, 0.6)));
    if (has_degenerate(false))
      key.add("degenerate component", Picture_legend::line(stroke(picture::degenerate, 2.2, picture::dashes)));
    if (!locus_.undecided().empty())
      key.add("undecided", scene_.has_point ? Picture_legend::line(Point_style::undecided()) : cell(picture::undecided_hatch));
  }

  bool has_degenerate(bool everywhere) const
  {
    return std::any_of(locus_.degenerate().begin(), locus_.degenerate().end(), [everywhere](const Degenerate_piece& d) {
      return d.box.size() == 2 && (d.kind == "everything") == everywhere;
    });
  }

  std::ostream& out_;
  const Locus<2>& locus_;
  Picture_scene scene_;
  Parameter_square square_;
  bool has_purged_pair_;
};

} // namespace detail

/// Draws a locus of the plane: on the left the plane, near the inputs; on the right the square of the parameters t and r,
/// with the cells of the subdivision if the result keeps them (`Bisector_options::keep_cells`), of a curve with itself only
/// the half t ≥ r. Where an input's domain is infinite, each of its pieces is one unit of the square. Connected components
/// have one colour each. Given the input curves, they and lines to the feet are drawn too. Of an evolute there is the plane
/// only; points of the curve's curvature may be marked. Of a point and a curve there is the plane only, too: with the cell of
/// what is nearer to the point and, where the result keeps it, the untrimmed bisector behind the true one.
inline void write_svg(std::ostream& out, const Locus<2>& locus, const std::vector<Curve_2>& inputs = {},
                      const std::vector<Curvature_point<2>>& marks = {}, const std::vector<Exact_point<2>>& points = {})
{
  detail::Bisector_picture(out, locus, inputs, marks, points).write();
}

/// The same into a file. Throws std::runtime_error if it cannot be written.
inline void write_svg(const std::string& path, const Locus<2>& locus, const std::vector<Curve_2>& inputs = {},
                      const std::vector<Curvature_point<2>>& marks = {}, const std::vector<Exact_point<2>>& points = {})
{
  std::ofstream out(path, std::ios::binary);
  if (out) write_svg(out, locus, inputs, marks, points);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path);
}

} // namespace locus

#endif
