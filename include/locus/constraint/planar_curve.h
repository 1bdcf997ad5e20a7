// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_PLANAR_CURVE_H
#define LOCUS_CONSTRAINT_PLANAR_CURVE_H

#include <locus/function/bounded_bernstein.h>
#include <locus/function/complex_polynomial.h>
#include <locus/shape/carrier.h>
#include <locus/shape/framed.h>
#include <locus/shape/velocity.h>

#include <mutex>

namespace locus {

/// A planar curve piece in complex notation, p = X + iY, as the constraints need it, over a ring T in the scaled
/// basis. `tangent` is D1 = p'w - pw' up to a positive real factor; on a circle z = p - centre·w stands for it.
template <class T>
struct Complex_curve {
  Complex_polynomial<T> point, weight, tangent;
  bool is_circle = false;
  Complex_polynomial<T> centre_to_point; ///< z, on a circle
  std::array<T, 2> centre{T(0), T(0)};   ///< relative to the current origin
  T squared_radius = T(0);
};

/// A planar curve piece in frame coordinates with everything the constraints are built from: exact, as integers and
/// as enclosures. Immutable after construction.
class Planar_curve {
public:
  /// Throws Unsupported_feature for a cusp inside the piece.
  Planar_curve(const Curve_piece<2>& original, const Frame<2>& frame) : carrier_(carrier_of(original))
  {
    const Curve_piece<2> piece = detail::in_frame(original, frame);
    numerator_ = piece.numerator;
    weight_ = piece.weight;
    for (std::size_t v = 0; v < 2; ++v) tangent_[v] = detail::velocity_numerator(numerator_[v], weight_);
    regularise_tangent();
    if (carrier_.kind == Carrier::Kind::circle) {
      for (std::size_t v = 0; v < 2; ++v) carrier_.centre[v] = frame.into(carrier_.centre[v], v);
      Rational& r2 = carrier_.squared_radius;
      if (frame.exponent >= 0) mpq_div_2exp(r2.get_mpq_t(), r2.get_mpq_t(), 2 * static_cast<mp_bitcnt_t>(frame.exponent));
      else mpq_mul_2exp(r2.get_mpq_t(), r2.get_mpq_t(), 2 * static_cast<mp_bitcnt_t>(-frame.exponent));
    }
    for (std::size_t v = 0; v < 2; ++v) {
      numerator_enclosure_[v] = enclosing(numerator_[v]);
      tangent_enclosure_[v] = enclosing(tangent_[v]);
    }
    weight_enclosure_ = enclosing(weight_);
  }

  const Carrier& carrier() const { return carrier_; }
  Curve_piece<2> piece() const { return {numerator_, weight_}; } ///< in frame coordinates
  const Bernstein<Rational, 1>& numerator(std::size_t axis) const { return numerator_[axis]; }
  const Bernstein<Rational, 1>& weight() const { return weight_; }
  const Bernstein<Rational, 1>& tangent(std::size_t axis) const { return tangent_[axis]; }
  const Bernstein<Interval, 1>& numerator_enclosure(std::size_t axis) const { return numerator_enclosure_[axis]; }
  const Bernstein<Interval, 1>& weight_enclosure() const { return weight_enclosure_; }
  const Bernstein<Interval, 1>& tangent_enclosure(std::size_t axis) const { return tangent_enclosure_[axis]; }
  /// The curve stands still at an end (0 or 1), or that end is infinite: D1 vanishes or the weight does.
  bool is_singular_at(int end) const
  {
    if (is_infinite_at(end)) return true;
    const auto pair = [end](const Bernstein<Rational, 1>& f) {
      const std::size_t n = f.size();
      if (n == 1) return std::array<const Rational*, 2>{&f[0], &f[0]};
      return end == 0 ? std::array<const Rational*, 2>{&f[0], &f[1]} : std::array<const Rational*, 2>{&f[n - 1], &f[n - 2]};
    };
    const auto w = pair(weight_);
    for (const auto& x : numerator_) {
      const auto p = pair(x);
      if (weight_.degree() == 0 ? *p[0] != *p[1] : *p[1] * *w[0] != *p[0] * *w[1]) return false;
    }
    return true;
  }
  /// The end at 0 or 1 is a point at infinity.
  bool is_infinite_at(int end) const { return weight_[end == 0 ? 0 : weight_.size() - 1] == 0; }

