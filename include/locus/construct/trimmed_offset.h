// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_TRIMMED_OFFSET_H
#define LOCUS_CONSTRUCT_TRIMMED_OFFSET_H

#include <locus/constraint/offset_forms.h>
#include <locus/construct/curve_evaluator.h>
#include <locus/construct/extent.h>
#include <locus/construct/locus.h>
#include <locus/construct/parameter_range.h>
#include <locus/construct/point_cell_features.h>
#include <locus/shape/carrier.h>
#include <locus/zero_set/feasible_set.h>

#include <chrono>

namespace locus {

enum class Offset_end_kind : unsigned char {
  domain,   ///< the curve ends there
  infinity, ///< it goes to infinity
  joint,    ///< pieces meet smoothly, and the offset is kept on both
  corner,   ///< pieces meet in a corner: the offset breaks off
  cusp,     ///< the curve reverses inside a piece: the offset goes on elsewhere, on the curve's other side
  trim,     ///< another foot becomes nearer: a self-intersection of the untrimmed offset, or where it meets the circle about an end or a corner
  undecided ///< beside it something is undecided
};

constexpr const char* name_of(Offset_end_kind k)
{
  constexpr const char* names[] = {"domain", "infinity", "joint", "corner", "cusp", "trim", "undecided"};
  return names[static_cast<std::size_t>(k)];
}

/// An end of a kept interval: the parameter, enclosed, and exact where it is a known rational number; the offset point there.
struct Offset_end {
  Offset_end_kind kind = Offset_end_kind::trim;
  Range parameter;
  std::optional<Rational> exact;
  std::optional<Approximate_point<2>> point; ///< none at infinity
  double error = 0;                          ///< proved bound of its distance from the exact one
};

/// Parameters from end to end, in a piece of the curve, whose offset points are as far from the whole curve as from their feet.
struct Offset_interval {
  std::size_t piece = 0;
  std::array<Offset_end, 2> ends;
};

struct Offset_options {
  Solve_control control;
};

namespace detail {

/// A piece of the curve in the frame, and what the requirements on its offset are made of. Interval forms first; exact ones
/// where they are needed.
class Offset_piece {
public:
  template <class T>
  using Forms = Offset_forms<T>;

  Offset_piece(const Curve_piece<2>& piece, const Piece& range) : curve_(std::make_shared<const Curve_piece<2>>(piece)), range_(range)
  {
    find_zeros();
    const std::array<int, 2> zeros = zeros_;
    const auto common = common_;
    exact_ = Lazy<Forms<Rational>>::from([curve = curve_, zeros, common] {
      return Forms<Rational>(curve->numerator, curve->weight, without_common(exact_velocity(*curve, zeros), common));
    });
    const Forms<Rational>* const known = common ? &exact_.get() : nullptr;
    auto along = known ? std::array{enclosing(known->along()[0]), enclosing(known->along()[1])} : enclosed_velocity(zeros);
    enclosed_.emplace(std::array{enclosing(curve_->numerator[0]), enclosing(curve_->numerator[1])}, enclosing(curve_->weight), std::move(along));
    lift_ = tree(enclosed_->lift(), [f = exact_] { return f.get().lift(); });
    square_ = tree({enclosed_->square()}, [f = exact_] { return Vector_form{f.get().square()}; });
    for (std::size_t k = 0; k < 2; ++k) {
      numerator_[k] = Enclosed_function(enclosed_->numerator()[k]);
      along_[k] = Enclosed_function(enclosed_->along()[k]);
    }
    carrier_ = curve_->is_polynomial() ? Carrier() : carrier_of(*curve_);
    weight_ = Enclosed_function(enclosed_->weight());
    length_ = Enclosed_function(enclosed_->square());
  }

