#include "cell/log_judge.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "base/error.hpp"
#include "cell/analyzed_file.hpp"
#include "cell/loop_fixture.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

using test::line_spec;
using Rows = std::vector<JudgedRow>;

/// x goes to x + u + v on 0, ..., 8, and 8.5 is the end: a pushes, b holds back.
const std::string kEdges = R"({"below": "saturate", "above": "unsafe"})";
const std::string kAgents = R"({"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]})";

class Analyzed {
 public:
  explicit Analyzed(const std::string& spec) : team_(1) {
    analyze_into(folder_ / "out.h5", spec, "", team_);
    results_.emplace(folder_ / "out.h5");
  }

  [[nodiscard]] Rows judge(const std::string& text) {
    std::istringstream stream(text);
    LogReader log(stream, results_->spec(), "log");
    LogJudge judge(*results_, 0, log, team_);
    Rows rows;
    while (std::optional<JudgedRow> row = judge.next()) rows.push_back(std::move(*row));
    return rows;
  }
  [[nodiscard]] std::string defect(const std::string& text) {
    try {
      static_cast<void>(judge(text));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] const ResultsReader& results() const { return *results_; }

 private:
  sample::ScratchFolder folder_;
  ThreadTeam team_;
  std::optional<ResultsReader> results_;
};

/// A letter for each row: 1 found, 0 not, - not judged.
std::string found(const Rows& rows, LogFinding finding) {
  std::string text;
  for (const JudgedRow& row : rows) {
    const std::optional<bool> own = row.found(finding);
    text += own ? (*own ? '1' : '0') : '-';
  }
  return text;
}

std::string countdowns(const Rows& rows) {
  std::string text;
  for (const JudgedRow& row : rows) text += row.countdown ? std::to_string(*row.countdown) : "-";
  return text;
}

// Two vehicles that may not be at the far corner together: delays are 3, 2, 1, 0 on the way there.
std::string corner_spec(const std::string& more = "") {
  return R"({"coordreq": 1, "name": "corner", "states": [
    {"name": "x", "lower": 0, "upper": 4, "step": 1}, {"name": "y", "lower": 0, "upper": 4, "step": 1}],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 0.5, "equations": {"x": "x + u", "y": "y + v"}},
    "safe": "x + y <= 6", "abstraction": {"cells": "half_open", "safe": "center"})" +
         more + "}";
}

TEST(LogJudge, CountsDownAndBeginsAnewAfterContact) {
  Analyzed corner(corner_spec());
  const Rows rows =
      corner.judge("x,y,u,v,connected\n0,0,1,1,0\n1,1,1,0,0\n2,1,0,1,0\n2,2,-1,-1,1\n1,1,1,1,0\n2,2,,,\n");
  EXPECT_EQ(countdowns(rows), "321021");
  EXPECT_EQ(found(rows, LogFinding::breach), "00000-");
  EXPECT_EQ(found(rows, LogFinding::not_coordinated), "---0--");
  EXPECT_EQ(found(rows, LogFinding::off_model), "00000-");
  EXPECT_EQ(found(rows, LogFinding::reckless), "00000-");
}

TEST(LogJudge, SilenceAtZeroIsABreach) {
  Analyzed corner(corner_spec());
  const Rows rows =
      corner.judge("x,y,u,v,connected\n2,2,0,0,0\n2,2,0,0,0\n2,2,0,0,0\n2,2,0,0,1\n2,2,0,0,0\n");
  EXPECT_EQ(countdowns(rows), "10001");
  EXPECT_EQ(found(rows, LogFinding::breach), "01100");
  EXPECT_TRUE(rows[1].is_silent_too_long);
  EXPECT_FALSE(rows[1].tolerates_less);
}

TEST(LogJudge, AConnectionThatTakesTimeMustStandWhereTheDelayIsShorter) {
  Analyzed corner(corner_spec(R"(, "coordination": {"connection_delay": 2})"));
  const Rows rows = corner.judge("x,y,u,v,connected\n1,1,1,1,0\n2,2,0,0,0\n2,2,0,0,1\n2,2,0,0,0\n");
  EXPECT_EQ(countdowns(rows), "2100");
  EXPECT_EQ(found(rows, LogFinding::breach), "0001");
}

TEST(LogJudge, ACellThatToleratesLessThanWasPromisedIsABreachOnce) {
  Analyzed corner(corner_spec());
  const Rows rows = corner.judge("x,y,u,v,connected\n0,0,1,1,0\n3,2,0,0,0\n3,2,0,0,1\n");
  EXPECT_EQ(countdowns(rows), "300");
  EXPECT_EQ(found(rows, LogFinding::breach), "010");
  EXPECT_TRUE(rows[1].tolerates_less);
  EXPECT_EQ(found(rows, LogFinding::off_model), "10-");
  EXPECT_EQ(rows[0].misfit->state, 0u);
  EXPECT_EQ(rows[0].misfit->found, 3);
  EXPECT_EQ(rows[0].misfit->lower, Rational(1, 2));
  EXPECT_EQ(rows[0].misfit->upper, Rational(3, 2));
}

