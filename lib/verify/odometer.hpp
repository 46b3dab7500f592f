#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace coordreq {

/// Runs through all tuples of indices below `counts`, the last index fastest.
class Odometer {
 public:
  /// @param start row-major number of the first tuple
  explicit Odometer(std::vector<std::int64_t> counts, std::int64_t start = 0)
      : counts_(std::move(counts)), digits_(counts_.size(), 0) {
    for (std::size_t i = counts_.size(); i-- > 0; start /= counts_[i]) digits_[i] = start % counts_[i];
  }

  [[nodiscard]] std::int64_t operator[](std::size_t i) const { return digits_[i]; }

  /// @returns false when it begins again
  bool advance() {
    for (std::size_t i = counts_.size(); i-- > 0;) {
      if (++digits_[i] < counts_[i]) return true;
      digits_[i] = 0;
    }
    return false;
  }

 private:
  std::vector<std::int64_t> counts_;
  std::vector<std::int64_t> digits_;
};

}  // namespace coordreq
