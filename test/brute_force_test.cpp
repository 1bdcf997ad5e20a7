// SPDX-License-Identifier: LGPL-3.0-or-later
// The reduced forms of curvature, evolute and torsion against the unreduced ones: degrees as Chen, Riesenfeld and Cohen
// count them, identities of polynomials, and the roots of the brute-force form, which CGAL's univariate kernel isolates.

// gcc 12 warns falsely of CGAL's reference counts, from the optimiser and so not at their place.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif

#ifndef CGAL_USE_GMP
#define CGAL_USE_GMP 1
#endif
#ifndef CGAL_USE_MPFR
#define CGAL_USE_MPFR 1
#endif
#ifndef CGAL_USE_CORE
#define CGAL_USE_CORE 1
#endif
#include <CGAL/CORE_BigInt.h>

#include <CGAL/Algebraic_kernel_d_1.h>

#include <locus/constraint/brute_force.h>
#include <locus/constraint/curvature_forms.h>
#include <locus/shape/constructors_2.h>

#include "support.h"

#include <catch2/catch.hpp>

#include <iostream>
#include <optional>

using namespace locus;
using locus_test::Random;
using locus_test::Samples;
using Form = Bernstein<Rational, 1>;

namespace {

// ------------------------------------------------------------------------------------------------- the exact kernel

/// The real roots of a polynomial with their multiplicities, without the library.
class Kernel_roots {
public:
  explicit Kernel_roots(const Integer_polynomial& f) { Kernel().solve_1_object()(made(f), std::back_inserter(roots_)); }

  std::size_t size() const { return roots_.size(); }
  int multiplicity(std::size_t i) const { return static_cast<int>(roots_[i].second); }
  bool is_within(std::size_t i, const Rational& lo, const Rational& hi) const
  {
    return roots_[i].first >= made(lo) && roots_[i].first <= made(hi);
  }
  bool is_root_of(std::size_t i, const Integer_polynomial& f) const
  {
    return Kernel().sign_at_1_object()(made(f), roots_[i].first) == CGAL::ZERO;
  }

private:
  using Integer_type = CORE::BigInt;
  using Kernel = CGAL::Algebraic_kernel_d_1<Integer_type>;

  static Integer_type made(const Integer& x) { return Integer_type(x.get_str()); }
  static Kernel::Bound made(const Rational& x) { return Kernel::Bound(made(x.get_num()), made(x.get_den())); }
  static Kernel::Polynomial_1 made(const Integer_polynomial& f)
  {
    std::vector<Integer_type> c;
    for (const Integer& x : f) c.push_back(made(x));
    return Kernel::Polynomial_1(c.begin(), c.end());
  }

