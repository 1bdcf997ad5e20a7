// SPDX-License-Identifier: LGPL-3.0-or-later
// Trimmed offsets against closed forms, against dense sampling in long double, and against Sturm's chains of the distance from
// single offset points to the whole curve, which are exact and share nothing with the solver.
#include <locus/construct/trimmed_offset.h>
#include <locus/curvature.h>
#include <locus/shape/edit_curve.h>

#include "support.h"

#include <catch2/catch.hpp>

using namespace locus;
using namespace locus_test;
using Kind = Offset_end_kind;

namespace {

double middle(const Range& r) { return r.lo + 0.5 * (r.hi - r.lo); }
bool holds(const Range& r, double x, double slack = 0) { return r.lo - slack <= x && x <= r.hi + slack; }
double distance(const Approximate_point<2>& a, double x, double y) { return std::hypot(a[0] - x, a[1] - y); }

std::string show(const Trimmed_offset& offset)
{
  std::string text;
  for (const auto& i : offset.intervals()) {
    text += " " + std::to_string(i.piece) + ":";
    for (const auto& e : i.ends) text += std::string(" ") + name_of(e.kind) + " " + std::to_string(middle(e.parameter));
  }
  return text;
}

std::size_t count_of(const Trimmed_offset& offset, Kind kind)
{
  std::size_t n = 0;
  for (const auto& i : offset.intervals())
    for (const auto& e : i.ends) n += e.kind == kind;
  return n;
}

bool is_whole(const Trimmed_offset& offset, std::size_t pieces)
{
  return offset.status() == Status::certified && offset.intervals().size() == pieces && count_of(offset, Kind::trim) == 0;
}

// ------------------------------------------------------------------------------------------------ a second way to look

/// A curve by its pieces' control points, by formulas of its own.
class Plain_offset {
public:
  using Real = long double;
  struct Place {
    std::size_t piece = 0;
    Real s = 0;
  };

  Plain_offset(const Curve_2& curve, const Rational& distance) : curve_(curve), distance_(distance), d_(real(distance))
  {
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      const auto& piece = curve.pieces()[i];
      std::array<std::vector<Real>, 3> c;
      for (std::size_t k = 0; k < 3; ++k)
        for (const Rational& x : (k < 2 ? piece.numerator[k] : piece.weight).coefficients()) c[k].push_back(real(x));
      pieces_.push_back(c);
      std::vector<std::array<Real, 2>> row;
      for (int j = 0; j <= samples; ++j) row.push_back(point(i, Real(j) / samples));
      grid_.push_back(row);
    }
  }

  std::array<Real, 2> offset(std::size_t piece, Real s) const
  {
    const auto p = point(piece, s);
    const auto [x, y, w] = jets(piece, s);
    const Real tx = x[1] * w[0] - x[0] * w[1], ty = y[1] * w[0] - y[0] * w[1], length = std::hypot(tx, ty);
    return {p[0] + d_ * ty / length, p[1] - d_ * tx / length};
  }

  /// The same with an exact velocity, which may nearly vanish.
  std::array<double, 2> offset_closely(std::size_t piece, const Rational& u) const
  {
    const auto [p, t] = exact_foot(piece, u);
    const double x = t[0].get_d(), y = t[1].get_d(), length = std::hypot(x, y), d = distance_.get_d();
    return {p[0].get_d() + d * y / length, p[1].get_d() - d * x / length};
  }

  /// The place of the whole curve that is nearest to the offset point of another one, as far as sampling finds it.
  Place nearest(std::size_t piece, Real s) const
  {
    const auto q = offset(piece, s);
    Place best;
    Real least = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const auto far = [&](Real t) { return length(point(i, t), q); };
      for (int k = 0; k <= samples; ++k) {
        const auto at = [&](int j) { return length(grid_[i][static_cast<std::size_t>(j)], q); };
        if ((k > 0 && at(k - 1) < at(k)) || (k < samples && at(k + 1) < at(k))) continue;
        Real lo = Real(std::max(0, k - 1)) / samples, hi = Real(std::min(samples, k + 1)) / samples;
        for (const Real t : {lo, hi, least_between(far, lo, hi)})
          if (const Real f = far(t); f < least) {
            least = f;
            best = {i, t};
          }
      }
    }
    return best;
  }

  /// Whether a place of the curve is strictly inside the circle about the offset point of u, exactly.
  bool is_inside(std::size_t piece, const Rational& u, const Place& v) const
  {
    const auto [p, t] = exact_foot(piece, u);
    const auto q = exact_foot(v.piece, Rational(static_cast<double>(v.s)))[0];
    const Rational dx = q[0] - p[0], dy = q[1] - p[1], a = dx * dx + dy * dy, b = distance_ * (t[1] * dx - t[0] * dy);
    return b > 0 && Rational((t[0] * t[0] + t[1] * t[1]) * a * a) < Rational(4 * b * b);
  }

  /// Whether any place of the curve is, exactly.
  bool is_occupied(std::size_t piece, const Rational& u) const
  {
    const auto [p, t] = exact_foot(piece, u);
    const auto powers = [](const Bernstein<Rational, 1>& f) { return trimmed(to_monomial(f)); };
    for (std::size_t j = 0; j < pieces_.size(); ++j) {
      const auto& c = curve_.pieces()[j];
      const Polynomial w = powers(c.weight);
      Polynomial x = plus(powers(c.numerator[0]), times(w, {Rational(-p[0])})), y = plus(powers(c.numerator[1]), times(w, {Rational(-p[1])}));
      Polynomial b = times(w, plus(times(x, {Rational(distance_ * t[1])}), times(y, {Rational(-distance_ * t[0])})));
      if (b.empty()) continue;
      if (j == piece) { // nothing changes its sign with (v - u)²
        const Polynomial root{Rational(-u), Rational(1)};
        x = quotient(x, root);
        y = quotient(y, root);
        b = quotient(quotient(b, root), root);
      }
      const Polynomial a = plus(times(x, x), times(y, y));
      const Polynomial f = plus(times(times(a, a), {Rational(t[0] * t[0] + t[1] * t[1])}), times(times(b, b), {Rational(-4)}));
      if (!f.empty() && is_somewhere_negative(f, b, Sturm(f), 0, 1)) return true;
    }
    return false;
  }

