// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/zero_set/real_roots.h>

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Integer_polynomial;
using locus::Real_root;
using locus::exact_rational;
using locus::real_roots;

namespace {

Polynomial rational(const Integer_polynomial& f) { return Polynomial(f.begin(), f.end()); }

/// A positive multiple with integer coefficients.
Integer_polynomial integral(const Polynomial& f)
{
  Integer denominator = 1;
  for (const Rational& c : f) denominator = lcm(denominator, c.get_den());
  Integer_polynomial g;
  for (const Rational& c : f) g.push_back(Rational(c * denominator).get_num());
  return g;
}

std::string show(const std::vector<Real_root>& roots)
{
  std::string text;
  for (const Real_root& r : roots)
    text += "[" + locus_test::show(r.lo) + ", " + locus_test::show(r.hi) + "]^" + std::to_string(r.multiplicity) + " ";
  return text;
}

/// What every answer must satisfy: order, strict signs at the ends, odd multiplicities where the sign changes.
std::string fault_of(const std::vector<Real_root>& roots, const Polynomial& f)
{
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const Real_root& r = roots[i];
    const int at_lo = sgn(horner(f, r.lo)), at_hi = sgn(horner(f, r.hi));
    const std::string name = "root " + std::to_string(i) + " of " + show(roots) + ": ";
    if (r.lo > r.hi || r.is_exact() != (r.lo == r.hi)) return name + "not an interval";
    if (i > 0 && (r.lo < roots[i - 1].hi || (r.lo == roots[i - 1].hi && (r.is_exact() || roots[i - 1].is_exact()))))
      return name + "not after the one before";
    if (r.multiplicity < 1) return name + "multiplicity";
    if (r.is_exact() && at_lo != 0) return name + "no zero there";
    if (!r.is_exact() && (at_lo == 0 || at_hi == 0)) return name + "an end is a root";
    if (!r.is_exact() && (at_lo != at_hi) != (r.multiplicity % 2 == 1)) return name + "sign change and multiplicity disagree";
  }
  return {};
}

/// Roots as planted, with multiplicities.
using Planted = std::vector<std::pair<Rational, int>>;

Polynomial planted(const Planted& roots, const Polynomial& other = {Rational(1)})
{
  Polynomial f = other;
  for (const auto& [x, multiplicity] : roots)
    for (int i = 0; i < multiplicity; ++i) f = times(f, {Rational(-x), Rational(1)});
  return f;
}

/// `other` must have no real roots.
void check_planted(Planted roots, const Polynomial& other, Samples& samples)
{
  std::sort(roots.begin(), roots.end());
  const Polynomial f = planted(roots, other);
  const auto found = real_roots(integral(f));
  std::string fault = fault_of(found, f);
  if (fault.empty() && found.size() != roots.size()) fault = "found " + show(found);
  for (std::size_t i = 0; fault.empty() && i < roots.size(); ++i)
    if (roots[i].first < found[i].lo || roots[i].first > found[i].hi || roots[i].second != found[i].multiplicity)
      fault = "root " + std::to_string(i) + " of " + show(found);
  samples.expect(fault.empty(), [&] {
    std::string text = fault + "\nplanted";
    for (const auto& [x, multiplicity] : roots) text += " " + locus_test::show(x) + "^" + std::to_string(multiplicity);
    return text;
  });
}

/// Counts by Sturm's theorem: one distinct root in each interval, and none elsewhere.
void check_by_sturm(const Integer_polynomial& f, Samples& samples)
{
  const Polynomial g = rational(f);
  const auto found = real_roots(f);
  const Sturm sturm(g);
  Rational bound = 1;
  for (const Rational& c : g) bound += abs(Rational(c / g.back()));
  std::string fault = fault_of(found, g);
  if (fault.empty() && static_cast<int>(found.size()) != sturm.closed(Rational(-bound), bound))
    fault = "found " + show(found) + "of " + std::to_string(sturm.closed(Rational(-bound), bound));
  for (std::size_t i = 0; fault.empty() && i < found.size(); ++i)
    if (!found[i].is_exact() && sturm.open(found[i].lo, found[i].hi) != 1) fault = "not one root in number " + std::to_string(i) + " of " + show(found);
  samples.expect(fault.empty(), [&] { return fault + "\ncoefficients " + locus_test::show(f); });
}

