#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// The symmetry group that exchanges agents that are alike, acting on rows: rows that differ in nothing but
/// the order of these agents are *permuted* rows of each other. The *canonical* row among them, in which the
/// agents are in ascending order of where they are, stands for all (symmetry reduction; Emerson and Sistla,
/// "Symmetry and Model Checking", 1996).
///
/// Immutable once built, so safe to share between threads.
class RowSymmetry {
 public:
  static constexpr std::size_t kMostAgents = 8;

  /// @param agents the dimensions of each of two to kMostAgents agents, matching one by one, all of them
  ///   across rows
  RowSymmetry(const UniformGrid& grid, const std::vector<std::vector<std::size_t>>& agents) {
    for (const std::vector<std::size_t>& dimensions : agents) {
      Agent& agent = agents_.emplace_back();
      agent.offsets.assign(1, 0);
      for (const std::size_t d : dimensions) {
        agent.dimensions.push_back({grid.row_stride(d), grid[d].count});
        add_dimension(agent);
      }
    }
  }

  [[nodiscard]] bool is_canonical(std::int64_t row) const {
    const Keys keys = keys_of(row);
    return std::is_sorted(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(agents_.size()));
  }

  /// The canonical one of its permuted rows; the row itself if it is canonical.
  [[nodiscard]] std::int64_t canonical_of(std::int64_t row) const {
    Keys keys = keys_of(row);
    const std::int64_t rest = row - offset_of(keys);
    std::sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(agents_.size()));
    return rest + offset_of(keys);
  }

  /// Whether a set has the same cells in all permuted rows.
  /// @param team may be null
  [[nodiscard]] bool keeps(const CellSet& set, ThreadTeam* team) const {
    std::atomic<bool> is_kept = true;
    for_each(team, set.rows(), 1024, [&](ThreadTeam::Range range, int) {
      for (std::int64_t row = range.begin; row < range.end && is_kept; ++row) {
        if (!std::ranges::equal(set.row(row), set.row(canonical_of(row)))) is_kept = false;
      }
    });
    return is_kept;
  }

  /// Calls `visit(row)` for all its permuted rows but the row itself.
  template <class Visit>
  void for_each_permuted(std::int64_t row, const Visit& visit) const {
    Keys keys = keys_of(row);
    const std::int64_t rest = row - offset_of(keys);
    const auto end = keys.begin() + static_cast<std::ptrdiff_t>(agents_.size());
    std::sort(keys.begin(), end);
    do {
      const std::int64_t permuted = rest + offset_of(keys);
      if (permuted != row) visit(permuted);
    } while (std::next_permutation(keys.begin(), end));
  }

 private:
  /// [agent] where it is: row-major over its dimensions.
  using Keys = std::array<std::uint32_t, kMostAgents>;
  struct Dimension {
    std::int64_t stride;  ///< in rows
    std::int64_t count;
  };
  struct Agent {
    std::vector<Dimension> dimensions;
    std::vector<std::int64_t> offsets;  ///< [key] in rows
  };

  static void add_dimension(Agent& agent) {
    std::vector<std::int64_t> offsets;
    for (const std::int64_t before : agent.offsets) {
      for (std::int64_t i = 0; i < agent.dimensions.back().count; ++i)
        offsets.push_back(before + i * agent.dimensions.back().stride);
    }
    agent.offsets = std::move(offsets);
  }

  /// The part of the number of a row that the agents' dimensions make up.
  [[nodiscard]] std::int64_t offset_of(const Keys& keys) const {
    std::int64_t offset = 0;
    for (std::size_t b = 0; b < agents_.size(); ++b) offset += agents_[b].offsets[keys[b]];
    return offset;
  }

  [[nodiscard]] Keys keys_of(std::int64_t row) const {
    Keys keys{};
    for (std::size_t b = 0; b < agents_.size(); ++b) {
      std::int64_t key = 0;
      for (const Dimension& dimension : agents_[b].dimensions)
        key = key * dimension.count + row / dimension.stride % dimension.count;
      keys[b] = static_cast<std::uint32_t>(key);
    }
    return keys;
  }

  std::vector<Agent> agents_;
};

}  // namespace coordreq
