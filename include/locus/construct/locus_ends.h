// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_LOCUS_ENDS_H
#define LOCUS_CONSTRUCT_LOCUS_ENDS_H

#include <locus/construct/locus.h>
#include <locus/function/domain.h>

namespace locus {
namespace detail {

/// Joins ends of arcs that were found apart: an end is known by its feet.
class End_joiner {
public:
  /// The parameters at which an input is closed, if it is.
  struct Seam {
    bool is_closed = false;
    Range first, last;
  };

  explicit End_joiner(std::vector<Seam> seams) : seams_(std::move(seams)) {}

  /// An end of an arc at a finite point with the feet that are known, and others, one of which at least is one if there are any;
  /// returns its number.
  std::size_t add(Locus_vertex<2> vertex, std::vector<Foot> possible = {})
  {
    vertex.feet = distinct(std::move(vertex.feet));
    ends_.push_back(std::move(vertex));
    possible_.push_back(std::move(possible));
    return ends_.size() - 1;
  }

  /// Numbers of the joined vertices by ends; the vertices are appended to `vertices`.
  std::vector<std::size_t> join(std::vector<Locus_vertex<2>>& vertices)
  {
    std::vector<std::size_t> parent(ends_.size());
    for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = i;
    const auto find = [&](std::size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (std::size_t i = 0; i < ends_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (are_one(i, j)) parent[find(i)] = find(j);
    std::vector<std::size_t> number(ends_.size());
    degree_.assign(ends_.size(), 0);
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (find(i) == i) {
        number[i] = vertices.size();
        vertices.push_back(ends_[i]);
      }
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      number[i] = number[find(i)];
      ++degree_[find(i)];
      if (find(i) == i) continue;
      Locus_vertex<2>& v = vertices[number[i]];
      if (ends_[i].error < v.error) {
        v.point = ends_[i].point;
        v.radius = ends_[i].radius;
        v.error = ends_[i].error;
      }
      v.feet.insert(v.feet.end(), ends_[i].feet.begin(), ends_[i].feet.end());
      v.feet = distinct(std::move(v.feet));
    }
    for (std::size_t i = 0; i < ends_.size(); ++i) degree_[i] = degree_[find(i)];
    return number;
  }

  /// How many ends were joined to an end, itself included.
  std::size_t degree(std::size_t end) const { return degree_[end]; }

  /// Whether two ranges of an input's parameter have a place in common.
  bool may_be_one_place(std::size_t input, const Range& x, const Range& y) const
  {
    if (overlap(x, y)) return true;
    const Seam& seam = seams_[input];
    return seam.is_closed && ((overlap(x, seam.first) && overlap(y, seam.last)) || (overlap(x, seam.last) && overlap(y, seam.first)));
  }

  /// Feet at one place are one; what is known best of it remains.
  std::vector<Foot> distinct(std::vector<Foot> feet) const
  {
    std::vector<Foot> all;
    for (Foot& f : feet) {
      const auto same = std::find_if(all.begin(), all.end(), [&](const Foot& g) { return are_one(f, g); });
      if (same == all.end()) all.push_back(std::move(f));
      else if (is_closer(f, *same)) *same = std::move(f);
    }
    std::stable_sort(all.begin(), all.end(), [](const Foot& a, const Foot& b) { return a.input < b.input; });
    return all;
  }

private:
  static bool overlap(const Range& a, const Range& b) { return a.lo <= b.hi && b.lo <= a.hi; }

  bool are_one(const Foot& a, const Foot& b) const
  {
    if (a.input != b.input) return false;
    if (a.parameters.empty() || b.parameters.empty()) return a.parameters.empty() && b.parameters.empty();
    return may_be_one_place(a.input, a.parameters[0], b.parameters[0]);
  }

  /// An end or a corner says more than the inside beside it, and a narrow enclosure more than a wide one.
  static bool is_closer(const Foot& a, const Foot& b)
  {
    if ((a.feature == Feature::interior) != (b.feature == Feature::interior)) return b.feature == Feature::interior;
    return !a.parameters.empty() && a.parameters[0].hi - a.parameters[0].lo < b.parameters[0].hi - b.parameters[0].lo;
  }

  /// The feet of either may be feet of the other, and the points may be the same: two ends can have their feet in common, as where
  /// one foot or the other passes from an end of its input to the inside.
  bool are_one(std::size_t i, std::size_t j) const
  {
    const Locus_vertex<2>&a = ends_[i], &b = ends_[j];
    if (a.point && b.point) {
      const double apart = std::hypot((*a.point)[0] - (*b.point)[0], (*a.point)[1] - (*b.point)[1]);
      if (apart > (a.error + b.error) * (1 + 8 * operation_error) + 0x1p-1000) return false;
    }
    if (possible_[i].empty() || possible_[j].empty()) return covers(i, j) || covers(j, i);
    return covers(i, j) && covers(j, i);
  }

  /// Whether all feet of the second end may be feet of the first one.
  bool covers(std::size_t i, std::size_t j) const
  {
    const auto has = [&](const std::vector<Foot>& feet, const Foot& f) {
      return std::any_of(feet.begin(), feet.end(), [&](const Foot& g) { return are_one(f, g); });
    };
    return std::all_of(ends_[j].feet.begin(), ends_[j].feet.end(), [&](const Foot& f) { return has(ends_[i].feet, f) || has(possible_[i], f); });
  }

  std::vector<Seam> seams_;
  std::vector<Locus_vertex<2>> ends_;
  std::vector<std::vector<Foot>> possible_;
  std::vector<std::size_t> degree_;
};

} // namespace detail
} // namespace locus

#endif
