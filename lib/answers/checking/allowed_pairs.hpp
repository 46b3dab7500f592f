#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/packed_pairs.hpp"
#include "expression/cell_truth.hpp"
#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Which joint inputs `allow` permits at the centre of a cell, exactly, and the controller file lists. Keeps
/// no table: evaluates what is asked, and remembers it while only variables change that `allow` does not
/// mention. One object a thread.
class AllowedPairs {
 public:
  /// REQUIRES: all outlive this object.
  /// @param listed none where the spec has no controller file
  AllowedPairs(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
               const std::optional<PackedPairs>& listed);

  void go_to(std::int64_t cell);
  /// @throws SpecError where `allow` cannot be decided
  [[nodiscard]] bool operator()(std::int64_t u) const {
    return permits(u) && (!listed_ || listed_->test(cell_, u));
  }
  /// The same, whatever the file lists.
  [[nodiscard]] bool permits(std::int64_t u) const { return permitted_.empty() || permitted_[number_of(u)]; }

 private:
  [[nodiscard]] std::size_t number_of(std::int64_t u) const { return numbers_[static_cast<std::size_t>(u)]; }
  void evaluate_all();

  const ProblemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const std::optional<PackedPairs>& listed_;
  std::int64_t cell_ = 0;
  std::vector<std::size_t> states_;  ///< mentioned
  std::vector<std::size_t> inputs_used_;
  std::vector<std::int64_t> indices_;  ///< of the cell in those states
  std::vector<std::size_t> numbers_;   ///< [u]: row-major over the inputs mentioned
  std::vector<bool> permitted_;        ///< by that number; empty: all
  std::vector<RationalInterval> slots_;
  std::vector<Evaluator<RationalInterval>> evaluator_;  ///< one, or none
  std::deque<CellTruth> of_cells_;  ///< one where memories are asked of whole cells, instead
};

}  // namespace coordreq
