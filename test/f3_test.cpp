// SPDX-License-Identifier: LGPL-3.0-or-later
#include "curve_support.h"

#include <locus/constraint/f1_f2.h>
#include <locus/constraint/f3_system.h>

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Box;
using locus::Carrier;
using locus::Curve_pair_equation;
using locus::F3_form;
using locus::Interval;
using locus::Planar_curve;
using locus::with_upward_rounding;

namespace {

std::shared_ptr<const Planar_curve> planar(const Control_curve& c, const locus::Frame<2>& frame = {})
{
  return std::make_shared<const Planar_curve>(c.build().pieces()[0], frame);
}

Carrier::Kind kind_of(const Control_curve& c) { return locus::carrier_of(c.build().pieces()[0]).kind; }

Rational random_parameter(Random& random)
{
  Rational u(random.between(1, 996), 997);
  u.canonicalize();
  return u;
}

/// The tests' own restriction of a univariate Bernstein polynomial: its blossom with lo and hi as arguments.
std::vector<Rational> blossomed(const std::vector<Rational>& c, const Rational& lo, const Rational& hi)
{
  const std::size_t n = c.size() - 1;
  std::vector<Rational> result;
  for (std::size_t i = 0; i <= n; ++i) {
    std::vector<Rational> work = c;
    for (std::size_t level = 0; level < n; ++level) {
      const Rational& u = level < n - i ? lo : hi;
      for (std::size_t j = 0; j + 1 < work.size(); ++j) work[j] = Rational((1 - u) * work[j] + u * work[j + 1]);
      work.pop_back();
    }
    result.push_back(work[0]);
  }
  return result;
}

Bernstein<Rational, 2> restricted(Bernstein<Rational, 2> f, const Box<2>& box)
{
  const int n = f.degree(0), m = f.degree(1);
  for (int i = 0; i <= n; ++i) {
    std::vector<Rational> row;
    for (int j = 0; j <= m; ++j) row.push_back(f.at({i, j}));
    row = blossomed(row, Rational(box.lo[1]), Rational(box.hi[1]));
    for (int j = 0; j <= m; ++j) f.at({i, j}) = row[static_cast<std::size_t>(j)];
  }
  for (int j = 0; j <= m; ++j) {
    std::vector<Rational> column;
    for (int i = 0; i <= n; ++i) column.push_back(f.at({i, j}));
    column = blossomed(column, Rational(box.lo[0]), Rational(box.hi[0]));
    for (int i = 0; i <= n; ++i) f.at({i, j}) = column[static_cast<std::size_t>(i)];
  }
  return f;
}

/// A dyadic sub-box of the unit square; sometimes it reaches over the border a little, as the point solver's boxes do.
Box<2> random_box(Random& random)
{
  Box<2> box;
  for (std::size_t v = 0; v < 2; ++v) {
    const int depth = random.between(0, 12);
    const double width = std::ldexp(1.0, -depth);
    const auto cell = static_cast<double>(random.below(1 << depth));
    box.lo[v] = cell * width;
    box.hi[v] = box.lo[v] + width;
    if (random.chance(25)) box.lo[v] -= 0.25 * width;
    if (random.chance(25)) box.hi[v] += 0.25 * width;
    if (random.chance(10)) box.hi[v] = box.lo[v];
  }
  return box;
}

/// The bidegree of F3 in the variable of one curve, by what it is.
int expected_degree(const Control_curve& c)
{
  const locus::Curve_2 curve = c.build();
  const auto& piece = curve.pieces()[0];
  const int d = piece.degree();
  switch (locus::carrier_of(piece).kind) {
  case Carrier::Kind::line: return 2 * d; // e² alone: the direction is constant
  case Carrier::Kind::circle: return d;
  case Carrier::Kind::general: return piece.is_polynomial() ? 3 * d - 1 : 4 * d - 2;
  }
  return -1;
}

struct Pair {
  Control_curve first, second;
};

Control_curve random_member(Random& random)
{
  const auto kind = static_cast<Coordinates>(random.below(4));
  if (random.chance(20)) {
    for (;;) {
      const Exact_pair centre{random_coordinate(random, kind), random_coordinate(random, kind)};
      const Exact_pair h0{random.between(-3, 3), random.between(-3, 3)}, h1{random.between(-3, 3), random.between(-3, 3)};
      if (h0[0] * h1[0] + h0[1] * h1[1] <= 0 || h0[0] * h1[1] == h0[1] * h1[0]) continue;
      return circular_arc(centre, Rational(random.between(1, 9)) / 4, h0, h1);
    }
  }
  return random_curve(random, random.between(1, 4), kind, random.chance(50));
}

/// A pair that F3 can be built for: no cusps inside.
std::optional<Pair> random_pair(Random& random)
{
  Pair p{random_member(random), random_member(random)};
  try {
    planar(p.first);
    planar(p.second);
  } catch (const locus::Unsupported_feature&) {
    return std::nullopt;
  }
  return p;
}

} // namespace

