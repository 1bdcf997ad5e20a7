// SPDX-License-Identifier: LGPL-3.0-or-later

// Bisectors against CGAL's exact analysis of algebraic curves. Algebraic_kernel_d_2 takes some twenty seconds to
// compile: it appears in this file alone, behind the plain functions of the first part.

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
#include <CGAL/Algebraic_kernel_d_2.h>
#include <CGAL/CORE_arithmetic_kernel.h>

#include "pair_support.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <iostream>

using namespace locus_test;

namespace {

/// Coefficient of x^i y^j at [i][j].
using Bivariate = std::vector<std::vector<Rational>>;

/// What the exact analysis says of a curve F(x, y) = 0 in the unit square.
struct Reference {
  std::size_t nodes = 0;      ///< points inside with F = F_x = F_y = 0
  std::size_t turns_x = 0;    ///< regular points inside with F_y = 0: x is extreme
  std::size_t turns_y = 0;    ///< with F_x = 0
  std::array<std::size_t, 4> on_side{}; ///< distinct zeros on x = 0, x = 1, y = 0, y = 1, ends included
  std::size_t components = 0;
  bool clear = true; ///< no critical point near a side, no critical point of higher order
};

// ------------------------------------------------------------------------------------------------- the exact kernel

namespace kernel {

using Integer_type = CGAL::CORE_arithmetic_kernel::Integer;
using Kernel = CGAL::Algebraic_kernel_d_2<Integer_type>;
using Polynomial_1 = Kernel::Polynomial_1;
using Polynomial_2 = Kernel::Polynomial_2;
using Curve = Kernel::Curve_analysis_2;
using Bound = Kernel::Bound;

Polynomial_1 make(const std::vector<Integer>& c)
{
  std::vector<Integer_type> values;
  for (const Integer& x : c) values.emplace_back(x.get_str());
  if (values.empty()) values.emplace_back(0);
  return Polynomial_1(values.begin(), values.end());
}

Polynomial_2 make(const Bivariate& f)
{
  Integer denominator = 1;
  std::size_t rows = f.size(), columns = 0;
  for (const auto& row : f) {
    columns = std::max(columns, row.size());
    for (const Rational& c : row) denominator = lcm(denominator, c.get_den());
  }
  std::vector<Polynomial_1> by_y;
  for (std::size_t j = 0; j < columns; ++j) {
    std::vector<Integer> c;
    for (std::size_t i = 0; i < rows; ++i) c.push_back(j < f[i].size() ? Integer(f[i][j].get_num() * Integer(denominator / f[i][j].get_den())) : Integer(0));
    while (c.size() > 1 && c.back() == 0) c.pop_back();
    by_y.push_back(make(c));
  }
  return Polynomial_2(by_y.begin(), by_y.end());
}

/// Distinct zeros in [0, 1], by Algebraic_kernel_d_1.
std::size_t zeros_on_unit_interval(const Polynomial_1& f)
{
  using Kernel_1 = CGAL::Algebraic_kernel_d_1<Integer_type>;
  std::vector<std::pair<Kernel_1::Algebraic_real_1, int>> roots;
  Kernel_1 k;
  k.solve_1_object()(f, std::back_inserter(roots));
  std::size_t n = 0;
  for (const auto& [root, multiplicity] : roots) n += root >= Bound(0) && root <= Bound(1);
  return n;
}

double near(const std::pair<Bound, Bound>& range) { return CGAL::to_double((range.first + range.second) / 2); }

/// Counts the common points of F and one derivative inside the square, split into nodes and turning points.
void count_critical(const Kernel& k, const Polynomial_2& f, const Polynomial_2& by, const Polynomial_2& other, std::size_t& nodes, std::size_t& turns, bool& clear)
{
  std::vector<std::pair<Kernel::Algebraic_real_2, int>> points;
  if (CGAL::total_degree(by) == 0) return;
  k.solve_2_object()(f, by, std::back_inserter(points));
  for (const auto& [p, multiplicity] : points) {
    const double x = near(k.approximate_absolute_x_2_object()(p, 40)), y = near(k.approximate_absolute_y_2_object()(p, 40));
    constexpr double margin = 1e-6;
    const bool inside = x > margin && x < 1 - margin && y > margin && y < 1 - margin;
    const bool outside = x < -margin || x > 1 + margin || y < -margin || y > 1 + margin;
    if (!inside && !outside) clear = false;
    if (!inside) continue;
    if (k.sign_at_2_object()(other, p) == CGAL::ZERO) {
      ++nodes;
    } else {
      ++turns;
      clear = clear && multiplicity == 1;
    }
  }
}

/// Connected components of F = 0 in the unit square: a sweep over the arcs of F·y·(y-1), of which those between the lines
/// y = 0 and y = 1 count, joined where they meet on a status line.
std::size_t components(const Kernel& k, const Polynomial_2& f)
{
  const Polynomial_2 y(Polynomial_1(Integer_type(0)), Polynomial_1(Integer_type(1))), y1(Polynomial_1(Integer_type(-1)), Polynomial_1(Integer_type(1)));
  const Polynomial_2 all = f * y * y1;
  const Curve curve = k.construct_curve_2_object()(all);
  const int events = curve.number_of_status_lines_with_event();
  // Arcs over interval i (between events i-1 and i) are numbered from below; the two lines are among them.
  std::vector<std::pair<std::size_t, std::size_t>> lines; // numbers of y = 0 and y = 1 over each interval
  std::vector<std::size_t> first;                        // running number of the first arc over each interval
  std::size_t total = 0;
  for (int i = 0; i <= events; ++i) {
    const auto status = curve.status_line_of_interval(i);
    std::pair<std::size_t, std::size_t> here{0, 0};
    for (int j = 0; j < status.number_of_events(); ++j) {
      const auto point = status.algebraic_real_2(j);
      // Exact: on the line y = c the polynomial y - c vanishes.
      if (k.sign_at_2_object()(y, point) == CGAL::ZERO) here.first = static_cast<std::size_t>(j);
      if (k.sign_at_2_object()(y1, point) == CGAL::ZERO) here.second = static_cast<std::size_t>(j);
    }
    lines.push_back(here);
    first.push_back(total);
    total += static_cast<std::size_t>(status.number_of_events());
  }
  std::vector<std::size_t> parent(total);
  for (std::size_t i = 0; i < total; ++i) parent[i] = i;
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<char> used(total, 0);
  std::size_t isolated = 0;
  const auto inside = [&](int interval, std::size_t j) {
    const auto& l = lines[static_cast<std::size_t>(interval)];
    return l.first < j && j < l.second;
  };
  const Bound zero(0), one(1);
  // Intervals that reach into (0, 1).
  for (int i = 0; i <= events; ++i) {
    const bool starts_before_one = i == 0 || curve.status_line_at_event(i - 1).x() < one;
    const bool ends_after_zero = i == events || curve.status_line_at_event(i).x() > zero;
    if (!starts_before_one || !ends_after_zero) continue;
    const auto n = static_cast<std::size_t>(curve.status_line_of_interval(i).number_of_events());
    for (std::size_t j = 0; j < n; ++j)
      if (inside(i, j)) used[first[static_cast<std::size_t>(i)] + j] = 1;
  }
  for (int e = 0; e < events; ++e) {
    const auto status = curve.status_line_at_event(e);
    if (status.x() < zero || status.x() > one) continue;
    const bool at_zero = status.x() == zero, at_one = status.x() == one;
    const auto from_below = status.number_of_branches_approaching_minus_infinity(); // along a vertical asymptote
    auto left = static_cast<std::size_t>(from_below.first), right = static_cast<std::size_t>(from_below.second);
    for (int j = 0; j < status.number_of_events(); ++j) {
      const auto [l, r] = status.number_of_incident_branches(j);
      std::vector<std::size_t> meeting;
      for (std::size_t a = left; a < left + static_cast<std::size_t>(l); ++a)
        if (inside(e, a) && !at_zero) meeting.push_back(first[static_cast<std::size_t>(e)] + a);
      for (std::size_t a = right; a < right + static_cast<std::size_t>(r); ++a)
        if (inside(e + 1, a) && !at_one) meeting.push_back(first[static_cast<std::size_t>(e) + 1] + a);
      // Is the point itself in the square? It is unless it lies below y = 0 or above y = 1.
      const auto point = status.algebraic_real_2(j);
      const bool between = k.sign_at_2_object()(y, point) != CGAL::NEGATIVE && k.sign_at_2_object()(y1, point) != CGAL::POSITIVE;
      left += static_cast<std::size_t>(l);
      right += static_cast<std::size_t>(r);
      if (meeting.empty()) { // nothing of F ends here inside: a point of F alone, or of the lines only
        isolated += between && k.sign_at_2_object()(f, point) == CGAL::ZERO;
        continue;
      }
      for (const std::size_t m : meeting) parent[find(m)] = find(meeting[0]);
    }
  }
  std::size_t count = isolated;
  for (std::size_t i = 0; i < total; ++i) count += used[i] && find(i) == i;
  return count;
}

} // namespace kernel

/// A line x = at without critical points, and how many zeros F has on it for y in [0, 1].
struct Line {
  double at = 0;
  std::size_t zeros = 0;
};

bool is_square_free(const Bivariate& f)
{
  const kernel::Kernel k;
  return k.is_square_free_2_object()(kernel::make(f));
}

/// Lines between neighbouring critical values of x in [0, 1] (also where F meets the sides y = 0 and y = 1), where those are
/// not too close for points in double.
std::vector<Line> lines_across(const Bivariate& f)
{
  const kernel::Kernel k;
  const Bivariate sides{{Rational(0), Rational(-1), Rational(1)}};
  const kernel::Curve curve = k.construct_curve_2_object()(kernel::make(f) * kernel::make(sides));
  std::vector<double> cuts{0};
  for (int i = 0; i < curve.number_of_status_lines_with_event(); ++i) {
    const double x = CGAL::to_double(curve.status_line_at_event(i).x());
    if (x > 0 && x < 1) cuts.push_back(x);
  }
  cuts.push_back(1);
  std::vector<Line> lines;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] < 0x1p-6) continue;
    const double at = std::ldexp(std::round(std::ldexp(0.5 * (cuts[i] + cuts[i + 1]), 20)), -20);
    Polynomial on_line;
    for (std::size_t n = f.size(); n-- > 0;) on_line = plus(times(on_line, {Rational(at)}), f[n]);
    lines.push_back({at, kernel::zeros_on_unit_interval(kernel::make(with_integers(trimmed(on_line))))});
  }
  return lines;
}

