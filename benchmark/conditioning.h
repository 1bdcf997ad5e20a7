// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_BENCHMARK_CONDITIONING_H
#define LOCUS_BENCHMARK_CONDITIONING_H

// Chen, Riesenfeld & Cohen (§6) suspect that a root's condition suffers from a discarded denominator where both the
// numerator and it are small. Measured here on curves that approach such a case: how sensitive a vertex's parameter is to
// the coefficients of four forms of dκ/ds = 0, and how well plain doubles find it.

#include <locus/constraint/brute_force.h>
#include <locus/constraint/curvature_forms.h>
#include <locus/function/descartes.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace locus_benchmark {

/// What one form makes of a root.
struct Root_measures {
  int degree = 0;
  double condition = 0; ///< Σ|c_k|·B_k(u)/|f'(u)|: how far the root moves per relative error of coefficients (Farouki & Rajan)
  double error = 0;     ///< of the parameter, found by bisection with de Casteljau's algorithm in doubles
  double residual = 0;  ///< how far from the root |f| ≤ 2^-40·max|f| is met, to first order
};

struct Conditioning_row {
  int exponent = 0; ///< ε = 2^-exponent
  double root = 0;
  /// brute: the numerator of (κ²)'. kept: dκ/ds = critical·w⁴/S³ with its denominator. paper: g0 or g2, (3.4), (3.5).
  /// here: critical.
  Root_measures brute, kept, paper, here;
};

namespace detail {

using locus::Bernstein;
using locus::Curve_piece;
using locus::Degrees;
using locus::Rational;
using Form = Bernstein<Rational, 1>;

inline Rational two_to_minus(int e) { return Rational(locus::Integer(1), locus::Integer(locus::Integer(1) << static_cast<unsigned>(e))); }

/// A function whose root is looked for: a form, over another one or not.
struct Function {
  Form numerator, denominator;

  Rational at(const Rational& u) const { return Rational(evaluate_at(numerator, u) / evaluate_at(denominator, u)); }
  /// At a root of the numerator.
  Rational slope(const Rational& root) const { return Rational(evaluate_at(derivative(numerator), root) / evaluate_at(denominator, root)); }
};

inline Function alone(Form f) { return {std::move(f), Form(Degrees<1>{0}, {Rational(1)})}; }

inline double condition(const Form& f, const Rational& root)
{
  Form sizes = f;
  for (std::size_t i = 0; i < f.size(); ++i) sizes[i] = abs(f[i]);
  return Rational(evaluate_at(sizes, root) / abs(evaluate_at(derivative(f), root))).get_d();
}

/// Coefficients in doubles, the greatest of size one.
inline std::vector<double> in_doubles(const Form& f)
{
  Rational greatest = 0;
  for (const Rational& c : f.coefficients())
    if (abs(c) > greatest) greatest = abs(c);
  std::vector<double> values;
  for (const Rational& c : f.coefficients()) values.push_back(Rational(c / greatest).get_d());
  return values;
}

inline double casteljau(std::vector<double> c, double u)
{
  for (std::size_t n = c.size() - 1; n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) c[i] = (1 - u) * c[i] + u * c[i + 1];
  return c[0];
}

/// Where a root lies, and between which parameters it is alone among all that the forms have.
struct Place {
  Rational root, lo, hi;
};

inline double bisected(const Function& f, const Place& place)
{
  const std::vector<double> top = in_doubles(f.numerator), bottom = in_doubles(f.denominator);
  const bool rises = sgn(f.slope(place.root)) > 0;
  double lo = place.lo.get_d(), hi = place.hi.get_d();
  for (;;) {
    const double mid = 0.5 * (lo + hi);
    if (!(lo < mid && mid < hi)) return mid;
    const double value = casteljau(top, mid) / casteljau(bottom, mid);
    if (value == 0) return mid;
    ((value < 0) == rises ? lo : hi) = mid;
  }
}

/// The greatest of many values, taken closer and closer to the root, where a cusp has the derivative's peaks.
inline Rational greatest_value(const Function& f, const Rational& root)
{
  Rational greatest = 0;
  const auto look = [&](const Rational& u) {
    if (u < 0 || u > 1) return;
    const Rational value = abs(f.at(u));
    if (value > greatest) greatest = value;
  };
  for (int i = 0; i <= 64; ++i) look(Rational(i, 64));
  const Rational near = Rational(locus::Integer(root * 1048576), 1048576);
  for (int j = 1; j <= 80; ++j)
    for (const int side : {-1, 1}) look(Rational(near + side * (j % 2 ? 1 : Rational(3, 4)) * two_to_minus(j / 2)));
  return greatest;
}

inline Root_measures measured(const Function& f, const Place& place, bool with_residual)
{
  Root_measures m;
  m.degree = std::max(f.numerator.degree(), f.denominator.degree());
  m.condition = condition(f.numerator, place.root);
  const Rational error = Rational(bisected(f, place)) - place.root;
  m.error = std::abs(error.get_d());
  if (with_residual) m.residual = Rational(greatest_value(f, place.root) * two_to_minus(40) / abs(f.slope(place.root))).get_d();
  return m;
}

/// The vertex of a piece next to `near`, to 2^-80.
inline Place vertex(const locus::Curvature_forms<2>& forms, const Rational& near)
{
  const locus::Bernstein<locus::Scaled_integer, 1> all(multiply(forms.critical, forms.bend[0])), critical(forms.critical);
  auto roots = exact_roots(all, Rational(0), Rational(1)).roots;
  auto mine = exact_roots(critical, Rational(0), Rational(1)).roots;
  const auto refine = [](auto& root) {
    while (!root.is_exact() && root.hi - root.lo > two_to_minus(80)) locus::detail::bisect_exactly(*root.factor, Rational(0), Rational(1), root);
  };
  Place place{-1, 0, 1};
  for (auto& root : mine) {
    refine(root);
    const Rational middle = (root.lo + root.hi) / 2;
    if (abs(middle - near) < abs(place.root - near)) place.root = middle;
  }
  for (auto& root : roots) {
    refine(root);
    const Rational middle = (root.lo + root.hi) / 2, between = (middle + place.root) / 2;
    if (abs(middle - place.root) < two_to_minus(70)) continue;
    if (middle < place.root && between > place.lo) place.lo = between;
    if (middle > place.root && between < place.hi) place.hi = between;
  }
  return place;
}

inline Conditioning_row row(const Curve_piece<2>& piece, const Rational& near, int exponent)
{
  const locus::Curvature_forms<2> forms(piece);
  const Place place = vertex(forms, near);
  const Form w2 = multiply(forms.weight, forms.weight), s3 = multiply(forms.speed, multiply(forms.speed, forms.speed));
  Conditioning_row r;
  r.exponent = exponent;
  r.root = place.root.get_d();
  r.brute = measured(alone(derivative(locus::brute_force::squared_curvature(piece)).numerator()[0]), place, false);
  r.kept = measured({multiply(forms.critical, multiply(w2, w2)), s3}, place, true);
  r.paper = measured(alone(locus::paper_form::critical(piece)), place, true);
  r.here = measured(alone(forms.critical), place, true);
  return r;
}

/// The polynomial Σ a_k·(t - at)^k, of degree a.size() - 1.
inline Form about(const Rational& at, const std::vector<Rational>& a)
{
  const Form step = locus::from_monomial(std::vector<Rational>{Rational(-at), Rational(1)});
  Form sum(Degrees<1>{0}, {a.back()});
  for (std::size_t k = a.size() - 1; k-- > 0;) sum = add(multiply(sum, step), Form(Degrees<1>{0}, {a[k]}));
  return sum;
}

} // namespace detail

