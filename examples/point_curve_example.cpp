// SPDX-License-Identifier: LGPL-3.0-or-later
// All points that are as far from a point as from the nearest point of a cubic: the boundary of the convex cell of what is
// nearer to the point; printed, and drawn into point_curve.svg with what was trimmed.

#include <locus/bisector_2.h>
#include <locus/construct/nearest_feet.h>
#include <locus/io/svg.h>

#include <iostream>

int main()
{
  const auto curve = locus::bezier_2({{0, 0}, {1, 4}, {2, -3}, {3, 1}});
  const locus::Coordinates_2 point{1, "5/2"};

  const auto bisector = locus::bisector(point, curve, {.control = {}, .keep_rational = true});
  std::cout << bisector.status() << ", " << bisector.arcs().size() << " arc(s)\n";
  for (const auto& arc : bisector.arcs()) // input 0 is the point, input 1 the curve
    std::cout << "an arc from " << arc.at(0).point() << " to " << arc.at(1).point() << ", foot: " << name_of(arc.features()[1]) << " of the curve\n";

  for (const auto& v : bisector.vertices()) {
    if (v.kind != locus::Vertex_kind::trim) continue;
    std::cout << "the nearest feet change at " << *v.point << ", radius " << v.radius << ":";
    for (const auto& foot : v.feet)
      if (foot.input == 1) std::cout << "  u = " << foot.parameters[0].lo;
    std::cout << '\n';
  }

  const locus::Coordinates_2 query{1, "5/4"};
  std::cout << "nearer to (1, 5/4): " << name_of(locus::nearer(query, point, curve)) << '\n'; // decided exactly

  locus::write_svg("point_curve.svg", bisector, {curve}, {}, {point.exact()});
  return bisector.status() == locus::Status::certified ? 0 : 1;
}
