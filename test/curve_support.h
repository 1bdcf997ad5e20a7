// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_TEST_CURVE_SUPPORT_H
#define LOCUS_TEST_CURVE_SUPPORT_H

// What the tests of planar bisectors share: curves as control points with exact transformations, F3 evaluated straight
// from its definition (in rationals and in long double) without the library, and the graph of a result as plain numbers.

#include "support.h"

#include <locus/bisector_2.h>

#include <complex>
#include <functional>
#include <map>
#include <memory>

namespace locus_test {

// ------------------------------------------------------------------------------------------------------- curves

using Exact_pair = std::array<Rational, 2>;

/// A Bézier curve before the library has seen it: control points, and weights unless it is polynomial.
struct Control_curve {
  std::vector<Exact_pair> points;
  std::vector<Rational> weights;

  int degree() const { return static_cast<int>(points.size()) - 1; }
  Rational weight(std::size_t i) const { return weights.empty() ? Rational(1) : weights[i]; }
  locus::Curve_2 build() const { return locus::bezier_curve<2>(points, weights); }
};

inline Control_curve curve_of(std::initializer_list<std::array<const char*, 2>> points,
                              std::initializer_list<const char*> weights = {})
{
  Control_curve c;
  for (const auto& p : points) c.points.push_back({locus::parse_rational(p[0]), locus::parse_rational(p[1])});
  for (const char* w : weights) c.weights.push_back(locus::parse_rational(w));
  return c;
}

/// C++ text that makes the curve again.
inline std::string show(const Control_curve& c)
{
  std::string text = "curve_of({";
  for (std::size_t i = 0; i < c.points.size(); ++i)
    text += std::string(i ? ", " : "") + "{\"" + c.points[i][0].get_str() + "\", \"" + c.points[i][1].get_str() + "\"}";
  text += "}";
  for (std::size_t i = 0; i < c.weights.size(); ++i)
    text += std::string(i ? ", " : ", {") + "\"" + c.weights[i].get_str() + "\"";
  return text + (c.weights.empty() ? ")" : "})");
}

inline std::string show(const Control_curve& a, const Control_curve& b) { return show(a) + ", " + show(b); }

using Homogeneous = std::vector<std::array<Rational, 3>>;

/// Homogeneous control points of a curve or a spline.
template <class Controls>
Homogeneous homogeneous(const Controls& c)
{
  Homogeneous h;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const Rational w = c.weight(i);
    h.push_back({Rational(c.points[i][0] * w), Rational(c.points[i][1] * w), w});
  }
  return h;
}

/// Back to control points; weights must not vanish. All weights one gives a polynomial curve.
inline Control_curve from_homogeneous(const Homogeneous& h)
{
  Control_curve c;
  bool polynomial = true;
  for (const auto& p : h) {
    c.points.push_back({Rational(p[0] / p[2]), Rational(p[1] / p[2])});
    c.weights.push_back(p[2]);
    polynomial = polynomial && p[2] == 1;
  }
  if (polynomial) c.weights.clear();
  return c;
}

inline Control_curve reversed(Control_curve c)
{
  std::reverse(c.points.begin(), c.points.end());
  std::reverse(c.weights.begin(), c.weights.end());
  return c;
}

/// The same curve written with one degree more.
inline Control_curve elevated(const Control_curve& c)
{
  const Homogeneous h = homogeneous(c);
  const auto n = static_cast<int>(h.size());
  Homogeneous e;
  for (int i = 0; i <= n; ++i) {
    std::array<Rational, 3> p{0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      if (i > 0) p[k] += Rational(i, n) * h[static_cast<std::size_t>(i - 1)][k];
      if (i < n) p[k] += Rational(n - i, n) * h[static_cast<std::size_t>(i)][k];
      p[k].canonicalize();
    }
    e.push_back(p);
  }
  return from_homogeneous(e);
}

/// Reparametrised by u = s/(s + (1-s)/k), which keeps [0,1]: weights times the powers of k.
inline Control_curve moebius(Control_curve c, const Rational& k)
{
  if (c.weights.empty()) c.weights.assign(c.points.size(), Rational(1));
  for (std::size_t i = 0; i < c.weights.size(); ++i) c.weights[i] *= power(k, static_cast<int>(i));
  return c;
}

/// The part on [lo, hi], by blossoming: control point i is the blossom at lo (n-i times) and hi (i times).
inline Control_curve part_of(const Control_curve& c, const Rational& lo, const Rational& hi)
{
  const Homogeneous h = homogeneous(c);
  const std::size_t n = h.size() - 1;
  Homogeneous result;
  for (std::size_t i = 0; i <= n; ++i) {
    Homogeneous work = h;
    for (std::size_t level = 0; level < n; ++level) {
      const Rational& u = level < n - i ? lo : hi;
      for (std::size_t j = 0; j + 1 < work.size(); ++j)
        for (std::size_t k = 0; k < 3; ++k) work[j][k] = Rational((1 - u) * work[j][k] + u * work[j + 1][k]);
      work.pop_back();
    }
    result.push_back(work[0]);
  }
  return from_homogeneous(result);
}

/// x ↦ (m00 x + m01 y + d0, m10 x + m11 y + d1).
inline Control_curve moved(Control_curve c, const std::array<Rational, 4>& m, const Exact_pair& d)
{
  for (Exact_pair& p : c.points)
    p = {Rational(m[0] * p[0] + m[1] * p[1] + d[0]), Rational(m[2] * p[0] + m[3] * p[1] + d[1])};
  return c;
}

inline Control_curve scaled(const Control_curve& c, const Rational& s) { return moved(c, {s, 0, 0, s}, {0, 0}); }
inline Control_curve translated(const Control_curve& c, const Rational& x, const Rational& y) { return moved(c, {1, 0, 0, 1}, {x, y}); }
inline Control_curve mirrored_in_x_axis(const Control_curve& c) { return moved(c, {1, 0, 0, -1}, {0, 0}); }

// -------------------------------------------------------------------------------------------- random curves

/// What the coordinates of a random curve look like.
enum class Coordinates { grid, dyadic, fractions, perturbed };

inline Rational random_coordinate(Random& random, Coordinates kind)
{
  switch (kind) {
  case Coordinates::grid: return Rational(random.between(-2, 2));
  case Coordinates::dyadic: return Rational(random.between(-64, 64)) / 32;
  case Coordinates::fractions: {
    Rational x(random.between(-3000, 3000), random.between(1, 999));
    x.canonicalize();
    return x;
  }
  case Coordinates::perturbed: return Rational(random.between(-2, 2)) + two_to(-45) * random.between(-1, 1);
  }
  return 0;
}

/// Not a single point; weights, if any, are positive.
inline Control_curve random_curve(Random& random, int degree, Coordinates kind, bool rational)
{
  for (;;) {
    Control_curve c;
    for (int i = 0; i <= degree; ++i) c.points.push_back({random_coordinate(random, kind), random_coordinate(random, kind)});
    if (rational)
      for (int i = 0; i <= degree; ++i) {
        Rational w(random.between(1, 8), 4);
        w.canonicalize();
        c.weights.push_back(w);
      }
    bool single = true;
    for (const Exact_pair& p : c.points) single = single && p == c.points[0];
    if (!single) return c;
  }
}

/// An arc of the circle with rational centre and the radius r·(p²+q²), from angle 2·atan(q0/p0)… as a rational quadratic:
/// z(u) = c + r·(a + i b)²-like parametrisation by half-angle points on the lines h0 + (h1-h0)u.
inline Control_curve circular_arc(const Exact_pair& centre, const Rational& radius, const Exact_pair& h0, const Exact_pair& h1)
{
  // With the half angle h(u) = (1-u)h0 + u·h1 as a complex number, z = centre + radius·h²/|h|².
  const auto product = [](const Exact_pair& a, const Exact_pair& b) {
    return Exact_pair{Rational(a[0] * b[0] - a[1] * b[1]), Rational(a[0] * b[1] + a[1] * b[0])};
  };
  const auto dot = [](const Exact_pair& a, const Exact_pair& b) { return Rational(a[0] * b[0] + a[1] * b[1]); };
  Homogeneous h;
  const std::array<std::array<Exact_pair, 2>, 3> pairs{{{h0, h0}, {h0, h1}, {h1, h1}}};
  for (const auto& [a, b] : pairs) {
    const Exact_pair z = product(a, b);
    const Rational w = dot(a, b);
    h.push_back({Rational(centre[0] * w + radius * z[0]), Rational(centre[1] * w + radius * z[1]), w});
  }
  return from_homogeneous(h);
}

