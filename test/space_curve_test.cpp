// SPDX-License-Identifier: LGPL-3.0-or-later
#include "system_support.h"

#include <locus/zero_set/curve_solver.h>
#include <locus/zero_set/sheet_evaluation.h>
#include <locus/zero_set/space_curve_solver.h>

#include <catch2/catch.hpp>

#include <set>

using namespace locus_test;
using locus::Answer;
using locus::Box;
using locus::Interval;
using locus::midpoint;
using locus::Sheet_evaluator;
using locus::Solve_control;
using locus::solve_space_curves;
using locus::Space_curve_graph;
using locus::Space_piece;
using locus::Space_vertex;
using locus::System;
using locus::with_upward_rounding;

namespace {

using Kind = Space_vertex<3>::Kind;
using P = Terms<3>;

const P x = P::variable(0), y = P::variable(1), z = P::variable(2);
const Rational half = fraction(1, 2), third = fraction(1, 3);

P square(const P& f) { return f * f; }
P sphere(const Rational& a, const Rational& b, const Rational& c, const Rational& squared_radius)
{
  return square(x - a) + square(y - b) + square(z - c) - squared_radius;
}

template <int D>
Space_curve_graph<D> solve(const System<D - 1, D>& system, const Solve_control& control = {},
                           locus::Claim_observer<D>* observer = nullptr)
{
  return with_upward_rounding([&] { return solve_space_curves<D>(system, control, observer); });
}
Space_curve_graph<3> solve(const P& f, const P& g, const Solve_control& control = {})
{
  return solve<3>(system_of<2, 3>({f, g}), control);
}

/// What a graph is, in words to compare.
template <int D>
std::string show_graph(const Space_curve_graph<D>& g)
{
  using K = typename Space_vertex<D>::Kind;
  std::ostringstream out;
  out << g.arcs.size() << " arcs, " << g.closed_arcs() << " closed, " << g.count(K::boundary) << " boundary, "
      << g.count(K::isolated) << " isolated, " << g.count(K::open) << " open, "
      << (g.is_certified() ? "certified" : "undecided");
  return out.str();
}

// ---------------------------------------------------------------------------------------------- checks of any graph

/// Checks a certified graph from outside: pieces hold the curve over all of their base range and only there, and every
/// exact solution on a plane lies on a piece.
class Graph_check {
public:
  Graph_check(const P& f, const P& g, const Space_curve_graph<3>& graph)
    : f_(f), g_(g), system_(system_of<2, 3>({f, g})), graph_(graph)
  {
  }

  std::string problem;
  int planes = 0, solutions = 0;

  void run(Random& random, int plane_count)
  {
    with_upward_rounding([&] {
      for (std::size_t k = 0; k < graph_.pieces.size(); ++k) check_piece(graph_.pieces[k], k);
      check_directions();
      for (int k = 0; k < plane_count; ++k) check_plane(random.below(3), random.unit());
    });
  }

private:
  double base_value(std::size_t vertex, int base, bool upper) const
  {
    const Interval i = graph_.vertices[vertex].at[static_cast<std::size_t>(base)];
    return upper ? i.sup() : i.inf();
  }

  void complain(const std::string& text)
  {
    if (problem.empty()) problem = text + " in " + f_.text() + " and " + g_.text() + ": " + show_graph(graph_);
  }

  /// There is a point over each base value between the ends; none over those beside them, unless of another piece.
  void check_piece(const Space_piece<3>& piece, std::size_t number)
  {
    const Sheet_evaluator<2, 3> curve(system_, piece.box, piece.pivots);
    const double lo = base_value(piece.from, piece.base, true), hi = base_value(piece.to, piece.base, false);
    if (!(lo < hi)) return complain("a piece runs backwards");
    for (const double s : {0.03, 0.25, 0.5, 0.71, 0.97}) {
      const auto p = curve.at({lo + s * (hi - lo)});
      if (p.exists == Answer::no) complain("piece " + std::to_string(number) + " has a gap");
      if (p.exists == Answer::yes && !vanishes(p.at)) complain("a point of a piece is no zero");
    }
    const auto b = static_cast<std::size_t>(piece.base);
    for (const double s : {0.1, 0.5, 0.9}) {
      const double end = base_value(piece.to, piece.base, true), beside = end + s * (piece.box.hi[b] - end);
      if (end + 1e-9 < piece.box.hi[b] && !covered(piece, beside) && curve.at({beside}).exists == Answer::yes)
        complain("a point beside piece " + std::to_string(number) + " is on no piece");
    }
  }

