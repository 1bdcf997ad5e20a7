// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_SITES_H
#define LOCUS_CONSTRUCT_SHEET_SITES_H

#include <locus/construct/sheet_cells.h>
#include <locus/construct/sheet_classes.h>
#include <locus/construct/sheet_grid.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace locus::detail {

/// All points that can be vertices: the corners of drawn cells, on joined sides those of both pieces. Points that are one and
/// the same on both sides form a class. Middles of cells are added one by one.
class Sheet_sites {
public:
  struct Entry {
    std::uint32_t piece;
    Sheet_unit at, along;
    std::uint32_t site;

    friend bool operator<(const Entry& a, const Entry& b)
    {
      return std::tie(a.piece, a.at, a.along) < std::tie(b.piece, b.at, b.along);
    }
  };
  using Entries = std::pair<std::vector<Entry>::const_iterator, std::vector<Entry>::const_iterator>;

  Sheet_sites(std::vector<Sheet_site> corners, const Sheet_grid& grid, std::size_t pieces, Sheet_unit full)
    : sites_(std::move(corners))
  {
    sort_sites();
    std::vector<Sheet_site> copies;
    for_each_joint(grid, pieces, [&](std::uint32_t a, std::uint32_t b, std::size_t k) {
      copy_side(a, full, b, 0, k, full, copies);
      copy_side(b, 0, a, full, k, full, copies);
    });
    sites_.insert(sites_.end(), copies.begin(), copies.end());
    sort_sites();
    Sheet_classes classes(sites_.size());
    for_each_joint(grid, pieces,
                   [&](std::uint32_t a, std::uint32_t b, std::size_t k) { unite(a, b, k, full, classes); });
    settle(classes);
  }

  const Sheet_site& operator[](std::uint32_t site) const { return sites_[site]; }
  /// The representative of a site's class; it has the best place of all.
  std::uint32_t same(std::uint32_t site) const { return same_[site]; }
  const Sheet_place& place(std::uint32_t site) const { return sites_[same_[site]].place; }

  std::uint32_t add(const Sheet_site& middle)
  {
    same_.push_back(static_cast<std::uint32_t>(sites_.size()));
    sites_.push_back(middle);
    return same_.back();
  }

  /// The corners on a closed part of a line, upwards.
  Entries on(std::uint32_t piece, const Sheet_line& line) const
  {
    const auto& all = lines_[line.k];
    return {std::lower_bound(all.begin(), all.end(), Entry{piece, line.at, line.lo, 0}),
            std::upper_bound(all.begin(), all.end(), Entry{piece, line.at, line.hi, 0})};
  }

private:
  template <class Visit>
  static void for_each_joint(const Sheet_grid& grid, std::size_t pieces, Visit visit)
  {
    for (std::uint32_t a = 0; a < pieces; ++a)
      for (std::size_t k = 0; k < 2; ++k)
        if (const auto b = grid.across(a, k, true)) visit(a, *b, k);
  }

  /// Each point once, with its best place; and the lists along the lines.
  void sort_sites()
  {
    const auto key = [](const Sheet_site& s) { return std::tie(s.piece, s.at[0], s.at[1]); };
    std::sort(sites_.begin(), sites_.end(), [&](const Sheet_site& a, const Sheet_site& b) {
      return key(a) != key(b) ? key(a) < key(b) : a.place.radius < b.place.radius;
    });
    const auto same_key = [&](const Sheet_site& a, const Sheet_site& b) { return key(a) == key(b); };
    sites_.erase(std::unique(sites_.begin(), sites_.end(), same_key), sites_.end());
    for (std::size_t k = 0; k < 2; ++k) {
      lines_[k].clear();
      for (std::uint32_t i = 0; i < sites_.size(); ++i)
        lines_[k].push_back({sites_[i].piece, sites_[i].at[k], sites_[i].at[1 - k], i});
      std::sort(lines_[k].begin(), lines_[k].end());
    }
  }

  void copy_side(std::uint32_t from, Sheet_unit from_at, std::uint32_t to, Sheet_unit to_at, std::size_t k,
                 Sheet_unit full, std::vector<Sheet_site>& copies) const
  {
    const Entries side = on(from, {k, from_at, 0, full});
    for (auto i = side.first; i != side.second; ++i) {
      Sheet_site copy;
      copy.piece = to;
      copy.at[k] = to_at;
      copy.at[1 - k] = i->along;
      copies.push_back(copy);
    }
  }

  void unite(std::uint32_t a, std::uint32_t b, std::size_t k, Sheet_unit full, Sheet_classes& classes) const
  {
    const Entries of_a = on(a, {k, full, 0, full}), of_b = on(b, {k, 0, 0, full});
    auto j = of_b.first;
    for (auto i = of_a.first; i != of_a.second; ++i) {
      while (j != of_b.second && j->along < i->along) ++j;
      if (j != of_b.second && j->along == i->along) classes.unite(i->site, j->site);
    }
  }

  void settle(Sheet_classes& classes)
  {
    same_.resize(sites_.size());
    for (std::uint32_t i = 0; i < sites_.size(); ++i) {
      same_[i] = classes.find(i);
      if (sites_[i].place.radius < sites_[same_[i]].place.radius) sites_[same_[i]].place = sites_[i].place;
    }
  }

  std::vector<Sheet_site> sites_;
  std::vector<std::uint32_t> same_;
  std::array<std::vector<Entry>, 2> lines_;
};

} // namespace locus::detail

#endif
