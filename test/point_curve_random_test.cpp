// SPDX-License-Identifier: LGPL-3.0-or-later
// Bisectors of points and random curves against two oracles that share no code with the library: least distances decided
// exactly in rationals for samples of the result, and a dense search in doubles in many directions from the point.
#include <locus/construct/point_curve_bisector.h>

#include "support.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <iostream>
#include <map>
#include <optional>
#include <set>

using namespace locus;
using locus_test::choose;
using locus_test::Polynomial;
using locus_test::Random;

namespace {

using Vector = std::array<Rational, 2>;
using Plane_point = std::array<double, 2>;

Rational dot(const Vector& a, const Vector& b) { return Rational(a[0] * b[0] + a[1] * b[1]); }
Rational cross(const Vector& a, const Vector& b) { return Rational(a[0] * b[1] - a[1] * b[0]); }
Vector minus(const Vector& a, const Vector& b) { return {Rational(a[0] - b[0]), Rational(a[1] - b[1])}; }
Vector along(const Vector& a, const Rational& f, const Vector& b) { return {Rational(a[0] + f * b[0]), Rational(a[1] + f * b[1])}; }
bool is_null(const Vector& a) { return a[0] == 0 && a[1] == 0; }
double length(const Vector& a) { return std::hypot(a[0].get_d(), a[1].get_d()); }
double distance(const Plane_point& a, const Plane_point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }
Plane_point in_doubles(const Vector& a) { return {a[0].get_d(), a[1].get_d()}; }
template <class Point>
Vector exactly(const Point& p)
{
  return {Rational(p[0]), Rational(p[1])};
}

Rational fraction(long n, long d)
{
  Rational x(n, d);
  x.canonicalize();
  return x;
}

// ---------------------------------------------------------------------------------------------------------------- jobs

/// A curve and a point, with the code that makes the curve.
struct Job {
  Curve_2 curve;
  Vector point;
  std::string text;

  std::string show() const { return "p = {\"" + point[0].get_str() + "\", \"" + point[1].get_str() + "\"}, " + text; }
};

std::string quoted(const Rational& x) { return x.get_den() == 1 ? x.get_str() : "\"" + x.get_str() + "\""; }

template <class Items>
std::string listed(const Items& items)
{
  std::string text = "{";
  for (const Rational& x : items) text += (text.size() > 1 ? ", " : "") + quoted(x);
  return text + "}";
}

std::string listed_points(const std::vector<Vector>& points)
{
  std::string text = "{";
  for (const Vector& p : points) text += (text.size() > 1 ? ", " : "") + listed(p);
  return text + "}";
}

struct Named_curve {
  Curve_2 curve;
  std::string text;
};

Named_curve named_bezier(const std::vector<Vector>& points, const std::vector<Rational>& weights = {})
{
  return {bezier_curve<2>(points, weights), "bezier_2(" + listed_points(points) + (weights.empty() ? "" : ", " + listed(weights)) + ")"};
}

Named_curve named_spline(int degree, const std::vector<Vector>& points, const std::vector<Rational>& knots, const std::vector<Rational>& weights, bool closed)
{
  return {bspline_curve<2>(degree, points, knots, weights, closed), "bspline_2(" + std::to_string(degree) + ", " + listed_points(points) + ", " + listed(knots) + ", " +
                                                                      listed(weights) + (closed ? ", true)" : ", false)")};
}

Named_curve named_polyline(const std::vector<Vector>& points, bool closed)
{
  return {polyline_curve<2>(points, closed), "polyline_2(" + listed_points(points) + (closed ? ", true)" : ")")};
}

Named_curve named_monomial(const std::array<std::vector<Rational>, 2>& coordinates, const std::vector<Rational>& weight, const Parameter_domain& domain)
{
  const auto end = [](const std::optional<Rational>& x) { return x ? "Rational(" + quoted(*x) + ")" : std::string("std::nullopt"); };
  return {monomial_curve<2>(coordinates, weight, domain), "monomial_curve<2>({{" + listed(coordinates[0]) + ", " + listed(coordinates[1]) + "}}, " + listed(weight) + ", {" +
                                                            end(domain.lo) + ", " + end(domain.hi) + "})"};
}

/// Random curves with control points on a grid.
class Curve_maker {
public:
  explicit Curve_maker(Random& random) : random_(random) {}

  Named_curve curve()
  {
    const int kind = random_.below(100);
    if (kind < 30) return bezier(false);
    if (kind < 50) return bezier(true);
    if (kind < 78) return spline(random_.chance(30), random_.chance(35));
    if (kind < 84) return polyline();
    if (kind < 96) return monomial();
    return circular();
  }

  Vector grid_point() { return {fraction(random_.between(-8, 8), 4), fraction(random_.between(-8, 8), 4)}; }

  Rational weight()
  {
    const int k = random_.below(6);
    return k < 4 ? Rational(k + 1) : k == 4 ? Rational(1, 2) : Rational(3, 2);
  }

  Named_curve bezier(bool rational)
  {
    const int degree = rational ? random_.between(2, 5) : random_.between(1, 5);
    std::vector<Vector> points;
    std::vector<Rational> weights;
    for (int i = 0; i <= degree; ++i) {
      points.push_back(grid_point());
      if (rational) weights.push_back(weight());
    }
    if (random_.chance(8)) mirror(points, weights);
    return named_bezier(points, weights);
  }

  Named_curve spline(bool rational, bool closed)
  {
    const int degree = random_.between(1, rational ? 3 : 4), spans = random_.between(2, 8);
    std::vector<Rational> knots(static_cast<std::size_t>(degree) + 1, Rational(0));
    const int corners = random_.below(3); // none, some, all joints are C0
    for (int s = 1; s < spans; ++s) {
      const int times = corners == 2 || (corners == 1 && random_.chance(40)) ? degree : random_.chance(20) ? std::max(1, degree - 1) : 1;
      knots.insert(knots.end(), static_cast<std::size_t>(times), Rational(s));
    }
    knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, Rational(spans));
    const std::size_t count = knots.size() - static_cast<std::size_t>(degree) - 1;
    std::vector<Vector> points;
    std::vector<Rational> weights;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back(grid_point());
      if (rational) weights.push_back(weight());
    }
    if (closed) points.back() = points.front();
    return named_spline(degree, points, knots, weights, closed);
  }

  Named_curve polyline()
  {
    std::vector<Vector> points;
    for (int n = random_.between(2, 8); n > 0; --n) {
      Vector p = grid_point();
      while (!points.empty() && (p == points.back() || p == points.front())) p = grid_point();
      points.push_back(p);
    }
    return named_polyline(points, points.size() > 2 && random_.chance(50));
  }

  Named_curve monomial()
  {
    std::array<std::vector<Rational>, 2> x;
    const int degree = random_.between(1, 4);
    for (auto& c : x)
      for (int i = 0; i <= degree; ++i) c.push_back(fraction(random_.between(-4, 4), 2));
    std::vector<Rational> w;
    const int kind = random_.below(4);
    if (kind == 1) w = {Rational(1), Rational(0), fraction(random_.between(1, 4), 2)};
    if (kind == 2) w = {fraction(random_.between(-3, 3), 2), Rational(1)};
    if (kind == 3) w = locus_test::times({fraction(random_.between(-3, 3), 2), Rational(1)}, {fraction(random_.between(-3, 3), 2), Rational(1)});
    Parameter_domain domain;
    const int ends = random_.below(4);
    if (ends == 1 || ends == 3) domain.lo = fraction(random_.between(-4, 0), 2);
    if (ends == 2 || ends == 3) domain.hi = fraction(random_.between(1, 4), 2);
    return named_monomial(x, w, domain);
  }

  Named_curve circular()
  {
    const Vector c = grid_point();
    if (random_.chance(50)) {
      const Rational r = fraction(random_.between(1, 8), 4);
      return {circle_2({c[0], c[1]}, r), "circle_2(" + listed(c) + ", " + quoted(r) + ")"};
    }
    Vector d = grid_point();
    while (d == c) d = grid_point();
    const Rational bulge = fraction(random_.between(-8, 8), 4);
    return {arc_2({c[0], c[1]}, {d[0], d[1]}, bulge), "arc_2(" + listed(c) + ", " + listed(d) + ", " + quoted(bulge) + ")"};
  }

  /// Makes control points symmetric about x = 0.
  static void mirror(std::vector<Vector>& points, std::vector<Rational>& weights)
  {
    for (std::size_t i = 0, j = points.size() - 1; i <= j && j < points.size(); ++i, --j) {
      if (i == j) points[i][0] = 0;
      else points[j] = {Rational(-points[i][0]), points[i][1]};
      if (!weights.empty()) weights[j] = weights[i];
    }
  }

private:
  Random& random_;
};

/// The point of a piece at a local parameter; nothing at infinity.
std::optional<Vector> point_on(const Curve_piece<2>& piece, const Rational& s)
{
  const auto value = [&](const Bernstein<Rational, 1>& f) { return locus_test::plain_value<1>(f, {s}); };
  const Rational w = value(piece.weight);
  if (w == 0) return std::nullopt;
  return Vector{Rational(value(piece.numerator[0]) / w), Rational(value(piece.numerator[1]) / w)};
}

Job random_job(std::size_t number)
{
  Random random(0x50430000u + number);
  Curve_maker maker(random);
  for (;;) {
    try {
      const Named_curve named = maker.curve();
      Vector p{fraction(random.between(-20, 20), 8), fraction(random.between(-20, 20), 8)};
      const auto& pieces = named.curve.pieces();
      const Curve_piece<2>& piece = pieces[static_cast<std::size_t>(random.below(static_cast<int>(pieces.size())))];
      const int place = random.below(100);
      if (place < 8) {
        if (const auto on = point_on(piece, fraction(random.between(0, 8), 8))) p = *on;
      } else if (place < 12) {
        const auto k = static_cast<std::size_t>(random.below(static_cast<int>(piece.numerator[0].size())));
        const Rational w = piece.weight.size() == 1 ? piece.weight[0] : piece.weight[k];
        if (w != 0) p = {Rational(piece.numerator[0][k] / w), Rational(piece.numerator[1][k] / w)};
      } else if (place < 18) {
        p[0] = 0;
      }
      return {named.curve, p, named.text};
    } catch (const Invalid_input&) { // another one
    }
  }
}

// ------------------------------------------------------------------------------------------- a curve in plain rationals

Polynomial monomial_of(const Bernstein<Rational, 1>& f)
{
  const int n = f.degree();
  Polynomial a;
  for (int k = 0; k <= n; ++k) {
    Rational sum = 0;
    for (int i = 0; i <= k; ++i) sum += ((k - i) % 2 ? -1 : 1) * Rational(choose(k, i)) * f[static_cast<std::size_t>(i)];
    a.push_back(Rational(sum * choose(n, k)));
  }
  return locus_test::trimmed(a);
}

Polynomial scaled(Polynomial f, const Rational& x)
{
  for (Rational& c : f) c *= x;
  return locus_test::trimmed(f);
}

/// One piece relative to the point: (x, y)/w, with what the test of a circle needs of it in integers of one scale.
struct Plain_piece {
  Polynomial x, y, w;
  Piece range;
  std::vector<Integer> square, twice_x, twice_y; ///< x² + y², 2wx, 2wy, all of one length
  std::vector<Rational> hits;                     ///< where the point itself is
  std::vector<Rational> cusps;                    ///< where the curve stands still inside
  bool has_irrational_places = false;             ///< one of them at an irrational parameter

  Plain_piece(const Curve_piece<2>& piece, const Piece& on, const Vector& p) : w(monomial_of(piece.weight)), range(on)
  {
    x = locus_test::plus(monomial_of(piece.numerator[0]), scaled(w, Rational(-p[0])));
    y = locus_test::plus(monomial_of(piece.numerator[1]), scaled(w, Rational(-p[1])));
    const Polynomial forms[3] = {locus_test::plus(locus_test::times(x, x), locus_test::times(y, y)), scaled(locus_test::times(w, x), 2), scaled(locus_test::times(w, y), 2)};
    Integer denominator = 1;
    std::size_t size = 1;
    for (const auto& f : forms) {
      size = std::max(size, f.size());
      for (const Rational& c : f) denominator = lcm(denominator, c.get_den());
    }
    std::vector<Integer>* to[3] = {&square, &twice_x, &twice_y};
    for (int k = 0; k < 3; ++k) {
      for (const Rational& c : forms[k]) to[k]->push_back(Integer(c.get_num() * Integer(denominator / c.get_den())));
      to[k]->resize(size, Integer(0));
    }
    find_places(locus_test::euclid(x, y), true, hits);
    const auto velocity = [&](const Polynomial& f) {
      return locus_test::plus(locus_test::times(locus_test::slope(f), w), scaled(locus_test::times(f, locus_test::slope(w)), -1));
    };
    find_places(locus_test::euclid(velocity(x), velocity(y)), false, cusps);
  }

