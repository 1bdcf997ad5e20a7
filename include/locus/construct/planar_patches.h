// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANAR_PATCHES_H
#define LOCUS_CONSTRUCT_PLANAR_PATCHES_H

#include <locus/constraint/curvature_forms.h>
#include <locus/constraint/f3_system.h>
#include <locus/construct/planar_evidence.h>
#include <locus/construct/planar_pieces.h>
#include <locus/zero_set/curve_solver.h>
#include <locus/zero_set/domain_cells.h>
#include <locus/zero_set/overlay.h>
#include <locus/zero_set/piece_evaluation.h>

#include <chrono>

namespace locus {
namespace detail {

/// Keeps the leaves of a solve for pictures, in the inputs' parameters.
class Cell_keeper final : public Claim_observer<2> {
public:
  void on_claim(const Claim<2>& claim) override
  {
    const char* name = name_of(claim.kind);
    if (!name) return;
    Cell_picture cell;
    for (int corner = 0; corner < 4; ++corner) { // counterclockwise
      const bool high_0 = corner == 1 || corner == 2, high_1 = corner >= 2;
      const std::array<Range, 2> p =
        patch.parameters({Interval(high_0 ? claim.box.hi[0] : claim.box.lo[0]), Interval(high_1 ? claim.box.hi[1] : claim.box.lo[1])});
      cell.corners.push_back({p[0].lo, p[1].lo});
      for (std::size_t v = 0; v < 2; ++v) {
        if (corner == 0) cell.box.push_back(p[v]);
        cell.box[v] = {std::min(cell.box[v].lo, p[v].lo), std::max(cell.box[v].hi, p[v].hi)};
      }
    }
    cell.claim = name;
    cells.push_back(std::move(cell));
  }

  Planar_patch patch; ///< whose cells come next
  std::vector<Cell_picture> cells;

private:
  static const char* name_of(Claim_kind kind)
  {
    switch (kind) {
    case Claim_kind::empty: return "empty";
    case Claim_kind::graph: return "graph";
    case Claim_kind::crossing: return "crossing";
    case Claim_kind::undecided: return "undecided";
    case Claim_kind::split:
    case Claim_kind::outside:
    case Claim_kind::isolated_box: return nullptr;
    }
    return nullptr;
  }
};

/// On which side of a line a piece lies that does not meet it between its ends.
inline Sign side_of_axis(const Curve_graph& graph, std::size_t piece, const Diagonal& line)
{
  const Graph_piece& p = graph.pieces[piece];
  if (p.is_half_branch) return line.side(graph.vertices[p.to].at);
  return sign_along(graph, piece, [&](const std::array<Interval, 2>& at) { return line.side(at); });
}

/// Whether a graph's special points were all found regular, and nothing was left open.
inline bool is_simple(const Curve_graph& graph)
{
  return graph.is_certified() &&
         std::none_of(graph.special.begin(), graph.special.end(), [](const Isolated_point& p) { return p.evidence != nullptr; });
}

inline Curve_graph solve_f3(const F3_problem& problem, const Solve_control& control, Claim_observer<2>* observer)
{
  Curve_graph graph = solve_curves(problem.system, control, observer);
  if (!problem.axis) return graph;
  const Diagonal line = problem.axis_line;
  Curve_graph axis = solve_curves(*problem.axis, control);
  // Where the other factor touches the axis or is singular on it, both are solved as one.
  if (problem.whole && (!is_simple(graph) || !is_simple(axis))) return solve_curves(*problem.whole, control, observer);
  return Overlay(std::move(graph), std::move(axis),
                 [line](const Curve_graph& g, std::size_t piece) { return side_of_axis(g, piece, line); })
    .run();
}

/// How two pieces touch at a blown-up corner, exactly: by their curvatures, if both are finite there and move.
struct Corner_contact {
  bool is_regular = false;
  bool osculates = false;   ///< one circle of curvature: branches whose circles touch from one side tend to its centre
  bool is_flat = false;     ///< both curvatures vanish: these branches go to infinity
  int direction = 1;        ///< -1: the tangents are opposite

