#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "example_spec.hpp"

namespace coordreq {
namespace {

std::string refusal(const nlohmann::json& spec) {
  const ProblemSpec read = test::read(spec);
  try {
    refuse_unsupported(read);
    return {};
  } catch (const SpecError& error) {
    return error.what();
  }
}

TEST(RefuseUnsupported, NamesTheKey) {
  const std::vector<test::ErrorCase> cases{
      {"/coordination", R"({"partitions": "all"})", "'all' is not supported yet (/coordination/partitions)"},
      {"/coordination", R"({"horizon": 3})", "'horizon' is not supported yet (/coordination/horizon)"},
      {"/coordination", R"({"horizon_time": 3})",
       "'horizon_time' is not supported yet (/coordination/horizon_time)"},
      {"/coordination", R"({"link_cost": [{"agents": ["a", "b"], "cost": 1}]})",
       "'link_cost' is not supported yet (/coordination/link_cost)"},
      {"/coordination", R"({"convention": true})",
       "'convention' is not supported yet (/coordination/convention)"},
      {"/network", R"({"delay": 2})", "'network' is not supported yet (/network)"},
  };
  for (const test::ErrorCase& one : cases) {
    EXPECT_EQ(refusal(test::example_with(one.pointer, one.value)), one.what);
  }
}

TEST(RefuseUnsupported, TakesEverythingElse) {
  nlohmann::json spec = test::example();
  spec["states"][0]["outside"] = {{"below", "safe"}, {"above", "saturate"}};
  spec["states"][0]["measurement_error"] = 0.1;
  spec["states"][1]["discrete"] = true;
  spec["agents"][1]["prefer"] = "x1^2";
  spec["dynamics"]["time"] = "discrete";
  spec["abstraction"] = {{"cells", "half_open"}, {"safe", "center"}, {"between_samples", false}};
  spec["controller"] = {{"synthesis", "given"}, {"allow", "u1 < 1"}, {"file", "other.h5"}};
  spec["coordination"] = {
      {"max_delay", 3},
      {"connection_delay", 2},
      {"partitions", nlohmann::json::parse(R"([{"classes": [["a", "b"]]}, {"classes": []}])")},
      {"link_cost", nlohmann::json::array()},
      {"convention", false}};
  spec["requirements"] = nlohmann::json::parse(R"([{"name": "r", "where": "true", "invariant": true}])");
  spec["output"] = {{"controller", true}, {"actions", true}, {"layers", true}, {"abstraction", true}};
  EXPECT_EQ(refusal(spec), "");
  EXPECT_EQ(refusal(test::example_with("/abstraction", R"({"between_samples": true})")), "");
  EXPECT_EQ(refusal(test::example()), "");
}

}  // namespace
}  // namespace coordreq
