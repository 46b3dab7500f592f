#include "ranks/cut_rows.hpp"

#include <algorithm>
#include <numeric>

namespace coordreq {

std::vector<std::int64_t> cut_rows(std::span<const std::int64_t> weights, std::int64_t block_rows,
                                   std::int64_t rows, int ranks) {
  const std::int64_t total = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
  const auto blocks = static_cast<std::int64_t>(weights.size());
  std::vector<std::int64_t> bounds = {0};
  std::int64_t block = 0;
  std::int64_t before = 0;
  for (int rank = 1; rank < ranks; ++rank) {
    // Up to the block that brings the sum nearest to this share.
    const auto share = static_cast<double>(total == 0 ? blocks : total) * rank / ranks;
    while (block < blocks) {
      const std::int64_t weight = total == 0 ? 1 : weights[static_cast<std::size_t>(block)];
      if (static_cast<double>(before) + static_cast<double>(weight) / 2 > share) break;
      before += weight;
      ++block;
    }
    bounds.push_back(std::min(block * block_rows, rows));
  }
  bounds.push_back(rows);
  return bounds;
}

}  // namespace coordreq
