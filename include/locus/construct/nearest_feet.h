// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_NEAREST_FEET_H
#define LOCUS_CONSTRUCT_NEAREST_FEET_H

#include <locus/constraint/foot_form.h>
#include <locus/constraint/point_curve.h>
#include <locus/construct/curvature_points.h>
#include <locus/function/resultant.h>
#include <locus/zero_set/algebraic_number.h>
#include <locus/zero_set/least_sign.h>
#include <locus/zero_set/real_roots.h>

namespace locus {

/// A point of a curve at which the distance from a point q is stationary, or where the curve ends or has a corner.
struct Curve_foot {
  Feature feature = Feature::interior;
  std::size_t piece = 0;         ///< of the curve, counted from 0; at a joint the piece before it
  Isolated_root<Rational> place; ///< in the piece's local coordinate, from 0 to 1: exactly, or isolated from its factor's other roots
  /// How often P_perp vanishes there, apart from what the curve's standing still adds to it; at a joint on the side where
  /// that is less. 0 where the line from q does not meet the curve at a right angle.
  int multiplicity = 1;
  bool is_whole_piece = false;   ///< an arc of a circle about q: all of the piece is meant, `place` and `point` are its middle's
  int before = 0, after = 0;     ///< signs of the distance's derivative on both sides; 0 where there is none or it is constant
  Range parameter;               ///< encloses the curve's parameter; infinite at u = ±∞
  Range distance;                ///< encloses the distance; {0, 0} exactly where q is the point
  Approximate_point<2> point;
  double error = 0;              ///< proved bound of the printed point's distance from the exact one

  /// No point beside it is nearer (farther).
  bool is_minimum() const { return before <= 0 && after >= 0; }
  bool is_maximum() const { return before >= 0 && after <= 0; }
};

/// The feet of a point on a curve.
struct Nearest_feet {
  std::vector<Curve_foot> feet;      ///< in order along the curve
  std::vector<std::size_t> nearest;  ///< those at the least distance, exactly: several in a tie
  Range distance;                    ///< encloses the least distance; {0, 0} exactly where the point is on the curve

  bool is_on_curve() const { return distance.hi == 0; }
};

namespace detail {

struct Rational_range {
  Rational lo, hi;
};

/// A polynomial's value at a root, by its value in the middle and a bound of its slope.
inline Rational_range range_at(const Bernstein<Rational, 1>& f, const Isolated_root<Rational>& root)
{
  const Fine_place place = fine_place(root);
  const Rational value = evaluate_at(f, place.at);
  if (root.is_exact() || f.degree() == 0) return {value, value};
  Rational slope = 0;
  for (std::size_t i = 0; i + 1 < f.size(); ++i) slope = std::max(slope, Rational(abs(f[i + 1] - f[i])));
  slope *= f.degree() * place.radius;
  return {Rational(value - slope), Rational(value + slope)};
}

/// A quotient; nothing where the divisor is not proved to be positive.
inline std::optional<Rational_range> quotient(const Rational_range& a, const Rational_range& b)
{
  if (b.lo <= 0) return std::nullopt;
  return Rational_range{Rational(a.lo / (a.lo < 0 ? b.lo : b.hi)), Rational(a.hi / (a.hi < 0 ? b.hi : b.lo))};
}

/// Enclosure of the square root of what lies in a range, which need not fit a double itself. Independent of the rounding mode.
inline Range square_root(const Rational_range& x)
{
  mpfr_t root;
  mpfr_init2(root, 64);
  const auto rounded = [&](const Rational& y, mpfr_rnd_t mode) {
    mpfr_set_q(root, y.get_mpq_t(), mode);
    mpfr_sqrt(root, root, mode);
    return mpfr_get_d(root, mode);
  };
  const Range range{rounded(std::max(x.lo, Rational(0)), MPFR_RNDD), rounded(x.hi, MPFR_RNDU)};
  mpfr_clear(root);
  return range;
}

inline Rational value_at(const Integer_polynomial& f, const Rational& x)
{
  Integer sum = 0, power = 1;
  for (std::size_t i = f.size(); i-- > 0;) {
    sum = sum * x.get_num() + f[i] * power;
    if (i > 0) power *= x.get_den();
  }
  Rational value(sum, power);
  value.canonicalize();
  return value;
}

/// A root between two numbers at which its polynomial has different signs.
struct Bracket {
  Rational lo, hi, at_lo, at_hi;

