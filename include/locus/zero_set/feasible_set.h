// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_FEASIBLE_SET_H
#define LOCUS_ZERO_SET_FEASIBLE_SET_H

#include <locus/zero_set/feasible_end.h>
#include <locus/zero_set/root_enclosure.h>
#include <locus/zero_set/solve_control.h>

#include <array>
#include <iterator>
#include <map>

namespace locus {

/// u is feasible from `ends[0]` to `ends[1]`, and infeasible just beyond them.
struct Feasible_interval {
  std::array<Feasible_end, 2> ends;
  double inside = 0; ///< a feasible u between the ends
};

struct Feasible_set {
  std::vector<Feasible_interval> intervals; ///< in order
  std::vector<std::array<double, 2>> undecided;
  std::size_t cells = 0, algebraic_cells = 0;
  Filter_counts filter;
};

namespace detail {

/// Finds the u of the unit interval for which all requirements hold: cells [lo, hi] of u, breadth first, each with the
/// requirements that may still fail on it.
class Feasible_set_solver {
public:
  Feasible_set_solver(const std::vector<Requirement>& requirements, const Solve_control& control)
    : requirements_(requirements), control_(control), signs_(requirements, result_.filter), refiner_(requirements, result_.filter)
  {
    for (const Requirement& r : requirements_) {
      family_.push_back(family_of(r.a.get()));
      corners_.push_back(r.corners);
      group_.push_back(r.square ? group_of({family_.back(), family_of(r.rest.get()), family_of(r.square.get())}) : 0);
    }
  }

  Feasible_set run()
  {
    Cell root;
    root.hi = 1;
    for (Vector_tree* a : families_) root.a.push_back(a->node(0).f);
    for (std::size_t r = 0; r < requirements_.size(); ++r) root.open.push_back({r, 0, 0});
    std::vector<Cell> level{std::move(root)}, next;
    for (int depth = 0; !level.empty(); ++depth) {
      next.clear();
      std::vector<Cell> stuck;
      // Many open cells side by side: requirements that vanish along a curve.
      const bool give_up = depth >= (groups_.empty() ? deepest : deepest_rooted) || level.size() > most_open || result_.cells > control_.max_cells || control_.is_cancelled();
      for (Cell& cell : level) treat(cell, depth, give_up ? &stuck : nullptr, next);
      stuck.insert(stuck.end(), std::make_move_iterator(crowded_.begin()), std::make_move_iterator(crowded_.end()));
      crowded_.clear();
      if (control_.is_cancelled())
        for (const Cell& cell : stuck) result_.undecided.push_back({cell.lo, cell.hi});
      else if (!stuck.empty()) by_algebra(stuck);
      level.swap(next);
    }
    merge();
    return std::move(result_);
  }

private:
  static constexpr int deepest = 30;
  static constexpr int deepest_rooted = 22; ///< double zeros drown in the root's error below
  static constexpr std::size_t most_open = 100, most_parts = 200;

  /// √square·a + rest on a cell, by a polynomial q near the root: `middle` is q·a + rest, `a` is written with its degree.
  struct Rooted {
    Enclosed_vector middle, a;
    std::optional<Root_enclosure> root;
    bool is_steep = false; ///< the square grows so much that other things will turn fast, too
    std::optional<std::array<Vector_form, 2>> exact; ///< of both
  };

  struct Cell {
    double lo = 0, hi = 1;
    std::vector<Enclosed_vector> a; ///< of each family
    std::vector<Open_requirement> open;
    std::vector<std::optional<Vector_form>> exact;
    std::vector<std::optional<Rooted>> rooted; ///< of each group

    double width() const { return hi - lo; }
  };

  enum class Outcome { satisfied, violated, open, waiting }; ///< waiting for smaller cells, not for smaller parts of v

  std::size_t family_of(Vector_tree* a)
  {
    const auto found = std::find(families_.begin(), families_.end(), a);
    if (found != families_.end()) return static_cast<std::size_t>(found - families_.begin());
    families_.push_back(a);
    return families_.size() - 1;
  }

  /// Families of a, rest and square that go together.
  using Group = std::array<std::size_t, 3>;

  std::size_t group_of(const Group& group)
  {
    const auto found = std::find(groups_.begin(), groups_.end(), group);
    if (found != groups_.end()) return static_cast<std::size_t>(found - groups_.begin());
    groups_.push_back(group);
    return groups_.size() - 1;
  }

