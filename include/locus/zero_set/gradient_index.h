// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_GRADIENT_INDEX_H
#define LOCUS_ZERO_SET_GRADIENT_INDEX_H

#include <locus/function/bernstein_operations.h>
#include <locus/function/descartes.h>
#include <locus/function/domain.h>

#include <optional>
#include <vector>

namespace locus {
namespace detail {

/// The winding number of a vector field (x, y) along the boundary of a box, counterclockwise. It is counted where the vector
/// crosses the positive y-axis: x goes from its not negative to its negative side, or back. Exact.
class Winding_number {
public:
  using Form = Bernstein<Scaled_integer, 2>;

  Winding_number(const Form& x, const Form& y, const Box<2>& box) : x_(x), y_(y), box_(box) {}

  /// Nothing where the vector vanishes on the boundary.
  std::optional<int> run()
  {
    // Edges counterclockwise: which variable is fixed, on which side, and whether the other one rises.
    constexpr std::array<std::array<int, 3>, 4> edges{{{1, 0, 1}, {0, 1, 1}, {1, 1, 0}, {0, 0, 0}}};
    for (const auto& e : edges) walk(e[0], e[1], e[2] == 1);
    if (is_singular_ || !first_) return std::nullopt;
    pass_to(*first_, first_above_);
    return is_singular_ ? std::nullopt : std::optional<int>(winding_);
  }

private:
  using Edge = Bernstein<Scaled_integer, 1>;

  Edge on_edge(const Form& f, int variable, int side) const
  {
    const auto v = static_cast<std::size_t>(variable), w = 1 - v;
    const Edge line = face(split(f, variable, Rational(side ? box_.hi[v] : box_.lo[v])).first, variable, true);
    return restrict_to(line, 0, Rational(box_.lo[w]), Rational(box_.hi[w]));
  }

  void walk(int variable, int side, bool rising)
  {
    Edge x = on_edge(x_, variable, side), y = on_edge(y_, variable, side);
    if (!rising) {
      x = reversed(x);
      y = reversed(y);
    }
    if (x.is_zero()) return pass_to(false, y.sign(0)); // counts as not negative all along
    auto set = exact_roots(x, Rational(0), Rational(1));
    for (std::size_t k = 0; k < set.gaps.size(); ++k) {
      const bool is_empty = (k == 0 && !set.roots.empty() && set.roots[0].is_exact() && set.roots[0].lo == 0) ||
                            (k > 0 && k == set.roots.size() && set.roots[k - 1].is_exact() && set.roots[k - 1].lo == 1);
      if (is_empty) continue;
      pass_to(set.gaps[k] == Sign::negative, k == 0 ? y.sign(0) : sign_at_root(y, set.roots[k - 1]));
    }
  }

  static Edge reversed(const Edge& f)
  {
    Bernstein<Integer, 1> values(f.values());
    std::vector<Integer> c(values.coefficients().rbegin(), values.coefficients().rend());
    return {Bernstein<Integer, 1>(f.degrees(), std::move(c)), f.scale()};
  }

  /// Sign of y where x vanishes; zero there would make the vector zero.
  Sign sign_at_root(const Edge& y, Isolated_root<Rational>& root)
  {
    constexpr int most = 400;
    for (int step = 0; step < most; ++step) {
      const Edge part = restrict_to(y, 0, root.lo, root.hi);
      if (const Sign all = common_sign(part); is_strict(all)) return all;
      if (root.is_exact()) break;
      bisect_exactly(*root.factor, Rational(0), Rational(1), root);
    }
    return Sign::zero;
  }

  /// The vector's x is negative from here on, or not; y has this sign at the passage.
  void pass_to(bool negative, Sign above)
  {
    if (!first_) {
      first_ = negative;
      first_above_ = above;
    } else if (negative != *current_) {
      if (above == Sign::zero) is_singular_ = true;
      if (above == Sign::positive) winding_ += negative ? 1 : -1;
    }
    current_ = negative;
  }

  const Form &x_, &y_;
  Box<2> box_;
  std::optional<bool> first_, current_;
  Sign first_above_ = Sign::zero;
  int winding_ = 0;
  bool is_singular_ = false;
};

} // namespace detail

/// The index of the gradient of f along the boundary of a box: how often it turns, counterclockwise. Nothing where it
/// vanishes on the boundary. Exact; needs no zero of the gradient there. Around the only critical point p of a box 2(1 - index) half-branches
/// of f = f(p) leave p (Arnold 1978).
inline std::optional<int> gradient_index(const Bernstein<Scaled_integer, 2>& fx, const Bernstein<Scaled_integer, 2>& fy, const Box<2>& box)
{
  return detail::Winding_number(fx, fy, box).run();
}

} // namespace locus

#endif
