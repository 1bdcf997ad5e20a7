// SPDX-License-Identifier: LGPL-3.0-or-later
#include "curve_support.h"

#include <locus/zero_set/curve_solver.h>

#include <catch2/catch.hpp>

#include <set>
#include <thread>

using namespace locus_test;
using locus::Box;
using locus::Claim;
using locus::Claim_kind;
using locus::Curve_graph;
using locus::Graph_vertex;
using locus::Interval;
using locus::Solve_control;
using locus::System;
using locus::with_upward_rounding;

namespace {

// ------------------------------------------------------------------------------- polynomials in x and y, by monomials

struct Bivariate {
  std::map<std::pair<int, int>, Rational> terms;

  Bivariate() = default;
  Bivariate(const Rational& c) { terms[{0, 0}] = c; }
  Bivariate(int c) : Bivariate(Rational(c)) {}

  Rational at(const Rational& x, const Rational& y) const
  {
    Rational sum = 0;
    for (const auto& [e, c] : terms) sum += c * power(x, e.first) * power(y, e.second);
    return sum;
  }
  Degrees<2> degrees() const
  {
    Degrees<2> d{0, 0};
    for (const auto& [e, c] : terms)
      if (c != 0) d = {std::max(d[0], e.first), std::max(d[1], e.second)};
    return d;
  }
  /// Coefficients in the Bernstein basis of these degrees, from the definition.
  Bernstein<Rational, 2> bernstein(const Degrees<2>& degrees) const
  {
    Bernstein<Rational, 2> f(degrees);
    for (const auto& [e, c] : terms)
      for (int i = e.first; i <= degrees[0]; ++i)
        for (int j = e.second; j <= degrees[1]; ++j)
          f.at({i, j}) += c * Rational(choose(i, e.first) * choose(j, e.second)) /
                          Rational(choose(degrees[0], e.first) * choose(degrees[1], e.second));
    return f;
  }
  Bernstein<Rational, 2> bernstein() const { return bernstein(degrees()); }
};

Bivariate monomial(int i, int j)
{
  Bivariate f;
  f.terms[{i, j}] = 1;
  return f;
}
Bivariate operator+(Bivariate f, const Bivariate& g)
{
  for (const auto& [e, c] : g.terms) f.terms[e] += c;
  return f;
}
Bivariate operator*(const Bivariate& f, const Bivariate& g)
{
  Bivariate product;
  for (const auto& [e, c] : f.terms)
    for (const auto& [d, b] : g.terms) product.terms[{e.first + d.first, e.second + d.second}] += c * b;
  return product;
}
Bivariate operator-(const Bivariate& f, const Bivariate& g) { return f + Bivariate(-1) * g; }

const Bivariate x = monomial(1, 0), y = monomial(0, 1);

Rational q(long p, long n = 1)
{
  Rational r(p, n);
  r.canonicalize();
  return r;
}

Bivariate circle(const Rational& cx, const Rational& cy, const Rational& squared_radius)
{
  return (x - cx) * (x - cx) + (y - cy) * (y - cy) - squared_radius;
}

std::string show_terms(const Bivariate& f)
{
  std::string text;
  for (const auto& [e, c] : f.terms)
    if (c != 0) text += " + (" + c.get_str() + ") x^" + std::to_string(e.first) + " y^" + std::to_string(e.second);
  return text.empty() ? "0" : text;
}

// -------------------------------------------------------------------------------------------------- the verification

/// Bernstein coefficients on a box, by blossoms in rationals: no code of the library.
Bernstein<Rational, 2> restricted(Bernstein<Rational, 2> f, const Box<2>& box)
{
  const auto blossomed = [](const std::vector<Rational>& c, const Rational& lo, const Rational& hi) {
    const std::size_t n = c.size() - 1;
    std::vector<Rational> result;
    for (std::size_t i = 0; i <= n; ++i) {
      std::vector<Rational> work = c;
      for (std::size_t level = 0; level < n; ++level) {
        const Rational& u = level < n - i ? lo : hi;
        for (std::size_t j = 0; j + 1 < work.size(); ++j) work[j] = Rational((1 - u) * work[j] + u * work[j + 1]);
        work.pop_back();
      }
      result.push_back(work[0]);
    }
    return result;
  };
  for (int i = 0; i <= f.degree(0); ++i) {
    std::vector<Rational> row;
    for (int j = 0; j <= f.degree(1); ++j) row.push_back(f.at({i, j}));
    row = blossomed(row, Rational(box.lo[1]), Rational(box.hi[1]));
    for (int j = 0; j <= f.degree(1); ++j) f.at({i, j}) = row[static_cast<std::size_t>(j)];
  }
  for (int j = 0; j <= f.degree(1); ++j) {
    std::vector<Rational> column;
    for (int i = 0; i <= f.degree(0); ++i) column.push_back(f.at({i, j}));
    column = blossomed(column, Rational(box.lo[0]), Rational(box.hi[0]));
    for (int i = 0; i <= f.degree(0); ++i) f.at({i, j}) = column[static_cast<std::size_t>(i)];
  }
  return f;
}

/// The polynomial on a side of a box, in monomials of the position on it.
Polynomial on_side(const Bernstein<Rational, 2>& f, int variable, int side)
{
  const int n = f.degree(1 - variable), fixed = side * f.degree(variable);
  Polynomial sum;
  for (int k = 0; k <= n; ++k) {
    Polynomial basis{Rational(choose(n, k))};
    for (int i = 0; i < n; ++i) basis = times(basis, i < k ? Polynomial{0, 1} : Polynomial{1, -1});
    sum = plus(sum, times(basis, {variable == 0 ? f.at({fixed, k}) : f.at({k, fixed})}));
  }
  return sum;
}

/// Distinct zeros on the boundary of a box (corners once); nothing where a side is all zeros.
std::optional<int> zeros_on_boundary(const Bernstein<Rational, 2>& f)
{
  int count = 0;
  for (int v = 0; v < 2; ++v)
    for (int side = 0; side < 2; ++side) {
      const Polynomial g = on_side(f, v, side);
      if (g.empty()) return std::nullopt;
      if (g.size() > 1) count += Sturm(g).open(Rational(0), Rational(1));
    }
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) count += f.at({i * f.degree(0), j * f.degree(1)}) == 0;
  return count;
}

/// Follows a solve's claims: the cells must tile the unit square, and each must be true by exact coefficients.
class Verifier final : public locus::Claim_observer<2> {
public:
  explicit Verifier(Bernstein<Rational, 2> f) : f_(std::move(f)) { open_.insert(key(Box<2>::unit())); }

