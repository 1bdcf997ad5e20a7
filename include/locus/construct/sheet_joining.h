// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_JOINING_H
#define LOCUS_CONSTRUCT_SHEET_JOINING_H

#include <locus/construct/sheet_classes.h>
#include <locus/construct/sheet_sites.h>
#include <locus/construct/sheet_triangles.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace locus::detail {

/// Joins triangles into sheets. A side i of triangle t is number 3t + i and runs from the triangle's corner of the same number
/// to the next. Only common edges join corners into vertices: where sheets or fans touch in a point, it is a vertex of each.
class Sheet_joining {
public:
  Sheet_joining(const std::vector<Sheet_triangle>& triangles, const Sheet_sites& sites)
    : triangles_(triangles), sites_(sites), partner_(3 * triangles.size(), none), vertices_(3 * triangles.size()),
      components_(triangles.size())
  {
    find_partners();
    for (std::uint32_t s = 0; s < partner_.size(); ++s) {
      if (partner_[s] == none) continue;
      vertices_.unite(s, next(partner_[s]));
      components_.unite(s / 3, partner_[s] / 3);
    }
  }

  static constexpr std::uint32_t none = ~std::uint32_t{0};
  static std::uint32_t next(std::uint32_t s) { return s % 3 == 2 ? s - 2 : s + 1; }

  bool is_free(std::uint32_t side) const { return partner_[side] == none; }
  std::uint32_t vertex(std::uint32_t corner) { return vertices_.find(corner); }
  std::uint32_t component(std::uint32_t triangle) { return components_.find(triangle); }

private:
  struct Edge {
    std::uint32_t low, high, side;
  };

  void find_partners()
  {
    std::vector<Edge> edges;
    edges.reserve(partner_.size());
    for (std::uint32_t s = 0; s < partner_.size(); ++s) {
      const std::uint32_t a = from(s), b = from(next(s));
      edges.push_back({std::min(a, b), std::max(a, b), s});
    }
    const auto key = [](const Edge& e) { return std::tie(e.low, e.high); };
    std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      while (j < edges.size() && key(edges[j]) == key(edges[i])) ++j;
      if (j == i + 2) join(edges[i].side, edges[i + 1].side);
      else if (j > i + 2) throw std::logic_error("rational_sheets: an edge of three triangles");
    }
  }

  void join(std::uint32_t s, std::uint32_t t)
  {
    if (from(s) == from(t)) throw std::logic_error("rational_sheets: triangles that turn against each other");
    partner_[s] = t;
    partner_[t] = s;
  }

  std::uint32_t from(std::uint32_t side) const { return sites_.same(triangles_[side / 3].site[side % 3]); }

  const std::vector<Sheet_triangle>& triangles_;
  const Sheet_sites& sites_;
  std::vector<std::uint32_t> partner_;
  Sheet_classes vertices_, components_;
};

} // namespace locus::detail

#endif
