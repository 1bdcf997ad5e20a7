// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BISECTOR_3_H
#define LOCUS_BISECTOR_3_H

/// Bisectors in space that are rational surfaces: of two points, of a point and a curve or a surface, of two curves.

#include <locus/construct/bisector_3.h>
#include <locus/shape/constructors_3.h>

#endif
