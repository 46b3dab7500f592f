#include "maximal_spec.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "example_spec.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Slots = std::vector<std::uint32_t>;
using Members = std::vector<std::int32_t>;
using Classes = std::vector<Members>;

ProblemSpec maximal() {
  return read_spec(std::string(test::kMaximalSpec), "test.json");
}

TEST(MaximalSpec, TopLevel) {
  const ProblemSpec spec = maximal();
  EXPECT_EQ(spec.text, test::kMaximalSpec);
  EXPECT_EQ(spec.name, "circle");
  EXPECT_EQ(spec.description, "free text");
  EXPECT_EQ(spec.safe.text, "r2 <= R^2");
  EXPECT_TRUE(spec.safe.is_condition());
  EXPECT_EQ(spec.safe.variables(), (Slots{0, 1}));
  EXPECT_EQ(spec.slot_count(), 8U);
}

TEST(MaximalSpec, States) {
  const std::vector<StateSpec> states = maximal().states;
  ASSERT_EQ(states.size(), 4U);
  EXPECT_EQ(states[0].name, "x1");
  EXPECT_EQ(states[0].unit, "m");
  EXPECT_EQ(states[0].grid.first, -1);
  EXPECT_EQ(states[0].grid.step, Rational(1, 100));
  EXPECT_EQ(states[0].grid.count, 201);
  EXPECT_EQ(states[0].lower, -1);
  EXPECT_EQ(states[0].upper, 1);
  EXPECT_FALSE(states[0].discrete);
  EXPECT_EQ(states[0].measurement_error, Rational(1, 2));
  EXPECT_EQ(states[0].below, Outside::unsafe);
  EXPECT_EQ(states[0].above, Outside::unsafe);

  EXPECT_EQ(states[1].upper, Rational(4, 5));
  EXPECT_EQ(states[1].grid.step, Rational(1, 5));
  EXPECT_EQ(states[1].grid.count, 5);
  EXPECT_TRUE(states[1].discrete);
  EXPECT_EQ(states[1].measurement_error, 0);
  EXPECT_EQ(states[1].below, Outside::saturate);
  EXPECT_EQ(states[1].above, Outside::safe);

  EXPECT_EQ(states[2].grid.step, Rational(1, 2));
  EXPECT_EQ(states[2].grid.count, 3);
  EXPECT_EQ(states[2].below, Outside::stop);
  EXPECT_EQ(states[2].above, Outside::stop);
  EXPECT_EQ(states[3].name, "heading");
  EXPECT_EQ(states[3].grid.count, 72);
  EXPECT_EQ(states[3].below, Outside::periodic);
  EXPECT_EQ(states[3].above, Outside::periodic);
}

TEST(MaximalSpec, InputsAndDisturbances) {
  const ProblemSpec spec = maximal();
  ASSERT_EQ(spec.inputs.size(), 3U);
  EXPECT_EQ(spec.inputs[0].name, "u1");
  EXPECT_EQ(spec.inputs[0].unit, "m/s");
  ASSERT_TRUE(spec.inputs[0].grid.has_value());
  EXPECT_EQ(spec.inputs[0].grid->first, Rational(-3, 4));
  EXPECT_EQ(spec.inputs[0].values,
            (std::vector<Rational>{Rational(-3, 4), Rational(-1, 4), Rational(1, 4), Rational(3, 4)}));
  EXPECT_FALSE(spec.inputs[1].grid.has_value());
  EXPECT_EQ(spec.inputs[1].values, (std::vector<Rational>{1, -1, Rational(4, 5)}));
  EXPECT_EQ(spec.inputs[2].values, (std::vector<Rational>{0, Rational(1, 2), 1}));
  ASSERT_EQ(spec.disturbances.size(), 1U);
  EXPECT_EQ(spec.disturbances[0].name, "w1");
  EXPECT_EQ(spec.disturbances[0].unit, "N");
  EXPECT_EQ(spec.disturbances[0].lower, Rational(-1, 100));
  EXPECT_EQ(spec.disturbances[0].upper, Rational(1, 100));
}

