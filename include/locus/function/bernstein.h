// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_BERNSTEIN_H
#define LOCUS_FUNCTION_BERNSTEIN_H

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace locus {

template <int D>
using Degrees = std::array<int, static_cast<std::size_t>(D)>;

/// Number of coefficients of a tensor product of these degrees.
template <std::size_t N>
constexpr std::size_t coefficient_count(const std::array<int, N>& degrees)
{
  std::size_t n = 1;
  for (int d : degrees) n *= static_cast<std::size_t>(d) + 1;
  return n;
}

/// How a dense array lies in memory as seen along one variable: `outer` blocks of `count` rows of `inner` entries.
struct Layout {
  std::size_t outer, count, inner;
};

template <std::size_t N>
constexpr Layout layout_along(const std::array<int, N>& degrees, int variable)
{
  Layout layout{1, static_cast<std::size_t>(degrees[static_cast<std::size_t>(variable)]) + 1, 1};
  for (std::size_t i = 0; i < N; ++i) {
    const auto extent = static_cast<std::size_t>(degrees[i]) + 1;
    if (static_cast<int>(i) < variable) layout.outer *= extent;
    if (static_cast<int>(i) > variable) layout.inner *= extent;
  }
  return layout;
}

/// A polynomial in D variables on the unit box, as a tensor product in the Bernstein basis: degrees chosen at run
/// time, coefficients in one contiguous array whose last index runs fastest.
/// T is a ring: double (approximate), Interval (enclosures), Rational (exact). `Bernstein<Bounded, D>` and
/// `Bernstein<Scaled_integer, D>` are specialisations whose whole array shares an error bound or a scale.
template <class T, int D>
class Bernstein {
public:
  using Coefficient = T;
  static constexpr int dimension = D;

  Bernstein() : Bernstein(Degrees<D>{}) {}
  explicit Bernstein(const Degrees<D>& degrees) : degrees_(degrees), coefficients_(coefficient_count(degrees), T(0)) {}
  Bernstein(const Degrees<D>& degrees, std::vector<T> coefficients)
    : degrees_(degrees), coefficients_(std::move(coefficients))
  {
    assert(coefficients_.size() == coefficient_count(degrees_));
  }

  const Degrees<D>& degrees() const { return degrees_; }
  int degree(int variable = 0) const { return degrees_[static_cast<std::size_t>(variable)]; }
  std::size_t size() const { return coefficients_.size(); }

  const T* data() const { return coefficients_.data(); }
  T* data() { return coefficients_.data(); }
  const T& operator[](std::size_t i) const { return coefficients_[i]; }
  T& operator[](std::size_t i) { return coefficients_[i]; }
  const std::vector<T>& coefficients() const { return coefficients_; }

  std::size_t index(const Degrees<D>& i) const
  {
    std::size_t n = 0;
    for (std::size_t k = 0; k < i.size(); ++k)
      n = n * (static_cast<std::size_t>(degrees_[k]) + 1) + static_cast<std::size_t>(i[k]);
    return n;
  }
  const T& at(const Degrees<D>& i) const { return coefficients_[index(i)]; }
  T& at(const Degrees<D>& i) { return coefficients_[index(i)]; }

private:
  Degrees<D> degrees_;
  std::vector<T> coefficients_;
};

/// Moves a multi-index to the next one in memory order; false after the last.
template <std::size_t N>
constexpr bool advance_index(std::array<int, N>& index, const std::array<int, N>& degrees)
{
  for (std::size_t k = N; k-- > 0;) {
    if (++index[k] <= degrees[k]) return true;
    index[k] = 0;
  }
  return false;
}

} // namespace locus

#endif