Integer_polynomial integers(std::initializer_list<long> c) { return Integer_polynomial(c.begin(), c.end()); }

} // namespace

// -------------------------------------------------------------------------------------------------- known roots

TEST_CASE("small polynomials whose roots everybody knows", "[real_roots]")
{
  CHECK(real_roots(integers({5})).empty());
  CHECK(real_roots(integers({-5, 0, 0})).empty());
  CHECK(real_roots(integers({1, 0, 1})).empty());
  CHECK(thrown<std::domain_error>([] { real_roots({}); }) == 1);
  CHECK(thrown<std::domain_error>([] { real_roots(integers({0, 0})); }) == 1);

  const auto line = real_roots(integers({0, 3, 0, 0})); // leading zeros do not matter
  REQUIRE(line.size() == 1u);
  CHECK((line[0].is_exact() && line[0].lo == 0 && line[0].multiplicity == 1));

  const auto units = real_roots(integers({0, 0, -1, -1, 1, 1})); // x²(x-1)(x+1)²
  REQUIRE(units.size() == 3u);
  CHECK((units[0].is_exact() && units[0].lo == -1 && units[0].multiplicity == 2));
  CHECK((units[1].is_exact() && units[1].lo == 0 && units[1].multiplicity == 2));
  CHECK((units[2].is_exact() && units[2].lo == 1 && units[2].multiplicity == 1));

  const auto root_two = real_roots(integers({-2, 0, 1}));
  REQUIRE(root_two.size() == 2u);
  CHECK((root_two[0].hi < 0 && root_two[0].hi * root_two[0].hi < 2 && root_two[0].lo * root_two[0].lo > 2));
  CHECK((root_two[1].lo > 0 && root_two[1].lo * root_two[1].lo < 2 && root_two[1].hi * root_two[1].hi > 2));
}

TEST_CASE("planted rational roots come back in order with their multiplicities", "[real_roots]")
{
  Random random(201);
  Samples samples;
  for (int i = 0; i < 600; ++i) {
    Planted roots;
    for (int k = random.between(0, 7); k > 0; --k) {
      Rational x;
      switch (random.below(8)) {
      case 0: x = random.between(-1, 1); break;
      case 1: x = Rational(random.between(-40, 40)) / 16; break; // where the search cuts
      case 2: x = random.rational() * two_to(random.between(-300, 300)); break;
      case 3: x = roots.empty() ? Rational(1, 3) : Rational(roots.back().first + two_to(-random.between(3, 70))); break;
      case 4: x = roots.empty() ? Rational(2) : Rational(1 / (roots.back().first + 3)); break;
      default: x = random.rational();
      }
      x.canonicalize();
      const bool is_new = std::none_of(roots.begin(), roots.end(), [&](const auto& r) { return r.first == x; });
      if (is_new) roots.emplace_back(x, random.chance(65) ? 1 : random.between(2, 4));
    }
    Polynomial other{Rational(random.chance(50) ? 1 : -7)};
    if (random.chance(40)) other = times(other, {Rational(random.between(1, 5)), Rational(-1), Rational(random.between(1, 9))});
    if (random.chance(15)) other = times(other, times(other, {Rational(5), Rational(3), Rational(1)}));
    check_planted(roots, other, samples);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 600);
}

TEST_CASE("huge and tiny roots together", "[real_roots]")
{
  Samples samples;
  for (const int e : {10, 60, 400, 1100})
    for (const int m : {1, 2, 3})
      check_planted({{two_to(e), 1}, {two_to(-e), m}, {Rational(-two_to(e) / 3), m}, {Rational(-two_to(-e) / 3), 1}, {Rational(1), 1}, {Rational(0), m}},
                    {Rational(3), Rational(0), two_to(e)}, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 12);
}

