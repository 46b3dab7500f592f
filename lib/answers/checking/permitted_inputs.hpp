#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "expression/cell_truth.hpp"
#include "expression/condition.hpp"
#include "model/input_class.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Whether a condition over states and inputs, such as `allow`, holds at a cell and a joint input: at the
/// centre of the cell, but a condition on memories is evaluated on the whole cell where `safe` is, and does
/// not hold if undecided. Remembers its answers until a state that it mentions changes. One object a thread.
class PermittedInputs {
 public:
  /// @pre unchecked: the arguments outlive this object. @param label, pointer name the condition in errors
  PermittedInputs(const ProblemSpec& spec, const Program& condition, const UniformGrid& grid,
                  const InputSpace& inputs, std::string label, std::string pointer);

  void go_to(std::int64_t cell);
  /// @pre unchecked: go_to() was called. @throws SpecError where the condition cannot be decided
  [[nodiscard]] bool holds(std::int64_t u) {
    if (known_.empty()) return decide(u);
    std::uint8_t& known = known_[static_cast<std::size_t>(used_.action(u))];
    if (known == kNotKnown) known = decide(u) ? 1 : 0;
    return known != 0;
  }

 private:
  static constexpr std::uint8_t kNotKnown = 2;
  static constexpr std::int64_t kMostKnown = std::int64_t{1} << 20U;

  void set(std::size_t slot, const Rational& value, std::int64_t index);
  [[nodiscard]] bool decide(std::int64_t u);

  const ProblemSpec& spec_;
  const Program& condition_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  std::string label_, pointer_;
  InputClass used_;                    ///< the inputs that the condition mentions
  std::vector<std::size_t> states_;    ///< that it mentions, its point or its cell
  std::vector<std::int64_t> indices_;  ///< by slot, of the pair looked at; then of states once more
  std::vector<std::uint8_t> known_;    ///< by choice of inputs, at indices_; empty: too many
  ConditionDecider decider_;
  std::unique_ptr<CellTruth> of_cells_;  ///< used instead, if memories are evaluated on whole cells
  std::vector<Interval> fast_;           ///< by slot
  std::vector<RationalInterval> exact_;
};

}  // namespace coordreq