  /// Cuts at a number strictly inside where the polynomial has that value; both ends become it where that is zero.
  void cut(const Rational& x, const Rational& value)
  {
    if (sgn(value) != sgn(at_hi)) lo = x, at_lo = value;
    if (sgn(value) != sgn(at_lo) || value == 0) hi = x, at_hi = value;
  }
};

/// Narrows a bracket to a cell of a grid of 2^step cells, next to the secant's zero; else only to the part of it beyond the
/// next grid line. True in the first case.
inline bool narrow_by_secant(const Integer_polynomial& f, unsigned step, Bracket& b)
{
  Rational cell = b.hi - b.lo, cells = b.at_lo / (b.at_lo - b.at_hi);
  mpq_div_2exp(cell.get_mpq_t(), cell.get_mpq_t(), step);
  mpq_mul_2exp(cells.get_mpq_t(), cells.get_mpq_t(), step);
  cells += Rational(1, 2);
  Integer count;
  mpz_fdiv_q(count.get_mpz_t(), cells.get_num_mpz_t(), cells.get_den_mpz_t());
  const Rational near = b.lo + count * cell;
  if (b.lo < near && near < b.hi) b.cut(near, value_at(f, near));
  const Rational next = near == b.lo ? Rational(near + cell) : Rational(near - cell);
  if (b.lo < next && next < b.hi) b.cut(next, value_at(f, next));
  return Rational(b.hi - b.lo) <= cell;
}

/// Narrows a root on the unit interval to 2^-bits, exactly: the grid's fineness is squared as long as the secant hits the
/// cell (quadratic interval refinement, Abbott 2006).
inline void narrow(Isolated_root<Rational>& root, long bits)
{
  if (root.is_exact()) return;
  const auto missing = [&](const Rational& width) {
    return bits + static_cast<long>(mpz_sizeinbase(width.get_num_mpz_t(), 2)) -
           static_cast<long>(mpz_sizeinbase(width.get_den_mpz_t(), 2)) + 1;
  };
  long left = missing(Rational(root.hi - root.lo)), step = 1;
  if (left <= 0) return;
  const Integer_polynomial f = monomial_form(*root.factor);
  Bracket b{root.lo, root.hi, value_at(f, root.lo), value_at(f, root.hi)};
  while (b.lo != b.hi && left > 0) {
    const bool hit = narrow_by_secant(f, static_cast<unsigned>(std::min(step, left)), b);
    step = hit ? 2 * step : std::max(1L, step / 2);
    left = missing(Rational(b.hi - b.lo));
  }
  root.lo = b.lo;
  root.hi = b.hi;
}

inline Isolated_root<Rational> exact_place(const Rational& s) { return {s, s, 1, nullptr}; }

/// How often the polynomials of a vector all vanish at an end of the unit interval; a large number for zero.
template <std::size_t N>
int order_at(const Polynomial_vector<1, N>& f, int end)
{
  int order = std::numeric_limits<int>::max();
  for (const auto& x : f) {
    const auto& c = x.coefficients();
    int k = 0;
    while (k < static_cast<int>(c.size()) && c[static_cast<std::size_t>(end == 0 ? k : x.degree() - k)] == 0) ++k;
    if (k < static_cast<int>(c.size())) order = std::min(order, k);
  }
  return order;
}

/// A piece of a curve as seen from a point.
class Foot_piece {
public:
  Foot_piece(const Curve_piece<2>& piece, const Exact_point<2>& q)
    : numerator_(piece.numerator), weight_(piece.weight), offset_(offset_from(piece, q)), velocity_(Derivative_vectors<2>(piece).d1()),
      square_(locus::square(offset_)), squared_weight_(at_true_degree(multiply(weight_, weight_))),
      polynomial_(foot_polynomial(piece, q)), standstill_(square_free_decomposition(standstill_factor(piece)))
  {
    form_ = bernstein_form(polynomial_).rational();
  }

  /// An arc of a circle about the point.
  bool is_equidistant() const { return polynomial_.empty(); }
  bool is_infinite_at(int end) const { return weight_[end == 0 ? 0 : weight_.size() - 1] == 0; }

  /// The feet inside and at the ends, and the signs of P_perp between them.
  Root_set<Rational> roots() const { return exact_roots(bernstein_form(polynomial_), Rational(0), Rational(1)); }

  /// Sign of the distance's derivative next to an end.
  int slope_beside(int end) const { return -sign_beside(form_, end); }

