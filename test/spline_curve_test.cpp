// SPDX-License-Identifier: LGPL-3.0-or-later
// Curves by control points and knots, their joints, the plane's constructors, and what changes their description:
// spline_curve.h, joints.h, cusps.h, constructors_2.h, edit_curve.h.

#include <locus/shape/carrier.h>
#include <locus/shape/constructors_2.h>
#include <locus/shape/edit_curve.h>

#include "shape_support.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <optional>

using namespace locus;
using namespace locus_test;

namespace {

/// A NURBS curve as its definition has it.
template <int Dim>
struct Nurbs {
  int degree = 1;
  std::vector<Exact_point<Dim>> points;
  std::vector<Rational> knots, weights;

  Rational_curve<Dim> curve(bool closed = false) const { return bspline_curve<Dim>(degree, points, knots, weights, closed); }
  const Rational& start() const { return knots[static_cast<std::size_t>(degree)]; }
  const Rational& finish() const { return knots[points.size()]; }
  std::string shown() const
  {
    std::string text = "degree " + std::to_string(degree) + ", knots " + show(knots) + ", weights " + show(weights) + ", points ";
    for (const auto& p : points) text += show(p);
    return text;
  }
};

template <int Dim>
Exact_point<Dim> defined_point(const Nurbs<Dim>& c, const Rational& x)
{
  Exact_point<Dim> p{};
  Rational w = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const Rational b = basis(c.knots, i, c.degree, x, c.finish()) * (c.weights.empty() ? Rational(1) : c.weights[i]);
    w += b;
    for (std::size_t v = 0; v < p.size(); ++v) p[v] += b * c.points[i][v];
  }
  for (Rational& v : p) v /= w;
  return p;
}

/// Knots of every kind: simple, multiple up to the degree, clamped or not, uniform or not.
template <int Dim>
Nurbs<Dim> random_nurbs(Random& random, bool rational)
{
  Nurbs<Dim> c;
  c.degree = random.between(1, 4);
  const int n = c.degree + random.between(1, 5);
  const bool clamped = random.chance(50);
  Rational u = random.between(-3, 3);
  int multiplicity = 0;
  for (int i = 0; i <= n + c.degree; ++i) {
    const bool at_end = i <= c.degree || i >= n;
    const bool repeat = at_end && clamped ? i != 0 && i != n : i > 0 && multiplicity < c.degree && random.chance(30);
    if (i > 0 && !repeat) u += random.chance(50) ? Rational(1) : Rational(random.between(1, 9)) / random.between(1, 4);
    multiplicity = repeat ? multiplicity + 1 : 1;
    c.knots.push_back(u);
  }
  for (int i = 0; i < n; ++i) {
    Exact_point<Dim> p;
    for (Rational& x : p) x = Rational(random.between(-6, 6)) / (random.chance(20) ? 3 : 1);
    c.points.push_back(p);
    if (rational) c.weights.push_back(Rational(random.between(1, 5)) / random.between(1, 2));
  }
  return c;
}

template <int Dim>
Rational random_parameter(Random& random, const Rational_curve<Dim>& c)
{
  const Rational lo = c.chain().pieces.front().lo, hi = c.chain().pieces.back().hi;
  return Rational(lo + random.unit_rational() * (hi - lo));
}

template <int Dim>
void compare_with_definition(std::uint64_t stream)
{
  Random random(stream);
  Samples samples;
  std::array<int, 4> kinds{};
  for (int round = 0; round < 150; ++round) {
    const Nurbs<Dim> n = random_nurbs<Dim>(random, random.chance(60));
    std::optional<Rational_curve<Dim>> c;
    const std::string refused = complaint([&] { c = n.curve(); });
    if (!c) {
      const bool for_reason =
        holds(refused, "stands still") || holds(refused, "single point") || holds(refused, "span no interval");
      samples.expect(for_reason, [&] { return refused + n.shown(); });
      continue;
    }
    samples.expect(is_well_formed(*c), [&] { return "ill formed: " + n.shown(); });
    samples.expect(joints_are_true(*c), [&] { return "joints: " + n.shown() + "\n" + show_curve(*c); });
    for (const Joint& j : c->chain().joints) ++kinds[static_cast<std::size_t>(j.kind)];
    for (int i = 0; i < 6; ++i) {
      const Rational u = random_parameter(random, *c);
      samples.expect(passes(*c, u, defined_point(n, u)), [&] { return n.shown() + " at " + show(u); });
    }
    for (const Piece& p : c->chain().pieces)
      samples.expect(passes(*c, p.hi, defined_point(n, p.hi)), [&] { return n.shown() + " at the joint " + show(p.hi); });
  }
  CHECK(kinds[0] > 50); // smooth
  CHECK(kinds[2] > 20); // corners
  CHECK(kinds[3] == 0);
  LOCUS_REQUIRE_SAMPLES(samples, 900);
}

} // namespace

// ---------------------------------------------------------------------------------------------------------- B-splines

TEST_CASE("plane B-splines against their definition") { compare_with_definition<2>(1); }
TEST_CASE("B-splines in space against their definition") { compare_with_definition<3>(2); }

