// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_ALGEBRAIC_EXTENSION_H
#define LOCUS_FUNCTION_ALGEBRAIC_EXTENSION_H

#include <locus/function/bivariate_polynomial.h>
#include <locus/function/checkpoint.h>
#include <locus/function/descartes.h>

namespace locus {

/// The numbers that are polynomials with rational coefficients in one real algebraic number α, the only root of a
/// square-free polynomial m in an isolating interval. m need not be irreducible: where a zero test finds a factor of m, m is
/// replaced by the factor that has α (dynamic evaluation, Della Dora, Dicrescenzo & Duval 1985).
class Algebraic_extension {
public:
  /// Coefficients of 1, α, α², …; fewer than the degree of m, no leading zeros.
  using Element = std::vector<Rational>;

  Checkpoint checkpoint; ///< of long computations with polynomials over these numbers

  /// α is the only root of m in [lo, hi], whose ends are no roots, or exactly lo == hi.
  Algebraic_extension(Integer_polynomial m, Rational lo, Rational hi) : m_(std::move(m)), lo_(std::move(lo)), hi_(std::move(hi))
  {
    if (lo_ == hi_) set_rational(lo_);
    else see_rational();
  }

  const Integer_polynomial& modulus() const { return m_; }
  const Rational& lo() const { return lo_; }
  const Rational& hi() const { return hi_; }

  Element reduced(Element a) const
  {
    const std::size_t n = m_.size() - 1;
    trim(a);
    while (a.size() > n) {
      const Rational q = a.back() / m_.back();
      const std::size_t shift = a.size() - m_.size();
      for (std::size_t i = 0; i < m_.size(); ++i) a[i + shift] -= q * m_[i];
      trim(a);
    }
    return a;
  }

  Element element(const Integer_polynomial& a) const { return reduced(Element(a.begin(), a.end())); }

  Element multiply(const Element& a, const Element& b) const { return reduced(product(a, b)); }

  static Element subtract(Element a, const Element& b)
  {
    if (a.size() < b.size()) a.resize(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) a[i] -= b[i];
    trim(a);
    return a;
  }

  /// Exact. May replace m by a factor of it; elements made before must then be reduced again, `reduced` does no harm else.
  bool is_zero(const Element& a)
  {
    const Element b = reduced(a);
    if (b.empty()) return true;
    const Integer_polynomial common = gcd(m_, cleared(b));
    if (degree(common) < 1) return false;
    const bool has_root = vanishes_at_root(common);
    m_ = has_root ? common : exact_quotient(m_, common);
    see_rational();
    return has_root;
  }

  /// Of an element that `is_zero` has found not to be zero.
  Element inverse(const Element& a) const
  {
    // Extended Euclid with rational coefficients: s·a ≡ r (mod m).
    Element r0(m_.begin(), m_.end()), r1 = reduced(a), s0, s1{Rational(1)};
    while (r1.size() > 1) {
      const auto [q, rest] = divided(r0, r1);
      Element s2 = subtract(s0, product(q, s1));
      r0 = std::move(r1);
      r1 = rest;
      s0 = std::move(s1);
      s1 = std::move(s2);
    }
    for (Rational& c : s1) c /= r1.at(0);
    return reduced(std::move(s1));
  }

  /// Sign of an element: the interval of α is halved until it shows.
  Sign sign(const Element& a)
  {
    if (is_zero(a)) return Sign::zero;
    const Bernstein<Scaled_integer, 1> f = bernstein_form(cleared(reduced(a)));
    for (;;) {
      const auto part = lo_ == hi_ ? Bernstein<Scaled_integer, 1>(Bernstein<Rational, 1>(Degrees<1>{0}, {evaluate(f, {lo_})}))
                                   : restrict_to(f, 0, lo_, hi_);
      if (const Sign all = common_sign(part); is_strict(all)) return all;
      halve();
    }
  }

  /// Halves the interval of α.
  void halve()
  {
    if (lo_ == hi_) return;
    const Rational middle = (lo_ + hi_) / 2;
    const Sign at = value_sign(m_, middle);
    if (at == Sign::zero) return set_rational(middle);
    (at == value_sign(m_, lo_) ? lo_ : hi_) = middle;
  }

  /// Makes x an end of the interval or, if it is the root, the number itself.
  void compare_with(const Rational& x)
  {
    if (!(lo_ < x && x < hi_)) return;
    const Sign at = value_sign(m_, x);
    if (at == Sign::zero) return set_rational(x);
    (at == value_sign(m_, lo_) ? lo_ : hi_) = x;
  }

  static Sign value_sign(const Integer_polynomial& f, const Rational& x)
  {
    // Σ f_i p^i q^(n-i) for x = p/q, by Horner's rule without fractions.
    const Integer &p = x.get_num(), &q = x.get_den();
    Integer v = 0, power = 1;
    for (std::size_t i = f.size(); i-- > 0; power *= q) {
      v *= p;
      v += f[i] * power;
    }
    return sign_of(v);
  }

private:
  void set_rational(const Rational x)
  {
    lo_ = hi_ = x;
    m_ = {Integer(-x.get_num()), x.get_den()};
  }

