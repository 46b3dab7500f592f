#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/check_context.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Checks blind delays and countdowns by the countdowns of the cells that can follow, B_1 by its definition,
/// and each row of a silent table as an intersection (contract, section 8). If only a sample of cells is
/// checked, rows are looked at for actions too many alone, and B_1 is not checked. Null if all agents see
/// everything.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_blind(const CheckContext& context);
/// Bytes a cell: the actions of each class there.
[[nodiscard]] double blind_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
