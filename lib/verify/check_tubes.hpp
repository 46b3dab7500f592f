#pragma once

#include <string>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"
#include "verify/analysis_tables.hpp"
#include "verify/budget.hpp"

namespace coordreq {

/// The ways between the samples that the checks of cells rest on.
struct CheckedTubes {
  std::vector<PostTable> tables;      ///< one a state: the tubes of the analysis
  std::vector<std::uint8_t> beyond;   ///< [cell]: safe for tubes that pass a limit where a state saturates
  bool exact = true;                  ///< no tube could be smaller
  std::vector<std::string> borrowed;  ///< states without tubes of the verifier's own
  std::vector<Finding> findings;
};

/// Takes the tubes of an abstraction and what is safe beyond its limits, which no results file stores, and
/// checks both by another route.
/// @param analysis of `spec`, with tubes
/// @param safe S as the file has it
[[nodiscard]] CheckedTubes check_tubes(const ProblemSpec& spec, const UniformGrid& grid,
                                       const InputSpace& inputs, AnalysisTables& analysis,
                                       const std::vector<std::uint8_t>& safe, Budget& budget,
                                       ThreadTeam& team);

}  // namespace coordreq
