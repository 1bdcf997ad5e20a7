// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_SELF_INTERSECTION_FORMS_H
#define LOCUS_CONSTRAINT_SELF_INTERSECTION_FORMS_H

#include <locus/constraint/point_curve.h>
#include <locus/function/bivariate_polynomial.h>

namespace locus {

/// N polynomials that share one scale, in powers of a piece's local parameter.
template <std::size_t N>
using Integer_vector = std::array<Integer_polynomial, N>;

namespace detail {

/// af + bg.
inline Integer_polynomial combined(long a, const Integer_polynomial& f, long b, const Integer_polynomial& g)
{
  Integer_polynomial h(std::max(f.size(), g.size()));
  for (std::size_t i = 0; i < f.size(); ++i) h[i] += a * f[i];
  for (std::size_t i = 0; i < g.size(); ++i) h[i] += b * g[i];
  trim(h);
  return h;
}

/// fg - hk.
inline Integer_polynomial minor(const Integer_polynomial& f, const Integer_polynomial& g, const Integer_polynomial& h,
                                const Integer_polynomial& k)
{
  return combined(1, multiply(f, g), -1, multiply(h, k));
}

inline Integer_polynomial dot(const Integer_vector<2>& a, const Integer_vector<2>& b)
{
  return combined(1, multiply(a[0], b[0]), 1, multiply(a[1], b[1]));
}

inline Integer_vector<3> cross(const Integer_vector<3>& a, const Integer_vector<3>& b)
{
  return vector_of<3>([&](std::size_t k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    return minor(a[i], b[j], a[j], b[i]);
  });
}

template <std::size_t N>
Integer_vector<N> derivative(const Integer_vector<N>& a)
{
  return vector_of<N>([&](std::size_t k) { return locus::derivative(a[k]); });
}

/// The factor, a polynomial, that all components share; primitive.
template <std::size_t N>
Integer_polynomial common_factor(const Integer_vector<N>& a)
{
  Integer_polynomial common;
  for (const auto& f : a) common = gcd(std::move(common), f);
  return common;
}

/// Without the factor, a polynomial or a number, that all components share.
template <std::size_t N>
Integer_vector<N> primitive(Integer_vector<N> a)
{
  const Integer_polynomial common = common_factor(a);
  if (degree(common) > 0)
    for (auto& f : a)
      if (!f.empty()) f = quotient(f, common).value();
  Integer number = 0;
  for (const auto& f : a) number = gcd(number, content(f));
  for (auto& f : a)
    for (Integer& c : f) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), number.get_mpz_t());
  return a;
}

/// Coefficients of 1, u, u², … of forms on the unit interval, with one common factor that clears all fractions.
template <std::size_t N>
Integer_vector<N> cleared(const Polynomial_vector<1, N>& f)
{
  const auto powers = vector_of<N>([&](std::size_t k) { return to_monomial(f[k]); });
  Integer denominator = 1;
  for (const auto& a : powers)
    for (const Rational& c : a) denominator = lcm(denominator, c.get_den());
  return vector_of<N>([&](std::size_t k) {
    Integer_polynomial g;
    for (const Rational& c : powers[k]) g.push_back(Integer(c.get_num() * Integer(denominator / c.get_den())));
    trim(g);
    return g;
  });
}

/// Σ_k a_k(u)·b_k(v).
template <std::size_t N>
Bivariate_polynomial paired(const Integer_vector<N>& a, const Integer_vector<N>& b)
{
  Bivariate_polynomial f;
  for (std::size_t k = 0; k < N; ++k) {
    if (f.row.size() < b[k].size()) f.row.resize(b[k].size());
    for (std::size_t j = 0; j < b[k].size(); ++j) {
      if (f.row[j].size() < a[k].size()) f.row[j].resize(a[k].size());
      for (std::size_t i = 0; i < a[k].size(); ++i) mpz_addmul(f.row[j][i].get_mpz_t(), a[k][i].get_mpz_t(), b[k][j].get_mpz_t());
    }
  }
  f.trim();
  return f;
}

/// f/(v - u), which must be a polynomial: f_j = g_(j-1) - u·g_j for the coefficients of v^j.
inline Bivariate_polynomial divided_by_difference(const Bivariate_polynomial& f)
{
  Bivariate_polynomial g;
  if (f.is_zero()) return g;
  g.row.resize(f.row.size() - 1);
  Integer_polynomial above; // f_j + u·g_j
  for (std::size_t j = f.row.size(); j-- > 0;) {
    if (!above.empty()) above.insert(above.begin(), Integer(0));
    above = combined(1, f.row[j], 1, above);
    if (j > 0) g.row[j - 1] = above;
  }
  if (!above.empty()) throw std::logic_error("locus: the polynomial does not vanish on the diagonal");
  g.trim();
  return g;
}

