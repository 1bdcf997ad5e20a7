// SPDX-License-Identifier: LGPL-3.0-or-later
// What certainty costs: the solver's subdivision of F3, with its error bounds and whatever its filters hand on to slower
// arithmetic, against the same cuts and sign tests on the same cells in plain doubles. Fails where it is above 1.3 times.
#include "cases.h"
#include "side_by_side.h"

#include <locus/bisector_2.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>

namespace {

using locus::Bernstein;
using locus::Box;
using locus::Claim;
using locus::Claim_kind;
using locus::Degrees;
using locus::Interval;
using locus_benchmark::Case;
using locus_benchmark::keep;
using Clock = std::chrono::steady_clock;

constexpr double allowed_ratio = 1.3;
constexpr int random_pairs = 50;
constexpr int rounds = 30, repeats = 25;
constexpr const char* random_name = "random cubics";

// ------------------------------------------------------------------------------------------------ what is solved

/// An equation whose coefficients on the unit cell are there already: their construction is no part of a subdivision.
class Prepared_equation final : public locus::Equation<2> {
public:
  explicit Prepared_equation(std::shared_ptr<const locus::Equation<2>> equation)
    : equation_(std::move(equation)), whole_(equation_->enclosure(Box<2>::unit()))
  {
  }

  Degrees<2> degrees() const override { return equation_->degrees(); }
  Bernstein<Interval, 2> enclosure(const Box<2>& box) const override
  {
    const bool is_whole = box.lo[0] == 0 && box.lo[1] == 0 && box.hi[0] == 1 && box.hi[1] == 1;
    return is_whole ? whole_ : equation_->enclosure(box);
  }
  const Bernstein<locus::Scaled_integer, 2>& exact() const override { return equation_->exact(); }

  Bernstein<double, 2> plain() const
  {
    return locus::converted<double>(whole_, [](const Interval& c) { return locus::midpoint(c); });
  }

private:
  std::shared_ptr<const locus::Equation<2>> equation_;
  Bernstein<Interval, 2> whole_;
};

/// Keeps a solve's claims.
class Recorder final : public locus::Claim_observer<2> {
public:
  void on_claim(const Claim<2>& claim) override { claims.push_back(claim); }

  std::vector<Claim<2>> claims;
};

/// One equation with the cells that the solver makes of it.
struct Problem {
  std::string name;
  std::shared_ptr<const Prepared_equation> equation;
  locus::System<1, 2> system;
  std::vector<Claim<2>> claims; ///< one a cell, in the order of their examination
};

/// F3 of a pair of Bézier curves that do not meet, without its causes: those are systems of their own. Nothing for others.
std::optional<Problem> problem_of(const Case& c)
{
  locus::Bisector_options options;
  options.keep_evidence = true;
  const auto result = locus::untrimmed_bisector(c.first.curve(), c.second.curve(), options);
  const auto* evidence = dynamic_cast<const locus::detail::Planar_evidence*>(result.evidence().get());
  if (!evidence || evidence->solves.size() != 1 || evidence->solves[0].problem.axis) return std::nullopt;
  for (const Claim<2>& claim : evidence->solves[0].claims)
    if (claim.kind == Claim_kind::crossing || claim.kind == Claim_kind::undecided) return std::nullopt;
  Problem p;
  p.name = c.name;
  locus::with_upward_rounding([&] {
    p.equation = std::make_shared<const Prepared_equation>(evidence->solves[0].system().equations[0]);
    p.system.equations[0] = p.equation;
    Recorder recorder;
    keep(locus::solve_curves(p.system, {}, &recorder));
    p.claims = std::move(recorder.claims);
  });
  return p;
}

std::vector<Problem> general_problems()
{
  std::vector<Problem> problems;
  for (const Case& c : {locus_benchmark::quad_quad(), locus_benchmark::cubic_cubic()})
    problems.push_back(problem_of(c).value());
  std::mt19937_64 engine(20240607);
  const auto coordinate = [&] { return static_cast<double>(engine() % 257) / 64 - 2; };
  while (problems.size() < 2 + random_pairs) {
    Case c{random_name, {}, {}};
    for (auto* curve : {&c.first, &c.second})
      for (int i = 0; i < 4; ++i) {
        const double x = coordinate(), y = coordinate();
        curve->points.push_back({x, y});
      }
    if (auto p = problem_of(c)) problems.push_back(std::move(*p));
  }
  return problems;
}

// -------------------------------------------------------------------------------------- subdivision in plain doubles

struct Extent {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;