TEST_CASE("continuity is at least what the knots promise")
{
  Random random(3);
  Samples samples;
  for (int round = 0; round < 100; ++round) {
    const Nurbs<2> n = random_nurbs<2>(random, false);
    std::optional<Curve_2> c;
    if (!complaint([&] { c = n.curve(); }).empty()) continue;
    for (std::size_t k = 0; k < c->chain().joints.size(); ++k) {
      const Rational& u = c->chain().pieces[k].hi;
      const auto multiplicity = std::count(n.knots.begin(), n.knots.end(), u);
      const Joint& j = c->chain().joints[k];
      const auto x = derivatives_at(c->pieces()[k], c->chain().pieces[k], true, 2);
      if (multiplicity == n.degree || x[1] == Exact_point<2>{}) continue; // only C⁰, or irregular
      samples.expect(j.kind == Joint_kind::smooth && j.order >= n.degree - multiplicity,
                     [&] { return n.shown() + " at " + show(u) + ": " + show(j); });
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 50);
}

TEST_CASE("periodic B-splines are closed with the continuity of their knots")
{
  Random random(4);
  for (int degree = 1; degree <= 4; ++degree)
    for (int round = 0; round < 5; ++round) {
      Nurbs<2> n;
      n.degree = degree;
      const int period = degree + 3;
      for (int i = 0; i < period; ++i) n.points.push_back({Rational(random.between(-9, 9)), Rational(13 * i - random.below(5))});
      for (int i = 0; i < degree; ++i) n.points.push_back(n.points[static_cast<std::size_t>(i)]);
      for (int i = 0; i <= period + 2 * degree; ++i) n.knots.push_back(i);
      const Curve_2 c = n.curve(true);
      INFO(show_curve(c));
      REQUIRE(c.chain().is_closed());
      CHECK(c.pieces().size() == static_cast<std::size_t>(period));
      CHECK(joints_are_true(c));
      const Joint seam = c.chain().joints.back();
      if (degree == 1) CHECK(seam.kind == Joint_kind::corner);
      else CHECK(seam.kind == Joint_kind::smooth);
      if (degree > 1) CHECK(seam.order >= degree - 1);
    }
}

TEST_CASE("B-splines: what the pieces look like")
{
  // Equal weights, of whatever sign, make a polynomial curve; unequal negative ones a positive weight.
  const std::vector<Exact_point<2>> points{{0, 0}, {1, 3}, {4, 2}, {6, 6}};
  const std::vector<Rational> knots{0, 0, 0, 2, 3, 3, 3};
  for (const Rational& w : {Rational(1), Rational(-2, 3)}) {
    const Curve_2 c = bspline_curve<2>(2, points, knots, {w, w, w, w});
    REQUIRE(c.pieces().size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(c.pieces()[k].is_polynomial());
      CHECK(c.pieces()[k].weight[0] == 1);
      CHECK(c.pieces()[k].degree() == 2);
    }
    CHECK(passes<2>(c, 3, {6, 6}));
  }
  const Curve_2 negative = bspline_curve<2>(2, points, knots, {-1, -2, -1, -3});
  for (const auto& piece : negative.pieces()) CHECK(detail::all_of_one_sign(piece.weight));
  for (const auto& piece : negative.pieces()) CHECK(piece.weight[0] > 0);
  // Inner weights may be negative where the denominator stays positive.
  CHECK(bspline_curve<2>(2, points, knots, {1, Rational(-1, 8), 1, 1}).pieces().size() == 2);
  // A common factor of numerators and weight, here 1 + s, goes: the pieces become lines with the weight 1.
  const Curve_2 reducible = bspline_2(2, {{0, 0}, {"1/3", "2/3"}, {1, 2}}, {0, 0, 0, 1, 1, 1}, {1, "3/2", 2});
  REQUIRE(reducible.pieces()[0].degree() == 1);
  CHECK(reducible.pieces()[0].is_polynomial());
  CHECK(passes<2>(reducible, Rational(1, 2), {Rational(1, 2), Rational(1)}));
  // Degrees are not lowered.
  CHECK(bspline_curve<2>(2, {{0, 0}, {1, 1}, {2, 2}}, {0, 0, 0, 1, 1, 1}).pieces()[0].degree() == 2);
  // An inner knot that stands degree + 1 times between equal control points; weights scale the point, not its place.
  const Curve_2 twice = bspline_curve<2>(2, {{0, 0}, {1, 0}, {2, 0}, {2, 0}, {3, 0}, {4, 1}}, {0, 0, 0, 1, 1, 1, 2, 2, 2},
                                         {1, 1, 2, 5, 1, 1});
  REQUIRE(twice.pieces().size() == 2);
  CHECK(twice.chain().joints[0].kind == Joint_kind::g1);
  CHECK(joints_are_true(twice));
}

TEST_CASE("what is wrong with a B-spline is named with its index and remedy")
{
  const std::vector<Exact_point<2>> p{{0, 0}, {1, 1}, {2, 0}, {3, 1}};
  struct Case {
    std::function<void()> make;
    std::string place, rule, remedy;
  };
  const std::vector<Case> cases{
    {[&] { bspline_curve<2>(0, p, {0, 1, 2, 3, 4}); }, ".degree", "from 1 on, not 0", "use 1"},
    {[&] { bspline_curve<2>(4, p, {0, 1, 2, 3, 4}); }, ".control_points",
     "4 control points for degree 4", "at least degree + 1 = 5"},
    {[&] { bspline_curve<2>(1, {}, {}); }, ".control_points", "0 control points", "at least degree + 1 = 2"},
    {[&] { bspline_curve<2>(2, p, {0, 0, 0, 1, 1, 1}); }, ".knots", "6 knots for 4 control points of degree 2", "give 7"},
    {[&] { bspline_curve<2>(2, p, {0, 0, 0, 1, 1, 1, 1, 1}); }, ".knots", "8 knots", "give 7"},
    {[&] { bspline_curve<2>(2, p, {0, 0, 0, 2, 1, 3, 3}); }, ".knots[4]", "1 follows 2", "sort"},
    {[&] { bspline_curve<2>(2, p, {0, 0, 0, 0, 1, 1, 1}); }, ".knots[3]", "too often for degree 2", "at most degree + 1 times"},
    {[&] { bspline_curve<1 + 1>(1, p, {0, 0, 1, 1, 1, 2}); }, ".knots[4]", "too often for degree 1", "inner knot at most degree"},
    {[&] { bspline_curve<2>(1, p, {0, 1, 1, 1, 2, 3}); }, ".knots[3]", "too often for degree 1", "inner knot at most degree"},
    {[&] { bspline_curve<2>(1, p, {0, 0, 1, 1, 2, 2}); }, ".knots[3]", "inner knot 1 is repeated degree + 1 times", "coincide"},
    {[&] { bspline_curve<2>(1, {{0, 0}, {1, 1}}, {0, 1, 1, 2}); }, ".knots", "span no interval", "knots[degree]"},
    {[&] { bspline_curve<2>(1, p, {0, 0, 1, 2, 3, 3}, {1, 1, 1}); }, ".weights", "3 weights for 4", "one weight for each"},
    {[&] { bspline_curve<2>(1, p, {0, 0, 1, 2, 3, 3}, {0, 0, 0, 0}); }, ".weights", "all weights are zero", "positive"},
    {[&] { bspline_curve<2>(1, p, {0, 0, 1, 2, 3, 3}, {1, 2, -2, 1}); }, ".weights[2]",
     "near u = 1.500000 (a pole), between knots[2] and knots[3]", "positive weights"},
    {[&] { bspline_curve<2>(1, p, {0, 0, 1, 2, 3, 3}, {1, 0, 0, 1}); }, ".weights[1]",
     "between knots[2] and knots[3]", "positive"},
    {[&] { bspline_curve<2>(2, p, {0, 0, 0, 5, 9, 9, 9}, {1, 1, -5, 1}); }, ".weights[2]", "a pole", "positive"},
    {[&] { bspline_curve<2>(1, {{0, 0}, {1, 1}, {1, 1}, {2, 0}}, {0, 0, 1, 2, 3, 3}); }, ".control_points",
     "stands still between knots[2] and knots[3]", "take out"},
    {[&] { bspline_curve<2>(1, {{1, 1}, {1, 1}, {1, 1}}, {0, 0, 1, 2, 2}); }, ".control_points",
     "the curve is a single point", "point input"},
    {[&] { bspline_curve<2>(1, {{1, 1}, {1, 1}}, {0, 0, 1, 1}, {1, 7}); }, ".control_points",
     "the curve is a single point", "point input"},
    {[&] { bspline_curve<2>(1, p, {0, 0, 1, 2, 3, 3}, {}, true); }, ".closed",
     "the ends of the curve do not coincide", "leave out"},
    {[&] { circle_2({0, 0}, 0); }, ".radius", "must be positive", "point"},
    {[&] { ellipse_2({0, 0}, 1, -1); }, ".b", "must be positive", "segment"},
    {[&] { ellipse_2({0, 0}, {1, 2}, {-2, -4}); }, ".half_diameters", "parallel", "segment"},
    {[&] { arc_2({1, 2}, {1, 2}, 1); }, ".end", "must differ", "circle_2"},
    {[&] { polyline_2({{0, 0}}); }, ".points", "at least 2 points, not 1", "add"},
    {[&] { polyline_2({{0, 0}, {1, 1}, {1, 1}, {0, 2}}); }, ".points[2]", "repeats the point before it", "leave it out"},
    {[&] { polyline_2({{0, 0}, {1, 1}, {0, 0}}, true); }, ".points[0]", "repeats the point before it", "leave it out"},
  };
  for (const Case& c : cases) {
    const std::string found = complaint(c.make);
    INFO(found << "\nexpected: " << c.place << " | " << c.rule << " | " << c.remedy);
    CHECK(found.substr(0, c.place.size() + 3) == c.place + " | ");
    CHECK(holds(found, c.rule));
    CHECK(holds(found.substr(found.rfind(" | ") + 1), c.remedy));
  }
}

// ------------------------------------------------------------------------------------------------------------- joints

namespace {

/// The joint of two quadratics, by their control points.
Joint joint_of_quadratics(const std::vector<Coordinates_2>& p)
{
  const Curve_2 c = bspline_2(2, p, {0, 0, 0, 1, 1, 2, 2, 2});
  REQUIRE(c.pieces().size() == 2);
  CHECK(joints_are_true(c));
  return c.chain().joints[0];
}

Joint bend(const char* slope, const Rational& tolerance)
{
  return with_join_tolerance(polyline_2({{0, 0}, {1, 0}, {2, slope}}), tolerance).chain().joints[0];
}

} // namespace

TEST_CASE("joints at exact ties")
{
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, 1}, {2, 0}, {3, -1}, {5, 0}}), {Joint_kind::smooth, 1, false}));
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, 1}, {2, 0}, {3, -1}, {4, -4}}),
                   {Joint_kind::smooth, Joint::any_order, false})); // one parabola
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, 1}, {2, 0}, {3, -1}, {4, 0}}), {Joint_kind::smooth, 1, false}));
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, 0}, {2, 1}, {3, 2}, {4, 4}}), {Joint_kind::smooth, Joint::any_order, false}));
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, 1}, {2, 0}, {4, -2}, {5, 0}}), {Joint_kind::g1, 0, false}));
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, 1}, {2, 0}, {1, 1}, {5, 0}}), {Joint_kind::corner, 0, false}));
  // A derivative that vanishes on one side or both: the next one points the way.
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {2, 0}, {2, 0}, {3, 0}, {4, 1}}), {Joint_kind::g1, 0, false}));
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {2, 0}, {2, 0}, {2, 0}, {4, 0}}), {Joint_kind::g1, 0, false}));
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {2, 0}, {2, 0}, {2, 0}, {1, 0}}), {Joint_kind::corner, 0, false}));
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {2, 0}, {2, 0}, {2, 0}, {4, 1}}), {Joint_kind::corner, 0, false}));
  // Parallel but for a digit that no double holds.
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, "1e200"}, {2, 0}, {3, "-1e200"}, {5, 0}}), {Joint_kind::smooth, 1, false}));
  const std::string nearly = "-1" + std::string(60, '0') + "1";
  CHECK(same_joint(joint_of_quadratics({{0, 0}, {1, "1e61"}, {2, 0}, {3, nearly}, {5, 0}}), {Joint_kind::corner, 0, false}));
  // In space.
  const Rational_curve<3> bent = bspline_curve<3>(1, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 4}}, {0, 0, 1, 3, 4, 4});
  CHECK(same_joint(bent.chain().joints[0], {Joint_kind::g1, 0, false}));
  CHECK(same_joint(bent.chain().joints[1], {Joint_kind::corner, 0, false}));
  CHECK(joints_are_true(bent));
  // A rational quadratic cut at 1/2 with other weights in the halves: one curve, another parameter.
  const Curve_2 arc = arc_2({1, 0}, {0, 1}, "1/3");
  const Curve_2 cut = with_inserted_knot(arc, Rational(1, 2));
  CHECK(same_joint(cut.chain().joints[0], {Joint_kind::smooth, Joint::any_order, false}));
  std::vector<Curve_piece<2>> pieces = cut.pieces();
  pieces[1] = detail::changed(pieces[1], [](const Bernstein<Rational, 1>& f) { return detail::rescaled(f, 1, 2); });
  CHECK(same_joint(joined_curve(pieces, cut.chain().pieces, false).chain().joints[0], {Joint_kind::g1, 0, false}));
  // Orders of every size: u^k appears at u = 0.
  for (int k = 1; k <= 5; ++k) {
    Polynomial f(static_cast<std::size_t>(k) + 1, Rational(0));
    f.back() = 1;
    Curve_piece<2> left, right;
    left.weight = right.weight = Bernstein<Rational, 1>(Degrees<1>{0}, {Rational(1)});
    left.numerator = {bernstein_on_unit({-1, 1}, 5), bernstein_on_unit({}, 5)};
    right.numerator = {bernstein_on_unit({0, 1}, 5), bernstein_on_unit(f, 5)};
    const Joint j = joint_between(left, detail::finite_range(-1, 0), right, detail::finite_range(0, 1));
    INFO(k << ": " << show(j));
    if (k == 1) CHECK(j.kind == Joint_kind::corner);
    else CHECK(j.kind == Joint_kind::smooth);
    CHECK(j.order == k - 1);
  }
}

