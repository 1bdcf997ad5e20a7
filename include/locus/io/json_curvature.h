// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_CURVATURE_H
#define LOCUS_IO_JSON_CURVATURE_H

#include <locus/construct/curvature_points.h>
#include <locus/io/json_result.h>

namespace locus {

namespace detail {

/// "maximum", "minimum" of the curvature, with its sign in the plane; or nothing.
template <int Dim>
const char* extremum_of(const Curvature_point<Dim>& p)
{
  if (p.kind != Curvature_event::extremum && p.kind != Curvature_event::kink && p.kind != Curvature_event::jump) return nullptr;
  return p.is_maximum() ? "maximum" : p.is_minimum() ? "minimum" : nullptr;
}

template <int Dim>
void write_curvature_point(Json_writer& json, const Curvature_point<Dim>& p)
{
  json.open('{').key("kind").value(name_of(p.kind));
  if (const char* extremum = extremum_of(p)) json.key("extremum").value(extremum);
  json.key("feet").open('[');
  write_foot(json, {0, p.feature, {p.parameter}});
  json.close(']').key("point").value(p.point).key("error").value(p.error);
  json.key("multiplicity").value(p.multiplicity).key("changes_sign").value(p.changes_sign());
  if (p.kind != Curvature_event::cusp) json.key("curvature").value(p.curvature);
  if (p.torsion) json.key("torsion").value(*p.torsion);
  if (p.centre) json.key("centre").value(*p.centre).key("centre_error").value(p.centre_error).key("radius").value(p.radius);
  json.close('}');
}

} // namespace detail

/// Writes the points of a curve's curvature as JSON; the keys are listed in doc/. Joints of `inputs` that were taken as smooth
/// by tolerance are listed.
template <int Dim>
void write_json(std::ostream& out, const Curvature_analysis<Dim>& analysis, const std::vector<Rational_curve<Dim>>& inputs = {})
{
  using detail::Json_writer;
  Json_writer json(out);
  json.open('{').line(2).key("compute").value("curvature").line(2).key("status").value("certified");
  json.line(2).key("scale").value(analysis.scale);
  detail::write_lines(json, "equations", analysis.equations, [](Json_writer& j, const Equation_info& e) {
    j.open('{').key("name").value(e.name).key("degrees").list(e.degrees).close('}');
  });
  detail::write_lines(json, "vertices", analysis.points, [](Json_writer& j, const Curvature_point<Dim>& p) { detail::write_curvature_point(j, p); });
  detail::write_lines(json, "degenerate", analysis.degenerate, detail::write_degenerate);
  detail::write_tolerated_joints(json, inputs);
  json.line(2).key("undecided").open('[').close(']');
  json.line(2).key("statistics").open('{').key("seconds").value(analysis.seconds).close('}');
  json.finish();
}

} // namespace locus

#endif
