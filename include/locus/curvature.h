// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CURVATURE_H
#define LOCUS_CURVATURE_H

// Curvature of curves in the plane and in space: where it is extremal, jumps or vanishes, where the torsion vanishes, and the
// osculating circle.

#include <locus/construct/curvature_points.h>
#include <locus/shape/constructors_2.h>

#endif
