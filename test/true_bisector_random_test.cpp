// SPDX-License-Identifier: LGPL-3.0-or-later
// True bisectors of random pairs of disjoint curves, and of random closed curves with themselves, against a dense search in
// doubles that shares no code with the library.
#include <locus/bisector_2.h>
#include <locus/number/zero_of_roots.h>

#include "support.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <functional>
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

double dot(const Plane_point& a, const Plane_point& b) { return a[0] * b[0] + a[1] * b[1]; }
double cross(const Plane_point& a, const Plane_point& b) { return a[0] * b[1] - a[1] * b[0]; }
Plane_point minus(const Plane_point& a, const Plane_point& b) { return {a[0] - b[0], a[1] - b[1]}; }
Plane_point between(const Plane_point& a, const Plane_point& b, double t) { return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}; }
double length(const Plane_point& a) { return std::hypot(a[0], a[1]); }
double distance(const Plane_point& a, const Plane_point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }
Plane_point plane(const Approximate_point<2>& p) { return {p[0], p[1]}; }
bool is_finite(const Plane_point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }

double distance_from_segment(const Plane_point& q, const Plane_point& a, const Plane_point& b)
{
  const Plane_point d = minus(b, a);
  const double square = dot(d, d);
  const double f = square > 0 ? std::min(1.0, std::max(0.0, dot(minus(q, a), d) / square)) : 0;
  return distance(q, between(a, b, f));
}

bool is_crossing(const Plane_point& a, const Plane_point& b, const Plane_point& c, const Plane_point& d)
{
  const double p = cross(minus(b, a), minus(c, a)), q = cross(minus(b, a), minus(d, a));
  const double r = cross(minus(d, c), minus(a, c)), s = cross(minus(d, c), minus(b, c));
  return (p > 0) != (q > 0) && (r > 0) != (s > 0);
}

Rational fraction(long n, long d)
{
  Rational x(n, d);
  x.canonicalize();
  return x;
}

std::string show(const Plane_point& p)
{
  std::ostringstream out;
  out.precision(17);
  out << '(' << p[0] << ", " << p[1] << ')';
  return out.str();
}

std::string show(double x)
{
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

// -------------------------------------------------------------------------------------------------------------- curves

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

/// A curve and the code that makes it.
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

Named_curve named_circle(const Vector& centre, const Rational& radius)
{
  return {circle_2({centre[0], centre[1]}, radius), "circle_2(" + listed(centre) + ", " + quoted(radius) + ")"};
}

/// A closed chain of cubic Bezier pieces; the first point is repeated at the end.
Named_curve named_loop(const std::vector<Vector>& points)
{
  std::vector<Rational> knots{0};
  for (std::size_t k = 0; 3 * k < points.size(); ++k) knots.insert(knots.end(), 3, Rational(static_cast<long>(k)));
  knots.push_back(knots.back());
  return named_spline(3, points, knots, {}, true);
}

/// Random curves with control points on a grid in [-2, 2]², some of them in a part of it only.
class Curve_maker {
public:
  explicit Curve_maker(Random& random) : random_(random) {}

  Named_curve bezier()
  {
    place();
    return bezier_here();
  }

private:
  Named_curve bezier_here()
  {
    const bool rational = random_.chance(40);
    const int degree = random_.between(rational ? 2 : 1, 3);
    std::vector<Vector> points;
    std::vector<Rational> weights;
    for (int i = 0; i <= degree; ++i) {
      points.push_back(grid_point());
      if (rational) weights.push_back(weight());
    }
    return named_bezier(points, weights);
  }

public:
  /// With control points anywhere on the grid.
  Named_curve wide_bezier()
  {
    size_ = 16;
    corner_ = {-8, -8};
    return bezier_here();
  }

  /// A closed spline about the middle.
  Named_curve ring()
  {
    const int n = random_.between(4, 8), degree = random_.between(1, 3);
    std::vector<Vector> points;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::acos(-1) * (i + 0.6 * random_.symmetric()) / n, radius = 2 - 0.7 * random_.unit();
      points.push_back({fraction(std::lround(4 * radius * std::cos(angle)), 4), fraction(std::lround(4 * radius * std::sin(angle)), 4)});
    }
    points.push_back(points.front());
    std::vector<Rational> knots(static_cast<std::size_t>(degree) + 1, Rational(0)), weights;
    for (int i = 1; i <= n - degree; ++i) knots.push_back(i);
    for (int i = 0; i <= degree; ++i) knots.push_back(n - degree + 1);
    if (random_.chance(30))
      for (std::size_t i = 0; i < points.size(); ++i) weights.push_back(weight());
    return named_spline(degree, points, knots, weights, true);
  }

  /// A curve near the middle.
  Named_curve small()
  {
    size_ = 6;
    corner_ = {-3, -3};
    return random_.chance(50) ? bezier_here() : spline_here();
  }

  Named_curve spline()
  {
    place();
    return spline_here();
  }

private:
  Named_curve spline_here()
  {
    if (random_.chance(30)) return polyline();
    const bool rational = random_.chance(30), closed = random_.chance(25);
    const int degree = random_.between(2, 3), spans = random_.between(2, 5);
    std::vector<Rational> knots(static_cast<std::size_t>(degree) + 1, Rational(0));
    const int corners = random_.below(3); // none, some, all joints are C0
    for (int s = 1; s < spans; ++s) {
      const int times = corners == 2 || (corners == 1 && random_.chance(40)) ? degree : random_.chance(20) ? degree - 1 : 1;
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

  /// The box of the next curve's control points, in quarters.
  void place()
  {
    size_ = random_.chance(40) ? 16 : random_.between(4, 10);
    for (int& c : corner_) c = random_.between(-8, 8 - size_);
  }

  Vector grid_point() { return {fraction(corner_[0] + random_.between(0, size_), 4), fraction(corner_[1] + random_.between(0, size_), 4)}; }

  Rational weight()
  {
    const int k = random_.below(6);
    return k < 4 ? Rational(k + 1) : k == 4 ? Rational(1, 2) : Rational(3, 2);
  }

  Named_curve polyline()
  {
    std::vector<Vector> points;
    for (int n = random_.between(2, 6); n > 0; --n) {
      Vector p = grid_point();
      while (!points.empty() && (p == points.back() || p == points.front())) p = grid_point();
      points.push_back(p);
    }
    return named_polyline(points, points.size() > 2 && random_.chance(40));
  }

  Random& random_;
  int size_ = 16;
  std::array<int, 2> corner_{-8, -8};
};

// ------------------------------------------------------------------------------------------------------ a dense search

Polynomial monomial_of(const Bernstein<Rational, 1>& f)
{
  const int n = f.degree();
  Polynomial a;
  for (int k = 0; k <= n; ++k) {
    Rational sum = 0;
    for (int i = 0; i <= k; ++i) sum += ((k - i) % 2 ? -1 : 1) * Rational(choose(k, i)) * f[static_cast<std::size_t>(i)];
    a.push_back(Rational(sum * choose(n, k)));
  }
  return a;
}

/// A piece in doubles, on [0, 1], with sampled points.
class Dense_piece {
public:
  struct Jet {
    Plane_point p, v, a; ///< with the first two derivatives
  };

  Dense_piece(const Curve_piece<2>& piece, const Piece& range, int n) : range_(range)
  {
    for (std::size_t k = 0; k < 2; ++k) x_[k] = in_doubles(piece.numerator[k]);
    x_[2] = in_doubles(piece.weight);
    for (int i = 0; i <= n; ++i) samples_.push_back(at(static_cast<double>(i) / n));
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const double before = i > 0 ? distance(samples_[i], samples_[i - 1]) : 0, after = i + 1 < samples_.size() ? distance(samples_[i], samples_[i + 1]) : 0;
      reach_.push_back(1.2 * std::max(before, after));
    }
  }

  const Piece& range() const { return range_; }
  const std::vector<Plane_point>& samples() const { return samples_; }
  double reach(std::size_t i) const { return reach_[i]; }
  double local(std::size_t i) const { return static_cast<double>(i) / static_cast<double>(samples_.size() - 1); }

  Plane_point at(double s) const
  {
    const double w = value(x_[2], s);
    return {value(x_[0], s) / w, value(x_[1], s) / w};
  }

  Jet jet(double s) const
  {
    const auto w = derivatives(x_[2], s);
    Jet j;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto x = derivatives(x_[k], s);
      j.p[k] = x[0] / w[0];
      j.v[k] = (x[1] - j.p[k] * w[1]) / w[0];
      j.a[k] = (x[2] - 2 * j.v[k] * w[1] - j.p[k] * w[2]) / w[0];
    }
    return j;
  }

  double curvature(double s) const
  {
    const Jet j = jet(s);
    return cross(j.v, j.a) / std::pow(length(j.v), 3);
  }

  /// Where on [a, b] the piece is nearest to q.
  double nearest_on(double a, double b, const Plane_point& q) const
  {
    constexpr int n = 8;
    std::array<double, n + 1> s{}, d{};
    for (std::size_t i = 0; i <= n; ++i) {
      s[i] = a + (b - a) * static_cast<double>(i) / n;
      d[i] = distance(at(s[i]), q);
    }
    double best = s[0], least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i <= n; ++i) {
      if ((i > 0 && d[i - 1] < d[i]) || (i < n && d[i + 1] < d[i])) continue;
      const double t = minimum(s[i == 0 ? 0 : i - 1], s[std::min<std::size_t>(i + 1, n)], q), f = distance(at(t), q);
      for (const auto& [place, value] : {std::pair(s[i], d[i]), std::pair(t, f)}) {
        if (value >= least) continue;
        best = place;
        least = value;
      }
    }
    return best;
  }

