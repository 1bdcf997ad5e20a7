// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CRITICAL_POINTS_H
#define LOCUS_ZERO_SET_CRITICAL_POINTS_H

#include <locus/number/interval.h>
#include <locus/zero_set/common_zeros.h>
#include <locus/zero_set/gradient_index.h>
#include <locus/zero_set/point_faces.h>
#include <locus/zero_set/points.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace locus {
namespace detail {

using Rational_box = std::array<std::array<Rational, 2>, 2>;

/// A box as rationals, with a margin on all sides, so that nothing lies on its boundary that lies on the given box.
inline Rational_box widened(const Box<2>& box, double margin)
{
  Rational_box wide;
  for (std::size_t v = 0; v < 2; ++v) wide[v] = {Rational(Rational(box.lo[v]) - Rational(margin)), Rational(Rational(box.hi[v]) + Rational(margin))};
  return wide;
}

/// The largest box of doubles inside.
inline Box<2> inner_box(const Rational_box& box)
{
  Box<2> inner;
  for (std::size_t v = 0; v < 2; ++v) {
    inner.lo[v] = enclosing(box[v][0]).sup();
    inner.hi[v] = enclosing(box[v][1]).inf();
  }
  return inner;
}

/// A zero of two equations that was proved algebraically, as the solver sees it; nothing where it lies outside the unit cell.
inline std::optional<Isolated_solution<2>> as_solution(const Common_zero& zero)
{
  Isolated_solution<2> p;
  for (std::size_t v = 0; v < 2; ++v) {
    const auto& [lo, hi] = zero.at[v];
    if (hi < 0 || lo > 1) return std::nullopt;
    p.box[v] = Interval(enclosing(lo).inf(), enclosing(hi).sup());
    for (const int end : {0, 1})
      if (lo == end && hi == end) p.face[v] = end;
  }
  p.unique_in = inner_box(zero.alone_in);
  if (zero.evidence) p.evidence = std::make_shared<const Algebraic_evidence>(*zero.evidence);
  return p;
}

/// All common zeros of some equations in a part of the unit cell, exactly; `cause` says which sufficient pair proves one.
inline std::vector<Isolated_solution<2>> solutions_in(const Common_zeros& zeros, const Box<2>& box,
                                                      const std::vector<Isolated_solution<2>>& known = {},
                                                      const std::vector<std::array<Bernstein<Scaled_integer, 2>, 2>>& sufficient = {})
{
  // Enclosures hold one zero of the first two polynomials each: a known one in it is that one.
  const auto is_known = [&](const Rational_box& at) {
    return std::any_of(known.begin(), known.end(), [&](const Isolated_solution<2>& p) {
      bool inside = true;
      for (std::size_t v = 0; v < 2; ++v) inside = inside && at[v][0] <= Rational(p.box[v].inf()) && Rational(p.box[v].sup()) <= at[v][1];
      return inside;
    });
  };
  std::vector<Isolated_solution<2>> found;
  for (const Common_zero& zero : zeros.in(widened(box, 0), widened(box, std::max(box.max_width(), 0x1p-20)), is_known, sufficient))
    if (auto p = as_solution(zero)) {
      p->cause = zero.sufficient.value_or(no_cause);
      bool is_inside = true; // not only in the margin
      for (std::size_t v = 0; v < 2; ++v) is_inside = is_inside && p->box[v].sup() >= box.lo[v] && p->box[v].inf() <= box.hi[v];
      if (is_inside) found.push_back(std::move(*p));
    }
  return found;
}

/// What is known exactly of the critical points of a polynomial f: made at the first question, for most solves ask none.
class Critical_points {
public:
  explicit Critical_points(const Bernstein<Scaled_integer, 2>& f, const Checkpoint& checkpoint = {})
    : fx_(derivative(f, 0)), fy_(derivative(f, 1)), f_(f), checkpoint_(checkpoint), zeros_({fx_, fy_, f_}, checkpoint)
  {
  }

  /// Bits that the elimination's integers may need.
  std::size_t bits() const { return zeros_.bits(); }

  /// Whether there are finitely many, over the complex numbers too; else nothing can be said here.
  bool is_finite() const { return zeros_.is_finite(); }

  /// All points of a part of the unit cell where f and its gradient vanish, but for some that are known; `cause` says which
  /// of some pairs of equations, where f and its gradient vanish as well, proves one.
  std::vector<Isolated_solution<2>> on_curve(const Box<2>& box, const std::vector<Isolated_solution<2>>& known,
                                             const std::vector<std::array<Bernstein<Scaled_integer, 2>, 2>>& sufficient) const
  {
    return solutions_in(zeros_, box, known, sufficient);
  }

