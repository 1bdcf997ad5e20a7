// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_COMMON_ZEROS_H
#define LOCUS_ZERO_SET_COMMON_ZEROS_H

#include <locus/function/algebraic_extension.h>
#include <locus/function/factorization.h>
#include <locus/function/resultant.h>
#include <locus/zero_set/system.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace locus {

/// Real roots of a univariate polynomial on a closed interval, each in an isolating interval whose ends are no roots, or exact.
struct Projected_roots {
  std::vector<std::array<Rational, 2>> roots;

  /// The part of [lo, hi] between the neighbours of root i: it has no other root.
  std::array<Rational, 2> gap_around(std::size_t i, const Rational& lo, const Rational& hi) const
  {
    // Half way to a neighbour's interval: its root may be that interval's end.
    const auto between = [](const Rational& a, const Rational& b) { return Rational((a + b) / 2); };
    return {i == 0 ? lo : between(roots[i - 1][1], roots[i][0]), i + 1 == roots.size() ? hi : between(roots[i][1], roots[i + 1][0])};
  }
};

/// Roots of f in [lo, hi], which is widened a little to both sides so that a root on an end is inside. Exact.
inline Projected_roots projected_roots(const Integer_polynomial& f, const Rational& lo, const Rational& hi)
{
  Projected_roots result;
  if (degree(f) < 1) return result;
  const auto part = restrict_to(bernstein_form(f), 0, lo, hi);
  const Rational width = hi - lo;
  for (const auto& root : exact_roots(part, Rational(0), Rational(1)).roots) {
    std::array<Rational, 2> at{Rational(lo + root.lo * width), Rational(lo + root.hi * width)};
    for (const int end : {0, 1}) // ends of the unit cell are told exactly
      if (at[0] < end && end < at[1] && Algebraic_extension::value_sign(f, end) == Sign::zero) at = {Rational(end), Rational(end)};
    result.roots.push_back(std::move(at));
  }
  return result;
}

/// A common real zero of several polynomials. `alone_in` is a box that holds no other zero of the first two.
struct Common_zero {
  std::array<std::array<Rational, 2>, 2> at; ///< closed enclosures, exact where both ends agree
  std::array<std::array<Rational, 2>, 2> alone_in;
  std::optional<Algebraic_evidence> evidence; ///< none where signs on the enclosure's sides prove the zero
  /// Which of the sufficient pairs of equations it solves, if one of them proves it.
  std::optional<std::size_t> sufficient;
};

/// The common zeros of polynomials in two variables, by resultants: exact, whatever their multiplicities. The first two must
/// have no common factor. Cost: resultants of the polynomials (see resultant_y), made at the first use.
class Common_zeros {
public:
  using Rational_box = std::array<std::array<Rational, 2>, 2>;
  using Form = Bernstein<Scaled_integer, 2>;

  /// Computations that take long pass the checkpoint, which may stop them; then the object is of no use any more.
  explicit Common_zeros(std::vector<Form> polynomials, Checkpoint checkpoint = {}) : form_(std::move(polynomials)), checkpoint_(std::move(checkpoint))
  {
    for (const Form& f : form_) f_.push_back(bivariate_form(f));
  }

  /// Whether the first two have finitely many common zeros.
  bool is_finite() const
  {
    for (std::size_t v = 0; v < 2; ++v)
      if (projection(v).empty()) return false;
    return true;
  }

  /// Bits that the elimination's integers may need.
  std::size_t bits() const
  {
    if (f_[0].is_zero() || f_[1].is_zero()) return 0;
    return std::max(detail::resultant_bits(f_[0], f_[1]), detail::resultant_bits(f_[0].swapped(), f_[1].swapped()));
  }

  /// An enclosure, and whether it is of a zero that needs no finding any more.
  using Is_known = std::function<bool(const std::array<std::array<Rational, 2>, 2>&)>;

