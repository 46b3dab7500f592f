#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cell/cell_controller.hpp"
#include "cell/log_position.hpp"
#include "cell/log_reader.hpp"
#include "cell/silence_watch.hpp"

namespace coordreq {

/// The findings about a row of a log.
enum class LogFinding : std::uint8_t {
  outside,          ///< the state is in no cell, and not beyond a `safe` or `goal` side
  unsafe,           ///< not in S
  not_invariant,    ///< in S, but not in K
  off_model,        ///< the next state is not in f(x,u)
  reckless,         ///< some class's action is not in its projection of C(x): the paper's term
  not_coordinated,  ///< the agents were connected, and the joint input is not in C(x)
  breach,           ///< silence for longer than the countdown, or a cell that tolerates less than it says
};
inline constexpr std::size_t kLogFindings = 7;
/// "outside", "unsafe", ...
[[nodiscard]] const char* finding_name(LogFinding finding);

/// A sample of a log and the step that follows it, judged. Nothing: it cannot be judged.
struct JudgedRow {
  std::int64_t number = 0;    ///< 1 is the first
  bool is_after_gap = false;  ///< samples are missing before it
  LogRow log;
  LogPosition position;
  std::int32_t delay = -2;                ///< as in `/delay`; the longest of the cells that it may be
  std::optional<std::int32_t> countdown;  ///< kUnbounded: without end; nothing outside K
  std::optional<bool> fits_model;
  /// Of a step that does not fit: the first state that is elsewhere, its value, and the range that it can
  /// have.
  struct Misfit {
    std::size_t state = 0;
    Rational found, lower, upper;
  };
  std::optional<Misfit> misfit;
  std::vector<std::optional<bool>> is_reckless;  ///< [class]
  std::vector<std::size_t> unknown_inputs;       ///< whose values are none of the spec's
  std::optional<bool> in_controller;             ///< the joint input is in C(x)
  Contact contact = Contact::possible;
  bool is_silent_too_long = false;
  bool tolerates_less = false;  ///< than the countdown that ran here

  /// Whether the row has this finding; nothing where it cannot be judged.
  [[nodiscard]] std::optional<bool> found(LogFinding finding) const;
};

/// Judges a log, row by row: against the posts of a system, its controller and the delays of a partition, as
/// a results file has them. Of a row that lies in one of several cells (LogPosition) it finds nothing that
/// one of them does not bear out.
///
/// A row after which some are missing (`t`) is judged alone, and a countdown begins after it.
class LogJudge {
 public:
  /// @pre unchecked: all outlive this object.
  LogJudge(const ResultsReader& results, std::size_t partition, LogReader& log, ThreadTeam& team);

  /// The next row; nothing at the end. @throws UsageError naming the line, as LogReader, and where samples do
  /// not follow each other by whole periods
  [[nodiscard]] std::optional<JudgedRow> next();

 private:
  [[nodiscard]] std::optional<JudgedRow> read(const JudgedRow* before);
  [[nodiscard]] bool is_next(const JudgedRow& row, const JudgedRow& before) const;
  [[nodiscard]] bool is_terminal(std::int64_t cell);
  void take_actions(JudgedRow& row);
  void judge_actions(JudgedRow& row);
  void judge_model(JudgedRow& row, const JudgedRow& next);
  [[nodiscard]] std::optional<std::size_t> misfit_in(std::int64_t cell, std::int64_t u,
                                                     const JudgedRow& next);
  [[nodiscard]] std::optional<std::int64_t> joint_input() const;

  const ResultsReader& results_;
  std::size_t partition_;
  LogReader& log_;
  CellController controller_;
  LogLocator locator_;
  SilenceWatch watch_;
  std::vector<InputClass> classes_;
  std::optional<JudgedRow> ahead_;
  bool has_begun_ = false;
  /// [input] position of its value in the row at work, -1 if the spec does not have the value.
  std::vector<std::optional<std::int64_t>> values_;
  std::vector<std::optional<std::int64_t>> actions_;  ///< [class] likewise
};

}  // namespace coordreq
