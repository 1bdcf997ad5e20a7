// SPDX-License-Identifier: LGPL-3.0-or-later
// Jobs in, results and pictures out: json_text.h, json_inputs.h, json_surface.h, json_job.h, json_result.h, svg.h. What jobs
// say of space is in surface_test.cpp.

#include <locus/bisector_2.h>
#include <locus/io/json_job.h>
#include <locus/io/json_result.h>
#include <locus/io/svg.h>

#include "support.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <sstream>

using namespace locus;
using namespace locus_test;

namespace {

/// What a call complains of: "place | rule | remedy", or nothing.
template <class F>
std::string complaint(F f)
{
  try {
    f();
  } catch (const Invalid_input& e) {
    return e.place() + " | " + e.rule() + " | " + e.remedy();
  }
  return "";
}

std::string job_complaint(const std::string& text)
{
  return complaint([&] { read_job(text); });
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A job of two lines with `second` as the second curve.
std::string job_with(const std::string& second, const std::string& options = R"({"trimmed": false})")
{
  return R"({"compute": "bisector", "inputs": [{"curve": {"degree": 1, "control_points": [[0,0],[1,0]]}}, {"curve": )" +
         second + R"(}], "options": )" + options + "}";
}

std::string line_with(const std::string& number)
{
  return job_with(R"({"degree": 1, "control_points": [[0, 7], [3, )" + number + "]]}");
}

/// The second curve's last control point's ordinate, as read.
Rational read_back(const std::string& number)
{
  const Job job = read_job(line_with(number));
  return job.inputs.at(1).curve.value().pieces()[0].numerator[1][1];
}

} // namespace

// ------------------------------------------------------------------------------------------------------------ jobs

TEST_CASE("numbers of a job are read exactly")
{
  CHECK(read_back("0.1") == Rational(1, 10));
  CHECK(read_back("-0.1") == Rational(-1, 10));
  CHECK(read_back("\"0.1\"") == Rational(1, 10));
  CHECK(read_back("\"-2/3\"") == Rational(-2, 3));
  CHECK(read_back("1e-6") == Rational(1, 1000000));
  CHECK(read_back("-0") == 0);
  CHECK(read_back("-0.0e5") == 0);
  CHECK(read_back("25E-1") == Rational(5, 2));
  CHECK(read_back("9007199254740993") == Rational("9007199254740993"));         // 2^53 + 1
  CHECK(read_back("18446744073709551615") == Rational("18446744073709551615")); // 2^64 - 1
  CHECK(read_back("18446744073709551617") == Rational("18446744073709551617")); // beyond 64 bits
  CHECK(read_back("-9223372036854775809") == Rational("-9223372036854775809"));
  CHECK(read_back("0.1000000000000000055511151231257827") ==
        Rational("1000000000000000055511151231257827/10000000000000000000000000000000000"));
  CHECK(read_back("1e400") == parse_rational("1e400")); // no double holds it
  CHECK(read_back("1e-400") == parse_rational("1e-400"));
  CHECK(read_back("1e4000") == parse_rational("1e4000"));
}

TEST_CASE("a job's members")
{
  const Job job =
    read_job(job_with(R"({"degree": 2, "control_points": [[0,1],["1/2",3],[1,1]], "weights": [1, "1/2", 1]})",
                      R"({"trimmed": false, "tolerance": "1/1000", "join_tolerance": 0})"));
  CHECK(job.compute == "bisector");
  CHECK(!job.alpha);
  CHECK(!job.options.trimmed);
  CHECK(job.options.tolerance == Rational(1, 1000));
  CHECK(job.options.join_tolerance == 0);
  REQUIRE(job.inputs.size() == 2);
  for (const Job_input& input : job.inputs) {
    CHECK(input.kind == Job_input::Kind::curve);
    CHECK(input.dimension == 2);
    CHECK(input.missing.empty());
    REQUIRE(input.curve);
    CHECK(input.curve->chain().pieces.size() == 1);
    CHECK(input.curve->chain().pieces[0].lo == 0);
    CHECK(input.curve->chain().pieces[0].hi == 1);
  }
  CHECK(job.inputs[1].place == "inputs[1]");
  CHECK(job.inputs[1].curve->pieces()[0].weight[1] == Rational(1, 2));
  CHECK_NOTHROW(require_supported(job));

  const Job defaults = read_job(R"({"inputs": [{"point": [0, 1]}, {"point": ["1/3", 2]}], "compute": "bisector"})");
  CHECK(defaults.options.trimmed);
  CHECK(defaults.options.tolerance == Rational(1, 1000000));
  CHECK(defaults.inputs[0].kind == Job_input::Kind::point);
  CHECK(defaults.inputs[1].missing.empty());
  CHECK(defaults.inputs[1].point == std::vector<Rational>{Rational(1, 3), 2});
  CHECK_NOTHROW(require_supported(defaults));
  CHECK(read_job(R"({"compute": "alpha_sector", "alpha": "1/3", "inputs": [{"point": [0, 1]}, {"point": [1, 2]}]})")
          .alpha == Rational(1, 3));

  std::istringstream stream(line_with("0.25"));
  CHECK(read_job(stream).inputs.size() == 2);
}

TEST_CASE("complaints name the place, the rule and the remedy")
{
  CHECK(job_complaint(line_with("0.5")).empty());
  struct Case {
    std::string text, place, rule, remedy;
  };
  const std::vector<Case> cases{
    {"", "", "empty", "write a JSON object"},
    {"{\"compute\": \"bisector\",", "", "not JSON at line 1, column", "mend"},
    {"{\n\"compute\":\n  nope}", "compute", "line 3, column 4", "mend"},
    {line_with("NaN"), "inputs[1].curve.control_points[1][1]", "not JSON", "finite decimals"},
    {line_with("1e5000"), "inputs[1].curve.control_points[1][1]", "1e5000", "4000"},
    {line_with("\"1/0\""), "inputs[1].curve.control_points[1][1]", "denominator zero", "2/3"},
    {line_with("\"0,5\""), "inputs[1].curve.control_points[1][1]", "'0,5' is not a number", "finite decimal"},
    {line_with("false"), "inputs[1].curve.control_points[1][1]", "must be a number, not false", "finite decimal"},
    {line_with("1, 2"), "inputs[1].curve.control_points[1]",
     "3 coordinates, but inputs[0].curve.control_points[0] has 2", "same number"},
    {job_with("[]"), "inputs[1].curve", "must be an object, not a list", "write"},
    {job_with(R"({"degree": 1, "control_points": [[0,0],[1,1]], "knot": []})"), "inputs[1].curve",
     "unknown key \"knot\"", "\"knots\""},
    {job_with(R"({"degree": 1, "control_points": [[0,0],[1,1]], "color": "red"})"), "inputs[1].curve",
     "unknown key \"color\"", "use \"degree\""},
    {job_with(R"({"degree": 1, "degree": 1, "control_points": [[0,0],[1,1]]})"), "inputs[1].curve",
     "\"degree\" is there twice", "keep one"},
    {job_with(R"({"degree": 2, "control_points": [[0,0],[1,1]]})"), "inputs[1].curve.control_points",
     "2 control points for degree 2", "degree + 1 = 3"},
    {job_with(R"({"degree": 1, "control_points": [[0,0],[1,1]], "weights": [1,-2]})"), "inputs[1].curve.weights",
     "(a pole)", "positive weights"},
    {job_with(R"({"degree": 1, "control_points": [[5,5],[5,5]]})"), "inputs[1].curve.control_points", "single point",
     "point input"},
    {job_with(R"({"degree": 1, "control_points": [[0,0],[1,1]], "knots": [0,0,1]})"), "inputs[1].curve.knots",
     "3 knots for 2 control points of degree 1", "give 4"},
    {job_with(R"({"degree": 1, "control_points": [[0,0],[1,1]]})", R"({"tolerance": -1})"), "options.tolerance",
     "positive, not -1", "1e-6"},
  };
  for (const Case& c : cases) {
    const std::string found = job_complaint(c.text);
    INFO(c.text << "\n" << found);
    CHECK(found.substr(0, c.place.size() + 3) == c.place + " | ");
    CHECK(holds(found, c.rule));
    CHECK(holds(found.substr(found.rfind(" | ")), c.remedy));
    CHECK(found.find('\n') == std::string::npos);
  }
}

TEST_CASE("deep, large and broken text is refused, not suffered")
{
  const std::size_t deep = 1000000;
  CHECK(holds(job_complaint(std::string(deep, '[')), "nested deeper than 64"));
  CHECK(holds(job_complaint(std::string(deep, '[') + std::string(deep, ']')), "nested deeper than 64"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  CHECK(holds(job_complaint(objects), "nested deeper than 64"));
  CHECK(complaint([] { parse_json(std::string(64, '[') + std::string(64, ']')); }).empty());
  CHECK(holds(job_complaint("[" + std::string(6000, '1') + "]"), "6000 characters"));
  CHECK(holds(job_complaint("[0." + std::string(6000, '1') + "]"), "6002 characters"));
  std::string zeros = "[0";
  for (std::size_t i = 0; i < max_json_values; ++i) zeros += ",0";
  CHECK(holds(job_complaint(zeros + "]"), "values"));
  CHECK(holds(job_complaint(std::string(max_json_bytes + 1, ' ')), "64 MiB"));
  CHECK(holds(job_complaint("{\"a\": \"\xff\xfe\"}"), "not JSON"));
  CHECK(holds(job_complaint("{\"a\": \"\xed\xa0\x80\"}"), "not JSON")); // a lone surrogate
}

TEST_CASE("damaged jobs either read or are refused as invalid")
{
  const std::string whole =
    R"({"compute": "bisector", "inputs": [{"curve": {"degree": 2, "control_points": [[0,1],["1/2",3],[1e1,1]], "weights": [1,2,3], "knots": [0,0,0,1,1,1]}},)"
    R"( {"point": [0.5, -2]}, {"curve": {"monomial": {"x": [1,2], "y": [0,1], "w": [1]}, "domain": ["-inf", 3]}}], "options": {"trimmed": true, "tolerance": 1e-3}})";
  const std::string alphabet = "{}[]\",:.-+eE0123456789 truefalsn/\\u\n\xc3\xa9\xff";
  Random random(1);
  Samples samples;
  for (int i = 0; i < 20000; ++i) {
    std::string text = whole;
    for (int edits = random.between(1, 3); edits > 0; --edits) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
      const char c = alphabet[static_cast<std::size_t>(random.below(static_cast<int>(alphabet.size())))];
      switch (random.below(4)) {
      case 0:
        text[at] = c;
        break;
      case 1:
        text.insert(at, 1, c);
        break;
      case 2:
        text.erase(at, static_cast<std::size_t>(random.between(1, 8)));
        break;
      default:
        text.resize(std::max<std::size_t>(at, 1));
      }
      if (text.empty()) text = " ";
    }
    const int outcome = thrown<Invalid_input>([&] { read_job(text); });
    samples.expect(outcome != 2, [&] { return "another exception for " + text; });
    samples.expect(job_complaint(text).find('\n') == std::string::npos, [&] { return "two lines for " + text; });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 40000);
}

TEST_CASE("suggestions and printable text")
{
  using detail::edit_distance;
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("weigths", "weights") == 2);
  CHECK(detail::suggestion("tol", {"trimmed", "tolerance"}) == "did you mean \"tolerance\"?");
  CHECK(detail::suggestion("Knots", {"knots", "closed"}) == "did you mean \"knots\"?");
  CHECK(detail::suggestion("colour", {"knots", "closed", "degree"}) == "use \"knots\", \"closed\" or \"degree\"");
  CHECK(printable("a\nb\tc") == "a b c");
  CHECK(printable("\x1b[31m") == " [31m");
  CHECK(printable("\xc2\x9bx") == " x"); // a control character of two bytes
  CHECK(printable("\xe2\x80\xa8x") == " x");
  CHECK(printable("\xff\xc3(\xe2\x82") == "?"
                                          "?(?"
                                          "?");
  CHECK(printable("é") == "é");
  CHECK(printable(std::string(100, 'x'), 5) == "xxxxx…");
}

// -------------------------------------------------------------------------------------------------------- B-splines

namespace {

/// Basis function of a B-spline by its recursive definition, on the right side of a knot.
Rational basis(const std::vector<Rational>& u, std::size_t i, int d, const Rational& x)
{
  if (d == 0) return u[i] <= x && x < u[i + 1] ? 1 : 0;
  const auto k = static_cast<std::size_t>(d);
  Rational sum = 0;
  if (u[i + k] != u[i]) sum += Rational((x - u[i]) / (u[i + k] - u[i])) * basis(u, i, d - 1, x);
  if (u[i + k + 1] != u[i + 1])
    sum += Rational((u[i + k + 1] - x) / (u[i + k + 1] - u[i + 1])) * basis(u, i + 1, d - 1, x);
  return sum;
}

/// Value of a coordinate of a curve at a parameter that is not its last: from the piece that holds it.
Rational value_at(const Curve_2& c, std::size_t axis, const Rational& u)
{
  for (std::size_t k = 0; k < c.pieces().size(); ++k) {
    const Piece& p = c.chain().pieces[k];
    if ((!p.lo_infinite && u < p.lo) || (!p.hi_infinite && u >= p.hi)) continue;
    const Rational s = p.hi_infinite   ? Rational(1 - p.lo / u)
                       : p.lo_infinite ? Rational(p.hi / u)
                                       : Rational((u - p.lo) / (p.hi - p.lo));
    return Rational(plain_value<1>(c.pieces()[k].numerator[axis], {s}) / plain_value<1>(c.pieces()[k].weight, {s}));
  }
  throw std::logic_error("no piece holds the parameter");
}

template <class List>
std::string json_list(const List& numbers)
{
  std::string text = "[";
  for (const auto& x : numbers) text += (text.size() > 1 ? ", \"" : "\"") + x.get_str() + "\"";
  return text + "]";
}

const Curve_2& second_curve(const Job& job) { return job.inputs.at(1).curve.value(); }

} // namespace

TEST_CASE("a job's B-splines against the basis functions' definition")
{
  Random random(2);
  Samples samples;
  int many = 0;
  for (int round = 0; round < 120; ++round) {
    const int d = random.between(1, 4);
    const auto n = static_cast<std::size_t>(d + random.between(1, 5));
    std::vector<Rational> u, w;
    Rational last = random.between(-5, 5);
    for (std::size_t i = 0; i < n + static_cast<std::size_t>(d) + 1; ++i) {
      if (!random.chance(35)) last += Rational(random.between(1, 6)) / 3;
      u.push_back(last);
    }
    std::vector<std::array<Rational, 2>> points;
    std::string list;
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back({Rational(random.between(-99, 99)), Rational(random.between(-99, 99))});
      list += (i ? ", " : "") + json_list(points.back());
      w.push_back(random.between(1, 5));
    }
    const std::string text = job_with("{\"degree\": " + std::to_string(d) + ", \"control_points\": [" + list +
                                      "], \"knots\": " + json_list(u) + ", \"weights\": " + json_list(w) + "}");
    if (!job_complaint(text).empty()) continue; // knots repeated too often
    const Job job = read_job(text);
    const Curve_2& c = second_curve(job);
    CHECK(c.chain().pieces.front().lo == u[static_cast<std::size_t>(d)]);
    CHECK(c.chain().pieces.back().hi == u[n]);
    many += c.pieces().size() > 1;
    for (int i = 0; i < 8; ++i) {
      const Rational x = u[static_cast<std::size_t>(d)] + Rational(i) / 8 * (u[n] - u[static_cast<std::size_t>(d)]);
      std::array<Rational, 3> sum{};
      for (std::size_t j = 0; j < n; ++j) {
        const Rational b = basis(u, j, d, x) * w[j];
        sum[0] += b * points[j][0];
        sum[1] += b * points[j][1];
        sum[2] += b;
      }
      for (std::size_t v = 0; v < 2; ++v)
        samples.expect(value_at(c, v, x) == Rational(sum[v] / sum[2]), [&] { return text + " at " + show(x); });
    }
  }
  CHECK(many > 20);
  LOCUS_REQUIRE_SAMPLES(samples, 800);
}

