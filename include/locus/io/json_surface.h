// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_SURFACE_H
#define LOCUS_IO_JSON_SURFACE_H

#include <locus/io/json_inputs.h>

namespace locus {

namespace detail {

/// What degrees, control points, weights and knots of a surface say, checked as far as their numbers go.
struct Surface_data {
  Degrees<2> degrees{};
  std::array<std::size_t, 2> size{}; ///< rows, points in a row
  std::vector<Exact_point<3>> points;
  std::vector<Rational> weights;
  std::optional<Knot_array<2>> knots;
};

inline void read_surface_degrees(const Json_value& v, const std::string& place, Surface_data& data)
{
  const std::string degrees_place = member(place, "degrees"), remedy = "give both degrees, like [2, 2]";
  const auto& list = require_list(require_key(v, place, "degrees", remedy), degrees_place, remedy);
  if (list.size() != 2)
    throw Invalid_input(degrees_place, std::to_string(list.size()) + " degrees for two parameters", remedy);
  for (std::size_t k = 0; k < 2; ++k) data.degrees[k] = read_degree(list[k], element(degrees_place, k));
}

inline void read_surface_points(const Json_value& v, const std::string& place, Dimension& dimension, Surface_data& data)
{
  const std::string points_place = member(place, "control_points");
  const std::string remedy = "list rows of points, the first index running with the first parameter";
  const auto& rows = require_list(require_key(v, place, "control_points", remedy), points_place, remedy);
  data.size = {rows.size(), 0};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string row_place = element(points_place, i);
    const auto& row = require_list(rows[i], row_place, remedy);
    if (i == 0) data.size[1] = row.size();
    if (row.size() != data.size[1])
      throw Invalid_input(
        row_place, std::to_string(row.size()) + " points in a row, but " + std::to_string(data.size[1]) + " in the first",
        "make all rows equally long");
    for (std::size_t j = 0; j < row.size(); ++j) {
      const auto p = read_point(row[j], element(row_place, j), dimension);
      if (p.size() != 3)
        throw Invalid_input(element(row_place, j), "a surface's points have 3 coordinates, not 2", "write [x, y, z]");
      data.points.push_back({p[0], p[1], p[2]});
    }
  }
}

inline void require_surface_size(const Surface_data& data, bool has_knots, const std::string& place)
{
  for (std::size_t k = 0; k < 2; ++k) {
    const auto order = static_cast<std::size_t>(data.degrees[k]) + 1;
    if (has_knots ? data.size[k] < order : data.size[k] != order)
      throw Invalid_input(member(place, "control_points"),
                          std::to_string(data.size[k]) + (k == 0 ? " rows" : " points in a row") + " for degree " +
                            std::to_string(data.degrees[k]),
                          std::string(has_knots ? "give at least" : "give") + " degree + 1 = " + std::to_string(order));
  }
}

inline void read_surface_weights(const Json_value& v, const std::string& place, Surface_data& data)
{
  const auto& rows = require_list(v, place, "list rows of weights, one for each control point");
  if (rows.size() != data.size[0])
    throw Invalid_input(place,
                        std::to_string(rows.size()) + " rows of weights for " + std::to_string(data.size[0]) +
                          " rows of control points",
                        "give one weight for each control point, or none");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = read_numbers(rows[i], element(place, i));
    if (row.size() != data.size[1])
      throw Invalid_input(element(place, i),
                          std::to_string(row.size()) + " weights for " + std::to_string(data.size[1]) + " control points",
                          "give one weight for each control point, or none");
    data.weights.insert(data.weights.end(), row.begin(), row.end());
  }
}

inline void read_surface_knots(const Json_value& v, const std::string& place, Surface_data& data)
{
  const auto& lists = require_list(v, place, "give two lists of knots");
  if (lists.size() != 2)
    throw Invalid_input(place, std::to_string(lists.size()) + " lists of knots for two parameters", "give two lists of knots");
  data.knots.emplace();
  for (std::size_t k = 0; k < 2; ++k)
    (*data.knots)[k] = read_knots(lists[k], element(place, k), data.degrees[k], data.size[k], data.degrees[k]);
}

inline void read_surface(const Json_value& v, const std::string& place, Dimension& dimension, Job_input& input)
{
  input.kind = Job_input::Kind::surface;
  require_object(v, place, {"degrees", "control_points", "weights", "knots"},
                 "{\"degrees\": [1,1], \"control_points\": [[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]}");
  Surface_data data;
  read_surface_degrees(v, place, data);
  read_surface_points(v, place, dimension, data);
  const Json_value* const knots = v.find("knots");
  require_surface_size(data, knots != nullptr, place);
  if (const Json_value* weights = v.find("weights")) read_surface_weights(*weights, member(place, "weights"), data);
  if (knots) read_surface_knots(*knots, member(place, "knots"), data);
  input.dimension = 3;
  if (!is_affordable(std::max(data.degrees[0], data.degrees[1]), "surfaces", input)) return;
  fill(input, place, [&] {
    input.surface = data.knots
                      ? bspline_surface(data.degrees, data.points, {(*data.knots)[0].values, (*data.knots)[1].values}, data.weights)
                      : bezier_surface(data.degrees, data.points, data.weights);
  });
}

} // namespace detail

} // namespace locus

#endif
