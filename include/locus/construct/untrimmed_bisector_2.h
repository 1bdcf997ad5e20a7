// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_UNTRIMMED_BISECTOR_2_H
#define LOCUS_CONSTRUCT_UNTRIMMED_BISECTOR_2_H

#include <locus/construct/planar_result.h>

#include <chrono>

namespace locus {

struct Bisector_options {
  Solve_control control;
  bool keep_cells = false; ///< keep the cells of the subdivision in the result, for pictures
  bool keep_evidence = false; ///< keep what a certificate is written from
  double least_cut_radius = 0; ///< arcs to infinity are drawn at least so far from the inputs' middle
};

namespace detail {

inline std::shared_ptr<Planar_solution> framed_solution(const std::vector<const Curve_2*>& curves, double least_cut_radius)
{
  std::vector<Exact_point<2>> points;
  for (const Curve_2* curve : curves) collect_control_points(*curve, points);
  auto solution = std::make_shared<Planar_solution>();
  solution->frame = fitting_frame<2>(points);
  for (std::size_t k = 0; k < 2; ++k) solution->origin[k] = enclosing(solution->frame.origin[k]);
  measure_inputs(points, *solution);
  solution->cut_radius = std::max(solution->cut_radius, std::ldexp(least_cut_radius, static_cast<int>(-solution->frame.exponent)));
  return solution;
}

/// Both inputs' pieces, cut where it is wanted and where that is necessary; for a self-bisector (no second curve) the same
/// ones twice.
inline std::array<std::shared_ptr<const Planar_pieces>, 2> framed_inputs(const Curve_2& a, const Curve_2* b, const Frame<2>& frame,
                                                                        const std::vector<Necessary_cut>& wanted)
{
  std::array<const Curve_2*, 2> curve{&a, b ? b : &a};
  std::array<std::optional<Curve_2>, 2> cut_curve;
  std::array<std::shared_ptr<const Planar_pieces>, 2> pieces;
  const auto frame_input = [&](std::size_t k) { pieces[k] = std::make_shared<const Planar_pieces>(*curve[k], frame); };
  const auto cut_at = [&](const Necessary_cut& cut) {
    const std::size_t k = b ? cut.input : 0;
    cut_curve[k] = with_inserted_knot(*curve[k], cut.at);
    curve[k] = &*cut_curve[k];
    return k;
  };
  for (const Necessary_cut& cut : wanted) cut_at(cut);
  frame_input(0);
  if (b) frame_input(1);
  else pieces[1] = pieces[0];
  while (const auto cut = necessary_cut(*pieces[0], *pieces[1], !b)) {
    frame_input(cut_at(*cut));
    if (!b) pieces[1] = pieces[0];
  }
  return pieces;
}

/// F3 = 0 on all pairs of pieces of two inputs, or of one with itself, and what the result is made from.
struct Solved_inputs {
  std::array<std::shared_ptr<const Planar_pieces>, 2> pieces;
  bool is_self = false;
  std::shared_ptr<const Planar_solution> solution;
  std::vector<Patch_maker::Note> notes;
  Degrees<2> degrees{0, 0};
  bool has_axis = false;
  std::vector<Cell_picture> cells;
  std::shared_ptr<const Locus_evidence> evidence;
  Locus_statistics statistics;
};

/// One attempt: nothing where it found that the inputs should be cut at a place of contact first, which is added to `cuts`.
inline std::optional<Solved_inputs> attempted_solution(const Curve_2& a, const Curve_2* b, const Bisector_options& options, std::vector<Necessary_cut>& cuts,
                                                       Solve_statistics& statistics)
{
  constexpr std::size_t most_cuts = 24;
  const bool is_self = b == nullptr;
  auto solution = framed_solution(is_self ? std::vector<const Curve_2*>{&a} : std::vector<const Curve_2*>{&a, b}, options.least_cut_radius);
  const auto inputs = framed_inputs(a, b, solution->frame, cuts);
  const Planar_pieces &first = *inputs[0], &second = *inputs[1];
  Cell_keeper keeper;
  const Domain_cells cells({{first.chain, second.chain}}, is_self);
  const auto evidence = options.keep_evidence ? std::make_shared<Planar_evidence>() : nullptr;
  Patch_maker maker(first, second, cells, options.control, options.keep_cells ? &keeper : nullptr, evidence.get());
  maker.statistics = statistics;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < (is_self ? i + 1 : second.size()); ++j) maker.solve_pair(i, j);
  statistics = maker.statistics;
  if (maker.wanted_cut && cuts.size() < most_cuts) {
    cuts.push_back(*maker.wanted_cut);
    return std::nullopt;
  }
  solution->patches = std::move(maker.planar);
  const std::vector<Glued_sides> glued = cells.glued(maker.patches);
  solution->work = join_patches(std::move(maker.patches), glued);
  if (evidence) {
    evidence->inputs = inputs;
    evidence->is_self = is_self;
    evidence->frame = solution->frame;
    evidence->solution = solution;
  }
  Solved_inputs solved{inputs, is_self, solution, std::move(maker.notes), maker.degrees, maker.has_axis, std::move(keeper.cells), evidence, {}};
  solved.statistics.cells = maker.statistics.cells;
  solved.statistics.pairs = maker.pairs;
  solved.statistics.purged_pairs = maker.purged;
  solved.statistics.exact_cells = maker.statistics.exact_cells;
  solved.statistics.filter = maker.statistics.filter;
  return solved;
}

inline Solved_inputs solved_inputs(const Curve_2& a, const Curve_2* b, const Bisector_options& options)
{
  std::vector<Necessary_cut> cuts;
  Solve_statistics statistics;
  for (;;)
    if (auto solved = attempted_solution(a, b, options, cuts, statistics)) return std::move(*solved);
}

/// The untrimmed bisector, from the solved equation.
inline Locus_data<2> untrimmed_data(const Solved_inputs& solved)
{
  Planar_result result(solved.solution, *solved.pieces[0], *solved.pieces[1], solved.is_self);
  result.add_notes(solved.notes);
  Locus_data<2> data = std::move(result.data());
  data.equations.push_back({F3_form::name, {solved.degrees[0], solved.degrees[1]}});
  if (solved.has_axis) data.equations.push_back({"axis of symmetry", {1, 1}});
  data.cells = solved.cells;
  data.evidence = solved.evidence;
  data.statistics = solved.statistics;
  return data;
}

inline Locus<2> untrimmed_bisector_upward(const Curve_2& a, const Curve_2* b, const Bisector_options& options)
{
  const auto start = std::chrono::steady_clock::now();
  Locus_data<2> data = untrimmed_data(solved_inputs(a, b, options));
  data.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return Locus<2>(std::move(data));
}

} // namespace detail

