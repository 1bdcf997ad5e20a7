// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CURVATURE_H
#define LOCUS_CURVATURE_H

// Curvature of plane curves: where it is extremal or jumps, with the centres of curvature there.

#include <locus/construct/curvature_extrema_2.h>
#include <locus/shape/constructors_2.h>

#endif
