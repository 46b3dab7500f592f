#pragma once

#include <vector>

#include "answers/field.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The attributes of a results file itself, but for `version`; what tells of the program is marked as found.
[[nodiscard]] std::vector<FieldAttribute> header_attributes(const ProblemSpec& spec);

}  // namespace coordreq
