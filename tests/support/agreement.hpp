#pragma once

#include <rapidcheck.h>

#include <cstdint>
#include <vector>

#include "answers/invariance/safe_set.hpp"
#include "choices/action_bits.hpp"
#include "support/fast_engine.hpp"
#include "support/members.hpp"
#include "support/plain_engine.hpp"

// What it means that the fast engine and the plain one agree, inside a RapidCheck property.
namespace coordreq {

/// The packed bits of the fast path as plain sets.
inline std::vector<std::vector<bool>> unpacked(const FastAnalysis& fast, const ActionGrouping& grouping,
                                               std::size_t c) {
  const auto actions = static_cast<std::size_t>(grouping[c].actions());
  const auto bytes = static_cast<std::size_t>(grouping[c].bytes());
  const auto packed = action_bits(fast.controller, grouping, c, 0, fast.engine.rows());
  std::vector<std::vector<bool>> result;
  for (std::size_t x = 0; x < packed.size() / bytes; ++x) {
    std::vector<bool>& set = result.emplace_back();
    for (std::size_t a = 0; a < actions; ++a) set.push_back((packed[x * bytes + a / 8] >> (a % 8) & 1) != 0);
  }
  return result;
}

inline PlainAnalysis plainly(const ProblemSpec& spec, const FastAnalysis& fast,
                             const PackedPairs* listed = nullptr) {
  const std::vector<bool> safe = members(fast.safe);
  std::vector<bool> terminal;
  if (spec.ends_at_goal()) {
    ThreadTeam team(1);
    terminal =
        members(cells_that_satisfy(*spec.goal, spec, fast.abstraction.grid, fast.abstraction.inputs, team));
    for (std::size_t x = 0; x < terminal.size(); ++x) terminal[x] = terminal[x] && safe[x];
  }
  return analyze_plainly(spec, fast.abstraction, safe, members(fast.beyond.value_or(fast.safe)), listed,
                         terminal);
}

inline void expect_agreement(const FastAnalysis& fast, const PlainAnalysis& plain, ThreadTeam& team) {
  RC_ASSERT(fast.invariance.iterations == plain.iterations);
  RC_ASSERT(members(fast.invariance.invariant) == plain.invariant);
  RC_ASSERT(fast.collision_times() == plain.collision_time);
  for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
    const PlainAnalysis::Partition& expected = plain.partitions[p];
    RC_ASSERT(fast.layers[p].sizes == expected.sizes);
    RC_ASSERT(fast.layers[p].fixed_point_index == expected.fixed_point_index);
    RC_ASSERT(fast.layers[p].truncated == expected.truncated);
    RC_ASSERT(fast.delays(p) == expected.delay);
    for (std::size_t c = 0; c < expected.projection.size(); ++c) {
      RC_ASSERT(unpacked(fast, fast.actions[p].grouping, c) == expected.projection[c]);
    }
  }
  const InputClass all = whole_class(fast.abstraction.inputs);
  RC_ASSERT(unpacked(fast, ActionGrouping(fast.engine, {all}, team), 0) == plain.controller);
}

}  // namespace coordreq
