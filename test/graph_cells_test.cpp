// SPDX-License-Identifier: LGPL-3.0-or-later
#include "system_support.h"

#include <locus/zero_set/sheet_evaluation.h>
#include <locus/zero_set/surface_cells.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace locus_test;
using locus::Answer;
using locus::Box;
using locus::Claim;
using locus::Claim_kind;
using locus::Interval;
using locus::Pivot_set;
using locus::Sheet_evaluator;
using locus::Solve_control;
using locus::Surface_cells;
using locus::System;
using locus::with_upward_rounding;

namespace {

template <int K, int D>
Surface_cells<K, D> cells_of(const System<K, D>& system, const Solve_control& control = {},
                             locus::Claim_observer<D>* observer = nullptr)
{
  return with_upward_rounding([&] { return locus::surface_cells<K, D>(system, control, observer); });
}

template <int D>
class Recorder final : public locus::Claim_observer<D> {
public:
  std::vector<Claim<D>> claims;
  void on_claim(const Claim<D>& claim) override { claims.push_back(claim); }
};

// ------------------------------------------------------------------------------------- claims, verified in rationals

/// Bernstein coefficients on a box, by blossoms in rationals: no code of the library.
template <int D>
Bernstein<Rational, D> restricted(Bernstein<Rational, D> f, const Box<D>& box)
{
  for (int v = 0; v < D; ++v) {
    const auto layout = locus::layout_along(f.degrees(), v);
    const Rational lo(box.lo[static_cast<std::size_t>(v)]), hi(box.hi[static_cast<std::size_t>(v)]);
    Bernstein<Rational, D> next(f.degrees());
    for (std::size_t o = 0; o < layout.outer; ++o)
      for (std::size_t i = 0; i < layout.inner; ++i)
        for (std::size_t k = 0; k < layout.count; ++k) {
          std::vector<Rational> work;
          for (std::size_t j = 0; j < layout.count; ++j) work.push_back(f[(o * layout.count + j) * layout.inner + i]);
          for (std::size_t level = 0; level + 1 < layout.count; ++level) {
            const Rational& u = level + 1 + k < layout.count ? lo : hi;
            for (std::size_t j = 0; j + 1 < work.size(); ++j) work[j] = Rational((1 - u) * work[j] + u * work[j + 1]);
            work.pop_back();
          }
          next[(o * layout.count + k) * layout.inner + i] = work[0];
        }
    f = next;
  }
  return f;
}

template <int D>
std::pair<Rational, Rational> slope_range(const Bernstein<Rational, D>& f, int v)
{
  const auto layout = locus::layout_along(f.degrees(), v);
  Rational lo = 0, hi = 0;
  bool first = true;
  for (std::size_t at = 0; at < f.size(); ++at) {
    if (at / layout.inner % layout.count + 1 == layout.count) continue;
    const Rational d = (f[at + layout.inner] - f[at]) * f.degree(v);
    lo = first ? d : std::min(lo, d);
    hi = first ? d : std::max(hi, d);
    first = false;
  }
  return {lo, hi};
}

template <int D>
bool has_one_sign(const Bernstein<Rational, D>& f)
{
  const int s = sgn(f[0]);
  for (std::size_t i = 0; i < f.size(); ++i)
    if (sgn(f[i]) != s) return false;
  return s != 0;
}

/// The polynomials written with common degrees, by multiplying with (x + 1 - x) in the monomial basis: from the definition.
template <int D>
Bernstein<Rational, D> of_degrees(const Terms<D>& f, const Degrees<D>& degrees)
{
  Bernstein<Rational, D> b(degrees);
  Degrees<D> i{};
  std::size_t at = 0;
  do {
    for (const auto& [e, c] : f.terms) {
      if (c == 0) continue;
      Rational t = c;
      for (std::size_t v = 0; v < i.size(); ++v) t *= Rational(choose(i[v], e[v])) / choose(degrees[v], e[v]);
      b[at] += t;
    }
    ++at;
  } while (locus::advance_index(i, degrees));
  return b;
}

template <std::size_t K, int D>
class Claim_check {
public:
  explicit Claim_check(const std::array<Terms<D>, K>& f)
  {
    Degrees<D> degrees{};
    for (const auto& g : f)
      for (std::size_t v = 0; v < degrees.size(); ++v) degrees[v] = std::max(degrees[v], g.degrees()[v]);
    for (std::size_t k = 0; k < K; ++k) forms_[k] = multiply(of_degrees(f[k], degrees), factor(f[k]));
  }

