#pragma once

#include <string>
#include <string_view>

#include "spec/system_spec.hpp"

namespace coordreq {

/// read_spec() for tests that ask for nothing but what posts follow from.
[[nodiscard]] SystemSpec read_system(std::string text, std::string_view source);

}  // namespace coordreq
