// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_LOCUS_H
#define LOCUS_CONSTRUCT_LOCUS_H

#include <locus/construct/approximate_point.h>
#include <locus/construct/sheet.h>
#include <locus/number/filter_counts.h>
#include <locus/shape/rational_map.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace locus {

/// The part of an input on which a foot lies.
enum class Feature : unsigned char { point, interior, start, end, corner };

constexpr const char* name_of(Feature f)
{
  constexpr const char* names[] = {"point", "interior", "start", "end", "corner"};
  return names[static_cast<std::size_t>(f)];
}

/// A foot of a locus point: on which input, which feature, at which parameters (none for a point input).
struct Foot {
  std::size_t input = 0;
  Feature feature = Feature::interior;
  std::vector<Range> parameters;
};

enum class Vertex_kind : unsigned char {
  boundary, ///< the arc meets the boundary of the parameters' domain
  corner,   ///< it breaks off at a spline's corner
  infinity, ///< it goes to infinity
  node,     ///< branches cross
  isolated, ///< a component that is one point
  trim,     ///< the nearest features change
  diagonal, ///< end of a self-bisector
  undecided ///< the arc enters an undecided box
};

constexpr const char* name_of(Vertex_kind k)
{
  constexpr const char* names[] = {"boundary", "corner", "infinity", "node", "isolated", "trim", "diagonal", "undecided"};
  return names[static_cast<std::size_t>(k)];
}

template <int Dim>
struct Asymptote {
  Approximate_point<Dim> point, direction; ///< direction of unit length
};

/// One end of an arc at a node.
struct Half_branch {
  std::size_t arc = 0;
  bool at_start = true;
};

template <int Dim>
struct Locus_vertex {
  Vertex_kind kind = Vertex_kind::boundary;
  std::vector<Foot> feet;
  std::optional<Approximate_point<Dim>> point; ///< none at infinity
  double radius = 0;                           ///< distance to the feet
  double error = std::numeric_limits<double>::infinity(); ///< bound of the printed point's distance from the exact one, where one is known
  std::optional<Approximate_point<Dim>> direction;
  std::optional<Asymptote<Dim>> asymptote;
  int multiplicity = 1;
  std::vector<Half_branch> half_branches; ///< at a node, in cyclic order
};

/// A point of an arc: enclosed parameters of all inputs one after another, the point and its distance to the feet.
template <int Dim>
class Arc_point {
public:
  Arc_point() = default;
  Arc_point(std::vector<Range> parameters, Approximate_point<Dim> point, double radius, double error)
    : parameters_(std::move(parameters)), point_(point), radius_(radius), error_(error)
  {
  }

  const std::vector<Range>& parameters() const { return parameters_; }
  /// A value inside the enclosure; infinite where the enclosure is not bounded.
  double parameter(std::size_t k) const
  {
    const Range& p = parameters_[k];
    if (std::isinf(p.hi)) return p.hi;
    return std::isinf(p.lo) ? p.lo : p.lo + 0.5 * (p.hi - p.lo);
  }
  const Approximate_point<Dim>& point() const { return point_; }
  double radius() const { return radius_; }
  /// Proved bound of the distance between `point()` and the exact locus point of these parameters.
  double error() const { return error_; }

private:
  std::vector<Range> parameters_;
  Approximate_point<Dim> point_;
  double radius_ = 0, error_ = 0;
};

/// Points along an arc, in order, whose connecting segments are proved to lie within `error()` of the arc and the arc
/// (where it is not cut off at the cut radius) within `error()` of them.
template <int Dim>
class Polyline {
public:
  Polyline() = default;
  Polyline(std::vector<Arc_point<Dim>> points, double error) : points_(std::move(points)), error_(error) {}

  auto begin() const { return points_.begin(); }
  auto end() const { return points_.end(); }
  std::size_t size() const { return points_.size(); }
  bool empty() const { return points_.empty(); }
  const Arc_point<Dim>& operator[](std::size_t i) const { return points_[i]; }
  const std::vector<Arc_point<Dim>>& points() const { return points_; }
  double error() const { return error_; }

private:
  std::vector<Arc_point<Dim>> points_;
  double error_ = 0;
};

/// Tangent and curvature at a point of an arc.
template <int Dim>
struct Arc_differential {
  Approximate_point<Dim> tangent; ///< of unit length, in the arc's direction
  double curvature = 0;           ///< signed in the plane: positive where the arc turns left
};

/// Points of an arc where one foot stands still, in order; `complete` is false where some stretch stayed open.
template <int Dim>
struct Irregular_points {
  std::vector<Arc_point<Dim>> points;
  bool complete = true;
};

/// What evaluates an arc; made by the construction that found it, immutable and safe to share between threads.
template <int Dim>
class Arc_geometry {
public:
  virtual ~Arc_geometry() = default;
  virtual Arc_point<Dim> at(double x) const = 0;
  virtual Arc_differential<Dim> differential(double x) const = 0;
  virtual std::vector<Arc_point<Dim>> samples(std::size_t n) const = 0;
  virtual Polyline<Dim> polyline(double relative_tolerance) const = 0;
  virtual Irregular_points<Dim> irregular() const = 0;
};

