// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_JSON_TEXT_H
#define LOCUS_IO_JSON_TEXT_H

#include <locus/shape/invalid_input.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace locus {

/// Limits of a job's text. They keep a hostile or damaged file from taking the machine's memory or stack.
inline constexpr std::size_t max_json_bytes = std::size_t{64} << 20;
inline constexpr std::size_t max_json_values = 2'000'000;
inline constexpr std::size_t max_json_depth = 64;
inline constexpr std::size_t max_json_keys = 64;     ///< of one object
inline constexpr std::size_t max_json_number = 5000; ///< characters of one number

/// A value of a JSON document. Numbers keep the text of their digits, so that 0.1 can be read as 1/10; objects keep
/// their keys in order, each with the item of the same index.
struct Json_value {
  enum class Kind : unsigned char { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  bool truth = false;            ///< of a boolean
  std::string text;              ///< of a string or a number
  std::vector<Json_value> items; ///< of an array or an object
  std::vector<std::string> keys; ///< of an object

  const Json_value* find(std::string_view key) const
  {
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (keys[i] == key) return &items[i];
    return nullptr;
  }
};

constexpr const char* name_of(Json_value::Kind k)
{
  constexpr const char* names[] = {"null", "true or false", "a number", "a string", "a list", "an object"};
  return names[static_cast<std::size_t>(k)];
}

namespace detail {

/// Length of the valid UTF-8 sequence that starts at text[i], or 0.
inline std::size_t utf8_length(std::string_view text, std::size_t i)
{
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const unsigned lead = byte(i);
  const std::size_t n = lead < 0x80                   ? 1
                        : lead >= 0xC2 && lead < 0xE0 ? 2
                        : lead >= 0xE0 && lead < 0xF0 ? 3
                        : lead >= 0xF0 && lead < 0xF5 ? 4
                                                      : 0;
  for (std::size_t k = 1; k < n; ++k)
    if ((byte(i + k) & 0xC0) != 0x80) return 0;
  const bool overlong = (lead == 0xE0 && byte(i + 1) < 0xA0) || (lead == 0xF0 && byte(i + 1) < 0x90);
  const bool beyond = (lead == 0xED && byte(i + 1) >= 0xA0) || (lead == 0xF4 && byte(i + 1) >= 0x90);
  return overlong || beyond ? 0 : n;
}

} // namespace detail

/// Text of unknown origin made fit for a message: one line, valid UTF-8, at most about `limit` bytes.
inline std::string printable(std::string_view text, std::size_t limit = 60)
{
  std::string out;
  std::size_t i = 0;
  while (i < text.size() && out.size() < limit) {
    const std::size_t n = detail::utf8_length(text, i);
    const auto c = static_cast<unsigned char>(text[i]);
    const bool control =
      c < 0x20 || c == 0x7F || (n == 2 && c == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0);
    // U+2028 and U+2029 separate lines.
    const bool separator =
      n == 3 && text.substr(i, 2) == "\xE2\x80" && (static_cast<unsigned char>(text[i + 2]) & 0xFE) == 0xA8;
    if (n == 0) out += '?';
    else if (control || separator) out += ' ';
    else out += text.substr(i, n);
    i += n == 0 ? 1 : n;
  }
  if (i < text.size()) out += "…";
  return out;
}

namespace detail {

/// "line 3, column 7" of a byte of the text.
inline std::string line_and_column(std::string_view text, std::size_t offset)
{
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto start = before.rfind('\n');
  const std::size_t column = start == std::string_view::npos ? before.size() : before.size() - start - 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::size_t>(column, 1));
}

/// Builds the tree from the parser's events, and knows at every moment which value it is in.
class Json_builder {
public:
  // The parser converts numbers before it hands over their text, and refuses what is not finite. In long double that
  // leaves room for every exponent that parse_rational takes.
  using Json = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t, std::uint64_t, long double>;

  explicit Json_builder(std::string_view text) : text_(text) {}

  Json_value& result() { return root_; }

  bool null() { return add(Json_value::Kind::null), true; }
  bool boolean(bool truth) { return add(Json_value::Kind::boolean).truth = truth, true; }
  bool number_integer(std::int64_t x) { return add(Json_value::Kind::number).text = std::to_string(x), true; }
  bool number_unsigned(std::uint64_t x) { return add(Json_value::Kind::number).text = std::to_string(x), true; }
  bool number_float(long double, const std::string& digits)
  {
    require_short(digits);
    add(Json_value::Kind::number).text = digits;
    return true;
  }
  bool string(std::string& s) { return add(Json_value::Kind::string).text = std::move(s), true; }
  bool binary(Json::binary_t&) { throw std::logic_error("binary data in JSON text"); }

  bool start_object(std::size_t) { return open(Json_value::Kind::object), true; }
  bool start_array(std::size_t) { return open(Json_value::Kind::array), true; }
  bool end_object() { return open_.pop_back(), true; }
  bool end_array() { return open_.pop_back(), true; }

