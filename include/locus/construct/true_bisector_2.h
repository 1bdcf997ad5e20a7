// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_TRUE_BISECTOR_2_H
#define LOCUS_CONSTRUCT_TRUE_BISECTOR_2_H

#include <locus/construct/arc_trimming.h>
#include <locus/construct/locus_ends.h>
#include <locus/construct/point_curve_bisector.h>
#include <locus/construct/fixed_feet_arc.h>
#include <locus/construct/two_cells.h>
#include <locus/construct/untrimmed_bisector_2.h>
#include <locus/shape/folds.h>
#include <locus/shape/snapped_joints.h>

namespace locus {
namespace detail {

/// Puts a true bisector together: parts of the untrimmed one between insides, and arcs about ends and corners.
class True_bisector_maker {
public:
  True_bisector_maker(const std::vector<const Curve_2*>& given, const Bisector_options& options)
    : inputs_(prepared(given)), curves_(addresses(inputs_)), options_(options), is_self_(curves_.size() == 1),
      solved_(solved_inputs(*curves_[0], is_self_ ? nullptr : curves_[1], options)), base_(untrimmed_data(solved_)), joiner_(seams())
  {
    data_ = base_;
    data_.trimmed = true;
    data_.vertices.clear();
    data_.arcs.clear();
    data_.degenerate.clear(); // they are of the equations
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      sites_.add_input(*solved_.pieces[k]);
      const auto &own = curves_[k]->chain().pieces, &all = given[k]->chain().pieces;
      is_shorter_.push_back({own.front().lo != all.front().lo, own.back().hi != all.back().hi});
    }
  }

  Locus_data<2> make()
  {
    for (std::size_t k = 0; k < base_.arcs.size(); ++k) trim(k);
    add_vertices();
    note_common_pieces();
    join();
    if (!is_self_) data_.outline = Two_cells(data_, curves_).outline();
    return std::move(data_);
  }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// An arc whose ends are not numbered yet: for either, an end of `joiner_`, or a vertex of `data_` that is kept.
  struct Open_arc {
    std::shared_ptr<const Arc_geometry<2>> geometry;
    std::vector<std::size_t> inputs;
    std::vector<Feature> features;
    bool closed = false, is_shared = false; ///< about a point of both inputs
    std::array<std::size_t, 2> end{none, none}, vertex{none, none};
  };

  static std::vector<Curve_2> prepared(const std::vector<const Curve_2*>& given)
  {
    std::vector<Curve_2> all;
    for (const Curve_2* c : given) all.push_back(without_folds(with_snapped_joints(*c)));
    return all;
  }
  static std::vector<const Curve_2*> addresses(const std::vector<Curve_2>& curves)
  {
    std::vector<const Curve_2*> all;
    for (const Curve_2& c : curves) all.push_back(&c);
    return all;
  }

  std::vector<Parameter_seam> seams() const
  {
    std::vector<Parameter_seam> all;
    for (const Curve_2* c : curves_) {
      const Chain& chain = c->chain();
      all.push_back({chain.is_closed(), Parameter_range(chain.pieces.front()).at(Interval(0)), Parameter_range(chain.pieces.back()).at(Interval(1))});
    }
    return all;
  }

  // ------------------------------------------------------------------------------------------------ between insides

  void trim(std::size_t arc)
  {
    const Arc_steps steps(solved_.solution, arc);
    const std::array<std::size_t, 2> inputs{0, is_self_ ? 0u : 1u};
    Arc_trimmer trimmer(steps, inputs, sites_, options_.control);
    for (const Empty_part& part : trimmer.run()) add_part(arc, part);
    for (const auto& box : trimmer.undecided()) {
      Undecided_piece u;
      u.box = {box[0], box[1]};
      u.reason = "whether circles there contain other parts of the inputs was not decided in doubles";
      data_.undecided.push_back(std::move(u));
    }
    data_.statistics.cells += trimmer.cells();
  }

