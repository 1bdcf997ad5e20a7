// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_BISECTOR_3_H
#define LOCUS_CONSTRUCT_BISECTOR_3_H

#include <locus/construct/base_points.h>
#include <locus/construct/bisector_maps_3.h>
#include <locus/construct/plane_cylinder.h>
#include <locus/construct/rational_path.h>
#include <locus/construct/rational_sheets.h>

#include <chrono>

namespace locus {

namespace detail {

/// Where a foot lies, for the distance to it.
class Foot_curve {
public:
  explicit Foot_curve(const Rational_curve<3>& curve)
  {
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      pieces_.emplace_back(curve.pieces()[i].numerator, curve.pieces()[i].weight);
      ranges_.emplace_back(curve.chain().pieces[i]);
    }
  }

  double parameter(std::size_t piece, double s) const
  {
    const Range r = ranges_[piece].at(Interval(s));
    return std::isinf(r.hi) ? r.hi : std::isinf(r.lo) ? r.lo : r.lo + 0.5 * (r.hi - r.lo);
  }
  double distance(std::size_t piece, double s, const Approximate_point<3>& from) const
  {
    double square = 0;
    const auto p = pieces_[piece].at(Interval(s));
    for (std::size_t k = 0; k < 3; ++k) square += (midpoint(p[k]) - from[k]) * (midpoint(p[k]) - from[k]);
    return std::sqrt(square);
  }

private:
  std::vector<Map_evaluator<3>> pieces_;
  std::vector<Parameter_range> ranges_;
};

/// A map in the coordinates of a frame.
inline Rational_map_piece<3, 2> in_frame(Rational_map_piece<3, 2> piece, const Frame<3>& frame)
{
  Rational factor = 1;
  if (frame.exponent >= 0) mpq_div_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(frame.exponent));
  else mpq_mul_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(-frame.exponent));
  for (std::size_t k = 0; k < 3; ++k)
    piece.numerator[k] = multiply(subtract(piece.numerator[k], multiply(piece.weight, frame.origin[k])), factor);
  return piece;
}

inline Rational_curve<3> in_frame(const Rational_curve<3>& curve, const Frame<3>& frame)
{
  std::vector<Curve_piece<3>> pieces;
  for (const auto& piece : curve.pieces()) pieces.push_back(in_frame(piece, frame));
  return Rational_curve<3>(std::move(pieces), curve.chain());
}

/// What all bisectors in space share: the frame in which surfaces are drawn, and the result being filled.
class Bisector_3_maker {
public:
  Bisector_3_maker(const std::vector<Exact_point<3>>& points, const Mesh_options& options)
    : options_(options), start_(std::chrono::steady_clock::now()), frame_(fitting_frame<3>(points))
  {
    require_drawable(frame_);
    extent_ = extent_in<3>(frame_, points);
    if (extent_.scale == 0) extent_.scale = 1;
    data_.scale = frame_.length(Interval(extent_.scale)).sup();
    data_.cut_radius = cut_factor * data_.scale;
    for (std::size_t k = 0; k < 3; ++k) data_.centre[k] = midpoint(frame_.out_of(Interval(extent_.centre[k]), k));
    data_.compute = "bisector";
  }

  Locus_data<3>& data() { return data_; }
  const Frame<3>& frame() const { return frame_; }
  Rational scale() const { return exact_rational(data_.scale); }