/// Σ a·f + b·g.
inline Bivariate_polynomial combined(long a, const Bivariate_polynomial& f, long b, const Bivariate_polynomial& g)
{
  Bivariate_polynomial h;
  h.row.resize(std::max(f.row.size(), g.row.size()));
  for (std::size_t j = 0; j < h.row.size(); ++j)
    h.row[j] = combined(a, j < f.row.size() ? f.row[j] : Integer_polynomial(), b, j < g.row.size() ? g.row[j] : Integer_polynomial());
  h.trim();
  return h;
}

/// f(u, u).
inline Integer_polynomial on_diagonal(const Bivariate_polynomial& f)
{
  Integer_polynomial h;
  for (std::size_t j = 0; j < f.row.size(); ++j) {
    if (h.size() < f.row[j].size() + j) h.resize(f.row[j].size() + j);
    for (std::size_t i = 0; i < f.row[j].size(); ++i) h[i + j] += f.row[j][i];
  }
  trim(h);
  return h;
}

} // namespace detail

/// Where the untrimmed bisector b of a point p and one piece of a curve meets itself, b(u) = b(v), as polynomials in two
/// parameters of the piece: those of Farouki & Johnstone (1994), section 3.3, for polynomial and rational curves, and others of
/// lower degree. All are exact up to a number, in powers of the local parameters, whatever these are on the line; n is the
/// curve's degree.
///
/// *The paper's.* With ρ and w as in `Point_curve_forms` and N = wρ' - w'ρ, the tangent's direction, the normal line at r(u) is
/// ν(u) = (wN, ⟨ρ,N⟩), of degree 3n-2, in coordinates where a point p + q is (-qx, -qy, qw). So the lines at u and v meet in
/// ν(u)×ν(v), which is (74); its last component has the factor w(u)w(v), which is left out. That this point is as far from r(u)
/// as from p is ℓ(u)·(ν(u)×ν(v)) = 0, which is (79); since ν is wℓ'/2 - w'ℓ, it is w(u)/2 times (ℓ×ℓ')(u)·ν(v), and with the
/// factor w(u) left out
///   R(u,v) = (ℓ×ℓ')(u)·ν(v) / (v-u),  S(u,v) = -R(v,u),
/// of degrees 4n-3 in u and 3n-3 in v (3n-2 and 2n-2 for a polynomial curve). R = S = 0 holds as well where both normal lines
/// coincide, which `self_intersection_polynomials` takes out again. With T below, R is (w(v)T_v - 2w'(v)T)/(2v - 2u): the slope of
/// T/w² in v, so to speak, and one degree more than need be.
///
/// *The better ones.* b(u) = b(v) says that the tangents ℓ×ℓ' of the inverted curve agree: it is a bitangent. With
///   T(u,v) = det(ℓ(u), ℓ'(u), ℓ(v)),
/// T(u,v) = T(v,u) = 0 says that each tangent passes through the other's point, so that they agree, or the points do. T(u,v) has
/// the factor (v-u)² (ℓ(v) - ℓ(u) - (v-u)ℓ'(u) has), and T2 = T/(v-u)² has degrees 4n-4 and 2n-2 (3n-3 and 2n-2). It knows
/// nothing of normals, and what remains beside self-intersections is known:
///  - on the diagonal T2(u,u) = P_c(u)/2: the cusps;
///  - ℓ(u) ∥ ℓ(v) for u ≠ v: double points r(u) = r(v) of the curve, and of real points no others.
/// Of the symmetric polynomials A = T2(u,v) + T2(v,u) and B = (T2(u,v) - T2(v,u))/(v-u) the cusps are no zeros: with
/// T2(u,u+h) = [012]/2 + [013]h/6 + …, where [012] = P_c and [013] = P_c' are determinants of derivatives of ℓ, B(u,u) =
/// -P_c'(u)/6. That is zero where P_c is only at a multiple root, as at an extraordinary point.
///
/// Here ℓ, ℓ×ℓ' and N are taken without factors that their components share. They have them where the curve stands still or
/// passes through p, and on circles.
class Self_intersection_forms {
public:
  /// Exact, whatever the weights' signs. O(n²) operations on integers.
  Self_intersection_forms(const Curve_piece<2>& piece, const Exact_point<2>& point) : degree_(piece.degree())
  {
    Polynomial_vector<1, 3> given{piece.numerator[0], piece.numerator[1], piece.weight};
    for (std::size_t k = 0; k < 2; ++k) given[k] = subtract(piece.numerator[k], multiply(piece.weight, point[k]));
    auto forms = detail::cleared(given);
    offset_ = {std::move(forms[0]), std::move(forms[1])};
    weight_ = std::move(forms[2]);
    direction_ = detail::primitive(detail::vector_of<2>([&](std::size_t k) {
      return detail::minor(weight_, locus::derivative(offset_[k]), locus::derivative(weight_), offset_[k]);
    }));
    const Integer_vector<3> lift = plain_lift();
    contact_ = detail::common_factor(lift);
    lift_ = detail::primitive(lift);
    tangent_ = detail::primitive(detail::cross(lift_, detail::derivative(lift_)));
  }