TEST_CASE("a tolerance takes small turns as smooth, and never a greater one")
{
  CHECK(bend("1e-3", 0).kind == Joint_kind::corner);
  CHECK(same_joint(bend("1e-3", Rational(1, 1000)), {Joint_kind::g1, 0, true})); // atan(x) < x
  CHECK(same_joint(bend("1e-3", Rational(9999, 10000000)), {Joint_kind::corner, 0, false}));
  CHECK(same_joint(bend("1e-300", parse_rational("1.0000001e-300")), {Joint_kind::g1, 0, true}));
  CHECK(same_joint(bend("1e-300", parse_rational("0.9999999e-300")), {Joint_kind::corner, 0, false}));
  CHECK(same_joint(bend("0", Rational(1, 2)), {Joint_kind::smooth, Joint::any_order, false}));
  CHECK(bend("1", 100).by_tolerance);    // 45° is less than 1 radian
  CHECK(!bend("100", 100).by_tolerance); // nearly 90° is not
  // A reversal is none, however large the tolerance.
  const Curve_2 back = with_join_tolerance(polyline_2({{0, 0}, {1, 0}, {0, "1e-9"}}), Rational(1));
  CHECK(same_joint(back.chain().joints[0], {Joint_kind::corner, 0, false}));
  CHECK(same_joint(with_join_tolerance(with_join_tolerance(polyline_2({{0, 0}, {1, 0}, {2, "1e-3"}}), 1), 0).chain().joints[0],
                   {Joint_kind::corner, 0, false}));
  Samples samples;
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    const double angle = random.unit() * 0.999, tolerance = angle * (1 + random.symmetric() * 0.01);
    const Rational y = exact_rational(std::tan(angle));
    const Curve_2 c = with_join_tolerance(polyline_2({{0, 0}, {1, 0}, {2, y}}), exact_rational(tolerance));
    const bool taken = c.chain().joints[0].by_tolerance;
    const auto shown = [&] { return (taken ? "taken: " : "refused: ") + show(angle) + " by " + show(tolerance); };
    if (angle > tolerance * (1 + 1e-12)) samples.expect(!taken, shown);
    if (angle < tolerance * (1 - 1e-5)) samples.expect(taken, shown);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 350);
}