  /// The inputs' surroundings, for charts over a coordinate.
  Coordinate_ranges surroundings() const
  {
    Coordinate_ranges ranges;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational middle = exact_rational(data_.centre[k]);
      ranges[k] = {Rational(middle - scale()), Rational(middle + scale())};
    }
    return ranges;
  }

  /// Parameters and radius of a vertex, the latter in frame units like the point.
  using Describe = std::function<Vertex_description(std::size_t, double, double, const Approximate_point<3>&)>;

  /// Looks for base points of a piece; they become holes of what is drawn next, if it is the given one of its pieces.
  void find_base_points(const Curve_piece<3>& first, const Curve_piece<3>& second, const Rational_map_piece<3, 2>& piece, std::size_t index)
  {
    Exact_point<3> centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = Rational(extent_.centre[k]);
    const Base_point_search search(in_frame(first, frame_), in_frame(second, frame_), centre);
    const double near = options_.tolerance * extent_.scale / 8;
    for (const Base_point& p : search.run(in_frame(piece, frame_), cut_factor * extent_.scale, near, rest_of_control())) {
      holes_.push_back({index, p.hole});
      hole_error_ = std::max(hole_error_, 2 * p.distance);
      const Range t = Parameter_range(piece.range[0]).at(p.at[0]), r = Parameter_range(piece.range[1]).at(p.at[1]);
      note("line", {t, r}, "both normal planes and the one half-way share a line: the surface runs along it, 0/0 in its parameters");
    }
  }

  void draw(const Rational_map<3, 2>& map, const std::array<std::size_t, 2>& grid, const std::array<bool, 2>& closed, Describe describe)
  {
    std::vector<Rational_map_piece<3, 2>> framed;
    for (const auto& piece : map.pieces()) framed.push_back(in_frame(piece, frame_));
    Sheet_options o;
    for (std::size_t k = 0; k < 3; ++k) o.centre[k] = extent_.centre[k];
    o.cut_radius = cut_factor * extent_.scale;
    o.tolerance = options_.tolerance * extent_.scale - hole_error_;
    o.max_cells = options_.max_cells;
    o.max_depth = 30; // near holes cells get small
    o.grid = grid;
    o.closed = closed;
    o.describe = std::move(describe);
    o.checkpoint = [control = rest_of_control(), start = std::chrono::steady_clock::now()] {
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (control.is_cancelled() || seconds > control.max_seconds) throw Stopped();
    };
    o.progress = options_.control.progress;
    o.holes = std::move(holes_);
    holes_.clear();
    Sheets drawn = rational_sheets(Rational_map<3, 2>(std::move(framed)), o);
    for (Sheet& s : drawn.sheets) data_.sheets.push_back(out_of_frame(std::move(s)));
    for (Undecided_piece& u : drawn.undecided) data_.undecided.push_back(std::move(u));
    data_.statistics.cells += drawn.cells;
    hole_error_ = 0;
  }

  void note(const char* kind, const std::vector<Range>& box, const std::string& reason)
  {
    Degenerate_piece d;
    d.kind = kind;
    d.box = box;
    d.reason = reason;
    data_.degenerate.push_back(std::move(d));
  }

  Locus<3> finish(const Degrees<2>& degrees, std::optional<Rational_map<3, 2>> rational)
  {
    if (degrees != Degrees<2>{}) data_.equations.push_back({"bisector surface", {degrees[0], degrees[1]}});
    if (rational && !rational->pieces().empty()) data_.rational_surface = std::move(rational);
    data_.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return Locus<3>(std::move(data_));
  }

  Mesh_options rest_of_options() const
  {
    Mesh_options rest = options_;
    rest.control = rest_of_control();
    return rest;
  }

private:
  /// What is left of the time.
  Solve_control rest_of_control() const
  {
    Solve_control rest = options_.control;
    rest.max_seconds -= std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return rest;
  }

  /// What was left out at holes is so near to what is drawn beside them that both errors add up; rounding comes on top.
  Sheet out_of_frame(Sheet sheet) const
  {
    double rounding = 0;
    for (auto& p : sheet.points) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Interval x = frame_.out_of(Interval(p[k]), k);
        p[k] = representative(x);
        sum += width(x);
      }
      rounding = std::max(rounding, sum);
    }
    for (double& r : sheet.radius) r = midpoint(frame_.length(Interval(r)));
    sheet.error = (frame_.length(Interval(sheet.error) + Interval(hole_error_)) + Interval(rounding)).sup();
    return sheet;
  }

  Mesh_options options_;
  std::chrono::steady_clock::time_point start_;
  Frame<3> frame_;
  Extent<3> extent_; ///< in the frame
  std::vector<Sheet_hole> holes_;
  double hole_error_ = 0; ///< in the frame
  Locus_data<3> data_;
};

inline Approximate_point<3> framed_point(const Exact_point<3>& p, const Frame<3>& frame)
{
  Approximate_point<3> q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = nearest_double(frame.into(p[k], k));
  return q;
}

inline std::vector<Range> whole_range(const Piece& piece)
{
  const Parameter_range range(piece);
  return {{range.at(Interval(0)).lo, range.at(Interval(1)).hi}};
}

