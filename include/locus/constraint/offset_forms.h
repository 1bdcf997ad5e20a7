// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_OFFSET_FORMS_H
#define LOCUS_CONSTRAINT_OFFSET_FORMS_H

#include <locus/constraint/point_curve.h>
#include <locus/function/diagonal.h>
#include <locus/function/enclosed_vector.h>

namespace locus {

/// When a curve's point r(v) is not inside the circle that touches the curve at r(u) and has its centre in the offset point
/// o = r(u) + d·n(u), n = (y', -x')/σ: with Δ = r(v) - r(u),
///   |r(v) - o|² - d² = |Δ|² - 2d·⟨n(u), Δ⟩ ≥ 0.
/// Without denominators, with r = p/w, e = p(v)w(u) - p(u)w(v) and a vector t along r'(u):
///   |t|·|e|² - 2d·w(u)w(v)·(t_y e_x - t_x e_y) ≥ 0.
/// Squared to lose the root |t| it would be of twice the degree and hold, or not, on the other side of the curve too. The root
/// is kept: |t|² is a polynomial, and the rest is linear in
///   lift(v) = (w², w·x, w·y, |p|²),
/// whatever piece of the curve v runs over. On u's own piece both terms are divisible by (u-v)².
/// T is Rational or Interval; degrees are the same for both.
template <class T>
class Offset_forms {
public:
  using Form = Bernstein<T, 1>;
  using Forms = std::vector<Form>;

  Offset_forms() = default;
  /// `along`: a multiple of the velocity by something positive.
  Offset_forms(std::array<Form, 2> numerator, Form weight, std::array<Form, 2> along)
    : numerator_(std::move(numerator)), weight_(std::move(weight)), along_(std::move(along))
  {
  }

  const std::array<Form, 2>& numerator() const { return numerator_; }
  const Form& weight() const { return weight_; }
  const std::array<Form, 2>& along() const { return along_; }

  Form square() const { return add(multiply(along_[0], along_[0]), multiply(along_[1], along_[1])); }

  Forms lift() const { return of_one_degree(Forms{multiply(weight_, weight_), multiply(weight_, numerator_[0]), multiply(weight_, numerator_[1]), norm()}); }

  /// What stands before lift(v): |t|·first + second.
  struct Pair {
    Forms first, second;
  };

  Pair pair(const T& distance) const
  {
    const T factor = T(-2) * distance;
    const Form w2 = multiply(weight_, weight_), minus_two = constant(T(-2)), zero = constant(T(0));
    const auto scaled = [&](const Form& f) { return multiply(f, factor); };
    const Form across = subtract(multiply(along_[0], numerator_[1]), multiply(along_[1], numerator_[0]));
    return split({norm(), multiply(multiply(weight_, numerator_[0]), minus_two), multiply(multiply(weight_, numerator_[1]), minus_two), w2,
                  scaled(multiply(weight_, across)), scaled(multiply(w2, along_[1])), multiply(scaled(multiply(w2, along_[0])), T(-1)), zero});
  }

  /// On the piece itself, divided by (u-v)²: what stands before the Bernstein basis in v.
  Pair own_pair(const T& distance) const
  {
    const auto chord = [&](std::size_t k) { // e / (u-v)
      return detail::quotient_by_diagonal(
        detail::product_form(of_one_degree(Forms{weight_, multiply(numerator_[k], T(-1))}), of_one_degree(Forms{numerator_[k], weight_})));
    };
    const Bernstein<T, 2> x = chord(0), y = chord(1);
    const auto of_u = [](const Form& f) { return Bernstein<T, 2>(Degrees<2>{f.degree(), 0}, f.coefficients()); };
    const auto of_v = [](const Form& f) { return Bernstein<T, 2>(Degrees<2>{0, f.degree()}, f.coefficients()); };
    Bernstein<T, 2> first = add(multiply(x, x), multiply(y, y));
    const Bernstein<T, 2> turned = subtract(multiply(of_u(along_[1]), x), multiply(of_u(along_[0]), y));
    const bool straight = turned.degree(0) == 0 || turned.degree(1) == 0; // what u - v divides is zero then
    const Bernstein<T, 2> across = straight ? Bernstein<T, 2>(Degrees<2>{0, 0}) : detail::quotient_by_diagonal(turned);
    Bernstein<T, 2> second = multiply(multiply(multiply(of_u(weight_), of_v(weight_)), across), T(T(-2) * distance));
    const Degrees<2> degrees = detail::max_degrees<2>(first.degrees(), second.degrees());
    return {columns(detail::elevated_to(std::move(first), degrees)), columns(detail::elevated_to(std::move(second), degrees))};
  }

private:
  static Form constant(const T& c) { return Form(Degrees<1>{0}, {c}); }

  Form norm() const { return add(multiply(numerator_[0], numerator_[0]), multiply(numerator_[1], numerator_[1])); }

  static Pair split(Forms f)
  {
    f = of_one_degree(std::move(f));
    const auto middle = f.begin() + static_cast<std::ptrdiff_t>(f.size() / 2);
    return {Forms(f.begin(), middle), Forms(middle, f.end())};
  }

  /// By the Bernstein basis in v.
  static Forms columns(const Bernstein<T, 2>& f)
  {
    Forms c;
    for (int j = 0; j <= f.degree(1); ++j) {
      Form column(Degrees<1>{f.degree(0)});
      for (int i = 0; i <= f.degree(0); ++i) column[static_cast<std::size_t>(i)] = f.at({i, j});
      c.push_back(std::move(column));
    }
    return c;
  }

  std::array<Form, 2> numerator_;
  Form weight_;
  std::array<Form, 2> along_;
};

} // namespace locus

#endif