  void add_part(std::size_t arc, const Empty_part& part)
  {
    Open_arc open;
    open.inputs = {0, is_self_ ? 0u : 1u};
    open.features = {Feature::interior, Feature::interior};
    open.closed = part.is_all;
    double end_error = 0;
    for (std::size_t e = 0; e < 2 && !open.closed; ++e) {
      if (part.ends[e]) {
        end_error = std::max(end_error, solved_.solution->frame.length(Interval(diameter(part.ends[e]->place.point))).sup());
        std::vector<Foot> possible = possible_feet(part.ends[e]->contacts);
        const std::optional<std::size_t> changing = only_input(possible, [](const Foot&) { return true; });
        Locus_vertex<2> v = event_vertex(*part.ends[e]);
        std::vector<Foot> pair = v.feet;
        open.end[e] = joiner_.add({std::move(v), std::move(possible), std::move(pair), arcs_.size(), changing});
      } else if (part.is_open[e]) {
        open.vertex[e] = add_undecided_vertex();
      } else {
        const std::optional<std::size_t> v = e == 0 ? base_.arcs[arc].source() : base_.arcs[arc].target();
        if (v) note_end(open, e, *v);
      }
    }
    open.geometry = std::make_shared<Planar_arc>(solved_.solution, arc, part.part, end_error);
    for (std::size_t e = 0; e < 2; ++e)
      if (part.is_open[e]) {
        const Arc_point<2> last = open.geometry->at(e == 0 ? 0.0 : 1.0);
        data_.vertices[open.vertex[e]].point = last.point();
        data_.vertices[open.vertex[e]].radius = last.radius();
      }
    arcs_.push_back(std::move(open));
  }

  std::size_t add_undecided_vertex()
  {
    Locus_vertex<2> v;
    v.kind = Vertex_kind::undecided;
    data_.vertices.push_back(std::move(v));
    return data_.vertices.size() - 1;
  }

  /// An end that the untrimmed arc has, too.
  void note_end(Open_arc& open, std::size_t e, std::size_t v)
  {
    const Locus_vertex<2>& vertex = base_.vertices[v];
    if (vertex.kind == Vertex_kind::boundary || vertex.kind == Vertex_kind::corner || (vertex.kind == Vertex_kind::node && vertex.radius == 0)) {
      std::vector<Foot> pair = vertex.feet;
      for (Foot& f : pair) f.feature = Feature::interior;
      open.end[e] = joiner_.add({vertex, {}, std::move(pair), arcs_.size(), only_input(vertex.feet, [](const Foot& f) { return f.feature != Feature::interior; })});
      return;
    }
    kept_.resize(base_.vertices.size(), none);
    if (kept_[v] == none) {
      kept_[v] = data_.vertices.size();
      data_.vertices.push_back(vertex);
      data_.vertices.back().half_branches.clear();
    }
    open.vertex[e] = kept_[v];
  }

  /// The input of some feet, if it is one; of two inputs.
  template <class Is_counted>
  std::optional<std::size_t> only_input(const std::vector<Foot>& feet, Is_counted is_counted) const
  {
    std::optional<std::size_t> only;
    if (is_self_) return only;
    for (const Foot& f : feet) {
      if (!is_counted(f)) continue;
      if (only && *only != f.input) return std::nullopt;
      only = f.input;
    }
    return only;
  }

  Locus_vertex<2> event_vertex(const Arc_event& event) const
  {
    Locus_vertex<2> v;
    v.kind = Vertex_kind::trim;
    const Arc_point<2> p = finished(*solved_.solution, event.place);
    v.point = p.point();
    v.radius = p.radius();
    v.error = p.error();
    for (std::size_t k = 0; k < 2; ++k) v.feet.push_back({is_self_ ? 0 : k, Feature::interior, {event.parameters[k]}});
    return v;
  }

  /// Of an event what may be touched there besides the feet of the arc: the arcs that go on from there tell what is.
  std::vector<Foot> possible_feet(const Contact_list& contacts) const
  {
    std::vector<Foot> feet;
    for (const Contact_foot& contact : open_parts(contacts)) feet.push_back({sites_[contact.site].input, Feature::interior, {sites_[contact.site].range.at(contact.at)}});
    for (const std::size_t i : contacts.vertices)
      for (const auto& at : sites_.vertices()[i].places) feet.push_back({sites_[at.site].input, at.feature, {sites_[at.site].range.at(Interval(at.end))}});
    return feet;
  }

