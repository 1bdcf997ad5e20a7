// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_REQUIREMENT_H
#define LOCUS_ZERO_SET_REQUIREMENT_H

#include <locus/function/enclosed_vector.h>
#include <locus/function/lazy.h>
#include <locus/zero_set/least_sign.h>

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace locus {

/// A vector of polynomials on the unit interval with its parts on dyadic intervals, made when they are first asked for.
/// Not for sharing between threads.
class Vector_tree {
public:
  struct Node {
    double lo, hi;
    Enclosed_vector f;
    std::size_t children = 0; ///< index of the lower half; the upper one follows; none where 0
    std::optional<Vector_form> exact;

    double width() const { return hi - lo; }
  };

  /// Upward rounding needed.
  explicit Vector_tree(Vector_form f) : exact_(of_one_degree(std::move(f))) { nodes_.push_back({0, 1, Enclosed_vector(exact_.get()), 0, {}}); }
  /// From an enclosure; the exact form, of the same degree, is made when it is first needed.
  Vector_tree(Enclosed_vector f, std::function<Vector_form()> make_exact)
    : exact_(Lazy<Vector_form>::from([make = std::move(make_exact)] { return of_one_degree(make()); }))
  {
    nodes_.push_back({0, 1, std::move(f), 0, {}});
  }

  /// Safe to ask for from several threads, unlike all else.
  const Vector_form& exact() const { return exact_.get(); }
  const Lazy<Vector_form>& lazy_exact() const { return exact_; }
  const Node& node(std::size_t i) const { return nodes_[i]; }

  /// Values at a place enclosed afresh, without what subdivision from the whole interval would inherit; nothing where there is
  /// no way.
  std::optional<std::vector<Interval>> fresh_at(double x) const { return make_fresh_ ? std::optional(make_fresh_(x)) : std::nullopt; }
  void set_fresh(std::function<std::vector<Interval>(double)> make_fresh) { make_fresh_ = std::move(make_fresh); }

  /// Index of the lower half; the upper one follows.
  std::size_t halve(std::size_t i)
  {
    if (nodes_[i].children) return nodes_[i].children;
    auto parts = nodes_[i].f.halves();
    const double lo = nodes_[i].lo, hi = nodes_[i].hi, middle = 0.5 * (lo + hi);
    nodes_[i].children = nodes_.size();
    nodes_.push_back({lo, middle, std::move(parts.first), 0, {}});
    nodes_.push_back({middle, hi, std::move(parts.second), 0, {}});
    return nodes_[i].children;
  }

  /// The vector on a node's interval.
  const Vector_form& exact_on(std::size_t i)
  {
    Node& n = nodes_[i];
    if (!n.exact) n.exact = part(n.lo, n.hi);
    return *n.exact;
  }

  Vector_form part(double lo, double hi) const
  {
    if (lo == 0 && hi == 1) return exact();
    Vector_form f;
    for (const auto& x : exact()) f.push_back(restrict_to(x, 0, Rational(lo), Rational(hi)));
    return f;
  }

private:
  Lazy<Vector_form> exact_;
  std::function<std::vector<Interval>(double)> make_fresh_;
  std::deque<Node> nodes_;
};

/// Which coefficients next to a corner (u end, v end) of the unit square are exactly zero: the corner's own, and, where it is,
/// the next one in u and in v. Halving at the corner keeps that.
struct Corner_zeros {
  bool here = false, next_u = false, next_v = false;
};

/// a(u)·b(v) ≥ 0 for all v of the unit interval is required of u. Several requirements may share a and b.
/// With a `square`, of one component, and a `rest`, of a's rank and degree, it is √square(u)·a(u)·b(v) + rest(u)·b(v) ≥ 0; then
/// the square is positive on the unit interval, and a(u)·b(v) nowhere negative on the unit square.
struct Requirement {
  std::shared_ptr<Vector_tree> a, b;
  /// What is known beforehand of corners of the unit square, index 2·(u end) + (v end).
  std::array<std::optional<Corner_zeros>, 4> corners{};
  /// Another product, (u - v)² times this one, if there is one that is enclosed more closely.
  std::shared_ptr<Vector_tree> apart_a{}, apart_b{};
  std::shared_ptr<Vector_tree> square{}, rest{};
};

namespace detail {

inline Rational dot_at(const Vector_form& a, std::size_t i, const Vector_form& b, std::size_t j)
{
  Rational sum = 0;
  for (std::size_t r = 0; r < a.size(); ++r) sum += a[r][i] * b[r][j];
  return sum;
}

/// a(u)·b(v) as a polynomial in v at a rational u.
inline Bernstein<Rational, 1> product_at(const Vector_form& a, const Rational& u, const Vector_form& b)
{
  Bernstein<Rational, 1> sum(b[0].degrees());
  for (std::size_t r = 0; r < a.size(); ++r) {
    const Rational x = evaluate_at(a[r], u);
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += x * b[r][j];
  }
  return sum;
}

inline Corner_zeros corner_zeros(const Vector_form& a, const Vector_form& b, int end_u, int end_v)
{
  const std::size_t n = a[0].size() - 1, m = b[0].size() - 1, i = end_u ? n : 0, j = end_v ? m : 0;
  Corner_zeros z;
  z.here = dot_at(a, i, b, j) == 0;
  if (!z.here) return z;
  z.next_u = n > 0 && dot_at(a, end_u ? n - 1 : 1, b, j) == 0;
  z.next_v = m > 0 && dot_at(a, i, b, end_v ? m - 1 : 1) == 0;
  return z;
}

/// a(u)·b(v).
inline Bernstein<Rational, 2> product_of(const Vector_form& a, const Vector_form& b)
{
  Bernstein<Rational, 2> g(Degrees<2>{a[0].degree(), b[0].degree()});
  for (int i = 0; i <= g.degree(0); ++i)
    for (int j = 0; j <= g.degree(1); ++j) g.at({i, j}) = dot_at(a, static_cast<std::size_t>(i), b, static_cast<std::size_t>(j));
  return g;
}

/// What is required to be ≥ 0; with a root, times the same expression with -√: it vanishes wherever the requirement's own does.
inline Bernstein<Rational, 2> form_of(const Requirement& r)
{
  const Bernstein<Rational, 2> g = product_of(r.a->exact(), r.b->exact());
  if (!r.square) return g;
  const Bernstein<Rational, 1>& s = r.square->exact()[0];
  const Bernstein<Rational, 2> square(Degrees<2>{s.degree(), 0}, s.coefficients()), rest = product_of(r.rest->exact(), r.b->exact());
  return subtract(multiply(square, multiply(g, g)), multiply(rest, rest));
}

inline Corner_zeros corner_zeros(const Requirement& r, int end_u, int end_v)
{
  Corner_zeros z = corner_zeros(r.a->exact(), r.b->exact(), end_u, end_v);
  if (!r.square) return z;
  const Corner_zeros rest = corner_zeros(r.rest->exact(), r.b->exact(), end_u, end_v);
  return {z.here && rest.here, z.next_u && rest.next_u, z.next_v && rest.next_v};
}

/// What stands before b(v) at a double u. Holds in any rounding mode.
inline Enclosed_vector factor_at(const Requirement& r, double u)
{
  Enclosed_vector a = r.a->node(0).f.at(u);
  if (!r.square) return a;
  const Enclosed_vector square = r.square->node(0).f.at(u);
  const double s = square.component(0)[0];
  if (!(s > square.error())) return {a.rank(), 0, std::vector<double>(a.rank(), 0.0), std::numeric_limits<double>::infinity()};
  const double root = std::sqrt(s), error = (square.error() / root + operation_error * root) * (1 + 8 * operation_error);
  return combined(Bernstein<Bounded, 1>(Bernstein<double, 1>(Degrees<1>{0}, {root}), error), a, r.rest->node(0).f.at(u));
}

} // namespace detail

} // namespace locus

#endif
