// SPDX-License-Identifier: LGPL-3.0-or-later
// All real solutions in the plane of two equations: locus::solve_points_on, certified, and CGAL's Algebraic_kernel_d_2,
// in turns in one run. Returns 1 where the two disagree, or where the ratio of their times is below the aim.
//
// The systems are R = S = 0 of Farouki & Johnstone 1994, (79)–(80), for the self-intersections of a point/curve bisector,
// and F3 = ∂F3/∂t = 0 for the turning points and nodes of the bisector of two curves.
// R and S meet threefold on u = v where R(u,u) = 0, as R - S is divisible by (v-u)³: the quotient D takes the place of S,
// and the roots of R(u,u) are found as such. The peer solves {R, S} and {R, D}.
// At a node of F3 = 0, where the curves meet, F3 and its derivative meet twofold: it is found as a solution of e = 0, and
// proved to be the only solution in a box around it.
#ifndef CGAL_USE_GMP
#define CGAL_USE_GMP 1
#endif
#ifndef CGAL_USE_MPFR
#define CGAL_USE_MPFR 1
#endif
#ifndef CGAL_USE_CORE
#define CGAL_USE_CORE 1
#endif

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuse-after-free" // gcc 12 sees one in CGAL's reference counting
#endif
#include <CGAL/Algebraic_kernel_d_2.h>
#include <CGAL/CORE_arithmetic_kernel.h>

#include "cases.h"
#include "side_by_side.h"

#include <locus/zero_set/algebraic_number.h>
#include <locus/zero_set/domain_points.h>
#include <locus/zero_set/double_points.h>
#include <locus/zero_set/real_roots.h>

#include <cstdio>
#include <string>

