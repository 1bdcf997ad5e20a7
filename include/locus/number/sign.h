// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_NUMBER_SIGN_H
#define LOCUS_NUMBER_SIGN_H

#include <ostream>

namespace locus {

/// The sign of a number as far as it is known. `unknown` is an answer of its own: it says that the arithmetic at
/// hand could not decide, never that the number is small.
enum class Sign : signed char { negative = -1, zero = 0, positive = 1, unknown = 2 };

/// Answer to a yes/no question that may have to stay open.
enum class Answer : signed char { no = 0, yes = 1, undecided = 2 };

constexpr bool is_certain(Sign s) { return s != Sign::unknown; }

/// True for a certainly positive or certainly negative sign.
constexpr bool is_strict(Sign s) { return s == Sign::positive || s == Sign::negative; }

constexpr Sign opposite(Sign s)
{
  return is_strict(s) ? static_cast<Sign>(-static_cast<signed char>(s)) : s;
}

constexpr Sign operator*(Sign a, Sign b)
{
  if (a == Sign::zero || b == Sign::zero) return Sign::zero;
  if (a == Sign::unknown || b == Sign::unknown) return Sign::unknown;
  return a == b ? Sign::positive : Sign::negative;
}

constexpr Sign sign_of_int(int s) { return s > 0 ? Sign::positive : s < 0 ? Sign::negative : Sign::zero; }

inline std::ostream& operator<<(std::ostream& out, Sign s)
{
  return out << (s == Sign::positive ? "+" : s == Sign::negative ? "-" : s == Sign::zero ? "0" : "?");
}

} // namespace locus

#endif
