// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PATH_ENDS_H
#define LOCUS_CONSTRUCT_PATH_ENDS_H

#include <locus/construct/rational_path.h>
#include <locus/function/root_value.h>

namespace locus {
namespace detail {

/// How arcs of derived rational curves end: at points, and towards infinity, where they are cut at the cut radius.
template <int Dim>
class Path_ends {
public:
  static constexpr auto size = static_cast<std::size_t>(Dim);

  explicit Path_ends(const Path_work<Dim>& work) : work_(work) {}

  /// |p - c·w|² - R²·w², positive where the curve is outside the cut radius, from what is enclosed of it.
  Bernstein<Interval, 1> enclosed_outside_form(std::size_t i) const
  {
    const auto& piece = work_.pieces[i];
    Bernstein<Interval, 1> sum = multiply(multiply(piece.weight, piece.weight), -CGAL::square(Interval(work_.cut_radius)));
    for (const auto& x : piece.numerator) sum = add(sum, multiply(x, x));
    return sum;
  }

  /// The same exactly: near two poles it is tiny.
  Bernstein<Rational, 1> outside_form(const Curve_piece<Dim>& p) const
  {
    using namespace operators;
    const Rational r(work_.cut_radius);
    Bernstein<Rational, 1> sum = multiply(p.weight * p.weight, Rational(-r * r));
    for (std::size_t k = 0; k < size; ++k) {
      const Bernstein<Rational, 1> x = subtract(p.numerator[k], multiply(p.weight, Rational(work_.centre[k])));
      sum = sum + x * x;
    }
    return sum;
  }

  /// A place beyond which all is outside, up to the pole: the farthest one from the pole of those tried, at distances that halve.
  /// Near the pole all is outside; but nothing where no double is near enough.
  template <class T>
  static std::optional<double> stop_towards(const Bernstein<T, 1>& outside, const Isolated_root<Rational>& pole, const Rational& far, const Rational& near)
  {
    constexpr int most_halvings = 60;
    const bool before = far < near;
    std::optional<double> found;
    const auto try_at = [&](const Rational& gap) {
      const double at = nearest_double(Rational(near - gap));
      const Rational place(at);
      if (place <= std::min(near, far) || place >= std::max(near, far)) return false;
      if (!is_positive_on(outside, before ? place : pole.lo, before ? pole.hi : place)) return false;
      found = at;
      return true;
    };
    const Rational whole = near - far;
    Rational gap = whole / 2;
    for (int i = 0; i < most_halvings && !try_at(gap); ++i) gap /= 2;
    if (!found || gap != whole / 2) return found;
    Rational rest = whole / 4; // the other half may be outside as well, as where the parameter's middle is far away
    for (int i = 0; i < most_halvings && try_at(Rational(whole - rest)); ++i) rest /= 2;
    return found;
  }

  /// A vertex where the weight has an isolated zero, narrowed to some 120 bits: with direction and, at a simple zero, asymptote,
  /// where they are known well.
  Locus_vertex<Dim> infinite_vertex(const Curve_piece<Dim>& p, const Isolated_root<Rational>& pole) const
  {
    const Fine_place s = fine_place(pole);
    Locus_vertex<Dim> v;
    v.kind = Vertex_kind::infinity;
    v.multiplicity = pole.multiplicity;
    const auto values = [&](const Polynomial_vector<1, size>& forms) {
      return vector_of<size>([&](std::size_t k) { return value_at(forms[k], s); });
    };
    const auto n = values(p.numerator);
    Interval square(0);
    double widest = 0;
    for (const Interval& x : n) {
      square += CGAL::square(x);
      widest = std::max(widest, width(x));
    }
    const double length = midpoint(CGAL::sqrt(square));
    if (widest <= 1e-9 * length) { // else the direction is not known
      Approximate_point<Dim> direction;
      for (std::size_t k = 0; k < size; ++k) direction[k] = representative(n[k]) / length;
      v.direction = direction;
      if (pole.multiplicity == 1) v.asymptote = asymptote_at(p, s, n, values(derivative(p.numerator)), direction);
    }
    return v;
  }

  /// The point at a rational place, exact but for the last rounding, with its distance from the foot.
  void place_exactly(std::size_t i, const Rational& s, Locus_vertex<Dim>& v) const
  {
    const auto& w = work_.pieces[i];
    const Rational weight = evaluate_at(w.forms.get().weight, s), foot_weight = evaluate_at(w.foot_forms.get().weight, s);
    Rational square = 0;
    Approximate_point<Dim> point;
    for (std::size_t k = 0; k < size; ++k) {
      const Rational x = evaluate_at(w.forms.get().numerator[k], s) / weight;
      point[k] = representative(work_.frame.out_of(enclosing(x), k));
      if (foot_weight == 0) continue;
      const Rational d = x - evaluate_at(w.foot_forms.get().numerator[k], s) / foot_weight;
      square += d * d;
    }
    v.point = point;
    v.radius = foot_weight == 0 ? std::numeric_limits<double>::infinity() : midpoint(work_.frame.length(CGAL::sqrt(enclosing(square))));
  }

private:
  using Point = std::array<Interval, size>;

  static bool is_positive_on(const Bernstein<Rational, 1>& f, const Rational& lo, const Rational& hi)
  {
    const auto part = restrict_to(f, 0, lo, hi);
    return std::all_of(part.coefficients().begin(), part.coefficients().end(), [](const Rational& c) { return c > 0; });
  }

  static bool is_positive_on(const Bernstein<Interval, 1>& f, const Rational& lo, const Rational& hi)
  {
    const auto part = restrict_to(f, 0, Interval(std::max(0.0, enclosing(lo).inf())), Interval(std::min(1.0, enclosing(hi).sup())));
    return std::all_of(part.coefficients().begin(), part.coefficients().end(), [](const Interval& c) { return c.inf() > 0; });
  }

  /// x = N/w = N(s₀)/(w'·δ) + N'/w' - N·w''/(2w'²) + …; nothing where that is not known well.
  std::optional<Asymptote<Dim>> asymptote_at(const Curve_piece<Dim>& p, const Fine_place& s, const Point& n, const Point& dn,
                                             const Approximate_point<Dim>& direction) const
  {
    const Bernstein<Rational, 1> slope = derivative(p.weight);
    const Interval dw = value_at(slope, s), ddw = value_at(derivative(slope), s);
    Asymptote<Dim> asymptote;
    asymptote.direction = direction;
    for (std::size_t k = 0; k < size; ++k) {
      const Interval x = dn[k] / dw - n[k] * ddw / (Interval(2) * dw * dw);
      if (!(width(x) <= 1e-9 * std::max(work_.scale, magnitude(x)))) return std::nullopt;
      asymptote.point[k] = representative(work_.frame.out_of(x, k));
    }
    return asymptote;
  }

  const Path_work<Dim>& work_;
};

} // namespace detail
} // namespace locus

#endif