  bool covered(const Space_piece<3>& like, double s) const
  {
    for (const auto& p : graph_.pieces)
      if (p.box.lo == like.box.lo && p.box.hi == like.box.hi && base_value(p.from, p.base, false) <= s &&
          s <= base_value(p.to, p.base, true))
        return true;
    return false;
  }

  bool vanishes(const std::array<Interval, 3>& at) const
  {
    for (const Interval& i : at)
      if (locus::width(i) > 1e-9) return false;
    Box<3> box;
    for (std::size_t v = 0; v < 3; ++v) box.lo[v] = at[v].inf(), box.hi[v] = at[v].sup();
    for (const auto& e : system_.equations) {
      const auto form = e->enclosure(box);
      bool positive = true, negative = true;
      for (const Interval& c : form.coefficients()) {
        positive = positive && c.inf() > 0;
        negative = negative && c.sup() < 0;
      }
      if (positive || negative) return false;
    }
    return true;
  }

  /// An arc that goes on from piece to piece keeps its sense along the tangent's orientation: neighbours may not be joined
  /// head to head. The orientation is that of the cross product of the gradients.
  void check_directions()
  {
    for (const auto& arc : graph_.arcs) {
      int sense = 0;
      for (const auto& step : arc.steps) {
        const int s = orientation(graph_.pieces[step.link]) * (step.reversed ? -1 : 1);
        if (s == 0) continue;
        if (sense != 0 && s != sense) return complain("an arc turns back");
        sense = s;
      }
    }
  }

  /// Sign of the base component of ∇F × ∇G in the middle of a piece; 0 where that is not certain.
  int orientation(const Space_piece<3>& piece) const
  {
    const double lo = base_value(piece.from, piece.base, true), hi = base_value(piece.to, piece.base, false);
    const auto p = Sheet_evaluator<2, 3>(system_, piece.box, piece.pivots).at({0.5 * (lo + hi)});
    if (p.exists != Answer::yes) return 0;
    Box<3> around;
    for (std::size_t v = 0; v < 3; ++v) around.lo[v] = p.at[v].inf() - 1e-9, around.hi[v] = p.at[v].sup() + 1e-9;
    const auto j = locus::detail::jacobian_over(system_, around);
    const auto b = static_cast<std::size_t>(piece.base), u = (b + 1) % 3, w = (b + 2) % 3;
    const Interval t = j[0][u] * j[1][w] - j[0][w] * j[1][u];
    return t.inf() > 0 ? 1 : t.sup() < 0 ? -1 : 0;
  }

  void check_plane(int v, double at)
  {
    const int first = (v + 1) % 3, second = (v + 2) % 3;
    const Exact_plane_system plane(f_.with(v, Rational(at)), g_.with(v, Rational(at)), first, second);
    const auto zeros = plane.zeros();
    if (!zeros) return;
    ++planes;
    int expected = 0;
    for (const auto& uv : *zeros) {
      std::array<double, 3> p{};
      p[static_cast<std::size_t>(v)] = at;
      p[static_cast<std::size_t>(first)] = uv[0];
      p[static_cast<std::size_t>(second)] = uv[1];
      ++solutions;
      const auto n = pieces_at(p, v);
      if (n == 0)
        complain("the point (" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) +
                 ") is on no piece");
      expected += static_cast<int>(based_on(p, v));
    }
    int crossing = 0;
    for (const auto& piece : graph_.pieces)
      crossing += piece.base == v && base_value(piece.from, v, false) <= at && at <= base_value(piece.to, v, true);
    if (crossing != expected)
      complain("a plane is crossed " + std::to_string(crossing) + " times, not " + std::to_string(expected));
  }