  /// The first claim that does not hold, in words.
  std::string problem(const std::vector<Claim<D>>& claims)
  {
    Rational volume = 0;
    for (const Claim<D>& c : claims) {
      if (c.kind == Claim_kind::split) continue;
      Rational v = 1;
      for (int k = 0; k < D; ++k)
        v *= Rational(c.box.hi[static_cast<std::size_t>(k)]) - Rational(c.box.lo[static_cast<std::size_t>(k)]);
      volume += v;
      if (c.kind == Claim_kind::empty && !is_empty(c)) return "a cell is not empty";
      if (c.kind == Claim_kind::graph && !is_graph(c)) return "a cell is no graph";
    }
    return volume == 1 ? "" : "the cells do not fill the unit cell";
  }

private:
  std::array<Bernstein<Rational, D>, K> on(const Box<D>& box) const
  {
    std::array<Bernstein<Rational, D>, K> f;
    for (std::size_t k = 0; k < K; ++k) f[k] = restricted(forms_[k], box);
    return f;
  }

  /// What `Polynomial_equation` multiplies a polynomial with: the weights of combinations are for its coefficients.
  static Rational factor(const Terms<D>& f)
  {
    const Bernstein<locus::Scaled_integer, D> form(f.bernstein());
    std::size_t bits = 0;
    for (const Integer& c : form.values().coefficients()) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
    return Rational(two_to(-static_cast<int>(bits)) / form.scale());
  }

  static Bernstein<Rational, D> multiply(Bernstein<Rational, D> f, const Rational& by)
  {
    for (std::size_t i = 0; i < f.size(); ++i) f[i] *= by;
    return f;
  }

  /// By one equation, or by the combination that the claim gives.
  bool is_empty(const Claim<D>& c) const
  {
    const auto f = on(c.box);
    if (c.variable >= 0) return has_one_sign(f[static_cast<std::size_t>(c.variable)]);
    if (c.rung == locus::Rung::exact) return true; // weights belong to rescaled polynomials
    std::istringstream in(c.reason.substr(std::string("combination").size()));
    Bernstein<Rational, D> sum(f[0].degrees());
    for (std::size_t k = 0; k < K; ++k) {
      std::string word;
      in >> word;
      const Rational w(std::strtod(word.c_str(), nullptr));
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * f[k][i];
    }
    return has_one_sign(sum);
  }

  /// Dominance with the exact inverse of the midpoint matrix.
  bool is_graph(const Claim<D>& c) const
  {
    const auto f = on(c.box);
    std::vector<int> pivots;
    for (int v = 0; v < D; ++v)
      if (K == 1 ? c.variable == v : (c.variable >> v & 1) != 0) pivots.push_back(v);
    if (pivots.size() != K) return false;
    std::vector<std::vector<Rational>> rows(K, std::vector<Rational>(2 * K, Rational(0)));
    for (std::size_t k = 0; k < K; ++k) {
      for (std::size_t j = 0; j < K; ++j) {
        const auto [lo, hi] = slope_range(f[k], pivots[j]);
        rows[k][j] = Rational((lo + hi) / 2);
      }
      rows[k][K + k] = 1;
    }
    if (!eliminate(rows)) return false;
    for (std::size_t r = 0; r < K; ++r) {
      Bernstein<Rational, D> g(f[0].degrees());
      for (std::size_t k = 0; k < K; ++k)
        for (std::size_t i = 0; i < g.size(); ++i) g[i] += rows[r][K + k] * f[k][i];
      Rational surplus = 0;
      for (std::size_t j = 0; j < K; ++j) {
        const auto [lo, hi] = slope_range(g, pivots[j]);
        surplus += j == r ? std::max(lo, Rational(-hi)) : Rational(-std::max(Rational(abs(lo)), Rational(abs(hi))));
      }
      if (surplus <= 0) return false;
    }
    return true;
  }

  static bool eliminate(std::vector<std::vector<Rational>>& a)
  {
    for (std::size_t c = 0; c < K; ++c) {
      std::size_t p = c;
      while (p < K && a[p][c] == 0) ++p;
      if (p == K) return false;
      std::swap(a[p], a[c]);
      const Rational pivot = a[c][c];
      for (Rational& e : a[c]) e /= pivot;
      for (std::size_t r = 0; r < K; ++r) {
        if (r == c) continue;
        const Rational factor = a[r][c];
        for (std::size_t j = 0; j < 2 * K; ++j) a[r][j] -= factor * a[c][j];
      }
    }
    return true;
  }

