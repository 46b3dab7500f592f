#pragma once

#include <string>

#include "spec/spec_types.hpp"

namespace coordreq {

/// Which steps are lost: "at most 2 of any 5 steps lost".
[[nodiscard]] std::string network_meaning(const NetworkSpec& network);

}  // namespace coordreq
