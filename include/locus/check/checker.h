// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CHECK_CHECKER_H
#define LOCUS_CHECK_CHECKER_H

#include <locus/check/inputs.h>
#include <locus/check/joining.h>

namespace locus {
namespace check {

/// What was verified.
struct Summary {
  std::size_t pairs = 0, patches = 0, cells = 0, singular = 0, arcs = 0;
  std::size_t undecided = 0; ///< cells and other places about which the certificate claims nothing
  std::size_t tolerated = 0; ///< joints that a tolerance made smooth: taken as listed
};

namespace detail {

inline void require(bool holds, const std::string& what)
{
  if (!holds) throw Refused(what);
}

/// Numbers that index others do so, and tables have their sizes.
inline void check_indices(const Certificate& c)
{
  require(c.curves.size() == 1 || c.curves.size() == 2, "there are not one or two curves");
  for (const Curve& curve : c.curves) {
    const Input& in = curve.input;
    require(in.is_monomial || (in.degree > 0 && in.points.size() > cast(in.degree)), "an input has too few points");
    require(in.weights.empty() || in.weights.size() == in.points.size(), "an input has not one weight a point");
    require(in.is_monomial || (in.knots.empty() ? in.points.size() == cast(in.degree) + 1 : in.knots.size() == in.points.size() + cast(in.degree) + 1),
            "an input has too few or too many knots");
    require(std::is_sorted(in.knots.begin(), in.knots.end()), "an input's knots decrease");
  }
  const auto is_pair = [&](const std::array<std::size_t, 2>& p) {
    return p[0] < c.curve(0).pieces.size() && p[1] < c.curve(1).pieces.size() && (!c.is_self() || p[1] <= p[0]);
  };
  for (const auto& pair : c.empty_pairs) require(is_pair(pair), "a pair of pieces is none");
  for (const Line_patch& l : c.lines) {
    require(is_pair(l.pair) && l.line.ratio > 0, "a line is none");
    for (const auto& m : l.meets) require(!m || l.corner || ((*m)[0] < c.patches.size() && (*m)[1] < c.patches[(*m)[0]].vertices.size()), "a line meets nothing");
  }
  for (std::size_t k = 0; k < c.patches.size(); ++k) {
    const Patch& p = c.patches[k];
    require(is_pair(p.pair), "a patch has no pair");
    for (const Patch_piece& piece : p.pieces)
      require(piece.from < p.vertices.size() && piece.to < p.vertices.size(), "patch " + std::to_string(k) + ": a piece has no vertex");
    for (const Vertex& v : p.vertices)
      for (const Range& x : v.at) require(x.lo <= x.hi && (v.cell || (x.lo >= 0 && x.hi <= 1)), "patch " + std::to_string(k) + ": a vertex has no range");
  }
}

} // namespace detail

/// Verifies a certificate in exact arithmetic. Throws Refused, with what failed and where.
inline Summary check(const Certificate& c)
{
  detail::check_indices(c);
  Summary s;
  for (std::size_t k = 0; k < c.curves.size(); ++k) {
    Input_check(c.curves[k], k).run();
    for (const Joint j : c.curves[k].joints) s.tolerated += j == Joint::tolerance;
  }
  for (std::size_t k = 0; k < c.patches.size(); ++k) {
    Patch_check patch(c, k);
    patch.run();
    s.cells += patch.leaves;
    s.singular += patch.singular;
    s.undecided += patch.undecided;
  }
  Joining_check(c).run();
  s.pairs = c.empty_pairs.size();
  s.patches = c.patches.size();
  s.arcs = c.arcs.size();
  s.undecided += c.undecided.size() + c.unproved.size();
  return s;
}

} // namespace check
} // namespace locus

#endif
