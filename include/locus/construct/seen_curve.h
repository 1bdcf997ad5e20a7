// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SEEN_CURVE_H
#define LOCUS_CONSTRUCT_SEEN_CURVE_H

#include <locus/construct/extent.h>
#include <locus/construct/locus.h>
#include <locus/construct/parameter_range.h>
#include <locus/construct/point_cell_features.h>
#include <locus/function/rational_root.h>
#include <locus/shape/parent_curve.h>
#include <locus/shape/rational_map.h>

namespace locus {
namespace detail {

/// A curve as seen from a point, in a frame of both: its pieces, cut where the point lies on them, and the features that
/// circles through the point can touch.
class Seen_curve {
public:
  /// With `beyond_ends` the curve is continued over the whole line (reading (70) of Farouki & Johnstone 1994).
  Seen_curve(const Curve_2& curve, const Exact_point<2>& point, bool beyond_ends = false) : chain_(curve.chain()), beyond_ends_(beyond_ends)
  {
    std::vector<Exact_point<2>> points{point};
    collect_control_points(curve, points);
    frame_ = fitting_frame<2>(points);
    require_drawable(frame_);
    extent_ = extent_in<2>(frame_, points);
    for (std::size_t k = 0; k < 2; ++k) point_[k] = frame_.into(point[k], k);
    const auto framed = [&](const Curve_piece<2>& piece) { return with_unit_forms(in_frame(piece, frame_)); };
    if (beyond_ends) {
      chain_ = Chain{{}, {}};
      for (Parent_piece& piece : parent_pieces(curve)) {
        chain_.pieces.push_back(piece.range);
        if (chain_.pieces.size() > 1) chain_.joints.push_back({Joint_kind::smooth, Joint::any_order, false});
        is_own_.push_back(piece.is_own);
        add_piece(chain_.pieces.size() - 1, framed(piece.forms));
      }
      return;
    }
    is_own_.assign(curve.pieces().size(), true);
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) add_piece(i, framed(curve.pieces()[i]));
  }

  std::size_t size() const { return pieces_.size(); }
  const Frame<2>& frame() const { return frame_; }
  const Extent<2>& extent() const { return extent_; }
  /// In the frame.
  const Exact_point<2>& point() const { return point_; }
  bool is_on_curve() const { return !hits_.empty(); }
  /// Whether the point lies on the curve where this has a tangent, not at an end nor at a corner.
  bool is_on_smooth_place() const { return smooth_hit_.has_value(); }

  /// False for what continues the curve beyond its ends.
  bool is_own(std::size_t piece) const { return is_own_[pieces_[piece].source]; }
  bool is_beyond_ends() const { return beyond_ends_; }

  const Parameter_range& range_of(std::size_t piece) const { return ranges_[piece]; }

  /// The curve's parameter; nothing where it is infinite.
  std::optional<Rational> parameter_at(std::size_t piece, const Rational& local) const
  {
    const Seen_piece& p = pieces_[piece];
    return chain_.pieces[p.source].at(Rational(p.from + local * (p.to - p.from)));
  }

  /// The piece of the untrimmed bisector: pieces of the curve that are mapped to infinity have none.
  std::size_t piece_of_map(std::size_t piece, const Rational_map<2, 1>& map) const
  {
    const Piece& source = chain_.pieces[pieces_[piece].source];
    for (std::size_t i = 0; i < map.pieces().size(); ++i) {
      const Piece& range = map.pieces()[i].range[0];
      if (range.lo_infinite == source.lo_infinite && range.hi_infinite == source.hi_infinite && (source.lo_infinite || range.lo == source.lo) &&
          (source.hi_infinite || range.hi == source.hi))
        return i;
    }
    throw std::logic_error("locus: a kept interval of a piece without an image");
  }

  Feature feature_at(std::size_t piece, int end) const
  {
    if (is_cut(piece, end)) return Feature::interior;
    if (beyond_ends_) {
      const bool ends_here = is_own(piece) && (end == 0 ? piece == 0 || !is_own(piece - 1) : piece + 1 == size() || !is_own(piece + 1));
      return !ends_here ? Feature::interior : end == 0 ? Feature::start : Feature::end;
    }
    const Joint* joint = joint_at(piece, end);
    if (joint && is_smooth(*joint)) return Feature::interior;
    if (joint) return Feature::corner;
    return end == 0 ? Feature::start : Feature::end;
  }

  /// Whether the next piece at an end is this one, with the same tangent.
  bool goes_on_smoothly(std::size_t piece, int end, std::size_t next) const
  {
    if (is_cut(piece, end)) return next == (end == 1 ? piece + 1 : piece - 1);
    const Joint* joint = joint_at(piece, end);
    return joint && is_smooth(*joint) && next == neighbour(piece, end);
  }

