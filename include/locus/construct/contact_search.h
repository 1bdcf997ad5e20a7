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
    convex,   ///< the turn grows along it: the power is nonnegative if it is joined to a foot
    quartic,  ///< the power's fourth derivative is positive: of four zeros there are no more than the feet's, if it holds both
    bent      ///< the curvature rises and falls so seldom that there are no more zeros than the feet's, if its ends are outside
  };
  std::size_t site = 0, node = 0;
  State state = State::open;

  bool is_open() const { return state == State::open; }
  bool is_monotone() const { return state == State::rising || state == State::falling; }
};

/// What may be touched besides the feet.
struct Contact_list {
  std::vector<Contact_leaf> leaves;
  std::vector<std::size_t> vertices;

  bool has_open() const
  {
    return !vertices.empty() || std::any_of(leaves.begin(), leaves.end(), [](const Contact_leaf& l) { return l.is_open(); });
  }
  /// Whether one circle must tell for all.
  bool has_pending() const
  {
    return std::any_of(leaves.begin(), leaves.end(), [](const Contact_leaf& l) { return l.is_monotone(); });
  }
};

/// Tells whether circles that touch two feet contain anything else, by signs on parts of the sites. For all circles of an enclosure
/// at once a part is done with if
/// - its power is positive;
/// - its turn has one sign, so that no circle touches it, and the end where the power is least is outside;
/// - its turn grows, and it holds a foot or continues such a part: the power is not negative then;
/// - it holds both feet and the power's fourth derivative is positive: the power has no other zeros than the two double ones;
/// - it is a chain of parts, smoothly joined, that holds k feet, along which the curvature rises and falls in fewer than 2k runs, a
///   step at a joint included, and the power is not negative at its ends. For an inversion that makes a line of the circle maps
///   the chain to a graph, if it does not turn too far away from the circle; by Rolle's theorem n zeros of a graph make n - 2 of
///   its curvature, and those n - 2 runs; and inversions keep runs. So the power has fewer than 2k + 2 zeros, 2k of which are the
///   feet's, and one more would change its sign. (For one foot this is Kneser's theorem on spirals.)
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
    while (split_loose())
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

  /// What of a list may reach into a disc.
  Contact_list within(const Circle& disc, const Contact_list& list)
  {
    left_ = {};
    budget_ = most_leaves;
    for (const Contact_leaf& l : list.leaves) add_within(disc, l.site, l.node);
    circle_ = &disc;
    for (const std::size_t v : list.vertices)
      if (power_at_vertex(v) != Sign::positive) left_.vertices.push_back(v);
    return std::move(left_);
  }

  /// The list with whole sites where open parts are beside a foot: near the ends of arcs only parts much longer than the feet's
  /// distance may be long enough to tell.
  Contact_list widened(const Contact_list& list, const std::array<Contact_foot, 2>& feet) const
  {
    std::array<bool, 2> is_whole{};
    for (const Contact_leaf& l : list.leaves)
      for (std::size_t k = 0; k < 2; ++k)
        is_whole[k] = is_whole[k] || (l.state == State::open && l.site == feet[k].site && reaches(node_of(l), feet[k].at + Interval(-beside, beside)));
    if (is_whole[1] && feet[0].site == feet[1].site) is_whole[1] = !is_whole[0];
    Contact_list wide;
    wide.vertices = list.vertices;
    for (const Contact_leaf& l : list.leaves)
      if (!(is_whole[0] && l.site == feet[0].site) && !(is_whole[1] && l.site == feet[1].site)) wide.leaves.push_back(l);
    for (std::size_t k = 0; k < 2; ++k)
      if (is_whole[k]) wide.leaves.push_back({feet[k].site, 0, State::open});
    return wide;
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
      const Contact_vertex::Place& at = sites_.vertices()[v].places.front();
      if (!note(sites_[at.site].evaluator->point(Interval(at.end)))) return Sign::unknown;
    }
    return all;
  }

