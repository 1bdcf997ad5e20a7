// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_APPROXIMATE_POINT_H
#define LOCUS_CONSTRUCT_APPROXIMATE_POINT_H

#include <array>
#include <cstddef>
#include <ostream>

namespace locus {

/// A closed range of doubles that contains an exact value.
struct Range {
  double lo = 0, hi = 0;
};

/// A point of the plane or of space, in doubles; how far it may be from the exact one is said where it is given.
template <int Dim>
struct Approximate_point {
  std::array<double, static_cast<std::size_t>(Dim)> coordinates{};

  double operator[](std::size_t k) const { return coordinates[k]; }
  double& operator[](std::size_t k) { return coordinates[k]; }
};

template <int Dim>
std::ostream& operator<<(std::ostream& out, const Approximate_point<Dim>& p)
{
  for (std::size_t k = 0; k < p.coordinates.size(); ++k) out << (k ? " " : "") << p[k];
  return out;
}

} // namespace locus

#endif
