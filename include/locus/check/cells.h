// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_CELLS_H
#define LOCUS_CHECK_CELLS_H

#include <locus/check/critical.h>

#include <map>
#include <string>

namespace locus {
namespace check {

inline constexpr std::size_t none = static_cast<std::size_t>(-1);

/// What one patch's cells prove: follows the tree of cells, verifies what is claimed of each from its own Bernstein
/// coefficients, derives the pieces of the zero set in it, and compares them with those listed.
class Patch_check {
public:
  Patch_check(const Certificate& all, std::size_t index)
    : patch_(all.patches[index]), pair_(all.curve(0).pieces[patch_.pair[0]], all.curve(1).pieces[patch_.pair[1]]),
      where_("patch " + std::to_string(index)), is_self_(all.is_self() && patch_.pair[0] == patch_.pair[1])
  {
  }

  void run()
  {
    if (!pair_.has_equation(patch_)) refuse("its equation is not that of its pieces");
    check_factors();
    if (patch_.vanishes) return;
    index_vertices();
    descend(bernstein(patch_.equation), {{{Rational(0), Rational(1)}, {Rational(0), Rational(1)}}});
    if (next_ != patch_.cells.size()) refuse("cells are left over");
    compare_pieces();
    check_vertices();
    if (is_self_ && patch_.chart.is_plain) check_diagonal();
  }

  std::size_t leaves = 0, undecided = 0, singular = 0;

private:
  static constexpr std::array<int, 2> ends{0, 1};

  [[noreturn]] void refuse(const std::string& what) const { throw Refused(where_ + ": " + what); }
  [[noreturn]] void refuse(std::size_t cell, const std::string& what) const { refuse("cell " + std::to_string(cell) + ": " + what); }

  const Vertex& vertex(std::size_t v) const { return patch_.vertices[v]; }

  // ------------------------------------------------------------------------------------------------------- factors

  void check_factors() const
  {
    for (std::size_t v = 0; v < 2; ++v) {
      if (patch_.factor[v].empty()) refuse("a factor is zero");
      if (has_root(patch_.factor[v]) != patch_.degenerate[v]) refuse("a factor's zeros are not as they are said to be");
    }
    for (const Divided_line& l : patch_.lines)
      if (l.power < 1 || l.line.ratio <= 0) refuse("a line that was divided out is none");
  }

  /// On the closed unit interval.
  static bool has_root(const Powers& f)
  {
    if (f.size() == 1) return false;
    const Powers c = on_half_line(bernstein(in_variable(f, 0)).c);
    if (c.front() == 0 || c.back() == 0) return true;
    return variations(c) > 0 && Sturm_chain(c).positive() > 0;
  }

  // ------------------------------------------------------------------------------------------------------ vertices

  void index_vertices()
  {
    seen_.assign(patch_.vertices.size(), 0);
    for (std::size_t v = 0; v < patch_.vertices.size(); ++v) {
      if (vertex(v).cell) continue;
      for (int fixed = 0; fixed < 2; ++fixed)
        if (vertex(v).at[cast(fixed)].is_exact()) on_line_[{fixed, vertex(v).at[cast(fixed)].lo}].push_back(v);
    }
    for (auto& [line, list] : on_line_) {
      const std::size_t along = cast(1 - line.first);
      std::sort(list.begin(), list.end(), [&](std::size_t a, std::size_t b) { return vertex(a).at[along].lo < vertex(b).at[along].lo; });
    }
  }

  /// The zeros on one side of a cell, all of them listed as vertices: at its ends, and inside in order; and the polynomial's
  /// signs between them.
  struct Side {
    bool vanishes = false;
    std::array<std::size_t, 2> corner{none, none};
    std::vector<std::size_t> inner;
    std::vector<int> gaps;
  };

