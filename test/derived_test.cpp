// SPDX-License-Identifier: LGPL-3.0-or-later
// Derived curves and surfaces, proved as identities of polynomials: every formula is compared with the definition in x', x''
// and x''' of x = p/w, which plain monomials and the quotient rule give, by a difference that vanishes identically.
#include <locus/bisector_3.h>
#include <locus/curvature.h>
#include <locus/evolute.h>

#include "shape_support.h"

#include <catch2/catch.hpp>

using namespace locus;
using locus_test::Random;
using locus_test::Samples;

namespace {

// ------------------------------------------------------------------------------------------------ polynomials in u and v

/// Integer coefficients of u^i v^j, without leading zeros; multiplied as at school.
class Form {
public:
  Form() : c_(1) {}
  explicit Form(const Integer& x) : c_{x} {}
  Form(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns), c_(rows * columns) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  int degree(int variable) const { return static_cast<int>(variable == 0 ? rows_ : columns_) - 1; }
  const Integer& at(std::size_t i, std::size_t j) const { return c_[i * columns_ + j]; }
  Integer& at(std::size_t i, std::size_t j) { return c_[i * columns_ + j]; }
  const std::vector<Integer>& coefficients() const { return c_; }
  std::vector<Integer>& coefficients() { return c_; }
  bool is_zero() const { return c_.size() == 1 && c_[0] == 0; }
  bool operator==(const Form& g) const { return rows_ == g.rows_ && columns_ == g.columns_ && c_ == g.c_; }

  Form trimmed() const
  {
    std::size_t rows = 1, columns = 1;
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t j = 0; j < columns_; ++j)
        if (at(i, j) != 0) {
          rows = std::max(rows, i + 1);
          columns = std::max(columns, j + 1);
        }
    if (rows == rows_ && columns == columns_) return *this;
    Form f(rows, columns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) f.at(i, j) = at(i, j);
    return f;
  }

private:
  std::size_t rows_ = 1, columns_ = 1;
  std::vector<Integer> c_;
};

Form sum(const Form& f, const Form& g, int sign)
{
  Form h(std::max(f.rows(), g.rows()), std::max(f.columns(), g.columns()));
  for (std::size_t i = 0; i < f.rows(); ++i)
    for (std::size_t j = 0; j < f.columns(); ++j) h.at(i, j) = f.at(i, j);
  for (std::size_t i = 0; i < g.rows(); ++i)
    for (std::size_t j = 0; j < g.columns(); ++j) {
      if (sign > 0) h.at(i, j) += g.at(i, j);
      else h.at(i, j) -= g.at(i, j);
    }
  return h.trimmed();
}
Form operator+(const Form& f, const Form& g) { return sum(f, g, 1); }
Form operator-(const Form& f, const Form& g) { return sum(f, g, -1); }

Form operator*(const Form& f, const Form& g)
{
  Form h(f.rows() + g.rows() - 1, f.columns() + g.columns() - 1);
  for (std::size_t i = 0; i < f.rows(); ++i)
    for (std::size_t j = 0; j < f.columns(); ++j) {
      if (f.at(i, j) == 0) continue;
      for (std::size_t k = 0; k < g.rows(); ++k)
        for (std::size_t l = 0; l < g.columns(); ++l)
          mpz_addmul(h.at(i + k, j + l).get_mpz_t(), f.at(i, j).get_mpz_t(), g.at(k, l).get_mpz_t());
    }
  return h.trimmed();
}

Form slope(const Form& f, int variable)
{
  Form h(f.rows(), f.columns());
  for (std::size_t i = 0; i < f.rows(); ++i)
    for (std::size_t j = 0; j < f.columns(); ++j) {
      if (variable == 0 && i > 0) h.at(i - 1, j) = f.at(i, j) * static_cast<unsigned long>(i);
      if (variable == 1 && j > 0) h.at(i, j - 1) = f.at(i, j) * static_cast<unsigned long>(j);
    }
  return h.trimmed();
}

/// v becomes u.
Form on_diagonal(const Form& f)
{
  Form h(f.rows() + f.columns() - 1, 1);
  for (std::size_t i = 0; i < f.rows(); ++i)
    for (std::size_t j = 0; j < f.columns(); ++j) h.at(i + j, 0) += f.at(i, j);
  return h.trimmed();
}

locus_test::Polynomial in_u(const Form& f)
{
  locus_test::Polynomial g;
  for (std::size_t i = 0; i < f.rows(); ++i) g.push_back(Rational(f.at(i, 0)));
  return locus_test::trimmed(g);
}

// -------------------------------------------------------------------------------------------- vectors of rational functions

/// N rational functions over one denominator. Nothing but integers is ever cancelled.
template <std::size_t N>
struct Quotient {
  std::array<Form, N> n;
  Form d{Integer(1)};

  Quotient reduced() const
  {
    Integer common = 0;
    const auto look = [&](const Form& f) {
      for (const Integer& c : f.coefficients()) {
        if (common == 1) return;
        common = gcd(common, c);
      }
    };
    look(d);
    for (const Form& f : n) look(f);
    if (common <= 1) return *this;
    Quotient q = *this;
    const auto divide = [&](Form& f) {
      for (Integer& c : f.coefficients()) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), common.get_mpz_t());
    };
    divide(q.d);
    for (Form& f : q.n) divide(f);
    return q;
  }
  bool is_zero() const
  {
    return std::all_of(n.begin(), n.end(), [](const Form& f) { return f.is_zero(); });
  }
  Quotient<1> operator[](std::size_t k) const { return {{n[k]}, d}; }
};
using Scalar = Quotient<1>;

Scalar number(const Rational& x) { return {{Form(x.get_num())}, Form(x.get_den())}; }

template <std::size_t N>
Quotient<N> operator*(const Scalar& f, const Quotient<N>& a)
{
  Quotient<N> q;
  for (std::size_t k = 0; k < N; ++k) q.n[k] = f.n[0] * a.n[k];
  q.d = f.d * a.d;
  return q.reduced();
}
template <std::size_t N>
Quotient<N> operator/(const Quotient<N>& a, const Scalar& f)
{
  return Scalar{{f.d}, f.n[0]} * a;
}
template <std::size_t N>
Quotient<N> operator*(int factor, const Quotient<N>& a)
{
  return number(factor) * a;
}

template <std::size_t N>
Quotient<N> combined(const Quotient<N>& a, const Quotient<N>& b, int sign)
{
  Quotient<N> q;
  const bool alike = a.d == b.d;
  for (std::size_t k = 0; k < N; ++k) q.n[k] = alike ? sum(a.n[k], b.n[k], sign) : sum(a.n[k] * b.d, b.n[k] * a.d, sign);
  q.d = alike ? a.d : a.d * b.d;
  return q.reduced();
}
template <std::size_t N>
Quotient<N> operator+(const Quotient<N>& a, const Quotient<N>& b) { return combined(a, b, 1); }
template <std::size_t N>
Quotient<N> operator-(const Quotient<N>& a, const Quotient<N>& b) { return combined(a, b, -1); }

template <std::size_t N>
Scalar dot(const Quotient<N>& a, const Quotient<N>& b)
{
  Form s;
  for (std::size_t k = 0; k < N; ++k) s = s + a.n[k] * b.n[k];
  return Scalar{{s}, a.d * b.d}.reduced();
}
template <std::size_t N>
Scalar square(const Quotient<N>& a) { return dot(a, a); }

Quotient<3> cross(const Quotient<3>& a, const Quotient<3>& b)
{
  Quotient<3> q;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    q.n[k] = a.n[i] * b.n[j] - a.n[j] * b.n[i];
  }
  q.d = a.d * b.d;
  return q.reduced();
}
/// In the plane the product has one component.
Scalar cross(const Quotient<2>& a, const Quotient<2>& b) { return Scalar{{a.n[0] * b.n[1] - a.n[1] * b.n[0]}, a.d * b.d}.reduced(); }
Scalar volume(const Quotient<3>& a, const Quotient<3>& b, const Quotient<3>& c) { return dot(a, cross(b, c)); }

