// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_PLANAR_EQUATIONS_H
#define LOCUS_CONSTRAINT_PLANAR_EQUATIONS_H

#include <locus/constraint/planar_curve.h>
#include <locus/function/scaled_basis.h>
#include <locus/zero_set/system.h>

#include <memory>
#include <mutex>

namespace locus {

// The equations of a pair of planar curves, each as a separable sum over one ring T: with e = p1·w2 - p2·w1 and the
// tangents a (of the first curve) and b (of the second).

/// F3 = -Im(e² ā b̄): the equation of Elber & Kim 1998 in its lowest degree. It is twice an angle condition,
/// 2·arg e = arg a + arg b (mod π). Expanded in p1 and p2 it is T2·S0 - 2·T1·S1 + T0·S2 with univariate
/// T_k = p1^k w1^(2-k) ā. On a circle of centre c and radius ρ, a = i·k·z with z = p - c·w and z·z̄ = ρ²w², so that
/// w² divides the triple; it is left out: z̄, ρ²w + c·z̄, ρ²z + 2cρ²w + c²z̄.
struct F3_form {
  static constexpr const char* name = "F3";
  static constexpr bool uses_circles = true;
  static constexpr std::array<int, 2> point_degree{2, 2}, tangent_degree{1, 1};

  template <class T>
  static std::array<Complex_polynomial<T>, 3> triple(const Complex_curve<T>& c)
  {
    if (!c.is_circle) {
      const Complex_polynomial<T> conjugate_tangent = conjugate(c.tangent), wa = multiply(c.weight, conjugate_tangent);
      const Complex_polynomial<T> pa = multiply(c.point, conjugate_tangent);
      return {multiply(c.weight, wa), multiply(c.point, wa), multiply(c.point, pa)};
    }
    const Complex_polynomial<T> zc = conjugate(c.centre_to_point), r2w = multiply(c.weight, c.squared_radius);
    const Complex_polynomial<T> first = combine(r2w, multiply(zc, c.centre[0], c.centre[1]), 1);
    // ρ²z + 2cρ²w + c²z̄ = ρ²z + cρ²w + c·first
    const Complex_polynomial<T> second =
      combine(combine(multiply(c.centre_to_point, c.squared_radius), multiply(r2w, c.centre[0], c.centre[1]), 1),
              multiply(first, c.centre[0], c.centre[1]), 1);
    // ā = -i·k·z̄, and the real factor k is left out.
    std::array<Complex_polynomial<T>, 3> result{zc, first, second};
    for (auto& f : result) f = multiply(f, T(0), T(-1));
    return result;
  }

  template <class T>
  static Separable_sum<T> build(const Complex_curve<T>& c1, const Complex_curve<T>& c2)
  {
    auto t = triple(c1);
    auto s = triple(c2);
    return {{{multiply(t[2], T(-1)), s[0]}, {multiply(t[1], T(2)), s[1]}, {multiply(t[0], T(-1)), s[2]}}, true};
  }
};

/// Real or imaginary part of e: both vanish where the curves meet.
template <bool Imaginary>
struct Difference_form {
  static constexpr const char* name = Imaginary ? "Im(C1 - C2)" : "Re(C1 - C2)";
  static constexpr bool uses_circles = false;
  static constexpr std::array<int, 2> point_degree{1, 1}, tangent_degree{0, 0};

  template <class T>
  static Separable_sum<T> build(const Complex_curve<T>& c1, const Complex_curve<T>& c2)
  {
    return {{{c1.point, c2.weight}, {multiply(c1.weight, T(-1)), c2.point}}, Imaginary};
  }
};

/// Im(e ā): vanishes where the second foot lies on the first curve's tangent line.
struct First_tangent_form {
  static constexpr const char* name = "Im(e conj a)";
  static constexpr bool uses_circles = false;
  static constexpr std::array<int, 2> point_degree{1, 1}, tangent_degree{1, 0};

  template <class T>
  static Separable_sum<T> build(const Complex_curve<T>& c1, const Complex_curve<T>& c2)
  {
    const Complex_polynomial<T> a = conjugate(c1.tangent);
    return {{{multiply(c1.point, a), c2.weight}, {multiply(multiply(c1.weight, a), T(-1)), c2.point}}, true};
  }
};

/// Im(e b̄): vanishes where the first foot lies on the second curve's tangent line.
struct Second_tangent_form {
  static constexpr const char* name = "Im(e conj b)";
  static constexpr bool uses_circles = false;
  static constexpr std::array<int, 2> point_degree{1, 1}, tangent_degree{0, 1};

