#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"

namespace coordreq {

/// "abstraction" and "safe set": Answers::ground.
/// @throws SpecError for errors that show only when the system is built
[[nodiscard]] std::vector<Stage> ground_stages(const ProblemSpec& spec);
void summarise_ground(const Answers& answers, Json& summary, Json& work);

}  // namespace coordreq
