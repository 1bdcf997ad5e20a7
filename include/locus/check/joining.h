// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_JOINING_H
#define LOCUS_CHECK_JOINING_H

#include <locus/check/cells.h>

#include <map>
#include <numeric>

namespace locus {
namespace check {

/// How the patches lie beside each other: every pair of pieces is covered, vertices that are one place of the domain are found
/// out from their coordinates, and the listed arcs are the maximal chains of pieces through them.
class Joining_check {
public:
  explicit Joining_check(const Certificate& c) : c_(c), second_(c.curve(1).pieces.size()) {}

  void run()
  {
    check_cover();
    number_vertices();
    for (std::size_t k = 0; k < c_.patches.size(); ++k) check_divided_lines(k);
    for (std::size_t k = 0; k < c_.lines.size(); ++k) check_line(k);
    note_places();
    match_sides();
    match_seams();
    settle_classes();
    check_arcs();
  }

private:
  using Member = std::array<std::size_t, 2>; ///< patch (lines after patches), vertex
  using Side = std::array<std::size_t, 3>;   ///< cell, fixed variable, end
  struct Place {
    Member member;
    Range along;
  };

  std::size_t cell_of(const std::array<std::size_t, 2>& pair) const { return pair[0] * second_ + pair[1]; }
  static std::string named(const std::array<std::size_t, 2>& pair) { return "pair " + std::to_string(pair[0]) + ", " + std::to_string(pair[1]); }

  // -------------------------------------------------------------------------------------------------------- cover

  void check_cover()
  {
    std::map<std::array<std::size_t, 2>, std::vector<std::size_t>> patches;
    for (std::size_t k = 0; k < c_.patches.size(); ++k) patches[c_.patches[k].pair].push_back(k);
    for (const auto& pair : c_.empty_pairs) {
      if (!patches.insert({pair, {}}).second) throw Refused(named(pair) + ": listed twice");
      const Pair equations(c_.curve(0).pieces[pair[0]], c_.curve(1).pieces[pair[1]]);
      if (!has_no_zero(bernstein(equations.angle_form()), 30)) throw Refused(named(pair) + ": is not proved to be empty");
    }
    for (std::size_t i = 0; i < c_.curve(0).pieces.size(); ++i)
      for (std::size_t j = 0; j < (c_.is_self() ? i + 1 : second_); ++j) {
        const auto found = patches.find({i, j});
        if (found == patches.end()) throw Refused(named({i, j}) + ": is not there");
        if (!found->second.empty() && !is_covered(found->second, c_.is_self() && i == j)) throw Refused(named({i, j}) + ": its charts do not cover it");
        for (const std::size_t p : found->second) patch_of_[cell_of({i, j})] = p;
        patches.erase(found);
      }
    if (!patches.empty()) throw Refused(named(patches.begin()->first) + ": is none");
  }

  /// One plain chart, or charts around one corner; of a piece with itself those with t ≥ r.
  bool is_covered(const std::vector<std::size_t>& patches, bool is_self) const
  {
    std::vector<Chart> charts;
    for (const std::size_t p : patches) charts.push_back(c_.patches[p].chart);
    if (charts[0].is_plain) return charts.size() == 1;
    const auto corner = charts[0].corner;
    for (const Chart& chart : charts)
      if (chart.is_plain || chart.corner != corner) return false;
    if (is_self && corner[0] != corner[1]) return false;
    std::size_t used = 0;
    bool covered = true;
    for (const bool first : {true, false}) {
      if (is_self && first != (corner[0] == 1)) continue;
      covered = covered && covers(charts, first ? Exponents{{{1, 1}, {0, 1}}} : Exponents{{{0, 1}, {1, 1}}}, 8, used);
    }
    return covered && used == charts.size();
  }

  using Exponents = std::array<std::array<int, 2>, 2>;

  /// A chart is there, or the two charts of its own corner's blow-up are covered.
  static bool covers(const std::vector<Chart>& charts, const Exponents& e, int depth, std::size_t& used)
  {
    for (const Chart& chart : charts)
      if (chart.exponent == e) return ++used, true;
    if (depth == 0) return false;
    for (std::size_t k = 0; k < 2; ++k) {
      Exponents part;
      for (std::size_t v = 0; v < 2; ++v) part[v] = {e[v][k], e[v][0] + e[v][1]};
      if (!covers(charts, part, depth - 1, used)) return false;
    }
    return true;
  }

