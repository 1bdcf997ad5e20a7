// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_POINT_CELL_FEATURES_H
#define LOCUS_CONSTRUCT_POINT_CELL_FEATURES_H

#include <locus/constraint/point_curve.h>
#include <locus/function/diagonal.h>
#include <locus/shape/framed.h>
#include <locus/zero_set/requirement.h>

namespace locus {

/// What circles through a point can touch: the inside of a piece, an end or a corner, or, where the point itself lies on the
/// curve, the curve there. `tangent` is (-qx, -qy, qw) for the circles' centres q relative to the point, by the feature's
/// parameter: the local one of a piece; for a straight line t, with λ = (2t - 1)/(t(1 - t)) along it, counterclockwise.
struct Cell_feature {
  enum class Kind : unsigned char { arc, vertex, normal };
  Kind kind = Kind::arc;
  std::size_t piece = 0;
  int end = 0; ///< of the piece, for a vertex
  std::shared_ptr<Vector_tree> tangent_tree;
  std::shared_ptr<Vector_tree> lift; ///< of an arc's piece
  bool counterclockwise = true;
  bool has_weight_requirement = false; ///< the first requirement is that of the weight's sign
  std::vector<Requirement> requirements;
  std::vector<std::size_t> piece_of; ///< the piece that a requirement is about; none of the weight's

  static constexpr std::size_t no_piece = std::numeric_limits<std::size_t>::max();

  void require(Requirement requirement, std::size_t about)
  {
    requirements.push_back(std::move(requirement));
    piece_of.push_back(about);
  }
  const Vector_form& tangent() const { return tangent_tree->exact(); }
};

/// A piece of the curve relative to the point, with its lift. At ends where the point itself is, the lift vanishes: it is
/// divided by that zero, which keeps its sign.
struct Seen_piece {
  std::array<Bernstein<Rational, 1>, 2> offset; ///< ρ
  Bernstein<Rational, 1> weight;
  std::array<int, 2> lift_zeros{};
  std::shared_ptr<Vector_tree> lift;
  std::vector<Bernstein<Interval, 1>> enclosed_lift;
  std::array<std::array<Rational, 3>, 2> end_lift; ///< the lift at both ends
  std::size_t input = 0, source = 0; ///< the curve, and its piece
  Rational from = 0, to = 1; ///< the part of it
  bool starts_at_cusp = false, ends_at_cusp = false;
  bool is_redundant = false; ///< another piece runs along the same path
};

struct Cell_features {
  std::vector<Seen_piece> pieces;
  std::vector<Cell_feature> features;
};

namespace detail {

/// f/v or f/(1 - v) for an f that vanishes there.
template <class T>
Bernstein<T, 1> without_end_zero(const Bernstein<T, 1>& f, int end)
{
  const int n = f.degree();
  Bernstein<T, 1> g(Degrees<1>{n - 1});
  for (int i = 0; i < n; ++i) {
    const T factor = T(n) / T(end == 0 ? i + 1 : n - i);
    g[static_cast<std::size_t>(i)] = f[static_cast<std::size_t>(end == 0 ? i + 1 : i)] * factor;
  }
  return g;
}

template <class T>
std::vector<Bernstein<T, 1>> without_end_zeros(std::vector<Bernstein<T, 1>> f, const std::array<int, 2>& times)
{
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < times[static_cast<std::size_t>(end)]; ++k)
      for (auto& x : f) x = without_end_zero(x, end);
  return f;
}

/// How often all components vanish at an end, by exact forms.
inline int zeros_at_end(const Vector_form& f, int end)
{
  int times = 0;
  const auto n = f[0].size();
  while (static_cast<std::size_t>(times) < n && std::all_of(f.begin(), f.end(), [&](const auto& x) {
           return x[end == 0 ? static_cast<std::size_t>(times) : n - 1 - static_cast<std::size_t>(times)] == 0;
         }))
    ++times;
  return times;
}

inline bool may_vanish_at_end(const std::vector<Bernstein<Interval, 1>>& f, int end)
{
  return std::all_of(f.begin(), f.end(), [&](const auto& x) { return contains_zero(x[end == 0 ? 0 : x.size() - 1]); });
}

/// The forms of one piece over a coefficient type: all by the same steps, so that the enclosures have the exact forms' degrees.
template <class T>
struct Piece_forms {
  std::vector<Bernstein<T, 1>> lift, tangent;
  std::vector<Bernstein<T, 1>> self; ///< T2(u, v), as coefficients of v's Bernstein basis
  Bernstein<T, 1> weight_sign;       ///< [ρ ρ']

