// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_CERTIFICATE_TREE_H
#define LOCUS_IO_CERTIFICATE_TREE_H

#include <locus/constraint/f1_f2.h>
#include <locus/construct/planar_evidence.h>

#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace locus {
namespace detail {

// What a certificate says in other words than the solver: powers instead of Bernstein coefficients, and the tree of cells
// as a list in which each cell comes before its parts.

/// An equation's coefficients of powers: integers up to one positive factor.
class Power_table {
public:
  explicit Power_table(Bernstein<Integer, 2> c) : c_(std::move(c))
  {
    Integer common = 0;
    for (const Integer& x : c_.coefficients()) common = gcd(common, x);
    if (common > 1)
      for (std::size_t i = 0; i < c_.size(); ++i) c_[i] /= common;
  }

  const std::vector<Integer>& coefficients() const { return c_.coefficients(); }

  Rational value(const Rational& x, const Rational& y) const
  {
    Rational sum = 0;
    for (int i = c_.degree(0); i >= 0; --i) {
      Rational row = 0;
      for (int j = c_.degree(1); j >= 0; --j) row = row * y + c_.at({i, j});
      sum = sum * x + row;
    }
    return sum;
  }

private:
  Bernstein<Integer, 2> c_;
};

inline Power_table power_table(const Bernstein<Scaled_integer, 2>& f)
{
  Scaled_form form(f);
  for (int v = 0; v < 2; ++v) shift_basis(form.c, v, true);
  return Power_table(std::move(form.c));
}

/// Integers in one positive proportion to fractions.
inline std::vector<std::vector<Integer>> cleared(const std::vector<std::vector<Rational>>& lists)
{
  Integer denominator = 1, common = 0;
  for (const auto& list : lists)
    for (const Rational& x : list) denominator = lcm(denominator, x.get_den());
  std::vector<std::vector<Integer>> out;
  for (const auto& list : lists) {
    out.emplace_back();
    for (const Rational& x : list) {
      out.back().push_back(Integer(x.get_num() * (denominator / x.get_den())));
      common = gcd(common, out.back().back());
    }
  }
  if (common > 1)
    for (auto& list : out)
      for (Integer& x : list) x /= common;
  return out;
}

/// A piece's x, y and w in powers of its local coordinate, out of the frame.
inline std::vector<std::vector<Integer>> point_powers(const Planar_curve& c, const Frame<2>& frame)
{
  std::vector<std::vector<Rational>> forms;
  const std::vector<Rational> w = to_monomial(c.weight());
  for (std::size_t v = 0; v < 2; ++v) {
    std::vector<Rational> x = to_monomial(c.numerator(v));
    x.resize(std::max(x.size(), w.size()), Rational(0));
    for (Rational& a : x) {
      if (frame.exponent >= 0) mpq_mul_2exp(a.get_mpq_t(), a.get_mpq_t(), static_cast<mp_bitcnt_t>(frame.exponent));
      else mpq_div_2exp(a.get_mpq_t(), a.get_mpq_t(), static_cast<mp_bitcnt_t>(-frame.exponent));
    }
    for (std::size_t i = 0; i < w.size(); ++i) x[i] += frame.origin[v] * w[i];
    forms.push_back(std::move(x));
  }
  forms.push_back(w);
  return cleared(forms);
}

/// The tangent's powers, along the direction of travel.
inline std::vector<std::vector<Integer>> tangent_powers(const Planar_curve& c)
{
  const Rational half(1, 2);
  Rational along = 0;
  for (std::size_t v = 0; v < 2; ++v)
    along += evaluate_at(velocity_numerator(c.numerator(v), c.weight()), half) * evaluate_at(c.tangent(v), half);
  std::vector<std::vector<Integer>> powers = cleared({to_monomial(c.tangent(0)), to_monomial(c.tangent(1))});
  if (along < 0)
    for (auto& f : powers)
      for (Integer& x : f) x = -x;
  return powers;
}

inline bool has_root_on_unit_interval(const std::vector<Integer>& powers)
{
  return !exact_roots(bernstein_form(powers), Rational(0), Rational(1)).roots.empty();
}

/// What was divided out of F3 as -Im(e² ā b̄) stands, w² on circles included.
struct Known_factors {
  std::array<std::vector<Integer>, 2> univariate;
  Diagonal diagonal;
  int diagonal_power = 0;

