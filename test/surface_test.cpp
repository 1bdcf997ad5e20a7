// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces by control points and knots, the one-line constructors of space, and what jobs say of space: rational_surface.h,
// constructors_3.h, json_surface.h, and the spatial side of json_inputs.h and json_job.h.

#include <locus/io/json_job.h>
#include <locus/shape/constructors_3.h>

#include "shape_support.h"

#include <catch2/catch.hpp>

#include <functional>
#include <optional>

using namespace locus;
using namespace locus_test;

namespace {

using Point = Exact_point<3>;

/// A NURBS surface as its definition has it; control points row by row.
struct Nurbs_surface {
  Degrees<2> degrees{};
  std::array<std::vector<Rational>, 2> knots;
  std::vector<Point> points;
  std::vector<Rational> weights;

  Rational_surface surface() const { return bspline_surface(degrees, points, knots, weights); }
  std::size_t count(std::size_t k) const { return knots[k].size() - static_cast<std::size_t>(degrees[k]) - 1; }
  const Rational& start(std::size_t k) const { return knots[k][static_cast<std::size_t>(degrees[k])]; }
  const Rational& finish(std::size_t k) const { return knots[k][count(k)]; }
  std::string shown() const
  {
    std::string text = "degrees " + show(degrees) + ", knots " + show(knots[0]) + show(knots[1]) + ", weights " + show(weights);
    for (const Point& p : points) text += " " + show(p);
    return text;
  }
};

Point defined_point(const Nurbs_surface& s, const std::array<Rational, 2>& at)
{
  Point p{};
  Rational w = 0;
  for (std::size_t i = 0; i < s.count(0); ++i)
    for (std::size_t j = 0; j < s.count(1); ++j) {
      const std::size_t n = i * s.count(1) + j;
      const Rational b = basis(s.knots[0], i, s.degrees[0], at[0], s.finish(0)) *
                         basis(s.knots[1], j, s.degrees[1], at[1], s.finish(1)) *
                         (s.weights.empty() ? Rational(1) : s.weights[n]);
      w += b;
      for (std::size_t v = 0; v < 3; ++v) p[v] += b * s.points[n][v];
    }
  for (Rational& x : p) x /= w;
  return p;
}

/// The points that the pieces which hold the parameters give there, by the definition of Bernstein forms.
std::vector<Point> points_at(const Rational_surface& s, const std::array<Rational, 2>& at)
{
  std::vector<Point> points;
  const auto &rows = s.chains()[0].pieces, &columns = s.chains()[1].pieces;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if (!covers(rows[i], at[0]) || !covers(columns[j], at[1])) continue;
      const Surface_piece& piece = s.pieces()[i * columns.size() + j];
      const std::array<Rational, 2> local{local_value(rows[i], at[0]), local_value(columns[j], at[1])};
      const Rational w = plain_value<2>(piece.weight, local);
      points.emplace_back();
      for (std::size_t v = 0; v < 3; ++v) points.back()[v] = plain_value<2>(piece.numerator[v], local) / w;
    }
  return points;
}

bool passes(const Rational_surface& s, const std::array<Rational, 2>& at, const Point& p)
{
  const auto points = points_at(s, at);
  return !points.empty() && std::all_of(points.begin(), points.end(), [&](const Point& q) { return q == p; });
}

/// Do the ranges fill a grid without gaps, are forms of one degree, and weights positive at many places?
bool is_well_formed(const Rational_surface& s)
{
  std::size_t cells = 1;
  for (const Chain& chain : s.chains()) {
    cells *= chain.pieces.size();
    if (!chain.joints.empty()) return false;
    for (std::size_t k = 0; k < chain.pieces.size(); ++k) {
      const Piece& p = chain.pieces[k];
      if (!p.is_finite() || p.lo >= p.hi || (k > 0 && chain.pieces[k - 1].hi != p.lo)) return false;
    }
  }
  if (s.pieces().size() != cells) return false;
  for (const Surface_piece& piece : s.pieces()) {
    for (const auto& x : piece.numerator)
      if (x.degrees() != piece.degrees()) return false;
    if (!piece.is_polynomial() && piece.weight.degrees() != piece.degrees()) return false;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j)
        if (plain_value<2>(piece.weight, {Rational(i) / 4, Rational(j) / 4}) <= 0) return false;
  }
  return true;
}

