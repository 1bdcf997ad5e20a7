// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SEEN_CURVE_H
#define LOCUS_CONSTRUCT_SEEN_CURVE_H

#include <locus/construct/extent.h>
#include <locus/construct/locus.h>
#include <locus/construct/parameter_range.h>
#include <locus/construct/point_cell_features.h>
#include <locus/function/rational_root.h>
#include <locus/shape/cusps.h>
#include <locus/shape/parent_curve.h>
#include <locus/shape/rational_map.h>

namespace locus {
namespace detail {

/// Curves as seen from a point, in a frame of all: their pieces, cut where the point lies on them, and the features that
/// circles through the point can touch. Throws Unsupported_feature for cusps, and for the point on a curve, at irrational
/// parameters inside pieces.
class Seen_curve {
public:
  /// With `beyond_ends` a single curve is continued over the whole line (reading (70) of Farouki & Johnstone 1994).
  Seen_curve(const Curve_2& curve, const Exact_point<2>& point, bool beyond_ends = false)
    : Seen_curve(std::vector<const Curve_2*>{&curve}, point, beyond_ends)
  {
  }

  Seen_curve(const std::vector<const Curve_2*>& curves, const Exact_point<2>& point, bool beyond_ends = false) : beyond_ends_(beyond_ends)
  {
    std::vector<Exact_point<2>> points{point};
    for (const Curve_2* curve : curves) {
      collect_control_points(*curve, points);
      inputs_.push_back({curve->chain(), 0, 0});
    }
    frame_ = fitting_frame<2>(points);
    require_drawable(frame_);
    extent_ = extent_in<2>(frame_, points);
    for (std::size_t k = 0; k < 2; ++k) point_[k] = frame_.into(point[k], k);
    const auto framed = [&](const Curve_piece<2>& piece) { return with_unit_forms(in_frame(piece, frame_)); };
    if (beyond_ends) {
      Chain& chain = inputs_[0].chain;
      chain = Chain{{}, {}};
      for (Parent_piece& piece : parent_pieces(*curves[0])) {
        chain.pieces.push_back(piece.range);
        if (chain.pieces.size() > 1) chain.joints.push_back({Joint_kind::smooth, Joint::any_order, false});
        is_own_.push_back(piece.is_own);
        add_piece(0, chain.pieces.size() - 1, framed(piece.forms));
      }
    } else {
      for (std::size_t k = 0; k < curves.size(); ++k)
        for (std::size_t i = 0; i < curves[k]->pieces().size(); ++i) add_piece(k, i, framed(curves[k]->pieces()[i]));
    }
    note_parts();
    drop_overlaps();
    note_hits();
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
  bool is_own(std::size_t piece) const { return !beyond_ends_ || is_own_[pieces_[piece].source]; }
  std::size_t input_of(std::size_t piece) const { return pieces_[piece].input; }
  bool is_beyond_ends() const { return beyond_ends_; }

  const Parameter_range& range_of(std::size_t piece) const { return ranges_[piece]; }

  /// The curve's parameter; nothing where it is infinite.
  std::optional<Rational> parameter_at(std::size_t piece, const Rational& local) const
  {
    const Seen_piece& p = pieces_[piece];
    return chain_of(piece).pieces[p.source].at(Rational(p.from + local * (p.to - p.from)));
  }

  /// Whether two parameter ranges of a curve hold one place: in common, or at the two sides of a seam.
  bool may_be_one_place(std::size_t input, const Range& a, const Range& b) const
  {
    const Seen_input& curve = inputs_[input];
    if (!curve.chain.is_closed()) return Parameter_seam().may_be_one_place(a, b);
    return Parameter_seam{true, ranges_[curve.first].at(Interval(0)), ranges_[curve.first + curve.count - 1].at(Interval(1))}.may_be_one_place(a, b);
  }

  /// The piece of the untrimmed bisector: pieces of the curve that are mapped to infinity have none.
  std::size_t piece_of_map(std::size_t piece, const Rational_map<2, 1>& map) const
  {
    const Piece& source = chain_of(piece).pieces[pieces_[piece].source];
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
    if (is_cut(piece, end)) return is_cusp(piece, end) ? Feature::corner : Feature::interior;
    if (beyond_ends_) {
      const bool ends_here = is_own(piece) && (end == 0 ? piece == 0 || !is_own(piece - 1) : piece + 1 == size() || !is_own(piece + 1));
      return !ends_here ? Feature::interior : end == 0 ? Feature::start : Feature::end;
    }
    if (goes_on_smoothly_at(piece, end)) return Feature::interior;
    if (joint_at(piece, end)) return Feature::corner;
    return end == 0 ? Feature::start : Feature::end;
  }

  /// Whether the next piece at an end is this one, with the same tangent.
  bool goes_on_smoothly(std::size_t piece, int end, std::size_t next) const
  {
    return goes_on_smoothly_at(piece, end) && next == next_at(piece, end);
  }

  /// What circles through the point can touch; of one input only, if it is given, though all of them are required to be outside.
  Cell_features features(const std::optional<std::size_t>& only_input = {}) const
  {
    Cell_feature_maker maker(pieces_);
    if (smooth_hit_) {
      maker.add_normal(smooth_hit_->first, smooth_hit_->second);
      return maker.result();
    }
    std::vector<std::pair<std::size_t, int>> vertices;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (only_input && pieces_[i].input != *only_input) continue;
      if (!pieces_[i].is_redundant) maker.add_arc(i);
      for (int end = 0; end < 2; ++end) {
        const std::pair<std::size_t, int> vertex(i, end);
        if (!is_vertex(i, end) || std::any_of(vertices.begin(), vertices.end(), [&](const auto& v) { return maker.has_one_line(v, vertex); })) continue;
        vertices.push_back(vertex);
        maker.add_vertex(i, end);
      }
    }
    return maker.result();
  }

private:
  struct Seen_input {
    Chain chain;
    std::size_t first, count; ///< its parts, in order
  };

