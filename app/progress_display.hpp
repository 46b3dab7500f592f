#pragma once

#include <chrono>
#include <string>

#include "analysis/progress.hpp"
#include "analysis/time_left.hpp"
#include "app/progress_options.hpp"

namespace coordreq {

/// Shows progress on standard error: as one line that is rewritten at most ten times a second and
/// gone in the end, as a log, or where there is no terminal as a line a minute. Uses no colour, so NO_COLOR
/// has nothing to switch off.
class ProgressDisplay {
 public:
  ProgressDisplay(const ProgressOptions& options, bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void update(const Progress& progress);
  /// The work is done; nothing more is said of a last stage that an error has ended.
  void finish();
  /// A line "coordreq: TEXT" that stays.
  void notice(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  void end_stage();
  [[nodiscard]] double seconds_since(Clock::time_point time) const;

  ProgressMode mode_;
  bool is_sparse_ = false;  ///< lines alone, without the ends of stages
  int width_ = 0;           ///< columns of the bar
  std::chrono::duration<double> pause_;
  Clock::time_point begin_;
  Clock::time_point next_;
  std::string stage_;
  Clock::time_point stage_begin_;
  TimeLeft time_left_;
};

}  // namespace coordreq
