// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BISECTOR_2_H
#define LOCUS_BISECTOR_2_H

/// Bisectors in the plane: constructors of curves, `untrimmed_bisector` of curves and of a point and a curve, `bisector` of two curves,
/// of a curve with itself, of a point and a curve and of two points, distances, `nearer` and `nearest_input`.

#include <locus/construct/nearest_feet.h>
#include <locus/construct/nearest_input.h>
#include <locus/construct/point_curve_bisector.h>
#include <locus/construct/point_curve_map.h>
#include <locus/construct/point_point_bisector_2.h>
#include <locus/construct/true_bisector_2.h>
#include <locus/construct/untrimmed_bisector_2.h>
#include <locus/shape/constructors_2.h>
#include <locus/shape/edit_curve.h>

#endif
