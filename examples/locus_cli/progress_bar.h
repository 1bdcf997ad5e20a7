// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CLI_PROGRESS_BAR_H
#define LOCUS_CLI_PROGRESS_BAR_H

#include <chrono>
#include <cstddef>
#include <ostream>
#include <string>

/// Tells of long work: a bar that redraws itself on a terminal, a line now and then elsewhere.
class Progress_bar {
public:
  enum class Style { none, lines, bar };

  /// Nothing is shown before `patience` seconds have passed.
  Progress_bar(std::ostream& out, Style style, double patience) : out_(out), style_(style), next_(patience) {}
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;
  ~Progress_bar() { clear(); }

  /// `done` and `open` count `what`, e.g. "cells".
  void show(const char* what, std::size_t done, std::size_t open)
  {
    if (style_ == Style::none) return;
    const double seconds = elapsed();
    if (seconds < next_) return;
    next_ = seconds + (style_ == Style::bar ? 0.1 : 1.0);
    const std::string counts = std::to_string(done) + " " + what + " done, " + std::to_string(open) + " open, " +
                               std::to_string(seconds).substr(0, 5) + " s";
    if (style_ == Style::lines) {
      out_ << "locus: " << counts << std::endl;
      return;
    }
    constexpr std::size_t width = 30;
    const std::size_t filled = done + open > 0 ? width * done / (done + open) : 0;
    const std::string line = "[" + std::string(filled, '#') + std::string(width - filled, '.') + "] " + counts;
    out_ << '\r' << line << std::string(shown_ > line.size() ? shown_ - line.size() : 0, ' ') << std::flush;
    shown_ = line.size();
  }

  void clear()
  {
    if (shown_ > 0) out_ << '\r' << std::string(shown_, ' ') << '\r' << std::flush;
    shown_ = 0;
  }

private:
  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  std::ostream& out_;
  Style style_;
  double next_;
  std::size_t shown_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

#endif