/// By the quotient rule.
template <std::size_t N>
Quotient<N> slope(const Quotient<N>& a, int variable = 0)
{
  const Form dd = slope(a.d, variable);
  Quotient<N> q;
  for (std::size_t k = 0; k < N; ++k) {
    const Form dn = slope(a.n[k], variable);
    q.n[k] = dd.is_zero() ? dn : dn * a.d - a.n[k] * dd;
  }
  q.d = dd.is_zero() ? a.d : a.d * a.d;
  return q.reduced();
}

template <std::size_t N>
bool same(const Quotient<N>& a, const Quotient<N>& b) { return (a - b).is_zero(); }

/// The given variable becomes lo + length·variable; a number for length 0.
template <std::size_t N>
Quotient<N> substituted(const Quotient<N>& a, int variable, const Rational& lo, const Rational& length)
{
  const Integer e = lcm(lo.get_den(), length.get_den());
  const Rational scaled_lo = lo * Rational(e), scaled_length = length * Rational(e);
  Form inner(variable == 0 ? 2 : 1, variable == 0 ? 1 : 2);
  inner.coefficients() = {scaled_lo.get_num(), scaled_length.get_num()};
  inner = inner.trimmed();
  int m = a.d.degree(variable);
  for (const Form& f : a.n) m = std::max(m, f.degree(variable));
  const auto put_in = [&](const Form& f) {
    Form result;
    for (int i = f.degree(variable); i >= 0; --i) {
      Form part(variable == 0 ? 1 : f.rows(), variable == 0 ? f.columns() : 1);
      Integer power;
      mpz_pow_ui(power.get_mpz_t(), e.get_mpz_t(), static_cast<unsigned long>(m - i));
      const auto at = static_cast<std::size_t>(i);
      for (std::size_t k = 0; k < part.coefficients().size(); ++k) part.coefficients()[k] = power * (variable == 0 ? f.at(at, k) : f.at(k, at));
      result = result * inner + part;
    }
    return result;
  };
  Quotient<N> q;
  for (std::size_t k = 0; k < N; ++k) q.n[k] = put_in(a.n[k]);
  q.d = put_in(a.d);
  return q.reduced();
}

template <std::size_t N>
Quotient<N> on_diagonal(const Quotient<N>& a)
{
  Quotient<N> q;
  for (std::size_t k = 0; k < N; ++k) q.n[k] = on_diagonal(a.n[k]);
  q.d = on_diagonal(a.d);
  return q;
}

template <std::size_t N>
std::array<Rational, N> value(const Quotient<N>& a, const Rational& u)
{
  const Rational d = locus_test::horner(in_u(a.d), u);
  std::array<Rational, N> x;
  for (std::size_t k = 0; k < N; ++k) x[k] = locus_test::horner(in_u(a.n[k]), u) / d;
  return x;
}

// ---------------------------------------------------------------------------------------------- from Bernstein coefficients

struct Table {
  std::size_t rows, columns;
  std::vector<Rational> c;
};

/// Coefficient of t^k in C(n,i) t^i (1-t)^(n-i).
Integer basis_coefficient(int n, int i, int k)
{
  if (k < i) return 0;
  const Integer c = locus_test::choose(n, i) * locus_test::choose(n - i, k - i);
  return (k - i) % 2 == 0 ? c : Integer(-c);
}

template <int D>
Table powers(const Bernstein<Rational, D>& f)
{
  const int n = f.degree(0), m = D == 2 ? f.degree(D - 1) : 0;
  const auto columns = static_cast<std::size_t>(m) + 1;
  Table half{f.size() / columns, columns, std::vector<Rational>(f.size())}, t = half;
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(i) * columns + static_cast<std::size_t>(j); };
  for (int i = 0; i <= n; ++i)
    for (int k = i; k <= n; ++k)
      for (int j = 0; j <= m; ++j) half.c[at(k, j)] += f[at(i, j)] * basis_coefficient(n, i, k);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
      for (int k = j; k <= m; ++k) t.c[at(i, k)] += half.c[at(i, j)] * basis_coefficient(m, j, k);
  return t;
}

/// (numerators)/weight, where polynomials in one variable depend on the given one of u and v.
template <std::size_t N, int D>
Quotient<N> quotient_of(const std::array<Bernstein<Rational, D>, N>& numerator, const Bernstein<Rational, D>& weight, int variable = 0)
{
  std::vector<Table> tables;
  for (const auto& f : numerator) tables.push_back(powers(f));
  tables.push_back(powers(weight));
  Integer common = 1;
  for (const Table& t : tables)
    for (const Rational& c : t.c) common = lcm(common, c.get_den());
  const auto form = [&](const Table& t) {
    Form f = variable == 0 ? Form(t.rows, t.columns) : Form(t.columns, t.rows);
    for (std::size_t i = 0; i < t.c.size(); ++i) f.coefficients()[i] = t.c[i].get_num() * Integer(common / t.c[i].get_den());
    return f.trimmed();
  };
  Quotient<N> q;
  for (std::size_t k = 0; k < N; ++k) q.n[k] = form(tables[k]);
  q.d = form(tables[N]);
  return q.reduced();
}

template <int D>
Bernstein<Rational, D> one() { return Bernstein<Rational, D>(Degrees<D>{}, {Rational(1)}); }

template <std::size_t N, int D>
Quotient<N> exactly(const std::array<Bernstein<Rational, D>, N>& f) { return quotient_of(f, one<D>()); }
template <int D>
Scalar exactly(const Bernstein<Rational, D>& f) { return quotient_of(std::array<Bernstein<Rational, D>, 1>{f}, one<D>()); }
template <int Dim, int K>
Quotient<static_cast<std::size_t>(Dim)> exactly(const Rational_map_piece<Dim, K>& p) { return quotient_of(p.numerator, p.weight); }

template <std::size_t N>
Quotient<N> constant(const std::array<Rational, N>& p)
{
  std::array<Bernstein<Rational, 1>, N> f;
  for (std::size_t k = 0; k < N; ++k) f[k] = Bernstein<Rational, 1>(Degrees<1>{0}, {p[k]});
  return exactly(f);
}

/// A curve piece and its derivatives, from x = p/w alone.
template <int Dim>
struct Definition {
  using Vector = Quotient<static_cast<std::size_t>(Dim)>;
  Vector x, x1, x2, x3;

  explicit Definition(const Curve_piece<Dim>& piece, int variable = 0)
    : x(quotient_of(piece.numerator, piece.weight, variable)), x1(slope(x, variable)), x2(slope(x1, variable)), x3(slope(x2, variable))
  {
  }
  /// x'×x'', in the plane a number.
  auto binormal() const { return cross(x1, x2); }
  /// (x'×x'')×x', times |x'|² the part of x'' across x'.
  Vector normal() const { return square(x1) * x2 - dot(x1, x2) * x1; }
};

// -------------------------------------------------------------------------------------------------------------- inputs

template <int Dim>
Exact_point<Dim> random_point(Random& random, int size = 50)
{
  Exact_point<Dim> p;
  for (Rational& x : p) x = random.between(-size, size);
  return p;
}

template <int Dim>
Rational_curve<Dim> random_bezier(Random& random, int degree, bool rational)
{
  std::vector<Exact_point<Dim>> points;
  std::vector<Rational> weights;
  for (int i = 0; i <= degree; ++i) {
    points.push_back(random_point<Dim>(random));
    Rational w(random.between(1, 60), random.between(1, 30));
    w.canonicalize();
    if (rational) weights.push_back(w);
  }
  return bezier_curve<Dim>(points, weights);
}

template <int Dim>
Rational_curve<Dim> random_spline(Random& random, int degree, int spans, bool rational)
{
  std::vector<Exact_point<Dim>> points;
  std::vector<Rational> knots, weights;
  for (int i = 0; i <= degree; ++i) knots.emplace_back(0);
  for (int s = 1; s < spans; ++s) knots.emplace_back(s);
  for (int i = 0; i <= degree; ++i) knots.emplace_back(spans);
  for (int i = 0; i < degree + spans; ++i) {
    points.push_back(random_point<Dim>(random));
    if (rational) weights.emplace_back(random.between(1, 7));
  }
  return bspline_curve<Dim>(degree, points, knots, weights);
}

template <int Dim>
struct Sample_curve {
  std::string name;
  Rational_curve<Dim> curve;
  int degree = 0;       ///< of a general curve: its derived ones have the generic degrees
  bool rational = false;
};

