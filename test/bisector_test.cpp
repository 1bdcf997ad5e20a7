// SPDX-License-Identifier: LGPL-3.0-or-later
#include "curve_support.h"

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Locus;
using locus::Vertex_kind;

namespace {

struct Pair {
  const char* name;
  Control_curve first, second;
};

Locus<2> solve(const Control_curve& a, const Control_curve& b, const locus::Bisector_options& options = {})
{
  return locus::untrimmed_bisector(a.build(), b.build(), options);
}
Locus<2> solve(const Pair& p) { return solve(p.first, p.second); }

const Pair& line_quad()
{
  static const Pair p{"line_quad", curve_of({{"-1", "1"}, {"0", "0"}, {"1", "1"}}), curve_of({{"-1", "-0.25"}, {"1", "-0.75"}})};
  return p;
}
const Pair& quad_quad()
{
  static const Pair p{"quad_quad", curve_of({{"-1", "0.75"}, {"0", "0.25"}, {"1", "1"}}), curve_of({{"-1", "-1"}, {"0.25", "-0.125"}, {"1", "-0.5"}})};
  return p;
}
const Pair& cubic_cubic()
{
  static const Pair p{"cubic_cubic", curve_of({{"0", "0"}, {"1", "2"}, {"2", "-1"}, {"3", "1"}}), curve_of({{"0", "3"}, {"1", "2.5"}, {"2", "4"}, {"3", "3"}})};
  return p;
}
const Pair& ellipse_arc_cubic()
{
  static const Pair p{"ellipse_arc_cubic", curve_of({{"2", "0"}, {"2", "1"}, {"0", "1"}}, {"1", "1", "2"}),
                      curve_of({{"-1", "-1"}, {"0.5", "0.5"}, {"1", "-1"}, {"3", "-0.5"}})};
  return p;
}
const Pair& crossing_cubics()
{
  static const Pair p{"crossing cubics", curve_of({{"0", "0"}, {"1", "2"}, {"2", "-1"}, {"3", "1"}}), curve_of({{"0", "1"}, {"1", "0"}, {"2", "1"}, {"3", "0"}})};
  return p;
}

/// Pairs of all sorts, all certified.
const std::vector<Pair>& regular_pairs()
{
  static const std::vector<Pair> pairs = [] {
    std::vector<Pair> all{line_quad(), quad_quad(), cubic_cubic(), ellipse_arc_cubic(), crossing_cubics()};
    // On which OCCT 7.6.3 answers wrongly.
    all.push_back({"failure 2", curve_of({{"-1.75", "-0.75"}, {"-0.5", "-2"}, {"-1.25", "-2"}}), curve_of({{"0", "-1.75"}, {"1.75", "-1.75"}, {"-0.75", "-1"}})});
    all.push_back({"failure 3", curve_of({{"1.75", "-1"}, {"-1", "-1.75"}, {"0", "-0.75"}}), curve_of({{"-2", "1.5"}, {"0.25", "-0.75"}, {"-0.5", "1"}})});
    all.push_back({"failure 4", curve_of({{"0", "-0.25"}, {"1.5", "0.25"}, {"-0.75", "0"}}), curve_of({{"0.75", "0.75"}, {"0.75", "1"}, {"1.25", "0.75"}})});
    all.push_back({"circle and line", circular_arc({0, 0}, 1, {2, -1}, {2, 1}), curve_of({{"2", "-1"}, {"5/2", "2"}})});
    all.push_back({"circle and circle", circular_arc({0, 0}, 1, {2, -1}, {2, 1}), circular_arc({3, Rational(1, 2)}, Rational(5, 4), {1, 2}, {-1, 2})});
    all.push_back({"bitangent", curve_of({{"-2", "1"}, {"-1", "-1"}, {"0", "1"}}), curve_of({{"1", "2"}, {"2", "-1"}, {"3", "2"}})});
    Random random(301);
    while (all.size() < 26) {
      const bool rational = all.size() % 3 == 0;
      Pair p{"random", random_curve(random, random.between(1, 4), Coordinates::dyadic, rational), random_curve(random, random.between(1, 4), Coordinates::dyadic, rational)};
      all.push_back(std::move(p));
    }
    return all;
  }();
  return pairs;
}

std::string text_of(const Pair& p) { return std::string(p.name) + ": " + show(p.first, p.second); }

// ------------------------------------------------------------------------------------------ points against definition

/// Largest violation of what makes q a bisector point of the feet C1(t), C2(r): equal distances and both normals.
struct Defects {
  Real distances = 0, radius = 0, normals = 0;
};

Defects defects(const Real_pair& pair, const locus::Arc_point<2>& q)
{
  const Complex z(q.point()[0], q.point()[1]);
  const auto c = pair.first().at(q.parameter(0)), d = pair.second().at(q.parameter(1));
  const Real one = std::abs(z - c.point), two = std::abs(z - d.point);
  Defects x;
  x.distances = std::abs(one - two);
  x.radius = std::abs(one - static_cast<Real>(q.radius()));
  for (const auto& [foot, tangent] : {std::pair(c.point, c.first), std::pair(d.point, d.first)})
    if (std::abs(tangent) > 0) x.normals = std::max(x.normals, std::abs(dot(z - foot, tangent)) / std::abs(tangent));
  return x;
}

double width(const locus::Range& r) { return r.hi - r.lo; }

Real segment_distance(const Complex& p, const Complex& a, const Complex& b)
{
  const Complex d = b - a;
  const Real n = std::norm(d);
  const Real s = n > 0 ? std::min(Real(1), std::max(Real(0), dot(p - a, d) / n)) : Real(0);
  return std::abs(p - (a + s * d));
}

/// Whether the exact solution lies in the enclosure of a point's parameters: for the middle of one, F3 as a function of the
/// other changes sign over its range. (In rationals, from the definition.)
bool encloses_solution(const Plain_curve& a, const Plain_curve& b, const std::vector<locus::Range>& at)
{
  const auto f = [&](double t, double r) { return sgn(plain_f3(a, b, Rational(t), Rational(r))); };
  // One of the two is the base and exact (a point or nearly), so that the corners' signs tell.
  const int s[4] = {f(at[0].lo, at[1].lo), f(at[0].lo, at[1].hi), f(at[0].hi, at[1].lo), f(at[0].hi, at[1].hi)};
  for (const int x : s)
    if (x == 0 || x != s[0]) return true;
  return false;
}

} // namespace

// ---------------------------------------------------------------------------------------------------- known answers

TEST_CASE("the peers' pairs: components, cells, no failed filter", "[bisector]")
{
  const std::vector<std::tuple<const Pair*, std::size_t, std::size_t>> cases{
    {&line_quad(), 1, 12}, {&quad_quad(), 1, 12}, {&cubic_cubic(), 2, 30}, {&ellipse_arc_cubic(), 2, 30}};
  for (const auto& [pair, components, cells] : cases) {
    const Locus<2> l = solve(*pair);
    INFO(pair->name << ": " << show(graph_numbers(l)) << ", " << l.statistics().cells << " cells");
    CHECK(is_certified(l));
    CHECK(l.components() == components);
    CHECK(l.arcs().size() == components);
    CHECK(l.statistics().cells <= cells);
    for (const auto failures : l.statistics().filter.failures) CHECK(failures == 0u);
    CHECK(l.statistics().exact_cells == 0u);
    CHECK(l.degenerate().empty());
    CHECK(count(l, Vertex_kind::boundary) == l.vertices().size());
    CHECK(l.compute() == "bisector");
    CHECK_FALSE(l.is_trimmed());
    // Each end lies where F3 has a root on a side of the square: as many as Sturm counts.
    const Plain_curve a(pair->first), b(pair->second);
    for (const auto& v : l.vertices()) {
      REQUIRE(v.feet.size() == 2u);
      const bool on_side = v.feet[0].feature != locus::Feature::interior || v.feet[1].feature != locus::Feature::interior;
      CHECK(on_side);
      for (std::size_t k = 0; k < 2; ++k) {
        const auto& range = v.feet[k].parameters[0];
        if (v.feet[k].feature == locus::Feature::start) CHECK((range.lo == 0 && range.hi == 0));
        if (v.feet[k].feature == locus::Feature::end) CHECK((range.lo == 1 && range.hi == 1));
      }
      CHECK(encloses_solution(a, b, {v.feet[0].parameters[0], v.feet[1].parameters[0]}));
    }
  }
  // The part between interiors of the first failure of OCCT: feet in [0.1208, 0.4351].
  const Locus<2> l = solve(cubic_cubic());
  bool covers = false;
  for (const auto& arc : l.arcs()) {
    double lo = 1, hi = 0;
    for (const auto& q : arc.samples(100)) {
      lo = std::min(lo, q.parameter(0));
      hi = std::max(hi, q.parameter(0));
    }
    covers = covers || (lo < 0.1208 && hi > 0.4351);
  }
  CHECK(covers);
}

