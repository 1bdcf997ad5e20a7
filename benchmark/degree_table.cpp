// SPDX-License-Identifier: LGPL-3.0-or-later
// Prints doc/degrees.md: what degrees, control points and building times the objects of Chen, Riesenfeld & Cohen have by
// brute force, in the paper's own forms and here, and what discarding denominators does to roots. Every number but the
// quotations in the columns "printed" is measured.
#include "conditioning.h"
#include "side_by_side.h"

#include <locus/constraint/brute_force_surfaces.h>
#include <locus/construct/bisector_maps_3.h>
#include <locus/construct/derived_curves.h>
#include <locus/construct/developables.h>
#include <locus/shape/constructors_3.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace locus;
using locus_benchmark::Conditioning_row;
using locus_benchmark::Root_measures;
using Form = Bernstein<Rational, 1>;

// ------------------------------------------------------------------------------------------------------- sizes

struct Size {
  int degree = 0; ///< along the curve
  std::size_t points = 0;
};

/// One entry of the table: empty where there is no such object.
struct Object {
  Size size;
  std::function<void()> build;
};

int formal_degree(const Form& f) { return f.degree(); }
template <std::size_t N>
int formal_degree(const Unreduced_quotient<N>& f)
{
  return f.degree();
}

std::size_t order(int degree) { return static_cast<std::size_t>(degree) + 1; }

/// Without any continuity: degree + 1 points a span, `across` times as many for a surface.
template <int Dim, class Make>
Object by_spans(const Rational_curve<Dim>& curve, Make make, std::size_t across = 1)
{
  Object object;
  for (const auto& piece : curve.pieces()) {
    const int degree = formal_degree(make(piece));
    object.size.degree = std::max(object.size.degree, degree);
    object.size.points += order(degree) * across;
  }
  object.build = [curve, make] {
    for (const auto& piece : curve.pieces()) locus_benchmark::keep(make(piece));
  };
  return object;
}

/// A function along the curve with as many derivatives in it as `derivatives`, which says how pieces are scaled.
template <int Dim, class Make>
Object function_along(const Rational_curve<Dim>& curve, int derivatives, Make make)
{
  Object object = by_spans(curve, make);
  const auto spline = spline_along(curve, derivatives, make);
  object.size = {spline.degree(), spline.size()};
  return object;
}

// A derived map's pieces each have homogeneous coordinates of their own: before continuity is asked for they are scaled by
// constants so that neighbours agree where they meet.

template <int Dim, int K>
using Map_pieces = std::vector<Rational_map_piece<Dim, K>>;

template <int Dim, int K>
Polynomial_vector<K, static_cast<std::size_t>(Dim) + 1> homogeneous(const Rational_map_piece<Dim, K>& piece, const Degrees<K>& degrees)
{
  constexpr auto n = static_cast<std::size_t>(Dim);
  return locus::detail::vector_of<n + 1>(
    [&](std::size_t k) { return locus::detail::elevated_to(k < n ? piece.numerator[k] : piece.weight, degrees); });
}

/// The factor that takes the start of `above`, in the first variable, to the end of `below`; 1 where there is none.
template <int K, std::size_t N>
Rational scale_between(const Polynomial_vector<K, N>& below, const Polynomial_vector<K, N>& above)
{
  const Layout layout = layout_along(below[0].degrees(), 0);
  for (std::size_t k = 0; k < N; ++k)
    for (std::size_t i = 0; i < layout.inner; ++i) {
      const Rational &a = below[k][(layout.count - 1) * layout.inner + i], &b = above[k][i];
      if (a != 0 && b != 0) return Rational(a / b);
    }
  return 1;
}

