// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRAINT_F3_PROBLEM_H
#define LOCUS_CONSTRAINT_F3_PROBLEM_H

#include <locus/constraint/planar_equations.h>
#include <locus/function/corner_chart.h>
#include <locus/function/diagonal.h>

#include <optional>
#include <vector>

namespace locus {

/// A component of F3 = 0 that is no arc of the bisector.
struct Degenerate_component {
  enum class Kind : unsigned char {
    centre,     ///< maps to one point, the centre of the circle that carries an input
    infinity,   ///< maps to infinity: the curve is tangent there to the line that carries the other input
    overlap,    ///< the inputs coincide along it; every point of it is its own bisector point
    everything  ///< F3 vanishes identically: both inputs lie on one line or one circle
  };
  Kind kind = Kind::everything;
  int input = -1;              ///< whose parameter is constant along it (centre, infinity)
  double lo = 0, hi = 1;       ///< enclosure of that parameter, on the unit interval
  int multiplicity = 1;
  Diagonal line;               ///< of an overlap
};

/// What a cause of an F3 problem says of its solutions (`Cause::tag`).
enum class F3_cause : int {
  meeting,  ///< the curves meet
  pole,     ///< a common tangent line: the bisector goes to infinity
  axis,     ///< two factors meet
  diagonal  ///< a self-bisector's end, where the curvature is extremal
};

constexpr int tag_of(F3_cause c) { return static_cast<int>(c); }

/// What gives the bisector point where the two feet come together, on the diagonal of a self-bisector or at a blown-up
/// corner: with δ = t - r, or a chart's coordinates, e = δ^k·chord and Im(e ā) = δ^l·turn. The point lies at
/// -|e|²/(2 w1 w2 Im(e ā)) times iā from the first foot. Both vanish with δ; chord and turn do not, unless the curvature does.
struct Contact_form {
  std::array<Bernstein<Scaled_integer, 2>, 2> chord;
  Bernstein<Scaled_integer, 2> turn;
  std::array<int, 2> power{0, 0}; ///< 2k - l: |e|²/Im(e ā) = δ^power·|chord|²/turn; other than zero on charts only
};

/// The bisector of two planar curve pieces as a system in their parameters, or in a chart of them.
struct F3_problem {
  std::shared_ptr<const Planar_curve> first, second;
  Corner_chart chart;
  bool is_self = false;       ///< both are one piece: only t > r is wanted
  System<1, 2> system;
  /// For mirror images: the axis, a factor of F3 that `system` is then without. Both have the cause number 0 in common, their crossings.
  std::optional<System<1, 2>> axis;
  std::optional<System<1, 2>> whole; ///< F3 with the axis, for places where the factors do not simply cross
  Diagonal axis_line;
  Degrees<2> degrees{}; ///< of the equation as solved
  std::vector<Degenerate_component> degenerate;
  bool repeats_degenerate = false; ///< another chart's problem lists the same ones
  std::optional<Contact_form> contact; ///< where the feet can come together
};

namespace detail {

template <class Form>
std::shared_ptr<const Equation<2>> pair_equation(const F3_problem& p)
{
  return std::make_shared<Curve_pair_equation<Form>>(p.first, p.second);
}

} // namespace detail
} // namespace locus

#endif
