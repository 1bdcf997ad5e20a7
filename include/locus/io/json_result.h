// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_RESULT_H
#define LOCUS_IO_JSON_RESULT_H

#include <locus/io/json_rational.h>
#include <locus/io/json_writer.h>
#include <locus/io/picked_parameter.h>
#include <locus/shape/rational_curve.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace locus {

namespace detail {

inline void write_foot(Json_writer& json, const Foot& foot)
{
  json.open('{').key("input").value(foot.input).key("feature").value(name_of(foot.feature));
  json.key("parameters").list(foot.parameters).close('}');
}

template <int Dim>
void write_vertex(Json_writer& json, const Locus_vertex<Dim>& v)
{
  json.open('{').key("kind").value(name_of(v.kind)).key("feet").open('[');
  for (const Foot& foot : v.feet) write_foot(json, foot);
  json.close(']');
  if (v.point) json.key("point").value(*v.point).key("radius").value(v.radius);
  if (v.direction) json.key("direction").value(*v.direction);
  if (v.asymptote)
    json.key("asymptote")
      .open('{')
      .key("point")
      .value(v.asymptote->point)
      .key("direction")
      .value(v.asymptote->direction)
      .close('}');
  if (v.multiplicity > 1) json.key("multiplicity").value(v.multiplicity);
  if (!v.half_branches.empty()) {
    json.key("half_branches").open('[');
    for (const Half_branch& h : v.half_branches)
      json.open('{').key("arc").value(h.arc).key("at").value(h.at_start ? "source" : "target").close('}');
    json.close(']');
  }
  json.close('}');
}

/// A value of each range. Of a self-bisector the first is not less than the second, also where rounding might have it so.
inline std::vector<double> picked_parameters(const std::vector<Range>& ranges, bool is_self)
{
  std::vector<double> values;
  for (const Range& r : ranges) values.push_back(picked(r));
  if (is_self && values[0] < values[1] && ranges[1].lo <= ranges[0].hi)
    values[0] = values[1] = std::max(ranges[0].lo, ranges[1].lo);
  return values;
}

template <int Dim>
void write_arc_point(Json_writer& json, const Arc_point<Dim>& p, bool is_self)
{
  json.open('{').key("parameters").list(picked_parameters(p.parameters(), is_self));
  json.key("point").value(p.point()).key("radius").value(p.radius()).close('}');
}

template <int Dim>
void write_arc(Json_writer& json, const Arc<Dim>& arc, const Polyline<Dim>& polyline, double largest_point_error)
{
  json.open('{');
  if (!arc.is_closed()) json.key("source").value(*arc.source()).key("target").value(*arc.target());
  json.key("closed").value(arc.is_closed());
  json.key("inputs").list(arc.inputs());
  json.key("features").open('[');
  for (const Feature f : arc.features()) json.value(name_of(f));
  json.close(']');
  json.key("error");
  if (std::isfinite(polyline.error())) json.value(polyline.error());
  else json.null();
  const bool is_self = arc.inputs().size() == 2 && arc.inputs()[0] == arc.inputs()[1];
  const Irregular_points<Dim> irregular = arc.irregular();
  json.key("irregular").open('[');
  for (const Arc_point<Dim>& p : irregular.points) write_arc_point(json, p, is_self);
  json.close(']');
  if (!irregular.complete) json.key("irregular_complete").value(false);
  json.key("samples").open('[');
  // Without a bound for the whole, only points that are good by themselves are given.
  const double limit = std::isfinite(polyline.error()) ? polyline.error() : largest_point_error;
  for (const Arc_point<Dim>& p : polyline)
    if (p.error() <= limit) write_arc_point(json.line(6), p, is_self);
  json.close(']').close('}');
}

inline void write_statistics(Json_writer& json, const Locus_statistics& s)
{
  std::uint64_t calls = 0, failures = 0;
  for (std::size_t i = 0; i < s.filter.calls.size(); ++i) {
    calls += s.filter.calls[i];
    failures += s.filter.failures[i];
  }
  json.open('{').key("cells").value(s.cells).key("filter_calls").value(calls).key("filter_failures").value(failures);
  json.key("exact_cells").value(s.exact_cells).key("seconds").value(s.seconds).key("rungs").open('{');
  constexpr const char* names[] = {"bounded", "interval", "exact"};
  for (std::size_t i = 0; i < s.filter.calls.size(); ++i)
    json.key(names[i])
      .open('{')
      .key("calls")
      .value(s.filter.calls[i])
      .key("failures")
      .value(s.filter.failures[i])
      .close('}');
  json.close('}').close('}');
}

/// Where an arc could not be drawn with a proved error, the ranges of its parameters, with the reason.
template <int Dim>
Undecided_piece undrawn(const Polyline<Dim>& polyline)
{
  Undecided_piece piece;
  for (const Arc_point<Dim>& p : polyline)
    for (std::size_t k = 0; k < p.parameters().size(); ++k) {
      if (piece.box.size() <= k) piece.box.push_back(p.parameters()[k]);
      piece.box[k].lo = std::min(piece.box[k].lo, p.parameters()[k].lo);
      piece.box[k].hi = std::max(piece.box[k].hi, p.parameters()[k].hi);
    }
  piece.reason = "the arc passes a point where its position in the plane is 0/0: no error is proved for its samples";
  return piece;
}

/// A joint of an input that turns, by less than the user's tolerance.
struct Tolerated_joint {
  std::size_t input = 0;
  double parameter = 0;
};

/// The value at which two pieces of a chain meet; that of the seam is where the chain ends.
inline double parameter_of_joint(const Chain& chain, std::size_t joint)
{
  const Piece& before = chain.pieces[joint];
  return before.hi_infinite ? std::numeric_limits<double>::infinity() : nearest_double(before.hi);
}

template <int Dim>
std::vector<Tolerated_joint> tolerated_joints(const std::vector<Rational_curve<Dim>>& inputs)
{
  std::vector<Tolerated_joint> found;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Chain& chain = inputs[i].chain();
    for (std::size_t k = 0; k < chain.joints.size(); ++k)
      if (chain.joints[k].by_tolerance) found.push_back({i, parameter_of_joint(chain, k)});
  }
  return found;
}

