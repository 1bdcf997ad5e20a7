// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_SPLINE_H
#define LOCUS_FUNCTION_SPLINE_H

#include <locus/function/bernstein.h>
#include <locus/function/knots.h>
#include <locus/number/interval.h>

#include <type_traits>

namespace locus {

template <int D>
using Knot_array = std::array<Knots, static_cast<std::size_t>(D)>;

/// A piecewise polynomial in D variables in the B-spline basis: knots for each variable and the control coefficients in
/// one contiguous array whose last index runs fastest. T is a ring, as for `Bernstein`: Rational (exact), double
/// (approximate) or Interval (enclosures). Knots and parameters are rational whatever T is, so weights are computed
/// exactly and rounded once; inside a solve that uses Interval, `with_upward_rounding` holds as ever.
template <class T, int D>
class Spline {
public:
  using Coefficient = T;
  static constexpr int dimension = D;

  /// Throws std::invalid_argument unless each variable's knots are valid (`require_valid`) and there are as many
  /// coefficients as the product of their control counts.
  Spline(Knot_array<D> knots, std::vector<T> coefficients)
    : knots_(std::move(knots)), coefficients_(std::move(coefficients))
  {
    for (const Knots& k : knots_) require_valid(k);
    const std::size_t expected = coefficient_count(last_index());
    if (coefficients_.size() != expected)
      throw std::invalid_argument("Spline: the knots ask for " + std::to_string(expected) + " coefficients, not " +
                                  std::to_string(coefficients_.size()));
  }

  const Knot_array<D>& knots() const { return knots_; }
  const Knots& knots(int variable) const { return knots_[static_cast<std::size_t>(variable)]; }
  int degree(int variable = 0) const { return knots(variable).degree; }
  Degrees<D> degrees() const
  {
    Degrees<D> degrees{};
    for (std::size_t k = 0; k < degrees.size(); ++k) degrees[k] = knots_[k].degree;
    return degrees;
  }
  const std::vector<T>& coefficients() const { return coefficients_; }
  std::size_t size() const { return coefficients_.size(); }
  const T& operator[](std::size_t i) const { return coefficients_[i]; }