  Side side(std::size_t cell, const Table& f, const Box& box, int variable, int end)
  {
    Powers c = on_half_line(side_of(f, variable, end));
    const std::size_t along = cast(1 - variable);
    const Rational &lo = box[along][0], &hi = box[along][1];
    Side s = vertices_on(cell, variable, box[cast(variable)][cast(end)], lo, hi, along);
    trim(c);
    s.vanishes = c.empty();
    const bool high_zero = c.size() != cast(f.count(1 - variable)), low_zero = s.vanishes || c.front() == 0;
    if (low_zero != (s.corner[0] != none) || high_zero != (s.corner[1] != none)) refuse(cell, "a zero at a corner is not listed, or none is there");
    if (s.vanishes) return s;
    const std::size_t size = cast(f.count(1 - variable)) - 1;
    const Powers whole = c; // of degree `size`, if zeros at the high end are put back
    while (c.front() == 0) c.erase(c.begin());
    isolate(cell, s, c, whole, size, lo, hi, along);
    return s;
  }

  Side vertices_on(std::size_t cell, int variable, const Rational& at, const Rational& lo, const Rational& hi, std::size_t along)
  {
    Side s;
    const auto list = on_line_.find({variable, at});
    if (list == on_line_.end()) return s;
    for (const std::size_t v : list->second) {
      const Range& x = vertex(v).at[along];
      if (x.hi < lo || x.lo > hi || (!x.is_exact() && (x.hi == lo || x.lo == hi))) continue;
      if (x.lo < lo || x.hi > hi) refuse(cell, "the range of vertex " + std::to_string(v) + " reaches over a corner");
      seen_[v] = 1;
      if (x.is_exact() && x.lo == lo) s.corner[0] = v;
      else if (x.is_exact() && x.lo == hi) s.corner[1] = v;
      else s.inner.push_back(v);
    }
    return s;
  }

  /// Proves that a side's zeros between its ends are just the listed ones, each in its range. `c` has no zero at 0 and ∞.
  void isolate(std::size_t cell, Side& s, const Powers& c, const Powers& whole, std::size_t size, const Rational& lo, const Rational& hi,
               std::size_t along) const
  {
    const Rational width = hi - lo;
    const auto sign = [&](const Rational& x) { return sign_on_side(whole, size, Rational((x - lo) / width)); };
    s.gaps.assign(s.inner.size() + 1, sgn(c.front()));
    const std::size_t bound = variations(c);
    for (std::size_t k = 0; k < s.inner.size(); ++k) {
      const Range& x = vertex(s.inner[k]).at[along];
      if (k > 0 && vertex(s.inner[k - 1]).at[along].hi > x.lo) refuse(cell, "ranges of vertices on a side overlap");
      if (x.is_exact()) {
        if (sign(x.lo) != 0) refuse(cell, "vertex " + std::to_string(s.inner[k]) + " is no zero");
      } else {
        const int below = x.lo == lo ? sgn(c.front()) : sign(x.lo), above = x.hi == hi ? sgn(c.back()) : sign(x.hi);
        if (below == 0 || above == 0 || (below == above && roots_in(c, x, lo, hi) != 1))
          refuse(cell, "vertex " + std::to_string(s.inner[k]) + " has no zero in its range");
      }
      s.gaps[k + 1] = k + 1 == s.inner.size() ? sgn(c.back()) : sign(between(x, vertex(s.inner[k + 1]).at[along]));
      if (s.gaps[k + 1] == 0) refuse(cell, "a zero on a side lies outside its range");
    }
    if (bound > s.inner.size() && Sturm_chain(c).positive() != s.inner.size()) refuse(cell, "a zero on a side is not listed");
    if (bound < s.inner.size()) refuse(cell, "a side has fewer zeros than listed");
  }

  static Rational between(const Range& a, const Range& b) { return (a.hi + b.lo) / 2; }

  /// Sign of Σ c_i s^i (1-s)^(size-i).
  static int sign_on_side(const Powers& c, std::size_t size, const Rational& s)
  {
    if (s == 1) return c.size() == size + 1 ? sgn(c.back()) : 0;
    return sgn(homogeneous_value(c, s.get_num(), s.get_den() - s.get_num()));
  }

