// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_IO_CERTIFICATE_H
#define LOCUS_IO_CERTIFICATE_H

#include <locus/io/certificate_tree.h>
#include <locus/io/json_result.h>
#include <locus/io/json_text.h>

#include <map>
#include <set>

namespace locus {
namespace detail {

/// Writes exact numbers: small integers as JSON numbers, others and fractions as strings.
class Exact_writer {
public:
  explicit Exact_writer(std::ostream& out) : json(out) {}

  Exact_writer& value(const Integer& x)
  {
    if (mpz_sizeinbase(x.get_mpz_t(), 2) <= 50) json.value(x.get_si());
    else json.value(x.get_str());
    return *this;
  }
  Exact_writer& value(const Rational& x)
  {
    if (x.get_den() == 1) return value(x.get_num());
    json.value(x.get_str());
    return *this;
  }
  Exact_writer& range(const Rational& lo, const Rational& hi)
  {
    json.open('[');
    value(lo);
    if (lo != hi) value(hi);
    json.close(']');
    return *this;
  }
  template <class T>
  Exact_writer& list(const std::vector<T>& items)
  {
    json.open('[');
    for (const T& x : items) value(x);
    json.close(']');
    return *this;
  }

  /// A part of a job, number for number as it stands there.
  void copy(const Json_value& v)
  {
    using Kind = Json_value::Kind;
    switch (v.kind) {
    case Kind::null: json.null(); return;
    case Kind::boolean: json.value(v.truth); return;
    case Kind::number: copy_number(v.text); return;
    case Kind::string: json.value(v.text); return;
    case Kind::array:
    case Kind::object: break;
    }
    const bool is_object = v.kind == Kind::object;
    json.open(is_object ? '{' : '[');
    for (std::size_t i = 0; i < v.items.size(); ++i) {
      if (is_object) json.key(v.keys[i]);
      copy(v.items[i]);
    }
    json.close(is_object ? '}' : ']');
  }

  Json_writer json;

private:
  /// Whole numbers stay numbers; other decimals become strings, which are read the same.
  void copy_number(const std::string& text)
  {
    const bool is_whole = text.size() < 16 && text.find_first_not_of("-0123456789") == std::string::npos;
    if (is_whole) json.value(std::stoll(text));
    else json.value(text);
  }
};

/// Writes the proof of a planar bisector; doc/certificate.md describes the format.
class Certificate_writer {
public:
  Certificate_writer(std::ostream& out, const Locus<2>& result, const Json_value& job)
    : out_(out), json_(out_.json), result_(result), job_(job), evidence_(dynamic_cast<const Planar_evidence*>(result.evidence().get()))
  {
    if (!evidence_) throw std::invalid_argument("a certificate needs a result that kept its evidence");
    number_patches();
  }

  void run()
  {
    json_.open('{').key("locus_certificate").value(1);
    json_.line(1).key("compute").value("bisector").key("solve_seconds").value(result_.statistics().seconds);
    write_curves();
    json_.line(1).key("empty_pairs").open('[');
    for (const auto& pair : evidence_->purged) json_.list(pair);
    json_.close(']');
    json_.line(1).key("patches").open('[');
    for (const auto& patch : patches_) write_patch(patch);
    json_.close(']').line(1).key("lines").open('[');
    for (const auto& line : lines_) write_line(line);
    json_.close(']');
    write_arcs();
    write_undecided();
    json_.finish();
  }

private:
  // ------------------------------------------------------------------------------------------------------- inputs

  void write_curves()
  {
    const Json_value* inputs = job_.find("inputs");
    if (!inputs || inputs->items.size() != (evidence_->is_self ? 1u : 2u)) throw std::invalid_argument("the job is not that of the result");
    json_.line(1).key("curves").open('[');
    for (std::size_t k = 0; k < inputs->items.size(); ++k) {
      json_.line(2).open('{').key("input");
      out_.copy(inputs->items[k]);
      const Planar_pieces& pieces = *evidence_->inputs[k];
      json_.line(3).key("pieces").open('[');
      for (std::size_t i = 0; i < pieces.size(); ++i) write_piece(*pieces.curves[i], pieces.chain.pieces[i]);
      json_.close(']').line(3).key("joints").open('[');
      for (const Joint& j : pieces.chain.joints) json_.value(j.by_tolerance ? "tolerance" : j.goes_on() ? "smooth" : "corner");
      json_.close(']').close('}');
    }
    json_.close(']');
  }