  const Curve_piece<2>& curve() const { return *curve_; }
  const Parameter_range& range() const { return range_; }
  const Lazy<Forms<Rational>>& exact() const { return exact_; }
  const Forms<Interval>& forms() const { return *enclosed_; }
  const std::shared_ptr<Vector_tree>& lift() const { return lift_; }
  const std::shared_ptr<Vector_tree>& square() const { return square_; }
  /// Circles are recognised: all of such a piece is as near to an offset point.
  bool is_on_circle() const { return carrier_.kind == Carrier::Kind::circle; }
  bool is_on_circle_of(const Offset_piece& other) const
  {
    return is_on_circle() && other.is_on_circle() && carrier_.centre == other.carrier_.centre && carrier_.squared_radius == other.carrier_.squared_radius;
  }
  /// Of a piece on a circle: whether the offset lies beyond the centre, so that no point of it is kept.
  bool is_beyond_centre(const Rational& distance) const
  {
    const Forms<Rational>& f = exact_.get();
    const auto at_0 = [](const Bernstein<Rational, 1>& x) { return x[0]; };
    const Rational w = at_0(f.weight()), dx = carrier_.centre[0] - at_0(f.numerator()[0]) / w, dy = carrier_.centre[1] - at_0(f.numerator()[1]) / w;
    return distance * (at_0(f.along()[1]) * dx - at_0(f.along()[0]) * dy) > 0 && distance * distance > carrier_.squared_radius;
  }
  /// What changes its sign where the curve reverses inside the piece; null where it does not.
  const std::shared_ptr<const Bernstein<Rational, 1>>& reversal() const { return reversal_; }

  template <class Make_exact>
  static std::shared_ptr<Vector_tree> tree(const std::vector<Bernstein<Interval, 1>>& f, Make_exact make_exact)
  {
    return std::make_shared<Vector_tree>(Enclosed_vector(f), std::move(make_exact));
  }

  // --------------------------------------------------------------------------------------------------- evaluation

  using Point = std::array<Interval, 2>;

  /// The offset point, in the frame. At a double it is evaluated exactly where intervals are poor.
  Point at(const Interval& s, const Rational& distance) const
  {
    const Interval w = weight_.at(s), step = enclosing(distance) / CGAL::sqrt(length_.at(s));
    Point p{numerator_[0].at(s) / w + step * along_[1].at(s), numerator_[1].at(s) / w - step * along_[0].at(s)};
    const bool narrow = std::all_of(p.begin(), p.end(), [](const Interval& c) { return width(c) <= 1e-10 * std::max(1.0, magnitude(c)); });
    return !narrow && s.is_point() ? exactly_at(Rational(s.inf()), distance) : p;
  }

  std::array<Jet<Interval>, 2> jet_at(const Interval& s, const Rational& distance) const
  {
    const Jet<Interval> here(s, Interval(1), Interval(0)), w = weight_.along(here), square = length_.along(here);
    const Interval root = CGAL::sqrt(square.value), half(0.5);
    const Jet<Interval> length = compose(root, Interval(half / root), Interval(-half * half / (square.value * root)), square);
    const Jet<Interval> step = Jet<Interval>(enclosing(distance)) / length;
    return {numerator_[0].along(here) / w + step * along_[1].along(here), numerator_[1].along(here) / w - step * along_[0].along(here)};
  }

private:
  static std::array<Bernstein<Rational, 1>, 2> exact_velocity(const Curve_piece<2>& c, const std::array<int, 2>& zeros)
  {
    const auto d = without_end_zeros<Rational>({velocity_numerator(c.numerator[0], c.weight), velocity_numerator(c.numerator[1], c.weight)}, zeros);
    return {d[0], d[1]};
  }
  static std::array<Bernstein<Rational, 1>, 2> without_common(std::array<Bernstein<Rational, 1>, 2> d, const std::shared_ptr<const Bernstein<Rational, 1>>& common)
  {
    if (common)
      for (auto& x : d) x = is_zero(x) ? x : divide_exactly(x, *common);
    return d;
  }

  std::vector<Bernstein<Interval, 1>> raw_velocity() const
  {
    const Bernstein<Interval, 1> w = enclosing(curve_->weight);
    return {velocity_numerator(enclosing(curve_->numerator[0]), w), velocity_numerator(enclosing(curve_->numerator[1]), w)};
  }
  std::array<Bernstein<Interval, 1>, 2> enclosed_velocity(const std::array<int, 2>& zeros) const
  {
    auto d = without_end_zeros(raw_velocity(), zeros);
    return {std::move(d[0]), std::move(d[1])};
  }

