// SPDX-License-Identifier: LGPL-3.0-or-later
#include "curve_support.h"

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Curve_2;
using locus::Locus;
using locus::Vertex_kind;

// Bisectors of a curve with itself: against exact counts of the equation's zeros along lines, next to the diagonal too, made
// from the control points alone; against components counted on a grid; against themselves with the curve written in other
// ways; and against figures whose answer is known.

namespace {

void judge(const Control_spline& a, Random& random, int lines, Samples& samples, Tally& tally)
{
  const auto text = [&](const std::string& what) { return what + "; " + show(a); };
  count_refusals(samples, tally, text, [&] {
    const Curve_2 curve = a.build();
    const Locus<2> l = locus::untrimmed_bisector(curve, limited());
    Result_check check(l, cut_like(chain_of(a), curve), nullptr);
    check.check_all(random, lines);
    tally.add(l);
    tally.lines += check.lines;
    tally.walls += check.walls;
    tally.diagonals += check.diagonals;
    samples.expect(check.problems.empty(), [&] { return text(show(graph_numbers(l)) + " | " + check.report()); });
  });
}

const Control_spline& zigzag_quadratic()
{
  static const Control_spline s =
    spline_of(2, {{"0", "0"}, {"1", "2"}, {"2", "-1"}, {"3", "1.5"}, {"4", "-0.5"}, {"5", "2"}, {"6", "0"}},
              {"0", "0", "0", "1", "2", "3", "4", "5", "5", "5"});
  return s;
}
const Control_spline& curled_cubic()
{
  static const Control_spline s =
    spline_of(3, {{"0", "0"}, {"0.5", "2"}, {"2", "2.5"}, {"3", "0.5"}, {"1.5", "-1"}, {"4", "-1.5"}, {"5", "1"}},
              {"0", "0", "0", "0", "1", "2", "3", "4", "4", "4", "4"});
  return s;
}

/// Components of F3 = 0 on a grid over the chain's square, on both sides of the diagonal.
std::size_t components_on_grid(const Control_chain& chain, int n, const std::vector<std::array<double, 2>>& nodes)
{
  const Real_chain curve(chain);
  const Real lo = real_of(chain.breaks.front()), length = real_of(Rational(chain.breaks.back() - chain.breaks.front()));
  const auto at = [&](Real x) { return curve.at(lo + x * length, lo + x * length); };
  std::vector<Real_curve::Values> values;
  for (int i = 0; i <= n; ++i) values.push_back(at(grid_line(n, i)));
  const auto positive = [](const Real_curve::Values& c, const Real_curve::Values& d) {
    const Complex e = c.point - d.point;
    return (e * e * std::conj(c.first) * std::conj(d.first)).imag() > 0;
  };
  // F3(r,t) = F3(t,r), and next to the diagonal F3 is (t-r)^4 times a function with zeros where arcs meet their images.
  std::vector<std::array<double, 2>> places;
  for (const auto& node : nodes)
    for (const auto& [t, r] : {std::pair(node[0], node[1]), std::pair(node[1], node[0])})
      places.push_back({static_cast<double>((t - lo) / length), static_cast<double>((r - lo) / length)});
  return grid_components(
    n,
    [&](std::size_t i, std::size_t j) {
      // On the diagonal itself F3 vanishes: the sign next to it.
      return i != j ? positive(values[i], values[j]) : positive(values[i], i > 0 ? values[i - 1] : values[i + 1]);
    },
    [&](Real t, Real r) { return positive(at(t), at(t == r ? r + Real(0.5) / static_cast<Real>(n) : r)); }, places);
}

} // namespace

// ---------------------------------------------------------------------------------------------------- known answers