private:
  static std::vector<double> in_doubles(const Bernstein<Rational, 1>& f)
  {
    std::vector<double> d;
    for (const Rational& c : monomial_of(f)) d.push_back(c.get_d());
    return d;
  }

  static double value(const std::vector<double>& f, double s)
  {
    double sum = 0;
    for (std::size_t i = f.size(); i-- > 0;) sum = sum * s + f[i];
    return sum;
  }

  static std::array<double, 3> derivatives(const std::vector<double>& f, double s)
  {
    double p = 0, d = 0, dd = 0;
    for (std::size_t i = f.size(); i-- > 0;) {
      dd = dd * s + 2 * d;
      d = d * s + p;
      p = p * s + f[i];
    }
    return {p, d, dd};
  }

  /// Of the distance between lo and hi: Newton's method kept in a bracket, or golden sections where there is none.
  double minimum(double lo, double hi, const Plane_point& q) const
  {
    const auto slope = [&](double s) {
      const Jet j = jet(s);
      const Plane_point r = minus(j.p, q);
      return std::array<double, 2>{dot(r, j.v), dot(j.v, j.v) + dot(r, j.a)};
    };
    if (slope(lo)[0] < 0 && slope(hi)[0] > 0) {
      double s = 0.5 * (lo + hi);
      for (int k = 0; k < 80 && lo < s && s < hi; ++k) {
        const auto f = slope(s);
        if (f[0] == 0) return s;
        (f[0] < 0 ? lo : hi) = s;
        double next = f[1] > 0 ? s - f[0] / f[1] : lo;
        if (!(lo < next && next < hi)) next = 0.5 * (lo + hi);
        if (std::abs(next - s) <= 1e-16) return next;
        s = next;
      }
      return s;
    }
    constexpr double ratio = 0.6180339887498949;
    for (int k = 0; k < 60; ++k) {
      const double c = hi - ratio * (hi - lo), d = lo + ratio * (hi - lo);
      (distance(at(c), q) <= distance(at(d), q) ? hi : lo) = distance(at(c), q) <= distance(at(d), q) ? d : c;
    }
    return 0.5 * (lo + hi);
  }

  std::array<std::vector<double>, 3> x_; ///< coefficients of powers of x, y, w
  Piece range_;
  std::vector<Plane_point> samples_;
  std::vector<double> reach_; ///< of samples: how far the curve goes up to the next ones
};

/// The nearest point of a curve, or one as near locally.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t piece = 0;
  double s = 0;
  Plane_point point{};
};

class Dense_curve {
public:
  explicit Dense_curve(const Curve_2& curve)
  {
    const int n = curve.pieces().size() > 2 ? 128 : 200;
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) pieces_.emplace_back(curve.pieces()[i], curve.chain().pieces[i], n);
  }

  const std::vector<Dense_piece>& pieces() const { return pieces_; }

  Nearest nearest(const Plane_point& q) const
  {
    Nearest best;
    for (const Nearest& n : minima(q, 0))
      if (n.distance < best.distance) best = n;
    return best;
  }

  double distance_from(const Plane_point& q) const { return nearest(q).distance; }

  /// All places that are as near as the nearest, but for `slack`, and `apart` from each other.
  std::vector<Nearest> feet(const Plane_point& q, double slack, double apart) const
  {
    std::vector<Nearest> all = minima(q, slack), feet;
    std::sort(all.begin(), all.end(), [](const Nearest& a, const Nearest& b) { return a.distance < b.distance; });
    for (const Nearest& n : all) {
      if (n.distance > all.front().distance + slack) break;
      if (std::all_of(feet.begin(), feet.end(), [&](const Nearest& f) { return distance(f.point, n.point) > apart; })) feet.push_back(n);
    }
    return feet;
  }

  /// The curve's extreme point in a direction.
  Plane_point extreme(const Plane_point& e) const
  {
    Plane_point best = pieces_[0].samples()[0];
    const auto take = [&](const Plane_point& p) {
      if (dot(p, e) > dot(best, e)) best = p;
    };
    for (const Dense_piece& piece : pieces_) {
      const auto& p = piece.samples();
      std::size_t at = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        if (dot(p[i], e) > dot(p[at], e)) at = i;
      take(p[at]);
      double lo = piece.local(at == 0 ? 0 : at - 1), hi = piece.local(std::min(at + 1, p.size() - 1));
      for (int k = 0; k < 80; ++k) {
        const double c = lo + (hi - lo) / 3, d = hi - (hi - lo) / 3;
        (dot(piece.at(c), e) >= dot(piece.at(d), e) ? hi : lo) = dot(piece.at(c), e) >= dot(piece.at(d), e) ? d : c;
      }
      take(piece.at(lo));
    }
    return best;
  }

  /// Places inside an enclosed parameter: two at a joint.
  std::vector<Nearest> places(const Range& range) const
  {
    std::vector<Nearest> all;
    if (!std::isfinite(range.lo) || !std::isfinite(range.hi)) return all;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& piece = pieces_[i].range();
      const Rational lo = std::max(Rational(range.lo), piece.lo), hi = std::min(Rational(range.hi), piece.hi);
      if (lo > hi) continue;
      Nearest n;
      n.piece = i;
      n.s = piece.local(Rational((lo + hi) / 2)).get_d();
      n.point = pieces_[i].at(n.s);
      all.push_back(n);
    }
    return all;
  }

  /// The place inside an enclosed parameter whose distance from q is nearest to `radius`.
  std::optional<Nearest> place(const Range& range, const Plane_point& q, double radius) const
  {
    std::optional<Nearest> best;
    for (Nearest& n : places(range)) {
      n.distance = distance(n.point, q);
      if (!best || std::abs(n.distance - radius) < std::abs(best->distance - radius)) best = n;
    }
    return best;
  }

  /// Whether a polygon of close points winds about q.
  bool has_inside(const Plane_point& q) const
  {
    bool inside = false;
    for (const Dense_piece& piece : pieces_)
      for (std::size_t i = 0; i + 1 < piece.samples().size(); ++i) {
        const Plane_point &a = piece.samples()[i], &b = piece.samples()[i + 1];
        if ((a[1] > q[1]) != (b[1] > q[1]) && q[0] < a[0] + (q[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
      }
    return inside;
  }

private:
  std::vector<Nearest> minima(const Plane_point& q, double slack) const
  {
    std::vector<Nearest> all;
    std::vector<double> d;
    double best = std::numeric_limits<double>::infinity();
    for (const Dense_piece& piece : pieces_)
      for (const Plane_point& p : piece.samples()) {
        const double dx = p[0] - q[0], dy = p[1] - q[1];
        d.push_back(dx * dx + dy * dy);
        best = std::min(best, d.back());
      }
    const double bound = std::sqrt(best) + slack;
    const double* at = d.data();
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Dense_piece& piece = pieces_[k];
      const std::size_t n = piece.samples().size();
      for (std::size_t i = 0; i < n; ++i) {
        if ((i > 0 && at[i - 1] < at[i]) || (i + 1 < n && at[i + 1] < at[i]) || std::sqrt(at[i]) - piece.reach(i) > bound) continue;
        Nearest place;
        place.piece = k;
        place.s = piece.nearest_on(piece.local(i == 0 ? 0 : i - 1), piece.local(std::min(i + 1, n - 1)), q);
        place.point = piece.at(place.s);
        place.distance = distance(place.point, q);
        all.push_back(place);
      }
      at += n;
    }
    return all;
  }

  std::vector<Dense_piece> pieces_;
};

/// Least distance of two curves, to be compared with `enough`.
bool are_apart(const Dense_curve& a, const Dense_curve& b, double enough)
{
  for (const Dense_piece& p : a.pieces())
    for (std::size_t i = 0; i < p.samples().size(); i += 2)
      for (const Dense_piece& q : b.pieces())
        for (const Plane_point& y : q.samples())
          if (distance(p.samples()[i], y) <= enough) return false;
  for (const Dense_piece& p : a.pieces())
    for (int i = 0; i <= 600; ++i)
      if (b.distance_from(p.at(i / 600.0)) <= enough) return false;
  for (const Dense_piece& p : a.pieces())
    for (const Dense_piece& q : b.pieces())
      for (std::size_t i = 0; i + 1 < p.samples().size(); ++i)
        for (std::size_t k = 0; k + 1 < q.samples().size(); ++k)
          if (is_crossing(p.samples()[i], p.samples()[i + 1], q.samples()[k], q.samples()[k + 1])) return false;
  return true;
}

// ---------------------------------------------------------------------------------------------------------------- jobs

/// Two curves, or one to be bisected with itself.
struct Job {
  std::vector<Named_curve> curves;

  std::string show() const { return curves.size() == 1 ? curves[0].text : "a = " + curves[0].text + ", b = " + curves[1].text; }
};

Job random_pair(std::size_t number)
{
  Random random(0x54420000u + number);
  Curve_maker maker(random);
  const bool splines = number % 3 == 2, nested = splines && random.chance(25);
  for (;;) {
    try {
      const bool mixed = random.chance(25);
      if (nested) {
        Named_curve a = maker.ring(), b = maker.small();
        if (are_apart(Dense_curve(a.curve), Dense_curve(b.curve), 0.02)) return {{std::move(a), std::move(b)}};
        continue;
      }
      Named_curve a = splines ? maker.spline() : maker.bezier(), b = splines && !mixed ? maker.spline() : maker.bezier();
      if (splines && mixed && random.chance(50)) std::swap(a, b);
      if (are_apart(Dense_curve(a.curve), Dense_curve(b.curve), 0.02)) return {{std::move(a), std::move(b)}};
    } catch (const Invalid_input&) { // another one
    }
  }
}

/// Two Bezier curves with control points anywhere on the grid.
Job random_wide_pair(std::size_t number)
{
  Random random(0x54570000u + number);
  Curve_maker maker(random);
  for (;;) {
    try {
      Named_curve a = maker.wide_bezier(), b = maker.wide_bezier();
      if (are_apart(Dense_curve(a.curve), Dense_curve(b.curve), 0.005)) return {{std::move(a), std::move(b)}};
    } catch (const Invalid_input&) { // another one
    }
  }
}

/// Whether a curve stands still inside a piece, or crosses itself.
bool has_cusp_or_crossing(const Dense_curve& curve)
{
  std::vector<std::pair<Plane_point, Plane_point>> edges;
  for (const Dense_piece& piece : curve.pieces()) {
    const auto speed = [&](double s) { return length(piece.jet(s).v); };
    const std::size_t n = piece.samples().size();
    for (std::size_t i = 0; i < n; ++i) {
      if (i + 1 < n) edges.push_back({piece.samples()[i], piece.samples()[i + 1]});
      double lo = piece.local(i == 0 ? 0 : i - 1), hi = piece.local(std::min(i + 1, n - 1));
      for (int k = 0; k < 80; ++k) {
        const double c = lo + (hi - lo) / 3, d = hi - (hi - lo) / 3;
        (speed(c) <= speed(d) ? hi : lo) = speed(c) <= speed(d) ? d : c;
      }
      if (speed(lo) < 1e-6) return true;
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 2; j < edges.size(); ++j)
      if (is_crossing(edges[i].first, edges[i].second, edges[j].first, edges[j].second)) return true;
  return false;
}

/// Whether the pieces at a joint cross beside it.
bool crosses_at_joint(const Dense_piece& before, const Dense_piece& after)
{
  constexpr int n = 30;
  const auto at = [](const Dense_piece& piece, int j, bool from_end) { return piece.at(from_end ? 1 - std::ldexp(1.0, -j) : std::ldexp(1.0, -j)); };
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j)
      if (is_crossing(at(before, i, true), at(before, i + 1, true), at(after, j, false), at(after, j + 1, false))) return true;
  return false;
}

/// Whether a closed curve crosses itself nowhere, keeps away from itself, and stands still nowhere.
bool is_simple(const Dense_curve& curve)
{
  std::vector<Plane_point> p;
  std::vector<double> along{0};
  for (const Dense_piece& piece : curve.pieces())
    for (int i = 0; i < 64; ++i) p.push_back(piece.at(i / 64.0));
  for (std::size_t k = 0; k < curve.pieces().size(); ++k)
    if (crosses_at_joint(curve.pieces()[k], curve.pieces()[(k + 1) % curve.pieces().size()])) return false;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) along.push_back(along.back() + distance(p[i], p[(i + 1) % n]));
  for (std::size_t i = 0; i < n; ++i) {
    if (distance(p[i], p[(i + 1) % n]) < 1e-4) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      const double apart = std::min(along[j] - along[i], along[n] - along[j] + along[i]), d = distance(p[i], p[j]);
      if (is_crossing(p[i], p[i + 1], p[j], p[(j + 1) % n]) || (apart > 0.3 && d < 0.03) || d < 0.1 * apart) return false;
    }
  }
  return true;
}

