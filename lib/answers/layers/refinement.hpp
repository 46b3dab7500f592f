#pragma once

#include <cstddef>
#include <vector>

#include "spec/spec_types.hpp"

// The order of partitions by refinement. If each class of P lies in a class of Q, agents are less free to
// choose alone with Q: IND_C of Q is within that of P, and every layer of P within that of Q. So the delays
// of Q bound those of P from above, and need not be found again from K on (see find_layer_levels()).
namespace coordreq {

/// True if each class of `finer` lies in a class of `coarser`; a partition refines itself.
/// @pre unchecked: both are of the same agents
[[nodiscard]] bool refines(const PartitionSpec& finer, const PartitionSpec& coarser);

/// Indices of the partitions with fewer classes first, otherwise in their order: each comes after all that it
/// refines.
[[nodiscard]] std::vector<std::size_t> coarsest_first(const std::vector<PartitionSpec>& partitions);

/// Of the other partitions that partition p refines, those that no other of them refines: their bounds imply
/// those of the rest. Ascending indices.
[[nodiscard]] std::vector<std::size_t> next_coarser(const std::vector<PartitionSpec>& partitions,
                                                    std::size_t p);

}  // namespace coordreq
