// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_SHAPE_UNREDUCED_QUOTIENT_H
#define LOCUS_SHAPE_UNREDUCED_QUOTIENT_H

#include <locus/function/polynomial_vector.h>

#include <memory>
#include <stdexcept>

namespace locus {

namespace detail {

/// The derivative of a constant: it has no degree, so that its products do not raise those of a sum.
inline bool is_zero_constant(const Bernstein<Rational, 1>& f) { return f.degree() == 0 && f[0] == 0; }

/// Product and sum at their formal degrees: no coefficient of higher degree is asked whether it vanishes.
inline Bernstein<Rational, 1> formal_product(const Bernstein<Rational, 1>& f, const Bernstein<Rational, 1>& g)
{
  if (is_zero_constant(f) || is_zero_constant(g)) return Bernstein<Rational, 1>(Degrees<1>{0});
  return multiply(f, g);
}

inline Bernstein<Rational, 1> formal_sum(const Bernstein<Rational, 1>& f, const Bernstein<Rational, 1>& g)
{
  if (is_zero_constant(f)) return g;
  return is_zero_constant(g) ? f : add(f, g);
}

inline Bernstein<Rational, 1> formal_difference(const Bernstein<Rational, 1>& f, const Bernstein<Rational, 1>& g)
{
  return formal_sum(f, multiply(g, Rational(-1)));
}

/// a·d - b·c at its formal degree.
inline Bernstein<Rational, 1> formal_minor(const Bernstein<Rational, 1>& a, const Bernstein<Rational, 1>& b,
                                           const Bernstein<Rational, 1>& c, const Bernstein<Rational, 1>& d)
{
  return formal_difference(formal_product(a, d), formal_product(b, c));
}

template <std::size_t N>
Polynomial_vector<1, N> formal_product(const Bernstein<Rational, 1>& f, const Polynomial_vector<1, N>& a)
{
  return vector_of<N>([&](std::size_t k) { return formal_product(f, a[k]); });
}

template <std::size_t N>
Polynomial_vector<1, N> formal_sum(const Polynomial_vector<1, N>& a, const Polynomial_vector<1, N>& b)
{
  return vector_of<N>([&](std::size_t k) { return formal_sum(a[k], b[k]); });
}

template <std::size_t N>
Bernstein<Rational, 1> formal_dot(const Polynomial_vector<1, N>& a, const Polynomial_vector<1, N>& b)
{
  Bernstein<Rational, 1> sum(Degrees<1>{0});
  for (std::size_t k = 0; k < N; ++k) sum = formal_sum(sum, formal_product(a[k], b[k]));
  return sum;
}

inline Bernstein<Rational, 1> formal_bracket(const Polynomial_vector<1, 2>& a, const Polynomial_vector<1, 2>& b)
{
  return formal_minor(a[0], a[1], b[0], b[1]);
}

inline Polynomial_vector<1, 3> formal_cross(const Polynomial_vector<1, 3>& a, const Polynomial_vector<1, 3>& b)
{
  return vector_of<3>([&](std::size_t k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    return formal_minor(a[i], a[j], b[i], b[j]);
  });
}

} // namespace detail

/// N rational functions over one denominator by the rules of symbolic NURBS computation (Chen, Riesenfeld & Cohen, §1):
/// products and sums multiply out, a derivative is by the quotient rule, and nothing is ever cancelled. What the degree
/// becomes is the measure that derived objects of least degree are compared with; it serves for nothing else.
/// The numerators are raised to one degree, no lower than the denominator's. A lower denominator stays as it is, like a
/// polynomial's constant 1; the paper's 3d-3 for the evolute of a polynomial curve counts so.
template <std::size_t N>
class Unreduced_quotient {
public:
  using Form = Bernstein<Rational, 1>;

  explicit Unreduced_quotient(Polynomial_vector<1, N> numerator, const Form& denominator = constant_one())
    : Unreduced_quotient(std::move(numerator), std::make_shared<const Form>(denominator))
  {}

  /// Quotients over one and the same denominator are added without raising their degree (§1, footnote 2).
  Unreduced_quotient(Polynomial_vector<1, N> numerator, std::shared_ptr<const Form> denominator)
    : numerator_(std::move(numerator)), denominator_(std::move(denominator))
  {
    if (denominator_->degree() == 0) divide_by_constant();
    Degrees<1> degrees = denominator_->degrees();
    for (const Form& f : numerator_) degrees = detail::max_degrees<1>(degrees, f.degrees());
    for (Form& f : numerator_) f = detail::elevated_to(std::move(f), degrees);
  }