/// A polynomial cubic whose velocity at t = 1/3 is (0, ε), next to a vertex: x' = s + s², y' = ε + 2s² for s = t - 1/3.
inline Conditioning_row conditioning_near_cusp(int exponent)
{
  using namespace detail;
  const Rational third(1, 3), e = two_to_minus(exponent);
  return row({{about(third, {0, 0, Rational(1, 2), third}), about(third, {0, e, 0, Rational(2, 3)})}, Form(Degrees<1>{0}, {Rational(1)})}, third, exponent);
}

/// A rational quadratic, an ever longer ellipse, whose weight has its minimum ε at t = 1/3, next to the far vertex.
inline Conditioning_row conditioning_near_pole(int exponent)
{
  using namespace detail;
  const Rational third(1, 3), e = two_to_minus(exponent);
  return row({{about(third, {1, Rational(1, 4), third}), about(third, {0, 1, Rational(1, 2)})}, about(third, {e, 0, 1})}, third, exponent);
}

/// The rational quadratic with control points (0,0), (1,2), (3,0) and weights ε, 1, 1: no sign changes in the weight.
inline Conditioning_row conditioning_at_small_weight(int exponent)
{
  using namespace detail;
  const Rational e = two_to_minus(exponent);
  const Degrees<1> two{2};
  return row({{Form(two, {Rational(0), Rational(1), Rational(3)}), Form(two, {Rational(0), Rational(2), Rational(0)})}, Form(two, {e, Rational(1), Rational(1)})}, 0,
             exponent);
}

namespace detail {

inline std::vector<Conditioning_row> rows_of(Conditioning_row (*make)(int))
{
  std::vector<Conditioning_row> rows;
  for (int exponent = 2; exponent <= 20; exponent += 2) rows.push_back(make(exponent));
  return rows;
}

} // namespace detail

inline std::vector<Conditioning_row> conditioning_of_near_cusps() { return detail::rows_of(conditioning_near_cusp); }
inline std::vector<Conditioning_row> conditioning_of_near_poles() { return detail::rows_of(conditioning_near_pole); }
inline std::vector<Conditioning_row> conditioning_of_small_weights() { return detail::rows_of(conditioning_at_small_weight); }

/// On standard error: standard output may have to stay what a reader of benchmark results expects.
inline void print_conditioning(const char* title, const std::vector<Conditioning_row>& rows)
{
  if (rows.empty()) return;
  const auto& first = rows[0];
  std::fprintf(stderr, "%s: degrees %d (brute force), %d (denominator kept), %d (paper), %d (here)\n", title, first.brute.degree, first.kept.degree,
              first.paper.degree, first.here.degree);
  std::fprintf(stderr, "         root   |  condition: brute      kept     paper      here  |  error in doubles: brute      kept     paper      here"
              "  |  met by residual: kept     paper      here\n");
  for (const auto& r : rows)
    std::fprintf(stderr, "  2^-%-2d  %.6f | %18.1e %9.1e %9.1e %9.1e | %25.1e %9.1e %9.1e %9.1e | %22.1e %9.1e %9.1e\n", r.exponent, r.root, r.brute.condition,
                r.kept.condition, r.paper.condition, r.here.condition, r.brute.error, r.kept.error, r.paper.error, r.here.error, r.kept.residual,
                r.paper.residual, r.here.residual);
}

} // namespace locus_benchmark

#endif
