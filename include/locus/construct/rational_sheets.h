// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_RATIONAL_SHEETS_H
#define LOCUS_CONSTRUCT_RATIONAL_SHEETS_H

#include <locus/construct/locus.h>
#include <locus/construct/sheet.h>
#include <locus/function/checkpoint.h>
#include <locus/number/interval.h>
#include <locus/shape/rational_map.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace locus {

/// What a vertex of a sheet is given besides its point.
struct Vertex_description {
  std::vector<double> parameters;
  double radius = 0;
};

/// How `rational_sheets` draws a surface.
struct Sheet_options {
  Approximate_point<3> centre;
  double cut_radius = 10;  ///< parts farther from the centre are left out; no vertex is farther than 9/8 of it and an error
  double tolerance = 1e-6; ///< of the error, in the inputs' units
  std::size_t max_cells = 400000;
  int max_depth = 24; ///< halvings of each variable, up to 30
  /// Where `max_cells` or `max_depth` ends the work, what is left is drawn if its error is up to this many tolerances; the
  /// sheets tell it.
  double slack = 64;
  /// The pieces cover a grid, the last index running fastest: piece i0·grid[1] + i1 lies at (i0, i1).
  std::array<std::size_t, 2> grid{1, 1};
  std::array<bool, 2> closed{false, false}; ///< in variable k the grid's last pieces are followed by the first
  /// Called for each vertex with its piece and its place in the piece's unit square. Without it: the values of the piece's
  /// own variables, and radius 0.
  std::function<Vertex_description(std::size_t piece, double u, double v, const Approximate_point<3>& point)> describe;
  Checkpoint checkpoint;
};

/// A surface as sheets, and the boxes of its parameters about which nothing is claimed.
struct Sheets {
  std::vector<Sheet> sheets;
  std::vector<Undecided_piece> undecided;
  std::size_t cells = 0; ///< looked at
};

namespace detail {

// ---------------------------------------------------------------------------------------------- forms on a cell

/// A point to print and a bound of its distance to the exact one.
struct Sheet_place {
  Approximate_point<3> at;
  double radius = std::numeric_limits<double>::infinity();
};

/// The homogeneous coordinates x, y, z, w of a surface on a cell, x, y, z taken from the centre: the Bernstein coefficients
/// of one after another in one array, so that all are split in one go. Upward rounding needed.
class Sheet_forms {
public:
  Sheet_forms(const Degrees<2>& degrees, std::vector<Interval> coefficients)
    : degrees_(degrees), coefficients_(std::move(coefficients))
  {
  }

  const Degrees<2>& degrees() const { return degrees_; }
  std::size_t size() const { return coefficients_.size() / 4; }
  std::size_t columns() const { return static_cast<std::size_t>(degrees_[1]) + 1; }
  const Interval* form(std::size_t k) const { return coefficients_.data() + k * size(); }

  std::pair<Sheet_forms, Sheet_forms> split(int variable) const
  {
    std::pair<Sheet_forms, Sheet_forms> parts{*this, *this};
    Layout layout = layout_along(degrees_, variable);
    layout.outer *= 4;
    split_kernel(coefficients_.data(), parts.first.coefficients_.data(), parts.second.coefficients_.data(), layout, half);
    return parts;
  }

  /// At corner 0 to 3: both variables low, the second high, the first high, both high.
  std::array<Interval, 4> corner(std::size_t c) const
  {
    const std::size_t at = (c & 2 ? size() - columns() : 0) + (c & 1 ? columns() - 1 : 0);
    return {form(0)[at], form(1)[at], form(2)[at], form(3)[at]};
  }

  std::array<Interval, 4> middle() const
  {
    std::array<Interval, 4> at;
    std::vector<Interval> work;
    for (std::size_t k = 0; k < 4; ++k) {
      work.assign(form(k), form(k) + size());
      for (std::size_t rest = size() - columns(); rest > 0; rest -= columns())
        for (std::size_t i = 0; i < rest; ++i) work[i] = half(work[i], work[i + columns()]);
      for (std::size_t rest = columns() - 1; rest > 0; --rest)
        for (std::size_t i = 0; i < rest; ++i) work[i] = half(work[i], work[i + 1]);
      at[k] = work[0];
    }
    return at;
  }

  bool weight_has_a_sign() const
  {
    const Sign first = sign_of(form(3)[0]);
    if (first != Sign::positive && first != Sign::negative) return false;
    return std::all_of(form(3), form(3) + size(), [&](const Interval& w) { return sign_of(w) == first; });
  }

private:
  static Interval half(const Interval& a, const Interval& b) { return (a + b) * 0.5; }

