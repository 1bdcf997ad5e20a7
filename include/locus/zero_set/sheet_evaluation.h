// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SHEET_EVALUATION_H
#define LOCUS_ZERO_SET_SHEET_EVALUATION_H

#include <locus/zero_set/interval_matrix.h>
#include <locus/zero_set/pivot_sets.h>
#include <locus/zero_set/system_jacobian.h>

#include <vector>

namespace locus {

/// What a graph cell holds over one value of its base variables.
template <int D>
struct Sheet_point {
  Answer exists = Answer::undecided; ///< undecided: too close to the cell's boundary for doubles, or not regular
  std::array<Interval, static_cast<std::size_t>(D)> at; ///< enclosure of the point, if there is one
};

/// Evaluates the curve or sheet in a graph cell: over given values of the base variables, finds the one point of the cell
/// by Krawczyk's operator in the pivots, or proves that there is none. For a piece of a curve it is made from `piece.box`
/// and `piece.pivots`. The system must outlive it; needs upward rounding; may be shared by threads. The usual cost is
/// that of a few enclosures of the equations.
template <int K, int D>
class Sheet_evaluator {
public:
  using Base_values = std::array<double, static_cast<std::size_t>(D - K)>;

  Sheet_evaluator(const System<K, D>& system, const Box<D>& cell, const Pivot_set<K>& pivots)
    : system_(system), cell_(cell), pivots_(pivots)
  {
  }

  /// The point over these base values, which are to lie in the cell. Its enclosure is usually some units in the last
  /// place wide.
  Sheet_point<D> at(const Base_values& values) const
  {
    std::vector<Box<D>> open{start(values)};
    bool in_doubt = false;
    for (int step = 0; !open.empty() && step < most_steps; ++step) {
      Box<D> box = open.back();
      open.pop_back();
      const State state = contract(box);
      if (state == State::none) continue;
      if (state == State::unknown) {
        if (!bisect(box, open)) in_doubt = true;
        continue;
      }
      const Answer inside = lies_in_cell(box);
      if (inside == Answer::yes) return {Answer::yes, as_point(box)};
      in_doubt = in_doubt || inside == Answer::undecided;
    }
    return {in_doubt || !open.empty() ? Answer::undecided : Answer::no, {}};
  }

private:
  enum class State : unsigned char { none, one, unknown };
  static constexpr auto n = static_cast<std::size_t>(K);
  static constexpr int most_steps = 200;
  static constexpr double least_width = 0x1p-48;
  static constexpr double most_width = 0x1p-30; ///< of an enclosure; where contraction is slow, the box is halved first

  std::size_t pivot(std::size_t j) const { return static_cast<std::size_t>(pivots_[j]); }

  /// The pivots may reach a little over the cell, so that a point near its faces lies inside of what is searched.
  Box<D> start(const Base_values& values) const
  {
    Box<D> box = cell_;
    for (std::size_t j = 0; j < n; ++j) {
      const double margin = 0x1p-8 * cell_.width(pivots_[j]);
      box.lo[pivot(j)] -= margin;
      box.hi[pivot(j)] += margin;
    }
    const auto base = base_variables<D>(pivots_);
    for (std::size_t b = 0; b < base.size(); ++b) {
      const auto v = static_cast<std::size_t>(base[b]);
      box.lo[v] = box.hi[v] = values[b];
    }
    return box;
  }

  /// Narrows the box to the one point that is proved to lie in it.
  State contract(Box<D>& box) const
  {
    bool proved = false;
    for (int step = 0; step < 40; ++step) {
      widen_where_flat(box);
      Box<D> next = box;
      const State state = krawczyk(next);
      if (state == State::none) return State::none;
      proved = proved || state == State::one;
      bool smaller = false;
      for (const int v : pivots_)
        smaller = smaller || (box.width(v) > least_width && next.width(v) < 0.9 * box.width(v));
      box = next;
      if (!smaller) break;
    }
    return proved && pivot_width(box) < most_width ? State::one : State::unknown;
  }

  double pivot_width(const Box<D>& box) const
  {
    double w = 0;
    for (const int v : pivots_) w = std::max(w, box.width(v));
    return w;
  }

  /// A pivot that is known to the last bit still needs some width to take slopes over.
  void widen_where_flat(Box<D>& box) const
  {
    for (const int pivot_variable : pivots_) {
      const auto v = static_cast<std::size_t>(pivot_variable);
      if (box.hi[v] - box.lo[v] > 0.25 * least_width) continue;
      box.lo[v] -= 0.25 * least_width;
      box.hi[v] += 0.25 * least_width;
    }
  }

