// Safety between the samples, on examples that can be computed by hand, by both engines.

#include <gtest/gtest.h>

#include "spec/read_spec.hpp"
#include "support/fast_engine.hpp"
#include "support/members.hpp"
#include "support/plain_engine.hpp"

namespace coordreq {
namespace {

/// K as text, "1" for members; both engines must agree on it.
std::string invariant(const std::string& text) {
  ThreadTeam team(2);
  const ProblemSpec spec = read_spec(text, "between samples");
  const FastAnalysis fast(spec, team);
  const PlainAnalysis plain =
      analyze_plainly(spec, fast.abstraction, members(fast.safe), members(fast.beyond.value_or(fast.safe)));
  EXPECT_EQ(members(fast.invariance.invariant), plain.invariant);
  EXPECT_EQ(fast.collision_times(), plain.collision_time);
  for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
    EXPECT_EQ(fast.delays(p), plain.partitions[p].delay);
  }
  std::string result;
  for (const bool member : plain.invariant) result += member ? '1' : '.';
  return result;
}

std::string problem(const std::string& states, const std::string& inputs, const std::string& equations,
                    const std::string& safe, const std::string& abstraction) {
  return R"({"coordreq": 1, "name": "t", "states": [)" + states + R"(], "inputs": [)" + inputs +
         R"(], "agents": [{"name": "all", "inputs": ["u"]}], "dynamics": {"time": "continuous", "period": 1,
"equations": {)" +
         equations + R"(}}, "safe": ")" + safe + R"(", "abstraction": )" + abstraction + "}";
}

std::string vehicle(const std::string& outside, const std::string& speeds, const std::string& safe,
                    const std::string& abstraction) {
  return problem(R"({"name": "x", "lower": 0, "upper": 9, "step": 1, "outside": )" + outside + "}",
                 R"({"name": "u", "values": )" + speeds + "}", R"("x": "u")", safe, abstraction);
}

TEST(BetweenSamples, AFastVehicleMustNotJumpOverAThinObstacle) {
  const std::string past_the_end = R"({"below": "unsafe", "above": "safe"})";
  const std::string safe = "x <= 3.5 or x >= 5.5";
  const auto k = [&](const std::string& between) {
    return invariant(
        vehicle(past_the_end, "[4]", safe, R"({"cells": "half_open", "between_samples": )" + between + "}"));
  };
  // From 2 and 3 the samples lie beyond the cells 4 and 5, but the way leads through them.
  EXPECT_EQ(k("false"), "..11..1111");
  EXPECT_EQ(k("true"), "......1111");
}

TEST(BetweenSamples, StandingAtAnObstacleOrAtTheEdgeIsSafe) {
  EXPECT_EQ(invariant(vehicle(R"("unsafe")", "[0]", "x <= 3.5 or x >= 5.5",
                              R"({"cells": "half_open", "between_samples": true})")),
            "1111..1111");
}

TEST(BetweenSamples, BeyondASaturatingLimitSafeMustHoldToo) {
  const auto k = [&](const std::string& speeds, const std::string& safe) {
    return invariant(
        vehicle(R"("saturate")", speeds, safe, R"({"cells": "half_open", "between_samples": true})"));
  };
  // From 9 with speed 1 the vehicle is up to 10.5 before the sample sets it back to 9.
  EXPECT_EQ(k("[1]", "x >= 2.5"), "...1111111");
  EXPECT_EQ(k("[1]", "x >= 2.5 and x <= 10.5"), "...1111111");
  EXPECT_EQ(k("[1]", "x >= 2.5 and x <= 10.4"), "..........");
  // Whoever stands still there does not get beyond it.
  EXPECT_EQ(k("[0, 1]", "x >= 2.5 and x <= 10.4"), "...1111111");
  // Other states do not matter to a limit that is passed elsewhere.
  EXPECT_EQ(k("[-1]", "x <= 9"), "111111111.");
  EXPECT_EQ(k("[-2]", "x >= -2.4"), "..........");
}

TEST(BetweenSamples, TheCentresSayWhatIsSafeIfThatWasAskedFor) {
  EXPECT_EQ(invariant(vehicle(R"("saturate")", "[1]", "x >= 3 and x <= 9",
                              R"({"cells": "half_open", "between_samples": true, "safe": "center"})")),
            "...1111111");
}

TEST(BetweenSamples, LayersShrinkWhereOnlyTheWayIsUnsafe) {
  // Two agents push a load along a line; a step of both together jumps over the obstacle at the cells 5
  // and 6.
  const auto layers = [](const std::string& between) {
    ThreadTeam team(1);
    const ProblemSpec spec = read_spec(
        R"({"coordreq": 1, "name": "t", "states": [{"name": "x", "lower": 0, "upper": 9, "step": 1,
"outside": {"below": "unsafe", "above": "safe"}}],
"inputs": [{"name": "u", "values": [1, 2]}, {"name": "v", "values": [1, 2]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"x": "u + v"}},
"safe": "x <= 4.5 or x >= 6.5", "abstraction": {"cells": "half_open", "between_samples": )" +
            between + "}}",
        "t");
    return FastAnalysis(spec, team).layers[0].sizes;
  };
  // At the samples both can jump from 3, and from 4 unless both go slowly; 0 and 2 may lead to 4, 1 to 5.
  // Between them nobody gets across.
  EXPECT_EQ(layers("false"), (std::vector<std::int64_t>{8, 6, 4}));
  EXPECT_EQ(layers("true"), (std::vector<std::int64_t>{3}));
}

TEST(BetweenSamples, TheHalfBeyondAStopLimitNeedNotBeSafe) {
  for (const std::string between : {"false", "true"}) {
    const std::string k =
        invariant(problem(R"({"name": "v", "lower": 0, "upper": 3, "step": 1, "outside": "stop"})",
                          R"({"name": "u", "values": [-1]})", R"("v": "u")", "v >= 0 and v <= 3",
                          R"({"between_samples": )" + between + "}"));
    EXPECT_EQ(k, "1111") << between;
  }
}

}  // namespace
}  // namespace coordreq