  /// Those of them where two further polynomials vanish as well.
  std::vector<Isolated_solution<2>> on_curve(const Box<2>& box, const std::array<std::shared_ptr<const Equation<2>>, 2>& more) const
  {
    return solutions_in(Common_zeros({fx_, fy_, f_, more[0]->exact(), more[1]->exact()}, checkpoint_), box);
  }

  /// What intervals and rational arithmetic say of a part of the unit cell, without any elimination.
  struct Nearby {
    std::vector<Isolated_solution<2>> on_curve; ///< critical points on f = 0, with rational coordinates
    bool is_complete = false;                   ///< there is no other one
  };

  /// Solves ∇f = 0 on a part by intervals. At each solution f has a strict sign about it, or all three vanish exactly at the
  /// simplest rational point of its enclosure; else elimination has to tell.
  Nearby nearby(const Box<2>& part, const Solve_control& control) const
  {
    const Rational_box around = widened(part, 0.1875 * part.max_width());
    const auto local = [&](const Bernstein<Scaled_integer, 2>& f) {
      return restrict_to(restrict_to(f, 0, around[0][0], around[0][1]), 1, around[1][0], around[1][1]);
    };
    const Bernstein<Scaled_integer, 2> f = local(f_);
    const Equations<2> gradient{std::make_shared<Polynomial_equation<2>>(derivative(f, 0)), std::make_shared<Polynomial_equation<2>>(derivative(f, 1))};
    Solve_control limited = control;
    limited.max_cells = std::min<std::size_t>(control.max_cells, 300);
    limited.progress = {};
    const auto solved = solve_points<2>(gradient, limited);
    Nearby result;
    result.is_complete = solved.undecided.empty();
    for (const Isolated_solution<2>& p : solved.points) {
      if (has_strict_sign(f, p)) continue;
      if (auto q = at_rational_point(p, around)) result.on_curve.push_back(std::move(*q));
      else result.is_complete = false;
    }
    return result;
  }

  /// A box about a critical point, as large as `reach` allows, that has no other one.
  std::optional<Box<2>> alone_about(const Isolated_solution<2>& p, double reach) const
  {
    const Box<2> at = box_of(p.box);
    const auto part = zeros_.alone_about(widened(at, 0), widened(at, reach));
    if (!part) return std::nullopt;
    return inner_box(*part);
  }

  /// Index of the gradient along the boundary of a box.
  std::optional<int> index(const Box<2>& box) const { return gradient_index(fx_, fy_, box); }

private:
  static bool has_strict_sign(const Bernstein<Scaled_integer, 2>& f, const Isolated_solution<2>& p)
  {
    auto part = f;
    for (int v = 0; v < 2; ++v) {
      const Interval& x = p.box[static_cast<std::size_t>(v)];
      part = restrict_to(part, v, Rational(x.inf()), Rational(x.sup()));
    }
    return is_strict(common_sign(part));
  }

  /// The solution of ∇f = 0 in an enclosure local to `around`, if it is the simplest rational point there and f vanishes, too.
  std::optional<Isolated_solution<2>> at_rational_point(const Isolated_solution<2>& p, const Rational_box& around) const
  {
    Common_zero zero;
    std::array<Rational, 2> at;
    for (std::size_t v = 0; v < 2; ++v) {
      const auto global = [&](double x) { return Rational(around[v][0] + Rational(x) * (around[v][1] - around[v][0])); };
      at[v] = simplest_between(global(p.box[v].inf()), global(p.box[v].sup()));
      zero.at[v] = {at[v], at[v]};
      zero.alone_in[v] = {global(p.unique_in.lo[v]), global(p.unique_in.hi[v])};
    }
    for (const auto* f : {&f_, &fx_, &fy_})
      if (evaluate(*f, at) != 0) return std::nullopt;
    Algebraic_evidence evidence;
    evidence.m = {Integer(-at[0].get_num()), at[0].get_den()};
    evidence.lo = evidence.hi = at[0];
    evidence.h = {{Rational(-at[1])}, {Rational(1)}};
    evidence.r_lo = evidence.r_hi = at[1];
    if (at[1] == 0) evidence.h[0].clear();
    zero.evidence = std::move(evidence);
    return as_solution(zero);
  }

  Bernstein<Scaled_integer, 2> fx_, fy_, f_;
  Checkpoint checkpoint_;
  Common_zeros zeros_;
};

} // namespace detail
} // namespace locus

#endif
