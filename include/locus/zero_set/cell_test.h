// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CELL_TEST_H
#define LOCUS_ZERO_SET_CELL_TEST_H

#include <locus/zero_set/interval_matrix.h>
#include <locus/zero_set/pivot_sets.h>
#include <locus/zero_set/system_tree.h>

namespace locus {
namespace detail {

/// What one rung of arithmetic finds out about a cell.
template <int K>
struct Cell_finding {
  enum class Kind : unsigned char {
    nothing, ///< neither of the two, and no better arithmetic would change that
    unknown, ///< errors are too large to tell
    empty,   ///< a polynomial has one strict sign
    graph    ///< dominant for `pivots`
  };
  Kind kind = Kind::nothing;
  Pivot_set<K> pivots{};
  int equation = -1;                                         ///< of an empty cell; -1 where a combination has the sign
  std::array<double, static_cast<std::size_t>(K)> weights{}; ///< of that combination, for the cell's own coefficients
};

/// The two tests on a cell, in doubles with error bounds.
///
/// *Empty*: one polynomial, or one combination with constant weights, has coefficients of one strict sign.
/// *Graph* over the variables that are not in J: the polynomials are combined by ONE constant matrix, the inverse of the
/// Jacobian's midpoint in x_J; the K×K matrix of ranges of the combinations' derivatives in x_J is strictly diagonally
/// dominant. Between two zeros that differ in x_J only, the mean value theorem would give a matrix, each row taken
/// from those ranges, with a nonzero vector in its kernel; but a strictly dominant matrix is regular. Combining the
/// coefficients before ranges are taken keeps what cancels. Cost: O(C(D,K)·K²·n) for n coefficients; no allocation.
template <int K, int D>
class Cell_test {
public:
  using Tree = System_tree<K, D>;
  using Index = typename Tree::Index;
  using Finding = Cell_finding<K>;
  using Kind = typename Finding::Kind;

  explicit Cell_test(const Tree& tree)
    : tree_(tree), degrees_(tree.degrees()), count_(tree.coefficient_count_each()), combined_(n * count_)
  {
  }

  Finding run(Index i)
  {
    Finding finding = sign_test(i);
    if (finding.kind == Kind::empty) return finding;
    measure_slopes(i);
    order_pivot_sets();
    for (const Candidate& candidate : candidates_) {
      const Finding f = pivot_test(i, candidate.pivots);
      if (f.kind == Kind::empty || f.kind == Kind::graph) return f;
      if (f.kind == Kind::unknown) finding.kind = Kind::unknown;
    }
    return finding;
  }

  /// How much each variable matters on a cell, for the choice of a cut: the polynomials' greatest slopes, each polynomial
  /// scaled to its greatest one. Cost: O(K·D·n).
  std::array<double, static_cast<std::size_t>(D)> spread(Index i)
  {
    measure_slopes(i);
    std::array<double, static_cast<std::size_t>(D)> total{};
    for (std::size_t k = 0; k < n; ++k) {
      double greatest = 0;
      for (const Range& r : slopes_[k]) greatest = std::max(greatest, r.magnitude());
      for (std::size_t v = 0; v < total.size() && greatest > 0; ++v) total[v] += slopes_[k][v].magnitude() / greatest;
    }
    return total;
  }

private:
  static constexpr auto n = static_cast<std::size_t>(K);

  struct Range {
    double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();

    void add(double x)
    {
      lo = x < lo ? x : lo;
      hi = x > hi ? x : hi;
    }
    double middle() const { return 0.5 * (lo + hi); }
    double magnitude() const { return std::max(std::abs(lo), std::abs(hi)); }
    /// Least absolute value; negative, by how far zero lies inside, where zero is one of the values.
    double mignitude() const { return std::max(lo, -hi); }
    Kind strict_sign(double bound) const
    {
      if (mignitude() > bound) return Kind::empty;
      return mignitude() >= -bound ? Kind::unknown : Kind::nothing;
    }
  };

  struct Candidate {
    Pivot_set<K> pivots;
    double score = 0;
  };

  Finding sign_test(Index i) const
  {
    Finding finding;
    for (std::size_t k = 0; k < n; ++k) {
      const Kind kind = range_of(tree_.coefficients(i, k)).strict_sign(tree_[i].error[k]);
      if (kind == Kind::nothing) continue;
      finding.kind = kind;
      finding.equation = static_cast<int>(k);
      if (kind == Kind::empty) return finding;
    }
    return finding;
  }

  Range range_of(const double* c) const
  {
    Range r;
    for (std::size_t j = 0; j < count_; ++j) r.add(c[j]);
    return r;
  }