namespace {

using locus::Bernstein;
using locus::Degrees;
using locus::Equations;
using locus::Integer;
using locus::Integer_polynomial;
using locus::Rational;

constexpr double aim = 20;

// ---------------------------------------------------------------------------------------- polynomials in two variables

/// Coefficient of u^i v^j at [i][j]; rows of equal length.
using Plane_polynomial = std::vector<std::vector<Rational>>;
using Line_polynomial = std::vector<Rational>;

std::size_t rows(const Plane_polynomial& f) { return f.size(); }
std::size_t columns(const Plane_polynomial& f) { return f[0].size(); }

Plane_polynomial zero(std::size_t n, std::size_t m)
{
  return Plane_polynomial(n, std::vector<Rational>(m, Rational(0)));
}

Plane_polynomial in_u(const Line_polynomial& f)
{
  Plane_polynomial g = zero(f.size(), 1);
  for (std::size_t i = 0; i < f.size(); ++i) g[i][0] = f[i];
  return g;
}
Plane_polynomial in_v(const Line_polynomial& f) { return {f}; }

/// a + factor·b.
Plane_polynomial sum(const Plane_polynomial& a, const Plane_polynomial& b, int factor = 1)
{
  Plane_polynomial s = zero(std::max(rows(a), rows(b)), std::max(columns(a), columns(b)));
  for (std::size_t i = 0; i < rows(a); ++i)
    for (std::size_t j = 0; j < columns(a); ++j) s[i][j] += a[i][j];
  for (std::size_t i = 0; i < rows(b); ++i)
    for (std::size_t j = 0; j < columns(b); ++j) s[i][j] += factor * b[i][j];
  return s;
}

Plane_polynomial operator*(const Plane_polynomial& a, const Plane_polynomial& b)
{
  Plane_polynomial p = zero(rows(a) + rows(b) - 1, columns(a) + columns(b) - 1);
  for (std::size_t i = 0; i < rows(a); ++i)
    for (std::size_t j = 0; j < columns(a); ++j)
      for (std::size_t k = 0; k < rows(b); ++k)
        for (std::size_t l = 0; l < columns(b); ++l) p[i + k][j + l] += a[i][j] * b[k][l];
  return p;
}

Line_polynomial times(const Line_polynomial& a, const Line_polynomial& b) { return (in_v(a) * in_v(b))[0]; }
Line_polynomial plus(const Line_polynomial& a, const Line_polynomial& b, int factor = 1)
{
  return sum(in_v(a), in_v(b), factor)[0];
}
Line_polynomial slope(const Line_polynomial& f)
{
  Line_polynomial d;
  for (std::size_t i = 1; i < f.size(); ++i) d.push_back(Rational(f[i] * static_cast<unsigned long>(i)));
  if (d.empty()) d.emplace_back(0);
  return d;
}

Plane_polynomial slope_in_u(const Plane_polynomial& f)
{
  Plane_polynomial d(f.begin() + 1, f.end());
  for (std::size_t i = 0; i < d.size(); ++i)
    for (Rational& c : d[i]) c *= static_cast<unsigned long>(i) + 1;
  return d;
}

/// Without outer coefficients that are all zero.
Plane_polynomial trimmed(Plane_polynomial f)
{
  const auto is_zero = [](const Rational& c) { return c == 0; };
  while (f.size() > 1 && std::all_of(f.back().begin(), f.back().end(), is_zero)) f.pop_back();
  while (columns(f) > 1 && std::all_of(f.begin(), f.end(), [&](const auto& row) { return is_zero(row.back()); }))
    for (auto& row : f) row.pop_back();
  return f;
}

/// f/(v-u), or an empty polynomial if there is a remainder.
Plane_polynomial divided_by_diagonal(const Plane_polynomial& f)
{
  Plane_polynomial q = zero(rows(f) + columns(f), columns(f)); // column j holds the factor of v^(j-1)
  for (std::size_t j = columns(f); j-- > 0;)
    for (std::size_t i = 0; i < rows(q); ++i) {
      if (i < rows(f)) q[i][j] += f[i][j];
      if (i > 0 && j + 1 < columns(f)) q[i][j] += q[i - 1][j + 1];
    }
  for (auto& row : q) {
    if (row[0] != 0) return {};
    row.erase(row.begin());
    if (row.empty()) return {};
  }
  return trimmed(q);
}

Line_polynomial on_diagonal(const Plane_polynomial& f)
{
  Line_polynomial d(rows(f) + columns(f) - 1, Rational(0));
  for (std::size_t i = 0; i < rows(f); ++i)
    for (std::size_t j = 0; j < columns(f); ++j) d[i + j] += f[i][j];
  return d;
}

Integer_polynomial with_integers(const Line_polynomial& f)
{
  Integer denominator = 1;
  for (const Rational& c : f) denominator = lcm(denominator, c.get_den());
  Integer_polynomial a;
  for (const Rational& c : f) a.push_back(Integer(c.get_num() * Integer(denominator / c.get_den())));
  locus::detail::trim(a);
  return a;
}

/// Integer coefficients of both, the same up to a factor.
Plane_polynomial with_integers(Plane_polynomial f)
{
  Integer denominator = 1;
  for (const auto& row : f)
    for (const Rational& c : row) denominator = lcm(denominator, c.get_den());
  for (auto& row : f)
    for (Rational& c : row) c *= denominator;
  return f;
}

// -------------------------------------------------------------------------------------------------------- the systems

struct Plane_system {
  std::string name;
  Plane_polynomial first, second;
  Plane_polynomial peers_second;   ///< the same solutions but for those on the diagonal
  Integer_polynomial diagonal;     ///< its zeros are further solutions u = v; empty if there are none
  /// A regular system with common zeros that are solutions where the first equation is of second order; or none.
  std::vector<Plane_polynomial> nodes{};
};

/// A planar curve x/w, y/w and a point, as in "point_curve" of the cases that peers were measured on.
struct Point_and_curve {
  std::string name;
  Line_polynomial x, y, w;
  Rational px, py;
};

/// R, S and D for the self-intersections of the bisector of a point and a curve: with Z = ⟨a,p⟩, a = p'w - pw', the
/// normals at u and v meet in (X_i, Y_i)/W_i, and that is as far from the point as from the curve at u (R) and at v (S).
Plane_system self_intersections(const Point_and_curve& c)
{
  const auto tangent = [&](const Line_polynomial& p) { return plus(times(slope(p), c.w), times(p, slope(c.w)), -1); };
  const Line_polynomial ax = tangent(c.x), ay = tangent(c.y), z = plus(times(ax, c.x), times(ay, c.y));
  const Line_polynomial axw = times(ax, c.w), ayw = times(ay, c.w), p2{Rational(c.px * c.px + c.py * c.py)};
  const Line_polynomial dx = plus(times({c.px}, c.w), c.x, -1), dy = plus(times({c.py}, c.w), c.y, -1);
  const Line_polynomial power = plus(plus(times(c.x, c.x), times(c.y, c.y)), times(p2, times(c.w, c.w)), -1);
  const Plane_polynomial xi = sum(in_u(z) * in_v(ayw), in_v(z) * in_u(ayw), -1),
                         yi = sum(in_v(z) * in_u(axw), in_u(z) * in_v(axw), -1);
  const Plane_polynomial wi = sum(in_u(ax) * in_v(ay), in_v(ax) * in_u(ay), -1);
  const auto equation = [&](auto at, auto other) {
    const Plane_polynomial twice = sum(at(dx) * xi, at(dy) * yi);
    return trimmed(sum(at(power) * other(c.w) * wi, twice, 2));
  };
  const Plane_polynomial r = divided_by_diagonal(equation(in_u, in_v)), s = divided_by_diagonal(equation(in_v, in_u));
  Plane_polynomial d = sum(in_v(c.w) * r, in_u(c.w) * s, -1);
  for (int k = 0; k < 3; ++k) d = divided_by_diagonal(d);
  return {c.name, with_integers(r), with_integers(d), with_integers(s), with_integers(on_diagonal(r))};
}

std::vector<Point_and_curve> points_and_curves()
{
  const auto q = [](long a, long b) { return Rational(a, b); };
  return {{"parabola", {0, 1}, {0, 0, 1}, {1}, q(1, 4), 1},
          {"ellipse", {1, 0, -1}, {0, 1}, {1, 0, 1}, q(1, 2), q(1, 8)},
          {"cubic", {0, 1}, {0, 0, 0, 1}, {1}, q(3, 4), q(1, 2)},
          {"superbola", {0, 1}, {0, 0, 0, 0, 1}, {1}, q(1, 4), q(3, 4)}};
}

/// F3 = -Im(e² ā b̄) of two polynomial curves, and its derivative by the first one's parameter. Nodes are where e = 0.
Plane_system turning_points(const locus_benchmark::Case& pair)
{
  const auto coordinates = [](const locus_benchmark::Curve_data& data) {
    std::array<Line_polynomial, 2> xy;
    Bernstein<Rational, 1> x(Degrees<1>{static_cast<int>(data.points.size()) - 1}), y = x;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      x[i] = data.points[i].x.value();
      y[i] = data.points[i].y.value();
    }
    xy[0] = to_monomial(x);
    xy[1] = to_monomial(y);
    return xy;
  };
  const auto p = coordinates(pair.first), q = coordinates(pair.second);
  const Plane_polynomial ex = sum(in_v(q[0]), in_u(p[0]), -1), ey = sum(in_v(q[1]), in_u(p[1]), -1);
  const Plane_polynomial ax = in_u(slope(p[0])), ay = in_u(slope(p[1])), bx = in_v(slope(q[0])), by = in_v(slope(q[1]));
  const Plane_polynomial real = sum(ax * bx, ay * by, -1), imaginary = sum(ax * by, ay * bx);
  const Plane_polynomial square = sum(ex * ex, ey * ey, -1), twice = ex * ey;
  const Plane_polynomial f = trimmed(with_integers(sum(square * imaginary, sum(twice * real, twice * real), -1)));
  return {pair.name, f, slope_in_u(f), slope_in_u(f), {}, {with_integers(ex), with_integers(ey)}};
}