  /// Where the velocity vanishes, exactly: at the ends, and by a common factor inside.
  void find_zeros()
  {
    const auto raw = raw_velocity();
    for (int end = 0; end < 2; ++end)
      if (may_vanish_at_end(raw, end)) {
        const auto exact = exact_velocity(*curve_, {});
        zeros_[static_cast<std::size_t>(end)] = zeros_at_end({exact[0], exact[1]}, end);
      }
    const auto d = enclosed_velocity(zeros_);
    const auto one_sign = [](const Bernstein<Interval, 1>& f) {
      return std::all_of(f.coefficients().begin(), f.coefficients().end(), [](const Interval& c) { return c.inf() > 0; }) ||
             std::all_of(f.coefficients().begin(), f.coefficients().end(), [](const Interval& c) { return c.sup() < 0; });
    };
    if (one_sign(d[0]) || one_sign(d[1])) return;
    const auto exact = exact_velocity(*curve_, zeros_);
    const Integer_polynomial common = common_factor(Polynomial_vector<1, 2>{exact[0], exact[1]});
    if (degree(common) < 1) return;
    Bernstein<Rational, 1> f = bernstein_form(common).rational();
    const auto roots = exact_roots(Bernstein<Scaled_integer, 1>(f), Rational(0), Rational(1));
    const bool changes = std::any_of(roots.roots.begin(), roots.roots.end(), [](const auto& r) { return r.multiplicity % 2 == 1; });
    if (std::find(roots.gaps.begin(), roots.gaps.end(), Sign::positive) == roots.gaps.end()) f = multiply(f, Rational(-1));
    common_ = std::make_shared<const Bernstein<Rational, 1>>(std::move(f));
    if (changes) reversal_ = common_;
  }

  Point exactly_at(const Rational& s, const Rational& distance) const
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const Forms<Rational>& f = exact_.get();
    const Rational w = evaluate_at(f.weight(), s);
    if (w == 0) return {Interval(-infinite, infinite), Interval(-infinite, infinite)};
    const std::array<Rational, 2> d{evaluate_at(f.along()[0], s), evaluate_at(f.along()[1], s)};
    // The step's coordinates by their squares: no cancellation is felt.
    const Rational square = d[0] * d[0] + d[1] * d[1];
    const auto step = [&](const Rational& x) {
      const Interval length = CGAL::sqrt(enclosing(Rational(distance * distance * x * x / square)));
      return sgn(distance) * sgn(x) < 0 ? -length : length;
    };
    const auto p = [&](std::size_t k) { return enclosing(Rational(evaluate_at(f.numerator()[k], s) / w)); };
    return {p(0) + step(d[1]), p(1) - step(d[0])};
  }

  std::shared_ptr<const Curve_piece<2>> curve_;
  Parameter_range range_;
  std::array<int, 2> zeros_{};
  std::shared_ptr<const Bernstein<Rational, 1>> common_, reversal_;
  Lazy<Forms<Rational>> exact_;
  std::optional<Forms<Interval>> enclosed_;
  Carrier carrier_;
  std::shared_ptr<Vector_tree> lift_, square_;
  std::array<Enclosed_function, 2> numerator_, along_;
  Enclosed_function weight_, length_;
};

/// All that a trimmed offset is evaluated from, in the frame.
struct Offset_work {
  Frame<2> frame;
  Extent<2> extent;
  Rational distance; ///< in the frame
  double radius = 0; ///< |distance|, not in the frame
  std::vector<Offset_piece> pieces;

  struct Stretch {
    std::size_t piece = 0;
    int side = 1; ///< the distance's sign for these forms
    double lo = 0, hi = 1;
    double end_error = 0;
  };
  std::vector<Stretch> stretches;

  Rational distance_of(const Stretch& s) const { return s.side > 0 ? distance : Rational(-distance); }