  void on_claim(const Claim<2>& claim) override
  {
    const Key box = key(claim.box);
    if (claim.kind == Claim_kind::isolated_box) {
      ++isolated;
      return;
    }
    if (open_.erase(box) != 1) complain("a claim of a cell that is not open", claim);
    const auto v = static_cast<std::size_t>(claim.variable);
    if (claim.kind == Claim_kind::split) {
      Box<2> low = claim.box, high = claim.box;
      low.hi[v] = high.lo[v] = claim.at;
      if (!(claim.box.lo[v] < claim.at && claim.at < claim.box.hi[v])) complain("a cut outside its cell", claim);
      open_.insert(key(low));
      open_.insert(key(high));
      return;
    }
    area += (Rational(claim.box.hi[0]) - Rational(claim.box.lo[0])) * (Rational(claim.box.hi[1]) - Rational(claim.box.lo[1]));
    ++leaves;
    if (claim.kind == Claim_kind::undecided) {
      ++undecided;
      if (claim.reason.empty()) complain("no reason", claim);
      return;
    }
    const Bernstein<Rational, 2> g = restricted(f_, claim.box);
    if (claim.kind == Claim_kind::empty && !is_empty(g)) complain("not empty", claim);
    if (claim.kind == Claim_kind::graph && !is_graph(g, claim.variable)) complain("not a graph", claim);
    if (claim.kind == Claim_kind::crossing) {
      ++crossings;
      // (On the unit cell's own boundary a singular point shows fewer zeros.)
      const bool inner = claim.box.lo[0] > 0 && claim.box.lo[1] > 0 && claim.box.hi[0] < 1 && claim.box.hi[1] < 1;
      const std::optional<int> zeros = zeros_on_boundary(g);
      if (inner && (!zeros || *zeros % 2 != 0)) complain("an odd number of zeros around a singular point", claim);
    }
    kept.push_back(claim);
  }

  bool complete() const { return open_.empty() && area == 1 && complaint.empty(); }

  std::string complaint;
  Rational area = 0;
  std::size_t leaves = 0, undecided = 0, crossings = 0, isolated = 0;
  std::vector<Claim<2>> kept;

private:
  using Key = std::array<double, 4>;
  static Key key(const Box<2>& b) { return {b.lo[0], b.hi[0], b.lo[1], b.hi[1]}; }

  static bool is_empty(const Bernstein<Rational, 2>& g)
  {
    int sign = 0;
    for (int i = 0; i <= g.degree(0); ++i)
      for (int j = 0; j <= g.degree(1); ++j) {
        const int s = sgn(g.at({i, j}));
        const bool corner = (i == 0 || i == g.degree(0)) && (j == 0 || j == g.degree(1));
        if (s == 0 && !corner) return false;
        if (s != 0 && sign != 0 && s != sign) return false;
        if (s != 0) sign = s;
      }
    // The curve may pass a cell's corner, not follow its side: beside a zero there must be none, on either side.
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const Degrees<2> corner{i * g.degree(0), j * g.degree(1)};
        if (g.at(corner) != 0) continue;
        for (std::size_t v = 0; v < 2; ++v) {
          Degrees<2> beside = corner;
          beside[v] += (v == 0 ? i : j) == 0 ? 1 : -1;
          if (g.degrees()[v] == 0 || g.at(beside) == 0) return false;
        }
      }
    return sign != 0;
  }

  static bool is_graph(const Bernstein<Rational, 2>& g, int variable)
  {
    int sign = 0;
    for (int i = 0; i <= g.degree(0); ++i)
      for (int j = 0; j <= g.degree(1); ++j) {
        if ((variable == 0 ? i : j) == g.degree(variable)) continue;
        const Rational difference = g.at(variable == 0 ? Degrees<2>{i + 1, j} : Degrees<2>{i, j + 1}) - g.at({i, j});
        if (sign == 0) sign = sgn(difference);
        if (sign == 0 || sgn(difference) != sign) return false;
      }
    return sign != 0;
  }

  void complain(const char* what, const Claim<2>& claim)
  {
    if (!complaint.empty()) return;
    complaint = std::string(what) + ": kind " + std::to_string(static_cast<int>(claim.kind)) + " on [" + show(claim.box.lo[0]) + ", " +
                show(claim.box.hi[0]) + "] x [" + show(claim.box.lo[1]) + ", " + show(claim.box.hi[1]) + "]";
  }

  Bernstein<Rational, 2> f_;
  std::set<Key> open_;
};

// ------------------------------------------------------------------------------------------------- solving and counts

struct Solved {
  bool certified = false, zero = false, verified = false;
  std::size_t arcs = 0, closed = 0, components = 0, boundary = 0, nodes = 0, ends = 0, isolated = 0, marks = 0, open = 0;
  std::size_t cells = 0, on_boundary = 0;
  std::vector<locus::Undecided_box> undecided;
  std::vector<std::array<double, 2>> node_places;
  std::vector<Claim<2>> claims;
  std::string complaint;

  /// The undecided part that a point lies in, or none.
  const locus::Undecided_box* around(double px, double py) const
  {
    for (const auto& u : undecided)
      if (u.box.lo[0] <= px && px <= u.box.hi[0] && u.box.lo[1] <= py && py <= u.box.hi[1]) return &u;
    return nullptr;
  }
};

std::string show(const Solved& s)
{
  std::ostringstream out;
  out << (s.certified ? "certified" : "undecided") << (s.zero ? ", zero" : "") << ", " << s.components << " components, " << s.arcs << " arcs ("
      << s.closed << " closed), " << s.boundary << " boundary, " << s.nodes << " nodes, " << s.ends << " ends, " << s.isolated << " isolated, "
      << s.marks << " marks, " << s.open << " open, " << s.cells << " cells. " << s.complaint;
  for (const auto& u : s.undecided)
    out << "\n  " << u.reason << " in [" << u.box.lo[0] << ", " << u.box.hi[0] << "] x [" << u.box.lo[1] << ", " << u.box.hi[1] << "]";
  return out.str();
}

Solved summary(const Curve_graph& g)
{
  Solved s;
  s.certified = g.is_certified();
  s.zero = g.identically_zero;
  s.undecided = g.undecided;
  s.cells = g.statistics.cells;
  s.arcs = g.arcs.size();
  s.components = g.components();
  std::vector<char> used(g.vertices.size(), 0);
  for (const auto& arc : g.arcs) {
    s.closed += arc.closed;
    if (!arc.closed) used[arc.source] = used[arc.target] = 1;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    const Graph_vertex& vertex = g.vertices[v];
    const auto fixed = [&](std::size_t k) { return vertex.at[k].inf() == vertex.at[k].sup() && (vertex.at[k].inf() == 0 || vertex.at[k].inf() == 1); };
    s.on_boundary += fixed(0) || fixed(1);
    s.isolated += vertex.kind == Graph_vertex::Kind::isolated;
    if (!used[v]) continue;
    s.boundary += vertex.kind == Graph_vertex::Kind::boundary;
    s.ends += vertex.kind == Graph_vertex::Kind::end;
    s.marks += vertex.kind == Graph_vertex::Kind::mark;
    s.open += vertex.kind == Graph_vertex::Kind::open;
    if (vertex.kind == Graph_vertex::Kind::node) {
      ++s.nodes;
      s.node_places.push_back({locus::midpoint(vertex.at[0]), locus::midpoint(vertex.at[1])});
    }
  }
  s.components += s.isolated;
  return s;
}

