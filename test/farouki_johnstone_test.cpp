// SPDX-License-Identifier: LGPL-3.0-or-later
// The formulas and counts that Farouki & Johnstone (1994) print for the bisector of a point and a curve, and the
// self-intersections of untrimmed bisectors found in two ways.
//
// The formulas are identities in u, α, β (and k), proved by values: what the library computes for numbers α, β, k is a
// polynomial in u whose coefficients are polynomials in these, of a degree that is stated, and two such polynomials that agree
// on a grid which determines polynomials of that degree are one. Nothing lies on the curve on these grids.
#include <locus/construct/self_intersections.h>
#include <locus/shape/constructors_2.h>

#include "support.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <functional>

using namespace locus;
using namespace locus_test;

namespace {

using Piece_2 = Curve_piece<2>;
using Point = Exact_point<2>;

// ------------------------------------------------------------------------------------------------------------ polynomials

Polynomial scaled(Polynomial f, const Rational& c)
{
  for (Rational& x : f) x *= c;
  return trimmed(std::move(f));
}
Polynomial minus(const Polynomial& f, const Polynomial& g) { return trimmed(plus(f, scaled(g, -1))); }
Polynomial squared(const Polynomial& f) { return times(f, f); }

Polynomial powers(const Bernstein<Rational, 1>& f) { return trimmed(to_monomial(f)); }
Polynomial powers(const Integer_polynomial& f) { return trimmed(Polynomial(f.begin(), f.end())); }

bool are_proportional_forms(const Polynomial& f, const Polynomial& g)
{
  const Polynomial a = trimmed(f), b = trimmed(g);
  if (a.size() != b.size() || a.empty()) return false;
  return scaled(a, b.back()) == scaled(b, a.back());
}
bool are_proportional_forms(const Integer_polynomial& f, const Polynomial& g) { return are_proportional_forms(powers(f), g); }

bool divides(const Polynomial& g, const Polynomial& f) { return trimmed(remainder(f, g)).empty(); }

// ----------------------------------------------------------------------------------------------------------------- curves

/// The curve with these coefficients of 1, u, u², …: its local parameter is u itself.
Piece_2 in_powers_of_u(Polynomial x, Polynomial y, Polynomial w = {1})
{
  const std::size_t n = std::max({x.size(), y.size(), w.size()});
  Piece_2 piece;
  x.resize(n);
  y.resize(n);
  piece.numerator = {from_monomial(x), from_monomial(y)};
  if (w.size() > 1) w.resize(n);
  piece.weight = from_monomial(w);
  return piece;
}

/// The same for lo ≤ u ≤ hi, with a local parameter from 0 to 1.
Piece_2 between(Piece_2 piece, const Rational& lo, const Rational& hi)
{
  for (auto& x : piece.numerator) x = restrict_to(x, 0, lo, hi);
  piece.weight = restrict_to(piece.weight, 0, lo, hi);
  return piece;
}

Piece_2 parabola() { return in_powers_of_u({0, 1}, {0, 0, 1}); }
Piece_2 cubic() { return in_powers_of_u({0, 1}, {0, 0, 0, 1}); }
/// (42)
Piece_2 ellipse(const Rational& k) { return in_powers_of_u({1, 0, -1}, {0, Rational(2 * k)}, {1, 0, 1}); }

Self_intersection_polynomials eliminated(const Piece_2& piece, const Point& p)
{
  return self_intersection_polynomials(Self_intersection_forms(piece, p));
}

/// X_b, Y_b, W_b of (38) and (39) from the library's forms, which are relative to p and -2 times as large.
std::array<Polynomial, 3> untrimmed_bisector(const Piece_2& piece, const Point& p)
{
  const auto t = Point_curve_forms(piece, p).tangent();
  const Polynomial w = scaled(powers(t[2]), Rational(-1, 2));
  const auto coordinate = [&](std::size_t k) { return trimmed(plus(scaled(powers(t[k]), Rational(1, 2)), scaled(w, p[k]))); };
  return {coordinate(0), coordinate(1), w};
}

// ------------------------------------------------------------------------------------------------------------------ grids

/// Calls f for points (α, β) that determine polynomials of this total degree. None lies on y = x², y = x³, or an ellipse (42)
/// with a whole k: their denominators are 3 and 7.
void for_grid(int degree, const std::function<void(const Rational&, const Rational&)>& f)
{
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) f(Rational(i - degree / 3) + Rational(1, 3), Rational(j - degree / 3) + Rational(1, 7));
}

/// Values of k that determine polynomials of this degree.
std::vector<Rational> k_grid(int degree)
{
  std::vector<Rational> values;
  for (int k = 0; k <= degree; ++k) values.push_back(k + 2);
  return values;
}

// --------------------------------------------------------------------------------------------------- the printed formulas

struct Formulas {
  Rational a, b, k;
  Rational r = a * a + b * b; ///< α² + β²
  Rational m = 1 - k * k;

  // (40)
  Polynomial x_40() const { return times({0, 2}, {Rational(r - b), 0, Rational(-2 * b), 0, 1}); }
  Polynomial y_40() const { return {Rational(-r), Rational(2 * a), -1, Rational(4 * a), -3}; }
  Polynomial w_40() const { return {Rational(-2 * b), Rational(4 * a), -2}; }

  // (43)
  Polynomial x_43() const { return times({1, 0, -1}, p_88_2()); }
  Polynomial y_43() const { return times({0, 2}, p_88_1()); }
  Polynomial w_43() const { return scaled(times(squared({1, 0, 1}), {Rational(k * (a - 1)), Rational(2 * b), Rational(-k * (a + 1))}), 2); }

  Polynomial p_64() const { return {Rational(b - r), 0, Rational(6 * b), Rational(-8 * a), 3}; }
  Polynomial p_65() const
  {
    const Rational minus_a = -2 * m * a, plus_a = 2 * m * a;
    return scaled({Rational(r + minus_a + 1 - 2 * k * k), 0, Rational(3 * (r + plus_a - 3 + 2 * k * k)), Rational(16 * m * b / k),
                   Rational(3 * (r + minus_a - 3 + 2 * k * k)), 0, Rational(r + plus_a + 1 - 2 * k * k)}, k);
  }
  Polynomial p_85() const { return {Rational(r - b), 0, Rational(-2 * b), 0, 1}; }
  Polynomial p_88_1() const { return {Rational(r - 2 * m * a + 1 - 2 * k * k), 0, Rational(2 * (r - 1)), 0, Rational(r + 2 * m * a + 1 - 2 * k * k)}; }
  Polynomial p_88_2() const
  {
    const Rational end = k * (r - 1), side = 4 * m * b;
    return {end, side, Rational(2 * k * (r - 3 + 2 * k * k)), side, end};
  }

  // (89), at (α, β)
  Rational c_0() const { return (a - m) * (a - m) + b * b - k * k * k * k; }
  Rational c_infinite() const { return (a + m) * (a + m) + b * b - k * k * k * k; }
  Rational c_plus() const { return a * a + (b - k + 1 / k) * (b - k + 1 / k) - 1 / (k * k); }
  Rational c_minus() const { return a * a + (b + k - 1 / k) * (b + k - 1 / k) - 1 / (k * k); }
  /// (91)
  Rational discriminant() const { return 4 * m * (k * k - k * k * a * a - b * b); }