TEST(LogJudge, LeavingTheSetWhileACountdownRunsIsABreach) {
  Analyzed corner(corner_spec());
  const Rows rows = corner.judge("x,y,u,v,connected\n2,2,1,1,0\n4,4,0,0,0\n9,9,0,0,0\n2,2,0,0,0\n");
  EXPECT_EQ(found(rows, LogFinding::breach), "01-0");
  EXPECT_EQ(found(rows, LogFinding::unsafe), "01-0");
  EXPECT_EQ(found(rows, LogFinding::outside), "0010");
  EXPECT_EQ(countdowns(rows), "1--1");
}

TEST(LogJudge, WithoutAWordAboutContactOnlyWhatIsCertainIsFound) {
  Analyzed corner(corner_spec());
  // At 3, 2 a and b may not both go up: that nobody agreed on, and at 2, 2 anything may have been.
  const Rows rows = corner.judge("x,y,u,v\n2,2,0,0\n2,2,1,0\n3,2,1,1\n4,3,,\n");
  EXPECT_EQ(countdowns(rows), "110-");
  EXPECT_EQ(found(rows, LogFinding::breach), "--1-");
  EXPECT_EQ(found(rows, LogFinding::not_coordinated), "----");
  EXPECT_EQ(found(corner.judge("x,y\n2,2\n3,3\n"), LogFinding::breach), "--");
}

TEST(LogJudge, RecklessIsWhoTakesWhatIsNotInItsProjection) {
  Analyzed corner(corner_spec());
  const Rows rows = corner.judge("x,y,u,v\n0,3,-1,1\n4,2,0,1\n2,2,0.5,0\n2,2,,0\n");
  EXPECT_EQ(rows[0].is_reckless, (std::vector<std::optional<bool>>{true, false}));
  EXPECT_EQ(rows[1].is_reckless, (std::vector<std::optional<bool>>{false, false}));
  EXPECT_EQ(rows[2].is_reckless, (std::vector<std::optional<bool>>{true, false}));
  EXPECT_EQ(rows[2].unknown_inputs, std::vector<std::size_t>{0});
  EXPECT_EQ(rows[3].is_reckless, (std::vector<std::optional<bool>>{std::nullopt, false}));
  EXPECT_EQ(found(rows, LogFinding::off_model), "11--");
  EXPECT_EQ(found(rows, LogFinding::not_coordinated), "----");
}

TEST(LogJudge, ConnectedAgentsTakeAJointInputOfTheController) {
  Analyzed corner(corner_spec());
  EXPECT_EQ(found(corner.judge("x,y,u,v,connected\n3,2,1,1,1\n3,2,1,0,1\n3,2,1,1,0\n3,2,1,,1\n"),
                  LogFinding::not_coordinated),
            "10--");
}

TEST(LogJudge, MissingSamplesAreNoStep) {
  Analyzed corner(corner_spec());
  const Rows rows = corner.judge("t,x,y,u,v,connected\n0,2,2,0,0,0\n0.6,2,2,0,0,0\n2.1,4,0,0,0,0\n");
  EXPECT_EQ(found(rows, LogFinding::off_model), "0--");
  EXPECT_EQ(found(rows, LogFinding::breach), "010");
  EXPECT_TRUE(rows[2].is_after_gap);
  EXPECT_EQ(corner.defect("t,x,y\n0,2,2\n0.7,2,2\n"),
            "found 0.7 after 0, expected one period more, 0.5, or several (log, line 3, t)");
  EXPECT_EQ(corner.defect("t,x,y\n1,2,2\n0.5,2,2\n"),
            "found 0.5 after 1, expected one period more, 0.5, or several (log, line 3, t)");
}