namespace {

/// The exact value of F3 and of the determinant of its Hessian, by differences so small that no sign depends on them.
struct Singular_signs {
  int value, determinant, curvature;
};

Singular_signs signs_at(const Control_curve& a, const Control_curve& b, const Rational& t, const Rational& r)
{
  const Plain_curve p(a), q(b);
  const Rational h = two_to(-100);
  const auto f = [&](int i, int j) { return plain_f3(p, q, Rational(t + i * h), Rational(r + j * h)); };
  const Rational tt = f(1, 0) - 2 * f(0, 0) + f(-1, 0), rr = f(0, 1) - 2 * f(0, 0) + f(0, -1);
  const Rational tr = (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) / 4;
  return {sgn(f(0, 0)), sgn(Rational(tt * rr - tr * tr)), sgn(tt)};
}

/// What the zero set near the singular point of the pair becomes when the second curve is shifted by ±2^-k.
void check_shifts(const char* name, const Control_curve& a, const Control_curve& b, const Rational& t, const Rational& r)
{
  const Locus<2> still = solve(a, b);
  INFO(name << ": " << show(graph_numbers(still)) << " " << reasons(still));
  REQUIRE(is_certified(still));
  for (int k = 20; k <= 60; k += 4)
    for (const int sign : {-1, 1}) {
      const Control_curve shifted = translated(b, Rational(sign * two_to(-k)), 0);
      const Locus<2> l = solve(a, shifted);
      const Singular_signs s = signs_at(a, shifted, t, r);
      INFO(name << " shifted by " << sign << "·2^-" << k << ": " << show(graph_numbers(l)) << " " << reasons(l));
      REQUIRE(s.value != 0);
      REQUIRE(s.determinant != 0);
      CHECK(is_certified(l));
      CHECK(count(l, Vertex_kind::isolated) == 0u);
      if (s.determinant > 0) { // a loop where the value has the other sign than the curvature, else nothing
        const bool is_loop = s.value != s.curvature;
        CHECK(l.arcs().size() == still.arcs().size() + (is_loop ? 1u : 0u));
        CHECK(l.components() == still.components() - (is_loop ? 0u : 1u));
        CHECK(graph_numbers(l).closed == graph_numbers(still).closed + (is_loop ? 1u : 0u));
      } else { // four half-branches become two branches
        CHECK(count(l, Vertex_kind::node) + 1 == count(still, Vertex_kind::node));
        CHECK(l.arcs().size() + 2 == still.arcs().size());
      }
    }
}

/// The curve over u = t² + t: what was at a rational place u is at an irrational one.
Control_curve over_t_squared_plus_t(const Control_curve& c)
{
  // Of a polynomial quadratic: x(u) = Σ a_i u^i.
  Control_curve result;
  result.points.resize(5);
  for (std::size_t v = 0; v < 2; ++v) {
    const Rational a0 = c.points[0][v], a1 = 2 * (c.points[1][v] - c.points[0][v]), a2 = c.points[2][v] - 2 * c.points[1][v] + c.points[0][v];
    const std::array<Rational, 5> m{a0, a1, Rational(a1 + a2), Rational(2 * a2), a2};
    for (int i = 0; i <= 4; ++i) {
      Rational b = 0;
      for (int j = 0; j <= i; ++j) b += Rational(choose(i, j)) / Rational(choose(4, j)) * m[static_cast<std::size_t>(j)];
      result.points[static_cast<std::size_t>(i)][v] = b;
    }
  }
  return result;
}

} // namespace

TEST_CASE("a singular point opens as the signs there say, however small the shift", "[bisector]")
{
  const Control_curve bow = curve_of({{"-0.375", "-0.9395751953125"}, {"-0.125", "-1.0135498046875"}, {"0.125", "-1.0333251953125"}, {"0.375", "-0.9197998046875"}});
  const Control_curve tie = curve_of({{"0.9395751953125", "-0.375"}, {"1.0135498046875", "-0.125"}, {"1.0333251953125", "0.125"}, {"0.9197998046875", "0.375"}});
  check_shifts("isolated point", bow, tie, Rational(1, 2), Rational(1, 2));
  check_shifts("node", bow, reversed(mirrored_in_x_axis(tie)), Rational(1, 2), Rational(1, 2));
  // The parabola y = x²/2 and itself turned by a quarter about the centre (-1, 5/2) of its circle of curvature at x = 1,
  // or mirrored besides. The place x = 1 is half way; over t² + t it is at t = (√3 - 1)/2.
  const Control_curve parabola = curve_of({{"0", "0"}, {"1", "0"}, {"2", "2"}});
  const Control_curve turned = translated(moved(translated(parabola, 1, Rational(-5, 2)), {0, -1, 1, 0}, {0, 0}), -1, Rational(5, 2));
  const Control_curve mirrored = translated(moved(translated(parabola, 1, Rational(-5, 2)), {0, 1, 1, 0}, {0, 0}), -1, Rational(5, 2));
  Rational place(3, 8);
  for (int i = 0; i < 9; ++i) place = Rational((place * place + Rational(1, 2)) / (2 * place + 1)); // Newton's steps to t² + t = 1/2
  for (const Control_curve* other : {&turned, &mirrored})
    check_shifts(other == &turned ? "irrational, turned" : "irrational, mirrored", over_t_squared_plus_t(parabola), over_t_squared_plus_t(*other), place, place);
}

TEST_CASE("far away, tiny and huge inputs give the same answer", "[bisector]")
{
  // Decimals as strings, so that the inputs are exact: 1e8 away, and from 1e-300 to 1e200 in size.
  const auto shifted = [](const Control_curve& c, const Rational& d, const Rational& s) { return translated(scaled(c, s), d, Rational(-d)); };
  for (const Pair* pair : {&line_quad(), &quad_quad(), &cubic_cubic(), &ellipse_arc_cubic(), &crossing_cubics()}) {
    const Locus<2> home = solve(*pair);
    const Graph_numbers numbers = graph_numbers(home);
    for (const auto& [shift, scale] : std::vector<std::pair<const char*, const char*>>{{"0", "1e-300"}, {"0", "1e-20"}, {"0", "1e100"}, {"0", "1e200"}, {"1e8", "1"},
                                                                                       {"1e8", "1e-3"}, {"1e15", "1"}, {"1e-290", "1e-300"}, {"-1e207", "1e200"}}) {
      const Rational d = locus::parse_rational(shift), s = locus::parse_rational(scale);
      const Locus<2> away = solve(shifted(pair->first, d, s), shifted(pair->second, d, s));
      INFO(pair->name << " at " << shift << " times " << scale << ": " << show(graph_numbers(away)));
      CHECK(show(graph_numbers(away)) == show(numbers));
      CHECK(away.statistics().cells <= (pair == &crossing_cubics() ? 400u : 60u));
      if (pair != &crossing_cubics()) CHECK(away.statistics().exact_cells == 0u);
      const double size = s.get_d();
      CHECK(away.scale() == Approx(home.scale() * size).epsilon(1e-9));
      // Arcs may come in another order, so compare the points as sets: each sample is a bisector point near one at home.
      Samples samples;
      for (const auto& arc : away.arcs())
        for (const auto& q : arc.samples(9)) {
          const double resolution = std::max(std::abs(d.get_d()), q.radius()) * 1e-15 + 1e-11 * size * home.scale();
          const double x = (q.point()[0] - d.get_d()) / size, y = (q.point()[1] + d.get_d()) / size;
          const Real_pair reals(pair->first, pair->second);
          const Complex z = reals.image(q.parameter(0), q.parameter(1));
          const bool node = q.error() > 1e-9 * size || q.radius() < 1e-9 * size; // inside a node's cell the point is only enclosed
          samples.expect(std::abs(z - Complex(x, y)) <= resolution / size + 2 * q.error() / size + 1e-9 || node || q.radius() > 1e3 * size,
                         [&] { return "(" + std::to_string(q.parameter(0)) + ", " + std::to_string(q.parameter(1)) + ") off by " + std::to_string(static_cast<double>(std::abs(z - Complex(x, y)))); });
          samples.expect(width(q.parameters()[0]) <= 2e-12 && width(q.parameters()[1]) <= 2e-12, "a wide parameter");
          samples.expect(std::isfinite(q.point()[0]) && std::isfinite(q.point()[1]) && std::isfinite(q.radius()), "not finite");
        }
      LOCUS_REQUIRE_SAMPLES(samples, 9);
      for (const auto& arc : away.arcs()) {
        const auto polyline = arc.polyline(1e-5);
        CHECK(polyline.error() <= 3e-5 * away.scale() + 1e-12 * std::abs(d.get_d()));
      }
    }
  }
}

