// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_RATIONAL_PATH_H
#define LOCUS_CONSTRUCT_RATIONAL_PATH_H

#include <locus/construct/curve_evaluator.h>
#include <locus/construct/extent.h>
#include <locus/construct/locus.h>
#include <locus/construct/parameter_range.h>
#include <locus/function/lazy.h>
#include <locus/shape/rational_map.h>

namespace locus {
namespace detail {

/// Homogeneous coordinates in a frame as enclosed functions.
template <int Dim>
class Map_evaluator {
public:
  static constexpr auto size = static_cast<std::size_t>(Dim);
  using Point = std::array<Interval, size>;

  /// Over rationals or over intervals.
  template <class T>
  Map_evaluator(const std::array<Bernstein<T, 1>, size>& numerator, const Bernstein<T, 1>& weight) : weight_(weight)
  {
    for (std::size_t k = 0; k < size; ++k) numerator_[k] = Enclosed_function(numerator[k]);
  }

  Point at(const Interval& s) const
  {
    const Interval w = weight_.at(s);
    return vector_of<size>([&](std::size_t k) { return Interval(numerator_[k].at(s) / w); });
  }
  std::array<Jet<Interval>, size> jet_at(const Interval& s) const
  {
    const Jet<Interval> here(s, Interval(1), Interval(0)), w = weight_.along(here);
    return vector_of<size>([&](std::size_t k) { return numerator_[k].along(here) / w; });
  }

private:
  std::array<Enclosed_function, size> numerator_;
  Enclosed_function weight_;
};

/// A rational curve that was derived from an input, with all that its arcs share. Coordinates are the frame's.
template <int Dim>
struct Path_work {
  static constexpr auto size = static_cast<std::size_t>(Dim);

  struct Piece_work {
    Lazy<Curve_piece<Dim>> forms, foot_forms;           ///< of the derived curve, and of the one with its feet
    std::array<Bernstein<Interval, 1>, size> numerator; ///< enclosed, relative to the inputs' middle
    Bernstein<Interval, 1> weight;
    std::optional<Map_evaluator<Dim>> image, foot;
    Parameter_range range;
    std::optional<Range> fixed;  ///< the other foot's parameter, if it has one
    bool is_fixed_first = false; ///< whether it is listed before the varying one

    std::vector<Range> parameters(const Interval& s) const
    {
      std::vector<Range> all{range.at(s)};
      if (fixed) all.insert(is_fixed_first ? all.begin() : all.end(), *fixed);
      return all;
    }
  };

  Frame<Dim> frame;
  double scale = 1, cut_radius = cut_factor;
  std::array<double, size> centre{};
  std::vector<Piece_work> pieces;

  using Point = std::array<Interval, size>;

  /// The point of a local parameter, in the inputs' coordinates. At a double it is evaluated exactly where intervals are poor.
  Arc_point<Dim> at(std::size_t piece, const Interval& s) const
  {
    const Piece_work& p = pieces[piece];
    Point x = p.image->at(s);
    if (s.is_point() && !is_narrow(x)) x = exactly(p.forms.get(), Rational(s.inf()));
    Interval radius(0);
    if (p.foot) {
      Point y = p.foot->at(s);
      if (s.is_point() && !is_narrow(y)) y = exactly(p.foot_forms.get(), Rational(s.inf()));
      for (std::size_t k = 0; k < size; ++k) radius += CGAL::square(x[k] - y[k]);
      radius = frame.length(CGAL::sqrt(radius));
    }
    Approximate_point<Dim> point;
    double magnitude_sum = 0, widest = 0;
    for (std::size_t k = 0; k < size; ++k) {
      point[k] = representative(frame.out_of(x[k], k));
      magnitude_sum += std::abs(point[k]);
      widest = std::max(widest, width(x[k]));
    }
    if (!(widest <= std::numeric_limits<double>::max())) return {p.parameters(s), point, 0, std::numeric_limits<double>::infinity()};
    const double error = frame.length(Interval(static_cast<double>(Dim)) * Interval(widest)).sup() + 8 * operation_error * magnitude_sum;
    return {p.parameters(s), point, std::max(0.0, representative(radius)), error};
  }

private:
  static bool is_narrow(const Point& x)
  {
    return std::all_of(x.begin(), x.end(), [](const Interval& c) { return width(c) <= 1e-10 * std::max(1.0, magnitude(c)); });
  }

