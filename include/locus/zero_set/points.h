// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_POINTS_H
#define LOCUS_ZERO_SET_POINTS_H

#include <locus/zero_set/control_hull.h>
#include <locus/zero_set/interval_matrix.h>
#include <locus/zero_set/local_forms.h>
#include <locus/zero_set/point_faces.h>
#include <locus/zero_set/roots.h>
#include <locus/zero_set/solve_control.h>
#include <locus/zero_set/system.h>

#include <cmath>
#include <optional>

namespace locus {

using Isolated_point = Isolated_solution<2>;

/// Why a box is undecided, and how many solutions there can be in it.
struct Undecided_points {
  const char* reason = "";
  /// Bound of the number of isolated solutions in the box, counted with multiplicities: by Descartes' rule for one
  /// variable, else what Bézout's theorem leaves of the solutions of the whole system.
  std::optional<unsigned long> at_most;
};

/// Solutions of K equations in K variables on the unit cell.
template <int K>
struct Point_set {
  std::vector<Isolated_solution<K>> points;
  std::vector<Box<K>> undecided;                   ///< parts of the unit cell where solutions may be left
  std::vector<Undecided_points> undecided_details; ///< one for each undecided box
  std::size_t cells = 0;                           ///< boxes that were examined
};

template <int K>
Point_set<K> solve_points(const Equations<K>& equations, const Solve_control& control,
                          const std::vector<Box<K>>& known = {});

namespace detail {

/// A bound of the number of isolated common zeros of K polynomials of these degrees in each variable, complex ones and
/// those at infinity included, by multiplicity: the permanent of the matrix of degrees (Bézout's theorem for products of
/// lines). `used` are the variables that the first equations have.
template <int K>
unsigned long bezout_number(const std::array<Degrees<K>, static_cast<std::size_t>(K)>& degrees,
                            std::size_t equation = 0, unsigned used = 0)
{
  if (equation == degrees.size()) return 1;
  unsigned long sum = 0;
  for (std::size_t v = 0; v < degrees.size(); ++v)
    if (!(used & (1u << v)))
      sum +=
        static_cast<unsigned long>(degrees[equation][v]) * bezout_number<K>(degrees, equation + 1, used | (1u << v));
  return sum;
}

/// A bound of the number of roots on a closed part of the unit interval, by multiplicity: the changes of sign in the exact
/// coefficients there, and the zeros at either end of them.
inline unsigned long descartes_bound(const Bernstein<Scaled_integer, 1>& f, const Box<1>& box)
{
  const auto part = restrict_to(f, 0, Rational(box.lo[0]), Rational(box.hi[0]));
  unsigned long bound = 0, zeros = 0;
  Sign last = Sign::zero;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Sign s = part.sign(i);
    if (s == Sign::zero) {
      ++zeros;
      continue;
    }
    if (last == Sign::zero) bound += zeros; // at the lower end
    else if (s != last) ++bound;
    last = s;
    zeros = 0;
  }
  return bound + zeros;
}

/// Isolated solutions of K equations on the unit cell. A box is dropped where an equation, or one of the preconditioned
/// system, has no zero; settled where that system's Jacobian is near the identity on an enlarged box, so that there is
/// one solution at most, and a small box there is mapped into itself, so that there is one; shrunk to where the control
/// polygons of the preconditioned system meet the axes; or cut in two.
template <int K>
class Point_solver {
public:
  Point_solver(const Equations<K>& equations, const Solve_control& control, const std::vector<Box<K>>& known)
    : equations_(equations), control_(control), known_(known)
  {
    for (const auto& f : equations_) sharp_.emplace_back(f, control.max_bits);
  }

  Point_set<K> run()
  {
    std::vector<Cell> level(1), next;
    level[0].box = Box<K>::unit();
    for (std::size_t k = 0; k < size; ++k) level[0].f[k] = bounded(equations_[k]->enclosure(level[0].box));
    while (!level.empty()) { // breadth first, so that a limit leaves a uniform rest
      for (Cell& cell : level) {
        open_ = level.size() + next.size();
        examine(cell, next);
      }
      level.swap(next);
      next.clear();
    }
    settle_boundaries();
    bound_undecided();
    return std::move(result_);
  }

private:
  static constexpr auto size = static_cast<std::size_t>(K);
  using Forms = Bounded_forms<K>;
  using Place = typename Basis_at_point<K>::Point;

