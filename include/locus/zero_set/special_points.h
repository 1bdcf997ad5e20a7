// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SPECIAL_POINTS_H
#define LOCUS_ZERO_SET_SPECIAL_POINTS_H

#include <locus/zero_set/critical_points.h>
#include <locus/zero_set/curve_graph.h>
#include <locus/zero_set/solve_control.h>

#include <algorithm>
#include <iterator>

namespace locus {
namespace detail {

/// Boxes that touch, put together to their common hulls.
inline std::vector<Box<2>> clustered(const std::vector<Box<2>>& boxes)
{
  std::vector<Box<2>> clusters;
  for (Box<2> box : boxes)
    for (std::size_t j = 0;;) {
      if (j == clusters.size()) {
        clusters.push_back(box);
        break;
      }
      const Box<2>& other = clusters[j];
      if (other.lo[0] > box.hi[0] || other.hi[0] < box.lo[0] || other.lo[1] > box.hi[1] || other.hi[1] < box.lo[1]) {
        ++j;
        continue;
      }
      for (std::size_t v = 0; v < 2; ++v) {
        box.lo[v] = std::min(box.lo[v], other.lo[v]);
        box.hi[v] = std::max(box.hi[v], other.hi[v]);
      }
      clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(j));
      j = 0;
    }
  return clusters;
}

/// The points of a system's zero set that need care: the solutions of its causes, and singular points without a cause.
class Special_points {
public:
  Special_points(const System<1, 2>& system, const Solve_control& control) : system_(system), control_(control) {}

  std::vector<Isolated_point> points;
  /// What a cause's solver left open, and its index.
  std::vector<std::pair<std::size_t, Box<2>>> undecided;
  std::size_t cells = 0; ///< of the causes' solves

  /// Solves the causes: by intervals where their solutions are regular, else exactly.
  void solve_causes()
  {
    Solve_control limited = control_; // where intervals are slow, elimination is quicker than more digits
    limited.max_cells = std::min<std::size_t>(control_.max_cells, 1000);
    limited.max_bits = std::min<std::size_t>(control_.max_bits, 256);
    for (std::size_t c = 0; c < system_.causes.size(); ++c) {
      const Cause<2>& cause = system_.causes[c];
      const auto solved = solve_points(cause.equations, limited);
      cells += solved.cells;
      for (const Isolated_point& p : solved.points) add(p, c);
      if (solved.undecided.empty()) continue;
      const std::vector<Box<2>> boxes = clustered(solved.undecided);
      const bool needs_them = std::any_of(boxes.begin(), boxes.end(), [&](const Box<2>& box) { return may_hold_zeros(box); });
      if (!needs_them) continue;
      if (!solve_exactly(c, boxes))
        for (const Box<2>& box : boxes) undecided.push_back({c, box});
    }
    in_time([&] { take_over_marks(); }); // those that are left over find no place on an arc
  }

  /// Looks for singular points in parts of the unit cell that subdivision could not settle: by intervals and rational
  /// arithmetic, then by elimination. What a limit leaves open stays open.
  void find_singular_points(const std::vector<Box<2>>& parts)
  {
    in_time([&] { look_for_singular_points(parts); });
  }

  /// Whether intervals leave it open that the system's equation vanishes in a box.
  bool may_hold_zeros(const Box<2>& box) const { return may_vanish(*system_.equations[0], box); }

  bool is_crossing(const Isolated_point& p) const
  {
    return p.cause == no_cause || system_.causes[p.cause].proves == Claim_kind::crossing;
  }

  /// The largest box that is known to have p as its only critical point.
  const std::optional<Box<2>>& alone_box(std::size_t p)
  {
    alone_.resize(points.size());
    if (!alone_[p].is_known) {
      alone_[p].is_known = true;
      in_time([&] {
        if (critical().bits() <= control_.max_bits && critical().is_finite()) alone_[p].box = critical().alone_about(points[p], reach);
      });
    }
    return alone_[p].box;
  }

  const Critical_points& critical()
  {
    if (!critical_) critical_.emplace(system_.equations[0]->exact(), checkpoint());
    return *critical_;
  }

private:
  static constexpr double reach = 0x1p-6;

  /// All solutions of a cause in some boxes; none where a limit stops it or they are not isolated.
  bool solve_exactly(std::size_t c, const std::vector<Box<2>>& boxes)
  {
    const Cause<2>& cause = system_.causes[c];
    const Common_zeros zeros({cause.equations[0]->exact(), cause.equations[1]->exact()}, checkpoint());
    std::vector<Isolated_point> found;
    bool is_finite = false;
    const bool is_done = in_time([&] {
      is_finite = !is_late() && zeros.bits() <= control_.max_bits && zeros.is_finite();
      if (!is_finite) return;
      for (const Box<2>& box : boxes)
        for (const Isolated_point& p : solutions_in(zeros, box)) found.push_back(p);
    });
    if (!is_done || !is_finite) return false;
    for (const Isolated_point& p : found) add(p, c);
    return true;
  }