  void write_piece(const Planar_curve& c, const Piece& range)
  {
    json_.line(4).open('{').key("range").open('[');
    if (range.lo_infinite) json_.value("-inf");
    else out_.value(range.lo);
    if (range.hi_infinite) json_.value("inf");
    else out_.value(range.hi);
    json_.close(']');
    constexpr const char* names[] = {"x", "y", "w"};
    const auto forms = point_powers(c, evidence_->frame);
    for (std::size_t v = 0; v < 3; ++v) {
      json_.key(names[v]);
      out_.list(forms[v]);
    }
    json_.key("tangent").open('[');
    for (const auto& f : tangent_powers(c)) out_.list(f);
    json_.close(']').close('}');
  }

  // ------------------------------------------------------------------------------------------------------ numbering

  /// A solve with its graph in the certificate's numbers. Pieces and vertices of an axis belong to a line, not to the patch.
  struct Numbered {
    const Planar_solve_evidence* solve = nullptr;
    const Patch* patch = nullptr; ///< of the patchwork; none where nothing was found
    std::vector<std::size_t> vertices, pieces;         ///< of the graph, in the certificate's order
    std::map<std::size_t, std::size_t> vertex, piece;  ///< and back
    std::size_t of = 0;                                ///< for a line of a plain cell: which patch has the other factor
  };

  void number_patches()
  {
    for (const Planar_solve_evidence& s : evidence_->solves) {
      Numbered n;
      n.solve = &s;
      if (s.patch) n.patch = &evidence_->solution->work.patches[*s.patch];
      if (s.problem.chart.is_axis) {
        axes_.insert(s.pair);
        number_line(n);
        continue;
      }
      if (n.patch) number(n);
      patches_.push_back(n);
      if (!s.has_axis()) continue;
      Numbered line;
      line.solve = n.solve;
      line.patch = n.patch;
      line.of = patches_.size() - 1;
      number_line(line);
    }
  }

  static bool is_on_axis(const Numbered& n, std::size_t piece)
  {
    return n.solve->problem.chart.is_axis || (n.solve->has_axis() && n.patch->graph.forms[piece].equation == n.solve->problem.axis->equations[0]);
  }

  static bool meets_axis(const Numbered& n, std::size_t vertex)
  {
    const Curve_graph& g = n.patch->graph;
    const int cause = g.vertices[vertex].cause;
    return cause >= 0 && (n.solve->has_axis() || n.solve->problem.chart.is_axis) && g.special[static_cast<std::size_t>(cause)].tag == tag_of(F3_cause::axis);
  }

  static void number(Numbered& n)
  {
    const Curve_graph& g = n.patch->graph;
    std::vector<char> used(g.vertices.size(), 0), on_axis(g.vertices.size(), 0);
    for (std::size_t k = 0; k < g.pieces.size(); ++k) {
      for (const std::size_t v : {g.pieces[k].from, g.pieces[k].to}) (is_on_axis(n, k) ? on_axis : used)[v] = 1;
      if (is_on_axis(n, k)) continue;
      n.piece[k] = n.pieces.size();
      n.pieces.push_back(k);
    }
    for (std::size_t v = 0; v < used.size(); ++v) {
      const bool alone = g.vertices[v].kind == Graph_vertex::Kind::isolated || (on_axis[v] && meets_axis(n, v));
      if (!used[v] && !alone) continue;
      n.vertex[v] = n.vertices.size();
      n.vertices.push_back(v);
    }
  }

  /// Along the line: by t, or by the distance from a blown-up corner.
  void number_line(Numbered n)
  {
    if (!n.patch) return;
    const Curve_graph& g = n.patch->graph;
    const std::size_t along = n.solve->problem.chart.is_axis ? 1 : 0;
    std::set<std::size_t> used;
    for (std::size_t k = 0; k < g.pieces.size(); ++k)
      if (is_on_axis(n, k)) used.insert({g.pieces[k].from, g.pieces[k].to});
    n.vertices.assign(used.begin(), used.end());
    std::sort(n.vertices.begin(), n.vertices.end(), [&](std::size_t a, std::size_t b) { return g.vertices[a].at[along].inf() < g.vertices[b].at[along].inf(); });
    for (std::size_t k = 0; k < n.vertices.size(); ++k) n.vertex[n.vertices[k]] = k;
    n.pieces.resize(n.vertices.empty() ? 0 : n.vertices.size() - 1);
    for (std::size_t k = 0; k < g.pieces.size(); ++k) {
      if (!is_on_axis(n, k)) continue;
      n.piece[k] = std::min(n.vertex[g.pieces[k].from], n.vertex[g.pieces[k].to]);
      n.pieces.at(n.piece[k]) = k;
    }
    lines_.push_back(std::move(n));
  }

