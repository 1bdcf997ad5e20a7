// SPDX-License-Identifier: LGPL-3.0-or-later
// Uses the installed library as a stranger would.
#include <locus/bisector_2.h>

#include <cmath>
#include <iostream>

// gcc tells whether the option arrived that interval arithmetic needs; clang has no such macro.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__ROUNDING_MATH__)
#error "locus::locus did not bring -frounding-math"
#endif

int main()
{
  const auto bisector = locus::untrimmed_bisector(locus::segment_2({0, 0}, {1, 0}), locus::segment_2({0, 1}, {1, 1}));
  bool right = bisector.status() == locus::Status::certified && bisector.arcs().size() == 1;
  if (right) {
    const auto middle = bisector.arcs()[0].at(0.5);
    right = std::abs(middle.point()[1] - 0.5) <= middle.error() && middle.error() < 1e-12;
  }
  std::cout << "two parallel segments: " << bisector.status() << ", " << bisector.arcs().size() << " arc"
            << (right ? "" : " (wrong)") << '\n';
  return right ? 0 : 1;
}
