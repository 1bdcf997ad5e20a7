// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_JOB_H
#define LOCUS_IO_JSON_JOB_H

#include <locus/io/json_surface.h>

#include <algorithm>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus {

struct Job_options {
  bool trimmed = true;
  bool beyond_ends = false; ///< of a point and a curve: the nearest point of the continued curve must lie on the curve itself
  Rational tolerance = Rational(1, 1000000); ///< positive
  bool has_tolerance = false;                ///< it was given; else surfaces may be drawn more coarsely
  Rational join_tolerance = 0;               ///< not negative
};

/// A valid job: everything in it obeys the format, whether this version can do it or not.
struct Job {
  std::string compute;
  std::vector<Job_input> inputs;
  std::optional<Rational> alpha;
  Job_options options;
};

namespace detail {

inline Job_input read_input(const Json_value& v, const std::string& place, Dimension& dimension)
{
  Job_input input;
  input.place = place;
  require_object(v, place, {"point", "curve", "surface"}, "{\"curve\": {…}} or {\"point\": [x, y]}");
  if (v.keys.size() != 1)
    throw Invalid_input(place,
                        v.keys.empty() ? "an input must say what it is"
                                       : "an input is one thing, not " + std::to_string(v.keys.size()),
                        "give one of \"point\", \"curve\" and \"surface\"");
  const std::string inner = member(place, v.keys[0]);
  if (v.keys[0] == "curve") {
    read_curve(v.items[0], inner, dimension, input);
  } else if (v.keys[0] == "surface") {
    read_surface(v.items[0], inner, dimension, input);
  } else {
    input.kind = Job_input::Kind::point;
    input.point = read_point(v.items[0], inner, dimension);
    input.dimension = dimension.value;
  }
  return input;
}

inline Job_options read_options(const Json_value& v)
{
  Job_options options;
  require_object(v, "options", {"trimmed", "beyond_ends", "tolerance", "join_tolerance"}, "{\"trimmed\": false, \"tolerance\": 1e-6}");
  if (const Json_value* x = v.find("trimmed")) options.trimmed = read_bool(*x, "options.trimmed");
  if (const Json_value* x = v.find("beyond_ends")) options.beyond_ends = read_bool(*x, "options.beyond_ends");
  if (const Json_value* x = v.find("tolerance")) {
    options.has_tolerance = true;
    options.tolerance = read_number(*x, "options.tolerance");
    if (options.tolerance <= 0)
      throw Invalid_input("options.tolerance", "the tolerance must be positive, not " + printable(x->text, 40),
                          "use a small part of the inputs' diameter, like 1e-6");
  }
  if (const Json_value* x = v.find("join_tolerance")) {
    options.join_tolerance = read_number(*x, "options.join_tolerance");
    if (options.join_tolerance < 0)
      throw Invalid_input("options.join_tolerance",
                          "an angle that joins forgive must not be negative, not " + printable(x->text, 40),
                          "use 0 or a small angle");
  }
  return options;
}

/// Do the inputs suit the construction? Their kinds and number, that is.
inline void require_inputs_for(const std::string& compute, const std::vector<Job_input>& inputs)
{
  using Kind = Job_input::Kind;
  const std::size_t n = inputs.size();
  const auto number = std::to_string(n) + (n == 1 ? " input" : " inputs");
  if (compute == "bisector" || compute == "alpha_sector" || compute == "envelope") {
    const bool one_curve = n == 1 && compute == "bisector";
    if (n != 2 && !one_curve)
      throw Invalid_input("inputs", number + " for \"" + compute + "\"",
                          compute == "bisector" ? "give two, or one curve for its self-bisector" : "give two");
    if (one_curve && inputs[0].kind != Kind::curve)
      throw Invalid_input("inputs[0]", "a self-bisector is that of a curve", "give one curve, or two inputs");
    if (compute == "envelope" && (inputs[0].kind == Kind::point || inputs[0].kind != inputs[1].kind))
      throw Invalid_input("inputs", "an envelope is that of two curves or of two surfaces", "give two of one kind");
  } else if (compute == "curvature" || compute == "evolute") {
    if (n != 1) throw Invalid_input("inputs", number + " for \"" + compute + "\"", "give one curve");
    if (inputs[0].kind != Kind::curve)
      throw Invalid_input("inputs[0]", "\"" + compute + "\" takes a curve", "give one curve");
  }
}

} // namespace detail