  std::vector<std::pair<Kernel::Algebraic_real_1, Kernel::Multiplicity_type>> roots_;
};

// --------------------------------------------------------------------------------------------------- curve pieces

/// A piece with numbers from the generator: a polynomial one has no weights.
template <int Dim>
Curve_piece<Dim> random_piece(Random& random, int degree, bool rational)
{
  for (;;) {
    std::vector<Exact_point<Dim>> points;
    std::vector<Rational> weights;
    for (int i = 0; i <= degree; ++i) {
      Exact_point<Dim> p;
      for (Rational& x : p) x = random.between(-20, 20);
      points.push_back(p);
      if (rational) weights.emplace_back(random.between(1, 6));
    }
    try {
      const Curve_piece<Dim> piece = bezier_curve<Dim>(points, weights).pieces()[0];
      if (piece.degree() == degree && piece.is_polynomial() != rational) return piece;
    } catch (const Invalid_input&) { // one point, again and again
    }
  }
}

/// One that is no straight line.
Curve_piece<2> curved_piece(Random& random, int degree, bool rational)
{
  for (;;) {
    const auto piece = random_piece<2>(random, degree, rational);
    if (!locus::detail::is_zero(wronskian(Derivative_vectors<2>(piece).homogeneous()))) return piece;
  }
}

/// The piece with these coefficients of 1, t, t², …; no denominator is a constant one.
Curve_piece<2> monomial_piece(std::vector<Rational> x, std::vector<Rational> y, std::vector<Rational> w = {})
{
  const bool polynomial = w.empty();
  const std::size_t n = std::max(std::max(x.size(), y.size()), w.size());
  x.resize(n, Rational(0));
  y.resize(n, Rational(0));
  w.resize(polynomial ? 1 : n, Rational(polynomial ? 1 : 0));
  return {{from_monomial(x), from_monomial(y)}, from_monomial(w)};
}

/// The same polynomial, whatever degrees it is written with.
bool same(const Form& f, const Form& g)
{
  const Form difference = subtract(f, g);
  return std::all_of(difference.coefficients().begin(), difference.coefficients().end(), [](const Rational& c) { return c == 0; });
}

Form power(const Form& f, int n)
{
  Form p(Degrees<1>{0}, {Rational(1)});
  for (int i = 0; i < n; ++i) p = multiply(p, f);
  return p;
}

Form product(const Form& f, const Form& g) { return multiply(f, g); }
template <class... More>
Form product(const Form& f, const Form& g, const More&... more)
{
  return product(multiply(f, g), more...);
}

// What the brute-force form of (κ²)' has beside β·critical.
constexpr int left_in_weight = 29, left_in_speed = 2;

} // namespace

// -------------------------------------------------------------------------------------------------------- degrees

TEST_CASE("unreduced arithmetic keeps the degrees that the rules give", "[brute_force]")
{
  const auto scalar = [](Form top, const Form& bottom) { return Unreduced_scalar({std::move(top)}, bottom); };
  const Form one(Degrees<1>{0}, {Rational(1)}), linear(Degrees<1>{1}, {Rational(1), Rational(2)}), square = multiply(linear, linear);
  const auto a = scalar(square, linear), b = scalar(one, square), c = scalar(square, one);
  CHECK(a.degree() == 2);
  CHECK(b.degree() == 2); // the numerator is raised to the denominator's degree
  CHECK(add(b, c).degree() == 4);
  CHECK(add(b, multiply(b, Rational(3))).degree() == 2);       // one and the same denominator
  CHECK(add(b, scalar(one, square)).degree() == 4);            // equal by chance: not known
  CHECK(multiply(b, b).degree() == 4);
  CHECK(divide(b, b).degree() == 4);
  CHECK(derivative(b).degree() == 4);
  CHECK(derivative(c).degree() == 1);
  CHECK(derivative(derivative(derivative(c))).degree() == 0);
  CHECK(add(c, c).degree() == 2);
  CHECK(divide(c, scalar(square, one)).degree() == 2);
  CHECK(subtract(b, b).degree() == 2); // zero, but nobody looks
  CHECK_THROWS_AS(divide(b, subtract(b, b)), std::domain_error);
  CHECK_THROWS_AS(scalar(one, Form(Degrees<1>{0})), std::domain_error);
  // (1/s)' = -s'/s², by values.
  const auto slope = derivative(scalar(one, linear));
  const Rational u(1, 3), value = evaluate_at(slope.numerator()[0], u) / evaluate_at(slope.denominator(), u);
  CHECK(value == Rational(-9, 16));
}

