#include "answers/layers/refinement.hpp"

#include <algorithm>
#include <numeric>

#include "spec/coordination_spec.hpp"

namespace coordreq {

bool refines(const PartitionSpec& finer, const PartitionSpec& coarser) {
  // Agents are ascending in a class, and every agent is in one, so a class can be looked for by its first.
  return std::all_of(finer.classes.begin(), finer.classes.end(), [&](const auto& agents) {
    return std::any_of(coarser.classes.begin(), coarser.classes.end(), [&](const auto& other) {
      return std::includes(other.begin(), other.end(), agents.begin(), agents.end());
    });
  });
}

std::vector<std::size_t> coarsest_first(const std::vector<PartitionSpec>& partitions) {
  std::vector<std::size_t> order(partitions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return partitions[a].classes.size() < partitions[b].classes.size();
  });
  return order;
}

std::vector<std::size_t> next_coarser(const std::vector<PartitionSpec>& partitions, std::size_t p) {
  std::vector<std::size_t> coarser;
  for (std::size_t q = 0; q < partitions.size(); ++q) {
    if (q != p && refines(partitions[p], partitions[q])) coarser.push_back(q);
  }
  std::vector<std::size_t> result;
  for (const std::size_t q : coarser) {
    const bool is_last = std::none_of(coarser.begin(), coarser.end(), [&](std::size_t other) {
      return other != q && refines(partitions[other], partitions[q]);
    });
    if (is_last) result.push_back(q);
  }
  return result;
}

}  // namespace coordreq
