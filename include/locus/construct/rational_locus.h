// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_RATIONAL_LOCUS_H
#define LOCUS_CONSTRUCT_RATIONAL_LOCUS_H

#include <locus/construct/path_ends.h>
#include <locus/shape/cusps.h>


namespace locus {
namespace detail {

/// Of which inputs a derived curve is, and what else lies in the picture: feet are on input `curve_input`.
struct Locus_labels {
  std::size_t curve_input = 0;
  std::optional<std::size_t> point_input; ///< a point that is a foot everywhere
  std::vector<std::size_t> inputs{0};
  std::vector<Feature> features{Feature::interior};
};

/// Makes a locus of a rational curve that was derived from a curve piece by piece: arcs between its poles, joined where the
/// curve's normal turns continuously and the images meet.
template <int Dim>
class Rational_locus_maker {
public:
  static constexpr auto size = static_cast<std::size_t>(Dim);

  /// `points`: more of what the picture is to hold.
  Rational_locus_maker(const Rational_curve<Dim>& curve, const Rational_map<Dim, 1>& map, Locus_labels labels = {},
                       std::vector<Exact_point<Dim>> points = {})
    : labels_(std::move(labels)), chain_(curve.chain()), work_(std::make_shared<Path_work<Dim>>())
  {
    collect_control_points(curve, points);
    work_->frame = fitting_frame<Dim>(points);
    require_drawable(work_->frame);
    const Extent<Dim> extent = extent_in<Dim>(work_->frame, points);
    work_->scale = extent.scale;
    work_->cut_radius = cut_factor * extent.scale;
    work_->centre = extent.centre;
    match_pieces(curve, map);
  }

  Locus_data<Dim> make()
  {
    for (std::size_t i = 0; i < work_->pieces.size(); ++i) cut_at_poles(i);
    join_pieces();
    make_ends();
    make_arcs();
    if (labels_.point_input) {
      add_point_feet();
      note_missing_pieces();
    }
    data_.scale = work_->frame.length(Interval(work_->scale)).sup();
    data_.cut_radius = work_->frame.length(Interval(work_->cut_radius)).sup();
    for (std::size_t k = 0; k < size; ++k) data_.centre[k] = midpoint(work_->frame.out_of(Interval(work_->centre[k]), k));
    return std::move(data_);
  }

private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// A stretch between poles or ends of a piece, with the vertex or the stretch that follows at both ends.
  struct Stretch {
    Path_leg leg;
    std::array<std::size_t, 2> vertex{none, none}, neighbour{none, none};
  };

  void match_pieces(const Rational_curve<Dim>& curve, const Rational_map<Dim, 1>& map)
  {
    std::size_t i = 0;
    for (const auto& piece : map.pieces()) {
      for (; !same_range(chain_.pieces[i], piece.range[0]); ++i) missing_.push_back(i);
      Curve_piece<Dim> image{piece.numerator, piece.weight};
      // As a curve's, a constant weight would be of degree zero.
      image = with_unit_forms(in_frame(homogenised(std::move(image)), work_->frame));
      add_piece(i, image, with_unit_forms(in_frame(curve.pieces()[i], work_->frame)));
      source_.push_back(i);
      ++i;
    }
    for (; i < chain_.pieces.size(); ++i) missing_.push_back(i);
  }

  static bool same_range(const Piece& a, const Piece& b) // of one chain
  {
    return a.lo_infinite == b.lo_infinite && a.hi_infinite == b.hi_infinite && (a.lo_infinite || a.lo == b.lo) && (a.hi_infinite || a.hi == b.hi);
  }

  void add_piece(std::size_t source, const Curve_piece<Dim>& image, const Curve_piece<Dim>& foot)
  {
    typename Path_work<Dim>::Piece_work w;
    w.forms = image;
    w.foot_forms = foot;
    w.image.emplace(image.numerator, image.weight);
    w.foot.emplace(foot.numerator, foot.weight);
    w.range = Parameter_range(chain_.pieces[source]);
    w.weight = enclosing(image.weight);
    for (std::size_t k = 0; k < size; ++k)
      w.numerator[k] = enclosing(subtract(image.numerator[k], multiply(image.weight, Rational(work_->centre[k]))));
    work_->pieces.push_back(std::move(w));
  }

