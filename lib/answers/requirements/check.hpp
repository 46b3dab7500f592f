#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks the verdicts on requirements: regions by an evaluation of its own, verdicts from the delays in the
/// file, counterexamples step by step. If it stays open whether a cell meets the region, and the verdict
/// depends on the cell, the verdict counts as not confirmed. Verdicts are about the whole file, whichever
/// cells are sampled.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_requirements(const CheckContext& context);

/// Bytes a cell: whether the cell meets a region.
[[nodiscard]] double requirements_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
