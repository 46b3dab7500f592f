#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/check_ground.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Blind delays and countdowns by what the countdowns of the cells that can follow say, B_1 by its
/// definition, and each row of a silent table as the intersection that it is (contract, section 8). Of a
/// sample of cells rows are only looked at for actions too many, and B_1 is not. Null if all agents see
/// everything.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_blind(const CheckGround& ground);
/// Bytes a cell: the actions of each class there.
[[nodiscard]] double blind_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
