// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/zero_set/critical_points.h>

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Algebraic_extension;
using locus::Bivariate_polynomial;
using locus::Common_zeros;
using locus::Integer_polynomial;
using locus::Sign;
using locus::with_upward_rounding;

namespace {

Integer_polynomial random_polynomial(Random& random, int degree, int size)
{
  Integer_polynomial f;
  for (int i = 0; i <= degree; ++i) f.push_back(Integer(random.between(-size, size)));
  while (!f.empty() && f.back() == 0) f.pop_back();
  return f;
}

Bivariate_polynomial random_bivariate(Random& random, int n, int m)
{
  Bivariate_polynomial f;
  for (int j = 0; j <= m; ++j) f.row.push_back(random_polynomial(random, n, 1000));
  f.trim();
  return f;
}

Rational value(const Integer_polynomial& f, const Rational& x)
{
  Rational v = 0;
  for (std::size_t i = f.size(); i-- > 0;) v = v * x + f[i];
  return v;
}

/// The resultant at one x by Sylvester's determinant in rationals.
Rational sylvester(const Bivariate_polynomial& f, const Bivariate_polynomial& g, const Rational& x)
{
  const std::size_t n = f.row.size() - 1, m = g.row.size() - 1, size = n + m;
  std::vector<std::vector<Rational>> a(size, std::vector<Rational>(size));
  for (std::size_t r = 0; r < m; ++r)
    for (std::size_t j = 0; j <= n; ++j) a[r][r + j] = value(f.row[n - j], x);
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t j = 0; j <= m; ++j) a[m + r][r + j] = value(g.row[m - j], x);
  Rational determinant = 1;
  for (std::size_t c = 0; c < size; ++c) {
    std::size_t p = c;
    while (p < size && a[p][c] == 0) ++p;
    if (p == size) return 0;
    if (p != c) {
      std::swap(a[p], a[c]);
      determinant = -determinant;
    }
    determinant *= a[c][c];
    for (std::size_t r = c + 1; r < size; ++r) {
      const Rational factor = a[r][c] / a[c][c];
      for (std::size_t k = c; k < size; ++k) a[r][k] -= factor * a[c][k];
    }
  }
  return determinant;
}

locus::Bernstein<locus::Scaled_integer, 2> form_of(const std::vector<std::vector<Rational>>& c) // c[i][j] x^i y^j
{
  const int n = static_cast<int>(c.size()) - 1;
  int m = 0;
  for (const auto& row : c) m = std::max(m, static_cast<int>(row.size()) - 1);
  locus::Bernstein<Rational, 2> f(locus::Degrees<2>{n, m});
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
      for (int k = 0; k <= i; ++k)
        for (int l = 0; l <= j && l < static_cast<int>(c[static_cast<std::size_t>(k)].size()); ++l)
          f.at({i, j}) += c[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)] * Rational(choose(i, k) * choose(j, l)) / Rational(choose(n, k) * choose(m, l));
  return locus::Bernstein<locus::Scaled_integer, 2>(f);
}

std::array<std::array<Rational, 2>, 2> box(const Rational& lo, const Rational& hi)
{
  return {std::array<Rational, 2>{lo, hi}, std::array<Rational, 2>{lo, hi}};
}

} // namespace

