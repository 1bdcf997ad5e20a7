// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_POINT_FACES_H
#define LOCUS_ZERO_SET_POINT_FACES_H

#include <locus/function/descartes.h>
#include <locus/zero_set/system.h>

#include <array>
#include <memory>
#include <vector>

namespace locus {

template <int K>
using Equations = std::array<std::shared_ptr<const Equation<K>>, static_cast<std::size_t>(K)>;

namespace detail {

/// The rational with the least denominator in [lo, hi], by continued fractions; as many steps as these have terms.
inline Rational simplest_between(const Rational& lo, const Rational& hi)
{
  Integer whole;
  mpz_cdiv_q(whole.get_mpz_t(), lo.get_num_mpz_t(), lo.get_den_mpz_t());
  if (whole <= hi) return sgn(lo) <= 0 && sgn(hi) >= 0 ? Rational(0) : Rational(whole);
  whole -= 1; // both lie strictly between two integers
  const Rational above = lo - whole, below = hi - whole;
  return Rational(whole + 1 / simplest_between(Rational(1 / below), Rational(1 / above)));
}

/// The other variables' ranges.
template <int K>
std::array<Interval, static_cast<std::size_t>(K) - 1>
along_face(const std::array<Interval, static_cast<std::size_t>(K)>& box, int variable)
{
  std::array<Interval, static_cast<std::size_t>(K) - 1> along;
  for (std::size_t v = 0, w = 0; v < box.size(); ++v)
    if (static_cast<int>(v) != variable) along[w++] = box[v];
  return along;
}

/// Whether all equations vanish at the simplest rational point of the box on a face, exactly.
template <int K>
bool vanish_at_simplest_point(const Equations<K>& equations, const Isolated_solution<K>& p, int variable, int side)
{
  std::array<Rational, static_cast<std::size_t>(K)> point;
  for (std::size_t v = 0; v < point.size(); ++v)
    point[v] = static_cast<int>(v) == variable ? Rational(side)
                                               : simplest_between(Rational(p.box[v].inf()), Rational(p.box[v].sup()));
  for (const auto& f : equations)
    if (evaluate(f->exact(), point) != 0) return false;
  return true;
}

/// Whether some equation certainly has no zero on a face within the box.
template <int K>
bool is_excluded_on_face(const Equations<K>& equations, const Isolated_solution<K>& p, int variable, int side)
{
  Box<K> box;
  for (std::size_t v = 0; v < p.box.size(); ++v) {
    box.lo[v] = static_cast<int>(v) == variable ? side : p.box[v].inf();
    box.hi[v] = static_cast<int>(v) == variable ? side : p.box[v].sup();
  }
  for (const auto& f : equations) {
    bool positive = true, negative = true;
    const Bernstein<Interval, K> form = f->enclosure(box);
    for (const Interval& c : form.coefficients()) {
      positive = positive && c.inf() > 0;
      negative = negative && c.sup() < 0;
    }
    if (positive || negative) return true;
  }
  return false;
}

/// Whether two polynomials other than zero differ by a constant factor, written with the same degrees.
template <int D>
bool is_proportional(const Bernstein<Scaled_integer, D>& f, const Bernstein<Scaled_integer, D>& g)
{
  if (f.degrees() != g.degrees()) return false;
  std::size_t first = 0;
  while (f.sign(first) == Sign::zero) ++first;
  for (std::size_t i = 0; i < f.size(); ++i)
    if (f.values()[i] * g.values()[first] != g.values()[i] * f.values()[first]) return false;
  return true;
}

/// The equations on a face as a square system there, where one of them vanishes on all of it or has a constant multiple
/// among the others; else nothing: then K equations in K-1 variables are left.
template <int K>
std::optional<Equations<K - 1>> square_system_on_face(const Equations<K>& equations, int variable, int side)
{
  std::vector<Bernstein<Scaled_integer, K - 1>> kept;
  for (const auto& f : equations) {
    auto g = face(f->exact(), variable, side == 1);
    bool is_new = !g.is_zero();
    for (const auto& h : kept) is_new = is_new && !is_proportional(g, h);
    if (is_new) kept.push_back(std::move(g));
  }
  if (kept.size() + 1 != equations.size()) return std::nullopt;
  Equations<K - 1> system;
  for (std::size_t k = 0; k < kept.size(); ++k)
    system[k] = std::make_shared<Polynomial_equation<K - 1>>(std::move(kept[k]));
  return system;
}

} // namespace detail
} // namespace locus

#endif
