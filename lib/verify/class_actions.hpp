#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/input_space.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The joint actions of one class: row-major over its inputs in the order of the spec, the last fastest.
struct ClassActions {
  std::int64_t count = 1;
  std::vector<std::int32_t> of_input;  ///< [joint input]: the class's part of it
  std::vector<std::string> inputs;     ///< names

  /// Bytes that one bit an action takes.
  [[nodiscard]] std::int64_t bytes() const { return (count + 7) / 8; }
};

/// @param agents indices
[[nodiscard]] ClassActions class_actions(const ProblemSpec& spec, const InputSpace& inputs,
                                         const std::vector<std::int32_t>& agents);

}  // namespace coordreq
