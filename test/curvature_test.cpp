// SPDX-License-Identifier: LGPL-3.0-or-later
// Curvature extrema against the ends of self-bisectors, which another formula finds, and against differences in doubles.
#include <locus/bisector_2.h>
#include <locus/curvature.h>

#include "support.h"

#include <catch2/catch.hpp>

using namespace locus;
using Kind = Curvature_event;

namespace {

double middle(const Range& r) { return r.lo + 0.5 * (r.hi - r.lo); }

/// Signed curvature at a parameter, from the exact forms of the definition: x'×x''/|x'|³ by exact differences of the curve.
double curvature_by_definition(const Curve_2& curve, double u)
{
  const auto& ranges = curve.chain().pieces;
  std::size_t k = 0;
  while (k + 1 < ranges.size() && !(Rational(u) < ranges[k].hi)) ++k;
  const auto& piece = curve.pieces()[k];
  const Rational length = ranges[k].hi - ranges[k].lo, s = (Rational(u) - ranges[k].lo) / length, h(1, 1 << 20);
  const auto at = [&](const Rational& v, std::size_t axis) { return Rational(evaluate_at(piece.numerator[axis], v) / evaluate_at(piece.weight, v)); };
  std::array<double, 2> d1{}, d2{};
  for (std::size_t v = 0; v < 2; ++v) {
    d1[v] = Rational((at(s + h, v) - at(s - h, v)) / (2 * h)).get_d();
    d2[v] = Rational((at(s + h, v) - 2 * at(s, v) + at(s - h, v)) / (h * h)).get_d();
  }
  return (d1[0] * d2[1] - d1[1] * d2[0]) / std::pow(std::hypot(d1[0], d1[1]), 3);
}

Curve_2 random_spline(locus_test::Random& random, int degree, int spans, bool rational)
{
  std::vector<Coordinates_2> points;
  std::vector<Number> knots, weights;
  for (int i = 0; i <= degree; ++i) knots.emplace_back(0);
  for (int s = 1; s < spans; ++s) knots.emplace_back(s);
  for (int i = 0; i <= degree; ++i) knots.emplace_back(spans);
  for (int i = 0; i < degree + spans; ++i) {
    const int x = random.between(-50, 50), y = random.between(-50, 50);
    points.push_back({x, y});
    if (rational) weights.emplace_back(random.between(1, 4));
  }
  return bspline_2(degree, points, knots, weights);
}

} // namespace

TEST_CASE("an ellipse has four vertices, exactly, with the centres of curvature that everyone knows", "[curvature]")
{
  const auto points = curvature_points(ellipse_2({1, 2}, 4, 2));
  REQUIRE(points.size() == 4u);
  const double a = 4, b = 2;
  const std::array<std::array<double, 2>, 4> centres{{{1, 2 - (a * a - b * b) / b}, {1 - (a * a - b * b) / a, 2}, {1, 2 + (a * a - b * b) / b}, {1 + (a * a - b * b) / a, 2}}};
  for (const auto& p : points) {
    CHECK(p.kind == Kind::extremum); // at the quarters' joints
    CHECK(p.changes_sign());
    CHECK(p.parameter.lo == p.parameter.hi);
    REQUIRE(p.centre.has_value());
    bool known = false;
    for (const auto& c : centres) known = known || std::hypot((*p.centre)[0] - c[0], (*p.centre)[1] - c[1]) <= p.centre_error;
    CHECK(known);
    CHECK(p.centre_error < 1e-10);
  }
}

TEST_CASE("lines and circles have none, a parabola one, a cubic y = x³ two", "[curvature]")
{
  CHECK(curvature_points(segment_2({0, 0}, {3, 1})).empty());
  CHECK(curvature_points(arc_2({1, 0}, {0, 1}, "1/2")).empty());
  const auto parabola = curvature_points(bezier_2({{-1, 1}, {0, -1}, {2, 4}}));
  REQUIRE(parabola.size() == 1u);
  CHECK(parabola[0].multiplicity == 1);
  const auto cubic = curvature_points(bezier_2({{-1, -1}, {"-1/3", 1}, {"1/3", -1}, {1, 1}}));
  REQUIRE(cubic.size() == 2u); // and the inflection is none
  for (const auto& p : cubic) CHECK(std::abs(std::abs(p.point[0]) - std::pow(1.0 / 45, 0.25)) < 1e-12);
  // Where the curvature vanishes there is no centre: y = x⁴ at 0.
  const auto flat = curvature_points(bezier_2({{-1, 1}, {"-1/2", -1}, {0, 1}, {"1/2", -1}, {1, 1}}));
  REQUIRE(flat.size() == 3u);
  CHECK_FALSE(flat[1].centre.has_value());
}

TEST_CASE("a self-bisector ends on the diagonal at the curvature's extrema", "[curvature]")
{
  locus_test::Random random(71);
  locus_test::Samples ends, slopes;
  for (int k = 0; k < 60; ++k) {
    const Curve_2 curve = random_spline(random, random.between(2, 4), 1, k % 3 == 0);
    std::vector<double> expected, found;
    for (const auto& p : curvature_points(curve))
      if (p.kind == Kind::extremum) expected.push_back(middle(p.parameter));
    const Locus<2> self = untrimmed_bisector(curve);
    for (const auto& v : self.vertices())
      if (v.feet[0].parameters[0].lo <= v.feet[1].parameters[0].hi) found.push_back(middle(v.feet[0].parameters[0]));
    std::sort(found.begin(), found.end());
    bool same = self.status() == Status::certified && expected.size() == found.size();
    for (std::size_t i = 0; same && i < found.size(); ++i) same = std::abs(expected[i] - found[i]) < 1e-9;
    ends.expect(same, [&] { return std::to_string(expected.size()) + " extrema, " + std::to_string(found.size()) + " ends, curve " + std::to_string(k); });
    for (const double u : expected) {
      const double h = 1e-3, before = curvature_by_definition(curve, u - h), here = curvature_by_definition(curve, u), after = curvature_by_definition(curve, u + h);
      if (u < 2 * h || u > 1 - 2 * h) continue;
      slopes.expect((before - here) * (after - here) > 0 || std::abs(before - after) < 1e-3 * std::abs(here),
                    [&] { return "no extremum at " + std::to_string(u) + " of curve " + std::to_string(k); });
    }
  }
  LOCUS_REQUIRE_SAMPLES(ends, 60);
  LOCUS_REQUIRE_SAMPLES(slopes, 60);
}

TEST_CASE("joints: quadratic splines jump, cubic ones have kinks, inserted knots nothing", "[curvature]")
{
  const Curve_2 quadratic = bspline_2(2, {{0, 0}, {1, 2}, {3, 1}, {4, 3}}, {0, 0, 0, 1, 2, 2, 2});
  int jumps = 0, kinks = 0;
  for (const auto& p : curvature_points(quadratic)) jumps += p.kind == Kind::jump;
  CHECK(jumps == 1);
  const Curve_2 cubic = bspline_2(3, {{0, 0}, {1, 2}, {3, 1}, {4, 3}, {6, 2}}, {0, 0, 0, 0, 1, 2, 2, 2, 2});
  for (const auto& p : curvature_points(cubic)) kinks += p.kind == Kind::kink;
  CHECK(kinks == 1);
  const Curve_2 plain = bezier_2({{0, 0}, {1, 2}, {3, 1}, {4, 3}});
  CHECK(curvature_points(plain).size() == curvature_points(with_inserted_knot(plain, Rational(2, 7))).size());
}
