// SPDX-License-Identifier: LGPL-3.0-or-later
// Certificates of the example jobs are accepted; after any change that makes one false it is refused.

#include "../examples/locus_cli/read_certificate.h"

#include <locus/bisector_2.h>
#include <locus/check/checker.h>
#include <locus/io/certificate.h>
#include <locus/io/json_job.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace check = locus::check;
using check::Certificate;
using locus::Rational;

std::string text_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  return locus::read_json_text(in);
}

std::string certificate_of(const std::string& job_text)
{
  const locus::Job job = locus::read_job(job_text);
  locus::Bisector_options options;
  options.keep_evidence = true;
  const locus::Curve_2& first = *job.inputs[0].curve;
  const locus::Locus<2> result =
    job.inputs.size() == 1 ? locus::untrimmed_bisector(first, options) : locus::untrimmed_bisector(first, *job.inputs[1].curve, options);
  std::ostringstream out;
  locus::write_certificate(out, result, locus::parse_json(job_text));
  return out.str();
}

struct Example {
  std::string name;
  Certificate certificate;
};

/// Splines of which some pairs of pieces are proved by directions alone to have no zero.
constexpr const char* far_splines = R"({"compute": "bisector", "inputs": [
  {"curve": {"degree": 2, "control_points": [[0,0],["1/2","1/8"],["3/2",0],["5/2","1/8"],["7/2",0],[4,0]], "knots": [0,0,0,1,2,3,4,4,4]}},
  {"curve": {"degree": 2, "control_points": [[0,3],["1/2",3],["3/2","25/8"],["5/2",3],["7/2","25/8"],[4,3]], "knots": [0,0,0,1,2,3,4,4,4]}}],
  "options": {"trimmed": false}})";

/// The certificates of all example jobs, and of a pair of splines.
const std::vector<Example>& examples()
{
  static const std::vector<Example> all = [] {
    const char* root = std::getenv("LOCUS_SOURCE_DIR");
    std::vector<Example> list;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(root ? root : ".") / "examples" / "jobs"))
      if (entry.path().extension() == ".json")
        list.push_back({entry.path().stem().string(), locus_cli::read_certificate(certificate_of(text_of(entry.path())))});
    list.push_back({"far splines", locus_cli::read_certificate(certificate_of(far_splines))});
    std::sort(list.begin(), list.end(), [](const Example& a, const Example& b) { return a.name < b.name; });
    return list;
  }();
  return all;
}

/// The reason of a refusal, or nothing.
std::string refusal(const Certificate& c)
{
  try {
    check::check(c);
  } catch (const check::Refused& e) {
    return e.what();
  }
  return "";
}

// ------------------------------------------------------------------------------------------------------ corruptions

/// Ways to make a certificate false: the k-th change of one kind; false where there are not so many.
using Corrupt = std::function<bool(Certificate&, std::size_t)>;

struct Corruption {
  const char* name;
  Corrupt apply;
};

/// Calls `visit` with every patch until it returns true.
template <class Visit>
bool in_patches(Certificate& c, Visit visit)
{
  for (check::Patch& p : c.patches)
    if (visit(p)) return true;
  return false;
}

/// The k-th item of all patches' lists for which `suits` holds is changed by `change`.
template <class List, class Suits, class Change>
Corrupt change_item(List check::Patch::*list, Suits suits, Change change)
{
  return [=](Certificate& c, std::size_t k) {
    return in_patches(c, [&](check::Patch& p) {
      for (std::size_t i = 0; i < (p.*list).size(); ++i)
        if (suits(p, i) && k-- == 0) {
          change(p, i);
          return true;
        }
      return false;
    });
  };
}

bool always(const check::Patch&, std::size_t) { return true; }

void shift(check::Range& x)
{
  const Rational by = x.is_exact() ? Rational(1, 4096) : Rational(4 * (x.hi - x.lo));
  const Rational signed_by = x.hi + by > 1 ? Rational(-by) : by;
  x.lo += signed_by;
  x.hi += signed_by;
}

