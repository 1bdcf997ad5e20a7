// SPDX-License-Identifier: LGPL-3.0-or-later
// The sign of a polynomial's minimum against its known roots; feet and nearest feet against dense sampling, formulas of the
// paper and configurations whose answer is known.
#include <locus/construct/nearest_feet.h>
#include <locus/construct/nearest_input.h>
#include <locus/shape/constructors_2.h>

#include "shape_support.h"

#include <catch2/catch.hpp>

using namespace locus;
using locus_test::two_to;

namespace {

using Form = Bernstein<Rational, 1>;

/// Σ a_i u^i.
Form powers(const std::vector<Number>& a)
{
  std::vector<Rational> values;
  for (const Number& x : a) values.push_back(x.value());
  return from_monomial(values);
}

struct Known_root {
  Rational at;
  int multiplicity;
};

/// The sign of the minimum of factor·∏ (u - root)^multiplicity on [0,1], from the roots alone.
Sign sign_from(const std::vector<Known_root>& roots, const Rational& factor)
{
  std::vector<Rational> cuts{0, 1};
  bool touches = false;
  for (const Known_root& r : roots)
    if (r.at >= 0 && r.at <= 1) {
      touches = true;
      cuts.push_back(r.at);
    }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i] == cuts[i - 1]) continue;
    const Rational mid = (cuts[i] + cuts[i - 1]) / 2;
    int s = sgn(factor);
    for (const Known_root& r : roots)
      if (r.multiplicity % 2 == 1 && mid < r.at) s = -s;
    if (s < 0) return Sign::negative;
  }
  return touches ? Sign::zero : Sign::positive;
}

} // namespace

TEST_CASE("the sign of a minimum where it can be seen at a glance", "[least_sign]")
{
  CHECK(least_sign(powers({0})) == Sign::zero);
  CHECK(least_sign(powers({0, 0, 0})) == Sign::zero);
  CHECK(least_sign(powers({1})) == Sign::positive);
  CHECK(least_sign(powers({-1})) == Sign::negative);
  // Zeros at the ends only.
  CHECK(least_sign(powers({0, 1})) == Sign::zero);
  CHECK(least_sign(powers({0, -1})) == Sign::negative);
  CHECK(least_sign(powers({1, -1})) == Sign::zero);
  CHECK(least_sign(powers({0, 1, -1})) == Sign::zero);
  CHECK(least_sign(powers({0, 0, 0, 1})) == Sign::zero);
  CHECK(least_sign(powers({0, 0, 1, -1})) == Sign::zero);
  CHECK(least_sign(powers({0, -1, 1})) == Sign::negative);
  CHECK(least_sign(powers({0, Rational(-two_to(-80)), 1})) == Sign::negative); // below zero on a short part next to an end
  CHECK(least_sign(powers({0, 0, Rational(-two_to(-80)), 1})) == Sign::negative);
  CHECK(least_sign(powers({0, two_to(-80), 1})) == Sign::zero);
  // A double root at 1/√2, and moved off.
  CHECK(least_sign(powers({"1/4", 0, -1, 0, 1})) == Sign::zero);
  CHECK(least_sign(powers({"-1/4", 0, 1, 0, -1})) == Sign::negative);
  for (const int e : {-5, -30, -52, -60, -200, -1000}) {
    CHECK(least_sign(powers({Rational(Rational(1, 4) + two_to(e)), 0, -1, 0, 1})) == Sign::positive);
    CHECK(least_sign(powers({Rational(Rational(1, 4) - two_to(e)), 0, -1, 0, 1})) == Sign::negative);
  }
  // A triple root inside, and roots outside.
  CHECK(least_sign(powers({"-1/8", "3/4", "-3/2", 1})) == Sign::negative);
  CHECK(least_sign(powers({"1/10", 1})) == Sign::positive);
  CHECK(least_sign(powers({2, -1})) == Sign::positive);
}

TEST_CASE("simple roots 2^-60 apart, or a complex pair as near, are told from a double root", "[least_sign]")
{
  for (const Rational& a : {Rational(1, 3), Rational(1, 2), Rational(7, 9)})
    for (const int e : {-20, -60, -300}) {
      const Rational d = two_to(e), b = a + d;
      CHECK(least_sign(powers({Rational(a * b), Rational(-a - b), 1})) == Sign::negative);
      CHECK(least_sign(powers({Rational(a * a + d * d), Rational(-2 * a), 1})) == Sign::positive);
      CHECK(least_sign(powers({Rational(a * a), Rational(-2 * a), 1})) == Sign::zero);
      CHECK(least_sign(multiply(powers({Rational(a * b), Rational(-a - b), 1}), powers({Rational(-b), 1}))) == Sign::negative);
    }
  // Both inside the last of the doubles before 1, or below the first ones.
  const Rational tiny = two_to(-1200);
  CHECK(least_sign(powers({Rational(2 * tiny * tiny), Rational(-3 * tiny), 1})) == Sign::negative);
  CHECK(least_sign(multiply(powers({Rational(1 - tiny), -1}), powers({1, -1}))) == Sign::negative);
}

