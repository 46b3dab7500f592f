#include "answers/checking/ruled_choices.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {

RuledChoices::RuledChoices(const CheckContext& context, const std::vector<std::optional<Program>>& conditions,
                           const std::string& key, const std::vector<std::vector<std::int32_t>>& partition)
    : joint_inputs_(context.inputs->count()) {
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (!conditions[i]) continue;
    rules_.emplace_back(*context.spec, *conditions[i], *context.grid, *context.inputs, "the condition",
                        member_pointer("/silence/" + key, context.spec->agents[i].name));
  }
  for (const std::vector<std::int32_t>& agents : partition) {
    const bool asks =
        std::ranges::any_of(agents, [&](std::int32_t i) { return !conditions[at(i)].has_value(); });
    if (asks) asking_.emplace_back(class_of(*context.spec, *context.inputs, agents)).tabulate();
  }
}

std::vector<std::int64_t> RuledChoices::of(std::int64_t cell, const std::vector<std::uint8_t>& admitted) {
  for (PermittedPairs& rule : rules_) rule.go_to(cell);
  std::vector<std::vector<std::uint8_t>> parts;
  for (const InputClass& input_class : asking_) {
    std::vector<std::uint8_t>& part = parts.emplace_back(at(input_class.actions()), std::uint8_t{0});
    for (std::int64_t u = 0; u < joint_inputs_; ++u) part[at(input_class.action(u))] |= admitted[at(u)];
  }
  std::vector<std::int64_t> result;
  for (std::int64_t u = 0; u < joint_inputs_; ++u) {
    bool is_choice = std::ranges::all_of(rules_, [u](const PermittedPairs& rule) { return rule(u); });
    for (std::size_t c = 0; c < asking_.size(); ++c)
      is_choice = is_choice && parts[c][at(asking_[c].action(u))] != 0;
    if (is_choice) result.push_back(u);
  }
  return result;
}

}  // namespace coordreq