/// A maximal arc of a locus between two vertices, or a closed loop.
template <int Dim>
class Arc {
public:
  Arc(std::shared_ptr<const Arc_geometry<Dim>> geometry, std::optional<std::size_t> source, std::optional<std::size_t> target,
      std::vector<std::size_t> inputs, std::vector<Feature> features)
    : geometry_(std::move(geometry)), source_(source), target_(target), inputs_(std::move(inputs)), features_(std::move(features))
  {
  }

  bool is_closed() const { return !source_; }
  /// Index of the end vertices in `Locus::vertices()`; none for a closed arc.
  std::optional<std::size_t> source() const { return source_; }
  std::optional<std::size_t> target() const { return target_; }
  const std::vector<std::size_t>& inputs() const { return inputs_; }
  const std::vector<Feature>& features() const { return features_; }

  /// The point at x from 0 (source) to 1 (target); the parametrisation is continuous, otherwise unspecified.
  /// At an infinite end the nearest finite point just before it is given.
  const std::shared_ptr<const Arc_geometry<Dim>>& geometry() const { return geometry_; }
  Arc_point<Dim> at(double x) const { return geometry_->at(x); }
  Arc_differential<Dim> differential(double x) const { return geometry_->differential(x); }
  /// `n` ≥ 2 points from end to end, each parameter enclosed to at least 1e-12 of the domain where doubles allow it.
  std::vector<Arc_point<Dim>> samples(std::size_t n) const { return geometry_->samples(n); }
  /// A polyline proved to lie within `relative_tolerance` times the inputs' diameter, both ways; its `error()` (in the
  /// inputs' units) says what was reached. Cost grows with the inverse square root of the tolerance.
  Polyline<Dim> polyline(double relative_tolerance) const { return geometry_->polyline(relative_tolerance); }
  /// Points where one foot stands still: the locus has a cusp there.
  Irregular_points<Dim> irregular() const { return geometry_->irregular(); }

private:
  std::shared_ptr<const Arc_geometry<Dim>> geometry_;
  std::optional<std::size_t> source_, target_;
  std::vector<std::size_t> inputs_;
  std::vector<Feature> features_;
};

/// A component of the equations that is no arc.
struct Degenerate_piece {
  std::string kind; ///< "centre", "infinity", "overlap", "everything"
  std::optional<std::size_t> input;
  std::optional<Range> parameter;
  std::vector<Range> box; ///< the inputs' parameter ranges in which it lies
  int multiplicity = 1;
  std::string reason;
};

/// Part of a rational curve's parameter that belongs to the locus: an end is a rational number or an algebraic one, enclosed.
struct Kept_interval {
  std::size_t piece = 0; ///< of the rational curve
  std::array<Range, 2> ends;
  std::array<std::optional<Rational>, 2> exact; ///< none where the end is irrational or infinite
};

/// What happens to a locus at one parameter of an input, and a part of that input between such places; see the construction.
struct Locus_event {
  std::string kind;
  std::size_t input = 0;
  Range parameter;
  int multiplicity = 1;
};
struct Locus_segment {
  std::size_t input = 0;
  Range parameters;
  bool active = false;
};

/// The boundary of a cell, a point's convex one or one of two curves': its arcs counterclockwise, of which those listed as `reversed` run clockwise themselves.
struct Cell_outline {
  std::size_t input = 0; ///< the input that is nearest inside
  std::vector<std::size_t> arcs;
  std::vector<char> reversed;
  bool bounded = false;
};

/// A two-dimensional piece of a locus.
struct Region {
  std::vector<std::size_t> arcs;
  std::string reason;
};

/// Part of the parameter domain about which nothing is claimed.
struct Undecided_piece {
  std::vector<Range> box;
  std::string reason;
};

struct Equation_info {
  std::string name;
  std::vector<int> degrees;
};

struct Locus_statistics {
  std::size_t pairs = 0, purged_pairs = 0; ///< of the inputs' pieces: looked at, and done with by their bounds alone
  std::size_t cells = 0;
  std::uint64_t exact_cells = 0;
  Filter_counts filter;
  double seconds = 0;
};

/// A cell of the subdivision, for pictures: in the inputs' parameters its bounding box and its corners, counterclockwise (a
/// cell of a blown-up corner is no box), and what was claimed of it.
struct Cell_picture {
  std::vector<Range> box;
  std::vector<std::array<double, 2>> corners;
  std::string claim; ///< "empty", "graph", "crossing", "undecided"
};

enum class Status : unsigned char { certified, undecided };

inline std::ostream& operator<<(std::ostream& out, Status s)
{
  return out << (s == Status::certified ? "certified" : "undecided");
}

