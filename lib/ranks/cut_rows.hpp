#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace coordreq {

/// Cuts rows into runs of about equal weight. @param weights of blocks of `block_rows` rows each, the last
/// one perhaps shorter; cuts are between blocks. Without any weight blocks count
/// @returns ranks + 1 ascending numbers: where the runs begin, and `rows`. Runs may be empty
[[nodiscard]] std::vector<std::int64_t> cut_rows(std::span<const std::int64_t> weights,
                                                 std::int64_t block_rows, std::int64_t rows, int ranks);

}  // namespace coordreq
