// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_BRUTE_FORCE_SURFACES_H
#define LOCUS_CONSTRAINT_BRUTE_FORCE_SURFACES_H

#include <locus/constraint/brute_force.h>

namespace locus {

// What belongs to a space curve by symbolic NURBS computation without reduction and in the paper's own forms (Chen, Riesenfeld
// & Cohen, §4 and §5): ruled surfaces and bisectors with the degrees along the curve that the paper counts. References to
// measure the surfaces of least degree against. Degrees are for a rational curve of degree d.

/// A foot on another curve, whose parameter is held: what remains depends on one parameter, in which degrees are counted.
struct Held_foot {
  Exact_point<3> point, velocity;

  Held_foot(const Curve_piece<3>& piece, const Rational& u)
  {
    const Rational w = evaluate_at(piece.weight, u), slope = evaluate_at(derivative(piece.weight), u);
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational p = evaluate_at(piece.numerator[k], u);
      point[k] = p / w;
      velocity[k] = (evaluate_at(derivative(piece.numerator[k]), u) * w - p * slope) / (w * w);
    }
  }
};

namespace detail {

using Unreduced_vector = Unreduced_quotient<3>;
/// A ruled surface directrix + λ·generator: six numerators over one denominator.
using Unreduced_ruled = Unreduced_quotient<6>;

inline Polynomial_vector<1, 3> constant_vector(const Exact_point<3>& p)
{
  return vector_of<3>([&](std::size_t k) { return Bernstein<Rational, 1>(Degrees<1>{0}, {p[k]}); });
}

inline Polynomial_vector<1, 6> joined(const Polynomial_vector<1, 3>& a, const Polynomial_vector<1, 3>& b)
{
  return vector_of<6>([&](std::size_t k) { return k < 3 ? a[k] : b[k - 3]; });
}

/// Over the product of both denominators, as a sum would be.
inline Unreduced_ruled ruled(const Unreduced_vector& directrix, const Unreduced_vector& generator)
{
  return Unreduced_ruled(joined(formal_product(generator.denominator(), directrix.numerator()),
                                formal_product(directrix.denominator(), generator.numerator())),
                         formal_product(directrix.denominator(), generator.denominator()));
}

/// Throws std::domain_error where the divisor is identically zero.
inline Unreduced_vector quotient(const Unreduced_vector& a, const Unreduced_scalar& divisor)
{
  if (is_zero(divisor.numerator())) throw std::domain_error("Unreduced_quotient: division by zero");
  return Unreduced_vector(formal_product(divisor.denominator(), a.numerator()),
                          formal_product(a.denominator(), divisor.numerator()[0]));
}

/// The plane through a point with this normal.
struct Unreduced_plane {
  Unreduced_vector normal, point;

  Unreduced_scalar side() const { return dot(normal, point); }
  /// The normal over the denominator of `side`, (5.5): what §5.1 calls the better way.
  Unreduced_vector raised_normal() const
  {
    return Unreduced_vector(formal_product(point.denominator(), normal.numerator()),
                            formal_product(point.denominator(), normal.denominator()));
  }
};

using Unreduced_planes = std::array<Unreduced_plane, 3>;

inline Unreduced_scalar volume(const Unreduced_planes& planes)
{
  return dot(planes[0].normal, cross(planes[1].normal, planes[2].normal));
}

/// The common point by Cramer's rule (5.2), each row of the system over one denominator.
inline Unreduced_vector common_point(const Unreduced_planes& planes)
{
  Polynomial_vector<1, 3> sum;
  Bernstein<Rational, 1> bottom(Degrees<1>{0}, {Rational(1)});
  for (std::size_t i = 0; i < 3; ++i) {
    const auto normals = cross(planes[(i + 1) % 3].raised_normal(), planes[(i + 2) % 3].raised_normal());
    sum = formal_sum(sum, formal_product(planes[i].side().numerator()[0], normals.numerator()));
    bottom = formal_product(bottom, planes[i].side().denominator());
  }
  return quotient(Unreduced_vector(sum, bottom), volume(planes));
}

/// The three determinants of (5.2) with their terms added as they come: those with one right-hand side share a denominator.
inline Unreduced_vector determinants_term_by_term(const Unreduced_planes& planes)
{
  const auto term = [&](std::size_t i) {
    return multiply(planes[i].side(), cross(planes[(i + 1) % 3].normal, planes[(i + 2) % 3].normal));
  };
  return add(add(term(0), term(1)), term(2));
}

/// The normal planes at both feet and the plane half-way, (5.1).
inline Unreduced_planes curve_curve_planes(const Curve_piece<3>& piece, const Held_foot& other)
{
  const Unreduced_vector x = brute_force::point(piece), foot(constant_vector(other.point)), velocity(constant_vector(other.velocity));
  return {{{derivative(x), x}, {velocity, foot}, {subtract(x, foot), multiply(add(x, foot), Rational(1, 2))}}};
}

} // namespace detail