TEST_CASE("crossing curves: one component with certified nodes", "[bisector]")
{
  const Locus<2> l = solve(crossing_cubics());
  INFO(show(graph_numbers(l)) << reasons(l));
  CHECK(is_certified(l));
  CHECK(l.components() == 1u);
  const std::size_t nodes = count(l, Vertex_kind::node);
  CHECK(nodes == 3u);
  const Real_pair pair(crossing_cubics().first, crossing_cubics().second);
  for (std::size_t k = 0; k < l.vertices().size(); ++k) {
    const auto& v = l.vertices()[k];
    if (v.kind != Vertex_kind::node) continue;
    REQUIRE(v.point.has_value());
    const auto& t = v.feet[0].parameters[0];
    const auto& r = v.feet[1].parameters[0];
    CHECK(width(t) < 1e-11);
    CHECK(width(r) < 1e-11);
    const Complex z((*v.point)[0], (*v.point)[1]);
    CHECK(std::abs(z - pair.first().at((t.lo + t.hi) / 2).point) < 1e-10L);
    CHECK(std::abs(z - pair.second().at((r.lo + r.hi) / 2).point) < 1e-10L);
    CHECK(v.radius < 1e-10);
    // Four half-branches in cyclic order, each the end of an arc here; opposite ones continue each other.
    REQUIRE(v.half_branches.size() == 4u);
    std::vector<Complex> direction;
    for (const auto& h : v.half_branches) {
      const auto& arc = l.arcs()[h.arc];
      CHECK((h.at_start ? arc.source() : arc.target()) == std::optional<std::size_t>(k));
      const auto points = arc.samples(400);
      const auto& q = h.at_start ? points[4] : points[points.size() - 5];
      direction.push_back(Complex(q.parameter(0) - t.lo, q.parameter(1) - r.lo));
    }
    double turns = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double angle = static_cast<double>(std::arg(direction[(i + 1) % 4] / direction[i]));
      turns += angle < 0 ? angle + 2 * std::acos(-1.0) : angle;
      const double opposite = static_cast<double>(std::abs(std::arg(direction[(i + 2) % 4] / direction[i])));
      CHECK(opposite > 2.5);
    }
    const double full = 2 * std::acos(-1.0);
    const bool cyclic = std::abs(turns - full) < 1e-6 || std::abs(turns - 3 * full) < 1e-6;
    CHECK(cyclic);
  }
}

TEST_CASE("lines", "[bisector]")
{
  { // parallel: one arc t = r, mapped to y = 1/2
    const Pair p{"parallel", curve_of({{"0", "0"}, {"1", "0"}}), curve_of({{"0", "1"}, {"1", "1"}})};
    const Locus<2> l = solve(p);
    INFO(show(graph_numbers(l)));
    CHECK(is_certified(l));
    REQUIRE(l.arcs().size() == 1u);
    CHECK(l.components() == 1u);
    CHECK(count(l, Vertex_kind::boundary) == 2u);
    Samples samples;
    for (const auto& q : l.arcs()[0].samples(50)) {
      samples.expect(std::abs(q.parameter(0) - q.parameter(1)) < 1e-12, "t = r");
      samples.expect(std::abs(q.point()[1] - 0.5) < 1e-12 && std::abs(q.point()[0] - q.parameter(0)) < 1e-12, "y = 1/2");
    }
    LOCUS_REQUIRE_SAMPLES(samples, 100);
    CHECK(l.arcs()[0].polyline(1e-9).size() <= 33u);
  }
  { // crossing inside: two angle bisectors through one node
    const Locus<2> l = solve(curve_of({{"-1", "0"}, {"1", "0"}}), curve_of({{"0", "-2"}, {"0", "1"}}));
    CHECK(is_certified(l));
    CHECK(l.components() == 1u);
    CHECK(count(l, Vertex_kind::node) == 1u);
    CHECK(l.arcs().size() == 4u);
    Samples samples;
    for (const auto& arc : l.arcs())
      for (const auto& q : arc.samples(20)) samples.expect(std::abs(std::abs(q.point()[0]) - std::abs(q.point()[1])) < 1e-6, "on a diagonal");
    LOCUS_REQUIRE_SAMPLES(samples, 80);
  }
  { // crossing at a shared end: the node lies in a corner
    const Locus<2> l = solve(curve_of({{"0", "0"}, {"1", "0"}}), curve_of({{"0", "0"}, {"1", "2"}}));
    INFO(show(graph_numbers(l)) << reasons(l));
    if (is_certified(l)) {
      CHECK(l.components() == 1u);
      CHECK(l.arcs().size() == 1u);
    }
  }
  { // a T: the foot of one is inside the other
    const Locus<2> l = solve(curve_of({{"-1", "0"}, {"1", "0"}}), curve_of({{"0", "0"}, {"1", "2"}}));
    INFO(show(graph_numbers(l)) << reasons(l));
    if (is_certified(l)) {
      CHECK(l.components() == 1u);
      CHECK(l.arcs().size() == 2u);
    }
  }
  { // lines whose crossing lies outside both
    const Locus<2> l = solve(curve_of({{"1", "0"}, {"3", "0"}}), curve_of({{"1", "1"}, {"3", "2"}}));
    CHECK(is_certified(l));
    CHECK(l.components() == 1u);
  }
  { // on one line: everything
    const Locus<2> l = solve(curve_of({{"0", "0"}, {"1", "0"}}), curve_of({{"2", "0"}, {"3", "0"}}));
    CHECK(is_certified(l));
    CHECK(l.arcs().empty());
    REQUIRE(l.degenerate().size() == 1u);
    CHECK(l.degenerate()[0].kind == "everything");
    CHECK_FALSE(l.degenerate()[0].reason.empty());
  }
}

