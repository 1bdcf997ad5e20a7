// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CONTACT_SEARCH_H
#define LOCUS_CONSTRUCT_CONTACT_SEARCH_H

#include <locus/construct/contact_sites.h>

namespace locus {
namespace detail {

/// A place where circles are known to touch a site.
struct Contact_foot {
  std::size_t site = 0;
  Interval at; ///< local parameter
};

/// A part of a site about which something is still to be said.
struct Contact_leaf {
  enum class State : unsigned char {
    open,     ///< circles may touch it
    rising,   ///< none touches it, and it is outside if its low end is: the power, divided by the weight's square, grows
    falling,  ///< the same with its high end
    convex    ///< the power is convex along it: nonnegative if it is joined to a foot
  };
  std::size_t site = 0, node = 0;
  State state = State::open;
};

/// What may be touched besides the feet.
struct Contact_list {
  std::vector<Contact_leaf> leaves;
  std::vector<std::size_t> vertices;

  bool has_open() const
  {
    return !vertices.empty() || std::any_of(leaves.begin(), leaves.end(), [](const Contact_leaf& l) { return l.state == Contact_leaf::State::open; });
  }
  bool has_monotone() const
  {
    return std::any_of(leaves.begin(), leaves.end(), [](const Contact_leaf& l) { return l.state == Contact_leaf::State::rising || l.state == Contact_leaf::State::falling; });
  }
};

/// Tells whether circles that touch two feet contain anything else, by signs on parts of the sites. For all circles of an enclosure
/// at once a part is done with if
/// - its power is positive;
/// - its turn has one sign, so that no circle touches it, and the end where the power is least is outside;
/// - its turn grows, and it holds a foot or continues such a part: the power is not negative then;
/// - it holds both feet and the power's fourth derivative is positive: the power has no other zeros than the two double ones.
/// A negative power at a part's end, or a turn that falls at a foot, means that no circle is empty. Two feet in one chain of parts along
/// which the turn grows contradict each other: such circles are only met beside joints that are taken as smooth and are not, where
/// they would be a corner's.
class Contact_search {
public:
  explicit Contact_search(Contact_sites& sites) : sites_(sites) {}

  Contact_list everything() const
  {
    Contact_list all;
    for (std::size_t i = 0; i < sites_.size(); ++i) all.leaves.push_back({i, 0, Contact_leaf::State::open});
    for (std::size_t v = 0; v < sites_.vertices().size(); ++v) all.vertices.push_back(v);
    return all;
  }

  /// What is left of a list for the circles; nothing where none of them is empty.
  std::optional<Contact_list> examine(const Circle& circle, const std::array<Contact_foot, 2>& feet, const Contact_list& list)
  {
    circle_ = &circle;
    feet_ = &feet;
    left_ = {};
    outside_.clear();
    is_nonempty_ = false;
    budget_ = most_leaves;
    for (const Contact_leaf& leaf : list.leaves) {
      treat(leaf.site, leaf.node);
      if (is_nonempty_) return std::nullopt;
    }
    while (split_loose_convex())
      if (is_nonempty_) return std::nullopt;
    if (is_nonempty_) return std::nullopt;
    while (drop_outside()) {}
    for (const std::size_t v : list.vertices) {
      const Sign s = power_at_vertex(v);
      if (s == Sign::negative) return std::nullopt;
      if (s != Sign::positive && !ends_joined_part(v)) left_.vertices.push_back(v);
    }
    return std::move(left_);
  }

  /// Whether no open part reaches a foot: then the circles are locally empty at both.
  bool are_feet_free(const Contact_list& list, const std::array<Contact_foot, 2>& feet) const
  {
    return std::none_of(list.leaves.begin(), list.leaves.end(), [&](const Contact_leaf& l) {
      if (l.state != Contact_leaf::State::open) return false;
      const auto& n = sites_[l.site].tree.node(l.node);
      return std::any_of(feet.begin(), feet.end(), [&](const Contact_foot& f) { return f.site == l.site && reaches(n, f.at); });
    });
  }

