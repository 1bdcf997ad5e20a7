// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_REQUIREMENT_SIGNS_H
#define LOCUS_ZERO_SET_REQUIREMENT_SIGNS_H

#include <locus/number/filter_counts.h>
#include <locus/zero_set/requirement.h>

namespace locus {

/// A requirement on the part of v that a node of its tree stands for.
struct Open_requirement {
  std::size_t requirement = 0, node = 0;
  int slope = 0; ///< of a·b in u on the cell: 1 nowhere falling, -1 nowhere rising, 0 not known
};

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
    const Sign s = sign_of_least(requirement.a->node(0).f.at(u), node.f);
    counts_.record(Rung::bounded, is_certain(s));
    if (is_certain(s)) return s;
    const bool apart = requirement.apart_a && (u < node.lo || u > node.hi);
    const auto a = (apart ? requirement.apart_a : requirement.a)->fresh_at(u);
    if (!a) return s;
    const Sign t = sign_of_least(*a, apart ? requirement.apart_b->node(requirement.apart_b->find(node.lo, node.hi)).f : node.f);
    counts_.record(Rung::interval, is_certain(t));
    return t;
  }

  Sign exact_at(const Open_requirement& r, const Rational& u)
  {
    const Requirement& requirement = requirements_[r.requirement];
    counts_.record(Rung::exact, true);
    return least_sign(detail::product_at(requirement.a->exact(), u, requirement.b->exact_on(r.node)));
  }

private:
  Sign sign_of_least(const Enclosed_vector& a, const Enclosed_vector& b)
  {
    table_.make(a, b);
    Bernstein<double, 1> values(Degrees<1>{static_cast<int>(table_.columns) - 1}, table_.c);
    return filtered_least_sign(Bernstein<Bounded, 1>(std::move(values), table_.error));
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
};

} // namespace locus

#endif
