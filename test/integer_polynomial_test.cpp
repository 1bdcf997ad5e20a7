// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/function/integer_polynomial.h>

#include <catch2/catch.hpp>

#include <set>

using namespace locus_test;
using locus::Integer_polynomial;

namespace {

Polynomial rational(const Integer_polynomial& f) { return Polynomial(f.begin(), f.end()); }

/// A prime of the size that the library's modular test uses; multiples of it as coefficients must not mislead it.
const Integer prime(std::to_string(locus::detail::small_prime));

Integer random_coefficient(Random& random)
{
  switch (random.below(8)) {
  case 0:
    return 0;
  case 1:
    return Integer(prime * random.between(-2, 2));
  case 2:
    return random.integer(90);
  case 3:
    return Integer(prime * random.integer(40) + 1);
  default:
    return Integer(random.between(-9, 9));
  }
}

/// A polynomial of this degree; its leading coefficient is not zero, of either sign.
Integer_polynomial random_polynomial(Random& random, int n)
{
  Integer_polynomial f;
  for (int i = 0; i <= n; ++i) f.push_back(random_coefficient(random));
  while (f.back() == 0) f.back() = random_coefficient(random);
  return f;
}

Integer_polynomial product(const Integer_polynomial& f, const Integer_polynomial& g)
{
  Integer_polynomial h(f.empty() || g.empty() ? 0 : f.size() + g.size() - 1, Integer(0));
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) h[i + j] += f[i] * g[j];
  return h;
}

Integer_polynomial repeated_product(const Integer_polynomial& f, int times)
{
  Integer_polynomial p{Integer(1)};
  for (int i = 0; i < times; ++i) p = product(p, f);
  return p;
}

Integer common_divisor(const Integer_polynomial& f)
{
  Integer g = 0;
  for (const Integer& c : f) g = gcd(g, c);
  return g;
}

bool is_primitive_and_positive(const Integer_polynomial& f)
{
  return !f.empty() && f.back() > 0 && common_divisor(f) == 1;
}

/// Whether a and b are equal up to a positive rational factor.
bool is_positive_multiple(const Integer_polynomial& a, const Integer_polynomial& b)
{
  if (a.size() != b.size() || a.empty()) return a.size() == b.size();
  if (sgn(a.back()) != sgn(b.back())) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] * b.back() != b[i] * a.back()) return false;
  return true;
}

} // namespace