TEST_CASE("a B-spline of one span is a Bezier curve over that span")
{
  const Job clamped = read_job(
    job_with(R"({"degree": 2, "control_points": [[0,0],[1,2],[3,0]], "weights": [1,2,3], "knots": [2,2,2,5,5,5]})"));
  const Curve_2& c = second_curve(clamped);
  CHECK(c.chain().pieces[0].lo == 2);
  CHECK(c.chain().pieces[0].hi == 5);
  CHECK(value_at(c, 1, Rational(3)) == Rational(2 * 2 * 2 * 2) / Rational(4 + 2 * 4 + 3)); // basis 4/9, 4/9, 1/9

  // Unclamped: the span [2,3] of a uniform quadratic starts and ends in the middles of the control polygon's sides.
  const Job open =
    read_job(job_with(R"({"degree": 2, "control_points": [[0,0],[2,4],[4,0]], "knots": [0,1,2,3,4,5]})"));
  const Curve_2& o = second_curve(open);
  REQUIRE(o.pieces().size() == 1);
  CHECK(o.chain().pieces[0].lo == 2);
  CHECK(o.chain().pieces[0].hi == 3);
  CHECK(value_at(o, 0, Rational(2)) == 1);
  CHECK(value_at(o, 1, Rational(2)) == 2);
  CHECK(value_at(o, 0, Rational(5, 2)) == 2);

  const Job many = read_job(job_with(R"({"degree": 1, "control_points": [[0,0],[2,4],[4,0]], "knots": [0,0,1,2,2]})"));
  CHECK(second_curve(many).pieces().size() == 2);
  CHECK(second_curve(many).chain().joints.at(0).kind == Joint_kind::corner);
  CHECK_NOTHROW(require_supported(many));
}

