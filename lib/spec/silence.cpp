#include "spec/silence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

/// A condition of an agent, and where it stands.
struct Rule {
  const Program& condition;
  std::int32_t agent;
  std::string pointer;
};

void for_each_rule(const ProblemSpec& spec, const std::function<void(const Rule&)>& look) {
  const auto look_at = [&](const std::vector<std::optional<Program>>& rules, const std::string& key) {
    for (std::size_t i = 0; i < rules.size(); ++i) {
      if (rules[i])
        look({*rules[i], static_cast<std::int32_t>(i),
              member_pointer("/silence/" + key, spec.agents[i].name)});
    }
  };
  look_at(spec.silence->actions, "actions");
  look_at(spec.silence->then, "then");
}

/// The states and inputs that a condition reads, by slot; a cell of a state counts as the state.
std::vector<std::size_t> slots_read(const ProblemSpec& spec, const Program& condition) {
  std::vector<std::size_t> slots;
  const std::size_t points = spec.states.size() + spec.inputs.size();
  for (const std::size_t slot : condition.variables()) slots.push_back(slot < points ? slot : slot - points);
  return slots;
}

void check_rule(const ProblemSpec& spec, const Rule& rule) {
  const AgentSpec& agent = spec.agents[at(rule.agent)];
  const auto refuse = [&](const std::string& found) {
    throw SpecError(fmt::format("expected inputs of the agent {} and states that it sees, found {}",
                                quote_text(agent.name), found),
                    rule.pointer);
  };
  const std::vector<std::size_t> seen = seen_states(spec, {rule.agent});
  for (const std::size_t slot : slots_read(spec, rule.condition)) {
    if (slot >= spec.states.size()) {
      const std::size_t input = slot - spec.states.size();
      if (!contains(agent.inputs, input)) refuse("the input " + quote_text(spec.inputs[input].name));
    } else if (!contains(seen, slot)) {
      const std::string memory = memory_that_keeps(spec, slot);
      refuse(memory.empty() ? "the state " + quote_text(spec.states[slot].name)
                            : fmt::format("the memory {}, whose formula reads more", quote_text(memory)));
    }
  }
}

/// Refuses rules of two agents that read the same state if it is measured with an error.
void check_measured(const ProblemSpec& spec) {
  std::vector<std::int32_t> reader(spec.states.size(), -1);
  for_each_rule(spec, [&](const Rule& rule) {
    std::vector<bool> read(spec.states.size(), false);
    for (const std::size_t slot : slots_read(spec, rule.condition)) {
      if (slot < spec.states.size()) add_states_read(spec, slot, read);
    }
    for (std::size_t i = 0; i < read.size(); ++i) {
      if (!read[i] || spec.states[i].measurement_error == 0) continue;
      if (reader[i] >= 0 && reader[i] != rule.agent) {
        throw SpecError(
            fmt::format("expected a state with a measurement error in conditions of one agent, found {} in "
                        "those of {} and {}",
                        quote_text(spec.states[i].name), quote_text(spec.agents[at(reader[i])].name),
                        quote_text(spec.agents[at(rule.agent)].name)),
            rule.pointer);
      }
      reader[i] = rule.agent;
    }
  });
}

}  // namespace

void check_silence(const ProblemSpec& spec) {
  if (!spec.silence) return;
  for_each_rule(spec, [&](const Rule& rule) { check_rule(spec, rule); });
  check_measured(spec);
}

bool all_have_rules(const SilenceSpec& silence) {
  return std::ranges::all_of(silence.actions, [](const auto& rule) { return rule.has_value(); });
}

}  // namespace coordreq
