// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_DESCARTES_H
#define LOCUS_FUNCTION_DESCARTES_H

#include <locus/function/descartes_search.h>
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

template <class Coordinate>
bool separates(const Coordinate& lo, const Coordinate& mid, const Coordinate& hi)
{
  return lo < mid && mid < hi;
}

/// Sign of an exact polynomial on [lo, hi] at x.
template <class Coordinate>
Sign exact_sign_at(const Bernstein<Scaled_integer, 1>& f, const Coordinate& lo, const Coordinate& hi, const Coordinate& x)
{
  return sign_at(f, Rational((Rational(x) - Rational(lo)) / (Rational(hi) - Rational(lo))));
}

/// A root in the open unit interval: the only one of the part to which the cuts lead, or exactly in its middle.
struct Unit_root {
  Cut_path path;
  bool in_middle;
};

/// Gathers the roots of a square-free polynomial; a doubtful middle of a part it looks at exactly.
class Square_free_observer {
public:
  explicit Square_free_observer(const Bernstein<Scaled_integer, 1>& f) : f_(f) {}

  bool found(const Cut_path& path)
  {
    roots.push_back({path, false});
    return true;
  }
  bool found_middle(const Cut_path& path)
  {
    roots.push_back({path, true});
    return true;
  }
  bool is_root_in_middle(const Cut_path& path) const
  {
    const auto part = follow(path, Rational(0), Rational(1));
    return sign_at(f_, Rational((part->first + part->second) / 2)) == Sign::zero;
  }

  std::vector<Unit_root> roots;

private:
  const Bernstein<Scaled_integer, 1>& f_;
};

/// Exact coefficients rounded to doubles after division by a common power of two.
inline Bernstein<Bounded, 1> rounded(const Bernstein<Integer, 1>& f)
{
  Bernstein<double, 1> values(f.degrees());
  std::vector<long> exponent(f.size());
  long greatest = std::numeric_limits<long>::min();
  for (std::size_t i = 0; i < f.size(); ++i) {
    values[i] = mpz_get_d_2exp(&exponent[i], f[i].get_mpz_t());
    if (values[i] != 0) greatest = std::max(greatest, exponent[i]);
  }
  for (std::size_t i = 0; i < f.size(); ++i)
    if (values[i] != 0) values[i] = std::ldexp(values[i], static_cast<int>(std::max(exponent[i] - greatest, -2000L)));
  return {std::move(values), accumulated_error(0, 2, 1)};
}

/// All roots in the open unit interval of a square-free polynomial, in order. In doubles, unless they are known to
/// fail, then in ever more digits: with enough of them the search ends, since only a simple root can leave coefficients
/// without a sign for ever.
inline std::vector<Unit_root> isolate_exactly(const Bernstein<Scaled_integer, 1>& f, bool try_doubles = true)
{
  Square_free_observer observer(f);
  const Sign low = f.sign(0), high = f.sign(f.size() - 1);
  if (try_doubles) {
    const auto form = rounded(f.values());
    Bounded_coefficients coefficients(form.values().data(), f.degree(), form.error());
    if (Descartes_search(coefficients, observer, 64).run(low, high)) return std::move(observer.roots);
  }
  for (std::size_t words = 2;; words *= 2) {
    observer.roots.clear();
    Wide_coefficients coefficients(f.values().coefficients(), words);
    const std::size_t depth = words * GMP_NUMB_BITS / 2 + 8; // two roots 2^-d apart leave values of size 2^-2d
    if (Descartes_search(coefficients, observer, depth).run(low, high)) return std::move(observer.roots);
  }
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
  if (above == Sign::zero) { // both are: the sign right of `lo` is that of the derivative there
    const Sign rising = exact_sign_at(derivative(f), lo, hi, root.lo);
    (at_mid == rising ? root.lo : root.hi) = mid;
    return true;
  }
  (at_mid != above ? root.lo : root.hi) = mid;
  return true;
}

