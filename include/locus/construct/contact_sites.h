// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CONSTRUCT_CONTACT_SITES_H
#define LOCUS_CONSTRUCT_CONTACT_SITES_H

#include <locus/construct/contact_tree.h>
#include <locus/construct/planar_pieces.h>

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
  /// Coefficients of the turn's derivative that vanish at the ends whatever the circle: of a straight polynomial piece that stands
  /// still there.
  std::array<std::size_t, 2> rests{};
  bool is_polynomial = true; ///< of constant weight
};

/// An end or a corner of an input.
struct Contact_vertex {
  std::size_t site = 0; ///< one with it at its end
  int end = 0;
  Feature feature = Feature::end;
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
      sites_.push_back({first_.size() - 1, i, Contact_tree(pieces.curves[i]), pieces.evaluator(i), pieces.ranges[i], {none, none}, {none, none}, rests_of(c), c.weight().degree() == 0});
    }
    for (std::size_t i = 0; i < n; ++i)
      for (int end = 0; end < 2; ++end) {
        if (pieces.curves[i]->is_infinite_at(end)) continue;
        const Joint* joint = pieces.chain.joint_at(i, end);
        const std::size_t next = joint ? first + pieces.chain.neighbour(i, end) : none;
        const auto e = static_cast<std::size_t>(end);
        if (joint && joint->goes_on()) {
          sites_[first + i].smooth_next[e] = next;
        } else if (joint && end == 0 && next != first + i) {
          continue; // noted with the end of the piece before
        } else {
          sites_[first + i].vertex[e] = vertices_.size();
          if (joint) sites_[next].vertex[1 - e] = vertices_.size();
          vertices_.push_back({first + i, end, joint ? Feature::corner : end == 0 ? Feature::start : Feature::end});
        }
      }
  }

  std::size_t size() const { return sites_.size(); }
  const Contact_site& operator[](std::size_t i) const { return sites_[i]; }
  Contact_site& operator[](std::size_t i) { return sites_[i]; }
  std::size_t site(std::size_t input, std::size_t piece) const { return first_[input] + piece; }
  const std::vector<Contact_vertex>& vertices() const { return vertices_; }

private:
  static std::array<std::size_t, 2> rests_of(const Planar_curve& c)
  {
    std::array<std::size_t, 2> rests{};
    if (!c.is_line() || c.weight().degree() > 0) return rests;
    const std::size_t n = c.numerator(0).size();
    const auto is_same = [&](std::size_t i, std::size_t j) { return c.numerator(0)[i] == c.numerator(0)[j] && c.numerator(1)[i] == c.numerator(1)[j]; };
    while (rests[0] + 1 < n && is_same(rests[0], rests[0] + 1)) ++rests[0];
    while (rests[1] + 1 < n && is_same(n - 1 - rests[1], n - 2 - rests[1])) ++rests[1];
    return rests;
  }

  std::vector<Contact_site> sites_;
  std::vector<Contact_vertex> vertices_;
  std::vector<std::size_t> first_;
};

} // namespace detail
} // namespace locus

#endif