private:
  static constexpr int samples = 200;

  static Real real(const Rational& x)
  {
    const double near = x.get_d();
    return static_cast<Real>(near) + static_cast<Real>(Rational(x - Rational(near)).get_d());
  }
  static Real length(const std::array<Real, 2>& a, const std::array<Real, 2>& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

  /// De Casteljau: value and derivative.
  template <class T>
  static std::array<T, 2> jet(std::vector<T> c, const T& s)
  {
    const T rest = T(1) - s;
    const auto degree = static_cast<int>(c.size()) - 1;
    T slope(0);
    for (std::size_t n = c.size(); n > 1; --n) {
      if (n == 2) slope = T(T(degree) * T(c[1] - c[0]));
      for (std::size_t i = 0; i + 1 < n; ++i) c[i] = T(rest * c[i] + s * c[i + 1]);
    }
    return {c[0], slope};
  }
  std::array<std::array<Real, 2>, 3> jets(std::size_t i, Real s) const { return {jet(pieces_[i][0], s), jet(pieces_[i][1], s), jet(pieces_[i][2], s)}; }
  std::array<Real, 2> point(std::size_t i, Real s) const
  {
    const auto [x, y, w] = jets(i, s);
    return {x[0] / w[0], y[0] / w[0]};
  }
  /// Point and a vector along the tangent.
  std::array<std::array<Rational, 2>, 2> exact_foot(std::size_t i, const Rational& s) const
  {
    const auto& c = curve_.pieces()[i];
    const auto x = jet(c.numerator[0].coefficients(), s), y = jet(c.numerator[1].coefficients(), s), w = jet(c.weight.coefficients(), s);
    return {{{Rational(x[0] / w[0]), Rational(y[0] / w[0])}, {Rational(x[1] * w[0] - x[0] * w[1]), Rational(y[1] * w[0] - y[0] * w[1])}}};
  }

  template <class F>
  static Real least_between(F f, Real lo, Real hi)
  {
    for (int k = 0; k < 70; ++k) {
      const Real a = lo + (hi - lo) * Real(0.382), b = hi - (hi - lo) * Real(0.382);
      if (f(a) < f(b)) hi = b;
      else lo = a;
    }
    return (lo + hi) / 2;
  }

  /// Whether f < 0 < b somewhere; b vanishes nowhere where f is negative.
  static bool is_somewhere_negative(const Polynomial& f, const Polynomial& b, const Sturm& roots, const Rational& lo, const Rational& hi)
  {
    const Rational half = (lo + hi) / 2;
    for (const Rational& v : {lo, half, hi})
      if (horner(f, v) < 0 && horner(b, v) > 0) return true;
    const int inside = roots.open(lo, hi);
    if (inside == 0 || (inside == 1 && !roots.is_root(lo) && !roots.is_root(hi)) || Rational(hi - lo) < two_to(-80)) return false;
    return is_somewhere_negative(f, b, roots, lo, half) || is_somewhere_negative(f, b, roots, half, hi);
  }

  const Curve_2& curve_;
  Rational distance_;
  Real d_;
  std::vector<std::array<std::vector<Real>, 3>> pieces_;
  std::vector<std::vector<std::array<Real, 2>>> grid_;
};

/// Compares kept intervals with offset points at random and beside the ends: an occupied circle is shown by one point inside,
/// and what is found empty is proved so now and then.
class Judge {
public:
  Judge(const Curve_2& curve, const Trimmed_offset& offset, Random& random, Samples& samples, int exact_percent)
    : curve_(curve), offset_(offset), plain_(curve, offset.distance()), random_(random), samples_(samples), exact_percent_(exact_percent)
  {
  }

  void run(int count, const std::string& name)
  {
    name_ = name;
    samples_.expect(offset_.status() == Status::certified, [&] { return name_ + " is undecided"; });
    const auto& ranges = curve_.chain().pieces;
    for (std::size_t i = 0; i < ranges.size(); ++i)
      for (int k = 0; k < count; ++k) look(i, (k + random_.unit()) / count, 1e-7);
    for (const auto& interval : offset_.intervals())
      for (std::size_t e = 0; e < 2; ++e) {
        const auto& end = interval.ends[e];
        if (end.kind != Kind::trim) continue;
        const Rational u(middle(end.parameter));
        if (!ranges[interval.piece].contains(u)) continue;
        const double s = ranges[interval.piece].local(u).get_d();
        for (const double h : {1e-6, 1e-4, -1e-6, -1e-4}) look(interval.piece, s + h, 1e-7);
      }
  }

private:
  void look(std::size_t piece, double s, double margin)
  {
    if (!(s > 0 && s < 1)) return;
    const double u = curve_.chain().pieces[piece].at(Rational(s))->get_d();
    bool kept = false;
    for (const auto& i : offset_.intervals()) {
      if (i.piece != piece || u < i.ends[0].parameter.lo - margin || u > i.ends[1].parameter.hi + margin) continue;
      if (u < i.ends[0].parameter.hi + margin || u > i.ends[1].parameter.lo - margin) return; // too near to tell
      kept = true;
    }
    bool occupied = plain_.is_inside(piece, Rational(s), plain_.nearest(piece, s));
    if (!occupied && (!kept || random_.chance(exact_percent_))) occupied = plain_.is_occupied(piece, Rational(s));
    samples_.expect(kept != occupied, [&] {
      return name_ + ", d = " + locus_test::show(offset_.distance()) + ": at " + locus_test::show(s) + " of piece " + std::to_string(piece) +
             (kept ? " kept, but something is nearer" : " cut, but nothing is nearer") + "; " + ::show(offset_);
    });
  }