/// A coordinate that is enclosed or exact and not that of a face line: moving it leaves the zero set.
void shift_vertex(check::Patch& p, std::size_t i)
{
  check::Vertex& v = p.vertices[i];
  shift(v.at[v.at[0].is_exact() ? 1 : 0]);
}

bool has_kind(const check::Patch& p, std::size_t cell, check::Token::Kind kind) { return p.cells[cell].kind == kind; }

bool is_leaf_of(check::Token::Kind a, const check::Patch& p, std::size_t i) { return has_kind(p, i, a); }

/// A cut with a vertex on it that lies on no other line of cuts.
bool carries_vertex(const check::Patch& p, std::size_t i)
{
  const check::Token& t = p.cells[i];
  if (t.kind != check::Token::Kind::split) return false;
  const auto same = std::count_if(p.cells.begin(), p.cells.end(), [&](const check::Token& x) {
    return x.kind == check::Token::Kind::split && x.variable == t.variable && x.at == t.at;
  });
  return same == 1 && std::any_of(p.vertices.begin(), p.vertices.end(), [&](const check::Vertex& v) {
           const check::Range& x = v.at[check::cast(t.variable)];
           return !v.cell && x.is_exact() && x.lo == t.at && !v.at[check::cast(1 - t.variable)].is_exact();
         });
}

std::size_t nonzero(const std::vector<locus::Integer>& c)
{
  return static_cast<std::size_t>(std::count_if(c.begin(), c.end(), [](const locus::Integer& x) { return x != 0; }));
}

std::vector<Corruption> corruptions_of_cells()
{
  using Kind = check::Token::Kind;
  const auto leaf = [](Kind kind) { return [kind](const check::Patch& p, std::size_t i) { return is_leaf_of(kind, p, i); }; };
  const auto flip = [](check::Patch& p, std::size_t i) { p.cells[i].sign = -p.cells[i].sign; };
  return {
    {"flip an empty cell's sign", change_item(&check::Patch::cells, leaf(Kind::empty), flip)},
    {"flip a graph cell's sign", change_item(&check::Patch::cells, leaf(Kind::graph), flip)},
    {"relabel a graph cell as empty", change_item(&check::Patch::cells, leaf(Kind::graph), [](check::Patch& p, std::size_t i) { p.cells[i].kind = Kind::empty; })},
    {"relabel a singular cell as a graph", change_item(&check::Patch::cells, leaf(Kind::singular),
                                                       [](check::Patch& p, std::size_t i) {
                                                         p.cells[i].kind = Kind::graph;
                                                         p.cells[i].sign = 1;
                                                       })},
    {"name another singular point", change_item(&check::Patch::cells, leaf(Kind::singular), [](check::Patch& p, std::size_t i) { ++p.cells[i].index; })},
    {"move a cut out of its cell", change_item(&check::Patch::cells, leaf(Kind::split), [](check::Patch& p, std::size_t i) { p.cells[i].at += 2; })},
    {"move a cut that carries a vertex", change_item(&check::Patch::cells, carries_vertex, [](check::Patch& p, std::size_t i) { p.cells[i].at += Rational(1, 1 << 30); })},
    {"drop a cell", change_item(&check::Patch::cells, always, [](check::Patch& p, std::size_t i) { p.cells.erase(p.cells.begin() + static_cast<std::ptrdiff_t>(i)); })},
    {"add a cell", change_item(&check::Patch::cells, always, [](check::Patch& p, std::size_t i) { p.cells.insert(p.cells.begin() + static_cast<std::ptrdiff_t>(i), p.cells[i]); })},
  };
}