/// A closed curve of 4 to 8 cubics with vertices about a circle or a star.
Job random_loop(std::size_t number, bool smooth)
{
  Random random((smooth ? 0x4D410000u : 0x4D430000u) + number);
  for (;;) {
    const int n = random.between(4, 8);
    const bool star = random.chance(35);
    std::vector<Vector> vertices;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::acos(-1) * (i + 0.5 * random.symmetric()) / n, radius = (star && i % 2 ? 0.55 : 1.0) + 0.35 * random.symmetric();
      vertices.push_back({fraction(std::lround(64 * radius * std::cos(angle)), 64), fraction(std::lround(64 * radius * std::sin(angle)), 64)});
    }
    const auto vertex = [&](int i) { return vertices[static_cast<std::size_t>((i + n) % n)]; };
    std::vector<Vector> before, after;
    for (int i = 0; i < n; ++i) {
      const Rational in(random.between(4, 9), 32), out = random.chance(50) ? in : Rational(random.between(4, 9), 32);
      Vector a = vertex(i), b = vertex(i);
      for (std::size_t k = 0; k < 2; ++k) {
        if (smooth) {
          const Rational t = vertex(i + 1)[k] - vertex(i - 1)[k];
          a[k] -= in * t;
          b[k] += out * t;
        } else {
          a[k] += (vertex(i - 1)[k] - vertex(i)[k]) / 4 + fraction(random.between(-16, 16), 64);
          b[k] += (vertex(i + 1)[k] - vertex(i)[k]) / 4 + fraction(random.between(-16, 16), 64);
        }
      }
      before.push_back(a);
      after.push_back(b);
    }
    std::vector<Vector> points;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      points.push_back(vertices[i]);
      points.push_back(after[i]);
      points.push_back(before[(i + 1) % vertices.size()]);
    }
    points.push_back(vertices[0]);
    try {
      Named_curve loop = named_loop(points);
      if (is_simple(Dense_curve(loop.curve))) return {{std::move(loop)}};
    } catch (const Invalid_input&) { // another one
    }
  }
}

// -------------------------------------------------------------------------------------------------------------- report

/// What became of the jobs.
struct Report {
  std::size_t jobs = 0, unsupported = 0, undecided = 0, arcs = 0, closed = 0, samples = 0, edges = 0, feet = 0, problems = 0;
  double seconds = 0, slowest = 0;
  std::map<std::string, std::size_t> kinds, reasons;
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
    out << jobs << " jobs (" << unsupported << " unsupported, " << undecided << " undecided, " << closed << " bounded), " << arcs << " arcs, " << samples << " points of them, " << edges
        << " points found by search, " << feet << " feet of vertices, " << problems << " problems; library " << seconds << " s, slowest " << slowest << " s";
    for (const auto& [kind, n] : kinds) out << "\n  " << kind << ": " << n;
    for (const auto& [reason, n] : reasons) out << "\n  unsupported: " << reason << ": " << n;
    return out.str();
  }
};

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// -------------------------------------------------------------------------------------------------------------- checks

/// What is asked of both kinds of bisectors.
class Checker {
public:
  Checker(const Job& job, const Locus<2>& result, const std::string& name, Report& report) : result_(result), scale_(result.scale()), job_(job), name_(name), report_(report)
  {
    for (const Named_curve& c : job.curves) curves_.emplace_back(c.curve);
  }

protected:
  /// One failure of a kind for each job.
  void say(const std::string& kind, const std::string& what)
  {
    if (said_.insert(kind).second) report_.say(kind, name_ + ": " + what + "; " + job_.show());
  }

  Report& report() { return report_; }

  /// The curve of a foot.
  const Dense_curve* curve_of(std::size_t input) const { return input < curves_.size() ? &curves_[input] : nullptr; }

  static std::string features(const Arc<2>& arc)
  {
    std::string text = "arc";
    for (std::size_t k = 0; k < arc.inputs().size(); ++k) text += " " + std::to_string(arc.inputs()[k]) + ":" + name_of(arc.features()[k]);
    return text;
  }

  std::size_t degree(std::size_t vertex) const
  {
    std::size_t n = 0;
    for (const auto& arc : result_.arcs()) n += (arc.source() == vertex) + (arc.target() == vertex);
    return n;
  }

  // ----------------------------------------------------------------------------------------------- points of the arcs

  void check_arcs()
  {
    report_.arcs += result_.arcs().size();
    for (const auto& arc : result_.arcs()) {
      const auto samples = arc.samples(17);
      if (samples.size() != 17) say("SAMPLES", std::to_string(samples.size()) + " for 17");
      polylines_.push_back(arc.polyline(1e-4));
      const auto& line = polylines_.back();
      if (line.size() < 2) say("POLYLINE", std::to_string(line.size()) + " points");
      double farthest = scale_;
      for (const auto& p : line)
        if (is_finite(plane(p.point()))) farthest = std::max(farthest, distance(plane(p.point()), plane(result_.centre())));
      if (!(line.error() <= 1e-3 * farthest)) say("POOR", features(arc) + ": polyline error " + show(line.error()) + " with " + std::to_string(line.size()) + " points, as far as " + show(farthest));
      for (std::size_t k = 0; k < samples.size(); ++k) check_point(arc, samples[k], "sample " + std::to_string(k));
      for (std::size_t k = 0; k < line.size(); ++k) check_point(arc, line[k], "polyline point " + std::to_string(k));
      check_ends(arc, samples);
      check_ends(arc, line.points());
    }
    check_overlaps();
  }

