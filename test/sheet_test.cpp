// SPDX-License-Identifier: LGPL-3.0-or-later
// Rational surfaces drawn as triangles, and meshes out: rational_sheets.h, mesh.h.

#include <locus/construct/rational_sheets.h>
#include <locus/io/mesh.h>

#include "support.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

using namespace locus;
using namespace locus_test;
using namespace locus::operators;

namespace {

using Form = Bernstein<Rational, 2>;
using Forms = std::array<Form, 4>;
using Surface = Rational_map<3, 2>;

Form number(const Rational& x) { return Form(Degrees<2>{0, 0}, {x}); }
Form u() { return Form(Degrees<2>{1, 0}, {0, 1}); }
Form v() { return Form(Degrees<2>{0, 1}, {0, 1}); }
Form times(const Form& f, const Rational& x) { return multiply(f, x); }

/// A piece at place (i, j) of the grid, on unit ranges.
Rational_map_piece<3, 2> piece(const Forms& f, int i = 0, int j = 0)
{
  std::array<Piece, 2> range;
  range[0].lo = i;
  range[0].hi = i + 1;
  range[1].lo = j;
  range[1].hi = j + 1;
  return rational_map_piece<3, 2>({f[0], f[1], f[2]}, f[3], range);
}

Surface patch(const Form& x, const Form& y, const Form& z, const Form& w) { return Surface({piece({x, y, z, w})}); }

/// Options with which a vertex's parameters are its place in the whole grid, exactly.
Sheet_options options_for(std::array<std::size_t, 2> grid, double tolerance, double cut_radius = 10)
{
  Sheet_options o;
  o.grid = grid;
  o.tolerance = tolerance;
  o.cut_radius = cut_radius;
  o.describe = [grid](std::size_t piece, double a, double b, const Approximate_point<3>&) {
    return Vertex_description{{static_cast<double>(piece / grid[1]) + a, static_cast<double>(piece % grid[1]) + b},
                              a + b};
  };
  return o;
}

std::size_t count_triangles(const Sheets& s)
{
  std::size_t n = 0;
  for (const Sheet& sheet : s.sheets) n += sheet.triangles.size();
  return n;
}

std::multiset<std::string> loops(const Sheet& s)
{
  std::multiset<std::string> kinds;
  for (const Sheet_boundary& b : s.boundary) kinds.insert(b.kind);
  return kinds;
}

// --------------------------------------------------------------------------------------------- what all must be

/// Each edge in two triangles that turn alike, or once in one loop; vertices in one fan each; one component; Euler's number.
void check_shape(const Sheet& s, Samples& samples)
{
  samples.expect(s.parameters.size() == s.points.size() && s.radius.size() == s.points.size(), "lists of one length");
  std::map<std::pair<std::size_t, std::size_t>, int> sides;
  std::vector<std::size_t> degree(s.points.size(), 0), parent(s.points.size()), ends(s.points.size(), 0);
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      samples.expect(++sides[{t[i], t[(i + 1) % 3]}] == 1, "a directed edge is in one triangle");
      samples.expect(t[i] != t[(i + 1) % 3], "a triangle has three vertices");
      ++degree[t[i]];
      parent[find(t[i])] = find(t[(i + 1) % 3]);
    }
  std::set<std::size_t> on_boundary;
  std::map<std::pair<std::size_t, std::size_t>, int> free;
  for (const Sheet_boundary& b : s.boundary)
    for (std::size_t i = 0; i < b.loop.size(); ++i) {
      samples.expect(on_boundary.insert(b.loop[i]).second, "loops are simple and apart");
      ++free[{b.loop[i], b.loop[(i + 1) % b.loop.size()]}];
    }
  std::size_t edges = 0;
  for (const auto& side : sides) {
    const bool paired = sides.count({side.first.second, side.first.first}) > 0;
    samples.expect(free.count(side.first) == (paired ? 0u : 1u), "an edge is paired or on a boundary");
    if (!paired || side.first.first < side.first.second) ++edges;
  }
  for (const auto& f : free) samples.expect(f.second == 1 && sides.count(f.first) == 1, "a loop runs along free edges");
  std::set<std::size_t> roots;
  for (std::size_t i = 0; i < parent.size(); ++i) {
    roots.insert(find(i));
    samples.expect(degree[i] > 0, "a vertex is used");
  }
  samples.expect(roots.size() == 1, "a sheet hangs together");
  samples.expect(s.euler == static_cast<int>(s.points.size() + s.triangles.size()) - static_cast<int>(edges), "euler");
}

