// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_POINTS_2_H
#define LOCUS_ZERO_SET_POINTS_2_H

#include <locus/zero_set/roots.h>
#include <locus/zero_set/solve_control.h>
#include <locus/zero_set/system.h>

#include <cmath>
#include <optional>

namespace locus {

using Isolated_point = Isolated_solution<2>;

struct Point_set {
  std::vector<Isolated_point> points;
  std::vector<Box<2>> undecided; ///< parts of the unit cell where solutions may be left
  std::size_t cells = 0;
};

namespace detail {

/// Isolated solutions of f = g = 0 on the unit cell: convex-hull purging, a preconditioned Jacobian that is strictly
/// diagonally dominant over an enlarged cell (at most one solution), and Krawczyk's operator (exactly one).
class Point_solver_2 {
public:
  using Pair = std::array<std::shared_ptr<const Equation<2>>, 2>;

  Point_solver_2(const Pair& equations, const Solve_control& control) : equations_(equations), control_(control) {}

  Point_set run()
  {
    std::vector<Cell> stack{{Box<2>::unit(), bounded_on(0, Box<2>::unit()), bounded_on(1, Box<2>::unit()), 0}};
    const std::size_t cell_limit = std::min<std::size_t>(control_.max_cells, 4000);
    while (!stack.empty()) {
      Cell cell = std::move(stack.back());
      stack.pop_back();
      ++result_.cells;
      if (is_purged(cell.f) || is_purged(cell.g)) continue;
      if (cell.depth > 2 && resolve(cell)) continue;
      if (cell.depth >= max_depth || result_.cells > cell_limit || control_.is_cancelled() || is_late()) {
        result_.undecided.push_back(cell.box);
        continue;
      }
      split_cell(cell, stack);
    }
    settle_boundaries();
    return std::move(result_);
  }

private:
  static constexpr int max_depth = 60;

  /// A solution's enclosure is narrowed at least to this part of the unit cell.
  static constexpr double largest_enclosure = 0x1p-30;
  /// Below this, further steps would only move the last bits.
  static constexpr double finest_enclosure = 0x1p-47;
  using Matrix = std::array<std::array<Interval, 2>, 2>;
  using Point = std::array<Interval, 2>;

  struct Cell {
    Box<2> box;
    Bernstein<Bounded, 2> f, g;
    int depth;
  };

  bool is_late() const
  {
    return std::isfinite(control_.max_seconds) && (result_.cells & 15u) == 0 &&
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > control_.max_seconds;
  }

  Bernstein<Bounded, 2> bounded_on(std::size_t k, const Box<2>& box) const
  {
    return bounded(equations_[k]->enclosure(box));
  }

  static bool is_purged(const Bernstein<Bounded, 2>& f)
  {
    const auto& c = f.values().coefficients();
    const auto [lo, hi] = std::minmax_element(c.begin(), c.end());
    return *lo > f.error() || *hi < -f.error();
  }

  static Interval derivative_range(const Bernstein<Interval, 2>& f, int variable, double width)
  {
    const Layout layout = layout_along(f.degrees(), variable);
    if (layout.count == 1) return Interval(0);
    std::optional<Interval> range;
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t i = 0; i < (layout.count - 1) * layout.inner; ++i) {
        const Interval* c = f.data() + o * layout.count * layout.inner + i;
        const Interval slope = c[layout.inner] - c[0];
        range = range ? hull(*range, slope) : slope;
      }
    return *range * Interval(f.degree(variable)) / Interval(width);
  }

  /// Enclosure of the Jacobian over a box.
  Matrix jacobian(const Box<2>& box) const
  {
    Matrix j;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto f = equations_[k]->enclosure(box);
      for (int v = 0; v < 2; ++v) j[k][static_cast<std::size_t>(v)] = derivative_range(f, v, box.width(v));
    }
    return j;
  }

  using Real_matrix = std::array<std::array<double, 2>, 2>;