TEST_CASE("a job's closed curves, and curves in monomial form")
{
  const Job loop = read_job(job_with(R"({"degree": 3, "control_points": [[0,0],[1,0],[0,1],[0,0]], "closed": true})"));
  CHECK(second_curve(loop).chain().is_closed());
  CHECK(second_curve(loop).chain().joints.at(0).kind == Joint_kind::corner);
  CHECK(loop.inputs[1].missing.empty());
  const Job cusp = read_job(job_with(R"({"degree": 3, "control_points": [[0,0],[3,3],[0,3],[3,0]]})"));
  REQUIRE(second_curve(cusp).pieces().size() == 2);
  CHECK(second_curve(cusp).chain().pieces[0].hi == Rational(1, 2));
  CHECK(second_curve(cusp).chain().joints.at(0).kind == Joint_kind::corner);

  const Job half = read_job(
    job_with(R"({"monomial": {"x": [0, 1, 0, 0], "y": [1, 0, "1/3"]}, "domain": ["-inf", "5/2"]})"));
  const Curve_2& parabola = second_curve(half);
  CHECK(parabola.chain().pieces.front().lo_infinite);
  CHECK(parabola.chain().pieces.back().hi == Rational(5, 2));
  for (const Rational& u : {Rational(-1000), Rational(-1), Rational(1, 7), Rational(2)}) {
    CHECK(value_at(parabola, 0, u) == u);
    CHECK(value_at(parabola, 1, u) == Rational(1 + u * u / 3));
  }
  const Job circle = read_job(
    job_with(R"({"monomial": {"x": [1, 0, -1], "y": [0, 2], "w": [1, 0, 1]}, "domain": ["-inf", "inf"]})"));
  CHECK(second_curve(circle).chain().is_closed());
  const Job ends = read_job(
    job_with(R"({"monomial": {"x": [0, 1, -1], "y": [0, 1, 0, -1]}, "domain": [0, 1], "closed": true})"));
  CHECK(second_curve(ends).chain().is_closed());
  const Job hyperbola = read_job(
    job_with(R"({"monomial": {"x": [1], "y": [0, 0, 1], "w": [0, 1]}, "domain": [-2, 2]})"));
  CHECK(second_curve(hyperbola).chain().joints.at(0).kind == Joint_kind::pole);

  const Job irrational = read_job(
    job_with(R"({"monomial": {"x": [1], "y": [0, 1], "w": [-2, 0, 1]}, "domain": [0, 2]})"));
  CHECK(!irrational.inputs[1].curve);
  CHECK(holds(irrational.inputs[1].missing, "pole at an irrational parameter, near u = 1.41421"));
  CHECK_THROWS_AS(require_supported(irrational), Unsupported_feature);
  const Job space = read_job(
    R"({"compute": "bisector", "inputs": [)"
    R"({"curve": {"degree": 1, "control_points": [[0,0,0],[1,0,1],[2,1,1]], "knots": [0,0,1,2,2]}},)"
    R"({"curve": {"monomial": {"x": [0,1], "y": [0], "z": [1]}, "domain": [0, "inf"]}}]})");
  for (const Job_input& input : space.inputs) {
    CHECK(input.missing.empty());
    CHECK(!input.curve);
    REQUIRE(input.space_curve);
    CHECK(input.space_curve->pieces().size() == 2);
  }
}

