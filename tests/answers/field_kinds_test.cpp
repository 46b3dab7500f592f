#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "answers/field_parts.hpp"
#include "answers/field_table.hpp"
#include "answers/plan.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// A spec that asks for every answer, and for all that is stored on request.
ProblemSpec everything() {
  return read_spec(R"({"coordreq": 1, "name": "all",
"states": [{"name": "x", "lower": 0, "upper": 3, "step": 1, "discrete": true, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u"], "sees": []}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u - v"}}, "safe": "x <= 2", "goal": "x == 0",
"coordination": {"partitions": "all", "horizon": 2, "convention": true, "connection_delay": 1},
"network": {"loss": 0.1}, "risk": {"horizon": 2}, "silence": {"then": {"a": "u == 0", "b": "v == 0"}}, "requirements": [{"name": "r", "where": "x == 0", "invariant": true}],
"output": {"controller": true, "actions": true, "layers": true, "abstraction": true}})",
                   "test");
}

bool is_over_cells(const Field& field, const ProblemSpec& spec) {
  const std::vector<std::string> axes = cell_axes(spec);
  const bool is_computed =
      std::search(field.axes.begin(), field.axes.end(), axes.begin(), axes.end()) != field.axes.end();
  return is_computed && field.section != FieldSection::abstraction;
}

TEST(FieldKind, IsThatOfTheElements) {
  const ProblemSpec spec = everything();
  const std::vector<ElementType> steps = {ElementType::int16, ElementType::int32};
  const std::map<FieldKind, std::vector<ElementType>> types = {
      {FieldKind::set, {ElementType::uint8}},
      {FieldKind::steps, steps},
      {FieldKind::choice, steps},
      {FieldKind::share, {ElementType::float32}},
      {FieldKind::probability, {ElementType::float32}},
      {FieldKind::actions, {ElementType::uint8}}};
  std::set<FieldKind> found;
  for (const Field& field : result_fields(spec)) {
    ASSERT_EQ(is_over_cells(field, spec), field.kind != FieldKind::none) << field.path;
    if (field.kind == FieldKind::none) continue;
    found.insert(field.kind);
    EXPECT_EQ(field.types, types.at(field.kind)) << field.path;
    EXPECT_EQ(field.kind == FieldKind::set, field.types.front() == ElementType::uint8 && field.most == 1)
        << field.path;
    EXPECT_EQ(field.kind == FieldKind::actions, field.axes.back() == field.path + ":byte") << field.path;
  }
  EXPECT_EQ(found.size(), types.size());
}

TEST(AnswerPolicies, HaveTheFieldsThatTheyName) {
  const ProblemSpec spec = everything();
  const Fields fields = result_fields(spec);
  const auto axes_of = [&fields](const std::string& path) {
    const auto found = std::find_if(fields.begin(), fields.end(),
                                    [&path](const Field& field) { return field.path == path; });
    return found == fields.end() || found->kind != FieldKind::steps ? std::vector<std::string>()
                                                                    : found->axes;
  };
  const std::vector<AnswerPolicy> policies = answer_policies(spec);
  ASSERT_GT(policies.size(), 2U);
  EXPECT_EQ(policies.front().name, "");
  std::set<std::string> names;
  for (const AnswerPolicy& policy : policies) {
    EXPECT_TRUE(names.insert(policy.name).second) << policy.name;
    EXPECT_TRUE(!policy.delay.empty() || policy.trigger.empty()) << policy.name;
    EXPECT_EQ(policy.countdown().empty(), policy.delay.empty()) << policy.name;
    for (const std::string& path : {policy.delay, policy.trigger}) {
      if (path.empty()) continue;
      EXPECT_EQ(axes_of(path), cell_axes("/partition", spec)) << path;
    }
    if (policy.aim.path.empty()) continue;
    EXPECT_EQ(axes_of(policy.aim.path), cell_axes(spec)) << policy.aim.path;
  }
}

TEST(AnswerPolicies, AreThoseOfTheSpec) {
  ProblemSpec spec = everything();
  spec.goal.reset();
  spec.coordination.convention = false;
  spec.agents[0].sees.reset();
  spec.silence.reset();
  const std::vector<AnswerPolicy> policies = answer_policies(spec);
  ASSERT_EQ(policies.size(), 1U);
  EXPECT_EQ(policies.front().delay, "/delay");
}

}  // namespace
}  // namespace coordreq
