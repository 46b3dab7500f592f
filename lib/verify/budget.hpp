#pragma once

#include <algorithm>
#include <chrono>

namespace coordreq {

/// Wall time that may be spent on what is hard to confirm. Immutable.
class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Budget(double seconds) : seconds_(seconds), end_(Clock::now() + duration(seconds)) {}

  [[nodiscard]] bool is_over() const { return Clock::now() >= end_; }
  /// The end of what one of many questions may take that begins now.
  [[nodiscard]] Clock::time_point end_of_one() const {
    return std::min(end_, Clock::now() + duration(kShareOfOne * seconds_));
  }

 private:
  static constexpr double kShareOfOne = 0.05;
  static Clock::duration duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  double seconds_;
  Clock::time_point end_;
};

}  // namespace coordreq