namespace brute_force {

/// (κ²)' in space, κ as in (4.3): degree 12d-12 or 48d.
inline Unreduced_scalar squared_curvature_slope(const Curve_piece<3>& piece)
{
  const auto first = derivative(point(piece)), binormal = cross(first, derivative(first));
  const Unreduced_scalar speed = dot(first, first);
  return derivative(divide(dot(binormal, binormal), multiply(speed, multiply(speed, speed))));
}

/// The centre of curvature by (4.4): 25d.
inline Unreduced_quotient<3> evolute(const Curve_piece<3>& piece)
{
  const auto x = point(piece), first = derivative(x), binormal = cross(first, derivative(first));
  return add(x, multiply(divide(dot(first, first), dot(binormal, binormal)), cross(binormal, first)));
}

/// x + λx': 3d.
inline Unreduced_quotient<6> tangent_developable(const Curve_piece<3>& piece)
{
  const auto x = point(piece);
  return detail::ruled(x, derivative(x));
}

/// x + λ·x'×x'': 7d.
inline Unreduced_quotient<6> binormal_scroll(const Curve_piece<3>& piece)
{
  const auto x = point(piece), first = derivative(x);
  return detail::ruled(x, cross(first, derivative(first)));
}

/// x + λ(x'×x'')×x': 9d.
inline Unreduced_quotient<6> normal_scroll(const Curve_piece<3>& piece)
{
  const auto x = point(piece), first = derivative(x);
  return detail::ruled(x, cross(cross(first, derivative(first)), first));
}

/// x + λ(τ·x' + x'×x''/|x'|²): 39d.
inline Unreduced_quotient<6> rectifying_developable(const Curve_piece<3>& piece)
{
  const auto x = point(piece), first = derivative(x);
  return detail::ruled(x, add(multiply(torsion(piece), first), detail::quotient(cross(first, derivative(first)), dot(first, first))));
}

/// (4.9): 31d.
inline Unreduced_quotient<6> polar_developable(const Curve_piece<3>& piece)
{
  const auto first = derivative(point(piece));
  return detail::ruled(evolute(piece), cross(first, derivative(first)));
}

/// The bisector of a point and a curve by its directrix (5.10), of degree 14d, and its generator: 17d.
inline Unreduced_quotient<6> point_curve_bisector(const Curve_piece<3>& piece, const Exact_point<3>& at)
{
  const detail::Unreduced_vector x = point(piece), q(detail::constant_vector(at)), first = derivative(x), way = subtract(x, q);
  const auto generator = cross(first, way);
  return detail::ruled(
    detail::common_point({{{first, x}, {generator, q}, {way, multiply(add(x, q), Rational(1, 2))}}}), generator);
}

/// The bisector of two curves by (5.1): 8d. The paper prints 6d-2, for which x' would have to be of degree d-1.
inline Unreduced_quotient<3> curve_curve_bisector(const Curve_piece<3>& piece, const Held_foot& other)
{
  return detail::common_point(detail::curve_curve_planes(piece, other));
}

/// Its determinants without looking for common denominators: 11d. The paper prints 8d-3, for the same reason.
inline Unreduced_quotient<3> curve_curve_determinants_term_by_term(const Curve_piece<3>& piece, const Held_foot& other)
{
  return detail::determinants_term_by_term(detail::curve_curve_planes(piece, other));
}

/// The bisector with them: 14d.
inline Unreduced_quotient<3> curve_curve_bisector_term_by_term(const Curve_piece<3>& piece, const Held_foot& other)
{
  const detail::Unreduced_planes planes = detail::curve_curve_planes(piece, other);
  return detail::quotient(detail::determinants_term_by_term(planes), detail::volume(planes));
}

} // namespace brute_force

