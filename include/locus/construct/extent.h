// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_EXTENT_H
#define LOCUS_CONSTRUCT_EXTENT_H

#include <locus/shape/framed.h>

namespace locus {
namespace detail {

/// Loci to infinity are drawn up to this multiple of the inputs' diameter.
inline constexpr double cut_factor = 10;

/// The bounding box of points in frame coordinates: the length of its diagonal, and its middle, in doubles.
template <int Dim>
struct Extent {
  double scale = 0;
  std::array<double, static_cast<std::size_t>(Dim)> centre{};
};

/// Upward rounding needed.
template <int Dim>
Extent<Dim> extent_in(const Frame<Dim>& frame, const std::vector<Exact_point<Dim>>& points)
{
  Extent<Dim> extent;
  double square = 0;
  for (std::size_t k = 0; k < extent.centre.size(); ++k) {
    Interval lo(0), hi(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Interval x = enclosing(frame.into(points[i][k], k));
      lo = i == 0 ? x : Interval(std::min(lo.inf(), x.inf()), std::min(lo.sup(), x.sup()));
      hi = i == 0 ? x : Interval(std::max(hi.inf(), x.inf()), std::max(hi.sup(), x.sup()));
    }
    const double length = midpoint(Interval(hi - lo));
    square += length * length;
    extent.centre[k] = midpoint(hull(lo, hi));
  }
  extent.scale = std::sqrt(square);
  return extent;
}

} // namespace detail
} // namespace locus

#endif
