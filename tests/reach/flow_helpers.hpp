#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "expression/evaluate.hpp"
#include "reach/validated_flow.hpp"

namespace coordreq {

/// Slots of the names x, y, z (states), u, v (inputs) and w, d (disturbances).
inline constexpr std::array<std::string_view, 7> kFlowNames{"x", "y", "z", "u", "v", "w", "d"};
inline constexpr std::size_t kInputSlot = 3;
inline constexpr std::size_t kDisturbanceSlot = 5;

inline Binding look_up_flow(std::string_view name) {
  for (std::uint32_t i = 0; i < kFlowNames.size(); ++i) {
    if (name == kFlowNames[i]) return i;
  }
  return NotDefined{};
}

/// A system of the states x, y, z, as many as there are equations, and boxes of everything.
struct FlowCase {
  std::vector<Program> equations;
  std::vector<Interval> slots = std::vector<Interval>(kFlowNames.size());
  std::vector<FlowSystem::Limit> stops;
  double tau = 0.1;

  explicit FlowCase(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      equations.push_back(link(text, look_up_flow, ExpectedType::number, "/dynamics"));
    }
  }

  [[nodiscard]] FlowSystem system() const {
    FlowSystem result;
    for (std::uint32_t i = 0; i < equations.size(); ++i) {
      result.equations.push_back(&equations[i]);
      result.state_slots.push_back(i);
    }
    result.disturbance_slots = {kDisturbanceSlot, kDisturbanceSlot + 1};
    result.slot_count = kFlowNames.size();
    result.stops = stops;
    return result;
  }
  [[nodiscard]] ValidatedFlow validated() const { return {system(), tau, tau}; }
  [[nodiscard]] FlowEnclosure enclosure() const { return validated().flow(slots); }
};

inline double width(const Interval& a) {
  return a.upper - a.lower;
}

}  // namespace coordreq
