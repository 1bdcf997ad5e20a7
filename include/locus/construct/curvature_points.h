// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CURVATURE_POINTS_H
#define LOCUS_CONSTRUCT_CURVATURE_POINTS_H

#include <locus/constraint/curvature_forms.h>
#include <locus/construct/extent.h>
#include <locus/construct/locus.h>
#include <locus/construct/parameter_range.h>
#include <locus/function/root_value.h>
#include <locus/shape/cusps.h>

#include <chrono>

namespace locus {

/// What happens to a curve's curvature, or torsion, at a point.
enum class Curvature_event : unsigned char {
  extremum,     ///< the curvature's derivative vanishes and changes its sign; signs tell a maximum from a minimum
  stationary,   ///< it vanishes there without changing it, or at an end of the curve
  jump,         ///< at a joint the curvature has two values
  kink,         ///< at a joint its derivative has two values; an extremum if their signs differ
  inflection,   ///< the curvature vanishes (in the plane it changes its sign where the slopes' signs tell so)
  torsion_zero, ///< a space curve's torsion vanishes
  cusp          ///< the curve stands still inside a piece, at an irrational parameter
};

constexpr const char* name_of(Curvature_event e)
{
  constexpr const char* names[] = {"extremum", "stationary", "jump", "kink", "inflection", "torsion_zero", "cusp"};
  return names[static_cast<std::size_t>(e)];
}

/// A point of a curve where its curvature is extremal, stationary, not smooth or zero, or its torsion zero; its place is
/// exact (a root of a polynomial, or a joint), the numbers are enclosures.
template <int Dim>
struct Curvature_point {
  Curvature_event kind = Curvature_event::extremum;
  Feature feature = Feature::interior;
  Range parameter;                  ///< encloses it
  int multiplicity = 1;             ///< of the zero, inside a piece
  int before = 0, after = 0;        ///< signs of the form on both sides: the curvature's derivative; for an inflection the curvature, for a torsion zero the torsion
  Approximate_point<Dim> point;
  double error = 0;                 ///< proved bound of the printed point's distance from the exact one
  Range curvature;                  ///< signed in the plane; at a jump that of the left side
  std::optional<Range> torsion;     ///< of a space curve with curvature there
  std::optional<Approximate_point<Dim>> centre; ///< of the osculating circle; none where the curvature vanishes
  double centre_error = 0;
  double radius = 0;                ///< of the osculating circle

  /// The derivative (or curvature, or torsion) changes its sign.
  bool changes_sign() const { return before * after < 0; }
  bool is_maximum() const { return before > 0 && after < 0; }
  bool is_minimum() const { return before < 0 && after > 0; }
};

/// The points of a curve, and what was solved for them.
template <int Dim>
struct Curvature_analysis {
  std::vector<Curvature_point<Dim>> points; ///< in order along the curve
  std::vector<Equation_info> equations;     ///< names and, for each, the greatest degree of a piece
  /// Pieces of which nothing is listed since it holds everywhere: "straight", "constant curvature", "plane".
  std::vector<Degenerate_piece> degenerate;
  double scale = 1;   ///< the curve's diameter (of its control polygon's bounding box)
  double seconds = 0; ///< it took
};

namespace detail {

/// Enclosures of what a piece has at a parameter, in the frame's coordinates.
template <int Dim>
struct Osculation {
  static constexpr auto size = static_cast<std::size_t>(Dim);
  std::array<Interval, size> point, centre;
  Interval curvature, radius;
  std::optional<Interval> torsion;
};

/// Evaluates a piece's forms at places that are known finely.
template <int Dim>
class Curvature_evaluator {
public:
  static constexpr auto size = static_cast<std::size_t>(Dim);
  using Vector = std::array<Interval, size>;

  Curvature_evaluator(const Curve_piece<Dim>& piece, const Curvature_forms<Dim>& forms) : numerator_(piece.numerator), forms_(forms)
  {
    if constexpr (Dim == 3) torsion_ = torsion_form(piece);
  }

  Vector point(const Fine_place& u) const
  {
    const Interval w = value_at(forms_.weight, u);
    return vector_of<size>([&](std::size_t k) { return Interval(value_at(numerator_[k], u) / w); });
  }