  static std::optional<Real_matrix> inverse_midpoint(const Matrix& j)
  {
    const double a = midpoint(j[0][0]), b = midpoint(j[0][1]), c = midpoint(j[1][0]), d = midpoint(j[1][1]);
    const double det = a * d - b * c;
    if (!std::isfinite(1 / det) || det == 0) return std::nullopt;
    const Real_matrix y{{{d / det, -b / det}, {-c / det, a / det}}};
    for (const auto& row : y)
      for (const double entry : row)
        if (!std::isfinite(entry)) return std::nullopt;
    return y;
  }

  static Matrix preconditioned(const Real_matrix& y, const Matrix& j)
  {
    Matrix m;
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t c = 0; c < 2; ++c) m[r][c] = Interval(y[r][0]) * j[0][c] + Interval(y[r][1]) * j[1][c];
    return m;
  }

  /// Strict diagonal dominance of an interval matrix: the map is then one-to-one on the box.
  static bool is_dominant(const Matrix& m)
  {
    return mignitude(m[0][0]) > magnitude(m[0][1]) && mignitude(m[1][1]) > magnitude(m[1][0]);
  }

  /// Krawczyk's operator on `box`; a result inside the box proves one solution there, and encloses it.
  Point krawczyk(const Box<2>& box, const Real_matrix& y, const Matrix& m) const
  {
    const double cx = 0.5 * (box.lo[0] + box.hi[0]), cy = 0.5 * (box.lo[1] + box.hi[1]);
    const Interval f = equations_[0]->value({cx, cy}), g = equations_[1]->value({cx, cy});
    const Interval dx = Interval(box.lo[0], box.hi[0]) - Interval(cx), dy = Interval(box.lo[1], box.hi[1]) - Interval(cy);
    const Interval one(1);
    return {Interval(cx) - (Interval(y[0][0]) * f + Interval(y[0][1]) * g) + (one - m[0][0]) * dx - m[0][1] * dy,
            Interval(cy) - (Interval(y[1][0]) * f + Interval(y[1][1]) * g) - m[1][0] * dx + (one - m[1][1]) * dy};
  }

  /// True if the cell is settled: no solution in it, or its only one has been recorded.
  bool resolve(const Cell& cell)
  {
    Box<2> wide = cell.box;
    for (std::size_t v = 0; v < 2; ++v) {
      const double margin = 0.25 * (wide.hi[v] - wide.lo[v]);
      wide.lo[v] -= margin;
      wide.hi[v] += margin;
    }
    const Matrix j = jacobian(wide);
    const auto y = inverse_midpoint(j);
    if (!y) return false;
    const Matrix m = preconditioned(*y, j);
    if (!is_dominant(m)) return false;
    const auto found = locate(wide, *y, m);
    if (!found) return false;
    if (!*found) return true; // no solution in the enlarged cell
    Isolated_point p = **found;
    p.unique_in = wide;
    record(p, cell.box);
    return true;
  }

  /// Contracts `box` by Krawczyk's operator. Nothing: undecided. An empty inner optional: proved to have no solution.
  std::optional<std::optional<Isolated_point>> locate(Box<2> box, Real_matrix y, Matrix m) const
  {
    bool proved = false;
    for (int step = 0; step < 60; ++step) {
      const Point k = krawczyk(box, y, m);
      bool inner = true, smaller = false;
      Box<2> next = box;
      for (std::size_t v = 0; v < 2; ++v) {
        if (k[v].sup() < box.lo[v] || k[v].inf() > box.hi[v]) return std::optional<Isolated_point>{};
        inner = inner && box.lo[v] < k[v].inf() && k[v].sup() < box.hi[v];
        next.lo[v] = std::max(box.lo[v], k[v].inf());
        next.hi[v] = std::min(box.hi[v], k[v].sup());
        smaller = smaller || next.hi[v] - next.lo[v] < 0.97 * (box.hi[v] - box.lo[v]);
      }
      proved = proved || inner;
      if (!smaller || (proved && next.max_width() < finest_enclosure)) {
        // Slow contraction of a box that is still large says nothing yet: the caller cuts the cell.
        if (!proved || next.max_width() > largest_enclosure) return std::nullopt;
        Isolated_point p;
        p.box = {Interval(next.lo[0], next.hi[0]), Interval(next.lo[1], next.hi[1])};
        return p;
      }
      box = next;
      const Matrix j = jacobian(box);
      if (const auto inverse = inverse_midpoint(j)) y = *inverse;
      m = preconditioned(y, j);
    }
    return std::nullopt;
  }

  static bool lies_within(const Point& p, const Box<2>& box)
  {
    return box.lo[0] < p[0].inf() && p[0].sup() < box.hi[0] && box.lo[1] < p[1].inf() && p[1].sup() < box.hi[1];
  }

  void record(const Isolated_point& candidate, const Box<2>& cell)
  {
    for (std::size_t v = 0; v < 2; ++v)
      if (candidate.box[v].sup() < cell.lo[v] || candidate.box[v].inf() > cell.hi[v]) return;
    // Two enclosures that meet are of one solution if either lies where the other's is known to be the only one.
    for (const Isolated_point& known : found_)
      if (overlap(known.box[0], candidate.box[0]) && overlap(known.box[1], candidate.box[1]) &&
          (lies_within(candidate.box, known.unique_in) || lies_within(known.box, candidate.unique_in)))
        return;
    found_.push_back(candidate);
  }

  void split_cell(const Cell& cell, std::vector<Cell>& stack) const
  {
    const int v = cell.box.width(0) >= cell.box.width(1) ? 0 : 1;
    const auto vv = static_cast<std::size_t>(v);
    auto f = split(cell.f, v, 0.5), g = split(cell.g, v, 0.5);
    Box<2> low = cell.box, high = cell.box;
    low.hi[vv] = high.lo[vv] = 0.5 * (cell.box.lo[vv] + cell.box.hi[vv]);
    stack.push_back({low, std::move(f.first), std::move(g.first), cell.depth + 1});
    stack.push_back({high, std::move(f.second), std::move(g.second), cell.depth + 1});
  }

  /// Whether both equations have a common root on a face of the unit cell near the point: exact, by a gcd.
  bool lies_on_face(const Isolated_point& p, int variable, int side) const
  {
    const auto f = monomial_form(face(equations_[0]->exact(), variable, side == 1));
    const auto g = monomial_form(face(equations_[1]->exact(), variable, side == 1));
    const Integer_polynomial common = gcd(f, g);
    const Interval& along = p.box[static_cast<std::size_t>(1 - variable)];
    return has_root_within(common, Rational(along.inf()), Rational(along.sup()));
  }

  void settle_boundaries()
  {
    for (Isolated_point& p : found_) {
      bool outside = false, open = false;
      for (int v = 0; v < 2; ++v) {
        const Interval& x = p.box[static_cast<std::size_t>(v)];
        outside = outside || x.sup() < 0 || x.inf() > 1;
        for (int side = 0; side < 2; ++side) {
          if (!(x.inf() <= side && side <= x.sup())) continue;
          if (lies_on_face(p, v, side)) p.face[static_cast<std::size_t>(v)] = side;
          else open = true;
        }
      }
      if (outside) continue;
      if (open) {
        Box<2> box;
        for (std::size_t v = 0; v < 2; ++v) {
          box.lo[v] = p.box[v].inf();
          box.hi[v] = p.box[v].sup();
        }
        result_.undecided.push_back(box);
      } else {
        result_.points.push_back(p);
      }
    }
  }

  Pair equations_;
  const Solve_control& control_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Point_set result_;
  std::vector<Isolated_point> found_;
};

} // namespace detail

/// Isolated solutions of two equations in two variables on the unit cell (upward rounding needed). Solutions that are
/// not regular are left in `undecided`, never merged or dropped.
inline Point_set solve_points(const std::array<std::shared_ptr<const Equation<2>>, 2>& equations,
                              const Solve_control& control)
{
  return detail::Point_solver_2(equations, control).run();
}

} // namespace locus

#endif
