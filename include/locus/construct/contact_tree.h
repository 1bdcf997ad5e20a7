// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CONTACT_TREE_H
#define LOCUS_CONSTRUCT_CONTACT_TREE_H

#include <locus/constraint/contact_forms.h>
#include <locus/constraint/curvature_forms.h>
#include <locus/function/enclosed_vector.h>
#include <locus/function/lazy.h>

#include <deque>

namespace locus {
namespace detail {

/// The coefficients of a family of circles, c + x·slope for x in [-1, 1], in doubles, each with a bound of its error.
struct Circle {
  std::array<double, 4> c{}, slope{}, error{};

  Circle() = default;
  /// Upward rounding needed.
  explicit Circle(const std::array<Interval, 4>& coefficients)
  {
    for (std::size_t k = 0; k < 4; ++k) {
      c[k] = midpoint(coefficients[k]);
      error[k] = std::max(coefficients[k].sup() - c[k], -(coefficients[k].inf() - c[k]));
      if (!(error[k] < std::numeric_limits<double>::infinity())) error[k] = std::numeric_limits<double>::infinity();
    }
  }
  Circle(const std::array<Interval, 4>& coefficients, const std::array<Interval, 4>& slopes) : Circle(coefficients)
  {
    const Circle other(slopes);
    slope = other.c;
    for (std::size_t k = 0; k < 4; ++k) error[k] += other.error[k];
  }

  double greatest_error() const { return *std::max_element(error.begin(), error.end()); }
};

/// The Bernstein coefficients of a form along a part of a curve, for all circles of an enclosure: values with error bounds.
/// Holds in any rounding mode.
class Contact_row {
public:
  /// Of the `order`-th derivative, up to a positive factor, of the first `rank` coefficients' combination.
  void make(const Circle& circle, const Enclosed_vector& f, int order)
  {
    const std::size_t n = f.count();
    value_.assign(n, 0.0);
    error_.assign(n, 0.0);
    slope_.assign(n, 0.0);
    double norm = 0;
    for (std::size_t k = 0; k < f.rank(); ++k) {
      difference_.assign(f.component(k), f.component(k) + n);
      for (int d = 0; d < order; ++d)
        for (std::size_t j = 0; j + 1 < difference_.size() - static_cast<std::size_t>(d); ++j) difference_[j] = difference_[j + 1] - difference_[j];
      for (std::size_t j = 0; j < n; ++j) {
        value_[j] += circle.c[k] * difference_[j];
        slope_[j] += circle.slope[k] * difference_[j];
        error_[j] += circle.error[k] * std::abs(difference_[j]);
      }
      norm += std::abs(circle.c[k]) + std::abs(circle.slope[k]) + circle.error[k];
    }
    const auto rank = static_cast<double>(f.rank());
    const double common = std::ldexp((f.error() + (order + rank + 2) * operation_error * f.norm()) * norm, order) + 0x1p-1000;
    const std::size_t size = n > static_cast<std::size_t>(order) ? n - static_cast<std::size_t>(order) : 0;
    value_.resize(size);
    error_.resize(size);
    for (std::size_t j = 0; j < size; ++j) error_[j] = (error_[j] + std::abs(slope_[j]) + common) * (1 + 16 * operation_error);
  }

  std::size_t size() const { return value_.size(); }
  Sign sign_at(std::size_t j) const { return value_[j] > error_[j] ? Sign::positive : value_[j] < -error_[j] ? Sign::negative : Sign::unknown; }
  Sign first() const { return sign_at(0); }
  Sign last() const { return sign_at(value_.size() - 1); }
  /// The sign of all coefficients, if it is one; but for some at the ends that are known to vanish.
  Sign common(const std::array<std::size_t, 2>& zeros = {}) const
  {
    if (value_.size() <= zeros[0] + zeros[1]) return Sign::unknown;
    const Sign s = sign_at(zeros[0]);
    for (std::size_t j = zeros[0] + 1; j + zeros[1] < value_.size() && is_strict(s); ++j)
      if (sign_at(j) != s) return Sign::unknown;
    return s;
  }
  /// Whether halving may tell more: coefficients differ by more than their errors.
  bool is_resolved() const
  {
    double least = value_[0], greatest = value_[0], error = 0;
    for (std::size_t j = 0; j < value_.size(); ++j) {
      least = std::min(least, value_[j]);
      greatest = std::max(greatest, value_[j]);
      error = std::max(error, error_[j]);
    }
    return greatest - least > error;
  }

private:
  std::vector<double> value_, error_, slope_, difference_;
};

/// Along a part of a curve the curvature rises and falls by turns.
struct Curvature_runs {
  int count = 0;
  Sign first = Sign::zero, last = Sign::zero;

