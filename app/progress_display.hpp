#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "analysis/progress.hpp"
#include "analysis/time_left.hpp"
#include "app/options.hpp"

namespace coordreq {

enum class ProgressMode : std::uint8_t {
  automatic,  ///< the bar, a line a minute where there is no terminal; but for --quiet
  bar,        ///< on a terminal
  log,
  none,
};

/// --progress and --progress-every.
struct ProgressOptions {
  ProgressMode mode = ProgressMode::automatic;
  std::optional<double> every_seconds = {};  ///< between two lines; nothing: 10 of a log, else 60
};

void declare_progress(Options& options, ProgressOptions& progress);

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
