// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CELL_CONTACTS_H
#define LOCUS_CONSTRUCT_CELL_CONTACTS_H

#include <locus/construct/point_cell.h>
#include <locus/function/root_value.h>

#include <functional>

namespace locus {
namespace detail {

/// Where the circle about a stretch's end touches the curve besides at the stretch's own foot.
struct Cell_contact {
  std::size_t piece = 0;
  double lo = 0, hi = 1; ///< of the piece's unit interval; an end of it exactly where lo == hi
};

/// Finds all contacts at an end where the empty circles cease to be so. There the open requirements vanish; which of them do
/// is told by their own boundary points, exactly where two of these cannot be told apart.
class Contact_finder {
public:
  Contact_finder(const Cell_feature& feature, Filter_counts& counts)
    : feature_(feature), counts_(counts), refiner_(feature.requirements, counts)
  {
  }

  /// `side` 0 for the low end of a stretch, 1 for the high one. Places that are known to be contacts are left out.
  std::vector<Cell_contact> at(const Feasible_end& end, int side, const std::function<bool(const Cell_contact&)>& is_known)
  {
    if (end.is_exact()) return at_exactly(end.lo);
    std::vector<Candidate> candidates;
    const double bad = side == 0 ? end.lo : end.hi;
    for (const Open_requirement& r : end.open) collect(r, bad, candidates);
    join_neighbours(candidates);
    const auto is_told = [&](const Candidate& c) { return is_known({c.piece, c.lo, c.hi}); };
    const auto first_told = std::stable_partition(candidates.begin(), candidates.end(), [&](const Candidate& c) { return !is_told(c); });
    const std::vector<Candidate> told(std::make_move_iterator(first_told), std::make_move_iterator(candidates.end()));
    candidates.erase(first_told, candidates.end());
    // What doubles could not tell: beyond the end a contact's requirement fails.
    Requirement_signs signs(feature_.requirements, counts_);
    const auto holds = [&](const Candidate& c) { return signs.at(c.open, bad) != Sign::negative; };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), holds), candidates.end());
    const bool is_only_one = candidates.size() == 1 && std::all_of(told.begin(), told.end(), holds); // which then is what binds
    if (!is_only_one && !candidates.empty()) keep_binding(candidates, end, side);
    std::vector<Cell_contact> contacts;
    for (const Candidate& c : candidates) contacts.push_back(narrowed(c, end));
    return contacts;
  }