  /// On [lo, hi] of the unit interval, seen from `origin` (upward rounding needed).
  Complex_curve<Interval> local(double lo, double hi, const std::array<double, 2>& origin) const
  {
    return seen_from(origin, [&](const Bernstein<Interval, 1>& f) {
      Bernstein<Interval, 1> g = lo == 0 && hi == 1 ? f : restrict_to(f, 0, Interval(lo), Interval(hi));
      return scaled_by_binomials(std::move(g), false).coefficients();
    });
  }

  /// At one point, as polynomials of degree zero.
  Complex_curve<Interval> at_point(double u, const std::array<double, 2>& origin) const
  {
    return seen_from(origin, [&](const Bernstein<Interval, 1>& f) { return std::vector<Interval>{evaluate_at(f, Interval(u))}; });
  }

  /// On the whole unit interval over the rationals.
  Complex_curve<Rational> exact() const
  {
    const auto scaled = [](const Bernstein<Rational, 1>& f) { return scaled_by_binomials(f, false).coefficients(); };
    Complex_curve<Rational> c;
    c.weight = real_polynomial(scaled(weight_));
    c.point = {scaled(numerator_[0]), scaled(numerator_[1])};
    c.tangent = {scaled(tangent_[0]), scaled(tangent_[1])};
    if (is_circle()) {
      c.is_circle = true;
      c.centre = carrier_.centre;
      c.squared_radius = carrier_.squared_radius;
      c.centre_to_point = shifted(c.point, c.weight, carrier_.centre[0], carrier_.centre[1]);
    }
    return c;
  }

  /// The same over the integers: numerator and weight times one positive factor, the tangent times another. Made on demand
  /// and kept; without a circle's centre.
  const Complex_curve<Integer>& integer() const
  {
    make_integer();
    return integer_;
  }
  const Rational& integer_point_factor() const
  {
    make_integer();
    return point_factor_;
  }
  const Rational& integer_tangent_factor() const
  {
    make_integer();
    return tangent_factor_;
  }

  /// Zeros of the right degrees, from which a form's degrees follow.
  Complex_curve<double> degrees_only() const
  {
    const auto zeros = [](const Bernstein<Rational, 1>& f) { return std::vector<double>(f.size(), 0.0); };
    Complex_curve<double> c;
    c.weight = real_polynomial(zeros(weight_));
    c.point = {zeros(numerator_[0]), zeros(numerator_[1])};
    c.tangent = {zeros(tangent_[0]), zeros(tangent_[1])};
    c.is_circle = is_circle();
    if (c.is_circle) c.centre_to_point = c.point;
    return c;
  }

  bool is_circle() const { return carrier_.kind == Carrier::Kind::circle; }
  bool is_line() const { return carrier_.kind == Carrier::Kind::line; }

private:
  /// The curve with each of its functions given by `part` of it.
  template <class Part>
  Complex_curve<Interval> seen_from(const std::array<double, 2>& origin, Part part) const
  {
    Complex_curve<Interval> c;
    c.weight = real_polynomial(part(weight_enclosure_));
    c.point = {part(numerator_enclosure_[0]), part(numerator_enclosure_[1])};
    c.tangent = {part(tangent_enclosure_[0]), part(tangent_enclosure_[1])};
    if (is_circle()) {
      c.centre_to_point = shifted(c.point, c.weight, enclosing(carrier_.centre[0]), enclosing(carrier_.centre[1]));
      c.squared_radius = enclosing(carrier_.squared_radius);
      c.is_circle = true;
      for (std::size_t v = 0; v < 2; ++v) c.centre[v] = enclosing(carrier_.centre[v]) - Interval(origin[v]);
    }
    if (origin[0] != 0 || origin[1] != 0) c.point = shifted(c.point, c.weight, Interval(origin[0]), Interval(origin[1]));
    return c;
  }