TEST_CASE("circular arcs", "[bisector]")
{
  const Control_curve arc = circular_arc({0, 0}, 1, {2, -1}, {2, 1});
  { // concentric: the circle between them, t and r matched by the angle
    const Locus<2> l = solve(arc, circular_arc({0, 0}, 2, {2, -1}, {2, 1}));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    REQUIRE(l.arcs().size() == 1u);
    Samples samples;
    for (const auto& q : l.arcs()[0].samples(30)) {
      samples.expect(std::abs(std::hypot(q.point()[0], q.point()[1]) - 1.5) < 1e-12, "between the circles");
      samples.expect(std::abs(q.parameter(0) - q.parameter(1)) < 1e-12, "one angle");
    }
    LOCUS_REQUIRE_SAMPLES(samples, 60);
  }
  { // concentric and half a turn apart: opposite points, whose circles have their centres on the circle of radius 1/2
    const Locus<2> l = solve(arc, circular_arc({0, 0}, 2, {1, 2}, {-1, 2}));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    REQUIRE(l.arcs().size() == 1u);
    Samples samples;
    for (const auto& q : l.arcs()[0].samples(30)) samples.expect(std::abs(std::hypot(q.point()[0], q.point()[1]) - 0.5) < 1e-12, "halfway");
    LOCUS_REQUIRE_SAMPLES(samples, 30);
  }
  { // disjoint: points of a conic with the centres as foci
    const Locus<2> l = solve(arc, circular_arc({4, 0}, 1, {1, 2}, {-1, 2}));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(l.components() >= 1u);
    Samples samples;
    for (const auto& a : l.arcs())
      for (const auto& q : a.samples(30)) {
        if (q.radius() > 1e3) continue;
        const double d1 = std::hypot(q.point()[0], q.point()[1]), d2 = std::hypot(q.point()[0] - 4, q.point()[1]);
        const bool conic = std::abs(std::abs(d1 - d2)) < 1e-9 || std::abs(std::abs(d1 - d2) - 2) < 1e-9 || std::abs(d1 + d2 - 2) < 1e-9;
        samples.expect(conic, "foci");
      }
    LOCUS_REQUIRE_SAMPLES(samples, 30);
  }
  { // intersecting
    const Locus<2> l = solve(circular_arc({0, 0}, 1, {1, 0}, {1, 1}), circular_arc({1, 0}, 1, {1, 1}, {0, 1}));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(count(l, Vertex_kind::node) == 1u);
  }
  { // on one circle: everything
    const Locus<2> l = solve(arc, circular_arc({0, 0}, 1, {1, 2}, {-1, 2}));
    CHECK(l.arcs().empty());
    REQUIRE(l.degenerate().size() == 1u);
    CHECK(l.degenerate()[0].kind == "everything");
  }
  { // a line tangent to the circle that carries the arc, away from the arc: r = r0 maps to the centre
    const Locus<2> l = solve(arc, curve_of({{"-2", "1"}, {"3", "1"}}));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    REQUIRE(l.degenerate().size() == 1u);
    CHECK(l.degenerate()[0].kind == "centre");
    CHECK(l.degenerate()[0].input == std::optional<std::size_t>(1));
    REQUIRE(l.degenerate()[0].parameter.has_value());
    CHECK(l.degenerate()[0].parameter->lo <= 0.4);
    CHECK(l.degenerate()[0].parameter->hi >= 0.4);
    Samples samples; // the rest lies on a parabola with focus 0, directrix y = 2 or y = 0 (the degenerate one)
    for (const auto& a : l.arcs())
      for (const auto& q : a.samples(30)) {
        const double d = std::hypot(q.point()[0], q.point()[1]), h = q.point()[1];
        samples.expect(q.radius() > 1e3 || std::abs(d - std::abs(h - 2)) < 1e-9 * (1 + d) || std::abs(d - std::abs(h)) < 1e-9 * (1 + d), "parabola");
      }
    LOCUS_REQUIRE_SAMPLES(samples, 30);
  }
}

