// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CURVE_SOLVER_H
#define LOCUS_ZERO_SET_CURVE_SOLVER_H

#include <locus/zero_set/arc_joining.h>
#include <locus/zero_set/curve_graph.h>
#include <locus/zero_set/face_segments.h>
#include <locus/zero_set/solve_control.h>
#include <locus/zero_set/multiple_components.h>
#include <locus/zero_set/special_points.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <stdexcept>
#include <utility>

namespace locus {
namespace detail {

/// How far one attempt to solve goes.
struct Curve_attempt {
  std::chrono::steady_clock::time_point start;
  double node_width = 0x1p-22; ///< of the cells of singular points
  std::size_t max_cells = 20000;
  /// Cells that are still open at this width, or when this many cells were examined, may hold a singular point that no
  /// cause explains: the attempt leaves them, and ends without a result.
  double doubtful_width = 0;
  std::size_t doubtful_cells = static_cast<std::size_t>(-1);
};

/// Solves one equation in two variables on the unit cell: cuts until every cell is empty, a graph, or holds one
/// singular point, then joins the arcs of the cells at the crossings that neighbours share.
class Curve_solver {
public:
  Curve_solver(const System<1, 2>& system, const Solve_control& control, const Curve_attempt& attempt, Special_points& special)
    : system_(system), control_(control), attempt_(attempt), special_(special),
      tree_(*system.equations[0], graph_.statistics.filter, control.all_exact), segments_(tree_)
  {
  }

  /// Cells that an attempt left (see `Curve_attempt::doubtful_width`); it has no other result then.
  std::vector<Box<2>> doubtful;
  /// What the attempt said of its cells.
  std::vector<Claim<2>> claims;
  bool keeps_claims = false;

  Curve_graph run()
  {
    graph_.equation = system_.equations[0];
    graph_.special = special_.points;
    graph_.statistics.point_cells = std::exchange(special_.cells, 0);
    Rung rung;
    if (tree_.range_sign(0, rung) == Range_sign::zero) {
      graph_.identically_zero = true;
      return std::move(graph_);
    }
    claim_special_points();
    lay_out_unit_cell();
    subdivide();
    if (!doubtful.empty()) {
      gather_statistics();
      return std::move(graph_);
    }
    for (std::size_t k = 0; k < graph_cells_.size(); ++k) trace_graph_cell(graph_cells_[k], pivot_[k]);
    for (std::size_t k = 0; k < node_cells_.size(); ++k) trace_node_cell(node_cells_[k], node_of_[k]);
    for (const Index i : corner_cells_) note_boundary_corners(i);
    insert_marks();
    settle_vertices();
    join_arcs();
    keep_forms();
    gather_statistics();
    return std::move(graph_);
  }

private:
  using Index = Cell_tree::Index;
  using Faces = std::array<std::array<std::size_t, 2>, 2>; // [variable that is fixed][low, high]
  static constexpr std::size_t no_special = static_cast<std::size_t>(-1);

  /// Vertices are enclosed at least this tightly; exact bisection helps where doubles do not reach it.
  static constexpr double vertex_width = 0x1p-41;

  // ------------------------------------------------------------------------------------------------ causes

  void claim_special_points()
  {
    for (std::size_t k = 0; k < graph_.special.size(); ++k) {
      const Isolated_point& p = graph_.special[k];
      Claim<2> claim;
      claim.kind = Claim_kind::isolated_box;
      claim.special = k;
      claim.reason = p.cause == no_cause ? "singular point" : system_.causes[p.cause].name;
      claim.box = box_of(p.box);
      emit(claim);
    }
  }

  bool is_crossing(const Isolated_point& p) const { return special_.is_crossing(p); }

  static bool touches(const Isolated_point& p, const Box<2>& box)
  {
    for (std::size_t v = 0; v < 2; ++v)
      if (p.box[v].sup() < box.lo[v] || p.box[v].inf() > box.hi[v]) return false;
    return true;
  }

  // ------------------------------------------------------------------------------------------- subdivision

  void lay_out_unit_cell()
  {
    Faces faces;
    for (int v = 0; v < 2; ++v)
      for (int side = 0; side < 2; ++side)
        faces[static_cast<std::size_t>(v)][static_cast<std::size_t>(side)] =
          segments_.add(v, side, 0, 1, true, 0, side == 1);
    faces_.assign(1, faces);
  }

  void subdivide()
  {
    std::vector<Index> level{0}, next;
    while (!level.empty()) {
      for (const Index i : level) {
        if (is_doubtful(i)) {
          doubtful.push_back(tree_[i].box);
          continue;
        }
        if (const char* limit = limit_reached(i)) {
          give_up(i, limit);
          continue;
        }
        ++graph_.statistics.cells;
        if (!decide(i) && !cut(i, next)) give_up(i, "no admissible cut");
      }
      level.swap(next);
      next.clear();
      if (control_.progress)
        with_nearest_rounding([&] { control_.progress(graph_.statistics.cells, level.size()); });
    }
  }

  /// Small, or one of too many, and not near a singular point that is known.
  bool is_doubtful(Index i) const
  {
    Box<2> box = tree_[i].box;
    const double width = box.max_width();
    if (width > attempt_.doubtful_width && graph_.statistics.cells < attempt_.doubtful_cells) return false;
    for (std::size_t v = 0; v < 2; ++v) { // about a node the cells are as small as its own
      box.lo[v] -= 16 * width;
      box.hi[v] += 16 * width;
    }
    for (const Isolated_point& p : graph_.special)
      if (is_crossing(p) && touches(p, box)) return false;
    return true;
  }