  Vector offset_at(const Rational& s) const { return {locus_test::horner(x, s), locus_test::horner(y, s)}; }
  Rational weight_at(const Rational& s) const { return locus_test::horner(w, s); }
  /// Along the curve, but not of its length; zero at a cusp.
  Vector tangent_at(const Rational& s) const
  {
    const Rational v = weight_at(s), dv = locus_test::horner(locus_test::slope(w), s);
    const Vector r = offset_at(s);
    return {Rational(locus_test::horner(locus_test::slope(x), s) * v - r[0] * dv), Rational(locus_test::horner(locus_test::slope(y), s) * v - r[1] * dv)};
  }

private:
  /// Rational places; inside, or at the ends as well.
  void find_places(const Polynomial& common, bool with_ends, std::vector<Rational>& places)
  {
    if (common.size() < 2) return;
    const auto note = [&](const Rational& s) {
      const bool is_inside = s > 0 && s < 1, is_there = is_inside || (with_ends && (s == 0 || s == 1));
      if (is_there && locus_test::horner(common, s) == 0 && std::find(places.begin(), places.end(), s) == places.end()) places.push_back(s);
    };
    if (common.size() == 2) {
      note(Rational(-common[0] / common[1]));
      return;
    }
    for (long d = 1; d <= 64; ++d)
      for (long n = 0; n <= d; ++n) note(fraction(n, d));
    const auto inside = std::count_if(places.begin(), places.end(), [](const Rational& s) { return s > 0 && s < 1; });
    has_irrational_places = has_irrational_places || locus_test::Sturm(common).open(0, 1) > inside;
  }
};

struct Plain_curve {
  std::vector<Plain_piece> pieces;
  bool closed = false;

  explicit Plain_curve(const Job& job) : closed(job.curve.chain().is_closed())
  {
    for (std::size_t i = 0; i < job.curve.pieces().size(); ++i) pieces.emplace_back(job.curve.pieces()[i], job.curve.chain().pieces[i], job.point);
  }
};

// --------------------------------------------------------------------------------------------- signs of a polynomial

/// f/(b·s - a) for a root a/b, in integers by Gauss's lemma.
std::vector<Integer> without_root(const std::vector<Integer>& f, const Rational& root)
{
  std::vector<Integer> q(f.size() - 1);
  Integer above = 0;
  for (std::size_t i = q.size(); i-- > 0;) {
    q[i] = (f[i + 1] + above * root.get_num()) / root.get_den();
    above = q[i];
  }
  return q;
}

/// Whether f ≥ 0 on [0, 1]: 1 yes, -1 no, with Bernstein coefficients of halves; 0 where that does not end.
int sign_by_halving(const std::vector<Integer>& c, int depth)
{
  std::size_t first = 0, last = c.size() - 1;
  while (first < last && c[first] == 0) ++first;
  while (last > first && c[last] == 0) --last;
  if (c[first] < 0 || c[last] < 0) return -1;
  if (std::all_of(c.begin(), c.end(), [](const Integer& x) { return x >= 0; })) return 1;
  if (depth == 0) return 0;
  std::vector<Integer> low, high(c.size()), row = c;
  const std::size_t n = c.size() - 1;
  for (std::size_t k = 0;; ++k) {
    low.push_back(row[0] << static_cast<unsigned>(n - k));
    high[n - k] = row[n - k] << static_cast<unsigned>(n - k);
    if (k == n) break;
    for (std::size_t i = 0; i + k < n; ++i) row[i] += row[i + 1];
  }
  const int a = sign_by_halving(low, depth - 1);
  if (a < 0) return a;
  const int b = sign_by_halving(high, depth - 1);
  return b < 0 ? b : std::min(a, b);
}

std::vector<Integer> bernstein_integers(const std::vector<Integer>& f)
{
  const int n = static_cast<int>(f.size()) - 1;
  Integer scale = 1;
  for (int j = 0; j <= n; ++j) scale = lcm(scale, choose(n, j));
  std::vector<Integer> c(f.size(), Integer(0));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= i; ++j) c[static_cast<std::size_t>(i)] += Integer(scale / choose(n, j)) * choose(i, j) * f[static_cast<std::size_t>(j)];
  return c;
}

/// By Sturm's theorem: signs between all roots.
bool is_nonnegative_by_roots(std::vector<Integer> f)
{
  while (f.size() > 1 && f[0] == 0) f = without_root(f, 0);
  for (Integer sum = 0; f.size() > 1; sum = 0) {
    for (const Integer& c : f) sum += c;
    if (sum != 0) break;
    f = without_root(f, 1);
    for (Integer& c : f) c = -c;
  }
  const Polynomial g = locus_test::trimmed(Polynomial(f.begin(), f.end()));
  if (g.size() < 2) return g.empty() || g[0] >= 0;
  const locus_test::Sturm sturm(g);
  std::vector<std::pair<Rational, Rational>> open{{Rational(0), Rational(1)}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    if (locus_test::horner(g, a) < 0 || locus_test::horner(g, b) < 0) return false;
    if (sturm.open(a, b) < 2) continue; // between positive ends one root is of even multiplicity
    Rational middle = (a + b) / 2;
    while (sturm.is_root(middle)) middle = Rational((middle + b) / 2);
    open.push_back({a, middle});
    open.push_back({middle, b});
  }
  return true;
}

struct Nearness {
  std::size_t by_roots = 0;

  /// Whether no point of the piece is nearer to p + q than p, `doubles`: places at which one may be as near.
  bool is_empty(const Plain_piece& piece, const Vector& q, const std::vector<Rational>& doubles)
  {
    const Integer w = lcm(q[0].get_den(), q[1].get_den());
    const Integer x = Integer(q[0].get_num() * Integer(w / q[0].get_den())), y = Integer(q[1].get_num() * Integer(w / q[1].get_den()));
    std::vector<Integer> f(piece.square.size());
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = Integer(w * piece.square[i] - x * piece.twice_x[i] - y * piece.twice_y[i]);
    for (const Rational& s : doubles) {
      if (s == 0 || s == 1 || locus_test::sign_at(f, s) != 0) continue; // zeros at ends are no trouble
      const std::vector<Integer> once = without_root(f, s);
      if (once.size() > 1 && locus_test::sign_at(once, s) == 0) f = without_root(once, s);
    }
    if (std::all_of(f.begin(), f.end(), [](const Integer& c) { return c == 0; })) return true;
    const int sign = sign_by_halving(bernstein_integers(f), 24);
    if (sign != 0) return sign > 0;
    ++by_roots;
    return is_nonnegative_by_roots(f);
  }
};

// ---------------------------------------------------------------------------------------------------- a dense search

/// A part of a piece in doubles, from a place where the point is, or which is nearest to it, at t = 0.
struct Dense_part {
  std::vector<double> x, y, w;
  std::vector<double> t;       ///< sampled places, growing
  std::vector<Plane_point> g;  ///< 2r/|r|² there
  std::vector<double> angles;  ///< of r

  static double value(const std::vector<double>& f, double t)
  {
    double sum = 0;
    for (std::size_t i = f.size(); i-- > 0;) sum = sum * t + f[i];
    return sum;
  }
  Plane_point inverted(double at) const
  {
    const double a = value(x, at), b = value(y, at), f = 2 * value(w, at) / (a * a + b * b);
    return {f * a, f * b};
  }
};

/// The support function of the inverted curve: in the direction θ the cell reaches 1/max(g·e).
class Dense_search {
public:
  Dense_search(const Plain_curve& curve, double scale)
  {
    const int n = curve.pieces.size() > 4 ? 96 : 192;
    for (const Plain_piece& piece : curve.pieces) {
      std::vector<Rational> cuts = piece.hits;
      for (const Rational& s : near_places(piece, scale)) cuts.push_back(s);
      std::sort(cuts.begin(), cuts.end());
      cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
      if (cuts.empty()) add_part(piece, 0, 1, false, n);
      for (std::size_t k = 0; k < cuts.size(); ++k) {
        const Rational low = k == 0 ? Rational(0) : Rational((cuts[k - 1] + cuts[k]) / 2), high = k + 1 == cuts.size() ? Rational(1) : Rational((cuts[k] + cuts[k + 1]) / 2);
        if (low < cuts[k]) add_part(piece, cuts[k], low, true, n);
        if (cuts[k] < high) add_part(piece, cuts[k], high, true, n);
      }
    }
  }

  /// How far the cell reaches; infinite where it is not bounded.
  double reach(double angle, bool finely = false) const
  {
    const Plane_point e{std::cos(angle), std::sin(angle)};
    if (finely) {
      double best = 0;
      for (const Dense_part& part : parts_)
        for (std::size_t i = 0; i + 1 < part.t.size(); ++i)
          for (int k = 0; k <= 200; ++k) {
            const Plane_point g = part.inverted(part.t[i] + k / 200.0 * (part.t[i + 1] - part.t[i]));
            best = std::max(best, g[0] * e[0] + g[1] * e[1]);
          }
      return best > 0 ? 1 / best : std::numeric_limits<double>::infinity();
    }
    std::vector<std::size_t> places;
    std::vector<double> values;
    double best = 0;
    for (const Dense_part& part : parts_) {
      std::size_t at = 0;
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < part.g.size(); ++i) {
        const double v = part.g[i][0] * e[0] + part.g[i][1] * e[1];
        if (v > most) {
          most = v;
          at = i;
        }
      }
      places.push_back(at);
      values.push_back(most);
      best = std::max(best, most);
    }
    double refined = best;
    for (std::size_t k = 0; k < parts_.size(); ++k)
      if (values[k] > 0.8 * best - 1e-3) refined = std::max(refined, around(parts_[k], places[k], e));
    return refined > 0 ? 1 / refined : std::numeric_limits<double>::infinity();
  }

  /// Whether the curve passes the point at less than 2^-20 of its size, but not through it.
  bool is_near() const { return is_near_; }

  /// The greatest angle seen from the point without the curve: bounded where it is less than π.
  double widest_gap() const
  {
    std::vector<double> angles;
    for (const Dense_part& part : parts_) angles.insert(angles.end(), part.angles.begin(), part.angles.end());
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 2 * std::acos(-1) - angles.back();
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) gap = std::max(gap, angles[i + 1] - angles[i]);
    return gap;
  }

  /// How far the cell of a point on the curve reaches along a normal, given exactly.
  double reach_along(const Vector& normal) const
  {
    double best = 0;
    for (const Exact_part& part : exact_parts_) {
      Polynomial above = scaled(locus_test::times(part.w, locus_test::plus(scaled(part.x, normal[0]), scaled(part.y, normal[1]))), 2);
      Polynomial below = locus_test::plus(locus_test::times(part.x, part.x), locus_test::times(part.y, part.y));
      while (!above.empty() && above[0] == 0 && below[0] == 0) {
        above.erase(above.begin());
        below.erase(below.begin());
      }
      if (above.empty()) continue;
      if (below[0] == 0) { // the normal is no normal of this branch
        if (above[0] > 0) return 0;
      } else {
        best = std::max(best, Rational(above[0] / below[0]).get_d());
      }
      const auto in_double = [](const Polynomial& f) {
        std::vector<double> d;
        for (const Rational& c : f) d.push_back(c.get_d());
        return d;
      };
      const std::vector<double> a = in_double(above), b = in_double(below);
      constexpr int n = 4000;
      const auto quotient = [&](double t) { return Dense_part::value(a, t) / Dense_part::value(b, t); };
      int most = 1;
      for (int i = 1; i <= n; ++i)
        if (quotient(static_cast<double>(i) / n) > quotient(static_cast<double>(most) / n)) most = i;
      double lo = (most - 1.0) / n, hi = std::min(1.0, (most + 1.0) / n); // between its neighbours, by thirds
      best = std::max(best, quotient(static_cast<double>(most) / n));
      for (int k = 0; k < 60 && quotient(static_cast<double>(most) / n) > 0; ++k) {
        const double c = lo + (hi - lo) / 3, d = hi - (hi - lo) / 3;
        best = std::max({best, quotient(c), quotient(d)});
        (quotient(c) < quotient(d) ? lo : hi) = quotient(c) < quotient(d) ? c : d;
      }
    }
    return best > 0 ? length(normal) / best : std::numeric_limits<double>::infinity();
  }

