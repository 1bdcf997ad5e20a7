// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_UNTRIMMED_BISECTOR_2_H
#define LOCUS_CONSTRUCT_UNTRIMMED_BISECTOR_2_H

#include <locus/construct/locus.h>
#include <locus/shape/rational_curve.h>
#include <locus/zero_set/solve_control.h>

namespace locus {

struct Bisector_options {
  Solve_control control;
  bool keep_cells = false; ///< keep the cells of the subdivision in the result, for pictures
};

Locus<2> untrimmed_bisector(const Curve_2& first, const Curve_2& second, const Bisector_options& options = {});

} // namespace locus

#endif
