// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CONTACT_SITES_H
#define LOCUS_CONSTRUCT_CONTACT_SITES_H

#include <locus/construct/contact_tree.h>
#include <locus/construct/planar_pieces.h>

#include <map>

namespace locus {
namespace detail {

/// A piece of an input as something that circles touch.
struct Contact_site {
  std::size_t input = 0, piece = 0;
  Contact_tree tree;
  Bisector_map_2::Evaluator evaluator;
  Parameter_range range;
  std::array<std::size_t, 2> vertex;      ///< at its ends: an end or a corner of the input, none where it goes on smoothly or is infinite
  std::array<std::size_t, 2> smooth_next; ///< the site that goes on smoothly behind an end, if one does
  bool is_line = false;
  std::array<Rational, 3> line{}; ///< of a straight piece: a, b, c with ax + by + c = 0
  bool is_polynomial = true; ///< of constant weight
};

/// A point that is an end or a corner of an input, of several if they meet there.
struct Contact_vertex {
  struct Place {
    std::size_t site = 0; ///< one with the point at its end
    int end = 0;
    Feature feature = Feature::end;
  };
  std::vector<Place> places;
};

/// All that circles may touch, of any number of inputs: the insides of pieces, ends and corners. Not for sharing between threads.
class Contact_sites {
public:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// Upward rounding needed.
  void add_input(const Planar_pieces& pieces)
  {
    const std::size_t first = sites_.size(), n = pieces.size();
    first_.push_back(first);
    for (std::size_t i = 0; i < n; ++i) {
      const Planar_curve& c = *pieces.curves[i];
      sites_.push_back({first_.size() - 1, i, Contact_tree(pieces.curves[i]), pieces.evaluator(i), pieces.ranges[i], {none, none}, {none, none}, c.is_line(), line_of(c), c.weight().degree() == 0});
    }
    for (std::size_t i = 0; i < n; ++i)
      for (int end = 0; end < 2; ++end) {
        if (pieces.curves[i]->is_infinite_at(end)) continue;
        const Joint* joint = pieces.chain.joint_at(i, end);
        const auto e = static_cast<std::size_t>(end);
        if (joint && joint->goes_on()) sites_[first + i].smooth_next[e] = first + pieces.chain.neighbour(i, end);
        else sites_[first + i].vertex[e] = add_vertex(*pieces.curves[i], {first + i, end, joint ? Feature::corner : end == 0 ? Feature::start : Feature::end});
      }
  }

  std::size_t size() const { return sites_.size(); }
  const Contact_site& operator[](std::size_t i) const { return sites_[i]; }
  Contact_site& operator[](std::size_t i) { return sites_[i]; }
  std::size_t site(std::size_t input, std::size_t piece) const { return first_[input] + piece; }
  const std::vector<Contact_vertex>& vertices() const { return vertices_; }

private:
  static std::array<Rational, 3> line_of(const Planar_curve& c)
  {
    if (!c.is_line()) return {};
    const auto &x = c.numerator(0), &y = c.numerator(1), &w = c.weight();
    // Through two homogeneous points: a straight piece has different control points at its ends, or it would turn back.
    const auto last = [](const Bernstein<Rational, 1>& f) { return f[f.size() - 1]; };
    return {y[0] * last(w) - last(y) * w[0], last(x) * w[0] - x[0] * last(w), x[0] * last(y) - last(x) * y[0]};
  }

  std::size_t add_vertex(const Planar_curve& c, const Contact_vertex::Place& place)
  {
    const auto value = [&](const Bernstein<Rational, 1>& f) { return f[place.end == 0 ? 0 : f.size() - 1]; };
    Exact_point<2> p;
    for (std::size_t k = 0; k < 2; ++k) p[k] = value(c.numerator(k)) / value(c.weight());
    const auto [at, is_new] = at_point_.try_emplace(p, vertices_.size());
    if (is_new) vertices_.emplace_back();
    vertices_[at->second].places.push_back(place);
    return at->second;
  }

  std::vector<Contact_site> sites_;
  std::vector<Contact_vertex> vertices_;
  std::map<Exact_point<2>, std::size_t> at_point_;
  std::vector<std::size_t> first_;
};

} // namespace detail
} // namespace locus

#endif