// --------------------------------------------------------------------------------- F3 from its definition, exactly

/// Homogeneous coordinates and D1 = p'w - pw' in the monomial basis.
struct Plain_curve {
  Polynomial x, y, w, ax, ay;

  explicit Plain_curve(const Control_curve& c)
  {
    const Homogeneous h = homogeneous(c);
    const int n = c.degree();
    std::array<Polynomial, 3> p;
    for (int i = 0; i <= n; ++i) {
      Polynomial basis{Rational(choose(n, i))};
      for (int k = 0; k < n; ++k) basis = times(basis, k < i ? Polynomial{0, 1} : Polynomial{1, -1});
      for (std::size_t k = 0; k < 3; ++k) p[k] = plus(p[k], times(basis, {h[static_cast<std::size_t>(i)][k]}));
    }
    x = p[0];
    y = p[1];
    w = p[2];
    ax = plus(times(slope(x), w), times(times(x, slope(w)), {Rational(-1)}));
    ay = plus(times(slope(y), w), times(times(y, slope(w)), {Rational(-1)}));
  }

  /// The tangent without the real factor that its coordinates have in common; that factor is positive at 1/2.
  Plain_curve with_primitive_tangent() const
  {
    Plain_curve c = *this;
    Polynomial common = euclid(ax, ay);
    if (horner(common, Rational(1, 2)) < 0) common = times(common, {Rational(-1)});
    c.ax = ax.empty() ? ax : quotient(ax, common);
    c.ay = ay.empty() ? ay : quotient(ay, common);
    return c;
  }
};

/// A complex number over the rationals.
struct Exact_complex {
  Rational re, im;
};
inline Exact_complex operator*(const Exact_complex& a, const Exact_complex& b)
{
  return {Rational(a.re * b.re - a.im * b.im), Rational(a.re * b.im + a.im * b.re)};
}
inline Exact_complex conj(const Exact_complex& a) { return {a.re, Rational(-a.im)}; }

/// e = p1·w2 - p2·w1, and the tangents a and b, at one point of the parameter square.
struct Plain_values {
  Exact_complex e, a, b;
  Rational w1, w2;
};

inline Plain_values plain_values(const Plain_curve& first, const Plain_curve& second, const Rational& t, const Rational& r)
{
  Plain_values v;
  v.w1 = horner(first.w, t);
  v.w2 = horner(second.w, r);
  v.e = {Rational(horner(first.x, t) * v.w2 - horner(second.x, r) * v.w1),
         Rational(horner(first.y, t) * v.w2 - horner(second.y, r) * v.w1)};
  v.a = {horner(first.ax, t), horner(first.ay, t)};
  v.b = {horner(second.ax, r), horner(second.ay, r)};
  return v;
}

/// -Im(e² ā b̄)
inline Rational plain_f3(const Plain_curve& first, const Plain_curve& second, const Rational& t, const Rational& r)
{
  const Plain_values v = plain_values(first, second, t, r);
  return Rational(-(v.e * v.e * conj(v.a) * conj(v.b)).im);
}

// ------------------------------------------------------------------------------------------------- in long double

using Real = long double;
using Complex = std::complex<Real>;

inline Real real_of(const Rational& x)
{
  const double high = x.get_d();
  const Rational rest = x - Rational(high);
  return static_cast<Real>(high) + static_cast<Real>(rest.get_d());
}

/// A curve with its first two derivatives, by de Casteljau in long double.
class Real_curve {
public:
  explicit Real_curve(const Control_curve& c)
  {
    for (const auto& p : homogeneous(c)) h_.push_back({real_of(p[0]), real_of(p[1]), real_of(p[2])});
  }

  struct Values {
    Complex point, first, second; ///< of p/w, with respect to the parameter
  };

  Values at(Real u) const
  {
    const std::size_t n = h_.size() - 1;
    std::vector<std::array<Real, 3>> b = h_;
    std::array<std::array<Real, 3>, 3> d{}; // homogeneous value and derivatives
    for (std::size_t left = n;; --left) {
      if (left == 2)
        for (std::size_t k = 0; k < 3; ++k) d[2][k] = static_cast<Real>(n * (n - 1)) * (b[2][k] - 2 * b[1][k] + b[0][k]);
      if (left == 1)
        for (std::size_t k = 0; k < 3; ++k) d[1][k] = static_cast<Real>(n) * (b[1][k] - b[0][k]);
      if (left == 0) break;
      for (std::size_t i = 0; i < left; ++i)
        for (std::size_t k = 0; k < 3; ++k) b[i][k] = (1 - u) * b[i][k] + u * b[i + 1][k];
    }
    d[0] = b[0];
    const Complex p(d[0][0], d[0][1]), p1(d[1][0], d[1][1]), p2(d[2][0], d[2][1]);
    const Real w = d[0][2], w1 = d[1][2], w2 = d[2][2];
    Values v;
    v.point = p / w;
    v.first = (p1 - v.point * w1) / w;
    v.second = (p2 - 2 * w1 * v.first - v.point * w2) / w;
    return v;
  }

private:
  std::vector<std::array<Real, 3>> h_;
};

inline Real dot(const Complex& a, const Complex& b) { return a.real() * b.real() + a.imag() * b.imag(); }
inline Real cross(const Complex& a, const Complex& b) { return a.real() * b.imag() - a.imag() * b.real(); }

/// The pair of curves with everything that is asked of a point (t, r), from first principles.
class Real_pair {
public:
  Real_pair(const Control_curve& a, const Control_curve& b) : first_(a), second_(b) {}

  const Real_curve& first() const { return first_; }
  const Real_curve& second() const { return second_; }

  struct Equation {
    Real value, by_t, by_r; ///< F = Im(e² ā b̄) for the affine e = C1 - C2, and its partial derivatives
    Real size;              ///< |e|²|a||b|: the value that F could have
  };

  Equation f3(Real t, Real r) const
  {
    const auto c = first_.at(t), d = second_.at(r);
    const Complex e = c.point - d.point, a = std::conj(c.first), b = std::conj(d.first);
    const Complex a1 = std::conj(c.second), b1 = std::conj(d.second);
    Equation f;
    f.value = (e * e * a * b).imag();
    f.by_t = (Real(2) * e * c.first * a * b + e * e * a1 * b).imag();
    f.by_r = (Real(-2) * e * d.first * a * b + e * e * a * b1).imag();
    f.size = std::norm(e) * std::abs(a) * std::abs(b);
    return f;
  }

  /// Newton steps along the gradient: the point of F = 0 next to (t, r).
  std::array<Real, 2> corrected(std::array<Real, 2> p, int steps = 6) const
  {
    for (int k = 0; k < steps; ++k) {
      const Equation f = f3(p[0], p[1]);
      const Real g = f.by_t * f.by_t + f.by_r * f.by_r;
      if (!(g > 0)) break;
      p[0] -= f.value * f.by_t / g;
      p[1] -= f.value * f.by_r / g;
    }
    return p;
  }

  /// The centre of the circle tangent to both curves at the feet, by the better of two formulas of our own: the normals'
  /// intersection, or the chord's bisector with the normal that is less parallel to the chord's bisector.
  Complex image(Real t, Real r) const
  {
    const auto c = first_.at(t), d = second_.at(r);
    const Complex n1 = Complex(0, 1) * c.first / std::abs(c.first), n2 = Complex(0, 1) * d.first / std::abs(d.first);
    const Complex e = d.point - c.point;
    const Real sine = cross(n1, n2);
    const Real by1 = dot(n1, e), by2 = dot(n2, e);
    if (std::abs(sine) > std::max(std::abs(by1), std::abs(by2)) / std::abs(e)) return c.point + n1 * (cross(e, n2) / sine);
    if (std::abs(by1) >= std::abs(by2)) return c.point + n1 * (std::norm(e) / (2 * by1));
    return d.point - n2 * (std::norm(e) / (2 * by2));
  }

private:
  Real_curve first_, second_;
};