  // (96)
  Polynomial p_inf_96() const { return {b, 0, Rational(-3 * a), 2}; }
  Polynomial p_c_96() const { return {b, Rational(-3 * r), Rational(3 * a), -1, Rational(15 * b), 0, Rational(-27 * a), 15}; }

  Polynomial p_95() const
  {
    const Rational a2 = a * a, b2 = b * b, a4 = a2 * a2, b4 = b2 * b2, a6 = a4 * a2, b6 = b4 * b2, r2 = r * r, r3 = r2 * r;
    return {
      Rational(27 * r2 * r2 - 256 * b4),
      Rational(-72 * r * (3 * a * r2 - 16 * b2 * b)),
      Rational(12 * (9 * (7 * a6 - 3 * a4 * b2 - 27 * a2 * b4 - 17 * b6) + 64 * a * b2 * b)),
      Rational(4 * (243 * b * r3 - 54 * a * (7 * a4 + 22 * a2 * b2 + 15 * b4) - 224 * b2 * b)),
      Rational(18 * (324 * a * b * r2 + 105 * a4 + 210 * a2 * b2 + 41 * b4)),
      Rational(-36 * (99 * a * r3 + 3 * b * (81 * a4 + 50 * a2 * b2 - 31 * b4) + 2 * a * (21 * a2 - 19 * b2))),
      Rational(12 * (9 * (59 * a6 + 77 * a4 * b2 - 23 * a2 * b4 - 41 * b6) + 36 * a * b * (13 * a2 + 17 * b2) + 63 * a2 - 89 * b2)),
      Rational(-108 * (a * (57 * a4 + 290 * a2 * b2 + 233 * b4) + b * (57 * a2 + 41 * b2) + 2 * a)),
      Rational(9 * (2664 * a * b * r2 + 12 * (57 * a4 + 234 * a2 * b2 + 65 * b4) + 520 * a * b + 3)),
      Rational(-4 * (27 * b * (253 * a4 + 234 * a2 * b2 - 19 * b4) + 945 * a * r + 293 * b)),
      Rational(-36 * (108 * a2 * r2 - 24 * a * b * (29 * a2 + 45 * b2) - 7 * a2 + 5 * b2)),
      Rational(-12 * (27 * a * (5 * a4 + 186 * a2 * b2 + 181 * b4) + 18 * b * (117 * a2 + 85 * b2) - 53 * a)),
      Rational(2 * (27 * (79 * a4 + 894 * a2 * b2 + 303 * b4) + 5724 * a * b - 86)),
      Rational(36 * (432 * a2 * b * r + 12 * a * (7 * a2 - 57 * b2) - 43 * b)),
      Rational(108 * (36 * a * b * (5 * a2 + 17 * b2) - 31 * a2 + 101 * b2)),
      Rational(-108 * (b * (241 * a2 + 305 * b2) + a)),
      Rational(-54 * (144 * a2 * (a2 + 3 * b2) - 100 * a * b - 7)),
      Rational(108 * (3 * a * (11 * a2 - 101 * b2) - 5 * b)),
      Rational(108 * (23 * a2 + 235 * b2)),
      Rational(108 * a * (144 * a * b - 1)),
      Rational(540 * (6 * a * b - 1)),
      Rational(-8100 * b),
      Rational(-3888 * a2),
      Rational(1620 * a),
      675};
  }
};

Rational value_of(const Bivariate_polynomial& f, const Rational& u, const Rational& v)
{
  Rational sum = 0;
  for (std::size_t j = f.row.size(); j-- > 0;) sum = sum * v + horner(powers(f.row[j]), u);
  return sum;
}

/// The left-hand side of (79) from the coordinates themselves; of a rational curve with (WX' - W'X, WY' - W'Y) for (X', Y'), what
/// makes it homogeneous, and without the factor W(u).
class Printed_form {
public:
  Printed_form(const Piece_2& piece, Point p)
    : x_(powers(piece.numerator[0])), y_(powers(piece.numerator[1])), w_(powers(piece.weight)), p_(std::move(p)),
      nx_(minus(times(w_, slope(x_)), times(slope(w_), x_))), ny_(minus(times(w_, slope(y_)), times(slope(w_), y_)))
  {
  }

  Rational at(const Rational& u, const Rational& v) const
  {
    const auto zu = z(u), zv = z(v);
    const Rational wu = horner(w_, u), wv = horner(w_, v), xu = horner(x_, u), yu = horner(y_, u);
    const Rational xi = zu * wv * horner(ny_, v) - zv * wu * horner(ny_, u), yi = zv * wu * horner(nx_, u) - zu * wv * horner(nx_, v);
    const Rational wi = horner(nx_, u) * horner(ny_, v) - horner(nx_, v) * horner(ny_, u);
    return 2 * (p_[0] * wu - xu) * xi + 2 * (p_[1] * wu - yu) * yi +
           (xu * xu + yu * yu - (p_[0] * p_[0] + p_[1] * p_[1]) * wu * wu) * wv * wi;
  }

private:
  Rational z(const Rational& u) const { return horner(x_, u) * horner(nx_, u) + horner(y_, u) * horner(ny_, u); }

  Polynomial x_, y_, w_;
  Point p_;
  Polynomial nx_, ny_;
};

/// Whether (v - u)·R is (79) up to a number: both have degrees 4n-2 and 3n-2 at most, n ≤ 3.
bool is_printed_form(const Piece_2& piece, const Point& p)
{
  const Printed_form printed(piece, p);
  const Bivariate_polynomial r = Self_intersection_forms(piece, p).normal_form();
  const int n = piece.degree();
  Rational factor = 0;
  for (int i = 0; i <= 4 * n - 2; ++i)
    for (int j = 0; j <= 3 * n - 2; ++j) {
      const Rational u = i, v = j, left = (v - u) * value_of(r, u, v), right = printed.at(u, v);
      if (factor == 0 && right != 0) factor = left / right;
      if (left != factor * right) return false;
    }
  return factor != 0;
}

} // namespace

// =================================================================================================================== identities

TEST_CASE("Farouki and Johnstone (8): the bisector of a point and the unit circle is a conic")
{
  // (8) is of degree 4 in α and β, X_b, Y_b and W_b of 3, all together of 10 at most.
  const Piece_2 circle = ellipse(1);
  Samples samples;
  for_grid(10, [&](const Rational& a, const Rational& b) {
    const auto [x, y, w] = untrimmed_bisector(circle, {a, b});
    const Rational d = a * a + b * b - 1;
    Polynomial sum = scaled(squared(x), Rational(1 - a * a));
    sum = plus(sum, scaled(squared(y), Rational(1 - b * b)));
    sum = minus(sum, scaled(times(x, y), Rational(2 * a * b)));
    sum = plus(sum, times(scaled(w, d), plus(scaled(x, a), scaled(y, b))));
    sum = minus(sum, scaled(squared(w), Rational(d * d / 4)));
    samples.expect(!w.empty() && trimmed(sum).empty(), "b does not lie on (8)");
  });
  LOCUS_REQUIRE_SAMPLES(samples, 66);
}