  // None of these decides anything: they say when which work is worth while, and what is left undecided.

  /// Forms whose errors exceed this part of their coefficients are made afresh.
  static constexpr double blurred = 0x1p-36;
  /// The same where the Jacobian is nearly singular, so that what is left of the digits counts.
  static constexpr double slightly_blurred = 0x1p-49;
  /// The same in a small box around a solution, where the box is what bounds its enclosure.
  static constexpr double slightly_sharp = 0x1p-20;
  /// An error of the preconditioned system from which on that is tried, as part of the box.
  static constexpr double poor_precision = 0x1p-14;
  /// In so many cells the equations are untangled at most, since that costs much, and is in vain at multiple solutions.
  static constexpr int most_untangled = 16;
  /// Below this width equations that differ may look alike.
  static constexpr double small_box = 0x1p-12;
  /// Deviation from the identity, below one, up to which a solution is looked for.
  static constexpr double largest_deviation = 0.9;
  static constexpr double promising_deviation = 0.6;
  /// A solution's enclosure is at most this part of the box in which it is unique,
  static constexpr double largest_radius = 0x1p-10;
  /// and of the unit cell this, if the digits are there.
  static constexpr double largest_enclosure = 0x1p-30, fine_enclosure = 0x1p-44;
  /// A box is shrunk before it is cut if this part of it or less is left, and not cut then if the second one is.
  static constexpr double fair_reduction = 0.8, good_reduction = 0.4;
  /// Never is less of a side left at once, so that the box in which a solution is unique stays much larger than its
  /// enclosure.
  static constexpr double least_reduction = 0x1p-8;

  struct Cell {
    Box<K> box;
    Forms f;
    bool is_sharp = false; ///< the forms were made afresh as sharp as doubles can be
  };

  // ------------------------------------------------------------------------------------------------- subdivision

  void examine(Cell& cell, std::vector<Cell>& next)
  {
    if (const char* limit = limit_reached()) return give_up(cell.box, limit);
    ++result_.cells;
    report_progress();
    if (is_purged(cell.f) || is_known(cell.box)) return;
    if (!sharpen(cell, blurred)) return give_up(cell.box, "precision limit");
    if (is_purged(cell.f)) return;
    for (const auto& f : cell.f)
      if (f.error() == 0 && f.norm() == 0) return give_up(cell.box, "an equation vanishes identically");
    Box<K> rest = cell.box;
    if (const auto p = precisely_preconditioned(cell)) {
      const auto reduced = where_zeros_can_be(cell.box, *p);
      if (!reduced) return;
      rest = *reduced;
      if (deviation_from_identity<K>(*p) < promising_deviation && settle(cell)) return;
    }
    go_on(cell, rest, next);
  }

  const char* limit_reached() const
  {
    if (result_.cells >= control_.max_cells) return "cell limit";
    if (control_.is_cancelled()) return "cancelled";
    if (std::isfinite(control_.max_seconds) && (result_.cells & 15u) == 0 &&
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > control_.max_seconds)
      return "time limit";
    return nullptr;
  }

  void report_progress() const
  {
    if (control_.progress && (result_.cells & 255u) == 0)
      with_nearest_rounding([&] { control_.progress(result_.cells, open_); });
  }

  void give_up(const Box<K>& box, const char* reason)
  {
    result_.undecided.push_back(box);
    result_.undecided_details.push_back({reason, std::nullopt});
  }

  static bool is_purged(const Forms& forms)
  {
    for (const auto& f : forms) {
      const auto& c = f.values().coefficients();
      const auto [lo, hi] = std::minmax_element(c.begin(), c.end());
      if (*lo > f.error() || *hi < -f.error()) return true;
    }
    return false;
  }

  bool is_known(const Box<K>& box) const
  {
    return std::any_of(known_.begin(), known_.end(), [&](const Box<K>& b) {
      bool inside = true;
      for (std::size_t v = 0; v < size; ++v) inside = inside && b.lo[v] <= box.lo[v] && box.hi[v] <= b.hi[v];
      return inside;
    });
  }

  static bool is_imprecise(const Forms& p)
  {
    return std::any_of(p.begin(), p.end(), [](const auto& f) { return !(f.error() <= poor_precision); });
  }

