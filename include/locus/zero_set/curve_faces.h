// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CURVE_FACES_H
#define LOCUS_ZERO_SET_CURVE_FACES_H

#include <locus/zero_set/face_crossings.h>
#include <locus/zero_set/graph_cells.h>
#include <locus/zero_set/system_jacobian.h>

#include <deque>
#include <limits>
#include <optional>
#include <stdexcept>

namespace locus {
namespace detail {

/// The faces that the subdivision of a curve's domain lays down, and the curve's crossings of them. A cut's face is solved
/// once, when the cut is proposed, and shared by the cells on both sides, whatever their sizes.
///
/// A cut is *clean* if the curve crosses its face transversally in points that are all isolated, and passes neither
/// through the face's edges nor through places where the face meets the crossings of older faces. Clean cuts are
/// preferred, so that the curve passes from cell to cell through the inside of faces. What a cut that is not clean leaves
/// in doubt makes the cells beside it undecided.
template <int D>
class Curve_faces {
public:
  static constexpr int K = D - 1;
  using Tree = System_tree<K, D>;
  using Index = typename Tree::Index;
  using Crossing = Face_crossing<D>;

  /// A part of a plane laid down by one cut, or a side of the unit cell.
  struct Segment {
    int variable = 0;
    Box<D> box; ///< flat in `variable`
    bool on_boundary = false;
    std::vector<Crossing> crossings;
    std::vector<Box<D>> undecided;

    bool is_clean() const { return undecided.empty(); }
  };

  /// Which crossing of which segment.
  struct Place {
    std::size_t segment, crossing;
  };

  /// A stretch of the curve in a cell between two crossings, from the lower base value to the higher one.
  struct Stretch {
    Index cell;
    Pivot_set<K> pivots;
    Place from, to;
  };

  Curve_faces(const System<K, D>& system, const Tree& tree, const Solve_control& control)
    : system_(system), tree_(tree), control_(control)
  {
    control_.max_cells = std::min(control.max_cells, most_face_cells);
    control_.progress = {};
    faces_.resize(1);
    for (int v = 0; v < D; ++v)
      for (std::size_t side = 0; side < 2; ++side) {
        Box<D> box = Box<D>::unit();
        box.lo[index(v)] = box.hi[index(v)] = static_cast<double>(side);
        faces_[0][index(v)][side] = segments.size();
        segments.push_back(solved(v, box, true));
      }
  }

  std::deque<Segment> segments;
  std::vector<Stretch> stretches;
  std::vector<Place> touches; ///< where the curve touches an edge or a corner of the unit cell from outside
  std::size_t search_cells = 0;

  // ------------------------------------------------------------------------------------------------- cuts

  bool admits(Index i, int variable, double at, bool is_last)
  {
    const bool is_clean = is_clear_of_crossings(i, variable, at);
    if (!is_clean && !is_last && wasted_cells_ < most_wasted_cells) return false;
    Box<D> box = tree_[i].box;
    box.lo[index(variable)] = box.hi[index(variable)] = at;
    Segment proposed = is_missed(i, variable, at) ? empty_segment(variable, box) : solved(variable, box, false);
    if (!proposed.is_clean()) wasted_cells_ += last_search_;
    if (wasted_cells_ >= most_wasted_cells) control_.max_cells = std::min(control_.max_cells, few_face_cells);
    else if (!proposed.is_clean() && !is_last) return false;
    proposed_ = std::move(proposed);
    return true;
  }

  void was_cut(Index i)
  {
    const Index low = tree_[i].low_child;
    const std::size_t v = index(proposed_.variable);
    faces_.resize(tree_.size());
    faces_[low] = faces_[low + 1] = faces_[i];
    faces_[low][v][1] = faces_[low + 1][v][0] = segments.size();
    segments.push_back(std::move(proposed_));
  }

  // ------------------------------------------------------------------------------------------- graph cells

