// SPDX-License-Identifier: LGPL-3.0-or-later
// Evolutes, curvature and bisector surfaces where they are easily wrong: sizes at the limits of doubles, poles that nearly meet,
// places where the parametrisation is 0/0, inputs that share a plane or a point.
#include <locus/bisector_3.h>
#include <locus/curvature.h>
#include <locus/evolute.h>

#include "support.h"

#include <catch2/catch.hpp>

using namespace locus;

namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double distance_to_segment(const Vector& p, const Vector& a, const Vector& b)
{
  const Vector d = minus(b, a), x = minus(p, a);
  const double f = std::min(1.0, std::max(0.0, dot(x, d) / std::max(dot(d, d), 1e-300)));
  const Vector rest = minus(x, {f * d[0], f * d[1], f * d[2]});
  return std::sqrt(dot(rest, rest));
}

double distance_to_triangle(const Vector& p, const std::array<Vector, 3>& t)
{
  const Vector u = minus(t[1], t[0]), v = minus(t[2], t[0]), x = minus(p, t[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
  if (det > 0) {
    const double a = (dot(x, u) * vv - dot(x, v) * uv) / det, b = (dot(x, v) * uu - dot(x, u) * uv) / det;
    if (a >= 0 && b >= 0 && a + b <= 1) {
      const Vector rest = minus(x, {a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]});
      return std::sqrt(dot(rest, rest));
    }
  }
  double least = distance_to_segment(p, t[2], t[0]);
  for (std::size_t k = 0; k < 2; ++k) least = std::min(least, distance_to_segment(p, t[k], t[k + 1]));
  return least;
}

double distance_to_sheets(const Vector& p, const std::vector<Sheet>& sheets)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Sheet& s : sheets)
    for (const auto& t : s.triangles)
      least = std::min(least, distance_to_triangle(p, {s.points[t[0]].coordinates, s.points[t[1]].coordinates, s.points[t[2]].coordinates}));
  return least;
}

std::size_t count_of(const Locus<3>& locus, const std::string& kind)
{
  const auto& d = locus.degenerate();
  return static_cast<std::size_t>(std::count_if(d.begin(), d.end(), [&](const Degenerate_piece& piece) { return piece.kind == kind; }));
}

Curve_2 scaled_cubic(const Rational& f)
{
  return bezier_curve<2>({{Rational(0), Rational(0)}, {f, Rational(2 * f)}, {Rational(3 * f), Rational(2 * f)}, {Rational(4 * f), Rational(-f)}});
}

} // namespace

TEST_CASE("weights and coordinates of any size", "[derived]")
{
  for (const char* factor : {"1e52", "1e-60"}) {
    const Rational f = parse_rational(factor);
    const auto circle = evolute(bezier_2({{6, 7}, {6, 8}, {5, 8}}, {f, f, Rational(2 * f)}));
    REQUIRE(circle.vertices().size() == 1u);
    CHECK((*circle.vertices()[0].point)[0] == 5);
    CHECK((*circle.vertices()[0].point)[1] == 7);
    CHECK(std::abs(circle.vertices()[0].radius - 1) < 1e-14);
  }
  const auto plain = curvature_points(scaled_cubic(1));
  const auto drawn = evolute(scaled_cubic(1)).arcs()[0].polyline(1e-6);
  for (const char* factor : {"1e200", "1e-300"}) {
    const Rational f = parse_rational(factor);
    const auto points = curvature_points(scaled_cubic(f));
    REQUIRE(points.size() == plain.size());
    CHECK(std::isfinite(points[0].error));
    CHECK(points[0].error <= 1e-12 * nearest_double(f));
    CHECK(std::abs(points[0].radius / nearest_double(f) - plain[0].radius) < 1e-9);
    const auto line = evolute(scaled_cubic(f)).arcs()[0].polyline(1e-6);
    CHECK(line.error() <= 1.1e-6 * 6 * nearest_double(f));
    CHECK(line.size() < 2 * drawn.size());
    const auto surface = untrimmed_bisector(Exact_point<3>{}, bezier_curve<3>({{f, Rational(0), Rational(0)}, {f, f, f}, {Rational(0), f, Rational(2 * f)}}));
    CHECK(surface.status() == Status::certified);
    CHECK(surface.sheets().size() == 1u);
    const auto plane = bisector(Exact_point<3>{}, Exact_point<3>{f, Rational(2 * f), f});
    CHECK(plane.status() == Status::certified);
    REQUIRE(plane.sheets().size() == 1u);
    CHECK(plane.sheets()[0].error < 1e-10 * nearest_double(f));
  }
  CHECK_THROWS_AS(evolute(scaled_cubic(parse_rational("1e400"))), Unsupported_feature);
}

