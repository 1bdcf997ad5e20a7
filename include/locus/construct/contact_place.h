// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CONTACT_PLACE_H
#define LOCUS_CONSTRUCT_CONTACT_PLACE_H

#include <locus/constraint/f3_problem.h>
#include <locus/function/enclosed_surface.h>
#include <locus/function/jet.h>
#include <locus/zero_set/critical_points.h>
#include <locus/zero_set/curve_graph.h>

#include <optional>

namespace locus {

/// A direction from a node in the plane of two parameters.
struct Node_direction {
  std::size_t base = 1; ///< which parameter's distance from the node is the greater one
  Interval slope;       ///< the other parameter's distance divided by it
};

/// The chord e = p2 w1 - p1 w2 and the turn a×e of two curves in powers of the parameters' distances u and v from a place where
/// the curves touch: e is of first order there and a×e of second order, so that with v = slope·u (or u = slope·v) both can be
/// divided by a distance, as the contact form of a blown-up corner is. Coefficients are enclosed: the place may be irrational.
class Contact_expansion {
public:
  Contact_expansion() = default;
  Contact_expansion(const Planar_curve& p, const Planar_curve& q, const std::array<Interval, 2>& at)
  {
    const auto w1 = expanded(p.weight(), at[0]), w2 = expanded(q.weight(), at[1]);
    for (std::size_t k = 0; k < 2; ++k)
      chord_[k] = sum(product(w1, expanded(q.numerator(k), at[1])), product(expanded(p.numerator(k), at[0]), w2), Interval(-1));
    const auto ax = expanded(p.tangent(0), at[0]), ay = expanded(p.tangent(1), at[0]);
    turn_ = sum(times(ax, chord_[1]), times(ay, chord_[0]), Interval(-1));
  }

  /// |e|²/(a×e), at a distance in a direction; T is Interval or Jet<Interval>.
  template <class T>
  T quotient(std::size_t base, const T& slope, const T& distance) const
  {
    const T x = value(chord_[0], 1, base, slope, distance), y = value(chord_[1], 1, base, slope, distance);
    return (x * x + y * y) / value(turn_, 2, base, slope, distance);
  }

  /// Lower bound of its magnitude, also where a×e may vanish.
  double least_quotient(std::size_t base, const Interval& slope, const Interval& distance) const
  {
    const Interval x = value(chord_[0], 1, base, slope, distance), y = value(chord_[1], 1, base, slope, distance);
    const double least = (CGAL::square(x) + CGAL::square(y)).inf(), turn = magnitude(value(turn_, 2, base, slope, distance));
    return least > 0 && std::isfinite(turn) ? (Interval(least) / Interval(turn)).inf() : 0;
  }

private:
  using Powers = std::vector<Interval>;
  using Table = std::vector<Powers>; ///< [i][j]: of u^i v^j

  /// Taylor coefficients.
  static Powers expanded(const Bernstein<Rational, 1>& f, const Interval& at)
  {
    Powers c;
    for (const Rational& x : to_monomial(f)) c.push_back(enclosing(x));
    for (std::size_t k = 0; k + 1 < c.size(); ++k)
      for (std::size_t i = c.size() - 1; i-- > k;) c[i] = c[i] + at * c[i + 1];
    return c;
  }

  static Table product(const Powers& f, const Powers& g)
  {
    Table c(f.size(), Powers(g.size(), Interval(0)));
    for (std::size_t i = 0; i < f.size(); ++i)
      for (std::size_t j = 0; j < g.size(); ++j) c[i][j] = f[i] * g[j];
    return c;
  }

  static Table times(const Powers& f, const Table& g)
  {
    Table c(f.size() + g.size() - 1, Powers(g[0].size(), Interval(0)));
    for (std::size_t k = 0; k < f.size(); ++k)
      for (std::size_t i = 0; i < g.size(); ++i)
        for (std::size_t j = 0; j < g[i].size(); ++j) c[k + i][j] = c[k + i][j] + f[k] * g[i][j];
    return c;
  }

  static Table sum(const Table& f, const Table& g, const Interval& factor)
  {
    Table c(std::max(f.size(), g.size()), Powers(std::max(f[0].size(), g[0].size()), Interval(0)));
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = 0; j < c[i].size(); ++j) c[i][j] = part(f, i, j) + factor * part(g, i, j);
    return c;
  }

  static Interval part(const Table& f, std::size_t i, std::size_t j) { return i < f.size() && j < f[i].size() ? f[i][j] : Interval(0); }

  /// Σ f_ij u^i v^j / distance^order without the terms of lower order, which vanish.
  template <class T>
  static T value(const Table& f, std::size_t order, std::size_t base, const T& slope, const T& distance)
  {
    const std::size_t most = f.size() + f[0].size() - 2;
    T total(Interval(0));
    for (std::size_t n = most + 1; n-- > order;) {
      T homogeneous(Interval(0));
      for (std::size_t k = n + 1; k-- > 0;) homogeneous = homogeneous * slope + T(base == 1 ? part(f, k, n - k) : part(f, n - k, k));
      total = total * distance + homogeneous;
    }
    return total;
  }

  std::array<Table, 2> chord_;
  Table turn_;
};

/// A node where the curves touch inside both. The other formulas of the map are 0/0 there, and their enclosures useless nearby.
struct Contact_place {
  std::array<Interval, 2> at; ///< the node's parameters
  Contact_expansion expansion;

  /// All points of a half-branch, up to its cell's side, lie in these directions from the node.
  struct Cone {
    std::size_t piece = 0;
    Node_direction direction;
  };
  std::vector<Cone> cones;

