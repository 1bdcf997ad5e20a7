// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_SVG_CURVE_H
#define LOCUS_IO_SVG_CURVE_H

#include <locus/io/svg_elements.h>
#include <locus/number/interval.h>
#include <locus/shape/rational_curve.h>

namespace locus {

namespace detail {

/// Homogeneous coordinates as Bernstein forms in plain doubles, relative to the middle of the picture.
struct Pictured_forms {
  std::array<std::vector<double>, 2> numerator;
  std::vector<double> weight;

  Pictured_forms() = default;
  Pictured_forms(const std::array<Bernstein<Rational, 1>, 2>& exact_numerator, const Bernstein<Rational, 1>& exact_weight,
                 const std::array<Rational, 2>& origin)
  {
    Rational largest = 0;
    for (const Rational& w : exact_weight.coefficients()) largest = std::max(largest, Rational(abs(w)));
    for (const Rational& w : exact_weight.coefficients()) weight.push_back(nearest_double(w / largest));
    for (std::size_t v = 0; v < 2; ++v) {
      const Bernstein<Rational, 1> x = subtract(exact_numerator[v], multiply(exact_weight, origin[v]));
      for (const Rational& c : x.coefficients()) numerator[v].push_back(nearest_double(c / largest));
    }
  }

  double weight_at(double s) const { return casteljau(weight, s); }
  Picture_point at(double s) const
  {
    const double w = weight_at(s);
    return {casteljau(numerator[0], s) / w, casteljau(numerator[1], s) / w};
  }

private:
  static double casteljau(std::vector<double> c, double s)
  {
    for (std::size_t n = c.size(); n > 1; --n)
      for (std::size_t i = 0; i + 1 < n; ++i) c[i] += s * (c[i + 1] - c[i]);
    return c[0];
  }
};

/// An input curve in plain doubles, relative to the middle of the picture; good for pictures only. A *place* on it is the
/// index of a piece plus the local coordinate on it, so that infinite parameters are places like others.
class Pictured_curve {
public:
  Pictured_curve(const Curve_2& curve, const std::array<Rational, 2>& origin) : joints_(curve.chain().joints)
  {
    for (std::size_t k = 0; k < curve.pieces().size(); ++k)
      spans_.push_back(span_of(curve.pieces()[k], curve.chain().pieces[k], origin));
  }

  double size() const { return static_cast<double>(spans_.size()); }
  bool is_closed() const { return joints_.size() == spans_.size(); }
  bool is_finite() const { return !std::isinf(start()) && !std::isinf(finish()); }
  double start() const { return spans_.front().lo; }
  double finish() const { return spans_.back().hi; }
  const std::vector<Joint>& joints() const { return joints_; }

  /// The parameter where piece k starts, or the chain ends.
  double knot(std::size_t k) const { return k < spans_.size() ? spans_[k].lo : finish(); }

  double place(double u) const
  {
    std::size_t k = 0;
    while (k + 1 < spans_.size() && u > spans_[k].hi) ++k;
    return static_cast<double>(k) + spans_[k].local(u);
  }

  Picture_point at_place(double x) const
  {
    const auto k = static_cast<std::size_t>(std::min(size() - 1, std::max(0.0, std::floor(x))));
    return spans_[k].at(x - static_cast<double>(k));
  }
  Picture_point at(double u) const { return at_place(place(u)); }

  /// Points from one parameter to another one.
  std::vector<Picture_point> between(double u, double v) const
  {
    constexpr int steps = 64;
    const double from = place(u), length = place(v) - from;
    std::vector<Picture_point> out;
    for (int i = 0; i <= steps; ++i) out.push_back(at_place(from + length * i / steps));
    return out;
  }

  /// Is the curve's point infinite at an end of piece k?
  bool is_pole(std::size_t k, bool finish) const { return finish ? spans_[k].pole_at_hi : spans_[k].pole_at_lo; }

  /// Points along the curve, close together near infinity; one list for each part between poles.
  std::vector<std::vector<Picture_point>> parts() const
  {
    std::vector<std::vector<Picture_point>> out;
    for (std::size_t k = 0; k < spans_.size(); ++k) {
      if (k == 0 || spans_[k].pole_at_lo) out.emplace_back();
      for (const double s : samples(spans_[k], out.back().empty())) out.back().push_back(spans_[k].at(s));
    }
    return out;
  }

  /// What of the curve should be seen: all of it, but only a part of pieces that go to infinity; `least`: none of those if
  /// there are others.
  std::vector<Picture_point> essential_points(bool least = false) const
  {
    std::vector<Picture_point> out;
    const bool some_finite = std::any_of(spans_.begin(), spans_.end(), [](const Span& s) { return s.is_finite(); });
    for (const Span& span : spans_) {
      if (least && some_finite && !span.is_finite()) continue;
      const bool both = span.pole_at_lo && span.pole_at_hi;
      const double margin = both ? 0.25 : 0.5;
      const double lo = span.pole_at_lo ? margin : 0, hi = span.pole_at_hi ? 1 - margin : 1;
      for (int i = 0; i <= 64; ++i) out.push_back(span.at(lo + (hi - lo) * i / 64));
    }
    return out;
  }

private:
  struct Span {
    double lo = 0, hi = 1;
    bool pole_at_lo = false, pole_at_hi = false;
    Pictured_forms forms;

    bool is_finite() const { return !pole_at_lo && !pole_at_hi; }
    double local(double u) const
    {
      double s = 0;
      if (std::isinf(hi)) s = std::isinf(u) ? 1 : 1 - lo / u;
      else if (std::isinf(lo)) s = std::isinf(u) ? 0 : hi / u;
      else s = (u - lo) / (hi - lo);
      return std::min(1.0, std::max(0.0, s));
    }
    Picture_point at(double s) const { return forms.at(s); }
  };

  static Span span_of(const Curve_piece<2>& piece, const Piece& range, const std::array<Rational, 2>& origin)
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Span span;
    span.lo = range.lo_infinite ? -infinite : nearest_double(range.lo);
    span.hi = range.hi_infinite ? infinite : nearest_double(range.hi);
    const std::vector<Rational>& weight = piece.weight.coefficients();
    span.pole_at_lo = weight.front() == 0;
    span.pole_at_hi = weight.back() == 0;
    span.forms = Pictured_forms(piece.numerator, piece.weight, origin);
    return span;
  }

  /// Local coordinates: evenly, and towards a pole in ever smaller steps. The start only where no piece ended there.
  std::vector<double> samples(const Span& span, bool with_start) const
  {
    const int steps = std::min(160, std::max(24, 640 / static_cast<int>(spans_.size())));
    constexpr int octaves = 40, per_octave = 4;
    std::vector<double> out;
    const auto graded = [&](int j) { return std::exp2(-static_cast<double>(j) / per_octave) / steps; };
    if (span.pole_at_lo)
      for (int j = octaves * per_octave; j > 0; --j) out.push_back(graded(j));
    for (int i = with_start && !span.pole_at_lo ? 0 : 1; i < steps; ++i) out.push_back(static_cast<double>(i) / steps);
    if (span.pole_at_hi)
      for (int j = 1; j <= octaves * per_octave; ++j) out.push_back(1 - graded(j));
    else out.push_back(1);
    return out;
  }

  std::vector<Span> spans_;
  std::vector<Joint> joints_;
};

} // namespace detail

} // namespace locus

#endif