/// Knots of every kind: simple, multiple up to the degree, clamped or not.
std::vector<Rational> random_knots(Random& random, int degree, int n)
{
  std::vector<Rational> knots;
  const bool clamped = random.chance(50);
  Rational u = random.between(-3, 3);
  int multiplicity = 0;
  for (int i = 0; i <= n + degree; ++i) {
    const bool at_end = i <= degree || i >= n;
    const bool repeat = at_end && clamped ? i != 0 && i != n : i > 0 && multiplicity < degree && random.chance(30);
    if (i > 0 && !repeat) u += random.chance(50) ? Rational(1) : Rational(random.between(1, 9)) / random.between(1, 4);
    multiplicity = repeat ? multiplicity + 1 : 1;
    knots.push_back(u);
  }
  return knots;
}

void random_net(Random& random, Nurbs_surface& s, bool rational)
{
  for (std::size_t i = 0; i < s.count(0) * s.count(1); ++i) {
    Point p;
    for (Rational& x : p) x = Rational(random.between(-6, 6)) / (random.chance(20) ? 3 : 1);
    s.points.push_back(p);
    if (rational) s.weights.push_back(Rational(random.between(1, 5)) / random.between(1, 2));
  }
}

/// Compares at random places of the domain, at its corners and on the inner knots.
void compare_with_definition(Random& random, Samples& samples, const Nurbs_surface& n, const Rational_surface& s)
{
  samples.expect(is_well_formed(s), [&] { return "ill formed: " + n.shown(); });
  std::array<std::vector<Rational>, 2> values;
  for (std::size_t k = 0; k < 2; ++k) {
    for (const Piece& p : s.chains()[k].pieces) values[k].push_back(p.lo);
    values[k].push_back(n.finish(k));
    samples.expect(values[k].front() == n.start(k) && s.chains()[k].pieces.back().hi == n.finish(k), "domain");
    for (int i = 0; i < 3; ++i)
      values[k].push_back(Rational(n.start(k) + random.unit_rational() * (n.finish(k) - n.start(k))));
  }
  for (const Rational& u : values[0])
    for (const Rational& v : values[1])
      samples.expect(passes(s, {u, v}, defined_point(n, {u, v})), [&] { return n.shown() + " at " + show(u) + ", " + show(v); });
}

} // namespace

// ------------------------------------------------------------------------------------------------------------- values

