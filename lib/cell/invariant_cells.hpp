#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cell/random_stream.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Draws from the cells of K, those where all that memories keep is as at first, without a list of them:
/// counts by block, then a walk through one block.
class InvariantCells {
 public:
  /// @param delay of all cells in the order of the spec. @pre unchecked: it outlives this object.
  InvariantCells(const SystemSpec& spec, std::span<const std::int32_t> delay);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// @pre there are any
  [[nodiscard]] std::int64_t draw(RandomStream& random) const;

 private:
  static constexpr std::size_t kBlock = 4096;

  [[nodiscard]] bool has(std::size_t cell) const { return delay_[cell] >= 0 && cell % stride_ == 0; }

  std::span<const std::int32_t> delay_;
  std::size_t stride_ = 1;             ///< of the states that no memory keeps
  std::vector<std::uint64_t> before_;  ///< cells before each block
  std::uint64_t count_ = 0;
};

}  // namespace coordreq