  /// Pieces that pass through the point.
  std::size_t pieces_at(const std::array<double, 3>& p, int) const
  {
    return count_if(p, [](const Space_piece<3>&) { return true; });
  }
  std::size_t based_on(const std::array<double, 3>& p, int v) const
  {
    return count_if(p, [v](const Space_piece<3>& piece) { return piece.base == v; });
  }

  template <class Wanted>
  std::size_t count_if(const std::array<double, 3>& p, Wanted wanted) const
  {
    std::size_t n = 0;
    for (const auto& piece : graph_.pieces) n += wanted(piece) && passes(piece, p);
    return n;
  }

  bool passes(const Space_piece<3>& piece, const std::array<double, 3>& p) const
  {
    for (std::size_t v = 0; v < 3; ++v)
      if (p[v] < piece.box.lo[v] || p[v] > piece.box.hi[v]) return false;
    const double s = p[static_cast<std::size_t>(piece.base)];
    if (s < base_value(piece.from, piece.base, false) || s > base_value(piece.to, piece.base, true)) return false;
    const auto q = Sheet_evaluator<2, 3>(system_, piece.box, piece.pivots).at({s});
    double distance = 0;
    for (std::size_t v = 0; v < 3; ++v) distance = std::max(distance, std::abs(midpoint(q.at[v]) - p[v]));
    return q.exists != Answer::yes || distance < 1e-6;
  }

  P f_, g_;
  System<2, 3> system_;
  const Space_curve_graph<3>& graph_;
};

/// A graph that passes all checks has no text.
std::string problem_of(const P& f, const P& g, const Space_curve_graph<3>& graph, std::uint64_t stream, int planes)
{
  Random random(stream);
  Graph_check check(f, g, graph);
  check.run(random, planes);
  return check.problem;
}

P torus(const Rational& large, const Rational& small)
{
  const P s = square(x - half) + square(y - half);
  return square(s + square(z - half) + Rational(large * large - small * small)) - P(Rational(4 * large * large)) * s;
}

struct Shape {
  const char* name;
  P f, g;
  std::size_t arcs, closed, boundary, most_cells;
};

std::vector<Shape> shapes()
{
  const P ball = sphere(half, half, half, fraction(1, 9)), ring = torus(fraction(3, 10), fraction(1, 10));
  const P upright = square(x - half) + square(y - half) - fraction(1, 9),
          thin = square(x - half) + square(z - half) - fraction(1, 16);
  const P thick = square(x - half) + square(z - half) - fraction(1, 9);
  return {
    {"sphere and plane z = 1/2", ball, z - half, 1, 1, 0, 49},
    {"sphere and tilted plane", ball, x + P(fraction(2, 3)) * y + P(fraction(1, 5)) * z - 1, 1, 1, 0, 49},
    {"two spheres", ball, sphere(third, half, fraction(4, 7), fraction(1, 9)), 1, 1, 0, 95},
    {"cylinders of two radii", upright, thin, 2, 2, 0, 159},
    {"cylinders that cut into each other", upright, square(x - fraction(3, 5)) + square(z - half) - fraction(1, 9), 1,
     1, 0, 135},
    {"sphere and cylinder through its side, two loops", ball, square(x - half) + square(y - half) - fraction(1, 36), 2,
     2, 0, 127},
    {"sphere and cylinder, one loop", ball, square(x - fraction(7, 10)) + square(y - half) - fraction(1, 25), 1, 1, 0,
     99},
    {"torus and plane, two circles outside each other", ring, x - half, 2, 2, 0, 121},
    {"torus and plane, two circles in each other", ring, z - half, 2, 2, 0, 417},
    {"torus and plane above the middle", ring, z - fraction(13, 25), 2, 2, 0, 417},
    {"torus and plane z = 1/2 + 1/8", ring, z - fraction(5, 8), 0, 0, 0, 97},
    {"twisted cubic, shifted, through an edge", y - x * x - fraction(1, 10), z - x * y, 1, 0, 2, 1},
    {"twisted cubic as two quadrics, away from their line", y - x * x + P(fraction(1, 8)),
     x * z - y * y + P(fraction(1, 16)), 1, 0, 2, 9},
    {"cylinders of one radius, shifted", thick, square(y - half) + square(z - fraction(11, 20)) - fraction(1, 9), 1, 1,
     0, 167},
  };
}

} // namespace