TEST_CASE("the sign of a minimum of products with known roots, in every rounding mode", "[least_sign]")
{
  locus_test::Random random(1);
  locus_test::Samples samples;
  for (int i = 0; i < 4000; ++i) {
    std::vector<Known_root> roots;
    Form f = powers({1});
    const int count = random.between(0, 4);
    for (int k = 0; k < count; ++k) {
      Rational at = random.chance(30) ? random.rational() : random.unit_rational();
      if (k > 0 && random.chance(30)) at = roots.back().at + two_to(-random.between(10, 90));
      roots.push_back({at, random.chance(50) ? 2 : random.between(1, 3)});
      for (int m = 0; m < roots.back().multiplicity; ++m) f = multiply(f, powers({Rational(-at), 1}));
    }
    const Rational factor = random.chance(70) ? Rational(1) : random.chance(50) ? two_to(random.between(-1500, 1500)) : Rational(-1);
    f = multiply(f, factor);
    if (random.chance(30)) { // without real roots
      const Rational a = random.unit_rational(), d = two_to(-random.between(0, 40));
      f = multiply(f, powers({Rational(a * a + d), Rational(-2 * a), 1}));
    }
    if (random.chance(20)) f = elevate(f, 0, random.between(1, 3));
    const Sign expected = sign_from(roots, factor);
    for (const int mode : locus_test::rounding_modes) {
      Sign found = Sign::unknown;
      Sign filtered = Sign::unknown;
      locus_test::in_mode(mode, [&] {
        found = least_sign(f);
        filtered = filtered_least_sign(locus::detail::rounded(Bernstein<Scaled_integer, 1>(f).values()));
      });
      samples.expect(found == expected && (filtered == Sign::unknown || filtered == expected),
                     [&] { return locus_test::show(f.coefficients()) + " in mode " + locus_test::mode_name(mode); });
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 16000);
}

TEST_CASE("the exact form is asked for only where doubles cannot tell", "[least_sign]")
{
  int asked = 0;
  const auto sign = [&](const Form& f, double error) {
    const auto values = converted<double>(f, [](const Rational& c) { return c.get_d(); });
    return least_sign(Bernstein<Bounded, 1>(values, error), [&] {
      ++asked;
      return f;
    });
  };
  CHECK(sign(powers({"1/4", -1, "5/4"}), 1e-15) == Sign::positive);
  CHECK(sign(powers({"1/4", -1, "3/4"}), 1e-15) == Sign::negative);
  CHECK(asked == 0);
  CHECK(sign(powers({"1/4", -1, 1}), 1e-15) == Sign::zero);
  CHECK(asked == 1);
  CHECK(sign(powers({"1/4", -1, "5/4"}), 1) == Sign::positive); // a bound that hides everything
  CHECK(asked == 2);
}

// ------------------------------------------------------------------------------------------------------------ P_perp

namespace {

using locus_test::in_powers;
using locus_test::plus;
using locus_test::Polynomial;
using locus_test::slope;
using locus_test::times;

/// (15) as it is printed, (12) for W = 1, in powers of the local coordinate.
Polynomial printed_form(const Curve_piece<2>& piece, const Exact_point<2>& q)
{
  const Polynomial w = in_powers(piece.weight);
  Polynomial sum;
  for (std::size_t k = 0; k < 2; ++k) {
    const Polynomial x = in_powers(piece.numerator[k]);
    const Polynomial offset = plus(times({q[k]}, w), times({-1}, x));
    sum = plus(sum, times(offset, plus(times(w, slope(x)), times({-1}, times(slope(w), x)))));
  }
  return locus_test::trimmed(sum);
}

Coordinates_2 coordinates(const Rational& x, const Rational& y) { return {x, y}; }

Curve_2 random_bezier(locus_test::Random& random, int degree, bool rational, int size = 50)
{
  std::vector<Coordinates_2> points;
  std::vector<Number> weights;
  for (int i = 0; i <= degree; ++i) {
    points.push_back({random.between(-size, size), random.between(-size, size)});
    if (rational) weights.emplace_back(random.between(1, 5));
  }
  return bezier_2(points, weights);
}

Curve_2 random_spline(locus_test::Random& random, int degree, int spans, bool rational, bool closed)
{
  std::vector<Coordinates_2> points;
  std::vector<Number> knots, weights;
  for (int i = 0; i <= degree; ++i) knots.emplace_back(0);
  int inner = 0;
  for (int s = 1; s < spans; ++s) {
    const int times_here = random.chance(30) ? random.between(1, degree) : 1; // now and then a corner
    for (int i = 0; i < times_here; ++i, ++inner) knots.emplace_back(s);
  }
  for (int i = 0; i <= degree; ++i) knots.emplace_back(spans);
  for (int i = 0; i <= degree + inner; ++i) {
    points.push_back({random.between(-50, 50), random.between(-50, 50)});
    if (rational) weights.emplace_back(random.between(1, 4));
  }
  if (closed) points.back() = points.front();
  return bspline_2(degree, points, knots, weights, closed);
}

/// Polynomials, or over 1 + u², u² - 1 or u, on the whole line, a half or an interval.
Curve_2 random_monomial(locus_test::Random& random)
{
  std::array<std::vector<Rational>, 2> x;
  const int degree = random.between(1, 4);
  for (auto& f : x)
    for (int i = 0; i <= degree; ++i) f.push_back(Rational(random.between(-20, 20), random.between(1, 4)));
  for (auto& f : x)
    for (Rational& c : f) c.canonicalize();
  const std::array<std::vector<Rational>, 5> weights{{{}, {1, 0, 1}, {-1, 0, 1}, {0, 1}, {2, 1, 1}}};
  Parameter_domain domain;
  if (random.chance(50)) domain.lo = random.between(-3, 0);
  if (random.chance(50)) domain.hi = random.between(1, 3);
  return monomial_curve<2>(x, weights[static_cast<std::size_t>(random.below(5))], domain);
}

/// Any of these; another one where the numbers make no valid curve.
Curve_2 random_curve(locus_test::Random& random)
{
  for (;;) {
    try {
      const int degree = random.between(1, 5), kind = random.below(3);
      if (kind == 0) return random_bezier(random, degree, random.chance(50));
      if (kind == 1) return random_spline(random, degree, random.between(1, 3), random.chance(50), random.chance(30));
      return random_monomial(random);
    } catch (const Invalid_input&) {
    }
  }
}

Coordinates_2 random_point(locus_test::Random& random, int size = 60)
{
  return {random.between(-size * 8, size * 8) / 8.0, random.between(-size * 8, size * 8) / 8.0};
}

// ------------------------------------------------------------------------------------------------- sampling in doubles

/// A curve in plain doubles.
class Sampler {
public:
  Sampler(const Curve_2& curve, const Coordinates_2& q) : curve_(curve), q_{q.x.value().get_d(), q.y.value().get_d()} {}

  double distance(std::size_t piece, double s) const
  {
    const auto& p = curve_.pieces()[piece];
    const double w = value(p.weight, s);
    return std::hypot(value(p.numerator[0], s) / w - q_[0], value(p.numerator[1], s) / w - q_[1]);
  }

  bool is_finite(std::size_t piece, int end) const
  {
    const auto& w = curve_.pieces()[piece].weight;
    return w[end == 0 ? 0 : w.size() - 1] != 0;
  }

  /// The values of local minima of samples on one piece, each improved by thirds; its ends among them.
  std::vector<double> minima(std::size_t piece, int n = 400) const
  {
    std::vector<double> d;
    for (int i = 0; i <= n; ++i)
      d.push_back(i == 0 && !is_finite(piece, 0)   ? HUGE_VAL
                  : i == n && !is_finite(piece, 1) ? HUGE_VAL
                                                   : distance(piece, double(i) / n));
    std::vector<double> found;
    for (int i = 0; i <= n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if ((i > 0 && d[k - 1] < d[k]) || (i < n && d[k + 1] < d[k])) continue;
      found.push_back(improved(piece, std::max(i - 1, 0) / double(n), std::min(i + 1, n) / double(n), d[k]));
    }
    return found;
  }

  double least(int n = 400) const
  {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < curve_.pieces().size(); ++i)
      for (const double d : minima(i, n)) least = std::min(least, d);
    return least;
  }

private:
  double improved(std::size_t piece, double lo, double hi, double best) const
  {
    if (lo == 0 && !is_finite(piece, 0)) lo = 1e-9;
    if (hi == 1 && !is_finite(piece, 1)) hi = 1 - 1e-9;
    for (int step = 0; step < 80; ++step) {
      const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3, da = distance(piece, a), db = distance(piece, b);
      best = std::min({best, da, db});
      (da < db ? hi : lo) = da < db ? b : a;
    }
    return best;
  }

  static double value(const Form& f, double s)
  {
    std::vector<double> c;
    for (const Rational& x : f.coefficients()) c.push_back(x.get_d());
    for (std::size_t level = 1; level < c.size(); ++level)
      for (std::size_t i = 0; i + level < c.size(); ++i) c[i] = (1 - s) * c[i] + s * c[i + 1];
    return c[0];
  }

  const Curve_2& curve_;
  std::array<double, 2> q_;
};

bool near(double a, double b) { return std::abs(a - b) <= 1e-7 * (1 + std::abs(a)); }

/// Whether each foot is where its record says: (15) changes its sign there just if it should, and the numbers fit the place.
bool feet_are_true(const Curve_2& curve, const Exact_point<2>& q, const Nearest_feet& result)
{
  for (const Curve_foot& foot : result.feet) {
    const auto& piece = curve.pieces()[foot.piece];
    const Rational middle = (foot.place.lo + foot.place.hi) / 2;
    const auto p = locus_test::local_point(piece, middle);
    const double d = std::hypot(Rational(p[0] - q[0]).get_d(), Rational(p[1] - q[1]).get_d());
    if (!(foot.distance.lo <= foot.distance.hi) || std::abs(d - foot.distance.lo) > 1e-12 * (1 + d)) return false;
    if (foot.distance.hi - foot.distance.lo > 1e-14 * foot.distance.hi) return false;
    if (std::hypot(p[0].get_d() - foot.point[0], p[1].get_d() - foot.point[1]) >
        foot.error + 1e-14 * (std::abs(foot.point[0]) + std::abs(foot.point[1])))
      return false;
    const bool inside = foot.place.lo > 0 && foot.place.hi < 1;
    if (!inside || foot.is_whole_piece || foot.feature != Feature::interior) continue;
    const Polynomial form = printed_form(piece, q);
    const int lo = sgn(locus_test::horner(form, foot.place.lo)), hi = sgn(locus_test::horner(form, foot.place.hi));
    if (foot.place.is_exact() ? lo != 0 : (lo * hi > 0) != (foot.multiplicity % 2 == 0)) return false;
    if (!foot.place.is_exact() && (lo != -foot.before || hi != -foot.after)) return false;
  }
  return true;
}

std::string described(const Curve_2& curve, const Coordinates_2& q)
{
  return locus_test::show_curve(curve) + "q = (" + q.x.value().get_str() + ", " + q.y.value().get_str() + ")";
}

} // namespace

