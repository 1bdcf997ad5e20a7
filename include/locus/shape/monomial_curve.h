// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_MONOMIAL_CURVE_H
#define LOCUS_SHAPE_MONOMIAL_CURVE_H

#include <locus/shape/cusps.h>

namespace locus {

/// An interval of a parameter; an end that is not there is infinite.
struct Parameter_domain {
  std::optional<Rational> lo, hi;

  bool is_whole_line() const { return !lo && !hi; }
};

namespace detail {

/// Numerators and weight as coefficients of 1, u, u², …, without a common factor, all of one length, the least.
template <int Dim>
struct Monomial_forms {
  std::array<Coefficient_list, static_cast<std::size_t>(Dim)> numerator;
  Coefficient_list weight;
};

template <int Dim>
Monomial_forms<Dim> reduced_forms(const std::array<Coefficient_list, static_cast<std::size_t>(Dim)>& coordinates,
                                  const Coefficient_list& weight)
{
  std::size_t size = std::max<std::size_t>(weight.size(), 1);
  for (const auto& x : coordinates) size = std::max(size, x.size());
  const auto on_unit = [&](Coefficient_list f) {
    f.resize(size, Rational(0));
    return from_monomial(f);
  };
  Curve_piece<Dim> piece;
  for (std::size_t v = 0; v < coordinates.size(); ++v) piece.numerator[v] = on_unit(coordinates[v]);
  piece.weight = on_unit(weight);
  if (is_zero(piece.weight))
    throw Invalid_input(".monomial.w", "the denominator is zero", "leave \"w\" out for a polynomial curve");
  if (is_single_point(piece)) throw Invalid_input(".monomial", "the curve is a single point", "use a point input instead");
  remove_common_factor(piece);
  Monomial_forms<Dim> forms;
  for (std::size_t v = 0; v < coordinates.size(); ++v) forms.numerator[v] = to_monomial(piece.numerator[v]);
  forms.weight = to_monomial(piece.weight);
  const auto needed = [](const Coefficient_list& f) {
    std::size_t n = f.size();
    while (n > 0 && f[n - 1] == 0) --n;
    return n;
  };
  size = needed(forms.weight);
  for (const auto& x : forms.numerator) size = std::max(size, needed(x));
  for (auto& x : forms.numerator) x.resize(size, Rational(0));
  forms.weight.resize(size, Rational(0));
  return forms;
}

/// The pieces of a domain cut at increasing values inside it. Towards an infinite end there is one more cut, one unit
/// beyond the last value, and at least at 1 (or -1): a projective piece begins at a value of its sign.
inline std::vector<Piece> ranges_over(const Parameter_domain& domain, const std::vector<Rational>& cuts)
{
  std::vector<Rational> values;
  if (domain.lo) values.push_back(*domain.lo);
  values.insert(values.end(), cuts.begin(), cuts.end());
  if (domain.hi) values.push_back(*domain.hi);
  if (!domain.lo) {
    const Rational cut = values.empty() ? Rational(-1) : Rational(values.front() - 1);
    values.insert(values.begin(), std::min(cut, Rational(-1)));
  }
  if (!domain.hi) values.push_back(std::max(Rational(values.back() + 1), Rational(1)));
  std::vector<Piece> ranges;
  if (!domain.lo) ranges.push_back(range_from_infinity(values.front()));
  for (std::size_t i = 1; i < values.size(); ++i) ranges.push_back(finite_range(values[i - 1], values[i]));
  if (!domain.hi) ranges.push_back(range_to_infinity(values.back()));
  return ranges;
}

template <int Dim>
Curve_piece<Dim> piece_over(const Piece& range, const Monomial_forms<Dim>& forms)
{
  Curve_piece<Dim> piece;
  for (std::size_t v = 0; v < piece.numerator.size(); ++v) piece.numerator[v] = form_on(range, forms.numerator[v]);
  piece.weight = form_on(range, forms.weight);
  return piece;
}

/// The poles on a range, its ends included. Throws Unsupported_feature for one at an irrational parameter.
inline void collect_poles(const Bernstein<Rational, 1>& weight, const Piece& range, std::vector<Rational>& values)
{
  if (all_of_one_sign(weight)) return;
  for (const auto& root : exact_roots(Bernstein<Scaled_integer, 1>(weight), Rational(0), Rational(1)).roots) {
    const auto s = rational_value(root);
    if (!s)
      throw Unsupported_feature("a curve with a pole at an irrational parameter, near u = " +
                                std::to_string(range.at(near_value(root))->get_d()));
    if (const auto u = range.at(*s)) values.push_back(*u);
  }
}

/// Where a curve must be cut inside its domain: at poles, and where it stands still at a rational parameter.
template <int Dim>
std::vector<Rational> necessary_cuts(const Parameter_domain& domain, const Monomial_forms<Dim>& forms)
{
  std::vector<Rational> values;
  for (const Piece& range : ranges_over(domain, {})) {
    const Curve_piece<Dim> piece = piece_over(range, forms);
    collect_poles(piece.weight, range, values);
    for (const Rational& s : rational_cusps(piece)) values.push_back(*range.at(s));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (domain.lo && !values.empty() && values.front() == *domain.lo) values.erase(values.begin());
  if (domain.hi && !values.empty() && values.back() == *domain.hi) values.pop_back();
  return values;
}

/// Whether a chain of pieces reaches infinity at one of its ends.
template <int Dim>
bool ends_at_infinity(const std::vector<Curve_piece<Dim>>& pieces)
{
  const auto& last = pieces.back().weight;
  return pieces.front().weight[0] == 0 || last[last.size() - 1] == 0;
}

} // namespace detail

/// The curve whose coordinates are given by coefficients of 1, u, u², …, divided by the weight's if there are any, on a
/// bounded, half-infinite or infinite domain. A common factor is divided out.
/// - Towards an infinite end the last piece is projective (see `Piece`); there, and at poles, the curve may reach infinity.
/// - A pole splits the domain: its joint is of the kind `pole`, or an end of the domain lies at infinity. An irrational one
///   throws Unsupported_feature with its place.
/// - On the whole line the curve is closed through u = ∞ if its point there is finite. `closed` on another domain: the
///   curve ends exactly where it starts.
/// - It is cut where it stands still at a rational parameter inside the domain (see `split_at_cusps`).
/// Throws Invalid_input for an empty domain, a zero denominator, a single point, or a closed curve whose ends differ or lie
/// at infinity. Time: O(degree³) operations on rationals, and the isolation of the poles.
template <int Dim>
Rational_curve<Dim> monomial_curve(const std::array<std::vector<Rational>, static_cast<std::size_t>(Dim)>& coordinates,
                                   const std::vector<Rational>& weight, const Parameter_domain& domain, bool closed = false)
{
  if (domain.lo && domain.hi && *domain.lo >= *domain.hi)
    throw Invalid_input(".domain", "the interval is empty", "let the first number be less than the second");
  const auto forms = detail::reduced_forms<Dim>(coordinates, weight.empty() ? std::vector<Rational>{Rational(1)} : weight);
  std::vector<Piece> ranges = detail::ranges_over(domain, detail::necessary_cuts(domain, forms));
  std::vector<Curve_piece<Dim>> pieces;
  for (const Piece& range : ranges) {
    pieces.push_back(detail::piece_over(range, forms));
    detail::normalise(pieces.back());
  }
  const bool at_infinity = detail::ends_at_infinity(pieces);
  if (closed && at_infinity)
    throw Invalid_input(".closed", "the curve ends at infinity",
                        "leave out \"closed\", or give a domain without poles at its ends");
  return joined_curve(std::move(pieces), std::move(ranges), closed || (domain.is_whole_line() && !at_infinity));
}

} // namespace locus

#endif
