// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_DESCARTES_SEARCH_H
#define LOCUS_FUNCTION_DESCARTES_SEARCH_H

#include <locus/function/bounded_bernstein.h>

#include <optional>
#include <vector>

namespace locus {
namespace detail {

/// One cut of the interval at hand, at so many sixteenths of its length, and the part that was taken.
struct Cut {
  unsigned char sixteenths = 8;
  bool high = false;
};

/// The cuts that lead from a whole interval to a part of it.
using Cut_path = std::vector<Cut>;

/// Descartes' method on the unit interval: cuts until the Bernstein coefficients of a part change sign at most once.
/// `Form` keeps the coefficients of the parts in slots, the whole in slot 0, and gives
///   int degree() const,
///   Sign sign(slot, i) const   of a coefficient as far as it is known,
///   void split(from, to, sixteenths)   which puts the parts of slot `from` into slots `to` and `to + 1`.
/// `Observer` gives
///   bool found(path)           called for a part that holds one root, a simple one,
///   bool found_middle(path)    called for a root exactly in the middle of a part,
///   bool is_root_in_middle(path)   asked where the coefficients leave that open; may say no for not known.
template <class Form, class Observer>
class Descartes_search {
public:
  Descartes_search(Form& form, Observer& observer, std::size_t max_depth)
    : form_(form), observer_(observer), max_depth_(max_depth)
  {
  }

  /// Finds all roots in the open interval, in order. The signs at its ends are given: strict, or zero for a simple
  /// root there. False where signs stay unknown or the observer returns false for a root found.
  bool run(Sign low, Sign high)
  {
    path_.clear();
    return descend(0, low, high);
  }

private:
  bool descend(std::size_t slot, Sign low, Sign high)
  {
    const int changes = sign_changes(slot, low, high);
    if (changes == 0) return true;
    if (changes == 1) return observer_.found(path_);
    if (path_.size() == max_depth_) return false;
    const std::size_t parts = 2 * path_.size() + 1;
    for (const unsigned char at : std::initializer_list<unsigned char>{8, 7, 9, 6}) {
      form_.split(slot, parts, at);
      Sign middle = form_.sign(parts + 1, 0);
      if (!is_strict(middle) && at == 8 && observer_.is_root_in_middle(path_)) middle = Sign::zero;
      if (!is_certain(middle)) continue;
      path_.push_back({at, false});
      bool decided = descend(parts, low, middle);
      path_.pop_back();
      if (decided && middle == Sign::zero) decided = observer_.found_middle(path_);
      path_.push_back({at, true});
      decided = decided && descend(parts + 1, middle, high);
      path_.pop_back();
      return decided;
    }
    return false;
  }

  /// Changes of sign along the coefficients: 0, 1, or 2 for more or for not known. The signs at the ends are known
  /// from outside. One unknown sign between two different ones changes nothing, all others might.
  int sign_changes(std::size_t slot, Sign low, Sign high) const
  {
    int count = 0, unknown = 0;
    Sign last = low;
    const auto add = [&](Sign s) {
      if (unknown > (is_strict(last) && s != last ? 1 : 0)) count = 2;
      if (is_strict(last) && s != last) ++count;
      last = s;
      unknown = 0;
    };
    const auto n = static_cast<std::size_t>(form_.degree());
    for (std::size_t i = 1; i < n && count < 2; ++i) {
      const Sign s = form_.sign(slot, i);
      if (is_strict(s)) add(s);
      else if (s == Sign::unknown) ++unknown;
    }
    if (is_strict(high)) add(high);
    else if (unknown > 0) count = 2;
    return std::min(count, 2);
  }

  Form& form_;
  Observer& observer_;
  std::size_t max_depth_;
  Cut_path path_;
};

/// Coefficients in doubles, each slot with one error bound that holds in any rounding mode.
class Bounded_coefficients {
public:
  /// `whole` must outlive this object.
  Bounded_coefficients(const double* whole, int degree, double error)
    : whole_(whole), count_(static_cast<std::size_t>(degree) + 1), whole_error_(error)
  {
  }

  int degree() const { return static_cast<int>(count_) - 1; }
  Sign sign(std::size_t slot, std::size_t i) const { return sign_of(at(slot)[i], error(slot)); }