  void add(Sign s)
  {
    if (s == Sign::zero) return;
    if (count == 0) first = s;
    if (s != last) ++count;
    last = s;
  }
  /// Another part that follows after a step; one that is not known goes against what is beside it.
  void add(Sign step, const Curvature_runs& next)
  {
    add(step == Sign::unknown ? worst_step(next) : step);
    if (next.count == 0) return;
    if (count == 0) first = next.first;
    count += next.count - (last == next.first ? 1 : 0);
    last = next.last;
  }

private:
  Sign worst_step(const Curvature_runs& next) const
  {
    const Sign beside = next.count > 0 ? next.first : last;
    if (count > 0 && next.count > 0 && last != next.first) return Sign::zero;
    return beside == Sign::positive ? Sign::negative : Sign::positive;
  }
};

/// What circles are tested against along one piece of a curve, with dyadic parts made when they are first asked for. Not for
/// sharing between threads.
class Contact_tree {
public:
  struct Node {
    double lo, hi;
    Enclosed_vector power, turn;
    std::size_t children = 0; ///< index of the lower half; the upper one follows; none where 0
  };

  /// Upward rounding needed.
  explicit Contact_tree(const std::shared_ptr<const Planar_curve>& curve) : critical_(Lazy<Critical>::from([curve] { return Critical(*curve); }))
  {
    const Contact_forms<Interval> forms = enclosed_contact_forms(*curve);
    nodes_.push_back({0, 1, Enclosed_vector(forms.power), Enclosed_vector(forms.turn), 0});
  }

  /// In how many runs at most the curvature rises or falls from lo to hi, and how the first and the last one go; nothing where doubles
  /// do not tell. By the signs of Bernstein coefficients: no fewer change than the form's own.
  std::optional<Curvature_runs> curvature_runs(double lo, double hi) const
  {
    const Critical& critical = critical_.get();
    const auto part = restrict_to(critical.form, 0, Interval(lo), Interval(hi));
    Curvature_runs runs;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const bool is_known_zero = (k == 0 && lo == 0 && critical.vanishes[0]) || (k + 1 == part.size() && hi == 1 && critical.vanishes[1]);
      if (is_known_zero || (part[k].inf() == 0 && part[k].sup() == 0)) continue;
      const Sign s = sign_of(part[k]);
      if (!is_strict(s)) return std::nullopt;
      runs.add(s);
    }
    return runs;
  }

  /// How the curvature changes from the end of this curve to the beginning of another that goes on smoothly; unknown where one stands
  /// still or is infinite there.
  Sign curvature_step(const Contact_tree& next) const
  {
    const auto &before = critical_.get().at_end[1], &after = next.critical_.get().at_end[0];
    if (!before || !after) return Sign::unknown;
    const Rational a = before->sign * before->square, b = after->sign * after->square;
    return a < b ? Sign::positive : b < a ? Sign::negative : Sign::zero;
  }

  const Node& node(std::size_t i) const { return nodes_[i]; }

  std::size_t halve(std::size_t i)
  {
    if (nodes_[i].children) return nodes_[i].children;
    auto power = nodes_[i].power.halves(), turn = nodes_[i].turn.halves();
    const double lo = nodes_[i].lo, hi = nodes_[i].hi, middle = 0.5 * (lo + hi);
    nodes_[i].children = nodes_.size();
    nodes_.push_back({lo, middle, std::move(power.first), std::move(turn.first), 0});
    nodes_.push_back({middle, hi, std::move(power.second), std::move(turn.second), 0});
    return nodes_[i].children;
  }

private:
  /// The derivative of the curvature, up to positive factors, whether it vanishes at the ends, and the curvature there.
  struct Critical {
    using Forms = Curvature_forms<2>;

    Bernstein<Interval, 1> form;
    std::array<bool, 2> vanishes{};
    std::array<std::optional<Forms::Exact_curvature>, 2> at_end;

    Critical() = default;
    explicit Critical(const Planar_curve& curve)
    {
      const Forms forms(curve.piece());
      form = enclosing(forms.critical);
      for (std::size_t e = 0; e < 2; ++e) {
        const auto end = [e](const Bernstein<Rational, 1>& f) { return f[e == 0 ? 0 : f.size() - 1]; };
        vanishes[e] = end(forms.critical) == 0;
        if (end(forms.speed) != 0 && end(forms.weight) != 0) at_end[e] = forms.at(Rational(static_cast<long>(e)));
      }
    }
  };

  std::deque<Node> nodes_;
  Lazy<Critical> critical_;
};

} // namespace detail
} // namespace locus

#endif
