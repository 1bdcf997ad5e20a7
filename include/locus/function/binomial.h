// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BINOMIAL_H
#define LOCUS_FUNCTION_BINOMIAL_H

#include <locus/number/interval.h>

#include <array>

namespace locus {

namespace detail {

/// Rows up to 56 hold only integers below 2^53, so doubles carry them exactly.
inline constexpr int last_exact_binomial_row = 56;

constexpr auto make_binomial_table()
{
  constexpr auto size = static_cast<std::size_t>(last_exact_binomial_row + 1);
  std::array<std::array<double, size>, size> table{};
  for (std::size_t n = 0; n < size; ++n) {
    table[n][0] = 1;
    for (std::size_t k = 1; k <= n; ++k) table[n][k] = table[n - 1][k - 1] + (k < n ? table[n - 1][k] : 0.0);
  }
  return table;
}

inline constexpr auto binomial_table = make_binomial_table();

template <class T>
T number_from_integer(const Integer& x)
{
  if constexpr (std::is_same_v<T, Interval>) return enclosing(Rational(x));
  else if constexpr (std::is_same_v<T, double>) return x.get_d();
  else return T(x);
}

} // namespace detail

/// The binomial coefficient "n over k" in the number type T: exact, for doubles from row 57 on rounded.
template <class T>
T binomial(int n, int k)
{
  if (n <= detail::last_exact_binomial_row)
    return T(detail::binomial_table[static_cast<std::size_t>(n)][static_cast<std::size_t>(k)]);
  Integer b;
  mpz_bin_uiui(b.get_mpz_t(), static_cast<unsigned long>(n), static_cast<unsigned long>(k));
  return detail::number_from_integer<T>(b);
}

} // namespace locus

#endif
