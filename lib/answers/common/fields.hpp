#pragma once

#include "answers/field.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

[[nodiscard]] Fields common_fields(const ProblemSpec& spec);

}  // namespace coordreq
