// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/function/spline_operations.h>

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Interval;
using locus::Knot_array;
using locus::Knots;
using locus::Spline;
using locus::Spline_span;
using locus::with_upward_rounding;

namespace {

template <int D>
using Point = std::array<Rational, static_cast<std::size_t>(D)>;

// ------------------------------------------------------------------------------ splines straight from the definition

/// The span for u by looking at each: the last of positive length whose lower end is not above u, and not beyond the
/// domain's last.
int plain_span(const Knots& knots, const Rational& u)
{
  int span = -1;
  for (int s = knots.degree; s < knots.control_count(); ++s)
    if (knots.value(s) < knots.value(s + 1) && knots.value(s) <= u) span = s;
  return span;
}

/// The basis function i of degree n at u by the recursion of Cox and de Boor, with 0/0 = 0.
Rational plain_basis(const Knots& knots, int i, int n, int span, const Rational& u)
{
  if (n == 0) return i == span ? 1 : 0;
  const Rational a = knots.value(i), b = knots.value(i + n), c = knots.value(i + 1), d = knots.value(i + n + 1);
  Rational sum = 0;
  if (b > a) sum += (u - a) / (b - a) * plain_basis(knots, i, n - 1, span, u);
  if (d > c) sum += (d - u) / (d - c) * plain_basis(knots, i + 1, n - 1, span, u);
  return sum;
}

template <int D>
Rational plain_value(const Knot_array<D>& knots, const std::vector<Rational>& coefficients, const Point<D>& point)
{
  std::vector<Rational> values = coefficients;
  for (std::size_t k = 0; k < point.size(); ++k) { // variable k is the outermost of those that are left
    const int n = knots[k].control_count(), span = plain_span(knots[k], point[k]);
    const std::size_t inner = values.size() / static_cast<std::size_t>(n);
    std::vector<Rational> sums(inner, Rational(0));
    for (int i = 0; i < n; ++i) {
      if (i < span - knots[k].degree || i > span) continue; // basis functions of other spans
      const Rational weight = plain_basis(knots[k], i, knots[k].degree, span, point[k]);
      for (std::size_t j = 0; j < inner; ++j) sums[j] += weight * values[static_cast<std::size_t>(i) * inner + j];
    }
    values = sums;
  }
  return values[0];
}

template <int D>
Rational plain_value(const Spline<Rational, D>& f, const Point<D>& point)
{
  return plain_value<D>(f.knots(), f.coefficients(), point);
}

template <int D>
bool same(const Spline<Rational, D>& f, const Spline<Rational, D>& g)
{
  return f.knots() == g.knots() && f.coefficients() == g.coefficients();
}

// ---------------------------------------------------------------------------------------------------- random splines

enum class Ends { clamped, unclamped, any };

/// Random knots over [-1, 2] with breaks at some sixths, so that two of them share breaks; inside, multiplicities up to
/// `highest`. Unclamped ends go on outside the domain, now and then with the end itself repeated, on either side of it.
Knots random_knots(Random& random, int degree, int spans, int highest, Ends ends)
{
  std::vector<Rational> inner;
  for (int i = 1; i < spans; ++i) {
    const Rational u = random.between(-5, 11);
    if (std::find(inner.begin(), inner.end(), u / 6) == inner.end()) inner.push_back(u / 6);
  }
  Knots knots{degree, {}};
  const auto add = [&](const Rational& u, int times) {
    knots.values.insert(knots.values.end(), static_cast<std::size_t>(times), u);
  };
  for (const Rational& u : inner) add(u, random.between(1, highest));
  const bool clamp = ends == Ends::clamped || (ends == Ends::any && random.chance(50));
  for (const int side : {-1, 1}) {
    const Rational end = side < 0 ? -1 : 2;
    if (clamp) {
      add(end, degree + 1);
      continue;
    }
    const int at_end = random.between(1, degree + 1);
    add(end, at_end);
    Rational u = end;
    for (int i = at_end; i <= degree; ++i) {
      if (i == at_end || random.chance(70)) u += Rational(side * random.between(1, 4)) / 3;
      add(u, 1);
    }
    if (ends == Ends::any && at_end <= degree && random.chance(30)) { // the domain's end stands once more than it needs
      add(end, 1);
    }
  }
  std::sort(knots.values.begin(), knots.values.end());
  return knots;
}

template <int D>
Spline<Rational, D> random_spline(Random& random, Ends ends, int highest_degree, int most_spans)
{
  Knot_array<D> knots;
  std::size_t count = 1;
  for (Knots& k : knots) {
    const int degree = random.between(0, highest_degree);
    k = random_knots(random, degree, random.between(1, most_spans),
                     random.chance(30) ? degree + 1 : std::max(1, degree - 1), ends);
    count *= static_cast<std::size_t>(k.control_count());
  }
  std::vector<Rational> coefficients;
  for (std::size_t i = 0; i < count; ++i)
    coefficients.push_back(random.chance(50) ? Rational(random.between(-9, 9)) : random.rational());
  return Spline<Rational, D>(knots, coefficients);
}

template <int D>
Spline<Rational, D> random_spline(Random& random, Ends ends = Ends::any)
{
  return random_spline<D>(random, ends, D == 1 ? 5 : D == 2 ? 3 : 2, D == 1 ? 6 : 3);
}

/// Inside the domain [-1, 2] of the random splines: between the knots, on a knot, at an end.
template <int D>
Point<D> random_point(Random& random)
{
  Point<D> p;
  for (Rational& x : p)
    x = random.chance(40) ? Rational(Rational(random.between(-6, 12)) / 6) : 3 * random.unit_rational() - 1;
  return p;
}

/// As above, never on a break of a random spline.
template <int D>
Point<D> point_between_breaks(Random& random)
{
  Point<D> p;
  for (Rational& x : p) x = Rational(random.between(-6, 11)) / 6 + Rational(random.between(1, 100), 607);
  return p;
}

std::string show_knots(const Knots& knots) { return "degree " + show(knots.degree) + " on " + show(knots.values); }

template <int D>
std::string show_spline(const Spline<Rational, D>& f)
{
  std::string text;
  for (const Knots& k : f.knots()) text += show_knots(k) + "; ";
  return text + "coefficients " + show(f.coefficients());
}

template <int D, class Check>
void for_random_splines(int stream, int times, Samples& samples, Check check)
{
  Random random(static_cast<std::uint64_t>(stream));
  for (int i = 0; i < times; ++i) {
    const auto f = random_spline<D>(random);
    check(random, f, [&](const char* what, bool ok) {
      samples.expect(ok, [&] { return std::string(what) + " of " + show_spline(f); });
    });
  }
}

/// The same check in one, two and three variables. `check` is a generic callable (random, spline, expect).
template <class Check>
void in_all_dimensions(int stream, int times, Samples& samples, Check check)
{
  for_random_splines<1>(stream, 4 * times, samples, check);
  for_random_splines<2>(stream + 1, 2 * times, samples, check);
  for_random_splines<3>(stream + 2, times, samples, check);
}

/// Another spline in as many variables, with breaks of its own over the same domain.
template <int D>
Spline<Rational, D> another(Random& random, const Spline<Rational, D>&)
{
  return random_spline<D>(random, Ends::any, D == 1 ? 4 : 2, 3);
}

template <int D>
Point<D> somewhere(Random& random, const Spline<Rational, D>&)
{
  return random_point<D>(random);
}

Spline<Rational, 1> spline(int degree, std::vector<Rational> values, std::vector<Rational> coefficients)
{
  return Spline<Rational, 1>({Knots{degree, std::move(values)}}, std::move(coefficients));
}

/// |x| over [-1, 1].
Spline<Rational, 1> absolute_value() { return spline(1, {-1, -1, 0, 1, 1}, {1, 0, 1}); }
Spline<Rational, 1> identity() { return spline(1, {-1, -1, 1, 1}, {-1, 1}); }

} // namespace