// ------------------------------------------------------------------------------------------- components on a grid

/// Line i of 0…n of an uneven grid on [0,1] that has both ends.
inline Real grid_line(int n, int i)
{
  if (i == 0 || i == n) return i == 0 ? Real(0) : Real(1);
  return (static_cast<Real>(i) + Real(0.3) * std::sin(Real(1.7) * static_cast<Real>(i) + 1)) / static_cast<Real>(n);
}

/// Connected components of a curve by the signs on a grid: its crossings with the grid's edges, joined within each
/// square; within a few squares of a declared node all are joined. Squares with four crossings elsewhere are joined by
/// the sign in the middle. Good for curves whose parts keep a few grid widths apart.
template <class Grid_sign, class Sign_at>
std::size_t grid_components(int n, Grid_sign positive, Sign_at positive_at, const std::vector<std::array<double, 2>>& nodes)
{
  const auto m = static_cast<std::size_t>(n) + 1;
  std::vector<Real> line(m);
  for (int i = 0; i <= n; ++i) line[static_cast<std::size_t>(i)] = grid_line(n, i);
  std::vector<char> sign(m * m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j) sign[i * m + j] = positive(i, j);
  // Edge (i,j)-(i+1,j) has number i·m+j, edge (i,j)-(i,j+1) has m² more.
  std::vector<std::size_t> parent(2 * m * m);
  for (std::size_t k = 0; k < parent.size(); ++k) parent[k] = k;
  std::vector<char> used(parent.size(), 0);
  const auto find = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  const auto join = [&](std::size_t a, std::size_t b) { parent[find(a)] = find(b); };
  for (std::size_t i = 0; i + 1 < m; ++i)
    for (std::size_t j = 0; j + 1 < m; ++j) {
      const std::size_t edge[4] = {i * m + j, m * m + (i + 1) * m + j, i * m + j + 1, m * m + i * m + j};
      const char corner[4] = {sign[i * m + j], sign[(i + 1) * m + j], sign[(i + 1) * m + j + 1], sign[i * m + j + 1]};
      std::vector<std::size_t> crossed;
      for (std::size_t k = 0; k < 4; ++k)
        if (corner[k] != corner[(k + 1) % 4]) crossed.push_back(edge[k]);
      for (const std::size_t e : crossed) used[e] = 1;
      if (crossed.size() == 2) join(crossed[0], crossed[1]);
      if (crossed.size() == 4) {
        const bool with_first = positive_at((line[i] + line[i + 1]) / 2, (line[j] + line[j + 1]) / 2) == (corner[0] != 0);
        join(edge[0], edge[with_first ? 1 : 3]);
        join(edge[2], edge[with_first ? 3 : 1]);
      }
    }
  for (const auto& node : nodes) {
    const double reach = (n > 1000 ? 16.0 : 3.0) / n;
    std::size_t first = parent.size();
    for (std::size_t i = 0; i < m; ++i) {
      if (std::abs(node[0] - static_cast<double>(line[i])) > reach) continue;
      for (std::size_t j = 0; j < m; ++j) {
        if (std::abs(node[1] - static_cast<double>(line[j])) > reach) continue;
        for (const std::size_t e : {i * m + j, m * m + i * m + j}) {
          if (!used[e]) continue;
          if (first < parent.size()) join(e, first);
          first = e;
        }
      }
    }
  }
  std::size_t count = 0;
  for (std::size_t k = 0; k < parent.size(); ++k) count += used[k] && find(k) == k;
  return count;
}

/// Components of F3 = 0 for a pair of curves by a grid.
class F3_grid {
public:
  F3_grid(const Control_curve& a, const Control_curve& b) : first_(a), second_(b) {}

  std::size_t components(int n, const std::vector<std::array<double, 2>>& nodes) const
  {
    std::vector<Side> a, b;
    for (int i = 0; i <= n; ++i) {
      a.push_back(first_.at(grid_line(n, i)));
      b.push_back(second_.at(grid_line(n, i)));
    }
    return grid_components(
      n, [&](std::size_t i, std::size_t j) { return is_positive(a[i], b[j]); },
      [&](Real t, Real r) { return is_positive(first_.at(t), second_.at(r)); }, nodes);
  }

private:
  struct Side {
    Complex point, tangent;
  };
  /// Point and tangent, without the factors that a tangent may have in common.
  struct Curve {
    explicit Curve(const Control_curve& c) : Curve(Plain_curve(c).with_primitive_tangent()) {}
    explicit Curve(const Plain_curve& c) : x(reals(c.x)), y(reals(c.y)), w(reals(c.w)), ax(reals(c.ax)), ay(reals(c.ay)) {}

    static std::vector<Real> reals(const Polynomial& f)
    {
      std::vector<Real> result;
      for (const Rational& c : f) result.push_back(real_of(c));
      return result;
    }
    static Real value(const std::vector<Real>& f, Real u)
    {
      Real sum = 0;
      for (std::size_t k = f.size(); k-- > 0;) sum = sum * u + f[k];
      return sum;
    }
    Side at(Real u) const { return {Complex(value(x, u), value(y, u)) / value(w, u), Complex(value(ax, u), value(ay, u))}; }

    std::vector<Real> x, y, w, ax, ay;
  };
  static bool is_positive(const Side& a, const Side& b)
  {
    const Complex e = a.point - b.point;
    return (e * e * std::conj(a.tangent) * std::conj(b.tangent)).imag() > 0;
  }

  Curve first_, second_;
};

// ------------------------------------------------------------------------------------------------- the result's graph

/// What must not change when the inputs are written differently.
struct Graph_numbers {
  bool certified = true;
  std::size_t components = 0, arcs = 0, closed = 0;
  std::map<std::string, std::size_t> vertices, degenerate;

  bool operator==(const Graph_numbers& other) const
  {
    return certified == other.certified && components == other.components && arcs == other.arcs && closed == other.closed &&
           vertices == other.vertices && degenerate == other.degenerate;
  }
};

inline std::string show(const Graph_numbers& g)
{
  std::string text = g.certified ? "certified" : "undecided";
  text += ", " + std::to_string(g.components) + " components, " + std::to_string(g.arcs) + " arcs (" + std::to_string(g.closed) + " closed)";
  for (const auto& [name, n] : g.vertices) text += ", " + std::to_string(n) + " " + name;
  for (const auto& [name, n] : g.degenerate) text += ", degenerate " + name + " " + std::to_string(n);
  return text;
}

inline Graph_numbers graph_numbers(const locus::Locus<2>& l)
{
  Graph_numbers g;
  g.certified = l.status() == locus::Status::certified;
  g.components = l.components();
  g.arcs = l.arcs().size();
  for (const auto& arc : l.arcs()) g.closed += arc.is_closed();
  for (const auto& v : l.vertices()) ++g.vertices[locus::name_of(v.kind)];
  for (const auto& d : l.degenerate()) ++g.degenerate[d.kind];
  return g;
}

inline std::string reasons(const locus::Locus<2>& l)
{
  std::string text;
  for (const auto& u : l.undecided()) {
    text += (text.empty() ? "" : "; ") + u.reason + " in";
    for (const auto& range : u.box) {
      char buffer[80];
      std::snprintf(buffer, sizeof buffer, " [%.17g, %.17g]", range.lo, range.hi);
      text += buffer;
    }
  }
  return text;
}

// --------------------------------------------------------------------------------------------- curves of several pieces

/// A curve of Bézier pieces in order, all of one degree: piece k on [breaks[k], breaks[k+1]].
struct Control_chain {
  std::vector<Control_curve> pieces;
  std::vector<Rational> breaks;
  bool closed = false;

  std::size_t size() const { return pieces.size(); }

  /// The pieces given one by one.
  locus::Curve_2 build() const
  {
    std::vector<locus::Curve_piece<2>> forms;
    std::vector<locus::Piece> ranges(size());
    for (std::size_t k = 0; k < size(); ++k) {
      forms.push_back(pieces[k].build().pieces()[0]);
      ranges[k].lo = breaks[k];
      ranges[k].hi = breaks[k + 1];
    }
    return locus::split_at_cusps(locus::joined_curve<2>(std::move(forms), std::move(ranges), closed));
  }
};