std::shared_ptr<const locus::Equation<2>> equation_of(const Bernstein<Rational, 2>& f)
{
  return std::make_shared<locus::Polynomial_equation<2>>(f);
}

using Causes = std::vector<std::array<Bivariate, 2>>;

Solved solve(const Bernstein<Rational, 2>& f, const Solve_control& control = {}, const Causes& crossings = {})
{
  return with_upward_rounding([&] {
    System<1, 2> system;
    system.name = "test";
    system.equations[0] = equation_of(f);
    for (const auto& c : crossings) {
      locus::Cause<2> cause;
      cause.name = "declared";
      cause.equations = {equation_of(c[0].bernstein()), equation_of(c[1].bernstein())};
      cause.proves = Claim_kind::crossing;
      system.causes.push_back(std::move(cause));
    }
    Verifier verifier(f);
    const Curve_graph graph = locus::solve_curves(system, control, &verifier);
    Solved s = summary(graph);
    s.verified = graph.identically_zero || verifier.complete();
    s.complaint = verifier.complaint;
    s.claims = std::move(verifier.kept);
    return s;
  });
}

Solved solve(const Bivariate& f, const Solve_control& control = {}, const Causes& crossings = {}) { return solve(f.bernstein(), control, crossings); }

/// What a curve must turn out to be.
struct Truth {
  std::size_t arcs = 0, closed = 0, components = 0, isolated = 0, nodes = 0;
};

void require(const char* name, const Bivariate& f, const Truth& truth, const Causes& crossings = {})
{
  // As it is, with x and y exchanged, mirrored, with the other sign, and written with higher degrees.
  for (int variant = 0; variant < 5; ++variant) {
    Bivariate g;
    Causes c = crossings;
    const auto change = [&](const Bivariate& h) {
      Bivariate k;
      for (const auto& [e, coefficient] : h.terms) {
        if (variant == 1) k = k + Bivariate(coefficient) * monomial(e.second, e.first);
        else if (variant == 2) {
          Bivariate term(coefficient);
          for (int i = 0; i < e.first; ++i) term = term * (Bivariate(1) - x);
          k = k + term * monomial(0, e.second);
        } else k = k + Bivariate(variant == 3 ? Rational(-coefficient) : coefficient) * monomial(e.first, e.second);
      }
      return k;
    };
    g = change(f);
    for (auto& pair : c) pair = {change(pair[0]), change(pair[1])};
    Degrees<2> degrees = g.degrees();
    if (variant == 4) degrees = {degrees[0] + 2, degrees[1] + 1};
    const Solved s = solve(g.bernstein(degrees), {}, c);
    INFO(name << ", variant " << variant << ": " << show(s));
    CHECK(s.certified);
    CHECK(s.verified);
    const std::array<std::size_t, 5> found{s.arcs, s.closed, s.components, s.isolated, s.nodes};
    const std::array<std::size_t, 5> expected{truth.arcs, truth.closed, truth.components, truth.isolated, truth.nodes};
    CHECK(found == expected);
    if (!s.certified || !s.verified || found != expected) return;
  }
}

/// It must stay undecided, with a part around the singular point and nothing claimed there.
void require_undecided(const char* name, const Bivariate& f, double px, double py, double size = 1e-3)
{
  const Solved s = solve(f);
  INFO(name << ": " << show(s));
  CHECK_FALSE(s.certified);
  CHECK(s.verified);
  const auto* u = s.around(px, py);
  REQUIRE(u != nullptr);
  CHECK(u->box.max_width() <= size);
}

} // namespace

// ------------------------------------------------------------------------------------------------------ whole curves

TEST_CASE("constants and the zero polynomial", "[curve_solver]")
{
  require("one", Bivariate(1), {});
  require("a line outside", x + y + 1, {});
  const Solved zero = solve(Bernstein<Rational, 2>(Degrees<2>{2, 3}));
  CHECK(zero.zero);
  CHECK(zero.arcs == 0u);
  const Solved constant = solve(Bernstein<Rational, 2>(Degrees<2>{0, 0}));
  CHECK(constant.zero);
  CHECK(solve(Bivariate(two_to(-1000))).certified);
  CHECK(solve(Bivariate(two_to(-3000))).certified); // below all doubles
}

TEST_CASE("lines: through corners, along faces and cuts", "[curve_solver]")
{
  require("diagonal", x - y, {1, 0, 1, 0, 0});
  require("other diagonal", x + y - 1, {1, 0, 1, 0, 0});
  require("from a corner", 2 * x - y, {1, 0, 1, 0, 0});
  require("from a corner, through no other cut", 3 * x - y, {1, 0, 1, 0, 0});
  require("cuts a corner off", x + y - q(1, 8), {1, 0, 1, 0, 0});
  require("touches a corner", x + y, {0, 0, 1, 1, 0});
  require("touches a corner, steep", x + Bivariate(two_to(30)) * y, {0, 0, 1, 1, 0});
  require("passes a corner by 2^-30", x + y + Bivariate(two_to(-30)), {});
  require("cuts 2^-30 off a corner", x + y - Bivariate(two_to(-30)), {1, 0, 1, 0, 0});
  require("x = 1/2", x - q(1, 2), {1, 0, 1, 0, 0});
  require("x = 1/3", x - q(1, 3), {1, 0, 1, 0, 0});
  require("x = 0", x, {1, 0, 1, 0, 0});
  require("x = 1", x - 1, {1, 0, 1, 0, 0});
  require("x = 0 and x = 1", x * (x - 1), {2, 0, 2, 0, 0});
  require("x = 0, and a factor without zeros", x * (y + 1) * (x + 2), {1, 0, 1, 0, 0});
  require("x = 1/2 and x = 1/4", (x - q(1, 2)) * (x - q(1, 4)), {2, 0, 2, 0, 0});
  require("x = 1/2 and 2^-9 beside", (x - q(1, 2)) * (x - q(1, 2) - Bivariate(two_to(-9))), {2, 0, 2, 0, 0});
  require("x = 1/3 and 2^-9 beside", (x - q(1, 3)) * (x - q(1, 3) - Bivariate(two_to(-9))), {2, 0, 2, 0, 0});
  require("x = 0 and 2^-9 beside", x * (x - Bivariate(two_to(-9))), {2, 0, 2, 0, 0});
  for (const Rational& at : {q(0), q(1, 2), q(1, 3)}) { // cells get as small as the gap all along it: a limit is reached
    Solve_control few;
    few.max_cells = 1000;
    const Solved close = solve((x - at) * (x - at - Bivariate(two_to(-30))), few);
    INFO(show(close));
    CHECK(close.verified);
    CHECK((!close.certified || close.arcs == 2));
  }
  require("five parallel lines", (x - y) * (x - y + q(1, 4)) * (x - y - q(1, 4)) * (x - y + q(1, 2)) * (x - y - q(1, 2)), {5, 0, 5, 0, 0});
}

