// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BENCHMARK_PEER_SEGMENTS_H
#define LOCUS_BENCHMARK_PEER_SEGMENTS_H

// The peer Boost.Polygon: both curves as chains of segments between integer points, and of their Voronoi diagram the
// edges that separate the two.

#include "plain_curve.h"

#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>

#include <cstdint>

namespace locus_benchmark {

/// The vertices of the separating edges. The error falls with the square of the number of segments a curve.
inline std::vector<Point> segment_voronoi(const Plain_curve& first, const Plain_curve& second, int segments_a_curve)
{
  using Integer_point = boost::polygon::point_data<std::int32_t>;
  constexpr double scale = 1 << 28; // of integers per unit: the cases reach to ±4
  std::vector<boost::polygon::segment_data<std::int32_t>> segments;
  for (const Plain_curve* c : {&first, &second}) {
    const auto rounded = [&](int i) {
      const Point p = c->at(static_cast<double>(i) / segments_a_curve);
      return Integer_point(static_cast<std::int32_t>(std::lround(p.x * scale)), static_cast<std::int32_t>(std::lround(p.y * scale)));
    };
    Integer_point from = rounded(0);
    for (int i = 1; i <= segments_a_curve; ++i) {
      const Integer_point to = rounded(i);
      segments.emplace_back(from, to);
      from = to;
    }
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
  std::vector<Point> vertices;
  const auto is_of_first = [&](const auto* cell) { return cell->source_index() < static_cast<std::size_t>(segments_a_curve); };
  for (const auto& edge : diagram.edges()) {
    if (!edge.is_primary() || is_of_first(edge.cell()) == is_of_first(edge.twin()->cell()) || !is_of_first(edge.cell())) continue;
    if (edge.vertex0()) vertices.push_back({edge.vertex0()->x() / scale, edge.vertex0()->y() / scale});
  }
  return vertices;
}

} // namespace locus_benchmark

#endif
