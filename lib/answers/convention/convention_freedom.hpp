#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/zeroed_array.hpp"
#include "choices/controller.hpp"
#include "engine/action_groups.hpp"
#include "engine/tiles.hpp"

namespace coordreq {

/// The cost of a convention (see convention_at()): for each agent and cell of K the fraction of its
/// admissible actions that it keeps, |P_i(x)| / |projection of C(x) on agent i|, in (0, 1].
struct ConventionFreedom {
  struct Agent {
    ZeroedArray<float> freedom;  ///< [cells of the engine's grid, row-major]; NaN outside K
    double mean = 0;             ///< over K; 0 if K is empty
    std::int64_t full = 0;       ///< cells in which the agent keeps all actions
    /// Cells with freedom in (k / 10, (k + 1) / 10].
    std::array<std::int64_t, 10> histogram{};
  };
  std::vector<Agent> agents;
};

/// @param agents the actions of each agent as a class of its own, in the order of the spec
/// @param tiles in which equal work is found; null: it is not looked for. @pre null unless posts must stay in
///   controller.invariant itself Cost: for each row of cells the choices of one group of actions an agent,
///   times agents^2.
[[nodiscard]] ConventionFreedom find_convention(const Controller& controller, const ActionGrouping& agents,
                                                ThreadTeam& team, const Tiles* tiles = nullptr);

/// P_i(x) of agent `agent`, packed as action_bits(): fills elements [begin, begin + count) of uint8 [cells,
/// ceil(m / 8)] in the order of the engine's grid.
void fill_convention_bits(const Controller& controller, const ActionGrouping& agents, std::size_t agent,
                          std::uint64_t begin, std::uint64_t count, void* out);

}  // namespace coordreq