  /// Infinite at a pole.
  static Point exactly(const Curve_piece<Dim>& forms, const Rational& s)
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const Rational w = evaluate_at(forms.weight, s);
    return vector_of<size>([&](std::size_t k) {
      return w == 0 ? Interval(-infinite, infinite) : enclosing(Rational(evaluate_at(forms.numerator[k], s) / w));
    });
  }
};

/// A stretch of one piece between two of its parameters, both finite places of the curve.
struct Path_leg {
  std::size_t piece = 0;
  double lo = 0, hi = 1;
};

/// An arc of a derived rational curve: legs one after another.
template <int Dim>
class Rational_path : public Arc_geometry<Dim> {
public:
  /// `end_error`: how far the ends of the legs may be from the arc's own, in the inputs' units.
  Rational_path(std::shared_ptr<const Path_work<Dim>> work, std::vector<Path_leg> legs, Irregular_points<Dim> irregular, double end_error = 0)
    : work_(std::move(work)), legs_(std::move(legs)), irregular_(std::move(irregular)), end_error_(end_error)
  {
  }

  Arc_point<Dim> at(double x) const override
  {
    return with_upward_rounding([&] { return point_at(x); });
  }

  Arc_differential<Dim> differential(double x) const override
  {
    return with_upward_rounding([&] {
      const auto [leg, s] = place(x);
      const auto jets = work_->pieces[leg.piece].image->jet_at(Interval(s));
      Arc_differential<Dim> d;
      std::array<double, static_cast<std::size_t>(Dim)> first, second;
      double square = 0, along = 0, second_square = 0;
      for (std::size_t k = 0; k < first.size(); ++k) {
        first[k] = midpoint(jets[k].first);
        second[k] = midpoint(jets[k].second);
        square += first[k] * first[k];
        along += first[k] * second[k];
        second_square += second[k] * second[k];
      }
      const double speed = std::sqrt(square);
      for (std::size_t k = 0; k < first.size(); ++k) d.tangent[k] = first[k] / speed;
      const double bend = Dim == 2 ? first[0] * second[1] - first[1] * second[0]
                                   : std::sqrt(std::max(0.0, square * second_square - along * along));
      d.curvature = std::ldexp(bend / (square * speed), static_cast<int>(-work_->frame.exponent));
      return d;
    });
  }

  std::vector<Arc_point<Dim>> samples(std::size_t n) const override
  {
    return with_upward_rounding([&] {
      std::vector<Arc_point<Dim>> points;
      const std::size_t count = std::max<std::size_t>(n, 2);
      for (std::size_t i = 0; i < count; ++i)
        points.push_back(point_at(static_cast<double>(i) / static_cast<double>(count - 1)));
      return points;
    });
  }

  Polyline<Dim> polyline(double relative_tolerance) const override
  {
    return with_upward_rounding([&] {
      Draft draft;
      // Where the tolerance asks for too many points a greater one is tried: the error tells.
      for (double tolerance = std::max(relative_tolerance, 0x1p-60) * work_->scale;; tolerance *= 16) {
        draft = drawn_within(tolerance);
        if (draft.points.size() <= most_points) break;
      }
      double rounding = 0;
      for (const auto& p : draft.points) rounding = std::max(rounding, p.error());
      const double bend = std::isfinite(draft.error) ? work_->frame.length(Interval(draft.error)).sup() : draft.error;
      return Polyline<Dim>(std::move(draft.points), bend + rounding + end_error_);
    });
  }

