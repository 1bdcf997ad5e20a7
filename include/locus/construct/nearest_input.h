// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_NEAREST_INPUT_H
#define LOCUS_CONSTRUCT_NEAREST_INPUT_H

#include <locus/construct/nearest_feet.h>

namespace locus {

/// Which of several curves a point is nearest to.
struct Nearest_input {
  /// A curve at the least distance, with its nearest feet.
  struct Candidate {
    std::size_t input = 0;
    Nearest_feet feet;
  };

  std::vector<Candidate> nearest; ///< several in an exact tie, by the inputs' numbers
  Range distance;                 ///< encloses the least distance

  bool is_tie() const { return nearest.size() > 1; }
};

/// Locates a point among curves: which is nearest to q, its ends and corners included, decided exactly. Distances are compared in
/// enclosures first, then as algebraic numbers. Cost: `nearest_feet` for every curve. Throws std::invalid_argument where there is no curve, and what `nearest_feet` throws.
inline Nearest_input nearest_input(const std::vector<const Curve_2*>& curves, const Coordinates_2& q)
{
  if (curves.empty()) throw std::invalid_argument("nearest_input: no curves");
  Nearest_input result;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Nearest_feet feet = nearest_feet(*curves[i], q);
    int order = -1; // of this distance beside the least so far
    if (!result.nearest.empty()) {
      const auto& best = result.nearest.front();
      if (feet.distance.lo > best.feet.distance.hi) order = 1;
      else if (feet.distance.hi < best.feet.distance.lo) order = -1;
      else order = squared_distance(*curves[i], q, feet.feet[feet.nearest[0]]).compare(squared_distance(*curves[best.input], q, best.feet.feet[best.feet.nearest[0]]));
    }
    if (order > 0) continue;
    if (order < 0) result.nearest.clear();
    result.nearest.push_back({i, std::move(feet)});
  }
  result.distance = result.nearest.front().feet.distance;
  for (const auto& c : result.nearest) {
    result.distance.lo = std::max(result.distance.lo, c.feet.distance.lo);
    result.distance.hi = std::min(result.distance.hi, c.feet.distance.hi);
  }
  return result;
}

/// The same for two curves.
inline Nearest_input nearest_input(const Curve_2& first, const Curve_2& second, const Coordinates_2& q) { return nearest_input({&first, &second}, q); }

} // namespace locus

#endif
