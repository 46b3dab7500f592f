#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/check_context.hpp"
#include "spec/spec_types.hpp"

// The checks of answers by their definitions. They stand apart from what finds answers, which no check may
// include; each says at its definition, in check.cpp of its answer, what it checks and what it does not.
namespace coordreq {

/// Null if the spec does not ask for the answer.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_invariance(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_layers(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_goal(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_coalition(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_network(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_risk(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_convention(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_blind(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_silence(const CheckContext& context);
[[nodiscard]] std::unique_ptr<AnswerCheck> check_requirements(const CheckContext& context);

/// Bytes for each cell that a check keeps beside the values of the file.
[[nodiscard]] double network_check_memory(const ProblemSpec& spec);
[[nodiscard]] double risk_check_memory(const ProblemSpec& spec);
[[nodiscard]] double blind_check_memory(const ProblemSpec& spec);
[[nodiscard]] double silence_check_memory(const ProblemSpec& spec);
[[nodiscard]] double requirements_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