  const Curve_2& curve_;
  const Trimmed_offset& offset_;
  Plain_offset plain_;
  Random& random_;
  Samples& samples_;
  int exact_percent_;
  std::string name_;
};

/// That points and polylines are as near to the offset as they say.
void expect_drawn(const Curve_2& curve, const Trimmed_offset& offset, Samples& samples, const std::string& name = "")
{
  const Plain_offset plain(curve, offset.distance());
  for (std::size_t k = 0; k < offset.intervals().size(); ++k) {
    const auto& interval = offset.intervals()[k];
    const Polyline<2> line = offset.polyline(k, 1e-4);
    for (int j = 0; j <= 40; ++j) {
      const Arc_point<2> p = offset.at(k, j / 40.0);
      const Rational u(p.parameter(0));
      if (!curve.chain().pieces[interval.piece].contains(u)) continue;
      const Rational s = curve.chain().pieces[interval.piece].local(u);
      const auto [x, y] = plain.offset_closely(interval.piece, s);
      const double size = std::abs(x) + std::abs(y);
      samples.expect(locus_test::show(p.error()) != "inf" && distance(p.point(), x, y) <= p.error() + 1e-11 * size,
                     [&, x = x, y = y] { return name + ": a point " + locus_test::show(distance(p.point(), x, y)) + " off, error " + locus_test::show(p.error()) + " at " + s.get_str() + " of piece " + std::to_string(interval.piece); });
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const auto &a = line[i].point(), &b = line[i + 1].point();
        const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
        const double f = square > 0 ? std::min(1.0, std::max(0.0, ((x - a[0]) * dx + (y - a[1]) * dy) / square)) : 0;
        least = std::min(least, std::hypot(x - a[0] - f * dx, y - a[1] - f * dy));
      }
      samples.expect(least <= line.error() + 1e-11 * size, [&] { return name + ": a polyline " + locus_test::show(least) + " off, error " + locus_test::show(line.error()); });
    }
  }
}

Curve_2 parabola() { return bezier_2({{-2, 4}, {0, -4}, {2, 4}}); } // y = x², its parameter is (x+2)/4

Curve_2 powers(const std::vector<Number>& x, const std::vector<Number>& y, const Parameter_domain& domain = {})
{
  return monomial_curve<2>({{locus::detail::exact(x), locus::detail::exact(y)}}, {}, domain);
}

} // namespace

// ------------------------------------------------------------------------------------------------------- closed forms

TEST_CASE("Figure 3: the inner offset of a parabola is cut twice, where x² = d² - 1/4", "[offset]")
{
  for (const char* d : {"-0.6", "-1", "-1.5", "-2"}) {
    const Trimmed_offset offset = trimmed_offset(parabola(), d);
    INFO(d << ::show(offset));
    REQUIRE(offset.status() == Status::certified);
    REQUIRE(offset.intervals().size() == 2u);
    const double distance_squared = std::pow(Number(d).value().get_d(), 2), x = std::sqrt(distance_squared - 0.25);
    const auto &left = offset.intervals()[0], &right = offset.intervals()[1];
    CHECK(left.ends[0].kind == Kind::domain);
    CHECK(left.ends[0].exact == Rational(0));
    CHECK(right.ends[1].kind == Kind::domain);
    for (const auto& [end, sign] : {std::pair(left.ends[1], -1), std::pair(right.ends[0], 1)}) {
      CHECK(end.kind == Kind::trim);
      CHECK(holds(end.parameter, (2 + sign * x) / 4, 1e-15));
      CHECK(end.parameter.hi - end.parameter.lo < 1e-10);
      REQUIRE(end.point.has_value()); // of both ends the same
      CHECK(distance(*end.point, 0, distance_squared + 0.25) <= end.error + 1e-15);
    }
  }
  for (const char* d : {"-0.49", "0.3", "1", "1e-9", "1e9"}) CHECK(is_whole(trimmed_offset(parabola(), d), 1));
}

TEST_CASE("the whole parabola, its ends at infinity", "[offset]")
{
  const Curve_2 curve = powers({0, 1}, {0, 0, 1});
  const Trimmed_offset offset = trimmed_offset(curve, -3);
  INFO(::show(offset));
  CHECK(offset.status() == Status::certified);
  REQUIRE(count_of(offset, Kind::trim) == 2u);
  CHECK(count_of(offset, Kind::infinity) == 2u);
  for (const auto& i : offset.intervals())
    for (const auto& e : i.ends) {
      if (e.kind == Kind::trim) CHECK(holds({std::abs(middle(e.parameter)) - 1e-9, std::abs(middle(e.parameter)) + 1e-9}, std::sqrt(8.75)));
      if (e.kind == Kind::infinity) CHECK((std::isinf(e.parameter.lo) && !e.point));
    }
  const Trimmed_offset outer = trimmed_offset(curve, 3);
  REQUIRE(is_whole(outer, 3));
  CHECK(count_of(outer, Kind::joint) == 4u);
  for (std::size_t k = 0; k < 3; ++k) CHECK(outer.polyline(k, 1e-3).error() < 0.1);
}