TEST_CASE("resultants are Sylvester's determinants", "[elimination]")
{
  Random random(401);
  Samples samples;
  for (int k = 0; k < 60; ++k) {
    const int n = random.between(0, 4), m = random.between(1, 4), p = random.between(0, 4), q = random.between(1, 4);
    const Bivariate_polynomial f = random_bivariate(random, n, m), g = random_bivariate(random, p, q);
    if (f.is_zero() || g.is_zero()) continue;
    const Integer_polynomial r = resultant_y(f, g);
    for (const int x : {-3, 0, 1, 7}) samples.expect(value(r, x) == sylvester(f, g, x), [&] { return "at " + std::to_string(x) + ", case " + std::to_string(k); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
  // Large coefficients need many primes; a common factor makes it zero.
  Bivariate_polynomial f, g;
  f.row = {{Integer("123456789012345678901234567890"), 1}, {Integer("-98765432109876543210")}, {1}};
  g.row = {{7, Integer("1000000000000000000000000")}, {Integer("31415926535897932384626433"), 5}};
  CHECK(value(resultant_y(f, g), Rational(2, 3)) == sylvester(f, g, Rational(2, 3)));
  f.row = {{0, 0, -1}, {}, {1}}; // y² - x²
  g.row = {{0, -1, -1}, {1, 1}}; // (y - x)(1 + x)
  CHECK(resultant_y(f, g).empty());
  CHECK(resultant_y({}, g).empty());
}

TEST_CASE("numbers over an algebraic number", "[elimination]")
{
  // m = (x² - 2)(x² - 3) with α = √2: a zero test must find the factor.
  const Integer_polynomial m{6, 0, -5, 0, 1};
  Algebraic_extension field(m, Rational(1), Rational(3, 2));
  CHECK(field.is_zero(field.element({-2, 0, 1})));
  CHECK(locus::degree(field.modulus()) == 2);
  CHECK_FALSE(field.is_zero(field.element({-3, 0, 1})));
  CHECK(field.sign(field.element({-1414213562, 1000000000})) == Sign::positive);
  CHECK(field.sign(field.element({-1414213563, 1000000000})) == Sign::negative);
  const auto a = field.element({3, 1});
  CHECK(field.multiply(a, field.inverse(a)) == Algebraic_extension::Element{Rational(1)});
  // gcd of (y - α)(y - 1) and (y - α)(y + 5) above α.
  const auto element = [&](int c0, int c1) { return field.element({Integer(c0), Integer(c1)}); };
  const locus::Extension_polynomial f{element(0, 1), element(-1, -1), element(1, 0)}, g{element(0, -5), element(5, -1), element(1, 0)};
  const auto h = gcd(f, g, field);
  REQUIRE(h.size() == 2u);
  CHECK(h[0] == element(0, -1));
  CHECK(sign_at(h, Rational(1), field) == Sign::negative);
  CHECK(sign_at(h, Rational(2), field) == Sign::positive);
  Algebraic_extension rational(Integer_polynomial{-1, 3}, Rational(0), Rational(1)); // 1/3
  CHECK(rational.lo() == Rational(1, 3));
  CHECK(rational.hi() == Rational(1, 3));
}

TEST_CASE("common zeros are found with what proves them", "[elimination]")
{
  // (x² - 1/2)² + (y² - 1/3)²: all zeros of the gradient on it are at (±1/√2, ±1/√3).
  const auto f = form_of({{Rational(13, 36), 0, Rational(-2, 3), 0, 1}, {}, {-1}, {}, {1}});
  const Common_zeros zeros({derivative(f, 0), derivative(f, 1), f});
  REQUIRE(zeros.is_finite());
  const auto found = zeros.in(box(-2, 2), box(-3, 3));
  REQUIRE(found.size() == 4u);
  for (const auto& zero : found) {
    for (std::size_t v = 0; v < 2; ++v) {
      const Rational square = v == 0 ? Rational(1, 2) : Rational(1, 3);
      const Rational lo = zero.at[v][0] * zero.at[v][0] - square, hi = zero.at[v][1] * zero.at[v][1] - square;
      CHECK(lo * hi < 0);
      CHECK(zero.at[v][1] - zero.at[v][0] < two_to(-50));
    }
    REQUIRE(zero.evidence);
    CHECK(zero.evidence->m == Integer_polynomial{-1, 0, 2});
    CHECK(zero.evidence->h.size() == 3u);
  }
  const auto quarter = zeros.in(box(0, 1), box(0, 1));
  CHECK(quarter.size() == 1u);
  // No zero where the third polynomial is only nearly zero.
  const auto near = form_of({{Rational(Rational(13, 36) + two_to(-90)), 0, Rational(-2, 3), 0, 1}, {}, {-1}, {}, {1}});
  CHECK(Common_zeros({derivative(near, 0), derivative(near, 1), near}).in(box(0, 1), box(0, 1)).empty());
  CHECK_FALSE(Common_zeros({f, f}).is_finite());
}

TEST_CASE("the index of a gradient", "[elimination]")
{
  const Rational h(1, 2);
  locus::Box<2> around;
  around.lo = {0.25, 0.25};
  around.hi = {0.875, 0.75};
  // (x - 1/2)^n ± (y - 1/2)^m by binomials.
  const auto power_sum = [&](int n, int m, int sign) {
    std::vector<std::vector<Rational>> c(static_cast<std::size_t>(n) + 1, std::vector<Rational>(static_cast<std::size_t>(m) + 1));
    for (int i = 0; i <= n; ++i) c[static_cast<std::size_t>(i)][0] += Rational(choose(n, i)) * power(Rational(-h), n - i);
    for (int j = 0; j <= m; ++j) c[0][static_cast<std::size_t>(j)] += sign * Rational(choose(m, j)) * power(Rational(-h), m - j);
    return form_of(c);
  };
  const auto index = [&](const auto& f) { return locus::gradient_index(derivative(f, 0), derivative(f, 1), around); };
  CHECK(index(power_sum(2, 2, 1)) == 1);
  CHECK(index(power_sum(2, 2, -1)) == -1);
  CHECK(index(power_sum(3, 2, 1)) == 0);
  CHECK(index(power_sum(2, 3, -1)) == 0);
  CHECK(index(power_sum(4, 2, 1)) == 1);
  CHECK(index(power_sum(2, 4, -1)) == -1);
  CHECK(index(power_sum(3, 3, 1)) == 0);
  CHECK(index(power_sum(1, 2, 1)) == 0);
  // x³ - 3xy² about (1/2, 1/2): three lines, index -2.
  CHECK(index(form_of({{Rational(1, 4), Rational(-3, 2), Rational(3, 2)}, {0, 3, -3}, {Rational(-3, 2)}, {1}})) == -2);
}

TEST_CASE("factoring leaves the rounding mode alone, and needs none", "[elimination]")
{
  // Swinnerton-Dyer polynomials have no factor of degree above two modulo any prime: lattices have to tell.
  const Integer_polynomial hard{46225, 0, -5596840, 0, 13950764, 0, -7453176, 0, 1513334, 0, -141912, 0, 6476, 0, -136, 0, 1};
  const Integer_polynomial other{576, 0, -960, 0, 352, 0, -40, 0, 1};
  with_upward_rounding([&] {
    const int before = observed_mode();
    CHECK(locus::irreducible_factors(hard) == std::vector<Integer_polynomial>{hard});
    CHECK(locus::irreducible_factors(locus::multiply(hard, other)).size() == 2u);
    CHECK(observed_mode() == before);
  });
  // One that was seen to leave the processor rounding to nearest.
  const std::vector<long> met{
    900142956, -20477169684, 226136342376, -1626584491296, 8623788257457, -36088002922311, 124217225600064,
    -360275616607312, 890681909267694, -1876943099072796, 3319203848448776, -4682674522136772, 4366866859162421,
    737594147899093, -15174346945929248, 43968936935006744, -90880447901545052, 156478607016413594,
    -236830609201521008, 323261227518990708, -403251676521758372, 462439237218071912, -487745012840763488,
    471392842310450264, -414647786473021648, 329045335474703824, -233230599107487504, 146106497471938784,
    -79997711926423584, 37827598845042688, -15239912668055616, 5146857056952960, -1427208516918272, 315946658356224,
    -53605321133056, 6533767616512, -508268407808, 18906699776};
  Integer_polynomial long_one;
  for (const long c : met) long_one.push_back(Integer(c));
  with_upward_rounding([&] {
    const int before = observed_mode();
    CHECK_FALSE(locus::irreducible_factors(long_one).empty());
    CHECK(observed_mode() == before);
  });
  Random random(402);
  for (int k = 0; k < 20; ++k) {
    Integer_polynomial product{1};
    std::vector<Integer_polynomial> parts;
    for (int i = 0; i < 4; ++i) {
      Integer_polynomial f = random_polynomial(random, random.between(1, 5), 1000000);
      if (locus::degree(f) < 1) continue;
      product = locus::multiply(product, f);
    }
    with_upward_rounding([&] {
      const int before = observed_mode();
      const auto factors = locus::irreducible_factors(product);
      CHECK(observed_mode() == before);
      Integer_polynomial rest = product;
      for (const auto& f : factors)
        while (locus::degree(locus::gcd(rest, f)) == locus::degree(f)) rest = locus::exact_quotient(rest, f);
      CHECK(locus::degree(rest) == 0);
    });
  }
}