TEST_CASE("circles with known answers", "[curve_solver]")
{
  require("inside", circle(q(1, 2), q(1, 2), q(1, 16)), {1, 1, 1, 0, 0});
  require("inside, off centre", circle(q(1, 3), q(3, 5), q(1, 50)), {1, 1, 1, 0, 0});
  require("too large", circle(q(1, 2), q(1, 2), q(1)), {});
  require("crosses one side", circle(q(0), q(1, 2), q(1, 16)), {1, 0, 1, 0, 0});
  require("crosses all sides", circle(q(1, 2), q(1, 2), q(5, 16)), {4, 0, 4, 0, 0});
  require("around a corner", circle(q(0), q(0), q(1, 4)), {1, 0, 1, 0, 0});
  require("through two corners", circle(q(0), q(0), q(1)), {1, 0, 1, 0, 0});
  require("through all corners, outside", circle(q(1, 2), q(1, 2), q(1, 2)), {0, 0, 4, 4, 0});
  require("through one corner, outside", circle(q(-1, 2), q(-1, 2), q(1, 2)), {0, 0, 1, 1, 0});
  require("through one corner, cutting", circle(q(1, 4), q(-1, 4), q(1, 8)), {1, 0, 1, 0, 0});
  require("touches one side from inside", circle(q(1, 4), q(1, 2), q(1, 16)), {1, 1, 1, 0, 0});
  require("touches one side from inside, no cut there", circle(q(1, 5), q(1, 3), q(1, 25)), {1, 1, 1, 0, 0});
  require("touches two sides from inside", circle(q(1, 5), q(1, 5), q(1, 25)), {1, 1, 1, 0, 0});
  require("touches all sides from inside", circle(q(1, 2), q(1, 2), q(1, 4)), {1, 1, 1, 0, 0});
  require("touches from outside", circle(q(-1, 4), q(1, 2), q(1, 16)), {0, 0, 1, 1, 0});
  require("touches from outside, no cut there", circle(q(-1, 5), q(1, 3), q(1, 25)), {0, 0, 1, 1, 0});
  require("misses by 2^-40", circle(q(-1, 5), q(1, 3), Rational(q(1, 25) - two_to(-40))), {});
  require("overlaps by 2^-40", circle(q(-1, 5), q(1, 3), Rational(q(1, 25) + two_to(-40))), {1, 0, 1, 0, 0});
  require("leaves by 2^-40 where it touched", circle(q(1, 5), q(1, 3), Rational(q(1, 25) + two_to(-40))), {1, 0, 1, 0, 0});
  require("stays inside by 2^-40", circle(q(1, 5), q(1, 3), Rational(q(1, 25) - two_to(-40))), {1, 1, 1, 0, 0});
  require("touches x = 1/2", circle(q(1, 4), q(1, 3), q(1, 16)), {1, 1, 1, 0, 0});
  require("touches x = 1/2 from both sides", circle(q(1, 4), q(1, 3), q(1, 16)) * circle(q(3, 4), q(2, 3), q(1, 16)), {2, 2, 2, 0, 0});
  require("of radius 2^-20", circle(q(1, 3), q(1, 5), two_to(-40)), {1, 1, 1, 0, 0});
  require("of radius 2^-20 around a cut", circle(q(1, 2), q(1, 4), two_to(-40)), {1, 1, 1, 0, 0});
  require("of radius 2^-30 around the centre", circle(q(1, 2), q(1, 2), two_to(-60)), {1, 1, 1, 0, 0});
  require("of radius 2^-25 around a corner", circle(q(1), q(0), two_to(-50)), {1, 0, 1, 0, 0});
  const auto wider = [](const Rational& d) { return circle(q(1, 2), q(1, 3), Rational((q(1, 4) + d) * (q(1, 4) + d))); };
  require("two, 2^-7 apart", circle(q(1, 2), q(1, 3), q(1, 16)) * wider(two_to(-7)), {2, 2, 2, 0, 0});
  // Cells must get as small as the gap all along it: here the limit is reached, and said so.
  Solve_control few;
  few.max_cells = 2000;
  const Solved close = solve(circle(q(1, 2), q(1, 3), q(1, 16)) * wider(two_to(-20)), few);
  CHECK(close.verified);
  CHECK((!close.certified || (close.arcs == 2 && close.closed == 2)));
}

TEST_CASE("random circles against their crossings with the sides", "[curve_solver]")
{
  Random random(201);
  Samples samples;
  for (int k = 0; k < 150; ++k) {
    const Rational cx = random.chance(70) ? random.unit_rational() : random.rational(), cy = random.chance(70) ? random.unit_rational() : random.rational();
    const Rational radius = random.unit_rational() * (random.chance(30) ? two_to(-random.between(1, 16)) : Rational(1));
    const Bivariate f = circle(cx, cy, Rational(radius * radius));
    if (radius == 0) continue;
    bool degenerate = false;
    int crossings = 0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) degenerate = degenerate || f.at(Rational(i), Rational(j)) == 0;
    for (int v = 0; v < 2; ++v)
      for (int side = 0; side < 2; ++side) {
        const Polynomial g = on_side(f.bernstein(), v, side);
        degenerate = degenerate || Rational(g[1] * g[1]) == 4 * g[0] * g[2];
        crossings += Sturm(g).open(Rational(0), Rational(1));
      }
    if (degenerate) continue;
    const bool inside = cx - radius > 0 && cx + radius < 1 && cy - radius > 0 && cy + radius < 1;
    const Solved s = solve(f);
    const std::size_t arcs = inside ? 1 : static_cast<std::size_t>(crossings / 2);
    samples.expect(s.certified && s.verified && s.arcs == arcs && s.closed == (inside ? 1u : 0u) && s.components == arcs &&
                     s.on_boundary == static_cast<std::size_t>(crossings),
                   [&] { return show_terms(f) + ": " + show(s); });
  }
  LOCUS_REQUIRE_SAMPLES(samples, 100);
}

