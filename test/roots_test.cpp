// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/zero_set/roots.h>

#include <catch2/catch.hpp>

#include <optional>

using namespace locus_test;
using locus::Bounded;
using locus::exact_rational;
using locus::Filter_counts;
using locus::Interval;
using locus::Isolated_root;
using locus::Root_set;
using locus::Rung;
using locus::Scaled_integer;
using locus::Univariate;
using locus::with_upward_rounding;

namespace {

std::size_t index(Rung r) { return static_cast<std::size_t>(r); }

/// A polynomial on an interval as the solver would hand it over, with what is needed to judge the answers.
struct Subject {
  Polynomial f;
  double lo = 0, hi = 1;
  int degree = 0;         ///< of the Bernstein form; the polynomial's own may be lower
  double slack = 0;       ///< relative size of the errors that the bounded form pretends to have
  bool has_fresh = false; ///< whether the isolator may ask for a tight form
  std::vector<std::pair<Rational, int>> known = {}; ///< all roots in [lo, hi] with multiplicities, if `is_known`
  bool is_known = false;

  Bernstein<Rational, 1> exact() const { return bernstein_on(f, exact_rational(lo), exact_rational(hi), degree); }
  std::string describe() const
  {
    return "degree " + show(degree) + " on [" + show(lo) + ", " + show(hi) + "], slack " + show(slack) +
           ", monomials " + show(f);
  }
};

Subject on_unit(Polynomial f)
{
  Subject s;
  s.degree = std::max(0, static_cast<int>(f.size()) - 1);
  s.f = std::move(f);
  return s;
}

Subject with_known_roots(const std::vector<std::pair<Rational, int>>& roots, double lo, double hi,
                         const Polynomial& other = {Rational(1)})
{
  Subject s;
  s.f = other;
  s.lo = lo;
  s.hi = hi;
  s.is_known = true;
  for (const auto& [x, multiplicity] : roots) {
    for (int i = 0; i < multiplicity; ++i) s.f = times(s.f, {Rational(-x), Rational(1)});
    if (exact_rational(lo) <= x && x <= exact_rational(hi)) s.known.emplace_back(x, multiplicity);
  }
  std::sort(s.known.begin(), s.known.end());
  s.degree = static_cast<int>(s.f.size()) - 1;
  return s;
}

Bernstein<Bounded, 1> loosened(const Bernstein<Bounded, 1>& form, double slack, Random& random)
{
  if (slack == 0) return form;
  const double error = slack * form.norm();
  Bernstein<double, 1> values = form.values();
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] += error * 0.9 * (random.chance(50) ? random.symmetric() : random.chance(50) ? 1 : -1);
  return {std::move(values), form.error() + error};
}

/// Upward rounding needed.
Univariate univariate(const Subject& s, Filter_counts& counts, Random& random)
{
  const auto exact = s.exact();
  const auto intervals = locus::converted<Interval>(exact, [](const Rational& c) { return locus::enclosing(c); });
  Univariate::Make_fresh fresh;
  if (s.has_fresh)
    fresh = [s](double a, double b) {
      const auto part = bernstein_on(s.f, exact_rational(a), exact_rational(b), s.degree);
      return locus::bounded(locus::converted<Interval>(part, [](const Rational& c) { return locus::enclosing(c); }));
    };
  return Univariate(
    loosened(locus::bounded(intervals), s.slack, random), s.lo, s.hi,
    [exact] { return Bernstein<Scaled_integer, 1>(exact); }, &counts, fresh);
}

/// A second opinion on a polynomial: Sturm's chains of f, of gcd(f, f'), of gcd of that and its derivative, …
/// A root of multiplicity m is a root of the first m of them.
class Second_opinion {
public:
  explicit Second_opinion(const Polynomial& f) : signs_(with_integers(trimmed(f)))
  {
    for (Polynomial g = trimmed(f); g.size() > 1; g = euclid(g, slope(g))) chains_.emplace_back(g);
  }
  int distinct(const Rational& a, const Rational& b) const { return chains_.empty() ? 0 : chains_[0].closed(a, b); }
  int multiplicity_at(const Rational& x) const
  {
    int m = 0;
    for (const Sturm& s : chains_) m += s.is_root(x);
    return m;
  }
  int between(const Rational& a, const Rational& b) const { return chains_.empty() ? 0 : chains_[0].open(a, b); }
  int multiplicity_between(const Rational& a, const Rational& b) const
  {
    int m = 0;
    for (const Sturm& s : chains_) m += s.open(a, b) > 0;
    return m;
  }
  int sign(const Rational& x) const { return sign_at(signs_, x); }

private:
  std::vector<Integer> signs_;
  std::vector<Sturm> chains_;
};

