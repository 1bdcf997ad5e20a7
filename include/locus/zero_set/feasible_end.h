// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_FEASIBLE_END_H
#define LOCUS_ZERO_SET_FEASIBLE_END_H

#include <locus/zero_set/feasible_events.h>
#include <locus/zero_set/requirement_signs.h>

namespace locus {

/// An end of an interval of feasible u: the only boundary point in [lo, hi]; exactly lo where lo == hi. Where it is no end of
/// the unit interval, `open` are the requirements that can fail beyond it.
struct Feasible_end {
  double lo = 0, hi = 0;
  std::vector<Open_requirement> open;
  std::shared_ptr<const Algebraic_end> algebraic; ///< where it was isolated as a polynomial's root

  bool is_exact() const { return lo == hi; }
};

namespace detail {

/// Narrows the ends of feasible intervals: a place is guessed by Newton's method in doubles, and signs beside it prove it.
class Feasible_end_refiner {
public:
  Feasible_end_refiner(const std::vector<Requirement>& requirements, Filter_counts& counts) : requirements_(requirements), signs_(requirements, counts) {}

  /// `side` 0 for the low end of an interval (feasible above it), 1 for the high one. Doubles alone narrow it to what they can
  /// tell; exact signs go on where that is wider than `exact_above`.
  void narrow(Feasible_end& end, int side, double width, double exact_above = 0x1p-36)
  {
    if (end.is_exact() || end.hi - end.lo <= width) return;
    if (end.algebraic) return narrow_algebraic(end, width);
    if (const auto guess = guessed(end, side)) close_in(end, side, *guess, width);
    while (end.hi - end.lo > std::max(width, exact_above)) {
      const double middle = 0.5 * (end.lo + end.hi);
      if (!(middle > end.lo && middle < end.hi)) return;
      move(end, side, middle, signs_.at(end.open, middle));
    }
  }

  /// Writes an end as a polynomial's root, so that equality can be asked. False where elimination cannot tell.
  bool make_algebraic(Feasible_end& end, int side)
  {
    if (end.algebraic || end.is_exact()) return true;
    Event_polynomials events;
    for (const Open_requirement& r : end.open) events.add(requirements_[r.requirement]);
    const auto boundary = events.on(end.lo, end.hi);
    if (!boundary) return false;
    for (std::size_t k = 1; k + 1 < boundary->size(); ++k) {
      const auto holds_beside = [&](std::size_t i) { // between events i and i + 1
        const Rational middle = ((*boundary)[i].hi + (*boundary)[i + 1].lo) / 2;
        return std::all_of(end.open.begin(), end.open.end(), [&](const Open_requirement& r) { return signs_.exact_at(r, middle) != Sign::negative; });
      };
      if (holds_beside(k - 1) != (side == 1) || holds_beside(k) != (side == 0)) continue;
      end.algebraic = std::make_shared<const Algebraic_end>((*boundary)[k]);
      return true;
    }
    return false;
  }

private:
  /// Moves the end's bound on the side that `u` is found to be on.
  static void move(Feasible_end& end, int side, double u, Sign least)
  {
    if (least != Sign::unknown) ((least != Sign::negative) == (side == 0) ? end.hi : end.lo) = u;
  }

  void close_in(Feasible_end& end, int side, double guess, double width)
  {
    double delta = std::max(0.4 * width, 4 * operation_error * std::abs(guess));
    for (int i = 0; i < 14; ++i, delta *= 4) {
      for (const double u : {guess - delta, guess + delta})
        if (u > end.lo && u < end.hi) move(end, side, u, signs_.filtered_at(end.open, u));
      if (end.hi - end.lo <= 2 * delta * (1 + 4 * operation_error)) return;
    }
  }

  void narrow_algebraic(Feasible_end& end, double width) const
  {
    Algebraic_end a = *end.algebraic;
    const Rational length = a.hi - a.lo;
    if (length > 0) {
      const Bernstein<Scaled_integer, 1> f = restrict_to(bernstein_form(*a.polynomial), 0, a.lo, a.hi);
      Isolated_root<Rational> root{Rational(0), Rational(1), 1, nullptr};
      const Rational wanted = Rational(width) / (4 * length);
      while (!root.is_exact() && Rational(root.hi - root.lo) > wanted)
        if (!bisect_exactly(f, Rational(0), Rational(1), root)) break;
      a = {Rational(a.lo + root.lo * length), Rational(a.lo + root.hi * length), a.polynomial};
      end.algebraic = std::make_shared<const Algebraic_end>(a);
    }
    const Interval x = hull(enclosing(a.lo), enclosing(a.hi));
    end.lo = x.inf();
    end.hi = x.sup();
  }

