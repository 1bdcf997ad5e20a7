// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_RATIONAL_H
#define LOCUS_IO_JSON_RATIONAL_H

#include <locus/io/json_writer.h>

namespace locus {
namespace detail {

/// An end of a range as a fraction, or "inf".
inline void write_end(Json_writer& json, const Rational& x, bool infinite, const char* infinity)
{
  if (infinite) json.value(infinity);
  else json.value(x.get_str());
}

inline void write_range(Json_writer& json, const Piece& range)
{
  json.open('[');
  write_end(json, range.lo, range.lo_infinite, "-inf");
  write_end(json, range.hi, range.hi_infinite, "inf");
  json.close(']');
}

/// Coefficients in rows, the first index running with the first parameter.
template <int K, class Write>
void write_rows(Json_writer& json, const Degrees<K>& degrees, Write write)
{
  const auto row = static_cast<std::size_t>(degrees.back()) + 1;
  const std::size_t count = coefficient_count(degrees);
  if (K > 1) json.open('[');
  for (std::size_t i = 0; i < count; ++i) {
    if (i % row == 0) json.open('[');
    write(i);
    if (i % row == row - 1) json.close(']');
  }
  if (K > 1) json.close(']');
}

/// The intervals of a piece that belong to the locus: rational ends as fractions, others as the doubles next to them, with all
/// ends' enclosures.
inline void write_kept(Json_writer& json, const std::vector<Kept_interval>& kept, std::size_t piece)
{
  json.key("intervals").open('[');
  const auto each = [&](auto write) {
    for (const Kept_interval& k : kept)
      if (k.piece == piece) write(k);
  };
  each([&](const Kept_interval& k) {
    json.open('[');
    for (std::size_t e = 0; e < 2; ++e) {
      const Range& r = k.ends[e];
      if (std::isinf(r.lo) && r.lo == r.hi) json.value(r.lo < 0 ? "-inf" : "inf");
      else if (k.exact[e]) json.value(k.exact[e]->get_str());
      else json.value(r.lo + 0.5 * (r.hi - r.lo));
    }
    json.close(']');
  });
  json.close(']').key("enclosures").open('[');
  each([&](const Kept_interval& k) { json.open('[').value(k.ends[0]).value(k.ends[1]).close(']'); });
  json.close(']');
}

/// A piece by control points and weights. Where a weight is 0 the control point is at infinity, and its numerators are given.
/// `kept`, if given, has what survives trimming, for all pieces.
template <int Dim, int K>
void write_map_piece(Json_writer& json, const Rational_map_piece<Dim, K>& piece, const std::vector<Kept_interval>* kept = nullptr, std::size_t index = 0)
{
  json.open('{').key("domain").open('[');
  for (const Piece& range : piece.range) write_range(json, range);
  json.close(']').key("degrees").list(piece.degrees()).key("control_points");
  write_rows<K>(json, piece.degrees(), [&](std::size_t i) {
    json.open('[');
    for (const auto& f : piece.numerator)
      json.value((piece.weight[i] == 0 ? f[i] : Rational(f[i] / piece.weight[i])).get_str());
    json.close(']');
  });
  json.key("weights");
  write_rows<K>(json, piece.degrees(), [&](std::size_t i) { json.value(piece.weight[i].get_str()); });
  if (kept) {
    write_kept(json, *kept, index);
  } else {
    json.key("intervals").open('[');
    if (K > 1) json.open('[');
    for (const Piece& range : piece.range) write_range(json, range);
    if (K > 1) json.close(']');
    json.close(']');
  }
  json.close('}');
}

inline void write_outline(Json_writer& json, const Cell_outline& outline)
{
  json.line(2).key("cell").open('{').key("input").value(outline.input).key("bounded").value(outline.bounded).key("arcs").list(outline.arcs);
  json.key("reversed").open('[');
  for (const char r : outline.reversed) json.value(r != 0);
  json.close(']').close('}');
}

inline void write_sheet(Json_writer& json, const Sheet& sheet)
{
  json.open('{').key("euler").value(sheet.euler).key("error").value(sheet.error).key("boundary").open('[');
  for (const Sheet_boundary& b : sheet.boundary) json.line(6).open('{').key("kind").value(b.kind).key("loop").list(b.loop).close('}');
  json.close(']').line(5).key("points").open('[');
  for (const auto& p : sheet.points) json.value(p);
  json.close(']').line(5).key("parameters").open('[');
  for (const auto& p : sheet.parameters) json.list(p);
  json.close(']').line(5).key("radius").list(sheet.radius).line(5).key("triangles").open('[');
  for (const auto& t : sheet.triangles) json.list(t);
  json.close(']').close('}');
}

/// The keys `sheets`, in space, and `rational`, where there is an exact curve or surface.
template <int Dim>
void write_surface(Json_writer& json, const Locus<Dim>& locus)
{
  if (Dim == 3) write_lines(json, "sheets", locus.sheets(), write_sheet);
  if (locus.outline()) write_outline(json, *locus.outline());
  if (!locus.events().empty() || !locus.segments().empty()) {
    write_lines(json, "events", locus.events(), [](Json_writer& j, const Locus_event& e) {
      j.open('{').key("kind").value(e.kind).key("input").value(e.input).key("parameter").value(e.parameter);
      j.key("multiplicity").value(e.multiplicity).close('}');
    });
    write_lines(json, "segments", locus.segments(), [](Json_writer& j, const Locus_segment& s) {
      j.open('{').key("input").value(s.input).key("parameters").value(s.parameters).key("active").value(s.active).close('}');
    });
  }
  const auto* const kept = locus.kept_intervals() ? &*locus.kept_intervals() : nullptr;
  std::size_t index = 0;
  if (locus.rational_curve())
    write_lines(json, "rational", locus.rational_curve()->pieces(), [&](Json_writer& j, const auto& piece) { write_map_piece(j, piece, kept, index++); });
  else if (locus.rational_surface())
    write_lines(json, "rational", locus.rational_surface()->pieces(), [](Json_writer& j, const auto& piece) { write_map_piece(j, piece); });
}

} // namespace detail
} // namespace locus

#endif
