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
       .failing = "has a delay of {steps}"},
      {.kind = RequirementKind::invariant,
       .key = "invariant",
       .needs = "",
       .value = "delay",
       .is_upper_limit = false,
       .claim = "in the invariance set",
       .failing = "has a delay of {steps}"},
      {.kind = RequirementKind::max_arrival,
       .key = "max_arrival",
       .needs = "goal",
       .value = "arrival",
       .is_upper_limit = true,
       .claim = "in the goal after at most {steps}",
       .failing = "takes {steps} to the goal"},
      {.kind = RequirementKind::min_approach_delay,
       .key = "min_approach_delay",
       .needs = "goal",
       .value = "approach_delay",
       .is_upper_limit = false,
       .claim = "approach delay of {partition} at least {steps}",
       .failing = "has an approach delay of {steps}"},
      {.kind = RequirementKind::max_risk,
       .key = "max_risk",
       .needs = "risk",
       .value = "risk",
       .is_upper_limit = true,
       .claim = "risk at most {risk}",
       .failing = "has a risk of {risk}",
       .is_probability = true},
      {.kind = RequirementKind::min_blind_delay,
       .key = "min_blind_delay",
       .needs = "sees",
       .value = "blind_delay",
       .is_upper_limit = false,
       .claim = "blind delay of {partition} at least {steps}",
       .failing = "has a blind delay of {steps}"},
      {.kind = RequirementKind::min_silence,
       .key = "min_silence",
       .needs = "silence",
       .value = "silence",
       .is_upper_limit = false,
       .claim = "silence of {partition} at least {steps}",
       .failing = "has a silence of {steps}"},
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
