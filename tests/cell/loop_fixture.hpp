#pragma once

#include <string>
#include <utility>
#include <vector>

#include "answers/layers/answer.hpp"
#include "answers/paths.hpp"
#include "cell/closed_loop.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"

namespace coordreq::test {

/// A loop on a spec with delays made by hand, as the tests need them.
class LoopFixture {
 public:
  LoopFixture(const std::string& spec, std::vector<std::int32_t> delay, std::int64_t connection_delay = 0)
      : spec_(read_spec(spec, "test")), delay_(std::move(delay)), connection_delay_(connection_delay) {
    ThreadTeam team(1);
    abstraction_ = build_abstraction(spec_, team);
  }
  LoopFixture(const LoopFixture&) = delete;
  LoopFixture& operator=(const LoopFixture&) = delete;

  [[nodiscard]] LoopProblem problem() const {
    return {.spec = &spec_,
            .abstraction = &abstraction_,
            .partition = &spec_.coordination.partitions.front(),
            .policies = layer_policies(spec_),
            .values = {{paths::kDelay, delay_}},
            .connection_delay = connection_delay_};
  }
  [[nodiscard]] const ProblemSpec& spec() const { return spec_; }
  [[nodiscard]] const Abstraction& abstraction() const { return abstraction_; }

  [[nodiscard]] RunTrace run(std::vector<Rational> start, LoopOptions options, std::uint64_t run = 0) const {
    return ClosedLoop(problem(), options).run(std::move(start), run);
  }

 private:
  ProblemSpec spec_;
  Abstraction abstraction_{.grid = UniformGrid({}), .inputs = InputSpace({})};
  std::vector<std::int32_t> delay_;
  std::int64_t connection_delay_;
};

/// One state x of `points` cells 0, 1, ... with x' = `equation` over x and the inputs u of agent a and v of
/// b.
inline std::string line_spec(int points, const std::string& equation, const std::string& edges = "\"unsafe\"",
                             const std::string& agents = R"({"name": "a", "inputs": ["u"]},
                                                            {"name": "b", "inputs": ["v"]})",
                             const std::string& more = "") {
  return R"({"coordreq": 1, "name": "line", "states": [{"name": "x", "lower": 0, "upper": )" +
         std::to_string(points - 1) + R"(, "step": 1, "outside": )" + edges + R"(}],
"inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [-1, 0]}], "agents": [)" +
         agents + R"(], "dynamics": {"time": "discrete", "period": 1, "equations": {"x": ")" + equation +
         R"("}}, "safe": "x <= 8.5", "abstraction": {"cells": "half_open", "safe": "center"})" + more + "}";
}

}  // namespace coordreq::test