std::vector<Corruption> corruptions_of_vertices()
{
  const auto on_side = [](const check::Patch& p, std::size_t i) { return !p.vertices[i].cell; };
  const auto singular = [](const check::Patch& p, std::size_t i) { return p.vertices[i].cell && p.vertices[i].kind != check::Vertex_kind::mark; };
  const auto is_algebraic = [](const check::Patch& p, std::size_t i) { return p.singular[i].algebraic.has_value(); };
  const auto inner = [](const check::Patch& p, std::size_t i) { return p.vertices[i].kind == check::Vertex_kind::crossing; };
  std::vector<Corruption> list{
    {"move a vertex", change_item(&check::Patch::vertices, on_side, shift_vertex)},
    {"move a singular vertex", change_item(&check::Patch::vertices, singular, shift_vertex)},
    {"let arcs stop at a crossing", change_item(&check::Patch::vertices, inner, [](check::Patch& p, std::size_t i) { p.vertices[i].stops = true; })},
    {"move a zero on the diagonal", change_item(&check::Patch::diagonal, always, [](check::Patch& p, std::size_t i) { shift(p.diagonal[i].at); })},
    {"drop a zero on the diagonal", change_item(&check::Patch::diagonal, always, [](check::Patch& p, std::size_t i) { p.diagonal.erase(p.diagonal.begin() + static_cast<std::ptrdiff_t>(i)); })},
    {"move a singular point", change_item(&check::Patch::singular, always,
                                          [](check::Patch& p, std::size_t i) {
                                            check::Singular& s = p.singular[i];
                                            shift(s.at[s.at[0].is_exact() && !s.at[1].is_exact() ? 1 : 0]);
                                            if (!s.algebraic) return;
                                            s.algebraic->lo = s.at[0].lo, s.algebraic->hi = s.at[0].hi;
                                            s.algebraic->r_lo = s.at[1].lo, s.algebraic->r_hi = s.at[1].hi;
                                          })},
    {"change what defines a singular point", change_item(&check::Patch::singular, is_algebraic, [](check::Patch& p, std::size_t i) { p.singular[i].algebraic->m[0] += 1; })},
    {"change what defines its second coordinate", change_item(&check::Patch::singular, is_algebraic, [](check::Patch& p, std::size_t i) { p.singular[i].algebraic->h[0].assign(1, Rational(1, 9)); })},
    {"drop a piece", change_item(&check::Patch::pieces, always, [](check::Patch& p, std::size_t i) { p.pieces.erase(p.pieces.begin() + static_cast<std::ptrdiff_t>(i)); })},
    {"turn a piece", change_item(&check::Patch::pieces, always, [](check::Patch& p, std::size_t i) { std::swap(p.pieces[i].from, p.pieces[i].to); })},
    {"put a piece into another cell", change_item(&check::Patch::pieces, always, [](check::Patch& p, std::size_t i) { ++p.pieces[i].cell; })},
    {"drop or keep a piece", change_item(&check::Patch::pieces, always, [](check::Patch& p, std::size_t i) { p.pieces[i].dropped = !p.pieces[i].dropped; })},
  };
  constexpr const char* names[] = {"call a vertex a crossing", "call a vertex a boundary", "call a vertex isolated", "call a vertex a node",
                                   "call a vertex an end", "call a vertex a mark", "call a vertex open"};
  for (int kind = 0; kind < 7; ++kind)
    list.push_back({names[kind], change_item(
                                                &check::Patch::vertices,
                                                [kind](const check::Patch& p, std::size_t i) { return static_cast<int>(p.vertices[i].kind) != kind; },
                                                [kind](check::Patch& p, std::size_t i) { p.vertices[i].kind = static_cast<check::Vertex_kind>(kind); })});
  return list;
}

/// Drops a vertex and all that names it: the zero is then not listed.
bool drop_vertex(Certificate& c, std::size_t k)
{
  for (std::size_t n = 0; n < c.patches.size(); ++n) {
    check::Patch& p = c.patches[n];
    if (k >= p.vertices.size()) {
      k -= p.vertices.size();
      continue;
    }
    p.vertices.erase(p.vertices.begin() + static_cast<std::ptrdiff_t>(k));
    std::vector<std::size_t> number;
    std::vector<check::Patch_piece> kept;
    for (const check::Patch_piece& piece : p.pieces) {
      number.push_back(kept.size());
      if (piece.from == k || piece.to == k) {
        number.back() = check::none;
        continue;
      }
      kept.push_back(piece);
      for (std::size_t* v : {&kept.back().from, &kept.back().to}) *v -= *v > k;
    }
    p.pieces = kept;
    for (check::Arc& arc : c.arcs) {
      std::vector<check::Step> steps;
      for (check::Step s : arc.steps) {
        if (s.patch == n && number[s.piece] == check::none) continue;
        if (s.patch == n) s.piece = number[s.piece];
        steps.push_back(s);
      }
      arc.steps = steps;
    }
    std::erase_if(c.arcs, [](const check::Arc& arc) { return arc.steps.empty(); });
    return true;
  }
  return false;
}

