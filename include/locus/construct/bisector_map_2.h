// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_BISECTOR_MAP_2_H
#define LOCUS_CONSTRUCT_BISECTOR_MAP_2_H

#include <locus/constraint/f3_problem.h>
#include <locus/construct/contact_place.h>
#include <locus/construct/curve_evaluator.h>
#include <locus/function/enclosed_surface.h>

#include <cmath>

namespace locus {

/// Which formula gives the bisector point of two feet: all hold where F3 = 0, and each is ill-conditioned where another is
/// good.
enum class Map_formula : unsigned char {
  normals, ///< intersection of the two normals (Cramer; fails where the tangents are parallel)
  chord,   ///< first normal and the chord's perpendicular bisector (Farouki & Johnstone 1994; fails where the feet meet)
  contact, ///< the same with the distance of the feet divided out
  node     ///< the same around a node inside, where the curves touch
};

/// A bivariate polynomial with its partial derivatives, to be enclosed over boxes and along jets.
class Enclosed_function_2 {
public:
  Enclosed_function_2() = default;
  explicit Enclosed_function_2(const Bernstein<Scaled_integer, 2>& g)
  {
    const Interval scale = enclosing(g.scale());
    const Bernstein<Bounded, 2> f =
      bounded(converted<Interval>(g.values(), [&](const Integer& c) { return enclosing_scaled(c, 0) * scale; }));
    const Bernstein<Bounded, 2> f0 = derivative(f, 0), f1 = derivative(f, 1);
    norm_ = f.norm();
    f_ = Enclosed_surface(f);
    first_ = {Enclosed_surface(f0), Enclosed_surface(f1)};
    second_ = {Enclosed_surface(derivative(f0, 0)), Enclosed_surface(derivative(f0, 1)), Enclosed_surface(derivative(f1, 1))};
  }

  double norm() const { return norm_; }

  Interval along(const std::array<Interval, 2>& x) const
  {
    const Centred c(x);
    return f_.over(c.centre, c.radius, first_[0].over(c.centre, c.radius), first_[1].over(c.centre, c.radius));
  }

  Jet<Interval> along(const std::array<Jet<Interval>, 2>& x) const
  {
    const std::array<Interval, 2> value{x[0].value, x[1].value};
    const Centred c(value);
    const auto over = [&](const Enclosed_surface& f) { return f.over(c.centre, c.radius); };
    const Interval f00 = over(second_[0]), f01 = over(second_[1]), f11 = over(second_[2]);
    const Interval f0 = first_[0].over(c.centre, c.radius, f00, f01), f1 = first_[1].over(c.centre, c.radius, f01, f11);
    const Interval u = x[0].first, v = x[1].first;
    return {f_.over(c.centre, c.radius, f0, f1), f0 * u + f1 * v,
            f00 * u * u + Interval(2) * f01 * u * v + f11 * v * v + f0 * x[0].second + f1 * x[1].second};
  }

private:
  struct Centred {
    explicit Centred(const std::array<Interval, 2>& x)
    {
      for (std::size_t v = 0; v < 2; ++v) {
        const double lo = std::min(1.0, std::max(0.0, x[v].inf())), hi = std::min(1.0, std::max(0.0, x[v].sup()));
        centre[v] = std::min(hi, lo + 0.5 * (hi - lo));
        radius[v] = std::max(hi - centre[v], centre[v] - lo);
      }
    }
    std::array<double, 2> centre{}, radius{};
  };

  double norm_ = 0;
  Enclosed_surface f_;
  std::array<Enclosed_surface, 2> first_;
  std::array<Enclosed_surface, 3> second_;
};

namespace detail {

/// A contact form, to be enclosed.
struct Enclosed_contact {
  std::array<Enclosed_function_2, 2> chord;
  Enclosed_function_2 turn;
  std::array<int, 2> power{0, 0};
};

} // namespace detail

/// The map from a solution of F3 = 0, in the coordinates of its chart, to the plane.
class Bisector_map_2 {
public:
  using Evaluator = std::shared_ptr<const Curve_evaluator>;

  Bisector_map_2() = default;
  Bisector_map_2(Evaluator first, Evaluator second, const Corner_chart& chart, const std::optional<Contact_form>& contact)
    : first_(std::move(first)), second_(std::move(second)), chart_(chart)
  {
    if (!contact) return;
    contact_ = Contact{{Enclosed_function_2(contact->chord[0]), Enclosed_function_2(contact->chord[1])},
                       Enclosed_function_2(contact->turn), contact->power};
  }

