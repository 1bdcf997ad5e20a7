// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_INPUTS_H
#define LOCUS_IO_JSON_INPUTS_H

#include <locus/io/json_text.h>
#include <locus/shape/invalid_input.h>
#include <locus/shape/monomial_curve.h>
#include <locus/shape/rational_surface.h>
#include <locus/shape/spline_curve.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace locus {

/// Greatest degree of a curve, and of a surface in each parameter, that this version takes. The equation's size grows with
/// its square, the exact work faster.
inline constexpr int max_curve_degree = 40;

/// One input of a job, valid by the rules of the job format. It holds what it is, or says what is missing.
struct Job_input {
  enum class Kind : unsigned char { point, curve, surface };

  Kind kind = Kind::curve;
  int dimension = 2;
  std::string place;                            ///< "inputs[1]"
  std::optional<std::vector<Rational>> point;   ///< its two or three coordinates
  std::optional<Curve_2> curve;                 ///< a planar curve, its joints by the job's tolerance
  std::optional<Rational_curve<3>> space_curve; ///< a curve in space, likewise
  std::optional<Rational_surface> surface;
  std::string missing; ///< where it holds none of them: what this version would need for it
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

/// Lets `make` fill the input. Its complaints are told of `place`; what this version cannot do is missing.
template <class Make>
void fill(Job_input& input, const std::string& place, Make make)
{
  try {
    make();
  } catch (const Invalid_input& e) {
    throw e.within(place);
  } catch (const Unsupported_feature& e) {
    input.missing = e.what();
  }
}

/// `make` is called with the dimension and returns the curve.
template <class Make>
void fill_curve(Job_input& input, const std::string& place, Make make)
{
  fill(input, place, [&] {
    if (input.dimension == 2) input.curve = make(std::integral_constant<int, 2>());
    else input.space_curve = make(std::integral_constant<int, 3>());
  });
}

/// Whether the degree is one that this version takes; if not, that is missing.
inline bool is_affordable(int degree, const std::string& kind, Job_input& input)
{
  if (degree <= max_curve_degree) return true;
  input.missing = kind + " of degree above " + std::to_string(max_curve_degree);
  return false;
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
  if (!is_affordable(degree, "curves", input)) return;
  fill_curve(input, place, [&](auto dim) { return curve_of<decltype(dim)::value>(data); });
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
  if (!is_affordable(static_cast<int>(size) - 1, "curves", input)) return;
  fill_curve(input, place, [&](auto dim) {
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

} // namespace detail

} // namespace locus

#endif
