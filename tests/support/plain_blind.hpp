#pragma once

#include <cstdint>
#include <vector>

#include "support/plain_engine.hpp"

namespace coordreq {

/// Blind silence (contract, section 8) done the plain way, on the plain analysis of agents who see
/// everything.
struct PlainBlind {
  struct Partition {
    std::vector<std::int32_t> delay;      ///< [cell] -2, -1 as in the results file, INT32_MAX: unbounded
    std::vector<std::int32_t> countdown;  ///< likewise
    std::vector<std::int64_t> sizes;
    std::int32_t fixed_point_index = -1;
    bool truncated = false;
    /// [class][k - 1][fibre][action] Q^k for k = 1, ..., max(1, F), or as far as `max_delay` goes; all false
    /// where the fibre does not meet B_k, or there is none.
    std::vector<std::vector<std::vector<std::vector<bool>>>> silent;
  };
  std::vector<Partition> partitions;
};

/// REQUIRES: the spec has no memory, and states of the abstraction are in the order of the spec.
[[nodiscard]] PlainBlind silence_plainly(const ProblemSpec& spec, const Abstraction& abstraction,
                                         const std::vector<bool>& safe, const std::vector<bool>& safe_beyond,
                                         const PlainAnalysis& plain);

/// What the agents of a class see: the number of the fibre of a cell, row-major over the states that one of
/// them sees; and how many fibres there are.
struct PlainSight {
  PlainSight(const ProblemSpec& spec, const UniformGrid& grid, const std::vector<std::int32_t>& agents);
  [[nodiscard]] std::size_t fibre(std::int64_t cell) const;
  [[nodiscard]] bool sees_all() const { return seen_.size() == grid_.size(); }
  std::size_t fibres = 1;

 private:
  const UniformGrid& grid_;
  std::vector<std::size_t> seen_;
};

}  // namespace coordreq
