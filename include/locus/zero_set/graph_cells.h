// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_GRAPH_CELLS_H
#define LOCUS_ZERO_SET_GRAPH_CELLS_H

#include <locus/zero_set/cell_test.h>
#include <locus/zero_set/claim.h>
#include <locus/zero_set/solve_control.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace locus {

/// A cell that a limit or a doubt left over, and why.
template <int D>
struct Undecided_cell {
  Box<D> box;
  std::string reason;
};

struct Graph_statistics {
  std::size_t cells = 0;      ///< examined
  std::size_t leaves = 0;     ///< decided or given up
  std::size_t faces = 0;      ///< whose points were looked for
  std::size_t face_cells = 0; ///< cells of those searches
  std::uint64_t exact_cells = 0;
  Filter_counts filter;
};

namespace detail {

enum class Settled : unsigned char { yes, no, cut };

/// Subdivides the unit cell for K equations in D variables, breadth first, until each cell is empty, a graph, or given
/// up. `Faces` has a say in it:
///   bool admits(i, variable, at, is_last)  whether cell i may be cut there; with `is_last` nothing better is left
///   void was_cut(i)                        the tree has the children now
///   Settled settles(i, pivots)             whether a graph cell is finished, should be cut further, or cannot be finished
///   int wish(i)                            the variable along which a cell that was not settled should be cut; -1: any
///
/// Claims say of each leaf what it is. An empty one names its equation in `variable`, or -1 and, in `reason`, the weights of
/// the combination that has a sign (for the coefficients as the equations' enclosures scale them; on the exact rung each
/// polynomial has a scale of its own). A graph names its pivot in `variable` for K = 1, and for K > 1 the pivots as bits.
template <int K, int D, class Faces>
class Graph_subdivision {
public:
  using Tree = System_tree<K, D>;
  using Index = typename Tree::Index;

  Graph_subdivision(const System<K, D>& system, Tree& tree, Faces& faces, const Solve_control& control,
                    Claim_observer<D>* observer)
    : system_(system), tree_(tree), faces_(faces), control_(control), observer_(observer), test_(tree)
  {
  }

  struct Graph_leaf {
    Index cell;
    Pivot_set<K> pivots;
  };
  std::vector<Graph_leaf> graphs;
  std::vector<Index> outside;
  std::vector<std::pair<Index, std::string>> undecided;
  Graph_statistics statistics;

  void run()
  {
    std::vector<Index> level{0}, next;
    while (!level.empty()) {
      for (const Index i : level) {
        if (const char* limit = limit_reached(i)) {
          give_up(i, limit);
          continue;
        }
        ++statistics.cells;
        if (!decide(i)) cut(i, next);
      }
      level.swap(next);
      next.clear();
      if (control_.progress) with_nearest_rounding([&] { control_.progress(statistics.cells, level.size()); });
    }
    statistics.exact_cells = tree_.exact_cells();
  }

private:
  using Finding = Cell_finding<K>;
  using Kind = typename Finding::Kind;

  const char* limit_reached(Index i) const
  {
    if (statistics.cells >= control_.max_cells) return "cell limit";
    if (tree_[i].depth >= D * control_.max_depth) return "depth limit";
    if (control_.is_cancelled()) return "cancelled";
    if (!tree_[i].exact.empty())
      for (const auto& f : tree_[i].exact)
        if (mpz_sizeinbase(f.values()[0].get_mpz_t(), 2) > control_.max_bits) return "bit limit";
    if (std::isfinite(control_.max_seconds) &&
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > control_.max_seconds)
      return "time limit";
    return nullptr;
  }

  void give_up(Index i, std::string reason)
  {
    ++statistics.leaves;
    Claim<D> claim;
    claim.kind = Claim_kind::undecided;
    claim.box = tree_[i].box;
    claim.reason = reason;
    emit(claim);
    undecided.emplace_back(i, std::move(reason));
  }

  void emit(const Claim<D>& claim)
  {
    if (observer_) observer_->on_claim(claim);
  }

  bool settle(const Claim<D>& claim)
  {
    ++statistics.leaves;
    emit(claim);
    return true;
  }

  bool decide(Index i)
  {
    Claim<D> claim;
    claim.box = tree_[i].box;
    if (system_.outside && system_.outside(claim.box)) {
      outside.push_back(i);
      claim.kind = Claim_kind::outside;
      return settle(claim);
    }
    const Finding finding = climb(i);
    claim.rung = tree_[i].rung;
    if (finding.kind == Kind::empty) {
      claim.kind = Claim_kind::empty;
      claim.variable = finding.equation;
      if (observer_ && finding.equation < 0) claim.reason = "combination" + in_words(finding.weights);
      return settle(claim);
    }
    if (finding.kind != Kind::graph) return false;
    const Settled settled = faces_.settles(i, finding.pivots);
    if (settled == Settled::no) give_up(i, "points on the cell's faces are undecided");
    if (settled != Settled::yes) return settled == Settled::no;
    graphs.push_back({i, finding.pivots});
    claim.kind = Claim_kind::graph;
    claim.variable = K == 1 ? finding.pivots[0] : bits_of(finding.pivots);
    if (K > 1 && observer_) claim.reason = name_of(finding.pivots);
    return settle(claim);
  }

