// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_SHEET_SPLIT_H
#define LOCUS_CONSTRUCT_SHEET_SPLIT_H

#include <locus/construct/sheet_forms.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace locus::detail {

/// Which variable a cell is split in. No claim rests on it.
class Split_choice {
public:
  /// The one in which the surface bends more; or, where it bends little or in both at once, the one in which it is longer.
  static int by_bending(const Sheet_forms& f)
  {
    const Split_choice s = of_points(f);
    const double u = s.second(0) * f.degrees()[0] * (f.degrees()[0] - 1);
    const double v = s.second(1) * f.degrees()[1] * (f.degrees()[1] - 1);
    if (std::max(u, v) > s.mixed() * f.degrees()[0] * f.degrees()[1]) return u >= v ? 0 : 1;
    return s.longer();
  }

  /// The one in which it is longer.
  static int by_length(const Sheet_forms& f) { return of_points(f).longer(); }

  /// The one in which the homogeneous coordinates vary more, points at the cut radius being as far as the weight's unit.
  static int by_forms(const Sheet_forms& f, double radius)
  {
    const auto value = [&](std::size_t k, std::size_t i) { return midpoint(f.form(k)[i]) / (k < 3 ? radius : 1); };
    return Split_choice(f, value).longer();
  }

private:
  static Split_choice of_points(const Sheet_forms& f)
  {
    const auto value = [&](std::size_t k, std::size_t i) {
      return k < 3 ? midpoint(f.form(k)[i]) / midpoint(f.form(3)[i]) : 0;
    };
    return Split_choice(f, value);
  }

  template <class Value>
  Split_choice(const Sheet_forms& f, Value value) : degrees_(f.degrees()), columns_(f.columns())
  {
    for (std::size_t i = 0; i < f.size(); ++i) values_.push_back({value(0, i), value(1, i), value(2, i), value(3, i)});
  }

  int longer() const { return first(0) * degrees_[0] >= first(1) * degrees_[1] ? 0 : 1; }
  double first(int k) const { return greatest(k == 0, k == 1, {{{0, -1}, {step(k), 1}, {}, {}}}); }
  double second(int k) const
  {
    return greatest(2 * (k == 0), 2 * (k == 1), {{{0, 1}, {step(k), -2}, {2 * step(k), 1}, {}}});
  }
  double mixed() const { return greatest(1, 1, {{{0, 1}, {step(0), -1}, {step(1), -1}, {step(0) + step(1), 1}}}); }

  std::size_t step(int k) const { return k == 0 ? columns_ : 1; }

  struct Term {
    std::size_t offset = 0;
    double factor = 0;
  };

  /// The greatest component of a difference, over all places where it reaches `rows` and `columns` further.
  double greatest(int rows, int columns, const std::array<Term, 4>& difference) const
  {
    double most = 0;
    for (int i = 0; i + rows <= degrees_[0]; ++i)
      for (int j = 0; j + columns <= degrees_[1]; ++j)
        for (std::size_t k = 0; k < 4; ++k) {
          double sum = 0;
          const std::size_t at = static_cast<std::size_t>(i) * columns_ + static_cast<std::size_t>(j);
          for (const Term& term : difference) sum += term.factor * values_[at + term.offset][k];
          most = std::max(most, std::abs(sum));
        }
    return most;
  }

  Degrees<2> degrees_;
  std::size_t columns_;
  std::vector<std::array<double, 4>> values_;
};

} // namespace locus::detail

#endif
