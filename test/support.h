// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_TEST_SUPPORT_H
#define LOCUS_TEST_SUPPORT_H

// What the tests share: random inputs from a seed that a failure prints, a collector that reports the first of many
// samples that failed, and a second, plain implementation of polynomial arithmetic in rationals to compare with.
// It shares no code with the library beyond the types Integer, Rational and the arrays of Bernstein coefficients.

#include <locus/function/bernstein.h>
#include <locus/number/interval.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace locus_test {

using locus::Bernstein;
using locus::Degrees;
using locus::Integer;
using locus::Rational;
using locus::Sign;

// ------------------------------------------------------------------------------------------------ random inputs

/// The seed of this run: the environment variable LOCUS_TEST_SEED or a fixed number.
inline std::uint64_t run_seed()
{
  const char* text = std::getenv("LOCUS_TEST_SEED");
  return text ? std::strtoull(text, nullptr, 10) : 20240607u;
}

/// The shortest exact spelling of a double, in hexadecimal: the same in every rounding mode.
inline std::string show(double x)
{
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%a", x);
  return buffer;
}
inline std::string show(const Rational& x) { return x.get_str(); }
inline std::string show(const Integer& x) { return x.get_str(); }
inline std::string show(int x) { return std::to_string(x); }
inline std::string show(const locus::Interval& x) { return "[" + show(x.inf()) + ", " + show(x.sup()) + "]"; }
template <class Sequence>
std::string show(const Sequence& s)
{
  std::string text = "{";
  for (const auto& x : s) text += (text.size() > 1 ? ", " : "") + show(x);
  return text + "}";
}

/// Inputs that mix the exact, the wide, the huge, the tiny and the tied.
class Random {
public:
  /// `stream` makes tests independent of each other's order and number.
  explicit Random(std::uint64_t stream) : engine_(run_seed() * 0x9E3779B97F4A7C15u + stream) {}