  Degrees<2> degrees_;
  std::vector<Interval> coefficients_;
};

/// Divides by the power of two next to the greatest coefficient: homogeneous coordinates allow it, doubles need it.
inline void scale_to_unit(std::array<Bernstein<Rational, 2>, 4>& forms)
{
  long exponent = std::numeric_limits<long>::min();
  for (const auto& f : forms)
    for (const Rational& c : f.coefficients())
      if (c != 0)
        exponent = std::max(exponent, static_cast<long>(mpz_sizeinbase(c.get_num_mpz_t(), 2)) -
                                        static_cast<long>(mpz_sizeinbase(c.get_den_mpz_t(), 2)));
  if (exponent == std::numeric_limits<long>::min()) return;
  Rational factor(1);
  if (exponent >= 0) mpq_div_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  else mpq_mul_2exp(factor.get_mpq_t(), factor.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  for (auto& f : forms) f = multiply(std::move(f), factor);
}

inline Sheet_forms sheet_forms(const Rational_map_piece<3, 2>& piece, const Approximate_point<3>& centre)
{
  std::array<Bernstein<Rational, 2>, 4> forms;
  for (std::size_t k = 0; k < 3; ++k) // exactly: a difference of large numbers would cost digits later
    forms[k] = subtract(piece.numerator[k], multiply(piece.weight, exact_rational(centre[k])));
  forms[3] = piece.weight;
  scale_to_unit(forms);
  Degrees<2> degrees{};
  for (const auto& f : forms) degrees = max_degrees<2>(degrees, f.degrees());
  std::vector<Interval> coefficients;
  for (auto& f : forms) {
    f = elevated_to(std::move(f), degrees);
    for (const Rational& c : f.coefficients()) coefficients.push_back(enclosing(c));
  }
  return Sheet_forms(degrees, std::move(coefficients));
}

// ------------------------------------------------------------------------------------------------ tests of a cell

/// Whether all points are proved to be farther than `radius` from the centre, the ones at infinity too. With a vector n and
/// the numerator N, n·N > radius·|n|·|w| says so; it is linear in the coefficients, and sharp as cells get small.
inline bool is_outside(const Sheet_forms& f, double radius)
{
  std::array<double, 3> n{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < f.size(); ++i) n[k] += midpoint(f.form(k)[i]);
  const double reach = radius * std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]); // rounded up
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Interval along = f.form(0)[i] * n[0] + f.form(1)[i] * n[1] + f.form(2)[i] * n[2];
    if (!(along.inf() > reach * magnitude(f.form(3)[i]))) return false;
  }
  return true;
}

inline Sheet_place printed(const std::array<Interval, 4>& homogeneous, const Approximate_point<3>& centre)
{
  Sheet_place p;
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Interval x = homogeneous[k] / homogeneous[3] + Interval(centre[k]);
    p.at[k] = midpoint(x);
    const double off = std::max(x.sup() - p.at[k], p.at[k] - x.inf());
    square += off * off;
  }
  p.radius = std::sqrt(square);
  return p;
}

inline double distance_from(const Approximate_point<3>& a, const Approximate_point<3>& b)
{
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square);
}

/// Bounds the distance of a surface f, whose weight has one sign, to each function that agrees with it at points of the cell
/// and is linear on triangles between them. For an affine map A the coefficients of (N - Aw)/w, taken at degrees that hold
/// both parts, span a convex hull that contains f - A everywhere and so also its linear interpolants: they differ by the
/// hull's diameter at most.
class Interpolation_bound {
public:
  /// Infinite as soon as it is beyond `give_up`.
  double operator()(const Sheet_forms& f, double give_up)
  {
    weight_.clear();
    for_each_elevated(f.degrees(), [&](int i, int j) {
      weight_.push_back(elevated(f.degrees(), i, j, [&](std::size_t, std::size_t at) { return f.form(3)[at]; }));
    });
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = width_in_coordinate(f, k);
      square += w * w;
      if (!(square <= give_up * give_up)) return std::numeric_limits<double>::infinity();
    }
    return std::sqrt(square);
  }