  explicit Known_factors(const F3_problem& problem)
  {
    const Planar_curve &first = *problem.first, &second = *problem.second;
    std::array<Bernstein<Rational, 1>, 2> product;
    for (std::size_t v = 0; v < 2; ++v) product[v] = Bernstein<Rational, 1>(Degrees<1>{0}, {Rational(1)});
    if (first.is_circle() || second.is_circle()) {
      const auto general = exact_form<F3_form>(first, second);
      const auto reduced = Curve_pair_equation<F3_form>(problem.first, problem.second).exact().rational();
      for (int v = 0; v < 2; ++v) product[static_cast<std::size_t>(v)] = univariate_quotient(general, reduced, v);
    }
    for (const auto& known : problem.system.known_factors) {
      const Bernstein<Rational, 2> f = known->exact().rational();
      if (f.degree(0) > 0 && f.degree(1) > 0) {
        ++diagonal_power;
        continue;
      }
      const std::size_t v = f.degree(0) > 0 ? 0 : 1;
      product[v] = multiply(product[v], Bernstein<Rational, 1>(Degrees<1>{f.degree(static_cast<int>(v))}, f.coefficients()));
    }
    for (std::size_t v = 0; v < 2; ++v) {
      univariate[v] = cleared({to_monomial(product[v])})[0];
      trim(univariate[v]);
    }
    for (const Degenerate_component& d : problem.degenerate)
      if (d.kind == Degenerate_component::Kind::overlap) diagonal = d.line;
  }

private:
  /// One factor of a quotient that is a product of polynomials in one variable each.
  static Bernstein<Rational, 1> univariate_quotient(const Bernstein<Rational, 2>& f, const Bernstein<Rational, 2>& g, int variable)
  {
    for (int k = 1;; ++k) { // all but a few values of the other variable will do
      const Rational at(k, k + 2);
      const Bernstein<Rational, 1> numerator = on_value(f, 1 - variable, at), denominator = on_value(g, 1 - variable, at);
      const auto is_nothing = [](const Bernstein<Rational, 1>& h) {
        return std::all_of(h.coefficients().begin(), h.coefficients().end(), [](const Rational& c) { return c == 0; });
      };
      if (!is_nothing(numerator) && !is_nothing(denominator)) return divide_exactly(numerator, denominator);
    }
  }

  static Bernstein<Rational, 1> on_value(const Bernstein<Rational, 2>& f, int variable, const Rational& at)
  {
    return face(split(f, variable, at).first, variable, true);
  }
};

/// The cells of a solve, rebuilt from its claims: they come level by level.
class Certificate_tree {
public:
  Certificate_tree(const std::vector<Claim<2>>& claims, const Power_table& equation, const Curve_graph* graph)
    : equation_(equation), graph_(graph)
  {
    nodes_.push_back({});
    std::deque<std::size_t> open{0};
    for (const Claim<2>& claim : claims) {
      if (claim.kind == Claim_kind::isolated_box) continue;
      if (open.empty()) { // a second solve, which counts
        nodes_.assign(1, {});
        open.assign(1, 0);
      }
      const std::size_t at = open.front();
      open.pop_front();
      nodes_[at].claim = &claim;
      if (claim.kind != Claim_kind::split) continue;
      nodes_[at].low = nodes_.size();
      open.insert(open.end(), {nodes_.size(), nodes_.size() + 1});
      nodes_.resize(nodes_.size() + 2);
    }
    if (!open.empty()) throw std::logic_error("locus: a cell without a claim");
    list(0);
  }