  void split(std::size_t from, std::size_t to, int sixteenths)
  {
    if (arena_.size() < (to + 1) * (count_ + 1)) arena_.resize(2 * (to + 1) * (count_ + 1));
    const double* const c = at(from);
    double* const low = slot(to);
    double* const high = slot(to + 1);
    double norm = 0;
    for (std::size_t i = 0; i < count_; ++i) norm = std::max(norm, std::abs(c[i]));
    norm = (norm + error(from)) * (1 + 2 * operation_error);
    double roundings = static_cast<double>(count_) + 1;
    if (sixteenths == 8) {
      split_kernel(c, low, high, Layout{1, count_, 1}, [](double a, double b) { return 0.5 * (a + b); });
    } else {
      const double s = sixteenths / 16.0, rest = 1 - s;
      split_kernel(c, low, high, Layout{1, count_, 1}, [=](double a, double b) { return rest * a + s * b; });
      roundings *= 3;
    }
    low[count_] = high[count_] = accumulated_error(error(from), roundings, norm);
  }

private:
  const double* at(std::size_t slot) const { return slot == 0 ? whole_ : arena_.data() + (slot - 1) * (count_ + 1); }
  double* slot(std::size_t slot) { return arena_.data() + (slot - 1) * (count_ + 1); }
  double error(std::size_t slot) const { return slot == 0 ? whole_error_ : at(slot)[count_]; }

  const double* whole_;
  std::size_t count_;
  double whole_error_;
  std::vector<double> arena_; ///< slots from 1 on: coefficients, then the error bound
};

/// Signed integers of a fixed number of machine words, in two's complement, side by side in one array.
class Word_array {
public:
  Word_array(std::size_t size, std::size_t words) : words_(words), data_(size * words) {}

  std::size_t words() const { return words_; }
  mp_limb_t* operator[](std::size_t i) { return data_.data() + i * words_; }
  const mp_limb_t* operator[](std::size_t i) const { return data_.data() + i * words_; }
  void resize(std::size_t size) { data_.resize(size * words_); }
  std::size_t size() const { return data_.size() / words_; }

  bool is_negative(std::size_t i) const { return (*this)[i][words_ - 1] >> (GMP_NUMB_BITS - 1); }

  /// Stores x, which must fit.
  void set(std::size_t i, const Integer& x)
  {
    mp_limb_t* const w = (*this)[i];
    const std::size_t used = mpz_size(x.get_mpz_t());
    mpn_zero(w, static_cast<mp_size_t>(words_));
    if (used > 0) mpn_copyi(w, mpz_limbs_read(x.get_mpz_t()), static_cast<mp_size_t>(used));
    if (sgn(x) < 0) negate(i);
  }

  void negate(std::size_t i) { mpn_neg((*this)[i], (*this)[i], static_cast<mp_size_t>(words_)); }
  void add(std::size_t to, std::size_t i)
  {
    mpn_add_n((*this)[to], (*this)[to], (*this)[i], static_cast<mp_size_t>(words_));
  }

  /// The number as mantissa·2^exponent, the mantissa with an error of at most three roundings.
  std::pair<double, int> rounded(std::size_t i)
  {
    const bool negative = is_negative(i);
    if (negative) negate(i);
    const mp_limb_t* const w = (*this)[i];
    std::size_t top = words_ - 1;
    while (top > 0 && w[top] == 0) --top;
    const double low = top == 0 ? 0.0 : static_cast<double>(w[top - 1]);
    const double value = static_cast<double>(w[top]) + low * 0x1p-64;
    if (negative) negate(i);
    return {negative ? -value : value, static_cast<int>(top * GMP_NUMB_BITS)};
  }

private:
  std::size_t words_;
  std::vector<mp_limb_t> data_;
};

/// Coefficients as fixed-point numbers of many words, each slot with one error bound in units of the last place. They
/// stand between doubles, which cannot tell close roots apart, and exact integers, whose length grows with each cut.
class Wide_coefficients {
public:
  /// The values times a common power of two, rounded to `words` machine words.
  Wide_coefficients(const std::vector<Integer>& values, std::size_t words)
    : count_(values.size()), store_(count_, words), error_(1)
  {
    static_assert(GMP_NAIL_BITS == 0);
    std::size_t bits = 1;
    for (const Integer& x : values) bits = std::max(bits, mpz_sizeinbase(x.get_mpz_t(), 2));
    const std::size_t room = words * GMP_NUMB_BITS - spare_bits;
    error_[0] = bits > room ? 1 : 0;
    Integer y;
    for (std::size_t i = 0; i < count_; ++i) {
      if (bits > room) mpz_fdiv_q_2exp(y.get_mpz_t(), values[i].get_mpz_t(), bits - room);
      else mpz_mul_2exp(y.get_mpz_t(), values[i].get_mpz_t(), room - bits);
      store_.set(i, y);
    }
  }

  int degree() const { return static_cast<int>(count_) - 1; }