// -------------------------------------------------------------------------------------------------------------- knots

TEST_CASE("knots answer as counting one by one does", "[spline][knots]")
{
  Random random(201);
  Samples samples;
  for (int i = 0; i < 300; ++i) {
    const int degree = random.between(0, 5);
    const Knots knots = random_knots(random, degree, random.between(1, 7), degree + 1, Ends::any);
    locus::require_valid(knots);
    const Rational u = random_point<1>(random)[0];
    const auto describe = [&] { return show_knots(knots) + " at " + show(u); };
    samples.expect(knots.domain_lo() == -1 && knots.domain_hi() == 2, describe);
    samples.expect(knots.span_of(u) == plain_span(knots, u), describe);
    const auto count = static_cast<int>(std::count(knots.values.begin(), knots.values.end(), u));
    samples.expect(knots.multiplicity(u) == count, describe);
    samples.expect(knots.continuity(u) == (count == 0 ? Knots::unlimited : degree - count), describe);
    std::vector<Rational> breaks;
    for (int v = -6; v <= 12; ++v) {
      const Rational x = Rational(v) / 6;
      if (v == -6 || v == 12 || knots.multiplicity(x) > 0) breaks.push_back(x);
    }
    samples.expect(knots.breaks() == breaks, describe);
    const Knots clamped = locus::clamped(knots);
    bool as_before = clamped.multiplicity(-1) == degree + 1 && clamped.multiplicity(2) == degree + 1;
    for (std::size_t k = 1; k + 1 < breaks.size(); ++k)
      as_before = as_before && clamped.multiplicity(breaks[k]) == knots.multiplicity(breaks[k]);
    samples.expect(as_before && clamped.breaks() == breaks && clamped.domain_lo() == -1 && clamped.domain_hi() == 2,
                   describe);
    const Rational lo = random.rational(), hi = lo + 1 + random.unit_rational();
    const Knots moved = locus::reparametrised(knots, lo, hi);
    bool affine = moved.domain_lo() == lo && moved.domain_hi() == hi && moved.degree == degree;
    for (std::size_t k = 0; k < moved.values.size(); ++k)
      affine = affine && (moved.values[k] - lo) * 3 == (knots.values[k] + 1) * (hi - lo);
    samples.expect(affine, describe);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 2100);
}

