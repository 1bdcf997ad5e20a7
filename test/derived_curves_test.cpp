// SPDX-License-Identifier: LGPL-3.0-or-later
// Special points of curves against independent counts of roots, and drawn evolutes against exact centres of curvature.
#include <locus/curvature.h>
#include <locus/evolute.h>

#include "shape_support.h"

#include <catch2/catch.hpp>

using namespace locus;
using locus_test::Polynomial;
using locus_test::Random;
using locus_test::Samples;
using Kind = Curvature_event;

namespace {

double middle(const Range& r) { return r.lo + 0.5 * (r.hi - r.lo); }

template <int Dim>
Rational_curve<Dim> random_bezier(Random& random, int degree, bool rational, int size = 50)
{
  std::vector<Exact_point<Dim>> points(static_cast<std::size_t>(degree) + 1);
  std::vector<Rational> weights;
  for (auto& p : points) {
    for (Rational& x : p) x = random.between(-size, size);
    if (rational) weights.emplace_back(random.between(1, 9));
  }
  return bezier_curve<Dim>(points, weights);
}

/// x, x', x'' and x''' at a rational place of a piece, by Leibniz' rule for x·w = p.
template <int Dim>
std::array<Exact_point<Dim>, 4> derivatives(const Curve_piece<Dim>& piece, const Rational& u)
{
  const auto all = [&](const Bernstein<Rational, 1>& f) {
    std::array<Rational, 4> d;
    Polynomial g = locus_test::in_powers(f);
    for (Rational& x : d) {
      x = locus_test::horner(g, u);
      g = locus_test::slope(g);
    }
    return d;
  };
  const auto w = all(piece.weight);
  std::array<Exact_point<Dim>, 4> x;
  for (std::size_t v = 0; v < static_cast<std::size_t>(Dim); ++v) {
    const auto p = all(piece.numerator[v]);
    for (std::size_t k = 0; k < 4; ++k) {
      Rational sum = p[k];
      for (std::size_t j = 1; j <= k; ++j) sum -= locus_test::choose(static_cast<int>(k), static_cast<int>(j)) * w[j] * x[k - j][v];
      x[k][v] = sum / w[0];
    }
  }
  return x;
}

template <std::size_t N>
Rational dot(const std::array<Rational, N>& a, const std::array<Rational, N>& b)
{
  Rational sum = 0;
  for (std::size_t k = 0; k < N; ++k) sum += a[k] * b[k];
  return sum;
}

/// The sign of (κ²)' by |x'|⁶κ² = |x'|²|x''|² - (x'·x'')².
template <int Dim>
int growth_sign(const Curve_piece<Dim>& piece, const Rational& u)
{
  const auto x = derivatives(piece, u);
  const Rational m = dot(x[1], x[1]), a = dot(x[1], x[2]), b = dot(x[2], x[2]), n = m * b - a * a;
  const Rational dm = 2 * a, da = b + dot(x[1], x[3]), db = 2 * dot(x[2], x[3]), dn = dm * b + m * db - 2 * a * da;
  return sgn(Rational(dn * m - 3 * n * dm));
}

/// det(f, f', f'', …) by the first row.
Polynomial determinant(const std::vector<std::vector<Polynomial>>& rows)
{
  if (rows.size() == 1) return rows[0][0];
  Polynomial sum;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<std::vector<Polynomial>> rest(rows.begin() + 1, rows.end());
    for (auto& row : rest) row.erase(row.begin() + static_cast<std::ptrdiff_t>(k));
    sum = locus_test::plus(sum, locus_test::times(locus_test::times(rows[0][k], determinant(rest)), {Rational(k % 2 == 0 ? 1 : -1)}));
  }
  return sum;
}