/// Parameters of the corners of a triangle, moved into one period where the grid is closed.
struct Parameter_triangle {
  std::array<std::array<Rational, 2>, 3> at;

  Parameter_triangle(const Sheet& s, const std::array<std::size_t, 3>& t, const Sheet_options& o)
  {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        double x = s.parameters[t[i]][k];
        const auto n = static_cast<double>(o.grid[k]);
        for (std::size_t j = 0; j < 3 && o.closed[k]; ++j) { // the seam is both 0 and n
          const double other = s.parameters[t[j]][k];
          if (x == 0 && n / 2 < other && other < n) x = n;
          else if (x == n && 0 < other && other < n / 2) x = 0;
        }
        at[i][k] = Rational(x);
      }
  }

  double area() const
  {
    Rational twice = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]);
    return twice.get_d() / 2;
  }
};

/// The exact point of a surface on a grid at a place.
std::optional<Exact_point<3>> exact_image(const Surface& surface, const Sheet_options& o,
                                          const std::array<Rational, 2>& place, const std::array<Rational, 2>& inside)
{
  std::array<std::size_t, 2> at{};
  std::array<Rational, 2> local;
  for (std::size_t k = 0; k < 2; ++k) {
    at[k] = static_cast<std::size_t>(inside[k].get_d());
    local[k] = place[k] - Rational(static_cast<unsigned long>(at[k]));
  }
  return image(surface.pieces()[at[0] * o.grid[1] + at[1]], local);
}

/// Points of triangles and the surface's points of the same parameters are within the error, exactly.
void check_error(const Surface& surface, const Sheet& s, const Sheet_options& o, Samples& samples, int each,
                 std::size_t most = 600)
{
  Random random(7);
  const Rational limit = Rational(s.error) * Rational(s.error);
  const std::size_t stride = s.triangles.size() / most + 1;
  for (std::size_t i = 0; i < s.triangles.size(); i += stride) {
    const auto& t = s.triangles[i];
    const Parameter_triangle p(s, t, o);
    const std::array<Rational, 2> middle{(p.at[0][0] + p.at[1][0] + p.at[2][0]) / 3,
                                         (p.at[0][1] + p.at[1][1] + p.at[2][1]) / 3};
    for (int n = 0; n < each; ++n) {
      std::array<Rational, 3> b; // corners and middles of sides first
      if (n < 3) b[static_cast<std::size_t>(n)] = 1;
      else if (n < 6) b[static_cast<std::size_t>(n - 3)] = b[static_cast<std::size_t>(n - 2) % 3] = Rational(1, 2);
      else {
        const int x = random.between(0, 64), y = random.between(0, 64 - x);
        b = {Rational(x, 64), Rational(y, 64), Rational(64 - x - y, 64)};
        for (Rational& c : b) c.canonicalize();
      }
      std::array<Rational, 2> place;
      Exact_point<3> on_mesh;
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 2; ++k) place[k] += b[j] * p.at[j][k];
        for (std::size_t k = 0; k < 3; ++k) on_mesh[k] += b[j] * Rational(s.points[t[j]][k]);
      }
      const auto exact = exact_image(surface, o, place, middle);
      Rational square = 0;
      if (exact)
        for (std::size_t k = 0; k < 3; ++k) square += ((*exact)[k] - on_mesh[k]) * ((*exact)[k] - on_mesh[k]);
      samples.expect(exact && square <= limit, [&] {
        return "off by " + std::to_string(std::sqrt(square.get_d())) + " where " + std::to_string(s.error) +
               " is proved";
      });
    }
  }
}

/// Draws a surface and checks all that every drawing must fulfil.
Sheets drawn(const Surface& surface, const Sheet_options& o, int each = 8)
{
  Sheets result = rational_sheets(surface, o);
  Samples samples;
  for (const Sheet& s : result.sheets) {
    check_shape(s, samples);
    check_error(surface, s, o, samples, each);
    for (const auto& p : s.points) {
      const double far = std::hypot(p[0] - o.centre[0], p[1] - o.centre[1], p[2] - o.centre[2]);
      samples.expect(far <= 1.125 * o.cut_radius + s.error, "no vertex is far beyond the cut radius");
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, result.sheets.size());
  return result;
}

/// The part of the grid that the triangles cover.
double covered(const Sheets& result, const Sheet_options& o)
{
  double sum = 0;
  for (const Sheet& s : result.sheets)
    for (const auto& t : s.triangles) sum += Parameter_triangle(s, t, o).area();
  return sum;
}

/// Whether a triangle of the first piece has no point inside a box, all its corners being beyond one side.
bool is_apart(const Sheet& s, const std::array<std::size_t, 3>& t, const Box<2>& box)
{
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::all_of(t.begin(), t.end(), [&](std::size_t i) { return s.parameters[i][k] <= box.lo[k]; })) return true;
    if (std::all_of(t.begin(), t.end(), [&](std::size_t i) { return s.parameters[i][k] >= box.hi[k]; })) return true;
  }
  return false;
}