Rational as_rational(double x) { return exact_rational(x); }
Rational as_rational(const Rational& x) { return x; }

/// What is wrong with an isolation, or an empty text.
template <class Coordinate>
std::string fault_of(const Root_set<Coordinate>& set, const Subject& s, const Second_opinion& opinion)
{
  const Rational lo = exact_rational(s.lo), hi = exact_rational(s.hi);
  if (set.identically_zero) return "called zero";
  if (!set.complete) return "not complete";
  const int expected = opinion.distinct(lo, hi);
  if (static_cast<int>(set.roots.size()) != expected)
    return "found " + std::to_string(set.roots.size()) + " roots of " + std::to_string(expected);
  if (s.is_known && set.roots.size() != s.known.size())
    return "found " + std::to_string(set.roots.size()) + " roots, known are " + std::to_string(s.known.size());
  if (set.gaps.size() != set.roots.size() + 1) return "the number of gaps is not one more than that of roots";
  Rational before = lo;
  for (std::size_t i = 0; i < set.roots.size(); ++i) {
    const auto& root = set.roots[i];
    const Rational a = as_rational(root.lo), b = as_rational(root.hi);
    const std::string name = "root " + std::to_string(i) + " in [" + show(root.lo) + ", " + show(root.hi) + "]: ";
    if (a > b || a < lo || b > hi) return name + "not an interval in the domain";
    if (i > 0 && a < as_rational(set.roots[i - 1].hi)) return name + "overlaps the one before";
    if (root.is_exact()) {
      if (opinion.sign(a) != 0) return name + "no zero there";
      if (opinion.multiplicity_at(a) != root.multiplicity)
        return name + "wrong multiplicity " + std::to_string(root.multiplicity);
    } else {
      if (opinion.between(a, b) != 1) return name + "holds " + std::to_string(opinion.between(a, b)) + " roots";
      if (opinion.sign(a) == 0 || opinion.sign(b) == 0) return name + "an end is a root";
      if (opinion.multiplicity_between(a, b) != root.multiplicity)
        return name + "wrong multiplicity " + std::to_string(root.multiplicity);
    }
    if (s.is_known) {
      const auto& [x, multiplicity] = s.known[i];
      if (x < a || x > b || multiplicity != root.multiplicity)
        return name + "the known root is " + show(x) + ", " + std::to_string(multiplicity) + " times";
    }
    if (root.factor) { // the factor changes sign at the root
      const auto factor = root.factor->rational();
      const auto value = [&](const Rational& x) { return plain_value(factor, {Rational((x - lo) / (hi - lo))}); };
      if (root.is_exact() ? value(a) != 0 : sgn(value(a)) * sgn(value(b)) >= 0)
        return name + "its factor has no simple root there";
    }
    // The gap before it, unless empty.
    if (!(i == 0 && root.is_exact() && a == lo)) {
      const Rational x = (before + a) / 2;
      if (opinion.sign(x) == 0 || locus::sign_of_int(opinion.sign(x)) != set.gaps[i])
        return name + "wrong sign before it";
    }
    before = b;
  }
  if (set.roots.empty() || !(set.roots.back().is_exact() && as_rational(set.roots.back().hi) == hi)) {
    const Rational x = (before + hi) / 2;
    if (locus::sign_of_int(opinion.sign(x)) != set.gaps.back()) return "wrong sign after the last root";
  }
  return {};
}

struct Fates {
  std::size_t filtered = 0, exact = 0, incomplete = 0, roots = 0, refined = 0;
};

