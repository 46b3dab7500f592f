#include "analysis/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// @param dynamics members of "dynamics" but `period`, which is 0.5
ProblemSpec spec_of(const std::string& outside, const std::string& dynamics) {
  return read_spec(R"({"coordreq": 1, "name": "t",
"states": [{"name": "p", "lower": 0, "upper": 10, "step": 0.5, "outside": ")" +
                       outside + R"("}, {"name": "n", "lower": 0, "upper": 3, "step": 1, "discrete": true}],
"inputs": [{"name": "u", "values": [-1, 0, 2]}], "disturbances": [{"name": "w", "lower": -3, "upper": 1}],
"agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"period": 0.5, )" +
                       dynamics + R"(}, "safe": "true"})",
                   "test");
}

TEST(Motion, IsTheGreatestOfAllInputsAndDisturbances) {
  const auto motion =
      sample_motion(spec_of("saturate", R"("time": "discrete", "equations": {"p": "p + u + w", "n": "n"})"))
          .states;
  EXPECT_DOUBLE_EQ(motion[0].amount, 4);  // u = -1, w = -3
  EXPECT_DOUBLE_EQ(motion[0].cells, 8);
  EXPECT_DOUBLE_EQ(motion[0].share, 8.0 / 21);
  EXPECT_EQ(motion[1].amount, 0);
}

TEST(Motion, BeginsAnywhereInTheCells) {
  const auto saturating = spec_of("saturate", R"("time": "continuous", "equations": {"p": "p", "n": "0"})");
  EXPECT_NEAR(sample_motion(saturating).states[0].amount, 10.25 * std::expm1(0.5), 1e-6);
}

TEST(Motion, BeginsNoFartherOutThanALimitThatStopsIt) {
  const auto stopping = spec_of("stop", R"("time": "continuous", "equations": {"p": "-p", "n": "0"})");
  EXPECT_NEAR(sample_motion(stopping).states[0].amount, 10 * -std::expm1(-0.5), 1e-6);
}

TEST(Motion, OfAStateWithAnUpdateIsHowFarItJumps) {
  const auto motion =
      sample_motion(
          spec_of("saturate", R"("time": "continuous", "equations": {"p": "u"}, "updates": {"n": "3 - n"})"))
          .states;
  EXPECT_NEAR(motion[0].amount, 1, 1e-9);
  EXPECT_EQ(motion[1].amount, 3);
  const auto by_cell = sample_motion(spec_of(
      "saturate", R"_("time": "continuous", "equations": {"p": "u"}, "updates": {"n": "if(p > 5, 2, n)"})_"));
  EXPECT_EQ(by_cell.states[1].amount, 2);
}

TEST(Motion, PassesOverWhatIsUndefined) {
  const auto motion = sample_motion(
      spec_of("saturate", R"("time": "discrete", "equations": {"p": "sqrt(p - 5) + p", "n": "n"})"));
  EXPECT_DOUBLE_EQ(motion.states[0].amount, std::sqrt(5.25));
  EXPECT_EQ(motion.left_out, 0);
}

TEST(Motion, LeavesOutSolutionsWhereTheyTakeVeryManySteps) {
  const auto motion = sample_motion(
      spec_of("saturate", R"("time": "continuous", "equations": {"p": "cos(1e6*p) + 2 + u", "n": "0"})"));
  EXPECT_GE(motion.solutions, 15);  // none takes more than 20,000
  EXPECT_GT(motion.left_out, 0);
  EXPECT_EQ(motion.solutions + motion.left_out, 16 + 16);
}

TEST(Motion, IsWrittenToSixDigits) {
  const auto spec =
      spec_of("saturate", R"("time": "discrete", "equations": {"p": "p + u/3 + 0*w", "n": "n"})");
  const Json json = motion_json(spec, sample_motion(spec).states);
  EXPECT_EQ(json[0].dump(), R"({"state":"p","amount":0.666667,"cells":1.33333,"share":0.0634921})");
}

}  // namespace
}  // namespace coordreq
