// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_WRITER_H
#define LOCUS_CONSTRUCT_SHEET_WRITER_H

#include <locus/construct/sheet.h>
#include <locus/construct/sheet_cells.h>
#include <locus/construct/sheet_ends.h>
#include <locus/construct/sheet_joining.h>
#include <locus/construct/sheet_options.h>
#include <locus/construct/sheet_sites.h>
#include <locus/construct/sheet_triangles.h>
#include <locus/number/interval.h>
#include <locus/shape/rational_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace locus::detail {

/// The values of a piece's own variables at a place of its unit square.
class Sheet_parameters {
public:
  explicit Sheet_parameters(const std::vector<Rational_map_piece<3, 2>>& pieces)
  {
    for (const auto& p : pieces) ends_.push_back({ends_of(p.range[0]), ends_of(p.range[1])});
  }

  std::vector<double> at(std::size_t piece, double u, double v) const
  {
    return {value(ends_[piece][0], u), value(ends_[piece][1], v)};
  }

private:
  static Range ends_of(const Piece& p)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {p.lo_infinite ? -infinity : nearest_double(p.lo), p.hi_infinite ? infinity : nearest_double(p.hi)};
  }
  static double value(const Range& r, double s)
  {
    if (std::isinf(r.hi)) return r.lo / (1 - s);
    if (std::isinf(r.lo)) return s == 0 ? r.lo : r.hi / s;
    return s == 0 ? r.lo : s == 1 ? r.hi : r.lo * (1 - s) + r.hi * s;
  }

  std::vector<std::array<Range, 2>> ends_;
};

/// Writes the joined triangles down as sheets.
class Sheet_writer {
public:
  Sheet_writer(const std::vector<Rational_map_piece<3, 2>>& pieces, const Sheet_options& options,
               const Sheet_cells& cells, const Sheet_sites& sites, const std::vector<Sheet_triangle>& triangles)
    : options_(options), cells_(cells), sites_(sites), triangles_(triangles), parameters_(pieces),
      joining_(triangles, sites), number_(3 * triangles.size(), Sheet_joining::none)
  {
  }

  std::vector<Sheet> write(const Sheet_ends& ends)
  {
    std::vector<Sheet> sheets;
    std::vector<std::uint32_t> sheet_of(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const std::uint32_t first = joining_.component(t);
      if (first == t) {
        sheet_of[t] = static_cast<std::uint32_t>(sheets.size());
        sheets.emplace_back();
      }
      sheet_of[t] = sheet_of[first];
      add_triangle(sheets[sheet_of[t]], t);
    }
    add_boundaries(sheets, sheet_of, ends);
    return sheets;
  }

private:
  void add_triangle(Sheet& sheet, std::uint32_t t)
  {
    std::array<std::size_t, 3> corners{};
    double rounding = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      corners[i] = vertex(sheet, 3 * t + i);
      rounding = std::max(rounding, sites_.place(triangles_[t].site[i]).radius);
    }
    sheet.triangles.push_back(corners);
    const double sum = cells_.leaves[triangles_[t].leaf].error + rounding;
    sheet.error = std::max(sheet.error, std::nextafter(sum, std::numeric_limits<double>::infinity()));
  }

  std::size_t vertex(Sheet& sheet, std::uint32_t corner)
  {
    std::uint32_t& number = number_[joining_.vertex(corner)];
    if (number == Sheet_joining::none) {
      number = static_cast<std::uint32_t>(sheet.points.size());
      add_point(sheet, triangles_[corner / 3].site[corner % 3]);
    }
    return number;
  }

  void add_point(Sheet& sheet, std::uint32_t site)
  {
    const Sheet_site& s = sites_[site];
    const double full = cells_.full_size();
    const double u = s.at[0] / full, v = s.at[1] / full;
    const Approximate_point<3>& p = sites_.place(site).at;
    Vertex_description d =
      options_.describe ? options_.describe(s.piece, u, v, p) : Vertex_description{parameters_.at(s.piece, u, v), 0};
    sheet.points.push_back(p);
    sheet.parameters.push_back(std::move(d.parameters));
    sheet.radius.push_back(d.radius);
  }

  /// Around each vertex lies one fan, so each vertex of a boundary starts one free side.
  void add_boundaries(std::vector<Sheet>& sheets, const std::vector<std::uint32_t>& sheet_of, const Sheet_ends& ends)
  {
    std::vector<std::uint32_t> side_from(number_.size(), Sheet_joining::none);
    std::vector<std::size_t> free_sides(sheets.size(), 0);
    for (std::uint32_t s = 0; s < number_.size(); ++s)
      if (joining_.is_free(s)) {
        side_from[joining_.vertex(s)] = s;
        ++free_sides[sheet_of[s / 3]];
      }
    for (std::uint32_t s = 0; s < number_.size(); ++s)
      if (joining_.is_free(s) && side_from[joining_.vertex(s)] != Sheet_joining::none)
        sheets[sheet_of[s / 3]].boundary.push_back(loop_from(s, side_from, ends));
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      const std::size_t edges = (3 * sheets[i].triangles.size() + free_sides[i]) / 2;
      sheets[i].euler =
        static_cast<int>(static_cast<std::ptrdiff_t>(sheets[i].points.size() + sheets[i].triangles.size()) -
                         static_cast<std::ptrdiff_t>(edges));
    }
  }

  Sheet_boundary loop_from(std::uint32_t side, std::vector<std::uint32_t>& side_from, const Sheet_ends& ends)
  {
    Sheet_boundary boundary;
    Sheet_end end = Sheet_end::domain;
    for (std::uint32_t v = joining_.vertex(side); side_from[v] != Sheet_joining::none;) {
      const std::uint32_t s = side_from[v];
      side_from[v] = Sheet_joining::none;
      boundary.loop.push_back(number_[v]);
      const Sheet_triangle& t = triangles_[s / 3];
      end = std::max(
        end, ends.across(cells_.leaves[t.leaf], sites_[t.site[s % 3]], sites_[t.site[Sheet_joining::next(s) % 3]]));
      v = joining_.vertex(Sheet_joining::next(s));
    }
    boundary.kind = name_of(end);
    return boundary;
  }

  const Sheet_options& options_;
  const Sheet_cells& cells_;
  const Sheet_sites& sites_;
  const std::vector<Sheet_triangle>& triangles_;
  Sheet_parameters parameters_;
  Sheet_joining joining_;
  std::vector<std::uint32_t> number_; ///< in its sheet, of each class of corners
};

} // namespace locus::detail

#endif
