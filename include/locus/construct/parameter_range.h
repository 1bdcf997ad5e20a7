// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PARAMETER_RANGE_H
#define LOCUS_CONSTRUCT_PARAMETER_RANGE_H

#include <locus/construct/locus.h>
#include <locus/function/domain.h>
#include <locus/number/interval.h>

namespace locus {
/// Where an input's parameter begins and ends; one place where the input is closed.
struct Parameter_seam {
  bool is_closed = false;
  Range first, last;

  /// Whether two ranges of the parameter hold one place: in common, or at the two sides of the seam.
  bool may_be_one_place(const Range& a, const Range& b) const
  {
    const auto meet = [](const Range& x, const Range& y) { return x.lo <= y.hi && y.lo <= x.hi; };
    return meet(a, b) || (is_closed && ((meet(a, first) && meet(b, last)) || (meet(a, last) && meet(b, first))));
  }
};

/// The values of a parameter that the unit interval stands for, enclosed.
class Parameter_range {
public:
  Parameter_range() = default;
  explicit Parameter_range(const Piece& piece) : Parameter_range(piece, Rational(0), Rational(1)) {}

  /// Of the part [from, to] of a piece's unit interval: the unit interval stands for it. What is cut out of a projective piece
  /// is not affine, though both its ends may be finite.
  Parameter_range(const Piece& whole, const Rational& from, const Rational& to)
    : lo_infinite_(whole.lo_infinite && from == 0), hi_infinite_(whole.hi_infinite && to == 1)
  {
    if (!lo_infinite_) lo_ = enclosing(*whole.at(from));
    if (!hi_infinite_) hi_ = enclosing(*whole.at(to));
    is_unit_ = whole.is_finite() && lo_.is_point() && hi_.is_point() && lo_.inf() == 0 && hi_.inf() == 1;
    if (whole.hi_infinite) pole_ = {enclosing(whole.lo), enclosing(Rational(1 - from)), enclosing(Rational(1 - to))};
    if (whole.lo_infinite) pole_ = {enclosing(whole.hi), enclosing(from), enclosing(to)};
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
    const Interval s(std::max(0.0, u.inf()), std::min(1.0, u.sup()));
    if (pole_) return clipped(pole_->factor / ((Interval(1) - s) * pole_->from + s * pole_->to));
    return clipped(is_unit_ ? u : lo_ + u * (hi_ - lo_));
  }

private:
  /// u = factor/t with t from `from` to `to`, one of which is zero where the range reaches infinity.
  struct Pole {
    Interval factor, from, to;
  };

  Range clipped(const Interval& p) const
  {
    return {lo_infinite_ ? p.inf() : std::max(p.inf(), lo_.inf()), hi_infinite_ ? p.sup() : std::min(p.sup(), hi_.sup())};
  }

  Interval lo_ = Interval(0), hi_ = Interval(1);
  bool lo_infinite_ = false, hi_infinite_ = false, is_unit_ = true;
  std::optional<Pole> pole_;
  std::optional<Range> constant_;
};

} // namespace locus

#endif