/// Of the homogeneous coordinates: zero where the curve has an inflection in the plane, no torsion in space.
template <int Dim>
Polynomial flatness(const Curve_piece<Dim>& piece)
{
  std::vector<std::vector<Polynomial>> rows(1);
  for (const auto& f : piece.numerator) rows[0].push_back(locus_test::in_powers(f));
  rows[0].push_back(locus_test::in_powers(piece.weight));
  while (rows.size() < rows[0].size()) {
    rows.emplace_back();
    for (const Polynomial& f : rows[rows.size() - 2]) rows.back().push_back(locus_test::slope(f));
  }
  return determinant(rows);
}

template <class Points>
bool roots_of(const Points& points, const Polynomial& f, Kind kind)
{
  const locus_test::Sturm sturm(f);
  int found = 0;
  for (const auto& p : points) {
    if (p.kind != kind) continue;
    ++found;
    if (p.parameter.lo > p.parameter.hi || sturm.closed(Rational(p.parameter.lo), Rational(p.parameter.hi)) != 1) return false;
  }
  return found == sturm.closed(0, 1);
}

Curve_2 graph(const Polynomial& y, int degree) // over [-1, 1]
{
  const auto f = locus_test::bernstein_on(y, -1, 1, degree), x = locus_test::bernstein_on({0, 1}, -1, 1, degree);
  std::vector<Exact_point<2>> points;
  for (std::size_t i = 0; i < f.size(); ++i) points.push_back({x[i], f[i]});
  return bezier_curve<2>(points);
}

} // namespace

// -------------------------------------------------------------------------------------------------------- special points

TEST_CASE("inflections of known curves", "[derived]")
{
  const auto cubic = inflections(graph({0, 0, 0, 1}, 3));
  REQUIRE(cubic.size() == 1u);
  CHECK(cubic[0].kind == Kind::inflection);
  CHECK(cubic[0].multiplicity == 1);
  CHECK((cubic[0].before < 0 && cubic[0].after > 0));
  CHECK((cubic[0].parameter.lo <= 0.5 && cubic[0].parameter.hi >= 0.5));
  CHECK(std::hypot(cubic[0].point[0], cubic[0].point[1]) <= cubic[0].error);
  CHECK_FALSE(cubic[0].centre.has_value());
  const auto quartic = inflections(graph({0, 0, 0, 0, 1}, 4));
  REQUIRE(quartic.size() == 1u);
  CHECK(quartic[0].multiplicity == 2);
  CHECK((quartic[0].before > 0 && quartic[0].after > 0));
  // A parabola away from its vertex is a spiral.
  const Curve_2 spiral = bezier_2({{"1/2", "1/4"}, {"5/4", 1}, {2, 4}});
  CHECK(inflections(spiral).empty());
  CHECK(curvature_points(spiral).empty());
  // An S of two parabolas bends over at the joint, without curvature zero on either side.
  const auto s = inflections(bspline_2(2, {{0, 0}, {1, 2}, {3, -2}, {4, 0}}, {0, 0, 0, 1, 2, 2, 2}));
  REQUIRE(s.size() == 1u);
  CHECK((s[0].parameter.lo == 1 && s[0].parameter.hi == 1));
  CHECK((s[0].before < 0 && s[0].after > 0));
  // In space the curvature itself may vanish: x''(0) = 0 at the middle of (t, t³, t⁴).
  const auto y = locus_test::bernstein_on({0, 0, 0, 1}, -1, 1, 4), z = locus_test::bernstein_on({0, 0, 0, 0, 1}, -1, 1, 4), x = locus_test::bernstein_on({0, 1}, -1, 1, 4);
  std::vector<Exact_point<3>> points;
  for (std::size_t i = 0; i < 5; ++i) points.push_back({x[i], y[i], z[i]});
  const auto flat = inflections(bezier_curve<3>(points));
  REQUIRE(flat.size() == 1u);
  CHECK((flat[0].parameter.lo <= 0.5 && flat[0].parameter.hi >= 0.5));
  CHECK((flat[0].before == 0 && flat[0].after == 0));
}