TEST_CASE("the paper's degrees come out of plane curves", "[brute_force]")
{
  Random random(1);
  for (int d = 2; d <= 4; ++d)
    for (const bool rational : {false, true}) {
      INFO((rational ? "rational, degree " : "polynomial, degree ") << d);
      const auto piece = curved_piece(random, d, rational);
      const auto count = [&](int of_polynomial, int of_rational) { return rational ? of_rational : of_polynomial; };
      CHECK(brute_force::inflections(piece).degree() == count(2 * d - 3, 6 * d));
      const auto squared = brute_force::squared_curvature(piece);
      CHECK(squared.degree() == count(6 * d - 6, 24 * d));
      CHECK(derivative(squared).degree() == count(12 * (d - 1), 48 * d));
      CHECK(brute_force::critical(piece).degree() == count(4 * d - 6, 26 * d));
      CHECK(brute_force::evolute(piece).degree() == count(3 * d - 3, 13 * d));
      CHECK(paper_form::inflections(piece).degree() == count(2 * d - 3, 3 * d - 3));
      CHECK(paper_form::critical(piece).degree() == count(4 * d - 6, 9 * d - 6));
      CHECK(paper_form::evolute(piece).degree() == count(3 * d - 3, 6 * d - 3));
      // What is left of them, or less by chance.
      const Curvature_forms<2> forms(piece);
      CHECK(forms.bend[0].degree() <= count(2 * d - 4, 3 * d - 6));
      CHECK(forms.critical.degree() <= count(4 * d - 7, 8 * d - 12));
    }
}

TEST_CASE("the paper's degrees come out of space curves", "[brute_force]")
{
  Random random(2);
  for (int d = 2; d <= 4; ++d) {
    INFO("degree " << d);
    const auto piece = random_piece<3>(random, d, true);
    CHECK(brute_force::triple_product(piece).degree() == 14 * d);
    CHECK(brute_force::torsion(piece).degree() == 26 * d);
    CHECK(paper_form::torsion(piece).degree() == 6 * d - 6);
    const auto polynomial = random_piece<3>(random, d, false);
    CHECK(brute_force::triple_product(polynomial).degree() == 3 * d - 6);
    CHECK(brute_force::torsion(polynomial).degree() == 4 * d - 6);
    CHECK(paper_form::torsion(polynomial).degree() == 3 * d - 6);
  }
}

TEST_CASE("an ellipse and cubics have the paper's numbers of control points", "[brute_force]")
{
  const auto points = [](const Curve_2& curve, auto degree) {
    std::size_t n = 0;
    for (const auto& piece : curve.pieces()) n += static_cast<std::size_t>(degree(piece)) + 1;
    return n;
  };
  const auto squared = [](const Curve_piece<2>& piece) { return derivative(brute_force::squared_curvature(piece)).degree(); };
  const auto reduced = [](const Curve_piece<2>& piece) { return paper_form::critical(piece).degree(); };
  const Curve_2 ellipse = ellipse_2({1, 2}, 4, 2);
  REQUIRE(ellipse.pieces().size() == 4u);
  CHECK(squared(ellipse.pieces()[0]) == 96);
  CHECK(points(ellipse, squared) == 388u);
  CHECK(reduced(ellipse.pieces()[0]) == 12);
  CHECK(points(ellipse, reduced) == 52u);
  CHECK(points(ellipse, [](const Curve_piece<2>& p) { return brute_force::evolute(p).degree(); }) == 108u);
  CHECK(points(ellipse, [](const Curve_piece<2>& p) { return paper_form::evolute(p).degree(); }) == 40u);

  Random random(3);
  const auto cubic = curved_piece(random, 3, false), rational = curved_piece(random, 3, true);
  CHECK(squared(cubic) == 24);
  CHECK(reduced(cubic) == 6);
  CHECK(squared(rational) == 144);
  CHECK(reduced(rational) == 21);
}

// ----------------------------------------------------------------------------------------------------- identities

TEST_CASE("what brute force leaves in the plane forms is known, factor by factor", "[brute_force]")
{
  Random random(4);
  for (int k = 0; k < 12; ++k) {
    const int d = 2 + k / 2 % 2;
    const auto piece = curved_piece(random, k < 8 ? d : 4, k < 8 && k % 2);
    INFO("sample " << k);
    const Curvature_forms<2> forms(piece);
    const Form &w = forms.weight, &bend = forms.bend[0], &speed = forms.speed;
    // N = w¹⁸β² and D = w¹²S³ make N'D - ND'.
    const auto squared = brute_force::squared_curvature(piece);
    CHECK(same(squared.numerator()[0], product(power(w, 18), bend, bend)));
    CHECK(same(squared.denominator(), product(power(w, 12), power(speed, 3))));
    CHECK(same(derivative(squared).numerator()[0],
               multiply(product(bend, forms.critical, power(w, left_in_weight), power(speed, left_in_speed)), Rational(2))));
    CHECK(same(brute_force::inflections(piece).numerator()[0], product(power(w, 3), bend)));
    CHECK(same(paper_form::inflections(piece), bend));
    CHECK(same(paper_form::critical(piece), multiply(w, forms.critical)));
    // g0 = critical/w⁸.
    const auto direct = brute_force::critical(piece);
    CHECK(same(product(direct.numerator()[0], power(w, 8)), multiply(direct.denominator(), forms.critical)));
  }
}