  Corner_contact() = default;
  Corner_contact(const Planar_curve& p, const Planar_curve& q, const std::array<int, 2>& end)
  {
    if (p.is_singular_at(end[0]) || q.is_singular_at(end[1])) return;
    is_regular = true;
    auto a = Curvature_forms<2>(p.piece()).at(end[0]), b = Curvature_forms<2>(q.piece()).at(end[1]);
    const Piece_end x(p, end[0]), y(q, end[1]);
    direction = sgn(Rational(x.tangent[0] * y.tangent[0] + x.tangent[1] * y.tangent[1]));
    if (direction < 0) b.sign = -b.sign;
    osculates = a.same_curvature(b);
    is_flat = a.sign == 0 && b.sign == 0;
  }
};

/// Solves F3 = 0 on all pairs of pieces that are not purged, patch by patch.
class Patch_maker {
public:
  /// The pairs are those of one curve's pieces where `cells.is_self()`.
  Patch_maker(const Planar_pieces& first, const Planar_pieces& second, const Domain_cells& cells, const Solve_control& control,
              Cell_keeper* keeper, Planar_evidence* evidence = nullptr)
    : first_(first), second_(second), cells_(cells), control_(control), keeper_(keeper), evidence_(evidence)
  {
  }

  /// Where a piece should be cut because it touches another one inside both, at a rational parameter: the branches there have
  /// different limits, which only the charts of a corner tell.
  std::optional<Necessary_cut> wanted_cut;

  void solve_pair(std::size_t i, std::size_t j)
  {
    if (wanted_cut) return; // all is done again
    const auto &a = first_.curves[i], &b = second_.curves[j];
    if (cells_.is_self() && i == j) return solve_self(i);
    ++pairs;
    if (are_apart(first_.bounds[i], second_.bounds[j])) {
      ++purged;
      if (evidence_) evidence_->purged.push_back({i, j});
      return;
    }
    const auto corners = touching_corners(*a, *b);
    if (corners.empty()) return solve(f3_problem(a, b), i, j);
    for (const F3_problem& problem : f3_corner_problems(a, b, corners[0])) solve(problem, i, j);
  }

  std::vector<Patch> patches;
  std::vector<Planar_patch> planar;
  /// What is said of a patch's problem, beside its zero set.
  struct Note {
    Planar_patch patch;
    std::vector<Degenerate_component> degenerate;
  };
  std::vector<Note> notes;
  Degrees<2> degrees{0, 0};
  bool has_axis = false;
  std::size_t pairs = 0, purged = 0; ///< of pieces: all, and those without any zero by their bounds
  Solve_statistics statistics;

private:
  void solve_self(std::size_t i)
  {
    const auto& piece = first_.curves[i];
    for (int end = 0; end < 2; ++end)
      if (piece->is_singular_at(end)) {
        for (const F3_problem& problem : f3_self_corner_problems(piece, end)) solve(problem, i, i);
        return;
      }
    solve(f3_self_problem(piece), i, i);
  }

