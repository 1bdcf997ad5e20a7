// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANE_CYLINDER_H
#define LOCUS_CONSTRUCT_PLANE_CYLINDER_H

#include <locus/construct/mesh_options.h>
#include <locus/construct/untrimmed_bisector_2.h>

namespace locus {

namespace detail {

/// A plane with orthogonal coordinates of one scale: origin + x·axis[0] + y·axis[1]; `height` is the unit normal.
struct Common_plane {
  Exact_point<3> origin{};
  std::array<Exact_point<3>, 2> axis{};
  Exact_point<3> height{};
  Rational squared_scale = 1; ///< of both axes
  bool is_line = false;       ///< the points lie on one line
  bool has_axes = false;      ///< else no two orthogonal rational vectors of this plane have one length
};

inline Exact_point<3> difference(const Exact_point<3>& a, const Exact_point<3>& b)
{
  return vector_of<3>([&](std::size_t k) { return Rational(a[k] - b[k]); });
}
inline Exact_point<3> cross_product(const Exact_point<3>& p, const Exact_point<3>& q)
{
  return {Rational(p[1] * q[2] - p[2] * q[1]), Rational(p[2] * q[0] - p[0] * q[2]), Rational(p[0] * q[1] - p[1] * q[0])};
}

/// The square root of a rational number that has a rational one.
inline std::optional<Rational> rational_square_root(const Rational& x)
{
  if (x < 0 || !mpz_perfect_square_p(x.get_num_mpz_t()) || !mpz_perfect_square_p(x.get_den_mpz_t())) return std::nullopt;
  Rational root(sqrt(Integer(x.get_num())), sqrt(Integer(x.get_den())));
  root.canonicalize();
  return root;
}

/// The plane of points that lie in one. The second axis is the first one turned about the normal, which is rational exactly
/// where the normal's length is.
inline std::optional<Common_plane> common_plane(const std::vector<Exact_point<3>>& points)
{
  Common_plane plane;
  plane.origin = points[0];
  const Exact_point<3> zero{};
  Exact_point<3> normal{};
  for (const auto& p : points) {
    const Exact_point<3> d = difference(p, plane.origin);
    if (plane.axis[0] == zero) plane.axis[0] = d;
    if (normal == zero) normal = cross_product(plane.axis[0], d);
    if (dot<3>(normal, d) != 0) return std::nullopt;
  }
  // The normal was not known to the first points, but they are on the line that the first axis spans.
  plane.is_line = normal == zero;
  plane.squared_scale = dot<3>(plane.axis[0], plane.axis[0]);
  if (plane.is_line) return plane;
  const auto length = rational_square_root(dot<3>(normal, normal));
  // Only the ratio to the first axis matters: |normal × axis|/|axis| = |normal|.
  if (!length) return plane;
  plane.has_axes = true;
  plane.height = vector_of<3>([&](std::size_t k) { return Rational(normal[k] / *length); });
  plane.axis[1] = cross_product(plane.height, plane.axis[0]);
  return plane;
}

/// A curve of the plane in the plane's coordinates.
inline Curve_2 in_plane(const Rational_curve<3>& curve, const Common_plane& plane)
{
  std::vector<Curve_piece<2>> pieces;
  for (const Curve_piece<3>& piece : curve.pieces()) {
    Curve_piece<2> flat;
    flat.weight = piece.weight;
    for (std::size_t a = 0; a < 2; ++a) {
      Bernstein<Rational, 1> sum(piece.numerator[0].degrees());
      for (std::size_t k = 0; k < 3; ++k) {
        const Rational factor = plane.axis[a][k] / plane.squared_scale;
        sum = add(sum, multiply(subtract(piece.numerator[k], multiply(piece.weight, plane.origin[k])), factor));
      }
      flat.numerator[a] = std::move(sum);
    }
    pieces.push_back(std::move(flat));
  }
  return Curve_2(std::move(pieces), curve.chain());
}

inline Rational_curve<3> single_piece(const Rational_curve<3>& curve, std::size_t index)
{
  Chain chain;
  chain.pieces = {curve.chain().pieces[index]};
  chain.joints.clear();
  return Rational_curve<3>({curve.pieces()[index]}, chain);
}

/// Points that span the same plane as a curve's control points do: those at infinity are taken as directions.
inline void collect_plane_points(const Rational_curve<3>& curve, std::vector<Exact_point<3>>& points)
{
  for (const Curve_piece<3>& piece : curve.pieces()) {
    std::vector<Exact_point<3>> directions;
    std::optional<Exact_point<3>> base;
    for (std::size_t i = 0; i < piece.numerator[0].size(); ++i) {
      const Rational& w = piece.weight[piece.is_polynomial() ? 0 : i];
      Exact_point<3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = w == 0 ? piece.numerator[k][i] : Rational(piece.numerator[k][i] / w);
      if (w == 0) {
        directions.push_back(p);
        continue;
      }
      base = p;
      points.push_back(p);
    }
    for (const auto& d : directions)
      if (base) points.push_back(vector_of<3>([&](std::size_t k) { return Rational((*base)[k] + d[k]); }));
  }
}

inline std::optional<Common_plane> plane_of(const Rational_curve<3>& first, const Rational_curve<3>& second)
{
  std::vector<Exact_point<3>> points;
  collect_plane_points(first, points);
  collect_plane_points(second, points);
  return common_plane(points);
}

/// One strip over a polyline of the plane, up and down as far as `height`.
class Strip_maker {
public:
  Strip_maker(const Common_plane& plane, double height) : height_(height), scale_(std::sqrt(nearest_double(plane.squared_scale)))
  {
    for (std::size_t k = 0; k < 3; ++k) {
      origin_[k] = enclosing(plane.origin[k]);
      for (std::size_t a = 0; a < 2; ++a) axis_[a][k] = enclosing(plane.axis[a][k]);
      up_[k] = enclosing(plane.height[k]);
    }
  }

