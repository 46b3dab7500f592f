#include "spec/held_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "spec/scope.hpp"
#include "spec/set_value.hpp"
#include "spec/spec_parts.hpp"
#include "spec/system_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// The inputs of a spec. Their values may name constants, which rest on nothing but constants.
std::vector<InputSpec> inputs_of(Json spec, std::string_view source) {
  for (const char* const key : {"definitions", "memory"}) spec.erase(key);
  const JsonDocument document = JsonDocument::parse(compact_json(spec), source);
  MemoryReader no_memory(document.root());
  return read_inputs(Scope(document.root(), no_memory), document.root());
}

std::vector<InputSpec> held_inputs(const Node& hold, const std::vector<InputSpec>& inputs) {
  if (hold.is_text()) return inputs;
  std::vector<std::string> names, held;
  for (const InputSpec& input : inputs) names.push_back(input.name);
  std::vector<InputSpec> result;
  for (const Node& name : hold.elements()) {
    check_new_name(name, held, "input");
    held.push_back(name.text());
    result.push_back(inputs[static_cast<std::size_t>(index_of_name(name, names, "an input"))]);
  }
  return result;
}

void check_name_is_free(const Json& spec, const std::string& name, const std::string& input,
                        const std::string& pointer) {
  bool is_used = false;
  for (const char* const list : {"states", "inputs", "disturbances"}) {
    for (const Json& variable : spec.value(list, Json::array()))
      is_used = is_used || variable["name"] == name;
  }
  for (const char* const object : {"constants", "definitions", "memory"})
    is_used = is_used || (spec.contains(object) && spec[object].contains(name));
  if (!is_used) return;
  throw SpecError(fmt::format("the name {} is taken, expected it free for the state that keeps {}",
                              quote_text(name), quote_text(input)),
                  pointer);
}

/// An input that is held, and the texts of which its state and its condition consist.
class HeldInput {
 public:
  explicit HeldInput(const InputSpec& input) : input_(input), values_(input.values) {
    std::ranges::sort(values_);
    for (std::size_t i = 2; i < values_.size(); ++i)
      is_even_ = is_even_ && values_[i] - values_[i - 1] == values_[1] - values_[0];
  }

  [[nodiscard]] std::string state_name() const { return input_.name + "_held"; }
  [[nodiscard]] Json state() const {
    const auto last = static_cast<std::int64_t>(values_.size()) - 1;
    Json state{{"name", state_name()},
               {"lower", is_even_ ? to_text(values_.front()) : "0"},
               {"upper", is_even_ ? to_text(values_.back()) : std::to_string(last)},
               {"count", last + 1},
               {"discrete", true}};
    if (is_even_ && !input_.unit.empty()) state["unit"] = input_.unit;
    return state;
  }
  [[nodiscard]] std::string next_value() const {
    if (is_even_) return input_.name;
    return choice([&](std::size_t i) { return fmt::format("{} == {}", input_.name, value(i)); },
                  [](std::size_t i) { return std::to_string(i); });
  }
  [[nodiscard]] std::string condition() const {
    if (is_even_) return fmt::format("{} == {}", input_.name, state_name());
    return fmt::format("{} == {}", input_.name,
                       choice([&](std::size_t i) { return fmt::format("{} == {}", state_name(), i); },
                              [&](std::size_t i) { return value(i); }));
  }

 private:
  [[nodiscard]] std::string value(std::size_t i) const { return "(" + to_text(input_.values[i]) + ")"; }

  /// "if(WHEN(0), THEN(0), if(WHEN(1), THEN(1), ... THEN(last)))"
  template <class When, class Then>
  [[nodiscard]] std::string choice(const When& when, const Then& then) const {
    const std::size_t last = values_.size() - 1;
    std::string text;
    for (std::size_t i = 0; i < last; ++i) text += fmt::format("if({}, {}, ", when(i), then(i));
    return text + then(last) + std::string(last, ')');
  }

  const InputSpec& input_;
  std::vector<Rational> values_;  ///< ascending
  bool is_even_ = true;
};

void add_condition(const std::string& condition, const std::string& agent, Json& silence) {
  Json& rule = silence["actions"][agent];
  rule = rule.is_null() ? condition : fmt::format("({}) and {}", rule.get<std::string>(), condition);
}

void add(const HeldInput& held, const std::string& input, Json& spec) {
  spec["states"].push_back(held.state());
  spec["dynamics"][spec["dynamics"]["time"] == "discrete" ? "equations" : "updates"][held.state_name()] =
      held.next_value();
  for (Json& agent : spec["agents"]) {
    if (std::ranges::find(agent["inputs"], Json(input)) == agent["inputs"].end()) continue;
    if (agent.contains("sees")) agent["sees"].push_back(held.state_name());
    add_condition(held.condition(), agent["name"].get<std::string>(), spec["silence"]);
  }
}

}  // namespace

JsonDocument with_held_inputs(const JsonDocument& document, const std::string& text,
                              std::string_view source) {
  const Node root = document.root();
  if (!root.has("silence") || !root["silence"].has("hold")) return document;
  Json spec = spec_json(text, std::string(source));
  const Node hold = root["silence"]["hold"];
  for (const InputSpec& input : held_inputs(hold, inputs_of(spec, source))) {
    const HeldInput held(input);
    check_name_is_free(spec, held.state_name(), input.name, hold.pointer());
    add(held, input.name, spec);
  }
  spec["silence"].erase("hold");
  return JsonDocument::parse(compact_json(spec), source);
}

}  // namespace coordreq