  void solve(const F3_problem& problem, std::size_t i, std::size_t j)
  {
    const bool is_axis = problem.chart.is_axis;
    Planar_patch planar_patch;
    planar_patch.piece = {i, j};
    planar_patch.domain = {first_.ranges[i], second_.ranges[j]};
    planar_patch.map = Bisector_map_2(first_.evaluator(i), second_.evaluator(j), problem.chart, std::nullopt);
    if (keeper_) keeper_->patch = planar_patch;
    Patch patch;
    Claim_recorder recorder(is_axis ? nullptr : keeper_);
    patch.graph = solve_f3(problem, remaining_control(), evidence_ ? &recorder : recorder.next());
    if (evidence_) {
      const bool as_whole = problem.whole && patch.graph.equation == problem.whole->equations[0];
      evidence_->solves.push_back({{i, j}, problem, std::move(recorder.claims), std::nullopt, as_whole});
    }
    patch.chart = problem.chart;
    patch.cell = cells_.cell(i, j);
    want_cut_at_contact(problem, patch.graph, i, j);
    statistics += patch.graph.statistics;
    for (std::size_t v = 0; v < 2; ++v) degrees[v] = std::max(degrees[v], problem.degrees[v]);
    has_axis = has_axis || problem.axis || is_axis;
    note_degenerate(problem, patch, planar_patch);
    if (is_nothing(patch.graph) && (problem.degenerate.empty() || problem.repeats_degenerate)) return;
    if (problem.contact && (!patch.graph.pieces.empty() || !patch.graph.vertices.empty()))
      planar_patch.map = Bisector_map_2(first_.evaluator(i), second_.evaluator(j), problem.chart, problem.contact);
    mark_vertices(problem, i, j, patch, planar_patch);
    if (problem.chart.is_plain()) note_contacts(problem, patch.graph, planar_patch.map);
    if (problem.is_self && problem.chart.is_plain()) drop_mirror_half(patch);
    if (evidence_) evidence_->solves.back().patch = patches.size();
    patches.push_back(std::move(patch));
    planar.push_back(std::move(planar_patch));
  }

  void want_cut_at_contact(const F3_problem& problem, const Curve_graph& graph, std::size_t i, std::size_t j)
  {
    for (const Isolated_point& p : graph.special) {
      if (wanted_cut || !problem.chart.is_plain() || !p.evidence || p.tag != tag_of(F3_cause::meeting)) continue;
      const Rational &t = p.evidence->lo, &r = p.evidence->r_lo;
      if (t != p.evidence->hi || r != p.evidence->r_hi || !are_parallel(problem, t, r)) continue;
      if (p.face[0] < 0) wanted_cut = Necessary_cut{0, *first_.chain.pieces[i].at(t)};
      else if (p.face[1] < 0) wanted_cut = Necessary_cut{1, *second_.chain.pieces[j].at(r)};
    }
  }

  /// Where the curves cross nothing is to be cut, whatever proved the place.
  static bool are_parallel(const F3_problem& problem, const Rational& t, const Rational& r)
  {
    const auto a = [&](std::size_t v) { return evaluate_at(problem.first->tangent(v), t); };
    const auto b = [&](std::size_t v) { return evaluate_at(problem.second->tangent(v), r); };
    return a(0) * b(1) == a(1) * b(0);
  }

  static bool is_nothing(const Curve_graph& g)
  {
    return g.pieces.empty() && g.vertices.empty() && g.undecided.empty() && !g.identically_zero;
  }

  void note_degenerate(const F3_problem& problem, const Patch& patch, const Planar_patch& planar_patch)
  {
    Note note{planar_patch, {}};
    for (const Degenerate_component& d : problem.degenerate)
      if (!problem.repeats_degenerate && !is_at_infinity(problem, d)) note.degenerate.push_back(d);
    if (patch.graph.identically_zero) note.degenerate.push_back(Degenerate_component{});
    if (!note.degenerate.empty()) notes.push_back(std::move(note));
  }

  /// Straight inputs are tangent to the line at infinity where they reach it, which is nothing to report.
  static bool is_at_infinity(const F3_problem& problem, const Degenerate_component& d)
  {
    if (d.kind != Degenerate_component::Kind::infinity || d.lo != d.hi || (d.lo != 0 && d.lo != 1)) return false;
    return (d.input == 0 ? problem.first : problem.second)->is_infinite_at(d.lo == 0 ? 0 : 1);
  }

  /// The limits hold for all patches together.
  Solve_control remaining_control() const
  {
    Solve_control c = control_;
    c.max_cells = control_.max_cells > statistics.cells ? control_.max_cells - statistics.cells : 0;
    if (std::isfinite(control_.max_seconds))
      c.max_seconds = control_.max_seconds - std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (control_.progress)
      c.progress = [this](std::size_t done, std::size_t open) { control_.progress(statistics.cells + done, open); };
    return c;
  }