  // -------------------------------------------------------------------------------------------------------- patches

  void write_patch(const Numbered& n)
  {
    const F3_problem& problem = n.solve->problem;
    json_.line(2).open('{').key("pair").list(n.solve->pair);
    write_chart(problem.chart);
    const Bernstein<Scaled_integer, 2>& equation = n.solve->system().equations[0]->exact();
    if (equation.is_zero()) {
      json_.key("vanishes").value(true).close('}');
      return;
    }
    write_factors(problem, n);
    const Power_table powers = power_table(equation);
    json_.line(3).key("equation").open('{').key("degrees").list(equation.degrees()).key("coefficients");
    out_.list(powers.coefficients());
    json_.close('}');
    const Certificate_tree tree(n.solve->claims, powers, n.patch ? &n.patch->graph : nullptr);
    json_.line(3).key("cells").list(tree.tokens());
    write_singular(n, tree);
    write_vertices(n, tree);
    write_pieces(n, tree);
    if (problem.is_self && problem.chart.is_plain()) write_diagonal(n);
    json_.close('}');
  }

  void write_chart(const Corner_chart& chart)
  {
    if (chart.is_plain()) return;
    json_.key("chart").open('{').key("corner").list(chart.corner).key("exponents").open('[');
    for (const auto& e : chart.exponent) json_.list(e);
    json_.close(']').close('}');
  }

  void write_factors(const F3_problem& problem, const Numbered& n)
  {
    const Known_factors known(problem);
    constexpr const char* names[] = {"factor_t", "factor_r"};
    for (std::size_t v = 0; v < 2; ++v) {
      if (known.univariate[v].size() < 2) continue;
      json_.line(3).key(names[v]).open('{').key("coefficients");
      out_.list(known.univariate[v]);
      json_.key("degenerate").value(has_root_on_unit_interval(known.univariate[v])).close('}');
    }
    std::vector<std::pair<Diagonal, int>> lines;
    if (known.diagonal_power > 0) lines.push_back({known.diagonal, known.diagonal_power});
    if (n.solve->has_axis()) lines.push_back({problem.axis_line, 1});
    else if (axes_.count(n.solve->pair)) lines.push_back({axis_through(problem.chart.corner), 1});
    if (lines.empty()) return;
    json_.line(3).key("lines").open('[');
    for (const auto& [line, power] : lines) {
      json_.open('{');
      write_diagonal_line(line);
      json_.key("power").value(power).close('}');
    }
    json_.close(']');
  }

  static Diagonal axis_through(const std::array<int, 2>& corner) { return {corner[0] != corner[1], Rational(1)}; }

  void write_diagonal_line(const Diagonal& line)
  {
    json_.key("reversed").value(line.reversed).key("ratio");
    out_.value(line.ratio);
  }

  void write_range(const Interval& x) { out_.range(Rational(x.inf()), Rational(x.sup())); }

  void write_singular(const Numbered& n, const Certificate_tree& tree)
  {
    if (tree.singular().empty()) return;
    json_.line(3).key("singular").open('[');
    for (const std::size_t k : tree.singular()) {
      const Isolated_point& p = n.patch->graph.special[k];
      json_.line(4).open('{').key("at").open('[');
      for (std::size_t v = 0; v < 2; ++v) {
        if (p.evidence) out_.range(v == 0 ? p.evidence->lo : p.evidence->r_lo, v == 0 ? p.evidence->hi : p.evidence->r_hi);
        else if (p.face[v] >= 0) write_range(Interval(p.face[v]));
        else write_range(p.box[v]);
      }
      json_.close(']');
      if (p.evidence) write_algebraic(*p.evidence);
      else if (p.tag == tag_of(F3_cause::axis)) {
        json_.key("axis").open('{');
        write_diagonal_line(n.solve->problem.axis_line);
        json_.close('}');
      }
      json_.close('}');
    }
    json_.close(']');
  }

  void write_algebraic(const Algebraic_evidence& e)
  {
    json_.key("algebraic").open('{').key("m");
    out_.list(e.m);
    json_.key("h").open('[');
    for (const auto& f : e.h) out_.list(f);
    json_.close(']').close('}');
  }

  /// How a vertex is listed: a crossing of the graph may be an end of arcs by what the geometry says of it.
  struct Listed_kind {
    const char* name;
    bool has_cell, stops;
  };

