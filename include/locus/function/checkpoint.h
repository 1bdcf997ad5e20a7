// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_FUNCTION_CHECKPOINT_H
#define LOCUS_FUNCTION_CHECKPOINT_H

#include <exception>
#include <functional>

namespace locus {

/// Ends a long exact computation from one of its checkpoints; caught by whoever set the checkpoint.
struct Stopped : std::exception {
  const char* what() const noexcept override { return "locus: an exact computation was stopped at a limit"; }
};

/// Called now and then by long exact computations, which end where it throws.
using Checkpoint = std::function<void()>;

inline void pass(const Checkpoint& checkpoint)
{
  if (checkpoint) checkpoint();
}

} // namespace locus

#endif
