// What simulate() writes is judged without a finding, and random logs are judged as the definitions have it.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/analyze.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/step_codes.hpp"
#include "base/json.hpp"
#include "cell/closed_loop.hpp"
#include "cell/log_judge.hpp"
#include "cell/simulate.hpp"
#include "reach/build_abstraction.hpp"
#include "results/scratch_folder.hpp"
#include "spec/read_spec.hpp"
#include "support/members.hpp"
#include "support/plain_engine.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

std::string shortest(double value) {
  return Json(value).dump();
}

/// A line of column names, and then lines.
class LogText {
 public:
  LogText(const ProblemSpec& spec, const InputSpace& inputs, bool has_contact)
      : inputs_(inputs), has_contact_(has_contact) {
    for (const StateSpec& state : spec.states) names_ += state.name + ",";
    for (const InputSpec& input : spec.inputs) names_ += input.name + ",";
    names_ += has_contact ? "connected\n" : "t\n";
    period_ = spec.dynamics.period;
  }

  /// @param u no number of a joint input: none is logged
  void add(const std::vector<double>& state, std::int64_t u, bool is_connected) {
    for (const double value : state) lines_ += shortest(value) + ",";
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const auto value = [&] { return inputs_[i].values[static_cast<std::size_t>(inputs_.index(u, i))]; };
      lines_ += (u < 0 ? "" : shortest(nearest_double(value()))) + ",";
    }
    const std::string contact = u < 0 ? "" : is_connected ? "1" : "0";
    lines_ += (has_contact_ ? contact : to_text(period_ * Rational(static_cast<long>(rows_)))) + "\n";
    ++rows_;
  }
  [[nodiscard]] std::string text() const { return names_ + lines_; }

 private:
  const InputSpace& inputs_;
  bool has_contact_;
  Rational period_;
  std::string names_, lines_;
  std::int64_t rows_ = 0;
};

std::vector<JudgedRow> judge(const ResultsReader& results, std::size_t partition, const LogText& text,
                             ThreadTeam& team) {
  std::istringstream stream(text.text());
  LogReader log(stream, results.spec(), "log");
  LogJudge judge(results, partition, log, team);
  std::vector<JudgedRow> rows;
  while (std::optional<JudgedRow> row = judge.next()) rows.push_back(std::move(*row));
  return rows;
}

void expect_nothing_found(const std::vector<JudgedRow>& rows, const std::string& log) {
  for (const JudgedRow& row : rows) {
    for (std::size_t f = 0; f < kLogFindings; ++f) {
      const auto finding = static_cast<LogFinding>(f);
      if (row.found(finding).value_or(false))
        RC_FAIL(std::string(finding_name(finding)) + " in row " + std::to_string(row.number) + " of\n" + log);
    }
  }
}

void analyze_to(const std::string& path, const std::string& spec, ThreadTeam& team) {
  AnalysisOptions options;
  options.output = path;
  static_cast<void>(analyze(read_spec(spec, "random"), options, team));
}

void expect_runs_are_fine(const std::string& spec, ThreadTeam& team) {
  const sample::ScratchFolder folder;
  analyze_to(folder / "out.h5", spec, team);
  const ResultsReader results(folder / "out.h5");
  const std::vector<std::int32_t> delays = results.values("/delay", 0, all_cells(results.grid()));
  const bool is_empty = !has_start(results.spec(), delays);
  RC_CLASSIFY(!is_empty, "a state of K to start from");
  if (is_empty) return;
  std::size_t most = 0;
  for (std::size_t p = 0; p < results.partitions().size(); ++p) {
    SimulationOptions options;
    options.partition = results.partitions()[p].name;
    options.steps = 10;
    options.runs = 3;
    options.policy = p % 2 == 0 ? Policy::random : Policy::adversarial;
    options.disturbance = p % 3 == 0 ? Disturbance::extremes : Disturbance::random;
    options.seed = p;
    for (const RunTrace& trace : simulate(results, options, team).traces) {
      most = std::max(most, trace.steps.size());
      for (const bool has_contact : {true, false}) {
        LogText log(results.spec(), results.inputs(), has_contact);
        for (std::size_t k = 0; k < trace.samples.size(); ++k) {
          const bool is_last = k == trace.steps.size();
          log.add(trace.samples[k].measured, is_last ? -1 : trace.steps[k].input,
                  !is_last && trace.steps[k].coordinated);
        }
        const std::vector<JudgedRow> rows = judge(results, p, log, team);
        RC_ASSERT(rows.size() == trace.samples.size());
        expect_nothing_found(rows, log.text());
        for (std::size_t k = 0; has_contact && k < rows.size(); ++k) {
          if (rows[k].countdown && rows[k].position.cells.size() == 1)
            RC_ASSERT(*rows[k].countdown >= trace.samples[k].countdown);
        }
      }
    }
  }
  RC_CLASSIFY(most == 10, "runs of ten steps");
}