  const Chain& chain_of(std::size_t piece) const { return inputs_[pieces_[piece].input].chain; }

  void add_piece(std::size_t input, std::size_t source, const Curve_piece<2>& piece)
  {
    Seen_piece seen;
    seen.input = input;
    for (std::size_t k = 0; k < 2; ++k) seen.offset[k] = subtract(piece.numerator[k], multiply(piece.weight, point_[k]));
    seen.weight = piece.weight;
    seen.source = source;
    std::vector<Rational> cuts = places_of(seen, {Rational(0), Rational(0)});
    std::vector<Rational> cusps;
    for (const Standstill& s : standstills(piece)) {
      cuts.push_back(s.place);
      if (s.reverses) cusps.push_back(s.place);
    }
    add_parts(seen, std::move(cuts), cusps);
  }

  /// The parts of a piece between the cuts; at some of them the curve stands still: it may reverse there, as at a corner.
  void add_parts(const Seen_piece& seen, std::vector<Rational> cuts, const std::vector<Rational>& cusps)
  {
    cuts.push_back(Rational(0));
    cuts.push_back(Rational(1));
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    const Rational length = seen.to - seen.from;
    const auto is_cusp = [&](const Rational& s) { return std::find(cusps.begin(), cusps.end(), s) != cusps.end(); };
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      Seen_piece part = seen;
      if (cuts.size() > 2) {
        for (auto& x : part.offset) x = restrict_to(x, 0, cuts[k], cuts[k + 1]);
        if (part.weight.degree() > 0) part.weight = restrict_to(part.weight, 0, cuts[k], cuts[k + 1]);
        part.from = seen.from + cuts[k] * length;
        part.to = seen.from + cuts[k + 1] * length;
        part.starts_at_cusp = k == 0 ? seen.starts_at_cusp : is_cusp(cuts[k]);
        part.ends_at_cusp = k + 2 == cuts.size() ? seen.ends_at_cusp : is_cusp(cuts[k + 1]);
      }
      ranges_.emplace_back(inputs_[part.input].chain.pieces[part.source], part.from, part.to);
      pieces_.push_back(std::move(part));
    }
  }