  /// Open leaves side by side hold one contact.
  std::vector<Contact_foot> open_parts(const Contact_list& list) const
  {
    std::vector<Contact_foot> parts;
    for (const Contact_leaf& leaf : list.leaves) {
      const auto& node = sites_[leaf.site].tree.node(leaf.node);
      if (leaf.state == Contact_leaf::State::open) parts.push_back({leaf.site, Interval(node.lo, node.hi)});
    }
    std::sort(parts.begin(), parts.end(), [](const Contact_foot& a, const Contact_foot& b) { return a.site != b.site ? a.site < b.site : a.at.inf() < b.at.inf(); });
    std::vector<Contact_foot> joined;
    for (const Contact_foot& part : parts) {
      if (!joined.empty() && joined.back().site == part.site && part.at.inf() <= joined.back().at.sup()) joined.back().at = hull(joined.back().at, part.at);
      else joined.push_back(part);
    }
    return joined;
  }

  // ---------------------------------------------------------------------------------------------- ends and corners

  /// An end or a corner of an input.
  struct Named_point {
    Exact_point<2> point;
    Foot foot;
  };

  /// Each place once, also where the curve passes it again.
  std::vector<Named_point> vertices_of(std::size_t input) const
  {
    const Curve_2& curve = *curves_[input];
    const Chain& chain = curve.chain();
    std::vector<Named_point> all;
    for (std::size_t i = 0; i < curve.pieces().size(); ++i)
      for (const int end : {0, 1}) {
        const Joint* joint = chain.joint_at(i, end);
        if (joint && (joint->goes_on() || end == 0 || joint->kind == Joint_kind::pole)) continue;
        const Curve_piece<2>& piece = curve.pieces()[i];
        const auto value = [end](const Bernstein<Rational, 1>& f) { return f[end == 0 ? 0 : f.size() - 1]; };
        if (value(piece.weight) == 0) continue;
        Exact_point<2> p;
        for (std::size_t k = 0; k < 2; ++k) p[k] = value(piece.numerator[k]) / value(piece.weight);
        if (find_at(all, p) != nullptr) continue;
        const Feature feature = joint ? Feature::corner : end == 0 ? Feature::start : Feature::end;
        all.push_back({p, {input, feature, {Parameter_range(chain.pieces[i]).at(Interval(end))}}});
      }
    return all;
  }

