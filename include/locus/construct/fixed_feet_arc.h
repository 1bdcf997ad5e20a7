// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_FIXED_FEET_ARC_H
#define LOCUS_CONSTRUCT_FIXED_FEET_ARC_H

#include <locus/construct/locus.h>

namespace locus {
namespace detail {

/// An arc with feet that stay.
class Fixed_feet_arc final : public Arc_geometry<2> {
public:
  Fixed_feet_arc(std::shared_ptr<const Arc_geometry<2>> arc, std::vector<Range> feet) : arc_(std::move(arc)), feet_(std::move(feet)) {}

  Arc_point<2> at(double x) const override { return fixed(arc_->at(x)); }
  Arc_differential<2> differential(double x) const override { return arc_->differential(x); }
  std::vector<Arc_point<2>> samples(std::size_t n) const override { return fixed(arc_->samples(n)); }
  Polyline<2> polyline(double relative_tolerance) const override
  {
    const Polyline<2> line = arc_->polyline(relative_tolerance);
    return {fixed(line.points()), line.error()};
  }
  Irregular_points<2> irregular() const override { return arc_->irregular(); }

private:
  Arc_point<2> fixed(const Arc_point<2>& p) const { return {feet_, p.point(), p.radius(), p.error()}; }
  std::vector<Arc_point<2>> fixed(std::vector<Arc_point<2>> points) const
  {
    for (Arc_point<2>& p : points) p = fixed(p);
    return points;
  }

  std::shared_ptr<const Arc_geometry<2>> arc_;
  std::vector<Range> feet_;
};

} // namespace detail
} // namespace locus

#endif
