#pragma once

#include <cstdint>
#include <vector>

namespace coordreq {

/// Numbers of grid points as SCOTS counts them, dimension 0 fastest, against row-major positions, the last
/// dimension fastest.
class ReversedNumbers {
 public:
  /// @param counts points of each dimension
  explicit ReversedNumbers(const std::vector<std::int64_t>& counts) {
    std::int64_t row_major = 1;
    for (const std::int64_t count : counts) row_major *= count;
    std::int64_t reversed = 1;
    for (const std::int64_t count : counts) {
      row_major /= count;
      strides_.push_back({row_major, count, reversed});
      reversed *= count;
    }
  }

  /// The position that has this number.
  [[nodiscard]] std::int64_t position_of(std::int64_t number) const {
    std::int64_t position = 0;
    for (const Stride& stride : strides_)
      position += number / stride.reversed % stride.count * stride.row_major;
    return position;
  }

 private:
  struct Stride {
    std::int64_t row_major;
    std::int64_t count;
    std::int64_t reversed;
  };
  std::vector<Stride> strides_;
};

}  // namespace coordreq
