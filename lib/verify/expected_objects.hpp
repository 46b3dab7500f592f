#pragma once

#include <string>
#include <vector>

#include "answers/checking/tally.hpp"
#include "answers/field.hpp"
#include "results/stored_object.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The attributes and axes that these fields of a results file of this spec have to have (contract, section
/// 4), but for free text, provenance and what counts cells or sweeps, which the checks of the answers look
/// after.
[[nodiscard]] std::vector<StoredObject> expected_objects(const ProblemSpec& spec, const Fields& fields);

/// Compares what is there with what is expected; more attributes than those are no harm.
[[nodiscard]] Finding check_objects(const std::vector<StoredObject>& expected,
                                    const std::vector<StoredObject>& found);

}  // namespace coordreq