TEST_CASE("P_perp is (12) and (15), at its true degree", "[foot_form]")
{
  locus_test::Random random(2);
  locus_test::Samples samples;
  for (int i = 0; i < 60; ++i) {
    const int n = random.between(1, 5);
    const bool rational = i % 2 == 1;
    Curve_2 curve = random_bezier(random, n, rational);
    const auto& piece = curve.pieces()[0];
    // Linear in a and b: equal for all of them if at three points.
    for (const Exact_point<2>& q : {Exact_point<2>{0, 0}, Exact_point<2>{1, 0}, Exact_point<2>{0, 1}}) {
      const Form form = foot_form(piece, q);
      samples.expect(in_powers(form) == printed_form(piece, q), [&] { return locus_test::show_curve(curve); });
      // N·W' - W·N'/2, with N = |ρ|².
      const auto offset = offset_from(piece, q);
      const Polynomial square = plus(times(in_powers(offset[0]), in_powers(offset[0])), times(in_powers(offset[1]), in_powers(offset[1])));
      const Polynomial w = in_powers(piece.weight);
      samples.expect(in_powers(form) == plus(times(square, slope(w)), times({Rational(-1, 2)}, times(w, slope(square)))), "by N and W");
    }
    const int degree = foot_form(piece, {Rational(1, 7), Rational(3, 11)}).degree();
    samples.expect(degree <= (piece.is_polynomial() ? 2 * n - 1 : 3 * n - 2), "no higher degree");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  CHECK(foot_form(bezier_2({{0, 0}, {1, 3}, {3, -2}, {4, 1}}).pieces()[0], {7, 5}).degree() == 5);
  CHECK(foot_form(bezier_2({{0, 0}, {1, 3}, {3, -2}, {4, 1}}, {1, 2, 5, 1}).pieces()[0], {7, 5}).degree() == 7);
}

TEST_CASE("(18) along y = x² is P_perp", "[foot_form]")
{
  // f = y - x²: (a-x)·f_y - (b-y)·f_x = (a-u) + 2u(b-u²), linear in a and b.
  const Curve_2 parabola = bezier_2({{0, 0}, {"1/2", 0}, {1, 1}});
  for (const Exact_point<2>& q : {Exact_point<2>{0, 0}, Exact_point<2>{1, 0}, Exact_point<2>{0, 1}})
    CHECK(in_powers(foot_form(parabola.pieces()[0], q)) == Polynomial({q[0], Rational(2 * q[1] - 1), 0, -2}));
}

TEST_CASE("what P_perp has in common with the weight is no foot", "[foot_form]")
{
  // Circles go through the circular points, where u² + 1 = 0: two feet are left of degree 4.
  const Curve_2 circle = monomial_curve<2>({{{1, 0, -1}, {0, 2}}}, {1, 0, 1}, {Rational(-1), Rational(1)});
  CHECK(foot_form(circle.pieces()[0], {3, 1}).degree() == 4);
  CHECK(degree(foot_polynomial(circle.pieces()[0], {3, 1})) == 2);
  CHECK(foot_polynomial(circle.pieces()[0], {0, 0}).empty());
  // A polynomial curve to infinity: as many feet as (12) has roots, 2n - 1.
  const Curve_2 cubic = monomial_curve<2>({{{0, 1}, {0, 0, 0, 1}}}, {}, {Rational(1), std::nullopt});
  REQUIRE(cubic.pieces().size() == 2u);
  CHECK(degree(foot_polynomial(cubic.pieces()[1], {3, 1})) == 5);
}

// -------------------------------------------------------------------------------------------------------------- inputs

TEST_CASE("the nearest of several curves, ties exactly", "[distance]")
{
  using Point = std::array<Rational, 2>;
  const std::vector<Point> points{{0, 1}, {1, 3}, {2, Rational(1, 2)}, {3, 2}};
  std::vector<Point> mirrored = points;
  for (Point& p : mirrored) p[1] = -p[1];
  const Curve_2 above = bezier_curve<2>(points), below = bezier_curve<2>(mirrored);
  for (const char* x : {"-2", "1/3", "7/5", "5"}) {
    const Nearest_input on_axis = nearest_input(above, below, {x, 0});
    CHECK(on_axis.is_tie());
    for (const int sign : {1, -1})
      for (const int e : {-1, -30, -200}) {
        const Nearest_input beside = nearest_input(above, below, coordinates(Rational(x), Rational(sign * two_to(e))));
        REQUIRE(beside.nearest.size() == 1u);
        CHECK(beside.nearest[0].input == (sign > 0 ? 0u : 1u));
        CHECK(beside.distance.lo <= beside.nearest[0].feet.distance.hi);
      }
  }
  const Curve_2 third = segment_2({10, 0}, {11, 0});
  const Nearest_input far = nearest_input({&above, &below, &third}, {20, 0});
  REQUIRE(far.nearest.size() == 1u);
  CHECK(far.nearest[0].input == 2u);
  CHECK(far.distance.lo <= 9.0);
  CHECK(far.distance.hi >= 9.0);
  CHECK_THROWS_AS(nearest_input(std::vector<const Curve_2*>{}, {0, 0}), std::invalid_argument);
}

// --------------------------------------------------------------------------------------------------------------- feet

TEST_CASE("Example 1.2: (u, u³) from (0, h) has a foot at the inflection, at times the nearest", "[distance]")
{
  const Curve_2 cubic = monomial_curve<2>({{{0, 1}, {0, 0, 0, 1}}}, {}, {});
  // |q - r|² - h² = u²·(1 - 2hu + u⁴), which is positive for all u ≠ 0 up to h = 2·3^(-3/4) = 0.877….
  for (const char* h : {"1/10", "1/2", "87/100", "877/1000"}) {
    const Nearest_feet result = nearest_feet(cubic, {0, h});
    REQUIRE(result.nearest.size() == 1u);
    const Curve_foot& foot = result.feet[result.nearest[0]];
    CHECK(foot.parameter.lo == 0.0);
    CHECK(foot.parameter.hi == 0.0);
    CHECK(foot.multiplicity == 1);
    CHECK(foot.is_minimum());
    CHECK(foot.feature == Feature::interior);
  }
  for (const char* h : {"878/1000", "1", "20"}) {
    const Nearest_feet result = nearest_feet(cubic, {0, h});
    REQUIRE(result.feet.size() == 3u);
    CHECK(result.feet[0].parameter.hi == 0.0);
    CHECK(result.feet[0].is_minimum());
    CHECK(result.nearest == std::vector<std::size_t>{2});
  }
}

TEST_CASE("the circle from (-2, 0): the nearest point is that at infinity", "[distance]")
{
  const std::array<std::vector<Rational>, 2> x{{{1, 0, -1}, {0, 2}}};
  const double infinite = std::numeric_limits<double>::infinity();
  const auto check = [&](const Parameter_domain& domain, Feature feature, double parameter) {
    const Nearest_feet result = nearest_feet(monomial_curve<2>(x, {1, 0, 1}, domain), {-2, 0});
    REQUIRE(result.nearest.size() == 1u);
    const Curve_foot& foot = result.feet[result.nearest[0]];
    CHECK(foot.feature == feature);
    CHECK(foot.parameter.lo == parameter);
    CHECK(foot.parameter.hi == parameter);
    CHECK(foot.multiplicity == 1);
    CHECK(foot.is_minimum());
    CHECK(result.distance.lo == 1.0);
    CHECK(result.distance.hi == 1.0);
    CHECK(foot.point[0] == -1.0);
    CHECK(foot.error == 0.0);
    CHECK(nearer({-2, 0}, {-3, 0}, monomial_curve<2>(x, {1, 0, 1}, domain)) == Nearer::equal);
  };
  check({}, Feature::interior, infinite);
  check({Rational(0), std::nullopt}, Feature::end, infinite);
  check({std::nullopt, Rational(0)}, Feature::start, -infinite);
  // From elsewhere it is not even a foot of the closed curve, but always one of a half-open domain.
  CHECK(nearest_feet(monomial_curve<2>(x, {1, 0, 1}, {}), {3, 1}).feet.size() == 2u);
  CHECK(nearest_feet(monomial_curve<2>(x, {1, 0, 1}, {Rational(0), std::nullopt}), {3, 1}).feet.size() == 3u);
}

TEST_CASE("ties are exact, and what is nearly one is none", "[distance]")
{
  const Curve_2 parabola = monomial_curve<2>({{{0, 1}, {0, 0, 1}}}, {}, {Rational(-2), Rational(2)});
  // Feet at u² = h - 1/2, irrational.
  for (const char* h : {"1", "2", "5/4", "3/4"}) CHECK(nearest_feet(parabola, {0, h}).nearest.size() == 2u);
  for (const int e : {-1, -40, -80, -400, -2000})
    for (const int side : {-1, 1}) {
      const Nearest_feet result = nearest_feet(parabola, coordinates(Rational(side * two_to(e)), 2));
      REQUIRE(result.nearest.size() == 1u);
      CHECK((result.feet[result.nearest[0]].point[0] > 0) == (side > 0));
    }
  // Two pieces of different forms: a cubic, and before it its mirror image, backwards.
  const Curve_2 mirrored = joined_curve<2>(
    {bezier_2({{4, -1}, {3, 2}, {1, -3}, {0, 0}}).pieces()[0], bezier_2({{0, 0}, {1, 3}, {3, -2}, {4, 1}}).pieces()[0]},
    {locus::detail::finite_range(0, 1), locus::detail::finite_range(1, 2)}, false);
  const Nearest_feet both = nearest_feet(mirrored, {"5/2", 0});
  REQUIRE(both.nearest.size() == 2u);
  CHECK(both.feet[both.nearest[0]].piece != both.feet[both.nearest[1]].piece);
  CHECK(nearest_feet(mirrored, coordinates(Rational(5, 2), two_to(-70))).nearest.size() == 1u);
  // On an ellipse, in quarters and as one rational function, from its long axis: feet at irrational parameters.
  for (const Curve_2& ellipse : {ellipse_2({1, 2}, 4, 2), monomial_curve<2>({{{5, 0, -3}, {2, 4, 2}}}, {1, 0, 1}, {})}) {
    CHECK(nearest_feet(ellipse, {2, 2}).nearest.size() == 2u);
    CHECK(nearest_feet(ellipse, coordinates(Rational(2), Rational(2 + two_to(-70)))).nearest.size() == 1u);
  }
  // An irrational foot of y = x² and an end, both at the distance 1.
  const auto parabola_and_segment = [](const Rational& y) {
    return joined_curve<2>({bezier_2({{0, 0}, {"1/2", 0}, {1, 1}}).pieces()[0], segment_2({1, 1}, coordinates(1, y)).pieces()[0]},
                           {locus::detail::finite_range(0, 1), locus::detail::finite_range(1, 2)}, false);
  };
  const Nearest_feet with_end = nearest_feet(parabola_and_segment(Rational(5, 4)), {0, "5/4"});
  REQUIRE(with_end.nearest.size() == 2u);
  CHECK(with_end.feet[with_end.nearest[0]].feature == Feature::interior);
  CHECK(with_end.feet[with_end.nearest[1]].feature == Feature::end);
  CHECK(nearest_feet(parabola_and_segment(Rational(Rational(5, 4) - two_to(-200))), {0, "5/4"}).nearest.size() == 1u);
  // A square from its centre, with four nearest; off it by little, one.
  const Curve_2 square = polyline_2({{0, 0}, {2, 1}, {1, 3}, {-1, 2}}, true);
  CHECK(nearest_feet(square, {"1/2", "3/2"}).nearest.size() == 4u);
  CHECK(nearest_feet(square, coordinates(Rational(Rational(1, 2) + two_to(-90)), Rational(3, 2))).nearest.size() == 1u);
}

TEST_CASE("three nearest feet at irrational places", "[distance]")
{
  // x = u, y = u²(u²-1)²: even, so that feet from the axis come in pairs; and one on the axis. The height at which the three
  // are equal is no rational; the pair alone is found nearest above it, the one alone below.
  const Curve_2 curve = monomial_curve<2>({{{0, 1}, {0, 0, 1, 0, -2, 0, 1}}}, {}, {Rational(-2), Rational(2)});
  Rational below = 0, above = 10;
  for (int step = 0; step < 120; ++step) {
    const Rational mid = (below + above) / 2;
    const std::size_t n = nearest_feet(curve, coordinates(0, mid)).nearest.size();
    REQUIRE((n == 1 || n == 2));
    (n == 1 ? below : above) = mid;
  }
  CHECK(below > 0);
  CHECK(above < 10);
}

TEST_CASE("from a circle's centre whole pieces are nearest", "[distance]")
{
  const Nearest_feet result = nearest_feet(circle_2({1, 2}, 3), {1, 2});
  REQUIRE(result.feet.size() == 4u);
  CHECK(result.nearest.size() == 4u);
  CHECK(result.distance.lo == 3.0);
  CHECK(result.distance.hi == 3.0);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(result.feet[i].is_whole_piece);
    CHECK(result.feet[i].parameter.lo == static_cast<double>(i));
    CHECK(result.feet[i].parameter.hi == static_cast<double>(i + 1));
    CHECK(result.feet[i].is_minimum());
    CHECK(result.feet[i].is_maximum());
  }
  // An arc: its ends are listed, too.
  const Nearest_feet arc = nearest_feet(arc_2({1, 0}, {0, 1}, {0}), {0, 0});
  CHECK(arc.feet.size() == 3u); // a bulge of zero: the segment
  const Nearest_feet half = nearest_feet(arc_2({1, 0}, {-1, 0}, 1), {0, 0});
  REQUIRE(half.feet.size() == 4u);
  CHECK(half.feet[0].feature == Feature::start);
  CHECK(half.feet[3].feature == Feature::end);
  CHECK(half.nearest.size() == 4u);
  // A segment that leaves the arc along its tangent: where they meet is a point of the arc.
  const Curve_2 hook = joined_curve<2>({arc_2({0, -1}, {1, 0}, "1/4").pieces()[0], segment_2({1, 0}, {1, 5}).pieces()[0]},
                                       {locus::detail::finite_range(0, 1), locus::detail::finite_range(1, 2)}, false);
  REQUIRE(hook.chain().joints[0].kind == Joint_kind::corner); // tan(90°/4) is no rational: not quite a quarter
  const Curve_2 smooth = joined_curve<2>({circle_2({0, 0}, 1).pieces()[3], segment_2({1, 0}, {1, 5}).pieces()[0]},
                                         {locus::detail::finite_range(0, 1), locus::detail::finite_range(1, 2)}, false);
  REQUIRE(smooth.chain().joints[0].goes_on());
  const Nearest_feet joined = nearest_feet(smooth, {0, 0});
  REQUIRE(joined.feet.size() == 3u);
  CHECK(joined.feet[0].feature == Feature::start);
  CHECK(joined.feet[1].is_whole_piece);
  CHECK(joined.feet[2].feature == Feature::end);
  CHECK(joined.nearest == std::vector<std::size_t>{0, 1});
  // Next to the centre it is an ordinary foot.
  const Nearest_feet beside = nearest_feet(circle_2({1, 2}, 3), coordinates(Rational(1 + two_to(-100)), 2));
  CHECK(beside.feet.size() == 2u);
  CHECK(beside.nearest.size() == 1u);
}