template <int Dim>
std::vector<Sample_curve<Dim>> random_samples(Random& random, int most_degree = 4, int count = 2)
{
  std::vector<Sample_curve<Dim>> out;
  for (int d = 2; d <= most_degree; ++d)
    for (const bool rational : {false, true})
      for (int k = 0; k < count; ++k) out.push_back({"random of degree " + std::to_string(d), random_bezier<Dim>(random, d, rational), d, rational});
  for (const bool rational : {false, true}) out.push_back({"spline", random_spline<Dim>(random, 3, 3, rational), 0, rational});
  return out;
}

std::vector<Sample_curve<2>> plane_samples(Random& random)
{
  auto out = random_samples<2>(random);
  out.push_back({"line", segment_2({0, 1}, {3, -2}), 0, false});
  out.push_back({"line, not at even speed", bezier_2({{0, 0}, {1, 2}, {3, 6}}), 0, false});
  out.push_back({"arc", arc_2({1, 0}, {0, 1}, "1/3"), 0, true});
  out.push_back({"ellipse", ellipse_2({1, 2}, 4, 2), 0, true});
  out.push_back({"weights of both signs", bezier_2({{0, 0}, {1, 3}, {4, -1}}, {1, "-1/2", 1}), 0, true});
  out.push_back({"weights of both signs", bezier_2({{0, 0}, {1, 3}, {4, -1}, {2, 2}, {0, 5}}, {1, 1, "-1/2", 1, 2}), 0, true});
  return out;
}

std::vector<Sample_curve<3>> space_samples(Random& random)
{
  auto out = random_samples<3>(random);
  out.push_back({"line", segment_3({0, 1, 2}, {3, -2, 1}), 0, false});
  out.push_back({"plane curve", bezier_3({{0, 0, 1}, {1, 2, -2}, {3, 1, -3}, {4, 5, -8}}), 0, false}); // x + y + z = 1
  out.push_back({"plane curve", bezier_3({{0, 0, 0}, {1, 2, 0}, {3, 1, 0}, {4, 5, 0}}, {1, 2, 3, 1}), 0, true});
  out.push_back({"twisted cubic", bezier_3({{0, 0, 0}, {"1/3", 0, 0}, {"2/3", "1/3", 0}, {1, 1, 1}}), 0, false});
  out.push_back({"helix-like", bspline_3(2, {{2, 0, 0}, {2, 2, 1}, {0, 2, 2}, {-2, 2, 3}, {-2, 0, 4}, {-2, -2, 5}, {0, -2, 6}}, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3}, {2, 1, 2, 1, 2, 1, 2}), 0, true});
  out.push_back({"weights of both signs", bezier_3({{0, 0, 0}, {1, 3, 1}, {4, -1, 2}, {2, 2, -3}, {0, 5, 1}}, {1, 1, "-1/2", 1, 2}), 0, true});
  return out;
}

int with_weight(bool rational, int for_rational, int for_polynomial) { return rational ? for_rational : for_polynomial; }

/// A degree: the generic one where the curve is general, at most that of a general one of the piece's degree in any case.
template <int Dim, class Bound>
void expect_degree(Samples& samples, const Sample_curve<Dim>& s, const Curve_piece<Dim>& piece, int found, Bound bound, const char* what)
{
  const int wanted = s.degree ? bound(s.degree, s.rational) : bound(piece.degree(), !piece.is_polynomial());
  samples.expect(s.degree ? found == wanted : found <= std::max(wanted, 0),
                 [&] { return std::string(what) + " of " + s.name + ": degree " + std::to_string(found) + ", not " + std::to_string(wanted); });
}

template <std::size_t N>
int degree_of(const Polynomial_vector<1, N>& f)
{
  int d = 0;
  for (const auto& g : f) d = std::max(d, g.degree());
  return d;
}

/// What the library says the degree is, is the degree.
template <std::size_t N>
bool is_at_true_degree(const Polynomial_vector<1, N>& f)
{
  for (const auto& g : f)
    if (g.degree() != exactly(g).n[0].degree(0)) return false;
  return true;
}

} // namespace

// ------------------------------------------------------------------------------------------------------ building blocks

TEST_CASE("polynomials find their true degrees", "[derived]")
{
  Random random(501);
  Samples samples;
  for (int k = 0; k < 60; ++k) {
    const auto degrees = random.degrees<2>(0, 4);
    auto f = random.polynomial<2>(degrees);
    f[f.size() - 1] += 1; // no power of two below it
    const Form powers_of_f = exactly(f).n[0];
    const auto high = elevate(elevate(f, 0, random.between(0, 3)), 1, random.between(0, 3));
    const auto low = at_true_degree(high);
    samples.expect(low.degree(0) == powers_of_f.degree(0) && low.degree(1) == powers_of_f.degree(1) && same(exactly(low), exactly(f)), "true degree");
    if (powers_of_f.degree(0) == degrees[0]) samples.expect(!lowered_by_one(f, 0), "lowered though it must not be");
    const auto none = at_true_degree(Bernstein<Rational, 2>(degrees));
    samples.expect(none.degrees() == Degrees<2>{} && none[0] == 0, "zero has degree zero");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 120);
}

namespace {

/// By Leibniz: the sum over all permutations.
template <std::size_t N>
Scalar determinant(const std::vector<Quotient<N>>& rows)
{
  std::array<std::size_t, N> p;
  for (std::size_t k = 0; k < N; ++k) p[k] = k;
  Scalar result = number(0);
  do {
    int sign = 1;
    Scalar term = number(1);
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < i; ++j) sign = p[j] > p[i] ? -sign : sign;
      term = term * rows[i][p[i]];
    }
    result = result + sign * term;
  } while (std::next_permutation(p.begin(), p.end()));
  return result;
}

template <std::size_t N>
void check_wronskian(Random& random, Samples& samples)
{
  constexpr int n = static_cast<int>(N);
  for (int d = n - 1; d <= n + 2; ++d) {
    Polynomial_vector<1, N> f;
    for (auto& g : f) g = random.polynomial<1>({d});
    std::vector<Quotient<N>> rows{exactly(f)};
    while (rows.size() < N) rows.push_back(slope(rows.back()));
    const auto w = wronskian(f);
    const auto minors = wronskian_minors(f);
    samples.expect(same(exactly(w), determinant(rows)), "the Wronskian by Leibniz");
    for (std::size_t i = 0; i + 1 < N; ++i) samples.expect(dot(exactly(minors), rows[i]).is_zero(), "minors across the rows");
    samples.expect(same(dot(exactly(minors), rows[N - 1]), (n % 2 == 0 ? -1 : 1) * exactly(w)), "minors times the last row");
    // Those of two functions are the functions themselves, as they are.
    const bool least = n == 2 || is_at_true_degree(minors);
    samples.expect(w.degree() <= n * (d - n + 1) && degree_of(minors) <= (n - 1) * (d - n + 2) && least, "degrees");
    // Dependent functions have none.
    f[N - 1] = multiply(f[0], Rational(3));
    samples.expect(detail::is_zero(wronskian(f)), "dependent functions");
  }
}

} // namespace

TEST_CASE("Wronskians are determinants, their minors orthogonal", "[derived]")
{
  Random random(502);
  Samples samples;
  check_wronskian<2>(random, samples);
  check_wronskian<3>(random, samples);
  check_wronskian<4>(random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 60);
}

TEST_CASE("tangent planes touch their surfaces", "[derived]")
{
  Random random(503);
  Samples samples;
  for (int k = 0; k < 6; ++k) {
    const Degrees<2> degrees{1 + k % 2, 1 + k % 3};
    Polynomial_vector<2, 4> h;
    for (auto& f : h) {
      f = Bernstein<Rational, 2>(degrees);
      for (std::size_t i = 0; i < f.size(); ++i) f[i] = random.between(-20, 20);
    }
    h[3][0] += 41; // not a common factor
    const auto plane = tangent_plane(h);
    const Quotient<4> m = exactly(plane);
    const Quotient<3> x = quotient_of(Polynomial_vector<2, 3>{h[0], h[1], h[2]}, h[3]);
    const Quotient<3> normal = cross(slope(x, 0), slope(x, 1)), M = exactly(Polynomial_vector<2, 3>{plane[0], plane[1], plane[2]});
    const Scalar w = exactly(h[3]), w3 = w * (w * w);
    samples.expect((dot(M, x) + m[3]).is_zero(), "the plane contains its point");
    samples.expect(same(M, w3 * normal) || same(M, -1 * (w3 * normal)), "M is plus or minus the cross product");
    samples.expect(plane[0].degree(0) == 3 * degrees[0] - 2 && plane[0].degree(1) == 3 * degrees[1] - 2, "degree 3d-2");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 18);
}