TEST_CASE("roots 2^-60 apart, anywhere on the line", "[real_roots]")
{
  Samples samples;
  const Rational tiny = two_to(-60);
  for (const Rational& x : {Rational(0), Rational(1), Rational(-1), Rational(1, 2), Rational(-1, 2), Rational(2), Rational(1, 3), Rational(-22, 7), Rational(7, 16), Rational(1000003)})
    for (const int m : {1, 2, 3}) {
      check_planted({{x, 1}, {Rational(x + tiny), m}}, {Rational(1)}, samples);
      check_planted({{x, m}, {Rational(x - tiny), 1}, {Rational(x + tiny), 1}}, {Rational(-2), Rational(1), Rational(-1)}, samples);
      check_planted({{Rational(x + tiny / 2), m}, {Rational(x - tiny / 2), m}, {Rational(x + tiny / 3), 1}, {Rational(x - tiny / 3), 1}}, {Rational(1)}, samples);
    }
  LOCUS_REQUIRE_SAMPLES(samples, 90);
}

TEST_CASE("roots at all places where a part may be cut, and others close to them", "[real_roots]")
{
  Samples samples;
  for (const int e : {8, 30, 70, 200}) {
    Planted roots;
    for (const int k : {8, 7, 9, 6}) {
      roots.emplace_back(Rational(k, 16), 1);
      roots.back().first.canonicalize();
      roots.emplace_back(Rational(roots.back().first + two_to(-e)), 1);
    }
    check_planted(roots, {Rational(1)}, samples);
    for (auto& r : roots) r.first = -1 / r.first;
    roots[0].second = 2;
    check_planted(roots, {Rational(1)}, samples);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 8);
}

TEST_CASE("degrees whose binomial coefficients overflow doubles", "[real_roots]")
{
  Integer_polynomial f(1031);
  f[0] = -2;
  f[1030] = 1;
  const auto roots = real_roots(f);
  CHECK(fault_of(roots, rational(f)) == "");
  REQUIRE(roots.size() == 2u);
  CHECK((roots[1].lo < exact_rational(1.000674) && exact_rational(1.000673) < roots[1].hi)); // 2^(1/1030)
}

TEST_CASE("irrational multiple roots are counted as often as they divide", "[real_roots]")
{
  const Polynomial two{Rational(-2), Rational(0), Rational(1)}, three{Rational(-3), Rational(0), Rational(1)}, golden{Rational(-1), Rational(-1), Rational(1)};
  const Polynomial f = times(times(times(two, two), times(three, times(three, three))), times(golden, {Rational(-7), Rational(1)}));
  const auto roots = real_roots(integral(f));
  CHECK(fault_of(roots, f) == "");
  std::vector<int> multiplicities;
  for (const Real_root& r : roots) multiplicities.push_back(r.multiplicity);
  CHECK(multiplicities == std::vector<int>{3, 2, 1, 2, 1, 3, 1}); // -√3, -√2, (1-√5)/2, √2, (1+√5)/2, √3, 7
  for (const std::size_t k : {1u, 3u}) CHECK((roots[k].lo * roots[k].lo - 2) * (roots[k].hi * roots[k].hi - 2) < 0);
}