  /// All ends at which the point is. A smooth place counts once.
  void note_hits()
  {
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for (int end = 0; end < 2; ++end) {
        const auto at = [&](const Bernstein<Rational, 1>& x) { return x[end == 0 ? 0 : x.size() - 1]; };
        if (at(pieces_[i].offset[0]) != 0 || at(pieces_[i].offset[1]) != 0) continue;
        hits_.push_back({i, end});
        if (!smooth_hit_ && goes_on_smoothly_at(i, end)) smooth_hit_ = {i, end};
      }
  }

  /// The parameters inside a piece at which the curve passes a place, given relative to the point. Irrational ones, where it crosses
  /// itself, are left out where nothing begins there: a path that two pieces share begins at rational ones.
  static std::vector<Rational> places_of(const Seen_piece& seen, const std::array<Rational, 2>& place, bool all = true)
  {
    Polynomial_vector<1, 2> from = seen.offset;
    std::array<Bernstein<Interval, 1>, 2> enclosures;
    for (std::size_t k = 0; k < 2; ++k) {
      if (place[k] != 0) from[k] = subtract(from[k], multiply(seen.weight, place[k]));
      enclosures[k] = enclosing(from[k]);
    }
    const auto square = add(multiply(enclosures[0], enclosures[0]), multiply(enclosures[1], enclosures[1]));
    if (std::all_of(square.coefficients().begin(), square.coefficients().end(), [](const Interval& c) { return c.inf() > 0; })) return {};
    return inner_rational_roots(common_factor(from), all ? "a point on the curve at an irrational parameter, where the curve crosses itself" : nullptr);
  }

  static std::vector<Rational> inner_rational_roots(const Integer_polynomial& f, const char* if_irrational)
  {
    std::vector<Rational> places;
    if (degree(f) < 1) return places;
    for (const auto& root : exact_roots(bernstein_form(f), Rational(0), Rational(1)).roots) {
      if (root.is_exact() && (root.lo == 0 || root.lo == 1)) continue;
      const auto s = rational_value(root);
      if (!s && if_irrational) throw Unsupported_feature(if_irrational);
      if (s) places.push_back(*s);
    }
    return places;
  }

  /// Where a piece stands still inside. It turns back there if its velocity vanishes to an odd order.
  struct Standstill {
    Rational place;
    bool reverses;
  };

  static std::vector<Standstill> standstills(const Curve_piece<2>& piece)
  {
    Bernstein<Interval, 1> square(Degrees<1>{0});
    for (const auto& x : piece.numerator) {
      const auto d = velocity_numerator(enclosing(x), enclosing(piece.weight));
      square = add(square, multiply(d, d));
    }
    if (std::all_of(square.coefficients().begin(), square.coefficients().end(), [](const Interval& c) { return c.inf() > 0; })) return {};
    const Integer_polynomial factor = standstill_factor(piece);
    std::vector<Standstill> found;
    for (const Rational& s : inner_rational_roots(factor, "a curve with a cusp at an irrational parameter")) {
      bool odd = false;
      for (Integer_polynomial f = factor; degree(f) >= 0 && sign_at(bernstein_form(f), s) == Sign::zero; f = derivative(f)) odd = !odd;
      found.push_back({s, odd});
    }
    return found;
  }

  // ---------------------------------------------------------------------------------------------------------- overlaps

  /// Where pieces of one curve run along one path, all but one of them say nothing: they are cut where they begin and cease to.
  void drop_overlaps()
  {
    std::vector<std::vector<Rational>> cuts(pieces_.size());
    bool any = false;
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for (std::size_t j = 0; j < pieces_.size(); ++j)
        if (i != j && pieces_[i].input == pieces_[j].input && boxes_meet(i, j))
          for (const int end : {0, 1}) {
            if (end_weight(j, end) == 0) continue;
            for (const Rational& s : places_of(pieces_[i], end_place(j, end), false)) {
              cuts[i].push_back(s);
              any = true;
            }
          }
    if (any) {
      const std::vector<Seen_piece> whole = std::move(pieces_);
      pieces_.clear();
      ranges_.clear();
      for (std::size_t i = 0; i < whole.size(); ++i) add_parts(whole[i], std::move(cuts[i]), {});
      note_parts();
    }
    keep_one_of_each_path();
  }