  /// In a graph cell the curve lies over a union of intervals of the base: it has no loop and no singular point there,
  /// and at most one point over each base value. Where the curve crosses the inside of a face transversally it enters or
  /// leaves the cell, so each crossing is an end of exactly one of these intervals; each interval has two ends, and they
  /// are neighbours in the order of base values. Intervals of one point do not occur: there the curve would touch a face.
  Settled settles(Index i, const Pivot_set<K>& pivots)
  {
    doubt_.reset();
    std::vector<Place> ends = crossings_of(i);
    if (!doubt_) keep_one_each(i, ends);
    const auto base = index(base_variables<D>(pivots)[0]);
    if (!doubt_) sort_along(base, ends);
    if (doubt_) return is_worth_cutting(i) ? Settled::cut : Settled::no;
    if (ends.size() % 2 != 0) throw std::logic_error("locus: a curve enters a graph cell and does not leave it");
    for (std::size_t k = 0; k < ends.size(); k += 2) stretches.push_back({i, pivots, ends[k], ends[k + 1]});
    touches.insert(touches.end(), touched_.begin(), touched_.end());
    return Settled::yes;
  }

  int wish(Index i) const { return i == wished_cell_ ? wished_variable_ : -1; }

  /// False for one of several finds of a point on an edge or a corner of the unit cell.
  static bool is_alone(const Crossing& c)
  {
    for (const int e : c.end)
      if (e >= 0) return false;
    return true;
  }

  const Crossing& at(const Place& p) const { return segments[p.segment].crossings[p.crossing]; }
  Crossing& at(const Place& p) { return segments[p.segment].crossings[p.crossing]; }

private:
  static constexpr std::size_t most_face_cells = 1000; ///< of one search; beyond, the rest of the face is undecided
  /// Where the zero set is no curve, no cut is clean: after so many cells in vain the first cut is taken, and less is
  /// spent on it.
  static constexpr std::size_t most_wasted_cells = 30'000, few_face_cells = 50;

  using Faces = std::array<std::array<std::size_t, 2>, static_cast<std::size_t>(D)>; // [variable][low, high]

  static constexpr std::size_t index(int variable) { return static_cast<std::size_t>(variable); }

  /// Whether the cell's own coefficients prove already that some polynomial has no zero on a cut.
  bool is_missed(Index i, int variable, double at)
  {
    const std::size_t v = index(variable), size = tree_.coefficient_count_each();
    const double s = (at - tree_[i].box.lo[v]) / (tree_[i].box.hi[v] - tree_[i].box.lo[v]), rest = 1 - s;
    const Layout layout = layout_along(tree_.degrees(), variable);
    low_.resize(size);
    high_.resize(size);
    for (std::size_t k = 0; k < index(K); ++k) {
      split_kernel(tree_.coefficients(i, k), low_.data(), high_.data(), layout,
                   [=](double a, double b) { return rest * a + s * b; });
      double least = std::numeric_limits<double>::infinity(), greatest = -least;
      for (std::size_t o = 0; o < layout.outer; ++o)
        for (std::size_t j = 0; j < layout.inner; ++j) {
          const double c = high_[o * layout.count * layout.inner + j];
          least = std::min(least, c);
          greatest = std::max(greatest, c);
        }
      // As in a cut: the roundings of `s` move the face by a little.
      const double error = accumulated_error(tree_[i].error[k], 11.0 * tree_.degrees()[v], tree_[i].norm[k]);
      if (least > error || greatest < -error) return true;
    }
    return false;
  }

  Segment empty_segment(int variable, const Box<D>& box)
  {
    Segment s;
    s.variable = variable;
    s.box = box;
    last_search_ = 0;
    return s;
  }

  /// Crossings that lie on an edge of a face inside the domain count as undecided.
  Segment solved(int variable, const Box<D>& box, bool on_boundary)
  {
    Face_crossings<D> found(system_, variable, box, control_);
    Segment s;
    s.variable = variable;
    s.box = box;
    s.on_boundary = on_boundary;
    s.undecided = std::move(found.undecided);
    for (const Crossing& c : found.points) {
      if (on_boundary || is_inside(c, box, variable)) s.crossings.push_back(c);
      else s.undecided.push_back(hull_of(c));
    }
    last_search_ = found.cells;
    search_cells += found.cells;
    return s;
  }

