// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANAR_PIECES_H
#define LOCUS_CONSTRUCT_PLANAR_PIECES_H

#include <locus/constraint/f3_factors.h>
#include <locus/constraint/span_bound.h>
#include <locus/construct/extent.h>
#include <locus/construct/planar_solution.h>
#include <locus/function/diagonal.h>
#include <locus/function/rational_root.h>
#include <locus/shape/edit_curve.h>

namespace locus {
namespace detail {

/// The pieces of one input in a common frame, as the constraints, the purging tests and the map to the plane need them.
struct Planar_pieces {
  Chain chain;
  std::vector<std::shared_ptr<const Planar_curve>> curves;
  std::vector<Span_bound> bounds;
  std::vector<Parameter_range> ranges;

  Planar_pieces(const Curve_2& curve, const Frame<2>& frame) : chain(curve.chain())
  {
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      curves.push_back(std::make_shared<const Planar_curve>(curve.pieces()[i], frame));
      bounds.emplace_back(*curves.back());
      ranges.emplace_back(chain.pieces[i]);
    }
    evaluators_.resize(curves.size());
  }

  std::size_t size() const { return curves.size(); }

  const Bisector_map_2::Evaluator& evaluator(std::size_t i) const
  {
    if (!evaluators_[i]) evaluators_[i] = std::make_shared<const Curve_evaluator>(*curves[i]);
    return evaluators_[i];
  }

  /// What a foot at a local parameter lies on.
  Feature feature_at(std::size_t piece, const Interval& u) const
  {
    for (int end = 0; end < 2; ++end) {
      if (u.inf() != end || u.sup() != end) continue;
      const Joint* joint = chain.joint_at(piece, end);
      if (!joint) return end == 0 ? Feature::start : Feature::end;
      return joint->kind == Joint_kind::corner ? Feature::corner : Feature::interior;
    }
    return Feature::interior;
  }

private:
  mutable std::vector<Bisector_map_2::Evaluator> evaluators_;
};

/// An end of a piece in homogeneous coordinates, with the direction of the tangent there.
struct Piece_end {
  Exact_point<2> numerator, tangent;
  Rational weight;