/// Every sampled point nearer than the cut radius is in a triangle or an undecided box.
void check_coverage(const Surface& surface, const Sheets& result, const Sheet_options& o, int count)
{
  Random random(11);
  Samples samples;
  std::vector<std::array<std::array<double, 2>, 3>> triangles;
  for (const Sheet& s : result.sheets)
    for (const auto& t : s.triangles) {
      triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) triangles.back()[i] = {s.parameters[t[i]][0], s.parameters[t[i]][1]};
    }
  for (int n = 0; n < count; ++n) {
    const double a = random.unit(), b = random.unit();
    const auto p = image(surface.pieces()[0], {Rational(a), Rational(b)});
    if (!p) continue;
    const double far =
      std::hypot((*p)[0].get_d() - o.centre[0], (*p)[1].get_d() - o.centre[1], (*p)[2].get_d() - o.centre[2]);
    if (far > o.cut_radius * (1 - 1e-9)) continue;
    const auto left_of = [&](const std::array<double, 2>& p0, const std::array<double, 2>& p1) {
      return (p1[0] - p0[0]) * (b - p0[1]) - (p1[1] - p0[1]) * (a - p0[0]) >= -1e-12;
    };
    bool found = false;
    for (const auto& t : triangles)
      found = found || (left_of(t[0], t[1]) && left_of(t[1], t[2]) && left_of(t[2], t[0]));
    for (const Undecided_piece& box : result.undecided)
      found = found || (box.box[0].lo <= a && a <= box.box[0].hi && box.box[1].lo <= b && b <= box.box[1].hi);
    samples.expect(found, [&] { return "nothing at " + show(a) + " " + show(b); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 1);
}

// ------------------------------------------------------------------------------------------------------- surfaces

Surface saddle()
{
  return patch(2 * u() - number(1), 2 * v() - number(1), (2 * u() - number(1)) * (2 * v() - number(1)), number(1));
}

/// x, y and w of a quarter of the unit circle in one variable, turned by so many quarters.
std::array<Form, 3> quarter(const Form& t, std::size_t turns)
{
  Form x = number(1) - t * t, y = 2 * t;
  for (std::size_t i = 0; i < turns; ++i) {
    const Form old = x;
    x = -1 * y;
    y = old;
  }
  return {x, y, number(1) + t * t};
}

Surface cylinder()
{
  std::vector<Rational_map_piece<3, 2>> pieces;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto c = quarter(u(), i);
    pieces.push_back(piece({c[0], c[1], v() * c[2], c[2]}, static_cast<int>(i)));
  }
  return Surface(pieces);
}

Surface torus()
{
  std::vector<Rational_map_piece<3, 2>> pieces;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto a = quarter(u(), i), b = quarter(v(), j);
      const Form out = 2 * b[2] + b[0];
      pieces.push_back(
        piece({a[0] * out, a[1] * out, a[2] * b[1], a[2] * b[2]}, static_cast<int>(i), static_cast<int>(j)));
    }
  return Surface(pieces);
}

/// The plane z = 0, homogeneous coordinates times a factor: where that vanishes, they are 0/0.
Rational_map_piece<3, 2> flat(int i, int j, const Form& factor)
{
  return piece({(number(i) + u()) * factor, (number(j) + v()) * factor, number(0), factor}, i, j);
}

/// Vanishes in the middle of the square only.
Form middle_point()
{
  const Form a = 2 * u() - number(1), b = 2 * v() - number(1);
  return a * a + b * b;
}

} // namespace

// ---------------------------------------------------------------------------------------------------- the shapes

