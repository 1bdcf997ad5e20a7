// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CRITICAL_POINTS_H
#define LOCUS_ZERO_SET_CRITICAL_POINTS_H

#include <locus/number/interval.h>
#include <locus/zero_set/common_zeros.h>
#include <locus/zero_set/gradient_index.h>

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

/// All common zeros of some equations in a part of the unit cell, exactly.
inline std::vector<Isolated_solution<2>> solutions_in(const Common_zeros& zeros, const Box<2>& box,
                                                      const std::vector<Isolated_solution<2>>& known = {})
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
  for (const Common_zero& zero : zeros.in(widened(box, 0), widened(box, std::max(box.max_width(), 0x1p-20)), is_known))
    if (auto p = as_solution(zero)) {
      bool is_inside = true; // not only in the margin
      for (std::size_t v = 0; v < 2; ++v) is_inside = is_inside && p->box[v].sup() >= box.lo[v] && p->box[v].inf() <= box.hi[v];
      if (is_inside) found.push_back(std::move(*p));
    }
  return found;
}

/// What is known exactly of the critical points of a polynomial f: made at the first question, for most solves ask none.
class Critical_points {
public:
  explicit Critical_points(const Bernstein<Scaled_integer, 2>& f)
    : fx_(derivative(f, 0)), fy_(derivative(f, 1)), f_(f), zeros_({fx_, fy_, f_})
  {
  }

  /// Whether there are finitely many, over the complex numbers too; else nothing can be said here.
  bool is_finite() const { return zeros_.is_finite(); }

  /// All points of a part of the unit cell where f and its gradient vanish, but for some that are known.
  std::vector<Isolated_solution<2>> on_curve(const Box<2>& box, const std::vector<Isolated_solution<2>>& known) const
  {
    return solutions_in(zeros_, box, known);
  }

  /// Those of them where two further polynomials vanish as well.
  std::vector<Isolated_solution<2>> on_curve(const Box<2>& box, const std::array<std::shared_ptr<const Equation<2>>, 2>& more) const
  {
    return solutions_in(Common_zeros({fx_, fy_, f_, more[0]->exact(), more[1]->exact()}), box);
  }

  /// A box about a critical point, as large as `reach` allows, that has no other one.
  std::optional<Box<2>> alone_about(const Isolated_solution<2>& p, double reach) const
  {
    Box<2> at;
    Rational_box point;
    for (std::size_t v = 0; v < 2; ++v) {
      at.lo[v] = p.box[v].inf();
      at.hi[v] = p.box[v].sup();
      point[v] = {Rational(at.lo[v]), Rational(at.hi[v])};
    }
    const auto part = zeros_.alone_about(point, widened(at, reach));
    if (!part) return std::nullopt;
    return inner_box(*part);
  }

  /// Index of the gradient along the boundary of a box.
  std::optional<int> index(const Box<2>& box) const { return gradient_index(fx_, fy_, box); }

private:
  Bernstein<Scaled_integer, 2> fx_, fy_, f_;
  Common_zeros zeros_;
};

} // namespace detail
} // namespace locus

#endif
