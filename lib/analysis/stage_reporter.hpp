#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "analysis/progress.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "base/timer.hpp"
#include "engine/wave_watch.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Puts together the progress reports of an analysis: its stages, the steps of fixed points, and loops of the
/// team, which it watches as long as it lives.
class StageReporter {
 public:
  /// @param report may be empty; called at once for what begins or ends, else some twenty times a second
  StageReporter(std::function<void(const Progress&)> report, ThreadTeam& team);
  ~StageReporter();
  StageReporter(const StageReporter&) = delete;
  StageReporter& operator=(const StageReporter&) = delete;

  void enter(const std::string& stage);
  void enter_substage(const std::string& substage);
  /// @param row_length cells in a row
  void step(const WaveStep& step, std::int64_t row_length);
  /// Until the next call there may be a temporary file.
  void set_temporary(bool has_temporary);
  /// The results file is complete.
  void set_written() { progress_.is_written = true; }
  /// From now on the pass is to fill the arrays of these values; their functions are replaced by ones that
  /// count. @pre unchecked: this outlives the values
  void watch_writing(const ProblemSpec& spec, FieldValues& values);

  /// Ends the last stage. @returns the stages and their seconds
  const std::vector<std::pair<std::string, double>>& finish();

 private:
  using Clock = std::chrono::steady_clock;
  void on_loop(std::int64_t done, std::int64_t count);
  void report_now();
  void report_if_due();

  std::function<void(const Progress&)> report_;
  ThreadTeam& team_;
  StageTimer timer_;
  Progress progress_;
  Clock::time_point next_;
  std::atomic<std::uint64_t> written_{0};  ///< bytes of arrays
  std::uint64_t to_write_ = 0;             ///< 0 outside of the writing
};

}  // namespace coordreq