/// Pieces that follow each other in the first variable, as one B-spline with the least knots.
template <int Dim, int K>
std::size_t points_of_chain(const Map_pieces<Dim, K>& pieces, std::size_t from, std::size_t to, const Degrees<K>& degrees)
{
  constexpr auto n = static_cast<std::size_t>(Dim) + 1;
  std::array<std::vector<Spline_span<Rational, K>>, n> spans;
  Polynomial_vector<K, n> last;
  for (std::size_t i = from; i < to; ++i) {
    auto all = homogeneous<Dim, K>(pieces[i], degrees);
    const Rational scale = i == from ? Rational(1) : scale_between<K>(last, all);
    for (auto& f : all) f = multiply(f, scale);
    for (std::size_t k = 0; k < n; ++k) {
      spans[k].push_back({{}, {}, all[k]});
      for (std::size_t v = 0; v < static_cast<std::size_t>(K); ++v) {
        spans[k].back().lo[v] = pieces[i].range[v].lo;
        spans[k].back().hi[v] = pieces[i].range[v].hi;
      }
    }
    last = all;
  }
  const auto breaks = locus::detail::breaks_of<Rational, K>(spans[0]);
  std::vector<int> least(breaks[0].size(), Knots::unlimited);
  for (const auto& coordinate : spans) {
    const std::vector<int> own = locus::detail::continuities<Rational, K>(coordinate, breaks, 0);
    for (std::size_t i = 0; i < own.size(); ++i) least[i] = std::min(least[i], own[i]);
  }
  std::size_t i = 0;
  const Knots knots = knots_over(degrees[0], breaks[0], [&](const Rational&) { return least[++i]; });
  auto points = static_cast<std::size_t>(knots.control_count());
  for (std::size_t v = 1; v < static_cast<std::size_t>(K); ++v) points *= order(degrees[v]);
  return points;
}

/// A chain ends where the next piece does not follow, or `separate` says that it is another surface.
template <int Dim, int K, class Separate>
Size size_of(const Map_pieces<Dim, K>& pieces, Separate separate)
{
  const Degrees<K> degrees = Rational_map<Dim, K>(pieces).degrees();
  Size size{degrees[0], 0};
  for (std::size_t from = 0, to; from < pieces.size(); from = to) {
    for (to = from + 1; to < pieces.size(); ++to)
      if (pieces[to].range[0].lo != pieces[to - 1].range[0].hi || separate(to)) break;
    size.points += points_of_chain<Dim, K>(pieces, from, to, degrees);
  }
  return size;
}

template <class Build>
Object map_object(Build build)
{
  return {size_of(build().pieces(), [](std::size_t) { return false; }), [build] { locus_benchmark::keep(build()); }};
}

/// Charts of different coordinates are different surfaces.
template <class Build>
Object chart_object(Build build)
{
  const std::vector<Ruled_chart> charts = build();
  Map_pieces<3, 2> pieces;
  for (const Ruled_chart& chart : charts) pieces.push_back(chart.map);
  return {size_of(pieces, [&](std::size_t i) { return charts[i].coordinate != charts[i - 1].coordinate; }),
          [build] { locus_benchmark::keep(build()); }};
}

/// A surface by sections at parameters of the second curve: as many as its degree there, taken for that in the first, asks.
template <class Make>
Object by_sections(const Curve_3& first, const Curve_3& second, Make make)
{
  const Curve_piece<3>&a = first.pieces()[0], &b = second.pieces()[0];
  const int degree = make(a, Held_foot(b, Rational(1, 2))).degree();
  return {{degree, order(degree) * order(degree)}, [=] {
            for (int i = 0; i <= degree; ++i) locus_benchmark::keep(make(a, Held_foot(b, Rational(Rational(i) / degree))));
          }};
}

// ------------------------------------------------------------------------------------------------------- curves

Curve_2 ellipse() { return ellipse_2({0, 0}, 4, 2); }

/// The same from other points: conjugate half-diameters turned by the angle with cosine 3/5, so that no span ends in a vertex.
Curve_2 turned_ellipse()
{
  return detail::conic_around({0, 0}, {Rational(12, 5), Rational(8, 5)}, {Rational(-16, 5), Rational(6, 5)});
}
Curve_2 plane_spline()
{
  return bspline_2(3, {{0, 0}, {1, 4}, {4, 5}, {6, 2}, {5, -2}, {8, -4}, {12, -1}, {11, 4}, {15, 6}}, {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6});
}

template <class T>
std::vector<T> first_of(const std::vector<T>& all, std::size_t n)
{
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n)};
}

/// Bézier curves of a degree from 2 to 4 in general position.
Curve_2 plane_curve(int degree, bool rational)
{
  return bezier_2(first_of<Coordinates_2>({{0, 0}, {1, 3}, {4, 4}, {6, 1}, {9, 2}}, order(degree)),
                  first_of<Number>({1, 2, 3, 2, 1}, rational ? order(degree) : 0));
}