/// Isolates by all ways, judges each, refines the roots and judges again.
void check(const Subject& s, Random& random, Samples& samples, Fates& fates, bool may_be_incomplete = false)
{
  const Second_opinion opinion(s.f);
  const auto say = [&](const std::string& how, const std::string& fault) {
    return how + ": " + fault + "\n" + s.describe();
  };

  const Bernstein<Scaled_integer, 1> exact_form(s.exact());
  const auto in_rationals = locus::exact_roots(exact_form, exact_rational(s.lo), exact_rational(s.hi));
  std::string fault = fault_of(in_rationals, s, opinion);
  samples.expect(fault.empty(), [&] { return say("exactly, in rationals", fault); });

  const auto in_doubles = locus::exact_roots(exact_form, s.lo, s.hi);
  if (in_doubles.complete || !may_be_incomplete) {
    fault = fault_of(in_doubles, s, opinion);
    samples.expect(fault.empty(), [&] { return say("exactly, in doubles", fault); });
  }

  Filter_counts counts;
  Root_set<double> set;
  std::vector<std::pair<Isolated_root<double>, double>> refined; // with the width asked for
  std::vector<Isolated_root<double>> filtered_only;
  with_upward_rounding([&] {
    const Univariate f = univariate(s, counts, random);
    set = locus::isolate_roots(f);
    if (!set.complete) return;
    for (const auto& root : set.roots) {
      auto narrow = root;
      const double width = (s.hi - s.lo) * std::ldexp(1.0, -random.between(3, 50));
      locus::refine_root(f, narrow, width, width);
      refined.emplace_back(narrow, width);
      auto by_filter = root;
      locus::refine_root(f, by_filter, width, 1e300);
      filtered_only.push_back(by_filter);
    }
  });
  if (!set.complete) {
    ++fates.incomplete;
    samples.expect(may_be_incomplete, [&] { return say("isolated", "not complete"); });
    return;
  }
  fault = fault_of(set, s, opinion);
  samples.expect(fault.empty(), [&] { return say("isolated", fault); });
  samples.expect(set.roots.size() == in_rationals.roots.size() && set.gaps == in_rationals.gaps,
                 [&] { return say("isolated", "filtered and exact disagree"); });
  const bool exactly = counts.failures[index(Rung::bounded)] > 0;
  samples.expect(counts.calls[index(Rung::bounded)] > 0 &&
                   (exactly || s.slack > 0 || counts.calls[index(Rung::bounded)] > 0),
                 [&] { return say("isolated", "counts"); });
  (exactly ? fates.exact : fates.filtered)++;
  fates.roots += set.roots.size();
  if (!fault.empty()) return;

  for (std::size_t i = 0; i < refined.size(); ++i) {
    const auto& before = set.roots[i];
    for (const auto* after : {&refined[i].first, &filtered_only[i]}) {
      const Rational a = exact_rational(after->lo), b = exact_rational(after->hi);
      const bool inside = before.lo <= after->lo && after->hi <= before.hi && after->lo <= after->hi;
      samples.expect(inside &&
                       (after->is_exact() ? opinion.sign(a) == 0
                                          : opinion.between(a, b) == 1 && opinion.sign(a) != 0 && opinion.sign(b) != 0),
                     [&] { return say("refined to " + show(after->lo) + ", " + show(after->hi), "the root is lost"); });
    }
    const auto& [narrow, width] = refined[i];
    const bool neighbours =
      std::nextafter(std::nextafter(narrow.lo, 2.0 + s.hi), 2.0 + s.hi) >= narrow.hi; // doubles end here
    samples.expect(narrow.hi - narrow.lo <= width || neighbours, [&, w = width, lo = narrow.lo, hi = narrow.hi] {
      return say("refined to " + show(lo) + ", " + show(hi), "wider than " + show(w));
    });
    fates.refined += !before.is_exact();
  }
}

} // namespace

// -------------------------------------------------------------------------------------------------- known roots

