#pragma once

#include "model/model.hpp"

namespace coordreq {

/// The problem made ready. @pre unchecked: `spec` outlives it. @throws SpecError as table_shapes()
[[nodiscard]] Model make_model(const ProblemSpec& spec);

}  // namespace coordreq