TEST_CASE("pieces are cut where the curve stands still at a rational parameter")
{
  // (u², u³) about 2/3, by control points: a cusp there, on a knot vector that does not know.
  const Polynomial x = compose_linear({0, 0, 1}, Rational(-2, 3), 1), y = compose_linear({0, 0, 0, 1}, Rational(-2, 3), 1);
  const Bernstein<Rational, 1> bx = bernstein_on_unit(x, 3), by = bernstein_on_unit(y, 3);
  std::vector<Exact_point<2>> p;
  for (std::size_t i = 0; i < 4; ++i) p.push_back({bx[i], by[i]});
  const Curve_2 c = bspline_curve<2>(3, p, {5, 5, 5, 5, 8, 8, 8, 8});
  REQUIRE(c.pieces().size() == 2);
  CHECK(c.chain().pieces[0].hi == 7);
  CHECK(same_joint(c.chain().joints[0], {Joint_kind::corner, 0, false}));
  for (int i = 0; i <= 12; ++i) {
    const Rational s = Rational(i) / 12;
    CHECK(passes<2>(c, 5 + 3 * s, {horner(x, s), horner(y, s)}));
  }
  // (u³, u⁶) stands still without reversing; a straight line that turns back; both at 1/2, rational too.
  for (const auto& [degree, kind] : std::vector<std::pair<int, Joint_kind>>{{3, Joint_kind::g1}, {2, Joint_kind::corner}}) {
    Polynomial f(static_cast<std::size_t>(degree) + 1, Rational(0));
    f.back() = 1;
    const Polynomial g = compose_linear(f, -1, 2);
    const Bernstein<Rational, 1> b = bernstein_on_unit(g, 6), b2 = bernstein_on_unit(times(g, g), 6),
      w = bernstein_on_unit({2, 1}, 6);
    std::vector<Exact_point<2>> q, line;
    std::vector<Rational> weights;
    for (std::size_t i = 0; i < 7; ++i) {
      q.push_back({Rational(b[i] / w[i]), degree == 3 ? Rational(b2[i] / w[i]) : Rational(b[i] / w[i])});
      line.push_back({b[i], Rational(3 * b[i])});
      weights.push_back(w[i]);
    }
    const std::vector<Rational> knots{0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1};
    const Curve_2 bent = bspline_curve<2>(6, q, knots, weights);
    REQUIRE(bent.pieces().size() == 2);
    CHECK(bent.chain().pieces[1].lo == Rational(1, 2));
    CHECK(bent.chain().joints[0].kind == kind);
    CHECK(joints_are_true(bent));
    const Curve_2 straight = bspline_curve<2>(6, line, knots);
    REQUIRE(straight.pieces().size() == 2);
    CHECK(straight.chain().joints[0].kind == kind);
    CHECK(joints_are_true(straight));
    CHECK(carrier_of(straight.pieces()[0]).kind == Carrier::Kind::line);
  }
  // A cusp at 1/√2 stays inside.
  const Polynomial ix{0, Rational(-1, 2), 0, Rational(1, 3)}, iy{0, 0, Rational(-1, 4), 0, Rational(1, 4)};
  const Bernstein<Rational, 1> jx = bernstein_on_unit(ix, 4), jy = bernstein_on_unit(iy, 4);
  std::vector<Exact_point<2>> r;
  for (std::size_t i = 0; i < 5; ++i) r.push_back({jx[i], jy[i]});
  CHECK(bspline_curve<2>(4, r, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}).pieces().size() == 1);
  // Several cusps in one piece, one of them at 1/3: x' and y' have (3u-1)(2u-1)(5u-4).
  const Polynomial three = with_roots({Rational(1, 3), Rational(1, 2), Rational(4, 5)});
  const auto integral = [](const Polynomial& f) {
    Polynomial g{0};
    for (std::size_t i = 0; i < f.size(); ++i) g.push_back(Rational(f[i] / static_cast<unsigned long>(i + 1)));
    return g;
  };
  const Polynomial tx = integral(three), ty = integral(times(three, {1, 1}));
  const Bernstein<Rational, 1> kx = bernstein_on_unit(tx, 5), ky = bernstein_on_unit(ty, 5);
  std::vector<Exact_point<3>> t;
  for (std::size_t i = 0; i < 6; ++i) t.push_back({kx[i], ky[i], Rational(kx[i] - 2 * ky[i])});
  const Rational_curve<3> many = bspline_curve<3>(5, t, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1});
  REQUIRE(many.pieces().size() == 4);
  CHECK(many.chain().pieces[1].lo == Rational(1, 3));
  CHECK(many.chain().pieces[2].lo == Rational(1, 2));
  CHECK(many.chain().pieces[3].lo == Rational(4, 5));
  for (const Joint& j : many.chain().joints) CHECK(j.kind == Joint_kind::corner);
  CHECK(joints_are_true(many));
  // Bézier curves are cut on demand only.
  const Curve_2 bezier = bezier_2({{0, 0}, {3, 3}, {0, 3}, {3, 0}});
  CHECK(bezier.pieces().size() == 1);
  CHECK(split_at_cusps(bezier).pieces().size() == 2);
}

