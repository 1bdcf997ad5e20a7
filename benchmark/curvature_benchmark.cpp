// SPDX-License-Identifier: LGPL-3.0-or-later
// From curves in memory to the certified result: curvature, evolutes, and bisector surfaces in space with their meshes, of which
// the time of a triangle is a counter.
#include <locus/bisector_3.h>
#include <locus/curvature.h>
#include <locus/evolute.h>

#include <benchmark/benchmark.h>

namespace {

using namespace locus;

Curve_2 plane_spline()
{
  return bspline_2(3, {{0, 0}, {1, 4}, {4, 5}, {7, 3}, {5, 0}, {8, -2}, {11, 2}, {12, 5}, {15, 4}}, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6});
}
Curve_3 space_cubic(bool rational)
{
  return bezier_3({{0, 0, 0}, {1, 2, 1}, {2, -1, 3}, {3, 1, 2}}, rational ? std::vector<Number>{1, 2, 1, 3} : std::vector<Number>{});
}

void curvature_of_plane_spline(benchmark::State& state)
{
  const Curve_2 curve = plane_spline();
  for (auto _ : state) benchmark::DoNotOptimize(analyse_curvature(curve));
}
BENCHMARK(curvature_of_plane_spline)->Unit(benchmark::kMicrosecond);

void curvature_of_space_cubic(benchmark::State& state)
{
  const Curve_3 curve = space_cubic(state.range(0) != 0);
  for (auto _ : state) benchmark::DoNotOptimize(analyse_curvature(curve));
}
BENCHMARK(curvature_of_space_cubic)->ArgName("rational")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void evolute_of_plane_spline(benchmark::State& state)
{
  const Curve_2 curve = plane_spline();
  std::size_t points = 0;
  for (auto _ : state) {
    const Locus<2> locus = evolute(curve);
    points = 0;
    for (const auto& arc : locus.arcs()) points += arc.polyline(1e-6).size();
  }
  state.counters["points"] = static_cast<double>(points);
}
BENCHMARK(evolute_of_plane_spline)->Unit(benchmark::kMillisecond);

template <class Solve>
void report_mesh(benchmark::State& state, Solve solve)
{
  std::size_t triangles = 0;
  double error = 0, scale = 1;
  for (auto _ : state) {
    const Locus<3> locus = solve();
    triangles = 0;
    for (const Sheet& sheet : locus.sheets()) {
      triangles += sheet.triangles.size();
      error = sheet.error;
    }
    scale = locus.scale();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["error/scale"] = error / scale;
  state.counters["s/triangle"] =
    benchmark::Counter(static_cast<double>(triangles) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

Mesh_options within(double tolerance)
{
  Mesh_options options;
  options.tolerance = tolerance;
  return options;
}

void point_and_helix(benchmark::State& state)
{
  const Curve_3 helix = bezier_3({{1, 0, 0}, {1, 1, "1/2"}, {0, 1, 1}}, {1, "7/10", 1});
  report_mesh(state, [&] { return untrimmed_bisector({0, 0, Rational(1, 2)}, helix, within(1e-3)); });
}
BENCHMARK(point_and_helix)->Unit(benchmark::kMillisecond);

void point_and_biquadratic(benchmark::State& state)
{
  const Rational_surface surface = bezier_surface_3({2, 2}, {{-1, -1, 0}, {-1, 0, 1}, {-1, 1, 0}, {0, -1, 1}, {0, 0, -1}, {0, 1, 1}, {1, -1, 0}, {1, 0, 1}, {1, 1, 0}});
  report_mesh(state, [&] { return untrimmed_bisector(Exact_point<3>{0, 0, 2}, surface, within(1e-3)); });
}
BENCHMARK(point_and_biquadratic)->Unit(benchmark::kMillisecond);

void two_space_cubics(benchmark::State& state)
{
  const Curve_3 a = bezier_3({{0, 0, 0}, {1, 1, 0}, {2, -1, 0}, {3, 0, 1}}), b = bezier_3({{0, 0, 3}, {1, 0, 2}, {2, 1, 3}, {3, 1, 2}});
  report_mesh(state, [&] { return untrimmed_bisector(a, b, within(1e-2)); });
}
BENCHMARK(two_space_cubics)->Unit(benchmark::kMillisecond);

} // namespace