  bool is_pole(std::size_t i, int end) const
  {
    const Bernstein<Rational, 1>& w = work_->pieces[i].forms.get().weight;
    return w[end == 0 ? 0 : w.size() - 1] == 0;
  }

  // ------------------------------------------------------------------------------------------------------------ poles

  struct Pole {
    Isolated_root<Rational> root;
    bool at_end(int end) const { return root.is_exact() && root.lo == end; }
  };

  void cut_at_poles(std::size_t i)
  {
    first_stretch_.push_back(stretches_.size());
    if (is_single_point(work_->pieces[i].forms.get())) {
      note_single_point(i);
      last_stretch_.push_back(none);
      return;
    }
    std::vector<Pole> poles;
    const Bernstein<Rational, 1>& weight = work_->pieces[i].forms.get().weight;
    if (!all_of_one_sign(weight))
      for (auto& root : exact_roots(Bernstein<Scaled_integer, 1>(weight), Rational(0), Rational(1)).roots) {
        refine(root);
        poles.push_back({std::move(root)});
      }
    const Bernstein<Rational, 1> outside = poles.empty() ? Bernstein<Rational, 1>() : Path_ends<Dim>(*work_).outside_form(work_->pieces[i].forms.get());
    Rational from = 0;
    std::size_t before = none; // the vertex at the last pole
    const Pole* last = nullptr;
    const auto close = [&](const Rational& to, const Pole* next, std::size_t after) {
      Stretch s;
      s.leg.piece = i;
      const double middle = nearest_double(Rational((from + to) / 2));
      // Ends towards poles are moved inwards to where the curve leaves the cut radius for good.
      const std::optional<double> lo = last ? Path_ends<Dim>::stop_towards(outside, last->root, to, from) : 0.0;
      const std::optional<double> hi = next ? Path_ends<Dim>::stop_towards(outside, next->root, from, to) : 1.0;
      if (!lo || !hi) note_open_stretch(i, from, to);
      s.leg.lo = lo.value_or(middle);
      s.leg.hi = hi.value_or(middle);
      if (s.leg.hi < s.leg.lo) s.leg.lo = s.leg.hi = middle;
      s.vertex = {before, after};
      stretches_.push_back(s);
    };
    for (const Pole& pole : poles) {
      const std::size_t vertex = pole_vertex(i, pole);
      if (!pole.at_end(0)) close(pole.root.lo, &pole, vertex);
      from = pole.root.hi;
      before = vertex;
      last = &pole;
    }
    if (!last || !last->at_end(1)) close(Rational(1), nullptr, none);
    last_stretch_.push_back(stretches_.size() - 1);
  }

  /// Also away from the ends, which it does not lie on.
  static void refine(Isolated_root<Rational>& root)
  {
    refine_root(root, 120);
    while (!root.is_exact() && (root.lo == 0 || root.hi == 1))
      if (!bisect_exactly(*root.factor, Rational(0), Rational(1), root)) return;
  }

  void note_open_stretch(std::size_t i, const Rational& from, const Rational& to)
  {
    Undecided_piece u;
    u.box = {work_->pieces[i].range.at(hull(enclosing(from), enclosing(to)))};
    u.reason = "the arc could not be followed to infinity in doubles";
    data_.undecided.push_back(std::move(u));
  }

  std::size_t pole_vertex(std::size_t i, const Pole& pole)
  {
    Locus_vertex<Dim> v = Path_ends<Dim>(*work_).infinite_vertex(work_->pieces[i].forms.get(), pole.root);
    v.feet.push_back(foot_at(i, fine_place(pole.root).enclosure()));
    data_.vertices.push_back(std::move(v));
    return data_.vertices.size() - 1;
  }

  /// In the order of the inputs.
  void add_point_feet()
  {
    for (Locus_vertex<Dim>& v : data_.vertices) {
      Foot foot;
      foot.input = *labels_.point_input;
      foot.feature = Feature::point;
      v.feet.insert(foot.input < labels_.curve_input ? v.feet.begin() : v.feet.end(), std::move(foot));
    }
  }