  // ------------------------------------------------------------------------------------------------------------ cells

  void treat(Cell& cell, int depth, std::vector<Cell>* stuck, std::vector<Cell>& next)
  {
    ++result_.cells;
    if (is_violated_as_neighbours(cell)) return;
    std::vector<Open_requirement>& kept = kept_;
    std::vector<Open_requirement>& todo = todo_;
    kept.clear();
    todo.assign(cell.open.rbegin(), cell.open.rend());
    while (!todo.empty()) {
      Open_requirement r = todo.back();
      todo.pop_back();
      Vector_tree& b = *requirements_[r.requirement].b;
      const Outcome outcome = examine(cell, r, depth);
      if (outcome == Outcome::violated) {
        remember_violator(r);
        return;
      }
      if (outcome == Outcome::satisfied) continue;
      if (outcome == Outcome::waiting) {
        kept.push_back(r);
        continue;
      }
      if (kept.size() + todo.size() > (groups_.empty() ? most_parts + 8 * requirements_.size() : most_parts * requirements_.size())) { // as where a requirement vanishes for all v at one u
        kept.push_back(r);
        kept.insert(kept.end(), todo.begin(), todo.end());
        cell.open = kept;
        crowded_.push_back(std::move(cell));
        return;
      }
      // Where the requirement is monotone in u the whole part of v is as good as smaller ones.
      if (r.slope == 0 && b.node(r.node).f.degree() > 0 && b.node(r.node).width() >= 2 * cell.width()) {
        const std::size_t low = b.halve(r.node);
        todo.push_back({r.requirement, low + 1, 0});
        todo.push_back({r.requirement, low, 0});
      } else {
        kept.push_back(r);
      }
    }
    cell.open = kept;
    if (cell.open.empty()) {
      add_whole(cell);
      return;
    }
    if (settle_monotone(cell)) return;
    if (stuck) {
      stuck->push_back(std::move(cell));
      return;
    }
    halve(cell, next);
  }

  void halve(const Cell& cell, std::vector<Cell>& next) const
  {
    Cell low, high;
    const double middle = 0.5 * (cell.lo + cell.hi);
    low.lo = cell.lo;
    low.hi = high.lo = middle;
    high.hi = cell.hi;
    for (const Enclosed_vector& a : cell.a) {
      auto parts = a.halves();
      low.a.push_back(std::move(parts.first));
      high.a.push_back(std::move(parts.second));
    }
    low.open = high.open = cell.open;
    next.push_back(std::move(low));
    next.push_back(std::move(high));
  }

  /// A v at which a requirement was violated on a whole cell; it may be on the next cells, too.
  struct Violator {
    std::size_t requirement;
    double v;
    Enclosed_vector b;
  };