Curve_3 space_curve(int degree, bool rational)
{
  return bezier_3(first_of<Coordinates_3>({{0, 0, 0}, {1, 3, 1}, {4, 4, 0}, {6, 1, 3}, {9, 2, 7}}, order(degree)),
                  first_of<Number>({1, 2, 3, 2, 1}, rational ? order(degree) : 0));
}

Curve_3 other_space_curve(int degree, bool rational)
{
  return bezier_3(first_of<Coordinates_3>({{1, 7, 5}, {2, 9, 8}, {5, 6, 9}, {8, 7, 6}, {9, 9, 4}}, order(degree)),
                  first_of<Number>({2, 1, 1, 3, 1}, rational ? order(degree) : 0));
}

/// One turn around the z axis in quarters, rising.
Curve_3 helix_like()
{
  return bspline_3(2, {{2, 0, 0}, {2, 2, 0.5}, {0, 2, 1}, {-2, 2, 1.5}, {-2, 0, 2}, {-2, -2, 2.5}, {0, -2, 3}, {2, -2, 3.5}, {2, 0, 4}},
                   {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {1, 1, 2, 1, 1, 1, 2, 1, 1});
}
Exact_point<3> gray_point() { return {Rational(1, 2), Rational(1, 3), Rational(2)}; }

Rational_surface biquadratic(bool rational)
{
  const std::vector<Coordinates_3> points{{0, 0, 0}, {0, 2, 1}, {0, 4, 0}, {2, 0, 1}, {2, 2, 3}, {2, 4, 2}, {4, 0, 1}, {4, 2, 1}, {5, 4, 0}};
  return bezier_surface_3({2, 2}, points, rational ? std::vector<Number>{1, 2, 1, 1, 3, 2, 1, 1, 2} : std::vector<Number>{});
}

// ------------------------------------------------------------------------------------------------------- rows

struct Row {
  std::string object, curve;
  Object brute, paper, here;
  std::string printed;
};

#define LOCUS_FORM(expression) [](const auto& piece) { return expression; }

void plane_rows(std::vector<Row>& rows)
{
  const auto bend = LOCUS_FORM(wronskian(Derivative_vectors<2>(piece).homogeneous()));
  const auto critical = LOCUS_FORM(Curvature_forms<2>(piece).critical);
  const auto squared = LOCUS_FORM(derivative(brute_force::squared_curvature(piece)));
  const auto reduced = LOCUS_FORM(paper_form::critical(piece));
  const Curve_2 cubic = plane_curve(3, true);
  rows.push_back({"inflections", "rational cubic", by_spans(cubic, LOCUS_FORM(brute_force::inflections(piece))),
                  by_spans(cubic, LOCUS_FORM(paper_form::inflections(piece))), function_along(cubic, 3, bend), "6d / 3d-3"});
  const auto add = [&](const char* name, const Curve_2& curve, const char* printed) {
    rows.push_back({"critical curvature", name, by_spans(curve, squared), by_spans(curve, reduced), function_along(curve, 6, critical), printed});
  };
  add("ellipse, 4 spans", turned_ellipse(), "96 (388) / 12 (52), Fig. 2");
  add("the same, from vertex to vertex", ellipse(), "the same [^ellipse]");
  add("cubic B-spline, 6 spans", plane_spline(), "24 (150) / 6 (24), Fig. 1 [^fig1]");
  add("rational cubic", cubic, "144 / 21");
  rows.push_back({"evolute", "ellipse, 4 spans", by_spans(ellipse(), LOCUS_FORM(brute_force::evolute(piece))),
                  by_spans(ellipse(), LOCUS_FORM(paper_form::evolute(piece))), map_object([] { return evolute_map(ellipse()); }),
                  "26 (108) / 9 (40), Fig. 3"});
}

Map_pieces<1, 1> torsion_quotient(const Curve_3& curve)
{
  using namespace operators;
  Map_pieces<1, 1> pieces;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
    const Curve_piece<3>& piece = curve.pieces()[i];
    const auto minors = wronskian_minors(Derivative_vectors<3>(piece).homogeneous());
    const Polynomial_vector<1, 3> bend{minors[0], minors[1], minors[2]};
    pieces.push_back(rational_map_piece<1, 1>({piece.weight * piece.weight * torsion_form(piece)}, square(bend), {curve.chain().pieces[i]}));
  }
  return pieces;
}

