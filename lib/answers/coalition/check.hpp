#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks what a file says about coalitions against the delays that it claims, which check_layers() looks
/// after: for each cell all partitions are gone through, those whose delay reaches the horizon are compared
/// by the cost of their cheapest network (Kruskal's algorithm), then by their largest class and name, and
/// each pair of agents is looked for in all that cost least. Also the sizes that the file counts.
/// @returns null: the spec has no horizon
[[nodiscard]] std::unique_ptr<AnswerCheck> check_coalition(const CheckGround& ground);

}  // namespace coordreq
