#include "support/random_like_agents.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include "support/draw.hpp"

namespace coordreq {
namespace {

/// In what the last agent is not like the others, or the first is; above these nobody differs. A unit and a
/// preference make no difference to what is safe.
enum class Odd : std::uint8_t { values, safe_set, edge, error, unit, preference };

class LikeAgents {
 public:
  LikeAgents() {
    // Integrators, a vehicle, two dimensions that move either way, or one that goes to its other end.
    kind_ = draw(0, 3);
    agents_ = draw(2, 3);
    has_one_state_ = kind_ == 0 || kind_ == 3;
    most_ = agents_ == 2 ? draw(3, kind_ == 3 ? 12 : 6) : has_one_state_ ? draw(3, 5) : 2;
    edges_ = *rc::gen::element<std::string>(
        R"("upper": {}, "step": 1)", R"("upper": {}, "step": 1, "outside": "saturate")",
        R"("upper": {}, "step": 1, "outside": {{"below": "unsafe", "above": "safe"}})",
        R"("upper": {}, "step": 1, "outside": {{"below": "safe", "above": "saturate"}})",
        R"("upper": {0}, "count": {0}, "outside": "periodic")");
    odd_ = static_cast<Odd>(draw(0, 11));
  }

  std::string spec() {
    std::string states, inputs, agents, equations, safe;
    for (int i = 0; i < agents_; ++i) {
      const std::string comma = i == 0 ? "" : ", ";
      const std::string preference = is_odd(i, Odd::preference) ? R"json(, "prefer": "abs(p0 - 1)")json" : "";
      agents += fmt::format(R"({}{{"name": "agent{}", "inputs": ["u{}"]{}}})", comma, i, i, preference);
      inputs += fmt::format(R"({}{{"name": "u{}", "values": [{}]{}}})", comma, i,
                            is_odd(i, Odd::values) ? "-1, 1" : values_,
                            is_odd(i, Odd::unit) ? R"(, "unit": "m")" : "");
      equations += comma + equation(i);
    }
    // All of one kind together, or all of one agent.
    const bool by_agent = *rc::gen::arbitrary<bool>();
    const int kinds = has_one_state_ ? 1 : 2;
    for (int k = 0; k < agents_ * kinds; ++k) {
      const int i = by_agent ? k / kinds : k % agents_;
      const int which = by_agent ? k % kinds : k / agents_;
      states += (k == 0 ? "" : ", ") + state(which == 0 ? "p" : "v", i, which == 1 && kind_ == 1);
    }
    for (int i = 0; i < agents_; ++i) {
      for (int j = 0; j < i; ++j)
        safe +=
            fmt::format("{}({})", safe.empty() ? "" : " and ", apart(std::to_string(i), std::to_string(j)));
    }
    if (odd_ == Odd::safe_set) safe += " and p0 >= 1";
    if (has_clock_) {
      states += R"(, {"name": "t", "lower": 0, "upper": 1, "step": 1, "outside": "saturate"})";
      equations += has_tubes_ ? R"(, "t": "1")" : R"(, "t": "t + 1")";
      safe = fmt::format("t <= 0 or ({})", safe);
    }
    return fmt::format(
        R"({{"coordreq": 1, "name": "alike", "states": [{}], "inputs": [{}], "agents": [{}],
"dynamics": {{"time": "{}", "period": 1, "equations": {{{}}}}}, "safe": "{}",
"coordination": {{"partitions": {}{}}},
"abstraction": {{{}}}}})",
        states, inputs, agents, has_tubes_ ? "continuous" : "discrete", equations, safe, partitions(),
        *rc::gen::element<std::string>("", R"(, "max_delay": 1)", R"(, "max_delay": 3)"),
        has_tubes_ ? R"("between_samples": true)" : R"("safe": "center", "cells": "half_open")");
  }

 private:
  [[nodiscard]] bool is_odd(int i, Odd what) const { return odd_ == what && i == agents_ - 1; }

  [[nodiscard]] std::string state(const std::string& name, int i, bool is_speed) const {
    std::string edges = is_speed ? fmt::format(R"("upper": {}, "step": 1, "outside": "saturate")", 2)
                                 : fmt::format(fmt::runtime(edges_), most_);
    if (!is_speed && is_odd(i, Odd::edge)) edges = fmt::format(fmt::runtime(other_edges_), most_);
    if (is_odd(i, Odd::error)) edges += R"(, "measurement_error": 0.25)";
    return fmt::format(R"({{"name": "{}{}", "lower": 0, {}}})", name, i, edges);
  }

  /// All, or a list of some.
  [[nodiscard]] std::string partitions() const {
    if (agents_ == 2 || is_listed_ == 0) return R"("all")";
    const std::string alone = R"({"classes": [["agent0"], ["agent1"], ["agent2"]]})";
    const std::string pair = R"({"classes": [["agent0"], ["agent1", "agent2"]]})";
    return is_listed_ == 1 ? fmt::format("[{}, {}]", pair, alone) : fmt::format("[{}, {}]", alone, pair);
  }

  std::string equation(int i) const {
    if (has_tubes_ && has_one_state_) return fmt::format(R"("p{0}": "u{0} + {1}")", i, drift_);
    if (has_tubes_ && kind_ == 1) return fmt::format(R"("p{0}": "v{0}", "v{0}": "u{0}")", i);
    if (has_tubes_) return fmt::format(R"("p{0}": "u{0}", "v{0}": "-u{0}")", i);
    if (kind_ == 0) return fmt::format(R"("p{0}": "p{0} + u{0} + {1}")", i, drift_);
    if (kind_ == 1) return fmt::format(R"("p{0}": "p{0} + v{0}", "v{0}": "v{0} + u{0}")", i);
    if (kind_ == 3) return fmt::format(R"("p{0}": "{1} - p{0} + u{0}")", i, most_ - drift_);
    return fmt::format(R"("p{0}": "p{0} + u{0}", "v{0}": "v{0} - u{0}")", i);
  }

  std::string apart(const std::string& i, const std::string& j) const {
    switch (form_) {
      case 0:
        return fmt::format("abs(p{} - p{}) >= {}", i, j, has_one_state_ ? 1 : 2);
      case 1:
        return fmt::format("p{} <= 1 or p{} <= 1 or p{} >= 4 or p{} >= 4", i, j, i, j);
      default:
        return fmt::format("p{} + p{} != {}", i, j, most_);
    }
  }

  int kind_, agents_, most_;
  Odd odd_;
  bool has_one_state_;
  int is_listed_ = draw(0, 2);
  int form_ = draw(0, 2);
  int drift_ = draw(0, 1);
  bool has_tubes_ = draw(0, 2) == 0;              // in continuous time, safe between the samples too
  bool has_clock_ = *rc::gen::arbitrary<bool>();  // a state that no agent moves
  std::string values_ = *rc::gen::element<std::string>("-1, 0, 1", "0, 1", "-1, 1", "-1, 0, 2");
  std::string edges_;
  /// Of an agent that differs, at one side or both.
  std::string other_edges_ = *rc::gen::element<std::string>(
      R"("upper": {}, "step": 1, "outside": {{"below": "unsafe", "above": "saturate"}})",
      R"("upper": {}, "step": 1, "outside": {{"below": "saturate", "above": "unsafe"}})",
      R"("upper": {}, "step": 1, "outside": {{"below": "saturate", "above": "safe"}})");
};

}  // namespace

std::string draw_like_agents() {
  return LikeAgents().spec();
}

}  // namespace coordreq