TEST_CASE("a tolerance that doubles cannot carry, or that would take millions of points, is not reached, and the error says so", "[derived]")
{
  const auto locus = evolute(scaled_cubic(1));
  const auto line = locus.arcs()[0].polyline(1e-15);
  CHECK(line.size() <= 100001u);
  CHECK(line.error() < 1e-7);
  CHECK(line.error() > 1e-15 * locus.scale());
}

TEST_CASE("two inflections next to each other: what is between is outside, and all directions are right", "[derived]")
{
  // x = v² + e·v, y = v³: at v = 0 the normal is (0, 1), at v = -e it is nearly so.
  for (const char* gap : {"1/100", "1/1000"}) {
    const Rational e = parse_rational(gap);
    const auto locus = evolute(monomial_curve<2>({{{0, e, 1}, {0, 0, 0, 1}}}, {}, {Rational(-1, 2), Rational(1, 2)}));
    std::size_t infinite = 0;
    for (const auto& v : locus.vertices()) {
      if (v.kind != Vertex_kind::infinity) continue;
      ++infinite;
      REQUIRE(v.direction.has_value());
      const double u = v.feet[0].parameters[0].lo, dx = 2 * u + e.get_d(), dy = 3 * u * u;
      CHECK(std::abs((*v.direction)[0] * dx + (*v.direction)[1] * dy) <= 1e-12 * std::hypot(dx, dy));
      REQUIRE(v.asymptote.has_value());
      const double x = u * u + e.get_d() * u, y = u * u * u; // it is the normal of the curve there
      CHECK(std::abs(((v.asymptote->point)[0] - x) * dx + ((v.asymptote->point)[1] - y) * dy) <= 1e-12 * std::hypot(dx, dy));
    }
    CHECK(infinite == 2u);
    CHECK(locus.arcs().size() == 3u);
    for (const auto& arc : locus.arcs()) CHECK(arc.polyline(1e-5).error() < 1.1e-5 * locus.scale());
  }
}

TEST_CASE("base points in a corner of the domain: what is left out is near, or undecided", "[derived]")
{
  const Rational t0(parse_rational("0.1252398")), r0(parse_rational("0.2419251")), margin(parse_rational("1e-5"));
  const auto first = [](const Rational& lo, const Rational& hi) {
    return monomial_curve<3>({{{0, 3}, {0, 3, -9, 6}, {0, 0, 0, 1}}}, {}, {lo, hi});
  };
  const auto second = [](const Rational& lo, const Rational& hi) {
    return monomial_curve<3>({{{0, 3}, {0, 0, 3, -2}, {3, -3, 6, -4}}}, {}, {lo, hi});
  };
  Mesh_options options;
  options.max_cells = 30000;
  for (const int corner : {0, 1, 2, 3, 4}) { // the last one in the middle of the domain
    const Curve_3 a = corner == 4 ? first(Rational(t0 / 2), Rational(2 * t0)) : corner & 1 ? first(Rational(t0 - margin), 1) : first(0, Rational(t0 + margin));
    const Curve_3 b = corner == 4 ? second(Rational(r0 / 2), Rational(2 * r0)) : corner & 2 ? second(Rational(r0 - margin), 1) : second(0, Rational(r0 + margin));
    const auto locus = untrimmed_bisector(a, b, options);
    if (corner == 4) REQUIRE((locus.status() == Status::certified && count_of(locus, "line") == 1u));
    if (locus.status() == Status::undecided) continue; // nothing is claimed
    double error = 0;
    for (const Sheet& s : locus.sheets()) error = std::max(error, s.error);
    const auto& map = locus.rational_surface()->pieces()[0];
    for (int i = 0; i < 24; ++i) {
      const double angle = 2 * 3.14159265358979 * i / 24;
      const Rational t = t0 + Rational(1e-6 * std::cos(angle)), r = r0 + Rational(1e-6 * std::sin(angle));
      const auto x = image(map, {map.range[0].local(t), map.range[1].local(r)});
      if (!x) continue;
      const Vector p{(*x)[0].get_d(), (*x)[1].get_d(), (*x)[2].get_d()};
      const Vector off = minus(p, locus.centre().coordinates);
      if (dot(off, off) > locus.cut_radius() * locus.cut_radius()) continue;
      INFO("corner " << corner << ", direction " << i);
      CHECK(distance_to_sheets(p, locus.sheets()) <= 1.001 * error);
    }
  }
}

