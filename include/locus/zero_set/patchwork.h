// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_PATCHWORK_H
#define LOCUS_ZERO_SET_PATCHWORK_H

#include <locus/function/corner_chart.h>
#include <locus/zero_set/arc_joining.h>
#include <locus/zero_set/curve_graph.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace locus {

/// The zero set on one chart of one cell of a domain: a cell of two chains is their pieces' product, and is covered by
/// itself or by the two charts that blow one of its corners up. A factor solved apart is a graph of its own.
struct Patch {
  Curve_graph graph;
  Corner_chart chart;
  std::size_t cell = 0;              ///< which cell of the domain
  std::vector<char> dropped;         ///< pieces that do not belong to the answer; may be empty
  /// Vertices where what the zero set stands for goes to infinity; 2 where it does so though the vertex is singular.
  std::vector<char> is_pole;
  std::vector<char> is_final;        ///< vertices where arcs end for good, each by itself: on a diagonal
  /// Vertices at a corner that is blown up; above 1 where the image of the branches is known: equal numbers are one image.
  std::vector<char> is_corner;

  bool is_dropped(std::size_t piece) const { return !dropped.empty() && dropped[piece]; }

  /// Parameters of a vertex, local to the cell.
  std::array<Interval, 2> local(std::size_t vertex) const { return chart(graph.vertices[vertex].at); }
};

/// Two sides of cells that are one line of the domain, across which the zero set goes on. The parameter along both is
/// the same; the parameters may have changed places (`variable` says which one is fixed on either side).
struct Glued_sides {
  struct Side {
    std::size_t cell = 0;
    int variable = 0; ///< which is fixed on this side
    int end = 0;      ///< at 0 or 1
  };
  Side a, b;
  /// The equation differs a little on both sides: zeros are matched by their order if they are equally many.
  bool by_order = false;
};

/// A place of the joined zero set, with the patches' vertices that are there.
struct Patchwork_vertex {
  struct Member {
    std::size_t patch, vertex;
  };
  struct Piece_ref {
    std::size_t patch, piece;
  };
  Graph_vertex::Kind kind = Graph_vertex::Kind::crossing;
  bool is_final = false;  ///< of a member
  bool is_pole = false;   ///< of a member
  bool is_corner = false; ///< of a member
  std::vector<Member> members;
  std::vector<Piece_ref> half_branches; ///< in cyclic order, at nodes
};

struct Patchwork_arc {
  struct Step {
    std::size_t patch, piece;
    bool reversed;
  };
  std::vector<Step> steps;
  bool closed = false;
  std::size_t source = 0, target = 0; ///< vertices of the patchwork
};

/// A zero set over a domain of several cells: the patches' graphs, joined across the sides that are glued.
struct Patchwork {
  std::vector<Patch> patches;
  std::vector<Patchwork_vertex> vertices;
  std::vector<Patchwork_arc> arcs;
  /// Places where two sides do not agree, as it seems: patch and vertex.
  std::vector<std::pair<Patchwork_vertex::Member, std::string>> undecided;
};

namespace detail {

/// Joins patches by the order of the zeros on their common sides: those are the same zeros, seen from either side.
class Patch_joiner {
public:
  Patch_joiner(std::vector<Patch> patches, const std::vector<Glued_sides>& glued) : glued_(glued)
  {
    work_.patches = std::move(patches);
    for (const Glued_sides& g : glued) {
      partner_[key(g.a)] = key(g.b);
      partner_[key(g.b)] = key(g.a);
    }
  }

  Patchwork run()
  {
    number_vertices();
    note_sides();
    for (const Glued_sides& g : glued_) match(g);
    for (const auto& [seam, list] : seams_) unite_equal(list);
    unite_corners();
    collect_classes();
    for (Patchwork_vertex& v : work_.vertices) settle(v);
    join();
    return std::move(work_);
  }

private:
  using Member = Patchwork_vertex::Member;
  using Piece_ref = Patchwork_vertex::Piece_ref;
  using Key = std::array<std::size_t, 3>; ///< cell, fixed variable, end
  using Seam = std::tuple<std::size_t, int, int>; ///< cell, ray

