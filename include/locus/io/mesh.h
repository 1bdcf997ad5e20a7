// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_MESH_H
#define LOCUS_IO_MESH_H

#include <locus/construct/sheet.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace locus {

namespace detail {

/// Writes lines of numbers, with doubles that read back as the same doubles.
class Mesh_text {
public:
  explicit Mesh_text(std::ostream& out) : out_(out) {}
  Mesh_text(const Mesh_text&) = delete;
  Mesh_text& operator=(const Mesh_text&) = delete;
  ~Mesh_text() { flush(); }

  Mesh_text& word(std::string_view s)
  {
    if (!at_start_) text_ += ' ';
    text_ += s;
    at_start_ = false;
    return *this;
  }
  template <class Number>
  Mesh_text& number(Number x)
  {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
    return word(std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
  }
  template <class Sequence>
  Mesh_text& numbers(const Sequence& items)
  {
    for (const auto x : items) number(x);
    return *this;
  }
  Mesh_text& end_line()
  {
    text_ += '\n';
    at_start_ = true;
    if (text_.size() > (1u << 16)) flush();
    return *this;
  }
  Mesh_text& line(std::string_view s) { return word(s).end_line(); }

private:
  void flush()
  {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  std::ostream& out_;
  std::string text_;
  bool at_start_ = true;
};

struct Mesh_counts {
  std::size_t points = 0, triangles = 0, parameters = 0;

  explicit Mesh_counts(const std::vector<Sheet>& sheets)
  {
    for (const Sheet& s : sheets) {
      points += s.points.size();
      triangles += s.triangles.size();
      for (const auto& p : s.parameters) parameters = std::max(parameters, p.size());
    }
  }
};

/// A parameter of a vertex; zero where the vertex has fewer than others.
inline double parameter_of(const Sheet& s, std::size_t vertex, std::size_t k)
{
  return k < s.parameters[vertex].size() ? s.parameters[vertex][k] : 0;
}

/// All triangles, the vertices of all sheets counted through from `first` on.
template <class Write>
void for_each_triangle(const std::vector<Sheet>& sheets, std::size_t first, Write write)
{
  for (const Sheet& s : sheets) {
    for (const auto& t : s.triangles) write(std::array<std::size_t, 3>{first + t[0], first + t[1], first + t[2]});
    first += s.points.size();
  }
}

/// One scalar of each vertex in the legacy format of VTK.
template <class Value>
void write_vtk_scalars(Mesh_text& text, const std::vector<Sheet>& sheets, const std::string& name, const char* type,
                       Value value)
{
  text.word("SCALARS").word(name).word(type).number(1).end_line().line("LOOKUP_TABLE default");
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t v = 0; v < sheets[i].points.size(); ++v) text.number(value(i, v)).end_line();
}

/// Opens a file for `write`.
template <class Write>
void write_mesh_file(const std::string& path, Write write)
{
  std::ofstream out(path, std::ios::binary);
  if (out) write(out);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path);
}

} // namespace detail

/// Writes sheets as one PLY mesh in ASCII; each vertex has x y z radius, its parameters p0 p1 … and its sheet's number.
inline void write_ply(std::ostream& out, const std::vector<Sheet>& sheets)
{
  const detail::Mesh_counts counts(sheets);
  detail::Mesh_text text(out);
  text.line("ply").line("format ascii 1.0").word("element vertex").number(counts.points).end_line();
  for (const char* name : {"x", "y", "z", "radius"}) text.word("property double").word(name).end_line();
  for (std::size_t k = 0; k < counts.parameters; ++k) text.line("property double p" + std::to_string(k));
  text.line("property int sheet").word("element face").number(counts.triangles).end_line();
  text.line("property list uchar int vertex_indices").line("end_header");
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t v = 0; v < sheets[i].points.size(); ++v) {
      text.numbers(sheets[i].points[v].coordinates).number(sheets[i].radius[v]);
      for (std::size_t k = 0; k < counts.parameters; ++k) text.number(detail::parameter_of(sheets[i], v, k));
      text.number(i).end_line();
    }
  detail::for_each_triangle(sheets, 0, [&](const auto& t) { text.number(3).numbers(t).end_line(); });
}

/// Writes sheets as Wavefront OBJ, one object each.
inline void write_obj(std::ostream& out, const std::vector<Sheet>& sheets)
{
  detail::Mesh_text text(out);
  std::size_t first = 1;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    text.line("o sheet_" + std::to_string(i));
    for (const auto& p : sheets[i].points) text.word("v").numbers(p.coordinates).end_line();
    for (const auto& t : sheets[i].triangles)
      text.word("f").number(first + t[0]).number(first + t[1]).number(first + t[2]).end_line();
    first += sheets[i].points.size();
  }
}

/// Writes sheets as one mesh in the legacy ASCII format of VTK, with the radius, the sheet and the parameters of each point.
inline void write_vtk(std::ostream& out, const std::vector<Sheet>& sheets)
{
  const detail::Mesh_counts counts(sheets);
  detail::Mesh_text text(out);
  text.line("# vtk DataFile Version 3.0").line("sheets").line("ASCII").line("DATASET POLYDATA");
  text.word("POINTS").number(counts.points).word("double").end_line();
  for (const Sheet& s : sheets)
    for (const auto& p : s.points) text.numbers(p.coordinates).end_line();
  text.word("POLYGONS").number(counts.triangles).number(4 * counts.triangles).end_line();
  detail::for_each_triangle(sheets, 0, [&](const auto& t) { text.number(3).numbers(t).end_line(); });
  text.word("POINT_DATA").number(counts.points).end_line();
  detail::write_vtk_scalars(text, sheets, "radius", "double",
                            [&](std::size_t i, std::size_t v) { return sheets[i].radius[v]; });
  detail::write_vtk_scalars(text, sheets, "sheet", "int", [](std::size_t i, std::size_t) { return i; });
  for (std::size_t k = 0; k < counts.parameters; ++k)
    detail::write_vtk_scalars(text, sheets, "p" + std::to_string(k), "double",
                              [&](std::size_t i, std::size_t v) { return detail::parameter_of(sheets[i], v, k); });
}

/// The same into files. They throw std::runtime_error if the file cannot be written.
inline void write_ply(const std::string& path, const std::vector<Sheet>& sheets)
{
  detail::write_mesh_file(path, [&](std::ostream& out) { write_ply(out, sheets); });
}
inline void write_obj(const std::string& path, const std::vector<Sheet>& sheets)
{
  detail::write_mesh_file(path, [&](std::ostream& out) { write_obj(out, sheets); });
}
inline void write_vtk(const std::string& path, const std::vector<Sheet>& sheets)
{
  detail::write_mesh_file(path, [&](std::ostream& out) { write_vtk(out, sheets); });
}

} // namespace locus

#endif