  /// Asks the rungs of the ladder in turn; the last word on a sign have the exact coefficients themselves.
  Finding climb(Index i)
  {
    for (;;) {
      Finding finding = test_.run(i);
      statistics.filter.record(tree_[i].rung, finding.kind != Kind::unknown);
      if (finding.kind != Kind::unknown) return finding;
      if (tree_.sharpen(i)) continue;
      finding.kind = Kind::nothing;
      for (int k = 0; k < K; ++k)
        if (has_one_strict_sign(tree_.exact(i)[static_cast<std::size_t>(k)])) {
          finding.kind = Kind::empty;
          finding.equation = k;
        }
      return finding;
    }
  }

  static bool has_one_strict_sign(const Bernstein<Scaled_integer, D>& f)
  {
    const Sign first = f.sign(0);
    for (std::size_t j = 0; j < f.size(); ++j)
      if (f.sign(j) != first) return false;
    return is_strict(first);
  }

  static std::string in_words(const std::array<double, static_cast<std::size_t>(K)>& weights)
  {
    std::string text;
    for (const double w : weights) {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, " %a", w);
      text += buffer;
    }
    return text;
  }

  /// Cuts where `Faces` likes it best. Where no cut is left, or the cell is as narrow as a singular point's may be, it is
  /// given up.
  void cut(Index i, std::vector<Index>& next)
  {
    const std::array<int, static_cast<std::size_t>(D)> order = cut_order(i);
    if (tree_[i].box.width(order[0]) <= control_.node_width)
      return give_up(i, "singular, or too fine for the smallest cell");
    for (const int variable : order)
      for (const double share : {0.5, 0.4375, 0.5625, 0.40625, 0.59375})
        if (cut_at(i, variable, share, false, next)) return;
    for (const int variable : order)
      if (cut_at(i, variable, 0.5, true, next)) return;
    give_up(i, "no admissible cut");
  }

  bool cut_at(Index i, int variable, double share, bool is_last, std::vector<Index>& next)
  {
    const Box<D> box = tree_[i].box;
    const auto v = static_cast<std::size_t>(variable);
    const double at = box.lo[v] + share * box.width(variable);
    if (!is_admissible(box, v, at) || !faces_.admits(i, variable, at, is_last)) return false;
    const Index low = tree_.cut(i, variable, at);
    faces_.was_cut(i);
    next.push_back(low);
    next.push_back(low + 1);
    emit_cut(box, variable, at);
    return true;
  }

  void emit_cut(const Box<D>& box, int variable, double at)
  {
    Claim<D> claim;
    claim.kind = Claim_kind::split;
    claim.box = box;
    claim.variable = variable;
    claim.at = at;
    emit(claim);
  }

  /// The cut has to be a double inside, far enough from the last bit.
  static bool is_admissible(const Box<D>& box, std::size_t v, double at)
  {
    return box.lo[v] < at && at < box.hi[v] && box.hi[v] - box.lo[v] > 0x1p-44;
  }

  /// The variables from the one to cut first: that along which the polynomials vary most, but cells that are long are cut
  /// across. Variables that hardly matter come last.
  std::array<int, static_cast<std::size_t>(D)> cut_order(Index i)
  {
    std::array<double, static_cast<std::size_t>(D)> weight = test_.spread(i);
    const double greatest = *std::max_element(weight.begin(), weight.end());
    const Box<D>& box = tree_[i].box;
    const auto matters = [&](int v) { return 16 * weight[static_cast<std::size_t>(v)] > greatest; };
    double longest = 0;
    for (int v = 0; v < D; ++v)
      if (matters(v)) longest = std::max(longest, box.width(v));
    const int wished = faces_.wish(i);
    for (int v = 0; v < D; ++v) {
      double& w = weight[static_cast<std::size_t>(v)];
      if (8 * box.width(v) < longest) w = 0;
      else if (box.width(v) == longest && matters(v)) w += greatest;
      if (v == wished) w = 4 * greatest + 1;
    }
    std::array<int, static_cast<std::size_t>(D)> order{};
    for (int v = 0; v < D; ++v) order[static_cast<std::size_t>(v)] = v;
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return weight[static_cast<std::size_t>(a)] > weight[static_cast<std::size_t>(b)];
    });
    return order;
  }

  const System<K, D>& system_;
  Tree& tree_;
  Faces& faces_;
  const Solve_control& control_;
  Claim_observer<D>* observer_;
  Cell_test<K, D> test_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace detail
} // namespace locus

#endif
