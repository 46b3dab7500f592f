#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field_source.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/memory_need.hpp"
#include "answers/stage.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"

namespace coordreq {

/// What is known of a partition whose agents do what they are told while they are silent.
struct SilencePartition {
  DelayLayers layers;  ///< L: its delays are the silence
  std::vector<std::int64_t>
      lacking;  ///< [agent] of the cells of K' in which A is empty, those it is named for
};

/// How long silence is safe if agents do what the spec tells them (contract, section 9).
struct Silence {
  /// [cells] when `then` for ever leaves S: 0 outside S, i where i steps of it do, LevelMap::kTop in K'.
  LevelMap lost;
  CellSet set;             ///< K' if there is `then`, in the rows held; else it is K
  std::int64_t cells = 0;  ///< |K'| likewise
  WaveCounts counts;
  /// In the order of the spec; one for all where every agent has a rule.
  std::vector<SilencePartition> partitions;
};

/// Adds Silence, if the spec says what silent agents do: "silence set" if there is `then`, then "silence" or,
/// where that depends on the partition, "silence PARTITION" for each.
[[nodiscard]] std::vector<Stage> silence_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed silence_memory(const EngineSizes& sizes, int threads);
void summarise_silence(const Answers& answers, Json& summary, Json& work);
/// Fails where an F is no layer.
void tell_silence(const ProblemSpec& spec, const FieldSource& source, Json& info);
/// Cells in which silent agents have nothing that they may do.
[[nodiscard]] Warnings advise_on_silence(const Answers& answers);

/// Of a partition. @pre unchecked: it has been found
[[nodiscard]] const SilencePartition& silence_of(const Answers& answers, std::size_t p);
/// K'. @pre unchecked: it has been found
[[nodiscard]] const CellSet& silence_set(const Answers& answers);

}  // namespace coordreq