// ------------------------------------------------------------------------------------------------ exact coefficients

TEST_CASE("the exact F3 is -Im(e² ā b̄) up to one factor for a pair, positive in each variable", "[f3]")
{
  Random random(101);
  Samples samples, degree_samples;
  std::size_t constant_factors = 0;
  with_upward_rounding([&] {
    for (int k = 0; k < 260; ++k) {
      const auto pair = random_pair(random);
      if (!pair) continue;
      const auto &a = pair->first, &b = pair->second;
      const Curve_pair_equation<F3_form> equation(planar(a), planar(b));
      const Bernstein<Rational, 2> f = equation.exact().rational();
      const auto primitive = [](const Control_curve& c) { return Plain_curve(c).with_primitive_tangent().ax.size() == Plain_curve(c).ax.size(); };
      const auto plain = [&](const Control_curve& c) { return kind_of(c) != Carrier::Kind::general || primitive(c); };
      if (plain(a) && plain(b)) // (a doubled end point and the like make the degree less)
        degree_samples.expect(equation.degrees() == Degrees<2>{expected_degree(a), expected_degree(b)},
                              [&] { return show(equation.degrees()) + " of " + show(a, b); });
      const Plain_curve first(a), second(b);
      const bool general = kind_of(a) == Carrier::Kind::general && kind_of(b) == Carrier::Kind::general;
      // For lines and circles a factor of one variable alone is left out: F at four points in a rectangle tells.
      std::vector<Rational> t, r;
      for (int i = 0; i < 3; ++i) {
        t.push_back(random_parameter(random));
        r.push_back(random_parameter(random));
      }
      Rational got[3][3], want[3][3];
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          got[i][j] = plain_value<2>(f, {t[i], r[j]});
          want[i][j] = plain_f3(first, second, t[i], r[j]);
        }
      // The factor: positive, but for clockwise circles, whose tangent's sign is a constant left out as well.
      int orientation = 0;
      bool constant = true, separable = true, one_sign = true;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          one_sign = one_sign && (sgn(got[i][j]) == 0) == (sgn(want[i][j]) == 0);
          const int s = sgn(got[i][j]) * sgn(want[i][j]);
          if (orientation == 0) orientation = s;
          one_sign = one_sign && (s == 0 || s == orientation);
          constant = constant && got[i][j] * want[0][0] == got[0][0] * want[i][j];
          separable = separable && Rational(got[i][j] * want[i][0]) * Rational(got[0][0] * want[0][j]) ==
                                     Rational(got[i][0] * want[i][j]) * Rational(got[0][j] * want[0][0]);
        }
      samples.expect(one_sign && separable, [&] { return show(a, b); });
      if (general) {
        // (The common real factor without zeros that a tangent may have is divided out or not.)
        if (primitive(a) && primitive(b)) {
          ++constant_factors;
          samples.expect(constant && orientation >= 0, [&] { return "not one positive factor: " + show(a, b); });
        }
      }
    }
  });
  CHECK(constant_factors > 60);
  LOCUS_REQUIRE_SAMPLES(degree_samples, 150);
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("degrees of F3", "[f3]")
{
  with_upward_rounding([&] {
    Random random(102);
    for (int m = 2; m <= 5; ++m)
      for (int n = 1; n <= 4; ++n)
        for (const bool rational : {false, true}) {
          const Control_curve a = random_curve(random, m, Coordinates::fractions, rational), b = random_curve(random, n, Coordinates::fractions, false);
          // (A double zero of the weight is a zero of D1 as well, and would be divided out.)
          if (Plain_curve(a).with_primitive_tangent().ax.size() != Plain_curve(a).ax.size()) continue;
          const Curve_pair_equation<F3_form> equation(planar(a), planar(b));
          const bool truly = rational && std::any_of(a.weights.begin(), a.weights.end(), [&](const Rational& w) { return w != a.weights[0]; });
          const Degrees<2> expected{truly ? 4 * m - 2 : 3 * m - 1, n == 1 ? 2 : 3 * n - 1};
          CHECK(equation.degrees() == expected);
          CHECK(equation.exact().degrees() == expected);
          CHECK(equation.enclosure(Box<2>::unit()).degrees() == expected);
        }
    // EK98's total degree 4m-2 for two polynomial curves of degree m: all terms beyond it cancel.
    for (int m = 2; m <= 4; ++m) {
      const Control_curve a = random_curve(random, m, Coordinates::fractions, false), b = random_curve(random, m, Coordinates::fractions, false);
      const Bernstein<Rational, 2> f = Curve_pair_equation<F3_form>(planar(a), planar(b)).exact().rational();
      // Along t = t0 + x·u, r = r0 + y·u the restriction has the total degree: count by finite differences.
      std::vector<Rational> values;
      for (int i = 0; i <= 6 * m; ++i) values.push_back(plain_value<2>(f, {Rational(Rational(i) * 2 / 7), Rational(Rational(i) * 3 / 11 - 1)}));
      int degree = -1;
      for (int d = 0; !values.empty(); ++d) {
        if (values[0] != 0) degree = d;
        for (std::size_t i = 0; i + 1 < values.size(); ++i) values[i] = values[i + 1] - values[i];
        values.pop_back();
      }
      CHECK(degree == 4 * m - 2);
    }
  });
}