Reference analyse(const Bivariate& f)
{
  const kernel::Kernel k;
  const kernel::Polynomial_2 form = kernel::make(f), by_x = CGAL::differentiate(form, 0), by_y = CGAL::differentiate(form, 1);
  Reference r;
  std::size_t nodes_again = 0;
  kernel::count_critical(k, form, by_y, by_x, r.nodes, r.turns_x, r.clear);
  kernel::count_critical(k, form, by_x, by_y, nodes_again, r.turns_y, r.clear);
  r.clear = r.clear && nodes_again == r.nodes;
  const auto side = [&](int variable, int at) {
    std::vector<Rational> c;
    std::size_t columns = 0;
    for (const auto& row : f) columns = std::max(columns, row.size());
    c.assign(variable == 0 ? columns : f.size(), Rational(0));
    for (std::size_t i = 0; i < f.size(); ++i)
      for (std::size_t j = 0; j < f[i].size(); ++j)
        if (at == 1 || (variable == 0 ? i : j) == 0) c[variable == 0 ? j : i] += f[i][j];
    return kernel::zeros_on_unit_interval(kernel::make(with_integers(trimmed(c))));
  };
  for (int v = 0; v < 2; ++v)
    for (int at = 0; at < 2; ++at) r.on_side[static_cast<std::size_t>(2 * v + at)] = side(v, at);
  r.components = kernel::components(k, form);
  return r;
}