  Foot foot_at(std::size_t i, const Interval& s) const
  {
    Foot foot;
    foot.input = labels_.curve_input;
    foot.parameters = {work_->pieces[i].range.at(s)};
    for (int end = 0; end < 2; ++end) {
      if (s.inf() != end || s.sup() != end) continue;
      const Joint* joint = chain_.joint_at(source_[i], end);
      if (!joint) foot.feature = end == 0 ? Feature::start : Feature::end;
      else if (joint->kind == Joint_kind::corner) foot.feature = Feature::corner;
    }
    return foot;
  }

  /// Pieces that are all mapped to infinity.
  void note_missing_pieces()
  {
    for (const std::size_t i : missing_) {
      Degenerate_piece d;
      d.kind = "infinity";
      d.input = labels_.curve_input;
      d.box = {Parameter_range(chain_.pieces[i]).at(Interval(0, 1))};
      d.reason = "all points of the piece map to infinity";
      data_.degenerate.push_back(std::move(d));
    }
  }

  void note_single_point(std::size_t i)
  {
    // The pieces of one circle have one vertex, with a foot for each.
    const bool again = i > 0 && last_stretch_[i - 1] == none && images_meet(i - 1, i);
    if (!again) {
      Locus_vertex<Dim> v;
      v.kind = Vertex_kind::isolated;
      Path_ends<Dim>(*work_).place_exactly(i, Rational(1, 2), v);
      data_.vertices.push_back(std::move(v));
    }
    data_.vertices.back().feet.push_back(foot_at(i, Interval(0, 1)));
    Degenerate_piece d;
    d.kind = "centre";
    d.input = labels_.curve_input;
    d.box = {work_->pieces[i].range.at(Interval(0, 1))};
    d.reason = "all points of the piece map to one";
    data_.degenerate.push_back(d);
  }

  // ----------------------------------------------------------------------------------------------------------- joints

  /// Where one piece's arc goes on in the next one, through a point or through infinity.
  void join_pieces()
  {
    for (std::size_t i = 0; i < source_.size(); ++i) {
      if (!chain_.goes_on_at(source_[i], 1)) continue;
      const std::size_t j = piece_of(chain_.neighbour(source_[i], 1));
      if (j == none || last_stretch_[i] == none || last_stretch_[j] == none) continue;
      if (is_pole(i, 1) != is_pole(j, 0) || !images_meet(i, j)) continue;
      if (is_pole(i, 1)) share_pole(i, j);
      else join(last_stretch_[i], first_stretch_[j]);
    }
  }

  std::size_t piece_of(std::size_t source) const
  {
    const auto found = std::find(source_.begin(), source_.end(), source);
    return found == source_.end() ? none : static_cast<std::size_t>(found - source_.begin());
  }

  /// The same homogeneous coordinates, up to a factor.
  bool images_meet(std::size_t i, std::size_t j) const
  {
    std::vector<Rational> a, b;
    const auto take = [](const Curve_piece<Dim>& p, bool last, std::vector<Rational>& out) {
      for (const auto& f : p.numerator) out.push_back(f[last ? f.size() - 1 : 0]);
      out.push_back(p.weight[last ? p.weight.size() - 1 : 0]);
    };
    take(work_->pieces[i].forms.get(), true, a);
    take(work_->pieces[j].forms.get(), false, b);
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t l = 0; l < k; ++l)
        if (a[k] * b[l] != a[l] * b[k]) return false;
    return true;
  }

  void join(std::size_t s, std::size_t t)
  {
    stretches_[s].neighbour[1] = t;
    stretches_[t].neighbour[0] = s;
  }

  /// Both pieces made a vertex of the pole: the second one gives way.
  void share_pole(std::size_t i, std::size_t j)
  {
    const std::size_t kept = stretches_[last_stretch_[i]].vertex[1];
    stretches_[first_stretch_[j]].vertex[0] = kept;
  }

