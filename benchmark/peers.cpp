// SPDX-License-Identifier: LGPL-3.0-or-later
// Puts into the head of every benchmark's output which peers it was compared with, so that a table without a peer's
// column cannot pass for a complete one.
#include <benchmark/benchmark.h>

namespace {

const char* state(bool present) { return present ? "compared" : "ABSENT, not compared"; }

const bool announced = [] {
  benchmark::AddCustomContext("peer OCCT", state(LOCUS_HAS_OCCT));
  benchmark::AddCustomContext("peer Boost.Polygon", state(LOCUS_HAS_BOOST_POLYGON));
  return true;
}();

} // namespace