  Osculation<Dim> at(const Fine_place& u) const
  {
    Osculation<Dim> o;
    const Interval w = value_at(forms_.weight, u), w3 = w * w * w, s = value_at(forms_.speed, u);
    o.point = point(u);
    const auto d = vector_of<size>([&](std::size_t k) { return value_at(forms_.first[k], u); });
    const auto b = vector_of<Curvature_forms<Dim>::bends>([&](std::size_t k) { return value_at(forms_.bend[k], u); });
    Interval b2(0);
    for (const Interval& x : b) b2 += CGAL::square(x);
    const Interval length = CGAL::sqrt(s), s3 = s * length;
    if constexpr (Dim == 2) {
      // The centre is iD1·S/(β·w³) from the point.
      const Interval reach = s / (b[0] * w3);
      o.curvature = b[0] * w3 / s3;
      o.centre = {o.point[0] - d[1] * reach, o.point[1] + d[0] * reach};
      o.radius = CGAL::abs(Interval(reach * length));
    } else {
      // The centre is (β×D1)·S/(⟨β,β⟩·w³) from the point (4.4).
      const Interval reach = s / (b2 * w3);
      o.curvature = CGAL::sqrt(b2) * w3 / s3;
      for (std::size_t k = 0; k < size; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        o.centre[k] = o.point[k] + (b[i] * d[j] - b[j] * d[i]) * reach;
      }
      o.radius = Interval(1) / o.curvature;
      if (!contains_zero(b2)) o.torsion = w * w * value_at(torsion_, u) / b2;
    }
    return o;
  }

private:
  Polynomial_vector<1, size> numerator_;
  Curvature_forms<Dim> forms_;
  Bernstein<Rational, 1> torsion_;
};

/// Sign of a polynomial next to an end of the unit interval: that of the nearest Bernstein coefficient that is not zero.
inline int sign_beside(const Bernstein<Rational, 1>& f, int end)
{
  const auto& c = f.coefficients();
  for (std::size_t k = 0; k < c.size(); ++k)
    if (const int s = sgn(c[end == 1 ? c.size() - 1 - k : k]); s != 0) return s;
  return 0;
}

/// Whether another polynomial vanishes at a root as well, decided exactly.
inline bool vanishes_at(const Integer_polynomial& f, const Isolated_root<Rational>& root)
{
  if (degree(f) < 1) return f.empty();
  const auto value = [](const Integer_polynomial& g, const Rational& u) { return sgn(evaluate_at(bernstein_form(g).rational(), u)); };
  if (root.is_exact()) return value(f, root.lo) == 0;
  const Integer_polynomial common = gcd(monomial_form(*root.factor), f);
  // A divisor of the square-free factor, which has one simple root between and none at the ends.
  return degree(common) > 0 && value(common, root.lo) != value(common, root.hi);
}

template <int Dim>
class Curvature_search {
public:
  explicit Curvature_search(const Rational_curve<Dim>& curve) : chain_(curve.chain())
  {
    std::vector<Exact_point<Dim>> points;
    collect_control_points(curve, points);
    frame_ = fitting_frame<Dim>(points);
    require_drawable(frame_);
    analysis_.scale = frame_.length(Interval(extent_in<Dim>(frame_, points).scale)).sup();
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      pieces_.push_back(with_unit_forms(in_frame(curve.pieces()[i], frame_)));
      forms_.emplace_back(pieces_.back());
      evaluators_.emplace_back(pieces_.back(), forms_.back());
      ranges_.emplace_back(chain_.pieces[i]);
      standstill_.push_back(standstill_factor(pieces_.back()));
    }
  }

  /// Where the derivative of the curvature vanishes or is not defined.
  void find_critical_points()
  {
    note_degree("critical curvature", [](const Curvature_forms<Dim>& f) { return f.critical.degree(); });
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      find_inside(i, forms_[i].critical, Curvature_event::extremum);
      if (chain_.goes_on_at(i, 1)) compare_at_joint(i, chain_.neighbour(i, 1));
    }
  }

  void find_inflections()
  {
    note_degree("inflections", [](const Curvature_forms<Dim>& f) { return inflection_form(f).degree(); });
    std::vector<Bernstein<Rational, 1>> forms;
    for (const auto& f : forms_) forms.push_back(inflection_form(f));
    for (std::size_t i = 0; i < pieces_.size(); ++i) find_zeros(i, forms, Curvature_event::inflection);
  }

  void find_torsion_zeros()
  {
    std::vector<Bernstein<Rational, 1>> forms;
    for (const auto& piece : pieces_) forms.push_back(torsion_form(piece));
    Equation_info equation{"torsion", {0}};
    for (const auto& f : forms) equation.degrees[0] = std::max(equation.degrees[0], f.degree());
    analysis_.equations.push_back(equation);
    for (std::size_t i = 0; i < pieces_.size(); ++i) find_zeros(i, forms, Curvature_event::torsion_zero);
  }

