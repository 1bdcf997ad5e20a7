// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_TEST_PAIR_SUPPORT_H
#define LOCUS_TEST_PAIR_SUPPORT_H

// Random pairs of curves on a small integer grid, many of them related so that degenerate bisectors abound: each pair is
// made from its number alone.

#include "curve_support.h"

#include <cstdlib>

namespace locus_test {

/// How the second curve of a pair depends on the first.
enum class Relation {
  independent,
  same_start,
  shared_end,
  shared_end_and_tangent,
  mirrored,
  swapped,
  translated,
  scaled,
  crossing,
  tangent,
  tangent_at_irrational,
  bitangent,
  parallel_lines,
  concentric_arcs,
  equal,
  overlapping
};
inline constexpr int relation_count = 16;

inline const char* name_of(Relation r)
{
  constexpr const char* names[] = {"independent", "same start", "shared end", "shared end and tangent",
                                   "mirrored", "swapped", "translated", "scaled",
                                   "crossing", "tangent", "tangent at irrational parameters", "bitangent",
                                   "parallel lines", "concentric arcs", "equal", "overlapping"};
  return names[static_cast<int>(r)];
}

/// What the degrees of a pair are chosen from.
struct Pair_limits {
  int polynomial_degree = 4, rational_degree = 4;
};

struct Curve_pair {
  Relation relation;
  Control_curve first, second;
};

/// A quotient of small integers.
inline Rational small_fraction(long p, long q)
{
  Rational x(p, q);
  x.canonicalize();
  return x;
}

/// Makes the pair of a given number: the same one whenever the run's seed is the same.
class Pair_maker {
public:
  explicit Pair_maker(std::size_t number, const Pair_limits& limits = {})
    : random_(7919 * number + 13), limits_(limits), relation_(static_cast<Relation>(number % relation_count)),
      grid_(random_.between(2, 3))
  {
  }

  Curve_pair make()
  {
    Curve_pair p{relation_, curve(), {}};
    switch (relation_) {
    case Relation::tangent_at_irrational: return tangent_at_irrational();
    case Relation::bitangent: return bitangent();
    case Relation::parallel_lines: return parallel_lines();
    case Relation::concentric_arcs: return concentric_arcs();
    default: p.second = second(p.first);
    }
    return p;
  }

private:
  Rational coordinate() { return Rational(random_.between(-grid_, grid_)); }

  Exact_pair point()
  {
    const Rational x = coordinate(), y = coordinate();
    return {x, y};
  }

  void add_weights(Control_curve& c)
  {
    constexpr std::array<std::array<long, 2>, 5> choice{{{1, 1}, {1, 1}, {2, 1}, {1, 2}, {3, 1}}};
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const auto& [p, q] = choice[static_cast<std::size_t>(random_.below(5))];
      c.weights.push_back(small_fraction(p, q));
    }
  }

  /// Not a single point; one in three is rational.
  Control_curve curve()
  {
    const bool rational = random_.chance(33);
    const int degree = random_.between(1, rational ? limits_.rational_degree : limits_.polynomial_degree);
    Control_curve c;
    do {
      c.points.clear();
      for (int i = 0; i <= degree; ++i) c.points.push_back(point());
    } while (std::count(c.points.begin(), c.points.end(), c.points[0]) == degree + 1);
    if (rational) add_weights(c);
    return c;
  }

  Control_curve second(const Control_curve& a)
  {
    const int variant = random_.below(3);
    switch (relation_) {
    case Relation::independent: return curve();
    case Relation::same_start: return starting_at(curve(), a.points.front());
    case Relation::shared_end: return starting_at(curve(), a.points.back());
    case Relation::shared_end_and_tangent: return continued(a);
    case Relation::mirrored: return variant == 0 ? reversed(mirrored_in_x_axis(a)) : mirrored_in_x_axis(a);
    case Relation::swapped: return moved(a, {0, 1, 1, 0}, {0, 0});
    case Relation::translated: return translated_copy(a);
    case Relation::scaled: return scaled(a, variant == 0 ? Rational(2) : variant == 1 ? Rational(-1) : small_fraction(3, 2));
    case Relation::crossing: return through_common_point(a, curve());
    case Relation::tangent: return touching(a, curve());
    case Relation::equal: return variant == 0 ? a : variant == 1 ? reversed(a) : elevated(a);
    default: return overlapping(a);
    }
  }