/// A B-spline curve before the library has seen it.
struct Control_spline {
  int degree = 1;
  std::vector<Exact_pair> points;
  std::vector<Rational> knots, weights;
  bool closed = false;

  Rational weight(std::size_t i) const { return weights.empty() ? Rational(1) : weights[i]; }
  locus::Curve_2 build() const { return locus::bspline_curve<2>(degree, points, knots, weights, closed); }
};

inline Control_spline spline_of(int degree, std::initializer_list<std::array<const char*, 2>> points,
                                std::initializer_list<const char*> knots,
                                std::initializer_list<const char*> weights = {}, bool closed = false)
{
  Control_spline s;
  s.degree = degree;
  for (const auto& p : points) s.points.push_back({locus::parse_rational(p[0]), locus::parse_rational(p[1])});
  for (const char* u : knots) s.knots.push_back(locus::parse_rational(u));
  for (const char* w : weights) s.weights.push_back(locus::parse_rational(w));
  s.closed = closed;
  return s;
}

/// C++ text that makes the curve again.
inline std::string show(const Control_spline& s)
{
  const auto list = [](const std::vector<Rational>& numbers) {
    std::string text = "{";
    for (std::size_t i = 0; i < numbers.size(); ++i)
      text += std::string(i ? ", " : "") + "\"" + numbers[i].get_str() + "\"";
    return text + "}";
  };
  std::string text = "spline_of(" + std::to_string(s.degree) + ", {";
  for (std::size_t i = 0; i < s.points.size(); ++i)
    text += std::string(i ? ", " : "") + list({s.points[i][0], s.points[i][1]});
  return text + "}, " + list(s.knots) + ", " + list(s.weights) + (s.closed ? ", true)" : ")");
}

/// The polar form of the span that starts with knots[k], at `degree` arguments: de Boor's triangle with one argument a level.
inline std::array<Rational, 3> blossom(const Control_spline& s, const Homogeneous& h, std::size_t k,
                                       const std::vector<Rational>& arguments)
{
  const auto n = static_cast<std::size_t>(s.degree);
  Homogeneous d(h.begin() + static_cast<std::ptrdiff_t>(k - n), h.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  for (std::size_t level = 1; level <= n; ++level)
    for (std::size_t j = n; j >= level; --j) {
      const Rational &lo = s.knots[j + k - n], &hi = s.knots[j + k + 1 - level];
      const Rational f = (arguments[level - 1] - lo) / (hi - lo);
      for (std::size_t c = 0; c < 3; ++c) d[j][c] = Rational((1 - f) * d[j - 1][c] + f * d[j][c]);
    }
  return d[n];
}

/// The Bézier pieces of a spline.
inline Control_chain chain_of(const Control_spline& s)
{
  const Homogeneous h = homogeneous(s);
  const auto n = static_cast<std::size_t>(s.degree);
  Control_chain chain;
  chain.closed = s.closed;
  for (std::size_t k = n; k < s.points.size(); ++k) {
    if (s.knots[k] == s.knots[k + 1]) continue;
    Homogeneous piece;
    for (std::size_t i = 0; i <= n; ++i) {
      std::vector<Rational> arguments(n, s.knots[k]);
      for (std::size_t j = 0; j < i; ++j) arguments[j] = s.knots[k + 1];
      piece.push_back(blossom(s, h, k, arguments));
    }
    chain.pieces.push_back(from_homogeneous(piece));
    if (chain.breaks.empty()) chain.breaks.push_back(s.knots[k]);
    chain.breaks.push_back(s.knots[k + 1]);
  }
  return chain;
}

/// The same curve as one spline whose inner knots stand `degree` times. Pieces are scaled so that weights agree at joints.
inline Control_spline spline_of(const Control_chain& chain)
{
  Control_spline s;
  s.degree = chain.pieces[0].degree();
  s.closed = chain.closed;
  Homogeneous h;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    Homogeneous piece = homogeneous(chain.pieces[k]);
    const Rational factor = h.empty() ? Rational(1) : Rational(h.back()[2] / piece[0][2]);
    for (auto& p : piece)
      for (Rational& x : p) x *= factor;
    h.insert(h.end(), piece.begin() + (h.empty() ? 0 : 1), piece.end());
    s.knots.insert(s.knots.end(), static_cast<std::size_t>(s.degree), chain.breaks[k]);
  }
  s.knots.insert(s.knots.begin(), chain.breaks.front());
  s.knots.insert(s.knots.end(), static_cast<std::size_t>(s.degree) + 1, chain.breaks.back());
  const Control_curve c = from_homogeneous(h);
  s.points = c.points;
  s.weights = c.weights;
  return s;
}

inline Control_chain chain_of(const Control_curve& c) { return {{c}, {0, 1}, false}; }

inline Control_chain reversed(Control_chain c)
{
  std::reverse(c.pieces.begin(), c.pieces.end());
  for (Control_curve& p : c.pieces) p = reversed(p);
  std::reverse(c.breaks.begin(), c.breaks.end());
  for (Rational& u : c.breaks) u = -u;
  return c;
}

inline Control_chain elevated(Control_chain c)
{
  for (Control_curve& p : c.pieces) p = elevated(p);
  return c;
}

inline Control_chain moved(Control_chain c, const std::array<Rational, 4>& m, const Exact_pair& d)
{
  for (Control_curve& p : c.pieces) p = moved(p, m, d);
  return c;
}

/// Knot insertion: the piece that holds u in two; unchanged at a joint.
inline Control_chain with_cut_at(Control_chain c, const Rational& u)
{
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (!(c.breaks[k] < u && u < c.breaks[k + 1])) continue;
    const auto at = static_cast<std::ptrdiff_t>(k);
    const Rational s = (u - c.breaks[k]) / (c.breaks[k + 1] - c.breaks[k]);
    const Control_curve whole = c.pieces[k];
    c.pieces[k] = part_of(whole, s, Rational(1));
    c.pieces.insert(c.pieces.begin() + at, part_of(whole, Rational(0), s));
    c.breaks.insert(c.breaks.begin() + at + 1, u);
    break;
  }
  return c;
}

/// A closed chain that starts with piece k; the parameters of the pieces before it grow by the period.
inline Control_chain with_seam_before(Control_chain c, std::size_t k)
{
  const Rational period = c.breaks.back() - c.breaks.front();
  const auto at = static_cast<std::ptrdiff_t>(k);
  std::rotate(c.pieces.begin(), c.pieces.begin() + at, c.pieces.end());
  c.breaks.pop_back();
  for (std::size_t i = 0; i < k; ++i) c.breaks[i] += period;
  std::rotate(c.breaks.begin(), c.breaks.begin() + at, c.breaks.end());
  c.breaks.push_back(Rational(c.breaks.front() + period));
  return c;
}

/// The parameter v = (u - lo)/(u - lo + k·(hi - u))·(hi - lo) + lo of [lo, hi]: increasing, the ends stay; 1 for k.
inline Rational moebius_value(const Control_chain& c, const Rational& k, const Rational& u)
{
  const Rational lo = c.breaks.front(), hi = c.breaks.back();
  return Rational((u - lo) / (u - lo + k * (hi - u)) * (hi - lo) + lo);
}

/// The chain with that parameter. On each piece the map is again projective and keeps the ends of the unit interval, so its
/// weights are multiplied by powers of the ratio of the denominators at the two ends.
inline Control_chain moebius(const Control_chain& c, const Rational& k)
{
  Control_chain m = c;
  const Rational lo = c.breaks.front(), hi = c.breaks.back();
  const auto denominator = [&](const Rational& u) { return Rational(u - lo + k * (hi - u)); };
  for (std::size_t i = 0; i < c.size(); ++i) {
    m.pieces[i] = moebius(c.pieces[i], Rational(denominator(c.breaks[i]) / denominator(c.breaks[i + 1])));
    m.breaks[i + 1] = moebius_value(c, k, c.breaks[i + 1]);
  }
  return m;
}

// ------------------------------------------------------------------ exact counts for curves of several pieces, by Sturm