  const char* limit_reached(Index i) const
  {
    if (graph_.statistics.cells >= attempt_.max_cells) return "cell limit";
    if (tree_[i].depth >= 2 * control_.max_depth) return "depth limit";
    if (control_.is_cancelled()) return "cancelled";
    if (tree_[i].exact && mpz_sizeinbase(tree_[i].exact->values()[0].get_mpz_t(), 2) > control_.max_bits) return "bit limit";
    if ((graph_.statistics.cells & 63u) == 0 && std::isfinite(control_.max_seconds) &&
        std::chrono::duration<double>(std::chrono::steady_clock::now() - attempt_.start).count() > control_.max_seconds)
      return "time limit";
    return nullptr;
  }

  void give_up(Index i, const char* reason)
  {
    ++graph_.statistics.leaves;
    undecided_cells_.push_back(i);
    undecided_reason_.push_back(reason);
    Claim<2> claim;
    claim.kind = Claim_kind::undecided;
    claim.box = tree_[i].box;
    claim.reason = reason;
    emit(claim);
  }

  bool decide(Index i)
  {
    Claim<2> claim;
    claim.box = tree_[i].box;
    if (system_.outside && system_.outside(claim.box)) {
      outside_cells_.push_back(i);
      claim.kind = Claim_kind::outside;
      return settle(claim);
    }
    const Range_sign s = tree_.range_sign(i, claim.rung);
    if (is_strict(s) || is_zero_only_at_corners(i, s)) {
      if (!is_strict(s)) corner_cells_.push_back(i);
      claim.kind = Claim_kind::empty;
      return settle(claim);
    }
    std::size_t crossings = 0, last = no_special;
    for (std::size_t k = 0; k < graph_.special.size(); ++k)
      if (is_crossing(graph_.special[k]) && touches(graph_.special[k], claim.box)) {
        ++crossings;
        last = k;
      }
    if (crossings > 1) return false;
    if (crossings == 1) {
      const bool is_regular = has_regular_critical_point(i, last);
      if (tree_[i].box.max_width() > attempt_.node_width || !is_node_cell(i, last, is_regular)) return false;
      node_cells_.push_back(i);
      node_of_.push_back(last);
      claim.kind = Claim_kind::crossing;
      claim.special = last;
      return settle(claim);
    }
    for (int v = 0; v < 2; ++v) {
      const int pivot = preferred_pivot(i) ^ v;
      if (const Range_sign d = tree_.derivative_sign(i, pivot, claim.rung); is_strict(d)) {
        graph_cells_.push_back(i);
        pivot_.push_back({pivot, d == Range_sign::positive ? Sign::positive : Sign::negative});
        claim.kind = Claim_kind::graph;
        claim.variable = pivot;
        return settle(claim);
      }
    }
    return false;
  }

  bool settle(const Claim<2>& claim)
  {
    ++graph_.statistics.leaves;
    emit(claim);
    return true;
  }

  void emit(const Claim<2>& claim)
  {
    if (keeps_claims) claims.push_back(claim);
  }

  /// The variable along which the polynomial varies more steadily.
  int preferred_pivot(Index i) const
  {
    double score[2] = {-1, -1};
    for (int v = 0; v < 2; ++v) {
      if (tree_.degrees()[static_cast<std::size_t>(v)] == 0) continue;
      double lo, hi;
      tree_.difference_range(i, v, lo, hi);
      score[v] = lo > 0 || hi < 0 ? std::min(std::abs(lo), std::abs(hi)) / std::max(std::abs(lo), std::abs(hi)) : -1;
    }
    return score[1] > score[0] ? 1 : 0;
  }

  /// No strict sign, but zero coefficients only at corners with strict ones beside them: then the zero set meets the
  /// cell in those corners at most, and its arcs belong to the neighbours.
  bool is_zero_only_at_corners(Index i, Range_sign s)
  {
    if (s != Range_sign::weak_negative && s != Range_sign::weak_positive) return false;
    const auto& f = tree_.exact(i);
    const int n = f.degree(0), m = f.degree(1);
    if (n == 0 || m == 0) return false;
    const auto is_zero = [&](int k, int l) { return f.values().at({k, l}) == 0; };
    std::size_t zeros = 0, corner_zeros = 0;
    for (std::size_t k = 0; k < f.size(); ++k) zeros += f.sign(k) == Sign::zero;
    for (const int k : {0, n})
      for (const int l : {0, m}) {
        if (!is_zero(k, l)) continue;
        ++corner_zeros;
        // With degree one an edge has no coefficients but its corners: two zeros there are a whole edge of zeros.
        if (is_zero(k == 0 ? 1 : n - 1, l) || is_zero(k, l == 0 ? 1 : m - 1)) return false;
      }
    return zeros == corner_zeros;
  }

  /// Cuts where no special point lies and the equation does not vanish along the cut.
  bool cut(Index i, std::vector<Index>& next)
  {
    const Box<2> box = tree_[i].box;
    const int first = cut_variable(i);
    for (int attempt = 0; attempt < 2; ++attempt) {
      const int variable = first ^ attempt;
      const auto v = static_cast<std::size_t>(variable);
      for (double s : {0.5, 0.4375, 0.5625, 0.375, 0.625, 0.46875, 0.53125}) {
        const double at = box.lo[v] + s * box.width(variable);
        if (!is_dyadic_cut(box, v, at) || meets_special(box, v, at)) continue;
        if (s == 0.5 || !splits_off_nothing(box, v, at)) {
          if (cut_at(i, variable, at, next)) return true;
        }
      }
    }
    return false;
  }