  /// Poles of the map to the plane, and places where a diagonal or a blown-up corner ends arcs.
  void mark_vertices(const F3_problem& problem, std::size_t i, std::size_t j, Patch& patch, Planar_patch& planar_patch) const
  {
    const std::size_t n = patch.graph.vertices.size();
    patch.is_pole.assign(n, 0);
    patch.is_final.assign(n, 0);
    patch.is_corner.assign(n, 0);
    planar_patch.at_contact.assign(n, 0);
    Corner_contact contact;
    if (!problem.chart.is_plain() && !is_on_diagonal(problem, i, j))
      contact = Corner_contact(*problem.first, *problem.second, problem.chart.corner);
    for (std::size_t v = 0; v < n; ++v) {
      const Graph_vertex& vertex = patch.graph.vertices[v];
      const int tag = vertex.cause >= 0 ? patch.graph.special[static_cast<std::size_t>(vertex.cause)].tag : tag_of(F3_cause::meeting);
      const std::array<Interval, 2> at = patch.local(v);
      const auto is_at = [&](int first, int second) { return is_exactly(at[0], first) && is_exactly(at[1], second); };
      const bool is_blown_up = !problem.chart.is_plain() && is_at(problem.chart.corner[0], problem.chart.corner[1]);
      patch.is_final[v] = tag == tag_of(F3_cause::diagonal) || is_on_diagonal_edge(problem, vertex) ||
                          (problem.is_self && (is_at(0, 0) || is_at(1, 1))) || (is_blown_up && is_on_diagonal(problem, i, j));
      patch.is_pole[v] = tag == tag_of(F3_cause::pole) || has_infinite_foot(problem, at) || has_infinite_limit(problem, vertex);
      if (is_blown_up && !patch.is_final[v]) {
        const Sign sides = contact.is_regular ? sides_of_branches(patch.graph, v, planar_patch.map, contact.direction) : Sign::unknown;
        patch.is_corner[v] = sides == Sign::positive ? 3 : contact.osculates ? 2 : 1;
        planar_patch.at_contact[v] = static_cast<signed char>(sides == Sign::positive ? contact.direction : 0);
        if (contact.is_flat && sides == Sign::negative) patch.is_pole[v] = 1;
      }
      if (vertex.cause >= 0 && patch.graph.special[static_cast<std::size_t>(vertex.cause)].also == tag_of(F3_cause::pole)) patch.is_pole[v] = 2;
    }
  }

  static void note_contacts(const F3_problem& problem, const Curve_graph& graph, Bisector_map_2& map)
  {
    for (std::size_t v = 0; v < graph.vertices.size(); ++v) {
      const int cause = graph.vertices[v].cause;
      if (cause < 0 || graph.special[static_cast<std::size_t>(cause)].tag != tag_of(F3_cause::meeting)) continue;
      if (auto node = contact_at_node(problem, graph, v)) map.add_node(std::move(*node));
    }
  }

  /// Positive where the circles of all branches that end at a vertex touch the curves from different sides: they shrink
  /// to the point where the curves touch. Negative where all do so from one side.
  static Sign sides_of_branches(const Curve_graph& graph, std::size_t vertex, const Bisector_map_2& map, int direction)
  {
    Sign all = Sign::unknown;
    bool any = false;
    for (std::size_t k = 0; k < graph.pieces.size(); ++k) {
      const Graph_piece& p = graph.pieces[k];
      if (p.from != vertex && p.to != vertex) continue;
      if (p.is_half_branch) return Sign::unknown;
      const Sign s = sign_along(graph, k, [&](const std::array<Interval, 2>& at) { return map.touches_both_sides(at); });
      if (any && s != all) return Sign::unknown;
      all = s;
      any = true;
    }
    return direction < 0 ? opposite(all) : all;
  }

  static bool is_exactly(const Interval& x, int end) { return x.inf() == end && x.sup() == end; }