  static const Named_point* find_at(const std::vector<Named_point>& all, const Exact_point<2>& p)
  {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Named_point& v) { return v.point == p; });
    return at == all.end() ? nullptr : &*at;
  }

  void add_vertices()
  {
    std::vector<std::vector<Named_point>> of_input;
    for (std::size_t input = 0; input < curves_.size(); ++input) of_input.push_back(vertices_of(input));
    for (std::size_t input = 0; input < curves_.size(); ++input)
      for (const Named_point& v : of_input[input]) {
        const Named_point* other = is_self_ ? nullptr : find_at(of_input[1 - input], v.point);
        if (!other) add_cell(v.point, v.foot);
        else if (input == 0) add_shared_cell(v.point, v.foot, other->foot);
      }
  }

  /// A point that is an end or a corner of both inputs: all points to which it is the nearest one of both are equidistant. They are a
  /// region, but where two pieces go on straight into each other: then they are on their normal line, which has been found twice.
  void add_shared_cell(const Exact_point<2>& p, const Foot& first, const Foot& second)
  {
    const Seen_curve seen(curves_, p);
    const Point_cell cell(seen.features(), options_.control);
    Point_bisector_maker maker(seen, cell, first, {0, 1}, point_options());
    const Locus_data<2> found = maker.make();
    note_work(cell);
    for (const Undecided_piece& u : found.undecided) data_.undecided.push_back(u);
    const bool is_flat = goes_straight_on(first, second);
    Region region;
    for (const Arc<2>& arc : found.arcs) {
      if (is_flat && arc.inputs()[0] == arc.inputs()[1]) continue;
      region.arcs.push_back(arcs_.size());
      add_found_arc(found, arc, std::nullopt);
      Open_arc& open = arcs_.back();
      open.geometry = std::make_shared<Fixed_feet_arc>(arc.geometry(), std::vector<Range>{first.parameters[0], second.parameters[0]});
      open.inputs = {0, 1};
      open.features = {first.feature, second.feature};
      for (const std::size_t v : open.vertex)
        if (v != none) data_.vertices[v].feet = {first, second};
    }
    if (is_flat || found.regions.empty()) return;
    region.reason = "the inputs share an end or a corner: all points to which it is the nearest one of both are equidistant";
    data_.regions.push_back(std::move(region));
  }

  /// Whether two pieces that begin or end at a point of both inputs have opposite directions there.
  bool goes_straight_on(const Foot& first, const Foot& second) const
  {
    std::vector<Vector_2<Rational>> directions;
    for (const Contact_vertex& v : sites_.vertices())
      for (const auto& at : v.places) {
        const Contact_site& site = sites_[at.site];
        const Range here = site.range.at(Interval(at.end)), wanted = (site.input == 0 ? first : second).parameters[0];
        if (here.lo != wanted.lo || here.hi != wanted.hi) continue;
        const Piece_end end(*solved_.pieces[site.input]->curves[site.piece], at.end);
        const Rational sign = at.end == 0 ? 1 : -1;
        directions.push_back({sign * end.tangent[0], sign * end.tangent[1]});
      }
    for (const auto& a : directions)
      for (const auto& b : directions)
        if (a.x * b.y == a.y * b.x && a.x * b.x + a.y * b.y < 0) return true;
    return false;
  }

  Point_bisector_options point_options() const
  {
    Point_bisector_options options;
    options.control = options_.control;
    options.least_cut_radius = data_.cut_radius;
    return options;
  }

  void note_work(const Point_cell& cell)
  {
    data_.statistics.cells += cell.cells();
    data_.statistics.exact_cells += cell.algebraic_cells();
    data_.statistics.filter += cell.filter();
  }

  /// Arcs of the cell of an end or a corner among all inputs.
  void add_cell(const Exact_point<2>& p, const Foot& own)
  {
    const Seen_curve seen(curves_, p);
    const Point_cell cell(seen.features(is_self_ ? std::nullopt : std::optional(1 - own.input)), options_.control);
    std::vector<std::size_t> inputs;
    for (std::size_t k = 0; k < curves_.size(); ++k) inputs.push_back(k);
    Point_bisector_maker maker(seen, cell, own, inputs, point_options());
    Locus_data<2> found = maker.make_arcs_alone();
    note_work(cell);
    for (Undecided_piece& u : found.undecided) {
      u.box.push_back(own.parameters[0]);
      data_.undecided.push_back(std::move(u));
    }
    for (const Arc<2>& arc : found.arcs)
      if (is_wanted(arc, own)) add_found_arc(found, arc, own);
  }

  bool is_wanted(const Arc<2>& arc, const Foot& own) const
  {
    const std::size_t own_index = is_own(arc, own) ? 0 : 1;
    if (!is_self_ && arc.inputs()[0] == arc.inputs()[1]) return false;
    const Arc_point<2> inside = arc.at(0.5);
    const Range &own_parameter = inside.parameters()[own_index], &other = inside.parameters()[1 - own_index];
    const bool is_vertex_pair = arc.features()[0] != Feature::interior && arc.features()[1] != Feature::interior;
    if (is_self_ && joiner_.may_be_one_place(0, own_parameter, other)) return false; // its own normals
    return !(is_vertex_pair && own_index == 1);                                      // the other vertex lists it
  }

  /// An arc of a vertex's cell, of one among the inputs' other places or, without `own`, of a point of both.
  void add_found_arc(const Locus_data<2>& found, const Arc<2>& arc, const std::optional<Foot>& own)
  {
    Open_arc open;
    open.inputs = arc.inputs();
    open.features = arc.features();
    open.geometry = arc.geometry();
    open.closed = arc.is_closed();
    open.is_shared = !own;
    for (std::size_t e = 0; e < 2 && !open.closed; ++e) {
      const Locus_vertex<2>& v = found.vertices[e == 0 ? *arc.source() : *arc.target()];
      if (v.kind == Vertex_kind::infinity || v.kind == Vertex_kind::undecided) {
        open.vertex[e] = data_.vertices.size();
        data_.vertices.push_back(v);
      } else {
        open.end[e] = joiner_.add({v, {}, pair_at(arc, e, v), arcs_.size(), own ? changing_input(v, *own) : std::nullopt});
        if (is_self_ && ends_in_own_foot(v)) diagonal_.push_back(open.end[e]);
      }
    }
    arcs_.push_back(std::move(open));
  }

  /// The feet at an end of an arc. Where it is evaluated is only near its end: what is known of the vertex encloses that.
  std::vector<Foot> pair_at(const Arc<2>& arc, std::size_t e, const Locus_vertex<2>& v) const
  {
    const Arc_point<2> last = arc.at(e == 0 ? 0.0 : 1.0);
    std::vector<Foot> pair;
    for (std::size_t k = 0; k < 2; ++k) {
      Foot foot{arc.inputs()[k], arc.features()[k], {last.parameters()[k]}};
      Range& range = foot.parameters[0];
      const Foot* nearest = nullptr;
      for (const Foot& f : v.feet)
        if (f.input == foot.input && (!nearest || std::abs(f.parameters[0].lo - range.lo) < std::abs(nearest->parameters[0].lo - range.lo))) nearest = &f;
      if (nearest && foot.feature == Feature::interior) range = {std::min(range.lo, nearest->parameters[0].lo), std::max(range.hi, nearest->parameters[0].hi)};
      pair.push_back(std::move(foot));
    }
    return pair;
  }

  /// At an end of an arc about a vertex: the vertex's input where another place of that, or the curve beside the vertex, is touched;
  /// else the other one.
  std::optional<std::size_t> changing_input(const Locus_vertex<2>& v, const Foot& own) const
  {
    if (is_self_) return std::nullopt;
    std::array<std::size_t, 2> count{};
    for (const Foot& f : v.feet) ++count[f.input];
    if (count[own.input] > 1) return count[1 - own.input] > 1 ? std::nullopt : std::optional(own.input);
    return 1 - own.input;
  }

  /// Whether both feet of an arc about a corner run into the corner: at the centre of curvature of a piece that begins there.
  bool ends_in_own_foot(const Locus_vertex<2>& v) const
  {
    const auto is_exact = [](const Foot& f) { return f.parameters[0].lo == f.parameters[0].hi; };
    return v.radius > 0 && std::all_of(v.feet.begin(), v.feet.end(), is_exact) && joiner_.distinct(v.feet).size() == 1;
  }

  /// Whether the first foot of an arc of a vertex's cell is the vertex.
  static bool is_own(const Arc<2>& arc, const Foot& own)
  {
    if (arc.inputs()[0] != arc.inputs()[1]) return arc.inputs()[0] == own.input;
    const Range p = arc.at(0.5).parameters()[0];
    return arc.features()[0] == own.feature && p.lo == own.parameters[0].lo && p.hi == own.parameters[0].hi;
  }

  /// Where the inputs have a piece in common all points to which that is nearest are equidistant.
  void note_common_pieces()
  {
    if (is_self_) return;
    for (const auto& d : base_.degenerate) {
      if (d.kind != "overlap" && (d.kind != "everything" || !share_straight_part())) continue;
      Undecided_piece u;
      u.box = d.box;
      u.reason = "the inputs have a piece in common: the points to which it is nearest are a region that is not found yet";
      data_.undecided.push_back(std::move(u));
      return;
    }
  }

  /// Whether straight pieces of both inputs have more than a point in common; true also where there are none, but arcs of one circle.
  bool share_straight_part() const
  {
    bool is_circle = true;
    for (const auto& a : curves_[0]->pieces())
      for (const auto& b : curves_[1]->pieces()) {
        const auto x = ends_of_straight(a), y = ends_of_straight(b);
        if (!x || !y) continue;
        is_circle = false;
        std::vector<Exact_point<2>> common;
        const auto note = [&](const Exact_point<2>& p, const auto& ends) {
          if (holds<2>(ends, p) && std::find(common.begin(), common.end(), p) == common.end()) common.push_back(p);
        };
        for (const auto& p : *x) note(p, *y);
        for (const auto& p : *y) note(p, *x);
        if (common.size() > 1) return true;
      }
    return is_circle;
  }

  // ------------------------------------------------------------------------------------------------------- joining

  void join()
  {
    const std::vector<std::size_t> number = joiner_.join(data_.vertices, !is_self_);
    for (Locus_vertex<2>& v : data_.vertices)
      for (Foot& f : v.feet) f.feature = feature_of_given(f.input, f.feature);
    for (Open_arc& open : arcs_) {
      for (std::size_t i = 0; i < open.features.size(); ++i) open.features[i] = feature_of_given(open.inputs[i], open.features[i]);
      std::array<std::optional<std::size_t>, 2> ends;
      for (std::size_t e = 0; e < 2; ++e) {
        if (open.end[e] != none) {
          ends[e] = number[open.end[e]];
          Locus_vertex<2>& v = data_.vertices[*ends[e]];
          if (joiner_.degree(open.end[e]) > 1) v.kind = v.kind == Vertex_kind::node ? v.kind : Vertex_kind::trim;
          else if (std::find(diagonal_.begin(), diagonal_.end(), open.end[e]) != diagonal_.end()) v.kind = Vertex_kind::diagonal;
          else if (!open.is_shared && (!is_self_ || !ends_in_corner(v))) note_loose(v);
        } else if (open.vertex[e] != none) {
          ends[e] = open.vertex[e];
        }
      }
      for (std::size_t e = 0; e < 2; ++e)
        if (ends[e] && data_.vertices[*ends[e]].kind == Vertex_kind::infinity) direct_outwards(data_.vertices[*ends[e]], *open.geometry, e);
      data_.arcs.emplace_back(open.geometry, ends[0], ends[1], open.inputs, open.features);
    }
  }

  /// Where a piece that runs back has been left out, the curve turns back.
  Feature feature_of_given(std::size_t input, Feature f) const
  {
    const bool is_turn = (f == Feature::start && is_shorter_[input][0]) || (f == Feature::end && is_shorter_[input][1]);
    return is_turn ? Feature::corner : f;
  }

  /// A self-bisector's arc that begins at a corner of the curve.
  static bool ends_in_corner(const Locus_vertex<2>& v)
  {
    return v.kind == Vertex_kind::corner && v.feet.size() == 1;
  }

  /// The direction at an infinite end is the arc's there.
  void direct_outwards(Locus_vertex<2>& v, const Arc_geometry<2>& arc, std::size_t end) const
  {
    if (!v.direction) return;
    const Arc_point<2> last = arc.at(end == 0 ? 0.0 : 1.0);
    double along = 0;
    for (std::size_t k = 0; k < 2; ++k) along += (last.point()[k] - data_.centre[k]) * (*v.direction)[k];
    if (!(along < 0)) return;
    for (std::size_t k = 0; k < 2; ++k) {
      (*v.direction)[k] = -(*v.direction)[k];
      if (v.asymptote) v.asymptote->direction[k] = -v.asymptote->direction[k];
    }
  }

  /// An end that nothing continues.
  void note_loose(Locus_vertex<2>& v)
  {
    v.kind = Vertex_kind::undecided;
    Undecided_piece u;
    for (const Foot& f : v.feet)
      if (!f.parameters.empty()) u.box.push_back(f.parameters[0]);
    u.reason = "an arc ends here, and what continues it was not found";
    data_.undecided.push_back(std::move(u));
  }

  std::vector<Curve_2> inputs_;
  std::vector<const Curve_2*> curves_;
  const Bisector_options& options_;
  bool is_self_;
  Solved_inputs solved_;
  Locus_data<2> base_, data_;
  Contact_sites sites_;
  End_joiner joiner_;
  std::vector<std::array<bool, 2>> is_shorter_;
  std::vector<std::size_t> kept_, diagonal_;
  std::vector<Open_arc> arcs_;
};

inline Locus<2> true_bisector(const std::vector<const Curve_2*>& curves, const Bisector_options& options)
{
  return with_upward_rounding([&] {
    const auto start = std::chrono::steady_clock::now();
    Locus_data<2> data = True_bisector_maker(curves, options).make();
    data.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return Locus<2>(std::move(data));
  });
}

} // namespace detail

/// The true bisector of two curves in the plane, certified: the points whose least distances to the two whole curves, their ends and
/// corners included, are equal.
inline Locus<2> bisector(const Curve_2& first, const Curve_2& second, const Bisector_options& options = {})
{
  return detail::true_bisector({&first, &second}, options);
}

/// The true bisector of a curve with itself: the closure of the points with two or more nearest points on it.
inline Locus<2> bisector(const Curve_2& curve, const Bisector_options& options = {}) { return detail::true_bisector({&curve}, options); }

} // namespace locus

#endif