TEST_CASE("inner offsets of an ellipse: none cut up to the least radius of curvature, four ends up to half the minor axis", "[offset]")
{
  const Curve_2 curve = ellipse_2({3, -1}, 2, 1); // least radius 1/2 at the ends of the major axis, quarters' joints
  const Rational tiny = two_to(-30), least(1, 2);
  for (const Rational& d : {Rational(1, 10), Rational(least - tiny), Rational(least - two_to(-54)), least}) {
    const Trimmed_offset offset = trimmed_offset(curve, Rational(-d));
    INFO(d << ::show(offset));
    CHECK(is_whole(offset, 4));
    CHECK(count_of(offset, Kind::joint) == 8u);
  }
  for (const Rational& d : {Rational(least + two_to(-54)), Rational(least + tiny), Rational(6, 10), Rational(9, 10), Rational(1 - tiny)}) {
    const Trimmed_offset offset = trimmed_offset(curve, Rational(-d));
    INFO(d << ::show(offset));
    CHECK(offset.status() == Status::certified);
    CHECK(offset.intervals().size() == 4u);
    REQUIRE(count_of(offset, Kind::trim) == 4u);
    CHECK(count_of(offset, Kind::joint) == 4u);
    const double sine2 = Rational((4 * d * d - 1) / 3).get_d(), x = std::sqrt(1 - sine2) * (2 - 1 / 2.0); // σ = 2d
    for (const auto& i : offset.intervals())
      for (const auto& e : i.ends) {
        if (e.kind != Kind::trim) continue;
        CHECK(std::min(distance(*e.point, 3 + x, -1), distance(*e.point, 3 - x, -1)) <= e.error + 1e-9);
        const double from_axis = std::abs(middle(e.parameter) - 2 * std::round(middle(e.parameter) / 2)), tangent = from_axis; // of half the angle
        CHECK(std::abs(2 * tangent / (1 + tangent * tangent) - std::sqrt(sine2)) <= 1e-4 * std::sqrt(sine2));
      }
  }
  for (const Rational& d : {Rational(1), Rational(1 + tiny), Rational(2), Rational(4)}) {
    const Trimmed_offset offset = trimmed_offset(curve, Rational(-d));
    INFO(d << ::show(offset));
    CHECK(offset.status() == Status::certified);
    CHECK(offset.intervals().empty());
  }
  CHECK(is_whole(trimmed_offset(curve, 100), 4));
}

TEST_CASE("circles: to the centre and no farther", "[offset]")
{
  const Curve_2 curve = circle_2({5, 7}, "3/2");
  for (const Rational& d : {Rational(3, 2), Rational(Rational(3, 2) - two_to(-30)), Rational(Rational(3, 2) - two_to(-200)), Rational(1, 7)}) {
    const Trimmed_offset offset = trimmed_offset(curve, Rational(-d));
    CHECK(is_whole(offset, 4));
    const double radius = 1.5 - d.get_d();
    for (std::size_t k = 0; k < offset.intervals().size(); ++k)
      for (const double x : {0.0, 0.3, 1.0}) {
        const auto p = offset.at(k, x);
        CHECK(std::abs(distance(p.point(), 5, 7) - radius) <= p.error() + 1e-15);
      }
  }
  for (const Rational& d : {Rational(2), Rational(Rational(3, 2) + two_to(-30)), Rational(Rational(3, 2) + two_to(-200))}) {
    CHECK(trimmed_offset(curve, Rational(-d)).intervals().empty());
    CHECK(is_whole(trimmed_offset(curve, d), 4));
  }
  // An arc of less than half a circle, beyond the centre: its ends are as near, and the rest nearer.
  const Curve_2 arc = arc_2({1, 0}, {0, 1}, "2/5");
  CHECK(trimmed_offset(arc, -2).intervals().empty());
  CHECK(is_whole(trimmed_offset(arc, 2), 1));
}