/// All of the zero set of F3 for two rational curves in the plane (of any number of pieces), with its image: every pair of
/// feet whose normals meet at equal distance, certified. The true bisector by least distances is a subset of it. Arcs go
/// on across joints where the tangent does not turn, and break off at corners.
/// F3 is the equation of Elber & Kim 1998 (13), written as -Im(e² ā b̄).
/// Throws Unsupported_feature for a cusp inside a piece. Cost: under a microsecond for each pair of pieces that a bounding
/// test purges; else some ten to a hundred cells of O(degree³) each.
inline Locus<2> untrimmed_bisector(const Curve_2& first, const Curve_2& second, const Bisector_options& options = {})
{
  return with_upward_rounding([&] { return detail::untrimmed_bisector_upward(first, &second, options); });
}

/// The same for a curve with itself: pairs of feet on one curve, each unordered pair once, with parameter(0) greater than
/// parameter(1). Arcs that end on the diagonal do so at curvature extrema, or at joints where the curvature or its
/// derivative jumps; spans that are straight or circular are listed as degenerate.
inline Locus<2> untrimmed_bisector(const Curve_2& curve, const Bisector_options& options = {})
{
  return with_upward_rounding([&] { return detail::untrimmed_bisector_upward(curve, nullptr, options); });
}

} // namespace locus

#endif