private:
  struct Exact_part {
    Polynomial x, y, w;
  };

  /// s = from + t·(to - from).
  void add_part(const Plain_piece& piece, const Rational& from, const Rational& to, bool near, int n)
  {
    const auto on_part = [&](const Polynomial& f) { return locus_test::compose_linear(f, from, Rational(to - from)); };
    const Exact_part exact{on_part(piece.x), on_part(piece.y), on_part(piece.w)};
    exact_parts_.push_back(exact);
    Dense_part part;
    const auto in_double = [](const Polynomial& f) {
      std::vector<double> d;
      for (const Rational& c : f) d.push_back(c.get_d());
      return d;
    };
    part.x = in_double(exact.x);
    part.y = in_double(exact.y);
    part.w = in_double(exact.w);
    std::vector<double> places{0};
    if (near)
      for (int k = 400; k >= 29; --k) places.push_back(std::exp2(-0.1 * k - std::log2(n)));
    for (int i = 1; i <= n; ++i) places.push_back(static_cast<double>(i) / n);
    for (const double t : places) {
      const double a = Dense_part::value(part.x, t), b = Dense_part::value(part.y, t);
      if (a == 0 && b == 0) continue;
      part.t.push_back(t);
      part.g.push_back(part.inverted(t));
      part.angles.push_back(std::atan2(b, a));
    }
    parts_.push_back(std::move(part));
  }

  /// Where a piece passes the point closely.
  std::vector<Rational> near_places(const Plain_piece& piece, double scale)
  {
    constexpr int n = 128;
    std::vector<double> x, y, w;
    for (const Rational& c : piece.x) x.push_back(c.get_d());
    for (const Rational& c : piece.y) y.push_back(c.get_d());
    for (const Rational& c : piece.w) w.push_back(c.get_d());
    const auto derivative_at = [](const std::vector<double>& f, double s) {
      double sum = 0;
      for (std::size_t i = f.size(); i-- > 1;) sum = sum * s + static_cast<double>(i) * f[i];
      return sum;
    };
    const auto slope = [&](double s) {
      const double a = Dense_part::value(x, s), b = Dense_part::value(y, s), v = Dense_part::value(w, s);
      return (a * derivative_at(x, s) + b * derivative_at(y, s)) * v - (a * a + b * b) * derivative_at(w, s);
    };
    std::vector<Rational> places;
    for (const double end : {0.0, 1.0}) {
      const double v = Dense_part::value(w, end), r = std::hypot(Dense_part::value(x, end), Dense_part::value(y, end));
      is_near_ = is_near_ || (r > 0 && r < 0x1p-20 * scale * v);
    }
    for (int i = 0; i < n; ++i) {
      double low = static_cast<double>(i) / n, high = static_cast<double>(i + 1) / n;
      if (!(slope(low) < 0 && slope(high) >= 0)) continue;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (slope(middle) < 0 ? low : high) = middle;
      }
      const double v = Dense_part::value(w, low), r = std::hypot(Dense_part::value(x, low), Dense_part::value(y, low));
      const bool is_hit = std::any_of(piece.hits.begin(), piece.hits.end(), [&](const Rational& h) { return std::abs(h.get_d() - low) < 1e-6; });
      is_near_ = is_near_ || (r < 0x1p-20 * scale * v && !is_hit);
      if (r < 0.05 * scale * v && low > 0 && low < 1 && !is_hit) places.emplace_back(low);
    }
    return places;
  }

  static double around(const Dense_part& part, std::size_t at, const Plane_point& e)
  {
    const auto f = [&](double t) {
      const Plane_point g = part.inverted(t);
      const double v = g[0] * e[0] + g[1] * e[1];
      return std::isnan(v) ? -std::numeric_limits<double>::infinity() : v;
    };
    double a = part.t[at == 0 ? 0 : at - 1], b = part.t[std::min(at + 1, part.t.size() - 1)];
    constexpr double ratio = 0.6180339887498949;
    double c = b - ratio * (b - a), d = a + ratio * (b - a), fc = f(c), fd = f(d);
    for (int k = 0; k < 30; ++k) {
      if (fc > fd) {
        b = d;
        d = c;
        fd = fc;
        c = b - ratio * (b - a);
        fc = f(c);
      } else {
        a = c;
        c = d;
        fc = fd;
        d = a + ratio * (b - a);
        fd = f(d);
      }
    }
    return std::max({fc, fd, f(part.t[at])});
  }

  std::vector<Dense_part> parts_;
  std::vector<Exact_part> exact_parts_;
  bool is_near_ = false;
};

// -------------------------------------------------------------------------------------------------------- the checks

/// What became of the jobs.
struct Report {
  std::size_t jobs = 0, unsupported = 0, exact_samples = 0, directions = 0, skipped = 0, by_roots = 0, far = 0, undecided = 0, problems = 0, regions = 0, unbounded = 0, on_curve = 0;
  double seconds = 0, slowest = 0;
  std::map<std::string, std::size_t> kinds;
  std::string first;

  void say(const std::string& kind, const std::string& what)
  {
    ++kinds[kind];
    std::cerr << kind << ' ' << what << std::endl;
    if (problems++ == 0) first = kind + ' ' + what;
  }

