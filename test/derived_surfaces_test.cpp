// SPDX-License-Identifier: LGPL-3.0-or-later
// Drawn bisectors in space: vertices are looked at one by one (both feet equally far and seen at right angles), and triangles
// and boundaries are counted anew.
#include <locus/bisector_2.h>
#include <locus/bisector_3.h>

#include "shape_support.h"

#include <catch2/catch.hpp>

#include <map>

using namespace locus;
using locus_test::Random;
using locus_test::Samples;

namespace {

using Vector = std::array<double, 3>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// A foot and the tangents there, by exact evaluation.
struct Foot_place {
  Vector point{};
  std::vector<Vector> tangents;
};

Vector rounded(const Exact_point<3>& p) { return {p[0].get_d(), p[1].get_d(), p[2].get_d()}; }

Foot_place foot_on(const Curve_3& curve, double parameter)
{
  const Rational u(parameter);
  std::size_t i = 0;
  while (!locus_test::covers(curve.chain().pieces[i], u)) ++i;
  const auto& piece = curve.pieces()[i];
  const Rational s = locus_test::local_value(curve.chain().pieces[i], u);
  const locus_test::Polynomial w = locus_test::in_powers(piece.weight);
  const Rational at = locus_test::horner(w, s), slope_at = locus_test::horner(locus_test::slope(w), s);
  Foot_place foot;
  foot.tangents.resize(1);
  for (std::size_t k = 0; k < 3; ++k) {
    const locus_test::Polynomial p = locus_test::in_powers(piece.numerator[k]);
    const Rational x = locus_test::horner(p, s);
    foot.point[k] = Rational(x / at).get_d();
    foot.tangents[0][k] = Rational((locus_test::horner(locus_test::slope(p), s) * at - x * slope_at) / (at * at)).get_d();
  }
  return foot;
}

/// Differences of second order of exact values: within 1e-9 of the derivative.
Foot_place foot_on(const Rational_surface& surface, double u, double v)
{
  const auto& piece = surface.pieces()[0];
  const Rational h = locus_test::two_to(-24);
  const auto at = [&](const Rational& a, const Rational& b) {
    Exact_point<3> p;
    const Rational w = locus_test::plain_value<2>(piece.weight, {a, b});
    for (std::size_t k = 0; k < 3; ++k) p[k] = locus_test::plain_value<2>(piece.numerator[k], {a, b}) / w;
    return p;
  };
  const Rational a(u), b(v);
  Foot_place foot;
  foot.point = rounded(at(a, b));
  foot.tangents.resize(2);
  const auto u0 = at(a - h, b), u1 = at(a + h, b), v0 = at(a, b - h), v1 = at(a, b + h);
  for (std::size_t k = 0; k < 3; ++k) {
    foot.tangents[0][k] = Rational((u1[k] - u0[k]) / (2 * h)).get_d();
    foot.tangents[1][k] = Rational((v1[k] - v0[k]) / (2 * h)).get_d();
  }
  return foot;
}

/// All vertices of all sheets: `feet` gives those of a vertex's parameters; `angle` bounds what is off the normal plane, as a
/// part of the size.
template <class Feet>
void check_vertices(const Locus<3>& locus, Samples& samples, const std::string& name, Feet feet, double angle = 1e-9)
{
  for (const Sheet& sheet : locus.sheets()) {
    samples.expect(sheet.parameters.size() == sheet.points.size() && sheet.radius.size() == sheet.points.size(), name.c_str());
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
      const Vector p = sheet.points[i].coordinates;
      const std::vector<Foot_place> all = feet(sheet.parameters[i]);
      for (const Foot_place& foot : all) {
        const Vector off = p - foot.point;
        const double size = locus.scale() + length(p) + sheet.radius[i];
        samples.expect(std::abs(length(off) - sheet.radius[i]) < 1e-9 * size,
                       [&] { return name + ": distance " + std::to_string(length(off)) + ", radius " + std::to_string(sheet.radius[i]); });
        for (const Vector& t : foot.tangents)
          samples.expect(std::abs(dot(off, t)) <= angle * size * length(t), [&] { return name + ": off the normal plane by " + std::to_string(dot(off, t) / length(t)); });
      }
    }
  }
}