  /// One step: the box becomes its intersection with Krawczyk's image; one point where the image lies inside.
  State krawczyk(Box<D>& box) const
  {
    Square_of_intervals m;
    if (!jacobian(box, m)) return State::none;
    detail::Real_matrix<K> middle;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j) middle[k][j] = midpoint(m[k][j]);
    const auto y = detail::approximate_inverse<K>(middle);
    if (!y) return State::unknown;
    std::array<double, static_cast<std::size_t>(D)> centre{};
    for (std::size_t v = 0; v < centre.size(); ++v)
      centre[v] = box.lo[v] == box.hi[v] ? box.lo[v] : 0.5 * (box.lo[v] + box.hi[v]);
    std::array<Interval, n> value;
    for (std::size_t k = 0; k < n; ++k) value[k] = system_.equations[k]->value(centre);
    bool inside = true;
    const Box<D> old = box;
    for (std::size_t j = 0; j < n; ++j) {
      const Interval image = krawczyk_row(j, (*y)[j], m, value, centre, old);
      const std::size_t v = pivot(j);
      if (image.sup() < old.lo[v] || image.inf() > old.hi[v]) return State::none;
      inside = inside && old.lo[v] < image.inf() && image.sup() < old.hi[v];
      box.lo[v] = std::max(old.lo[v], image.inf());
      box.hi[v] = std::min(old.hi[v], image.sup());
    }
    return inside ? State::one : State::unknown;
  }

  using Square_of_intervals = std::array<std::array<Interval, n>, n>;

  /// Derivatives by the pivots over a box; false where an equation has one strict sign there.
  bool jacobian(const Box<D>& box, Square_of_intervals& m) const
  {
    for (std::size_t k = 0; k < n; ++k) {
      const Bernstein<Interval, D> f = system_.equations[k]->enclosure(box);
      bool positive = true, negative = true;
      for (const Interval& c : f.coefficients()) {
        positive = positive && c.inf() > 0;
        negative = negative && c.sup() < 0;
      }
      if (positive || negative) return false;
      for (std::size_t j = 0; j < n; ++j) m[k][j] = detail::slope_over(f, pivots_[j], box.width(pivots_[j]));
    }
    return true;
  }

  Interval krawczyk_row(std::size_t r, const std::array<double, n>& y, const Square_of_intervals& m,
                        const std::array<Interval, n>& value,
                        const std::array<double, static_cast<std::size_t>(D)>& centre, const Box<D>& box) const
  {
    Interval sum(centre[pivot(r)]);
    for (std::size_t k = 0; k < n; ++k) sum -= Interval(y[k]) * value[k];
    for (std::size_t j = 0; j < n; ++j) {
      Interval rest(r == j ? 1 : 0);
      for (std::size_t k = 0; k < n; ++k) rest -= Interval(y[k]) * m[k][j];
      sum += rest * (Interval(box.lo[pivot(j)], box.hi[pivot(j)]) - Interval(centre[pivot(j)]));
    }
    return sum;
  }

  /// Halves the widest pivot, with an overlap so that no point lies on the border of both parts. False where the box is
  /// too small for that.
  bool bisect(const Box<D>& box, std::vector<Box<D>>& open) const
  {
    int widest = pivots_[0];
    for (const int v : pivots_)
      if (box.width(v) > box.width(widest)) widest = v;
    const auto v = static_cast<std::size_t>(widest);
    if (!(box.hi[v] - box.lo[v] > 0x1p-44)) return false;
    Box<D> low = box, high = box;
    const double middle = 0.5 * (box.lo[v] + box.hi[v]), margin = 0x1p-5 * (box.hi[v] - box.lo[v]);
    low.hi[v] = middle + margin;
    high.lo[v] = middle - margin;
    open.push_back(low);
    open.push_back(high);
    return true;
  }

  Answer lies_in_cell(const Box<D>& box) const
  {
    Answer answer = Answer::yes;
    for (const int pivot_variable : pivots_) {
      const auto v = static_cast<std::size_t>(pivot_variable);
      if (box.hi[v] < cell_.lo[v] || box.lo[v] > cell_.hi[v]) return Answer::no;
      if (box.lo[v] < cell_.lo[v] || box.hi[v] > cell_.hi[v]) answer = Answer::undecided;
    }
    return answer;
  }

  static std::array<Interval, static_cast<std::size_t>(D)> as_point(const Box<D>& box)
  {
    std::array<Interval, static_cast<std::size_t>(D)> p;
    for (std::size_t v = 0; v < p.size(); ++v) p[v] = Interval(box.lo[v], box.hi[v]);
    return p;
  }

  const System<K, D>& system_;
  Box<D> cell_;
  Pivot_set<K> pivots_;
};

} // namespace locus

#endif