private:
  template <class Visit>
  static void for_each_elevated(const Degrees<2>& d, Visit visit)
  {
    for (int i = 0; i <= d[0] + 1; ++i)
      for (int j = 0; j <= d[1] + 1; ++j) visit(i, j);
  }

  /// A coefficient of the product of a bilinear form with corner values b_c and a form of coefficients a_i, times a constant:
  /// the sum of `at(c, i)` = b_c a_i, weighted.
  template <class At>
  static Interval elevated(const Degrees<2>& d, int i, int j, At at)
  {
    Interval sum(0);
    for (int c = 0; c < 4; ++c) {
      const int a = i - (c >> 1), b = j - (c & 1);
      if (a < 0 || a > d[0] || b < 0 || b > d[1]) continue;
      const int factor = (c & 2 ? i : d[0] + 1 - i) * (c & 1 ? j : d[1] + 1 - j);
      sum += at(static_cast<std::size_t>(c), static_cast<std::size_t>(a * (d[1] + 1) + b)) * static_cast<double>(factor);
    }
    return sum;
  }

  /// The values at the corners of an affine function near to coordinate `k`. Whatever its rounding, it is affine.
  static std::array<Interval, 4> affine(const Sheet_forms& f, std::size_t k)
  {
    std::array<double, 4> q;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto h = f.corner(c);
      q[c] = midpoint(h[k] / h[3]);
    }
    const double along_u = 0.5 * ((q[2] - q[0]) + (q[3] - q[1])), along_v = 0.5 * ((q[1] - q[0]) + (q[3] - q[2]));
    const Interval start(q[0]);
    return {start, start + along_v, start + along_u, start + along_u + along_v};
  }

  double width_in_coordinate(const Sheet_forms& f, std::size_t k)
  {
    const std::array<Interval, 4> plane = affine(f, k);
    const std::size_t n = f.size();
    off_.resize(4 * n);
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t i = 0; i < n; ++i) off_[c * n + i] = f.form(k)[i] - plane[c] * f.form(3)[i];
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    std::size_t next = 0;
    for_each_elevated(f.degrees(), [&](int i, int j) {
      const Interval ratio =
        elevated(f.degrees(), i, j, [&](std::size_t c, std::size_t at) { return off_[c * n + at]; }) / weight_[next++];
      lo = std::min(lo, ratio.inf());
      hi = std::max(hi, ratio.sup());
    });
    return hi - lo;
  }

  std::vector<Interval> weight_, off_;
};

/// Which variable a cell is split in. No claim rests on it.
class Split_choice {
public:
  /// The one in which the surface bends more; or, where it bends little or in both at once, the one in which it is longer.
  static int by_bending(const Sheet_forms& f)
  {
    const Split_choice s(f, [&](std::size_t k, std::size_t i) {
      return k == 3 ? 0 : midpoint(f.form(k)[i]) / midpoint(f.form(3)[i]);
    });
    const double u = s.second(0) * f.degrees()[0] * (f.degrees()[0] - 1);
    const double v = s.second(1) * f.degrees()[1] * (f.degrees()[1] - 1);
    if (std::max(u, v) > s.mixed() * f.degrees()[0] * f.degrees()[1]) return u >= v ? 0 : 1;
    return s.longer();
  }

  /// The one in which it is longer.
  static int by_length(const Sheet_forms& f)
  {
    return Split_choice(f, [&](std::size_t k, std::size_t i) {
             return k == 3 ? 0 : midpoint(f.form(k)[i]) / midpoint(f.form(3)[i]);
           }).longer();
  }

  /// The one in which the homogeneous coordinates vary more, points at the cut radius being as far as the weight's unit.
  static int by_forms(const Sheet_forms& f, double radius)
  {
    return Split_choice(f, [&](std::size_t k, std::size_t i) {
             return k == 3 ? midpoint(f.form(k)[i]) : midpoint(f.form(k)[i]) / radius;
           }).longer();
  }

private:
  template <class Value>
  Split_choice(const Sheet_forms& f, Value value) : degrees_(f.degrees()), columns_(f.columns())
  {
    for (std::size_t i = 0; i < f.size(); ++i)
      values_.push_back({value(0, i), value(1, i), value(2, i), value(3, i)});
  }

  int longer() const { return first(0) * degrees_[0] >= first(1) * degrees_[1] ? 0 : 1; }
  double first(int k) const
  {
    return greatest(k == 0, k == 1, {{{0, -1}, {step(k), 1}, {}, {}}});
  }
  double second(int k) const
  {
    return greatest(2 * (k == 0), 2 * (k == 1), {{{0, 1}, {step(k), -2}, {2 * step(k), 1}, {}}});
  }
  double mixed() const
  {
    return greatest(1, 1, {{{0, 1}, {step(0), -1}, {step(1), -1}, {step(0) + step(1), 1}}});
  }

  std::size_t step(int k) const { return k == 0 ? columns_ : 1; }

  struct Term {
    std::size_t offset = 0;
    double factor = 0;
  };

  /// The greatest component of a difference, over all places where it reaches `rows` and `columns` further.
  double greatest(int rows, int columns, const std::array<Term, 4>& difference) const
  {
    double most = 0;
    for (int i = 0; i + rows <= degrees_[0]; ++i)
      for (int j = 0; j + columns <= degrees_[1]; ++j)
        for (std::size_t k = 0; k < 4; ++k) {
          double sum = 0;
          const std::size_t at = static_cast<std::size_t>(i) * columns_ + static_cast<std::size_t>(j);
          for (const Term& term : difference) sum += term.factor * values_[at + term.offset][k];
          most = std::max(most, std::abs(sum));
        }
    return most;
  }

