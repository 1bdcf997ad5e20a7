// SPDX-License-Identifier: LGPL-3.0-or-later
// Untrimmed bisectors of pairs of Bézier curves, from control points in memory to the certified result: the curves'
// validation and the equations' construction are inside. Then the same with 200 points on every arc.
#include "cases.h"

#include <locus/bisector_2.h>

#include <benchmark/benchmark.h>

namespace {

using locus_benchmark::Case;

constexpr std::size_t points_an_arc = 200;

locus::Locus<2> solved(const Case& c) { return locus::untrimmed_bisector(c.first.curve(), c.second.curve()); }

/// Counts that do not depend on the machine.
void report(benchmark::State& state, const locus::Locus<2>& result)
{
  const auto count = [&](const char* name, auto n) { state.counters[name] = static_cast<double>(n); };
  const auto& statistics = result.statistics();
  const char* calls[] = {"bounded", "interval", "exact"};
  const char* failures[] = {"bounded_failed", "interval_failed", "exact_failed"};
  count("components", result.components());
  count("arcs", result.arcs().size());
  count("cells", statistics.cells);
  count("exact_cells", statistics.exact_cells);
  count("undecided", result.undecided().size());
  for (std::size_t rung = 0; rung < 3; ++rung) {
    count(calls[rung], statistics.filter.calls[rung]);
    if (rung < 2) count(failures[rung], statistics.filter.failures[rung]);
  }
}

void solve(benchmark::State& state, const Case& c)
{
  for (auto _ : state) benchmark::DoNotOptimize(solved(c));
  report(state, solved(c));
}

void solve_and_sample(benchmark::State& state, const Case& c)
{
  std::size_t points = 0;
  for (auto _ : state) {
    const auto result = solved(c);
    points = 0;
    for (const auto& arc : result.arcs()) points += arc.samples(points_an_arc).size();
    benchmark::DoNotOptimize(points);
  }
  state.counters["points"] = static_cast<double>(points);
}

const bool registered = [] {
  for (const Case& c : locus_benchmark::all_cases()) {
    benchmark::RegisterBenchmark(("solve/" + c.name).c_str(), solve, c)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("solve_and_sample/" + c.name).c_str(), solve_and_sample, c)
      ->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

} // namespace
