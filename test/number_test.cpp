// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/number/bounded.h>
#include <locus/number/filter_counts.h>
#include <locus/number/interval.h>
#include <locus/number/rational.h>
#include <locus/number/sign.h>

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Bounded;
using locus::exact_rational;
using locus::Interval;
using locus::parse_rational;
using locus::with_nearest_rounding;
using locus::with_upward_rounding;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double greatest = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();

bool is_rejected(const std::string& text)
{
  return thrown<std::invalid_argument>([&] { parse_rational(text); }) == 1;
}

Rational random_rational_near_doubles(Random& random)
{
  switch (random.below(6)) {
  case 0:
    return random.rational();
  case 1:
    return exact_rational(random.any_double());
  case 2:
    return Rational(exact_rational(random.any_double()) + (random.chance(50) ? 1 : -1) * two_to(-1200));
  case 3: { // between two doubles, exactly half-way
    const double x = random.any_double();
    return Rational((exact_rational(x) + exact_rational(std::nextafter(x, 0.0))) / 2);
  }
  case 4:
    return Rational(random.rational() * two_to(random.between(-1120, -1000)));
  default:
    return Rational(random.rational() * two_to(random.between(900, 1040)));
  }
}

volatile double sink;

} // namespace

// --------------------------------------------------------------------------------------------------------- signs

TEST_CASE("the arithmetic of signs is that of the integers, with unknown on top", "[number][sign]")
{
  using locus::opposite;
  using locus::sign_of_int;
  for (int a = -2; a <= 2; ++a) {
    CHECK(static_cast<int>(sign_of_int(a)) == (a > 0) - (a < 0));
    CHECK(opposite(sign_of_int(a)) == sign_of_int(-a));
    CHECK(locus::is_strict(sign_of_int(a)) == (a != 0));
    CHECK(locus::is_certain(sign_of_int(a)));
    CHECK(sign_of_int(a) * Sign::unknown == (a == 0 ? Sign::zero : Sign::unknown));
    CHECK(Sign::unknown * sign_of_int(a) == (a == 0 ? Sign::zero : Sign::unknown));
    for (int b = -2; b <= 2; ++b) CHECK(sign_of_int(a) * sign_of_int(b) == sign_of_int(a * b));
  }
  CHECK(opposite(Sign::unknown) == Sign::unknown);
  CHECK(Sign::unknown * Sign::unknown == Sign::unknown);
  CHECK_FALSE(locus::is_certain(Sign::unknown));
  CHECK_FALSE(locus::is_strict(Sign::unknown));
  std::ostringstream out;
  out << Sign::negative << Sign::zero << Sign::positive << Sign::unknown;
  CHECK(out.str() == "-0+?");
}

TEST_CASE("a count of the ladder's rungs adds up", "[number][filter]")
{
  using locus::Rung;
  locus::Filter_counts a, b;
  a.record(Rung::bounded, true);
  a.record(Rung::bounded, false);
  b.record(Rung::interval, false);
  b.record(Rung::exact, true);
  a += b;
  a += b;
  CHECK(a.calls == std::array<std::uint64_t, 3>{2, 2, 2});
  CHECK(a.failures == std::array<std::uint64_t, 3>{1, 2, 0});
  CHECK(b.calls == std::array<std::uint64_t, 3>{0, 1, 1});
}

// ----------------------------------------------------------------------------------------------- numbers from text

