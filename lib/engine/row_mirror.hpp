#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/cell_set.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Rows that differ in nothing but the order of agents that are alike: *images* of each other. What is equal
/// in them is worked out for the *first* of them, where the agents come in the order of where they are.
class RowMirror {
 public:
  static constexpr std::size_t kMostAgents = 8;

  /// @param blocks the dimensions of each of two to kMostAgents agents, matching one by one, all of them
  ///   across rows
  RowMirror(const UniformGrid& grid, const std::vector<std::vector<std::size_t>>& blocks) {
    for (const std::vector<std::size_t>& dimensions : blocks) {
      Block& block = blocks_.emplace_back();
      block.offsets.assign(1, 0);
      for (const std::size_t d : dimensions) {
        block.dimensions.push_back({grid.row_stride(d), grid[d].count});
        add_dimension(block);
      }
    }
  }

  [[nodiscard]] bool is_first(std::int64_t row) const {
    const Keys keys = keys_of(row);
    return std::is_sorted(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(blocks_.size()));
  }

  /// The first of its images, or the row itself.
  [[nodiscard]] std::int64_t first_of(std::int64_t row) const {
    Keys keys = keys_of(row);
    const std::int64_t rest = row - offset_of(keys);
    std::sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(blocks_.size()));
    return rest + offset_of(keys);
  }

  /// Whether a set holds the same in all images.
  [[nodiscard]] bool is_same(const CellSet& set) const {
    for (std::int64_t row = 0; row < set.rows(); ++row) {
      if (!std::ranges::equal(set.row(row), set.row(first_of(row)))) return false;
    }
    return true;
  }

  /// Calls `visit(row)` for all images but the row itself.
  template <class Visit>
  void for_each_image(std::int64_t row, const Visit& visit) const {
    Keys keys = keys_of(row);
    const std::int64_t rest = row - offset_of(keys);
    const auto end = keys.begin() + static_cast<std::ptrdiff_t>(blocks_.size());
    std::sort(keys.begin(), end);
    do {
      const std::int64_t image = rest + offset_of(keys);
      if (image != row) visit(image);
    } while (std::next_permutation(keys.begin(), end));
  }

 private:
  /// [agent] where it is: row-major over its dimensions.
  using Keys = std::array<std::uint32_t, kMostAgents>;
  struct Dimension {
    std::int64_t stride;  ///< in rows
    std::int64_t count;
  };
  struct Block {
    std::vector<Dimension> dimensions;
    std::vector<std::int64_t> offsets;  ///< [key] in rows
  };

  static void add_dimension(Block& block) {
    std::vector<std::int64_t> offsets;
    for (const std::int64_t before : block.offsets) {
      for (std::int64_t i = 0; i < block.dimensions.back().count; ++i)
        offsets.push_back(before + i * block.dimensions.back().stride);
    }
    block.offsets = std::move(offsets);
  }

  /// What the agents' dimensions are of the number of a row.
  [[nodiscard]] std::int64_t offset_of(const Keys& keys) const {
    std::int64_t offset = 0;
    for (std::size_t b = 0; b < blocks_.size(); ++b) offset += blocks_[b].offsets[keys[b]];
    return offset;
  }

  [[nodiscard]] Keys keys_of(std::int64_t row) const {
    Keys keys{};
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      std::int64_t key = 0;
      for (const Dimension& dimension : blocks_[b].dimensions)
        key = key * dimension.count + row / dimension.stride % dimension.count;
      keys[b] = static_cast<std::uint32_t>(key);
    }
    return keys;
  }

  std::vector<Block> blocks_;
};

}  // namespace coordreq
