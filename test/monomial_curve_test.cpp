// SPDX-License-Identifier: LGPL-3.0-or-later
// Curves in monomial form on every kind of domain: monomial_curve.h, parameter_form.h, rational_root.h, lines and rays.

#include <locus/shape/carrier.h>
#include <locus/shape/constructors_2.h>
#include <locus/shape/edit_curve.h>

#include "shape_support.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <optional>

using namespace locus;
using namespace locus_test;

namespace {

template <int Dim>
using Coordinates = std::array<Polynomial, static_cast<std::size_t>(Dim)>;

const Parameter_domain whole_line{};

Parameter_domain between(const Rational& lo, const Rational& hi) { return {lo, hi}; }
Parameter_domain from(const Rational& lo) { return {lo, std::nullopt}; }
Parameter_domain up_to(const Rational& hi) { return {std::nullopt, hi}; }

/// The point by Horner's rule, straight from the coefficients; the weight must not vanish.
template <int Dim>
Exact_point<Dim> direct(const Coordinates<Dim>& x, const Polynomial& w, const Rational& u)
{
  Exact_point<Dim> p;
  for (std::size_t v = 0; v < p.size(); ++v) p[v] = horner(x[v], u) / (w.empty() ? Rational(1) : horner(w, u));
  return p;
}

Polynomial random_polynomial(Random& random, int degree)
{
  Polynomial f;
  for (int i = 0; i <= degree; ++i) f.push_back(Rational(random.between(-5, 5)) / random.between(1, 3));
  return f;
}

/// 1 + a square: a weight without zeros, of degree 2n.
Polynomial positive_polynomial(Random& random, int n)
{
  const Polynomial f = random_polynomial(random, n);
  return plus(times(f, f), {1});
}

Rational random_in(Random& random, const Parameter_domain& d)
{
  const Rational s = random.unit_rational(), far = Rational(1) / (s + Rational(1, 1000000));
  if (d.lo && d.hi) return Rational(*d.lo + s * (*d.hi - *d.lo));
  if (d.lo) return Rational(*d.lo + far);
  if (d.hi) return Rational(*d.hi - far);
  return random.chance(50) ? far : Rational(-far);
}

Joint_kind kind_at(const Curve_2& c, const Rational& u)
{
  for (std::size_t k = 0; k + 1 < c.pieces().size(); ++k)
    if (c.chain().pieces[k].hi == u) return c.chain().joints[k].kind;
  throw std::logic_error("no joint at " + u.get_str());
}

std::size_t inner_cuts(const Curve_2& c)
{
  std::size_t n = 0;
  for (const Joint& j : c.chain().joints) n += j.kind != Joint_kind::smooth;
  return n;
}

template <int Dim>
void compare_with_definition(std::uint64_t stream)
{
  Random random(stream);
  Samples samples;
  std::array<int, 4> domains{};
  for (int round = 0; round < 200; ++round) {
    Coordinates<Dim> x;
    const int degree = random.between(1, 4);
    for (auto& f : x) f = random_polynomial(random, degree);
    const Polynomial w = random.chance(50) ? Polynomial() : positive_polynomial(random, random.between(1, 2));
    Parameter_domain d;
    if (random.chance(60)) d.lo = Rational(random.between(-40, 40)) / 7;
    if (random.chance(60)) d.hi = (d.lo ? *d.lo : Rational(random.between(-6, 5))) + Rational(random.between(1, 60)) / 7;
    const std::string shown = show(x[0]) + show(x[1]) + "/" + show(w) + " on " + (d.lo ? show(*d.lo) : "-inf") + ", " +
                              (d.hi ? show(*d.hi) : "inf");
    std::optional<Rational_curve<Dim>> c;
    const std::string refused = complaint([&] { c = monomial_curve<Dim>(x, w, d); });
    if (!c) {
      samples.expect(holds(refused, "single point"), [&] { return refused + shown; });
      continue;
    }
    ++domains[static_cast<std::size_t>((d.lo ? 0 : 1) + (d.hi ? 0 : 2))];
    samples.expect(is_well_formed(*c), [&] { return "ill formed " + shown + "\n" + show_curve(*c); });
    const auto &first = c->chain().pieces.front(), &last = c->chain().pieces.back();
    samples.expect(d.lo ? first.lo == *d.lo : first.lo_infinite, "the domain's lower end");
    samples.expect(d.hi ? last.hi == *d.hi : last.hi_infinite, "the domain's upper end");
    for (int i = 0; i < 6; ++i) {
      const Rational u = random_in(random, d);
      samples.expect(passes(*c, u, direct<Dim>(x, w, u)), [&] { return shown + " at " + show(u) + "\n" + show_curve(*c); });
    }
    // The point at infinity is that of the highest coefficients, where the weight has one.
    std::size_t size = trimmed(w).size();
    for (const auto& f : x) size = std::max(size, trimmed(f).size());
    const auto leading = [&](const Polynomial& f) { return f.size() >= size ? f[size - 1] : Rational(0); };
    const Rational w_leading = w.empty() ? Rational(0) : leading(w);
    const bool finite = w_leading != 0;
    const bool is_whole = !d.lo && !d.hi;
    samples.expect(c->chain().is_closed() == (is_whole && finite), [&] { return "closed? " + shown; });
    for (const bool high : {false, true}) {
      if (high ? !last.hi_infinite : !first.lo_infinite) continue;
      const auto& piece = high ? c->pieces().back() : c->pieces().front();
      const Rational s = high ? 1 : 0;
      samples.expect((plain_value<1>(piece.weight, {s}) != 0) == finite, [&] { return "finite at infinity? " + shown; });
      if (!finite) continue;
      const Exact_point<Dim> p = local_point(piece, s);
      for (std::size_t v = 0; v < p.size(); ++v)
        samples.expect(p[v] == Rational(leading(x[v]) / w_leading), [&] { return "at infinity: " + shown; });
    }
    // Joints that the analytic curve does not ask for are of any order.
    for (const Joint& j : c->chain().joints)
      samples.expect((j.kind == Joint_kind::smooth && j.order == Joint::any_order) || j.kind == Joint_kind::corner ||
                       j.kind == Joint_kind::g1,
                     [&] { return show(j) + ": " + shown; });
  }
  for (const int n : domains) CHECK(n > 10);
  LOCUS_REQUIRE_SAMPLES(samples, 1500);
}

} // namespace