  /// How often the line from the point meets the curve at a right angle at an end where it is finite.
  int multiplicity_at(int end) const { return order_at<1>({form_}, end) - order_at(velocity_, end); }

  /// How often the velocity vanishes at a root inside.
  int standstill_at(const Isolated_root<Rational>& root) const
  {
    for (const Square_free_factor& f : standstill_)
      if (vanishes_at(f.factor, root)) return f.multiplicity;
    return 0;
  }

  /// Nothing where the place is not known well enough to tell the weight from zero.
  std::optional<Rational_range> squared_distance(const Isolated_root<Rational>& place) const
  {
    auto n = range_at(square_, place), w = range_at(weight_, place);
    if (w.lo <= 0) return std::nullopt;
    n.lo = std::max(n.lo, Rational(0));
    return quotient(n, {Rational(w.lo * w.lo), Rational(w.hi * w.hi)});
  }

  std::optional<Rational_range> coordinate(std::size_t k, const Isolated_root<Rational>& place) const
  {
    return quotient(range_at(numerator_[k], place), range_at(weight_, place));
  }

  /// Whether the curve passes through the point there.
  bool passes_at(const Isolated_root<Rational>& place) const
  {
    Integer_polynomial common;
    for (const auto& x : offset_) common = gcd(common, monomial_form(Bernstein<Scaled_integer, 1>(x)));
    return vanishes_at(common, place);
  }

  /// A polynomial in t that has the squared distance there as a root: Res_s(factor, |ρ|² - t·W²), whose arguments have no root
  /// in common for all t, since the factor has none in common with W.
  Integer_polynomial squared_distance_polynomial(const Isolated_root<Rational>& place) const
  {
    if (place.is_exact()) {
      const Rational t = squared_distance(place)->lo;
      return {Integer(-t.get_num()), Integer(t.get_den())};
    }
    Bivariate_polynomial factor, distance;
    for (const Integer& c : monomial_form(*place.factor)) factor.row.push_back({c});
    const std::vector<Rational> n = to_monomial(square_), w = to_monomial(squared_weight_);
    Integer denominator = 1;
    for (const auto* list : {&n, &w})
      for (const Rational& c : *list) denominator = lcm(denominator, c.get_den());
    const auto cleared = [&](const std::vector<Rational>& a, std::size_t j) {
      return j < a.size() ? Integer(Rational(a[j] * denominator).get_num()) : Integer(0);
    };
    for (std::size_t j = 0; j < std::max(n.size(), w.size()); ++j) distance.row.push_back({cleared(n, j), Integer(-cleared(w, j))});
    factor.trim();
    distance.trim();
    return resultant_y(factor, distance);
  }

private:
  Polynomial_vector<1, 2> numerator_;
  Bernstein<Rational, 1> weight_;
  Polynomial_vector<1, 2> offset_, velocity_;
  Bernstein<Rational, 1> square_, squared_weight_;
  Integer_polynomial polynomial_;
  Bernstein<Rational, 1> form_;
  std::vector<Square_free_factor> standstill_;
};

/// The squared distance of a foot: an enclosure that can be narrowed, and its polynomial.
class Squared_distance {
public:
  /// Both must outlive this object.
  Squared_distance(const Foot_piece& piece, Isolated_root<Rational>& place) : piece_(&piece), place_(&place)
  {
    refine(80);
    if (!(range_.lo > 0) && piece_->passes_at(*place_)) range_ = {0, 0};
    for (long bits = 160; !is_relatively_fine(); bits *= 2) refine(bits);
  }

  const Rational_range& range() const { return range_; }

  /// Doubles the digits of the place.
  void refine()
  {
    if (range_.lo != range_.hi) refine(2 * bits_);
  }

  Integer_polynomial polynomial() const { return piece_->squared_distance_polynomial(*place_); }

  /// Which of a polynomial's roots, all of them, it is.
  std::size_t root_of(const std::vector<Real_root>& roots)
  {
    for (;; refine()) {
      const auto apart = [&](const Real_root& r) { return r.hi < range_.lo || range_.hi < r.lo; };
      const auto first = std::find_if_not(roots.begin(), roots.end(), apart);
      if (std::all_of(first + 1, roots.end(), apart)) return static_cast<std::size_t>(first - roots.begin());
    }
  }

private:
  void refine(long bits)
  {
    for (bits_ = bits;; bits_ *= 2) {
      narrow(*place_, bits_);
      if (const auto t = piece_->squared_distance(*place_)) {
        range_ = *t;
        return;
      }
    }
  }