TEST_CASE("brute-force evolutes and the paper's are one map", "[brute_force]")
{
  Random random(5);
  for (int k = 0; k < 12; ++k) {
    const auto piece = curved_piece(random, 2 + k / 2 % 3, k % 2 == 1);
    INFO("sample " << k);
    const auto brute = brute_force::evolute(piece), reduced = paper_form::evolute(piece);
    for (std::size_t v = 0; v < 2; ++v)
      CHECK(same(multiply(brute.numerator()[v], reduced.denominator()), multiply(reduced.numerator()[v], brute.denominator())));
  }
}

TEST_CASE("a straight line has no evolute", "[brute_force]")
{
  const Curve_2 line = segment_2({0, 0}, {3, 1});
  CHECK(brute_force::inflections(line.pieces()[0]).degree() <= 0);
  CHECK(brute_force::squared_curvature(line.pieces()[0]).degree() == 0);
  CHECK_THROWS_AS(brute_force::evolute(line.pieces()[0]), std::domain_error);
}

TEST_CASE("brute-force torsion is the reduced one", "[brute_force]")
{
  Random random(6);
  for (int k = 0; k < 4; ++k) {
    const auto piece = random_piece<3>(random, 3 + k / 2, k % 2 == 1);
    INFO("sample " << k);
    const Derivative_vectors<3> x(piece);
    const auto minors = wronskian_minors(x.homogeneous());
    const Polynomial_vector<1, 3> bend{minors[0], minors[1], minors[2]};
    const Form w = piece.weight, torsion = torsion_form(piece);
    CHECK(same(brute_force::triple_product(piece).numerator()[0], multiply(torsion, power(w, 10))));
    CHECK(same(paper_form::torsion(piece), product(torsion, w, w)));
    const auto brute = brute_force::torsion(piece);
    CHECK(same(brute.numerator()[0], multiply(torsion, power(w, 22))));
    CHECK(same(brute.denominator(), multiply(square(bend), power(w, 20))));
  }
}

// ----------------------------------------------------------------------------------------------------------- roots

namespace {

/// A reduced form, its roots on the unit interval as the library finds them, and how often each is one of the brute-force
/// form per multiplicity.
struct Factor {
  Integer_polynomial form;
  std::vector<Isolated_root<Rational>> roots;
  int left;
  std::vector<bool> matched;

  Factor(const Form& f, int times) : left(times)
  {
    const Bernstein<Scaled_integer, 1> exact(f);
    form = monomial_form(exact);
    roots = exact_roots(exact, Rational(0), Rational(1)).roots;
    matched.assign(roots.size(), false);
  }
};

struct Counts {
  std::size_t curves = 0, pieces = 0, vanishing = 0;
  std::size_t roots = 0, critical = 0, inflections = 0, others = 0, multiple = 0;
  Samples explained, found;