TEST_CASE("polynomials with known rational roots, simple and multiple, are isolated", "[roots]")
{
  Random random(71);
  Samples samples;
  Fates fates;
  for (int i = 0; i < 250; ++i) {
    std::vector<std::pair<Rational, int>> roots;
    for (int k = random.between(0, 6); k > 0; --k) {
      Rational x;
      switch (random.below(7)) {
      case 0:
        x = Rational(random.below(2));
        break; // an end
      case 1:
        x = Rational(random.below(17)) / 16;
        break; // a point where Descartes' method cuts
      case 2:
        x = random.rational();
        break; // anywhere
      case 3:
        x = roots.empty() ? Rational(1, 2) : Rational(roots.back().first + two_to(-random.between(3, 30)));
        break; // close
      default:
        x = random.unit_rational();
      }
      bool is_new = true;
      for (const auto& r : roots) is_new = is_new && r.first != x;
      if (is_new) roots.emplace_back(x, random.chance(70) ? 1 : random.between(2, 3));
    }
    Polynomial other{random.chance(50) ? Rational(1) : Rational(-3, 7)};
    if (random.chance(30))
      other = times(other, {Rational(random.between(1, 5)), Rational(-1), Rational(1)}); // no real roots
    Subject s = with_known_roots(roots, 0, 1, other);
    s.degree += random.chance(20) ? random.below(3) : 0;
    s.has_fresh = random.chance(50);
    s.slack = random.chance(70) ? 0 : std::ldexp(1.0, -random.between(5, 40));
    check(s, random, samples, fates, true);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 2000);
  CHECK(fates.filtered > 20);
  CHECK(fates.exact > 50);
  CHECK(fates.refined > 200);
  CHECK(fates.incomplete < 10);
}

TEST_CASE("roots at both ends, in the middle and side by side", "[roots]")
{
  Random random(72);
  Samples samples;
  Fates fates;
  const Rational half(1, 2), third(1, 3), tiny = two_to(-30);
  using Roots = std::vector<std::pair<Rational, int>>;
  for (const Roots& roots : {Roots{{0, 1}, {1, 1}},
                             Roots{{0, 2}, {1, 3}},
                             Roots{{half, 1}},
                             Roots{{half, 2}},
                             Roots{{half, 3}},
                             Roots{{0, 1}, {half, 1}, {1, 1}},
                             Roots{{0, 3}, {half, 4}, {1, 2}},
                             Roots{{half, 1}, {Rational(half + tiny), 1}},
                             Roots{{half, 2}, {Rational(half + tiny), 1}},
                             Roots{{third, 1}, {Rational(third + tiny), 1}},
                             Roots{{third, 3}, {Rational(third + tiny), 2}},
                             Roots{{0, 1}, {tiny, 1}},
                             Roots{{tiny, 1}, {Rational(2 * tiny), 1}},
                             Roots{{1, 1}, {Rational(1 - tiny), 1}},
                             Roots{{Rational(1 - tiny), 2}, {Rational(1 - 2 * tiny), 1}},
                             Roots{{Rational(-tiny), 1}, {Rational(1 + tiny), 1}},
                             Roots{{Rational(-tiny), 2}, {Rational(1 + tiny), 2}},
                             Roots{{0, 1}, {Rational(-tiny), 1}},
                             Roots{{Rational(1, 4), 1}, {half, 1}, {Rational(3, 4), 1}, {Rational(3, 8), 1}},
                             Roots{{third, 5}},
                             Roots{},
                             Roots{{0, 6}},
                             Roots{{1, 6}},
                             Roots{{third, 1}, {Rational(third + tiny), 1}, {Rational(third + 2 * tiny), 1}}}) {
    for (const bool fresh : {false, true})
      for (const double slack : {0.0, 0x1p-20, 1.0}) {
        Subject s = with_known_roots(roots, 0, 1, {Rational(-2)});
        s.has_fresh = fresh;
        s.slack = slack;
        check(s, random, samples, fates);
      }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 600);
  CHECK(fates.exact > 50);
}

TEST_CASE("Wilkinson's polynomials", "[roots]")
{
  Random random(73);
  Samples samples;
  Fates fates;
  for (const int n : {10, 20})
    for (const int parts : {n + 1, n, n - 1}) { // inside; up to the end; one outside
      std::vector<std::pair<Rational, int>> roots;
      for (int k = 1; k <= n; ++k) roots.emplace_back(Rational(k) / parts, 1);
      check(with_known_roots(roots, 0, 1), random, samples, fates);
    }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
  CHECK(fates.roots > 80u);
}