  std::string text() const
  {
    std::ostringstream out;
    out << jobs << " jobs (" << unsupported << " unsupported, " << undecided << " undecided, " << on_curve << " with the point on the curve, " << regions << " with a region, " << unbounded << " unbounded, " << far << " arcs far away or about a point next to the curve drawn roughly), " << exact_samples
        << " samples tested exactly (" << by_roots << " by Sturm's theorem, " << skipped << " skipped), " << directions << " directions searched, " << problems << " problems; library " << seconds
        << " s, slowest " << slowest << " s";
    for (const auto& [kind, n] : kinds) out << "\n  " << kind << ": " << n;
    return out.str();
  }
};

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Checker {
public:
  Checker(const Job& job, const Locus<2>& result, const std::string& name, Report& report)
    : job_(job), result_(result), name_(name), report_(report), curve_(job), search_(curve_, result.scale())
  {
  }

  void run()
  {
    find_place();
    if (result_.status() != Status::certified) {
      ++report_.undecided;
      say("UNDECIDED", result_.undecided()[0].reason);
    }
    check_structure();
    check_samples();
    check_directions();
    check_feet();
    report_.by_roots += nearness_.by_roots;
  }

private:
  /// One failure of a kind for each job.
  void say(const std::string& kind, const std::string& what)
  {
    if (said_.insert(kind).second) report_.say(kind, name_ + ": " + what + "; " + job_.show());
  }

  static std::string show(const Plane_point& p) { return "(" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ")"; }
  static std::string show(double x)
  {
    std::ostringstream out;
    out.precision(17);
    out << x;
    return out.str();
  }

  // ------------------------------------------------------------------------------------------- where the point is

  /// The direction in which a piece leaves one of its places: with the parameter, or against it.
  static Vector way_from(const Plain_piece& piece, const Rational& s, bool backwards)
  {
    // Of x·w(s) - x(s)·w the first coefficient about the place.
    const auto about = [&](const Polynomial& f) { return locus_test::compose_linear(f, s, Rational(backwards ? -1 : 1)); };
    const Polynomial x = about(piece.x), y = about(piece.y), w = about(piece.w);
    const auto at = [](const Polynomial& f, std::size_t k) { return k < f.size() ? f[k] : Rational(0); };
    for (std::size_t k = 1; k < std::max({x.size(), y.size(), w.size()}); ++k) {
      const Vector way{Rational(at(x, k) * at(w, 0) - at(x, 0) * at(w, k)), Rational(at(y, k) * at(w, 0) - at(y, 0) * at(w, k))};
      if (!is_null(way)) return way;
    }
    return {Rational(0), Rational(0)};
  }

  /// The direction of a piece at one of its ends, along the curve.
  static Vector direction_at(const Plain_piece& piece, int end)
  {
    const Vector way = way_from(piece, Rational(end), end == 1);
    return end == 1 ? Vector{Rational(-way[0]), Rational(-way[1])} : way;
  }

  static bool is_one_direction(const Vector& a, const Vector& b) { return cross(a, b) == 0 && dot(a, b) > 0; }

  void find_place()
  {
    const std::size_t n = curve_.pieces.size();
    for (std::size_t i = 0; i < n; ++i)
      for (const Rational& s : curve_.pieces[i].hits) {
        is_hit_ = true;
        if (s > 0 && s < 1) {
          const Vector on = way_from(curve_.pieces[i], s, false), back = way_from(curve_.pieces[i], s, true);
          if (is_one_direction(on, {Rational(-back[0]), Rational(-back[1])})) smooth_.push_back(on);
          continue;
        }
        const int end = s == 0 ? 0 : 1;
        const bool has_next = curve_.closed || (end == 1 ? i + 1 < n : i > 0);
        if (!has_next) continue;
        const std::size_t next = end == 1 ? (i + 1) % n : (i + n - 1) % n;
        const Vector a = direction_at(curve_.pieces[i], end), b = direction_at(curve_.pieces[next], 1 - end);
        if (is_one_direction(a, b)) smooth_.push_back(a);
      }
    for (const Vector& t : smooth_) is_alone_ = is_alone_ || cross(t, smooth_[0]) != 0;
    report_.on_curve += is_hit_;
  }

  // --------------------------------------------------------------------------------------------- how arcs join

  std::optional<std::size_t> end_of(std::size_t k, bool last) const
  {
    const auto& outline = *result_.outline();
    const auto& arc = result_.arcs()[outline.arcs[k]];
    return last != static_cast<bool>(outline.reversed[k]) ? arc.target() : arc.source();
  }

  void check_structure()
  {
    if (result_.arcs().empty()) {
      if (!is_alone_ && smooth_.empty() && !is_hit_) say("NO ARCS", "nothing found");
      if (result_.vertices().size() != 1) say("NO ARCS", "and no isolated point");
      return;
    }
    if (is_alone_) say("ALONE", "the point is on two branches, but there are arcs");
    const bool expects_region = is_hit_ && smooth_.empty();
    report_.regions += expects_region;
    if (result_.regions().size() != (expects_region ? 1u : 0u)) say("REGION", std::to_string(result_.regions().size()) + " regions");
    if (!result_.outline()) {
      say("OUTLINE", "none");
      return;
    }
    const auto& outline = *result_.outline();
    report_.unbounded += !outline.bounded;
    std::set<std::size_t> used(outline.arcs.begin(), outline.arcs.end());
    if (used.size() != outline.arcs.size() || used.size() != result_.arcs().size()) say("OUTLINE", "not each arc once");
    for (const auto& arc : result_.arcs()) {
      polylines_.push_back(arc.polyline(1e-5));
      double farthest = result_.scale();
      for (const auto& sample : polylines_.back()) farthest = std::max(farthest, distance(plane(sample), in_doubles(job_.point)));
      const bool is_rough = !(polylines_.back().error() <= 1e-4 * farthest), is_far = farthest > 1e4 * result_.scale() || search_.is_near();
      report_.far += is_rough && is_far;
      if (is_rough && !is_far) say("POOR", "polyline error " + show(polylines_.back().error()) + " with " + std::to_string(polylines_.back().size()) + " points, as far as " + show(farthest));
    }
    std::size_t gaps = 0;
    const std::size_t n = outline.arcs.size();
    for (std::size_t k = 0; k < n; ++k) {
      const auto& arc = result_.arcs()[outline.arcs[k]];
      if (arc.is_closed()) {
        if (n != 1) say("OUTLINE", "a closed arc among others");
        continue;
      }
      const auto a = end_of(k, true), b = end_of((k + 1) % n, false);
      if (a == b && (n > 1 || smooth_.empty())) {
        if (result_.vertices()[*a].kind != Vertex_kind::trim) say("VERTEX", "joined at one of the kind " + std::string(name_of(result_.vertices()[*a].kind)));
      } else {
        ++gaps;
        for (const auto v : {*a, *b})
          if (result_.vertices()[v].kind != Vertex_kind::infinity && smooth_.empty()) say("VERTEX", "loose, of the kind " + std::string(name_of(result_.vertices()[v].kind)));
      }
      for (const bool last : {false, true}) {
        const auto& v = result_.vertices()[*end_of(k, last)];
        const auto& line = polylines_[outline.arcs[k]];
        if (v.kind == Vertex_kind::infinity || !v.point) continue;
        const auto& p = (last != static_cast<bool>(outline.reversed[k]) ? line[line.size() - 1] : line[0]).point();
        const double off = distance({p[0], p[1]}, {(*v.point)[0], (*v.point)[1]});
        const auto& neighbour = polylines_[outline.arcs[last ? (k + 1) % n : (k + n - 1) % n]];
        if (!(off <= 2 * std::max(line.error(), neighbour.error()) + 1e-9 * result_.scale())) say("VERTEX", "an arc ends " + show(off) + " from its vertex");
      }
    }
    if (smooth_.empty() && outline.bounded != (gaps == 0)) say("BOUNDED", std::to_string(gaps) + " gaps, bounded " + std::to_string(outline.bounded));
    if (smooth_.empty()) {
      const double gap = search_.widest_gap(), half = std::acos(-1);
      if (std::abs(gap - half) > 1e-3 && (gap < half) != outline.bounded) say("BOUNDED", "the curve leaves free an angle of " + show(gap));
    } else if (!is_alone_) {
      const Vector normal{Rational(-smooth_[0][1]), smooth_[0][0]}, other{Rational(-normal[0]), Rational(-normal[1])};
      const bool bounded = std::isfinite(search_.reach_along(normal)) && std::isfinite(search_.reach_along(other));
      if (bounded != outline.bounded) say("BOUNDED", "on the normal, " + std::to_string(outline.bounded));
    }
  }

  // ------------------------------------------------------------------------------------------------- exact samples

  /// The exact point, relative to p, of a foot on a piece.
  static std::optional<Vector> centre_at(const Plain_piece& piece, const Rational& s)
  {
    const Rational w = piece.weight_at(s);
    const Vector t = piece.tangent_at(s), n{Rational(-t[1]), t[0]};
    Vector r = piece.offset_at(s);
    const Rational across = dot(n, r);
    if (w == 0 || across == 0) return std::nullopt;
    r = {Rational(r[0] / w), Rational(r[1] / w)};
    return along(r, Rational(-dot(r, r) * w / (2 * across)), n);
  }

  struct Foot_place {
    std::size_t piece;
    Rational s;
  };

  /// Local parameters inside the printed enclosure: two at a joint.
  std::vector<Foot_place> places_of(const Range& range) const
  {
    std::vector<Foot_place> places;
    for (std::size_t i = 0; i < curve_.pieces.size(); ++i) {
      const Piece& piece = curve_.pieces[i].range;
      if (std::isinf(range.lo) && std::isinf(range.hi)) {
        if (range.lo > 0 && piece.hi_infinite) places.push_back({i, Rational(1)});
        if (range.lo < 0 && piece.lo_infinite) places.push_back({i, Rational(0)});
        continue;
      }
      if (std::isinf(range.lo) || std::isinf(range.hi)) return {};
      Rational low(range.lo), high(range.hi);
      if (!piece.lo_infinite) low = std::max(low, piece.lo);
      if (!piece.hi_infinite) high = std::min(high, piece.hi);
      if (low <= high) places.push_back({i, piece.local(Rational((low + high) / 2))});
    }
    return places;
  }

  /// The one whose point is nearest to the printed one.
  std::optional<Foot_place> place_of(const Arc_point<2>& sample) const
  {
    std::optional<Foot_place> best;
    double least = 0;
    for (const Foot_place& place : places_of(sample.parameters()[0])) {
      const auto q = centre_at(curve_.pieces[place.piece], place.s);
      if (!q) continue;
      const double off = length(minus(along(job_.point, 1, *q), exactly(sample.point())));
      if (best && off >= least) continue;
      best = place;
      least = off;
    }
    return best;
  }

  /// How far the exact point moves within the printed enclosure of its parameter.
  double spread(const Foot_place& place, const Range& range, const Vector& q) const
  {
    double most = 0;
    const Plain_piece& piece = curve_.pieces[place.piece];
    if (range.lo == range.hi) return 0;
    for (const double u : {range.lo, range.hi}) {
      if (!piece.range.contains(Rational(u))) continue;
      const auto other = centre_at(piece, piece.range.local(Rational(u)));
      if (other) most = std::max(most, length(minus(*other, q)));
    }
    return most;
  }

  void expect_empty(const Vector& q, const std::vector<Rational>& places, const std::string& what)
  {
    ++report_.exact_samples;
    for (std::size_t i = 0; i < curve_.pieces.size(); ++i) {
      std::vector<Rational> doubles = places;
      doubles.insert(doubles.end(), curve_.pieces[i].hits.begin(), curve_.pieces[i].hits.end());
      if (!nearness_.is_empty(curve_.pieces[i], q, doubles)) {
        const Vector at = along(job_.point, 1, q);
        say("NEARER", what + ": piece " + std::to_string(i) + " is nearer to " + show(in_doubles(at)) + " than the point");
        return;
      }
    }
  }

  void expect_printed(const Arc_point<2>& printed, const Vector& q, double more, const std::string& what)
  {
    const Vector exact = along(job_.point, 1, q);
    const double off = length(minus(exact, exactly(printed.point())));
    if (!(off <= printed.error() + more * 1.001)) say("PRINTED", what + ": off by " + show(off) + ", error " + show(printed.error()) + " and " + show(more));
    if (!(std::abs(length(q) - printed.radius()) <= printed.error() + more + 1e-15 * result_.scale())) say("RADIUS", what + ": " + show(printed.radius()) + " for " + show(length(q)));
  }

  void check_arc(const Arc<2>& arc, bool reversed)
  {
    const auto samples = arc.samples(5);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const auto& sample = samples[reversed ? samples.size() - 1 - k : k];
      const Range& range = sample.parameters()[0];
      const auto place = place_of(sample);
      const auto q = place ? centre_at(curve_.pieces[place->piece], place->s) : std::nullopt;
      if (!q) {
        ++report_.skipped;
        continue;
      }
      const std::string what = "foot at " + show(range.lo);
      expect_printed(sample, *q, spread(*place, range, *q), what);
      if (k == 0 || k + 1 == samples.size()) continue; // a double next to an end may lie a little beyond it
      expect_empty(*q, {place->s, Rational(1 - place->s)}, what);
      outline_points_.push_back(*q);
    }
  }

  /// Samples of a straight arc, projected on its exact line a + λ·d, relative to p.
  void check_line(const Arc<2>& arc, bool reversed, const Vector& a, const Vector& d)
  {
    const auto samples = arc.samples(5);
    const double extent = distance(plane(samples.front()), plane(samples.back()));
    for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
      const auto& sample = samples[reversed ? samples.size() - 1 - k : k];
      if (!(extent > 1e4 * sample.error())) {
        ++report_.skipped;
        continue;
      }
      const Vector printed = minus(exactly(sample.point()), job_.point);
      const Vector q = along(a, Rational(dot(minus(printed, a), d) / dot(d, d)), d);
      expect_empty(q, {}, "on a line");
      expect_printed(sample, q, 0, "on a line");
      outline_points_.push_back(q);
    }
  }

  static Plane_point plane(const Arc_point<2>& p) { return {p.point()[0], p.point()[1]}; }

  /// The end or corner that an arc belongs to.
  void check_vertex_arc(const Arc<2>& arc, bool reversed)
  {
    const auto middle = arc.at(0.5);
    const Range range = middle.parameters()[0];
    const Vector printed = minus(exactly(middle.point()), job_.point);
    std::optional<std::pair<Vector, Vector>> best;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Plain_piece& piece, const Rational& s) {
      const Rational w = piece.weight_at(s);
      if (w == 0) return;
      std::vector<Vector> normals;
      Vector r = piece.offset_at(s);
      if (is_null(r)) {
        for (const bool backwards : {false, true}) {
          const Vector t = way_from(piece, s, backwards);
          if (backwards ? s > 0 : s < 1) normals.push_back({Rational(-t[1]), t[0]});
        }
      } else {
        r = {Rational(r[0] / (2 * w)), Rational(r[1] / (2 * w))};
        normals.push_back({Rational(-r[1]), r[0]});
      }
      for (const Vector& d : normals) {
        const double off = std::abs(Rational(cross(minus(printed, r), d)).get_d()) / length(d);
        if (off >= least) continue;
        least = off;
        best = {r, d};
      }
    };
    for (const Plain_piece& piece : curve_.pieces) {
      for (int end = 0; end < 2; ++end) {
        if (end == 0 ? piece.range.lo_infinite : piece.range.hi_infinite) {
          if (std::isinf(range.lo) && (range.lo > 0) == (end == 1)) consider(piece, Rational(end));
        } else {
          const Rational u = end == 0 ? piece.range.lo : piece.range.hi;
          if (!std::isinf(range.lo) && u >= Rational(range.lo) && u <= Rational(range.hi)) consider(piece, Rational(end));
        }
      }
      for (const Rational& s : piece.cusps) {
        const auto u = piece.range.at(s);
        if (u && !std::isinf(range.lo) && !std::isinf(range.hi) && *u >= Rational(range.lo) && *u <= Rational(range.hi)) consider(piece, s);
      }
    }
    if (!best) say("FEATURE", "no end or corner at the printed parameter " + show(range.lo));
    else check_line(arc, reversed, best->first, best->second);
  }

  void check_samples()
  {
    if (!result_.outline()) return;
    const auto& outline = *result_.outline();
    for (std::size_t k = 0; k < outline.arcs.size(); ++k) {
      const auto& arc = result_.arcs()[outline.arcs[k]];
      const bool reversed = outline.reversed[k];
      if (!smooth_.empty()) check_line(arc, reversed, {Rational(0), Rational(0)}, {Rational(-smooth_[0][1]), smooth_[0][0]});
      else if (arc.features()[0] == Feature::interior) check_arc(arc, reversed);
      else check_vertex_arc(arc, reversed);
    }
    if (smooth_.empty()) check_convexity();
  }

  /// Exact points of a convex cell's boundary, in their order.
  void check_convexity()
  {
    const std::size_t n = outline_points_.size();
    if (n < 3) return;
    std::vector<Vector> edges;
    for (std::size_t k = 0; k < n; ++k) {
      const Vector edge = minus(outline_points_[(k + 1) % n], outline_points_[k]);
      if (!is_null(edge)) edges.push_back(edge);
    }
    std::size_t turns = 0;
    const auto half = [](const Vector& e) { return e[1] > 0 || (e[1] == 0 && e[0] > 0) ? 0 : 1; };
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Vector &a = edges[k], &b = edges[(k + 1) % edges.size()];
      turns += half(a) == 1 && half(b) == 0;
      if (cross(a, b) < 0) say("CONVEX", "a right turn");
    }
    if (turns > 1) say("CONVEX", std::to_string(turns) + " turns");
  }

  // ----------------------------------------------------------------------------------------------- many directions

  double distance_from_result(const Plane_point& q) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& v : result_.vertices())
      if (v.point) least = std::min(least, distance(q, {(*v.point)[0], (*v.point)[1]}));
    for (const auto& line : polylines_)
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Plane_point a = plane(line[i]), b = plane(line[i + 1]);
        const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
        const double f = square > 0 ? std::min(1.0, std::max(0.0, ((q[0] - a[0]) * dx + (q[1] - a[1]) * dy) / square)) : 0;
        least = std::min(least, std::max(0.0, distance(q, {a[0] + f * dx, a[1] + f * dy}) - line.error()));
      }
    return least;
  }

  bool check_direction(const Plane_point& e, double reach, bool says = true)
  {
    if (!std::isfinite(reach)) return true;
    const Plane_point p = in_doubles(job_.point), q{p[0] + reach * e[0], p[1] + reach * e[1]};
    if (distance(q, {result_.centre()[0], result_.centre()[1]}) > 0.99 * result_.cut_radius()) return true;
    const double off = distance_from_result(q);
    const bool is_met = off <= 1e-6 * result_.scale();
    if (!is_met && says) say("MISSED", show(q) + " is " + show(off) + " from the result");
    return is_met;
  }

  void check_directions()
  {
    constexpr int count = 120;
    if (is_alone_) return;
    if (!smooth_.empty()) {
      for (const int sign : {1, -1}) {
        const Vector n{Rational(-sign * smooth_[0][1]), Rational(sign * smooth_[0][0])};
        const double l = length(n);
        ++report_.directions;
        check_direction({n[0].get_d() / l, n[1].get_d() / l}, search_.reach_along(n));
      }
      return;
    }
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::acos(-1) * (k + 0.37) / count;
      const Plane_point e{std::cos(angle), std::sin(angle)};
      ++report_.directions;
      if (!check_direction(e, search_.reach(angle), false)) check_direction(e, search_.reach(angle, true)); // two maxima side by side
    }
  }

  // ------------------------------------------------------------------------------------------------ feet of vertices

public:
  /// The different places at which a vertex' circle touches the curve, as they are listed.
  std::vector<Plane_point> feet_of(const Locus_vertex<2>& v) const
  {
    std::vector<Plane_point> feet;
    for (const Foot& f : v.feet) {
      if (f.feature == Feature::point) continue;
      std::optional<Plane_point> best; // two pieces may reach into the enclosure
      double least = std::numeric_limits<double>::infinity();
      for (const Foot_place& place : places_of(f.parameters[0])) {
        const Plain_piece& piece = curve_.pieces[place.piece];
        const Rational w = piece.weight_at(place.s);
        if (w == 0) continue;
        const Vector r = piece.offset_at(place.s);
        const Plane_point foot = in_doubles(along(job_.point, Rational(1 / w), r));
        const double off = v.point ? std::abs(distance(foot, {(*v.point)[0], (*v.point)[1]}) - v.radius) : 0;
        if (best && off >= least) continue;
        best = foot;
        least = off;
      }
      const bool is_new = best && std::none_of(feet.begin(), feet.end(), [&](const Plane_point& x) { return distance(x, *best) <= 1e-14 * result_.scale(); });
      if (is_new) feet.push_back(*best);
    }
    return feet;
  }