// ----------------------------------------------------------------------------------------------- derivatives and curvature

namespace {

template <int Dim>
void check_derivative_vectors(const Sample_curve<Dim>& s, const Curve_piece<Dim>& piece, Samples& samples)
{
  const Definition<Dim> c(piece);
  const Derivative_vectors<Dim> v(piece);
  const auto D1 = exactly(v.d1()), D2 = exactly(v.d2()), D3 = exactly(v.d3()), D21 = exactly(v.d21());
  const Scalar w = exactly(piece.weight), w1 = slope(w), w2 = slope(w1), ww = w * w;
  const auto tell = [&](const char* what) { return [what, &s] { return std::string(what) + " of " + s.name; }; };
  samples.expect(same(c.x1, D1 / ww), tell("x'"));
  samples.expect(same(c.x2, D2 / ww - (2 * w1 / (ww * w)) * D1), tell("x''"));
  const Scalar factor = 6 * (w1 * w1) - 2 * (w * w2);
  samples.expect(same(c.x3, (D3 + D21) / ww - (4 * w1 / (ww * w)) * D2 + (factor / (ww * ww)) * D1), tell("x'''"));
  samples.expect(same(w * D21, w1 * D2 - w2 * D1), tell("w D21 = w'D2 - w''D1"));
  samples.expect(same(slope(D1), D2), tell("D1' = D2"));
  samples.expect(is_at_true_degree(v.d1()) && is_at_true_degree(v.d2()) && is_at_true_degree(v.d3()) && is_at_true_degree(v.d21()), tell("true degrees"));
  expect_degree(samples, s, piece, degree_of(v.d1()), [](int d, bool r) { return with_weight(r, 2 * d - 2, d - 1); }, "D1");
  expect_degree(samples, s, piece, degree_of(v.d2()), [](int d, bool r) { return with_weight(r, 2 * d - 3, d - 2); }, "D2");
  expect_degree(samples, s, piece, degree_of(v.d3()), [](int d, bool r) { return with_weight(r, d > 2 ? 2 * d - 4 : 0, std::max(d - 3, 0)); }, "D3");
  expect_degree(samples, s, piece, degree_of(v.d21()), [](int d, bool r) { return with_weight(r, 2 * d - 4, 0); }, "D21");
}

template <int Dim>
void check_curvature(const Sample_curve<Dim>& s, const Curve_piece<Dim>& piece, Random& random, Samples& samples)
{
  constexpr bool plane = Dim == 2;
  const Definition<Dim> c(piece);
  const Derivative_vectors<Dim> v(piece);
  const Curvature_forms<Dim> f(piece);
  const auto bend = exactly(f.bend);
  const auto D1 = exactly(v.d1()), D2 = exactly(v.d2());
  const Scalar w = exactly(piece.weight), w2 = w * w, w3 = w2 * w, S = exactly(f.speed), critical = exactly(f.critical);
  const auto tell = [&](const char* what) { return [what, &s] { return std::string(what) + " of " + s.name; }; };
  samples.expect(same(exactly(f.first), D1) && same(S, square(D1)) && same(exactly(f.weight), w), tell("D1, S, w"));
  samples.expect(same(cross(D1, D2), w * bend), tell("D1×D2 = wβ"));
  samples.expect(same(w3 * c.binormal(), bend), tell("w³ x'×x'' = β"));
  const Scalar s3 = S * (S * S), squared = (w3 * w3) * square(bend) / s3, x1 = square(c.x1);
  // κ² = |x'×x''|²/|x'|⁶
  samples.expect(same(squared * (x1 * (x1 * x1)), square(c.binormal())), tell("κ²"));
  // κ·dκ/du = (κ²)'/2, where du is ds·w²/√S: no square roots are left.
  const Scalar slopes = slope(squared), half = critical * (w3 * w2) / (s3 * S);
  if constexpr (plane) samples.expect(same(2 * (bend * half), slopes), tell("(κ²)'"));
  else samples.expect(same(2 * half, slopes), tell("(κ²)'"));
  expect_degree(samples, s, piece, degree_of(f.bend), [](int d, bool r) { return with_weight(r, 3 * d - 6, 2 * d - 4); }, "bend");
  samples.expect(is_at_true_degree(f.bend), tell("true degree of β"));
  expect_degree(samples, s, piece, f.critical.degree(),
                [](int d, bool r) { return plane ? with_weight(r, 8 * d - 12, 4 * d - 7) : with_weight(r, 11 * d - 18, 6 * d - 11); }, "critical");
  if constexpr (!plane) {
    const auto form = torsion_form(piece);
    const Scalar T = exactly(form), triple = volume(c.x1, c.x2, c.x3);
    samples.expect(same(triple, T / (w2 * w2)), tell("[x' x'' x''']"));
    samples.expect(same(volume(D1, D2, exactly(v.d3())), w2 * T), tell("[D1 D2 D3]"));
    if (!bend.is_zero()) samples.expect(same(triple / square(c.binormal()), w2 * T / square(bend)), tell("τ"));
    expect_degree(samples, s, piece, form.degree(), [](int d, bool r) { return d < 3 ? 0 : with_weight(r, 4 * d - 12, 3 * d - 9); }, "torsion");
  }
  for (int k = 0; k < 4; ++k) {
    const Rational u = random.unit_rational();
    const auto d1 = value(c.x1, u), d2 = value(c.x2, u);
    Rational length2 = 0, along = 0, second2 = 0;
    for (std::size_t i = 0; i < d1.size(); ++i) {
      length2 += d1[i] * d1[i];
      along += d1[i] * d2[i];
      second2 += d2[i] * d2[i];
    }
    if (length2 == 0) continue;
    const Rational k2 = (length2 * second2 - along * along) / (length2 * length2 * length2), rise = value(slopes, u)[0];
    const auto here = f.at(u);
    int side = sgn(k2);
    if constexpr (plane) side = sgn(Rational(d1[0] * d2[1] - d1[1] * d2[0]));
    samples.expect(here.square == k2 && here.sign == side, tell("κ at a parameter"));
    if (k2 == 0) continue;
    samples.expect(here.slope_square == Rational(rise * rise / (4 * k2 * length2)) && here.slope_sign == side * sgn(rise), tell("dκ/ds at a parameter"));
  }
}

} // namespace

TEST_CASE("derivatives of p/w are made of polynomial vectors", "[derived]")
{
  Random random(510);
  Samples samples;
  for (const auto& s : plane_samples(random))
    for (const auto& piece : s.curve.pieces()) check_derivative_vectors(s, piece, samples);
  for (const auto& s : space_samples(random))
    for (const auto& piece : s.curve.pieces()) check_derivative_vectors(s, piece, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 400);
}

TEST_CASE("curvature forms are curvature, its derivative and torsion", "[derived]")
{
  Random random(511);
  Samples samples;
  for (const auto& s : plane_samples(random))
    for (const auto& piece : s.curve.pieces()) check_curvature(s, piece, random, samples);
  for (const auto& s : space_samples(random))
    for (const auto& piece : s.curve.pieces()) check_curvature(s, piece, random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 400);
}

