#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "answers/checking/checked_cell.hpp"
#include "answers/checking/comparison.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"

namespace coordreq {

/// Checks what one answer says of single cells. One object a thread.
class CellChecker {
 public:
  virtual ~CellChecker() = default;
  virtual void check(CheckedCell& cell) = 0;
};

/// The place of findings in a report; those of one section stand in the order of the answers.
enum class CheckSection : std::uint8_t { sets, choices, steps, modes, requirements, costs };

/// What one answer says, checked by its definition and without anything that has computed it.
class AnswerCheck {
 public:
  explicit AnswerCheck(CheckSection section) : section_(section) {}
  virtual ~AnswerCheck() = default;
  AnswerCheck(const AnswerCheck&) = delete;
  AnswerCheck& operator=(const AnswerCheck&) = delete;

  [[nodiscard]] CheckSection section() const { return section_; }
  /// Compares what is said of all cells together with what is said of each; no posts are needed.
  /// @param sizes how many cells sets have; @returns what is no matter of these
  virtual std::vector<Finding> compare_sizes(Comparison& /*sizes*/) { return {}; }
  /// Null: single cells are not looked at. @pre unchecked: this object outlives the result.
  [[nodiscard]] virtual std::unique_ptr<CellChecker> cell_checker() { return nullptr; }
  /// Cells that check_all() asks for the posts of, whatever the sample is.
  [[nodiscard]] virtual std::vector<std::uint64_t> more_cells() const { return {}; }
  /// Whatever takes more than one cell at a time.
  virtual void check_all(ThreadTeam& /*team*/) {}
  /// After all that.
  [[nodiscard]] virtual std::vector<Finding> findings() const = 0;

 private:
  CheckSection section_;
};

}  // namespace coordreq