// ------------------------------------------------------------------------------------------------ F3 in monomials

Bivariate outer(const Polynomial& f, const Polynomial& g)
{
  Bivariate p(std::max<std::size_t>(1, f.size()), std::vector<Rational>(std::max<std::size_t>(1, g.size()), Rational(0)));
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) p[i][j] = f[i] * g[j];
  return p;
}

Bivariate add(Bivariate a, const Bivariate& b, int sign)
{
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) {
    a[i].resize(std::max(a[i].size(), b[i].size()), Rational(0));
    for (std::size_t j = 0; j < b[i].size(); ++j) a[i][j] += sign * b[i][j];
  }
  return a;
}

Bivariate multiply(const Bivariate& a, const Bivariate& b)
{
  std::size_t m = 0, n = 0;
  for (const auto& row : a) m = std::max(m, row.size());
  for (const auto& row : b) n = std::max(n, row.size());
  Bivariate p(a.size() + b.size() - 1, std::vector<Rational>(m + n - 1, Rational(0)));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t l = 0; l < b[k].size(); ++l) p[i + k][j + l] += a[i][j] * b[k][l];
  return p;
}

/// -Im(e² ā b̄) by its definition, without the library.
Bivariate f3(const Control_curve& first, const Control_curve& second)
{
  const Plain_curve a = Plain_curve(first).with_primitive_tangent(), b = Plain_curve(second).with_primitive_tangent();
  const Bivariate er = add(outer(a.x, b.w), outer(a.w, b.x), -1), ei = add(outer(a.y, b.w), outer(a.w, b.y), -1);
  const Bivariate square_re = add(multiply(er, er), multiply(ei, ei), -1), square_im = add(multiply(er, ei), multiply(er, ei), 1);
  // ā b̄ = (ax bx - ay by) - i (ax by + ay bx)
  const Bivariate re = add(outer(a.ax, b.ax), outer(a.ay, b.ay), -1), im = add(outer(a.ax, b.ay), outer(a.ay, b.ax), 1);
  return add(multiply(square_re, im), multiply(square_im, re), -1);
}

