#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks the verdicts on requirements: regions by an evaluation of their own, verdicts from the delays in
/// the file, counterexamples step by step. A cell of which it stays open whether it meets the region counts
/// as not checked where that decides. Verdicts are about the whole file, whichever cells are checked.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_requirements(const CheckGround& ground);

/// What is found about a region.
[[nodiscard]] double requirements_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
