// SPDX-License-Identifier: LGPL-3.0-or-later
// Where a spline's curvature is extremal, has kinks or vanishes, and its evolute as an exact rational curve; drawn into
// curvature.svg as in Figure 1 of Chen, Riesenfeld & Cohen.

#include <locus/curvature.h>
#include <locus/evolute.h>
#include <locus/io/svg.h>

#include <iostream>

int main()
{
  const auto curve = locus::bspline_2(3, {{0, 0}, {1, 4}, {4, 5}, {7, 3}, {5, 0}, {8, -2}, {11, 2}, {12, 5}, {15, 4}},
                                      {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6});
  const auto analysis = locus::analyse_curvature(curve);
  for (const auto& p : analysis.points) // the parameters are enclosures of exact roots
    std::cout << name_of(p.kind) << " at u = " << p.parameter.lo << ", point " << p.point << ", curvature " << p.curvature.lo << '\n';

  const auto evolute = locus::evolute(curve);
  std::cout << "evolute: " << evolute.status() << ", " << evolute.arcs().size() << " arc(s), degree " << evolute.equations()[0].degrees[0] << '\n';
  for (const auto& arc : evolute.arcs())
    for (const auto& cusp : arc.irregular().points) std::cout << "  cusp at " << cusp.point() << ", u = " << cusp.parameter(0) << '\n';

  const auto circle = locus::osculating_circle(curve, locus::Rational(1, 2)); // exact at a rational parameter
  std::cout << "centre of curvature at u = 1/2: (" << circle->centre[0] << ", " << circle->centre[1] << ")\n";

  locus::write_svg("curvature.svg", evolute, {curve}, analysis.points);
  return evolute.status() == locus::Status::certified ? 0 : 1;
}
