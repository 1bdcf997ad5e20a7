// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_TEST_SYSTEM_SUPPORT_H
#define LOCUS_TEST_SYSTEM_SUPPORT_H

// Polynomials in D variables by monomials, systems made of them, and an exact count of a plane system's solutions by
// resultants. Shares no code with the library but its types.

#include "support.h"

#include <locus/zero_set/system.h>

#include <map>
#include <memory>
#include <optional>

namespace locus_test {

template <int D>
struct Terms {
  using Exponents = std::array<int, static_cast<std::size_t>(D)>;
  std::map<Exponents, Rational> terms;

  Terms() = default;
  Terms(const Rational& c) { terms[Exponents{}] = c; }
  Terms(int c) : Terms(Rational(c)) {}

  static Terms variable(int v)
  {
    Terms f;
    Exponents e{};
    e[static_cast<std::size_t>(v)] = 1;
    f.terms[e] = 1;
    return f;
  }

  Degrees<D> degrees() const
  {
    Degrees<D> d{};
    for (const auto& [e, c] : terms)
      for (std::size_t v = 0; v < d.size() && c != 0; ++v) d[v] = std::max(d[v], e[v]);
    return d;
  }

  Rational at(const std::array<Rational, static_cast<std::size_t>(D)>& p) const
  {
    Rational sum = 0;
    for (const auto& [e, c] : terms) {
      Rational t = c;
      for (std::size_t v = 0; v < p.size(); ++v) t *= power(p[v], e[v]);
      sum += t;
    }
    return sum;
  }

  /// Coefficients in the Bernstein basis, from the definition.
  Bernstein<Rational, D> bernstein() const
  {
    Bernstein<Rational, D> f(degrees());
    Degrees<D> i{};
    std::size_t at = 0;
    do {
      for (const auto& [e, c] : terms) {
        if (c == 0) continue;
        Rational t = c;
        for (std::size_t v = 0; v < i.size(); ++v) t *= Rational(choose(i[v], e[v])) / choose(f.degrees()[v], e[v]);
        f[at] += t;
      }
      ++at;
    } while (locus::advance_index(i, f.degrees()));
    return f;
  }

  /// Variable v of the result is variable order[v] of this one, mirrored (1 - x) where asked for.
  Terms rearranged(const std::array<int, static_cast<std::size_t>(D)>& order,
                   const std::array<bool, static_cast<std::size_t>(D)>& mirror) const;

  /// With one variable set to a number: it stays, with exponent zero.
  Terms with(int v, const Rational& value) const
  {
    Terms f;
    for (const auto& [e, c] : terms) {
      Exponents rest = e;
      rest[static_cast<std::size_t>(v)] = 0;
      f.terms[rest] += c * power(value, e[static_cast<std::size_t>(v)]);
    }
    return f;
  }

  friend Terms operator+(Terms f, const Terms& g)
  {
    for (const auto& [e, c] : g.terms) f.terms[e] += c;
    return f;
  }
  friend Terms operator*(const Terms& f, const Terms& g)
  {
    Terms product;
    for (const auto& [e, c] : f.terms)
      for (const auto& [d, b] : g.terms) {
        auto sum = e;
        for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += d[v];
        product.terms[sum] += c * b;
      }
    return product;
  }
  friend Terms operator-(const Terms& f, const Terms& g) { return f + Terms(-1) * g; }

  std::string text() const
  {
    std::string s;
    for (const auto& [e, c] : terms)
      if (c != 0) s += " + (" + c.get_str() + ")" + show(e);
    return s.empty() ? "0" : s;
  }
};

template <int D>
Terms<D> Terms<D>::rearranged(const std::array<int, static_cast<std::size_t>(D)>& order,
                              const std::array<bool, static_cast<std::size_t>(D)>& mirror) const
{
  Terms f;
  for (const auto& [e, c] : terms) {
    Terms t(c);
    for (int v = 0; v < D; ++v) {
      const auto vv = static_cast<std::size_t>(v);
      const Terms x = mirror[vv] ? Terms(1) - variable(v) : variable(v);
      for (int k = 0; k < e[static_cast<std::size_t>(order[vv])]; ++k) t = t * x;
    }
    f = f + t;
  }
  return f;
}

template <std::size_t K, int D>
locus::System<static_cast<int>(K), D> system_of(const std::array<Terms<D>, K>& f)
{
  locus::System<static_cast<int>(K), D> s;
  for (std::size_t k = 0; k < K; ++k)
    s.equations[k] = std::make_shared<locus::Polynomial_equation<D>>(f[k].bernstein());
  return s;
}

inline Rational fraction(long p, long n = 1)
{
  Rational r(p, n);
  r.canonicalize();
  return r;
}

/// A polynomial of these degrees with small integer coefficients.
template <int D>
Terms<D> random_terms(Random& random, const Degrees<D>& degrees, int size)
{
  Terms<D> f;
  Degrees<D> e{};
  do f.terms[e] = random.between(-size, size);
  while (locus::advance_index(e, degrees));
  return f;
}

// ------------------------------------------------------------------------------------- exact solutions in the plane

/// Common zeros of f and g in the open unit square, exactly: by the resultant in the second variable, and the first
/// subresultant, which gives the second coordinate. Nothing where that fails: a common factor, a zero on the boundary,
/// two zeros with one first coordinate.
class Exact_plane_system {
public:
  using Matrix = std::vector<std::vector<Polynomial>>;

