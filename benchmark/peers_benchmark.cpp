// SPDX-License-Identifier: LGPL-3.0-or-later
// The bisector of two curves beside what OCCT and Boost.Polygon give, in turns in one run, with the ratios to reach; and
// a mirror-symmetric pair beside a general one.
#include "side_by_side.h"

#include "plain_curve.h"
#if LOCUS_HAS_OCCT
#include "peer_occt.h"
#endif
#if LOCUS_HAS_BOOST_POLYGON
#include "peer_segments.h"
#endif

#include <locus/bisector_2.h>

#include <cstdio>

namespace {

using locus_benchmark::Case;
using locus_benchmark::keep;
using locus_benchmark::Plain_curve;
using locus_benchmark::Point;
using locus_benchmark::print;
using locus_benchmark::side_by_side;

constexpr int points_an_arc = 200;
constexpr int segments_a_curve = 1024;
constexpr double least_gain_over_segments = 20, greatest_loss_by_symmetry = 20;

locus::Locus<2> solve(const Case& c) { return locus::untrimmed_bisector(c.first.curve(), c.second.curve()); }

void solve_and_sample(const Case& c, std::size_t most_arcs)
{
  const auto result = solve(c);
  for (std::size_t i = 0; i < std::min(most_arcs, result.arcs().size()); ++i) keep(result.arcs()[i].samples(points_an_arc));
}

void print_ratio(const char* what, double ratio, const char* aim, bool met)
{
  std::printf("  ratio %-46s %9.2f    aim %s: %s\n", what, ratio, aim, met ? "met" : "NOT MET");
}

#if LOCUS_HAS_OCCT
/// Points from which OCCT may start: ends and middles of the curves, and points of the bisector itself.
std::vector<Point> origins(const Plain_curve& a, const Plain_curve& b, const locus::Locus<2>& result)
{
  std::vector<Point> found{a.at(0), middle(a.at(0), b.at(0)), middle(a.at(0.5), b.at(0.5))};
  for (const auto& arc : result.arcs())
    for (const auto& p : arc.samples(5)) found.push_back({p.point()[0], p.point()[1]});
  return found;
}
#endif

void compare(const Case& c)
{
  const auto result = solve(c);
  std::printf("%s: %zu arc(s), %zu undecided\n", c.name.c_str(), result.arcs().size(), result.undecided().size());
  const Plain_curve a(c.first), b(c.second);
  std::vector<std::function<void()>> jobs{[&] { keep(solve(c)); }, [&] { solve_and_sample(c, 1); }, [&] { solve_and_sample(c, 1000); }};
#if LOCUS_HAS_OCCT
  const auto occt = best_occt_call(a, b, origins(a, b, result), points_an_arc);
  const std::size_t occt_job = jobs.size();
  if (occt) jobs.push_back([&] { keep(occt_arc(a, b, occt->call, points_an_arc)); });
#endif
#if LOCUS_HAS_BOOST_POLYGON
  const std::size_t segments_job = jobs.size();
  jobs.push_back([&] { keep(segment_voronoi(a, b, segments_a_curve)); });
#endif
  const auto t = side_by_side(jobs, 11, 0.02);
  print("locus, certified result, all arcs", t[0]);
  print("locus, the same and 200 points on one arc", t[1]);
  print("locus, the same and 200 points on every arc", t[2]);

#if LOCUS_HAS_OCCT
  if (occt) {
    print("OCCT, one uncertified arc of 200 points", t[occt_job]);
    std::printf("    of its points %zu of %d are right to 1e-6, by the best of %zu calls, %zu of which returned an arc\n", occt->right,
                points_an_arc, occt->tried, occt->answered);
    print_ratio("locus, one arc of points / OCCT", t[1].least / t[occt_job].least, "≤ 1", t[1].least <= t[occt_job].least);
    print_ratio("locus, points on every arc / OCCT", t[2].least / t[occt_job].least, "≤ 1", t[2].least <= t[occt_job].least);
  } else {
    std::printf("  OCCT returned no arc by any call\n");
  }
#else
  std::printf("  OCCT: ABSENT, not compared\n");
#endif

#if LOCUS_HAS_BOOST_POLYGON
  print("Boost.Polygon, Voronoi of 2×1024 segments", t[segments_job]);
  double worst = 0;
  const auto vertices = segment_voronoi(a, b, segments_a_curve);
  for (const Point& p : vertices)
    if (std::hypot(p.x, p.y) < 10) worst = std::max(worst, residual(a, b, p));
  std::printf("    distances from its %zu separating vertices differ by up to %.1e\n", vertices.size(), worst);
  const double gain = t[segments_job].least / t[2].least;
  print_ratio("Boost.Polygon / locus, points on every arc", gain, "≥ 20", gain >= least_gain_over_segments);
#else
  std::printf("  Boost.Polygon: ABSENT, not compared\n");
#endif
}

void compare_symmetric()
{
  const Case symmetric = locus_benchmark::mirror_images(), general = locus_benchmark::cubic_cubic();
  const auto t = side_by_side({[&] { keep(solve(symmetric)); }, [&] { keep(solve(general)); }}, 11, 0.02);
  std::printf("mirror images\n");
  print("mirror-symmetric cubics, certified result", t[0]);
  print("general cubics, certified result", t[1]);
  const double loss = t[0].least / t[1].least;
  print_ratio("mirror-symmetric / general", loss, "≤ 20", loss <= greatest_loss_by_symmetry);
}

} // namespace

int main()
{
  std::printf("Bisectors of plane curves: processor time of one job, least of the rounds\n");
  compare(locus_benchmark::quad_quad());
  compare(locus_benchmark::cubic_cubic());
  compare_symmetric();
}