  std::uint64_t bits() { return engine_(); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  int between(int lo, int hi) { return lo + below(hi - lo + 1); }
  bool chance(int percent) { return below(100) < percent; }
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double symmetric() { return 2 * unit() - 1; }

  Integer integer(int bit_count)
  {
    Integer x = 0;
    for (int left = bit_count; left > 0; left -= 32) {
      x <<= 32;
      x += static_cast<unsigned long>(engine_() & 0xFFFFFFFFu);
    }
    mpz_fdiv_r_2exp(x.get_mpz_t(), x.get_mpz_t(), static_cast<mp_bitcnt_t>(bit_count));
    return chance(50) ? x : Integer(-x);
  }

  /// A rational of moderate size; one in five is a small integer, so that zeros and ties occur.
  Rational rational()
  {
    if (chance(20)) return Rational(between(-2, 2));
    Integer q = integer(between(1, 30));
    if (q == 0) q = 1;
    Rational x(integer(between(1, 30)), q);
    x.canonicalize();
    return x;
  }

  /// A rational in [0, 1]; now and then an end or the middle.
  Rational unit_rational()
  {
    if (chance(15)) return Rational(below(3)) / 2;
    const int width = between(1, 40);
    Integer p = abs(integer(width));
    Rational x(p, Integer(Integer(1) << static_cast<unsigned>(width)) + 1);
    x.canonicalize();
    return x;
  }

  enum class Size { integers, plain, tiny, subnormal, large, mixed };
  static constexpr int size_count = 6;
  Size size() { return static_cast<Size>(below(size_count)); }

  /// A double of one class of magnitude; each class has exact zeros.
  double real(Size size)
  {
    if (chance(12)) return 0.0;
    switch (size) {
    case Size::integers:
      return static_cast<double>(between(-3, 3));
    case Size::plain:
      return symmetric();
    case Size::tiny:
      return symmetric() * 1e-160;
    case Size::subnormal:
      return symmetric() * (chance(50) ? 1e-310 : 1e-321);
    case Size::large:
      return symmetric() * 1e150;
    default:
      return std::ldexp(symmetric(), between(-400, 400));
    }
  }

  /// Any finite double, every bit pattern about equally likely.
  double any_double()
  {
    for (;;) {
      const std::uint64_t pattern = engine_();
      double x;
      static_assert(sizeof x == sizeof pattern);
      std::memcpy(&x, &pattern, sizeof x);
      if (std::isfinite(x)) return x;
    }
  }

  template <int D>
  Degrees<D> degrees(int lowest, int highest)
  {
    Degrees<D> d{};
    for (int& n : d) n = between(lowest, highest);
    return d;
  }

  template <int D>
  Bernstein<Rational, D> polynomial(const Degrees<D>& degrees)
  {
    Bernstein<Rational, D> f(degrees);
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = rational();
    return f;
  }

private:
  std::mt19937_64 engine_;
};

// ------------------------------------------------------------------------------------- many samples, one report

/// Counts samples and failures, and keeps the description of the first failure.
class Samples {
public:
  template <class Describe>
  void expect(bool ok, Describe describe)
  {
    ++count_;
    if (!ok && failures_++ == 0) first_ = "sample " + std::to_string(count_) + ": " + describe();
  }
  void expect(bool ok, const char* what)
  {
    expect(ok, [what] { return std::string(what); });
  }
  std::size_t count() const { return count_; }
  std::size_t failures() const { return failures_; }
  std::string report() const
  {
    return "LOCUS_TEST_SEED=" + std::to_string(run_seed()) + ", " + std::to_string(failures_) + " of " +
           std::to_string(count_) + " samples failed; the first: " + first_;
  }

private:
  std::size_t count_ = 0, failures_ = 0;
  std::string first_;
};

/// Ends a sampling test: fails with the first failure, or where fewer samples were taken than meant.
#define LOCUS_REQUIRE_SAMPLES(samples, at_least)                                                                       \
  do {                                                                                                                 \
    INFO((samples).report());                                                                                          \
    CHECK((samples).count() + 1 > static_cast<std::size_t>(at_least)); /* no warning for 0 */                          \
    REQUIRE((samples).failures() == 0);                                                                                \
  } while (false)

/// What `f` throws, as a number: 0 nothing, 1 an exception of type E, 2 another one.
template <class E, class F>
int thrown(F f)
{
  try {
    f();
  } catch (const E&) {
    return 1;
  } catch (...) {
    return 2;
  }
  return 0;
}

// ---------------------------------------------------------------------------------------------- rounding modes

inline constexpr std::array<int, 4> rounding_modes{FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

inline const char* mode_name(int mode)
{
  return mode == FE_TONEAREST ? "nearest" : mode == FE_UPWARD ? "upward" : mode == FE_DOWNWARD ? "downward" : "to zero";
}

/// The mode in which doubles are rounded now, found out by rounding. (std::fegetround reads the x87 unit, which
/// CGAL leaves alone where doubles live in SSE registers.)
inline int observed_mode()
{
  const bool up = locus::detail::opaque_sum(1.0, 0x1p-80) > 1.0,
             minus_up = locus::detail::opaque_sum(-1.0, 0x1p-80) > -1.0;
  const bool down = locus::detail::opaque_sum(1.0, -0x1p-80) < 1.0,
             minus_down = locus::detail::opaque_sum(-1.0, -0x1p-80) < -1.0;
  if (up && minus_up && !down && !minus_down) return FE_UPWARD;
  if (!up && !minus_up && down && minus_down) return FE_DOWNWARD;
  if (!up && minus_up && down && !minus_down) return FE_TOWARDZERO;
  return !up && !minus_up && !down && !minus_down ? FE_TONEAREST : -1;
}

/// Runs `f` in a rounding mode, in a frame of its own, and restores the old one.
template <class F>
[[gnu::noinline]] void in_mode(int mode, F&& f)
{
  struct Restore {
    int mode = std::fegetround();
    ~Restore() { std::fesetround(mode); }
  } restore;
  std::fesetround(mode);
  locus::detail::call_out_of_line(f);
}

// ------------------------------------------------------------------------------- plain arithmetic to compare with

inline Integer choose(int n, int k)
{
  Integer b;
  mpz_bin_uiui(b.get_mpz_t(), static_cast<unsigned long>(n), static_cast<unsigned long>(k));
  return b;
}

inline Rational power(const Rational& x, int n)
{
  Rational p = 1;
  for (int i = 0; i < n; ++i) p *= x;
  return p;
}

inline Rational two_to(int e)
{
  Rational x = 1;
  if (e >= 0) mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(e));
  else mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-e));
  return x;
}

