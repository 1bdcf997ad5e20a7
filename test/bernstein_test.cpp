// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/function/bernstein_horner.h>
#include <locus/function/bernstein_operations.h>
#include <locus/function/bounded_bernstein.h>
#include <locus/function/complex_polynomial.h>
#include <locus/function/domain.h>
#include <locus/function/scaled_integer_bernstein.h>

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Bounded;
using locus::exact_rational;
using locus::Interval;
using locus::Scaled_integer;
using locus::with_upward_rounding;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int D>
using Point = std::array<Rational, static_cast<std::size_t>(D)>;

/// Inside the unit box, on its boundary, now and then outside.
template <int D>
Point<D> random_point(Random& random)
{
  Point<D> p;
  for (Rational& x : p) x = random.chance(20) ? random.rational() : random.unit_rational();
  return p;
}

/// The partial derivative from the definition: the basis functions of one variable differentiated.
template <int D>
Rational plain_derivative(const Bernstein<Rational, D>& f, int variable, const Point<D>& point)
{
  const auto v = static_cast<std::size_t>(variable);
  const int n = f.degrees()[v];
  const Rational u = point[v], w = 1 - u;
  Rational sum = 0;
  for (int i = 0; i <= n; ++i) {
    // Only row i of the variable is kept; its basis function is replaced by the derivative.
    Bernstein<Rational, D> row = f;
    Degrees<D> index{};
    std::size_t at = 0;
    do {
      if (index[v] != i) row[at] = 0;
      ++at;
    } while (locus::advance_index(index, f.degrees()));
    Point<D> elsewhere = point;
    elsewhere[v] = Rational(1, 3);
    const Rational weight = choose(n, i) * power(Rational(1, 3), i) * power(Rational(2, 3), n - i);
    Rational derived = 0;
    if (i > 0) derived += i * power(u, i - 1) * power(w, n - i);
    if (i < n) derived -= (n - i) * power(u, i) * power(w, n - i - 1);
    sum += plain_value(row, elsewhere) / weight * derived * choose(n, i);
  }
  return sum;
}

template <int D>
std::string show_form(const Bernstein<Rational, D>& f)
{
  return "degrees " + show(f.degrees()) + ", coefficients " + show(f.coefficients());
}

template <int D>
constexpr int highest_degree = D == 1   ? 8
                               : D == 2 ? 4
                                        : 3;

} // namespace

// ------------------------------------------------------------------------------------------------------- the array

TEST_CASE("coefficients lie in memory with the last index running fastest", "[bernstein]")
{
  const Degrees<3> degrees{2, 1, 3};
  CHECK(locus::coefficient_count(degrees) == 24u);
  Bernstein<double, 3> f(degrees);
  CHECK(f.size() == 24u);
  std::size_t expected = 0, wrong = 0, steps = 0;
  Degrees<3> walk{};
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 1; ++j)
      for (int k = 0; k <= 3; ++k) {
        wrong += f.index({i, j, k}) != expected || walk != Degrees<3>{i, j, k};
        f.at({i, j, k}) = static_cast<double>(expected);
        wrong += f[expected] != static_cast<double>(expected);
        ++expected;
        const bool more = locus::advance_index(walk, degrees);
        wrong += more != (expected < 24);
        ++steps;
      }
  CHECK(steps == 24u);
  CHECK(wrong == 0u);
  for (int v = 0; v < 3; ++v) {
    const locus::Layout layout = locus::layout_along(degrees, v);
    CHECK(layout.outer * layout.count * layout.inner == 24u);
    CHECK(layout.count == static_cast<std::size_t>(degrees[static_cast<std::size_t>(v)]) + 1);
    Degrees<3> unit{};
    unit[static_cast<std::size_t>(v)] = 1;
    CHECK(layout.inner == f.index(unit));
  }
  CHECK(Bernstein<Rational, 2>().size() == 1u);
  CHECK(Bernstein<Rational, 2>()[0] == 0);
}

TEST_CASE("binomials agree with Pascal's rule and with GMP", "[bernstein]")
{
  Samples samples;
  for (int n = 0; n <= 80; ++n)
    for (int k = 0; k <= n; ++k) {
      const Integer exact = choose(n, k);
      samples.expect(locus::binomial<Integer>(n, k) == exact, [&] { return show(n) + " over " + show(k); });
      samples.expect(locus::binomial<Rational>(n, k) == exact, [&] { return show(n) + " over " + show(k); });
      if (n > 0 && k > 0 && k < n)
        samples.expect(locus::binomial<Integer>(n, k) ==
                         locus::binomial<Integer>(n - 1, k - 1) + locus::binomial<Integer>(n - 1, k),
                       [&] { return "Pascal, " + show(n) + " over " + show(k); });
      const Rational error = abs(Rational(exact_rational(locus::binomial<double>(n, k)) - exact));
      samples.expect(n <= 56 ? error == 0 : error <= exact * two_to(-52),
                     [&] { return "double, " + show(n) + " over " + show(k); });
      double lo = 0, hi = 0;
      with_upward_rounding([&] {
        const Interval b = locus::binomial<Interval>(n, k);
        lo = b.inf();
        hi = b.sup();
      });
      samples.expect(exact_rational(lo) <= exact && exact <= exact_rational(hi) &&
                       (lo == hi) == (exact_rational(lo) == exact) && hi <= std::nextafter(lo, infinity),
                     [&] { return "interval, " + show(n) + " over " + show(k); });
    }
  LOCUS_REQUIRE_SAMPLES(samples, 15000);
}

// -------------------------------------------------------------------------- exact operations against the definition