private:
  using State = Contact_leaf::State;
  using Node = Contact_tree::Node;

  static constexpr std::size_t none = Contact_sites::none;
  /// Parts smaller than this are left open.
  static constexpr double least_width = 0x1p-40;
  static constexpr std::size_t most_leaves = 400;
  static constexpr double least_part_within = 0x1p-10;
  static constexpr int most_runs = 3; ///< with two feet
  static constexpr double beside = 0x1p-6;

  static bool reaches(const Node& n, const Interval& at) { return at.inf() <= n.hi && at.sup() >= n.lo; }
  static bool holds(const Node& n, const Interval& at) { return n.lo <= std::max(0.0, at.inf()) && std::min(1.0, at.sup()) <= n.hi; }
  /// More than one end at which another part holds it.
  static bool holds_some(const Node& n, const Interval& at) { return at.inf() == at.sup() ? reaches(n, at) : at.inf() < n.hi && at.sup() > n.lo; }

  const Node& node_of(const Contact_leaf& l) const { return sites_[l.site].tree.node(l.node); }

  Vector_2<Interval> point(const Contact_foot& f) const { return sites_[f.site].evaluator->point(f.at); }

  void add_within(const Circle& disc, std::size_t site, std::size_t node)
  {
    const Node& n = sites_[site].tree.node(node);
    power_.make(disc, n.power, 0);
    if (power_.common() == Sign::positive) return;
    if (n.hi - n.lo <= least_part_within || budget_ == 0) {
      left_.leaves.push_back({site, node, State::open});
      return;
    }
    --budget_;
    const std::size_t low = sites_[site].tree.halve(node);
    add_within(disc, site, low);
    add_within(disc, site, low + 1);
  }

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
    if (reached < 2) {
      slope_.make(*circle_, n.turn, 1);
      const Sign s = reached == 1 && sites_[site].is_line ? Sign::positive : slope_.common(); // on a line whatever the parameter
      if (s == Sign::negative && held == 1) {
        is_nonempty_ = true;
        return;
      }
      if (s == Sign::positive) {
        left_.leaves.push_back({site, node, State::convex});
        return;
      }
    }
    if (reached > 0) {
      fourth_.make(*circle_, n.power, 4);
      const Sign s = fourth_.common();
      if (s == Sign::negative && held == 2) {
        is_nonempty_ = true;
        return;
      }
      if (s == Sign::positive && feet_on(site) == 2) {
        left_.leaves.push_back({site, node, State::quartic});
        return;
      }
    }
    if (reached > 0 && (power_.first() == Sign::positive || power_.last() == Sign::positive)) {
      if (const auto runs = sites_[site].tree.curvature_runs(n.lo, n.hi); runs && runs->count <= most_runs) {
        left_.leaves.push_back({site, node, State::bent});
        return;
      }
    }
    halve_or_leave(site, node);
  }

  std::size_t feet_on(std::size_t site) const { return static_cast<std::size_t>((*feet_)[0].site == site) + ((*feet_)[1].site == site); }

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

  /// Of convex parts only those that are joined to a foot count, of quartic and bent ones those that make up a whole. The others are
  /// halved; tells whether there were any.
  bool split_loose()
  {
    note_joined();
    note_quartic();
    drop_bent();
    std::vector<Contact_leaf> loose;
    auto& leaves = left_.leaves;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const State s = leaves[i].state;
      if ((s == State::convex || s == State::quartic || s == State::bent) && !joined_[i]) loose.push_back(leaves[i]);
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
    return !loose.empty();
  }

  /// Quartic parts side by side that hold both feet.
  void note_quartic()
  {
    const auto& leaves = left_.leaves;
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (leaves[i].state == State::quartic) parts.push_back(i);
    if (parts.empty()) return;
    const auto node = [&](std::size_t i) -> const Node& { return sites_[leaves[i].site].tree.node(leaves[i].node); };
    std::sort(parts.begin(), parts.end(), [&](std::size_t i, std::size_t k) { return node(i).lo < node(k).lo; }); // of one site
    bool is_whole = true;
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) is_whole = is_whole && node(parts[k]).hi == node(parts[k + 1]).lo;
    for (const Contact_foot& f : *feet_) is_whole = is_whole && node(parts.front()).lo <= f.at.inf() && f.at.sup() <= node(parts.back()).hi;
    for (const std::size_t i : parts) joined_[i] = is_whole;
    // The power's derivative has three zeros there, at the feet and between: beyond, it grows. That is the turn where the weight is constant.
    if (!is_whole || !sites_[leaves[parts[0]].site].is_polynomial) return;
    std::vector<std::size_t> seeds;
    for (std::size_t k = 0; k < leaves.size(); ++k)
      if (leaves[k].state == State::convex && !joined_[k] && (goes_on(leaves[k], leaves[parts.front()]) || goes_on(leaves[parts.back()], leaves[k]))) seeds.push_back(k);
    join_from(seeds, 3);
  }

  /// A part of a site in a chain of such parts; the power is not negative beyond an end that is outside.
  struct Span {
    std::size_t site;
    double lo, hi;
  };

  Span span_of(const Contact_leaf& l) const { return {l.site, node_of(l).lo, node_of(l).hi}; }

  /// Chains of bent parts that are done with.
  void drop_bent()
  {
    const auto& leaves = left_.leaves;
    const auto next = [&](std::size_t i) {
      for (std::size_t k = 0; k < leaves.size(); ++k)
        if (leaves[k].state == State::bent && goes_on(leaves[i], leaves[k])) return k;
      return none;
    };
    std::vector<char> is_continued(leaves.size(), 0), is_done(leaves.size(), 0);
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (leaves[i].state == State::bent && next(i) != none) is_continued[next(i)] = 1;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (leaves[i].state != State::bent || is_continued[i]) continue;
      std::vector<std::size_t> chain{i};
      for (std::size_t k = next(i); k != none; k = next(k)) chain.push_back(k);
      if (!is_outside(chain)) continue;
      for (const std::size_t k : chain) is_done[k] = 1;
    }
    drop(is_done);
  }

  void drop(const std::vector<char>& is_done)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < left_.leaves.size(); ++i) {
      if (is_done[i]) continue;
      left_.leaves[kept] = left_.leaves[i];
      joined_[kept++] = joined_[i];
    }
    left_.leaves.resize(kept);
    joined_.resize(kept);
  }

  bool is_outside(const std::vector<std::size_t>& chain)
  {
    const auto& leaves = left_.leaves;
    std::vector<Span> spans;
    for (const std::size_t i : chain) spans.push_back(span_of(leaves[i]));
    std::array<std::size_t, 2> beyond{none, none}; // convex parts joined to a foot
    for (const bool high : {false, true}) {
      const std::size_t end = high ? chain.back() : chain.front();
      power_.make(*circle_, node_of(leaves[end]).power, 0);
      if ((high ? power_.last() : power_.first()) == Sign::positive) continue;
      beyond[high] = joined_beyond(end, high);
      if (beyond[high] == none) return false;
    }
    if (has_few_zeros(spans)) return true;
    // Up to the foot in a convex part.
    for (const bool high : {false, true}) {
      if (beyond[high] == none) continue;
      const Contact_leaf& l = leaves[beyond[high]];
      for (const Contact_foot& f : *feet_) {
        Span s = span_of(l);
        if (f.site != l.site || !holds(node_of(l), f.at)) continue;
        (high ? s.hi : s.lo) = high ? std::min(s.hi, f.at.sup()) : std::max(s.lo, f.at.inf());
        std::vector<Span> longer = spans;
        longer.insert(high ? longer.end() : longer.begin(), s);
        if (has_few_zeros(longer)) return true;
      }
    }
    return false;
  }

  /// Whether the power has no zeros along a chain but the feet's, if it is not negative at its ends.
  bool has_few_zeros(const std::vector<Span>& chain) const
  {
    std::array<bool, 2> held{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Contact_foot& f = (*feet_)[k];
      double lo = 2, hi = -1;
      for (const Span& s : chain)
        if (s.site == f.site) {
          lo = std::min(lo, s.lo);
          hi = std::max(hi, s.hi);
        }
      held[k] = lo <= std::max(0.0, f.at.inf()) && std::min(1.0, f.at.sup()) <= hi;
      if (!held[k] && f.at.inf() < hi && f.at.sup() > lo) return false;
    }
    if (!held[0] && !held[1]) return false;
    const auto runs = runs_of(chain);
    return runs && runs->count < 2 * (held[0] + held[1]) && is_graph(chain, (*feet_)[held[0] ? 0 : 1]);
  }

  std::optional<Curvature_runs> runs_of(const std::vector<Span>& chain) const
  {
    Curvature_runs runs;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const Contact_tree& tree = sites_[chain[k].site].tree;
      const auto of_part = tree.curvature_runs(chain[k].lo, chain[k].hi);
      if (!of_part) return std::nullopt;
      const bool is_same_piece = k > 0 && chain[k].site == chain[k - 1].site;
      runs.add(k == 0 || is_same_piece ? Sign::zero : sites_[chain[k - 1].site].tree.curvature_step(tree), *of_part);
    }
    return runs;
  }

  /// Whether an inversion that makes a line of the circle maps the parts to a graph over it, with the point opposite to a foot A at
  /// infinity: x' > 0 where the tangent is turned from that at A by less than a right angle but for twice the angle under which the
  /// point is seen, from the opposite point, away from A. It is if no tangent is turned by more than half a right angle, and no
  /// point is farther from A than half the radius.
  bool is_graph(const std::vector<Span>& chain, const Contact_foot& foot) const
  {
    constexpr int parts = 8;
    std::array<Interval, 4> c;
    for (std::size_t k = 0; k < 4; ++k) {
      const double e = circle_->error[k] + std::abs(circle_->slope[k]);
      c[k] = Interval(circle_->c[k]) + Interval(-e, e);
    }
    const Interval size = CGAL::square(c[1]) + CGAL::square(c[2]) - Interval(4) * c[0] * c[3]; // (2·radius·c0)²
    const Vector_2<Interval> a = point(foot), along = sites_[foot.site].evaluator->tangent(foot.at);
    for (const Span& s : chain) {
      const auto& evaluator = *sites_[s.site].evaluator;
      const double step = (s.hi - s.lo) / parts;
      for (int k = 0; k < parts; ++k) {
        const Interval t(s.lo + k * step, k + 1 == parts ? s.hi : s.lo + (k + 1) * step); // one ends where the next one begins
        const Vector_2<Interval> off = evaluator.point(t) - a, tangent = evaluator.tangent(t);
        const Interval d = dot(along, tangent), x = cross(along, tangent), reach = Interval(16) * CGAL::square(c[0]) * dot(off, off);
        if (!((d - x).inf() > 0) || !((d + x).inf() > 0) || !(reach.sup() <= size.inf())) return false;
      }
    }
    return true;
  }

  /// The part beyond an end of a leaf, on its own piece or across a smooth joint, if it is convex and joined to a foot.
  std::size_t joined_beyond(std::size_t i, bool high) const
  {
    const auto& leaves = left_.leaves;
    for (std::size_t k = 0; k < leaves.size(); ++k)
      if (leaves[k].state == State::convex && joined_[k] && (high ? goes_on(leaves[i], leaves[k]) : goes_on(leaves[k], leaves[i]))) return k;
    return none;
  }

  /// Which convex parts hold a foot, or continue such a part without a corner between: 1 for the first foot, 2 for the second one.
  void note_joined()
  {
    const auto& leaves = left_.leaves;
    joined_.assign(leaves.size(), 0);
    char foot = 0;
    for (const Contact_foot& f : *feet_) {
      ++foot;
      std::vector<std::size_t> seeds;
      for (std::size_t i = 0; i < leaves.size(); ++i)
        if (f.site == leaves[i].site && holds_some(sites_[f.site].tree.node(leaves[i].node), f.at)) seeds.push_back(i);
      join_from(seeds, foot);
    }
  }

  /// All convex parts that are reached from some.
  void join_from(const std::vector<std::size_t>& seeds, char mark)
  {
    const auto& leaves = left_.leaves;
    std::vector<std::size_t> todo;
    const auto join = [&](std::size_t i) {
      if (leaves[i].state != State::convex || joined_[i] == mark) return;
      is_nonempty_ = is_nonempty_ || joined_[i] != 0;
      joined_[i] = mark;
      todo.push_back(i);
    };
    for (const std::size_t i : seeds) join(i);
    while (!todo.empty()) {
      const std::size_t i = todo.back();
      todo.pop_back();
      for (std::size_t k = 0; k < leaves.size(); ++k)
        if (are_neighbours(leaves[i], leaves[k])) join(k);
    }
  }

  /// Monotone parts that begin where a convex or quartic part ends, or go on from such a part, are outside. Whether there were any.
  bool drop_outside()
  {
    auto& leaves = left_.leaves;
    if (outside_.size() != leaves.size()) outside_.assign(leaves.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (!leaves[i].is_monotone() || outside_[i]) continue;
      const auto begins_at = [&](std::size_t k) {
        if (leaves[k].state != State::convex && leaves[k].state != State::quartic && !outside_[k]) return false;
        const bool is_rising = leaves[i].state == State::rising;
        return (is_rising ? goes_on(leaves[k], leaves[i]) : goes_on(leaves[i], leaves[k])) || has_end_at(leaves[k], vertex_at(leaves[i], is_rising ? 0 : 1));
      };
      for (std::size_t k = 0; k < leaves.size() && !outside_[i]; ++k)
        if (k != i && begins_at(k)) outside_[i] = any = true;
    }
    if (any) return true;
    drop(outside_);
    outside_.clear();
    return false;
  }

  /// The end or corner at an end of a part, if that is one.
  std::size_t vertex_at(const Contact_leaf& l, std::size_t end) const
  {
    const Node& n = node_of(l);
    return (end == 0 ? n.lo == 0 : n.hi == 1) ? sites_[l.site].vertex[end] : none;
  }
  bool has_end_at(const Contact_leaf& l, std::size_t vertex) const { return vertex != none && (vertex_at(l, 0) == vertex || vertex_at(l, 1) == vertex); }

  /// Whether the second part begins, smoothly, where the first one ends.
  bool goes_on(const Contact_leaf& a, const Contact_leaf& b) const
  {
    const Node &m = sites_[a.site].tree.node(a.node), &n = sites_[b.site].tree.node(b.node);
    return (a.site == b.site && m.hi == n.lo) || (m.hi == 1 && n.lo == 0 && sites_[a.site].smooth_next[1] == b.site);
  }

  bool are_neighbours(const Contact_leaf& a, const Contact_leaf& b) const { return goes_on(a, b) || goes_on(b, a); }

  /// Whether a vertex is the end of a convex or quartic part, along which the power is not negative.
  bool ends_joined_part(std::size_t vertex) const
  {
    return std::any_of(left_.leaves.begin(), left_.leaves.end(), [&](const Contact_leaf& l) {
      return (l.state == State::convex || l.state == State::quartic) && has_end_at(l, vertex);
    });
  }

  Sign power_at_vertex(std::size_t vertex)
  {
    const Contact_vertex::Place& v = sites_.vertices()[vertex].places.front();
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