  bool is_relatively_fine() const
  {
    Rational width = range_.hi - range_.lo;
    mpq_mul_2exp(width.get_mpq_t(), width.get_mpq_t(), 56);
    return width <= range_.hi;
  }

  const Foot_piece* piece_;
  Isolated_root<Rational>* place_;
  Rational_range range_;
  long bits_ = 0;
};

/// The least of squared distances, exactly.
class Least_distance {
public:
  explicit Least_distance(std::vector<Squared_distance>& distances) : distances_(distances)
  {
    for (std::size_t i = 0; i < distances.size(); ++i) left_.push_back(i);
  }

  /// The indices of those that are least.
  std::vector<std::size_t> run()
  {
    drop_greater();
    for (int round = 0; round < 2 && !is_decided(); ++round) {
      for (const std::size_t i : left_) distances_[i].refine();
      drop_greater();
    }
    if (!is_decided()) compare_exactly();
    return left_;
  }

private:
  const Rational_range& range(std::size_t i) const { return distances_[i].range(); }

  /// One is left, or several that are known exactly.
  bool is_decided() const
  {
    return left_.size() == 1 || std::all_of(left_.begin(), left_.end(), [&](std::size_t i) { return range(i).lo == range(i).hi; });
  }

  void drop_greater()
  {
    Rational least = range(left_[0]).hi;
    for (const std::size_t i : left_) least = std::min(least, range(i).hi);
    left_.erase(std::remove_if(left_.begin(), left_.end(), [&](std::size_t i) { return range(i).lo > least; }), left_.end());
  }

  /// All are roots of one polynomial: which ones?
  void compare_exactly()
  {
    Integer_polynomial all{Integer(1)};
    for (const std::size_t i : left_) {
      const Integer_polynomial f = distances_[i].polynomial();
      all = multiply(all, exact_quotient(f, gcd(f, all)));
    }
    const std::vector<Real_root> roots = real_roots(all);
    std::vector<std::size_t> index, least;
    for (const std::size_t i : left_) index.push_back(distances_[i].root_of(roots));
    const std::size_t first = *std::min_element(index.begin(), index.end());
    for (std::size_t k = 0; k < left_.size(); ++k)
      if (index[k] == first) least.push_back(left_[k]);
    left_ = least;
  }

  std::vector<Squared_distance>& distances_;
  std::vector<std::size_t> left_;
};

/// Gathers the feet of a point along a curve.
class Foot_search {
public:
  Foot_search(const Curve_2& curve, const Exact_point<2>& q) : chain_(curve.chain())
  {
    for (const auto& piece : curve.pieces()) pieces_.emplace_back(piece, q);
  }

  Nearest_feet run()
  {
    if (!chain_.joint_at(0, 0)) add_end(0, 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      add_inside(i);
      if (chain_.joint_at(i, 1)) add_joint(i);
      else add_end(i, 1);
    }
    choose_nearest();
    return std::move(result_);
  }

private:
  void add(std::size_t i, Isolated_root<Rational> place, Feature feature, int multiplicity, int before, int after)
  {
    Curve_foot foot;
    foot.feature = feature;
    foot.piece = i;
    foot.place = std::move(place);
    foot.multiplicity = multiplicity;
    foot.before = before;
    foot.after = after;
    result_.feet.push_back(std::move(foot));
  }

  void add_end(std::size_t i, int end)
  {
    const Foot_piece& p = pieces_[i];
    if (p.is_infinite_at(end)) return;
    const int slope = p.slope_beside(end);
    add(i, exact_place(end), end == 0 ? Feature::start : Feature::end, p.is_equidistant() ? 1 : p.multiplicity_at(end),
        end == 0 ? 0 : slope, end == 0 ? slope : 0);
  }

  void add_inside(std::size_t i)
  {
    if (pieces_[i].is_equidistant()) {
      add(i, exact_place(Rational(1, 2)), Feature::interior, 1, 0, 0);
      result_.feet.back().is_whole_piece = true;
      return;
    }
    const auto set = pieces_[i].roots();
    const auto slope = [&](std::size_t k) { return -static_cast<int>(set.gaps[k]); };
    for (std::size_t k = 0; k < set.roots.size(); ++k) {
      const auto& root = set.roots[k];
      if (root.is_exact() && (root.lo == 0 || root.lo == 1)) continue; // a joint's or an end's
      const int standstill = pieces_[i].standstill_at(root);
      add(i, root, standstill % 2 ? Feature::corner : Feature::interior, root.multiplicity - standstill, slope(k), slope(k + 1));
    }
  }