template <int Dim>
void write_tolerated_joints(Json_writer& json, const std::vector<Rational_curve<Dim>>& inputs)
{
  write_lines(json, "joined_by_tolerance", tolerated_joints(inputs), [](Json_writer& j, const Tolerated_joint& t) {
    j.open('{').key("input").value(t.input).key("parameter").value(t.parameter).close('}');
  });
}

inline void write_degenerate(Json_writer& json, const Degenerate_piece& d)
{
  json.open('{').key("kind").value(d.kind);
  if (d.input) json.key("input").value(*d.input);
  if (d.parameter) json.key("parameter").value(*d.parameter);
  json.key("box").list(d.box);
  if (d.multiplicity > 1) json.key("multiplicity").value(d.multiplicity);
  json.key("reason").value(d.reason).close('}');
}

} // namespace detail

/// Writes a result as JSON; the keys are listed in doc/. Each arc is written as the polyline `arc.polyline(tolerance)`
/// with the error that this reaches. Doubles are written so that they read back as the same doubles. `progress`, if
/// given, is called with the numbers of arcs done and to come. `inputs`, if given, are the curves it was computed from:
/// their joints that were taken as smooth by tolerance are listed. Returns the status that was written: undecided also where
/// an arc's error has no proved bound, which is then written as null.
template <int Dim>
Status write_json(std::ostream& out, const Locus<Dim>& locus, double tolerance = 1e-6,
                  const std::function<void(std::size_t done, std::size_t open)>& progress = {},
                  const std::vector<Rational_curve<Dim>>& inputs = {})
{
  using detail::Json_writer;
  std::vector<Polyline<Dim>> polylines;
  std::vector<Undecided_piece> undecided = locus.undecided();
  for (const Arc<Dim>& arc : locus.arcs()) {
    if (progress) progress(polylines.size(), locus.arcs().size() - polylines.size());
    polylines.push_back(arc.polyline(tolerance));
    if (!std::isfinite(polylines.back().error())) undecided.push_back(detail::undrawn(polylines.back()));
  }
  const Status status = undecided.empty() ? Status::certified : Status::undecided;
  Json_writer json(out);
  json.open('{').line(2).key("compute").value(locus.compute()).line(2).key("trimmed").value(locus.is_trimmed());
  json.line(2).key("status").value(status == Status::certified ? "certified" : "undecided");
  json.line(2).key("tolerance").value(tolerance).line(2).key("scale").value(locus.scale());
  json.line(2).key("cut_radius").value(locus.cut_radius()).line(2).key("centre").value(locus.centre());
  json.line(2).key("components").value(locus.components());
  detail::write_lines(json, "equations", locus.equations(), [](Json_writer& j, const Equation_info& e) {
    j.open('{').key("name").value(e.name).key("degrees").list(e.degrees).close('}');
  });
  detail::write_lines(json, "vertices", locus.vertices(),
                      [](Json_writer& j, const Locus_vertex<Dim>& v) { detail::write_vertex(j, v); });
  std::size_t next = 0;
  detail::write_lines(json, "arcs", locus.arcs(), [&](Json_writer& j, const Arc<Dim>& a) {
    detail::write_arc(j, a, polylines[next++], 1e-10 * locus.scale());
  });
  detail::write_surface(json, locus);
  detail::write_lines(json, "regions", locus.regions(), [](Json_writer& j, const Region& r) {
    j.open('{').key("arcs").list(r.arcs).key("reason").value(r.reason).close('}');
  });
  detail::write_lines(json, "degenerate", locus.degenerate(), detail::write_degenerate);
  detail::write_tolerated_joints(json, inputs);
  detail::write_lines(json, "undecided", undecided, [](Json_writer& j, const Undecided_piece& u) {
    j.open('{').key("box").list(u.box).key("reason").value(u.reason).close('}');
  });
  json.line(2).key("statistics");
  detail::write_statistics(json, locus.statistics());
  json.finish();
  return status;
}

} // namespace locus

#endif
