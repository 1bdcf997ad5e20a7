// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_DOMAIN_H
#define LOCUS_FUNCTION_DOMAIN_H

#include <locus/number/rational.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace locus {

/// How two neighbouring pieces of a variable's domain meet. Continuity is that of the point x = p/w, not of its
/// homogeneous form.
enum class Joint_kind : unsigned char {
  smooth, ///< C^k for the `order` k ≥ 1 given with it
  g1,     ///< tangent directions agree, their lengths do not
  corner, ///< the tangent turns, or the curve reverses (a cusp)
  pole    ///< the curve passes through infinity
};

struct Joint {
  /// Order of a joint at which both pieces are one and the same rational function.
  static constexpr int any_order = std::numeric_limits<int>::max();

  Joint_kind kind = Joint_kind::smooth;
  int order = 1;             ///< of continuity, for smooth joints
  bool by_tolerance = false; ///< the tangent turns, by less than the user's tolerance: taken as smooth

  /// Normals turn continuously here, so loci go on across it.
  bool goes_on() const { return kind == Joint_kind::smooth || kind == Joint_kind::g1; }
};

/// One span of a variable: the unit interval of a Bernstein form, mapped affinely onto [lo, hi]; or, for the
/// projective pieces of an infinite domain, u = lo/(1-s) onto [lo, ∞) with lo > 0, or u = hi/s onto (-∞, hi] with hi < 0.
/// The local coordinate s grows with u from 0 to 1. The end that is infinite has no meaning as a number.
struct Piece {
  Rational lo = 0, hi = 1;
  bool lo_infinite = false, hi_infinite = false;

  bool is_finite() const { return !lo_infinite && !hi_infinite; }

  /// The variable's value at local coordinate `s` in [0,1]; nothing where it is infinite.
  std::optional<Rational> at(const Rational& s) const
  {
    if (is_finite()) return Rational(lo + s * (hi - lo));
    const Rational t = hi_infinite ? Rational(1 - s) : s;
    if (t == 0) return std::nullopt;
    return Rational((hi_infinite ? lo : hi) / t);
  }

  bool contains(const Rational& u) const { return (lo_infinite || lo <= u) && (hi_infinite || u <= hi); }

  /// The local coordinate of a value that the piece contains.
  Rational local(const Rational& u) const
  {
    if (hi_infinite) return Rational(1 - lo / u);
    if (lo_infinite) return Rational(hi / u);
    return Rational((u - lo) / (hi - lo));
  }
};

/// The domain of one variable: pieces in order and the joints between them. The last joint, where there are as many as
/// pieces, is the seam that closes the chain.
struct Chain {
  std::vector<Piece> pieces = std::vector<Piece>(1);
  std::vector<Joint> joints;

  bool is_closed() const { return joints.size() == pieces.size(); }

  /// The joint at an end (0 or 1) of a piece, if there is one.
  const Joint* joint_at(std::size_t piece, int end) const
  {
    if (end == 1 && piece < joints.size()) return &joints[piece];
    if (end == 0 && piece > 0) return &joints[piece - 1];
    if (end == 0 && is_closed()) return &joints.back();
    return nullptr;
  }

  /// The piece behind an end.
  std::size_t neighbour(std::size_t piece, int end) const
  {
    const std::size_t n = pieces.size();
    return end == 1 ? (piece + 1) % n : (piece + n - 1) % n;
  }

  bool goes_on_at(std::size_t piece, int end) const
  {
    const Joint* joint = joint_at(piece, end);
    return joint && joint->goes_on();
  }
};

/// The domain of D variables: a chain for each.
template <int D>
struct Domain {
  std::array<Chain, static_cast<std::size_t>(D)> chains;

  std::size_t cells() const
  {
    std::size_t n = 1;
    for (const Chain& c : chains) n *= c.pieces.size();
    return n;
  }
};

/// A box inside the unit cell of a domain's piece. Its corners are dyadic, so doubles carry them exactly.
template <int D>
struct Box {
  std::array<double, static_cast<std::size_t>(D)> lo{}, hi{};

  static Box unit()
  {
    Box b;
    b.hi.fill(1.0);
    return b;
  }
  double width(int k) const { return hi[static_cast<std::size_t>(k)] - lo[static_cast<std::size_t>(k)]; }
  double max_width() const
  {
    double w = 0;
    for (int k = 0; k < D; ++k) w = std::max(w, width(k));
    return w;
  }
};

} // namespace locus

#endif
