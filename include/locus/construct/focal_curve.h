// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_FOCAL_CURVE_H
#define LOCUS_CONSTRUCT_FOCAL_CURVE_H

#include <locus/construct/derived_curves.h>
#include <locus/construct/rational_path.h>

namespace locus {

/// By what the radius of curvature is differentiated in x + N̄/κ + (1/τ)(1/κ)'B̄, (4.7) of Chen, Riesenfeld & Cohen.
enum class Focal_derivative : unsigned char {
  arc_length, ///< the centre of the osculating sphere: rational, see `focal_curve_map`
  parameter   ///< as the paper derives it: |x'| times as far from the centre of curvature, so not rational unless |x'| is
};

/// (4.7) as a function with certified enclosures. Both readings agree where the curve runs with unit speed; only the one by
/// arc length does not depend on the parametrisation.
class Focal_function {
public:
  explicit Focal_function(const Rational_curve<3>& curve)
  {
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      const Rational_curve<3> piece({curve.pieces()[i]}, chain_of(curve.chain().pieces[i]));
      const Rational_map<3, 1> centres = evolute_map(piece), spheres = focal_curve_map(piece);
      pieces_.push_back({curve.chain().pieces[i], curve.pieces()[i], {}, {}});
      if (centres.pieces().empty() || spheres.pieces().empty()) continue;
      pieces_.back().centre = centres.pieces()[0];
      pieces_.back().sphere = spheres.pieces()[0];
    }
  }

  /// The point at a rational parameter, at a joint by the piece before it: exact but for the square root in |x'| and the last
  /// rounding. Nothing where the curvature or the torsion vanishes, or the curve is infinite or stands still.
  /// Throws Invalid_input outside the domain.
  std::optional<std::array<Range, 3>> at(const Rational& parameter, Focal_derivative by) const
  {
    std::size_t i = 0;
    while (i < pieces_.size() && !pieces_[i].range.contains(parameter)) ++i;
    if (i == pieces_.size())
      throw Invalid_input("", "the curve's domain does not contain " + parameter.get_str(), "ask inside its domain");
    const Piece_forms& p = pieces_[i];
    if (!p.centre) return std::nullopt;
    const Rational u = p.range.local(parameter);
    const auto centre = image(*p.centre, {u}), sphere = image(*p.sphere, {u});
    if (!centre || !sphere) return std::nullopt;
    return with_upward_rounding([&] {
      const Interval speed = by == Focal_derivative::parameter ? speed_at(p, u) : Interval(1);
      return detail::vector_of<3>([&](std::size_t k) {
        const Interval x = enclosing((*centre)[k]) + speed * enclosing(Rational((*sphere)[k] - (*centre)[k]));
        return Range{x.inf(), x.sup()};
      });
    });
  }

private:
  struct Piece_forms {
    Piece range;
    Curve_piece<3> curve;
    std::optional<Rational_map_piece<3, 1>> centre, sphere;
  };

  static Chain chain_of(const Piece& range)
  {
    Chain chain;
    chain.pieces = {range};
    return chain;
  }

  /// |x'| by the curve's parameter, which the local coordinate s follows with ds/du.
  static Interval speed_at(const Piece_forms& p, const Rational& s)
  {
    const auto d = Derivative_vectors<3>(p.curve).d1();
    Rational square = 0;
    for (const auto& f : d) {
      const Rational x = evaluate_at(f, s);
      square += x * x;
    }
    const Rational w = evaluate_at(p.curve.weight, s);
    Rational slope; // ds/du
    if (p.range.hi_infinite) slope = (1 - s) * (1 - s) / p.range.lo;
    else if (p.range.lo_infinite) slope = -s * s / p.range.hi;
    else slope = 1 / (p.range.hi - p.range.lo);
    return CGAL::sqrt(enclosing(square)) * enclosing(Rational(slope / (w * w)));
  }

  std::vector<Piece_forms> pieces_;
};

} // namespace locus

#endif
