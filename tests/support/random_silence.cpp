#include "support/random_silence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "support/draw.hpp"

namespace coordreq {
namespace {

/// Over inputs of one agent and some states. @param narrow permits few actions
std::string draw_rule(const std::vector<std::string>& inputs, const std::vector<std::string>& states,
                      bool narrow) {
  if (!narrow && draw(0, 3) == 0) return "true";
  std::string text;
  for (const std::string& input : inputs) {
    if (!narrow && draw(0, 3) == 0) continue;
    const std::string bound = states.empty() || draw(0, 2) > 0
                                  ? std::to_string(draw(-1, 1))
                                  : fmt::format("{} - {}", pick(states), draw(1, 4));
    const std::string sign = pick<std::string>(narrow ? std::vector<std::string>{"<=", ">=", "=="}
                                                      : std::vector<std::string>{"<=", ">=", "!="});
    text += fmt::format("{}{} {} {}", text.empty() ? "" : " and ", input, sign, bound);
  }
  if (text.empty()) return "true";
  if (states.empty() || draw(0, 3) > 0) return text;
  return fmt::format("{} > {} or {}", pick(states), draw(1, 5), text);
}

}  // namespace

std::string with_silence(const std::string& problem) {
  nlohmann::json spec = nlohmann::json::parse(problem);
  std::vector<std::string> exact;
  for (const nlohmann::json& state : spec["states"]) {
    if (!state.contains("measurement_error") || state["measurement_error"] == 0)
      exact.push_back(state["name"].get<std::string>());
  }
  const bool has_then = draw(0, 1) == 0;
  const bool are_all = draw(0, 1) == 0;
  nlohmann::json silence = nlohmann::json::object();
  for (const nlohmann::json& agent : spec["agents"]) {
    const auto inputs = agent["inputs"].get<std::vector<std::string>>();
    std::vector<std::string> states;
    for (const std::string& state : exact) {
      const bool is_seen = !agent.contains("sees") || std::find(agent["sees"].begin(), agent["sees"].end(),
                                                                state) != agent["sees"].end();
      if (is_seen) states.push_back(state);
    }
    const auto name = agent["name"].get<std::string>();
    if (are_all || draw(0, 2) > 0) silence["actions"][name] = draw_rule(inputs, states, draw(0, 1) == 0);
    if (has_then) silence["then"][name] = draw_rule(inputs, states, draw(0, 2) > 0);
  }
  if (silence.empty()) {
    const nlohmann::json& first = spec["agents"].front();
    silence["actions"][first["name"].get<std::string>()] = "true";
  }
  spec["silence"] = silence;
  return spec.dump();
}

}  // namespace coordreq