void scalar_rows_in_space(std::vector<Row>& rows)
{
  const Curve_3 cubic = space_curve(3, true), quartic = space_curve(4, true);
  rows.push_back({"torsion", "rational quartic", by_spans(quartic, LOCUS_FORM(brute_force::torsion(piece))),
                  by_spans(quartic, LOCUS_FORM(paper_form::torsion_quotient(piece))),
                  map_object([=] { return Rational_map<1, 1>(torsion_quotient(quartic)); }), "26d / 8d-6"});
  const auto zeros = [&](const char* name, const Curve_3& curve) {
    rows.push_back({"torsion's zeros", name, by_spans(curve, LOCUS_FORM(brute_force::triple_product(piece))),
                    by_spans(curve, LOCUS_FORM(paper_form::torsion(piece))),
                  function_along(curve, 6, LOCUS_FORM(torsion_form(piece))), "14d / 6d-6"});
  };
  zeros("rational quartic", quartic);
  zeros("rational cubic", cubic);
  rows.back().printed += " [^none]";
  rows.push_back({"critical curvature in space", "rational cubic",
                  by_spans(cubic, LOCUS_FORM(brute_force::squared_curvature_slope(piece))), {},
                  function_along(cubic, 9, LOCUS_FORM(Curvature_forms<3>(piece).critical)), ""});
}

void ruled_rows(std::vector<Row>& rows, const char* name, const Curve_3& curve, bool rational)
{
  const auto here = [&](Ruled_kind kind) { return map_object([=] { return ruled_surface(kind, curve); }); };
  const auto add = [&](const char* object, const Object& brute, const Object& paper, Ruled_kind kind, const char* printed) {
    rows.push_back({object, name, brute, paper, here(kind), rational ? printed : ""});
  };
  add("tangent developable", by_spans(curve, LOCUS_FORM(brute_force::tangent_developable(piece)), 2),
      by_spans(curve, LOCUS_FORM(paper_form::tangent_developable(piece)), 2), Ruled_kind::tangent_developable, "3d / 2d-1");
  rows.push_back({"– by polar form", name, {}, {}, map_object([=] { return tangent_developable_by_polar_form(curve); }), ""});
  add("normal scroll", by_spans(curve, LOCUS_FORM(brute_force::normal_scroll(piece)), 2),
      by_spans(curve, LOCUS_FORM(paper_form::normal_scroll(piece)), 2), Ruled_kind::normal_scroll, "9d / 6d-4");
  add("binormal scroll", by_spans(curve, LOCUS_FORM(brute_force::binormal_scroll(piece)), 2),
      by_spans(curve, LOCUS_FORM(paper_form::binormal_scroll(piece)), 2), Ruled_kind::binormal_scroll, "7d / 4d-3");
  add("rectifying developable", by_spans(curve, LOCUS_FORM(brute_force::rectifying_developable(piece)), 2),
      by_spans(curve, LOCUS_FORM(paper_form::rectifying_developable(piece)), 2), Ruled_kind::rectifying_developable, "39d / 13d-8");
  add("polar developable", by_spans(curve, LOCUS_FORM(brute_force::polar_developable(piece)), 2),
      by_spans(curve, LOCUS_FORM(paper_form::polar_developable(piece)), 2), Ruled_kind::polar_developable, "no figure [^polar]");
  rows.push_back({"– in charts", name, {}, {}, chart_object([=] { return polar_developable_charts(curve, {}); }), ""});
}

void centre_rows(std::vector<Row>& rows, const char* name, const Curve_3& curve, bool rational)
{
  rows.push_back({"evolute in space", name, by_spans(curve, LOCUS_FORM(brute_force::evolute(piece))),
                  by_spans(curve, LOCUS_FORM(paper_form::evolute(piece))),
                  map_object([=] { return evolute_map(curve); }), rational ? "no figure [^evolute]" : ""});
  rows.push_back({"focal curve", name, {}, {}, map_object([=] { return focal_curve_map(curve); }), "\"not rational\" [^focal]"});
}

