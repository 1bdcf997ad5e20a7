// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SYSTEM_H
#define LOCUS_ZERO_SET_SYSTEM_H

#include <locus/function/bounded_bernstein.h>
#include <locus/function/domain.h>
#include <locus/function/scaled_integer_bernstein.h>
#include <locus/zero_set/claim.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace locus {

/// A polynomial equation on the unit cell of one piece of a domain, in the two forms the ladder needs.
template <int D>
class Equation {
public:
  virtual ~Equation() = default;

  virtual Degrees<D> degrees() const = 0;

  /// Enclosures of the Bernstein coefficients on `box` (which may reach beyond the unit cell). Called with upward
  /// rounding. The closer the form's own cancellation is modelled, the fewer exact cells a solve needs.
  virtual Bernstein<Interval, D> enclosure(const Box<D>& box) const = 0;

  /// Enclosure of the value at a point, by the same positive factor as `enclosure`.
  virtual Interval value(const std::array<double, static_cast<std::size_t>(D)>& point) const
  {
    Box<D> box;
    box.lo = box.hi = point;
    const Bernstein<Interval, D> f = enclosure(box);
    Interval v = f[0];
    for (const Interval& c : f.coefficients()) v = hull(v, c);
    return v;
  }

  /// Exact coefficients on the unit cell, up to a positive factor that is also allowed in `enclosure`: signs count.
  virtual const Bernstein<Scaled_integer, D>& exact() const = 0;
};

/// An equation given by its coefficients.
template <int D>
class Polynomial_equation final : public Equation<D> {
public:
  /// The coefficients may be of any size: the enclosure is of f times a positive factor.
  explicit Polynomial_equation(Bernstein<Scaled_integer, D> f) : exact_(std::move(f))
  {
    std::size_t bits = 0;
    for (const Integer& c : exact_.values().coefficients()) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
    enclosure_ = converted<Interval>(exact_.values(), [&](const Integer& c) { return enclosing_scaled(c, static_cast<long>(bits)); });
  }
  explicit Polynomial_equation(const Bernstein<Rational, D>& f) : Polynomial_equation(Bernstein<Scaled_integer, D>(f)) {}

  Degrees<D> degrees() const override { return exact_.degrees(); }
  const Bernstein<Scaled_integer, D>& exact() const override { return exact_; }

  Bernstein<Interval, D> enclosure(const Box<D>& box) const override
  {
    Bernstein<Interval, D> f = enclosure_;
    for (int k = 0; k < D; ++k) {
      const auto kk = static_cast<std::size_t>(k);
      if (box.lo[kk] != 0 || box.hi[kk] != 1) f = restrict_to(f, k, Interval(box.lo[kk]), Interval(box.hi[kk]));
    }
    return f;
  }

private:
  Bernstein<Scaled_integer, D> exact_;
  Bernstein<Interval, D> enclosure_;
};

/// The box of doubles that some intervals span.
template <std::size_t N>
Box<static_cast<int>(N)> box_of(const std::array<Interval, N>& at)
{
  Box<static_cast<int>(N)> box;
  for (std::size_t v = 0; v < N; ++v) {
    box.lo[v] = at[v].inf();
    box.hi[v] = at[v].sup();
  }
  return box;
}

/// `cause` and `tag` of a singular point that no cause explains.
inline constexpr std::size_t no_cause = static_cast<std::size_t>(-1);
inline constexpr int no_tag = -1;

/// An isolated solution of D equations in D variables: the only one in `box`, which may reach a little over the unit
/// cell.
template <int D>
struct Isolated_solution {
  std::array<Interval, static_cast<std::size_t>(D)> box;
  /// For each variable: 0 or 1 where the solution lies exactly on that face of the unit cell, else -1.
  std::array<int, static_cast<std::size_t>(D)> face;
  std::size_t cause = 0; ///< index of the cause that it solves
  int tag = 0;           ///< that cause's tag
  int also = no_tag;     ///< tag of another cause that a singular point solves as well
  Box<D> unique_in;      ///< larger box with no other solution of the same equations
  /// What proves the solution where it is not regular, and no interval test can.
  std::shared_ptr<const Algebraic_evidence> evidence;

  Isolated_solution() { face.fill(-1); }

  bool on_boundary() const
  {
    for (int f : face)
      if (f >= 0) return true;
    return false;
  }
};

/// A smaller regular system whose solutions explain singular or infinite points of another one.
template <int D>
struct Cause {
  std::string name;                                                     ///< e.g. "C1 = C2"
  std::array<std::shared_ptr<const Equation<D>>, static_cast<std::size_t>(D)> equations;
  Claim_kind proves = Claim_kind::crossing;
  int tag = 0; ///< for the caller, who finds it again at the solutions
  int also = no_tag; ///< tag of another cause that these solve as well
  /// Causes (by index) all of whose solutions solve this one as well; such a solution counts for them only.
  std::vector<std::size_t> includes;
  /// Solutions that belong to another factor of the equation, if any, decided exactly.
  std::function<bool(const Isolated_solution<D>&)> leave_out;
};

/// K polynomial equations in D variables on the unit cell of a domain's piece. `known_factors` have been divided out already and are listed so
/// that a result can report them; `causes` let the solver use geometry without knowing any.
template <int K, int D>
struct System {
  std::string name;
  std::array<std::shared_ptr<const Equation<D>>, static_cast<std::size_t>(K)> equations;
  std::vector<std::shared_ptr<const Equation<D>>> known_factors;
  std::vector<Cause<D>> causes;
  /// Half of the unit cell of which nothing is wanted, if any: a solve may leave boxes there alone, and arcs open.
  std::function<bool(const Box<D>&)> outside;
};

} // namespace locus

#endif