// --------------------------------------------------------------------------------------------------- enclosures

TEST_CASE("F3's enclosures hold the exact coefficients on any box, and are tight", "[f3]")
{
  Random random(103);
  Samples inside, tight;
  with_upward_rounding([&] {
    for (int k = 0; k < 120; ++k) {
      const auto pair = random_pair(random);
      if (!pair) continue;
      const auto &a = pair->first, &b = pair->second;
      const Curve_pair_equation<F3_form> equation(planar(a), planar(b));
      const Bernstein<Rational, 2> whole = equation.exact().rational();
      // The exact form and the enclosure may differ by one positive factor; find it on the unit box.
      const Bernstein<Interval, 2> unit = equation.enclosure(Box<2>::unit());
      std::size_t largest = 0;
      for (std::size_t i = 0; i < whole.size(); ++i)
        if (abs(whole[i]) > abs(whole[largest])) largest = i;
      if (whole[largest] == 0) {
        bool zero = true;
        for (const Interval& c : unit.coefficients()) zero = zero && locus::contains_zero(c);
        inside.expect(zero, [&] { return "F3 = 0: " + show(a, b); });
        continue;
      }
      // The factor lies in [low, high] by every coefficient's enclosure; it must exist and be positive.
      Rational low = 0, high = 0;
      bool consistent = true, bounded = false;
      for (std::size_t i = 0; i < whole.size(); ++i) {
        const Rational lo(unit[i].inf()), hi(unit[i].sup());
        if (whole[i] == 0) {
          consistent = consistent && lo <= 0 && hi >= 0;
          continue;
        }
        Rational x = lo / whole[i], y = hi / whole[i];
        if (x > y) std::swap(x, y);
        if (!bounded) low = x, high = y;
        bounded = true;
        low = std::max(low, x);
        high = std::min(high, y);
      }
      inside.expect(consistent && bounded && low <= high && high > 0, [&] { return "unit box of " + show(a, b); });
      const Rational factor = (low + high) / 2, slack = (high - low) / 2 + abs(factor) * two_to(-50);
      for (int box_number = 0; box_number < 6; ++box_number) {
        const Box<2> box = random_box(random);
        const Bernstein<Interval, 2> f = equation.enclosure(box);
        const Bernstein<Rational, 2> exact = restricted(whole, box);
        Rational size = 0;
        double width = 0;
        bool holds = true;
        for (std::size_t i = 0; i < f.size(); ++i) {
          const Rational value = exact[i] * factor, error = abs(exact[i]) * slack;
          holds = holds && Rational(f[i].inf()) - error <= value && value <= Rational(f[i].sup()) + error;
          size = std::max(size, Rational(abs(value)));
          width = std::max(width, locus::width(f[i]));
        }
        const auto text = [&] {
          return show(a, b) + " on [" + show(box.lo[0]) + ", " + show(box.hi[0]) + "] x [" + show(box.lo[1]) + ", " + show(box.hi[1]) + "]";
        };
        inside.expect(holds, text);
        // Tight against the largest coefficient of the whole: the coordinates' roundings are all that is lost.
        tight.expect(width <= 1e-11 * Rational(abs(whole[largest] * factor)).get_d(), text);
      }
    }
  });
  LOCUS_REQUIRE_SAMPLES(inside, 400);
  LOCUS_REQUIRE_SAMPLES(tight, 400);
}

TEST_CASE("near a common point of the curves the enclosure is relatively tight", "[f3]")
{
  // C1(1/2) = C2(1/2) = (0, 0), far from the origin of coordinates after the move.
  const Control_curve a = translated(curve_of({{"-1", "-1"}, {"0", "1/3"}, {"1", "1/3"}}), Rational(1), Rational(2));
  const Control_curve b = translated(curve_of({{"-1", "1"}, {"1/3", "0"}, {"1/3", "-1"}}), Rational(1), Rational(2));
  with_upward_rounding([&] {
    const Curve_pair_equation<F3_form> equation(planar(a), planar(b));
    for (const int depth : {10, 20, 30}) {
      const double h = std::ldexp(1.0, -depth);
      Box<2> box;
      box.lo = {0.5 - h, 0.5 - h};
      box.hi = {0.5 + h, 0.5 + h};
      const Bernstein<Interval, 2> f = equation.enclosure(box);
      const Bernstein<Rational, 2> exact = restricted(equation.exact().rational(), box);
      double size = 0, width = 0;
      for (const Interval& c : f.coefficients()) {
        size = std::max(size, locus::magnitude(c));
        width = std::max(width, locus::width(c));
      }
      INFO("depth " << depth);
      // e is about h with an error of the coordinates' last bits, F about h²: its error is h times that, where forms
      // in the coordinates themselves would carry errors of size 1e-16.
      CHECK(width < 2e-12 * h);
      CHECK(size < 100 * h * h);
      CHECK(exact.size() == f.size());
    }
  });
}