/// F3(t, r) as a polynomial in r for one t, both local.
inline Polynomial f3_across(const Plain_curve& p, const Plain_curve& q, const Rational& t)
{
  const Rational x = horner(p.x, t), y = horner(p.y, t), w = horner(p.w, t), ax = horner(p.ax, t), ay = horner(p.ay, t);
  const auto minus = [](const Polynomial& f, const Polynomial& g) { return plus(f, times(g, {Rational(-1)})); };
  const Polynomial er = minus(times(q.w, {x}), times(q.x, {w})), ei = minus(times(q.w, {y}), times(q.y, {w}));
  const Polynomial sr = minus(times(er, er), times(ei, ei)), si = times(times(er, ei), {Rational(2)});
  const Polynomial ur = plus(times(sr, {ax}), times(si, {ay})), ui = minus(times(si, {ax}), times(sr, {ay}));
  return minus(times(ui, q.ax), times(ur, q.ay));
}

/// Roots of F3 along lines through the chains' product, counted exactly from control points alone: what a certified result
/// must agree with. Roots at knots, multiple ones and identities make a count `unclear`.
class Exact_counts {
public:
  /// `b` null: the chain with itself; then each unordered pair counts once.
  Exact_counts(const Control_chain& a, const Control_chain* b) : self_(b == nullptr), chains_{a, b ? *b : a}
  {
    for (std::size_t k = 0; k < 2; ++k)
      for (const Control_curve& c : chains_[k].pieces) forms_[k].push_back(Plain_curve(c).with_primitive_tangent());
  }

  struct Count {
    std::size_t roots = 0;
    bool clear = true;
  };

  const Control_chain& chain(std::size_t k) const { return chains_[k]; }
  bool is_self() const { return self_; }

  /// Where the direction of travel turns: the break's number, for the seam 0.
  bool is_corner(std::size_t k, std::size_t joint) const
  {
    const std::size_t n = chains_[k].size();
    const Plain_curve &left = forms_[k][(joint + n - 1) % n], &right = forms_[k][joint % n];
    const Rational lx = horner(left.ax, 1), ly = horner(left.ay, 1), rx = horner(right.ax, 0), ry = horner(right.ay, 0);
    return Rational(lx * ry) != Rational(ly * rx) || Rational(lx * rx + ly * ry) < 0;
  }

  /// Distinct roots on the line where variable k has the local value s on its piece i, except at feet that are one point.
  Count on_line(std::size_t k, std::size_t i, const Rational& s) const
  {
    Count count;
    const auto& others = forms_[1 - k];
    for (std::size_t j = 0; j < others.size(); ++j) {
      Polynomial f = f3_across(forms_[k][i], others[j], s);
      if (f.empty()) {
        count.clear = false;
        continue;
      }
      // The components where the other parameter stands still are no arcs.
      const Polynomial still =
        euclid(f, f3_across(forms_[k][i], others[j],
                            Rational(s == Rational(317, 1009) ? Rational(401, 1013) : Rational(317, 1009))));
      if (still.size() > 1) f = quotient(f, still);
      for (const Rational& meeting : meetings(i, s, j))
        while (f.size() > 1 && horner(f, meeting) == 0) f = quotient(f, {Rational(-meeting), 1});
      if (f.size() < 2) continue;
      count.clear = count.clear && horner(f, 0) != 0 && horner(f, 1) != 0;
      const Polynomial multiple = euclid(f, slope(f));
      count.clear = count.clear && (multiple.size() < 2 || Sturm(multiple).closed(0, 1) == 0);
      count.roots += static_cast<std::size_t>(Sturm(f).open(0, 1));
    }
    return count;
  }

  /// Roots on all lines where variable k stands at the break `joint`: from both sides of a corner, one of a domain's end.
  Count on_wall(std::size_t k, std::size_t joint) const
  {
    const std::size_t n = chains_[k].size();
    Count count;
    if (joint < n) add(on_line(k, joint, 0), count);
    if (joint > 0 || chains_[k].closed) add(on_line(k, (joint + n - 1) % n, 1), count);
    return count;
  }

  /// Roots of F3(u, u - δ) for a small δ, but for those across corners: the arcs that end on the diagonal.
  Count near_diagonal() const
  {
    const Count count = at_offset(two_to(-60)), closer = at_offset(two_to(-66));
    return {count.roots, count.clear && closer.clear && count.roots == closer.roots};
  }

private:
  static void add(const Count& c, Count& to)
  {
    to.roots += c.roots;
    to.clear = to.clear && c.clear;
  }

  /// Local parameters on piece j where a curve meets itself because it is the same parameter.
  std::vector<Rational> meetings(std::size_t i, const Rational& s, std::size_t j) const
  {
    std::vector<Rational> found;
    if (!self_) return found;
    const std::size_t n = chains_[0].size();
    if (i == j) found.push_back(s);
    if (s == 1 && ((i + 1 < n && j == i + 1) || (i + 1 == n && j == 0 && chains_[0].closed))) found.push_back(0);
    if (s == 0 && ((i > 0 && j + 1 == i) || (i == 0 && j + 1 == n && chains_[0].closed))) found.push_back(1);
    return found;
  }

  Count at_offset(const Rational& relative) const
  {
    const Control_chain& c = chains_[0];
    const std::size_t n = c.size();
    const Rational period = c.breaks.back() - c.breaks.front(), delta = relative * period;
    Count count;
    for (std::size_t i = 0; i < n; ++i) {
      add(between(i, i, 0, delta, Rational(c.breaks[i] + delta), c.breaks[i + 1]), count);
      if (i == 0 && !c.closed) continue;
      if (is_corner(0, i)) continue;
      add(between(i, i == 0 ? n - 1 : i - 1, i == 0 ? period : Rational(0), delta, c.breaks[i],
                  Rational(c.breaks[i] + delta)),
          count);
    }
    return count;
  }

  Count between(std::size_t i, std::size_t j, const Rational& shift, const Rational& delta, const Rational& from,
                const Rational& to) const
  {
    const auto moved_form = [&](std::size_t k, const Rational& by) { // as a polynomial in u, of the piece at u - by
      const Rational lo = chains_[0].breaks[k], h = chains_[0].breaks[k + 1] - lo;
      Plain_curve p = forms_[0][k];
      for (Polynomial* f : {&p.x, &p.y, &p.w, &p.ax, &p.ay})
        *f = compose_linear(*f, Rational(-(lo + by) / h), Rational(1 / h));
      return p;
    };
    const Plain_curve p = moved_form(i, 0), q = moved_form(j, Rational(delta - shift));
    const auto minus = [](const Polynomial& f, const Polynomial& g) { return plus(f, times(g, {Rational(-1)})); };
    const Polynomial er = minus(times(p.x, q.w), times(q.x, p.w)), ei = minus(times(p.y, q.w), times(q.y, p.w));
    const Polynomial sr = minus(times(er, er), times(ei, ei)), si = times(times(er, ei), {Rational(2)});
    const Polynomial tr = minus(times(p.ax, q.ax), times(p.ay, q.ay)), ti = plus(times(p.ax, q.ay), times(p.ay, q.ax));
    const Polynomial f = minus(times(si, tr), times(sr, ti));
    if (f.empty()) return {0, false};
    const Polynomial multiple = euclid(f, slope(f));
    const bool clear =
      horner(f, from) != 0 && horner(f, to) != 0 && (multiple.size() < 2 || Sturm(multiple).closed(from, to) == 0);
    return {static_cast<std::size_t>(Sturm(f).open(from, to)), clear};
  }

  bool self_;
  std::array<Control_chain, 2> chains_;
  std::array<std::vector<Plain_curve>, 2> forms_;
};

/// How the parameters of a pair of feet go on to those of the next sample, where chains are closed: the nearest of the
/// places that mean the same pair. `swapped`: the two parameters of a self-bisector change places across the seam.
struct Parameter_step {
  std::array<double, 2> to{};
  bool swapped = false;
};

inline Parameter_step next_parameters(const std::array<double, 2>& from, const std::array<double, 2>& to,
                                      const std::array<double, 2>& periods, bool is_self)
{
  const auto lifted = [](double x, double y, double period) {
    return period > 0 ? y + period * std::round((x - y) / period) : y;
  };
  const Parameter_step straight{{lifted(from[0], to[0], periods[0]), lifted(from[1], to[1], periods[1])}, false};
  if (!is_self || periods[0] == 0) return straight;
  const Parameter_step crosswise{{lifted(from[0], to[1], periods[0]), lifted(from[1], to[0], periods[1])}, true};
  const auto length = [&](const Parameter_step& s) {
    return std::abs(s.to[0] - from[0]) + std::abs(s.to[1] - from[1]);
  };
  return length(crosswise) < length(straight) ? crosswise : straight;
}

