// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PARAMETER_RANGE_H
#define LOCUS_CONSTRUCT_PARAMETER_RANGE_H

#include <locus/construct/locus.h>
#include <locus/function/domain.h>
#include <locus/number/interval.h>

namespace locus {
/// The values of a parameter that the unit interval stands for, enclosed.
class Parameter_range {
public:
  Parameter_range() = default;
  explicit Parameter_range(const Piece& piece)
    : lo_(enclosing(piece.lo)), hi_(enclosing(piece.hi)), lo_infinite_(piece.lo_infinite), hi_infinite_(piece.hi_infinite)
  {
    is_unit_ = piece.is_finite() && piece.lo == 0 && piece.hi == 1;
  }

  /// One value for all of the unit interval.
  static Parameter_range constant(const Range& value)
  {
    Parameter_range range;
    range.constant_ = value;
    return range;
  }

  /// An infinite end is an infinity.
  Range at(const Interval& u) const
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (constant_) return *constant_;
    if (u.sup() == 0) return lo_infinite_ ? Range{-infinite, -infinite} : Range{lo_.inf(), lo_.sup()};
    if (u.inf() == 1) return hi_infinite_ ? Range{infinite, infinite} : Range{hi_.inf(), hi_.sup()};
    if (hi_infinite_) return clipped(lo_ / (Interval(1) - Interval(u.inf(), std::min(1.0, u.sup()))));
    if (lo_infinite_) return clipped(hi_ / Interval(std::max(0.0, u.inf()), u.sup()));
    return clipped(is_unit_ ? u : lo_ + u * (hi_ - lo_));
  }

private:
  Range clipped(const Interval& p) const
  {
    return {lo_infinite_ ? p.inf() : std::max(p.inf(), lo_.inf()), hi_infinite_ ? p.sup() : std::min(p.sup(), hi_.sup())};
  }

  Interval lo_ = Interval(0), hi_ = Interval(1);
  bool lo_infinite_ = false, hi_infinite_ = false, is_unit_ = true;
  std::optional<Range> constant_;
};

} // namespace locus

#endif
