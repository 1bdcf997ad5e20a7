// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_F1_F2_H
#define LOCUS_CONSTRAINT_F1_F2_H

#include <locus/constraint/planar_equations.h>

namespace locus {

/// A form of two curves multiplied out over the rationals.
template <class Form>
Bernstein<Rational, 2> exact_form(const Planar_curve& first, const Planar_curve& second)
{
  // The general form also for circles, whose own one leaves out their denominators' squares.
  Complex_curve<Rational> c1 = first.exact(), c2 = second.exact();
  c1.is_circle = c2.is_circle = false;
  return expand(Form::build(c1, c2));
}

namespace detail {

/// Re(e ā), Re(e b̄): e against both tangents.
template <bool First>
struct Tangent_product_form {
  template <class T>
  static Separable_sum<T> build(const Complex_curve<T>& c1, const Complex_curve<T>& c2)
  {
    Separable_sum<T> sum;
    if constexpr (First) sum = First_tangent_form::build(c1, c2);
    else sum = Second_tangent_form::build(c1, c2);
    sum.imaginary = false;
    return sum;
  }
};

/// |a|² in the first variable, or |b|² in the second.
template <bool First>
struct Squared_speed_form {
  template <class T>
  static Separable_sum<T> build(const Complex_curve<T>& c1, const Complex_curve<T>& c2)
  {
    const Complex_polynomial<T> one = real_polynomial(std::vector<T>{T(1)});
    Separable_sum<T> sum;
    sum.imaginary = false;
    if constexpr (First) sum.terms.push_back({multiply(c1.tangent, conjugate(c1.tangent)), one});
    else sum.terms.push_back({one, multiply(c2.tangent, conjugate(c2.tangent))});
    return sum;
  }
};

/// |a|²·second² - |b|²·first²
template <class First_form, class Second_form>
Bernstein<Rational, 2> squared_difference(const Planar_curve& c1, const Planar_curve& c2)
{
  const Bernstein<Rational, 2> first = exact_form<First_form>(c1, c2), second = exact_form<Second_form>(c1, c2);
  return subtract(multiply(exact_form<Squared_speed_form<true>>(c1, c2), multiply(second, second)),
                  multiply(exact_form<Squared_speed_form<false>>(c1, c2), multiply(first, first)));
}

} // namespace detail

/// F1 of Elber & Kim 1998 (3), for rational curves too: |a|²⟨e, b⟩² - |b|²⟨e, a⟩². Total degree 6m-4 for polynomial
/// curves of degree m. It equals -W·F3, so that its zero set has the parallel-tangent curves W = 0 and false nodes
/// where they cross F3 = 0. For comparison only.
inline Bernstein<Rational, 2> f1(const Planar_curve& first, const Planar_curve& second)
{
  return detail::squared_difference<detail::Tangent_product_form<true>, detail::Tangent_product_form<false>>(first, second);
}

/// F2 of Elber & Kim 1998 (after (7)), cleared of its denominators: |b|²⟨e, N1⟩² - |a|²⟨e, N2⟩², which is F1 again.
inline Bernstein<Rational, 2> f2(const Planar_curve& first, const Planar_curve& second)
{
  return multiply(detail::squared_difference<First_tangent_form, Second_tangent_form>(first, second), Rational(-1));
}

/// F1 by its two factors, as equations of their own: the bisector's, and the parallel tangents' that EK98 (4) warns of.
struct F1_factors {
  std::shared_ptr<const Equation<2>> bisector, parallel_tangents;
};

inline F1_factors f1_factors(const std::shared_ptr<const Planar_curve>& first, const std::shared_ptr<const Planar_curve>& second)
{
  return {std::make_shared<Curve_pair_equation<F3_form>>(first, second),
          std::make_shared<Curve_pair_equation<Parallel_tangents_form>>(first, second)};
}

} // namespace locus

#endif
