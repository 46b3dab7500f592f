#pragma once

#include <vector>

#include "answers/stage.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// All stages of the analysis of a spec, in order: what can be refused at once, "controller" if there is a
/// file with one, the context, and each answer that the spec asks for. Checkpoints, progress, timings and
/// tests all use these.
[[nodiscard]] std::vector<Stage> analysis_stages(const ProblemSpec& spec);

}  // namespace coordreq
