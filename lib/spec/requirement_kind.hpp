#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spec/spec_types.hpp"

namespace coordreq {

/// Properties of all requirements of a kind.
struct RequirementTraits {
  RequirementKind kind;
  std::string key;  ///< of the spec that stands for it
  /// A key at the top of the spec without which it cannot be, or "sees" of agents; empty: none.
  std::string needs;
  std::string value;    ///< what states are judged by: "delay", "arrival"
  bool is_upper_limit;  ///< at most so many steps; else at least
  // In words; {steps} stands for the steps, {partition} for the name of the partition, {risk} for a risk.
  std::string claim;    ///< what is required of each cell: "delay of {partition} at least {steps}"
  std::string failing;  ///< what is the matter with one: "has a delay of {steps}"
  // Of `require`, which searches for states that meet it; null: it does not.
  const char* option = nullptr;  ///< that takes the limit: "--delay"
  const char* asks = nullptr;    ///< its description
  bool is_probability = false;   ///< instead of steps

  /// The key of the worst value: "least_delay", "longest_arrival", "greatest_risk".
  [[nodiscard]] std::string worst() const {
    return (is_probability ? "greatest_" : is_upper_limit ? "longest_" : "least_") + value;
  }
};
/// By number of the kind.
[[nodiscard]] const std::vector<RequirementTraits>& requirement_kinds();
[[nodiscard]] const RequirementTraits& traits(RequirementKind kind);
/// The dataset of a kind of requirement, and the entry of its leading axis that counts, if it has one that is
/// not of partitions: of risks the mode of the first step, or that this mode is drawn.
/// @pre not `invariant`
struct RequirementDataset {
  std::string path;
  std::size_t entry = 0;
};
[[nodiscard]] RequirementDataset dataset_of(RequirementKind kind, const ProblemSpec& spec);
/// @pre it is one
[[nodiscard]] const RequirementTraits& requirement_traits(const std::string& key);

}  // namespace coordreq
