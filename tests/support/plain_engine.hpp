#pragma once

#include <cstdint>
#include <vector>

#include "engine/packed_pairs.hpp"
#include "reach/abstraction.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The analysis from S on done the plain way: one cell and one joint input at a time, straight from the
/// definitions of the contract. Slow and obviously right; what every fast path is compared with, bit for bit.
struct PlainAnalysis {
  struct Partition {
    std::vector<std::int32_t> delay;
    std::vector<std::int64_t> sizes;
    std::int32_t fixed_point_index = -1;
    bool truncated = false;
    /// [class][cell][joint action of the class]
    std::vector<std::vector<std::vector<bool>>> projection;
  };
  std::vector<bool> terminal;  ///< [cell] counts as T: of a goal that ends the task
  std::vector<bool> invariant;
  std::vector<std::int32_t> collision_time;
  std::int64_t iterations = 0;
  std::vector<std::vector<bool>> permitted;   ///< [cell][joint input] by `allow`, whatever is listed
  std::vector<std::vector<bool>> controller;  ///< [cell][joint input]
  std::vector<Partition> partitions;
  std::vector<std::vector<bool>> network;  ///< [mode][cell] W(q), if there is a network
};

/// @param listed the pairs of a controller file; null: there is none
/// @param safe_beyond what tubes that pass a limit where a state saturates must stay in, as S reads beyond it
/// @param terminal the cells of S in a goal that ends the task; empty: none does
[[nodiscard]] PlainAnalysis analyze_plainly(const ProblemSpec& spec, const Abstraction& abstraction,
                                            const std::vector<bool>& safe,
                                            const std::vector<bool>& safe_beyond,
                                            const PackedPairs* listed = nullptr,
                                            const std::vector<bool>& terminal = {});

/// What S lies between, in plain terms.
struct SafeBounds {
  std::vector<bool>
      natural;  ///< natural interval evaluation in rationals proves the cell: S has at least these
  std::vector<bool> sampled;  ///< no unsafe point among corners, centre and some more: S has at most these
};

[[nodiscard]] SafeBounds bound_safe_plainly(const ProblemSpec& spec, const UniformGrid& grid);

}  // namespace coordreq
