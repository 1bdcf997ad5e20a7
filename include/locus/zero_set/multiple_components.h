// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_MULTIPLE_COMPONENTS_H
#define LOCUS_ZERO_SET_MULTIPLE_COMPONENTS_H

#include <locus/function/square_free.h>
#include <locus/zero_set/piece_evaluation.h>
#include <locus/zero_set/system.h>

#include <optional>

namespace locus {
namespace detail {

/// An equation of which some factor is repeated: along that factor's zeros all derivatives vanish, so that its square-free part
/// is solved instead.
struct Square_free_system {
  System<1, 2> system;
  struct Factor {
    std::shared_ptr<const Equation<2>> equation;
    int multiplicity = 1;
  };
  std::vector<Factor> factors;
};

/// Nothing where no factor is repeated.
inline std::optional<Square_free_system> without_repetition(const System<1, 2>& system)
{
  const std::vector<Repeated_factor> factors = square_free_factors(bivariate_form(system.equations[0]->exact()));
  if (std::none_of(factors.begin(), factors.end(), [](const Repeated_factor& x) { return x.multiplicity > 1; })) return std::nullopt;
  Square_free_system reduced{system, {}};
  Bivariate_polynomial product{{{Integer(1)}}};
  for (const Repeated_factor& x : factors) {
    product = multiply(product, x.f);
    reduced.factors.push_back({std::make_shared<Polynomial_equation<2>>(bernstein_form(x.f)), x.multiplicity});
  }
  reduced.system.equations[0] = std::make_shared<Polynomial_equation<2>>(bernstein_form(product));
  return reduced;
}

/// The only factor that can vanish on a piece, seen from a place on it where all others have a sign; -1 where none is found.
inline int factor_of_piece(const Curve_graph& graph, std::size_t piece, const std::vector<Square_free_system::Factor>& factors)
{
  int found = -1;
  const auto look = [&](const std::array<Interval, 2>& at) {
    int candidate = -1, open = 0;
    for (std::size_t k = 0; k < factors.size(); ++k)
      if (may_vanish(*factors[k].equation, box_of(at))) {
        ++open;
        candidate = static_cast<int>(k);
      }
    if (open == 1) found = candidate;
    return open == 1 ? Sign::positive : Sign::unknown;
  };
  const Graph_piece& p = graph.pieces[piece];
  if (p.is_half_branch) look(graph.vertices[p.to].at);
  else sign_along(graph, piece, look);
  return found;
}

/// Tells each piece and each arc the multiplicity of its factor: different factors meet in nodes only.
inline void note_multiplicities(Curve_graph& graph, const std::vector<Square_free_system::Factor>& factors)
{
  for (std::size_t k = 0; k < graph.pieces.size(); ++k) {
    const int factor = factor_of_piece(graph, k, factors);
    if (factor >= 0) graph.pieces[k].multiplicity = factors[static_cast<std::size_t>(factor)].multiplicity;
    else graph.undecided.push_back({graph.forms[k].box, "which factor's zero an arc is"});
  }
  for (Graph_arc& arc : graph.arcs)
    for (const Graph_arc::Step& step : arc.steps) arc.multiplicity = std::max(arc.multiplicity, graph.pieces[step.piece].multiplicity);
}

} // namespace detail
} // namespace locus

#endif
