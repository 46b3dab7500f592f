#pragma once

#include <vector>

#include "base/thread_team.hpp"
#include "verify/check_cells.hpp"

namespace coordreq {

/// Checks the verdicts on requirements: regions by an evaluation of their own, verdicts from the delays in
/// the file, counterexamples step by step. A cell of which it stays open whether it meets the region counts
/// as not checked where that decides.
/// @param check `cells` does not matter: verdicts are about the whole file
[[nodiscard]] std::vector<Finding> check_requirements(const CellCheck& check, ThreadTeam& team);

}  // namespace coordreq