  // ----------------------------------------------------------------------------------------------------- vertices

  std::size_t vertices_of(std::size_t patch) const
  {
    return patch < c_.patches.size() ? c_.patches[patch].vertices.size() : c_.lines[patch - c_.patches.size()].vertices.size();
  }
  std::size_t pieces_of(std::size_t patch) const
  {
    return patch < c_.patches.size() ? c_.patches[patch].pieces.size() : c_.lines[patch - c_.patches.size()].dropped.size();
  }
  std::size_t patches() const { return c_.patches.size() + c_.lines.size(); }
  const std::array<std::size_t, 2>& pair_of(std::size_t patch) const
  {
    return patch < c_.patches.size() ? c_.patches[patch].pair : c_.lines[patch - c_.patches.size()].pair;
  }
  bool is_dropped(std::size_t patch, std::size_t piece) const
  {
    return patch < c_.patches.size() ? c_.patches[patch].pieces[piece].dropped : c_.lines[patch - c_.patches.size()].dropped[piece] != 0;
  }
  Member end_of(std::size_t patch, std::size_t piece, bool target) const
  {
    if (patch >= c_.patches.size()) return {patch, piece + target};
    const Patch_piece& p = c_.patches[patch].pieces[piece];
    return {patch, target ? p.to : p.from};
  }
  const Vertex* vertex(const Member& m) const { return m[0] < c_.patches.size() ? &c_.patches[m[0]].vertices[m[1]] : nullptr; }

  void number_vertices()
  {
    std::size_t n = 0;
    for (std::size_t p = 0; p < patches(); ++p) {
      first_.push_back(n);
      n += vertices_of(p);
    }
    corners_ = n;
    parent_.resize(n + 4 * c_.curve(0).pieces.size() * second_); // places, then the cells' corners
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    stops_.assign(parent_.size(), 0);
  }