TEST_CASE("lines, corners and channels", "[offset]")
{
  for (const int d : {1, -1, 1000}) CHECK(is_whole(trimmed_offset(segment_2({0, 0}, {3, 1}), d), 1));
  CHECK(is_whole(trimmed_offset(line_2({0, 0}, {3, 1}), 2), 3));
  // Outside of a corner both sides are kept, up to it; inside they are cut at the same point.
  const Curve_2 angle = polyline_2({{0, 0}, {3, 0}, {3, 2}});
  const Trimmed_offset outer = trimmed_offset(angle, 1);
  CHECK(is_whole(outer, 2));
  CHECK(count_of(outer, Kind::corner) == 2u);
  const Trimmed_offset inner = trimmed_offset(angle, "-1/2");
  REQUIRE(inner.intervals().size() == 2u);
  CHECK(holds(inner.intervals()[0].ends[1].parameter, 2.5 / 3, 1e-15));
  CHECK(inner.intervals()[1].ends[0].exact == Rational(5, 4));
  CHECK(distance(*inner.intervals()[1].ends[0].point, 2.5, 0.5) <= inner.intervals()[1].ends[0].error + 1e-15);
  // Where two sides are 2|d| apart the offset of either is kept, from both; farther none is.
  const Curve_2 channel = polyline_2({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  const Trimmed_offset tied = trimmed_offset(channel, -1);
  INFO(::show(tied));
  CHECK(tied.status() == Status::certified);
  REQUIRE(tied.intervals().size() == 2u);
  CHECK(holds(tied.intervals()[0].ends[1].parameter, 0.75));
  CHECK(holds(tied.intervals()[1].ends[0].parameter, 2.25));
  CHECK(trimmed_offset(channel, Rational(-1 - two_to(-40))).intervals().empty());
  // A way back along the same line, and a square whose offset has shrunk to a point.
  for (const int d : {1, -1}) CHECK(is_whole(trimmed_offset(polyline_2({{0, 0}, {4, 0}, {1, 0}}), d), 2));
  const Curve_2 square = polyline_2({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, true);
  CHECK(is_whole(trimmed_offset(square, 1), 4));
  CHECK(trimmed_offset(square, -1).intervals().empty());
  CHECK(trimmed_offset(square, "-1/3").intervals().size() == 4u);
}

TEST_CASE("corners with sides that bend towards the offset", "[offset]")
{
  // Beside the corner the sign of what a squared condition compares changes along a parabola: no cell of squares tells it.
  const Curve_2 spike = bspline_2(2, {{0, 0}, {2, 1}, {3, 4}, {4, 1}, {6, 0}}, {0, 0, 0, 1, 1, 2, 2, 2});
  const Trimmed_offset outer = trimmed_offset(spike, -1);
  CHECK(is_whole(outer, 2));
  CHECK(count_of(outer, Kind::corner) == 2u);
  CHECK(outer.statistics().exact_cells == 0u);
  CHECK(outer.statistics().cells < 40u);
  const Trimmed_offset inner = trimmed_offset(spike, 1);
  REQUIRE(inner.intervals().size() == 2u);
  CHECK(count_of(inner, Kind::trim) == 2u);
  CHECK(std::abs((*inner.intervals()[0].ends[1].point)[0] - 3) <= inner.intervals()[0].ends[1].error);
}

// ------------------------------------------------------------------------------------------------- other descriptions

TEST_CASE("knots, degree, direction and place make no difference", "[offset]")
{
  const Curve_2 plain = bezier_2({{0, 0}, {4, 3}, {-2, 3}, {3, 0}});
  const Trimmed_offset expected = trimmed_offset(plain, "-1/5");
  REQUIRE(count_of(expected, Kind::trim) == 4u);
  const auto trims = [](const Trimmed_offset& offset) {
    std::vector<double> u;
    for (const auto& i : offset.intervals())
      for (const auto& e : i.ends)
        if (e.kind == Kind::trim) u.push_back(middle(e.parameter));
    std::sort(u.begin(), u.end());
    return u;
  };
  const auto agree = [&](const Trimmed_offset& offset, double sign) {
    const auto a = trims(expected);
    auto b = trims(offset);
    for (double& u : b) u *= sign;
    std::sort(b.begin(), b.end());
    bool same = a.size() == b.size();
    for (std::size_t k = 0; same && k < a.size(); ++k) same = std::abs(a[k] - b[k]) < 1e-9;
    return same;
  };
  Curve_2 cut = plain;
  for (const Rational& u : {Rational(1, 3), Rational(1, 2), Rational(9, 10)}) cut = with_inserted_knot(cut, u);
  const Trimmed_offset in_pieces = trimmed_offset(cut, "-1/5");
  INFO(::show(in_pieces));
  CHECK(agree(in_pieces, 1));
  CHECK(count_of(in_pieces, Kind::joint) == 6u);
  CHECK(agree(trimmed_offset(elevated(plain, 2), "-1/5"), 1));
  CHECK(agree(trimmed_offset(reversed(plain), "1/5"), -1));
  // A billion times as large, and far away.
  std::vector<Coordinates_2> points;
  for (const auto& [x, y] : {std::pair(0, 0), {4, 3}, {-2, 3}, {3, 0}}) points.push_back({Rational(Rational(x) * 1000000000 + 7), Rational(Rational(y) * 1000000000 - Rational("1000000000000000"))});
  CHECK(agree(trimmed_offset(bezier_2(points), Rational(-200000000)), 1));
}

// -------------------------------------------------------------------------------------------- close to and at a tie

TEST_CASE("distances near a least radius of curvature, on both sides, and exactly it", "[offset]")
{
  Random random(5);
  Samples samples;
  const Curve_2 curve = parabola();
  CHECK(is_whole(trimmed_offset(curve, "-1/2"), 1));
  for (const int e : {-20, -30, -45, -60, -100}) {
    CHECK(is_whole(trimmed_offset(curve, Rational(Rational(-1, 2) + two_to(e))), 1));
    const Rational d = Rational(1, 2) + two_to(e);
    const Trimmed_offset offset = trimmed_offset(curve, Rational(-d));
    INFO(e << ::show(offset));
    CHECK(offset.status() == Status::certified);
    REQUIRE(offset.intervals().size() == 2u);
    const double x = std::sqrt(Rational(d * d - Rational(1, 4)).get_d());
    CHECK(std::abs(middle(offset.intervals()[0].ends[1].parameter) - (2 - x) / 4) <= 1e-10);
    CHECK(std::abs(middle(offset.intervals()[1].ends[0].parameter) - (2 + x) / 4) <= 1e-10);
    CHECK(offset.intervals()[0].ends[1].parameter.hi <= offset.intervals()[1].ends[0].parameter.lo);
  }
  // Vertices of cubics at irrational parameters: the radius is known to a few 1e-16 only.
  int vertices = 0;
  for (int k = 0; vertices < 12 && k < 100; ++k) {
    std::vector<Coordinates_2> points;
    for (int i = 0; i < 4; ++i) points.push_back({random.between(-9, 9), random.between(-9, 9)});
    const Curve_2 cubic = bezier_2(points);
    for (const auto& p : curvature_points(cubic)) {
      if (p.kind != Curvature_event::extremum || !p.centre || p.radius > 20) continue;
      const double u = middle(p.parameter);
      const bool left = p.curvature.lo > 0;
      if (left ? !p.is_maximum() : !p.is_minimum()) continue;
      ++vertices;
      for (const int side : {1, -1}) { // below, above the radius
        const Rational d = Rational(p.radius) * (1 - side * two_to(-30)) * (left ? -1 : 1);
        const Trimmed_offset offset = trimmed_offset(cubic, d);
        const Plain_offset plain(cubic, d);
        bool kept = false;
        for (const auto& i : offset.intervals()) kept = kept || (i.ends[0].parameter.hi < u && u < i.ends[1].parameter.lo);
        samples.expect(offset.status() == Status::certified && kept != plain.is_occupied(0, Rational(u)) && (side > 0 || !kept),
                       [&] { return "vertex at " + locus_test::show(u) + ", side " + std::to_string(side) + ::show(offset); });
        Judge(cubic, offset, random, samples, 20).run(8, "near a vertex");
      }
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
}

TEST_CASE("feet that are tied along whole stretches, and touching places", "[offset]")
{
  // Two arcs back to back, and side by side at 2|d|.
  const Curve_2 twice = bspline_2(2, {{-1, 1}, {0, -1}, {1, 1}, {0, 3}, {1, 1}, {0, -1}, {-1, 1}}, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3});
  const Trimmed_offset same_way_back = trimmed_offset(twice, "2/5"); // y = x² there and back
  INFO(::show(same_way_back));
  CHECK(same_way_back.status() == Status::certified);
  Random random(6);
  Samples samples;
  for (const char* d : {"2/5", "-2/5", "3/2", "-3/2"}) Judge(twice, trimmed_offset(twice, d), random, samples, 30).run(12, "there and back");
  // The end of a curve on its own middle; a closed loop that touches itself.
  for (const char* d : {"1/4", "-1/4", "1", "-1"}) {
    const Curve_2 tee = polyline_2({{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 0}});
    Judge(tee, trimmed_offset(tee, d), random, samples, 30).run(12, "an end on the curve");
    const Curve_2 eight = polyline_2({{0, 0}, {2, 1}, {4, 0}, {2, 1}, {4, 3}, {0, 3}, {2, 1}}, true);
    Judge(eight, trimmed_offset(eight, d), random, samples, 30).run(12, "a curve through one point three times");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 300);
}

// --------------------------------------------------------------------------------------------------------------- cusps

TEST_CASE("where a curve reverses inside a piece its right side changes", "[offset]")
{
  // (s, s²) with s = u³/3 - u/2: back along the same way from u = 1/√2 on.
  const Parameter_domain unit{Rational(0), Rational(1)};
  const Trimmed_offset line = trimmed_offset(powers({0, "-1/2", 0, "1/3"}, {0, -1, 0, "2/3"}, unit), 1);
  const Trimmed_offset arc = trimmed_offset(powers({0, "-1/2", 0, "1/3"}, {0, 0, "1/4", 0, "-1/3", 0, "1/9"}, unit), "1/5");
  for (const Trimmed_offset* offset : {&line, &arc}) {
    INFO(::show(*offset));
    CHECK(offset->status() == Status::certified);
    REQUIRE(offset->intervals().size() == 2u);
    CHECK(count_of(*offset, Kind::cusp) == 2u);
    const auto &before = offset->intervals()[0].ends[1], &after = offset->intervals()[1].ends[0];
    CHECK(holds(before.parameter, std::sqrt(0.5)));
    CHECK(holds(after.parameter, std::sqrt(0.5)));
    const double across = 2 * std::abs(offset->distance().get_d());
    CHECK(std::abs(distance(*before.point, (*after.point)[0], (*after.point)[1]) - across) <= before.error + after.error + 1e-12);
  }
  // A cusp of the usual kind, at a rational parameter inside: both branches are cut before it.
  const Curve_2 cusp = bezier_2({{1, -1}, {"-1/3", 1}, {"-1/3", -1}, {1, 1}}); // (t², t³) from -1 to 1
  Random random(8);
  Samples samples;
  for (const char* d : {"1/4", "-1/4", "1/100"}) {
    const Trimmed_offset offset = trimmed_offset(cusp, d);
    CHECK(offset.intervals().size() == 2u);
    CHECK(count_of(offset, Kind::trim) == 2u);
    Judge(cusp, offset, random, samples, 30).run(12, "a cusp");
    const Trimmed_offset parts = trimmed_offset(split_at_cusps(cusp), d);
    CHECK(parts.intervals().size() == 2u);
    CHECK(std::abs(middle(parts.intervals()[0].ends[1].parameter) - middle(offset.intervals()[0].ends[1].parameter)) < 1e-10);
  }
  LOCUS_REQUIRE_SAMPLES(samples, 40);
}

// -------------------------------------------------------------------------------------------------------------- random

TEST_CASE("random curves of all kinds against dense sampling and exact emptiness", "[offset]")
{
  Random random(1994);
  Samples samples, drawn;
  std::size_t trims = 0, corners = 0;
  for (int job = 0; job < 330; ++job) {
    const int size = random.chance(50) ? 6 : 60;
    const auto points = [&](int n) {
      std::vector<Coordinates_2> p;
      for (int i = 0; i < n; ++i) {
        const int x = random.between(-size, size), y = random.between(-size, size);
        p.push_back({x, y});
      }
      return p;
    };
    const auto weights = [&](int n) {
      std::vector<Number> w;
      for (int i = 0; i < n; ++i) w.emplace_back(random.between(1, 4));
      return w;
    };
    /// A spline with knots of random multiplicity up to `most`.
    const auto spline = [&](int degree, int most, bool rational) {
      std::vector<Number> knots(static_cast<std::size_t>(degree) + 1, Number(0));
      const int inner = random.between(1, 3);
      int n = degree + 1;
      for (int k = 1; k <= inner; ++k) {
        const int times = random.between(1, most);
        knots.insert(knots.end(), static_cast<std::size_t>(times), Number(k));
        n += times;
      }
      knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, Number(inner + 1));
      const auto p = points(n);
      return bspline_2(degree, p, knots, rational ? weights(n) : std::vector<Number>{});
    };
    std::optional<Curve_2> made;
    try {
      switch (job % 10) {
      case 0:
      case 1:
        made = bezier_2(points(4));
        break;
      case 2:
        made = bezier_2(points(3));
        break;
      case 3: {
        const auto p = points(4);
        made = bezier_2(p, weights(4));
        break;
      }
      case 4:
        made = bezier_2(points(5));
        break;
      case 5:
        made = spline(3, 1, false);
        break;
      case 6: {
        const int degree = random.between(1, 3); // in this order with every compiler
        made = spline(degree, 2, random.chance(40));
        break;
      }
      case 7: {
        const int n = random.between(2, 6);
        const auto p = points(n);
        made = polyline_2(p, random.chance(50));
        break;
      }
      case 8: {
        const int a = random.between(1, 9), b = random.between(1, 9);
        made = ellipse_2({1, -2}, a, b);
        break;
      }
      default: {
        auto p = points(4);
        p.push_back(p[0]);
        made = bspline_2(2, p, {0, 0, 0, 1, 1, 2, 2, 2}, {}, true);
      }
      }
    } catch (const Invalid_input&) {
      continue; // points that repeat each other
    }
    Rational d = random.chance(40) ? Rational(random.between(1, 8)) : random.chance(50) ? Rational(Rational(random.between(1, 64)) / 8) : Rational(20 * random.unit() + 1e-3);
    if (random.chance(50)) d = -d;
    const Trimmed_offset offset = trimmed_offset(*made, d);
    trims += count_of(offset, Kind::trim);
    corners += count_of(offset, Kind::corner);
    Judge(*made, offset, random, samples, 3).run(10, "job " + std::to_string(job));
    if (job % 4 == 0) expect_drawn(*made, offset, drawn, "job " + std::to_string(job));
  }
  CHECK(trims > 200u);
  CHECK(corners > 20u);
  LOCUS_REQUIRE_SAMPLES(samples, 5000);
  LOCUS_REQUIRE_SAMPLES(drawn, 1000);
}

// -------------------------------------------------------------------------------------------------------------- limits

TEST_CASE("what is asked wrongly, what is cancelled, and few cells", "[offset]")
{
  CHECK(thrown<Invalid_input>([] { trimmed_offset(parabola(), 0); }) == 1);
  CHECK(thrown<Unsupported_feature>([] { trimmed_offset(parabola(), "1e200"); }) == 1);
  Offset_options options;
  options.control.max_cells = 1; // elimination does the rest
  const Trimmed_offset by_elimination = trimmed_offset(parabola(), -1, options);
  CHECK(by_elimination.status() == Status::certified);
  REQUIRE(by_elimination.intervals().size() == 2u);
  CHECK(holds(by_elimination.intervals()[1].ends[0].parameter, (2 + std::sqrt(0.75)) / 4, 1e-15));
  options.control.cancel = std::make_shared<std::atomic<bool>>(true);
  const Trimmed_offset cancelled = trimmed_offset(parabola(), -1, options);
  CHECK(cancelled.status() == Status::undecided);
  CHECK(cancelled.intervals().empty());
  REQUIRE(cancelled.undecided().size() == 1u);
  CHECK(cancelled.undecided()[0].box[0].lo == 0);
  CHECK(cancelled.undecided()[0].box[0].hi == 1);
}

// ------------------------------------------------------------------------------------------- requirements with a root

TEST_CASE("a polynomial near a square root, with bounds of how far both and their slopes are apart", "[offset]")
{
  Random random(31);
  Samples samples;
  for (int k = 0; k < 2000; ++k) {
    const int n = random.between(0, 8);
    Bernstein<Rational, 1> f(Degrees<1>{n});
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = Rational(random.unit()) + two_to(-random.between(1, 40));
    const int mode = rounding_modes[static_cast<std::size_t>(random.below(4))];
    std::optional<Root_enclosure> root;
    const Enclosed_vector form = with_upward_rounding([&] { return Enclosed_vector({f}); });
    in_mode(mode, [&] { root = root_enclosure(form); });
    if (!root) continue;
    for (int j = 0; j <= 20; ++j) {
      const Rational u(j, 20);
      const auto value = [&](const Bernstein<Rational, 1>& g) { return static_cast<long double>(evaluate_at(g, u).get_d()); };
      const auto near = converted<Rational>(root->near, [](double x) { return Rational(x); });
      const long double s = std::sqrt(value(f)), slope = value(derivative(f)) / (2 * s);
      samples.expect(std::abs(s - value(near)) <= root->error + 1e-16 && std::abs(slope - value(derivative(near))) <= root->slope_error + 1e-14 * (1 + std::abs(slope)),
                     [&] { return "at " + locus_test::show(u) + " of " + locus_test::show(f.coefficients()); });
    }
  }
  LOCUS_REQUIRE_SAMPLES(samples, 20000);
  // Close where the root is smooth, and 32 times closer on half of the interval.
  Enclosed_vector f = with_upward_rounding([] { return Enclosed_vector({Bernstein<Rational, 1>(Degrees<1>{1}, {1, 2})}); });
  double last = root_enclosure(f)->error;
  CHECK(last < 1e-4);
  for (int k = 0; k < 4; ++k) {
    f = f.halves().first;
    const double error = root_enclosure(f)->error;
    CHECK(error < last / 16);
    last = error;
  }
}

TEST_CASE("the sign of the least value of √s·p + q", "[offset]")
{
  Random random(32);
  Samples samples;
  int zeros = 0;
  for (int k = 0; k < 3000; ++k) {
    // With a square s it is that of a polynomial.
    const Rational r = abs(random.rational()) + Rational(1, 7);
    Bernstein<Rational, 1> p(Degrees<1>{random.between(0, 3)}), q(Degrees<1>{random.between(0, 4)});
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = random.between(0, 3);
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = random.between(-4, 6);
    if (random.chance(40)) { // a double root, or a zero of both
      const Rational u = random.unit_rational();
      const Bernstein<Rational, 1> line(Degrees<1>{1}, {Rational(-u), Rational(1 - u)}), square = multiply(line, line);
      if (random.chance(50)) p = multiply(p, square);
      q = subtract(multiply(square, Rational(random.between(0, 2))), multiply(p, r));
      if (random.chance(30)) q = add(q, Bernstein<Rational, 1>(Degrees<1>{0}, {Rational(two_to(-random.between(20, 90)) * random.between(-1, 1))}));
    }
    const Sign expected = least_sign(add(multiply(p, r), q)), found = least_root_sign(Rational(r * r), p, q);
    zeros += expected == Sign::zero;
    samples.expect(expected == found, [&] { return locus_test::show(p.coefficients()) + ", " + locus_test::show(q.coefficients()) + ", r = " + locus_test::show(r); });
  }
  CHECK(zeros > 300);
  LOCUS_REQUIRE_SAMPLES(samples, 3000);
  // An irrational root: √2 - v² - 41/100 is about 0.004 at v = 1, and √2·v - v + 1 has no zero.
  const auto form = [](const std::vector<Rational>& a) { return from_monomial(a); };
  CHECK(least_root_sign(2, form({1}), form({Rational(-41, 100), 0, -1})) == Sign::positive);
  CHECK(least_root_sign(2, form({1}), form({Rational(-42, 100), 0, -1})) == Sign::negative);
  CHECK(least_root_sign(2, form({0, 1}), form({1, -1})) == Sign::positive);
  CHECK(least_root_sign(2, form({1}), form({0, -1})) == Sign::positive);
  CHECK(least_root_sign(2, form({1}), form({0, -2})) == Sign::negative);
  CHECK(least_root_sign(2, form({0, 0, 1}), form({0, -1})) == Sign::negative);
  CHECK(least_root_sign(2, form({0, 1}), form({0, -1})) == Sign::zero);
}

TEST_CASE("with the root of a square a requirement holds where the plain one does", "[offset]")
{
  Random random(33);
  Samples samples;
  std::size_t intervals = 0;
  for (int k = 0; k < 400; ++k) {
    const auto form = [&](int degree, int lo, int hi) {
      Bernstein<Rational, 1> f(Degrees<1>{degree});
      for (std::size_t i = 0; i < f.size(); ++i) f[i] = Rational(random.between(lo, hi)) / 4;
      return f;
    };
    const int n = random.between(1, 3), m = random.between(0, 3), rank = random.between(1, 3);
    Bernstein<Rational, 1> root = form(random.between(0, 3), 1, 9);
    Vector_form a, rest, b, plain;
    if (k % 20 == 0) { // waves that vanish wherever the polynomial near the root is taken from the root, on an incline
      root = multiply(from_monomial(with_roots({0, Rational(1, 4), Rational(1, 2), Rational(3, 4), 1})), Rational(random.chance(50) ? 20 : -20));
      root = add(root, Bernstein<Rational, 1>(Degrees<1>{0}, {1}));
      const Rational incline = Rational(random.between(-30, 30)) / 1000;
      a.push_back(Bernstein<Rational, 1>(Degrees<1>{1}, {1, 1}));
      rest.push_back(Bernstein<Rational, 1>(Degrees<1>{1}, {Rational(-1 - incline), Rational(-1 + incline)}));
      b.push_back(Bernstein<Rational, 1>(Degrees<1>{0}, {1}));
      plain.push_back(add(root, rest.back()));
    }
    for (int i = 0; i < rank && k % 20 != 0; ++i) {
      a.push_back(form(n, 0, 5));
      rest.push_back(form(n, -9, 7));
      b.push_back(form(m, 0, 5));
      plain.push_back(add(multiply(root, a.back()), rest.back()));
    }
    with_upward_rounding([&] {
      const auto tree = [](const Vector_form& f) { return std::make_shared<Vector_tree>(f); };
      Requirement r, p;
      r.a = tree(a);
      r.b = p.b = tree(b);
      r.rest = tree(rest);
      r.square = tree({multiply(root, root)});
      p.a = tree(plain);
      const std::vector<Requirement> rooted{r}, without{p};
      const Solve_control control;
      Filter_counts counts;
      Feasible_set found = locus::detail::Feasible_set_solver(rooted, control).run(), expected = locus::detail::Feasible_set_solver(without, control).run();
      locus::detail::Feasible_end_refiner of_rooted(rooted, counts), of_plain(without, counts);
      bool same = found.intervals.size() == expected.intervals.size() && found.undecided.empty();
      for (std::size_t i = 0; same && i < expected.intervals.size(); ++i)
        for (int e = 0; e < 2; ++e) {
          Feasible_end &x = found.intervals[i].ends[static_cast<std::size_t>(e)], &y = expected.intervals[i].ends[static_cast<std::size_t>(e)];
          of_rooted.narrow(x, e, 0x1p-42);
          of_plain.narrow(y, e, 0x1p-42);
          same = same && x.lo <= y.hi && y.lo <= x.hi && x.hi - x.lo < 1e-10;
        }
      intervals += expected.intervals.size();
      samples.expect(same, [&] { return std::to_string(found.intervals.size()) + " intervals, not " + std::to_string(expected.intervals.size()); });
    });
  }
  CHECK(intervals > 100u);
  LOCUS_REQUIRE_SAMPLES(samples, 400);
}

TEST_CASE("signs of a requirement whose square is known roughly are not taken for certain", "[offset]")
{
  with_upward_rounding([] {
    const auto constant = [](const Rational& x) { return Vector_form{Bernstein<Rational, 1>(Degrees<1>{0}, {x})}; };
    Requirement r;
    r.a = std::make_shared<Vector_tree>(constant(1));
    r.b = std::make_shared<Vector_tree>(constant(1));
    r.rest = std::make_shared<Vector_tree>(constant(Rational(-9999, 10000)));
    r.square = std::make_shared<Vector_tree>(Enclosed_vector(1, 0, {1.0}, 1e-3), [&] { return constant(Rational(9991, 10000)); });
    Filter_counts counts;
    const std::vector<Requirement> requirements{r};
    Requirement_signs signs(requirements, counts);
    CHECK(signs.filtered_at({{0, 0, 0}}, 0.5) == Sign::unknown);
    CHECK(signs.at({{0, 0, 0}}, 0.5) == Sign::negative);
    const Solve_control control;
    CHECK(locus::detail::Feasible_set_solver(requirements, control).run().intervals.empty());
  });
}