TEST_CASE("mirror images have the axis as an arc", "[bisector]")
{
  Random random(302);
  Samples samples;
  std::size_t certified = 0, pairs = 0;
  for (int k = 0; k < 40; ++k) {
    const Control_curve c = random_curve(random, 3, k % 2 ? Coordinates::dyadic : Coordinates::fractions, k % 5 == 0);
    for (const bool reverse : {false, true}) {
      const Control_curve image = reverse ? reversed(mirrored_in_x_axis(c)) : mirrored_in_x_axis(c);
      Locus<2> l = solve(c, image);
      ++pairs;
      certified += is_certified(l);
      // A curve that touches the axis has a triple point there; none of these does. All must be certified.
      samples.expect(is_certified(l), [&] { return show(graph_numbers(l)) + " " + reasons(l) + " " + show(c, image); });
      if (!is_certified(l)) continue;
      // The axis: all t with r = t (or 1-t), from corner to corner through nodes and poles.
      double covered = 0;
      bool on_axis = true;
      for (const auto& arc : l.arcs()) {
        const auto points = arc.samples(30);
        bool all = true;
        for (const auto& q : points) all = all && std::abs((reverse ? 1 - q.parameter(1) : q.parameter(1)) - q.parameter(0)) < 1e-11;
        if (!all) continue;
        const auto start = l.vertices()[*arc.source()], target = l.vertices()[*arc.target()];
        covered += std::abs(start.feet[0].parameters[0].lo - target.feet[0].parameters[0].lo);
        for (const auto& q : points) on_axis = on_axis && (q.radius() > 1e4 || std::abs(q.point()[1]) <= 1e-9 * (l.scale() + q.radius()) + 2 * q.error());
      }
      samples.expect(std::abs(covered - 1) < 1e-9, [&] { return "the axis covers " + std::to_string(covered) + " of the parameters: " + show(c, image); });
      samples.expect(on_axis, [&] { return "off the axis: " + show(c, image); });
      // Poles on the axis: where the tangent is perpendicular to it.
      const Plain_curve plain = Plain_curve(c).with_primitive_tangent();
      std::size_t poles = 0;
      for (const auto& v : l.vertices())
        if (v.kind == Vertex_kind::infinity && std::abs((reverse ? 1 - v.feet[1].parameters[0].lo : v.feet[1].parameters[0].lo) - v.feet[0].parameters[0].lo) < 1e-9) ++poles;
      samples.expect(poles == static_cast<std::size_t>(Sturm(plain.ax).closed(Rational(0), Rational(1))), [&] { return std::to_string(poles) + " poles on the axis: " + show(c, image); });
    }
  }
  CHECK(certified == pairs);
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("the pairs with a known singular structure", "[bisector]")
{
  const Control_curve bow = curve_of({{"-0.375", "-0.9395751953125"}, {"-0.125", "-1.0135498046875"}, {"0.125", "-1.0333251953125"}, {"0.375", "-0.9197998046875"}});
  const Control_curve tie = curve_of({{"0.9395751953125", "-0.375"}, {"1.0135498046875", "-0.125"}, {"1.0333251953125", "0.125"}, {"0.9197998046875", "0.375"}});
  { // an isolated point at (1/2, 1/2)
    const Locus<2> l = solve(bow, tie);
    INFO(show(graph_numbers(l)) << " " << reasons(l));
    CHECK(is_certified(l));
    CHECK(l.components() == 1u);
    CHECK(l.arcs().empty());
    REQUIRE(l.vertices().size() == 1u);
    CHECK(l.vertices()[0].kind == Vertex_kind::isolated);
    for (const auto& foot : l.vertices()[0].feet) {
      CHECK(foot.parameters[0].lo == 0.5);
      CHECK(foot.parameters[0].hi == 0.5);
    }
    REQUIRE(l.vertices()[0].point);
  }
  { // a node at (1/2, 1/2) of two osculating circles
    const Locus<2> l = solve(bow, reversed(mirrored_in_x_axis(tie)));
    INFO(show(graph_numbers(l)) << " " << reasons(l));
    if (is_certified(l)) {
      CHECK(l.components() == 1u);
      CHECK(count(l, Vertex_kind::node) == 1u);
    } else {
      REQUIRE(l.undecided().size() == 1u);
      CHECK(width(l.undecided()[0].box[0]) < 1e-3);
      CHECK(count(l, Vertex_kind::undecided) == 4u);
      CHECK(l.arcs().size() == 4u);
    }
  }
  { // identical parabolas: t = r fourfold, and one arc t + r = 1
    const Control_curve parabola = curve_of({{"-1", "1"}, {"0", "0"}, {"1", "1"}});
    for (const bool reverse : {false, true}) {
      const Locus<2> l = solve(parabola, reverse ? reversed(parabola) : parabola);
      INFO((reverse ? "reversed: " : "same: ") << show(graph_numbers(l)) << " " << reasons(l));
      CHECK(is_certified(l));
      REQUIRE(l.degenerate().size() == 1u);
      CHECK(l.degenerate()[0].kind == "overlap");
      CHECK(l.degenerate()[0].multiplicity == 4);
      REQUIRE(l.arcs().size() == 1u);
      CHECK(l.components() == 1u);
      Samples samples;
      for (const auto& q : l.arcs()[0].samples(21)) {
        const double r = reverse ? 1 - q.parameter(1) : q.parameter(1);
        samples.expect(std::abs(q.parameter(0) + r - 1) < 1e-12, "t + r = 1");
        // At the vertex itself the image is 0/0; elsewhere the arc is the parabola's own axis.
        samples.expect(std::abs(q.parameter(0) - 0.5) < 1e-3 || std::abs(q.point()[0]) < 1e-9, "on the axis");
      }
      LOCUS_REQUIRE_SAMPLES(samples, 42);
    }
  }
  { // a line on the axis of coordinates
    const Control_curve line = curve_of({{"-1", "0"}, {"1", "0"}}), curve = curve_of({{"-1", "1"}, {"0.25", "0.5"}, {"1", "2"}});
    for (const bool swapped : {false, true}) {
      const Locus<2> l = swapped ? solve(curve, line) : solve(line, curve);
      INFO(show(graph_numbers(l)));
      CHECK(is_certified(l));
      CHECK(l.components() == 1u);
    }
  }
  { // two parabolas that touch with different curvatures: a triple point with six half-branches
    const Locus<2> l = solve(curve_of({{"-1", "1"}, {"0", "-1"}, {"1", "1"}}), curve_of({{"-1", "-1"}, {"0", "1"}, {"1", "-1"}}));
    INFO(show(graph_numbers(l)) << " " << reasons(l));
    CHECK(is_certified(l));
    CHECK(l.components() == 1u);
    CHECK(l.arcs().size() == 6u);
    REQUIRE(count(l, Vertex_kind::node) == 1u);
    for (const auto& v : l.vertices()) {
      if (v.kind != Vertex_kind::node) continue;
      CHECK(v.half_branches.size() == 6u);
      CHECK(v.feet[0].parameters[0].lo == 0.5);
      REQUIRE(v.point);
      CHECK(std::hypot((*v.point)[0], (*v.point)[1]) < 1e-12); // where the curves touch
    }
  }
  { // a line and an arc that starts tangent to it: r = 0 is degenerate, G = 0 the rest
    const Control_curve line = curve_of({{"-2", "0"}, {"0", "0"}}), arc = curve_of({{"0", "0"}, {"1", "0"}, {"1", "1"}}, {"1", "1/2", "1"});
    for (const bool swapped : {false, true}) {
      const Locus<2> l = swapped ? solve(arc, line) : solve(line, arc);
      INFO(show(graph_numbers(l)) << " " << reasons(l));
      REQUIRE(l.degenerate().size() == 1u);
      CHECK(l.degenerate()[0].kind == "infinity");
      CHECK(l.degenerate()[0].input == std::optional<std::size_t>(swapped ? 0 : 1));
      REQUIRE(l.degenerate()[0].parameter.has_value());
      CHECK(l.degenerate()[0].parameter->lo == 0);
      CHECK(l.degenerate()[0].parameter->hi == 0);
      for (const auto& a : l.arcs()) { // never the degenerate line itself
        bool along = true;
        for (const auto& q : a.samples(9)) along = along && q.parameter(swapped ? 0 : 1) < 1e-9;
        CHECK_FALSE(along);
      }
    }
  }
}

// ---------------------------------------------------------------------------------------------------- along the arcs

TEST_CASE("samples are bisector points of their feet", "[bisector]")
{
  Samples samples, enclosed;
  for (const Pair& p : regular_pairs()) {
    const Locus<2> l = solve(p);
    samples.expect(is_certified(l), [&] { return "undecided " + reasons(l) + " " + text_of(p); });
    const Real_pair reals(p.first, p.second);
    const Plain_curve a(p.first), b(p.second);
    for (const auto& arc : l.arcs()) {
      const auto points = arc.samples(50);
      samples.expect(points.size() == 50, "50 samples");
      std::size_t index = 0;
      for (const auto& q : points) {
        const auto text = [&] {
          const Defects d = defects(reals, q);
          std::ostringstream out;
          out << "sample " << index << " at (" << q.parameter(0) << ", " << q.parameter(1) << ") of widths " << width(q.parameters()[0]) << ", "
              << width(q.parameters()[1]) << ", distances differ by " << d.distances << ", normals miss by " << d.normals << ", radius " << q.radius()
              << " wrong by " << d.radius << ", error " << q.error() << "; " << text_of(p);
          return out.str();
        };
        ++index;
        samples.expect(width(q.parameters()[0]) <= 2e-12 && width(q.parameters()[1]) <= 2e-12, text);
        // The point's own error is proved; beside it only this computation's roundings, which grow with the radius.
        const Defects d = defects(reals, q);
        const Real size = l.scale(), far = q.radius() / size, tolerance = 1e-9L * size * (1 + far) + 3 * static_cast<Real>(q.error());
        samples.expect(d.distances <= tolerance && d.normals <= tolerance && d.radius <= tolerance, text);
        const Real slack = 1e-9L * size * (1 + far * far);
        const bool near_node = q.radius() < 1e-2 * l.scale(); // there q is ill-conditioned; its bound says so
        samples.expect(q.error() <= slack || near_node, text);
        const auto e = reals.f3(q.parameter(0), q.parameter(1));
        samples.expect(std::abs(e.value) <= 1e-9L * e.size + 1e-13L || near_node, text);
        if (index % 7 == 1 && !near_node) enclosed.expect(encloses_solution(a, b, q.parameters()), text);
      }
      // The two ends are the vertices.
      if (!arc.is_closed())
        for (const bool at_end : {false, true}) {
          const auto& v = l.vertices()[at_end ? *arc.target() : *arc.source()];
          const auto& q = at_end ? points.back() : points.front();
          const auto x = arc.at(at_end ? 1 : 0);
          samples.expect(std::abs(x.parameter(0) - q.parameter(0)) < 1e-12 && std::abs(x.parameter(1) - q.parameter(1)) < 1e-12, "at() and samples() end alike");
          if (v.kind == Vertex_kind::infinity) {
            samples.expect(q.radius() > l.cut_radius() * 0.5, "an infinite end ends far away");
            continue;
          }
          if (v.kind == Vertex_kind::node && q.radius() > l.cut_radius() * 0.5) continue; // where the curves touch, a branch may be infinite
          for (std::size_t k = 0; k < 2; ++k)
            samples.expect(v.feet[k].parameters[0].lo - 1e-12 <= q.parameter(k) && q.parameter(k) <= v.feet[k].parameters[0].hi + 1e-12, "an arc's end at its vertex");
          samples.expect(v.point && std::hypot((*v.point)[0] - q.point()[0], (*v.point)[1] - q.point()[1]) <= 1e-9 * l.scale() + 2 * q.error(), "a vertex's point");
        }
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 4000);
  LOCUS_REQUIRE_SAMPLES(enclosed, 200);
}

TEST_CASE("at() runs along the arc without jumps", "[bisector]")
{
  Samples samples;
  for (const Pair* p : {&line_quad(), &cubic_cubic(), &crossing_cubics(), &ellipse_arc_cubic()}) {
    const Locus<2> l = solve(*p);
    for (const auto& arc : l.arcs()) {
      std::array<double, 2> last{};
      double length = 0, longest = 0;
      for (int i = 0; i <= 400; ++i) {
        const auto q = arc.at(i / 400.0);
        const std::array<double, 2> here{q.parameter(0), q.parameter(1)};
        if (i > 0) {
          const double step = std::hypot(here[0] - last[0], here[1] - last[1]);
          length += step;
          longest = std::max(longest, step);
        }
        last = here;
      }
      samples.expect(longest < 0.1 * length + 1e-9, [&] { return text_of(*p) + " jumps by " + std::to_string(longest) + " of " + std::to_string(length); });
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 5);
}

TEST_CASE("polylines keep their promise, both ways", "[bisector]")
{
  Samples samples;
  std::size_t checked = 0;
  for (const Pair& p : regular_pairs()) {
    const Locus<2> l = solve(p);
    const Real_pair reals(p.first, p.second);
    for (const double tolerance : {1e-3, 1e-6}) {
      for (const auto& arc : l.arcs()) {
        const auto polyline = arc.polyline(tolerance);
        samples.expect(std::isfinite(polyline.error()) && polyline.size() >= 2, [&] { return "no polyline: " + text_of(p); });
        samples.expect(polyline.error() <= 3 * tolerance * l.scale() || count(l, Vertex_kind::node) > 0,
                       [&] { return "error " + std::to_string(polyline.error()) + " of " + text_of(p); });
        if (polyline.size() > 20000) continue; // (a bound that needs so many points is reported elsewhere)
        const Real bound = polyline.error() * (1 + 1e-9L) + 1e-11L * l.scale();
        const std::size_t step = std::max<std::size_t>(1, polyline.size() / 300);
        for (std::size_t i = 0; i + 1 < polyline.size(); i += step) {
          const auto &u = polyline[i], &v = polyline[i + 1];
          const Complex a(u.point()[0], u.point()[1]), b(v.point()[0], v.point()[1]);
          // The exact arc between both points: Newton's method in long double from points between their parameters.
          std::vector<Complex> between{a};
          Real far = 0;
          for (int k = 1; k < 8; ++k) {
            const Real f = static_cast<Real>(k) / 8;
            const std::array<Real, 2> guess{u.parameter(0) * (1 - f) + v.parameter(0) * f, u.parameter(1) * (1 - f) + v.parameter(1) * f};
            const auto x = reals.corrected(guess);
            const Real gap = std::hypot(static_cast<Real>(v.parameter(0) - u.parameter(0)), static_cast<Real>(v.parameter(1) - u.parameter(1)));
            if (!(std::hypot(x[0] - guess[0], x[1] - guess[1]) < 0.5L * gap + 1e-12L)) continue;
            const Complex z = reals.image(x[0], x[1]);
            const Real distance = segment_distance(z, a, b);
            ++checked;
            far = std::max(far, std::abs(z));
            samples.expect(distance <= bound + 1e-10L * std::abs(z), [&] {
              std::ostringstream out;
              out << "segment " << i << " of " << polyline.size() << " from (" << u.parameter(0) << ", " << u.parameter(1) << ") to (" << v.parameter(0) << ", "
                  << v.parameter(1) << "): the arc is " << distance << " away, claimed " << polyline.error() << "; " << text_of(p);
              return out.str();
            });
            between.push_back(z);
          }
          between.push_back(b);
          if (between.size() < 9) continue;
          for (int k = 1; k < 8; ++k) { // and the segment's points from the arc, drawn finely
            const Complex z = a + (b - a) * (static_cast<Real>(k) / 8);
            Real distance = std::abs(z - a);
            for (std::size_t j = 0; j + 1 < between.size(); ++j) distance = std::min(distance, segment_distance(z, between[j], between[j + 1]));
            samples.expect(distance <= bound + 1e-10L * far, [&] { return "a segment leaves the arc by " + std::to_string(static_cast<double>(distance)) + "; " + text_of(p); });
          }
        }
        // Ends are the arc's ends.
        const auto ends = arc.samples(2);
        samples.expect(std::abs(polyline[0].parameter(0) - ends[0].parameter(0)) < 1e-9 && std::abs(polyline[polyline.size() - 1].parameter(0) - ends[1].parameter(0)) < 1e-9,
                       "a polyline from end to end");
      }
    }
  }
  CHECK(checked > 20000u);
  LOCUS_REQUIRE_SAMPLES(samples, 20000);
}

TEST_CASE("a polyline cut off at a pole reaches the cut radius", "[bisector]")
{
  Samples samples;
  std::size_t poles = 0;
  for (const Pair& p : regular_pairs()) {
    const Locus<2> l = solve(p);
    for (const auto& arc : l.arcs()) {
      if (arc.is_closed()) continue;
      for (const bool at_end : {false, true}) {
        if (l.vertices()[at_end ? *arc.target() : *arc.source()].kind != Vertex_kind::infinity) continue;
        ++poles;
        const auto polyline = arc.polyline(1e-3);
        const auto& q = polyline[at_end ? polyline.size() - 1 : 0];
        const double off = std::hypot(q.point()[0] - l.centre()[0], q.point()[1] - l.centre()[1]);
        samples.expect(off >= l.cut_radius(), [&] { return "cut at " + std::to_string(off) + " of " + std::to_string(l.cut_radius()) + ": " + text_of(p); });
      }
    }
  }
  CHECK(poles >= 4u);
  LOCUS_REQUIRE_SAMPLES(samples, 4);
}

TEST_CASE("tangent and curvature against finite differences", "[bisector]")
{
  Samples samples;
  std::size_t compared = 0;
  for (const Pair& p : regular_pairs()) {
    const Locus<2> l = solve(p);
    const Real_pair reals(p.first, p.second);
    for (const auto& arc : l.arcs())
      for (int i = 1; i < 20; ++i) {
        const double x = i / 20.0 + 0.001;
        const auto q = arc.at(x);
        if (q.error() > 1e-9 * l.scale() || q.radius() > 30 * l.scale() || q.radius() < 1e-2 * l.scale()) continue; // near nodes and poles
        const auto d = arc.differential(x);
        // Along the zero set by our own steps: the direction across the gradient, corrected back.
        const std::array<Real, 2> at = reals.corrected({q.parameter(0), q.parameter(1)});
        const auto f = reals.f3(at[0], at[1]);
        const Real gradient = std::hypot(f.by_t, f.by_r);
        std::array<Real, 2> along{f.by_r / gradient, -f.by_t / gradient};
        const auto ahead = arc.at(x + 1e-4);
        if ((ahead.parameter(0) - q.parameter(0)) * along[0] + (ahead.parameter(1) - q.parameter(1)) * along[1] < 0) along = {-along[0], -along[1]};
        const Real h = 1e-4L;
        const auto forward = reals.corrected({at[0] + h * along[0], at[1] + h * along[1]}), back = reals.corrected({at[0] - h * along[0], at[1] - h * along[1]});
        const Complex z = reals.image(at[0], at[1]), zf = reals.image(forward[0], forward[1]), zb = reals.image(back[0], back[1]);
        const Complex first = zf - zb;
        const Real speed = std::abs(first) / (2 * h);
        if (!(speed > 1e-2L * l.scale())) continue; // near a cusp of the locus
        const Complex tangent(d.tangent[0], d.tangent[1]);
        const Real curvature = 4 * cross(first, zf - Real(2) * z + zb) / std::pow(std::abs(first), Real(3));
        const Real steepness = std::abs(zf - Real(2) * z + zb) / (h * h) / speed; // how fast the direction may change
        if (!(steepness < 200)) continue;
        ++compared;
        const auto text = [&] {
          std::ostringstream out;
          out << "x = " << x << " at (" << q.parameter(0) << ", " << q.parameter(1) << "): tangent " << d.tangent << " against " << first / std::abs(first)
              << ", curvature " << d.curvature << " against " << curvature << "; " << text_of(p);
          return out.str();
        };
        samples.expect(std::abs(tangent - first / std::abs(first)) < 1e-4L, text);
        samples.expect(std::abs(std::abs(tangent) - 1) < 1e-12L, text);
        samples.expect(std::abs(curvature - static_cast<Real>(d.curvature)) < 2e-3L * (std::abs(curvature) + 1 / static_cast<Real>(l.scale())), text);
      }
  }
  CHECK(compared > 300u);
  LOCUS_REQUIRE_SAMPLES(samples, 900);
}

TEST_CASE("arcs to infinity approach their asymptotes", "[bisector]")
{
  Samples samples;
  std::size_t poles = 0;
  for (const Pair& p : regular_pairs()) {
    const Locus<2> l = solve(p);
    const Real_pair reals(p.first, p.second);
    for (const auto& arc : l.arcs()) {
      if (arc.is_closed()) continue;
      for (const bool at_end : {false, true}) {
        const auto& v = l.vertices()[at_end ? *arc.target() : *arc.source()];
        if (v.kind != Vertex_kind::infinity) continue;
        ++poles;
        const auto text = [&] { return text_of(p); };
        samples.expect(v.asymptote.has_value() && !v.point.has_value(), text);
        if (!v.asymptote) continue;
        const Complex origin(v.asymptote->point[0], v.asymptote->point[1]), direction(v.asymptote->direction[0], v.asymptote->direction[1]);
        samples.expect(std::abs(std::abs(direction) - 1) < 1e-12L, text);
        // Both feet on one tangent line.
        const std::array<Real, 2> pole{(v.feet[0].parameters[0].lo + v.feet[0].parameters[0].hi) / 2, (v.feet[1].parameters[0].lo + v.feet[1].parameters[0].hi) / 2};
        const auto c = reals.first().at(pole[0]), d = reals.second().at(pole[1]);
        const Complex e = d.point - c.point;
        samples.expect(std::abs(cross(c.first, d.first)) < 1e-8L * std::abs(c.first) * std::abs(d.first), text);
        samples.expect(std::abs(cross(c.first, e)) < 1e-8L * std::abs(c.first) * l.scale(), text);
        samples.expect(std::abs(dot(direction, e)) < 1e-8L * l.scale(), text);
        // Following the arc: ever farther away, ever closer to the line.
        const auto points = arc.samples(200);
        const auto& from = at_end ? points[points.size() - 2] : points[1];
        Real last = -1, last_radius = 0;
        bool closer = true, farther = true;
        for (const Real f : {1e-2L, 1e-3L, 1e-4L, 1e-5L}) {
          const auto x = reals.corrected({pole[0] + f * (from.parameter(0) - pole[0]), pole[1] + f * (from.parameter(1) - pole[1])}, 12);
          const Complex z = reals.image(x[0], x[1]);
          const Real off = std::abs(cross(z - origin, direction));
          closer = closer && (last < 0 || off < 0.3L * last + 1e-6L * l.scale());
          farther = farther && std::abs(z - origin) > 3 * last_radius;
          last = off;
          last_radius = std::abs(z - origin);
        }
        samples.expect(closer && farther && last < 1e-2L * l.scale(), [&] { return "ends " + std::to_string(static_cast<double>(last)) + " from its asymptote; " + text_of(p); });
      }
    }
  }
  CHECK(poles >= 4u);
  LOCUS_REQUIRE_SAMPLES(samples, 20);
}

TEST_CASE("irregular points: one foot turns there, and nowhere else", "[bisector]")
{
  Samples samples;
  std::size_t found = 0;
  const auto verify = [&](const Control_curve& a, const Control_curve& b) {
    const Locus<2> l = solve(a, b);
    const Real_pair reals(a, b);
    for (const auto& arc : l.arcs()) {
      const auto irregular = arc.irregular();
      if (!irregular.complete) continue;
      const auto text = [&] {
        std::ostringstream out;
        out << irregular.points.size() << " irregular:";
        for (const auto& q : irregular.points) out << " (" << q.parameter(0) << ", " << q.parameter(1) << ")";
        out << "; " << show(a, b);
        return out.str();
      };
      for (const auto& q : irregular.points) {
        ++found;
        // Along the arc to both sides, F_t·F_r changes its sign: one of the two vanishes here.
        const auto at = reals.corrected({q.parameter(0), q.parameter(1)});
        const auto f = reals.f3(at[0], at[1]);
        const Real gradient = std::hypot(f.by_t, f.by_r);
        const std::array<Real, 2> along{f.by_r / gradient, -f.by_t / gradient};
        const Real h = 1e-5L;
        const auto ahead = reals.corrected({at[0] + h * along[0], at[1] + h * along[1]}), back = reals.corrected({at[0] - h * along[0], at[1] - h * along[1]});
        const auto g = reals.f3(ahead[0], ahead[1]), k = reals.f3(back[0], back[1]);
        samples.expect(g.by_t * g.by_r * k.by_t * k.by_r < 0, text);
        samples.expect(std::min(std::abs(f.by_t), std::abs(f.by_r)) < 1e-5L * gradient, text);
      }
      // None is missed: sign changes between 600 samples.
      std::size_t changes = 0;
      Real last = 0;
      for (const auto& q : arc.samples(600)) {
        const auto f = reals.f3(q.parameter(0), q.parameter(1));
        const Real product = f.by_t * f.by_r / (f.by_t * f.by_t + f.by_r * f.by_r);
        if (!(std::abs(product) > 1e-9L) || q.radius() < 1e-4 * l.scale()) continue; // (nothing is known inside a node's cell)
        changes += last * product < 0;
        last = product;
      }
      samples.expect(changes <= irregular.points.size(), [&] { return std::to_string(changes) + " turns seen, " + text(); });
      samples.expect(irregular.points.size() <= changes + 2, [&] { return std::to_string(changes) + " turns seen, " + text(); });
    }
  };
  for (const Pair& p : regular_pairs()) verify(p.first, p.second);
  // Cusps at exactly t = r = 1/2, where cells are cut: the line is tangent to the osculating circle of the cubic there.
  // p(s) = s(3,4) + s²(1,-2) + s³(2,1), s = t - 1/2: centre (5, -15/4), radius 25/4.
  const Control_curve cubic = curve_of({{"-3/2", "-21/8"}, {"-1/3", "-3/8"}, {"1/6", "17/24"}, {"2", "13/8"}});
  for (const Exact_pair& u : {Exact_pair{Rational(-7, 25), Rational(-24, 25)}, Exact_pair{Rational(5, 13), Rational(12, 13)}, Exact_pair{Rational(3, 5), Rational(-4, 5)},
                              Exact_pair{Rational(-3, 5), Rational(-4, 5)}, Exact_pair{Rational(0), Rational(-1)}, Exact_pair{Rational(1), Rational(0)}}) {
    const Exact_pair foot{Rational(5 + u[0] * 25 / 4), Rational(Rational(-15, 4) + u[1] * 25 / 4)};
    Control_curve line;
    for (const int side : {-1, 1}) line.points.push_back({Rational(foot[0] - side * u[1]), Rational(foot[1] + side * u[0])});
    verify(cubic, line);
    verify(line, cubic);
    verify(reversed(cubic), elevated(line));
    const Locus<2> l = solve(cubic, line);
    std::size_t there = 0;
    for (const auto& arc : l.arcs())
      for (const auto& q : arc.irregular().points) there += std::abs(q.parameter(0) - 0.5) < 1e-6 && std::abs(q.parameter(1) - 0.5) < 1e-6;
    samples.expect(there == 1, [&] { return std::to_string(there) + " irregular points in the middle: " + show(cubic, line); });
  }
  CHECK(found > 30u);
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

// -------------------------------------------------------------------------------------------------------- at random

TEST_CASE("random pairs: certified, with the components a dense grid sees", "[bisector]")
{
  Random random(303);
  Samples samples, components;
  std::size_t certified = 0, undecided = 0;
  std::string open;
  double longest = 0;
  for (int k = 0; k < 300; ++k) {
    const Coordinates kind = k % 3 == 0 ? Coordinates::grid : k % 3 == 1 ? Coordinates::dyadic : Coordinates::fractions;
    const Control_curve a = random_curve(random, random.between(1, 4), kind, random.chance(50));
    const Control_curve b = random_curve(random, random.between(1, 4), kind, random.chance(50));
    std::string failure;
    std::optional<Locus<2>> solved;
    try {
      solved.emplace(solve(a, b));
    } catch (const locus::Unsupported_feature&) { // a cusp
      continue;
    } catch (const std::exception& e) {
      failure = e.what();
    }
    samples.expect(failure.empty(), [&] { return failure + ": " + show(a, b); });
    if (!solved) continue;
    const Locus<2>& l = *solved;
    longest = std::max(longest, l.statistics().seconds);
    const Graph_numbers numbers = graph_numbers(l);
    if (!numbers.certified) {
      ++undecided;
      open += "\n" + show(numbers) + ": " + reasons(l) + "\n  " + show(a, b);
      samples.expect(kind == Coordinates::grid, [&] { return "general curves undecided: " + reasons(l) + " " + show(a, b); });
      continue;
    }
    ++certified;
    if (!l.degenerate().empty()) continue;
    // Ends of arcs add up.
    std::size_t ends = 0, halves = 0, alone = 0;
    std::vector<std::size_t> degree(l.vertices().size(), 0);
    for (const auto& arc : l.arcs())
      if (!arc.is_closed()) {
        ++degree[*arc.source()];
        ++degree[*arc.target()];
        ends += 2;
      }
    bool sound = true;
    std::vector<std::array<double, 2>> nodes;
    for (std::size_t v = 0; v < degree.size(); ++v) {
      const auto& vertex = l.vertices()[v];
      halves += degree[v];
      alone += degree[v] == 0;
      if (vertex.kind == Vertex_kind::node) sound = sound && degree[v] >= 2 && vertex.half_branches.size() == degree[v];
      if (vertex.kind == Vertex_kind::boundary) sound = sound && degree[v] == 1;
      if (vertex.kind == Vertex_kind::isolated) sound = sound && degree[v] == 0;
      if (vertex.kind == Vertex_kind::undecided) sound = false;
      if (!vertex.half_branches.empty()) nodes.push_back({vertex.feet[0].parameters[0].lo, vertex.feet[1].parameters[0].lo});
    }
    samples.expect(sound && ends == halves, [&] { return "vertices and arcs do not add up, " + show(numbers) + ": " + show(a, b); });
    if (kind == Coordinates::fractions) continue; // coordinates up to 1000 beside small ones: narrower than any grid
    const F3_grid grid(a, b);
    bool agree = false;
    std::size_t seen = 0;
    // Finer grids only where the first one disagrees; a point of the zero set on the boundary alone may be seen or not.
    for (const int n : {200, 801, 3203}) {
      seen = grid.components(n, nodes);
      agree = seen <= l.components() + alone && seen + alone >= l.components();
      if (agree) break;
    }
    const Control_chain second = chain_of(b);
    agree = agree || agrees_with_exact_counts(l, chain_of(a), &second); // branches closer than any grid
    components.expect(agree, [&] { return show(numbers) + ", the grid sees " + std::to_string(seen) + ": " + show(a, b); });
  }
  if (undecided > 0) WARN(undecided << " undecided:" << open);
  CHECK(undecided <= 12u); // small integer coordinates make shared ends and touching curves
  CHECK(longest < 1.0);
  LOCUS_REQUIRE_SAMPLES(samples, 250);
  LOCUS_REQUIRE_SAMPLES(components, 150);
}

TEST_CASE("a certified answer at 2^-45 from a degeneracy is the right one", "[bisector]")
{
  Random random(304);
  Samples samples;
  std::size_t certified = 0;
  for (int k = 0; k < 150; ++k) {
    const Control_curve a = random_curve(random, random.between(1, 3), Coordinates::perturbed, random.chance(30));
    const Control_curve b = random_curve(random, random.between(1, 3), Coordinates::perturbed, random.chance(30));
    std::string failure;
    Graph_numbers first, second, third;
    try {
      first = graph_numbers(solve(a, b));
      second = graph_numbers(solve(reversed(b), a));
      third = graph_numbers(solve(moebius(a, Rational(2)), b));
    } catch (const locus::Unsupported_feature&) {
      continue;
    } catch (const std::exception& e) {
      failure = e.what();
    }
    samples.expect(failure.empty(), [&] { return failure + ": " + show(a, b); });
    certified += first.certified;
    for (const Graph_numbers* other : {&second, &third})
      samples.expect(!first.certified || !other->certified || first == *other, [&] { return show(first) + " | " + show(*other) + ": " + show(a, b); });
  }
  CHECK(certified > 90u);
  LOCUS_REQUIRE_SAMPLES(samples, 300);
}

TEST_CASE("limits and options reach the solver", "[bisector]")
{
  locus::Bisector_options options;
  options.control.max_cells = 3;
  options.control.max_depth = 3;
  const Locus<2> few = solve(cubic_cubic().first, cubic_cubic().second, options);
  CHECK_FALSE(is_certified(few));
  CHECK_FALSE(few.undecided().empty());
  for (const auto& u : few.undecided()) {
    CHECK(u.box.size() == 2u);
    CHECK_FALSE(u.reason.empty());
  }
  for (const auto& arc : few.arcs()) { // what is there can be evaluated
    CHECK(arc.samples(5).size() == 5u);
    CHECK(arc.polyline(1e-3).size() >= 2u);
  }
  options = {};
  options.control.cancel = std::make_shared<std::atomic<bool>>(true);
  const Locus<2> cancelled = solve(cubic_cubic().first, cubic_cubic().second, options);
  CHECK_FALSE(is_certified(cancelled));
  CHECK(cancelled.arcs().empty());
  options = {};
  options.keep_cells = true;
  const Locus<2> kept = solve(cubic_cubic().first, cubic_cubic().second, options);
  double area = 0;
  for (const auto& cell : kept.cells()) {
    REQUIRE(cell.box.size() == 2u);
    area += width(cell.box[0]) * width(cell.box[1]);
    const bool known = cell.claim == "empty" || cell.claim == "graph" || cell.claim == "crossing";
    CHECK(known);
  }
  CHECK(area == Approx(1).epsilon(1e-12));
  CHECK(solve(cubic_cubic()).cells().empty());
  // Evaluation is the same in any rounding mode of the caller, and leaves it alone.
  const auto reference = kept.arcs()[0].samples(7);
  for (const int mode : rounding_modes) {
    std::vector<locus::Arc_point<2>> points;
    int after = -1;
    in_mode(mode, [&] {
      points = kept.arcs()[0].samples(7);
      after = observed_mode();
    });
    INFO(mode_name(mode));
    CHECK(after == mode);
    bool same = true;
    for (std::size_t i = 0; i < points.size(); ++i)
      same = same && points[i].point()[0] == reference[i].point()[0] && points[i].point()[1] == reference[i].point()[1] && points[i].error() == reference[i].error();
    CHECK(same);
  }
}

// ---------------------------------------------------------------------------------- branches where the curves touch

namespace {

/// Radii of the circles with which arcs end at a node, in order; those of infinite branches are beyond the cut radius.
std::vector<double> radii_at(const locus::Locus<2>& l, std::size_t vertex)
{
  std::vector<double> radii;
  for (const auto& branch : l.vertices()[vertex].half_branches) {
    const auto points = l.arcs()[branch.arc].samples(20);
    radii.push_back((branch.at_start ? points.front() : points.back()).radius());
  }
  std::sort(radii.begin(), radii.end());
  return radii;
}

std::optional<std::size_t> first_node(const locus::Locus<2>& l)
{
  for (std::size_t v = 0; v < l.vertices().size(); ++v)
    if (l.vertices()[v].kind == Vertex_kind::node) return v;
  return std::nullopt;
}

void require_drawn(const locus::Locus<2>& l, double relative_error)
{
  CHECK(is_certified(l));
  for (const auto& arc : l.arcs()) CHECK(arc.polyline(1e-5).error() <= relative_error * l.scale());
}

} // namespace

TEST_CASE("where the curves touch at irrational parameters each branch has its own limit", "[bisector]")
{
  // y = x² and the circle around (0, 5/4) touch at x = ±√3/2, where the parabola's radius of curvature is 4: two
  // half-branches shrink to the point of contact, two end in the parabola's centre of curvature.
  const Control_curve parabola = curve_of({{"0", "0"}, {"1/2", "0"}, {"1", "1"}});
  const Control_curve arc = circular_arc({0, Rational("5/4")}, Rational(1), {1, 0}, {1, -1});
  const auto l = locus::untrimmed_bisector(parabola.build(), arc.build());
  require_drawn(l, 1e-2);
  const auto node = first_node(l);
  REQUIRE(node);
  const auto& parameters = l.vertices()[*node].feet[0].parameters[0];
  CHECK(parameters.lo <= std::sqrt(0.75));
  CHECK(parameters.hi >= std::sqrt(0.75) - 1e-15);
  const auto radii = radii_at(l, *node);
  REQUIRE(radii.size() == 4);
  for (const std::size_t k : {0u, 1u}) CHECK(std::abs(radii[k]) < 1e-2);
  for (const std::size_t k : {2u, 3u}) CHECK(std::abs(radii[k] - 4) < 1e-2);
}

TEST_CASE("at an inflection on its tangent some branches go to infinity", "[bisector]")
{
  // y = x³ and y = 0: the median passes the point of contact, and feet with t : r = 3 : 1 have circles that grow for ever.
  const Control_curve cubic = curve_of({{"-1", "-1"}, {"-1/3", "1"}, {"1/3", "-1"}, {"1", "1"}}), line = curve_of({{"-1", "0"}, {"1", "0"}});
  const auto l = locus::untrimmed_bisector(cubic.build(), line.build());
  require_drawn(l, 1e-2);
  const auto node = first_node(l);
  REQUIRE(node);
  REQUIRE(l.vertices()[*node].point);
  CHECK(std::abs((*l.vertices()[*node].point)[0]) < 1e-12);
  const auto radii = radii_at(l, *node);
  REQUIRE(radii.size() == 4);
  CHECK(radii[1] == 0);
  CHECK(radii[2] > 0.5 * l.cut_radius());
}

TEST_CASE("at a flat common end the median has the common point as its limit", "[bisector]")
{
  const Control_curve flat = curve_of({{"0", "0"}, {"1", "0"}, {"2", "0"}, {"3", "1"}}), line = curve_of({{"0", "0"}, {"2", "0"}});
  const auto l = locus::untrimmed_bisector(flat.build(), line.build());
  require_drawn(l, 1e-2);
  std::size_t ends = 0;
  for (const auto& v : l.vertices())
    ends += v.feet[0].parameters[0].hi == 0 && v.feet[1].parameters[0].hi == 0 && v.point && (*v.point)[0] == 0 && (*v.point)[1] == 0;
  CHECK(ends >= 1);
}

TEST_CASE("overlaps that end where the curve stands still", "[bisector]")
{
  const Control_curve cusped = curve_of({{"0", "2"}, {"3", "3"}, {"-3", "3"}, {"-3", "3"}});
  for (const Control_curve& other : {cusped, reversed(cusped), part_of(cusped, Rational("1/2"), Rational(1)), moebius(cusped, Rational(2))}) {
    const auto l = locus::untrimmed_bisector(cusped.build(), other.build());
    INFO(reasons(l));
    require_drawn(l, 1e-2);
    CHECK(std::any_of(l.degenerate().begin(), l.degenerate().end(), [](const auto& d) { return d.kind == "overlap"; }));
  }
}
