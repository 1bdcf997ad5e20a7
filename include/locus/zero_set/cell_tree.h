// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CELL_TREE_H
#define LOCUS_ZERO_SET_CELL_TREE_H

#include <locus/function/bounded_bernstein.h>
#include <locus/function/scaled_integer_bernstein.h>
#include <locus/number/filter_counts.h>
#include <locus/zero_set/system.h>

#include <limits>
#include <memory>
#include <vector>

namespace locus {
namespace detail {

/// What the coefficients of a polynomial say about its sign on a cell.
enum class Range_sign : unsigned char {
  negative,  ///< all strictly negative
  positive,  ///< all strictly positive
  weak_negative, ///< none positive, some exactly zero
  weak_positive, ///< none negative, some exactly zero
  zero,      ///< all exactly zero
  mixed,     ///< both signs occur for certain
  unknown    ///< this arithmetic cannot tell
};

constexpr bool is_strict(Range_sign s) { return s == Range_sign::negative || s == Range_sign::positive; }

/// Collects coefficient signs into a `Range_sign`; an unknown sign is an answer only beside both strict ones.
class Range_sign_of {
public:
  void add(Sign s)
  {
    if (s == Sign::positive) positive_ = true;
    else if (s == Sign::negative) negative_ = true;
    else if (s == Sign::zero) zero_ = true;
    else unknown_ = true;
  }
  bool is_mixed() const { return positive_ && negative_; }
  Range_sign result() const
  {
    if (is_mixed()) return Range_sign::mixed;
    if (unknown_) return Range_sign::unknown;
    if (!positive_ && !negative_) return Range_sign::zero;
    if (zero_) return positive_ ? Range_sign::weak_positive : Range_sign::weak_negative;
    return positive_ ? Range_sign::positive : Range_sign::negative;
  }

private:
  bool positive_ = false, negative_ = false, zero_ = false, unknown_ = false;
};

/// Whether intervals leave it open that an equation vanishes in a box, by its coefficients there.
inline bool may_vanish(const Equation<2>& equation, const Box<2>& box)
{
  Range_sign_of sign;
  const auto f = equation.enclosure(box);
  for (const Interval& c : f.coefficients()) sign.add(sign_of(c));
  return !is_strict(sign.result());
}

/// The cells of a subdivision with one polynomial's Bernstein coefficients on each: doubles with an error bound in one
/// arena, replaced by a fresh enclosure where a sign stays unknown, and exact integers made on demand along the path
/// of ancestors and kept there.
class Cell_tree {
public:
  using Index = std::size_t;
  static constexpr Index none = static_cast<Index>(-1);

  /// Least and greatest of some numbers; empty without any.
  struct Extent {
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;

    bool is_empty() const { return !(lo <= hi); }
    void add(double x)
    {
      lo = x < lo ? x : lo;
      hi = x > hi ? x : hi;
    }
  };

  struct Cell {
    Box<2> box;
    Index parent = none;
    int split_variable = -1; ///< how this cell was cut, -1 for a leaf
    double split_at = 0;
    bool is_high = false; ///< which part of the parent it is
    Index low_child = none, high_child = none;
    double error = 0, norm = 0;
    Extent coefficients; ///< in doubles
    mutable std::array<Extent, 2> differences; ///< of neighbours along a variable; empty before the first use
    int depth = 0;
    bool refreshed = false;
    std::unique_ptr<const Bernstein<Scaled_integer, 2>> exact; ///< apart, for few cells ever have it
  };

  /// With `all_exact` every sign is decided by the exact rung alone (see `Solve_control::all_exact`).
  Cell_tree(const Equation<2>& equation, Filter_counts& counts, bool all_exact = false)
    : equation_(equation), counts_(counts), degrees_(equation.degrees()), count_(coefficient_count(degrees_)),
      all_exact_(all_exact)
  {
    cells_.reserve(64);
    arena_.reserve(64 * count_);
    const auto root = bounded(equation.enclosure(Box<2>::unit()));
    cells_.push_back({});
    cells_[0].box = Box<2>::unit();
    cells_[0].error = root.error();
    arena_.assign(root.values().coefficients().begin(), root.values().coefficients().end());
    measure(0);
  }

