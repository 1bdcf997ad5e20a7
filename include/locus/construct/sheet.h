// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_H
#define LOCUS_CONSTRUCT_SHEET_H

#include <locus/construct/approximate_point.h>

#include <string>
#include <vector>

namespace locus {

/// A loop of edges that have a triangle on one side only: vertices in order, the last joined with the first, with the
/// sheet on the left in the parameters.
struct Sheet_boundary {
  /// Why the sheet ends: at the end of its parameters ("domain"), where it was cut off at the cut radius ("infinity"),
  /// around a point where it is proved to be 0/0 or a hole that was asked for ("singular"), at a part about which nothing
  /// is claimed ("undecided").
  /// Of a loop with several causes the first of "infinity", "singular", "undecided" that occurs.
  std::string kind;
  std::vector<std::size_t> loop;
};

/// One connected component of a surface as triangles that share their vertices. Each edge is in two triangles or once in
/// a boundary loop; the triangles around a vertex form one fan.
struct Sheet {
  std::vector<Approximate_point<3>> points;
  std::vector<std::vector<double>> parameters; ///< of each point
  std::vector<double> radius;                  ///< of each point, its distance to the feet
  std::vector<std::array<std::size_t, 3>> triangles; ///< turning left in the parameters
  std::vector<Sheet_boundary> boundary;
  int euler = 0; ///< vertices - edges + triangles
  /// Proved bound, in the inputs' units, of the distance of each point of the triangles to the surface and of each point of
  /// this part of the surface to the triangles; the points' rounding is included.
  double error = 0;
};

} // namespace locus

#endif
