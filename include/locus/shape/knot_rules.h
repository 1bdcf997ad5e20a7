// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_KNOT_RULES_H
#define LOCUS_SHAPE_KNOT_RULES_H

#include <locus/function/knots.h>
#include <locus/shape/invalid_input.h>

#include <string>
#include <vector>

namespace locus {

namespace detail {

/// The rules for knots that users give: control points + degree + 1 of them, not decreasing, none more than degree + 1
/// times (inside the domain `inner_repeats` times), a domain with a length. Throws Invalid_input, with the index where
/// there is one.
inline void require_knots(const Knots& knots, std::size_t points, int inner_repeats, const std::string& place)
{
  const auto& u = knots.values;
  const std::string degree = std::to_string(knots.degree);
  const std::size_t order = static_cast<std::size_t>(knots.degree) + 1, wanted = points + order;
  if (u.size() != wanted)
    throw Invalid_input(place,
                        std::to_string(u.size()) + " knots for " + std::to_string(points) + " control points of degree " + degree,
                        "give " + std::to_string(wanted) + ": control points + degree + 1");
  int repeated = 1;
  for (std::size_t i = 1; i < u.size(); ++i) {
    const std::string at = place + "[" + std::to_string(i) + "]";
    if (u[i] < u[i - 1])
      throw Invalid_input(at, "knots must not decrease, but " + u[i].get_str() + " follows " + u[i - 1].get_str(), "sort them");
    repeated = u[i] == u[i - 1] ? repeated + 1 : 1;
    const bool inside = knots.domain_lo() < u[i] && u[i] < knots.domain_hi();
    if (repeated > (inside ? inner_repeats : knots.degree + 1))
      throw Invalid_input(at, "a knot is repeated too often for degree " + degree,
                          "repeat an end knot at most degree + 1 times, an inner knot at most degree times");
  }
  if (knots.domain_lo() == knots.domain_hi())
    throw Invalid_input(place, "the knots span no interval", "let knots[degree] be less than knots[number of control points]");
}

} // namespace detail

} // namespace locus

#endif
