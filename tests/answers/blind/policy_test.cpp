#include "answers/blind/answer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <vector>

#include "answers/paths.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int32_t kForEver = std::numeric_limits<std::int32_t>::max();

/// A line of five closed cells: where a cell ends the next one begins, so that a step leads to three.
constexpr char kLine[] = R"({"coordreq": 1, "name": "line",
"states": [{"name": "x", "lower": 0, "upper": 4, "step": 1, "outside": "safe"},
           {"name": "m", "lower": 0, "upper": 1, "step": 1, "discrete": true, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [0, 1, 9]}, {"name": "v", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u"], "sees": ["m"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "m": "m"}}, "safe": "true"})";

/// Rows told apart by their numbers: byte 1 for one step, 2 for two, 3 for three, with m in bit 2.
class Tables : public ByteTables {
 public:
  [[nodiscard]] std::int64_t length(const std::string& scale) const override {
    EXPECT_EQ(scale, "/silent_layer");
    return 3;
  }
  [[nodiscard]] std::vector<std::uint8_t> bytes(const std::string& path,
                                                const std::vector<std::int64_t>& indices) const override {
    EXPECT_EQ(path, "/silent/a|b/a");
    EXPECT_EQ(indices.size(), 2U);
    return {static_cast<std::uint8_t>(static_cast<unsigned>(indices[0] + 1) |
                                      static_cast<unsigned>(indices[1]) << 2U)};
  }
};

class BlindPolicyTest : public testing::Test {
 protected:
  BlindPolicyTest()
      : spec_(read_spec(kLine, "test")), team_(1), abstraction_(build_abstraction(spec_, team_)) {}

  std::unique_ptr<CellPolicy> policy() {
    return blind_policies(spec_).front().make({.spec = &spec_,
                                               .partition = &spec_.coordination.partitions.front(),
                                               .tables = &tables_,
                                               .posts = &posts_,
                                               .values = [this](const std::string& path) -> CellValue {
                                                 EXPECT_EQ(path, paths::kBlindCountdown);
                                                 return
                                                     [this](std::int64_t cell) { return countdown_[cell]; };
                                               }});
  }
  /// By x where m is 0.
  void set_countdowns(const std::vector<std::int32_t>& steps) {
    for (std::size_t x = 0; x < steps.size(); ++x) countdown_[static_cast<std::int64_t>(2 * x)] = steps[x];
  }
  [[nodiscard]] std::int64_t input(std::int64_t u) const { return u * 2; }

  ProblemSpec spec_;
  ThreadTeam team_;
  Abstraction abstraction_;
  CellPosts posts_{abstraction_};
  Tables tables_;
  std::map<std::int64_t, std::int32_t> countdown_;
};

using Numbers = CellPolicy::Numbers;

TEST_F(BlindPolicyTest, CountsDownFromTheLeastOfAllCellsThatMayBeNext) {
  set_countdowns({9, 3, 8, 5, kForEver});
  const auto blind_policy = policy();
  EXPECT_EQ(blind_policy->countdown_after(4, input(0)), 3);         // cells 1, 2 and 3
  EXPECT_EQ(blind_policy->countdown_after(4, input(1)), 5);         // 2, 3 and 4
  EXPECT_EQ(blind_policy->countdown_after(8, input(0)), 5);         // 3 and 4, or beyond the safe side
  EXPECT_EQ(blind_policy->countdown_after(8, input(2)), kForEver);  // all is beyond it
}

TEST_F(BlindPolicyTest, TakesTheRowOfWhatTheClassSees) {
  const auto blind_policy = policy();
  const std::vector<InputClass> classes =
      input_classes(spec_, abstraction_.inputs, spec_.coordination.partitions.front());
  const Numbers together{0, 1};
  EXPECT_EQ(blind_policy->alone(4, 1, together, classes), (std::vector<Numbers>{{0}, {0, 1}}));
  EXPECT_EQ(blind_policy->alone(4, 2, together, classes), (std::vector<Numbers>{{1}, {0, 1}}));
  EXPECT_EQ(blind_policy->alone(5, 2, together, classes), (std::vector<Numbers>{{1, 2}, {0, 1}}));
  EXPECT_EQ(blind_policy->alone(4, 4, together, classes),
            (std::vector<Numbers>{{0, 1}, {0, 1}}));  // the last row
  EXPECT_EQ(blind_policy->alone(4, kForEver, together, classes), (std::vector<Numbers>{{0, 1}, {0, 1}}));
  EXPECT_EQ(blind_policy->alone(4, 0, together, classes), (std::vector<Numbers>{{}, {}}));
}

}  // namespace
}  // namespace coordreq