  void add(double x)
  {
    lo = x < lo ? x : lo;
    hi = x > hi ? x : hi;
  }
  bool has_sign() const { return lo > 0 || hi < 0; }
  double largest() const { return std::max(std::abs(lo), std::abs(hi)); }
  double smallest() const { return std::min(std::abs(lo), std::abs(hi)); }
};

/// The solver's subdivision without any error bound: the same tests and choices on the same kernels, and the same record of
/// cells and of the segments between them, from which arcs would be traced.
class Plain_subdivision {
public:
  explicit Plain_subdivision(const Bernstein<double, 2>& f) : degrees_(f.degrees()), count_(f.size())
  {
    cells_.reserve(64);
    arena_.reserve(64 * count_);
    cells_.push_back({});
    arena_.assign(f.coefficients().begin(), f.coefficients().end());
    for (int v = 0; v < 2; ++v)
      for (int side = 0; side < 2; ++side)
        cells_[0].faces[index(v)][index(side)] = add_segment({v, static_cast<double>(side), 0, 1, true, 0});
  }

  void run()
  {
    std::vector<std::size_t> level{0}, next;
    while (!level.empty()) {
      for (const std::size_t i : level)
        if (!decide(i)) cut(i, next);
      level.swap(next);
      next.clear();
    }
  }

  /// Whether the cells are those that the solver claimed.
  bool made(const std::vector<Claim<2>>& claims) const
  {
    std::vector<std::size_t> order{0};
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Cell& c = cells_[order[k]];
      if (k >= claims.size() || c.kind != claims[k].kind) return false;
      if (c.box.lo != claims[k].box.lo || c.box.hi != claims[k].box.hi) return false;
      if (c.kind == Claim_kind::graph && c.variable != claims[k].variable) return false;
      if (c.kind != Claim_kind::split) continue;
      order.push_back(c.low_child);
      order.push_back(c.low_child + 1);
    }
    return order.size() == claims.size();
  }

private:
  struct Segment {
    int fixed_variable;
    double fixed, lo, hi;
    bool on_boundary;
    std::size_t source;
  };

  struct Cell {
    Box<2> box = Box<2>::unit();
    Claim_kind kind = Claim_kind::split;
    int variable = 0, depth = 0;
    std::size_t parent = 0, low_child = 0;
    std::array<std::array<std::size_t, 2>, 2> faces{};
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const double* coefficients(std::size_t i) const { return arena_.data() + i * count_; }

  std::size_t add_segment(const Segment& s)
  {
    segments_.push_back(s);
    return segments_.size() - 1;
  }

  bool decide(std::size_t i)
  {
    Extent range;
    for (std::size_t k = 0; k < count_; ++k) range.add(coefficients(i)[k]);
    if (range.has_sign()) {
      cells_[i].kind = Claim_kind::empty;
      return true;
    }
    difference_ = {differences(i, 0), differences(i, 1)};
    const int preferred = steadiness(1) > steadiness(0) ? 1 : 0;
    for (const int pivot : {preferred, 1 - preferred}) {
      if (!difference_[index(pivot)].has_sign()) continue;
      cells_[i].kind = Claim_kind::graph;
      cells_[i].variable = pivot;
      return true;
    }
    return false;
  }

  Extent differences(std::size_t i, int variable) const
  {
    const locus::Layout layout = locus::layout_along(degrees_, variable);
    const std::size_t block = layout.count * layout.inner;
    const double* const c = coefficients(i);
    Extent d;
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t k = 0; k + layout.inner < block; ++k) d.add(c[o * block + k + layout.inner] - c[o * block + k]);
    return d;
  }

  double steadiness(int variable) const
  {
    const Extent& d = difference_[index(variable)];
    return d.has_sign() ? d.smallest() / d.largest() : -1;
  }

  int cut_variable(const Box<2>& box) const
  {
    const double first = degrees_[0] * difference_[0].largest(), second = degrees_[1] * difference_[1].largest();
    if (box.width(0) > 8 * box.width(1) && 16 * first > second) return 0;
    if (box.width(1) > 8 * box.width(0) && 16 * second > first) return 1;
    return second > first ? 1 : 0;
  }

  void cut(std::size_t i, std::vector<std::size_t>& next)
  {
    const std::size_t low = cells_.size(), high = low + 1;
    cells_.resize(low + 2);
    arena_.resize(cells_.size() * count_);
    Cell& parent = cells_[i];
    const int variable = cut_variable(parent.box);
    const std::size_t v = index(variable), w = 1 - v;
    const double at = parent.box.lo[v] + 0.5 * parent.box.width(variable);
    double* const base = arena_.data();
    const locus::Layout layout = locus::layout_along(degrees_, variable);
    locus::detail::split_kernel(base + i * count_, base + low * count_, base + high * count_, layout,
                                [](double a, double b) { return 0.5 * (a + b); });
    parent.variable = variable;
    parent.low_child = low;
    const std::size_t shared = add_segment({variable, at, parent.box.lo[w], parent.box.hi[w], false, low});
    for (const std::size_t c : {low, high}) {
      Cell& child = cells_[c];
      child.box = parent.box;
      child.faces = parent.faces;
      child.parent = i;
      child.depth = parent.depth + 1;
      (c == low ? child.box.hi : child.box.lo)[v] = at;
      child.faces[v][c == low ? 1 : 0] = shared;
      next.push_back(c);
    }
  }