  Piece_forms(const std::array<Bernstein<T, 1>, 2>& offset, const Bernstein<T, 1>& weight) : offset_(offset), weight_(weight) {}

  void make_lift() { lift = of_one_degree(lift_of(offset_, weight_)); }
  void make_tangent() { tangent = of_one_degree(tangent_of(lift_of(offset_, weight_))); }
  void make_weight_sign() { weight_sign = turning(offset_[0], offset_[1]); }
  /// From a tangent and a lift without zeros at their ends.
  void make_self(const std::vector<Bernstein<T, 1>>& reduced_tangent, const std::vector<Bernstein<T, 1>>& reduced_lift)
  {
    const Bernstein<T, 2> f = quotient_by_diagonal(quotient_by_diagonal(product_form(reduced_tangent, reduced_lift)));
    self.clear();
    for (int j = 0; j <= f.degree(1); ++j) {
      Bernstein<T, 1> row(Degrees<1>{f.degree(0)});
      for (int i = 0; i <= f.degree(0); ++i) row[static_cast<std::size_t>(i)] = f.at({i, j});
      self.push_back(std::move(row));
    }
  }

private:
  std::array<Bernstein<T, 1>, 2> offset_;
  Bernstein<T, 1> weight_;
};

struct Enclosed_piece {
  std::array<Bernstein<Interval, 1>, 2> offset;
  Bernstein<Interval, 1> weight;
};

inline Enclosed_piece enclosed_piece(const Seen_piece& piece) { return {{enclosing(piece.offset[0]), enclosing(piece.offset[1])}, enclosing(piece.weight)}; }

/// ℓ and ℓ' at a place, from values of ρ, W and their derivatives there. Upward rounding needed.
inline std::array<std::array<Interval, 3>, 2> fresh_lift(const Enclosed_piece& piece, double u)
{
  const auto at = [&](const Bernstein<Interval, 1>& f) {
    return std::array<Interval, 2>{evaluate_at(f, Interval(u)), evaluate_at(derivative(f), Interval(u))};
  };
  const auto x = at(piece.offset[0]), y = at(piece.offset[1]), w = at(piece.weight);
  const Interval two(2);
  return {{{two * w[0] * x[0], two * w[0] * y[0], CGAL::square(x[0]) + CGAL::square(y[0])},
           {two * (w[1] * x[0] + w[0] * x[1]), two * (w[1] * y[0] + w[0] * y[1]), two * (x[0] * x[1] + y[0] * y[1])}}};
}

inline std::vector<Interval> fresh_tangent(const Enclosed_piece& piece, double u, int sign)
{
  const auto [l, d] = fresh_lift(piece, u);
  std::vector<Interval> t;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    t.push_back(Interval(sign) * (l[i] * d[j] - l[j] * d[i]));
  }
  return t;
}

/// Sets up what is required of the features of a curve. Interval forms first; exact ones where they are needed.
class Cell_feature_maker {
public:
  /// The curve's pieces relative to the point, in order.
  explicit Cell_feature_maker(std::vector<Seen_piece> pieces)
  {
    result_.pieces = std::move(pieces);
    for (Seen_piece& piece : result_.pieces) {
      make_lift(piece);
      make_end_lifts(piece);
    }
  }

