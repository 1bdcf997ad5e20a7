// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CELL_BOUNDARY_H
#define LOCUS_CONSTRUCT_CELL_BOUNDARY_H

#include <locus/construct/point_cell.h>

#include <numeric>

namespace locus {
namespace detail {

/// The stretches of a cell's boundary in counterclockwise order. Seen from a point between them the boundary of a convex set is
/// passed once; so an exact comparison of directions to one rational point of each stretch orders them.
class Cell_boundary {
public:
  /// Upward rounding needed.
  explicit Cell_boundary(const Point_cell& cell) : cell_(cell), order_(cell.stretches().size())
  {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (order_.size() > 2 && !sort<Interval>()) sort<Rational>();
  }

  std::size_t size() const { return order_.size(); }
  /// Index of the k-th stretch, k taken modulo their number.
  std::size_t operator[](std::size_t k) const { return order_[k % order_.size()]; }

  /// The end (0 or 1) of a stretch that comes last.
  std::size_t last_end(std::size_t stretch) const { return cell_.stretches()[stretch].counterclockwise ? 1 : 0; }
  std::size_t first_end(std::size_t stretch) const { return 1 - last_end(stretch); }

  /// Whether the boundary goes on from the k-th stretch to the next one through a finite point.
  bool goes_on(std::size_t k) const
  {
    const std::size_t a = (*this)[k], b = (*this)[k + 1];
    return !cell_.stretches()[a].infinite[last_end(a)] && !cell_.stretches()[b].infinite[first_end(b)];
  }

private:
  template <class T>
  using Place = std::array<T, 2>;

  static Place<Rational> point_at(const Cell_feature& feature, double u, const Rational*)
  {
    const Vector_form& f = feature.tangent();
    const Rational w = evaluate_at(f[2], Rational(u));
    return {Rational(-evaluate_at(f[0], Rational(u)) / w), Rational(-evaluate_at(f[1], Rational(u)) / w)};
  }
  static Place<Interval> point_at(const Cell_feature& feature, double u, const Interval*)
  {
    const Enclosed_vector t = feature.tangent_tree->node(0).f.at(u);
    const auto value = [&](std::size_t k) { return t.interval_form(k)[0]; };
    return {-value(0) / value(2), -value(1) / value(2)};
  }

  static Sign sign(const Rational& x) { return sign_of_int(sgn(x)); }
  static Sign sign(const Interval& x) { return sign_of(x); }

  /// By the angles from the first axis on, seen from the middle of all places; false where the number type leaves one open.
  template <class T>
  bool sort()
  {
    std::vector<Place<T>> places;
    Place<T> middle{T(0), T(0)};
    for (const Cell_stretch& s : cell_.stretches()) {
      places.push_back(point_at(cell_.features()[s.feature], s.inside, static_cast<const T*>(nullptr)));
      for (std::size_t k = 0; k < 2; ++k) middle[k] += places.back()[k];
    }
    bool is_certain_order = true;
    std::vector<int> half;
    for (Place<T>& p : places) {
      for (std::size_t k = 0; k < 2; ++k) p[k] -= middle[k] / T(static_cast<int>(places.size()));
      const Sign x = sign(p[0]), y = sign(p[1]);
      is_certain_order = is_certain_order && is_strict(y);
      half.push_back(y == Sign::positive || (y == Sign::zero && x == Sign::positive) ? 0 : 1);
      if (std::is_same_v<T, Rational>) is_certain_order = true;
    }
    if (!is_certain_order) return false;
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t i, std::size_t j) { // bears answers that contradict each other
      if (i == j || half[i] != half[j]) return half[i] < half[j];
      const Sign turn = sign(T(places[i][0] * places[j][1] - places[i][1] * places[j][0]));
      is_certain_order = is_certain_order && is_certain(turn);
      return turn == Sign::positive;
    });
    return is_certain_order;
  }

  const Point_cell& cell_;
  std::vector<std::size_t> order_;
};

} // namespace detail
} // namespace locus

#endif
