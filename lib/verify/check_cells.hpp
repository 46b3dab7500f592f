#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/check_context.hpp"
#include "base/thread_team.hpp"
#include "verify/budget.hpp"

namespace coordreq {

/// Shows one cell after the other to all checks.
/// @param cells ascending; empty: all
/// @param budget null: no matter what it takes; else blocks of cells from all over the grid until it is over
/// @param progress may be empty; called by the caller's thread
/// @returns how many were shown
std::int64_t check_cells(const CheckContext& context, const std::vector<std::unique_ptr<AnswerCheck>>& checks,
                         const std::vector<std::int64_t>& cells, Budget* budget,
                         const std::function<void(std::int64_t done, std::int64_t all)>& progress,
                         ThreadTeam& team);

}  // namespace coordreq
