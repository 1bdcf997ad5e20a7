// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_FACE_CROSSINGS_H
#define LOCUS_ZERO_SET_FACE_CROSSINGS_H

#include <locus/zero_set/points.h>
#include <locus/zero_set/roots.h>
#include <locus/zero_set/solve_control.h>
#include <locus/zero_set/system.h>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace locus {
namespace detail {

/// An equation in D variables on a flat part of a plane x_v = c, as an equation in the D-1 others on the unit cell.
template <int D>
class Face_equation final : public Equation<D - 1> {
public:
  /// `box` is flat in `variable`.
  Face_equation(std::shared_ptr<const Equation<D>> equation, int variable, const Box<D>& box)
    : equation_(std::move(equation)), variable_(variable), box_(box),
      form_(face(equation_->enclosure(box), variable, false))
  {
  }

  Degrees<D - 1> degrees() const override { return form_.degrees(); }

  Bernstein<Interval, D - 1> enclosure(const Box<D - 1>& part) const override
  {
    Bernstein<Interval, D - 1> f = form_;
    for (int k = 0; k < D - 1; ++k) {
      const auto kk = static_cast<std::size_t>(k);
      if (part.lo[kk] != 0 || part.hi[kk] != 1) f = restrict_to(f, k, Interval(part.lo[kk]), Interval(part.hi[kk]));
    }
    return f;
  }

  const Bernstein<Scaled_integer, D - 1>& exact() const override
  {
    std::call_once(made_, [this] { exact_ = make_exact(); });
    return exact_;
  }

private:
  Bernstein<Scaled_integer, D - 1> make_exact() const
  {
    const auto v = static_cast<std::size_t>(variable_);
    Bernstein<Scaled_integer, D> f = equation_->exact();
    for (int k = 0; k < D; ++k) {
      const auto kk = static_cast<std::size_t>(k);
      if (k != variable_ && (box_.lo[kk] != 0 || box_.hi[kk] != 1))
        f = restrict_to(f, k, Rational(box_.lo[kk]), Rational(box_.hi[kk]));
    }
    return face(split(f, variable_, Rational(box_.lo[v])).first, variable_, true);
  }

  std::shared_ptr<const Equation<D>> equation_;
  int variable_;
  Box<D> box_;
  Bernstein<Interval, D - 1> form_;
  mutable std::once_flag made_;
  mutable Bernstein<Scaled_integer, D - 1> exact_;
};

/// A point where the zero set of D-1 equations crosses a flat part of a plane, transversally: the restricted system is
/// regular there, so the curve's tangent does not lie in the plane.
template <int D>
struct Face_crossing {
  std::array<Interval, static_cast<std::size_t>(D)> at;
  /// For each variable: 0 or 1 where the point lies exactly on that end of the part; -1 where it certainly does not.
  std::array<int, static_cast<std::size_t>(D)> end;
  Box<D> unique_in; ///< no other zero on the plane there
  int vertex = -1;

  Face_crossing() { end.fill(-1); }
};

/// Finds the crossings of a part of a plane; whatever is not regular there becomes an undecided box.
template <int D>
struct Face_crossings {
  std::vector<Face_crossing<D>> points;
  std::vector<Box<D>> undecided;
  std::size_t cells = 0; ///< that the search took

  /// `box` is flat in `variable`. Needs upward rounding.
  Face_crossings(const System<D - 1, D>& system, int variable, const Box<D>& box, const Solve_control& control)
    : variable_(variable), box_(box)
  {
    std::array<std::shared_ptr<const Equation<D - 1>>, static_cast<std::size_t>(D - 1)> equations;
    bool may_vanish = false;
    for (std::size_t k = 0; k < equations.size(); ++k) {
      auto e = std::make_shared<Face_equation<D>>(system.equations[k], variable, box);
      const Range r = range(e->enclosure(Box<D - 1>::unit()));
      if (r == Range::strict) return;
      may_vanish = may_vanish || r == Range::zero;
      equations[k] = std::move(e);
    }
    if (may_vanish) undecided.push_back(box); // one of the polynomials seems to vanish on all of it
    else if constexpr (D == 2) find_roots(*equations[0]);
    else find_points(equations, control);
  }

private:
  enum class Range : unsigned char { strict, zero, mixed };

