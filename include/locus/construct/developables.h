// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_DEVELOPABLES_H
#define LOCUS_CONSTRUCT_DEVELOPABLES_H

#include <locus/constraint/curvature_forms.h>
#include <locus/construct/plane_pencil.h>

namespace locus {

// Ruled surfaces along a space curve x = p/w that are rational with it (Chen, Riesenfeld & Cohen, §4), as exact surfaces of
// degree 1 along the rulings. With D1, β and S as in `Curvature_forms` and T = `torsion_form`; generators may be scaled by a
// function of the parameter, so each is given without common factor. Pieces of the curve for which a surface is not defined
// (straight ones, for all but the first) give none.

enum class Ruled_kind : unsigned char {
  // Degrees, in brackets those of a polynomial curve, and never less than d:
  tangent_developable,    ///< x + λD1: 2d-2 (d)
  normal_scroll,          ///< x + λ·β×D1: 5d-8 (3d-5)
  binormal_scroll,        ///< x + λβ: 3d-6 (2d-4)
  rectifying_developable, ///< x + λ(S·T·D1 + w·⟨β,β⟩β), along Darboux's vector τT̄ + κB̄: 10d-18 (6d-12)
  polar_developable       ///< centre of curvature + λβ, the focal surface: 9d-12 (5d-7); `polar_developable_charts` has less
};

constexpr const char* name_of(Ruled_kind k)
{
  constexpr const char* names[] = {"tangent_developable", "normal_scroll", "binormal_scroll", "rectifying_developable",
                                   "polar_developable"};
  return names[static_cast<std::size_t>(k)];
}

namespace detail {

inline Polynomial_vector<1, 3> generator_of(Ruled_kind kind, const Curvature_forms<3>& f, const Curve_piece<3>& piece)
{
  using namespace operators;
  switch (kind) {
  case Ruled_kind::tangent_developable: return f.first;
  case Ruled_kind::normal_scroll: return cross(f.bend, f.first);
  case Ruled_kind::binormal_scroll:
  case Ruled_kind::polar_developable: return f.bend;
  case Ruled_kind::rectifying_developable: break;
  }
  return (f.speed * torsion_form(piece)) * f.first + (piece.weight * square(f.bend)) * f.bend;
}

inline std::optional<Ruled_forms> ruled_forms(Ruled_kind kind, const Curve_piece<3>& piece)
{
  using namespace operators;
  const Curvature_forms<3> f(piece);
  if (kind != Ruled_kind::tangent_developable && is_zero(f.bend)) return std::nullopt;
  Ruled_forms forms{piece.numerator, without_common_factor(generator_of(kind, f, piece)), piece.weight};
  if (kind == Ruled_kind::polar_developable) {
    const Bernstein<Rational, 1> size = square(f.bend), w2 = piece.weight * piece.weight;
    forms.point = (w2 * size) * piece.numerator + f.speed * cross(f.bend, f.first);
    forms.weight = size * w2 * piece.weight;
  }
  forms.reduce();
  return forms;
}

} // namespace detail

/// One of these surfaces, a piece for each piece of the curve.
inline Rational_map<3, 2> ruled_surface(Ruled_kind kind, const Rational_curve<3>& curve, const Ruling_range& rulings = {})
{
  std::vector<Rational_map_piece<3, 2>> pieces;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i)
    if (const auto forms = detail::ruled_forms(kind, curve.pieces()[i]))
      pieces.push_back(forms->over(curve.chain().pieces[i], rulings));
  return Rational_map<3, 2>(std::move(pieces));
}

/// The tangent developable by the polar form h(u, …, u, v) of the homogeneous curve: a point of the tangent at u, that at u
/// itself for v = u. Degree d-1 in u only and 1 in v, which runs over the piece's own range; v goes to infinity on the tangent
/// where the weight vanishes.
inline Rational_map<3, 2> tangent_developable_by_polar_form(const Rational_curve<3>& curve)
{
  using namespace operators;
  std::vector<Rational_map_piece<3, 2>> pieces;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
    const Curve_piece<3> h = detail::homogenised(curve.pieces()[i]);
    const auto polar = [](const Bernstein<Rational, 1>& f) {
      const auto& c = f.coefficients();
      const Degrees<1> lower{f.degree() - 1};
      const Bernstein<Rational, 1> first(lower, {c.begin(), c.end() - 1}), second(lower, {c.begin() + 1, c.end()});
      return detail::lifted(detail::ramp(1, 0), 1) * detail::lifted(first, 0) + detail::lifted(detail::ramp(0, 1), 1) * detail::lifted(second, 0);
    };
    const Piece& range = curve.chain().pieces[i];
    pieces.push_back(rational_map_piece<3, 2>(detail::vector_of<3>([&](std::size_t k) { return polar(h.numerator[k]); }), polar(h.weight), {range, range}));
  }
  return Rational_map<3, 2>(std::move(pieces));
}

/// The polar developable as the lines in which the normal plane meets its neighbour: ⟨D1,X⟩ = ⟨D1,p⟩/w and
/// ⟨D2,X⟩ = ⟨D2,p⟩/w + S/w². By the direct approach (see `Plane_pencil::charts`) of degree 6d-6 (3d-3), in as many charts as needed.
inline std::vector<Ruled_chart> polar_developable_charts(const Rational_curve<3>& curve, const Coordinate_ranges& coordinates)
{
  using namespace operators;
  const auto make_planes = [](const Curve_piece<3>& piece) {
    const Bernstein<Rational, 1>& w = piece.weight;
    Plane_pencil planes;
    planes.normal = {Derivative_vectors<3>(piece).d1(), {}};
    planes.normal[1] = derivative(planes.normal[0]);
    planes.side = {w * dot(planes.normal[0], piece.numerator), w * dot(planes.normal[1], piece.numerator) + square(planes.normal[0])};
    planes.denominator = w * w;
    return planes;
  };
  std::vector<Ruled_chart> charts;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i)
    collect_charts(i, curve.pieces()[i], curve.chain().pieces[i], make_planes, coordinates, charts);
  return charts;
}

} // namespace locus

#endif
