// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_POLYNOMIAL_VECTOR_H
#define LOCUS_FUNCTION_POLYNOMIAL_VECTOR_H

#include <locus/function/bernstein_operators.h>
#include <locus/function/true_degree.h>

namespace locus {

/// N polynomials in D variables: a vector that depends on parameters. All operations are exact; results have their least
/// degrees.
template <int D, std::size_t N>
using Polynomial_vector = std::array<Bernstein<Rational, D>, N>;

namespace detail {

template <std::size_t N, class Make>
auto vector_of(Make make)
{
  std::array<decltype(make(std::size_t{0})), N> out;
  for (std::size_t k = 0; k < N; ++k) out[k] = make(k);
  return out;
}

} // namespace detail

template <int D, std::size_t N>
Polynomial_vector<D, N> at_true_degree(const Polynomial_vector<D, N>& a)
{
  return detail::vector_of<N>([&](std::size_t k) { return at_true_degree(a[k]); });
}

template <int D, std::size_t N>
Bernstein<Rational, D> dot(const Polynomial_vector<D, N>& a, const Polynomial_vector<D, N>& b)
{
  Bernstein<Rational, D> sum = multiply(a[0], b[0]);
  for (std::size_t k = 1; k < N; ++k) sum = add(sum, multiply(a[k], b[k]));
  return at_true_degree(sum);
}

/// The square of the length.
template <int D, std::size_t N>
Bernstein<Rational, D> square(const Polynomial_vector<D, N>& a)
{
  return dot(a, a);
}

template <int D>
Polynomial_vector<D, 3> cross(const Polynomial_vector<D, 3>& a, const Polynomial_vector<D, 3>& b)
{
  return detail::vector_of<3>([&](std::size_t k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    return at_true_degree(subtract(multiply(a[i], b[j]), multiply(a[j], b[i])));
  });
}

/// The bracket [a b] of two vectors of the plane: the area that they span, with its sign.
template <int D>
Bernstein<Rational, D> bracket(const Polynomial_vector<D, 2>& a, const Polynomial_vector<D, 2>& b)
{
  return at_true_degree(subtract(multiply(a[0], b[1]), multiply(a[1], b[0])));
}

/// The bracket [a b c] of three vectors of space: the volume that they span, with its sign.
template <int D>
Bernstein<Rational, D> bracket(const Polynomial_vector<D, 3>& a, const Polynomial_vector<D, 3>& b,
                               const Polynomial_vector<D, 3>& c)
{
  return dot(a, cross(b, c));
}

/// A vector of the plane turned left by a right angle.
template <int D>
Polynomial_vector<D, 2> turned_left(const Polynomial_vector<D, 2>& a)
{
  return {multiply(a[1], Rational(-1)), a[0]};
}

template <int D, std::size_t N>
Polynomial_vector<D, N> derivative(const Polynomial_vector<D, N>& a, int variable = 0)
{
  return detail::vector_of<N>([&](std::size_t k) { return derivative(a[k], variable); });
}

template <int D, std::size_t N>
Polynomial_vector<D, N> add(const Polynomial_vector<D, N>& a, const Polynomial_vector<D, N>& b)
{
  return detail::vector_of<N>([&](std::size_t k) { return at_true_degree(add(a[k], b[k])); });
}

template <int D, std::size_t N>
Polynomial_vector<D, N> subtract(const Polynomial_vector<D, N>& a, const Polynomial_vector<D, N>& b)
{
  return detail::vector_of<N>([&](std::size_t k) { return at_true_degree(subtract(a[k], b[k])); });
}

template <int D, std::size_t N>
Polynomial_vector<D, N> multiply(const Bernstein<Rational, D>& factor, const Polynomial_vector<D, N>& a)
{
  return detail::vector_of<N>([&](std::size_t k) { return at_true_degree(multiply(factor, a[k])); });
}

template <int D, std::size_t N>
bool is_zero(const Polynomial_vector<D, N>& a)
{
  for (const auto& f : a)
    for (const Rational& c : f.coefficients())
      if (c != 0) return false;
  return true;
}

namespace operators {

template <int D, std::size_t N>
Polynomial_vector<D, N> operator+(const Polynomial_vector<D, N>& a, const Polynomial_vector<D, N>& b)
{
  return add(a, b);
}
template <int D, std::size_t N>
Polynomial_vector<D, N> operator-(const Polynomial_vector<D, N>& a, const Polynomial_vector<D, N>& b)
{
  return subtract(a, b);
}
template <int D, std::size_t N>
Polynomial_vector<D, N> operator*(const Bernstein<Rational, D>& f, const Polynomial_vector<D, N>& a)
{
  return multiply(f, a);
}

} // namespace operators

} // namespace locus

#endif