  /// The side of the chord from the first foot to the second one on which all open parts lie: the sign of cross(chord, part);
  /// unknown where they do not lie on one.
  Sign side_of_chord(const Contact_list& list, const std::array<Contact_foot, 2>& feet) const
  {
    const Vector_2<Interval> from = point(feet[0]), chord = point(feet[1]) - from;
    Sign all = Sign::zero;
    const auto note = [&](const Vector_2<Interval>& p) {
      const Sign s = sign_of(cross(chord, p - from));
      all = all == Sign::zero || all == s ? s : Sign::unknown;
      return is_strict(all);
    };
    for (const Contact_leaf& l : list.leaves) {
      if (l.state != Contact_leaf::State::open) continue;
      const auto& n = sites_[l.site].tree.node(l.node);
      if (!note(sites_[l.site].evaluator->point(Interval(n.lo, n.hi)))) return Sign::unknown;
    }
    for (const std::size_t v : list.vertices) {
      const Contact_vertex& at = sites_.vertices()[v];
      if (!note(sites_[at.site].evaluator->point(Interval(at.end)))) return Sign::unknown;
    }
    return all;
  }

private:
  using State = Contact_leaf::State;
  using Node = Contact_tree::Node;

  /// Parts smaller than this are left open.
  static constexpr double least_width = 0x1p-40;
  static constexpr std::size_t most_leaves = 400;

  static bool reaches(const Node& n, const Interval& at) { return at.inf() <= n.hi && at.sup() >= n.lo; }
  static bool holds(const Node& n, const Interval& at) { return n.lo <= at.inf() && at.sup() <= n.hi; }

  Vector_2<Interval> point(const Contact_foot& f) const { return sites_[f.site].evaluator->point(f.at); }

  void treat(std::size_t site, std::size_t node)
  {
    const Node& n = sites_[site].tree.node(node);
    power_.make(*circle_, n.power, 0);
    if (power_.first() == Sign::negative || power_.last() == Sign::negative) {
      is_nonempty_ = true;
      return;
    }
    if (power_.common() == Sign::positive) return;
    int reached = 0, held = 0;
    for (const Contact_foot& f : *feet_)
      if (f.site == site) {
        reached += reaches(n, f.at);
        held += holds(n, f.at);
      }
    turn_.make(*circle_, n.turn, 0);
    if (const Sign s = turn_.common(); is_strict(s)) {
      const bool rises = s == Sign::positive;
      if ((rises ? power_.first() : power_.last()) != Sign::positive) left_.leaves.push_back({site, node, rises ? State::rising : State::falling});
      return;
    }
    if (held == 2) {
      fourth_.make(*circle_, n.power, 4);
      const Sign s = fourth_.common();
      if (s == Sign::negative) is_nonempty_ = true;
      if (is_strict(s)) return;
    }
    if (reached < 2) {
      slope_.make(*circle_, n.turn, 1);
      const Sign s = slope_.common({n.lo == 0 ? sites_[site].rests[0] : 0, n.hi == 1 ? sites_[site].rests[1] : 0});
      if (s == Sign::negative && held == 1) {
        is_nonempty_ = true;
        return;
      }
      if (s == Sign::positive) {
        left_.leaves.push_back({site, node, State::convex});
        return;
      }
    }
    halve_or_leave(site, node);
  }

  void halve_or_leave(std::size_t site, std::size_t node)
  {
    if (is_nonempty_) return;
    const Node& n = sites_[site].tree.node(node);
    if (n.hi - n.lo <= least_width || budget_ == 0 || !(power_.is_resolved() || turn_.is_resolved())) {
      left_.leaves.push_back({site, node, State::open});
      return;
    }
    --budget_;
    const std::size_t low = sites_[site].tree.halve(node);
    treat(site, low);
    if (!is_nonempty_) treat(site, low + 1);
  }

  /// Of convex parts only those that are joined to a foot count. The others are halved; tells whether there were any.
  bool split_loose_convex()
  {
    note_joined();
    std::vector<Contact_leaf> loose;
    auto& leaves = left_.leaves;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (leaves[i].state == State::convex && !joined_[i]) loose.push_back(leaves[i]);
      else leaves[kept++] = leaves[i];
    }
    leaves.resize(kept);
    for (const Contact_leaf& l : loose) {
      const Node& n = sites_[l.site].tree.node(l.node);
      power_.make(*circle_, n.power, 0);
      turn_.make(*circle_, n.turn, 0);
      halve_or_leave(l.site, l.node);
      if (is_nonempty_) return true;
    }
    if (loose.empty()) return false;
    return std::any_of(leaves.begin(), leaves.end(), [](const Contact_leaf& l) { return l.state == State::convex; });
  }