TEST_CASE("Chebyshev polynomials up to degree 40 have the roots that the cosine tells", "[roots]")
{
  Random random(74);
  Samples samples;
  Fates fates;
  // T_n(2u-1) by the recurrence.
  Polynomial before{Rational(1)}, current{Rational(-1), Rational(2)};
  for (int n = 1; n <= 40; ++n) {
    if (n < 12 || n % 7 == 5) {
      const Subject s = on_unit(current);
      const double width = n < 20 ? 1e-14 : 1e-8;   // exact signs of high degrees are slow
      if (n < 20) check(s, random, samples, fates); // above, n sign changes and the cosine say it all
      Filter_counts counts;
      Root_set<double> set;
      with_upward_rounding([&] {
        const Univariate f = univariate(s, counts, random);
        set = locus::isolate_roots(f);
        for (auto& root : set.roots) locus::refine_root(f, root, width, width);
      });
      bool right = set.roots.size() == static_cast<std::size_t>(n);
      for (int k = 0; right && k < n; ++k) {
        const double known = 0.5 - 0.5 * std::cos((2 * k + 1) * 3.14159265358979323846 / (2 * n));
        const auto& root = set.roots[static_cast<std::size_t>(k)];
        right =
          root.lo - 1e-14 < known && known < root.hi + 1e-14 && root.hi - root.lo <= width && root.multiplicity == 1;
        const auto signs = with_integers(current);
        const int below = sign_at(signs, exact_rational(root.lo)), above = sign_at(signs, exact_rational(root.hi));
        right = right && (root.is_exact() ? below == 0 : below * above < 0) &&
                (k == 0 || set.roots[static_cast<std::size_t>(k) - 1].hi <= root.lo);
        right = right && set.gaps[static_cast<std::size_t>(k)] == ((n - k) % 2 ? Sign::negative : Sign::positive);
      }
      samples.expect(right, [&] { return "degree " + show(n); });
    }
    Polynomial next = times({Rational(-2), Rational(4)}, current);
    for (std::size_t i = 0; i < before.size(); ++i) next[i] -= before[i];
    before = std::move(current);
    current = std::move(next);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 300);
}