  Degrees<2> degrees_;
  std::size_t columns_;
  std::vector<std::array<double, 4>> values_;
};

// ----------------------------------------------------------------------------------------------------------- tree

using Sheet_unit = std::uint32_t;
/// A place in a piece's square, in units of half a smallest cell, so that cells' middles are whole numbers too.
using Sheet_position = std::array<Sheet_unit, 2>;

enum class Sheet_cell : unsigned char {
  divided,
  outside,
  good,
  smallest,  ///< undecided: may not be split further
  unfinished ///< undecided: the limit of cells came first
};

constexpr bool is_undecided(Sheet_cell c) { return c == Sheet_cell::smallest || c == Sheet_cell::unfinished; }

struct Sheet_node {
  Sheet_position low{}, size{};
  std::uint32_t link = 0; ///< of a divided cell the first of its two children, of an undecided one its cluster
  Sheet_cell state = Sheet_cell::unfinished;
  std::uint8_t variable = 0;

  Sheet_unit high(std::size_t k) const { return low[k] + size[k]; }
};

using Sheet_tree = std::vector<Sheet_node>;

/// Part of the line where variable `k` is `at`.
struct Sheet_line {
  std::size_t k = 0;
  Sheet_unit at = 0, lo = 0, hi = 0;
};

/// Visits the cells that touch the line on one side.
template <class Visit>
void visit_along(const Sheet_tree& tree, std::uint32_t index, const Sheet_line& line, bool above, const Visit& visit)
{
  const Sheet_node& n = tree[index];
  if (n.state != Sheet_cell::divided) return visit(index);
  const Sheet_unit cut = tree[n.link].high(n.variable);
  if (n.variable == line.k) return visit_along(tree, n.link + (above ? line.at >= cut : line.at > cut), line, above, visit);
  if (line.lo < cut) visit_along(tree, n.link, line, above, visit);
  if (line.hi > cut) visit_along(tree, n.link + 1, line, above, visit);
}

/// A point of a piece that is a vertex.
struct Sheet_site {
  std::uint32_t piece = 0;
  Sheet_position at{};
  Sheet_place place;
};

/// A cell that is drawn.
struct Sheet_leaf {
  std::uint32_t piece = 0, node = 0;
  double error = 0; ///< of any interpolation on it, without its points' rounding
  Sheet_place middle;
};

// ------------------------------------------------------------------------------------------------- subdivision

/// Divides the pieces into cells until each is drawn, left out or undecided. Upward rounding needed.
class Sheet_cells {
public:
  std::vector<Sheet_tree> trees;
  std::vector<Sheet_leaf> leaves;
  std::vector<Sheet_site> corners; ///< of the leaves, repeated
  std::size_t count = 0;

  Sheet_cells(const std::vector<Rational_map_piece<3, 2>>& pieces, const Sheet_options& options) : options_(options)
  {
    for (std::size_t k = 0; k < 2; ++k) largest_[k] = largest_size(k);
    trees.resize(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      trees[i].emplace_back();
      trees[i][0].size = {full_size(), full_size()};
      look_at(sheet_forms(pieces[i], options.centre), static_cast<std::uint32_t>(i), 0);
    }
    // The coarsest first: where the limit of cells ends the work, all of the surface has been treated alike.
    while (!open_.empty() && count < options_.max_cells) {
      const Open_cell cell = std::move(open_.front());
      open_.pop_front();
      divide(cell);
    }
    for (const Open_cell& cell : open_)
      if (may_be_drawn(cell)) draw(cell);
    open_.clear();
  }

  Sheet_unit full_size() const { return Sheet_unit{2} << options_.max_depth; }

private:
  struct Open_cell {
    Sheet_forms forms;
    std::uint32_t piece, node;
    double error = std::numeric_limits<double>::infinity(), rounding = 0; ///< infinite if it may not be drawn
  };

  /// Around a closed variable at least four cells are wanted: an edge is known by its ends.
  Sheet_unit largest_size(std::size_t k) const
  {
    Sheet_unit size = full_size();
    if (options_.closed[k])
      for (std::size_t n = options_.grid[k]; n < 4 && size > 2; n *= 2) size /= 2;
    return size;
  }

  void look_at(Sheet_forms forms, std::uint32_t piece, std::uint32_t node)
  {
    if ((++count & 1023u) == 0) with_nearest_rounding([&] { pass(options_.checkpoint); });
    Sheet_node& n = trees[piece][node];
    if (is_outside(forms, options_.cut_radius)) {
      n.state = Sheet_cell::outside;
      return;
    }
    Open_cell cell{std::move(forms), piece, node};
    const int variable = measure(cell, n);
    // A little is left to the rounding of vertices that a neighbour will add.
    if (cell.error + cell.rounding <= options_.tolerance * (1 - 0x1p-10)) return draw(cell);
    n.variable = static_cast<std::uint8_t>(variable);
    if (n.size[n.variable] > 2) open_.push_back(std::move(cell));
    else if (may_be_drawn(cell)) draw(cell);
    else n.state = Sheet_cell::smallest;
  }

