// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_EVOLUTE_H
#define LOCUS_CONSTRUCT_EVOLUTE_H

#include <locus/construct/derived_curves.h>
#include <locus/construct/rational_locus.h>

#include <chrono>

namespace locus {

/// The evolute of a curve in the plane or in space, the locus of its centres of curvature, as arcs: they go to infinity at
/// inflections (certified roots, with asymptotes), have cusps (`Arc::irregular`), in the plane where the curvature is stationary, and break
/// off at corners and where the curvature jumps. Straight pieces have none; circular ones give isolated points, listed as
/// degenerate too. `Locus::rational_curve` has it exactly, at its true degree. Upward of O(d²) rational operations a piece.
template <int Dim>
Locus<Dim> evolute(const Rational_curve<Dim>& curve)
{
  const auto start = std::chrono::steady_clock::now();
  return with_upward_rounding([&] {
    const Rational_map<Dim, 1> map = evolute_map(curve);
    Locus_data<Dim> data = detail::Rational_locus_maker<Dim>(curve, map).make();
    data.compute = "evolute";
    data.equations.push_back({"evolute", {map.degrees()[0]}});
    data.rational_curve = map;
    data.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return Locus<Dim>(std::move(data));
  });
}

} // namespace locus

#endif
