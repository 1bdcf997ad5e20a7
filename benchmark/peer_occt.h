// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BENCHMARK_PEER_OCCT_H
#define LOCUS_BENCHMARK_PEER_OCCT_H

// The peer OCCT: Bisector_BisecCC, one arc of the bisector of two curves, in doubles and without proof. It wants to be
// told on which side of either curve the arc lies and a point to start from; what fits is found here by trying.

#include "plain_curve.h"

#include <Bisector_BisecCC.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>

#include <optional>

namespace locus_benchmark {

struct Occt_call {
  bool swapped = false;
  double side_of_first = 1, side_of_second = 1;
  Point origin;
};

inline Handle(Geom2d_Curve) occt_curve(const Plain_curve& c)
{
  const int n = static_cast<int>(c.control().size());
  TColgp_Array1OfPnt2d poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 1; i <= n; ++i) {
    const auto k = static_cast<std::size_t>(i - 1);
    poles(i) = gp_Pnt2d(c.control()[k].x, c.control()[k].y);
    weights(i) = c.weights()[k];
  }
  return new Geom2d_BezierCurve(poles, weights);
}

/// The arc of that call at so many points: curves, construction and evaluation. Empty where OCCT gives up.
inline std::vector<Point> occt_arc(const Plain_curve& first, const Plain_curve& second, const Occt_call& call, int points)
{
  std::vector<Point> arc;
  try {
    const Handle(Geom2d_Curve) a = occt_curve(call.swapped ? second : first), b = occt_curve(call.swapped ? first : second);
    const Handle(Bisector_BisecCC) bisector = new Bisector_BisecCC();
    bisector->Perform(a, b, call.side_of_first, call.side_of_second, gp_Pnt2d(call.origin.x, call.origin.y));
    if (bisector->IsEmpty()) return arc;
    const double from = bisector->FirstParameter(), to = bisector->LastParameter();
    for (int i = 0; i < points; ++i) {
      gp_Pnt2d p;
      bisector->D0(from + (to - from) * i / (points - 1), p);
      arc.push_back({p.X(), p.Y()});
    }
  } catch (const Standard_Failure&) {
    arc.clear();
  }
  return arc;
}

inline double length(const std::vector<Point>& arc)
{
  double sum = 0;
  for (std::size_t i = 1; i < arc.size(); ++i) sum += distance(arc[i - 1], arc[i]);
  return sum;
}

struct Occt_best {
  Occt_call call;
  std::size_t right = 0; ///< points whose distances to both curves agree to 1e-6
  std::size_t tried = 0, answered = 0;
};

/// The call with the most right points, of equals the longest arc.
inline std::optional<Occt_best> best_occt_call(const Plain_curve& first, const Plain_curve& second,
                                               const std::vector<Point>& origins, int points)
{
  Occt_best best;
  double best_length = 0;
  for (const Point& origin : origins)
    for (const bool swapped : {false, true})
      for (const double side_1 : {-1.0, 1.0})
        for (const double side_2 : {-1.0, 1.0}) {
          const Occt_call call{swapped, side_1, side_2, origin};
          const auto arc = occt_arc(first, second, call, points);
          ++best.tried;
          if (arc.empty()) continue;
          ++best.answered;
          std::size_t right = 0;
          for (const Point& p : arc) right += residual(first, second, p) <= 1e-6;
          if (right < best.right || (right == best.right && length(arc) <= best_length)) continue;
          best.call = call;
          best.right = right;
          best_length = length(arc);
        }
  if (best.answered == 0) return std::nullopt;
  return best;
}

} // namespace locus_benchmark

#endif