  bool key(std::string& name)
  {
    Json_value& object = *open_.back();
    if (object.find(name))
      throw Invalid_input(place_of_container(), "the key \"" + printable(name) + "\" is there twice",
                          "keep one of them");
    if (object.keys.size() == max_json_keys)
      throw Invalid_input(place_of_container(), "an object of more than " + std::to_string(max_json_keys) + " keys",
                          "use only the keys that `locus --help` lists");
    object.keys.push_back(std::move(name));
    return true;
  }

  bool parse_error(std::size_t offset, const std::string& token, const nlohmann::detail::exception& error)
  {
    if (error.id == 406) { // a number's overflow
      require_short(token);
      throw Invalid_input(place(), "the number " + printable(token, 40) + " is too large",
                          "use exponents between -4000 and 4000");
    }
    // "[json.exception…] parse error at line 1, column 2: syntax error while parsing value - the reason; last read: '…'"
    std::string_view reason = error.what();
    if (const auto at = reason.find("column "); at != std::string_view::npos)
      if (const auto colon = reason.find(": ", at); colon != std::string_view::npos) reason.remove_prefix(colon + 2);
    if (const auto dash = reason.find(" - "); dash != std::string_view::npos) reason.remove_prefix(dash + 3);
    std::string_view rest = reason;
    if (const auto read = reason.find("; last read: "); read != std::string_view::npos) {
      reason = reason.substr(0, read);
      rest.remove_prefix(read + std::strlen("; last read: "));
    } else {
      rest = {};
    }
    std::string rule = "not JSON at " + line_and_column(text_, offset) + ": " + printable(reason, 160);
    if (!rest.empty()) rule += ", read " + printable(rest, 60);
    throw Invalid_input(
      place(), rule,
      "mend the text there: keys and strings in double quotes, numbers as finite decimals or as strings like \"2/3\"");
  }

private:
  void require_short(const std::string& digits) const
  {
    if (digits.size() > max_json_number)
      throw Invalid_input(place(), "a number of " + std::to_string(digits.size()) + " characters",
                          "use at most " + std::to_string(max_json_number));
  }

  Json_value& add(Json_value::Kind kind)
  {
    if (++count_ > max_json_values)
      throw Invalid_input("", "more than " + std::to_string(max_json_values) + " values", "split the job");
    Json_value* value = &root_;
    if (!open_.empty()) value = &open_.back()->items.emplace_back();
    value->kind = kind;
    return *value;
  }
  void open(Json_value::Kind kind)
  {
    if (open_.size() == max_json_depth)
      throw Invalid_input(
        "", "values nested deeper than " + std::to_string(max_json_depth) + " levels at " + first_of_path(),
        "a job needs fewer than ten");
    // The parent's items do not move while this one is open.
    open_.push_back(&add(kind));
  }

  /// Place of the value that is read now, as in "inputs[1].curve.control_points[2]".
  std::string place() const { return path(open_.size()); }
  std::string place_of_container() const { return open_.empty() ? "" : path(open_.size() - 1); }
  std::string first_of_path() const { return path(4) + "…"; }
  std::string path(std::size_t depth) const
  {
    std::string out;
    for (std::size_t i = 0; i < depth; ++i) {
      const Json_value& v = *open_[i];
      // The last item is the one that is open, except in the innermost container: there the next is being read.
      const std::size_t index = i + 1 < open_.size() ? v.items.size() - 1 : v.items.size();
      if (v.kind == Json_value::Kind::array) {
        out += "[" + std::to_string(index) + "]";
      } else if (index < v.keys.size()) {
        if (!out.empty()) out += '.';
        out += printable(v.keys[index]);
      }
    }
    return out;
  }

  std::string_view text_;
  Json_value root_;
  std::vector<Json_value*> open_;
  std::size_t count_ = 0;
};

} // namespace detail

/// Reads JSON text. Throws Invalid_input, with the place, where it is no JSON, repeats a key or exceeds a limit.
inline Json_value parse_json(std::string_view text)
{
  if (text.size() > max_json_bytes)
    throw Invalid_input("", "longer than " + std::to_string(max_json_bytes >> 20) + " MiB", "split the job");
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw Invalid_input("", "the job is empty", "write a JSON object with \"compute\" and \"inputs\"");
  detail::Json_builder builder(text);
  if (!detail::Json_builder::Json::sax_parse(text.begin(), text.end(), &builder))
    throw std::logic_error("the JSON parser stopped without a reason");
  return std::move(builder.result());
}

/// Reads a stream to its end, at most one byte more than `parse_json` takes.
inline std::string read_json_text(std::istream& in)
{
  std::string text;
  std::array<char, 1 << 16> block;
  while (text.size() <= max_json_bytes && in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

} // namespace locus

#endif