private:
  void check_feet()
  {
    for (const auto& v : result_.vertices()) {
      if (v.kind != Vertex_kind::trim || !v.point || v.radius > 20 * result_.scale()) continue;
      const Plane_point at{(*v.point)[0], (*v.point)[1]};
      const std::vector<Plane_point> feet = feet_of(v);
      const double small = 1e-8 * result_.scale();
      for (const Plane_point& f : feet)
        if (!(std::abs(distance(f, at) - v.radius) <= small)) say("FEET", "one is not as far as the radius from " + show(at));
      if (feet.empty()) say("FEET", "none at " + show(at));
      const bool is_smooth = std::all_of(v.feet.begin(), v.feet.end(), [](const Foot& f) { return f.feature == Feature::interior || f.feature == Feature::point; });
      if (feet.size() == 1 && is_smooth && smooth_.empty()) say("FEET", "only one, where the curve is smooth, at " + show(at));
      for (const Plain_piece& piece : curve_.pieces) check_feet(piece, v, at, feet);
    }
  }

  /// No place of a piece as near that is not listed.
  void check_feet(const Plain_piece& piece, const Locus_vertex<2>& v, const Plane_point& at, const std::vector<Plane_point>& feet)
  {
    constexpr int n = 128;
    Dense_part part;
    const auto in_double = [](const Polynomial& f, double more, const Polynomial& w) {
      std::vector<double> d(std::max(f.size(), w.size()), 0.0);
      for (std::size_t i = 0; i < f.size(); ++i) d[i] += f[i].get_d();
      for (std::size_t i = 0; i < w.size(); ++i) d[i] += more * w[i].get_d();
      return d;
    };
    const Plane_point p = in_doubles(job_.point);
    part.x = in_double(piece.x, p[0], piece.w);
    part.y = in_double(piece.y, p[1], piece.w);
    part.w = in_double(piece.w, 0, {});
    const auto place = [&](double s) {
      const double w = Dense_part::value(part.w, s);
      return Plane_point{Dense_part::value(part.x, s) / w, Dense_part::value(part.y, s) / w};
    };
    const auto off = [&](double s) {
      const double d = distance(place(s), at);
      return std::isfinite(d) ? d : std::numeric_limits<double>::infinity();
    };
    std::vector<double> d;
    for (int i = 0; i <= n; ++i) d.push_back(off(static_cast<double>(i) / n));
    if (*std::max_element(d.begin(), d.end()) - *std::min_element(d.begin(), d.end()) <= 1e-8 * result_.scale()) return; // an arc of the vertex' circle
    for (int i = 0; i <= n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if ((i > 0 && d[k - 1] < d[k]) || (i < n && d[k + 1] < d[k])) continue;
      double low = static_cast<double>(std::max(0, i - 1)) / n, high = static_cast<double>(std::min(n, i + 1)) / n;
      for (int step = 0; step < 60; ++step) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (off(a) <= off(b) ? high : low) = off(a) <= off(b) ? b : a;
      }
      double s = 0.5 * (low + high);
      for (const double end : {0.0, 1.0})
        if (std::abs(end - s) < 2.0 / n && off(end) <= off(s)) s = end;
      const Plane_point foot = place(s);
      if (off(s) < v.radius - 1e-8 * result_.scale()) say("FEET", "a place of the curve is nearer to " + show(at));
      if (distance(foot, p) <= 1e-6 * result_.scale() || (!smooth_.empty() && feet.size() == 1)) continue; // the point itself; a centre of curvature
      const bool is_listed = std::any_of(feet.begin(), feet.end(), [&](const Plane_point& x) { return distance(x, foot) <= 1e-2 * result_.scale(); });
      if (off(s) <= v.radius + 1e-12 * result_.scale() && !is_listed) say("FEET", show(foot) + " is as near as those listed at " + show(at));
    }
  }

  const Job& job_;
  const Locus<2>& result_;
  std::string name_;
  Report& report_;
  Plain_curve curve_;
  Dense_search search_;
  Nearness nearness_;
  bool is_hit_ = false, is_alone_ = false;
  std::vector<Vector> smooth_; ///< tangents where the point is on a smooth place
  std::vector<Polyline<2>> polylines_;
  std::vector<Vector> outline_points_;
  std::set<std::string> said_;
};

std::optional<Locus<2>> run_job(Report& report, const Job& job, const std::string& name)
{
  ++report.jobs;
  try {
    const auto start = std::chrono::steady_clock::now();
    const Locus<2> result = bisector(job.curve, Coordinates_2{job.point[0], job.point[1]});
    const double seconds = seconds_since(start);
    report.seconds += seconds;
    report.slowest = std::max(report.slowest, seconds);
    if (seconds > 1) std::cerr << "SLOW " << name << " took " << seconds << " s; " << job.show() << std::endl;
    Checker(job, result, name, report).run();
    return result;
  } catch (const Unsupported_feature& e) {
    ++report.unsupported;
    const Plain_curve curve(job);
    if (std::none_of(curve.pieces.begin(), curve.pieces.end(), [](const Plain_piece& piece) { return piece.has_irrational_places; }))
      report.say("EXCEPTION", name + ": no irrational place; " + job.show());
    std::cerr << "UNSUPPORTED " << name << ": " << e.what() << "; " << job.show() << std::endl;
  } catch (const std::exception& e) {
    report.say("EXCEPTION", name + ": " + e.what() + "; " + job.show());
  }
  return std::nullopt;
}

std::size_t number_from(const char* variable, std::size_t otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

// ------------------------------------------------------------------------------------------------ special positions

/// A finite vertex, with all places of the curve that its circle touches; as far off as `tolerance` times 1 + its distance.
struct Expected_vertex {
  Plane_point at;
  std::vector<Plane_point> feet;
  double tolerance = 1e-9;
  bool more_feet = false; ///< on a whole stretch of the curve
};

struct Expected {
  std::size_t arcs = 0;
  bool bounded = false;
  std::vector<Expected_vertex> vertices;
  std::vector<Plane_point> directions; ///< to infinity, of any length
  std::size_t regions = 0;
  bool closed = false;
};

struct Special {
  std::string name;
  Named_curve named;
  Vector point;
  Expected expected;
};

double length(const Plane_point& a) { return std::hypot(a[0], a[1]); }
std::string show_point(const Plane_point& p)
{
  std::ostringstream out;
  out.precision(15);
  out << '(' << p[0] << ", " << p[1] << ')';
  return out.str();
}

/// What differs from the expected structure; empty where nothing does.
std::string difference(const Locus<2>& result, const Expected& expected, const Checker& checker, const Plane_point& point)
{
  std::ostringstream out;
  const auto without_point = [&](std::vector<Plane_point> feet) { // which may be listed as a foot on the curve, or not
    feet.erase(std::remove_if(feet.begin(), feet.end(), [&](const Plane_point& f) { return distance(f, point) <= 1e-7; }), feet.end());
    return feet;
  };
  out.precision(15);
  if (result.status() != Status::certified) out << " not certified;";
  if (result.arcs().size() != expected.arcs) out << ' ' << result.arcs().size() << " arcs for " << expected.arcs << ';';
  if (result.regions().size() != expected.regions) out << ' ' << result.regions().size() << " regions for " << expected.regions << ';';
  if (!result.outline() || result.outline()->bounded != expected.bounded) out << (expected.bounded ? " not bounded;" : " bounded;");
  for (const auto& arc : result.arcs())
    if (arc.is_closed() != expected.closed) out << (expected.closed ? " an arc with ends;" : " a closed arc;");
  std::vector<char> used(result.vertices().size(), 0);
  const auto near = [](const Plane_point& a, const std::vector<Plane_point>& all, double within) {
    return std::any_of(all.begin(), all.end(), [&](const Plane_point& b) { return distance(a, b) <= within; });
  };
  const auto take = [&](const auto& fits) {
    for (std::size_t k = 0; k < used.size(); ++k)
      if (!used[k] && fits(result.vertices()[k])) {
        used[k] = 1;
        return true;
      }
    return false;
  };
  for (const Expected_vertex& e : expected.vertices) {
    const bool found = take([&](const Locus_vertex<2>& v) {
      const double within = e.tolerance * (1 + length(e.at));
      if (v.kind != Vertex_kind::trim || !v.point || distance({(*v.point)[0], (*v.point)[1]}, e.at) > within) return false;
      const std::vector<Plane_point> feet = without_point(checker.feet_of(v)), wanted = without_point(e.feet);
      if (e.more_feet ? feet.size() < wanted.size() : feet.size() != wanted.size()) return false;
      const double foot_within = std::max(e.tolerance, 1e-9);
      return std::all_of(wanted.begin(), wanted.end(), [&](const Plane_point& f) { return near(f, feet, foot_within); }) &&
             (e.more_feet || std::all_of(feet.begin(), feet.end(), [&](const Plane_point& f) { return near(f, wanted, foot_within); }));
    });
    if (found) continue;
    out << " no vertex " << show_point(e.at) << " with feet";
    for (const Plane_point& f : e.feet) out << ' ' << show_point(f);
    out << ';';
  }
  for (const Plane_point& e : expected.directions) {
    const double l = length(e);
    const bool found = take([&](const Locus_vertex<2>& v) {
      return v.kind == Vertex_kind::infinity && v.direction && distance({(*v.direction)[0], (*v.direction)[1]}, {e[0] / l, e[1] / l}) <= 1e-9;
    });
    if (!found) out << " nothing goes to infinity along " << show_point({e[0] / l, e[1] / l}) << ';';
  }
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (used[k]) continue;
    const auto& v = result.vertices()[k];
    out << " found " << name_of(v.kind);
    if (v.point) out << ' ' << show_point({(*v.point)[0], (*v.point)[1]});
    if (v.direction) out << " along " << show_point({(*v.direction)[0], (*v.direction)[1]});
    for (const Plane_point& f : checker.feet_of(v)) out << ' ' << show_point(f);
    out << ';';
  }
  return out.str();
}

/// Arcs and vertices as they join, and the numbers of feet, in plain words.
std::string structure(const Locus<2>& result)
{
  if (!result.outline()) return "none";
  const auto& outline = *result.outline();
  std::vector<std::string> words;
  const auto vertex = [&](std::size_t i) {
    const auto& v = result.vertices()[i];
    std::string text = name_of(v.kind);
    for (const Foot& f : v.feet) text += std::string(",") + name_of(f.feature);
    return text;
  };
  for (std::size_t k = 0; k < outline.arcs.size(); ++k) {
    const auto& arc = result.arcs()[outline.arcs[k]];
    std::string word = std::string(name_of(arc.features()[0])) + (outline.reversed[k] ? " reversed" : "");
    if (!arc.is_closed()) word += " from " + vertex(*arc.source()) + " to " + vertex(*arc.target());
    words.push_back(word);
  }
  std::string least; // of all turns
  for (std::size_t k = 0; k < words.size(); ++k) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) text += words[(k + i) % words.size()] + "; ";
    if (least.empty() || text < least) least = text;
  }
  return std::string(result.status() == Status::certified ? "certified" : "undecided") + (outline.bounded ? ", bounded: " : ": ") + least + std::to_string(result.regions().size()) + " regions";
}

const Rational tiny(Rational(1) / (Integer(1) << 30));
const double eps = 0x1p-30;

Vector at(const Rational& x, const Rational& y) { return {x, y}; }

Named_curve named_parabola(const std::optional<Rational>& lo = {}, const std::optional<Rational>& hi = {})
{
  return named_monomial({std::vector<Rational>{0, 1}, std::vector<Rational>{0, 0, 1}}, {}, {lo, hi});
}

/// The whole parabola y = x²: circles about (0, c), c ≥ 1/2, touch it at x² = c - 1/2; those about b + 1/2 ± sqrt(b - a²) pass (a, b).
Special about_parabola(const std::string& name, const Rational& a, const Rational& b)
{
  Special s{"parabola, " + name, named_parabola(), at(a, b), {}};
  Expected& e = s.expected;
  const Rational inside = b - a * a;
  const double x = a.get_d(), y = b.get_d();
  if (inside < 0) {
    const double root = std::sqrt(-inside.get_d());
    e = {1, false, {}, {{2 * (x + root), -1}, {2 * (x - root), -1}}, 0, false};
    return s;
  }
  if (inside == 0) {
    e = {1, false, {{{0, x * x + 0.5}, {{x, x * x}, {-x, x * x}}}}, {{2 * x, -1}}, 0, false};
    if (a == 0) e.vertices[0].feet.pop_back();
    return s;
  }
  const double root = std::sqrt(inside.get_d());
  const Rational product = b * b - inside; // of both squares
  std::vector<double> squares{y + root};
  if (product > 0 && b > 0) squares.push_back(product.get_d() / (y + root));
  const double tolerance = inside < tiny * 2 ? 1e-7 : 1e-9; // next to the curve
  for (const double q : squares) e.vertices.push_back({{0, 0.5 + q}, {{std::sqrt(q), q}, {-std::sqrt(q), q}}, tolerance});
  e.arcs = squares.size();
  e.bounded = true;
  return s;
}

