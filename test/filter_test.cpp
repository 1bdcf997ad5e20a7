// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support.h"

#include <locus/zero_set/cell_tree.h>

#include <catch2/catch.hpp>

using namespace locus_test;
using locus::Box;
using locus::exact_rational;
using locus::Filter_counts;
using locus::Interval;
using locus::Rung;
using locus::Scaled_integer;
using locus::with_upward_rounding;
using locus::detail::Cell_tree;
using locus::detail::Range_sign;
using locus::detail::Range_sign_of;

namespace {

std::size_t index(Rung r) { return static_cast<std::size_t>(r); }

/// An equation whose enclosures are as wide as asked for: it decides which rungs of the ladder can tell.
class Fuzzy_equation final : public locus::Equation<2> {
public:
  Fuzzy_equation(Bernstein<Rational, 2> f, double radius) : f_(std::move(f)), exact_(f_), radius_(radius) {}

  Degrees<2> degrees() const override { return f_.degrees(); }
  const Bernstein<Scaled_integer, 2>& exact() const override { return exact_; }
  Bernstein<Interval, 2> enclosure(const Box<2>& box) const override
  {
    ++enclosures;
    auto f = locus::converted<Interval>(on(box), [](const Rational& c) { return locus::enclosing(c); });
    // Off the middle, differently for each coefficient and box, up to the ends: what is true may lie anywhere within.
    std::uint64_t hash = 0;
    for (const double x : {box.lo[0], box.hi[0], box.lo[1], box.hi[1]})
      hash = hash * 31 + static_cast<std::uint64_t>(x * 4096);
    for (std::size_t i = 0; radius_ > 0 && i < f.size(); ++i) {
      hash = hash * 6364136223846793005u + 1442695040888963407u;
      const double share = static_cast<double>(hash >> 62) / 3.0;
      f[i] = f[i] + Interval(-2 * radius_ * share, 2 * radius_ * (1 - share));
    }
    return f;
  }

  /// The true coefficients on a box, in one step from the unit cell.
  Bernstein<Rational, 2> on(const Box<2>& box) const
  {
    auto part = f_;
    for (int k = 0; k < 2; ++k) {
      const auto kk = static_cast<std::size_t>(k);
      part = locus::restrict_to(part, k, exact_rational(box.lo[kk]), exact_rational(box.hi[kk]));
    }
    return part;
  }

  mutable std::size_t enclosures = 0;

private:
  Bernstein<Rational, 2> f_;
  Bernstein<Scaled_integer, 2> exact_;
  double radius_;
};

Range_sign range_of(const std::vector<Rational>& values)
{
  bool positive = false, negative = false, zero = false;
  for (const Rational& x : values) {
    positive = positive || x > 0;
    negative = negative || x < 0;
    zero = zero || x == 0;
  }
  if (positive && negative) return Range_sign::mixed;
  if (positive) return zero ? Range_sign::weak_positive : Range_sign::positive;
  if (negative) return zero ? Range_sign::weak_negative : Range_sign::negative;
  return Range_sign::zero;
}

std::vector<Rational> differences(const Bernstein<Rational, 2>& f, int variable)
{
  std::vector<Rational> d;
  for (int i = 0; i <= f.degree(0); ++i)
    for (int j = 0; j <= f.degree(1); ++j) {
      if (variable == 0 && i < f.degree(0)) d.push_back(Rational(f.at({i + 1, j}) - f.at({i, j})));
      if (variable == 1 && j < f.degree(1)) d.push_back(Rational(f.at({i, j + 1}) - f.at({i, j})));
    }
  return d;
}

/// Small integers over 3: zeros and ties abound, and no double is exact.
Bernstein<Rational, 2> random_equation(Random& random)
{
  auto f = random.polynomial<2>(random.degrees<2>(1, 3));
  const int kind = random.below(4);
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (kind == 0) f[i] = Rational(random.between(-2, 2)) / 3;
    if (kind == 1) f[i] = Rational(random.between(0, 3)) / 3;
    if (kind == 2) f[i] = Rational(random.between(-9, 0)) / 7;
  }
  if (random.chance(10)) f = Bernstein<Rational, 2>(f.degrees());
  if (random.chance(30)) { // a square of a line through dyadic points: exact zeros on the diagonals of cells
    const Bernstein<Rational, 2> line(Degrees<2>{1, 1}, {Rational(0), Rational(-1, 3), Rational(1, 3), Rational(0)});
    f = random.chance(50) ? locus::multiply(line, line) : locus::multiply(line, f);
  }
  return f;
}

