// SPDX-License-Identifier: LGPL-3.0-or-later
// What each rung of the ladder of number types costs: one array of bidegree (8,8) is halved once in each variable, and
// the signs of the four parts' coefficients are read. Rounding upward, as in a solve.
#include "side_by_side.h"

#include <locus/zero_set/cell_tree.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <random>

namespace {

using locus::Bernstein;
using locus::Interval;
using locus::Rational;
using locus::Scaled_integer;
using locus::detail::Range_sign;
using locus::detail::Range_sign_of;
using locus_benchmark::keep;

constexpr int degree = 8;
constexpr std::size_t count = (degree + 1) * (degree + 1);
constexpr int repeats = 50; ///< in one change of the rounding mode

Bernstein<Rational, 2> random_array()
{
  std::mt19937_64 engine(20240607);
  Bernstein<Rational, 2> f({degree, degree});
  for (std::size_t i = 0; i < f.size(); ++i)
    f[i] = Rational(static_cast<long>(engine() % (std::uint64_t(1) << 41)) - (1L << 40)) / (1L << 20);
  return f;
}

/// The four quarters of a raw array, in storage that is there already. `whole(i)` gives coefficient i.
template <class T, class Half>
class Quarters {
public:
  explicit Quarters(const Bernstein<T, 2>& whole) : whole_(whole.coefficients()) {}

  void cut()
  {
    const auto first = locus::layout_along(locus::Degrees<2>{degree, degree}, 0);
    const auto second = locus::layout_along(locus::Degrees<2>{degree, degree}, 1);
    locus::detail::split_kernel(whole_.data(), half_[0].data(), half_[1].data(), first, Half());
    for (std::size_t k : {0u, 1u})
      locus::detail::split_kernel(half_[k].data(), quarter[2 * k].data(), quarter[2 * k + 1].data(), second, Half());
  }

  std::array<std::array<T, count>, 4> quarter;

private:
  std::vector<T> whole_;
  std::array<std::array<T, count>, 2> half_;
};

struct Half_double {
  double operator()(double a, double b) const { return 0.5 * (a + b); }
};

struct Half_interval {
  Interval operator()(const Interval& a, const Interval& b) const
  {
    const Interval sum = a + b;
    return {0.5 * sum.inf(), 0.5 * sum.sup()};
  }
};

Range_sign range(double lo, double hi, double error)
{
  if (lo > error) return Range_sign::positive;
  if (hi < -error) return Range_sign::negative;
  return lo < -error && hi > error ? Range_sign::mixed : Range_sign::unknown;
}

/// Every coefficient is looked at, as an empty cell's are: no early end.
template <class Coefficients, class Sign_of>
Range_sign scan(const Coefficients& c, Sign_of sign)
{
  Range_sign_of range;
  for (std::size_t i = 0; i < count; ++i) range.add(sign(c, i));
  return range.result();
}

/// Least and greatest coefficient, without branches.
std::pair<double, double> extremes(const std::array<double, count>& c)
{
  double lo = c[0], hi = c[0];
  for (const double x : c) {
    lo = x < lo ? x : lo;
    hi = x > hi ? x : hi;
  }
  return {lo, hi};
}

void in_doubles(Quarters<double, Half_double>& q)
{
  q.cut();
  for (const auto& c : q.quarter) {
    const auto [lo, hi] = extremes(c);
    keep(range(lo, hi, 0));
  }
}

/// With one bound for each array: it grows by each cut, and the next cut wants the greatest coefficient.
void in_bounded_doubles(Quarters<double, Half_double>& q, double norm)
{
  q.cut();
  const double once = locus::detail::accumulated_error(0x1p-52 * norm, degree, norm);
  const double error = locus::detail::accumulated_error(once, degree, norm);
  for (const auto& c : q.quarter) {
    const auto [lo, hi] = extremes(c);
    keep(std::max(-lo, hi) + error);
    keep(range(lo, hi, error));
  }
}

void in_intervals(Quarters<Interval, Half_interval>& q)
{
  q.cut();
  for (const auto& c : q.quarter) keep(scan(c, [](const auto& a, std::size_t i) { return locus::sign_of(a[i]); }));
}

template <class T, class Sign_of>
void exactly(const Bernstein<T, 2>& f, Sign_of sign)
{
  const auto halves = locus::split(f, 0, Rational(1, 2));
  for (const auto* half : {&halves.first, &halves.second}) {
    const auto quarters = locus::split(*half, 1, Rational(1, 2));
    keep(scan(quarters.first, sign));
    keep(scan(quarters.second, sign));
  }
}

} // namespace

int main()
{
  const Bernstein<Rational, 2> rational = random_array();
  const Bernstein<Scaled_integer, 2> integer(rational);
  Quarters<double, Half_double> doubles(locus::converted<double>(rational, [](const Rational& c) { return c.get_d(); }));
  Quarters<Interval, Half_interval> intervals(locus::converted<Interval>(rational, [](const Rational& c) { return locus::enclosing(c); }));
  const auto many = [](auto job) {
    return [job] {
      locus::with_upward_rounding([&] {
        for (int i = 0; i < repeats; ++i) job();
      });
    };
  };
  const char* names[] = {"double", "double with an error bound", "interval", "integers with one scale", "rationals"};
  const auto t = locus_benchmark::side_by_side(
    {many([&] { in_doubles(doubles); }), many([&] { in_bounded_doubles(doubles, 0x1p21); }), many([&] { in_intervals(intervals); }),
     many([&] { exactly(integer, [](const auto& f, std::size_t i) { return f.sign(i); }); }),
     many([&] { exactly(rational, [](const auto& f, std::size_t i) { return locus::sign_of(f[i]); }); })},
    15, 0.02);
  std::printf("Halving an array of bidegree (8,8) in both variables and reading its signs: processor time, least of the rounds\n");
  for (std::size_t k = 0; k < t.size(); ++k)
    std::printf("  %-28s %9.2f µs (median %.2f)  %7.2f × double\n", names[k], 1e6 * t[k].least / repeats, 1e6 * t[k].median / repeats,
                t[k].least / t[0].least);
}