TEST_CASE("Farouki and Johnstone (40), (64), (85): the parabola")
{
  // ℓ has degree 2 in α and β, so that X_b, Y_b and W_b have 3 and P_c has 4.
  Samples samples;
  for_grid(4, [&](const Rational& a, const Rational& b) {
    const Formulas f{a, b, 1};
    const auto [x, y, w] = untrimmed_bisector(parabola(), {a, b});
    samples.expect(x == f.x_40() && y == f.y_40() && w == f.w_40(), "(40)");
    // det(ℓ, ℓ', ℓ'') is -4 times (58), which is -2 times what is printed as (64).
    samples.expect(powers(Point_curve_forms(parabola(), {a, b}).circular_form()) == scaled(f.p_64(), 8), "(64)");
  });
  // (79) has degree 2 in α and β, the resultant of R and S 2·6; of that P_c³ takes 3·2. That Γ and (85) are proportional over
  // the rational functions of α and β is said by products of their coefficients, of degree 12 - 6 + 2.
  for_grid(8, [&](const Rational& a, const Rational& b) {
    const auto found = eliminated(parabola(), {a, b});
    const Formulas f{a, b, 1};
    samples.expect(is_printed_form(parabola(), {a, b}), "R of (79), (80)");
    samples.expect(degree(found.lambda) == 0 && are_proportional_forms(found.p_i, f.p_85()), "(85)");
    samples.expect(divides(f.p_85(), f.x_40()), "Remark 3.7");
  });
  LOCUS_REQUIRE_SAMPLES(samples, 30 + 135);
}

TEST_CASE("Farouki and Johnstone (43), (65): the ellipse")
{
  // In k, ρ and N are of degree 1, ℓ of 2, X_b, Y_b and W_b of 3, P_c of 4.
  Samples samples;
  for (const Rational& k : k_grid(4))
    for_grid(4, [&](const Rational& a, const Rational& b) {
      const Formulas f{a, b, k};
      const auto [x, y, w] = untrimmed_bisector(ellipse(k), {a, b});
      // A common factor 2 of (39) is left out in (43).
      samples.expect(x == scaled(f.x_43(), 2) && y == scaled(f.y_43(), 2) && w == scaled(f.w_43(), 2), "(43)");
      // (59) is of degree 8 here: in (65), which is of degree 6, its factor w is left out, and a number.
      samples.expect(powers(Point_curve_forms(ellipse(k), {a, b}).circular_form()) == scaled(f.p_65(), -32), "(65)");
    });
  LOCUS_REQUIRE_SAMPLES(samples, 5 * 15 * 2);
}

TEST_CASE("Farouki and Johnstone (88): self-intersections of the ellipse's bisector")
{
  // In α and β (79) has degree 2, the resultant 2·8, P_c³ 3·2 and both factors of (88) together 4: products of coefficients
  // have degree 16 - 6 + 4. In k these are 3, 3·8, 3·3 and 5, and the products' degree is 24 - 9 + 5.
  Samples samples;
  for (const Rational& k : k_grid(20))
    for_grid(14, [&](const Rational& a, const Rational& b) {
      const Formulas f{a, b, k};
      const auto found = eliminated(ellipse(k), {a, b});
      samples.expect(is_printed_form(ellipse(k), {a, b}), "R of (79), (80)");
      samples.expect(are_proportional_forms(found.p_i, times(f.p_88_1(), f.p_88_2())), "(88)");
      // Normals in common: both axes', of which one meets the curve at u = ∞.
      samples.expect(are_proportional_forms(found.lambda, {0, -1, 0, 1}), "Λ of the ellipse");
    });
  LOCUS_REQUIRE_SAMPLES(samples, 21 * 120 * 3);
}

TEST_CASE("Farouki and Johnstone (89) to (93): circles of curvature at the ellipse's vertices")
{
  Samples samples;
  for (const Rational& k : {Rational(1, 2), Rational(4, 5), Rational(3, 2), Rational(3)})
    for_grid(4, [&](const Rational& a, const Rational& b) {
      const Formulas f{a, b, k};
      const Polynomial first = f.p_88_1(), p_c = f.p_65();
      samples.expect(first[4] == f.c_infinite() && first[0] == f.c_0(), "(90)");
      samples.expect(f.discriminant() == (f.r - 1) * (f.r - 1) - f.c_infinite() * f.c_0(), "(91)");
      const Polynomial square = squared({Rational(k * (f.r - 1)), Rational(2 * f.m * b), Rational(k * (f.r - 1))});
      samples.expect(scaled(f.p_88_2(), k * (f.r - 1)) == trimmed(plus(square, {0, 0, f.discriminant()})), "(93)");
      // The circles are where a vertex is a circular point. C_+1 and C_-1 are printed with y² for y.
      samples.expect(p_c[0] == k * f.c_0() && horner(p_c, 1) == 8 * f.c_plus() * k && horner(p_c, -1) == 8 * f.c_minus() * k, "(89)");
    });
  LOCUS_REQUIRE_SAMPLES(samples, 4 * 15 * 4);
}

TEST_CASE("Farouki and Johnstone (95), (96): the cubic (u, u³)")
{
  Samples samples;
  for_grid(4, [&](const Rational& a, const Rational& b) { // degrees 1 and 4 at most
    const Formulas f{a, b, 1};
    const Point_curve_forms forms(cubic(), {a, b});
    samples.expect(powers(forms.class_form()) == f.p_inf_96(), "P_∞ of (96)");
    samples.expect(powers(forms.circular_form()) == scaled(f.p_c_96(), 8), "P_c of (96)");
  });
  // (79) has degree 2 in α and β, the resultant 2·11, P_c³ 3·2 and (95) 8: products of coefficients have degree 22 - 6 + 8.
  for_grid(24, [&](const Rational& a, const Rational& b) {
    const auto found = eliminated(cubic(), {a, b});
    samples.expect(is_printed_form(cubic(), {a, b}), "R of (79), (80)");
    samples.expect(are_proportional_forms(found.lambda, {1, 0, 0, 0, 3}), "Λ = 3u⁴ + 1");
    samples.expect(are_proportional_forms(found.p_i, Formulas{a, b, 1}.p_95()), "(95)");
  });
  LOCUS_REQUIRE_SAMPLES(samples, 15 * 2 + 325 * 3);
}

// ======================================================================================================================= degrees

namespace {

Polynomial random_polynomial(Random& random, int n)
{
  Polynomial f;
  for (int i = 0; i <= n; ++i) f.push_back(Rational(random.between(-40000, 40000)) / random.between(1, 5));
  return f;
}

Point random_point(Random& random) { return {Rational(random.between(-9000, 9000), 4096), Rational(random.between(-9000, 9000), 4096)}; }

std::vector<int> degrees_of_factors(const Integer_polynomial& f)
{
  std::vector<int> degrees;
  for (const Square_free_factor& part : square_free_decomposition(f))
    for (const Integer_polynomial& g : irreducible_factors(part.factor))
      for (int k = 0; k < part.multiplicity; ++k) degrees.push_back(degree(g));
  std::sort(degrees.begin(), degrees.end());
  return degrees;
}

} // namespace