TEST_CASE("a spline along a curve has the pieces' forms in the curve's own parameter", "[derived]")
{
  Random random(512);
  Samples samples;
  const Curve_2 curve = bspline_2(3, {{0, 0}, {1, 4}, {3, 1}, {5, 5}, {6, 2}, {8, 8}}, {0, 0, 0, 0, 1, 3, 4, 4, 4, 4});
  REQUIRE(curve.pieces().size() == 3u);
  const auto spline = spline_along(curve, 1, [](const Curve_piece<2>& p) { return Derivative_vectors<2>(p).d1()[0]; });
  for (int k = 0; k < 20; ++k) {
    const Rational u = 4 * random.unit_rational();
    const std::size_t i = u < 1 ? 0 : u < 3 ? 1 : 2;
    const auto& range = curve.chain().pieces[i];
    // x' by the parameter itself: the weight is one.
    const Rational wanted = value(Definition<2>(curve.pieces()[i]).x1, locus_test::local_value(range, u))[0] / (range.hi - range.lo);
    Rational found = 0;
    for (const auto& span : bezier_spans(spline))
      if (span.lo[0] <= u && u <= span.hi[0]) found = evaluate_at(span.form, Rational((u - span.lo[0]) / (span.hi[0] - span.lo[0])));
    samples.expect(found == wanted, "value of the spline");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 20);
  const auto form = [](const Curve_piece<2>& p) { return p.weight; };
  CHECK_THROWS_AS(spline_along(line_2({0, 0}, {1, 1}), 0, form), Invalid_input);
}

// ------------------------------------------------------------------------------------------------------- derived curves

namespace {

template <int Dim>
void check_evolute(const Sample_curve<Dim>& s, const Rational_curve<Dim>& piece_curve, Samples& samples)
{
  const auto& piece = piece_curve.pieces()[0];
  const Definition<Dim> c(piece);
  const auto tell = [&](const char* what) { return [what, &s] { return std::string(what) + " of " + s.name; }; };
  const auto arc = curvature_vector_map(piece_curve);
  samples.expect(arc.pieces().size() == 1 && same((square(c.x1) * square(c.x1)) * exactly(arc.pieces()[0]), c.normal()), tell("κN"));
  expect_degree(samples, s, piece, arc.degrees()[0], [](int d, bool r) { return with_weight(r, 8 * d - 8, 4 * d - 4); }, "κN");
  const auto map = evolute_map(piece_curve), radius = radius_vector_map(piece_curve);
  if (c.binormal().is_zero()) {
    samples.expect(map.pieces().empty() && radius.pieces().empty() && arc.pieces()[0].degrees()[0] == 0, tell("a straight piece has no evolute"));
    return;
  }
  if (map.pieces().size() != 1 || radius.pieces().size() != 1) return samples.expect(false, tell("an evolute"));
  const auto E = exactly(map.pieces()[0]), off = E - c.x;
  samples.expect(dot(off, c.x1).is_zero(), tell("(E-x)·x' = 0"));
  samples.expect(same(dot(off, c.x2), square(c.x1)), tell("(E-x)·x'' = |x'|²"));
  samples.expect(same(exactly(radius.pieces()[0]), off), tell("N/κ = E-x"));
  if constexpr (Dim == 2) {
    samples.expect(dot(slope(E), c.x1).is_zero(), tell("E' along the normal"));
    expect_degree(samples, s, piece, map.degrees()[0], [](int d, bool r) { return with_weight(r, 6 * d - 6, 3 * d - 3); }, "evolute");
  } else {
    samples.expect(dot(off, c.binormal()).is_zero(), tell("(E-x)·(x'×x'') = 0"));
    expect_degree(samples, s, piece, map.degrees()[0], [](int d, bool r) { return with_weight(r, 9 * d - 12, 5 * d - 7); }, "evolute");
    const auto focal = focal_curve_map(piece_curve);
    if (volume(c.x1, c.x2, c.x3).is_zero()) return samples.expect(focal.pieces().empty(), tell("a plane piece has no focal curve"));
    if (focal.pieces().size() != 1) return samples.expect(false, tell("a focal curve"));
    const auto F = exactly(focal.pieces()[0]), from = F - c.x;
    samples.expect(dot(from, c.x1).is_zero(), tell("(F-x)·x' = 0"));
    samples.expect(same(dot(from, c.x2), square(c.x1)), tell("(F-x)·x'' = |x'|²"));
    samples.expect(same(dot(from, c.x3), 3 * dot(c.x1, c.x2)), tell("(F-x)·x''' = 3x'·x''"));
    samples.expect(cross(E - F, c.binormal()).is_zero(), tell("(E-F)×(x'×x'') = 0"));
    samples.expect(cross(slope(F), c.binormal()).is_zero(), tell("F' along the binormal"));
    expect_degree(samples, s, piece, focal.degrees()[0], [](int d, bool r) { return with_weight(r, 8 * d - 12, 4 * d - 7); }, "focal curve");
  }
}

template <int Dim>
Rational_curve<Dim> piece_of(const Rational_curve<Dim>& curve, std::size_t i)
{
  Chain chain;
  chain.pieces = {curve.chain().pieces[i]};
  chain.joints.clear();
  return Rational_curve<Dim>({curve.pieces()[i]}, chain);
}

template <int Dim>
void check_circle(const Sample_curve<Dim>& s, Random& random, Samples& samples)
{
  const auto& ranges = s.curve.chain().pieces;
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(random.below(static_cast<int>(ranges.size())));
    const Rational local = (random.unit_rational() * 3 + Rational(1, 7)) / 4; // not at a joint
    const Rational u = ranges[i].lo + local * (ranges[i].hi - ranges[i].lo);
    const Definition<Dim> c(s.curve.pieces()[i]);
    const auto circle = osculating_circle(s.curve, u);
    const auto x = value(c.x, local), x1 = value(c.x1, local), x2 = value(c.x2, local);
    Rational along = 0, across = 0, speed = 0, radius = 0, flat = 0;
    for (std::size_t a = 0; a < x.size(); ++a) {
      speed += x1[a] * x1[a];
      const std::size_t b = (a + 1) % x.size();
      const Rational minor = x1[a] * x2[b] - x1[b] * x2[a];
      flat += minor * minor;
    }
    samples.expect(circle.has_value() == (flat != 0), [&] { return "a circle of " + s.name; });
    if (!circle) continue;
    for (std::size_t a = 0; a < x.size(); ++a) {
      const Rational off = circle->centre[a] - x[a];
      along += off * x1[a];
      across += off * x2[a];
      radius += off * off;
    }
    bool ok = circle->point == x && along == 0 && across == speed && circle->squared_radius == radius;
    if constexpr (Dim == 2) ok = ok && circle->side == sgn(Rational(x1[0] * x2[1] - x1[1] * x2[0]));
    else {
      Rational volume = 0;
      for (std::size_t a = 0; a < 3; ++a)
        volume += (circle->centre[a] - x[a]) * (x1[(a + 1) % 3] * x2[(a + 2) % 3] - x1[(a + 2) % 3] * x2[(a + 1) % 3]);
      ok = ok && volume == 0;
    }
    samples.expect(ok, [&] { return "osculating circle of " + s.name; });
  }
}

} // namespace

TEST_CASE("centres of curvature and of osculating spheres solve their equations identically", "[derived]")
{
  Random random(520);
  Samples samples;
  for (const auto& s : plane_samples(random))
    for (std::size_t i = 0; i < s.curve.pieces().size(); ++i) check_evolute(s, piece_of(s.curve, i), samples);
  for (const auto& s : space_samples(random))
    for (std::size_t i = 0; i < s.curve.pieces().size(); ++i) check_evolute(s, piece_of(s.curve, i), samples);
  LOCUS_REQUIRE_SAMPLES(samples, 300);
}

TEST_CASE("maps of several pieces have the pieces' ranges", "[derived]")
{
  Random random(521);
  const Curve_3 spline = random_spline<3>(random, 3, 3, true);
  const auto evolutes = evolute_map(spline);
  const auto focal = focal_curve_map(spline);
  REQUIRE(evolutes.pieces().size() == 3u);
  REQUIRE(focal.pieces().size() == 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(evolutes.pieces()[i].range[0].lo == spline.chain().pieces[i].lo);
    CHECK(focal.pieces()[i].range[0].hi == spline.chain().pieces[i].hi);
    CHECK(same(exactly(evolutes.pieces()[i]), exactly(evolute_map(piece_of(spline, i)).pieces()[0])));
  }
  // A straight piece is left out.
  const Curve_2 mixed = bspline_2(2, {{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 4}}, {0, 0, 0, 1, 1, 2, 2, 2});
  const auto rest = evolute_map(mixed);
  REQUIRE(rest.pieces().size() == 1u);
  CHECK(rest.pieces()[0].range[0].lo == 1);
}

