// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHARED_ARC_H
#define LOCUS_CONSTRUCT_SHARED_ARC_H

#include <locus/construct/locus.h>

namespace locus {
namespace detail {

/// An arc of another locus.
class Shared_arc : public Arc_geometry<2> {
public:
  explicit Shared_arc(Arc<2> arc) : arc_(std::move(arc)) {}
  Arc_point<2> at(double x) const override { return arc_.at(x); }
  Arc_differential<2> differential(double x) const override { return arc_.differential(x); }
  std::vector<Arc_point<2>> samples(std::size_t n) const override { return arc_.samples(n); }
  Polyline<2> polyline(double tolerance) const override { return arc_.polyline(tolerance); }
  Irregular_points<2> irregular() const override { return arc_.irregular(); }

private:
  Arc<2> arc_;
};

/// The same with feet that stay.
class Fixed_feet_arc final : public Shared_arc {
public:
  Fixed_feet_arc(Arc<2> arc, std::vector<Range> feet) : Shared_arc(std::move(arc)), feet_(std::move(feet)) {}
  Arc_point<2> at(double x) const override { return fixed(Shared_arc::at(x)); }
  std::vector<Arc_point<2>> samples(std::size_t n) const override { return fixed(Shared_arc::samples(n)); }
  Polyline<2> polyline(double tolerance) const override
  {
    const Polyline<2> line = Shared_arc::polyline(tolerance);
    return {fixed(line.points()), line.error()};
  }

private:
  Arc_point<2> fixed(const Arc_point<2>& p) const { return {feet_, p.point(), p.radius(), p.error()}; }
  std::vector<Arc_point<2>> fixed(std::vector<Arc_point<2>> points) const
  {
    for (Arc_point<2>& p : points) p = fixed(p);
    return points;
  }

  std::vector<Range> feet_;
};

} // namespace detail
} // namespace locus

#endif
