// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_TANGENT_PLANE_H
#define LOCUS_SHAPE_TANGENT_PLANE_H

#include <locus/function/polynomial_vector.h>

namespace locus {

/// The tangent planes of a surface in homogeneous coordinates h = (p, w): the vector (M, m) with ⟨M, X⟩ + m = 0 on the plane
/// at each point, of the minors of h, h_u and h_v. M is ±w³·x_u×x_v. Of degree 3d-2 in each parameter
/// where formal degrees promise 3d-1, since leading terms cancel.
inline Polynomial_vector<2, 4> tangent_plane(const Polynomial_vector<2, 4>& h)
{
  const Polynomial_vector<2, 4> hu = derivative(h, 0), hv = derivative(h, 1);
  return detail::vector_of<4>([&](std::size_t k) {
    std::array<std::size_t, 3> c{};
    for (std::size_t j = 0, n = 0; j < 4; ++j)
      if (j != k) c[n++] = j;
    const auto columns = [&](const Polynomial_vector<2, 4>& row) { return Polynomial_vector<2, 3>{row[c[0]], row[c[1]], row[c[2]]}; };
    const Bernstein<Rational, 2> minor = bracket(columns(h), columns(hu), columns(hv));
    return k % 2 == 0 ? minor : multiply(minor, Rational(-1));
  });
}

} // namespace locus

#endif
