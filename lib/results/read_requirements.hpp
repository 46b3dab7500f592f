#pragma once

#include <string>
#include <vector>

#include "answers/requirements/result_requirement.hpp"
#include "results/results_file.hpp"

namespace coordreq {

/// `/counterexample`: nothing if the file has none. Shapes are checked, and that enumerated values, states
/// and inputs are ones that there are; whether paths are right is for a verification.
/// @param states, inputs their names
/// @throws ResultsError naming the dataset; hdf5::Failure
[[nodiscard]] std::vector<ResultRequirement> read_stored_requirements(const ResultsFile& file,
                                                                      const std::vector<std::string>& states,
                                                                      const std::vector<std::string>& inputs);

}  // namespace coordreq
