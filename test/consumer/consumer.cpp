// SPDX-License-Identifier: LGPL-3.0-or-later
// Uses the installed library as a stranger would.
#include <locus/function/bernstein_operations.h>
#include <locus/number/rational.h>

#include <iostream>

// gcc tells whether the option arrived that interval arithmetic needs; clang has no such macro.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__ROUNDING_MATH__)
#error "locus::locus did not bring -frounding-math"
#endif

int main()
{
  const auto f = locus::from_monomial<locus::Rational>({1, -3, 2});
  const bool right = f[1] == locus::parse_rational("-0.5");
  std::cout << "middle coefficient of 1 - 3u + 2u^2: " << f[1] << (right ? "" : " (wrong)") << '\n';
  return right ? 0 : 1;
}
