#include "results/controller_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.hpp"
#include "scratch_folder.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// x: 3 points, y: 2 points; u listed backwards, v a single value.
ProblemSpec problem() {
  return read_spec(R"({"coordreq": 1, "name": "p",
"states": [{"name": "x", "lower": 0, "upper": 0.2, "step": 0.1}, {"name": "y", "lower": 1, "upper": 2, "step": 1}],
"inputs": [{"name": "u", "values": [1, 0, -1]}, {"name": "v", "values": [5]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}}, "safe": "true"})",
                   "test");
}

const std::string kGrid =
    "#SCOTS:v0.2\n#TYPE:STATICCONTROLLER\n"
    "#SCOTS:STATE_SPACE\n#TYPE:UNIFORMGRID\n#MEMBER:DIM\n2\n"
    "#VECTOR:ETA\n#BEGIN:2\n0.10000000000000001\n1\n#END\n"
    "#VECTOR:LOWER_LEFT\n#BEGIN:2\n0\n1\n#END\n"
    "#VECTOR:UPPER_RIGHT\n#BEGIN:2\n0.20000000000000004\n2\n#END\n"
    "#SCOTS:INPUT_SPACE\n#TYPE:UNIFORMGRID\n#MEMBER:DIM\n2\n"
    "#VECTOR:ETA\n#BEGIN:2\n1\n0.3\n#END\n"
    "#VECTOR:LOWER_LEFT\n#BEGIN:2\n-1\n5\n#END\n"
    "#VECTOR:UPPER_RIGHT\n#BEGIN:2\n1\n5\n#END\n";
const std::string kHead = kGrid +
                          "#TYPE:WINNINGDOMAIN\n#SCOTS:i (state) j_0 ... j_n (valid inputs)\n"
                          "#MATRIX:DATA\n#BEGIN:6 3\n";

class ScotsController : public ::testing::Test {
 protected:
  PackedPairs read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_scots_controller(path_, problem());
  }
  std::string complaint(const std::string& text) {
    try {
      static_cast<void>(read(text));
    } catch (const ControllerError& error) {
      const std::string what = error.what();
      const std::size_t at = what.find(path_);
      return at == std::string::npos ? what : what.substr(0, at) + what.substr(at + path_.size());
    }
    return "";
  }
  static std::string with(std::string text, const std::string& old, const std::string& now) {
    return text.replace(text.find(old), old.size(), now);
  }

  sample::ScratchFolder folder_;
  std::string path_ = folder_ / "c.scs";
};

TEST_F(ScotsController, CountsWithDimension0FastestAndValuesAscending) {
  const PackedPairs pairs = read(kHead + "1 0 2 \n5 1\n3\n#END\n");
  EXPECT_EQ(pairs.inputs, 3);
  std::vector<std::pair<int, int>> found;
  for (int cell = 0; cell < 6; ++cell) {
    for (int u = 0; u < 3; ++u) {
      if (pairs.test(cell, u)) found.emplace_back(cell, u);
    }
  }
  // State 1 is (x = 0.1, y = 1), cell 2; state 5 is (0.2, 2), cell 5. Input 0 is u = -1, the last one listed.
  EXPECT_EQ(found, (std::vector<std::pair<int, int>>{{2, 0}, {2, 2}, {5, 1}}));
}

TEST_F(ScotsController, ToleratesNoiseBlankLinesAndOtherEndsOfLines) {
  std::string text = kHead + "0 0\n\n#END\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  EXPECT_TRUE(read(text).test(0, 2));
  EXPECT_TRUE(read(with(kHead, "\n0\n1\n#END", "\n-1e-17\n1.0000001\n#END") + "0 0\n#END\n").test(0, 2));
}