  static bool splits_off_nothing(const Box<2>& box, std::size_t v, double at)
  {
    return !(box.lo[v] < at && at < box.hi[v]);
  }

  /// The cut has to be an exact double, far enough from the last bit.
  static bool is_dyadic_cut(const Box<2>& box, std::size_t v, double at)
  {
    return box.lo[v] < at && at < box.hi[v] && box.hi[v] - box.lo[v] > 0x1p-44;
  }

  bool meets_special(const Box<2>& box, std::size_t v, double at) const
  {
    const double margin = 0x1p-6 * (box.hi[v] - box.lo[v]);
    for (const Isolated_point& p : graph_.special)
      if (touches(p, box) && p.box[v].inf() - margin <= at && at <= p.box[v].sup() + margin && p.face[v] < 0) return true;
    return false;
  }

  int cut_variable(Index i) const
  {
    double spread[2] = {0, 0};
    for (int v = 0; v < 2; ++v) {
      if (tree_.degrees()[static_cast<std::size_t>(v)] == 0) continue;
      double lo, hi;
      tree_.difference_range(i, v, lo, hi);
      spread[v] = tree_.degrees()[static_cast<std::size_t>(v)] * std::max(std::abs(lo), std::abs(hi));
    }
    const Box<2>& box = tree_[i].box;
    // Long cells are cut across, but not along a variable that hardly matters.
    if (box.width(0) > 8 * box.width(1) && 16 * spread[0] > spread[1]) return 0;
    if (box.width(1) > 8 * box.width(0) && 16 * spread[1] > spread[0]) return 1;
    return spread[1] > spread[0] ? 1 : 0;
  }

  bool cut_at(Index i, int variable, double at, std::vector<Index>& next)
  {
    const auto v = static_cast<std::size_t>(variable), w = 1 - v;
    const Index low = tree_.cut(i, variable, at), high = low + 1;
    if (vanishes_on_high_face(low, variable)) { // a component runs along the cut: choose another
      tree_.undo_cut(i);
      return false;
    }
    const Box<2>& box = tree_[i].box;
    const std::size_t shared = segments_.add(variable, at, box.lo[w], box.hi[w], false, low, true);
    const Faces parent = faces_[i];
    faces_.resize(tree_.size());
    faces_[low] = faces_[high] = parent;
    faces_[low][v][1] = shared;
    faces_[high][v][0] = shared;
    next.push_back(low);
    next.push_back(high);
    Claim<2> claim;
    claim.kind = Claim_kind::split;
    claim.box = box;
    claim.variable = variable;
    claim.at = at;
    emit(claim);
    return true;
  }

  bool vanishes_on_high_face(Index cell, int variable)
  {
    if (tree_.is_nonzero_on_face(cell, variable, true)) return false;
    const auto fresh = face(system_.equations[0]->enclosure(tree_[cell].box), variable, true);
    for (const Interval& c : fresh.coefficients())
      if (is_strict(sign_of(c))) return false;
    return face(tree_.exact(cell), variable, true).is_zero();
  }

  // ------------------------------------------------------------------------------------------------- nodes

  /// Three conditions make the zero set in a box a star of 2(1 - index) half-branches that leave p: F and ∇F vanish at p; p is
  /// the only critical point of the box; and the box's boundary has exactly as many crossings, all of them simple. Where p
  /// lies on the unit cell's boundary, the polynomial is continued and the box reaches over; p is the only zero on the
  /// boundary line, so that each half-branch stays on its side: clipping keeps just those inside.
  bool is_node_cell(Index i, std::size_t special, bool is_regular)
  {
    const Isolated_point p = graph_.special[special];
    const Box<2> box = tree_[i].box, whole = p.on_boundary() ? continued_box(box, p) : box;
    for (std::size_t v = 0; v < 2; ++v)
      if (p.face[v] < 0 && !(box.lo[v] < p.box[v].inf() && p.box[v].sup() < box.hi[v])) return false;
    for (const Isolated_point& other : graph_.special)
      if (!is_crossing(other) && touches(other, box)) return false; // its place would be lost in here
    const std::optional<int> index = is_regular ? std::optional<int>(hessian_index_[i]) : index_of_only_critical_point(whole, special);
    if (!index || (!is_regular && p.on_boundary() && !is_only_zero_on_boundary(i, p))) return false;
    bool simple = true;
    const auto crossings = static_cast<int>(boundary_crossings(i, p, simple).size());
    if (!simple) return false;
    return (p.on_boundary() ? crossings_of_free_box(whole) : crossings) == 2 * (1 - *index);
  }

  /// By exact projections of all critical points.
  std::optional<int> index_of_only_critical_point(const Box<2>& box, std::size_t special)
  {
    const std::optional<Box<2>>& alone = special_.alone_box(special);
    if (!alone) return std::nullopt;
    for (std::size_t v = 0; v < 2; ++v)
      if (!(alone->lo[v] < box.lo[v] && box.hi[v] < alone->hi[v])) return std::nullopt;
    return special_.critical().index(box);
  }

  /// On the faces of the unit cell on which p lies, the cell has no other zero than p.
  bool is_only_zero_on_boundary(Index i, const Isolated_point& p)
  {
    for (int v = 0; v < 2; ++v) {
      const int side = p.face[static_cast<std::size_t>(v)];
      if (side < 0) continue;
      Face_segment& s = segments_.solved(face_of(i, v, side));
      if (s.set.identically_zero || !s.set.complete) return false;
      const auto w = static_cast<std::size_t>(1 - v);
      std::size_t zeros = 0;
      for (std::size_t r = segments_.lower_bound(s, tree_[i].box.lo[w]);
           r < s.set.roots.size() && segments_.compare(s, r, tree_[i].box.hi[w]) <= 0; ++r)
        ++zeros;
      if (zeros != 1) return false;
    }
    return true;
  }

