// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_MESH_OPTIONS_H
#define LOCUS_CONSTRUCT_MESH_OPTIONS_H

#include <locus/zero_set/solve_control.h>

namespace locus {

/// How surfaces are drawn. Where `max_cells` or the control's time ends the work a mesh's error is greater than asked for, or
/// boxes stay undecided: each sheet tells its own error.
struct Mesh_options {
  double tolerance = 1e-2;        ///< greatest distance between mesh and surface, as a part of the inputs' diameter
  std::size_t max_cells = 400000; ///< of one surface, to look at
  Solve_control control{};        ///< time, cancellation, progress; limits of the equations that are solved besides
};

} // namespace locus

#endif
