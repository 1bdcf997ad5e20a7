// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_SCENE_H
#define LOCUS_IO_SVG_SCENE_H

#include <locus/construct/curvature_points.h>
#include <locus/construct/locus.h>
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

/// What a picture shows: the locus, its inputs and its arcs, in coordinates relative to the inputs' middle.
struct Picture_scene {
  struct Drawn_arc {
    std::vector<Picture_point> plane;
    std::vector<Arc_point<2>> samples;
  };

  Picture_scene(const Locus<2>& of, const std::vector<Curve_2>& inputs, std::vector<Curvature_point<2>> marked)
    : locus(of), components(component_numbers(of)), marks(std::move(marked))
  {
    for (std::size_t k = 0; k < 2; ++k) centre[k] = std::isfinite(of.centre()[k]) ? of.centre()[k] : 0.0;
    for (const Curve_2& curve : inputs)
      curves.emplace_back(curve, std::array<Rational, 2>{exact_rational(centre[0]), exact_rational(centre[1])});
    // Of one curve and its evolute there is no square of parameters.
    has_parameters = of.compute() != "evolute" &&
                     std::all_of(of.arcs().begin(), of.arcs().end(), [](const Arc<2>& a) { return a.inputs().size() == 2; });
    is_self = of.compute() == "evolute" ? false : of.arcs().empty() ? inputs.size() == 1 : has_parameters && of.arcs()[0].inputs()[0] == of.arcs()[0].inputs()[1];
    for (const Arc<2>& arc : of.arcs()) arcs.push_back(draw(arc));
  }

  Picture_point placed(const Approximate_point<2>& p) const { return {p[0] - centre[0], p[1] - centre[1]}; }

  /// The curve on which the foot of an arc's parameter k lies, if it is known.
  const Pictured_curve* foot_curve(std::size_t k) const
  {
    const std::size_t input = is_self ? 0 : k;
    return input < curves.size() ? &curves[input] : nullptr;
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
  bool has_parameters = true, is_self = false;
  std::vector<Drawn_arc> arcs;

private:
  Drawn_arc draw(const Arc<2>& arc) const
  {
    constexpr double fine_enough = 2e-4; // of the inputs' diameter: a fraction of a pixel
    constexpr std::size_t samples = 257;
    Drawn_arc drawn;
    for (const Arc_point<2>& p : arc.polyline(fine_enough)) drawn.plane.push_back(placed(p.point()));
    drawn.samples = arc.samples(samples);
    return drawn;
  }
};

} // namespace detail

} // namespace locus

#endif