/// What a construction can keep of its work so that a certificate can be written of it; each has a type of its own.
struct Locus_evidence {
  Locus_evidence() = default;
  Locus_evidence(const Locus_evidence&) = delete;
  Locus_evidence& operator=(const Locus_evidence&) = delete;
  virtual ~Locus_evidence() = default;
};

/// What a construction fills in; see `Locus` for the meanings.
template <int Dim>
struct Locus_data {
  std::string compute;
  bool trimmed = false;
  std::vector<Locus_vertex<Dim>> vertices;
  std::vector<Arc<Dim>> arcs;
  std::vector<Sheet> sheets;
  std::optional<Rational_map<Dim, 1>> rational_curve;
  std::optional<std::vector<Kept_interval>> kept; ///< all of it where there is none
  std::optional<Rational_map<Dim, 2>> rational_surface;
  std::vector<Region> regions;
  std::optional<Cell_outline> outline;
  std::vector<Locus_event> events;
  std::vector<Locus_segment> segments;
  std::vector<Degenerate_piece> degenerate;
  std::vector<Undecided_piece> undecided;
  std::vector<Equation_info> equations;
  std::vector<Cell_picture> cells;
  Locus_statistics statistics;
  double scale = 1, cut_radius = 10;
  Approximate_point<Dim> centre;
  std::shared_ptr<const Locus_evidence> evidence;
};

/// The answer of a construction: vertices, arcs and degenerate pieces, each proved, and the undecided rest. Immutable.
template <int Dim>
class Locus {
public:
  explicit Locus(Locus_data<Dim> data) : data_(std::move(data)) {}

  /// Certified, or undecided where `undecided()` lists anything.
  Status status() const { return data_.undecided.empty() ? Status::certified : Status::undecided; }
  /// The construction, e.g. "bisector", and whether least distances decided (else: all solutions of the equations).
  const std::string& compute() const { return data_.compute; }
  bool is_trimmed() const { return data_.trimmed; }
  const std::vector<Locus_vertex<Dim>>& vertices() const { return data_.vertices; }
  const std::vector<Arc<Dim>>& arcs() const { return data_.arcs; }
  /// The surfaces of a locus in space, as meshes.
  const std::vector<Sheet>& sheets() const { return data_.sheets; }
  /// The exact curve or surface, where the locus is rational; its parts at infinity included.
  const std::optional<Rational_map<Dim, 1>>& rational_curve() const { return data_.rational_curve; }
  /// The parts of the rational curve that survive trimming, by pieces; nothing where it is not trimmed.
  const std::optional<std::vector<Kept_interval>>& kept_intervals() const { return data_.kept; }
  const std::optional<Rational_map<Dim, 2>>& rational_surface() const { return data_.rational_surface; }
  const std::vector<Region>& regions() const { return data_.regions; }
  /// Of the bisector of a point and a curve, where it was asked for: `Bisector_events`.
  const std::vector<Locus_event>& events() const { return data_.events; }
  const std::vector<Locus_segment>& segments() const { return data_.segments; }
  /// Where the locus bounds the convex cell of an input, in which order.
  const std::optional<Cell_outline>& outline() const { return data_.outline; }
  const std::vector<Degenerate_piece>& degenerate() const { return data_.degenerate; }
  const std::vector<Undecided_piece>& undecided() const { return data_.undecided; }
  const std::vector<Equation_info>& equations() const { return data_.equations; }
  const Locus_statistics& statistics() const { return data_.statistics; }
  /// The cells of the subdivision, where the construction was asked to keep them.
  const std::vector<Cell_picture>& cells() const { return data_.cells; }
  /// What a certificate is written from, where the construction was asked to keep it; else null.
  const std::shared_ptr<const Locus_evidence>& evidence() const { return data_.evidence; }
  /// Diameter of the inputs (of their control polygons' bounding box).
  double scale() const { return data_.scale; }
  /// Arcs to infinity are drawn up to this distance from `centre()`, the middle of the inputs' bounding box.
  double cut_radius() const { return data_.cut_radius; }
  const Approximate_point<Dim>& centre() const { return data_.centre; }
  /// Number of connected components, of arcs as joined by common vertices; each sheet is one.
  std::size_t components() const;

private:
  Locus_data<Dim> data_;
};

template <int Dim>
std::size_t Locus<Dim>::components() const
{
  std::vector<std::size_t> parent(data_.vertices.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::size_t closed = 0;
  std::vector<char> used(data_.vertices.size(), 0);
  for (const Arc<Dim>& arc : data_.arcs) {
    if (arc.is_closed()) {
      ++closed;
      continue;
    }
    used[*arc.source()] = used[*arc.target()] = 1;
    parent[find(*arc.source())] = find(*arc.target());
  }
  std::size_t n = closed + data_.sheets.size();
  for (std::size_t i = 0; i < parent.size(); ++i)
    n += find(i) == i && (used[i] || data_.vertices[i].kind == Vertex_kind::isolated);
  return n;
}

} // namespace locus

#endif
