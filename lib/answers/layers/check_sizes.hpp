#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/checking/claims.hpp"
#include "answers/checking/comparison.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// A kind of layers: its paths in the file, and its names.
struct LayersMeant {
  std::string delay = "/delay", trigger = "/trigger", prefix = "/";
  std::string words = "layers";
  char letter = 'Z';
};
/// The layers of agents who see only themselves, with countdowns for delays.
[[nodiscard]] LayersMeant blind_layers_meant();
/// The layers of agents who act by rules, with silence for delays.
[[nodiscard]] LayersMeant silence_layers_meant();

/// The claims of a file about one partition. @pre unchecked: the claims outlive it.
struct PartitionClaims {
  PartitionClaims(const ProblemSpec& spec, const Claims& claims, std::size_t p, LayersMeant layers = {});

  LayersMeant meant;
  const PartitionSpec& partition;
  const std::vector<std::int32_t>& delay;
  const std::vector<std::int32_t>& trigger;
  std::int64_t fixed_point_index;         ///< F; negative: unknown because max_delay stopped the iteration
  std::vector<std::int64_t> layer_sizes;  ///< the whole row of the file
  std::vector<const std::vector<std::uint8_t>*> actions;  ///< [class]; empty if actions are not stored
};

/// Compares F, whether max_delay stopped the iteration, layer sizes and layer lists of a partition with the
/// delays of the cells.
/// @param longest the most layers of any partition so far
[[nodiscard]] Finding compare_layers(const ProblemSpec& spec, const Claims& claims,
                                     const PartitionClaims& partition, std::size_t& longest);

}  // namespace coordreq
