// SPDX-License-Identifier: LGPL-3.0-or-later
// How the condition of a curvature's critical point depends on the form that is solved for it; see conditioning.h. The time
// is that of measuring, in exact numbers.
#include "conditioning.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using locus_benchmark::Conditioning_row;
using locus_benchmark::Root_measures;

void report(benchmark::State& state, Conditioning_row (*make)(int), std::vector<Conditioning_row>& rows)
{
  for (auto _ : state) rows.push_back(make(static_cast<int>(state.range(0))));
  const auto count = [&](const std::string& name, const Root_measures& m) {
    state.counters["condition_" + name] = m.condition;
    state.counters["error_" + name] = m.error;
    state.counters["residual_" + name] = m.residual;
  };
  const Conditioning_row& r = rows.back();
  count("brute", r.brute);
  count("kept", r.kept);
  count("paper", r.paper);
  count("here", r.here);
}

std::vector<Conditioning_row> cusps, poles, weights;

void near_cusps(benchmark::State& state) { report(state, locus_benchmark::conditioning_near_cusp, cusps); }
void near_poles(benchmark::State& state) { report(state, locus_benchmark::conditioning_near_pole, poles); }
void small_weights(benchmark::State& state) { report(state, locus_benchmark::conditioning_at_small_weight, weights); }

BENCHMARK(near_cusps)->DenseRange(2, 20, 2)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(near_poles)->DenseRange(2, 20, 2)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(small_weights)->DenseRange(2, 20, 2)->Iterations(1)->Unit(benchmark::kMillisecond);

} // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  locus_benchmark::print_conditioning("Cubics near a cusp, least speed ε", cusps);
  locus_benchmark::print_conditioning("Rational quadratics near a pole, least weight ε", poles);
  locus_benchmark::print_conditioning("Rational quadratics with first weight ε", weights);
}
