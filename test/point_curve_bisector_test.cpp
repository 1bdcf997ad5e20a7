// SPDX-License-Identifier: LGPL-3.0-or-later
// The true bisector of a point and a curve: the answers of closed form, both ways of trimming, readings (70) and (71), points
// in special position. Random ones are in point_curve_random_test.

#include "support.h"

#include <locus/bisector_2.h>
#include <locus/construct/bisector_events.h>
#include <locus/construct/trimming_by_elimination.h>
#include <locus/shape/spline_curve.h>

#include <catch2/catch.hpp>

using namespace locus;
using namespace locus_test;

namespace {

Curve_2 parabola(Number lo, Number hi) { return monomial_curve<2>({{{0, 1}, {0, 0, 1}}}, {}, {lo.value(), hi.value()}); }
Curve_2 whole_parabola() { return monomial_curve<2>({{{0, 1}, {0, 0, 1}}}, {}, {}); }

/// (1 - u², 2ku, 1 + u²).
Curve_2 ellipse(const Rational& k) { return monomial_curve<2>({{{1, 0, -1}, {0, Rational(2 * k)}}}, {1, 0, 1}, {}); }

std::vector<double> trims(const Locus<2>& locus)
{
  std::vector<double> found;
  for (const auto& v : locus.vertices())
    for (const Foot& f : v.feet)
      if (v.kind == Vertex_kind::trim && f.feature == Feature::interior) found.push_back(0.5 * (f.parameters[0].lo + f.parameters[0].hi));
  std::sort(found.begin(), found.end());
  return found;
}

std::size_t count(const Locus<2>& locus, Vertex_kind kind)
{
  return static_cast<std::size_t>(std::count_if(locus.vertices().begin(), locus.vertices().end(), [&](const auto& v) { return v.kind == kind; }));
}

/// Arcs with a foot inside the curve.
std::size_t interior_arcs(const Locus<2>& locus)
{
  return static_cast<std::size_t>(std::count_if(locus.arcs().begin(), locus.arcs().end(), [](const auto& a) {
    return std::find(a.features().begin(), a.features().end(), Feature::interior) != a.features().end();
  }));
}

} // namespace