Bivariate transposed(const Bivariate& f)
{
  Bivariate g;
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < f[i].size(); ++j) {
      if (g.size() <= j) g.resize(j + 1);
      g[j].resize(f.size(), Rational(0));
      g[j][i] = f[i][j];
    }
  return g;
}

/// Without the factor that depends on y alone.
Bivariate without_content(Bivariate f)
{
  Polynomial common;
  for (const auto& row : f) common = euclid(common, trimmed(row));
  if (common.size() < 2) return f;
  for (auto& row : f)
    if (const Polynomial p = trimmed(row); !p.empty()) row = quotient(p, common);
  return f;
}

/// Without factors of one variable: the kernel takes none, and those with zeros in the square are degenerate components.
Bivariate primitive(const Bivariate& f) { return transposed(without_content(transposed(without_content(f)))); }

struct Case {
  std::string name;
  Control_curve first, second;
};

std::vector<Case> cases()
{
  std::vector<Case> all{
    {"line_quad", curve_of({{"-1", "1"}, {"0", "0"}, {"1", "1"}}), curve_of({{"-1", "-0.25"}, {"1", "-0.75"}})},
    {"quad_quad", curve_of({{"-1", "0.75"}, {"0", "0.25"}, {"1", "1"}}), curve_of({{"-1", "-1"}, {"0.25", "-0.125"}, {"1", "-0.5"}})},
    {"cubic_cubic", curve_of({{"0", "0"}, {"1", "2"}, {"2", "-1"}, {"3", "1"}}), curve_of({{"0", "3"}, {"1", "2.5"}, {"2", "4"}, {"3", "3"}})},
    {"lines", curve_of({{"-1", "0"}, {"1", "0"}}), curve_of({{"0", "-2"}, {"1/2", "1"}})},
    {"line through a parabola", curve_of({{"-1", "1"}, {"0", "-1"}, {"1", "1"}}), curve_of({{"-2", "1/3"}, {"2", "1/2"}})},
    {"parabolas that cross in four points", curve_of({{"-2", "3"}, {"0", "-4"}, {"2", "2"}}), curve_of({{"3", "-2"}, {"-4", "1/4"}, {"3", "2"}})},
    {"bitangent", curve_of({{"-2", "1"}, {"-1", "-1"}, {"0", "1"}}), curve_of({{"1", "2"}, {"2", "-1"}, {"3", "2"}})},
    {"rational", curve_of({{"2", "0"}, {"2", "1"}, {"0", "1"}}, {"1", "1", "2"}), curve_of({{"-1", "-1"}, {"0", "3"}, {"1", "-2"}}, {"1", "3", "2"})}};
  Random random(501);
  while (all.size() < 20) {
    const int n = random.between(1, 3), m = n == 3 ? 1 : random.between(1, 2);
    all.push_back({"random", random_curve(random, n, Coordinates::grid, false), random_curve(random, m, Coordinates::dyadic, false)});
  }
  return all;
}

} // namespace

