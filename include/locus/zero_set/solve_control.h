// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_ZERO_SET_SOLVE_CONTROL_H
#define LOCUS_ZERO_SET_SOLVE_CONTROL_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>

namespace locus {

/// Limits of a solve. Reaching one never changes an answer: what is left over is reported as undecided.
struct Solve_control {
  std::size_t max_cells = 20000;                                ///< cells examined, all depths together
  int max_depth = 40;                                           ///< halvings of one variable
  double max_seconds = std::numeric_limits<double>::infinity(); ///< wall-clock time of one solve
  std::size_t max_bits = 1u << 16;                              ///< size of an exact coefficient
  double node_width = 0x1p-22; ///< singular points are enclosed in cells no wider than this part of a piece

  /// Signs on cells, of derivatives and at corners, and roots on faces, are decided by exact integers alone, without the
  /// filters: a check of the filters, many times slower. Causes are solved, and cuts are chosen, as always.
  bool all_exact = false;

  /// Called now and then with the number of cells done and open, rounding to nearest.
  std::function<void(std::size_t done, std::size_t open)> progress;

  /// Set from any thread to stop the solve; what is left over is undecided.
  std::shared_ptr<std::atomic<bool>> cancel;

  bool is_cancelled() const { return cancel && cancel->load(std::memory_order_relaxed); }
};

} // namespace locus

#endif