  std::size_t id(const Member& m) const { return first_[m[0]] + m[1]; }
  std::size_t corner_id(std::size_t cell, int a, int b) const { return corners_ + 4 * cell + 2 * cast(a) + cast(b); }
  std::size_t find(std::size_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

  /// Local parameters: exact where all that they depend on is.
  std::array<Range, 2> local(const Member& m) const
  {
    if (const Vertex* v = vertex(m)) return through_chart(c_.patches[m[0]].chart, v->at);
    const Line_patch& l = c_.lines[m[0] - c_.patches.size()];
    const Range& x = l.vertices[m[1]];
    if (!l.corner) return {x, ordered(partner_of(l.line, x.lo), partner_of(l.line, x.hi))};
    std::array<Range, 2> at;
    for (std::size_t k = 0; k < 2; ++k) at[k] = (*l.corner)[k] == 0 ? x : Range{1 - x.hi, 1 - x.lo};
    return at;
  }

  static Range ordered(const Rational& a, const Rational& b) { return a < b ? Range{a, b} : Range{b, a}; }

  static std::array<Range, 2> through_chart(const Chart& chart, const std::array<Range, 2>& x)
  {
    if (chart.is_plain) return x;
    std::array<Range, 2> at;
    for (std::size_t v = 0; v < 2; ++v) {
      Range p{1, 1};
      for (std::size_t k = 0; k < 2; ++k)
        for (int i = 0; i < chart.exponent[v][k]; ++i) p = {p.lo * x[k].lo, p.hi * x[k].hi};
      at[v] = chart.corner[v] == 0 ? p : Range{1 - p.hi, 1 - p.lo};
    }
    return at;
  }

  static int end_at(const Range& x) { return !x.is_exact() ? -1 : x.lo == 0 ? 0 : x.lo == 1 ? 1 : -1; }

  /// Sorts vertices onto the sides and corners of their cells, and finds out where arcs may end.
  void note_places()
  {
    for (std::size_t p = 0; p < patches(); ++p)
      for (std::size_t v = 0; v < vertices_of(p); ++v) {
        const Member m{p, v};
        const std::array<Range, 2> at = local(m);
        const std::array<int, 2> end{end_at(at[0]), end_at(at[1])};
        const std::size_t cell = cell_of(pair_of(p));
        if (end[0] >= 0 && end[1] >= 0) unite(id(m), corner_id(cell, end[0], end[1]));
        for (std::size_t k = 0; k < 2; ++k)
          if (end[k] >= 0 && end[1 - k] < 0) sides_[{cell, k, cast(end[k])}].push_back({m, at[1 - k]});
        if (may_stop(m, end)) stops_[id(m)] = 1;
      }
    for (auto& [side, list] : sides_) sort(list);
  }

  static void sort(std::vector<Place>& list)
  {
    std::sort(list.begin(), list.end(), [](const Place& a, const Place& b) { return a.along.lo < b.along.lo; });
  }

  bool may_stop(const Member& m, const std::array<int, 2>& end) const
  {
    const auto& pair = pair_of(m[0]);
    for (std::size_t k = 0; k < 2; ++k)
      if (end[k] >= 0 && !behind({cell_of(pair), k, cast(end[k])})) return true;
    const Vertex* v = vertex(m);
    if (!v) { // where a line meets the other factor, or goes to infinity
      const Line_patch& l = c_.lines[m[0] - c_.patches.size()];
      return l.stops[m[1]] || l.meets[m[1]];
    }
    if (v->stops || v->kind == Vertex_kind::node || v->kind == Vertex_kind::end || v->kind == Vertex_kind::mark || v->kind == Vertex_kind::open) return true;
    const Chart& chart = c_.patches[m[0]].chart;
    for (std::size_t k = 0; k < 2; ++k) {
      if (is_exceptional(chart, k) && v->at[k].is_exact() && v->at[k].lo == 0) return true;
      if (is_diagonal_edge(m[0], k) && v->at[k].is_exact() && v->at[k].lo == 1) return true;
    }
    return c_.is_self() && end[0] >= 0 && end[1] >= 0;
  }

  /// The line x_k = 1 that a chart of a piece with itself has on the diagonal.
  bool is_diagonal_edge(std::size_t patch, std::size_t k) const
  {
    const Patch& p = c_.patches[patch];
    return c_.is_self() && p.pair[0] == p.pair[1] && !p.chart.is_plain && ray(p.chart, k) == std::array<int, 2>{1, 1};
  }

  /// The powers with which the other coordinate runs along the edge x_k = 1.
  static std::array<int, 2> ray(const Chart& chart, std::size_t k) { return {chart.exponent[0][1 - k], chart.exponent[1][1 - k]}; }

  // --------------------------------------------------------------------------------------------------------- lines

  /// A line that was divided out once is there once, as a chain from end to end that meets the rest in all their common zeros.
  void check_line(std::size_t k)
  {
    const Line_patch& l = c_.lines[k];
    const std::string where = "line " + std::to_string(k);
    if (l.vertices.size() < 2 || l.dropped.size() + 1 != l.vertices.size() || l.meets.size() != l.vertices.size() || l.stops.size() != l.vertices.size())
      throw Refused(where + ": is incomplete");
    if (end_at(l.vertices.front()) != 0 || end_at(l.vertices.back()) != 1) throw Refused(where + ": does not reach from end to end");
    for (std::size_t v = 0; v + 1 < l.vertices.size(); ++v)
      if (!(l.vertices[v].hi < l.vertices[v + 1].lo) || l.vertices[v].lo > l.vertices[v].hi) throw Refused(where + ": its vertices are not in order");
    if (l.corner && (l.line.ratio != 1 || l.line.reversed != ((*l.corner)[0] != (*l.corner)[1]))) throw Refused(where + ": misses its corner");
    for (std::size_t other = 0; other < k; ++other)
      if (c_.lines[other].pair == l.pair && is_same(c_.lines[other].line, l.line)) throw Refused(where + ": is there twice");
    check_halves(l, where);
    bool found = false;
    for (std::size_t p = 0; p < c_.patches.size(); ++p) {
      if (c_.patches[p].pair != l.pair) continue;
      found = true;
      if (!is_divided_by(c_.patches[p], l.line)) throw Refused(where + ": was not divided out of patch " + std::to_string(p));
      if (c_.patches[p].chart.is_plain == l.corner.has_value()) throw Refused(where + ": is in other coordinates than its pair");
      if (!l.corner) meet_in_cell(k, p);
      else meet_on_edge(k, p);
    }
    if (!found) throw Refused(where + ": belongs to no patch");
  }

  /// What was divided out once is listed apart; more often, it is where the inputs overlap.
  void check_divided_lines(std::size_t patch) const
  {
    for (const Divided_line& l : c_.patches[patch].lines)
      if (l.power == 1 && std::none_of(c_.lines.begin(), c_.lines.end(), [&](const Line_patch& x) {
            return x.pair == c_.patches[patch].pair && is_same(x.line, l.line);
          }))
        throw Refused("patch " + std::to_string(patch) + ": a line that was divided out is not listed");
  }

  static bool is_same(const Line& a, const Line& b) { return a.reversed == b.reversed && a.ratio == b.ratio; }
  static bool is_divided_by(const Patch& p, const Line& line)
  {
    return std::any_of(p.lines.begin(), p.lines.end(), [&](const Divided_line& l) { return l.power == 1 && is_same(l.line, line); });
  }

  /// Of a piece with itself the half beyond the diagonal is dropped; the line crosses the diagonal once, in a vertex.
  void check_halves(const Line_patch& l, const std::string& where) const
  {
    const bool is_halved = c_.is_self() && l.pair[0] == l.pair[1];
    for (std::size_t k = 0; k < l.dropped.size(); ++k) {
      if (!is_halved && l.dropped[k]) throw Refused(where + ": a piece is dropped");
      const Rational &lo = l.vertices[k].hi, &hi = l.vertices[k + 1].lo;
      if (is_halved && (l.dropped[k] ? hi > partner_of(l.line, hi) : lo < partner_of(l.line, lo))) throw Refused(where + ": a piece on the wrong side is kept or dropped");
    }
  }

  void meet_in_cell(std::size_t line, std::size_t patch)
  {
    const Line_patch& l = c_.lines[line];
    std::vector<Line_point> points;
    for (std::size_t v = 0; v < l.vertices.size(); ++v) {
      if (!l.meets[v]) continue;
      if ((*l.meets[v])[0] != patch) throw Refused("line " + std::to_string(line) + ": meets another patch");
      points.push_back({l.vertices[v], (*l.meets[v])[1]});
      unite(id({c_.patches.size() + line, v}), id(*l.meets[v]));
    }
    const auto kept = std::find(l.dropped.begin(), l.dropped.end(), 0); // what lies beyond the diagonal is not wanted
    Patch_check(c_, patch).check_roots_on_line(l.line, points, l.vertices[cast(static_cast<int>(kept - l.dropped.begin()))].lo);
  }

  /// Where a line through a blown-up corner is the edge of a chart, the chart's vertices there are its meetings.
  void meet_on_edge(std::size_t line, std::size_t patch)
  {
    const Line_patch& l = c_.lines[line];
    const Patch& p = c_.patches[patch];
    for (std::size_t k = 0; k < 2; ++k) {
      if (ray(p.chart, k) != std::array<int, 2>{1, 1}) continue;
      const Powers f = on_value(p.equation, static_cast<int>(k), 1);
      for (std::size_t w = 0; w < p.vertices.size(); ++w) {
        const Vertex& x = p.vertices[w];
        if (!x.at[k].is_exact() || x.at[k].lo != 1 || (x.at[1 - k].is_exact() && (x.at[1 - k].lo == 0 || x.at[1 - k].lo == 1))) continue;
        std::size_t there = none;
        for (std::size_t v = 0; v < l.vertices.size(); ++v)
          if (l.meets[v] && are_one_root(f, l.vertices[v], x.at[1 - k])) there = v;
        if (there == none) throw Refused("line " + std::to_string(line) + ": does not list where it meets patch " + std::to_string(patch));
        unite(id({c_.patches.size() + line, there}), id({patch, w}));
      }
    }
  }

  static bool has_one_root(const Powers& f, const Range& x)
  {
    if (x.is_exact()) return sign_at(f, x.lo) == 0;
    return sign_at(f, x.lo) != 0 && sign_at(f, x.hi) != 0 && roots_between(f, x.lo, x.hi) == 1;
  }

  /// Two ranges have one root each, and it is the same.
  static bool are_one_root(const Powers& f, const Range& a, const Range& b)
  {
    if (a.hi < b.lo || b.hi < a.lo || f.empty()) return false;
    return has_one_root(f, a) && has_one_root(f, b) && has_one_root(f, {std::min(a.lo, b.lo), std::max(a.hi, b.hi)});
  }

  // ---------------------------------------------------------------------------------------------------- neighbours

  struct Behind {
    Side side;
    bool by_tolerance;
  };

  /// The joint at an end of a piece of curve k.
  const Joint* joint(std::size_t k, std::size_t piece, std::size_t end) const
  {
    const Curve& curve = c_.curve(k);
    const std::size_t n = curve.pieces.size();
    const std::size_t at = end == 1 ? piece : (piece + n - 1) % n;
    return at < curve.joints.size() && (end == 1 || piece > 0 || curve.joints.size() == n) ? &curve.joints[at] : nullptr;
  }

  /// The side of another cell that is one line of the domain with this one, if the curve goes on there.
  std::optional<Behind> behind(const Side& s) const
  {
    const std::size_t i = s[0] / second_, j = s[0] % second_, n = c_.curve(0).pieces.size();
    if (c_.is_self() && i == j && (s[1] == 0) == (s[2] == 0)) return std::nullopt; // beyond the diagonal
    const Joint* const at = joint(s[1], s[1] == 0 ? i : j, s[2]);
    if (!at || *at == Joint::corner) return std::nullopt;
    const bool by_tolerance = *at == Joint::tolerance;
    // Of a curve with itself the parameters change places across the seam.
    if (c_.is_self() && s[1] == 0 && s[2] == 1 && i + 1 == n) return Behind{{cell_of({j, 0}), 1, 0}, by_tolerance};
    if (c_.is_self() && s[1] == 1 && s[2] == 0 && j == 0) return Behind{{cell_of({n - 1, i}), 0, 1}, by_tolerance};
    const std::size_t size = s[1] == 0 ? n : second_, next = ((s[1] == 0 ? i : j) + (s[2] == 1 ? 1 : size - 1)) % size;
    return Behind{{s[1] == 0 ? cell_of({next, j}) : cell_of({i, next}), s[1], 1 - s[2]}, by_tolerance};
  }

  void match_sides()
  {
    const std::size_t cells = c_.curve(0).pieces.size() * second_;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      if (c_.is_self() && cell / second_ < cell % second_) continue;
      for (std::size_t v = 0; v < 2; ++v)
        for (std::size_t end = 0; end < 2; ++end) {
          const Side side{cell, v, end};
          const auto other = behind(side);
          if (!other || other->side < side) continue;
          match(side, other->side, other->by_tolerance);
          for (const int along : {0, 1}) unite(corner_of(side, along), corner_of(other->side, along));
        }
    }
  }

