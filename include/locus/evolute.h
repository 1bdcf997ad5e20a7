// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_EVOLUTE_H
#define LOCUS_EVOLUTE_H

/// Evolutes, focal curves and developable surfaces of curves, exactly and as drawn loci.

#include <locus/construct/developables.h>
#include <locus/construct/evolute.h>
#include <locus/construct/focal_curve.h>
#include <locus/shape/constructors_3.h>

#endif