  /// The cell, continued over the unit cell's faces on which the point lies.
  static Box<2> continued_box(Box<2> box, const Isolated_point& p)
  {
    for (std::size_t v = 0; v < 2; ++v) {
      const double width = box.hi[v] - box.lo[v];
      if (p.face[v] == 0) box.lo[v] -= width;
      if (p.face[v] == 1) box.hi[v] += width;
    }
    return box;
  }

  /// Simple zeros on the boundary of a box that need not lie in the unit cell; -1 where they are not all simple or one
  /// is a corner.
  int crossings_of_free_box(const Box<2>& box)
  {
    int count = 0;
    for (int v = 0; v < 2; ++v)
      for (int side = 0; side < 2; ++side) {
        const auto vv = static_cast<std::size_t>(v), w = 1 - vv;
        const double fixed = side ? box.hi[vv] : box.lo[vv];
        const auto thin = [&](double lo, double hi) {
          Box<2> line;
          line.lo[vv] = line.hi[vv] = fixed;
          line.lo[w] = lo;
          line.hi[w] = hi;
          return bounded(face(system_.equations[0]->enclosure(line), v, false));
        };
        const auto exact = [&] {
          const auto on_line = face(split(system_.equations[0]->exact(), v, Rational(fixed)).first, v, true);
          return restrict_to(on_line, 0, Rational(box.lo[w]), Rational(box.hi[w]));
        };
        const Univariate f(thin(box.lo[w], box.hi[w]), box.lo[w], box.hi[w], exact, &graph_.statistics.filter);
        const auto set = isolate_roots(f);
        if (set.identically_zero || !set.complete) return -1;
        for (const auto& root : set.roots) {
          if (root.multiplicity != 1 || (root.is_exact() && (root.lo == box.lo[w] || root.hi == box.hi[w]))) return -1;
          ++count;
        }
      }
    return count;
  }

  /// Whether a dominant Hessian (and at the boundary, convexity along it) makes the point the only critical one of the cell:
  /// tested where the cell is still large, for on the smallest ones the second differences drown in the coefficients'
  /// errors; it carries over to all parts.
  bool has_regular_critical_point(Index i, std::size_t special)
  {
    hessian_index_.resize(tree_.size(), 0);
    const Index parent = tree_[i].parent;
    if (parent != Cell_tree::none && hessian_index_[parent] != 0) hessian_index_[i] = hessian_index_[parent];
    if (hessian_index_[i] != 0) return true;
    const Isolated_point& p = graph_.special[special];
    const auto f = system_.equations[0]->enclosure(continued_box(tree_[i].box, p));
    int index = index_by_dominant_hessian(f);
    for (int v = 0; v < 2; ++v)
      if (p.face[static_cast<std::size_t>(v)] >= 0 && contains_zero(range(derivative(derivative(f, 1 - v), 1 - v)))) index = 0;
    hessian_index_[i] = static_cast<signed char>(index);
    return index != 0;
  }

  static Interval range(const Bernstein<Interval, 2>& f)
  {
    Interval r = f[0];
    for (const Interval& c : f.coefficients()) r = hull(r, c);
    return r;
  }

  /// The index of the gradient's only zero: 1 where the Hessian is definite, -1 where it is indefinite; 0 where neither is proved.
  static int index_by_dominant_hessian(const Bernstein<Interval, 2>& f)
  {
    const auto ft = derivative(f, 0), fr = derivative(f, 1);
    const Interval a = range(derivative(ft, 0)), b = range(derivative(ft, 1)), d = range(derivative(fr, 1));
    const double ma = midpoint(a), mb = midpoint(b), md = midpoint(d), det = ma * md - mb * mb;
    if (det == 0 || !std::isfinite(1 / det)) return 0;
    const double y[2][2] = {{md / det, -mb / det}, {-mb / det, ma / det}};
    for (int r = 0; r < 2; ++r) {
      const Interval m0 = Interval(y[r][0]) * a + Interval(y[r][1]) * b, m1 = Interval(y[r][0]) * b + Interval(y[r][1]) * d;
      if (!(mignitude(r == 0 ? m0 : m1) > magnitude(r == 0 ? m1 : m0))) return 0;
    }
    const Sign sign = sign_of(a * d - b * b);
    return sign == Sign::positive ? 1 : sign == Sign::negative ? -1 : 0;
  }

