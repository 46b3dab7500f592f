#include "support/random_sight.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/draw.hpp"

namespace coordreq {

std::string with_sight(const std::string& problem) {
  nlohmann::json spec = nlohmann::json::parse(problem);
  nlohmann::json& agents = spec["agents"];
  nlohmann::json& states = spec["states"];
  const int share = draw(0, 3);  // of four states an agent sees so many, as a rule
  const int limited = draw(0, static_cast<int>(agents.size()) - 1);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (static_cast<int>(i) != limited && draw(0, 5) == 0) continue;
    nlohmann::json sees = nlohmann::json::array();
    for (const nlohmann::json& state : states) {
      if (draw(0, 3) < share) sees.push_back(state["name"]);
    }
    if (static_cast<int>(i) == limited && sees.size() == states.size()) sees.erase(sees.begin());
    agents[i]["sees"] = sees;
  }
  for (nlohmann::json& state : states) {
    int observers = 0;
    for (const nlohmann::json& agent : agents) {
      const bool sees = !agent.contains("sees") || std::find(agent["sees"].begin(), agent["sees"].end(),
                                                             state["name"]) != agent["sees"].end();
      observers += sees ? 1 : 0;
    }
    if (observers > 1) state["measurement_error"] = 0;
  }
  return spec.dump();
}

}  // namespace coordreq