  void find_cusps()
  {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (degree(standstill_[i]) < 1) continue;
      for (auto root : exact_roots(bernstein_form(standstill_[i]), Rational(0), Rational(1)).roots) {
        if (root.is_exact() && (root.lo == 0 || root.lo == 1)) continue; // a joint's or an end's
        refine_root(root, 80);
        Curvature_point<Dim> p;
        p.kind = Curvature_event::cusp;
        p.multiplicity = root.multiplicity;
        place_point(i, fine_place(root), p, evaluators_[i].point(fine_place(root)));
        add(i, root.lo, p);
      }
    }
  }

  /// Pieces of which a form vanishes everywhere.
  void note_degenerate_pieces()
  {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const bool straight = is_zero(forms_[i].bend), constant = detail::is_zero(forms_[i].critical);
      if (straight) note(i, "straight", "the curvature vanishes all along");
      else if (constant) note(i, "constant curvature", "every point is critical: an arc of a circle");
      if constexpr (Dim == 3)
        if (!straight && detail::is_zero(torsion_form(pieces_[i]))) note(i, "plane", "the torsion vanishes all along");
    }
  }

  Curvature_analysis<Dim> result()
  {
    std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      return a.piece != b.piece ? a.piece < b.piece : a.at < b.at;
    });
    for (Found& f : found_) analysis_.points.push_back(std::move(f.point));
    return std::move(analysis_);
  }