TEST(MaximalSpec, AgentsAndDynamics) {
  const ProblemSpec spec = maximal();
  ASSERT_EQ(spec.agents.size(), 2U);
  EXPECT_EQ(spec.agents[0].name, "horizontal");
  EXPECT_EQ(spec.agents[0].inputs, (Members{0, 2}));
  ASSERT_TRUE(spec.agents[0].prefer.has_value());
  EXPECT_EQ(spec.agents[0].prefer->variables(), (Slots{0, 5}));
  EXPECT_EQ(spec.agents[1].inputs, (Members{1}));
  EXPECT_FALSE(spec.agents[1].prefer.has_value());
  EXPECT_FALSE(spec.agents[0].sees.has_value());
  EXPECT_EQ(spec.agents[1].sees, (std::vector<std::int32_t>{1, 3}));
  EXPECT_EQ(spec.dynamics.time, Time::continuous);
  EXPECT_EQ(spec.dynamics.period, Rational(1, 100));
  EXPECT_EQ(spec.dynamics.unit, "s");
  ASSERT_EQ(spec.dynamics.equations.size(), 4U);
  EXPECT_EQ(spec.dynamics.equations[0].variables(), Slots{spec.input_slot(0)});
  EXPECT_EQ(spec.dynamics.equations[1].variables(), Slots{spec.input_slot(1)});
  EXPECT_EQ(spec.dynamics.equations[2].variables(), Slots{spec.disturbance_slot(0)});
  EXPECT_EQ(spec.dynamics.equations[3].variables(), (Slots{spec.state_slot(0), spec.input_slot(2)}));
}

TEST(MaximalSpec, AbstractionControllerOutput) {
  const ProblemSpec spec = maximal();
  EXPECT_EQ(spec.abstraction.cells, Cells::half_open);
  EXPECT_EQ(spec.abstraction.safe, Membership::center);
  EXPECT_TRUE(spec.abstraction.between_samples);
  EXPECT_EQ(spec.controller.synthesis, Synthesis::given);
  ASSERT_TRUE(spec.controller.allow.has_value());
  EXPECT_EQ(spec.controller.allow->variables(), (Slots{0, 4}));
  EXPECT_EQ(spec.controller.file, "other.h5");
  EXPECT_TRUE(spec.output.controller);
  EXPECT_TRUE(spec.output.actions);
  EXPECT_TRUE(spec.output.layers);
  EXPECT_TRUE(spec.output.abstraction);
}

TEST(MaximalSpec, Silence) {
  const std::optional<SilenceSpec> silence = maximal().silence;
  ASSERT_TRUE(silence.has_value());
  EXPECT_FALSE(silence->actions[0].has_value());
  EXPECT_EQ(silence->actions[1]->variables(), (Slots{3, 5}));
  EXPECT_EQ(silence->then[0]->variables(), (Slots{0, 4, 6}));
  EXPECT_EQ(silence->then[1]->text, "true");
}

TEST(MaximalSpec, Coordination) {
  const CoordinationSpec coordination = maximal().coordination;
  ASSERT_EQ(coordination.partitions.size(), 2U);
  EXPECT_EQ(coordination.partitions[0].name, "alone");
  EXPECT_EQ(coordination.partitions[0].canonical, "horizontal|vertical");
  EXPECT_EQ(coordination.partitions[0].classes, (Classes{{0}, {1}}));
  EXPECT_EQ(coordination.partitions[1].name, "horizontal+vertical");
  EXPECT_EQ(coordination.partitions[1].classes, (Classes{{0, 1}}));
  EXPECT_FALSE(coordination.all_partitions);
  EXPECT_EQ(coordination.max_delay, 100);
  EXPECT_EQ(coordination.connection_delay, 2);
  EXPECT_EQ(coordination.horizon, 10);
  ASSERT_EQ(coordination.link_cost.size(), 1U);
  EXPECT_EQ(coordination.link_cost[0].first, 0);
  EXPECT_EQ(coordination.link_cost[0].second, 1);
  EXPECT_EQ(coordination.link_cost[0].cost, 2);
  EXPECT_TRUE(coordination.convention);
}

TEST(MaximalSpec, NetworkAutomaton) {
  const NetworkSpec network = maximal().network.value();
  EXPECT_EQ(network.kind, NetworkKind::automaton);
  ASSERT_EQ(network.modes.size(), 2U);
  EXPECT_EQ(network.modes[0].name, "up");
  EXPECT_EQ(network.modes[0].partition.classes, (Classes{{0, 1}}));
  EXPECT_EQ(network.modes[1].partition.name, "alone");
  EXPECT_EQ(network.transitions,
            (std::vector<std::pair<std::int32_t, std::int32_t>>{{0, 0}, {0, 1}, {1, 0}}));
  EXPECT_TRUE(network.resynthesise);
}

