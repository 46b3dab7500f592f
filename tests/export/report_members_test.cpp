#include "export/report_maps.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "answers/paths.hpp"
#include "cell/analyzed_file.hpp"
#include "export/report_data.hpp"
#include "results/scratch_folder.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using SortedJson = nlohmann::json;

// Two points on a line that must not meet; the connection is lost for the first six steps.
constexpr char kMembersSpec[] = R"json({
  "coordreq": 1, "name": "line",
  "states": [
    {"name": "x", "lower": 0, "upper": 9, "step": 1, "outside": "saturate"},
    {"name": "y", "lower": 0, "upper": 9, "step": 1, "outside": "saturate"}],
  "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
  "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
  "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}},
  "safe": "y - x >= 1",
  "abstraction": {"cells": "half_open", "safe": "center"},
  "coordination": {"partitions": "all", "horizon": 2, "convention": true},
  "network": {"delay": 6}})json";

class ReportMembersOfLine : public testing::Test {
 protected:
  ReportMembersOfLine() {
    ThreadTeam team(2);
    analyze_into(folder_ / "line.h5", kMembersSpec, "", team);
    results_ = std::make_unique<ResultsReader>(folder_ / "line.h5");
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const NetworkModeSpec& mode : results_->spec().network->modes) names.push_back(mode.name);
    return names;
  }
  [[nodiscard]] MemberMap modes(std::size_t most, std::size_t most_sets) const {
    const auto read = [this](std::size_t mode, const CellBlock& block) {
      return results_->members(results_->field("/network_safe"), mode, block);
    };
    return {*results_, read, names(), most, most_sets};
  }

  /// Every cell has the members that the file has, and the flags of cells that are lost.
  void expect_true(MemberMap& map) const {
    const CellBlock all = all_cells(results_->grid());
    const std::vector<std::int32_t> values = map.read(all);
    ASSERT_TRUE(map.fits());
    const std::vector<std::uint8_t> safe = results_->members(paths::kSafe, all),
                                    kept = results_->members(paths::kInvariant, all);
    for (std::size_t mode = 0; mode < map.names().size(); ++mode) {
      const std::vector<std::uint8_t> expected =
          results_->members(results_->field("/network_safe"), mode, all);
      for (std::size_t x = 0; x < values.size(); ++x) {
        if (kept[x] == 0) {
          ASSERT_EQ(values[x], safe[x] == 0 ? -2 : -1);
          continue;
        }
        const std::uint64_t set = std::stoull(map.sets()[static_cast<std::size_t>(values[x])], nullptr, 16);
        ASSERT_EQ(set >> mode & 1U, expected[x]) << "mode " << mode << ", cell " << x;
      }
    }
  }

  sample::ScratchFolder folder_;
  std::unique_ptr<ResultsReader> results_;
};

TEST_F(ReportMembersOfLine, SetsAreThoseOfTheFile) {
  MemberMap map = modes(64, 100);
  expect_true(map);
  EXPECT_EQ(map.names(), names());
  EXPECT_GT(map.sets().size(), 3);
  MemberMap first = modes(2, 100);
  expect_true(first);
  const std::vector<std::string> all = names();
  EXPECT_EQ(first.names(), std::vector<std::string>(all.begin(), all.begin() + 2));
  EXPECT_EQ(first.total(), all.size());
}

TEST_F(ReportMembersOfLine, HalfOfTheMembersHaveFewerSets) {
  MemberMap map = modes(64, 3);
  static_cast<void>(map.read(all_cells(results_->grid())));
  EXPECT_FALSE(map.fits());
  while (!map.fits()) {
    map.halve();
    static_cast<void>(map.read(all_cells(results_->grid())));
  }
  EXPECT_LT(map.names().size(), names().size());
  expect_true(map);
}

TEST_F(ReportMembersOfLine, APageSaysHowManyThereAre) {
  const SortedJson json = SortedJson::parse(report_data(*results_, {0, 1}, {.subsets = 3}).json);
  std::vector<std::string> kinds;
  for (const SortedJson& map : json["maps"]) kinds.push_back(map["kind"]);
  EXPECT_EQ(kinds, (std::vector<std::string>{"delay", "delay", "collision_time", "coalition", "pairs",
                                             "modes", "freedom", "freedom"}));
  const SortedJson& modes = json["maps"][5];
  EXPECT_LT(modes["members"].size(), names().size());
  EXPECT_EQ(modes["total"], names().size());
  EXPECT_LE(modes["sets"].size(), 3);
  EXPECT_EQ(json["maps"][3]["choices"], SortedJson::parse(R"([{"partition": 1, "cost": 0.0},
                                                        {"partition": 0, "cost": 1.0}])"));
}

}  // namespace
}  // namespace coordreq