  std::size_t corner_of(const Side& s, int along) const
  {
    const int end = static_cast<int>(s[2]);
    return s[1] == 0 ? corner_id(s[0], end, along) : corner_id(s[0], along, end);
  }

  /// Both sides have the same zeros, but for those of what was divided out; they are matched in order. A side that is glued
  /// by a tolerance is taken as it is.
  void match(const Side& a, const Side& b, bool by_tolerance)
  {
    const std::vector<Place> empty;
    const auto in = [&](const Side& s) -> const std::vector<Place>& { return sides_.count(s) ? sides_.at(s) : empty; };
    const std::vector<Place> &x = in(a), &y = in(b);
    if (by_tolerance && x.size() == y.size()) {
      for (std::size_t k = 0; k < x.size(); ++k) unite(id(x[k].member), id(y[k].member));
      return;
    }
    if (x.size() != y.size() && (is_open(a[0]) || is_open(b[0]))) { // what is open may have the others
      stop_all(x);
      stop_all(y);
      return;
    }
    const bool whole = !by_tolerance && !may_lack(a) && !may_lack(b);
    if (whole && x.size() != y.size()) throw Refused(named_side(a) + ": the zeros on both sides of a joint differ");
    std::size_t i = 0, j = 0;
    while (i < x.size() || j < y.size()) {
      if (j == y.size() || (i < x.size() && x[i].along.hi < y[j].along.lo)) leave(x[i++], b, by_tolerance);
      else if (i == x.size() || y[j].along.hi < x[i].along.lo) leave(y[j++], a, by_tolerance);
      else match_places(x[i++], y[j++], whole || by_tolerance);
    }
  }