TEST_CASE("Degrees of P_i and Λ")
{
  Random random(1);
  const auto all = [&](const Piece_2& piece) {
    const auto f = eliminated(piece, random_point(random));
    return std::vector<int>{degree(f.p_i), degree(f.lambda), degree(f.p_c), degree(f.p_inf), degree(f.gamma)};
  };
  using List = std::vector<int>;
  for (int m = 2; m <= 5; ++m) {
    const int p_i = (m - 1) * (9 * m - 14), lambda = 3 * (m - 1) * (m - 2);
    CAPTURE(m);
    CHECK(all(in_powers_of_u(random_polynomial(random, m), random_polynomial(random, m))) == List{p_i, lambda, 4 * m - 4, 2 * m - 2, p_i + lambda});
  }
  for (int n = 2; n <= 4; ++n) {
    const int p_i = 8 * (n - 1) * (2 * n - 3), lambda = 4 * (n - 1) * (2 * n - 3);
    CAPTURE(n);
    CHECK(all(in_powers_of_u(random_polynomial(random, n), random_polynomial(random, n), random_polynomial(random, n))) ==
          List{p_i, lambda, 6 * n - 6, 2 * n - 2, p_i + lambda});
  }
  // 26 and 6 for a cubic, as the paper says; 24 and 4 for (u, u³), see above. A denominator of lower degree:
  CHECK(all(in_powers_of_u(random_polynomial(random, 3), random_polynomial(random, 3), {1, 2})) == List{36, 14, 10, 4, 50});
  CHECK(degrees_of_factors(eliminated(cubic(), {Rational(1, 3), 2}).p_i) == List{24});
  CHECK(degrees_of_factors(eliminated(in_powers_of_u(random_polynomial(random, 3), random_polynomial(random, 3)), {Rational(1, 3), 2}).p_i) == List{26});
  // (u, u⁴): Λ is of degree 12, each root having two partners: it takes the square, too.
  const auto quartic = eliminated(in_powers_of_u({0, 1}, {0, 0, 0, 0, 1}), {Rational(2, 7), Rational(3, 5)});
  CHECK(degrees_of_factors(quartic.p_i) == List{10, 48});
  CHECK(are_proportional_forms(quartic.lambda, squared({1, 0, 0, 0, 0, 0, 4})));
  CHECK(are_proportional_forms(quartic.gamma, times(powers(quartic.p_i), powers(quartic.lambda))));
}

namespace {

/// Whether X_i, Y_i and W_i are the point where the normals at u and v meet, relative to p: (q - r)·r' = 0 for both.
bool normals_meet_at(const Self_intersection_forms& forms, const Rational& u, const Rational& v)
{
  const auto [x, y, w] = forms.normals_meet();
  const Polynomial weight = powers(forms.weight());
  const Rational qw = value_of(w, u, v) * horner(weight, u) * horner(weight, v);
  const std::array<Rational, 2> q{value_of(x, u, v), value_of(y, u, v)};
  for (const Rational& s : {u, v}) {
    const Rational ws = horner(weight, s), dws = horner(slope(weight), s);
    Rational sum = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Polynomial f = powers(forms.offset()[k]);
      sum += (q[k] * ws - qw * horner(f, s)) * (ws * horner(slope(f), s) - dws * horner(f, s));
    }
    if (sum != 0) return false;
  }
  return qw != 0;
}

} // namespace

TEST_CASE("Forms of lower degree: T2, A and B against R, S and P_c")
{
  Random random(2);
  Samples samples;
  for (int k = 0; k < 40; ++k) {
    const int n = random.between(2, 4);
    const bool is_rational = random.chance(50);
    const Piece_2 piece = is_rational ? in_powers_of_u(random_polynomial(random, n), random_polynomial(random, n), random_polynomial(random, n))
                                      : in_powers_of_u(random_polynomial(random, n), random_polynomial(random, n));
    const Point p = random_point(random);
    const Self_intersection_forms forms(piece, p);
    const Point_curve_forms plain(piece, p);
    const auto t2 = forms.bitangent_form(), r = forms.normal_form();
    samples.expect(t2.degree_x() == (is_rational ? 4 * n - 4 : 3 * n - 3) && t2.degree_y() == 2 * n - 2, "degrees of T2");
    samples.expect(r.degree_x() == (is_rational ? 4 * n - 3 : 3 * n - 2) && r.degree_y() == (is_rational ? 3 * n - 3 : 2 * n - 2), "degrees of R");
    samples.expect(are_proportional_forms(forms.circular_form(), powers(plain.circular_form())), "P_c");
    samples.expect(are_proportional_forms(forms.cusp_form(), powers(plain.circular_form())), "T2 on the diagonal");
    samples.expect(are_proportional_forms(forms.class_form(), powers(plain.class_form())), "P_∞");
    // T = (ℓ×ℓ')(u)·ℓ(v), and R = (w(v)T_v - 2w'(v)T)/(v - u) up to a number, at numbers u and v.
    const auto lift = plain.lift(), tangent = plain.tangent();
    Rational t_factor = 0, r_factor = 0;
    for (int i = 0; i < 4; ++i) {
      const Rational u = random.between(-9, -1), v = Rational(random.between(1, 9)) / 2, h = v - u;
      Rational t = 0, slope_v = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        t += horner(powers(tangent[c]), u) * horner(powers(lift[c]), v);
        slope_v += horner(powers(tangent[c]), u) * horner(slope(powers(lift[c])), v);
      }
      const Polynomial w = powers(piece.weight);
      const Rational of_r = horner(w, v) * slope_v - 2 * horner(slope(w), v) * t;
      const std::array<Rational, 2> printed{t, of_r}, found{Rational(value_of(t2, u, v) * h * h), Rational(value_of(r, u, v) * h)};
      for (std::size_t c = 0; c < 2; ++c) {
        Rational& factor = c == 0 ? t_factor : r_factor;
        if (factor == 0 && printed[c] != 0) factor = found[c] / printed[c];
        samples.expect(found[c] == factor * printed[c] && factor != 0, c == 0 ? "T2" : "R by T");
      }
      samples.expect(normals_meet_at(forms, u, v), "(74)");
      const auto [a, b] = forms.symmetric_forms();
      const Rational x = value_of(t2, u, v), y = value_of(t2, v, u);
      samples.expect(value_of(a, u, v) == x + y && value_of(b, u, v) * h == x - y, "A and B");
    }
    // B(u,u) = -P_c'(u)/6, and T2(u,u) = P_c(u)/2.
    const Polynomial on_diagonal = powers(detail::on_diagonal(forms.symmetric_forms()[1]));
    samples.expect(scaled(on_diagonal, -3) == slope(powers(forms.cusp_form())), "B on the diagonal");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 40 * 22);
}