  static bool is_inside(const Crossing& c, const Box<D>& box, int variable)
  {
    for (std::size_t w = 0; w < index(D); ++w)
      if (w != index(variable) && !(box.lo[w] < c.at[w].inf() && c.at[w].sup() < box.hi[w])) return false;
    return true;
  }

  static Box<D> hull_of(const Crossing& c)
  {
    Box<D> b;
    for (std::size_t v = 0; v < index(D); ++v) {
      b.lo[v] = c.at[v].inf();
      b.hi[v] = c.at[v].sup();
    }
    return b;
  }

  static bool meet(const Box<D>& a, const Box<D>& b)
  {
    for (std::size_t v = 0; v < index(D); ++v)
      if (a.hi[v] < b.lo[v] || b.hi[v] < a.lo[v]) return false;
    return true;
  }

  /// No crossing, and no doubt, on the faces of the cell lies where a new face would meet them.
  bool is_clear_of_crossings(Index i, int variable, double at) const
  {
    Box<D> slice = tree_[i].box;
    slice.lo[index(variable)] = slice.hi[index(variable)] = at;
    for (std::size_t v = 0; v < index(D); ++v) {
      if (v == index(variable)) continue;
      for (const std::size_t s : faces_[i][v]) {
        for (const Crossing& c : segments[s].crossings)
          if (meet(hull_of(c), slice)) return false;
        for (const Box<D>& b : segments[s].undecided)
          if (meet(b, slice)) return false;
      }
    }
    return true;
  }

  enum class Where : unsigned char { outside, inside, unsure };

  /// Where a crossing of a segment lies against the part of the segment that is the cell's face.
  static Where locate(const Segment& s, const Crossing& c, const Box<D>& cell)
  {
    Where where = Where::inside;
    for (std::size_t w = 0; w < index(D); ++w) {
      if (w == index(s.variable)) continue;
      if (c.at[w].sup() < cell.lo[w] || c.at[w].inf() > cell.hi[w]) return Where::outside;
      if (cell.lo[w] > s.box.lo[w] && !(c.at[w].inf() > cell.lo[w])) where = Where::unsure;
      if (cell.hi[w] < s.box.hi[w] && !(c.at[w].sup() < cell.hi[w])) where = Where::unsure;
    }
    return where;
  }

  void add_doubt(const Box<D>& b)
  {
    if (!doubt_) doubt_ = b;
    for (std::size_t v = 0; v < index(D); ++v) {
      doubt_->lo[v] = std::min(doubt_->lo[v], b.lo[v]);
      doubt_->hi[v] = std::max(doubt_->hi[v], b.hi[v]);
    }
  }

  std::vector<Place> crossings_of(Index i)
  {
    const Box<D>& box = tree_[i].box;
    std::vector<Place> places;
    for (const auto& sides : faces_[i])
      for (const std::size_t id : sides) {
        const Segment& s = segments[id];
        for (const Box<D>& b : s.undecided)
          if (meet(b, box)) add_doubt(b);
        for (std::size_t c = 0; c < s.crossings.size(); ++c) {
          const Where where = locate(s, s.crossings[c], box);
          if (where == Where::inside) places.push_back({id, c});
          if (where == Where::unsure) add_doubt(hull_of(s.crossings[c]));
        }
      }
    return places;
  }

  // ---------------------------------------------------------------------- edges and corners of the unit cell

  /// A crossing on an edge or a corner of the unit cell was found on each of the faces there: keeps the first of them,
  /// if a branch of the curve goes on into the cell; otherwise the curve only touches it.
  void keep_one_each(Index i, std::vector<Place>& places)
  {
    touched_.clear();
    std::vector<Place> kept;
    for (const Place& p : places) {
      if (is_alone(at(p))) {
        kept.push_back(p);
        continue;
      }
      if (first_of(i, p, places) != p.segment) continue;
      const Answer enters = goes_on_inside(p);
      if (doubt_ || enters == Answer::undecided) return add_doubt(hull_of(at(p)));
      (enters == Answer::yes ? kept : touched_).push_back(p);
    }
    places.swap(kept);
  }

