// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_CURVATURE_2_H
#define LOCUS_CONSTRAINT_CURVATURE_2_H

#include <locus/constraint/planar_curve.h>

namespace locus {

/// The curvature of a planar curve piece by exact polynomials: with D1 = p'w - pw' and the Wronskian Wr of (X, Y, W),
/// κ = Wr·w³/|D1|³ and dκ/ds = critical·w⁴/|D1|⁶, where critical = (Wr'w + 3Wr·w')⟨D1,D1⟩ - 3Wr·w⟨D1,D1'⟩.
/// (Chen, Riesenfeld & Cohen give higher degrees; these are the true ones or differ from them by a vanishing leading term.)
struct Curvature_forms {
  std::array<Bernstein<Rational, 1>, 2> first;  ///< D1
  Bernstein<Rational, 1> wronskian, critical, weight;

  explicit Curvature_forms(const Planar_curve& c) : weight(c.weight())
  {
    const std::array<Bernstein<Rational, 1>, 3> f{c.numerator(0), c.numerator(1), c.weight()};
    for (std::size_t v = 0; v < 2; ++v) first[v] = detail::first_derivative_numerator(f[v], f[2]);
    wronskian = wronskian_of(f);
    const auto dot = [&](const std::array<Bernstein<Rational, 1>, 2>& a, const std::array<Bernstein<Rational, 1>, 2>& b) {
      return add(multiply(a[0], b[0]), multiply(a[1], b[1]));
    };
    const std::array<Bernstein<Rational, 1>, 2> second{derivative(first[0]), derivative(first[1])};
    const auto grows = add(multiply(derivative(wronskian), weight), multiply(multiply(wronskian, derivative(weight)), Rational(3)));
    critical = subtract(multiply(grows, dot(first, first)), multiply(multiply(multiply(wronskian, weight), dot(first, second)), Rational(3)));
  }

  /// A curvature that is compared exactly: its sign and its square.
  struct Exact_curvature {
    int sign = 0;
    Rational square;
    Rational slope; ///< dκ/ds

    bool same_curvature(const Exact_curvature& other) const { return sign == other.sign && square == other.square; }
  };

  /// At a rational parameter where the piece is finite and does not stand still.
  Exact_curvature at(const Rational& u) const
  {
    const Rational x = evaluate_at(first[0], u), y = evaluate_at(first[1], u), w = evaluate_at(weight, u), wr = evaluate_at(wronskian, u);
    const Rational speed = x * x + y * y, speed3 = speed * speed * speed, w2 = w * w;
    return {sgn(wr) * sgn(w), Rational(wr * wr * w2 * w2 * w2 / speed3), Rational(evaluate_at(critical, u) * w2 * w2 / speed3)};
  }

private:
  static Bernstein<Rational, 1> wronskian_of(const std::array<Bernstein<Rational, 1>, 3>& f)
  {
    std::array<Bernstein<Rational, 1>, 3> d, dd;
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = derivative(f[k]);
      dd[k] = derivative(d[k]);
    }
    Bernstein<Rational, 1> sum(Degrees<1>{0});
    for (std::size_t k = 0; k < 3; ++k) { // along the first row
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      sum = add(sum, multiply(f[k], subtract(multiply(d[i], dd[j]), multiply(d[j], dd[i]))));
    }
    return sum;
  }
};

} // namespace locus

#endif
