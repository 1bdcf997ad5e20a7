// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_BOUND_H
#define LOCUS_CONSTRUCT_SHEET_BOUND_H

#include <locus/construct/sheet_forms.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace locus::detail {

/// Bounds the distance of a surface f, whose weight has one sign, to each function that agrees with it at points of the cell
/// and is linear on triangles between them. For an affine map A the coefficients of (N - Aw)/w, taken at degrees that hold
/// both parts, span a convex hull that contains f - A everywhere and so also its linear interpolants: they differ by the
/// hull's diameter at most.
class Interpolation_bound {
public:
  /// Infinite as soon as it is beyond `give_up`.
  double operator()(const Sheet_forms& f, double give_up)
  {
    weight_.clear();
    for_each_elevated(f.degrees(), [&](int i, int j) {
      weight_.push_back(elevated(f.degrees(), i, j, [&](std::size_t, std::size_t at) { return f.form(3)[at]; }));
    });
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = width_in_coordinate(f, k);
      square += w * w;
      if (!(square <= give_up * give_up)) return std::numeric_limits<double>::infinity();
    }
    return std::sqrt(square);
  }

private:
  template <class Visit>
  static void for_each_elevated(const Degrees<2>& d, Visit visit)
  {
    for (int i = 0; i <= d[0] + 1; ++i)
      for (int j = 0; j <= d[1] + 1; ++j) visit(i, j);
  }

  /// A coefficient of the product of a bilinear form with corner values b_c and a form of coefficients a_i, times a constant:
  /// the sum of `at(c, i)` = b_c a_i, weighted.
  template <class At>
  static Interval elevated(const Degrees<2>& d, int i, int j, At at)
  {
    Interval sum(0);
    for (int c = 0; c < 4; ++c) {
      const int a = i - (c >> 1), b = j - (c & 1);
      if (a < 0 || a > d[0] || b < 0 || b > d[1]) continue;
      const int factor = (c & 2 ? i : d[0] + 1 - i) * (c & 1 ? j : d[1] + 1 - j);
      const auto index = static_cast<std::size_t>(a * (d[1] + 1) + b);
      sum += at(static_cast<std::size_t>(c), index) * static_cast<double>(factor);
    }
    return sum;
  }

  /// The values at the corners of an affine function near to coordinate `k`. Whatever its rounding, it is affine.
  static std::array<Interval, 4> affine(const Sheet_forms& f, std::size_t k)
  {
    std::array<double, 4> q;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto h = f.corner(c);
      q[c] = midpoint(h[k] / h[3]);
    }
    const double along_u = 0.5 * ((q[2] - q[0]) + (q[3] - q[1])), along_v = 0.5 * ((q[1] - q[0]) + (q[3] - q[2]));
    const Interval start(q[0]);
    return {start, start + along_v, start + along_u, start + along_u + along_v};
  }

  double width_in_coordinate(const Sheet_forms& f, std::size_t k)
  {
    const std::array<Interval, 4> plane = affine(f, k);
    const std::size_t n = f.size();
    off_.resize(4 * n);
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t i = 0; i < n; ++i) off_[c * n + i] = f.form(k)[i] - plane[c] * f.form(3)[i];
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    std::size_t next = 0;
    for_each_elevated(f.degrees(), [&](int i, int j) {
      const Interval ratio =
        elevated(f.degrees(), i, j, [&](std::size_t c, std::size_t at) { return off_[c * n + at]; }) / weight_[next++];
      lo = std::min(lo, ratio.inf());
      hi = std::max(hi, ratio.sup());
    });
    return hi - lo;
  }

  std::vector<Interval> weight_, off_;
};

} // namespace locus::detail

#endif