TEST_CASE("two open splines with themselves", "[self_bisector]")
{
  Random random(701);
  for (const auto& [spline, components] :
       {std::pair(&zigzag_quadratic(), std::size_t(7)), std::pair(&curled_cubic(), std::size_t(3))}) {
    const Locus<2> l = locus::untrimmed_bisector(spline->build());
    INFO(show(*spline) << ": " << show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(l.components() == components);
    CHECK(l.degenerate().empty());
    Result_check check(l, chain_of(*spline), nullptr);
    check.check_all(random, 60);
    CHECK(check.report() == "");
    CHECK(check.lines == 60u);
    CHECK(check.walls == (spline == &zigzag_quadratic() ? 0u : 2u)); // the ends of the quadratic are a pair of feet
    CHECK(check.diagonals == 1u);
    for (const auto& v : l.vertices()) {
      CHECK(v.feet[0].input == 0u);
      CHECK(v.feet[1].input == 0u);
      CHECK(v.feet[0].parameters[0].hi >= v.feet[1].parameters[0].lo);
    }
    for (const auto& arc : l.arcs()) CHECK(arc.inputs() == std::vector<std::size_t>{0, 0});
  }
  // One arc of the cubic ends at its knot 2, where the derivative of the curvature changes its sign.
  const Locus<2> l = locus::untrimmed_bisector(curled_cubic().build());
  std::size_t at_knot = 0;
  for (const auto& v : l.vertices())
    at_knot += v.kind == Vertex_kind::diagonal && v.feet[0].parameters[0].lo == 2 && v.feet[0].parameters[0].hi == 2;
  CHECK(at_knot == 1u);
}

TEST_CASE("an ellipse with itself: its two axes, from evolute cusp to cusp", "[self_bisector]")
{
  const Rational a = 3, b = Rational(3, 2);
  for (int seam = 0; seam < 6; ++seam) {
    const auto conjugate =
      [&]() -> std::array<locus::Coordinates_2, 2> { // a pair of half diameters of x²/9 + 4y²/9 = 1
      switch (seam) {
      case 0:
        return {{{3, 0}, {0, "3/2"}}};
      case 1:
        return {{{0, "3/2"}, {-3, 0}}};
      case 2:
        return {{{-3, 0}, {0, "3/2"}}};
      case 3:
        return {{{"9/5", "6/5"}, {"-12/5", "9/10"}}};
      case 4:
        return {{{"-36/13", "15/26"}, {"15/13", "18/13"}}};
      default:
        return {{{"9/5", "-6/5"}, {"-12/5", "-9/10"}}};
      }
    }();
    const Locus<2> l = locus::untrimmed_bisector(locus::ellipse_2({0, 0}, conjugate[0], conjugate[1]));
    INFO("seam " << seam << ": " << show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(l.arcs().size() == 2u);
    CHECK(l.components() == 2u);
    REQUIRE(l.vertices().size() == 4u);
    CHECK(count(l, Vertex_kind::diagonal) == 4u);
    // The ends are the centres of curvature at the ellipse's vertices: (±(a² - b²)/a, 0), (0, ±(a² - b²)/b).
    const double x = Rational((a * a - b * b) / a).get_d(), y = Rational((a * a - b * b) / b).get_d();
    for (const auto& v : l.vertices()) {
      REQUIRE(v.point.has_value());
      const double px = std::abs((*v.point)[0]), py = std::abs((*v.point)[1]);
      const bool is_cusp = std::hypot(px - x, py) < 1e-9 || std::hypot(px, py - y) < 1e-9;
      CHECK(is_cusp);
      CHECK((std::abs(v.radius - 0.75) < 1e-9 || std::abs(v.radius - 6) < 1e-9));
    }
    Samples samples;
    bool across = false, along = false;
    for (const auto& arc : l.arcs()) {
      double widest = 0, highest = 0;
      for (const auto& q : arc.samples(101)) {
        samples.expect(std::min(std::abs(q.point()[0]), std::abs(q.point()[1])) < 1e-9, "on an axis");
        widest = std::max(widest, std::abs(q.point()[0]));
        highest = std::max(highest, std::abs(q.point()[1]));
      }
      along = along || (widest > 2.2 && highest < 1e-9);
      across = across || (highest > 4.4 && widest < 1e-9);
    }
    CHECK((along && across));
    LOCUS_REQUIRE_SAMPLES(samples, 202);
  }
}

TEST_CASE("circles and lines with themselves are degenerate all over", "[self_bisector]")
{
  for (const Curve_2& c :
       {locus::circle_2({1, "1/3"}, 2), locus::segment_2({0, 0}, {1, 2}), locus::line_2({0, 1}, {1, 1}),
        locus::arc_2({0, 0}, {1, 0}, 1), locus::bspline_2(1, {{0, 0}, {1, 1}, {3, 3}}, {0, 0, 1, 2, 2})}) {
    const Locus<2> l = locus::untrimmed_bisector(c);
    INFO(show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    CHECK(l.arcs().empty());
    CHECK(l.vertices().empty());
    const std::size_t n = c.pieces().size();
    CHECK(l.degenerate().size() == n * (n + 1) / 2);
    for (const auto& d : l.degenerate()) CHECK(d.kind == "everything");
  }
}

TEST_CASE("the angle bisectors of a polyline start at its corners", "[self_bisector]")
{
  const Locus<2> l = locus::untrimmed_bisector(locus::polyline_2({{0, 0}, {4, 0}, {4, 3}}));
  INFO(show(graph_numbers(l)) << reasons(l));
  CHECK(is_certified(l));
  CHECK(l.components() == 1u);
  REQUIRE(l.arcs().size() == 1u);
  Samples samples;
  for (const auto& q : l.arcs()[0].samples(30))
    samples.expect(std::abs(4 - q.point()[0] - q.point()[1]) < 1e-6, "on the angle bisector");
  LOCUS_REQUIRE_SAMPLES(samples, 30);
  // From the corner (4,0), with both feet there, to where a foot reaches the end (4,3).
  CHECK(count(l, Vertex_kind::corner) == 1u);
  CHECK(count(l, Vertex_kind::boundary) == 1u);

  // A triangle: each pair of sides has the bisectors of its inner angle; those of the outer ones lie beyond the sides.
  const Locus<2> triangle = locus::untrimmed_bisector(locus::polyline_2({{0, 0}, {4, 0}, {0, 3}}, true));
  INFO(show(graph_numbers(triangle)) << reasons(triangle));
  CHECK(is_certified(triangle));
  CHECK(triangle.arcs().size() == 3u);
  CHECK(count(triangle, Vertex_kind::corner) == 6u);
  std::size_t degenerate = 0;
  for (const auto& d : triangle.degenerate()) degenerate += d.kind == "everything";
  CHECK(degenerate == 3u); // each side with itself
}

// ------------------------------------------------------------------------------------------------- exact counts

TEST_CASE("random splines with themselves: zeros along lines, next to the diagonal, at ends and corners",
          "[self_bisector]")
{
  Random random(702);
  Samples samples;
  Tally tally;
  for (int k = 0; k < 180; ++k) {
    const Coordinates kind = k % 20 > 0 ? Coordinates::dyadic : Coordinates::fractions;
    judge(some_spline(random, 3, 4, kind), random, 3, samples, tally);
  }
  INFO(tally.text());
  CHECK(tally.lines > 250u);
  CHECK(tally.walls > 80u);
  CHECK(tally.diagonals > 70u);
  CHECK(tally.certified > 8 * tally.undecided);
  LOCUS_REQUIRE_SAMPLES(samples, 160);
}

TEST_CASE("closed periodic cubics with themselves", "[self_bisector]")
{
  Random random(703);
  Samples samples;
  Tally tally;
  for (int k = 0; k < 8; ++k)
    judge(random_spline(random, 3, random.between(4, 7), Coordinates::dyadic, k % 4 == 0, Ends::periodic, false),
          random, 4, samples, tally);
  INFO(tally.text());
  CHECK(tally.certified > 6u);
  CHECK(tally.diagonals > 6u);
  LOCUS_REQUIRE_SAMPLES(samples, 8);
}

TEST_CASE("components of a self-bisector against a grid of signs", "[self_bisector]")
{
  // The grid has each arc twice, mirrored in the diagonal; an arc that ends on the diagonal is one with its image.
  Random random(704);
  Samples samples;
  for (int k = 0; k < 40; ++k) {
    const int degree = random.between(2, 3), spans = random.between(2, 4);
    const Control_spline a = random_spline(random, degree, spans, Coordinates::dyadic, k % 4 == 0, Ends::open, false);
    const Control_chain chain = chain_of(a);
    const Locus<2> l = locus::untrimmed_bisector(a.build(), limited());
    if (!is_certified(l)) continue;
    std::vector<std::array<double, 2>> nodes;
    std::vector<std::size_t> parent(l.vertices().size());
    for (std::size_t v = 0; v < parent.size(); ++v) {
      parent[v] = v;
      if (l.vertices()[v].kind == Vertex_kind::node)
        nodes.push_back({l.vertices()[v].feet[0].parameters[0].lo, l.vertices()[v].feet[1].parameters[0].lo});
    }
    // Components that do not reach the diagonal count twice.
    const auto find = [&](std::size_t v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    std::size_t closed = 0;
    for (const auto& arc : l.arcs()) {
      if (arc.is_closed()) ++closed;
      else parent[find(*arc.source())] = find(*arc.target());
    }
    // On a joint an arc leaves the diagonal along an axis, too close to its image for a grid.
    const bool at_joint = std::any_of(l.vertices().begin(), l.vertices().end(), [](const auto& v) {
      return v.kind == Vertex_kind::diagonal && v.feet[0].parameters[0].lo == std::floor(v.feet[0].parameters[0].lo);
    });
    if (at_joint) continue;
    std::vector<char> on_diagonal(parent.size(), 0);
    for (std::size_t v = 0; v < parent.size(); ++v)
      if (l.vertices()[v].kind == Vertex_kind::diagonal) on_diagonal[find(v)] = 1;
    std::size_t expected = 2 * closed;
    for (std::size_t v = 0; v < parent.size(); ++v)
      if (find(v) == v) expected += on_diagonal[v] ? 1 : 2;
    const std::size_t coarse = components_on_grid(chain, 300, nodes), fine = components_on_grid(chain, 460, nodes);
    if (coarse != fine) continue;
    samples.expect(expected == fine || agrees_with_exact_counts(l, chain, nullptr), [&] {
      return std::to_string(fine) + " on the grid, not " + std::to_string(expected) + ": " + show(graph_numbers(l)) +
             "; " + show(a);
    });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 8);
}

// -------------------------------------------------------------------------------------------- written in another way

TEST_CASE("the same self-bisector however the spline is written", "[self_bisector]")
{
  Random random(705);
  Samples graphs, failures;
  std::size_t certified = 0, of_other_status = 0;
  for (int k = 0; k < 250; ++k) {
    const Coordinates kind = k % 4 ? Coordinates::dyadic : Coordinates::grid;
    const Control_spline a = some_spline(random, 3, 3, kind);
    const Control_chain chain = chain_of(a);
    std::optional<Locus<2>> home;
    try {
      home.emplace(locus::untrimmed_bisector(a.build(), limited()));
    } catch (const locus::Invalid_input&) { // a single point
      continue;
    } catch (const locus::Unsupported_feature&) { // a cusp at an irrational parameter
      continue;
    }
    if (!is_certified(*home)) continue;
    ++certified;
    for (int g = 0; g < 2; ++g) {
      Chain_guise c = random_guise(random, chain);
      if (g == 1) {
        const Similarity& s =
          similarities()[static_cast<std::size_t>(random.below(static_cast<int>(similarities().size())))];
        c.chain = moved(c.chain, s.matrix, s.shift);
        c.name += std::string(", ") + s.name;
      }
      const auto text = [&](const std::string& what) {
        return c.name + ": " + show(graph_numbers(*home)) + " | " + what + "; " + show(a);
      };
      try {
        const Locus<2> there = locus::untrimmed_bisector(c.build(), limited());
        if (!is_certified(there)) {
          ++of_other_status;
          continue;
        }
        const Graph_numbers here = without_pieces(graph_numbers(*home)), numbers = without_pieces(graph_numbers(there));
        const double period = a.closed ? Rational(c.chain.breaks.back() - c.chain.breaks.front()).get_d() : 0;
        const std::string lost = lost_vertex(*home, there, c.parameter, c.parameter, {period, period}, true);
        graphs.expect(here == numbers && lost.empty(), [&] { return text(show(numbers) + " " + lost); });
      } catch (const std::exception& e) {
        const std::string what = e.what();
        failures.expect(false, [&] { return text(what); });
      }
    }
  }
  INFO(certified << " certified, " << of_other_status << " guises undecided");
  CHECK(certified > 200u);
  CHECK(20 * of_other_status <= certified); // an axis of symmetry is found only where the knots lie symmetrically
  LOCUS_REQUIRE_SAMPLES(graphs, 400);
  LOCUS_REQUIRE_SAMPLES(failures, 0);
}

TEST_CASE("inserted knots change nothing", "[self_bisector]")
{
  Random random(706);
  for (const Control_spline* spline : {&zigzag_quadratic(), &curled_cubic()}) {
    const Graph_numbers numbers = graph_numbers(locus::untrimmed_bisector(spline->build()));
    const Control_chain chain = chain_of(*spline);
    for (int k = 0; k < 8; ++k) {
      Control_chain cut = chain;
      for (int i = 0; i <= k % 3; ++i)
        cut = with_cut_at(cut, Rational(chain.breaks.back() * random.between(1, 4095) / 4096));
      const Locus<2> there = locus::untrimmed_bisector(spline_of(cut).build());
      INFO(show(spline_of(cut)));
      CHECK(show(graph_numbers(there)) == show(numbers));
    }
  }
}

// ------------------------------------------------------------------------------------------------- special positions

TEST_CASE("knots at curvature extrema", "[self_bisector]")
{
  // The parabola (u, u²) from -1 to 2 has its vertex at u = 0: one arc along its axis, cut there or elsewhere.
  const Control_spline parabola =
    spline_of(2, {{"-1", "1"}, {"1/2", "-2"}, {"2", "4"}}, {"-1", "-1", "-1", "2", "2", "2"});
  std::vector<std::vector<Rational>> all_cuts{
    {}, {0}, {0, 1}, {Rational(-1, 2), 0, Rational(1, 2)}, {Rational(1, 3)}, {two_to(-30)}, {Rational(-two_to(-20))}};
  for (const auto& cuts : all_cuts) {
    Control_chain chain = chain_of(parabola);
    for (const Rational& u : cuts) chain = with_cut_at(chain, u);
    const Locus<2> l = locus::untrimmed_bisector(chain.build());
    INFO(show(cuts) << ": " << show(graph_numbers(l)) << reasons(l));
    CHECK(is_certified(l));
    REQUIRE(l.arcs().size() == 1u);
    REQUIRE(l.vertices().size() == 2u);
    for (const auto& v : l.vertices()) {
      REQUIRE(v.point.has_value());
      CHECK(std::abs((*v.point)[0]) < 1e-9);
      if (v.kind == Vertex_kind::diagonal) {
        CHECK(std::abs((*v.point)[1] - 0.5) < 1e-9);
      } else {
        CHECK(v.kind == Vertex_kind::boundary);
        CHECK(std::abs(v.feet[0].parameters[0].lo - 1) < 1e-12);
        CHECK(v.feet[1].parameters[0].lo == -1);
        CHECK(std::abs((*v.point)[1] - 1.5) < 1e-9);
      }
    }
    Samples samples;
    for (const auto& q : l.arcs()[0].samples(40)) samples.expect(std::abs(q.point()[0]) < 1e-6, "on the axis");
    LOCUS_REQUIRE_SAMPLES(samples, 40);
  }
}

TEST_CASE("joints where the curvature jumps or the speed does", "[self_bisector]")
{
  Random random(707);
  Samples samples;
  Tally tally;
  // Quadratics have jumps of curvature at single knots; with a double knot and a jump of speed the joint is g1.
  for (int k = 0; k < 30; ++k) {
    Control_spline s = random_spline(random, 2, 3, Coordinates::dyadic, false, Ends::open, false);
    s.knots = {0, 0, 0, 1, 1, 2, 3, 3, 3};
    s.points.resize(6,
                    {random_coordinate(random, Coordinates::dyadic), random_coordinate(random, Coordinates::dyadic)});
    const Rational ratio = Rational(random.between(1, 6)) / 2;
    for (std::size_t v = 0; v < 2; ++v) s.points[3][v] = s.points[2][v] + ratio * (s.points[2][v] - s.points[1][v]);
    judge(s, random, 2, samples, tally);
  }
  INFO(tally.text());
  CHECK(tally.certified >= 27u);
  CHECK(tally.diagonals >= 25u);
  LOCUS_REQUIRE_SAMPLES(samples, 28);
}

TEST_CASE("self-crossings are nodes, on knots too", "[self_bisector]")
{
  // A loop symmetric to the y axis that crosses itself on the axis, at irrational parameters.
  const Control_chain loop = chain_of(curve_of({{"-2", "0"}, {"4", "3"}, {"-4", "3"}, {"2", "0"}}));
  const auto numbers = graph_numbers(locus::untrimmed_bisector(loop.build()));
  INFO(show(numbers));
  CHECK(numbers.certified);
  CHECK(numbers.vertices.at("node") >= 1u);
  // (u² - 1, u(u² - 1)) crosses itself in the origin, at u = ±1; from -2 to 3.
  const auto node_curve = [](const std::vector<Rational>& cuts, const Rational& shift) {
    const Polynomial x{-1, 0, 1}, y{0, Rational(-1 + shift), 0, 1};
    const Bernstein<Rational, 1> bx = bernstein_on(x, -2, 3, 3), by = bernstein_on(y, -2, 3, 3);
    Control_curve c;
    for (std::size_t i = 0; i < 4; ++i) c.points.push_back({bx[i], by[i]});
    Control_chain chain{{c}, {-2, 3}, false};
    for (const Rational& u : cuts) chain = with_cut_at(chain, u);
    return chain;
  };
  const std::vector<std::vector<Rational>> all_cuts{{}, {1}, {-1}, {-1, 1}, {-1, 0, 1}, {0}, {Rational(1, 2)}};
  for (const auto& cuts : all_cuts) {
    const Control_chain chain = node_curve(cuts, 0);
    const Locus<2> l = locus::untrimmed_bisector(chain.build(), limited());
    INFO(show(cuts) << ": " << show(graph_numbers(l)) << reasons(l));
    std::size_t here = 0;
    for (const auto& v : l.vertices())
      if (v.kind == Vertex_kind::node && std::abs(v.feet[0].parameters[0].lo - 1) < 1e-9 &&
          std::abs(v.feet[1].parameters[0].lo + 1) < 1e-9) {
        ++here;
        CHECK(v.radius < 1e-9);
      }
    CHECK(here == 1u);
  }
  // Perturbed by 2^-30 and 2^-45 it crosses itself next to the knots.
  for (const int bits : {-30, -45}) {
    const Locus<2> l = locus::untrimmed_bisector(node_curve({-1, 1}, two_to(bits)).build(), limited());
    INFO(bits << ": " << show(graph_numbers(l)) << reasons(l));
    CHECK(count(l, Vertex_kind::node) >= 1u);
  }
}