  /// Range of the derivative's coefficients by the cell's own unit coordinate.
  Range slope_range(const double* c, int variable) const
  {
    const Layout layout = layout_along(degrees_, variable);
    Range r;
    if (layout.count == 1) r.add(0);
    const std::size_t block = layout.count * layout.inner;
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t k = 0; k + layout.inner < block; ++k) r.add(c[o * block + k + layout.inner] - c[o * block + k]);
    const double degree = degrees_[static_cast<std::size_t>(variable)];
    r.lo *= degree;
    r.hi *= degree;
    return r;
  }

  void measure_slopes(Index i)
  {
    for (std::size_t k = 0; k < n; ++k)
      for (int v = 0; v < D; ++v) slopes_[k][static_cast<std::size_t>(v)] = slope_range(tree_.coefficients(i, k), v);
  }

  Real_matrix<K> middle_matrix(const Pivot_set<K>& pivots) const
  {
    Real_matrix<K> m;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j) m[k][j] = slopes_[k][static_cast<std::size_t>(pivots[j])].middle();
    return m;
  }

  /// Largest minors first: a guess where dominance is likeliest.
  void order_pivot_sets()
  {
    for (std::size_t s = 0; s < candidates_.size(); ++s) {
      candidates_[s].pivots = sets[s];
      const double minor = std::abs(determinant(middle_matrix(sets[s])));
      candidates_[s].score = std::isfinite(minor) ? minor : 0;
    }
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  }

  Finding pivot_test(Index i, const Pivot_set<K>& pivots)
  {
    Finding finding;
    finding.pivots = pivots;
    const auto inverse = approximate_inverse<K>(middle_matrix(pivots));
    if (!inverse) return finding;
    bool unknown = false, nothing = false;
    for (std::size_t r = 0; r < n; ++r) {
      const double error = combine(i, (*inverse)[r], r);
      const double* row = combined_.data() + r * count_;
      const Range values = range_of(row);
      if (n > 1 && values.strict_sign(error) == Kind::empty) {
        finding.kind = Kind::empty;
        finding.weights = (*inverse)[r];
        return finding;
      }
      if (nothing) continue; // the other rows may still show that the cell is empty
      const Kind strict = row_dominance(row, r, pivots, error, std::max(std::abs(values.lo), std::abs(values.hi)));
      unknown = unknown || strict == Kind::unknown;
      nothing = strict == Kind::nothing;
    }
    finding.kind = nothing ? Kind::nothing : unknown ? Kind::unknown : Kind::graph;
    return finding;
  }

  /// Row r of the combinations into the scratch array; returns its error bound.
  double combine(Index i, const std::array<double, n>& weights, std::size_t r)
  {
    double* out = combined_.data() + r * count_;
    double inherited = 0, norm = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double* c = tree_.coefficients(i, k);
      const double w = weights[k];
      if (k == 0)
        for (std::size_t j = 0; j < count_; ++j) out[j] = w * c[j];
      else
        for (std::size_t j = 0; j < count_; ++j) out[j] += w * c[j];
      inherited += std::abs(w) * tree_[i].error[k];
      norm += std::abs(w) * tree_[i].norm[k];
    }
    return accumulated_error(inherited, 4.0 * K + 2, norm);
  }

  /// Whether the diagonal of row r outweighs the rest of the row for all values within the error bound (graph), or for the
  /// computed ones only (unknown). Where not even these pass, better arithmetic is not worth its price.
  Kind row_dominance(const double* row, std::size_t r, const Pivot_set<K>& pivots, double error, double norm) const
  {
    double surplus = 0, size = 0, doubt = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Range range = slope_range(row, pivots[j]);
      surplus += j == r ? range.mignitude() : -range.magnitude();
      size += range.magnitude();
      doubt += degrees_[static_cast<std::size_t>(pivots[j])] * accumulated_error(2 * error, 4, 2 * (norm + error));
    }
    doubt = accumulated_error(doubt, 4.0 * K + 4, size);
    return surplus > doubt ? Kind::graph : surplus > 0 ? Kind::unknown : Kind::nothing;
  }

  static constexpr auto sets = all_pivot_sets<K, D>();

  const Tree& tree_;
  Degrees<D> degrees_;
  std::size_t count_;
  std::array<std::array<Range, static_cast<std::size_t>(D)>, n> slopes_{};
  std::array<Candidate, choose_number(D, K)> candidates_{};
  std::vector<double> combined_;
};

} // namespace detail
} // namespace locus

#endif