TEST_CASE("a saddle is drawn within the tolerance")
{
  const Sheet_options o = options_for({1, 1}, 1e-3);
  const Sheets r = drawn(saddle(), o, 20);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.undecided.empty());
  CHECK(r.sheets[0].euler == 1);
  CHECK(loops(r.sheets[0]) == std::multiset<std::string>{"domain"});
  CHECK(r.sheets[0].error <= 1e-3);
  CHECK(r.sheets[0].error > 1e-4);
  CHECK(covered(r, o) == 1);
  CHECK(r.sheets[0].radius[0] == r.sheets[0].parameters[0][0] + r.sheets[0].parameters[0][1]);
}

TEST_CASE("a plane is two triangles and exact")
{
  const Sheets r = drawn(patch(u(), v(), u() + v(), number(1)), options_for({1, 1}, 1e-9));
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.cells == 1);
  CHECK(r.sheets[0].triangles.size() == 2);
  CHECK(r.sheets[0].error < 1e-14);
  CHECK(r.sheets[0].euler == 1);
}

TEST_CASE("a surface through infinity comes in sheets that end at the cut radius")
{
  const Form s = 4 * u() - number(2);
  const Surface hyperbola = patch(s * s, number(1), v() * s, s); // (s, 1/s, v)
  Sheet_options o = options_for({1, 1}, 1e-2);
  o.centre = Approximate_point<3>{{0.1, 0.25, 0.5}};
  const Sheets r = drawn(hyperbola, o);
  REQUIRE(r.sheets.size() == 2);
  CHECK(r.undecided.empty());
  for (const Sheet& sheet : r.sheets) {
    CHECK(sheet.euler == 1);
    CHECK(loops(sheet) == std::multiset<std::string>{"infinity"});
    CHECK(sheet.error <= 1e-2);
  }
  CHECK(r.sheets[0].points[0][0] * r.sheets[1].points[0][0] < 0);
  check_coverage(hyperbola, r, o, 400);
}

TEST_CASE("the pole may lie anywhere and be curved")
{
  const Form a = 3 * u() - number(1), b = 2 * v() - number(1);
  const Form w = a * a + b * b - number(Rational(1, 5));
  const Surface s = patch(a, b, number(1), w);
  const Sheet_options o = options_for({1, 1}, 0.02, 20);
  const Sheets r = drawn(s, o);
  CHECK(r.undecided.empty());
  REQUIRE(r.sheets.size() == 2); // inside and outside of an oval
  std::multiset<int> euler{r.sheets[0].euler, r.sheets[1].euler};
  CHECK(euler == std::multiset<int>{0, 1});
  check_coverage(s, r, o, 400);
}

TEST_CASE("a closed cylinder is one sheet with two loops")
{
  Sheet_options o = options_for({4, 1}, 1e-3);
  o.closed = {true, false};
  Sheets r = drawn(cylinder(), o, 12);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].euler == 0);
  CHECK(loops(r.sheets[0]) == std::multiset<std::string>{"domain", "domain"});
  CHECK(covered(r, o) == 4);
  // Bent in one variable only, it is split in that only.
  CHECK(count_triangles(r) < 1000);
  o.closed = {false, false};
  r = drawn(cylinder(), o);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].euler == 1);
  CHECK(loops(r.sheets[0]) == std::multiset<std::string>{"domain"});
  // A coarse one still has enough cells around.
  o.closed = {true, false};
  o.tolerance = 100;
  CHECK(drawn(cylinder(), o).sheets[0].euler == 0);
}

TEST_CASE("a torus has no boundary")
{
  Sheet_options o = options_for({4, 4}, 1e-2);
  o.closed = {true, true};
  const Sheets r = drawn(torus(), o, 6);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].euler == 0);
  CHECK(r.sheets[0].boundary.empty());
  CHECK(r.sheets[0].error <= 1e-2);
  CHECK(covered(r, o) == 16);
}

TEST_CASE("one piece that is closed has cells enough around")
{
  // A double loop through the points of a quartic: closed, its seam meeting with the same parameter.
  const Form t = 2 * u() - number(1), c = t * t * t - t;
  const Surface s = patch(c, t * t, v(), number(1));
  for (const double tolerance : {10.0, 0.1, 1e-3}) {
    Sheet_options o = options_for({1, 1}, tolerance);
    o.closed = {true, false};
    const Sheets r = drawn(s, o);
    REQUIRE(r.sheets.size() == 1);
    CHECK(r.sheets[0].euler == 0);
    CHECK(r.sheets[0].boundary.size() == 2);
  }
}