  /// Makes forms afresh whose errors exceed a part of their coefficients; false if that takes too many bits.
  bool sharpen(Cell& cell, double part)
  {
    cell.is_sharp = cell.is_sharp || part == slightly_blurred;
    for (std::size_t k = 0; k < size; ++k) {
      if (!is_blurred(cell.f[k], part)) continue;
      auto f = sharp_[k].on(cell.box, part);
      if (!f) return false;
      cell.f[k] = std::move(*f);
    }
    return true;
  }

  /// The preconditioned system, for which the cell's forms are made afresh if its errors are large: first each equation,
  /// then what they differ by.
  std::optional<Forms> precisely_preconditioned(Cell& cell)
  {
    auto p = preconditioned<K>(cell.f);
    if (p && !is_imprecise(*p)) return p;
    if (!cell.is_sharp && sharpen(cell, slightly_blurred)) {
      p = preconditioned<K>(cell.f);
      if (p && !is_imprecise(*p)) return p;
    }
    if (untangled_ == most_untangled || !is_tangled(cell)) return p;
    auto f = untangled<K>(sharp_, cell.box, blurred);
    untangled_ = f ? untangled_ + 1 : most_untangled; // dependent everywhere, as it seems
    if (!f) return p;
    cell.f = std::move(*f);
    return preconditioned<K>(cell.f);
  }

  /// Whether two equations are nearly multiples of each other, or the box is so small that they may have become so.
  static bool is_tangled(const Cell& cell)
  {
    if (K > 1 && cell.box.max_width() < small_box) return true;
    for (std::size_t k = 0; k < size; ++k)
      for (std::size_t l = 0; l < k; ++l)
        if (cell.f[k].degrees() == cell.f[l].degrees() && is_nearly_multiple(cell.f[k].values(), cell.f[l].values()))
          return true;
    return false;
  }

  static bool is_nearly_multiple(const Bernstein<double, K>& f, const Bernstein<double, K>& g)
  {
    std::size_t greatest = 0;
    for (std::size_t i = 0; i < f.size(); ++i)
      if (std::abs(f[i]) > std::abs(f[greatest])) greatest = i;
    const double factor = g[greatest] / f[greatest];
    for (std::size_t i = 0; i < f.size(); ++i)
      if (!(std::abs(g[i] - factor * f[i]) <= 0x1p-20 * std::abs(g[greatest]))) return false;
    return true;
  }

  /// The part of the box outside of which the preconditioned system has no zero; nothing if it has none.
  static std::optional<Box<K>> where_zeros_can_be(const Box<K>& box, const Forms& p)
  {
    Box<K> rest = box;
    for (std::size_t v = 0; v < size; ++v) {
      const auto range = zero_range(p[v], static_cast<int>(v));
      if (!range) return std::nullopt;
      const double width = box.hi[v] - box.lo[v], spare = std::max(0.0, 0.5 * (least_reduction - range->width()));
      if (range->lo > spare)
        rest.lo[v] = std::max(box.lo[v], grid_below(box.lo[v] + (range->lo - spare) * width) - box_grid);
      if (range->hi < 1 - spare)
        rest.hi[v] = std::min(box.hi[v], grid_above(box.lo[v] + (range->hi + spare) * width) + box_grid);
    }
    return rest;
  }

  void go_on(Cell& cell, const Box<K>& rest, std::vector<Cell>& next)
  {
    double left = 1;
    for (int v = 0; v < K; ++v) left *= rest.width(v) / cell.box.width(v);
    if (left <= fair_reduction) {
      for (auto& f : cell.f) f = moved_to(rest, std::move(f), cell.box);
      cell.box = rest;
      cell.is_sharp = false;
      if (left <= good_reduction) return next.push_back(std::move(cell));
    }
    cut(cell, next);
  }