  /// All common zeros in a box; those of the first two polynomials that are known already may be left out. What is near
  /// the box, in `around`, tells how alone the zeros are.
  /// Where a pair of `sufficient` equations vanishes all polynomials do; a regular zero of such a pair needs no algebra.
  std::vector<Common_zero> in(const Rational_box& box, const Rational_box& around, const Is_known& is_known = {},
                              const std::vector<std::array<Form, 2>>& sufficient = {}) const
  {
    std::vector<Common_zero> zeros;
    std::array<Projected_roots, 2> roots;
    std::array<std::vector<Candidate>, 2> candidate;
    for (std::size_t v = 0; v < 2; ++v) {
      if (degree(candidates(v)) < 1) return zeros;
      roots[v] = projected_roots(projection(v), around[v][0], around[v][1]);
      for (std::size_t i = 0; i < roots[v].roots.size(); ++i) {
        const auto& at = roots[v].roots[i];
        if (at[1] < box[v][0] || at[0] > box[v][1] || !has_root(candidates(v), at)) continue;
        candidate[v].push_back({at, Algebraic_extension(candidates(v), at[0], at[1]), roots[v].gap_around(i, around[v][0], around[v][1])});
      }
    }
    for (Candidate& x : candidate[0])
      for (Candidate& y : candidate[1])
        if (auto zero = decide(x, y, is_known, sufficient)) zeros.push_back(std::move(*zero));
    return zeros;
  }

private:
  /// A root of a projection that may be a zero's coordinate, and how far it is alone.
  struct Candidate {
    std::array<Rational, 2> isolating;
    Algebraic_extension root;
    std::array<Rational, 2> alone;

    std::array<Rational, 2> enclosure() const { return {root.lo(), root.hi()}; }

    void narrow(int bits)
    {
      const Rational width = Rational(1) / Rational(Integer(1) << static_cast<mp_bitcnt_t>(bits));
      for (const int end : {0, 1}) root.compare_with(end);
      while (root.hi() - root.lo() > width) root.halve();
    }
  };

  /// Whether there is a zero above both roots: by signs about the place, of ever smaller size, else by exact algebra.
  std::optional<Common_zero> decide(Candidate& x, Candidate& y, const Is_known& is_known,
                                    const std::vector<std::array<Form, 2>>& sufficient) const
  {
    pass(checkpoint_);
    if (is_known && is_known({x.isolating, y.isolating})) return std::nullopt;
    Common_zero zero;
    zero.alone_in = {x.alone, y.alone};
    for (const int bits : {20, 60, 160}) {
      x.narrow(bits);
      y.narrow(bits);
      zero.at = {x.enclosure(), y.enclosure()};
      if (is_refuted(zero.at)) return std::nullopt;
      if (bits == 20) continue;
      if (f_.size() == 2 && is_surrounded(form_[0], form_[1], zero.at)) return zero;
      for (std::size_t k = 0; k < sufficient.size() && !zero.sufficient; ++k)
        if (is_surrounded(sufficient[k][0], sufficient[k][1], zero.at)) zero.sufficient = k;
      if (zero.sufficient) return zero;
    }
    Algebraic_extension field = smallest_field(x.enclosure());
    field.checkpoint = checkpoint_;
    const Extension_polynomial h = common_divisor(field);
    if (h.size() < 2 || !changes_sign(h, y.enclosure(), field)) return std::nullopt;
    zero.at[0] = {field.lo(), field.hi()};
    refine(zero, h, field);
    return zero;
  }

public:
  /// The largest part of `box` about a point that holds no other zero of the first two: no other root of either projection.
  /// Nothing where the point is no zero of them.
  std::optional<std::array<std::array<Rational, 2>, 2>> alone_about(const std::array<std::array<Rational, 2>, 2>& point,
                                                                   const std::array<std::array<Rational, 2>, 2>& box) const
  {
    std::array<std::array<Rational, 2>, 2> part;
    for (std::size_t v = 0; v < 2; ++v) {
      const Projected_roots found = projected_roots(projection(v), box[v][0], box[v][1]);
      std::size_t here = found.roots.size();
      for (std::size_t i = 0; i < found.roots.size(); ++i) {
        if (found.roots[i][1] < point[v][0] || found.roots[i][0] > point[v][1]) continue;
        if (here != found.roots.size()) return std::nullopt; // the point's enclosure is too wide to tell
        here = i;
      }
      if (here == found.roots.size()) return std::nullopt;
      part[v] = found.gap_around(here, box[v][0], box[v][1]);
    }
    return part;
  }

private:
  /// Enclosures are narrowed to this width.
  static Rational finest() { return Rational(1) / Rational(Integer(1) << 56); }