TEST_CASE("known curves have the components they are known to have", "[space_curve]")
{
  for (const Shape& s : shapes()) {
    const auto g = solve(s.f, s.g);
    INFO(s.name << ": " << show_graph(g) << ", " << g.statistics.cells << " cells");
    CHECK(g.is_certified());
    CHECK(g.arcs.size() == s.arcs);
    CHECK(g.closed_arcs() == s.closed);
    CHECK(g.count(Kind::boundary) == s.boundary);
    CHECK(g.statistics.cells <= s.most_cells);
    CHECK(problem_of(s.f, s.g, g, 1, 20) == "");
  }
}

TEST_CASE("a plane that touches a sphere is undecided; moved by 2^-20 or less it meets it in a loop or not at all",
          "[space_curve]")
{
  const P ball = sphere(half, half, half, fraction(1, 9));
  const auto plane = [&](const Rational& offset) {
    return P(2) * x + y + P(2) * z -
           P(Rational(fraction(5, 2) + 1 + offset)); // distance 1/3 + offset/3 from the centre
  };
  for (const int k : {12, 20, 30}) {
    const auto loop = solve(ball, plane(-two_to(-k))), nothing = solve(ball, plane(two_to(-k)));
    INFO("2^-" << k << ": " << show_graph(loop) << " and " << show_graph(nothing));
    CHECK(show_graph(loop) == "1 arcs, 1 closed, 0 boundary, 0 isolated, 0 open, certified");
    CHECK(show_graph(nothing) == "0 arcs, 0 closed, 0 boundary, 0 isolated, 0 open, certified");
    CHECK(loop.statistics.cells <= 500);
    CHECK(problem_of(ball, plane(-two_to(-k)), loop, 2, 0) == "");
  }
  const auto touch = solve(ball, plane(0));
  CHECK(touch.arcs.empty());
  REQUIRE_FALSE(touch.is_certified());
  CHECK(touch.statistics.cells <= 700);
  const std::array<double, 3> place{0.5 + 2.0 / 9, 0.5 + 1.0 / 9, 0.5 + 2.0 / 9};
  for (const auto& u : touch.undecided)
    for (std::size_t v = 0; v < 3; ++v) {
      CHECK(u.box.lo[v] > place[v] - 1e-5);
      CHECK(u.box.hi[v] < place[v] + 1e-5);
    }
}

TEST_CASE("loops of radius 2^-12 are found, wherever they are", "[space_curve]")
{
  Random random(3);
  Samples samples;
  for (int k = 0; k < 40; ++k) {
    std::array<Rational, 3> c;
    for (Rational& u : c) u = fraction(random.between(10, 990), 1000);
    const int a = random.between(1, 9), b = random.between(-9, 9);
    const P plane = P(a) * (x - c[0]) + P(b) * (y - c[1]) + P(random.between(-9, 9)) * (z - c[2]);
    const P ball = sphere(c[0], c[1], c[2], two_to(-24));
    const auto g = solve(ball, plane);
    samples.expect(g.is_certified() && g.arcs.size() == 1 && g.closed_arcs() == 1 && g.statistics.cells < 1000,
                   [&] { return plane.text() + ": " + show_graph(g); });
    const std::string problem = problem_of(ball, plane, g, 4, 0);
    samples.expect(problem.empty(), [&] { return problem; });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 80);
}

// ---------------------------------------------------------------------------------------------------- many samples