TEST_CASE("plane curves in monomial form against Horner's rule") { compare_with_definition<2>(1); }
TEST_CASE("space curves in monomial form against Horner's rule") { compare_with_definition<3>(2); }

TEST_CASE("domains and their pieces")
{
  const Coordinates<2> parabola{{{0, 1}, {0, 0, 1}}};
  const Curve_2 bounded = monomial_curve<2>(parabola, {}, between(-3, Rational(1, 2)));
  REQUIRE(bounded.pieces().size() == 1);
  CHECK(bounded.pieces()[0].is_polynomial());
  CHECK(bounded.chain().joints.empty());

  const Curve_2 half = monomial_curve<2>(parabola, {}, from(-3));
  REQUIRE(half.pieces().size() == 2);
  CHECK(half.chain().pieces[0].hi == 1);
  CHECK(half.chain().pieces[1].hi_infinite);
  CHECK(half.pieces()[1].weight.degree() == 2);
  CHECK(half.pieces()[1].weight[2] == 0);
  CHECK(monomial_curve<2>(parabola, {}, from(5)).chain().pieces[1].lo == 6);
  CHECK(monomial_curve<2>(parabola, {}, up_to(5)).chain().pieces[0].hi == -1);
  CHECK(monomial_curve<2>(parabola, {}, up_to(-5)).chain().pieces[0].hi == -6);

  const Curve_2 whole = monomial_curve<2>(parabola, {}, whole_line);
  REQUIRE(whole.pieces().size() == 3);
  CHECK(whole.chain().pieces[0].hi == -1);
  CHECK(whole.chain().pieces[2].lo == 1);
  CHECK(!whole.chain().is_closed());
  CHECK(passes<2>(whole, Rational(-100), {-100, 10000}));

  // A polynomial of lower degree than its list is long; a weight that is a constant.
  const Curve_2 scaled = monomial_curve<2>({{{0, 3, 0, 0}, {6, 0, 0, 0}}}, {3, 0, 0}, between(0, 1));
  CHECK(scaled.pieces()[0].degree() == 1);
  CHECK(scaled.pieces()[0].is_polynomial());
  CHECK(passes<2>(scaled, 1, {1, 2}));
  // On a projective piece the weight may be the constant: (1/u, 2/u).
  const Curve_2 inverse = monomial_curve<2>({{{1}, {2, 1}}}, {0, 1}, from(1));
  CHECK(inverse.pieces().back().is_polynomial());
  CHECK(passes<2>(inverse, 4, {Rational(1, 4), Rational(3, 2)}));
}

