#pragma once

#include <cstdint>
#include <vector>

#include "safety/row_engine.hpp"

namespace coordreq {

/// What tells actions apart in a row, seen alike: a table of slices, or the rows of `allow`.
/// Entry = sum of state index * state_stride + input index * input_stride; equal numbers mean equal contents.
struct ActionSource {
  const std::vector<std::uint32_t>* shared_ids = nullptr;  ///< of a table of slices
  std::vector<std::uint32_t> own_ids;                      ///< of `allow`
  std::vector<std::int64_t> state_stride;
  std::vector<std::int64_t> input_stride;
  std::vector<std::int32_t> inputs;  ///< in use, ascending
  std::int64_t input_combinations = 1;

  [[nodiscard]] const std::vector<std::uint32_t>& ids() const { return shared_ids ? *shared_ids : own_ids; }
  /// Where the entries of a row of the grid begin.
  [[nodiscard]] std::int64_t base(const RowPlace& place) const { return place.offset(state_stride); }
};

/// The engine's slices in order (posts, then tubes), then `allow` if there is one. They refer to the engine.
[[nodiscard]] std::vector<ActionSource> action_sources(const RowEngine& engine);

}  // namespace coordreq