  const Cell& operator[](Index i) const { return cells_[i]; }
  std::size_t size() const { return cells_.size(); }
  const Equation<2>& equation() const { return equation_; }
  const Degrees<2>& degrees() const { return degrees_; }
  const double* coefficients(Index i) const { return arena_.data() + i * count_; }
  Filter_counts& counts() const { return counts_; }
  bool all_exact() const { return all_exact_; }
  std::uint64_t exact_cells() const { return exact_cells_; }

  /// The cell's polynomial in doubles with its bound.
  Bernstein<Bounded, 2> bounded_form(Index i) const
  {
    const double* c = coefficients(i);
    return {Bernstein<double, 2>(degrees_, std::vector<double>(c, c + count_)), cells_[i].error};
  }

  /// The tightest form that is at hand: rounded from the exact one, or enclosed afresh where the inherited bound does
  /// not prove what the cell is used for.
  Bernstein<Bounded, 2> tight_form(Index i) const
  {
    if (cells_[i].exact) {
      const Bernstein<Rational, 2> f = cells_[i].exact->rational();
      return bounded(enclosing(f));
    }
    return cells_[i].refreshed ? bounded_form(i) : bounded(equation_.enclosure(cells_[i].box));
  }

  /// Exact coefficients on the cell, up to a positive factor.
  const Bernstein<Scaled_integer, 2>& exact(Index i)
  {
    if (!cells_[i].exact) {
      ++exact_cells_;
      if (cells_[i].parent == none) {
        keep_exact(i, equation_.exact());
      } else {
        const Index p = cells_[i].parent;
        const Cell& parent = cells_[p];
        const auto v = static_cast<std::size_t>(parent.split_variable);
        const Rational at = (Rational(parent.split_at) - Rational(parent.box.lo[v])) /
                            (Rational(parent.box.hi[v]) - Rational(parent.box.lo[v]));
        auto parts = split(exact(p), parent.split_variable, at);
        keep_exact(parent.low_child, std::move(parts.first));
        keep_exact(parent.high_child, std::move(parts.second));
      }
    }
    return *cells_[i].exact;
  }

  /// Cuts a cell at `at` (a double strictly inside) and returns the low child; the high one follows it.
  Index cut(Index i, int variable, double at)
  {
    const Index low = cells_.size(), high = low + 1;
    cells_.resize(cells_.size() + 2);
    arena_.resize(cells_.size() * count_);
    Cell& parent = cells_[i];
    const auto v = static_cast<std::size_t>(variable);
    const double width = parent.box.hi[v] - parent.box.lo[v];
    const double s = (at - parent.box.lo[v]) / width, rest = 1 - s;
    double* const base = arena_.data();
    const Layout layout = layout_along(degrees_, variable);
    if (s == 0.5)
      split_kernel(base + i * count_, base + low * count_, base + high * count_, layout,
                   [](double a, double b) { return 0.5 * (a + b); });
    else
      split_kernel(base + i * count_, base + low * count_, base + high * count_, layout,
                   [=](double a, double b) { return rest * a + s * b; });
    // `s` may carry two roundings of its own; they move the cut, whose effect the derivative bounds by 2n·norm.
    const double n = degrees_[v];
    const double error = accumulated_error(parent.error, s == 0.5 ? n : 3 * n + 8 * n, parent.norm);
    parent.split_variable = variable;
    parent.split_at = at;
    parent.low_child = low;
    parent.high_child = high;
    for (Index c : {low, high}) {
      Cell& child = cells_[c];
      child.box = parent.box;
      child.parent = i;
      child.is_high = c == high;
      child.depth = parent.depth + 1;
      child.error = error;
      (c == low ? child.box.hi : child.box.lo)[v] = at;
      measure(c);
    }
    return low;
  }

