// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/zero_set/domain_points.h>
#include <locus/zero_set/double_points.h>

#include <catch2/catch.hpp>

#include <map>
#include <memory>

using namespace locus_test;
using locus::Box;
using locus::exact_rational;
using locus::Interval;
using Point_set = locus::Point_set<2>;
using locus::Polynomial_equation;
using locus::Solve_control;
using locus::with_upward_rounding;

namespace {

/// A polynomial in two variables, by exponents.
using Bivariate = std::map<std::pair<int, int>, Rational>;
using Point = std::array<Rational, 2>;

Bivariate times(const Bivariate& f, const Bivariate& g)
{
  Bivariate h;
  for (const auto& [e, a] : f)
    for (const auto& [d, b] : g) h[{e.first + d.first, e.second + d.second}] += a * b;
  return h;
}

Bivariate combined(const Bivariate& f, const Rational& factor, const Bivariate& g)
{
  Bivariate h = f;
  for (const auto& [e, a] : g) h[e] += factor * a;
  return h;
}

Rational value(const Bivariate& f, const Point& p)
{
  Rational sum = 0;
  for (const auto& [e, a] : f) sum += a * power(p[0], e.first) * power(p[1], e.second);
  return sum;
}

Bivariate line(const Rational& a, const Rational& b, const Rational& c)
{
  return {{{1, 0}, a}, {{0, 1}, b}, {{0, 0}, c}};
}
Bivariate line_through(const Point& p, const Point& q)
{
  const Rational a = q[1] - p[1], b = p[0] - q[0];
  return line(a, b, Rational(-a * p[0] - b * p[1]));
}
Bivariate line_through(const Point& p, Random& random)
{
  Rational a = random.between(-9, 9), b = random.between(-9, 9);
  if (a == 0 && b == 0) a = 1;
  return line(a, b, Rational(-a * p[0] - b * p[1]));
}

/// Coefficients in the Bernstein basis of degrees n, m, from the definition of the basis.
Bernstein<Rational, 2> bernstein(const Bivariate& f)
{
  int n = 0, m = 0;
  for (const auto& [e, a] : f) {
    n = std::max(n, e.first);
    m = std::max(m, e.second);
  }
  Bernstein<Rational, 2> b(Degrees<2>{n, m});
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
      for (const auto& [e, a] : f)
        if (e.first <= i && e.second <= j)
          b.at({i, j}) +=
            a * Rational(choose(i, e.first)) / choose(n, e.first) * Rational(choose(j, e.second)) / choose(m, e.second);
  return b;
}

std::string show_system(const Bivariate& f, const Bivariate& g)
{
  std::string text;
  for (const auto* h : {&f, &g}) {
    text += "\n";
    for (const auto& [e, a] : *h)
      if (a != 0) text += " + " + show(a) + " x^" + show(e.first) + " y^" + show(e.second);
  }
  return text;
}

Point_set solve(const Bivariate& f, const Bivariate& g, const Solve_control& control = {})
{
  const std::array<std::shared_ptr<const locus::Equation<2>>, 2> equations{
    std::make_shared<Polynomial_equation<2>>(bernstein(f)), std::make_shared<Polynomial_equation<2>>(bernstein(g))};
  Point_set result;
  with_upward_rounding([&] { result = locus::solve_points(equations, control); });
  return result;
}

bool contains(const std::array<Interval, 2>& box, const Point& p)
{
  for (std::size_t k = 0; k < 2; ++k)
    if (p[k] < exact_rational(box[k].inf()) || p[k] > exact_rational(box[k].sup())) return false;
  return true;
}
bool contains(const Box<2>& box, const Point& p)
{
  for (std::size_t k = 0; k < 2; ++k)
    if (p[k] < exact_rational(box.lo[k]) || p[k] > exact_rational(box.hi[k])) return false;
  return true;
}
bool in_unit_square(const Point& p) { return p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1; }

/// A solution that is known exactly; `simple` where both equations meet there transversally.
struct Known {
  Point at;
  bool simple = true;
};

/// What is wrong with the answer, or an empty text. `solutions` are all solutions anywhere.
std::string fault_of(const Point_set& set, const std::vector<Known>& solutions, bool must_decide)
{
  if (must_decide && !set.undecided.empty()) return "undecided boxes are left";
  for (const Known& s : solutions) {
    const std::string name = "the solution " + show(s.at[0]) + ", " + show(s.at[1]);
    std::size_t boxes = 0, undecided = 0;
    for (const auto& p : set.points) boxes += contains(p.box, s.at);
    for (const auto& u : set.undecided) undecided += contains(u, s.at);
    if (!in_unit_square(s.at)) {
      if (boxes > 0) return name + " outside is reported as a point";
      continue;
    }
    if (boxes + undecided == 0) return name + " is lost";
    if (boxes > 1) return name + " is reported more than once";
    if (!s.simple && boxes > 0) return name + ", a multiple one, is reported as regular";
    if (must_decide && boxes != 1) return name + " is not reported as a point";
  }
  for (const auto& p : set.points) {
    std::size_t inside = 0, near = 0;
    const Known* found = nullptr;
    for (const Known& s : solutions) {
      if (contains(p.unique_in, s.at)) ++near;
      if (!contains(p.box, s.at)) continue;
      ++inside;
      found = &s;
    }
    const std::string name = "the point in " + show(p.box[0]) + " × " + show(p.box[1]);
    if (inside != 1) return name + " holds " + std::to_string(inside) + " solutions";
    if (near != 1) return name + ": its larger box holds " + std::to_string(near) + " solutions";
    bool on_face = false;
    for (std::size_t k = 0; k < 2; ++k) {
      const int face = found->at[k] == 0 ? 0 : found->at[k] == 1 ? 1 : -1;
      if (p.face[k] != face)
        return name + " has face " + std::to_string(p.face[k]) + " of variable " + std::to_string(k);
      on_face = on_face || face >= 0;
      if (!(p.unique_in.lo[k] <= p.box[k].inf() && p.box[k].sup() <= p.unique_in.hi[k]))
        return name + " is not in its larger box";
      if (must_decide && !(p.box[k].sup() - p.box[k].inf() < 1e-9)) return name + " is wide";
    }
    if (p.on_boundary() != on_face) return name + ": on_boundary";
  }
  if (set.cells == 0) return "no cells counted";
  return {};
}

/// A point of one of the kinds that decide about faces and corners.
Point special_point(Random& random)
{
  Point p{random.unit_rational(), random.unit_rational()};
  const auto k = static_cast<std::size_t>(random.below(2));
  switch (random.below(8)) {
  case 0:
    p[k] = Rational(random.below(2));
    break; // on a face
  case 1:
    p = {Rational(random.below(2)), Rational(random.below(2))};
    break; // a corner
  case 2:
    p[k] = random.chance(50) ? Rational(-two_to(-30)) : Rational(1 + two_to(-30));
    break; // just outside
  case 3:
    p[k] = random.chance(50) ? two_to(-30) : Rational(1 - two_to(-30));
    break; // just inside
  case 4:
    p = {Rational(random.below(9)) / 8, Rational(random.below(9)) / 8};
    break; // on lines where cells are cut
  default:
    break;
  }
  return p;
}

bool are_apart(const std::vector<Point>& points, const Rational& by)
{
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (abs(Rational(points[i][0] - points[j][0])) < by && abs(Rational(points[i][1] - points[j][1])) < by)
        return false;
  return true;
}

Rational cross(const Bivariate& f, const Bivariate& g)
{
  const auto at = [](const Bivariate& h, int i, int j) {
    const auto it = h.find({i, j});
    return it == h.end() ? Rational(0) : it->second;
  };
  return Rational(at(f, 1, 0) * at(g, 0, 1) - at(f, 0, 1) * at(g, 1, 0));
}

/// Whether two lines meet at an angle of more than some 17 degrees.
bool are_steep(const Bivariate& f, const Bivariate& g)
{
  const auto length = [](const Bivariate& h) { return Rational(power(h.at({1, 0}), 2) + power(h.at({0, 1}), 2)); };
  return 12 * power(cross(f, g), 2) > length(f) * length(g);
}

} // namespace