TEST_CASE("Bezier surfaces against their definition")
{
  Random random(1);
  Samples samples;
  for (int round = 0; round < 60; ++round) {
    Nurbs_surface n;
    for (std::size_t k = 0; k < 2; ++k) {
      n.degrees[k] = random.between(1, 4);
      n.knots[k].assign(static_cast<std::size_t>(n.degrees[k]) + 1, Rational(0));
      n.knots[k].resize(2 * n.knots[k].size(), Rational(1));
    }
    random_net(random, n, random.chance(60));
    std::optional<Rational_surface> s;
    const std::string refused = complaint([&] { s = bezier_surface(n.degrees, n.points, n.weights); });
    samples.expect(s.has_value(), [&] { return refused + n.shown(); });
    if (!s) continue;
    samples.expect(s->pieces().size() == 1 && s->pieces()[0].degrees() == n.degrees, "one piece");
    // Row by row, the first index with the first parameter: coefficients in the same order.
    if (n.weights.empty())
      for (std::size_t i = 0; i < n.points.size(); ++i)
        samples.expect(s->pieces()[0].numerator[2][i] == n.points[i][2], [&] { return n.shown(); });
    compare_with_definition(random, samples, n, *s);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
}

TEST_CASE("B-spline surfaces against their definition")
{
  Random random(2);
  Samples samples;
  int many = 0, refusals = 0;
  for (int round = 0; round < 60; ++round) {
    Nurbs_surface n;
    for (std::size_t k = 0; k < 2; ++k) {
      n.degrees[k] = random.between(1, 3);
      n.knots[k] = random_knots(random, n.degrees[k], n.degrees[k] + random.between(1, 4));
    }
    random_net(random, n, random.chance(60));
    std::optional<Rational_surface> s;
    const std::string refused = complaint([&] { s = n.surface(); });
    if (!s) {
      ++refusals;
      samples.expect(holds(refused, "span no interval"), [&] { return refused + n.shown(); });
      continue;
    }
    many += s->chains()[0].pieces.size() > 1 && s->chains()[1].pieces.size() > 1;
    compare_with_definition(random, samples, n, *s);
  }
  CHECK(many > 20);
  CHECK(refusals < 20);
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
}

TEST_CASE("a surface's grid, ranges and weights")
{
  const std::vector<Coordinates_3> net{{0, 0, 0}, {0, 1, 0}, {0, 2, 1}, {1, 0, 0}, {1, 1, 1}, {1, 2, 0}};
  const std::array<std::vector<Number>, 2> knots{{{0, 0, 2, 2}, {-1, -1, 0, "1/2", "1/2"}}};
  const Rational_surface s = bspline_surface_3({1, 1}, net, knots);
  REQUIRE(s.pieces().size() == 2);
  CHECK(s.chains()[0].pieces.size() == 1);
  CHECK(s.chains()[0].pieces[0].hi == 2);
  REQUIRE(s.chains()[1].pieces.size() == 2);
  CHECK(s.chains()[1].pieces[0].lo == -1);
  CHECK(s.chains()[1].pieces[1].lo == 0);
  CHECK(s.chains()[1].pieces[1].hi == Rational(1, 2));
  for (const Chain& chain : s.chains()) CHECK(!chain.is_closed());
  for (const Surface_piece& piece : s.pieces()) CHECK(piece.is_polynomial());
  CHECK(passes(s, {1, 0}, {Rational(1, 2), 1, Rational(1, 2)}));
  CHECK(passes(s, {2, Rational(1, 2)}, {1, 2, 0}));

  // Equal weights, of whatever sign, make a polynomial surface; unequal negative ones a positive weight.
  for (const Number& w : {Number(3), Number("-2/3")}) {
    const Rational_surface equal = bspline_surface_3({1, 1}, net, knots, {w, w, w, w, w, w});
    for (std::size_t n = 0; n < 2; ++n) {
      CHECK(equal.pieces()[n].is_polynomial());
      CHECK(equal.pieces()[n].weight[0] == 1);
      CHECK(equal.pieces()[n].numerator[2].coefficients() == s.pieces()[n].numerator[2].coefficients());
    }
  }
  const Rational_surface negative = bspline_surface_3({1, 1}, net, knots, {-1, -2, -2, -3, -2, -2});
  CHECK(is_well_formed(negative));
  CHECK(!negative.pieces()[0].is_polynomial());
  CHECK(negative.pieces()[1].is_polynomial()); // its own weights are equal
  CHECK(passes(negative, {2, -1}, {1, 0, 0}));
  // Inner weights may be negative where the denominator stays positive: with c in the middle it is at least (3 + c)/4.
  const std::vector<Coordinates_3> bowl{{0, 0, 1}, {0, 1, 0}, {0, 2, 1}, {1, 0, 0}, {1, 1, -1}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}, {2, 2, 1}};
  const Rational_surface dented = bezier_surface_3({2, 2}, bowl, {1, 1, 1, 1, -2, 1, 1, 1, 1});
  CHECK(is_well_formed(dented));
  CHECK(dented.pieces()[0].weight[4] == -2);
  CHECK(is_well_formed(bezier_surface_3({2, 2}, bowl, {1, 1, 1, 1, "-2.99", 1, 1, 1, 1})));

  // A side of the square may go to one point.
  CHECK_NOTHROW(bezier_surface_3({1, 1}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}}));
}

TEST_CASE("a denominator too near zero along a curve is refused soon")
{
  // (3u + 5v - 4)² + ε.
  const auto made_with = [](const Rational& e) {
    const std::vector<Rational> square{16, -4, 1, 4, Rational(-17, 2), 4, 1, -4, 16};
    std::vector<Rational> weights;
    for (const Rational& w : square) weights.push_back(Rational(w + e));
    std::vector<Point> points;
    for (int i = 0; i < 9; ++i) points.push_back({Rational(i / 3), Rational(i % 3), Rational(i % 2)});
    return complaint([&] { bezier_surface({2, 2}, points, weights); });
  };
  CHECK(made_with(Rational(1, 10)).empty());
  CHECK(made_with(Rational(1, 1000)).empty());
  CHECK(holds(made_with(parse_rational("1e-12")), ".weights | the denominator is not proved positive near"));
  CHECK(holds(made_with(0), ".weights | the denominator vanishes on the domain near"));
  CHECK(holds(made_with(parse_rational("-1e-12")), ".weights | the denominator vanishes on the domain near"));
}

// --------------------------------------------------------------------------------------------------------- rejections

