// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_LOCAL_FORMS_H
#define LOCUS_ZERO_SET_LOCAL_FORMS_H

#include <locus/function/bounded_bernstein.h>
#include <locus/number/dyadic_interval.h>
#include <locus/zero_set/system.h>

#include <cmath>
#include <map>
#include <memory>

namespace locus {
namespace detail {

/// Ends of the point solver's boxes are multiples of this, from -1 to 2, so that their differences are exact.
inline constexpr double box_grid = 0x1p-50;

inline double grid_below(double x) { return std::floor(x / box_grid) * box_grid; }
inline double grid_above(double x) { return std::ceil(x / box_grid) * box_grid; }

/// Coefficients on the part [a, b] of one variable, of ends that are quotients: each is within a rounding of the truth.
template <int D>
Bernstein<Bounded, D> part_of(const Bernstein<Bounded, D>& f, int variable, double a, double b)
{
  if (a == 0 && b == 1) return f;
  const double n = f.degree(variable);
  Bernstein<Bounded, D> part = a == 0   ? split(f, variable, b).first
                               : b == 1 ? split(f, variable, a).second
                                        : restrict_to(f, variable, a, b);
  const double reach = std::max({1.0, std::abs(a) + std::abs(1 - a), std::abs(b) + std::abs(1 - b)});
  const double shift = 4 * operation_error * reach * 2 * n * f.norm() * std::pow(reach, n);
  return {part.values(), accumulated_error(part.error() + shift, 0, 0)};
}

/// Coefficients on `box` of a polynomial that is given on another one; both have their ends on the grid.
template <int D>
Bernstein<Bounded, D> moved_to(const Box<D>& box, Bernstein<Bounded, D> f, const Box<D>& from)
{
  for (int v = 0; v < D; ++v) {
    const auto vv = static_cast<std::size_t>(v);
    const double width = from.width(v);
    f = part_of(f, v, (box.lo[vv] - from.lo[vv]) / width, (box.hi[vv] - from.lo[vv]) / width);
  }
  return f;
}

/// Whether the error bound of a form exceeds this part of its greatest coefficient.
template <int D>
bool is_blurred(const Bernstein<Bounded, D>& f, double part)
{
  double most = 0;
  for (const double c : f.values().coefficients()) most = std::max(most, std::abs(c));
  return !(f.error() <= part * most);
}

template <int D>
using Dyadic_form = Bernstein<Dyadic_interval, D>;

/// The least e such that all coefficients are below 2^e; 0 for zero.
template <int D>
long exponent_of(const Dyadic_form<D>& f)
{
  long most = Dyadic_interval::zero_exponent;
  for (const Dyadic_interval& c : f.coefficients()) most = std::max(most, c.exponent());
  return most == Dyadic_interval::zero_exponent ? 0 : most;
}

/// In doubles, times a power of two that makes the greatest coefficient about one.
template <int D>
Bernstein<Bounded, D> rounded(const Dyadic_form<D>& f)
{
  const long exponent = exponent_of(f);
  return bounded(converted<Interval>(f, [&](const Dyadic_interval& c) { return c.enclosing_interval(-exponent); }));
}

/// One equation's forms on small boxes, as sharp as they are needed: enclosed afresh in doubles, else computed from the
/// exact coefficients in long dyadic intervals and rounded at the end. All differ by positive factors only.
template <int D>
class Sharp_forms {
public:
  Sharp_forms(std::shared_ptr<const Equation<D>> equation, std::size_t max_bits)
    : equation_(std::move(equation)), max_bits_(max_bits)
  {
  }

  /// A form on `box` whose error bound is at most `part` (2^-50 or more) of its greatest coefficient, or zero. Nothing if
  /// that takes more bits than allowed.
  std::optional<Bernstein<Bounded, D>> on(const Box<D>& box, double part)
  {
    auto f = bounded(equation_->enclosure(box));
    for (std::size_t bits = 106; is_blurred(f, part); bits *= 2) {
      if (bits > max_bits_) return std::nullopt;
      f = rounded(in_dyadic_intervals(box, bits));
    }
    return f;
  }

  /// The form on `box` with this many bits.
  Dyadic_form<D> in_dyadic_intervals(const Box<D>& box, std::size_t bits)
  {
    Form f = whole(bits);
    for (int v = 0; v < D; ++v) {
      const auto vv = static_cast<std::size_t>(v);
      if (box.lo[vv] != 0 || box.hi[vv] != 1) f = restricted(f, v, box.lo[vv], box.hi[vv], bits);
    }
    return f;
  }

  /// The allowed bits, or what suffices to tell the equation on boxes of the grid from others of its size, if that is less:
  /// about the length of a determinant of such coefficients there.
  std::size_t enough_bits() const
  {
    std::size_t size = 0, degree = 0;
    for (const Integer& c : equation_->exact().values().coefficients())
      size = std::max(size, mpz_sizeinbase(c.get_mpz_t(), 2));
    for (const int n : equation_->degrees()) degree += static_cast<std::size_t>(n);
    return std::min(max_bits_, static_cast<std::size_t>(D) * (size + 50 * degree) + 106);
  }

private:
  using Form = Dyadic_form<D>;

