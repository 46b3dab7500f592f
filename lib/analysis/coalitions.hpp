#pragma once

#include <optional>

#include "analysis/analyze.hpp"
#include "analysis/solution.hpp"
#include "answers/coalition/coalition_map.hpp"
#include "results/result_content.hpp"

// What a solution says about who must talk to whom, if its spec has a horizon.
namespace coordreq {

/// Enters the stage "coalitions" if there is a horizon.
[[nodiscard]] std::optional<CoalitionMap> coalitions_of(const Solution& solution, ThreadTeam& team,
                                                        const EnterStage& enter);

[[nodiscard]] CoalitionSummary summary_of(const CoalitionMap& map, const ProblemSpec& spec);

/// Adds `/coalition` and, where there is more than one agent, `/critical_pair` with its axis `/pair`. The
/// arrays refer to the map and to the solution, which must outlive the writing.
void add_coalitions(const CoalitionMap& map, const Solution& solution, ResultContent& content);

}  // namespace coordreq