TEST_CASE("a parabola: trims at the roots of (85), ends at those of (41)")
{
  // Inside: u = ±sqrt(β ± sqrt(β - α²)), all four outside, two inside of the vertex' circle of curvature.
  for (const auto& [a, b] : std::vector<std::pair<double, double>>{{0.25, 1}, {0, 2}, {0.25, 0.25}, {-0.125, 0.75}}) {
    const Locus<2> locus = bisector(Coordinates_2{a, b}, whole_parabola());
    std::vector<double> expected;
    for (const double sign : {1.0, -1.0}) {
      const double square = b + sign * std::sqrt(b - a * a);
      if (square > 0) expected.insert(expected.end(), {std::sqrt(square), -std::sqrt(square)});
    }
    std::sort(expected.begin(), expected.end());
    CAPTURE(a, b);
    CHECK(locus.status() == Status::certified);
    REQUIRE(trims(locus).size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(trims(locus)[i] == Approx(expected[i]).epsilon(1e-10));
    CHECK(locus.outline()->bounded);
    CHECK(locus.arcs().size() == expected.size() / 2);
    for (const auto& v : locus.vertices()) CHECK(std::abs((*v.point)[0]) < 1e-10); // on the axis
  }
  const Locus<2> outside = bisector(Coordinates_2{2, 1}, whole_parabola());
  CHECK(count(outside, Vertex_kind::infinity) == 2);
  REQUIRE(outside.arcs().size() == 1);
  CHECK(!outside.outline()->bounded);
  std::vector<double> ends;
  for (const auto& v : outside.vertices()) ends.push_back(v.feet[1].parameters[0].lo);
  std::sort(ends.begin(), ends.end());
  CHECK(ends[0] == Approx(2 - std::sqrt(3)).epsilon(1e-10));
  CHECK(ends[1] == Approx(2 + std::sqrt(3)).epsilon(1e-10));
}

TEST_CASE("a point on the vertex' circle of curvature: an extraordinary point, no trim")
{
  const Locus<2> on = bisector(Coordinates_2{0, 1}, whole_parabola());
  CHECK(on.status() == Status::certified);
  CHECK(on.arcs().size() == 1);
  REQUIRE(trims(on).size() == 2);
  CHECK(trims(on)[1] == Approx(std::sqrt(2.0)).epsilon(1e-10));
  const Rational tiny = Rational(1) / (Integer(1) << 30);
  // Just outside of it two more trims at u² ≈ β - sqrt(β): 2^-31 from the axis.
  const Locus<2> above = bisector(Coordinates_2{Rational(0), Rational(1 + tiny)}, whole_parabola());
  CHECK(above.status() == Status::certified);
  REQUIRE(trims(above).size() == 4);
  CHECK(trims(above)[2] == Approx(std::sqrt(0x1p-31)).epsilon(1e-4));
  CHECK(above.arcs().size() == 2);
  const Locus<2> below = bisector(Coordinates_2{Rational(0), Rational(1 - tiny)}, whole_parabola());
  CHECK(below.status() == Status::certified);
  CHECK(trims(below).size() == 2);
}

TEST_CASE("an ellipse: self-intersections by the circles of curvature, through u = infinity as well")
{
  struct Job {
    const char *x, *y;
    std::size_t trims, infinite;
  };
  // k = 1/2: inside, on the major axis; outside, on the minor one.
  for (const Job& job : std::vector<Job>{{"1/2", "1/8", 4, 0}, {"0", "0", 4, 0}, {"7/8", "1/16", 2, 0}, {"3", "2", 0, 2}, {"0", "2", 0, 2}}) {
    CAPTURE(job.x, job.y);
    const Locus<2> locus = bisector(Coordinates_2{job.x, job.y}, ellipse(Rational(1, 2)));
    CHECK(locus.status() == Status::certified);
    CHECK(trims(locus).size() == job.trims);
    CHECK(count(locus, Vertex_kind::infinity) == job.infinite);
    CHECK(locus.arcs().size() == (job.trims + job.infinite) / 2);
    for (const auto& v : locus.vertices())
      if (v.kind == Vertex_kind::trim) CHECK(std::abs((*v.point)[1]) < 1e-10);
  }
}

TEST_CASE("circles: conics (8), closed inside, half the radius at the centre")
{
  const Curve_2 circle = circle_2({0, 0}, 1);
  const Locus<2> inside = bisector(Coordinates_2{"1/2", "1/8"}, circle);
  CHECK(inside.status() == Status::certified);
  REQUIRE(inside.arcs().size() == 1);
  CHECK(inside.arcs()[0].is_closed());
  CHECK(inside.vertices().empty());
  const double a = 0.5, b = 0.125, s = a * a + b * b - 1;
  for (const auto& p : inside.arcs()[0].polyline(1e-6)) {
    const double x = p.point()[0], y = p.point()[1];
    const double f = (1 - a * a) * x * x + (1 - b * b) * y * y - 2 * a * b * x * y + s * (a * x + b * y) - 0.25 * s * s;
    if (std::abs(f) > 1e-9) FAIL("a point of the bisector that is not on the conic");
  }
  const Locus<2> central = bisector(Coordinates_2{0, 0}, circle);
  CHECK(central.status() == Status::certified);
  REQUIRE(central.arcs().size() == 1);
  for (const auto& p : central.arcs()[0].polyline(1e-6))
    if (std::abs(std::hypot(p.point()[0], p.point()[1]) - 0.5) > 1e-9) FAIL("not half the radius");
  const Locus<2> outside = bisector(Coordinates_2{3, 0}, circle);
  REQUIRE(outside.arcs().size() == 1);
  CHECK(count(outside, Vertex_kind::infinity) == 2);
}

TEST_CASE("a curve's own poles: both branches of a hyperbola bound the cell")
{
  const Curve_2 hyperbola = monomial_curve<2>({{{1, 0, 1}, {0, 2}}}, {1, 0, -1}, {});
  const Locus<2> locus = bisector(Coordinates_2{"1/4", "1/8"}, hyperbola);
  CHECK(locus.status() == Status::certified);
  CHECK(locus.arcs().size() == 2);
  CHECK(locus.outline()->bounded);
  const Locus<2> middle = bisector(Coordinates_2{0, 0}, hyperbola);
  CHECK(middle.status() == Status::certified);
  CHECK(middle.arcs().size() == 2);
}

TEST_CASE("a segment: parabola and two straight ends")
{
  const Locus<2> locus = bisector(Coordinates_2{0, 1}, segment_2({-1, 0}, {2, 0}));
  REQUIRE(locus.arcs().size() == 3);
  CHECK(interior_arcs(locus) == 1);
  CHECK(count(locus, Vertex_kind::trim) == 2);
  CHECK(count(locus, Vertex_kind::infinity) == 2);
}

TEST_CASE("a segment's line through the point: ends alone")
{
  const Locus<2> locus = bisector(Coordinates_2{-1, 0}, segment_2({0, 0}, {2, 0}));
  CHECK(locus.status() == Status::certified);
  REQUIRE(locus.arcs().size() == 1);
  CHECK(interior_arcs(locus) == 0);
}

TEST_CASE("where another system fails: no piece with an inner foot; a quartic with an axis")
{
  const Locus<2> locus = bisector(Coordinates_2{"0.3", 3}, bezier_2({{-1, 1}, {"-0.5", -1}, {"0.5", -1}, {1, 1}}));
  CHECK(locus.status() == Status::certified);
  CHECK(locus.arcs().size() == 2);
  CHECK(interior_arcs(locus) == 0);
  const Locus<2> quartic =
    bisector(Coordinates_2{0, "0.2"}, bezier_2({{"-1.6", "1.4336"}, {"-0.8", "-6.5536"}, {0, "8.26027"}, {"0.8", "-6.5536"}, {"1.6", "1.4336"}}));
  CHECK(quartic.status() == Status::certified);
  for (const auto& arc : quartic.arcs())
    for (const auto& p : arc.polyline(1e-6))
      if (std::abs(std::hypot(p.point()[0], p.point()[1] - 0.2) - p.radius()) > 1e-9) FAIL("the radius is not the distance");
}

TEST_CASE("points on the curve: a part of the normal line; at ends and corners a region")
{
  const Locus<2> smooth = bisector(Coordinates_2{1, 1}, whole_parabola());
  REQUIRE(smooth.arcs().size() == 1);
  CHECK(smooth.regions().empty());
  CHECK(count(smooth, Vertex_kind::trim) == 1); // the other foot is on the mirror side
  CHECK(count(smooth, Vertex_kind::infinity) == 1);
  for (const auto& p : smooth.arcs()[0].polyline(1e-6))
    if (std::abs((p.point()[0] - 1) + 2 * (p.point()[1] - 1)) > 1e-9) FAIL("a point off the normal line");
  const Locus<2> end = bisector(Coordinates_2{3, 9}, parabola(-3, 3));
  CHECK(end.status() == Status::certified);
  REQUIRE(end.regions().size() == 1);
  const Locus<2> corner = bisector(Coordinates_2{2, 2}, polyline_curve<2>({{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  REQUIRE(corner.regions().size() == 1);
  CHECK(corner.regions()[0].arcs.size() == 2);
}

TEST_CASE("exact ties: a point in the middle of a square")
{
  const Locus<2> closed = bisector(Coordinates_2{1, 1}, polyline_curve<2>({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}));
  CHECK(closed.status() == Status::certified);
  CHECK(closed.arcs().size() == 4);
  const Locus<2> open = bisector(Coordinates_2{1, 1}, polyline_curve<2>({{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  CHECK(open.status() == Status::certified);
  CHECK(open.arcs().size() == 3); // the ends' own lines give one point only
  CHECK(interior_arcs(open) == 3);
}

TEST_CASE("readings (70) and (71) of a bounded domain")
{
  const Curve_2 curve = parabola(-1, 2);
  const Locus<2> own = bisector(Coordinates_2{"1/4", 1}, curve);
  CHECK(own.arcs().size() == 3);
  CHECK(interior_arcs(own) == 2);
  Point_bisector_options options;
  options.beyond_ends = true;
  const Locus<2> continued = bisector(Coordinates_2{"1/4", 1}, curve, options);
  CHECK(continued.arcs().size() == 2);
  CHECK(count(continued, Vertex_kind::boundary) == 1);
  CHECK(trims(continued).back() == Approx(std::sqrt(1 + std::sqrt(15.0 / 16))).epsilon(1e-10));
  CHECK_THROWS_AS(bisector(Coordinates_2{0, 1}, polyline_curve<2>({{0, 0}, {1, 0}, {1, 1}}), options), Invalid_input);
}

TEST_CASE("the design's counterexample to the printed step 3")
{
  // p = (0,2), |u| ≤ 10: the distances at all three midpoints differ, yet u = ±1.2 are on the bisector.
  const Locus<2> locus = bisector(Coordinates_2{0, 2}, parabola(-10, 10));
  CHECK(interior_arcs(locus) == 2);
  const auto kept = trimmed_by_elimination({0, 2}, parabola(-10, 10));
  CHECK(kept.size() == 2);
}

TEST_CASE("both ways of trimming agree")
{
  Random random(run_seed() + 11);
  const auto compare = [&](const Coordinates_2& p, const Curve_2& curve, bool beyond_ends, const std::string& name) {
    Point_bisector_options options;
    options.beyond_ends = beyond_ends;
    options.keep_rational = true;
    const Locus<2> locus = bisector(p, curve, options);
    Trimming_options trimming;
    trimming.beyond_ends = beyond_ends;
    const auto kept = trimmed_by_elimination(p, curve, trimming);
    CAPTURE(name, beyond_ends);
    REQUIRE(locus.status() == Status::certified);
    REQUIRE(locus.kept_intervals()->size() == kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t e = 0; e < 2; ++e) {
        const Range& r = (*locus.kept_intervals())[i].ends[e];
        const Isolated_root<Rational>& root = kept[i].ends[e];
        CHECK((nearest_double(root.lo) <= r.hi && r.lo <= nearest_double(root.hi)));
      }
  };
  for (int i = 0; i < 24; ++i) {
    const int degree = 2 + i % 2, points = degree + 1;
    std::vector<Exact_point<2>> control;
    std::vector<Rational> weights;
    for (int k = 0; k < points; ++k) {
      control.push_back({Rational(random.between(-8, 8)) / 4, Rational(random.between(-8, 8)) / 4});
      weights.push_back(random.between(1, 3));
    }
    const double x = random.between(-31, 31), y = random.between(-31, 31);
    const Coordinates_2 p{x / 16, y / 16};
    const bool rational = i % 4 == 2;
    const std::string name = "job " + std::to_string(i);
    try {
      const Curve_2 curve = bezier_curve<2>(control, rational ? weights : std::vector<Rational>{});
      compare(p, curve, false, name);
      compare(p, curve, true, name);
    } catch (const Invalid_input&) {
      continue; // a single point
    }
  }
}

TEST_CASE("events: kinds and multiplicities, free of the curve's own poles")
{
  const Bisector_events on = bisector_events({0, 1}, parabola(-10, 10));
  REQUIRE(on.events.size() == 1);
  CHECK(on.events[0].kind == Bisector_event_kind::extraordinary);
  CHECK(on.events[0].place.multiplicity == 2);
  const Bisector_events off = bisector_events({0, 2}, parabola(-10, 10));
  REQUIRE(off.events.size() == 2);
  CHECK(off.events[0].kind == Bisector_event_kind::cusp);
  REQUIRE(off.segments.size() == 3);
  CHECK((off.segments[0].active && !off.segments[1].active && off.segments[2].active));
  const Curve_2 hyperbola = monomial_curve<2>({{{1, 0, 1}, {0, 2}}}, {1, 0, -1}, {});
  for (const auto& e : bisector_events({"1/4", "1/8"}, hyperbola).events) CHECK(std::abs(std::abs(e.parameter.lo) - 1) > 1e-9);
}
