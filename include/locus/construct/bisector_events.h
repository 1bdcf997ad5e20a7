// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_BISECTOR_EVENTS_H
#define LOCUS_CONSTRUCT_BISECTOR_EVENTS_H

#include <locus/constraint/point_curve.h>
#include <locus/construct/locus.h>
#include <locus/construct/parameter_range.h>
#include <locus/function/rational_root.h>
#include <locus/function/root_value.h>
#include <locus/shape/constructors_2.h>

namespace locus {

/// What happens to the untrimmed bisector of a point p and a curve at a single parameter (section 2.3 and Definition 3.3 of
/// Farouki & Johnstone 1994). A place can be several of these.
enum class Bisector_event_kind : unsigned char {
  class_point,     ///< the tangent passes through p: the bisector goes to infinity, or, at an even multiplicity, touches it
  cusp,            ///< circular point of multiplicity 1: the circle of curvature passes through p, the bisector's tangent reverses
  extraordinary,   ///< of multiplicity 2: the tangent goes on, the curvature is infinite
  higher_cusp,     ///< of multiplicity 3 or more: κ', …, κ^(multiplicity-1) vanish as well
  inflection,      ///< the curve's curvature vanishes; the bisector is regular there
  on_curve         ///< the curve passes through p
};

constexpr const char* name_of(Bisector_event_kind k)
{
  constexpr const char* names[] = {"class_point", "cusp", "extraordinary", "higher_cusp", "inflection", "on_curve"};
  return names[static_cast<std::size_t>(k)];
}

struct Bisector_event {
  Bisector_event_kind kind = Bisector_event_kind::class_point;
  std::size_t piece = 0;
  Isolated_root<Rational> place; ///< on the piece's unit interval; its `multiplicity` is that of the polynomial's root
  Range parameter;
};

/// A part of a piece between events: *active* where circles about bisector points through p do not meet the curve beside the
/// point that they touch (Theorem 3.1), i.e. 1 + κd > 0. Only active parts can belong to the true bisector.
struct Bisector_segment {
  std::size_t piece = 0;
  Isolated_root<Rational> from, to; ///< events, or the piece's ends
  Range parameters;                 ///< enclosing both ends
  bool active = false;
};

struct Bisector_events {
  std::vector<Bisector_event> events;     ///< in the order of the parameter
  std::vector<Bisector_segment> segments; ///< likewise; none of pieces that all circles touch in one centre or at infinity
};

namespace detail {

/// The events of one piece: roots of [ρ ρ'], of det(ℓ, ℓ', ℓ''), of the Wronskian of X, Y, W and of |ρ|², isolated together.
class Bisector_event_finder {
public:
  Bisector_event_finder(std::size_t index, const Curve_piece<2>& piece, const Piece& range, const Exact_point<2>& point)
    : index_(index), range_(range), forms_(piece, point)
  {
    // At the point itself all of these vanish: it is an event of its own.
    const Integer_polynomial passes = common_factor(forms_.offset());
    const Form bend = wronskian(Polynomial_vector<1, 3>{piece.numerator[0], piece.numerator[1], at_true_degree(piece.weight)});
    add(Bisector_event_kind::on_curve, degree(passes) > 0 ? bernstein_form(passes).rational() : Form(Degrees<1>{0}, {Rational(1)}));
    add(Bisector_event_kind::class_point, without_factor(forms_.class_form(), passes));
    add(Bisector_event_kind::cusp, without_factor(forms_.circular_form(), passes));
    add(Bisector_event_kind::inflection, bend);
  }

  void collect(Bisector_events& found)
  {
    Integer_polynomial all{Integer(1)};
    for (const Source& s : sources_)
      if (degree(s.polynomial) > 0) all = multiply(all, s.polynomial);
    std::vector<Isolated_root<Rational>> places;
    if (degree(all) > 0) places = exact_roots(bernstein_form(all), Rational(0), Rational(1)).roots;
    for (auto& place : places) {
      refine_root(place, 60);
      if (is_pole(place)) continue;
      for (const Source& s : sources_)
        if (const int times = multiplicity_at(s.polynomial, place)) found.events.push_back(event(s.kind, times, place));
    }
    if (!is_zero(forms_.class_form()) && !is_zero(forms_.circular_form())) collect_segments(places, found);
  }

private:
  using Form = Bernstein<Rational, 1>;

  struct Source {
    Bisector_event_kind kind;
    Integer_polynomial polynomial; ///< none where it is identically zero
  };

