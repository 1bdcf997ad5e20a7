// SPDX-License-Identifier: LGPL-3.0-or-later
// Pictures of a point and a curve: svg_point.h, svg_cell.h, svg_image.h.

#include "shape_support.h"

#include <locus/bisector_2.h>
#include <locus/construct/nearest_feet.h>
#include <locus/io/svg.h>

#include <catch2/catch.hpp>

#include <sstream>

using namespace locus;
using namespace locus::detail;
using namespace locus_test;

namespace {

struct Pair {
  Coordinates_2 point;
  Curve_2 curve;
};

Curve_2 parabola() { return monomial_curve<2>({{{0, 1}, {0, 0, 1}}}, {}, {}); }
Curve_2 segment() { return bezier_2({{0, 0}, {2, 1}}); }
Curve_2 zigzag() { return polyline_2({{-3, 2}, {-2, -1}, {0, 0}, {1, "-3/2"}, {3, -1}}); }

Locus<2> true_bisector(const Pair& pair) { return bisector(pair.point, pair.curve, {.control = {}, .keep_rational = true}); }

Picture_scene scene_of(const Locus<2>& locus, const Pair& pair) { return {locus, {pair.curve}, {}, {pair.point.exact()}}; }

std::string picture_of(const Locus<2>& locus, const Pair& pair)
{
  std::ostringstream out;
  write_svg(out, locus, {pair.curve}, {}, {pair.point.exact()});
  CHECK(!holds(out.str(), "nan"));
  CHECK(!holds(out.str(), "inf"));
  return out.str();
}

/// Is a place left of all sides of a convex polygon, by more than `margin`?
bool is_inside(const std::vector<Picture_point>& polygon, const Picture_point& at, double margin)
{
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Picture_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double length = std::hypot(q.x - p.x, q.y - p.y);
    if ((q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x) < margin * length) return false;
  }
  return !polygon.empty();
}

void expect(const std::string& text, const std::vector<const char*>& parts, bool there = true)
{
  for (const char* part : parts) {
    INFO(part);
    CHECK(holds(text, part) == there);
  }
}

} // namespace

TEST_CASE("the cell that is filled holds the points that are nearer to the point")
{
  const std::vector<Pair> pairs{{{1, 0}, parabola()},       {{"1/5", "1/2"}, parabola()},    {{"1/2", 1}, segment()},
                                {{4, 2}, segment()},        {{"1/2", 1}, zigzag()},          {{3, 0}, line_2({0, 0}, {1, 2})},
                                {{1, 5}, line_2({0, 0}, {1, 2})}, {{"3/10", "1/5"}, ellipse_2({0, 0}, 1, "1/2")}};
  for (const Pair& pair : pairs) {
    const Locus<2> locus = true_bisector(pair);
    const Picture_scene scene = scene_of(locus, pair);
    Picture_box box = plane_box(scene, 1.2);
    const std::vector<Picture_point> polygon = Cell_polygon(scene, box).points();
    REQUIRE(!polygon.empty());
    CHECK(box.contains(scene.points[0]));
    CHECK(is_inside(polygon, scene.points[0], 0));
    const Point_or_curve side(pair.point, pair.curve);
    const double margin = 1e-3 * box.size();
    for (int i = 1; i < 24; ++i)
      for (int j = 1; j < 24; ++j) {
        const Picture_point at{box.x0 + box.width() * i / 24, box.y0 + box.height() * j / 24};
        const Nearer nearer = side({at.x + scene.centre[0], at.y + scene.centre[1]});
        INFO(at.x << ' ' << at.y << ' ' << name_of(nearer));
        if (is_inside(polygon, at, margin)) CHECK(nearer == Nearer::point);
        if (nearer == Nearer::point) CHECK(is_inside(polygon, at, -margin));
      }
  }
}

TEST_CASE("a picture of a point shows trim vertices that are near, and is not blown up by far ones")
{
  const Pair near{{"1/4", "3/2"}, parabola()}, far{{1, 0}, monomial_curve<2>({{{0, 1}, {0, 0, 0, 1}}}, {}, {})};
  const Locus<2> first = true_bisector(near), second = true_bisector(far);
  REQUIRE(first.vertices().size() == 2);
  const Picture_scene scene = scene_of(first, near);
  for (const auto& v : first.vertices()) CHECK(plane_box(scene, 1.2).contains(scene.placed(*v.point)));
  const auto is_far = [](const Locus_vertex<2>& v) { return std::abs((*v.point)[0]) > 100; };
  REQUIRE(std::any_of(second.vertices().begin(), second.vertices().end(), is_far));
  CHECK(plane_box(scene_of(second, far), 1.2).size() < 6);
}

TEST_CASE("an untrimmed bisector is split where it goes through infinity")
{
  const Pair pair{{1, 0}, parabola()}; // poles at u = 0, 2 and ±∞
  const Rational_map<2, 1> map = untrimmed_bisector_map(pair.point, pair.curve);
  Picture_box box;
  box.add({-4, -4});
  box.add({4, 4});
  std::size_t splits = 0;
  for (const auto& piece : map.pieces()) {
    const Pictured_image image(Pictured_forms(piece.numerator, piece.weight, {0, 0}), box, 1e-3);
    const auto is_line = [](const std::vector<Picture_point>& part) { return part.size() > 1; }; // else an end at infinity
    splits += static_cast<std::size_t>(std::count_if(image.parts().begin(), image.parts().end(), is_line)) - 1;
    for (const auto& part : image.parts())
      for (std::size_t i = 1; i < part.size(); ++i) {
        const Picture_point &p = part[i - 1], &q = part[i];
        if (box.contains(p) && box.contains(q)) CHECK(std::hypot(q.x - p.x, q.y - p.y) < 1);
      }
  }
  CHECK(splits == 2);
}

TEST_CASE("pictures of a point say what they show")
{
  const Pair inside{{"1/2", 1}, zigzag()}, at_corner{{-2, -1}, zigzag()}, on_line{{1, "1/2"}, segment()};
  const std::vector<const char*> cell{"nearer to p"}, trimmed{"untrimmed bisector", "nearest feet change", "to the feet"};
  const std::string picture = picture_of(true_bisector(inside), inside);
  expect(picture, {"True bisector of a point and a curve", ">p</text>", "where the foot is an end or a corner", picture::point_cell});
  expect(picture, cell);
  expect(picture, trimmed);
  expect(picture, {"id=\"degenerate\"", "to infinity", ">t</text>", "asymptote"}, false); // nor a square of parameters

  const std::string region = picture_of(true_bisector(at_corner), at_corner);
  expect(region, {"p is the nearest point of the curve"});
  expect(region, cell, false);
  expect(picture_of(true_bisector(on_line), on_line), cell, false);

  const std::string untrimmed = picture_of(untrimmed_bisector(inside.point, inside.curve), inside);
  expect(untrimmed, {"Untrimmed bisector of a point and a curve"});
  expect(untrimmed, trimmed, false);

  Locus_data<2> data;
  data.compute = "bisector";
  data.trimmed = true;
  data.undecided.push_back({{{0.5, 0.75}}, "limit"});
  const std::string open = picture_of(Locus<2>(data), inside);
  expect(open, {"1 box undecided", ">undecided</text>", "stroke-width=\"8\""});
  std::ostringstream alone;
  write_svg(alone, true_bisector(inside));
  CHECK(holds(alone.str(), "True bisector of a point and a curve"));
}