  static std::size_t roots_in(const Powers& c, const Range& x, const Rational& lo, const Rational& hi)
  {
    const Rational a = (x.lo - lo) / (hi - x.lo);
    return x.hi == hi ? Sturm_chain(c).positive() - (a == 0 ? 0 : roots_between(c, 0, a)) : roots_between(c, a, Rational((x.hi - lo) / (hi - x.hi)));
  }

  // --------------------------------------------------------------------------------------------------------- cells

  /// Each cell comes before its parts; f is its Bernstein form.
  void descend(Table f, const Box& box, int depth = 0)
  {
    constexpr int most = 1000; // cuts of one cell; no solve comes near
    if (depth > most) refuse("the tree of cells is too deep");
    const std::size_t cell = next_++;
    if (cell >= patch_.cells.size()) refuse("the tree of cells breaks off");
    const Token& t = patch_.cells[cell];
    if (t.kind != Token::Kind::split) return leaf(cell, t, f, box);
    const std::size_t v = cast(t.variable);
    if (!(box[v][0] < t.at && t.at < box[v][1])) refuse(cell, "its cut lies outside it");
    const Rational part = (t.at - box[v][0]) / (box[v][1] - box[v][0]);
    Table high = cut(f, t.variable, part.get_num(), part.get_den());
    Box low_box = box, high_box = box;
    low_box[v][1] = high_box[v][0] = t.at;
    descend(std::move(f), low_box, depth + 1);
    descend(std::move(high), high_box, depth + 1);
  }

  void leaf(std::size_t cell, const Token& t, const Table& f, const Box& box)
  {
    ++leaves;
    switch (t.kind) {
    case Token::Kind::empty: return check_empty(cell, t.sign, f, box);
    case Token::Kind::graph: return trace(cell, t, f, box);
    case Token::Kind::singular: return check_singular(cell, t.index, f, box);
    case Token::Kind::outside:
      if (!is_self_ || !patch_.chart.is_plain || box[0][1] > box[1][0]) refuse(cell, "is left out though it belongs to the domain");
      open_.push_back(box);
      return;
    case Token::Kind::undecided:
    case Token::Kind::split: break;
    }
    ++undecided;
    open_.push_back(box);
  }

  /// One strict sign, or zeros at corners only, where both neighbours have the sign: those corners are vertices.
  void check_empty(std::size_t cell, int sign, const Table& f, const Box& box)
  {
    std::size_t zeros = 0;
    for (const Integer& c : f.c) {
      if (sgn(c) == -sign) refuse(cell, "is not empty");
      zeros += c == 0;
    }
    if (zeros == 0) return;
    for (const int a : ends)
      for (const int b : ends) {
        const int n = f.degree[0], m = f.degree[1], i = a * n, j = b * m;
        if (n == 0 || m == 0 || f.at(i, j) != 0) continue;
        --zeros;
        if (f.at(a ? n - 1 : 1, j) == 0 || f.at(i, b ? m - 1 : 1) == 0) refuse(cell, "is not empty beside a corner");
        if (!has_vertex_at(box[0][cast(a)], box[1][cast(b)])) refuse(cell, "a zero at its corner is not listed");
      }
    if (zeros != 0) refuse(cell, "is not empty");
  }

  bool has_vertex_at(const Rational& x, const Rational& y)
  {
    const auto list = on_line_.find({0, x});
    if (list == on_line_.end()) return false;
    for (const std::size_t v : list->second)
      if (vertex(v).at[1].is_exact() && vertex(v).at[1].lo == y) {
        seen_[v] = 1;
        return true;
      }
    return false;
  }

