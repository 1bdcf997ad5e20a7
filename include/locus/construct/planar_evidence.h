// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_PLANAR_EVIDENCE_H
#define LOCUS_CONSTRUCT_PLANAR_EVIDENCE_H

#include <locus/constraint/f3_problem.h>
#include <locus/construct/locus.h>
#include <locus/construct/planar_pieces.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace locus {
namespace detail {

/// One solve of a planar bisector: what was asked and what was claimed of the cells, in the solver's order. The graph is that
/// of the patch, if the solve left one.
struct Planar_solve_evidence {
  std::array<std::size_t, 2> pair;
  F3_problem problem;
  std::vector<Claim<2>> claims;
  std::optional<std::size_t> patch; ///< in the solution's patchwork; none where nothing was found
  bool as_whole = false;            ///< the axis was solved with the other factor; the latest claims count

  bool has_axis() const { return problem.axis && !as_whole; }
  const System<1, 2>& system() const { return as_whole ? *problem.whole : problem.system; }
};

/// All that a certificate of a planar bisector is written from.
struct Planar_evidence final : Locus_evidence {
  std::array<std::shared_ptr<const Planar_pieces>, 2> inputs; ///< after all cuts; twice the same for a self-bisector
  bool is_self = false;
  Frame<2> frame;
  std::vector<std::array<std::size_t, 2>> purged;
  std::vector<Planar_solve_evidence> solves;
  std::shared_ptr<const Planar_solution> solution;
};

/// Keeps a solve's claims, and hands them on.
class Claim_recorder final : public Claim_observer<2> {
public:
  explicit Claim_recorder(Claim_observer<2>* next) : next_(next) {}

  void on_claim(const Claim<2>& claim) override
  {
    claims.push_back(claim);
    if (next_) next_->on_claim(claim);
  }

  Claim_observer<2>* next() const { return next_; }

  std::vector<Claim<2>> claims;

private:
  Claim_observer<2>* next_;
};

} // namespace detail
} // namespace locus

#endif