  /// The whole polynomial, with coefficients below one.
  const Form& whole(std::size_t bits)
  {
    const auto [at, is_new] = whole_.try_emplace(bits);
    if (is_new) {
      const auto& exact = equation_->exact().values();
      std::size_t size = 0;
      for (const Integer& c : exact.coefficients()) size = std::max(size, mpz_sizeinbase(c.get_mpz_t(), 2));
      at->second = converted<Dyadic_interval>(exact, [&](const Integer& c) {
        return Dyadic_interval(c, static_cast<long>(size), static_cast<mpfr_prec_t>(bits));
      });
    }
    return at->second;
  }

  static Form restricted(const Form& f, int variable, double lo, double hi, std::size_t bits)
  {
    const auto precision = static_cast<mpfr_prec_t>(bits);
    const Dyadic_interval one(1), a(lo, precision), b(hi, precision);
    if (lo <= 0.5) return split(split(f, variable, a).second, variable, (b - a) / (one - a)).first;
    return split(split(f, variable, b).first, variable, a / b).second;
  }

  std::shared_ptr<const Equation<D>> equation_;
  std::size_t max_bits_;
  std::map<std::size_t, Form> whole_;
};

/// Σ of a partial derivative's coefficients on the faces across its variable: a multiple of its mean.
template <int D>
Dyadic_interval slope_sum(const Dyadic_form<D>& f, int variable)
{
  const Layout layout = layout_along(f.degrees(), variable);
  Dyadic_interval sum(0);
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t i = 0; i < layout.inner; ++i) {
      const Dyadic_interval* const c = f.data() + o * layout.count * layout.inner + i;
      sum += c[(layout.count - 1) * layout.inner] - c[0];
    }
  return sum;
}

/// About a/b, in doubles; zero where b may be zero.
inline double approximate_quotient(const Dyadic_interval& a, const Dyadic_interval& b)
{
  const long exponent = b.exponent();
  const double quotient = midpoint(a.enclosing_interval(-exponent)) / midpoint(b.enclosing_interval(-exponent));
  return std::isfinite(quotient) ? quotient : 0;
}

/// Subtracts multiples of one form from others so that their mean gradients become a triangular matrix, each time what
/// doubles can tell of the factor, until all digits are used up. The common zeros stay the same.
template <int D>
void make_triangular(std::array<Dyadic_form<D>, static_cast<std::size_t>(D)>& f, std::size_t bits)
{
  const auto weight = [](const Dyadic_form<D>& g, int v) { return slope_sum(g, v).exponent() - exponent_of(g); };
  for (std::size_t c = 0; c + 1 < f.size(); ++c) {
    const int v = static_cast<int>(c);
    for (std::size_t r = c + 1; r < f.size(); ++r)
      if (weight(f[r], v) > weight(f[c], v)) std::swap(f[r], f[c]);
    for (std::size_t r = c + 1; r < f.size(); ++r)
      for (std::size_t pass = 0; pass < bits; pass += 48) {
        const Dyadic_interval factor(approximate_quotient(slope_sum(f[r], v), slope_sum(f[c], v)), 53);
        for (std::size_t i = 0; i < f[r].size(); ++i) f[r][i] -= factor * f[c][i];
      }
  }
}

/// Forms on `box` of a system with the same solutions, the equations of which are far from multiples of each other: so
/// much alike as they are, what they differ by is found with more bits before it is rounded. Nothing if that takes more
/// bits than allowed.
template <int K>
std::optional<std::array<Bernstein<Bounded, K>, static_cast<std::size_t>(K)>>
untangled(std::vector<Sharp_forms<K>>& equations, const Box<K>& box, double part)
{
  std::size_t most = 0;
  for (const auto& f : equations) most = std::max(most, f.enough_bits());
  for (std::size_t bits = 106; bits <= most; bits *= 2) {
    std::array<Dyadic_form<K>, static_cast<std::size_t>(K)> f;
    Degrees<K> degrees{};
    for (std::size_t k = 0; k < f.size(); ++k) {
      f[k] = equations[k].in_dyadic_intervals(box, bits);
      degrees = max_degrees<K>(degrees, f[k].degrees());
    }
    for (auto& g : f) g = elevated_to(std::move(g), degrees);
    make_triangular<K>(f, bits);
    std::array<Bernstein<Bounded, K>, static_cast<std::size_t>(K)> result;
    bool is_sharp = true;
    for (std::size_t k = 0; k < f.size(); ++k) {
      result[k] = rounded(f[k]);
      is_sharp = is_sharp && !is_blurred(result[k], part);
    }
    if (is_sharp) return result;
  }
  return std::nullopt;
}

} // namespace detail
} // namespace locus

#endif