TEST_CASE("inflections and torsion zeros are as many as the determinants have roots", "[derived]")
{
  Random random(601);
  Samples samples;
  int inflected = 0, twisted = 0;
  for (int k = 0; k < 40; ++k) {
    const int d = random.between(3, 5);
    const bool rational = k % 2 == 0;
    const auto tell = [&] { return "degree " + std::to_string(d) + ", case " + std::to_string(k); };
    const Curve_2 plane = random_bezier<2>(random, d, rational);
    const auto points = inflections(plane);
    inflected += static_cast<int>(points.size());
    samples.expect(roots_of(points, flatness(plane.pieces()[0]), Kind::inflection), tell);
    const Rational_curve<3> space = random_bezier<3>(random, d, rational);
    const auto zeros = torsion_zeros(space);
    twisted += static_cast<int>(zeros.size());
    const Polynomial f = flatness(space.pieces()[0]);
    samples.expect(d == 3 ? f.size() == 1 && zeros.empty() : roots_of(zeros, f, Kind::torsion_zero), tell);
    // τ has the sign of [x' x'' x'''].
    for (const auto& p : zeros)
      for (const bool after : {false, true}) {
        const Rational u = after ? Rational(Rational(p.parameter.hi) + locus_test::two_to(-40)) : Rational(Rational(p.parameter.lo) - locus_test::two_to(-40));
        if (u < 0 || u > 1) {
          samples.expect((after ? p.after : p.before) == 0, tell);
          continue;
        }
        const auto x = derivatives(space.pieces()[0], u);
        Rational volume = 0;
        for (std::size_t a = 0; a < 3; ++a) volume += x[1][a] * (x[2][(a + 1) % 3] * x[3][(a + 2) % 3] - x[2][(a + 2) % 3] * x[3][(a + 1) % 3]);
        samples.expect(sgn(volume) == (after ? p.after : p.before), tell);
      }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 90);
  CHECK(inflected > 10);
  CHECK(twisted > 10);
}