  /// At the limits of the work.
  bool may_be_drawn(const Open_cell& cell) const
  {
    return cell.error + cell.rounding <= options_.slack * options_.tolerance;
  }

  /// Finds the cell's error and the variable that is better split.
  int measure(Open_cell& cell, const Sheet_node& n)
  {
    if (!cell.forms.weight_has_a_sign()) return Split_choice::by_forms(cell.forms, options_.cut_radius);
    for (int k = 0; k < 2; ++k)
      if (n.size[static_cast<std::size_t>(k)] > largest_[static_cast<std::size_t>(k)]) return k;
    double farthest = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const Sheet_place p = printed(cell.forms.corner(c), options_.centre);
      farthest = std::max(farthest, distance_from(p.at, options_.centre));
      cell.rounding = std::max(cell.rounding, p.radius);
    }
    if (!(farthest <= 1.125 * options_.cut_radius)) return Split_choice::by_length(cell.forms);
    cell.error = bound_(cell.forms, options_.slack * options_.tolerance);
    return Split_choice::by_bending(cell.forms);
  }

  void draw(const Open_cell& cell)
  {
    Sheet_node& n = trees[cell.piece][cell.node];
    n.state = Sheet_cell::good;
    leaves.push_back({cell.piece, cell.node, cell.error, printed(cell.forms.middle(), options_.centre)});
    for (std::size_t c = 0; c < 4; ++c)
      corners.push_back({cell.piece,
                         {c & 2 ? n.high(0) : n.low[0], c & 1 ? n.high(1) : n.low[1]},
                         printed(cell.forms.corner(c), options_.centre)});
  }

  void divide(const Open_cell& cell)
  {
    Sheet_tree& tree = trees[cell.piece];
    const auto child = static_cast<std::uint32_t>(tree.size());
    const std::size_t k = tree[cell.node].variable;
    Sheet_node part = tree[cell.node];
    part.size[k] /= 2;
    tree.push_back(part);
    part.low[k] += part.size[k];
    tree.push_back(part);
    tree[cell.node].link = child;
    tree[cell.node].state = Sheet_cell::divided;
    auto forms = cell.forms.split(static_cast<int>(k));
    look_at(std::move(forms.first), cell.piece, child);
    look_at(std::move(forms.second), cell.piece, child + 1);
  }

  const Sheet_options& options_;
  Sheet_position largest_{};
  std::deque<Open_cell> open_;
  Interpolation_bound bound_;
};

// ------------------------------------------------------------------------------------------------------ the grid

/// Classes of numbers that were declared to be equal.
class Sheet_classes {
public:
  explicit Sheet_classes(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller representative stays.
  void unite(std::uint32_t i, std::uint32_t j)
  {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

private:
  std::vector<std::uint32_t> parent_;
};

inline bool same_end(const Rational& a, bool a_infinite, const Rational& b, bool b_infinite)
{
  return a_infinite || b_infinite ? a_infinite == b_infinite : a == b;
}

/// Whether the side where variable `k` is 1 of one piece is, point by point, the side where it is 0 of the other.
inline bool have_common_side(const Rational_map_piece<3, 2>& a, const Rational_map_piece<3, 2>& b, int k)
{
  const auto wa = face(a.weight, k, true), wb = face(b.weight, k, false);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto off = subtract(multiply(face(a.numerator[i], k, true), wb), multiply(face(b.numerator[i], k, false), wa));
    for (const Rational& c : off.coefficients())
      if (c != 0) return false;
  }
  return true;
}

/// Which sides of the pieces are joined.
class Sheet_grid {
public:
  Sheet_grid(const std::vector<Rational_map_piece<3, 2>>& pieces, const Sheet_options& options)
    : pieces_(pieces), size_(options.grid), closed_(options.closed), joined_(pieces.size())
  {
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) joined_[i][k] = is_joint(i, k);
  }

  /// The piece across a side that is joined.
  std::optional<std::uint32_t> across(std::uint32_t piece, std::size_t k, bool high) const
  {
    if (high) return joined_[piece][k] ? std::optional(neighbour(piece, k, 1)) : std::nullopt;
    const std::uint32_t before = neighbour(piece, k, size_[k] - 1);
    return joined_[before][k] ? std::optional(before) : std::nullopt;
  }

private:
  std::size_t index(std::uint32_t piece, std::size_t k) const { return k == 0 ? piece / size_[1] : piece % size_[1]; }
  std::uint32_t neighbour(std::uint32_t piece, std::size_t k, std::size_t step) const
  {
    std::array<std::size_t, 2> at{index(piece, 0), index(piece, 1)};
    at[k] = (at[k] + step) % size_[k];
    return static_cast<std::uint32_t>(at[0] * size_[1] + at[1]);
  }