/// The ellipse x²/4 + y² = 1: circles about (c, 0), |c| ≤ 3/2, touch it at x = 4c/3; those through (a, b) have (4/3)c² - 2ac + a² + b² = 1.
Special about_ellipse(const std::string& name, const Rational& a, const Rational& b)
{
  Special s{"ellipse, " + name, {ellipse_2({0, 0}, 2, 1), "ellipse_2({0, 0}, 2, 1)"}, at(a, b), {}};
  Expected& e = s.expected;
  const Rational on = a * a / 4 + b * b - 1;
  const double x = a.get_d(), y = b.get_d();
  if (on > 0) { // on an axis: where the polar meets the ellipse
    e.arcs = 1;
    if (b == 0) {
      const double u = 4 / x, v = std::sqrt(1 - u * u / 4);
      e.directions = {{u / 4, v}, {u / 4, -v}};
    } else {
      const double v = 1 / y, u = 2 * std::sqrt(1 - v * v);
      e.directions = {{u / 4, v}, {-u / 4, v}};
    }
    return s;
  }
  if (on == 0) {
    e.arcs = 1;
    if (b == 0) e.vertices = {{{1.5, 0}, {{2, 0}}}};
    else e.vertices = {{{0, 0}, {{0, 1}, {0, -1}}}};
    e.directions = {{x, y}};
    return s;
  }
  e.bounded = true;
  const Rational quarter = a * a - Rational(4, 3) * (a * a + b * b - 1);
  const auto add = [&](const Rational& sign) {
    // c = 3/4·(a + sign·sqrt(quarter)); 3/2 - sign·c > 0 by exact squares.
    const Rational far = 2 - sign * a;
    if (far * far <= quarter) return;
    const double root = std::sqrt(quarter.get_d()), c = 0.75 * (x + sign.get_d() * root);
    // 1 - (2c/3)² = (3/2 - c)(3/2 + c)·4/9, and 2 - |a| - root without cancellation.
    const double rest = Rational(far * far - quarter).get_d() / (far.get_d() + root) * 0.75, v = std::sqrt(rest * (3 - rest)) * 2 / 3;
    e.vertices.push_back({{c, 0}, {{4 * c / 3, v}, {4 * c / 3, -v}}});
    e.vertices.back().more_feet = v < 1e-8; // the joint on the axis is between them
  };
  add(1);
  add(-1);
  e.arcs = e.vertices.size();
  return s;
}

/// The unit circle's half above the x-axis.
Special about_half_circle(const std::string& name, const Rational& a, const Rational& b, const Expected& expected)
{
  return {"half circle, " + name, {arc_2({1, 0}, {-1, 0}, 1), "arc_2({1, 0}, {-1, 0}, 1)"}, at(a, b), expected};
}

/// Three of its vertices are on the unit circle, both ends among them; the others are outside.
Named_curve three_on_a_circle() { return named_polyline({at(1, 0), at(2, 2), at(0, 1), at(-2, 2), at(-1, 0)}, false); }

/// Six inner corners on the circle of radius 5, none between (3, -4) and (5, 0), where (4, -3) is on it as well.
Named_curve star()
{
  return named_polyline({at(5, 0), at(8, 4), at(3, 4), at(0, 10), at(-3, 4), at(-8, 4), at(-5, 0), at(-8, -4), at(-3, -4), at(0, -10), at(3, -4), at(16, -12)}, true);
}

Named_curve square() { return named_polyline({at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)}, true); }

/// Four parabolas inscribed in the square's corners, joined smoothly where the axes meet the unit circle: at (1 - t², 2t - t²) the
/// square of the radius is 1 + 2t²(1 - t)²; circles about (s, s), 0 ≤ s ≤ 1/4, touch at t(1 - t) = s and have the squared radius 1 - 2s.
Named_curve rounded_square()
{
  return named_spline(2, {at(1, 0), at(1, 1), at(0, 1), at(-1, 1), at(-1, 0), at(-1, -1), at(0, -1), at(1, -1), at(1, 0)}, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {}, true);
}

/// y² = x³ for |t| ≤ 1.
Named_curve cusped() { return named_monomial({std::vector<Rational>{0, 0, 1}, std::vector<Rational>{0, 0, 0, 1}}, {}, {Rational(-1), Rational(1)}); }

/// A polygon whose sides touch the unit circle at these points, counterclockwise.
Special about_tangents(const std::string& name, const std::vector<Vector>& n)
{
  std::vector<Vector> corners;
  Expected e;
  e.bounded = true;
  for (std::size_t k = 0; k < n.size(); ++k) {
    const Vector &a = n[k], &b = n[(k + 1) % n.size()];
    const Rational c = dot(a, b);
    corners.push_back({Rational((a[0] + b[0]) / (1 + c)), Rational((a[1] + b[1]) / (1 + c))});
    // q on the way to the corner: |q| = 1 - |q|·cos δ, δ half the angle between the normals, and the feet q + |q|·n.
    const double half = std::sqrt((1 + c.get_d()) / 2), r = 1 / (1 + half), l = length(corners.back());
    const Plane_point q{corners.back()[0].get_d() * r / l, corners.back()[1].get_d() * r / l};
    e.vertices.push_back({q, {{q[0] + r * a[0].get_d(), q[1] + r * a[1].get_d()}, {q[0] + r * b[0].get_d(), q[1] + r * b[1].get_d()}}});
  }
  e.arcs = n.size();
  return {name, named_polyline(corners, true), at(0, 0), e};
}

void add_parabolas(std::vector<Special>& all)
{
  for (const auto& [text, e] : std::vector<std::pair<std::string, Rational>>{{"exactly", Rational(0)}, {"by 2^-30", tiny}, {"by -2^-30", Rational(-tiny)}}) {
    // Centres of curvature (-4u³, 1/2 + 3u²); the evolute's normal is (1, 2u).
    for (const Rational& u : {Rational(1, 2), Rational(1, 4), Rational(-1, 2), Rational(1, 8)})
      all.push_back(about_parabola("evolute at u = " + u.get_str() + " " + text, Rational(-4 * u * u * u + e), Rational(Rational(1, 2) + 3 * u * u + 2 * u * e)));
    for (const Rational& b : {Rational(2), Rational(1, 2), Rational(1), Rational(1, 4), Rational(5, 4)}) all.push_back(about_parabola("axis at " + b.get_str() + " " + text, e, b));
    all.push_back(about_parabola("outer axis " + text, e, Rational(-1)));
    all.push_back(about_parabola("vertex' circle of curvature " + text, Rational(0), Rational(1 + e)));
    all.push_back(about_parabola("centre of the vertex' circle of curvature " + text, Rational(0), Rational(Rational(1, 2) + e)));
    all.push_back(about_parabola("at (1, 1) " + text, Rational(1), Rational(1 + e)));
    all.push_back(about_parabola("at (-1/2, 1/4) " + text, Rational(-1, 2), Rational(Rational(1, 4) + e)));
    all.push_back(about_parabola("vertex " + text, Rational(0), e));
  }
  const Named_curve part = named_parabola(Rational(-1), Rational(1));
  const auto end = [&](const std::string& name, const Rational& x, const Rational& y, const Expected& e) { all.push_back({"parabola's end, " + name, part, at(x, y), e}); };
  const double c = 0.5, root = std::sqrt(5 * eps - 4 * eps * eps);
  const Plane_point right{1, 1}, left{-1, 1};
  end("exactly", 1, 1, {2, false, {{{0, 1.5}, {right, left}}}, {{0, 1}, {2, -1}}, 1, false});
  end("beyond it", Rational(1 + tiny), Rational(1 + 2 * tiny), {2, false, {{{0, 1.5 + 1.25 * eps}, {right, left}}}, {{0, 1}, {2, -1}}, 0, false});
  end("before it on the tangent", Rational(1 - tiny), Rational(1 - 2 * tiny), {1, false, {}, {{2, -1}, {2 * (1 - 2 * eps), -1}}, 0, false});
  const double low = 1 + eps - root, lambda = ((2 - 2 * eps) * (2 - 2 * eps) + eps * eps) / (2 * (4 - 3 * eps));
  end("inside on the normal", Rational(1 - 2 * tiny), Rational(1 + tiny),
      {4,
       false,
       {{{0, c + low}, {{std::sqrt(low), low}, {-std::sqrt(low), low}}}, {{1 - eps, 1 + eps / 2}, {right}}, {{-1 + 2 * lambda, 1 + lambda}, {left}}},
       {{1, 2}, {-eps, 2 - 2 * eps}},
       0,
       false});
  end("outside on the normal", Rational(1 + 2 * tiny), Rational(1 - tiny),
      {2, false, {{{1 + eps, 1 - eps / 2}, {right}}}, {{1, 2}, {2 * (1 + 2 * eps - std::sqrt(5 * eps + 4 * eps * eps)), -1}}, 0, false});
}

void add_ellipses(std::vector<Special>& all)
{
  for (const auto& [text, e] : std::vector<std::pair<std::string, Rational>>{{"exactly", Rational(0)}, {"by 2^-30", tiny}, {"by -2^-30", Rational(-tiny)}}) {
    for (const Rational& a : {Rational(0), Rational(1), Rational(3, 2), Rational(7, 4), Rational(2), Rational(-1), Rational(4)})
      all.push_back(about_ellipse("major axis at " + a.get_str() + " " + text, Rational(a + e), Rational(0)));
    for (const Rational& a : {Rational(0), Rational(1), Rational(3, 2), Rational(7, 4), Rational(-1)})
      all.push_back(about_ellipse("beside the major axis at " + a.get_str() + " " + text, a, e));
    all.push_back(about_ellipse("minor axis at 1 " + text, Rational(0), Rational(1 + e)));
    all.push_back(about_ellipse("centre of curvature on the minor axis " + text, Rational(0), Rational(-3 + e)));
  }
  const Named_curve circle{circle_2({0, 0}, 1), "circle_2({0, 0}, 1)"};
  const Expected closed{1, true, {}, {}, 0, true};
  all.push_back({"circle, its centre", circle, at(0, 0), closed});
  all.push_back({"circle, right of its centre", circle, at(tiny, 0), closed});
  all.push_back({"circle, beside its centre", circle, at(-tiny, tiny), closed});
  all.push_back({"circle, inside near it", circle, at(1 - tiny, 0), closed});
  all.push_back({"circle, on it", circle, at(Rational(3, 5), Rational(4, 5)), {1, false, {}, {{3, 4}}, 0, false}});
  all.back().expected.vertices = {{{0, 0}, {{0.6, 0.8}}, 1e-10, true}};
}

void add_half_circles(std::vector<Special>& all)
{
  const Plane_point right{1, 0}, left{-1, 0}, down{0, -1};
  all.push_back(about_half_circle("its centre", 0, 0, {3, false, {{{0.5, 0}, {right}}, {{-0.5, 0}, {left}}}, {down, down}, 0, false}));
  all.push_back(about_half_circle("above the centre", 0, tiny,
                                  {3, true, {{{0.5, 0}, {right}}, {{-0.5, 0}, {left}}, {{0, (eps * eps - 1) / (2 * eps)}, {right, left}, 1e-5}}, {}, 0, false}));
  all.push_back(about_half_circle("below the centre", 0, Rational(-tiny), {3, false, {{{0.5, 0}, {right}}, {{-0.5, 0}, {left}}}, {{eps, -1}, {-eps, -1}}, 0, false}));
  all.push_back(about_half_circle("right of the centre", tiny, 0, {3, false, {{{0.5 * (1 + eps), 0}, {right}}, {{-0.5 * (1 - eps), 0}, {left}}}, {down, down}, 0, false}));
  all.push_back(about_half_circle("on the circle", 0, -1, {2, false, {{{0, 0}, {right, left}, 1e-10, true}}, {{1, -1}, {-1, -1}}, 0, false}));
  all.push_back(about_half_circle("outside the circle", 0, Rational(-1 - tiny),
                                  {2, false, {{{0, -eps * (2 + eps) / (2 * (1 + eps))}, {right, left}}}, {{1 + eps, -1}, {-1 - eps, -1}}, 0, false}));
  all.push_back(about_half_circle("inside the circle", 0, Rational(-1 + tiny),
                                  {3, false, {{{eps - eps * eps / 2, 0}, {right}}, {{-eps + eps * eps / 2, 0}, {left}}}, {{1 - eps, -1}, {-1 + eps, -1}}, 0, false}));
}