  /// Of the pieces on one path the one that goes on where kept ones end, so that chains keep their sense.
  void keep_one_of_each_path()
  {
    const std::size_t n = pieces_.size();
    std::vector<std::size_t> path(n); // its first piece
    std::vector<char> is_shared(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      path[i] = i;
      for (std::size_t j = 0; j < i && path[i] == i; ++j)
        if (path[j] == j && pieces_[i].input == pieces_[j].input && boxes_meet(i, j) && is_one_path(pieces_[i], pieces_[j], i, j)) path[i] = j;
      if (path[i] != i) is_shared[path[i]] = pieces_[i].is_redundant = true;
    }
    std::vector<char> is_open = is_shared; // paths whose piece is not chosen yet, by their first pieces
    const auto is_kept = [&](std::size_t i) { return !is_open[path[i]] && !pieces_[i].is_redundant; };
    const auto goes_on_from_kept = [&](std::size_t i) {
      return std::any_of(std::begin(both_ends), std::end(both_ends), [&](int end) { return goes_on_smoothly_at(i, end) && is_kept(next_at(i, end)); });
    };
    const auto choose = [&](std::size_t i) {
      pieces_[path[i]].is_redundant = true;
      pieces_[i].is_redundant = false;
      is_open[path[i]] = false;
    };
    for (;;) {
      std::size_t chosen = n;
      for (std::size_t i = 0; i < n; ++i) {
        if (!is_open[path[i]]) continue;
        if (chosen == n || goes_on_from_kept(i)) chosen = i;
        if (goes_on_from_kept(i)) break;
      }
      if (chosen == n) return;
      choose(chosen);
    }
  }
  static constexpr int both_ends[] = {0, 1};

  const Rational& end_weight(std::size_t i, int end) const { return pieces_[i].weight[end == 0 ? 0 : pieces_[i].weight.size() - 1]; }

  std::array<Rational, 2> end_place(std::size_t i, int end) const
  {
    const Seen_piece& p = pieces_[i];
    const Rational& w = end_weight(i, end);
    return {Rational(p.offset[0][end == 0 ? 0 : p.offset[0].size() - 1] / w), Rational(p.offset[1][end == 0 ? 0 : p.offset[1].size() - 1] / w)};
  }

  /// The place of an end; nothing at infinity.
  std::optional<std::array<Rational, 2>> finite_end(std::size_t i, int end) const
  {
    if (end_weight(i, end) == 0) return std::nullopt;
    return end_place(i, end);
  }

  /// Same ends, and more points of one on the other than two different curves of their degrees can share (Bézout).
  bool is_one_path(const Seen_piece& a, const Seen_piece& b, std::size_t i, std::size_t j) const
  {
    const auto from = finite_end(i, 0), to = finite_end(i, 1), other_from = finite_end(j, 0), other_to = finite_end(j, 1);
    if (!(from == other_from && to == other_to) && !(from == other_to && to == other_from)) return false;
    const int n = std::max(a.offset[0].degree(), a.weight.degree()), m = std::max(b.offset[0].degree(), b.weight.degree());
    for (int k = 1; k <= n * m; ++k) {
      const Rational s = Rational(k) / (n * m + 1), w = evaluate_at(a.weight, s);
      const std::array<Rational, 2> place{Rational(evaluate_at(a.offset[0], s) / w), Rational(evaluate_at(a.offset[1], s) / w)};
      Polynomial_vector<1, 2> difference;
      for (std::size_t l = 0; l < 2; ++l) difference[l] = subtract(b.offset[l], multiply(b.weight, place[l]));
      const Integer_polynomial common = common_factor(difference);
      if (degree(common) < 1 || exact_roots(bernstein_form(common), Rational(0), Rational(1)).roots.empty()) return false;
    }
    return true;
  }