  /// Vertices where the zero set meets the cell's boundary, counterclockwise from the low corner; `simple` is false
  /// where it does not cross there transversally. Faces of the unit cell on which the point `p` lies are left out.
  std::vector<std::size_t> boundary_crossings(Index i, const Isolated_point& p, bool& simple)
  {
    std::vector<std::size_t> found;
    const auto walk = [&](int fixed_variable, int side, bool forward) {
      if (p.face[static_cast<std::size_t>(fixed_variable)] == side) return;
      Face_segment& s = segments_.solved(face_of(i, fixed_variable, side));
      const auto w = static_cast<std::size_t>(1 - fixed_variable);
      const double a = tree_[i].box.lo[w], b = tree_[i].box.hi[w];
      if (s.set.identically_zero || !s.set.complete) {
        simple = false;
        return;
      }
      std::vector<std::size_t> here;
      for (std::size_t r = segments_.lower_bound(s, a); r < s.set.roots.size() && segments_.compare(s, r, b) <= 0; ++r) {
        if (s.set.roots[r].multiplicity != 1) simple = false;
        here.push_back(vertex_on_face(i, fixed_variable, side, r));
      }
      if (!forward) std::reverse(here.begin(), here.end());
      for (const std::size_t v : here)
        if (std::find(found.begin(), found.end(), v) == found.end()) found.push_back(v);
    };
    // Faces counterclockwise; where the point lies on some, the walk begins behind them, so that the order is that of a
    // sector's half-branches.
    constexpr std::array<std::array<int, 2>, 4> faces{{{1, 0}, {0, 1}, {1, 1}, {0, 0}}};
    const auto skipped = [&](std::size_t k) { return p.face[static_cast<std::size_t>(faces[k % 4][0])] == faces[k % 4][1]; };
    std::size_t first = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (skipped(k) && !skipped(k + 1)) first = k + 1;
    for (std::size_t k = first; k < first + 4; ++k) walk(faces[k % 4][0], faces[k % 4][1], k % 4 < 2);
    return found;
  }

  void trace_node_cell(Index i, std::size_t special)
  {
    const Isolated_point& p = graph_.special[special];
    bool simple = true;
    const std::vector<std::size_t> crossings = boundary_crossings(i, p, simple);
    Graph_vertex node;
    node.kind = p.on_boundary() && crossings.size() < 2 ? Graph_vertex::Kind::end
                : crossings.empty()                     ? Graph_vertex::Kind::isolated
                                                        : Graph_vertex::Kind::node;
    node.at = p.box;
    for (std::size_t v = 0; v < 2; ++v)
      if (p.face[v] >= 0) node.at[v] = Interval(p.face[v]);
    node.cause = static_cast<int>(special);
    const std::size_t n = add_vertex(node);
    for (const std::size_t v : crossings) {
      graph_.vertices[n].half_branches.push_back(graph_.pieces.size());
      Graph_piece piece;
      piece.cell = i;
      piece.is_half_branch = true;
      piece.from = n;
      piece.to = v;
      graph_.pieces.push_back(piece);
    }
  }

  // ------------------------------------------------------------------------------------------- graph cells

  std::size_t face_of(Index i, int variable, int side) const
  {
    return faces_[i][static_cast<std::size_t>(variable)][static_cast<std::size_t>(side)];
  }

  std::size_t add_vertex(const Graph_vertex& v)
  {
    graph_.vertices.push_back(v);
    return graph_.vertices.size() - 1;
  }

  /// The vertex of root `r` on a face of cell `i`; where the root is a corner of the cell, the one that the other
  /// segment through the corner may already hold.
  std::size_t vertex_on_face(Index i, int fixed_variable, int side, std::size_t r)
  {
    const std::size_t id = face_of(i, fixed_variable, side);
    Face_segment& s = segments_.solved(id);
    const auto w = static_cast<std::size_t>(1 - fixed_variable);
    int& vertex = s.vertex[r];
    int* other = nullptr;
    bool on_boundary = s.on_boundary;
    if (const auto& root = s.set.roots[r]; root.is_exact()) {
      for (int end = 0; end < 2; ++end) {
        if (root.lo != (end ? tree_[i].box.hi[w] : tree_[i].box.lo[w])) continue;
        Face_segment& across = segments_.solved(face_of(i, 1 - fixed_variable, end));
        on_boundary = on_boundary || across.on_boundary;
        if (across.set.identically_zero) continue;
        const std::size_t q = segments_.lower_bound(across, s.fixed);
        if (q < across.set.roots.size() && segments_.compare(across, q, s.fixed) == 0) other = &across.vertex[q];
      }
    }
    if (vertex < 0 && other) vertex = *other;
    if (vertex < 0) {
      Graph_vertex v;
      v.kind = on_boundary ? Graph_vertex::Kind::boundary : Graph_vertex::Kind::crossing;
      vertex = static_cast<int>(add_vertex(v));
      where_.push_back({});
    }
    where_.resize(graph_.vertices.size());
    where_[static_cast<std::size_t>(vertex)] = Place{id, r};
    if (on_boundary) graph_.vertices[static_cast<std::size_t>(vertex)].kind = Graph_vertex::Kind::boundary;
    if (other) *other = vertex;
    return static_cast<std::size_t>(vertex);
  }

  /// A vertex at a corner of the cell, for a face along which the equation vanishes identically.
  std::size_t corner_vertex(Index i, int variable, int side, int end)
  {
    Face_segment& across = segments_.solved(face_of(i, 1 - variable, end));
    const double at = segments_[face_of(i, variable, side)].fixed;
    const std::size_t q = segments_.lower_bound(across, at);
    if (q < across.set.roots.size() && segments_.compare(across, q, at) == 0)
      return vertex_on_face(i, 1 - variable, end, q);
    throw std::logic_error("locus: a face of zeros ends at a corner that is no zero");
  }

  /// Zeros at the cell's corners on the domain's boundary become vertices even where no arc of this cell ends there:
  /// a curve that touches the boundary from outside has that point in the domain.
  void note_boundary_corners(Index i)
  {
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        const int side[2] = {a, b};
        for (int v = 0; v < 2; ++v) {
          if (!segments_[face_of(i, v, side[v])].on_boundary || tree_.corner_sign(i, a, b) != Sign::zero) continue;
          Face_segment& s = segments_.solved(face_of(i, v, side[v]));
          if (s.set.identically_zero || !s.set.complete) continue;
          const auto w = static_cast<std::size_t>(1 - v);
          const double at = side[w] ? tree_[i].box.hi[w] : tree_[i].box.lo[w];
          const std::size_t r = segments_.lower_bound(s, at);
          if (r < s.set.roots.size() && segments_.compare(s, r, at) == 0) vertex_on_face(i, v, side[v], r);
        }
      }
  }

