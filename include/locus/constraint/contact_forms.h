// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_CONTACT_FORMS_H
#define LOCUS_CONSTRAINT_CONTACT_FORMS_H

#include <locus/constraint/planar_curve.h>
#include <locus/function/enclosed_vector.h>

namespace locus {

/// A circle, or a line, is given by c = (α, β, γ, δ): the points where f(x, y) = α(x² + y²) + βx + γy + δ vanishes; inside f is
/// negative. Along a curve piece p/w with a tangent t (a positive multiple of p'w - pw') both of these are linear in c:
///   power:  w²·f(p/w) = (|p|², w·x, w·y, w²) · (α, β, γ, δ),
///   turn:   w³·(f(p/w))', times something positive, = (2⟨p, t⟩, w·t_x, w·t_y) · (α, β, γ).
/// The circle passes through a point of the curve where the power vanishes, and touches the curve there where the turn does, too.
/// T is Rational or Interval; degrees are the same for both.
template <class T>
struct Contact_forms {
  using Form = Bernstein<T, 1>;

  std::vector<Form> power, turn;

  Contact_forms(const std::array<Form, 2>& p, const Form& w, const std::array<Form, 2>& t)
  {
    power = of_one_degree(std::vector<Form>{add(multiply(p[0], p[0]), multiply(p[1], p[1])), multiply(w, p[0]), multiply(w, p[1]), multiply(w, w)});
    turn = of_one_degree(std::vector<Form>{multiply(add(multiply(p[0], t[0]), multiply(p[1], t[1])), T(2)), multiply(w, t[0]), multiply(w, t[1])});
  }
};

/// Of a piece in frame coordinates, enclosed (upward rounding needed).
inline Contact_forms<Interval> enclosed_contact_forms(const Planar_curve& c)
{
  return {{c.numerator_enclosure(0), c.numerator_enclosure(1)}, c.weight_enclosure(), {c.tangent_enclosure(0), c.tangent_enclosure(1)}};
}

} // namespace locus

#endif