  Control_curve starting_at(Control_curve b, const Exact_pair& p) const
  {
    const bool single = std::count(b.points.begin() + 1, b.points.end(), p) == b.degree();
    b.points[0] = p;
    if (single) b.points.back()[0] += 1;
    return b;
  }

  /// Goes on where the curve ends, with the same tangent line.
  Control_curve continued(const Control_curve& a)
  {
    Control_curve b = starting_at(curve(), a.points.back());
    const Rational step(random_.chance(70) ? 1 : random_.between(-2, 2));
    const Exact_pair& end = a.points.back();
    const Exact_pair& before = a.points[a.points.size() - 2];
    for (std::size_t k = 0; k < 2; ++k) b.points[1][k] = end[k] + step * (end[k] - before[k]);
    if (std::count(b.points.begin(), b.points.end(), b.points[0]) == b.degree() + 1) b.points.back()[1] += 1;
    return b;
  }

  Control_curve translated_copy(const Control_curve& a)
  {
    const int dx = random_.between(-1, 1), dy = random_.between(-1, 1);
    return translated(a, Rational(dx), Rational(dx == 0 && dy == 0 ? 1 : dy));
  }

  Rational inner_parameter() { return small_fraction(random_.between(1, 3), 4); }

  struct Local {
    Exact_pair point, tangent; ///< the tangent without a length
  };

  static Local local(const Control_curve& c, const Rational& u)
  {
    const Plain_curve p(c);
    const Rational w = horner(p.w, u);
    return {{Rational(horner(p.x, u) / w), Rational(horner(p.y, u) / w)}, {horner(p.ax, u), horner(p.ay, u)}};
  }

  /// Moved so that both curves pass through one point inside.
  Control_curve through_common_point(const Control_curve& a, const Control_curve& b)
  {
    const Rational t = inner_parameter(), r = inner_parameter();
    const Local p = local(a, t), q = local(b, r);
    return translated(b, p.point[0] - q.point[0], p.point[1] - q.point[1]);
  }

  /// Turned and moved so that both curves have one tangent line at a common point inside.
  Control_curve touching(const Control_curve& a, const Control_curve& b)
  {
    const Rational t = inner_parameter(), r = inner_parameter();
    const Local p = local(a, t), q = local(b, r);
    const Rational size = q.tangent[0] * q.tangent[0] + q.tangent[1] * q.tangent[1];
    if (size == 0 || (p.tangent[0] == 0 && p.tangent[1] == 0)) return through_common_point(a, b);
    Rational c = (p.tangent[0] * q.tangent[0] + p.tangent[1] * q.tangent[1]) / size;
    Rational s = (p.tangent[1] * q.tangent[0] - p.tangent[0] * q.tangent[1]) / size;
    const Rational longest = abs(c) > abs(s) ? Rational(abs(c)) : Rational(abs(s));
    c /= longest;
    s /= longest;
    const Control_curve turned = moved(b, {c, -s, s, c}, {0, 0});
    const Local there = local(turned, r);
    return translated(turned, p.point[0] - there.point[0], p.point[1] - there.point[1]);
  }

  /// A part of the curve, perhaps beyond its end, perhaps with another speed.
  Control_curve overlapping(const Control_curve& a)
  {
    constexpr std::array<std::array<long, 2>, 4> ranges{{{0, 2}, {1, 3}, {2, 4}, {1, 4}}};
    const auto& [lo, hi] = ranges[static_cast<std::size_t>(random_.below(4))];
    const Control_curve part = part_of(a, small_fraction(lo, 4), small_fraction(hi, 4));
    const int guise = random_.below(3);
    return guise == 0 ? part : guise == 1 ? reversed(part) : moebius(part, Rational(2));
  }

  /// A random affine map on the grid that keeps both coordinates apart.
  std::array<Rational, 4> affine_map()
  {
    for (;;) {
      std::array<Rational, 4> m;
      for (Rational& x : m) x = Rational(random_.between(-1, 1));
      if (m[0] * m[3] != m[1] * m[2]) return m;
    }
  }

  Curve_pair mapped(const Control_curve& a, const Control_curve& b)
  {
    const std::array<Rational, 4> m = affine_map();
    const Exact_pair d = point();
    return {relation_, moved(a, m, d), moved(b, m, d)};
  }

