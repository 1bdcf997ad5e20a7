// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_MESH_OPTIONS_H
#define LOCUS_CONSTRUCT_MESH_OPTIONS_H

#include <locus/function/checkpoint.h>

#include <cstddef>

namespace locus {

/// How surfaces are drawn. Where `max_cells` ends the work a mesh's error is greater than asked for: each sheet tells its own.
struct Mesh_options {
  double tolerance = 1e-2;          ///< greatest distance between mesh and surface, as a part of the inputs' diameter
  std::size_t max_cells = 400000;   ///< to look at
  Checkpoint checkpoint;            ///< may stop the work by throwing `Stopped`; what is left is drawn coarsely or undecided
  std::function<void(std::size_t done, std::size_t open)> progress; ///< called now and then with numbers of cells
};

} // namespace locus

#endif