  void check_point(const Arc<2>& arc, const Arc_point<2>& sample, const std::string& which)
  {
    ++report_.samples;
    const Plane_point q = plane(sample.point());
    const std::string what = features(arc) + ", " + which + " at " + show(q);
    if (!is_finite(q) || !std::isfinite(sample.radius())) return say("NOT FINITE", what);
    if (!(sample.error() <= 1e-6 * std::max(scale_, sample.radius() * sample.radius() / scale_))) say("POOR", what + ": error " + show(sample.error()) + ", radius " + show(sample.radius()));
    const double tolerance = 1e-8 * scale_ + 4 * sample.error() + 1e-13 * sample.radius();
    std::vector<double> d;
    for (const Dense_curve& curve : curves_) d.push_back(curve.distance_from(q));
    if (!(std::abs(d.front() - d.back()) <= tolerance)) say("NOT BISECTOR", what + ": distances " + show(d.front()) + " and " + show(d.back()) + ", error " + show(sample.error()));
    for (const double x : d)
      if (!(std::abs(x - sample.radius()) <= tolerance)) say("RADIUS", what + ": radius " + show(sample.radius()) + ", distance " + show(x) + ", error " + show(sample.error()));
    if (sample.parameters().size() != 2 || arc.inputs().size() != 2) return say("PARAMETERS", what + ": " + std::to_string(sample.parameters().size()));
    for (std::size_t k = 0; k < 2; ++k) {
      const Dense_curve* curve = curve_of(arc.inputs()[k]);
      const double u = sample.parameter(k);
      const auto foot = curve ? curve->place({u, u}, q, sample.radius()) : std::nullopt;
      if (!foot) say("FOOT OF SAMPLE", what + ": none at parameter " + show(u));
      else if (!(std::abs(foot->distance - sample.radius()) <= 1e-7 * scale_ + 4 * sample.error() + 1e-13 * sample.radius()))
        say("FOOT OF SAMPLE", what + ": parameter " + show(u) + " of input " + std::to_string(arc.inputs()[k]) + " at distance " + show(foot->distance) + ", radius " + show(sample.radius()));
    }
  }

  /// Ends are where their vertices are, or far away.
  template <class Points>
  void check_ends(const Arc<2>& arc, const Points& points)
  {
    if (points.empty()) return;
    for (const bool last : {false, true}) {
      const auto& v = last ? arc.target() : arc.source();
      const Plane_point q = plane(last ? points[points.size() - 1].point() : points[0].point());
      if (!v) continue;
      const auto& vertex = result_.vertices()[*v];
      if (vertex.kind == Vertex_kind::infinity) {
        if (is_finite(q) && distance(q, plane(result_.centre())) < 0.99 * result_.cut_radius()) say("CUT", features(arc) + " to infinity ends at " + show(q));
      } else if (!vertex.point) {
        say("JOIN", "no point at a vertex of kind " + std::string(name_of(vertex.kind)));
      } else if (!(distance(q, plane(*vertex.point)) <= 1e-6 * std::max(scale_, vertex.radius))) {
        say("JOIN", features(arc) + " ends " + show(distance(q, plane(*vertex.point))) + " from its vertex " + show(plane(*vertex.point)));
      }
    }
    if (arc.is_closed() && !(distance(plane(points[0].point()), plane(points[points.size() - 1].point())) <= 1e-6 * scale_)) say("JOIN", "a closed arc is open");
  }

  /// The feet of a point of an arc, in the inputs' order.
  std::vector<Plane_point> feet_of(const Arc<2>& arc, const Arc_point<2>& p) const
  {
    std::vector<Plane_point> feet;
    if (p.parameters().size() != 2 || arc.inputs().size() != 2) return feet;
    for (std::size_t k = 0; k < 2; ++k) {
      const Dense_curve* curve = curve_of(arc.inputs()[k]);
      const auto foot = curve ? curve->place({p.parameter(k), p.parameter(k)}, plane(p.point()), p.radius()) : std::nullopt;
      if (!foot) return {};
      feet.push_back(foot->point);
    }
    if (arc.inputs()[0] > arc.inputs()[1]) std::swap(feet[0], feet[1]);
    return feet;
  }

  /// No arc runs where another one does, with its feet where the other's are.
  void check_overlaps()
  {
    for (std::size_t i = 0; i < result_.arcs().size(); ++i) {
      const auto& arc = result_.arcs()[i];
      const auto middle = arc.at(0.5);
      const Plane_point q = plane(middle.point());
      const auto feet = feet_of(arc, middle);
      for (std::size_t j = 0; j < result_.arcs().size() && !feet.empty(); ++j) {
        if (i == j) continue;
        const auto& line = polylines_[j];
        for (std::size_t k = 0; k + 1 < line.size(); ++k) {
          if (distance_from_segment(q, plane(line[k].point()), plane(line[k + 1].point())) > 2 * line.error() + 1e-6 * scale_) continue;
          const auto a = feet_of(result_.arcs()[j], line[k]), b = feet_of(result_.arcs()[j], line[k + 1]);
          if (a.empty() || b.empty()) continue;
          for (const bool swapped : {false, true}) {
            if (swapped && curves_.size() > 1) continue;
            bool is_same = true;
            for (std::size_t m = 0; m < 2; ++m) {
              const std::size_t n = swapped ? 1 - m : m;
              const double step = distance(a[n], b[n]) + 1e-9 * scale_;
              is_same = is_same && distance(feet[m], a[n]) <= step && distance(feet[m], b[n]) <= step;
            }
            if (is_same) say("OVERLAP", features(arc) + " and " + features(result_.arcs()[j]) + " at " + show(q));
          }
        }
      }
    }
  }

  double distance_from_result(const Plane_point& q) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& line : polylines_)
      for (std::size_t i = 0; i + 1 < line.size(); ++i) least = std::min(least, distance_from_segment(q, plane(line[i].point()), plane(line[i + 1].point())));
    return least;
  }

  void check_found(const Plane_point& q)
  {
    ++report_.edges;
    const double off = distance_from_result(q);
    if (!(off <= 2e-3 * scale_)) say("MISSED", show(q) + " is " + show(off) + " from the result");
  }

  // ------------------------------------------------------------------------------------------------ feet of vertices

  void check_feet()
  {
    for (const auto& v : result_.vertices()) {
      if (v.kind == Vertex_kind::infinity || !v.point) continue;
      const Plane_point at = plane(*v.point);
      const double small = 1e-6 * scale_ + 1e-12 * v.radius;
      const std::string what = std::string(name_of(v.kind)) + " vertex " + show(at);
      for (const Dense_curve& c : curves_) {
        const double d = c.distance_from(at);
        if (!(std::abs(d - v.radius) <= small)) say("VERTEX", what + ": radius " + show(v.radius) + ", distance " + show(d));
      }
      std::vector<Plane_point> places;
      bool has_feature = false;
      for (const Foot& f : v.feet) {
        ++report_.feet;
        has_feature = has_feature || f.feature == Feature::start || f.feature == Feature::end || f.feature == Feature::corner;
        const Dense_curve* curve = curve_of(f.input);
        if (!curve || f.parameters.empty()) {
          say("FEET", what + ": a foot of no input or without parameters");
          continue;
        }
        const auto foot = curve->place(f.parameters[0], at, v.radius);
        if (!foot) {
          say("FEET", what + ": no foot at parameter " + show(f.parameters[0].lo));
          continue;
        }
        if (!(std::abs(foot->distance - v.radius) <= small))
          say("FEET", what + ": " + name_of(f.feature) + " at parameter " + show(f.parameters[0].lo) + ".." + show(f.parameters[0].hi) + " of input " + std::to_string(f.input) + " at distance " + show(foot->distance) +
                        ", radius " + show(v.radius));
        if (std::all_of(places.begin(), places.end(), [&](const Plane_point& p) { return distance(p, foot->point) > 1e-9 * scale_; })) places.push_back(foot->point);
        check_feature(*curve, f, what);
      }
      if (v.kind == Vertex_kind::trim && places.size() < 3 && !has_feature) say("FEET", what + ": " + std::to_string(places.size()) + " different feet, all interior");
    }
  }

  /// Whether a piece stands still inside, at a parameter: it may turn back there.
  static bool is_standstill(const Dense_piece& piece, double at)
  {
    const double lo = piece.range().lo.get_d(), hi = piece.range().hi.get_d(), s = (at - lo) / (hi - lo);
    return s > 0 && s < 1 && length(piece.jet(s).v) <= 1e-7;
  }

  /// A start or an end is at an end of the curve, a corner at one of a piece or where it turns back.
  void check_feature(const Dense_curve& curve, const Foot& f, const std::string& what)
  {
    if (f.feature == Feature::interior) return;
    const auto& pieces = curve.pieces();
    const auto contains = [&](const Rational& u) { return Rational(f.parameters[0].lo) <= u && u <= Rational(f.parameters[0].hi); };
    bool found = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (f.feature == Feature::start) found = found || (i == 0 && contains(pieces[i].range().lo));
      else if (f.feature == Feature::end) found = found || (i + 1 == pieces.size() && contains(pieces[i].range().hi));
      else found = found || contains(pieces[i].range().lo) || contains(pieces[i].range().hi) || is_standstill(pieces[i], f.parameters[0].lo);
    }
    if (!found) say("FEET", what + ": no " + name_of(f.feature) + " at parameter " + show(f.parameters[0].lo));
  }

  /// The box of all curves, twice as great.
  std::array<Plane_point, 2> box() const
  {
    Plane_point lo{1e300, 1e300}, hi{-1e300, -1e300};
    for (const Dense_curve& c : curves_)
      for (const Dense_piece& piece : c.pieces())
        for (const Plane_point& p : piece.samples())
          for (std::size_t k = 0; k < 2; ++k) {
            lo[k] = std::min(lo[k], p[k]);
            hi[k] = std::max(hi[k], p[k]);
          }
    for (std::size_t k = 0; k < 2; ++k) {
      const double more = std::max(0.5 * (hi[k] - lo[k]), 0.1 * scale_);
      lo[k] -= more;
      hi[k] += more;
    }
    return {lo, hi};
  }

  const Locus<2>& result_;
  double scale_;
  std::vector<Dense_curve> curves_;
  std::vector<Polyline<2>> polylines_;

