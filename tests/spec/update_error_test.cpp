#include <gtest/gtest.h>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using test::error_of;

/// The example with a mode, and its update.
nlohmann::json with_mode(const std::string& update, const std::string& changes = "[]") {
  nlohmann::json spec = test::example();
  spec["states"].push_back(
      nlohmann::json::parse(R"({"name": "m", "lower": 0, "upper": 2, "step": 1, "discrete": true})"));
  spec["dynamics"]["updates"]["m"] = update;
  return spec.patch(nlohmann::json::parse(changes));
}

TEST(UpdateErrors, AnUpdateIsAFunctionOfTheSample) {
  EXPECT_EQ(error_of(with_mode("if(x1 >= 0.2 and u1 > 0, 2, m)")), "");
  EXPECT_EQ(error_of(with_mode("if(x1 >= 0.2, x2, m)")),
            "expected discrete states and inputs outside of the conditions of 'if', found the state 'x2' "
            "(/dynamics/updates/m)");
  EXPECT_EQ(
      error_of(with_mode("if(w1 > 0, 1, m)")),
      "expected an expression over states and inputs, found the disturbance 'w1' (/dynamics/updates/m)");
}

TEST(UpdateErrors, OnlyDiscreteStatesHaveOneInsteadOfAnEquation) {
  EXPECT_EQ(error_of(with_mode("m", R"([{"op": "add", "path": "/dynamics/equations/m", "value": "0"}])")),
            "'m' has an equation too, expected one of the two (/dynamics/updates/m)");
  EXPECT_EQ(error_of(with_mode("m", R"([{"op": "remove", "path": "/states/2/discrete"}])")),
            "'m' is no discrete state, expected an equation (/dynamics/updates/m)");
  EXPECT_EQ(error_of(with_mode("m", R"([{"op": "add", "path": "/dynamics/updates/n", "value": "0"}])")),
            "an update for 'n', which is no state (/dynamics/updates)");
  EXPECT_EQ(error_of(with_mode("m", R"([{"op": "add", "path": "/states/2/outside", "value": "stop"}])")),
            "'m' jumps at samples, expected another 'outside' than 'stop' (/dynamics/updates/m)");
  EXPECT_EQ(error_of(with_mode("m", R"([{"op": "replace", "path": "/dynamics/time", "value": "discrete"}])")),
            "updates are for continuous time, expected the next values in 'equations' (/dynamics/updates)");
  EXPECT_EQ(error_of(with_mode("m", R"([{"op": "remove", "path": "/dynamics/updates/m"}])")),
            "missing equation for the state 'm' (/dynamics/equations)");
}

}  // namespace
}  // namespace coordreq