  void cut(Cell& cell, std::vector<Cell>& next)
  {
    const int v = cut_variable(cell);
    const auto vv = static_cast<std::size_t>(v);
    const double middle = grid_below(0.5 * (cell.box.lo[vv] + cell.box.hi[vv]));
    if (cell.box.max_width() <= std::ldexp(1.0, -control_.max_depth) ||
        !(cell.box.lo[vv] < middle && middle < cell.box.hi[vv]))
      return give_up(cell.box, "depth limit: solutions that are multiple, or as good as");
    Cell low, high;
    low.box = high.box = cell.box;
    low.box.hi[vv] = high.box.lo[vv] = middle;
    const double at = (middle - cell.box.lo[vv]) / cell.box.width(v);
    for (std::size_t k = 0; k < size; ++k) {
      auto parts = split(cell.f[k], v, at);
      const double moved = at == 0.5 ? 0.0 : 8 * operation_error * cell.f[k].degree(v) * cell.f[k].norm();
      low.f[k] = {parts.first.values(), accumulated_error(parts.first.error() + moved, 0, 0)};
      high.f[k] = {parts.second.values(), accumulated_error(parts.second.error() + moved, 0, 0)};
    }
    next.push_back(std::move(low));
    next.push_back(std::move(high));
  }

  /// The variable along which the equations bend most, but none whose side has become much shorter than others.
  int cut_variable(const Cell& cell) const
  {
    int best = 0;
    double most = -1;
    const double widest = cell.box.max_width();
    for (int v = 0; v < K; ++v) {
      if (cell.box.width(v) < 0x1p-4 * widest) continue;
      double bend = 0;
      for (const auto& f : cell.f)
        bend += spread_of_differences(f, v) / std::max(f.norm(), std::numeric_limits<double>::min());
      bend = (bend + 0x1p-30) * cell.box.width(v) / widest; // where nothing bends, the longest side
      if (bend > most) {
        most = bend;
        best = v;
      }
    }
    return best;
  }

  static double spread_of_differences(const Bernstein<Bounded, K>& f, int variable)
  {
    const Layout layout = layout_along(f.degrees(), variable);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t o = 0; o < layout.outer; ++o) {
      const double* const c = f.values().data() + o * layout.count * layout.inner;
      for (std::size_t i = 0; i < (layout.count - 1) * layout.inner; ++i) {
        low = std::min(low, c[i + layout.inner] - c[i]);
        high = std::max(high, c[i + layout.inner] - c[i]);
      }
    }
    return layout.count == 1 ? 0 : f.degree(variable) * (high - low);
  }

  // --------------------------------------------------------------------------------------- existence, uniqueness

  /// The box and a sixteenth more on every side, if the grid is fine enough for that.
  static Box<K> enlarged(Box<K> box)
  {
    for (std::size_t v = 0; v < size; ++v) {
      const double margin = grid_above(0.0625 * (box.hi[v] - box.lo[v]));
      box.lo[v] -= margin;
      box.hi[v] += margin;
    }
    return box;
  }

  /// True if the cell's only solution has been recorded, or belongs to a neighbour.
  bool settle(const Cell& cell)
  {
    const Box<K> wide = enlarged(cell.box);
    Forms f;
    for (std::size_t k = 0; k < size; ++k) f[k] = moved_to(wide, cell.f[k], cell.box);
    auto p = located(wide, f);
    if (!p) return false;
    for (const double part : {slightly_sharp, blurred, slightly_blurred})
      if (widest(*p) > fine_enclosure) look_closer(*p, part);
    if (widest(*p) > largest_enclosure) return false;
    record(*p, cell.box);
    return true;
  }

  static double widest(const Isolated_solution<K>& p)
  {
    double most = 0;
    for (const Interval& x : p.box) most = std::max(most, width(x));
    return most;
  }

  /// The only solution in a box on which the forms are given, closely enclosed; nothing if there may be none or more.
  static std::optional<Isolated_solution<K>> located(const Box<K>& box, const Forms& f)
  {
    const auto p = preconditioned<K>(f);
    if (!p) return std::nullopt;
    const double deviation = deviation_from_identity<K>(*p);
    if (!(deviation <= largest_deviation)) return std::nullopt;
    Basis_at_point<K> basis((*p)[0].degrees());
    const Place y = approximate_zero(*p, basis);
    // Krawczyk's operator maps the ball of this radius into itself, if it lies in the box.
    double distance = 0;
    for (const auto& g : *p) {
      const Bounded value = basis.value(g);
      distance = std::max(distance, std::abs(value.value) + value.error);
    }
    const double radius = distance / (1 - deviation) * (1 + 0x1p-40) + std::numeric_limits<double>::min();
    if (!(radius <= largest_radius)) return std::nullopt;
    Isolated_solution<K> s;
    s.unique_in = box;
    for (std::size_t v = 0; v < size; ++v) {
      const Interval local = Interval(y[v]) + Interval(-radius, radius);
      if (!(local.inf() > 0 && local.sup() < 1)) return std::nullopt;
      s.box[v] = Interval(box.lo[v]) + Interval(box.hi[v] - box.lo[v]) * local;
    }
    return s;
  }