  static bool has_infinite_foot(const F3_problem& problem, const std::array<Interval, 2>& at)
  {
    for (int end = 0; end < 2; ++end)
      if ((is_exactly(at[0], end) && problem.first->is_infinite_at(end)) || (is_exactly(at[1], end) && problem.second->is_infinite_at(end)))
        return true;
    return false;
  }

  /// The feet come together where the curvature vanishes: decided exactly, on an edge where it vanishes all along or at
  /// vertices with exact coordinates.
  static bool has_infinite_limit(const F3_problem& problem, const Graph_vertex& vertex)
  {
    if (!problem.contact) return false;
    const auto& chord = problem.contact->chord;
    std::array<Rational, 2> at;
    bool is_exact = true;
    for (std::size_t v = 0; v < 2; ++v) {
      const bool on_edge = is_exactly(vertex.at[v], 0);
      if (problem.contact->power[v] > 0 && on_edge) return false;
      if (on_edge && face(problem.contact->turn, static_cast<int>(v), false).is_zero() &&
          (is_strict(sign_about(chord[0], vertex)) || is_strict(sign_about(chord[1], vertex))))
        return true;
      is_exact = is_exact && vertex.at[v].inf() == vertex.at[v].sup();
      at[v] = Rational(vertex.at[v].inf());
    }
    return is_exact && evaluate(problem.contact->turn, at) == 0 && (evaluate(chord[0], at) != 0 || evaluate(chord[1], at) != 0);
  }

  /// The sign that a polynomial has all over a vertex's enclosure, if it has one.
  static Sign sign_about(const Bernstein<Scaled_integer, 2>& f, const Graph_vertex& vertex)
  {
    auto part = f;
    for (int v = 0; v < 2; ++v) {
      const Interval& x = vertex.at[static_cast<std::size_t>(v)];
      part = restrict_to(part, v, Rational(x.inf()), Rational(x.sup()));
    }
    return common_sign(part);
  }

  /// The diagonal as an edge of a chart of a piece with itself.
  static bool is_on_diagonal_edge(const F3_problem& problem, const Graph_vertex& vertex)
  {
    for (std::size_t k = 0; k < 2; ++k)
      if (problem.is_self && !problem.chart.is_plain() && is_exactly(vertex.at[k], 1) && problem.chart.ray(k) == std::array<int, 2>{1, 1}) return true;
    return false;
  }

  /// Whether a blown-up corner of a cell is one point of the curve, reached from both sides: at a joint or at the seam.
  bool is_on_diagonal(const F3_problem& problem, std::size_t i, std::size_t j) const
  {
    if (!cells_.is_self()) return false;
    const std::array<int, 2>& corner = problem.chart.corner;
    if (i == j) return corner[0] == corner[1];
    const bool joint = i == j + 1 && corner[0] == 0 && corner[1] == 1;
    return joint || (j == 0 && i + 1 == first_.size() && corner[0] == 1 && corner[1] == 0 && first_.chain.is_closed());
  }

  /// Of a piece with itself only t > r is kept.
  static void drop_mirror_half(Patch& patch)
  {
    Curve_graph& g = patch.graph;
    patch.dropped.assign(g.pieces.size(), 0);
    for (std::size_t k = 0; k < g.pieces.size(); ++k) {
      const Sign side = side_of_axis(g, k, Diagonal{});
      patch.dropped[k] = side == Sign::negative;
      if (side == Sign::unknown) g.undecided.push_back({g.forms[k].box, "on which side of the diagonal an arc runs"});
    }
    const auto is_mirrored = [](const Undecided_box& u) { return u.box.hi[0] < u.box.lo[1]; };
    g.undecided.erase(std::remove_if(g.undecided.begin(), g.undecided.end(), is_mirrored), g.undecided.end());
  }

  const Planar_pieces &first_, &second_;
  const Domain_cells& cells_;
  const Solve_control& control_;
  Cell_keeper* keeper_;
  Planar_evidence* evidence_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace detail
} // namespace locus

#endif
