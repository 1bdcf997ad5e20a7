// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BENCHMARK_PEER_OCCT_POINT_H
#define LOCUS_BENCHMARK_PEER_OCCT_POINT_H

// The peer OCCT: Bisector_BisecPC, the bisector of a curve and a point on one side of the curve, in doubles and without
// proof. A point of it is the one on the normal at the parameter that is equally far from the curve's point and from the
// given point, up to the distance 500. Its header asks for monotone curvature, but Perform takes any curve.

#include "peer_occt.h"

#include <Bisector_BisecPC.hxx>

namespace locus_benchmark {

/// Curve and construction; side 1 is left of the curve, side -1 right of it. Null where OCCT gives up or finds nothing.
inline Handle(Bisector_BisecPC) occt_point_bisector(const Plain_curve& curve, const Point& p, double side)
{
  try {
    const Handle(Bisector_BisecPC) bisector = new Bisector_BisecPC();
    bisector->Perform(occt_curve(curve), gp_Pnt2d(p.x, p.y), side);
    if (!bisector->IsEmpty()) return bisector;
  } catch (const Standard_Failure&) {
  }
  return {};
}

/// The same and so many points, evenly from the first to the last parameter. Empty where OCCT gives up or finds nothing.
inline std::vector<Point> occt_point_arc(const Plain_curve& curve, const Point& p, double side, int points)
{
  std::vector<Point> arc;
  const Handle(Bisector_BisecPC) bisector = occt_point_bisector(curve, p, side);
  if (bisector.IsNull()) return arc;
  try {
    const double from = bisector->FirstParameter(), to = bisector->LastParameter();
    for (int i = 0; i < points; ++i) {
      gp_Pnt2d q;
      bisector->D0(from + (to - from) * i / (points - 1), q);
      arc.push_back({q.X(), q.Y()});
    }
  } catch (const Standard_Failure&) {
    arc.clear();
  }
  return arc;
}

} // namespace locus_benchmark

#endif