/// The counters tell one story: each failure of a rung is one call of the next that was not left out.
bool are_consistent(const Filter_counts& c)
{
  const auto bounded_failures = c.failures[0], interval_calls = c.calls[1], interval_failures = c.failures[1],
             exact_calls = c.calls[2];
  return c.failures[0] <= c.calls[0] && interval_failures <= interval_calls && interval_calls <= bounded_failures &&
         c.failures[2] == 0 && exact_calls == interval_failures + (bounded_failures - interval_calls);
}

const char* name_of(Range_sign s)
{
  switch (s) {
  case Range_sign::negative:
    return "negative";
  case Range_sign::positive:
    return "positive";
  case Range_sign::weak_negative:
    return "weakly negative";
  case Range_sign::weak_positive:
    return "weakly positive";
  case Range_sign::zero:
    return "zero";
  case Range_sign::mixed:
    return "mixed";
  default:
    return "unknown";
  }
}

} // namespace

TEST_CASE("the collected range of signs says neither more nor less than its signs", "[filter]")
{
  Samples samples;
  const std::array<Sign, 4> signs{Sign::negative, Sign::zero, Sign::positive, Sign::unknown};
  for (int subset = 0; subset < 16; ++subset) {
    Range_sign_of range;
    for (std::size_t k = 0; k < 4; ++k)
      if (subset >> k & 1) range.add(signs[k]);
    const bool negative = subset & 1, zero = subset & 2, positive = subset & 4, unknown = subset & 8;
    Range_sign expected = Range_sign::zero;
    if (positive && negative) expected = Range_sign::mixed;
    else if (unknown) expected = Range_sign::unknown;
    else if (positive) expected = zero ? Range_sign::weak_positive : Range_sign::positive;
    else if (negative) expected = zero ? Range_sign::weak_negative : Range_sign::negative;
    samples.expect(range.result() == expected && range.is_mixed() == (positive && negative),
                   [&] { return "signs of mask " + show(subset); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 16);
  CHECK(locus::detail::is_strict(Range_sign::positive));
  CHECK(locus::detail::is_strict(Range_sign::negative));
  for (const Range_sign s :
       {Range_sign::weak_negative, Range_sign::weak_positive, Range_sign::zero, Range_sign::mixed, Range_sign::unknown})
    CHECK_FALSE(locus::detail::is_strict(s));
}

TEST_CASE("on any subdivision the ladder's answers are those of exact arithmetic", "[filter]")
{
  Random random(111);
  Samples samples;
  std::array<std::size_t, 3> answered{};
  for (int i = 0; i < 250; ++i) {
    const auto f = random_equation(random);
    const double radius = random.chance(50) ? 0 : std::ldexp(1.0, -random.between(1, 60));
    const Fuzzy_equation equation(f, radius);
    Filter_counts counts;
    with_upward_rounding([&] {
      Cell_tree tree(equation, counts);
      std::vector<Cell_tree::Index> leaves{0};
      for (int step = 0; step < 12; ++step) {
        const auto at = static_cast<std::size_t>(random.below(static_cast<int>(leaves.size())));
        const Cell_tree::Index cell = leaves[at];
        const Box<2> box = tree[cell].box;
        const auto truth = equation.on(box);
        const auto say = [&](const std::string& what) {
          return what + " on [" + show(box.lo[0]) + ", " + show(box.hi[0]) + "] × [" + show(box.lo[1]) + ", " +
                 show(box.hi[1]) + "], degrees " + show(f.degrees()) + ", coefficients " + show(f.coefficients()) +
                 ", radius " + show(radius);
        };

        // Questions in a random order: an earlier answer may refresh the cell or make it exact.
        for (int question = 0; question < 3; ++question) {
          Rung rung{};
          const Filter_counts before = counts;
          Range_sign given, expected;
          const int what = random.below(4);
          if (what == 0) {
            given = tree.range_sign(cell, rung);
            expected = range_of(truth.coefficients());
          } else if (what < 3) {
            given = tree.derivative_sign(cell, what - 1, rung);
            expected = range_of(differences(truth, what - 1));
          } else {
            const int a = random.below(2), b = random.below(2);
            const Sign sign = tree.corner_sign(cell, a, b);
            samples.expect(sign == locus::sign_of(truth.at({a * f.degree(0), b * f.degree(1)})),
                           [&] { return say("corner " + show(a) + show(b)); });
            samples.expect(are_consistent(counts) && counts.calls[0] == before.calls[0] + 1,
                           [&] { return say("counts of a corner"); });
            continue;
          }
          samples.expect(given == expected, [&] {
            return say(std::string("asked for ") +
                       (what == 0   ? "the range"
                        : what == 1 ? "the first derivative"
                                    : "the second derivative") +
                       ": " + name_of(given) + ", truly " + name_of(expected));
          });
          samples.expect(are_consistent(counts) && counts.calls[0] == before.calls[0] + 1,
                         [&] { return say("counts"); });
          // The rung that answered is the last one that was called.
          bool last = counts.calls[index(rung)] == before.calls[index(rung)] + 1 &&
                      counts.failures[index(rung)] == before.failures[index(rung)];
          for (std::size_t above = index(rung) + 1; above < 3; ++above)
            last = last && counts.calls[above] == before.calls[above];
          samples.expect(last, [&] { return say("the rung that answered"); });
          ++answered[index(rung)];
        }

        // The three forms on the cell.
        const auto form = tree.bounded_form(cell), tight = tree.tight_form(cell);
        bool covered = form.degrees() == truth.degrees();
        for (std::size_t k = 0; covered && k < truth.size(); ++k)
          covered = abs(Rational(exact_rational(form[k].value) - truth[k])) <= exact_rational(form.error()) &&
                    abs(Rational(exact_rational(tight[k].value) - truth[k])) <= exact_rational(tight.error());
        samples.expect(covered, [&] { return say("bounded form"); });
        if (random.chance(30)) {
          const auto& exact = tree.exact(cell);
          samples.expect(exact.degrees() == truth.degrees() && exact.rational().coefficients() == truth.coefficients(),
                         [&] { return say("exact form"); });
        }

        // Cut, in the middle or not.
        const int v = random.below(2);
        const auto vv = static_cast<std::size_t>(v);
        const double share = random.chance(60) ? 0.5 : std::ldexp(static_cast<double>(random.between(1, 15)), -4);
        const double cut = box.lo[vv] + share * (box.hi[vv] - box.lo[vv]);
        const std::size_t size = tree.size();
        Cell_tree::Index low = tree.cut(cell, v, cut);
        if (random.chance(20)) {
          tree.undo_cut(cell);
          samples.expect(tree.size() == size && tree[cell].split_variable == -1, [&] { return say("undone"); });
          low = tree.cut(cell, 1 - v, 0.5 * (box.lo[1 - vv] + box.hi[1 - vv]));
        }
        samples.expect(tree.size() == size + 2 && tree[cell].low_child == low && tree[cell].high_child == low + 1 &&
                         tree[low].parent == cell && tree[low + 1].parent == cell && tree[low + 1].is_high &&
                         !tree[low].is_high && tree[low].depth == tree[cell].depth + 1,
                       [&] { return say("the tree"); });
        const auto w = static_cast<std::size_t>(tree[cell].split_variable);
        samples.expect(tree[low].box.hi[w] == tree[low + 1].box.lo[w] && tree[low].box.lo == box.lo &&
                         tree[low + 1].box.hi == box.hi && tree[low].box.hi[1 - w] == box.hi[1 - w] &&
                         tree[low + 1].box.lo[1 - w] == box.lo[1 - w],
                       [&] { return say("the children's boxes"); });
        leaves[at] = low;
        leaves.push_back(low + 1);
      }
    });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 20000);
  CHECK(answered[0] > 500);
  CHECK(answered[1] > 50);
  CHECK(answered[2] > 500);
}

TEST_CASE("coefficients that are exactly zero are decided as zero by the exact rung", "[filter]")
{
  // x - y, in thirds: on the cells along the diagonal two corners are zero, which no enclosure proves.
  const Bernstein<Rational, 2> f(Degrees<2>{1, 1}, {Rational(0), Rational(-1, 3), Rational(1, 3), Rational(0)});
  const Fuzzy_equation equation(f, 0x1p-60);
  Filter_counts counts;
  std::vector<Sign> corners;
  Range_sign whole{}, square{}, zero{};
  Rung rung_of_square{}, rung_of_zero{}, rung{};
  std::uint64_t exact_cells = 0, exact_cells_again = 0;
  Filter_counts first, second;
  with_upward_rounding([&] {
    Cell_tree tree(equation, counts);
    whole = tree.range_sign(0, rung);
    const auto low = tree.cut(0, 0, 0.5), quarter = tree.cut(low, 1, 0.5);
    corners = {tree.corner_sign(quarter, 0, 0), tree.corner_sign(quarter, 1, 1), tree.corner_sign(quarter, 0, 1),
               tree.corner_sign(quarter, 1, 0)};
    first = counts;
    exact_cells = tree.exact_cells();
    tree.corner_sign(quarter, 0, 0);
    exact_cells_again = tree.exact_cells();
    second = counts;

    // (x - 1/2)²/3 on the upper half: zero along one side, else positive.
    const Bernstein<Rational, 2> g(Degrees<2>{2, 0}, {Rational(1, 12), Rational(-1, 12), Rational(1, 12)});
    const Fuzzy_equation square_equation(g, 0x1p-60);
    Filter_counts square_counts;
    Cell_tree square_tree(square_equation, square_counts);
    square = square_tree.range_sign(square_tree.cut(0, 0, 0.5) + 1, rung_of_square);

    const Fuzzy_equation zero_equation(Bernstein<Rational, 2>(Degrees<2>{2, 1}), 0x1p-60);
    Filter_counts zero_counts;
    Cell_tree zero_tree(zero_equation, zero_counts);
    zero = zero_tree.range_sign(0, rung_of_zero);
  });
  CHECK(whole == Range_sign::mixed);
  CHECK(rung == Rung::bounded);
  CHECK(corners == std::vector<Sign>{Sign::zero, Sign::zero, Sign::negative, Sign::positive});
  CHECK(square == Range_sign::weak_positive);
  CHECK(rung_of_square == Rung::exact);
  CHECK(zero == Range_sign::zero);
  CHECK(rung_of_zero == Rung::exact);
  // Two zeros were asked for: each failed on the bounded rung, the first one on the interval rung too, and made the
  // cell exact with its ancestors; asking again costs a call of two rungs and no new exact cell.
  CHECK(first.calls == std::array<std::uint64_t, 3>{5, 1, 2});
  CHECK(first.failures == std::array<std::uint64_t, 3>{2, 1, 0});
  CHECK(second.calls == std::array<std::uint64_t, 3>{6, 1, 3});
  CHECK(second.failures == std::array<std::uint64_t, 3>{3, 1, 0});
  CHECK(exact_cells == 3u);
  CHECK(exact_cells_again == 3u);
}

TEST_CASE("below an exact cell the interval rung is left out", "[filter]")
{
  const Bernstein<Rational, 2> f(Degrees<2>{1, 1}, {Rational(0), Rational(-1, 3), Rational(1, 3), Rational(0)});
  const Fuzzy_equation equation(f, 0x1p-60);
  Filter_counts counts;
  std::size_t enclosures_before = 0, enclosures_after = 0;
  Sign sign = Sign::unknown;
  with_upward_rounding([&] {
    Cell_tree tree(equation, counts);
    const auto quarter = tree.cut(tree.cut(0, 0, 0.5), 1, 0.5);
    tree.exact(quarter);
    const auto child = tree.cut(quarter, 0, 0.25);
    enclosures_before = equation.enclosures;
    sign = tree.corner_sign(child, 0, 0);
    enclosures_after = equation.enclosures;
  });
  CHECK(sign == Sign::zero);
  CHECK(enclosures_before == enclosures_after);
  CHECK(counts.calls == std::array<std::uint64_t, 3>{1, 0, 1});
  CHECK(are_consistent(counts));
}

TEST_CASE("an equation that does not depend on a variable has the derivative zero", "[filter]")
{
  for (const int variable : {0, 1}) {
    Degrees<2> degrees{1, 1};
    degrees[static_cast<std::size_t>(variable)] = 0;
    const Fuzzy_equation equation(Bernstein<Rational, 2>(degrees, {Rational(-1, 3), Rational(2, 3)}), 0);
    Filter_counts counts;
    Range_sign along{}, across{};
    Rung rung{};
    with_upward_rounding([&] {
      Cell_tree tree(equation, counts);
      along = tree.derivative_sign(0, variable, rung);
      across = tree.derivative_sign(0, 1 - variable, rung);
    });
    INFO("variable " << variable);
    CHECK(along == Range_sign::zero);
    CHECK(across == Range_sign::positive);
  }
}

TEST_CASE("coefficients beyond the doubles are left to the exact rung", "[filter]")
{
  const Rational huge = locus::parse_rational("1e400"), tiny = locus::parse_rational("1e-400");
  Samples samples;
  for (const Rational& scale :
       {huge, tiny, Rational(locus::parse_rational("1e308")), Rational(locus::parse_rational("1e-310"))})
    for (const int signs : {0, 1, 2, 3}) {
      // All positive; all negative; mixed; mixed with one huge coefficient only.
      std::vector<Rational> c{scale, Rational(2 * scale), Rational(3 * scale), scale};
      if (signs == 1)
        for (Rational& x : c) x = -x;
      if (signs == 2) c[1] = -scale;
      if (signs == 3) c = {scale, Rational(-1), Rational(1), Rational(1)};
      const Fuzzy_equation equation(Bernstein<Rational, 2>(Degrees<2>{1, 1}, c), 0);
      Filter_counts counts;
      Range_sign whole{}, low{};
      Rung rung{};
      const auto truth = equation.on([] {
        auto box = Box<2>::unit();
        box.hi[0] = 0.5;
        return box;
      }());
      with_upward_rounding([&] {
        Cell_tree tree(equation, counts);
        whole = tree.range_sign(0, rung);
        low = tree.range_sign(tree.cut(0, 0, 0.5), rung);
      });
      samples.expect(whole == range_of(c), [&] { return show(c) + ": " + name_of(whole); });
      samples.expect(low == range_of(truth.coefficients()), [&] { return show(c) + ", lower half: " + name_of(low); });
      samples.expect(are_consistent(counts), [&] { return show(c) + ": counts"; });
    }
  LOCUS_REQUIRE_SAMPLES(samples, 48);
}
