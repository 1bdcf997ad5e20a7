// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_ARC_TRIMMING_H
#define LOCUS_CONSTRUCT_ARC_TRIMMING_H

#include <locus/construct/arc_circles.h>
#include <locus/number/zero_of_roots.h>

#include <set>

namespace locus {
namespace detail {

/// Where circles along an arc cease to be empty: the place on a step, and what is touched there besides the feet.
struct Arc_event {
  std::size_t step = 0;
  Placed place;
  std::array<Range, 2> parameters; ///< of both inputs
  std::array<Contact_foot, 2> feet;
  Contact_list contacts;  ///< parts and vertices one of which at least is touched
};

/// A part of an arc along which the circles are empty; where it does not begin or end with the arc, at events.
struct Empty_part {
  Arc_part part;
  std::array<std::optional<Arc_event>, 2> ends;
  std::array<bool, 2> is_open{}; ///< beyond an end nothing is known
  bool is_all = false;           ///< all of a closed arc
};

/// Finds the parts of one arc whose circles are empty.
///
/// Let q(s) run along the arc, with feet A and B, and let C be another point of an input. The power of C changes with s by
/// -2⟨C - A, q'⟩, since |A - q| is least at A; and q' is perpendicular to the chord B - A. So while the circles are empty near
/// their feet, where q' does not vanish, a third contact on one side of the chord can only end their being empty, and one on the
/// other side only begin it. Over a part of the arc with all possible contacts on one side the answers at both ends tell all.
class Arc_trimmer {
public:
  Arc_trimmer(const Arc_steps& steps, const std::array<std::size_t, 2>& inputs, Contact_sites& sites, const Solve_control& control)
    : steps_(steps), inputs_(inputs), sites_(sites), search_(sites), control_(control)
  {
  }

  std::vector<Empty_part> run()
  {
    Contact_list all = search_.everything();
    for (std::size_t k = 0; k < steps_.size(); ++k) treat_step(k, all);
    settle_unknown();
    return parts();
  }

  /// Boxes of the inputs' parameters about which nothing is said.
  const std::vector<std::array<Range, 2>>& undecided() const { return undecided_; }
  std::size_t cells() const { return cells_; }

private:
  enum class Answer : unsigned char { empty, nonempty, unknown };
  using Place = Step_circles::Place;

  /// A stretch of the arc with one answer, in the arc's direction, and the event at its end, if that is one. Of an unknown one, what
  /// may happen there, and the side of the chord on which all possible contacts lie.
  struct Section {
    std::size_t step;
    double from, to; ///< base values
    Answer answer;
    std::optional<Arc_event> event;
    Sign side = Sign::unknown;
  };

  static constexpr double least_width = 0x1p-44; ///< of base values
  static constexpr std::size_t most_unknown = 16; ///< places of an arc after which the rest of it is given up

