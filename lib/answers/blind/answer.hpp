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

/// How long the classes of a partition can be silent if they see only themselves (contract, section 8).
struct BlindPartition {
  DelayLayers layers;               ///< B: its delays are the countdowns
  DelayLayers delays;               ///< B, with the levels of find_blind_delays()
  std::int64_t greatest = 0;        ///< the greatest finite delay of find_blind_delays()
  std::int64_t as_much = 0;         ///< cells of K whose blind delay is that of agents who see everything
  std::vector<SilentTable> tables;  ///< [class] empty for a class that sees all states
  /// The tables have Q^k for k up to this, which serves all greater k.
  [[nodiscard]] std::int64_t table_steps() const;
};
struct Blind {
  /// In the order of the spec. Empty for a partition of one class, whose delays are those of Z.
  std::vector<BlindPartition> partitions;
};

/// Adds Blind, if some agent does not see all states: for each partition of several classes "blind layers
/// PARTITION", then "blind delays PARTITION".
[[nodiscard]] std::vector<Stage> blind_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed blind_memory(const EngineSizes& sizes, int threads);
void summarise_blind(const Answers& answers, Json& summary, Json& work);
void tell_blind(const ProblemSpec& spec, const FieldSource& source, Json& info);
/// Warns that other answers are about agents who see everything.
[[nodiscard]] Warnings advise_on_blind(const Answers& answers);

}  // namespace coordreq