namespace {

struct Pair {
  P f, g;
};

Pair random_pair(Random& random, int degree)
{
  const Degrees<3> d{degree, degree, degree};
  const int size = random.chance(50) ? 3 : 50;
  std::array<Rational, 3> through; // a point of the unit cell, so that there is something to find
  for (Rational& u : through) u = fraction(random.between(1, 99), 100);
  const auto form = [&] {
    const P f = random_terms<3>(random, d, size);
    return f - P(f.at(through));
  };
  const P f = form();
  return {f, form()};
}

/// Quadrics and other forms that have loops inside the unit cell more often.
Pair random_round_pair(Random& random)
{
  const auto quadric = [&] {
    P f = P(-fraction(random.between(5, 40), 100));
    for (int v = 0; v < 3; ++v) {
      const int weight = random.between(-1, 4);
      f = f + P(weight) * square(P::variable(v) - P(fraction(random.between(20, 80), 100)));
    }
    return f;
  };
  const P f = quadric();
  return {f, quadric()};
}

void check_random(int kind, int count, int planes, int least_planes, double most_seconds)
{
  Random random(static_cast<std::uint64_t>(10 + kind));
  Samples samples;
  int all_planes = 0, solutions = 0, undecided = 0;
  std::size_t closed = 0, cells = 0;
  Solve_control control;
  control.max_seconds = most_seconds;
  for (int k = 0; k < count; ++k) {
    const Pair p = kind == 0 ? random_round_pair(random) : random_pair(random, kind);
    const auto g = solve(p.f, p.g, control);
    cells += g.statistics.cells;
    if (!g.is_certified()) {
      ++undecided;
      continue;
    }
    closed += g.closed_arcs();
    Graph_check check(p.f, p.g, g);
    check.run(random, planes);
    all_planes += check.planes;
    solutions += check.solutions;
    samples.expect(check.problem.empty(), [&] { return check.problem; });
    samples.expect(g.count(Kind::boundary) == 2 * (g.arcs.size() - g.closed_arcs()), "ends of arcs");
  }
  INFO("kind " << kind << ": " << count << " pairs, " << undecided << " undecided, " << closed << " loops, "
               << all_planes << " planes with " << solutions << " points, " << cells << " cells");
  CHECK(undecided * 20 <= count);
  CHECK(all_planes >= least_planes);
  LOCUS_REQUIRE_SAMPLES(samples, 2 * (count - undecided));
}

} // namespace

TEST_CASE("quadrics that meet, compared with exact counts on planes", "[space_curve]")
{
  check_random(0, 150, 6, 500, 10);
}
TEST_CASE("trilinear pairs, compared with exact counts on planes", "[space_curve]")
{
  check_random(1, 150, 6, 300, 10);
}
TEST_CASE("triquadratic pairs, compared with exact counts on planes", "[space_curve]")
{
  check_random(2, 40, 3, 60, 10);
}