  void treat_step(std::size_t k, const Contact_list& all)
  {
    Step_circles circles(steps_, k, inputs_, sites_);
    step_ = k;
    circles_ = &circles;
    const bool reversed = circles.stretch().reversed;
    std::vector<Section> found;
    found_ = &found;
    if (circles.is_half_branch()) {
      treat_half_branch(all);
    } else {
      const auto ends = circles.ends();
      treat(ends[0], ends[1], all, Answer::unknown, Answer::unknown);
    }
    if (reversed) {
      std::reverse(found.begin(), found.end());
      for (std::size_t i = 0; i < found.size(); ++i) {
        std::swap(found[i].from, found[i].to);
        if (found[i].answer == Answer::unknown) continue; // its event is its own
        const bool has_next = i + 1 < found.size() && found[i + 1].answer != Answer::unknown;
        found[i].event = has_next ? std::move(found[i + 1].event) : std::nullopt;
      }
    }
    sections_.insert(sections_.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  }

  std::optional<Contact_list> search(const Arc_circles& c, const Contact_list& list)
  {
    ++cells_;
    return search_.examine(c.circle, c.feet, list);
  }

  void add(double lo, double hi, Answer answer) { found_->push_back({step_, lo, hi, answer, {}, Sign::unknown}); }

  void add_unknown(double lo, double hi, Arc_event event, Sign side)
  {
    const std::vector<Section>& before = found_->empty() ? sections_ : *found_;
    const bool goes_on = is_strict(side) && !before.empty() && before.back().answer == Answer::unknown && before.back().side == side;
    if (!goes_on) ++unknown_; // one change that errors hide may take many parts
    found_->push_back({step_, lo, hi, Answer::unknown, std::move(event), side});
  }

  void treat_half_branch(const Contact_list& all)
  {
    const Arc_circles over = circles_->over_half_branch();
    const std::optional<Circle> disc = circles_->disc_of_half_branch();
    const auto list = search(over, disc ? search_.within(*disc, all) : all);
    Answer answer = Answer::nonempty;
    if (list) answer = !list->has_open() && search_.are_feet_free(*list, over.feet) ? answer_of(circles_->at_outer_end(), *list) : Answer::unknown;
    if (answer != Answer::unknown) return add(0, 1, answer);
    const Placed place = steps_.over_half_branch(circles_->stretch(), steps_.place_vertex(circles_->stretch(), circles_->stretch().piece->from));
    add_unknown(0, 1, event_at(place, over.feet, {}), Sign::unknown);
  }

  Arc_event event_at(const Placed& place, const std::array<Contact_foot, 2>& feet, Contact_list contacts) const
  {
    return {step_, place, place.patch->parameters(place.at), feet, std::move(contacts)};
  }

  /// From one place to another, given what may be touched there; answers at the ends where they are known.
  void treat(const Place& lo, const Place& hi, const Contact_list& all, Answer at_lo, Answer at_hi)
  {
    if (unknown_ >= most_unknown) return add_unknown(lo.base, hi.base, event_at(circles_->placed_over(lo, hi), {}, {}), Sign::unknown);
    const std::optional<Place> middle = circles_->between(lo, hi);
    const Arc_circles over = circles_->over(lo, hi, middle);
    const auto list = search(over, all);
    if (!list) return add(lo.base, hi.base, Answer::nonempty);
    Answer at_middle = Answer::unknown;
    Sign side = Sign::unknown;
    if (search_.are_feet_free(*list, over.feet)) {
      if (!list->has_open()) {
        if (middle) at_middle = answer_at(*middle, *list);
        if (at_middle == Answer::unknown) at_middle = answer_somewhere(lo, hi, *list);
        if (at_middle != Answer::unknown) return add(lo.base, hi.base, at_middle);
      } else if (side = search_.side_of_chord(*list, over.feet); is_strict(side)) {
        if (at_lo == Answer::unknown) at_lo = answer_at(lo, *list);
        if (at_hi == Answer::unknown) at_hi = answer_at(hi, *list);
        if (at_lo != Answer::unknown && at_hi != Answer::unknown) return at_lo == at_hi ? add(lo.base, hi.base, at_lo) : locate(lo, hi, *list, at_lo, side);
      }
    }
    if (!middle || !(hi.base - lo.base > least_width) || cells_ > control_.max_cells || control_.is_cancelled()) {
      return add_unknown(lo.base, hi.base, event_at(circles_->placed_over(lo, hi), over.feet, *list), side);
    }
    const Contact_list rest = search_.widened(*list, over.feet);
    const Step_circles* all_of_step = circles_;
    const std::optional<Step_circles> part = over.is_loose ? circles_->restricted(lo, hi) : std::nullopt;
    if (part) circles_ = &*part;
    treat(lo, *middle, rest, at_lo, at_middle);
    treat(*middle, hi, rest, at_middle, at_hi);
    circles_ = all_of_step;
  }

  Answer answer_somewhere(const Place& lo, const Place& hi, const Contact_list& list)
  {
    for (const double f : {0.3125, 0.6875, 0.0625, 0.9375})
      if (const auto place = circles_->between(lo, hi, f))
        if (const Answer answer = answer_at(*place, list); answer != Answer::unknown) return answer;
    for (const Place& end : {lo, hi})
      if (const Answer answer = answer_at(end, list); answer != Answer::unknown) return answer;
    return Answer::unknown;
  }

  Answer answer_at(const Place& place, const Contact_list& list) { return answer_of(circles_->at(place), list); }

  Answer answer_of(const Arc_circles& c, const Contact_list& list)
  {
    const auto rest = search(c, list);
    if (!rest) return Answer::nonempty;
    return rest->has_open() || rest->has_pending() ? Answer::unknown : Answer::empty;
  }

  /// One change of the answer between two places: where, as closely as doubles tell.
  void locate(Place lo, Place hi, const Contact_list& list, Answer at_lo, Sign side)
  {
    const double first = lo.base, last = hi.base;
    while (hi.base - lo.base > 0x1p-52) {
      const auto middle = circles_->between(lo, hi);
      const Answer answer = middle ? answer_at(*middle, list) : Answer::unknown;
      if (answer == Answer::unknown) break;
      (answer == at_lo ? lo : hi) = *middle;
    }
    const Arc_circles over = circles_->over(lo, hi, circles_->between(lo, hi));
    Arc_event event = event_at(circles_->placed_over(lo, hi), over.feet, {});
    if (auto contacts = search(over, list)) event.contacts = std::move(*contacts);
    found_->push_back({step_, first, lo.base, at_lo, std::move(event), side});
    add(hi.base, last, at_lo == Answer::empty ? Answer::nonempty : Answer::empty);
  }

  // ----------------------------------------------------------------------------------------------------- the arc

  /// Unknown sections side by side with all contacts on one side of the chord, as where an event is at the end of a step: one change
  /// between different answers, none between equal ones. All others are reported.
  void settle_unknown()
  {
    std::vector<Section> settled;
    for (std::size_t i = 0; i < sections_.size();) {
      if (sections_[i].answer != Answer::unknown) {
        settled.push_back(std::move(sections_[i++]));
        continue;
      }
      std::size_t end = i;
      bool is_one_sided = true;
      for (; end < sections_.size() && sections_[end].answer == Answer::unknown; ++end)
        is_one_sided = is_one_sided && is_strict(sections_[end].side) && sections_[end].side == sections_[i].side;
      const bool has_answers = i > 0 && end < sections_.size();
      const bool is_settled = has_answers && settled.back().answer == sections_[end].answer &&
                              (is_one_sided || (settled.back().answer == Answer::nonempty && is_tie_of_lines(i, end)));
      if (is_one_sided && has_answers && !is_settled) {
        Arc_event event = std::move(*sections_[i].event);
        for (std::size_t k = i + 1; k < end; ++k) widen(event, *sections_[k].event);
        settled.back().event = std::move(event);
      } else {
        const Answer answer = is_settled ? settled.back().answer : Answer::unknown;
        for (std::size_t k = i; k < end; ++k) {
          if (!is_settled) undecided_.push_back(sections_[k].event->parameters);
          sections_[k].answer = answer;
          sections_[k].event.reset();
          settled.push_back(std::move(sections_[k]));
        }
      }
      i = end;
    }
    sections_ = std::move(settled);
    drop_crumbs();
  }

  /// Whether unknown sections between nonempty ones are a place where circles touch two straight pieces besides two as feet, all four
  /// at once, exactly: one contact ends there where the other begins, so that one circle is empty and no arc.
  bool is_tie_of_lines(std::size_t first, std::size_t end) const
  {
    std::set<std::size_t> touched;
    for (std::size_t k = first; k < end; ++k) {
      const Arc_event& event = *sections_[k].event;
      if (!event.contacts.vertices.empty()) return false;
      for (const Contact_foot& f : event.feet) touched.insert(f.site);
      for (const Contact_leaf& l : event.contacts.leaves)
        if (l.is_open() || l.is_monotone()) touched.insert(l.site);
    }
    if (touched.size() != 4) return false;
    const Vector_2<Interval>& q = sections_[first].event->place.point;
    std::array<std::array<Rational, 3>, 4> line;
    std::array<int, 4> side{};
    std::size_t i = 0;
    for (const std::size_t site : touched) {
      line[i] = sites_[site].line;
      const Sign s = sites_[site].is_line ? sign_of(enclosing(line[i][0]) * q.x + enclosing(line[i][1]) * q.y + enclosing(line[i][2])) : Sign::unknown;
      if (!is_strict(s)) return false;
      side[i++] = s == Sign::positive ? 1 : -1;
    }
    return have_common_circle(line, side);
  }

  /// Lines ax + by + c = 0 with their sides have a common touching circle: x, y, 1 and -r solve ax + by + c - r·side·√(a² + b²) = 0.
  static bool have_common_circle(const std::array<std::array<Rational, 3>, 4>& line, const std::array<int, 4>& side)
  {
    std::array<Signed_root, 4> terms; // of the determinant, by its last column
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<const std::array<Rational, 3>*, 3> m{};
      for (std::size_t k = 0, j = 0; k < 4; ++k)
        if (k != i) m[j++] = &line[k];
      const auto &a = *m[0], &b = *m[1], &c = *m[2];
      const Rational minor = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
      terms[i] = Signed_root((i % 2 ? 1 : -1) * side[i] * minor, line[i][0] * line[i][0] + line[i][1] * line[i][1]);
    }
    return is_zero_sum(terms);
  }