/// Value of a Bernstein form straight from the definition: the sum of coefficients times basis functions.
template <int D>
Rational plain_value(const Bernstein<Rational, D>& f, const std::array<Rational, static_cast<std::size_t>(D)>& point)
{
  std::array<std::vector<Rational>, static_cast<std::size_t>(D)> basis;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const int n = f.degrees()[k];
    for (int i = 0; i <= n; ++i)
      basis[k].push_back(Rational(choose(n, i) * power(point[k], i) * power(Rational(1 - point[k]), n - i)));
  }
  Rational sum = 0;
  for (std::size_t at = 0; at < f.size(); ++at) {
    std::size_t rest = at;
    Rational term = f[at];
    for (std::size_t k = point.size(); k-- > 0;) {
      const std::size_t extent = static_cast<std::size_t>(f.degrees()[k]) + 1;
      term *= basis[k][rest % extent];
      rest /= extent;
    }
    sum += term;
  }
  return sum;
}

/// Univariate polynomials in the monomial basis, lowest coefficient first, without leading zeros.
using Polynomial = std::vector<Rational>;

inline Polynomial trimmed(Polynomial f)
{
  while (!f.empty() && f.back() == 0) f.pop_back();
  return f;
}

inline Rational horner(const Polynomial& f, const Rational& x)
{
  Rational y = 0;
  for (std::size_t i = f.size(); i-- > 0;) y = Rational(y * x + f[i]);
  return y;
}

inline Polynomial times(const Polynomial& f, const Polynomial& g)
{
  if (f.empty() || g.empty()) return {};
  Polynomial h(f.size() + g.size() - 1, Rational(0));
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) h[i + j] += f[i] * g[j];
  return trimmed(h);
}

inline Polynomial plus(Polynomial f, const Polynomial& g)
{
  f.resize(std::max(f.size(), g.size()), Rational(0));
  for (std::size_t i = 0; i < g.size(); ++i) f[i] += g[i];
  return trimmed(f);
}

inline Polynomial slope(const Polynomial& f)
{
  Polynomial d;
  for (std::size_t i = 1; i < f.size(); ++i) d.push_back(Rational(f[i] * static_cast<unsigned long>(i)));
  return d;
}

inline Polynomial remainder(Polynomial f, const Polynomial& g)
{
  f = trimmed(std::move(f));
  while (f.size() >= g.size() && !f.empty()) {
    const Rational q = f.back() / g.back();
    const std::size_t shift = f.size() - g.size();
    for (std::size_t i = 0; i < g.size(); ++i) f[i + shift] -= q * g[i];
    f = trimmed(std::move(f));
  }
  return f;
}

inline Polynomial monic(Polynomial f)
{
  f = trimmed(std::move(f));
  if (f.empty()) return f;
  const Rational lead = f.back();
  for (Rational& c : f) c /= lead;
  return f;
}

/// Euclid's algorithm in rationals.
inline Polynomial euclid(Polynomial f, Polynomial g)
{
  f = monic(std::move(f));
  g = monic(std::move(g));
  while (!g.empty()) {
    Polynomial r = monic(remainder(f, g));
    f = std::move(g);
    g = std::move(r);
  }
  return f;
}

/// f(a + b·x).
inline Polynomial compose_linear(const Polynomial& f, const Rational& a, const Rational& b)
{
  Polynomial result;
  const Polynomial inner = trimmed({a, b});
  for (std::size_t i = f.size(); i-- > 0;) result = plus(times(result, inner), {f[i]});
  return trimmed(result);
}

/// The polynomial with these roots, times a factor.
inline Polynomial with_roots(const std::vector<Rational>& roots, const Rational& factor = 1)
{
  Polynomial f{factor};
  for (const Rational& r : roots) f = times(f, {Rational(-r), Rational(1)});
  return f;
}