  std::array<Bernstein<Rational, D>, K> forms_;
};

template <std::size_t K, int D>
void check_claims(Samples& samples, const std::array<Terms<D>, K>& f, std::size_t most_cells)
{
  Recorder<D> recorder;
  Solve_control control;
  control.max_cells = most_cells;
  const auto system = system_of<K, D>(f);
  const auto cells = cells_of<static_cast<int>(K), D>(system, control, &recorder);
  const auto text = [&](const std::string& problem) {
    std::string t = problem + ":";
    for (const auto& g : f) t += " " + g.text() + ",";
    return t;
  };
  const std::string problem = Claim_check<K, D>(f).problem(recorder.claims);
  samples.expect(problem.empty(), [&] { return text(problem); });
  std::size_t graphs = 0, undecided = 0;
  for (const auto& c : recorder.claims) {
    graphs += c.kind == Claim_kind::graph;
    undecided += c.kind == Claim_kind::undecided;
  }
  samples.expect(graphs == cells.cells.size() && undecided == cells.undecided.size(),
                 [&] { return text("claims are missing"); });
}

template <std::size_t K, int D>
std::array<Terms<D>, K> random_system(Random& random, int degree)
{
  std::array<Terms<D>, K> f;
  std::array<Rational, static_cast<std::size_t>(D)> through;
  for (Rational& u : through) u = fraction(random.between(1, 15), 16);
  for (auto& g : f) {
    Degrees<D> degrees{};
    for (int& n : degrees) n = random.between(1, degree);
    g = random_terms<D>(random, degrees, random.chance(50) ? 2 : 30);
    if (random.chance(70)) g = g - Terms<D>(g.at(through));
  }
  return f;
}

template <int D>
Terms<D> round_form(const std::array<Rational, static_cast<std::size_t>(D)>& centre, const Rational& squared_radius)
{
  Terms<D> f(Rational(-squared_radius));
  for (int v = 0; v < D; ++v) {
    const Terms<D> u = Terms<D>::variable(v) - Terms<D>(centre[static_cast<std::size_t>(v)]);
    f = f + u * u;
  }
  return f;
}

} // namespace

TEST_CASE("pivot sets are all subsets, and the base is the rest", "[graph_cells]")
{
  const auto sets = locus::detail::all_pivot_sets<2, 4>();
  std::set<std::array<int, 2>> different(sets.begin(), sets.end());
  CHECK(sets.size() == 6);
  CHECK(different.size() == 6);
  for (const auto& s : sets) {
    CHECK(s[0] < s[1]);
    const auto base = locus::base_variables<4>(s);
    std::set<int> all{s[0], s[1], base[0], base[1]};
    CHECK(all == std::set<int>{0, 1, 2, 3});
    CHECK(base[0] < base[1]);
    CHECK(locus::bits_of(s) == (1 << s[0] | 1 << s[1]));
  }
  CHECK(locus::detail::all_pivot_sets<3, 3>().size() == 1);
  CHECK(locus::detail::all_pivot_sets<1, 5>().size() == 5);
  CHECK(locus::name_of(Pivot_set<2>{0, 2}) == "x0 x2");
  const std::array<std::array<double, 3>, 3> m{{{2, 1, 0}, {0, 3, 1}, {1, 0, 4}}};
  CHECK(locus::detail::determinant(m) == 25.0);
}

TEST_CASE("every claim holds in exact rationals, and the cells fill the unit cell", "[graph_cells]")
{
  Random random(1);
  Samples samples;
  for (int k = 0; k < 60; ++k) check_claims<1, 2>(samples, random_system<1, 2>(random, 4), 400);
  for (int k = 0; k < 40; ++k) check_claims<1, 3>(samples, random_system<1, 3>(random, 2), 150);
  for (int k = 0; k < 40; ++k) check_claims<2, 3>(samples, random_system<2, 3>(random, 2), 150);
  for (int k = 0; k < 10; ++k) check_claims<2, 4>(samples, random_system<2, 4>(random, 1), 100);
  for (int k = 0; k < 10; ++k) check_claims<3, 4>(samples, random_system<3, 4>(random, 1), 100);
  LOCUS_REQUIRE_SAMPLES(samples, 320);
}