  Arc_point<2> at(std::size_t piece, const Rational& d, const Interval& s) const
  {
    const Offset_piece::Point x = pieces[piece].at(s, d);
    Approximate_point<2> point;
    double size = 0, widest = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      point[k] = representative(frame.out_of(x[k], k));
      size += std::abs(point[k]);
      widest = std::max(widest, width(x[k]));
    }
    const Range parameter = pieces[piece].range().at(s);
    if (!(widest <= std::numeric_limits<double>::max())) return {{parameter}, point, radius, std::numeric_limits<double>::infinity()};
    return {{parameter}, point, radius, frame.length(Interval(2) * Interval(widest)).sup() + 8 * operation_error * size};
  }
  Arc_point<2> at(const Stretch& s, double x) const
  {
    return at(s.piece, distance_of(s), Interval(std::min(s.hi, std::max(s.lo, s.lo + x * (s.hi - s.lo)))));
  }
};

/// Points along a stretch so that the segments between them are proved to be near.
class Offset_tracer {
public:
  Offset_tracer(const Offset_work& work, const Offset_work::Stretch& stretch, double tolerance)
    : work_(work), stretch_(stretch), distance_(work.distance_of(stretch)), tolerance_(tolerance)
  {
  }

  Polyline<2> run()
  {
    points_.push_back(work_.at(stretch_.piece, distance_, Interval(stretch_.lo)));
    if (line_of(work_.pieces[stretch_.piece].curve())) points_.push_back(work_.at(stretch_.piece, distance_, Interval(stretch_.hi)));
    else descend(stretch_.lo, stretch_.hi, 0);
    double error = work_.frame.length(Interval(0, deviation_)).sup(); // an infinite one, too, where nothing is proved
    double point_error = 0;
    for (const auto& p : points_) point_error = std::max(point_error, p.error());
    error += point_error + stretch_.end_error;
    return {std::move(points_), error};
  }

private:
  static constexpr int deepest = 16;

  void descend(double lo, double hi, int depth)
  {
    const double deviation = chord_deviation(lo, hi), middle = 0.5 * (lo + hi);
    if (depth < 2 || (!(deviation <= tolerance_) && depth < deepest)) {
      if (middle > lo && middle < hi) {
        descend(lo, middle, depth + 1);
        descend(middle, hi, depth + 1);
        return;
      }
    }
    deviation_ = std::max(deviation_, deviation);
    points_.push_back(work_.at(stretch_.piece, distance_, Interval(hi)));
  }

  /// From the linear interpolation: at most h²/8 times the second derivative. Where the curve runs forward along a direction near
  /// the chord's, what is across it counts, and what is along it as far as the chord is inclined.
  double chord_deviation(double lo, double hi) const
  {
    const auto jets = work_.pieces[stretch_.piece].jet_at(Interval(lo, hi), distance_);
    std::array<double, 2> along{midpoint(jets[0].first), midpoint(jets[1].first)};
    const double length = std::hypot(along[0], along[1]);
    double bend = CGAL::sqrt(CGAL::square(Interval(0, magnitude(jets[0].second))) + CGAL::square(Interval(0, magnitude(jets[1].second)))).sup();
    if (length > 0 && std::isfinite(length)) {
      const Interval x = Interval(along[0]) / Interval(length), y = Interval(along[1]) / Interval(length), forward = x * jets[0].first + y * jets[1].first;
      if (forward.inf() > 0) {
        const Interval size = CGAL::sqrt(CGAL::square(x) + CGAL::square(y)), inclined = CGAL::abs(x * jets[1].first - y * jets[0].first) / forward;
        const Interval across = CGAL::abs(x * jets[1].second - y * jets[0].second) / size + inclined * Interval(0, bend);
        bend = std::min(bend, across.sup());
      }
    }
    const double d = (Interval(0, bend) * CGAL::square(Interval(hi) - Interval(lo)) / Interval(8)).sup();
    return d >= 0 ? d : std::numeric_limits<double>::infinity();
  }

  const Offset_work& work_;
  const Offset_work::Stretch& stretch_;
  Rational distance_;
  double tolerance_, deviation_ = 0;
  std::vector<Arc_point<2>> points_;
};

} // namespace detail