  std::string text() const
  {
    return std::to_string(curves) + " curves, " + std::to_string(pieces) + " pieces: " + std::to_string(roots) + " roots by brute force, " +
           std::to_string(critical) + " critical, " + std::to_string(inflections) + " inflections, " + std::to_string(others) +
           " of w or S, " + std::to_string(multiple) + " multiple; " + std::to_string(vanishing) + " forms vanish identically";
  }
};

/// The multiplicity in a factor of a root that the kernel found, by the only one of the factor's isolating intervals that
/// has it and the exact sign there.
int multiplicity_in(Factor& factor, const Kernel_roots& roots, std::size_t i)
{
  for (std::size_t k = 0; k < factor.roots.size(); ++k) {
    const auto& root = factor.roots[k];
    if (!roots.is_within(i, root.lo, root.hi) || !roots.is_root_of(i, factor.form)) continue;
    if (factor.matched[k]) return -1000; // two for one
    factor.matched[k] = true;
    return root.multiplicity;
  }
  return 0;
}

/// The roots on [0, 1] of the brute-force form of (κ²)', one by one, against those of the reduced forms.
void compare(Counts& counts, const Curve_piece<2>& piece)
{
  ++counts.pieces;
  const Curvature_forms<2> forms(piece);
  const Form brute = derivative(brute_force::squared_curvature(piece)).numerator()[0];
  if (locus::detail::is_zero(brute)) {
    ++counts.vanishing;
    counts.explained.expect(locus::detail::is_zero(forms.bend[0]) || locus::detail::is_zero(forms.critical), "the brute-force form alone vanishes");
    return;
  }
  const Kernel_roots roots(monomial_form(Bernstein<Scaled_integer, 1>(brute)));
  std::vector<Factor> factors{{forms.critical, 1}, {forms.bend[0], 1}, {forms.weight, left_in_weight}, {forms.speed, left_in_speed}};
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (!roots.is_within(i, Rational(0), Rational(1))) continue;
    ++counts.roots;
    counts.multiple += roots.multiplicity(i) > 1;
    std::array<int, 4> times{};
    int sum = 0;
    for (std::size_t k = 0; k < factors.size(); ++k) {
      times[k] = multiplicity_in(factors[k], roots, i);
      sum += factors[k].left * times[k];
    }
    counts.critical += times[0] > 0;
    counts.inflections += times[1] > 0;
    counts.others += times[2] + times[3] > 0;
    const int multiplicity = roots.multiplicity(i);
    counts.explained.expect(sum == multiplicity, [&] {
      return "root " + std::to_string(i) + " of multiplicity " + std::to_string(multiplicity) + " on piece " + std::to_string(counts.pieces) +
             " is explained with " + std::to_string(sum);
    });
  }
  for (const Factor& factor : factors)
    for (const bool matched : factor.matched)
      counts.found.expect(matched, [&] { return "a root of a reduced form on piece " + std::to_string(counts.pieces) + " is none of the brute-force one"; });
}

void compare(Counts& counts, const Curve_2& curve)
{
  ++counts.curves;
  for (const auto& piece : curve.pieces()) compare(counts, piece);
}

void compare_random(Counts& counts, Random& random, int curves, int degree, bool rational)
{
  for (int k = 0; k < curves; ++k) {
    ++counts.curves;
    compare(counts, random_piece<2>(random, degree, rational));
  }
}

Curve_2 random_spline(Random& random, int spans)
{
  std::vector<Coordinates_2> points;
  std::vector<Number> knots(4, Number(0));
  for (int i = 0; i < 3 + spans; ++i) {
    const int x = random.between(-20, 20), y = random.between(-20, 20);
    points.push_back({x, y});
  }
  for (int s = 1; s < spans; ++s) knots.emplace_back(s);
  for (int i = 0; i < 4; ++i) knots.emplace_back(spans);
  return bspline_2(3, points, knots);
}

void require(const Counts& counts, int least = 1)
{
  LOCUS_REQUIRE_SAMPLES(counts.explained, least);
  LOCUS_REQUIRE_SAMPLES(counts.found, 0);
}

} // namespace