  static Range range(const Bernstein<Interval, D - 1>& f)
  {
    bool positive = true, negative = true, zero = true;
    for (const Interval& c : f.coefficients()) {
      positive = positive && c.inf() > 0;
      negative = negative && c.sup() < 0;
      zero = zero && contains_zero(c);
    }
    return positive || negative ? Range::strict : zero ? Range::zero : Range::mixed;
  }

  void find_roots(const Equation<1>& e)
  {
    Filter_counts counts;
    const auto form = [&](double lo, double hi) {
      Box<1> part;
      part.lo[0] = lo;
      part.hi[0] = hi;
      return bounded(e.enclosure(part));
    };
    const Univariate f(
      form(0, 1), 0, 1, [&] { return e.exact(); }, &counts, form);
    Root_set<double> set = isolate_roots(f);
    cells = 1;
    if (set.identically_zero || !set.complete) undecided.push_back(box_);
    if (set.identically_zero || !set.complete) return;
    for (Isolated_root<double>& root : set.roots) {
      Isolated_solution<1> p;
      p.unique_in.lo[0] = root.lo;
      p.unique_in.hi[0] = root.hi;
      refine_root(f, root, 1e-15, 0x1p-41);
      p.box[0] = Interval(root.lo, root.hi);
      if (root.is_exact() && (root.lo == 0 || root.lo == 1)) p.face[0] = static_cast<int>(root.lo);
      add(p, root.multiplicity == 1);
    }
  }

  template <class Equations>
  void find_points(const Equations& equations, const Solve_control& control)
  {
    const auto solved = solve_points<D - 1>(equations, control);
    cells = solved.cells;
    for (const auto& p : solved.points) add(p, !p.evidence);
    for (const Box<D - 1>& b : solved.undecided) undecided.push_back(lifted(b));
  }

  /// A box of the part's own unit cell as one of the domain.
  Box<D> lifted(const Box<D - 1>& local) const
  {
    Box<D> b = box_;
    for (std::size_t v = 0, k = 0; v < static_cast<std::size_t>(D); ++v) {
      if (static_cast<int>(v) == variable_) continue;
      const Interval x = to_domain(Interval(local.lo[k], local.hi[k]), v);
      b.lo[v] = x.inf();
      b.hi[v] = x.sup();
      ++k;
    }
    return b;
  }

  /// The same rounded inwards: for boxes in which something is unique.
  Box<D> unique_part(const Box<D - 1>& local) const
  {
    Box<D> b = box_;
    for (std::size_t v = 0, k = 0; v < static_cast<std::size_t>(D); ++v) {
      if (static_cast<int>(v) == variable_) continue;
      b.lo[v] = to_domain(Interval(local.lo[k]), v).sup();
      b.hi[v] = to_domain(Interval(local.hi[k]), v).inf();
      ++k;
    }
    return b;
  }

  Interval to_domain(const Interval& u, std::size_t v) const
  {
    return Interval(box_.lo[v]) + u * (Interval(box_.hi[v]) - Interval(box_.lo[v]));
  }

  void add(const Isolated_solution<D - 1>& p, bool is_regular)
  {
    Face_crossing<D> c;
    for (std::size_t v = 0, k = 0; v < static_cast<std::size_t>(D); ++v) {
      if (static_cast<int>(v) == variable_) {
        c.at[v] = Interval(box_.lo[v]);
        continue;
      }
      c.end[v] = p.face[k];
      const Interval x = to_domain(p.box[k++], v);
      c.at[v] = c.end[v] < 0 ? Interval(std::max(box_.lo[v], x.inf()), std::min(box_.hi[v], x.sup()))
                             : Interval(c.end[v] ? box_.hi[v] : box_.lo[v]);
    }
    c.unique_in = unique_part(p.unique_in);
    if (is_regular) points.push_back(c);
    else undecided.push_back(box_of(c));
  }

  static Box<D> box_of(const Face_crossing<D>& c)
  {
    Box<D> b;
    for (std::size_t v = 0; v < static_cast<std::size_t>(D); ++v) {
      b.lo[v] = c.at[v].inf();
      b.hi[v] = c.at[v].sup();
    }
    return b;
  }

  int variable_;
  Box<D> box_;
};

} // namespace detail
} // namespace locus

#endif