/// The trimmed offset of a curve at a signed distance d: of r(u) + d·n(u), n = (y', -x')/|r'| to the right of the curve, the
/// parts that are as far from the whole curve as |d|, (29) of Farouki & Johnstone 1994. Immutable.
class Trimmed_offset {
public:
  Trimmed_offset(Rational distance, std::shared_ptr<const detail::Offset_work> work, std::vector<Offset_interval> intervals,
                 std::vector<Undecided_piece> undecided, Locus_statistics statistics)
    : distance_(std::move(distance)), work_(std::move(work)), intervals_(std::move(intervals)), undecided_(std::move(undecided)), statistics_(statistics)
  {
  }

  Status status() const { return undecided_.empty() ? Status::certified : Status::undecided; }
  const Rational& distance() const { return distance_; }
  /// Kept: the least distance of the offset point to the curve is |d|. Between them it is less, but at single parameters, and but
  /// for what is undecided. In the order of the parameter, each in one piece.
  const std::vector<Offset_interval>& intervals() const { return intervals_; }
  const std::vector<Undecided_piece>& undecided() const { return undecided_; }
  const Locus_statistics& statistics() const { return statistics_; }
  /// Diameter of the curve (of its control polygon's bounding box).
  double scale() const { return with_upward_rounding([&] { return work_->frame.length(Interval(work_->extent.scale)).sup(); }); }

  /// The offset point at x from 0 to 1 between an interval's ends, with a proved bound of its error. An infinite end is cut off.
  Arc_point<2> at(std::size_t interval, double x) const
  {
    return with_upward_rounding([&] { return work_->at(work_->stretches[interval], x); });
  }
  /// A polyline proved to lie within `error()` of an interval's offset, both ways: about `relative_tolerance` times the greater of
  /// the curve's diameter and |d|, if doubles allow it. Parts to infinity are cut off far from the curve.
  Polyline<2> polyline(std::size_t interval, double relative_tolerance) const
  {
    return with_upward_rounding([&] {
      const double size = std::max(work_->extent.scale, std::abs(nearest_double(work_->distance)));
      return detail::Offset_tracer(*work_, work_->stretches[interval], relative_tolerance * size).run();
    });
  }

private:
  Rational distance_;
  std::shared_ptr<const detail::Offset_work> work_;
  std::vector<Offset_interval> intervals_;
  std::vector<Undecided_piece> undecided_;
  Locus_statistics statistics_;
};

namespace detail {

class Offset_maker {
public:
  Offset_maker(const Curve_2& curve, const Rational& distance, const Offset_options& options)
    : start_(std::chrono::steady_clock::now()), chain_(curve.chain()), control_(options.control), given_(distance), work_(std::make_shared<Offset_work>())
  {
    std::vector<Exact_point<2>> points;
    collect_control_points(curve, points);
    work_->frame = fitting_frame<2>(points);
    require_drawable(work_->frame);
    work_->extent = extent_in<2>(work_->frame, points);
    work_->distance = Frame<2>{{}, work_->frame.exponent}.into(distance, 0);
    if (!(magnitude(enclosing(work_->distance)) < 0x1p300)) throw Unsupported_feature("an offset distance beyond 2^300 times the curve's size");
    work_->radius = std::abs(nearest_double(distance));
    for (std::size_t i = 0; i < curve.pieces().size(); ++i)
      work_->pieces.emplace_back(with_unit_forms(in_frame(curve.pieces()[i], work_->frame)), chain_.pieces[i]);
  }