  /// In a cell where F is strictly monotone in one variable, the zero set lies over those values of the other one where F
  /// has opposite signs on the two sides: between the zeros on these sides.
  void trace(std::size_t cell, const Token& t, const Table& f, const Box& box)
  {
    if (t.sign == 0 || slope_sign(f, t.variable) != t.sign) refuse(cell, "its derivative has no strict sign");
    const int base = 1 - t.variable;
    const Side low = side(cell, f, box, t.variable, 0), high = side(cell, f, box, t.variable, 1);
    const Side left = side(cell, f, box, base, 0), right = side(cell, f, box, base, 1);
    if (low.vanishes || high.vanishes) return add_piece(cell, base, (low.vanishes ? low : high).corner[0], (low.vanishes ? low : high).corner[1]);
    std::size_t i = 0, j = 0;
    const auto is_inside = [&] { return low.gaps[i] == -t.sign && high.gaps[j] == t.sign; };
    std::size_t from = is_inside() ? only_zero(cell, left) : none;
    while (i < low.inner.size() || j < high.inner.size()) {
      const bool was_inside = is_inside(), is_low = next_is_low(cell, low, i, high, j, cast(base));
      const std::size_t v = is_low ? low.inner[i++] : high.inner[j++];
      if (was_inside) add_piece(cell, base, from, v);
      from = v;
    }
    if (is_inside()) add_piece(cell, base, from, only_zero(cell, right));
  }

  std::size_t only_zero(std::size_t cell, const Side& s) const
  {
    const std::size_t n = s.inner.size() + (s.corner[0] != none) + (s.corner[1] != none);
    if (n != 1) refuse(cell, "the zero set leaves it where no vertex is");
    return !s.inner.empty() ? s.inner[0] : s.corner[0] != none ? s.corner[0] : s.corner[1];
  }

  bool next_is_low(std::size_t cell, const Side& low, std::size_t i, const Side& high, std::size_t j, std::size_t base) const
  {
    if (i == low.inner.size() || j == high.inner.size()) return i < low.inner.size();
    const Range &a = vertex(low.inner[i]).at[base], &b = vertex(high.inner[j]).at[base];
    if (a.hi < b.lo || b.hi < a.lo) return a.hi < b.lo;
    refuse(cell, "zeros on opposite sides are not told apart");
  }

  /// A piece over a range of the base, cut at the marks that lie on it.
  void add_piece(std::size_t cell, int base, std::size_t from, std::size_t to)
  {
    const std::size_t b = cast(base);
    std::vector<std::size_t> marks;
    for (std::size_t v = 0; v < patch_.vertices.size(); ++v)
      if (vertex(v).kind == Vertex_kind::mark && vertex(v).cell == cell && vertex(from).at[b].hi < vertex(v).at[b].lo &&
          vertex(v).at[b].hi < vertex(to).at[b].lo)
        marks.push_back(v);
    std::sort(marks.begin(), marks.end(), [&](std::size_t x, std::size_t y) { return vertex(x).at[b].lo < vertex(y).at[b].lo; });
    marks.push_back(to);
    for (const std::size_t v : marks) {
      if (v != to) seen_[v] = 1;
      if (v != to && !(vertex(from).at[b].hi < vertex(v).at[b].lo)) refuse(cell, "marks are not told apart");
      found_.push_back({cell, from, v});
      from = v;
    }
  }

  // ------------------------------------------------------------------------------------------------ singular cells

  void check_singular(std::size_t cell, std::size_t number, const Table& f, const Box& box)
  {
    ++singular;
    if (number >= patch_.singular.size()) refuse(cell, "names no singular point");
    const Singular& s = patch_.singular[number];
    if (const std::string reason = Singular_check(pair_, patch_).refusal(s); !reason.empty()) refuse(cell, reason);
    Box wide = box;
    std::array<int, 2> face{-1, -1};
    for (std::size_t v = 0; v < 2; ++v) {
      if (s.at[v].is_exact() && (s.at[v].lo == 0 || s.at[v].lo == 1) && (s.at[v].lo == box[v][0] || s.at[v].lo == box[v][1])) {
        face[v] = s.at[v].lo == 0 ? 0 : 1;
        const Rational width = box[v][1] - box[v][0];
        if (face[v] == 0) wide[v][0] -= width;
        else wide[v][1] += width;
      } else if (!(box[v][0] < s.at[v].lo && s.at[v].hi < box[v][1])) {
        refuse(cell, "its singular point is not proved to lie in it");
      }
    }
    const Table g = face[0] >= 0 || face[1] >= 0 ? bernstein_on(patch_.equation, wide) : f;
    const int index = index_of_only_critical_point(cell, s, f, g, wide, face);
    if (static_cast<int>(boundary_zeros(cell, g)) != 2 * (1 - index)) refuse(cell, "its boundary has not as many zeros as branches can leave its point");
    add_half_branches(cell, s, f, box, face);
  }

