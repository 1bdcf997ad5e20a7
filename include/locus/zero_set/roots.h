// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_ROOTS_H
#define LOCUS_ZERO_SET_ROOTS_H

#include <locus/function/bernstein_horner.h>
#include <locus/function/bounded_bernstein.h>
#include <locus/function/descartes.h>
#include <locus/number/filter_counts.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace locus {

/// A univariate polynomial on [lo, hi] as the root isolator sees it: a bounded form at hand, the exact form on demand.
/// Not for sharing between threads: it caches the exact form.
class Univariate {
public:
  using Make_exact = std::function<Bernstein<Scaled_integer, 1>()>;
  using Make_fresh = std::function<Bernstein<Bounded, 1>(double lo, double hi)>;

  /// `make_exact` gives the exact form on [lo, hi]; `make_fresh`, if any, a newly enclosed one on a part of it.
  Univariate(Bernstein<Bounded, 1> f, double lo, double hi, Make_exact make_exact, Filter_counts* counts,
             Make_fresh make_fresh = {})
    : bounded_(std::move(f)), norm_(bounded_.norm()), lo_(lo), hi_(hi), make_exact_(std::move(make_exact)),
      make_fresh_(std::move(make_fresh)), counts_(counts)
  {
  }

  /// The polynomial enclosed afresh on [lo, hi], where that is possible: tighter than the inherited form.
  std::optional<Univariate> fresh(double lo, double hi) const
  {
    if (!make_fresh_) return std::nullopt;
    return Univariate(make_fresh_(lo, hi), lo, hi, {}, counts_);
  }

  int degree() const { return bounded_.degree(); }
  double lo() const { return lo_; }
  double hi() const { return hi_; }
  double norm() const { return norm_; }
  const Bernstein<Bounded, 1>& bounded() const { return bounded_; }
  Filter_counts& counts() const { return *counts_; }

  const Bernstein<Scaled_integer, 1>& exact() const
  {
    if (!exact_) exact_ = make_exact_();
    return *exact_;
  }

  /// Value at x in [lo, hi] with its error.
  Bounded value(double x) const
  {
    const double u = std::min(1.0, std::max(0.0, (x - lo_) / (hi_ - lo_)));
    const int n = degree();
    // The two roundings in u move the argument; the derivative is at most 2n times the norm.
    const double operations = detail::horner_operations(n) + 6.0 * n;
    return {detail::horner_value(bounded_.values().data(), n, u),
            detail::accumulated_error(bounded_.error(), operations, norm_)};
  }

  Sign exact_sign(double x) const
  {
    counts_->record(Rung::exact, true);
    const Rational u = (Rational(x) - Rational(lo_)) / (Rational(hi_) - Rational(lo_));
    return sign_at(exact(), u);
  }

  Sign sign(double x) const
  {
    Sign s = sign_of(value(x));
    counts_->record(Rung::bounded, is_certain(s));
    if (!is_certain(s) && make_fresh_) {
      s = sign_of(make_fresh_(x, x)[0]);
      counts_->record(Rung::interval, is_certain(s));
    }
    return is_certain(s) ? s : exact_sign(x);
  }

private:
  Bernstein<Bounded, 1> bounded_;
  double norm_, lo_, hi_;
  Make_exact make_exact_;
  Make_fresh make_fresh_;
  mutable std::optional<Bernstein<Scaled_integer, 1>> exact_;
  Filter_counts* counts_;
};

namespace detail {

/// Descartes' method in doubles with an error bound. Gives up (false) where a sign stays unknown.
class Filtered_isolator {
public:
  explicit Filtered_isolator(int degree) : degree_(degree) {}

  bool run(const double* c, double error, double lo, double hi, std::vector<Isolated_root<double>>& out) const
  {
    const Sign low = sign_of(c[0], error), high = sign_of(c[degree_], error);
    return is_strict(low) && is_strict(high) && run(c, error, {low, high}, lo, hi, out);
  }

  /// The same where the signs at both ends are known otherwise.
  bool run(const double* c, double error, std::pair<Sign, Sign> ends, double lo, double hi,
           std::vector<Isolated_root<double>>& out) const
  {
    Bounded_coefficients coefficients(c, degree_, error);
    Observer observer{lo, hi, out};
    return Descartes_search(coefficients, observer, max_depth).run(ends.first, ends.second);
  }

private:
  static constexpr std::size_t max_depth = 40;

  struct Observer {
    double lo, hi;
    std::vector<Isolated_root<double>>& out;

    bool found(const Cut_path& path) const
    {
      const auto part = follow(path, lo, hi);
      if (part) out.push_back({part->first, part->second, 1, nullptr});
      return part.has_value();
    }
    bool found_middle(const Cut_path&) const { return false; }
    bool is_root_in_middle(const Cut_path&) const { return false; }
  };

  int degree_;
};

} // namespace detail

