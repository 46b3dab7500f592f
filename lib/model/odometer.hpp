#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace coordreq {

/// Runs through all tuples of indices below `counts` row by row, the last index fastest: the order of cells
/// and of joint actions. No counts: one empty tuple.
class Odometer {
 public:
  /// @param start row-major number of the first tuple
  explicit Odometer(std::vector<std::int64_t> counts, std::int64_t start = 0)
      : counts_(std::move(counts)), indices_(counts_.size()) {
    if (start != 0) seek(start);
  }

  [[nodiscard]] const std::vector<std::int64_t>& indices() const { return indices_; }
  [[nodiscard]] std::int64_t operator[](std::size_t i) const { return indices_[i]; }

  /// Goes to the next tuple. @returns false when it begins again
  bool advance() {
    for (std::size_t i = counts_.size(); i-- > 0;) {
      if (++indices_[i] < counts_[i]) return true;
      indices_[i] = 0;
    }
    return false;
  }

  /// Goes to the tuple with this row-major number.
  void seek(std::int64_t number) {
    for (std::size_t i = counts_.size(); i-- > 0;) {
      indices_[i] = number % counts_[i];
      number /= counts_[i];
    }
  }

  /// Number of tuples.
  [[nodiscard]] std::int64_t size() const {
    std::int64_t product = 1;
    for (const std::int64_t count : counts_) product *= count;
    return product;
  }

 private:
  std::vector<std::int64_t> counts_;
  std::vector<std::int64_t> indices_;
};

}  // namespace coordreq
