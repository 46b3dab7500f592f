#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "answers/answers.hpp"
#include "answers/blind/silent_table.hpp"
#include "answers/field_source.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/memory_need.hpp"
#include "answers/stage.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"

namespace coordreq {

/// How long a partition can be silent if its classes see only themselves (contract, section 8).
struct BlindPartition {
  DelayLayers layers;               ///< B: its delays are the countdowns
  DelayLayers delays;               ///< the same, with the levels of find_blind_delays()
  std::int64_t greatest = 0;        ///< the greatest of these delays that is finite
  std::int64_t as_much = 0;         ///< cells of K where they are those of agents who see everything
  std::vector<SilentTable> tables;  ///< [class] none of one that sees all states
  /// Q^k is told for k up to this; it serves all greater k.
  [[nodiscard]] std::int64_t table_steps() const;
};
struct Blind {
  /// In the order of the spec. Of a partition of one class nothing is kept: its delays are those of Z.
  std::vector<BlindPartition> partitions;
};

/// Adds Blind, if some agent does not see all states: for each partition of several classes "blind layers
/// PARTITION", then "blind delays PARTITION".
[[nodiscard]] std::vector<Stage> blind_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed blind_memory(const EngineSizes& sizes, int threads);
void summarise_blind(const Answers& answers, Json& summary, Json& work);
void tell_blind(const ProblemSpec& spec, const FieldSource& source, Json& info);
/// Other answers still speak of agents who see everything.
[[nodiscard]] Warnings advise_on_blind(const Answers& answers);

}  // namespace coordreq
