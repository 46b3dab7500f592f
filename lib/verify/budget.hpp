#pragma once

#include <algorithm>
#include <ctime>

namespace coordreq {

/// Processor time that may be spent on what is hard to confirm, so that what else the machine does has no say
/// in what is confirmed. Immutable; begins when it is made.
class Budget {
 public:
  /// @param seconds for each thread, on average
  Budget(double seconds, int threads)
      : seconds_(seconds), threads_(threads), end_(now() + seconds * threads) {}

  [[nodiscard]] bool is_over() const { return now() >= end_; }
  /// The end of what one of many questions may take that begins now.
  [[nodiscard]] double end_of_one() const {
    return std::min(end_, now() + kShareOfOne * seconds_ * threads_);
  }
  /// Processor time of all threads so far.
  [[nodiscard]] static double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

 private:
  static constexpr double kShareOfOne = 0.05;

  double seconds_;
  int threads_;
  double end_;
};

}  // namespace coordreq