  /// Each curve's parts, and enclosing boxes of their control polygons, unbounded where weights are not all positive.
  void note_parts()
  {
    boxes_.clear();
    for (Seen_input& input : inputs_) input.first = input.count = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (inputs_[pieces_[i].input].count++ == 0) inputs_[pieces_[i].input].first = i;
    for (const Seen_piece& p : pieces_) {
      std::array<Interval, 2> box{Interval(0), Interval(0)};
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i < p.offset[k].size(); ++i) {
          const Interval w = enclosing(p.weight[p.weight.degree() == 0 ? 0 : i]);
          constexpr double infinite = std::numeric_limits<double>::infinity();
          const Interval x = w.inf() > 0 ? enclosing(p.offset[k][i]) / w : Interval(-infinite, infinite);
          box[k] = i == 0 ? x : hull(box[k], x);
        }
      boxes_.push_back(box);
    }
  }

  bool boxes_meet(std::size_t i, std::size_t j) const { return overlap(boxes_[i][0], boxes_[j][0]) && overlap(boxes_[i][1], boxes_[j][1]); }

  bool is_cut(std::size_t piece, int end) const { return end == 0 ? pieces_[piece].from != 0 : pieces_[piece].to != 1; }
  bool is_cusp(std::size_t piece, int end) const { return end == 0 ? pieces_[piece].starts_at_cusp : pieces_[piece].ends_at_cusp; }

  /// Whether the curve goes on at an end, with the same tangent.
  bool goes_on_smoothly_at(std::size_t piece, int end) const
  {
    if (is_cut(piece, end)) return !is_cusp(piece, end);
    const Joint* joint = joint_at(piece, end);
    return joint && is_smooth(*joint);
  }

  const Joint* joint_at(std::size_t piece, int end) const { return is_cut(piece, end) ? nullptr : chain_of(piece).joint_at(pieces_[piece].source, end); }

  /// Least distances are exact: a joint that turns a little is a corner, whatever tolerance took it for smooth. Through
  /// infinity the inverted curve goes on through the point's own image.
  static bool is_smooth(const Joint& joint) { return (joint.goes_on() && !joint.by_tolerance) || joint.kind == Joint_kind::pole; }

  /// The piece behind an end that is a cut or a joint.
  std::size_t next_at(std::size_t piece, int end) const
  {
    const Seen_input& input = inputs_[pieces_[piece].input]; // parts of a piece follow one another
    return input.first + (piece - input.first + (end == 1 ? 1 : input.count - 1)) % input.count;
  }

  /// Ends, and of a corner the end of the piece before it; both where the point itself is there.
  bool is_vertex(std::size_t piece, int end) const
  {
    const bool ends_here = !is_cut(piece, end) && beyond_ends_;
    if (ends_here || goes_on_smoothly_at(piece, end) || end_weight(piece, end) == 0) return false;
    const bool hit = std::find(hits_.begin(), hits_.end(), std::pair<std::size_t, int>(piece, end)) != hits_.end();
    const bool has_next = is_cut(piece, end) || joint_at(piece, end);
    return !has_next || end == 1 || hit;
  }

  std::vector<Seen_input> inputs_;
  bool beyond_ends_ = false;
  std::vector<char> is_own_; ///< by pieces of a chain that is continued beyond its ends
  Frame<2> frame_;
  Extent<2> extent_;
  Exact_point<2> point_;
  std::vector<Seen_piece> pieces_;
  std::vector<Parameter_range> ranges_;
  std::vector<std::array<Interval, 2>> boxes_;
  std::vector<std::pair<std::size_t, int>> hits_;
  std::optional<std::pair<std::size_t, int>> smooth_hit_;
};

} // namespace detail
} // namespace locus

#endif
