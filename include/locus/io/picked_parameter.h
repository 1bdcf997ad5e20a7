// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_PICKED_PARAMETER_H
#define LOCUS_IO_PICKED_PARAMETER_H

#include <locus/construct/locus.h>

#include <cmath>

namespace locus {

namespace detail {

/// One value of a range: its middle, or the finite end of a half-infinite one. Never "not a number".
inline double picked(const Range& r)
{
  if (r.lo == r.hi || std::isinf(r.hi)) return r.lo;
  return std::isinf(r.lo) ? r.hi : r.lo + 0.5 * (r.hi - r.lo);
}

} // namespace detail

} // namespace locus

#endif
