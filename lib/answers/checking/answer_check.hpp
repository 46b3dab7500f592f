#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "answers/checking/checked_cell.hpp"
#include "answers/checking/comparison.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"

namespace coordreq {

/// Checks one answer at single cells. One object a thread.
class CellChecker {
 public:
  virtual ~CellChecker() = default;
  virtual void check(CheckedCell& cell) = 0;
};

/// The section of a report in which findings stand; within a section they are in the order of the answers.
enum class CheckSection : std::uint8_t { sets, choices, steps, modes, requirements, costs };

/// The check of one answer, by its definition and without the code that has computed it.
class AnswerCheck {
 public:
  explicit AnswerCheck(CheckSection section) : section_(section) {}
  virtual ~AnswerCheck() = default;
  AnswerCheck(const AnswerCheck&) = delete;
  AnswerCheck& operator=(const AnswerCheck&) = delete;

  [[nodiscard]] CheckSection section() const { return section_; }
  /// Compares sizes and other figures in the file with the values of its cells; no posts are needed.
  /// @param sizes compares numbers of cells of sets @returns the findings about other figures
  virtual std::vector<Finding> compare_sizes(Comparison& /*sizes*/) { return {}; }
  /// Null: single cells are not checked. @pre unchecked: this object outlives the result.
  [[nodiscard]] virtual std::unique_ptr<CellChecker> cell_checker() { return nullptr; }
  /// Cells, in the sample or not, whose posts check_all() needs.
  [[nodiscard]] virtual std::vector<std::uint64_t> more_cells() const { return {}; }
  /// Checks that take more than one cell at a time.
  virtual void check_all(ThreadTeam& /*team*/) {}
  /// The findings, when all checks have been made.
  [[nodiscard]] virtual std::vector<Finding> findings() const = 0;

 private:
  CheckSection section_;
};

}  // namespace coordreq
