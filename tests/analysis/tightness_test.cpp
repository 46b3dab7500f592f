#include "analysis/tightness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/analyze.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// Two states around the origin, 25 cells, one joint input.
Json summary_of(const std::string& y, const std::string& period, const std::string& effort) {
  const std::string state = R"("lower": -2, "upper": 2, "step": 1, "outside": "saturate")";
  const std::string spec =
      R"({"coordreq": 1, "name": "t", "states": [{"name": "x", )" + state + R"(}, {"name": "y", )" + state +
      R"(}], "inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": )" +
      period + R"(, "equations": {"x": "y", "y": ")" + y +
      R"("}}, "safe": "true", "abstraction": {"effort": )" + effort + "}}";
  ThreadTeam team(1);
  return analyze(read_spec(spec, "test"), {}, team);
}

bool warns(const Json& summary) {
  return std::any_of(summary["warnings"].begin(), summary["warnings"].end(),
                     [](const Json& warning) { return warning["kind"] == "tightness"; });
}

TEST(Tightness, ExactPostsHaveNone) {
  EXPECT_TRUE(summary_of("u", "1", "200")["tightness"].is_null());
}

TEST(Tightness, WideEnclosuresAreToldWithWhatHelps) {
  const Json summary = summary_of("2*(1 - x^2)*y - x + u", "1", "0");
  const Json& found = summary["tightness"];
  EXPECT_EQ(found["posts"], 24);
  EXPECT_GT(found["p99"], 3);
  EXPECT_GE(found["most"], found["p99"]);
  EXPECT_GT(found["mean"], found["share"]);
  EXPECT_GT(found["share"], 0);
  ASSERT_TRUE(warns(summary));
  const std::string text = summary["warnings"].back()["message"];
  EXPECT_NE(text.find("a period half as long (to "), std::string::npos) << text;
  EXPECT_NE(text.find("an \"effort\" of 200 (to "), std::string::npos) << text;
}

TEST(Tightness, EffortBringsItDown) {
  const Json summary = summary_of("2*(1 - x^2)*y - x + u", "1", "200");
  EXPECT_LE(summary["tightness"]["p99"], 1);
  EXPECT_FALSE(warns(summary));
}

TEST(Tightness, SaysHowManyPostsAreNotLookedAt) {
  EXPECT_EQ(summary_of("u - x", "1", "0")["work"]["helpers"]["tightness"]["left_out"], 0);
  // Each solution takes some thousand steps, all of a post too many.
  const Json summary = summary_of("cos(1e5*x)", "0.5", "0");
  const Json& work = summary["work"]["helpers"]["tightness"];
  EXPECT_GT(work["left_out"], 0);
  EXPECT_EQ(work["posts"], summary["tightness"]["posts"]);
}

TEST(Tightness, IsTheSameEveryTime) {
  EXPECT_EQ(summary_of("sin(3*x) + u", "0.7", "10")["tightness"],
            summary_of("sin(3*x) + u", "0.7", "10")["tightness"]);
}

}  // namespace
}  // namespace coordreq
