// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CURVATURE_EXTREMA_2_H
#define LOCUS_CONSTRUCT_CURVATURE_EXTREMA_2_H

#include <locus/constraint/curvature_2.h>
#include <locus/construct/planar_pieces.h>

namespace locus {

/// A point of a planar curve where its curvature, as a function along the curve, is extremal, stationary or jumps. There the
/// arcs of the curve's self-bisector end on the diagonal, in the centre of curvature.
struct Curvature_point {
  enum class Kind : unsigned char {
    extremum,   ///< the curvature's derivative changes its sign inside a piece
    stationary, ///< it vanishes there without changing it
    jump,       ///< at a joint the curvature has two values
    kink        ///< at a joint its derivative has two values, or vanishes; `changes_sign` tells whether the curvature is extremal
  };
  Kind kind = Kind::extremum;
  Range parameter;                           ///< encloses it
  int multiplicity = 1;                      ///< of the zero, inside a piece
  bool changes_sign = true;                  ///< of the derivative (left and right of a joint)
  Approximate_point<2> point;
  std::optional<Approximate_point<2>> centre; ///< none where the curvature vanishes; at a joint the left one
  double centre_error = 0;                    ///< proved bound of the printed centre's distance from the exact one
};

namespace detail {

class Curvature_search {
public:
  explicit Curvature_search(const Curve_2& curve)
  {
    std::vector<Exact_point<2>> points;
    collect_control_points(curve, points);
    frame_ = fitting_frame<2>(points);
    pieces_.emplace(curve, frame_);
    for (const auto& c : pieces_->curves) forms_.emplace_back(*c);
  }

  std::vector<Curvature_point> run()
  {
    for (std::size_t i = 0; i < pieces_->size(); ++i) {
      inside(i);
      if (pieces_->chain.goes_on_at(i, 1)) at_joint(i, pieces_->chain.neighbour(i, 1));
    }
    return std::move(found_);
  }

private:
  using Kind = Curvature_point::Kind;

  void inside(std::size_t i)
  {
    const Bernstein<Scaled_integer, 1> f(forms_[i].critical);
    if (f.is_zero()) return; // on a line or a circle
    for (auto root : exact_roots(f, 0.0, 1.0).roots) {
      if (root.is_exact() && (root.lo == 0 || root.lo == 1)) continue; // a joint's or an end's
      while (!root.is_exact() && root.hi - root.lo > 0x1p-50)
        if (!bisect_exactly(*root.factor, 0.0, 1.0, root)) break;
      Curvature_point p;
      p.multiplicity = root.multiplicity;
      p.changes_sign = root.multiplicity % 2 == 1;
      p.kind = p.changes_sign ? Kind::extremum : Kind::stationary;
      place(i, Interval(root.lo, root.hi), p);
      found_.push_back(p);
    }
  }

  /// Joints where the normal turns continuously: compared exactly from both sides.
  void at_joint(std::size_t i, std::size_t next)
  {
    if (pieces_->curves[i]->is_singular_at(1) || pieces_->curves[next]->is_singular_at(0)) return;
    const auto left = forms_[i].at(1), right = forms_[next].at(0);
    const bool jumps = !left.same_curvature(right);
    const int before = sign_beside(forms_[i].critical, true), after = sign_beside(forms_[next].critical, false);
    const bool stands = left.slope == 0 && (before != 0 || after != 0); // and the curve is no circle or line on both sides
    if (!jumps && left.slope == right.slope && !stands) return;
    Curvature_point p;
    p.kind = jumps ? Kind::jump : Kind::kink;
    p.changes_sign = before * after < 0;
    place(i, Interval(1), p);
    found_.push_back(p);
  }

  /// Sign of a polynomial next to an end of the unit interval: that of the nearest coefficient that is not zero.
  static int sign_beside(const Bernstein<Rational, 1>& f, bool high)
  {
    const auto& c = f.coefficients();
    for (std::size_t k = 0; k < c.size(); ++k)
      if (const int s = sgn(c[high ? c.size() - 1 - k : k]); s != 0) return s;
    return 0;
  }

  void place(std::size_t i, const Interval& u, Curvature_point& p) const
  {
    p.parameter = pieces_->ranges[i].at(u);
    const Enclosed_function x(pieces_->curves[i]->numerator(0)), y(pieces_->curves[i]->numerator(1)), w(forms_[i].weight);
    const Enclosed_function dx(forms_[i].first[0]), dy(forms_[i].first[1]), wr(forms_[i].wronskian);
    const Interval weight = w.at(u), ax = dx.at(u), ay = dy.at(u);
    const Interval px = x.at(u) / weight, py = y.at(u) / weight;
    p.point = out({px, py});
    // The centre is iD1|D1|²/(Wr·w³) from the point.
    const Interval reach = (CGAL::square(ax) + CGAL::square(ay)) / (wr.at(u) * weight * weight * weight);
    const Vector_2<Interval> centre{px - ay * reach, py + ax * reach};
    const double error = frame_.length(Interval(0, diameter(centre))).sup();
    if (!std::isfinite(error)) return;
    p.centre = out(centre);
    p.centre_error = error + rounding(*p.centre);
  }

  Approximate_point<2> out(const Vector_2<Interval>& v) const
  {
    Approximate_point<2> p;
    p[0] = representative(frame_.out_of(v.x, 0));
    p[1] = representative(frame_.out_of(v.y, 1));
    return p;
  }

  static double rounding(const Approximate_point<2>& p) { return 8 * operation_error * (std::abs(p[0]) + std::abs(p[1])); }

  Frame<2> frame_;
  std::optional<Planar_pieces> pieces_;
  std::vector<Curvature_forms> forms_;
  std::vector<Curvature_point> found_;
};

} // namespace detail

/// The points of a curve where its curvature is extremal, stationary, or not smooth, in order along the curve; ends and
/// corners are left out. Roots of a polynomial of degree at most 8d - 12 (4d - 7 for a polynomial curve), isolated exactly.
inline std::vector<Curvature_point> curvature_points(const Curve_2& curve)
{
  return with_upward_rounding([&] { return detail::Curvature_search(curve).run(); });
}

} // namespace locus

#endif