  /// Nodes inside where the curves touch; only where the chart is plain.
  const std::vector<Contact_place>& nodes() const { return nodes_; }
  void add_node(Contact_place node) { nodes_.push_back(std::move(node)); }

  const Curve_evaluator& first() const { return *first_; }
  const Curve_evaluator& second() const { return *second_; }
  const Corner_chart& chart() const { return chart_; }

  template <class T>
  struct Image {
    Vector_2<T> point;
    Vector_2<T> first_foot;
  };

  /// T is Interval or Jet<Interval>.
  template <class T>
  Image<T> at(const std::array<T, 2>& x, Map_formula formula) const
  {
    const std::array<T, 2> p = chart_(x);
    const Vector_2<T> x1 = first_->point(p[0]), a = first_->tangent(p[0]);
    const T lambda = formula == Map_formula::node      ? by_node(x)
                     : formula == Map_formula::contact ? by_contact(x, p)
                                                       : by_feet(p, x1, a, formula);
    return {{x1.x - a.y * lambda, x1.y + a.x * lambda}, x1};
  }

  /// The best conditioned formula near x.
  Map_formula choose(const std::array<double, 2>& at) const
  {
    if (node_near(at)) return Map_formula::node;
    const std::array<Interval, 2> x{Interval(at[0]), Interval(at[1])}, p = chart_(x);
    const auto mid = [](const Vector_2<Interval>& v) { return Vector_2<double>{midpoint(v.x), midpoint(v.y)}; };
    const Vector_2<double> x1 = mid(first_->point(p[0])), x2 = mid(second_->point(p[1]));
    const Vector_2<double> a = mid(first_->tangent(p[0])), b = mid(second_->tangent(p[1]));
    const Vector_2<double> d = x2 - x1;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), ld = std::sqrt(dot(d, d));
    // Coordinates are of size one in the frame: the relative error of the chord grows as it gets short.
    const double by_normals = std::abs(cross(a, b)) / (la * lb);
    const double by_chord = ld > 0 ? std::abs(cross(a, d)) / (la * ld) * std::min(1.0, ld) : 0.0;
    const double by_contact = contact_ ? std::abs(midpoint(contact_->turn.along(x))) / contact_->turn.norm() : -1.0;
    if (by_contact > by_normals && by_contact > by_chord) return Map_formula::contact;
    return by_normals > by_chord ? Map_formula::normals : Map_formula::chord;
  }

  /// Whether the contact form gives the circle's curvature also where the bisector point is at infinity.
  bool has_regular_contact() const { return contact_ && contact_->power == std::array<int, 2>{0, 0}; }

  /// The circle's curvature times the length of the first tangent, by a regular contact form.
  template <class T>
  T curvature_by_contact(const std::array<T, 2>& x) const
  {
    const std::array<T, 2> p = chart_(x);
    const T ex = contact_->chord[0].along(x), ey = contact_->chord[1].along(x);
    return T(Interval(-2)) * first_->weight(p[0]) * second_->weight(p[1]) * contact_->turn.along(x) / (ex * ex + ey * ey);
  }

  /// Whether the circle of a solution touches the curves from different sides, if their tangents are directed alike: with λ
  /// the feet's distances along the normals, Im(e ā)·Im(e b̄) is positive then. Along F3 = 0 its sign changes at poles only.
  Sign touches_both_sides(const std::array<Interval, 2>& x) const
  {
    const std::array<Interval, 2> p = chart_(x);
    const Vector_2<Interval> d = second_->point(p[1]) - first_->point(p[0]);
    return sign_of(cross(first_->tangent(p[0]), d)) * sign_of(cross(second_->tangent(p[1]), d));
  }

  /// Encloses the bisector points over x where their circles lie between the curves: such a circle's diameters to the feet turn
  /// by less than a right angle, so its radius is at most |d|/√2. `direction`: 1, or -1 where the curves run against each other
  /// at their contact. Nothing where the tangents may have turned by more since.
  std::optional<Vector_2<Interval>> between_curves(const std::array<Interval, 2>& x, int direction) const
  {
    const std::array<Interval, 2> p = chart_(x);
    const Vector_2<Interval> x1 = first_->point(p[0]), d = second_->point(p[1]) - x1;
    if (sign_of(dot(first_->tangent(p[0]), second_->tangent(p[1]))) != sign_of_int(direction)) return std::nullopt;
    const double reach = CGAL::sqrt((CGAL::square(d.x) + CGAL::square(d.y)) * Interval(0.5)).sup();
    return Vector_2<Interval>{x1.x + Interval(-reach, reach), x1.y + Interval(-reach, reach)};
  }