// ------------------------------------------------------------------------------------------------- one-line constructors

TEST_CASE("circles and ellipses")
{
  const Exact_point<2> centre{Rational(1, 3), -2};
  const Curve_2 circle = circle_2({"1/3", -2}, "5/2");
  REQUIRE(circle.pieces().size() == 4);
  CHECK(circle.chain().is_closed());
  CHECK(is_well_formed(circle));
  CHECK(joints_are_true(circle));
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(circle.chain().joints[k].kind == Joint_kind::smooth);
    CHECK(circle.chain().joints[k].order == (k % 2 == 0 ? 1 : Joint::any_order));
    const Carrier carrier = carrier_of(circle.pieces()[k]);
    CHECK(carrier.kind == Carrier::Kind::circle);
    CHECK(carrier.centre == centre);
    CHECK(carrier.squared_radius == Rational(25, 4));
  }
  const Rational r(5, 2);
  CHECK(passes<2>(circle, 0, {Rational(centre[0] + r), centre[1]}));
  CHECK(passes<2>(circle, 1, {centre[0], Rational(centre[1] + r)}));
  CHECK(passes<2>(circle, 2, {Rational(centre[0] - r), centre[1]}));
  CHECK(passes<2>(circle, 3, {centre[0], Rational(centre[1] - r)}));
  CHECK(passes<2>(circle, 4, {Rational(centre[0] + r), centre[1]}));
  // Each quarter stays in its quadrant.
  for (int i = 0; i < 32; ++i) {
    const Rational u = Rational(2 * i + 1) / 16;
    const auto p = points_at(circle, u)[0];
    const int quadrant = i / 8;
    CHECK((p[0] > centre[0]) == (quadrant == 0 || quadrant == 3));
    CHECK((p[1] > centre[1]) == (quadrant < 2));
  }
  const Curve_2 ellipse = ellipse_2({1, 1}, {3, 1}, {-1, 2});
  CHECK(joints_are_true(ellipse));
  for (int i = 0; i < 40; ++i) {
    // (x, y) = centre + X·(3,1) + Y·(-1,2) with X² + Y² = 1.
    const auto p = points_at(ellipse, Rational(Rational(i) / 10))[0];
    const Rational x = (2 * (p[0] - 1) + (p[1] - 1)) / 7, y = (3 * (p[1] - 1) - (p[0] - 1)) / 7;
    CHECK(Rational(x * x + y * y) == 1);
  }
  CHECK(passes<2>(ellipse_2({0, 0}, 3, "1/2"), 1, {0, Rational(1, 2)}));
}