private:
  struct Candidate {
    std::size_t piece;
    double lo, hi;
    std::vector<Open_requirement> open;
  };

  /// Contacts are at least this far apart, or neighbours of one: candidates are parts of v's interval of about this width.
  static constexpr double finest = 0x1p-18;
  static constexpr std::size_t most = 100;

  /// Parts of a node on which the requirement may fail at u.
  void collect(const Open_requirement& r, double u, std::vector<Candidate>& candidates)
  {
    const Requirement& requirement = feature_.requirements[r.requirement];
    if (feature_.piece_of[r.requirement] == Cell_feature::no_piece) return;
    const Enclosed_vector a = requirement.a->node(0).f.at(u);
    std::vector<std::size_t> todo{r.node};
    while (!todo.empty()) {
      const std::size_t node = todo.back();
      todo.pop_back();
      const auto& part = requirement.b->node(node);
      table_.make(a, part.f);
      if (std::all_of(table_.c.begin(), table_.c.end(), [&](double x) { return x > table_.error; })) continue;
      // A whole stretch of contacts, as on a circle about the end, is not looked at more closely.
      if (part.width() <= finest || candidates.size() + todo.size() > most) {
        candidates.push_back({feature_.piece_of[r.requirement], part.lo, part.hi, {{r.requirement, node, r.slope}}});
        continue;
      }
      const std::size_t low = requirement.b->halve(node);
      todo.push_back(low + 1);
      todo.push_back(low);
    }
  }

  static void join_neighbours(std::vector<Candidate>& candidates)
  {
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) { return x.piece != y.piece ? x.piece < y.piece : x.lo < y.lo; });
    std::vector<Candidate> joined;
    for (Candidate& c : candidates) {
      if (!joined.empty() && joined.back().piece == c.piece && joined.back().hi >= c.lo) {
        joined.back().hi = std::max(joined.back().hi, c.hi);
        joined.back().open.insert(joined.back().open.end(), c.open.begin(), c.open.end());
      } else {
        joined.push_back(std::move(c));
      }
    }
    candidates = std::move(joined);
  }

  /// The ones that fail as soon as anything does.
  void keep_binding(std::vector<Candidate>& candidates, const Feasible_end& end, int side)
  {
    std::vector<Candidate> kept;
    Feasible_end all = end;
    for (const Candidate& c : candidates) {
      Feasible_end own = end;
      own.algebraic = nullptr;
      own.open = c.open;
      refiner_.narrow(own, side, 0x1p-48);
      if (is_no_looser(own, all, side)) kept.push_back(c);
    }
    candidates = std::move(kept);
  }

  /// Whether the first boundary point fails no later than the second one, seen from inside the stretch.
  bool is_no_looser(Feasible_end& a, Feasible_end& b, int side)
  {
    if (a.hi < b.lo) return side == 1;
    if (b.hi < a.lo) return side == 0;
    if (!refiner_.make_algebraic(a, side) || !refiner_.make_algebraic(b, side)) return true;
    for (double width = 0x1p-60; ; width *= 0x1p-60) {
      const Algebraic_end &x = *a.algebraic, &y = *b.algebraic;
      if (x.hi < y.lo) return side == 1;
      if (y.hi < x.lo) return side == 0;
      if (is_common_root(x, y)) return true;
      refiner_.narrow(a, side, width);
      refiner_.narrow(b, side, width);
    }
  }

  static bool is_common_root(const Algebraic_end& x, const Algebraic_end& y)
  {
    const Rational lo = std::max(x.lo, y.lo), hi = std::min(x.hi, y.hi);
    const Integer_polynomial common = x.polynomial && y.polynomial ? gcd(*x.polynomial, *y.polynomial) : Integer_polynomial{};
    if (degree(common) < 1) return false;
    if (lo == hi) return sign_at(bernstein_form(common), lo) == Sign::zero;
    return !exact_roots(restrict_to(bernstein_form(common), 0, lo, hi), Rational(0), Rational(1)).roots.empty();
  }

  /// The place of least value within a candidate, by the sign of the slope in v for all u of the end's enclosure.
  Cell_contact narrowed(const Candidate& c, const Feasible_end& end)
  {
    Cell_contact contact{c.piece, c.lo, c.hi};
    if (c.hi - c.lo > 64 * finest) return contact; // all of it
    const Requirement& requirement = feature_.requirements[c.open[0].requirement];
    const Enclosed_vector a = requirement.a->node(0).f.over(end.lo, end.hi);
    table_.make(a, requirement.b->node(0).f);
    const auto slope = [&](double v) {
      const double value = value_and_slopes(table_.c.data(), static_cast<int>(table_.columns) - 1, v, scratch_)[1];
      double norm = table_.error;
      for (const double x : table_.c) norm = std::max(norm, std::abs(x));
      const auto n = static_cast<double>(table_.columns);
      return sign_of(value, 2 * n * table_.error + 16 * n * n * operation_error * norm);
    };
    if (c.lo == 0 && slope(0) == Sign::positive) contact.hi = 0;
    if (c.hi == 1 && slope(1) == Sign::negative) contact.lo = 1;
    for (int step = 0; step < 50 && contact.lo < contact.hi; ++step) {
      const double middle = 0.5 * (contact.lo + contact.hi);
      const Sign s = slope(middle);
      if (!is_strict(s)) break;
      (s == Sign::negative ? contact.lo : contact.hi) = middle;
    }
    return contact;
  }

  /// At a dyadic u: the zeros of the requirements that doubles do not prove to be positive.
  std::vector<Cell_contact> at_exactly(double u)
  {
    std::vector<Cell_contact> contacts;
    Requirement_signs signs(feature_.requirements, counts_);
    for (std::size_t r = 0; r < feature_.requirements.size(); ++r) {
      if (feature_.piece_of[r] == Cell_feature::no_piece || signs.filtered_at(Open_requirement{r, 0, 0}, u) == Sign::positive) continue;
      const Requirement& q = feature_.requirements[r];
      const Bernstein<Scaled_integer, 1> g(product_at(q.a->exact(), Rational(u), q.b->exact()));
      if (g.is_zero()) continue;
      for (auto& root : exact_roots(g, Rational(0), Rational(1)).roots) {
        refine_root(root, 50);
        const Interval v = hull(enclosing(root.lo), enclosing(root.hi));
        contacts.push_back({feature_.piece_of[r], v.inf(), v.sup()});
      }
    }
    return contacts;
  }

  const Cell_feature& feature_;
  Filter_counts& counts_;
  Feasible_end_refiner refiner_;
  Product_table table_;
  std::vector<double> scratch_;
};

} // namespace detail
} // namespace locus

#endif