  struct Side {
    Face_segment* segment = nullptr;
    std::size_t id = 0, next = 0; ///< next root
    Sign sign = Sign::zero;       ///< sign just right of the current place
  };

  Side start_side(Index i, int pivot, int side, double a)
  {
    Side s;
    s.id = face_of(i, pivot, side);
    s.segment = &segments_.solved(s.id);
    if (s.segment->set.identically_zero) return s;
    s.next = segments_.lower_bound(*s.segment, a);
    if (s.next < s.segment->set.roots.size() && segments_.compare(*s.segment, s.next, a) == 0) ++s.next;
    s.sign = s.segment->set.gaps[s.next];
    return s;
  }

  /// In a graph cell with pivot p the equation is strictly monotone in x_p, so above each base value the curve is
  /// inside exactly where the equation has opposite signs on the two p-faces. Walks along the base through the
  /// roots on those faces and records each stretch between two of them.
  void trace_graph_cell(Index i, std::pair<int, Sign> pivot_and_slope)
  {
    const int pivot = pivot_and_slope.first;
    const Sign slope = pivot_and_slope.second;
    const auto base = static_cast<std::size_t>(1 - pivot);
    const double a = tree_[i].box.lo[base], b = tree_[i].box.hi[base];
    std::array<Side, 2> sides{start_side(i, pivot, 0, a), start_side(i, pivot, 1, a)};
    for (const Side& s : sides)
      if (!s.segment->set.complete) return leave_open(i);
    for (int side = 0; side < 2; ++side)
      if (sides[static_cast<std::size_t>(side)].segment->set.identically_zero) {
        add_piece(i, static_cast<int>(base), corner_vertex(i, pivot, side, 0), corner_vertex(i, pivot, side, 1));
        return;
      }
    const auto inside = [&] { return sides[0].sign == opposite(slope) && sides[1].sign == slope; };

    note_boundary_corners(i);
    std::size_t from = no_special;
    if (inside()) {
      from = end_vertex(i, pivot, 0);
      if (from == no_special) return leave_open(i);
    }
    for (;;) {
      const int side = next_event(sides, b);
      if (side == -2) return leave_open(i);
      if (side < 0) break;
      Side& s = sides[static_cast<std::size_t>(side)];
      const bool was_inside = inside();
      const std::size_t r = s.next++;
      if (segments_.compare(*s.segment, r, b) == 0) continue; // a corner: the face across the base takes it
      s.sign = s.segment->set.gaps[s.next];
      if (!was_inside && !inside()) {
        if (s.segment->on_boundary) vertex_on_face(i, pivot, side, r);
        continue;
      }
      const std::size_t v = vertex_on_face(i, pivot, side, r);
      if (was_inside) add_piece(i, static_cast<int>(base), from, v);
      from = v;
    }
    if (inside()) {
      const std::size_t to = end_vertex(i, pivot, 1);
      if (to == no_special) return leave_open(i);
      add_piece(i, static_cast<int>(base), from, to);
    }
  }

  void add_piece(Index i, int base, std::size_t from, std::size_t to)
  {
    Graph_piece p;
    p.cell = i;
    p.base = base;
    p.from = from;
    p.to = to;
    graph_.pieces.push_back(p);
  }

  void leave_open(Index i)
  {
    undecided_cells_.push_back(i);
    undecided_reason_.push_back("roots on a face closer than doubles can part");
  }

  /// Vertex where the curve enters (end 0) or leaves (end 1) the cell through the face across the base variable.
  std::size_t end_vertex(Index i, int pivot, int end)
  {
    const int base = 1 - pivot;
    Face_segment& s = segments_.solved(face_of(i, base, end));
    if (!s.set.complete || s.set.identically_zero) return no_special;
    const auto p = static_cast<std::size_t>(pivot);
    const double lo = tree_[i].box.lo[p], hi = tree_[i].box.hi[p];
    const std::size_t r = segments_.lower_bound(s, lo);
    if (r >= s.set.roots.size() || segments_.compare(s, r, hi) > 0)
      throw std::logic_error("locus: a graph cell's arc does not reach the face it must cross");
    return vertex_on_face(i, base, end, r);
  }

  /// Which of the two p-faces has the next root not beyond b: 0, 1, -1 for none, -2 where doubles cannot tell.
  int next_event(std::array<Side, 2>& sides, double b)
  {
    std::array<bool, 2> has{};
    for (std::size_t k = 0; k < 2; ++k) {
      Side& s = sides[k];
      has[k] = s.next < s.segment->set.roots.size() && segments_.compare(*s.segment, s.next, b) <= 0;
    }
    if (!has[0] || !has[1]) return has[0] ? 0 : has[1] ? 1 : -1;
    bool certain = true;
    const bool first = segments_.less({sides[0].id, sides[0].next}, {sides[1].id, sides[1].next}, certain);
    if (!certain) return -2;
    return first ? 0 : 1;
  }

  // ------------------------------------------------------------------------------------------------- marks

  struct Place {
    std::size_t segment = no_special, root = 0;
  };

  Interval position_along(const Graph_vertex& v, int variable) const { return v.at[static_cast<std::size_t>(variable)]; }

