#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "answers/field_table.hpp"
#include "spec/names.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

using Names = std::set<std::string, std::less<>>;

nlohmann::json plain_spec() {
  return nlohmann::json::parse(R"({"coordreq": 1, "name": "names",
"states": [{"name": "x", "lower": 0, "upper": 3, "step": 1}, {"name": "y", "lower": 0, "upper": 3, "step": 1}],
"inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}}, "safe": "x + y <= 5"})");
}

/// The names at the top of a results file, but for states and inputs. Names with a colon cannot clash.
Names written(const ProblemSpec& spec) {
  Names names = {"spec", "spec_json"};  // of every file
  for (const Field& field : result_fields(spec)) {
    const std::string name = field.path.substr(1, field.path.find('/', 1) - 1);
    if (name.find(':') == std::string::npos) names.insert(name);
  }
  for (const StateSpec& state : spec.states) names.erase(state.name);
  for (const InputSpec& input : spec.inputs) names.erase(input.name);
  return names;
}

TEST(DatasetNames, AreThoseOfTheDatasetsThatAreWritten) {
  Names all;
  for (const char* const addition :
       {"{}", R"({"goal": "x >= 2"})", R"({"network": {"delay": 2}})",
        R"({"network": {"loss": 0.1}, "risk": {"horizon": 2}})",
        R"({"network": {"loss": 0.1}, "risk": {"horizon": 2, "start": "drawn"}})",
        R"({"coordination": {"horizon": 2, "convention": false}})",
        R"({"coordination": {"horizon_time": "4/2"}})",
        R"({"coordination": {"convention": true, "max_delay": null}})",
        R"({"requirements": [{"name": "r", "where": "x <= 1 and 0 <= y <= 1", "invariant": true}]})",
        R"({"output": {"controller": true, "layers": false}})", R"({"output": {"actions": true}})",
        R"({"output": {"layers": true}})", R"({"output": {"abstraction": true}})",
        R"({"agents": [{"name": "a", "inputs": ["u"], "sees": ["x"]}, {"name": "b", "inputs": ["v"]}]})",
        R"({"silence": {"actions": {"a": "u <= 0"}}})",
        R"({"silence": {"then": {"a": "u <= 0", "b": "true"}}})",
        R"({"controller": {"file": "other.h5"}})"}) {
    nlohmann::json spec = plain_spec();
    spec.update(nlohmann::json::parse(addition));
    const std::string text = spec.dump();
    const Names reserved = dataset_names(JsonDocument::parse(text, "test").root());
    EXPECT_EQ(reserved, written(read_spec(text, "test"))) << addition;
    all.insert(reserved.begin(), reserved.end());
  }
  EXPECT_EQ(all.size(), 44U);
}

}  // namespace
}  // namespace coordreq