TEST_CASE("the distance is zero exactly on the curve", "[distance]")
{
  locus_test::Random random(3);
  locus_test::Samples samples;
  for (int i = 0; i < 60; ++i) {
    const Curve_2 curve = random_bezier(random, random.between(1, 5), i % 2 == 0);
    const Rational u = i % 3 ? random.unit_rational() : Rational(i % 2);
    const auto p = locus_test::local_point(curve.pieces()[0], u);
    const Nearest_feet result = nearest_feet(curve, coordinates(p[0], p[1]));
    bool found = result.is_on_curve() && result.distance.lo == 0;
    bool listed = false;
    for (const std::size_t k : result.nearest) listed = listed || (result.feet[k].place.lo <= u && u <= result.feet[k].place.hi);
    samples.expect(found && listed && nearer(coordinates(p[0], p[1]), {1000, 1000}, curve) == Nearer::curve,
                   [&] { return locus_test::show_curve(curve); });
    const Nearest_feet off = nearest_feet(curve, coordinates(Rational(p[0] + two_to(-200)), p[1]));
    // Along a straight piece with y constant it stays on the curve.
    const auto& y = curve.pieces()[0].numerator[1];
    const bool level = subtract(y, multiply(curve.pieces()[0].weight, p[1])).coefficients() == std::vector<Rational>(y.size(), Rational(0));
    samples.expect(level || (!off.is_on_curve() && off.distance.lo > 0), [&] { return locus_test::show_curve(curve); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
  // A rational point at an irrational parameter: u² = 1/2 on (u² , u⁴ + u²).
  const Curve_2 twice = monomial_curve<2>({{{0, 0, 1}, {0, 0, 1, 0, 1}}}, {}, {Rational(0), Rational(1)});
  const Nearest_feet result = nearest_feet(twice, {"1/2", "3/4"});
  REQUIRE(result.nearest.size() == 1u);
  CHECK(result.is_on_curve());
  CHECK_FALSE(result.feet[result.nearest[0]].place.is_exact());
  CHECK_FALSE(nearest_feet(twice, coordinates(Rational(Rational(1, 2) + two_to(-300)), Rational(3, 4))).is_on_curve());
  // A crossing point is passed twice: (u² - 1, u³ - u) at u = ±1; with irrational parameters at u = ±√2.
  const Curve_2 loop = monomial_curve<2>({{{-1, 0, 1}, {0, -1, 0, 1}}}, {}, {Rational(-2), Rational(2)});
  CHECK(nearest_feet(loop, {0, 0}).nearest.size() == 2u);
  const Curve_2 wide = monomial_curve<2>({{{-2, 0, 1}, {0, -2, 0, 1}}}, {}, {Rational(-2), Rational(2)});
  const Nearest_feet crossing = nearest_feet(wide, {0, 0});
  CHECK(crossing.nearest.size() == 2u);
  CHECK(crossing.is_on_curve());
}

TEST_CASE("corners and ends are feet of their own", "[distance]")
{
  const Curve_2 bend = polyline_2({{0, 0}, {2, 0}, {2, 2}});
  const Nearest_feet outside = nearest_feet(bend, {3, -1});
  REQUIRE(outside.feet.size() == 3u);
  CHECK(outside.feet[0].feature == Feature::start);
  CHECK(outside.feet[1].feature == Feature::corner);
  CHECK(outside.feet[2].feature == Feature::end);
  CHECK(outside.nearest == std::vector<std::size_t>{1});
  CHECK(outside.feet[1].is_minimum());
  CHECK(outside.feet[1].multiplicity == 0);
  CHECK(outside.feet[1].piece == 0u);
  CHECK(outside.feet[1].parameter.lo == 1.0);
  const Nearest_feet inside = nearest_feet(bend, {1, 1});
  REQUIRE(inside.feet.size() == 5u);
  CHECK(inside.nearest == std::vector<std::size_t>{1, 3});
  CHECK(inside.feet[2].is_maximum());
  // Perpendicular to both pieces at once it is never; at an end on the normal there it is a root.
  const Nearest_feet end = nearest_feet(bend, {0, 5});
  CHECK(end.feet.front().multiplicity == 1);
  CHECK(end.feet.back().multiplicity == 0);
  CHECK(end.nearest == std::vector<std::size_t>{end.feet.size() - 1});
  // A corner that counts as smooth is a foot where it is extremal.
  const Curve_2 nearly_straight = with_join_tolerance(polyline_2({{-2, 0}, {0, "1/100"}, {2, 0}}), Rational(1, 10));
  REQUIRE(nearly_straight.chain().joints[0].by_tolerance);
  const Nearest_feet tolerated = nearest_feet(nearly_straight, {0, 1});
  REQUIRE(tolerated.nearest.size() == 1u);
  CHECK(tolerated.feet[tolerated.nearest[0]].feature == Feature::interior);
  CHECK(tolerated.feet[tolerated.nearest[0]].multiplicity == 0);
  CHECK(tolerated.feet[tolerated.nearest[0]].parameter.lo == 1.0);
  CHECK(nearest_feet(nearly_straight, {1, 1}).feet.size() == 3u); // an ordinary point of it from there
  // A smooth joint on the normal: a circle's quarters meet at (0, 1).
  const Nearest_feet joint = nearest_feet(circle_2({0, 0}, 1), {0, 3});
  REQUIRE(joint.feet.size() == 2u);
  CHECK(joint.feet[0].feature == Feature::interior);
  CHECK(joint.feet[0].parameter.lo == 1.0);
  CHECK(joint.feet[0].multiplicity == 1);
  CHECK(joint.nearest == std::vector<std::size_t>{0});
}

TEST_CASE("where the curve stands still is a corner if it reverses", "[distance]")
{
  // (t², t³) for t from -1 to 1, with its cusp inside a Bézier piece.
  const Curve_2 cusp = bezier_2({{1, -1}, {"-1/3", 1}, {"-1/3", -1}, {1, 1}});
  const Nearest_feet result = nearest_feet(cusp, {-1, 0});
  REQUIRE(result.feet.size() == 3u);
  CHECK(result.feet[1].feature == Feature::corner);
  CHECK(result.feet[1].multiplicity == 0); // P_perp vanishes with the velocity only
  CHECK(result.feet[1].is_minimum());
  CHECK(result.nearest == std::vector<std::size_t>{1});
  // From above the line to the cusp is at a right angle to its tangent.
  CHECK(nearest_feet(cusp, {0, 1}).feet[1].multiplicity > 0);
  // The same at an irrational parameter: velocity (1, u)·(u² - 1/2), on [0, 1].
  const Curve_2 hidden =
    monomial_curve<2>({{{0, Rational(-1, 2), 0, Rational(1, 3)}, {0, 0, Rational(-1, 4), 0, Rational(1, 4)}}}, {},
                      {Rational(0), Rational(1)});
  bool found = false;
  for (const Curve_foot& foot : nearest_feet(hidden, {-5, 0}).feet)
    found = found || (foot.feature == Feature::corner && std::abs(foot.parameter.lo - std::sqrt(0.5)) < 1e-12);
  CHECK(found);
  // (t³, t³·(1 + t)): it stands still without turning; the point there is a foot only for its normal.
  const Curve_2 pause = monomial_curve<2>({{{0, 0, 0, 1}, {0, 0, 0, 1, 1}}}, {}, {Rational(-1), Rational(1)});
  for (const Curve_foot& foot : nearest_feet(pause, {3, 1}).feet) CHECK(foot.feature != Feature::corner);
}

TEST_CASE("at a centre of curvature P_perp has a multiple root", "[distance]")
{
  const Curve_2 parabola = monomial_curve<2>({{{0, 1}, {0, 0, 1}}}, {}, {Rational(-2), Rational(2)});
  const auto foot_at = [](const Nearest_feet& result, double u) {
    for (const Curve_foot& foot : result.feet)
      if (foot.parameter.lo <= u && u <= foot.parameter.hi) return foot;
    FAIL("no foot there");
    return Curve_foot{};
  };
  const Curve_foot vertex = foot_at(nearest_feet(parabola, {0, "1/2"}), 0);
  CHECK(vertex.multiplicity == 3);
  CHECK(vertex.is_minimum());
  const auto circle = osculating_circle(parabola, Rational(1, 2));
  REQUIRE(circle.has_value());
  const Curve_foot level = foot_at(nearest_feet(parabola, coordinates(circle->centre[0], circle->centre[1])), 0.5);
  CHECK(level.multiplicity == 2);
  CHECK(level.before == level.after);
  CHECK_FALSE(level.is_minimum());
  CHECK_FALSE(level.is_maximum());
  // Off by 2^-100 along the normal: two simple roots, or none.
  for (const int side : {-1, 1}) {
    const Rational t = 1 + side * two_to(-100);
    const Rational x = Rational(1, 2) + t * (circle->centre[0] - Rational(1, 2)),
                   y = Rational(1, 4) + t * (circle->centre[1] - Rational(1, 4));
    CHECK(foot_at(nearest_feet(parabola, coordinates(x, y)), 0.5).multiplicity == 1);
  }
  // The same at a joint where the curve goes on as it is: the double root is listed, though the distance only levels off.
  const Curve_2 cut = joined_curve<2>({bezier_2({{-1, 1}, {"-1/4", "-1/2"}, {"1/2", "1/4"}}).pieces()[0],
                                       bezier_2({{"1/2", "1/4"}, {1, "3/4"}, {"3/2", "9/4"}}).pieces()[0]},
                                      {locus::detail::finite_range(0, 3), locus::detail::finite_range(3, 5)}, false);
  REQUIRE(cut.chain().joints[0].order == Joint::any_order);
  const Curve_foot at_joint = foot_at(nearest_feet(cut, coordinates(circle->centre[0], circle->centre[1])), 3);
  CHECK(at_joint.multiplicity == 2);
  CHECK(at_joint.before == at_joint.after);
  CHECK(at_joint.before != 0);
  // Random curves: osculating circles of rational parameters.
  locus_test::Random random(4);
  locus_test::Samples samples;
  for (int i = 0; i < 40; ++i) {
    const Curve_2 curve = random_bezier(random, random.between(2, 5), i % 2 == 0);
    const Rational u = Rational(random.between(1, 63)) / 64;
    const auto osculating = osculating_circle(curve, u);
    if (!osculating) continue;
    const Nearest_feet result = nearest_feet(curve, coordinates(osculating->centre[0], osculating->centre[1]));
    bool found = false;
    for (const Curve_foot& foot : result.feet)
      found = found || (foot.place.lo <= u && u <= foot.place.hi && (foot.multiplicity >= 2 || foot.is_whole_piece));
    samples.expect(found && feet_are_true(curve, osculating->centre, result), [&] { return locus_test::show_curve(curve); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 30);
}

TEST_CASE("a polynomial curve's or a hyperbola's branches to infinity have no foot there", "[distance]")
{
  const Curve_2 hyperbola = monomial_curve<2>({{{0, 0, 1}, {1}}}, {0, 1}, {});
  const Nearest_feet result = nearest_feet(hyperbola, {0, 0});
  CHECK(result.feet.size() == 2u);
  CHECK(result.nearest.size() == 2u);
  CHECK(result.distance.lo <= std::sqrt(2.0));
  CHECK(result.distance.hi >= std::sqrt(2.0));
  CHECK(nearest_feet(line_2({1, 1}, {3, 4}), {1, 1}).is_on_curve());
  CHECK(nearest_feet(line_2({1, 1}, {3, 4}), {1001, -749}).feet.size() == 1u);
  CHECK(nearest_feet(ray_2({0, 0}, {1, 0}), {-1, 1}).nearest == std::vector<std::size_t>{0});
}

TEST_CASE("squared distances are algebraic numbers", "[distance]")
{
  const Curve_2 parabola = monomial_curve<2>({{{0, 1}, {0, 0, 1}}}, {}, {});
  const Nearest_feet result = nearest_feet(parabola, {0, 1}); // u² = 1/2, squared distance 3/4
  REQUIRE(result.nearest.size() == 2u);
  for (const std::size_t i : result.nearest) CHECK(squared_distance(parabola, {0, 1}, result.feet[i]).compare(Rational(3, 4)) == 0);
  // From (3, 0): 2u³ + u - 3 = 0, u = 1, rational but not found as such for certain.
  const Nearest_feet other = nearest_feet(parabola, {3, 0});
  REQUIRE(other.feet.size() == 1u);
  CHECK(squared_distance(parabola, {3, 0}, other.feet[0]).compare(5) == 0);
  // The root of a cubic without rational ones: the Range agrees.
  const Nearest_feet cubic = nearest_feet(parabola, {1, 0});
  const Algebraic_number t = squared_distance(parabola, {1, 0}, cubic.feet[0]);
  CHECK(degree(t.polynomial()) == 3);
  CHECK(std::abs(std::sqrt(t.to_double()) - cubic.distance.lo) < 1e-14);
  const Nearest_feet on = nearest_feet(parabola, {2, 4});
  CHECK(squared_distance(parabola, {2, 4}, on.feet[on.nearest[0]]).compare(0) == 0);
}

TEST_CASE("huge and tiny coordinates", "[distance]")
{
  const Nearest_feet huge = nearest_feet(segment_2({"1e200", 0}, {"1e200", "1e200"}), {0, "5e199"});
  CHECK(huge.distance.lo <= 1e200);
  CHECK(huge.distance.hi >= 1e200);
  CHECK(huge.distance.hi <= 1.000001e200);
  const Nearest_feet tiny = nearest_feet(segment_2({"1e-200", 0}, {"1e-200", "1e-200"}), {0, "5e-201"});
  CHECK(tiny.distance.lo <= 1e-200);
  CHECK(tiny.distance.hi >= 1e-200);
  CHECK(tiny.distance.lo >= 0.999999e-200);
  const Nearest_feet least = nearest_feet(segment_2({"1e-400", 0}, {"1e-400", 1}), {0, "1/2"});
  CHECK_FALSE(least.is_on_curve());
  CHECK(least.distance.lo == 0.0);
  CHECK(locus_test::thrown<Unsupported_feature>([] { nearest_feet(segment_2({"1e400", 0}, {"1e400", 1}), {0, 0}); }) == 1);
}

TEST_CASE("feet of random curves against dense sampling", "[distance]")
{
  locus_test::Random random(5);
  locus_test::Samples samples;
  for (int i = 0; i < 700; ++i) {
    const Curve_2 curve = random_curve(random);
    const Coordinates_2 q = random_point(random);
    const Nearest_feet result = nearest_feet(curve, q);
    const Sampler sampler(curve, q);
    const auto report = [&] { return described(curve, q); };
    const double least = sampler.least();
    samples.expect(near(least, result.distance.lo) && result.distance.lo <= least + 1e-12 * (100 + least), report);
    samples.expect(feet_are_true(curve, q.exact(), result), report);
    // Every minimum that samples show inside a piece is one of the feet.
    for (std::size_t k = 0; k < curve.pieces().size(); ++k)
      for (const double d : sampler.minima(k)) {
        const bool found = std::any_of(result.feet.begin(), result.feet.end(), [&](const Curve_foot& f) { return near(d, f.distance.lo); });
        const bool at_joint = (sampler.is_finite(k, 0) && near(d, sampler.distance(k, 0))) ||
                              (sampler.is_finite(k, 1) && near(d, sampler.distance(k, 1)));
        samples.expect(found || at_joint, report);
      }
    for (std::size_t k = 0; k < result.feet.size(); ++k) {
      const bool is_nearest = std::find(result.nearest.begin(), result.nearest.end(), k) != result.nearest.end();
      const Range& d = result.feet[k].distance;
      samples.expect(is_nearest
                       ? d.lo <= result.distance.hi && result.distance.lo <= d.hi && result.feet[k].is_minimum()
                       : d.hi >= result.distance.lo,
                     report);
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 5000);
}

TEST_CASE("feet are the same in every rounding mode", "[distance]")
{
  locus_test::Random random(6);
  for (int i = 0; i < 20; ++i) {
    const Curve_2 curve = random_curve(random);
    const Coordinates_2 q = random_point(random);
    const Nearest_feet expected = nearest_feet(curve, q);
    for (const int mode : locus_test::rounding_modes) {
      Nearest_feet found;
      locus_test::in_mode(mode, [&] { found = nearest_feet(curve, q); });
      CHECK(found.nearest == expected.nearest);
      REQUIRE(found.feet.size() == expected.feet.size());
      for (std::size_t k = 0; k < found.feet.size(); ++k) {
        CHECK(found.feet[k].distance.lo <= expected.feet[k].distance.hi);
        CHECK(expected.feet[k].distance.lo <= found.feet[k].distance.hi);
        CHECK(found.feet[k].multiplicity == expected.feet[k].multiplicity);
      }
    }
  }
}

// ------------------------------------------------------------------------------------------ nearer to point or curve

TEST_CASE("nearer to the point or to the curve, against dense sampling and the feet", "[nearer]")
{
  locus_test::Random random(7);
  locus_test::Samples samples;
  std::array<int, 3> count{};
  for (int i = 0; i < 400; ++i) {
    const Curve_2 curve = random_curve(random);
    const Coordinates_2 p = random_point(random);
    const Point_or_curve query(p, curve);
    for (int k = 0; k < 5; ++k) {
      const Coordinates_2 q = random_point(random);
      const Exact_point<2> a = p.exact(), b = q.exact();
      const Nearer found = query(q);
      ++count[static_cast<std::size_t>(found)];
      const Rational dx = a[0] - b[0], dy = a[1] - b[1];
      const double to_point = std::hypot(dx.get_d(), dy.get_d());
      const double to_curve = Sampler(curve, q).least(200);
      const auto report = [&] { return described(curve, q) + " p = (" + a[0].get_str() + ", " + a[1].get_str() + ")"; };
      if (!near(to_point, to_curve)) samples.expect(found == (to_point < to_curve ? Nearer::point : Nearer::curve), report);
      const Range exactly = nearest_feet(curve, q).distance;
      if (to_point * (1 + 1e-14) < exactly.lo) samples.expect(found == Nearer::point, report);
      if (to_point > exactly.hi * (1 + 1e-14)) samples.expect(found == Nearer::curve, report);
      samples.expect(nearer(q, p, curve) == found, report);
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 5000);
  CHECK(count[0] > 100);
  CHECK(count[1] > 100);
}

TEST_CASE("on the bisector neither is nearer, and beside it by 2^-60 it is decided", "[nearer]")
{
  locus_test::Random random(8);
  locus_test::Samples samples;
  int equal = 0;
  for (int i = 0; i < 300; ++i) {
    const Curve_2 curve = random_bezier(random, random.between(1, 5), i % 2 == 0);
    const Coordinates_2 p = random_point(random);
    const Exact_point<2> a = p.exact();
    const Rational u = random.unit_rational();
    // The point of r's normal as far from p as from r: r + λn with λ = -|r-p|²/(2n·(r-p)).
    const auto& piece = curve.pieces()[0];
    const auto r = locus_test::derivatives_at(piece, locus::detail::finite_range(0, 1), false,
                                              1)[0]; // at u = 0, to see that it is the curve's
    samples.expect(r == locus_test::local_point(piece, Rational(0)), "start");
    const auto at = locus_test::local_point(piece, u);
    std::array<Rational, 2> velocity;
    const Polynomial w = in_powers(piece.weight);
    for (std::size_t v = 0; v < 2; ++v) {
      const Polynomial x = in_powers(piece.numerator[v]);
      velocity[v] = locus_test::horner(slope(x), u) * locus_test::horner(w, u) - locus_test::horner(x, u) * locus_test::horner(slope(w), u);
    }
    const Rational dx = at[0] - a[0], dy = at[1] - a[1], across = -velocity[1] * dx + velocity[0] * dy;
    if (across == 0) continue;
    const Rational factor = -(dx * dx + dy * dy) / (2 * across);
    const Rational qx = at[0] - factor * velocity[1], qy = at[1] + factor * velocity[0];
    const Coordinates_2 q = coordinates(qx, qy);
    const auto report = [&] { return described(curve, q) + " p = (" + a[0].get_str() + ", " + a[1].get_str() + ")"; };
    const Point_or_curve query(p, curve);
    const Nearest_feet feet = nearest_feet(curve, q);
    bool touches = false;
    for (const std::size_t k : feet.nearest) touches = touches || (feet.feet[k].place.lo <= u && u <= feet.feet[k].place.hi);
    samples.expect(query(q) == (touches ? Nearer::equal : Nearer::curve), report);
    if (!touches) continue;
    ++equal;
    const Rational t = two_to(-60);
    samples.expect(query(coordinates(Rational(qx + t * (a[0] - qx)), Rational(qy + t * (a[1] - qy)))) == Nearer::point, report);
    samples.expect(query(coordinates(Rational(qx - t * (a[0] - qx)), Rational(qy - t * (a[1] - qy)))) == Nearer::curve, report);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  CHECK(equal > 50);
}

TEST_CASE("equality at places that are special", "[nearer]")
{
  // Two feet of y = x² at the irrational u² = 3/4, at distance 1 from (0, 5/4).
  const Curve_2 parabola = monomial_curve<2>({{{0, 1}, {0, 0, 1}}}, {}, {});
  CHECK(nearer({0, "5/4"}, {1, "5/4"}, parabola) == Nearer::equal);
  CHECK(nearer({0, "5/4"}, {"3/5", "41/20"}, parabola) == Nearer::equal);
  CHECK(nearer({0, "5/4"}, coordinates(Rational(1 + two_to(-70)), Rational(5, 4)), parabola) == Nearer::curve);
  CHECK(nearer({0, "5/4"}, coordinates(Rational(1 - two_to(-70)), Rational(5, 4)), parabola) == Nearer::point);
  // The focus and the directrix.
  CHECK(nearer({0, 0}, {0, "1/4"}, line_2({0, "-1/4"}, {1, 0})) == Nearer::equal);
  CHECK(nearer({2, 4}, {0, "1/4"}, line_2({0, "-1/4"}, {1, 0})) == Nearer::equal);
  // An end, a corner, a circle all along, the curve's own point, and the point itself.
  CHECK(nearer({-1, 1}, {-2, 2}, ray_2({0, 0}, {1, 0})) == Nearer::equal);
  CHECK(nearer({3, -1}, {4, -2}, polyline_2({{0, 0}, {2, 0}, {2, 2}})) == Nearer::equal);
  CHECK(nearer({0, 0}, {"3/5", "4/5"}, circle_2({0, 0}, 1)) == Nearer::equal);
  CHECK(nearer({0, 0}, {"3/5", "5/5"}, circle_2({0, 0}, 1)) == Nearer::curve);
  CHECK(nearer({0, 0}, {"3/5", "3/5"}, circle_2({0, 0}, 1)) == Nearer::point);
  CHECK(nearer({1, 1}, {1, 1}, parabola) == Nearer::equal);
  CHECK(nearer({1, 2}, {1, 2}, parabola) == Nearer::point);
  CHECK(nearer({1, 1}, {1, 2}, parabola) == Nearer::curve);
  // With p on the curve: along the normal up to the centre of curvature.
  CHECK(nearer({0, "1/2"}, {0, 0}, parabola) == Nearer::equal);
  CHECK(nearer({0, "501/1000"}, {0, 0}, parabola) == Nearer::curve);
  CHECK(nearer({"1/1000", "1/4"}, {0, 0}, parabola) == Nearer::curve);
}

TEST_CASE("the answer does not depend on the size of the numbers", "[nearer]")
{
  locus_test::Random random(9);
  locus_test::Samples samples;
  for (int i = 0; i < 60; ++i) {
    const int degree = random.between(1, 4);
    std::vector<std::array<int, 2>> points;
    for (int k = 0; k < degree + 3; ++k) points.push_back({random.between(-9, 9), random.between(-9, 9)});
    const auto asked = [&](const Rational& scale, const Rational& shift) {
      std::vector<Coordinates_2> at;
      for (const auto& p : points) at.push_back(coordinates(Rational(scale * p[0] + shift), Rational(scale * p[1])));
      const Coordinates_2 p = at.back(), q = at[at.size() - 2];
      at.erase(at.end() - 2, at.end());
      const Curve_2 curve = bezier_2(at);
      return std::pair(nearer(q, p, curve), nearest_feet(curve, q).nearest.size());
    };
    if (points[0] == points[1]) continue;
    const auto expected = asked(1, 0);
    for (const int e : {-1000, -300, 300, 900})
      for (const Rational& shift : {Rational(0), two_to(1000)})
        samples.expect(asked(two_to(e), shift) == expected, "scaled");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 300);
}
