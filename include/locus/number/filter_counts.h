// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_NUMBER_FILTER_COUNTS_H
#define LOCUS_NUMBER_FILTER_COUNTS_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace locus {

/// The rungs of the ladder by which a sign is decided, cheapest first.
enum class Rung : unsigned char { bounded = 0, interval = 1, exact = 2 };

/// How often each rung was asked, and how often it could not tell. They live in a solve, never in globals.
struct Filter_counts {
  std::array<std::uint64_t, 3> calls{};
  std::array<std::uint64_t, 3> failures{};

  void record(Rung rung, bool decided)
  {
    const auto i = static_cast<std::size_t>(rung);
    ++calls[i];
    if (!decided) ++failures[i];
  }
  Filter_counts& operator+=(const Filter_counts& other)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      calls[i] += other.calls[i];
      failures[i] += other.failures[i];
    }
    return *this;
  }
};

} // namespace locus

#endif
