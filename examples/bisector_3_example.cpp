// SPDX-License-Identifier: LGPL-3.0-or-later
// The ruled bisector of a point and a helix-like curve, exactly and as a mesh with a proved error, written to point_helix.ply;
// after Figure 4 of Chen, Riesenfeld & Cohen.

#include <locus/bisector_3.h>
#include <locus/io/mesh.h>

#include <iostream>

int main()
{
  const locus::Exact_point<3> point{0, 0, locus::Rational(1, 2)};
  const auto curve = locus::bezier_3({{1, 0, 0}, {1, 1, "1/2"}, {0, 1, 1}}, {1, "7/10", 1});
  locus::Mesh_options options;
  options.tolerance = 5e-3; // of the inputs' diameter
  const auto bisector = locus::untrimmed_bisector(point, curve, options);

  for (const auto& chart : bisector.rational_surface()->pieces())
    std::cout << "chart of degree " << chart.degrees()[0] << " and " << chart.degrees()[1] << " over u from " << chart.range[0].lo << " to "
              << chart.range[0].hi << '\n';
  for (const auto& sheet : bisector.sheets())
    std::cout << bisector.status() << " sheet of " << sheet.triangles.size() << " triangles, within " << sheet.error << '\n';

  locus::write_ply("point_helix.ply", bisector.sheets());
  return bisector.status() == locus::Status::certified ? 0 : 1;
}
