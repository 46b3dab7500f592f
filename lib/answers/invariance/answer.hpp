#pragma once

#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field_source.hpp"
#include "answers/invariance/controller.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/memory_need.hpp"
#include "answers/stage.hpp"
#include "base/json.hpp"

namespace coordreq {

/// The cells of K in which the task goes on, and C there: all of K but the cells of a goal that ends the
/// task, where agents choose nothing. Code that asks for the choices of agents asks for them in these cells.
struct GoingOn {
  CellSet cells;  ///< K \ G; not used, and empty, where no goal ends the task
  Controller controller;
};

/// Adds Invariance, with the Controller of its K, and GoingOn: "invariance".
[[nodiscard]] std::vector<Stage> invariance_stages(const ProblemSpec& spec);
/// The guarantee of a result of this spec: "samples", "samples-center" or "continuous" (contract, "What is
/// guaranteed"). Safety at centres proves nothing about tubes, so that it is never "continuous".
[[nodiscard]] std::string guarantee_of(const ProblemSpec& spec);
[[nodiscard]] MemoryNeed invariance_memory(const EngineSizes& sizes, int threads);
void summarise_invariance(const Answers& answers, Json& summary, Json& work);
void tell_invariance(const ProblemSpec& spec, const FieldSource& source, Json& info);

}  // namespace coordreq
