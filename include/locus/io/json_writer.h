// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_WRITER_H
#define LOCUS_IO_JSON_WRITER_H

#include <locus/construct/locus.h>

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace locus {
namespace detail {

/// Writes JSON as it goes, without a tree: the largest part of a result, its samples, is only numbers. Objects keep the
/// order in which they are written.
class Json_writer {
public:
  explicit Json_writer(std::ostream& out) : out_(out) {}
  Json_writer(const Json_writer&) = delete;
  Json_writer& operator=(const Json_writer&) = delete;
  ~Json_writer() = default;

  Json_writer& open(char bracket)
  {
    separate();
    text_ += bracket;
    first_ = true;
    return *this;
  }
  Json_writer& close(char bracket)
  {
    text_ += bracket;
    first_ = false;
    if (text_.size() > (1u << 16)) flush();
    return *this;
  }
  Json_writer& key(std::string_view name)
  {
    separate();
    quote(name);
    text_ += ": ";
    first_ = true; // no comma between key and value
    return *this;
  }
  /// Starts a line of its own for the next key or element.
  Json_writer& line(int indent)
  {
    if (!first_) text_ += ',';
    first_ = true;
    text_ += '\n';
    text_.append(static_cast<std::size_t>(indent), ' ');
    return *this;
  }

  Json_writer& null()
  {
    separate();
    text_ += "null";
    return *this;
  }
  Json_writer& value(double x)
  {
    if (std::isnan(x)) throw std::logic_error("a result holds a number that is not a number");
    if (std::isinf(x)) return value(x > 0 ? "inf" : "-inf");
    separate();
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x == 0 ? 0.0 : x).ptr; // no "-0"
    text_.append(digits.data(), end);
    return *this;
  }
  template <std::integral Integer>
  Json_writer& value(Integer x)
  {
    separate();
    text_ += std::to_string(x);
    return *this;
  }
  Json_writer& value(bool x)
  {
    separate();
    text_ += x ? "true" : "false";
    return *this;
  }
  Json_writer& value(std::string_view x)
  {
    separate();
    quote(x);
    return *this;
  }
  Json_writer& value(const char* x) { return value(std::string_view(x)); }
  Json_writer& value(const Range& r) { return open('[').value(r.lo).value(r.hi).close(']'); }
  template <int Dim>
  Json_writer& value(const Approximate_point<Dim>& p)
  {
    return list(p.coordinates);
  }
  template <class Sequence>
  Json_writer& list(const Sequence& items)
  {
    open('[');
    for (const auto& x : items) value(x);
    return close(']');
  }

  /// Closes the outermost object, on a line of its own.
  void finish()
  {
    text_ += "\n}\n";
    flush();
    out_.flush();
  }

private:
  void separate()
  {
    if (!first_) text_ += ", ";
    first_ = false;
  }
  void quote(std::string_view s)
  {
    constexpr const char* hex = "0123456789abcdef";
    text_ += '"';
    for (const char c : s) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') (text_ += '\\') += c;
      else if (byte < 0x20) ((text_ += "\\u00") += hex[byte >> 4]) += hex[byte & 15];
      else text_ += c;
    }
    text_ += '"';
  }
  void flush()
  {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  std::ostream& out_;
  std::string text_;
  bool first_ = true;
};

/// A list with one element on a line.
template <class Sequence, class Write>
void write_lines(Json_writer& json, const char* key, const Sequence& items, Write write)
{
  json.line(2).key(key).open('[');
  for (const auto& item : items) write(json.line(4), item);
  json.close(']');
}

} // namespace detail
} // namespace locus

#endif