TEST_CASE("knots and coefficients that make no spline are refused with the reason", "[spline][knots]")
{
  const auto refused = [](int degree, std::vector<Rational> values) {
    return thrown<std::invalid_argument>([&] { locus::require_valid(Knots{degree, values}); }) == 1;
  };
  CHECK(refused(-1, {0, 1}));
  CHECK(refused(1, {}));
  CHECK(refused(1, {0, 0, 1}));
  CHECK(refused(1, {0, 0, 2, 1, 3, 3}));
  CHECK(refused(1, {0, 0, 0, 1, 1, 1}));
  CHECK(refused(0, {0, 1, 1, 2}));
  CHECK(refused(1, {0, 1, 1, 2}));
  CHECK(refused(0, {1, 1}));
  CHECK_FALSE(refused(1, {0, 0, 1, 1}));
  CHECK_FALSE(refused(1, {0, 0, 1, 1, 2, 2}));
  CHECK_FALSE(refused(0, {0, 1}));
  CHECK_THROWS_WITH(locus::require_valid(Knots{1, {0, 0, 2, 1, 3, 3}}), "Knots: value 1 follows the greater 2");

  CHECK_THROWS_WITH(locus::require_valid(Knots{1, {0, 0, 1}}), "Knots: degree 1 needs at least 4 values, not 3");

  CHECK_THROWS_AS(spline(1, {0, 0, 2, 1, 3, 3}, {1, 2, 3, 4}), std::invalid_argument);
  CHECK_THROWS_AS(spline(1, {0, 0, 1, 1}, {1}), std::invalid_argument);
  CHECK_THROWS_AS(spline(1, {0, 0, 1, 1}, {1, 2, 3}), std::invalid_argument);
  CHECK_THROWS_AS(spline(2, {0, 0, 1, 1}, {1, 2}), std::invalid_argument);
  const Knots linear{1, {0, 0, 1, 1}};
  CHECK_THROWS_AS((Spline<Rational, 2>({linear, linear}, {1, 2, 3})), std::invalid_argument);
  CHECK_NOTHROW(Spline<Rational, 2>({linear, linear}, {1, 2, 3, 4}));

  CHECK_THROWS_AS(linear.span_of(Rational(-1, 9)), std::invalid_argument);
  CHECK_THROWS_AS(linear.span_of(Rational(10, 9)), std::invalid_argument);
  CHECK_THROWS_AS(locus::evaluate_at(identity(), Rational(2)), std::invalid_argument);
  CHECK_THROWS_AS(locus::reparametrised(linear, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(locus::reparametrised(identity(), 0, 2, 1), std::invalid_argument);
}

// --------------------------------------------------------------------------------------------- values and their spans

TEST_CASE("the value of a spline is that of Cox and de Boor's recursion", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(210, 40, samples, [](Random& random, const auto& f, const auto& expect) {
    for (int i = 0; i < 4; ++i) {
      const auto p = somewhere(random, f);
      expect("value", locus::evaluate(f, p) == plain_value(f, p));
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 1100);
}

namespace {

/// Whether the span's polynomial has the spline's values inside, on a grid that determines it.
template <int D>
bool agrees_inside(const Spline<Rational, D>& f, const Spline_span<Rational, D>& span)
{
  Degrees<D> i{};
  do {
    Point<D> local, p;
    for (std::size_t k = 0; k < p.size(); ++k) {
      local[k] = Rational(i[k] + 1) / (span.form.degrees()[k] + 2);
      p[k] = span.lo[k] + local[k] * (span.hi[k] - span.lo[k]);
    }
    if (locus_test::plain_value(span.form, local) != plain_value(f, p)) return false;
  } while (locus::advance_index(i, span.form.degrees()));
  return true;
}

} // namespace

TEST_CASE("spans come in order, fill the domain and are the spline's polynomials", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(220, 15, samples, [](Random&, const auto& f, const auto& expect) {
    const auto spans = locus::bezier_spans(f);
    auto last = f.degrees();
    for (std::size_t k = 0; k < last.size(); ++k) last[k] = static_cast<int>(f.knots()[k].breaks().size()) - 2;
    expect("number of spans", spans.size() == locus::coefficient_count(last));
    auto cell = last;
    cell.fill(0);
    for (const auto& span : spans) {
      bool placed = span.form.degrees() == f.degrees();
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const auto breaks = f.knots()[k].breaks();
        placed = placed && span.lo[k] == breaks[static_cast<std::size_t>(cell[k])] &&
                 span.hi[k] == breaks[static_cast<std::size_t>(cell[k]) + 1];
      }
      expect("place of a span", placed);
      expect("polynomial of a span", agrees_inside(f, span));
      locus::advance_index(cell, last);
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 800);
}

TEST_CASE("splines with known spans", "[spline][exact]")
{
  SECTION("without inner knots, clamped, the coefficients are Bernstein's")
  {
    const auto f = spline(3, {2, 2, 2, 2, 5, 5, 5, 5}, {1, -2, 3, 7});
    const auto spans = locus::bezier_spans(f);
    REQUIRE(spans.size() == 1);
    CHECK(spans[0].form.coefficients() == f.coefficients());
    CHECK(spans[0].lo[0] == 2);
    CHECK(spans[0].hi[0] == 5);
  }
  SECTION("a uniform quadratic")
  {
    const auto spans = locus::bezier_spans(spline(2, {0, 1, 2, 3, 4, 5, 6}, {4, 0, 2, 6}));
    REQUIRE(spans.size() == 2);
    CHECK(spans[0].form.coefficients() == std::vector<Rational>{2, 0, 1});
    CHECK(spans[1].form.coefficients() == std::vector<Rational>{1, 2, 4});
    CHECK(spans[1].lo[0] == 3);
  }
  SECTION("a jump: the value there is the one from above")
  {
    const auto f = spline(1, {0, 0, 1, 1, 2, 2}, {1, 2, 5, 6});
    const auto spans = locus::bezier_spans(f);
    REQUIRE(spans.size() == 2);
    CHECK(spans[0].form.coefficients() == std::vector<Rational>{1, 2});
    CHECK(spans[1].form.coefficients() == std::vector<Rational>{5, 6});
    CHECK(locus::evaluate_at(f, Rational(1)) == 5);
    CHECK(locus::evaluate_at(f, Rational(2)) == 6);
  }
  SECTION("degree zero: steps")
  {
    const auto f = spline(0, {0, 1, 3}, {7, 9});
    CHECK(locus::evaluate_at(f, Rational(0)) == 7);
    CHECK(locus::evaluate_at(f, Rational(1)) == 9);
    CHECK(locus::evaluate_at(f, Rational(3)) == 9);
    CHECK(locus::bezier_spans(f).size() == 2);
  }
  SECTION("zero-length spans at the ends of the domain are skipped")
  {
    const auto f = spline(2, {-1, 0, 1, 1, 2, 3, 3, 4, 5}, {100, 1, 2, 3, 4, 100});
    CHECK(f.knots(0).domain_lo() == 1);
    CHECK(f.knots(0).domain_hi() == 3);
    CHECK(locus::bezier_spans(f).size() == 2);
    CHECK(locus::evaluate_at(f, Rational(1)) == 1); // a double knot: the coefficient itself
    CHECK(locus::evaluate_at(f, Rational(3)) == 4);
  }
  SECTION("a periodic cubic is periodic")
  {
    const auto f = spline(3, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, {1, 5, -2, 4, 1, 5, -2});
    const auto spans = locus::bezier_spans(f);
    REQUIRE(spans.size() == 4);
    for (int order = 0; order < 3; ++order) {
      auto first = spans.front().form, last = spans.back().form;
      for (int i = 0; i < order; ++i) {
        first = locus::derivative(first);
        last = locus::derivative(last);
      }
      CHECK(first[0] == last[last.size() - 1]);
    }
  }
  SECTION("two variables: the last one runs fastest")
  {
    const Spline<Rational, 2> f({Knots{0, {0, 1, 2}}, Knots{1, {0, 0, 1, 1}}}, {1, 2, 3, 4});
    const auto spans = locus::bezier_spans(f);
    REQUIRE(spans.size() == 2);
    CHECK(spans[0].form.coefficients() == std::vector<Rational>{1, 2});
    CHECK(spans[1].form.coefficients() == std::vector<Rational>{3, 4});
    CHECK(f.size() == 4);
    CHECK(f[2] == 3);
    CHECK(f.degree(1) == 1);
    CHECK(f.last_index() == Degrees<2>{1, 1});
  }
}

// ---------------------------------------------------------------------------------------------------- changes of knots

namespace {

/// One knot inserted by Boehm's formula: each new coefficient is between two old ones that follow each other.
Spline<Rational, 1> plain_insertion(const Spline<Rational, 1>& f, const Rational& u)
{
  const Knots& t = f.knots(0);
  const int n = t.degree, span = plain_span(t, u);
  std::vector<Rational> c;
  for (int i = 0; i <= t.control_count(); ++i) {
    if (i <= span - n) c.push_back(f[static_cast<std::size_t>(i)]);
    else if (i > span) c.push_back(f[static_cast<std::size_t>(i) - 1]);
    else {
      const Rational a = (u - t.value(i)) / (t.value(i + n) - t.value(i));
      c.push_back((1 - a) * f[static_cast<std::size_t>(i) - 1] + a * f[static_cast<std::size_t>(i)]);
    }
  }
  std::vector<Rational> values = t.values;
  values.insert(values.begin() + span + 1, u);
  return Spline<Rational, 1>({Knots{n, values}}, c);
}

/// Whether some control coefficient acts nowhere in the domain.
template <int D>
bool has_idle_coefficients(const Spline<Rational, D>& f)
{
  return std::any_of(f.knots().begin(), f.knots().end(), [](const Knots& k) {
    return k.value(k.degree) == k.value(k.degree + 1) || k.value(k.control_count() - 1) == k.value(k.control_count());
  });
}

} // namespace

TEST_CASE("inserted knots keep the values, agree with Boehm's formula, and come out again", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(230, 30, samples, [](Random& random, const auto& f, const auto& expect) {
    const int v = random.below(f.dimension);
    std::vector<Rational> more;
    Knots expected = f.knots(v);
    for (int i = random.between(0, 3); i > 0; --i) {
      const Rational u = random.chance(50) ? Rational(Rational(random.between(-5, 11)) / 6)
                                           : Rational(Rational(random.between(-99, 199)) / 100);
      if (expected.multiplicity(u) > expected.degree) continue;
      more.push_back(u);
      expected.values.push_back(u);
      std::sort(expected.values.begin(), expected.values.end());
    }
    const auto g = locus::insert_knots(f, v, more);
    expect("knots after insertion", g.knots(v) == expected);
    for (int i = 0; i < 3; ++i) {
      const auto p = somewhere(random, f);
      expect("value after insertion", plain_value(g, p) == plain_value(f, p));
    }
    if (has_idle_coefficients(f)) return;
    expect("removal", same(locus::spline_from_spans(locus::bezier_spans(g), f.knots()), f));
    if constexpr (std::decay_t<decltype(f)>::dimension == 1) {
      auto plain = f;
      for (const Rational& u : more) plain = plain_insertion(plain, u);
      expect("Boehm's formula", same(g, plain));
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 900);
}

TEST_CASE("knots are inserted inside the domain only, and at most degree + 1 times", "[spline]")
{
  const auto f = absolute_value();
  CHECK(locus::insert_knots(f, 0, {0}).knots(0).multiplicity(0) == 2);
  CHECK_THROWS_AS(locus::insert_knots(f, 0, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(locus::insert_knots(f, 0, {-1}), std::invalid_argument);
  CHECK_THROWS_AS(locus::insert_knots(f, 0, {1}), std::invalid_argument);
  CHECK_THROWS_AS(locus::insert_knots(f, 0, {Rational(1, 2), 3}), std::invalid_argument);
  const auto unclamped = spline(1, {-2, -1, 1, 2}, {0, 1});
  CHECK(locus::insert_knots(unclamped, 0, {0}).coefficients() == std::vector<Rational>{0, Rational(1, 2), 1});
  CHECK_THROWS_AS(locus::insert_knots(unclamped, 0, {-1}), std::invalid_argument);
  CHECK_THROWS_AS(locus::insert_knots(unclamped, 0, {1}), std::invalid_argument);
}

TEST_CASE("clamping, restricting and reparametrising keep the values", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(240, 25, samples, [](Random& random, const auto& f, const auto& expect) {
    const auto g = locus::clamped(f);
    bool is_clamped = true;
    for (std::size_t k = 0; k < g.knots().size(); ++k)
      is_clamped = is_clamped && g.knots()[k] == locus::clamped(f.knots()[k]);
    expect("clamped knots", is_clamped);

    const int v = random.below(f.dimension);
    const auto vv = static_cast<std::size_t>(v);
    Rational lo = random_point<1>(random)[0], hi = random_point<1>(random)[0];
    if (lo == hi) lo = -1, hi = 2;
    if (lo > hi) std::swap(lo, hi);
    const auto part = locus::restrict_to(f, v, lo, hi);
    expect("restricted domain", part.knots(v).domain_lo() == lo && part.knots(v).domain_hi() == hi);
    const auto moved = locus::reparametrised(f, v, 10, 16);

    for (int i = 0; i < 3; ++i) {
      auto p = somewhere(random, f);
      expect("value after clamping", plain_value(g, p) == plain_value(f, p));
      auto q = p;
      q[vv] = 12 + 2 * p[vv];
      expect("value after reparametrising", plain_value(moved, q) == plain_value(f, p));
      p[vv] = lo + (hi - lo) * Rational(random.between(0, 606)) / 607; // below the end, where f may jump
      expect("value of the part", plain_value(part, p) == plain_value(f, p));
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 1900);
  CHECK_THROWS_AS(locus::restrict_to(identity(), 0, 0, 2), std::invalid_argument);
  CHECK_THROWS_WITH(locus::restrict_to(identity(), 0, 0, 2), "restrict_to: [0, 2] is no part of the domain");
  CHECK_THROWS_WITH(locus::restrict_to(identity(), 0, 0, 0), "restrict_to: [0, 0] is no part of the domain");
  CHECK_THROWS_WITH(locus::restrict_to(identity(), 0, -2, 0), "restrict_to: [-2, 0] is no part of the domain");
}

namespace {

/// max(0, x - b)^n as coefficients of 1, x, x², … on either side of b.
Polynomial truncated_power(const Rational& b, int n, bool above)
{
  return above ? with_roots(std::vector<Rational>(static_cast<std::size_t>(n), b)) : Polynomial{};
}

Polynomial random_coefficients(Random& random, int degree)
{
  Polynomial f;
  for (int i = 0; i <= degree; ++i) f.push_back(random.rational());
  return trimmed(f);
}

Spline_span<Rational, 1> span_of_polynomial(const Polynomial& f, const Rational& lo, const Rational& hi, int degree)
{
  return {{lo}, {hi}, bernstein_on(f, lo, hi, degree)};
}

} // namespace

TEST_CASE("minimal knots are as many as truncated powers say", "[spline][exact]")
{
  Random random(250);
  Samples samples;
  for (int i = 0; i < 200; ++i) {
    // A polynomial plus c·max(0, x - b)^(k+1) for each break is C^k there and no better; for k = degree it is none.
    const int degree = random.between(0, 6), spans = random.between(1, 6);
    std::vector<Rational> breaks{-2};
    while (static_cast<int>(breaks.size()) <= spans)
      breaks.push_back(Rational(breaks.back() + Rational(random.between(1, 9)) / random.between(1, 5)));
    std::vector<int> continuity;
    for (int k = 0; k <= spans; ++k) continuity.push_back(random.between(-1, degree));
    const Polynomial base = random_coefficients(random, degree);
    std::vector<Polynomial> pieces;
    std::vector<Spline_span<Rational, 1>> forms;
    Knots expected{degree, std::vector<Rational>(static_cast<std::size_t>(degree) + 1, breaks.front())};
    std::vector<Rational> factors;
    for (int k = 0; k <= spans; ++k) factors.push_back(Rational(random.between(1, 9)) / 7);
    for (int s = 0; s < spans; ++s) {
      const auto ss = static_cast<std::size_t>(s);
      Polynomial piece = base;
      for (std::size_t b = 1; b <= ss; ++b)
        if (continuity[b] < degree)
          piece = plus(piece, times({factors[b]}, truncated_power(breaks[b], continuity[b] + 1, true)));
      pieces.push_back(piece);
      forms.push_back(span_of_polynomial(piece, breaks[ss], breaks[ss + 1], degree));
      const int times = s + 1 == spans ? degree + 1 : degree - continuity[ss + 1];
      expected.values.insert(expected.values.end(), static_cast<std::size_t>(times), breaks[ss + 1]);
    }
    const auto f = locus::spline_from_spans(forms);
    const auto describe = [&] { return show_spline(f) + "\nexpected " + show_knots(expected); };
    samples.expect(f.knots(0) == expected, describe);
    for (int s = 0; s < spans; ++s) {
      const auto ss = static_cast<std::size_t>(s);
      const Rational u = breaks[ss] + (breaks[ss + 1] - breaks[ss]) * Rational(random.between(0, 606)) / 607;
      samples.expect(plain_value<1>(f, {u}) == horner(pieces[ss], u), describe);
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 700);
}

TEST_CASE("minimal knots undo insertion and clamping, and elevation goes along with them", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(260, 25, samples, [](Random& random, const auto& f, const auto& expect) {
    const auto least = locus::minimal_knots(f);
    const auto p = somewhere(random, f);
    expect("value on minimal knots", plain_value(least, p) == plain_value(f, p));
    expect("minimal knots are minimal", same(locus::minimal_knots(least), least));
    expect("clamped", same(locus::minimal_knots(locus::clamped(f)), least));
    const int v = random.below(f.dimension);
    const Rational u = Rational(random.between(-55, 115)) / 60;
    if (f.knots(v).multiplicity(u) <= f.degree(v))
      expect("insertion", same(locus::minimal_knots(locus::insert_knots(f, v, {u})), least));
    const auto raised = locus::elevate(f, v, random.between(0, 3));
    expect("elevation", same(locus::minimal_knots(raised), locus::elevate(least, v, raised.degree(v) - f.degree(v))));
    bool no_more = true;
    for (int k = 0; k < f.dimension; ++k)
      for (const Rational& b : f.knots(k).breaks())
        no_more = no_more && (!f.knots(k).contains(b) || b == -1 || b == 2 ||
                              least.knots(k).multiplicity(b) <= f.knots(k).multiplicity(b));
    expect("multiplicities", no_more);
  });
  LOCUS_REQUIRE_SAMPLES(samples, 900);
}

TEST_CASE("in two variables the least smooth joint across a break decides", "[spline][exact]")
{
  // Quadratic in x; across x = 1 one polynomial for y in [0,1], a kink for y in [1,2].
  const auto cell = [](int x, int y, std::vector<Rational> c) {
    return Spline_span<Rational, 2>{{x, y}, {x + 1, y + 1}, Bernstein<Rational, 2>(Degrees<2>{2, 0}, std::move(c))};
  };
  const std::vector<Spline_span<Rational, 2>> spans{cell(0, 0, {0, 0, 1}), cell(0, 1, {0, 0, 1}), cell(1, 0, {1, 2, 4}),
                                                    cell(1, 1, {1, 1, 2})};
  const auto f = locus::spline_from_spans(spans);
  CHECK(f.knots(0).values == std::vector<Rational>{0, 0, 0, 1, 1, 2, 2, 2});
  CHECK(f.knots(1).values == std::vector<Rational>{0, 1, 2});
  CHECK(plain_value<2>(f, {Rational(3, 2), Rational(1, 2)}) == Rational(9, 4));
  // The same with the kink for y in [0,1].
  const std::vector<Spline_span<Rational, 2>> mirrored{cell(0, 0, {0, 0, 1}), cell(0, 1, {0, 0, 1}),
                                                       cell(1, 0, {1, 1, 2}), cell(1, 1, {1, 2, 4})};
  CHECK(locus::spline_from_spans(mirrored).knots(0).values == std::vector<Rational>{0, 0, 0, 1, 1, 2, 2, 2});
  // With x² everywhere no knot is left.
  const auto g = locus::spline_from_spans<Rational, 2>(
    {cell(0, 0, {0, 0, 1}), cell(0, 1, {0, 0, 1}), cell(1, 0, {1, 2, 4}), cell(1, 1, {1, 2, 4})});
  CHECK(g.knots(0).values == std::vector<Rational>{0, 0, 0, 2, 2, 2});
  CHECK(g.knots(1).values == std::vector<Rational>{0, 2});
  CHECK(g.coefficients() == std::vector<Rational>{0, 0, 4});
  // One cell of the grid is missing.
  const std::vector<Spline_span<Rational, 2>> three{spans[0], spans[1], spans[2]};
  CHECK_THROWS_AS(locus::spline_from_spans(three), std::invalid_argument);
  CHECK_THROWS_WITH(locus::spline_from_spans(three), "spline_from_spans: the spans do not fill a grid in order");
}

TEST_CASE("spans of unlike degrees are raised; spans that fill no grid are refused", "[spline]")
{
  const auto span = [](Rational lo, Rational hi, std::vector<Rational> c) {
    const int n = static_cast<int>(c.size()) - 1;
    return Spline_span<Rational, 1>{{lo}, {hi}, Bernstein<Rational, 1>(Degrees<1>{n}, std::move(c))};
  };
  const auto from = [](std::vector<Spline_span<Rational, 1>> spans) {
    return locus::spline_from_spans(std::move(spans));
  };
  const auto f = from({span(0, 1, {3}), span(1, 2, {3, 3, 4}), span(2, 4, {4, 8})});
  CHECK(f.degree() == 2);
  CHECK(f.knots(0).values == std::vector<Rational>{0, 0, 0, 1, 2, 4, 4, 4}); // slopes 0, 0 to 2, 2
  CHECK(plain_value<1>(f, {Rational(3, 2)}) == Rational(13, 4));
  CHECK(plain_value<1>(f, {Rational(3)}) == 6);

  const auto refused = [&](std::vector<Spline_span<Rational, 1>> spans) {
    return thrown<std::invalid_argument>([&] { from(spans); }) == 1;
  };
  CHECK(refused({}));
  CHECK(refused({span(0, 1, {1}), span(2, 3, {1})}));
  CHECK(refused({span(1, 2, {1}), span(0, 1, {1})}));
  CHECK(refused({span(0, 1, {1}), span(0, 1, {1})}));
  CHECK_THROWS_WITH(from({span(0, 1, {1}), span(0, 1, {1})}),
                    "spline_from_spans: the spans do not fill a grid in order");
  CHECK(refused({span(0, 0, {1})}));
  CHECK(refused({span(0, 2, {1}), span(1, 3, {1})}));
  CHECK(refused({span(1, 1, {1}), span(0, 2, {1})}));
  const auto on = [&](Knots knots) { return locus::spline_from_spans<Rational, 1>({span(0, 1, {1, 2})}, {knots}); };
  CHECK(on({1, {0, 0, 1, 1}}).coefficients() == std::vector<Rational>{1, 2});
  CHECK(on({2, {0, 0, 0, 1, 1, 1}}).coefficients() == std::vector<Rational>{1, Rational(3, 2), 2});
  CHECK(on({1, {-1, 0, 1, 2}}).coefficients() == std::vector<Rational>{1, 2});
  CHECK(on({1, {-1, 0, Rational(1, 2), 1, 3}}).coefficients() == std::vector<Rational>{1, Rational(3, 2), 2});
  CHECK_THROWS_AS(on({0, {0, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(on({1, {0, 0, 2, 2}}), std::invalid_argument);
  CHECK_THROWS_AS(on({1, {-1, -1, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(on({1, {0, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(on({1, {}}), std::invalid_argument);
}

// ------------------------------------------------------------------------------------------------------------- algebra

namespace {

/// At each break of either, degree minus the lower of the operands' continuities: counted here.
bool has_joined_knots(const Knots& joined, const Knots& f, const Knots& g, int degree)
{
  Knots expected{degree, {}};
  const auto add = [&](const Rational& u, int times) {
    expected.values.insert(expected.values.end(), static_cast<std::size_t>(std::max(times, 0)), u);
  };
  add(-1, degree + 1);
  for (int v = -5; v < 12; ++v) {
    const Rational u = Rational(v) / 6;
    const int a = f.multiplicity(u), b = g.multiplicity(u);
    add(u, std::max(a == 0 ? 0 : degree - f.degree + a, b == 0 ? 0 : degree - g.degree + b));
  }
  add(2, degree + 1);
  return joined == expected;
}

} // namespace

TEST_CASE("sums, products and multiples have the values and the knots they must", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(270, 20, samples, [](Random& random, const auto& f, const auto& expect) {
    const auto g = another(random, f);
    const auto sum = locus::add(f, g), difference = locus::subtract(f, g), product = locus::multiply(f, g);
    const Rational factor = random.rational();
    const auto multiple = locus::multiply(f, factor);
    for (int i = 0; i < 3; ++i) {
      const auto p = somewhere(random, f);
      const Rational a = plain_value(f, p), b = plain_value(g, p);
      expect("sum", plain_value(sum, p) == a + b);
      expect("difference", plain_value(difference, p) == a - b);
      expect("product", plain_value(product, p) == a * b);
      expect("multiple", plain_value(multiple, p) == factor * a);
    }
    for (int k = 0; k < f.dimension; ++k) {
      const Knots &a = f.knots(k), &b = g.knots(k);
      const int higher = std::max(a.degree, b.degree);
      expect("knots of the sum", has_joined_knots(sum.knots(k), a, b, higher));
      expect("knots of the difference", has_joined_knots(difference.knots(k), a, b, higher));
      expect("knots of the product", has_joined_knots(product.knots(k), a, b, a.degree + b.degree));
    }
    const auto zero = locus::minimal_knots(locus::subtract(f, f));
    expect("f - f", std::all_of(zero.coefficients().begin(), zero.coefficients().end(),
                                [](const Rational& c) { return c == 0; }) &&
                      zero.size() == locus::coefficient_count(f.degrees()));
  });
  LOCUS_REQUIRE_SAMPLES(samples, 2400);
}

TEST_CASE("splines over different domains are not combined", "[spline]")
{
  const auto f = identity(), g = spline(1, {0, 0, 1, 1}, {0, 1}), h = spline(1, {-1, -1, 2, 2}, {0, 1});
  CHECK_THROWS_AS(locus::add(f, g), std::invalid_argument);
  CHECK_THROWS_AS(locus::subtract(f, h), std::invalid_argument);
  CHECK_THROWS_AS(locus::multiply(h, g), std::invalid_argument);
  CHECK_THROWS_AS(locus::divide_exactly(f, h), std::invalid_argument);
  const auto longer = spline(1, {0, 0, 2, 2}, {0, 1});
  for (const auto& other : {f, h, longer}) {
    CHECK_THROWS_WITH(locus::add(other, g), "splines of different domains cannot be combined");
    CHECK_THROWS_WITH(locus::add(g, other), "splines of different domains cannot be combined");
  }
  CHECK_THROWS_WITH(locus::add(f, h), "splines of different domains cannot be combined");
  CHECK_THROWS_WITH(locus::add(h, f), "splines of different domains cannot be combined");
}

TEST_CASE("elevation keeps the values and the continuity", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(280, 25, samples, [](Random& random, const auto& f, const auto& expect) {
    const int v = random.below(f.dimension), by = random.between(0, 3);
    const auto g = locus::elevate(f, v, by);
    for (int k = 0; k < f.dimension; ++k)
      expect("knots", k == v ? has_joined_knots(g.knots(k), f.knots(k), f.knots(k), f.degree(k) + by)
                             : g.knots(k) == f.knots(k));
    for (int i = 0; i < 4; ++i) {
      const auto p = somewhere(random, f);
      expect("value", plain_value(g, p) == plain_value(f, p));
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 900);
}

namespace {

/// The derivative by differences of control coefficients over those of knots, on the knots without the outermost two:
/// not a valid spline at a jump, but one that Cox and de Boor's recursion evaluates off the breaks.
template <int D>
Rational plain_derivative(const Spline<Rational, D>& f, int variable, const Point<D>& point)
{
  const auto v = static_cast<std::size_t>(variable);
  const int n = f.degree(variable);
  if (n == 0) return 0;
  Knot_array<D> knots = f.knots();
  const Knots t = knots[v];
  knots[v] = Knots{n - 1, {t.values.begin() + 1, t.values.end() - 1}};
  const locus::Layout from = locus::layout_along(f.last_index(), variable);
  std::vector<Rational> c;
  for (std::size_t o = 0; o < from.outer; ++o)
    for (int i = 1; i < t.control_count(); ++i)
      for (std::size_t j = 0; j < from.inner; ++j) {
        const std::size_t at = (o * from.count + static_cast<std::size_t>(i)) * from.inner + j;
        const Rational length = t.value(i + n) - t.value(i);
        c.push_back(length == 0 ? Rational(0) : Rational(n * (f[at] - f[at - from.inner]) / length));
      }
  return plain_value<D>(knots, c, point);
}

} // namespace

TEST_CASE("the derivative is that of differences of coefficients", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(290, 25, samples, [](Random& random, const auto& f, const auto& expect) {
    const int v = random.below(f.dimension);
    const auto g = locus::derivative(f, v);
    expect("degree", g.degree(v) == std::max(0, f.degree(v) - 1));
    bool knots = true;
    for (const Rational& u : f.knots(v).breaks())
      knots = knots && (u == -1 || u == 2 ||
                        g.knots(v).multiplicity(u) == std::min(g.degree(v) + 1, f.knots(v).multiplicity(u)));
    expect("knots", knots);
    for (int i = 0; i < 4; ++i) {
      const auto p = point_between_breaks<std::decay_t<decltype(f)>::dimension>(random);
      expect("value", plain_value(g, p) == plain_derivative(f, v, p));
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
  const auto sign = locus::derivative(absolute_value());
  CHECK(sign.knots(0) == Knots{0, {-1, 0, 1}});
  CHECK(sign.coefficients() == std::vector<Rational>{-1, 1});
  CHECK(locus::derivative(sign).coefficients() == std::vector<Rational>{0, 0});
}

// ------------------------------------------------------------------------------------------------------------ quotients

TEST_CASE("a product divided by one factor is the other, on its least knots", "[spline][exact]")
{
  Samples samples;
  in_all_dimensions(300, 15, samples, [](Random& random, const auto& f, const auto& expect) {
    const auto g = another(random, f);
    const auto product = locus::multiply(f, g);
    const auto spans = locus::bezier_spans(g);
    const bool vanishes = std::any_of(spans.begin(), spans.end(), [](const auto& s) {
      return std::all_of(s.form.coefficients().begin(), s.form.coefficients().end(),
                         [](const Rational& c) { return c == 0; });
    });
    if (vanishes) {
      expect("division by zero", thrown<std::domain_error>([&] { locus::divide_exactly(product, g); }) == 1);
      return;
    }
    expect("quotient", same(locus::divide_exactly(product, g), locus::minimal_knots(f)));
    const auto raised = locus::elevate(product, random.below(f.dimension), 1);
    expect("higher degree of the divisor",
           thrown<std::domain_error>([&] { locus::divide_exactly(product, raised); }) == 1);
  });
  LOCUS_REQUIRE_SAMPLES(samples, 180);
}

TEST_CASE("quotients that are smoother or less smooth than their operands, and those that are none", "[spline][exact]")
{
  const auto x = identity(), size = absolute_value();
  const auto sign = locus::divide_exactly(size, x);
  CHECK(sign.knots(0) == Knots{0, {-1, 0, 1}});
  CHECK(sign.coefficients() == std::vector<Rational>{-1, 1});
  CHECK(same(locus::divide_exactly(locus::multiply(x, size), size), x));
  CHECK(same(locus::divide_exactly(locus::multiply(x, size), x), size));
  // x·|x| is C¹ and a knot of multiplicity one is enough; the rule for products cannot know that.
  CHECK(locus::multiply(x, size).knots(0).multiplicity(0) == 2);
  CHECK(locus::minimal_knots(locus::multiply(x, size)).knots(0).multiplicity(0) == 1);
  // x² + 1 is not divisible; nor is a spline that is divisible on one span only.
  const auto square = spline(2, {-1, -1, -1, 1, 1, 1}, {2, 0, 2});
  CHECK_THROWS_AS(locus::divide_exactly(square, x), std::domain_error);
  CHECK_THROWS_AS(locus::divide_exactly(spline(1, {-1, -1, 0, 0, 1, 1}, {-1, 0, 1, 2}), x), std::domain_error);
  // A divisor that vanishes on a span leaves the quotient undetermined, even of zero.
  const auto ramp = spline(1, {-1, -1, 0, 1, 1}, {0, 0, 1});
  CHECK_THROWS_AS(locus::divide_exactly(ramp, ramp), std::domain_error);
  const auto zero = locus::divide_exactly(ramp, size);
  CHECK(zero.coefficients() == std::vector<Rational>{0, 1});
}

// -------------------------------------------------------------------------------------------- other coefficient types

namespace {

/// Everything that decides no zero, in one list: coefficients of the results, and a value.
template <class T, int D>
std::vector<T> all_results(const Spline<T, D>& f, const Spline<T, D>& g, int v, const std::vector<Rational>& more,
                           const Point<D>& p)
{
  std::vector<T> all;
  const auto append = [&](const std::vector<T>& c) { all.insert(all.end(), c.begin(), c.end()); };
  append(locus::add(f, g).coefficients());
  append(locus::subtract(f, g).coefficients());
  append(locus::multiply(f, g).coefficients());
  append(locus::multiply(f, T(3)).coefficients());
  append(locus::elevate(f, v, 2).coefficients());
  append(locus::derivative(f, v).coefficients());
  append(locus::clamped(f).coefficients());
  append(locus::insert_knots(f, v, more).coefficients());
  append(locus::restrict_to(f, v, Rational(-1, 3), Rational(3, 2)).coefficients());
  append(locus::reparametrised(f, v, 0, 1).coefficients());
  append(locus::spline_from_spans(locus::bezier_spans(g), locus::clamped(g).knots()).coefficients());
  for (const auto& span : locus::bezier_spans(f)) append(span.form.coefficients());
  all.push_back(locus::evaluate(f, p));
  return all;
}

template <int D>
void check_other_types(Random& random, Samples& samples)
{
  auto f = random_spline<D>(random), g = another(random, f);
  const auto rounded = [](const Rational& c) { return Rational(locus::nearest_double(c)); };
  f = locus::converted<Rational>(f, rounded);
  g = locus::converted<Rational>(g, rounded);
  const int v = random.below(D);
  const std::vector<Rational> more{Rational(1, 7), Rational(8, 7)};
  const Point<D> p = random_point<D>(random);
  const std::vector<Rational> exact = all_results<Rational, D>(f, g, v, more, p);
  const auto to_double = [](const Rational& c) { return locus::nearest_double(c); };
  const auto doubles =
    all_results<double, D>(locus::converted<double>(f, to_double), locus::converted<double>(g, to_double), v, more, p);
  std::vector<std::pair<double, double>> enclosures;
  with_upward_rounding([&] {
    const auto to_interval = [](const Rational& c) { return locus::enclosing(c); };
    for (const Interval& x : all_results<Interval, D>(locus::converted<Interval>(f, to_interval),
                                                      locus::converted<Interval>(g, to_interval), v, more, p))
      enclosures.emplace_back(x.inf(), x.sup());
  });
  samples.expect(exact.size() == doubles.size() && exact.size() == enclosures.size(), "as many results");
  Rational largest = 1; // the largest result measures them all
  for (const Rational& c : exact) largest = std::max(largest, Rational(abs(c)));
  for (std::size_t i = 0; i < std::min({exact.size(), doubles.size(), enclosures.size()}); ++i) {
    const auto describe = [&] {
      return "result " + show(static_cast<int>(i)) + " of " + show_spline(f) + "\nand " + show_spline(g);
    };
    samples.expect(abs(Rational(Rational(doubles[i]) - exact[i])) <= largest * two_to(-26), describe);
    samples.expect(Rational(enclosures[i].first) <= exact[i] && exact[i] <= Rational(enclosures[i].second), describe);
    samples.expect(Rational(enclosures[i].second) - Rational(enclosures[i].first) <= largest * two_to(-26), describe);
  }
}

} // namespace

TEST_CASE("doubles come near the exact results and intervals hold them", "[spline][interval]")
{
  Random random(310);
  Samples samples;
  for (int i = 0; i < 30; ++i) check_other_types<1>(random, samples);
  for (int i = 0; i < 15; ++i) check_other_types<2>(random, samples);
  for (int i = 0; i < 6; ++i) check_other_types<3>(random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 20000);
}