  Irregular_points<Dim> irregular() const override { return irregular_; }

private:
  static constexpr auto size = static_cast<std::size_t>(Dim);

  struct Draft {
    std::vector<Arc_point<Dim>> points;
    double tolerance = 0, error = 0; ///< in frame units
  };

  static constexpr std::size_t most_points = 100000;

  /// One point more than `most_points` where these do not do.
  Draft drawn_within(double tolerance) const
  {
    Draft draft;
    draft.tolerance = tolerance;
    for (const Path_leg& leg : legs_) {
      const auto& piece = work_->pieces[leg.piece];
      Part part{leg.lo, leg.hi, piece.numerator, piece.weight, 1, false};
      part.restrict_from_unit();
      if (draft.points.empty()) draft.points.push_back(work_->at(leg.piece, Interval(leg.lo)));
      refine(leg.piece, part, 0, draft);
    }
    return draft;
  }

  /// The curve on a part of a piece, in Bernstein form on [lo, hi].
  struct Part {
    double lo, hi;
    std::array<Bernstein<Interval, 1>, size> numerator;
    Bernstein<Interval, 1> weight;
    double enclosed_on; ///< the length of the part on which the forms were enclosed: their errors are of that part's size
    bool is_fresh = false; ///< on this very part

    void restrict_from_unit()
    {
      if (lo == 0 && hi == 1) return;
      for (auto& f : numerator) f = restrict_to(f, 0, Interval(lo), Interval(hi));
      weight = restrict_to(weight, 0, Interval(lo), Interval(hi));
    }
    std::array<Part, 2> halves() const
    {
      const double mid = 0.5 * (lo + hi);
      std::array<Part, 2> parts{Part{lo, mid, {}, {}, enclosed_on, false}, Part{mid, hi, {}, {}, enclosed_on, false}};
      for (std::size_t k = 0; k < size; ++k) {
        auto both = split(numerator[k], 0, Interval(0.5));
        parts[0].numerator[k] = std::move(both.first);
        parts[1].numerator[k] = std::move(both.second);
      }
      auto both = split(weight, 0, Interval(0.5));
      parts[0].weight = std::move(both.first);
      parts[1].weight = std::move(both.second);
      return parts;
    }
  };

  std::pair<Path_leg, double> place(double x) const
  {
    const double along = std::min(1.0, std::max(0.0, x)) * static_cast<double>(legs_.size());
    const std::size_t k = std::min(legs_.size() - 1, static_cast<std::size_t>(along));
    const double f = along - static_cast<double>(k);
    return {legs_[k], std::min(legs_[k].hi, legs_[k].lo + f * (legs_[k].hi - legs_[k].lo))};
  }

  Arc_point<Dim> point_at(double x) const
  {
    const auto [leg, s] = place(x);
    return work_->at(leg.piece, Interval(s));
  }

  /// Adds the points after the first one. The curve lies in the hull of its control points, so their greatest distance from
  /// the chord bounds its own; the chord's distance from the curve is no greater, since the curve runs from end to end.
  /// It ends where roundings are most of the distance: halving would not help.
  void refine(std::size_t piece, const Part& part, int depth, Draft& draft) const
  {
    constexpr int deepest = 100;
    if (draft.points.size() > most_points) return;
    const Arc_point<Dim> last = work_->at(piece, Interval(part.hi));
    const auto [distance, rounding] = distance_from_chord(part, draft.points.back().point(), last.point());
    // Beyond the cut radius the tolerance grows with the distance: an end may be finite and very far away.
    const double tolerance = draft.tolerance * std::max(1.0, std::min(distance_of(draft.points.back().point()), distance_of(last.point())) / work_->cut_radius);
    if (!part.is_fresh && is_poor(distance, rounding, tolerance) && part.hi - part.lo <= 0x1p-8 * part.enclosed_on) return refine(piece, afresh(piece, part), depth, draft);
    const double mid = 0.5 * (part.lo + part.hi);
    const bool is_done = distance <= tolerance || (part.is_fresh && distance <= 4 * rounding);
    if (is_done || depth == deepest || !(mid > part.lo && mid < part.hi)) {
      draft.error = std::max(draft.error, distance);
      draft.points.push_back(last);
      return;
    }
    const auto halves = part.halves();
    refine(piece, halves[0], depth + 1, draft);
    refine(piece, halves[1], depth + 1, draft);
  }

