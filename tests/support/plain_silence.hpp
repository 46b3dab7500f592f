#pragma once

#include <cstdint>
#include <vector>

#include "support/plain_engine.hpp"

namespace coordreq {

/// How long silence is safe for agents who do what they are told (contract, section 9), done the plain way on
/// the plain analysis of those who coordinate.
struct PlainSilence {
  struct Partition {
    std::vector<std::vector<bool>> actions;  ///< [cell][joint input] A(x)
    std::vector<std::int32_t> silence;       ///< [cells] -2, -1 as in the results file, INT32_MAX: unbounded
    std::vector<std::int64_t> sizes;
    std::int32_t fixed_point_index = -1;
    bool truncated = false;
  };
  std::vector<bool> terminal;           ///< counts as T, as PlainAnalysis has it
  std::vector<bool> set;                ///< K'
  std::vector<std::vector<bool>> then;  ///< [cell][joint input] C'(x); none without `then`
  std::vector<Partition> partitions;
};

/// REQUIRES: the spec has no memory, and states of the abstraction are in the order of the spec.
[[nodiscard]] PlainSilence told_silence_plainly(const ProblemSpec& spec, const Abstraction& abstraction,
                                                const std::vector<bool>& safe,
                                                const std::vector<bool>& safe_beyond,
                                                const PlainAnalysis& plain);

}  // namespace coordreq