  /// n.
  int degree() const { return degree_; }
  const Integer_polynomial& weight() const { return weight_; }
  /// ρ, on the weight's scale.
  const Integer_vector<2>& offset() const { return offset_; }
  /// ℓ, without common factors.
  const Integer_vector<3>& lift() const { return lift_; }
  /// ℓ × ℓ', without common factors: (-qx, -qy, qw) of the bisector's point p + q.
  const Integer_vector<3>& tangent() const { return tangent_; }

  /// P_∞, (36), and (37) without its factor w; see `Point_curve_forms::class_form`.
  Integer_polynomial class_form() const
  {
    return detail::minor(offset_[0], locus::derivative(offset_[1]), offset_[1], locus::derivative(offset_[0]));
  }

  /// P_c, (58), and (59) without its factor w; see `Point_curve_forms::circular_form`.
  Integer_polynomial circular_form() const
  {
    const auto lift = plain_lift(), first = detail::derivative(lift), tangent = detail::cross(lift, first), second = detail::derivative(first);
    Integer_polynomial sum;
    for (std::size_t k = 0; k < 3; ++k) sum = detail::combined(1, sum, 1, multiply(tangent[k], second[k]));
    return sum;
  }

  /// X_i, Y_i and W_i of (74), divided by v - u; of a rational curve without W_i's factor w(u)w(v). Relative to p.
  std::array<Bivariate_polynomial, 3> normals_meet() const
  {
    const Integer_polynomial z = detail::dot(offset_, direction_), wx = multiply(weight_, direction_[0]), wy = multiply(weight_, direction_[1]);
    const auto minor = [](const Integer_polynomial& f, const Integer_polynomial& g) { // f(u)g(v) - f(v)g(u)
      const Integer_vector<2> a{f, g}, b{g, detail::combined(-1, f, 0, {})};
      return detail::divided_by_difference(detail::paired(a, b));
    };
    return {minor(z, wy), minor(wx, z), minor(direction_[0], direction_[1])};
  }

  /// R of (80); S(u,v) is -R(v,u).
  Bivariate_polynomial normal_form() const
  {
    const Integer_vector<3> normal{multiply(weight_, direction_[0]), multiply(weight_, direction_[1]), detail::dot(offset_, direction_)};
    return detail::divided_by_difference(detail::paired(tangent_, normal));
  }

  /// T2.
  Bivariate_polynomial bitangent_form() const
  {
    return detail::divided_by_difference(detail::divided_by_difference(detail::paired(tangent_, lift_)));
  }

  /// A and B.
  std::array<Bivariate_polynomial, 2> symmetric_forms() const
  {
    const Bivariate_polynomial t = bitangent_form(), s = t.swapped();
    return {detail::combined(1, t, 1, s), detail::divided_by_difference(detail::combined(1, t, -1, s))};
  }

  /// [ρx w] and [ρy w], f(u)g(v) - f(v)g(u) each, divided by v - u: both vanish at double points r(u) = r(v), and at two poles.
  std::array<Bivariate_polynomial, 2> double_point_forms() const
  {
    const auto minor = [&](const Integer_polynomial& f) {
      const Integer_vector<2> a{f, weight_}, b{weight_, detail::combined(-1, f, 0, {})};
      return detail::divided_by_difference(detail::paired(a, b));
    };
    return {minor(offset_[0]), minor(offset_[1])};
  }

  /// (ℓ×ℓ')(u)·ℓ'(v) and (ℓ×ℓ')(u)·(dℓ(v) - vℓ'(v)), with d the degree of ℓ: the slopes of ℓ in homogeneous coordinates of the
  /// line. Both vanish exactly if the tangents at u and v agree, and so do the points of b: at a double point of the curve,
  /// if its branches touch.
  std::array<Bivariate_polynomial, 2> tangency_forms() const
  {
    const Integer_vector<3> slope = detail::derivative(lift_);
    const auto other = detail::vector_of<3>([&](std::size_t k) {
      return detail::combined(lift_degree(), lift_[k], -1, multiply(slope[k], {Integer(0), Integer(1)}));
    });
    return {detail::paired(tangent_, slope), detail::paired(tangent_, other)};
  }

  /// P_c/2 for ℓ and ℓ×ℓ' without common factors: T2 on the diagonal.
  Integer_polynomial cusp_form() const { return detail::on_diagonal(bitangent_form()); }

  /// What the components of the plain ℓ share: its roots are parameters of p, if it is on the curve.
  const Integer_polynomial& contact_form() const { return contact_; }

  int lift_degree() const { return greatest_degree(lift_); }
  int tangent_degree() const { return greatest_degree(tangent_); }

private:
  static int greatest_degree(const Integer_vector<3>& a) { return std::max({locus::degree(a[0]), locus::degree(a[1]), locus::degree(a[2])}); }

  Integer_vector<3> plain_lift() const
  {
    const auto twice = [&](std::size_t k) { return detail::combined(2, multiply(weight_, offset_[k]), 0, {}); };
    return {twice(0), twice(1), detail::dot(offset_, offset_)};
  }

  int degree_;
  Integer_polynomial weight_, contact_;
  Integer_vector<2> offset_, direction_;
  Integer_vector<3> lift_, tangent_;
};

} // namespace locus

#endif