TEST(LogJudge, RunsOfTheLoopAreJudgedWithoutAFinding) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("random problems", [&] { expect_runs_are_fine(draw_problem(), team); }));
}

TEST(LogJudge, AlsoThoseThatGoForAGoal) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("random problems with a goal", [&] {
    Json spec = Json::parse(draw_problem());
    spec["goal"] = "x0 >= " + std::to_string(*rc::gen::inRange(0, 4));
    expect_runs_are_fine(spec.dump(), team);
  }));
}

TEST(LogJudge, AlsoThoseThatRemember) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("random problems with memories", [&] {
    Json spec = Json::parse(draw_problem(RandomTime::any, RandomEdges::plain));
    const std::string limit = std::to_string(*rc::gen::inRange(0, 4));
    spec["memory"] = {{"was", "once(x0 >= " + limit + ")"}, {"lately", "within(3, x0 <= " + limit + ")"}};
    spec["safe"] =
        "(" + spec["safe"].get<std::string>() + ") and (lately or not was or x0 < " + limit + " + 2)";
    expect_runs_are_fine(spec.dump(), team);
  }));
}

/// A random problem analysed by the plain engine, and by the program.
struct Twice {
  explicit Twice(ThreadTeam& team)
      : text(draw_problem()),
        spec(read_spec(text, "random")),
        abstraction(build_abstraction(spec, team)),
        safe(safe_set(spec, abstraction, team)),
        beyond(safe_beyond_limits(spec, abstraction, safe, team)),
        plain(analyze_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)))) {
    analyze_to(folder / "out.h5", text, team);
    results.emplace(folder / "out.h5");
  }

  sample::ScratchFolder folder;
  std::string text;
  ProblemSpec spec;
  Abstraction abstraction;
  CellSet safe;
  std::optional<CellSet> beyond;
  PlainAnalysis plain;
  std::optional<ResultsReader> results;
};

/// Rows at centres of cells that need have nothing to do with each other.
struct RandomLog {
  std::vector<std::int64_t> cells, inputs;
  std::vector<bool> connected;
};

RandomLog draw_log(const Twice& twice) {
  RandomLog log;
  const std::int64_t all = twice.abstraction.grid.cells();
  for (int k = 0; k < 12; ++k) {
    std::int64_t cell = *rc::gen::inRange<std::int64_t>(0, all);
    // Where half of them follow the model there is something left to count down.
    if (k > 0 && *rc::gen::inRange(0, 4) > 0) {
      cell = 0;
      for (std::size_t i = 0; i < twice.abstraction.grid.size(); ++i) {
        const ResolvedRange next = twice.abstraction.resolved(i, log.cells.back(), log.inputs.back());
        const std::int64_t count = twice.abstraction.grid[i].count;
        const std::int64_t index =
            next.all_left() ? 0 : *rc::gen::inRange<std::int64_t>(next.inside.first, next.inside.last + 1);
        cell += index % count * twice.abstraction.grid.stride(i);
      }
    }
    log.cells.push_back(cell);
    log.inputs.push_back(*rc::gen::inRange<std::int64_t>(0, twice.abstraction.inputs.count()));
    log.connected.push_back(*rc::gen::inRange(0, 4) == 0);
  }
  return log;
}