  void locate_vertices()
  {
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
      Graph_vertex& vertex = graph_.vertices[v];
      if (vertex.cause >= 0) continue;
      if (v >= where_.size() || where_[v].segment == no_special) throw std::logic_error("locus: a vertex without a place");
      Face_segment& s = segments_[where_[v].segment];
      auto& root = s.set.roots[where_[v].root];
      refine_root(*s.polynomial, root, 1e-15, vertex_width);
      vertex.at[static_cast<std::size_t>(s.fixed_variable)] = Interval(s.fixed);
      vertex.at[static_cast<std::size_t>(1 - s.fixed_variable)] = Interval(root.lo, root.hi);
    }
  }

  /// Puts the marks (solutions of causes that prove no singularity, but a pole of the map to the plane) on their arcs.
  void insert_marks()
  {
    locate_vertices();
    for (std::size_t k = 0; k < graph_.special.size(); ++k) {
      const Isolated_point& p = graph_.special[k];
      if (is_crossing(p)) continue;
      if (!insert_mark(k)) {
        Box<2> box;
        for (std::size_t v = 0; v < 2; ++v) {
          box.lo[v] = std::max(0.0, p.box[v].inf());
          box.hi[v] = std::min(1.0, p.box[v].sup());
        }
        report_undecided({box, "cannot place a solution of " + system_.causes[p.cause].name + " on its arc"});
      }
    }
  }

  bool insert_mark(std::size_t k)
  {
    const Isolated_point p = graph_.special[k];
    if (p.on_boundary()) return mark_boundary_vertex(k);
    for (std::size_t q = 0; q < graph_.pieces.size(); ++q) {
      const Graph_piece piece = graph_.pieces[q];
      if (piece.is_half_branch || !touches(p, tree_[piece.cell].box)) continue;
      const Interval x = p.box[static_cast<std::size_t>(piece.base)];
      const Interval a = position_along(graph_.vertices[piece.from], piece.base);
      const Interval b = position_along(graph_.vertices[piece.to], piece.base);
      if (!(a.sup() < x.inf() && x.sup() < b.inf())) continue;
      Graph_vertex mark;
      mark.kind = Graph_vertex::Kind::mark;
      mark.at = p.box;
      mark.cause = static_cast<int>(k);
      const std::size_t v = add_vertex(mark);
      graph_.pieces[q].to = v;
      Graph_piece rest = piece;
      rest.from = v;
      graph_.pieces.push_back(rest);
      return true;
    }
    return false;
  }

  bool mark_boundary_vertex(std::size_t k)
  {
    const Isolated_point& p = graph_.special[k];
    std::size_t found = no_special;
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
      const Graph_vertex& vertex = graph_.vertices[v];
      if (vertex.kind != Graph_vertex::Kind::boundary) continue;
      if (!overlap(vertex.at[0], p.box[0]) || !overlap(vertex.at[1], p.box[1])) continue;
      if (found != no_special) return false;
      found = v;
    }
    if (found == no_special) return false;
    graph_.vertices[found].is_mark = true;
    graph_.vertices[found].cause = static_cast<int>(k);
    return true;
  }

  // ------------------------------------------------------------------------------------------------ result

  void settle_vertices()
  {
    merge_undecided();
    std::vector<int> degree(graph_.vertices.size(), 0);
    for (const Graph_piece& p : graph_.pieces) {
      ++degree[p.from];
      ++degree[p.to];
    }
    for (std::size_t v = 0; v < degree.size(); ++v) {
      Graph_vertex& vertex = graph_.vertices[v];
      if ((vertex.kind == Graph_vertex::Kind::boundary || vertex.kind == Graph_vertex::Kind::end) && degree[v] == 0)
        vertex.kind = Graph_vertex::Kind::isolated;
      // A smooth arc that only touches the boundary, or runs along it, goes on there.
      if (vertex.kind == Graph_vertex::Kind::boundary && degree[v] == 2 && !vertex.is_mark)
        vertex.kind = Graph_vertex::Kind::crossing;
      if (vertex.kind != Graph_vertex::Kind::crossing || degree[v] == 2 || degree[v] == 0) continue;
      if (!is_near(vertex, undecided_cells_) && !is_near(vertex, outside_cells_))
        throw std::logic_error("locus: an arc ends inside the domain");
      vertex.kind = Graph_vertex::Kind::open;
    }
  }

  bool is_near(const Graph_vertex& vertex, const std::vector<Index>& cells) const
  {
    for (const Index i : cells) {
      const Box<2>& b = tree_[i].box;
      if (vertex.at[0].sup() >= b.lo[0] && vertex.at[0].inf() <= b.hi[0] && vertex.at[1].sup() >= b.lo[1] &&
          vertex.at[1].inf() <= b.hi[1])
        return true;
    }
    return false;
  }

  /// Undecided cells that touch are reported as one box; so are boxes that a cause left open, where they may hold
  /// zeros of the equation at all.
  void merge_undecided()
  {
    for (std::size_t k = 0; k < undecided_cells_.size(); ++k)
      report_undecided({tree_[undecided_cells_[k]].box, undecided_reason_[k]});
    for (const auto& [cause, box] : special_.undecided)
      if (special_.may_hold_zeros(box)) report_undecided({box, "cannot decide the solutions of " + system_.causes[cause].name});
  }

  void report_undecided(Undecided_box added)
  {
    auto& list = graph_.undecided;
    for (std::size_t j = 0; j < list.size();) {
      const Box<2>& m = list[j].box;
      if (m.lo[0] > added.box.hi[0] || m.hi[0] < added.box.lo[0] || m.lo[1] > added.box.hi[1] || m.hi[1] < added.box.lo[1]) {
        ++j;
        continue;
      }
      for (std::size_t v = 0; v < 2; ++v) {
        added.box.lo[v] = std::min(added.box.lo[v], m.lo[v]);
        added.box.hi[v] = std::max(added.box.hi[v], m.hi[v]);
      }
      added.reason = list[j].reason;
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(j));
      j = 0;
    }
    list.push_back(std::move(added));
  }

  static bool runs_through(const Graph_vertex& v) { return v.kind == Graph_vertex::Kind::crossing; }

  void join_arcs()
  {
    std::vector<Arc_link> links;
    for (const Graph_piece& p : graph_.pieces) links.push_back({p.from, p.to});
    std::vector<char> through;
    for (const Graph_vertex& v : graph_.vertices) through.push_back(runs_through(v));
    for (Joined_arc& joined : join_links(links, through)) {
      Graph_arc arc;
      for (const auto& step : joined.steps) arc.steps.push_back({step.link, step.reversed});
      arc.closed = joined.closed;
      arc.source = joined.source;
      arc.target = joined.target;
      graph_.arcs.push_back(std::move(arc));
    }
  }

  void keep_forms()
  {
    graph_.forms.reserve(graph_.pieces.size());
    for (const Graph_piece& p : graph_.pieces) {
      const double width = tree_[p.cell].box.max_width();
      const bool small = width < 0x1p-5;
      if (width < Curve_graph::Cell_form::exact_below) tree_.exact(p.cell);
      graph_.forms.push_back({tree_[p.cell].box, small ? tree_.tight_form(p.cell) : tree_.bounded_form(p.cell), graph_.equation});
    }
  }

  void gather_statistics() { graph_.statistics.exact_cells = tree_.exact_cells(); }

  const System<1, 2>& system_;
  const Solve_control& control_;
  const Curve_attempt& attempt_;
  Special_points& special_;
  Curve_graph graph_;
  Cell_tree tree_;
  Face_segments segments_;
  std::vector<Faces> faces_;
  std::vector<Index> graph_cells_, node_cells_, corner_cells_, outside_cells_, undecided_cells_;
  std::vector<std::pair<int, Sign>> pivot_;
  std::vector<std::size_t> node_of_;
  std::vector<signed char> hessian_index_; ///< of the gradient's only zero in a cell, where the Hessian proves it
  std::vector<const char*> undecided_reason_;
  std::vector<Place> where_;
};

