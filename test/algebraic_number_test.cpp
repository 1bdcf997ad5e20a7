// SPDX-License-Identifier: LGPL-3.0-or-later
#include <locus/zero_set/algebraic_number.h>

#include <catch2/catch.hpp>

#include <thread>
#include <vector>

using namespace locus;

namespace {

Integer_polynomial polynomial(std::initializer_list<long> coefficients)
{
  Integer_polynomial p;
  for (long c : coefficients) p.emplace_back(c);
  return p;
}

} // namespace

TEST_CASE("the square root of two is enclosed as tightly as asked, and its square is two")
{
  const Algebraic_number root(polynomial({-2, 0, 1}), 1, 2);
  const Rational width = Rational(1, Integer(1) << 200);
  const auto [lo, hi] = root.enclosure(width);
  REQUIRE(Rational(hi - lo) <= width);
  REQUIRE(Rational(lo * lo) < 2);
  REQUIRE(Rational(hi * hi) > 2);
  REQUIRE(root.compare(Rational(3, 2)) == -1);
  REQUIRE(root.compare(Rational(7, 5)) == 1);
  REQUIRE(root.to_double() == Approx(1.4142135623730951).epsilon(1e-15));
}

TEST_CASE("a rational root compares equal to itself, also as a multiple root and at an end of the interval")
{
  const Algebraic_number third(polynomial({1, -6, 9}), 0, 1); // (3u - 1)^2
  REQUIRE(third.compare(Rational(1, 3)) == 0);
  REQUIRE(third.compare(Rational(1, 3) + Rational(1, Integer(1) << 100)) == -1);
  REQUIRE(degree(third.polynomial()) == 1);
  const Algebraic_number at_end(polynomial({0, -1, 1}), Rational(1, 2), 1); // u(u - 1)
  REQUIRE(at_end.compare(1) == 0);
  REQUIRE(at_end.enclosure(Rational(1, 1000)).second == 1);
  REQUIRE(Algebraic_number(Rational(-5, 7)).compare(Rational(-5, 7)) == 0);
}

TEST_CASE("intervals without exactly one root are refused")
{
  REQUIRE_THROWS_AS(Algebraic_number(polynomial({-2, 0, 1}), -2, 2), std::invalid_argument);
  REQUIRE_THROWS_AS(Algebraic_number(polynomial({2, 0, 1}), -2, 2), std::invalid_argument);
  REQUIRE_THROWS_AS(Algebraic_number(polynomial({5}), 0, 1), std::invalid_argument);
  REQUIRE_THROWS_AS(Algebraic_number(polynomial({-2, 0, 1}), 1, 1), std::invalid_argument);
}

TEST_CASE("several threads may refine one number")
{
  const Algebraic_number root(polynomial({-3, 0, 0, 1}), 1, 2);
  std::vector<std::thread> threads;
  std::vector<int> right(4, 0);
  for (std::size_t k = 0; k < right.size(); ++k)
    threads.emplace_back([&, k] {
      for (unsigned bits = 1; bits <= 300; ++bits) {
        const auto [lo, hi] = root.enclosure(Rational(1, Integer(1) << bits));
        right[k] += Rational(lo * lo * lo) <= 3 && Rational(hi * hi * hi) >= 3;
      }
    });
  for (std::thread& t : threads) t.join();
  for (int r : right) REQUIRE(r == 300);
}