  /// The first segment on which the point was found; doubt where it was not found, for certain the same, on all its faces.
  std::size_t first_of(Index i, const Place& p, const std::vector<Place>& places)
  {
    std::size_t first = p.segment;
    for (std::size_t w = 0; w < index(D); ++w) {
      if (at(p).end[w] < 0) continue;
      const std::size_t across = faces_[i][w][static_cast<std::size_t>(at(p).end[w])];
      bool found = false;
      for (const Place& q : places)
        if (q.segment == across && are_same(at(p), at(q))) found = true;
      if (!found) add_doubt(hull_of(at(p)));
      first = std::min(first, across);
    }
    return first;
  }

  /// Both lie on the two planes, and one lies where the other is the only zero on its own plane.
  static bool are_same(const Crossing& p, const Crossing& q)
  {
    return meet(hull_of(p), hull_of(q)) && (lies_in(p, q.unique_in) || lies_in(q, p.unique_in));
  }

  static bool lies_in(const Crossing& c, const Box<D>& box)
  {
    for (std::size_t v = 0; v < index(D); ++v)
      if (c.at[v].inf() < box.lo[v] || c.at[v].sup() > box.hi[v]) return false;
    return true;
  }

  /// Whether one of the two branches at a point on several faces of the unit cell lies inside: the tangent points inwards,
  /// or outwards, on all of these faces. Its components are minors of the Jacobian.
  Answer goes_on_inside(const Place& p) const
  {
    Box<D> around = hull_of(at(p));
    for (std::size_t v = 0; v < index(D); ++v) {
      around.lo[v] -= 0x1p-26;
      around.hi[v] += 0x1p-26;
    }
    const auto j = jacobian_over(system_, around);
    bool inwards = false, outwards = false;
    for (std::size_t w = 0; w < index(D); ++w) {
      const bool is_own = w == index(segments[p.segment].variable);
      if (!is_own && at(p).end[w] < 0) continue;
      const bool is_high = is_own ? segments[p.segment].box.lo[w] > 0 : at(p).end[w] == 1;
      const Sign s = sign_of(tangent_component(j, w));
      if (!is_strict(s)) return Answer::undecided;
      ((s == Sign::positive) != is_high ? inwards : outwards) = true;
    }
    return inwards && outwards ? Answer::no : Answer::yes;
  }

  static Interval tangent_component(const System_jacobian<K, D>& j, std::size_t without)
  {
    std::array<std::array<Interval, index(K)>, index(K)> minor;
    for (std::size_t r = 0; r < index(K); ++r)
      for (std::size_t v = 0, c = 0; v < index(D); ++v)
        if (v != without) minor[r][c++] = j[r][v];
    const Interval m = determinant(minor);
    return without % 2 == 0 ? m : -m;
  }

  // ------------------------------------------------------------------------------------------------- order

  /// Sorts places by base values; doubt where two enclosures overlap.
  void sort_along(std::size_t base, std::vector<Place>& places)
  {
    std::sort(places.begin(), places.end(),
              [&](const Place& p, const Place& q) { return at(p).at[base].inf() < at(q).at[base].inf(); });
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      if (at(places[k]).at[base].sup() < at(places[k + 1]).at[base].inf()) continue;
      add_doubt(hull_of(at(places[k])));
      add_doubt(hull_of(at(places[k + 1])));
    }
  }

  /// A doubt that is small against the cell can be cut off: the rest of the cell will be decided then.
  bool is_worth_cutting(Index i)
  {
    const Box<D>& box = tree_[i].box;
    wished_cell_ = i;
    wished_variable_ = -1;
    double widest = control_.node_width;
    for (int v = 0; v < D; ++v) {
      if (!(4 * doubt_->width(v) < box.width(v)) || !(box.width(v) > widest)) continue;
      widest = box.width(v);
      wished_variable_ = v;
    }
    return wished_variable_ >= 0;
  }

  const System<K, D>& system_;
  const Tree& tree_;
  Solve_control control_;
  std::vector<Faces> faces_;
  Segment proposed_;
  std::size_t last_search_ = 0, wasted_cells_ = 0;
  std::vector<double> low_, high_; ///< scratch
  std::optional<Box<D>> doubt_;
  std::vector<Place> touched_;
  Index wished_cell_ = Tree::none;
  int wished_variable_ = -1;
};

} // namespace detail
} // namespace locus

#endif
