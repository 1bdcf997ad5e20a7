// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_FRAME_H
#define LOCUS_SHAPE_FRAME_H

#include <locus/number/interval.h>

#include <array>
#include <cmath>
#include <vector>

namespace locus {

/// An exact change of coordinates, x ↦ (x - origin)·2^-exponent, applied to all inputs before any double sees them.
/// F3 has degree 4 in the coordinates, so inputs of size 1e200 or 1e-300 would over- or underflow without it, and
/// inputs far from the origin would lose their digits. Undone on the way out.
template <int Dim>
struct Frame {
  std::array<Rational, static_cast<std::size_t>(Dim)> origin{};
  long exponent = 0;

  Rational into(const Rational& x, std::size_t axis) const
  {
    Rational y = x - origin[axis];
    if (exponent >= 0) mpq_div_2exp(y.get_mpq_t(), y.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    else mpq_mul_2exp(y.get_mpq_t(), y.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    return y;
  }

  /// Original coordinate of a value in the frame, as an enclosure (upward rounding needed).
  Interval out_of(const Interval& x, std::size_t axis) const
  {
    return length(x) + enclosing(origin[axis]);
  }

  /// Original length of a length in the frame; the power of two is exact unless it underflows, which the enclosure of
  /// the result then covers.
  Interval length(const Interval& x) const
  {
    const int e = static_cast<int>(exponent);
    if (e == 0) return x;
    constexpr double tiny = std::numeric_limits<double>::denorm_min();
    double lo = std::ldexp(x.inf(), e), hi = std::ldexp(x.sup(), e);
    if (std::ldexp(lo, -e) != x.inf()) lo -= tiny;
    if (std::ldexp(hi, -e) != x.sup()) hi += tiny;
    return {lo, hi};
  }
};

/// A frame that brings points into a box of about unit size around the origin. `origin` gets few digits, so that
/// inputs with few digits keep them.
template <int Dim>
Frame<Dim> fitting_frame(const std::vector<std::array<Rational, static_cast<std::size_t>(Dim)>>& points)
{
  Frame<Dim> frame;
  if (points.empty()) return frame;
  Rational extent = 0;
  std::array<Rational, static_cast<std::size_t>(Dim)> centre;
  for (std::size_t k = 0; k < centre.size(); ++k) {
    Rational lo = points[0][k], hi = points[0][k];
    for (const auto& p : points) {
      if (p[k] < lo) lo = p[k];
      if (p[k] > hi) hi = p[k];
    }
    const Rational size = hi - lo;
    if (size > extent) extent = size;
    centre[k] = (lo + hi) / 2;
  }
  if (extent == 0) return frame;
  // 2^exponent is between half and twice the extent.
  frame.exponent = static_cast<long>(mpz_sizeinbase(extent.get_num_mpz_t(), 2)) -
                   static_cast<long>(mpz_sizeinbase(extent.get_den_mpz_t(), 2));
  for (std::size_t k = 0; k < centre.size(); ++k) {
    // Centre rounded to a multiple of 2^(exponent-2).
    const long grain = frame.exponent - 2;
    Rational units = centre[k];
    if (grain >= 0) mpq_div_2exp(units.get_mpq_t(), units.get_mpq_t(), static_cast<mp_bitcnt_t>(grain));
    else mpq_mul_2exp(units.get_mpq_t(), units.get_mpq_t(), static_cast<mp_bitcnt_t>(-grain));
    Integer whole;
    mpz_fdiv_q(whole.get_mpz_t(), units.get_num_mpz_t(), units.get_den_mpz_t());
    frame.origin[k] = Rational(whole);
    if (grain >= 0) mpq_mul_2exp(frame.origin[k].get_mpq_t(), frame.origin[k].get_mpq_t(), static_cast<mp_bitcnt_t>(grain));
    else mpq_div_2exp(frame.origin[k].get_mpq_t(), frame.origin[k].get_mpq_t(), static_cast<mp_bitcnt_t>(-grain));
  }
  return frame;
}

} // namespace locus

#endif