TEST(MaximalSpec, OtherNetworks) {
  const auto network = [](const std::string& text) {
    return test::read(test::example_with("/network", text)).network.value();
  };
  const NetworkSpec delay = network(R"({"delay": 5})");
  EXPECT_EQ(delay.kind, NetworkKind::delay);
  EXPECT_EQ(delay.delay, 5);
  const NetworkSpec burst = network(R"({"burst": {"length": 3, "gap": 2}})");
  EXPECT_EQ(burst.kind, NetworkKind::burst);
  EXPECT_EQ(burst.burst_length, 3);
  EXPECT_EQ(burst.burst_gap, 2);
  const NetworkSpec weakly_hard = network(R"({"weakly_hard": {"misses": 2, "window": 5}})");
  EXPECT_EQ(weakly_hard.kind, NetworkKind::weakly_hard);
  EXPECT_EQ(weakly_hard.misses, 2);
  EXPECT_EQ(weakly_hard.window, 5);
  EXPECT_FALSE(weakly_hard.resynthesise);
}

TEST(MaximalSpec, LossesAreUnfolded) {
  const auto network = [](const std::string& text) {
    return test::read(test::example_with("/network", text)).network.value();
  };
  const NetworkSpec burst = network(R"({"burst": {"length": 2, "gap": 1}})");
  ASSERT_EQ(burst.modes.size(), 3U);
  EXPECT_EQ(burst.modes[0].name, "11");
  EXPECT_EQ(burst.modes[0].partition.name, "a+b");
  EXPECT_EQ(burst.modes[2].name, "00");
  EXPECT_EQ(burst.modes[2].partition.name, "a|b");
  EXPECT_EQ(burst.transitions,
            (std::vector<std::pair<std::int32_t, std::int32_t>>{{0, 0}, {0, 1}, {1, 0}, {1, 2}, {2, 0}}));
  const NetworkSpec other = network(R"({"delay": 1, "up": "a|b", "down": "b+a"})");
  EXPECT_EQ(other.modes[0].partition.name, "a+b");
  EXPECT_EQ(other.modes[1].partition.name, "a|b");
}

TEST(MaximalSpec, Requirements) {
  const std::vector<RequirementSpec> requirements = maximal().requirements;
  ASSERT_EQ(requirements.size(), 3U);
  EXPECT_EQ(requirements[0].name, "near the middle");
  EXPECT_EQ(requirements[0].where.variables(), (Slots{0, 1}));
  EXPECT_EQ(requirements[0].partition, 0);
  EXPECT_EQ(requirements[0].steps, 20);
  EXPECT_EQ(requirements[0].kind, RequirementKind::min_delay);
  EXPECT_EQ(requirements[1].partition, 1);
  EXPECT_EQ(requirements[1].steps, 21);
  EXPECT_EQ(requirements[2].kind, RequirementKind::invariant);
  EXPECT_FALSE(requirements[2].partition.has_value());
  EXPECT_EQ(requirements[2].steps, 0);
}

TEST(MaximalSpec, DefaultsOfTheRest) {
  nlohmann::json minimal = test::example();
  for (const char* key : {"constants", "definitions", "disturbances"}) minimal.erase(key);
  minimal["safe"] = "x1 < 1";
  minimal["dynamics"]["equations"]["x1"] = "u1";
  const ProblemSpec spec = test::read(minimal);
  EXPECT_EQ(spec.description, "");
  EXPECT_TRUE(spec.disturbances.empty());
  EXPECT_EQ(spec.states[0].unit, "");
  EXPECT_EQ(spec.states[0].below, Outside::unsafe);
  EXPECT_EQ(spec.states[0].above, Outside::unsafe);
  EXPECT_EQ(spec.dynamics.unit, "");
  EXPECT_EQ(spec.abstraction.cells, Cells::closed);
  EXPECT_EQ(spec.abstraction.safe, Membership::inner);
  EXPECT_FALSE(spec.abstraction.between_samples);
  EXPECT_EQ(spec.controller.synthesis, Synthesis::maximal);
  EXPECT_FALSE(spec.controller.allow.has_value());
  EXPECT_FALSE(spec.controller.file.has_value());
  EXPECT_FALSE(spec.coordination.max_delay.has_value());
  EXPECT_EQ(spec.coordination.connection_delay, 0);
  EXPECT_FALSE(spec.coordination.horizon.has_value());
  EXPECT_FALSE(spec.network.has_value());
  EXPECT_TRUE(spec.requirements.empty());
  EXPECT_FALSE(spec.output.controller);
}

TEST(MaximalSpec, OneSideOfOutsideLeavesTheOtherUnsafe) {
  const ProblemSpec spec = test::read(test::example_with("/states/0/outside", R"({"above": "safe"})"));
  EXPECT_EQ(spec.states[0].below, Outside::unsafe);
  EXPECT_EQ(spec.states[0].above, Outside::safe);
}

}  // namespace
}  // namespace coordreq
