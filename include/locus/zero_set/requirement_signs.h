// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_REQUIREMENT_SIGNS_H
#define LOCUS_ZERO_SET_REQUIREMENT_SIGNS_H

#include <locus/number/filter_counts.h>
#include <locus/zero_set/least_root_sign.h>
#include <locus/zero_set/requirement.h>

namespace locus {

/// A requirement on the part of v that a node of its tree stands for.
struct Open_requirement {
  std::size_t requirement = 0, node = 0;
  int slope = 0; ///< in u on the cell: 1 nowhere falling, 2 strictly rising, -1 nowhere rising, -2 strictly falling, 0 not known
};

namespace detail {

/// A polynomial's value, first and second derivative, by de Casteljau's algorithm, in doubles and without bounds.
inline std::array<double, 3> value_and_slopes(const double* c, int degree, double x, std::vector<double>& b)
{
  b.assign(c, c + degree + 1);
  int n = degree;
  const auto level = [&] {
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) b[i] = (1 - x) * b[i] + x * b[i + 1];
    --n;
  };
  while (n > 2) level();
  const double second = n == 2 ? degree * (degree - 1.0) * (b[2] - 2 * b[1] + b[0]) : 0;
  if (n == 2) level();
  const double first = n == 1 ? degree * (b[1] - b[0]) : 0;
  if (n == 1) level();
  return {b[0], first, second};
}

} // namespace detail

/// Signs of requirements at single values of u: by doubles, and exactly where these do not tell.
class Requirement_signs {
public:
  Requirement_signs(const std::vector<Requirement>& requirements, Filter_counts& counts) : requirements_(requirements), counts_(counts) {}

  /// The sign of the least value over all open requirements at u in [0,1]: negative where one is violated.
  Sign at(const std::vector<Open_requirement>& open, double u)
  {
    return least_of(open, [&](const Open_requirement& r) {
      const Sign s = filtered_at(r, u);
      return is_certain(s) ? s : exact_at(r, Rational(u));
    });
  }

  /// As far as doubles tell: positive, negative or unknown.
  Sign filtered_at(const std::vector<Open_requirement>& open, double u)
  {
    return least_of(open, [&](const Open_requirement& r) { return filtered_at(r, u); });
  }

  Sign filtered_at(const Open_requirement& r, double u)
  {
    const Requirement& requirement = requirements_[r.requirement];
    const Vector_tree::Node& node = requirement.b->node(r.node);
    table_.make(detail::factor_at(requirement, u), node.f);
    const auto by_convexity = sign_if_convex(requirement, node, u);
    Sign s = by_convexity.value_or(Sign::unknown);
    if (!by_convexity) {
      Bernstein<double, 1> values(Degrees<1>{static_cast<int>(table_.columns) - 1}, table_.c);
      s = filtered_least_sign(Bernstein<Bounded, 1>(std::move(values), table_.error));
    }
    counts_.record(Rung::bounded, is_certain(s));
    return s;
  }

  Sign exact_at(const Open_requirement& r, const Rational& u)
  {
    const Requirement& requirement = requirements_[r.requirement];
    counts_.record(Rung::exact, true);
    if (requirement.square) {
      const Vector_form& b = requirement.b->exact_on(r.node);
      return least_root_sign(evaluate_at(requirement.square->exact()[0], u), detail::product_at(requirement.a->exact(), u, b),
                             detail::product_at(requirement.rest->exact(), u, b));
    }
    return least_sign(detail::product_at(requirement.a->exact(), u, requirement.b->exact_on(r.node)));
  }

private:
  /// The sign of the least value g of the row in `table_`, as far as it is seen from where g is least: with g'' ≥ m > 0 on all of
  /// the unit interval, g ≥ g(x) - g'(x)²/(2m). Nothing where g is not proved to be convex.
  std::optional<Sign> sign_if_convex(const Requirement& requirement, const Vector_tree::Node& node, double u)
  {
    const std::vector<double>& c = table_.c;
    const double error = table_.error;
    const std::size_t last = c.size() - 1;
    if (c[0] < -error || c[last] < -error) return Sign::negative;
    if (std::all_of(c.begin(), c.end(), [&](double x) { return x > error; })) return Sign::positive;
    if (last < 2) return std::nullopt;
    double bend = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 2 <= last; ++i) bend = std::min(bend, c[i + 2] - 2 * c[i + 1] + c[i]);
    const auto n = static_cast<double>(last);
    bend = n * (n - 1) * (bend - 8 * (error + operation_error * std::abs(c[0])));
    if (!(bend > 0)) return std::nullopt;
    const auto [x, value, slope] = least_place();
    const bool at_end = (x == 0 && slope > 4 * n * error) || (x == 1 && slope < -4 * n * error);
    const double slope_bound = at_end ? 0 : std::abs(slope) + 8 * n * (error + operation_error * table_norm());
    const double below = slope_bound * slope_bound / (2 * bend) * (1 + 8 * operation_error);
    const double value_error = error + 8 * n * operation_error * table_norm();
    if (value < -value_error) return Sign::negative;
    if (value - value_error - below > 0) return Sign::positive;
    const auto close = close_value(requirement, u, node.lo + x * (node.hi - node.lo));
    if (!close) return Sign::unknown;
    counts_.record(Rung::interval, close->sup() < 0 || close->inf() - below > 0);
    if (close->sup() < 0) return Sign::negative;
    return close->inf() - below > 0 ? Sign::positive : Sign::unknown;
  }

  double table_norm() const
  {
    double norm = 0;
    for (const double x : table_.c) norm = std::max(norm, std::abs(x));
    return norm;
  }

  /// Where the row is least, about, with its value and slope there: Newton's method on the slope, from the least coefficient on.
  std::array<double, 3> least_place()
  {
    const std::vector<double>& c = table_.c;
    const auto last = static_cast<int>(c.size()) - 1;
    double x = static_cast<double>(std::min_element(c.begin(), c.end()) - c.begin()) / last;
    auto jet = detail::value_and_slopes(c.data(), last, x, scratch_);
    for (int step = 0; step < 12; ++step) {
      const double next = std::min(1.0, std::max(0.0, x - jet[1] / jet[2]));
      if (!(std::abs(next - x) > 0x1p-50)) break;
      x = next;
      jet = detail::value_and_slopes(c.data(), last, x, scratch_);
    }
    return {x, jet[0], jet[1]};
  }

  /// g(u, v), or what has its sign and is comparable with it, from values of both factors enclosed afresh.
  std::optional<Interval> close_value(const Requirement& requirement, double u, double v)
  {
    const bool apart = requirement.apart_a != nullptr;
    if (requirement.square || (apart && u == v)) return std::nullopt;
    const auto a = (apart ? requirement.apart_a : requirement.a)->fresh_at(u), b = (apart ? requirement.apart_b : requirement.b)->fresh_at(v);
    if (!a || !b) return std::nullopt;
    Interval sum(0);
    for (std::size_t k = 0; k < a->size(); ++k) sum += (*a)[k] * (*b)[k];
    return apart ? sum / CGAL::square(Interval(u) - Interval(v)) : sum;
  }

  template <class Sign_of>
  static Sign least_of(const std::vector<Open_requirement>& open, Sign_of sign_of)
  {
    Sign least = Sign::positive;
    for (const Open_requirement& r : open) {
      const Sign s = sign_of(r);
      if (s == Sign::negative) return s;
      if (s != Sign::positive && least != Sign::unknown) least = s;
    }
    return least;
  }

  const std::vector<Requirement>& requirements_;
  Filter_counts& counts_;
  Product_table table_;
  std::vector<double> scratch_;
};

} // namespace locus

#endif