  void add(Bisector_event_kind kind, const Form& f) { sources_.push_back({kind, is_zero(f) ? Integer_polynomial{} : monomial_form(Bernstein<Scaled_integer, 1>(f))}); }

  static Form without_factor(Form f, const Integer_polynomial& factor)
  {
    if (degree(factor) < 1 || is_zero(f)) return f;
    Integer_polynomial p = monomial_form(Bernstein<Scaled_integer, 1>(f));
    for (;;) {
      const Integer_polynomial common = gcd(p, factor);
      if (degree(common) < 1) return bernstein_form(p).rational();
      p = exact_quotient(p, common);
    }
  }

  /// Poles of the curve are at ends of pieces; nothing is said of the point at infinity.
  bool is_pole(const Isolated_root<Rational>& place) const { return place.is_exact() && evaluate_at(forms_.weight(), place.lo) == 0; }

  static int multiplicity_at(const Integer_polynomial& f, const Isolated_root<Rational>& place)
  {
    if (degree(f) < 1) return 0;
    for (const Square_free_factor& factor : square_free_decomposition(f)) {
      if (degree(factor.factor) < 1) continue;
      const auto form = bernstein_form(factor.factor);
      const Sign lo = sign_at(form, place.lo);
      // The interval holds at most one root of the product of all, and its ends are none.
      if (place.is_exact() ? lo == Sign::zero : lo != sign_at(form, place.hi)) return factor.multiplicity;
    }
    return 0;
  }

  Bisector_event event(Bisector_event_kind kind, int times, const Isolated_root<Rational>& place) const
  {
    Bisector_event e;
    e.kind = kind != Bisector_event_kind::cusp || times == 1 ? kind
             : times == 2                                    ? Bisector_event_kind::extraordinary
                                                             : Bisector_event_kind::higher_cusp;
    e.piece = index_;
    e.place = place;
    e.place.multiplicity = times;
    e.parameter = range_.at(hull(enclosing(place.lo), enclosing(place.hi)));
    return e;
  }

  void collect_segments(const std::vector<Isolated_root<Rational>>& places, Bisector_events& found) const
  {
    std::vector<Isolated_root<Rational>> ends;
    const auto exactly = [](int x) { return Isolated_root<Rational>{Rational(x), Rational(x), 1, nullptr}; };
    if (places.empty() || places.front().hi != 0) ends.push_back(exactly(0));
    ends.insert(ends.end(), places.begin(), places.end());
    if (places.empty() || places.back().lo != 1) ends.push_back(exactly(1));
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const Rational middle = (ends[k].hi + ends[k + 1].lo) / 2;
      Bisector_segment s{index_, ends[k], ends[k + 1], {}, false};
      s.parameters = range_.at(hull(enclosing(ends[k].lo), enclosing(ends[k + 1].hi)));
      s.active = sgn(evaluate_at(forms_.class_form(), middle)) * sgn(evaluate_at(forms_.circular_form(), middle)) > 0;
      found.segments.push_back(std::move(s));
    }
  }

  std::size_t index_;
  Parameter_range range_;
  Point_curve_forms forms_;
  std::vector<Source> sources_;
};

} // namespace detail

/// Class points, circular points and inflections of a curve with respect to a point, as certified roots with multiplicities, and
/// the active and inactive segments that they delimit (Theorem 3.1). The polynomials are free of the redundant factor w of (37)
/// and (59), so a curve's own poles are none of them. Inflections never change the activity; they are listed since the paper
/// cuts there. At joints of pieces an event can appear on both sides.
/// Cost: isolating the roots of polynomials of degree 2n-2, 6n-6 and 3n-6 in rationals, for each piece of degree n.
inline Bisector_events bisector_events(const Coordinates_2& point, const Curve_2& curve)
{
  return with_upward_rounding([&] {
    Bisector_events found;
    for (std::size_t i = 0; i < curve.pieces().size(); ++i)
      detail::Bisector_event_finder(i, curve.pieces()[i], curve.chain().pieces[i], point.exact()).collect(found);
    return found;
  });
}

namespace detail {

/// Writes the events into a result; the curve is that input.
inline void note_events(const Bisector_events& found, std::size_t input, Locus_data<2>& data)
{
  for (const Bisector_event& e : found.events) data.events.push_back({name_of(e.kind), input, e.parameter, e.place.multiplicity});
  for (const Bisector_segment& s : found.segments) data.segments.push_back({input, s.parameters, s.active});
}

} // namespace detail

} // namespace locus

#endif