/// f/g for g dividing f.
inline Polynomial quotient(Polynomial f, const Polynomial& g)
{
  f = trimmed(std::move(f));
  Polynomial q(f.size() >= g.size() ? f.size() - g.size() + 1 : 0, Rational(0));
  while (f.size() >= g.size() && !f.empty()) {
    const std::size_t shift = f.size() - g.size();
    q[shift] = f.back() / g.back();
    const Rational c = q[shift];
    for (std::size_t i = 0; i < g.size(); ++i) f[i + shift] -= c * g[i];
    f = trimmed(std::move(f));
  }
  if (!f.empty()) throw std::logic_error("quotient: the divisor does not divide");
  return q;
}

/// A positive multiple with integer coefficients: quick to ask for signs.
inline std::vector<Integer> with_integers(const Polynomial& f)
{
  Integer denominator = 1, common = 0;
  for (const Rational& c : f) denominator = lcm(denominator, c.get_den());
  std::vector<Integer> a;
  for (const Rational& c : f) a.push_back(Integer(c.get_num() * Integer(denominator / c.get_den())));
  for (const Integer& c : a) common = gcd(common, c);
  if (common != 0)
    for (Integer& c : a) c /= common;
  return a;
}

inline int sign_at(const std::vector<Integer>& f, const Rational& x)
{
  Integer sum = 0, power = 1;
  for (std::size_t i = f.size(); i-- > 0;) {
    sum = Integer(sum * x.get_num() + f[i] * power);
    power *= x.get_den();
  }
  return sgn(sum);
}

/// Sturm's chain of a polynomial: f, f', and the negated remainders, all divided by the last one. It counts distinct
/// roots, multiple ones too.
class Sturm {
public:
  explicit Sturm(const Polynomial& f)
  {
    std::vector<Polynomial> chain{trimmed(f), slope(trimmed(f))};
    while (!chain.back().empty()) {
      Polynomial r = remainder(chain[chain.size() - 2], chain.back());
      Rational size = 1;
      if (!r.empty()) size = abs(r.back());
      for (Rational& c : r) c /= -size; // a positive factor keeps the numbers short
      chain.push_back(std::move(r));
    }
    chain.pop_back();
    for (const Polynomial& g : chain) chain_.push_back(with_integers(quotient(g, chain.back())));
  }

  /// Distinct roots in the half-open interval (a, b], in the closed and in the open one.
  int half_open(const Rational& a, const Rational& b) const { return changes(a) - changes(b); }
  int closed(const Rational& a, const Rational& b) const { return half_open(a, b) + (is_root(a) ? 1 : 0); }
  int open(const Rational& a, const Rational& b) const { return half_open(a, b) - (is_root(b) ? 1 : 0); }
  bool is_root(const Rational& x) const { return sign_at(chain_[0], x) == 0; }

private:
  int changes(const Rational& x) const
  {
    int count = 0, last = 0;
    for (const auto& f : chain_) {
      const int s = sign_at(f, x);
      if (s == 0) continue;
      if (last != 0 && s != last) ++count;
      last = s;
    }
    return count;
  }

  std::vector<std::vector<Integer>> chain_;
};

/// Bernstein coefficients on [0,1] of a polynomial, written with degree `n`: Horner's rule in the basis u^i (1-u)^(n-i).
inline Bernstein<Rational, 1> bernstein_on_unit(const Polynomial& f, int n)
{
  std::vector<Rational> scaled; // of degree scaled.size()-1 in the scaled basis
  for (int k = n; k >= 0; --k) {
    std::vector<Rational> next(scaled.empty() ? 1 : scaled.size() + 1, Rational(0));
    for (std::size_t i = 0; i < scaled.size(); ++i) next[i + 1] += scaled[i];
    const int m = static_cast<int>(next.size()) - 1;
    const auto kk = static_cast<std::size_t>(k);
    if (kk < f.size())
      for (int i = 0; i <= m; ++i) next[static_cast<std::size_t>(i)] += f[kk] * choose(m, i);
    scaled = std::move(next);
  }
  for (int i = 0; i <= n; ++i) scaled[static_cast<std::size_t>(i)] /= choose(n, i);
  return Bernstein<Rational, 1>(Degrees<1>{n}, std::move(scaled));
}

/// Bernstein coefficients on [lo, hi].
inline Bernstein<Rational, 1> bernstein_on(const Polynomial& f, const Rational& lo, const Rational& hi, int n)
{
  return bernstein_on_unit(compose_linear(f, lo, Rational(hi - lo)), n);
}

} // namespace locus_test

#endif
