// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CLI_READ_CERTIFICATE_H
#define LOCUS_CLI_READ_CERTIFICATE_H

// A certificate's text as the checker's plain data. No part of the proof: what is read wrongly here does not fit together
// there.

#include <locus/check/certificate.h>
#include <locus/io/json_text.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace locus_cli {

using locus::Integer;
using locus::Invalid_input;
using locus::Json_value;
using locus::Rational;
namespace check = locus::check;

class Certificate_reader {
public:
  explicit Certificate_reader(std::string_view text) : root_(locus::parse_json(text)) {}

  check::Certificate read() const
  {
    if (!root_.find("locus_certificate")) throw Invalid_input("", "no certificate", "give a file that --certificate wrote");
    if (count(get(root_, "locus_certificate")) != 1) throw Invalid_input("locus_certificate", "an unknown version", "use 1");
    check::Certificate c;
    const Json_value& seconds = get(root_, "solve_seconds");
    c.seconds = number(seconds).get_d();
    for (const Json_value& v : list(get(root_, "curves"))) c.curves.push_back(curve(v));
    for (const Json_value& v : list(get(root_, "empty_pairs"))) c.empty_pairs.push_back(pair(v));
    for (const Json_value& v : list(get(root_, "patches"))) c.patches.push_back(patch(v));
    for (const Json_value& v : list(get(root_, "lines"))) c.lines.push_back(line_patch(v));
    for (const Json_value& v : list(get(root_, "arcs"))) c.arcs.push_back(arc(v));
    for (const Json_value& v : list(get(root_, "undecided"))) c.undecided.push_back(text(v));
    for (const Json_value& v : list(get(root_, "unproved"))) c.unproved.push_back(text(v));
    return c;
  }

private:
  using Kind = Json_value::Kind;

  [[noreturn]] static void refuse(const std::string& what) { throw Invalid_input("", what, "use a file as --certificate wrote it"); }

  // -------------------------------------------------------------------------------------------------------- values

  static const Json_value& get(const Json_value& v, const char* key)
  {
    const Json_value* found = v.find(key);
    if (!found) refuse("the key \"" + std::string(key) + "\" is missing");
    return *found;
  }

  static const std::vector<Json_value>& list(const Json_value& v)
  {
    if (v.kind != Kind::array) refuse("a list is missing");
    return v.items;
  }

  static const std::string& text(const Json_value& v)
  {
    if (v.kind != Kind::string && v.kind != Kind::number) refuse("a number or a string is missing");
    return v.text;
  }

  static Rational number(const Json_value& v)
  {
    try {
      return locus::parse_rational(text(v));
    } catch (const std::invalid_argument& e) {
      refuse(e.what());
    }
  }

  static Integer integer(const Json_value& v)
  {
    const Rational x = number(v);
    if (x.get_den() != 1) refuse("a whole number is missing");
    return x.get_num();
  }

  static std::size_t count(const Json_value& v)
  {
    const Integer x = integer(v);
    if (x < 0 || x > std::numeric_limits<int>::max()) refuse("an index is missing");
    return x.get_ui();
  }

  static int small(const Json_value& v) { return static_cast<int>(count(v)); }

  static bool truth(const Json_value& v, const char* key)
  {
    const Json_value* found = v.find(key);
    return found && found->kind == Kind::boolean && found->truth;
  }

  template <class T, class Read>
  static std::vector<T> all(const Json_value& v, Read read)
  {
    std::vector<T> out;
    for (const Json_value& item : list(v)) out.push_back(read(item));
    return out;
  }

  template <std::size_t N>
  static const std::vector<Json_value>& exactly(const Json_value& v)
  {
    if (list(v).size() != N) refuse("a list of " + std::to_string(N) + " is missing");
    return v.items;
  }

  static std::array<std::size_t, 2> pair(const Json_value& v)
  {
    const auto& items = exactly<2>(v);
    return {count(items[0]), count(items[1])};
  }

  static check::Powers powers(const Json_value& v)
  {
    check::Powers f = all<Integer>(v, integer);
    check::trim(f);
    return f;
  }

  /// [lo, hi], or [x] for an exact value.
  static check::Range range(const Json_value& v)
  {
    const auto& items = list(v);
    if (items.empty() || items.size() > 2) refuse("a range is missing");
    return {number(items[0]), number(items.back())};
  }

  static std::optional<Rational> end(const Json_value& v, const char* infinity)
  {
    if (v.kind == Kind::string && v.text == infinity) return std::nullopt;
    return number(v);
  }

  // -------------------------------------------------------------------------------------------------------- inputs

