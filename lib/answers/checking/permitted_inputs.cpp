#include "answers/checking/permitted_inputs.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "model/condition_table.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::vector<std::int32_t> inputs_in(const Program& condition, const ProblemSpec& spec) {
  std::vector<std::int32_t> result;
  for (const std::uint32_t slot : condition.variables()) {
    if (slot >= spec.input_slot(0) && slot < spec.input_slot(spec.inputs.size()))
      result.push_back(static_cast<std::int32_t>(slot - spec.input_slot(0)));
  }
  return result;
}

}  // namespace

PermittedInputs::PermittedInputs(const ProblemSpec& spec, const Program& condition, const UniformGrid& grid,
                                 const InputSpace& inputs, std::string label, std::string pointer)
    : spec_(spec),
      condition_(condition),
      grid_(grid),
      inputs_(inputs),
      label_(std::move(label)),
      pointer_(std::move(pointer)),
      used_(inputs, inputs_in(condition, spec)),
      indices_(2 * grid.size() + inputs.size(), -1),
      decider_(condition),
      fast_(spec.slot_count()),
      exact_(spec.slot_count()) {
  used_.tabulate();
  if (used_.actions() <= kMostKnown) known_.resize(at(used_.actions()), kNotKnown);
  const std::size_t points = grid.size() + inputs.size();
  for (const std::uint32_t slot : condition.variables()) {
    const bool is_cell = slot >= points;
    if (is_cell && of_cells_ == nullptr)
      of_cells_ = std::make_unique<CellTruth>(condition, allow_axes(grid, inputs));
    const std::size_t state = is_cell ? slot - points : slot;
    if (state < grid.size() && !contains(states_, state)) states_.push_back(state);
  }
}

void PermittedInputs::set(std::size_t slot, const Rational& value, std::int64_t index) {
  indices_[slot] = index;
  exact_[slot] = {.lower = value, .upper = value};
  fast_[slot] = enclose(value);
}

void PermittedInputs::go_to(std::int64_t cell) {
  bool is_other = false;
  for (const std::size_t state : states_) {
    const std::size_t i = grid_.dimension_of(state);
    const std::int64_t index = grid_.index(cell, i);
    if (indices_[state] == index) continue;
    is_other = true;
    set(state, grid_[i].point(index), index);
    indices_[grid_.size() + inputs_.size() + state] = index;
  }
  if (is_other) std::ranges::fill(known_, kNotKnown);
}

bool PermittedInputs::decide(std::int64_t u) {
  for (const std::int32_t i : used_.inputs()) {
    const std::int64_t index = inputs_.index(u, at(i));
    set(spec_.input_slot(at(i)), inputs_[at(i)].values[at(index)], index);
  }
  if (of_cells_) return of_cells_->at(indices_) == Truth::yes;
  const Truth truth =
      decider_.decide(fast_, [this]() -> std::span<const RationalInterval> { return exact_; });
  if (truth == Truth::undecided && !may_not_know(condition_))
    throw SpecError(label_ + " cannot be decided at a grid point", pointer_);
  return truth == Truth::yes;
}

}  // namespace coordreq
