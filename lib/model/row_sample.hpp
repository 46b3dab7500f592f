#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/table_shape.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Lanes of a row along several dimensions, at the most; at a byte each a quarter of 32 KiB, a usual
/// first-level cache.
inline constexpr std::int64_t kMostJoinedLanes = 8192;

/// The number of rows if they run along some states, and of different rows in a sample of them.
struct RowSample {
  std::int64_t rows = 0;
  std::int64_t lanes = 0;      ///< cells of a row
  std::int64_t drawn = 0;      ///< rows of the sample, less than `rows` or all
  std::int64_t different = 0;  ///< of these: in S at the lanes that were looked at, or in what tables say
  [[nodiscard]] bool operator==(const RowSample&) const = default;
};

/// Draws rows along the states `along`, the same ones in every call. What a table says of a row is
/// taken to differ with every state across rows on which it depends otherwise than by an offset.
/// @param most no more rows are looked at once more than so many are different
/// @pre `along` are some of the states, or all of them
[[nodiscard]] RowSample sample_rows(const ProblemSpec& spec, const std::vector<TableShape>& shapes,
                                    const std::vector<std::size_t>& along, std::int64_t most = INT64_MAX);

/// The states that rows are best taken along, the fastest last: those for which few rows are different, as it
/// is where states that only meet in a difference are on different sides (x1 and x2 across, y1 and y2 along).
/// Only states that move by offsets and that no other depends on can be taken together (join_rows()).
/// @param order the order that would be taken otherwise, whose last state stays the last
/// @returns nothing where another choice does not promise a fourth of the work
[[nodiscard]] std::optional<std::vector<std::size_t>> find_similar_rows(
    const ProblemSpec& spec, const std::vector<TableShape>& shapes, const std::vector<std::size_t>& order);

}  // namespace coordreq
