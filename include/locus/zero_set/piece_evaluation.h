// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_PIECE_EVALUATION_H
#define LOCUS_ZERO_SET_PIECE_EVALUATION_H

#include <locus/function/enclosed_surface.h>
#include <locus/zero_set/curve_graph.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace locus {

/// The dependent variable of an arc with its first and second derivative by the base variable, over a stretch.
struct Dependent_jet {
  Interval value, first, second;
};

/// Evaluates an arc's stretch in a graph cell, where F(x_pivot, x_base) = 0 has one solution x_pivot for each base
/// value. All positions are on the unit cell. Needs upward rounding; read-only and cheap to make, not to be shared by
/// threads (it keeps scratch memory).
class Piece_evaluator {
public:
  Piece_evaluator(const Curve_graph::Cell_form& form, int base)
    : form_(form), base_(base), pivot_(1 - base), n_(form.f.degree(pivot_)), m_(form.f.degree(base)), norm_(form.f.norm()),
      row_(static_cast<std::size_t>(n_) + 1), weight_(static_cast<std::size_t>(m_) + 1)
  {
  }

  int base() const { return base_; }
  int pivot() const { return pivot_; }

  /// Certified enclosure of the pivot variable at base value s, usually a few units in the last place wide; `guess`
  /// starts the search. Signs at both ends prove it, by the ladder; exact ones only where it is wider than wanted.
  Interval pivot_at(double s, double guess, double wanted_width = 5e-13) const
  {
    const double lo = form_.box.lo[pivot_index()], hi = form_.box.hi[pivot_index()], width = hi - lo;
    const double error = contract(s);
    const double* g = row_.data();
    double u = std::min(1.0, std::max(0.0, (guess - lo) / width));
    double slope = 0;
    for (int step = 0; step < 12; ++step) {
      slope = detail::horner_slope(g, n_, u);
      const double next = std::min(1.0, std::max(0.0, u - detail::horner_value(g, n_, u) / slope));
      const double moved = std::abs(next - u);
      u = next;
      if (!(moved > 0x1p-27)) break; // Newton squares the error; the signs below prove the rest
    }
    const double radius = std::max(1.25 * error / std::abs(slope), 0x1p-52);
    const Sign high = sign_of(g[n_], error), low = sign_of(g[0], error);
    const Sign above = is_strict(high) ? high : opposite(low);
    for (double delta = radius; is_strict(above) && delta < 0.8 * wanted_width / width && delta < 0.5; delta *= 2) {
      const double a = std::max(0.0, u - delta), b = std::min(1.0, u + delta);
      const double ga = detail::horner_value(g, n_, a), gb = detail::horner_value(g, n_, b);
      const bool below_a = a == 0 ? low == opposite(above) : sign_of(ga, error) == opposite(above);
      const bool above_b = b == 1 ? high == above : sign_of(gb, error) == above;
      if (below_a && above_b) return Interval(lo) + Interval(a, b) * Interval(width);
    }
    return pivot_by_ladder(s, error, wanted_width);
  }

  /// Enclosures over base values [s0, s1] of the pivot and its derivatives, given its values at both ends.
  std::optional<Dependent_jet> jet_over(double s0, double s1, const Interval& at_s0, const Interval& at_s1) const
  {
    const Interval ds = Interval(s1) - Interval(s0);
    // x(s) lies within half the step times the slope of the values at both ends: first with the whole cell's slope,
    // then with the slope over the box that this gives.
    const Interval range = range_over(s0, s1, at_s0, at_s1);
    const auto slopes = partials(sub_box(range, s0, s1));
    if (!slopes) return std::nullopt;
    const Interval slope = -slopes->f_base / slopes->f_pivot;
    const double growth = std::min(form_.box.width(pivot_), (Interval(magnitude(slope)) * ds).sup() * 0.5);
    const Interval closer = hull(at_s0, at_s1) + Interval(-growth, growth);
    const Interval second = -(slopes->f_bb + Interval(2) * slopes->f_pb * slope + slopes->f_pp * slope * slope) / slopes->f_pivot;
    return Dependent_jet{Interval(std::max(range.inf(), closer.inf()), std::min(range.sup(), closer.sup())), slope, second};
  }

