#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "answers/answer.hpp"
#include "answers/countdown/delay_layers.hpp"

namespace coordreq {

/// The silence of a partition whose agents act by rules while they are silent.
struct SilencePartition {
  DelayLayers layers;  ///< L: its delays are the silence
  std::vector<std::int64_t>
      without_action;  ///< [agent] number of cells of K' in which A is empty, by the agent named for it
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

/// The silence of a partition. @pre unchecked: it has been found
[[nodiscard]] const SilencePartition& silence_of(const Answers& answers, std::size_t p);
/// K'. @pre unchecked: K' has been found
[[nodiscard]] const CellSet& silence_set(const Answers& answers);

extern const Answer silence_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields silence_fields(const ProblemSpec& spec);
void fill_silence_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);
[[nodiscard]] std::vector<AnswerPolicy> silence_policies(const ProblemSpec& spec);

}  // namespace coordreq
