#include "reach/enclosure_sample.hpp"

#include <gtest/gtest.h>

#include <string>

#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// Three states on 9 points each, two inputs of 2 values. @param effort of "abstraction"
ProblemSpec sampled_spec(const std::string& equations, const std::string& effort = "200") {
  const std::string limits = R"("lower": -4, "upper": 4, "step": 1, "outside": "saturate"})";
  return read_spec(R"({"coordreq": 1, "name": "t", "states": [{"name": "x", )" + limits +
                       R"(, {"name": "y", )" + limits + R"(, {"name": "z", )" + limits +
                       R"(], "inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "continuous", "period": 0.5, "equations": )" +
                       equations + R"(}, "safe": "true", "abstraction": {"effort": )" + effort + "}}",
                   "test");
}

std::vector<EnclosedGroup> groups_of(const ProblemSpec& spec) {
  return enclosed_groups(spec, table_shapes(spec));
}

/// How many subboxes a box takes, about.
double subboxes_of_box(const ProblemSpec& spec, int boxes) {
  EnclosureSample sample(spec, groups_of(spec).front());
  std::int64_t subboxes = 0;
  for (int k = 0; k < boxes; ++k) subboxes += sample.enclose_next();
  return static_cast<double>(subboxes) / boxes;
}

TEST(EnclosureSample, CountsTheBoxesThatTablesNeed) {
  // x and y have an influence on one another, z moves by itself and is exactly solved.
  const ProblemSpec spec = sampled_spec(R"({"x": "y + u", "y": "(1 - x^2)*y - x", "z": "v"})");
  const std::vector<EnclosedGroup> groups = groups_of(spec);
  ASSERT_EQ(groups.size(), 1);
  EXPECT_EQ(groups[0].states, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(EnclosureSample(spec, groups[0]).choices(), 9 * 9 * 2);
}

TEST(EnclosureSample, HasNothingOfExactPosts) {
  EXPECT_TRUE(groups_of(sampled_spec(R"({"x": "y + u", "y": "v", "z": "1"})")).empty());
}

TEST(EnclosureSample, KnowsAStateThatIsAffineOnlyWithoutAnInput) {
  const ProblemSpec spec = sampled_spec(R"_({"x": "if(u > 0, sin(x), 1)", "y": "v", "z": "1"})_");
  const std::vector<EnclosedGroup> groups = groups_of(spec);
  ASSERT_EQ(groups.size(), 1);
  EXPECT_EQ(EnclosureSample(spec, groups[0]).choices(), 9 * 2);
}

TEST(EnclosureSample, KnowsThatTablesOfSumsNeedFewBoxes) {
  const ProblemSpec spec = sampled_spec(R"_({"x": "y + sin(z)", "y": "-x + cos(z)", "z": "v"})_");
  const std::vector<EnclosedGroup> groups = groups_of(spec);
  ASSERT_EQ(groups.size(), 1);
  EXPECT_EQ(groups[0].states, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(groups[0].terms, (std::vector<std::int32_t>{0, 1}));
  EnclosureSample sample(spec, groups[0]);
  EXPECT_EQ(sample.choices(), 9 * 2);
  EXPECT_GE(sample.enclose_next(), 1);
}

TEST(EnclosureSample, TellsByFewBoxesHowManySubboxesAllTake) {
  const ProblemSpec spec = sampled_spec(R"({"x": "y + u", "y": "2*(1 - x^2)*y - x", "z": "v"})");
  const double few = subboxes_of_box(spec, 12);
  const double all = subboxes_of_box(spec, 300);
  EXPECT_GT(all, 3);  // boxes are divided
  EXPECT_LT(few, 2 * all);
  EXPECT_GT(few, all / 2);
}

TEST(EnclosureSample, TakesOneSubboxABoxWhereNoneIsDivided) {
  EXPECT_EQ(subboxes_of_box(sampled_spec(R"({"x": "y + u", "y": "2*(1 - x^2)*y - x", "z": "v"})", "0"), 12),
            1);
}

}  // namespace
}  // namespace coordreq