  Sign sign(std::size_t slot, std::size_t i) const
  {
    const mp_limb_t* const x = store_[slot * count_ + i];
    const bool negative = store_.is_negative(slot * count_ + i);
    const mp_limb_t filling = negative ? ~mp_limb_t(0) : 0, error = error_[slot];
    bool small = negative ? x[0] >= -error : x[0] <= error; // in the lowest word; a small x fills the others
    for (std::size_t k = 1; small && k < store_.words(); ++k) small = x[k] == filling;
    if (small && !(negative && error == 0)) return error == 0 ? Sign::zero : Sign::unknown;
    return negative ? Sign::negative : Sign::positive;
  }

  void split(std::size_t from, std::size_t to, int sixteenths)
  {
    if (error_.size() < to + 2) {
      error_.resize(2 * to + 2);
      store_.resize(error_.size() * count_);
    }
    const std::size_t low = to * count_, high = low + count_;
    const auto words = static_cast<mp_size_t>(store_.words());
    mpn_copyi(store_[high], store_[from * count_], words * static_cast<mp_size_t>(count_));
    for (std::size_t level = 0; level < count_; ++level) {
      mpn_copyi(store_[low + level], store_[high], words);
      mp_limb_t* x = store_[high];
      for (std::size_t i = 0; i + level + 1 < count_; ++i, x += words) blend(x, x + words, sixteenths);
    }
    // Each level rounds down by less than one unit, and the coefficients between are means.
    error_[to] = error_[to + 1] = error_[from] + count_;
  }

private:
  /// Room for the sign and for sixteen times a coefficient.
  static constexpr std::size_t spare_bits = 6;

  /// x becomes the weighted mean of x and y, rounded down.
  void blend(mp_limb_t* x, const mp_limb_t* y, int sixteenths) const
  {
    const auto words = static_cast<mp_size_t>(store_.words());
    unsigned shift = 1;
    if (sixteenths == 8) {
      mpn_add_n(x, x, y, words);
    } else { // modulo 2^bits, so that negative numbers need no care
      mpn_mul_1(x, x, words, static_cast<mp_limb_t>(16 - sixteenths));
      mpn_addmul_1(x, y, words, static_cast<mp_limb_t>(sixteenths));
      shift = 4;
    }
    const mp_limb_t sign = x[words - 1] >> (GMP_NUMB_BITS - 1);
    mpn_rshift(x, x, words, shift);
    x[words - 1] |= -sign << (GMP_NUMB_BITS - shift);
  }

  std::size_t count_;
  Word_array store_;
  std::vector<mp_limb_t> error_;
};

// ------------------------------------------------------------------------------------- where a path leads to

/// The part of the interval [lo, hi] to which a path of cuts leads; nothing where a double cannot hold an end.
inline std::optional<std::pair<double, double>> follow(const Cut_path& path, double lo, double hi)
{
  // All ends are multiples of the last bit's value in lo and hi, divided by 2 or 16 for each cut. As long as they are
  // integers below 2^53 times that, no operation rounds.
  const auto last_bit = [](double x) {
    int exponent;
    const double fraction = std::frexp(x, &exponent);
    const auto digits = static_cast<unsigned long>(std::abs(std::ldexp(fraction, 53)));
    return x == 0 ? 1024 : exponent - 53 + __builtin_ctzl(digits);
  };
  int length;
  std::frexp((lo < 0) == (hi < 0) ? std::max(std::abs(lo), std::abs(hi)) : std::abs(lo) + std::abs(hi), &length);
  int bits = 0;
  for (const Cut& cut : path) bits += cut.sixteenths == 8 ? 1 : 4;
  const int last = std::min(last_bit(lo), last_bit(hi)) - bits;
  if (length - last > 53 || last < -1074) return std::nullopt;
  for (const Cut& cut : path) (cut.high ? lo : hi) = lo + cut.sixteenths * 0.0625 * (hi - lo);
  return std::pair(lo, hi);
}

inline std::optional<std::pair<Rational, Rational>> follow(const Cut_path& path, const Rational& lo, const Rational& hi)
{
  // `from` and `length` in units of 2^-bits.
  Integer from = 0, length = 1;
  mp_bitcnt_t bits = 0;
  for (const Cut& cut : path) {
    const unsigned shift = cut.sixteenths == 8 ? 1 : 4, low = cut.sixteenths >> (4 - shift);
    from <<= shift;
    if (cut.high) mpz_addmul_ui(from.get_mpz_t(), length.get_mpz_t(), low);
    if (shift > 1) length *= cut.high ? 16 - low : low;
    bits += shift;
  }
  Rational a(from), b(Integer(from + length));
  mpq_div_2exp(a.get_mpq_t(), a.get_mpq_t(), bits);
  mpq_div_2exp(b.get_mpq_t(), b.get_mpq_t(), bits);
  if (lo == 0 && hi == 1) return std::pair(a, b);
  const Rational whole = hi - lo;
  return std::pair(Rational(lo + a * whole), Rational(lo + b * whole));
}

} // namespace detail
} // namespace locus

#endif
