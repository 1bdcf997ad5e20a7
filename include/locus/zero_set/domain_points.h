// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_DOMAIN_POINTS_H
#define LOCUS_ZERO_SET_DOMAIN_POINTS_H

#include <locus/zero_set/points.h>

#include <algorithm>
#include <limits>

namespace locus {

/// The piece of each variable's chain that makes a cell of a domain.
template <int K>
using Cell_number = std::array<std::size_t, static_cast<std::size_t>(K)>;

/// Ranges of all variables, in their own parameters; a range that ends at infinity has an infinite number there.
template <int K>
using Parameter_box = std::array<Interval, static_cast<std::size_t>(K)>;

/// A solution on a domain. One on a side that several cells share is given in the first of them.
template <int K>
struct Domain_point {
  Cell_number<K> cell{};
  Isolated_solution<K> local; ///< in the unit cell; `face` says whether it lies on a side
  Parameter_box<K> at;
};

/// A part of a cell where solutions may be left.
template <int K>
struct Undecided_part {
  Cell_number<K> cell{};
  Box<K> local;
  Parameter_box<K> at;
  Undecided_points details;
};

/// What is to be solved on a cell of a domain.
template <int K>
struct Cell_system {
  Equations<K> equations; ///< on the unit cell, homogenised where a piece is infinite; none if the cell is left out
  std::vector<Box<K>> known{}; ///< boxes in which nothing is looked for
};

template <int K>
struct Domain_point_set {
  std::vector<Domain_point<K>> points;
  std::vector<Undecided_part<K>> undecided;
  std::size_t cells = 0; ///< boxes that were examined
};

/// The variable's range on a part of a piece, given by its local coordinate (upward rounding needed).
inline Interval parameter_range(const Piece& piece, const Interval& local)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double lo = std::min(1.0, std::max(0.0, local.inf())), hi = std::min(1.0, std::max(0.0, local.sup()));
  if (piece.is_finite()) {
    if (lo == hi && (lo == 0 || lo == 1)) return enclosing(lo == 0 ? piece.lo : piece.hi);
    return enclosing(piece.lo) + Interval(lo, hi) * enclosing(Rational(piece.hi - piece.lo));
  }
  // u = c/d with the distance d from the infinite end.
  const Interval from_end = piece.hi_infinite ? Interval(1) - Interval(lo, hi) : Interval(lo, hi);
  const Interval c = enclosing(piece.hi_infinite ? piece.lo : piece.hi);
  const auto at = [&](double d) {
    if (d > 0) return c / Interval(d);
    const double end = piece.hi_infinite ? infinity : -infinity;
    return Interval(end, end); // CGAL takes infinite numbers by pairs only
  };
  return hull(at(from_end.inf()), at(from_end.sup()));
}

namespace detail {

/// Solves the cells of a domain one by one and recognises what they share.
template <int K, class Make_system>
class Domain_point_solver {
public:
  Domain_point_solver(const Domain<K>& domain, const Make_system& make, const Solve_control& control)
    : domain_(domain), make_(make), control_(control)
  {
  }

  Domain_point_set<K> run()
  {
    Degrees<K> index{}, last{};
    for (std::size_t v = 0; v < size; ++v) last[v] = static_cast<int>(domain_.chains[v].pieces.size()) - 1;
    do {
      Cell_number<K> cell;
      for (std::size_t v = 0; v < size; ++v) cell[v] = static_cast<std::size_t>(index[v]);
      solve_cell(cell);
    } while (advance_index(index, last));
    return std::move(result_);
  }

private:
  static constexpr auto size = static_cast<std::size_t>(K);

  /// What is left of the limits.
  Solve_control rest_of_control() const
  {
    Solve_control rest = control_;
    const std::size_t done = result_.cells;
    rest.max_cells -= std::min(rest.max_cells, done);
    rest.max_seconds -= std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (control_.progress)
      rest.progress = [report = control_.progress, done](std::size_t more, std::size_t open) {
        report(done + more, open);
      };
    return rest;
  }

  void solve_cell(const Cell_number<K>& cell)
  {
    const Cell_system<K> system = make_(cell);
    if (!system.equations[0]) return;
    const Solve_control control = rest_of_control();
    const Point_set<K> set = solve_points<K>(system.equations, control, system.known);
    result_.cells += set.cells;
    for (const auto& p : set.points) {
      Domain_point<K> point{cell, p, {}};
      for (std::size_t v = 0; v < size; ++v)
        point.at[v] = parameter_range(piece(cell, v), p.face[v] < 0 ? p.box[v] : Interval(p.face[v]));
      const bool known = p.on_boundary() && std::any_of(result_.points.begin(), result_.points.end(),
                                                        [&](const Domain_point<K>& q) { return are_one(q, point); });
      if (!known) result_.points.push_back(std::move(point));
    }
    for (std::size_t i = 0; i < set.undecided.size(); ++i) {
      const Box<K>& box = set.undecided[i];
      Undecided_part<K> part{cell, box, {}, set.undecided_details[i]};
      for (std::size_t v = 0; v < size; ++v)
        part.at[v] = parameter_range(piece(cell, v), Interval(box.lo[v], box.hi[v]));
      result_.undecided.push_back(std::move(part));
    }
  }

  const Piece& piece(const Cell_number<K>& cell, std::size_t v) const { return domain_.chains[v].pieces[cell[v]]; }

  /// The joint on which a solution lies, numbered along the chain; the seam of a closed chain is number 0.
  std::size_t joint(const Domain_point<K>& p, std::size_t v) const
  {
    const Chain& chain = domain_.chains[v];
    const std::size_t number = p.cell[v] + static_cast<std::size_t>(p.local.face[v]);
    return chain.is_closed() ? number % chain.pieces.size() : number;
  }

  /// Whether two solutions of different cells are one point of the sides that these share. There both have the same local
  /// coordinates, and one of them lies where the other is known to be the only one.
  bool are_one(const Domain_point<K>& p, const Domain_point<K>& q) const
  {
    bool q_at_p = true, p_at_q = true;
    for (std::size_t v = 0; v < size; ++v) {
      if ((p.local.face[v] < 0) != (q.local.face[v] < 0)) return false;
      if (p.local.face[v] >= 0) {
        if (joint(p, v) != joint(q, v)) return false;
        continue;
      }
      if (p.cell[v] != q.cell[v]) return false;
      const Interval &x = p.local.box[v], &y = q.local.box[v];
      if (!overlap(x, y)) return false;
      q_at_p = q_at_p && p.local.unique_in.lo[v] < y.inf() && y.sup() < p.local.unique_in.hi[v];
      p_at_q = p_at_q && q.local.unique_in.lo[v] < x.inf() && x.sup() < q.local.unique_in.hi[v];
    }
    return q_at_p || p_at_q;
  }

  const Domain<K>& domain_;
  const Make_system& make_;
  const Solve_control& control_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Domain_point_set<K> result_;
};

} // namespace detail

/// Isolated solutions of K equations in K variables on a whole domain, infinite pieces included (upward rounding
/// needed). `make(cell)` gives the `Cell_system<K>` that belongs to a `Cell_number<K>`. The equations of neighbouring cells
/// must have the same zeros on their common side: a solution there is reported once. Limits count for all cells together.
/// Cost: that of the cells.
template <int K, class Make_system>
Domain_point_set<K> solve_points_on(const Domain<K>& domain, const Make_system& make, const Solve_control& control)
{
  return detail::Domain_point_solver<K, Make_system>(domain, make, control).run();
}

} // namespace locus

#endif