/// Reads a job. Throws Invalid_input, which names the place, the rule and the remedy, where it breaks a rule.
inline Job read_job(std::string_view text)
{
  using namespace detail;
  const Json_value v = parse_json(text);
  const std::string example = "{\"compute\": \"bisector\", \"inputs\": [...]}";
  if (v.kind != Json_value::Kind::object) wrong_type(v, "job", "an object", "write " + example);
  Job job;
  const Json_value& compute = require_key(v, "", "compute", "say what to compute, like \"compute\": \"bisector\"");
  const Words known = {"bisector", "alpha_sector", "envelope", "silhouette", "sweep", "curvature", "evolute"};
  if (compute.kind != Json_value::Kind::string)
    wrong_type(compute, "compute", "a string", "say what to compute, like \"bisector\"");
  if (std::find(known.begin(), known.end(), compute.text) == known.end())
    throw Invalid_input("compute", "unknown construction \"" + printable(compute.text) + "\"",
                        suggestion(compute.text, known));
  job.compute = compute.text;

  // Silhouettes and sweeps come with keys of their own, which this version does not know.
  const bool own_keys = job.compute == "silhouette" || job.compute == "sweep";
  if (!own_keys) {
    Words keys = {"compute", "inputs", "options"};
    if (job.compute == "alpha_sector") keys.push_back("alpha");
    require_object(v, "", keys, example);
  }
  if (job.compute == "alpha_sector") {
    const std::string remedy = "give \"alpha\": the distances are in the ratio alpha : 1 - alpha, like \"1/3\"";
    const Json_value& alpha = require_key(v, "", "alpha", remedy);
    job.alpha = read_number(alpha, "alpha");
    if (*job.alpha <= 0 || *job.alpha >= 1)
      throw Invalid_input("alpha", "must lie between 0 and 1, not " + printable(alpha.text, 40),
                          "use a number like \"1/3\"");
  }
  if (const Json_value* inputs = v.find("inputs")) {
    Dimension dimension;
    for (const Json_value& item :
         require_list(*inputs, "inputs", "list the inputs, like [{\"curve\": {…}}, {\"curve\": {…}}]"))
      job.inputs.push_back(read_input(item, element("inputs", job.inputs.size()), dimension));
  } else if (!own_keys) {
    throw Invalid_input("", "the key \"inputs\" is missing",
                        "list the inputs, like \"inputs\": [{\"curve\": {…}}, {\"curve\": {…}}]");
  }
  require_inputs_for(job.compute, job.inputs);
  if (const Json_value* options = v.find("options")) job.options = read_options(*options);
  if (job.options.join_tolerance > 0)
    for (Job_input& input : job.inputs) {
      if (input.curve) input.curve = with_join_tolerance(*input.curve, job.options.join_tolerance);
      if (input.space_curve) input.space_curve = with_join_tolerance(*input.space_curve, job.options.join_tolerance);
    }
  return job;
}

inline Job read_job(std::istream& in) { return read_job(read_json_text(in)); }

namespace detail {

[[noreturn]] inline void refuse(const std::string& place, const std::string& feature)
{
  throw Unsupported_feature(place + ": " + feature);
}

inline void refuse_trimmed(const Job& job)
{
  if (job.options.trimmed)
    refuse("options.trimmed", "trimmed bisectors (give \"trimmed\": false for all solutions of the equations)");
}

inline void require_supported_in_plane(const Job& job)
{
  const auto is_point = [](const Job_input& input) { return input.kind == Job_input::Kind::point; };
  const auto points = std::count_if(job.inputs.begin(), job.inputs.end(), is_point);
  if (points == 0 && job.options.beyond_ends) refuse("options.beyond_ends", "bisectors of curves that are continued beyond their ends");
}

/// In space this version has the bisectors that are rational: of a point with anything, and of two curves.
inline void require_supported_in_space(const Job& job)
{
  using Kind = Job_input::Kind;
  const Job_input& first = job.inputs[0];
  if (job.inputs.size() == 1) refuse(first.place, "self-bisectors of curves in space");
  const auto count = [&](Kind kind) {
    return std::count_if(job.inputs.begin(), job.inputs.end(), [&](const Job_input& input) { return input.kind == kind; });
  };
  if (count(Kind::surface) == 2) refuse(first.place, "bisectors of two surfaces");
  if (count(Kind::surface) == 1 && count(Kind::curve) == 1)
    refuse(first.place, "bisectors of a curve in space and a surface");
  // Of two points the whole plane between them is nearest: there is nothing to trim.
  if (count(Kind::point) < 2) refuse_trimmed(job);
}

} // namespace detail

/// Throws Unsupported_feature, naming where and what, if the job asks for something that this version does not have.
/// What it has: in the plane bisectors of one or two curves and of a point with a curve or a point, trimmed or not; in space
/// untrimmed ones of a point with anything or of two curves, and of two points, where that is the same; curvature and evolute of
/// a curve, planar or not.
inline void require_supported(const Job& job)
{
  const bool bisector = job.compute == "bisector";
  if (!bisector && job.compute != "curvature" && job.compute != "evolute")
    detail::refuse("compute", "\"" + job.compute + "\"");
  for (const Job_input& input : job.inputs)
    if (!input.missing.empty()) detail::refuse(input.place, input.missing);
  if (!bisector) return;
  if (job.inputs[0].dimension == 2) detail::require_supported_in_plane(job);
  else detail::require_supported_in_space(job);
}

} // namespace locus

#endif
