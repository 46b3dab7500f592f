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

/// The silence of a partition whose agents act by rules while they are silent.
struct SilencePartition {
  DelayLayers layers;  ///< L: its delays are the silence
  std::vector<std::int64_t>
      lacking;  ///< [agent] number of cells of K' in which A is empty, by the agent named for it
};

/// How long silence is safe if agents act by the rules of the spec (contract, section 9).
struct Silence {
  /// [cells]: number of steps after which `then` can leave S: 0 outside S, LevelMap::kTop in K'.
  LevelMap lost;
  CellSet set;             ///< K' if there is `then`, in the rows held; else not used, K' is K
  std::int64_t cells = 0;  ///< |K'|
  WaveCounts counts;
  /// In the order of the spec; one for all partitions if every agent has a rule.
  std::vector<SilencePartition> partitions;
};

/// Adds Silence, if the spec says what silent agents do: "silence set" if there is `then`, then "silence" or,
/// if silence depends on the partition, "silence PARTITION" for each.
[[nodiscard]] std::vector<Stage> silence_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed silence_memory(const EngineSizes& sizes, int threads);
void summarise_silence(const Answers& answers, Json& summary, Json& work);
/// Fails if an F is no layer.
void tell_silence(const ProblemSpec& spec, const FieldSource& source, Json& info);
/// Warns of cells in which silent agents have no action.
[[nodiscard]] Warnings advise_on_silence(const Answers& answers);

/// The silence of a partition. @pre unchecked: it has been found
[[nodiscard]] const SilencePartition& silence_of(const Answers& answers, std::size_t p);
/// K'. @pre unchecked: K' has been found
[[nodiscard]] const CellSet& silence_set(const Answers& answers);

}  // namespace coordreq