TEST_CASE("irrational roots close together are told apart", "[roots]")
{
  Random random(75);
  Samples samples;
  Fates fates;
  for (const int k : {2, 6, 12, 18, 22}) {
    // (u - m)² - 2·4^(-k): two roots √2·2^(1-k) apart; then with both a third root near, and squared.
    for (const Rational& m : {Rational(1, 2), Rational(1, 3)}) {
      const Polynomial pair{Rational(m * m - 2 * two_to(-2 * k)), Rational(-2 * m), Rational(1)};
      for (const auto& f : {pair, times(pair, {Rational(-m), Rational(1)}),
                            times(pair, {Rational(m + two_to(-k)), Rational(-1)}), times(pair, pair)}) {
        Subject s = on_unit(f);
        check(s, random, samples, fates);
        s.has_fresh = true;
        s.slack = 0x1p-10;
        check(s, random, samples, fates);
      }
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 500);
}

TEST_CASE("roots far closer than doubles are told apart in rationals", "[roots]")
{
  Random random(84);
  Samples samples;
  Fates fates;
  for (const int k : {60, 100, 300, 700}) {
    const Rational x(1, 3), near = x + two_to(-k);
    check(with_known_roots({{x, 1}, {near, 1}}, 0, 1), random, samples, fates, true);
    check(with_known_roots({{x, 2}, {near, 1}, {Rational(1, 2), 1}}, 0, 1), random, samples, fates, true);
    check(with_known_roots({{0, 1}, {two_to(-k), 3}}, 0, 1), random, samples, fates, true);
    check(
      with_known_roots(
        {{Rational(1, 2), 1}, {Rational(Rational(1, 2) + two_to(-k)), 1}, {Rational(Rational(1, 2) - two_to(-k)), 2}},
        0, 1),
      random, samples, fates, true);
    check(on_unit({Rational(x * x - 2 * two_to(-2 * k)), Rational(-2 * x), Rational(1)}), random, samples, fates, true);
    check(on_unit({Rational(x * x + 2 * two_to(-2 * k)), Rational(-2 * x), Rational(1)}), random, samples, fates,
          true); // none, nearly
  }
  LOCUS_REQUIRE_SAMPLES(samples, 24);
}

TEST_CASE("a polynomial that is zero is told apart from one without roots", "[roots]")
{
  Filter_counts counts;
  Root_set<double> zero, none, negative;
  Random random(76);
  with_upward_rounding([&] {
    Subject s = on_unit({});
    s.degree = 3;
    zero = locus::isolate_roots(univariate(s, counts, random));
    none = locus::isolate_roots(univariate(on_unit({Rational(1, 3)}), counts, random));
    negative = locus::isolate_roots(univariate(on_unit({Rational(-1), Rational(1), Rational(-1)}), counts, random));
  });
  CHECK(zero.identically_zero);
  CHECK(zero.roots.empty());
  CHECK_FALSE(none.identically_zero);
  CHECK(none.roots.empty());
  CHECK(none.gaps == std::vector<Sign>{Sign::positive});
  CHECK(negative.gaps == std::vector<Sign>{Sign::negative});
  CHECK(counts.calls[index(Rung::exact)] >= 1);
  CHECK(
    locus::exact_roots(Bernstein<Scaled_integer, 1>(Bernstein<Rational, 1>(Degrees<1>{4})), Rational(0), Rational(1))
      .identically_zero);
}

// --------------------------------------------------------------------------------------------- random polynomials

TEST_CASE("random polynomials of degrees 1 to 30 have as many roots as Sturm's theorem says", "[roots]")
{
  Random random(77);
  Samples samples;
  Fates fates;
  for (int n = 1; n <= 30; ++n)
    for (int i = 0; i < 4; ++i) {
      // Random Bernstein coefficients change sign often; by the definition they become monomials.
      Polynomial f;
      const int bits = random.chance(50) ? 3 : 40;
      for (int k = 0; k <= n; ++k) {
        const Rational c(random.chance(10) ? Integer(0) : random.integer(bits));
        Polynomial basis{Rational(c * choose(n, k))};
        for (int j = 0; j < n; ++j)
          basis = times(basis, j < k ? Polynomial{Rational(0), Rational(1)} : Polynomial{Rational(1), Rational(-1)});
        f = plus(f, basis);
      }
      if (f.empty()) continue;
      Subject s = on_unit(f);
      s.degree = std::max(s.degree, n);
      s.has_fresh = random.chance(30);
      if (random.chance(30)) s.slack = std::ldexp(1.0, -random.between(2, 45));
      check(s, random, samples, fates);
    }
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
  CHECK(fates.filtered > 30);
  CHECK(fates.roots > 150);
}

TEST_CASE("coefficients hidden by their error never cost a root", "[roots]")
{
  // Small integers, an error of their own size: whatever the filter says must hold for the polynomial meant.
  Random random(78);
  Samples samples;
  Fates fates;
  for (int i = 0; i < 3000; ++i) {
    const int n = random.between(2, 8);
    std::vector<Rational> c;
    for (int k = 0; k <= n; ++k) c.push_back(Rational(random.between(-3, 3)));
    const double error = random.between(1, 7) * 0.25;
    const Bernstein<Rational, 1> truth(Degrees<1>{n}, c);
    bool all_zero = true;
    for (const Rational& x : c) all_zero = all_zero && x == 0;
    if (all_zero) continue;
    Filter_counts counts;
    Root_set<double> set;
    with_upward_rounding([&] {
      Bernstein<double, 1> values(Degrees<1>{n});
      for (std::size_t k = 0; k < values.size(); ++k)
        values[k] =
          locus::nearest_double(c[k]) + error * (random.chance(50) ? random.symmetric() : random.between(-1, 1));
      set = locus::isolate_roots(Univariate(
        Bernstein<Bounded, 1>(values, error), 0, 1, [truth] { return Bernstein<Scaled_integer, 1>(truth); }, &counts));
    });
    (counts.failures[index(Rung::bounded)] > 0 ? fates.exact : fates.filtered)++;
    Subject s;
    s.degree = n;
    for (int k = 0; k <= n; ++k) {
      Polynomial basis{Rational(c[static_cast<std::size_t>(k)] * choose(n, k))};
      for (int j = 0; j < n; ++j)
        basis = times(basis, j < k ? Polynomial{Rational(0), Rational(1)} : Polynomial{Rational(1), Rational(-1)});
      s.f = plus(s.f, basis);
    }
    const std::string fault = fault_of(set, s, Second_opinion(s.f));
    samples.expect(fault.empty(), [&] { return fault + "\ncoefficients " + show(c) + ", error " + show(error); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 2900);
  CHECK(fates.filtered > 100);
  CHECK(fates.exact > 100);
}

TEST_CASE("two unknown coefficients between different signs may hide two more roots", "[roots]")
{
  // The polynomial with coefficients 1, -2, 2, -1 has three roots; within an error of 1 its form reads 1.1, -1, 1, -1.1.
  const Bernstein<Rational, 1> truth(Degrees<1>{3}, {Rational(1), Rational(-2), Rational(2), Rational(-1)});
  Filter_counts counts;
  Root_set<double> set;
  with_upward_rounding([&] {
    const Bernstein<double, 1> values(Degrees<1>{3}, {1.1, -1, 1, -1.1});
    set = locus::isolate_roots(Univariate(
      Bernstein<Bounded, 1>(values, 1), 0, 1, [truth] { return Bernstein<Scaled_integer, 1>(truth); }, &counts));
  });
  CHECK(set.roots.size() == 3u);
}

TEST_CASE("a certain sign at an end stays certain while the error grows by subdivision", "[roots]")
{
  // One triple root near 0.01, written with degree 6: the sign at 0 is certain, if only just beside the error.
  Random random(82);
  Samples samples;
  Fates fates;
  for (int k = 4; k < 16; ++k)
    for (int m = 2; m <= 4; ++m)
      for (const int raised : {0, 1, 2}) {
        Subject s = with_known_roots({{Rational(1, 1 << k), m}}, 0, 1, {Rational(-7), Rational(-6), Rational(4)});
        s.degree += raised;
        check(s, random, samples, fates);
      }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  CHECK(fates.exact > 50);
}

// ------------------------------------------------------------------------------------------------ other intervals

TEST_CASE("a cut that no double represents is not made", "[roots]")
{
  // Two roots within a few doubles on an interval of 2^16 of them.
  const double lo = 1 - 0x1p-37;
  Random random(83);
  Samples samples;
  Fates fates;
  for (int i = 0; i < 100; ++i) {
    const Rational x = exact_rational(lo) + random.unit_rational() * Rational(3, 4) * two_to(-37);
    check(with_known_roots({{x, 1}, {Rational(x + random.between(1, 40) * two_to(-54)), 1}}, lo, 1), random, samples,
          fates, true);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
  CHECK(fates.incomplete < 100);
}

TEST_CASE("roots are isolated on intervals that doubles hardly resolve", "[roots]")
{
  Random random(79);
  Samples samples;
  Fates fates;
  for (int i = 0; i < 200; ++i) {
    // On [1-2^-k, 1] there are 2^(53-k) doubles; all roots lie a good many of them apart.
    const int k = random.between(20, 46);
    const double lo = 1 - std::ldexp(1.0, -k);
    std::vector<std::pair<Rational, int>> roots;
    for (int count = random.between(2, 5), j = 0; j < count; ++j) {
      const Rational u = random.unit_rational();
      roots.emplace_back(Rational(exact_rational(lo) + u * two_to(-k)), 1);
      if (random.chance(40))
        roots.emplace_back(
          Rational(exact_rational(lo) + (u + two_to(-random.between(4, std::min(20, 50 - k)))) * two_to(-k)), 1);
    }
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    check(with_known_roots(roots, lo, 1), random, samples, fates, true);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 800);
  CHECK(fates.filtered > 20);
}

TEST_CASE("roots are isolated on intervals that are not dyadic", "[roots]")
{
  Random random(80);
  Samples samples;
  Fates fates;
  for (int i = 0; i < 200; ++i) {
    const double a = 4 * random.symmetric(), b = a + random.unit() * std::ldexp(1.0, -random.below(20));
    if (!(a < b)) continue;
    std::vector<std::pair<Rational, int>> roots;
    for (int k = random.between(1, 5); k > 0; --k)
      roots.emplace_back(Rational(exact_rational(a) + random.unit_rational() * (exact_rational(b) - exact_rational(a))),
                         1);
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    check(with_known_roots(roots, a, b), random, samples, fates, true);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  CHECK(fates.filtered > 20);
}

TEST_CASE("whether a root lies in a closed interval is decided exactly, ends included", "[roots]")
{
  Random random(85);
  Samples samples;
  std::size_t yes = 0, no = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<Rational> roots;
    for (int k = random.between(0, 4); k > 0; --k)
      roots.push_back(random.chance(30) ? random.rational() : random.unit_rational());
    Polynomial f = with_roots(roots, Rational(random.between(1, 9)));
    if (random.chance(30)) f = times(f, {Rational(-1, 2), Rational(0), Rational(1)}); // with ±1/√2
    const auto an_end = [&] {
      return !roots.empty() && random.chance(40)
               ? roots[static_cast<std::size_t>(random.below(static_cast<int>(roots.size())))]
               : random.rational();
    };
    Rational lo = an_end(), hi = random.chance(15) ? lo : an_end();
    if (random.chance(20)) hi = Rational(lo + two_to(-random.between(20, 200)));
    if (random.chance(20)) lo = Rational(hi - two_to(-random.between(20, 200)));
    if (lo > hi) std::swap(lo, hi);
    const bool expected = f.size() > 1 && Sturm(f).closed(lo, hi) > 0;
    samples.expect(locus::has_root_within(with_integers(f), lo, hi) == expected,
                   [&] { return show(f) + " in [" + show(lo) + ", " + show(hi) + "]"; });
    (expected ? yes : no)++;
  }
  LOCUS_REQUIRE_SAMPLES(samples, 300);
  CHECK(yes > 50);
  CHECK(no > 50);
}

// ------------------------------------------------------------------------------------------------ values and signs

TEST_CASE("a polynomial's filtered value keeps within its error, and its sign is the exact one", "[roots]")
{
  Random random(81);
  Samples samples;
  std::uint64_t exact_calls = 0, interval_calls = 0;
  for (int i = 0; i < 300; ++i) {
    Subject s;
    s.lo = random.chance(50) ? 0 : random.symmetric();
    s.hi = s.lo + (random.chance(50) ? 1 : random.unit() + 1e-9);
    const Rational root = random.unit_rational();
    Polynomial f;
    for (int k = random.between(0, 9); k >= 0; --k) f.push_back(random.rational());
    s.f = trimmed(times(f, with_roots({root})));
    if (s.f.empty()) continue;
    s.degree = static_cast<int>(s.f.size()) - 1;
    s.has_fresh = random.chance(50);
    s.slack = random.chance(50) ? 0 : std::ldexp(1.0, -random.between(1, 40));
    std::vector<double> points{s.lo, s.hi, s.lo + 0.5 * (s.hi - s.lo)};
    for (int k = 0; k < 4; ++k) points.push_back(std::min(s.hi, s.lo + random.unit() * (s.hi - s.lo)));
    const double near_root = locus::nearest_double(root); // where the filter cannot tell
    if (s.lo <= near_root && near_root <= s.hi) points.push_back(near_root);
    Filter_counts counts;
    std::vector<Bounded> values;
    std::vector<Sign> signs;
    with_upward_rounding([&] {
      const Univariate f_on = univariate(s, counts, random);
      for (double x : points) {
        values.push_back(f_on.value(x));
        signs.push_back(f_on.sign(x));
      }
    });
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Rational truth = horner(s.f, exact_rational(points[k]));
      samples.expect(abs(Rational(exact_rational(values[k].value) - truth)) <= exact_rational(values[k].error),
                     [&] { return "value at " + show(points[k]) + " of " + s.describe(); });
      samples.expect(signs[k] == locus::sign_of(truth),
                     [&] { return "sign at " + show(points[k]) + " of " + s.describe(); });
    }
    samples.expect(counts.calls[index(Rung::bounded)] == points.size(),
                   [&] { return "each sign asks the bounded rung; " + s.describe(); });
    samples.expect(counts.failures[index(Rung::bounded)] ==
                       (s.has_fresh ? counts.calls[index(Rung::interval)] : counts.calls[index(Rung::exact)]) &&
                     counts.failures[index(Rung::exact)] == 0 &&
                     (!s.has_fresh || counts.failures[index(Rung::interval)] == counts.calls[index(Rung::exact)]),
                   [&] { return "each failure asks the next rung; " + s.describe(); });
    exact_calls += counts.calls[index(Rung::exact)];
    interval_calls += counts.calls[index(Rung::interval)];
  }
  LOCUS_REQUIRE_SAMPLES(samples, 3000);
  CHECK(exact_calls > 50);
  CHECK(interval_calls > 50);
}
