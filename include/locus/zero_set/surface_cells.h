// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SURFACE_CELLS_H
#define LOCUS_ZERO_SET_SURFACE_CELLS_H

#include <locus/zero_set/graph_cells.h>

namespace locus {

/// A cell in which the zero set is a graph: at most one point over each value of the variables that are no pivots. It may
/// hold no point at all; `Sheet_evaluator` tells, value by value.
template <int K, int D>
struct Surface_cell {
  Box<D> box;
  Pivot_set<K> pivots;
};

/// Two cells that meet in a part of a plane x_v = c of positive size.
struct Cell_contact {
  std::size_t low, high; ///< the cell below the plane and the one above
  int variable;
};

/// The zero set of K equations in D variables, where it is a surface (D = K+2) or has any other dimension D-K ≥ 1,
/// enclosed by cells. Outside the cells and the undecided boxes there is no point of it. A sheet that lies in a plane
/// between two cells belongs to both.
template <int K, int D>
struct Surface_cells {
  std::vector<Surface_cell<K, D>> cells;
  std::vector<Cell_contact> contacts;
  std::vector<Undecided_cell<D>> undecided;
  Graph_statistics statistics;

  bool is_certified() const { return undecided.empty(); }
};

namespace detail {

/// Cuts anywhere, but where a polynomial seems to vanish on the cut only if nothing else is left.
template <int K, int D>
class Free_cuts {
public:
  using Index = typename System_tree<K, D>::Index;

  Free_cuts(const System<K, D>& system, const System_tree<K, D>& tree) : system_(system), tree_(tree) {}

  bool admits(Index i, int variable, double at, bool is_last) const
  {
    Box<D> slice = tree_[i].box;
    slice.lo[static_cast<std::size_t>(variable)] = slice.hi[static_cast<std::size_t>(variable)] = at;
    for (const auto& e : system_.equations)
      if (!is_last && may_vanish(e->enclosure(slice))) return false;
    return true;
  }
  void was_cut(Index) const {}
  Settled settles(Index, const Pivot_set<K>&) const { return Settled::yes; }
  int wish(Index) const { return -1; }

private:
  static bool may_vanish(const Bernstein<Interval, D>& f)
  {
    for (const Interval& c : f.coefficients())
      if (!contains_zero(c)) return false;
    return true;
  }

  const System<K, D>& system_;
  const System_tree<K, D>& tree_;
};

/// Finds all pairs of leaves that meet in a part of a plane, by a walk down both sides of every cut.
template <int K, int D>
class Contact_finder {
public:
  using Tree = System_tree<K, D>;
  using Index = typename Tree::Index;

  /// `number[i]` is what the cell i is called in the result; those with `none` are left out.
  Contact_finder(const Tree& tree, const std::vector<std::size_t>& number) : tree_(tree), number_(number) {}

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::vector<Cell_contact> run()
  {
    for (Index i = 0; i < tree_.size(); ++i)
      if (tree_[i].split_variable >= 0) pair(tree_[i].low_child, tree_[i].low_child + 1, tree_[i].split_variable);
    return std::move(contacts_);
  }

private:
  void pair(Index low, Index high, int variable)
  {
    if (!overlap_beside(tree_[low].box, tree_[high].box, variable)) return;
    const int cut_low = tree_[low].split_variable, cut_high = tree_[high].split_variable;
    if (cut_low >= 0) {
      if (cut_low != variable) pair(tree_[low].low_child, high, variable);
      pair(tree_[low].low_child + 1, high, variable);
    } else if (cut_high >= 0) {
      pair(low, tree_[high].low_child, variable);
      if (cut_high != variable) pair(low, tree_[high].low_child + 1, variable);
    } else if (number_[low] != none && number_[high] != none) {
      contacts_.push_back({number_[low], number_[high], variable});
    }
  }

  static bool overlap_beside(const Box<D>& a, const Box<D>& b, int variable)
  {
    for (int v = 0; v < D; ++v) {
      const auto vv = static_cast<std::size_t>(v);
      if (v != variable && !(a.lo[vv] < b.hi[vv] && b.lo[vv] < a.hi[vv])) return false;
    }
    return true;
  }

  const Tree& tree_;
  const std::vector<std::size_t>& number_;
  std::vector<Cell_contact> contacts_;
};

} // namespace detail

/// Encloses the zero set of K equations on the unit cell by cells in which it is a graph, and says which of them meet.
/// Singular points stay undecided, in cells no wider than `control.node_width`. Causes and known factors of the system
/// are not used. Needs upward rounding. A cell costs O(C(D,K)·K²·n) operations for n coefficients.
template <int K, int D>
Surface_cells<K, D> surface_cells(const System<K, D>& system, const Solve_control& control = {},
                                  Claim_observer<D>* observer = nullptr)
{
  detail::System_tree<K, D> tree(system);
  detail::Free_cuts<K, D> cuts(system, tree);
  detail::Graph_subdivision<K, D, detail::Free_cuts<K, D>> cells(system, tree, cuts, control, observer);
  cells.run();
  using Finder = detail::Contact_finder<K, D>;
  std::vector<std::size_t> number(tree.size(), Finder::none);
  Surface_cells<K, D> result;
  for (const auto& g : cells.graphs) {
    number[g.cell] = result.cells.size();
    result.cells.push_back({tree[g.cell].box, g.pivots});
  }
  for (const auto& [cell, reason] : cells.undecided) result.undecided.push_back({tree[cell].box, reason});
  result.contacts = Finder(tree, number).run();
  result.statistics = cells.statistics;
  return result;
}

} // namespace locus

#endif
