#include "answers/checking/class_choices.hpp"

#include <algorithm>

#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {

ClassChoices::ClassChoices(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                           const Partition& partition, Rules rules)
    : joint_inputs_(inputs.count()), actions_(partition.size()) {
  const char* const pointer = rules == Rules::then ? "/silence/then" : "/silence/actions";
  for (const std::vector<std::int32_t>& agents : partition) {
    InputClass& input_class = inputs_.emplace_back(class_of(spec, inputs, agents));
    Class& entry = classes_.emplace_back(Class{input_class.offsets(), {}, rules == Rules::none});
    input_class.tabulate();
    for (const std::int32_t i : agents) {
      if (rules == Rules::none) continue;
      const auto& rule = rules == Rules::then ? spec.silence->then[at(i)] : spec.silence->actions[at(i)];
      if (rule) {
        entry.rules.emplace_back(spec, *rule, grid, inputs, "the condition",
                                 member_pointer(pointer, spec.agents[at(i)].name));
      } else {
        entry.asks_controller = true;
      }
    }
  }
}

template <class ForEachJoint>
void ClassChoices::find(std::int64_t cell, const ForEachJoint& for_each_joint) {
  for (std::size_t c = 0; c < actions_.size(); ++c) {
    Class& entry = classes_[c];
    std::vector<std::uint8_t>& actions = actions_[c];
    actions.assign(entry.offsets.size(), entry.asks_controller ? 0 : 1);
    if (entry.asks_controller) for_each_joint([&](std::int64_t u) { actions[at(inputs_[c].action(u))] = 1; });
    for (PermittedInputs& rule : entry.rules) {
      rule.go_to(cell);
      for (std::size_t a = 0; a < actions.size(); ++a) {
        if (actions[a] != 0 && !rule.holds(entry.offsets[a])) actions[a] = 0;
      }
    }
  }
}

void ClassChoices::go_to(std::int64_t cell, const std::vector<std::uint8_t>& joint) {
  find(cell, [&joint](const auto& visit) {
    for (std::size_t u = 0; u < joint.size(); ++u) {
      if (joint[u] != 0) visit(static_cast<std::int64_t>(u));
    }
  });
}

void ClassChoices::go_to(std::int64_t cell, const Numbers& joint) {
  find(cell, [&joint](const auto& visit) { std::ranges::for_each(joint, visit); });
}

void ClassChoices::restrict_to(std::size_t c, const std::vector<std::uint8_t>& bytes, std::size_t cell) {
  const std::size_t first = cell * at(inputs_[c].bytes());
  for (std::size_t a = 0; a < actions_[c].size(); ++a)
    actions_[c][a] &= static_cast<std::uint8_t>(bytes[first + a / 8] >> (a % 8) & 1U);
}

std::vector<ClassChoices::Numbers> ClassChoices::numbers() const {
  std::vector<Numbers> result(actions_.size());
  for (std::size_t c = 0; c < actions_.size(); ++c) {
    for (std::size_t a = 0; a < actions_[c].size(); ++a) {
      if (actions_[c][a] != 0) result[c].push_back(static_cast<std::int64_t>(a));
    }
  }
  return result;
}

bool ClassChoices::is_empty() const {
  return std::ranges::any_of(
      actions_, [](const auto& actions) { return std::ranges::find(actions, 1) == actions.end(); });
}

ClassChoices::Numbers ClassChoices::joint() const {
  Numbers result;
  for (std::int64_t u = 0; u < joint_inputs_; ++u) {
    if (has(u)) result.push_back(u);
  }
  return result;
}

}  // namespace coordreq