  /// What is left of the polynomials where variable 1 - v is eliminated: of the first two, then of all.
  const Integer_polynomial& projection(std::size_t v) const
  {
    if (!projection_[v]) {
      const Integer_polynomial r = resultant_of(f_[0], f_[1], v);
      const bool share_line = depend_on_one(f_[0], f_[1], v) && degree(r) > 0;
      projection_[v] = share_line ? Integer_polynomial() : square_free(r);
    }
    return *projection_[v];
  }

  const Integer_polynomial& candidates(std::size_t v) const
  {
    if (!candidates_[v]) {
      Integer_polynomial common = projection(v);
      for (std::size_t k = 2; k < f_.size(); ++k)
        for (std::size_t first : {std::size_t(0), std::size_t(1)}) {
          if (degree(common) < (first == 0 ? 1 : 5)) continue; // the second one only to leave less to do
          common = gcd(common, resultant_of(f_[first], f_[k], v));
        }
      candidates_[v] = square_free(common);
    }
    return *candidates_[v];
  }

  static Integer_polynomial square_free(const Integer_polynomial& f)
  {
    if (degree(f) < 1) return f;
    const Integer_polynomial common = gcd(f, derivative(f));
    return degree(common) < 1 ? detail::primitive_part(f) : exact_quotient(f, common);
  }

  /// Whether both are polynomials in variable v alone.
  static bool depend_on_one(const Bivariate_polynomial& f, const Bivariate_polynomial& g, std::size_t v)
  {
    const auto other_degree = [v](const Bivariate_polynomial& h) { return v == 0 ? h.degree_y() : h.degree_x(); };
    return other_degree(f) == 0 && other_degree(g) == 0;
  }

  /// Vanishes where both do; of two polynomials in variable v alone it is their common divisor.
  Integer_polynomial resultant_of(const Bivariate_polynomial& f, const Bivariate_polynomial& g, std::size_t v) const
  {
    if (depend_on_one(f, g, v)) {
      const auto plain = [v](const Bivariate_polynomial& h) { return v == 0 ? h.row[0] : h.swapped().row[0]; };
      return gcd(plain(f), plain(g));
    }
    return v == 0 ? resultant_y(f, g, checkpoint_) : resultant_y(f.swapped(), g.swapped(), checkpoint_);
  }

  /// Whether a polynomial whose roots are all isolated by such intervals has a root in this one.
  static bool has_root(const Integer_polynomial& f, const std::array<Rational, 2>& x)
  {
    const Sign low = Algebraic_extension::value_sign(f, x[0]);
    return x[0] == x[1] ? low == Sign::zero : low != Algebraic_extension::value_sign(f, x[1]);
  }

  static Form restricted(const Form& f, const Rational_box& box)
  {
    return restrict_to(restrict_to(f, 0, box[0][0], box[0][1]), 1, box[1][0], box[1][1]);
  }

  static Sign sign_of_all(const std::vector<Rational>& c)
  {
    const Sign sign = sign_of(c[0]);
    for (const Rational& x : c)
      if (sign_of(x) != sign) return Sign::unknown;
    return sign;
  }

  /// Some polynomial has a strict sign about the point: it is none of their common zeros.
  bool is_refuted(const Rational_box& box) const
  {
    return std::any_of(form_.begin(), form_.end(),
                       [&](const Form& f) { return is_strict(common_sign(restricted(f, box))); });
  }