TEST_CASE("close branches, and curves tangent to cuts", "[curve_solver]")
{
  for (const Rational& c : {q(1, 2), q(1, 3)})
    for (const Rational& d : {q(1, 2), q(2, 5)}) {
      const Bivariate saddle = (x - c) * (x - c) - (y - d) * (y - d);
      require("hyperbola, 2^-30 apart", saddle - Bivariate(two_to(-60)), {2, 0, 2, 0, 0});
      require("hyperbola, 2^-20 apart", saddle + Bivariate(two_to(-40)), {2, 0, 2, 0, 0});
      const Bivariate skew = (x - c) * (2 * x + 3 * y - Rational(2 * c + 3 * d));
      require("skew hyperbola", skew - Bivariate(two_to(-50)), {2, 0, 2, 0, 0});
    }
  require("parabola touching x = 1/2", x - q(1, 2) - (y - q(1, 3)) * (y - q(1, 3)), {1, 0, 1, 0, 0});
  require("parabola touching x = 1/2 in a cut", x - q(1, 2) + (y - q(1, 2)) * (y - q(1, 2)), {1, 0, 1, 0, 0});
  require("inflection along x = 1/2", x - q(1, 2) - (y - q(1, 2)) * (y - q(1, 2)) * (y - q(1, 2)), {1, 0, 1, 0, 0});
  require("flat inflection off the cuts", x - q(1, 2) - (y - q(1, 3)) * (y - q(1, 3)) * (y - q(1, 3)), {1, 0, 1, 0, 0});
  Bivariate fifth = y - q(1, 3);
  for (int i = 0; i < 4; ++i) fifth = fifth * (y - q(1, 3));
  require("contact of order five with x = 1/2", x - q(1, 2) - fifth, {1, 0, 1, 0, 0});
  require("parabola from outside, touching", y + (x - q(1, 3)) * (x - q(1, 3)), {0, 0, 1, 1, 0});
  require("parabola from inside, touching", y - (x - q(1, 3)) * (x - q(1, 3)), {1, 0, 1, 0, 0});
  require("two touches of one side", y - (x - q(1, 3)) * (x - q(1, 3)) * (x - q(2, 3)) * (x - q(2, 3)), {1, 0, 1, 0, 0});
  require("two touches from outside", y + (x - q(1, 4)) * (x - q(1, 4)) * (x - q(2, 3)) * (x - q(2, 3)), {0, 0, 2, 2, 0});
  require("contact of order three with a side", y - (x - q(1, 3)) * (x - q(1, 3)) * (x - q(1, 3)), {1, 0, 1, 0, 0});
  require("crosses a side, touches it, crosses it", y - (x - q(1, 5)) * (x - q(1, 2)) * (x - q(1, 2)) * (x - q(4, 5)), {2, 0, 3, 1, 0});
  require("crosses a side, touches it from inside, crosses it", y + (x - q(1, 5)) * (x - q(1, 2)) * (x - q(1, 2)) * (x - q(4, 5)), {1, 0, 1, 0, 0});
}

// -------------------------------------------------------------------------------------------------- singular points

TEST_CASE("singular points without a declared cause", "[curve_solver]")
{
  const Truth point{0, 0, 1, 1, 0}, cusp{2, 0, 1, 0, 1}, crossing{4, 0, 1, 0, 1}, triple{6, 0, 1, 0, 1};
  const auto at = [](const Rational& a, const Rational& b) { return std::array<Bivariate, 2>{x - a, y - b}; };
  const auto [hx, hy] = at(q(1, 2), q(1, 2));
  const auto [tx, ty] = at(q(1, 3), q(2, 5));
  require("two lines crossing in a cut", (x - y) * (x + y - 1), crossing);
  require("two lines crossing elsewhere", (x - q(1, 3)) * (3 * x + 5 * y - 3), crossing);
  require("a circle and a line", circle(q(1, 2), q(1, 2), q(1, 9)) * (x - y), {5, 0, 1, 0, 2});
  require("a cusp", hy * hy - hx * hx * hx, cusp);
  require("a cusp off the cuts", ty * ty - tx * tx * tx, cusp);
  require("a cusp of higher order", ty * ty - tx * tx * tx * tx * tx, cusp);
  require("a cusp in the corner", y * y - x * x * x, {1, 0, 1, 0, 0});
  require("an isolated point", circle(q(1, 3), q(1, 3), q(0)), point);
  require("an isolated point in a cut", circle(q(1, 2), q(1, 2), q(0)), point);
  require("an isolated point on a side", circle(q(0), q(1, 2), q(0)), point);
  require("an isolated point in a corner", circle(q(1), q(1), q(0)), point);
  require("a flat isolated point", tx * tx * tx * tx + ty * ty, point);
  require("a flatter one", tx * tx * tx * tx + ty * ty * ty * ty, point);
  require("a triple point", hx * hy * (x + y - 1), triple);
  require("a triple point off the cuts", tx * ty * (tx - Bivariate(q(3, 2)) * ty), triple);
  require("a triple point with two complex branches", tx * (tx * tx + ty * ty), {2, 0, 1, 0, 1});
  require("a tacnode", (hy - hx * hx) * (hy + hx * hx), crossing);
  require("a tacnode off the cuts", (ty - tx * tx) * (ty + Bivariate(2) * tx * tx), crossing);
  require("a tacnode along a diagonal", (tx - ty - (tx + ty) * (tx + ty)) * (tx - ty + (tx + ty) * (tx + ty)), crossing);
  require("branches in contact of order three", ty * (ty - tx * tx * tx), crossing);
  require("four lines through a point", tx * ty * (tx - ty) * (tx + ty), {8, 0, 1, 0, 1});
  require("a smooth branch that is singular as a zero set", tx * tx * tx - ty * ty * ty * ty * ty, {2, 0, 1, 0, 1});
  require("a cusp and a line through it", (ty * ty - tx * tx * tx) * tx, {4, 0, 1, 0, 1});
  require("lines crossing on a side", (x + y - q(1, 2)) * (y - x - q(1, 2)), {2, 0, 1, 0, 1});
  require("lines crossing in a corner", (2 * x - y) * (x - 2 * y), {2, 0, 1, 0, 1});
  require("a point just missed", circle(q(1, 3), q(1, 3), Rational(-two_to(-50))), {});
  require("a point just grown", circle(q(1, 3), q(1, 3), two_to(-50)), {1, 1, 1, 0, 0});
}

TEST_CASE("singular points with irrational coordinates", "[curve_solver]")
{
  const Bivariate sx = 2 * x * x - 1, sy = 3 * y * y - 1; // both vanish at (1/sqrt 2, 1/sqrt 3), and nowhere else in the cell
  require("an isolated point", sx * sx + sy * sy, {0, 0, 1, 1, 0});
  require("a node", sx * sx - sy * sy, {4, 0, 1, 0, 1});
  require("a cusp", sx * sx - sy * sy * sy, {2, 0, 1, 0, 1});
  require("a triple point", sx * sy * (sx + sy), {6, 0, 1, 0, 1});
  require("a tacnode", (sx - sy * sy) * (sx + Bivariate(q(1, 2)) * sy * sy), {4, 0, 1, 0, 1});
  for (const int k : {20, 30, 45, 60}) { // what was singular opens to either side
    const Bivariate e(two_to(-k));
    require("an isolated point that grew", sx * sx + sy * sy - e, {1, 1, 1, 0, 0});
    require("an isolated point that vanished", sx * sx + sy * sy + e, {});
    require("a node that opened", sx * sx - sy * sy - e, {2, 0, 2, 0, 0});
    require("a node that opened the other way", sx * sx - sy * sy + e, {2, 0, 2, 0, 0});
  }
}

TEST_CASE("what has no isolated singular point stays undecided", "[curve_solver]")
{
  require_undecided("all four sides", x * y * (x - 1) * (y - 1), 0, 0, 1);
  require_undecided("two sides", x * y, 0, 0);
}