  struct On_side {
    Member member;
    Interval along;
  };
  using Side_list = std::vector<On_side>;

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  const Patch& patch(const Member& m) const { return work_.patches[m.patch]; }
  const Graph_vertex& vertex(const Member& m) const { return patch(m).graph.vertices[m.vertex]; }
  std::size_t id(const Member& m) const { return first_[m.patch] + m.vertex; }
  static bool is_exactly(const Interval& x, int end) { return x.inf() == end && x.sup() == end; }
  static Key key(const Glued_sides::Side& s) { return {s.cell, static_cast<std::size_t>(s.variable), static_cast<std::size_t>(s.end)}; }

  void number_vertices()
  {
    std::size_t n = 0;
    for (const Patch& p : work_.patches) {
      first_.push_back(n);
      n += p.graph.vertices.size();
      cells_.insert({p.cell, 0});
    }
    parent_.resize(n);
    for (std::size_t i = 0; i < n; ++i) parent_[i] = i;
    incident_.resize(n);
    for (std::size_t p = 0; p < work_.patches.size(); ++p) {
      const auto& pieces = work_.patches[p].graph.pieces;
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (work_.patches[p].is_dropped(k)) continue;
        incident_[first_[p] + pieces[k].from].push_back({p, k});
        incident_[first_[p] + pieces[k].to].push_back({p, k});
      }
    }
  }