private:
  const Job& job_;
  std::string name_;
  Report& report_;
  std::set<std::string> said_;
};

/// The bisector of two disjoint curves is one simple curve, closed or from infinity to infinity.
class Pair_checker : public Checker {
public:
  using Checker::Checker;

  void run()
  {
    if (result_.status() != Status::certified || !result_.undecided().empty()) {
      ++report().undecided;
      say("UNDECIDED", result_.undecided().empty() ? "without a reason" : std::to_string(result_.undecided().size()) + " times: " + result_.undecided()[0].reason);
    }
    check_arcs();
    check_feet();
    if (result_.status() != Status::certified) return; // of what is known nothing more is claimed
    check_structure();
    check_infinity();
    check_grid();
  }

private:
  void check_structure()
  {
    if (result_.arcs().empty()) say("STRUCTURE", "no arcs");
    if (result_.components() != 1) say("STRUCTURE", std::to_string(result_.components()) + " components");
    std::size_t infinite = 0;
    for (std::size_t v = 0; v < result_.vertices().size(); ++v) {
      const bool is_infinite = result_.vertices()[v].kind == Vertex_kind::infinity;
      infinite += is_infinite;
      if (degree(v) != (is_infinite ? 1u : 2u))
        say("STRUCTURE", std::string(name_of(result_.vertices()[v].kind)) + " vertex of degree " + std::to_string(degree(v)) + (result_.vertices()[v].point ? " at " + show(plane(*result_.vertices()[v].point)) : ""));
    }
    if (infinite != 0 && infinite != 2) say("STRUCTURE", std::to_string(infinite) + " infinite vertices");
    report().closed += infinite == 0;
    for (const auto& arc : result_.arcs())
      if (arc.is_closed() && result_.arcs().size() != 1) say("STRUCTURE", "a closed arc among others");
    if (!result_.degenerate().empty()) say("STRUCTURE", std::to_string(result_.degenerate().size()) + " degenerate pieces: " + result_.degenerate()[0].kind);
    if (!result_.regions().empty()) say("STRUCTURE", "a region");
  }

  /// Far away in a direction, the curve is nearer whose extreme point is farther that way.
  void check_infinity()
  {
    const double small = 1e-3 * scale_;
    const auto difference = [&](const Plane_point& e) { return dot(curves_[0].extreme(e), e) - dot(curves_[1].extreme(e), e); };
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int k = 0; k < 180; ++k) {
      const double angle = std::acos(-1) * (k + 0.3) / 90, f = difference({std::cos(angle), std::sin(angle)});
      least = std::min(least, f);
      most = std::max(most, f);
    }
    std::size_t infinite = 0;
    for (std::size_t i = 0; i < result_.vertices().size(); ++i) {
      const auto& v = result_.vertices()[i];
      if (v.kind != Vertex_kind::infinity) continue;
      ++infinite;
      if (!v.direction && !v.asymptote) {
        say("INFINITY", "no direction");
        continue;
      }
      Plane_point e = plane(v.asymptote ? v.asymptote->direction : *v.direction);
      const auto far = point_before(i);
      if (far && dot(minus(*far, plane(result_.centre())), e) < 0) {
        say("SENSE", "direction " + show(e) + " points back");
        e = {-e[0], -e[1]};
      }
      const double f = difference(e);
      if (!(std::abs(length(e) - 1) <= 1e-9 && std::abs(f) <= 1e-6 * scale_)) say("INFINITY", "direction " + show(e) + ": the curves reach differently, by " + show(f));
      if (v.asymptote) check_asymptote(plane(v.asymptote->point), e);
    }
    if (least < -small && most > small && infinite != 2) say("INFINITY", std::to_string(infinite) + " ends, but each curve is nearer somewhere far away");
    if ((least > small || most < -small) && infinite != 0) say("INFINITY", std::to_string(infinite) + " ends, but one curve is nearer everywhere far away");
  }

  /// The end of the polyline to an infinite vertex.
  std::optional<Plane_point> point_before(std::size_t vertex) const
  {
    for (std::size_t k = 0; k < polylines_.size(); ++k) {
      if (polylines_[k].empty()) continue;
      if (result_.arcs()[k].source() == vertex) return plane(polylines_[k][0].point());
      if (result_.arcs()[k].target() == vertex) return plane(polylines_[k][polylines_[k].size() - 1].point());
    }
    return std::nullopt;
  }

  /// It passes midway between the extreme points; of which there may be two where a segment is perpendicular.
  void check_asymptote(const Plane_point& p, const Plane_point& e)
  {
    double off = std::numeric_limits<double>::infinity();
    for (const double i : {-1e-7, 1e-7})
      for (const double j : {-1e-7, 1e-7}) {
        const Plane_point middle = between(curves_[0].extreme({e[0] - i * e[1], e[1] + i * e[0]}), curves_[1].extreme({e[0] - j * e[1], e[1] + j * e[0]}), 0.5);
        off = std::min(off, std::abs(cross(minus(p, middle), e)));
      }
    if (!(off <= 1e-5 * scale_)) say("INFINITY", "asymptote along " + show(e) + " through " + show(p) + " is " + show(off) + " beside its place");
  }

  void check_grid()
  {
    constexpr std::size_t n = 28;
    const auto [lo, hi] = box();
    const auto difference = [&](const Plane_point& q) { return curves_[0].distance_from(q) - curves_[1].distance_from(q); };
    const auto place = [&, lo = lo, hi = hi](std::size_t i, std::size_t j) {
      return Plane_point{lo[0] + (static_cast<double>(i) + 0.013) / n * (hi[0] - lo[0]), lo[1] + (static_cast<double>(j) + 0.017) / n * (hi[1] - lo[1])};
    };
    std::vector<double> f((n + 1) * (n + 1));
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= n; ++j) f[i * (n + 1) + j] = difference(place(i, j));
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= n; ++j)
        for (const auto& [k, l] : {std::pair(i + 1, j), std::pair(i, j + 1)}) {
          if (k > n || l > n || (f[i * (n + 1) + j] > 0) == (f[k * (n + 1) + l] > 0)) continue;
          Plane_point a = place(i, j), b = place(k, l);
          const bool sign = f[i * (n + 1) + j] > 0;
          for (int step = 0; step < 30; ++step) {
            const Plane_point middle = between(a, b, 0.5);
            ((difference(middle) > 0) == sign ? a : b) = middle;
          }
          check_found(a);
        }
  }
};

/// The medial axis of a simple closed curve.
class Medial_checker : public Checker {
public:
  using Checker::Checker;

  void run()
  {
    if (result_.status() != Status::certified || !result_.undecided().empty()) {
      ++report().undecided;
      say("UNDECIDED", result_.undecided().empty() ? "without a reason" : std::to_string(result_.undecided().size()) + " times: " + result_.undecided()[0].reason);
    }
    check_arcs();
    check_feet();
    if (result_.status() != Status::certified) return;
    check_structure();
    check_leaves();
    check_corners();
    check_grid();
  }

private:
  const Dense_curve& curve() const { return curves_[0]; }
  bool is_inside(const Arc<2>& arc) const { return curve().has_inside(plane(arc.at(0.5).point())); }

  /// Vertices and arcs on one side.
  struct Side {
    std::set<std::size_t> vertices;
    std::size_t arcs = 0, components = 0;
    std::vector<std::size_t> infinite; ///< infinite vertices of components
  };

  Side side(bool inside) const
  {
    Side side;
    std::map<std::size_t, std::size_t> parent;
    const auto find = [&](std::size_t v) {
      while (parent[v] != v) v = parent[v];
      return v;
    };
    for (const auto& arc : result_.arcs()) {
      if (is_inside(arc) != inside) continue;
      ++side.arcs;
      if (arc.is_closed()) continue;
      for (const std::size_t v : {*arc.source(), *arc.target()})
        if (side.vertices.insert(v).second) parent[v] = v;
      parent[find(*arc.source())] = find(*arc.target());
    }
    std::map<std::size_t, std::size_t> infinite;
    for (const std::size_t v : side.vertices) infinite[find(v)] += result_.vertices()[v].kind == Vertex_kind::infinity;
    side.components = infinite.size();
    for (const auto& c : infinite) side.infinite.push_back(c.second);
    return side;
  }

