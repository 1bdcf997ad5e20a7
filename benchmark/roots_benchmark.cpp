// SPDX-License-Identifier: LGPL-3.0-or-later
// All real roots of univariate integer polynomials with their multiplicities: locus::real_roots and CGAL's
// Algebraic_kernel_d_1 with CORE's integers, in turns in one run. Returns 1 where the two disagree.
#define CGAL_USE_GMP 1
#define CGAL_USE_MPFR 1
#define CGAL_USE_CORE 1

#include "side_by_side.h"

#include <locus/zero_set/real_roots.h>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuse-after-free" // gcc 12 sees one in CGAL's reference counting
#endif
#include <CGAL/CORE_BigInt.h>

#include <CGAL/Algebraic_kernel_d_1.h>

#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

namespace {

using locus::Integer;
using locus::Integer_polynomial;
using locus::degree;
using locus::multiply;
using locus_benchmark::Timing;
using Kernel = CGAL::Algebraic_kernel_d_1<CORE::BigInt>;

constexpr double aim = 3;

class Families {
public:
  explicit Families(std::uint64_t seed) : engine_(seed) {}

  static std::vector<std::string> names() { return {"random", "spread", "clustered", "chebyshev", "multiple"}; }

  Integer_polynomial make(const std::string& name, int n)
  {
    if (name == "random") return random(n, 32);
    if (name == "spread") return spread(n);
    if (name == "clustered") return clustered(n);
    if (name == "chebyshev") return chebyshev(n);
    return multiple(n);
  }

private:
  /// A signed integer of fewer than `bits` bits, not zero.
  Integer integer(int bits)
  {
    const auto half = static_cast<long>(1) << (bits - 1);
    const long x = static_cast<long>(engine_() % static_cast<std::uint64_t>(2 * half)) - half;
    return x == 0 ? 1 : x;
  }

  Integer_polynomial random(int n, int bits)
  {
    Integer_polynomial f;
    for (int i = 0; i <= n; ++i) f.push_back(integer(bits));
    return f;
  }

  /// Different roots k/16, between -16 and 16.
  Integer_polynomial spread(int n)
  {
    std::vector<long> numerators;
    while (numerators.size() < static_cast<std::size_t>(n)) {
      const long k = integer(9).get_si();
      if (std::find(numerators.begin(), numerators.end(), k) == numerators.end()) numerators.push_back(k);
    }
    Integer_polynomial f{Integer(1)};
    for (const long k : numerators) f = multiply(f, Integer_polynomial{Integer(-k), Integer(16)});
    return f;
  }

  /// Roots in threes, 7/11·2^-20 apart.
  static Integer_polynomial clustered(int n)
  {
    Integer_polynomial f{Integer(1)};
    for (long i = 0; i < n; ++i) {
      const long centre = i / 3 * 3 + 1, scale = 1 << 20;
      f = multiply(f, Integer_polynomial{Integer(-(centre * scale + i % 3 * 7)), Integer(11 * scale)});
    }
    return f;
  }

  static Integer_polynomial chebyshev(int n)
  {
    Integer_polynomial before{Integer(1)}, current{Integer(0), Integer(1)};
    for (int i = 1; i < n; ++i) {
      Integer_polynomial next = multiply(current, Integer_polynomial{Integer(0), Integer(2)});
      for (std::size_t k = 0; k < before.size(); ++k) next[k] -= before[k];
      before = std::move(current);
      current = std::move(next);
    }
    return current;
  }

  /// p·q²·r³ of random p, q, r.
  Integer_polynomial multiple(int n)
  {
    const Integer_polynomial q = random(n / 6, 10), r = random(n / 6, 10), q2 = multiply(q, q), r3 = multiply(r, multiply(r, r));
    return multiply(multiply(q2, r3), random(n - degree(q2) - degree(r3), 10));
  }

  std::mt19937_64 engine_;
};

using Kernel_roots = std::vector<std::pair<Kernel::Algebraic_real_1, Kernel::Multiplicity_type>>;

Kernel::Polynomial_1 for_kernel(const Integer_polynomial& f)
{
  std::vector<CORE::BigInt> coefficients;
  for (const Integer& c : f) coefficients.emplace_back(c.get_mpz_t());
  return Kernel::Polynomial_1(coefficients.begin(), coefficients.end());
}

bool agree(const std::vector<locus::Real_root>& ours, const Kernel_roots& theirs)
{
  if (ours.size() != theirs.size()) return false;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double x = CGAL::to_double(theirs[i].first), tolerance = 1e-12 * (1 + std::abs(x));
    if (ours[i].multiplicity != static_cast<int>(theirs[i].second)) return false;
    if (x < ours[i].lo.get_d() - tolerance || x > ours[i].hi.get_d() + tolerance) return false;
  }
  return true;
}

} // namespace

int main()
{
  std::printf("Real roots of integer polynomials: processor time in µs, least of the rounds (median)\n");
  std::printf("%-10s %6s %5s %22s %26s %8s\n", "family", "degree", "roots", "locus", "CGAL AK_d_1, CORE", "ratio");
  Families families(20240607);
  const auto solve = Kernel().solve_1_object();
  bool right = true;
  double worst = 1e300;
  for (const std::string& name : Families::names())
    for (const int n : {6, 10, 20, 24, 40, 60}) {
      const Integer_polynomial f = families.make(name, n);
      const Kernel::Polynomial_1 g = for_kernel(f);
      const auto theirs = [&] {
        Kernel_roots roots;
        solve(g, std::back_inserter(roots));
        return roots;
      };
      const auto ours = locus::real_roots(f);
      const bool same = agree(ours, theirs());
      right = right && same;
      const std::vector<Timing> t =
        locus_benchmark::side_by_side({[&] { locus_benchmark::keep(locus::real_roots(f)); }, [&] { locus_benchmark::keep(theirs()); }});
      const double ratio = t[1].least / t[0].least;
      worst = std::min(worst, ratio);
      std::printf("%-10s %6d %5zu %10.1f (%9.1f) %14.1f (%9.1f) %7.1fx%s\n", name.c_str(), n, ours.size(), 1e6 * t[0].least,
                  1e6 * t[0].median, 1e6 * t[1].least, 1e6 * t[1].median, ratio, same ? "" : "  THE TWO DISAGREE");
      std::fflush(stdout);
    }
  std::printf("least ratio %.1f, aim at least %.0f: %s\n", worst, aim, worst >= aim ? "met" : "NOT MET");
  return right ? 0 : 1;
}
