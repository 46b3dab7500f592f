#include <gtest/gtest.h>

#include <string>

#include "example_spec.hpp"

namespace coordreq {
namespace {

using test::error_of;
using test::example;
using test::example_with;
using test::expect_errors;

TEST(SpecError, ExampleReads) {
  EXPECT_EQ(error_of(example()), "");
}

TEST(SpecError, FormatIsRequired) {
  expect_errors({
      {"/coordreq", "-", "missing key 'coordreq' (top level)"},
      {"/coordreq", "2", "this program reads spec format 1, found 2 (/coordreq)"},
      {"/coordreq", "1.0", "this program reads spec format 1, found 1.0 (/coordreq)"},
      {"/coordreq", "\"1\"", "expected 1, found '1' (/coordreq)"},
      {"", "[]", "expected an object that describes a problem, found an empty list (top level)"},
      {"", "null", "expected an object that describes a problem, found null (top level)"},
  });
}

TEST(SpecError, KeysAreKnownAndPresent) {
  expect_errors({
      {"/stats", "[]", "unknown key 'stats', did you mean 'states'? (top level)"},
      {"/states/0/stpe", "1", "unknown key 'stpe', did you mean 'step'? (/states/0)"},
      {"/disturbances/0/colour", "1",
       "unknown key 'colour', expected 'lower', 'name', 'unit' or 'upper' (/disturbances/0)"},
      {"/output", "{\"layer\": true}", "unknown key 'layer', did you mean 'layers'? (/output)"},
      {"/dynamics", "-", "missing key 'dynamics' (top level)"},
      {"/safe", "-", "missing key 'safe' (top level)"},
      {"/states", "-", "missing key 'states' (top level)"},
      {"/states/1/name", "-", "missing key 'name' (/states/1)"},
      {"/states/0/step", "-", "missing key: one of 'step' or 'count' (/states/0)"},
      {"/states/0/count", "5", "'step' and 'count' exclude each other (/states/0)"},
      {"/inputs/0/step", "-", "missing key: one of 'values', 'step' or 'count' (/inputs/0)"},
      {"/inputs/0/values", "[1]", "'values' and 'lower' exclude each other (/inputs/0)"},
      {"/inputs/1/step", "1", "'step' needs 'lower' (/inputs/1)"},
      {"/inputs/1/upper", "1", "'values' and 'upper' exclude each other (/inputs/1)"},
      {"/dynamics/period", "-", "missing key 'period' (/dynamics)"},
      {"/dynamics/time", "-", "missing key 'time', expected 'continuous' or 'discrete' (/dynamics)"},
      {"/coordination", R"({"horizon": 1, "horizon_time": 1})",
       "'horizon' and 'horizon_time' exclude each other (/coordination)"},
  });
}

TEST(SpecError, ValuesHaveTheRightType) {
  expect_errors({
      {"/states/0/step", "true",
       "expected a number or a string with a constant expression, found true (/states/0/step)"},
      {"/states/0/lower", "[1]",
       "expected a number or a string with a constant expression, found a list of 1 (/states/0/lower)"},
      {"/states/0/discrete", "0", "expected true or false, found 0 (/states/0/discrete)"},
      {"/states", "{}", "expected a list of at least one state, found an object (/states)"},
      {"/states", "[]", "expected a list of at least one state, found an empty list (/states)"},
      {"/inputs", "[]", "expected a list of at least one input, found an empty list (/inputs)"},
      {"/agents", "[]", "expected a list of at least one agent, found an empty list (/agents)"},
      {"/agents/0/inputs", "[]",
       "expected a list of at least one input name, found an empty list (/agents/0/inputs)"},
      {"/agents/0/inputs", "[1]", "expected the name of an input, found 1 (/agents/0/inputs/0)"},
      {"/inputs/1/values", "[]",
       "expected a list of at least one value, found an empty list (/inputs/1/values)"},
      {"/states/0", "\"x1\"", "expected an object that describes a state, found 'x1' (/states/0)"},
      {"/safe", "true", "expected a string with a condition, found true (/safe)"},
      {"/definitions/r2", "1", "expected a string with an expression, found 1 (/definitions/r2)"},
      {"/dynamics/equations/x1", "0",
       "expected a string with an expression, found 0 (/dynamics/equations/x1)"},
      {"/dynamics/time", "\"sampled\"",
       "expected 'continuous' or 'discrete', found 'sampled' (/dynamics/time)"},
      {"/abstraction", R"({"cells": "open"})",
       "expected 'closed' or 'half_open', found 'open' (/abstraction/cells)"},
      {"/controller", R"({"synthesis": true})",
       "expected 'maximal' or 'given', found true (/controller/synthesis)"},
      {"/coordination", R"({"max_delay": -1})",
       "expected null or an integer from 0 to 2147483646, found -1 (/coordination/max_delay)"},
      {"/coordination", R"({"max_delay": 1.5})",
       "expected null or an integer from 0 to 2147483646, found 1.5 (/coordination/max_delay)"},
      {"/coordination", R"({"connection_delay": "2"})",
       "expected an integer from 0 to 2147483646, found '2' (/coordination/connection_delay)"},
      {"/coordination", R"({"connection_delay": 2147483647})",
       "expected an integer from 0 to 2147483646, found 2147483647 (/coordination/connection_delay)"},
      {"/coordination", R"({"partitions": "each"})",
       "expected 'all' or a list of at least one partition, found 'each' (/coordination/partitions)"},
      {"/coordination", R"({"partitions": []})",
       "expected a list of at least one partition, found an empty list (/coordination/partitions)"},
      {"/states/0/outside", "\"unsave\"",
       "expected 'unsafe', 'safe', 'saturate', 'stop', 'periodic', 'goal' or an object with 'below' and "
       "'above', "
       "found "
       "'unsave' (/states/0/outside)"},
      {"/states/0/outside", R"({"below": "wall"})",
       "expected 'unsafe', 'safe', 'saturate', 'stop', 'periodic' or 'goal', found 'wall' "
       "(/states/0/outside/below)"},
      {"/goal", "3",
       "expected a string with a condition, or an object with 'where' and 'then', found 3 (/goal)"},
      {"/goal", R"({"where": "x1 <= 0", "then": "done"})",
       "expected 'safe', 'over', 'stay' or 'return', found 'done' (/goal/then)"},
      {"/goal", R"({"where": "x1 <= 0", "then": true})",
       "expected 'safe', 'over', 'stay' or 'return', found true (/goal/then)"},
      {"/goal", R"({"where": 0, "then": "over"})",
       "expected a string with a condition, found 0 (/goal/where)"},
      {"/goal", R"({"then": "over"})", "missing key 'where' (/goal)"},
      {"/goal", R"({"where": "x1 <= 0"})",
       "missing key 'then', expected 'safe', 'over', 'stay' or 'return' (/goal)"},
      {"/goal", R"({"where": "x1 <= 0", "then": "over", "than": 1})",
       "unknown key 'than', did you mean 'then'? (/goal)"},
      {"/goal", R"({"where": "x1", "then": "over"})",
       "expected a condition, found a number (/goal/where, column 1)"},
      {"/states/0/outside", R"({"left": "safe"})",
       "unknown key 'left', expected 'above' or 'below' (/states/0/outside)"},
  });
}

TEST(SpecError, NamesAreWellFormedAndDifferent) {
  const std::string expected_name =
      "expected a name of at most 200 letters, digits and '_' that does not start with a digit, found ";
  const std::string expected_label =
      "expected a name of at most 200 letters, digits, '_', '.' and '-' that starts with none of '.' and "
      "'-', "
      "found ";
  const std::string expected_title =
      "expected a name of at most 200 letters, digits, blanks, '_', '.' and '-' that starts with none of ' "
      "', '.' "
      "and '-' and does not end with ' ', found ";
  expect_errors({
      {"/name", "\"\"", expected_title + "'' (/name)"},
      {"/name", "\"a/b\"", expected_title + "'a/b' (/name)"},
      {"/name", "\"..\"", expected_title + "'..' (/name)"},
      {"/name", "\"two cars \"", expected_title + "'two cars ' (/name)"},
      {"/agents/0/name", "\"a+b\"", expected_label + "'a+b' (/agents/0/name)"},
      {"/states/0/name", "\"1x\"", expected_name + "'1x' (/states/0/name)"},
      {"/states/0/name", "\"x\\n\"", expected_name + "'x\\u000A' (/states/0/name)"},
      {"/constants/a-b", "1", expected_name + "the key 'a-b' (/constants)"},
      {"/states/1/name", "\"x1\"",
       "the name 'x1' is taken, it stands at /states/0/name too (/states/1/name)"},
      {"/inputs/0/name", "\"x1\"",
       "the name 'x1' is taken, it stands at /states/0/name too (/inputs/0/name)"},
      {"/constants/u1", "1", "the name 'u1' is taken, it stands at /inputs/0/name too (/constants/u1)"},
      {"/definitions/R", "\"1\"", "the name 'R' is taken, it stands at /constants/R too (/definitions/R)"},
      {"/states/0/name", "\"delay\"",
       "'delay' is a dataset of the results file, expected another name (/states/0/name)"},
      {"/inputs/1/name", "\"trigger\"",
       "'trigger' is a dataset of the results file, expected another name (/inputs/1/name)"},
      {"/disturbances/0/name", "\"pi\"",
       "'pi' is a function or keyword, expected another name (/disturbances/0/name)"},
      {"/inputs/0/name", "\"and\"", "'and' is a function or keyword, expected another name (/inputs/0/name)"},
      {"/definitions/sin", "\"1\"",
       "'sin' is a function or keyword, expected another name (/definitions/sin)"},
      {"/agents/1/name", "\"a\"", "the agent 'a' is listed twice (/agents/1/name)"},
  });
}

/// A state called so, in a spec with something more.
std::string error_of_state(const std::string& name, const std::string& addition) {
  nlohmann::json spec = example();
  spec["definitions"] = {{"x1", name}};
  spec["states"][0]["name"] = name;
  spec["dynamics"]["equations"] = {{name, "u1"}, {"x2", "u2"}};
  spec["safe"] = "x1 <= R";
  spec.update(nlohmann::json::parse(addition));
  return error_of(spec);
}

TEST(SpecError, NamesOfDatasetsAreReservedWhereTheyAreWritten) {
  const auto expected = [](const std::string& name) {
    return "'" + name + "' is a dataset of the results file, expected another name (/states/0/name)";
  };
  for (const std::string name : {"collision_time", "delay", "fixed_point_index", "invariant", "layer",
                                 "layer_size", "partition", "safe", "spec", "trigger"})
    EXPECT_EQ(error_of_state(name, "{}"), expected(name));
  const std::vector<std::pair<std::string, std::string>> additions = {
      {"arrival", R"({"goal": "x2 <= 0"})"},
      {"mode", R"({"network": {"delay": 2}})"},
      {"risk", R"({"network": {"loss": 0.1}, "risk": {"horizon": 2}})"},
      {"pair", R"({"coordination": {"horizon": 2}})"},
      {"agent", R"({"coordination": {"convention": true}})"},
      {"counterexample", R"({"requirements": [{"name": "r", "where": "x2 <= 0", "invariant": true}]})"},
      {"controller", R"({"output": {"controller": true}})"},
      {"abstraction", R"({"output": {"abstraction": true}})"}};
  for (const auto& [name, addition] : additions) {
    EXPECT_EQ(error_of_state(name, addition), expected(name));
    EXPECT_EQ(error_of_state(name, "{}"), "");
  }
  for (const std::string name : {"action", "first", "last", "start"})
    EXPECT_EQ(error_of_state(name, "{}"), "");
}

TEST(SpecError, OnlyStatesAndInputsHaveDatasets) {
  for (const std::string name : {"delay", "mode", "safe"}) {
    EXPECT_EQ(error_of(example_with("/constants/" + name, "1")), "");
    EXPECT_EQ(error_of(example_with("/definitions/" + name, "\"x1 + 1\"")), "");
  }
}

TEST(SpecError, ConstantsAndDefinitionsHaveNoCycles) {
  expect_errors({
      {"/constants", R"({"R": "R"})", "cycle of constants: R -> R (/constants/R)"},
      {"/constants", R"({"R": "a/2", "a": "b", "b": "2*R"})",
       "cycle of constants: R -> a -> b -> R (/constants/R)"},
      {"/definitions", R"({"r2": "a", "a": "b + 1", "b": "a"})",
       "cycle of definitions: a -> b -> a (/definitions/a)"},
      {"/constants/a", "\"x1\"", "expected constants only, found the state 'x1' (/constants/a)"},
      {"/constants/a", "\"r2\"", "expected constants only, found the definition 'r2' (/constants/a)"},
      {"/states/0/step", "\"u1\"", "expected constants only, found the input 'u1' (/states/0/step)"},
  });
}

TEST(SpecError, GridsHavePoints) {
  expect_errors({
      {"/states/0/step", "0", "expected a step > 0, found 0 (/states/0/step)"},
      {"/states/0/step", "-0.5", "expected a step > 0, found -0.5 (/states/0/step)"},
      {"/states/0/step", "\"1/0\"", "'1/0' divides by zero (/states/0/step)"},
      {"/states/0/upper", "-2", "expected upper >= lower = -1, found -2 (/states/0/upper)"},
      {"/inputs/0/upper", "-2", "expected upper >= lower = -1, found -2 (/inputs/0/upper)"},
      {"/disturbances/0/upper", "-2", "expected upper >= lower = -1, found -2 (/disturbances/0/upper)"},
      {"/states/0", R"({"name": "x1", "lower": 1, "upper": 2, "step": 3})",
       "no grid point 0 + k*3 lies in [1, 2] (/states/0)"},
      {"/states/0", R"({"name": "x1", "lower": 1, "upper": 2, "count": 1})",
       "one point is lower and upper: expected 1, found 2 (/states/0/upper)"},
      {"/states/0", R"({"name": "x1", "lower": 1, "upper": 1, "count": 1})",
       "the cell of one point needs its width: expected 'step', found 'count' (/states/0/count)"},
      {"/inputs/0", R"({"name": "u1", "lower": 1, "upper": 2, "count": 1})",
       "one point is lower and upper: expected 1, found 2 (/inputs/0/upper)"},
      {"/states/0", R"({"name": "x1", "lower": 1, "upper": 2, "count": 0})",
       "expected an integer >= 1, found 0 (/states/0/count)"},
      {"/states/0", R"({"name": "x1", "lower": 1, "upper": 1, "count": 2})",
       "expected upper > lower = 1, found the same (/states/0/upper)"},
      {"/states/0", R"({"name": "x1", "lower": 1, "upper": 2, "count": 3, "origin": 0})",
       "'origin' needs 'step' (/states/0)"},
      {"/states/0/outside", "\"periodic\"",
       "a periodic state is given with 'count', found 'step' (/states/0/step)"},
      {"/states/0/outside", R"({"above": "periodic"})",
       "expected 'periodic' on both sides, found it on one (/states/0/outside)"},
      {"/states/0/measurement_error", "-1", "expected an error >= 0, found -1 (/states/0/measurement_error)"},
      {"/states/0",
       R"({"name": "x1", "lower": 0, "upper": 1, "step": 1, "discrete": true, "measurement_error": 0.1})",
       "a discrete state cannot have a measurement error (/states/0/measurement_error)"},
      {"/inputs/1/values", "[1, 0.5, \"1/2\"]",
       "repeated value 0.5, the same as number 1 (/inputs/1/values/2)"},
      {"/states/0", R"({"name": "x1", "lower": 1, "upper": "1 + 1e-20", "step": 1e-20})",
       "grid points 1e-20 apart near 1 are equal as doubles (/states/0)"},
  });
}

TEST(SpecError, AgentsShareOutTheInputs) {
  expect_errors({
      {"/agents/0/inputs", R"(["u3"])", "'u3' is not an input, did you mean 'u1'? (/agents/0/inputs/0)"},
      {"/agents/0/inputs", R"(["x1"])", "'x1' is not an input, did you mean 'u1'? (/agents/0/inputs/0)"},
      {"/agents/0/inputs", R"(["u1", "u1"])", "the input 'u1' is listed twice (/agents/0/inputs/1)"},
      {"/agents/0/inputs", R"(["u1", "u2"])",
       "the input 'u2' belongs to the agent 'a' already (/agents/1/inputs/0)"},
      {"/agents/1", "-", "the input 'u2' belongs to no agent (/agents)"},
      {"/agents/0/sees", R"(["x3"])", "'x3' is not a state, did you mean 'x1'? (/agents/0/sees/0)"},
      {"/agents/0/sees", R"(["u1"])", "'u1' is not a state, did you mean 'x1'? (/agents/0/sees/0)"},
      {"/agents/0/sees", R"(["x1", "x1"])", "the state 'x1' is listed twice (/agents/0/sees/1)"},
      {"/agents/0/sees", R"("x1")", "expected a list of state names, found 'x1' (/agents/0/sees)"},
  });
}

TEST(SpecError, DynamicsFitTheStates) {
  nlohmann::json discrete = example_with("/dynamics/time", "\"discrete\"");
  discrete["states"][1]["outside"] = {{"above", "stop"}};
  EXPECT_EQ(error_of(discrete),
            "'stop' is for continuous time, expected 'saturate' or another (/states/1/outside/above)");
  discrete = example_with("/dynamics/time", "\"discrete\"");
  discrete["abstraction"]["between_samples"] = true;
  EXPECT_EQ(
      error_of(discrete),
      "discrete time has nothing between samples, expected false, found true (/abstraction/between_samples)");
  expect_errors({
      {"/dynamics/equations/x2", "-", "missing equation for the state 'x2' (/dynamics/equations)"},
      {"/dynamics/equations/x3", "\"0\"",
       "an equation for 'x3', which is no state, did you mean 'x1'? (/dynamics/equations)"},
      {"/dynamics/period", "0", "expected a period > 0, found 0 (/dynamics/period)"},
      {"/dynamics/period", "\"-1/3\"", "expected a period > 0, found -1/3 (/dynamics/period)"},
      {"/dynamics/unit", "\"seconds Since 1970\"",
       "expected a unit without the word 'since', found 'seconds Since 1970' (/dynamics/unit)"},
      {"/states/0/unit", "\"since\"",
       "expected a unit without the word 'since', found 'since' (/states/0/unit)"},
  });
  EXPECT_EQ(error_of(example_with("/states/0/unit", "\"sincere\"")), "");
}

TEST(SpecError, ExpressionsAreOverWhatTheyMayUse) {
  expect_errors({
      {"/safe", "\"u1 < 1\"", "expected an expression over states, found the input 'u1' (/safe)"},
      {"/definitions/r2", "\"x1 + u2\"", "expected an expression over states, found the input 'u2' (/safe)"},
      {"/safe", "\"w1 < 1\"", "expected an expression over states, found the disturbance 'w1' (/safe)"},
      {"/controller", R"({"allow": "w1 < 1"})",
       "expected an expression over states and inputs, found the disturbance 'w1' (/controller/allow)"},
      {"/agents/0/prefer", "\"w1\"",
       "expected an expression over states and inputs, found the disturbance 'w1' (/agents/0/prefer)"},
      {"/requirements", R"([{"name": "r", "where": "u1 < 1", "invariant": true}])",
       "expected an expression over states, found the input 'u1' (/requirements/0/where)"},
      {"/safe", "\"x1 + 1\"", "expected a condition, found a number (/safe, column 1)"},
      {"/dynamics/equations/x1", "\"x1 < 1\"",
       "expected a number, found a condition (/dynamics/equations/x1, column 1)"},
      {"/safe", "\"x1 < y\"", "'y' is not defined (/safe, column 6)"},
  });
}

TEST(SpecError, LinkCostsAndHorizons) {
  expect_errors({
      {"/coordination", R"({"link_cost": [{"agents": ["a", "c"], "cost": 1}]})",
       "'c' is not an agent (/coordination/link_cost/0/agents/1)"},
      {"/coordination", R"({"link_cost": [{"agents": ["a", "a"], "cost": 1}]})",
       "expected two agents, found one twice (/coordination/link_cost/0/agents)"},
      {"/coordination", R"({"link_cost": [{"agents": ["a"], "cost": 1}]})",
       "expected a list of two agent names, found a list of 1 (/coordination/link_cost/0/agents)"},
      {"/coordination", R"({"link_cost": [{"agents": ["a", "b"], "cost": -1}]})",
       "expected a cost >= 0, found -1 (/coordination/link_cost/0/cost)"},
      {"/coordination",
       R"({"link_cost": [{"agents": ["a", "b"], "cost": 1}, {"agents": ["b", "a"], "cost": 1}]})",
       "the link of 'b' and 'a' is listed twice (/coordination/link_cost/1)"},
      {"/coordination", R"({"link_cost": [{"agents": ["a", "b"], "cost": 1}]})",
       "'link_cost' is for the coalition map, expected 'horizon' or 'horizon_time' beside it "
       "(/coordination/link_cost)"},
      {"/coordination", R"({"horizon": 4, "max_delay": 3})",
       "expected a horizon of at most max_delay = 3 steps, found 4 steps (/coordination/horizon)"},
      {"/coordination", R"({"max_delay": 3, "horizon_time": 3.5})",
       "expected a horizon of at most max_delay = 3 steps, found 4 steps (/coordination/horizon_time)"},
      {"/coordination", R"({"horizon_time": -1})",
       "expected a time >= 0, found -1 (/coordination/horizon_time)"},
      {"/coordination", R"({"horizon_time": 1e10})",
       "expected a time of at most 2147483646 periods, found 10000000000 (/coordination/horizon_time)"},
  });
}

TEST(SpecError, NetworksAreOfOneKind) {
  const std::string modes =
      R"("modes": [{"name": "up", "partition": "a+b"}, {"name": "down", "partition": "a|b"}])";
  expect_errors({
      {"/network", "{}", "missing key: one of 'modes', 'delay', 'burst', 'weakly_hard' or 'loss' (/network)"},
      {"/network", R"({"delay": 1, "burst": {"length": 1, "gap": 1}})",
       "'delay' and 'burst' exclude each other (/network)"},
      {"/network", "{" + modes + "}", "'modes' needs 'transitions' (/network)"},
      {"/network", "{" + modes + R"(, "transitions": [["up", "dwon"]]})",
       "'dwon' is not a mode, did you mean 'down'? (/network/transitions/0/1)"},
      {"/network", "{" + modes + R"(, "transitions": [["up"]]})",
       "expected a list of two mode names, perhaps with a probability, found a list of 1 "
       "(/network/transitions/0)"},
      {"/network", "{" + modes + R"(, "transitions": [["up", "up"], ["up", "up"]]})",
       "the transition from 'up' to 'up' is listed twice (/network/transitions/1)"},
      {"/network", R"({"modes": [{"name": "m", "partition": "a"}], "transitions": [["m", "m"]]})",
       "expected the name of a partition, such as 'a|b', found 'a' (/network/modes/0/partition)"},
      {"/network", R"({"modes": [{"name": "m", "partition": "a|b"}, {"name": "m", "partition": "a|b"}],
                       "transitions": [["m", "m"]]})",
       "the mode 'm' is listed twice (/network/modes/1/name)"},
      {"/network", R"({"weakly_hard": {"misses": 3, "window": 2}})",
       "expected at most window = 2 misses, found 3 (/network/weakly_hard/misses)"},
      {"/network", "{" + modes + R"(, "transitions": [["up", "down"], ["up", "up"]]})",
       "the mode 'down' has no successor (/network/modes/1)"},
      {"/network", "{" + modes + R"(, "transitions": [["up", "up"], ["down", "up"]], "up": "a+b"})",
       "'modes' and 'up' exclude each other (/network)"},
      {"/network", R"({"delay": 1, "down": "c|a"})",
       "expected the name of a partition, such as 'a|b', found 'c|a' (/network/down)"},
      {"/network", R"({"burst": {"length": 0, "gap": 1}})",
       "expected an integer from 1 to 2147483646, found 0 (/network/burst/length)"},
  });
}

}  // namespace
}  // namespace coordreq