TEST_CASE("the exact analysis itself, on curves with known answers", "[algebraic_kernel]")
{
  // (x-1/2)² + (y-1/2)² - 1/9, alone and with lines.
  const Bivariate circle{{Rational(1, 2) - Rational(1, 9), Rational(-1), Rational(1)}, {Rational(-1)}, {Rational(1)}};
  const Bivariate diagonal{{Rational(0), Rational(-1)}, {Rational(1)}}, high{{Rational(-9, 10), Rational(1)}, {Rational(1, 100)}};
  CHECK(analyse(circle).components == 1u);
  CHECK(analyse(circle).turns_x == 2u);
  CHECK(analyse(circle).turns_y == 2u);
  CHECK(analyse(multiply(circle, diagonal)).components == 1u);
  CHECK(analyse(multiply(circle, diagonal)).nodes == 2u);
  CHECK(analyse(multiply(circle, high)).components == 2u);
  CHECK(analyse(multiply(circle, high)).nodes == 0u);
  // y = 8 (x-1/5)(x-1/2)(x-4/5) + 1/20 dips below y = 0: two arcs.
  Bivariate cubic{{Rational(0), Rational(-1)}};
  const Polynomial f = plus(with_roots({Rational(1, 5), Rational(1, 2), Rational(4, 5)}, Rational(8)), {Rational(1, 20)});
  cubic = add(cubic, outer(f, {Rational(1)}), 1);
  const Reference c = analyse(cubic);
  CHECK(c.components == 2u);
  CHECK(c.on_side == std::array<std::size_t, 4>{0, 1, 3, 0});
}

namespace {

/// The vertices of a bisector and the turning points of its arcs against the exact analysis of F3; false where the latter
/// could not all be found.
bool check_points(const locus::Locus<2>& l, const Reference& r, const Control_curve& first, const Control_curve& second)
{
  CHECK(l.components() == r.components);
  std::size_t nodes = 0;
  std::array<std::size_t, 4> on_side{};
  for (const auto& v : l.vertices()) {
    const auto& t = v.feet[0].parameters[0];
    const auto& s = v.feet[1].parameters[0];
    nodes += v.kind == locus::Vertex_kind::node && t.lo > 0 && t.hi < 1 && s.lo > 0 && s.hi < 1;
    on_side[0] += t.hi == 0;
    on_side[1] += t.lo == 1;
    on_side[2] += s.hi == 0;
    on_side[3] += s.lo == 1;
  }
  CHECK(nodes == r.nodes);
  CHECK(on_side == r.on_side);
  const Real_pair reals(first, second);
  std::size_t turns_t = 0, turns_r = 0;
  bool complete = true;
  for (const auto& arc : l.arcs()) {
    const auto irregular = arc.irregular();
    complete = complete && irregular.complete;
    for (const auto& q : irregular.points) {
      const auto at = reals.f3(q.parameter(0), q.parameter(1));
      ++(std::abs(at.by_r) < std::abs(at.by_t) ? turns_t : turns_r);
    }
  }
  if (!complete) return false; // beside points where branches touch
  CHECK(turns_t == r.turns_x);
  CHECK(turns_r == r.turns_y);
  return true;
}

/// Whether both tangent lines are one at a pair of ends: F3 is zero there, perhaps nowhere else near, but the bisector has no
/// point there.
bool has_infinite_corner(const Control_curve& first, const Control_curve& second)
{
  const Plain_curve a = Plain_curve(first).with_primitive_tangent(), b = Plain_curve(second).with_primitive_tangent();
  const auto cross = [](const Exact_complex& p, const Exact_complex& q) { return Rational(p.re * q.im - p.im * q.re); };
  for (const int t : {0, 1})
    for (const int r : {0, 1}) {
      const Plain_values v = plain_values(a, b, t, r);
      if (cross(v.a, v.b) == 0 && cross(v.e, v.a) == 0) return true;
    }
  return false;
}

} // namespace

TEST_CASE("bisectors of small pairs agree with CGAL's exact analysis of F3", "[algebraic_kernel]")
{
  std::size_t compared = 0, with_nodes = 0, with_turns = 0;
  for (const Case& c : cases()) {
    std::optional<locus::Locus<2>> solved;
    try {
      solved.emplace(locus::untrimmed_bisector(c.first.build(), c.second.build()));
    } catch (const locus::Unsupported_feature&) {
      continue;
    }
    const locus::Locus<2>& l = *solved;
    INFO(c.name << ": " << show(graph_numbers(l)) << " " << reasons(l) << "; " << show(c.first, c.second));
    if (l.status() != locus::Status::certified || !l.degenerate().empty() || l.equations().size() > 1) continue;
    const Bivariate f = f3(c.first, c.second);
    const Reference r = analyse(f);
    if (!r.clear) continue;
    ++compared;
    CHECK(check_points(l, r, c.first, c.second));
    with_nodes += r.nodes > 0;
    with_turns += r.turns_x + r.turns_y > 0;
  }
  CHECK(compared >= 13u);
  CHECK(with_nodes >= 3u);
  CHECK(with_turns >= 5u);
}

