// SPDX-License-Identifier: LGPL-3.0-or-later
// Bisectors of splines, from curves in memory to the certified result: single cases against what an uncertified solver took,
// and two splines of n cubic spans each, where nearly all of the n² pairs of spans must be purged by their bounds.
#include "side_by_side.h"

#include <locus/bisector_2.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace {

using locus::Curve_2;
using locus::Locus;
using locus_benchmark::side_by_side;

Curve_2 bspline11()
{
  return locus::bspline_2(3, {{0, 0}, {0.5, 1}, {1, 0.25}, {1.5, 1.5}, {2, 0.5}, {2.5, 1}, {3, 0}, {3.5, 1.25}, {4, 0.5}, {4.5, 1.5}, {5, 0.75}},
                          {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8});
}

Curve_2 quadratic7()
{
  return locus::bspline_2(2, {{0, 0}, {1, 2}, {2, -1}, {3, 1.5}, {4, -0.5}, {5, 2}, {6, 0}}, {0, 0, 0, 1, 2, 3, 4, 5, 5, 5});
}

Curve_2 cubic7()
{
  return locus::bspline_2(3, {{0, 0}, {0.5, 2}, {2, 2.5}, {3, 0.5}, {1.5, -1}, {4, -1.5}, {5, 1}}, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4});
}

/// A wavy cubic spline of `spans` spans above or below the x-axis, with coordinates of few bits.
Curve_2 wave(int spans, double height, unsigned seed)
{
  std::mt19937 engine(seed);
  std::vector<locus::Coordinates_2> points;
  std::vector<locus::Number> knots(3, locus::Number(0));
  const int n = spans + 3;
  for (int i = 0; i < n; ++i) {
    const double x = 16.0 * i / n, noise = static_cast<double>(engine() % 64) / 1024;
    points.push_back({std::round(x * 1024) / 1024, std::round((height + 0.5 * std::sin(1.3 * x + height)) * 1024) / 1024 + noise / (1 + spans / 16)});
  }
  for (int s = 0; s <= spans; ++s) knots.emplace_back(s);
  for (int k = 0; k < 3; ++k) knots.emplace_back(spans);
  return locus::bspline_2(3, points, knots);
}

void single_cases()
{
  struct Single {
    const char* name;
    std::function<Locus<2>()> solve;
    double aim; ///< milliseconds
  };
  const Curve_2 b11 = bspline11(), line = locus::segment_2({0, -1}, {5, -1.5}), q7 = quadratic7(), c7 = cubic7();
  const std::vector<Single> singles{{"bspline11_line", [&] { return untrimmed_bisector(b11, line); }, 2},
                                    {"bspline7_self_quad", [&] { return untrimmed_bisector(q7); }, 2},
                                    {"bspline7_self_cubic", [&] { return untrimmed_bisector(c7); }, 2}};
  std::vector<std::function<void()>> jobs;
  for (const Single& s : singles) jobs.push_back([&s] { locus_benchmark::keep(s.solve()); });
  const auto timings = side_by_side(jobs);
  std::printf("Splines: processor time of one certified result, least of the rounds (median)\n");
  for (std::size_t k = 0; k < singles.size(); ++k) {
    const Locus<2> result = singles[k].solve();
    std::printf("  %-22s %6.2f ms (%.2f)  %2zu arcs, %zu components, %zu cells, %llu exact, %zu undecided   aim below %.0f ms: %s\n", singles[k].name,
                1e3 * timings[k].least, 1e3 * timings[k].median, result.arcs().size(), result.components(), result.statistics().cells,
                static_cast<unsigned long long>(result.statistics().exact_cells), result.undecided().size(), singles[k].aim,
                1e3 * timings[k].least < singles[k].aim ? "met" : "MISSED");
  }
}

/// Time of the bounding test alone, a pair.
double purge_time(const Curve_2& a, const Curve_2& b)
{
  return locus::with_upward_rounding([&] {
    const auto solution = locus::detail::framed_solution({&a, &b});
    const locus::detail::Planar_pieces first(a, solution->frame), second(b, solution->frame);
    const double pairs = static_cast<double>(first.size() * second.size());
    std::size_t apart = 0;
    const auto all = [&] {
      for (const auto& p : first.bounds)
        for (const auto& q : second.bounds) apart += are_apart(p, q);
      locus_benchmark::keep(apart);
    };
    return side_by_side({all}, 5)[0].least / pairs;
  });
}

void growing_pairs()
{
  std::printf("\nTwo cubic splines of n spans each\n     n    pairs   purged   solve ms   µs a pair   purge alone, ns a pair   arcs  undecided\n");
  bool met = true;
  for (int n = 4; n <= 256; n *= 2) {
    const Curve_2 a = wave(n, 2, 1), b = wave(n, 0, 2);
    const Locus<2> result = untrimmed_bisector(a, b);
    const auto& statistics = result.statistics();
    const double seconds = side_by_side({[&] { locus_benchmark::keep(untrimmed_bisector(a, b)); }}, 3)[0].least;
    const double pairs = static_cast<double>(statistics.pairs), purge = purge_time(a, b);
    met = met && purge < 1e-6;
    std::printf("  %4d %8zu %8zu %10.2f %11.2f %24.0f %6zu %10zu\n", n, statistics.pairs, statistics.purged_pairs, 1e3 * seconds, 1e6 * seconds / pairs,
                1e9 * purge, result.arcs().size(), result.undecided().size());
  }
  std::printf("purging below 1 µs a pair: %s\n", met ? "met" : "MISSED");
}

} // namespace

int main()
{
  single_cases();
  growing_pairs();
}
