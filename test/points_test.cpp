// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/zero_set/points_2.h>

#include <catch2/catch.hpp>

#include <map>
#include <memory>

using namespace locus_test;
using locus::Box;
using locus::exact_rational;
using locus::Interval;
using locus::Point_set;
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
  CHECK(decided >= 30);
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
  const Bivariate f = line_through(p, {Rational(1), Rational(1)}), g = line_through(p, {Rational(0), Rational(1)});
  Solve_control few;
  few.max_cells = 2;
  Solve_control cancelled;
  cancelled.cancel = std::make_shared<std::atomic<bool>>(true);
  for (const Solve_control& control : {few, cancelled}) {
    const Point_set set = solve(f, g, control);
    CHECK(set.points.empty());
    std::size_t covered = 0;
    for (const auto& box : set.undecided) covered += contains(box, p);
    CHECK(covered >= 1u);
  }
  CHECK(solve(f, g).points.size() == 1u);
}