  bool is_joint(std::uint32_t piece, std::size_t k) const
  {
    const bool last = index(piece, k) + 1 == size_[k];
    if (last && !closed_[k]) return false;
    const auto &a = pieces_[piece], &b = pieces_[neighbour(piece, k, 1)];
    const Piece &along = a.range[1 - k], &along_too = b.range[1 - k];
    if (!same_end(along.lo, along.lo_infinite, along_too.lo, along_too.lo_infinite) ||
        !same_end(along.hi, along.hi_infinite, along_too.hi, along_too.hi_infinite))
      return false;
    if (!last && !same_end(a.range[k].hi, a.range[k].hi_infinite, b.range[k].lo, b.range[k].lo_infinite)) return false;
    return have_common_side(a, b, static_cast<int>(k));
  }

  const std::vector<Rational_map_piece<3, 2>>& pieces_;
  std::array<std::size_t, 2> size_;
  std::array<bool, 2> closed_;
  std::vector<std::array<bool, 2>> joined_;
};

// ----------------------------------------------------------------------------------------------------- vertices

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
    for_each_joint(grid, pieces, [&](std::uint32_t a, std::uint32_t b, std::size_t k) { unite(a, b, k, full, classes); });
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

  void copy_side(std::uint32_t from, Sheet_unit from_at, std::uint32_t to, Sheet_unit to_at, std::size_t k, Sheet_unit full,
                 std::vector<Sheet_site>& copies) const
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

// ---------------------------------------------------------------------------------------------------- triangles

struct Sheet_triangle {
  std::array<std::uint32_t, 3> site;
  std::uint32_t leaf;
};

/// The triangles of all drawn cells. A corner of one cell on a side of another is a vertex of both, so that they fit.
class Sheet_triangles {
public:
  Sheet_triangles(const Sheet_cells& cells, Sheet_sites& sites) : sites_(sites)
  {
    for (std::uint32_t i = 0; i < cells.leaves.size(); ++i) {
      const Sheet_leaf& leaf = cells.leaves[i];
      const Sheet_node& node = cells.trees[leaf.piece][leaf.node];
      find_outline(leaf.piece, node);
      if (outline_.size() == 4) add_two(i);
      else add_fan(i, leaf, node);
    }
  }

  std::vector<Sheet_triangle> take() { return std::move(triangles_); }

private:
  /// All vertices on the sides, turning left.
  void find_outline(std::uint32_t piece, const Sheet_node& n)
  {
    outline_.clear();
    forwards(sites_.on(piece, {1, n.low[1], n.low[0], n.high(0)}));
    forwards(sites_.on(piece, {0, n.high(0), n.low[1], n.high(1)}));
    backwards(sites_.on(piece, {1, n.high(1), n.low[0], n.high(0)}));
    backwards(sites_.on(piece, {0, n.low[0], n.low[1], n.high(1)}));
  }
  // Each side without its last vertex, which is the next one's first.
  void forwards(const Sheet_sites::Entries& side)
  {
    for (auto i = side.first; i + 1 != side.second; ++i) outline_.push_back(i->site);
  }
  void backwards(const Sheet_sites::Entries& side)
  {
    for (auto i = side.second; --i != side.first;) outline_.push_back(i->site);
  }

  /// Along the shorter diagonal, for the look of it.
  void add_two(std::uint32_t leaf)
  {
    const auto& o = outline_;
    const auto length = [&](std::size_t a, std::size_t b) {
      return distance_from(sites_.place(o[a]).at, sites_.place(o[b]).at);
    };
    const std::size_t s = length(0, 2) <= length(1, 3) ? 0 : 1;
    triangles_.push_back({{o[s], o[s + 1], o[s + 2]}, leaf});
    triangles_.push_back({{o[s], o[s + 2], o[(s + 3) % 4]}, leaf});
  }

  void add_fan(std::uint32_t index, const Sheet_leaf& leaf, const Sheet_node& n)
  {
    const std::uint32_t middle =
      sites_.add({leaf.piece, {n.low[0] + n.size[0] / 2, n.low[1] + n.size[1] / 2}, leaf.middle});
    for (std::size_t i = 0; i < outline_.size(); ++i)
      triangles_.push_back({{middle, outline_[i], outline_[(i + 1) % outline_.size()]}, index});
  }

  Sheet_sites& sites_;
  std::vector<std::uint32_t> outline_;
  std::vector<Sheet_triangle> triangles_;
};

// ----------------------------------------------------------------------------------------------- undecided cells