TEST_CASE("what is wrong with a job's splines and monomials")
{
  struct Case {
    std::string curve, place, rule;
  };
  const std::string points = R"({"degree": 1, "control_points": [[0,0],[1,1],[2,0],[3,1]], )";
  const std::vector<Case> cases{
    {points + R"("knots": [0,0,1,2,3]})", ".knots", "5 knots for 4 control points of degree 1"},
    {points + R"("knots": [0,0,2,1,3,3]})", ".knots[3]", "1 follows 2"},
    {points + R"("knots": [0,0,1,1,3,3]})", ".knots[3]", "repeated degree + 1 times, and the curve jumps"},
    {points + R"("knots": [0,0,1,1,1,3]})", ".knots[4]", "repeated too often for degree 1"},
    {points + R"("knots": [0,0,1,2,3,3], "weights": [1,1,-1,1]})", ".weights[2]", "near u = 1.5"},
    {points + R"("knots": [0,0,1,2,3,3], "closed": true})", ".closed", "the ends of the curve do not coincide"},
    {R"({"degree": 1, "control_points": [[0,0],[1,1],[1,1],[3,1]], "knots": [0,0,1,2,3,3]})", ".control_points",
     "stands still between knots[2] and knots[3]"},
    {R"({"monomial": {"x": [0, 1], "y": [1]}, "domain": [1, "1/2"]})", ".domain", "the interval is empty"},
    {R"({"monomial": {"x": [0, 1], "y": [1]}, "domain": ["-inf", "inf"], "closed": true})", ".closed", "ends at infinity"},
    {R"({"monomial": {"x": [0, 1], "y": [1]}, "domain": [0, 1], "closed": true})", ".closed", "do not coincide"},
  };
  for (const Case& c : cases) {
    const std::string found = job_complaint(job_with(c.curve));
    INFO(c.curve << "\n" << found);
    const std::string place = "inputs[1].curve" + c.place + " | ";
    CHECK(found.substr(0, place.size()) == place);
    CHECK(holds(found, c.rule));
  }
  // Two control points of one place: no jump.
  const std::string twice = R"({"degree": 1, "control_points": [[0,0],[1,1],[1,1],[3,1]], "knots": [0,0,1,1,3,3]})";
  CHECK(job_complaint(job_with(twice)).empty());
}

TEST_CASE("a job's join tolerance, and one curve alone")
{
  const std::string bent = R"({"degree": 1, "control_points": [[0,0],[1,0],[2,"1/1000"]], "knots": [0,0,1,2,2]})";
  const Job exact = read_job(job_with(bent));
  CHECK(second_curve(exact).chain().joints.at(0).kind == Joint_kind::corner);
  const Job tolerant = read_job(job_with(bent, R"({"trimmed": false, "join_tolerance": 0.0011})"));
  const Joint joint = second_curve(tolerant).chain().joints.at(0);
  CHECK(joint.kind == Joint_kind::g1);
  CHECK(joint.by_tolerance);
  CHECK_NOTHROW(require_supported(tolerant));
  const Job tighter = read_job(job_with(bent, R"({"trimmed": false, "join_tolerance": 0.0009})"));
  CHECK(second_curve(tighter).chain().joints.at(0).kind == Joint_kind::corner);

  const Job alone =
    read_job(R"({"compute": "bisector", "inputs": [{"curve": )" + bent + R"(}], "options": {"trimmed": false}})");
  CHECK_NOTHROW(require_supported(alone));
}

// ---------------------------------------------------------------------------------------------------------- results

namespace {

/// An arc along a segment, from (0,0) to (2,1), with parameters that run from 0 to 1 and from 1 to 0.
class Straight final : public Arc_geometry<2> {
public:
  explicit Straight(double radius = 0.5) : radius_(radius) {}
  Arc_point<2> at(double x) const override { return {{{x, x}, {1 - x, 1 - x}}, {{2 * x, x}}, radius_, 1e-15}; }
  Arc_differential<2> differential(double) const override { return {}; }
  std::vector<Arc_point<2>> samples(std::size_t n) const override
  {
    std::vector<Arc_point<2>> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(at(static_cast<double>(i) / static_cast<double>(n - 1)));
    return points;
  }
  Polyline<2> polyline(double tolerance) const override { return {samples(tolerance < 1e-3 ? 5 : 2), tolerance}; }
  Irregular_points<2> irregular() const override { return {{at(0.25)}, true}; }

private:
  double radius_;
};

Locus_data<2> sample_data()
{
  Locus_data<2> data;
  data.compute = "bisector";
  data.equations.push_back({"F3", {8, 8}});
  Locus_vertex<2> a, b, infinity;
  a.kind = Vertex_kind::boundary;
  a.feet = {{0, Feature::start, {{0, 0}}}, {1, Feature::interior, {{0.1, 0.25}}}};
  a.point = Approximate_point<2>{{0, 0}};
  b.kind = Vertex_kind::node;
  b.multiplicity = 3;
  b.feet = {{0, Feature::end, {{1, 1}}}, {1, Feature::corner, {{0.5, 0.5}}}};
  b.point = Approximate_point<2>{{2, 1}};
  b.radius = 0.5;
  b.half_branches = {{0, false}, {0, true}};
  infinity.kind = Vertex_kind::infinity;
  infinity.feet = {{0, Feature::interior, {{0.5, 0.5}}}, {1, Feature::interior, {{0.75, 0.75}}}};
  infinity.direction = Approximate_point<2>{{0, 1}};
  infinity.asymptote = Asymptote<2>{{{1, 2}}, {{0, 1}}};
  data.vertices = {a, b, infinity};
  const std::vector<std::size_t> inputs{0, 1};
  const std::vector<Feature> features{Feature::interior, Feature::interior};
  data.arcs.emplace_back(std::make_shared<Straight>(), 0, 1, inputs, features);
  data.arcs.emplace_back(std::make_shared<Straight>(), std::nullopt, std::nullopt, inputs, features);
  data.regions.push_back({{0, 1}, "overlap"});
  data.degenerate.push_back({"centre", 1, Range{0.5, 0.5}, {{0, 1}, {0.25, 1}}, 2, "a \"quoted\"\nreason\\"});
  data.cells = {{{{0, 0.5}, {0, 1}}, {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}}, "graph"}, {{{0.5, 1}, {0, 1}}, {}, "empty"}};
  data.statistics.cells = 7;
  data.statistics.filter.calls = {10, 2, 1};
  data.statistics.filter.failures = {2, 1, 0};
  data.scale = 3.5;
  data.cut_radius = 35;
  return data;
}