std::vector<Corruption> corruptions_of_equations()
{
  const auto patch_change = [](auto suits, auto change) -> Corrupt {
    return [=](Certificate& c, std::size_t k) {
      return in_patches(c, [&](check::Patch& p) {
        if (!suits(p) || k-- != 0) return false;
        change(p);
        return true;
      });
    };
  };
  const auto is_equation = [](const check::Patch& p) { return !p.vanishes && nonzero(p.equation.c) > 1; };
  const auto has_line = [](const check::Patch& p) { return !p.lines.empty(); };
  const auto has_chart = [](const check::Patch& p) { return !p.chart.is_plain; };
  const auto has_factor = [](const check::Patch& p) { return p.factor[0].size() > 1 || p.factor[1].size() > 1; };
  const auto factor_of = [](check::Patch& p) -> std::size_t { return p.factor[0].size() > 1 ? 0 : 1; };
  return {
    {"change an equation's coefficient", patch_change(is_equation, [](check::Patch& p) { p.equation.c[p.equation.c.size() / 2] += 1; })},
    {"turn an equation", patch_change(is_equation, [](check::Patch& p) { for (auto& x : p.equation.c) x = -x; })},
    {"let an equation vanish", patch_change(is_equation, [](check::Patch& p) { p.vanishes = true; })},
    {"change a factor", patch_change(has_factor, [=](check::Patch& p) { p.factor[factor_of(p)][0] += 1; })},
    {"forget a factor", patch_change(has_factor, [=](check::Patch& p) { p.factor[factor_of(p)] = {locus::Integer(1)}; })},
    {"say of a factor what is not so", patch_change(has_factor, [=](check::Patch& p) { p.degenerate[factor_of(p)] = !p.degenerate[factor_of(p)]; })},
    {"change a multiplicity", patch_change(has_line, [](check::Patch& p) { ++p.lines[0].power; })},
    {"change a line", patch_change(has_line, [](check::Patch& p) { p.lines[0].line.ratio += 1; })},
    {"mirror a line", patch_change(has_line, [](check::Patch& p) { p.lines[0].line.reversed = !p.lines[0].line.reversed; })},
    {"change a chart", patch_change(has_chart, [](check::Patch& p) { ++p.chart.exponent[0][0]; })},
    {"blow up another corner", patch_change(has_chart, [](check::Patch& p) { p.chart.corner[0] = 1 - p.chart.corner[0]; })},
    {"give a patch another pair", patch_change([](const check::Patch&) { return true; }, [](check::Patch& p) { ++p.pair[1]; })},
  };
}