// ------------------------------------------------------------------------------------------------------ this library

/// A cell of the plane: [-∞,-1], [-1,1] or [1,∞] in each variable, or half of one that is infinite in both. There all but
/// few polynomials vanish at infinity; blown up, that corner is the edge x1 = 0 of the charts
/// 1/|u| = x0·x1, 1/|v| = x1 and 1/|u| = x1, 1/|v| = x0·x1.
struct Plane_cell {
  std::array<int, 2> piece{}; ///< -1, 0, 1
  int chart = 0;              ///< 0 or 1, where both are infinite

  bool is_corner() const { return piece[0] != 0 && piece[1] != 0; }
};

/// Coefficients of powers of a cell's own coordinates, on [-1,1] for finite pieces, on [0,1] for others.
Bernstein<Integer, 2> in_powers(const Plane_polynomial& f, const Plane_cell& cell)
{
  const int n = static_cast<int>(rows(f)) - 1, m = static_cast<int>(columns(f)) - 1;
  int order = cell.is_corner() ? n + m : 0, top = 0;
  const auto weight = [&](int i, int j) { return n - i + m - j; };
  for (int i = 0; i <= n && cell.is_corner(); ++i)
    for (int j = 0; j <= m; ++j)
      if (f[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] != 0) {
        order = std::min(order, weight(i, j));
        top = std::max(top, weight(i, j));
      }
  Bernstein<Integer, 2> g(cell.is_corner() ? Degrees<2>{cell.chart == 0 ? n : m, top - order} : Degrees<2>{n, m});
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const Rational& c = f[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      if (c == 0) continue;
      const bool negative = (cell.piece[0] < 0 && i % 2 == 1) != (cell.piece[1] < 0 && j % 2 == 1);
      Degrees<2> at{cell.piece[0] != 0 ? n - i : i, cell.piece[1] != 0 ? m - j : j};
      if (cell.is_corner()) at = {cell.chart == 0 ? n - i : m - j, weight(i, j) - order};
      g.at(at) = negative ? Integer(-c.get_num()) : c.get_num();
    }
  return g;
}