TEST_CASE("pieces are joined only where their sides are the same curve with the same parameter")
{
  const Form one = number(1), bent = number(1) + v(), other = 2 * u() - number(1) + 3 * v() * v() + number(4);
  const auto first = flat(0, 0, one);
  const auto sheets_with = [&](const Rational_map_piece<3, 2>& second) {
    const Sheet_options o = options_for({2, 1}, 1e-3);
    return drawn(Surface({first, second}), o).sheets.size();
  };
  CHECK(sheets_with(flat(1, 0, one)) == 1);
  CHECK(sheets_with(flat(1, 0, bent)) == 1);  // the weights differ by a factor
  CHECK(sheets_with(flat(1, 0, other)) == 1); // one that depends on both variables
  const Form x = number(1) + u();
  CHECK(sheets_with(piece({x, v() * v(), number(0), one}, 1)) == 2);                       // another parameter
  CHECK(sheets_with(piece({x, v(), times(v() * (one - v()), two_to(-60)), one}, 1)) == 2); // a little beside
  CHECK(sheets_with(piece({x, v(), number(two_to(-60)), one}, 1)) == 2);
  CHECK(sheets_with(piece({number(2) - u(), v(), number(0), one}, 1)) == 2); // the far side
  auto later = flat(1, 0, one);
  later.range[0].lo = Rational(3, 2);
  CHECK(sheets_with(later) == 2); // the ranges do not meet
}

TEST_CASE("pieces of different fineness fit")
{
  const Form x = number(1) + u(), wave = u() * u() * u() * (v() - number(Rational(1, 3))) * v() * v();
  const Surface s({flat(0, 0, number(1)), piece({x, v(), times(wave, 3), number(1)}, 1)});
  const Sheet_options o = options_for({2, 1}, 1e-4);
  const Sheets r = drawn(s, o);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].euler == 1);
  CHECK(r.sheets[0].boundary.size() == 1);
  CHECK(covered(r, o) == 2);
}

TEST_CASE("where cells touch in a point, it is a vertex of each")
{
  std::vector<Rational_map_piece<3, 2>> pieces;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) pieces.push_back(flat(i, j, i == j && i < 2 ? middle_point() : number(1)));
  Sheet_options o = options_for({3, 3}, 1e-3);
  o.max_depth = 0;
  const Sheets r = drawn(Surface(pieces), o);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].euler == 1); // the notch and the hole are one bay
  CHECK(r.sheets[0].points.size() == 16);
  CHECK(loops(r.sheets[0]) == std::multiset<std::string>{"undecided"});
  CHECK(r.undecided.size() == 2);
}

TEST_CASE("a point 0/0 stays undecided and is listed")
{
  const auto at = [](const Rational& a, const Rational& b) {
    const Form x = u() - number(a), y = v() - number(b); // the height depends on the direction
    return patch(u() * (x * x + y * y), v() * (x * x + y * y), x * y, x * x + y * y);
  };
  for (const bool dyadic : {true, false}) {
    const Rational a = dyadic ? Rational(1, 4) : Rational(1, 3);
    const Sheet_options o = options_for({1, 1}, 1e-2);
    const Surface s = at(a, Rational(2, 3) - a / 3 - (dyadic ? Rational(1, 12) : Rational(0)));
    const Sheets r = drawn(s, o, 7);
    REQUIRE(r.sheets.size() == 1);
    CHECK(r.sheets[0].euler == 0);
    CHECK(loops(r.sheets[0]) == std::multiset<std::string>{"domain", dyadic ? "singular" : "undecided"});
    REQUIRE(r.undecided.size() == 1);
    const auto& box = r.undecided[0].box;
    CHECK((box[0].lo <= a.get_d() && a.get_d() <= box[0].hi));
    CHECK(box[0].hi - box[0].lo < 1e-5);
    CHECK(box[1].hi - box[1].lo < 1e-5);
    CHECK(r.undecided[0].reason.find("0/0") != std::string::npos);
    check_coverage(s, r, o, 200);
  }
}