  /// What is shorter than can be told from its ends, between parts that are not decided, is not decided either.
  void drop_crumbs()
  {
    const auto is_unknown = [&](std::size_t i) { return sections_[i].answer == Answer::unknown; };
    for (std::size_t first = 1; first < sections_.size(); ++first) {
      if (!is_unknown(first - 1) || is_unknown(first)) continue;
      std::size_t end = first;
      double length = 0;
      for (; end < sections_.size() && !is_unknown(end) && !sections_[end].event; ++end) length += std::abs(sections_[end].to - sections_[end].from);
      if (end == sections_.size() || !is_unknown(end) || length > 0x1p-20) continue;
      for (std::size_t i = first; i < end; ++i) {
        if (sections_[i].answer == Answer::empty) note_undecided(sections_[i]);
        sections_[i].answer = Answer::unknown;
      }
    }
  }

  void note_undecided(const Section& s)
  {
    const Step_circles circles(steps_, s.step, inputs_, sites_);
    const auto ends = circles.ends();
    const double lo = ends[0].base, length = ends[1].base - lo;
    std::optional<std::array<Range, 2>> box;
    for (const double base : {s.from, s.to}) {
      const auto place = circles.between(ends[0], ends[1], (base - lo) / length);
      const Placed p = circles.placed_over(place.value_or(ends[0]), place.value_or(ends[0]));
      const auto parameters = p.patch->parameters(p.at);
      if (!box) box = parameters;
      for (std::size_t v = 0; v < 2; ++v) (*box)[v] = {std::min((*box)[v].lo, parameters[v].lo), std::max((*box)[v].hi, parameters[v].hi)};
    }
    undecided_.push_back(*box);
  }