/// All roots on [lo, hi] of a square-free polynomial, in order, by isolating intervals whose ends are no roots.
/// False where `Coordinate` runs out of digits.
template <class Coordinate>
bool isolate_square_free(const Bernstein<Scaled_integer, 1>& f, const Coordinate& lo, const Coordinate& hi,
                         std::vector<Isolated_root<Coordinate>>& roots, bool try_doubles = true)
{
  if (f.sign(0) == Sign::zero) roots.push_back({lo, lo, 1, nullptr});
  for (Unit_root& root : isolate_exactly(f, try_doubles)) {
    if (root.in_middle) root.path.push_back({8, false});
    const auto part = follow(root.path, lo, hi);
    if (!part) return false;
    roots.push_back({root.in_middle ? part->second : part->first, part->second, 1, nullptr});
  }
  if (f.degree() > 0 && f.sign(f.size() - 1) == Sign::zero) roots.push_back({hi, hi, 1, nullptr});
  const auto touches_root = [&](std::size_t i) {
    if (roots[i].is_exact()) return false;
    const bool below = i > 0 && roots[i - 1].is_exact() && roots[i - 1].hi == roots[i].lo;
    const bool above = i + 1 < roots.size() && roots[i + 1].is_exact() && roots[i + 1].lo == roots[i].hi;
    return below || above;
  };
  for (std::size_t i = 0; i < roots.size(); ++i)
    while (touches_root(i))
      if (!bisect_exactly(f, lo, hi, roots[i])) return false;
  return true;
}

/// The polynomial that has the roots of all factors once.
inline Integer_polynomial product_of(const std::vector<Square_free_factor>& factors)
{
  Integer_polynomial product = factors[0].factor;
  for (std::size_t k = 1; k < factors.size(); ++k) product = multiply(product, factors[k].factor);
  return product;
}

/// Which of the factors has a root that all of them together have; its signs at the ends of the root's interval are
/// strict, so that they tell.
template <class Coordinate>
void find_factor(Isolated_root<Coordinate>& root, const std::vector<Square_free_factor>& parts,
                 const std::vector<std::shared_ptr<const Bernstein<Scaled_integer, 1>>>& factors, const Coordinate& lo,
                 const Coordinate& hi)
{
  std::size_t k = 0;
  for (; k + 1 < factors.size(); ++k) {
    const Sign at_lo = exact_sign_at(*factors[k], lo, hi, root.lo);
    if (at_lo == Sign::zero) break;
    if (!root.is_exact() && at_lo != exact_sign_at(*factors[k], lo, hi, root.hi)) break;
  }
  root.multiplicity = parts[k].multiplicity;
  root.factor = factors[k];
}

} // namespace detail

/// All roots on [lo, hi] with multiplicities: Yun's square-free factors, then Descartes' method on their product, with
/// as many digits as it takes; first in doubles, unless those are not to be tried.
template <class Coordinate>
Root_set<Coordinate> exact_roots(const Bernstein<Scaled_integer, 1>& f, const Coordinate& lo, const Coordinate& hi,
                                 bool try_doubles = true)
{
  Root_set<Coordinate> result;
  if (f.is_zero()) {
    result.identically_zero = true;
    return result;
  }
  auto& roots = result.roots;
  const std::vector<Square_free_factor> parts = square_free_decomposition(monomial_form(f));
  if (!parts.empty()) {
    std::vector<std::shared_ptr<const Bernstein<Scaled_integer, 1>>> factors;
    for (const Square_free_factor& part : parts)
      factors.push_back(std::make_shared<const Bernstein<Scaled_integer, 1>>(bernstein_form(part.factor)));
    const Bernstein<Scaled_integer, 1> all = parts.size() > 1 ? bernstein_form(detail::product_of(parts)) : *factors[0];
    result.complete = detail::isolate_square_free(all, lo, hi, roots, try_doubles);
    if (result.complete)
      for (auto& root : roots) detail::find_factor(root, parts, factors, lo, hi);
  }

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

/// Whether a nonzero polynomial has a root in the closed interval [lo, hi], exactly.
inline bool has_root_within(const Integer_polynomial& f, const Rational& lo, const Rational& hi)
{
  if (degree(f) < 1) return false;
  const Bernstein<Scaled_integer, 1> form = bernstein_form(f);
  if (lo == hi) return sign_at(form, lo) == Sign::zero;
  return !exact_roots(restrict_to(form, 0, lo, hi), Rational(0), Rational(1)).roots.empty();
}

} // namespace locus

#endif