TEST(LogJudge, AStateAsGoodAsOnAFaceIsInBothCells) {
  Analyzed corner(corner_spec());
  EXPECT_EQ(corner.judge("x,y\n1.50000001,2\n").front().position.cells, (std::vector<std::int64_t>{12, 7}));
  EXPECT_EQ(corner.judge("x,y\n1.501,2\n").front().position.cells, (std::vector<std::int64_t>{12}));
  // Of the two cells one bears it out.
  const std::string up = ",1,1,1\n4,3,,,\n";
  EXPECT_EQ(found(corner.judge("x,y,u,v,connected\n3.4999999999,2" + up), LogFinding::not_coordinated), "1-");
  EXPECT_EQ(found(corner.judge("x,y,u,v,connected\n2.5,2" + up), LogFinding::not_coordinated), "0-");
  EXPECT_EQ(found(corner.judge("x,y,u,v\n1,1,0,0\n1.50000001,1,,\n"), LogFinding::off_model), "0-");
  EXPECT_EQ(found(corner.judge("x,y,u,v\n1,1,0,0\n1.6,1,,\n"), LogFinding::off_model), "1-");
  EXPECT_EQ(found(corner.judge("x,y,u,v\n1,1,0,0.99999999\n1,2,,\n"), LogFinding::off_model), "0-");
}

TEST(LogJudge, NothingIsPromisedOrBrokenWhereAllIsSafe) {
  Analyzed line(line_spec(9, "x + u + v", R"({"below": "saturate", "above": "safe"})", kAgents));
  const Rows rows = line.judge("x,u,v,connected\n8,1,0,0\n9,1,0,0\n9,0,0,0\n8,0,0,0\n");
  EXPECT_EQ(found(rows, LogFinding::breach), "0--0");
  EXPECT_EQ(found(rows, LogFinding::outside), "0000");
}

TEST(LogJudge, ASideThatHoldsBackIsNotPassed) {
  Analyzed line(line_spec(9, "x + u + v", R"({"below": "saturate", "above": "safe"})", kAgents));
  const Rows rows = line.judge("x,u,v\n0,0,-1\n0,0,-1\n-1,0,0\n8,1,0\n9,0,0\n9,,\n");
  EXPECT_EQ(found(rows, LogFinding::off_model), "01-0--");
  EXPECT_EQ(found(rows, LogFinding::outside), "001000");
}

TEST(LogJudge, MemoriesFollowTheCells) {
  Analyzed line(line_spec(9, "x + u + v", kEdges, kAgents, R"json(, "memory": {"was": "once(x >= 6)"})json"));
  const auto remembered = [](const Rows& rows) {
    std::vector<Rational> values;
    for (const JudgedRow& row : rows) values.push_back(row.position.state[1]);
    return values;
  };
  const Rows rows = line.judge("x,u,v\n5,1,0\n6,0,-1\n5,0,-1\n4,,\n");
  EXPECT_EQ(remembered(rows), (std::vector<Rational>{0, 0, 1, 1}));
  EXPECT_EQ(found(rows, LogFinding::off_model), "000-");
  // Where the log says what is remembered that is judged, too.
  const Rows told = line.judge("x,was_past,u,v\n6,0,0,-1\n5,0,0,0\n5,1,,\n");
  EXPECT_EQ(remembered(told), (std::vector<Rational>{0, 0, 1}));
  EXPECT_EQ(found(told, LogFinding::off_model), "11-");
  EXPECT_EQ(told[0].misfit->state, 1u);
}

LogRow first_row(const std::string& text, const ProblemSpec& spec) {
  std::istringstream stream(text);
  return LogReader(stream, spec, "log").next().value();
}

TEST(LogReader, TakesInputsTimeAndContactByName) {
  const ProblemSpec spec = read_spec(corner_spec(), "test");
  const std::string json =
      R"({"x": 2, "y": "1/2", "v": null, "u": 0.1, "connected": 1, "t": "1/3", "z": []})";
  for (const std::string& text : {std::string("t, v,u,x,y,connected,z\n1/3,,0.1,2,0.5,1,[]\n"), json}) {
    const LogRow row = first_row(text, spec);
    EXPECT_EQ(row.state, (std::vector<Rational>{2, Rational(1, 2)}));
    EXPECT_EQ(row.inputs, (std::vector<std::optional<Rational>>{Rational(1, 10), std::nullopt}));
    EXPECT_EQ(row.time, Rational(1, 3));
    EXPECT_EQ(row.connected, true);
  }
  EXPECT_EQ(first_row("x,y\n1,2\n", spec).connected, std::nullopt);
}

TEST(LogReader, SaysWhereALogIsWrong) {
  Analyzed corner(corner_spec());
  EXPECT_EQ(corner.defect("x,y,connected\n1,1,yes\n"),
            "expected 0 or 1, found 'yes' (log, line 2, connected)");
  EXPECT_EQ(corner.defect("x,y,u\n1,1,fast\n"), "'fast' is not defined (log, line 2, u, column 1)");
  EXPECT_EQ(corner.defect("x,y,u,u\n1,1,0,0\n"), "'u' is given twice (log, line 1)");
  EXPECT_EQ(corner.defect("x,u\n1,0\n"), "no column for the state 'y'; no state is 'u' (log, line 1)");
}

}  // namespace
}  // namespace coordreq
