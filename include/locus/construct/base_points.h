// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_BASE_POINTS_H
#define LOCUS_CONSTRUCT_BASE_POINTS_H

#include <locus/construct/bisector_maps_3.h>
#include <locus/function/enclosed_surface.h>
#include <locus/zero_set/points.h>

namespace locus {
namespace detail {

/// A pair of feet whose three planes (both normal planes and the one half-way) share a line: all points of the line are equally
/// far from both feet, and the surface, 0/0 there, runs along it from infinity to infinity.
struct Base_point {
  std::array<Interval, 2> at; ///< in the unit square
  Box<2> hole;                ///< around it; what of the surface belongs to it is near the line
  double distance = 0;        ///< proved bound of how near, within the cut radius
};

/// Finds the base points of a bisector surface's piece. Two curves in general position have some: two conditions in two
/// parameters.
class Base_point_search {
public:
  /// The planes in homogeneous coordinates from `centre`.
  Base_point_search(const Curve_piece<3>& first, const Curve_piece<3>& second, const Exact_point<3>& centre)
    : forms_(seen_from(first, centre), seen_from(second, centre))
  {
    using namespace operators;
    const auto &v = forms_.first_weight, &w = forms_.second_weight;
    planes_[0] = plane(v * forms_.first_tangent, dot(forms_.first_tangent, forms_.first_point));
    planes_[1] = plane(w * forms_.second_tangent, dot(forms_.second_tangent, forms_.second_point));
    planes_[2] = plane((2 * (v * w)) * forms_.difference,
                       subtract(square(forms_.first_point) * w * w, square(forms_.second_point) * v * v));
  }

  /// Those that are regular solutions. What the search leaves open stays open in the drawing.
  std::vector<Base_point> run(const Rational_map_piece<3, 2>& piece, double cut_radius, double tolerance, const Solve_control& control) const
  {
    using namespace operators;
    // The numerator is a multiple of the common line's direction there, which this vector is hardly across to.
    const Bernstein<Rational, 2> along = 3 * piece.numerator[0] + 5 * piece.numerator[1] + 7 * piece.numerator[2];
    const Equations<2> equations{std::make_shared<const Polynomial_equation<2>>(piece.weight),
                                 std::make_shared<const Polynomial_equation<2>>(along)};
    const Point_set<2> set = solve_points<2>(equations, control, {});
    std::vector<Base_point> found;
    for (const auto& p : set.points) {
      const auto base = examine(p, cut_radius, tolerance);
      const auto meets = [&](const Base_point& other) {
        for (std::size_t k = 0; k < 2; ++k)
          if (base->hole.lo[k] >= other.hole.hi[k] || base->hole.hi[k] <= other.hole.lo[k]) return false;
        return true;
      };
      if (base && std::none_of(found.begin(), found.end(), meets)) found.push_back(*base);
    }
    return found;
  }

private:
  using Plane = std::array<Enclosed_surface, 4>;
  using Values = std::array<Interval, 4>;

  static Plane plane(const Polynomial_vector<2, 3>& normal, const Bernstein<Rational, 2>& side)
  {
    return vector_of<4>([&](std::size_t k) {
      const Bernstein<Rational, 2>& f = k < 3 ? normal[k] : side;
      return Enclosed_surface(bounded(enclosing(f)));
    });
  }

  static Values values(const Plane& plane, const std::array<double, 2>& centre, const std::array<double, 2>& radius)
  {
    return vector_of<4>([&](std::size_t k) { return plane[k].over(centre, radius); });
  }

  static std::array<Interval, 3> cross_product(const Values& a, const Values& b)
  {
    return vector_of<3>([&](std::size_t k) { return Interval(a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]); });
  }
  static Interval norm(const Interval& x, const Interval& y, const Interval& z)
  {
    return CGAL::sqrt(CGAL::square(x) + CGAL::square(y) + CGAL::square(z));
  }

  /// The hole is all inside the domain and holds no other solution: so its rim, on which the surface's point goes once to infinity
  /// in both directions, runs along all of the line.
  /// A solution of weight = ⟨numerator, c⟩ = 0 is a base point if two of the planes have a line that is not across c: then the
  /// three normals have rank two, the numerator is a multiple of that line's direction, and so vanishes.
  std::optional<Base_point> examine(const Isolated_solution<2>& solution, double cut_radius, double tolerance) const
  {
    const std::array<Interval, 2>& at = solution.box;
    const std::array<double, 2> centre{midpoint(at[0]), midpoint(at[1])};
    const std::array<double, 2> radius{width(at[0]), width(at[1])};
    std::optional<std::array<std::size_t, 2>> best;
    double greatest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const Values a = values(planes_[i], centre, radius), b = values(planes_[j], centre, radius);
      const auto line = cross_product(a, b);
      if (contains_zero(Interval(3) * line[0] + Interval(5) * line[1] + Interval(7) * line[2])) continue;
      const Interval sine = norm(line[0], line[1], line[2]) / (norm(a[0], a[1], a[2]) * norm(b[0], b[1], b[2]));
      if (sine.inf() > greatest) {
        greatest = sine.inf();
        best = {i, j};
      }
    }
    if (!best) return std::nullopt;
    Base_point base{at, {}, 0};
    for (double h = 0x1p-5; h > 0x1p-24; h *= 0.5) {
      base.distance = distance_to_line(*best, centre, h, cut_radius);
      if (!(base.distance <= tolerance)) continue;
      bool fits = true;
      for (std::size_t k = 0; k < 2; ++k) {
        base.hole.lo[k] = centre[k] - h;
        base.hole.hi[k] = centre[k] + h;
        const double lo = std::max(0.0, solution.unique_in.lo[k]), hi = std::min(1.0, solution.unique_in.hi[k]);
        fits = fits && lo <= base.hole.lo[k] && base.hole.hi[k] <= hi;
      }
      if (fits) return base;
    }
    return std::nullopt;
  }

  /// How far from the planes' common line at the middle a point can be that lies on both planes at some place of the box and
  /// within the cut radius: each plane's equation changes by no more than its coefficients do.
  double distance_to_line(const std::array<std::size_t, 2>& pair, const std::array<double, 2>& centre, double h, double cut_radius) const
  {
    std::array<Values, 2> middle;
    Interval sum(0);
    for (std::size_t i = 0; i < 2; ++i) {
      middle[i] = values(planes_[pair[i]], centre, {0, 0});
      const Values all = values(planes_[pair[i]], centre, {h, h});
      const auto change = vector_of<4>([&](std::size_t k) { return Interval(width(all[k])); });
      sum += (norm(change[0], change[1], change[2]) * Interval(cut_radius) + change[3]) / norm(middle[i][0], middle[i][1], middle[i][2]);
    }
    const auto line = cross_product(middle[0], middle[1]);
    const Interval sine = norm(line[0], line[1], line[2]) /
                          (norm(middle[0][0], middle[0][1], middle[0][2]) * norm(middle[1][0], middle[1][1], middle[1][2]));
    return (sum / sine).sup();
  }

  Curve_pair_forms forms_;
  std::array<Plane, 3> planes_;
};

} // namespace detail
} // namespace locus

#endif