/// Edges from the triangles: each with one triangle is once in a loop, in its direction.
void check_topology(const Locus<3>& locus, Samples& samples, const std::string& name)
{
  for (const Sheet& sheet : locus.sheets()) {
    std::map<std::pair<std::size_t, std::size_t>, int> directed;
    for (const auto& t : sheet.triangles)
      for (std::size_t k = 0; k < 3; ++k) ++directed[{t[k], t[(k + 1) % 3]}];
    std::size_t edges = 0, free = 0;
    bool oriented = true;
    for (const auto& entry : directed) {
      const bool has_twin = directed.count({entry.first.second, entry.first.first}) > 0;
      oriented = oriented && entry.second == 1;
      free += !has_twin;
      edges += !has_twin || entry.first.first < entry.first.second;
    }
    std::size_t in_loops = 0;
    bool loops_are_free = true, known = true;
    for (const auto& b : sheet.boundary) {
      in_loops += b.loop.size();
      known = known && (b.kind == "domain" || b.kind == "infinity" || b.kind == "singular" || b.kind == "undecided");
      for (std::size_t k = 0; k < b.loop.size(); ++k) {
        const std::size_t from = b.loop[k], to = b.loop[(k + 1) % b.loop.size()];
        loops_are_free = loops_are_free && directed.count({from, to}) + directed.count({to, from}) == 1;
      }
    }
    samples.expect(oriented, [&] { return name + ": triangles turn against each other"; });
    samples.expect(in_loops == free && loops_are_free && known, [&] { return name + ": boundary"; });
    const auto euler = static_cast<std::ptrdiff_t>(sheet.points.size() + sheet.triangles.size()) - static_cast<std::ptrdiff_t>(edges);
    samples.expect(sheet.euler == euler, [&] { return name + ": Euler's number"; });
    // Closed by a disk for each loop it is an oriented surface.
    const auto closed = euler + static_cast<std::ptrdiff_t>(sheet.boundary.size());
    samples.expect(closed <= 2 && closed % 2 == 0, [&] { return name + ": Euler's number and the boundary"; });
  }
}

Exact_point<3> random_point(Random& random, int size)
{
  Exact_point<3> p;
  for (Rational& x : p) x = random.between(-size, size);
  return p;
}

Curve_3 random_bezier(Random& random, int degree, bool rational)
{
  std::vector<Exact_point<3>> points;
  std::vector<Rational> weights;
  for (int i = 0; i <= degree; ++i) {
    points.push_back(random_point(random, 9));
    if (rational) weights.emplace_back(random.between(1, 4));
  }
  return bezier_curve<3>(points, weights);
}

Mesh_options coarse()
{
  Mesh_options options;
  options.tolerance = 1e-1;
  options.max_cells = 3000;
  return options;
}

} // namespace