  /// That of a half-branch, if it has one.
  const Node_direction* cone_of(std::size_t piece) const
  {
    for (const Cone& cone : cones)
      if (cone.piece == piece) return &cone.direction;
    return nullptr;
  }

  /// Nothing where a place may be the node.
  std::optional<Node_direction> direction_to(const std::array<Interval, 2>& x) const
  {
    const Interval u = x[0] - at[0], v = x[1] - at[1];
    if (mignitude(u) > mignitude(v)) return Node_direction{0, v / u};
    if (mignitude(v) > 0) return Node_direction{1, u / v};
    return std::nullopt;
  }

  /// Whether the expansion is the best formula at a place.
  bool is_near(const std::array<double, 2>& x) const
  {
    constexpr double reach = 0x1p-7;
    return std::abs(x[0] - midpoint(at[0])) < reach && std::abs(x[1] - midpoint(at[1])) < reach;
  }
};

namespace detail {

/// All derivatives of one order of a polynomial, enclosed.
class Enclosed_derivatives {
public:
  Enclosed_derivatives(const Bernstein<Interval, 2>& f, std::size_t order) : order_(order)
  {
    for (std::size_t k = 0; k <= order; ++k) {
      Bernstein<Bounded, 2> d = bounded(f);
      for (std::size_t i = 0; i < order; ++i) d = derivative(d, i < k ? 1 : 0);
      parts_.emplace_back(std::move(d));
    }
  }

  /// The sign that the derivative in a direction has all over a box, if it has one.
  Sign along(const std::array<Interval, 2>& direction, const Box<2>& box) const
  {
    std::array<double, 2> centre, radius;
    for (std::size_t v = 0; v < 2; ++v) {
      centre[v] = 0.5 * (box.lo[v] + box.hi[v]);
      radius[v] = std::max(box.hi[v] - centre[v], centre[v] - box.lo[v]);
    }
    double binomial = 1;
    Interval sum(0);
    for (std::size_t k = 0; k <= order_; ++k) {
      Interval term = Interval(binomial) * parts_[k].over(centre, radius);
      for (std::size_t i = 0; i < order_; ++i) term = term * direction[i < k ? 1 : 0];
      sum = sum + term;
      binomial = binomial * static_cast<double>(order_ - k) / static_cast<double>(k + 1);
    }
    return sign_of(sum);
  }

private:
  std::size_t order_;
  std::vector<Enclosed_surface> parts_; ///< by the number of derivatives in the second variable
};

/// The narrowest cone that is proved to hold a half-branch: on its two rays the equation, with a zero of some order at the node,
/// has no other one in the cell, since its derivative of that order along them has none.
inline std::optional<Node_direction> cone_around(const Node_direction& exit, const Enclosed_derivatives& d, const Box<2>& cell)
{
  for (double spread = 0x1p-24; spread < 0.5; spread *= 2) {
    const Interval low(exit.slope.inf() - spread), high(exit.slope.sup() + spread);
    const auto ray = [&](const Interval& slope) {
      return exit.base == 1 ? std::array<Interval, 2>{slope, Interval(1)} : std::array<Interval, 2>{Interval(1), slope};
    };
    if (is_strict(d.along(ray(low), cell)) && is_strict(d.along(ray(high), cell))) return Node_direction{exit.base, hull(low, high)};
  }
  return std::nullopt;
}

/// Whether the curves touch at a node where they meet, exactly. With more than four half-branches F3 is at least triple there, or
/// what is left of it without a line or a circle's factor; where the curves cross, it starts with |a|²t² - |b|²r².
inline bool touch_at_node(const F3_problem& problem, const Isolated_point& p, std::size_t half_branches)
{
  if (half_branches > 4) return true;
  if (!p.evidence) return false; // a regular solution of C1 = C2
  const auto exact = [&](const auto& equation) { return equation->exact(); };
  const Common_zeros both({exact(pair_equation<Difference_form<false>>(problem)), exact(pair_equation<Difference_form<true>>(problem)),
                           exact(pair_equation<Parallel_tangents_form>(problem))});
  return both.is_finite() && !solutions_in(both, box_of(p.box)).empty();
}

/// The surroundings of a node of F3 (or of a factor of it) at which the curves touch. The equation vanishes to the second
/// order at any node, and to the third at one with more than four half-branches.
inline std::optional<Contact_place> contact_at_node(const F3_problem& problem, const Curve_graph& graph, std::size_t vertex)
{
  const Graph_vertex& node = graph.vertices[vertex];
  const Isolated_point& p = graph.special[static_cast<std::size_t>(node.cause)];
  if (!touch_at_node(problem, p, node.half_branches.size())) return std::nullopt;
  Contact_place place;
  place.at = p.box;
  if (p.evidence) place.at = {hull(enclosing(p.evidence->lo), enclosing(p.evidence->hi)), hull(enclosing(p.evidence->r_lo), enclosing(p.evidence->r_hi))};
  place.expansion = Contact_expansion(*problem.first, *problem.second, place.at);
  const Enclosed_derivatives d(graph.equation->enclosure(Box<2>::unit()), node.half_branches.size() > 4 ? 3 : 2);
  for (const std::size_t k : node.half_branches) {
    const auto exit = place.direction_to(graph.vertices[graph.pieces[k].to].at);
    if (!exit) continue;
    if (const auto cone = cone_around(*exit, d, graph.forms[k].box)) place.cones.push_back({k, *cone});
  }
  return place;
}

} // namespace detail
} // namespace locus

#endif