/// Places where the arcs cross the line on which parameter k is u, by their samples; for a self-bisector either parameter.
/// A closed chain has a period, else 0.
inline std::size_t crossings(const locus::Locus<2>& l, std::size_t k, double u, const std::array<double, 2>& periods,
                             bool is_self, std::size_t samples)
{
  std::size_t count = 0;
  for (const auto& arc : l.arcs()) {
    std::vector<std::array<double, 2>> points;
    // Samples end at the cut radius, the arc at infinity.
    const auto add_end = [&](const std::optional<std::size_t>& v) {
      if (!v || l.vertices()[*v].kind != locus::Vertex_kind::infinity) return;
      const auto& feet = l.vertices()[*v].feet;
      points.push_back({feet[0].parameters[0].lo, feet[1].parameters[0].lo});
    };
    add_end(arc.source());
    for (const auto& q : arc.samples(samples)) points.push_back({q.parameter(0), q.parameter(1)});
    add_end(arc.target());
    for (std::size_t i = 1; i < points.size(); ++i) {
      const std::array<double, 2>& from = points[i - 1];
      const Parameter_step step = next_parameters(from, points[i], periods, is_self);
      for (std::size_t v = 0; v < 2; ++v) {
        if (v != k && !is_self) continue;
        for (const double line : {u - periods[v], u, u + periods[v]}) {
          count += (from[v] < line) != (step.to[v] < line);
          if (periods[v] == 0) break;
        }
      }
    }
  }
  return count;
}

/// A chain in long double.
class Real_chain {
public:
  explicit Real_chain(const Control_chain& c)
  {
    for (const Control_curve& p : c.pieces) pieces_.emplace_back(p);
    for (const Rational& u : c.breaks) breaks_.push_back(real_of(u));
  }

  /// Derivatives are by the local parameter of the piece that holds u; near a joint, of the piece on the side of `side`.
  Real_curve::Values at(Real u, Real side) const
  {
    std::size_t k = 0;
    const auto is_beyond = [&](Real joint) {
      return std::abs(u - joint) < 1e-12L * (1 + std::abs(u)) ? side > joint : u > joint;
    };
    while (k + 1 < pieces_.size() && is_beyond(breaks_[k + 1])) ++k;
    return pieces_[k].at((u - breaks_[k]) / (breaks_[k + 1] - breaks_[k]));
  }

private:
  std::vector<Real_curve> pieces_;
  std::vector<Real> breaks_;
};

/// Judges a result of curves of several pieces by their control points alone; collects what is wrong with it.
class Result_check {
public:
  /// `b` null: a self-bisector.
  Result_check(const locus::Locus<2>& l, const Control_chain& a, const Control_chain* b)
    : l_(l), counts_(a, b), reals_{Real_chain(a), Real_chain(b ? *b : a)}
  {
  }

  std::vector<std::string> problems;
  std::size_t lines = 0, walls = 0, samples = 0, diagonals = 0; ///< how much was looked at

  bool is_certified() const { return l_.status() == locus::Status::certified; }

  void check_samples(std::size_t n)
  {
    for (const auto& arc : l_.arcs()) {
      Real last_side = 0;
      const auto points = arc.samples(n);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& q = points[i];
        ++samples;
        const Complex z(q.point()[0], q.point()[1]);
        const auto& near = points[i > 0 ? i - 1 : i + 1]; // at a corner an arc has its own side's tangent
        const auto c = reals_[0].at(q.parameter(0), near.parameter(0)),
                   d = reals_[1].at(q.parameter(1), near.parameter(1));
        const Real one = std::abs(z - c.point), two = std::abs(z - d.point), error = static_cast<Real>(q.error()),
                   scale = static_cast<Real>(l_.scale());
        if (!std::isfinite(one) || !std::isfinite(two)) {
          complain("a sample that is not finite", q);
          continue;
        }
        if (is_self() && is_certified() && q.parameters()[0].hi < q.parameters()[1].lo)
          complain("a sample below the diagonal", q);
        if (error > 1e-4L * scale || one > 1e6L * scale) continue;
        const Real tolerance = 1e-8L * (scale + one) + 2 * error;
        if (std::abs(one - two) > tolerance || std::abs(one - static_cast<Real>(q.radius())) > tolerance)
          complain("unequal distances", q);
        for (const auto& [foot, tangent] : {std::pair(c.point, c.first), std::pair(d.point, d.first)})
          if (std::abs(tangent) > 1e-6L * scale && std::abs(dot(z - foot, tangent)) > tolerance * std::abs(tangent))
            complain("off a normal", q);
        if (i == 0 || i + 1 == points.size()) continue;
        // The circle lies to one side of the first curve all along an arc, for it could change only through infinity.
        const Complex e = d.point - c.point;
        const Real sine = cross(c.first, e) / (std::abs(c.first) * std::abs(e));
        const auto step = next_parameters({near.parameter(0), near.parameter(1)}, {q.parameter(0), q.parameter(1)},
                                          periods(), is_self());
        if (step.swapped) last_side = 0;
        if (!(std::abs(sine) > 1e-7L) || std::abs(e) < 1e-6L * scale) continue;
        if (is_certified() && last_side * sine < 0) complain("an arc through infinity", q);
        last_side = sine;
      }
    }
  }

  /// The line on which parameter k has the local value s on its piece i.
  void check_line(std::size_t k, std::size_t i, const Rational& s)
  {
    const auto count = counts_.on_line(k, i, s);
    if (!is_certified() || !count.clear) return;
    ++lines;
    const auto& breaks = counts_.chain(k).breaks;
    const Rational u = breaks[i] + s * (breaks[i + 1] - breaks[i]);
    std::size_t found = 0;
    for (const std::size_t n : {33u, 257u, 2049u}) {
      found = crossings(l_, k, u.get_d(), periods(), is_self(), n);
      if (found == count.roots) return;
    }
    problems.push_back("parameter " + std::to_string(k) + " = " + u.get_str() + ": " + std::to_string(count.roots) +
                       " zeros, " + std::to_string(found) + " crossings");
  }

  /// Vertices at the ends of the domain and at corners: as many as the equation has zeros there.
  void check_walls()
  {
    for (std::size_t k = 0; k < (is_self() ? 1u : 2u); ++k) {
      const Control_chain& c = counts_.chain(k);
      for (std::size_t joint = c.closed ? 1 : 0; joint <= c.size(); ++joint) {
        const bool is_end = !c.closed && (joint == 0 || joint == c.size());
        if (!is_end && !counts_.is_corner(k, joint)) continue;
        const auto count = counts_.on_wall(k, joint == c.size() && c.closed ? 0 : joint);
        if (!is_certified() || !count.clear) continue;
        ++walls;
        std::size_t found = 0;
        for (const auto& v : l_.vertices()) {
          bool here = false;
          for (std::size_t f = 0; f < 2; ++f) {
            if (!is_self() && f != k) continue;
            here = here || is_at(c, joint, v.feet[f].parameters[0]);
          }
          const bool both = is_self() && same_place(c, v.feet[0].parameters[0], v.feet[1].parameters[0]);
          if (!here || both) continue;
          ++found;
          const locus::Vertex_kind kind = is_end ? locus::Vertex_kind::boundary : locus::Vertex_kind::corner;
          if (v.kind != kind && v.kind != locus::Vertex_kind::infinity &&
              !(kind == locus::Vertex_kind::boundary && v.kind == locus::Vertex_kind::corner))
            problems.push_back("a vertex at " + c.breaks[joint].get_str() + " of kind " + locus::name_of(v.kind));
        }
        if (found != count.roots)
          problems.push_back("parameter " + std::to_string(k) + " = " + c.breaks[joint].get_str() + " (" +
                             (is_end ? "end" : "corner") + "): " + std::to_string(count.roots) + " zeros, " +
                             std::to_string(found) + " vertices");
      }
    }
  }

  /// Arcs that end on the diagonal.
  void check_diagonal()
  {
    if (!is_self() || !is_certified()) return;
    const auto count = counts_.near_diagonal();
    if (!count.clear) return;
    ++diagonals;
    std::size_t found = 0;
    for (const auto& arc : l_.arcs())
      for (const auto& end : {arc.source(), arc.target()})
        if (end && ends_on_diagonal(l_.vertices()[*end])) ++found;
    if (found != count.roots)
      problems.push_back("near the diagonal: " + std::to_string(count.roots) + " zeros, " + std::to_string(found) +
                         " ends");
  }

  void check_vertices()
  {
    for (std::size_t v = 0; v < l_.vertices().size(); ++v) {
      const auto& vertex = l_.vertices()[v];
      std::size_t degree = 0;
      for (const auto& arc : l_.arcs()) degree += (arc.source() == v) + (arc.target() == v);
      const std::string name = locus::name_of(vertex.kind);
      const auto &t = vertex.feet[0].parameters[0], &r = vertex.feet[1].parameters[0];
      const std::string place = " at (" + std::to_string(t.lo) + ", " + std::to_string(r.lo) + ")";
      if (is_certified() && vertex.kind == locus::Vertex_kind::undecided)
        problems.push_back("certified with an undecided vertex" + place);
      if (vertex.kind == locus::Vertex_kind::boundary && degree != 1)
        problems.push_back("a boundary vertex of degree " + std::to_string(degree) + place);
      if (vertex.kind == locus::Vertex_kind::corner && degree != 1)
        problems.push_back("a corner vertex of degree " + std::to_string(degree) + place);
      if (vertex.kind == locus::Vertex_kind::node && degree < 2)
        problems.push_back("a node of degree " + std::to_string(degree) + place);
      if (is_certified() && vertex.kind == locus::Vertex_kind::node && vertex.half_branches.size() != degree)
        problems.push_back("a node without its half-branches" + place);
      if (is_certified() && vertex.kind == locus::Vertex_kind::infinity && degree == 0)
        problems.push_back("infinity of degree " + std::to_string(degree) + place);
      if (vertex.kind == locus::Vertex_kind::isolated && degree != 0)
        problems.push_back("isolated of degree " + std::to_string(degree) + place);
      if (is_certified()) check_place(vertex, place);
      if (vertex.kind != locus::Vertex_kind::infinity) continue;
      bool is_pole = false;
      for (const Real side : {-1, 1}) // at a corner either tangent may be meant
        for (const Real other : {-1, 1}) {
          const double at[2] = {t.lo + (t.hi - t.lo) / 2, r.lo + (r.hi - r.lo) / 2};
          const auto c = reals_[0].at(at[0], at[0] + side), d = reals_[1].at(at[1], at[1] + other);
          const Complex e = d.point - c.point;
          const auto along = [&](const Complex& tangent) {
            return std::abs(cross(tangent, e)) <= 1e-6L * std::abs(tangent) * std::abs(e);
          };
          const bool crossing = std::abs(e) < 1e-9L * static_cast<Real>(l_.scale()) &&
                                std::abs(cross(c.first, d.first)) > 1e-3L * std::abs(c.first) * std::abs(d.first);
          const bool near = std::abs(c.first) < 1e-6L || std::abs(d.first) < 1e-6L || std::abs(e) < 1e-3L;
          is_pole = is_pole || (!crossing && (near || (along(c.first) && along(d.first))));
        }
      if (!is_pole) problems.push_back("infinity without a common tangent" + place);
    }
  }

  void check_all(Random& random, int number_of_lines)
  {
    check_vertices();
    check_samples(17);
    check_walls();
    check_diagonal();
    for (int i = 0; i < number_of_lines; ++i) {
      const auto k = static_cast<std::size_t>(random.below(is_self() ? 1 : 2));
      const auto piece = static_cast<std::size_t>(random.below(static_cast<int>(counts_.chain(k).size())));
      check_line(k, piece, Rational(random.between(1, 1022)) / 1023);
    }
  }

  std::string report() const
  {
    std::string text;
    for (const std::string& p : problems) text += (text.empty() ? "" : "; ") + p;
    return text;
  }