  /// Proves that the point is the only critical one of the box, and that no other zero lies on the unit square's sides there.
  /// 2(1 - index) branches leave such a point.
  int index_of_only_critical_point(std::size_t cell, const Singular& s, const Table& f, const Table& g, const Box& wide, const std::array<int, 2>& face)
  {
    const Table ft = differences(g, 0), fr = differences(g, 1);
    const Table second[3] = {differences(ft, 0), differences(ft, 1), differences(fr, 1)};
    int index = index_by_dominance(second, g.degree);
    for (std::size_t v = 0; v < 2; ++v)
      if (face[v] >= 0 && strict_sign(second[v == 0 ? 2 : 0].c) == 0) index = 0;
    if (index != 0) return index;
    if (!s.algebraic) refuse(cell, "the singular point is not proved to be the only critical point");
    if (!critical_) critical_.emplace(patch_.equation);
    if (!critical_->is_only_one(*s.algebraic, wide)) refuse(cell, "the singular point is not the only critical point");
    for (int v = 0; v < 2; ++v)
      if (face[cast(v)] >= 0 && zeros_on(side_of(f, v, face[cast(v)])) != 1) refuse(cell, "another zero lies beside its point on the boundary");
    const auto turns = critical_->index(wide);
    if (!turns) refuse(cell, "its gradient's index is not found");
    return *turns;
  }

  /// Different zeros on the closed unit interval of Bernstein coefficients that are not all zero.
  static std::size_t zeros_on(const Powers& coefficients)
  {
    Powers c = on_half_line(coefficients);
    trim(c);
    std::size_t n = c.size() != coefficients.size();
    n += c.front() == 0;
    while (c.front() == 0) c.erase(c.begin());
    return n + (variations(c) > 1 ? Sturm_chain(c).positive() : variations(c));
  }

  struct Bounds {
    Integer lo, hi;
    Bounds(const Table& f, int factor) : lo(f.c[0]), hi(f.c[0])
    {
      for (const Integer& c : f.c) {
        if (c < lo) lo = c;
        if (c > hi) hi = c;
      }
      lo *= factor;
      hi *= factor;
    }
    Bounds(Integer l, Integer h) : lo(std::move(l)), hi(std::move(h)) {}

    Bounds times(const Integer& x) const { return x >= 0 ? Bounds(lo * x, hi * x) : Bounds(hi * x, lo * x); }
    Bounds plus(const Bounds& b) const { return {lo + b.lo, hi + b.hi}; }
    Integer least_size() const { return lo > 0 ? lo : hi < 0 ? Integer(-hi) : Integer(0); }
    Integer greatest_size() const { return std::max(Integer(abs(lo)), Integer(abs(hi))); }
    Integer middle() const { return lo + hi; } ///< twice
  };