TEST_CASE("Chebyshev's and Wilkinson's polynomials up to degree 60", "[real_roots]")
{
  Samples samples;
  Polynomial before{Rational(1)}, current{Rational(0), Rational(1)};
  for (int n = 1; n <= 60; ++n) {
    const auto roots = real_roots(integral(current));
    std::string fault = fault_of(roots, current);
    if (roots.size() != static_cast<std::size_t>(n)) fault = std::to_string(roots.size()) + " roots";
    for (std::size_t k = 0; fault.empty() && k < roots.size(); ++k) {
      const double x = -std::cos((2.0 * static_cast<double>(k) + 1) * 3.14159265358979323846 / (2 * n));
      if (roots[k].multiplicity != 1 || x < roots[k].lo.get_d() - 1e-12 || x > roots[k].hi.get_d() + 1e-12) fault = "root " + std::to_string(k);
    }
    samples.expect(fault.empty(), [&] { return "degree " + std::to_string(n) + ": " + fault; });
    Polynomial next = times({Rational(0), Rational(2)}, current);
    for (std::size_t k = 0; k < before.size(); ++k) next[k] -= before[k];
    before = std::move(current);
    current = std::move(next);
  }
  for (const int n : {20, 40, 60}) {
    Planted roots;
    for (int k = 1; k <= n; ++k) roots.emplace_back(Rational(k), 1);
    check_planted(roots, {Rational(1)}, samples);
    for (auto& r : roots) r.first /= n + 1;
    check_planted(roots, {Rational(1)}, samples);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 66);
}

// ---------------------------------------------------------------------------------- random polynomials, Sturm

TEST_CASE("random polynomials have as many roots as Sturm's theorem says", "[real_roots]")
{
  Random random(202);
  Samples samples;
  const auto random_polynomial = [&](int n, int bits) {
    Integer_polynomial f;
    for (int i = 0; i <= n; ++i) f.push_back(random.chance(15) ? Integer(0) : random.integer(bits));
    if (f.back() == 0) f.back() = 1;
    return f;
  };
  for (int i = 0; i < 500; ++i) check_by_sturm(random_polynomial(random.between(1, 12), random.chance(60) ? 3 : random.between(1, 100)), samples);
  for (int i = 0; i < 40; ++i) {
    const auto f = random_polynomial(random.between(1, 4), 3), g = random_polynomial(random.between(1, 4), 3);
    check_by_sturm(locus::multiply(locus::multiply(f, f), g), samples);
  }
  for (const int n : {20, 30, 45, 60}) check_by_sturm(random_polynomial(n, 20), samples);
  LOCUS_REQUIRE_SAMPLES(samples, 500);
}

