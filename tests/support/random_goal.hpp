#pragma once

#include <rapidcheck.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace coordreq {

/// Often met, sometimes nowhere or everywhere; drawn inside a RapidCheck property.
inline std::string draw_goal(const nlohmann::json& states) {
  const auto name = [&] {
    return states[*rc::gen::inRange<std::size_t>(0, states.size())]["name"].get<std::string>();
  };
  const auto bound = [] { return std::to_string(*rc::gen::inRange(0, 6)) + ".5"; };
  const std::string one = name() + *rc::gen::element<std::string>(" <= ", " >= ") + bound();
  const std::string two = name() + *rc::gen::element<std::string>(" <= ", " >= ") + bound();
  return *rc::gen::weightedElement<std::string>(
      {{6, one}, {3, one + " and " + two}, {2, one + " or " + two}, {1, "false"}, {1, "true"}});
}

/// The problem with a goal that ends the task, or that lasts; or, of four times one, as it is.
inline std::string perhaps_with_goal(const std::string& problem) {
  if (*rc::gen::inRange(0, 4) == 0) return problem;
  nlohmann::json spec = nlohmann::json::parse(problem);
  spec["goal"] = {{"where", draw_goal(spec["states"])},
                  {"then", *rc::gen::element<std::string>("over", "over", "stay", "return")}};
  return spec.dump();
}

}  // namespace coordreq