TEST_F(ScotsController, NamesLineSectionFoundAndExpected) {
  EXPECT_EQ(complaint("#SCOTS:v0.1\n"), "found '#SCOTS:v0.1', expected '#SCOTS:v0.2' (, line 1)");
  EXPECT_EQ(complaint("#SCOTS:v0.2\n#TYPE:SYMBOLICSET\n"),
            "found '#TYPE:SYMBOLICSET', expected '#TYPE:STATICCONTROLLER' (, line 2)");
  EXPECT_EQ(complaint(with(kHead, "DIM\n2", "DIM\n3")),
            "STATE_SPACE: found 3 dimensions, expected 2 (, line 6)");
  EXPECT_EQ(complaint(with(kHead, "0.10000000000000001", "0.2")),
            "STATE_SPACE: ETA of x is 0.2, expected 0.1 (, line 9)");
  EXPECT_EQ(complaint(with(kHead, "\n0\n1\n", "\n0.01\n1\n")),
            "STATE_SPACE: LOWER_LEFT of x is 0.01, expected 0 (, line 14)");
  EXPECT_EQ(complaint(with(kHead, "-1\n5\n", "-2\n5\n")),
            "INPUT_SPACE: LOWER_LEFT of u is -2, expected -1 (, line 33)");
  EXPECT_EQ(complaint(with(kHead, "1\n5\n#END\n#TYPE", "1\n6\n#END\n#TYPE")),
            "INPUT_SPACE: UPPER_RIGHT of v is 6, expected 5 (, line 39)");
  EXPECT_EQ(complaint(with(kHead, "#BEGIN:2", "#BEGIN:1")), "found 1 of ETA, expected 2 (, line 8)");
  EXPECT_EQ(complaint(with(kHead, "0.3", "wide")), "found 'wide', expected a number (, line 29)");
  EXPECT_EQ(complaint(with(kHead, "#BEGIN:6 3", "#BEGIN:6 4")),
            "found a matrix of 6 4 states and inputs, expected 6 3 (or 6 1: one input a state) (, line 44)");
  EXPECT_EQ(complaint(kHead + "6 0\n#END\n"),
            "WINNINGDOMAIN: found state 6, expected one below 6 (, line 45)");
  EXPECT_EQ(complaint(kHead + "0 3\n#END\n"),
            "WINNINGDOMAIN: found input 3, expected one below 3 (, line 45)");
  EXPECT_EQ(complaint(kHead + "1 0\n1 2\n#END\n"), "WINNINGDOMAIN: state 1 is listed twice (, line 46)");
  EXPECT_EQ(complaint(kHead + "1 x\n"), "found '1 x', expected natural numbers (, line 45)");
  EXPECT_EQ(complaint(kHead + "1 -1\n"), "found '1 -1', expected natural numbers (, line 45)");
  EXPECT_EQ(complaint(kHead + "1 0\n"), "the file ends, expected #END (, line 45)");
}

TEST_F(ScotsController, OfAReachabilityGameNamesOneInputAState) {
  const std::string head = with(kHead, "#BEGIN:6 3", "#BEGIN:6 1");
  const PackedPairs pairs = read(head + "1 0\n3 2\n5 1\n#END\n");
  EXPECT_EQ(pairs.count(), 3);
  EXPECT_TRUE(pairs.test(2, 2) && pairs.test(1, 0) && pairs.test(5, 1));
  EXPECT_EQ(complaint(head + "1 3\n#END\n"),
            "WINNINGDOMAIN: found input 3, expected one below 3 (, line 45)");
  EXPECT_EQ(
      complaint(head + "0 0\n1 0 2\n#END\n"),
      "WINNINGDOMAIN: found 2 inputs of state 1, expected one, as the matrix has one column (, line 46)");
  EXPECT_EQ(
      complaint(head + "1\n#END\n"),
      "WINNINGDOMAIN: found 0 inputs of state 1, expected one, as the matrix has one column (, line 45)");
}

TEST_F(ScotsController, RefusesListsThatScotsDoesNotKnow) {
  ProblemSpec uneven = problem();
  uneven.inputs[0].values[1] = Rational(1, 2);
  std::ofstream(path_) << kHead << "#END\n";
  EXPECT_THROW(check_scots_controller(path_, uneven), ControllerError);
}

}  // namespace
}  // namespace coordreq