  bool is_violated_as_neighbours(const Cell& cell)
  {
    for (std::size_t k = 0; k < violators_.size(); ++k) {
      table_.make(cell.a[family_[violators_[k].requirement]], violators_[k].b);
      if (!std::all_of(table_.c.begin(), table_.c.end(), [&](double x) { return x < -table_.error; })) continue;
      result_.filter.record(Rung::bounded, true);
      std::rotate(violators_.begin(), violators_.begin() + static_cast<std::ptrdiff_t>(k), violators_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      return true;
    }
    return false;
  }

  /// The latest ones, the last that helped first.
  void remember_violator(const Open_requirement& r)
  {
    constexpr std::size_t most = 6;
    const Requirement& requirement = requirements_[r.requirement];
    if (requirement.square) return;
    const auto& node = requirement.b->node(r.node);
    const double v = violated_at_high_end_ ? node.hi : node.lo;
    if (violators_.size() == most) violators_.pop_back();
    violators_.insert(violators_.begin(), Violator{r.requirement, v, requirement.b->node(0).f.at(v)});
  }

  // ---------------------------------------------------------------------------------------------- one requirement

  /// The ends of the unit square at which the cell examined lies, u's and v's.
  struct Position {
    std::size_t requirement;
    std::array<bool, 2> at_u, at_v;
  };

  Outcome examine(Cell& cell, Open_requirement& r, int depth)
  {
    const Requirement& requirement = requirements_[r.requirement];
    if (requirement.square) return examine_rooted(cell, r, depth);
    const auto& node = requirement.b->node(r.node);
    table_.make(cell.a[family_[r.requirement]], node.f);
    const Position position{r.requirement, {cell.lo == 0, cell.hi == 1}, {node.lo == 0, node.hi == 1}};
    if (const auto outcome = judge_at_once(position, depth, r.slope)) {
      result_.filter.record(Rung::bounded, true);
      return *outcome;
    }
    const auto sign = [&](std::size_t i, std::size_t j) {
      const Sign s = sign_of(table_.at(i, j), table_.error);
      return is_certain(s) || !is_known_zero(position, i, j) ? s : Sign::zero;
    };
    const auto rise = [&](std::size_t i, std::size_t j) {
      const Sign s = sign_of(table_.at(i + 1, j) - table_.at(i, j), 2 * table_.error * (1 + 4 * operation_error) + operation_error * std::abs(table_.at(i, j)));
      return is_certain(s) || !(is_known_zero(position, i, j) && is_known_zero(position, i + 1, j)) ? s : Sign::zero;
    };
    auto [outcome, unknown] = judge(sign, sign, rise, r.slope);
    result_.filter.record(Rung::bounded, !unknown);
    if (outcome == Outcome::open && unknown && depth >= exact_from) {
      result_.filter.record(Rung::exact, true);
      const Vector_form &a = exact_on(cell, family_[r.requirement]), &b = requirement.b->exact_on(r.node);
      std::vector<Rational> c(table_.rows * table_.columns);
      for (std::size_t i = 0; i < table_.rows; ++i)
        for (std::size_t j = 0; j < table_.columns; ++j) c[i * table_.columns + j] = dot_at(a, i, b, j);
      const auto exact_sign = [&](std::size_t i, std::size_t j) { return sign_of_int(sgn(c[i * table_.columns + j])); };
      outcome = judge(exact_sign, exact_sign, [&](std::size_t i, std::size_t j) { return sign_of_int(cmp(c[(i + 1) * table_.columns + j], c[i * table_.columns + j])); }, r.slope)
                  .first;
    }
    return outcome;
  }

  /// The answer where extreme coefficients give it, away from corners and while cells are wide: the rule.
  std::optional<Outcome> judge_at_once(const Position& position, int depth, int& slope)
  {
    const std::size_t rows = table_.rows, columns = table_.columns;
    const double* const c = table_.c.data();
    double least = c[0], first = c[0], last = c[columns - 1];
    for (std::size_t k = 0; k < rows * columns; ++k) least = std::min(least, c[k]);
    if (least > table_.error) return Outcome::satisfied;
    for (std::size_t i = 1; i < rows; ++i) {
      first = std::max(first, c[i * columns]);
      last = std::max(last, c[i * columns + columns - 1]);
    }
    violated_at_high_end_ = !(first < -table_.error);
    if (std::min(first, last) < -table_.error) return Outcome::violated;
    const bool at_corner = (position.at_u[0] || position.at_u[1]) && (position.at_v[0] || position.at_v[1]);
    if (at_corner || depth >= exact_from || !(least < -table_.error)) return std::nullopt;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (std::size_t k = 0; k + columns < rows * columns; ++k) {
      lowest = std::min(lowest, c[k + columns] - c[k]);
      highest = std::max(highest, c[k + columns] - c[k]);
    }
    const double error = 2 * table_.error * (1 + 4 * operation_error) + 2 * operation_error * (std::abs(lowest) + std::abs(highest));
    slope = lowest > error ? 2 : highest < -error ? -2 : 0;
    return Outcome::open;
  }

  /// Exact coefficients are formed in cells narrower than 2^-`exact_from`: before, halving is cheaper.
  static constexpr int exact_from = 12;

  /// The same with a root, which lies between q - e and q + e.
  Outcome examine_rooted(Cell& cell, Open_requirement& r, int depth)
  {
    const Requirement& requirement = requirements_[r.requirement];
    const auto& node = requirement.b->node(r.node);
    Rooted& rooted = rooted_on(cell, group_[r.requirement]);
    r.slope = 0;
    if (!rooted.root) return Outcome::waiting;
    const double e = rooted.root->error;
    table_.make(rooted.middle, node.f);
    size_.make(rooted.a, node.f);
    double greatest = 0, steepest = 0;
    for (const double x : size_.c) greatest = std::max(greatest, std::abs(x));
    for (std::size_t k = 0; k + size_.columns < size_.c.size(); ++k) steepest = std::max(steepest, std::abs(size_.c[k + size_.columns] - size_.c[k]));
    // The derivative of (root - q)·a·b, as a difference of neighbouring coefficients.
    const double rise_error = (rooted.root->slope_error * (greatest + size_.error) / std::max(1.0, static_cast<double>(table_.rows) - 1) +
                               e * (steepest + 2 * size_.error)) * (1 + 16 * operation_error);
    const Position position{r.requirement, {cell.lo == 0, cell.hi == 1}, {node.lo == 0, node.hi == 1}};
    const auto sign = [&](double shift) {
      return [&, shift](std::size_t i, std::size_t j) {
        const double middle = table_.at(i, j), more = shift * size_.at(i, j);
        const Sign s = sign_of(middle + more, (table_.error + e * size_.error + 2 * operation_error * (std::abs(middle) + 2 * std::abs(more))) * (1 + 8 * operation_error));
        return is_certain(s) || !is_known_zero(position, i, j) ? s : Sign::zero;
      };
    };
    bool slope_unknown = false;
    const auto rise = [&](std::size_t i, std::size_t j) {
      const Sign s = sign_of(table_.at(i + 1, j) - table_.at(i, j), (2 * table_.error + rise_error + operation_error * std::abs(table_.at(i, j))) * (1 + 8 * operation_error));
      slope_unknown = slope_unknown || !is_certain(s);
      return is_certain(s) ? s : Sign::zero;
    };
    auto [outcome, unknown] = judge(sign(-e), sign(e), rise, r.slope);
    if (slope_unknown) r.slope = 0;
    if (outcome == Outcome::open && r.slope == 0 && rooted.is_steep) outcome = Outcome::waiting;
    result_.filter.record(Rung::bounded, !unknown);
    // Exact coefficients tell more only where the root is known better than they are.
    if (outcome != Outcome::open || !unknown || depth < exact_from || !(64 * e * greatest < table_.error)) return outcome;
    result_.filter.record(Rung::exact, true);
    const auto& [middle, a] = exact_rooted_on(cell, group_[r.requirement]);
    const Vector_form& b = requirement.b->exact_on(r.node);
    std::vector<Rational> c(table_.c.size()), size(table_.c.size());
    for (std::size_t i = 0; i < table_.rows; ++i)
      for (std::size_t j = 0; j < table_.columns; ++j) {
        c[i * table_.columns + j] = dot_at(middle, i, b, j);
        size[i * table_.columns + j] = dot_at(a, i, b, j);
      }
    const Rational error(e);
    const auto exact_sign = [&](int side) {
      return [&, side](std::size_t i, std::size_t j) {
        const std::size_t k = i * table_.columns + j;
        return sign_of(Rational(c[k] + side * error * size[k]));
      };
    };
    const auto exact_rise = [&, slack = Rational(rise_error)](std::size_t i, std::size_t j) {
      const Rational x = c[(i + 1) * table_.columns + j] - c[i * table_.columns + j];
      slope_unknown = slope_unknown || abs(x) <= slack;
      return sign_of(x);
    };
    slope_unknown = false;
    outcome = judge(exact_sign(-1), exact_sign(1), exact_rise, r.slope).first;
    if (slope_unknown) r.slope = 0;
    return outcome;
  }

  Rooted& rooted_on(Cell& cell, std::size_t group)
  {
    cell.rooted.resize(groups_.size());
    auto& rooted = cell.rooted[group];
    if (rooted) return *rooted;
    rooted.emplace();
    const auto [a, rest, square] = groups_[group];
    rooted->root = root_enclosure(cell.a[square]);
    if (!rooted->root) return *rooted;
    const auto [least, greatest] = std::minmax_element(cell.a[square].component(0), cell.a[square].component(0) + cell.a[square].count());
    rooted->is_steep = *greatest > 16 * *least;
    rooted->middle = combined(Bernstein<Bounded, 1>(rooted->root->near, 0), cell.a[a], cell.a[rest]);
    rooted->a = elevated(cell.a[a], rooted->root->near.degree());
    return *rooted;
  }

  const std::array<Vector_form, 2>& exact_rooted_on(Cell& cell, std::size_t group)
  {
    auto& exact = cell.rooted[group]->exact;
    if (exact) return *exact;
    const auto near = converted<Rational>(cell.rooted[group]->root->near, [](double x) { return Rational(x); });
    const Vector_form &a = exact_on(cell, groups_[group][0]), &rest = exact_on(cell, groups_[group][1]);
    exact.emplace();
    for (std::size_t k = 0; k < a.size(); ++k) {
      (*exact)[0].push_back(add(multiply(near, a[k]), rest[k]));
      (*exact)[1].push_back(elevate(a[k], 0, near.degree()));
    }
    return *exact;
  }

  /// From signs of coefficients: `low` of what is nowhere above the requirement's, `high` of what is nowhere below; for a plain
  /// one both are its own. With whether exact signs might say more.
  template <class Low_at, class High_at, class Rise_at>
  std::pair<Outcome, bool> judge(Low_at low, High_at high, Rise_at rise, int& slope)
  {
    bool any_negative = false, any_unknown = false;
    for (std::size_t k = 0; k < table_.c.size(); ++k) {
      const Sign s = low(k / table_.columns, k % table_.columns);
      any_negative = any_negative || s == Sign::negative;
      any_unknown = any_unknown || s == Sign::unknown;
    }
    if (!any_negative && !any_unknown) return {Outcome::satisfied, false};
    bool column_unknown = false;
    for (const std::size_t j : {std::size_t{0}, table_.columns - 1}) {
      bool negative = true, possible = true;
      for (std::size_t i = 0; i < table_.rows; ++i) {
        const Sign s = high(i, j);
        negative = negative && s == Sign::negative;
        possible = possible && (s == Sign::negative || s == Sign::unknown);
      }
      if (negative) {
        violated_at_high_end_ = j > 0;
        return {Outcome::violated, false};
      }
      column_unknown = column_unknown || possible;
    }
    bool rising = true, falling = true, slope_unknown = false;
    std::array<bool, 2> moves{}; // on the first, on the last column: with both it does for every v
    for (std::size_t i = 0; i + 1 < table_.rows; ++i)
      for (std::size_t j = 0; j < table_.columns; ++j) {
        const Sign s = rise(i, j);
        moves[0] = moves[0] || (j == 0 && s != Sign::zero);
        moves[1] = moves[1] || (j + 1 == table_.columns && s != Sign::zero);
        rising = rising && (s == Sign::positive || s == Sign::zero);
        falling = falling && (s == Sign::negative || s == Sign::zero);
        slope_unknown = slope_unknown || s == Sign::unknown;
      }
    slope = (rising ? 1 : falling ? -1 : 0) * (moves[0] && moves[1] ? 2 : 1);
    return {Outcome::open, (any_unknown && !any_negative) || column_unknown || (slope_unknown && slope == 0)};
  }

  const Vector_form& exact_on(Cell& cell, std::size_t family)
  {
    cell.exact.resize(families_.size());
    if (!cell.exact[family]) cell.exact[family] = families_[family]->part(cell.lo, cell.hi);
    return *cell.exact[family];
  }

  // ---------------------------------------------------------------------------------------------------------- corners

  const Corner_zeros& zeros_at(std::size_t requirement, std::size_t end_u, std::size_t end_v)
  {
    auto& known = corners_[requirement][2 * end_u + end_v];
    const Requirement& r = requirements_[requirement];
    if (!known) known = corner_zeros(r, static_cast<int>(end_u), static_cast<int>(end_v));
    return *known;
  }

  /// Whether a coefficient of the table, not told from zero by doubles, is zero because of its place beside a corner.
  bool is_known_zero(const Position& position, std::size_t i, std::size_t j)
  {
    for (std::size_t end_u = 0; end_u < 2; ++end_u)
      for (std::size_t end_v = 0; end_v < 2; ++end_v) {
        if (!position.at_u[end_u] || !position.at_v[end_v]) continue;
        const std::size_t di = end_u ? table_.rows - 1 - i : i, dj = end_v ? table_.columns - 1 - j : j;
        if (di + dj > 1 || is_strict(sign_of(table_.at(end_u ? table_.rows - 1 : 0, end_v ? table_.columns - 1 : 0), table_.error))) continue;
        const Corner_zeros& z = zeros_at(position.requirement, end_u, end_v);
        if (z.here && (di == 0 || z.next_u) && (dj == 0 || z.next_v)) return true;
      }
    return false;
  }

  // ----------------------------------------------------------------------------------------------------------- leaves

  struct Found {
    double lo, hi; ///< the cell
    Feasible_interval interval;
    bool whole_low = false, whole_high = false; ///< the interval reaches the cell's ends
  };

  void add_whole(const Cell& cell) { add_whole(cell.lo, cell.hi); }

  void add_whole(double lo, double hi)
  {
    Found f;
    f.lo = lo;
    f.hi = hi;
    f.interval.ends[0].lo = f.interval.ends[0].hi = lo;
    f.interval.ends[1].lo = f.interval.ends[1].hi = hi;
    f.interval.inside = 0.5 * (lo + hi);
    f.whole_low = f.whole_high = true;
    found_.push_back(std::move(f));
  }

  /// Where all open requirements are monotone in u, the rising ones hold from one place on and the falling ones up to another.
  bool settle_monotone(const Cell& cell)
  {
    std::array<Feasible_end, 2> ends; // below which the rising ones fail; above which the falling ones do
    for (const Open_requirement& r : cell.open) {
      if (r.slope == 0) return false;
      ends[r.slope > 0 ? 0 : 1].open.push_back(r);
    }
    Found f;
    f.lo = cell.lo;
    f.hi = cell.hi;
    for (std::size_t e = 0; e < 2; ++e) {
      const double good = e == 0 ? cell.hi : cell.lo, bad = e == 0 ? cell.lo : cell.hi;
      const Sign at_good = signs_.at(ends[e].open, good);
      if (at_good == Sign::negative) return true; // nowhere feasible
      const bool is_whole = signs_.at(ends[e].open, bad) != Sign::negative;
      if (!is_whole && at_good == Sign::zero) {
        // Feasible at the end alone: a neighbour's end, if anything's. But the zero may be one for all u.
        const bool strict = std::all_of(ends[e].open.begin(), ends[e].open.end(), [](const Open_requirement& r) { return std::abs(r.slope) > 1; });
        if (!strict) by_algebra(cell.lo, cell.hi, cell.open);
        return true;
      }
      ends[e].lo = is_whole ? bad : cell.lo;
      ends[e].hi = is_whole ? bad : cell.hi;
      if (is_whole) ends[e].open.clear();
      (e == 0 ? f.whole_low : f.whole_high) = is_whole;
    }
    if (!f.whole_low && !f.whole_high && !separate(ends)) {
      by_algebra(std::min(ends[0].lo, ends[1].lo), std::max(ends[0].hi, ends[1].hi), cell.open);
      return true;
    }
    if (ends[0].lo >= ends[1].hi && !(f.whole_low && f.whole_high)) return true; // they contradict each other
    f.interval.inside = 0.5 * (ends[0].hi + ends[1].lo);
    f.interval.ends = std::move(ends);
    found_.push_back(std::move(f));
    return true;
  }

  /// Narrows two boundary points until their enclosures are disjoint; false where they seem to be equal.
  bool separate(std::array<Feasible_end, 2>& ends)
  {
    for (double width = 0.25 * (ends[0].hi - ends[0].lo); width > 0x1p-44; width *= 0x1p-8) {
      for (int e = 0; e < 2; ++e) refiner_.narrow(ends[static_cast<std::size_t>(e)], e, width);
      if (ends[0].hi < ends[1].lo || ends[1].hi < ends[0].lo) return true;
    }
    return false;
  }

  // ---------------------------------------------------------------------------------------------------------- algebra

  /// Cells that stayed open: runs of neighbours by their exact boundary points.
  void by_algebra(std::vector<Cell>& cells)
  {
    std::sort(cells.begin(), cells.end(), [](const Cell& x, const Cell& y) { return x.lo < y.lo; });
    for (std::size_t i = 0; i < cells.size();) {
      std::size_t j = i + 1;
      std::vector<Open_requirement> open = cells[i].open;
      while (j < cells.size() && cells[j].lo == cells[j - 1].hi) {
        for (const Open_requirement& r : cells[j].open)
          if (std::none_of(open.begin(), open.end(), [&](const Open_requirement& o) { return o.requirement == r.requirement && o.node == r.node; })) open.push_back(r);
        ++j;
      }
      by_algebra(cells[i].lo, cells[j - 1].hi, open);
      i = j;
    }
  }

  void by_algebra(double lo, double hi, const std::vector<Open_requirement>& parts)
  {
    const std::vector<Open_requirement> open = without_parts(parts);
    ++result_.algebraic_cells;
    const auto boundary = events_of(open).on(lo, hi);
    if (!boundary) {
      result_.undecided.push_back({lo, hi});
      return;
    }
    // Between two events nothing changes: a rational place tells. Neighbours that are feasible share their event.
    bool was_feasible = false;
    for (std::size_t k = 0; k + 1 < boundary->size(); ++k) {
      const Rational middle = ((*boundary)[k].hi + (*boundary)[k + 1].lo) / 2;
      const bool is_feasible = holds_at(open, middle);
      if (is_feasible && !was_feasible) {
        Found f;
        f.lo = lo;
        f.hi = hi;
        f.whole_low = k == 0;
        f.interval.inside = nearest_double(middle);
        f.interval.ends[0] = end_at((*boundary)[k], open);
        found_.push_back(std::move(f));
      }
      if (is_feasible) {
        found_.back().whole_high = k + 2 == boundary->size();
        found_.back().interval.ends[1] = end_at((*boundary)[k + 1], open);
      }
      was_feasible = is_feasible;
    }
  }

  const Event_polynomials& events_of(const std::vector<Open_requirement>& open)
  {
    std::vector<std::size_t> key;
    for (const Open_requirement& r : open) key.push_back(r.requirement);
    std::sort(key.begin(), key.end());
    const auto [found, is_new] = events_.try_emplace(key);
    if (is_new)
      for (const std::size_t r : key) found->second.add(requirements_[r]);
    return found->second;
  }

  /// Each requirement once: on all of v where several parts are open.
  static std::vector<Open_requirement> without_parts(const std::vector<Open_requirement>& parts)
  {
    std::vector<Open_requirement> open;
    for (const Open_requirement& r : parts) {
      const auto same = std::find_if(open.begin(), open.end(), [&](const Open_requirement& o) { return o.requirement == r.requirement; });
      if (same == open.end()) open.push_back(r);
      else if (same->node != r.node) *same = {r.requirement, 0, 0};
    }
    return open;
  }

  bool holds_at(const std::vector<Open_requirement>& open, const Rational& u)
  {
    return std::none_of(open.begin(), open.end(), [&](const Open_requirement& r) { return signs_.exact_at(r, u) == Sign::negative; });
  }

  static Feasible_end end_at(const Algebraic_end& event, const std::vector<Open_requirement>& open)
  {
    Feasible_end end;
    const Interval x = hull(enclosing(event.lo), enclosing(event.hi));
    end.lo = x.inf();
    end.hi = x.sup();
    end.open = open;
    if (event.polynomial) end.algebraic = std::make_shared<const Algebraic_end>(event);
    return end;
  }

  /// Intervals that meet in a cell's end are one.
  void merge()
  {
    std::sort(found_.begin(), found_.end(), [](const Found& x, const Found& y) { return x.interval.ends[0].lo < y.interval.ends[0].lo; });
    for (std::size_t i = 0; i < found_.size(); ++i) {
      Found f = found_[i];
      while (i + 1 < found_.size() && goes_on(f, found_[i + 1])) {
        const Found& g = found_[++i];
        if (g.interval.ends[1].hi - g.interval.ends[0].lo > f.interval.ends[1].lo - f.interval.ends[0].hi) f.interval.inside = g.interval.inside;
        f.interval.ends[1] = g.interval.ends[1];
        f.whole_high = g.whole_high;
        f.hi = g.hi;
      }
      result_.intervals.push_back(std::move(f.interval));
    }
  }

  static bool goes_on(const Found& f, const Found& g) { return f.hi == g.lo && f.whole_high && g.whole_low; }

  const std::vector<Requirement>& requirements_;
  const Solve_control& control_;
  Feasible_set result_;
  Requirement_signs signs_;
  Feasible_end_refiner refiner_;
  std::vector<Vector_tree*> families_;
  std::vector<std::size_t> family_, group_; ///< of each requirement
  std::vector<Group> groups_;
  std::vector<std::array<std::optional<Corner_zeros>, 4>> corners_;
  Product_table table_, size_;
  std::vector<Violator> violators_;
  std::vector<Cell> crowded_; ///< with too many parts of v to go on
  std::vector<Open_requirement> kept_, todo_; ///< of the cell at hand
  bool violated_at_high_end_ = false;
  std::vector<Found> found_;
  std::map<std::vector<std::size_t>, Event_polynomials> events_; ///< of sets of requirements
};

} // namespace detail

} // namespace locus

#endif
