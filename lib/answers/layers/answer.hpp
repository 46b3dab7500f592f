#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answers/answer.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "choices/projections.hpp"

namespace coordreq {

/// The layers of all partitions.
struct PartitionLayers {
  std::vector<DelayLayers> partitions;  ///< in the order of the spec
};

/// The actions of the classes of a partition, each by itself. Kept only while its layers are found: for many
/// partitions together they would take more memory than everything else.
struct PartitionActions {
  /// @pre unchecked: K is known. @param p number of the partition
  PartitionActions(const Answers& answers, std::size_t p, ThreadTeam& team);
  PartitionActions(const PartitionActions&) = delete;
  PartitionActions& operator=(const PartitionActions&) = delete;

  ActionGrouping grouping;
  std::optional<RowSymmetry> symmetry;
  Projections projections;  ///< of canonical rows alone, if there is a symmetry
};

extern const Answer layers_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields layer_fields(const ProblemSpec& spec);
void fill_layer_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);
[[nodiscard]] std::vector<AnswerPolicy> layer_policies(const ProblemSpec& spec);

}  // namespace coordreq
