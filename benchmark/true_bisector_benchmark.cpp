// SPDX-License-Identifier: LGPL-3.0-or-later
// The true bisector of two curves, certified, and its polyline with a proved error, beside Boost.Polygon's Voronoi diagram of the
// same curves as segments, in turns in one run; and what random pairs take.
#include "cases.h"
#include "side_by_side.h"

#include "plain_curve.h"
#if LOCUS_HAS_BOOST_POLYGON
#include "peer_segments.h"
#endif

#include <locus/bisector_2.h>

#include <cstdio>

namespace {

using locus_benchmark::Case;
using locus_benchmark::keep;
using locus_benchmark::Plain_curve;
using locus_benchmark::print;
using locus_benchmark::side_by_side;

constexpr int segments_a_curve = 1024;
constexpr double tolerance = 1e-6; ///< relative to the inputs' diameter
constexpr double wanted_share = 0.1;

std::size_t draw(const locus::Locus<2>& result)
{
  std::size_t points = 0;
  for (const auto& arc : result.arcs()) {
    const auto line = arc.polyline(tolerance);
    keep(line);
    points += line.size();
  }
  return points;
}

void compare(const Case& c)
{
  const auto first = c.first.curve(), second = c.second.curve();
  const auto result = locus::bisector(first, second);
  double error = 0;
  for (const auto& arc : result.arcs()) error = std::max(error, arc.polyline(tolerance).error() / result.scale());
  std::printf("%s: %zu arcs, %zu undecided, %zu points, proved error %.1e of the diameter\n", c.name.c_str(), result.arcs().size(),
              result.undecided().size(), draw(result), error);
  std::vector<std::function<void()>> jobs{[&] { keep(locus::bisector(first, second)); }, [&] { draw(result); },
                                          [&] { draw(locus::bisector(first, second)); }};
#if LOCUS_HAS_BOOST_POLYGON
  const Plain_curve a(c.first), b(c.second);
  jobs.push_back([&] { keep(segment_voronoi(a, b, segments_a_curve)); });
#endif
  const auto t = side_by_side(jobs, 11, 0.05);
  print("locus, certified true bisector", t[0]);
  print("locus, its polylines within 1e-6", t[1]);
  print("locus, both", t[2]);
#if LOCUS_HAS_BOOST_POLYGON
  print("Boost.Polygon, Voronoi of 2×1024 segments", t[3]);
  const double share = t[2].least / t[3].least;
  std::printf("  share of locus, both / Boost.Polygon %32.3f    aim ≤ %.1f: %s\n", share, wanted_share, share <= wanted_share ? "met" : "NOT MET");
#else
  std::printf("  Boost.Polygon: ABSENT, not compared\n");
#endif
}

} // namespace

int main()
{
  std::printf("True bisectors of plane curves: processor time of one job, least of the rounds\n");
  for (const Case& c : {locus_benchmark::cubic_cubic(), locus_benchmark::mirror_images(), locus_benchmark::quad_quad()}) compare(c);
}
