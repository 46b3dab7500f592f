#pragma once

#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/coalition/coalition_map.hpp"
#include "answers/field_source.hpp"
#include "answers/memory_need.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"

namespace coordreq {

/// "first+second".
[[nodiscard]] std::string pair_name(const ProblemSpec& spec, const AgentPair& pair);

/// Adds CoalitionMap, if the spec has a horizon: "coalitions".
[[nodiscard]] std::vector<Stage> coalition_stages(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed coalition_memory(const EngineSizes& sizes, int threads);
void summarise_coalition(const Answers& answers, Json& summary, Json& work);
void tell_coalition(const ProblemSpec& spec, const FieldSource& source, Json& info);

}  // namespace coordreq