TEST_CASE("curves that close through infinity")
{
  const Coordinates<2> circle{{{1, 0, -1}, {0, 2}}};
  const Curve_2 c = monomial_curve<2>(circle, {1, 0, 1}, whole_line);
  REQUIRE(c.chain().is_closed());
  REQUIRE(c.pieces().size() == 3);
  for (const Joint& j : c.chain().joints) CHECK(same_joint(j, {Joint_kind::smooth, Joint::any_order, false}));
  CHECK(local_point(c.pieces()[2], Rational(1)) == Exact_point<2>{-1, 0});
  for (const auto& piece : c.pieces()) CHECK(carrier_of(piece).kind == Carrier::Kind::circle);

  // (u², u)/(1 + u⁴) runs through infinity like (v², v³): a cusp there. With v⁴ for v² it only stands still.
  const Curve_2 cusp = monomial_curve<2>({{{0, 0, 1}, {0, 1}}}, {1, 0, 0, 0, 1}, whole_line);
  CHECK(same_joint(cusp.chain().joints.back(), {Joint_kind::corner, 0, false}));
  CHECK(inner_cuts(cusp) == 1);
  // (u³, 1)/(1 + u⁶) is (v³, v⁶)/(1 + v⁶) at infinity.
  const Curve_2 still = monomial_curve<2>({{{0, 0, 0, 1}, {1}}}, {1, 0, 0, 0, 0, 0, 1}, whole_line);
  CHECK(same_joint(still.chain().joints.back(), {Joint_kind::g1, 0, false}));
  CHECK(kind_at(still, 0) == Joint_kind::g1); // and (u³, 1 - u⁶…) at 0

  // The other half of a circle ends at the point at infinity.
  const Curve_2 half = monomial_curve<2>(circle, {1, 0, 1}, from(0));
  CHECK(!half.chain().is_closed());
  CHECK(local_point(half.pieces().back(), Rational(1)) == Exact_point<2>{-1, 0});
  // A half-infinite domain whose ends meet: u/(1+u²) is 0 at both. Parameters there are of two kinds.
  const Coordinates<2> loop{{{0, 1}, {0, 0, 1, 0}}};
  const Polynomial w{1, 0, 0, 1}; // (u, u²)/(1+u³), Descartes' folium
  const Curve_2 folium = monomial_curve<2>(loop, w, from(0), true);
  REQUIRE(folium.chain().is_closed());
  CHECK(same_joint(folium.chain().joints.back(), {Joint_kind::corner, 0, false}));
  CHECK(complaint([&] { monomial_curve<2>(loop, w, from(1), true); }).substr(0, 8) == ".closed ");
  // Tangents agree, and even first derivatives by u at 0 and by -1/u at infinity: that is no continuity of a derivative.
  const Curve_2 drop = monomial_curve<2>({{{0, 1, 0, -1}, {0, 0, 1}}}, {1, 4, 6, 4, 1}, from(0), true);
  CHECK(same_joint(drop.chain().joints.back(), {Joint_kind::g1, 0, false}));
}