  /// The inside of a piece, in both orientations that its tangents can have.
  void add_arc(std::size_t i)
  {
    const auto piece = std::make_shared<const Seen_piece>(result_.pieces[i]);
    const auto seen = std::make_shared<const Enclosed_piece>(enclosed_piece(*piece));
    Piece_forms<Interval> forms(seen->offset, seen->weight);
    forms.make_tangent();
    forms.make_weight_sign();
    const std::array<int, 2> zeros = end_zeros(forms.tangent, [piece] { return exact_tangent(*piece, {}); });
    forms.tangent = without_end_zeros(forms.tangent, zeros);
    const std::array<int, 2> weight_zeros = end_zeros({forms.weight_sign}, [piece] { return exact_weight_sign(*piece, {}, 1); });
    if (weight_zeros[0] + weight_zeros[1] > forms.weight_sign.degree()) return; // the piece lies on a line through the point
    const auto weight_sign = without_end_zeros<Interval>({forms.weight_sign}, weight_zeros);
    bool can[2] = {true, true};
    bool all[2] = {true, true};
    for (const Interval& c : weight_sign[0].coefficients()) {
      all[0] = all[0] && c.inf() > 0;
      all[1] = all[1] && c.sup() < 0;
    }
    if (all[0]) can[1] = false;
    if (all[1]) can[0] = false;
    forms.make_self(forms.tangent, piece->enclosed_lift);
    if (is_one_centre(*piece, forms.self, zeros)) return;
    const auto basis = basis_tree(forms.self.size());
    for (int sign = 1; sign >= -1; sign -= 2) {
      if (!can[sign > 0 ? 0 : 1]) continue;
      Cell_feature f;
      f.piece = i;
      f.counterclockwise = sign > 0;
      f.lift = result_.pieces[i].lift;
      f.tangent_tree = tree(forms.tangent, sign, [piece, zeros, sign] { return times(exact_tangent(*piece, zeros), sign); });
      if (zeros == std::array<int, 2>{}) f.tangent_tree->set_fresh([seen, sign](double u) { return fresh_tangent(*seen, u, sign); });
      const auto self = tree(forms.self, sign, [piece, zeros, sign] { return times(exact_self(*piece, zeros), sign); });
      if (!all[sign > 0 ? 0 : 1]) {
        f.has_weight_requirement = true;
        f.require({tree(weight_sign, sign, [piece, weight_zeros, sign] { return exact_weight_sign(*piece, weight_zeros, sign); }), basis_tree(1)}, Cell_feature::no_piece);
      }
      f.require({self, basis, {}, f.tangent_tree, result_.pieces[i].lift}, i);
      for (std::size_t j = 0; j < result_.pieces.size(); ++j)
        if (j != i && !result_.pieces[j].is_redundant) f.require({f.tangent_tree, result_.pieces[j].lift}, j);
      result_.features.push_back(std::move(f));
    }
  }

  /// The centres of circles through the point that touch the lift vector (a, b, c) of an end: the line a·x + b·y = c.
  void add_vertex(std::size_t piece, int end)
  {
    const auto& [a, b, c] = result_.pieces[piece].end_lift[static_cast<std::size_t>(end)];
    const Rational square = a * a + b * b;
    if (square == 0) return; // at infinity
    const Rational across = c / square, along = c == 0 ? Rational(1) / std::max(Rational(abs(a)), Rational(abs(b))) : across;
    add_line(Cell_feature::Kind::vertex, piece, end, {Rational(a * across), Rational(b * across)}, {Rational(-b * along), Rational(a * along)});
  }

  /// Whether two ends have one line: the same point, or, where the point itself is there, the same tangent.
  bool has_one_line(const std::pair<std::size_t, int>& x, const std::pair<std::size_t, int>& y) const
  {
    const auto &a = result_.pieces[x.first].end_lift[static_cast<std::size_t>(x.second)], &b = result_.pieces[y.first].end_lift[static_cast<std::size_t>(y.second)];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < k; ++l)
        if (a[k] * b[l] != a[l] * b[k]) return false;
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0;
  }

  /// The normal line of the curve where the point is, at an end of a piece.
  void add_normal(std::size_t piece, int end)
  {
    const auto& [a, b, c] = result_.pieces[piece].end_lift[static_cast<std::size_t>(end)];
    const Rational along = Rational(1) / std::max(Rational(abs(a)), Rational(abs(b)));
    add_line(Cell_feature::Kind::normal, piece, end, {Rational(0), Rational(0)}, {Rational(-b * along), Rational(a * along)});
  }

  Cell_features result() { return std::move(result_); }

  /// Of a circle through the point all normals meet in its centre: T vanishes identically.
  static bool is_one_centre(const Seen_piece& piece, const std::vector<Bernstein<Interval, 1>>& self, const std::array<int, 2>& zeros)
  {
    for (const auto& row : self)
      for (const Interval& c : row.coefficients())
        if (!contains_zero(c)) return false;
    const Vector_form exact = exact_self(piece, zeros);
    return std::all_of(exact.begin(), exact.end(), [](const auto& row) { return is_zero(row); });
  }