  /// The form restricted to base values [s0, s1] and to where the arc is there, given its values at both ends: bounds of
  /// slopes are then those of that part.
  Curve_graph::Cell_form restricted_form(double s0, double s1, const Interval& at_s0, const Interval& at_s1) const
  {
    Curve_graph::Cell_form part{sub_box(range_over(s0, s1, at_s0, at_s1), s0, s1), form_.f, form_.equation};
    for (std::size_t v = 0; v < 2; ++v) {
      double &lo = part.box.lo[v], &hi = part.box.hi[v];
      lo = std::max(form_.box.lo[v], lo);
      hi = std::min(form_.box.hi[v], hi);
      if (!(lo < hi)) return form_;
    }
    part.f = part.box.max_width() < part.exact_below ? rounded_form(part.box) : bounded(form_.equation->enclosure(part.box));
    return part;
  }

  /// True if the derivative by the base variable has one strict sign on the whole cell, by its coefficients.
  bool has_strict_base_slope() const
  {
    const Bernstein<Bounded, 2> d = derivative(form_.f, base_);
    const auto& c = d.values().coefficients();
    const auto [least, greatest] = std::minmax_element(c.begin(), c.end());
    return *least > d.error() || *greatest < -d.error();
  }

  /// Enclosure of the pivot over base values [s0, s1] from its values at both ends: a tube on whose sides the equation
  /// is proved to have its two signs, or, failing that, what the cell's greatest slope allows. Always finite.
  Interval range_over(double s0, double s1, const Interval& at_s0, const Interval& at_s1) const
  {
    const auto p = pivot_index(), b = base_index();
    const Box<2> ends = sub_box(hull(at_s0, at_s1), s0, s1);
    const Local local = to_local(ends);
    const Surfaces& d = surfaces();
    const Interval slope = d.p.at(local.centre);
    double margin = 1.5 * (d.f.slope[b] * local.radius[b] + d.f.error) / mignitude(slope) + local.radius[p];
    for (int attempt = 0; attempt < 3 && margin < 0.5; ++attempt, margin *= 4) {
      const double lo = std::max(0.0, local.centre[p] - margin), hi = std::min(1.0, local.centre[p] + margin);
      if ((lo == 0 || sign_beside(local, lo) == opposite(sign_of(slope))) && (hi == 1 || sign_beside(local, hi) == sign_of(slope))) {
        const Interval tube = Interval(form_.box.lo[p]) + Interval(lo, hi) * Interval(form_.box.width(pivot_));
        return {std::max(tube.inf(), form_.box.lo[p]), std::min(tube.sup(), form_.box.hi[p])};
      }
    }
    const double growth = std::min(form_.box.width(pivot_), (Interval(cell_slope()) * (Interval(s1) - Interval(s0))).sup() * 0.5);
    const Interval range = hull(at_s0, at_s1) + Interval(-growth, growth);
    return {std::max(range.inf(), form_.box.lo[p]), std::min(range.sup(), form_.box.hi[p])};
  }

private:
  /// Rounded from the exact polynomial.
  Bernstein<Bounded, 2> rounded_form(const Box<2>& box) const
  {
    auto f = form_.equation->exact();
    for (int v = 0; v < 2; ++v) f = restrict_to(f, v, Rational(box.lo[static_cast<std::size_t>(v)]), Rational(box.hi[static_cast<std::size_t>(v)]));
    return bounded(enclosing(f.rational()));
  }

