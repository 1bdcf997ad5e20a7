// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_RATIONAL_MAP_H
#define LOCUS_SHAPE_RATIONAL_MAP_H

#include <locus/function/polynomial_vector.h>
#include <locus/shape/rational_curve.h>

namespace locus {

/// One piece of a rational map from K parameters to Dim dimensions: the point is numerator / weight, Bernstein forms of one
/// and the same degrees on the unit cell, which lies on `range`. Unlike a curve's, its weight may vanish: there the image is
/// at infinity, or, where the numerator vanishes as well, not determined by this map.
template <int Dim, int K>
struct Rational_map_piece {
  Polynomial_vector<K, static_cast<std::size_t>(Dim)> numerator;
  Bernstein<Rational, K> weight;
  std::array<Piece, static_cast<std::size_t>(K)> range;

  const Degrees<K>& degrees() const { return weight.degrees(); }
};

/// A curve (K = 1) or surface (K = 2) derived from exact input, piece by piece. Immutable.
template <int Dim, int K>
class Rational_map {
public:
  Rational_map() = default;
  explicit Rational_map(std::vector<Rational_map_piece<Dim, K>> pieces) : pieces_(std::move(pieces)) {}

  const std::vector<Rational_map_piece<Dim, K>>& pieces() const { return pieces_; }

  /// The greatest degree of a piece in each parameter.
  Degrees<K> degrees() const
  {
    Degrees<K> d{};
    for (const auto& piece : pieces_) d = detail::max_degrees<K>(d, piece.degrees());
    return d;
  }

private:
  std::vector<Rational_map_piece<Dim, K>> pieces_;
};

namespace detail {

/// The common factor of polynomials in one variable; a constant where there is none.
template <std::size_t N>
Integer_polynomial common_factor(const Polynomial_vector<1, N>& forms)
{
  Integer_polynomial common;
  for (const auto& f : forms) {
    if (is_zero(f)) continue;
    common = gcd(common, monomial_form(Bernstein<Scaled_integer, 1>(f)));
    if (degree(common) == 0) return common;
  }
  return common;
}

/// The forms without their common factor.
template <std::size_t N>
Polynomial_vector<1, N> without_common_factor(const Polynomial_vector<1, N>& forms)
{
  const Integer_polynomial common = common_factor(forms);
  if (degree(common) < 1) return forms;
  const Bernstein<Rational, 1> divisor = bernstein_form(common).rational();
  return vector_of<N>([&](std::size_t k) { return is_zero(forms[k]) ? forms[k] : divide_exactly(forms[k], divisor); });
}

} // namespace detail

/// A piece of given homogeneous coordinates: all at the least degrees that they have in common. In one variable their common
/// factor is divided out.
template <int Dim, int K>
Rational_map_piece<Dim, K> rational_map_piece(Polynomial_vector<K, static_cast<std::size_t>(Dim)> numerator,
                                              Bernstein<Rational, K> weight,
                                              const std::array<Piece, static_cast<std::size_t>(K)>& range)
{
  constexpr auto n = static_cast<std::size_t>(Dim);
  auto all = detail::vector_of<n + 1>([&](std::size_t k) { return at_true_degree(k < n ? numerator[k] : weight); });
  if constexpr (K == 1) all = detail::without_common_factor(all);
  Degrees<K> degrees{};
  for (const auto& f : all) degrees = detail::max_degrees<K>(degrees, f.degrees());
  Rational_map_piece<Dim, K> piece;
  for (std::size_t k = 0; k < n; ++k) piece.numerator[k] = detail::elevated_to(std::move(all[k]), degrees);
  piece.weight = detail::elevated_to(std::move(all[n]), degrees);
  piece.range = range;
  return piece;
}

/// The image of a point of the unit cell, exactly; nothing where the weight vanishes.
template <int Dim, int K>
std::optional<Exact_point<Dim>> image(const Rational_map_piece<Dim, K>& piece,
                                      const std::array<Rational, static_cast<std::size_t>(K)>& at)
{
  const Rational w = evaluate(piece.weight, at);
  if (w == 0) return std::nullopt;
  Exact_point<Dim> p;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = evaluate(piece.numerator[k], at) / w;
  return p;
}

} // namespace locus

#endif