  Degrees<2> degrees_;
  std::size_t count_;
  std::vector<Cell> cells_;
  std::vector<double> arena_;
  std::vector<Segment> segments_;
  std::array<Extent, 2> difference_; ///< of the cell at hand
};

// -------------------------------------------------------------------------------------------------------- timing

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

struct Seconds {
  double subdivision = 0, solve = 0;
};

/// Reports the end of the subdivision, when no cell is left, and counts the reports, one for each level.
struct Level_watch {
  Clock::time_point last;
  std::size_t levels = 0;

  void operator()(std::size_t, std::size_t open)
  {
    ++levels;
    if (open == 0) last = Clock::now();
  }
};

/// What one report takes at least, in and out of rounding to nearest: no work of the solver's.
double report_seconds()
{
  Level_watch watch;
  const std::function<void(std::size_t, std::size_t)> progress = std::ref(watch);
  constexpr std::size_t many = 1000;
  double least = 1;
  locus::with_upward_rounding([&] {
    for (int round = 0; round < rounds; ++round) {
      const auto start = Clock::now();
      for (std::size_t i = 0; i < many; ++i) locus::with_nearest_rounding([&] { progress(i, i + 1); });
      least = std::min(least, seconds_between(start, Clock::now()) / many);
    }
  });
  return least;
}

/// The solver as it is, without the time of its reports.
Seconds filtered(const Problem& p, double one_report)
{
  Seconds sum;
  Level_watch watch;
  locus::Solve_control control;
  control.progress = std::ref(watch);
  locus::with_upward_rounding([&] {
    for (int i = 0; i < repeats; ++i) {
      const auto start = Clock::now();
      keep(locus::solve_curves(p.system, control));
      sum.solve += seconds_between(start, Clock::now());
      sum.subdivision += seconds_between(start, watch.last);
    }
  });
  const double reports = static_cast<double>(watch.levels) * one_report;
  return {(sum.subdivision - reports) / repeats, (sum.solve - reports) / repeats};
}

double plain(const Bernstein<double, 2>& f)
{
  const auto start = Clock::now();
  for (int i = 0; i < repeats; ++i) {
    Plain_subdivision subdivision(f);
    subdivision.run();
    keep(subdivision);
  }
  return seconds_between(start, Clock::now()) / repeats;
}

struct Result {
  Seconds filtered;
  double plain = 0;

  Result& operator+=(const Result& r)
  {
    filtered.subdivision += r.filtered.subdivision;
    filtered.solve += r.filtered.solve;
    plain += r.plain;
    return *this;
  }
};

/// The least of several rounds in turns: noise only adds.
Result measured(const Problem& p, double one_report)
{
  const Bernstein<double, 2> f = p.equation->plain();
  Plain_subdivision subdivision(f);
  subdivision.run();
  if (!subdivision.made(p.claims)) {
    std::fprintf(stderr, "%s: plain doubles make other cells\n", p.name.c_str());
    std::exit(1);
  }
  Result least{{1, 1}, 1};
  for (int round = 0; round < rounds; ++round) {
    const Seconds here = filtered(p, one_report);
    least.filtered.subdivision = std::min(least.filtered.subdivision, here.subdivision);
    least.filtered.solve = std::min(least.filtered.solve, here.solve);
    least.plain = std::min(least.plain, plain(f));
  }
  return least;
}

void print(const std::string& name, std::size_t cells, const Result& r)
{
  std::printf("  %-24s %6zu cells  plain %9.2f µs  filtered %9.2f µs  ratio %.2f  (whole solve %.2f µs)\n",
              name.c_str(), cells, 1e6 * r.plain, 1e6 * r.filtered.subdivision, r.filtered.subdivision / r.plain,
              1e6 * r.filtered.solve);
}

} // namespace

int main()
{
  std::printf("Subdivision of F3 over the same cells, in plain doubles and as the solver does it: least of %d rounds\n",
              rounds);
  Result sum{{0, 0}, 0}, random_sum{{0, 0}, 0};
  std::size_t cells = 0, random_cells = 0;
  const double one_report = report_seconds();
  for (const Problem& p : general_problems()) {
    const Result r = measured(p, one_report);
    const bool is_random = p.name == random_name;
    sum += r;
    cells += p.claims.size();
    if (!is_random) print(p.name, p.claims.size(), r);
    if (!is_random) continue;
    random_sum += r;
    random_cells += p.claims.size();
  }
  print(std::to_string(random_pairs) + " random cubic pairs", random_cells, random_sum);
  print("all", cells, sum);
  const double ratio = sum.filtered.subdivision / sum.plain;
  if (ratio <= allowed_ratio) return 0;
  std::fprintf(stderr, "filtered subdivision takes %.2f times the time of plain doubles, more than %.1f\n", ratio,
               allowed_ratio);
  return 1;
}
