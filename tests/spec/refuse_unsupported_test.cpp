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
      {"/requirements", R"([{"name": "r", "where": "true", "invariant": true}])",
       "'requirements' is not supported yet (/requirements)"},
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
      {"horizon", 3},
      {"link_cost", nlohmann::json::parse(R"([{"agents": ["a", "b"], "cost": 2}])")},
      {"convention", true}};
  spec["network"] = {{"delay", 2}};
  spec["requirements"] = nlohmann::json::array();
  spec["output"] = {{"controller", true}, {"actions", true}, {"layers", true}, {"abstraction", true}};
  EXPECT_EQ(refusal(spec), "");
  EXPECT_EQ(refusal(test::example_with("/abstraction", R"({"between_samples": true})")), "");
  EXPECT_EQ(refusal(test::example()), "");
}

}  // namespace
}  // namespace coordreq