  /// Newton's method from the middle, in plain doubles; leaves the basis at the result.
  static Place approximate_zero(const Forms& p, Basis_at_point<K>& basis)
  {
    Place y;
    y.fill(0.5);
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 40; ++step) {
      basis.move_to(y);
      Place value;
      Real_matrix<K> slopes;
      for (std::size_t k = 0; k < size; ++k) {
        const auto jet = basis.jet(p[k].values().data());
        value[k] = jet[0];
        for (std::size_t v = 0; v < size; ++v) slopes[k][v] = jet[v + 1];
      }
      const auto inverse = approximate_inverse<K>(slopes);
      if (!inverse) break;
      double moved = 0;
      Place after = y;
      for (std::size_t k = 0; k < size; ++k) {
        for (std::size_t v = 0; v < size; ++v) after[k] -= (*inverse)[k][v] * value[v];
        after[k] = std::min(1.0, std::max(0.0, after[k]));
        moved = std::max(moved, std::abs(after[k] - y[k]));
      }
      if (moved <= 0x1p-52 || (moved < 0x1p-30 && moved >= last)) break;
      last = moved;
      y = after;
    }
    return y;
  }

  /// Encloses a solution more closely, if possible, by forms that are made afresh on a small box around it, with errors
  /// up to this part of their coefficients.
  void look_closer(Isolated_solution<K>& p, double part)
  {
    const double reach = std::max(8 * widest(p), 0x1p-26);
    Box<K> box;
    Forms f;
    for (std::size_t v = 0; v < size; ++v) {
      box.lo[v] = std::max(p.unique_in.lo[v], grid_below(p.box[v].inf() - reach));
      box.hi[v] = std::min(p.unique_in.hi[v], grid_above(p.box[v].sup() + reach));
      if (!(box.lo[v] < box.hi[v])) return;
    }
    for (std::size_t k = 0; k < size; ++k) {
      auto g = sharp_[k].on(box, part);
      if (!g) return;
      f[k] = std::move(*g);
    }
    const auto closer = located(box, f);
    if (closer && widest(*closer) < widest(p)) p.box = closer->box;
  }

  static bool lies_within(const Isolated_solution<K>& p, const Box<K>& box)
  {
    for (std::size_t v = 0; v < size; ++v)
      if (!(box.lo[v] < p.box[v].inf() && p.box[v].sup() < box.hi[v])) return false;
    return true;
  }

  void record(const Isolated_solution<K>& candidate, const Box<K>& cell)
  {
    for (std::size_t v = 0; v < size; ++v)
      if (candidate.box[v].sup() < cell.lo[v] || candidate.box[v].inf() > cell.hi[v]) return;
    // Of two enclosures of one solution the smaller one lies where the other's solution is known to be the only one.
    for (const Isolated_solution<K>& known : found_) {
      bool meet = true;
      for (std::size_t v = 0; v < size; ++v) meet = meet && overlap(known.box[v], candidate.box[v]);
      if (meet && (lies_within(candidate, known.unique_in) || lies_within(known, candidate.unique_in))) return;
    }
    found_.push_back(candidate);
  }

  // ------------------------------------------------------------------------------------------------------- faces

  /// Whether the solution lies exactly on a face that its enclosure meets.
  Answer lies_on_face(const Isolated_solution<K>& p, int variable, int side) const
  {
    if constexpr (K == 1) {
      const auto& f = equations_[0]->exact();
      return f.sign(side == 1 ? f.size() - 1 : 0) == Sign::zero ? Answer::yes : Answer::no;
    } else if constexpr (K == 2) {
      const auto f = monomial_form(face(equations_[0]->exact(), variable, side == 1));
      const auto g = monomial_form(face(equations_[1]->exact(), variable, side == 1));
      const Interval& along = p.box[static_cast<std::size_t>(1 - variable)];
      return has_root_within(gcd(f, g), Rational(along.inf()), Rational(along.sup())) ? Answer::yes : Answer::no;
    } else {
      if (vanish_at_simplest_point<K>(equations_, p, variable, side)) return Answer::yes;
      if (is_excluded_on_face<K>(equations_, p, variable, side)) return Answer::no;
      const auto system = square_system_on_face<K>(equations_, variable, side);
      if (!system) return Answer::undecided;
      for (const auto& q : solve_points<K - 1>(*system, control_).points)
        if (is_at(q, p, variable)) return Answer::yes;
      return Answer::undecided;
    }
  }

  /// Whether a solution on a face is this one: where the latter is the only one.
  static bool is_at(const Isolated_solution<K - 1>& q, const Isolated_solution<K>& p, int variable)
  {
    for (std::size_t v = 0, w = 0; v < size; ++v) {
      if (static_cast<int>(v) == variable) continue;
      if (!(p.unique_in.lo[v] < q.box[w].inf() && q.box[w].sup() < p.unique_in.hi[v])) return false;
      ++w;
    }
    return true;
  }

  /// Whether the enclosure holds a corner of the unit cell that is a zero of all equations; marks it then.
  bool is_corner(Isolated_solution<K>& p) const
  {
    std::array<int, size> corner;
    for (std::size_t v = 0; v < size; ++v) {
      const Interval& x = p.box[v];
      corner[v] = x.inf() <= 0 && x.sup() >= 0 ? 0 : x.inf() <= 1 && x.sup() >= 1 ? 1 : -1;
      if (corner[v] < 0) return false;
    }
    for (const auto& f : equations_) {
      Degrees<K> index = f->degrees();
      for (std::size_t v = 0; v < size; ++v) index[v] *= corner[v];
      if (f->exact().values().at(index) != 0) return false;
    }
    p.face = corner;
    return true;
  }

  /// Marks the solutions on faces, and leaves undecided what is too near a face to tell. None lies outside.
  void settle_boundaries()
  {
    for (Isolated_solution<K>& p : found_) {
      if (is_corner(p)) {
        result_.points.push_back(p);
        continue;
      }
      bool open = false;
      for (int v = 0; v < K; ++v) {
        const Interval& x = p.box[static_cast<std::size_t>(v)];
        for (int side = 0; side < 2; ++side) {
          if (!(x.inf() <= side && side <= x.sup())) continue;
          if (lies_on_face(p, v, side) == Answer::yes) p.face[static_cast<std::size_t>(v)] = side;
          else open = true;
        }
      }
      if (!open) {
        result_.points.push_back(p);
        continue;
      }
      give_up(box_of(p.box), "a solution too near a face of the cell to tell on which side");
      result_.undecided_details.back().at_most = 1;
    }
  }

  void bound_undecided()
  {
    std::array<Degrees<K>, size> degrees;
    for (std::size_t k = 0; k < size; ++k) degrees[k] = equations_[k]->degrees();
    const unsigned long all = bezout_number<K>(degrees),
                        rest = all - std::min<unsigned long>(all, result_.points.size());
    for (std::size_t i = 0; i < result_.undecided.size(); ++i) {
      std::optional<unsigned long>& at_most = result_.undecided_details[i].at_most;
      if (at_most) continue;
      at_most = rest;
      if constexpr (K == 1)
        if (!equations_[0]->exact().is_zero()) at_most = descartes_bound(equations_[0]->exact(), result_.undecided[i]);
    }
  }

  Equations<K> equations_;
  const Solve_control& control_;
  const std::vector<Box<K>>& known_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<Sharp_forms<K>> sharp_;
  std::size_t open_ = 0;
  int untangled_ = 0;
  Point_set<K> result_;
  std::vector<Isolated_solution<K>> found_;
};

} // namespace detail

/// Isolated solutions of K equations in K variables, K = 1…4, on the unit cell (upward rounding needed): each once, in a
/// box that holds no other, and `face` says exactly on which faces of the cell it lies. What is not proved to be regular
/// and single is left in `undecided`, never merged or dropped. In the boxes `known` nothing is looked for, although what
/// is found elsewhere may lie in them. Cost: some microseconds a box; a regular solution takes a
/// few boxes, a multiple one some tens a halving.
template <int K>
Point_set<K> solve_points(const Equations<K>& equations, const Solve_control& control, const std::vector<Box<K>>& known)
{
  static_assert(1 <= K && K <= 4);
  return detail::Point_solver<K>(equations, control, known).run();
}

} // namespace locus

#endif