inline bool has_irregular_node(const Special_points& special)
{
  return std::any_of(special.points.begin(), special.points.end(),
                     [&](const Isolated_point& p) { return p.evidence && special.is_crossing(p); });
}

Curve_graph solve_curves_by_attempts(const System<1, 2>& system, const Solve_control& control, Claim_observer<2>* observer);

/// The claims are those of the square-free part.
inline Curve_graph solve_square_free(const Square_free_system& reduced, const Solve_control& control, Claim_observer<2>* observer)
{
  Curve_graph graph = solve_curves_by_attempts(reduced.system, control, observer);
  note_multiplicities(graph, reduced.factors);
  return graph;
}

/// Attempts one after the other: first without an eye for singular points that no cause explains; where cells stay open, with
/// those that exact algebra finds there. A singular point whose branches touch needs many cells near it: if too many, its own
/// is left larger.
inline Curve_graph solve_curves_by_attempts(const System<1, 2>& system, const Solve_control& control, Claim_observer<2>* observer)
{
  constexpr double doubtful_width = 0x1p-16;
  constexpr std::size_t doubtful_cells = 3000;
  constexpr double largest_node_width = 0x1p-6;
  constexpr std::size_t patient_cells = 1500;
  Special_points special(system, control);
  special.solve_causes();
  Solve_statistics before;
  Curve_attempt attempt;
  attempt.start = std::chrono::steady_clock::now();
  attempt.node_width = control.node_width;
  attempt.doubtful_width = doubtful_width;
  attempt.doubtful_cells = doubtful_cells;
  for (;;) {
    const std::size_t left = control.max_cells - std::min(control.max_cells, before.cells);
    const bool may_try_again = attempt.node_width < largest_node_width;
    attempt.max_cells = may_try_again && has_irregular_node(special) ? std::min(left, patient_cells) : left;
    Curve_solver solver(system, control, attempt, special);
    solver.keeps_claims = observer != nullptr;
    Curve_graph graph = solver.run();
    graph.statistics += before;
    if (!solver.doubtful.empty())
      if (const auto reduced = without_repetition(system)) return solve_square_free(*reduced, control, observer);
    if (!solver.doubtful.empty()) {
      special.find_singular_points(solver.doubtful);
      attempt.doubtful_width = 0;
      attempt.doubtful_cells = static_cast<std::size_t>(-1);
    } else if (may_try_again && !graph.undecided.empty() && !control.is_cancelled() && has_irregular_node(special)) {
      attempt.node_width = std::min(largest_node_width, attempt.node_width * 0x1p8);
    } else {
      if (observer)
        for (const Claim<2>& claim : solver.claims) observer->on_claim(claim);
      return graph;
    }
    before = graph.statistics;
  }
}

} // namespace detail

/// The zero set of one equation in two variables on the unit cell of its domain, certified; what could not be decided
/// is listed. Components along which a factor is repeated are zeros of the square-free part, with their multiplicity.
/// Needs upward rounding. Cost grows with the number of cells, O(degree³) each in doubles.
inline Curve_graph solve_curves(const System<1, 2>& system, const Solve_control& control = {},
                                Claim_observer<2>* observer = nullptr)
{
  return detail::solve_curves_by_attempts(system, control, observer);
}

} // namespace locus

#endif
