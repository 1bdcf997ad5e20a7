// SPDX-License-Identifier: LGPL-3.0-or-later
#include "curve_support.h"

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Curve_2;
using locus::Locus;
using locus::Vertex_kind;

// Bisectors of two curves of several pieces: against exact counts of the equation's zeros along lines, made from the control
// points alone; against components counted on a grid; against themselves with the curves written in other ways; and against
// figures whose answer is known.

namespace {

/// Solves a pair and judges the result; cusps at irrational parameters and single points are refused.
void judge(const Control_spline& a, const Control_spline& b, Random& random, int lines, Samples& samples, Tally& tally)
{
  const auto text = [&](const std::string& what) { return what + "; " + show(a) + ", " + show(b); };
  count_refusals(samples, tally, text, [&] {
    const Curve_2 first = a.build(), second = b.build();
    const Control_chain second_chain = cut_like(chain_of(b), second);
    const Locus<2> l = locus::untrimmed_bisector(first, second, limited());
    Result_check check(l, cut_like(chain_of(a), first), &second_chain);
    check.check_all(random, lines);
    tally.add(l);
    tally.lines += check.lines;
    tally.walls += check.walls;
    samples.expect(check.problems.empty(), [&] { return text(check.report()); });
  });
}

const Control_spline& wavy_cubic()
{
  static const Control_spline s =
    spline_of(3,
              {{"0", "0"},
               {"0.5", "1"},
               {"1", "0.25"},
               {"1.5", "1.5"},
               {"2", "0.5"},
               {"2.5", "1"},
               {"3", "0"},
               {"3.5", "1.25"},
               {"4", "0.5"},
               {"4.5", "1.5"},
               {"5", "0.75"}},
              {"0", "0", "0", "0", "1", "2", "3", "4", "5", "6", "7", "8", "8", "8", "8"});
  return s;
}
Control_spline segment(const char* x0, const char* y0, const char* x1, const char* y1)
{
  return spline_of(1, {{x0, y0}, {x1, y1}}, {"0", "0", "1", "1"});
}

/// Components of F3 = 0 on a grid over two chains, in double from the sampled curves; without corners, where F3 jumps.
std::size_t components_on_grid(const Control_chain& a, const Control_chain& b, int n,
                               const std::vector<std::array<double, 2>>& nodes)
{
  const Real_chain first(a), second(b);
  const auto value = [](const Control_chain& c, Real x) {
    return real_of(c.breaks.front()) + x * real_of(Rational(c.breaks.back() - c.breaks.front()));
  };
  const auto at = [&](const Control_chain& c, const Real_chain& r, Real x) { return r.at(value(c, x), value(c, x)); };
  std::vector<Real_curve::Values> rows, columns;
  for (int i = 0; i <= n; ++i) {
    rows.push_back(at(a, first, grid_line(n, i)));
    columns.push_back(at(b, second, grid_line(n, i)));
  }
  const auto positive = [](const Real_curve::Values& c, const Real_curve::Values& d) {
    const Complex e = c.point - d.point;
    return (e * e * std::conj(c.first) * std::conj(d.first)).imag() > 0;
  };
  std::vector<std::array<double, 2>> places;
  for (const auto& node : nodes) {
    const auto local = [](const Control_chain& c, double u) {
      return (u - c.breaks.front().get_d()) / Rational(c.breaks.back() - c.breaks.front()).get_d();
    };
    places.push_back({local(a, node[0]), local(b, node[1])});
  }
  return grid_components(
    n, [&](std::size_t i, std::size_t j) { return positive(rows[i], columns[j]); },
    [&](Real t, Real r) { return positive(at(a, first, t), at(b, second, r)); }, places);
}

std::vector<std::array<double, 2>> places_of(const Locus<2>& l, Vertex_kind kind)
{
  std::vector<std::array<double, 2>> places;
  for (const auto& v : l.vertices())
    if (v.kind == kind) places.push_back({v.feet[0].parameters[0].lo, v.feet[1].parameters[0].lo});
  return places;
}

} // namespace

// ---------------------------------------------------------------------------------------------------- known answers

TEST_CASE("a wavy cubic spline over a line", "[spline_bisector]")
{
  const Control_spline a = wavy_cubic(), b = segment("0", "-1", "5", "-1.5");
  const Locus<2> l = locus::untrimmed_bisector(a.build(), b.build());
  INFO(show(graph_numbers(l)) << reasons(l));
  CHECK(is_certified(l));
  CHECK(l.components() == 2u);
  CHECK(l.degenerate().empty());
  const Control_chain line = chain_of(b);
  Result_check check(l, chain_of(a), &line);
  Random random(601);
  check.check_all(random, 60);
  CHECK(check.report() == "");
  CHECK(check.lines == 60u);
  CHECK(check.walls == 4u);
  CHECK(components_on_grid(chain_of(a), line, 500, {}) == 2u);
}