/// Powers of x to the Bernstein basis in s, times a positive factor: x = 2s - 1 on a finite piece, x = s or 1 - s on others.
void to_bernstein(Bernstein<Integer, 2>& f, int variable, int piece, bool reversed)
{
  const locus::Layout layout = locus::layout_along(f.degrees(), variable);
  const std::size_t n = layout.count - 1;
  std::vector<Integer> binomials(n + 1), factor(n + 1);
  Integer common = 1;
  for (std::size_t k = 0; k <= n; ++k) {
    binomials[k] = locus::binomial<Integer>(static_cast<int>(n), static_cast<int>(k));
    common = lcm(common, binomials[k]);
  }
  for (std::size_t k = 0; k <= n; ++k) factor[k] = common / binomials[k];
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t i = 0; i < layout.inner; ++i) {
      const auto at = [&](std::size_t k) -> Integer& { return f[(o * layout.count + k) * layout.inner + i]; };
      if (piece == 0) { // powers of x + 1, by Taylor's shift, then of s
        for (std::size_t pass = 0; pass < n; ++pass)
          for (std::size_t k = n; k-- > pass;) at(k) -= at(k + 1);
        for (std::size_t k = 0; k <= n; ++k) at(k) <<= k;
      }
      for (std::size_t k = 0; k <= n; ++k) at(k) *= factor[k];
      for (std::size_t level = n; level > 0; --level)
        for (std::size_t k = level; k <= n; ++k) at(k) += at(k - 1);
      if (reversed)
        for (std::size_t k = 0; 2 * k < n; ++k) std::swap(at(k), at(n - k));
    }
}

/// On the unit square, in the local coordinates of a `Piece` where the cell is none of a corner's charts.
std::shared_ptr<const locus::Equation<2>> equation_on(const Plane_cell& cell, const Plane_polynomial& f)
{
  Bernstein<Integer, 2> g = in_powers(f, cell);
  for (int v = 0; v < 2; ++v) {
    const int piece = cell.piece[static_cast<std::size_t>(v)];
    to_bernstein(g, v, piece, piece > 0 && !cell.is_corner());
  }
  return std::make_shared<locus::Polynomial_equation<2>>(
    Bernstein<locus::Scaled_integer, 2>(std::move(g), Rational(1)));
}

/// A cell's equations, with boxes around the nodes that have no other solution; `only_nodes`: those of the nodes.
locus::Cell_system<2> system_on(const Plane_cell& cell, const Plane_system& system, const locus::Solve_control& control,
                                bool only_nodes)
{
  Equations<2> nodes;
  for (std::size_t k = 0; k < system.nodes.size(); ++k) nodes[k] = equation_on(cell, system.nodes[k]);
  if (only_nodes) return {nodes};
  locus::Cell_system<2> result{{equation_on(cell, system.first), equation_on(cell, system.second)}};
  if (nodes[0])
    for (const auto& p : locus::solve_points<2>(nodes, control).points)
      if (const auto box = locus::box_of_double_point(*result.equations[0], *result.equations[1], p))
        result.known.push_back(*box);
  return result;
}