  void see_rational()
  {
    if (degree(m_) != 1 || lo_ == hi_) return;
    Rational x(Integer(-m_[0]), m_[1]);
    x.canonicalize();
    set_rational(x);
  }

  static void trim(Element& a)
  {
    while (!a.empty() && a.back() == 0) a.pop_back();
  }

  static Integer_polynomial cleared(const Element& a)
  {
    Integer denominator = 1;
    for (const Rational& c : a) denominator = lcm(denominator, c.get_den());
    Integer_polynomial f;
    for (const Rational& c : a) f.push_back(Integer(c.get_num() * (denominator / c.get_den())));
    return f;
  }

  /// A factor of m has α where it changes sign over the interval, in which m has no other root.
  bool vanishes_at_root(const Integer_polynomial& factor) const
  {
    if (lo_ == hi_) return value_sign(factor, lo_) == Sign::zero;
    return value_sign(factor, lo_) != value_sign(factor, hi_);
  }

  static Element product(const Element& a, const Element& b)
  {
    if (a.empty() || b.empty()) return {};
    Element c(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
    trim(c);
    return c;
  }

  static std::pair<Element, Element> divided(Element a, const Element& b)
  {
    Element q(a.size() >= b.size() ? a.size() - b.size() + 1 : 0);
    while (a.size() >= b.size()) {
      const std::size_t shift = a.size() - b.size();
      q[shift] = a.back() / b.back();
      for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] -= q[shift] * b[i];
      trim(a);
    }
    return {std::move(q), std::move(a)};
  }

  Integer_polynomial m_;
  Rational lo_, hi_;
};

/// A polynomial Σ_j c[j]·y^j with coefficients in an extension.
using Extension_polynomial = std::vector<Algebraic_extension::Element>;

namespace detail {

/// Leading coefficients that are zero at α go.
inline void trim(Extension_polynomial& f, Algebraic_extension& field)
{
  while (!f.empty() && field.is_zero(f.back())) f.pop_back();
  for (auto& c : f) c = field.reduced(std::move(c));
}

inline void make_monic(Extension_polynomial& f, const Algebraic_extension& field)
{
  const Algebraic_extension::Element inverse = field.inverse(f.back());
  for (auto& c : f) c = field.multiply(c, inverse);
}

/// f modulo the monic g.
inline Extension_polynomial remainder(Extension_polynomial f, const Extension_polynomial& g, Algebraic_extension& field)
{
  while (f.size() >= g.size()) {
    pass(field.checkpoint);
    const std::size_t shift = f.size() - g.size();
    const Algebraic_extension::Element q = f.back();
    for (std::size_t i = 0; i + 1 < g.size(); ++i) f[i + shift] = field.subtract(f[i + shift], field.multiply(q, g[i]));
    f.pop_back();
    trim(f, field);
  }
  return f;
}

} // namespace detail

inline Extension_polynomial over_extension(const Bivariate_polynomial& f, const Algebraic_extension& field)
{
  Extension_polynomial g;
  for (const Integer_polynomial& r : f.row) g.push_back(field.element(r));
  return g;
}

/// Monic greatest common divisor; no coefficients where both are zero. Euclid's algorithm.
inline Extension_polynomial gcd(Extension_polynomial f, Extension_polynomial g, Algebraic_extension& field)
{
  detail::trim(f, field);
  detail::trim(g, field);
  while (!g.empty()) {
    detail::make_monic(g, field);
    Extension_polynomial rest = detail::remainder(std::move(f), g, field);
    f = std::move(g);
    g = std::move(rest);
  }
  if (!f.empty()) {
    for (auto& c : f) c = field.reduced(std::move(c));
    detail::make_monic(f, field);
  }
  return f;
}

/// f without repeated roots: f / gcd(f, f'), monic. f is monic.
inline Extension_polynomial square_free_part(const Extension_polynomial& f, Algebraic_extension& field)
{
  Extension_polynomial slope;
  for (std::size_t j = 1; j < f.size(); ++j) {
    slope.push_back(f[j]);
    for (Rational& c : slope.back()) c *= static_cast<unsigned long>(j);
  }
  const Extension_polynomial common = gcd(f, slope, field);
  if (common.size() < 2) return f;
  Extension_polynomial rest = f, quotient(f.size() - common.size() + 1);
  while (rest.size() >= common.size()) {
    const std::size_t shift = rest.size() - common.size();
    quotient[shift] = rest.back();
    for (std::size_t i = 0; i < common.size(); ++i)
      rest[i + shift] = field.subtract(rest[i + shift], field.multiply(quotient[shift], common[i]));
    detail::trim(rest, field);
  }
  return quotient;
}

/// Sign of Σ_j f[j](α)·y^j at a rational y.
inline Sign sign_at(const Extension_polynomial& f, const Rational& y, Algebraic_extension& field)
{
  Algebraic_extension::Element value;
  for (std::size_t j = f.size(); j-- > 0;) {
    for (Rational& c : value) c *= y;
    if (value.size() < f[j].size()) value.resize(f[j].size());
    for (std::size_t i = 0; i < f[j].size(); ++i) value[i] += f[j][i];
  }
  return field.sign(value);
}

} // namespace locus

#endif
