#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "example_spec.hpp"

namespace coordreq {
namespace {

using test::expect_errors;

TEST(SpecError, RequirementsAskForOneThing) {
  expect_errors({
      {"/requirements", R"([{"name": "r", "where": "true"}])",
       "missing key: one of 'min_delay', 'min_delay_time', 'invariant', 'max_arrival', 'max_arrival_time', "
       "'min_approach_delay', 'min_approach_delay_time', 'max_risk', 'min_blind_delay', "
       "'min_blind_delay_time', 'min_silence' or 'min_silence_time' (/requirements/0)"},
      {"/requirements", R"([{"name": "r", "where": "true", "min_delay": 1, "invariant": true}])",
       "'min_delay' and 'invariant' exclude each other (/requirements/0)"},
      {"/requirements", R"([{"name": "r", "where": "true", "invariant": false}])",
       "expected true, found false (/requirements/0/invariant)"},
      {"/requirements", R"([{"name": "", "where": "true", "invariant": true}])",
       "expected a string that is not empty, found '' (/requirements/0/name)"},
      {"/requirements", R"([{"name": "r", "where": "true", "invariant": true, "partition": "a|b"}])",
       "'invariant' is about all partitions, found 'partition' too (/requirements/0/partition)"},
      {"/requirements", R"([{"name": "r", "where": "true", "min_delay": 1, "partition": "a+b"}])",
       "expected the partition 'a|b', found 'a+b' (/requirements/0/partition)"},
      {"/requirements",
       R"([{"name": "r", "where": "true", "invariant": true}, {"name": "r", "where": "true", "min_delay": 1}])",
       "the requirement 'r' is listed twice (/requirements/1/name)"},
  });
}

TEST(SpecError, RequirementsAreDecidedBeforeMaxDelay) {
  nlohmann::json spec = test::example();
  spec["coordination"] = {{"max_delay", 2}};
  spec["requirements"] = nlohmann::json::parse(R"([{"name": "r", "where": "true", "min_delay_time": 2.5}])");
  EXPECT_EQ(test::error_of(spec),
            "expected at most 'max_delay', 2 steps, where the analysis stops, found 3 steps "
            "(/requirements/0/min_delay_time)");
  spec["requirements"][0]["min_delay_time"] = 2;
  EXPECT_EQ(test::error_of(spec), "");
}

}  // namespace
}  // namespace coordreq