TEST_CASE("what is wrong with a surface is named with its place, rule and remedy")
{
  const std::vector<Coordinates_3> square{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  const std::vector<Coordinates_3> strip{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {1, 0, 0}, {1, 1, 0}, {1, 2, 0}};
  const std::vector<Coordinates_3> bowl{{0, 0, 1}, {0, 1, 0}, {0, 2, 1}, {1, 0, 0}, {1, 1, -1}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}, {2, 2, 1}};
  const std::vector<Number> two{0, 0, 1, 1}, three{0, 0, 1, 2, 2};
  struct Case {
    std::function<void()> make;
    std::string expected;
  };
  const std::vector<Case> cases{
    {[&] { bezier_surface_3({1, 0}, square); },
     ".degrees[1] | the degree must be a whole number from 1 on, not 0 | use 1 where the surface is ruled, 3 for most surfaces"},
    {[&] { bezier_surface_3({1, 2}, square); },
     ".control_points | 4 control points for degrees 1 and 2 | give 2 rows of 3, the first index running with the first parameter"},
    {[&] { bspline_surface_3({1, 1}, square, {two, three}); },
     ".control_points | 4 control points for knots that ask for 2 × 3 | give 2 rows of 3, the first index running with the first parameter"},
    {[&] { bspline_surface_3({1, 1}, square, {{two, {0, 1, 2}}}); },
     ".knots[1] | 3 knots for degree 1 | give at least 2·(degree + 1) = 4"},
    {[&] { bspline_surface_3({1, 1}, square, {{{0, 0, 2, 1}, two}}); }, ".knots[0][3] | knots must not decrease, but 1 follows 2 | sort them"},
    {[&] { bspline_surface_3({1, 1}, {}, {{two, {0, 0, 1, 1, 2, 2}}}); },
     ".knots[1][3] | a knot is repeated too often for degree 1 | repeat an end knot at most degree + 1 times, an inner knot at most degree times"},
    {[&] { bspline_surface_3({1, 1}, square, {{{0, 1, 1, 2}, two}}); },
     ".knots[0] | the knots span no interval | let knots[degree] be less than knots[number of control points]"},
    {[&] { bezier_surface_3({1, 1}, square, {1, 1, 1}); },
     ".weights | 3 weights for 4 control points | give one weight for each control point, or none"},
    {[&] { bezier_surface_3({1, 1}, square, {0, 0, 0, 0}); }, ".weights | all weights are zero | use positive weights"},
    {[&] { bezier_surface_3({1, 1}, square, {0, 1, 1, 1}); },
     ".weights | the denominator vanishes on the domain near (u, v) = (0.000000, 0.000000) (a pole) | use positive weights"},
    {[&] { bezier_surface_3({1, 1}, square, {1, 1, 1, -1}); },
     ".weights | the denominator vanishes on the domain near (u, v) = (0.707107, 0.707107) (a pole) | use positive weights"},
    {[&] { bezier_surface_3({1, 1}, square, {-1, -1, -1, 0}); },
     ".weights | the denominator vanishes on the domain near (u, v) = (1.000000, 1.000000) (a pole) | use positive weights"},
    {[&] { bspline_surface_3({1, 1}, strip, {two, three}, {1, 1, -1, 1, 1, -1}); },
     ".weights | the denominator vanishes on the domain near (u, v) = (0.000000, 1.500000) (a pole) | use positive weights"},
    // Zeros that the denominator only touches: in the middle, and, where no dyadic number is, of (3u - 1)² + (3v - 1)².
    {[&] { bezier_surface_3({2, 2}, bowl, {1, 1, 1, 1, -3, 1, 1, 1, 1}); },
     ".weights | the denominator vanishes on the domain near (u, v) = (0.500000, 0.500000) (a pole) | use positive weights"},
    {[&] { bezier_surface_3({2, 2}, bowl, {2, -1, 5, -1, -4, 2, 5, 2, 8}); },
     ".weights | the denominator is not proved positive near (u, v) = (0.333333, 0.333333): it touches zero (a pole), or nearly so | use positive weights"},
    {[&] { bezier_surface_3({1, 1}, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {1, 2, 1, 1}); },
     ".control_points | the surface is a single point | use a point input instead"},
    {[&] { bspline_surface_3({1, 1}, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {two, three}); },
     ".control_points | the surface is a single point | use a point input instead"},
    {[&] { bezier_surface_3({1, 1}, {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}}); },
     ".control_points | the surface is a curve | use a curve input instead"},
    {[&] { bezier_surface_3({1, 1}, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}, {1, 2, 3, 5}); },
     ".control_points | the surface is a curve | use a curve input instead"},
    // Both parameters move along the parabola (u + v, (u + v)²).
    {[&] { bezier_surface_3({2, 2}, {{0, 0, 0}, {"1/2", 0, 0}, {1, 1, 0}, {"1/2", 0, 0}, {1, "1/2", 0}, {"3/2", 2, 0}, {1, 1, 0}, {"3/2", 2, 0}, {2, 4, 0}}); },
     ".control_points | the surface is a curve | use a curve input instead"},
    {[&] { bspline_surface_3({1, 1}, {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}}, {two, three}); },
     ".control_points | the surface is only a curve over [0, 1] × [1, 2] | take out the control points that repeat others, with as many knots"},
  };
  for (const Case& c : cases) CHECK(complaint(c.make) == c.expected);
}