  const Polynomial_vector<1, N>& numerator() const { return numerator_; }
  const Form& denominator() const { return *denominator_; }
  const std::shared_ptr<const Form>& shared_denominator() const { return denominator_; }
  int degree() const { return numerator_[0].degree(); } ///< the formal one
  bool is_polynomial() const { return denominator_->degree() == 0; }

  bool has_denominator_of(const Unreduced_quotient& other) const
  {
    return denominator_ == other.denominator_ || (is_polynomial() && other.is_polynomial());
  }

private:
  static Form constant_one() { return Form(Degrees<1>{0}, {Rational(1)}); }

  void divide_by_constant()
  {
    const Rational c = (*denominator_)[0];
    if (c == 0) throw std::domain_error("Unreduced_quotient: the denominator is zero");
    if (c == 1) return;
    for (Form& f : numerator_) f = multiply(f, Rational(1 / c));
    denominator_ = std::make_shared<const Form>(constant_one());
  }

  Polynomial_vector<1, N> numerator_;
  std::shared_ptr<const Form> denominator_;
};

using Unreduced_scalar = Unreduced_quotient<1>;

template <std::size_t N>
Unreduced_quotient<N> add(const Unreduced_quotient<N>& a, const Unreduced_quotient<N>& b)
{
  using namespace detail;
  if (a.has_denominator_of(b)) return Unreduced_quotient<N>(formal_sum(a.numerator(), b.numerator()), a.shared_denominator());
  return Unreduced_quotient<N>(
    formal_sum(formal_product(b.denominator(), a.numerator()), formal_product(a.denominator(), b.numerator())),
    formal_product(a.denominator(), b.denominator()));
}

template <std::size_t N>
Unreduced_quotient<N> multiply(const Unreduced_quotient<N>& a, const Rational& factor)
{
  return Unreduced_quotient<N>(detail::vector_of<N>([&](std::size_t k) { return multiply(a.numerator()[k], factor); }),
                               a.shared_denominator());
}

template <std::size_t N>
Unreduced_quotient<N> subtract(const Unreduced_quotient<N>& a, const Unreduced_quotient<N>& b)
{
  return add(a, multiply(b, Rational(-1)));
}

template <std::size_t N>
Unreduced_quotient<N> multiply(const Unreduced_scalar& factor, const Unreduced_quotient<N>& a)
{
  return Unreduced_quotient<N>(detail::formal_product(factor.numerator()[0], a.numerator()),
                               detail::formal_product(factor.denominator(), a.denominator()));
}

/// Throws std::domain_error where b is identically zero.
inline Unreduced_scalar divide(const Unreduced_scalar& a, const Unreduced_scalar& b)
{
  if (is_zero(b.numerator())) throw std::domain_error("Unreduced_quotient: division by zero");
  return Unreduced_scalar({detail::formal_product(a.numerator()[0], b.denominator())},
                          detail::formal_product(a.denominator(), b.numerator()[0]));
}

template <std::size_t N>
Unreduced_scalar dot(const Unreduced_quotient<N>& a, const Unreduced_quotient<N>& b)
{
  return Unreduced_scalar({detail::formal_dot(a.numerator(), b.numerator())},
                          detail::formal_product(a.denominator(), b.denominator()));
}

inline Unreduced_scalar bracket(const Unreduced_quotient<2>& a, const Unreduced_quotient<2>& b)
{
  return Unreduced_scalar({detail::formal_bracket(a.numerator(), b.numerator())},
                          detail::formal_product(a.denominator(), b.denominator()));
}

inline Unreduced_quotient<3> cross(const Unreduced_quotient<3>& a, const Unreduced_quotient<3>& b)
{
  return Unreduced_quotient<3>(detail::formal_cross(a.numerator(), b.numerator()),
                               detail::formal_product(a.denominator(), b.denominator()));
}

/// A vector of the plane turned left by a right angle.
inline Unreduced_quotient<2> turned_left(const Unreduced_quotient<2>& a)
{
  return Unreduced_quotient<2>(turned_left(a.numerator()), a.shared_denominator());
}

/// By the quotient rule: the degree doubles, but for a polynomial, whose degree falls by one.
template <std::size_t N>
Unreduced_quotient<N> derivative(const Unreduced_quotient<N>& a)
{
  using Form = Bernstein<Rational, 1>;
  if (a.is_polynomial()) return Unreduced_quotient<N>(derivative(a.numerator()), a.shared_denominator());
  const Form bottom = detail::elevated_to(a.denominator(), Degrees<1>{a.degree()}), slope = derivative(bottom);
  return Unreduced_quotient<N>(
    detail::vector_of<N>([&](std::size_t k) {
      const Form& top = a.numerator()[k];
      return detail::formal_minor(derivative(top), top, slope, bottom);
    }),
    detail::formal_product(bottom, bottom));
}

} // namespace locus

#endif