  /// Encloses the bisector points over a box of parameters that lie in a direction from a node where the curves touch.
  Vector_2<Interval> near_node(const Contact_place& node, const std::array<Interval, 2>& x, const Node_direction& direction) const
  {
    const Vector_2<Interval> x1 = first_->point(x[0]), a = first_->tangent(x[0]);
    const Interval lambda = by_expansion(node, direction.base, direction.slope, x[direction.base] - node.at[direction.base], x);
    return {x1.x - a.y * lambda, x1.y + a.x * lambda};
  }

  /// Lower bound of the distance from `centre` to the bisector points along an arc that ends in a pole of the map or at an
  /// infinite foot, at most `length` away in the jets' variable. The points themselves have no enclosure there.
  double least_distance(const std::array<Jet<Interval>, 2>& x, double length, const Vector_2<double>& centre) const
  {
    const std::array<Jet<Interval>, 2> p = chart_(x);
    double radius = least_radius(p, length);
    if (has_regular_contact()) radius = std::max(radius, least_contact_radius(x, p, length));
    if (!std::isfinite(radius)) return radius;
    double bound = 0;
    for (const auto& foot : {first_->point(p[0].value), second_->point(p[1].value)}) {
      const double off = std::hypot(magnitude(foot.x - Interval(centre.x)), magnitude(foot.y - Interval(centre.y))) * (1 + 8 * operation_error);
      if (std::isfinite(off)) bound = std::max(bound, (Interval(radius) - Interval(off)).inf());
    }
    bound = std::max(bound, normal_line_distance(*first_, p[0].value, centre));
    return std::max(bound, normal_line_distance(*second_, p[1].value, centre));
  }

  /// The same over a box of parameters that lie in a direction from a node where the curves touch.
  double least_distance(const Contact_place& node, const std::array<Interval, 2>& x, const Node_direction& direction, const Vector_2<double>& centre) const
  {
    const Vector_2<Interval> x1 = first_->point(x[0]), a = first_->tangent(x[0]);
    const double least = node.expansion.least_quotient(direction.base, direction.slope, x[direction.base] - node.at[direction.base]);
    const Interval scale = Interval(2) * Interval(magnitude(first_->weight(x[0]))) * Interval(magnitude(second_->weight(x[1])));
    if (!std::isfinite(least)) return least;
    const Interval radius = CGAL::sqrt(CGAL::square(a.x) + CGAL::square(a.y)) * Interval(least) / scale;
    const Interval off = CGAL::sqrt(CGAL::square(x1.x - Interval(centre.x)) + CGAL::square(x1.y - Interval(centre.y)));
    return (Interval(radius.inf()) - Interval(off.sup())).inf();
  }

  /// The same over a box of parameters.
  double least_distance(const std::array<Interval, 2>& x, const Vector_2<double>& centre) const
  {
    std::array<Jet<Interval>, 2> any; // of which only the values count
    for (std::size_t v = 0; v < 2; ++v) any[v] = {x[v], Interval(-1, 1), Interval(0)};
    return least_distance(any, std::numeric_limits<double>::infinity(), centre);
  }

private:
  using Contact = detail::Enclosed_contact;

  template <class T>
  T by_feet(const std::array<T, 2>& p, const Vector_2<T>& x1, const Vector_2<T>& a, Map_formula formula) const
  {
    const Vector_2<T> d = second_->point(p[1]) - x1;
    if (formula == Map_formula::chord) return dot(d, d) / (T(Interval(2)) * cross(a, d));
    const Vector_2<T> b = second_->tangent(p[1]);
    return dot(b, d) / cross(a, b);
  }

  const Contact_place* node_near(const std::array<double, 2>& at) const
  {
    for (const Contact_place& node : nodes_)
      if (node.is_near(at)) return &node;
    return nullptr;
  }

  static double middle(const Interval& x) { return midpoint(x); }
  static double middle(const Jet<Interval>& x) { return midpoint(x.value); }