private:
  /// Boundaries, corners and the diagonal are where their vertices say.
  void check_place(const locus::Locus_vertex<2>& v, const std::string& place)
  {
    const std::array<locus::Range, 2> at{v.feet[0].parameters[0], v.feet[1].parameters[0]};
    bool ends = false, corners = false;
    for (std::size_t k = 0; k < 2; ++k) {
      const Control_chain& c = counts_.chain(k);
      for (std::size_t joint = 0; joint <= c.size(); ++joint) {
        if (!is_at(c, joint, at[k])) continue;
        if (!c.closed && (joint == 0 || joint == c.size())) ends = true;
        else corners = corners || counts_.is_corner(k, joint);
      }
    }
    const bool is_contact = is_self() && same_place(counts_.chain(0), at[0], at[1]);
    if (v.kind == locus::Vertex_kind::boundary && !ends) problems.push_back("a boundary vertex inside" + place);
    if (v.kind == locus::Vertex_kind::corner && !corners)
      problems.push_back("a corner vertex where there is none" + place);
    if (v.kind == locus::Vertex_kind::diagonal && !is_contact)
      problems.push_back("a diagonal vertex off the diagonal" + place);
  }

  bool is_self() const { return counts_.is_self(); }

  std::array<double, 2> periods() const
  {
    std::array<double, 2> p{};
    for (std::size_t k = 0; k < 2; ++k)
      if (counts_.chain(k).closed)
        p[k] = Rational(counts_.chain(k).breaks.back() - counts_.chain(k).breaks.front()).get_d();
    return p;
  }

  static bool is_at(const Control_chain& c, std::size_t joint, const locus::Range& u)
  {
    const auto same = [&](const Rational& x) {
      return Rational(u.lo) <= x && x <= Rational(u.hi) && u.hi - u.lo <= 1e-15 * std::abs(u.lo);
    };
    return same(c.breaks[joint]) || (c.closed && joint == c.size() && same(c.breaks[0]));
  }

  bool same_place(const Control_chain& c, const locus::Range& t, const locus::Range& r) const
  {
    const double period = Rational(c.breaks.back() - c.breaks.front()).get_d();
    const auto overlap = [&](double by) { return t.lo + by <= r.hi && r.lo <= t.hi + by; };
    return overlap(0) || (c.closed && (overlap(period) || overlap(-period)));
  }

  /// Where the curvature is zero an end on the diagonal lies at infinity.
  bool ends_on_diagonal(const locus::Locus_vertex<2>& v) const
  {
    const bool may_end = v.kind == locus::Vertex_kind::diagonal || v.kind == locus::Vertex_kind::infinity;
    return may_end && !is_corner(v) && same_place(counts_.chain(0), v.feet[0].parameters[0], v.feet[1].parameters[0]);
  }

  bool is_corner(const locus::Locus_vertex<2>& v) const { return v.feet[0].feature == locus::Feature::corner; }

  void complain(const std::string& what, const locus::Arc_point<2>& q)
  {
    if (problems.size() > 20) return;
    problems.push_back(what + " at (" + std::to_string(q.parameter(0)) + ", " + std::to_string(q.parameter(1)) + ")");
  }

  const locus::Locus<2>& l_;
  Exact_counts counts_;
  std::array<Real_chain, 2> reals_;
};

// ----------------------------------------------------------------------------------- random splines, and their guises

enum class Ends { open, closed, periodic };

