#include "spec/requirement_kind.hpp"

#include <algorithm>

#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

const std::vector<RequirementTraits>& requirement_kinds() {
  static const std::vector<RequirementTraits> kinds = {
      {.kind = RequirementKind::min_delay,
       .key = "min_delay",
       .needs = "",
       .value = "delay",
       .is_upper_limit = false,
       .claim = "delay of {partition} at least {steps}",
       .failing = "has a delay of {steps}",
       .option = "--delay",
       .asks = "The silence to be tolerated: steps, or a time, e.g. 2s or 10min"},
      {.kind = RequirementKind::invariant,
       .key = "invariant",
       .needs = "",
       .value = "delay",
       .is_upper_limit = false,
       .claim = "in the invariance set",
       .failing = "has a delay of {steps}"},
      {.kind = RequirementKind::min_silence,
       .key = "min_silence",
       .needs = "silence",
       .value = "silence",
       .is_upper_limit = false,
       .claim = "silence of {partition} at least {steps}",
       .failing = "has a silence of {steps}",
       .option = "--silence",
       .asks = "The same by the communication-loss rule of the spec ('silence')"},
      {.kind = RequirementKind::min_blind_delay,
       .key = "min_blind_delay",
       .needs = "sees",
       .value = "blind_delay",
       .is_upper_limit = false,
       .claim = "blind delay of {partition} at least {steps}",
       .failing = "has a blind delay of {steps}",
       .option = "--blind",
       .asks = "The same for agents with their own observations only ('sees')"},
      {.kind = RequirementKind::min_approach_delay,
       .key = "min_approach_delay",
       .needs = "goal",
       .value = "approach_delay",
       .is_upper_limit = false,
       .claim = "approach delay of {partition} at least {steps}",
       .failing = "has an approach delay of {steps}",
       .option = "--approach",
       .asks = "The silence that costs no time on the way to the goal ('goal')"},
      {.kind = RequirementKind::max_arrival,
       .key = "max_arrival",
       .needs = "goal",
       .value = "arrival",
       .is_upper_limit = true,
       .claim = "in the goal after at most {steps}",
       .failing = "takes {steps} to the goal",
       .option = "--arrival",
       .asks = "The steps, or the time, within which the goal can be forced ('goal')"},
      {.kind = RequirementKind::max_risk,
       .key = "max_risk",
       .needs = "risk",
       .value = "risk",
       .is_upper_limit = true,
       .claim = "risk at most {risk}",
       .failing = "has a risk of {risk}",
       .option = "--risk",
       .asks = "The maximum probability of leaving the invariance set within the horizon ('risk')",
       .is_probability = true},
  };
  return kinds;
}

const RequirementTraits& traits(RequirementKind kind) {
  return requirement_kinds()[static_cast<std::size_t>(kind)];
}

RequirementDataset dataset_of(RequirementKind kind, const ProblemSpec& spec) {
  REQUIRES(kind != RequirementKind::invariant);
  const std::string path = "/" + traits(kind).value;
  if (kind != RequirementKind::max_risk || !spec.risk) return {path};
  if (spec.risk->is_drawn) return {path + "_drawn"};
  return {path, spec.risk->start};
}

std::string requirement_kind_name(RequirementKind kind) {
  return traits(kind).key;
}

const RequirementTraits& requirement_traits(const std::string& key) {
  const auto found = std::ranges::find(requirement_kinds(), key, &RequirementTraits::key);
  REQUIRES(found != requirement_kinds().end());
  return *found;
}

}  // namespace coordreq
