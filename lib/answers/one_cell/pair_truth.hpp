#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "expression/cell_truth.hpp"
#include "expression/condition.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The truth of a condition over states and inputs, such as `allow`, at single pairs of a cell and a joint
/// input: at the centre of the cell, but a condition on memories is asked of the whole cell where `safe` is,
/// and is false if undecided. One object a thread.
class PairTruth {
 public:
  /// @pre unchecked: the arguments outlive this object. @param words, pointer name the condition in errors
  PairTruth(const ProblemSpec& spec, const Program& condition, const CellPosts& posts, std::string words,
            std::string pointer);

  /// @throws SpecError where the condition cannot be decided
  [[nodiscard]] bool holds(std::int64_t x, std::int64_t u);

 private:
  [[nodiscard]] bool holds_at_cell(std::int64_t x, std::int64_t u);

  const ProblemSpec& spec_;
  const Program& condition_;
  const CellPosts& posts_;
  std::string words_, pointer_;
  ConditionDecider decider_;
  std::unique_ptr<CellTruth> of_cells_;  ///< used instead, if memories are asked of whole cells
  std::vector<Interval> fast_point_;
  std::vector<RationalInterval> point_;
};

}  // namespace coordreq