TEST_CASE("degenerate curves: every root of the squaring approach is known, with its multiplicity", "[brute_force]")
{
  const auto alone = [](const Curve_piece<2>& piece) {
    Counts counts;
    compare(counts, piece);
    require(counts);
    return counts;
  };
  const Rational half(1, 2), shift(1, 3);
  // y = (t-1/2)⁴, flat and symmetric; y = (t-1/3)⁵, an inflection where κ' vanishes as well.
  const Counts flat = alone(monomial_piece({0, 1}, {Rational(1, 16), -half, Rational(3, 2), -2, 1}));
  CHECK(flat.multiple == 1u);
  const auto fifth = locus_test::with_roots(std::vector<Rational>(5, shift));
  const Counts deep = alone(monomial_piece({0, 1}, fifth));
  CHECK(deep.critical == 2u);
  CHECK(deep.inflections == 1u);
  CHECK(deep.multiple == 1u);
  // At an end: y = t⁴ and t⁵.
  CHECK(alone(monomial_piece({0, 1}, {0, 0, 0, 0, 1})).multiple == 1u);
  CHECK(alone(monomial_piece({0, 1}, {0, 0, 0, 0, 0, 1})).multiple == 1u);
  // Cusps: S vanishes.
  CHECK(alone(monomial_piece({0, 0, 1}, {0, 0, 0, 1})).others == 1u);
  CHECK(alone(monomial_piece({Rational(1, 9), Rational(-2, 3), 1}, locus_test::with_roots(std::vector<Rational>(3, shift)))).others == 1u);
  // Poles: w vanishes at an end, between, twice.
  CHECK(alone(monomial_piece({1}, {0, 0, 1}, {0, 1})).others == 1u);
  CHECK(alone(monomial_piece({1, 1, 3}, {0, 2, 1}, {Rational(-1), 1, 4})).others == 1u);
  CHECK(alone(monomial_piece({1, 1, 3}, {0, 2, 1}, {Rational(1, 9), Rational(-2, 3), 1})).others == 1u);
  // A symmetric loop and a symmetric rational arch.
  alone(bezier_2({{-1, 0}, {3, 4}, {-3, 4}, {1, 0}}).pieces()[0]);
  alone(bezier_2({{-2, 0}, {-1, 3}, {1, 3}, {2, 0}}).pieces()[0]);
  alone(bezier_2({{-2, 0}, {0, 3}, {2, 0}}, {1, 3, 1}).pieces()[0]);
  // Lines and circles: everything vanishes.
  CHECK(alone(segment_2({0, 0}, {3, 1}).pieces()[0]).vanishing == 1u);
  CHECK(alone(arc_2({1, 0}, {0, 1}, "1/2").pieces()[0]).vanishing == 1u);
}

TEST_CASE("an ellipse has the four vertices by brute force as well", "[brute_force]")
{
  Counts counts;
  compare(counts, ellipse_2({1, 2}, 4, 2));
  require(counts);
  CHECK(counts.critical == 8u); // each joint from both sides
  CHECK(counts.roots == 8u);
}

TEST_CASE("2000 random curves: no root of the squaring approach is unexplained, and none of ours missing", "[brute_force]")
{
  struct Family {
    const char* name;
    int curves, degree;
    bool rational;
  };
  constexpr std::array<Family, 4> families{{{"polynomial cubics", 840, 3, false},
                                            {"polynomial quartics", 400, 4, false},
                                            {"rational quadratics", 320, 2, true},
                                            {"rational cubics", 40, 3, true}}};
  Random random(7);
  std::size_t curves = 0, critical = 0, inflections = 0;
  const auto finish = [&](const char* name, const Counts& counts, int least) {
    std::cerr << name << ": " << counts.text() << std::endl;
    require(counts, least);
    curves += counts.curves;
    critical += counts.critical;
    inflections += counts.inflections;
  };
  for (const Family& family : families) {
    Counts counts;
    compare_random(counts, random, family.curves, family.degree, family.rational);
    finish(family.name, counts, family.curves);
  }
  Counts splines;
  for (int k = 0; k < 400; ++k) compare(splines, random_spline(random, random.between(2, 5)));
  finish("cubic splines", splines, 400);
  CHECK(curves == 2000u);
  CHECK(critical >= 2000u);
  CHECK(inflections >= 200u);
}
