#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
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

/// Which joint inputs a condition over states and inputs permits at the centre of a cell, exactly. Keeps no
/// table: evaluates what is asked, and remembers it while only variables change that it does not mention. One
/// object a thread.
class PermittedPairs {
 public:
  /// @pre unchecked: all outlive this object. @param words, @param pointer for errors
  PermittedPairs(const ProblemSpec& spec, const Program& condition, const UniformGrid& grid,
                 const InputSpace& inputs, std::string words, std::string pointer);

  /// @throws SpecError where it cannot be decided
  void go_to(std::int64_t cell);
  [[nodiscard]] bool operator()(std::int64_t u) const {
    return permitted_[numbers_[static_cast<std::size_t>(u)]];
  }

 private:
  void evaluate_all();

  const ProblemSpec& spec_;
  const Program& condition_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  std::string words_, pointer_;
  std::vector<std::size_t> states_;  ///< mentioned
  std::vector<std::size_t> inputs_used_;
  std::vector<std::int64_t> indices_;  ///< of the cell in those states
  std::vector<std::size_t> numbers_;   ///< [u]: row-major over the inputs mentioned
  std::vector<bool> permitted_;        ///< by that number
  std::vector<RationalInterval> slots_;
  Evaluator<RationalInterval> evaluator_;
  std::deque<CellTruth> of_cells_;  ///< one where memories are asked of whole cells, instead
};

/// Which joint inputs `allow` permits, and the controller file lists. One object a thread.
class AllowedPairs {
 public:
  /// @pre unchecked: all outlive this object.
  /// @param listed none where the spec has no controller file
  AllowedPairs(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
               const std::optional<PackedPairs>& listed);

  /// @throws SpecError where `allow` cannot be decided
  void go_to(std::int64_t cell);
  [[nodiscard]] bool operator()(std::int64_t u) const {
    return permits(u) && (!listed_ || listed_->test(cell_, u));
  }
  /// The same, whatever the file lists.
  [[nodiscard]] bool permits(std::int64_t u) const { return !allow_ || (*allow_)(u); }

 private:
  const std::optional<PackedPairs>& listed_;
  std::int64_t cell_ = 0;
  std::optional<PermittedPairs> allow_;  ///< none: it permits everything
};

}  // namespace coordreq
