// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANAR_SOLUTION_H
#define LOCUS_CONSTRUCT_PLANAR_SOLUTION_H

#include <locus/construct/bisector_map_2.h>
#include <locus/construct/locus.h>
#include <locus/construct/parameter_range.h>
#include <locus/shape/frame.h>
#include <locus/zero_set/patchwork.h>

#include <algorithm>
#include <cmath>

namespace locus {

/// What belongs to one patch of the zero set, beside its graph: the map to the plane and both inputs' parameters.
struct Planar_patch {
  Bisector_map_2 map;
  std::array<std::size_t, 2> piece{0, 0}; ///< of both inputs
  std::array<Parameter_range, 2> domain;
  /// The graph's vertices whose image is the point where the curves touch: 1, or -1 where the curves run against each other
  /// there. May be empty.
  std::vector<signed char> at_contact;

  int contact_at(std::size_t vertex) const { return vertex < at_contact.size() ? at_contact[vertex] : 0; }

  /// The inputs' parameters at a place of the patch's chart.
  std::array<Range, 2> parameters(const std::array<Interval, 2>& at) const
  {
    const std::array<Interval, 2> p = map.chart()(at);
    return {domain[0].at(p[0]), domain[1].at(p[1])};
  }
};

/// Everything that the arcs of one planar bisector share: immutable once made.
struct Planar_solution {
  Frame<2> frame;
  std::array<Interval, 2> origin; ///< of the frame
  std::vector<Planar_patch> patches; ///< as in `work.patches`
  Patchwork work;
  double scale = 1;            ///< diameter of the inputs, in the frame
  double cut_radius = 10;      ///< in the frame, from `centre`
  Vector_2<double> centre;     ///< of the inputs' bounding box, in the frame
};

namespace detail {

/// A point of an arc during evaluation, in the frame and in the coordinates of its patch's chart.
struct Placed {
  const Planar_patch* patch = nullptr;
  std::array<Interval, 2> at;
  Vector_2<Interval> point;
  Interval radius;
  int between = 0; ///< on a branch whose circles lie between the curves, up to their contact: as Planar_patch::at_contact
};

inline void narrow(Vector_2<Interval>& point, const Vector_2<Interval>& box)
{
  point = {common_part(box.x, point.x), common_part(box.y, point.y)};
}

/// `between`: see Placed. A half-branch may be told, on which the whole box lies.
inline Placed place(const Planar_patch& patch, const std::array<Interval, 2>& at, int between = 0, std::optional<std::size_t> half_branch = {})
{
  const Map_formula formula = patch.map.choose({midpoint(at[0]), midpoint(at[1])});
  auto image = patch.map.at(at, formula);
  if (between != 0)
    if (const auto box = patch.map.between_curves(at, between)) narrow(image.point, *box);
  if (half_branch)
    for (const Contact_place& node : patch.map.nodes())
      if (const Node_direction* cone = node.cone_of(*half_branch)) narrow(image.point, patch.map.near_node(node, at, *cone));
  const Vector_2<Interval> arm = image.point - image.first_foot;
  return {&patch, at, image.point, CGAL::sqrt(CGAL::square(arm.x) + CGAL::square(arm.y)), between};
}

/// At a vertex of the patch's graph.
inline Placed place_vertex(const Planar_patch& patch, std::size_t vertex, const std::array<Interval, 2>& at)
{
  const int contact = patch.contact_at(vertex);
  if (contact == 0) return place(patch, at);
  return {&patch, at, patch.map.first().point(patch.map.chart()(at)[0]), Interval(0), contact};
}

inline double diameter(const Vector_2<Interval>& box) { return std::hypot(width(box.x), width(box.y)) * (1 + 8 * operation_error); }

/// The point in the user's coordinates, with a proved bound of the printed doubles' distance from the exact one.
inline Arc_point<2> finished(const Planar_solution& s, const Placed& p)
{
  Approximate_point<2> point;
  double error = 0;
  const std::array<Interval, 2> xy{s.frame.length(p.point.x) + s.origin[0], s.frame.length(p.point.y) + s.origin[1]};
  for (std::size_t k = 0; k < 2; ++k) {
    point[k] = representative(xy[k]);
    error = std::hypot(error, std::max(xy[k].sup() - point[k], point[k] - xy[k].inf()));
  }
  const Interval radius = s.frame.length(p.radius);
  const auto parameters = p.patch->parameters(p.at);
  return {{parameters[0], parameters[1]}, point, std::max(0.0, representative(radius)), error * (1 + 8 * operation_error)};
}

} // namespace detail

} // namespace locus

#endif
