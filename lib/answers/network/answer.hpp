#pragma once

#include <vector>

#include "answers/answers.hpp"
#include "answers/field_source.hpp"
#include "answers/memory_need.hpp"
#include "answers/network/network_safety.hpp"
#include "answers/stage.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"

namespace coordreq {

/// Adds NetworkSafety, if the spec has a network: "network".
[[nodiscard]] std::vector<Stage> network_stages(const ProblemSpec& spec);
/// Warns if the spec has a communication-loss rule and does not say whether the network uses it.
[[nodiscard]] Warnings advise_on_network(const Answers& answers);
[[nodiscard]] MemoryNeed network_memory(const EngineSizes& sizes, int threads);
void summarise_network(const Answers& answers, Json& summary, Json& work);
/// Fails if the numbers of safe cells are not as many as modes.
void examine_network(const ProblemSpec& spec, const FieldSource& source);
void tell_network(const ProblemSpec& spec, const FieldSource& source, Json& info);

}  // namespace coordreq