  /// Where the Hessian, after one constant preconditioner, is strictly diagonally dominant on the whole box, the gradient
  /// vanishes once at most: with index 1 where the determinant is positive, -1 where it is negative. Else 0.
  static int index_by_dominance(const Table (&second)[3], const std::array<int, 2>& n)
  {
    const Bounds a(second[0], n[0] * (n[0] - 1)), b(second[1], n[0] * n[1]), d(second[2], n[1] * (n[1] - 1));
    const Integer ma = a.middle(), mb = b.middle(), md = d.middle();
    const auto row_is_dominant = [&](const Integer& y0, const Integer& y1, bool first) {
      const Bounds x = a.times(y0).plus(b.times(y1)), y = b.times(y0).plus(d.times(y1));
      return (first ? x : y).least_size() > (first ? y : x).greatest_size();
    };
    if (!row_is_dominant(md, -mb, true) || !row_is_dominant(-mb, ma, false)) return 0;
    // With dominance the determinant has no zero: its sign in the middle is its sign.
    return cmp(Integer(ma * md), Integer(mb * mb)) > 0 ? 1 : -1;
  }

  /// Zeros on the boundary of a Bernstein form's square, each with a change of sign.
  std::size_t boundary_zeros(std::size_t cell, const Table& g) const
  {
    std::size_t zeros = 0;
    std::vector<int> signs; // around, beside the corners
    for (const auto& [variable, end, forward] : {std::array<int, 3>{1, 0, 1}, {0, 1, 1}, {1, 1, 0}, {0, 0, 0}}) {
      Powers c = on_half_line(side_of(g, variable, end));
      if (!forward) std::reverse(c.begin(), c.end());
      trim(c);
      if (c.empty()) refuse(cell, "its boundary carries a component");
      zeros += c.size() != cast(g.count(1 - variable)); // the corner at which the side ends
      while (c.front() == 0) c.erase(c.begin());
      const std::size_t bound = variations(c);
      if (bound > 1) {
        const Sturm_chain chain(c);
        if (!chain.has_simple_roots_only()) refuse(cell, "its boundary is touched");
        zeros += chain.positive();
      } else {
        zeros += bound;
      }
      signs.push_back(sgn(c.front()));
      signs.push_back(sgn(c.back()));
    }
    for (std::size_t k = 1; k < 8; k += 2) { // a zero at a corner counts as one zero, if the sign changes there
      const bool is_zero = corner_is_zero(g, k / 2);
      if (is_zero != (signs[k] != signs[(k + 1) % 8])) refuse(cell, "its boundary is touched at a corner");
    }
    return zeros;
  }

  /// Corners counterclockwise, from (1, 0) on.
  static bool corner_is_zero(const Table& g, std::size_t k)
  {
    return g.at(k == 0 || k == 1 ? g.degree[0] : 0, k == 1 || k == 2 ? g.degree[1] : 0) == 0;
  }

  /// A half-branch leads from the point to each zero on the cell's boundary inside the unit square.
  void add_half_branches(std::size_t cell, const Singular& s, const Table& f, const Box& box, const std::array<int, 2>& face)
  {
    std::size_t point = none;
    for (std::size_t v = 0; v < patch_.vertices.size(); ++v)
      if (vertex(v).cell == cell && vertex(v).kind != Vertex_kind::mark) point = v;
    if (point == none) refuse(cell, "its singular point is no vertex");
    for (std::size_t v = 0; v < 2; ++v)
      if (vertex(point).at[v].lo > s.at[v].lo || vertex(point).at[v].hi < s.at[v].hi) refuse(cell, "its singular point is not where its vertex is");
    seen_[point] = 1;
    std::vector<std::size_t> around;
    for (int v = 0; v < 2; ++v)
      for (const int end : ends) {
        if (face[cast(v)] == end) continue;
        const Side zeros = side(cell, f, box, v, end);
        around.insert(around.end(), zeros.inner.begin(), zeros.inner.end());
        for (const std::size_t c : zeros.corner)
          if (c != none) around.push_back(c);
      }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const std::size_t v : around) found_.push_back({cell, point, v});
  }

  // ------------------------------------------------------------------------------------------------------- results

  using Found = std::array<std::size_t, 3>; ///< cell, from, to