/// All roots of `f` on its closed interval with multiplicities: Descartes' method in bounded doubles; where a sign
/// stays unknown (multiple roots, roots at the ends), exactly by square-free factors.
/// With `all_exact` the latter alone, and the roots keep their factors, so that what refines them is exact as well.
inline Root_set<double> isolate_roots(const Univariate& f, bool all_exact = false)
{
  if (all_exact) {
    f.counts().record(Rung::exact, true);
    return exact_roots(f.exact(), f.lo(), f.hi(), false);
  }
  Root_set<double> result;
  const detail::Filtered_isolator filtered(f.degree());
  const auto attempt = [&](const Bernstein<Bounded, 1>& form, Rung rung) {
    result.roots.clear();
    const bool decided = filtered.run(form.values().data(), form.error(), f.lo(), f.hi(), result.roots);
    f.counts().record(rung, decided);
    if (decided) result.gaps.push_back(sign_of(form.values()[0], form.error()));
    return decided;
  };
  bool decided = attempt(f.bounded(), Rung::bounded);
  if (!decided)
    if (const auto fresh = f.fresh(f.lo(), f.hi())) decided = attempt(fresh->bounded(), Rung::interval);
  if (!decided) {
    f.counts().record(Rung::exact, true);
    result = exact_roots(f.exact(), f.lo(), f.hi());
    for (auto& root : result.roots) // `f` itself changes sign at a simple root: its filtered signs are cheaper
      if (root.multiplicity == 1) root.factor.reset();
    return result;
  }
  for (std::size_t i = 0; i < result.roots.size(); ++i) result.gaps.push_back(opposite(result.gaps.back()));
  return result;
}

namespace detail {

inline Sign sign_for_refinement(const Univariate& f, const Isolated_root<double>& root, double x)
{
  return root.factor ? exact_sign_at(*root.factor, f.lo(), f.hi(), x) : f.sign(x);
}

/// One step of a bracketing secant in plain doubles: an approximation of a simple root, certified by nobody.
inline double approximate_root(const Univariate& f, double a, double b)
{
  double fa = f.value(a).value, fb = f.value(b).value;
  if (!(fa * fb < 0)) return 0.5 * (a + b);
  int side = 0;
  for (int i = 0; i < 60 && b - a > 4e-16 * (1 + std::abs(a)); ++i) {
    double x = (a * fb - b * fa) / (fb - fa);
    if (!(x > a && x < b)) x = 0.5 * (a + b);
    const double fx = f.value(x).value;
    if (fx == 0) return x;
    if ((fx > 0) == (fb > 0)) {
      if (b - x < 2e-16 * (1 + std::abs(x))) return x;
      b = x, fb = fx;
      if (side == 1) fa *= 0.5;
      side = 1;
    } else {
      if (x - a < 2e-16 * (1 + std::abs(x))) return x;
      a = x, fa = fx;
      if (side == -1) fb *= 0.5;
      side = -1;
    }
  }
  return 0.5 * (a + b);
}

} // namespace detail

namespace detail {

/// Shrinks a simple root's interval around a numerical guess, by signs that the bounded form proves.
inline void shrink_by_filter(const Univariate& f, Isolated_root<double>& root, Sign above, double width)
{
  const double guess = approximate_root(f, root.lo, root.hi);
  const double slope_error = f.value(guess).error;
  double delta = std::max(0.45 * width, 0x1p-54 * std::max(std::abs(root.lo), std::abs(root.hi)));
  const double rise = std::abs(f.value(root.hi).value - f.value(root.lo).value) / (root.hi - root.lo);
  if (rise > 0) delta = std::max(delta, 2 * slope_error / rise);
  for (; delta < root.hi - root.lo; delta *= 4) {
    const double a = std::max(root.lo, guess - delta), b = std::min(root.hi, guess + delta);
    const Sign sa = a == root.lo ? opposite(above) : sign_of(f.value(a));
    const Sign sb = b == root.hi ? above : sign_of(f.value(b));
    if (sb == above && sa == opposite(above)) {
      root.lo = a;
      root.hi = b;
      return;
    }
  }
}

} // namespace detail

/// Narrows a root of `f` towards `width`. The enclosure stays certified: it shrinks only by proved signs, of the
/// bounded form, then of fresh ones on the part that is left; exact bisection follows while it is wider than
/// `exact_above`.
inline void refine_root(const Univariate& f, Isolated_root<double>& root, double width, double exact_above)
{
  if (root.is_exact() || root.hi - root.lo <= width) return;
  if (!root.factor) {
    const Sign above = f.sign(root.hi);
    detail::shrink_by_filter(f, root, above, width);
    for (int step = 0; step < 3 && root.hi - root.lo > std::max(width, exact_above); ++step) {
      const auto fresh = f.fresh(root.lo, root.hi);
      if (!fresh) break;
      const double before = root.hi - root.lo;
      f.counts().record(Rung::interval, true);
      detail::shrink_by_filter(*fresh, root, above, width);
      if (!(root.hi - root.lo < 0.5 * before)) break;
    }
  }
  while (!root.is_exact() && root.hi - root.lo > std::max(width, exact_above)) {
    if (root.factor) {
      if (!detail::bisect_exactly(*root.factor, f.lo(), f.hi(), root)) return;
      continue;
    }
    const double mid = 0.5 * (root.lo + root.hi);
    if (!(mid > root.lo && mid < root.hi)) return;
    const Sign s = f.sign(mid);
    if (s == Sign::zero) root.lo = root.hi = mid;
    else (s == f.sign(root.hi) ? root.hi : root.lo) = mid;
  }
}

} // namespace locus

#endif