std::vector<Corruption> corruptions_of_inputs()
{
  const auto curve_change = [](auto change) -> Corrupt {
    return [=](Certificate& c, std::size_t k) { return k < c.curves.size() && change(c.curves[k]); };
  };
  const auto coordinate = [](std::size_t axis) {
    return [axis](check::Curve& c) {
      std::vector<Rational>& powers = c.input.power[axis];
      if (c.input.is_monomial) return !powers.empty() && (powers[0] += Rational(1, 7), true);
      c.input.points[c.input.points.size() / 2][axis] += Rational(1, 7);
      return true;
    };
  };
  return {
    {"change an x coordinate", curve_change(coordinate(0))},
    {"change a y coordinate", curve_change(coordinate(1))},
    {"change a weight", curve_change([](check::Curve& c) { return !c.input.weights.empty() && (c.input.weights[0] *= 3, true); })},
    {"change a piece", curve_change([](check::Curve& c) {
       check::Powers& x = c.pieces[0].point[0];
       if (x.empty()) x.resize(1);
       return x[0] += 1, true;
     })},
    {"change a range", curve_change([](check::Curve& c) { return c.pieces[0].hi && (*c.pieces[0].hi += Rational(1, 3), true); })},
    {"turn a tangent", curve_change([](check::Curve& c) {
       for (auto& f : c.pieces[0].tangent)
         for (auto& x : f) x = -x;
       return true;
     })},
    {"bend a tangent", curve_change([](check::Curve& c) {
       auto& a = c.pieces[0].tangent;
       const std::size_t v = a[1].empty() ? 1 : 0;
       if (a[v].empty()) a[v].resize(1);
       return a[v][0] += 1, true;
     })},
    {"change a joint", [](Certificate& c, std::size_t k) {
       for (check::Curve& curve : c.curves)
         for (check::Joint& j : curve.joints)
           if (j != check::Joint::tolerance && k-- == 0) return j = j == check::Joint::smooth ? check::Joint::corner : check::Joint::smooth, true;
       return false;
     }},
    {"drop a joint", [](Certificate& c, std::size_t k) { return k < c.curves.size() && !c.curves[k].joints.empty() && (c.curves[k].joints.pop_back(), true); }},
    {"forget an empty pair", [](Certificate& c, std::size_t k) { return k < c.empty_pairs.size() && (c.empty_pairs.erase(c.empty_pairs.begin() + static_cast<std::ptrdiff_t>(k)), true); }},
    {"list a pair twice", [](Certificate& c, std::size_t k) { return k < c.patches.size() && (c.empty_pairs.push_back(c.patches[k].pair), true); }},
    {"forget a pair", [](Certificate& c, std::size_t k) { return k == 0 && !c.patches.empty() && c.lines.empty() && (c.patches.pop_back(), true); }},
  };
}

std::vector<Corruption> corruptions_of_arcs()
{
  const auto arc_change = [](auto suits, auto change) -> Corrupt {
    return [=](Certificate& c, std::size_t k) {
      for (std::size_t i = 0; i < c.arcs.size(); ++i)
        if (suits(c.arcs[i]) && k-- == 0) return change(c, i), true;
      return false;
    };
  };
  const auto any = [](const check::Arc&) { return true; };
  const auto is_long = [](const check::Arc& a) { return a.steps.size() > 2; };
  const auto is_open_and_long = [](const check::Arc& a) { return a.steps.size() > 2 && !a.closed; };
  const auto line_change = [](auto change) -> Corrupt {
    return [=](Certificate& c, std::size_t k) { return k < c.lines.size() && change(c.lines[k]); };
  };
  return {
    {"drop an arc", arc_change(any, [](Certificate& c, std::size_t i) { c.arcs.erase(c.arcs.begin() + static_cast<std::ptrdiff_t>(i)); })},
    {"list an arc twice", arc_change(any, [](Certificate& c, std::size_t i) { c.arcs.push_back(check::Arc(c.arcs[i])); })},
    {"turn one step of an arc", arc_change(is_long, [](Certificate& c, std::size_t i) { c.arcs[i].steps[1].reversed = !c.arcs[i].steps[1].reversed; })},
    {"swap two steps of an arc", arc_change(is_open_and_long, [](Certificate& c, std::size_t i) { std::swap(c.arcs[i].steps[0], c.arcs[i].steps[2]); })},
    {"swap the ends of two arcs", arc_change(is_open_and_long,
                                             [](Certificate& c, std::size_t i) {
                                               const std::size_t j = (i + 1) % c.arcs.size();
                                               if (i == j) c.arcs[i].steps.pop_back();
                                               else std::swap(c.arcs[i].steps.back(), c.arcs[j].steps.back());
                                             })},
    {"cut an arc", arc_change(is_open_and_long,
                              [](Certificate& c, std::size_t i) {
                                check::Arc rest;
                                rest.steps.assign(c.arcs[i].steps.begin() + 1, c.arcs[i].steps.end());
                                c.arcs[i].steps.resize(1);
                                c.arcs.push_back(rest);
                              })},
    {"close an open arc", [](Certificate& c, std::size_t k) { // of one cell, where different ends are different places
       return c.patches.size() == 1 && k < c.arcs.size() && !c.arcs[k].closed && (c.arcs[k].closed = true);
     }},
    {"open a closed arc", arc_change([](const check::Arc& a) { return a.closed; }, [](Certificate& c, std::size_t i) { c.arcs[i].closed = false; })},
    {"drop a vertex", drop_vertex},
    {"drop a line", [](Certificate& c, std::size_t k) { return k < c.lines.size() && (c.lines.erase(c.lines.begin() + static_cast<std::ptrdiff_t>(k)), true); }},
    {"let a line meet nothing", line_change([](check::Line_patch& l) {
       const auto met = std::find_if(l.meets.begin(), l.meets.end(), [](const auto& m) { return m.has_value(); });
       return met != l.meets.end() && (met->reset(), true);
     })},
    {"move a line's meeting", line_change([](check::Line_patch& l) {
       for (std::size_t v = 0; v < l.meets.size(); ++v)
         if (l.meets[v]) return shift(l.vertices[v]), true;
       return false;
     })},
    {"drop a line's last vertex", line_change([](check::Line_patch& l) {
       l.vertices.pop_back();
       l.meets.pop_back();
       l.stops.pop_back();
       l.dropped.pop_back();
       return true;
     })},
  };
}

