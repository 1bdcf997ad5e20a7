// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_FACE_SEGMENTS_H
#define LOCUS_ZERO_SET_FACE_SEGMENTS_H

#include <locus/zero_set/cell_tree.h>
#include <locus/zero_set/roots.h>

#include <deque>
#include <memory>

namespace locus {
namespace detail {

/// A segment that the subdivision laid down in one cut (or a side of the unit cell), with the roots of the equation
/// on it. The cells on both sides, of whatever size, look their crossings up here, so a crossing exists once.
struct Face_segment {
  int fixed_variable = 0;
  double fixed = 0, lo = 0, hi = 0;
  bool on_boundary = false;
  Cell_tree::Index source = 0; ///< a cell that has the whole segment as its face
  bool source_high = false;

  bool solved = false;
  std::unique_ptr<const Univariate> polynomial; ///< apart, for most segments of a large subdivision are never solved
  Root_set<double> set;
  std::vector<int> vertex; ///< vertex number of each root, -1 before the first use
};

/// A root of a segment as seen from a cell's face.
struct Crossing_ref {
  std::size_t segment;
  std::size_t root;
};

class Face_segments {
public:
  explicit Face_segments(Cell_tree& tree) : tree_(tree) {}

  std::size_t add(int fixed_variable, double fixed, double lo, double hi, bool on_boundary, Cell_tree::Index source,
                  bool source_high)
  {
    Face_segment& s = segments_.emplace_back();
    s.fixed_variable = fixed_variable;
    s.fixed = fixed;
    s.lo = lo;
    s.hi = hi;
    s.on_boundary = on_boundary;
    s.source = source;
    s.source_high = source_high;
    return segments_.size() - 1;
  }

  Face_segment& operator[](std::size_t i) { return segments_[i]; }
  const Face_segment& operator[](std::size_t i) const { return segments_[i]; }

  /// The segment with its roots isolated.
  Face_segment& solved(std::size_t i)
  {
    Face_segment& s = segments_[i];
    if (!s.solved) {
      s.solved = true;
      s.polynomial = std::make_unique<const Univariate>(
        face(tree_.bounded_form(s.source), s.fixed_variable, s.source_high), s.lo, s.hi,
        [this, i] {
          const Face_segment& self = segments_[i];
          return face(tree_.exact(self.source), self.fixed_variable, self.source_high);
        },
        &tree_.counts(),
        [this, i](double lo, double hi) {
          const Face_segment& self = segments_[i];
          Box<2> box;
          const auto v = static_cast<std::size_t>(self.fixed_variable);
          box.lo[v] = box.hi[v] = self.fixed;
          box.lo[1 - v] = lo;
          box.hi[1 - v] = hi;
          return bounded(face(tree_.equation().enclosure(box), self.fixed_variable, false));
        });
      s.set = isolate_roots(*s.polynomial, tree_.all_exact());
      s.vertex.assign(s.set.roots.size(), -1);
    }
    return s;
  }

  /// Where root `r` lies against the coordinate x: -1 below, 0 exactly there, 1 above. Narrows the root as needed.
  int compare(Face_segment& s, std::size_t r, double x)
  {
    auto& root = s.set.roots[r];
    if (root.is_exact()) return root.lo < x ? -1 : root.lo > x ? 1 : 0;
    if (root.hi <= x) return -1;
    if (root.lo >= x) return 1;
    const Sign at_x = sign_for_refinement(*s.polynomial, root, x);
    if (at_x == Sign::zero) {
      root.lo = root.hi = x;
      return 0;
    }
    (at_x == sign_for_refinement(*s.polynomial, root, root.hi) ? root.hi : root.lo) = x;
    return root.hi == x ? -1 : 1;
  }

  /// Index of the first root not below x.
  std::size_t lower_bound(Face_segment& s, double x)
  {
    std::size_t r = 0;
    while (r < s.set.roots.size() && compare(s, r, x) < 0) ++r;
    return r;
  }

  /// Strict order of two different points along two parallel segments (refines until their enclosures part).
  /// False in `certain` where doubles cannot part them.
  bool less(Crossing_ref a, Crossing_ref b, bool& certain)
  {
    Face_segment &sa = segments_[a.segment], &sb = segments_[b.segment];
    auto &ra = sa.set.roots[a.root], &rb = sb.set.roots[b.root];
    if (a.segment == b.segment) return a.root < b.root;
    for (double width = 0x1p-6; ra.hi >= rb.lo && rb.hi >= ra.lo; width *= 0x1p-8) {
      if (width < 0x1p-60) {
        certain = false;
        return false;
      }
      refine_root(*sa.polynomial, ra, width, width);
      refine_root(*sb.polynomial, rb, width, width);
    }
    return ra.hi < rb.lo;
  }

private:
  Cell_tree& tree_;
  std::deque<Face_segment> segments_;
};

} // namespace detail
} // namespace locus

#endif
