// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_CERTIFICATE_H
#define LOCUS_CHECK_CERTIFICATE_H

#include <locus/check/polynomial.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace locus {
namespace check {

// A certificate as plain data. doc/certificate.md says what each part means and why it proves what it does.

/// An input as the job gives it: control points, or coefficients of powers on a domain.
struct Input {
  bool is_monomial = false;
  int degree = 1;
  std::vector<std::array<Rational, 2>> points;
  std::vector<Rational> weights, knots;       ///< may be empty
  std::array<std::vector<Rational>, 3> power; ///< of x, y and w
  std::optional<Rational> lo, hi;             ///< the domain of powers; none: infinite
  bool closed = false;
};

/// A piece of an input on the unit interval. An end of its range that is not there is infinite.
struct Piece {
  std::optional<Rational> lo, hi;
  std::array<Powers, 3> point;   ///< x, y and w
  std::array<Powers, 2> tangent; ///< of the tangent line, along the direction of travel
};

enum class Joint : unsigned char { corner, smooth, tolerance };

struct Curve {
  Input input;
  std::vector<Piece> pieces;
  std::vector<Joint> joints; ///< behind each piece; one more than gaps between pieces where the curve is closed
};

/// The line r/(1-r) = ratio·t/(1-t), with 1 - r for r where reversed.
struct Line {
  bool reversed = false;
  Rational ratio = 1;
};

/// A line's polynomial that was divided out of an equation: once, if its zero set is listed apart; else the inputs overlap.
struct Divided_line {
  Line line;
  int power = 1;
};

/// Coordinates on a unit square: the parameters themselves, or monomials in the distances from a corner.
struct Chart {
  bool is_plain = true;
  std::array<int, 2> corner{0, 0};
  std::array<std::array<int, 2>, 2> exponent{{{1, 0}, {0, 1}}}; ///< [parameter][x]
};

/// A range with exactly one root, or an exact value.
struct Range {
  Rational lo, hi;
  bool is_exact() const { return lo == hi; }
};

enum class Vertex_kind : unsigned char { crossing, boundary, isolated, node, end, mark, open };

struct Vertex {
  Vertex_kind kind = Vertex_kind::crossing;
  std::array<Range, 2> at;
  std::optional<std::size_t> cell; ///< in which it lies; none for a point on cells' sides
  bool stops = false;              ///< arcs may end here though two pieces meet
};

struct Patch_piece {
  std::size_t cell = 0, from = 0, to = 0;
  bool dropped = false;
};

/// What proves a singular point that no regular system does; see doc/certificate.md.
struct Algebraic {
  Powers m;
  Rational lo, hi;
  std::vector<std::vector<Rational>> h;
  Rational r_lo, r_hi;
};

/// A point with F = 0 and ∇F = 0, in a box or with exact coordinates on the unit square's sides.
struct Singular {
  std::array<Range, 2> at;
  std::optional<Algebraic> algebraic; ///< without this and `axis` the curves meet there
  std::optional<Line> axis;           ///< a line that is part of the zero set and crosses the rest there
};

/// A root of the equation along a line, and which vertex it is.
struct Line_point {
  Range at;
  std::size_t vertex = 0;
};

struct Token {
  enum class Kind : unsigned char { split, empty, graph, singular, outside, undecided };
  Kind kind = Kind::split;
  int variable = 0; ///< cut or pivot
  Rational at;      ///< of a cut
  int sign = 0;     ///< of the polynomial, or of its derivative along the pivot
  std::size_t index = 0; ///< of a singular point
};

/// The zero set on one chart of the cell of two pieces.
struct Patch {
  std::array<std::size_t, 2> pair{0, 0};
  Chart chart;
  bool vanishes = false; ///< the equation is zero
  std::array<Powers, 2> factor; ///< divided out, in one variable each
  std::array<bool, 2> degenerate{false, false}; ///< whether a factor has zeros on the unit interval
  std::vector<Divided_line> lines;
  Table equation;               ///< what is left, in the chart's coordinates
  std::vector<Token> cells;     ///< the tree, each cell before its parts
  std::vector<Singular> singular;
  std::vector<Vertex> vertices;
  std::vector<Patch_piece> pieces;
  std::vector<Line_point> diagonal; ///< of a piece with itself: where the equation vanishes at t = r
};

/// The zero set of a line that was divided out once: a chain of vertices, pieces between them. Its pieces and vertices count
/// after those of all patches.
struct Line_patch {
  std::array<std::size_t, 2> pair{0, 0};
  Line line;
  std::optional<std::array<int, 2>> corner; ///< the line through a blown-up corner
  std::vector<Range> vertices;              ///< by t, or by the distance from the corner
  std::vector<std::optional<std::array<std::size_t, 2>>> meets; ///< patch and vertex of the other factor there
  std::vector<char> stops;                  ///< vertices at which arcs may end without a meeting
  std::vector<char> dropped;                ///< of the pieces between them
};

struct Step {
  std::size_t patch = 0, piece = 0;
  bool reversed = false;
};

struct Arc {
  bool closed = false;
  std::vector<Step> steps;
};

struct Certificate {
  std::vector<Curve> curves; ///< one for a curve with itself
  std::vector<std::array<std::size_t, 2>> empty_pairs;
  std::vector<Patch> patches;
  std::vector<Line_patch> lines;
  std::vector<Arc> arcs;
  std::vector<std::string> undecided; ///< what the solve left open
  std::vector<std::string> unproved;  ///< what the certificate does not cover
  double seconds = 0;

  bool is_self() const { return curves.size() == 1; }
  const Curve& curve(std::size_t k) const { return curves[is_self() ? 0 : k]; }
};

} // namespace check
} // namespace locus

#endif