TEST_CASE("what the parametrisation does not show is listed", "[derived]")
{
  const Exact_point<3> origin{};
  const auto on_curve = untrimmed_bisector(origin, monomial_curve<3>({{{0, 1}, {0, 0, 1}, {0, 0, 0, 1}}}, {}, {Rational(-1), Rational(1)}));
  CHECK(count_of(on_curve, "plane") == 1u);
  const auto on_line = untrimmed_bisector(origin, segment_3({1, 1, 0}, {2, 2, 0}));
  CHECK(count_of(on_line, "plane") == 1u);
  CHECK(on_line.sheets().empty());
  const auto in_surface = untrimmed_bisector(Exact_point<3>{Rational(1, 2), Rational(1, 2), 0}, bezier_surface_3({1, 1}, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}));
  CHECK(count_of(in_surface, "cone") == 1u);
  // The same where a row of the surface's weights is zero: positive all the same.
  const auto zero_weights = untrimmed_bisector(Exact_point<3>{0, 0, 5}, bezier_surface_3({2, 1}, {{0, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {2, 0, 0}, {2, 1, 1}}, {1, 1, 0, 0, 1, 1}));
  CHECK(std::isfinite(zero_weights.scale()));
}

TEST_CASE("pieces in one plane, and pieces that only seem to be", "[derived]")
{
  // A piece towards infinity has one finite control point: its plane is told by the others' directions.
  const auto parabola = monomial_curve<3>({{{0, 1}, {0, 0, 1}, {0}}}, {}, {Rational(1), std::nullopt});
  const auto bent = bspline_3(2, {{0, 0, 0}, {1, -3, 0}, {2, 0, 0}, {2, 1, 2}, {2, 3, 3}}, {0, 0, 0, 1, 1, 2, 2, 2});
  const auto locus = untrimmed_bisector(parabola, bent);
  CHECK(count_of(locus, "cylinder") == 2u); // both pieces with the first span only
  REQUIRE(locus.rational_surface().has_value());
  CHECK(locus.rational_surface()->pieces().size() == 2u);
  // Cylinders of single pairs go as far as all the rest.
  const auto mixed = untrimmed_bisector(bezier_3({{-1, 1, 0}, {0, -1, 0}, {1, 1, 0}}),
                                        bspline_3(2, {{2, 1, 0}, {3, -1, 0}, {4, 1, 0}, {4, 1, 20}, {4, 2, 40}}, {0, 0, 0, 1, 1, 2, 2, 2}));
  CHECK(count_of(mixed, "cylinder") == 1u);
  double farthest = 0;
  for (const Sheet& s : mixed.sheets())
    for (const auto& p : s.points)
      if (std::abs(std::abs(p[2]) - 40) > 0) farthest = std::max(farthest, std::hypot(p[0], p[1]));
  CHECK(farthest >= mixed.cut_radius());
}

TEST_CASE("time and cancellation end the work on surfaces", "[derived]")
{
  Mesh_options options;
  options.tolerance = 1e-9;
  options.max_cells = 100000000;
  options.control.max_seconds = 0.2;
  const auto a = bezier_3({{0, 0, 0}, {1, 1, 0}, {2, -1, 0}, {3, 0, 1}}), b = bezier_3({{0, 0, 3}, {1, 0, 2}, {2, 1, 3}, {3, 1, 2}});
  const auto locus = untrimmed_bisector(a, b, options);
  CHECK(locus.statistics().cells < 1000000u);
  CHECK(locus.statistics().cells > 0u);
}
