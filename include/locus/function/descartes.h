// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_DESCARTES_H
#define LOCUS_FUNCTION_DESCARTES_H

#include <locus/function/integer_polynomial.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace locus {

/// A real root: the only one of its polynomial in the open interval (lo, hi), or exactly lo where lo == hi.
template <class Coordinate>
struct Isolated_root {
  Coordinate lo, hi;
  int multiplicity = 1;
  /// Square-free factor (on the polynomial's whole interval) that has the root as a simple one; none where the
  /// polynomial itself has.
  std::shared_ptr<const Bernstein<Scaled_integer, 1>> factor;

  bool is_exact() const { return lo == hi; }
};

/// All roots on a closed interval, in order, and the strict signs between them: gaps[i] before roots[i], gaps.back()
/// after the last. A gap is empty where a root sits on an end of the interval.
template <class Coordinate>
struct Root_set {
  bool identically_zero = false;
  bool complete = true; ///< false where roots lie too close for `Coordinate` to separate
  std::vector<Isolated_root<Coordinate>> roots;
  std::vector<Sign> gaps;
};

namespace detail {

/// f/u for f(0) = 0 (or f/(1-u) for f(1) = 0), up to a positive factor.
inline Bernstein<Scaled_integer, 1> deflated(const Bernstein<Scaled_integer, 1>& f, bool at_one)
{
  const int n = f.degree();
  Integer common = 1;
  for (int i = 1; i <= n; ++i) common = lcm(common, Integer(i));
  Bernstein<Integer, 1> g(Degrees<1>{n - 1});
  for (int i = 0; i < n; ++i) {
    const int weight = at_one ? n - i : i + 1;
    g[static_cast<std::size_t>(i)] = f.values()[static_cast<std::size_t>(at_one ? i : i + 1)] * Integer(common / weight);
  }
  Bernstein<Scaled_integer, 1> result(std::move(g), 1);
  result.normalize();
  return result;
}

inline int variations(const Bernstein<Scaled_integer, 1>& f)
{
  int count = 0;
  Sign last = Sign::zero;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Sign s = f.sign(i);
    if (s == Sign::zero) continue;
    if (last != Sign::zero && s != last) ++count;
    last = s;
  }
  return count;
}

template <class Coordinate>
bool separates(const Coordinate& lo, const Coordinate& mid, const Coordinate& hi)
{
  return lo < mid && mid < hi;
}

/// Roots in the open interval (lo, hi) of a square-free polynomial; false where `Coordinate` runs out of digits.
template <class Coordinate>
bool isolate_exactly(Bernstein<Scaled_integer, 1> f, const Coordinate& lo, const Coordinate& hi,
                     std::vector<Isolated_root<Coordinate>>& out)
{
  if (f.degree() > 0 && f.sign(0) == Sign::zero) f = deflated(f, false);
  if (f.degree() > 0 && f.sign(f.size() - 1) == Sign::zero) f = deflated(f, true);
  const int v = variations(f);
  if (v == 0) return true;
  if (v == 1) {
    out.push_back({lo, hi, 1, nullptr});
    return true;
  }
  const Coordinate mid = (lo + hi) / 2;
  if (!separates(lo, mid, hi) || (std::is_same_v<Coordinate, double> && Rational(mid) * 2 != Rational(lo) + Rational(hi)))
    return false;
  const auto parts = split(f, 0, Rational(1, 2));
  if (!isolate_exactly(parts.first, lo, mid, out)) return false;
  if (parts.second.sign(0) == Sign::zero) out.push_back({mid, mid, 1, nullptr});
  return isolate_exactly(parts.second, mid, hi, out);
}

/// Sign of an exact polynomial on [lo, hi] at x.
template <class Coordinate>
Sign exact_sign_at(const Bernstein<Scaled_integer, 1>& f, const Coordinate& lo, const Coordinate& hi, const Coordinate& x)
{
  const Rational u = (Rational(x) - Rational(lo)) / (Rational(hi) - Rational(lo));
  return sign_of(evaluate_at(f.rational(), u));
}