TEST_CASE("osculating circles touch to the second order", "[derived]")
{
  Random random(522);
  Samples samples;
  for (const auto& s : plane_samples(random)) check_circle(s, random, samples);
  for (const auto& s : space_samples(random)) check_circle(s, random, samples);
  LOCUS_REQUIRE_SAMPLES(samples, 80);
  CHECK_THROWS_AS(osculating_circle(bezier_2({{0, 0}, {1, 1}, {2, 0}}), Rational(2)), Invalid_input);
}

// ---------------------------------------------------------------------------------------------------------- developables

namespace {

/// A ruled surface as directrix (at λ = 0) and generator (by λ).
struct Ruling {
  Quotient<3> surface, directrix, generator;

  explicit Ruling(const Rational_map_piece<3, 2>& piece) : surface(exactly(piece))
  {
    const Rational lo = piece.range[1].lo, length = piece.range[1].hi - lo;
    directrix = substituted(surface, 1, Rational(-lo / length), Rational(0));
    generator = substituted(slope(surface, 1), 1, Rational(0), Rational(0));
  }
  Scalar twist() const { return volume(slope(directrix), generator, slope(generator)); }
  Quotient<3> normal() const { return cross(slope(surface, 0), slope(surface, 1)); }
};

void check_ruled(Ruled_kind kind, const Sample_curve<3>& s, const Curve_3& piece_curve, Samples& samples)
{
  const auto& piece = piece_curve.pieces()[0];
  const Definition<3> c(piece);
  const auto tell = [&](const char* what) { return [what, &s, kind] { return std::string(name_of(kind)) + ", " + what + ": " + s.name; }; };
  const auto map = ruled_surface(kind, piece_curve, {-1, 2});
  const bool straight = c.binormal().is_zero();
  if (straight && kind != Ruled_kind::tangent_developable) return samples.expect(map.pieces().empty(), tell("none of a straight piece"));
  if (map.pieces().size() != 1) return samples.expect(false, tell("a piece"));
  const Ruling r(map.pieces()[0]);
  samples.expect(map.degrees()[1] <= 1 && !r.generator.is_zero(), tell("ruled"));
  if (kind == Ruled_kind::polar_developable) {
    const auto off = r.directrix - c.x;
    samples.expect(dot(off, c.x1).is_zero() && same(dot(off, c.x2), square(c.x1)) && dot(off, c.binormal()).is_zero(), tell("contains the evolute"));
  } else {
    samples.expect(same(r.directrix, c.x), tell("contains the curve"));
  }
  Quotient<3> along = c.x1;
  using Bound = int (*)(int, bool);
  Bound bound = [](int d, bool rational) { return with_weight(rational, std::max(d, 2 * d - 2), d); };
  if (kind == Ruled_kind::normal_scroll) {
    along = c.normal();
    bound = [](int d, bool rational) { return std::max(d, with_weight(rational, 5 * d - 8, 3 * d - 5)); };
  } else if (kind == Ruled_kind::binormal_scroll) {
    along = c.binormal();
    bound = [](int d, bool rational) { return std::max(d, with_weight(rational, 3 * d - 6, 2 * d - 4)); };
  } else if (kind == Ruled_kind::polar_developable) {
    along = c.binormal();
    bound = [](int d, bool rational) { return with_weight(rational, 9 * d - 12, 5 * d - 7); };
  } else if (kind == Ruled_kind::rectifying_developable) {
    // τT + κB, times |x'|³|x'×x''|²
    along = (volume(c.x1, c.x2, c.x3) * square(c.x1)) * c.x1 + square(c.binormal()) * c.binormal();
    bound = [](int d, bool rational) { return std::max(d, with_weight(rational, 10 * d - 18, 6 * d - 12)); };
  }
  samples.expect(cross(r.generator, along).is_zero(), tell("direction of the rulings"));
  expect_degree(samples, s, piece, map.degrees()[0], bound, name_of(kind));
  if (kind == Ruled_kind::normal_scroll || kind == Ruled_kind::binormal_scroll) return;
  samples.expect(r.twist().is_zero(), tell("developable"));
  if (straight) return;
  const Quotient<3> normal = r.normal();
  if (kind == Ruled_kind::tangent_developable) samples.expect(cross(normal, c.binormal()).is_zero(), tell("osculating planes"));
  if (kind == Ruled_kind::polar_developable) samples.expect(cross(normal, c.x1).is_zero(), tell("normal planes"));
  if (kind == Ruled_kind::rectifying_developable) samples.expect(cross(normal, c.normal()).is_zero(), tell("rectifying planes"));
}

/// Does a chart's direction of rulings have no zero in that coordinate on its part, common factors apart?
bool covers_its_part(const Quotient<3>& line, std::size_t coordinate, const Rational& lo, const Rational& hi)
{
  locus_test::Polynomial common;
  for (const Form& f : line.n) common = locus_test::euclid(common, in_u(f));
  const locus_test::Polynomial own = in_u(line.n[coordinate]);
  if (own.empty()) return false;
  const auto rest = locus_test::quotient(own, common);
  return rest.size() == 1 || locus_test::Sturm(rest).closed(lo, hi) == 0;
}

/// Charts that follow each other over a piece's range: `line` is the direction of their rulings.
template <class Check>
void check_charts(const std::vector<Ruled_chart>& charts, const Piece& range, const Quotient<3>& line, const Coordinate_ranges& coordinates,
                  Samples& samples, const std::string& name, Check check)
{
  const auto tell = [&name](const char* what) { return [what, &name] { return std::string(what) + ": " + name; }; };
  if (charts.empty()) return samples.expect(line.is_zero(), tell("charts"));
  Rational from = range.lo;
  for (const Ruled_chart& chart : charts) {
    const Piece& over = chart.map.range[0];
    samples.expect(over.lo == from && over.lo < over.hi, tell("charts follow each other"));
    from = over.hi;
    const Rational lo = locus_test::local_value(range, over.lo), hi = locus_test::local_value(range, over.hi);
    samples.expect(covers_its_part(line, chart.coordinate, lo, hi), tell("no other ruling at infinity"));
    const Quotient<3> B = exactly(chart.map);
    const Ruling_range& wanted = coordinates[chart.coordinate];
    Form v(1, 2);
    v.at(0, 1) = 1;
    samples.expect(chart.map.range[1].lo == wanted.lo && chart.map.range[1].hi == wanted.hi, tell("range of the coordinate"));
    samples.expect(same(B[chart.coordinate], number(wanted.lo) + number(Rational(wanted.hi - wanted.lo)) * Scalar{{v}, Form(Integer(1))}), tell("the coordinate is the second parameter"));
    check(B, lo, Rational(hi - lo));
  }
  samples.expect(from == range.hi, tell("charts end with the piece"));
}

const Coordinate_ranges some_ranges{Ruling_range{-3, 5}, Ruling_range{Rational(1, 3), 2}, Ruling_range{-1, 4}};

template <class Visit>
void for_pieces(const Sample_curve<3>& s, Visit visit)
{
  for (std::size_t i = 0; i < s.curve.pieces().size(); ++i) visit(piece_of(s.curve, i));
}

} // namespace

TEST_CASE("ruled surfaces along a curve have their rulings and normals, developables are", "[derived]")
{
  Random random(530);
  Samples samples;
  for (const auto& s : space_samples(random))
    for_pieces(s, [&](const Curve_3& piece) {
      for (const auto kind : {Ruled_kind::tangent_developable, Ruled_kind::normal_scroll, Ruled_kind::binormal_scroll, Ruled_kind::rectifying_developable, Ruled_kind::polar_developable})
        check_ruled(kind, s, piece, samples);
    });
  LOCUS_REQUIRE_SAMPLES(samples, 400);
  // The others are not.
  const Curve_3 cubic = bezier_3({{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 0, 3}});
  for (const auto kind : {Ruled_kind::normal_scroll, Ruled_kind::binormal_scroll})
    CHECK_FALSE(Ruling(ruled_surface(kind, cubic).pieces()[0]).twist().is_zero());
}