  using Point = std::array<Interval, size>;

  /// Roundings, not bending, are what keeps the distance from being small.
  static bool is_poor(double distance, double rounding, double tolerance)
  {
    return !std::isfinite(distance) || (distance > tolerance && distance <= 4 * rounding);
  }

  /// From the inputs' middle, about, in frame units.
  double distance_of(const Approximate_point<Dim>& p) const
  {
    const Point x = framed(p);
    double square = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const double d = midpoint(x[k]) - work_->centre[k];
      square += d * d;
    }
    return std::sqrt(square);
  }

  /// The same part, its forms enclosed from exact ones on it.
  Part afresh(std::size_t piece, const Part& part) const
  {
    const Curve_piece<Dim>& forms = work_->pieces[piece].forms.get();
    const Rational lo(part.lo), hi(part.hi);
    const auto on_part = [&](const Bernstein<Rational, 1>& f) { return enclosing(restrict_to(f, 0, lo, hi)); };
    Part fresh{part.lo, part.hi, {}, on_part(forms.weight), part.hi - part.lo, true};
    for (std::size_t k = 0; k < size; ++k)
      fresh.numerator[k] = on_part(subtract(forms.numerator[k], multiply(forms.weight, Rational(work_->centre[k]))));
    return fresh;
  }

  /// A printed point in frame coordinates.
  Point framed(const Approximate_point<Dim>& p) const
  {
    const int e = static_cast<int>(-work_->frame.exponent);
    return vector_of<size>([&](std::size_t k) {
      const Interval x = Interval(p[k]) - enclosing(work_->frame.origin[k]);
      return Interval(std::ldexp(x.inf(), e), std::ldexp(x.sup(), e));
    });
  }

  /// With how much of it roundings may account for, both in frame units. Infinite where the weight's coefficients have no common sign.
  std::pair<double, double> distance_from_chord(const Part& part, const Approximate_point<Dim>& first, const Approximate_point<Dim>& last) const
  {
    const Point from = framed(first), to = framed(last);
    double greatest = 0, rounding = 0;
    const bool positive = part.weight[0].inf() > 0;
    for (std::size_t i = 0; i < part.weight.size(); ++i) {
      const Interval& w = part.weight[i];
      if (!(positive ? w.inf() > 0 : w.sup() < 0)) return {std::numeric_limits<double>::infinity(), 0};
      Interval along(0), length2(0), square(0);
      Point p;
      for (std::size_t k = 0; k < size; ++k) {
        const Interval x = part.numerator[k][i] / w;
        rounding = std::max(rounding, width(x));
        p[k] = x + Interval(work_->centre[k]) - from[k];
        const Interval d = to[k] - from[k];
        along += p[k] * d;
        length2 += CGAL::square(d);
      }
      // Any point of the chord bounds the distance from above: a good one.
      const double f = length2.inf() > 0 ? std::min(1.0, std::max(0.0, midpoint(along) / midpoint(length2))) : 0.0;
      for (std::size_t k = 0; k < size; ++k) square += CGAL::square(p[k] - Interval(f) * (to[k] - from[k]));
      greatest = std::max(greatest, CGAL::sqrt(square).sup());
    }
    return {greatest, rounding};
  }

  std::shared_ptr<const Path_work<Dim>> work_;
  std::vector<Path_leg> legs_;
  Irregular_points<Dim> irregular_;
  double end_error_ = 0;
};

} // namespace detail
} // namespace locus

#endif
