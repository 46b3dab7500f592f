#pragma once

#include <vector>

#include "model/table_shape.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The variables, form and size of the table of every state.
/// @throws SpecError as build_abstraction() does where an equation is undefined
[[nodiscard]] std::vector<TableShape> table_shapes(const SystemSpec& spec);

/// Solves the dynamics for every input and parameter without building tables.
/// @returns true if every post is an exact hull. @throws SpecError as build_abstraction() does, but for
///   discrete states off their grid
[[nodiscard]] bool check_dynamics(const SystemSpec& spec);

/// @throws SpecError if a discrete state moves between the samples: between its values it has no cells
void check_between_samples(const SystemSpec& spec);

}  // namespace coordreq