std::string json_of(const Locus<2>& locus, double tolerance = 1e-6)
{
  std::ostringstream out;
  write_json(out, locus, tolerance);
  return out.str();
}

} // namespace

TEST_CASE("a result's JSON holds what the contract names")
{
  using Json = nlohmann::ordered_json;
  const std::string text = json_of(Locus<2>(sample_data()));
  const Json j = Json::parse(text);
  std::vector<std::string> keys;
  for (const auto& [key, value] : j.items()) keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"compute", "trimmed", "status", "tolerance", "scale", "cut_radius", "centre",
                                         "components", "equations", "vertices", "arcs", "regions", "degenerate",
                                         "joined_by_tolerance", "undecided", "statistics"});
  CHECK(j["compute"] == "bisector");
  CHECK(j["trimmed"] == false);
  CHECK(j["status"] == "certified");
  CHECK(j["scale"] == 3.5);
  CHECK(j["components"] == 2);
  CHECK(j["equations"] == Json::parse(R"([{"name": "F3", "degrees": [8, 8]}])"));
  CHECK(j["vertices"][0] ==
        Json::parse(R"({"kind": "boundary", "feet": [{"input": 0, "feature": "start", "parameters": [[0.0, 0.0]]},
    {"input": 1, "feature": "interior", "parameters": [[0.1, 0.25]]}], "point": [0.0, 0.0], "radius": 0.0})"));
  CHECK(j["vertices"][1]["multiplicity"] == 3);
  CHECK(j["vertices"][1]["half_branches"] ==
        Json::parse(R"([{"arc": 0, "at": "target"}, {"arc": 0, "at": "source"}])"));
  CHECK(j["vertices"][2] ==
        Json::parse(R"({"kind": "infinity", "feet": [{"input": 0, "feature": "interior", "parameters": [[0.5, 0.5]]},
    {"input": 1, "feature": "interior", "parameters": [[0.75, 0.75]]}], "direction": [0.0, 1.0], "asymptote": {"point": [1.0, 2.0], "direction": [0.0, 1.0]}})"));
  const Json& arc = j["arcs"][0];
  CHECK(arc["source"] == 0);
  CHECK(arc["target"] == 1);
  CHECK(arc["closed"] == false);
  CHECK(arc["inputs"] == Json::parse("[0, 1]"));
  CHECK(arc["features"] == Json::parse(R"(["interior", "interior"])"));
  CHECK(arc["error"] == 1e-6);
  CHECK(arc["samples"].size() == 5);
  CHECK(arc["samples"][1] == Json::parse(R"({"parameters": [0.25, 0.75], "point": [0.5, 0.25], "radius": 0.5})"));
  CHECK(arc["irregular"] == Json::parse(R"([{"parameters": [0.25, 0.75], "point": [0.5, 0.25], "radius": 0.5}])"));
  CHECK(!j["arcs"][1].contains("source"));
  CHECK(!j["arcs"][1].contains("target"));
  CHECK(j["arcs"][1]["closed"] == true);
  CHECK(j["regions"] == Json::parse(R"([{"arcs": [0, 1], "reason": "overlap"}])"));
  CHECK(j["degenerate"] == Json::parse(R"([{"kind": "centre", "input": 1, "parameter": [0.5, 0.5],
    "box": [[0, 1], [0.25, 1]], "multiplicity": 2, "reason": "a \"quoted\"\nreason\\"}])"));
  CHECK(j["joined_by_tolerance"].empty());
  CHECK(j["undecided"].empty());
  CHECK(j["statistics"]["cells"] == 7);
  CHECK(j["statistics"]["filter_calls"] == 13);
  CHECK(j["statistics"]["filter_failures"] == 3);
  CHECK(j["statistics"]["rungs"]["interval"] == Json::parse(R"({"calls": 2, "failures": 1})"));
  CHECK(Json::parse(json_of(Locus<2>(sample_data()), 1e-2))["arcs"][0]["samples"].size() == 2);

  Locus_data<2> open = sample_data();
  open.undecided.push_back({{{0, 0.5}, {0.25, 0.5}}, "cell limit"});
  const Json u = Json::parse(json_of(Locus<2>(open)));
  CHECK(u["status"] == "undecided");
  CHECK(u["undecided"] == Json::parse(R"([{"box": [[0.0, 0.5], [0.25, 0.5]], "reason": "cell limit"}])"));
  CHECK(Json::parse(json_of(Locus<2>(Locus_data<2>())))["arcs"].empty());
}

TEST_CASE("doubles of a result read back as themselves, and nothing else is a number")
{
  Random random(3);
  Samples samples;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.any_double();
    std::ostringstream out;
    detail::Json_writer json(out);
    json.value(x);
    json.finish();
    const std::string digits = out.str().substr(0, out.str().find('\n'));
    samples.expect(std::strtod(digits.c_str(), nullptr) == x, [&] { return show(x) + " became " + digits; });
    samples.expect(digits.size() <= 24 && nlohmann::json::parse(digits).is_number(),
                   [&] { return "no number: " + digits; });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 40000);

  Locus_data<2> data = sample_data();
  data.vertices[0].feet[0].parameters[0] = {-std::numeric_limits<double>::infinity(),
                                            std::numeric_limits<double>::infinity()};
  CHECK(nlohmann::json::parse(json_of(Locus<2>(data)))["vertices"][0]["feet"][0]["parameters"] ==
        nlohmann::json::parse(R"([["-inf", "inf"]])"));
  data.vertices[0].radius = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(json_of(Locus<2>(data)), std::logic_error);
}