/// Where the curve passes through the point, its whole normal plane is equidistant.
inline void note_point_on_curve(const Exact_point<3>& point, const Rational_curve<3>& curve, std::size_t i, Bisector_3_maker& maker)
{
  const Integer_polynomial common = common_factor(seen_from(curve.pieces()[i], point).numerator);
  if (degree(common) < 1) return;
  for (const auto& root : exact_roots(bernstein_form(common), Rational(0), Rational(1)).roots)
    maker.note("plane", {Parameter_range(curve.chain().pieces[i]).at(hull(enclosing(root.lo), enclosing(root.hi)))},
               "the curve passes through the point: its whole normal plane there is equidistant");
}

/// Raises `factor` until factor²·f > g on the unit interval, as Bernstein coefficients show: where those of f are not all
/// positive, on both halves of it. f has no zero.
inline void outgrow(const Bernstein<Rational, 1>& f, const Bernstein<Rational, 1>& g, Rational& factor)
{
  const auto& c = f.coefficients();
  const Rational least = *std::min_element(c.begin(), c.end());
  if (least <= 0) {
    const auto f_halves = split(f, 0, Rational(1, 2)), g_halves = split(g, 0, Rational(1, 2));
    outgrow(f_halves.first, g_halves.first, factor);
    outgrow(f_halves.second, g_halves.second, factor);
    return;
  }
  const Rational greatest = *std::max_element(g.coefficients().begin(), g.coefficients().end());
  while (factor * factor * least <= greatest) factor *= 2;
}

/// A factor λ such that λ·|generator| ≥ reach·|weight| on all of a piece: rulings go that far.
inline Rational ruling_reach(const Ruled_forms& forms, const Rational& reach)
{
  using namespace operators;
  const Bernstein<Rational, 1> f = square(forms.generator), g = multiply(forms.weight * forms.weight, Rational(reach * reach));
  const auto bits = [](const Bernstein<Rational, 1>& h) {
    const Rational x = *std::max_element(h.coefficients().begin(), h.coefficients().end());
    return static_cast<long>(mpz_sizeinbase(x.get_num_mpz_t(), 2)) - static_cast<long>(mpz_sizeinbase(x.get_den_mpz_t(), 2));
  };
  // It will not be much less than the root of the greatest coefficients' ratio.
  const long start = (bits(g) - bits(f)) / 2 - 8;
  Rational factor = 1;
  if (start >= 0) mpq_mul_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(start));
  else mpq_div_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(-start));
  outgrow(f, g, factor);
  return factor;
}

/// Scales a piece's generator so that its first ruling is the last one of the piece before with the same parameter, if it is
/// the same line: then both are drawn as one sheet.
inline void continue_rulings(const Ruled_forms& before, Ruled_forms& after)
{
  const auto ruling = [](const Ruled_forms& f, bool last) {
    const auto value = [last](const Bernstein<Rational, 1>& g) { return g[last ? g.size() - 1 : 0]; };
    const Rational w = value(f.weight);
    return w == 0 ? Exact_point<3>{} : vector_of<3>([&](std::size_t k) { return Rational(value(f.generator[k]) / w); });
  };
  const Exact_point<3> a = ruling(before, true), b = ruling(after, false), across = cross_product(a, b);
  const Rational length = dot<3>(b, b);
  if (length == 0 || across != Exact_point<3>{}) return;
  const Rational factor = dot<3>(a, b) / length;
  if (factor == 0) return;
  for (auto& g : after.generator) g = multiply(g, factor);
}

} // namespace detail

namespace detail {

inline Locus<3> point_point_bisector(const Exact_point<3>& a, const Exact_point<3>& b, const Mesh_options& options, bool trimmed)
{
  if (a == b) throw Invalid_input("", "both points are the same, so all points are equally far from them", "give two different points");
  return with_upward_rounding([&] {
    Bisector_3_maker maker({a, b}, options);
    const Rational_map<3, 2> map = point_point_bisector_map(a, b, Rational(maker.scale() * 12));
    const Approximate_point<3> foot = framed_point(a, maker.frame());
    maker.draw(map, {1, 1}, {false, false}, [foot](std::size_t, double, double, const Approximate_point<3>& p) {
      return Vertex_description{{}, distance_from(p, foot)};
    });
    maker.data().trimmed = trimmed;
    return maker.finish(map.degrees(), map);
  });
}

} // namespace detail