// ------------------------------------------------------------------------------------------------- curves in one line

TEST_CASE("curves in space in one line")
{
  const Curve_3 cubic = bezier_3({{0, 0, 0}, {1, 2, 0}, {2, "1/2", 1}, {3, 0, 0.5}}, {1, 2, "1/2", 1});
  CHECK(passes<3>(cubic, 1, {3, 0, Rational(1, 2)}));
  // At 1/2 the basis functions are 1/8, 3/8, 3/8, 1/8.
  CHECK(passes<3>(cubic, Rational(1, 2), {Rational(24, 19), Rational(51, 38), Rational(4, 19)}));
  CHECK(passes<3>(segment_3({0, 1, 2}, {2, 3, 6}), Rational(1, 4), {Rational(1, 2), Rational(3, 2), 3}));
  const Curve_3 spline = bspline_3(2, {{0, 0, 0}, {2, 0, 0}, {4, 0, 2}, {6, 0, 4}}, {0, 0, 0, 1, 2, 2, 2});
  REQUIRE(spline.pieces().size() == 2);
  CHECK(passes<3>(spline, 1, {3, 0, 1}));
  CHECK(bspline_3(1, {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {0, 0, 0}}, {0, 0, 1, 2, 3, 3}, {}, true).chain().is_closed());
  CHECK(complaint([] { segment_3({1, 2, 3}, {1, 2, 3}); }) ==
        ".control_points | the curve is a single point | use a point input instead");
}

// --------------------------------------------------------------------------------------------------------------- jobs

namespace {

std::string job_of(const std::string& inputs, const std::string& compute = "bisector", bool trimmed = false)
{
  return R"({"compute": ")" + compute + R"(", "inputs": [)" + inputs + R"(], "options": {"trimmed": )" +
         (trimmed ? "true" : "false") + "}}";
}

std::string complaint_of(const std::string& inputs)
{
  return complaint([&] { read_job(job_of(inputs)); });
}

/// What the version says that it does not have for a job, or nothing.
std::string refusal_of(const std::string& inputs, const std::string& compute = "bisector", bool trimmed = false)
{
  const Job job = read_job(job_of(inputs, compute, trimmed));
  return complaint([&] { require_supported(job); });
}

const std::string point = R"({"point": [1, "1/3", 0.25]})", plane_point = R"({"point": [1, 2]})";
const std::string curve = R"({"curve": {"degree": 1, "control_points": [[0,0,0],[1,1,1]]}})";
const std::string plane_curve = R"({"curve": {"degree": 1, "control_points": [[0,0],[1,1]]}})";
const std::string surface = R"({"surface": {"degrees": [1,1], "control_points": [[[0,0,0],[0,1,0]],[[1,0,0],[1,1,1]]]}})";

/// The only curve of a job.
Curve_3 read_curve_3(const std::string& text)
{
  const Job job = read_job(job_of(R"({"curve": )" + text + "}"));
  CHECK(job.inputs[0].missing.empty());
  CHECK(job.inputs[0].dimension == 3);
  CHECK(!job.inputs[0].curve);
  return job.inputs[0].space_curve.value();
}

/// A job's surface, of a job of a point and it.
Rational_surface read_surface_3(const std::string& text)
{
  const Job job = read_job(job_of(point + R"(, {"surface": )" + text + "}"));
  CHECK(job.inputs[1].missing.empty());
  CHECK(job.inputs[1].kind == Job_input::Kind::surface);
  return job.inputs[1].surface.value();
}

} // namespace