TEST_CASE("components of multiplicity above one", "[curve_solver]")
{
  const auto multiplicities = [](const Bivariate& f) {
    return with_upward_rounding([&] {
      std::multiset<int> found;
      System<1, 2> squares;
      squares.equations[0] = equation_of(f.bernstein());
      const Curve_graph g = locus::solve_curves(squares);
      REQUIRE(g.is_certified());
      for (const auto& arc : g.arcs) {
        found.insert(arc.multiplicity);
        for (const auto& step : arc.steps) CHECK(g.pieces[step.piece].multiplicity == arc.multiplicity);
      }
      return found;
    });
  };
  using Set = std::multiset<int>;
  const Bivariate third = x - q(1, 3), half = x - q(1, 2), round = circle(q(1, 2), q(1, 2), q(1, 9));
  CHECK(multiplicities(third * third) == Set{2});
  CHECK(multiplicities(half * half * half) == Set{3});
  CHECK(multiplicities(x * x) == Set{2});
  CHECK(multiplicities(third * half) == Set{1, 1});
  CHECK(multiplicities(round * round) == Set{2});
  CHECK(multiplicities(third * third * half) == Set{2, 1});
  // A double circle that a line crosses: two arcs of the circle, three of the line.
  CHECK(multiplicities(round * round * (x - y)) == Set{2, 2, 1, 1, 1});
  CHECK(multiplicities(third * third * third * (x + y - 1) * (x + y - 1) * (y - q(1, 5))) == Set{3, 3, 3, 2, 2, 2, 1, 1, 1});
  // A simple circle next to a double one, and one that touches it.
  CHECK(multiplicities(round * round * circle(q(1, 2), q(1, 2), Rational(q(1, 9) + two_to(-8)))) == Set{1, 2});
  CHECK(multiplicities(round * round * circle(q(1, 2), q(1, 3), q(1, 36))) == Set{1, 2});
}

TEST_CASE("declared crossings become nodes", "[curve_solver]")
{
  const auto pair = [](const char* name, const Bivariate& f, const Bivariate& g, const Truth& truth) { require(name, f * g, truth, {{f, g}}); };
  pair("two lines crossing in a cut", x - y, x + y - 1, {4, 0, 1, 0, 1});
  pair("two lines crossing elsewhere", x - q(1, 3), 3 * x + 5 * y - 3, {4, 0, 1, 0, 1});
  pair("a circle and a line", circle(q(1, 2), q(1, 2), q(1, 9)), x - y, {5, 0, 1, 0, 2});
  pair("a circle and a vertical line", circle(q(1, 2), q(1, 2), q(1, 9)), x - q(1, 2), {5, 0, 1, 0, 2});
  pair("two circles", circle(q(2, 5), q(1, 2), q(1, 16)), circle(q(3, 5), q(1, 3), q(1, 16)), {4, 0, 1, 0, 2});
  pair("parallel lines", x - q(1, 3), x - q(2, 3), {2, 0, 2, 0, 0});
  pair("lines that would cross outside", x + 2 * y - 1, x + 2 * y - q(1, 2) - Bivariate(q(1, 100)) * x, {2, 0, 2, 0, 0});
  pair("crossing at an angle of 2^-8", y - q(1, 2), y - q(1, 2) - Bivariate(two_to(-8)) * (x - q(1, 3)), {4, 0, 1, 0, 1});
  pair("two nodes 2^-5 apart", y - q(1, 2), y - q(1, 2) - (x - q(1, 3)) * (x - q(1, 3) - Bivariate(two_to(-5))), {6, 0, 1, 0, 2});
  // Three lines in general position: a triangle with its continuations.
  const Bivariate a = x - q(1, 4), b = y - q(1, 4), c = x + y - 1;
  require("three lines", a * b * c, {9, 0, 1, 0, 3}, {{a, b}, {b, c}, {a, c}});
  // A declared cause that has no solutions, or whose solutions are elsewhere, changes nothing.
  require("a cause without solutions", x - y, {1, 0, 1, 0, 0}, {{x - y, x - y - 2}});
  // A double point that only touches: the cause is not regular there, and elimination proves the point.
  const Bivariate parabola = y - q(1, 2) - (x - q(1, 3)) * (x - q(1, 3));
  require("a parabola and its tangent", parabola * (y - q(1, 2)), {4, 0, 1, 0, 1}, {{parabola, y - q(1, 2)}});
}

TEST_CASE("declared crossings on the boundary keep the branches inside", "[curve_solver]")
{
  const auto pair = [](const char* name, const Bivariate& f, const Bivariate& g, std::size_t arcs, std::size_t components, std::size_t nodes, std::size_t ends,
                       std::size_t isolated) {
    const Solved s = solve(f * g, {}, {{f, g}});
    INFO(name << ": " << show(s));
    CHECK(s.verified);
    CHECK(s.certified);
    CHECK(s.arcs == arcs);
    CHECK(s.components == components);
    CHECK(s.nodes == nodes);
    CHECK(s.ends == ends);
    CHECK(s.isolated == isolated);
  };
  pair("both enter", x + y - q(1, 2), y - x - q(1, 2), 2, 1, 1, 0, 0);
  pair("both enter, on the far side", x - q(1) + y - q(1, 3), y - x + q(2, 3), 2, 1, 1, 0, 0);
  pair("both from a corner", 2 * x - y, x - 2 * y, 2, 1, 1, 0, 0);
  pair("one from a corner, one past it", x - y, x + y, 1, 1, 0, 1, 0);
  pair("both past a corner", 2 * x + y, x + 2 * y, 0, 1, 0, 0, 1);
}

// -------------------------------------------------------------------------------------------------------- limits

TEST_CASE("a limit leaves parts undecided and changes no answer", "[curve_solver]")
{
  const std::vector<std::pair<const char*, Bivariate>> curves{
    {"circle", circle(q(1, 2), q(1, 2), q(1, 9))},
    {"small circle", circle(q(1, 3), q(1, 5), two_to(-40))},
    {"hyperbola", (x - q(1, 3)) * (x - q(1, 3)) - (y - q(2, 5)) * (y - q(2, 5)) - Bivariate(two_to(-40))},
    {"line", x - y},
    {"cubic", y - q(1, 2) - 8 * (x - q(1, 5)) * (x - q(1, 2)) * (x - q(4, 5))},
    {"point", circle(q(1, 3), q(1, 3), q(0))}};
  for (const auto& [name, f] : curves) {
    const Solved full = solve(f);
    for (const std::size_t cells : {std::size_t(0), std::size_t(1), std::size_t(3), std::size_t(10), std::size_t(40)})
      for (const int depth : {0, 1, 3, 8, 40}) {
        Solve_control control;
        control.max_cells = cells;
        control.max_depth = depth;
        const Solved s = solve(f, control);
        INFO(name << ", " << cells << " cells, depth " << depth << ": " << show(s));
        CHECK(s.verified);
        CHECK(s.cells <= cells);
        if (s.certified) {
          CHECK(full.certified);
          CHECK(s.arcs == full.arcs);
          CHECK(s.closed == full.closed);
          CHECK(s.components == full.components);
        }
        // Whatever is not undecided is claimed: every zero lies in a graph cell or in an undecided part.
        bool covered = true;
        for (int k = 0; k <= 200; ++k) {
          const double u = k / 200.0;
          for (int side = 0; side < 2; ++side) {
            const Rational at(u);
            // Signs on neighbouring grid points: a change on a stretch needs a claim that allows it.
            if (k == 200) continue;
            const Rational other((k + 1) / 200.0), across = q(side ? 2 : 1, 5);
            if (sgn(f.at(at, across)) * sgn(f.at(other, across)) >= 0) continue;
            bool found = false;
            const double a = across.get_d();
            for (const auto& c : s.claims)
              found = found || (c.kind != Claim_kind::empty && c.box.lo[1] <= a && a <= c.box.hi[1] && c.box.lo[0] <= (k + 1) / 200.0 && u <= c.box.hi[0]);
            for (const auto& undecided : s.undecided)
              found = found || (undecided.box.lo[1] <= a && a <= undecided.box.hi[1] && undecided.box.lo[0] <= (k + 1) / 200.0 && u <= undecided.box.hi[0]);
            covered = covered && found;
          }
        }
        CHECK(covered);
      }
  }
  Solve_control three;
  three.max_cells = 3;
  three.max_depth = 3;
  CHECK_FALSE(solve(curves[0].second, three).certified);
  CHECK_FALSE(solve(curves[1].second, three).certified);
  CHECK_FALSE(solve(curves[2].second, three).certified);
  CHECK(solve(curves[3].second, three).certified);
  Solve_control shallow;
  shallow.max_depth = 3;
  CHECK_FALSE(solve(curves[1].second, shallow).certified); // a loop that could hide
}