/// Inner knots now and then stand more than once, control points now and then twice; open splines may be unclamped.
/// Closed ones end where they start, periodic ones are as smooth at the seam as at any knot.
inline Control_spline random_spline(Random& random, int degree, int spans, Coordinates kind, bool rational, Ends ends,
                                    bool repeated_knots)
{
  Control_spline s;
  s.degree = degree;
  const auto order = static_cast<std::size_t>(degree) + 1;
  if (ends == Ends::periodic) spans = std::max(spans, degree + 1);
  if (ends == Ends::closed && degree == 1) spans = std::max(spans, 3);
  if (ends == Ends::periodic || (ends == Ends::open && random.chance(20))) {
    for (int i = -degree; i <= spans + degree; ++i) s.knots.push_back(Rational(i));
  } else {
    s.knots.assign(order, Rational(0));
    Rational u = 0;
    for (int k = 1; k < spans; ++k) {
      u += random.chance(70) ? Rational(1) : Rational(random.between(1, 4)) / 2;
      s.knots.push_back(u);
      for (int m = 1; m < degree && repeated_knots && random.chance(40); ++m) s.knots.push_back(u);
    }
    s.knots.insert(s.knots.end(), order, Rational(u + 1));
  }
  for (std::size_t i = 0; i + order < s.knots.size(); ++i) {
    const Rational x = random_coordinate(random, kind), y = random_coordinate(random, kind);
    s.points.push_back({x, y});
    if (rational) s.weights.push_back(Rational(random.between(1, 8)) / 4);
  }
  if (ends == Ends::open) return s;
  const std::size_t n = s.points.size(), equal = ends == Ends::closed ? 1 : static_cast<std::size_t>(degree);
  for (std::size_t i = 0; i < equal; ++i) {
    s.points[n - equal + i] = s.points[i];
    if (rational) s.weights[n - equal + i] = s.weights[i];
  }
  s.closed = true;
  return s;
}

/// A chain written in another way, with the map of its parameter.
struct Chain_guise {
  std::string name;
  Control_chain chain;
  std::function<Rational(const Rational&)> parameter;
  bool as_one_spline = false;

  locus::Curve_2 build() const { return as_one_spline ? spline_of(chain).build() : chain.build(); }
};

inline Chain_guise random_guise(Random& random, const Control_chain& c)
{
  const auto same = [](const Rational& u) { return u; };
  const Rational lo = c.breaks.front(), period = c.breaks.back() - lo;
  switch (random.below(c.closed ? 8 : 6)) {
  case 0:
    return {"pieces one by one", c, same};
  case 1: {
    Control_chain cut = c;
    for (int k = random.between(1, 3); k > 0; --k)
      cut = with_cut_at(cut, Rational(lo + period * random.between(1, 63) / 64));
    return {"knots inserted", cut, same, random.chance(50)};
  }
  case 2:
    return {"elevated", elevated(c), same, random.chance(50)};
  case 3:
    return {"reversed", reversed(c), [](const Rational& u) { return Rational(-u); }, random.chance(50)};
  case 4: {
    const Rational k = Rational(random.between(1, 5)) / random.between(1, 5);
    return {"by a Moebius map", moebius(c, k), [c, k](const Rational& u) { return moebius_value(c, k, u); },
            random.chance(50)};
  }
  case 5:
    return {"as one spline", c, same, true};
  default: {
    Control_chain cut = random.chance(50) ? c : with_cut_at(c, Rational(lo + period * random.between(1, 31) / 32));
    const auto k = static_cast<std::size_t>(random.below(static_cast<int>(cut.size())));
    const Rational start = cut.breaks[k];
    return {"seam elsewhere", with_seam_before(cut, k),
            [start, period](const Rational& u) { return u < start ? Rational(u + period) : u; }, random.chance(50)};
  }
  }
}

/// A similarity that rationals carry out exactly.
struct Similarity {
  const char* name;
  std::array<Rational, 4> matrix;
  Exact_pair shift;
};

inline const std::vector<Similarity>& similarities()
{
  static const std::vector<Similarity> all{
    {"turned by (3/5, 4/5)", {Rational(3, 5), Rational(-4, 5), Rational(4, 5), Rational(3, 5)}, {0, 0}},
    {"reflected", {-1, 0, 0, 1}, {0, 0}},
    {"times 2^-70", {two_to(-70), 0, 0, two_to(-70)}, {0, 0}},
    {"times 2^91", {two_to(91), 0, 0, two_to(91)}, {0, 0}},
    {"moved", {1, 0, 0, 1}, {Rational(1000001, 7), -33}}};
  return all;
}

/// The numbers of a graph that do not depend on how many pieces the curves have.
inline Graph_numbers without_pieces(Graph_numbers g)
{
  for (auto& [kind, n] : g.degenerate) n = 1;
  return g;
}

/// The first vertex of `home` that has none of its kind in `there` at its mapped parameters, in words; nothing if all have.
template <class First, class Second>
std::string lost_vertex(const locus::Locus<2>& home, const locus::Locus<2>& there, First first, Second second,
                        const std::array<double, 2>& periods, bool is_self)
{
  for (const auto& v : home.vertices()) {
    const std::array<double, 2> at{first(Rational(v.feet[0].parameters[0].lo)).get_d(),
                                   second(Rational(v.feet[1].parameters[0].lo)).get_d()};
    bool found = false;
    for (const auto& w : there.vertices()) {
      std::array<double, 2> to{w.feet[0].parameters[0].lo, w.feet[1].parameters[0].lo};
      for (int order = 0; order < (is_self ? 2 : 1) && !found; ++order) {
        const Parameter_step step = next_parameters(at, to, periods, false);
        found = v.kind == w.kind && std::abs(step.to[0] - at[0]) + std::abs(step.to[1] - at[1]) <
                                      1e-6 * (1 + std::abs(at[0]) + std::abs(at[1]));
        std::swap(to[0], to[1]);
      }
    }
    if (!found)
      return std::string(locus::name_of(v.kind)) + " at (" + std::to_string(at[0]) + ", " + std::to_string(at[1]) +
             ") is lost";
  }
  return "";
}

// ------------------------------------------------------------------------------- what tests of bisectors of splines share

/// Tests must end whatever happens: far more cells than any of these curves needs.
inline locus::Bisector_options limited()
{
  locus::Bisector_options options;
  options.control.max_cells = 20000;
  return options;
}

inline bool is_certified(const locus::Locus<2>& l) { return l.status() == locus::Status::certified; }

inline std::size_t count(const locus::Locus<2>& l, locus::Vertex_kind kind)
{
  std::size_t n = 0;
  for (const auto& v : l.vertices()) n += v.kind == kind;
  return n;
}

/// The chain cut where the library cuts it, at cusps.
inline Control_chain cut_like(Control_chain chain, const locus::Curve_2& curve)
{
  for (const locus::Piece& p : curve.chain().pieces) chain = with_cut_at(std::move(chain), p.lo);
  return chain;
}

/// Whether a result passes all checks against exact counts of zeros, on that many lines: for features too fine for a grid.
inline bool agrees_with_exact_counts(const locus::Locus<2>& l, const Control_chain& first, const Control_chain* second)
{
  Random lines(97);
  Result_check check(l, first, second);
  check.check_all(lines, 200);
  return check.problems.empty() && check.lines >= 100;
}

/// How many results were looked at, and what was found.
struct Tally {
  std::size_t certified = 0, undecided = 0, refused = 0, lines = 0, walls = 0, diagonals = 0;
  std::map<std::string, std::size_t> reasons;

  void add(const locus::Locus<2>& l)
  {
    ++(is_certified(l) ? certified : undecided);
    for (const auto& u : l.undecided()) ++reasons[u.reason];
  }
  std::string text() const
  {
    std::string t = std::to_string(certified) + " certified, " + std::to_string(undecided) + " undecided, " +
                    std::to_string(refused) + " refused; " + std::to_string(lines) + " lines, " +
                    std::to_string(walls) + " walls, " + std::to_string(diagonals) + " diagonals";
    for (const auto& [reason, n] : reasons) t += "\n  " + std::to_string(n) + " " + reason;
    return t;
  }
};

/// Runs a check: what the library refuses is counted, and any other exception is a failure, described by `text`.
template <class Text, class Check>
void count_refusals(Samples& samples, Tally& tally, Text text, Check check)
{
  try {
    check();
  } catch (const locus::Invalid_input&) {
    ++tally.refused;
  } catch (const locus::Unsupported_feature&) {
    ++tally.refused;
  } catch (const std::exception& e) {
    const std::string what = e.what();
    samples.expect(false, [&] { return text(what); });
  }
}

inline Control_spline some_spline(Random& random, int highest_degree, int most_spans, Coordinates kind)
{
  const int degree = random.between(1, highest_degree), spans = random.between(1, most_spans);
  const Ends ends = random.chance(55) ? Ends::open : random.chance(45) ? Ends::closed : Ends::periodic;
  const bool rational = random.chance(25), repeated = random.chance(50);
  return random_spline(random, degree, spans, kind, rational, ends, repeated);
}

} // namespace locus_test

#endif