TEST_CASE("the tangent developable by polar forms is the same surface", "[derived]")
{
  Random random(531);
  Samples samples;
  for (const auto& s : space_samples(random))
    for_pieces(s, [&](const Curve_3& piece) {
      const Definition<3> c(piece.pieces()[0]);
      const auto map = tangent_developable_by_polar_form(piece);
      const Quotient<3> P = exactly(map.pieces()[0]);
      samples.expect(cross(P - c.x, c.x1).is_zero(), [&] { return "on the tangent: " + s.name; });
      samples.expect(same(on_diagonal(P), c.x), [&] { return "the curve for v = u: " + s.name; });
      samples.expect(!slope(P, 1).is_zero() && map.pieces()[0].range[1].hi == piece.chain().pieces[0].hi, [&] { return "along the tangent: " + s.name; });
      expect_degree(samples, s, piece.pieces()[0], map.degrees()[0], [](int d, bool) { return d - 1; }, "polar form");
      samples.expect(map.degrees()[1] == 1, "degree 1 along the rulings");
    });
  LOCUS_REQUIRE_SAMPLES(samples, 80);
}

TEST_CASE("polar developables in charts are where normal planes meet", "[derived]")
{
  Random random(532);
  Samples samples;
  for (const auto& s : space_samples(random))
    for_pieces(s, [&](const Curve_3& piece) {
      const Definition<3> c(piece.pieces()[0]);
      const auto charts = polar_developable_charts(piece, some_ranges);
      check_charts(charts, piece.chain().pieces[0], c.binormal(), some_ranges, samples, s.name, [&](const Quotient<3>& B, const Rational& lo, const Rational& length) {
        const auto on_part = [&](const auto& f) { return substituted(f, 0, lo, length); };
        const Quotient<3> off = B - on_part(c.x);
        samples.expect(dot(off, on_part(c.x1)).is_zero(), [&] { return "(B-x)·x' = 0: " + s.name; });
        samples.expect(same(dot(off, on_part(c.x2)), on_part(square(c.x1))), [&] { return "(B-x)·x'' = |x'|²: " + s.name; });
      });
      for (const auto& chart : charts)
        expect_degree(samples, s, piece.pieces()[0], chart.map.degrees()[0], [](int d, bool r) { return with_weight(r, 6 * d - 6, 3 * d - 3); }, "polar chart");
    });
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

// ------------------------------------------------------------------------------------------------------------- bisectors

namespace {

void check_pair(const Curve_piece<3>& first, const Curve_piece<3>& second, const std::string& name, Samples& samples)
{
  const auto tell = [&name](const char* what) { return [what, &name] { return std::string(what) + ": " + name; }; };
  const auto map = curve_curve_bisector_piece(first, {}, second, {});
  if (!map) return samples.expect(false, tell("a bisector"));
  const Quotient<3> B = exactly(*map);
  const Quotient<3> x = quotient_of(first.numerator, first.weight, 0), y = quotient_of(second.numerator, second.weight, 1);
  const Quotient<3> from_x = B - x, from_y = B - y;
  samples.expect(dot(from_x, slope(x, 0)).is_zero(), tell("(B-x)·x' = 0"));
  samples.expect(dot(from_y, slope(y, 1)).is_zero(), tell("(B-y)·y' = 0"));
  samples.expect(same(square(from_x), square(from_y)), tell("|B-x| = |B-y|"));
}

} // namespace

TEST_CASE("curve/curve bisectors are equidistant and perpendicular as bivariate polynomials", "[derived]")
{
  Random random(540);
  Samples samples;
  for (int d = 1; d <= 3; ++d)
    for (int e = 1; e <= d; ++e)
      for (int k = 0; k < 4; ++k) {
        const bool r = k % 2 == 1 && d > 1, q = k / 2 == 1 && e > 1;
        const Curve_3 a = random_bezier<3>(random, d, r), b = random_bezier<3>(random, e, q);
        check_pair(a.pieces()[0], b.pieces()[0], "degrees " + std::to_string(d) + " and " + std::to_string(e), samples);
        const auto degrees = curve_curve_bisector_map(a, b).degrees();
        samples.expect(degrees[0] == with_weight(r, 4 * d - 2, 3 * d - 1) && degrees[1] == with_weight(q, 4 * e - 2, 3 * e - 1),
                       [&] { return "degrees " + std::to_string(degrees[0]) + ", " + std::to_string(degrees[1]) + " for " + std::to_string(d) + ", " + std::to_string(e); });
      }
  // Several spans: a grid, the second curve's pieces fastest.
  const Curve_3 s = random_spline<3>(random, 2, 2, true), t = random_spline<3>(random, 2, 3, false);
  const auto map = curve_curve_bisector_map(s, t);
  REQUIRE(map.pieces().size() == 6u);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const auto& p = map.pieces()[3 * i + j];
      CHECK(p.range[0].lo == s.chain().pieces[i].lo);
      CHECK(p.range[1].lo == t.chain().pieces[j].lo);
      const auto own = curve_curve_bisector_piece(s.pieces()[i], {}, t.pieces()[j], {});
      CHECK(same(exactly(*own), exactly(p)));
      check_pair(s.pieces()[i], t.pieces()[j], "spline", samples);
    }
  const Curve_3 twisted = bezier_3({{0, 0, 0}, {1, 3, 1}, {4, -1, 2}, {2, 2, -3}}, {1, "-1/8", 1, 2}), line = segment_3({0, 1, 2}, {3, -2, 1});
  check_pair(twisted.pieces()[0], line.pieces()[0], "weights of both signs", samples);
  LOCUS_REQUIRE_SAMPLES(samples, 90);
}

TEST_CASE("skew lines have a hyperbolic paraboloid", "[derived]")
{
  Random random(541);
  Samples samples;
  for (int k = 0; k < 10; ++k) {
    std::array<Exact_point<3>, 4> p;
    for (auto& q : p) q = random_point<3>(random, 9);
    if (p[0] == p[1] || p[2] == p[3]) continue;
    const Curve_3 a = bezier_curve<3>({p[0], p[1]}), b = bezier_curve<3>({p[2], p[3]});
    const auto map = curve_curve_bisector_map(a, b);
    if (map.pieces().empty()) continue; // not skew
    samples.expect(map.degrees()[0] <= 2 && map.degrees()[1] <= 2, "bidegree (2,2)");
    // |(P-a)×d|²·|e|² = |(P-b)×e|²·|d|²
    const Quotient<3> P = exactly(map.pieces()[0]), d = constant(p[1]) - constant(p[0]), e = constant(p[3]) - constant(p[2]);
    const Scalar from_a = square(cross(P - constant(p[0]), d)), from_b = square(cross(P - constant(p[2]), e));
    samples.expect(same(square(e) * from_a, square(d) * from_b), "on the quadric");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 16);
}

TEST_CASE("curves in one plane have no rational bisector, nearly such have", "[derived]")
{
  const Curve_3 a = bezier_3({{0, 0, 1}, {1, 2, -2}, {3, 1, -3}}), b = bezier_3({{5, 0, -4}, {4, 2, -5}, {7, 1, -7}, {8, 3, -10}}, {1, 2, 1, 3}); // x + y + z = 1
  CHECK_FALSE(curve_curve_bisector_piece(a.pieces()[0], {}, b.pieces()[0], {}).has_value());
  Curve_piece<3> moved = b.pieces()[0];
  moved.numerator[2][0] += locus_test::two_to(-40);
  const auto map = curve_curve_bisector_piece(a.pieces()[0], {}, moved, {});
  REQUIRE(map.has_value());
  Samples samples;
  check_pair(a.pieces()[0], moved, "nearly in one plane", samples);
  LOCUS_REQUIRE_SAMPLES(samples, 3);
  CHECK(curve_curve_bisector_map(a, b).pieces().empty());
}