namespace {

/// An arc on which both parameters pass infinity.
class Through_infinity final : public Arc_geometry<2> {
public:
  Arc_point<2> at(double x) const override
  {
    constexpr double inf = std::numeric_limits<double>::infinity();
    if (x < 0.5) return {{{inf, inf}, {-inf, 2}}, {{x, 0}}, 1, 0};
    return {{{3, inf}, {-inf, -inf}}, {{x, 0}}, 1, 0};
  }
  Arc_differential<2> differential(double) const override { return {}; }
  std::vector<Arc_point<2>> samples(std::size_t n) const override
  {
    std::vector<Arc_point<2>> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(at(static_cast<double>(i) / static_cast<double>(n - 1)));
    return points;
  }
  Polyline<2> polyline(double) const override { return {samples(2), 0}; }
  Irregular_points<2> irregular() const override { return {}; }
};

} // namespace

TEST_CASE("of a self-bisector the greater parameter comes first, whatever rounding says")
{
  using Values = std::vector<double>;
  CHECK(detail::picked_parameters({{0.5, 0.75}, {0.5, 1}}, true) == Values{0.5, 0.5});
  CHECK(detail::picked_parameters({{0.25, 0.5}, {0.5, 1}}, true) == Values{0.5, 0.5});
  CHECK(detail::picked_parameters({{0.5, 0.75}, {0.5, 1}}, false) == Values{0.625, 0.75});
  CHECK(detail::picked_parameters({{0.5, 1}, {0, 0.5}}, true) == Values{0.75, 0.25});
  CHECK(detail::picked_parameters({{0, 0.25}, {0.5, 1}}, true) == Values{0.125, 0.75}); // no rounding: nothing to hide
}

TEST_CASE("infinite parameters of a result are strings")
{
  using Json = nlohmann::json;
  Locus_data<2> data;
  constexpr double inf = std::numeric_limits<double>::infinity();
  data.arcs.emplace_back(std::make_shared<Through_infinity>(), std::nullopt, std::nullopt, std::vector<std::size_t>{0, 0},
                         std::vector<Feature>{Feature::interior, Feature::interior});
  data.degenerate.push_back({"everything", {}, {}, {{-inf, -1}, {1, inf}}, 1, "all"});
  data.undecided.push_back({{{-inf, inf}, {0, 1}}, "some"});
  const Json j = Json::parse(json_of(Locus<2>(data)));
  CHECK(j["arcs"][0]["inputs"] == Json::parse("[0, 0]"));
  CHECK(j["arcs"][0]["samples"][0]["parameters"] == Json::parse(R"(["inf", 2.0])"));
  CHECK(j["arcs"][0]["samples"][1]["parameters"] == Json::parse(R"([3.0, "-inf"])"));
  CHECK(j["degenerate"] == Json::parse(R"([{"kind": "everything", "box": [["-inf", -1.0], [1.0, "inf"]], "reason": "all"}])"));
  CHECK(j["undecided"][0]["box"] == Json::parse(R"([["-inf", "inf"], [0.0, 1.0]])"));
}

TEST_CASE("joints that were taken as smooth are listed")
{
  const Curve_2 straight = bezier_2({{0, 2}, {3, 2}});
  const Curve_2 bent = polyline_2({{0, 0}, {1, 0}, {2, "1/100"}, {2, 1}});
  const Curve_2 joined = with_join_tolerance(bent, Rational(1, 50));
  const auto list = [](const std::vector<Curve_2>& inputs) {
    std::ostringstream out;
    write_json(out, Locus<2>(sample_data()), 1e-6, {}, inputs);
    return nlohmann::json::parse(out.str())["joined_by_tolerance"];
  };
  CHECK(list({straight, bent}).empty());
  CHECK(list({straight, joined}) == nlohmann::json::parse(R"([{"input": 1, "parameter": 1.0}])"));
  CHECK(list({joined}) == nlohmann::json::parse(R"([{"input": 0, "parameter": 1.0}])"));

  // The seam, at the end of the domain.
  Chain chain = circle_2({0, 0}, 1).chain();
  chain.joints.back().by_tolerance = true;
  CHECK(list({Curve_2(circle_2({0, 0}, 1).pieces(), chain)}) == nlohmann::json::parse(R"([{"input": 0, "parameter": 4.0}])"));
  chain.pieces.back().hi_infinite = true;
  CHECK(list({Curve_2(circle_2({0, 0}, 1).pieces(), chain)}) == nlohmann::json::parse(R"([{"input": 0, "parameter": "inf"}])"));
}

// --------------------------------------------------------------------------------------------------------- pictures

namespace {

std::string svg_of(const Locus<2>& locus, const std::vector<Curve_2>& inputs = {})
{
  std::ostringstream out;
  write_svg(out, locus, inputs);
  return out.str();
}

/// Elements closed in the order in which they were opened, and no number that is none.
std::string fault_of(const std::string& svg)
{
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos) return "a tag that does not end";
    const std::string tag = svg.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "a tag inside the tag " + tag;
    if (holds(tag, "nan") || holds(tag, "\"inf") || holds(tag, " inf") || holds(tag, "-inf"))
      return "no number in " + tag;
    if (tag.back() == '/') continue;
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "unexpected " + tag;
      open.pop_back();
    } else {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  return open.empty() ? "" : open.back() + " stays open";
}

} // namespace

TEST_CASE("pictures are well-formed, of any data")
{
  const Curve_2 a = bezier_2({{0, -1}, {1, -2}, {2, -1}}), b = bezier_2({{0, 1}, {1, 3}, {2, 2}}, {1, 2, 1});
  Locus_data<2> data = sample_data();
  data.undecided.push_back({{{0, 0.5}, {0.25, 0.5}}, "cell limit"});
  data.undecided.push_back({{{0.5, 0.5}, {0.25, 0.25}}, "depth limit"});
  data.cells.push_back({{{0, 0.5}, {0.25, 0.5}}, {}, "undecided"});
  data.centre = {{1, 0}};
  const Locus<2> locus(data);
  const std::string alone = svg_of(locus), with_curves = svg_of(locus, {a, b});
  CHECK(fault_of(alone).empty());
  CHECK(fault_of(with_curves).empty());
  CHECK(with_curves.size() > alone.size());
  for (const char* part :
       {"first curve", "second curve", "to the feet", "t = 0", "r = 1", "url(#hatch)", "node", "asymptote",
        "degenerate component"}) {
    INFO(part);
    CHECK(holds(with_curves, part));
  }
  CHECK(!holds(alone, "first curve"));
  CHECK(holds(svg_of(Locus<2>(sample_data())), "certified"));
  CHECK(fault_of(svg_of(Locus<2>(Locus_data<2>()))).empty());

  for (const double size : {1e-300, 1e-100, 1e100, 1e300}) {
    Locus_data<2> d = sample_data();
    d.scale = size;
    d.cut_radius = 10 * size;
    const Rational s = exact_rational(size);
    INFO(size);
    CHECK(fault_of(svg_of(Locus<2>(d))).empty());
    CHECK(fault_of(svg_of(Locus<2>(d), {bezier_2({{0, s}, {s, s}}), bezier_2({{0, 0}, {s, Rational(-s)}})})).empty());
  }
  data.vertices[1].point = Approximate_point<2>{{std::numeric_limits<double>::infinity(), 0}};
  data.centre = {{std::numeric_limits<double>::quiet_NaN(), 0}};
  CHECK(fault_of(svg_of(Locus<2>(data), {a, b})).empty());
  CHECK_THROWS_AS(write_svg("/absent/folder/bisector.svg", locus), std::runtime_error);
}