  void stop_all(const std::vector<Place>& list)
  {
    for (const Place& x : list) stops_[id(x.member)] = 1;
  }

  /// Whether something in a cell was left undecided.
  bool is_open(std::size_t cell) const
  {
    return std::any_of(c_.patches.begin(), c_.patches.end(), [&](const Patch& p) {
      const auto is_undecided = [](const Token& t) { return t.kind == Token::Kind::undecided; };
      return cell_of(p.pair) == cell && std::any_of(p.cells.begin(), p.cells.end(), is_undecided);
    });
  }

  std::string named_side(const Side& s) const { return named({s[0] / second_, s[0] % second_}); }

  /// Whether a cell's equation may have lost zeros along a side by what was divided out of it.
  bool may_lack(const Side& s) const
  {
    const auto patch = patch_of_.find(s[0]);
    return patch != patch_of_.end() && (c_.patches[patch->second].degenerate[1 - s[1]] || c_.patches[patch->second].vanishes);
  }

  void match_places(const Place& x, const Place& y, bool is_known)
  {
    if (!is_known) {
      const Powers common = common_factor(side_polynomial(x.member), side_polynomial(y.member));
      if (!are_one_root(common, x.along, y.along)) throw Refused("zeros on both sides of a joint are not proved to be one");
    }
    unite(id(x.member), id(y.member));
  }

