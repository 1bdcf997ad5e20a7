// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_SNAPPED_JOINTS_H
#define LOCUS_SHAPE_SNAPPED_JOINTS_H

#include <locus/shape/joints.h>

#include <cmath>

namespace locus {

namespace detail {

template <int Dim>
Exact_point<Dim> control_point(const Curve_piece<Dim>& piece, std::size_t i)
{
  Exact_point<Dim> p;
  for (std::size_t k = 0; k < Dim; ++k) p[k] = piece.numerator[k][i] / (piece.is_polynomial() ? piece.weight[0] : piece.weight[i]);
  return p;
}

/// Moves the second control point of a piece, or the last but one, so that the piece leaves its end in a direction given up to its
/// length; nothing is done where that point lies on the end or turns the other end, too.
template <int Dim>
bool turn_end(Curve_piece<Dim>& piece, bool at_end, const Exact_point<Dim>& direction)
{
  const std::size_t n = piece.numerator[0].size() - 1;
  if (n < 3 || (!piece.is_polynomial() && piece.weight.size() != n + 1)) return false;
  const std::size_t inner = at_end ? n - 1 : 1;
  const Exact_point<Dim> end = control_point(piece, at_end ? n : 0), old = control_point(piece, inner);
  double length = 0, wanted = 0;
  for (std::size_t k = 0; k < Dim; ++k) {
    length += std::pow(Rational(old[k] - end[k]).get_d(), 2);
    wanted += std::pow(direction[k].get_d(), 2);
  }
  const double ratio = std::sqrt(length / wanted);
  if (!(ratio > 0) || !std::isfinite(ratio)) return false;
  for (std::size_t k = 0; k < Dim; ++k) {
    const Rational w = piece.is_polynomial() ? piece.weight[0] : piece.weight[inner];
    std::vector<Rational> c(piece.numerator[k].coefficients().begin(), piece.numerator[k].coefficients().end());
    c[inner] = w * (end[k] + Rational(ratio) * direction[k]);
    piece.numerator[k] = Bernstein<Rational, 1>(Degrees<1>{static_cast<int>(n)}, std::move(c));
  }
  return true;
}

} // namespace detail

/// The same curve with joints that are smooth by a tolerance made smooth: a control point beside each, at distance d from the joint,
/// is turned about it and so moved by about d times the angle. Joints of pieces of degree below three stay as they are.
template <int Dim>
Rational_curve<Dim> with_snapped_joints(const Rational_curve<Dim>& curve)
{
  const Chain& chain = curve.chain();
  std::vector<Curve_piece<Dim>> pieces = curve.pieces();
  bool any = false;
  for (std::size_t k = 0; k < chain.joints.size(); ++k) {
    if (!chain.joints[k].by_tolerance) continue;
    const std::size_t next = (k + 1) % pieces.size(), n = pieces[k].numerator[0].size() - 1;
    const Exact_point<Dim> joint = detail::control_point(pieces[k], n), before = detail::control_point(pieces[k], n - 1);
    Exact_point<Dim> direction;
    for (std::size_t i = 0; i < Dim; ++i) direction[i] = joint[i] - before[i];
    any = detail::turn_end(pieces[next], false, direction) || any;
  }
  return any ? joined_curve(std::move(pieces), chain.pieces, chain.is_closed()) : curve;
}

} // namespace locus

#endif