bool is_in_post(const Abstraction& a, std::int64_t x, std::int64_t u, std::int64_t y) {
  for (std::size_t i = 0; i < a.grid.size(); ++i) {
    const IndexRange inside = a.resolved(i, x, u).inside;
    const std::int64_t k = a.grid.index(y, i);
    const bool is_in = (inside.first <= k && k <= inside.last) ||
                       (a.grid[i].periodic() && k + a.grid[i].count <= inside.last);
    if (!is_in) return false;
  }
  return true;
}

void expect_rows(const Twice& twice, std::size_t p, const RandomLog& log,
                 const std::vector<JudgedRow>& rows) {
  const auto& own = twice.plain.partitions[p];
  const auto classes =
      input_classes(twice.spec, twice.abstraction.inputs, twice.spec.coordination.partitions[p]);
  const std::int64_t connect = twice.spec.coordination.connection_delay;
  const auto delay = [&](std::size_t k) { return own.delay[static_cast<std::size_t>(log.cells[k])]; };
  const auto begun = [&](std::size_t k) { return delay(k) < 0 ? -1 : delay(k) >= connect ? delay(k) : 0; };
  std::int32_t left = begun(0);
  bool tolerates_less = false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const JudgedRow& row = rows[k];
    const auto x = static_cast<std::size_t>(log.cells[k]);
    RC_ASSERT(row.position.cells == std::vector<std::int64_t>{log.cells[k]});
    RC_ASSERT(row.delay == delay(k));
    RC_ASSERT(row.countdown.value_or(-1) == left);
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const auto action = static_cast<std::size_t>(classes[c].action(log.inputs[k]));
      const std::optional<bool> reckless =
          delay(k) < 0 ? std::nullopt : std::optional(!own.projection[c][x][action]);
      RC_ASSERT(row.is_reckless[c] == reckless);
    }
    const bool is_member = twice.plain.controller[x][static_cast<std::size_t>(log.inputs[k])];
    RC_ASSERT(row.in_controller == (delay(k) < 0 ? std::nullopt : std::optional(is_member)));
    RC_ASSERT(row.tolerates_less == tolerates_less);
    RC_ASSERT(row.is_silent_too_long == (!log.connected[k] && left == 0));
    if (k + 1 == rows.size()) continue;
    RC_ASSERT(row.fits_model == is_in_post(twice.abstraction, log.cells[k], log.inputs[k], log.cells[k + 1]));
    const std::int32_t after = left == kUnbounded ? left : left - 1;
    tolerates_less = !log.connected[k] && left > 0 && delay(k + 1) < after;
    const std::int32_t kept = std::min(std::max(after, 0), delay(k + 1));
    left = log.connected[k] || left < 0 ? begun(k + 1) : std::max(kept, -1);
  }
}

TEST(LogJudge, RandomLogsAreJudgedAsThePlainEngineHasIt) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("random logs", [&] {
    const Twice twice(team);
    for (std::size_t p = 0; p < twice.plain.partitions.size(); ++p) {
      const RandomLog log = draw_log(twice);
      LogText text(twice.spec, twice.abstraction.inputs, true);
      for (std::size_t k = 0; k < log.cells.size(); ++k) {
        std::vector<double> state;
        for (std::size_t i = 0; i < twice.abstraction.grid.size(); ++i) {
          const GridDimension& dimension = twice.abstraction.grid[i];
          state.push_back(nearest_double(dimension.point(twice.abstraction.grid.index(log.cells[k], i))));
        }
        text.add(state, log.inputs[k], log.connected[k]);
      }
      const std::vector<JudgedRow> rows = judge(*twice.results, p, text, team);
      RC_ASSERT(rows.size() == log.cells.size());
      expect_rows(twice, p, log, rows);
      const auto has = [&rows](LogFinding finding) {
        return std::any_of(rows.begin(), rows.end(),
                           [&](const JudgedRow& row) { return row.found(finding).value_or(false); });
      };
      RC_CLASSIFY(has(LogFinding::off_model), "off the model");
      RC_CLASSIFY(has(LogFinding::reckless), "reckless");
      RC_CLASSIFY(has(LogFinding::not_coordinated), "not coordinated");
      RC_CLASSIFY(has(LogFinding::breach), "breach");
    }
  }));
}

}  // namespace
}  // namespace coordreq