struct Answer {
  std::vector<std::pair<double, double>> points; ///< near the solutions
  std::size_t diagonal = 0; ///< number of further ones on the diagonal
  std::size_t undecided = 0, cells = 0;
};

double near(const locus::Interval& x) { return 0.5 * (x.inf() + x.sup()); }

locus::Domain<2> projective_plane()
{
  locus::Chain line;
  line.pieces.resize(3);
  line.pieces[0].lo_infinite = line.pieces[2].hi_infinite = true;
  line.pieces[0].hi = line.pieces[1].lo = -1;
  line.pieces[1].hi = line.pieces[2].lo = 1;
  line.joints.resize(2);
  return {{line, line}};
}

/// The solutions in a chart of a corner that no other cell has: those on the line between the charts count in the first.
void add_chart(const Plane_cell& cell, const locus::Cell_system<2>& system, const locus::Solve_control& control,
               Answer& answer)
{
  const auto set = locus::solve_points<2>(system.equations, control, system.known);
  answer.cells += set.cells;
  answer.undecided += set.undecided.size();
  for (const auto& p : set.points) {
    if (p.face[1] >= 0 || p.face[0] == 0 || (p.face[0] == 1 && cell.chart == 1)) continue;
    const double product = near(p.box[0]) * near(p.box[1]), single = near(p.box[1]);
    answer.points.emplace_back(cell.piece[0] / (cell.chart == 0 ? product : single),
                               cell.piece[1] / (cell.chart == 0 ? single : product));
  }
}

/// The solutions that are not at infinity.
void add_plane(const Plane_system& system, bool only_nodes, Answer& answer)
{
  const locus::Solve_control control;
  const auto make = [&](const locus::Cell_number<2>& number) {
    const Plane_cell cell{{static_cast<int>(number[0]) - 1, static_cast<int>(number[1]) - 1}, 0};
    return cell.is_corner() ? locus::Cell_system<2>{} : system_on(cell, system, control, only_nodes);
  };
  const auto set = locus::solve_points_on<2>(projective_plane(), make, control);
  answer.cells += set.cells;
  answer.undecided += set.undecided.size();
  for (const auto& p : set.points)
    if (std::isfinite(near(p.at[0])) && std::isfinite(near(p.at[1])))
      answer.points.emplace_back(near(p.at[0]), near(p.at[1]));
  for (const int u : {-1, 1})
    for (const int v : {-1, 1})
      for (const int chart : {0, 1}) {
        const Plane_cell cell{{u, v}, chart};
        add_chart(cell, system_on(cell, system, control, only_nodes), control, answer);
      }
}

Answer ours(const Plane_system& system)
{
  Answer answer;
  locus::with_upward_rounding([&] {
    if (!system.nodes.empty()) add_plane(system, true, answer);
    add_plane(system, false, answer);
  });
  return answer;
}

std::vector<locus::Real_root> diagonal_roots(const Plane_system& system)
{
  return system.diagonal.empty() ? std::vector<locus::Real_root>{} : locus::real_roots(system.diagonal);
}

// ----------------------------------------------------------------------------------------------------------- the peer

using Peers_integer = CGAL::CORE_arithmetic_kernel::Integer;
using Kernel = CGAL::Algebraic_kernel_d_2<Peers_integer>;
using Peers_points = std::vector<std::pair<Kernel::Algebraic_real_2, int>>;

Kernel::Polynomial_2 for_peer(const Plane_polynomial& f)
{
  std::vector<Kernel::Polynomial_1> by_v;
  for (std::size_t j = 0; j < columns(f); ++j) {
    std::vector<Peers_integer> c;
    for (const auto& row : f) c.emplace_back(row[j].get_num().get_mpz_t());
    by_v.emplace_back(c.begin(), c.end());
  }
  return Kernel::Polynomial_2(by_v.begin(), by_v.end());
}