  Trimmed_offset make()
  {
    for (std::size_t i = 0; i < work_->pieces.size(); ++i) {
      const auto& reversal = work_->pieces[i].reversal();
      solve(i, 1, reversal);
      if (reversal) solve(i, -1, reversal);
    }
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      return a.piece != b.piece ? a.piece < b.piece : a.ends[0].lo < b.ends[0].lo;
    });
    std::vector<Offset_interval> intervals;
    for (const Found& f : found_) {
      Offset_interval interval;
      interval.piece = f.piece;
      Offset_work::Stretch stretch{f.piece, f.side, f.ends[0].hi, f.ends[1].lo, 0};
      for (int e = 0; e < 2; ++e) {
        Offset_end& end = interval.ends[static_cast<std::size_t>(e)];
        end = made_end(f, e);
        if (end.kind == Offset_end_kind::infinity) (e == 0 ? stretch.lo : stretch.hi) = stop_before(stretch, e);
        else if (!f.ends[static_cast<std::size_t>(e)].is_exact()) stretch.end_error = std::max(stretch.end_error, end.error);
      }
      if (stretch.lo > stretch.hi) std::swap(stretch.lo, stretch.hi); // as short as its ends' enclosures
      work_->stretches.push_back(stretch);
      intervals.push_back(std::move(interval));
    }
    statistics_.pairs = work_->pieces.size() * work_->pieces.size();
    statistics_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return {given_, work_, std::move(intervals), std::move(undecided_), statistics_};
  }