TEST_CASE("between critical points the curvature grows or falls as they say", "[derived]")
{
  Random random(602);
  Samples samples;
  int extrema = 0;
  const auto check = [&](const auto& curve, int number) {
    const auto& piece = curve.pieces()[0];
    const auto points = curvature_points(curve);
    constexpr bool plane = std::tuple_size_v<std::decay_t<decltype(piece.numerator)>> == 2;
    const auto tell = [number] { return "curve " + std::to_string(number); };
    std::vector<Rational> ends{0};
    for (const auto& p : points) {
      extrema += p.kind == Kind::extremum;
      ends.emplace_back(p.parameter.lo);
      ends.emplace_back(p.parameter.hi);
      // In the plane before and after are those of the signed curvature.
      const int side = plane ? (p.curvature.lo > 0 ? 1 : -1) : 1;
      const Rational before = Rational(p.parameter.lo) - locus_test::two_to(-40), after = Rational(p.parameter.hi) + locus_test::two_to(-40);
      samples.expect((before < 0 ? 0 : growth_sign(piece, before)) == side * p.before, tell);
      samples.expect((after > 1 ? 0 : growth_sign(piece, after)) == side * p.after, tell);
    }
    ends.emplace_back(1);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
      for (int k = 1; k < 6; ++k) {
        const Rational u = ends[i] + (ends[i + 1] - ends[i]) * Rational(k) / 6;
        int sign = growth_sign(piece, u);
        if (plane) { // of κ, not of κ²: it goes on through inflections
          const auto x = derivatives(piece, u);
          sign *= sgn(Rational(x[1][0] * x[2][1] - x[1][1] * x[2][0]));
        }
        const std::size_t gap = i / 2;
        samples.expect((gap == 0 || sign == points[gap - 1].after) && (gap == points.size() || sign == points[gap].before), tell);
      }
  };
  for (int k = 0; k < 24; ++k) {
    check(random_bezier<3>(random, 2 + k % 3, k % 2 == 0), k);
    check(random_bezier<2>(random, 2 + k % 3, k % 2 == 0), k);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  CHECK(extrema > 40);
}

TEST_CASE("cusps at irrational parameters and degenerate pieces are told", "[derived]")
{
  // x' = 2t² - 1, y' = t·x'.
  const auto x = locus_test::bernstein_on_unit({0, -1, 0, Rational(2, 3)}, 4), y = locus_test::bernstein_on_unit({0, 0, Rational(-1, 2), 0, Rational(1, 2)}, 4);
  std::vector<Exact_point<2>> points;
  for (std::size_t i = 0; i < 5; ++i) points.push_back({x[i], y[i]});
  const auto cusped = analyse_curvature(bezier_curve<2>(points));
  int cusps = 0;
  for (const auto& p : cusped.points)
    if (p.kind == Kind::cusp) {
      ++cusps;
      CHECK(std::abs(middle(p.parameter) - std::sqrt(0.5)) < 1e-14);
    }
  CHECK(cusps == 1);
  const auto kind_of = [](const auto& analysis) { return analysis.degenerate.empty() ? std::string() : analysis.degenerate[0].kind; };
  CHECK(kind_of(analyse_curvature(segment_2({0, 0}, {3, 1}))) == "straight");
  CHECK(kind_of(analyse_curvature(arc_2({1, 0}, {0, 1}, "1/3"))) == "constant curvature");
  CHECK(kind_of(analyse_curvature(bezier_3({{0, 0, 1}, {1, 2, -2}, {3, 1, -3}, {4, 5, -8}}))) == "plane");
  CHECK(kind_of(analyse_curvature(bezier_3({{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 0, 3}}))).empty());
}

// -------------------------------------------------------------------------------------------------------------- evolutes

namespace {

template <int Dim>
double distance_to_segment(const std::array<double, static_cast<std::size_t>(Dim)>& p, const std::array<double, static_cast<std::size_t>(Dim)>& a,
                           const std::array<double, static_cast<std::size_t>(Dim)>& b)
{
  double along = 0, length2 = 0, off = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    along += (p[k] - a[k]) * (b[k] - a[k]);
    length2 += (b[k] - a[k]) * (b[k] - a[k]);
  }
  const double f = length2 > 0 ? std::min(1.0, std::max(0.0, along / length2)) : 0.0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double d = p[k] - a[k] - f * (b[k] - a[k]);
    off += d * d;
  }
  return std::sqrt(off);
}

template <int Dim>
using Doubles = std::array<double, static_cast<std::size_t>(Dim)>;

/// The centre of curvature x + |x'|²·n/|n|²·…, from the derivatives: n is |x'|²x'' - (x'·x'')x'.
template <int Dim>
std::optional<Doubles<Dim>> centre_at(const Rational_curve<Dim>& curve, const Rational& parameter)
{
  std::size_t i = 0;
  while (!locus_test::covers(curve.chain().pieces[i], parameter)) ++i;
  const auto x = derivatives(curve.pieces()[i], locus_test::local_value(curve.chain().pieces[i], parameter));
  const Rational speed = dot(x[1], x[1]), along = dot(x[1], x[2]), curved = dot(x[2], x[2]) * speed - along * along;
  if (curved == 0) return std::nullopt;
  Doubles<Dim> c;
  for (std::size_t k = 0; k < c.size(); ++k) c[k] = Rational(x[0][k] + speed * (speed * x[2][k] - along * x[1][k]) / curved).get_d();
  return c;
}

