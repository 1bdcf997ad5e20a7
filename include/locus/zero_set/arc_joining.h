// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_ARC_JOINING_H
#define LOCUS_ZERO_SET_ARC_JOINING_H

#include <cstddef>
#include <vector>

namespace locus {

/// A stretch of a curve between two vertices.
struct Arc_link {
  std::size_t from = 0, to = 0;
};

/// A maximal chain of links. A closed one has no end vertices; `source` and `target` are then where listing starts.
struct Joined_arc {
  struct Step {
    std::size_t link;
    bool reversed;
  };
  std::vector<Step> steps;
  bool closed = false;
  std::size_t source = 0, target = 0;
};

namespace detail {

class Link_joiner {
public:
  Link_joiner(const std::vector<Arc_link>& links, const std::vector<char>& runs_through)
    : links_(links), runs_through_(runs_through), at_(runs_through.size()), used_(links.size(), 0)
  {
    for (std::size_t k = 0; k < links.size(); ++k) {
      at_[links[k].from].push_back(k);
      at_[links[k].to].push_back(k);
    }
  }

  std::vector<Joined_arc> run()
  {
    std::vector<Joined_arc> arcs;
    for (std::size_t v = 0; v < at_.size(); ++v) {
      if (runs_through_[v]) continue;
      for (const std::size_t k : at_[v])
        if (!used_[k]) arcs.push_back(follow(k, v));
    }
    for (std::size_t k = 0; k < used_.size(); ++k)
      if (!used_[k]) arcs.push_back(follow(k, links_[k].from));
    return arcs;
  }

private:
  Joined_arc follow(std::size_t link, std::size_t start)
  {
    Joined_arc arc;
    std::size_t v = start;
    for (;;) {
      used_[link] = 1;
      const bool reversed = links_[link].from != v;
      arc.steps.push_back({link, reversed});
      v = reversed ? links_[link].from : links_[link].to;
      if (!runs_through_[v]) break;
      if (v == start) {
        arc.closed = true;
        break;
      }
      link = at_[v][0] == link ? at_[v][1] : at_[v][0];
    }
    arc.source = start;
    arc.target = v;
    return arc;
  }

  const std::vector<Arc_link>& links_;
  const std::vector<char>& runs_through_;
  std::vector<std::vector<std::size_t>> at_;
  std::vector<char> used_;
};

} // namespace detail

/// Chains links at the vertices that `runs_through` names; each of those must have exactly two link ends. Linear.
inline std::vector<Joined_arc> join_links(const std::vector<Arc_link>& links, const std::vector<char>& runs_through)
{
  return detail::Link_joiner(links, runs_through).run();
}

} // namespace locus

#endif