  /// p - (x + iy)·w
  template <class T>
  static Complex_polynomial<T> shifted(const Complex_polynomial<T>& p, const Complex_polynomial<T>& w, const T& x, const T& y)
  {
    return combine(p, multiply(w, x, y), -1);
  }

  /// F3 depends on the tangent lines only, so real zeros of D1 are divided out: at an end (a doubled control point)
  /// the limit direction remains; on a line a constant direction remains.
  void regularise_tangent()
  {
    if (is_line()) {
      reject_cusps(real_common_factor());
      for (std::size_t v = 0; v < 2; ++v) tangent_[v] = Bernstein<Rational, 1>(Degrees<1>{0}, {carrier_.direction[v]});
      return;
    }
    for (std::size_t v = 0; v < 2; ++v)
      if (detail::all_of_one_sign(tangent_[v])) return;
    const Integer_polynomial common = real_common_factor();
    if (degree(common) < 1) return;
    reject_cusps(common);
    const Bernstein<Rational, 1> divisor = bernstein_form(common).rational();
    const Rational half(1, 2);
    const int sign = sgn(evaluate_at(divisor, half));
    for (std::size_t v = 0; v < 2; ++v) tangent_[v] = multiply(divide_exactly(tangent_[v], divisor), Rational(sign));
  }

  Integer_polynomial real_common_factor() const
  {
    return gcd(monomial_form(Bernstein<Scaled_integer, 1>(tangent_[0])), monomial_form(Bernstein<Scaled_integer, 1>(tangent_[1])));
  }

  static void reject_cusps(const Integer_polynomial& common)
  {
    if (degree(common) < 1) return;
    for (const auto& root : exact_roots(bernstein_form(common), Rational(0), Rational(1)).roots)
      if (!(root.is_exact() && (root.lo == 0 || root.lo == 1)))
        throw Unsupported_feature("a curve with a cusp inside its domain (near parameter " +
                                  std::to_string(Rational((root.lo + root.hi) / 2).get_d()) + ")");
  }

  void make_integer() const
  {
    std::call_once(integer_once_, [this] {
      const auto cleared = [](std::initializer_list<const Bernstein<Rational, 1>*> functions, Rational& factor) {
        Integer d = 1;
        for (const auto* f : functions)
          for (const Rational& x : f->coefficients())
            if (x.get_den() != 1) d = lcm(d, x.get_den());
        factor = d;
        std::vector<std::vector<Integer>> out;
        for (const auto* f : functions) {
          out.emplace_back();
          for (std::size_t i = 0; i < f->size(); ++i) {
            Integer c = d;
            mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), (*f)[i].get_den_mpz_t());
            c *= (*f)[i].get_num();
            c *= binomial<Integer>(f->degree(), static_cast<int>(i));
            out.back().push_back(std::move(c));
          }
        }
        return out;
      };
      auto point = cleared({&numerator_[0], &numerator_[1], &weight_}, point_factor_);
      auto tangent = cleared({&tangent_[0], &tangent_[1]}, tangent_factor_);
      integer_.point = {std::move(point[0]), std::move(point[1])};
      integer_.weight = real_polynomial(std::move(point[2]));
      integer_.tangent = {std::move(tangent[0]), std::move(tangent[1])};
    });
  }

  Carrier carrier_;
  std::array<Bernstein<Rational, 1>, 2> numerator_, tangent_;
  Bernstein<Rational, 1> weight_;
  std::array<Bernstein<Interval, 1>, 2> numerator_enclosure_, tangent_enclosure_;
  Bernstein<Interval, 1> weight_enclosure_;
  mutable std::once_flag integer_once_;
  mutable Complex_curve<Integer> integer_;
  mutable Rational point_factor_ = 1, tangent_factor_ = 1;
};

} // namespace locus

#endif