TEST_CASE("components of a picture are those of the locus")
{
  const auto numbers = detail::component_numbers(Locus<2>(sample_data()));
  CHECK(numbers.of_arc == std::vector<std::size_t>{0, 1});
  CHECK(numbers.of_vertex[0] == 0);
  CHECK(numbers.of_vertex[1] == 0);
}

TEST_CASE("pictured curves run through the curve's points")
{
  const Curve_2 c(bezier_2({{0, 1}, {1, 3}, {4, 2}}, {1, 2, 3}).pieces(), [] {
    Chain chain;
    chain.pieces[0].lo = -2;
    chain.pieces[0].hi = 6;
    return chain;
  }());
  const detail::Pictured_curve pictured(c, {Rational(1), Rational(1, 2)});
  for (int i = 0; i <= 8; ++i) {
    const Rational s = Rational(i) / 8, w = plain_value<1>(c.pieces()[0].weight, {s});
    const detail::Picture_point p = pictured.at(-2.0 + i);
    CHECK(std::abs(pictured.place(-2.0 + i) - 0.125 * i) < 1e-15);
    CHECK(std::abs(p.x + 1 - Rational(plain_value<1>(c.pieces()[0].numerator[0], {s}) / w).get_d()) < 1e-14);
    CHECK(std::abs(p.y + 0.5 - Rational(plain_value<1>(c.pieces()[0].numerator[1], {s}) / w).get_d()) < 1e-14);
  }
}

TEST_CASE("pictured curves of several pieces, and through infinity")
{
  const detail::Pictured_curve line(line_2({1, 2}, {1, 3}), {Rational(0), Rational(0)});
  CHECK(line.size() == 3);
  CHECK(!line.is_finite());
  CHECK(!line.is_closed());
  CHECK(line.is_pole(0, false));
  CHECK(!line.is_pole(0, true));
  CHECK(line.is_pole(2, true));
  for (const double u : {-1e6, -3.0, -1.0, 0.0, 0.5, 1.0, 7.0, 1e6}) {
    INFO(u);
    CHECK(line.at(u).x == Approx(1 + u));
    CHECK(line.at(u).y == Approx(2 + 3 * u));
  }
  CHECK(line.place(-std::numeric_limits<double>::infinity()) == 0);
  CHECK(line.place(std::numeric_limits<double>::infinity()) == 3);
  for (const auto& p : line.essential_points()) CHECK(std::abs(p.x - 1) <= 2); // u from -2 to 2
  REQUIRE(line.parts().size() == 1);
  CHECK(line.parts()[0].front().x < -1e9);
  CHECK(line.parts()[0].back().x > 1e9);

  // y = 1/x: two branches.
  const detail::Pictured_curve hyperbola(monomial_curve<2>({{{0, 0, 1}, {1, 0, 0}}}, {0, 1}, {Rational(-2), Rational(2)}),
                                         {Rational(0), Rational(0)});
  REQUIRE(hyperbola.parts().size() == 2);
  CHECK(hyperbola.parts()[0].back().y < -1e9);
  CHECK(hyperbola.parts()[1].front().y > 1e9);
  for (const auto& p : hyperbola.essential_points()) CHECK(std::abs(p.y) <= 1 + 1e-12);

  const detail::Pictured_curve circle(circle_2({0, 0}, 1), {Rational(0), Rational(0)});
  CHECK(circle.is_closed());
  CHECK(circle.at(2).x == Approx(-1));
  CHECK(circle.at(4).x == Approx(1));
  const auto parts = circle.parts();
  REQUIRE(parts.size() == 1);
  for (const auto& p : parts[0]) CHECK(std::hypot(p.x, p.y) == Approx(1));
}

TEST_CASE("axes of a picture: values, or pieces one unit long where the domain is infinite")
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  const detail::Pictured_curve spline(bspline_2(1, {{0, 0}, {1, 0}, {1, 1}}, {2, 2, 5, 6, 6}), {Rational(0), Rational(0)});
  const detail::Parameter_axis plain(spline);
  REQUIRE(plain.knots().size() == 3);
  CHECK(plain.lo() == 2);
  CHECK(plain.knots()[1].at == 5);
  CHECK(plain.knots()[1].is_corner);
  CHECK(plain.hi() == 6);
  CHECK(plain.at(5.5) == 5.5);
  CHECK(plain.at(inf) == 6);

  const detail::Pictured_curve line(line_2({0, 0}, {1, 0}), {Rational(0), Rational(0)});
  const detail::Parameter_axis units(line);
  REQUIRE(units.knots().size() == 4);
  CHECK(units.lo() == 0);
  CHECK(units.hi() == 3);
  CHECK(units.knots()[0].value == -inf);
  CHECK(units.knots()[2].value == 1);
  CHECK(!units.knots()[2].is_corner);
  CHECK(units.at(-inf) == 0);
  CHECK(units.at(-2) == Approx(0.5));
  CHECK(units.at(0) == Approx(1.5));
  CHECK(units.at(4) == Approx(2.75));
  CHECK(units.at(inf) == 3);
}