  /// The greatest index of a control coefficient in each variable: what `layout_along` and `advance_index` ask for.
  Degrees<D> last_index() const
  {
    Degrees<D> last{};
    for (std::size_t k = 0; k < last.size(); ++k) last[k] = knots_[k].control_count() - 1;
    return last;
  }

private:
  Knot_array<D> knots_;
  std::vector<T> coefficients_;
};

/// One cell of a spline: where it lies, and the polynomial there, on the unit cell.
template <class T, int D>
struct Spline_span {
  std::array<Rational, static_cast<std::size_t>(D)> lo, hi;
  Bernstein<T, D> form;
};

// -------------------------------------------------------------------------------------------------------- kernels

namespace detail {

template <class T>
T number_from_rational(const Rational& x)
{
  if constexpr (std::is_same_v<T, Interval>) return enclosing(x);
  else if constexpr (std::is_same_v<T, double>) return nearest_double(x);
  else return T(x);
}

/// One new coefficient as a combination of old ones that follow each other.
struct Combination {
  std::size_t first;
  std::vector<Rational> weights;
};

/// Replaces the rows of a dense array along one variable by combinations of them.
template <class T, std::size_t N>
std::vector<T> combined_along(const std::vector<T>& in, const std::array<int, N>& last, int variable,
                              const std::vector<Combination>& rows)
{
  const Layout from = layout_along(last, variable);
  std::vector<T> out(from.outer * rows.size() * from.inner, T(0));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t j = 0; j < rows[r].weights.size(); ++j) {
      if (rows[r].weights[j] == 0) continue;
      const T weight = number_from_rational<T>(rows[r].weights[j]);
      for (std::size_t o = 0; o < from.outer; ++o)
        for (std::size_t i = 0; i < from.inner; ++i)
          out[(o * rows.size() + r) * from.inner + i] +=
            weight * in[(o * from.count + rows[r].first + j) * from.inner + i];
    }
  return out;
}

/// The polar form of `from`'s polynomial on the span at `where`, as a combination of control coefficients.
inline Combination polar_combination(const Knots& from, const Rational& where, const Rational* arguments)
{
  const int span = from.span_of(where);
  return {static_cast<std::size_t>(span - from.degree), polar_weights(from, span, arguments)};
}

/// Control coefficients on the knots `to` from those on `from`: coefficient i is the polar form at the knots i+1, …,
/// i+degree of the polynomial on any span that it acts on.
inline std::vector<Combination> change_of_knots(const Knots& from, const Knots& to)
{
  std::vector<Combination> rows;
  for (int i = 0; i < to.control_count(); ++i) {
    const Rational& where = to.value(middle_span(to, i));
    rows.push_back(polar_combination(from, where, to.values.data() + i + 1));
  }
  return rows;
}

/// The same function on other knots of one variable, of the same degree, over its domain or a part of it. The knots that
/// are left out must be ones that the function does not need: no one checks, the result would be another function.
/// Every change between knots, insertion, removal, clamping, the way to Bernstein forms and back, is this one.
template <class T, int D>
Spline<T, D> on_knots(const Spline<T, D>& f, int variable, const Knots& knots)
{
  assert(knots.degree == f.degree(variable));
  Knot_array<D> all = f.knots();
  all[static_cast<std::size_t>(variable)] = knots;
  return Spline<T, D>(std::move(all), combined_along(f.coefficients(), f.last_index(), variable,
                                                     change_of_knots(f.knots(variable), knots)));
}

template <int D>
using Break_array = std::array<std::vector<Rational>, static_cast<std::size_t>(D)>;

template <int D>
Break_array<D> breaks_of(const Knot_array<D>& knots)
{
  Break_array<D> breaks;
  for (std::size_t k = 0; k < breaks.size(); ++k) breaks[k] = knots[k].breaks();
  return breaks;
}

/// Knots whose control coefficients are the Bernstein coefficients on all the spans: every break degree + 1 times.
inline Knots bernstein_knots(int degree, const std::vector<Rational>& breaks)
{
  return knots_over(degree, breaks, [](const Rational&) { return -1; });
}

/// The greatest index of a span between the breaks, in each variable.
template <int D>
Degrees<D> last_span(const Break_array<D>& breaks)
{
  Degrees<D> last{};
  for (std::size_t k = 0; k < last.size(); ++k) last[k] = static_cast<int>(breaks[k].size()) - 2;
  return last;
}

/// Calls back with the index of each control coefficient of one span, for a spline on `bernstein_knots` of these degrees
/// over a grid with this greatest span.
template <std::size_t N, class Visit>
void for_each_of_span(const std::array<int, N>& degrees, const std::array<int, N>& last, const std::array<int, N>& span,
                      Visit visit)
{
  std::array<int, N> i{};
  do {
    std::size_t at = 0;
    for (std::size_t k = 0; k < N; ++k)
      at = at * static_cast<std::size_t>((last[k] + 1) * (degrees[k] + 1)) +
           static_cast<std::size_t>(span[k] * (degrees[k] + 1) + i[k]);
    visit(at);
  } while (advance_index(i, degrees));
}

/// Bernstein forms on the cells between breaks that include all those of f inside their range.
template <class T, int D>
std::vector<Spline_span<T, D>> spans_between(Spline<T, D> f, const Break_array<D>& breaks)
{
  for (int k = 0; k < D; ++k) f = on_knots(f, k, bernstein_knots(f.degree(k), breaks[static_cast<std::size_t>(k)]));
  const Degrees<D> last = last_span<D>(breaks);
  std::vector<Spline_span<T, D>> spans;
  Degrees<D> cell{};
  do {
    Spline_span<T, D> span{{}, {}, Bernstein<T, D>(f.degrees())};
    for (std::size_t k = 0; k < cell.size(); ++k) {
      span.lo[k] = breaks[k][static_cast<std::size_t>(cell[k])];
      span.hi[k] = breaks[k][static_cast<std::size_t>(cell[k]) + 1];
    }
    std::size_t n = 0;
    for_each_of_span(f.degrees(), last, cell, [&](std::size_t at) { span.form[n++] = f[at]; });
    spans.push_back(std::move(span));
  } while (advance_index(cell, last));
  return spans;
}

} // namespace detail

// ------------------------------------------------------------------------------------- what can be asked of a spline

/// Value at a point of rational coordinates, by de Boor's recursion in one variable after the other: O(degree²) for the
/// weights, and (degree+1) times the control counts of the variables that follow. At a jump it is the value from above,
/// at the domain's upper end the one from below. Throws std::invalid_argument outside the domain.
template <class T, int D>
T evaluate(const Spline<T, D>& f, const std::array<Rational, static_cast<std::size_t>(D)>& point)
{
  std::vector<T> values = f.coefficients();
  Degrees<D> last = f.last_index();
  for (std::size_t k = 0; k < point.size(); ++k) {
    const int variable = static_cast<int>(k);
    const std::vector<Rational> arguments(static_cast<std::size_t>(f.degree(variable)), point[k]);
    values = detail::combined_along(values, last, variable,
                                    {detail::polar_combination(f.knots(variable), point[k], arguments.data())});
    last[k] = 0;
  }
  return values[0];
}

template <class T>
T evaluate_at(const Spline<T, 1>& f, const Rational& u)
{
  return evaluate(f, std::array<Rational, 1>{u});
}

/// The polynomials that a spline consists of, cell by cell in order, the last variable fastest; spans of length zero are
/// left out. For each of their coefficients, degree+1 products in each variable; weights in O(degree²) each.
template <class T, int D>
std::vector<Spline_span<T, D>> bezier_spans(const Spline<T, D>& f)
{
  return detail::spans_between(f, detail::breaks_of<D>(f.knots()));
}

} // namespace locus

#endif
