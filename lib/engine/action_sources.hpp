#pragma once

#include <cstdint>
#include <vector>

#include "engine/row_engine.hpp"

namespace coordreq {

/// A table that tells actions apart in a row: of slices, or of rows of pairs.
/// Entry = sum of state index * state_stride + input index * input_stride; equal ids mean equal contents.
struct ActionSource {
  const RowSlices* slices = nullptr;                ///< null: `ids` are those of a table of pairs
  const std::vector<std::uint32_t>* ids = nullptr;  ///< [entry]; null: every entry is its own number
  std::vector<std::int64_t> state_stride;
  std::vector<std::int64_t> input_stride;
  std::int64_t before = 0;           ///< entries before the first one held
  std::vector<std::int32_t> inputs;  ///< in use, ascending
  std::int64_t input_combinations = 1;

  /// Entries differ from one another in all rows.
  [[nodiscard]] bool all_distinct() const { return ids == nullptr; }
  [[nodiscard]] std::uint32_t id(std::int64_t entry) const {
    return all_distinct() ? static_cast<std::uint32_t>(entry) : (*ids)[static_cast<std::size_t>(entry)];
  }
  /// Where the entries of a row of the grid begin.
  [[nodiscard]] std::int64_t base(const RowPosition& position) const {
    return position.offset(state_stride) - before;
  }
};

[[nodiscard]] ActionSource source_of(const PairTable& pairs, const InputSpace& inputs);

/// The engine's slices in order (posts, then tubes), then `allow` if there is one. The sources refer to the
/// engine.
[[nodiscard]] std::vector<ActionSource> action_sources(const RowEngine& engine);

}  // namespace coordreq