TEST_CASE("a point 0/0 in a hole leaves nothing undecided")
{
  for (const bool dyadic : {true, false}) {
    const Rational at = dyadic ? Rational(3, 8) : Rational(1, 3);
    const Form x = u() - number(at), y = v() - number(at), w = x * x + y * y;
    const Surface s = patch(u() * w, v() * w, x * y, w);
    Sheet_options o = options_for({1, 1}, 1e-2);
    Sheet_hole hole;
    hole.box.lo = {0.25, 0.25};
    hole.box.hi = {0.5, 0.5};
    o.holes.push_back(hole);
    const Sheets r = drawn(s, o, 7);
    CHECK(r.undecided.empty());
    REQUIRE(r.sheets.size() == 1);
    CHECK(r.sheets[0].euler == 0);
    CHECK(loops(r.sheets[0]) == std::multiset<std::string>{"domain", "singular"});
    CHECK(covered(r, o) == 15.0 / 16);
    Samples samples;
    for (const auto& t : r.sheets[0].triangles)
      samples.expect(is_apart(r.sheets[0], t, hole.box), "no triangle reaches into the hole");
    LOCUS_REQUIRE_SAMPLES(samples, 100);
  }
  // The hole of another piece does not count.
  std::vector<Rational_map_piece<3, 2>> pieces{flat(0, 0, number(1)), flat(1, 0, middle_point())};
  Sheet_options o = options_for({2, 1}, 1e-2);
  o.holes.push_back({0, {{0.25, 0.25}, {0.75, 0.75}}});
  CHECK(drawn(Surface(pieces), o).undecided.size() == 1);
  o.holes[0].piece = 1;
  CHECK(drawn(Surface(pieces), o).undecided.empty());
}

TEST_CASE("a line 0/0 uses up the cells, and the rest is still drawn")
{
  const Form line = u() + v() - number(Rational(2, 3));
  const Surface s = patch(u() * line, v() * line, u() * v() * line, line);
  Sheet_options o = options_for({1, 1}, 1e-2);
  o.max_cells = 20000;
  const Sheets r = drawn(s, o);
  CHECK(r.sheets.size() == 2);
  CHECK(!r.undecided.empty());
  CHECK(r.undecided.size() < 10);
  CHECK(r.cells < 20002);
  CHECK(covered(r, o) > 0.99);
}

TEST_CASE("features of the size of 2^-20 are found")
{
  const Rational size = two_to(-40);
  const Form x = u() - number(Rational(1, 3)), y = v() - number(Rational(2, 7));
  const Form w = x * x + y * y + number(size); // a needle of height 1
  const Surface s = patch(u() * w, v() * w, number(size), w);
  const Sheet_options o = options_for({1, 1}, 1e-2);
  const Sheets r = drawn(s, o);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].euler == 1);
  CHECK(r.sheets[0].error <= 1e-2);
  CHECK(r.undecided.empty());
  double top = 0;
  for (const auto& p : r.sheets[0].points) top = std::max(top, p[2]);
  CHECK(top > 0.98);
  CHECK(count_triangles(r) < 20000);
}

TEST_CASE("where the cells do not suffice, the error says so")
{
  Sheet_options o = options_for({4, 4}, 1e-4);
  o.closed = {true, true};
  o.max_cells = 20000;
  const Sheets r = drawn(torus(), o, 6);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].error > 1e-4);
  CHECK(r.sheets[0].boundary.empty());
  o.slack = 1;
  const Sheets strict = drawn(torus(), o, 6);
  CHECK(!strict.undecided.empty());
  for (const Sheet& s : strict.sheets) CHECK(s.error <= 1e-4);
  CHECK(strict.undecided[0].reason == "the limit of cells or time was reached in this box");
}

TEST_CASE("where the cells do not suffice, the error is about even")
{
  // One piece bends little, the other, apart from it, a thousand times as much.
  const Form one = number(1), x = u() + number(2);
  const Surface s(
    {piece({u(), v(), times(u() * v(), Rational(1, 100)), one}, 0), piece({x, v(), 10 * u() * v() * v(), one}, 1)});
  Sheet_options o = options_for({2, 1}, 1e-8);
  o.max_cells = 20000;
  const Sheets r = drawn(s, o, 12);
  REQUIRE(r.sheets.size() == 2);
  CHECK(r.undecided.empty());
  const double little = std::min(r.sheets[0].error, r.sheets[1].error);
  const double much = std::max(r.sheets[0].error, r.sheets[1].error);
  CHECK(little > o.tolerance);
  CHECK(much <= 5 * little); // halving a cell makes its error up to four times as small
  // No cell was wasted: as a tolerance the error takes about as many.
  o.tolerance = much * 1.01;
  const Sheets again = drawn(s, o, 12);
  CHECK(again.cells <= r.cells);
  CHECK(again.cells > r.cells / 2);
}

