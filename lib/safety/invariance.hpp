#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/thread_team.hpp"
#include "bitset/cell_set.hpp"
#include "safety/action_groups.hpp"
#include "safety/row_reach.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The invariance set K and when each cell was lost, contract "Controller".
struct Invariance {
  static constexpr std::int32_t kNever = INT32_MAX;

  CellSet invariant;
  std::vector<std::int32_t>
      collision_time;           ///< [cells]: 0 outside S, i if the i-th sweep removed it, kNever in K
  std::int64_t iterations = 0;  ///< sweeps, the confirming last one included
};

/// K: for `maximal` the greatest K with K = {x in K n S : some allowed u has empty != f(x,u) subset of K};
/// for `given` the limit of SPRE_S^i(X) of the paper, C(x) being all that `allow` permits.
/// @param stepped told after each sweep (number, cells left); may be empty
[[nodiscard]] Invariance find_invariance(const RowEngine& engine, const RowReach& reach, const CellSet& safe,
                                         Synthesis synthesis,
                                         const std::function<void(std::int64_t, std::int64_t)>& stepped,
                                         ThreadTeam& team);

/// Calls `visit(position)` for every set bit.
template <class Visit>
void for_each_bit(ConstRow row, const Visit& visit) {
  for (std::size_t w = 0; w < row.size(); ++w) {
    for (Word word = row[w]; word != 0; word &= word - 1) {
      visit(static_cast<std::int64_t>(w) * CellSet::kWordBits + std::countr_zero(word));
    }
  }
}

}  // namespace coordreq
