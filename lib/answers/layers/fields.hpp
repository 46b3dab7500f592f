#pragma once

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace paths {

[[nodiscard]] std::string layers(const PartitionSpec& partition);
[[nodiscard]] std::string actions(const ProblemSpec& spec, const PartitionSpec& partition,
                                  std::size_t class_number);

}  // namespace paths

/// Delays and triggers of all partitions, sizes of layers, F; on request the layers' cells, and the
/// admissible actions of each class.
[[nodiscard]] Fields layer_fields(const ProblemSpec& spec);

/// What was found for them. The arrays refer to the answers, which must outlive the writing.
void fill_layer_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq
