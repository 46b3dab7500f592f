#include "verify/class_actions.hpp"

#include <algorithm>

namespace coordreq {

ClassActions class_actions(const ProblemSpec& spec, const InputSpace& inputs,
                           const std::vector<std::int32_t>& agents) {
  std::vector<std::size_t> own;
  for (const std::int32_t agent : agents) {
    for (const std::int32_t i : spec.agents[static_cast<std::size_t>(agent)].inputs)
      own.push_back(static_cast<std::size_t>(i));
  }
  std::sort(own.begin(), own.end());
  ClassActions result;
  for (const std::size_t i : own) {
    result.count *= inputs[i].count();
    result.inputs.push_back(spec.inputs[i].name);
  }
  for (std::int64_t u = 0; u < inputs.count(); ++u) {
    std::int64_t action = 0;
    for (const std::size_t i : own) action = action * inputs[i].count() + inputs.index(u, i);
    result.of_input.push_back(static_cast<std::int32_t>(action));
  }
  return result;
}

}  // namespace coordreq