TEST_CASE("a job's curves in space, exactly")
{
  const Curve_3 bezier = read_curve_3(
    R"({"degree": 2, "control_points": [[0,0,0.1],["1/3",2,0],[1,0,1e-6]], "weights": [1,2,1]})");
  REQUIRE(bezier.pieces().size() == 1);
  CHECK(bezier.pieces()[0].numerator[0][1] == Rational(2, 3));
  CHECK(bezier.pieces()[0].numerator[2][0] == Rational(1, 10));
  CHECK(bezier.pieces()[0].numerator[2][2] == Rational(1, 1000000));
  CHECK(bezier.pieces()[0].weight[1] == 2);
  CHECK(passes<3>(bezier, 1, {1, 0, Rational(1, 1000000)}));

  const Curve_3 spline = read_curve_3(
    R"({"degree": 2, "control_points": [[0,0,0],[2,0,0],[4,0,2],[6,0,4]], "knots": [0,0,0,1,2,2,2]})");
  REQUIRE(spline.pieces().size() == 2);
  CHECK(spline.chain().joints.at(0).kind == Joint_kind::smooth);
  CHECK(passes<3>(spline, 1, {3, 0, 1}));
  CHECK(read_curve_3(R"({"degree": 1, "control_points": [[0,0,0],[1,0,0],[0,1,1],[0,0,0]], "knots": [0,0,1,2,3,3], "closed": true})")
          .chain()
          .is_closed());

  // The twisted cubic, on an interval and on a ray.
  const std::string twisted = R"({"monomial": {"x": [0, 1], "y": [0, 0, 1], "z": [0, 0, 0, "1/2"]}, "domain": )";
  const Curve_3 bounded = read_curve_3(twisted + R"(["-1/2", 3]})");
  CHECK(bounded.chain().pieces.front().lo == Rational(-1, 2));
  CHECK(bounded.chain().pieces.back().hi == 3);
  const Curve_3 ray = read_curve_3(twisted + R"([0, "inf"]})");
  CHECK(ray.chain().pieces.back().hi_infinite);
  for (const Curve_3& c : {bounded, ray})
    for (const Rational& u : {Rational(0), Rational(1, 7), Rational(5, 2)})
      CHECK(passes<3>(c, u, {u, Rational(u * u), Rational(u * u * u / 2)}));
  CHECK(passes<3>(ray, 1000, {1000, 1000000, 500000000}));

  // On the whole line through u = ∞ a curve is closed if its point there is finite.
  const Curve_3 circle = read_curve_3(
    R"({"monomial": {"x": [1, 0, -1], "y": [0, 2], "z": [3, 0, 3], "w": [1, 0, 1]}, "domain": ["-inf", "inf"]})");
  CHECK(circle.chain().is_closed());
  CHECK(passes<3>(circle, 2, {Rational(-3, 5), Rational(4, 5), 3}));
  const Curve_3 branches = read_curve_3(
    R"({"monomial": {"x": [1], "y": [0, 0, 1], "z": [1, 1], "w": [0, 1]}, "domain": [-2, 2]})");
  CHECK(branches.chain().joints.at(0).kind == Joint_kind::pole);

  const Job irrational = read_job(
    job_of(R"({"curve": {"monomial": {"x": [1], "y": [0, 1], "z": [1], "w": [-2, 0, 1]}, "domain": [0, 2]}})"));
  CHECK(!irrational.inputs[0].space_curve);
  CHECK(holds(irrational.inputs[0].missing, "pole at an irrational parameter, near u = 1.41421"));
  CHECK(holds(complaint([&] { require_supported(irrational); }), "unsupported: inputs[0]: a curve with a pole"));
}

TEST_CASE("a job's join tolerance holds in space")
{
  const std::string bent = R"({"compute": "bisector", "inputs": [{"point": [0,0,1]},)"
                           R"({"curve": {"degree": 1, "control_points": [[0,0,0],[1,0,0],[2,0,"1/1000"]], "knots": [0,0,1,2,2]}}],)"
                           R"("options": {"trimmed": false, "join_tolerance": )";
  const auto joint = [&](const std::string& tolerance) {
    return read_job(bent + tolerance + "}}").inputs[1].space_curve.value().chain().joints.at(0);
  };
  CHECK(same_joint(joint("0.0009"), {Joint_kind::corner, 0, false}));
  CHECK(same_joint(joint("0.0011"), {Joint_kind::g1, 0, true}));
}

