#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks the coalitions in a file against its delays, which check_layers() checks: for each cell the
/// partitions whose delay reaches the horizon are compared by the cost of their cheapest network (Kruskal's
/// algorithm), then by their largest class and name, and each pair of agents is looked for in all partitions
/// of least cost. Also checks the sizes in the file.
/// @returns null: the spec has no horizon
[[nodiscard]] std::unique_ptr<AnswerCheck> check_coalition(const CheckContext& context);

}  // namespace coordreq
