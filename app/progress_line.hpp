#pragma once

#include <chrono>
#include <string>

#include "analysis/analyze.hpp"

namespace coordreq {

/// One line on standard error that is rewritten at most ten times a second and gone in the end.
/// Shows nothing unless standard error is a terminal. Uses no colour, so NO_COLOR has nothing to switch off.
class ProgressLine {
 public:
  /// @param shown false for --quiet
  explicit ProgressLine(bool shown);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void update(const Progress& progress);
  void update(const std::string& text);

 private:
  void rewrite(const std::string& text);

  using Clock = std::chrono::steady_clock;
  int width_ = 0;  ///< columns that may be used; 0: show nothing
  std::size_t length_ = 0;
  Clock::time_point next_;
};

}  // namespace coordreq