/// All along an arc the polyline and the exact centres stay within its error of each other.
template <int Dim>
void check_polyline(const Rational_curve<Dim>& curve, const Arc<Dim>& arc, double tolerance, Samples& samples)
{
  const auto line = arc.polyline(tolerance);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Rational from(line[i].parameter(0)), to(line[i + 1].parameter(0));
    const auto &a = line[i].point().coordinates, &b = line[i + 1].point().coordinates;
    std::vector<Doubles<Dim>> exact;
    constexpr int steps = 6;
    for (int k = 1; k < steps; ++k)
      if (const auto c = centre_at(curve, Rational(from + (to - from) * Rational(k) / steps))) exact.push_back(*c);
    if (!(from < to)) continue; // across the seam of a closed curve
    for (const auto& c : exact)
      samples.expect(distance_to_segment<Dim>(c, a, b) <= line.error(), [&] { return "the curve is " + std::to_string(distance_to_segment<Dim>(c, a, b) / line.error()) + " errors away"; });
    exact.insert(exact.begin(), a);
    exact.push_back(b);
    for (int k = 1; k < 4; ++k) {
      Doubles<Dim> p{};
      for (std::size_t v = 0; v < p.size(); ++v) p[v] = a[v] + 0.25 * k * (b[v] - a[v]);
      double nearest = 1e300;
      for (std::size_t j = 0; j + 1 < exact.size(); ++j) nearest = std::min(nearest, distance_to_segment<Dim>(p, exact[j], exact[j + 1]));
      samples.expect(nearest <= 1.1 * line.error(), "a segment leaves the curve");
    }
  }
}

} // namespace

TEST_CASE("the evolute of an ellipse is one closed arc with four cusps", "[derived]")
{
  const Curve_2 ellipse = ellipse_2({1, 2}, 4, 2);
  const auto locus = evolute(ellipse);
  CHECK(locus.status() == Status::certified);
  REQUIRE(locus.arcs().size() == 1u);
  CHECK(locus.arcs()[0].is_closed());
  CHECK(locus.vertices().empty());
  CHECK(locus.components() == 1u);
  const auto cusps = locus.arcs()[0].irregular();
  CHECK(cusps.complete);
  REQUIRE(cusps.points.size() == 4u);
  const double a = 12.0 / 4, b = 12.0 / 2;
  const std::array<std::array<double, 2>, 4> known{{{1 + a, 2}, {1 - a, 2}, {1, 2 + b}, {1, 2 - b}}};
  std::array<int, 4> hits{};
  for (const auto& p : cusps.points)
    for (std::size_t k = 0; k < 4; ++k) hits[k] += std::hypot(p.point()[0] - known[k][0], p.point()[1] - known[k][1]) < 1e-12;
  CHECK(hits == std::array<int, 4>{1, 1, 1, 1});
  Samples samples;
  check_polyline(ellipse, locus.arcs()[0], 1e-3, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 100);
  REQUIRE(locus.rational_curve().has_value());
  // In each quarter x = a·cos³, y = b·sin³ at full degree 6.
  CHECK(locus.rational_curve()->degrees()[0] == 6);
}