  static check::Curve curve(const Json_value& v)
  {
    check::Curve c;
    c.input = input(get(get(v, "input"), "curve"));
    for (const Json_value& p : list(get(v, "pieces"))) {
      check::Piece piece;
      const auto& ends = exactly<2>(get(p, "range"));
      piece.lo = end(ends[0], "-inf");
      piece.hi = end(ends[1], "inf");
      constexpr const char* names[] = {"x", "y", "w"};
      for (std::size_t k = 0; k < 3; ++k) piece.point[k] = powers(get(p, names[k]));
      const auto& tangent = exactly<2>(get(p, "tangent"));
      for (std::size_t k = 0; k < 2; ++k) piece.tangent[k] = powers(tangent[k]);
      c.pieces.push_back(std::move(piece));
    }
    for (const Json_value& j : list(get(v, "joints"))) c.joints.push_back(joint(text(j)));
    return c;
  }

  static check::Joint joint(const std::string& name)
  {
    if (name == "smooth") return check::Joint::smooth;
    if (name == "tolerance") return check::Joint::tolerance;
    if (name != "corner") refuse("an unknown kind of joint");
    return check::Joint::corner;
  }

  static check::Input input(const Json_value& v)
  {
    check::Input in;
    in.closed = truth(v, "closed");
    if (const Json_value* form = v.find("monomial")) {
      in.is_monomial = true;
      in.power[0] = all<Rational>(get(*form, "x"), number);
      in.power[1] = all<Rational>(get(*form, "y"), number);
      in.power[2] = form->find("w") ? all<Rational>(get(*form, "w"), number) : std::vector<Rational>{Rational(1)};
      const auto& ends = exactly<2>(get(v, "domain"));
      in.lo = end(ends[0], "-inf");
      in.hi = end(ends[1], "inf");
      return in;
    }
    in.degree = small(get(v, "degree"));
    for (const Json_value& p : list(get(v, "control_points"))) {
      const auto& xy = exactly<2>(p);
      in.points.push_back({number(xy[0]), number(xy[1])});
    }
    if (const Json_value* w = v.find("weights")) in.weights = all<Rational>(*w, number);
    if (const Json_value* u = v.find("knots")) in.knots = all<Rational>(*u, number);
    return in;
  }

  // ------------------------------------------------------------------------------------------------------- patches

  static check::Patch patch(const Json_value& v)
  {
    check::Patch p;
    p.pair = pair(get(v, "pair"));
    if (const Json_value* c = v.find("chart")) p.chart = chart(*c);
    p.factor = {check::Powers{Integer(1)}, check::Powers{Integer(1)}};
    p.vanishes = truth(v, "vanishes");
    if (p.vanishes) return p;
    constexpr const char* factors[] = {"factor_t", "factor_r"};
    for (std::size_t k = 0; k < 2; ++k)
      if (const Json_value* f = v.find(factors[k])) {
        p.factor[k] = powers(get(*f, "coefficients"));
        p.degenerate[k] = truth(*f, "degenerate");
      }
    if (const Json_value* lines = v.find("lines"))
      for (const Json_value& l : list(*lines)) p.lines.push_back({line(l), small(get(l, "power"))});
    p.equation = table(get(v, "equation"));
    for (const Json_value& t : list(get(v, "cells"))) p.cells.push_back(token(text(t)));
    if (const Json_value* s = v.find("singular")) p.singular = all<check::Singular>(*s, singular);
    p.vertices = all<check::Vertex>(get(v, "vertices"), vertex);
    read_pieces(v, p);
    return p;
  }

  static void read_pieces(const Json_value& v, check::Patch& p)
  {
    for (const Json_value& piece : list(get(v, "pieces"))) {
      const auto& items = exactly<3>(piece);
      p.pieces.push_back({count(items[0]), count(items[1]), count(items[2]), false});
    }
    if (const Json_value* dropped = v.find("dropped"))
      for (const Json_value& k : list(*dropped)) p.pieces.at(index(k, p.pieces.size())).dropped = true;
    if (const Json_value* diagonal = v.find("diagonal"))
      for (const Json_value& point : list(*diagonal)) p.diagonal.push_back({range(get(point, "at")), count(get(point, "vertex"))});
  }

  static std::size_t index(const Json_value& v, std::size_t size)
  {
    const std::size_t k = count(v);
    if (k >= size) refuse("an index is too great");
    return k;
  }

  static check::Chart chart(const Json_value& v)
  {
    check::Chart c;
    c.is_plain = false;
    const auto& corner = exactly<2>(get(v, "corner"));
    const auto& rows = exactly<2>(get(v, "exponents"));
    for (std::size_t k = 0; k < 2; ++k) {
      c.corner[k] = small(corner[k]);
      if (c.corner[k] > 1) refuse("a corner is 0 or 1");
      for (std::size_t i = 0; i < 2; ++i) c.exponent[k][i] = small(exactly<2>(rows[k])[i]);
    }
    return c;
  }

  static check::Line line(const Json_value& v) { return {truth(v, "reversed"), number(get(v, "ratio"))}; }

  static check::Table table(const Json_value& v)
  {
    const auto& degrees = exactly<2>(get(v, "degrees"));
    constexpr int greatest = 10000;
    const int n = small(degrees[0]), m = small(degrees[1]);
    if (n > greatest || m > greatest) refuse("an equation's degree is too great");
    const auto& c = list(get(v, "coefficients"));
    if (c.size() != check::cast(n + 1) * check::cast(m + 1)) refuse("an equation has too few or too many coefficients");
    check::Table t(n, m);
    t.c = all<Integer>(get(v, "coefficients"), integer);
    return t;
  }