TEST_CASE("poles split the domain")
{
  const Coordinates<2> one_u{{{1}, {0, 1}}};
  // Over u(u-1/3)(u+5): simple poles; on the line the point at infinity is finite, so the curve is closed.
  const Coordinates<2> x{{{1, 0, 1}, {0, 1}}}; // (1 + u², u)
  const Polynomial w = with_roots({0, Rational(1, 3), -5});
  const Curve_2 c = monomial_curve<2>(x, w, whole_line);
  CHECK(is_well_formed(c));
  CHECK(c.chain().is_closed());
  CHECK(inner_cuts(c) == 3);
  for (const Rational& u : {Rational(0), Rational(1, 3), Rational(-5)}) CHECK(kind_at(c, u) == Joint_kind::pole);
  CHECK(c.chain().joints.back().kind == Joint_kind::smooth);
  for (const Rational& u : {Rational(-100), Rational(-2), Rational(1, 4), Rational(1, 2), Rational(7)})
    CHECK(passes(c, u, direct<2>(x, w, u)));
  // A double pole, a pole at a domain's end, poles at both.
  const Curve_2 twice = monomial_curve<2>(one_u, {4, -4, 1}, between(0, 3));
  CHECK(twice.pieces().size() == 2);
  CHECK(kind_at(twice, 2) == Joint_kind::pole);
  const Curve_2 at_end = monomial_curve<2>(one_u, {0, 1}, between(0, 3));
  CHECK(at_end.pieces().size() == 1);
  CHECK(at_end.pieces()[0].weight[0] == 0);
  CHECK(monomial_curve<2>(one_u, {0, -1, 1}, between(0, 1)).pieces().size() == 1);
  CHECK(is_well_formed(monomial_curve<2>(one_u, {0, -1, 1}, between(0, 1))));
  CHECK(holds(complaint([&] { monomial_curve<2>(one_u, {0, -1, 1}, between(0, 1), true); }), "ends at infinity"));
  // A pole far out on a projective piece, with a large denominator.
  const Rational far = parse_rational("123456789/1000");
  const Curve_2 distant = monomial_curve<2>(one_u, {Rational(-far), 1}, from(0));
  CHECK(kind_at(distant, far) == Joint_kind::pole);
  CHECK(distant.chain().pieces.back().lo == Rational(far + 1));
  // A zero that the numerators share is none.
  const Curve_2 removable = monomial_curve<2>({{{-1, 1}, {-1, 0, 1}}}, {-1, 1}, between(0, 3));
  CHECK(removable.pieces().size() == 1);
  CHECK(passes<2>(removable, 1, {1, 2}));
  const Curve_2 lowered = monomial_curve<2>({{{-1, 1}, {-1, 0, 1}}}, {1, -2, 1}, between(0, 3));
  CHECK(kind_at(lowered, 1) == Joint_kind::pole);
  CHECK(passes<2>(lowered, 2, {1, 3}));
  // Irrational ones: one that is met, one that is not, one beside a rational one.
  const std::string root_two = complaint([&] { monomial_curve<2>(one_u, {-2, 0, 1}, between(0, 3)); });
  CHECK(root_two == "unsupported: a curve with a pole at an irrational parameter, near u = 1.414214");
  CHECK(monomial_curve<2>(one_u, {-2, 0, 1}, between(0, Rational(7, 5))).pieces().size() == 1);
  CHECK(kind_at(monomial_curve<2>(one_u, times({-2, 0, 1}, {-2, 1}), from(Rational(3, 2))), 2) == Joint_kind::pole);
  CHECK(holds(complaint([&] { monomial_curve<2>(one_u, {-200000000, 0, 1}, whole_line); }), "near u = -14142.135"));
}