  /// Graphs of f and f + k(x² - s)², in other parameters: they touch at x = √s, an irrational number for all s here.
  Curve_pair tangent_at_irrational()
  {
    const int degree = random_.between(1, std::min(3, limits_.polynomial_degree));
    Polynomial f;
    for (int i = 0; i <= degree; ++i) f.push_back(Rational(random_.between(-2, 2)));
    const Rational s = small_fraction(1, random_.between(2, 3)), k(random_.chance(50) ? 1 : -2);
    const Polynomial touching = times({k}, times({Rational(-s), 0, 1}, {Rational(-s), 0, 1}));
    const Control_curve a = graph_of(f, degree);
    Control_curve b = graph_of(plus(f, touching), 4);
    const int guise = random_.below(3);
    if (guise == 1) b = reversed(b);
    if (guise == 2) b = part_of(b, small_fraction(1, 4), Rational(1));
    return mapped(a, b);
  }

  static Control_curve graph_of(const Polynomial& f, int degree)
  {
    const Bernstein<Rational, 1> form = bernstein_on_unit(f, degree);
    Control_curve c;
    for (int i = 0; i <= degree; ++i) c.points.push_back({small_fraction(i, degree), form[static_cast<std::size_t>(i)]});
    return c;
  }

  /// The parabola y = x² and the circle around (0, k) that touches it where y = k - 1/2, at x = ±√(k - 1/2), perhaps seen
  /// through an affine map.
  Curve_pair bitangent()
  {
    const int radius = random_.between(1, 2);
    const Rational k = Rational(radius) * radius + small_fraction(1, 4);
    const Rational lo(-random_.between(1, 2)), hi(random_.between(1, 2));
    const Exact_pair start{lo, Rational(lo * lo)}, middle{Rational((lo + hi) / 2), Rational(lo * hi)}, end{hi, Rational(hi * hi)};
    const Control_curve parabola{{start, middle, end}, {}};
    const Control_curve arc = circular_arc({0, k}, Rational(random_.chance(50) ? radius : -radius), half_angle(), {0, 1});
    if (random_.chance(50)) return {relation_, parabola, arc};
    return mapped(parabola, arc);
  }

  /// Not at a right angle to (0, 1), where the arc would have a control point at infinity.
  Exact_pair half_angle()
  {
    constexpr std::array<std::array<int, 2>, 4> choice{{{1, 2}, {1, 1}, {-1, 1}, {2, 1}}};
    const auto& [x, y] = choice[static_cast<std::size_t>(random_.below(4))];
    return {Rational(x), Rational(y)};
  }

  Curve_pair parallel_lines()
  {
    const Exact_pair a = point(), shift = point();
    Exact_pair d = point();
    if (d[0] == 0 && d[1] == 0) d[0] = 1;
    const Rational from = Rational(random_.between(-2, 1)) / 2, to = from + random_.between(1, 2);
    const auto on = [&](const Exact_pair& p, const Rational& u) {
      return Exact_pair{Rational(p[0] + u * d[0]), Rational(p[1] + u * d[1])};
    };
    const Exact_pair b{Rational(a[0] + shift[0]), Rational(a[1] + shift[1])};
    return {relation_, {{a, on(a, 1)}, {}}, {{on(b, from), on(b, to)}, {}}};
  }

  /// Arcs of circles around one centre, and with one centre on a line through the other's.
  Curve_pair concentric_arcs()
  {
    const Exact_pair centre = point();
    Exact_pair other = centre;
    if (random_.chance(25)) other[0] += 1;
    const Exact_pair h0 = half_angle(), h1 = half_angle();
    const Rational r0(random_.between(1, 2)), r1(random_.between(1, 3));
    return {relation_, circular_arc(centre, r0, h0, {0, 1}), circular_arc(other, r1, h1, {0, 1})};
  }

  Random random_;
  Pair_limits limits_;
  Relation relation_;
  int grid_;
};

inline Curve_pair random_pair(std::size_t number, const Pair_limits& limits = {})
{
  return Pair_maker(number, limits).make();
}

/// As a user gets it from a job: cut where it stands still.
inline locus::Curve_2 built(const Control_curve& c) { return locus::split_at_cusps(c.build()); }

/// The pair and where it comes from, with C++ text that makes the curves again.
inline std::string show(const Curve_pair& p, std::size_t number)
{
  return "pair " + std::to_string(number) + " (" + name_of(p.relation) + "): " + show(p.first, p.second);
}

/// How many pairs are asked for by the environment variable LOCUS_RANDOM_PAIRS, or `share` without it.
inline std::size_t pairs_to_run(std::size_t share)
{
  const char* text = std::getenv("LOCUS_RANDOM_PAIRS");
  return text ? static_cast<std::size_t>(std::strtoull(text, nullptr, 10)) : share;
}

} // namespace locus_test

#endif