TEST_CASE("in a picture's square arcs leave at a seam and come back on the other side")
{
  using detail::Picture_point;
  const detail::Pictured_curve circle(circle_2({0, 0}, 1), {Rational(0), Rational(0)});
  detail::Parameter_square square;
  square.axes = {detail::Parameter_axis(circle), detail::Parameter_axis(circle)};
  const auto at = [](const std::vector<Picture_point>& part, std::size_t i, double x, double y) {
    return std::abs(part[i].x - x) + std::abs(part[i].y - y) < 1e-12;
  };
  auto parts = square.parts({{3.5, 1}, {3.875, 1.25}, {0.25, 1.5}, {0.5, 1.75}});
  REQUIRE(parts.size() == 2);
  REQUIRE(parts[0].size() == 3);
  CHECK(at(parts[0], 2, 4.25, 1.5));
  CHECK(at(parts[1], 0, -0.125, 1.25));
  CHECK(at(parts[1], 2, 0.5, 1.75));

  square.is_self = true; // the parameters change places
  parts = square.parts({{3.5, 1}, {3.875, 1.25}, {1.5, 0.25}, {1.75, 0.5}});
  REQUIRE(parts.size() == 2);
  CHECK(at(parts[0], 2, 4.25, 1.5));
  CHECK(at(parts[1], 0, 1.25, -0.125));

  square.axes = {detail::Parameter_axis(0, 4), detail::Parameter_axis(0, 4)}; // no seam
  CHECK(square.parts({{3.5, 1}, {3.875, 1.25}, {1.5, 0.25}}).size() == 1);
}

TEST_CASE("segments are clipped to a box")
{
  using detail::Picture_point;
  const detail::Picture_box box{0, 0, 2, 1};
  const auto clipped = [&](Picture_point p, Picture_point q) {
    if (!box.clip(p, q)) return std::vector<double>{};
    return std::vector<double>{p.x, p.y, q.x, q.y};
  };
  CHECK(clipped({0.5, 0.5}, {1, 1}) == std::vector<double>{0.5, 0.5, 1, 1});
  CHECK(clipped({-1, 0.5}, {3, 0.5}) == std::vector<double>{0, 0.5, 2, 0.5});
  CHECK(clipped({1, 0.5}, {1, 1e9}) == std::vector<double>{1, 0.5, 1, 1});
  CHECK(clipped({3, 0.25}, {1, 2.25}).empty()); // past the corner, beyond no single side
  CHECK(clipped({-1, 2}, {3, 3}).empty());
  CHECK(clipped({0, 0}, {std::numeric_limits<double>::infinity(), 1}).empty());
}

TEST_CASE("pictures of a curve with itself, of closed and of infinite curves")
{
  const auto pictured = [](const std::vector<Curve_2>& inputs) {
    const Bisector_options options{.control = {}, .keep_cells = true};
    const Locus<2> locus = inputs.size() == 1 ? untrimmed_bisector(inputs[0], options)
                                              : untrimmed_bisector(inputs[0], inputs[1], options);
    const std::string svg = svg_of(locus, inputs);
    CHECK(fault_of(svg).empty());
    CHECK(fault_of(svg_of(locus)).empty());
    return svg;
  };
  const auto expect = [](const std::string& svg, const std::vector<const char*>& parts) {
    for (const char* part : parts) {
      INFO(part);
      CHECK(holds(svg, part));
    }
  };
  const Curve_2 spline = bspline_2(2, {{0, 0}, {1, 2}, {2, -1}, {3, 1}}, {0, 0, 0, 1, 2, 2, 2});
  const std::string self = pictured({spline});
  expect(self, {"of a curve with itself", "class=\"diagonal\"", "t = r", "u = 0", "u = 2", "end on the diagonal", "joint",
                "the curve<"});
  const std::string two = pictured({spline, segment_2({0, -2}, {3, -3})});
  for (const char* absent : {"class=\"diagonal\"", "t = r", "end on the diagonal", "the curve<"}) CHECK(!holds(two, absent));

  expect(pictured({circle_2({0, 0}, 1)}), {"equation vanishes", "url(#degenerate-hatch)", "u = 0, 4", "10 degenerate"});
  expect(pictured({line_2({0, 0}, {1, 0}), bezier_2({{-1, 1}, {0, 2}, {1, 1}})}), {"t → −∞", "t → ∞", ">−∞<", ">∞<"});
  expect(pictured({polyline_2({{0, 0}, {2, 0}, {3, 1}}), segment_2({0, 1}, {2, 2})}),
         {"end at a curve's corner", ">corner<"});
  expect(pictured({ellipse_2({0, 0}, 2, 1), ellipse_2({0, 0}, 5, 4)}), {"t = 0, 4", "r = 0, 4"});
  // Parallel segments a diagonal apart have no bisector and no cells; a picture says so.
  expect(pictured({polyline_2({{0, 0}, {1, 0}, {1, 1}}), segment_2({10, 10}, {11, 10})}), {"pieces proved apart"});
}

TEST_CASE("a picture's square: what it shows of a curve with itself, and where inputs overlap")
{
  detail::Parameter_square square;
  CHECK(detail::Square_drawing::outline(square).size() == 4);
  square.is_self = true;
  const auto triangle = detail::Square_drawing::outline(square);
  REQUIRE(triangle.size() == 3);
  for (const auto& p : triangle) CHECK(p.x >= p.y);

  const Curve_2 a = bezier_2({{0, 0}, {1, 2}, {3, 0}}), back = bezier_2({{3, 0}, {1, 2}, {0, 0}});
  const std::string rising = "M732 576L1232 76\"", falling = "M732 76L1232 576\"", dashed = "stroke-dasharray=\"7 5\"";
  const auto overlap_of = [&](const std::string& svg) {
    for (std::size_t at = svg.find(dashed); at != std::string::npos; at = svg.find(dashed, at + 1)) {
      const std::string path = svg.substr(svg.rfind('<', at), at - svg.rfind('<', at));
      if (holds(path, rising)) return "t = r";
      if (holds(path, falling)) return "t + r = 1";
    }
    return "none";
  };
  CHECK(overlap_of(svg_of(untrimmed_bisector(a, a), {a, a})) == std::string("t = r"));
  CHECK(overlap_of(svg_of(untrimmed_bisector(a, back), {a, back})) == std::string("t + r = 1"));
}

TEST_CASE("a self-bisector's JSON has each pair once, the greater parameter first")
{
  const Curve_2 spline = bspline_2(2, {{0, 0}, {1, 2}, {2, -1}, {3, 1}}, {0, 0, 0, 1, 2, 2, 2});
  const auto j = nlohmann::json::parse(json_of(untrimmed_bisector(spline)));
  CHECK(j["status"] == "certified");
  REQUIRE(!j["arcs"].empty());
  for (const auto& arc : j["arcs"]) {
    CHECK(arc["inputs"] == nlohmann::json::parse("[0, 0]"));
    for (const auto& s : arc["samples"]) CHECK(s["parameters"][0] >= s["parameters"][1]);
  }
  for (const auto& v : j["vertices"])
    for (const auto& foot : v["feet"]) CHECK(foot["input"] == 0);
}
