#pragma once

#include <string>

#include "answers/analysis_context.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Where `controller.file` leads: a relative path starts in the folder of the spec.
/// @pre the spec has one
[[nodiscard]] std::string controller_path(const ProblemSpec& spec);

/// Reads `controller.file`: `/controller` of an HDF5 file (see check_stored_controller()) or a SCOTS static
/// controller (see read_scots_controller()); its first bytes tell which.
/// @pre the spec has one
/// @throws IoError if it cannot be read; ControllerError if it is neither, damaged, or on another grid,
///   naming the place in it, what was found and what was expected
[[nodiscard]] ListedController read_controller_file(const ProblemSpec& spec);

/// Checks its kind and its grids only.
void check_controller_file(const ProblemSpec& spec);

}  // namespace coordreq