TEST_CASE("decimals and fractions are read as the rationals that they spell", "[number][parse]")
{
  const std::vector<std::pair<const char*, const char*>> table{
    {"0", "0"},
    {"-0", "0"},
    {"0.1", "1/10"},
    {"-0.25e3", "-250"},
    {"2/3", "2/3"},
    {"-6/4", "-3/2"},
    {"+5", "5"},
    {"+1/2", "1/2"},
    {"1e3", "1000"},
    {"1E3", "1000"},
    {"1e+3", "1000"},
    {"1e-3", "1/1000"},
    {"1.50", "3/2"},
    {"007", "7"},
    {"0/5", "0"},
    {"010", "10"},
    {"0.125", "1/8"},
    {".5", "1/2"},
    {"5.", "5"},
    {"12.5e-1", "5/4"},
    {"1e0000000002", "100"},
    {"010/020", "1/2"},
    {"123456789012345678901234567890", "123456789012345678901234567890"},
    {"0.333333333333333333333", "333333333333333333333/1000000000000000000000"},
  };
  for (const auto& [text, value] : table) {
    INFO(text);
    CHECK(parse_rational(text).get_str() == value);
  }
}

TEST_CASE("text that spells no number is rejected with the text in the message", "[number][parse]")
{
  for (const char* text :
       {"",         " ",    "-",     "+",     ".",     "-.",    "e5",    "1e",    "1e+",   "1e-", "1e+-5", "1e5e3",
        "1e1.5",    "--1",  "+-1",   "-+1",   "++1",   "1-",    "0x10",  "0x1p3", "nan",   "NaN", "inf",   "-inf",
        "Infinity", " 1",   "1 ",    "1 2",   "1\n",   "\t1",   "1,5",   "1_000", "1.2.3", "1/",  "/2",    "1/-2",
        "-1/-2",    "1//2", "1/2/3", "1.5/2", "1/2.5", "1e3/2", "1/1e3", "1/+2",  "0b1",   "1f",  "½"}) {
    INFO("'" << text << "'");
    CHECK(is_rejected(text));
  }
  CHECK(is_rejected(std::string("1\0", 2)));
  CHECK(is_rejected("1/0"));
  CHECK(is_rejected("0/0"));
  CHECK(is_rejected("1/000"));
  // Short texts that would need gigabytes.
  CHECK(is_rejected("1e99999999"));
  CHECK(is_rejected("1e-99999999"));
  CHECK(is_rejected("1e99999999999999999999999999"));
  CHECK(is_rejected("1e4001"));
  CHECK(is_rejected("1e-4001"));
  CHECK_FALSE(is_rejected("1e4000"));
  CHECK_FALSE(is_rejected("1e-4000"));
  std::string message;
  try {
    parse_rational("12monkeys");
  } catch (const std::invalid_argument& e) {
    message = e.what();
  }
  CHECK(message.find("12monkeys") != std::string::npos);
  CHECK(thrown<std::invalid_argument>([] { parse_rational(std::string(100000, 'x')); }) == 1);
}

TEST_CASE("exponents are powers of ten up to the limit", "[number][parse]")
{
  Integer p = 1;
  for (int i = 0; i < 4000; ++i) p *= 10;
  CHECK(parse_rational("1e4000") == p);
  CHECK(parse_rational("-3e-4000") == Rational(-3) / p);
  CHECK(parse_rational("0.001e4000") * 1000 == p);
}