/// Halves a root's interval by the exact sign of `f`, which has it as its only, simple root there.
/// False where `Coordinate` has no number between.
template <class Coordinate>
bool bisect_exactly(const Bernstein<Scaled_integer, 1>& f, const Coordinate& lo, const Coordinate& hi,
                    Isolated_root<Coordinate>& root)
{
  const Coordinate mid = (root.lo + root.hi) / 2;
  if (!separates(root.lo, mid, root.hi)) return false;
  const Sign at_mid = exact_sign_at(f, lo, hi, mid);
  if (at_mid == Sign::zero) {
    root.lo = root.hi = mid;
    return true;
  }
  // An end of the isolating interval may be another root: ask just inside, by the sign that the root separates.
  const Sign at_hi = exact_sign_at(f, lo, hi, root.hi);
  const Sign above = at_hi != Sign::zero ? at_hi : opposite(exact_sign_at(f, lo, hi, root.lo));
  if (above == Sign::zero) { // both ends are roots of f: count variations between
    const Rational a = (Rational(mid) - Rational(lo)) / (Rational(hi) - Rational(lo));
    const Rational b = (Rational(root.hi) - Rational(lo)) / (Rational(hi) - Rational(lo));
    auto part = restrict_to(f, 0, a, b);
    part = deflated(part, true);
    (variations(part) % 2 == 1 ? root.lo : root.hi) = mid;
    return true;
  }
  (at_mid != above ? root.lo : root.hi) = mid;
  return true;
}

} // namespace detail

/// All roots on [lo, hi] with multiplicities, in exact arithmetic: Yun's square-free factors, then Descartes' method on
/// each (which ends for square-free polynomials), then bisection until the roots of different factors are apart.
template <class Coordinate>
Root_set<Coordinate> exact_roots(const Bernstein<Scaled_integer, 1>& f, const Coordinate& lo, const Coordinate& hi)
{
  Root_set<Coordinate> result;
  if (f.is_zero()) {
    result.identically_zero = true;
    return result;
  }
  for (Square_free_factor& part : square_free_decomposition(monomial_form(f))) {
    const auto factor = std::make_shared<const Bernstein<Scaled_integer, 1>>(bernstein_form(part.factor));
    std::vector<Isolated_root<Coordinate>> roots;
    if (factor->sign(0) == Sign::zero) roots.push_back({lo, lo, 1, nullptr});
    if (!detail::isolate_exactly(*factor, lo, hi, roots)) result.complete = false;
    if (factor->sign(factor->size() - 1) == Sign::zero) roots.push_back({hi, hi, 1, nullptr});
    for (auto& root : roots) {
      root.multiplicity = part.multiplicity;
      root.factor = factor;
      // Ends of isolating intervals must not be roots of any factor, so that signs there tell the sides apart.
      while (!root.is_exact() && (detail::exact_sign_at(f, lo, hi, root.lo) == Sign::zero ||
                                  detail::exact_sign_at(f, lo, hi, root.hi) == Sign::zero))
        if (!detail::bisect_exactly(*factor, lo, hi, root)) {
          result.complete = false;
          break;
        }
      result.roots.push_back(root);
    }
  }
  auto& roots = result.roots;
  const auto clash = [](const auto& a, const auto& b) { return a.lo < b.hi && b.lo < a.hi; };
  for (std::size_t i = 0; i < roots.size() && result.complete; ++i)
    for (std::size_t j = 0; j < i && result.complete; ++j)
      while (clash(roots[i], roots[j]) || (roots[i].is_exact() != roots[j].is_exact() &&
                                           roots[i].lo <= roots[j].hi && roots[j].lo <= roots[i].hi)) {
        auto& wider = roots[i].hi - roots[i].lo > roots[j].hi - roots[j].lo ? roots[i] : roots[j];
        if (!detail::bisect_exactly(*wider.factor, lo, hi, wider)) {
          result.complete = false;
          break;
        }
      }
  std::sort(roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); });

  Sign sign = Sign::zero;
  for (std::size_t i = 0; i < f.size() && sign == Sign::zero; ++i) sign = f.sign(i);
  // Just right of `lo` the sign is that of the first nonzero coefficient; a root at `lo` has an empty gap before it.
  bool first = true;
  for (const auto& root : roots) {
    if (first && root.is_exact() && root.lo == lo) {
      result.gaps.push_back(root.multiplicity % 2 ? opposite(sign) : sign);
    } else {
      result.gaps.push_back(sign);
      if (root.multiplicity % 2) sign = opposite(sign);
    }
    first = false;
  }
  result.gaps.push_back(sign);
  return result;
}

} // namespace locus

#endif