  /// A vertex's equation along the side of its cell on which it lies, by the local parameter; a line has none there.
  Powers side_polynomial(const Member& m) const
  {
    const Vertex* v = vertex(m);
    if (!v) return {};
    const Patch& p = c_.patches[m[0]];
    const std::array<Range, 2> at = local(m);
    const std::size_t along = end_at(at[0]) < 0 ? 0 : 1;
    for (std::size_t k = 0; k < 2; ++k) {
      if (end_at(v->at[k]) < 0 || end_at(v->at[1 - k]) >= 0) continue;
      const Powers f = on_value(p.equation, static_cast<int>(k), v->at[k].lo);
      return p.chart.is_plain || p.chart.corner[along] == 0 ? f : on_line(f, 1, -1, 1);
    }
    return {};
  }

  /// A zero that the other side does not have must be one of what was divided out there.
  void leave(const Place& x, const Side& other, bool by_tolerance)
  {
    stops_[id(x.member)] = 1;
    if (by_tolerance) return;
    const auto patch = patch_of_.find(other[0]);
    if (patch != patch_of_.end()) {
      const Patch& p = c_.patches[patch->second];
      const Powers& f = p.factor[1 - other[1]];
      const bool is_root = x.along.is_exact() ? sign_at(f, x.along.lo) == 0 : sign_at(f, x.along.lo) * sign_at(f, x.along.hi) != 0 && roots_between(f, x.along.lo, x.along.hi) > 0;
      if (p.vanishes || is_root) return;
    }
    throw Refused(named_side(other) + ": a zero on a joint is missing on its other side");
  }

  // --------------------------------------------------------------------------------------------------------- seams

