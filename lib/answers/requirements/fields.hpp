#pragma once

#include <string>
#include <vector>

#include "answers/field.hpp"
#include "answers/field_source.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Verdicts, and the counterexamples of those that fail: each in a group of its own, by its position among
/// the requirements.
[[nodiscard]] Fields requirement_fields(const ProblemSpec& spec);

/// Adds what was found for them. REQUIRES: one for each requirement of the spec.
void add_requirement_values(const std::vector<ResultRequirement>& requirements, FieldValues& values);

[[nodiscard]] std::vector<ResultRequirement> read_requirement_values(const ProblemSpec& spec,
                                                                     const FieldSource& source);

}  // namespace coordreq