TEST_CASE("rational roots are told from irrational ones")
{
  Random random(3);
  Samples samples;
  for (int round = 0; round < 150; ++round) {
    // A product of linear factors, some repeated, and an irreducible quadratic with roots inside.
    std::vector<Rational> roots;
    Polynomial f{1};
    for (int i = random.between(1, 3); i > 0; --i) {
      Rational r = random.unit_rational();
      if (std::find(roots.begin(), roots.end(), r) == roots.end()) roots.push_back(r);
      for (int m = random.between(1, 2); m > 0; --m) f = times(f, {Rational(-r), 1});
    }
    const bool irrational = random.chance(50);
    if (irrational) f = times(f, {Rational(-1), 0, random.chance(50) ? Rational(2) : Rational(500001)});
    std::sort(roots.begin(), roots.end());
    std::vector<Rational> found;
    int others = 0;
    for (const auto& root : exact_roots(Bernstein<Scaled_integer, 1>(bernstein_on_unit(f, static_cast<int>(f.size()) - 1)),
                                        Rational(0), Rational(1)).roots) {
      if (const auto value = rational_value(root)) found.push_back(*value);
      else ++others;
      const double near = near_value(root).get_d();
      samples.expect(std::abs(horner(f, exact_rational(near)).get_d()) < 1e-6, "a near value is near");
    }
    samples.expect(found == roots, [&] { return show(f) + ": " + show(found) + ", not " + show(roots); });
    samples.expect(others == (irrational ? 1 : 0), [&] { return "irrational roots of " + show(f); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 450);
}

TEST_CASE("cusps at rational parameters, on every kind of piece")
{
  // (u - r)² and (u - r)³, plus a straight motion for neither.
  for (const Rational& r : {Rational(0), Rational(1, 3), Rational(-17, 2), Rational(1000), Rational(1)}) {
    const Coordinates<2> x{{with_roots({r, r}), with_roots({r, r, r})}};
    const Curve_2 whole = monomial_curve<2>(x, {}, whole_line);
    INFO(show_curve(whole));
    CHECK(is_well_formed(whole));
    CHECK(kind_at(whole, r) == Joint_kind::corner);
    CHECK(inner_cuts(whole) == 1);
    const Curve_2 bounded = monomial_curve<2>(x, {}, between(r - 2, r + 3));
    CHECK(bounded.pieces().size() == 2);
    CHECK(joints_are_true(bounded));
    CHECK(monomial_curve<2>(x, {}, between(r, r + 3)).pieces().size() == 1); // at an end it is fine
    const Rational_curve<3> space = monomial_curve<3>({{x[0], x[1], plus(x[0], x[1])}}, {}, between(r - 2, r + 3));
    CHECK(space.chain().joints.at(0).kind == Joint_kind::corner);
    const Rational_curve<3> lifted = monomial_curve<3>({{x[0], x[1], {0, 1}}}, {}, between(r - 2, r + 3));
    CHECK(lifted.pieces().size() == 1); // regular in space
  }
  const Curve_2 still = monomial_curve<2>({{{0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 1}}}, {}, between(-1, 1));
  CHECK(kind_at(still, 0) == Joint_kind::g1);
  CHECK(joints_are_true(still));
  // Rational: the cusp of (u², u³) seen through the projective map with the weight 1 + u².
  const Curve_2 rational = monomial_curve<2>({{{0, 0, 1}, {0, 0, 0, 1}}}, {1, 0, 1}, between(-1, 2));
  CHECK(kind_at(rational, 0) == Joint_kind::corner);
  // Moved away from the origin, so that the numerators' own derivatives do not vanish.
  const Polynomial bent{1, 1, 1};
  const Curve_2 away = monomial_curve<2>({{plus({0, 0, 1}, times({5}, bent)), plus({0, 0, 0, 1}, times({-2}, bent))}}, bent,
                                         between(-1, 2));
  CHECK(away.pieces().size() == 2);
  CHECK(kind_at(away, 0) == Joint_kind::corner);
  CHECK(joints_are_true(away));
  // An irrational cusp stays inside its piece.
  CHECK(monomial_curve<2>({{{0, -6, 0, 1}, {0, 0, -3, 0, Rational(1, 4) * 2}}}, {}, between(0, 2)).pieces().size() == 1);
  // Cusp and pole in one curve.
  const Curve_2 both = monomial_curve<2>({{{0, 0, 1}, {0, 0, 0, 1}}}, {-1, 1}, between(-1, 2));
  CHECK(kind_at(both, 0) == Joint_kind::corner);
  CHECK(kind_at(both, 1) == Joint_kind::pole);
  CHECK(both.pieces().size() == 3);
}

TEST_CASE("lines and rays")
{
  const Curve_2 line = line_2({1, "1/2"}, {3, -4});
  CHECK(is_well_formed(line));
  REQUIRE(line.pieces().size() == 3);
  CHECK(!line.chain().is_closed());
  for (const Joint& j : line.chain().joints) CHECK(same_joint(j, {Joint_kind::smooth, Joint::any_order, false}));
  for (const int u : {-100, -1, 0, 1, 7}) CHECK(passes<2>(line, u, {Rational(1 + 3 * u), Rational(Rational(1, 2) - 4 * u)}));
  CHECK(line.pieces().front().weight[0] == 0);
  CHECK(line.pieces().back().weight[1] == 0);
  for (const auto& piece : line.pieces()) {
    const Carrier carrier = carrier_of(piece);
    CHECK(carrier.kind == Carrier::Kind::line);
    CHECK(Rational(carrier.direction[0] * -4) == Rational(carrier.direction[1] * 3));
    CHECK(carrier.direction[0] > 0); // along the parameter
  }
  const Curve_2 ray = ray_2({0, 0}, {0, "1/3"});
  REQUIRE(ray.pieces().size() == 2);
  CHECK(ray.chain().pieces[0].lo == 0);
  CHECK(passes<2>(ray, 30, {0, 10}));
  CHECK(carrier_of(ray.pieces()[1]).direction[1] > 0);
  CHECK(holds(complaint([] { ray_2({0, 0}, {0, 0}); }), ".direction | a direction must not be zero"));
  CHECK(holds(complaint([] { line_2({0, 0}, {0, 0}); }), ".direction"));
}

TEST_CASE("what is wrong with a monomial curve")
{
  CHECK(complaint([] { monomial_curve<2>({{{0, 1}, {1}}}, {}, between(1, 1)); }) ==
        ".domain | the interval is empty | let the first number be less than the second");
  const Coordinates<2> line{{{0, 1}, {1}}};
  const auto found = [](const Coordinates<2>& x, const Polynomial& w, const Parameter_domain& d, bool closed = false) {
    return complaint([&] { monomial_curve<2>(x, w, d, closed); });
  };
  CHECK(holds(found(line, {0, 0}, whole_line), ".monomial.w | the denominator is zero"));
  CHECK(holds(found({{{2}, {1}}}, {}, whole_line), ".monomial | the curve is a single point"));
  CHECK(holds(found({{{2, 4}, {1, 2}}}, {1, 2}, whole_line), "single point"));
  CHECK(holds(found({{{}, {}}}, {}, whole_line), "single point"));
  CHECK(holds(found(line, {}, between(0, 1), true), ".closed | the ends of the curve do not coincide"));
  CHECK(holds(found(line, {}, whole_line, true), ".closed | the curve ends at infinity"));
  CHECK(monomial_curve<2>({{{0, 1, -1}, {0, 1, 0, -1}}}, {}, between(0, 1), true).chain().is_closed());
}

TEST_CASE("edited infinite curves keep their points")
{
  const Coordinates<2> x{{{1, 2, 0, 1}, {0, -1, 3}}};
  const Polynomial w{2, 1, 1};
  const auto where = [&](const Rational& u) { return direct<2>(x, w, u); };
  for (const Parameter_domain& d : {from(-2), up_to(3), whole_line}) {
    const Curve_2 c = monomial_curve<2>(x, w, d);
    std::vector<Rational> at;
    for (const Rational& u : {Rational(-50), Rational(-1), Rational(1, 3), Rational(2), Rational(3), Rational(77, 2)})
      if ((!d.lo || u >= *d.lo) && (!d.hi || u <= *d.hi)) at.push_back(u);
    const Curve_2 back = reversed(c), higher = elevated(c, 1);
    CHECK(is_well_formed(back));
    for (const Rational& u : at) {
      CHECK(passes(back, Rational(-u), where(u)));
      CHECK(passes(higher, u, where(u)));
      const Curve_2 cut = with_inserted_knot(c, u);
      CHECK(is_well_formed(cut));
      for (const Rational& v : at) CHECK(passes(cut, v, where(v)));
      for (const Joint& j : cut.chain().joints) CHECK(same_joint(j, {Joint_kind::smooth, Joint::any_order, false}));
    }
    // Affine maps keep infinity, whatever the sign of where the last piece begins.
    const std::vector<Moebius_map> maps{{3, 1, 0, 1}, {1, -9, 0, 2}, {1, 20, 0, 1}, {-2, 5, 0, 1}};
    for (const Moebius_map& map : maps) {
      const Curve_2 moved = reparametrised(c, map);
      INFO(show_curve(moved));
      CHECK(is_well_formed(moved));
      for (const Rational& u : at) CHECK(passes(moved, map(u), where(u)));
      for (const Joint& j : moved.chain().joints) CHECK(same_joint(j, {Joint_kind::smooth, Joint::any_order, false}));
    }
    CHECK(holds(complaint([&] { reparametrised(c, {1, 0, 1, -1}); }), "pole at 1"));
  }
  // A half-infinite domain to a bounded one: infinity becomes 1.
  const Coordinates<2> circle{{{1, 0, -1}, {0, 2}}};
  for (const bool up : {true, false}) {
    const Curve_2 half = monomial_curve<2>(circle, {1, 0, 1}, up ? from(0) : up_to(0));
    const Moebius_map map = up ? Moebius_map{1, 0, 1, 2} : Moebius_map{1, 0, 1, -2};
    const Curve_2 bounded = reparametrised(half, map);
    INFO(show_curve(bounded));
    CHECK(is_well_formed(bounded));
    CHECK(bounded.chain().pieces.front().lo == 0);
    CHECK(bounded.chain().pieces.back().hi == 1);
    CHECK(joints_are_true(bounded));
    for (const Rational& a : {Rational(1, 9), Rational(1), Rational(40)}) {
      const Rational u = up ? a : Rational(-a);
      CHECK(passes(bounded, map(u), direct<2>(circle, {1, 0, 1}, u)));
    }
    CHECK(passes<2>(bounded, 1, {-1, 0}));
  }
  // A closed curve's seam at infinity stays there.
  const Curve_2 closed = monomial_curve<2>(circle, {1, 0, 1}, whole_line);
  CHECK(holds(complaint([&] { with_seam_at(closed, 1); }), "through u = infinity"));
  CHECK(reversed(closed).chain().is_closed());
  CHECK(reparametrised(closed, {2, 1, 0, 1}).chain().is_closed());
}
