#pragma once

#include <cstdint>
#include <vector>

#include "model/table_shape.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The variables, form and size of the table of every state.
/// @throws SpecError as build_abstraction() does where an equation is undefined
[[nodiscard]] std::vector<TableShape> table_shapes(const SystemSpec& spec);

/// Entries of all tables, as they are stored.
[[nodiscard]] double entries_of(const std::vector<TableShape>& shapes);
/// How many choices there are of the values of some states and inputs: the entries of a table over them.
[[nodiscard]] double choices_of(const SystemSpec& spec, const std::vector<std::int32_t>& states,
                                const std::vector<std::int32_t>& inputs);

/// Solves the dynamics for every input and parameter without building tables.
/// @returns true if every post is an exact hull. @throws SpecError as build_abstraction() does, but for
///   discrete states off their grid
[[nodiscard]] bool check_dynamics(const SystemSpec& spec);

/// @throws SpecError if a discrete state moves between the samples: between its values it has no cells
void check_between_samples(const SystemSpec& spec);

}  // namespace coordreq