TEST_CASE("the test's own Bernstein coefficients are those of its polynomials", "[points]")
{
  Random random(91);
  Samples samples;
  for (int i = 0; i < 30; ++i) {
    Bivariate f;
    for (int k = 0; k < 6; ++k) f[{random.below(4), random.below(4)}] += random.rational();
    const Point p{random.rational(), random.rational()};
    samples.expect(plain_value(bernstein(f), p) == value(f, p), [&] { return show_system(f, {}); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 30);
}

TEST_CASE("two lines meet in the point through which they were drawn", "[points]")
{
  Random random(92);
  Samples samples;
  std::size_t on_boundary = 0, outside = 0;
  for (int i = 0; i < 300; ++i) {
    const Point p = special_point(random);
    const auto f = line_through(p, random), g = line_through(p, random);
    if (cross(f, g) == 0) continue;
    const Point_set set = solve(f, g);
    const std::string fault = fault_of(set, {{p}}, true);
    samples.expect(fault.empty() && set.points.size() == (in_unit_square(p) ? 1u : 0u),
                   [&] { return fault + "; through " + show(p) + show_system(f, g); });
    on_boundary += !set.points.empty() && set.points[0].on_boundary();
    outside += !in_unit_square(p);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 250);
  CHECK(on_boundary > 30);
  CHECK(outside > 15);
}

TEST_CASE("a line and a conic meet in the two points through which they were drawn", "[points]")
{
  Random random(93);
  Samples samples;
  for (int i = 0; i < 180; ++i) {
    const Point p = special_point(random), q = special_point(random);
    if (!are_apart({p, q}, Rational(1, 1000))) continue;
    const auto f = line_through(p, q);
    const auto through_p = line_through(p, random), through_q = line_through(q, random);
    if (!are_steep(f, through_p) || !are_steep(f, through_q)) continue;
    const auto conic = combined(times(through_p, through_q), Rational(random.between(-3, 3)),
                                times(f, line_through({random.unit_rational(), random.unit_rational()}, random)));
    // On the line the conic is the product of the two lines: no other solutions, unless at infinity.
    const bool swapped = random.chance(50);
    const Point_set set = swapped ? solve(conic, f) : solve(f, conic);
    const std::string fault = fault_of(set, {{p}, {q}}, true);
    samples.expect(fault.empty(),
                   [&] { return fault + "; through " + show(p) + " and " + show(q) + show_system(f, conic); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 70);
}

TEST_CASE("two conics meet in the four points through which they were drawn", "[points]")
{
  Random random(94);
  Samples samples;
  std::size_t decided = 0;
  for (int i = 0; i < 80; ++i) {
    const std::vector<Point> p{special_point(random), special_point(random), special_point(random),
                               special_point(random)};
    if (!are_apart(p, Rational(1, 100))) continue;
    bool collinear = false;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (std::size_t c = 0; c < b; ++c)
          collinear = collinear || abs(value(line_through(p[a], p[b]), p[c])) < Rational(1, 1000);
    if (collinear) continue;
    const auto first = times(line_through(p[0], p[1]), line_through(p[2], p[3])),
               second = times(line_through(p[0], p[2]), line_through(p[1], p[3]));
    // All conics of the pencil pass through the four; two of them meet nowhere else. Some run close together all the
    // way, which costs more cells than there may be: those are left undecided, never wrong.
    const auto f = combined(first, Rational(random.between(1, 5)), second),
               g = combined(first, Rational(-random.between(1, 5)) / 3, second);
    const Point_set set = solve(f, g);
    const std::string fault = fault_of(set, {{p[0]}, {p[1]}, {p[2]}, {p[3]}}, false);
    samples.expect(fault.empty(), [&] {
      return fault + "; through " + show(p[0]) + show(p[1]) + show(p[2]) + show(p[3]) + show_system(f, g);
    });
    decided += fault_of(set, {{p[0]}, {p[1]}, {p[2]}, {p[3]}}, true).empty();
  }
  LOCUS_REQUIRE_SAMPLES(samples, 20);
  CHECK(10 * decided >= 9 * samples.count());
}

TEST_CASE("bundles of lines meet in all their pairs", "[points]")
{
  Random random(95);
  Samples samples;
  std::size_t steep_bundles = 0;
  for (int i = 0; i < 60; ++i) {
    const int n = random.between(2, 3);
    std::array<std::vector<Bivariate>, 2> lines;
    std::array<Bivariate, 2> product{Bivariate{{{0, 0}, Rational(1)}}, Bivariate{{{0, 0}, Rational(-2)}}};
    for (std::size_t side = 0; side < 2; ++side)
      for (int k = 0; k < n; ++k) {
        lines[side].push_back(line_through({random.unit_rational(), random.unit_rational()}, random));
        product[side] = times(product[side], lines[side].back());
      }
    std::vector<Known> solutions;
    std::vector<Point> points;
    bool parallel = false, steep = true;
    for (auto& a : lines[0])
      for (auto& b : lines[1]) {
        const Rational d = cross(a, b);
        steep = steep && are_steep(a, b);
        if (d == 0) {
          parallel = true;
          continue;
        }
        const Point p{Rational((a[{0, 1}] * b[{0, 0}] - b[{0, 1}] * a[{0, 0}]) / d),
                      Rational((a[{0, 0}] * b[{1, 0}] - b[{0, 0}] * a[{1, 0}]) / d)};
        solutions.push_back({p});
        points.push_back(p);
      }
    if (parallel || !are_apart(points, Rational(1, 300))) continue;
    const Point_set set = solve(product[0], product[1]);
    const std::string fault = fault_of(set, solutions, steep); // lines that nearly agree may cost too many cells
    steep_bundles += steep;
    samples.expect(fault.empty(), [&] { return fault + show_system(product[0], product[1]); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 20);
  CHECK(steep_bundles >= 3);
}

TEST_CASE("a solution that is proved early is still enclosed closely", "[points]")
{
  // Krawczyk's first images are hardly smaller than the cell here.
  const Point p{Rational(1), Rational(0)}, q{Rational(5, 8), Rational(3, 8)};
  Random random(100);
  Samples samples;
  for (int i = 0; i < 1200; ++i) {
    const auto f = line_through(p, q), through_p = line_through(p, random), through_q = line_through(q, random);
    if (!are_steep(f, through_p) || !are_steep(f, through_q)) continue;
    const auto conic = combined(times(through_p, through_q), Rational(random.between(-20, 20)),
                                times(f, line_through({random.unit_rational(), random.unit_rational()}, random)));
    const Point_set set = solve(f, conic);
    const std::string fault = fault_of(set, {{p}, {q}}, set.undecided.empty());
    samples.expect(fault.empty(), [&] { return fault + show_system(f, conic); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 500);
}

TEST_CASE("a solution on the corner of cells is reported once, and closely enclosed", "[points]")
{
  struct Case {
    Bivariate f, g;
    Point p, q;
  };
  const auto quadratic = [](const char* c, const char* y, const char* yy, const char* x, const char* xy,
                            const char* xx) {
    return Bivariate{{{0, 0}, Rational(c)}, {{0, 1}, Rational(y)},  {{0, 2}, Rational(yy)},
                     {{1, 0}, Rational(x)}, {{1, 1}, Rational(xy)}, {{2, 0}, Rational(xx)}};
  };
  const Bivariate diagonal = line(1, 1, -1);
  const Point one{Rational(1), Rational(0)}, other{Rational(5, 8), Rational(3, 8)};
  const std::vector<Case> cases{
    {diagonal, quadratic("-1191/514", "-18341/514", "43", "21237/514", "-4", "-39"), one, other},
    {diagonal,
     quadratic("-15389067779/1045271428", "-29034967911/1045271428", "265/8", "129817603361/2090542856", "3/4",
               "-379/8"),
     one, other},
    {diagonal,
     quadratic("182448013839/27514634650", "1712458888397/55029269300", "-29", "-1420606573089/27514634650", "2", "45"),
     one, other},
    {line(Rational(-1, 3), -1, Rational(7, 6)),
     quadratic("528482325/16777216", "-18", "0", "-754974741/8388608", "36", "54"),
     {Rational(1, 2), Rational(1)},
     {Rational(Rational(1, 2) + two_to(-24)), Rational(1 - two_to(-24) / 3)}},
    // Two enclosures of one point: the later one reaches out of the box in which the earlier is unique, but not the
    // other way round.
    {line(Rational(-1, 3145728), Rational(-1, 1048576), Rational("330906174969/576460752303947776")),
     quadratic("57408836239324466771122202797/19807040628602113195404967936", "-1040939720461254655/108086391056990208",
               "8", "-1561403533377929209/432345564227960832", "6", "-14"),
     {Rational(0), Rational("661812349938/1099511627777")},
     {two_to(-20), Rational("2081880540434137087/3458764513823686656")}},
  };
  for (const Case& c : cases) {
    REQUIRE(value(c.f, c.p) == 0);
    REQUIRE(value(c.g, c.p) == 0);
    REQUIRE(value(c.f, c.q) == 0);
    REQUIRE(value(c.g, c.q) == 0);
    const Point_set set = solve(c.f, c.g);
    CHECK(fault_of(set, {{c.p}, {c.q}}, set.undecided.empty()) == "");
  }
}

TEST_CASE("solutions close together are told apart or left undecided, never merged", "[points]")
{
  Random random(96);
  Samples samples;
  std::size_t decided = 0;
  for (const int k : {4, 8, 12, 16, 20, 24, 30}) {
    for (int i = 0; i < 20; ++i) {
      const Point p{random.unit_rational(), random.unit_rational()},
        q{Rational(p[0] + two_to(-k)), Rational(p[1] - two_to(-k) / 3)};
      if (!in_unit_square(p) || !in_unit_square(q)) continue;
      const auto f = line_through(p, q), through_p = line_through(p, random), through_q = line_through(q, random);
      if (value(through_p, q) == 0 || value(through_q, p) == 0) continue;
      const auto conic = times(through_p, through_q);
      const Point_set set = solve(f, conic);
      const std::string fault = fault_of(set, {{p}, {q}}, false);
      samples.expect(fault.empty(), [&] { return fault + "; 2^-" + show(k) + " apart" + show_system(f, conic); });
      decided += set.undecided.empty();
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 80);
  CHECK(100 * decided >= 97 * samples.count());
}

TEST_CASE("double solutions come back as undecided boxes, never as a point or as nothing", "[points]")
{
  Random random(97);
  Samples samples;
  for (int i = 0; i < 12; ++i) {
    Point p = special_point(random);
    if (i % 3 == 0) p = {Rational(random.below(17)) / 16, Rational(random.below(17)) / 16};
    if (!in_unit_square(p)) continue;
    Bivariate f, g;
    switch (i % 4) {
    case 0: // a parabola and its tangent at the vertex
      f = line(0, 1, Rational(-p[1]));
      g = combined(f, Rational(-1), times(line(1, 0, Rational(-p[0])), line(1, 0, Rational(-p[0]))));
      break;
    case 1: { // a line and a conic that touches it: the product of two lines through the point, plus the line times another
      f = line_through(p, random);
      const auto a = line_through(p, random);
      if (cross(f, a) == 0) continue;
      g = combined(times(a, a), Rational(1), times(f, line(random.between(1, 3), random.between(1, 3), 20)));
      break;
    }
    case 2: // both singular: two crossing pairs of lines with one centre, four-fold
      f = times(line(1, 2, Rational(-p[0] - 2 * p[1])), line(2, -1, Rational(-2 * p[0] + p[1])));
      g = times(line(1, 3, Rational(-p[0] - 3 * p[1])), line(3, -2, Rational(-3 * p[0] + 2 * p[1])));
      break;
    default: // one equation singular
      f = line(1, 1, Rational(-p[0] - p[1]));
      g = times(line(1, 2, Rational(-p[0] - 2 * p[1])), line(2, -1, Rational(-2 * p[0] + p[1])));
    }
    const Point_set set = solve(f, g);
    const std::string fault = fault_of(set, {{p, false}}, false);
    bool covered = false;
    for (const auto& box : set.undecided) covered = covered || contains(box, p);
    samples.expect(fault.empty() && covered && set.points.empty(),
                   [&] { return fault + "; kind " + show(i % 4) + " at " + show(p) + show_system(f, g); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 6);
}

TEST_CASE("a common curve is left undecided along its whole length", "[points]")
{
  const Bivariate common = line(2, -1, Rational(-1, 3)), f = times(common, line(1, 1, -5)),
                  g = times(common, line(1, -3, 7)), zero{{{0, 0}, Rational(0)}};
  for (const auto& [a, b] :
       std::vector<std::pair<Bivariate, Bivariate>>{{f, g}, {common, common}, {common, zero}, {zero, common}}) {
    Solve_control control;
    control.max_cells = 1000;
    const Point_set set = solve(a, b, control);
    CHECK(set.points.empty());
    std::size_t covered = 0;
    for (int k = 0; k <= 16; ++k) {
      const Point p{Rational(Rational(1, 6) + Rational(k) / 32), Rational(k) / 16}; // 2x - y = 1/3
      REQUIRE(value(common, p) == 0);
      for (const auto& box : set.undecided)
        if (contains(box, p)) {
          ++covered;
          break;
        }
    }
    CHECK(covered == 17u);
  }
}

TEST_CASE("systems without solutions in the square leave nothing", "[points]")
{
  Random random(98);
  Samples samples;
  for (int i = 0; i < 30; ++i) {
    // A positive conic, or two parallel lines, or a meeting far outside.
    const Bivariate parallel = line(1, 2, Rational(-random.between(1, 2)));
    Bivariate f = parallel, g = combined(parallel, Rational(1), {{{0, 0}, two_to(-random.between(1, 6))}});
    if (i % 3 == 0)
      g = {{{2, 0}, Rational(1)}, {{0, 2}, Rational(1)}, {{1, 1}, Rational(1)}, {{0, 0}, Rational(1, 100)}};
    if (i % 3 == 1) g = line_through({Rational(2), Rational(-1, 2)}, random), f = line(1, 2, -1);
    if (i % 3 == 1 && cross(f, g) == 0) continue;
    const Point_set set = solve(f, g);
    samples.expect(set.points.empty() && set.undecided.empty() && set.cells > 0, [&] { return show_system(f, g); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 20);
}

// ------------------------------------------------------------------------------------------------- faces, exactly

TEST_CASE("a point beside a face is not on it though the equations meet elsewhere on that face", "[points][face]")
{
  // Solutions (0, 1/5) and (δ, 9/10): on the face x = 0 the equations have the common root 1/5, which is another point.
  for (const int variable : {0, 1})
    for (const int side : {0, 1})
      for (const Rational& delta : {two_to(-70), Rational(-two_to(-70))}) {
        const auto place = [&](const Rational& across, const Rational& along) {
          const Rational x = side == 1 ? Rational(1 - across) : across;
          return variable == 0 ? Point{x, along} : Point{along, x};
        };
        const Point on = place(0, Rational(1, 5)), beside = place(delta, Rational(9, 10));
        const auto f = line_through(on, beside);
        const auto level = [&](const Rational& along) {
          return variable == 0 ? line(0, 1, Rational(-along)) : line(1, 0, Rational(-along));
        };
        const auto g = times(level(Rational(1, 5)), level(Rational(9, 10)));
        const Point_set set = solve(f, g);
        const std::string fault = fault_of(set, {{on}, {beside}}, false);
        INFO("variable " << variable << ", side " << side << ", δ = " << show(delta));
        CHECK(fault == "");
      }
}

TEST_CASE("a point beside a corner is not in it", "[points][face]")
{
  const Rational delta = two_to(-70);
  for (const Rational& x : {delta, Rational(-delta), Rational(1 - delta)})
    for (const Rational& y : {delta, Rational(0), Rational(1 + delta)}) {
      const Point p{x, y};
      const Point_set set = solve(line(1, 2, Rational(-x - 2 * y)), line(3, -1, Rational(-3 * x + y)));
      INFO(show(p));
      CHECK(fault_of(set, {{p}}, false) == "");
    }
}

TEST_CASE("a face on which an equation vanishes is told from one that it only meets", "[points][face]")
{
  // x = 0 and a line across it: the solution lies on the face, exactly, and with the corner on two.
  for (const Rational& y : {Rational(0), Rational(1, 3), Rational(1)}) {
    const Point_set set = solve(line(1, 0, 0), line(1, 2, Rational(-2 * y)));
    CHECK(fault_of(set, {{{Rational(0), y}}}, true) == "");
    CHECK(set.points.size() == 1u);
  }
}

// ---------------------------------------------------------------------------------------------------- sizes, limits

TEST_CASE("equations of huge, tiny and unequal size lose no solution", "[points][scale]")
{
  Random random(99);
  Samples samples;
  std::size_t decided = 0;
  for (const char* factor :
       {"1e150", "1e300", "1e305", "1e308", "1e320", "1e400", "1e-150", "1e-300", "1e-310", "1e-320", "1e-400"})
    for (int i = 0; i < 3; ++i) {
      const Point p{random.unit_rational(), random.unit_rational()};
      auto f = line_through(p, random), other = line_through(p, random);
      if (cross(f, other) == 0) continue;
      auto g = times(other, line(1, 1, 7));
      const auto scale = locus::parse_rational(factor);
      for (auto& term : f) term.second *= scale;
      if (i != 1)
        for (auto& term : g) term.second *= scale;
      Solve_control control;
      control.max_cells = 500;
      const Point_set set = solve(f, g, control);
      // Other solutions of the system lie outside: x + y = -7.
      std::size_t points = 0, undecided = 0;
      for (const auto& found : set.points) points += contains(found.box, p);
      for (const auto& box : set.undecided) undecided += contains(box, p);
      samples.expect(points + undecided > 0 && points <= 1 && set.points.size() == points,
                     [&] { return std::string(factor) + " at " + show(p) + show_system(f, g); });
      decided += set.undecided.empty();
    }
  LOCUS_REQUIRE_SAMPLES(samples, 20);
  CHECK(decided >= 4);
}

TEST_CASE("a limit or a cancellation leaves the rest undecided", "[points]")
{
  const Point p{Rational(1, 3), Rational(1, 7)};
  // Through p run also the other lines, which meet the first ones elsewhere in the square.
  const Bivariate f = times(line_through(p, {Rational(1), Rational(1)}),
                            line_through({Rational(0), Rational(1, 2)}, {Rational(1), Rational(3, 4)})),
                  g = times(line_through(p, {Rational(0), Rational(1)}),
                            line_through({Rational(1, 2), Rational(0)}, {Rational(2, 3), Rational(1)}));
  Solve_control few;
  few.max_cells = 2;
  Solve_control cancelled;
  cancelled.cancel = std::make_shared<std::atomic<bool>>(true);
  Solve_control late;
  late.max_seconds = 0;
  for (const Solve_control& control : {few, cancelled, late}) {
    const Point_set set = solve(f, g, control);
    CHECK(set.points.empty());
    CHECK(set.undecided_details.size() == set.undecided.size());
    std::size_t covered = 0;
    for (const auto& box : set.undecided) covered += contains(box, p);
    CHECK(covered >= 1u);
  }
  CHECK(solve(f, g).points.size() == 4u);
  CHECK(solve(f, g).undecided.empty());
}

// ------------------------------------------------------------------------------------------------ one to four variables

namespace {

/// A polynomial in K variables, by exponents.
template <int K>
using Multivariate = std::map<std::array<int, static_cast<std::size_t>(K)>, Rational>;

template <int K>
using Place = std::array<Rational, static_cast<std::size_t>(K)>;

template <int K>
Multivariate<K> product(const Multivariate<K>& f, const Multivariate<K>& g)
{
  Multivariate<K> h;
  for (const auto& [e, a] : f)
    for (const auto& [d, b] : g) {
      auto sum = e;
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += d[k];
      h[sum] += a * b;
    }
  return h;
}

template <int K>
Multivariate<K> added(Multivariate<K> f, const Rational& factor, const Multivariate<K>& g)
{
  for (const auto& [e, a] : g) f[e] += factor * a;
  return f;
}

template <int K>
Multivariate<K> constant(const Rational& c)
{
  return {{{}, c}};
}

template <int K>
Multivariate<K> variable(std::size_t k)
{
  std::array<int, static_cast<std::size_t>(K)> e{};
  e[k] = 1;
  return {{e, Rational(1)}};
}

/// Σ a_k·(x_k - p_k).
template <int K>
Multivariate<K> plane_through(const Place<K>& a, const Place<K>& p)
{
  Multivariate<K> f;
  for (std::size_t k = 0; k < p.size(); ++k)
    f = added<K>(added<K>(f, a[k], variable<K>(k)), Rational(-a[k] * p[k]), constant<K>(1));
  return f;
}

/// Bernstein coefficients from the definition of the basis.
template <int K>
Bernstein<Rational, K> bernstein_of(const Multivariate<K>& f)
{
  Degrees<K> degrees{};
  for (const auto& [e, a] : f)
    for (std::size_t k = 0; k < degrees.size(); ++k) degrees[k] = std::max(degrees[k], e[k]);
  Bernstein<Rational, K> b(degrees);
  Degrees<K> i{};
  std::size_t at = 0;
  do {
    for (const auto& [e, a] : f) {
      Rational term = a;
      for (std::size_t k = 0; k < degrees.size(); ++k) {
        term *= e[k] <= i[k] ? choose(i[k], e[k]) : Integer(0);
        term /= choose(degrees[k], e[k]);
      }
      b[at] += term;
    }
    ++at;
  } while (locus::advance_index(i, degrees));
  return b;
}

template <int K>
using Multivariates = std::array<Multivariate<K>, static_cast<std::size_t>(K)>;

template <int K>
locus::Equations<K> equations_of(const Multivariates<K>& f)
{
  locus::Equations<K> equations;
  for (std::size_t k = 0; k < f.size(); ++k)
    equations[k] = std::make_shared<Polynomial_equation<K>>(bernstein_of<K>(f[k]));
  return equations;
}

template <int K>
locus::Point_set<K> solved(const Multivariates<K>& f, const Solve_control& control = {})
{
  locus::Point_set<K> set;
  with_upward_rounding([&] { set = locus::solve_points<K>(equations_of<K>(f), control); });
  return set;
}

template <std::size_t N>
bool holds(const std::array<Interval, N>& box, const std::array<Rational, N>& p)
{
  for (std::size_t k = 0; k < N; ++k)
    if (p[k] < exact_rational(box[k].inf()) || p[k] > exact_rational(box[k].sup())) return false;
  return true;
}

template <int K>
bool holds(const Box<K>& box, const Place<K>& p)
{
  for (std::size_t k = 0; k < p.size(); ++k)
    if (p[k] < exact_rational(box.lo[k]) || p[k] > exact_rational(box.hi[k])) return false;
  return true;
}

template <int K>
bool in_unit_box(const Place<K>& p)
{
  return std::all_of(p.begin(), p.end(), [](const Rational& x) { return x >= 0 && x <= 1; });
}

/// What is wrong with an answer in which all regular solutions, which are known, must be decided; or an empty text.
template <int K>
std::string fault_with(const locus::Point_set<K>& set, const std::vector<Place<K>>& solutions)
{
  if (!set.undecided.empty()) return std::string("undecided: ") + set.undecided_details[0].reason;
  std::size_t expected = 0;
  for (const auto& s : solutions) {
    if (!in_unit_box<K>(s)) continue;
    ++expected;
    std::size_t boxes = 0;
    for (const auto& p : set.points) {
      if (!holds(p.box, s)) continue;
      ++boxes;
      for (std::size_t k = 0; k < s.size(); ++k) {
        if (p.face[k] != (s[k] == 0 ? 0 : s[k] == 1 ? 1 : -1)) return "face of " + show(s);
        if (!(p.box[k].sup() - p.box[k].inf() < 1e-9)) return "a wide box at " + show(s);
      }
      const auto near = std::count_if(solutions.begin(), solutions.end(),
                                      [&](const auto& other) { return holds<K>(p.unique_in, other); });
      if (near != 1) return "not unique: " + show(s);
    }
    if (boxes != 1) return show(s) + " is found " + std::to_string(boxes) + " times";
  }
  return set.points.size() == expected ? "" : "there are points that are no solutions";
}

/// The solution of a square linear system, by Cramer's rule as elimination; false if singular.
template <int K>
bool solve_linear(std::vector<Place<K>> rows, Place<K> right, Place<K>& x)
{
  for (std::size_t c = 0; c < x.size(); ++c) {
    std::size_t pivot = c;
    while (pivot < x.size() && rows[pivot][c] == 0) ++pivot;
    if (pivot == x.size()) return false;
    std::swap(rows[pivot], rows[c]);
    std::swap(right[pivot], right[c]);
    for (std::size_t r = 0; r < x.size(); ++r) {
      if (r == c || rows[r][c] == 0) continue;
      const Rational factor = rows[r][c] / rows[c][c];
      for (std::size_t k = c; k < x.size(); ++k) rows[r][k] -= factor * rows[c][k];
      right[r] -= factor * right[c];
    }
  }
  for (std::size_t c = 0; c < x.size(); ++c) x[c] = right[c] / rows[c][c];
  return true;
}

/// Pairs of parallel planes, mixed: equation k is Σ_j m_kj·l_j·(l_j - d_j), where all l_j vanish at p. The 2^K solutions
/// are known.
template <int K>
struct Planted {
  Multivariates<K> equations;
  std::vector<Place<K>> solutions;
  bool is_regular = true;
};

template <int K>
Planted<K> planted(const Place<K>& p, Random& random)
{
  constexpr auto size = static_cast<std::size_t>(K);
  Planted<K> result;
  std::vector<Place<K>> normals(size);
  Place<K> gap, ignored;
  Multivariates<K> pairs;
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t k = 0; k < size; ++k) normals[j][k] = k == j ? random.between(4, 7) : random.between(-1, 1);
    gap[j] = Rational(random.between(5, 30) * (random.chance(50) ? 1 : -1), 7);
    gap[j].canonicalize();
    const auto plane = plane_through<K>(normals[j], p);
    pairs[j] = product<K>(plane, added<K>(plane, Rational(-gap[j]), constant<K>(1)));
  }
  std::vector<Place<K>> mixture(size);
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t j = 0; j < size; ++j) {
      mixture[k][j] = random.between(-3, 3);
      result.equations[k] = added<K>(result.equations[k], mixture[k][j], pairs[j]);
    }
  result.is_regular = solve_linear<K>(mixture, gap, ignored);
  for (unsigned choice = 0; choice < (1u << K); ++choice) {
    Place<K> right, x;
    for (std::size_t j = 0; j < size; ++j) right[j] = choice & (1u << j) ? gap[j] : Rational(0);
    if (!solve_linear<K>(normals, right, x)) result.is_regular = false;
    for (std::size_t k = 0; k < size; ++k) x[k] += p[k];
    result.solutions.push_back(x);
  }
  return result;
}

template <int K>
void check_planted(std::uint64_t stream, int count)
{
  Random random(stream);
  Samples samples;
  std::size_t on_boundary = 0, corners = 0, all = 0;
  for (int i = 0; i < count; ++i) {
    Place<K> p;
    for (Rational& x : p) x = random.chance(30) ? Rational(random.below(2)) : Rational(random.below(41), 40);
    for (Rational& x : p) x.canonicalize();
    if (i % 4 == 0)
      for (Rational& x : p) x = Rational(random.below(2));
    const Planted<K> system = planted<K>(p, random);
    if (!system.is_regular) continue;
    const auto set = solved<K>(system.equations);
    const std::string fault = fault_with<K>(set, system.solutions);
    samples.expect(fault.empty(), [&] { return fault + "; K = " + std::to_string(K) + ", planted at " + show(p); });
    all += set.points.size();
    for (const auto& q : set.points) {
      on_boundary += q.on_boundary();
      corners += std::none_of(q.face.begin(), q.face.end(), [](int f) { return f < 0; });
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, count / 2);
  CHECK(on_boundary >= corners);
  CHECK(corners > 0u);
  CHECK(all > samples.count());
}

} // namespace

TEST_CASE("planted solutions are found in one to four variables, on faces and in corners too", "[points][dimension]")
{
  check_planted<1>(101, 200);
  check_planted<2>(102, 100);
  check_planted<3>(103, 30);
  check_planted<4>(104, 8);
}

TEST_CASE("all solutions on the graph of a polynomial, as many as Sturm counts", "[points]")
{
  Random random(105);
  Samples samples;
  std::size_t all = 0;
  for (int i = 0; i < 150; ++i) {
    // y = h(x) with 0 < h < 1, and a random f(x, y): the roots of f(x, h(x)).
    const int n = random.between(1, 3), fn = random.between(1, 4), fm = random.between(1, 4);
    Bernstein<Rational, 1> steep(Degrees<1>{n});
    for (std::size_t k = 0; k < steep.size(); ++k) steep[k] = Rational(random.between(1, 31), 32);
    for (std::size_t k = 0; k < steep.size(); ++k) steep[k].canonicalize();
    Polynomial h;
    for (int k = 0; k <= n; ++k) { // differences at the start
      Rational d = 0;
      for (int j = 0; j <= k; ++j)
        d += (((k - j) % 2) ? -1 : 1) * Rational(choose(k, j)) * steep[static_cast<std::size_t>(j)];
      h.push_back(Rational(choose(n, k) * d));
    }
    Multivariate<2> graph = variable<2>(1), f;
    for (int k = 0; k <= n; ++k) graph[{k, 0}] -= h[static_cast<std::size_t>(k)];
    Polynomial along, h_power{Rational(1)};
    for (int j = 0; j <= fm; ++j) {
      for (int k = 0; k <= fn; ++k) {
        const Rational c = random.between(-9, 9);
        f[{k, j}] = c;
        Polynomial term(static_cast<std::size_t>(k), Rational(0));
        term.push_back(c);
        along = plus(along, times(term, h_power));
      }
      h_power = times(h_power, h);
    }
    if (along.size() < 2 || euclid(along, slope(along)).size() > 1) continue;
    const auto roots = Sturm(along).closed(0, 1);
    const auto set = random.chance(50) ? solved<2>({f, graph}) : solved<2>({graph, f});
    samples.expect(set.undecided.empty() && static_cast<int>(set.points.size()) == roots,
                   [&] { return std::to_string(set.points.size()) + " points, " + std::to_string(set.undecided.size()) +
                                " undecided, but " + std::to_string(roots) + " roots"; });
    all += set.points.size();
  }
  LOCUS_REQUIRE_SAMPLES(samples, 120);
  CHECK(all > 25);
}

TEST_CASE("roots of one polynomial: simple ones are found, multiple ones bounded", "[points][dimension]")
{
  Random random(106);
  Samples samples;
  for (int i = 0; i < 200; ++i) {
    std::vector<Rational> simple;
    for (int k = random.between(0, 4); k > 0; --k) simple.push_back(Rational(Rational(random.below(101)) / 100));
    std::sort(simple.begin(), simple.end());
    simple.erase(std::unique(simple.begin(), simple.end()), simple.end());
    // Not among the others; now and then an end of the boxes that are cut.
    const Rational centre = random.chance(70) ? Rational(Rational(random.below(101)) / 100 + Rational(1, 300))
                                              : Rational(Rational(2 * random.below(8) + 1) / 16);
    const int multiplicity = random.below(4);
    Multivariate<1> f = constant<1>(random.chance(50) ? 3 : -1);
    std::vector<Place<1>> solutions;
    for (const Rational& r : simple) {
      f = product<1>(f, plane_through<1>({Rational(1)}, {r}));
      solutions.push_back({r});
    }
    for (int k = 0; k < multiplicity; ++k) f = product<1>(f, plane_through<1>({Rational(1)}, {centre}));
    const auto set = solved<1>({f});
    bool ok = true;
    if (multiplicity < 2 || centre > 1) {
      if (multiplicity == 1) solutions.push_back({centre});
      ok = fault_with<1>(set, solutions).empty();
    } else {
      std::size_t covered = 0;
      for (std::size_t k = 0; k < set.undecided.size(); ++k)
        if (holds<1>(set.undecided[k], {centre})) {
          ++covered;
          ok = ok && set.undecided_details[k].at_most &&
               *set.undecided_details[k].at_most >= static_cast<unsigned>(multiplicity) &&
               *set.undecided_details[k].at_most <= static_cast<unsigned>(multiplicity + 1);
        } else {
          ok = ok && set.undecided_details[k].at_most <= 2u; // beside it
        }
      ok = ok && covered > 0 && set.points.size() == simple.size();
    }
    samples.expect(ok, [&] {
      return "simple " + show(simple) + ", centre " + show(centre) + ", multiplicity " + show(multiplicity);
    });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("a double solution in space is left undecided with a bound, the others are found", "[points][dimension]")
{
  // z = 1/3 touches the sphere-like surface z - 1/3 = (x-1/2)² + (y-1/2)² … and a plane cuts what is left to one point.
  const auto x = plane_through<3>({1, 0, 0}, {Rational(1, 2), 0, 0}),
             y = plane_through<3>({0, 1, 0}, {0, Rational(1, 2), 0});
  const auto z = plane_through<3>({0, 0, 1}, {0, 0, Rational(1, 3)});
  const auto set =
    solved<3>({added<3>(z, Rational(-1), product<3>(x, x)), z, added<3>(y, Rational(1), product<3>(x, z))});
  const Place<3> p{Rational(1, 2), Rational(1, 2), Rational(1, 3)};
  CHECK(set.points.empty());
  std::size_t covered = 0;
  for (std::size_t k = 0; k < set.undecided.size(); ++k) {
    if (!holds<3>(set.undecided[k], p)) continue;
    ++covered;
    CHECK(set.undecided_details[k].at_most.value_or(0) >= 2u);
    CHECK(set.undecided[k].max_width() < 1e-6);
  }
  CHECK(covered > 0u);
  CHECK(set.cells < 3000u);
}

TEST_CASE("solutions 2^-30 apart are separated in every dimension", "[points][dimension]")
{
  for (const int k : {10, 20, 30}) {
    const Rational a(1, 3), b = a + two_to(-k);
    const auto at = [](std::size_t v, const Rational& c) { return v == 0 ? c : Rational(2, 7); };
    const auto f1 = product<1>(plane_through<1>({1}, {a}), plane_through<1>({1}, {b}));
    CHECK(fault_with<1>(solved<1>({f1}), {{a}, {b}}) == "");
    // (x-a)(x-b) + y·(x-1) and y + 3 (x-a)(x-b), with the other coordinates carried along.
    Multivariates<3> f;
    const auto pair =
      product<3>(plane_through<3>({1, 0, 0}, {at(0, a), 0, 0}), plane_through<3>({1, 0, 0}, {at(0, b), 0, 0}));
    const auto y = plane_through<3>({0, 1, 1}, {0, Rational(2, 7), Rational(1, 5)}),
               z = plane_through<3>({0, 1, -2}, {0, Rational(2, 7), Rational(1, 5)});
    f[0] = added<3>(pair, Rational(1), y);
    f[1] = added<3>(added<3>(y, Rational(3), pair), Rational(2), z);
    f[2] = added<3>(z, Rational(-1, 2), pair);
    const Place<3> p{a, Rational(2, 7), Rational(1, 5)}, q{b, Rational(2, 7), Rational(1, 5)};
    INFO("2^-" << k);
    CHECK(fault_with<3>(solved<3>(f), {p, q}) == "");
  }
}

TEST_CASE("digits that cancel in doubles are found again with more bits", "[points][precision]")
{
  // Two lines plus 2^60 times their cubes: to tell that they meet once takes a look at some 2^-30 of the square.
  Multivariate<2> l = plane_through<2>({3, 1}, {Rational(2, 5), Rational(3, 7)}),
                  m = plane_through<2>({1, -2}, {Rational(2, 5), Rational(3, 7)});
  const auto f = added<2>(l, two_to(60), product<2>(product<2>(l, l), l)),
             g = added<2>(m, two_to(60), product<2>(product<2>(m, m), m));
  CHECK(fault_with<2>(solved<2>({f, g}), {{Rational(2, 5), Rational(3, 7)}}) == "");
  Solve_control short_numbers;
  short_numbers.max_bits = 64;
  const auto poor = solved<2>({f, g}, short_numbers);
  CHECK(poor.points.empty());
  REQUIRE(!poor.undecided.empty());
  CHECK(std::string(poor.undecided_details[0].reason) == "precision limit");
  // Both roots of x² - 10^-16 lie where its coefficients nearly agree.
  const auto h = added<1>(product<1>(variable<1>(0), variable<1>(0)), locus::parse_rational("-1e-16"), constant<1>(1));
  CHECK(fault_with<1>(solved<1>({h}), {{locus::parse_rational("1e-8")}, {locus::parse_rational("-1e-8")}}) == "");
}

TEST_CASE("equations that differ in far digits only are told apart", "[points][precision]")
{
  // A = 0 and A + 2^-k·l = 0: the line l meets the conic A in one point of the square.
  const Place<2> p{Rational(2, 5), Rational(3, 7)};
  const auto l = plane_through<2>({3, -2}, p), x = plane_through<2>({1, 0}, p), y = plane_through<2>({0, 1}, p);
  const auto conic =
    added<2>(added<2>(plane_through<2>({1, 2}, p), Rational(1), product<2>(x, x)), Rational(1, 3), product<2>(y, y));
  for (const int k : {20, 45, 60, 80, 150}) {
    INFO("2^-" << k);
    CHECK(fault_with<2>(solved<2>({added<2>(conic, two_to(-k), l), conic}), {p}) == "");
    const auto z = added<3>(variable<3>(2), Rational(-1, 9), constant<3>(1));
    Multivariate<3> a, m;
    for (const auto& [e, c] : conic) a[{e[0], e[1], 0}] = c;
    for (const auto& [e, c] : l) m[{e[0], e[1], 0}] = c;
    const auto set = solved<3>({added<3>(a, Rational(1), z), added<3>(added<3>(a, Rational(1), z), two_to(-k), m),
                                added<3>(a, Rational(-2), z)});
    CHECK(fault_with<3>(set, {{p[0], p[1], Rational(1, 9)}}) == "");
  }
}

TEST_CASE("a solution on a face of the cube is decided exactly where that can be", "[points][face][dimension]")
{
  const auto x = variable<3>(0), y = variable<3>(1), z = variable<3>(2);
  const auto half = added<3>(product<3>(x, x), Rational(-1, 2), constant<3>(1)); // x = √½
  const auto same = added<3>(y, Rational(-1), x);
  // The last equation vanishes on the face: the other two say where.
  const auto on_face = product<3>(z, added<3>(x, Rational(1), constant<3>(1)));
  const auto set = solved<3>({added<3>(half, Rational(1), z), added<3>(same, Rational(2), product<3>(z, z)), on_face});
  CHECK(set.undecided.empty());
  REQUIRE(set.points.size() == 1u);
  CHECK(set.points[0].face == std::array<int, 3>{-1, -1, 0});
  // Here all three are needed to see that z = 0: an irrational solution, left undecided, not lost.
  const auto hidden =
    solved<3>({added<3>(half, Rational(1), product<3>(x, z)), same, added<3>(z, Rational(1), product<3>(half, y))});
  CHECK(hidden.points.empty());
  REQUIRE(hidden.undecided.size() == 1u);
  CHECK(hidden.undecided_details[0].at_most == 1u);
  CHECK(std::string(hidden.undecided_details[0].reason).find("face") != std::string::npos);
}

TEST_CASE("progress is reported rounding to nearest, and limits hold in space", "[points][limits]")
{
  const auto x = variable<3>(0), y = variable<3>(1);
  const auto f = added<3>(product<3>(x, x), Rational(-1, 2), product<3>(y, y));
  Solve_control control;
  control.max_cells = 2000;
  std::size_t calls = 0, last = 0;
  bool nearest = true;
  control.progress = [&](std::size_t done, std::size_t) {
    ++calls;
    nearest = nearest && observed_mode() == FE_TONEAREST && done > last;
    last = done;
  };
  const auto set = solved<3>({f, f, f}, control); // a surface: no end but the limit
  CHECK(calls > 3u);
  CHECK(nearest);
  CHECK(set.cells == 2000u);
  CHECK(set.points.empty());
  CHECK(!set.undecided.empty());
  CHECK(observed_mode() == FE_TONEAREST);
}

// ------------------------------------------------------------------------------------------------------- whole domains

namespace {

locus::Chain real_line()
{
  locus::Chain line;
  line.pieces.resize(3);
  line.pieces[0].lo_infinite = line.pieces[2].hi_infinite = true;
  line.pieces[0].hi = line.pieces[1].lo = -1;
  line.pieces[1].hi = line.pieces[2].lo = 1;
  line.joints.resize(2);
  return line;
}

/// A polynomial of degree n in u as one of degree n in the piece's local coordinate, times s^n or (1-s)^n.
template <int K>
Multivariate<K> on_piece(const Multivariate<K>& f, std::size_t v, const locus::Piece& piece)
{
  int n = 0;
  for (const auto& [e, a] : f) n = std::max(n, e[v]);
  const auto s = variable<K>(v), rest = added<K>(constant<K>(1), Rational(-1), s);
  // u = numerator/denominator.
  auto numerator = constant<K>(piece.hi_infinite ? piece.lo : piece.hi), denominator = piece.hi_infinite ? rest : s;
  if (piece.is_finite()) {
    numerator = added<K>(constant<K>(piece.lo), Rational(piece.hi - piece.lo), s);
    denominator = constant<K>(1);
  }
  Multivariate<K> sum;
  for (const auto& [e, a] : f) {
    auto rest_of_term = e;
    rest_of_term[v] = 0;
    Multivariate<K> term{{rest_of_term, a}};
    for (int i = 0; i < n; ++i) term = product<K>(term, i < e[v] ? numerator : denominator);
    sum = added<K>(sum, Rational(1), term);
  }
  return sum;
}

template <int K>
locus::Domain_point_set<K> solved_on(const locus::Domain<K>& domain, const Multivariates<K>& f,
                                     const Solve_control& control = {})
{
  const auto make = [&](const locus::Cell_number<K>& cell) {
    Multivariates<K> g = f;
    for (auto& h : g)
      for (std::size_t v = 0; v < cell.size(); ++v) h = on_piece<K>(h, v, domain.chains[v].pieces[cell[v]]);
    return locus::Cell_system<K>{equations_of<K>(g)};
  };
  locus::Domain_point_set<K> set;
  with_upward_rounding([&] { set = locus::solve_points_on<K>(domain, make, control); });
  return set;
}

} // namespace

TEST_CASE("every solution in the plane is found once, on joints and corners of cells too", "[points][domain]")
{
  Random random(107);
  Samples samples;
  const locus::Domain<2> plane{{real_line(), real_line()}};
  std::size_t on_joints = 0;
  for (int i = 0; i < 40; ++i) {
    Place<2> p{Rational(random.between(-30, 30), 7), Rational(random.between(-30, 30), 7)};
    for (Rational& x : p) x.canonicalize();
    if (i % 2) p[static_cast<std::size_t>(i / 2 % 2)] = random.chance(50) ? 1 : -1;
    if (i % 5 == 0) p = {random.chance(50) ? 1 : -1, random.chance(50) ? 1 : -1};
    const Planted<2> system = planted<2>(p, random);
    if (!system.is_regular) continue;
    const auto set = solved_on<2>(plane, system.equations);
    bool ok = true;
    std::size_t finite = 0;
    for (const auto& q : set.points)
      finite += std::isfinite(q.at[0].inf() + q.at[0].sup() + q.at[1].inf() + q.at[1].sup());
    for (const auto& s : system.solutions) {
      const auto found = std::count_if(set.points.begin(), set.points.end(), [&](const auto& q) {
        return std::isfinite(q.at[0].inf() + q.at[0].sup() + q.at[1].inf() + q.at[1].sup()) && holds(q.at, s);
      });
      ok = ok && found == 1;
      on_joints += abs(s[0]) == 1 || abs(s[1]) == 1;
    }
    samples.expect(ok && finite == 4, [&] { return std::to_string(finite) + " finite points, planted at " + show(p); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 25);
  CHECK(on_joints > 20u);
}

TEST_CASE("roots on the whole line, infinite ones and the seam of a closed chain included", "[points][domain]")
{
  const auto at = [](const Rational& r) { return plane_through<1>({1}, {r}); };
  const locus::Domain<1> line{{real_line()}};
  const Multivariate<1> f =
    product<1>(product<1>(at(-7), at(-1)), product<1>(at(Rational(1, 3)), product<1>(at(1), at(1000))));
  const auto set = solved_on<1>(line, {f});
  CHECK(set.undecided.empty());
  REQUIRE(set.points.size() == 5u);
  const std::vector<Rational> roots{-7, -1, Rational(1, 3), 1, 1000};
  for (const Rational& r : roots) {
    const auto found =
      std::find_if(set.points.begin(), set.points.end(), [&](const auto& p) { return holds<1>(p.at, {r}); });
    REQUIRE(found != set.points.end());
    if (abs(r) == 1) CHECK(found->at[0].inf() == found->at[0].sup()); // exact on a joint
    CHECK(found->at[0].sup() - found->at[0].inf() < 1e-8);
  }
  // 0·x² + x - 2: one root is infinite, at both ends of the line.
  Multivariate<1> g = at(2);
  g[{2}] = 0;
  const auto infinite = solved_on<1>(line, {g});
  REQUIRE(infinite.points.size() == 3u);
  CHECK(infinite.points[0].at[0].sup() == -std::numeric_limits<double>::infinity());
  CHECK(infinite.points[2].at[0].inf() == std::numeric_limits<double>::infinity());
  locus::Domain<1> closed = line;
  closed.chains[0].joints.resize(3);
  CHECK(solved_on<1>(closed, {g}).points.size() == 2u);
  // A limit counts for all cells together.
  Solve_control few;
  few.max_cells = 1;
  const auto limited = solved_on<1>(line, {f}, few);
  CHECK(limited.cells <= 1u);
  CHECK(limited.undecided.size() >= 2u);
  for (const auto& part : limited.undecided) CHECK(std::string(part.details.reason) == "cell limit");
}

// --------------------------------------------------------------------------------------------------------- the pieces

TEST_CASE("dyadic intervals enclose, and with more bits more closely", "[points][number]")
{
  using locus::Dyadic_interval;
  Random random(108);
  Samples samples;
  for (int i = 0; i < 500; ++i) {
    const auto bits = static_cast<mpfr_prec_t>(64 << random.below(4));
    std::array<Rational, 3> x;
    std::array<Dyadic_interval, 3> y;
    for (std::size_t k = 0; k < 3; ++k) {
      const Integer n = random.integer(random.between(1, 200));
      const int e = random.between(-100, 100);
      x[k] = Rational(n) * two_to(-e);
      y[k] = Dyadic_interval(n, e, bits);
    }
    const Dyadic_interval sum = y[0] + y[1] * y[2], difference = y[0] - y[1] * y[2] * y[2],
                          quotient = y[0] / (y[1] * y[1] + Dyadic_interval(1));
    const Rational exact[] = {x[0] + x[1] * x[2], x[0] - x[1] * x[2] * x[2], x[0] / (x[1] * x[1] + 1)};
    std::size_t k = 0;
    bool ok = true;
    for (const Dyadic_interval* z : {&sum, &difference, &quotient}) {
      const Interval d = z->enclosing_interval(-40);
      const Rational scaled = exact[k++] * two_to(-40);
      ok = ok && exact_rational(d.inf()) <= scaled && scaled <= exact_rational(d.sup());
      const Sign s = sign_of(*z);
      ok = ok && (s == Sign::unknown || s == locus::sign_of(scaled));
    }
    samples.expect(ok, [&] { return show(x); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 500);
  // 2^200 + 1 - 2^200, which doubles lose.
  const Integer large = Integer(1) << 200;
  const Dyadic_interval lost = Dyadic_interval(Integer(large + 1), 0, 106) - Dyadic_interval(large, 0, 106),
                        kept = Dyadic_interval(Integer(large + 1), 0, 212) - Dyadic_interval(large, 0, 212);
  CHECK(sign_of(lost) != Sign::negative);
  CHECK(!locus::is_strict(sign_of(lost)));
  CHECK(sign_of(kept) == Sign::positive);
  CHECK(kept.enclosing_interval().inf() == 1.0);
  CHECK(kept.enclosing_interval().sup() == 1.0);
  CHECK(thrown<std::domain_error>([&] { (void)(kept / lost); }) == 1);
}

TEST_CASE("the hull of the control polygon leaves no zero out", "[points][hull]")
{
  Random random(109);
  Samples samples;
  std::size_t shrunk = 0, none = 0;
  for (int i = 0; i < 400; ++i) {
    const int n = random.between(1, 6);
    std::vector<Rational> roots;
    for (int k = random.below(3); k > 0; --k) roots.push_back(random.unit_rational());
    Polynomial f = with_roots(roots, random.chance(50) ? 3 : -2);
    f = times(f, {Rational(random.between(11, 20)), Rational(random.between(-10, 10))}); // no further zero
    const auto b = bernstein_on_unit(f, static_cast<int>(f.size()) - 1 + n);
    with_upward_rounding([&] {
      const auto form =
        locus::bounded(locus::converted<Interval>(b, [](const Rational& c) { return locus::enclosing(c); }));
      const auto range = locus::zero_range(form, 0);
      bool ok = roots.empty() || range.has_value();
      for (const Rational& r : roots) ok = ok && exact_rational(range->lo) <= r && r <= exact_rational(range->hi);
      samples.expect(ok, [&] { return show(roots); });
      none += !range;
      shrunk += range && range->width() < 0.5;
    });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  CHECK(shrunk > 50u);
  CHECK(none > 50u);
}

TEST_CASE("a node of a curve is proved to be the only turning point around it", "[points][double]")
{
  // (x-a)² - 2(y-b)² + (x-a)³, with its derivative by x.
  const Rational a(1, 3), b(2, 5);
  const auto x = plane_through<2>({1, 0}, {a, 0}), y = plane_through<2>({0, 1}, {0, b});
  const auto f =
    added<2>(added<2>(product<2>(x, x), Rational(-2), product<2>(y, y)), Rational(1), product<2>(x, product<2>(x, x)));
  const auto slope_x = added<2>(added<2>({}, Rational(2), x), Rational(3), product<2>(x, x));
  const auto node = solved<2>({x, y});
  REQUIRE(node.points.size() == 1u);
  with_upward_rounding([&] {
    const auto equations = equations_of<2>({f, slope_x});
    const auto box = locus::box_of_double_point(*equations[0], *equations[1], node.points[0]);
    CHECK(box.has_value());
    if (!box) return;
    CHECK(holds<2>(*box, {a, b}));
    CHECK(!holds<2>(*box, {Rational(a - Rational(2, 3)), b})); // where the derivative vanishes again
    const auto rest = locus::solve_points<2>(equations, {}, {*box});
    CHECK(rest.points.empty());
    CHECK(rest.undecided.empty());
    // The tangent of the node's branch instead of the derivative: both meet along it, more than twofold.
    const auto along =
      equations_of<2>({added<2>(product<2>(x, x), Rational(-1), product<2>(y, y)), added<2>(x, Rational(-1), y)});
    CHECK(!locus::box_of_double_point(*along[0], *along[1], node.points[0]));
  });
}
