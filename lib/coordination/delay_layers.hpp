#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "coordination/projections.hpp"
#include "safety/row_reach.hpp"

namespace coordreq {

/// The delay layers of one partition, contract "Layers".
struct DelayLayers {
  static constexpr std::int32_t kOutsideSafe = -2;
  static constexpr std::int32_t kOutsideInvariant = -1;
  static constexpr std::int32_t kUnbounded = INT32_MAX;

  std::vector<std::int32_t> delay;     ///< [cells]: largest k with x in Z_k, or one of the values above
  std::vector<std::int64_t> sizes;     ///< |Z_0|, |Z_1|, ..., |Z_F| (or as far as `max_delay` went)
  std::int32_t fixed_point_index = 0;  ///< F; -1 if truncated
  bool truncated =
      false;  ///< `max_delay` came first: the last layer's delays are lower bounds, none is unbounded
};

/// Z_0 = K, Z_{k+1} = SIPRE_S(Z_k) (paper, Proposition 1), with IND_C given by its projections.
/// An empty layer is a fixed point also where `max_delay` stops at it.
/// @param stepped told after each layer (its number, cells left); may be empty
[[nodiscard]] DelayLayers find_delay_layers(const RowEngine& engine, const RowReach& reach,
                                            const CellSet& safe, const CellSet& invariant,
                                            const Projections& projections,
                                            std::optional<std::int64_t> max_delay,
                                            const std::function<void(std::int64_t, std::int64_t)>& stepped,
                                            ThreadTeam& team);

}  // namespace coordreq