void add_ties(std::vector<Special>& all)
{
  const Plane_point r1{1, 0}, r2{0, 1}, r3{-1, 0};
  all.push_back({"tie of both ends and a corner", three_on_a_circle(), at(0, -1), {2, false, {{{0, 0}, {r1, r2, r3}}}, {{1, -1}, {-1, -1}}, 0, false}});
  all.push_back({"tie of both ends and a corner, outside", three_on_a_circle(), at(0, Rational(-1 - tiny)),
                 {2, false, {{{0, -eps * (2 + eps) / (2 * (1 + eps))}, {r1, r3}}}, {{1 + eps, -1}, {-1 - eps, -1}}, 0, false}});
  all.push_back({"tie of both ends and a corner, inside", three_on_a_circle(), at(0, Rational(-1 + tiny)),
                 {3, false, {{{eps / 2, eps / 2}, {r1, r2}}, {{-eps / 2, eps / 2}, {r2, r3}}}, {{1 - eps, -1}, {-1 + eps, -1}}, 0, false}});

  // In the square, on its inscribed circle: of the circles about (s, s) two pass the point, s² - 0.8s = 0.
  const Plane_point r4{0, -1};
  const auto in_square = [&](const Rational& f) { return at(Rational(f * Rational(3, 5)), Rational(f * Rational(4, 5))); };
  const Expected_vertex corner{{0.8, 0.8}, {{1, 0.8}, {0.8, 1}}, 1e-8};
  all.push_back({"square, tie of four sides", square(), in_square(1), {2, true, {{{0, 0}, {r1, r2, r3, r4}}, corner}, {}, 0, false}});
  all.push_back({"square, tie of four sides, outside", square(), in_square(Rational(1 + tiny)), {2, true, {{{2.5 * eps, 2.5 * eps}, {r1, r2}, 1e-8}, corner}, {}, 0, false}});
  all.push_back({"square, tie of four sides, inside", square(), in_square(Rational(1 - tiny)),
                 {4,
                  true,
                  {corner, {{eps / 1.2, -eps / 1.2}, {r1, r4}, 1e-8}, {{-eps / 2.4, -eps / 2.4}, {r3, r4}, 1e-8}, {{-1.25 * eps, 1.25 * eps}, {r2, r3}, 1e-8}},
                  {},
                  0,
                  false}});

  const std::vector<Plane_point> six{{5, 0}, {3, 4}, {-3, 4}, {-5, 0}, {-3, -4}, {3, -4}};
  const auto in_star = [](const Rational& f) { return at(Rational(4 * f), Rational(-3 * f)); };
  const Expected_vertex first{{11.0 / 3, -11.0 / 9}, {six[0]}, 1e-7}, second{{71.0 / 21, -71.0 / 21}, {six[5]}, 1e-7},
    third{{5.754527955981366, -3.539700178681708}, {{7.107691721734833, -2.299300060074363}, {4.792463704479607, -5.103054587372067}}, 1e-7};
  all.push_back({"star, tie of six corners", star(), in_star(1), {4, true, {{{0, 0}, six}, first, second, third}, {}, 0, false}});
  all.push_back({"star, tie of six corners, outside", star(), in_star(Rational(1 + tiny)), {4, true, {{{0, 0}, {six[0], six[5]}, 1e-7}, first, second, third}, {}, 0, false}});
  Expected many{8, true, {first, second, third}, {}, 0, false};
  for (std::size_t k = 0; k < 5; ++k) many.vertices.push_back({{0, 0}, {six[k], six[k + 1]}, 1e-7});
  all.push_back({"star, tie of six corners, inside", star(), in_star(Rational(1 - tiny)), many});

  all.push_back({"rounded square, its middle", rounded_square(), at(0, 0), {1, true, {}, {}, 0, true}});
  all.push_back({"rounded square, right of its middle", rounded_square(), at(tiny, 0), {1, true, {}, {}, 0, true}});
  all.push_back({"rounded square, tie of four joints", rounded_square(), in_square(1), {1, true, {{{0, 0}, {r1, r2, r3, r4}}}, {}, 0, false}});
  all.push_back({"rounded square, tie of four joints, outside", rounded_square(), in_square(Rational(1 + tiny)),
                 {1, true, {{{2.5 * eps, 2.5 * eps}, {{1, 5 * eps}, {5 * eps, 1}}, 1e-8}}, {}, 0, false}});
  all.push_back({"rounded square, tie of four joints, inside", rounded_square(), in_square(Rational(1 - tiny)),
                 {3, true, {{{eps / 1.2, -eps / 1.2}, {r1, r4}, 1e-8}, {{-eps / 2.4, -eps / 2.4}, {r3, r4}, 1e-8}, {{-1.25 * eps, 1.25 * eps}, {r2, r3}, 1e-8}}, {}, 0, false}});
  all.push_back({"rounded square, on a joint", rounded_square(), at(1, 0), {1, false, {{{0, 0}, {r1, r2, r3, r4}, 1e-7}}, {{1, 0}}, 0, false}});
  const double s = (std::sqrt(4 * eps * eps + 8 * (2 * eps - eps * eps)) - 2 * eps) / 4, t = 2 * s / (1 + std::sqrt(1 - 4 * s));
  const double near = 2 * t - t * t, far = 1 - t * t, m = 2 * (2 * eps - eps * eps) / (4 - 2 * eps + std::sqrt((4 - 2 * eps) * (4 - 2 * eps) + 8 * (2 * eps - eps * eps)));
  all.push_back({"rounded square, inside near a joint", rounded_square(), at(Rational(1 - tiny), 0),
                 {4,
                  true,
                  {{{s, s}, {{far, near}, {near, far}}},
                   {{s, -s}, {{far, -near}, {near, -far}}},
                   {{-m, m}, {{-2 * m, 1}, {-1, 2 * m}}},
                   {{-m, -m}, {{-2 * m, -1}, {-1, -2 * m}}}},
                  {},
                  0,
                  false}});
}

void add_rings(std::vector<Special>& all)
{
  const auto third = [](int a, int b, int c) { return Vector{fraction(a, c), fraction(b, c)}; };
  all.push_back(about_tangents("square about its centre", {third(1, 0, 1), third(0, 1, 1), third(-1, 0, 1), third(0, -1, 1)}));
  all.push_back(about_tangents("five sides about a circle", {third(1, 0, 1), third(3, 4, 5), third(-4, 3, 5), third(-4, -3, 5), third(5, -12, 13)}));
  all.push_back(about_tangents("eight sides about a circle", {third(1, 0, 1), third(3, 4, 5), third(0, 1, 1), third(-4, 3, 5), third(-1, 0, 1), third(-3, -4, 5), third(0, -1, 1), third(4, -3, 5)}));
  all.push_back(about_tangents("twelve sides about a circle",
                               {third(1, 0, 1), third(4, 3, 5), third(3, 4, 5), third(0, 1, 1), third(-3, 4, 5), third(-4, 3, 5), third(-1, 0, 1), third(-4, -3, 5), third(-3, -4, 5), third(0, -1, 1),
                                third(3, -4, 5), third(4, -3, 5)}));
  const double m = 4 * (std::sqrt(2.0) - 1);
  Expected e{4, true, {}, {}, 0, false};
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0}) e.vertices.push_back({{m * x, m * y}, {{4 * x, m * y}, {m * x, 4 * y}}});
  all.push_back({"eight corners on a circle", named_polyline({at(4, -3), at(4, 3), at(3, 4), at(-3, 4), at(-4, 3), at(-4, -3), at(-3, -4), at(3, -4)}, true), at(0, 0), e});
}

void add_polylines(std::vector<Special>& all)
{
  const Plane_point start{0, 0}, end{2, 0};
  const auto bent = [](const Rational& y) { return named_polyline({at(0, 0), at(1, y), at(2, 0)}, false); };
  const double out = 1 / (1 - eps), half = (1 - eps) / 2, in = 1 / (1 + eps), norm = 1 + eps * eps, c = (std::sqrt(norm) - eps) / (1 + std::sqrt(norm)), aside = eps * (c + eps) / norm;
  all.push_back({"nearly collinear, towards the point", bent(tiny), at(1, 1),
                 {5,
                  false,
                  {{{-eps * out, out}, {start}}, {{2 + eps * out, out}, {end}}, {{1 - eps * half, eps + half}, {{1, eps}}}, {{1 + eps * half, eps + half}, {{1, eps}}}},
                  {{-1, 1}, {1, 1}},
                  0,
                  false}});
  all.push_back({"nearly collinear, away from the point", bent(Rational(-tiny)), at(1, 1),
                 {4, false, {{{eps * in, in}, {start}}, {{2 - eps * in, in}, {end}}, {{1, c}, {{1 - aside, 0}, {1 + aside, 0}}}}, {{-1, 1}, {1, 1}}, 0, false}});
  const Expected segment{3, false, {{{0, 1}, {start}}, {{2, 1}, {end}}}, {{-1, 1}, {1, 1}}, 0, false};
  all.push_back({"collinear", bent(0), at(1, 1), segment});
  all.push_back({"there and back", named_polyline({at(0, 0), at(2, 0), at(0, 0)}, false), at(1, 1), segment});
  all.push_back({"there and partly back", named_polyline({at(0, 0), at(2, 0), at(1, 0)}, false), at(1, 1), segment});
  all.push_back({"there, back and there", named_polyline({at(0, 0), at(3, 0), at(1, 0), at(2, 0)}, false), at(1, 1),
                 {3, false, {{{0, 1}, {start}}, {{3, 2.5}, {{3, 0}}}}, {{-1, 1}, {1, 2}}, 0, false}});
  const Expected normal{1, false, {}, {{0, 1}, {0, -1}}, 0, false};
  all.push_back({"there and back, on it", named_polyline({at(0, 0), at(2, 0), at(0, 0)}, false), at(1, 0), normal});
  all.push_back({"there and partly back, on its end", named_polyline({at(0, 0), at(2, 0), at(1, 0)}, false), at(1, 0), normal});
  all.push_back({"there and back, where it turns", named_polyline({at(0, 0), at(2, 0), at(0, 0)}, false), at(2, 0), {1, false, {}, {{0, 1}, {0, -1}}, 1, false}});

  const Named_curve angle = named_polyline({at(0, 0), at(2, 0), at(2, 2)}, false);
  all.push_back({"corner, on it", angle, at(2, 0), {2, false, {{{2, 0}, {{2, 0}}}}, {{0, -1}, {1, 0}}, 1, false}});
  const double far = (eps * eps + (2 + eps) * (2 + eps)) / (2 * eps);
  all.push_back({"corner, outside", angle, at(2 + tiny, Rational(-tiny)),
                 {5,
                  false,
                  {{{2 + eps, 0}, {{2, 0}}}, {{2, -eps}, {{2, 0}}}, {{2 + far, 2}, {{2, 2}}, 1e-5}, {{0, -far}, {{0, 0}}, 1e-5}},
                  {{2 + eps, eps}, {-eps, -2 - eps}},
                  0,
                  false}});
  const double low = eps * std::sqrt(2.0) / (std::sqrt(2.0) + 1), high = eps * std::sqrt(2.0) / (std::sqrt(2.0) - 1);
  all.push_back({"corner, inside", angle, at(2 - tiny, tiny),
                 {2, true, {{{2 - low, low}, {{2 - low, 0}, {2, low}}}, {{2 - high, high}, {{2 - high, 0}, {2, high}}, 2e-9}}, {}, 0, false}});
}

void add_retraced(std::vector<Special>& all)
{
  const Named_curve twice = named_spline(2, {at(-1, 1), at(0, -1), at(1, 1), at(0, -1), at(-1, 1)}, {0, 0, 0, 1, 1, 2, 2, 2}, {}, false);
  const double q = 0.125 + std::sqrt(0.125);
  all.push_back({"parabola there and back", twice, at(0, Rational(1, 8)), {1, true, {{{0, 0.5 + q}, {{std::sqrt(q), q}, {-std::sqrt(q), q}}}}, {}, 0, false}});
  std::vector<Vector> points{at(1, 0)};
  std::vector<Rational> weights{1}, knots{0, 0, 0};
  const std::vector<Vector> round{at(1, 1), at(0, 1), at(-1, 1), at(-1, 0), at(-1, -1), at(0, -1), at(1, -1), at(1, 0)};
  for (int turn = 0; turn < 2; ++turn)
    for (std::size_t k = 0; k < round.size(); ++k) {
      points.push_back(round[k]);
      weights.push_back(k % 4 == 1 ? 2 : 1);
      if (k % 2 == 1) knots.insert(knots.end(), 2, Rational(4 * turn + static_cast<long>(k + 1) / 2));
    }
  knots.push_back(8);
  const Named_curve circle = named_spline(2, points, knots, weights, true);
  all.push_back({"circle traced twice", circle, at(Rational(1, 4), Rational(1, 8)), {1, true, {}, {}, 0, true}});
  all.push_back({"circle traced twice, its centre", circle, at(0, 0), {1, true, {}, {}, 0, true}});
  all.push_back({"ray there and back", named_monomial({std::vector<Rational>{0, 0, 1}, std::vector<Rational>{0}}, {}, {}), at(1, 1), {2, false, {{{0, 1}, {{0, 0}}}}, {{-1, 1}, {0, 1}}, 0, false}});
  // (t, 0)/(t² - 1): each point of the line twice, at t and at -1/t.
  all.push_back({"line traced twice through infinity", named_monomial({std::vector<Rational>{0, 1}, std::vector<Rational>{0}}, {-1, 0, 1}, {}), at(0, 1),
                 {1, false, {}, {{0, 1}, {0, 1}}, 0, false}});
  // Parts of the path are passed twice, in both senses; what is kept must run through the seam.
  all.push_back({"segment there and back from its inside", named_polyline({at(0, 0), at(0, -1), at(0, 1)}, true), at(1, Rational(-3, 2)),
                 {3, false, {{{0.625, -1}, {{0, -1}}}, {{3.625, 1}, {{0, 1}}}}, {{-1, -2}, {5, 2}}, 0, false}});
  all.push_back({"segment with a standstill", named_bezier({at(-1, 0), at(1, 0), at(-1, 0), at(1, 0)}), at(0, 1),
                 {3, false, {{{-1, 1}, {{-1, 0}}}, {{1, 1}, {{1, 0}}}}, {{-1, 1}, {1, 1}}, 0, false}});
  all.push_back({"segment with a standstill, on it", named_bezier({at(-1, 0), at(1, 0), at(-1, 0), at(1, 0)}), at(0, 0), {1, false, {}, {{0, 1}, {0, -1}}, 0, false}});
}

