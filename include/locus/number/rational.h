// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_NUMBER_RATIONAL_H
#define LOCUS_NUMBER_RATIONAL_H

#include <locus/number/sign.h>

#include <gmpxx.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace locus {

/// Exact integers and rationals: GMP's C++ classes, one concrete type each, whatever CGAL was configured with.
/// They use expression templates, so generic code here never writes `auto x = a * b`.
using Integer = mpz_class;
using Rational = mpq_class;

inline Sign sign_of(const Integer& x) { return sign_of_int(sgn(x)); }
inline Sign sign_of(const Rational& x) { return sign_of_int(sgn(x)); }

/// Greatest power of ten that a decimal may carry. The largest double needs 308, the smallest 324; beyond this
/// limit a nine-character string could ask for gigabytes.
inline constexpr long max_decimal_exponent = 4000;

/// The rational equal to a double. Throws std::domain_error for NaN and infinities.
inline Rational exact_rational(double x)
{
  if (!std::isfinite(x)) throw std::domain_error("not a finite number");
  return Rational(x);
}

namespace detail {

inline bool all_digits(std::string_view s)
{
  if (s.empty()) return false;
  for (char c : s)
    if (c < '0' || c > '9') return false;
  return true;
}

inline Integer power_of_ten(unsigned long e)
{
  Integer p;
  mpz_ui_pow_ui(p.get_mpz_t(), 10, e);
  return p;
}

[[noreturn]] inline void reject_number(std::string_view text)
{
  constexpr std::size_t shown = 40;
  throw std::invalid_argument("'" + std::string(text.substr(0, shown)) + (text.size() > shown ? "…" : "") +
                              "' is not a number (write a decimal like \"-0.25e3\" or a fraction like \"2/3\")");
}

inline long parse_exponent(std::string_view digits, std::string_view text)
{
  const bool negative = !digits.empty() && digits.front() == '-';
  if (!digits.empty() && (digits.front() == '-' || digits.front() == '+')) digits.remove_prefix(1);
  if (!all_digits(digits)) reject_number(text);
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  const long e = digits.size() > 6 ? max_decimal_exponent + 1 : std::stol(std::string(digits));
  if (e > max_decimal_exponent)
    throw std::invalid_argument("'" + std::string(text.substr(0, 40)) + "' has a decimal exponent beyond " +
                                std::to_string(max_decimal_exponent));
  return negative ? -e : e;
}

inline Rational parse_decimal(std::string_view body, std::string_view text)
{
  long exponent = 0;
  if (const auto e = body.find_first_of("eE"); e != std::string_view::npos) {
    exponent = parse_exponent(body.substr(e + 1), text);
    body = body.substr(0, e);
  }
  std::string digits(body.substr(0, body.find('.')));
  if (const auto dot = body.find('.'); dot != std::string_view::npos) {
    const std::string_view fraction = body.substr(dot + 1);
    if (!fraction.empty() && !all_digits(fraction)) reject_number(text);
    digits += fraction;
    exponent -= static_cast<long>(fraction.size());
  }
  if (!all_digits(digits)) reject_number(text);
  Rational value{Integer(digits, 10)};
  if (exponent > 0) value *= power_of_ten(static_cast<unsigned long>(exponent));
  if (exponent < 0) value /= power_of_ten(static_cast<unsigned long>(-exponent));
  return value;
}

} // namespace detail

/// The rational that a decimal ("-0.25", "1e-300") or a fraction ("2/3") spells, exactly: "0.1" is 1/10.
/// Throws std::invalid_argument, with the offending text, for anything else.
inline Rational parse_rational(std::string_view text)
{
  std::string_view body = text;
  const bool negative = !body.empty() && body.front() == '-';
  if (!body.empty() && (body.front() == '-' || body.front() == '+')) body.remove_prefix(1);
  Rational value;
  if (const auto slash = body.find('/'); slash != std::string_view::npos) {
    const std::string_view p = body.substr(0, slash), q = body.substr(slash + 1);
    if (!detail::all_digits(p) || !detail::all_digits(q)) detail::reject_number(text);
    const Integer denominator(std::string(q), 10);
    if (denominator == 0)
      throw std::invalid_argument("'" + std::string(text.substr(0, 40)) + "' has the denominator zero");
    value = Rational(Integer(std::string(p), 10), denominator);
    value.canonicalize();
  } else {
    value = detail::parse_decimal(body, text);
  }
  return negative ? Rational(-value) : value;
}

/// An exact coordinate as users write it: an int, a double (taken at its binary value) or a string (taken at its
/// decimal value). Note that the C++ literal 0.1 is a double and therefore not 1/10, while "0.1" is.
class Number {
public:
  Number(int x) : value_(x) {}
  Number(long x) : value_(x) {}
  Number(double x) : value_(exact_rational(x)) {}
  Number(const char* text) : value_(parse_rational(text)) {}
  Number(const std::string& text) : value_(parse_rational(text)) {}
  Number(Rational x) : value_(std::move(x)) {}

  const Rational& value() const { return value_; }

private:
  Rational value_;
};

} // namespace locus

#endif
