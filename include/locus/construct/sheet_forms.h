// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_FORMS_H
#define LOCUS_CONSTRUCT_SHEET_FORMS_H

#include <locus/construct/approximate_point.h>
#include <locus/function/bernstein_operations.h>
#include <locus/number/interval.h>
#include <locus/shape/rational_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace locus::detail {

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
    Interval *const low = parts.first.coefficients_.data(), *const high = parts.second.coefficients_.data();
    split_kernel(coefficients_.data(), low, high, layout, half);
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

/// The weight must not contain zero, else the bound is not finite.
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

} // namespace locus::detail

#endif