private:
  struct Found {
    std::size_t piece;
    int side;
    std::array<Feasible_end, 2> ends;
    std::array<bool, 2> reverses{};
  };

  /// As closely as an end is enclosed.
  static constexpr double end_width = 0x1p-42;

  // ------------------------------------------------------------------------------------------------- requirements

  void solve(std::size_t i, int side, const std::shared_ptr<const Bernstein<Rational, 1>>& reversal)
  {
    const Offset_piece& piece = work_->pieces[i];
    const Rational d = side > 0 ? work_->distance : Rational(-work_->distance);
    if (piece.is_on_circle() && piece.is_beyond_centre(d)) return;
    const Interval enclosed_d = enclosing(d);
    std::vector<Requirement> requirements;
    const auto make = [&](typename Offset_forms<Interval>::Pair pair, std::shared_ptr<Vector_tree> b, auto exact_pair) {
      Requirement r;
      r.a = Offset_piece::tree(pair.first, [exact_pair] { return exact_pair().first; });
      r.rest = Offset_piece::tree(pair.second, [exact_pair] { return exact_pair().second; });
      r.b = std::move(b);
      r.square = piece.square();
      return r;
    };
    if (reversal) {
      const Vector_form sign{multiply(*reversal, Rational(side))};
      requirements.push_back({std::make_shared<Vector_tree>(sign), basis_tree(1)});
    }
    if (!piece.is_on_circle()) {
      auto own = piece.forms().own_pair(enclosed_d);
      const std::size_t size = own.first.size();
      const Requirement self = make(std::move(own), basis_tree(size), [f = piece.exact(), d] { return f.get().own_pair(d); });
      if (!is_on_tangent(self)) requirements.push_back(self);
    }
    Requirement other = make(piece.forms().pair(enclosed_d), nullptr, [f = piece.exact(), d] { return f.get().pair(d); });
    for (std::size_t j = 0; j < work_->pieces.size(); ++j) {
      if (j == i || same_path(j, i) || repeats_earlier_piece(j) || piece.is_on_circle_of(work_->pieces[j])) continue;
      other.b = work_->pieces[j].lift();
      if (!is_on_tangent(other)) requirements.push_back(other);
    }
    run(i, side, requirements, reversal);
  }

  void run(std::size_t i, int side, const std::vector<Requirement>& requirements, const std::shared_ptr<const Bernstein<Rational, 1>>& reversal)
  {
    Feasible_set set = Feasible_set_solver(requirements, control_).run();
    statistics_.cells += set.cells;
    statistics_.exact_cells += set.algebraic_cells;
    statistics_.filter += set.filter;
    Feasible_end_refiner refiner(requirements, statistics_.filter);
    for (Feasible_interval& interval : set.intervals) {
      Found f{i, side, {}, {}};
      for (int e = 0; e < 2; ++e) {
        Feasible_end& end = interval.ends[static_cast<std::size_t>(e)];
        refiner.narrow(end, e, end_width);
        f.reverses[static_cast<std::size_t>(e)] = reversal && reverses_at(*reversal, end, e, refiner);
        f.ends[static_cast<std::size_t>(e)] = std::move(end);
      }
      found_.push_back(std::move(f));
    }
    for (const auto& u : set.undecided) {
      undecided_ends_.push_back({i, u});
      Undecided_piece undecided;
      undecided.box = {work_->pieces[i].range().at(Interval(u[0], u[1]))};
      undecided.reason = "whether the offset is as far from the whole curve was not decided within the limits";
      undecided_.push_back(std::move(undecided));
    }
  }

  /// Whether the rest vanishes identically: two pieces on one line.
  static bool is_on_tangent(const Requirement& r)
  {
    Product_table table;
    table.make(r.rest->node(0).f, r.b->node(0).f);
    if (!std::all_of(table.c.begin(), table.c.end(), [&](double x) { return std::abs(x) <= table.error; })) return false;
    const Bernstein<Rational, 2> f = product_of(r.rest->exact(), r.b->exact());
    return std::all_of(f.coefficients().begin(), f.coefficients().end(), [](const Rational& c) { return c == 0; });
  }

  bool same_path(std::size_t i, std::size_t j) const
  {
    const auto same = [](const Bernstein<Rational, 1>& a, const Bernstein<Rational, 1>& b, bool reversed) {
      if (a.size() != b.size()) return false;
      return reversed ? std::equal(a.coefficients().begin(), a.coefficients().end(), b.coefficients().rbegin()) : a.coefficients() == b.coefficients();
    };
    const Curve_piece<2>&a = work_->pieces[i].curve(), &b = work_->pieces[j].curve();
    return std::any_of(std::begin(both_senses), std::end(both_senses), [&](bool reversed) {
      return same(a.numerator[0], b.numerator[0], reversed) && same(a.numerator[1], b.numerator[1], reversed) && same(a.weight, b.weight, reversed);
    });
  }
  static constexpr bool both_senses[] = {false, true};

  bool repeats_earlier_piece(std::size_t j) const
  {
    for (std::size_t k = 0; k < j; ++k)
      if (same_path(k, j)) return true;
    return false;
  }

  std::shared_ptr<Vector_tree> basis_tree(std::size_t size)
  {
    if (bases_.size() <= size) bases_.resize(size + 1);
    if (!bases_[size]) {
      Vector_form basis;
      for (std::size_t k = 0; k < size; ++k) {
        Bernstein<Rational, 1> b(Degrees<1>{static_cast<int>(size) - 1});
        b[k] = 1;
        basis.push_back(std::move(b));
      }
      bases_[size] = std::make_shared<Vector_tree>(std::move(basis));
    }
    return bases_[size];
  }

  /// Whether an end is where the curve reverses: the first requirement's polynomial vanishes there.
  static bool reverses_at(const Bernstein<Rational, 1>& reversal, Feasible_end& end, int side, Feasible_end_refiner& refiner)
  {
    if (end.is_exact()) return end.lo > 0 && end.lo < 1 && evaluate_at(reversal, Rational(end.lo)) == 0;
    const Integer_polynomial form = monomial_form(Bernstein<Scaled_integer, 1>(reversal));
    if (!has_root_within(form, Rational(end.lo), Rational(end.hi))) return false;
    if (!refiner.make_algebraic(end, side)) return false;
    refiner.narrow(end, side, end_width);
    return has_root_within(gcd(form, *end.algebraic->polynomial), end.algebraic->lo, end.algebraic->hi);
  }

  // --------------------------------------------------------------------------------------------------------- ends

  Offset_end made_end(const Found& f, int e) const
  {
    const auto i = static_cast<std::size_t>(e);
    const Feasible_end& end = f.ends[i];
    const Offset_piece& piece = work_->pieces[f.piece];
    Offset_end made;
    made.kind = kind_of(f, e);
    made.parameter = piece.range().at(Interval(end.lo, end.hi));
    if (end.is_exact()) made.exact = chain_.pieces[f.piece].at(Rational(end.lo));
    else if (end.algebraic && end.algebraic->lo == end.algebraic->hi) made.exact = chain_.pieces[f.piece].at(end.algebraic->lo);
    if (made.kind == Offset_end_kind::infinity) return made;
    const Arc_point<2> p = work_->at(f.piece, f.side > 0 ? work_->distance : Rational(-work_->distance), Interval(end.lo, end.hi));
    made.point = p.point();
    made.error = p.error();
    return made;
  }

  static bool is_smooth(const Joint& joint) { return joint.goes_on() && !joint.by_tolerance; }

  Offset_end_kind kind_of(const Found& f, int e) const
  {
    const Feasible_end& end = f.ends[static_cast<std::size_t>(e)];
    if (f.reverses[static_cast<std::size_t>(e)]) return Offset_end_kind::cusp;
    if (end.is_exact())
      for (const auto& u : undecided_ends_)
        if (u.piece == f.piece && u.at[static_cast<std::size_t>(1 - e)] == end.lo) return Offset_end_kind::undecided;
    if (!end.is_exact() || end.lo != e) return Offset_end_kind::trim;
    const auto& weight = work_->pieces[f.piece].curve().weight;
    if (weight[e == 0 ? 0 : weight.size() - 1] == 0) return Offset_end_kind::infinity;
    const Joint* joint = chain_.joint_at(f.piece, e);
    if (!joint) return Offset_end_kind::domain;
    if (!is_smooth(*joint)) return Offset_end_kind::corner;
    const std::size_t next = chain_.neighbour(f.piece, e);
    const auto meets = [&](double at) { return at == 1 - e; };
    for (const Found& g : found_) {
      const Feasible_end& other = g.ends[static_cast<std::size_t>(1 - e)];
      if (g.piece == next && other.is_exact() && meets(other.lo)) return Offset_end_kind::joint;
    }
    for (const auto& u : undecided_ends_)
      if (u.piece == next && meets(u.at[static_cast<std::size_t>(1 - e)])) return Offset_end_kind::undecided;
    return Offset_end_kind::trim;
  }

  /// Towards an infinite end as far as is drawn.
  double stop_before(const Offset_work::Stretch& stretch, int e) const
  {
    const double end = e == 0 ? stretch.lo : stretch.hi, far = cut_factor * (work_->extent.scale + std::abs(nearest_double(work_->distance)));
    double s = 0.5 * (stretch.lo + stretch.hi);
    for (int k = 0; k < 60; ++k) {
      const auto p = work_->pieces[stretch.piece].at(Interval(s), work_->distance_of(stretch));
      const double x = midpoint(p[0]) - work_->extent.centre[0], y = midpoint(p[1]) - work_->extent.centre[1];
      const double next = 0.5 * (s + end);
      if (!(std::abs(x) + std::abs(y) < far) || next == end) break;
      s = next;
    }
    return s;
  }

  struct Undecided_end {
    std::size_t piece;
    std::array<double, 2> at;
  };

  std::chrono::steady_clock::time_point start_;
  Chain chain_;
  Solve_control control_;
  Rational given_;
  std::shared_ptr<Offset_work> work_;
  std::vector<std::shared_ptr<Vector_tree>> bases_;
  std::vector<Found> found_;
  std::vector<Undecided_end> undecided_ends_;
  std::vector<Undecided_piece> undecided_;
  Locus_statistics statistics_;
};

} // namespace detail

/// The trimmed offset at a signed distance d ≠ 0, to the right of the curve for positive d, certified: the parameters whose offset
/// point has no point of the curve nearer than |d|. Ends and corners belong to the curve and can be the nearest points; the
/// circular arcs about them, with which the trimmed offsets of both sides make a level curve of the distance (Remark 2.1), are not
/// offset points and not listed. At corners the offset of either piece is trimmed by the other.
/// Where a curve reverses inside a piece its right side changes, and the offset with it.
/// Throws Invalid_input for d = 0. Cost: for each piece some ten cells, each O(degree²) for every piece that is not yet known to be
/// farther; elimination only where d is a radius of curvature or feet are tied.
inline Trimmed_offset trimmed_offset(const Curve_2& curve, const Number& distance, const Offset_options& options = {})
{
  if (distance.value() == 0) throw Invalid_input(".distance", "an offset needs a distance that is not zero", "give a positive or a negative number");
  return with_upward_rounding([&] { return detail::Offset_maker(curve, distance.value(), options).make(); });
}

} // namespace locus

#endif