  void check_structure()
  {
    const Side inside = side(true), outside = side(false);
    const auto numbers = [](const Side& s) { return std::to_string(s.vertices.size()) + " vertices, " + std::to_string(s.arcs) + " arcs, " + std::to_string(s.components) + " components"; };
    if (inside.components != 1 || inside.vertices.size() != inside.arcs + 1) say("INSIDE", "no tree: " + numbers(inside));
    for (const std::size_t n : inside.infinite)
      if (n != 0) say("INSIDE", "goes to infinity");
    if (outside.vertices.size() != outside.arcs + outside.components) say("OUTSIDE", "no trees: " + numbers(outside));
    for (const std::size_t n : outside.infinite)
      if (n != 1) say("OUTSIDE", "a component with " + std::to_string(n) + " infinite vertices");
    for (const std::size_t v : inside.vertices)
      if (outside.vertices.count(v)) say("STRUCTURE", "a vertex both inside and outside");
    for (std::size_t v = 0; v < result_.vertices().size(); ++v)
      if (degree(v) == 0) say("STRUCTURE", std::string(name_of(result_.vertices()[v].kind)) + " vertex without arcs");
  }

  /// Arcs end at corners and at centres of curvature; as many meet as there are feet.
  void check_leaves()
  {
    for (std::size_t i = 0; i < result_.vertices().size(); ++i) {
      const auto& v = result_.vertices()[i];
      if (!v.point || v.kind == Vertex_kind::infinity) continue;
      const Plane_point at = plane(*v.point);
      const std::size_t n = degree(i);
      const std::string what = std::string(name_of(v.kind)) + " vertex " + show(at) + " of degree " + std::to_string(n);
      // At a centre of curvature the distance is flat: what is found beside the foot is the foot.
      const auto feet = curve().feet(at, 1e-7 * scale_, (n == 1 ? 3e-2 : 1e-3) * scale_);
      const bool has_branches = feet.size() >= 3 || n >= 3;
      // Feet close together may be one to the search: those of the vertex are checked on their own.
      if (has_branches && feet.size() != n && (feet.size() > n || v.feet.size() != n)) say("BRANCHES", what + " has " + std::to_string(feet.size()) + " feet");
      if (n != 1 || v.radius <= 1e-6 * scale_) continue;
      double off = std::numeric_limits<double>::infinity();
      for (const auto& [piece, s] : sides(feet[0])) off = std::min(off, std::abs(std::abs(curve().pieces()[piece].curvature(s)) * v.radius - 1));
      if (feet.size() != 1 || !(off <= 1e-3)) say("LEAF", what + " is no centre of curvature, by " + show(off) + ", " + std::to_string(feet.size()) + " feet");
    }
  }

  /// A place, and beyond a joint next to it the next piece's.
  std::vector<std::pair<std::size_t, double>> sides(const Nearest& foot) const
  {
    const std::size_t n = curve().pieces().size();
    std::vector<std::pair<std::size_t, double>> all{{foot.piece, foot.s}};
    if (foot.s < 1e-4) all.push_back({(foot.piece + n - 1) % n, 1.0});
    if (foot.s > 1 - 1e-4) all.push_back({(foot.piece + 1) % n, 0.0});
    return all;
  }

  void check_corners()
  {
    double area = 0;
    for (const Dense_piece& piece : curve().pieces())
      for (std::size_t k = 0; k + 1 < piece.samples().size(); ++k) area += cross(piece.samples()[k], piece.samples()[k + 1]);
    const std::size_t n = curve().pieces().size();
    for (std::size_t k = 0; k < n; ++k) {
      const auto before = curve().pieces()[k].jet(1), after = curve().pieces()[(k + 1) % n].jet(0);
      const double turn = cross(before.v, after.v) / (length(before.v) * length(after.v));
      if (std::abs(turn) < 1e-6) continue;
      const bool inside = (turn > 0) == (area > 0);
      std::size_t ends = 0;
      for (const auto& arc : result_.arcs())
        for (const auto& v : {arc.source(), arc.target()}) {
          if (!v || !result_.vertices()[*v].point || distance(plane(*result_.vertices()[*v].point), after.p) > 1e-6 * scale_) continue;
          ++ends;
          if (is_inside(arc) != inside) say("CORNER", "an arc on the wrong side of the corner " + show(after.p));
        }
      if (ends != 1) say("CORNER", std::to_string(ends) + " arcs end at the corner " + show(after.p));
    }
  }

  /// Between neighbouring points of a grid the nearest foot jumps only on the medial axis.
  void check_grid()
  {
    constexpr std::size_t n = 28;
    const auto [lo, hi] = box();
    const auto place = [&, lo = lo, hi = hi](std::size_t i, std::size_t j) {
      return Plane_point{lo[0] + (static_cast<double>(i) + 0.013) / n * (hi[0] - lo[0]), lo[1] + (static_cast<double>(j) + 0.017) / n * (hi[1] - lo[1])};
    };
    std::vector<Plane_point> feet((n + 1) * (n + 1));
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= n; ++j) feet[i * (n + 1) + j] = curve().nearest(place(i, j)).point;
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= n; ++j)
        for (const auto& [k, l] : {std::pair(i + 1, j), std::pair(i, j + 1)}) {
          if (k > n || l > n) continue;
          Plane_point a = place(i, j), b = place(k, l), p = feet[i * (n + 1) + j], q = feet[k * (n + 1) + l];
          for (int step = 0; step < 40 && distance(p, q) > 0.02 * scale_; ++step) {
            const Plane_point middle = between(a, b, 0.5), foot = curve().nearest(middle).point;
            const bool first = distance(p, foot) >= distance(foot, q);
            (first ? b : a) = middle;
            (first ? q : p) = foot;
          }
          if (distance(p, q) > 0.02 * scale_) check_found(a);
        }
  }
};

/// For the environment variable LOCUS_TRUE_BISECTOR_SHOW: what was found.
std::string description(const Locus<2>& result)
{
  std::ostringstream out;
  out.precision(9);
  const auto ranges = [&](const std::vector<Range>& box) {
    for (const Range& r : box) out << " [" << r.lo << ", " << r.hi << "]";
  };
  for (std::size_t k = 0; k < result.arcs().size(); ++k) {
    const auto& arc = result.arcs()[k];
    out << "  arc " << k;
    for (const auto& v : {arc.source(), arc.target()}) out << (v ? " v" + std::to_string(*v) : " closed");
    for (std::size_t i = 0; i < arc.inputs().size(); ++i) out << ", " << arc.inputs()[i] << ' ' << name_of(arc.features()[i]);
    for (const double x : {0.0, 0.5, 1.0}) {
      const auto p = arc.at(x);
      out << (x == 0 ? ": " : " -> ") << '(' << p.point() << ')';
      ranges(p.parameters());
    }
    out << '\n';
  }
  for (std::size_t k = 0; k < result.vertices().size(); ++k) {
    const auto& v = result.vertices()[k];
    out << "  v" << k << ' ' << name_of(v.kind);
    if (v.point) out << " (" << *v.point << ") radius " << v.radius;
    for (const Foot& f : v.feet) {
      out << ", " << f.input << ' ' << name_of(f.feature);
      ranges(f.parameters);
    }
    out << '\n';
  }
  for (std::size_t k = 0; k < result.undecided().size(); ++k) {
    if (k >= 5 && k + 5 < result.undecided().size()) continue;
    out << "  undecided " << k;
    ranges(result.undecided()[k].box);
    out << ' ' << result.undecided()[k].reason << '\n';
  }
  return out.str();
}

std::optional<Locus<2>> run_job(Report& report, const Job& job, const std::string& name)
{
  ++report.jobs;
  std::optional<Locus<2>> found;
  try {
    const auto start = std::chrono::steady_clock::now();
    found = job.curves.size() == 1 ? bisector(job.curves[0].curve) : bisector(job.curves[0].curve, job.curves[1].curve);
    const double seconds = seconds_since(start);
    report.seconds += seconds;
    report.slowest = std::max(report.slowest, seconds);
    if (std::getenv("LOCUS_TRUE_BISECTOR_SHOW")) std::cerr << name << ": " << job.show() << '\n' << description(*found);
    if (seconds > 5) std::cerr << "SLOW " << name << " took " << seconds << " s; " << job.show() << std::endl;
    if (job.curves.size() == 1) Medial_checker(job, *found, name, report).run();
    else Pair_checker(job, *found, name, report).run();
  } catch (const Unsupported_feature& e) {
    ++report.unsupported;
    const std::string reason = e.what();
    ++report.reasons[reason.substr(0, reason.find(" ("))];
    if (std::none_of(job.curves.begin(), job.curves.end(), [](const Named_curve& c) { return has_cusp_or_crossing(Dense_curve(c.curve)); }))
      report.say("EXCEPTION", name + ": " + reason + ", but there is neither a cusp nor a crossing; " + job.show());
    std::cerr << "UNSUPPORTED " << name << ": " << e.what() << "; " << job.show() << std::endl;
  } catch (const std::exception& e) {
    report.say("EXCEPTION", name + ": " + e.what() + "; " + job.show());
  }
  return found;
}

