// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_TRIMMING_BY_ELIMINATION_H
#define LOCUS_CONSTRUCT_TRIMMING_BY_ELIMINATION_H

#include <locus/construct/self_intersections.h>
#include <locus/function/enclosed_vector.h>
#include <locus/shape/parent_curve.h>
#include <locus/zero_set/least_sign.h>

namespace locus {

/// A parameter interval of a curve's piece whose bisector points are true ones; ends on the piece's unit interval.
struct Trimmed_interval {
  std::size_t piece = 0;
  std::array<Isolated_root<Rational>, 2> ends;
};

struct Trimming_options {
  bool beyond_ends = false; ///< reading (70): the curve goes on beyond its ends; else (71)
};

namespace detail {

/// The five steps of Farouki & Johnstone (1994), section 3.2, in exact arithmetic, with step 3 put right: a segment between
/// inflections, class points and circular points is discarded where it is inactive (Theorem 3.1), whatever the distances at its
/// midpoint, since self-intersections may still cut it.
class Elimination_trimmer {
public:
  Elimination_trimmer(const Curve_2& curve, const Exact_point<2>& point, const Trimming_options& options)
  {
    const std::vector<Parent_piece> parent = parent_pieces(curve); // refuses curves of several functions
    std::vector<Curve_piece<2>> all = curve.pieces();
    if (options.beyond_ends) {
      all.clear();
      for (const Parent_piece& p : parent) all.push_back(p.forms);
    }
    for (const Curve_piece<2>& p : all) obstacles_.push_back(of_one_degree(Point_curve_forms(p, point).lift()));
    if (!options.beyond_ends) note_ends(curve);
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) trim(i, curve.pieces()[i], point);
  }

  std::vector<Trimmed_interval> result() { return std::move(found_); }

private:
  using Form = Bernstein<Rational, 1>;

  /// The lifts of the curve's own ends, where circles can come to touch it without a common tangent.
  void note_ends(const Curve_2& curve)
  {
    if (curve.chain().is_closed()) return;
    for (const int end : {0, 1}) {
      const Vector_form& lift = end == 0 ? obstacles_.front() : obstacles_.back();
      const std::size_t k = end == 0 ? 0 : lift[0].size() - 1;
      ends_.push_back({lift[0][k], lift[1][k], lift[2][k]});
    }
  }

  /// Steps 2 and 4: what divides a piece.
  Integer_polynomial dividing_polynomial(const Curve_piece<2>& piece, const Exact_point<2>& point, const Point_curve_forms& forms) const
  {
    Integer_polynomial all{Integer(1)};
    const auto include = [&](Integer_polynomial f) {
      trim_zeros(f);
      if (degree(f) < 1) return;
      const Integer_polynomial common = gcd(all, f);
      all = multiply(all, degree(common) < 1 ? f : exact_quotient(f, common));
    };
    const auto include_form = [&](const Form& f) {
      if (!is_zero(f)) include(monomial_form(Bernstein<Scaled_integer, 1>(f)));
    };
    include_form(wronskian(Polynomial_vector<1, 3>{piece.numerator[0], piece.numerator[1], at_true_degree(piece.weight)}));
    const Self_intersection_polynomials critical = self_intersection_polynomials(Self_intersection_forms(piece, point));
    for (const Integer_polynomial* f : {&critical.p_inf, &critical.p_c, &critical.p_i}) include(*f);
    const auto tangent = forms.tangent();
    for (const auto& end : ends_) {
      Form sum = multiply(tangent[0], end[0]);
      for (std::size_t k = 1; k < 3; ++k) sum = add(sum, multiply(tangent[k], end[k]));
      include_form(at_true_degree(sum));
    }
    return all;
  }

  static void trim_zeros(Integer_polynomial& f)
  {
    while (!f.empty() && f.back() == 0) f.pop_back();
  }

  void trim(std::size_t index, const Curve_piece<2>& piece, const Exact_point<2>& point)
  {
    const Point_curve_forms forms(piece, point);
    const Form class_form = forms.class_form(), circular_form = forms.circular_form();
    if (is_zero(class_form) || is_zero(circular_form)) return; // no arc: all in one centre, or at infinity
    const Vector_form tangent = of_one_degree(forms.tangent());
    const auto exactly = [](int x) { return Isolated_root<Rational>{Rational(x), Rational(x), 1, nullptr}; };
    const Integer_polynomial dividing = dividing_polynomial(piece, point, forms);
    std::vector<Isolated_root<Rational>> cuts{exactly(0)};
    if (degree(dividing) > 0)
      for (auto& root : exact_roots(bernstein_form(dividing), Rational(0), Rational(1)).roots)
        if (root.hi != 0 && root.lo != 1) cuts.push_back(std::move(root));
    cuts.push_back(exactly(1));
    bool was_kept = false;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Rational u = (cuts[k].hi + cuts[k + 1].lo) / 2;
      const int side = sgn(evaluate_at(class_form, u));
      const bool is_active = side * sgn(evaluate_at(circular_form, u)) > 0;
      const bool is_kept = is_active && is_empty(tangent, u, side);
      if (is_kept && was_kept) found_.back().ends[1] = cuts[k + 1];
      else if (is_kept) found_.push_back({index, {cuts[k], cuts[k + 1]}});
      was_kept = is_kept;
    }
  }

  /// Step 5: no point of the curve is inside the circle, by the sign of a polynomial over the whole domain.
  bool is_empty(const Vector_form& tangent, const Rational& u, int side) const
  {
    for (const Vector_form& lift : obstacles_) {
      Form g(lift[0].degrees());
      for (std::size_t r = 0; r < 3; ++r) {
        const Rational x = side * evaluate_at(tangent[r], u);
        for (std::size_t j = 0; j < g.size(); ++j) g[j] += x * lift[r][j];
      }
      if (least_sign(g) == Sign::negative) return false;
    }
    return true;
  }

  std::vector<Vector_form> obstacles_;
  std::vector<std::array<Rational, 3>> ends_;
  std::vector<Trimmed_interval> found_;
};

} // namespace detail

/// The parts of the untrimmed bisector of a point and a curve that are true, as Farouki & Johnstone (1994) find them: inflections,
/// class points, circular points and all self-intersections by elimination, and between them an exact test of one circle's
/// emptiness. For curves of one rational function and points that are not on them; `bisector` does the same for all curves, and
/// some hundred times faster, without elimination.
inline std::vector<Trimmed_interval> trimmed_by_elimination(const Coordinates_2& point, const Curve_2& curve, const Trimming_options& options = {})
{
  return detail::Elimination_trimmer(curve, point.exact(), options).result();
}

} // namespace locus

#endif