namespace {

template <int D>
void check_exact_operations(Random& random, Samples& samples)
{
  const auto df = random.degrees<D>(0, highest_degree<D>), dg = random.degrees<D>(0, highest_degree<D>);
  const auto f = random.polynomial<D>(df), g = random.polynomial<D>(dg);
  const Point<D> p = random_point<D>(random);
  const int v = random.below(D);
  const auto vv = static_cast<std::size_t>(v);
  const Rational fp = plain_value(f, p), gp = plain_value(g, p);
  const auto expect = [&](const char* what, bool ok) {
    samples.expect(ok, [&] {
      return std::string(what) + ", variable " + show(v) + " at " + show(p) + "\nf: " + show_form(f) +
             "\ng: " + show_form(g);
    });
  };

  expect("evaluate", locus::evaluate(f, p) == fp);

  Degrees<D> sum_degrees{}, max_degrees{};
  for (std::size_t k = 0; k < df.size(); ++k) {
    sum_degrees[k] = df[k] + dg[k];
    max_degrees[k] = std::max(df[k], dg[k]);
  }
  const auto product = locus::multiply(f, g);
  expect("product", plain_value(product, p) == fp * gp && product.degrees() == sum_degrees);
  const auto sum = locus::add(f, g);
  expect("sum", plain_value(sum, p) == fp + gp && sum.degrees() == max_degrees);
  const auto difference = locus::subtract(f, g);
  expect("difference", plain_value(difference, p) == fp - gp && difference.degrees() == max_degrees);
  const Rational factor = random.rational();
  expect("multiple", plain_value(locus::multiply(f, factor), p) == fp * factor);

  const int by = random.below(4);
  const auto raised = locus::elevate(f, v, by);
  Degrees<D> raised_degrees = df;
  raised_degrees[vv] += by;
  expect("elevate", plain_value(raised, p) == fp && raised.degrees() == raised_degrees);

  const auto slope = locus::derivative(f, v);
  Degrees<D> slope_degrees = df;
  slope_degrees[vv] = std::max(0, df[vv] - 1);
  expect("derivative", plain_value(slope, p) == plain_derivative(f, v, p) && slope.degrees() == slope_degrees);

  // A cut at s: the low part at u is f at s·u, the high part is f at s + (1-s)·u.
  const Rational s = random.chance(20) ? random.rational() : random.unit_rational();
  const auto parts = locus::split(f, v, s);
  Point<D> low = p, high = p;
  low[vv] = s * p[vv];
  high[vv] = s + (1 - s) * p[vv];
  expect("low part", plain_value(parts.first, p) == plain_value(f, low) && parts.first.degrees() == df);
  expect("high part", plain_value(parts.second, p) == plain_value(f, high) && parts.second.degrees() == df);

  Rational lo = random.chance(20) ? random.rational() : random.unit_rational(), hi = random.unit_rational();
  if (lo > hi) std::swap(lo, hi);
  const auto part = locus::restrict_to(f, v, lo, hi);
  Point<D> inside = p;
  inside[vv] = lo + p[vv] * (hi - lo);
  expect("restriction", plain_value(part, p) == plain_value(f, inside) && part.degrees() == df);

  if constexpr (D > 1) {
    for (const bool side : {false, true}) {
      const auto on_face = locus::face(f, v, side);
      Point<D - 1> q;
      for (std::size_t k = 0, j = 0; k < p.size(); ++k)
        if (k != vv) q[j++] = p[k];
      Point<D> there = p;
      there[vv] = side ? 1 : 0;
      expect("face", plain_value(on_face, q) == plain_value(f, there));
    }
  }

  const auto scaled = locus::scaled_by_binomials(f, false);
  expect("scaled basis and back", locus::scaled_by_binomials(scaled, true).coefficients() == f.coefficients());
  Rational in_scaled_basis = 0;
  Degrees<D> index{};
  std::size_t at = 0;
  do {
    Rational term = scaled[at++];
    for (std::size_t k = 0; k < p.size(); ++k)
      term *= power(p[k], index[k]) * power(Rational(1 - p[k]), df[k] - index[k]);
    in_scaled_basis += term;
  } while (locus::advance_index(index, df));
  expect("scaled basis", in_scaled_basis == fp);
}

/// f·g divided by g gives f; with one coefficient moved it must throw.
template <int D>
void check_division(Random& random, Samples& samples)
{
  const auto df = random.degrees<D>(0, D == 1 ? 6 : 3);
  auto dg = random.degrees<D>(0, D == 1 ? 5 : 2);
  const auto f = random.polynomial<D>(df);
  auto g = random.polynomial<D>(dg);
  for (std::size_t i = 0,
                   zeros = random.chance(40) ? static_cast<std::size_t>(random.below(static_cast<int>(g.size()))) : 0;
       i < zeros; ++i)
    g[i] = 0; // vanishing at the first corners: the division must start later
  if (std::all_of(g.coefficients().begin(), g.coefficients().end(), [](const Rational& c) { return c == 0; }))
    g[g.size() - 1] = 1;
  auto product = locus::multiply(f, g);
  const auto describe = [&] { return "f: " + show_form(f) + "\ng: " + show_form(g); };
  samples.expect(locus::divide_exactly(product, g).coefficients() == f.coefficients(), describe);
  const bool constant = g.size() == 1;
  product[static_cast<std::size_t>(random.below(static_cast<int>(product.size())))] +=
    random.chance(50) ? Rational(1) : two_to(-200);
  // The moved product minus the product is one basis function, which only constants and products of u and 1-u divide.
  bool g_is_monomial = false;
  {
    std::size_t terms = 0;
    for (const Rational& c : g.coefficients()) terms += c != 0;
    g_is_monomial = terms == 1;
  }
  if (!constant && !g_is_monomial)
    samples.expect(thrown<std::domain_error>([&] { locus::divide_exactly(product, g); }) == 1,
                   [&] { return "did not throw; " + describe(); });
  Bernstein<Rational, D> zero(dg);
  samples.expect(thrown<std::domain_error>([&] { locus::divide_exactly(product, zero); }) == 1,
                 [&] { return "division by zero; " + describe(); });
  const auto too_high = locus::elevate(product, random.below(D), 1);
  samples.expect(thrown<std::domain_error>([&] { locus::divide_exactly(product, too_high); }) == 1,
                 [&] { return "higher degree; " + describe(); });
}

template <int D, int E>
void check_substitution(Random& random, Samples& samples)
{
  const auto f = random.polynomial<D>(random.degrees<D>(0, 3));
  std::array<Bernstein<Rational, E>, static_cast<std::size_t>(D)> g;
  for (auto& inner : g) inner = random.polynomial<E>(random.degrees<E>(0, 2));
  const auto composed = locus::substitute(f, g);
  const Point<E> p = random_point<E>(random);
  Point<D> image;
  for (std::size_t k = 0; k < image.size(); ++k) image[k] = plain_value(g[k], p);
  samples.expect(plain_value(composed, p) == plain_value(f, image),
                 [&] { return "f: " + show_form(f) + "\nat " + show(p); });
}

} // namespace

TEST_CASE("exact operations agree with the definition at random points", "[bernstein][exact]")
{
  Random random(11);
  Samples samples;
  for (int i = 0; i < 150; ++i) check_exact_operations<1>(random, samples);
  for (int i = 0; i < 80; ++i) check_exact_operations<2>(random, samples);
  for (int i = 0; i < 40; ++i) check_exact_operations<3>(random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 2800);
}

TEST_CASE("exact division undoes the product and refuses all else", "[bernstein][exact]")
{
  Random random(12);
  Samples samples;
  for (int i = 0; i < 150; ++i) check_division<1>(random, samples);
  for (int i = 0; i < 60; ++i) check_division<2>(random, samples);
  for (int i = 0; i < 20; ++i) check_division<3>(random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 800);
}