TEST_CASE("cancellation, progress, time and size limits are honoured", "[curve_solver]")
{
  const Bivariate circle_form = circle(q(1, 2), q(1, 2), q(1, 9)), double_line = (x - y) * (x - y);
  {
    Solve_control control;
    control.cancel = std::make_shared<std::atomic<bool>>(true);
    const Solved s = solve(circle_form, control);
    CHECK_FALSE(s.certified);
    CHECK(s.cells == 0u);
    REQUIRE(s.undecided.size() == 1u);
    CHECK(s.undecided[0].reason == "cancelled");
    CHECK(s.verified);
  }
  {
    std::vector<std::size_t> done;
    std::vector<int> modes;
    Solve_control control;
    control.max_depth = 8;
    control.progress = [&](std::size_t d, std::size_t) {
      done.push_back(d);
      modes.push_back(observed_mode());
    };
    const Solved s = solve(double_line, control);
    CHECK_FALSE(s.certified);
    REQUIRE(done.size() > 4u);
    CHECK(std::is_sorted(done.begin(), done.end()));
    CHECK(done.back() == s.cells);
    CHECK(std::all_of(modes.begin(), modes.end(), [](int m) { return m == FE_TONEAREST; }));
    CHECK(observed_mode() == FE_TONEAREST);
  }
  { // cancelled from the progress callback, on its way
    Solve_control control;
    control.cancel = std::make_shared<std::atomic<bool>>(false);
    control.progress = [&](std::size_t d, std::size_t) {
      if (d >= 50) control.cancel->store(true);
    };
    const Solved s = solve(double_line, control);
    CHECK_FALSE(s.certified);
    CHECK(s.cells < 500u);
    CHECK(s.verified);
  }
  {
    Solve_control control;
    control.max_seconds = 0;
    const Solved s = solve(circle_form, control);
    CHECK_FALSE(s.certified);
    REQUIRE_FALSE(s.undecided.empty());
    CHECK(s.undecided[0].reason == "time limit");
  }
  { // elimination for the singular points of a form of degree 16 takes longer than this
    const Bivariate sx = 2 * x * x - 1, sy = 3 * y * y - 1, f = sx * sx - sy * sy * sy + sx * sx * sx * sy, g = f * f + sx * sx * sx * sx * sy * sy;
    Solve_control control;
    control.max_seconds = 0.05;
    System<1, 2> heavy;
    heavy.equations[0] = equation_of(g.bernstein());
    const auto start = std::chrono::steady_clock::now();
    CHECK_FALSE(with_upward_rounding([&] { return locus::solve_curves(heavy, control).is_certified(); }));
    CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 2);
  }
  {
    Solve_control control;
    control.max_seconds = 0.05;
    control.max_cells = 1u << 30;
    const auto start = std::chrono::steady_clock::now();
    const Solved s = solve(x * y, control);
    CHECK_FALSE(s.certified);
    CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 5);
  }
  {
    Solve_control control;
    control.max_bits = 4;
    const Solved s = solve(circle(q(1, 3), q(1, 3), q(0)), control);
    CHECK_FALSE(s.certified);
    REQUIRE_FALSE(s.undecided.empty());
    CHECK(s.around(1 / 3.0, 1 / 3.0) != nullptr);
    CHECK(s.around(1 / 3.0, 1 / 3.0)->reason == "bit limit");
  }
  { // an exception thrown by the observer's user reaches the caller, and the rounding mode is restored
    Solve_control control;
    control.progress = [](std::size_t, std::size_t) { throw std::runtime_error("stop"); };
    CHECK(thrown<std::runtime_error>([&] { solve(circle_form, control); }) == 1);
    CHECK(observed_mode() == FE_TONEAREST);
  }
}

TEST_CASE("solves run in parallel without sharing anything", "[curve_solver]")
{
  const Bivariate f = circle(q(1, 2), q(1, 2), q(1, 9)) * (x - y), g = x - y;
  const Solved alone = solve(f, {}, {{circle(q(1, 2), q(1, 2), q(1, 9)), g}});
  std::vector<Solved> results(4);
  std::vector<std::thread> threads;
  for (Solved& r : results) threads.emplace_back([&] { r = solve(f, {}, {{circle(q(1, 2), q(1, 2), q(1, 9)), g}}); });
  for (auto& t : threads) t.join();
  for (const Solved& r : results) {
    CHECK(r.certified);
    CHECK(r.arcs == alone.arcs);
    CHECK(r.cells == alone.cells);
    CHECK(r.nodes == alone.nodes);
  }
}

// ---------------------------------------------------------------------------------------------------- random curves

