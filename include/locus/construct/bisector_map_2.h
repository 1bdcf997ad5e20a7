// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_BISECTOR_MAP_2_H
#define LOCUS_CONSTRUCT_BISECTOR_MAP_2_H

#include <locus/construct/curve_evaluator.h>

#include <cmath>

namespace locus {

/// Which of the two formulas gives the bisector point of two feet: both hold where F3 = 0, and each is ill-conditioned
/// where the other is good.
enum class Map_formula : unsigned char {
  normals, ///< intersection of the two normals (Cramer; fails where the tangents are parallel)
  chord    ///< first normal and the chord's perpendicular bisector (Farouki & Johnstone 1994; fails where the feet meet)
};

/// The map from a solution (t, r) of F3 = 0 to the plane.
class Bisector_map_2 {
public:
  Bisector_map_2() = default;
  Bisector_map_2(const Planar_curve& first, const Planar_curve& second) : first_(first), second_(second) {}

  const Curve_evaluator& first() const { return first_; }
  const Curve_evaluator& second() const { return second_; }

  template <class T>
  struct Image {
    Vector_2<T> point;
    Vector_2<T> first_foot;
  };

  template <class T>
  Image<T> at(const T& t, const T& r, Map_formula formula) const
  {
    const Vector_2<T> x1 = first_.point(t), x2 = second_.point(r), a = first_.tangent(t);
    const Vector_2<T> d = x2 - x1;
    T lambda;
    if (formula == Map_formula::normals) {
      const Vector_2<T> b = second_.tangent(r);
      lambda = dot(b, d) / cross(a, b);
    } else {
      lambda = dot(d, d) / (T(Interval(2)) * cross(a, d));
    }
    return {{x1.x - a.y * lambda, x1.y + a.x * lambda}, x1};
  }

  /// The better conditioned formula near (t, r).
  Map_formula choose(double t, double r) const
  {
    const auto mid = [](const Vector_2<Interval>& v) { return Vector_2<double>{midpoint(v.x), midpoint(v.y)}; };
    const Vector_2<double> x1 = mid(first_.point(Interval(t))), x2 = mid(second_.point(Interval(r)));
    const Vector_2<double> a = mid(first_.tangent(Interval(t))), b = mid(second_.tangent(Interval(r)));
    const Vector_2<double> d = x2 - x1;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), ld = std::sqrt(dot(d, d));
    if (ld == 0) return Map_formula::normals;
    const double by_normals = std::abs(cross(a, b)) / (la * lb);
    // Coordinates are of size one in the frame: the relative error of the chord grows as it gets short.
    const double by_chord = std::abs(cross(a, d)) / (la * ld) * std::min(1.0, ld);
    return by_normals > by_chord ? Map_formula::normals : Map_formula::chord;
  }

  /// Lower bound of the distance from the first foot to the bisector point along an arc that ends in a pole at most
  /// `length` away in the jets' variable. The point itself has no enclosure there; but a×d vanishes at the pole, so it is
  /// bounded by its derivative.
  double least_radius(const Jet<Interval>& t, const Jet<Interval>& r, double length) const
  {
    const Vector_2<Jet<Interval>> a = first_.tangent(t), d = second_.point(r) - first_.point(t);
    const Interval speed = CGAL::sqrt(dot(a, a).value), chord2 = dot(d, d).value;
    if (!(speed.inf() > 0) || !(chord2.inf() > 0)) return 0;
    const Jet<Interval> product = cross(a, d);
    const Interval largest = Interval(2) * Interval(std::min(magnitude(product.value), magnitude(product.first) * length * (1 + 4 * operation_error)));
    if (largest.sup() == 0) return std::numeric_limits<double>::infinity();
    return (Interval(chord2.inf()) * Interval(speed.inf()) / Interval(largest.sup())).inf();
  }

private:
  Curve_evaluator first_, second_;
};

} // namespace locus

#endif
