#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/requirements/result_requirement.hpp"

namespace coordreq {

/// @throws SpecError naming the first requirement whose region meets no cell
void check_regions(const ProblemSpec& spec, ThreadTeam& team);

/// The verdict on each requirement of the spec: it holds if all cells that may meet its region fulfil it and
/// the region cannot reach beyond an unsafe side of the domain. If a cell fails, with the escape of the worst
/// cell.
[[nodiscard]] std::vector<ResultRequirement> judge_requirements(const Answers& answers, ThreadTeam& team);

}  // namespace coordreq