TEST_CASE("random decimals agree with GMP's own fractions and with the C library's reader", "[number][parse]")
{
  Random random(1);
  Samples samples;
  for (int i = 0; i < 4000; ++i) {
    std::string digits, fraction;
    for (int k = random.between(1, 22); k > 0; --k) digits += static_cast<char>('0' + random.below(10));
    for (int k = random.below(22); k > 0; --k) fraction += static_cast<char>('0' + random.below(10));
    const int exponent = random.chance(30) ? 0 : random.between(-60, 60);
    const bool negative = random.chance(50);
    std::string text = (negative ? "-" : random.chance(10) ? "+" : "") + digits;
    if (!fraction.empty() || random.chance(10)) text += "." + fraction;
    if (exponent != 0 || random.chance(10)) text += (random.chance(50) ? "e" : "E") + std::to_string(exponent);
    const int shift = exponent - static_cast<int>(fraction.size());
    Rational expected((negative ? "-" : "") + digits + fraction +
                        (shift > 0 ? std::string(static_cast<std::size_t>(shift), '0') : "") + "/1" +
                        (shift < 0 ? std::string(static_cast<std::size_t>(-shift), '0') : ""),
                      10);
    expected.canonicalize();
    const Rational parsed = parse_rational(text);
    samples.expect(parsed == expected, [&] { return text + " read as " + show(parsed); });
    samples.expect(locus::nearest_double(parsed) == std::strtod(text.c_str(), nullptr),
                   [&] { return text + " is not next to " + show(std::strtod(text.c_str(), nullptr)); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 8000);
}

TEST_CASE("doubles are taken at their binary value", "[number][parse]")
{
  Random random(2);
  Samples samples;
  std::vector<double> values{0.0, -0.0, 1.0, 0.1, least, -least, greatest, 0x1p-1022, 0x1.fffffffffffffp-1023};
  for (int i = 0; i < 300; ++i) values.push_back(random.any_double());
  for (const double x : values) {
    char text[1600];
    std::snprintf(text, sizeof text, "%.1100f", x); // the C library prints all digits of the binary value
    samples.expect(exact_rational(x) == parse_rational(text), [&] { return show(x); });
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    const Rational rebuilt = Rational(Integer(static_cast<long>(std::ldexp(mantissa, 53)))) * two_to(exponent - 53);
    samples.expect(exact_rational(x) == rebuilt, [&] { return show(x); });
    samples.expect(locus::nearest_double(exact_rational(x)) == x, [&] { return show(x); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 900);
  CHECK(exact_rational(0.1) != parse_rational("0.1"));
  for (const double x :
       {infinity, -infinity, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::signaling_NaN()})
    CHECK(thrown<std::domain_error>([&] { exact_rational(x); }) == 1);
}

TEST_CASE("a coordinate may be an int, a double, a string or a rational", "[number][parse]")
{
  using locus::Number;
  CHECK(Number(3).value() == 3);
  CHECK(Number(-4000000000L).value() == Rational("-4000000000"));
  CHECK(Number(0.5).value() == Rational(1, 2));
  CHECK(Number(0.1).value() != Rational(1, 10));
  CHECK(Number("0.1").value() == Rational(1, 10));
  CHECK(Number(std::string("5/2")).value() == Rational(5, 2));
  CHECK(Number(Rational(7, 3)).value() == Rational(7, 3));
  CHECK(thrown<std::domain_error>([] { Number(std::nan("")); }) == 1);
  CHECK(thrown<std::invalid_argument>([] { Number("1e"); }) == 1);
}

// --------------------------------------------------------------------------------------------------- rounding modes

TEST_CASE("with_upward_rounding enters the mode and restores the caller's, also on a throw", "[number][rounding]")
{
  for (const int mode : rounding_modes) {
    int inside = -1, nested = -1, nearest_inside = -1, after_nested = -1, after = -1, after_throw = -1;
    bool caught = false, sums_up = false, sums_near = false;
    in_mode(mode, [&] {
      with_upward_rounding([&] {
        inside = observed_mode();
        sums_up = locus::detail::opaque_sum(1.0, 0x1p-80) > 1.0;
        with_upward_rounding([&] { nested = observed_mode(); });
        with_nearest_rounding([&] {
          nearest_inside = observed_mode();
          sums_near = locus::detail::opaque_sum(1.0, 0x1p-80) == 1.0;
        });
        after_nested = observed_mode();
      });
      after = observed_mode();
      try {
        with_upward_rounding([&] {
          sink = locus::detail::opaque_sum(1.0, 0x1p-80);
          with_nearest_rounding([] { throw std::logic_error("on purpose"); });
        });
      } catch (const std::logic_error&) {
        caught = true;
      }
      after_throw = observed_mode();
    });
    INFO(mode_name(mode));
    CHECK(inside == FE_UPWARD);
    CHECK(nested == FE_UPWARD);
    CHECK(nearest_inside == FE_TONEAREST);
    CHECK(after_nested == FE_UPWARD);
    CHECK(sums_up);
    CHECK(sums_near);
    CHECK(after == mode);
    CHECK(caught);
    CHECK(after_throw == mode);
  }
  CHECK(observed_mode() == FE_TONEAREST);
}

TEST_CASE("with_upward_rounding hands back values and references", "[number][rounding]")
{
  int x = 1;
  int& same = with_upward_rounding([&]() -> int& { return x; });
  same = 5;
  CHECK(x == 5);
  CHECK(with_upward_rounding([] { return std::string("moved"); }) == "moved");
  CHECK(locus::detail::rounding_mode_works());
}

// -------------------------------------------------------------------------------------------- enclosures of rationals

TEST_CASE("enclosing gives the tightest interval of doubles, in every rounding mode", "[number][interval]")
{
  Random random(3);
  std::vector<Rational> values{0, 1, -1, Rational(1, 3), Rational(1, 10)};
  for (const char* text : {"1e300", "-1e300", "1e-320", "-1e-320", "1e-323", "1e-324", "2e-324", "3e-324", "1e-400",
                           "-1e-4000", "1e308", "1.7976931348623157e308", "1.8e308", "-1e309", "1e4000",
                           "2.2250738585072014e-308", "2.2250738585072011e-308", "0.1"})
    values.push_back(parse_rational(text));
  for (int i = 0; i < 1500; ++i) values.push_back(random_rational_near_doubles(random));
  Samples samples;
  std::size_t exact = 0, subnormal = 0;
  for (const int mode : rounding_modes)
    for (const Rational& x : values) {
      double lo = 0, hi = 0;
      in_mode(mode, [&] {
        const Interval e = locus::enclosing(x);
        lo = e.inf();
        hi = e.sup();
      });
      const auto describe = [&] {
        return show(x) + " in [" + show(lo) + ", " + show(hi) + "], rounding " + mode_name(mode);
      };
      const bool below = lo == -infinity || exact_rational(lo) <= x, above = hi == infinity || exact_rational(hi) >= x;
      samples.expect(below && above, describe);
      // One double where x is one; else two neighbours. (nextafter is exact in every mode.)
      samples.expect(lo == hi ? exact_rational(lo) == x : std::nextafter(lo, infinity) == hi, describe);
      samples.expect(lo == hi ||
                       ((lo == -infinity || exact_rational(lo) < x) && (hi == infinity || exact_rational(hi) > x)),
                     describe);
      exact += lo == hi;
      subnormal += lo != hi && std::abs(lo) < 0x1p-1022;
    }
  LOCUS_REQUIRE_SAMPLES(samples, 18000);
  CHECK(exact > 500);
  CHECK(subnormal > 100);
}

TEST_CASE("nearest_double is next to the rational, and nearest where doubles are normal", "[number][interval]")
{
  Random random(4);
  Samples samples;
  for (int i = 0; i < 3000; ++i) {
    const Rational x = random_rational_near_doubles(random);
    if (abs(x) > exact_rational(greatest)) continue;
    const double y = locus::nearest_double(x);
    const Rational distance = abs(Rational(exact_rational(y) - x));
    const Rational up = std::nextafter(y, infinity) == infinity
                          ? distance
                          : Rational(abs(Rational(exact_rational(std::nextafter(y, infinity)) - x)));
    const Rational down = std::nextafter(y, -infinity) == -infinity
                            ? distance
                            : Rational(abs(Rational(exact_rational(std::nextafter(y, -infinity)) - x)));
    const bool normal = std::abs(y) >= 0x1p-1021;
    samples.expect(normal ? distance <= up && distance <= down : distance < two_to(-1074),
                   [&] { return show(x) + " to " + show(y); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 2500);
}

// -------------------------------------------------------------------------------------------------------- intervals

TEST_CASE("what the helpers say of an interval holds for the rationals in it", "[number][interval]")
{
  struct Fact {
    double inf, sup, mid, mag, mig, width;
    Sign sign;
    bool zero;
  };
  Random random(5);
  Samples samples;
  for (int i = 0; i < 4000; ++i) {
    const auto size = random.size();
    double a = random.real(size), b = random.chance(20) ? a : random.real(size);
    if (a > b) std::swap(a, b);
    const Fact f = with_upward_rounding([&] {
      const Interval x(a, b);
      return Fact{x.inf(),         x.sup(),           locus::midpoint(x),     locus::magnitude(x), locus::mignitude(x),
                  locus::width(x), locus::sign_of(x), locus::contains_zero(x)};
    });
    const Sign expected = a > 0              ? Sign::positive
                          : b < 0            ? Sign::negative
                          : a == 0 && b == 0 ? Sign::zero
                                             : Sign::unknown;
    const auto describe = [&] { return "[" + show(a) + ", " + show(b) + "]"; };
    samples.expect(f.inf == a && f.sup == b, describe);
    samples.expect(f.sign == expected, describe);
    samples.expect(f.zero == (a <= 0 && b >= 0), describe);
    samples.expect(a <= f.mid && f.mid <= b, describe);
    samples.expect(f.mag == std::max(std::abs(a), std::abs(b)), describe);
    samples.expect(f.mig == (a <= 0 && b >= 0 ? 0.0 : std::min(std::abs(a), std::abs(b))), describe);
    samples.expect(exact_rational(f.width) >= exact_rational(b) - exact_rational(a), describe);
    samples.expect(f.width <= std::nextafter(b - a, infinity), describe);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 32000);
}

TEST_CASE("hull, overlap and inside compare all four ends", "[number][interval]")
{
  Samples samples;
  for (int code = 0; code < 5 * 5 * 5 * 5; ++code) {
    const double a = code % 5, b = code / 5 % 5, c = code / 25 % 5, d = code / 125;
    if (a > b || c > d) continue;
    bool hull = false, meet = false, within = false;
    with_upward_rounding([&] {
      const Interval x(a, b), y(c, d), h = locus::hull(x, y);
      hull = h.inf() == std::min(a, c) && h.sup() == std::max(b, d);
      meet = locus::overlap(x, y);
      within = locus::inside(x, y);
    });
    int common = 0, strictly_in = 0, points = 0;
    for (double p = 0; p <= 4; p += 0.5) {
      common += a <= p && p <= b && c <= p && p <= d;
      points += a <= p && p <= b;
      strictly_in += a <= p && p <= b && c < p && p < d;
    }
    const auto describe = [&] { return "[" + show(a) + ", " + show(b) + "] and [" + show(c) + ", " + show(d) + "]"; };
    samples.expect(hull, describe);
    samples.expect(meet == (common > 0), describe);
    samples.expect(within == (points == strictly_in), describe);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 600);
}

TEST_CASE("interval operations contain the exact results and are one rounding wide", "[number][interval]")
{
  Random random(6);
  Samples samples;
  for (int i = 0; i < 3000; ++i) {
    const auto size = random.size();
    const double a = random.real(size), b = random.real(random.chance(50) ? size : random.size());
    double lo[4], hi[4];
    with_upward_rounding([&] {
      const Interval x(a), y(b);
      const Interval results[4]{x + y, x - y, x * y, b != 0 ? Interval(x / y) : Interval(0)};
      for (int k = 0; k < 4; ++k) {
        lo[k] = results[k].inf();
        hi[k] = results[k].sup();
      }
    });
    const Rational x = exact_rational(a), y = exact_rational(b);
    const Rational exact[4]{Rational(x + y), Rational(x - y), Rational(x * y), b != 0 ? Rational(x / y) : Rational(0)};
    for (int k = 0; k < 4; ++k) {
      const bool contained = (lo[k] == -infinity || exact_rational(lo[k]) <= exact[k]) &&
                             (hi[k] == infinity || exact_rational(hi[k]) >= exact[k]);
      samples.expect(contained, [&] { return show(a) + " and " + show(b) + ", operation " + std::to_string(k); });
      samples.expect(lo[k] == hi[k] || std::nextafter(std::nextafter(lo[k], infinity), infinity) >= hi[k],
                     [&] { return show(a) + " and " + show(b) + ", width of operation " + std::to_string(k); });
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 24000);
}

// --------------------------------------------------------------------------------------------------- value and error

TEST_CASE("the sign of a bounded number is the common sign of all numbers within the bound", "[number][bounded]")
{
  using locus::sign_of;
  CHECK(sign_of(Bounded{0, 0}) == Sign::zero);
  CHECK(sign_of(Bounded{-0.0, 0}) == Sign::zero);
  CHECK(sign_of(Bounded{0, least}) == Sign::unknown);
  CHECK(sign_of(Bounded{least, 0}) == Sign::positive);
  CHECK(sign_of(Bounded{-least, 0}) == Sign::negative);
  CHECK(sign_of(Bounded{1, 1}) == Sign::unknown);
  CHECK(sign_of(Bounded{-1, 1}) == Sign::unknown);
  CHECK(sign_of(Bounded{1, std::nextafter(1.0, 0.0)}) == Sign::positive);
  CHECK(sign_of(Bounded{-1, std::nextafter(1.0, 0.0)}) == Sign::negative);
  CHECK(sign_of(Bounded{1, infinity}) == Sign::unknown);
  CHECK(sign_of(Bounded{infinity, infinity}) == Sign::unknown);
  CHECK(sign_of(Bounded{std::nan(""), 0}) == Sign::unknown);
  CHECK(sign_of(Bounded{1, std::nan("")}) == Sign::unknown);
}

TEST_CASE("midpoint and radius cover the interval, in every rounding mode", "[number][bounded]")
{
  Random random(7);
  Samples samples;
  for (const int mode : rounding_modes)
    for (int i = 0; i < 2000; ++i) {
      const auto size = random.size();
      double a = random.real(size), b = a;
      switch (random.below(4)) {
      case 0:
        break;
      case 1:
        b = std::nextafter(a, infinity);
        break;
      case 2:
        b = random.real(random.size());
        break;
      default:
        b = random.real(size);
      }
      if (a > b) std::swap(a, b);
      Bounded x;
      in_mode(mode, [&] { x = locus::bounded(Interval(a, b)); });
      const Rational value = exact_rational(x.value), error = exact_rational(x.error);
      const auto describe = [&] {
        return "[" + show(a) + ", " + show(b) + "] as " + show(x.value) + " with " + show(x.error) + ", rounding " +
               mode_name(mode);
      };
      samples.expect(value - error <= exact_rational(a) && exact_rational(b) <= value + error, describe);
      samples.expect(a == b
                       ? x.error == 0
                       : error <= (exact_rational(b) - exact_rational(a)) * Rational(9, 8) / 2 + 6 * two_to(-1074) +
                                    two_to(-50) * std::max(abs(exact_rational(a)), abs(exact_rational(b))),
                     describe);
    }
  LOCUS_REQUIRE_SAMPLES(samples, 16000);
}

TEST_CASE("an unbounded interval has no known sign unless all of it has", "[number][bounded]")
{
  for (const auto& ends : std::vector<std::pair<double, double>>{{-infinity, infinity},
                                                                 {-1, infinity},
                                                                 {0, infinity},
                                                                 {-infinity, 1},
                                                                 {-infinity, 0},
                                                                 {-greatest, infinity},
                                                                 {-greatest, greatest}}) {
    const double a = ends.first, b = ends.second;
    Sign sign = Sign::zero;
    with_upward_rounding([&] { sign = locus::sign_of(locus::bounded(Interval(a, b))); });
    INFO(a << ", " << b);
    CHECK(sign == Sign::unknown);
  }
}
