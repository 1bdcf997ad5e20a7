// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_JOINTS_H
#define LOCUS_SHAPE_JOINTS_H

#include <locus/shape/parameter_form.h>

namespace locus {

namespace detail {

/// A curve near one end of a piece: numerators and weight as polynomials in δ, which grows along the curve and is 0 there.
template <int Dim>
struct Curve_germ {
  std::array<Coefficient_list, static_cast<std::size_t>(Dim)> numerator;
  Coefficient_list weight;
};

template <int Dim>
Curve_germ<Dim> germ_of(const Curve_piece<Dim>& piece, const Piece& range, bool at_finish)
{
  const Curve_piece<Dim> forms = homogenised(piece);
  Curve_germ<Dim> germ;
  for (std::size_t k = 0; k < germ.numerator.size(); ++k) germ.numerator[k] = form_about(range, at_finish, forms.numerator[k]);
  germ.weight = form_about(range, at_finish, forms.weight);
  return germ;
}

template <int Dim>
Rational dot(const Exact_point<Dim>& a, const Exact_point<Dim>& b)
{
  Rational sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// The first derivative of the point that does not vanish: a vector along the curve's direction of travel, and its order.
template <int Dim>
struct Tangent_ray {
  Exact_point<Dim> direction{};
  std::size_t order = 0;
};

/// Of a germ with nonzero weight at 0. x - x(0) = (p·w(0) - p(0)·w)/(w·w(0)) starts with δ^k; on the left side, where δ is
/// negative, a point with even k moves against that coefficient.
template <int Dim>
Tangent_ray<Dim> tangent_ray(const Curve_germ<Dim>& germ, bool left_side)
{
  Tangent_ray<Dim> ray;
  for (std::size_t k = 1; k < germ.weight.size(); ++k) {
    bool vanishes = true;
    for (std::size_t v = 0; v < ray.direction.size(); ++v) {
      ray.direction[v] = germ.numerator[v][k] * germ.weight[0] - germ.numerator[v][0] * germ.weight[k];
      vanishes = vanishes && ray.direction[v] == 0;
    }
    if (vanishes) continue;
    ray.order = k;
    if (left_side && k % 2 == 0)
      for (Rational& x : ray.direction) x = -x;
    return ray;
  }
  throw std::logic_error("locus: a piece that is a single point has no tangent");
}

/// The order to which two germs with nonzero weights agree: the first power of δ in which they differ, `any_order` where
/// they are one function. Read off p⁻w⁺ - p⁺w⁻.
template <int Dim>
int contact_order(const Curve_germ<Dim>& left, const Curve_germ<Dim>& right)
{
  std::size_t first = std::numeric_limits<std::size_t>::max();
  for (std::size_t v = 0; v < left.numerator.size(); ++v) {
    const Coefficient_list a = product(left.numerator[v], right.weight), b = product(right.numerator[v], left.weight);
    std::size_t k = 0;
    while (k < a.size() && k < first && a[k] == b[k]) ++k;
    if (k < a.size()) first = std::min(first, k);
  }
  return first == std::numeric_limits<std::size_t>::max() ? Joint::any_order : static_cast<int>(first);
}

/// A rational number below sin(angle), and near it for small angles; angles above 1 count as 1.
inline Rational sine_from_below(const Rational& angle)
{
  const Rational t = angle < 1 ? angle : Rational(1), t2 = t * t;
  return Rational(t * (1 - t2 / 6 * (1 - t2 / 20 * (1 - t2 / 42))));
}

/// Do the curves turn by less than `tolerance` (radians)? Sines are compared, squared and exact; a turn so near the
/// tolerance that the bound cannot tell counts as greater.
template <int Dim>
bool turns_by_less(const Exact_point<Dim>& a, const Exact_point<Dim>& b, const Rational& tolerance)
{
  const Rational along = dot<Dim>(a, b);
  if (tolerance <= 0 || along <= 0) return false;
  const Rational sizes = dot<Dim>(a, a) * dot<Dim>(b, b), bound = sine_from_below(tolerance);
  return Rational(sizes - along * along) < Rational(bound * bound * sizes);
}

/// How two germs meet. `comparable`: their parameters δ are of one kind, so that orders of continuity have a meaning.
template <int Dim>
Joint joint_of(const Curve_germ<Dim>& left, const Curve_germ<Dim>& right, bool comparable, const Rational& tolerance)
{
  Joint joint;
  if (left.weight[0] == 0 || right.weight[0] == 0) {
    joint.kind = Joint_kind::pole;
    joint.order = 0;
    return joint;
  }
  const Tangent_ray<Dim> a = tangent_ray(left, true), b = tangent_ray(right, false);
  const Rational along = dot<Dim>(a.direction, b.direction);
  const bool parallel = along > 0 && Rational(along * along) ==
                                       Rational(dot<Dim>(a.direction, a.direction) * dot<Dim>(b.direction, b.direction));
  joint.order = 0;
  if (!parallel) {
    joint.by_tolerance = turns_by_less<Dim>(a.direction, b.direction, tolerance);
    joint.kind = joint.by_tolerance ? Joint_kind::g1 : Joint_kind::corner;
    return joint;
  }
  joint.kind = Joint_kind::g1;
  if (!comparable || a.order > 1 || b.order > 1) return joint;
  const int contact = contact_order(left, right);
  if (contact < 2) return joint;
  joint.kind = Joint_kind::smooth;
  joint.order = contact == Joint::any_order ? contact : contact - 1;
  return joint;
}

/// Do two germs start from one point? Two points at infinity count as one: the curve passes through a pole.
template <int Dim>
bool meet(const Curve_germ<Dim>& left, const Curve_germ<Dim>& right)
{
  if ((left.weight[0] == 0) != (right.weight[0] == 0)) return false;
  for (std::size_t v = 0; v < left.numerator.size(); ++v)
    if (left.numerator[v][0] * right.weight[0] != right.numerator[v][0] * left.weight[0]) return false;
  return true;
}

} // namespace detail

/// Whether a piece's end is followed by a piece's start: the same point, or both at infinity.
template <int Dim>
bool meet(const Curve_piece<Dim>& left, const Piece& left_range, const Curve_piece<Dim>& right, const Piece& right_range)
{
  return detail::meet(detail::germ_of(left, left_range, true), detail::germ_of(right, right_range, false));
}

/// How the finish of one piece meets the start of the next (or, for a seam, of the first), decided exactly.
/// - pole: the weight vanishes there; the points themselves are not asked.
/// - smooth: tangents agree, neither first derivative by the parameter vanishes, and `order` derivatives of the point agree
///   (u = ∞: by 1/u).
/// - g1: the directions of travel agree, nothing more: first derivatives differ, or one vanishes.
/// - corner: the direction of travel turns or reverses. It is that of the first derivative that does not vanish.
/// A corner that turns by less than `tolerance` (radians, at most 1) is g1 with `by_tolerance`.
/// O(degree²) operations on rationals. Neither piece is a single point.
template <int Dim>
Joint joint_between(const Curve_piece<Dim>& left, const Piece& left_range, const Curve_piece<Dim>& right,
                    const Piece& right_range, const Rational& tolerance = 0)
{
  return detail::joint_of(detail::germ_of(left, left_range, true), detail::germ_of(right, right_range, false),
                          left_range.hi_infinite == right_range.lo_infinite, tolerance);
}

/// A curve of pieces that follow each other, the joints between them found out; `closed` adds the seam, from the last
/// piece to the first. Throws Invalid_input where neighbours do not meet.
template <int Dim>
Rational_curve<Dim> joined_curve(std::vector<Curve_piece<Dim>> pieces, std::vector<Piece> ranges, bool closed,
                                 const Rational& tolerance = 0)
{
  Chain chain;
  const std::size_t n = pieces.size(), joints = closed ? n : n - 1;
  for (std::size_t k = 0; k < joints; ++k) {
    const std::size_t next = (k + 1) % n;
    const auto left = detail::germ_of(pieces[k], ranges[k], true), right = detail::germ_of(pieces[next], ranges[next], false);
    if (!detail::meet(left, right)) {
      if (k + 1 == n)
        throw Invalid_input(".closed", "the ends of the curve do not coincide",
                            "let it end where it starts, or leave out \"closed\"");
      throw Invalid_input(".pieces[" + std::to_string(next) + "]", "does not start where the piece before it ends",
                          "let each piece start at the end of the one before it");
    }
    chain.joints.push_back(detail::joint_of(left, right, ranges[k].hi_infinite == ranges[next].lo_infinite, tolerance));
  }
  chain.pieces = std::move(ranges);
  return Rational_curve<Dim>(std::move(pieces), std::move(chain));
}

/// The same curve, corners that turn by less than `tolerance` (radians, at least 0, above 1 taken as 1) made g1 joints with
/// `by_tolerance`; 0 restores the exact joints.
template <int Dim>
Rational_curve<Dim> with_join_tolerance(const Rational_curve<Dim>& curve, const Rational& tolerance)
{
  return joined_curve(curve.pieces(), curve.chain().pieces, curve.chain().is_closed(), tolerance);
}

} // namespace locus

#endif