  static void widen(Arc_event& event, const Arc_event& other)
  {
    for (std::size_t v = 0; v < 2; ++v)
      event.parameters[v] = {std::min(event.parameters[v].lo, other.parameters[v].lo), std::max(event.parameters[v].hi, other.parameters[v].hi)};
    event.place.point = {hull(event.place.point.x, other.place.point.x), hull(event.place.point.y, other.place.point.y)};
    event.place.radius = hull(event.place.radius, other.place.radius);
  }

  std::vector<Empty_part> parts() const
  {
    std::vector<Empty_part> all;
    std::optional<Empty_part> open;
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const Section& s = sections_[i];
      const bool begins_step = i == 0 || sections_[i - 1].step != s.step;
      if (s.answer == Answer::empty) {
        if (!open) {
          open.emplace();
          open->part.first = s.step;
          if (!begins_step) open->part.from = s.from;
          if (i > 0) open->ends[0] = sections_[i - 1].event;
          open->is_open[0] = i > 0 && !open->ends[0];
        }
        const bool ends_step = i + 1 == sections_.size() || sections_[i + 1].step != s.step;
        open->part.count = s.step - open->part.first + 1;
        open->part.to = ends_step ? std::nullopt : std::optional(s.to);
        open->ends[1] = s.event;
        open->is_open[1] = i + 1 < sections_.size() && !s.event;
      } else if (open) {
        all.push_back(std::move(*open));
        open.reset();
      }
    }
    if (open) all.push_back(std::move(*open));
    if (steps_.graph_arc().closed) close(all);
    return all;
  }

  /// Of a closed arc the first and the last part are one if both reach the place where its listing starts.
  void close(std::vector<Empty_part>& all) const
  {
    if (sections_.front().answer != Answer::empty || sections_.back().answer != Answer::empty) return;
    if (all.size() == 1) {
      all[0].is_all = true;
      return;
    }
    Empty_part& last = all.back();
    last.part.count += all.front().part.count;
    last.part.to = all.front().part.to;
    last.ends[1] = std::move(all.front().ends[1]);
    last.is_open[1] = all.front().is_open[1];
    all.erase(all.begin());
  }

  const Arc_steps& steps_;
  std::array<std::size_t, 2> inputs_;
  Contact_sites& sites_;
  Contact_search search_;
  const Solve_control& control_;
  const Step_circles* circles_ = nullptr;
  std::size_t step_ = 0, cells_ = 0, unknown_ = 0;
  std::vector<Section>* found_ = nullptr;
  std::vector<Section> sections_;
  std::vector<std::array<Range, 2>> undecided_;
};

} // namespace detail
} // namespace locus

#endif