  void compare_pieces()
  {
    std::vector<Found> listed;
    for (const Patch_piece& p : patch_.pieces) listed.push_back({p.cell, p.from, p.to});
    std::sort(listed.begin(), listed.end());
    std::sort(found_.begin(), found_.end());
    for (std::size_t k = 0; k < std::max(listed.size(), found_.size()); ++k) {
      if (k < listed.size() && k < found_.size() && listed[k] == found_[k]) continue;
      const bool missing = k == listed.size() || (k < found_.size() && found_[k] < listed[k]);
      const Found& p = missing ? found_[k] : listed[k];
      refuse(p[0], "a piece from vertex " + std::to_string(p[1]) + " to vertex " + std::to_string(p[2]) + (missing ? " is missing" : " is not there"));
    }
  }

  bool is_near_open(const Vertex& v) const
  {
    return std::any_of(open_.begin(), open_.end(), [&](const Box& b) {
      return v.at[0].hi >= b[0][0] && v.at[0].lo <= b[0][1] && v.at[1].hi >= b[1][0] && v.at[1].lo <= b[1][1];
    });
  }

  static bool is_on_boundary(const Vertex& v)
  {
    return std::any_of(v.at.begin(), v.at.end(), [](const Range& x) { return x.is_exact() && (x.lo == 0 || x.lo == 1); });
  }

  void check_vertices() const
  {
    std::vector<int> degree(patch_.vertices.size(), 0);
    for (const Patch_piece& p : patch_.pieces) ++degree[p.from], ++degree[p.to];
    for (std::size_t v = 0; v < degree.size(); ++v) {
      if (!seen_[v]) refuse("vertex " + std::to_string(v) + " lies in no cell that has it");
      if (!has_right_degree(vertex(v), degree[v]))
        refuse("vertex " + std::to_string(v) + " has " + std::to_string(degree[v]) + " branches, which is not what its kind has");
    }
  }

  /// Where arcs stop in the midst of the zero set, at exact parameters.
  bool is_pole(const Vertex& v) const
  {
    return patch_.chart.is_plain && v.at[0].is_exact() && v.at[1].is_exact() && pair_.is_infinite_at(v.at[0].lo, v.at[1].lo);
  }

  bool has_right_degree(const Vertex& v, int degree) const
  {
    switch (v.kind) {
    case Vertex_kind::crossing: return !v.cell && degree == 2 && (!v.stops || is_pole(v));
    case Vertex_kind::boundary: return !v.cell && is_on_boundary(v) && degree > 0 && (degree != 2 || v.stops);
    case Vertex_kind::isolated: return degree == 0 && (v.cell || is_on_boundary(v));
    case Vertex_kind::node: return v.cell && degree > 1;
    case Vertex_kind::end: return v.cell && degree == 1 && is_on_boundary(v);
    case Vertex_kind::mark: return v.cell && degree == 2;
    case Vertex_kind::open: return !v.cell && degree != 2 && is_near_open(v);
    }
    return false;
  }

  // ------------------------------------------------------------------------------------- a piece with itself