/// The plane of points at equal distance from two points, drawn up to the cut radius. Throws Invalid_input for one point twice.
inline Locus<3> bisector(const Exact_point<3>& a, const Exact_point<3>& b, const Mesh_options& options = {})
{
  return detail::point_point_bisector(a, b, options, true);
}

/// The same plane: of two points all solutions are nearest.
inline Locus<3> untrimmed_bisector(const Exact_point<3>& a, const Exact_point<3>& b, const Mesh_options& options = {})
{
  return detail::point_point_bisector(a, b, options, false);
}

/// All points at equal distance from a point and from a foot on a curve, in the foot's normal plane: a ruled surface. The exact
/// result (`Locus::rational_surface`) is that of the direct approach, in charts over coordinates; the drawn one follows the
/// rulings from their points next to the given point.
inline Locus<3> untrimmed_bisector(const Exact_point<3>& point, const Rational_curve<3>& curve, const Mesh_options& options = {})
{
  return with_upward_rounding([&] {
    std::vector<Exact_point<3>> points{point};
    detail::collect_control_points(curve, points);
    detail::Bisector_3_maker maker(points, options);
    std::vector<Rational_map_piece<3, 2>> charts;
    Degrees<2> degrees{};
    for (const Ruled_chart& chart : point_curve_bisector_charts(point, curve, maker.surroundings())) {
      degrees = detail::max_degrees<2>(degrees, chart.map.degrees());
      charts.push_back(chart.map);
    }
    std::vector<detail::Ruled_forms> forms;
    std::vector<std::size_t> source;
    Rational reach = 0;
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      const Plane_pencil planes = detail::point_curve_planes(detail::seen_from(curve.pieces()[i], point));
      if (planes.is_degenerate()) {
        maker.note("plane", detail::whole_range(curve.chain().pieces[i]),
                   "the piece lies on a line through the point: only where it passes through the point, its normal plane is equidistant");
        continue;
      }
      detail::note_point_on_curve(point, curve, i, maker);
      forms.push_back(planes.forms_by_directrix());
      if (forms.size() > 1) detail::continue_rulings(forms[forms.size() - 2], forms.back());
      reach = std::max(reach, detail::ruling_reach(forms.back(), Rational(maker.scale() * 24)));
      source.push_back(i);
    }
    std::vector<Rational_map_piece<3, 2>> drawn;
    for (std::size_t k = 0; k < forms.size(); ++k)
      drawn.push_back(detail::moved_by(forms[k].over(curve.chain().pieces[source[k]], {Rational(-reach), reach}), point));
    const detail::Foot_curve foot(detail::in_frame(curve, maker.frame()));
    const bool whole = drawn.size() == curve.pieces().size();
    if (!drawn.empty())
      maker.draw(Rational_map<3, 2>(drawn), {drawn.size(), 1}, {whole && curve.chain().is_closed(), false},
                 [&](std::size_t piece, double u, double, const Approximate_point<3>& p) {
                   return Vertex_description{{foot.parameter(source[piece], u)}, foot.distance(source[piece], u, p)};
                 });
    return maker.finish(degrees, Rational_map<3, 2>(std::move(charts)));
  });
}