/// Undecided cells of a piece that hang together.
struct Sheet_cluster {
  std::uint32_t piece = 0;
  Sheet_position low{}, high{};
  bool smallest = false;     ///< some cell may not be split further
  bool zero_by_zero = false; ///< proved to hold a point where the numerator and the weight vanish
};

class Sheet_clusters {
public:
  Sheet_clusters(const std::vector<Rational_map_piece<3, 2>>& pieces, Sheet_cells& cells)
    : pieces_(pieces), full_(cells.full_size())
  {
    for (std::uint32_t i = 0; i < pieces.size(); ++i) gather(i, cells.trees[i]);
  }

  const Sheet_cluster& operator[](std::size_t i) const { return clusters_[i]; }

  std::vector<Undecided_piece> listed() const
  {
    std::vector<Undecided_piece> list;
    for (const Sheet_cluster& c : clusters_) {
      Undecided_piece u;
      for (std::size_t k = 0; k < 2; ++k) u.box.push_back(range(pieces_[c.piece].range[k], c.low[k], c.high[k]));
      u.reason = c.zero_by_zero ? "the surface is 0/0 at a point of this box"
                 : c.smallest   ? "the surface is 0/0 or goes to infinity in this box"
                                : "the limit of cells was reached in this box";
      list.push_back(std::move(u));
    }
    return list;
  }

private:
  void gather(std::uint32_t piece, Sheet_tree& tree)
  {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < tree.size(); ++i)
      if (is_undecided(tree[i].state)) {
        tree[i].link = static_cast<std::uint32_t>(found.size());
        found.push_back(i);
      }
    Sheet_classes classes(found.size());
    for (const std::uint32_t i : found)
      for (std::size_t k = 0; k < 2; ++k) {
        if (tree[i].high(k) == full_) continue;
        const Sheet_line side{k, tree[i].high(k), tree[i].low[1 - k], tree[i].high(1 - k)};
        visit_along(tree, 0, side, true, [&](std::uint32_t j) {
          if (is_undecided(tree[j].state)) classes.unite(tree[i].link, tree[j].link);
        });
      }
    std::vector<std::uint32_t> cluster_of(found.size());
    for (std::uint32_t i = 0; i < found.size(); ++i) {
      const std::uint32_t first = classes.find(i);
      if (first == i) open_cluster(piece, tree[found[i]], cluster_of[i]);
      cluster_of[i] = cluster_of[first];
      extend(cluster_of[i], tree[found[i]]);
    }
    for (const std::uint32_t i : found) tree[i].link = cluster_of[tree[i].link];
  }

  void open_cluster(std::uint32_t piece, const Sheet_node& n, std::uint32_t& number)
  {
    number = static_cast<std::uint32_t>(clusters_.size());
    Sheet_cluster c;
    c.piece = piece;
    c.low = n.low;
    c.high = {n.high(0), n.high(1)};
    clusters_.push_back(c);
  }

  void extend(std::uint32_t number, const Sheet_node& n)
  {
    Sheet_cluster& c = clusters_[number];
    for (std::size_t k = 0; k < 2; ++k) {
      c.low[k] = std::min(c.low[k], n.low[k]);
      c.high[k] = std::max(c.high[k], n.high(k));
    }
    if (n.state != Sheet_cell::smallest) return;
    c.smallest = true;
    // Exact and slow, so only a number of times. What is missed is called undecided, which it is.
    if (c.zero_by_zero || trials_ == 0) return;
    --trials_;
    for (const Sheet_unit u : {n.low[0], n.high(0)})
      for (const Sheet_unit v : {n.low[1], n.high(1)}) c.zero_by_zero = c.zero_by_zero || is_zero_by_zero(c.piece, u, v);
  }

  bool is_zero_by_zero(std::uint32_t piece, Sheet_unit u, Sheet_unit v) const
  {
    const std::array<Rational, 2> at{local(u), local(v)};
    const auto& p = pieces_[piece];
    if (evaluate(p.weight, at) != 0) return false;
    return std::all_of(p.numerator.begin(), p.numerator.end(), [&](const auto& f) { return evaluate(f, at) == 0; });
  }

  Rational local(Sheet_unit at) const
  {
    Rational x(at, full_);
    x.canonicalize();
    return x;
  }

  Range range(const Piece& piece, Sheet_unit low, Sheet_unit high) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto lo = piece.at(local(low)), hi = piece.at(local(high));
    return {lo ? enclosing(*lo).inf() : -infinity, hi ? enclosing(*hi).sup() : infinity};
  }

  const std::vector<Rational_map_piece<3, 2>>& pieces_;
  Sheet_unit full_;
  std::vector<Sheet_cluster> clusters_;
  int trials_ = 256;
};

// --------------------------------------------------------------------------------------------------- components

/// Why there is no triangle across an edge; a loop is named after the greatest.
enum class Sheet_end : unsigned char { domain, undecided, singular, infinity };