void add_cusps(std::vector<Special>& all)
{
  const Plane_point cusp{0, 0}, up{1, 1}, down{1, -1};
  all.push_back({"cusp, on it", cusped(), at(0, 0), {3, false, {{{-2, 3}, {up}}, {{-2, -3}, {down}}}, {{-1, 1}, {-1, -1}}, 1, false}});
  const double square = 2 * eps / (1 + std::sqrt(1 + 12 * eps)), t = std::sqrt(square), y = t + 2 * t * square, x = -eps / 2;
  const double lambda = ((1 + eps) * (1 + eps) + 1) / (2 * (1 + 3 * eps));
  all.push_back({"cusp, before it", cusped(), at(Rational(-tiny), 0),
                 {5,
                  false,
                  {{{x, y}, {cusp, {square, t * square}}},
                   {{x, -y}, {cusp, {square, -t * square}}},
                   {{1 - 3 * lambda, 1 + 2 * lambda}, {up}},
                   {{1 - 3 * lambda, -1 - 2 * lambda}, {down}}},
                  {{-1, 1 + eps}, {-1, -1 - eps}},
                  0,
                  false}});
  // Circles about (t² + 3/2·t⁴, 0) touch both branches; their radius t³·sqrt(1 + 9/4·t²) is the distance to the point.
  Expected e{2, true, {}, {}, 0, false};
  for (const double sign : {1.0, -1.0}) {
    double u = std::sqrt(eps);
    for (int k = 0; k < 50; ++k) u = std::sqrt(eps - 1.5 * u * u * u * u + sign * u * u * u * std::sqrt(1 + 2.25 * u * u));
    e.vertices.push_back({{u * u + 1.5 * u * u * u * u, 0}, {{u * u, u * u * u}, {u * u, -u * u * u}}});
  }
  all.push_back({"cusp, inside it", cusped(), at(tiny, 0), e});
}

void add_others(std::vector<Special>& all)
{
  // The other foot's parameter, 3, lies between 1 and the point's, 7: on the finite part of a projective piece.
  all.push_back({"on a parabola, where its parameter is projective", named_monomial({std::vector<Rational>{-5, 1}, std::vector<Rational>{25, -10, 1}}, {}, {}), at(2, 4),
                 {1, false, {{{0, 4.5}, {{2, 4}, {-2, 4}}, 1e-7}}, {{4, -1}}, 0, false}});
  const Named_curve quartic = named_monomial({std::vector<Rational>{0, 1}, std::vector<Rational>{0, 0, 0, 0, 1}}, {}, {Rational(-2), Rational(2)});
  const auto pair = [](double u) { return std::vector<Plane_point>{{u, u * u * u * u}, {-u, u * u * u * u}}; };
  const auto on_axis = [&](double u, double tolerance) { return Expected_vertex{{0, u * u * u * u + 1 / (4 * u * u)}, pair(u), tolerance}; };
  for (const auto& [text, e] : std::vector<std::pair<std::string, Rational>>{{"exactly", Rational(0)}, {"by 2^-30", tiny}, {"by -2^-30", Rational(-tiny)}}) {
    const double tolerance = e == 0 ? 1e-10 : 1e-7;
    all.push_back({"quartic, axis at 2 " + text, quartic, at(e, 2), {2, true, {on_axis(1.338077168762386, tolerance), on_axis(0.9267140461173617, tolerance)}, {}, 0, false}});
    const double u = 0.1357857782213697, v = 0.8131199327770387, x = 0.1282220134682679, y = 0.7556324385364589;
    all.push_back({"quartic, axis at 3/2 " + text, quartic, at(e, Rational(3, 2)),
                   {3,
                    true,
                    {on_axis(1.273273653613964, tolerance), {{x, y}, {{u, u * u * u * u}, {v, v * v * v * v}}, tolerance}, {{-x, y}, {{-u, u * u * u * u}, {-v, v * v * v * v}}, tolerance}},
                    {},
                    0,
                    false}});
    // y = x³ from (0, 0) to (2, 8), its centre of curvature at x = 1; across the evolute along (1, 3).
    const double w = 1.175894313530364;
    const Expected_vertex tie{{-1.392201686925306, 2.245030802945374}, {{0, 0}, {w, w * w * w}}, tolerance};
    const double ax = -6 + e.get_d(), ay = -16.0 / 3 + 3 * e.get_d(), lambda = -(ax * ax + ay * ay) / (2 * (-12 * ax + ay)); // 0 = |a|² - 2λa·n, n = (-12, 1)
    all.push_back({"cubic, centre of curvature " + text, named_monomial({std::vector<Rational>{0, 1}, std::vector<Rational>{0, 0, 0, 1}}, {}, {Rational(0), Rational(2)}),
                   at(Rational(-4 + e), Rational(Rational(8, 3) + 3 * e)),
                   {3, false, {tie, {{2 + 12 * lambda, 8 - lambda}, {{2, 8}}, 1e-9}}, {{ay, -ax}, {-8.0 / 3 - 3 * e.get_d(), -4 + e.get_d()}}, 0, false}});
    // y = x² + x³ on [-1/2, 1], its centre of curvature at 0, where the curvature grows.
    const double px = e.get_d();
    const auto q_at = [&](const Plane_point& r, const Plane_point& n) {
      const double dx = r[0] - px, dy = r[1] - 0.5, f = -(dx * dx + dy * dy) / (2 * (dx * n[0] + dy * n[1]));
      return Plane_point{r[0] + f * n[0], r[1] + f * n[1]};
    };
    const Plane_point a{1 - px, 1.5}, b{-0.5 - px, -0.375};
    const double aa = 0.5 * (a[0] * a[0] + a[1] * a[1]), bb = 0.5 * (b[0] * b[0] + b[1] * b[1]), det = a[0] * b[1] - a[1] * b[0];
    all.push_back({"cubic, centre of curvature inside " + text, named_monomial({std::vector<Rational>{0, 1}, std::vector<Rational>{0, 0, 1, 1}}, {}, {Rational(-1, 2), Rational(1)}), at(e, Rational(1, 2)),
                   {3,
                    true,
                    {{q_at({1, 2}, {-5, 1}), {{1, 2}}},
                     {q_at({-0.5, 0.125}, {0.25, 1}), {{-0.5, 0.125}}},
                     {{px + (aa * b[1] - bb * a[1]) / det, 0.5 + (a[0] * bb - b[0] * aa) / det}, {{1, 2}, {-0.5, 0.125}}}},
                    {},
                    0,
                    false}});
  }
  // Circles about (0, c) touch at 0 and ±u, u⁶ = 1/2, where 2c = 1.8898815748423...: between two neighbouring multiples of 2^-30.
  const double u = std::exp2(-1.0 / 6), v = u * u * u * u, c = 0.9449407874211549;
  const Integer below = 2029244889;
  double w = 1.3;
  for (int k = 0; k < 60; ++k) { // c(w) - b = radius
    const auto f = [&](double x) { return x * x * x * x + 1 / (4 * x * x) - 2 * c - std::sqrt(x * x + 1 / (16 * x * x * x * x)); };
    w -= f(w) * 1e-6 / (f(w + 1e-6) - f(w));
  }
  all.push_back({"quartic, below the tie of three", quartic, at(0, Rational(below) * tiny),
                 {3, true, {on_axis(w, 1e-7), {{0, c}, {{0, 0}, {u, v}}, 1e-7}, {{0, c}, {{0, 0}, {-u, v}}, 1e-7}}, {}, 0, false}});
  all.push_back({"quartic, above the tie of three", quartic, at(0, Rational(below + 1) * tiny), {2, true, {on_axis(w, 1e-7), {{0, c}, {{u, v}, {-u, v}}, 1e-7}}, {}, 0, false}});
}

std::vector<Special> special_positions()
{
  std::vector<Special> all;
  add_parabolas(all);
  add_ellipses(all);
  add_half_circles(all);
  add_ties(all);
  add_rings(all);
  add_polylines(all);
  add_retraced(all);
  add_cusps(all);
  add_others(all);
  if (const char* name = std::getenv("LOCUS_POINT_CURVE_SPECIAL")) // only this one, by its number
    return {all.at(std::strtoull(name, nullptr, 10))};
  return all;
}

/// x ↦ factor·x + shift in both coordinates.
Curve_2 moved(const Curve_2& curve, const Rational& factor, const Rational& shift)
{
  std::vector<Curve_piece<2>> pieces = curve.pieces();
  for (auto& piece : pieces)
    for (auto& x : piece.numerator)
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = Rational(factor * x[i] + shift * piece.weight[piece.weight.degree() == 0 ? 0 : i]);
  return joined_curve(std::move(pieces), curve.chain().pieces, curve.chain().is_closed());
}

} // namespace

TEST_CASE("random points and curves: exact samples and a dense search", "[point_curve_random]")
{
  const std::size_t from = number_from("LOCUS_POINT_CURVE_FROM", 0), count = number_from("LOCUS_POINT_CURVE_COUNT", 5000);
  Report report;
  for (std::size_t number = from; number < from + count; ++number) run_job(report, random_job(number), "job " + std::to_string(number));
  std::cerr << report.text() << std::endl;
  INFO("LOCUS_TEST_SEED=" << locus_test::run_seed() << ", the first: " << report.first);
  CHECK(report.undecided == 0);
  CHECK(report.problems == 0);
}

TEST_CASE("special positions: structure by hand, and both oracles", "[point_curve_random]")
{
  Report report;
  std::size_t different = 0;
  std::string first;
  const auto all = special_positions();
  for (const Special& s : all) {
    const Job job{s.named.curve, s.point, s.named.text};
    const auto result = run_job(report, job, s.name);
    Report unused;
    const std::string text = result ? difference(*result, s.expected, Checker(job, *result, s.name, unused), in_doubles(s.point)) : " nothing";
    if (text.empty()) continue;
    std::cerr << "STRUCTURE " << s.name << ':' << text << ' ' << job.show() << std::endl;
    if (different++ == 0) first = s.name + ':' + text;
  }
  std::cerr << all.size() << " special positions, " << different << " of another structure; " << report.text() << std::endl;
  INFO("the first: " << report.first << first);
  CHECK(report.problems == 0);
  CHECK(report.unsupported == 0);
  CHECK(different == 0);
}

TEST_CASE("special positions: the same structure for other scales and places", "[point_curve_random]")
{
  const Rational great(Integer(1) << 200), small = 1 / great, away(Integer(1) << 40);
  std::size_t different = 0, count = 0;
  std::string first;
  const auto of = [](const Curve_2& curve, const Vector& p) -> std::string {
    try {
      return structure(bisector(curve, Coordinates_2{p[0], p[1]}));
    } catch (const std::exception& e) {
      return e.what();
    }
  };
  for (const Special& s : special_positions()) {
    const std::string own = of(s.named.curve, s.point);
    for (const auto& [factor, shift] : std::vector<std::pair<Rational, Rational>>{{great, 0}, {small, 0}, {1, away}, {great, Rational(away * great)}, {Rational(-1), 0}}) {
      ++count;
      const std::string other = of(moved(s.named.curve, factor, shift), {Rational(factor * s.point[0] + shift), Rational(factor * s.point[1] + shift)});
      if (other == own) continue;
      const std::string text = s.name + ", factor " + std::to_string(factor.get_d()).substr(0, 12) + ", shift " + std::to_string(shift.get_d()).substr(0, 12) + ": " + own + " / " + other;
      std::cerr << "MOVED " << text << std::endl;
      if (different++ == 0) first = text;
    }
  }
  std::cerr << count << " moved, " << different << " of another structure" << std::endl;
  INFO(first);
  CHECK(different == 0);
}
