#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answers/analysis_context.hpp"
#include "engine/packed_pairs.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

// Whether the grid of a file that others wrote is that of a spec: numbers in it may be off in their last
// digits, since they are sums of rounded steps.
namespace coordreq {

/// Where `controller.file` leads: a relative path starts in the folder of the spec.
/// @pre the spec has one
[[nodiscard]] std::string controller_path(const ProblemSpec& spec);

/// Reads `controller.file`: `/controller` of an HDF5 file (see check_stored_controller()) or a SCOTS static
/// controller (see read_scots_controller()); its first bytes say which.
/// @pre the spec has one
/// @throws IoError if it cannot be read; ControllerError if it is neither, damaged, or on another grid,
///   naming the location in it, what was found and what was expected
[[nodiscard]] ListedController read_controller_file(const ProblemSpec& spec);

/// Checks its kind and its grids only.
void check_controller_file(const ProblemSpec& spec);

/// How far a grid point in a file may be off, as a fraction of the distance of neighbours.
inline constexpr double kGridTolerance = 1e-3;

/// The smallest distance of two of the points; none if there is but one.
[[nodiscard]] std::optional<double> spacing(const std::vector<Rational>& points);

/// Whether `found` is `expected` up to that tolerance.
/// @param distance of neighbours; none: there is but one point, which is compared to nine digits
[[nodiscard]] bool same_point(double found, double expected, std::optional<double> distance);

/// Reads a static controller of SCOTS v0.2 (text): the grids of states and inputs, which must be those of the
/// spec up to the noise of last digits, then for each state of its winning domain the valid inputs: any
/// number of them, as a safety game leaves, or one, as a reachability game does (a matrix of one column).
/// States and inputs are numbered with dimension 0 fastest; inputs of a spec that lists values may stand in
/// any order.
/// @throws IoError; ControllerError naming file, line and section, what was found and what was expected
[[nodiscard]] PackedPairs read_scots_controller(const std::string& path, const ProblemSpec& spec);

/// Checks what comes before the list of states.
void check_scots_controller(const std::string& path, const ProblemSpec& spec);

/// Checks that a results file (or one that others wrote by the same rules) holds `/controller` on the grid of
/// the spec: its axes are the states of the spec in their order, its attribute `inputs` names the inputs in
/// theirs, and the datasets of both have the grid points, up to the noise of last digits.
/// @throws IoError; ResultsError naming the object, what was found and what was expected
void check_stored_controller(const std::string& path, const ProblemSpec& spec);

/// Reads it, after the same checks.
[[nodiscard]] PackedPairs read_stored_controller(const std::string& path, const ProblemSpec& spec);

}  // namespace coordreq
