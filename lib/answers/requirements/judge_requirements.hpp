#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/requirements/result_requirement.hpp"

namespace coordreq {

/// @throws SpecError naming the first requirement whose region meets no cell
void check_regions(const ProblemSpec& spec, ThreadTeam& team);

/// The verdict on each requirement of the spec: it holds if all cells that may meet its region do what it
/// asks and the region cannot reach beyond an unsafe side of the domain. With it the worst cell's way out of
/// the safe set, if a cell fails.
[[nodiscard]] std::vector<ResultRequirement> judge_requirements(const Answers& answers, ThreadTeam& team);

}  // namespace coordreq