  std::size_t find(std::size_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(const Member& a, const Member& b) { parent_[find(id(a))] = find(id(b)); }

  // -------------------------------------------------------------------------------------------------- sides

  /// Lists the vertices on every side of every cell, and those on the line between two charts.
  void note_sides()
  {
    for (std::size_t p = 0; p < work_.patches.size(); ++p) {
      const Patch& patch = work_.patches[p];
      for (std::size_t v = 0; v < patch.graph.vertices.size(); ++v) {
        if (patch.is_final[v]) continue;
        const std::array<Interval, 2> at = patch.local(v);
        for (std::size_t k = 0; k < 2; ++k)
          for (int end = 0; end < 2; ++end)
            if (is_exactly(at[k], end)) sides_[Key{patch.cell, k, static_cast<std::size_t>(end)}].push_back({{p, v}, at[1 - k]});
        note_seam({p, v});
      }
    }
    for (auto& [key, list] : sides_) sort_along(list);
    for (auto& [seam, list] : seams_) sort_along(list);
  }

  /// The lines that a cell's charts share, by their rays.
  void note_seam(const Member& m)
  {
    const Corner_chart& chart = patch(m).chart;
    const std::array<Interval, 2>& at = vertex(m).at;
    if (chart.is_plain()) return;
    if (chart.is_axis) return seams_[Seam{patch(m).cell, 1, 1}].push_back({m, at[1]});
    for (std::size_t v = 0; v < 2; ++v) {
      if (!is_exactly(at[v], 1)) continue;
      const std::array<int, 2> ray = chart.ray(v);
      if (ray[0] > 0 && ray[1] > 0) seams_[Seam{patch(m).cell, ray[0], ray[1]}].push_back({m, at[1 - v]});
    }
  }

  static void sort_along(Side_list& list)
  {
    std::sort(list.begin(), list.end(), [](const On_side& a, const On_side& b) { return midpoint(a.along) < midpoint(b.along); });
  }

  /// Vertices of several graphs of one cell that are one place: their enclosures meet, and meet no others'.
  void unite_equal(const Side_list& list)
  {
    for (std::size_t k = 0; k + 1 < list.size(); ++k)
      if (overlap(list[k].along, list[k + 1].along) && list[k].member.patch != list[k + 1].member.patch)
        unite(list[k].member, list[k + 1].member);
  }

  /// Groups of overlapping enclosures along a side.
  static std::vector<Side_list> groups(const Side_list& list)
  {
    std::vector<Side_list> all;
    for (const On_side& v : list) {
      if (!all.empty() && overlap(all.back().back().along, v.along)) all.back().push_back(v);
      else all.push_back({v});
    }
    return all;
  }

  void match(const Glued_sides& g)
  {
    const auto a = sides_.find(key(g.a)), b = sides_.find(key(g.b));
    const Side_list empty;
    const std::vector<Side_list> first = groups(a == sides_.end() ? empty : a->second), second = groups(b == sides_.end() ? empty : b->second);
    if (g.by_order && first.size() == second.size()) {
      for (std::size_t k = 0; k < first.size(); ++k) match_groups(first[k], second[k]);
      return;
    }
    std::size_t i = 0, j = 0;
    while (i < first.size() || j < second.size()) {
      if (j == second.size() || (i < first.size() && first[i].back().along.sup() < second[j].front().along.inf())) {
        leave_unmatched(first[i++], g.b.cell);
      } else if (i == first.size() || second[j].back().along.sup() < first[i].front().along.inf()) {
        leave_unmatched(second[j++], g.a.cell);
      } else {
        match_groups(first[i++], second[j++]);
      }
    }
  }

  /// At a corner of its cell of which both sides are glued.
  bool is_inner_corner(const On_side& x) const
  {
    const std::array<Interval, 2> at = patch(x.member).local(x.member.vertex);
    for (std::size_t k = 0; k < 2; ++k)
      for (int end = 0; end < 2; ++end)
        if (is_exactly(at[k], end) && !is_glued({patch(x.member).cell, static_cast<int>(k), end})) return false;
    return true;
  }

  void match_groups(const Side_list& a, const Side_list& b)
  {
    const auto is_corner = [&](const On_side& x) { return patch(x.member).is_corner[x.member.vertex] != 0; };
    const bool at_corner = std::any_of(a.begin(), a.end(), is_corner) || std::any_of(b.begin(), b.end(), is_corner);
    if (at_corner && !is_inner_corner(a[0]) && !is_inner_corner(b[0])) { // on the domain's boundary each branch ends by itself
      for (const Side_list* list : {&a, &b})
        for (const On_side& x : *list) ends_here_.insert({id(x.member), 0});
      return;
    }
    if (a.size() == b.size() && !at_corner) {
      for (std::size_t k = 0; k < a.size(); ++k) unite(a[k].member, b[k].member);
      return;
    }
    // Several graphs of one cell (a factor solved apart, the charts at a corner) may have the same place.
    if (a.size() == 1 || b.size() == 1 || at_corner) {
      for (const On_side& x : a)
        for (const On_side& y : b) unite(x.member, y.member);
      return;
    }
    for (const On_side& x : a) work_.undecided.push_back({x.member, "zeros too close to be told apart where two pieces meet"});
  }

  using Corner = std::array<std::size_t, 3>; ///< cell, end of each variable

  /// Corners of cells that are one place of the domain, though the place may be seen from opposite cells only.
  class Corner_classes {
  public:
    void unite(const Corner& a, const Corner& b)
    {
      const Corner from = find(a), to = find(b);
      parent_[from] = to;
      parent_[to] = to;
    }
    Corner find(Corner c) const
    {
      for (auto at = parent_.find(c); at != parent_.end() && at->second != c; at = parent_.find(c)) c = at->second;
      return c;
    }
    /// All corners at one place.
    std::vector<Corner> at_place_of(const Corner& c) const
    {
      std::vector<Corner> all;
      for (const auto& [corner, parent] : parent_)
        if (find(corner) == find(c)) all.push_back(corner);
      return all;
    }

  private:
    std::map<Corner, Corner> parent_;
  };

  static Corner corner_of(const Glued_sides::Side& s, int along)
  {
    const auto end = static_cast<std::size_t>(s.end), other = static_cast<std::size_t>(along);
    return s.variable == 0 ? Corner{s.cell, end, other} : Corner{s.cell, other, end};
  }

  /// The corner of a cell that is exactly there, if one is.
  static std::optional<Corner> corner_at(std::size_t cell, const std::array<Interval, 2>& at)
  {
    Corner corner{cell, 0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
      if (!is_exactly(at[k], 0) && !is_exactly(at[k], 1)) return std::nullopt;
      corner[k + 1] = is_exactly(at[k], 1) ? 1 : 0;
    }
    return corner;
  }

  void unite_corners()
  {
    for (const Glued_sides& g : glued_)
      for (const int along : {0, 1}) corners_.unite(corner_of(g.a, along), corner_of(g.b, along));
    std::map<Corner, Member> first;
    for (std::size_t p = 0; p < work_.patches.size(); ++p)
      for (std::size_t v = 0; v < work_.patches[p].graph.vertices.size(); ++v) {
        const Member m{p, v};
        const std::array<Interval, 2> at = patch(m).local(v);
        const std::optional<Corner> corner = corner_at(patch(m).cell, at);
        if (!corner || patch(m).is_final[v] || !is_inner_corner({m, at[0]})) continue;
        const auto [known, is_new] = first.insert({corners_.find(*corner), m});
        if (!is_new) unite(m, known->second);
      }
  }

  /// Where the other side has no such zero, it has another factor: a component of it that is no arc ends there. No patch
  /// at all on the other side means that the equation was proved to have no zero there.
  void leave_unmatched(const Side_list& list, std::size_t other)
  {
    for (const On_side& v : list) {
      if (cells_.count(other) == 0 && !incident_[id(v.member)].empty())
        work_.undecided.push_back({v.member, "an arc ends where two pieces meet: their tangents agree within the tolerance only"});
      ends_here_.insert({id(v.member), 0});
    }
  }

  // ------------------------------------------------------------------------------------------------ classes

  void collect_classes()
  {
    std::map<std::size_t, std::size_t> class_of;
    for (std::size_t p = 0; p < work_.patches.size(); ++p)
      for (std::size_t v = 0; v < work_.patches[p].graph.vertices.size(); ++v) {
        const std::size_t root = find(first_[p] + v);
        const auto [at, is_new] = class_of.insert({root, work_.vertices.size()});
        if (is_new) work_.vertices.emplace_back();
        work_.vertices[at->second].members.push_back({p, v});
      }
    class_.resize(parent_.size());
    for (std::size_t i = 0; i < parent_.size(); ++i) class_[i] = class_of[find(i)];
  }

  std::size_t degree(const Patchwork_vertex& v) const
  {
    std::size_t n = 0;
    for (const Member& m : v.members) n += incident_[id(m)].size();
    return n;
  }

  /// On a side of its cell that is not glued.
  bool is_on_boundary(const Member& m) const
  {
    const std::array<Interval, 2> at = patch(m).local(m.vertex);
    for (std::size_t k = 0; k < 2; ++k)
      for (int end = 0; end < 2; ++end)
        if (is_exactly(at[k], end) && !is_glued({patch(m).cell, static_cast<int>(k), end})) return true;
    return false;
  }

  bool is_glued(const Glued_sides::Side& s) const { return partner_.count(key(s)) != 0; }

  void settle(Patchwork_vertex& v)
  {
    using Kind = Graph_vertex::Kind;
    bool is_open = false, is_boundary = false, is_crossing_point = false, is_isolated = false, is_corner = false, one_image = true, is_singular_pole = false;
    bool all_poles = true;
    char image = 0;
    for (const Member& m : v.members) {
      const Graph_vertex& g = vertex(m);
      is_open = is_open || g.kind == Kind::open;
      is_isolated = is_isolated || g.kind == Kind::isolated;
      is_corner = is_corner || patch(m).is_corner[m.vertex];
      if (const char other = patch(m).is_corner[m.vertex]) {
        one_image = one_image && other != 1 && (image == 0 || image == other);
        image = other;
      }
      v.is_final = v.is_final || patch(m).is_final[m.vertex];
      v.is_pole = v.is_pole || patch(m).is_pole[m.vertex];
      all_poles = all_poles && (patch(m).is_pole[m.vertex] || incident_[id(m)].empty());
      is_singular_pole = is_singular_pole || patch(m).is_pole[m.vertex] == 2;
      is_crossing_point = is_crossing_point || g.kind == Kind::node || g.kind == Kind::end;
      is_boundary = is_boundary || ends_here_.count(id(m)) != 0 || is_on_boundary(m);
    }
    const std::size_t n = degree(v);
    v.is_corner = is_corner;
    // Where the curves meet, their tangents may well look like a common one; and only some of the branches may go to infinity.
    v.is_pole = is_singular_pole || (v.is_pole && !is_crossing_point && (!is_corner || all_poles));
    if (v.is_final) v.kind = Kind::boundary;
    else if (n > 2 || (n == 2 && (is_crossing_point || !one_image))) v.kind = Kind::node;
    else if (v.is_pole) v.kind = Kind::mark;
    else if (n == 0 && is_isolated && !is_corner) v.kind = Kind::isolated;
    else if (n == 2 || n == 0) v.kind = Kind::crossing;
    else if (is_crossing_point) v.kind = Kind::end;
    else if (is_boundary) v.kind = Kind::boundary;
    else v.kind = Kind::open;
    if (v.kind == Kind::open && !is_open) work_.undecided.push_back({v.members[0], "an arc ends inside the domain"});
    if (v.kind == Kind::node) order_half_branches(v);
  }

  // ------------------------------------------------------------------------------------------- cyclic order

  /// A direction along a side, from a place on it.
  struct Ray {
    Key side{none, none, none};
    bool ascending = true;

    bool operator==(const Ray& other) const { return side == other.side && ascending == other.ascending; }
  };

  /// What one cell sees of a place: the half-branches counterclockwise between two rays.
  struct Sector {
    std::vector<Piece_ref> pieces;
    std::optional<Ray> from, to; ///< none where the place is inside the cell
  };

  void order_half_branches(Patchwork_vertex& v)
  {
    if (degree(v) <= 2) { // any order is cyclic
      for (const Member& m : v.members) v.half_branches.insert(v.half_branches.end(), incident_[id(m)].begin(), incident_[id(m)].end());
      return;
    }
    std::vector<Sector> sectors;
    std::vector<Member> axis;
    std::map<std::size_t, std::vector<Member>> corners; // by cell
    for (const Member& m : v.members) {
      if (patch(m).is_corner[m.vertex]) corners[patch(m).cell].push_back(m);
      else if (patch(m).chart.is_axis) axis.push_back(m);
      else add_sector(sector(m), sectors);
    }
    for (const auto& [cell, members] : corners) sectors.push_back(corner_sector(members));
    add_empty_sectors(v, sectors);
    if (!axis.empty()) return order_around_axis(v, axis);
    if (sectors.size() == 1) {
      v.half_branches = sectors[0].pieces;
      return;
    }
    walk(v, sectors);
  }

  /// Cells that have no branch at their corner there lie between those that have.
  void add_empty_sectors(const Patchwork_vertex& v, std::vector<Sector>& sectors) const
  {
    const Member& m = v.members[0];
    const std::optional<Corner> corner = corner_at(patch(m).cell, patch(m).local(m.vertex));
    if (!corner) return;
    for (const Corner& other : corners_.at_place_of(*corner)) {
      const bool is_known = std::any_of(v.members.begin(), v.members.end(), [&](const Member& x) { return patch(x).cell == other[0]; });
      if (!is_known) sectors.push_back(corner_rays(other[0], {static_cast<int>(other[1]), static_cast<int>(other[2])}));
    }
  }

  /// One cell may have the place as several vertices, of which at most one has branches.
  static void add_sector(Sector s, std::vector<Sector>& sectors)
  {
    for (Sector& known : sectors) {
      if (!s.from || !known.from || !(*s.from == *known.from) || (!s.pieces.empty() && !known.pieces.empty())) continue;
      known.pieces.insert(known.pieces.end(), s.pieces.begin(), s.pieces.end());
      return;
    }
    sectors.push_back(std::move(s));
  }

  /// Where a branch leaves a blown-up corner, counterclockwise from the side ρ = 0 as τ and ρ see it: the exceptional line by
  /// its ray (p, q), on which τ^q : ρ^p is constant, then the place on it.
  struct Departure {
    std::array<int, 2> ray{1, 1};
    int half = 0; ///< which of the two charts along that line
    double place = 0;

    bool operator<(const Departure& other) const
    {
      const int turn = ray[1] * other.ray[0] - ray[0] * other.ray[1]; // a greater q/p comes first
      if (turn != 0) return turn > 0;
      return half != other.half ? half < other.half : place < other.place;
    }
  };

  Departure departure(const Member& m) const
  {
    const Corner_chart& chart = patch(m).chart;
    Departure d;
    if (chart.is_axis) return {{1, 1}, 0, 1};
    for (std::size_t v = 0; v < 2; ++v) {
      const std::array<int, 2> ray = chart.ray(1 - v), other = chart.ray(v);
      if (!is_exactly(vertex(m).at[v], 0) || ray[0] == 0 || ray[1] == 0) continue;
      const bool first_half = other[1] * ray[0] > ray[1] * other[0]; // the chart's other line comes before this one
      const double x = midpoint(vertex(m).at[1 - v]);
      d = {ray, first_half ? 0 : 1, first_half ? x : -x};
    }
    return d;
  }

  /// All branches that leave a cell's blown-up corner.
  Sector corner_sector(std::vector<Member> members)
  {
    std::sort(members.begin(), members.end(), [&](const Member& a, const Member& b) { return departure(a) < departure(b); });
    Sector s = corner_rays(patch(members[0]).cell, patch(members[0]).chart.corner);
    for (const Member& m : members) s.pieces.insert(s.pieces.end(), incident_[id(m)].begin(), incident_[id(m)].end());
    const auto& corner = patch(members[0]).chart.corner;
    if (corner[0] != corner[1]) std::reverse(s.pieces.begin(), s.pieces.end());
    return s;
  }

  /// The sector of a cell at one of its corners, still without branches: counterclockwise from one side to the other.
  static Sector corner_rays(std::size_t cell, const std::array<int, 2>& end)
  {
    const auto ray = [&](std::size_t variable, bool ascending) { return Ray{Key{cell, variable, static_cast<std::size_t>(end[variable])}, ascending}; };
    const bool horizontal_first = end[0] == end[1];
    Sector s;
    s.from = horizontal_first ? ray(1, end[0] == 0) : ray(0, end[1] == 0);
    s.to = horizontal_first ? ray(0, end[1] == 0) : ray(1, end[0] == 0);
    return s;
  }

  void walk(Patchwork_vertex& v, const std::vector<Sector>& sectors)
  {
    std::vector<char> seen(sectors.size(), 0);
    std::size_t k = first_sector(sectors);
    bool forward = true;
    while (k != none) {
      seen[k] = 1;
      const Sector& s = sectors[k];
      if (forward) v.half_branches.insert(v.half_branches.end(), s.pieces.begin(), s.pieces.end());
      else v.half_branches.insert(v.half_branches.end(), s.pieces.rbegin(), s.pieces.rend());
      const std::optional<Ray> out = forward ? s.to : s.from;
      k = none;
      for (std::size_t next = 0; out && next < sectors.size() && k == none; ++next) {
        if (seen[next]) continue;
        for (const bool enters_forward : {true, false}) {
          const std::optional<Ray>& in = enters_forward ? sectors[next].from : sectors[next].to;
          if (!in || !are_one(*in, *out)) continue;
          k = next;
          forward = enters_forward;
          break;
        }
      }
    }
    if (v.half_branches.size() != degree(v)) work_.undecided.push_back({v.members[0], "the cyclic order of branches on a knot line"});
  }

  /// A sector with which a walk begins that is not closed: nothing leads into it.
  std::size_t first_sector(const std::vector<Sector>& sectors) const
  {
    for (std::size_t k = 0; k < sectors.size(); ++k) {
      if (!sectors[k].from) continue;
      bool has_neighbour = false;
      for (std::size_t other = 0; other < sectors.size(); ++other)
        for (const std::optional<Ray>& ray : {sectors[other].from, sectors[other].to})
          has_neighbour = has_neighbour || (other != k && ray && are_one(*ray, *sectors[k].from));
      if (!has_neighbour) return k;
    }
    return 0;
  }

  bool are_one(const Ray& a, const Ray& b) const
  {
    if (a == b) return a.side[1] >= 2; // a line between two charts
    const auto partner = partner_.find(a.side);
    return a.ascending == b.ascending && partner != partner_.end() && partner->second == b.side;
  }

  Sector sector(const Member& m)
  {
    const std::array<Interval, 2> at = patch(m).local(m.vertex);
    Sector s;
    s.pieces = ordered_pieces(m, at);
    std::array<int, 2> end{-1, -1};
    for (std::size_t k = 0; k < 2; ++k)
      for (int e = 0; e < 2; ++e)
        if (is_exactly(at[k], e)) end[k] = e;
    const std::size_t cell = patch(m).cell;
    const auto ray = [&](int variable, bool ascending) {
      return Ray{Key{cell, static_cast<std::size_t>(variable), static_cast<std::size_t>(end[static_cast<std::size_t>(variable)])}, ascending};
    };
    if (end[0] >= 0 && end[1] >= 0) {
      Sector corner = corner_rays(cell, end);
      corner.pieces = std::move(s.pieces);
      return corner;
    } else if (end[0] >= 0) {
      s.from = ray(0, end[0] == 1);
      s.to = ray(0, end[0] == 0);
    } else if (end[1] >= 0) {
      s.from = ray(1, end[1] == 0);
      s.to = ray(1, end[1] == 1);
    } else {
      add_seam_rays(m, s);
    }
    return s;
  }

  /// The sector of a chart at a place on a line that it shares with another one.
  void add_seam_rays(const Member& m, Sector& s) const
  {
    const Corner_chart& chart = patch(m).chart;
    if (chart.is_plain()) return;
    for (std::size_t v = 0; v < 2; ++v) {
      if (!is_exactly(vertex(m).at[v], 1)) continue;
      const std::array<int, 2> line = chart.ray(v);
      const Key key{patch(m).cell, 2 + static_cast<std::size_t>(line[0]), static_cast<std::size_t>(line[1])};
      const bool ascending_first = (v == 0) != chart.reverses();
      s.from = Ray{key, ascending_first};
      s.to = Ray{key, !ascending_first};
    }
  }

  /// Half-branches counterclockwise, as the local parameters see it.
  std::vector<Piece_ref> ordered_pieces(const Member& m, const std::array<Interval, 2>& at)
  {
    const Graph_vertex& g = vertex(m);
    std::vector<Piece_ref> pieces;
    for (const std::size_t k : g.half_branches)
      if (!patch(m).is_dropped(k)) pieces.push_back({m.patch, k});
    if (pieces.empty()) pieces = incident_[id(m)];
    else if (patch(m).chart.reverses()) std::reverse(pieces.begin(), pieces.end());
    if (g.half_branches.empty() && pieces.size() == 2) order_two(m, at, pieces);
    if (g.half_branches.empty() && pieces.size() > 2) work_.undecided.push_back({m, "the cyclic order of branches on a knot line"});
    return pieces;
  }

  /// An arc that touches a side from within: its two halves lie on both sides of the place, along that side.
  void order_two(const Member& m, const std::array<Interval, 2>& at, std::vector<Piece_ref>& pieces)
  {
    for (std::size_t k = 0; k < 2; ++k)
      for (int end = 0; end < 2; ++end) {
        if (!is_exactly(at[k], end)) continue;
        const Interval a = far_end(m, pieces[0])[1 - k], b = far_end(m, pieces[1])[1 - k];
        if (!(a.sup() < b.inf()) && !(b.sup() < a.inf())) continue;
        // Counterclockwise is ascending where the side is left or the top, else descending.
        const bool ascending = (k == 0) == (end == 0);
        if ((a.sup() < b.inf()) != ascending) std::swap(pieces[0], pieces[1]);
        return;
      }
    work_.undecided.push_back({m, "the cyclic order of branches on a knot line"});
  }

  std::array<Interval, 2> far_end(const Member& m, const Piece_ref& p) const
  {
    const Graph_piece& piece = work_.patches[p.patch].graph.pieces[p.piece];
    return work_.patches[p.patch].local(piece.from == m.vertex ? piece.to : piece.from);
  }

  /// A factor along the line between two charts meets the other factor: its two halves and the charts' branches take turns.
  void order_around_axis(Patchwork_vertex& v, const std::vector<Member>& axis)
  {
    std::vector<Piece_ref> outward, inward;
    for (const Member& m : axis)
      for (const Piece_ref& p : incident_[id(m)]) {
        const Graph_piece& piece = patch(m).graph.pieces[p.piece];
        const Interval there = patch(m).graph.vertices[piece.from == m.vertex ? piece.to : piece.from].at[1];
        (vertex(m).at[1].sup() < there.inf() ? outward : inward).push_back(p);
      }
    // Counterclockwise from the half that leads away from the corner: τ ≥ ρ, the other half, τ ≤ ρ.
    v.half_branches = outward;
    append_side(v, false);
    v.half_branches.insert(v.half_branches.end(), inward.begin(), inward.end());
    append_side(v, true);
    if (outward.size() > 1 || inward.size() > 1 || v.half_branches.size() != degree(v))
      work_.undecided.push_back({v.members[0], "the cyclic order of branches on an axis"});
  }

  void append_side(Patchwork_vertex& v, bool first) const
  {
    for (const Member& m : v.members)
      if (!patch(m).chart.is_axis && patch(m).chart.is_first_side() == first)
        v.half_branches.insert(v.half_branches.end(), incident_[id(m)].begin(), incident_[id(m)].end());
  }

  // --------------------------------------------------------------------------------------------------- arcs

  void join()
  {
    std::vector<Arc_link> links;
    std::vector<Piece_ref> piece_of;
    for (std::size_t p = 0; p < work_.patches.size(); ++p) {
      const auto& pieces = work_.patches[p].graph.pieces;
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (work_.patches[p].is_dropped(k)) continue;
        links.push_back({class_[first_[p] + pieces[k].from], class_[first_[p] + pieces[k].to]});
        piece_of.push_back({p, k});
      }
    }
    std::vector<char> through;
    for (const Patchwork_vertex& v : work_.vertices) through.push_back(v.kind == Graph_vertex::Kind::crossing);
    for (const Joined_arc& joined : join_links(links, through)) {
      Patchwork_arc arc;
      for (const auto& step : joined.steps) arc.steps.push_back({piece_of[step.link].patch, piece_of[step.link].piece, step.reversed});
      arc.closed = joined.closed;
      arc.source = joined.source;
      arc.target = joined.target;
      work_.arcs.push_back(std::move(arc));
    }
  }

  const std::vector<Glued_sides>& glued_;
  Patchwork work_;
  std::vector<std::size_t> first_, parent_, class_;
  std::vector<std::vector<Piece_ref>> incident_;
  std::map<std::size_t, int> cells_, ends_here_;
  std::map<Key, Key> partner_;
  std::map<Key, Side_list> sides_;
  std::map<Seam, Side_list> seams_;
  Corner_classes corners_;
};

} // namespace detail

/// Joins the zero sets of one equation over the cells of a domain across the glued sides. Vertices inside a cell stay;
/// on a glued side what arrives from both sides decides: two half-branches go on as one arc, none is an isolated
/// point, more are a node. Cost: O(n log n) in the vertices.
inline Patchwork join_patches(std::vector<Patch> patches, const std::vector<Glued_sides>& glued)
{
  return detail::Patch_joiner(std::move(patches), glued).run();
}

} // namespace locus

#endif