  /// "0 1/2": cut along a variable; "e+", "g1-", "s0", "o", "u": leaves.
  static check::Token token(const std::string& s)
  {
    using Token_kind = check::Token::Kind;
    check::Token t;
    const auto sign = [](char c) { return c == '+' ? 1 : c == '-' ? -1 : 0; };
    const bool has_variable = s.size() > 1 && (s[0] == 'g' ? s[1] == '0' || s[1] == '1' : s[0] == '0' || s[0] == '1');
    if (s.size() > 2 && has_variable && s[1] == ' ') {
      t.variable = s[0] - '0';
      t.at = locus::parse_rational(std::string_view(s).substr(2));
    } else if (s.size() == 2 && s[0] == 'e' && sign(s[1]) != 0) {
      t.kind = Token_kind::empty;
      t.sign = sign(s[1]);
    } else if (s.size() == 3 && s[0] == 'g' && has_variable && sign(s[2]) != 0) {
      t.kind = Token_kind::graph;
      t.variable = s[1] - '0';
      t.sign = sign(s[2]);
    } else if (s.size() > 1 && s.size() < 9 && s[0] == 's' && s.find_first_not_of("0123456789", 1) == std::string::npos) {
      t.kind = Token_kind::singular;
      t.index = std::stoul(s.substr(1));
    } else if (s == "o" || s == "u") {
      t.kind = s == "o" ? Token_kind::outside : Token_kind::undecided;
    } else {
      refuse("an unknown cell \"" + locus::printable(s) + "\"");
    }
    return t;
  }

  static std::array<check::Range, 2> ranges(const Json_value& v)
  {
    const auto& at = exactly<2>(v);
    return {range(at[0]), range(at[1])};
  }

  static check::Singular singular(const Json_value& v)
  {
    check::Singular s;
    s.at = ranges(get(v, "at"));
    if (const Json_value* axis = v.find("axis")) s.axis = line(*axis);
    const Json_value* a = v.find("algebraic");
    if (!a) return s;
    s.algebraic.emplace();
    s.algebraic->m = powers(get(*a, "m"));
    s.algebraic->lo = s.at[0].lo;
    s.algebraic->hi = s.at[0].hi;
    s.algebraic->r_lo = s.at[1].lo;
    s.algebraic->r_hi = s.at[1].hi;
    for (const Json_value& f : list(get(*a, "h"))) s.algebraic->h.push_back(all<Rational>(f, number));
    return s;
  }

  static check::Vertex vertex(const Json_value& v)
  {
    check::Vertex x;
    const std::string& kind = text(get(v, "kind"));
    constexpr std::array<const char*, 7> names{"crossing", "boundary", "isolated", "node", "end", "mark", "open"};
    std::size_t k = 0;
    while (k < names.size() && kind != names[k]) ++k;
    if (k == names.size()) refuse("an unknown kind of vertex");
    x.kind = static_cast<check::Vertex_kind>(k);
    x.at = ranges(get(v, "at"));
    if (const Json_value* cell = v.find("cell")) x.cell = count(*cell);
    x.stops = truth(v, "stops");
    return x;
  }

  // ------------------------------------------------------------------------------------------------- lines and arcs

  static check::Line_patch line_patch(const Json_value& v)
  {
    check::Line_patch l;
    l.pair = pair(get(v, "pair"));
    l.line = line(v);
    if (const Json_value* corner = v.find("corner")) {
      const auto& ends = exactly<2>(*corner);
      l.corner.emplace(std::array<int, 2>{small(ends[0]), small(ends[1])});
    }
    for (const Json_value& x : list(get(v, "vertices"))) {
      l.vertices.push_back(range(get(x, "at")));
      l.stops.push_back(truth(x, "stops"));
      l.meets.emplace_back();
      const Json_value* meets = x.find("meets");
      if (!meets) continue;
      if (l.corner) l.meets.back().emplace(std::array<std::size_t, 2>{0, 0});
      else l.meets.back() = pair(*meets);
    }
    l.dropped.assign(l.vertices.empty() ? 0 : l.vertices.size() - 1, 0);
    if (const Json_value* dropped = v.find("dropped"))
      for (const Json_value& k : list(*dropped)) l.dropped[index(k, l.dropped.size())] = 1;
    return l;
  }

  static check::Arc arc(const Json_value& v)
  {
    check::Arc a;
    a.closed = truth(v, "closed");
    for (const Json_value& s : list(get(v, "steps"))) {
      const auto& items = exactly<3>(s);
      a.steps.push_back({count(items[0]), count(items[1]), count(items[2]) != 0});
    }
    return a;
  }

  Json_value root_;
};

/// Reads a certificate. Throws Invalid_input for text that is none.
inline check::Certificate read_certificate(std::string_view text) { return Certificate_reader(text).read(); }

} // namespace locus_cli

#endif