private:
  using Exact = typename Curvature_forms<Dim>::Exact_curvature;
  struct Found {
    std::size_t piece;
    Rational at;
    Curvature_point<Dim> point;
  };

  void add(std::size_t piece, const Rational& at, const Curvature_point<Dim>& p) { found_.push_back({piece, at, p}); }

  void note(std::size_t i, const char* kind, const char* reason)
  {
    Degenerate_piece d;
    d.kind = kind;
    d.input = 0;
    d.box = {{ranges_[i].at(Interval(0)).lo, ranges_[i].at(Interval(1)).hi}};
    d.reason = reason;
    analysis_.degenerate.push_back(d);
  }

  template <class Degree>
  void note_degree(const char* name, Degree degree)
  {
    Equation_info equation{name, {0}};
    for (const auto& f : forms_) equation.degrees[0] = std::max(equation.degrees[0], degree(f));
    analysis_.equations.push_back(equation);
  }

  /// Vanishes with the curvature: the Wronskian, or what the three minors have in common.
  static Bernstein<Rational, 1> inflection_form(const Curvature_forms<Dim>& f)
  {
    if constexpr (Dim == 2) {
      return f.bend[0];
    } else {
      if (is_zero(f.bend)) return Bernstein<Rational, 1>(Degrees<1>{0});
      return bernstein_form(common_factor(f.bend)).rational();
    }
  }

  /// The curve has no velocity at the end of a piece, or is infinite there.
  bool is_singular_at(std::size_t i, int end) const
  {
    const auto vanishes = [end](const Bernstein<Rational, 1>& f) { return f[end == 0 ? 0 : f.size() - 1] == 0; };
    return vanishes(forms_[i].weight) || vanishes(forms_[i].speed);
  }

  /// Zeros of a form inside a piece, and at an open end of the curve; those where the curve stands still are cusps.
  void find_inside(std::size_t i, const Bernstein<Rational, 1>& form, Curvature_event kind)
  {
    const Bernstein<Scaled_integer, 1> f(form);
    if (f.is_zero()) return;
    auto set = exact_roots(f, Rational(0), Rational(1));
    for (std::size_t k = 0; k < set.roots.size(); ++k) {
      auto& root = set.roots[k];
      const bool at_end = root.is_exact() && (root.lo == 0 || root.lo == 1);
      const int end = root.lo == 1 ? 1 : 0;
      if (at_end && (chain_.joint_at(i, end) || is_singular_at(i, end))) continue;
      if (!at_end && vanishes_at(standstill_[i], root)) continue;
      refine_root(root, 80);
      Curvature_point<Dim> p;
      p.kind = kind;
      p.multiplicity = root.multiplicity;
      if (!at_end || end == 1) p.before = sign_before(set, k);
      if (!at_end || end == 0) p.after = k + 1 < set.gaps.size() ? to_int(set.gaps[k + 1]) : 0;
      if (at_end) p.feature = end == 0 ? Feature::start : Feature::end;
      if (has_no_sign(kind)) p.before = p.after = 0;
      if (kind == Curvature_event::extremum && !p.changes_sign()) p.kind = Curvature_event::stationary;
      place(i, fine_place(root), p);
      add(i, root.lo, p);
    }
  }

  /// A space curve's curvature is never negative.
  static bool has_no_sign(Curvature_event kind) { return Dim == 3 && kind == Curvature_event::inflection; }

  static int to_int(Sign s) { return s == Sign::positive ? 1 : s == Sign::negative ? -1 : 0; }
  static int sign_before(const Root_set<Rational>& set, std::size_t k) { return to_int(set.gaps[k]); }

  /// The same for a form that is to be followed across joints.
  void find_zeros(std::size_t i, const std::vector<Bernstein<Rational, 1>>& forms, Curvature_event kind)
  {
    find_inside(i, forms[i], kind);
    if (!chain_.goes_on_at(i, 1)) return;
    const std::size_t next = chain_.neighbour(i, 1);
    if (is_singular_at(i, 1) || is_singular_at(next, 0)) return;
    const auto &f = forms[i], &g = forms[next];
    const int before = sign_beside(f, 1), after = sign_beside(g, 0);
    const bool stays = before == 0 || after == 0; // all of a piece is straight, or plane
    const bool vanishes = f[f.size() - 1] == 0 || g[0] == 0;
    if (stays || (before == after && !vanishes)) return;
    if (Dim == 3 && kind == Curvature_event::inflection && !vanishes) return; // of a common factor only zeros mean anything
    Curvature_point<Dim> p;
    p.kind = kind;
    p.before = has_no_sign(kind) ? 0 : before;
    p.after = has_no_sign(kind) ? 0 : after;
    place(i, Fine_place{1}, p);
    add(i, Rational(1), p);
  }

  /// Joints where the normal turns continuously: compared exactly from both sides. Where both derivatives vanish the
  /// curvature is stationary there, unless the curve is a circle or a line on both sides.
  void compare_at_joint(std::size_t i, std::size_t next)
  {
    if (is_singular_at(i, 1) || is_singular_at(next, 0)) return;
    const Exact left = forms_[i].at(1), right = forms_[next].at(0);
    const bool jumps = !left.same_curvature(right);
    Curvature_point<Dim> p;
    p.before = sign_beside(forms_[i].critical, 1);
    p.after = sign_beside(forms_[next].critical, 0);
    const bool stands = left.slope_sign == 0 && (p.before != 0 || p.after != 0);
    if (!jumps && left.same_slope(right) && !stands) return;
    p.kind = jumps                                ? Curvature_event::jump
             : !(stands && left.same_slope(right)) ? Curvature_event::kink
             : p.changes_sign()                    ? Curvature_event::extremum
                                                   : Curvature_event::stationary;
    place(i, Fine_place{1}, p);
    add(i, Rational(1), p);
  }

  void place_point(std::size_t i, const Fine_place& u, Curvature_point<Dim>& p, const std::array<Interval, static_cast<std::size_t>(Dim)>& x) const
  {
    p.parameter = ranges_[i].at(u.enclosure());
    p.error = put(x, p.point);
  }

  void place(std::size_t i, const Fine_place& u, Curvature_point<Dim>& p) const
  {
    const Osculation<Dim> o = evaluators_[i].at(u);
    place_point(i, u, p, o.point);
    const Interval curvature = Interval(1) / frame_.length(Interval(1)) * o.curvature;
    p.curvature = {curvature.inf(), curvature.sup()};
    if (o.torsion) {
      const Interval torsion = Interval(1) / frame_.length(Interval(1)) * *o.torsion;
      p.torsion = Range{torsion.inf(), torsion.sup()};
    }
    if (p.kind == Curvature_event::inflection) return;
    Approximate_point<Dim> centre;
    const double error = put(o.centre, centre);
    if (!std::isfinite(error)) return;
    p.centre = centre;
    p.centre_error = error;
    p.radius = representative(frame_.length(o.radius));
  }

  /// Writes an enclosed point in the inputs' coordinates; returns a bound of its distance from the exact one.
  double put(const std::array<Interval, static_cast<std::size_t>(Dim)>& x, Approximate_point<Dim>& p) const
  {
    Interval square(0);
    double size = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      square += CGAL::square(Interval(0, width(x[k])));
      p[k] = representative(frame_.out_of(x[k], k));
      size += std::abs(p[k]);
    }
    const Interval distance = CGAL::sqrt(square);
    const double error = std::isfinite(distance.sup()) ? frame_.length(distance).sup() : distance.sup();
    return std::isfinite(error) ? error + 8 * operation_error * size : error;
  }

  Frame<Dim> frame_;
  Chain chain_;
  std::vector<Curve_piece<Dim>> pieces_;
  std::vector<Curvature_forms<Dim>> forms_;
  std::vector<Curvature_evaluator<Dim>> evaluators_;
  std::vector<Parameter_range> ranges_;
  std::vector<Integer_polynomial> standstill_;
  std::vector<Found> found_;
  Curvature_analysis<Dim> analysis_;
};

} // namespace detail