  /// Two combinations of both polynomials have opposite signs on opposite sides of the box, one pair of sides each: there is a
  /// common zero inside (Poincaré & Miranda).
  static bool is_surrounded(const Form& first, const Form& second, const Rational_box& box)
  {
    for (std::size_t v = 0; v < 2; ++v)
      if (box[v][0] == box[v][1]) return false;
    const std::array<Bernstein<Rational, 2>, 2> f{restricted(first, box).rational(), restricted(second, box).rational()};
    std::array<std::array<Rational, 2>, 2> slope; // across the box, of f[k] along v
    for (std::size_t k = 0; k < 2; ++k) {
      const int n = f[k].degree(0), m = f[k].degree(1);
      slope[k] = {Rational(f[k].at({n, 0}) - f[k].at({0, 0})), Rational(f[k].at({0, m}) - f[k].at({0, 0}))};
    }
    // Rows of the inverse, up to their common factor, make g_v rise along v only.
    const auto rises = [&](int v, const Rational& a, const Rational& b) {
      std::array<std::vector<Rational>, 2> side;
      for (std::size_t end = 0; end < 2; ++end) {
        const auto p = elevated_to_common(face(f[0], v, end == 1), face(f[1], v, end == 1), a, b);
        side[end] = p.coefficients();
      }
      const Sign low = sign_of_all(side[0]), high = sign_of_all(side[1]);
      return is_strict(low) && high == opposite(low);
    };
    return rises(0, slope[1][1], Rational(-slope[0][1])) && rises(1, Rational(-slope[1][0]), slope[0][0]);
  }

  static Bernstein<Rational, 1> elevated_to_common(Bernstein<Rational, 1> f, Bernstein<Rational, 1> g, const Rational& a, const Rational& b)
  {
    const int n = std::max(f.degree(), g.degree());
    if (f.degree() < n) f = elevate(f, 0, n - f.degree());
    if (g.degree() < n) g = elevate(g, 0, n - g.degree());
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = a * f[i] + b * g[i];
    return f;
  }

  /// The numbers over the irreducible factor that has the root.
  Algebraic_extension smallest_field(const std::array<Rational, 2>& x) const
  {
    if (!factors_) factors_ = irreducible_factors(candidates(0));
    for (const Integer_polynomial& factor : *factors_)
      if (has_root(factor, x)) return {factor, x[0], x[1]};
    return {candidates(0), x[0], x[1]};
  }

  /// The greatest common divisor of all polynomials above α, without repeated roots.
  Extension_polynomial common_divisor(Algebraic_extension& field) const
  {
    Extension_polynomial h = over_extension(f_[0], field);
    for (std::size_t k = 1; k < f_.size(); ++k) h = gcd(std::move(h), over_extension(f_[k], field), field);
    return h.size() < 2 ? h : square_free_part(h, field);
  }

  static bool changes_sign(const Extension_polynomial& h, const std::array<Rational, 2>& y, Algebraic_extension& field)
  {
    const Sign low = sign_at(h, y[0], field);
    return y[0] == y[1] ? low == Sign::zero : low != sign_at(h, y[1], field);
  }

  static void refine(Common_zero& zero, const Extension_polynomial& h, Algebraic_extension& field)
  {
    for (const int end : {0, 1}) field.compare_with(end);
    while (field.hi() - field.lo() > finest()) field.halve();
    auto& y = zero.at[1];
    if (h.size() == 2 && degree(field.modulus()) == 1) {
      const auto value = field.reduced(h[0]);
      y[0] = y[1] = value.empty() ? Rational(0) : Rational(-value[0]);
    }
    if (y[0] != y[1]) {
      const Sign low = sign_at(h, y[0], field);
      const auto cut_at = [&](const Rational& x) {
        if (!(y[0] < x && x < y[1])) return;
        const Sign at = sign_at(h, x, field);
        if (at == Sign::zero) y = {x, x};
        else (at == low ? y[0] : y[1]) = x;
      };
      for (const int end : {0, 1}) cut_at(end);
      while (y[1] - y[0] > finest()) cut_at(Rational((y[0] + y[1]) / 2));
    }
    zero.at[0] = {field.lo(), field.hi()};
    Algebraic_evidence evidence;
    evidence.m = field.modulus();
    evidence.lo = field.lo();
    evidence.hi = field.hi();
    for (const auto& c : h) evidence.h.push_back(field.reduced(c));
    evidence.r_lo = y[0];
    evidence.r_hi = y[1];
    zero.evidence = std::move(evidence);
  }

  std::vector<Form> form_;
  Checkpoint checkpoint_;
  std::vector<Bivariate_polynomial> f_;
  mutable std::optional<std::vector<Integer_polynomial>> factors_; ///< of candidates(0)
  mutable std::array<std::optional<Integer_polynomial>, 2> projection_, candidates_;
};

} // namespace locus

#endif