TEST_CASE("arcs by their bulge")
{
  for (const char* bulge : {"1/10", "1/3", "-1/3", "1/2", "-1", "1", "3", "-7/2", "1000", "1e-9"}) {
    const Rational b = parse_rational(bulge);
    const Curve_2 arc = arc_2({1, 1}, {4, 5}, bulge); // chord 5
    INFO(bulge << "\n" << show_curve(arc));
    CHECK(is_well_formed(arc));
    CHECK(joints_are_true(arc));
    const Rational last = arc.chain().pieces.back().hi;
    CHECK(passes<2>(arc, 0, {1, 1}));
    CHECK(passes<2>(arc, last, {4, 5}));
    // Half-way it is bulge times half the chord to the right of the chord's middle.
    CHECK(passes<2>(arc, last / 2, {Rational(Rational(5, 2) + b * 2), Rational(3 - b * Rational(3, 2))}));
    for (const auto& piece : arc.pieces()) {
      const Carrier carrier = carrier_of(piece);
      CHECK(carrier.kind == Carrier::Kind::circle);
      const Rational sagitta = abs(b) * Rational(5, 2), half(5, 2);
      const Rational radius = (half * half + sagitta * sagitta) / (2 * sagitta);
      CHECK(carrier.squared_radius == Rational(radius * radius));
      CHECK(detail::all_of_one_sign(piece.weight));
    }
    for (const Joint& j : arc.chain().joints) CHECK(same_joint(j, {Joint_kind::smooth, Joint::any_order, false}));
  }
  CHECK(arc_2({0, 0}, {1, 1}, 0).pieces()[0].degree() == 1);
}

