// SPDX-License-Identifier: LGPL-3.0-or-later
// What a certificate costs: the solve without and with keeping the evidence, writing, reading and checking it; and its size.

#include "../examples/locus_cli/read_certificate.h"
#include "cases.h"

#include <locus/bisector_2.h>
#include <locus/check/checker.h>
#include <locus/io/certificate.h>
#include <locus/io/json_job.h>

#include <benchmark/benchmark.h>

#include <sstream>
#include <string>

namespace {

using locus_benchmark::Case;

std::string number(const locus::Number& x) { return '"' + x.value().get_str() + '"'; }

std::string curve_text(const locus_benchmark::Curve_data& c)
{
  std::string points, weights;
  for (const auto& p : c.points) points += (points.empty() ? "[" : ",[") + number(p.x) + ',' + number(p.y) + ']';
  for (const auto& w : c.weights) weights += (weights.empty() ? "" : ",") + number(w);
  return R"({"curve": {"degree": )" + std::to_string(c.points.size() - 1) + R"(, "control_points": [)" + points + "]" +
         (weights.empty() ? "" : R"(, "weights": [)" + weights + "]") + "}}";
}

/// A case as a job, so that the certificate starts from the same numbers.
std::string job_text(const Case& c)
{
  return R"({"compute": "bisector", "inputs": [)" + curve_text(c.first) + "," + curve_text(c.second) + R"(], "options": {"trimmed": false}})";
}

locus::Locus<2> solved(const locus::Job& job, bool keep_evidence)
{
  locus::Bisector_options options;
  options.keep_evidence = keep_evidence;
  return locus::untrimmed_bisector(*job.inputs[0].curve, *job.inputs[1].curve, options);
}

std::string certificate_of(const std::string& text, const locus::Locus<2>& result)
{
  std::ostringstream out;
  locus::write_certificate(out, result, locus::parse_json(text));
  return out.str();
}

void solve(benchmark::State& state, const Case& c, bool keep_evidence)
{
  const locus::Job job = locus::read_job(job_text(c));
  for (auto _ : state) benchmark::DoNotOptimize(solved(job, keep_evidence));
}

void write(benchmark::State& state, const Case& c)
{
  const std::string text = job_text(c);
  const locus::Locus<2> result = solved(locus::read_job(text), true);
  for (auto _ : state) benchmark::DoNotOptimize(certificate_of(text, result));
  state.counters["bytes"] = static_cast<double>(certificate_of(text, result).size());
}

void read(benchmark::State& state, const Case& c)
{
  const std::string text = job_text(c), certificate = certificate_of(text, solved(locus::read_job(text), true));
  for (auto _ : state) benchmark::DoNotOptimize(locus_cli::read_certificate(certificate));
}

void check(benchmark::State& state, const Case& c)
{
  const std::string text = job_text(c);
  const auto certificate = locus_cli::read_certificate(certificate_of(text, solved(locus::read_job(text), true)));
  for (auto _ : state) benchmark::DoNotOptimize(locus::check::check(certificate));
}

const bool registered = [] {
  for (const Case& c : locus_benchmark::all_cases()) {
    benchmark::RegisterBenchmark(("solve/" + c.name).c_str(), solve, c, false)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("solve_keeping_evidence/" + c.name).c_str(), solve, c, true)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("write_certificate/" + c.name).c_str(), write, c)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("read_certificate/" + c.name).c_str(), read, c)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("check_certificate/" + c.name).c_str(), check, c)->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

} // namespace
