// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SYSTEM_TREE_H
#define LOCUS_ZERO_SET_SYSTEM_TREE_H

#include <locus/function/bounded_bernstein.h>
#include <locus/function/scaled_integer_bernstein.h>
#include <locus/number/filter_counts.h>
#include <locus/zero_set/system.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace locus {
namespace detail {

/// The cells of a binary subdivision with the Bernstein coefficients of K polynomials in D variables on each, raised to
/// common degrees so that polynomials can be combined: doubles with an error bound for each polynomial, in one arena;
/// `sharpen` replaces a cell's by better ones. Exact integers are made on demand along the path of ancestors and kept.
template <int K, int D>
class System_tree {
public:
  using Index = std::size_t;
  using Exact = Bernstein<Scaled_integer, D>;
  static constexpr Index none = static_cast<Index>(-1);

  struct Cell {
    Box<D> box;
    Index parent = none;
    int split_variable = -1; ///< how this cell was cut, -1 for a leaf
    double split_at = 0;
    Index low_child = none; ///< the high one follows it
    int depth = 0;
    Rung rung = Rung::bounded; ///< where the doubles come from: inherited, enclosed afresh, or rounded from exact ones
    std::array<double, static_cast<std::size_t>(K)> error{}, norm{};
    std::vector<Exact> exact; ///< none or K
  };

  explicit System_tree(const System<K, D>& system) : system_(system)
  {
    for (const auto& e : system.equations) degrees_ = max_degrees<D>(degrees_, e->degrees());
    count_ = coefficient_count(degrees_);
    cells_.resize(1);
    cells_[0].box = Box<D>::unit();
    cells_[0].error.fill(std::numeric_limits<double>::infinity());
    cells_[0].norm = cells_[0].error;
    arena_.resize(stride());
    enclose_afresh(0);
    cells_[0].rung = Rung::bounded; // a fresh enclosure of the unit cell is no better than this one
  }

  const Cell& operator[](Index i) const { return cells_[i]; }
  std::size_t size() const { return cells_.size(); }
  const Degrees<D>& degrees() const { return degrees_; }
  std::size_t coefficient_count_each() const { return count_; }
  std::uint64_t exact_cells() const { return exact_cells_; }

  /// Coefficients of polynomial k on a cell.
  const double* coefficients(Index i, std::size_t k) const { return arena_.data() + i * stride() + k * count_; }

  /// Replaces a cell's doubles by those of the next rung of the ladder. Below an ancestor that needed exact coefficients
  /// the middle rung is left out: zeros there are usually true zeros. False on the last rung.
  bool sharpen(Index i)
  {
    if (cells_[i].rung == Rung::exact) return false;
    const bool exact_near =
      !cells_[i].exact.empty() || (cells_[i].parent != none && !cells_[cells_[i].parent].exact.empty());
    if (cells_[i].rung == Rung::bounded && i != 0 && !exact_near) {
      enclose_afresh(i);
      cells_[i].rung = Rung::interval;
    } else {
      round_exact(i);
      cells_[i].rung = Rung::exact;
    }
    return true;
  }

  /// Exact coefficients of the K polynomials on a cell, each up to a positive factor.
  const std::vector<Exact>& exact(Index i)
  {
    if (!cells_[i].exact.empty()) return cells_[i].exact;
    ++exact_cells_;
    if (cells_[i].parent == none) make_exact_root();
    else split_exact(cells_[i].parent);
    return cells_[i].exact;
  }

  /// Cuts a leaf at `at`, a double strictly inside, and returns the low child.
  Index cut(Index i, int variable, double at)
  {
    const Index low = cells_.size();
    cells_.resize(low + 2);
    arena_.resize(cells_.size() * stride());
    cells_[i].split_variable = variable;
    cells_[i].split_at = at;
    cells_[i].low_child = low;
    for (const Index c : {low, low + 1}) {
      cells_[c].box = cells_[i].box;
      cells_[c].parent = i;
      cells_[c].depth = cells_[i].depth + 1;
    }
    const auto v = static_cast<std::size_t>(variable);
    cells_[low].box.hi[v] = cells_[low + 1].box.lo[v] = at;
    for (std::size_t k = 0; k < static_cast<std::size_t>(K); ++k) split_coefficients(i, k);
    return low;
  }

private:
  std::size_t stride() const { return static_cast<std::size_t>(K) * count_; }
  double* writable(Index i, std::size_t k) { return arena_.data() + i * stride() + k * count_; }

  void split_coefficients(Index i, std::size_t k)
  {
    const Cell& parent = cells_[i];
    const auto v = static_cast<std::size_t>(parent.split_variable);
    const double s = (parent.split_at - parent.box.lo[v]) / (parent.box.hi[v] - parent.box.lo[v]), rest = 1 - s;
    const Layout layout = layout_along(degrees_, parent.split_variable);
    const Index low = parent.low_child, high = low + 1;
    if (s == 0.5)
      split_kernel(coefficients(i, k), writable(low, k), writable(high, k), layout,
                   [](double a, double b) { return 0.5 * (a + b); });
    else
      split_kernel(coefficients(i, k), writable(low, k), writable(high, k), layout,
                   [=](double a, double b) { return rest * a + s * b; });
    // `s` may carry two roundings of its own; they move the cut, whose effect the derivative bounds by 2n·norm.
    const double n = degrees_[v];
    const double error = accumulated_error(parent.error[k], s == 0.5 ? n : 11 * n, parent.norm[k]);
    for (const Index c : {low, high}) adopt_bound(c, k, error);
  }

  void adopt_bound(Index i, std::size_t k, double error)
  {
    double m = 0;
    const double* c = coefficients(i, k);
    for (std::size_t j = 0; j < count_; ++j) m = std::max(m, std::abs(c[j]));
    cells_[i].error[k] = error;
    cells_[i].norm[k] = (m + error) * (1 + 2 * operation_error);
  }

  /// Takes over midpoints of intervals where their bound is better than the one at hand.
  void adopt(Index i, std::size_t k, const Bernstein<Interval, D>& f)
  {
    const auto b = bounded(elevated_to(f, degrees_));
    if (!(b.error() < cells_[i].error[k])) return;
    std::copy(b.values().data(), b.values().data() + count_, writable(i, k));
    adopt_bound(i, k, b.error());
  }

  void enclose_afresh(Index i)
  {
    for (std::size_t k = 0; k < static_cast<std::size_t>(K); ++k)
      adopt(i, k, system_.equations[k]->enclosure(cells_[i].box));
  }

  /// The exact forms are known up to positive factors, so their doubles replace the old ones, and the factor is free.
  void round_exact(Index i)
  {
    exact(i);
    for (std::size_t k = 0; k < static_cast<std::size_t>(K); ++k) {
      const Bernstein<Integer, D>& f = cells_[i].exact[k].values();
      std::size_t bits = 0;
      for (const Integer& c : f.coefficients()) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
      const auto rounded =
        bounded(converted<Interval>(f, [&](const Integer& c) { return enclosing_scaled(c, static_cast<long>(bits)); }));
      std::copy(rounded.values().data(), rounded.values().data() + count_, writable(i, k));
      adopt_bound(i, k, rounded.error());
    }
  }

  void make_exact_root()
  {
    for (const auto& e : system_.equations) {
      Exact f = e->exact();
      for (int v = 0; v < D; ++v)
        if (const int by = degrees_[static_cast<std::size_t>(v)] - f.degree(v); by > 0) f = elevate(f, v, by);
      cells_[0].exact.push_back(std::move(f));
    }
  }

  void split_exact(Index p)
  {
    exact(p);
    const auto v = static_cast<std::size_t>(cells_[p].split_variable);
    const Rational lo(cells_[p].box.lo[v]), hi(cells_[p].box.hi[v]);
    const Rational at = (Rational(cells_[p].split_at) - lo) / (hi - lo);
    const Index low = cells_[p].low_child;
    for (const Exact& f : cells_[p].exact) {
      auto parts = split(f, cells_[p].split_variable, at);
      cells_[low].exact.push_back(std::move(parts.first));
      cells_[low + 1].exact.push_back(std::move(parts.second));
    }
  }

  const System<K, D>& system_;
  Degrees<D> degrees_{};
  std::size_t count_ = 0;
  std::vector<Cell> cells_;
  std::vector<double> arena_;
  std::uint64_t exact_cells_ = 0;
};

} // namespace detail
} // namespace locus

#endif