private:
  static Vector_form times(Vector_form f, int sign)
  {
    if (sign < 0)
      for (auto& x : f) x = multiply(x, Rational(-1));
    return f;
  }

  static Vector_form exact_lift(const Seen_piece& piece)
  {
    Piece_forms<Rational> forms(piece.offset, piece.weight);
    forms.make_lift();
    return forms.lift;
  }
  static Vector_form exact_tangent(const Seen_piece& piece, const std::array<int, 2>& zeros)
  {
    Piece_forms<Rational> forms(piece.offset, piece.weight);
    forms.make_tangent();
    return without_end_zeros(forms.tangent, zeros);
  }
  static Vector_form exact_self(const Seen_piece& piece, const std::array<int, 2>& zeros)
  {
    Piece_forms<Rational> forms(piece.offset, piece.weight);
    forms.make_self(exact_tangent(piece, zeros), without_end_zeros(exact_lift(piece), piece.lift_zeros));
    return forms.self;
  }
  static Vector_form exact_weight_sign(const Seen_piece& piece, const std::array<int, 2>& zeros, int sign)
  {
    Piece_forms<Rational> forms(piece.offset, piece.weight);
    forms.make_weight_sign();
    return times(without_end_zeros<Rational>({forms.weight_sign}, zeros), sign);
  }

  /// How often forms vanish at both ends: by the exact ones where the enclosures do not exclude it.
  template <class Make_exact>
  static std::array<int, 2> end_zeros(const std::vector<Bernstein<Interval, 1>>& f, Make_exact make_exact)
  {
    std::array<int, 2> zeros{};
    std::optional<Vector_form> exact;
    for (int end = 0; end < 2; ++end) {
      if (!may_vanish_at_end(f, end)) continue;
      if (!exact) exact = make_exact();
      zeros[static_cast<std::size_t>(end)] = zeros_at_end(*exact, end);
    }
    return zeros;
  }

  template <class Make_exact>
  static std::shared_ptr<Vector_tree> tree(std::vector<Bernstein<Interval, 1>> f, int sign, Make_exact make_exact)
  {
    if (sign < 0)
      for (auto& x : f) x = multiply(x, Interval(-1));
    return std::make_shared<Vector_tree>(Enclosed_vector(f), std::move(make_exact));
  }

  /// From the curve's own end where the point is not there.
  static void make_end_lifts(Seen_piece& piece)
  {
    for (std::size_t end = 0; end < 2; ++end) {
      const auto at = [&](const Bernstein<Rational, 1>& f) -> const Rational& { return f[end == 0 ? 0 : f.size() - 1]; };
      const Rational &x = at(piece.offset[0]), &y = at(piece.offset[1]), &w = at(piece.weight);
      if (piece.lift_zeros[end] == 0) piece.end_lift[end] = {Rational(2 * w * x), Rational(2 * w * y), Rational(x * x + y * y)};
      else
        for (std::size_t k = 0; k < 3; ++k) piece.end_lift[end][k] = at(piece.lift->exact()[k]);
    }
  }

  void make_lift(Seen_piece& piece) const
  {
    Piece_forms<Interval> forms({enclosing(piece.offset[0]), enclosing(piece.offset[1])}, enclosing(piece.weight));
    forms.make_lift();
    const Seen_piece exact = piece;
    piece.lift_zeros = end_zeros(forms.lift, [&] { return exact_lift(exact); });
    const std::array<int, 2> zeros = piece.lift_zeros;
    piece.enclosed_lift = without_end_zeros(forms.lift, zeros);
    piece.lift = tree(piece.enclosed_lift, 1, [exact, zeros] { return without_end_zeros(exact_lift(exact), zeros); });
    if (zeros == std::array<int, 2>{})
      piece.lift->set_fresh([seen = enclosed_piece(exact)](double v) {
        const auto l = fresh_lift(seen, v)[0];
        return std::vector<Interval>(l.begin(), l.end());
      });
  }

  /// The Bernstein basis of so many functions, one tree for each degree.
  std::shared_ptr<Vector_tree> basis_tree(std::size_t size)
  {
    if (bases_.size() <= size) bases_.resize(size + 1);
    if (!bases_[size]) {
      Vector_form basis;
      for (std::size_t k = 0; k < size; ++k) {
        Bernstein<Rational, 1> b(Degrees<1>{static_cast<int>(size) - 1});
        b[k] = 1;
        basis.push_back(std::move(b));
      }
      bases_[size] = std::make_shared<Vector_tree>(std::move(basis));
    }
    return bases_[size];
  }

  using Vector_2 = std::array<Rational, 2>;

  /// q = middle + λ·along, with the requirements of all pieces; zeros that all of its points share with a piece's end divided out.
  void add_line(Cell_feature::Kind kind, std::size_t piece, int end, const Vector_2& middle, const Vector_2& along)
  {
    Cell_feature f;
    f.kind = kind;
    f.piece = piece;
    f.end = end;
    const Rational half(1, 2);
    Vector_form tangent(3, Bernstein<Rational, 1>(Degrees<1>{2}));
    for (std::size_t k = 0; k < 2; ++k) {
      tangent[k][0] = along[k];
      tangent[k][1] = -half * middle[k];
      tangent[k][2] = -along[k];
    }
    tangent[2][1] = half;
    f.tangent_tree = std::make_shared<Vector_tree>(std::move(tangent));
    for (std::size_t j = 0; j < result_.pieces.size(); ++j)
      if (!result_.pieces[j].is_redundant) f.require({f.tangent_tree, without_common_zeros(f.tangent(), result_.pieces[j])}, j);
    result_.features.push_back(std::move(f));
  }

  static bool is_orthogonal(const Vector_form& tangent, const std::array<Rational, 3>& lift)
  {
    for (std::size_t i = 0; i < tangent[0].size(); ++i)
      if (tangent[0][i] * lift[0] + tangent[1][i] * lift[1] + tangent[2][i] * lift[2] != 0) return false;
    return true;
  }

  /// A simple zero at an end is the rule, where the piece begins or ends there; at a point on the curve there are more.
  static std::shared_ptr<Vector_tree> without_common_zeros(const Vector_form& tangent, const Seen_piece& piece)
  {
    std::array<int, 2> times{};
    for (std::size_t end = 0; end < 2; ++end)
      if (is_orthogonal(tangent, piece.end_lift[end])) times[end] = zeros_of_product(tangent, piece, end);
    if (times == std::array<int, 2>{}) return piece.lift;
    return tree(without_end_zeros(piece.enclosed_lift, times), 1, [lift = piece.lift->lazy_exact(), times] { return without_end_zeros(lift.get(), times); });
  }

  static int zeros_of_product(const Vector_form& tangent, const Seen_piece& piece, std::size_t end)
  {
    int times = 1;
    for (const std::size_t n = piece.enclosed_lift[0].size(); static_cast<std::size_t>(times) < n; ++times) {
      const std::size_t k = end == 0 ? static_cast<std::size_t>(times) : n - 1 - static_cast<std::size_t>(times);
      if (is_certainly_not_orthogonal(tangent, piece, k)) break;
      const Vector_form& lift = piece.lift->exact();
      if (!is_orthogonal(tangent, {lift[0][k], lift[1][k], lift[2][k]})) break;
    }
    return times;
  }

  static bool is_certainly_not_orthogonal(const Vector_form& tangent, const Seen_piece& piece, std::size_t k)
  {
    for (std::size_t i = 0; i < tangent[0].size(); ++i) {
      Interval sum(0);
      for (std::size_t r = 0; r < 3; ++r) sum += enclosing(tangent[r][i]) * piece.enclosed_lift[r][k];
      if (!contains_zero(sum)) return true;
    }
    return false;
  }

  Cell_features result_;
  std::vector<std::shared_ptr<Vector_tree>> bases_;
};

} // namespace detail
} // namespace locus

#endif
