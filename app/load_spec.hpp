#pragma once

#include <string>

#include "spec/problem_spec.hpp"

namespace coordreq {

/// The spec at `path` ("-": standard input), checked, with nothing in it that this version cannot do.
/// @throws IoError, SpecError
[[nodiscard]] ProblemSpec load_spec(const std::string& path);

}  // namespace coordreq