// ================================================================================================================ counts by region

namespace {

Integer_polynomial circular_form(const Piece_2& piece, const Point& p) { return Self_intersection_forms(piece, p).circular_form(); }

} // namespace

TEST_CASE("Example 2.3: cusps of the bisectors of a parabola and of ellipses")
{
  Samples samples;
  const auto on_parabola = [&](const Rational& a, const Rational& b) {
    const Rational circle = a * a + b * b - b;
    const auto roots = real_roots(circular_form(parabola(), {a, b}));
    if (circle != 0) samples.expect(roots.size() == (circle > 0 ? 2u : 0u), "two cusps outside the circle of curvature, none inside");
    else samples.expect(roots.size() == 1 && roots[0].is_exact() && roots[0].lo == 0 && roots[0].multiplicity == (b == 0 ? 4 : 2), "on the circle");
  };
  for (int i = -16; i <= 16; ++i)
    for (int j = -8; j <= 16; ++j) on_parabola(Rational(i, 8), Rational(j, 8));
  for (int t = -9; t <= 9; ++t) // on the circle of curvature
    on_parabola(Rational(t * 4) / (16 + t * t), Rational(t * t) / (16 + t * t));

  int most = 0;
  for (const Rational& k : {Rational(1, 2), Rational(4, 5), Rational(3, 2), Rational(3)})
    for (int i = -12; i <= 12; ++i)
      for (int j = -12; j <= 12; ++j) {
        const auto count = static_cast<int>(real_roots(circular_form(ellipse(k), {Rational(i, 4), Rational(j, 4)})).size());
        most = std::max(most, count);
        samples.expect(count <= 4, "at most four cusps");
      }
  CHECK(most == 4);
  LOCUS_REQUIRE_SAMPLES(samples, 33 * 25 + 19 + 4 * 625);
}

TEST_CASE("Example 3.1: self-intersections of a parabola's bisector")
{
  // All roots have |u| < 4 on this grid.
  const Piece_2 piece = between(parabola(), -4, 4);
  Samples samples;
  const auto at = [&](const Rational& a, const Rational& b) {
    const Rational inside = b - a * a, circle = a * a + b * b - b;
    if (inside == 0) return; // p is on the curve
    const Self_intersection_forms forms(piece, {a, b});
    const auto polynomials = self_intersection_polynomials(forms);
    const auto roots = real_roots_on(polynomials.p_i, {Rational(0), Rational(1)});
    const std::size_t count = inside < 0 ? 0 : circle > 0 ? 4 : circle < 0 ? 2 : 3;
    samples.expect(roots.size() == count && real_roots(polynomials.p_i).size() == count, "real roots of P_i");
    const auto found = self_intersections(forms);
    samples.expect(found.undecided.empty() && found.pairs.size() == count / 2, "pairs");
    samples.expect(count == 0 || circle != 0 || roots[1].multiplicity == 2, "double root of P_i on the circle of curvature");
    for (const auto& pair : found.pairs) // u and -u
      samples.expect(pair.kind() == Self_intersection_kind::ordinary && pair.u.lo + pair.v.lo <= 1 && pair.u.hi + pair.v.hi >= 1, "symmetric pair");
  };
  for (int i = -12; i <= 12; ++i)
    for (int j = -4; j <= 16; ++j) at(Rational(i, 8), Rational(j, 8));
  for (int t = -9; t <= 9; ++t) at(Rational(t * 4) / (16 + t * t), Rational(t * t) / (16 + t * t));
  LOCUS_REQUIRE_SAMPLES(samples, 1500);
}

TEST_CASE("Example 3.2: self-intersections of an ellipse's bisector by circles of curvature")
{
  Samples samples;
  std::array<int, 3> seen{};
  const auto at = [&](const Rational& k, const Rational& a, const Rational& b) {
    const Formulas f{a, b, k};
    const Rational inside = k * k - k * k * a * a - b * b;
    if (inside == 0) return;
    const bool x_is_major = k < 1, on_x_axis = (inside > 0) == x_is_major; // where the self-intersections are
    const std::array<Rational, 2> circles = on_x_axis ? std::array<Rational, 2>{f.c_0(), f.c_infinite()} : std::array<Rational, 2>{f.c_plus(), f.c_minus()};
    // Inside the ellipse those count that p is outside of, outside those that p is inside of. On a circle, the pair has become
    // one extraordinary point.
    std::size_t expected = 0, touching = 0;
    for (const Rational& c : circles) {
      expected += inside > 0 ? c > 0 : c < 0;
      touching += c == 0;
    }
    ++seen[expected];
    const Self_intersection_forms forms(between(ellipse(k), -32, 32), {a, b});
    const Integer_polynomial p_i = self_intersection_polynomials(forms).p_i;
    const auto roots = real_roots(p_i);
    const auto at_infinity = static_cast<std::size_t>(8 - degree(p_i)); // the vertex u = ∞
    std::size_t simple = at_infinity == 1, all = at_infinity;
    for (const Real_root& root : roots) {
      simple += root.multiplicity == 1;
      all += static_cast<std::size_t>(root.multiplicity);
    }
    samples.expect(simple == 2 * expected && all <= 2 * (expected + touching), [&] { return "roots of P_i: " + show(k) + " " + show(a) + " " + show(b); });
    const auto found = self_intersections(forms, Partners::on_line);
    const bool is_within = at_infinity == 0 && std::all_of(roots.begin(), roots.end(), [](const Real_root& r) { return r.lo > 0 && r.hi < 1; });
    samples.expect(found.undecided.empty() && found.undecided_outside.empty(), "nothing is left open");
    if (is_within) samples.expect(found.pairs.size() == expected, [&] { return "pairs: " + show(k) + " " + show(a) + " " + show(b); });
  };
  for (const Rational& k : {Rational(1, 2), Rational(4, 5), Rational(3, 2), Rational(2)}) {
    for (int i = -7; i <= 7; ++i)
      for (int j = -7; j <= 7; ++j) at(k, Rational(i, 4) + Rational(1, 100), Rational(j, 4) + Rational(1, 50));
    for (int t = -3; t <= 3; ++t) { // on the circles of curvature
      const Rational cos = Rational(9 - t * t) / (9 + t * t), sin = Rational(6 * t) / (9 + t * t), m = 1 - k * k;
      at(k, Rational(m + k * k * cos), Rational(k * k * sin));
      at(k, Rational(-m + k * k * cos), Rational(k * k * sin));
      at(k, Rational(cos / k), Rational(k - 1 / k + sin / k));
      at(k, Rational(cos / k), Rational(1 / k - k + sin / k));
    }
    at(k, 0, Rational(1, 8)); // on the axes
    at(k, Rational(1, 8), 0);
    at(k, 0, 0);
    at(k, 0, 3);
    at(k, 3, 0);
  }
  CHECK((seen[0] > 100 && seen[1] > 100 && seen[2] > 100));
  LOCUS_REQUIRE_SAMPLES(samples, 2000);
}

