// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BERNSTEIN_OPERATORS_H
#define LOCUS_FUNCTION_BERNSTEIN_OPERATORS_H

#include <locus/function/bernstein_operations.h>
#include <locus/number/rational.h>

namespace locus {

/// Arithmetic signs for exact polynomials, so that formulas read as on paper: `using namespace locus::operators;` in the
/// function that has the formula. Nothing is an expression template: each operation costs what its function does.
namespace operators {

template <int D>
Bernstein<Rational, D> operator+(const Bernstein<Rational, D>& f, const Bernstein<Rational, D>& g)
{
  return add(f, g);
}
template <int D>
Bernstein<Rational, D> operator-(const Bernstein<Rational, D>& f, const Bernstein<Rational, D>& g)
{
  return subtract(f, g);
}
template <int D>
Bernstein<Rational, D> operator*(const Bernstein<Rational, D>& f, const Bernstein<Rational, D>& g)
{
  return multiply(f, g);
}
template <int D>
Bernstein<Rational, D> operator*(int factor, const Bernstein<Rational, D>& f)
{
  return multiply(f, Rational(factor));
}

} // namespace operators

} // namespace locus

#endif
