#include <fmt/format.h>
#include <gtest/gtest.h>

#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// Steps of 0.5 s.
std::int64_t steps_of(const std::string& requirement) {
  const ProblemSpec spec = read_spec(fmt::format(R"({{"coordreq": 1, "name": "times",
"states": [{{"name": "x", "lower": 0, "upper": 9, "step": 1}}],
"inputs": [{{"name": "u", "values": [0]}}], "agents": [{{"name": "a", "inputs": ["u"]}}],
"dynamics": {{"time": "discrete", "period": 0.5, "equations": {{"x": "x + u"}}}}, "safe": "true", "goal": "x == 0",
"requirements": [{{"name": "r", "where": "true", {}}}]}})",
                                                 requirement),
                                     "times");
  return spec.requirements.front().steps;
}

/// What must last is rounded up to whole steps, what must not take longer is rounded down.
TEST(Requirement, TimesBecomeStepsOnTheSafeSide) {
  for (const std::string lasts : {"min_delay_time", "min_approach_delay_time"}) {
    EXPECT_EQ(steps_of(fmt::format("\"{}\": 1.45", lasts)), 3);
    EXPECT_EQ(steps_of(fmt::format("\"{}\": 1.5", lasts)), 3);
    EXPECT_EQ(steps_of(fmt::format("\"{}\": 1.55", lasts)), 4);
  }
  EXPECT_EQ(steps_of("\"max_arrival_time\": 1.45"), 2);
  EXPECT_EQ(steps_of("\"max_arrival_time\": 1.5"), 3);
  EXPECT_EQ(steps_of("\"max_arrival_time\": 1.95"), 3);
  EXPECT_EQ(steps_of("\"max_arrival_time\": 0.45"), 0);
}

TEST(Requirement, StepsAreTakenAsTheyAre) {
  for (const std::string kind : {"min_delay", "max_arrival", "min_approach_delay"})
    EXPECT_EQ(steps_of(fmt::format("\"{}\": 7", kind)), 7);
}

}  // namespace
}  // namespace coordreq
