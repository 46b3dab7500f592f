#include "answers/one_cell/action_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "answers/field_parts.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::string action_text(const ProblemSpec& spec, const std::vector<std::int32_t>& agents,
                        const std::vector<bool>& actions) {
  REQUIRES(std::find(actions.begin(), actions.end(), true) != actions.end());
  constexpr std::size_t kMostWords = 5;
  const std::vector<std::int32_t> inputs = inputs_of(spec, agents);
  std::vector<std::string> names, values;
  std::vector<std::int64_t> counts;
  for (const std::int32_t i : inputs) {
    names.push_back(spec.inputs[at(i)].name);
    counts.push_back(std::ssize(spec.inputs[at(i)].values));
  }
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (!actions[a]) continue;
    if (values.size() == kMostWords) {
      values.emplace_back("...");
      break;
    }
    const Odometer index(counts, static_cast<std::int64_t>(a));
    std::vector<double> tuple;
    for (std::size_t k = 0; k < inputs.size(); ++k)
      tuple.push_back(nearest_double(spec.inputs[at(inputs[k])].values[at(index[k])]));
    values.push_back(inputs.size() == 1 ? fmt::format("{}", tuple.front())
                                        : fmt::format("({})", fmt::join(tuple, ", ")));
  }
  const std::string name = names.size() == 1 ? names.front() : fmt::format("({})", fmt::join(names, ", "));
  return fmt::format("{} = {}", name, fmt::join(values, ", "));
}

}  // namespace coordreq