  Listed_kind kind_of(const Numbered& n, std::size_t v, const Certificate_tree& tree) const
  {
    using Kind = Graph_vertex::Kind;
    const Graph_vertex& g = n.patch->graph.vertices[v];
    const bool has_branches = std::any_of(n.pieces.begin(), n.pieces.end(), [&](std::size_t k) {
      return n.patch->graph.pieces[k].from == v || n.patch->graph.pieces[k].to == v;
    });
    const bool on_side = is_on_unit_boundary(g), meets = meets_axis(n, v);
    const bool ends_arcs = meets || g.is_mark || n.patch->is_pole[v] || n.patch->is_final[v] || n.patch->is_corner[v];
    if (meets && !on_side) return {"mark", true, false};
    if (is_in_singular_cell(g, tree)) return {!has_branches ? "isolated" : g.kind == Kind::end ? "end" : "node", true, false};
    if (g.kind == Kind::mark) return {"mark", true, false};
    if (!has_branches) return {"isolated", false, false};
    if (on_side && ends_arcs) return {"boundary", false, true};
    if (g.kind == Kind::boundary || meets) return {"boundary", false, false};
    return {g.kind == Kind::open ? "open" : "crossing", false, n.patch->is_pole[v] != 0};
  }

  static bool is_in_singular_cell(const Graph_vertex& g, const Certificate_tree& tree)
  {
    return g.cause >= 0 && tree.has_cell_of_special(static_cast<std::size_t>(g.cause));
  }

  static bool is_on_unit_boundary(const Graph_vertex& g)
  {
    return std::any_of(g.at.begin(), g.at.end(), [](const Interval& x) { return x.inf() == x.sup() && (x.inf() == 0 || x.inf() == 1); });
  }

  void write_vertices(const Numbered& n, const Certificate_tree& tree)
  {
    json_.line(3).key("vertices").open('[');
    for (const std::size_t v : n.vertices) {
      const Listed_kind kind = kind_of(n, v, tree);
      json_.line(4).open('{').key("kind").value(kind.name).key("at").open('[');
      for (const Interval& x : n.patch->graph.vertices[v].at) write_range(x);
      json_.close(']');
      const Graph_vertex& g = n.patch->graph.vertices[v];
      if (kind.has_cell)
        json_.key("cell").value(is_in_singular_cell(g, tree) ? tree.cell_of_special(static_cast<std::size_t>(g.cause)) : tree.number_of(cell_with(n, v)));
      if (kind.stops) json_.key("stops").value(true);
      json_.close('}');
    }
    json_.close(']');
  }

  static Cell_tree::Index cell_with(const Numbered& n, std::size_t v)
  {
    for (const std::size_t k : n.pieces) {
      const Graph_piece& p = n.patch->graph.pieces[k];
      if (p.from == v || p.to == v) return p.cell;
    }
    throw std::logic_error("locus: a vertex inside a cell without a piece");
  }

  void write_pieces(const Numbered& n, const Certificate_tree& tree)
  {
    json_.line(3).key("pieces").open('[');
    std::vector<std::size_t> dropped;
    for (const std::size_t k : n.pieces) {
      const Graph_piece& p = n.patch->graph.pieces[k];
      json_.list(std::array<std::size_t, 3>{tree.number_of(p.cell), n.vertex.at(p.from), n.vertex.at(p.to)});
      if (n.patch->is_dropped(k)) dropped.push_back(n.piece.at(k));
    }
    json_.close(']');
    if (!dropped.empty()) json_.line(3).key("dropped").list(dropped);
  }

  /// The part of a vertex's first range whose places on a line lie in the second.
  static std::array<Rational, 2> range_on_line(const Graph_vertex& v, const Diagonal& line)
  {
    std::array<Rational, 2> t;
    for (const int end : {0, 1}) {
      const Rational r(end == 0 ? v.at[1].inf() : v.at[1].sup()), s = line.reversed ? Rational(1 - r) : r;
      t[static_cast<std::size_t>(line.reversed ? 1 - end : end)] = s / (line.ratio * (1 - s) + s);
    }
    return {std::max(t[0], Rational(v.at[0].inf())), std::min(t[1], Rational(v.at[0].sup()))};
  }

  void write_diagonal(const Numbered& n)
  {
    json_.line(3).key("diagonal").open('[');
    std::vector<std::pair<std::array<Rational, 2>, std::size_t>> points;
    for (const std::size_t v : n.vertices) {
      const Graph_vertex& g = n.patch->graph.vertices[v];
      if (g.cause < 0 || n.patch->graph.special[static_cast<std::size_t>(g.cause)].tag != tag_of(F3_cause::diagonal)) continue;
      points.push_back({range_on_line(g, Diagonal()), n.vertex.at(v)});
    }
    std::sort(points.begin(), points.end());
    for (const auto& [range, v] : points) {
      json_.open('{').key("at");
      out_.range(range[0], range[1]);
      json_.key("vertex").value(v).close('}');
    }
    json_.close(']');
  }