TEST_CASE("polylines and B-splines in one line")
{
  const Curve_2 open = polyline_2({{0, 0}, {1, 0}, {3, 0}, {3, "1/2"}});
  CHECK(is_well_formed(open));
  REQUIRE(open.chain().joints.size() == 2);
  CHECK(same_joint(open.chain().joints[0], {Joint_kind::g1, 0, false}));
  CHECK(same_joint(open.chain().joints[1], {Joint_kind::corner, 0, false}));
  CHECK(passes<2>(open, Rational(3, 2), {2, 0}));
  const Curve_2 square = polyline_2({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true);
  CHECK(square.chain().is_closed());
  CHECK(square.pieces().size() == 4);
  CHECK(passes<2>(square, Rational(7, 2), {0, Rational(1, 2)}));
  CHECK(polyline_2({{0, 0}, {1, 2}}).pieces().size() == 1);
  const Curve_2 c = bspline_2(2, {{0, 0}, {1, 2}, {2, "0.1"}}, {0, 1, 2, 3, 4, 5}, {1, "1/2", 1});
  CHECK(c.chain().pieces[0].lo == 2);
  CHECK(c.chain().pieces[0].hi == 3);
}

// ------------------------------------------------------------------------------------------------------------- editing

namespace {

/// Do two curves pass through the same points at corresponding parameters?
template <int Dim, class Map>
bool same_points(const Rational_curve<Dim>& a, const Rational_curve<Dim>& b, Random& random, Map map)
{
  for (int i = 0; i < 8; ++i) {
    const Rational u = random_parameter(random, a);
    if (!passes(b, map(u), points_at(a, u)[0])) return false;
  }
  return true;
}

template <int Dim>
bool same_joints(const Rational_curve<Dim>& a, const Rational_curve<Dim>& b)
{
  if (a.chain().joints.size() != b.chain().joints.size()) return false;
  for (std::size_t k = 0; k < a.chain().joints.size(); ++k)
    if (!same_joint(a.chain().joints[k], b.chain().joints[k])) return false;
  return true;
}

/// Joints as they are found anew.
template <int Dim>
Rational_curve<Dim> anew(const Rational_curve<Dim>& c)
{
  return joined_curve(c.pieces(), c.chain().pieces, c.chain().is_closed());
}

} // namespace

TEST_CASE("edited curves keep their points and their joints")
{
  Random random(6);
  Samples samples;
  for (int round = 0; round < 60; ++round) {
    std::optional<Rational_curve<3>> made;
    const Nurbs<3> n = random_nurbs<3>(random, random.chance(50));
    if (!complaint([&] { made = n.curve(); }).empty()) continue;
    const Rational_curve<3>& c = *made;
    const auto same = [](const Rational& u) { return u; };

    const auto back = reversed(c);
    samples.expect(is_well_formed(back) && same_points(c, back, random, [](const Rational& u) { return Rational(-u); }),
                   [&] { return "reversed " + n.shown(); });
    samples.expect(same_joints(back, anew(back)), [&] { return "joints of reversed " + n.shown(); });

    const auto higher = elevated(c, 2);
    samples.expect(is_well_formed(higher) && same_points(c, higher, random, same), [&] { return "elevated " + n.shown(); });
    samples.expect(higher.pieces()[0].degree() == c.pieces()[0].degree() + 2,
                   [&] { return "elevated " + n.shown(); });
    samples.expect(same_joints(higher, c) && same_joints(higher, anew(higher)),
      [&] { return "joints of elevated " + n.shown(); });

    const Rational at = random_parameter(random, c);
    const auto cut = with_inserted_knot(c, at);
    samples.expect(is_well_formed(cut) && same_points(c, cut, random, same) && same_joints(cut, anew(cut)),
                   [&] { return "cut at " + show(at) + ": " + n.shown(); });
    bool is_end = false, found = false;
    for (const Piece& p : c.chain().pieces) is_end = is_end || at == p.lo || at == p.hi;
    for (const Piece& p : cut.chain().pieces) found = found || at == p.lo || at == p.hi;
    samples.expect(found && cut.pieces().size() == c.pieces().size() + (is_end ? 0 : 1), "a cut adds one piece");

    // A Möbius map without a pole on the domain; half of them decrease.
    const Rational lo = c.chain().pieces.front().lo, hi = c.chain().pieces.back().hi;
    const Rational pole = random.chance(50) ? Rational(lo - random.between(1,
      9)) : Rational(hi + Rational(1) / random.between(1, 9));
    Moebius_map map{Rational(random.between(-3, 3)), Rational(random.between(-3, 3)), 1, Rational(-pole)};
    if (random.chance(20)) map = {Rational(random.between(1, 5)) / 2, Rational(random.between(-3, 3)), 0, -3};
    if (map.determinant() == 0) continue;
    const auto moved = reparametrised(c, map);
    samples.expect(is_well_formed(moved) && same_points(c, moved, random, map),
                   [&] { return "moved " + n.shown() + " by " + show(std::vector<Rational>{map.a, map.b, map.c, map.d}); });
    samples.expect(same_joints(moved, anew(moved)), [&] { return "joints of moved " + n.shown(); });
    samples.expect(same_joints(moved, map.determinant() > 0 ? c : back), [&] { return "orders of moved " + n.shown(); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 350);
}

TEST_CASE("the seam of a closed curve goes where it is sent")
{
  const Curve_2 c = bspline_2(3, {{0, 0}, {2, 1}, {3, 3}, {1, 5}, {-1, 3}, {0, 0}, {2, 1}, {3, 3}}, {0, 1, 2, 3, 4, 5, 6, 7,
    8, 9, 10, 11},
                              {1, 2, 1, 1, 3, 1, 2, 1}, true);
  const Curve_2 square = with_join_tolerance(polyline_2({{0, 0}, {1, 0}, {2, "1e-3"}, {0, 1}}, true), Rational(1, 100));
  for (const Curve_2& curve : {c, square, circle_2({0, 0}, 1)}) {
    const std::size_t n = curve.pieces().size();
    const Rational start = curve.chain().pieces.front().lo, length = curve.chain().pieces.back().hi - start;
    for (std::size_t k = 0; k < n; ++k) {
      const Curve_2 turned = with_seam_at(curve, k);
      INFO(show_curve(turned));
      CHECK(is_well_formed(turned));
      const Rational first = curve.chain().pieces[k].lo;
      CHECK(turned.chain().pieces.front().lo == first);
      CHECK(Rational(turned.chain().pieces.back().hi - first) == length);
      for (std::size_t j = 0; j < n; ++j) CHECK(same_joint(turned.chain().joints[j], curve.chain().joints[(j + k) % n]));
      for (int i = 0; i <= 20; ++i) {
        const Rational u = start + Rational(i) / 20 * length;
        CHECK(passes(turned, u < first ? Rational(u + length) : u, points_at(curve, u)[0]));
      }
    }
  }
  CHECK(holds(complaint([&] { with_seam_at(c, 5); }), "no piece 5"));
  CHECK(holds(complaint([] { with_seam_at(polyline_2({{0, 0}, {1, 0}}), 0); }), "open curve"));
  CHECK(with_join_tolerance(square, Rational(1, 100)).chain().joints[0].by_tolerance);
  // Reversal keeps the seam last and the tolerance's mark.
  const Curve_2 back = reversed(square);
  CHECK(back.chain().is_closed());
  CHECK(back.chain().joints[2].by_tolerance);
  CHECK(!back.chain().joints[3].by_tolerance);
  // A Möbius map tells the two sides of the seam apart.
  const Curve_2 moved = reparametrised(c, {1, 0, 1, 10});
  CHECK(c.chain().joints.back().kind == Joint_kind::smooth);
  CHECK(same_joint(moved.chain().joints.back(), {Joint_kind::g1, 0, false}));
  CHECK(joints_are_true(moved));
}

TEST_CASE("edits that cannot be")
{
  const Curve_2 c = polyline_2({{0, 0}, {1, 0}, {2, 1}});
  CHECK(holds(complaint([&] { with_inserted_knot(c, Rational(5, 2)); }), "does not contain 5/2"));
  CHECK(holds(complaint([&] { reparametrised(c, {1, 2, 2, 4}); }), "constant"));
  CHECK(holds(complaint([&] { reparametrised(c, {0, 1, 1, -2}); }), "pole at 2"));
  CHECK(holds(complaint([&] { reparametrised(c, {0, 1, 2, -1}); }), "pole at 1/2"));
  CHECK(with_inserted_knot(c, 1).pieces().size() == 2);
  // A polynomial piece of too high a degree would get a common factor.
  const Curve_2 higher = elevated(polyline_2({{0, 0}, {2, 1}}), 2);
  CHECK(higher.pieces()[0].degree() == 3);
  CHECK(reparametrised(higher, {1, 0, 1, 1}).pieces()[0].degree() == 1);
  std::vector<Curve_piece<2>> pieces = c.pieces();
  std::swap(pieces[0], pieces[1]);
  CHECK(holds(complaint([&] { joined_curve(pieces, c.chain().pieces, false); }), ".pieces[1] | does not start where"));
}