TEST_CASE("a job's points, exactly")
{
  const Job job = read_job(job_of(point + ", " + curve));
  CHECK(job.inputs[0].kind == Job_input::Kind::point);
  CHECK(job.inputs[0].dimension == 3);
  CHECK(job.inputs[0].point == std::vector<Rational>{1, Rational(1, 3), Rational(1, 4)});
  CHECK(!job.inputs[1].point);
  CHECK(read_job(job_of(plane_point + ", " + plane_curve)).inputs[0].point == std::vector<Rational>{1, 2});
}

TEST_CASE("a job's surfaces, exactly")
{
  const Rational_surface bezier = read_surface_3(
    R"({"degrees": [1,2], "control_points": [[[0,0,0.1],[0,1,0],[0,2,0]],[[1,0,0],[1,1,"1/3"],[1,2,0]]], "weights": [[1,2,1],[1,1,"1/2"]]})");
  REQUIRE(bezier.pieces().size() == 1);
  CHECK(bezier.pieces()[0].degrees() == Degrees<2>{1, 2});
  CHECK(bezier.pieces()[0].numerator[1].at({0, 1}) == 2);
  CHECK(bezier.pieces()[0].numerator[2].at({0, 0}) == Rational(1, 10));
  CHECK(bezier.pieces()[0].numerator[2].at({1, 1}) == Rational(1, 3));
  CHECK(bezier.pieces()[0].weight.at({1, 2}) == Rational(1, 2));
  CHECK(passes(bezier, {1, 1}, {1, 2, 0}));

  const Rational_surface spline = read_surface_3(
    R"({"degrees": [1,1], "control_points": [[[0,0,0],[0,1,0],[0,2,1]],[[1,0,0],[1,1,1],[1,2,0]]], "knots": [[0,0,2,2],[-1,-1,0,"1/2","1/2"]]})");
  CHECK(spline.pieces().size() == 2);
  CHECK(passes(spline, {1, 0}, {Rational(1, 2), 1, Rational(1, 2)}));

  std::string rows;
  for (int i = 0; i <= 41; ++i)
    rows += (i ? ", " : "") + ("[[" + std::to_string(i)) + ",0,0],[" + std::to_string(i * i) + ",1,0]]";
  const Job high = read_job(job_of(point + R"(, {"surface": {"degrees": [41,1], "control_points": [)" + rows + "]}}"));
  CHECK(!high.inputs[1].surface);
  CHECK(complaint([&] { require_supported(high); }) == "unsupported: inputs[1]: surfaces of degree above 40");
}