/// All points at equal distance from feet on two space curves, in both normal planes: a rational surface over pairs of
/// parameters. Curves (or pieces) in one plane give the cylinder over their planar bisector, which is not rational.
/// Throws Unsupported_feature for those whose plane has no two orthogonal rational vectors of one length.
inline Locus<3> untrimmed_bisector(const Rational_curve<3>& first, const Rational_curve<3>& second, const Mesh_options& options = {})
{
  return with_upward_rounding([&] {
    std::vector<Exact_point<3>> points;
    detail::collect_control_points(first, points);
    detail::collect_control_points(second, points);
    detail::Bisector_3_maker maker(points, options);
    if (const auto plane = detail::plane_of(first, second)) {
      detail::draw_cylinder(*plane, first, second, maker.rest_of_options(), maker.data());
      return maker.finish({0, 0}, std::nullopt);
    }
    const std::size_t n = first.pieces().size(), m = second.pieces().size();
    std::vector<std::optional<Rational_map_piece<3, 2>>> piece;
    std::vector<Rational_map_piece<3, 2>> all;
    for (std::size_t k = 0; k < n * m; ++k) {
      piece.push_back(curve_curve_bisector_piece(first.pieces()[k / m], first.chain().pieces[k / m], second.pieces()[k % m], second.chain().pieces[k % m]));
      if (piece.back()) all.push_back(*piece.back());
    }
    const Rational_map<3, 2> map(all);
    const detail::Foot_curve a(detail::in_frame(first, maker.frame())), b(detail::in_frame(second, maker.frame()));
    const auto describe = [&](std::size_t i, std::size_t j, double u, double v, const Approximate_point<3>& p) {
      return Vertex_description{{a.parameter(i, u), b.parameter(j, v)}, 0.5 * (a.distance(i, u, p) + b.distance(j, v, p))};
    };
    if (all.size() == n * m) {
      for (std::size_t k = 0; k < n * m; ++k) maker.find_base_points(first.pieces()[k / m], second.pieces()[k % m], all[k], k);
      maker.draw(map, {n, m}, {first.chain().is_closed(), second.chain().is_closed()},
                 [&](std::size_t k, double u, double v, const Approximate_point<3>& p) { return describe(k / m, k % m, u, v, p); });
      return maker.finish(map.degrees(), map);
    }
    for (std::size_t k = 0; k < n * m; ++k) {
      const std::size_t i = k / m, j = k % m;
      if (piece[k]) {
        maker.find_base_points(first.pieces()[i], second.pieces()[j], *piece[k], 0);
        maker.draw(Rational_map<3, 2>({*piece[k]}), {1, 1}, {false, false},
                   [&](std::size_t, double u, double v, const Approximate_point<3>& p) { return describe(i, j, u, v, p); });
        continue;
      }
      const Rational_curve<3> p = detail::single_piece(first, i), q = detail::single_piece(second, j);
      if (const auto plane = detail::plane_of(p, q)) detail::draw_cylinder(*plane, p, q, maker.rest_of_options(), maker.data());
      else throw std::logic_error("locus: two pieces without a bisector surface do not lie in one plane");
    }
    return maker.finish(map.degrees(), map);
  });
}

/// All points at equal distance from a point and from a foot on a surface, on the foot's normal: a rational surface.
inline Locus<3> untrimmed_bisector(const Exact_point<3>& point, const Rational_surface& surface, const Mesh_options& options = {})
{
  return with_upward_rounding([&] {
    std::vector<Exact_point<3>> points{point};
    for (const Surface_piece& s : surface.pieces()) detail::collect_control_points(s, points);
    detail::Bisector_3_maker maker(points, options);
    const Rational_map<3, 2> map = point_surface_bisector_map(point, surface);
    const auto& chains = surface.chains();
    const std::array<std::size_t, 2> grid{chains[0].pieces.size(), chains[1].pieces.size()};
    const Approximate_point<3> foot = detail::framed_point(point, maker.frame());
    const auto describe = [&](const std::array<Piece, 2>& range, double u, double v, const Approximate_point<3>& p) {
      const Range a = Parameter_range(range[0]).at(Interval(u)), b = Parameter_range(range[1]).at(Interval(v));
      return Vertex_description{{a.lo + 0.5 * (a.hi - a.lo), b.lo + 0.5 * (b.hi - b.lo)}, detail::distance_from(p, foot)};
    };
    const bool whole = map.pieces().size() == grid[0] * grid[1];
    if (!whole)
      maker.note("cone", {}, "all tangent planes of a piece of the surface pass through the point: only where the surface itself does, "
                             "its normal is equidistant");
    if (whole)
      maker.draw(map, grid, {false, false}, [&](std::size_t k, double u, double v, const Approximate_point<3>& p) {
        return describe(map.pieces()[k].range, u, v, p);
      });
    else
      for (const auto& piece : map.pieces())
        maker.draw(Rational_map<3, 2>({piece}), {1, 1}, {false, false},
                   [&](std::size_t, double u, double v, const Approximate_point<3>& p) { return describe(piece.range, u, v, p); });
    return maker.finish(map.degrees(), map);
  });
}

} // namespace locus

#endif