  Sheet make(const Polyline<2>& line, bool closed) const
  {
    Sheet sheet;
    double rounding = 0;
    const std::size_t n = closed ? line.size() - 1 : line.size();
    for (std::size_t i = 0; i < n; ++i)
      for (const double side : {-1.0, 1.0}) rounding = std::max(rounding, add_point(line[i], side, sheet));
    const std::size_t steps = closed ? n : n - 1;
    std::array<std::vector<std::size_t>, 2> rim;
    for (std::size_t i = 0; i < steps; ++i) {
      const std::size_t a = 2 * i, b = 2 * ((i + 1) % n);
      sheet.triangles.push_back({a, b, b + 1});
      sheet.triangles.push_back({a, b + 1, a + 1});
    }
    for (std::size_t i = 0; i < n; ++i) {
      rim[0].push_back(2 * i);
      rim[1].push_back(2 * i + 1);
    }
    std::reverse(rim[1].begin(), rim[1].end());
    if (closed) {
      for (auto& loop : rim) sheet.boundary.push_back({"infinity", std::move(loop)});
      sheet.euler = 0;
    } else {
      rim[0].insert(rim[0].end(), rim[1].begin(), rim[1].end());
      sheet.boundary.push_back({"infinity", std::move(rim[0])});
      sheet.euler = 1;
    }
    sheet.error = line.error() * scale_ * (1 + 8 * operation_error) + rounding;
    return sheet;
  }

private:
  /// Returns the rounding of the printed point.
  double add_point(const Arc_point<2>& p, double side, Sheet& sheet) const
  {
    Approximate_point<3> q;
    double rounding = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Interval x = origin_[k] + axis_[0][k] * Interval(p.point()[0]) + axis_[1][k] * Interval(p.point()[1]) + up_[k] * Interval(side * height_);
      q[k] = representative(x);
      rounding += width(x);
    }
    sheet.points.push_back(q);
    sheet.parameters.push_back({p.parameter(0), p.parameter(1)});
    sheet.radius.push_back(std::hypot(scale_ * p.radius(), height_));
    return rounding;
  }

  double height_, scale_;
  std::array<Interval, 3> origin_, up_;
  std::array<std::array<Interval, 3>, 2> axis_;
};

/// Adds the cylinder over the planar bisector of two curves in one plane: every point over or under it is equally far from the
/// same feet, and no others are.
inline void draw_cylinder(const Common_plane& plane, const Rational_curve<3>& first, const Rational_curve<3>& second,
                          const Mesh_options& options, Locus_data<3>& data)
{
  if (plane.is_line) {
    Degenerate_piece d;
    d.kind = "everything";
    d.reason = "both curves lie on one line: their normal planes are parallel or the same";
    data.degenerate.push_back(d);
    return;
  }
  if (!plane.has_axes)
    throw Unsupported_feature("curves in one plane whose normal has an irrational length (turn the inputs into a plane whose "
                              "normal has a rational one, like z = 0)");
  // The inputs are within their diameter of the middle, and so is its foot in the plane.
  const double far = data.cut_radius + 2 * data.scale;
  Bisector_options planar_options;
  planar_options.control = options.control;
  planar_options.least_cut_radius = far / std::sqrt(nearest_double(plane.squared_scale));
  const Locus<2> planar = untrimmed_bisector(in_plane(first, plane), in_plane(second, plane), planar_options);
  const Strip_maker maker(plane, far);
  const double scale = std::sqrt(nearest_double(plane.squared_scale)); // a length of the plane's coordinates in space
  for (const Arc<2>& arc : planar.arcs()) {
    const Polyline<2> line = arc.polyline(options.tolerance * data.scale / (planar.scale() * scale));
    if (std::isfinite(line.error())) {
      data.sheets.push_back(maker.make(line, arc.is_closed()));
      continue;
    }
    Undecided_piece u;
    u.box = line[0].parameters();
    u.reason = "from here on an arc of the planar bisector has no proved error";
    data.undecided.push_back(std::move(u));
  }
  for (const Locus_vertex<2>& v : planar.vertices()) {
    if (v.kind != Vertex_kind::isolated) continue;
    Degenerate_piece line;
    line.kind = "line";
    for (const Foot& foot : v.feet) line.box.insert(line.box.end(), foot.parameters.begin(), foot.parameters.end());
    line.reason = "the planar bisector has an isolated point: the line over it is equally far from both feet";
    data.degenerate.push_back(line);
  }
  for (const Equation_info& e : planar.equations()) data.equations.push_back(e);
  data.degenerate.insert(data.degenerate.end(), planar.degenerate().begin(), planar.degenerate().end());
  data.undecided.insert(data.undecided.end(), planar.undecided().begin(), planar.undecided().end());
  data.statistics.cells += planar.statistics().cells;
  Degenerate_piece note;
  note.kind = "cylinder";
  note.reason = "the curves lie in one plane: the bisector is the cylinder over their planar bisector";
  data.degenerate.push_back(note);
}

} // namespace detail
} // namespace locus

#endif
