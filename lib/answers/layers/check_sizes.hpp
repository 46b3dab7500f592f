#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/claims.hpp"
#include "answers/checking/comparison.hpp"
#include "answers/countdown/kinds.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The claims of a file about the countdown of one partition. @pre unchecked: the claims outlive it.
struct PartitionClaims {
  /// @param root of the paths of stored actions
  PartitionClaims(const ProblemSpec& spec, const Claims& claims, std::size_t p,
                  const CountdownKind& countdown, const std::string& root = "/actions");

  const CountdownKind& kind;
  const PartitionSpec& partition;
  const std::vector<std::int32_t>& delay;  ///< the steps by which cells are in layers
  std::int64_t fixed_point_index;          ///< F; negative: unknown because max_delay stopped the iteration
  std::optional<std::int32_t> most = {};   ///< max_delay, if it has stopped the iteration: no steps are more
  std::vector<std::int64_t> layer_sizes;   ///< the whole row of the file
  std::vector<const std::vector<std::uint8_t>*> actions;  ///< [class]; empty if actions are not stored
};

/// Compares F, whether max_delay stopped the iteration, layer sizes and layer lists of a partition with the
/// delays of the cells.
/// @param longest the most layers of any partition so far
[[nodiscard]] Finding compare_layers(const ProblemSpec& spec, const Claims& claims,
                                     const PartitionClaims& partition, std::size_t& longest);

}  // namespace coordreq
