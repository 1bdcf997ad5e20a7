// SPDX-License-Identifier: LGPL-3.0-or-later
// A closed spline with itself: where two of its normals meet at equal distance. Drawn into self_bisector.svg.

#include <locus/bisector_2.h>
#include <locus/io/svg.h>

#include <iostream>

int main()
{
  // The first three control points again at the end: the seam is a joint like the others.
  const auto curve = locus::bspline_2(3,
                                      {{2, 0}, {1.5, 1.5}, {0, 2}, {-1.5, 1}, {-2, -0.5}, {-0.5, -1.5}, {1, -1.25},
                                       {2, 0}, {1.5, 1.5}, {0, 2}},
                                      {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13}, {}, true);

  const auto bisector = locus::untrimmed_bisector(curve, {.control = {}, .keep_cells = true});
  std::cout << bisector.status() << ", " << bisector.arcs().size() << " arc(s)\n";
  for (const auto& vertex : bisector.vertices()) {
    std::cout << name_of(vertex.kind);
    for (const auto& foot : vertex.feet) std::cout << "  u = " << foot.parameters[0].lo;
    std::cout << "  radius " << vertex.radius << '\n'; // on the diagonal: the radius of curvature where it is extreme
  }

  locus::write_svg("self_bisector.svg", bisector, {curve});
  return bisector.status() == locus::Status::certified ? 0 : 1;
}