  /// Corners are always feet; other joints where the distance is stationary, but not those of an arc that is listed as a whole.
  void add_joint(std::size_t i)
  {
    const Foot_piece &left = pieces_[i], &right = pieces_[chain_.neighbour(i, 1)];
    if (left.is_infinite_at(1) || right.is_infinite_at(0)) return;
    const bool is_corner = !chain_.goes_on_at(i, 1), is_in_arc = left.is_equidistant() || right.is_equidistant();
    if (!is_corner && is_in_arc) return;
    const int before = left.slope_beside(1), after = right.slope_beside(0);
    const int multiplicity = is_in_arc ? 0 : std::min(left.multiplicity_at(1), right.multiplicity_at(0));
    if (!is_corner && multiplicity == 0 && before == after) return;
    add(i, exact_place(1), is_corner ? Feature::corner : Feature::interior, multiplicity, before, after);
  }

  void choose_nearest()
  {
    std::vector<Squared_distance> distances;
    for (Curve_foot& foot : result_.feet) {
      distances.emplace_back(pieces_[foot.piece], foot.place);
      describe(foot, distances.back().range());
    }
    result_.nearest = Least_distance(distances).run();
    result_.distance = result_.feet[result_.nearest[0]].distance;
    for (const std::size_t i : result_.nearest) {
      result_.distance.lo = std::max(result_.distance.lo, result_.feet[i].distance.lo);
      result_.distance.hi = std::min(result_.distance.hi, result_.feet[i].distance.hi);
    }
  }

  /// The curve's parameters for local coordinates.
  static Range parameters(const Piece& piece, const Rational_range& s)
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const auto lo = piece.at(s.lo), hi = piece.at(s.hi);
    const double beyond = piece.hi_infinite ? infinite : -infinite;
    return {lo ? enclosing(*lo).inf() : beyond, hi ? enclosing(*hi).sup() : beyond};
  }

  void describe(Curve_foot& foot, const Rational_range& squared) const
  {
    foot.distance = square_root(squared);
    foot.parameter =
      parameters(chain_.pieces[foot.piece],
                 foot.is_whole_piece ? Rational_range{0, 1} : Rational_range{foot.place.lo, foot.place.hi});
    Rational_range error{0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto x = *pieces_[foot.piece].coordinate(k, foot.place);
      foot.point[k] = nearest_double(Rational((x.lo + x.hi) / 2));
      if (!std::isfinite(foot.point[k])) throw Unsupported_feature("a foot with coordinates beyond 1e308");
      const Rational printed(foot.point[k]), off = std::max(Rational(abs(x.lo - printed)), Rational(abs(x.hi - printed)));
      error.hi += off * off;
    }
    foot.error = square_root(error).hi;
  }

  Chain chain_;
  std::vector<Foot_piece> pieces_;
  Nearest_feet result_;
};

} // namespace detail

/// The feet of a point q on a curve, and those at the least distance, exactly: Farouki & Johnstone (1994), (11)-(16).
/// - Inside pieces all roots of P_perp (see `foot_form`), isolated exactly, with their multiplicities: those of odd ones are
///   extrema, as the signs on both sides tell. A cusp at an irrational parameter is a corner.
/// - The ends of the curve that are not at infinity, and its corners; other joints where the distance is stationary.
/// - A finite point at u = ±∞ is a point of the curve, also where the domain is half-open there.
/// - A piece that is an arc of a circle about q is one foot, `is_whole_piece`; its ends are listed only as ends and corners.
/// Distances are compared in rational enclosures, and where those do not tell them apart as roots of the resultants in t of
/// P_perp and |ρ|² - t·W²: several feet are nearest exactly where their distances are equal.
/// Throws Unsupported_feature for a foot whose coordinates no double can hold. Time, for a piece of degree n: O(n²) rational
/// operations, the isolation of at most 3n-2 roots and some ten steps of refinement for each; in a tie besides a resultant for
/// each foot in it.
inline Nearest_feet nearest_feet(const Curve_2& curve, const Coordinates_2& q) { return detail::Foot_search(curve, q.exact()).run(); }