TEST_CASE("segment and circle, whole", "[spline_bisector]")
{
  // A line outside a circle: a parabola on either side of it, each of feet all along the segment.
  const Locus<2> l = locus::untrimmed_bisector(locus::circle_2({0, 0}, 1), locus::segment_2({-3, -2}, {3, -2}));
  INFO(show(graph_numbers(l)) << reasons(l));
  CHECK(is_certified(l));
  CHECK(l.components() == 2u);
  CHECK(count(l, Vertex_kind::boundary) == 4u);
  Samples samples;
  for (const auto& arc : l.arcs())
    for (const auto& q : arc.samples(100)) {
      // |q| ± 1 is the distance from the line y = -2: x² = (y+2∓1)² - y².
      const double x = q.point()[0], y = q.point()[1], size = 1 + x * x + y * y;
      const double outside = x * x + y * y - (y + 3) * (y + 3), inside = x * x + y * y - (y + 1) * (y + 1);
      samples.expect(std::min(std::abs(outside), std::abs(inside)) < 1e-8 * size, "on one of the parabolas");
    }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("circle against circle", "[spline_bisector]")
{
  { // nested, not concentric: two ellipses with the centres as foci
    const Locus<2> l = locus::untrimmed_bisector(locus::circle_2({0, 0}, 4), locus::circle_2({1, "1/2"}, 1));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(graph_numbers(l).closed == 2u);
    CHECK(l.arcs().size() == 2u);
    Samples samples;
    for (const auto& arc : l.arcs())
      for (const auto& q : arc.samples(100)) {
        const double sum = std::hypot(q.point()[0], q.point()[1]) + std::hypot(q.point()[0] - 1, q.point()[1] - 0.5);
        samples.expect(std::min(std::abs(sum - 5), std::abs(sum - 3)) < 1e-9,
                       "the sum of distances from the centres is 4 ± 1");
      }
    LOCUS_REQUIRE_SAMPLES(samples, 200);
  }
  { // apart: the four common tangents are the poles of two hyperbolas
    const Locus<2> l = locus::untrimmed_bisector(locus::circle_2({0, 0}, 1), locus::circle_2({5, 1}, 2));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(count(l, Vertex_kind::infinity) == 4u);
    CHECK(l.arcs().size() == 4u);
    CHECK(l.components() == 2u);
    Samples samples;
    for (const auto& arc : l.arcs())
      for (const auto& q : arc.samples(50)) {
        if (q.radius() > 1e3) continue;
        const double difference =
          std::abs(std::hypot(q.point()[0], q.point()[1]) - std::hypot(q.point()[0] - 5, q.point()[1] - 1));
        samples.expect(std::min(std::abs(difference - 1), std::abs(difference - 3)) < 1e-7,
                       "the distances differ by 2 ∓ 1");
      }
    LOCUS_REQUIRE_SAMPLES(samples, 150);
  }
  { // the same circle twice, also the other way round or from another start
    const Curve_2 c = locus::circle_2({1, 2}, 3);
    for (const Curve_2& other :
         {c, locus::ellipse_2({1, 2}, {0, 3}, {-3, 0}), locus::ellipse_2({1, 2}, {3, 0}, {0, -3})}) {
      const Locus<2> l = locus::untrimmed_bisector(c, other);
      INFO(show(graph_numbers(l)) << reasons(l));
      CHECK(is_certified(l));
      CHECK(l.arcs().empty());
      CHECK(l.degenerate().size() == 16u);
    }
  }
  { // concentric: F3 vanishes where both feet lie on one line through the centre
    const Locus<2> l = locus::untrimmed_bisector(locus::circle_2({0, 0}, 1), locus::circle_2({0, 0}, 3));
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(graph_numbers(l).closed == 2u);
    for (const auto& arc : l.arcs())
      for (const auto& q : arc.samples(20)) CHECK(std::min(std::abs(q.radius() - 1), std::abs(q.radius() - 2)) < 1e-9);
  }
}

TEST_CASE("ellipses, nested and apart, wherever their seams are", "[spline_bisector]")
{
  const auto around = [](int quarter) { // the seam at each vertex, in both senses
    const locus::Coordinates_2 c{"1/8", 0};
    switch (quarter) {
    case 0:
      return locus::ellipse_2(c, {"3/2", 0}, {0, 1});
    case 1:
      return locus::ellipse_2(c, {0, 1}, {"-3/2", 0});
    case 2:
      return locus::ellipse_2(c, {"-3/2", 0}, {0, 1});
    case 3:
      return locus::ellipse_2(c, {"9/10", "4/5"}, {"-6/5", "3/5"}); // p·4/5 and q·3/5 turned by an angle
    default:
      return locus::ellipse_2(c, {"3/2", 0}, {0, -1});
    }
  };
  std::optional<Graph_numbers> nested, apart;
  for (int quarter = 0; quarter < 5; ++quarter) {
    const Locus<2> in = locus::untrimmed_bisector(locus::ellipse_2({0, 0}, 4, 3), around(quarter));
    const Locus<2> out = locus::untrimmed_bisector(locus::ellipse_2({7, 2}, 4, 3), around(quarter));
    INFO("seam " << quarter << ": " << show(graph_numbers(in)) << " | " << show(graph_numbers(out)) << reasons(in)
                 << reasons(out));
    CHECK(is_certified(in));
    CHECK(is_certified(out));
    CHECK(graph_numbers(in).closed >= 1u);
    CHECK(count(in, Vertex_kind::boundary) + count(out, Vertex_kind::boundary) == 0u);
    CHECK(count(in, Vertex_kind::infinity) == 0u);
    CHECK(count(out, Vertex_kind::infinity) == 4u); // the common tangents of two convex curves apart
    if (quarter == 0) {
      nested = graph_numbers(in);
      apart = graph_numbers(out);
    }
    CHECK(graph_numbers(in) == *nested);
    CHECK(graph_numbers(out) == *apart);
  }
}

TEST_CASE("polylines and curves: arcs break off at corners", "[spline_bisector]")
{
  const Curve_2 square = locus::polyline_2({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, true);
  const Locus<2> l = locus::untrimmed_bisector(square, locus::circle_2({0, 0}, 1));
  INFO(show(graph_numbers(l)) << reasons(l));
  CHECK(is_certified(l));
  CHECK(count(l, Vertex_kind::corner) == l.vertices().size());
  CHECK(l.arcs().size() == 8u); // with the near and with the far side of the circle, for each side of the square
  CHECK(count(l, Vertex_kind::corner) == 16u);
  for (const auto& v : l.vertices()) {
    CHECK(v.feet[0].feature == locus::Feature::corner);
    CHECK(v.feet[1].feature == locus::Feature::interior);
    CHECK((v.feet[0].parameters[0].lo == std::floor(v.feet[0].parameters[0].lo) &&
           v.feet[0].parameters[0].lo == v.feet[0].parameters[0].hi));
  }
}

// ------------------------------------------------------------------------------------------------- exact counts

TEST_CASE("random splines: zeros along lines, ends, corners, samples", "[spline_bisector]")
{
  Random random(602);
  Samples samples;
  Tally tally;
  for (int k = 0; k < 260; ++k) {
    const Coordinates kind = k % 5 < 2 ? Coordinates::grid : k % 5 < 4 ? Coordinates::dyadic : Coordinates::fractions;
    const Control_spline a = some_spline(random, 3, 4, kind), b = some_spline(random, 3, 3, kind);
    judge(a, b, random, 3, samples, tally);
  }
  INFO(tally.text());
  CHECK(tally.lines > 400u);
  CHECK(tally.walls > 400u);
  CHECK(tally.certified > 8 * tally.undecided);
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("random splines of degree four with many spans", "[spline_bisector]")
{
  Random random(603);
  Samples samples;
  Tally tally;
  for (int k = 0; k < 12; ++k) {
    const Control_spline a = random_spline(random, 4, 6, Coordinates::dyadic, k % 4 == 0,
                                           k % 3 == 0 ? Ends::periodic : Ends::open, k % 2 == 0);
    const Control_spline b =
      random_spline(random, random.between(1, 4), 5, Coordinates::dyadic, false, Ends::open, true);
    judge(a, b, random, 3, samples, tally);
  }
  INFO(tally.text());
  CHECK(tally.lines >= 30u);
  LOCUS_REQUIRE_SAMPLES(samples, 10);
}

TEST_CASE("components against a grid of signs", "[spline_bisector]")
{
  // Open curves without corners. A grid is believed where two of them agree.
  Random random(604);
  Samples samples;
  for (int k = 0; k < 40; ++k) {
    const int degree = random.between(2, 3), spans = random.between(2, 4), other_degree = random.between(1, 3);
    const Control_spline a = random_spline(random, degree, spans, Coordinates::dyadic, k % 4 == 0, Ends::open, false);
    const Control_spline b = random_spline(random, other_degree, 1, Coordinates::dyadic, false, Ends::open, false);
    const Control_chain first = chain_of(a), second = chain_of(b);
    const Locus<2> l = locus::untrimmed_bisector(a.build(), b.build(), limited());
    if (!is_certified(l)) continue;
    const auto nodes = places_of(l, Vertex_kind::node);
    const std::size_t coarse = components_on_grid(first, second, 250, nodes),
                      fine = components_on_grid(first, second, 430, nodes);
    if (coarse != fine) continue;
    samples.expect(l.components() == fine || agrees_with_exact_counts(l, first, &second), [&] {
      return std::to_string(fine) + " on the grid: " + show(graph_numbers(l)) + "; " + show(a) + ", " + show(b);
    });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 28);
}

// -------------------------------------------------------------------------------------------- written in another way

TEST_CASE("the same bisector however its splines are written", "[spline_bisector]")
{
  Random random(605);
  Samples graphs, failures;
  std::size_t certified = 0, of_other_status = 0;
  for (int k = 0; k < 250; ++k) {
    const Coordinates kind = k % 2 ? Coordinates::dyadic : Coordinates::grid;
    const Control_spline a = some_spline(random, 3, 3, kind), b = some_spline(random, 3, 2, kind);
    const Control_chain first = chain_of(a), second = chain_of(b);
    std::optional<Locus<2>> home;
    try {
      home.emplace(locus::untrimmed_bisector(a.build(), b.build(), limited()));
    } catch (const locus::Invalid_input&) { // a single point
      continue;
    } catch (const locus::Unsupported_feature&) { // a cusp at an irrational parameter
      continue;
    }
    if (!is_certified(*home)) continue;
    ++certified;
    for (int g = 0; g < 2; ++g) {
      Chain_guise c = random_guise(random, first), d = random_guise(random, second);
      if (g == 1) {
        const Similarity& s =
          similarities()[static_cast<std::size_t>(random.below(static_cast<int>(similarities().size())))];
        c.chain = moved(c.chain, s.matrix, s.shift);
        d.chain = moved(d.chain, s.matrix, s.shift);
        c.name += std::string(", ") + s.name;
      }
      const auto text = [&](const std::string& what) {
        return c.name + "; " + d.name + ": " + show(graph_numbers(*home)) + " | " + what + "; " + show(a) + ", " +
               show(b);
      };
      try {
        const Locus<2> there = locus::untrimmed_bisector(c.build(), d.build(), limited());
        if (!is_certified(there)) {
          ++of_other_status;
          continue;
        }
        const Graph_numbers here = without_pieces(graph_numbers(*home)), numbers = without_pieces(graph_numbers(there));
        std::array<double, 2> periods{};
        if (a.closed) periods[0] = Rational(c.chain.breaks.back() - c.chain.breaks.front()).get_d();
        if (b.closed) periods[1] = Rational(d.chain.breaks.back() - d.chain.breaks.front()).get_d();
        const std::string lost = lost_vertex(*home, there, c.parameter, d.parameter, periods, false);
        graphs.expect(here == numbers && lost.empty(), [&] { return text(show(numbers) + " " + lost); });
      } catch (const std::exception& e) {
        const std::string what = e.what();
        failures.expect(false, [&] { return text(what); });
      }
    }
  }
  INFO(certified << " certified, " << of_other_status << " guises undecided");
  CHECK(certified > 200u);
  CHECK(50 * of_other_status <= 2 * certified); // a factor found only where both curves are written alike
  LOCUS_REQUIRE_SAMPLES(graphs, 400);
  LOCUS_REQUIRE_SAMPLES(failures, 0);
}

// ------------------------------------------------------------------------------------------------- special positions

TEST_CASE("crossings exactly on knots", "[spline_bisector]")
{
  Random random(606);
  Samples samples;
  Tally tally;
  // Two smooth splines through the origin at a knot of one or of both, in different directions.
  for (int k = 0; k < 30; ++k) {
    const auto through_origin = [&](bool at_knot) {
      Control_spline s = random_spline(random, 2, 3, Coordinates::grid, false, Ends::open, false);
      s.knots = {0, 0, 0, 1, 2, 3, 3, 3};
      // At the knot 1 the point is the mean of control points 1 and 2; at 3/2 it is (1, 6, 1)/8 of 1, 2 and 3.
      const std::size_t last = at_knot ? 2 : 3;
      for (std::size_t v = 0; v < 2; ++v)
        s.points[last][v] = at_knot ? Rational(-s.points[1][v]) : Rational(-s.points[1][v] - 6 * s.points[2][v]);
      return s;
    };
    const bool both = k % 2 == 0;
    const Control_spline a = through_origin(true), b = through_origin(both);
    judge(a, b, random, 3, samples, tally);
  }
  INFO(tally.text());
  CHECK(tally.certified > 18u);
  LOCUS_REQUIRE_SAMPLES(samples, 25);
}

TEST_CASE("curves that touch at a knot of both", "[spline_bisector]")
{
  // Both pass through the origin along the x axis; branches of different limits meet there, and nothing ends.
  const Locus<2> l =
    locus::untrimmed_bisector(locus::bspline_2(2, {{-2, 1}, {-1, 0}, {1, 0}, {2, 1}}, {0, 0, 0, 1, 2, 2, 2}),
                              locus::bspline_2(2, {{-2, -1}, {-1, 0}, {1, 0}, {3, -2}}, {0, 0, 0, 1, 2, 2, 2}));
  INFO(show(graph_numbers(l)) << reasons(l));
  CHECK(is_certified(l));
  CHECK(count(l, Vertex_kind::boundary) == 6u);
  CHECK(l.arcs().size() == 6u);
  std::size_t here = 0;
  for (const auto& v : l.vertices())
    here += v.feet[0].parameters[0].lo == 1 && v.feet[1].parameters[0].lo == 1 && v.kind == Vertex_kind::node;
  CHECK(here == 1u);
}

TEST_CASE("mirror images and their perturbations", "[spline_bisector]")
{
  // Exact mirror images have their axis; a perturbation by 2^-30 or 2^-45 parts it from the rest without any harm.
  Random random(607);
  Samples samples;
  Tally tally;
  for (int k = 0; k < 24; ++k) {
    const Control_spline a = random_spline(random, random.between(1, 3), random.between(1, 3), Coordinates::dyadic,
                                           k % 4 == 3, Ends::open, k % 2 == 0);
    Control_spline b = a;
    for (Exact_pair& p : b.points) p[1] = -p[1] - Rational(9, 2);
    if (k % 3 != 0) b.points[0][0] += two_to(k % 3 == 1 ? -30 : -45);
    judge(a, b, random, 3, samples, tally);
  }
  INFO(tally.text());
  CHECK(tally.certified > 20u);
  LOCUS_REQUIRE_SAMPLES(samples, 22);
}

TEST_CASE("straight spans, doubled end points, joints with a jump of speed", "[spline_bisector]")
{
  Random random(608);
  Samples samples;
  Tally tally;
  // A quadratic whose middle span is straight, and ends where the curve stands still.
  const Control_spline straight = spline_of(2, {{"-2", "1"}, {"-1", "0"}, {"0", "0"}, {"1", "0"}, {"2", "2"}},
                                            {"0", "0", "0", "1", "2", "3", "3", "3"});
  const Control_spline doubled =
    spline_of(3, {{"-2", "-2"}, {"-2", "-2"}, {"0", "-1"}, {"1", "-3"}, {"2", "-2"}, {"2", "-2"}},
              {"0", "0", "0", "0", "1", "2", "3", "3", "3", "3"});
  // One tangent direction at the double knot, lengths 1 : 2, and curvatures that differ.
  const Control_spline jumping = spline_of(2, {{"-2", "-3"}, {"-1", "-5"}, {"0", "-5"}, {"2", "-5"}, {"3", "-3"}},
                                           {"0", "0", "0", "1", "1", "2", "2", "2"});
  for (const Control_spline* a : {&straight, &doubled, &jumping})
    for (const Control_spline* b : {&straight, &doubled, &jumping, &wavy_cubic()})
      if (a != b) judge(*a, *b, random, 5, samples, tally);
  INFO(tally.text());
  CHECK(tally.certified == 9u);
  LOCUS_REQUIRE_SAMPLES(samples, 9);
  // The joint with a jump of speed is no corner.
  const Locus<2> l = locus::untrimmed_bisector(jumping.build(), segment("-2", "-7", "3", "-7.5").build());
  INFO(show(graph_numbers(l)) << reasons(l));
  CHECK(is_certified(l));
  CHECK(count(l, Vertex_kind::corner) == 0u);
}