  /// Vertices where a piece's arc ends at a finite point.
  void make_ends()
  {
    for (Stretch& s : stretches_)
      for (int end = 0; end < 2; ++end) {
        const auto e = static_cast<std::size_t>(end);
        if (s.vertex[e] != none || s.neighbour[e] != none) continue;
        Locus_vertex<Dim> v;
        v.kind = chain_.joint_at(source_[s.leg.piece], end) ? Vertex_kind::corner : Vertex_kind::boundary;
        v.feet.push_back(foot_at(s.leg.piece, Interval(end)));
        Path_ends<Dim>(*work_).place_exactly(s.leg.piece, Rational(end), v);
        s.vertex[e] = data_.vertices.size();
        data_.vertices.push_back(std::move(v));
      }
    drop_unused_vertices();
  }

  void drop_unused_vertices()
  {
    std::vector<char> used(data_.vertices.size(), 0);
    for (const Stretch& s : stretches_)
      for (const std::size_t v : s.vertex)
        if (v != none) used[v] = 1;
    std::vector<std::size_t> number(used.size(), none);
    std::vector<Locus_vertex<Dim>> kept;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v] && data_.vertices[v].kind != Vertex_kind::isolated) continue;
      number[v] = kept.size();
      kept.push_back(std::move(data_.vertices[v]));
    }
    data_.vertices = std::move(kept);
    for (Stretch& s : stretches_)
      for (std::size_t& v : s.vertex)
        if (v != none) v = number[v];
  }

  // ------------------------------------------------------------------------------------------------------------- arcs

  void make_arcs()
  {
    std::vector<char> done(stretches_.size(), 0);
    for (const bool closed : {false, true})
      for (std::size_t first = 0; first < stretches_.size(); ++first) {
        if (done[first] || (!closed && stretches_[first].neighbour[0] != none)) continue;
        std::vector<std::size_t> chain;
        for (std::size_t s = first; s != none && !done[s]; s = stretches_[s].neighbour[1]) {
          done[s] = 1;
          chain.push_back(s);
        }
        make_arc(chain, closed);
      }
  }

  void make_arc(const std::vector<std::size_t>& chain, bool closed)
  {
    std::vector<Path_leg> legs;
    Irregular_points<Dim> irregular;
    for (std::size_t n = 0; n < chain.size(); ++n) {
      const Stretch& s = stretches_[chain[n]];
      legs.push_back(s.leg);
      collect_cusps(s, irregular);
      if (s.neighbour[1] != none && reverses_between(s.leg.piece, stretches_[s.neighbour[1]].leg.piece))
        irregular.points.push_back(work_->at(s.leg.piece, Interval(1)));
    }
    std::optional<std::size_t> source, target;
    if (!closed) {
      source = stretches_[chain.front()].vertex[0];
      target = stretches_[chain.back()].vertex[1];
    }
    data_.arcs.emplace_back(std::make_shared<const Rational_path<Dim>>(work_, std::move(legs), std::move(irregular)), source, target,
                            labels_.inputs, labels_.features);
  }

  /// Where the derived curve stands still inside a stretch.
  void collect_cusps(const Stretch& s, Irregular_points<Dim>& irregular)
  {
    const Integer_polynomial factor = standstill_factor(work_->pieces[s.leg.piece].forms.get());
    if (degree(factor) < 1) return;
    for (auto& root : exact_roots(bernstein_form(factor), Rational(0), Rational(1)).roots) {
      refine(root);
      if (root.lo <= Rational(s.leg.lo) || root.hi >= Rational(s.leg.hi)) continue;
      irregular.points.push_back(work_->at(s.leg.piece, hull(enclosing(root.lo), enclosing(root.hi))));
    }
  }

  bool reverses_between(std::size_t i, std::size_t j) const
  {
    const auto &a = work_->pieces[i].forms.get(), &b = work_->pieces[j].forms.get();
    return joint_between(a, chain_.pieces[source_[i]], b, chain_.pieces[source_[j]]).kind == Joint_kind::corner;
  }

  const Locus_labels labels_;
  const Chain chain_;
  std::shared_ptr<Path_work<Dim>> work_;
  std::vector<std::size_t> source_, missing_, first_stretch_, last_stretch_; ///< pieces of the chain; those without an image
  std::vector<Stretch> stretches_;
  Locus_data<Dim> data_;
};

} // namespace detail
} // namespace locus

#endif
