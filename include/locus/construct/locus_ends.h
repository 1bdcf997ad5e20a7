// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_LOCUS_ENDS_H
#define LOCUS_CONSTRUCT_LOCUS_ENDS_H

#include <locus/construct/parameter_range.h>

#include <functional>
#include <map>

namespace locus {
namespace detail {

/// An end of an arc at a finite point.
struct Arc_end {
  Locus_vertex<2> vertex;     ///< with the feet that are known
  std::vector<Foot> possible; ///< others, one of which at least is one if there are any
  std::vector<Foot> pair;     ///< the arc's own feet, with its features
  std::size_t arc = 0;
  std::optional<std::size_t> changing; ///< of two inputs the one on which the arc that goes on has another foot, where that is known
};

/// Joins ends of arcs that were found apart: an end is known by its feet.
class End_joiner {
public:
  explicit End_joiner(std::vector<Parameter_seam> seams) : seams_(std::move(seams)) {}

  /// Returns the end's number.
  std::size_t add(Arc_end end)
  {
    end.vertex.feet = distinct(std::move(end.vertex.feet));
    ends_.push_back(std::move(end));
    return ends_.size() - 1;
  }

  /// Numbers of the joined vertices by ends; the vertices are appended to `vertices`. Away from places where two inputs meet two arcs
  /// of their bisector end at each, with `in_pairs`: where more may have one end, as beside the ends of an arc that is shorter than
  /// errors, they are told apart by the feet that they have in common.
  std::vector<std::size_t> join(std::vector<Locus_vertex<2>>& vertices, bool in_pairs)
  {
    std::vector<std::vector<std::size_t>> groups;
    for (std::vector<std::size_t>& group : groups_of_one()) {
      const bool is_node = std::any_of(group.begin(), group.end(), [&](std::size_t i) { return ends_[i].vertex.kind == Vertex_kind::node; });
      if (auto pairs = in_pairs && !is_node && group.size() > 2 ? paired(group) : std::nullopt) {
        for (const auto& pair : *pairs) groups.push_back({pair[0], pair[1]});
      } else {
        groups.push_back(std::move(group));
      }
    }
    std::vector<std::size_t> number(ends_.size());
    degree_.assign(ends_.size(), 0);
    for (const auto& group : groups) {
      for (const std::size_t i : group) {
        number[i] = vertices.size();
        degree_[i] = group.size();
      }
      vertices.push_back(merged(group));
    }
    return number;
  }

  /// How many ends were joined to an end, itself included.
  std::size_t degree(std::size_t end) const { return degree_[end]; }

  /// Whether two ranges of an input's parameter have a place in common.
  bool may_be_one_place(std::size_t input, const Range& x, const Range& y) const
  {
    return seams_[input].may_be_one_place(x, y);
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

  /// Ends that may be one, all those together that others link.
  std::vector<std::vector<std::size_t>> groups_of_one() const
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
    std::map<std::size_t, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < ends_.size(); ++i) groups[find(i)].push_back(i);
    std::vector<std::vector<std::size_t>> all;
    for (auto& [root, group] : groups) all.push_back(std::move(group));
    return all;
  }

  /// Ends two by two: of arcs that have one foot in common, and change that on one input; the nearest ones.
  std::optional<std::vector<std::array<std::size_t, 2>>> paired(const std::vector<std::size_t>& group) const
  {
    constexpr std::size_t most = 8;
    if (group.size() > most || group.size() % 2) return std::nullopt;
    std::optional<std::vector<std::array<std::size_t, 2>>> best;
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::array<std::size_t, 2>> pairs;
    const std::function<void(std::vector<std::size_t>, double)> extend = [&](std::vector<std::size_t> rest, double length) {
      if (rest.empty()) {
        if (!best || length < least) best = pairs;
        least = std::min(least, length);
        return;
      }
      const std::size_t i = rest.back();
      rest.pop_back();
      for (std::size_t k = 0; k < rest.size(); ++k) {
        if (!may_go_on(i, rest[k])) continue;
        std::vector<std::size_t> others = rest;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        pairs.push_back({i, rest[k]});
        extend(std::move(others), length + apart(ends_[i].vertex, ends_[rest[k]].vertex));
        pairs.pop_back();
      }
    };
    extend(group, 0);
    return best;
  }

  bool may_go_on(std::size_t i, std::size_t j) const
  {
    const Arc_end &a = ends_[i], &b = ends_[j];
    if (a.arc == b.arc || (a.changing && b.changing && *a.changing != *b.changing)) return false;
    std::size_t common = 0;
    for (const Foot& f : a.pair)
      for (const Foot& g : b.pair) common += f.feature == g.feature && are_one(f, g);
    return common == 1;
  }

  Locus_vertex<2> merged(const std::vector<std::size_t>& group) const
  {
    Locus_vertex<2> v = ends_[group.front()].vertex;
    for (std::size_t k = 1; k < group.size(); ++k) {
      const Locus_vertex<2>& other = ends_[group[k]].vertex;
      if (other.error < v.error) {
        v.point = other.point;
        v.radius = other.radius;
        v.error = other.error;
      }
      v.feet.insert(v.feet.end(), other.feet.begin(), other.feet.end());
      if (other.kind == Vertex_kind::node) v.kind = other.kind;
    }
    v.feet = distinct(std::move(v.feet));
    return v;
  }

  static double apart(const Locus_vertex<2>& a, const Locus_vertex<2>& b)
  {
    return a.point && b.point ? std::hypot((*a.point)[0] - (*b.point)[0], (*a.point)[1] - (*b.point)[1]) : 0;
  }

  /// The feet of either may be feet of the other, and the points may be the same: two ends can have their feet in common, as where
  /// one foot or the other passes from an end of its input to the inside.
  bool are_one(std::size_t i, std::size_t j) const
  {
    const Locus_vertex<2>&a = ends_[i].vertex, &b = ends_[j].vertex;
    if (a.point && b.point && apart(a, b) > (a.error + b.error) * (1 + 8 * operation_error) + 0x1p-1000) return false;
    if (ends_[i].possible.empty() || ends_[j].possible.empty()) return covers(i, j) || covers(j, i);
    return covers(i, j) && covers(j, i);
  }

  /// Whether all feet of the second end may be feet of the first one.
  bool covers(std::size_t i, std::size_t j) const
  {
    const auto has = [&](const std::vector<Foot>& feet, const Foot& f) {
      return std::any_of(feet.begin(), feet.end(), [&](const Foot& g) { return are_one(f, g); });
    };
    const auto& feet = ends_[j].vertex.feet;
    return std::all_of(feet.begin(), feet.end(), [&](const Foot& f) { return has(ends_[i].vertex.feet, f) || has(ends_[i].possible, f); });
  }

  std::vector<Parameter_seam> seams_;
  std::vector<Arc_end> ends_;
  std::vector<std::size_t> degree_;
};

} // namespace detail
} // namespace locus

#endif