  /// Which convex parts hold a foot, or continue such a part without a corner between: 1 for the first foot, 2 for the second one.
  void note_joined()
  {
    const auto& leaves = left_.leaves;
    joined_.assign(leaves.size(), 0);
    std::vector<std::size_t> todo;
    char foot = 0;
    const auto join = [&](std::size_t i) {
      if (leaves[i].state != State::convex || joined_[i] == foot) return;
      is_nonempty_ = is_nonempty_ || joined_[i] != 0;
      joined_[i] = foot;
      todo.push_back(i);
    };
    for (const Contact_foot& f : *feet_) {
      ++foot;
      for (std::size_t i = 0; i < leaves.size(); ++i)
        if (f.site == leaves[i].site && reaches(sites_[f.site].tree.node(leaves[i].node), f.at)) join(i);
      while (!todo.empty()) {
        const std::size_t i = todo.back();
        todo.pop_back();
        for (std::size_t k = 0; k < leaves.size(); ++k)
          if (are_neighbours(leaves[i], leaves[k])) join(k);
      }
    }
  }

  /// Monotone parts that begin where a convex part ends, or go on from such a part, are outside. Whether there were any.
  bool drop_outside()
  {
    auto& leaves = left_.leaves;
    const auto is_monotone = [](const Contact_leaf& l) { return l.state == State::rising || l.state == State::falling; };
    if (outside_.size() != leaves.size()) outside_.assign(leaves.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (!is_monotone(leaves[i]) || outside_[i]) continue;
      const auto begins_at = [&](std::size_t k) {
        const bool follows = leaves[i].state == State::rising ? meets(leaves[k], leaves[i]) : meets(leaves[i], leaves[k]);
        return follows && (leaves[k].state == State::convex || outside_[k]);
      };
      for (std::size_t k = 0; k < leaves.size() && !outside_[i]; ++k)
        if (k != i && begins_at(k)) outside_[i] = any = true;
    }
    if (any) return true;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (!outside_[i]) leaves[kept++] = leaves[i];
    leaves.resize(kept);
    outside_.clear();
    return false;
  }

  /// Whether the second part begins, smoothly or in a corner, where the first one ends.
  bool meets(const Contact_leaf& a, const Contact_leaf& b) const
  {
    if (goes_on(a, b)) return true;
    const std::size_t corner = sites_[a.site].vertex[1];
    return corner != Contact_sites::none && corner == sites_[b.site].vertex[0] && sites_[a.site].tree.node(a.node).hi == 1 && sites_[b.site].tree.node(b.node).lo == 0;
  }

  /// Whether the second part begins, smoothly, where the first one ends.
  bool goes_on(const Contact_leaf& a, const Contact_leaf& b) const
  {
    const Node &m = sites_[a.site].tree.node(a.node), &n = sites_[b.site].tree.node(b.node);
    return (a.site == b.site && m.hi == n.lo) || (m.hi == 1 && n.lo == 0 && sites_[a.site].smooth_next[1] == b.site);
  }

  bool are_neighbours(const Contact_leaf& a, const Contact_leaf& b) const { return goes_on(a, b) || goes_on(b, a); }

  /// Whether a vertex is the end of a convex part that is joined to a foot.
  bool ends_joined_part(std::size_t vertex) const
  {
    return std::any_of(left_.leaves.begin(), left_.leaves.end(), [&](const Contact_leaf& l) {
      if (l.state != State::convex) return false;
      const Contact_site& s = sites_[l.site];
      const Node& n = s.tree.node(l.node);
      return (n.lo == 0 && s.vertex[0] == vertex) || (n.hi == 1 && s.vertex[1] == vertex);
    });
  }

  Sign power_at_vertex(std::size_t vertex)
  {
    const Contact_vertex& v = sites_.vertices()[vertex];
    power_.make(*circle_, sites_[v.site].tree.node(0).power, 0);
    return v.end == 0 ? power_.first() : power_.last();
  }

  Contact_sites& sites_;
  const Circle* circle_ = nullptr;
  const std::array<Contact_foot, 2>* feet_ = nullptr;
  Contact_list left_;
  bool is_nonempty_ = false;
  std::size_t budget_ = 0;
  Contact_row power_, turn_, slope_, fourth_;
  std::vector<char> joined_, outside_;
};

} // namespace detail
} // namespace locus

#endif
