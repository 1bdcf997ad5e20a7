// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BISECTOR_2_H
#define LOCUS_BISECTOR_2_H

/// Bisectors of curves in the plane: constructors of curves and `untrimmed_bisector`.

#include <locus/construct/untrimmed_bisector_2.h>
#include <locus/shape/constructors_2.h>
#include <locus/shape/edit_curve.h>

#endif
