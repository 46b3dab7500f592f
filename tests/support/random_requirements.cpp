#include "support/random_requirements.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "answers/requirements/region.hpp"
#include "spec/read_spec.hpp"
#include "spec/sight.hpp"
#include "support/draw.hpp"

namespace coordreq {
namespace {

std::string join(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string region(const ProblemSpec& spec) {
  const auto name = [&] { return pick(spec.states).name; };
  std::vector<std::string> box;
  for (const StateSpec& state : spec.states) {
    const int low = draw(0, static_cast<int>(state.grid.count) - 1);
    box.push_back(fmt::format("{} <= {} <= {}", low, state.name, low + draw(0, 2)));
  }
  const std::string inside = fmt::format("{}", fmt::join(box, " and "));
  return pick<std::string>(
      {inside, inside, inside, inside + fmt::format(" or {} == 2", name()), "true",
       fmt::format("{} + {} <= {}", name(), name(), draw(0, 8)),
       fmt::format("({0} - 3)^2 + ({1} - 2)^2 < {2}", name(), name(), draw(1, 8)),
       fmt::format("{0}^2 - 2*{0}*{1} + {1}^2 <= {2} and {3}", name(), name(), draw(0, 6), inside),
       fmt::format("sqrt({} - 1) <= 1.5", name())});
}

/// One that meets some cell.
std::string region_on_grid(const ProblemSpec& spec) {
  ThreadTeam team(1);
  const UniformGrid grid = make_grid(spec);
  for (;;) {
    std::string text = region(spec);
    const auto slot = [&spec](std::string_view name) -> Binding {
      for (std::uint32_t i = 0; i < spec.states.size(); ++i) {
        if (spec.states[i].name == name) return i;
      }
      return NotDefined{};
    };
    const Program where = link(text, slot, ExpectedType::condition, "where");
    if (cells_of_region(where, grid, team).count() > 0) return text;
  }
}

}  // namespace

std::string draw_team() {
  const int agents = draw(2, 4);
  const int count = agents == 2 ? draw(5, 9) : agents == 3 ? draw(4, 6) : draw(3, 4);
  std::vector<std::string> states, inputs, owners, equations;
  for (int i = 0; i < agents; ++i) {
    const std::string side = pick<std::string>({"unsafe", "safe", "saturate", "saturate"});
    states.push_back(fmt::format(R"({{"name": "x{}", "lower": 0, "upper": {}, "step": 1, "outside": "{}"}})",
                                 i, count - 1, side));
    inputs.push_back(fmt::format(R"({{"name": "u{}", "values": {}}})", i,
                                 pick<std::string>({"[-1, 0, 1]", "[0, 1]", "[1, -1]"})));
    owners.push_back(fmt::format(R"({{"name": "a{0}", "inputs": ["u{0}"]}})", i));
    equations.push_back(fmt::format(R"("x{0}": "x{0} + {1}u{0}")", i, pick<std::string>({"", "0.5*"})));
  }
  std::vector<std::string> apart;
  for (int i = 1; i < agents; ++i)
    apart.push_back(fmt::format("(x{} != x{} or x{} > 2)", draw(0, i - 1), i, draw(0, agents - 1)));
  std::vector<std::string> partitions = {R"({"name": "alone", "classes": []})"};
  if (agents > 2) partitions.push_back(R"({"classes": [["a0", "a1"]]})");
  if (agents > 3) partitions.push_back(R"({"classes": [["a0", "a2"], ["a1", "a3"]]})");
  return fmt::format(R"({{"coordreq": 1, "name": "team",
"states": [{}],
"inputs": [{}],
"agents": [{}],
"dynamics": {{"time": "discrete", "period": 1, "equations": {{{}}}}},
"safe": "{}",
"abstraction": {{"cells": "half_open", "safe": "center"}},
"coordination": {{"partitions": [{}]}}}})",
                     join(states), join(inputs), join(owners), join(equations),
                     fmt::join(apart, pick<std::string>({" and ", " or "})), join(partitions));
}

std::string with_requirements(std::string text) {
  const ProblemSpec spec = read_spec(text, "random");
  const auto most = static_cast<int>(std::min<std::int64_t>(spec.coordination.max_delay.value_or(4), 4));
  const bool has_goal = draw(0, 1) == 0;
  const bool is_blind = has_limited_sight(spec);
  const bool is_told = spec.silence.has_value();
  std::vector<std::string> requirements;
  for (int r = 0; r < 2; ++r) {
    const auto of_partition = [&](const std::string& kind) {
      const bool is_much = kind == "min_silence" && !spec.coordination.max_delay;  // so that more cells fail
      return fmt::format(R"("partition": "{}", "{}": {})", pick(spec.coordination.partitions).name, kind,
                         is_much ? draw(most, 3 * most) : draw(std::min(1, most), most));
    };
    const std::vector<std::string> of_goal = {fmt::format(R"("max_arrival": {})", draw(0, 4)),
                                              of_partition("min_approach_delay")};
    const std::string asked = has_goal && draw(0, 1) == 0  ? pick(of_goal)
                              : draw(0, 3) == 0            ? R"("invariant": true)"
                              : is_told && draw(0, 2) > 0  ? of_partition("min_silence")
                              : is_blind && draw(0, 2) > 0 ? of_partition("min_blind_delay")
                                                           : of_partition("min_delay");
    requirements.push_back(
        fmt::format(R"({{"name": "r{}", "where": "{}", {}}})", r, region_on_grid(spec), asked));
  }
  text.erase(text.rfind('}'));
  if (has_goal)
    text += fmt::format(R"(, "goal": "{} {} {}.5")", pick(spec.states).name, pick<std::string>({"<=", ">="}),
                        draw(0, 6));
  return text + fmt::format(", \"requirements\": [{}]}}", join(requirements));
}

}  // namespace coordreq