TEST_CASE("the work can be watched, and stopped: what there is then is a drawing like others")
{
  Sheet_options o = options_for({4, 4}, 1e-9);
  o.closed = {true, true};
  std::size_t calls = 0, last = 0;
  o.progress = [&](std::size_t done, std::size_t) {
    CHECK(done > last);
    last = done;
    ++calls;
  };
  o.checkpoint = [&] {
    if (last >= 8000) throw locus::Stopped();
  };
  const Sheets r = drawn(torus(), o, 6);
  CHECK(calls >= 7);
  CHECK(r.cells < 10000);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].error > 1e-9);
  CHECK(r.sheets[0].boundary.empty());
  o.progress = {};
  o.checkpoint = [] { throw std::runtime_error("another exception goes through"); };
  CHECK_THROWS_AS(drawn(torus(), o, 6), std::runtime_error);
}

TEST_CASE("far from the origin the rounding of the points is in the error")
{
  const Rational far = two_to(40);
  const Surface s = patch(u() + number(far), v(), u() * v(), number(1));
  Sheet_options o = options_for({1, 1}, 1e-3);
  o.centre[0] = 0x1p40;
  const Sheets r = drawn(s, o);
  REQUIRE(r.sheets.size() == 1);
  CHECK(r.sheets[0].error < 1.1e-3);
  // A third is no double, so that each vertex is rounded.
  const Sheets third = drawn(patch(times(u(), Rational(1, 3)) + number(far), v(), number(0), number(1)), o);
  CHECK(third.sheets[0].error >= 0x1p-14);
  CHECK(third.sheets[0].error < 0x1p-11);
}

TEST_CASE("infinite ranges are told as the values of the variables")
{
  Rational_map_piece<3, 2> p = piece({u(), v(), number(0), number(1)});
  p.range[0].lo = 2;
  p.range[0].hi_infinite = true;
  Sheet_options o;
  const Sheets r = rational_sheets(Surface({p}), o);
  REQUIRE(r.sheets.size() == 1);
  std::set<double> values;
  for (const auto& q : r.sheets[0].parameters) values.insert(q[0]);
  CHECK(values == std::set<double>{2, std::numeric_limits<double>::infinity()});
}

TEST_CASE("options that make no sense are refused")
{
  const auto refused = [](auto change) {
    Sheet_options o;
    change(o);
    return thrown<std::invalid_argument>([&] { rational_sheets(saddle(), o); }) == 1;
  };
  CHECK(refused([](Sheet_options& o) { o.grid = {2, 1}; }));
  CHECK(refused([](Sheet_options& o) { o.grid = {0, 1}; }));
  CHECK(refused([](Sheet_options& o) { o.max_depth = 31; }));
  CHECK(refused([](Sheet_options& o) { o.tolerance = -1; }));
  CHECK(refused([](Sheet_options& o) {
    o.closed = {true, false};
    o.max_depth = 1;
  }));
  CHECK(refused([](Sheet_options& o) { o.cut_radius = std::nan(""); }));
  CHECK(!refused([](Sheet_options& o) { o.tolerance = 1; }));
  CHECK(rational_sheets(Surface(), Sheet_options()).sheets.empty());
}

TEST_CASE("random surfaces are drawn within the error")
{
  Random random(3);
  for (int n = 0; n < 10; ++n) {
    const Degrees<2> d = random.degrees<2>(1, 3);
    Forms f;
    for (Form& g : f) {
      g = Form(d);
      for (std::size_t i = 0; i < g.size(); ++i) g[i] = Rational(random.between(-8, 8)) / 4;
    }
    const Surface s({piece(f)});
    Sheet_options o = options_for({1, 1}, 0.05, 20);
    o.max_cells = 10000;
    const Sheets r = drawn(s, o, 7);
    check_coverage(s, r, o, 60);
  }
}

// ---------------------------------------------------------------------------------------------------- the writers

namespace {

std::vector<Sheet> two_sheets()
{
  const Form s = 4 * u() - number(2);
  return rational_sheets(patch(s * s, number(1), v() * s, s), options_for({1, 1}, 0.1)).sheets;
}

std::size_t point_count(const std::vector<Sheet>& sheets)
{
  std::size_t n = 0;
  for (const Sheet& s : sheets) n += s.points.size();
  return n;
}

std::size_t triangle_count(const std::vector<Sheet>& sheets)
{
  std::size_t n = 0;
  for (const Sheet& s : sheets) n += s.triangles.size();
  return n;
}

/// Reads words up to one, which must come.
void skip_to(std::istream& in, const std::string& word)
{
  std::string w;
  while (in >> w)
    if (w == word) return;
  FAIL("no " << word);
}

/// Reads numbers and counts those that are not as wanted.
void expect_number(std::istream& in, double wanted, Samples& samples)
{
  std::string word; // streams of numbers may not read what is shortest
  in >> word;
  samples.expect(std::strtod(word.c_str(), nullptr) == wanted, [&] { return word + " is not " + show(wanted); });
}

} // namespace

