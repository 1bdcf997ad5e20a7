// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_TEST_CURVE_SUPPORT_H
#define LOCUS_TEST_CURVE_SUPPORT_H

// What the tests of planar bisectors share: curves as control points with exact transformations, F3 evaluated straight
// from its definition (in rationals and in long double) without the library, and the graph of a result as plain numbers.

#include "support.h"

#include <locus/bisector_2.h>

#include <complex>
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

inline Homogeneous homogeneous(const Control_curve& c)
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

} // namespace locus_test

#endif
