// SPDX-License-Identifier: LGPL-3.0-or-later
// Bisectors of a point and a plane curve, all contestants in turns in one run; and which of OCCT's points lie on the true
// bisector.
#include "side_by_side.h"

#include "plain_curve.h"

#include <locus/bisector_2.h>
#include <locus/construct/trimming_by_elimination.h>

#include <flint/flint.h>

#if LOCUS_HAS_OCCT
#include "peer_occt_point.h"
#endif

#include <cmath>
#include <cstdio>
#include <string>

namespace {

using locus_benchmark::Curve_data;
using locus_benchmark::keep;
using locus_benchmark::Plain_curve;
using locus_benchmark::Point;

constexpr int points_an_arc = 200;
constexpr double tolerance = 1e-6;

struct Problem {
  Problem(std::string name_of_it, Curve_data curve_of_it, locus::Coordinates_2 point_of_it)
    : name(std::move(name_of_it)), curve(std::move(curve_of_it)), point(std::move(point_of_it)), plain_curve(curve),
      plain_point{point.x.value().get_d(), point.y.value().get_d()}
  {
  }

  std::string name;
  Curve_data curve;
  locus::Coordinates_2 point;
  Plain_curve plain_curve; ///< the same in doubles
  Point plain_point;
};

std::vector<Problem> problems()
{
  const Curve_data parabola{{{-3, 9}, {0, -9}, {3, 9}}, {}};
  const Curve_data cubic{{{-2, -8}, {"-2/3", 8}, {"2/3", -8}, {2, 8}}, {}};
  const Curve_data bowl{{{-1, 1}, {-0.5, -1}, {0.5, -1}, {1, 1}}, {}};
  const Curve_data quartic{{{-1.5, 5.0625}, {-0.75, -5.0625}, {0, 5.0625}, {0.75, -5.0625}, {1.5, 5.0625}}, {}};
  const Curve_data wave{{{0, 0}, {1, 2}, {2, -1}, {3, 1}}, {}};
  return {{"y = x², p = (0.25, 1)", parabola, {0.25, 1}}, {"y = x³, p = (0.75, 0.5)", cubic, {0.75, 0.5}},
          {"cubic U, p = (0, 0.5)", bowl, {0, 0.5}},      {"cubic U, p = (0.3, 3)", bowl, {"3/10", 3}},
          {"y = x⁴, p = (0.25, 0.75)", quartic, {0.25, 0.75}}, {"cubic wave, p = (1, 2)", wave, {1, 2}}};
}

// ----------------------------------------------------------------------------------------------------- contestants

/// Both jobs start from control points in memory.
struct Contestant {
  std::string name;
  std::function<void()> construct, construct_and_sample;
};

#if LOCUS_HAS_OCCT
/// What one side's points are worth.
struct Occt_side {
  std::size_t points = 0, off = 0;
  double worst = 0, length = 0;
};

Occt_side judged(const Problem& problem, double side)
{
  const auto arc = occt_point_arc(problem.plain_curve, problem.plain_point, side, points_an_arc);
  Occt_side result{arc.size(), 0, 0, length(arc)};
  for (const Point& q : arc) {
    const bool finite = std::isfinite(q.x) && std::isfinite(q.y);
    const double difference = finite ? std::abs(distance(q, problem.plain_point) - problem.plain_curve.distance_from(q)) : 1e300;
    result.off += difference > tolerance;
    result.worst = std::max(result.worst, difference);
  }
  return result;
}

/// The side with the most right points, of equals the longer one.
double better_side(const Problem& problem)
{
  const Occt_side left = judged(problem, 1), right = judged(problem, -1);
  const std::size_t good_left = left.points - left.off, good_right = right.points - right.off;
  return good_left > good_right || (good_left == good_right && left.length >= right.length) ? 1 : -1;
}

Contestant occt(const std::string& name, const Problem& problem, const std::vector<double>& sides)
{
  const Plain_curve& c = problem.plain_curve;
  const Point& p = problem.plain_point;
  return {name,
          [=, &c, &p] {
            for (const double side : sides) keep(occt_point_bisector(c, p, side));
          },
          [=, &c, &p] {
            for (const double side : sides) keep(occt_point_arc(c, p, side, points_an_arc));
          }};
}
#endif

/// The whole true bisector, certified, with its points spread over all arcs.
Contestant locus_contestant(const Problem& problem)
{
  return {"locus, certified",
          [&problem] { keep(locus::bisector(problem.point, problem.curve.curve())); },
          [&problem] {
            const auto bisector = locus::bisector(problem.point, problem.curve.curve());
            const std::size_t each = std::max<std::size_t>(2, points_an_arc / bisector.arcs().size());
            for (const auto& arc : bisector.arcs()) keep(arc.samples(each));
          }};
}

/// One entry for each pair of columns; the same names for every problem. The problem has to outlive them.
std::vector<Contestant> contestants([[maybe_unused]] const Problem& problem)
{
  std::vector<Contestant> all{locus_contestant(problem)};
#if LOCUS_HAS_OCCT
  all.push_back(occt("OCCT, better side", problem, {better_side(problem)}));
  all.push_back(occt("OCCT, both sides", problem, {1, -1}));
#endif
  return all;
}

// ----------------------------------------------------------------------------------------------------------- tables

/// Pads by characters, which printf would do by bytes.
void print_name(const std::string& name)
{
  const auto characters = std::count_if(name.begin(), name.end(), [](char c) { return (c & 0xC0) != 0x80; });
  std::printf("  %s%*s", name.c_str(), static_cast<int>(std::max<std::ptrdiff_t>(0, 28 - characters)), "");
}

void print_head(const std::vector<Contestant>& all)
{
  print_name("");
  for (const Contestant& c : all) std::printf(" %23s", c.name.c_str());
  std::printf("\n");
  print_name("");
  for (std::size_t i = 0; i < all.size(); ++i) std::printf(" %11s %7d pts", "construct", points_an_arc);
  std::printf("\n");
}

void print_times(const Problem& problem, const std::vector<Contestant>& all)
{
  std::vector<std::function<void()>> jobs;
  for (const Contestant& c : all) {
    jobs.push_back(c.construct);
    jobs.push_back(c.construct_and_sample);
  }
  print_name(problem.name);
  const auto times = locus_benchmark::side_by_side(jobs, 11, 0.02);
  for (const auto& t : times) std::printf(" %11.1f", 1e6 * t.median);
  if (times.size() == 6) std::printf("  %6.1f %6.1f", times[0].median / times[4].median, times[1].median / times[5].median);
  std::printf("\n");
}

#if LOCUS_HAS_OCCT
void print_occt_points(const Problem& problem)
{
  print_name(problem.name);
  for (const double side : {1.0, -1.0}) {
    const Occt_side s = judged(problem, side);
    if (s.points == 0)
      std::printf("  %27s", "no points");
    else
      std::printf("  %3zu (%5.1f %%), worst %7.1e", s.off,
                  100.0 * static_cast<double>(s.off) / static_cast<double>(s.points), s.worst);
  }
  std::printf("   better: %s\n", better_side(problem) > 0 ? "left" : "right");
}
#endif

/// The polynomial of self-intersections (95): its real roots, its construction, and both ways of trimming.
void print_elimination()
{
  const locus::Curve_2 cubic = locus::monomial_curve<2>({{{0, 1}, {0, 0, 0, 1}}}, {}, {locus::Rational(-2), locus::Rational(2)});
  const locus::Coordinates_2 p{"3/4", "1/2"};
  const locus::Self_intersection_forms forms(cubic.pieces()[0], p.exact());
  const locus::Integer_polynomial p_i = locus::self_intersection_polynomials(forms).p_i;
  const std::vector<std::function<void()>> jobs{[&] { keep(locus::real_roots(p_i)); }, [&] { keep(locus::self_intersection_polynomials(forms)); },
                                                [&] { keep(locus::self_intersections(forms)); }, [&] { keep(locus::trimmed_by_elimination(p, cubic)); },
                                                [&] { keep(locus::bisector(p, cubic)); }};
  const auto times = locus_benchmark::side_by_side(jobs, 11, 0.02);
  std::printf("y = x³ on [-2, 2], p = (0.75, 0.5), µs: %zu real roots of P_i of degree %d %.1f (FLINT " FLINT_VERSION " isolates none: ABSENT);\n"
              "P_i, Λ, P_c by elimination %.0f; self-intersections as pairs %.0f; trimming by elimination %.0f, directly %.0f\n",
              locus::real_roots(p_i).size(), locus::degree(p_i), 1e6 * times[0].median, 1e6 * times[1].median, 1e6 * times[2].median,
              1e6 * times[3].median, 1e6 * times[4].median);
}

} // namespace

int main()
{
  const std::vector<Problem> all = problems();
  std::printf("Bisectors of a point and a plane curve: processor time of one job in µs, median of the rounds,\n");
  std::printf("of the construction alone and with %d points: on either side of OCCT's, on the whole bisector of locus; last the ratios\n"
              "of locus to OCCT's both sides\n",
              points_an_arc);
  print_head(contestants(all.front()));
  for (const Problem& problem : all) print_times(problem, contestants(problem));
  print_elimination();
#if LOCUS_HAS_OCCT
  std::printf("OCCT's points, of %d a side, whose distances to the point and to the whole curve differ by more than %.0e\n",
              points_an_arc, tolerance);
  print_name("");
  std::printf("  %27s  %27s\n", "left", "right");
  for (const Problem& problem : all) print_occt_points(problem);
#else
  std::printf("OCCT: ABSENT, not compared\n");
#endif
}