TEST_CASE("a determinant without zeros is not enough for a graph", "[graph_cells]")
{
  // Cube roots of 1 + i(1/2 - t): the Jacobian 9|z|⁴ vanishes for z = 0 only, and two roots over each t are in the box.
  using P = Terms<3>;
  const P u = P(fraction(1, 4)) - P(2) * P::variable(0),
          v = P(fraction(-13, 10)) + P(fraction(26, 10)) * P::variable(1);
  const auto system = system_of<2, 3>(
    {u * u * u - P(3) * u * v * v - P(1), P(3) * u * u * v - v * v * v - P(fraction(1, 2)) + P::variable(2)});
  const auto cells = cells_of<2, 3>(system);
  REQUIRE(cells.is_certified());
  Samples samples;
  with_upward_rounding([&] {
    for (const double t : {0.1, 0.4, 0.55, 0.9}) {
      std::set<double> found;
      for (const auto& c : cells.cells) {
        if (c.pivots != Pivot_set<2>{0, 1} || t < c.box.lo[2] || t > c.box.hi[2]) continue;
        const auto p = Sheet_evaluator<2, 3>(system, c.box, c.pivots).at({t});
        if (p.exists == Answer::yes) found.insert(std::round(1e6 * locus::midpoint(p.at[1])));
      }
      samples.expect(found.size() == 2,
                     [&] { return std::to_string(found.size()) + " roots over " + std::to_string(t); });
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 4);
}

TEST_CASE("cells of known surfaces, their numbers and their sheets", "[graph_cells]")
{
  const Rational half = fraction(1, 2);
  const auto system = system_of<1, 3>({round_form<3>({half, half, half}, fraction(1, 9))});
  const auto cells = cells_of<1, 3>(system);
  CHECK(cells.is_certified());
  CHECK(cells.statistics.cells <= 200);
  Samples samples;
  Random random(2);
  with_upward_rounding([&] {
    int points = 0;
    for (const auto& c : cells.cells)
      for (int k = 0; k < 40; ++k) {
        const auto base = locus::base_variables<3>(c.pivots);
        std::array<double, 2> s{};
        double rest = 1.0 / 9;
        for (std::size_t b = 0; b < 2; ++b) {
          const int v = base[b];
          s[b] = c.box.lo[static_cast<std::size_t>(v)] + random.unit() * c.box.width(v);
          rest -= (s[b] - 0.5) * (s[b] - 0.5);
        }
        const auto p = Sheet_evaluator<1, 3>(system, c.box, c.pivots).at(s);
        const auto pivot = static_cast<std::size_t>(c.pivots[0]);
        int inside = 0;
        double place = 0;
        for (const int side : {-1, 1}) {
          const double x = rest > 0 ? 0.5 + side * std::sqrt(rest) : -1;
          if (x < c.box.lo[pivot] || x > c.box.hi[pivot]) continue;
          ++inside;
          place = x;
        }
        points += inside;
        samples.expect(p.exists == (inside ? Answer::yes : Answer::no), "a sheet's point");
        samples.expect(inside < 2 && (inside == 0 || std::abs(locus::midpoint(p.at[pivot]) - place) < 1e-9),
                       "its place");
      }
    samples.expect(points > 100, "enough points");
  });
  LOCUS_REQUIRE_SAMPLES(samples, 1000);
}

TEST_CASE("a surface in four variables: a torus as a product of circles", "[graph_cells]")
{
  using Q = Terms<4>;
  const auto circle = [](int a, int b) {
    const Q u = Q::variable(a) - Q(fraction(1, 2)), v = Q::variable(b) - Q(fraction(9, 20));
    return u * u + v * v - Q(fraction(1, 9));
  };
  const auto system = system_of<2, 4>({circle(0, 1), circle(2, 3)});
  const auto cells = cells_of<2, 4>(system);
  INFO(cells.cells.size() << " graph cells of " << cells.statistics.cells);
  CHECK(cells.is_certified());
  CHECK(cells.statistics.cells <= 3000);
  Samples samples;
  Random random(3);
  with_upward_rounding([&] {
    for (int k = 0; k < 300; ++k) {
      const double a = 6.283185307179586 * random.unit(), b = 6.283185307179586 * random.unit();
      const std::array<double, 4> p{0.5 + std::cos(a) / 3, 0.45 + std::sin(a) / 3, 0.5 + std::cos(b) / 3,
                                    0.45 + std::sin(b) / 3};
      int holding = 0;
      bool agrees = false;
      for (const auto& c : cells.cells) {
        bool in = true;
        for (std::size_t v = 0; v < 4; ++v) in = in && c.box.lo[v] <= p[v] && p[v] <= c.box.hi[v];
        if (!in) continue;
        ++holding;
        const auto base = locus::base_variables<4>(c.pivots);
        const auto q = Sheet_evaluator<2, 4>(system, c.box, c.pivots)
                         .at({p[static_cast<std::size_t>(base[0])], p[static_cast<std::size_t>(base[1])]});
        double distance = 0;
        for (std::size_t v = 0; v < 4; ++v) distance = std::max(distance, std::abs(locus::midpoint(q.at[v]) - p[v]));
        agrees = q.exists == Answer::yes && distance < 1e-9;
      }
      samples.expect(holding == 1 && agrees, "a point of the torus");
    }
  });
  LOCUS_REQUIRE_SAMPLES(samples, 300);
}

TEST_CASE("cells in contact are found, all of them and only they", "[graph_cells]")
{
  const auto system =
    system_of<1, 3>({round_form<3>({fraction(1, 2), fraction(2, 5), fraction(3, 7)}, fraction(1, 10))});
  const auto cells = cells_of<1, 3>(system);
  std::set<std::array<std::size_t, 3>> expected, found;
  for (std::size_t a = 0; a < cells.cells.size(); ++a)
    for (std::size_t b = 0; b < cells.cells.size(); ++b)
      for (std::size_t v = 0; v < 3; ++v) {
        const Box<3>&low = cells.cells[a].box, &high = cells.cells[b].box;
        bool meet = low.hi[v] == high.lo[v];
        for (std::size_t w = 0; w < 3; ++w)
          meet = meet && (w == v || (low.lo[w] < high.hi[w] && high.lo[w] < low.hi[w]));
        if (meet) expected.insert({a, b, v});
      }
  for (const auto& c : cells.contacts) found.insert({c.low, c.high, static_cast<std::size_t>(c.variable)});
  CHECK(found.size() == cells.contacts.size());
  CHECK(found.size() > 20);
  CHECK(found == expected);
}

TEST_CASE("signs that doubles cannot tell are decided exactly", "[graph_cells]")
{
  for (const int k : {20, 50, 80, 200}) { // x² + y² + z² + 2^-k has no zero, but in a corner of eight cells almost
    const auto system = system_of<1, 3>({round_form<3>({fraction(1, 2), fraction(1, 2), fraction(1, 2)}, -two_to(-k))});
    const auto cells = cells_of<1, 3>(system);
    INFO("2^-" << k << ": " << cells.statistics.cells << " cells, " << cells.statistics.exact_cells << " exact");
    CHECK(cells.is_certified());
    CHECK(cells.cells.empty());
    CHECK((cells.statistics.exact_cells > 0) == (k > 50));
  }
  // Coefficients that are exactly zero, and such that are huge or tiny.
  for (const int e : {-900, 0, 900, 3000}) {
    const Terms<3> f =
      round_form<3>({fraction(1, 2), fraction(1, 2), fraction(1, 2)}, fraction(1, 4)) * Terms<3>(two_to(e));
    const auto cells = cells_of<1, 3>(system_of<1, 3>({f}));
    INFO("times 2^" << e);
    CHECK(cells.is_certified());
    CHECK(cells.statistics.cells <= 200);
  }
}

TEST_CASE("a cone's tip stays undecided in a small box; the rest is done", "[graph_cells]")
{
  using P = Terms<3>;
  const P x = P::variable(0) - P(fraction(1, 3)), y = P::variable(1) - P(fraction(1, 3)),
          z = P::variable(2) - P(fraction(1, 3));
  const auto cells = cells_of<1, 3>(system_of<1, 3>({x * x + y * y - z * z}));
  REQUIRE_FALSE(cells.is_certified());
  CHECK(cells.undecided.size() <= 8);
  CHECK(cells.statistics.cells <= 2500);
  for (const auto& u : cells.undecided)
    for (std::size_t v = 0; v < 3; ++v) {
      CHECK(u.box.lo[v] > 1.0 / 3 - 1e-6);
      CHECK(u.box.hi[v] < 1.0 / 3 + 1e-6);
    }
}

TEST_CASE("a point that is not proved is not said to exist", "[graph_cells]")
{
  using P = Terms<2>;
  const P u = P::variable(0) - P(fraction(1, 3));
  const auto system = system_of<1, 2>({u * u + P::variable(1) - P(fraction(1, 2))});
  with_upward_rounding([&] {
    const Sheet_evaluator<1, 2> parabola(system, Box<2>::unit(), {0});
    CHECK(parabola.at({0.75}).exists == Answer::no);
    CHECK(parabola.at({0.5 + 0x1p-20}).exists == Answer::no);
    CHECK(parabola.at({0.5}).exists == Answer::undecided); // a double one
    CHECK(parabola.at({0.5 + 0x1p-52}).exists == Answer::undecided);
    const auto other = Sheet_evaluator<1, 2>(system, Box<2>::unit(), {1}).at({0.5});
    CHECK(other.exists == Answer::yes);
    CHECK(std::abs(locus::midpoint(other.at[1]) - (0.5 - 1.0 / 36)) < 1e-14);
    CHECK(locus::width(other.at[1]) < 1e-13);
  });
}