  /// All zeros on the diagonal are vertices; so no piece crosses it, and each dropped one lies beyond it as a whole.
  void check_diagonal() const
  {
    check_roots_on_line(Line(), patch_.diagonal);
    for (const Patch_piece& p : patch_.pieces) {
      int side = 0;
      for (const std::size_t v : {p.from, p.to})
        side = vertex(v).at[0].lo > vertex(v).at[1].hi ? 1 : vertex(v).at[0].hi < vertex(v).at[1].lo ? -1 : side;
      if (side == 0) refuse(p.cell, "a piece is not proved to lie on one side of the diagonal");
      if ((side < 0) != p.dropped) refuse(p.cell, "a piece on the wrong side of the diagonal is kept or dropped");
    }
  }

public:
  /// The equation's roots along a line, from a value of t on, are the listed ones, each at the vertex that is named with it.
  void check_roots_on_line(const Line& line, const std::vector<Line_point>& points, const Rational& from = 0) const
  {
    const Powers f = along(line);
    if (f.empty()) refuse("the equation vanishes along a line");
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Range& t = points[k].at;
      if (k > 0 && points[k - 1].at.hi >= t.lo) refuse("zeros along a line are not told apart");
      if (t.is_exact() ? sign_at(f, t.lo) != 0 : sign_at(f, t.lo) * sign_at(f, t.hi) == 0 || roots_between(f, t.lo, t.hi) != 1)
        refuse("a zero along a line is not in its range");
      if (!is_at(line, points[k])) refuse("vertex " + std::to_string(points[k].vertex) + " is not the zero along a line that it is said to be");
    }
    const Powers part = on_line(f, from.get_num(), from.get_den() - from.get_num(), from.get_den());
    if (zeros_on(bernstein(in_variable(part, 0)).c) != points.size()) refuse("a zero along a line is not listed");
  }

private:
  /// The equation on a line, as a polynomial in t times a positive one.
  Powers along(const Line& line) const
  {
    const Table f = line.reversed ? mirrored(patch_.equation, 1) : patch_.equation;
    const Integer &p = line.ratio.get_num(), &q = line.ratio.get_den(); // r = pt/(q + (p - q)t)
    const Powers top{Integer(0), p}, bottom{q, Integer(p - q)};
    std::vector<Powers> bottoms{{Integer(1)}};
    for (int j = 0; j < f.degree[1]; ++j) bottoms.push_back(product(bottoms.back(), bottom));
    Powers total, tops{Integer(1)};
    for (int j = 0; j <= f.degree[1]; ++j) {
      Powers row;
      for (int i = 0; i <= f.degree[0]; ++i) row.push_back(f.at(i, j));
      total = sum(total, product(row, product(tops, bottoms[cast(f.degree[1] - j)])));
      tops = product(tops, top);
    }
    trim(total);
    return total;
  }

  /// The place of a root along a line lies in a mark's range, or is a vertex with that exact place.
  bool is_at(const Line& line, const Line_point& point) const
  {
    if (point.vertex >= patch_.vertices.size()) return false;
    const Vertex& v = vertex(point.vertex);
    Range r{partner_of(line, point.at.lo), partner_of(line, point.at.hi)};
    if (r.lo > r.hi) std::swap(r.lo, r.hi);
    const Range* const place[2] = {&point.at, &r};
    for (std::size_t k = 0; k < 2; ++k)
      if (place[k]->lo < v.at[k].lo || place[k]->hi > v.at[k].hi) return false;
    return v.kind == Vertex_kind::mark ? is_inside_cell(v) : point.at.is_exact();
  }

  /// A mark's range lies in its cell, found again by the tree.
  bool is_inside_cell(const Vertex& v) const
  {
    Box box{{{Rational(0), Rational(1)}, {Rational(0), Rational(1)}}};
    std::size_t at = 0;
    while (at != *v.cell) {
      if (at >= patch_.cells.size() || patch_.cells[at].kind != Token::Kind::split) return false;
      const Token& t = patch_.cells[at];
      const std::size_t variable = cast(t.variable), high = end_of_cell(at + 1);
      const bool is_low = *v.cell < high;
      box[variable][is_low ? 1 : 0] = t.at;
      at = is_low ? at + 1 : high;
    }
    for (std::size_t k = 0; k < 2; ++k)
      if (v.at[k].lo < box[k][0] || v.at[k].hi > box[k][1]) return false;
    return true;
  }

  /// The number behind a cell's last part.
  std::size_t end_of_cell(std::size_t at) const
  {
    for (std::size_t open = 1; open > 0; ++at) open += patch_.cells[at].kind == Token::Kind::split ? 1 : std::size_t(-1);
    return at;
  }

  const Patch& patch_;
  Pair pair_;
  std::string where_;
  bool is_self_;
  std::size_t next_ = 0;
  std::map<std::pair<int, Rational>, std::vector<std::size_t>> on_line_;
  std::vector<char> seen_;
  std::vector<Found> found_;
  std::vector<Box> open_;
  std::optional<Critical_check> critical_; ///< made at the first use: it costs more than all else
};

} // namespace check
} // namespace locus

#endif
