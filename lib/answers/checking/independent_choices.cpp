#include "answers/checking/independent_choices.hpp"

#include "spec/problem_spec.hpp"

namespace coordreq {

IndependentChoices::IndependentChoices(const CheckContext& context,
                                       const std::vector<std::vector<std::int32_t>>& partition) {
  for (const auto& agents : partition)
    classes_.emplace_back(class_of(*context.spec, *context.inputs, agents)).tabulate();
}

std::vector<std::int64_t> IndependentChoices::of(const std::vector<std::uint8_t>& joint) const {
  std::vector<std::uint8_t> is_choice(joint.size(), 1);
  for (const InputClass& input_class : classes_) {
    std::vector<std::uint8_t> projection(static_cast<std::size_t>(input_class.actions()), 0);
    for (std::size_t u = 0; u < joint.size(); ++u)
      projection[static_cast<std::size_t>(input_class.action(static_cast<std::int64_t>(u)))] |= joint[u];
    for (std::size_t u = 0; u < joint.size(); ++u)
      is_choice[u] &= projection[static_cast<std::size_t>(input_class.action(static_cast<std::int64_t>(u)))];
  }
  std::vector<std::int64_t> result;
  for (std::size_t u = 0; u < joint.size(); ++u) {
    if (is_choice[u] != 0) result.push_back(static_cast<std::int64_t>(u));
  }
  return result;
}

}  // namespace coordreq