  Piece_end(const Planar_curve& c, int end)
  {
    const auto value = [end](const Bernstein<Rational, 1>& f) { return f[end == 0 ? 0 : f.size() - 1]; };
    for (std::size_t v = 0; v < 2; ++v) {
      numerator[v] = value(c.numerator(v));
      tangent[v] = value(c.tangent(v));
    }
    weight = value(c.weight());
  }
};

/// How two pieces meet at ends of theirs, if they do. F3 is singular, beyond a node, where they touch or one rests.
enum class End_meeting : unsigned char {
  none,
  crosses, ///< a common finite point
  rests,   ///< the same, and one of them stands still there
  touches  ///< a common finite point with one tangent line, or both are infinite there
};

inline End_meeting meeting_at(const Planar_curve& p, int p_end, const Planar_curve& q, int q_end)
{
  const auto end_of = [](const Bernstein<Interval, 1>& f, int end) { return f[end == 0 ? 0 : f.size() - 1]; };
  for (std::size_t v = 0; v < 2; ++v) { // most pieces are far apart
    const Interval left = end_of(p.numerator_enclosure(v), p_end) * end_of(q.weight_enclosure(), q_end);
    const Interval right = end_of(q.numerator_enclosure(v), q_end) * end_of(p.weight_enclosure(), p_end);
    if (!overlap(left, right)) return End_meeting::none;
  }
  const Piece_end a(p, p_end), b(q, q_end);
  if (a.weight == 0 || b.weight == 0) return a.weight == b.weight ? End_meeting::touches : End_meeting::none;
  for (std::size_t v = 0; v < 2; ++v)
    if (a.numerator[v] * b.weight != b.numerator[v] * a.weight) return End_meeting::none;
  if (a.tangent[0] * b.tangent[1] == a.tangent[1] * b.tangent[0]) return End_meeting::touches;
  return p.is_singular_at(p_end) || q.is_singular_at(q_end) ? End_meeting::rests : End_meeting::crosses;
}

/// The corners of two pieces' cell where they touch, or else the only one where they meet and one of them stands still: of
/// several such corners none is worth a cut, which might divide an axis.
inline std::vector<std::array<int, 2>> touching_corners(const Planar_curve& p, const Planar_curve& q)
{
  std::vector<std::array<int, 2>> touching, resting;
  for (const int s : {0, 1})
    for (const int e : {0, 1}) {
      const End_meeting meeting = meeting_at(p, s, q, e);
      if (meeting == End_meeting::touches) touching.push_back({s, e});
      else if (meeting == End_meeting::rests) resting.push_back({s, e});
    }
  return touching.empty() && resting.size() == 1 ? resting : touching;
}

/// Whether two pieces that touch at opposite corners of their cell coincide.
inline bool coincide(const Planar_curve& p, const Planar_curve& q, bool reversed)
{
  if (p.is_circle() || q.is_circle()) return p.carrier().kind == q.carrier().kind;
  const auto ratio = matching_ratio(p, q, reversed);
  if (!ratio) return false;
  Scaled_form f = scaled_form<F3_form>(p, q);
  return f.is_zero() || divide_by_diagonal(f, {reversed, *ratio}) > 1;
}

/// Whether the cell of two pieces has more than one corner where they touch, so that it must be cut. Pieces that coincide
/// touch at two corners as well; what is left of F3 without their overlap is singular there only if they are.
inline bool touch_more_than_once(const Planar_curve& p, const Planar_curve& q)
{
  const auto corners = touching_corners(p, q);
  if (corners.size() < 2) return false;
  const bool opposite = corners[0][0] != corners[1][0] && corners[0][1] != corners[1][1];
  const bool singular_twice = p.is_singular_at(0) && p.is_singular_at(1);
  return !(opposite && !singular_twice && coincide(p, q, corners[0][0] != corners[0][1]));
}

/// Where inside a piece the end of another one touches it (lies on it with the same tangent line), at a rational parameter:
/// a candidate where an overlap begins, and singular in any case.
inline std::optional<Rational> touch_inside(const Planar_curve& p, int p_end, const Planar_curve& q)
{
  std::array<Bernstein<Interval, 1>, 2> apart;
  const auto end_of = [p_end](const auto& f) { return f[p_end == 0 ? 0 : f.size() - 1]; };
  for (std::size_t v = 0; v < 2; ++v) {
    const Interval x = end_of(p.numerator_enclosure(v)), w = end_of(p.weight_enclosure());
    Sign all = Sign::unknown;
    for (std::size_t i = 0; i < q.numerator_enclosure(v).size(); ++i) {
      const auto& weight = q.weight_enclosure();
      const Sign s = sign_of(q.numerator_enclosure(v)[i] * w - x * weight[weight.size() == 1 ? 0 : i]);
      all = i == 0 || s == all ? s : Sign::unknown;
    }
    if (is_strict(all)) return std::nullopt;
  }
  const Piece_end end(p, p_end);
  if (end.weight == 0) return std::nullopt;
  Integer_polynomial common;
  for (std::size_t v = 0; v < 2; ++v) {
    const auto difference = subtract(multiply(q.numerator(v), end.weight), multiply(q.weight(), end.numerator[v]));
    common = gcd(common, monomial_form(Bernstein<Scaled_integer, 1>(difference)));
  }
  if (degree(common) < 1) return std::nullopt;
  for (const auto& root : exact_roots(bernstein_form(common), Rational(0), Rational(1)).roots) {
    const std::optional<Rational> r = rational_value(root);
    if (!r || *r <= 0 || *r >= 1) continue;
    if (end.tangent[0] * evaluate_at(q.tangent(1), *r) == end.tangent[1] * evaluate_at(q.tangent(0), *r)) return r;
  }
  return std::nullopt;
}

/// A piece whose ends meet smoothly, or that is infinite at both.
inline bool touches_itself(const Planar_curve& p) { return meeting_at(p, 0, p, 1) == End_meeting::touches; }

/// Finite value in the middle of a piece's local range.
inline Rational middle_of(const Piece& range) { return *range.at(Rational(1, 2)); }

/// Where an input must be cut so that no cell has several corners to blow up, and pieces that overlap do so from end to end.
struct Necessary_cut {
  std::size_t input;
  Rational at; ///< parameter value
};

inline std::optional<Necessary_cut> cut_of_one_piece(const Planar_pieces& pieces, std::size_t input, bool is_self)
{
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Planar_curve& c = *pieces.curves[i];
    const bool singular_twice = is_self && c.is_singular_at(0) && c.is_singular_at(1); // infinite, or at rest
    if (singular_twice || (is_self && touches_itself(c)) || (c.is_infinite_at(0) && c.is_infinite_at(1)))
      return Necessary_cut{input, middle_of(pieces.chain.pieces[i])};
  }
  return std::nullopt;
}

inline std::optional<Necessary_cut> cut_of_pair(const Planar_pieces& first, std::size_t i, const Planar_pieces& second, std::size_t j)
{
  const Planar_curve &p = *first.curves[i], &q = *second.curves[j];
  if (p.carrier().kind != Carrier::Kind::general && q.carrier().kind == p.carrier().kind) return std::nullopt;
  for (const int end : {0, 1}) {
    if (const auto r = touch_inside(p, end, q)) return Necessary_cut{1, *second.chain.pieces[j].at(*r)};
    if (const auto t = touch_inside(q, end, p)) return Necessary_cut{0, *first.chain.pieces[i].at(*t)};
  }
  if (!touch_more_than_once(p, q)) return std::nullopt;
  const auto corners = touching_corners(p, q);
  return corners[0][0] != corners[1][0] ? Necessary_cut{0, middle_of(first.chain.pieces[i])}
                                        : Necessary_cut{1, middle_of(second.chain.pieces[j])};
}

inline std::optional<Necessary_cut> necessary_cut(const Planar_pieces& first, const Planar_pieces& second, bool is_self)
{
  if (auto cut = cut_of_one_piece(first, 0, is_self)) return cut;
  if (auto cut = cut_of_one_piece(second, 1, is_self)) return cut;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < (is_self ? i : second.size()); ++j)
      if (!are_apart(first.bounds[i], second.bounds[j]))
        if (auto cut = cut_of_pair(first, i, second, j)) return cut;
  return std::nullopt;
}

inline void measure_inputs(const std::vector<Exact_point<2>>& points, Planar_solution& solution)
{
  const Extent<2> extent = extent_in<2>(solution.frame, points);
  solution.scale = extent.scale;
  solution.cut_radius = cut_factor * solution.scale;
  solution.centre = {extent.centre[0], extent.centre[1]};
}

} // namespace detail
} // namespace locus

#endif