namespace {

/// Degree of F3 in the parameter of a curve: twice its degree and that of its tangent.
int degree_in_f3(const Control_curve& c)
{
  return 2 * c.degree() + (c.weights.empty() ? c.degree() - 1 : 2 * c.degree() - 2);
}

/// The kernel's time grows fast with the degrees.
bool is_affordable(const Curve_pair& p, int most) { return degree_in_f3(p.first) * degree_in_f3(p.second) <= most; }

/// What became of random pairs.
struct Agreement {
  std::size_t compared = 0, in_full = 0, without_turns = 0, lines = 0, refused = 0, degenerate = 0, undecided = 0;
  double kernel_seconds = 0, slowest = 0;

  std::string text() const
  {
    std::ostringstream out;
    out << compared << " pairs compared (" << in_full << " in all points, " << without_turns << " but for turning points), " << lines
        << " lines; left out: " << refused << " refused, " << degenerate << " degenerate, " << undecided
        << " undecided; the kernel took " << kernel_seconds << " s, " << slowest << " s at most";
    return out.str();
  }
};

/// Zeros of F3 on lines across, between the kernel's critical ones, against the arcs that cross them.
void check_lines(Agreement& agreement, const locus::Locus<2>& l, const std::vector<Line>& lines)
{
  for (const Line& line : lines) {
    INFO("t = " << line.at);
    CHECK(crossings(l, 0, line.at, {0, 0}, false, 400) == line.zeros);
    ++agreement.lines;
  }
}

void compare(Agreement& agreement, const Curve_pair& pair)
{
  const locus::Curve_2 first = built(pair.first), second = built(pair.second);
  const auto l = locus::untrimmed_bisector(first, second, limited());
  if (!is_certified(l)) {
    ++agreement.undecided;
    return;
  }
  const Bivariate f = primitive(f3(pair.first, pair.second));
  if (!l.degenerate().empty() || !is_square_free(f)) {
    ++agreement.degenerate;
    return;
  }
  INFO(show(graph_numbers(l)));
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Line> lines = lines_across(f);
  const Reference r = analyse(f);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  agreement.kernel_seconds += seconds;
  agreement.slowest = std::max(agreement.slowest, seconds);
  ++agreement.compared;
  check_lines(agreement, l, lines);
  if (!r.clear || first.pieces().size() != 1 || second.pieces().size() != 1 || l.equations().size() > 1) return;
  if (has_infinite_corner(pair.first, pair.second)) return;
  const bool has_turns = check_points(l, r, pair.first, pair.second);
  ++(has_turns ? agreement.in_full : agreement.without_turns);
}

} // namespace

// As many pairs as LOCUS_RANDOM_PAIRS says, but at most 200: the kernel takes seconds for many.
TEST_CASE("bisectors of random pairs agree with CGAL's exact analysis of F3", "[algebraic_kernel]")
{
  constexpr std::size_t share = 15;
  const std::size_t wanted = std::min<std::size_t>(200, pairs_to_run(share));
  const int most = wanted > share ? 88 : 40;
  Agreement agreement;
  for (std::size_t number = 0; agreement.compared < wanted; ++number) {
    const Curve_pair pair = random_pair(number, {number % 8 < 7 ? 3 : 4, 2});
    if (!is_affordable(pair, most)) continue;
    INFO("LOCUS_TEST_SEED=" << run_seed() << ", " << show(pair, number));
    try {
      compare(agreement, pair);
    } catch (const locus::Unsupported_feature&) {
      ++agreement.refused;
    }
    if (wanted > share)
      std::cerr << number << " (" << degree_in_f3(pair.first) << ", " << degree_in_f3(pair.second) << "): " << agreement.text() << std::endl;
  }
  std::cerr << agreement.text() << std::endl;
  CHECK(agreement.in_full * 4 >= agreement.compared);
  CHECK(agreement.lines >= agreement.compared);
  CHECK(agreement.undecided * 20 <= agreement.compared);
}
