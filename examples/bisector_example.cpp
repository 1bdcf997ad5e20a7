// SPDX-License-Identifier: LGPL-3.0-or-later
// All pairs of points of two curves whose normals meet at equal distance: printed, and drawn into bisector.svg.

#include <locus/bisector_2.h>
#include <locus/io/svg.h>

#include <iostream>

int main()
{
  const auto a =
    locus::bezier_2({{0, 0}, {1, 2}, {2, -1}, {3, 1}}); // coordinates are exact: ints, doubles, "5/2", "0.1"
  const auto b = locus::bezier_2({{0, 3}, {1, "5/2"}, {2, 4}, {3, 3}});

  const auto bisector = locus::untrimmed_bisector(a, b, {.control = {}, .keep_cells = true});
  std::cout << bisector.status() << ", " << bisector.arcs().size() << " arc(s)\n";
  for (const auto& arc : bisector.arcs()) {
    std::cout << "an arc\n";
    for (const auto& p : arc.polyline(1e-3)) // proved to lie within 1e-3 of the inputs' diameter, both ways
      std::cout << "  " << p.point() << "  feet " << p.parameter(0) << ' ' << p.parameter(1) << "  radius "
                << p.radius() << '\n';
  }

  locus::write_svg("bisector.svg", bisector, {a, b});
  return bisector.status() == locus::Status::certified ? 0 : 1;
}
