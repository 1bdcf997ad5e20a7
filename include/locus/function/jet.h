// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_JET_H
#define LOCUS_FUNCTION_JET_H

namespace locus {

/// A function of one variable by its value, first and second derivative: arithmetic on jets differentiates by the
/// product and quotient rules. Over intervals it encloses all three over a range.
template <class T>
struct Jet {
  T value{0}, first{0}, second{0};

  Jet() = default;
  Jet(T v) : value(v) {}
  Jet(T v, T d, T dd) : value(v), first(d), second(dd) {}
};

template <class T>
Jet<T> operator+(const Jet<T>& a, const Jet<T>& b)
{
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}

template <class T>
Jet<T> operator-(const Jet<T>& a, const Jet<T>& b)
{
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}

template <class T>
Jet<T> operator-(const Jet<T>& a)
{
  return {-a.value, -a.first, -a.second};
}

template <class T>
Jet<T> operator*(const Jet<T>& a, const Jet<T>& b)
{
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + T(2) * a.first * b.first + a.value * b.second};
}

template <class T>
Jet<T> operator/(const Jet<T>& a, const Jet<T>& b)
{
  const T q = a.value / b.value;
  const T q1 = (a.first - q * b.first) / b.value;
  return {q, q1, (a.second - T(2) * q1 * b.first - q * b.second) / b.value};
}

/// f(x) for f known by its derivatives at x's value (or over its range).
template <class T>
Jet<T> compose(const T& f, const T& f1, const T& f2, const Jet<T>& x)
{
  return {f, f1 * x.first, f2 * x.first * x.first + f1 * x.second};
}

} // namespace locus

#endif