TEST_CASE("point/curve bisectors are equidistant and perpendicular, by charts and by directrix", "[derived]")
{
  Random random(542);
  Samples samples;
  for (const auto& s : space_samples(random)) {
    const Exact_point<3> at = random_point<3>(random, 30);
    const Quotient<3> Q = constant(at);
    for_pieces(s, [&](const Curve_3& piece_curve) {
      const Curve_piece<3>& piece = piece_curve.pieces()[0];
      const Definition<3> c(piece);
      const auto tell = [&](const char* what) { return [what, &s] { return std::string(what) + ": " + s.name; }; };
      const Quotient<3> line = cross(c.x1, c.x - Q);
      const auto charts = point_curve_bisector_charts(at, piece_curve, some_ranges);
      check_charts(charts, piece_curve.chain().pieces[0], line, some_ranges, samples, s.name, [&](const Quotient<3>& B, const Rational& lo, const Rational& length) {
        const auto on_part = [&](const auto& f) { return substituted(f, 0, lo, length); };
        const Quotient<3> off = B - on_part(c.x);
        samples.expect(dot(off, on_part(c.x1)).is_zero(), tell("(B-x)·x' = 0"));
        samples.expect(same(square(off), square(B - Q)), tell("|B-Q| = |B-x|"));
      });
      const auto bound = [](int d, bool r) { return with_weight(r, 4 * d - 2, 3 * d - 1); };
      for (const auto& chart : charts) expect_degree(samples, s, piece, chart.map.degrees()[0], bound, "chart");
      const auto explicitly = point_curve_bisector_by_directrix(at, piece_curve, {-1, 2});
      samples.expect(explicitly.pieces().empty() == line.is_zero(), tell("directrix"));
      if (explicitly.pieces().empty()) return;
      const Ruling r(explicitly.pieces()[0]);
      const Quotient<3> off = r.surface - c.x;
      samples.expect(dot(off, c.x1).is_zero() && same(square(off), square(r.surface - Q)), tell("by directrix"));
      samples.expect(!r.generator.is_zero() && cross(r.generator, line).is_zero(), tell("rulings by directrix"));
      samples.expect(dot(r.directrix - Q, r.generator).is_zero(), tell("the directrix is next to the point"));
      expect_degree(samples, s, piece, explicitly.degrees()[0], [](int d, bool rational) { return with_weight(rational, 6 * d - 4, 5 * d - 3); }, "directrix");
      // The same lines: chart and directrix satisfy the same two linear equations, and these leave one line (its direction is
      // not zero).
      if (charts.empty()) return;
      const Rational lo = locus_test::local_value(piece_curve.chain().pieces[0], charts[0].map.range[0].lo);
      const Rational hi = locus_test::local_value(piece_curve.chain().pieces[0], charts[0].map.range[0].hi);
      const Quotient<3> g = substituted(r.generator, 0, lo, Rational(hi - lo)), start = substituted(r.directrix, 0, lo, Rational(hi - lo));
      samples.expect(cross(exactly(charts[0].map) - start, g).is_zero(), tell("the same lines"));
    });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 200);
  // A line through the point.
  CHECK(point_curve_bisector_charts({0, 0, 0}, segment_3({1, 1, 1}, {2, 2, 2}), some_ranges).empty());
}

TEST_CASE("the plane bisector is a height line of the ruled one", "[derived]")
{
  Random random(543);
  Samples samples;
  for (int d = 2; d <= 3; ++d)
    // A coordinate that vanishes has a lower degree than the weight, which must not be seen.
    for (const bool rational : {false, true})
      for (int k = 0; k < 2; ++k) {
        const Curve_2 flat = random_bezier<2>(random, d, rational);
        Curve_piece<3> piece;
        for (std::size_t i = 0; i < 2; ++i) piece.numerator[i] = flat.pieces()[0].numerator[i];
        piece.numerator[2] = Bernstein<Rational, 1>(piece.numerator[0].degrees());
        piece.weight = flat.pieces()[0].weight;
        const Curve_3 curve({piece}, Chain());
        const Exact_point<3> at{random.between(-30, 30), random.between(-30, 30), 0};
        const auto charts = point_curve_bisector_charts(at, curve, some_ranges);
        const auto explicitly = point_curve_bisector_by_directrix(at, curve, {-2, 3});
        samples.expect(charts.size() == 1 && charts[0].coordinate == 2 && explicitly.pieces().size() == 1, "one chart over the height");
        if (charts.size() != 1 || explicitly.pieces().empty()) continue;
        const Quotient<3> x = quotient_of(piece.numerator, piece.weight);
        for (const auto* map : {&charts[0].map, &explicitly.pieces()[0]}) {
          const Ruling r(*map); // λ is the height
          const Quotient<3> B = r.directrix, off = B - x;
          samples.expect(B.n[2].is_zero(), "in the plane");
          samples.expect(dot(off, slope(x)).is_zero() && same(square(off), square(B - constant(at))), "the plane bisector");
          samples.expect(r.generator.n[0].is_zero() && r.generator.n[1].is_zero(), "a cylinder");
        }
      }
  LOCUS_REQUIRE_SAMPLES(samples, 56);
}

TEST_CASE("point/surface and point/point bisectors are equidistant", "[derived]")
{
  Random random(544);
  Samples samples;
  for (int k = 0; k < 8; ++k) {
    const Degrees<2> degrees{1 + k % 2, 1 + k / 2 % 2};
    const bool rational = k >= 4;
    std::vector<Exact_point<3>> points;
    std::vector<Rational> weights;
    for (int i = 0; i < (degrees[0] + 1) * (degrees[1] + 1); ++i) {
      points.push_back(random_point<3>(random, 20));
      if (rational) weights.emplace_back(random.between(1, 9));
    }
    const Rational_surface surface = bezier_surface(degrees, points, weights);
    const Exact_point<3> at = random_point<3>(random, 30);
    const auto map = point_surface_bisector_map(at, surface);
    if (map.pieces().size() != 1) {
      samples.expect(false, "a bisector");
      continue;
    }
    const Quotient<3> B = exactly(map.pieces()[0]), x = quotient_of(surface.pieces()[0].numerator, surface.pieces()[0].weight), off = B - x;
    samples.expect(dot(off, slope(x, 0)).is_zero() && dot(off, slope(x, 1)).is_zero(), "on the normal");
    samples.expect(same(square(off), square(B - constant(at))), "|B-Q| = |B-x|");
    samples.expect(map.degrees()[0] <= 5 * degrees[0] - 2 && map.degrees()[1] <= 5 * degrees[1] - 2, "degrees");
    if (rational) samples.expect(map.degrees()[0] == 5 * degrees[0] - 2 && map.degrees()[1] == 5 * degrees[1] - 2, "generic degrees");
  }
  // Pieces lie over the grid's ranges, the second parameter fastest.
  {
    std::vector<Coordinates_3> points;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) points.push_back({i, j, random.between(-4, 4)});
    const Rational_surface surface = bspline_surface_3({1, 1}, points, {std::vector<Number>{0, 0, 1, 3, 3}, std::vector<Number>{0, 0, 2, 5, 6, 6}});
    const auto map = point_surface_bisector_map({1, 2, 10}, surface);
    REQUIRE(map.pieces().size() == 6u);
    for (std::size_t n = 0; n < 6; ++n) {
      CHECK(map.pieces()[n].range[0].lo == surface.chains()[0].pieces[n / 3].lo);
      CHECK(map.pieces()[n].range[1].hi == surface.chains()[1].pieces[n % 3].hi);
      const Quotient<3> B = exactly(map.pieces()[n]), x = quotient_of(surface.pieces()[n].numerator, surface.pieces()[n].weight);
      samples.expect(same(square(B - x), square(B - constant(Exact_point<3>{1, 2, 10}))), "a piece of the grid");
    }
  }
  // A cone around the point has none.
  CHECK(point_surface_bisector_map({0, 0, 0}, bezier_surface_3({1, 1}, {{1, 0, 1}, {0, 1, 1}, {2, 0, 2}, {0, 2, 2}})).pieces().empty());
  for (int k = 0; k < 12; ++k) {
    const Exact_point<3> a = random_point<3>(random, 2);
    Exact_point<3> b = random_point<3>(random, 2);
    if (a == b) b[0] += 1;
    const Quotient<3> B = exactly(point_point_bisector_map(a, b, Rational(7, 2)).pieces()[0]);
    samples.expect(same(square(B - constant(a)), square(B - constant(b))), "|B-a| = |B-b|");
    const Quotient<3> u = slope(B, 0), v = slope(B, 1);
    // On [-reach, reach] by unit parameters: at least 7 long.
    samples.expect(dot(u, v).is_zero() && value(square(u), 0)[0] >= 49 && value(square(v), 0)[0] >= 49, "orthogonal, as far as the reach");
  }
  LOCUS_REQUIRE_SAMPLES(samples, 50);
}