namespace detail {

/// D1, D2, their product and lengths, as the paper counts them: 2d-1, 2d-2, 4d-3, 4d-2 and 8d-6.
struct Formal_frame {
  Polynomial_vector<1, 3> first, binormal;
  Bernstein<Rational, 1> speed, size;

  explicit Formal_frame(const Curve_piece<3>& piece)
    : first(formal_derivative_vector(piece, 1, 0)), binormal(formal_cross(first, formal_derivative_vector(piece, 2, 0))),
      speed(formal_dot(first, first)), size(formal_dot(binormal, binormal))
  {}
};

/// (p + λ·generator)/w
inline Unreduced_ruled formal_ruled(const Curve_piece<3>& piece, const Polynomial_vector<1, 3>& generator)
{
  return Unreduced_ruled(joined(piece.numerator, generator), piece.weight);
}

/// ⟨normal[i], w·X⟩ = side[i], the polynomial systems (5.6) and (5.12).
struct Formal_planes {
  std::array<Polynomial_vector<1, 3>, 3> normal;
  std::array<Bernstein<Rational, 1>, 3> side;

  Unreduced_vector common_point(const Bernstein<Rational, 1>& w) const
  {
    Polynomial_vector<1, 3> sum;
    for (std::size_t i = 0; i < 3; ++i)
      sum = formal_sum(sum, formal_product(side[i], formal_cross(normal[(i + 1) % 3], normal[(i + 2) % 3])));
    return Unreduced_vector(sum, formal_product(w, formal_dot(normal[0], formal_cross(normal[1], normal[2]))));
  }
};

/// p - wQ and the half of p² - (wQ)², 2d.
struct Formal_way {
  Polynomial_vector<1, 3> way;
  Bernstein<Rational, 1> half_squares;

  Formal_way(const Curve_piece<3>& piece, const Exact_point<3>& at)
  {
    const auto there = formal_product(piece.weight, constant_vector(at));
    way = vector_of<3>([&](std::size_t k) { return formal_difference(piece.numerator[k], there[k]); });
    half_squares = multiply(formal_difference(formal_dot(piece.numerator, piece.numerator), formal_dot(there, there)), Rational(1, 2));
  }
};

} // namespace detail