TEST_CASE("the same curve with variables permuted, mirrored, equations swapped and combined", "[space_curve]")
{
  Random random(20);
  Samples samples;
  for (int k = 0; k < 60; ++k) {
    const Pair p = k % 2 == 0 ? random_round_pair(random) : random_pair(random, 1);
    const auto home = solve(p.f, p.g);
    if (!home.is_certified()) continue;
    std::array<int, 3> order{0, 1, 2};
    for (std::size_t i = 3; i-- > 1;)
      std::swap(order[i], order[static_cast<std::size_t>(random.below(static_cast<int>(i) + 1))]);
    std::array<bool, 3> mirror{};
    for (bool& m : mirror) m = random.chance(50);
    const P f = p.f.rearranged(order, mirror), g = p.g.rearranged(order, mirror);
    const auto other = random.chance(50) ? solve(g, f) : solve(f, P(3) * g - P(2) * f);
    samples.expect(!other.is_certified() || show_graph(other) == show_graph(home), [&] {
      return show_graph(home) + " became " + show_graph(other) + " for " + p.f.text() + " and " + p.g.text();
    });
    samples.expect(other.is_certified(), [&] { return "lost certainty: " + p.f.text() + " and " + p.g.text(); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

TEST_CASE("one equation in two variables agrees with the plane solver", "[space_curve]")
{
  Random random(30);
  Samples samples;
  int loops = 0;
  for (int k = 0; k < 400; ++k) {
    const Degrees<2> degrees = random.degrees<2>(1, 4);
    Terms<2> f = random_terms<2>(random, degrees, random.chance(50) ? 2 : 30);
    if (k % 4 == 0) { // round forms, a little disturbed, for loops
      const Terms<2> u = Terms<2>::variable(0) - fraction(random.between(30, 70), 100),
                     v = Terms<2>::variable(1) - fraction(random.between(30, 70), 100);
      const Rational disturbance = fraction(random.between(-3, 3), 100);
      f = f * Terms<2>(disturbance) + u * u + v * v - fraction(random.between(1, 9), 100);
    }
    const System<1, 2> system = system_of<1, 2>({f});
    const auto plane = with_upward_rounding([&] { return locus::solve_curves(system); });
    const auto general = solve<2>(system);
    if (!plane.is_certified() || plane.identically_zero || !general.is_certified()) continue;
    std::size_t arcs = 0, closed = 0, ends = 0;
    std::vector<char> used(plane.vertices.size(), 0);
    for (const auto& arc : plane.arcs) {
      ++arcs;
      closed += arc.closed;
      if (!arc.closed) used[arc.source] = used[arc.target] = 1;
    }
    for (const char u : used) ends += u != 0;
    loops += static_cast<int>(closed);
    samples.expect(general.arcs.size() == arcs && general.closed_arcs() == closed &&
                     general.count(Space_vertex<2>::Kind::boundary) == ends,
                   [&] {
                     return f.text() + ": " + show_graph(general) + ", but " + std::to_string(arcs) + " arcs, " +
                            std::to_string(closed) + " closed, " + std::to_string(ends) + " ends";
                   });
  }
  CHECK(loops >= 40);
  LOCUS_REQUIRE_SAMPLES(samples, 350);
}

// --------------------------------------------------------------------------------- edges, corners, touches, limits

TEST_CASE("curves through edges and corners of the unit cell, and such that touch them from outside", "[space_curve]")
{
  struct Case {
    const char* name;
    P f, g;
    std::size_t arcs, boundary, isolated;
  };
  const std::vector<Case> cases{
    {"the diagonal", x - y, y - z, 1, 2, 0},
    {"from edge to edge", x - y, z - half, 1, 2, 0},
    {"the other edges", x + y - 1, z - third, 1, 2, 0},
    {"from a corner into the inside", x - P(2) * y, y - P(3) * z, 1, 2, 0},
    {"touches an edge", x + y, z - half, 0, 0, 1},
    {"touches an edge at an irrational place", x + y, z * z + x - half, 0, 0, 1},
    {"touches a corner", x + y + z, x - y, 0, 0, 1},
    {"touches the last corner", x + y + z - 3, x - y, 0, 0, 1},
    {"touches two edges", (z - third) * (z - half) + x, x + y, 0, 0, 2},
    {"through an edge at an irrational place", x - y + x * x * z, z * z - x - half, 1, 2, 0},
    {"through two points of an edge", x - y, (z - third) * (z - fraction(2, 5)) - x * x + P(fraction(1, 7)) * x, 2, 4,
     0},
  };
  for (const Case& c : cases) {
    const auto g = solve(c.f, c.g);
    INFO(c.name << ": " << show_graph(g));
    CHECK(g.is_certified());
    CHECK(g.arcs.size() == c.arcs);
    CHECK(g.closed_arcs() == 0);
    CHECK(g.count(Kind::boundary) == c.boundary);
    CHECK(g.count(Kind::isolated) == c.isolated);
    CHECK(problem_of(c.f, c.g, g, 5, 0) == "");
  }
}

namespace {

/// Every exact solution on some planes lies on a piece or in an undecided box.
std::string lost_point(const P& f, const P& g, const Space_curve_graph<3>& graph, std::uint64_t stream, int planes,
                       int& points)
{
  Random random(stream);
  const auto system = system_of<2, 3>({f, g});
  for (int k = 0; k < planes; ++k) {
    const int v = random.below(3), a = (v + 1) % 3, b = (v + 2) % 3;
    const double at = random.unit();
    const auto zeros = Exact_plane_system(f.with(v, Rational(at)), g.with(v, Rational(at)), a, b).zeros();
    if (!zeros) continue;
    for (const auto& uv : *zeros) {
      std::array<double, 3> p{};
      p[static_cast<std::size_t>(v)] = at;
      p[static_cast<std::size_t>(a)] = uv[0];
      p[static_cast<std::size_t>(b)] = uv[1];
      ++points;
      bool found = false;
      const auto lies_in = [&](const Box<3>& box) {
        for (std::size_t w = 0; w < 3; ++w)
          if (p[w] < box.lo[w] || p[w] > box.hi[w]) return false;
        return true;
      };
      for (const auto& u : graph.undecided) found = found || lies_in(u.box);
      for (const auto& piece : graph.pieces) {
        if (found || !lies_in(piece.box)) continue;
        const auto base = static_cast<std::size_t>(piece.base);
        found =
          graph.vertices[piece.from].at[base].inf() <= p[base] && p[base] <= graph.vertices[piece.to].at[base].sup();
      }
      if (!found)
        return "(" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) + ") is lost";
    }
  }
  return "";
}

} // namespace

TEST_CASE("what touches the boundary or is singular stays undecided in small boxes, and nothing is lost beside them",
          "[space_curve]")
{
  struct Case {
    const char* name;
    P f, g;
    std::size_t open; ///< arcs' ends at the doubtful places
    double most_width;
    int least_points;
  };
  const P ball = sphere(half, half, half, fraction(4, 25));
  const std::vector<Case> cases{
    {"circle that touches four faces", square(x - half) + square(y - half) - fraction(1, 4),
     z - fraction(2, 7) - P(fraction(1, 9)) * x, 8, 1e-4, 30},
    {"twisted cubic tangent to two faces in a corner", y - x * x, z - x * y, 1, 1e-4, 10},
    {"Viviani's curve with its node", ball, square(x - fraction(3, 10)) + square(y - half) - fraction(1, 25), 4, 1e-4,
     20},
    {"two planes times one", (x - third) * (y - fraction(2, 5)),
     z - half - P(fraction(1, 9)) * x - P(fraction(1, 11)) * y, 4, 1e-4, 20},
    {"circles in one sphere that cross", ball, (x - half - P(fraction(1, 50))) * (y - half - P(fraction(1, 70))), 8,
     1e-4, 20},
  };
  for (const Case& c : cases) {
    const auto g = solve(c.f, c.g);
    double widest = 0;
    std::set<std::string> reasons;
    for (const auto& u : g.undecided) {
      widest = std::max(widest, u.box.max_width());
      reasons.insert(u.reason);
    }
    std::string text;
    for (const auto& r : reasons) text += "; " + r;
    INFO(c.name << ": " << show_graph(g) << ", " << g.undecided.size() << " boxes up to " << widest << ", "
                << g.statistics.cells << " cells, " << g.statistics.face_cells << " face cells" << text);
    CHECK_FALSE(g.is_certified());
    CHECK(g.count(Kind::open) == c.open);
    CHECK(widest < c.most_width);
    CHECK(g.statistics.cells < 6000);
    int points = 0;
    CHECK(lost_point(c.f, c.g, g, 6, 60, points) == "");
    CHECK(points >= c.least_points);
  }
}

TEST_CASE("what cannot be a curve ends in undecided boxes, soon", "[space_curve]")
{
  struct Case {
    const char* name;
    P f, g;
  };
  const P ball = sphere(half, half, half, fraction(1, 9));
  for (const Case& c :
       {Case{"one surface twice", ball, P(2) * ball}, Case{"a common factor", ball * (x - third), ball * (y - third)},
        Case{"a curve in a face", x, square(y - half) + square(z - half) - fraction(1, 9)},
        Case{"surfaces that touch along a circle", ball, square(x - half) + square(y - half) - fraction(1, 9)},
        Case{"zero", P(0), ball}}) {
    Solve_control control;
    control.max_cells = 3000;
    const auto g = solve(c.f, c.g, control);
    INFO(c.name << ": " << show_graph(g) << ", " << g.undecided.size() << " boxes, " << g.statistics.cells << " cells, "
                << g.statistics.face_cells << " face cells");
    CHECK_FALSE(g.is_certified());
    CHECK(g.statistics.cells <= 3000);
    CHECK(g.statistics.face_cells <= 150'000);
    CHECK(g.closed_arcs() == 0);
  }
}

TEST_CASE("limits leave the rest undecided, and nothing is lost", "[space_curve]")
{
  const P f = torus(fraction(3, 10), fraction(1, 10)),
          g = x + P(fraction(1, 3)) * y + P(fraction(1, 7)) * z - fraction(31, 42);
  const auto whole = solve(f, g);
  REQUIRE(whole.is_certified());
  int points = 0;
  for (std::size_t cells = 1; cells < whole.statistics.cells; cells += 7) {
    Solve_control control;
    control.max_cells = cells;
    const auto part = solve(f, g, control);
    INFO(cells << " cells: " << show_graph(part));
    REQUIRE_FALSE(part.is_certified());
    REQUIRE(part.statistics.cells <= cells);
    REQUIRE(part.undecided[0].reason == "cell limit");
    REQUIRE(lost_point(f, g, part, 7, 4, points) == "");
  }
  CHECK(points >= 20);
  Solve_control cancelled;
  cancelled.cancel = std::make_shared<std::atomic<bool>>(true);
  CHECK(solve(f, g, cancelled).undecided.at(0).reason == "cancelled");
  Solve_control late;
  late.max_seconds = 0;
  CHECK(solve(f, g, late).undecided.at(0).reason == "time limit");
  Solve_control watched;
  std::size_t calls = 0;
  watched.progress = [&](std::size_t done, std::size_t) {
    ++calls;
    CHECK(done <= whole.statistics.cells);
    CHECK(observed_mode() == FE_TONEAREST);
  };
  solve(f, g, watched);
  CHECK(calls > 3);
}

TEST_CASE("cells outside what is wanted are left alone, and arcs end there", "[space_curve]")
{
  auto system = system_of<2, 3>({sphere(half, half, half, fraction(1, 9)), z - fraction(11, 20)});
  system.outside = [](const Box<3>& box) { return box.lo[0] >= 0.5; };
  const auto g = solve<3>(system);
  INFO(show_graph(g));
  CHECK(g.is_certified());
  CHECK(g.arcs.size() == 1);
  CHECK(g.closed_arcs() == 0);
  CHECK(g.count(Kind::open) == 2);
}

TEST_CASE("three equations in four variables", "[space_curve]")
{
  using Q = Terms<4>;
  const Q a = Q::variable(0), b = Q::variable(1), c = Q::variable(2), d = Q::variable(3);
  using K4 = Space_vertex<4>::Kind;
  // The three cube roots of 1 + i(1/2 - t), in a square of side 3, for t from 0 to 1.
  const Q u = Q(3) * a - Q(fraction(3, 2)), v = Q(3) * b - Q(fraction(3, 2));
  const auto roots = solve<4>(
    system_of<3, 4>({u * u * u - Q(3) * u * v * v - Q(1), Q(3) * u * u * v - v * v * v - Q(half) + c, d - a * b}));
  INFO(show_graph(roots) << ", " << roots.statistics.cells << " cells");
  CHECK(roots.arcs.size() == 3);
  CHECK(roots.closed_arcs() == 0);
  CHECK(roots.count(K4::boundary) == 6);
  const Q s = (a - half) * (a - half) + (b - half) * (b - half) - fraction(1, 9);
  const auto loop = solve<4>(system_of<3, 4>({s, c - a * b, d - a * a}));
  INFO(show_graph(loop) << ", " << loop.statistics.cells << " cells");
  CHECK(loop.is_certified());
  CHECK(loop.arcs.size() == 1);
  CHECK(loop.closed_arcs() == 1);
}
