// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_CLAIM_H
#define LOCUS_ZERO_SET_CLAIM_H

#include <locus/function/domain.h>
#include <locus/number/filter_counts.h>
#include <locus/number/rational.h>

#include <cstddef>
#include <string>
#include <vector>

namespace locus {

/// What the solver says of a cell.
enum class Claim_kind : unsigned char {
  split,        ///< nothing yet: the cell was cut along `variable` at `at`
  empty,        ///< equation `variable` has one strict sign on the cell (zeros at corners excepted)
  graph,        ///< dominant for the pivot `variable`: at most one point above each value of the others
  crossing,     ///< the cell holds one singular point, where two smooth branches cross
  outside,      ///< nothing is wanted here
  isolated_box, ///< a regular point system has exactly one solution in the box
  undecided     ///< a limit was reached; `reason` says which
};

/// What proves that polynomials in two variables vanish together at a point (α, β), by division identities that anyone can
/// redo: α is the only root of m in [lo, hi], where m changes sign (or exactly lo where lo == hi), and β is a root of
/// h(α, y) = Σ_j h[j](α)·y^j, which changes sign between r_lo and r_hi (or vanishes at r_lo == r_hi). The polynomials reduce to zero modulo
/// m(x) and h(x, y); the last of the h[j] is 1.
struct Algebraic_evidence {
  std::vector<Integer> m;                ///< square-free; coefficients of 1, x, x², …
  Rational lo, hi;
  std::vector<std::vector<Rational>> h; ///< h[j]: coefficients of 1, x, x², …, of lower degree than m
  Rational r_lo, r_hi;
};

/// A claim with its evidence: the cell, the pivot or equation, and the rung of arithmetic that proved it. The signs
/// themselves are the Bernstein coefficients on the box and can be recomputed by anyone.
template <int D>
struct Claim {
  Claim_kind kind = Claim_kind::split;
  Box<D> box;
  int variable = 0;
  double at = 0;
  Rung rung = Rung::bounded;
  std::size_t special = 0; ///< of a crossing: which of the graph's special points the cell holds
  std::string reason;
};

/// Receives every claim of a solve, in the solve's order: statistics, pictures of the cells and certificates are
/// observers. Called with upward rounding.
template <int D>
class Claim_observer {
public:
  virtual ~Claim_observer() = default;
  virtual void on_claim(const Claim<D>& claim) = 0;
};

} // namespace locus

#endif
