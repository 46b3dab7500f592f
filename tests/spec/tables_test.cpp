#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "example_spec.hpp"
#include "expression/evaluate.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

nlohmann::json with_table(const std::string& table, const std::string& equation = "u1 + t(x1)") {
  nlohmann::json spec = test::example();
  spec["tables"] = nlohmann::json::parse(R"({"t": )" + table + "}");
  spec["dynamics"]["equations"]["x1"] = equation;
  return spec;
}

constexpr const char* kTable = R"({"x": [-2, 0, 3], "value": [1, "R/4", 2]})";

TEST(Tables, AreFunctionsInAllExpressionsButConstants) {
  nlohmann::json spec = with_table(kTable, "speed + t(u1)");
  spec["definitions"]["speed"] = "t(x1)";
  spec["memory"] = {{"seen", "once(t(x2) > 1)"}};
  spec["safe"] = "t(x1) < 2 and not seen";
  spec["states"][1]["upper"] = "t(-2)";
  const ProblemSpec read = test::read(spec);
  EXPECT_EQ(read.states[1].upper, 1);
  std::vector<double> slots(read.slot_count(), 0.0);
  slots[0] = -1.0;
  EXPECT_DOUBLE_EQ(Evaluator<double>(read.dynamics.equations[0]).number(slots), 0.6 + 0.2);
  spec["constants"]["c"] = "t(1)";
  EXPECT_EQ(test::error_of(spec), "expected constants only, found the table 't' (/constants/c)");
}

TEST(Tables, AxesAscend) {
  EXPECT_EQ(test::error_of(with_table(R"({"x": [0, 1, "1"], "value": [0, 1, 2]})")),
            "expected a number > 1, found 1 (/tables/t/x/2)");
  EXPECT_EQ(
      test::error_of(with_table(R"({"x": [0, 1], "y": [1, 0.5], "value": [[0, 1], [1, 2]]})", "t(x1, x2)")),
      "expected a number > 1, found 0.5 (/tables/t/y/1)");
}

TEST(Tables, HaveLimits) {
  nlohmann::json spec = with_table(kTable);
  spec["tables"]["t"]["x"] = nlohmann::json::array();
  spec["tables"]["t"]["value"] = nlohmann::json::array();
  for (int i = 0; i < 100; ++i) {
    spec["tables"]["t"]["x"].push_back(i - 50);
    spec["tables"]["t"]["value"].push_back(i * i * (100 - i));
  }
  EXPECT_EQ(test::error_of(spec), "");
  spec["tables"]["t"]["x"].push_back(200);
  EXPECT_EQ(test::error_of(spec), "expected 2 to 100 numbers, found 101 (/tables/t/x)");
}

TEST(Tables, ReadNoFilesWithoutTheFolderOfTheSpec) {
  EXPECT_EQ(test::error_of(with_table(R"({"file": "t.csv"})")),
            "a file can be read for a spec in a file only (/tables/t/file)");
}

}  // namespace
}  // namespace coordreq