TEST_CASE("at an inflection the evolute goes to infinity along the normal", "[derived]")
{
  Random random(610);
  Samples samples;
  int seen = 0;
  for (int k = 0; k < 30; ++k) {
    const Curve_2 curve = k == 0 ? graph({0, 0, 0, 1}, 3) : random_bezier<2>(random, 3, k % 2 == 0);
    const auto points = inflections(curve);
    if (points.size() != 1) continue;
    ++seen;
    const auto locus = evolute(curve);
    const auto tell = [k] { return "curve " + std::to_string(k); };
    std::vector<std::size_t> infinite;
    for (std::size_t v = 0; v < locus.vertices().size(); ++v)
      if (locus.vertices()[v].kind == Vertex_kind::infinity) infinite.push_back(v);
    samples.expect(locus.arcs().size() == 2 && infinite.size() == 1, tell);
    if (infinite.size() != 1 || locus.arcs().size() != 2) continue;
    const auto& vertex = locus.vertices()[infinite[0]];
    samples.expect(locus.arcs()[0].target() == infinite[0] && locus.arcs()[1].source() == infinite[0], tell);
    if (!vertex.asymptote) {
      samples.expect(false, tell);
      continue;
    }
    const auto x = derivatives(curve.pieces()[0], Rational(middle(points[0].parameter)));
    const double tx = x[1][0].get_d(), ty = x[1][1].get_d(), speed = std::hypot(tx, ty);
    const auto& line = *vertex.asymptote;
    const double off = (line.point[0] - x[0][0].get_d()) * tx + (line.point[1] - x[0][1].get_d()) * ty, turn = line.direction[0] * tx + line.direction[1] * ty;
    samples.expect(std::abs(off) < 1e-8 * speed * locus.scale() && std::abs(turn) < 1e-12 * speed, tell);
    for (const auto& arc : locus.arcs()) {
      check_polyline(curve, arc, 1e-2, samples);
      // The arc's infinite end is outside of what is drawn.
      const auto p = arc.at(arc.target() == infinite[0] ? 1 : 0).point();
      samples.expect(std::hypot(p[0] - locus.centre()[0], p[1] - locus.centre()[1]) >= locus.cut_radius() * (1 - 1e-9), tell);
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
  CHECK(seen > 5);
}

TEST_CASE("a circle's evolute is a point, a line has none", "[derived]")
{
  const auto locus = evolute(circle_2({1, 2}, 3));
  CHECK(locus.arcs().empty());
  REQUIRE(locus.vertices().size() == 1u);
  const auto& v = locus.vertices()[0];
  CHECK(v.kind == Vertex_kind::isolated);
  CHECK(std::hypot((*v.point)[0] - 1, (*v.point)[1] - 2) < 1e-12);
  CHECK(std::abs(v.radius - 3) < 1e-12);
  REQUIRE_FALSE(locus.degenerate().empty());
  CHECK(locus.degenerate()[0].kind == "centre");
  CHECK(evolute(segment_2({0, 0}, {3, 1})).arcs().empty());
  CHECK(evolute(segment_3({0, 0, 0}, {3, 1, 1})).arcs().empty());
}

TEST_CASE("evolutes break where the curvature jumps, and only there", "[derived]")
{
  const Curve_2 jumps = bspline_2(2, {{0, 0}, {1, 2}, {3, 3}, {5, 2}, {6, 0}}, {0, 0, 0, 1, 2, 3, 3, 3});
  const auto broken = evolute(jumps);
  CHECK(broken.arcs().size() == 3u);
  int corners = 0, ends = 0;
  for (const auto& v : broken.vertices()) {
    corners += v.kind == Vertex_kind::corner;
    ends += v.kind == Vertex_kind::boundary;
    REQUIRE(v.point.has_value());
  }
  CHECK(corners == 4);
  CHECK(ends == 2);
  // From both sides of the joint at 1, x'' is the piece's.
  const Rational h = locus_test::two_to(-50);
  for (const Rational& u : {Rational(1 - h), Rational(1 + h)}) {
    const auto c = centre_at(jumps, u);
    int hits = 0;
    for (const auto& v : broken.vertices()) hits += v.kind == Vertex_kind::corner && std::hypot((*v.point)[0] - (*c)[0], (*v.point)[1] - (*c)[1]) < 1e-10;
    CHECK(hits == 1);
  }
  const Curve_2 smooth = bspline_2(3, {{0, 0}, {1, 2}, {3, 3}, {5, 2}, {6, 0}}, {0, 0, 0, 0, 1, 2, 2, 2, 2});
  const auto whole = evolute(smooth);
  CHECK(whole.arcs().size() == 1u);
  Samples samples;
  for (const auto& arc : broken.arcs()) check_polyline(jumps, arc, 1e-3, samples);
  for (const auto& arc : whole.arcs()) check_polyline(smooth, arc, 1e-3, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

TEST_CASE("drawn evolutes keep to their error, in space too", "[derived]")
{
  Random random(611);
  Samples samples;
  for (int k = 0; k < 12; ++k) {
    const Rational_curve<3> space = random_bezier<3>(random, 2 + k % 3, k % 2 == 0);
    const auto twisted = evolute(space);
    for (const auto& arc : twisted.arcs()) check_polyline(space, arc, 1e-2, samples);
    const Curve_2 plane = random_bezier<2>(random, 2 + k % 3, k % 2 == 0);
    const auto locus = evolute(plane);
    for (const auto& arc : locus.arcs()) check_polyline(plane, arc, 1e-2, samples);
    // Cusps are the extrema of the curvature inside.
    std::size_t cusps = 0, extrema = 0;
    for (const auto& arc : locus.arcs()) cusps += arc.irregular().points.size();
    for (const auto& p : curvature_points(plane))
      if (const auto c = p.centre; c && p.kind == Kind::extremum && p.feature == Feature::interior)
        extrema += std::hypot((*c)[0] - locus.centre()[0], (*c)[1] - locus.centre()[1]) < 0.99 * locus.cut_radius();
    samples.expect(cusps >= extrema, [k] { return "cusps of curve " + std::to_string(k); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 500);
}

TEST_CASE("the focal function: exact by arc length, |x'| times as far from the centre of curvature by the parameter", "[derived]")
{
  const auto curve = bspline_3(3, {{0, 0, 0}, {1, 2, 1}, {2, -1, 3}, {3, 1, 2}, {5, 2, 0}}, {0, 0, 0, 0, 2, 5, 5, 5, 5}, {1, 2, 1, 3, 1});
  const Focal_function focal(curve);
  const auto spheres = focal_curve_map(curve), centres = evolute_map(curve);
  for (const Rational& u : {Rational(1, 3), Rational(3, 2), Rational(7, 2)}) {
    const std::size_t k = u < 2 ? 0 : 1;
    const Piece& range = curve.chain().pieces[k];
    const Rational s = range.local(u), length = range.hi - range.lo;
    const auto sphere = image(spheres.pieces()[k], {s}), centre = image(centres.pieces()[k], {s});
    const auto by_length = focal.at(u, Focal_derivative::arc_length), by_parameter = focal.at(u, Focal_derivative::parameter);
    REQUIRE((sphere && centre && by_length && by_parameter));
    // |x'|² by the quotient rule, from values of numerator, weight and their derivatives.
    const Curve_piece<3>& piece = curve.pieces()[k];
    const Rational w = evaluate_at(piece.weight, s), dw = evaluate_at(derivative(piece.weight), s);
    Rational speed2 = 0;
    for (const auto& p : piece.numerator) {
      const Rational d = (evaluate_at(derivative(p), s) * w - evaluate_at(p, s) * dw) / (w * w * length);
      speed2 += d * d;
    }
    for (std::size_t v = 0; v < 3; ++v) {
      CHECK((Rational((*by_length)[v].lo) <= (*sphere)[v] && (*sphere)[v] <= Rational((*by_length)[v].hi)));
      const Rational step = (*sphere)[v] - (*centre)[v], lo = Rational((*by_parameter)[v].lo) - (*centre)[v], hi = Rational((*by_parameter)[v].hi) - (*centre)[v];
      CHECK(sgn(lo) == sgn(step));
      const Rational exact = speed2 * step * step, a = lo * lo, b = hi * hi;
      CHECK((std::min(a, b) <= exact && exact <= std::max(a, b)));
      CHECK(Rational(hi - lo) < abs(step) / 1000000);
    }
  }
  CHECK_THROWS_AS(focal.at(Rational(6), Focal_derivative::arc_length), Invalid_input);
  CHECK_FALSE(Focal_function(bezier_3({{0, 0, 0}, {1, 2, 0}, {2, 0, 0}, {3, 1, 0}})).at(Rational(1, 2), Focal_derivative::arc_length).has_value());
}