  // -------------------------------------------------------------------------------------------------- Newton's method

  struct Value {
    double g = 0, gu = 0, gv = 0, guv = 0, gvv = 0;
  };

  Value value(const Vector_tree& a_tree, const Vector_tree& b_tree, double u, double v)
  {
    const Enclosed_vector &a = a_tree.node(0).f, &b = b_tree.node(0).f;
    Value sum;
    for (std::size_t k = 0; k < a.rank(); ++k) {
      const auto x = value_and_slopes(a.component(k), a.degree(), u, scratch_), y = value_and_slopes(b.component(k), b.degree(), v, scratch_);
      sum.g += x[0] * y[0];
      sum.gu += x[1] * y[0];
      sum.gv += x[0] * y[1];
      sum.guv += x[1] * y[1];
      sum.gvv += x[0] * y[2];
    }
    return sum;
  }

  /// With a root.
  Value rooted_value(const Requirement& r, double u, double v)
  {
    const Enclosed_vector& square = r.square->node(0).f;
    const auto s = value_and_slopes(square.component(0), square.degree(), u, scratch_);
    const double root = std::sqrt(s[0]), slope = 0.5 * s[1] / root;
    const Value g = value(*r.a, *r.b, u, v), h = value(*r.rest, *r.b, u, v);
    return {root * g.g + h.g, slope * g.g + root * g.gu + h.gu, root * g.gv + h.gv, slope * g.gv + root * g.guv + h.guv, root * g.gvv + h.gvv};
  }

  /// Where a requirement is worst at u, about: by its Bernstein coefficients in v.
  struct Worst {
    const Requirement* requirement = nullptr;
    double v = 0, coefficient = 0;
  };

  Worst worst_at(const std::vector<Open_requirement>& open, double u)
  {
    Worst worst;
    const Vector_tree* known = nullptr;
    Enclosed_vector a;
    for (const Open_requirement& o : open) {
      const Requirement& r = requirements_[o.requirement];
      const auto& node = r.b->node(o.node);
      if (r.a.get() != known) {
        known = r.a.get();
        a = factor_at(r, u);
      }
      table_.make(a, node.f);
      for (std::size_t j = 0; j < table_.columns; ++j)
        if (!worst.requirement || table_.c[j] < worst.coefficient) {
          const double at = table_.columns == 1 ? 0.5 : static_cast<double>(j) / static_cast<double>(table_.columns - 1);
          worst = {&r, node.lo + at * (node.hi - node.lo), table_.c[j]};
        }
    }
    return worst;
  }

  /// Where g(u, v) = 0 = ∂g/∂v, or g(u, v) = 0 at an end of v's interval, from the worst place at the infeasible end on.
  std::optional<double> guessed(const Feasible_end& end, int side)
  {
    const auto [binding, start, coefficient] = worst_at(end.open, side == 0 ? end.lo : end.hi);
    if (!binding) return std::nullopt;
    const bool apart = binding->apart_a && (start < end.lo || start > end.hi);
    const Vector_tree &a = apart ? *binding->apart_a : *binding->a, &b = apart ? *binding->apart_b : *binding->b;
    double u = 0.5 * (end.lo + end.hi), v = start, last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 30; ++step) {
      const Value x = binding->square ? rooted_value(*binding, u, v) : value(a, b, u, v);
      const bool at_end = (v <= 0 && x.gv > 0) || (v >= 1 && x.gv < 0);
      double du = 0, dv = 0;
      if (at_end || x.gvv == 0) {
        du = -x.g / x.gu;
      } else {
        const double det = x.gu * x.gvv - x.gv * x.guv;
        du = (-x.g * x.gvv + x.gv * x.gv) / det;
        dv = (x.g * x.guv - x.gu * x.gv) / det;
      }
      if (!std::isfinite(du) || !std::isfinite(dv)) return std::nullopt;
      u = std::min(end.hi, std::max(end.lo, u + du));
      v = std::min(1.0, std::max(0.0, v + dv));
      const double moved = std::max(std::abs(du), std::abs(dv));
      if (moved <= 0x1p-50 || (moved < 0x1p-30 && moved >= last)) break;
      last = moved;
    }
    return u;
  }

  const std::vector<Requirement>& requirements_;
  Requirement_signs signs_;
  Product_table table_;
  std::vector<double> scratch_;
};

} // namespace detail

} // namespace locus

#endif
