#include "property/random_dynamics.hpp"

#include <fmt/format.h>

#include "support/read_system.hpp"

namespace coordreq {
namespace {

template <std::size_t N>
const char* one_of(const std::array<const char*, N>& choices) {
  return choices[static_cast<std::size_t>(pick(static_cast<int>(N)))];
}

std::string draw_side(bool continuous) {
  return one_of(std::array{"unsafe", "safe", "saturate", continuous ? "stop" : "saturate"});
}

std::string draw_state(std::string_view name, bool continuous) {
  const std::string lower = one_of(std::array{"-2", "-0.7", "-0.1", "0", "0.25", "1"});
  const std::string length = one_of(std::array{"0.05", "0.3", "1", "pi/8"});
  const int count = 2 + pick(2);
  std::string text = fmt::format(R"({{"name": "{}", "lower": {}, "upper": "{} + {}", "count": {}, )", name,
                                 lower, lower, length, count);
  if (pick(3) == 0) {
    text += fmt::format(R"("measurement_error": "{}*{}/{}", )", one_of(std::array{"0.05", "0.5", "0.9"}),
                        length, count);
  }
  if (pick(3) == 0) return text + R"("outside": "periodic"})";
  return text + fmt::format(R"("outside": {{"below": "{}", "above": "{}"}}}})", draw_side(continuous),
                            draw_side(continuous));
}

std::string draw_disturbance(std::string_view name) {
  const std::string lower = one_of(std::array{"-1", "-0.1", "0", "0.5"});
  return fmt::format(R"({{"name": "{}", "lower": {}, "upper": "{} + {}"}})", name, lower, lower,
                     one_of(std::array{"0", "0.1", "1"}));
}

std::string draw_text(const std::vector<std::string>& equations, bool continuous) {
  const auto name = [](std::size_t slot) { return kFlowNames[slot]; };
  return fmt::format(
      R"({{"coordreq": 1, "name": "random",
"states": [{}, {}, {}],
"inputs": [{{"name": "u", "values": [{}]}}, {{"name": "v", "values": [-1, 0.3]}}],
"disturbances": [{}, {}],
"agents": [{{"name": "a", "inputs": ["u", "v"]}}],
"dynamics": {{"time": "{}", "period": {}, "equations": {{"x": "{}", "y": "{}", "z": "{}"}}}},
"safe": "true", "abstraction": {{"cells": "{}"}}}})",
      draw_state(name(0), continuous), draw_state(name(1), continuous), draw_state(name(2), continuous),
      one_of(std::array{"0", "1.5", "-0.5"}), draw_disturbance(name(kDisturbanceSlot)),
      draw_disturbance(name(kDisturbanceSlot + 1)), continuous ? "continuous" : "discrete",
      one_of(std::array{"0.01", "0.1", "0.3", "1"}), equations[0], equations[1], equations[2],
      one_of(std::array{"closed", "half_open"}));
}

}  // namespace

RandomDynamics RandomDynamics::draw() {
  constexpr std::array kRoughness{Roughness::smooth, Roughness::lipschitz, Roughness::discontinuous};
  const Roughness roughness = kRoughness[static_cast<std::size_t>(pick(3))];
  std::vector<std::string> equations;
  for (int i = 0; i < 3; ++i) equations.push_back(random_field(pick(4), 3, roughness));
  const std::string text = draw_text(equations, pick(3) > 0);
  RandomDynamics result{text, read_system(text, "random"), FlowCase(equations)};
  const SystemSpec& spec = result.spec;
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    const DisturbanceSpec& w = spec.disturbances[l];
    result.system.slots[kDisturbanceSlot + l] = {w.lower.get_d(), w.upper.get_d()};
  }
  for (const StateSpec& state : spec.states) {
    const double first = state.grid.first.get_d();
    const double last = Rational(state.grid.first + state.grid.step * (state.grid.count - 1)).get_d();
    result.system.stops.push_back(
        {state.below == Outside::stop, state.above == Outside::stop, {first, first}, {last, last}});
  }
  result.system.tau = spec.dynamics.period.get_d();
  return result;
}

}  // namespace coordreq