  Exact_plane_system(const Terms<3>& f, const Terms<3>& g, int first, int second)
    : f_(rows(f, first, second)), g_(rows(g, first, second))
  {
  }

  /// Approximations of all zeros, each with its proof behind it.
  std::optional<std::vector<std::array<double, 2>>> zeros() const
  {
    const std::size_t m = f_.size() - 1, n = g_.size() - 1;
    if (f_.empty() || g_.empty() || m == 0 || n == 0) return std::nullopt;
    const Polynomial r = determinant(sylvester(m + n, n, m));
    if (trimmed(r).empty()) return std::nullopt;
    Polynomial s1, s0; // y = -s0/s1
    if (m == 1) {
      s1 = f_[1], s0 = f_[0];
    } else if (n == 1) {
      s1 = g_[1], s0 = g_[0];
    } else {
      s1 = determinant(sylvester(m + n - 2, n - 1, m - 1));
      s0 = determinant(with_last_column(sylvester(m + n - 2, n - 1, m - 1), m + n - 2, n - 1, m - 1));
    }
    return locate(r, trimmed(s1), trimmed(s0));
  }

private:
  /// Coefficients of powers of the second variable, as polynomials in the first.
  static std::vector<Polynomial> rows(const Terms<3>& f, int first, int second)
  {
    std::vector<Polynomial> c;
    for (const auto& [e, a] : f.terms) {
      const auto i = static_cast<std::size_t>(e[static_cast<std::size_t>(first)]),
                 j = static_cast<std::size_t>(e[static_cast<std::size_t>(second)]);
      if (c.size() <= j) c.resize(j + 1);
      if (c[j].size() <= i) c[j].resize(i + 1, Rational(0));
      c[j][i] += a;
    }
    for (Polynomial& p : c) p = trimmed(p);
    while (!c.empty() && c.back().empty()) c.pop_back();
    return c;
  }

  Polynomial coefficient(const std::vector<Polynomial>& f, long j) const
  {
    return j >= 0 && j < static_cast<long>(f.size()) ? f[static_cast<std::size_t>(j)] : Polynomial{};
  }

  /// y^(a-1)·f, …, f, y^(b-1)·g, …, g, by falling powers from y^(a+m-1), of which `size` columns are kept.
  Matrix sylvester(std::size_t size, std::size_t a, std::size_t b) const
  {
    Matrix matrix;
    const auto row = [&](const std::vector<Polynomial>& f, std::size_t shift, std::size_t top) {
      std::vector<Polynomial> entries;
      for (std::size_t c = 0; c < size; ++c)
        entries.push_back(coefficient(f, static_cast<long>(top) - static_cast<long>(c) - static_cast<long>(shift)));
      matrix.push_back(entries);
    };
    const std::size_t top = a + f_.size() - 2;
    for (std::size_t k = a; k-- > 0;) row(f_, k, top);
    for (std::size_t k = b; k-- > 0;) row(g_, k, top);
    return matrix;
  }

  Matrix with_last_column(Matrix m, std::size_t size, std::size_t a, std::size_t b) const
  {
    const Matrix next = sylvester(size + 1, a, b);
    for (std::size_t r = 0; r < m.size(); ++r) m[r].back() = next[r].back();
    return m;
  }

  static Polynomial determinant(const Matrix& m)
  {
    if (m.size() == 1) return m[0][0];
    Polynomial sum;
    for (std::size_t c = 0; c < m.size(); ++c) {
      if (m[0][c].empty()) continue;
      Matrix minor;
      for (std::size_t r = 1; r < m.size(); ++r) {
        minor.push_back(m[r]);
        minor.back().erase(minor.back().begin() + static_cast<std::ptrdiff_t>(c));
      }
      sum = plus(sum, times({Rational(c % 2 == 0 ? 1 : -1)}, times(m[0][c], determinant(minor))));
    }
    return trimmed(sum);
  }

  static std::optional<std::vector<std::array<double, 2>>> locate(const Polynomial& r, const Polynomial& s1,
                                                                  const Polynomial& s0)
  {
    const Polynomial square_free = quotient(r, euclid(r, slope(r)));
    if (square_free.size() != trimmed(r).size() || s1.empty()) return std::nullopt; // a multiple root: two zeros above
    const Sturm roots(square_free);
    if (roots.is_root(0) || roots.is_root(1)) return std::nullopt;
    std::vector<std::array<double, 2>> found;
    std::vector<std::pair<Rational, Rational>> open{{0, 1}};
    while (!open.empty()) {
      auto [lo, hi] = open.back();
      open.pop_back();
      const int n = roots.half_open(lo, hi);
      if (n == 0) continue;
      const Rational mid = (lo + hi) / 2;
      if (n > 1 || hi - lo > fraction(1, 1L << 40)) {
        open.push_back({lo, mid});
        open.push_back({mid, hi});
        continue;
      }
      // y lies in (0, 1) where s0 and s1 have opposite signs and s0 + s1 has that of s1.
      const Polynomial at_one = plus(s0, s1);
      for (const Polynomial& p : {s1, s0, at_one})
        if (p.empty() || Sturm(p).closed(lo, hi) > 0) return std::nullopt;
      const Rational a = horner(s1, mid), b = horner(s0, mid), c = horner(at_one, mid);
      if (sgn(a) == -sgn(b) && sgn(c) == sgn(a)) found.push_back({mid.get_d(), Rational(-b / a).get_d()});
    }
    return found;
  }

  std::vector<Polynomial> f_, g_;
};

} // namespace locus_test

#endif
