#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spec/system_spec.hpp"

namespace coordreq {

/// Agents "a", "b", ...
[[nodiscard]] inline std::vector<AgentSpec> agents(std::size_t count) {
  std::vector<AgentSpec> result;
  for (std::size_t a = 0; a < count; ++a)
    result.push_back({.name = std::string(1, static_cast<char>('a' + a)), .inputs = {0}});
  return result;
}

}  // namespace coordreq