void point_curve_rows(std::vector<Row>& rows)
{
  const Curve_3 helix = helix_like();
  const Exact_point<3> at = gray_point();
  const auto brute = [at](const auto& piece) { return brute_force::point_curve_bisector(piece, at); };
  const auto reduced = [at](const auto& piece) { return paper_form::point_curve_bisector(piece, at); };
  const auto direct = [at](const auto& piece) { return paper_form::point_curve_bisector_direct(piece, at); };
  const char* name = "helix-like quadratic, 4 spans";
  rows.push_back({"point/curve bisector by its directrix", name, by_spans(helix, brute, 2), by_spans(helix, reduced, 2),
                  map_object([=] { return point_curve_bisector_by_directrix(at, helix); }), "17d / 10d-3, 17 in Fig. 4"});
  rows.push_back({"– directly", name, {}, by_spans(helix, direct, 2),
                  chart_object([=] { return point_curve_bisector_charts(at, helix, {}); }), "4d-1, 7 in Fig. 4"});
}

void curve_curve_rows(std::vector<Row>& rows)
{
  using Piece_form = Curve_piece<3>;
  const auto brute = [](const Piece_form& a, const Held_foot& b) { return brute_force::curve_curve_bisector(a, b); };
  const auto by_terms = [](const Piece_form& a, const Held_foot& b) { return brute_force::curve_curve_bisector_term_by_term(a, b); };
  const auto reduced = [](const Piece_form& a, const Held_foot& b) { return paper_form::curve_curve_bisector(a, b); };
  const auto add = [&](const char* name, int degree, bool rational, const char* printed) {
    const Curve_3 a = space_curve(degree, rational), b = other_space_curve(degree, rational);
    rows.push_back({"curve/curve bisector", name, by_sections(a, b, brute), by_sections(a, b, reduced),
                    map_object([=] { return curve_curve_bisector_map(a, b); }), printed});
    if (rational) rows.push_back({"– terms added as they come", name, by_sections(a, b, by_terms), {}, {}, "a determinant 8d-3 [^pairs]"});
  };
  add("two rational quadratics", 2, true, "6d-2 [^pairs] / 4d-1");
  add("two polynomial cubics", 3, false, "3d-1");
}

void surface_rows(std::vector<Row>& rows)
{
  for (const bool rational : {false, true})
    rows.push_back({"point/surface bisector", rational ? "rational biquadratic" : "polynomial biquadratic", {}, {}, map_object([=] {
                      return point_surface_bisector_map({Rational(1), Rational(2), Rational(9)}, biquadratic(rational));
                    }), "–"});
}

std::vector<Row> all_rows()
{
  std::vector<Row> rows;
  plane_rows(rows);
  scalar_rows_in_space(rows);
  for (const bool rational : {true, false}) {
    const char* name = rational ? "rational cubic" : "polynomial cubic";
    ruled_rows(rows, name, space_curve(3, rational), rational);
    centre_rows(rows, name, space_curve(3, rational), rational);
  }
  point_curve_rows(rows);
  curve_curve_rows(rows);
  surface_rows(rows);
  return rows;
}

// ------------------------------------------------------------------------------------------- formulas of degrees

/// A degree that the paper states for all d, as a function, next to the same object's measured ones.
struct Statement {
  const char *object, *formula;
  std::array<int, 3> stated, measured;
};

template <class Curve, class Stated, class Make>
void state(std::vector<Statement>& all, const char* object, const char* formula, bool rational, Curve curve, Stated stated, Make make)
{
  Statement s{object, formula, {}, {}};
  for (int d = 2; d <= 4; ++d) {
    const auto i = static_cast<std::size_t>(d - 2);
    s.stated[i] = stated(d);
    s.measured[i] = formal_degree(make(curve(d, rational).pieces()[0]));
  }
  all.push_back(s);
}