  void look_for_singular_points(const std::vector<Box<2>>& parts)
  {
    if (critical().bits() > control_.max_bits) return;
    for (const Box<2>& part : clustered(parts)) {
      if (is_late()) return;
      const auto nearby = critical().nearby(part, control_);
      for (const Isolated_point& p : nearby.on_curve) add_singular(p);
      if (nearby.is_complete || is_late()) continue;
      if (!critical().is_finite()) return;
      std::vector<Isolated_point> known;
      std::copy_if(points.begin(), points.end(), std::back_inserter(known), [this](const Isolated_point& p) { return is_crossing(p); });
      std::vector<std::size_t> cause;
      std::vector<std::array<Bernstein<Scaled_integer, 2>, 2>> sufficient;
      for (std::size_t c = 0; c < system_.causes.size(); ++c)
        if (system_.causes[c].proves == Claim_kind::crossing) {
          cause.push_back(c);
          sufficient.push_back({system_.causes[c].equations[0]->exact(), system_.causes[c].equations[1]->exact()});
        }
      for (const Isolated_point& p : critical().on_curve(part, known, sufficient)) {
        if (p.cause == no_cause) add_singular(p);
        else add(p, cause[p.cause]);
      }
    }
  }

  Checkpoint checkpoint() const
  {
    return [this] {
      if (is_late()) throw Stopped();
    };
  }

  /// Elimination takes its time; whether it was not stopped.
  template <class F>
  bool in_time(F f)
  {
    try {
      f();
    } catch (const Stopped&) {
      critical_.reset();
      return false;
    }
    return true;
  }

  bool is_late() const
  {
    return control_.is_cancelled() || std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > control_.max_seconds;
  }

  void add(Isolated_point p, std::size_t cause)
  {
    p.cause = cause;
    p.tag = system_.causes[cause].tag;
    p.also = system_.causes[cause].also;
    if (is_explained(system_.causes[cause], p) || (system_.causes[cause].leave_out && system_.causes[cause].leave_out(p))) return;
    for (const Isolated_point& known : points)
      if (known.cause == cause && (lies_within(known, p.unique_in) || lies_within(p, known.unique_in))) return;
    points.push_back(std::move(p));
  }

  /// A singular point that is no solution of a cause for singular points.
  void add_singular(Isolated_point p)
  {
    for (const Isolated_point& known : points)
      if (is_crossing(known) && lies_within(known, p.unique_in)) return; // that one is critical, too
    p.cause = no_cause;
    p.tag = no_tag;
    take_over_mark(p, [this](const Box<2>& at, const Cause<2>& cause) { return !critical().on_curve(at, cause.equations).empty(); });
    alone_.clear();
    points.push_back(std::move(p));
  }

  /// A solution of another cause that is the singular point p goes over into it. `is_solved` tells whether they are the same,
  /// where their enclosures meet.
  template <class Is_solved>
  bool take_over_mark(Isolated_point& p, const Is_solved& is_solved)
  {
    const Box<2> at = box_of(p.box);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (is_crossing(points[k]) || !overlap(points[k].box[0], p.box[0]) || !overlap(points[k].box[1], p.box[1])) continue;
      const Cause<2>& cause = system_.causes[points[k].cause];
      const bool one_corner = p.face[0] >= 0 && p.face[1] >= 0 && p.face == points[k].face;
      if (!one_corner && !is_solved(at, cause)) continue;
      // All solutions of an included cause are the other one's as well, and mean nothing more.
      if (std::find(cause.includes.begin(), cause.includes.end(), p.cause) == cause.includes.end()) p.also = points[k].tag;
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(k));
      return true;
    }
    return false;
  }

  /// Marks that are solutions of a cause for singular points as well. The order of the points stays.
  void take_over_marks()
  {
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!is_crossing(points[k])) continue;
      Isolated_point p = points[k];
      const bool taken = take_over_mark(p, [&](const Box<2>& at, const Cause<2>& cause) {
        const auto& node = system_.causes[p.cause].equations;
        const Common_zeros both({node[0]->exact(), node[1]->exact(), cause.equations[0]->exact(), cause.equations[1]->exact()}, checkpoint());
        return both.bits() <= control_.max_bits && both.is_finite() && !solutions_in(both, at).empty();
      });
      if (!taken) continue;
      const auto same = [&](const Isolated_point& q) { return q.cause == p.cause && q.box[0].is_same(p.box[0]) && q.box[1].is_same(p.box[1]); };
      const auto here = std::find_if(points.begin(), points.end(), same); // a mark before it may be gone
      *here = p;
      k = static_cast<std::size_t>(here - points.begin());
    }
  }

  static bool lies_within(const Isolated_point& p, const Box<2>& box)
  {
    for (std::size_t v = 0; v < 2; ++v)
      if (!(box.lo[v] < p.box[v].inf() && p.box[v].sup() < box.hi[v])) return false;
    return true;
  }

  /// The point is the solution of an included cause: both lie where this cause has one solution only.
  bool is_explained(const Cause<2>& cause, const Isolated_point& p) const
  {
    for (const Isolated_point& known : points)
      if (std::find(cause.includes.begin(), cause.includes.end(), known.cause) != cause.includes.end() && lies_within(known, p.unique_in))
        return true;
    return false;
  }

  struct Alone {
    bool is_known = false;
    std::optional<Box<2>> box;
  };

  const System<1, 2>& system_;
  const Solve_control& control_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<Alone> alone_;
  std::optional<Critical_points> critical_;
};

} // namespace detail
} // namespace locus

#endif