TEST_CASE("random polynomials: claims, boundary points and components", "[curve_solver]")
{
  // Small integer coefficients make degeneracies abound; perturbed ones come within 2^-45 of them.
  Random random(202);
  Samples claims, boundary, components;
  std::size_t certified = 0;
  for (int k = 0; k < 1200; ++k) {
    const Degrees<2> degrees = random.degrees<2>(random.chance(10) ? 0 : 1, 4);
    Bernstein<Rational, 2> f(degrees);
    const int kind = random.below(3);
    for (std::size_t i = 0; i < f.size(); ++i) {
      f[i] = kind == 2 ? Rational(random.between(-1000, 1000)) / 999 : Rational(random.between(-2, 2));
      if (kind == 1) f[i] += two_to(-45) * random.between(-1, 1);
    }
    Solve_control control;
    control.max_cells = 300;
    Solved s;
    std::string failure;
    try {
      s = solve(f, control);
    } catch (const std::exception& e) {
      failure = e.what();
    }
    const auto text = [&] { return show(degrees) + " " + show(f.coefficients()) + ": " + failure + " " + show(s); };
    claims.expect(failure.empty() && s.verified, text);
    if (!s.certified || s.zero || !failure.empty()) continue;
    ++certified;
    const auto zeros = zeros_on_boundary(f);
    if (zeros) boundary.expect(s.on_boundary == static_cast<std::size_t>(*zeros), text);
    std::vector<Real> c;
    for (const Rational& value : f.coefficients()) c.push_back(real_of(value));
    const auto basis = [&](int n, Real u) {
      std::vector<Real> b;
      for (int i = 0; i <= n; ++i)
        b.push_back(static_cast<Real>(choose(n, i).get_d()) * std::pow(u, static_cast<Real>(i)) * std::pow(1 - u, static_cast<Real>(n - i)));
      return b;
    };
    const auto is_positive = [&](const std::vector<Real>& a, const std::vector<Real>& b) {
      Real sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) sum += a[i] * b[j] * c[i * b.size() + j];
      return sum > 0;
    };
    const auto value = [&](Real u, Real v) { return is_positive(basis(degrees[0], u), basis(degrees[1], v)); };
    if (kind != 2) continue; // (the others may come closer than any grid can see)
    bool agree = false;
    for (const int n : {41, 160, 500}) {
      std::vector<std::vector<Real>> columns, rows;
      for (int i = 0; i <= n; ++i) {
        columns.push_back(basis(degrees[0], grid_line(n, i)));
        rows.push_back(basis(degrees[1], grid_line(n, i)));
      }
      const std::size_t found = grid_components(n, [&](std::size_t i, std::size_t j) { return is_positive(columns[i], rows[j]); }, value, {});
      // A curve that only touches the boundary may be seen or not.
      agree = found <= s.components && found + s.isolated >= s.components;
      if (agree) break;
    }
    components.expect(agree, text);
  }
  CHECK(certified > 600);
  LOCUS_REQUIRE_SAMPLES(claims, 1200);
  LOCUS_REQUIRE_SAMPLES(boundary, 500);
  LOCUS_REQUIRE_SAMPLES(components, 200);
}

TEST_CASE("vertices and arcs lie on the curve", "[curve_solver]")
{
  const Bivariate f = circle(q(1, 2), q(1, 3), q(1, 10)) * circle(q(3, 4), q(3, 4), q(1, 30)) - Bivariate(q(1, 1000));
  with_upward_rounding([&] {
    System<1, 2> system;
    system.equations[0] = equation_of(f.bernstein());
    const Curve_graph g = locus::solve_curves(system);
    CHECK(g.is_certified());
    Samples samples;
    for (const auto& vertex : g.vertices) {
      // A zero in an interval on a line: F changes sign between its ends, or is zero at one of them.
      const Rational x0(vertex.at[0].inf()), x1(vertex.at[0].sup()), y0(vertex.at[1].inf()), y1(vertex.at[1].sup());
      samples.expect((x0 == x1 || y0 == y1) && sgn(f.at(x0, y0)) * sgn(f.at(x1, y1)) <= 0, "a vertex off the curve");
      samples.expect(x1 - x0 <= two_to(-40) && y1 - y0 <= two_to(-40), "a wide vertex");
    }
    for (std::size_t k = 0; k < g.pieces.size(); ++k) {
      const auto& piece = g.pieces[k];
      const locus::Piece_evaluator e(g.forms[k], piece.base);
      const auto base = static_cast<std::size_t>(piece.base);
      const double lo = g.vertices[piece.from].at[base].sup(), hi = g.vertices[piece.to].at[base].inf();
      samples.expect(lo <= hi, "a piece that runs backwards");
      for (int i = 1; i < 8; ++i) {
        const double at = lo + (hi - lo) * i / 8;
        if (!(lo < at && at < hi)) continue;
        const Interval other = e.pivot_at(at, 0.5);
        const Rational s(at), a(other.inf()), b(other.sup());
        const int sa = sgn(base == 0 ? f.at(s, a) : f.at(a, s)), sb = sgn(base == 0 ? f.at(s, b) : f.at(b, s));
        samples.expect(sa * sb <= 0 && b - a < two_to(-40), "a point off the curve");
        const auto& box = g.forms[k].box;
        samples.expect(box.lo[1 - base] - 1e-12 <= other.inf() && other.sup() <= box.hi[1 - base] + 1e-12, "a point off its cell");
      }
    }
    for (const auto& arc : g.arcs) { // steps join
      std::size_t v = arc.source;
      bool joined = true;
      for (const auto& step : arc.steps) {
        const auto& piece = g.pieces[step.piece];
        joined = joined && (step.reversed ? piece.to : piece.from) == v;
        v = step.reversed ? piece.from : piece.to;
      }
      samples.expect(joined && v == arc.target, "steps of an arc that do not join");
    }
    std::set<std::size_t> used;
    std::size_t steps = 0;
    for (const auto& arc : g.arcs)
      for (const auto& step : arc.steps) {
        used.insert(step.piece);
        ++steps;
      }
    CHECK(steps == g.pieces.size());
    CHECK(used.size() == g.pieces.size());
    LOCUS_REQUIRE_SAMPLES(samples, 100);
  });
}

TEST_CASE("marks are put on their arcs without cutting anything else", "[curve_solver]")
{
  const Bivariate f = circle(q(1, 2), q(1, 2), q(1, 9)), g = x - y, far = x - q(1, 2) - Bivariate(q(1, 3)) * (y - q(1, 2));
  const auto marked = [](const Bivariate& curve, const Bivariate& first, const Bivariate& second) {
    return with_upward_rounding([&] {
      System<1, 2> system;
      system.equations[0] = equation_of(curve.bernstein());
      locus::Cause<2> cause;
      cause.name = "mark";
      cause.equations = {equation_of(first.bernstein()), equation_of(second.bernstein())};
      cause.proves = Claim_kind::isolated_box;
      system.causes.push_back(cause);
      return summary(locus::solve_curves(system));
    });
  };
  const Solved two = marked(f, f, g);
  INFO(show(two));
  CHECK(two.certified);
  CHECK(two.marks == 2u);
  CHECK(two.arcs == 2u);
  CHECK(two.closed == 0u);
  CHECK(two.components == 1u);
  const Solved also = marked(f, f, far);
  CHECK(also.certified);
  CHECK(also.marks == 2u);
  const Solved line = marked(x - q(1, 3), x - q(1, 3), y - q(1, 2));
  CHECK(line.certified);
  CHECK(line.marks == 1u);
  CHECK(line.arcs == 2u);
  // At the boundary the vertex itself is the mark, and the arc is not cut again.
  const Solved end = marked(x - y, x - y, y - 1);
  INFO(show(end));
  CHECK(end.certified);
  CHECK(end.arcs == 1u);
  CHECK(end.marks == 0u);
  // A mark in a cut, and one on the arc along the side.
  const Solved in_cut = marked(x - q(1, 2), x - q(1, 2), y - q(1, 2));
  INFO(show(in_cut));
  CHECK((!in_cut.certified || (in_cut.marks == 1 && in_cut.arcs == 2)));
  const Solved on_side = marked(x, x, y - q(1, 3));
  INFO(show(on_side));
  CHECK((!on_side.certified || on_side.arcs == 2));
}