/// The points of a curve where its curvature is extremal, stationary, or not smooth, in order along the curve; corners are
/// left out. Inside pieces roots of `Curvature_forms::critical`, isolated exactly; joints are compared exactly from both
/// sides. O(d²) rational operations for a piece of degree d, and the isolation.
template <int Dim>
std::vector<Curvature_point<Dim>> curvature_points(const Rational_curve<Dim>& curve)
{
  return with_upward_rounding([&] {
    detail::Curvature_search<Dim> search(curve);
    search.find_critical_points();
    return search.result().points;
  });
}

/// The points where the curvature vanishes, in order: zeros of the Wronskian of X, Y, W (degree 3d-6; 2d-4 for a polynomial
/// curve) in the plane, where it changes its sign at those with odd multiplicity, and at joints where it jumps across zero; corners are left out. In
/// space the curvature vanishes only by accident.
template <int Dim>
std::vector<Curvature_point<Dim>> inflections(const Rational_curve<Dim>& curve)
{
  return with_upward_rounding([&] {
    detail::Curvature_search<Dim> search(curve);
    search.find_inflections();
    return search.result().points;
  });
}

/// The points where a space curve's torsion vanishes, or changes its sign at a joint, in order: zeros of `torsion_form`.
inline std::vector<Curvature_point<3>> torsion_zeros(const Rational_curve<3>& curve)
{
  return with_upward_rounding([&] {
    detail::Curvature_search<3> search(curve);
    search.find_torsion_zeros();
    return search.result().points;
  });
}

/// All of these together, and the cusps inside pieces.
template <int Dim>
Curvature_analysis<Dim> analyse_curvature(const Rational_curve<Dim>& curve)
{
  const auto start = std::chrono::steady_clock::now();
  Curvature_analysis<Dim> analysis = with_upward_rounding([&] {
    detail::Curvature_search<Dim> search(curve);
    search.find_critical_points();
    search.find_inflections();
    if constexpr (Dim == 3) search.find_torsion_zeros();
    search.find_cusps();
    search.note_degenerate_pieces();
    return search.result();
  });
  analysis.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return analysis;
}

/// The circle that touches a curve to the second order, exactly.
template <int Dim>
struct Osculating_circle {
  Exact_point<Dim> point, centre;
  Rational squared_radius;
  int side = 1; ///< in the plane: 1 where the curve turns left, -1 right
};

/// The osculating circle at a rational parameter; at a joint that of the piece before it. Nothing where the curvature
/// vanishes, the curve stands still, or is infinite. Throws Invalid_input outside the domain.
template <int Dim>
std::optional<Osculating_circle<Dim>> osculating_circle(const Rational_curve<Dim>& curve, const Rational& parameter)
{
  const auto& ranges = curve.chain().pieces;
  std::size_t i = 0;
  while (i < ranges.size() && !ranges[i].contains(parameter)) ++i;
  if (i == ranges.size())
    throw Invalid_input("", "the curve's domain does not contain " + parameter.get_str(), "ask inside its domain");
  const Curve_piece<Dim>& piece = curve.pieces()[i];
  const Curvature_forms<Dim> forms(piece);
  const Rational u = ranges[i].local(parameter), w = evaluate_at(forms.weight, u), s = evaluate_at(forms.speed, u);
  const auto values = [&](const auto& vector) {
    return detail::vector_of<std::tuple_size_v<std::decay_t<decltype(vector)>>>([&](std::size_t k) { return Rational(evaluate_at(vector[k], u)); });
  };
  const auto d = values(forms.first), x = values(piece.numerator);
  const auto b = values(forms.bend);
  Rational b2 = 0;
  for (const Rational& f : b) b2 += f * f;
  if (w == 0 || s == 0 || b2 == 0) return std::nullopt;
  Osculating_circle<Dim> circle;
  for (std::size_t k = 0; k < x.size(); ++k) {
    circle.point[k] = x[k] / w;
    const std::size_t i1 = (k + 1) % 3, i2 = (k + 2) % 3;
    Rational across;
    if constexpr (Dim == 2) across = k == 0 ? Rational(-b[0] * d[1]) : Rational(b[0] * d[0]);
    else across = b[i1] * d[i2] - b[i2] * d[i1];
    circle.centre[k] = circle.point[k] + across * s / (b2 * w * w * w);
  }
  circle.squared_radius = s * s * s / (b2 * w * w * w * w * w * w);
  circle.side = Dim == 2 ? sgn(b[0]) * sgn(w) : 1;
  return circle;
}

} // namespace locus

#endif