  template <class T>
  static Separable_sum<T> build(const Complex_curve<T>& c1, const Complex_curve<T>& c2)
  {
    const Complex_polynomial<T> b = conjugate(c2.tangent);
    return {{{c1.point, multiply(c2.weight, b)}, {multiply(c1.weight, T(-1)), multiply(c2.point, b)}}, true};
  }
};

/// W = Im(ā b) = [D1 D̂1]: vanishes where the tangents are parallel.
struct Parallel_tangents_form {
  static constexpr const char* name = "W";
  static constexpr bool uses_circles = false;
  static constexpr std::array<int, 2> point_degree{0, 0}, tangent_degree{1, 1};

  template <class T>
  static Separable_sum<T> build(const Complex_curve<T>& c1, const Complex_curve<T>& c2)
  {
    return {{{conjugate(c1.tangent), c2.tangent}}, true};
  }
};

namespace detail {

/// A form's exact coefficients, for curves of which no circle's carrier is used (`Form::uses_circles`).
/// `Form::point_degree` and `Form::tangent_degree` say how often each curve's point and tangent occur in it.
template <class Form>
Scaled_form scaled_form(const Planar_curve& first, const Planar_curve& second)
{
  Rational factor = 1;
  const auto times = [&](const Rational& x, int power) {
    for (int k = 0; k < power && x != 1; ++k) factor *= x;
  };
  times(first.integer_point_factor(), Form::point_degree[0]);
  times(second.integer_point_factor(), Form::point_degree[1]);
  times(first.integer_tangent_factor(), Form::tangent_degree[0]);
  times(second.integer_tangent_factor(), Form::tangent_degree[1]);
  return {expand(Form::build(first.integer(), second.integer()), false), Rational(1 / factor)};
}

} // namespace detail

/// One of the forms above as an equation on the unit cell of a pair of curve pieces.
template <class Form>
class Curve_pair_equation final : public Equation<2> {
public:
  Curve_pair_equation(std::shared_ptr<const Planar_curve> first, std::shared_ptr<const Planar_curve> second)
    : first_(std::move(first)), second_(std::move(second)), degrees_(Form::build(first_->degrees_only(), second_->degrees_only()).degrees())
  {
  }

  Degrees<2> degrees() const override { return degrees_; }

  /// Built afresh from the curves' parts on the box, seen from a point of the first curve there: near a common point
  /// of the curves e is small, and its enclosure is then relatively as tight as the coordinates'.
  Bernstein<Interval, 2> enclosure(const Box<2>& box) const override
  {
    if (box.lo[0] == 0 && box.lo[1] == 0 && box.hi[0] == 1 && box.hi[1] == 1) {
      std::call_once(unit_once_, [&] { unit_ = enclosure_from(box, {0, 0}); });
      return unit_;
    }
    return enclosure_from(box, place_on_first(0.5 * (box.lo[0] + box.hi[0])));
  }

  Interval value(const std::array<double, 2>& point) const override
  {
    const std::array<double, 2> origin = place_on_first(point[0]);
    return expand(Form::build(first_->at_point(point[0], origin), second_->at_point(point[1], origin)))[0];
  }

  const Bernstein<Scaled_integer, 2>& exact() const override
  {
    std::call_once(once_, [&] {
      if (Form::uses_circles && (first_->is_circle() || second_->is_circle()))
        exact_ = Bernstein<Scaled_integer, 2>(expand(Form::build(first_->exact(), second_->exact())));
      else
        exact_ = detail::scaled_form<Form>(*first_, *second_).bernstein();
      exact_.normalize();
    });
    return exact_;
  }

private:
  /// About the first curve's point at a parameter.
  std::array<double, 2> place_on_first(double at) const
  {
    std::array<double, 2> place{0, 0};
    const Interval t(at), w = evaluate_at(first_->weight_enclosure(), t);
    for (std::size_t v = 0; v < 2; ++v) {
      const double x = midpoint(evaluate_at(first_->numerator_enclosure(v), t) / w);
      place[v] = std::abs(x) < 0x1p100 ? x : 0; // a point at infinity, or nearly so, is no place to look from
    }
    return place;
  }

  Bernstein<Interval, 2> enclosure_from(const Box<2>& box, const std::array<double, 2>& origin) const
  {
    return expand(Form::build(first_->local(box.lo[0], box.hi[0], origin), second_->local(box.lo[1], box.hi[1], origin)));
  }

  std::shared_ptr<const Planar_curve> first_, second_;
  Degrees<2> degrees_;
  mutable std::once_flag unit_once_;
  mutable Bernstein<Interval, 2> unit_;
  mutable std::once_flag once_;
  mutable Bernstein<Scaled_integer, 2> exact_;
};

} // namespace locus

#endif