/// The squared distance of one of a point's feet as an algebraic number, for comparisons with other distances.
inline Algebraic_number squared_distance(const Curve_2& curve, const Coordinates_2& q, Curve_foot foot)
{
  const detail::Foot_piece piece(curve.pieces()[foot.piece], q.exact());
  detail::Squared_distance distance(piece, foot.place);
  if (distance.range().lo == distance.range().hi) return Algebraic_number(distance.range().lo);
  const Integer_polynomial polynomial = distance.polynomial();
  const std::vector<Real_root> roots = real_roots(polynomial);
  const Real_root& root = roots[distance.root_of(roots)];
  return Algebraic_number(polynomial, root.lo, root.hi);
}

/// To which of a point and a curve a query point is nearer.
enum class Nearer : unsigned char { point, curve, equal };

constexpr const char* name_of(Nearer n)
{
  constexpr const char* names[] = {"point", "curve", "equal"};
  return names[static_cast<std::size_t>(n)];
}

/// Tells of query points whether they are nearer to a point p or to a curve. Immutable, safe to share between threads.
///   Q(u) = |ρ_q|² - |q - p|²·W²,
/// of degree 2n on each piece, decides: negative somewhere, it is the curve; zero somewhere but never negative, neither;
/// positive all along, the point. As q moves Q is linear in it: Q = ℓ₃ - (q-p)·(ℓ₁, ℓ₂) with the lift of `Point_curve_forms`,
/// which is formed once. The distance from the curve is that of (11): a finite point at u = ±∞ is a point of the curve.
class Point_or_curve {
public:
  Point_or_curve(const Coordinates_2& p, const Curve_2& curve) : point_(p.exact())
  {
    for (const auto& piece : curve.pieces()) {
      Lift lift{Point_curve_forms(piece, point_).lift(), {}};
      int degree = 0;
      for (const auto& f : lift.exact) degree = std::max(degree, f.degree());
      for (std::size_t k = 0; k < 3; ++k) {
        lift.exact[k] = elevate(lift.exact[k], 0, degree - lift.exact[k].degree());
        lift.enclosed[k] = enclosing(lift.exact[k]);
      }
      lifts_.push_back(std::move(lift));
    }
  }

  /// Decided exactly, always: doubles with an error bound first, then `least_sign`. O(n²) operations for a piece where doubles
  /// tell.
  Nearer operator()(const Coordinates_2& q) const
  {
    const Exact_point<2> at = q.exact();
    const std::array<Rational, 2> from_point{Rational(at[0] - point_[0]), Rational(at[1] - point_[1])};
    std::vector<const Lift*> open;
    for (const Lift& lift : lifts_) {
      const Sign sign = filtered_least_sign(enclosed_form(lift, from_point));
      if (sign == Sign::negative) return Nearer::curve;
      if (sign == Sign::unknown) open.push_back(&lift);
    }
    Nearer result = Nearer::point;
    for (const Lift* lift : open) {
      const Sign sign = least_sign(form<Rational>(lift->exact, from_point));
      if (sign == Sign::negative) return Nearer::curve;
      if (sign == Sign::zero) result = Nearer::equal;
    }
    return result;
  }

private:
  struct Lift {
    std::array<Bernstein<Rational, 1>, 3> exact;
    std::array<Bernstein<Interval, 1>, 3> enclosed;
  };

  template <class T>
  static Bernstein<T, 1> form(const std::array<Bernstein<T, 1>, 3>& lift, const std::array<T, 2>& q)
  {
    Bernstein<T, 1> f = lift[2];
    for (std::size_t i = 0; i < f.size(); ++i) f[i] -= T(q[0] * lift[0][i]) + T(q[1] * lift[1][i]);
    return f;
  }

  static Bernstein<Bounded, 1> enclosed_form(const Lift& lift, const std::array<Rational, 2>& q)
  {
    return with_upward_rounding([&] { return bounded(form<Interval>(lift.enclosed, {enclosing(q[0]), enclosing(q[1])})); });
  }

  Exact_point<2> point_;
  std::vector<Lift> lifts_;
};

/// Whether q is nearer to p or to the curve, exactly; for many query points see `Point_or_curve`.
inline Nearer nearer(const Coordinates_2& q, const Coordinates_2& p, const Curve_2& curve) { return Point_or_curve(p, curve)(q); }

} // namespace locus

#endif
