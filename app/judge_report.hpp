#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "cell/log_judge.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The summary of a judged log: for each kind of finding the number of rows, and the first one.
class JudgeSummary {
 public:
  /// @pre unchecked: `results` outlives this object.
  JudgeSummary(const ResultsReader& results, std::size_t partition);

  void add(const JudgedRow& row);
  /// Neither the model nor a countdown is broken.
  [[nodiscard]] bool holds() const;
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] Json json() const;

 private:
  struct Tally {
    std::int64_t judged = 0, count = 0;
    std::optional<JudgedRow> first;
  };
  [[nodiscard]] Json row_json(const JudgedRow& row) const;
  [[nodiscard]] Json first_json(const JudgedRow& row, LogFinding finding) const;

  const ResultsReader& results_;
  std::size_t partition_;
  std::int64_t rows_ = 0, gaps_ = 0;
  std::array<Tally, kLogFindings> tallies_;
  std::vector<std::int64_t> reckless_;  ///< [class] rows
};

[[nodiscard]] std::string judgement_text(const Json& found);

/// The line of column names, and one of a row: of findings 1 if it is found, 0 if not, nothing if it cannot
/// be judged.
[[nodiscard]] std::string judged_csv_header(const ResultsReader& results, std::size_t partition);
[[nodiscard]] std::string judged_csv_line(const JudgedRow& row);

}  // namespace coordreq