std::size_t number_from(const char* variable, std::size_t otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// Nothing that is said may be wrong; some jobs are not decided yet (doc/mathematics.md says which), each of which counts as a problem.
void conclude(const Report& report, std::size_t most_undecided)
{
  std::cerr << report.text() << std::endl;
  INFO("LOCUS_TEST_SEED=" << locus_test::run_seed() << ", the first: " << report.first);
  CHECK(report.undecided <= most_undecided);
  CHECK(report.problems == report.undecided);
}

void run_loops(bool smooth)
{
  const std::size_t from = number_from("LOCUS_MEDIAL_FROM", 0), count = number_from("LOCUS_MEDIAL_COUNT", 40);
  Report report;
  for (std::size_t number = from; number < from + count; ++number) run_job(report, random_loop(number, smooth), (smooth ? "smooth loop " : "cornered loop ") + std::to_string(number));
  conclude(report, 0);
}

// ----------------------------------------------------------------------------------------------------- made by hand

Vector at(const Rational& x, const Rational& y) { return {x, y}; }

Named_curve segment(const Vector& a, const Vector& b) { return named_bezier({a, b}); }

/// A circle as a rational quadratic spline.
Named_curve spline_circle(const Rational& x, const Rational& y, const Rational& r)
{
  std::vector<Vector> points;
  const std::vector<std::array<int, 2>> around{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  std::vector<Rational> weights, knots{0, 0, 0};
  for (std::size_t k = 0; k < around.size(); ++k) {
    points.push_back({Rational(x + around[k][0] * r), Rational(y + around[k][1] * r)});
    weights.push_back(k % 4 == 2 ? 2 : 1);
    if (k % 2 == 0 && k > 0) knots.insert(knots.end(), 2, Rational(static_cast<long>(k) / 2));
  }
  knots.push_back(knots.back());
  return named_spline(2, points, knots, weights, true);
}

struct Expected {
  std::size_t arcs = 0, infinite = 0;
};

void run_by_hand(const std::string& name, const std::vector<Named_curve>& curves, const std::optional<Expected>& expected, const std::function<double(const Plane_point&)>& off)
{
  INFO(name);
  Report report;
  const auto result = run_job(report, Job{curves}, name);
  INFO(report.text() << ", the first: " << report.first);
  CHECK(report.undecided == 0);
  CHECK(report.problems == 0);
  REQUIRE(result);
  if (expected) {
    CHECK(result->arcs().size() == expected->arcs);
    std::size_t infinite = 0;
    for (const auto& v : result->vertices()) infinite += v.kind == Vertex_kind::infinity;
    CHECK(infinite == expected->infinite);
  }
  if (!off) return;
  locus_test::Samples samples;
  for (const auto& arc : result->arcs())
    for (const auto& p : arc.samples(9)) samples.expect(std::abs(off(plane(p.point()))) <= 1e-9 + 4 * p.error(), [&] { return show(plane(p.point())); });
  LOCUS_REQUIRE_SAMPLES(samples, 9);
}

void run_by_hand(const std::string& name, const Named_curve& a, const Named_curve& b, const std::optional<Expected>& expected = {}, const std::function<double(const Plane_point&)>& off = {})
{
  run_by_hand(name, std::vector<Named_curve>{a, b}, expected, off);
}

} // namespace

TEST_CASE("random pairs of disjoint curves: a dense search", "[true_bisector]")
{
  const std::size_t from = number_from("LOCUS_TRUE_BISECTOR_FROM", 0), count = number_from("LOCUS_TRUE_BISECTOR_COUNT", 300);
  Report report;
  for (std::size_t number = from; number < from + count; ++number) run_job(report, random_pair(number), "pair " + std::to_string(number));
  conclude(report, 7 + count / 40);
}

TEST_CASE("random pairs of disjoint Bezier curves: a dense search", "[true_bisector]")
{
  const std::size_t from = number_from("LOCUS_WIDE_FROM", 0), count = number_from("LOCUS_WIDE_COUNT", 150);
  Report report;
  for (std::size_t number = from; number < from + count; ++number) run_job(report, random_wide_pair(number), "wide pair " + std::to_string(number));
  conclude(report, 0);
}

TEST_CASE("random smooth loops: the medial axis", "[medial]") { run_loops(true); }

TEST_CASE("random loops with corners: the medial axis", "[medial]") { run_loops(false); }

TEST_CASE("two parallel segments", "[by_hand]")
{
  run_by_hand("opposite", segment(at(0, 0), at(2, 0)), segment(at(0, 1), at(2, 1)), Expected{3, 2}, [](const Plane_point& p) { return p[1] - 0.5; });
  run_by_hand("opposite, reversed", segment(at(0, 0), at(2, 0)), segment(at(2, 1), at(0, 1)), Expected{3, 2}, [](const Plane_point& p) { return p[1] - 0.5; });
  run_by_hand("shifted", segment(at(0, 0), at(2, 0)), segment(at(1, 1), at(4, 1)), Expected{5, 2});
  run_by_hand("without an overlap", segment(at(0, 0), at(1, 0)), segment(at(2, 1), at(3, 1)));
  run_by_hand("on one line", segment(at(0, 0), at(1, 0)), segment(at(2, 0), at(3, 0)), std::nullopt, [](const Plane_point& p) { return p[0] - 1.5; });
}

TEST_CASE("two perpendicular segments", "[by_hand]")
{
  run_by_hand("symmetric L", segment(at(1, 0), at(3, 0)), segment(at(0, 1), at(0, 3)), Expected{3, 2}, [](const Plane_point& p) { return p[0] - p[1]; });
  run_by_hand("L", segment(at(Rational(1, 2), 0), at(3, 0)), segment(at(0, 1), at(0, 2)));
  run_by_hand("T", segment(at(-1, 0), at(1, 0)), segment(at(0, Rational(1, 2)), at(0, 3)));
}

TEST_CASE("two short segments", "[by_hand]")
{
  run_by_hand("short", segment(at(0, 0), at(Rational(1, 64), 0)), segment(at(1, 1), at(1, Rational(65, 64))));
  run_by_hand("very short", segment(at(0, 0), at(Rational(1, 4096), Rational(1, 4096))), segment(at(1, 1), at(1, Rational(4097, 4096))));
}

TEST_CASE("two circles", "[by_hand]")
{
  const auto ring = [](const Plane_point& p) { return length(p) - 1.5; };
  run_by_hand("concentric", named_circle(at(0, 0), 1), named_circle(at(0, 0), 2), std::nullopt, ring);
  run_by_hand("concentric splines", spline_circle(0, 0, 1), spline_circle(0, 0, 2), std::nullopt, ring);
  run_by_hand("one in the other", named_circle(at(0, 0), 2), named_circle(at(Rational(1, 2), 0), 1), std::nullopt,
              [](const Plane_point& p) { return length(p) + distance(p, {0.5, 0}) - 3; });
  run_by_hand("side by side", named_circle(at(0, 0), 1), named_circle(at(3, 0), Rational(1, 2)), std::nullopt,
              [](const Plane_point& p) { return length(p) - distance(p, {3, 0}) - 0.5; });
  run_by_hand("of one size", spline_circle(0, 0, 1), spline_circle(3, 0, 1), std::nullopt, [](const Plane_point& p) { return p[0] - 1.5; });
}

TEST_CASE("two cubics with a known part", "[by_hand]")
{
  const Named_curve a = named_bezier({at(0, 0), at(1, 2), at(2, -1), at(3, 1)}), b = named_bezier({at(0, 3), at(1, Rational(5, 2)), at(2, 4), at(3, 3)});
  run_by_hand("two cubics", a, b);
  const auto result = bisector(a.curve, b.curve);
  std::size_t inner = 0;
  for (const auto& arc : result.arcs()) {
    if (arc.features()[0] != Feature::interior || arc.features()[1] != Feature::interior) continue;
    double lo = arc.at(0).parameter(arc.inputs()[0] == 1), hi = arc.at(1).parameter(arc.inputs()[0] == 1);
    if (lo > hi) std::swap(lo, hi);
    INFO("from " << lo << " to " << hi);
    inner += std::abs(lo - 0.12067) <= 1e-5 && std::abs(hi - 0.43885) <= 1e-5;
  }
  CHECK(inner == 1);
}

TEST_CASE("three pairs of quadratics", "[by_hand]")
{
  const auto q = [](long n) { return fraction(n, 4); };
  const auto bezier = [&](const std::vector<std::array<long, 2>>& quarters) {
    std::vector<Vector> points;
    for (const auto& p : quarters) points.push_back({q(p[0]), q(p[1])});
    return named_bezier(points);
  };
  run_by_hand("first", bezier({{-7, -3}, {-2, -8}, {-5, -8}}), bezier({{0, -7}, {7, -7}, {-3, -4}}));
  run_by_hand("second", bezier({{7, -4}, {-4, -7}, {0, -3}}), bezier({{-8, 6}, {1, -3}, {-2, 4}}));
  run_by_hand("third", bezier({{0, -1}, {6, 1}, {-3, 0}}), bezier({{3, 3}, {3, 4}, {5, 3}}));
}

/// Counts of a bisector of inputs that meet, and that all samples have the same distance to both.
void run_meeting(const std::string& name, const Named_curve& a, const Named_curve& b, std::size_t arcs, std::size_t regions, std::size_t nodes)
{
  INFO(name);
  const auto result = bisector(a.curve, b.curve);
  CHECK(result.undecided().empty());
  CHECK(result.arcs().size() == arcs);
  CHECK(result.regions().size() == regions);
  std::size_t found = 0;
  for (const auto& v : result.vertices()) found += v.kind == Vertex_kind::node;
  CHECK(found == nodes);
  const Dense_curve first(a.curve), second(b.curve);
  locus_test::Samples samples;
  for (const auto& arc : result.arcs())
    for (const auto& p : arc.samples(9)) {
      const Plane_point q = plane(p.point());
      samples.expect(std::abs(first.distance_from(q) - second.distance_from(q)) <= 1e-9 * (1 + p.radius()), [&] { return show(q); });
    }
  LOCUS_REQUIRE_SAMPLES(samples, 9);
}

TEST_CASE("inputs that meet", "[by_hand]")
{
  run_meeting("a common end, right angle", segment(at(0, 0), at(1, 0)), segment(at(0, 0), at(0, 1)), 4, 1, 0);
  run_meeting("a common end, straight on", segment(at(-1, 0), at(0, 0)), segment(at(0, 0), at(1, 0)), 1, 0, 0);
  run_meeting("a common end of curves", named_bezier({at(-2, 1), at(-1, 0), at(0, 0)}), named_bezier({at(0, 0), at(1, 1), at(2, 0)}), 5, 1, 0);
  run_meeting("crossing segments", segment(at(-1, -1), at(1, 1)), segment(at(-1, 1), at(1, -1)), 8, 0, 1);
  run_meeting("curves that cross twice", named_bezier({at(-2, 1), at(0, -2), at(2, 1)}), named_bezier({at(-2, -1), at(0, 1), at(2, -1)}), 15, 0, 2);
  run_meeting("T", segment(at(-1, 0), at(1, 0)), segment(at(0, 0), at(0, 1)), 5, 0, 1);
  for (const long shift : {0, 1}) {
    INFO("segments that overlap, shift " << shift);
    CHECK_FALSE(bisector(segment(at(0, 0), at(2, 0)).curve, segment(at(shift, 0), at(shift + 2, 0)).curve).undecided().empty());
  }
}

TEST_CASE("near ties", "[by_hand]")
{
  for (const unsigned long k : {20ul, 30ul, 40ul, 45ul}) {
    Integer power = 1;
    power <<= k;
    const Rational e(Integer(1), power);
    const auto run = [&](const std::string& name, const Named_curve& a, const Named_curve& b) {
      INFO(name << ", 2^-" << k);
      const auto result = bisector(a.curve, b.curve);
      CHECK(result.undecided().empty());
      std::vector<std::size_t> degree(result.vertices().size());
      std::size_t infinite = 0, closed = 0;
      for (const auto& arc : result.arcs()) {
        closed += arc.is_closed();
        for (const auto& v : {arc.source(), arc.target()})
          if (v) ++degree[*v];
      }
      for (std::size_t i = 0; i < degree.size(); ++i) {
        const bool is_infinite = result.vertices()[i].kind == Vertex_kind::infinity;
        infinite += is_infinite;
        CHECK(degree[i] == (is_infinite ? 1u : 2u));
      }
      CHECK(infinite + 2 * closed == 2);
    };
    run("mirror images", named_bezier({at(0, 1), at(1, 3), at(2, Rational(1, 2)), at(3, 2)}), named_bezier({at(0, -1), at(1, Rational(e - 3)), at(2, Rational(-1, 2)), at(3, -2)}));
    run("rational mirror images", named_bezier({at(0, 1), at(1, 3), at(2, Rational(1, 2))}, {1, 2, 1}), named_bezier({at(0, -1), at(1, Rational(e - 3)), at(2, Rational(-1, 2))}, {1, 2, 1}));
    run("parallel segments", segment(at(0, 0), at(2, 0)), segment(at(0, 1), at(2, Rational(1 + e))));
    run("opposite segments", segment(at(0, 0), at(2, 0)), segment(at(e, 1), at(Rational(2 - e), 1)));
    run("perpendicular segments", segment(at(-1, 0), at(1, 0)), segment(at(e, 1), at(0, 2)));
    run("circles with nearly one centre", named_circle(at(0, 0), 1), named_circle(at(e, 0), 2));
    run("a curve moved", named_bezier({at(0, 0), at(1, 2), at(2, -1), at(3, 1)}), named_bezier({at(0, Rational(1 + e)), at(1, 3), at(2, 0), at(3, 2)}));
    run("sides of a square", segment(at(-1, -1), at(-1, 1)), segment(at(1, -1), at(1, Rational(1 + e))));
    run("curves that are nearly equal", named_bezier({at(0, 0), at(1, 2), at(2, 0)}), named_bezier({at(0, Rational(1, 16)), at(1, Rational(33, 16)), at(2, Rational(Rational(1, 16) + e))}));
    // Circles between are as small as 2^-45 there; doubles do not tell all of it.
    if (k < 45) run("parabolas that nearly touch", named_bezier({at(-1, Rational(1 + e)), at(0, Rational(e - 1)), at(1, Rational(1 + e))}), named_bezier({at(-1, -1), at(0, 1), at(1, -1)}));
  }
}

void run_shape(const std::string& name, const Named_curve& curve, const Expected& expected) { run_by_hand(name, std::vector<Named_curve>{curve}, expected, {}); }

TEST_CASE("medial axes of simple shapes", "[by_hand]")
{
  run_shape("rectangle", named_polyline({at(0, 0), at(3, 0), at(3, 1), at(0, 1)}, true), {5, 0});
  run_shape("triangle", named_polyline({at(0, 0), at(3, 0), at(1, 2)}, true), {3, 0});
  run_shape("ellipse", {ellipse_2({0, 0}, 2, 1), "ellipse_2({0, 0}, 2, 1)"}, {1, 0});
}

TEST_CASE("the medial axis of a loop whose joints are smooth as drawn", "[by_hand]")
{
  // The decimals turn the tangents by 1e-11 to 3e-10.
  const std::vector<Vector> points{at(fraction(21, 64), fraction(55, 64)),
                                   at(fraction(-1, 64), fraction(10104166667, 10000000000)),
                                   at(fraction(-1, 2), fraction(8645833333, 10000000000)),
                                   at(fraction(-45, 64), fraction(5807291667, 10000000000)),
                                   at(fraction(-29, 32), fraction(19, 64)),
                                   at(fraction(-53, 64), fraction(-1, 8)),
                                   at(fraction(-5911458333, 10000000000), fraction(-3854166667, 10000000000)),
                                   at(fraction(-3541666667, 10000000000), fraction(-6458333333, 10000000000)),
                                   at(fraction(416666667, 10000000000), fraction(-7447916667, 10000000000)),
                                   at(fraction(3463541667, 10000000000), fraction(-6848958333, 10000000000)),
                                   at(fraction(6510416667, 10000000000), fraction(-5, 8)),
                                   at(fraction(8645833333, 10000000000), fraction(-13, 32)),
                                   at(fraction(8697916667, 10000000000), fraction(-729166667, 10000000000)),
                                   at(fraction(7, 8), fraction(2604166667, 10000000000)),
                                   at(fraction(43, 64), fraction(7083333333, 10000000000)),
                                   at(fraction(21, 64), fraction(55, 64))};
  const Named_curve loop = named_loop(points);
  Named_curve joined{with_join_tolerance(loop.curve, fraction(1, 100000000)), loop.text + " with a join tolerance of 1e-8"};
  std::size_t tolerated = 0;
  for (const Joint& joint : joined.curve.chain().joints) tolerated += joint.by_tolerance;
  CHECK(tolerated == 4);
  run_shape("loop", joined, {3, 0});
}

TEST_CASE("medial axes of polygons with several changes in one point", "[by_hand]")
{
  run_shape("square", named_polyline({at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, true), {4, 0});
  run_shape("square on a corner", named_polyline({at(0, -1), at(1, 0), at(0, 1), at(-1, 0)}, true), {4, 0});
  // Inside 5 arcs to convex corners, 2 between edges, 2 parabolas about the reflex corner; outside 3 from that corner to infinity.
  run_shape("L", named_polyline({at(0, 0), at(3, 0), at(3, 1), at(1, 1), at(1, 4), at(0, 4)}, true), {12, 1});
  for (const unsigned long k : {20ul, 30ul, 40ul, 48ul}) {
    Integer power = 1;
    power <<= k;
    const auto result = bisector(named_polyline({at(0, 0), at(1, 0), at(1, Rational(1 + Rational(Integer(1), power))), at(0, 1)}, true).curve);
    INFO("a square with a corner moved by 2^-" << k);
    if (k < 40) CHECK(result.undecided().empty());
    if (result.undecided().empty()) CHECK(result.arcs().size() == 5); // two vertices inside, however close
  }
}

TEST_CASE("sums of four square roots that are zero", "[by_hand]")
{
  const auto root = [](const Rational& f, const Rational& q) { return Signed_root(f, q); };
  CHECK(is_zero_sum({root(1, 2), root(1, 3), root(-1, 2), root(-1, 3)}));
  CHECK(is_zero_sum({root(1, 2), root(1, 8), root(-1, 18), root(0, 5)}));
  CHECK(is_zero_sum({root(1, 2), root(-1, 18), root(2, 2), root(7, 0)}));
  CHECK(is_zero_sum({root(3, 1), root(-1, 4), root(-1, 1), root(1, 0)}));
  CHECK(is_zero_sum({root(1, 2), root(Rational(-1, 2), 12), root(1, 3), root(-1, 2)}));
  CHECK_FALSE(is_zero_sum({root(1, 2), root(1, 3), root(1, 2), root(1, 3)}));
  CHECK_FALSE(is_zero_sum({root(1, 2), root(1, 3), root(-1, 5), root(-1, Rational(0))}));
  CHECK_FALSE(is_zero_sum({root(1, 2), root(-1, 3), root(1, 2), root(-1, 3)}));
  Integer power = 1;
  power <<= 300;
  CHECK_FALSE(is_zero_sum({root(1, 2), root(1, 3), root(-1, 2), root(-1, Rational(3 + Rational(Integer(1), power)))}));
}