// The formula is quoted once and gives both text and function.
#define LOCUS_STATE(object, formula, rational, curve, expression) \
  state(all, object, #formula, rational, curve, [](int d) { return formula; }, LOCUS_FORM(expression))

void plane_statements(std::vector<Statement>& all)
{
  LOCUS_STATE("inflections, polynomial", 2*d - 3, false, plane_curve, brute_force::inflections(piece));
  LOCUS_STATE("inflections, brute force", 6*d, true, plane_curve, brute_force::inflections(piece));
  LOCUS_STATE("inflections, paper", 3*d - 3, true, plane_curve, paper_form::inflections(piece));
  LOCUS_STATE("κ², polynomial", 6*d - 6, false, plane_curve, brute_force::squared_curvature(piece));
  LOCUS_STATE("κ²", 24*d, true, plane_curve, brute_force::squared_curvature(piece));
  LOCUS_STATE("(κ²)', polynomial", 12*(d - 1), false, plane_curve, derivative(brute_force::squared_curvature(piece)));
  LOCUS_STATE("(κ²)'", 48*d, true, plane_curve, derivative(brute_force::squared_curvature(piece)));
  LOCUS_STATE("critical curvature (3.4), polynomial", 4*d - 6, false, plane_curve, brute_force::critical(piece));
  LOCUS_STATE("critical curvature (3.4)", 26*d, true, plane_curve, brute_force::critical(piece));
  LOCUS_STATE("critical curvature (3.5)", 9*d - 6, true, plane_curve, paper_form::critical(piece));
  LOCUS_STATE("evolute, polynomial", 3*d - 3, false, plane_curve, brute_force::evolute(piece));
  LOCUS_STATE("evolute, brute force", 13*d, true, plane_curve, brute_force::evolute(piece));
  LOCUS_STATE("evolute, paper", 6*d - 3, true, plane_curve, paper_form::evolute(piece));
}

void ruled_statements(std::vector<Statement>& all)
{
  LOCUS_STATE("torsion, brute force", 26*d, true, space_curve, brute_force::torsion(piece));
  LOCUS_STATE("torsion, paper", 8*d - 6, true, space_curve, paper_form::torsion_quotient(piece));
  LOCUS_STATE("torsion's zeros, brute force", 14*d, true, space_curve, brute_force::triple_product(piece));
  LOCUS_STATE("torsion's zeros, paper", 6*d - 6, true, space_curve, paper_form::torsion(piece));
  LOCUS_STATE("tangent developable, brute force", 3*d, true, space_curve, brute_force::tangent_developable(piece));
  LOCUS_STATE("tangent developable, paper", 2*d - 1, true, space_curve, paper_form::tangent_developable(piece));
  LOCUS_STATE("binormal scroll, brute force", 7*d, true, space_curve, brute_force::binormal_scroll(piece));
  LOCUS_STATE("binormal scroll, paper", 4*d - 3, true, space_curve, paper_form::binormal_scroll(piece));
  LOCUS_STATE("normal scroll, brute force", 9*d, true, space_curve, brute_force::normal_scroll(piece));
  LOCUS_STATE("normal scroll, paper", 6*d - 4, true, space_curve, paper_form::normal_scroll(piece));
  LOCUS_STATE("rectifying developable, brute force", 39*d, true, space_curve, brute_force::rectifying_developable(piece));
  LOCUS_STATE("rectifying developable, paper", 13*d - 8, true, space_curve, paper_form::rectifying_developable(piece));
}

/// On a curve of the same degree.
Held_foot foot_of(const Curve_piece<3>& piece)
{
  return {other_space_curve(piece.degree(), !piece.is_polynomial()).pieces()[0], Rational(1, 2)};
}

void bisector_statements(std::vector<Statement>& all)
{
  LOCUS_STATE("point/curve, brute force", 17*d, true, space_curve, brute_force::point_curve_bisector(piece, gray_point()));
  LOCUS_STATE("point/curve by its directrix, paper", 10*d - 3, true, space_curve, paper_form::point_curve_bisector(piece, gray_point()));
  LOCUS_STATE("point/curve directly, polynomial", 3*d - 1, false, space_curve, paper_form::point_curve_bisector_direct(piece, gray_point()));
  LOCUS_STATE("point/curve directly, paper", 4*d - 1, true, space_curve, paper_form::point_curve_bisector_direct(piece, gray_point()));
  LOCUS_STATE("curve/curve, polynomial", 3*d - 1, false, space_curve, brute_force::curve_curve_bisector(piece, foot_of(piece)));
  LOCUS_STATE("curve/curve, brute force", 6*d - 2, true, space_curve, brute_force::curve_curve_bisector(piece, foot_of(piece)));
  LOCUS_STATE("curve/curve, a determinant term by term", 8*d - 3, true, space_curve,
              brute_force::curve_curve_determinants_term_by_term(piece, foot_of(piece)));
  LOCUS_STATE("curve/curve, paper", 4*d - 1, true, space_curve, paper_form::curve_curve_bisector(piece, foot_of(piece)));
}

// ------------------------------------------------------------------------------------------------------ printing

std::string text_of(double x, const char* format)
{
  char text[64];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

/// Microseconds to about three figures.
std::string time_text(double seconds)
{
  const double us = seconds * 1e6;
  return text_of(us, us < 10 ? "%.1f" : "%.0f");
}

std::string entry(const Object& object, double seconds)
{
  if (!object.build) return "– | ";
  return std::to_string(object.size.degree) + " (" + std::to_string(object.size.points) + ") | " + time_text(seconds);
}

void print(const Row& row)
{
  std::array<double, 3> seconds{};
  std::vector<std::function<void()>> jobs;
  const std::array<const Object*, 3> objects{&row.brute, &row.paper, &row.here};
  for (const Object* o : objects)
    if (o->build) jobs.push_back(o->build);
  const auto timings = locus_benchmark::side_by_side(jobs, 7, 0.004);
  std::size_t n = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (objects[i]->build) seconds[i] = timings[n++].median;
  std::printf("| %s | %s | %s | %s | %s | %s |\n", row.object.c_str(), row.curve.c_str(), entry(row.brute, seconds[0]).c_str(),
              entry(row.paper, seconds[1]).c_str(), entry(row.here, seconds[2]).c_str(), row.printed.c_str());
}

void print_objects()
{
  std::puts(R"(# Degrees

Each object of Chen, Riesenfeld & Cohen, *Degree Reduction for NURBS Symbolic Computation on Curves*, is built in three ways:
by brute force, where every product, sum and derivative multiplies out and nothing cancels; in the paper's own reduced form; and
by this library, with the common factors that always occur left out beforehand and any other divided out.
Degrees are those along the curve: ruled surfaces have degree 1 along their rulings, curve/curve bisectors the same degree in both
parameters. In brackets is the number of control points, in the first two ways degree + 1 for each span, since the paper's
representation is C⁻¹ at knots, and twice that for a ruled surface. Here it is that of the B-spline with the least knots that the
exact continuity allows, the same ones for numerators and weight, times as many as the other degree asks.
All that is measured on the objects but for the last column, which quotes the paper (brute force / reduced, d being the curve's
degree); times are medians, of one machine, to build all spans in exact numbers, and include the search for common factors and
least degrees here, which the other two ways do without.
Regenerate with `build/bin/degree_table > doc/degrees.md`.

| object | curve | brute force | µs | the paper | µs | here | µs | printed in the paper |
|---|---|---|---|---|---|---|---|---|)");
  for (const Row& row : all_rows()) print(row);
  std::puts(R"(
Sections of a curve/curve bisector are built at one parameter of the second curve after the other in the first two ways; the time
is that of as many as determine the surface.

[^ellipse]: In general 8d-12 = 4. Each span runs from vertex to vertex and has another one at its parameter's infinity.
[^fig1]: The paper's curve is not given. 150 is that of six spans of degree 24; six of degree 6 have 42 without continuity, so its
    24 must be counted in another way.
[^none]: Of degree 0: a rational cubic's torsion has no zero unless it vanishes everywhere. The paper's form has w² in it, and
    leading terms that cancel.
[^polar]: The paper says "significantly reduced" and leaves a sum of three terms. It is brought here over the least denominator
    that the terms' own have in common; added up by the rules it would be of higher degree.
[^evolute]: (4.4) and its first terms in the form below (4.9) are taken.
[^focal]: With the derivative of 1/κ by arc length it is rational for any curve (8d-12, 4d-7 for a polynomial one); the paper's
    proof takes the derivative by the curve's parameter. See `focal_curve_map`.
[^pairs]: These do not come out. (5.3) counts d-1 for x' of a rational curve too, where (5.11) and the rest of the paper have 2d.
    With that the bisector has degree 8d, and a determinant whose terms are added as they come 11d, the bisector by it 14d.)");
}

void print_statements()
{
  std::vector<Statement> all;
  plane_statements(all);
  ruled_statements(all);
  bisector_statements(all);
  std::puts(R"(
## The paper's formulas

What the paper states for curves of degree d, rational where nothing else is said, against the formal degrees of the forms that
it describes, for d = 2, 3, 4.

| object | stated | d = 2, 3, 4 | measured | |
|---|---|---|---|---|)");
  const auto list = [](const std::array<int, 3>& a) {
    return std::to_string(a[0]) + ", " + std::to_string(a[1]) + ", " + std::to_string(a[2]);
  };
  for (const Statement& s : all) {
    std::string formula;
    for (const char* c = s.formula; *c; ++c)
      if (*c != '*') formula += *c;
    std::printf("| %s | %s | %s | %s | %s |\n", s.object, formula.c_str(), list(s.stated).c_str(), list(s.measured).c_str(),
                s.stated == s.measured ? "agrees" : "**differs** [^pairs]");
  }
}

void print_family(const char* title, Conditioning_row (*make)(int))
{
  std::vector<Conditioning_row> rows;
  for (int exponent = 4; exponent <= 20; exponent += 4) rows.push_back(make(exponent));
  const auto& first = rows.front();
  std::printf("\n%s. Degrees: %d by brute force, %d with the denominator kept, %d in the paper's form, %d here.\n\n", title,
              first.brute.degree, first.kept.degree, first.paper.degree, first.here.degree);
  std::puts("| ε | condition: brute | kept | paper | here | error: brute | kept | paper | here | by residual: kept | paper | here |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const auto& r : rows) {
    std::printf("| 2^-%d |", r.exponent);
    for (const double x : {r.brute.condition, r.kept.condition, r.paper.condition, r.here.condition, r.brute.error, r.kept.error,
                           r.paper.error, r.here.error, r.kept.residual, r.paper.residual, r.here.residual})
      std::printf(" %.1e |", x);
    std::puts("");
  }
  const auto growth = [&](Root_measures Conditioning_row::*form) {
    const auto &a = rows[rows.size() - 2], &b = rows.back(); // by the last step in ε
    return text_of(-std::log2((b.*form).condition / (a.*form).condition) / (b.exponent - a.exponent), "%.1f");
  };
  std::printf("\nThe condition grows like ε to the power %s (brute force), %s (kept), %s (paper), %s (here).\n",
              growth(&Conditioning_row::brute).c_str(), growth(&Conditioning_row::kept).c_str(), growth(&Conditioning_row::paper).c_str(),
              growth(&Conditioning_row::here).c_str());
}

void print_conditioning()
{
  std::puts(R"(
## Discarding the denominator

The paper (§6) suspects that a root becomes ill-conditioned where both the numerator and the discarded denominator come close to
zero. Measured on critical curvature, on three families of curves that approach such a case as ε does:

At a root a denominator cancels from the condition number, Σ|c_k|·B_k(u)/|f'(u)|, as both the value's error and the slope are
divided by it: discarding it cannot make the root worse. What makes it worse is the opposite, small powers that are left in the
numerator. Near a cusp the condition of the brute-force form grows like ε⁻⁶, near a pole about like ε⁻³⁴; that of the reduced form
grows like ε⁻¹. The factor w that is left in the paper's (3.5) costs another ε⁻¹ near a pole, and the w⁴ of dκ/ds itself four.
Where only a first weight is small no form's condition suffers.
The suspicion is right for a search that stops by residual: near a cusp with ε = 2⁻²⁰, |f| ≤ 2⁻⁴⁰·max|f| is met within 2.2·10⁻¹⁹
of the root with the denominator, but only within 2.5·10⁻⁶ without it. So a reduced form must be solved by changes of sign or by
isolating its roots, as it is here; then nothing is lost.

"kept" is dκ/ds = critical·w⁴/S³ with its denominator, whose numerator the condition is taken of; "error" is that of bisection in
doubles, "by residual" the distance from the root at which the residual's bound is met.)");
  print_family("Polynomial cubics near a cusp, with least speed ε", locus_benchmark::conditioning_near_cusp);
  print_family("Rational quadratics near a pole, with least weight ε", locus_benchmark::conditioning_near_pole);
  print_family("Rational quadratics with first weight ε, next to the root", locus_benchmark::conditioning_at_small_weight);
}

} // namespace

int main()
{
  print_objects();
  print_statements();
  print_conditioning();
}