// ================================================================================================================== pairs, two ways

namespace {

bool holds(const Line_parameter& p, const Rational& x) { return !p.outside && p.lo <= x && x <= p.hi; }

/// Whether b has a cusp of higher order at a root of P_i: there two parameters of a self-intersection have become one.
bool is_extraordinary(const Real_root& root, const Self_intersection_polynomials& polynomials)
{
  const Integer_polynomial multiple = gcd(polynomials.p_i, gcd(polynomials.p_c, derivative(polynomials.p_c)));
  return root.multiplicity > 1 && !real_roots_on(multiple, {root.lo, root.hi}).empty();
}

/// What is wrong with the agreement of pairs and roots of P_i in the unit interval, multiplicities included; or nothing.
std::string disagreement(const Self_intersection_forms& forms)
{
  const auto set = self_intersections(forms, Partners::on_line);
  const auto polynomials = self_intersection_polynomials(forms);
  if (!set.is_finite || !polynomials.is_finite) return "not finite";
  if (!set.undecided.empty() || !set.undecided_outside.empty()) return "undecided";
  const auto roots = real_roots_on(polynomials.p_i, {Rational(0), Rational(1)});
  std::vector<int> met(roots.size());
  for (const auto& pair : set.pairs)
    for (const Line_parameter* p : {&pair.u, &pair.v}) {
      if (p->outside) continue;
      int here = 0;
      for (std::size_t k = 0; k < roots.size(); ++k)
        if (roots[k].lo <= p->hi && p->lo <= roots[k].hi) {
          ++here;
          ++met[k];
        }
      if (here == 0) return "a pair's parameter is no root: " + show(Rational((p->lo + p->hi) / 2));
    }
  for (std::size_t k = 0; k < roots.size(); ++k) {
    if (met[k] == 0 && !is_extraordinary(roots[k], polynomials)) return "a root has no partner: " + show(roots[k].lo);
    const bool is_plain = std::all_of(set.pairs.begin(), set.pairs.end(), [](const Self_intersection& p) { return !p.at_cusp && !p.tangential; });
    if (is_plain && met[k] > 0 && met[k] < roots[k].multiplicity) return "a multiple root has too few partners: " + show(roots[k].lo);
  }
  return "";
}

/// b at a parameter's middle, in doubles: direction of (-qx, -qy, qw).
std::array<double, 3> direction(const Self_intersection_forms& forms, const Line_parameter& p)
{
  const Rational s = (p.lo + p.hi) / 2, x = p.outside ? Rational(1 - s) : s, y = p.outside ? Rational(1 - 2 * s) : Rational(1);
  std::array<Rational, 3> sum;
  Rational size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Polynomial f = powers(forms.tangent()[k]);
    for (std::size_t i = 0; i < f.size(); ++i) sum[k] += f[i] * power(x, static_cast<int>(i)) * power(y, forms.tangent_degree() - static_cast<int>(i));
    size = std::max(size, Rational(abs(sum[k])));
  }
  std::array<double, 3> d{};
  for (std::size_t k = 0; k < 3; ++k) d[k] = Rational(sum[k] / size).get_d();
  return d;
}

bool is_one_point(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if (std::abs(a[i] * b[j] - a[j] * b[i]) > 1e-7) return false;
  }
  return true;
}

Piece_2 random_piece(Random& random, int degree, bool is_rational)
{
  std::vector<Point> points;
  std::vector<Rational> weights;
  for (int i = 0; i <= degree; ++i) {
    points.push_back(random_point(random));
    weights.push_back(Rational(random.between(1, 64), 16));
  }
  return bezier_curve<2>(points, is_rational ? weights : std::vector<Rational>{}).pieces()[0];
}

/// Solutions u < v of two equations by intervals alone.
std::size_t count_above_diagonal(const Bivariate_polynomial& f, const Bivariate_polynomial& g)
{
  const Equations<2> equations{std::make_shared<Polynomial_equation<2>>(bernstein_form(f)), std::make_shared<Polynomial_equation<2>>(bernstein_form(g))};
  const auto set = with_upward_rounding([&] { return solve_points<2>(equations, {}); });
  return static_cast<std::size_t>(std::count_if(set.points.begin(), set.points.end(), [](const auto& p) { return p.box[0].sup() < p.box[1].inf(); }));
}

/// Parameters as numbers, for messages.
std::string text_of(const Self_intersection_set& set)
{
  std::string text = set.is_finite ? "" : "not finite ";
  for (const auto& p : set.pairs) text += show(p.u.lo.get_d()) + " " + show(p.v.lo.get_d()) + (p.v.outside ? " outside; " : "; ");
  return text;
}

const Self_intersection* pair_at(const Self_intersection_set& set, const Rational& u, const Rational& v)
{
  for (const auto& p : set.pairs)
    if (holds(p.u, u) && holds(p.v, v)) return &p;
  return nullptr;
}

} // namespace

TEST_CASE("Pairs of parameters agree with the roots of P_i on random curves")
{
  Random random(3);
  Samples samples;
  std::size_t pairs = 0;
  struct Kind {
    int degree;
    bool is_rational;
    int count;
  };
  for (const Kind& kind : {Kind{2, false, 20}, Kind{3, false, 60}, Kind{4, false, 25}, Kind{2, true, 40}, Kind{3, true, 25}})
    for (int k = 0; k < kind.count; ++k) {
      const Piece_2 piece = random_piece(random, kind.degree, kind.is_rational);
      const Point p = random_point(random);
      const Self_intersection_forms forms(piece, p);
      const std::string wrong = disagreement(forms);
      samples.expect(wrong.empty(), [&] { return wrong + ", degree " + show(kind.degree); });
      const auto set = self_intersections(forms, Partners::on_line), inside = self_intersections(forms);
      pairs += set.pairs.size();
      const auto both_inside = std::count_if(set.pairs.begin(), set.pairs.end(), [](const auto& q) { return !q.v.outside; });
      samples.expect(inside.pairs.size() == static_cast<std::size_t>(both_inside), "those inside are the same");
      for (const auto& q : set.pairs) {
        samples.expect(is_one_point(direction(forms, q.u), direction(forms, q.v)), "b(u) = b(v)");
        samples.expect(q.kind() == Self_intersection_kind::ordinary && !q.at_cusp, "ordinary");
      }
      // The other system has the same solutions, double points of the curve included.
      const auto t2 = forms.bitangent_form();
      const auto [a, b] = forms.symmetric_forms();
      samples.expect(b.is_zero() || count_above_diagonal(t2, t2.swapped()) == count_above_diagonal(a, b), "A = B = 0");
    }
  CHECK(pairs > 150);
  LOCUS_REQUIRE_SAMPLES(samples, 170 * 3);
}