TEST_CASE("sheets of point/curve bisectors", "[derived]")
{
  Random random(701);
  Samples samples;
  std::size_t sheets = 0;
  for (int k = 0; k < 20; ++k) {
    const std::string name = "case " + std::to_string(k);
    const Curve_3 curve = random_bezier(random, 1 + k % 4, k % 2 == 0 && k % 4 != 0);
    const Exact_point<3> at = random_point(random, 9);
    const auto locus = untrimmed_bisector(at, curve, coarse());
    sheets += locus.sheets().size();
    check_topology(locus, samples, name);
    check_vertices(locus, samples, name, [&](const std::vector<double>& u) { return std::vector<Foot_place>{foot_on(curve, u[0]), {rounded(at), {}}}; });
    samples.expect(locus.rational_surface().has_value(), name.c_str());
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
  CHECK(sheets >= 20);
}

TEST_CASE("an ordinary point/curve bisector is drawn, though its generator's squared length has negative coefficients", "[derived]")
{
  const auto locus = untrimmed_bisector(Exact_point<3>{8, 4, -2}, bezier_3({{7, -2, -6}, {0, 9, 7}, {-5, -6, -6}}), coarse());
  CHECK(locus.status() == Status::certified);
  CHECK(locus.sheets().size() == 1u);
}

TEST_CASE("spans of a smooth spline have one sheet, those of a polyline one each", "[derived]")
{
  const Exact_point<3> q{Rational(1), Rational(1), Rational(4)};
  const auto smooth = bspline_3(2, {{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 1}, {5, 1, 0}}, {0, 0, 0, 1, 2, 3, 3, 3});
  CHECK(untrimmed_bisector(q, smooth, coarse()).sheets().size() == 1u);
  CHECK(untrimmed_bisector(q, polyline_3({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}), coarse()).sheets().size() == 2u);
}

TEST_CASE("sheets of curve/curve bisectors", "[derived]")
{
  Random random(702);
  Samples samples;
  std::size_t sheets = 0;
  for (int k = 0; k < 20; ++k) {
    const std::string name = "case " + std::to_string(k);
    const Curve_3 a = random_bezier(random, 1 + k % 3, k % 5 == 0), b = random_bezier(random, 1 + k / 3 % 3, k % 4 == 0);
    const auto locus = untrimmed_bisector(a, b, coarse());
    sheets += locus.sheets().size();
    check_topology(locus, samples, name);
    check_vertices(locus, samples, name, [&](const std::vector<double>& u) { return std::vector<Foot_place>{foot_on(a, u[0]), foot_on(b, u[1])}; });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
  CHECK(sheets >= 20);
}

TEST_CASE("sheets of point/surface bisectors", "[derived]")
{
  Random random(703);
  Samples samples;
  std::size_t sheets = 0;
  for (int k = 0; k < 20; ++k) {
    const std::string name = "case " + std::to_string(k);
    const Degrees<2> degrees{1 + k % 2, 1 + k / 2 % 2};
    std::vector<Exact_point<3>> points;
    std::vector<Rational> weights;
    for (int i = 0; i <= degrees[0]; ++i)
      for (int j = 0; j <= degrees[1]; ++j) {
        points.push_back({4 * i + random.between(-1, 1), 4 * j + random.between(-1, 1), random.between(-3, 3)});
        if (k % 3 == 0) weights.emplace_back(random.between(1, 3));
      }
    const Rational_surface surface = bezier_surface(degrees, points, weights);
    const Exact_point<3> at = random_point(random, 9);
    const auto locus = untrimmed_bisector(at, surface, coarse());
    sheets += locus.sheets().size();
    check_topology(locus, samples, name);
    check_vertices(locus, samples, name, [&](const std::vector<double>& u) { return std::vector<Foot_place>{foot_on(surface, u[0], u[1]), {rounded(at), {}}}; }, 1e-8);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
  CHECK(sheets >= 15);
}

TEST_CASE("the bisector of two points is a plane as far as the cut radius", "[derived]")
{
  Random random(704);
  Samples samples;
  for (int k = 0; k < 8; ++k) {
    const Exact_point<3> a = random_point(random, 9);
    Exact_point<3> b = random_point(random, 9);
    if (a == b) b[1] += 1;
    const auto locus = bisector(a, b);
    REQUIRE(locus.sheets().size() == 1u);
    check_topology(locus, samples, "plane");
    check_vertices(locus, samples, "plane", [&](const std::vector<double>&) { return std::vector<Foot_place>{{rounded(a), {}}, {rounded(b), {}}}; });
    const Sheet& sheet = locus.sheets()[0];
    REQUIRE(sheet.boundary.size() == 1u);
    CHECK(sheet.boundary[0].kind == "infinity");
    CHECK(sheet.euler == 1);
    for (const std::size_t i : sheet.boundary[0].loop)
      samples.expect(length(sheet.points[i].coordinates - locus.centre().coordinates) > locus.cut_radius() * (1 - 1e-9), "the boundary is beyond the cut radius");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 50);
  CHECK_THROWS_AS(bisector(Exact_point<3>{1, 2, 3}, Exact_point<3>{1, 2, 3}), Invalid_input);
}

TEST_CASE("curves of several spans are drawn on all of them", "[derived]")
{
  Samples samples;
  const Curve_3 spline = bspline_3(2, {{2, 0, 0}, {2, 2, 1}, {0, 2, 2}, {-2, 2, 3}, {-2, 0, 4}}, {0, 0, 0, 1, 2, 3, 3, 3});
  const Exact_point<3> at{0, 0, 2};
  const auto locus = untrimmed_bisector(at, spline, coarse());
  check_topology(locus, samples, "spline");
  check_vertices(locus, samples, "spline", [&](const std::vector<double>& u) { return std::vector<Foot_place>{foot_on(spline, u[0]), {rounded(at), {}}}; });
  std::array<int, 3> ends{}; // triangles with feet on a span
  for (const Sheet& sheet : locus.sheets())
    for (const auto& t : sheet.triangles) {
      double sum = 0;
      for (const std::size_t i : t) sum += sheet.parameters[i][0];
      for (std::size_t k = 0; k < 3; ++k) ends[k] += sum > 3 * static_cast<double>(k) && sum < 3 * static_cast<double>(k + 1);
    }
  for (const int n : ends) CHECK(n > 0);
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

// ------------------------------------------------------------------------------------------------- curves in one plane

namespace {

/// A plane curve put into space: origin + x·a + y·b for control points (x, y).
struct Plane_axes {
  Exact_point<3> origin, a, b;

  Curve_3 curve(const std::vector<std::array<int, 2>>& points, const std::vector<Rational>& weights = {}) const
  {
    std::vector<Exact_point<3>> out;
    for (const auto& p : points) {
      out.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) out.back()[k] = origin[k] + a[k] * p[0] + b[k] * p[1];
    }
    return bezier_curve<3>(out, weights);
  }
};

const std::vector<std::array<int, 2>> bow{{-3, 0}, {0, 3}, {4, 1}}, wave{{-2, -3}, {0, -1}, {2, -4}, {4, -2}};

void check_cylinder(const Curve_3& a, const Curve_3& b, const Vector& normal, const std::string& name)
{
  INFO(name);
  Samples samples;
  const auto locus = untrimmed_bisector(a, b, coarse());
  REQUIRE_FALSE(locus.sheets().empty());
  CHECK_FALSE(locus.rational_surface().has_value());
  bool told = false;
  for (const auto& d : locus.degenerate()) told = told || d.kind == "cylinder";
  CHECK(told);
  check_topology(locus, samples, name);
  for (const Sheet& sheet : locus.sheets())
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
      const Foot_place x = foot_on(a, sheet.parameters[i][0]), y = foot_on(b, sheet.parameters[i][1]);
      const Vector p = sheet.points[i].coordinates, to_x = p - x.point, to_y = p - y.point;
      const double size = locus.scale() + length(p), bound = sheet.error + 1e-7 * size;
      samples.expect(std::abs(length(to_x) - length(to_y)) < 1e-7 * size && std::abs(length(to_x) - sheet.radius[i]) < 1e-7 * size, "equidistant");
      samples.expect(std::abs(dot(to_x, x.tangents[0])) < bound * length(x.tangents[0]) && std::abs(dot(to_x, x.tangents[0])) < 1e-7 * size * length(x.tangents[0]), "perpendicular to the first");
      samples.expect(std::abs(dot(to_y, y.tangents[0])) < 1e-7 * size * length(y.tangents[0]), "perpendicular to the second");
      // Over and under the plane, so far that the cut radius is covered wherever the inputs' middle is.
      const double height = std::abs(dot(to_x, normal));
      samples.expect(height >= locus.cut_radius() + locus.scale() && height <= 2 * locus.cut_radius(), "height");
    }
  LOCUS_REQUIRE_SAMPLES(samples, 40);
}

} // namespace

TEST_CASE("curves in one plane have the cylinder over their planar bisector", "[derived]")
{
  const Plane_axes flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  check_cylinder(flat.curve(bow), flat.curve(wave, {1, 2, 1, 3}), {0, 0, 1}, "z = 0");
  // As many sheets as the planar bisector has arcs.
  const Curve_2 p = bezier_2({{-3, 0}, {0, 3}, {4, 1}}), q = bezier_2({{-2, -3}, {0, -1}, {2, -4}, {4, -2}}, {1, 2, 1, 3});
  CHECK(untrimmed_bisector(flat.curve(bow), flat.curve(wave, {1, 2, 1, 3}), coarse()).sheets().size() == untrimmed_bisector(p, q).arcs().size());
  // x + 2y + 2z = 3, whose normal has length 3; the axes need not be orthogonal.
  const Plane_axes tilted{{3, 0, 0}, {-2, 1, 0}, {-2, 0, 1}};
  check_cylinder(tilted.curve(bow), tilted.curve(wave), {1.0 / 3, 2.0 / 3, 2.0 / 3}, "x + 2y + 2z = 3");
  const Plane_axes irrational{{1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}};
  CHECK_THROWS_AS(untrimmed_bisector(irrational.curve(bow), irrational.curve(wave)), Unsupported_feature);
  // On one line all is equally far, or nothing.
  const auto line = untrimmed_bisector(segment_3({0, 0, 0}, {1, 1, 1}), segment_3({2, 2, 2}, {5, 5, 5}));
  REQUIRE(line.degenerate().size() == 1u);
  CHECK(line.degenerate()[0].kind == "everything");
}

TEST_CASE("nearly coplanar curves have a rational bisector", "[derived]")
{
  const Plane_axes flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Curve_piece<3> lifted = flat.curve(wave).pieces()[0];
  lifted.numerator[2][0] += locus_test::two_to(-40);
  const Curve_3 near({lifted}, Chain()), other = flat.curve(bow);
  Mesh_options options = coarse();
  options.max_cells = 500;
  const auto locus = untrimmed_bisector(other, near, options);
  CHECK(locus.rational_surface().has_value());
  for (const auto& d : locus.degenerate()) CHECK(d.kind != "cylinder");
  Samples samples;
  check_topology(locus, samples, "nearly flat");
}

TEST_CASE("a plane curve and a point of its plane: the ruled bisector is a cylinder", "[derived]")
{
  Samples samples;
  const Curve_3 quarter = bezier_3({{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {1, 1, 2});
  for (const Exact_point<3>& at : {Exact_point<3>{2, 0, 0}, Exact_point<3>{Rational(1, 3), Rational(1, 4), 0}}) {
    const auto locus = untrimmed_bisector(at, quarter, coarse());
    REQUIRE_FALSE(locus.sheets().empty());
    check_topology(locus, samples, "quarter");
    check_vertices(locus, samples, "quarter", [&](const std::vector<double>& u) { return std::vector<Foot_place>{foot_on(quarter, u[0]), {rounded(at), {}}}; });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 50);
}

TEST_CASE("where three planes share a line, the surface is cut around it and nothing stays undecided", "[derived]")
{
  const auto a = bezier_3({{1, 0, 0}, {1, 1, 1}, {-1, 1, 2}}), b = bezier_3({{3, 0, 0}, {3, 1, 2}, {2, 2, 1}, {3, 3, 0}});
  Mesh_options options;
  options.max_cells = 60000;
  const auto locus = untrimmed_bisector(a, b, options);
  CHECK(locus.status() == Status::certified);
  CHECK(locus.sheets().size() == 2u);
  REQUIRE(locus.degenerate().size() == 1u);
  CHECK(locus.degenerate()[0].kind == "line");
  // Next to the place, by the planes' equations alone: what two planes have in common is nearly in the third.
  const auto& box = locus.degenerate()[0].box;
  const double t = 0.5 * (box[0].lo + box[0].hi), r = 0.5 * (box[1].lo + box[1].hi);
  CHECK(box[0].hi - box[0].lo < 1e-9);
  const auto& map = locus.rational_surface()->pieces()[0];
  const std::array<Rational, 2> at{Rational(t), Rational(r)};
  double greatest = std::abs(evaluate(map.weight, at).get_d());
  for (const auto& f : map.numerator) greatest = std::max(greatest, std::abs(evaluate(f, at).get_d()));
  CHECK(greatest < 1e-8);
  // A hole is worth it: without the base point's own treatment there would be an error of the cut radius' size.
  for (const auto& sheet : locus.sheets()) CHECK(sheet.error < 0.2 * locus.scale());
}

TEST_CASE("an ellipse on the whole line: charts towards infinity, one sheet for all of it", "[derived]")
{
  const Curve_3 ellipse = monomial_curve<3>({{{2, 0, -2}, {0, 2}, {0}}}, {1, 0, 1}, {});
  const Exact_point<3> inside{Rational(1, 2), 0, Rational(1, 3)};
  const auto locus = untrimmed_bisector(inside, ellipse, coarse());
  CHECK(locus.status() == Status::certified);
  CHECK(locus.scale() > std::sqrt(20.0) - 1e-9); // of its bounding box, although a control point is at infinity
  CHECK(locus.sheets().size() == 1u);
  REQUIRE(locus.rational_surface().has_value());
  for (const auto& chart : locus.rational_surface()->pieces())
    for (const Rational& u : {Rational(1, 7), Rational(6, 7)})
      for (const Rational& v : {Rational(0), Rational(2, 3)}) {
        const auto x = image(chart, {u, v});
        REQUIRE(x.has_value());
        const auto parameter = chart.range[0].at(u);
        REQUIRE(parameter.has_value());
        const Rational q = 1 + *parameter * *parameter;
        const Exact_point<3> foot{Rational((2 - 2 * *parameter * *parameter) / q), Rational(2 * *parameter / q), Rational(0)};
        Rational difference = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const Rational to_foot = (*x)[k] - foot[k], to_point = (*x)[k] - inside[k];
          difference += to_foot * to_foot - to_point * to_point;
        }
        CHECK(difference == 0);
      }
}
