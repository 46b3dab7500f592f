#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace coordreq {

/// Wall time by stage, in the order in which the stages were begun.
class StageTimer {
 public:
  /// Ends the current stage, if any, and begins `name`; a name seen before is added to.
  void begin(std::string name);
  /// Ends the current stage.
  void end();
  /// Stages and their seconds so far.
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<std::pair<std::string, double>> seconds_;
  std::size_t current_ = 0;
  bool running_ = false;
  Clock::time_point started_;
};

/// Gives memory that is not in use back to the system and lets peak_memory_bytes() begin anew from what is
/// left. Without effect where the system cannot do that.
void reset_peak_memory();

/// Memory of this process now, in bytes; 0 where the system does not report it.
[[nodiscard]] std::uint64_t resident_bytes();

/// An entry of /proc/self/status, in bytes: "VmData" is the size that a limit of data counts, "RssAnon" and
/// "RssFile" are in memory; 0 where the system does not report it.
[[nodiscard]] std::uint64_t status_bytes(const std::string& key);

/// The largest resident set of this process so far, or since reset_peak_memory(), in bytes; 0 where the
/// system does not report it.
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace coordreq