TEST_CASE("Pairs of parameters agree with the roots of P_i on small whole numbers")
{
  // p on the curve, curves that stand still, cusps of b at u = ∞, and all kinds of symmetry.
  Random random(4);
  Samples samples;
  for (int k = 0; k < 150; ++k) {
    const int degree = random.between(2, 3);
    std::vector<Point> points;
    std::vector<Rational> weights;
    for (int i = 0; i <= degree; ++i) {
      points.push_back({random.between(-2, 2), random.between(-2, 2)});
      weights.push_back(random.between(1, 3));
    }
    const Point p{random.between(-2, 2), random.between(-2, 2)};
    const auto label = [&] {
      std::string text = show(p);
      for (const Point& q : points) text += " " + show(q);
      return text;
    };
    if (std::all_of(points.begin(), points.end(), [&](const Point& q) { return q == points[0]; })) continue;
    const Piece_2 piece = bezier_curve<2>(points, random.chance(50) ? weights : std::vector<Rational>{}).pieces()[0];
    const Self_intersection_forms forms(piece, p);
    const std::string wrong = disagreement(forms);
    const auto polynomials = self_intersection_polynomials(forms);
    // Only on lines, circles and what is traced more than once two normals agree everywhere.
    if (!polynomials.is_finite || wrong == "not finite") continue;
    samples.expect(wrong.empty(), [&] { return wrong + ": " + label(); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

TEST_CASE("Remark 3.6: tangential self-intersections")
{
  // ((u²-1)², u(u²-1)) touches itself at u = ±1; u = 4s - 2.
  const Self_intersection_forms forms(between(in_powers_of_u({1, 0, -2, 0, 1}, {0, -1, 0, 1}), -2, 2), {2, 1});
  const auto set = self_intersections(forms);
  INFO(text_of(set));
  const auto* pair = pair_at(set, Rational(1, 4), Rational(3, 4));
  REQUIRE(pair);
  CHECK((pair->kind() == Self_intersection_kind::tangential && pair->u.is_exact() && pair->v.is_exact()));
  CHECK((set.pairs.size() == 7 && set.eliminated && set.undecided.empty()));
  CHECK(std::count_if(set.pairs.begin(), set.pairs.end(), [](const auto& p) { return p.kind() == Self_intersection_kind::ordinary; }) == 6);
  // Its parameters are roots of Λ, as the paper says, but of Γ twice as often, so that they stay in P_i.
  const auto polynomials = self_intersection_polynomials(forms);
  const auto multiplicity = [](const Integer_polynomial& f) {
    const auto roots = real_roots_on(f, {Rational(1, 4), Rational(1, 4)});
    return roots.size() == 1 ? roots[0].multiplicity : 0;
  };
  CHECK((multiplicity(polynomials.gamma) == 6 && multiplicity(polynomials.lambda) == 3 && multiplicity(polynomials.p_i) == 3));
  CHECK(disagreement(forms).empty());
}

TEST_CASE("Double points of the curve are no self-intersections")
{
  // (u²-1, u(u²-1)) crosses itself at u = ±1.
  const Piece_2 piece = between(in_powers_of_u({-1, 0, 1}, {0, -1, 0, 1}), -2, 2);
  for (const Point& p : {Point{2, 1}, Point{Rational(-3, 4), 0}, Point{0, 0}, Point{0, Rational(1, 1 << 30)}}) {
    const Self_intersection_forms forms(piece, p);
    const auto set = self_intersections(forms, Partners::on_line);
    INFO(show(p) << " " << text_of(set));
    CHECK(pair_at(set, Rational(1, 4), Rational(3, 4)) == nullptr);
    CHECK((set.is_finite && set.undecided.empty() && set.undecided_outside.empty() && set.eliminated == (p[0] == 0)));
    CHECK(disagreement(forms) == "");
    if (p[0] != 0) CHECK(value_of(forms.bitangent_form(), Rational(1, 4), Rational(3, 4)) == 0); // but solutions of T2 = 0
  }
}

TEST_CASE("Two poles are one point of the inverted curve")
{
  // (u, 1/u): poles at u = 0 and u = ∞, with different asymptotes.
  const Self_intersection_forms hyperbola(in_powers_of_u({0, 0, 1}, {1}, {0, 1}), {Rational(1, 3), -2});
  const auto set = self_intersections(hyperbola, Partners::on_line);
  INFO(text_of(set));
  CHECK((set.undecided.empty() && set.undecided_outside.empty()));
  for (const auto& pair : set.pairs) CHECK(pair.u.lo > 0);
  // (u, 1/(u(1-u))): parallel ones, so that both branches of b go to infinity in one direction.
  const Self_intersection_forms forms(in_powers_of_u({0, 0, 1, -1}, {1}, {0, 1, -1}), {Rational(1, 3), -2});
  const auto parallel = self_intersections(forms);
  INFO(text_of(parallel));
  const auto* pair = pair_at(parallel, 0, 1);
  REQUIRE(pair);
  CHECK((pair->infinite && pair->tangential && pair->kind() == Self_intersection_kind::infinite && parallel.undecided.empty()));
}

TEST_CASE("Remark 3.6: infinite self-intersections")
{
  // y = -1 touches (u, u⁴-2u²) at u = ±1.
  const Piece_2 piece = between(in_powers_of_u({0, 1}, {0, 0, -2, 0, 1}), -2, 2);
  for (const Rational& x : {Rational(5), Rational(0), Rational(-1, 3)}) {
    const Self_intersection_forms forms(piece, {x, -1});
    const auto set = self_intersections(forms, Partners::on_line);
    INFO(show(x) << " " << text_of(set));
    const auto* pair = pair_at(set, Rational(1, 4), Rational(3, 4));
    REQUIRE(pair);
    CHECK((pair->kind() == Self_intersection_kind::infinite && pair->u.is_exact() && pair->v.is_exact()));
    CHECK(std::count_if(set.pairs.begin(), set.pairs.end(), [](const auto& p) { return p.infinite; }) == 1);
    CHECK(disagreement(forms) == "");
    CHECK(horner(powers(forms.class_form()), Rational(1, 4)) == 0);
  }
  // A little beside, it is finite.
  const Self_intersection_forms forms(piece, {5, Rational(-1) + Rational(1, 1 << 30)});
  for (const auto& pair : self_intersections(forms).pairs) CHECK(pair.kind() == Self_intersection_kind::ordinary);
}

TEST_CASE("Remark 3.6: three parameters of one point")
{
  // A circle about (0, 15/8) through p touches (u, u⁴-3u²) at u = 0 and u = ±√(7/2); u = 6s - 3.
  const Piece_2 piece = between(in_powers_of_u({0, 1}, {0, 0, -3, 0, 1}), -3, 3);
  const Self_intersection_forms forms(piece, {0, Rational(15, 4)});
  const auto set = self_intersections(forms, Partners::on_line);
  INFO(text_of(set));
  CHECK((set.pairs.size() == 7 && set.undecided.empty()));
  std::vector<const Self_intersection*> multiple;
  for (const auto& p : set.pairs)
    if (p.kind() == Self_intersection_kind::multiple) multiple.push_back(&p);
  REQUIRE(multiple.size() == 3);
  CHECK((multiple[0]->place == multiple[1]->place && multiple[1]->place == multiple[2]->place));
  CHECK((holds(multiple[0]->v, Rational(1, 2)) && holds(multiple[2]->u, Rational(1, 2))));
  for (const auto& p : set.pairs) CHECK((p.is_multiple || p.place != multiple[0]->place));
  CHECK(disagreement(forms) == "");

  // Beside the axis, and beside the point on it, the three are apart: by less than doubles tell, in the first case.
  for (const Point& p : {Point{Rational(1, 1 << 30), Rational(15, 4)}, Point{0, Rational(15, 4) + Rational(1, 1 << 30)}}) {
    const auto near = self_intersections(Self_intersection_forms(piece, p));
    INFO(show(p) << " " << text_of(near));
    CHECK((near.pairs.size() == 7 && near.undecided.empty()));
    for (const auto& q : near.pairs) CHECK(q.kind() == Self_intersection_kind::ordinary);
  }
}

TEST_CASE("Self-intersections at cusps, and beside extraordinary points")
{
  // One branch has a cusp at u = ∞.
  const Self_intersection_forms at_infinity(
    bezier_2({{"11/4", 0}, {2, "-5/2"}, {"-11/4", -1}, {"-11/4", 1}}).pieces()[0], {Rational(-3, 2), Rational(-3, 4)});
  const auto set = self_intersections(at_infinity, Partners::on_line);
  INFO(text_of(set));
  std::vector<Self_intersection> cusps;
  std::copy_if(set.pairs.begin(), set.pairs.end(), std::back_inserter(cusps), [](const auto& p) { return p.at_cusp; });
  REQUIRE(cusps.size() == 1);
  CHECK((cusps[0].infinite && cusps[0].v.outside && cusps[0].v.lo <= Rational(1, 2) && cusps[0].v.hi >= Rational(1, 2) && !cusps[0].v.bounds()));
  CHECK(disagreement(at_infinity) == "");

  // p on, and 2^-30 beside, the circle of curvature at the parabola's vertex: there is one pair more inside, near the vertex.
  const Piece_2 piece = between(parabola(), -2, 2);
  const Rational e(1, 1 << 30);
  for (const int side : {-1, 0, 1}) {
    const auto found = self_intersections(Self_intersection_forms(piece, {Rational(2, 5), Rational(Rational(1, 5) + side * e)}));
    CHECK((found.undecided.empty() && found.pairs.size() == (side < 0 ? 2u : 1u) && found.eliminated == (side == 0)));
  }
  // Near the curve: two pairs inside it, none outside.
  for (const int side : {-1, 1}) {
    const Self_intersection_forms forms(piece, {1, Rational(1 + side * e)});
    const auto found = self_intersections(forms);
    CHECK((found.undecided.empty() && found.pairs.size() == (side < 0 ? 0u : 2u)));
  }
}

TEST_CASE("Lines, circles, points on the curve, and curves that are traced twice")
{
  const Point p{Rational(1, 3), 2};
  const auto solved = [](const Piece_2& piece, const Point& q) { return self_intersections(Self_intersection_forms(piece, q), Partners::on_line); };
  // A circle: all normals meet in the centre, and elimination is in vain; the bisector is a conic.
  const Piece_2 circle = between(ellipse(1), -1, 1);
  for (const Point& q : {p, Point{0, 0}}) {
    const auto set = solved(circle, q);
    CHECK((set.is_finite && set.pairs.empty() && set.undecided.empty() && set.undecided_outside.empty()));
    const auto polynomials = eliminated(circle, q);
    CHECK((!polynomials.is_finite && polynomials.gamma.empty() && degree(polynomials.p_i) == 0));
  }
  CHECK(!solved(circle, {0, 1}).is_finite); // b is its centre

  const Piece_2 line = in_powers_of_u({0, 1}, {1, 2});
  CHECK((solved(line, p).is_finite && solved(line, p).pairs.empty()));
  CHECK((eliminated(line, p).is_finite && degree(eliminated(line, p).p_i) == 0));
  CHECK(!solved(line, {1, 3}).is_finite);

  // A parabola traced twice, and a line that turns back.
  CHECK(!solved(in_powers_of_u({0, -1, 1}, {0, 0, 1, -2, 1}), {0, 2}).is_finite);
  CHECK(!eliminated(in_powers_of_u({0, -1, 1}, {0, 0, 1, -2, 1}), {0, 2}).is_finite);
  CHECK(!solved(in_powers_of_u({0, -1, 1}, {0, -2, 2}), {0, 2}).is_finite);

  // p on the curve, and a curve with a cusp: no roots there are taken for self-intersections.
  CHECK(disagreement(Self_intersection_forms(between(cubic(), -2, 2), {1, 1})) == "");
  const Piece_2 cusp = between(in_powers_of_u({0, 0, 1}, {0, 0, 0, 1}), -2, 2);
  for (const Point& q : {Point{1, 1}, Point{1, Rational(1, 2)}, Point{0, 0}, Point{-1, 0}}) CHECK(disagreement(Self_intersection_forms(cusp, q)) == "");
}

TEST_CASE("Parameters outside, and roots on intervals")
{
  const Line_parameter a{true, Rational(1, 4), Rational(1, 3)}, b{true, Rational(2, 3), Rational(3, 4)}, c{true, 0, 1}, d{false, 0, Rational(1, 2)};
  CHECK((*a.bounds())[0] == Rational(3, 2));
  CHECK((*a.bounds())[1] == 2);
  CHECK((*b.bounds())[0] == -1);
  CHECK((*b.bounds())[1] == Rational(-1, 2));
  CHECK(!c.bounds());
  CHECK((*d.bounds())[1] == Rational(1, 2));

  const Integer_polynomial f = with_integers(with_roots({-2, 0, 0, Rational(1, 3), 1, 5}));
  const auto count = [&](const Parameter_domain& domain) { return real_roots_on(f, domain).size(); };
  CHECK(count({}) == 5);
  CHECK(count({Rational(0), Rational(1)}) == 3);
  CHECK(count({Rational(1, 3), std::nullopt}) == 3);
  CHECK(count({std::nullopt, Rational(-2)}) == 1);
  CHECK(count({Rational(2), Rational(3)}) == 0);
  CHECK(real_roots_on(f, {Rational(0), Rational(0)})[0].multiplicity == 2);
  CHECK(real_roots_on({-2, 0, 1}, {Rational(1414213, 1000000), Rational(1414214, 1000000)}).size() == 1);
  CHECK(thrown<std::domain_error>([] { real_roots_on({}, {}); }) == 1);
}

TEST_CASE("Limits leave boxes undecided")
{
  const Self_intersection_forms forms(between(in_powers_of_u({0, 1}, {0, 0, -2, 0, 1}), -2, 2), {5, -1});
  Solve_control control;
  control.max_bits = 200; // too few for the elimination that tells an infinite pair
  const auto set = self_intersections(forms, Partners::inside, control);
  CHECK((set.undecided.size() == 1 && set.pairs.size() == 2 && !set.eliminated));
  control = {};
  control.cancel = std::make_shared<std::atomic<bool>>(true);
  CHECK(!self_intersections(forms, Partners::inside, control).undecided.empty());
}