TEST_CASE("substitution composes", "[bernstein][exact]")
{
  Random random(13);
  Samples samples;
  for (int i = 0; i < 60; ++i) {
    check_substitution<1, 1>(random, samples);
    check_substitution<1, 2>(random, samples);
    check_substitution<2, 1>(random, samples);
    check_substitution<2, 2>(random, samples);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 240);
}

TEST_CASE("the change between the monomial and the Bernstein basis is exact both ways", "[bernstein][exact]")
{
  Random random(14);
  Samples samples;
  for (int i = 0; i < 120; ++i) {
    const int n = random.between(0, 12);
    Polynomial a;
    for (int k = 0; k <= n; ++k) a.push_back(random.rational());
    const auto f = locus::from_monomial(a);
    const Rational u = random_point<1>(random)[0];
    const auto describe = [&] { return show(a) + " at " + show(u); };
    samples.expect(f.degree() == n && plain_value(f, {u}) == horner(a, u), describe);
    samples.expect(f.coefficients() == bernstein_on_unit(a, n).coefficients(), describe);
    samples.expect(locus::to_monomial(f) == a, describe);
    samples.expect(locus::evaluate_at(f, u) == horner(a, u), describe);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 480);
}

TEST_CASE("transposing swaps the variables", "[bernstein][exact]")
{
  Random random(15);
  Samples samples;
  for (int i = 0; i < 40; ++i) {
    const auto f = random.polynomial<2>(random.degrees<2>(0, 5));
    const auto t = locus::transpose(f);
    const Point<2> p = random_point<2>(random);
    samples.expect(t.degree(0) == f.degree(1) && t.degree(1) == f.degree(0) &&
                     plain_value(t, {p[1], p[0]}) == plain_value(f, p),
                   [&] { return show_form(f); });
    samples.expect(locus::transpose(t).coefficients() == f.coefficients(), [&] { return show_form(f); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 80);
}

// ------------------------------------------------------------------- the same operations for every coefficient type

namespace {

enum class Operation { sum, difference, product, derivative, elevation, low_part, high_part, restriction };
constexpr std::array<Operation, 8> operations{Operation::sum,        Operation::difference, Operation::product,
                                              Operation::derivative, Operation::elevation,  Operation::low_part,
                                              Operation::high_part,  Operation::restriction};
constexpr std::array<const char*, 8> operation_names{"sum",       "difference", "product",   "derivative",
                                                     "elevation", "low part",   "high part", "restriction"};

/// What the operations need besides their operands; doubles, so that every type takes them exactly.
struct Parameters {
  int variable = 0, by = 0;
  double at = 0.5, lo = 0, hi = 1;
};

Parameters random_parameters(Random& random, int dimension)
{
  Parameters p;
  p.variable = random.below(dimension);
  p.by = random.below(4);
  switch (random.below(5)) {
  case 0:
    p.at = 0.5;
    break;
  case 1:
    p.at = static_cast<double>(random.below(17)) / 16;
    break;
  case 2:
    p.at = 3 * random.symmetric();
    break; // outside: an extrapolation
  default:
    p.at = random.unit();
  }
  p.lo = random.chance(25) ? 2 * random.symmetric() : random.chance(30) ? 0.0 : random.unit();
  p.hi = random.chance(25) ? 2 * random.symmetric() : random.chance(30) ? 1.0 : random.unit();
  if (random.chance(10)) p.hi = p.lo; // a point
  if (p.lo > p.hi) std::swap(p.lo, p.hi);
  return p;
}

template <class T>
auto parameter(double x)
{
  if constexpr (std::is_same_v<T, Bounded>) return x;
  else if constexpr (std::is_same_v<T, Scaled_integer>) return exact_rational(x);
  else return T(x);
}

template <class T, int D>
[[gnu::noinline]] Bernstein<T, D> apply(Operation operation, const Bernstein<T, D>& f, const Bernstein<T, D>& g,
                                        const Parameters& p)
{
  switch (operation) {
  case Operation::sum:
    return locus::add(f, g);
  case Operation::difference:
    if constexpr (std::is_same_v<T, Bounded> || std::is_same_v<T, Scaled_integer>)
      return locus::add(f, g); // they have none
    else return locus::subtract(f, g);
  case Operation::product:
    return locus::multiply(f, g);
  case Operation::derivative:
    return locus::derivative(f, p.variable);
  case Operation::elevation:
    return locus::elevate(f, p.variable, p.by);
  case Operation::low_part:
    return locus::split(f, p.variable, parameter<T>(p.at)).first;
  case Operation::high_part:
    return locus::split(f, p.variable, parameter<T>(p.at)).second;
  default:
    return locus::restrict_to(f, p.variable, parameter<T>(p.lo), parameter<T>(p.hi));
  }
}

template <int D>
double greatest_coefficient(const Bernstein<Rational, D>& f)
{
  double m = 0;
  for (const Rational& c : f.coefficients()) m = std::max(m, std::abs(locus::nearest_double(c)));
  return m;
}

double growth_at(double at, int n) { return std::pow(std::abs(at) + std::abs(1 - at) + 1e-9, n); }

/// By how much an operation may multiply errors of magnitude `ef` and `eg` in its operands of magnitude nf and ng.
double amplified(Operation operation, const Parameters& p, int n, double nf, double ng, double ef, double eg)
{
  switch (operation) {
  case Operation::sum:
  case Operation::difference:
    return ef + eg;
  case Operation::product:
    return ef * (ng + eg) + (nf + ef) * eg;
  case Operation::derivative:
    return 2 * n * ef;
  case Operation::elevation:
    return ef;
  case Operation::low_part:
  case Operation::high_part:
    return ef * growth_at(p.at, n);
  default: { // the second cut is rounded itself
    const double first = p.lo <= 0.5 ? p.lo : p.hi, second = p.lo <= 0.5 ? (p.hi - p.lo) / (1 - p.lo) : p.lo / p.hi;
    return ef * growth_at(first, n) * growth_at(second, n) * (1 + std::abs(second));
  }
  }
}

std::string describe(Operation operation, const Parameters& p)
{
  return std::string(operation_names[static_cast<std::size_t>(operation)]) + " of variable " + show(p.variable) +
         ", by " + show(p.by) + ", at " + show(p.at) + ", to [" + show(p.lo) + ", " + show(p.hi) + "]";
}

template <int D>
Bernstein<double, D> random_reals(Random& random, const Degrees<D>& degrees, Random::Size size)
{
  Bernstein<double, D> f(degrees);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = random.real(size);
  return f;
}

template <int D>
Bernstein<Rational, D> exactly(const Bernstein<double, D>& f)
{
  return locus::converted<Rational>(f, [](double c) { return exact_rational(c); });
}

/// Plain doubles and intervals (from doubles, or around rationals) against exact coefficients.
template <int D>
void check_approximate_operations(Random& random, Samples& samples)
{
  const auto df = random.degrees<D>(0, highest_degree<D>), dg = random.degrees<D>(0, highest_degree<D>);
  const Parameters p = random_parameters(random, D);
  const bool from_rationals = random.chance(50);
  const auto size = random.chance(50) ? Random::Size::plain : Random::Size::integers;
  const auto fd = random_reals<D>(random, df, size), gd = random_reals<D>(random, dg, size);
  Bernstein<Rational, D> f = exactly(fd), g = exactly(gd);
  if (from_rationals) {
    for (std::size_t i = 0; i < f.size(); ++i) f[i] += random.rational() / 1000000;
    for (std::size_t i = 0; i < g.size(); ++i) g[i] += random.rational() / 1000000;
  }
  const double nf = greatest_coefficient(f) + 1e-30, ng = greatest_coefficient(g) + 1e-30;
  const int n = df[static_cast<std::size_t>(p.variable)];
  int total = 0;
  for (std::size_t k = 0; k < df.size(); ++k) total += df[k] + dg[k];
  for (const Operation operation : operations) {
    const auto exact = apply(operation, f, g, p);
    // 2^-52 for each rounding along the longest chain of operations.
    const double roundings = 16.0 * (total + 4) * (static_cast<double>(f.size()) + 4);
    const double tolerance =
      amplified(operation, p, n, nf, ng, nf * roundings * 0x1p-52, ng * roundings * 0x1p-52) + 1e-300;
    const auto say = [&] { return describe(operation, p) + "\nf: " + show_form(f) + "\ng: " + show_form(g); };

    if (!from_rationals) {
      const auto result = apply(operation, fd, gd, p);
      bool close = result.degrees() == exact.degrees();
      for (std::size_t i = 0; close && i < exact.size(); ++i)
        close = abs(Rational(exact_rational(result[i]) - exact[i])) <= exact_rational(tolerance);
      samples.expect(close, [&] { return "doubles: " + say(); });
    }

    std::vector<double> lo, hi;
    with_upward_rounding([&] {
      const auto enclose = [](const Rational& c) { return locus::enclosing(c); };
      const auto result =
        apply(operation, locus::converted<Interval>(f, enclose), locus::converted<Interval>(g, enclose), p);
      for (const Interval& c : result.coefficients()) {
        lo.push_back(c.inf());
        hi.push_back(c.sup());
      }
    });
    bool contained = lo.size() == exact.size(), narrow = contained;
    for (std::size_t i = 0; i < exact.size() && contained; ++i) {
      contained = exact_rational(lo[i]) <= exact[i] && exact[i] <= exact_rational(hi[i]);
      narrow = narrow && hi[i] - lo[i] <= 4 * tolerance;
    }
    samples.expect(contained, [&] { return "intervals, containment: " + say(); });
    samples.expect(narrow, [&] { return "intervals, width: " + say(); });
  }

  // Values.
  std::array<double, static_cast<std::size_t>(D)> u{};
  Point<D> at;
  for (std::size_t k = 0; k < u.size(); ++k)
    at[k] = exact_rational(u[k] = random.chance(20) ? random.below(3) * 0.5 : random.unit());
  const Rational value = plain_value(f, at);
  double lo = 0, hi = 0;
  with_upward_rounding([&] {
    const Interval v =
      locus::evaluate(locus::converted<Interval>(f, [](const Rational& c) { return locus::enclosing(c); }), u);
    lo = v.inf();
    hi = v.sup();
  });
  const double tolerance = 64 * nf * (total + 2) * 0x1p-52;
  samples.expect(exact_rational(lo) <= value && value <= exact_rational(hi),
                 [&] { return "interval value at " + show(at) + " of " + show_form(f); });
  samples.expect(hi - lo <= tolerance, [&] { return "width of the value at " + show(at) + " of " + show_form(f); });
  if (!from_rationals)
    samples.expect(abs(Rational(exact_rational(locus::evaluate(fd, u)) - value)) <= exact_rational(tolerance),
                   [&] { return "double value at " + show(at) + " of " + show_form(f); });
}

} // namespace

TEST_CASE("doubles stay near the exact results, intervals contain them and stay narrow", "[bernstein][interval]")
{
  Random random(21);
  Samples samples;
  for (int i = 0; i < 150; ++i) check_approximate_operations<1>(random, samples);
  for (int i = 0; i < 60; ++i) check_approximate_operations<2>(random, samples);
  for (int i = 0; i < 25; ++i) check_approximate_operations<3>(random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 4500);
}

TEST_CASE("interval substitution and change of basis contain the exact ones", "[bernstein][interval]")
{
  Random random(22);
  Samples samples;
  for (int i = 0; i < 40; ++i) {
    const auto f = random.polynomial<2>(random.degrees<2>(0, 3));
    const std::array<Bernstein<Rational, 1>, 2> g{random.polynomial<1>(random.degrees<1>(0, 3)),
                                                  random.polynomial<1>(random.degrees<1>(0, 3))};
    const auto exact = locus::substitute(f, g);
    const auto exact_monomial = locus::to_monomial(exact);
    const auto exact_back = locus::from_monomial(exact_monomial);
    bool composed = true, monomial = true, back = true;
    with_upward_rounding([&] {
      const auto enclose = [](const Rational& c) { return locus::enclosing(c); };
      const auto contains = [](const Interval& x, const Rational& y) {
        return !std::isnan(x.inf()) && !std::isnan(x.sup()) && (std::isinf(x.inf()) || exact_rational(x.inf()) <= y) &&
               (std::isinf(x.sup()) || y <= exact_rational(x.sup()));
      };
      const std::array<Bernstein<Interval, 1>, 2> inner{locus::converted<Interval>(g[0], enclose),
                                                        locus::converted<Interval>(g[1], enclose)};
      const auto result = locus::substitute(locus::converted<Interval>(f, enclose), inner);
      const auto in_monomials = locus::to_monomial(result);
      const auto again = locus::from_monomial(in_monomials);
      composed = result.size() == exact.size();
      for (std::size_t k = 0; composed && k < exact.size(); ++k) {
        composed = contains(result[k], exact[k]);
        monomial = monomial && contains(in_monomials[k], exact_monomial[k]);
        back = back && contains(again[k], exact_back[k]);
      }
    });
    samples.expect(composed, [&] { return "substitution: " + show_form(f); });
    samples.expect(monomial, [&] { return "to monomials: " + show_form(exact); });
    samples.expect(back, [&] { return "from monomials: " + show_form(exact); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 120);
}

// ----------------------------------------------------------------------------------- doubles with one error bound

namespace {

/// A bounded form and a polynomial that it stands for: some coefficients as far off as the bound allows.
template <int D>
struct Bounded_sample {
  Bernstein<Bounded, D> form;
  Bernstein<Rational, D> truth;
};

template <int D>
Bounded_sample<D> random_bounded(Random& random, const Degrees<D>& degrees, Random::Size size)
{
  const auto values = random_reals<D>(random, degrees, size);
  double norm = 0;
  for (double c : values.coefficients()) norm = std::max(norm, std::abs(c));
  double error = 0;
  switch (random.below(4)) {
  case 0:
    break;
  case 1:
    error = norm * random.unit() * 0x1p-48;
    break;
  case 2:
    error = norm * random.unit() * 4;
    break; // an error that hides the values
  default:
    error = random.between(1, 5) * std::numeric_limits<double>::denorm_min();
  }
  Bernstein<Rational, D> truth = exactly(values);
  const int shift = random.below(4);
  for (std::size_t i = 0; i < truth.size(); ++i)
    truth[i] += exact_rational(error) * (shift == 0   ? Rational(1)
                                         : shift == 1 ? Rational(-1)
                                         : shift == 2 ? Rational(random.between(-1, 1))
                                                      : Rational(exact_rational(random.symmetric())));
  return {Bernstein<Bounded, D>(values, error), std::move(truth)};
}

/// Whether a value and its error, as a caller may trust them, cover the truth.
bool covers(double value, double error, const Rational& truth)
{
  if (std::isnan(error) || error == infinity) return true; // no claim: every sign stays unknown
  return error >= 0 && std::isfinite(value) && abs(Rational(exact_rational(value) - truth)) <= exact_rational(error);
}

template <int D>
bool covers(const Bernstein<Bounded, D>& form, const Bernstein<Rational, D>& truth)
{
  if (form.degrees() != truth.degrees()) return false;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (!covers(form[i].value, form[i].error, truth[i])) return false;
  return true;
}

template <int D>
std::string show_sample(const Bounded_sample<D>& f)
{
  return "degrees " + show(f.form.degrees()) + ", values " + show(f.form.values().coefficients()) + ", error " +
         show(f.form.error());
}

template <int D>
void check_bounded_operations(Random& random, Samples& samples, int mode)
{
  const auto df = random.degrees<D>(0, highest_degree<D>), dg = random.degrees<D>(0, highest_degree<D>);
  const auto size = random.size();
  const auto f = random_bounded<D>(random, df, size);
  const auto g = random_bounded<D>(random, dg,
                                   random.chance(50)   ? size
                                   : random.chance(50) ? Random::Size::tiny
                                                       : Random::Size::plain);
  const Parameters p = random_parameters(random, D);
  const int n = df[static_cast<std::size_t>(p.variable)];
  const double nf = greatest_coefficient(exactly(f.form.values())), ng = greatest_coefficient(exactly(g.form.values()));
  int total = 0;
  for (std::size_t k = 0; k < df.size(); ++k) total += df[k] + dg[k];
  const double roundings = (10.0 * (total + 4) + static_cast<double>(f.form.size())) * 0x1p-52;
  const auto say = [&](const std::string& what) {
    return what + ", rounding " + mode_name(mode) + "\nf: " + show_sample(f) + "\ng: " + show_sample(g);
  };

  for (const Operation operation : operations) {
    if (operation == Operation::difference) continue;
    const auto truth = apply(operation, f.truth, g.truth, p);
    Bernstein<Bounded, D> result;
    in_mode(mode, [&] { result = apply(operation, f.form, g.form, p); });
    samples.expect(covers(result, truth),
                   [&] { return say(describe(operation, p)) + "\nerror " + show(result.error()); });
    // Not just a bound but a good one: what was inherited, and some dozens of roundings. (Near overflow there is none.)
    const double ef = f.form.error(), eg = g.form.error();
    const double good = 1.01 * amplified(operation, p, n, nf, ng, ef + 1e-321, eg + 1e-321) +
                        amplified(operation, p, n, nf + ef, ng + eg, (nf + ef) * roundings, (ng + eg) * roundings) +
                        amplified(operation, p, n, 1, 1, 1e-320, 1e-320) + 1e-320;
    samples.expect(result.error() <= good || good > 0x1p850, [&] {
      return say(describe(operation, p)) + "\nerror " + show(result.error()) + " above " + show(good);
    });
  }

  double norm = 0;
  in_mode(mode, [&] { norm = f.form.norm(); });
  bool within = true;
  for (const Rational& c : f.truth.coefficients()) within = within && abs(c) <= exact_rational(norm);
  if (mode == FE_TONEAREST || mode == FE_UPWARD) samples.expect(within, [&] { return say("norm " + show(norm)); });
  samples.expect(norm <= (nf + f.form.error()) * 1.0001 + 1e-320, [&] { return say("great norm " + show(norm)); });

  if constexpr (D > 1) {
    for (const bool side : {false, true})
      samples.expect(covers(locus::face(f.form, p.variable, side), locus::face(f.truth, p.variable, side)),
                     [&] { return say("face"); });
  }

  std::array<double, static_cast<std::size_t>(D)> u{};
  Point<D> at;
  const bool outside = random.chance(25);
  for (std::size_t k = 0; k < u.size(); ++k)
    at[k] = exact_rational(u[k] = outside             ? 6 * random.symmetric()
                                  : random.chance(25) ? random.below(3) * 0.5
                                                      : random.unit());
  Bounded value;
  in_mode(mode, [&] { value = locus::evaluate(f.form, u); });
  samples.expect(covers(value.value, value.error, plain_value(f.truth, at)),
                 [&] { return say("value at " + show(at)) + "\n" + show(value.value) + " with " + show(value.error); });
  if (!outside)
    samples.expect(value.error <= 1.01 * f.form.error() + (nf + f.form.error()) * roundings + 1e-320,
                   [&] { return say("error of the value at " + show(at)); });
}

} // namespace

TEST_CASE("every operation's error bound holds, in every rounding mode", "[bernstein][bounded]")
{
  Random random(31);
  Samples samples;
  for (const int mode : rounding_modes) {
    for (int i = 0; i < 500; ++i) check_bounded_operations<1>(random, samples, mode);
    for (int i = 0; i < 120; ++i) check_bounded_operations<2>(random, samples, mode);
    for (int i = 0; i < 40; ++i) check_bounded_operations<3>(random, samples, mode);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 40000);
}

TEST_CASE("the bounds hold at high degrees too, where binomials are rounded", "[bernstein][bounded]")
{
  Random random(32);
  Samples samples;
  for (const int mode : {FE_TONEAREST, FE_UPWARD})
    for (int i = 0; i < 6; ++i) {
      const auto f = random_bounded<1>(random, {random.between(25, 40)}, Random::Size::plain),
                 g = random_bounded<1>(random, {random.between(25, 40)}, Random::Size::plain);
      const auto truth = locus::multiply(f.truth, g.truth);
      Bernstein<Bounded, 1> product;
      in_mode(mode, [&] { product = locus::multiply(f.form, g.form); });
      samples.expect(covers(product, truth), [&] { return show_sample(f) + "\n" + show_sample(g); });
    }
  LOCUS_REQUIRE_SAMPLES(samples, 12);
}

TEST_CASE("where doubles overflow, the bound makes no false claim", "[bernstein][bounded][overflow]")
{
  Random random(33);
  Samples samples;
  for (const int mode : rounding_modes)
    for (int i = 0; i < 200; ++i) {
      Bounded_sample<1> f = random_bounded<1>(random, {random.between(1, 5)}, Random::Size::plain),
                        g = random_bounded<1>(random, {random.between(1, 5)}, Random::Size::plain);
      const double scale = random.chance(50) ? 0x1p1023 : 0x1p511;
      const auto enlarged = [&](const Bounded_sample<1>& s) {
        auto values = s.form.values();
        for (std::size_t k = 0; k < values.size(); ++k) values[k] *= scale;
        return Bounded_sample<1>{Bernstein<Bounded, 1>(values, 0), exactly(values)};
      };
      f = enlarged(f);
      g = enlarged(g);
      const Parameters p = random_parameters(random, 1);
      for (const Operation operation : operations) {
        if (operation == Operation::difference) continue;
        const auto truth = apply(operation, f.truth, g.truth, p);
        Bernstein<Bounded, 1> result;
        in_mode(mode, [&] { result = apply(operation, f.form, g.form, p); });
        samples.expect(covers(result, truth), [&] {
          return describe(operation, p) + ", rounding " + mode_name(mode) + "\nf: " + show_sample(f) +
                 "\ng: " + show_sample(g) + "\nresult " + show(result.values().coefficients()) + ", error " +
                 show(result.error());
        });
      }
    }
  LOCUS_REQUIRE_SAMPLES(samples, 5000);
}

TEST_CASE("bounded forms and interval forms enclose each other", "[bernstein][bounded]")
{
  Random random(34);
  Samples samples;
  for (int i = 0; i < 300; ++i) {
    const auto degrees = random.degrees<2>(0, 3);
    const auto f = random.polynomial<2>(degrees);
    Bernstein<Bounded, 2> form;
    bool back = true;
    double error = 0;
    with_upward_rounding([&] {
      const auto intervals = locus::converted<Interval>(f, [](const Rational& c) { return locus::enclosing(c); });
      form = locus::bounded(intervals);
      const auto again = locus::enclosing(form);
      for (std::size_t k = 0; k < f.size(); ++k) {
        back = back && exact_rational(again[k].inf()) <= f[k] && f[k] <= exact_rational(again[k].sup());
        error = std::max(error, again[k].sup() - again[k].inf());
      }
    });
    const double norm = greatest_coefficient(f);
    samples.expect(covers(form, f), [&] { return show_form(f); });
    samples.expect(back, [&] { return show_form(f); });
    samples.expect(error <= norm * 0x1p-49 && form.error() <= norm * 0x1p-51,
                   [&] { return "width " + show(error) + ": " + show_form(f); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 900);
}

TEST_CASE("bounded substitution covers the exact one", "[bernstein][bounded]")
{
  Random random(35);
  Samples samples;
  for (int i = 0; i < 60; ++i) {
    const auto f = random_bounded<2>(random, random.degrees<2>(0, 3), Random::Size::plain);
    const std::array<Bounded_sample<1>, 2> g{
      random_bounded<1>(random, random.degrees<1>(0, 2), Random::Size::plain),
      random_bounded<1>(random, random.degrees<1>(0, 2), Random::Size::integers)};
    const auto truth = locus::substitute(f.truth, std::array<Bernstein<Rational, 1>, 2>{g[0].truth, g[1].truth});
    Bernstein<Bounded, 1> result;
    with_upward_rounding([&] {
      result = locus::substitute(f.form, std::array<Bernstein<Bounded, 1>, 2>{g[0].form, g[1].form});
    });
    samples.expect(covers(result, truth),
                   [&] { return show_sample(f) + "\n" + show_sample(g[0]) + "\n" + show_sample(g[1]); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 60);
}

TEST_CASE("an unbounded coefficient leaves every sign of a bounded form unknown or true",
          "[bernstein][bounded][overflow]")
{
  Samples samples;
  for (const auto& ends : std::vector<std::pair<double, double>>{
         {-infinity, infinity}, {-1, infinity}, {-infinity, 1}, {2, infinity}, {-infinity, -2}})
    for (std::size_t at = 0; at < 3; ++at) {
      const double a = ends.first, b = ends.second;
      Bernstein<Bounded, 1> f;
      with_upward_rounding([&] {
        Bernstein<Interval, 1> intervals(Degrees<1>{2}, {Interval(1), Interval(1), Interval(1)});
        intervals[at] = Interval(a, b);
        f = locus::bounded(intervals);
      });
      const auto describe = [&] {
        return "coefficient " + show(static_cast<int>(at)) + " in [" + show(a) + ", " + show(b) + "]: value " +
               show(f[at].value) + ", error " + show(f.error());
      };
      const Sign s = locus::sign_of(f[at]);
      samples.expect(s == Sign::unknown || (s == Sign::positive && a > 0) || (s == Sign::negative && b < 0), describe);
      // The array has one bound for all: a finite one would vouch for every coefficient, in sorting and maxima too.
      samples.expect(!std::isfinite(f.error()) && !std::isfinite(f.norm()), describe);
    }
  LOCUS_REQUIRE_SAMPLES(samples, 30);
}

TEST_CASE("Horner's rule keeps to its stated number of roundings", "[bernstein][bounded]")
{
  Random random(36);
  Samples samples;
  for (const int mode : rounding_modes)
    for (int i = 0; i < 150; ++i) {
      const int n = random.chance(20) ? random.between(50, 70) : random.between(0, 20);
      const auto stride = static_cast<std::size_t>(random.between(1, 3));
      const auto size = random.size();
      const auto f = random_reals<1>(random, {n}, size);
      std::vector<double> spread((f.size() - 1) * stride + 1, 7.0);
      for (std::size_t k = 0; k < f.size(); ++k) spread[k * stride] = f[k];
      const double u = random.chance(20)   ? random.below(5) * 0.25
                       : random.chance(10) ? std::ldexp(random.unit(), -1060)
                                           : random.unit();
      double value = 0, error = 0;
      in_mode(mode, [&] {
        double norm = 0;
        for (double c : f.coefficients()) norm = std::max(norm, std::abs(c));
        value = locus::detail::horner_value(spread.data(), n, u, stride);
        error = locus::detail::accumulated_error(0, locus::detail::horner_operations(n), norm);
      });
      samples.expect(covers(value, error, plain_value(exactly(f), {exact_rational(u)})), [&] {
        return show(value) + " with " + show(error) + " at " + show(u) + ", rounding " + mode_name(mode) + ", of " +
               show(f.coefficients());
      });
    }
  LOCUS_REQUIRE_SAMPLES(samples, 600);
}

TEST_CASE("the tensor product's weighted sum keeps to its stated number of roundings", "[bernstein][bounded]")
{
  Random random(37);
  Samples samples;
  for (const int mode : rounding_modes)
    for (int i = 0; i < 60; ++i) {
      const int n = random.chance(4) ? 66 : random.below(8), m = random.chance(4) ? 65 : random.below(8);
      const auto f = random_reals<2>(random, {n, m}, random.size());
      const auto coordinate = [&] {
        return random.chance(25)   ? random.below(3) * 0.5
               : random.chance(10) ? std::ldexp(random.unit(), -1060)
                                   : random.unit();
      };
      const double u = coordinate(), v = coordinate();
      double value = 0, error = 0;
      in_mode(mode, [&] {
        double norm = 0;
        for (double c : f.coefficients()) norm = std::max(norm, std::abs(c));
        value = locus::detail::tensor_value(f.data(), n, m, u, v);
        error = locus::detail::accumulated_error(0, 6.0 * (n + m) + 8, norm);
      });
      samples.expect(covers(value, error, plain_value(exactly(f), {exact_rational(u), exact_rational(v)})), [&] {
        return show(value) + " with " + show(error) + " at " + show(u) + ", " + show(v) + ", rounding " +
               mode_name(mode) + ", degrees " + show(f.degrees()) + ", of " + show(f.coefficients());
      });
    }
  LOCUS_REQUIRE_SAMPLES(samples, 240);
}

// ------------------------------------------------------------------------------------------ integers over one scale

namespace {

template <int D>
bool same(const Bernstein<Scaled_integer, D>& f, const Bernstein<Rational, D>& g)
{
  if (f.degrees() != g.degrees() || f.scale() <= 0) return false;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (f[i] != g[i] || f.sign(i) != locus::sign_of(g[i])) return false;
  return f.rational().coefficients() == g.coefficients();
}

template <int D>
bool is_normal(const Bernstein<Scaled_integer, D>& f)
{
  for (const Integer& c : f.values().coefficients())
    if (mpz_odd_p(c.get_mpz_t())) return true;
  return f.is_zero();
}

template <int D>
void check_scaled_operations(Random& random, Samples& samples)
{
  const auto df = random.degrees<D>(0, highest_degree<D>), dg = random.degrees<D>(0, highest_degree<D>);
  auto f = random.polynomial<D>(df), g = random.polynomial<D>(dg);
  if (random.chance(10)) f = Bernstein<Rational, D>(df);
  const Bernstein<Scaled_integer, D> fs(f), gs(g);
  const Parameters p = random_parameters(random, D);
  const auto say = [&](const std::string& what) { return what + "\nf: " + show_form(f) + "\ng: " + show_form(g); };
  samples.expect(same(fs, f), [&] { return say("construction"); });
  samples.expect(fs.is_zero() == (fs.sign(0) == Sign::zero && greatest_coefficient(f) == 0),
                 [&] { return say("is_zero"); });
  for (const Operation operation : operations) {
    if (operation == Operation::difference) continue;
    const auto result = apply(operation, fs, gs, p);
    samples.expect(same(result, apply(operation, f, g, p)), [&] { return say(describe(operation, p)); });
    if (operation == Operation::low_part || operation == Operation::high_part || operation == Operation::restriction)
      samples.expect(is_normal(result), [&] { return say("common power of two, " + describe(operation, p)); });
  }
  // A cut at any fraction, not only at doubles.
  const Rational s = random.rational();
  const auto cut = locus::split(fs, p.variable, s);
  const auto expected = locus::split(f, p.variable, s);
  samples.expect(same(cut.first, expected.first) && same(cut.second, expected.second),
                 [&] { return say("cut at " + show(s)); });
  const Point<D> at = random_point<D>(random);
  samples.expect(locus::evaluate(fs, at) == plain_value(f, at), [&] { return say("value"); });
  if constexpr (D == 1)
    samples.expect(locus::sign_at(fs, at[0]) == locus::sign_of(plain_value(f, at)),
                   [&] { return say("sign at " + show(at[0])); });
  if constexpr (D > 1) {
    for (const bool side : {false, true})
      samples.expect(same(locus::face(fs, p.variable, side), locus::face(f, p.variable, side)),
                     [&] { return say("face"); });
  }
  if (greatest_coefficient(g) > 0)
    samples.expect(same(locus::divide_exactly(locus::multiply(fs, gs), gs), f), [&] { return say("division"); });
}

} // namespace

TEST_CASE("integers over one scale compute what rationals compute", "[bernstein][scaled]")
{
  Random random(41);
  Samples samples;
  for (int i = 0; i < 150; ++i) check_scaled_operations<1>(random, samples);
  for (int i = 0; i < 60; ++i) check_scaled_operations<2>(random, samples);
  for (int i = 0; i < 20; ++i) check_scaled_operations<3>(random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 3000);
}

TEST_CASE("integers over one scale substitute as rationals do", "[bernstein][scaled]")
{
  Random random(42);
  Samples samples;
  for (int i = 0; i < 30; ++i) {
    const auto f = random.polynomial<2>(random.degrees<2>(0, 3));
    const std::array<Bernstein<Rational, 1>, 2> g{random.polynomial<1>(random.degrees<1>(0, 3)),
                                                  random.polynomial<1>(random.degrees<1>(0, 3))};
    const std::array<Bernstein<Scaled_integer, 1>, 2> gs{Bernstein<Scaled_integer, 1>(g[0]),
                                                         Bernstein<Scaled_integer, 1>(g[1])};
    samples.expect(same(locus::substitute(Bernstein<Scaled_integer, 2>(f), gs), locus::substitute(f, g)),
                   [&] { return show_form(f); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 30);
}

TEST_CASE("repeated halving keeps integers as short as their values need", "[bernstein][scaled]")
{
  // After k halvings towards an end, the n-th differences shrink by 2^(-kn): the integers may grow by n bits a step.
  Random random(43);
  const int n = 6, steps = 20;
  Bernstein<Rational, 1> f(Degrees<1>{n});
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = random.between(-1000, 1000);
  Bernstein<Scaled_integer, 1> fs(f);
  std::size_t before = 0, after = 0;
  for (const Integer& c : fs.values().coefficients()) before = std::max(before, mpz_sizeinbase(c.get_mpz_t(), 2));
  for (int i = 0; i < steps; ++i)
    fs = i % 2 ? locus::split(fs, 0, Rational(1, 2)).first : locus::split(fs, 0, Rational(1, 2)).second;
  for (const Integer& c : fs.values().coefficients()) after = std::max(after, mpz_sizeinbase(c.get_mpz_t(), 2));
  CHECK(after <= before + static_cast<std::size_t>(n * steps));
  Rational lo = 0, hi = 1;
  for (int i = 0; i < steps; ++i) (i % 2 ? hi : lo) = (lo + hi) / 2;
  CHECK(fs[0] == plain_value(f, {lo}));
  CHECK(fs[static_cast<std::size_t>(n)] == plain_value(f, {hi}));
}

// ------------------------------------------------------------------------------------------- complex coefficients

namespace {

struct Complex {
  Rational re = 0, im = 0;
};

template <class T>
Complex complex_value(const locus::Complex_polynomial<T>& f, const Rational& u)
{
  Complex z;
  const int n = f.degree();
  for (int i = 0; i <= n; ++i) {
    const Rational b = power(u, i) * power(Rational(1 - u), n - i);
    z.re += b * f.re[static_cast<std::size_t>(i)];
    if (!f.is_real()) z.im += b * f.im[static_cast<std::size_t>(i)];
  }
  return z;
}

template <class T>
locus::Complex_polynomial<T> random_complex(Random& random, int n)
{
  locus::Complex_polynomial<T> f;
  const bool real = random.chance(25);
  for (int i = 0; i <= n; ++i) {
    f.re.push_back(T(random.between(-9, 9)));
    if (!real) f.im.push_back(T(random.between(-9, 9)));
  }
  return f;
}

} // namespace

TEST_CASE("complex polynomials multiply, combine and expand as their values do", "[bernstein][complex]")
{
  Random random(51);
  Samples samples;
  for (int i = 0; i < 150; ++i) {
    const auto f = random_complex<Rational>(random, random.below(5)),
               g = random_complex<Rational>(random, random.below(5));
    const Rational u = random.unit_rational(), v = random.unit_rational();
    const Complex a = complex_value(f, u), b = complex_value(g, u), product = complex_value(locus::multiply(f, g), u);
    const auto describe = [&] {
      return show(f.re) + " + i" + show(f.im) + " and " + show(g.re) + " + i" + show(g.im) + " at " + show(u);
    };
    samples.expect(product.re == a.re * b.re - a.im * b.im && product.im == a.re * b.im + a.im * b.re, describe);
    for (const int sign : {1, -1}) {
      const Complex sum = complex_value(locus::combine(f, g, sign), u);
      samples.expect(sum.re == a.re + sign * b.re && sum.im == a.im + sign * b.im, describe);
    }
    const Complex turned = complex_value(locus::multiply(f, Rational(2), Rational(-3)), u),
                  mirrored = complex_value(locus::conjugate(f), u), raised = complex_value(locus::elevate(f, 3), u);
    samples.expect(turned.re == 2 * a.re + 3 * a.im && turned.im == 2 * a.im - 3 * a.re, describe);
    samples.expect(mirrored.re == a.re && mirrored.im == -a.im, describe);
    samples.expect(raised.re == a.re && raised.im == a.im, describe);

    // Σ A_k(u)·B_k(v), real or imaginary part.
    locus::Separable_sum<Rational> sum;
    locus::Separable_sum<Integer> integers;
    sum.imaginary = integers.imaginary = random.chance(50);
    Complex total;
    for (int k = random.between(1, 3); k > 0; --k) {
      const auto x = random_complex<Integer>(random, random.below(4)),
                 y = random_complex<Integer>(random, random.below(4));
      const auto rational = [](const locus::Complex_polynomial<Integer>& z) {
        return locus::Complex_polynomial<Rational>{{z.re.begin(), z.re.end()}, {z.im.begin(), z.im.end()}};
      };
      const Complex p = complex_value(x, u), q = complex_value(y, v);
      // A sum of homogeneous terms of unlike degrees is meant with each raised to the highest: values agree.
      total.re += p.re * q.re - p.im * q.im;
      total.im += p.re * q.im + p.im * q.re;
      integers.terms.emplace_back(x, y);
      sum.terms.emplace_back(rational(x), rational(y));
    }
    const auto expanded = locus::expand(sum);
    samples.expect(plain_value(expanded, {u, v}) == (sum.imaginary ? total.im : total.re),
                   [] { return std::string("expansion"); });
    const auto up_to_factor = locus::expand(integers);
    Rational factor = 0;
    bool proportional = up_to_factor.degrees() == expanded.degrees();
    for (std::size_t k = 0; proportional && k < expanded.size(); ++k) {
      if (expanded[k] == 0) proportional = up_to_factor[k] == 0;
      else if (factor == 0) factor = Rational(up_to_factor[k]) / expanded[k];
      else proportional = up_to_factor[k] == factor * expanded[k];
    }
    samples.expect(proportional && factor >= 0, [] { return std::string("expansion in integers"); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1200);
}

// ------------------------------------------------------------------------------------------------------- domains

TEST_CASE("pieces of a domain map the unit interval, half lines included", "[bernstein][domain]")
{
  const locus::Piece span{Rational(2), Rational(5)};
  CHECK(*span.at(0) == 2);
  CHECK(*span.at(1) == 5);
  CHECK(*span.at(Rational(1, 3)) == 3);
  const locus::Piece right{Rational(1), Rational(0), false, true}, left{Rational(0), Rational(-1), true, false};
  CHECK(*right.at(0) == 1);
  CHECK(*right.at(Rational(3, 4)) == 4);
  CHECK_FALSE(right.at(1).has_value());
  CHECK(*left.at(1) == -1);
  CHECK(*left.at(Rational(1, 4)) == -4);
  CHECK_FALSE(left.at(0).has_value());
  locus::Domain<2> domain;
  CHECK(domain.cells() == 1u);
  domain.chains[0].pieces.resize(3);
  domain.chains[1].pieces.resize(2);
  domain.chains[0].joints.resize(2);
  domain.chains[1].joints.resize(2);
  CHECK(domain.cells() == 6u);
  CHECK_FALSE(domain.chains[0].is_closed());
  CHECK(domain.chains[1].is_closed());
  auto box = locus::Box<2>::unit();
  box.lo[1] = 0.25;
  CHECK(box.width(0) == 1);
  CHECK(box.width(1) == 0.75);
  CHECK(box.max_width() == 1);
}
