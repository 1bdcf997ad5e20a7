// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_EDIT_CURVE_H
#define LOCUS_SHAPE_EDIT_CURVE_H

#include <locus/shape/joints.h>

#include <iterator>

namespace locus {

// Changes of a curve's description that keep its points: direction, degree, cuts, seam and parameter. Exact.

/// The map u ↦ (a·u + b)/(c·u + d) of a parameter.
struct Moebius_map {
  Rational a = 1, b = 0, c = 0, d = 1;

  Rational determinant() const { return Rational(a * d - b * c); }
  /// Where c·u + d does not vanish.
  Rational operator()(const Rational& u) const { return Rational((a * u + b) / (c * u + d)); }
};

namespace detail {

inline Piece mirrored(const Piece& p)
{
  Piece m;
  m.lo = -p.hi;
  m.hi = -p.lo;
  m.lo_infinite = p.hi_infinite;
  m.hi_infinite = p.lo_infinite;
  return m;
}

inline Bernstein<Rational, 1> mirrored(const Bernstein<Rational, 1>& f)
{
  return {f.degrees(), std::vector<Rational>(f.coefficients().rbegin(), f.coefficients().rend())};
}

} // namespace detail

/// The curve run through backwards, with the parameter -u.
template <int Dim>
Rational_curve<Dim> reversed(const Rational_curve<Dim>& curve)
{
  const Chain& old = curve.chain();
  std::vector<Curve_piece<Dim>> pieces;
  Chain chain;
  chain.pieces.clear();
  for (std::size_t k = old.pieces.size(); k-- > 0;) {
    pieces.push_back(
      detail::changed(curve.pieces()[k], [](const Bernstein<Rational, 1>& f) { return detail::mirrored(f); }));
    chain.pieces.push_back(detail::mirrored(old.pieces[k]));
  }
  // The seam stays the last joint.
  const auto inner = old.joints.end() - (old.is_closed() ? 1 : 0);
  chain.joints.assign(std::make_reverse_iterator(inner), old.joints.rend());
  if (old.is_closed()) chain.joints.push_back(old.joints.back());
  return Rational_curve<Dim>(std::move(pieces), std::move(chain));
}

/// The curve with the degree of each piece raised; the weight of a polynomial piece stays of degree 0.
template <int Dim>
Rational_curve<Dim> elevated(const Rational_curve<Dim>& curve, int by)
{
  std::vector<Curve_piece<Dim>> pieces = curve.pieces();
  for (auto& piece : pieces) {
    for (auto& x : piece.numerator) x = elevate(x, 0, by);
    if (!piece.is_polynomial()) piece.weight = elevate(piece.weight, 0, by);
  }
  return Rational_curve<Dim>(std::move(pieces), curve.chain());
}

/// The curve with a piece cut in two at the parameter `u`; unchanged where pieces meet or end there. The new joint is
/// smooth of any order, if the curve does not stand still there. Throws Invalid_input outside the domain.
template <int Dim>
Rational_curve<Dim> with_inserted_knot(const Rational_curve<Dim>& curve, const Rational& u)
{
  const std::vector<Piece>& ranges = curve.chain().pieces;
  std::size_t k = 0;
  while (k < ranges.size() && !ranges[k].contains(u)) ++k;
  if (k == ranges.size())
    throw Invalid_input("", "the curve's domain does not contain " + u.get_str(), "cut it inside its domain");
  const Piece range = ranges[k];
  if ((!range.lo_infinite && u == range.lo) || (!range.hi_infinite && u == range.hi)) return curve;
  const auto parts = detail::split_range(range, u);
  std::vector<Curve_piece<Dim>> pieces = curve.pieces();
  Chain chain = curve.chain();
  const auto at = static_cast<std::ptrdiff_t>(k);
  const Curve_piece<Dim> whole = pieces[k];
  pieces[k] = detail::part_over(whole, range, parts[0]);
  pieces.insert(pieces.begin() + at + 1, detail::part_over(whole, range, parts[1]));
  chain.pieces[k] = parts[0];
  chain.pieces.insert(chain.pieces.begin() + at + 1, parts[1]);
  chain.joints.insert(chain.joints.begin() + at, joint_between(pieces[k], parts[0], pieces[k + 1], parts[1]));
  return Rational_curve<Dim>(std::move(pieces), std::move(chain));
}

/// A closed curve that starts with the piece of the given index. Parameters go on growing: those of the pieces before it
/// grow by the length of the domain. Throws Invalid_input for an open curve, one that closes through u = ∞, or an index
/// that is too great.
template <int Dim>
Rational_curve<Dim> with_seam_at(const Rational_curve<Dim>& curve, std::size_t index)
{
  const Chain& old = curve.chain();
  if (!old.is_closed()) throw Invalid_input("", "an open curve has no seam", "close it, or leave it where it starts");
  if (index >= old.pieces.size())
    throw Invalid_input("", "the curve has no piece " + std::to_string(index),
                        "use an index below " + std::to_string(old.pieces.size()));
  if (index == 0) return curve;
  if (old.pieces.front().lo_infinite || old.pieces.back().hi_infinite)
    throw Invalid_input("", "the curve closes through u = infinity, where its seam stays", "use a curve on a bounded domain");
  const Rational length = old.pieces.back().hi - old.pieces.front().lo;
  std::vector<Curve_piece<Dim>> pieces = curve.pieces();
  Chain chain = old;
  for (std::size_t k = 0; k < index; ++k) {
    chain.pieces[k].lo += length;
    chain.pieces[k].hi += length;
  }
  const auto first = static_cast<std::ptrdiff_t>(index);
  std::rotate(pieces.begin(), pieces.begin() + first, pieces.end());
  std::rotate(chain.pieces.begin(), chain.pieces.begin() + first, chain.pieces.end());
  std::rotate(chain.joints.begin(), chain.joints.begin() + first, chain.joints.end());
  return Rational_curve<Dim>(std::move(pieces), std::move(chain));
}

namespace detail {

inline Homogeneous_parameter image(const Moebius_map& map, const Homogeneous_parameter& p)
{
  return {Rational(map.a * p.x + map.b * p.y), Rational(map.c * p.x + map.d * p.y)};
}

/// Where a piece goes under an increasing map without pole there.
inline Piece image(const Moebius_map& map, const Piece& p)
{
  const Homogeneous_parameter lo = image(map, start_of(p)), hi = image(map, finish_of(p));
  if (lo.y == 0) return range_from_infinity(Rational(hi.x / hi.y));
  if (hi.y == 0) return range_to_infinity(Rational(lo.x / lo.y));
  return finite_range(Rational(lo.x / lo.y), Rational(hi.x / hi.y));
}

/// A projective piece must begin at a value of its sign: cuts pieces towards infinity whose images would not.
template <int Dim>
Rational_curve<Dim> cut_for_affine_map(Rational_curve<Dim> curve, const Moebius_map& map)
{
  const Rational a = map.a / map.d, b = map.b / map.d;
  const Piece first = curve.chain().pieces.front(), last = curve.chain().pieces.back();
  if (first.lo_infinite && a * first.hi + b >= 0) curve = with_inserted_knot(curve, Rational((-1 - b) / a));
  if (last.hi_infinite && a * last.lo + b <= 0) curve = with_inserted_knot(curve, Rational((1 - b) / a));
  return curve;
}

inline void require_no_pole(const Moebius_map& map, const Chain& chain)
{
  if (map.determinant() == 0) throw Invalid_input("", "the map of the parameter is constant", "let a·d differ from b·c");
  if (map.c == 0) return;
  const Rational pole = -map.d / map.c;
  for (const Piece& p : chain.pieces)
    if (p.contains(pole))
      throw Invalid_input("", "the map of the parameter has its pole at " + pole.get_str() + ", in the curve's domain",
                          "use a map without a pole there");
}

} // namespace detail

/// The same curve with the parameter v = (a·u + b)/(c·u + d): parameter values are mapped, points stay, and polynomial
/// pieces become rational ones unless c = 0. Degrees stay, but for degrees higher than a polynomial piece needs. A decreasing map (a·d < b·c) reverses the curve. A piece towards
/// infinity is cut first where its image must be; an infinite end goes to a/c, or stays infinite if c = 0. Orders of
/// continuity stay, but for the seam's, whose sides are mapped apart: that is found out anew.
/// Throws Invalid_input for a·d = b·c, or if c·u + d vanishes on the domain.
template <int Dim>
Rational_curve<Dim> reparametrised(const Rational_curve<Dim>& curve, const Moebius_map& map)
{
  detail::require_no_pole(map, curve.chain());
  if (map.determinant() < 0) return reparametrised(reversed(curve), {Rational(-map.a), map.b, Rational(-map.c), map.d});
  const Rational_curve<Dim> source = map.c == 0 ? detail::cut_for_affine_map(curve, map) : curve;
  std::vector<Curve_piece<Dim>> pieces;
  Chain chain = source.chain();
  for (std::size_t k = 0; k < source.pieces().size(); ++k) {
    const Piece from = chain.pieces[k];
    chain.pieces[k] = detail::image(map, from);
    pieces.push_back(detail::moved(source.pieces()[k], detail::image(map, detail::start_of(from)),
                                   detail::image(map, detail::finish_of(from)), chain.pieces[k]));
  }
  if (chain.is_closed() && !chain.joints.back().by_tolerance)
    chain.joints.back() = joint_between(pieces.back(), chain.pieces.back(), pieces.front(), chain.pieces.front());
  return Rational_curve<Dim>(std::move(pieces), std::move(chain));
}

} // namespace locus

#endif