  Cell_features features() const
  {
    Cell_feature_maker maker(pieces_);
    if (smooth_hit_) {
      maker.add_normal(smooth_hit_->first, smooth_hit_->second);
      return maker.result();
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!repeats_earlier_piece(i)) maker.add_arc(i);
      for (int end = 0; end < 2; ++end)
        if (is_vertex(i, end)) maker.add_vertex(i, end);
    }
    return maker.result();
  }

private:
  void add_piece(std::size_t source, const Curve_piece<2>& piece)
  {
    Seen_piece seen;
    for (std::size_t k = 0; k < 2; ++k) seen.offset[k] = subtract(piece.numerator[k], multiply(piece.weight, point_[k]));
    seen.weight = piece.weight;
    seen.source = source;
    std::vector<Rational> cuts{Rational(0), Rational(1)};
    for (const Rational& s : places_of_point(seen)) cuts.insert(cuts.end() - 1, s);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      Seen_piece part = seen;
      if (cuts.size() > 2) {
        for (auto& x : part.offset) x = restrict_to(x, 0, cuts[k], cuts[k + 1]);
        if (part.weight.degree() > 0) part.weight = restrict_to(part.weight, 0, cuts[k], cuts[k + 1]);
        part.from = cuts[k];
        part.to = cuts[k + 1];
      }
      pieces_.push_back(std::move(part));
      ranges_.push_back(range_between(source, cuts[k], cuts[k + 1]));
      note_hits();
    }
  }

  /// The ends of the piece added last where the point is. A cut, and a smooth joint, count once, from before.
  void note_hits()
  {
    const std::size_t i = pieces_.size() - 1;
    for (int end = 0; end < 2; ++end) {
      const auto at = [&](const Bernstein<Rational, 1>& x) { return x[end == 0 ? 0 : x.size() - 1]; };
      if (at(pieces_[i].offset[0]) != 0 || at(pieces_[i].offset[1]) != 0) continue;
      hits_.push_back({i, end});
      const Joint* joint = joint_at(i, end);
      if (!smooth_hit_ && (is_cut(i, end) || (joint && is_smooth(*joint)))) smooth_hit_ = {i, end};
    }
  }

  /// The parameters inside a piece at which the curve passes the point, in order.
  std::vector<Rational> places_of_point(const Seen_piece& seen) const
  {
    const auto x = enclosed(seen.offset[0]), y = enclosed(seen.offset[1]);
    const auto square = add(multiply(x, x), multiply(y, y));
    if (std::all_of(square.coefficients().begin(), square.coefficients().end(), [](const Interval& c) { return c.inf() > 0; })) return {};
    const Integer_polynomial common = common_factor(Polynomial_vector<1, 2>{seen.offset[0], seen.offset[1]});
    std::vector<Rational> places;
    if (degree(common) < 1) return places;
    for (const auto& root : exact_roots(bernstein_form(common), Rational(0), Rational(1)).roots) {
      if (root.is_exact() && (root.lo == 0 || root.lo == 1)) continue;
      const auto s = rational_value(root);
      if (!s) throw Unsupported_feature("a point on the curve at an irrational parameter, where the curve crosses itself");
      places.push_back(*s);
    }
    return places;
  }

  Parameter_range range_between(std::size_t source, const Rational& from, const Rational& to) const
  {
    const Piece& whole = chain_.pieces[source];
    Piece part = whole;
    if (from != 0) {
      part.lo = *whole.at(from);
      part.lo_infinite = false;
    }
    if (to != 1) {
      part.hi = *whole.at(to);
      part.hi_infinite = false;
    }
    return Parameter_range(part);
  }

  bool is_cut(std::size_t piece, int end) const { return end == 0 ? pieces_[piece].from != 0 : pieces_[piece].to != 1; }

  const Joint* joint_at(std::size_t piece, int end) const { return is_cut(piece, end) ? nullptr : chain_.joint_at(pieces_[piece].source, end); }

  /// Least distances are exact: a joint that turns a little is a corner, whatever tolerance took it for smooth. Through
  /// infinity the inverted curve goes on through the point's own image.
  static bool is_smooth(const Joint& joint) { return (joint.goes_on() && !joint.by_tolerance) || joint.kind == Joint_kind::pole; }

  std::size_t neighbour(std::size_t piece, int end) const
  {
    const std::size_t n = pieces_.size();
    return end == 1 ? (piece + 1) % n : (piece + n - 1) % n;
  }

  /// Ends, and of a corner the end of the piece before it; both where the point itself is there.
  bool is_vertex(std::size_t piece, int end) const
  {
    if (is_cut(piece, end) || beyond_ends_) return false;
    const Joint* joint = joint_at(piece, end);
    if (joint && is_smooth(*joint)) return false;
    const auto& w = pieces_[piece].weight;
    if (w[end == 0 ? 0 : w.size() - 1] == 0) return false;
    const bool hit = std::find(hits_.begin(), hits_.end(), std::pair<std::size_t, int>(piece, end)) != hits_.end();
    return !joint || end == 1 || hit;
  }

  /// Whether an earlier piece runs along the same path, in either sense: one of them is enough.
  bool repeats_earlier_piece(std::size_t i) const
  {
    const auto same = [](const Bernstein<Rational, 1>& a, const Bernstein<Rational, 1>& b, bool reversed) {
      if (a.size() != b.size()) return false;
      return reversed ? std::equal(a.coefficients().begin(), a.coefficients().end(), b.coefficients().rbegin()) : a.coefficients() == b.coefficients();
    };
    const Seen_piece& p = pieces_[i];
    for (std::size_t j = 0; j < i; ++j)
      for (const bool reversed : {false, true})
        if (same(p.offset[0], pieces_[j].offset[0], reversed) && same(p.offset[1], pieces_[j].offset[1], reversed) &&
            same(p.weight, pieces_[j].weight, reversed))
          return true;
    return false;
  }

  Chain chain_;
  bool beyond_ends_ = false;
  std::vector<char> is_own_; ///< by pieces of the chain
  Frame<2> frame_;
  Extent<2> extent_;
  Exact_point<2> point_;
  std::vector<Seen_piece> pieces_;
  std::vector<Parameter_range> ranges_;
  std::vector<std::pair<std::size_t, int>> hits_;
  std::optional<std::pair<std::size_t, int>> smooth_hit_;
};

} // namespace detail
} // namespace locus

#endif
