// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_SCENE_H
#define LOCUS_IO_SVG_SCENE_H

#include <locus/construct/curvature_points.h>
#include <locus/construct/locus.h>
#include <locus/io/picked_parameter.h>
#include <locus/io/svg_curve.h>

namespace locus {

namespace detail {

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

/// What a point's bisector has besides plain arcs: straight ones, whose foot on the curve stands still.
enum class Arc_look : unsigned char {
  plain,
  at_end,   ///< the foot is an end or a corner
  on_normal ///< the point lies on the curve
};

/// What a picture shows: the locus, its inputs and its arcs, in coordinates relative to the inputs' middle.
struct Picture_scene {
  struct Drawn_arc {
    std::vector<Picture_point> plane;
    std::vector<Arc_point<2>> samples;
    Arc_look look = Arc_look::plain;
  };

  Picture_scene(const Locus<2>& of, const std::vector<Curve_2>& inputs, std::vector<Curvature_point<2>> marked,
                const std::vector<Exact_point<2>>& input_points)
    : locus(of), components(component_numbers(of)), marks(std::move(marked))
  {
    for (std::size_t k = 0; k < 2; ++k) centre[k] = std::isfinite(of.centre()[k]) ? of.centre()[k] : 0.0;
    for (const Curve_2& curve : inputs) curves.emplace_back(curve, origin());
    for (const Exact_point<2>& p : input_points)
      points.push_back({nearest_double(p[0] - origin()[0]), nearest_double(p[1] - origin()[1])});
    has_point = !points.empty() || std::any_of(of.arcs().begin(), of.arcs().end(), [](const Arc<2>& a) { return has_feature(a, {Feature::point}); });
    // Of one curve and its evolute, or a point, there is no square of parameters.
    has_parameters = of.compute() != "evolute" && !has_point &&
                     std::all_of(of.arcs().begin(), of.arcs().end(), [](const Arc<2>& a) { return a.inputs().size() == 2; });
    is_self = has_parameters && (of.arcs().empty() ? inputs.size() == 1 : of.arcs()[0].inputs()[0] == of.arcs()[0].inputs()[1]);
    for (const Arc<2>& arc : of.arcs()) arcs.push_back(draw(arc));
  }

  std::array<Rational, 2> origin() const { return {exact_rational(centre[0]), exact_rational(centre[1])}; }

  Picture_point placed(const Approximate_point<2>& p) const { return {p[0] - centre[0], p[1] - centre[1]}; }

  /// The curve on which the foot of an arc's parameter k lies, if it is known.
  const Pictured_curve* foot_curve(std::size_t k) const
  {
    const std::size_t input = is_self ? 0 : k;
    return input < curves.size() ? &curves[input] : nullptr;
  }

  /// Where a foot lies, if that is known. Of a point and a curve parameters are the curve's.
  std::optional<Picture_point> point_of(const Foot& foot) const
  {
    if (foot.feature == Feature::point) return points.empty() ? std::nullopt : std::optional(points[0]);
    const Pictured_curve* curve = foot_curve(has_point ? 0 : foot.input);
    if (!curve || foot.parameters.empty()) return std::nullopt;
    return curve->at(picked(foot.parameters[0]));
  }

  /// Of a point and a curve: all that is nearest, or all solutions of the equations?
  bool is_true() const { return has_point && locus.is_trimmed(); }
  bool is_untrimmed() const { return has_point && !locus.is_trimmed(); }

  /// Is the locus a part of a rational curve that can be drawn behind it?
  bool has_untrimmed() const { return is_true() && locus.rational_curve(); }

  bool has_arc(Arc_look look) const
  {
    return std::any_of(arcs.begin(), arcs.end(), [look](const Drawn_arc& arc) { return arc.look == look; });
  }

  /// Does the locus bound points that are nearer to the point?
  bool has_cell() const { return locus.outline() && locus.regions().empty() && !has_arc(Arc_look::on_normal); }

  /// But for those of straight arcs, which are the arcs themselves.
  std::vector<Asymptote<2>> asymptotes() const
  {
    std::vector<Asymptote<2>> out;
    for (std::size_t v = 0; v < locus.vertices().size(); ++v)
      if (locus.vertices()[v].asymptote && !ends_straight(v)) out.push_back(*locus.vertices()[v].asymptote);
    return out;
  }

  /// What an input's parameter is called.
  const char* parameter_name(std::size_t input) const { return curves.size() != 2 ? "u" : input == 0 ? "t" : "r"; }

  bool has_vertex(Vertex_kind kind) const
  {
    return std::any_of(locus.vertices().begin(), locus.vertices().end(),
                       [kind](const Locus_vertex<2>& v) { return v.kind == kind; });
  }
  bool has_cell(std::string_view claim) const
  {
    return std::any_of(locus.cells().begin(), locus.cells().end(), [claim](const Cell_picture& c) { return c.claim == claim; });
  }
  bool has_mark(Curvature_event kind) const
  {
    return std::any_of(marks.begin(), marks.end(), [kind](const Curvature_point<2>& p) { return p.kind == kind; });
  }
  bool has_joint(bool corner) const
  {
    for (const Pictured_curve& curve : curves)
      for (const Joint& j : curve.joints())
        if (j.kind != Joint_kind::pole && (j.kind == Joint_kind::corner) == corner) return true;
    return false;
  }

  const Locus<2>& locus;
  Component_numbers components;
  std::vector<Curvature_point<2>> marks; ///< on the first input
  std::array<double, 2> centre{};
  std::vector<Pictured_curve> curves;
  std::vector<Picture_point> points; ///< that are inputs
  bool has_point = false, has_parameters = true, is_self = false;
  std::vector<Drawn_arc> arcs;

private:
  static bool has_feature(const Arc<2>& arc, const std::vector<Feature>& any_of)
  {
    return std::find_first_of(arc.features().begin(), arc.features().end(), any_of.begin(), any_of.end()) != arc.features().end();
  }

  Drawn_arc draw(const Arc<2>& arc) const
  {
    constexpr double fine_enough = 2e-4; // of the inputs' diameter: a fraction of a pixel
    constexpr std::size_t samples = 257;
    Drawn_arc drawn;
    for (const Arc_point<2>& p : arc.polyline(fine_enough)) drawn.plane.push_back(placed(p.point()));
    drawn.samples = arc.samples(samples);
    if (has_point) drawn.look = look_of(arc, drawn.samples);
    return drawn;
  }

  static Arc_look look_of(const Arc<2>& arc, const std::vector<Arc_point<2>>& samples)
  {
    if (has_feature(arc, {Feature::start, Feature::end, Feature::corner})) return Arc_look::at_end;
    if (samples.empty() || samples[0].parameters().empty()) return Arc_look::plain; // of two points
    const bool stands_still = std::all_of(samples.begin(), samples.end(), [&](const Arc_point<2>& p) {
      return p.parameters()[0].lo == samples[0].parameters()[0].lo && p.parameters()[0].hi == samples[0].parameters()[0].hi;
    });
    return stands_still ? Arc_look::on_normal : Arc_look::plain;
  }

  bool ends_straight(std::size_t vertex) const
  {
    for (std::size_t a = 0; a < arcs.size(); ++a)
      if (arcs[a].look != Arc_look::plain && (locus.arcs()[a].source() == vertex || locus.arcs()[a].target() == vertex)) return true;
    return false;
  }
};

} // namespace detail

} // namespace locus

#endif
