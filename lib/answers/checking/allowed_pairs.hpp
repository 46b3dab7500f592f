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
/// table: evaluates the condition for the cell asked about, and remembers the results as long as no variable
/// changes that it mentions. One object a thread.
class PermittedPairs {
 public:
  /// @pre unchecked: the arguments outlive this object. @param words, pointer name the condition in errors
  PermittedPairs(const ProblemSpec& spec, const Program& condition, const UniformGrid& grid,
                 const InputSpace& inputs, std::string words, std::string pointer);

  /// @throws SpecError where the condition cannot be decided
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
  std::vector<std::size_t> states_;  ///< that the condition mentions
  std::vector<std::size_t> inputs_used_;
  std::vector<std::int64_t> indices_;  ///< of the cell in states_
  std::vector<std::size_t> numbers_;   ///< [u] row-major over inputs_used_
  std::vector<bool> permitted_;        ///< [number]
  std::vector<RationalInterval> slots_;
  Evaluator<RationalInterval> evaluator_;
  std::deque<CellTruth> of_cells_;  ///< one, used instead, if memories are asked of whole cells
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
  /// Whether `allow` permits u, also if the file does not list it.
  [[nodiscard]] bool permits(std::int64_t u) const { return !allow_ || (*allow_)(u); }

 private:
  const std::optional<PackedPairs>& listed_;
  std::int64_t cell_ = 0;
  std::optional<PermittedPairs> allow_;  ///< nothing: all joint inputs are permitted
};

}  // namespace coordreq
