// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_FEASIBLE_EVENTS_H
#define LOCUS_ZERO_SET_FEASIBLE_EVENTS_H

#include <locus/function/resultant.h>
#include <locus/function/square_free.h>
#include <locus/zero_set/requirement.h>

#include <algorithm>

namespace locus {

/// A root of an integer polynomial in [lo, hi], the only one there; or the rational number lo where there is no polynomial.
struct Algebraic_end {
  Rational lo, hi;
  std::shared_ptr<const Integer_polynomial> polynomial; ///< square-free

  bool same_as(const Algebraic_end& other) const { return lo == other.lo && hi == other.hi; }
};

namespace detail {

/// The u at which a requirement a(u)·b(v) ≥ 0 for all v can begin or cease to hold: g(u, ·) = a(u)·b has a multiple root, or one
/// at an end of the unit interval. All of them are roots of the discriminant in v, of g(u, 0) or of g(u, 1).
class Event_polynomials {
public:
  void add(const Requirement& requirement)
  {
    for (const Requirement& r : known_)
      if (r.a == requirement.a && r.b == requirement.b && r.rest == requirement.rest) return;
    known_.push_back(requirement);
    const Bernstein<Scaled_integer, 2> g(form_of(requirement));
    if (g.is_zero()) return;
    for (const Repeated_factor& factor : square_free_factors(bivariate_form(g))) add_factor(factor.f);
    for (const bool high : {false, true}) include(monomial_form(face(g, 1, high)));
  }

  /// The events in [lo, hi] in order, between these two numbers themselves; nothing where elimination cannot tell.
  std::optional<std::vector<Algebraic_end>> on(double lo, double hi) const
  {
    if (failed_) return std::nullopt;
    const Rational from(lo), to(hi), length = to - from;
    std::vector<Algebraic_end> ends{{from, from, nullptr}};
    if (degree(all_) > 0) {
      const auto polynomial = std::make_shared<const Integer_polynomial>(all_);
      for (const auto& root : exact_roots(restrict_to(bernstein_form(all_), 0, from, to), Rational(0), Rational(1)).roots) {
        if (root.hi == 0 || root.lo == 1) continue; // an end of the interval itself
        ends.push_back({Rational(from + root.lo * length), Rational(from + root.hi * length), polynomial});
      }
    }
    ends.push_back({to, to, nullptr});
    return ends;
  }

private:
  void add_factor(const Bivariate_polynomial& f)
  {
    if (f.degree_y() < 1) {
      include(f.row[0]);
      return;
    }
    if (f.degree_y() > 1) include(resultant_y(f, derivative_y(f)));
    include(f.row.back());
    // Two factors may share a root at some u: it is one of their product's discriminant.
    for (const Bivariate_polynomial& other : factors_)
      if (other.degree_y() > 0) include(resultant_y(f, other));
    factors_.push_back(f);
  }

  /// The polynomial of all events so far, without multiple roots.
  void include(Integer_polynomial f)
  {
    trim(f);
    if (degree(f) < 1) return;
    f = exact_quotient(primitive_part(f), gcd(f, derivative(f)));
    if (degree(all_) < 1) {
      all_ = std::move(f);
      return;
    }
    const Integer_polynomial common = gcd(all_, f);
    all_ = multiply(all_, degree(common) < 1 ? f : exact_quotient(f, common));
  }

  std::vector<Requirement> known_;
  std::vector<Bivariate_polynomial> factors_;
  Integer_polynomial all_;
  bool failed_ = false;
};

} // namespace detail

} // namespace locus

#endif