TEST_CASE("primitive parts and contents", "[integer_polynomial]")
{
  Random random(61);
  Samples samples;
  for (int i = 0; i < 400; ++i) {
    const auto f = random_polynomial(random, random.below(7));
    const auto p = locus::detail::primitive_part(f);
    const Integer c = locus::detail::content(f);
    samples.expect(is_primitive_and_positive(p) && c > 0 && c == common_divisor(f), [&] { return show(f); });
    Integer_polynomial again = p;
    for (Integer& x : again) x *= f.back() < 0 ? Integer(-c) : c;
    samples.expect(again == f, [&] { return show(f); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 800);
  CHECK(locus::detail::primitive_part({Integer(0), Integer(0)}).empty());
  CHECK(locus::detail::primitive_part({Integer(0), Integer(-6), Integer(0)}) ==
        Integer_polynomial{Integer(0), Integer(1)});
  CHECK(locus::degree(Integer_polynomial{}) == -1);
  CHECK(locus::degree({Integer(5)}) == 0);
  CHECK(locus::derivative(Integer_polynomial{}).empty());
  CHECK(locus::derivative({Integer(5)}).empty());
}

TEST_CASE("derivatives agree with the rational ones", "[integer_polynomial]")
{
  Random random(62);
  Samples samples;
  for (int i = 0; i < 200; ++i) {
    const auto f = random_polynomial(random, random.below(12));
    samples.expect(rational(locus::derivative(f)) == slope(rational(f)), [&] { return show(f); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("the gcd is the planted one and the one of Euclid's algorithm in rationals", "[integer_polynomial]")
{
  Random random(63);
  Samples samples;
  int coprime = 0, common = 0;
  for (int i = 0; i < 500; ++i) {
    const auto h = random_polynomial(random, random.below(5)), a = random_polynomial(random, random.below(6)),
               b = random.chance(10) ? a : random_polynomial(random, random.below(6));
    const auto f = product(h, a), g = product(h, b);
    const auto d = locus::gcd(f, g);
    const auto describe = [&] { return show(f) + " and " + show(g) + " give " + show(d); };
    const Polynomial expected = euclid(rational(f), rational(g));
    samples.expect(monic(rational(d)) == expected, describe);
    samples.expect(is_primitive_and_positive(d), describe);
    samples.expect(remainder(rational(d), rational(h)).empty(), describe); // the planted factor is in it
    samples.expect(locus::gcd(g, f) == d, describe);
    (locus::degree(d) > 0 ? common : coprime)++;
  }
  LOCUS_REQUIRE_SAMPLES(samples, 2000);
  CHECK(coprime > 50);
  CHECK(common > 200);
}

TEST_CASE("the gcd with zero and with constants", "[integer_polynomial]")
{
  const Integer_polynomial zero, zero_with_zeros{Integer(0), Integer(0)}, f{Integer(-4), Integer(0), Integer(-6)},
    primitive{Integer(2), Integer(0), Integer(3)};
  CHECK(locus::gcd(zero, zero).empty());
  CHECK(locus::gcd(f, zero) == primitive);
  CHECK(locus::gcd(zero_with_zeros, f) == primitive);
  CHECK(locus::gcd({Integer(6)}, {Integer(-4)}) == Integer_polynomial{Integer(1)});
  CHECK(locus::gcd({Integer(6)}, f) == Integer_polynomial{Integer(1)});
}

TEST_CASE("the modular test never calls polynomials with a common factor coprime", "[integer_polynomial]")
{
  const Integer p = prime;
  const Integer_polynomial one{Integer(1)}, vanishing_lead{Integer(1), p}; // 1 + p·x is constant modulo p
  const Integer_polynomial a{Integer(2), Integer(1)}, b{Integer(3), Integer(1)};
  CHECK_FALSE(locus::detail::certainly_coprime(product(vanishing_lead, a), product(vanishing_lead, b)));
  CHECK(locus::gcd(product(vanishing_lead, a), product(vanishing_lead, b)) == vanishing_lead);
  CHECK(locus::gcd(vanishing_lead, product(vanishing_lead, b)) == vanishing_lead);
  // x and x+p have a common root modulo p only: not certain, and the exact answer is one.
  const Integer_polynomial x{Integer(0), Integer(1)}, x_plus_p{p, Integer(1)};
  CHECK_FALSE(locus::detail::certainly_coprime(x, x_plus_p));
  CHECK(locus::gcd(x, x_plus_p) == one);
  CHECK(locus::gcd(product(x, a), product(x_plus_p, a)) == a);
  // The usual case is answered by it.
  CHECK(locus::detail::certainly_coprime(product(a, a), product(b, b)));
  CHECK(locus::detail::certainly_coprime({Integer(7)}, b));
  CHECK_FALSE(locus::detail::certainly_coprime(product(a, b), product(b, b)));
  // Inverses modulo the prime.
  Random random(64);
  Samples samples;
  for (int i = 0; i < 200; ++i) {
    const std::uint64_t r = random.bits() % (locus::detail::small_prime - 1) + 1;
    samples.expect(r * locus::detail::inverse_mod(r) % locus::detail::small_prime == 1,
                   [&] { return std::to_string(r); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
  CHECK(mpz_probab_prime_p(p.get_mpz_t(), 30) != 0);
}

TEST_CASE("a common divisor that only the values at a power of two have does not mislead the gcd",
          "[integer_polynomial]")
{
  // Found by lattice reduction: small, coprime, and at 2^64 both divisible by a prime near 2^70.
  const Integer_polynomial a{Integer(7848439), Integer(-1431028), Integer(815075)};
  const Integer_polynomial b{Integer(5112533), Integer(10049018), Integer(2790188)};
  const Rational at = two_to(64), shared(Integer("871709100316485385309"));
  REQUIRE(Rational(horner(rational(a), at) / shared).get_den() == 1);
  REQUIRE(Rational(horner(rational(b), at) / shared).get_den() == 1);
  const Integer_polynomial h{Integer(987654321), Integer(1000000007)};
  CHECK(locus::gcd(product(h, a), product(h, b)) == h);
  CHECK(locus::gcd(a, b) == Integer_polynomial{Integer(1)});
}

TEST_CASE("products whose coefficients fill their machine words are right", "[integer_polynomial]")
{
  Samples samples;
  for (const unsigned words : {1u, 2u, 3u})
    for (unsigned bits = 1; bits < 64 * words; bits += 5)
      for (int more = -4; more <= 2; ++more)
        for (const std::size_t terms : {1u, 2u, 3u, 7u, 8u, 9u}) {
          const int other = static_cast<int>(64 * words) - static_cast<int>(bits) + more;
          if (other < 1) continue;
          Integer_polynomial f(terms, Integer((Integer(1) << bits) - 1));
          Integer_polynomial g(8, Integer((Integer(1) << static_cast<unsigned>(other)) - 1));
          for (const int sign : {1, -1}) {
            if (sign < 0)
              for (Integer& c : g) c = -c;
            samples.expect(locus::multiply(f, g) == product(f, g), [&] { return show(f) + " times " + show(g); });
          }
          f.back() = 1; // alternating carries
          g.front() = -1;
          samples.expect(locus::multiply(f, g) == product(f, g), [&] { return show(f) + " times " + show(g); });
        }
  LOCUS_REQUIRE_SAMPLES(samples, 8000);
}

TEST_CASE("products agree with the schoolbook", "[integer_polynomial]")
{
  Random random(69);
  Samples samples;
  for (int i = 0; i < 400; ++i) {
    auto f = random_polynomial(random, random.below(9)), g = random_polynomial(random, random.below(9));
    if (random.chance(30)) // coefficients of one word's size and its neighbours, where packing could carry
      for (Integer& c : f)
        c = Integer(Integer(random.between(-1, 1)) << static_cast<unsigned>(random.between(62, 66))) +
            random.between(-1, 1);
    if (f.back() == 0) f.back() = -1;
    samples.expect(locus::multiply(f, g) == product(f, g), [&] { return show(f) + " times " + show(g); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  CHECK(locus::multiply(Integer_polynomial{}, {Integer(1)}).empty());
}

TEST_CASE("exact quotients undo products, with the right sign, and refuse other divisors", "[integer_polynomial]")
{
  Random random(65);
  Samples samples;
  for (int i = 0; i < 400; ++i) {
    const auto f = random_polynomial(random, random.below(7)), g = random_polynomial(random, random.below(5));
    const auto h = product(f, g);
    const auto q = locus::exact_quotient(h, g);
    const auto describe = [&] { return show(h) + " by " + show(g) + " gives " + show(q); };
    samples.expect(is_positive_multiple(q, f), describe);
    samples.expect(common_divisor(q) == 1, describe);
    // Division over the rationals: g times a constant divides as well.
    const Integer constant = random.between(2, 9);
    auto multiple = g;
    for (Integer& c : multiple) c *= Integer(-constant);
    const auto opposite = locus::exact_quotient(h, multiple);
    auto negated = q;
    for (Integer& c : negated) c = -c;
    samples.expect(opposite == negated, describe);
    if (locus::degree(g) > 0) {
      auto spoilt = h;
      spoilt[0] += 1; // a constant, which g does not divide
      samples.expect(thrown<std::domain_error>([&] { locus::exact_quotient(spoilt, g); }) == 1, describe);
      if (locus::degree(g) > 1)
        samples.expect(
          thrown<std::domain_error>([&] { locus::exact_quotient(Integer_polynomial(g.begin() + 1, g.end()), g); }) == 1,
          describe);
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1500);
}

TEST_CASE("square-free decomposition finds the planted factors with their multiplicities", "[integer_polynomial]")
{
  Random random(66);
  Samples samples;
  std::set<int> seen;
  for (int i = 0; i < 150; ++i) {
    // Distinct linear and irreducible quadratic factors, some of them with rational and huge roots.
    std::vector<std::pair<Integer_polynomial, int>> planted;
    std::set<std::string> used;
    for (int k = random.between(1, 5); k > 0; --k) {
      Integer_polynomial factor;
      if (random.chance(65)) {
        factor = {random.chance(15) ? random.integer(70) : Integer(random.between(-5, 5)),
                  Integer(random.chance(10) ? prime : Integer(random.between(1, 3)))};
      } else {
        factor = {Integer(random.between(1, 4)), Integer(random.between(-1, 1)),
                  Integer(random.between(1, 3))}; // discriminant ≤ 1-4
      }
      const Integer common = common_divisor(factor);
      for (Integer& c : factor) c /= common;
      if (used.insert(show(factor)).second) planted.emplace_back(factor, random.chance(40) ? 1 : random.between(1, 5));
    }
    Integer_polynomial f{Integer(random.chance(50) ? 6 : -35)};
    for (const auto& [factor, multiplicity] : planted) f = product(f, repeated_product(factor, multiplicity));
    const auto parts = locus::square_free_decomposition(f);
    const auto describe = [&] { return show(f); };

    // The factors of each multiplicity, multiplied together.
    std::vector<Integer_polynomial> expected(6, Integer_polynomial{Integer(1)});
    for (const auto& [factor, multiplicity] : planted) {
      auto& e = expected[static_cast<std::size_t>(multiplicity)];
      e = product(e, factor);
      seen.insert(multiplicity);
    }
    std::size_t nontrivial = 0;
    for (const auto& e : expected) nontrivial += e.size() > 1;
    bool right = parts.size() == nontrivial;
    Integer_polynomial together{Integer(1)};
    for (std::size_t k = 0; right && k < parts.size(); ++k) {
      const auto m = static_cast<std::size_t>(parts[k].multiplicity);
      right = m >= 1 && m < expected.size() && is_positive_multiple(parts[k].factor, expected[m]) &&
              (k == 0 || parts[k - 1].multiplicity < parts[k].multiplicity);
      together = product(together, repeated_product(parts[k].factor, parts[k].multiplicity));
      // Square-free by another algorithm too.
      right = right && euclid(rational(parts[k].factor), slope(rational(parts[k].factor))).size() == 1;
    }
    samples.expect(right, describe);
    auto positive = f;
    if (positive.back() < 0)
      for (Integer& c : positive) c = -c;
    samples.expect(is_positive_multiple(together, positive), describe);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 300);
  CHECK(seen.size() == 5u);
  CHECK(locus::square_free_decomposition({}).empty());
  CHECK(locus::square_free_decomposition({Integer(7)}).empty());
  CHECK(locus::square_free_decomposition({Integer(0), Integer(0)}).empty());
}

TEST_CASE("random polynomials are square-free or share a factor with their derivative", "[integer_polynomial]")
{
  Random random(67);
  Samples samples;
  for (int i = 0; i < 150; ++i) {
    const auto f = random_polynomial(random, random.between(1, 9));
    const auto parts = locus::square_free_decomposition(f);
    int degree = 0;
    for (const auto& part : parts) degree += part.multiplicity * locus::degree(part.factor);
    const bool square_free = euclid(rational(f), slope(rational(f))).size() == 1;
    samples.expect(degree == locus::degree(f) && square_free == (parts.size() == 1 && parts[0].multiplicity == 1),
                   [&] { return show(f); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 150);
}

TEST_CASE("the monomial and the Bernstein form are the same polynomial", "[integer_polynomial]")
{
  Random random(68);
  Samples samples;
  for (int i = 0; i < 200; ++i) {
    const auto a = random_polynomial(random, random.below(13));
    const auto f = locus::bernstein_form(a);
    const Rational u = random.chance(30) ? random.rational() : random.unit_rational();
    const auto describe = [&] { return show(a) + " at " + show(u); };
    samples.expect(f.degree() == locus::degree(a) && plain_value(f.rational(), {u}) == horner(rational(a), u),
                   describe);
    samples.expect(f.rational().coefficients() == bernstein_on_unit(rational(a), locus::degree(a)).coefficients(),
                   describe);
    samples.expect(is_positive_multiple(locus::monomial_form(f), a), describe);
    // Written with a higher degree and another scale it is still the same.
    const auto raised = locus::elevate(f, 0, random.between(1, 3));
    const auto back = locus::monomial_form(raised);
    samples.expect(is_positive_multiple(back, a) && common_divisor(back) == 1, describe);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 800);
  const auto zero = locus::bernstein_form({});
  CHECK(zero.degree() == 0);
  CHECK(zero.is_zero());
  CHECK(locus::monomial_form(zero).empty());
  CHECK(locus::monomial_form(locus::elevate(zero, 0, 3)).empty());
}