std::vector<Corruption> all_corruptions()
{
  std::vector<Corruption> all;
  for (const auto& list : {corruptions_of_cells(), corruptions_of_vertices(), corruptions_of_equations(), corruptions_of_inputs(), corruptions_of_arcs()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

} // namespace

TEST_CASE("certificates of all example jobs are accepted")
{
  REQUIRE(examples().size() > 20);
  for (const Example& e : examples()) {
    INFO(e.name);
    CHECK(refusal(e.certificate).empty());
    check::Summary s;
    CHECK_NOTHROW(s = check::check(e.certificate));
    CHECK(s.undecided == e.certificate.undecided.size());
  }
}

TEST_CASE("a certificate's text is refused where it breaks off or has another form")
{
  const std::string text = certificate_of(far_splines);
  CHECK_FALSE(locus_cli::read_certificate(text).patches.empty());
  for (std::size_t n = 0; n < text.size() - 3; n += text.size() / 97) CHECK_THROWS_AS(locus_cli::read_certificate(text.substr(0, n)), locus::Invalid_input);
  for (const char* key : {"curves", "patches", "cells", "vertices", "pieces", "equation", "degrees", "tangent", "arcs", "steps", "solve_seconds"}) {
    std::string other = text;
    other.replace(other.find('"' + std::string(key) + '"') + 1, 1, "_");
    CHECK_THROWS_AS(locus_cli::read_certificate(other), locus::Invalid_input);
  }
}

TEST_CASE("a cubic pair's certificate is small")
{
  const char* root = std::getenv("LOCUS_SOURCE_DIR");
  const std::string job = text_of(std::filesystem::path(root ? root : ".") / "examples" / "jobs" / "cubic_cubic.json");
  CHECK(certificate_of(job).size() < 100000);
}

TEST_CASE("a certificate that was made false is refused")
{
  constexpr std::size_t most = 12; // changes of one kind in one certificate
  for (const Corruption& corruption : all_corruptions()) {
    std::size_t made = 0;
    for (const Example& e : examples())
      for (std::size_t k = 0; k < most; ++k) {
        Certificate c = e.certificate;
        if (!corruption.apply(c, k)) break;
        ++made;
        const std::string reason = refusal(c);
        if (!reason.empty()) continue;
        INFO(corruption.name << " " << k << " in " << e.name);
        CHECK(!reason.empty());
      }
    INFO(corruption.name);
    CHECK(made > 0);
  }
}