  // ---------------------------------------------------------------------------------------------------------- lines

  void write_line(const Numbered& n)
  {
    const F3_problem& problem = n.solve->problem;
    const bool at_corner = problem.chart.is_axis;
    const Diagonal line = at_corner ? axis_through(problem.chart.corner) : problem.axis_line;
    json_.line(2).open('{').key("pair").list(n.solve->pair);
    write_diagonal_line(line);
    if (at_corner) json_.key("corner").list(problem.chart.corner);
    json_.line(3).key("vertices").open('[');
    for (const std::size_t v : n.vertices) {
      const Graph_vertex& g = n.patch->graph.vertices[v];
      json_.open('{').key("at");
      if (at_corner) write_range(g.at[1]);
      else {
        const auto range = range_on_line(g, line);
        out_.range(range[0], range[1]);
      }
      if (meets_axis(n, v)) write_meeting(n, v, at_corner);
      if (n.patch->is_pole[v] || n.patch->is_final[v] || n.patch->is_corner[v]) json_.key("stops").value(true);
      json_.close('}');
    }
    json_.close(']');
    std::vector<std::size_t> dropped;
    for (std::size_t k = 0; k < n.pieces.size(); ++k)
      if (n.patch->is_dropped(n.pieces[k])) dropped.push_back(k);
    if (!dropped.empty()) json_.key("dropped").list(dropped);
    json_.close('}');
  }

  /// Which vertex of the other factor is there; on an edge of charts it is found by its place.
  void write_meeting(const Numbered& n, std::size_t v, bool at_corner)
  {
    if (at_corner) json_.key("meets").value(true);
    else json_.key("meets").list(std::array<std::size_t, 2>{n.of, patches_[n.of].vertex.at(v)});
  }

  // ----------------------------------------------------------------------------------------------------------- arcs

  struct Place {
    std::size_t patch, piece;
    bool flipped;
  };

  /// Where a piece of the patchwork is in the certificate.
  Place place_of(std::size_t patch, std::size_t piece) const
  {
    const Patch* const wanted = &evidence_->solution->work.patches[patch];
    for (std::size_t k = 0; k < patches_.size(); ++k)
      if (patches_[k].patch == wanted && patches_[k].piece.count(piece)) return {k, patches_[k].piece.at(piece), false};
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (lines_[k].patch != wanted || !lines_[k].piece.count(piece)) continue;
      const Graph_piece& p = wanted->graph.pieces[piece];
      return {patches_.size() + k, lines_[k].piece.at(piece), lines_[k].vertex.at(p.from) > lines_[k].vertex.at(p.to)};
    }
    throw std::logic_error("locus: an arc's piece without its patch");
  }

  void write_arcs()
  {
    json_.line(1).key("arcs").open('[');
    for (const Patchwork_arc& arc : evidence_->solution->work.arcs) {
      json_.line(2).open('{').key("closed").value(arc.closed).key("steps").open('[');
      for (const Patchwork_arc::Step& step : arc.steps) {
        const Place p = place_of(step.patch, step.piece);
        json_.list(std::array<std::size_t, 3>{p.patch, p.piece, static_cast<std::size_t>(step.reversed != p.flipped)});
      }
      json_.close(']').close('}');
    }
    json_.close(']');
  }

  void write_undecided()
  {
    json_.line(1).key("undecided").open('[');
    for (const Patch& patch : evidence_->solution->work.patches)
      for (const Undecided_box& u : patch.graph.undecided) json_.value(u.reason);
    for (const auto& [member, reason] : evidence_->solution->work.undecided) json_.value(reason);
    json_.close(']').line(1).key("unproved").open('[').close(']');
  }

  Exact_writer out_;
  Json_writer& json_;
  const Locus<2>& result_;
  const Json_value& job_;
  const Planar_evidence* evidence_;
  std::vector<Numbered> patches_, lines_;
  std::set<std::array<std::size_t, 2>> axes_; ///< pairs with an axis through a blown-up corner
};

} // namespace detail

/// Writes the certificate of an untrimmed planar bisector that was computed with `Bisector_options::keep_evidence`. `job` is the
/// job as it was read: its inputs are copied digit by digit, so that a checker starts from what the user wrote.
/// Throws std::invalid_argument without evidence, or where the job has other inputs.
inline void write_certificate(std::ostream& out, const Locus<2>& result, const Json_value& job)
{
  detail::Certificate_writer(out, result, job).run();
}

} // namespace locus

#endif