  /// Greatest slope of the pivot by the base variable over the whole cell, from the coefficients' differences; a large
  /// finite number where they do not bound it.
  double cell_slope() const
  {
    if (!cell_slope_) {
      const auto range = [&](int v) {
        const Bernstein<Bounded, 2> d = derivative(form_.f, v);
        const auto& c = d.values().coefficients();
        const auto [least, greatest] = std::minmax_element(c.begin(), c.end());
        return (Interval(*least, *greatest) + Interval(-d.error(), d.error())) / Interval(form_.box.width(v));
      };
      const Interval by_pivot = range(pivot_);
      cell_slope_ = contains_zero(by_pivot) ? 0x1p100 : magnitude(range(base_) / by_pivot);
    }
    return *cell_slope_;
  }

  struct Partials {
    Interval f_pivot, f_base, f_pp, f_pb, f_bb;
  };

  std::size_t pivot_index() const { return static_cast<std::size_t>(pivot_); }
  std::size_t base_index() const { return static_cast<std::size_t>(base_); }

  /// Coefficients in the pivot at base value s; returns their error bound.
  double contract(double s) const
  {
    const double lo = form_.box.lo[base_index()], hi = form_.box.hi[base_index()];
    const double v = std::min(1.0, std::max(0.0, (s - lo) / (hi - lo)));
    detail::bernstein_weights(m_, v, weight_.data());
    const double* c = form_.f.values().data();
    const std::size_t rows = row_.size(), columns = weight_.size();
    for (std::size_t i = 0; i < rows; ++i) row_[i] = 0;
    if (base_ == 1) {
      for (std::size_t i = 0; i < rows; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < columns; ++j) sum += c[i * columns + j] * weight_[j];
        row_[i] = sum;
      }
    } else {
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t i = 0; i < rows; ++i) row_[i] += c[j * rows + i] * weight_[j];
    }
    // Weights carry 2m+2 roundings each, the sum m more, the position v two that move it; then one Horner pass.
    const double operations = 4.0 * m_ + 6 + 6.0 * m_ + detail::horner_operations(n_);
    return detail::accumulated_error(form_.f.error(), operations, norm_);
  }

  /// The same by a fresh enclosure on the thin box, then exactly.
  Interval pivot_by_ladder(double s, double error, double wanted_width) const
  {
    const double lo = form_.box.lo[pivot_index()], hi = form_.box.hi[pivot_index()];
    Filter_counts counts;
    const auto& equation = *form_.equation;
    const auto thin = [&](double a, double b) {
      Box<2> box;
      box.lo[base_index()] = box.hi[base_index()] = s;
      box.lo[pivot_index()] = a;
      box.hi[pivot_index()] = b;
      return bounded(face(equation.enclosure(box), base_, false));
    };
    const auto exact = [&] {
      const auto line = face(split(equation.exact(), base_, Rational(s)).first, base_, true);
      return restrict_to(line, 0, Rational(lo), Rational(hi));
    };
    const Univariate f({Bernstein<double, 1>(Degrees<1>{n_}, row_), error}, lo, hi, exact, &counts, thin);
    const Sign low = f.sign(lo), high = f.sign(hi);
    if (low == Sign::zero) return Interval(lo);
    if (high == Sign::zero) return Interval(hi);
    if (low == high) throw std::logic_error("locus: an arc was asked for outside its stretch");
    Isolated_root<double> root{lo, hi, 1, nullptr};
    refine_root(f, root, 1e-15, wanted_width);
    return {root.lo, root.hi};
  }

  Box<2> sub_box(const Interval& pivot_range, double s0, double s1) const
  {
    Box<2> box;
    box.lo[base_index()] = s0;
    box.hi[base_index()] = s1;
    box.lo[pivot_index()] = pivot_range.inf();
    box.hi[pivot_index()] = pivot_range.sup();
    return box;
  }

  using Surface = Enclosed_surface;
  struct Surfaces {
    Surface f, p, b, pp, pb, bb;
  };

  const Surfaces& surfaces() const
  {
    if (!surfaces_) {
      const Bernstein<Bounded, 2> dp = derivative(form_.f, pivot_), db = derivative(form_.f, base_);
      surfaces_ = Surfaces{Surface(form_.f), Surface(dp), Surface(db), Surface(derivative(dp, pivot_)), Surface(derivative(dp, base_)),
                           Surface(derivative(db, base_))};
    }
    return *surfaces_;
  }

  /// Centre and radii of a box in the cell's own unit coordinates, clipped to the cell.
  struct Local {
    std::array<double, 2> centre, radius;
  };

  Local to_local(const Box<2>& box) const
  {
    Local local;
    for (std::size_t v = 0; v < 2; ++v) {
      const double width = form_.box.hi[v] - form_.box.lo[v];
      const double lo = std::min(1.0, std::max(0.0, (box.lo[v] - form_.box.lo[v]) / width));
      const double hi = std::min(1.0, std::max(0.0, (box.hi[v] - form_.box.lo[v]) / width));
      local.centre[v] = std::min(1.0, 0.5 * (lo + hi));
      local.radius[v] = std::max(0.0, 0.5 * (hi - lo)) * (1 + 8 * operation_error);
    }
    return local;
  }

  /// Sign of the equation on the line pivot = `at` over the base values of a box, all in the cell's unit coordinates.
  Sign sign_beside(const Local& box, double at) const
  {
    std::array<double, 2> centre = box.centre, radius = box.radius;
    centre[pivot_index()] = at;
    radius[pivot_index()] = 0;
    return sign_of(surfaces().f.over(centre, radius));
  }

  /// Enclosures of the partial derivatives over a part of the cell; nothing where the pivot's may vanish.
  std::optional<Partials> partials(const Box<2>& box) const
  {
    const Surfaces& d = surfaces();
    const auto [centre, radius] = to_local(box);
    const std::array<double, 2> width{form_.box.width(0), form_.box.width(1)};
    const double wp = width[pivot_index()], wb = width[base_index()];
    const Interval pp = d.pp.over(centre, radius), pb = d.pb.over(centre, radius), bb = d.bb.over(centre, radius);
    const bool first = pivot_ == 0;
    Partials result;
    result.f_pivot = d.p.over(centre, radius, first ? pp : pb, first ? pb : pp) / Interval(wp);
    if (contains_zero(result.f_pivot)) return std::nullopt;
    result.f_base = d.b.over(centre, radius, first ? pb : bb, first ? bb : pb) / Interval(wb);
    result.f_pp = pp / Interval(wp) / Interval(wp);
    result.f_pb = pb / Interval(wp) / Interval(wb);
    result.f_bb = bb / Interval(wb) / Interval(wb);
    return result;
  }

  const Curve_graph::Cell_form& form_;
  int base_, pivot_, n_, m_;
  double norm_;
  mutable std::vector<double> row_, weight_;
  mutable std::optional<Surfaces> surfaces_;
  mutable std::optional<double> cell_slope_;
};

namespace detail {

/// A property with a sign that a piece has all along it, from a strict sign somewhere on it. It need not be one at the piece's
/// ends.
template <class Property>
Sign sign_along(const Curve_graph& graph, std::size_t piece, Property property)
{
  const Graph_piece& p = graph.pieces[piece];
  const auto base = static_cast<std::size_t>(p.base);
  const Interval from = graph.vertices[p.from].at[base], to = graph.vertices[p.to].at[base];
  const Piece_evaluator e(graph.forms[piece], p.base);
  for (const double f : {0.5, 0.25, 0.75, 0.0625, 0.9375}) {
    const double s = from.sup() + f * (to.inf() - from.sup());
    std::array<Interval, 2> at;
    at[base] = Interval(s);
    at[1 - base] = e.pivot_at(s, 0.5 * (midpoint(graph.vertices[p.from].at[1 - base]) + midpoint(graph.vertices[p.to].at[1 - base])));
    if (const Sign sign = property(at); is_strict(sign)) return sign;
  }
  return Sign::unknown;
}

} // namespace detail

} // namespace locus

#endif