constexpr const char* name_of(Sheet_end e)
{
  constexpr const char* names[] = {"domain", "undecided", "singular", "infinity"};
  return names[static_cast<std::size_t>(e)];
}

/// Looks up what lies across a side of a drawn cell.
class Sheet_ends {
public:
  Sheet_ends(const Sheet_cells& cells, const Sheet_grid& grid, const Sheet_clusters& clusters)
    : cells_(cells), grid_(grid), clusters_(clusters)
  {
  }

  Sheet_end across(const Sheet_leaf& leaf, const Sheet_site& a, const Sheet_site& b) const
  {
    const Sheet_node& n = cells_.trees[leaf.piece][leaf.node];
    const std::size_t k = a.at[0] == b.at[0] ? 0 : 1;
    const bool high = a.at[k] == n.high(k);
    Sheet_line line{k, a.at[k], std::min(a.at[1 - k], b.at[1 - k]), std::max(a.at[1 - k], b.at[1 - k])};
    std::uint32_t piece = leaf.piece;
    if (line.at == (high ? cells_.full_size() : 0)) {
      const auto next = grid_.across(piece, k, high);
      if (!next) return Sheet_end::domain;
      piece = *next;
      line.at = high ? 0 : cells_.full_size();
    }
    Sheet_end end = Sheet_end::domain;
    const Sheet_tree& tree = cells_.trees[piece];
    visit_along(tree, 0, line, high, [&](std::uint32_t i) { end = std::max(end, cause(tree[i])); });
    return end;
  }

private:
  Sheet_end cause(const Sheet_node& n) const
  {
    if (n.state == Sheet_cell::outside) return Sheet_end::infinity;
    return is_undecided(n.state) && clusters_[n.link].zero_by_zero ? Sheet_end::singular : Sheet_end::undecided;
  }

  const Sheet_cells& cells_;
  const Sheet_grid& grid_;
  const Sheet_clusters& clusters_;
};

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

// ------------------------------------------------------------------------------------------------------- result

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
  Sheet_writer(const std::vector<Rational_map_piece<3, 2>>& pieces, const Sheet_options& options, const Sheet_cells& cells,
               const Sheet_sites& sites, const std::vector<Sheet_triangle>& triangles)
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
    Vertex_description d = options_.describe ? options_.describe(s.piece, u, v, p)
                                             : Vertex_description{parameters_.at(s.piece, u, v), 0};
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
      sheets[i].euler = static_cast<int>(static_cast<std::ptrdiff_t>(sheets[i].points.size() + sheets[i].triangles.size()) -
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
      end = std::max(end, ends.across(cells_.leaves[t.leaf], sites_[t.site[s % 3]],
                                      sites_[t.site[Sheet_joining::next(s) % 3]]));
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

inline void check_sheet_options(const Sheet_options& o, std::size_t pieces)
{
  if (o.grid[0] == 0 || pieces % o.grid[0] != 0 || o.grid[1] != pieces / o.grid[0])
    throw std::invalid_argument("rational_sheets: the grid does not have as many places as the surface has pieces");
  if (o.max_depth < 0 || o.max_depth > 30) throw std::invalid_argument("rational_sheets: max_depth is from 0 to 30");
  if (!(o.cut_radius > 0) || !(o.tolerance >= 0))
    throw std::invalid_argument("rational_sheets: the cut radius is positive, the tolerance not negative");
}

} // namespace detail

/// Draws a rational surface as triangles with a proved error. All of the surface that is nearer to the centre than the cut
/// radius, except in the undecided boxes, is within the error of the sheets. Neighbouring pieces are joined where their common
/// side is proved to be the same curve with the same parameter; which triangles hang together is decided by the parameters
/// alone. A side that is one point of space stays a boundary loop of length zero.
inline Sheets rational_sheets(const Rational_map<3, 2>& surface, const Sheet_options& options)
{
  Sheets result;
  const auto& pieces = surface.pieces();
  if (pieces.empty()) return result;
  detail::check_sheet_options(options, pieces.size());
  detail::Sheet_cells cells = with_upward_rounding([&] { return detail::Sheet_cells(pieces, options); });
  const detail::Sheet_grid grid(pieces, options);
  detail::Sheet_sites sites(std::move(cells.corners), grid, pieces.size(), cells.full_size());
  const std::vector<detail::Sheet_triangle> triangles = detail::Sheet_triangles(cells, sites).take();
  const detail::Sheet_clusters clusters(pieces, cells);
  result.sheets = detail::Sheet_writer(pieces, options, cells, sites, triangles)
                    .write(detail::Sheet_ends(cells, grid, clusters));
  result.undecided = clusters.listed();
  result.cells = cells.count;
  return result;
}

} // namespace locus

#endif
