#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"

namespace coordreq {

/// "abstraction" and "safe set": Answers::context.
/// @throws SpecError for errors that show only when the system is built
[[nodiscard]] std::vector<Stage> context_stages(const ProblemSpec& spec);
void summarise_context(const Answers& answers, Json& summary, Json& work);

}  // namespace coordreq
