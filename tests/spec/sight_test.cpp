#include "spec/sight.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using States = std::vector<std::size_t>;

/// Agents a and b that see what is given; null: they say nothing of it.
nlohmann::json with_sight(const nlohmann::json& a, const nlohmann::json& b) {
  nlohmann::json spec = test::example();
  if (!a.is_null()) spec["agents"][0]["sees"] = a;
  if (!b.is_null()) spec["agents"][1]["sees"] = b;
  return spec;
}

TEST(Sight, IsOfAllStatesUnlessTheSpecSaysElse) {
  EXPECT_FALSE(has_limited_sight(test::read(with_sight(nullptr, nullptr))));
  EXPECT_FALSE(has_limited_sight(test::read(with_sight({"x2", "x1"}, nullptr))));
  const ProblemSpec spec = test::read(with_sight({"x2"}, nullptr));
  EXPECT_TRUE(has_limited_sight(spec));
  EXPECT_EQ(seen_states(spec, {0}), (States{1}));
  EXPECT_EQ(seen_states(spec, {1}), (States{0, 1}));
}

TEST(Sight, OfAClassIsThatOfItsAgents) {
  const ProblemSpec spec = test::read(with_sight({"x2"}, {"x1"}));
  EXPECT_EQ(seen_states(spec, {0, 1}), (States{0, 1}));
  const ProblemSpec blind = test::read(with_sight(nlohmann::json::array(), nlohmann::json::array()));
  EXPECT_EQ(seen_states(blind, {0, 1}), States{});
}

TEST(Sight, OfAPartitionIsLimitedIfThatOfOneOfSeveralClassesIs) {
  nlohmann::json json = with_sight({"x2"}, {"x1"});
  json["coordination"]["partitions"] =
      nlohmann::json::parse(R"([{"classes": [["a", "b"]]}, {"classes": []}])");
  const ProblemSpec spec = test::read(json);
  EXPECT_FALSE(has_limited_sight(spec, spec.coordination.partitions[0]));
  EXPECT_TRUE(has_limited_sight(spec, spec.coordination.partitions[1]));
}

TEST(Sight, OfWhatAMemoryKeepsIsThatOfAllThatItsFormulaReads) {
  nlohmann::json json = with_sight({"x1"}, {"x2"});
  json["memory"] = {{"first", "once(x1 >= 0)"},
                    {"mixed", "since(x1 >= 0, x2 >= 0)"},
                    {"later", "previous(mixed)"},
                    {"clock", "for_last(3, true)"}};  // in the order of their names
  const ProblemSpec spec = test::read(json);
  ASSERT_EQ(spec.states.size(), 6U);
  EXPECT_EQ(spec.states[2].name, "clock_past");
  const auto names_of = [&](const States& states) {
    std::vector<std::string> names;
    for (const std::size_t i : states) names.push_back(spec.states[i].name);
    return names;
  };
  EXPECT_EQ(names_of(seen_states(spec, {0})), (std::vector<std::string>{"x1", "clock_past", "first_past"}));
  EXPECT_EQ(names_of(seen_states(spec, {1})), (std::vector<std::string>{"x2", "clock_past"}));
  EXPECT_EQ(seen_states(spec, {0, 1}).size(), 6U);
}

TEST(Sight, OfWhatIsMeasuredWithAnErrorIsOfOneClass) {
  nlohmann::json json = with_sight({"x1"}, {"x1", "x2"});
  json["states"][0]["measurement_error"] = 0.25;
  EXPECT_EQ(test::error_of(json),
            "a state with a measurement error, expected one class of the partition 'a|b' that sees it, found "
            "'a' and "
            "'b' (/states/0/measurement_error)");
  json["coordination"]["partitions"] = nlohmann::json::parse(R"([{"classes": [["a", "b"]]}])");
  EXPECT_EQ(test::error_of(json), "");
  json["coordination"].erase("partitions");
  json["agents"][0].erase("sees");
  json["agents"][1]["sees"] = {"x1"};
  EXPECT_NE(test::error_of(json), "");
  json["agents"][0]["sees"] = {"x2"};
  EXPECT_EQ(test::error_of(json), "");
  json["agents"][0].erase("sees");
  json["agents"][1].erase("sees");
  EXPECT_EQ(test::error_of(json), "");  // all see everything, in the same cell
}

}  // namespace
}  // namespace coordreq