TEST_CASE("PLY reads back")
{
  const auto sheets = two_sheets();
  REQUIRE(sheets.size() == 2);
  std::stringstream text;
  write_ply(text, sheets);
  std::string word;
  text >> word;
  CHECK(word == "ply");
  std::size_t n = 0;
  skip_to(text, "vertex");
  text >> n;
  CHECK(n == point_count(sheets));
  skip_to(text, "face");
  text >> n;
  CHECK(n == triangle_count(sheets));
  skip_to(text, "end_header");
  Samples samples;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < sheets[i].points.size(); ++k) {
      for (const double x : sheets[i].points[k].coordinates) expect_number(text, x, samples);
      expect_number(text, sheets[i].radius[k], samples);
      for (const double x : sheets[i].parameters[k]) expect_number(text, x, samples);
      expect_number(text, static_cast<double>(i), samples);
    }
  std::size_t first = 0;
  for (const Sheet& s : sheets) {
    for (const auto& t : s.triangles) {
      expect_number(text, 3, samples);
      for (const std::size_t k : t) expect_number(text, static_cast<double>(first + k), samples);
    }
    first += s.points.size();
  }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
  CHECK(!(text >> word));
}

TEST_CASE("OBJ reads back")
{
  const auto sheets = two_sheets();
  std::stringstream text;
  write_obj(text, sheets);
  Samples samples;
  std::string word;
  std::size_t first = 1;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    text >> word;
    CHECK(word == "o");
    text >> word;
    CHECK(word == "sheet_" + std::to_string(i));
    for (const auto& p : sheets[i].points) {
      text >> word;
      samples.expect(word == "v", "a vertex");
      for (const double x : p.coordinates) expect_number(text, x, samples);
    }
    for (const auto& t : sheets[i].triangles) {
      text >> word;
      samples.expect(word == "f", "a face");
      for (const std::size_t k : t) expect_number(text, static_cast<double>(first + k), samples);
    }
    first += sheets[i].points.size();
  }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
  CHECK(!(text >> word));
}

TEST_CASE("VTK reads back")
{
  const auto sheets = two_sheets();
  std::stringstream text;
  write_vtk(text, sheets);
  std::string line;
  std::getline(text, line);
  CHECK(line == "# vtk DataFile Version 3.0");
  Samples samples;
  const std::size_t points = point_count(sheets), triangles = triangle_count(sheets);
  skip_to(text, "POINTS");
  expect_number(text, static_cast<double>(points), samples);
  skip_to(text, "double");
  for (const Sheet& s : sheets)
    for (const auto& p : s.points)
      for (const double x : p.coordinates) expect_number(text, x, samples);
  skip_to(text, "POLYGONS");
  expect_number(text, static_cast<double>(triangles), samples);
  expect_number(text, static_cast<double>(4 * triangles), samples);
  skip_to(text, "POINT_DATA");
  expect_number(text, static_cast<double>(points), samples);
  for (const std::string name : {"radius", "sheet", "p0", "p1"}) {
    skip_to(text, name);
    skip_to(text, "default");
    for (std::size_t i = 0; i < sheets.size(); ++i)
      for (std::size_t k = 0; k < sheets[i].points.size(); ++k)
        expect_number(text,
                      name == "radius"  ? sheets[i].radius[k]
                      : name == "sheet" ? static_cast<double>(i)
                                        : sheets[i].parameters[k][name == "p0" ? 0 : 1],
                      samples);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

TEST_CASE("meshes of nothing, and files that cannot be written")
{
  std::ostringstream ply, vtk;
  write_ply(ply, {});
  CHECK(ply.str().find("element vertex 0") != std::string::npos);
  write_vtk(vtk, {});
  CHECK(vtk.str().find("POINTS 0 double") != std::string::npos);
  const std::string path = "/nowhere/at/all.ply";
  CHECK(thrown<std::runtime_error>([&] { write_ply(path, two_sheets()); }) == 1);
  CHECK(thrown<std::runtime_error>([&] { write_obj(path, two_sheets()); }) == 1);
  CHECK(thrown<std::runtime_error>([&] { write_vtk(path, two_sheets()); }) == 1);
}