namespace paper_form {

/// τ = w²[D1 D2 D3]/|D1×D2|² (4.6): 8d-6.
inline Unreduced_scalar torsion_quotient(const Curve_piece<3>& piece)
{
  using namespace detail;
  return Unreduced_scalar({formal_product(formal_product(piece.weight, piece.weight), torsion(piece))}, Formal_frame(piece).size);
}

/// p/w + |D1|²(D1×D2)×D1/(w²|D1×D2|²), of the polar developable: 10d-6.
inline Unreduced_quotient<3> evolute(const Curve_piece<3>& piece)
{
  using namespace detail;
  const Formal_frame f(piece);
  const auto bottom = formal_product(piece.weight, f.size);
  return Unreduced_quotient<3>(
    formal_sum(formal_product(bottom, piece.numerator), formal_product(f.speed, formal_cross(f.binormal, f.first))),
    formal_product(bottom, piece.weight));
}

/// (p + λD1)/w: 2d-1.
inline Unreduced_quotient<6> tangent_developable(const Curve_piece<3>& piece)
{
  return detail::formal_ruled(piece, detail::formal_derivative_vector(piece, 1, 0));
}

/// (p + λ·D1×D2)/w: 4d-3.
inline Unreduced_quotient<6> binormal_scroll(const Curve_piece<3>& piece)
{
  return detail::formal_ruled(piece, detail::Formal_frame(piece).binormal);
}

/// (p + λ(D1×D2)×D1)/w: 6d-4.
inline Unreduced_quotient<6> normal_scroll(const Curve_piece<3>& piece)
{
  const detail::Formal_frame f(piece);
  return detail::formal_ruled(piece, detail::formal_cross(f.binormal, f.first));
}

/// x + λ([D1 D2 D3]/|D1×D2|²·D1 + D1×D2/|D1|²): 13d-8.
inline Unreduced_quotient<6> rectifying_developable(const Curve_piece<3>& piece)
{
  using namespace detail;
  const Formal_frame f(piece);
  const Unreduced_vector along(formal_product(torsion(piece), f.first), f.size), across(f.binormal, f.speed);
  return ruled(brute_force::point(piece), add(along, across));
}

/// Below (4.9): the evolute + (μ/w⁴)D1×D2, which the paper leaves as a sum. Over w⁴|D1×D2|², the least that the terms' own
/// denominators have in common: 12d-6.
inline Unreduced_quotient<6> polar_developable(const Curve_piece<3>& piece)
{
  using namespace detail;
  const Unreduced_vector centre = evolute(piece);
  const auto w2 = formal_product(piece.weight, piece.weight);
  const Formal_frame f(piece);
  return Unreduced_ruled(joined(formal_product(w2, centre.numerator()), formal_product(f.size, f.binormal)),
                         formal_product(w2, centre.denominator()));
}

/// (5.12) with the generator D1×(x - Q): 10d-3.
inline Unreduced_quotient<6> point_curve_bisector(const Curve_piece<3>& piece, const Exact_point<3>& at)
{
  using namespace detail;
  const Formal_way f(piece, at);
  const auto first = formal_derivative_vector(piece, 1, 0), generator = formal_cross(first, f.way);
  const auto side = formal_product(piece.weight, formal_dot(constant_vector(at), generator));
  const Formal_planes planes{{first, generator, f.way}, {formal_dot(piece.numerator, first), side, f.half_squares}};
  return ruled(planes.common_point(piece.weight), Unreduced_vector(generator, piece.weight));
}

/// (5.13) without denominators, the coordinate k being the rulings' parameter λ: 4d-1.
inline Unreduced_quotient<6> point_curve_bisector_direct(const Curve_piece<3>& piece, const Exact_point<3>& at, std::size_t k = 2)
{
  using namespace detail;
  const Formal_way f(piece, at);
  const auto first = formal_derivative_vector(piece, 1, 0);
  Exact_point<3> axis{};
  axis[k] = 1;
  // The third plane is ⟨e, wX⟩ = λw: for λ = 0 it gives the directrix, and what λ adds is the generator.
  const Formal_planes planes{{first, f.way, constant_vector(axis)},
                             {formal_dot(piece.numerator, first), f.half_squares, Bernstein<Rational, 1>(Degrees<1>{0})}};
  const auto line = formal_product(piece.weight, formal_cross(first, f.way));
  const auto directrix = planes.common_point(piece.weight);
  return Unreduced_ruled(joined(directrix.numerator(), line), directrix.denominator());
}

/// (5.6): 4d-1.
inline Unreduced_quotient<3> curve_curve_bisector(const Curve_piece<3>& piece, const Held_foot& other)
{
  using namespace detail;
  const Formal_way f(piece, other.point);
  const auto first = formal_derivative_vector(piece, 1, 0), velocity = constant_vector(other.velocity);
  const auto side = formal_product(piece.weight, formal_dot(constant_vector(other.point), velocity));
  const Formal_planes planes{{first, velocity, f.way}, {formal_dot(piece.numerator, first), side, f.half_squares}};
  return planes.common_point(piece.weight);
}

} // namespace paper_form

} // namespace locus

#endif
