// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_JOB_H
#define LOCUS_IO_JSON_JOB_H

#include <locus/io/json_text.h>
#include <locus/shape/invalid_input.h>
#include <locus/shape/monomial_curve.h>
#include <locus/shape/spline_curve.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <initializer_list>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace locus {

/// Greatest degree of a curve that this version takes. The equation's size grows with its square, the exact work faster.
inline constexpr int max_curve_degree = 40;

/// One input of a job, valid by the rules of the job format.
struct Job_input {
  enum class Kind : unsigned char { point, curve, surface };

  Kind kind = Kind::curve;
  int dimension = 2;
  std::string place;            ///< "inputs[1]"
  std::optional<Curve_2> curve; ///< a planar curve, its joints by the job's tolerance
  std::string missing;          ///< otherwise: what this version would need for it
};

struct Job_options {
  bool trimmed = true;
  Rational tolerance = Rational(1, 1000000); ///< positive
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

// ------------------------------------------------------------------------------------------------ reading of values

inline std::string lower_case(std::string_view s)
{
  std::string out(s);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Number of edits between two words (Levenshtein).
inline std::size_t edit_distance(std::string_view a, std::string_view b)
{
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

using Words = std::vector<std::string_view>;

/// What to do about a word that is none of the known ones: the nearest of them, or all.
inline std::string suggestion(std::string_view word, const Words& known)
{
  constexpr std::size_t longest = 40;
  const std::string lower = lower_case(word.substr(0, longest));
  std::string_view best;
  std::size_t least = longest;
  for (const std::string_view k : known) {
    std::size_t d = edit_distance(lower, k);
    // The beginning of a word stands for the word: "tol", "knot_vector".
    if (lower.size() >= 3 && (k.substr(0, lower.size()) == lower || lower.substr(0, k.size()) == k)) d = 0;
    if (d < least) {
      least = d;
      best = k;
    }
  }
  if (!best.empty() && least <= std::max<std::size_t>(2, best.size() / 3))
    return "did you mean \"" + std::string(best) + "\"?";
  std::string all = "use ";
  for (std::size_t i = 0; i < known.size(); ++i)
    all += (i == 0 ? "" : i + 1 == known.size() ? " or " : ", ") + ("\"" + std::string(known[i]) + "\"");
  return all;
}

inline std::string member(const std::string& place, std::string_view key)
{
  return place.empty() ? std::string(key) : place + "." + std::string(key);
}
inline std::string element(const std::string& place, std::size_t i) { return place + "[" + std::to_string(i) + "]"; }

inline std::string shown(const Json_value& v)
{
  switch (v.kind) {
  case Json_value::Kind::boolean:
    return v.truth ? "true" : "false";
  case Json_value::Kind::number:
    return "the number " + printable(v.text, 40);
  case Json_value::Kind::string:
    return "the string \"" + printable(v.text, 40) + "\"";
  default:
    return name_of(v.kind);
  }
}

[[noreturn]] inline void wrong_type(const Json_value& v, const std::string& place, const std::string& wanted,
                                    const std::string& remedy)
{
  throw Invalid_input(place, "must be " + wanted + ", not " + shown(v), remedy);
}

/// Requires an object with no other keys than the known ones.
inline void require_object(const Json_value& v, const std::string& place, const Words& known,
                           const std::string& example)
{
  if (v.kind != Json_value::Kind::object) wrong_type(v, place, "an object", "write " + example);
  for (const std::string& key : v.keys)
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw Invalid_input(place, "unknown key \"" + printable(key) + "\"", suggestion(key, known));
}

inline const Json_value& require_key(const Json_value& v, const std::string& place, const char* key,
                                     const std::string& remedy)
{
  const Json_value* found = v.find(key);
  if (!found) throw Invalid_input(place, "the key \"" + std::string(key) + "\" is missing", remedy);
  return *found;
}

inline const std::vector<Json_value>& require_list(const Json_value& v, const std::string& place,
                                                   const std::string& remedy)
{
  if (v.kind != Json_value::Kind::array) wrong_type(v, place, "a list", remedy);
  return v.items;
}

inline bool read_bool(const Json_value& v, const std::string& place)
{
  if (v.kind != Json_value::Kind::boolean) wrong_type(v, place, "true or false", "write true or false, without quotes");
  return v.truth;
}

/// The exact value of a JSON number or of a string with a decimal or a fraction.
inline Rational read_number(const Json_value& v, const std::string& place)
{
  const std::string remedy = "write a finite decimal like -0.25e3 or a string like \"2/3\"";
  if (v.kind != Json_value::Kind::number && v.kind != Json_value::Kind::string)
    wrong_type(v, place, "a number", remedy);
  if (v.text.size() > max_json_number)
    throw Invalid_input(place, "a number of " + std::to_string(v.text.size()) + " characters",
                        "use at most " + std::to_string(max_json_number));
  try {
    return parse_rational(v.text);
  } catch (const std::invalid_argument& e) {
    std::string_view reason = e.what();
    if (const auto bracket = reason.find(" (write"); bracket != std::string_view::npos)
      reason = reason.substr(0, bracket);
    throw Invalid_input(place, printable(reason, 160), remedy);
  }
}

inline std::vector<Rational> read_numbers(const Json_value& v, const std::string& place)
{
  std::vector<Rational> out;
  for (const Json_value& item : require_list(v, place, "write a list of numbers, like [1, 0.5, \"2/3\"]"))
    out.push_back(read_number(item, element(place, out.size())));
  return out;
}

/// A whole number of at least `least`.
inline int read_degree(const Json_value& v, const std::string& place)
{
  const Rational x = read_number(v, place);
  if (x.get_den() != 1 || x < 1)
    throw Invalid_input(place, "the degree must be a whole number from 1 on, not " + printable(v.text, 40),
                        "use the number of control points less one for a Bézier curve");
  if (x > static_cast<int>(max_json_values))
    throw Invalid_input(place, "the degree " + printable(v.text, 40) + " needs more control points than a job can hold",
                        "lower it");
  return static_cast<int>(x.get_num().get_si());
}

/// Coordinates of a point. `dimension` is 0 until the first point of the job has set it, in `dimension_from`.
struct Dimension {
  int value = 0;
  std::string from;
};

inline std::vector<Rational> read_point(const Json_value& v, const std::string& place, Dimension& dimension)
{
  const auto& items = require_list(v, place, "write a point as [x, y] or [x, y, z]");
  if (items.size() != 2 && items.size() != 3)
    throw Invalid_input(place, "a point has 2 or 3 coordinates, not " + std::to_string(items.size()),
                        items.size() == 4 ? "write [x, y] or [x, y, z], and weights under \"weights\""
                                          : "write [x, y] or [x, y, z]");
  const int n = static_cast<int>(items.size());
  if (dimension.value == 0) dimension = {n, place};
  if (n != dimension.value)
    throw Invalid_input(
      place, std::to_string(n) + " coordinates, but " + dimension.from + " has " + std::to_string(dimension.value),
      "give all points of a job the same number of coordinates");
  return read_numbers(v, place);
}

// ----------------------------------------------------------------------------------------------------- B-splines

inline Knots read_knots(const Json_value& v, const std::string& place, int degree, std::size_t points, int inner_repeats)
{
  Knots knots{degree, read_numbers(v, place)};
  require_knots(knots, points, inner_repeats, place);
  return knots;
}

// -------------------------------------------------------------------------------------------------------- curves

/// What control points, weights and knots say, checked as far as their numbers go.
struct Control_data {
  int degree = 1;
  std::vector<std::vector<Rational>> points;
  std::vector<Rational> weights;
  std::optional<Knots> knots;
  bool closed = false;
};

template <int Dim>
Rational_curve<Dim> curve_of(const Control_data& data)
{
  std::vector<Exact_point<Dim>> points;
  for (const auto& p : data.points) {
    points.emplace_back();
    std::copy_n(p.begin(), Dim, points.back().begin());
  }
  if (data.knots) return bspline_curve<Dim>(data.degree, points, data.knots->values, data.weights, data.closed);
  const Rational_curve<Dim> bezier = bezier_curve<Dim>(points, data.weights);
  return split_at_cusps(data.closed ? joined_curve(bezier.pieces(), bezier.chain().pieces, true) : bezier);
}

/// What only later versions take is checked all the same. `make` is called with the dimension.
template <class Make>
void read_into(Job_input& input, const std::string& place, Make make)
{
  try {
    if (input.dimension == 2) {
      input.curve = make(std::integral_constant<int, 2>());
    } else {
      make(std::integral_constant<int, 3>());
      input.missing = "curves in space";
    }
  } catch (const Invalid_input& e) {
    throw e.within(place);
  } catch (const Unsupported_feature& e) {
    input.missing = e.what();
  }
}

inline void require_affordable(int degree, Job_input& input)
{
  if (degree > max_curve_degree) input.missing = "curves of degree above " + std::to_string(max_curve_degree);
}

inline void read_control_curve(const Json_value& v, const std::string& place, Dimension& dimension, Job_input& input)
{
  const int degree =
    read_degree(require_key(v, place, "degree", "give the degree, like \"degree\": 3"), member(place, "degree"));
  const std::string points_place = member(place, "control_points");
  const auto& list =
    require_list(require_key(v, place, "control_points", "list the control points, like [[0,0],[1,2]]"), points_place,
                 "list the control points, like [[0,0],[1,2]]");
  Control_data data;
  data.degree = degree;
  for (const Json_value& p : list)
    data.points.push_back(read_point(p, element(points_place, data.points.size()), dimension));
  const Json_value* knot_list = v.find("knots");
  const auto n = list.size(), order = static_cast<std::size_t>(degree) + 1;
  if (knot_list ? n < order : n != order)
    throw Invalid_input(points_place, std::to_string(n) + " control points for degree " + std::to_string(degree),
                        knot_list ? "give at least degree + 1 = " + std::to_string(order)
                                  : "give degree + 1 = " + std::to_string(order) + ", or knots for a B-spline");
  if (const Json_value* w = v.find("weights")) {
    data.weights = read_numbers(*w, member(place, "weights"));
    if (data.weights.size() != n)
      throw Invalid_input(member(place, "weights"),
                          std::to_string(data.weights.size()) + " weights for " + std::to_string(n) + " control points",
                          "give one weight for each control point, or none");
  }
  if (knot_list) data.knots = read_knots(*knot_list, member(place, "knots"), degree, n, degree + 1);
  const Json_value* closed = v.find("closed");
  data.closed = closed && read_bool(*closed, member(place, "closed"));

  input.dimension = dimension.value;
  require_affordable(degree, input);
  if (!input.missing.empty()) return;
  read_into(input, place, [&](auto dim) { return curve_of<decltype(dim)::value>(data); });
}

inline Parameter_domain read_domain(const Json_value& v, const std::string& place)
{
  const std::string domain_place = member(place, "domain");
  const std::string domain_remedy = "write \"domain\": [lo, hi], where \"-inf\" and \"inf\" are allowed";
  const auto& ends = require_list(require_key(v, place, "domain", domain_remedy), domain_place, domain_remedy);
  if (ends.size() != 2)
    throw Invalid_input(domain_place, std::to_string(ends.size()) + " numbers for an interval", domain_remedy);
  const auto is = [](const Json_value& x, const char* word) {
    return x.kind == Json_value::Kind::string && x.text == word;
  };
  Parameter_domain domain;
  if (!is(ends[0], "-inf")) domain.lo = read_number(ends[0], element(domain_place, 0));
  if (!is(ends[1], "inf")) domain.hi = read_number(ends[1], element(domain_place, 1));
  if (domain.lo && domain.hi && *domain.lo >= *domain.hi)
    throw Invalid_input(domain_place, "the interval is empty", "let the first number be less than the second");
  return domain;
}

/// Curve in monomial form on an interval of the line.
inline void read_monomial_curve(const Json_value& v, const std::string& place, Dimension& dimension, Job_input& input)
{
  for (const char* other : {"degree", "control_points", "weights", "knots"})
    if (v.find(other))
      throw Invalid_input(place, "\"monomial\" and \"" + std::string(other) + "\" exclude each other",
                          "describe the curve in one way");
  const std::string form_place = member(place, "monomial");
  const std::string example = "{\"x\": [a0, a1], \"y\": [b0, b1]}";
  const Json_value& form = *v.find("monomial");
  require_object(form, form_place, {"x", "y", "z", "w"}, example);
  std::vector<std::vector<Rational>> h;
  for (const char* axis : {"x", "y", "z"}) {
    if (axis[0] == 'z' && !form.find("z")) continue;
    h.push_back(read_numbers(require_key(form, form_place, axis, "write " + example), member(form_place, axis)));
  }
  const int n = static_cast<int>(h.size());
  if (dimension.value == 0) dimension = {n, form_place};
  if (n != dimension.value)
    throw Invalid_input(
      form_place, std::to_string(n) + " coordinates, but " + dimension.from + " has " + std::to_string(dimension.value),
      "give all inputs of a job the same number of coordinates");
  const Json_value* w = form.find("w");
  h.push_back(w ? read_numbers(*w, member(form_place, "w")) : std::vector<Rational>{Rational(1)});
  constexpr const char* planar[] = {"x", "y", "w"};
  constexpr const char* spatial[] = {"x", "y", "z", "w"};
  std::size_t size = 1;
  for (std::size_t k = 0; k < h.size(); ++k) {
    if (h[k].empty())
      throw Invalid_input(member(form_place, n == 2 ? planar[k] : spatial[k]), "no coefficients",
                          "give the coefficients of 1, u, u²… ([0] for zero)");
    for (std::size_t i = size; i < h[k].size(); ++i)
      if (h[k][i] != 0) size = i + 1;
  }
  for (auto& x : h) x.resize(size);
  if (std::all_of(h.back().begin(), h.back().end(), [](const Rational& c) { return c == 0; }))
    throw Invalid_input(member(form_place, "w"), "the denominator is zero", "leave \"w\" out for a polynomial curve");
  // A single point: all coordinates are multiples of w.
  std::size_t first = 0;
  while (h.back()[first] == 0) ++first;
  bool one_point = true;
  for (std::size_t k = 0; k + 1 < h.size(); ++k)
    for (std::size_t i = 0; i < size; ++i)
      one_point = one_point && h[k][i] * h.back()[first] == h.back()[i] * h[k][first];
  if (one_point) throw Invalid_input(form_place, "the curve is a single point", "use a point input instead");

  const Parameter_domain domain = read_domain(v, place);
  const Json_value* is_closed = v.find("closed");
  const bool closed = is_closed && read_bool(*is_closed, member(place, "closed"));
  input.dimension = n;
  require_affordable(static_cast<int>(size) - 1, input);
  if (!input.missing.empty()) return;
  read_into(input, place, [&](auto dim) {
    constexpr int D = decltype(dim)::value;
    std::array<std::vector<Rational>, static_cast<std::size_t>(D)> coordinates;
    std::copy_n(h.begin(), D, coordinates.begin());
    return monomial_curve<D>(coordinates, h.back(), domain, closed);
  });
}

inline void read_curve(const Json_value& v, const std::string& place, Dimension& dimension, Job_input& input)
{
  input.kind = Job_input::Kind::curve;
  require_object(v, place, {"degree", "control_points", "weights", "knots", "closed", "monomial", "domain"},
                 "{\"degree\": 1, \"control_points\": [[0,0],[1,0]]}");
  if (v.find("monomial")) {
    read_monomial_curve(v, place, dimension, input);
    return;
  }
  if (v.find("domain"))
    throw Invalid_input(place, "\"domain\" belongs to curves in monomial form",
                        "leave it out, or give \"monomial\" instead of control points");
  read_control_curve(v, place, dimension, input);
}

// ------------------------------------------------------------------------------------------- points and surfaces

/// Surface: checked as far as its numbers go, and left to a later version.
inline void read_surface(const Json_value& v, const std::string& place, Dimension& dimension, Job_input& input)
{
  input.kind = Job_input::Kind::surface;
  input.missing = "surfaces";
  require_object(v, place, {"degrees", "control_points", "weights", "knots"},
                 "{\"degrees\": [1,1], \"control_points\": [[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]}");
  const std::string degrees_place = member(place, "degrees"), points_place = member(place, "control_points");
  const auto& degree_list = require_list(require_key(v, place, "degrees", "give both degrees, like [2, 2]"),
                                         degrees_place, "give both degrees, like [2, 2]");
  if (degree_list.size() != 2)
    throw Invalid_input(degrees_place, std::to_string(degree_list.size()) + " degrees for two parameters",
                        "give both degrees, like [2, 2]");
  std::array<int, 2> degrees{};
  for (std::size_t k = 0; k < 2; ++k) degrees[k] = read_degree(degree_list[k], element(degrees_place, k));

  const std::string rows_remedy = "list rows of points, the first index running with the first parameter";
  const auto& rows = require_list(require_key(v, place, "control_points", rows_remedy), points_place, rows_remedy);
  std::array<std::size_t, 2> size{rows.size(), 0};
  bool one_point = true;
  std::vector<Rational> first_point;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string row_place = element(points_place, i);
    const auto& row = require_list(rows[i], row_place, rows_remedy);
    if (i == 0) size[1] = row.size();
    if (row.size() != size[1])
      throw Invalid_input(
        row_place, std::to_string(row.size()) + " points in a row, but " + std::to_string(size[1]) + " in the first",
        "make all rows equally long");
    for (std::size_t j = 0; j < row.size(); ++j) {
      const auto p = read_point(row[j], element(row_place, j), dimension);
      if (p.size() != 3)
        throw Invalid_input(element(row_place, j), "a surface's points have 3 coordinates, not 2", "write [x, y, z]");
      if (first_point.empty()) first_point = p;
      one_point = one_point && p == first_point;
    }
  }
  const Json_value* knots = v.find("knots");
  for (std::size_t k = 0; k < 2; ++k) {
    const auto order = static_cast<std::size_t>(degrees[k]) + 1;
    if (knots ? size[k] < order : size[k] != order)
      throw Invalid_input(points_place,
                          std::to_string(size[k]) + (k == 0 ? " rows" : " points in a row") + " for degree " +
                            std::to_string(degrees[k]),
                          std::string(knots ? "give at least" : "give") + " degree + 1 = " + std::to_string(order));
  }
  if (one_point) throw Invalid_input(points_place, "the surface is a single point", "use a point input instead");
  if (const Json_value* weights = v.find("weights")) {
    const std::string weights_place = member(place, "weights");
    const auto& weight_rows = require_list(*weights, weights_place, "list rows of weights, one for each control point");
    if (weight_rows.size() != size[0])
      throw Invalid_input(weights_place,
                          std::to_string(weight_rows.size()) + " rows of weights for " + std::to_string(size[0]) +
                            " rows of control points",
                          "give one weight for each control point, or none");
    bool all_zero = true;
    for (std::size_t i = 0; i < weight_rows.size(); ++i) {
      const auto row = read_numbers(weight_rows[i], element(weights_place, i));
      if (row.size() != size[1])
        throw Invalid_input(element(weights_place, i),
                            std::to_string(row.size()) + " weights for " + std::to_string(size[1]) + " control points",
                            "give one weight for each control point, or none");
      all_zero = all_zero && std::all_of(row.begin(), row.end(), [](const Rational& w) { return w == 0; });
    }
    if (all_zero) throw Invalid_input(weights_place, "all weights are zero", "use positive weights");
  }
  if (knots) {
    const std::string knots_place = member(place, "knots");
    const auto& lists = require_list(*knots, knots_place, "give two lists of knots");
    if (lists.size() != 2)
      throw Invalid_input(knots_place, std::to_string(lists.size()) + " lists of knots for two parameters",
                          "give two lists of knots");
    for (std::size_t k = 0; k < 2; ++k) read_knots(lists[k], element(knots_place, k), degrees[k], size[k], degrees[k]);
  }
  input.dimension = 3;
}

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
    input.missing = "points as inputs";
    read_point(v.items[0], inner, dimension);
    input.dimension = dimension.value;
  }
  return input;
}

inline Job_options read_options(const Json_value& v)
{
  Job_options options;
  require_object(v, "options", {"trimmed", "tolerance", "join_tolerance"}, "{\"trimmed\": false, \"tolerance\": 1e-6}");
  if (const Json_value* x = v.find("trimmed")) options.trimmed = read_bool(*x, "options.trimmed");
  if (const Json_value* x = v.find("tolerance")) {
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
    for (Job_input& input : job.inputs)
      if (input.curve) input.curve = with_join_tolerance(*input.curve, job.options.join_tolerance);
  return job;
}

inline Job read_job(std::istream& in) { return read_job(read_json_text(in)); }

/// Throws Unsupported_feature, naming where and what, if the job asks for something that this version does not have.
inline void require_supported(const Job& job)
{
  const auto refuse = [](const std::string& place, const std::string& feature) {
    throw Unsupported_feature(place + ": " + feature);
  };
  if (job.compute != "bisector") refuse("compute", "\"" + job.compute + "\"");
  for (const Job_input& input : job.inputs)
    if (!input.missing.empty()) refuse(input.place, input.missing);
  if (job.options.trimmed)
    refuse("options.trimmed", "trimmed bisectors (give \"trimmed\": false for all solutions of the equations)");
}

} // namespace locus

#endif
