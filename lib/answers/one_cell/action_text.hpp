#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "spec/spec_types.hpp"

namespace coordreq {

/// Some joint actions of a class, the first few: "u1 = -1, -0.5", or of several inputs "(u1, u2) = (-1, 0),
/// ...". @param agents of the class @param actions [action] whether it is shown. @pre some action is
[[nodiscard]] std::string action_text(const ProblemSpec& spec, const std::vector<std::int32_t>& agents,
                                      const std::vector<bool>& actions);

}  // namespace coordreq