  /// Takes back the latest cut, whose children nobody has used yet.
  void undo_cut(Index i)
  {
    cells_.resize(cells_.size() - 2);
    arena_.resize(cells_.size() * count_);
    cells_[i].split_variable = -1;
    cells_[i].low_child = cells_[i].high_child = none;
  }

  /// Sign of the polynomial on the cell as its coefficients tell it, by the ladder.
  Range_sign range_sign(Index i, Rung& rung)
  {
    return climb(
      i, rung, [&] { return bounded_range(i); },
      [](const Bernstein<Interval, 2>& f) {
        Range_sign_of range;
        for (const Interval& c : f.coefficients()) {
          range.add(sign_of(c));
          if (range.is_mixed()) break;
        }
        return range.result();
      },
      [](const Bernstein<Scaled_integer, 2>& f) {
        Range_sign_of range;
        for (std::size_t k = 0; k < f.size(); ++k) range.add(f.sign(k));
        return range.result();
      });
  }

  /// Sign of a partial derivative on the cell, by the ladder.
  Range_sign derivative_sign(Index i, int variable, Rung& rung)
  {
    rung = Rung::bounded;
    if (degrees_[static_cast<std::size_t>(variable)] == 0) return Range_sign::zero;
    const Layout layout = layout_along(degrees_, variable);
    return climb(
      i, rung,
      [&] {
        const double bound = accumulated_error(2 * cells_[i].error, 2, 2 * cells_[i].norm);
        return range_of(differences(i, variable), bound);
      },
      [&](const Bernstein<Interval, 2>& f) {
        Range_sign_of range;
        for_each_difference(f.data(), layout, [&](const Interval& a, const Interval& b) { range.add(sign_of(b - a)); });
        return range.result();
      },
      [&](const Bernstein<Scaled_integer, 2>& f) {
        Range_sign_of range;
        for_each_difference(f.values().data(), layout,
                            [&](const Integer& a, const Integer& b) { range.add(sign_of_int(cmp(b, a))); });
        return range.result();
      });
  }

  /// Sign at a corner (0 or 1 for each variable), by the ladder.
  Sign corner_sign(Index i, int low_or_high_0, int low_or_high_1)
  {
    const std::size_t at = static_cast<std::size_t>(low_or_high_0 * degrees_[0]) * (static_cast<std::size_t>(degrees_[1]) + 1) +
                           static_cast<std::size_t>(low_or_high_1 * degrees_[1]);
    if (!all_exact_)
      if (const Sign s = filtered_corner_sign(i, at); is_certain(s)) return s;
    counts_.record(Rung::exact, true);
    return exact(i).sign(at);
  }

  /// Least and greatest difference of neighbouring coefficients along a variable, in doubles.
  void difference_range(Index i, int variable, double& lo, double& hi) const
  {
    const Extent& d = differences(i, variable);
    lo = d.lo;
    hi = d.hi;
  }

  /// Whether a coefficient on a face is proved not to be zero, by the bounded rung.
  bool is_nonzero_on_face(Index i, int variable, bool high) const
  {
    const Layout layout = layout_along(degrees_, variable);
    const double* const c = coefficients(i) + (high ? (layout.count - 1) * layout.inner : 0);
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t k = 0; k < layout.inner; ++k)
        if (is_strict(sign_of(c[o * layout.count * layout.inner + k], cells_[i].error))) return true;
    return false;
  }

private:
  static Range_sign range_of(const Extent& x, double bound)
  {
    if (x.lo > bound) return Range_sign::positive;
    if (x.hi < -bound) return Range_sign::negative;
    if (x.lo < -bound && x.hi > bound) return Range_sign::mixed;
    return Range_sign::unknown;
  }

