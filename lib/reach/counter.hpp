#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace coordreq {

/// Counts through all index tuples below `counts`, the last index fastest. No counts: one empty tuple.
class Counter {
 public:
  explicit Counter(std::vector<std::int64_t> counts)
      : counts_(std::move(counts)), indices_(counts_.size(), 0) {}

  [[nodiscard]] const std::vector<std::int64_t>& indices() const { return indices_; }

  /// @returns false after the last tuple (and begins again)
  bool next() {
    for (std::size_t i = counts_.size(); i-- > 0;) {
      if (++indices_[i] < counts_[i]) return true;
      indices_[i] = 0;
    }
    return false;
  }

  /// Goes to the tuple with this row-major number.
  void seek(std::int64_t position) {
    for (std::size_t i = counts_.size(); i-- > 0;) {
      indices_[i] = position % counts_[i];
      position /= counts_[i];
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
