// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BENCHMARK_CASES_H
#define LOCUS_BENCHMARK_CASES_H

// The pairs of curves that the benchmarks solve, as a program holds them: control points and weights, exact.

#include <locus/shape/rational_curve.h>

#include <string>
#include <vector>

namespace locus_benchmark {

struct Curve_data {
  std::vector<locus::Coordinates_2> points;
  std::vector<locus::Number> weights;

  locus::Curve_2 curve() const { return locus::bezier_2(points, weights); }
};

struct Case {
  std::string name;
  Curve_data first, second;
};

/// The same pair after x ↦ factor·x + shift, exactly.
inline Case moved(const Case& from, const std::string& name, const locus::Number& factor, const locus::Number& shift)
{
  Case result = from;
  result.name = name;
  for (Curve_data* c : {&result.first, &result.second})
    for (locus::Coordinates_2& p : c->points)
      for (locus::Number* x : {&p.x, &p.y}) *x = locus::Rational(x->value() * factor.value() + shift.value());
  return result;
}

inline Case quad_quad()
{
  return {"quad_quad", {{{-1, 0.75}, {0, 0.25}, {1, 1}}, {}}, {{{-1, -1}, {0.25, -0.125}, {1, -0.5}}, {}}};
}

inline Case cubic_cubic()
{
  return {"cubic_cubic", {{{0, 0}, {1, 2}, {2, -1}, {3, 1}}, {}}, {{{0, 3}, {1, 2.5}, {2, 4}, {3, 3}}, {}}};
}

/// A cubic and its image in the line y = -2: many coefficients of the equation are exactly zero.
inline Case mirror_images()
{
  return {"mirror_images", {{{0, 0}, {1, 2}, {2, -1}, {3, 1}}, {}}, {{{0, -4}, {1, -6}, {2, -3}, {3, -5}}, {}}};
}

inline std::vector<Case> all_cases()
{
  return {
    {"line_quad", {{{-1, 1}, {0, 0}, {1, 1}}, {}}, {{{-1, -0.25}, {1, -0.75}}, {}}},
    quad_quad(),
    cubic_cubic(),
    {"ellipse_arc_cubic",
     {{{2, 0}, {2, 1}, {0, 1}}, {1, 1, 2}},
     {{{-1, -1}, {0.5, 0.5}, {1, -1}, {3, -0.5}}, {}}},
    mirror_images(),
    {"crossing_cubics", {{{0, 0}, {1, 2}, {2, -1}, {3, 1}}, {}}, {{{0, 0.875}, {1, -1}, {2, 1.5}, {3, -0.25}}, {}}},
    moved(quad_quad(), "quad_quad_moved_by_1e8", 1, "1e8"),
    moved(quad_quad(), "quad_quad_times_1e-300", "1e-300", 0),
    moved(quad_quad(), "quad_quad_times_1e200", "1e200", 0),
  };
}

} // namespace locus_benchmark

#endif