// ------------------------------------------------------------------------------------------------- other formulas

TEST_CASE("F1 of Elber & Kim 1998 (3) is -W·F3 as a polynomial identity", "[f3]")
{
  Random random(104);
  Samples samples;
  with_upward_rounding([&] {
    for (int k = 0; k < 60; ++k) {
      const auto pair = random_pair(random);
      if (!pair) continue;
      const auto &a = pair->first, &b = pair->second;
      const auto first = planar(a), second = planar(b);
      const Bernstein<Rational, 2> f1 = locus::f1(*first, *second), f2 = locus::f2(*first, *second);
      const Plain_curve p(a), q(b);
      const Carrier::Kind kinds[] = {kind_of(a), kind_of(b)};
      const bool lines = kinds[0] == Carrier::Kind::line || kinds[1] == Carrier::Kind::line;
      // EK98 (3), with the derivatives of the affine curve, cleared of its denominators: exactly at random points. More
      // points than a product of the degrees would need for the identity are too many; a polynomial of such a degree
      // that vanishes at 12 random points of 10^6 is the zero polynomial for all one can tell.
      bool same = true, product = true, second_form = true;
      const Bernstein<Rational, 2> w = locus::exact_form<locus::Parallel_tangents_form>(*first, *second);
      const Bernstein<Rational, 2> f3 = locus::exact_form<F3_form>(*first, *second);
      Rational factor = 0;
      for (int i = 0; i < 12; ++i) {
        const Rational t = random_parameter(random), r = random_parameter(random);
        const Plain_values v = plain_values(p, q, t, r);
        const Rational ea = v.e.re * v.a.re + v.e.im * v.a.im, eb = v.e.re * v.b.re + v.e.im * v.b.im;
        const Rational aa = v.a.re * v.a.re + v.a.im * v.a.im, bb = v.b.re * v.b.re + v.b.im * v.b.im;
        const Rational printed = aa * eb * eb - bb * ea * ea;
        const Rational identity = -(v.a.re * v.b.im - v.a.im * v.b.re) * plain_f3(p, q, t, r);
        same = same && printed == identity; // the mathematics
        const Rational at_f1 = plain_value<2>(f1, {t, r});
        product = product && at_f1 == -plain_value<2>(w, {t, r}) * plain_value<2>(f3, {t, r});
        second_form = second_form && plain_value<2>(f2, {t, r}) == at_f1;
        if (!lines && printed != 0) { // the library's F1 against the paper's, up to a constant
          if (factor == 0) factor = at_f1 / printed;
          const bool primitive = p.with_primitive_tangent().ax.size() == p.ax.size() && q.with_primitive_tangent().ax.size() == q.ax.size();
          same = same && (!primitive || at_f1 == factor * printed) && factor > 0;
        }
      }
      samples.expect(same, [&] { return "the paper's F1 " + show(a, b); });
      samples.expect(product, [&] { return "F1 = -W F3 " + show(a, b); });
      samples.expect(second_form, [&] { return "F2 = F1 " + show(a, b); });
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 120);
}

TEST_CASE("F3 is W times the difference of the squared distances of the normals' intersection", "[f3]")
{
  // EK98 (12), (13): the point where both normals meet, by Cramer's rule, and its distances to both feet.
  Random random(105);
  Samples samples;
  with_upward_rounding([&] {
    for (int k = 0; k < 120; ++k) {
      const auto pair = random_pair(random);
      if (!pair) continue;
      const auto &a = pair->first, &b = pair->second;
      const Bernstein<Rational, 2> f = Curve_pair_equation<F3_form>(planar(a), planar(b)).exact().rational();
      const Plain_curve p(a), q(b);
      int orientation = 0;
      bool ok = true;
      for (int i = 0; i < 6; ++i) {
        const Rational t = random_parameter(random), r = random_parameter(random);
        const Plain_values v = plain_values(p, q, t, r);
        const Exact_pair c1{Rational(horner(p.x, t) / v.w1), Rational(horner(p.y, t) / v.w1)};
        const Exact_pair c2{Rational(horner(q.x, r) / v.w2), Rational(horner(q.y, r) / v.w2)};
        const Rational w = v.a.re * v.b.im - v.a.im * v.b.re;
        if (w == 0) continue;
        const Rational k1 = c1[0] * v.a.re + c1[1] * v.a.im, k2 = c2[0] * v.b.re + c2[1] * v.b.im;
        const Exact_pair z{Rational((k1 * v.b.im - k2 * v.a.im) / w), Rational((v.a.re * k2 - v.b.re * k1) / w)};
        const auto squared = [&](const Exact_pair& c) { return Rational((z[0] - c[0]) * (z[0] - c[0]) + (z[1] - c[1]) * (z[1] - c[1])); };
        const int s = sgn(Rational(w * (squared(c1) - squared(c2)))) * sgn(plain_value<2>(f, {t, r}));
        ok = ok && (s != 0 || squared(c1) == squared(c2));
        if (orientation == 0) orientation = s;
        ok = ok && (s == 0 || s == orientation);
      }
      const bool circles = kind_of(a) == Carrier::Kind::circle || kind_of(b) == Carrier::Kind::circle;
      samples.expect(ok && (circles || orientation <= 0), [&] { return show(a, b); });
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 90);
}

// ------------------------------------------------------------------------------------------------- special curves

TEST_CASE("on a circle F3 is divided by the squared denominator and nothing else", "[f3]")
{
  Random random(106);
  Samples samples;
  with_upward_rounding([&] {
    for (int k = 0; k < 60; ++k) {
      const Exact_pair h0{1, random.between(-2, 2)}, h1{1, random.between(-2, 2)};
      if (h0[1] == h1[1] || 1 + h0[1] * h1[1] <= 0) continue;
      Control_curve arc = circular_arc({random.rational(), random.rational()}, Rational(random.between(1, 20)) / 7, h0, h1);
      if (random.chance(30)) arc = elevated(arc);
      if (random.chance(30)) arc = moebius(arc, Rational(random.between(1, 5)) / 3);
      const Control_curve other = random_curve(random, random.between(2, 3), Coordinates::dyadic, random.chance(50));
      const bool counterclockwise = h0[0] * h1[1] - h0[1] * h1[0] > 0;
      std::shared_ptr<const Planar_curve> q;
      try {
        q = planar(other);
      } catch (const locus::Unsupported_feature&) {
        continue;
      }
      const auto p = planar(arc);
      const Bernstein<Rational, 2> divided = Curve_pair_equation<F3_form>(p, q).exact().rational();
      const Bernstein<Rational, 2> general = locus::exact_form<F3_form>(*p, *q);
      const Bernstein<Rational, 2> swapped = Curve_pair_equation<F3_form>(q, p).exact().rational();
      samples.expect(p->is_circle(), [&] { return "not recognised: " + show(arc); });
      // On an arc of degree 2 the tangent is i·k·(p - cw) with a constant k. (Elevated ones have linear k > 0.)
      Rational factor = 0;
      bool ok = true;
      for (int i = 0; i < 5; ++i) {
        const Rational t = random_parameter(random), r = random_parameter(random);
        const Rational w = locus::evaluate_at(p->weight(), t);
        const Rational left = plain_value<2>(divided, {t, r}) * w * w, right = plain_value<2>(general, {t, r});
        ok = ok && sgn(left) == (counterclockwise ? 1 : -1) * sgn(right);
        if (right != 0 && arc.degree() == 2) {
          if (factor == 0) factor = left / right;
          ok = ok && left == factor * right;
        }
        ok = ok && sgn(plain_value<2>(swapped, {r, t})) == sgn(left); // e changes its sign, which is squared
      }
      samples.expect(ok, [&] { return show(arc, other); });
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 40);
}

TEST_CASE("carriers are recognised exactly, and not by a margin", "[f3]")
{
  Random random(107);
  Samples samples;
  const Rational tiny = two_to(-40);
  for (int k = 0; k < 40; ++k) {
    // A line of any degree: collinear control points in any order, with weights or without.
    const Exact_pair p{random.rational(), random.rational()}, d{random.rational(), Rational(1 + abs(random.rational()))};
    Control_curve line;
    const int n = random.between(1, 4);
    for (int i = 0; i <= n; ++i) {
      const Rational s = i + random.unit_rational() / 3;
      line.points.push_back({Rational(p[0] + s * d[0]), Rational(p[1] + s * d[1])});
      if (k % 2) line.weights.push_back(Rational(random.between(1, 9)) / 3);
    }
    samples.expect(kind_of(line) == Carrier::Kind::line, [&] { return "line " + show(line); });
    const auto carrier = locus::carrier_of(line.build().pieces()[0]);
    samples.expect(carrier.direction[0] * d[1] == carrier.direction[1] * d[0] && carrier.direction[0] * d[0] + carrier.direction[1] * d[1] > 0,
                   [&] { return "its direction " + show(line); });
    if (n > 1) {
      Control_curve bent = line;
      bent.points[1][0] += tiny * d[1];
      bent.points[1][1] -= tiny * d[0];
      samples.expect(kind_of(bent) == Carrier::Kind::general, [&] { return "bent line " + show(bent); });
    }
    // A circle, also elevated and reparametrised.
    const Exact_pair centre{random.rational(), random.rational()};
    const Rational radius = Rational(random.between(1, 30)) / 11;
    Control_curve arc = circular_arc(centre, radius, {4, Rational(random.between(-3, -1))}, {4, Rational(random.between(0, 3))});
    if (k % 3 == 1) arc = elevated(arc);
    if (k % 3 == 2) arc = moebius(arc, Rational(5, 3));
    const auto circle = locus::carrier_of(arc.build().pieces()[0]);
    samples.expect(circle.kind == Carrier::Kind::circle && circle.centre[0] == centre[0] && circle.centre[1] == centre[1] &&
                     circle.squared_radius == radius * radius,
                   [&] { return "circle " + show(arc); });
    for (const std::size_t coordinate : {std::size_t(0), std::size_t(1)}) {
      Control_curve bumped = arc;
      bumped.points[1][coordinate] += tiny;
      samples.expect(kind_of(bumped) == Carrier::Kind::general, [&] { return "bumped circle " + show(bumped); });
    }
    Control_curve heavier = arc;
    heavier.weights[1] += tiny;
    samples.expect(kind_of(heavier) == Carrier::Kind::general, [&] { return "circle with a changed weight " + show(heavier); });
  }
  // An ellipse, and a parabola through the same ends.
  samples.expect(kind_of(curve_of({{"2", "0"}, {"2", "1"}, {"0", "1"}}, {"1", "1", "2"})) == Carrier::Kind::general, "ellipse");
  samples.expect(kind_of(curve_of({{"1", "0"}, {"1", "1"}, {"0", "1"}})) == Carrier::Kind::general, "parabola");
  samples.expect(kind_of(curve_of({{"1", "0"}, {"1", "1"}, {"0", "1"}}, {"1", "1", "2"})) == Carrier::Kind::circle, "quarter circle");
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("cusps: inside refused, at an end divided out", "[f3]")
{
  const auto refused = [](const Control_curve& c) { return thrown<locus::Unsupported_feature>([&] { planar(c); }); };
  // x = s², y = s³ with s = 2u-1: a cusp at u = 1/2.
  CHECK(refused(curve_of({{"1", "-1"}, {"-1/3", "1"}, {"-1/3", "-1"}, {"1", "1"}})) == 1);
  // The same cusp at u = 1/3, and beyond the end.
  const Control_curve cusp = curve_of({{"0", "0"}, {"0", "0"}, {"1/3", "0"}, {"1", "1"}});
  CHECK(refused(part_of(cusp, Rational(-1), Rational(2))) == 1);
  CHECK(refused(part_of(cusp, Rational(-1, 1000000), Rational(1))) == 1);
  CHECK(refused(part_of(cusp, Rational(1, 1000000), Rational(1))) == 0);
  CHECK(refused(cusp) == 0);
  CHECK(refused(reversed(cusp)) == 0);
  // Rational: the same curve under a Möbius map; a line that turns back; a circle that turns back.
  CHECK(refused(moebius(part_of(cusp, Rational(-1), Rational(1)), Rational(7, 3))) == 1);
  CHECK(refused(curve_of({{"0", "0"}, {"2", "2"}, {"1", "1"}})) == 1);
  CHECK(refused(curve_of({{"0", "0"}, {"1", "1"}, {"2", "2"}})) == 0);
  CHECK(refused(curve_of({{"0", "0"}, {"0", "0"}, {"2", "2"}})) == 0);
  CHECK(refused(curve_of({{"0", "0"}, {"5", "5"}, {"-1", "-1"}, {"4", "4"}})) == 1);
  // Monotone with a standing point inside is refused as well: the tangent is regular in direction, but u is not.
  CHECK(refused(curve_of({{"-1", "0"}, {"1", "0"}, {"-1", "0"}, {"1", "0"}})) == 1);

  // A doubled end control point: F3 keeps no zero along r = 0, and the limit of the tangent stands in.
  with_upward_rounding([&] {
    const Control_curve doubled = curve_of({{"0", "0"}, {"0", "0"}, {"1", "2"}, {"3", "1"}});
    const Control_curve tripled = curve_of({{"3", "1"}, {"1", "2"}, {"1", "2"}, {"1", "2"}}); // a line, once reduced
    const Control_curve other = curve_of({{"0", "3"}, {"1", "5/2"}, {"2", "4"}, {"3", "3"}});
    for (const bool at_end : {false, true}) {
      const Control_curve c = at_end ? reversed(doubled) : doubled;
      const auto p = planar(c), q = planar(other);
      const auto f = Curve_pair_equation<F3_form>(p, q);
      CHECK(f.degrees()[0] == 3 * 3 - 1 - 1);
      const auto edge = locus::face(f.exact(), 0, at_end);
      CHECK_FALSE(edge.is_zero());
      // Same sign as the plain F3 inside, and as the one with the primitive tangent up to the end.
      const Plain_curve plain = Plain_curve(c).with_primitive_tangent(), second(other);
      bool same = true;
      for (int i = 0; i <= 10; ++i)
        for (int j = 0; j <= 10; ++j) {
          const Rational t = Rational(i) / 10, r = Rational(j) / 10;
          same = same && sgn(plain_value<2>(f.exact().rational(), {t, r})) == sgn(plain_f3(plain, second, t, r));
        }
      CHECK(same);
    }
    CHECK(Curve_pair_equation<F3_form>(planar(tripled), planar(other)).degrees()[0] == 6);
    CHECK(planar(tripled)->is_line());
  });
}

TEST_CASE("lines written with higher degree have the same zero set", "[f3]")
{
  Random random(108);
  Samples samples;
  with_upward_rounding([&] {
    for (int k = 0; k < 40; ++k) {
      const Control_curve line = random_curve(random, 1, Coordinates::dyadic, random.chance(40));
      const Control_curve other = random_curve(random, random.between(1, 3), Coordinates::dyadic, random.chance(40));
      const Control_curve high = random.chance(50) ? elevated(line) : elevated(elevated(line));
      if (thrown<locus::Unsupported_feature>([&] { planar(other); }) != 0) continue;
      const auto low_form = Curve_pair_equation<F3_form>(planar(line), planar(other)).exact().rational();
      const auto high_form = Curve_pair_equation<F3_form>(planar(high), planar(other)).exact().rational();
      bool ok = true;
      for (int i = 0; i < 6; ++i) {
        const Rational t = random_parameter(random), r = random_parameter(random);
        ok = ok && sgn(plain_value<2>(low_form, {t, r})) == sgn(plain_value<2>(high_form, {t, r}));
      }
      samples.expect(ok, [&] { return show(line, other); });
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 25);
}

// ------------------------------------------------------------------------------------------------- the problem

TEST_CASE("known factors of F3 are divided out, listed, and nothing else is", "[f3]")
{
  using Kind = locus::Degenerate_component::Kind;
  const auto problem = [](const Control_curve& a, const Control_curve& b) { return locus::f3_problem(planar(a), planar(b)); };
  with_upward_rounding([&] {
    Random random(109);
    // The arc that starts tangent to the line, F3 = 2 r G: one factor r, at r = 0 exactly.
    const Control_curve line = curve_of({{"-2", "0"}, {"0", "0"}}), arc = curve_of({{"0", "0"}, {"1", "0"}, {"1", "1"}}, {"1", "1/2", "1"});
    for (const bool swapped : {false, true}) {
      const auto p = swapped ? problem(arc, line) : problem(line, arc);
      REQUIRE(p.degenerate.size() == 1u);
      const auto& d = p.degenerate[0];
      CHECK(d.kind == Kind::infinity);
      CHECK(d.input == (swapped ? 0 : 1));
      CHECK(d.lo == 0.0);
      CHECK(d.hi == 0.0);
      CHECK(d.multiplicity == 1);
      const auto whole = Curve_pair_equation<F3_form>(p.first, p.second).exact().rational();
      const auto rest = p.system.equations[0]->exact().rational();
      CHECK(p.degrees[swapped ? 0u : 1u] == locus::Degrees<2>(whole.degrees())[swapped ? 0u : 1u] - 1);
      Rational factor = 0;
      bool same = true;
      for (int i = 0; i < 6; ++i) {
        const Rational t = random_parameter(random), r = random_parameter(random);
        const Rational ratio = plain_value<2>(whole, {t, r}) / plain_value<2>(rest, {t, r}) / (swapped ? t : r);
        if (i == 0) factor = ratio;
        same = same && ratio == factor;
      }
      CHECK(same);
      CHECK(factor != 0);
    }
    // A parabola tangent to the line inside, at r = 1/3 (found as an interval or exactly), and one that only crosses it.
    const Control_curve axis = curve_of({{"-1", "0"}, {"1", "0"}});
    const Control_curve touching = part_of(curve_of({{"-1", "1"}, {"0", "-1"}, {"1", "1"}}), Rational(1, 4), Rational(1)); // y = x² from -1/2 to 1
    const auto p = problem(axis, touching);
    REQUIRE(p.degenerate.size() == 1u);
    CHECK(p.degenerate[0].kind == Kind::infinity);
    CHECK(Rational(p.degenerate[0].lo) <= Rational(1, 3));
    CHECK(Rational(1, 3) <= Rational(p.degenerate[0].hi));
    CHECK(p.degenerate[0].hi - p.degenerate[0].lo < 1e-9);
    CHECK(problem(axis, translated(touching, Rational(0), two_to(-40))).degenerate.empty());
    CHECK(problem(axis, translated(touching, Rational(0), -two_to(-40))).degenerate.empty());
    // A circle and a parabola tangent to it at (1, 0): that parameter maps to the centre.
    const Control_curve circle = circular_arc({0, 0}, 1, {2, -1}, {2, 1});
    const Control_curve kiss = curve_of({{"1", "-1"}, {"1/2", "0"}, {"1", "1"}}); // x = 3/4 + y²/4
    CHECK(problem(circle, kiss).degenerate.empty());
    const Control_curve tangent = translated(kiss, Rational(1, 4), Rational(0)); // x = 1 + y²/4
    const auto c = problem(circle, tangent);
    REQUIRE(c.degenerate.size() == 1u);
    CHECK(c.degenerate[0].kind == Kind::centre);
    CHECK(c.degenerate[0].input == 1);
    CHECK(c.degenerate[0].lo <= 0.5);
    CHECK(c.degenerate[0].hi >= 0.5);
    CHECK(problem(circle, translated(tangent, two_to(-40), Rational(0))).degenerate.empty());
    // Equal curves: the fourth power of t - r (or of t + r - 1) and one genuine factor.
    const Control_curve parabola = curve_of({{"-1", "1"}, {"0", "0"}, {"1", "1"}});
    for (const bool reverse : {false, true}) {
      const auto same = problem(parabola, reverse ? reversed(parabola) : parabola);
      REQUIRE(same.degenerate.size() == 1u);
      CHECK(same.degenerate[0].kind == Kind::overlap);
      CHECK(same.degenerate[0].multiplicity == 4);
      CHECK(same.degenerate[0].line.reversed == reverse);
    }
    // Mirror images: one factor, an axis; a third of a degree away: none.
    const Control_curve bow = curve_of({{"0", "1"}, {"1", "3"}, {"2", "1/2"}, {"3", "2"}}), image = mirrored_in_x_axis(bow);
    CHECK(problem(bow, image).axis.has_value());
    CHECK_FALSE(problem(bow, image).axis_line.reversed);
    CHECK(problem(bow, reversed(image)).axis.has_value());
    CHECK(problem(bow, reversed(image)).axis_line.reversed);
    CHECK(problem(bow, image).degenerate.empty());
    Control_curve off = image;
    off.points[2][1] += two_to(-40);
    CHECK_FALSE(problem(bow, off).axis.has_value());
    // Both on one line or one circle: F3 = 0.
    CHECK(problem(curve_of({{"0", "0"}, {"1", "0"}}), curve_of({{"2", "0"}, {"3", "0"}})).system.equations[0]->exact().is_zero());
    CHECK(problem(circular_arc({1, 2}, 3, {1, 0}, {2, 1}), circular_arc({1, 2}, 3, {0, 1}, {-1, 2})).system.equations[0]->exact().is_zero());
    CHECK_FALSE(problem(curve_of({{"0", "0"}, {"1", "0"}}), curve_of({{"2", "1/1099511627776"}, {"3", "0"}})).system.equations[0]->exact().is_zero());
  });
}

TEST_CASE("a Möbius transformation of both curves multiplies F3 by a positive factor", "[f3]")
{
  // z ↦ 1/z on both curves: e, a and b change so that F3 of the images has the same sign, point by point. (The map is
  // applied to points and tangents exactly; curves of the library are compared with it through their own F3.)
  Random random(110);
  Samples samples;
  const auto inverse = [](const Exact_complex& z) {
    const Rational n = z.re * z.re + z.im * z.im;
    return Exact_complex{Rational(z.re / n), Rational(-z.im / n)};
  };
  with_upward_rounding([&] {
    for (int k = 0; k < 40; ++k) {
      const Control_curve a = random_curve(random, random.between(2, 3), Coordinates::fractions, false);
      const Control_curve b = random_curve(random, random.between(2, 3), Coordinates::fractions, false);
      const Plain_curve p(a), q(b);
      const Bernstein<Rational, 2> f = Curve_pair_equation<F3_form>(planar(a), planar(b)).exact().rational();
      bool ok = true;
      for (int i = 0; i < 4; ++i) {
        const Rational t = random_parameter(random), r = random_parameter(random);
        const Plain_values v = plain_values(p, q, t, r);
        const Exact_complex z1{horner(p.x, t), horner(p.y, t)}, z2{horner(q.x, r), horner(q.y, r)};
        const Exact_complex i1 = inverse(z1), i2 = inverse(z2), e{Rational(i1.re - i2.re), Rational(i1.im - i2.im)};
        const Exact_complex a1 = i1 * i1 * v.a, b1 = i2 * i2 * v.b; // up to the common factor -1
        const Rational g = -(e * e * conj(a1) * conj(b1)).im;
        ok = ok && sgn(g) == sgn(plain_value<2>(f, {t, r}));
      }
      samples.expect(ok, [&] { return show(a, b); });
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 40);
}