  template <class T>
  T by_node(const std::array<T, 2>& x) const
  {
    const std::array<double, 2> at{middle(x[0]), middle(x[1])};
    const Contact_place& node = *node_near(at);
    const std::size_t base = std::abs(at[1] - midpoint(node.at[1])) >= std::abs(at[0] - midpoint(node.at[0])) ? 1 : 0;
    const T distance = x[base] - T(node.at[base]), other = x[1 - base] - T(node.at[1 - base]);
    return by_expansion(node, base, T(other / distance), distance, x);
  }

  template <class T>
  T by_expansion(const Contact_place& node, std::size_t base, const T& slope, const T& distance, const std::array<T, 2>& x) const
  {
    return node.expansion.quotient(base, slope, distance) / (T(Interval(2)) * first_->weight(x[0]) * second_->weight(x[1]));
  }

  template <class T>
  T by_contact(const std::array<T, 2>& x, const std::array<T, 2>& p) const
  {
    const T ex = contact_->chord[0].along(x), ey = contact_->chord[1].along(x), turn = contact_->turn.along(x);
    T lambda = (ex * ex + ey * ey) / (T(Interval(-2)) * first_->weight(p[0]) * second_->weight(p[1]) * turn);
    for (std::size_t v = 0; v < 2; ++v)
      for (int k = 0; k < contact_->power[v]; ++k) lambda = lambda * x[v];
    return lambda;
  }

  /// Lower bound of the circles' radius |e|²|a|/(2|w1 w2||a×e|) with e = p2 w1 - p1 w2. At a common tangent line a×e vanishes, so
  /// it is bounded by its derivative; at an infinite foot a weight does.
  double least_radius(const std::array<Jet<Interval>, 2>& p, double length) const
  {
    const Vector_2<Jet<Interval>> p1 = first_->numerator(p[0]), p2 = second_->numerator(p[1]);
    const Jet<Interval> w1 = first_->weight(p[0]), w2 = second_->weight(p[1]);
    const Vector_2<Jet<Interval>> e{p2.x * w1 - p1.x * w2, p2.y * w1 - p1.y * w2};
    return least_radius(p, e, cross(first_->tangent(p[0]), e), length);
  }

  /// The same where the feet come together: e and a×e without what the contact form divides them by.
  double least_contact_radius(const std::array<Jet<Interval>, 2>& x, const std::array<Jet<Interval>, 2>& p, double length) const
  {
    const Vector_2<Jet<Interval>> e{contact_->chord[0].along(x), contact_->chord[1].along(x)};
    return least_radius(p, e, contact_->turn.along(x), length);
  }

  double least_radius(const std::array<Jet<Interval>, 2>& p, const Vector_2<Jet<Interval>>& e, const Jet<Interval>& product, double length) const
  {
    const Vector_2<Interval> a = first_->tangent(p[0].value);
    const Interval speed = CGAL::sqrt(CGAL::square(a.x) + CGAL::square(a.y));
    const Interval chord2 = CGAL::square(e.x.value) + CGAL::square(e.y.value);
    const double turn = std::min(magnitude(product.value), magnitude(product.first) * length * (1 + 4 * operation_error));
    const Interval largest = Interval(2) * Interval(turn) * Interval(magnitude(first_->weight(p[0].value))) *
                             Interval(magnitude(second_->weight(p[1].value)));
    if (!(speed.inf() > 0) || !(chord2.inf() > 0)) return 0;
    if (largest.sup() == 0) return std::numeric_limits<double>::infinity();
    const double radius = (Interval(chord2.inf()) * Interval(speed.inf()) / Interval(largest.sup())).inf();
    return radius > 0 ? radius : 0; // also where something is infinite
  }

  /// Lower bound of the distance from `centre` to the normals of a curve over a range: the bisector lies on them, and they
  /// go to infinity with the foot.
  static double normal_line_distance(const Curve_evaluator& c, const Interval& t, const Vector_2<double>& centre)
  {
    const Vector_2<Interval> a = c.tangent(t), p = c.numerator(t);
    const Interval w = c.weight(t);
    const Vector_2<Interval> from{p.x - Interval(centre.x) * w, p.y - Interval(centre.y) * w};
    const Interval speed = CGAL::sqrt(CGAL::square(a.x) + CGAL::square(a.y));
    const double along = mignitude(dot(from, a));
    if (!(along > 0)) return 0;
    return (Interval(along) / (Interval(magnitude(w)) * Interval(magnitude(speed)))).inf();
  }

  Evaluator first_, second_;
  Corner_chart chart_;
  std::optional<Contact> contact_;
  std::vector<Contact_place> nodes_;
};

} // namespace locus

#endif
