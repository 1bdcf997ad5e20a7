// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BENCHMARK_SIDE_BY_SIDE_H
#define LOCUS_BENCHMARK_SIDE_BY_SIDE_H

// Times several jobs in turns, so that whatever else the machine does meets them all, and by processor time.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <functional>
#include <vector>

namespace locus_benchmark {

/// Keeps the compiler from dropping a result that nobody reads.
template <class T>
void keep(const T& value)
{
  asm volatile("" : : "g"(&value) : "memory");
}

inline double processor_seconds()
{
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Seconds of one run of a job over all rounds. Noise only adds, so ratios are taken of the least ones.
struct Timing {
  double least = 0, median = 0;
};

inline void print(const char* what, const Timing& t) { std::printf("  %-52s %9.1f µs (median %.1f)\n", what, 1e6 * t.least, 1e6 * t.median); }

/// Runs the jobs in turns, in each round every job for about `seconds`.
inline std::vector<Timing> side_by_side(const std::vector<std::function<void()>>& jobs, std::size_t rounds = 9,
                                        double seconds = 0.01)
{
  std::vector<std::vector<double>> samples(jobs.size());
  std::vector<std::size_t> repeats;
  for (const auto& job : jobs) {
    job(); // warms up caches and allocators
    const double start = processor_seconds();
    job();
    const double once = processor_seconds() - start;
    repeats.push_back(1 + static_cast<std::size_t>(std::min(1e6, seconds / std::max(once, 1e-8))));
  }
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      const double start = processor_seconds();
      for (std::size_t i = 0; i < repeats[k]; ++i) jobs[k]();
      samples[k].push_back((processor_seconds() - start) / static_cast<double>(repeats[k]));
    }
  std::vector<Timing> timings;
  for (auto& s : samples) {
    std::sort(s.begin(), s.end());
    timings.push_back({s.front(), s[s.size() / 2]});
  }
  return timings;
}

} // namespace locus_benchmark

#endif