  const std::vector<std::string>& tokens() const { return tokens_; }
  /// The special points that cells name, in their order.
  const std::vector<std::size_t>& singular() const { return singular_; }
  /// The cell of a special point.
  std::size_t cell_of_special(std::size_t k) const { return singular_cell_.at(k); }
  bool has_cell_of_special(std::size_t k) const { return singular_cell_.count(k) != 0; }
  /// The list's number of one of the solver's cells.
  std::size_t number_of(std::size_t cell) const { return nodes_.at(cell).number; }

private:
  struct Node {
    const Claim<2>* claim = nullptr;
    std::size_t low = 0, number = 0;
  };

  void list(std::size_t at)
  {
    nodes_[at].number = tokens_.size();
    tokens_.push_back(token(*nodes_[at].claim));
    if (nodes_[at].low == 0) return;
    list(nodes_[at].low);
    list(nodes_[at].low + 1);
  }

  std::string token(const Claim<2>& c)
  {
    const char variable = c.variable == 0 ? '0' : '1';
    switch (c.kind) {
    case Claim_kind::split: return std::string(1, variable) + ' ' + Rational(c.at).get_str();
    case Claim_kind::empty: return std::string("e") + sign_name(centre_value(c.box));
    case Claim_kind::graph: return std::string("g") + variable + sign_name(rise(c.box, static_cast<std::size_t>(c.variable)));
    case Claim_kind::crossing: return "s" + std::to_string(singular_number(c));
    case Claim_kind::outside: return "o";
    case Claim_kind::undecided:
    case Claim_kind::isolated_box: break;
    }
    return "u";
  }

  static char sign_name(const Rational& x) { return x > 0 ? '+' : '-'; }

  static Rational middle(const Box<2>& box, std::size_t v) { return (Rational(box.lo[v]) + Rational(box.hi[v])) / 2; }
  Rational centre_value(const Box<2>& box) const { return equation_.value(middle(box, 0), middle(box, 1)); }

  /// Difference of the values on both sides across a variable.
  Rational rise(const Box<2>& box, std::size_t v) const
  {
    std::array<Rational, 2> low{middle(box, 0), middle(box, 1)}, high = low;
    low[v] = Rational(box.lo[v]);
    high[v] = Rational(box.hi[v]);
    return equation_.value(high[0], high[1]) - equation_.value(low[0], low[1]);
  }

  std::size_t singular_number(const Claim<2>& c)
  {
    singular_.push_back(special_in(c));
    singular_cell_[singular_.back()] = tokens_.size();
    return singular_.size() - 1;
  }

  /// The claim names its point; the first that touches the cell is it where it does not.
  std::size_t special_in(const Claim<2>& c) const
  {
    if (graph_) {
      const auto touches = [&](std::size_t k) {
        const Isolated_point& point = graph_->special[k];
        const auto& p = point.box;
        return (point.evidence || point.tag == tag_of(F3_cause::meeting) || point.tag == tag_of(F3_cause::axis)) && p[0].sup() >= c.box.lo[0] &&
               p[0].inf() <= c.box.hi[0] && p[1].sup() >= c.box.lo[1] && p[1].inf() <= c.box.hi[1];
      };
      if (c.special < graph_->special.size() && touches(c.special)) return c.special;
      for (std::size_t k = 0; k < graph_->special.size(); ++k)
        if (touches(k)) return k;
    }
    throw std::logic_error("locus: a node's cell without its point");
  }

  const Power_table& equation_;
  const Curve_graph* graph_;
  std::vector<Node> nodes_;
  std::vector<std::string> tokens_;
  std::vector<std::size_t> singular_;
  std::map<std::size_t, std::size_t> singular_cell_;
};

} // namespace detail
} // namespace locus

#endif
