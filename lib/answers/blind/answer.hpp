#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "answers/answer.hpp"
#include "answers/blind/silent_table.hpp"
#include "answers/countdown/delay_layers.hpp"

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

/// The class is one of several, and does not see all states.
[[nodiscard]] bool has_silent_table(const ProblemSpec& spec, const PartitionSpec& partition,
                                    std::size_t class_number);
/// B of a partition; Z if it has one class. @pre unchecked: the layers have been found
[[nodiscard]] const DelayLayers& blind_layers(const Answers& answers, std::size_t p);
/// B with the levels of blind delays; Z if the partition has one class.
[[nodiscard]] const DelayLayers& blind_delays(const Answers& answers, std::size_t p);

extern const Answer blind_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields blind_fields(const ProblemSpec& spec);
void fill_blind_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);
[[nodiscard]] std::vector<AnswerPolicy> blind_policies(const ProblemSpec& spec);
[[nodiscard]] Explained explain_blind(const ExplainContext& context);

}  // namespace coordreq