  /// Computed once: the test of a derivative, the choice of the pivot and that of a cut all ask.
  const Extent& differences(Index i, int variable) const
  {
    Extent& e = cells_[i].differences[static_cast<std::size_t>(variable)];
    if (e.is_empty()) {
      const Layout layout = layout_along(degrees_, variable);
      for_each_difference(coefficients(i), layout, [&e](double a, double b) { e.add(b - a); });
    }
    return e;
  }

  template <class T, class F>
  static void for_each_difference(const T* c, const Layout& layout, F f)
  {
    const std::size_t block = layout.count * layout.inner;
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t k = 0; k + layout.inner < block; ++k) f(c[o * block + k], c[o * block + k + layout.inner]);
  }

  /// Sign of a coefficient by the bounded rung, then by a fresh enclosure.
  Sign filtered_corner_sign(Index i, std::size_t at)
  {
    Sign s = sign_of(coefficients(i)[at], cells_[i].error);
    counts_.record(Rung::bounded, is_certain(s));
    if (is_certain(s) || exact_near(i) || cells_[i].refreshed) return s;
    adopt(i, equation_.enclosure(cells_[i].box));
    s = sign_of(coefficients(i)[at], cells_[i].error);
    counts_.record(Rung::interval, is_certain(s));
    return s;
  }

  void keep_exact(Index i, Bernstein<Scaled_integer, 2> f)
  {
    cells_[i].exact = std::make_unique<const Bernstein<Scaled_integer, 2>>(std::move(f));
  }

  bool exact_near(Index i) const
  {
    return cells_[i].exact || (cells_[i].parent != none && cells_[cells_[i].parent].exact);
  }

  Range_sign bounded_range(Index i) const { return range_of(cells_[i].coefficients, cells_[i].error); }

  /// Asks the bounded rung, then a fresh enclosure on the box, then the exact one. Below an ancestor that needed
  /// exact coefficients the middle rung is left out: zeros there are usually true zeros.
  template <class Bounded_test, class Interval_test, class Exact_test>
  Range_sign climb(Index i, Rung& rung, Bounded_test bounded_test, Interval_test interval_test, Exact_test exact_test)
  {
    if (!all_exact_) {
      rung = Rung::bounded;
      Range_sign s = bounded_test();
      counts_.record(rung, s != Range_sign::unknown);
      if (s != Range_sign::unknown) return s;
      if (!exact_near(i)) {
        rung = Rung::interval;
        const auto f = equation_.enclosure(cells_[i].box);
        adopt(i, f);
        s = interval_test(f);
        counts_.record(rung, s != Range_sign::unknown);
        if (s != Range_sign::unknown) return s;
      }
    }
    rung = Rung::exact;
    counts_.record(rung, true);
    return exact_test(exact(i));
  }

  /// Takes over a fresh enclosure where its bound is better than the inherited one.
  void adopt(Index i, const Bernstein<Interval, 2>& f)
  {
    if (cells_[i].refreshed) return;
    cells_[i].refreshed = true;
    const auto b = bounded(f);
    if (!(b.error() < cells_[i].error)) return;
    std::copy(b.values().data(), b.values().data() + count_, arena_.begin() + static_cast<std::ptrdiff_t>(i * count_));
    cells_[i].error = b.error();
    measure(i);
  }

  void measure(Index i)
  {
    const double* c = coefficients(i);
    Extent e;
    for (std::size_t k = 0; k < count_; ++k) e.add(c[k]);
    Cell& cell = cells_[i];
    cell.coefficients = e;
    cell.differences = {Extent(), Extent()};
    cell.norm = (std::max(-e.lo, e.hi) + cell.error) * (1 + 2 * operation_error);
  }

  const Equation<2>& equation_;
  Filter_counts& counts_;
  Degrees<2> degrees_;
  std::size_t count_;
  bool all_exact_;
  std::vector<Cell> cells_;
  std::vector<double> arena_;
  std::uint64_t exact_cells_ = 0;
};

} // namespace detail
} // namespace locus

#endif
