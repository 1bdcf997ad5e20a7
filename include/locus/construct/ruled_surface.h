// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_RULED_SURFACE_H
#define LOCUS_CONSTRUCT_RULED_SURFACE_H

#include <locus/shape/rational_map.h>

namespace locus {

/// The part of each ruling that a surface has: directrix + λ·generator for λ from lo to hi.
struct Ruling_range {
  Rational lo = -1, hi = 1;
};

namespace detail {

/// A polynomial in one variable as one in two that depends on the given one of them.
inline Bernstein<Rational, 2> lifted(const Bernstein<Rational, 1>& f, int variable)
{
  return {variable == 0 ? Degrees<2>{f.degree(), 0} : Degrees<2>{0, f.degree()}, f.coefficients()};
}

template <std::size_t N>
Polynomial_vector<2, N> lifted(const Polynomial_vector<1, N>& f, int variable)
{
  return vector_of<N>([&](std::size_t k) { return lifted(f[k], variable); });
}

inline Piece finite_piece(const Rational& lo, const Rational& hi)
{
  Piece p;
  p.lo = lo;
  p.hi = hi;
  return p;
}

/// The linear function that runs from lo to hi.
inline Bernstein<Rational, 1> ramp(const Rational& lo, const Rational& hi) { return {Degrees<1>{1}, {lo, hi}}; }

/// The polynomials of one variable that a ruled surface (point + λ·generator)/weight consists of.
struct Ruled_forms {
  Polynomial_vector<1, 3> point, generator;
  Bernstein<Rational, 1> weight;

  /// Divides out the factor that all have in common.
  void reduce()
  {
    const auto all = without_common_factor(
      vector_of<7>([&](std::size_t k) { return k < 3 ? point[k] : k < 6 ? generator[k - 3] : weight; }));
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = all[k];
      generator[k] = all[k + 3];
    }
    weight = all[6];
  }

  Rational_map_piece<3, 2> over(const Piece& range, const Ruling_range& rulings) const
  {
    using namespace operators;
    const Bernstein<Rational, 2> lambda = lifted(ramp(rulings.lo, rulings.hi), 1);
    return rational_map_piece<3, 2>(lifted(point, 0) + lambda * lifted(generator, 0), lifted(weight, 0),
                                    {range, finite_piece(rulings.lo, rulings.hi)});
  }
};

} // namespace detail
} // namespace locus

#endif