TEST_CASE("mirroring and inverting the line mirrors and inverts the roots", "[real_roots]")
{
  Random random(203);
  Samples samples;
  for (int i = 0; i < 200; ++i) {
    Integer_polynomial f;
    for (int k = random.between(1, 20); k >= 0; --k) f.push_back(random.integer(random.between(1, 20)));
    if (f.back() == 0 || f.front() == 0) continue;
    Integer_polynomial mirrored = f, inverted(f.rbegin(), f.rend());
    for (std::size_t k = 1; k < f.size(); k += 2) mirrored[k] = -mirrored[k];
    const auto roots = real_roots(f), minus = real_roots(mirrored), inverse = real_roots(inverted);
    bool right = roots.size() == minus.size() && roots.size() == inverse.size();
    for (std::size_t k = 0; right && k < roots.size(); ++k) {
      const Real_root& m = minus[roots.size() - 1 - k];
      right = roots[k].multiplicity == m.multiplicity && -m.hi <= roots[k].hi && roots[k].lo <= -m.lo;
    }
    samples.expect(right, [&] { return locus_test::show(f) + ": " + show(roots) + "but " + show(minus) + "and " + show(inverse); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 150);
}

TEST_CASE("the roots are found in every rounding mode", "[real_roots]")
{
  Samples samples;
  for (const int mode : rounding_modes)
    in_mode(mode, [&] {
      check_planted({{Rational(1, 3), 1}, {Rational(1, 7), 2}, {Rational(-5, 3), 1}, {Rational(1, 3) + two_to(-50), 1}}, {Rational(1)}, samples);
      check_by_sturm(integers({-1, 3, 5, -17, -4, 9, 2, -1}), samples);
      Planted many;
      for (int k = 1; k < 24; ++k) many.emplace_back(Rational(k, 25), 1);
      for (auto& r : many) r.first.canonicalize();
      check_planted(many, {Rational(1)}, samples);
    });
  LOCUS_REQUIRE_SAMPLES(samples, 12);
}

// -------------------------------------------------------------------------------------------- what it stands on

TEST_CASE("strict signs of the coefficients in doubles and in many words are right after any cuts", "[real_roots]")
{
  Random random(204);
  Samples samples;
  std::size_t strict = 0;
  for (int i = 0; i < 300; ++i) {
    const int n = random.between(1, 12);
    std::vector<Integer> values;
    for (int k = 0; k <= n; ++k) values.push_back(random.chance(20) ? Integer(0) : random.integer(random.between(1, 300)));
    const auto words = static_cast<std::size_t>(random.between(1, 6));
    locus::detail::Wide_coefficients wide(values, words);
    Bernstein<Rational, 1> exact(Degrees<1>{n}, std::vector<Rational>(values.begin(), values.end()));
    const auto rounded = locus::detail::rounded(Bernstein<Integer, 1>(Degrees<1>{n}, values));
    locus::detail::Bounded_coefficients bounded(rounded.values().data(), n, rounded.error());
    std::size_t slot = 0;
    for (int cut = 0; cut < 8; ++cut) {
      const int sixteenths = random.chance(50) ? 8 : random.between(6, 9);
      wide.split(slot, 2 * static_cast<std::size_t>(cut) + 1, sixteenths);
      bounded.split(slot, 2 * static_cast<std::size_t>(cut) + 1, sixteenths);
      const auto parts = locus::split(exact, 0, Rational(Rational(sixteenths) / 16));
      const bool high = random.chance(50);
      exact = high ? parts.second : parts.first;
      slot = 2 * static_cast<std::size_t>(cut) + (high ? 2 : 1);
      for (std::size_t k = 0; k < exact.size(); ++k)
        for (const Sign s : {wide.sign(slot, k), bounded.sign(slot, k)}) {
          samples.expect(!locus::is_certain(s) || s == locus::sign_of(exact[k]), [&] { return "coefficient " + std::to_string(k) + " after " + std::to_string(cut + 1) + " cuts, " + std::to_string(words) + " words"; });
          strict += locus::is_strict(s);
        }
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 20000);
  CHECK(strict > samples.count() / 2); // and they do not hide behind "unknown"
}

TEST_CASE("products by way of long integers are the products", "[real_roots]")
{
  Random random(205);
  Samples samples;
  for (int i = 0; i < 400; ++i) {
    Integer_polynomial f, g;
    for (int k = random.between(0, 9); k > 0; --k) f.push_back(random.chance(20) ? Integer(0) : random.integer(random.between(1, 200)));
    for (int k = random.between(0, 9); k > 0; --k) g.push_back(random.chance(20) ? Integer(0) : random.chance(20) ? Integer(Integer(1) << 63) : random.integer(random.between(1, 200)));
    while (!f.empty() && f.back() == 0) f.pop_back();
    while (!g.empty() && g.back() == 0) g.pop_back();
    samples.expect(rational(locus::multiply(f, g)) == times(rational(f), rational(g)), [&] { return locus_test::show(f) + " times " + locus_test::show(g); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
}

TEST_CASE("values with a common factor that the polynomials do not have deceive neither gcd nor division", "[real_roots]")
{
  // At 2^64, x² + 1 is Fermat's number F7, which 59649589127497217 divides; and so it does this linear polynomial's value.
  const Integer_polynomial fermat = integers({1, 0, 1}), linear = integers({-208648999, 126945596}), common = integers({-777777, 1048575, 987654});
  CHECK(locus::gcd(locus::multiply(common, fermat), locus::multiply(common, linear)) == locus::gcd(common, {}));
  // Here the whole value of the linear polynomial divides that of the other.
  const Integer_polynomial multiple = locus::multiply(fermat, integers({11369833396, 1}));
  CHECK(thrown<std::domain_error>([&] { locus::exact_quotient(multiple, linear); }) == 1);
  CHECK(locus::gcd(multiple, linear) == integers({1}));
}