  /// Charts of one cell share lines τ^q = ρ^p, on which their equations have the same zeros.
  void match_seams()
  {
    std::map<std::array<std::size_t, 3>, std::vector<std::vector<Place>>> seams; // cell and ray
    for (std::size_t p = 0; p < c_.patches.size(); ++p)
      for (std::size_t k = 0; k < 2; ++k) {
        const Patch& patch = c_.patches[p];
        const std::array<int, 2> line = ray(patch.chart, k);
        if (patch.chart.is_plain || patch.vanishes || line[0] == 0 || line[1] == 0 || is_diagonal_edge(p, k)) continue;
        std::vector<Place> list;
        for (std::size_t v = 0; v < patch.vertices.size(); ++v)
          if (end_at(patch.vertices[v].at[k]) == 1 && end_at(patch.vertices[v].at[1 - k]) < 0) list.push_back({{p, v}, patch.vertices[v].at[1 - k]});
        sort(list);
        seams[{cell_of(patch.pair), cast(line[0]), cast(line[1])}].push_back(std::move(list));
      }
    for (const auto& [key, lists] : seams) {
      const bool differ = lists.size() != 2 || lists[0].size() != lists[1].size();
      if (differ && is_open(key[0])) {
        for (const auto& list : lists) stop_all(list);
        continue;
      }
      if (differ) throw Refused("cell " + std::to_string(key[0]) + ": the zeros on both sides of a line between charts differ");
      for (std::size_t k = 0; k < lists[0].size(); ++k) unite(id(lists[0][k].member), id(lists[1][k].member));
    }
  }

  // ---------------------------------------------------------------------------------------------------------- arcs

  void settle_classes()
  {
    degree_.assign(parent_.size(), 0);
    for (std::size_t p = 0; p < patches(); ++p)
      for (std::size_t k = 0; k < pieces_of(p); ++k)
        if (!is_dropped(p, k))
          for (const bool target : {false, true}) ++degree_[find(id(end_of(p, k, target)))];
    for (std::size_t i = 0; i < corners_; ++i)
      if (stops_[i]) stops_[find(i)] = 1;
    for (std::size_t p = 0; p < patches(); ++p)
      for (std::size_t v = 0; v < vertices_of(p); ++v)
        if (const std::size_t c = find(id({p, v})); !stops_[c] && degree_[c] % 2 != 0)
          throw Refused("patch " + std::to_string(p) + ": an arc ends inside the domain, at vertex " + std::to_string(v));
  }

  void check_arcs()
  {
    std::vector<std::vector<char>> used;
    for (std::size_t p = 0; p < patches(); ++p) used.emplace_back(pieces_of(p), 0);
    for (std::size_t a = 0; a < c_.arcs.size(); ++a) check_arc(a, used);
    for (std::size_t p = 0; p < patches(); ++p)
      for (std::size_t k = 0; k < used[p].size(); ++k)
        if ((used[p][k] != 0) == is_dropped(p, k))
          throw Refused("patch " + std::to_string(p) + ": piece " + std::to_string(k) + (is_dropped(p, k) ? " was dropped, but is on an arc" : " is on no arc"));
  }

  void check_arc(std::size_t index, std::vector<std::vector<char>>& used)
  {
    const Arc& arc = c_.arcs[index];
    const std::string where = "arc " + std::to_string(index);
    if (arc.steps.empty()) throw Refused(where + ": is empty");
    const auto class_of = [&](const Step& s, bool target) { return find(id(end_of(s.patch, s.piece, target != s.reversed))); };
    for (std::size_t k = 0; k < arc.steps.size(); ++k) {
      const Step& s = arc.steps[k];
      if (s.patch >= patches() || s.piece >= pieces_of(s.patch)) throw Refused(where + ": names no piece");
      if (used[s.patch][s.piece]++) throw Refused(where + ": a piece is on two arcs");
      if (k == 0) continue;
      const std::size_t c = class_of(s, false);
      if (class_of(arc.steps[k - 1], true) != c) throw Refused(where + ": its pieces do not join");
      if (degree_[c] != 2) throw Refused(where + ": passes through a place where other branches meet it");
    }
    const std::size_t source = class_of(arc.steps.front(), false), target = class_of(arc.steps.back(), true);
    if (arc.closed && (source != target || degree_[source] != 2)) throw Refused(where + ": is not closed");
    for (const std::size_t c : {source, target})
      if (!arc.closed && degree_[c] == 2 && !stops_[c]) throw Refused(where + ": ends where it goes on");
  }

  const Certificate& c_;
  std::size_t second_;
  std::map<std::size_t, std::size_t> patch_of_; ///< one of a cell's patches
  std::vector<std::size_t> first_, parent_, degree_;
  std::size_t corners_ = 0;
  std::vector<char> stops_;
  std::map<Side, std::vector<Place>> sides_;
};

} // namespace check
} // namespace locus

#endif