/// A kernel of its own each time: it remembers the curves that it has analysed.
Peers_points peers(const Kernel::Polynomial_2& f, const Kernel::Polynomial_2& g)
{
  const Kernel kernel;
  Peers_points points;
  kernel.solve_2_object()(f, g, std::back_inserter(points));
  return points;
}

bool same_places(std::vector<std::pair<double, double>> a, const Peers_points& b)
{
  if (a.size() != b.size()) return false;
  for (const auto& p : b) {
    const auto [x, y] = p.first.to_double();
    const double bx = x, by = y;
    const auto found = std::find_if(a.begin(), a.end(), [&](const auto& q) {
      return std::abs(q.first - bx) < 1e-8 * (1 + std::abs(bx)) && std::abs(q.second - by) < 1e-8 * (1 + std::abs(by));
    });
    if (found == a.end()) return false;
    a.erase(found);
  }
  return true;
}

// ------------------------------------------------------------------------------------------------------ the comparison

/// The solutions on the diagonal, narrowed for the comparison.
std::vector<std::pair<double, double>> near_diagonal(const Plane_system& system)
{
  std::vector<std::pair<double, double>> points;
  for (const locus::Real_root& r : diagonal_roots(system)) {
    const double u = locus::Algebraic_number(system.diagonal, r.lo, r.hi).to_double();
    points.emplace_back(u, u);
  }
  return points;
}

/// One line of the table; false where the two disagree or the aim is missed.
bool compare(const Plane_system& system, bool with_diagonal)
{
  const auto our_run = [&] {
    Answer answer = ours(system);
    if (with_diagonal) answer.diagonal = diagonal_roots(system).size();
    return answer;
  };
  const Kernel::Polynomial_2 first = for_peer(system.first),
                             second = for_peer(with_diagonal ? system.peers_second : system.second);
  Answer answer = our_run();
  if (with_diagonal)
    for (const auto& p : near_diagonal(system)) answer.points.push_back(p);
  const Peers_points theirs = peers(first, second);
  const bool agree = answer.undecided == 0 && same_places(answer.points, theirs);
  const auto t = locus_benchmark::side_by_side(
    {[&] { locus_benchmark::keep(our_run()); }, [&] { locus_benchmark::keep(peers(first, second)); }}, 3, 0.05);
  const double ratio = t[1].least / t[0].least;
  std::printf("%-12s %-10s %5zu %5zu %6zu %12.0f (%9.0f) %14.0f (%11.0f) %7.1fx%s%s\n", system.name.c_str(),
              with_diagonal             ? "R, S"
              : system.diagonal.empty() ? "F3, F3_t"
                                        : "R, D",
              answer.points.size(), theirs.size(), answer.cells, 1e6 * t[0].least, 1e6 * t[0].median, 1e6 * t[1].least,
              1e6 * t[1].median, ratio, agree ? "" : "  THE TWO DISAGREE",
              answer.undecided == 0 ? "" : ", undecided boxes are left");
  std::fflush(stdout);
  const bool is_reduced =
    !with_diagonal && !system.diagonal.empty(); // made for the solvers: shown, but no figure to reach
  return agree && (is_reduced || ratio >= aim);
}

/// The diagonal's solutions are none of the system's.
bool is_apart_from_diagonal(const Plane_system& system)
{
  return locus::degree(locus::gcd(system.diagonal, with_integers(on_diagonal(system.second)))) == 0;
}

} // namespace

int main()
{
  std::printf("All solutions in the plane: processor time in µs, least of the rounds (median)\n");
  std::printf("%-12s %-10s %5s %5s %6s %24s %28s %8s\n", "case", "system", "ours", "peer", "boxes", "locus",
              "CGAL AK_d_2", "ratio");
  bool right = true;
  for (const Point_and_curve& c : points_and_curves()) {
    const Plane_system system = self_intersections(c);
    right = is_apart_from_diagonal(system) && right;
    right = compare(system, true) && right;
    right = compare(system, false) && right;
  }
  for (const auto& pair : {locus_benchmark::quad_quad(), locus_benchmark::cubic_cubic()})
    right = compare(turning_points(pair), false) && right;
  std::printf("aim: the same solutions, at least %.0f times faster: %s\n", aim, right ? "met" : "NOT MET");
  return right ? 0 : 1;
}