TEST_CASE("what is wrong with a job's surfaces, and mixed dimensions")
{
  const auto complaint_at = [](const std::string& members) { return complaint_of(point + R"(, {"surface": {)" + members + "}}"); };
  const std::string degrees = R"("degrees": [1,1], )", net = R"("control_points": [[[0,0,0],[0,1,0]],[[1,0,0],[1,1,1]]])";
  const std::string in = "inputs[1].surface";
  CHECK(complaint_at(R"("degrees": [1], )" + net) == in + ".degrees | 1 degrees for two parameters | give both degrees, like [2, 2]");
  CHECK(complaint_at(R"("degrees": [1,2], )" + net) ==
        in + ".control_points | 2 points in a row for degree 2 | give degree + 1 = 3");
  CHECK(complaint_at(degrees + R"("control_points": [[[0,0,0],[0,1,0]],[[1,0,0]]])") ==
        in + ".control_points[1] | 1 points in a row, but 2 in the first | make all rows equally long");
  CHECK(complaint_at(degrees + net + R"(, "weights": [[1,1]])") ==
        in + ".weights | 1 rows of weights for 2 rows of control points | give one weight for each control point, or none");
  CHECK(complaint_at(degrees + net + R"(, "weights": [[1,1],[1]])") ==
        in + ".weights[1] | 1 weights for 2 control points | give one weight for each control point, or none");
  CHECK(complaint_at(degrees + net + R"(, "weights": [[0,0],[0,0]])") == in + ".weights | all weights are zero | use positive weights");
  CHECK(complaint_at(degrees + net + R"(, "weights": [[1,1],[1,-1]])") ==
        in + ".weights | the denominator vanishes on the domain near (u, v) = (0.707107, 0.707107) (a pole) | use positive weights");
  CHECK(complaint_at(degrees + net + R"(, "knots": [[0,0,1,1]])") ==
        in + ".knots | 1 lists of knots for two parameters | give two lists of knots");
  CHECK(complaint_at(degrees + net + R"(, "knots": [[0,0,1,1],[0,0,1]])") ==
        in + ".knots[1] | 3 knots for 2 control points of degree 1 | give 4: control points + degree + 1");
  CHECK(complaint_at(degrees + R"("control_points": [[[2,2,2],[2,2,2]],[[2,2,2],[2,2,2]]])") ==
        in + ".control_points | the surface is a single point | use a point input instead");
  CHECK(complaint_at(degrees + R"("control_points": [[[0,0,0],[2,2,2]],[[1,1,1],[3,3,3]]])") ==
        in + ".control_points | the surface is a curve | use a curve input instead");

  const std::string remedy = " | give all points of a job the same number of coordinates";
  CHECK(complaint_of(plane_point + ", " + surface) ==
        in + ".control_points[0][0] | 3 coordinates, but inputs[0].point has 2" + remedy);
  CHECK(complaint_of(curve + ", " + plane_curve) ==
        "inputs[1].curve.control_points[0] | 2 coordinates, but inputs[0].curve.control_points[0] has 3" + remedy);
  CHECK(complaint_of(plane_curve + ", " + point) ==
        "inputs[1].point | 3 coordinates, but inputs[0].curve.control_points[0] has 2" + remedy);
  CHECK(complaint_of(surface + R"(, {"curve": {"monomial": {"x": [0,1], "y": [1]}, "domain": [0,1]}})") ==
        "inputs[1].curve.monomial | 2 coordinates, but inputs[0].surface.control_points[0][0] has 3 | give all inputs of a job the same number of coordinates");
  CHECK(complaint_of(R"({"surface": {"degrees": [1,1], "control_points": [[[0,0],[0,1]],[[1,0],[1,1]]]}}, )" + plane_curve) ==
        "inputs[0].surface.control_points[0][0] | a surface's points have 3 coordinates, not 2 | write [x, y, z]");
}

TEST_CASE("what this version has in space, and what it names as missing")
{
  const std::string untrimmed_only =
    "unsupported: options.trimmed: trimmed bisectors (give \"trimmed\": false for all solutions of the equations)";
  for (const std::string& inputs : {point + ", " + curve, curve + ", " + point, curve + ", " + curve, point + ", " + surface,
                                    surface + ", " + point}) {
    INFO(inputs);
    CHECK(refusal_of(inputs).empty());
    CHECK(refusal_of(inputs, "bisector", true) == untrimmed_only);
  }
  // The bisector of two points needs no trimming.
  CHECK(refusal_of(point + ", " + R"({"point": [0, 0, 0]})").empty());
  CHECK(refusal_of(point + ", " + R"({"point": [0, 0, 0]})", "bisector", true).empty());

  CHECK(refusal_of(curve) == "unsupported: inputs[0]: self-bisectors of curves in space");
  CHECK(refusal_of(curve + ", " + surface) == "unsupported: inputs[0]: bisectors of a curve in space and a surface");
  CHECK(refusal_of(surface + ", " + curve) == "unsupported: inputs[0]: bisectors of a curve in space and a surface");
  CHECK(refusal_of(surface + ", " + surface, "bisector", true) == "unsupported: inputs[0]: bisectors of two surfaces");

  CHECK(refusal_of(plane_curve + ", " + plane_curve).empty());
  CHECK(refusal_of(plane_curve).empty());
  CHECK(refusal_of(plane_curve, "bisector", true).empty());
  CHECK(refusal_of(plane_curve + ", " + plane_curve, "bisector", true).empty());
  for (const bool trimmed : {false, true}) CHECK(refusal_of(plane_curve + ", " + plane_point, "bisector", trimmed).empty());
  for (const bool trimmed : {false, true}) CHECK(refusal_of(plane_point + ", " + plane_point, "bisector", trimmed).empty());

  for (const char* compute : {"curvature", "evolute"})
    for (const std::string& input : {curve, plane_curve})
      for (const bool trimmed : {false, true}) CHECK(refusal_of(input, compute, trimmed).empty());
  CHECK(refusal_of(curve + ", " + curve, "envelope") == "unsupported: compute: \"envelope\"");
  CHECK(refusal_of(surface, "silhouette") == "unsupported: compute: \"silhouette\"");
}
