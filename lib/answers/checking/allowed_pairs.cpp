#include "answers/checking/allowed_pairs.hpp"

#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "model/condition_table.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

PermittedPairs::PermittedPairs(const ProblemSpec& spec, const Program& condition, const UniformGrid& grid,
                               const InputSpace& inputs, std::string words, std::string pointer)
    : spec_(spec),
      condition_(condition),
      grid_(grid),
      inputs_(inputs),
      words_(std::move(words)),
      pointer_(std::move(pointer)),
      slots_(spec.slot_count()),
      evaluator_(condition) {
  const std::size_t points = grid.size() + inputs.size();
  for (const std::uint32_t slot : condition.variables()) {
    if (slot >= points) {
      if (of_cells_.empty()) of_cells_.emplace_back(condition, allow_axes(grid, inputs));
      if (!contains(states_, slot - points)) states_.push_back(slot - points);
    } else if (slot < grid.size()) {
      states_.push_back(slot);
    } else {
      inputs_used_.push_back(slot - grid.size());
    }
  }
  for (std::int64_t u = 0; u < inputs.count(); ++u) {
    std::int64_t number = 0;
    for (const std::size_t i : inputs_used_) number = number * inputs[i].count() + inputs.index(u, i);
    numbers_.push_back(static_cast<std::size_t>(number));
  }
}

void PermittedPairs::go_to(std::int64_t cell) {
  std::vector<std::int64_t> indices;
  for (const std::size_t i : states_) indices.push_back(grid_.index(cell, i));
  if (!permitted_.empty() && indices == indices_) return;
  indices_ = std::move(indices);
  evaluate_all();
}

void PermittedPairs::evaluate_all() {
  std::vector<std::int64_t> indices(2 * grid_.size() + inputs_.size(), 0);
  for (std::size_t s = 0; s < states_.size(); ++s) {
    indices[states_[s]] = indices[grid_.size() + inputs_.size() + states_[s]] = indices_[s];
    const Rational centre = grid_[states_[s]].point(indices_[s]);
    slots_[states_[s]] = {.lower = centre, .upper = centre};
  }
  std::vector<std::int64_t> counts;
  for (const std::size_t i : inputs_used_) counts.push_back(inputs_[i].count());
  permitted_.clear();
  Odometer choice(counts);
  do {
    for (std::size_t i = 0; i < inputs_used_.size(); ++i) {
      const Rational& value = inputs_[inputs_used_[i]].values[static_cast<std::size_t>(choice[i])];
      slots_[spec_.input_slot(inputs_used_[i])] = {.lower = value, .upper = value};
      indices[spec_.input_slot(inputs_used_[i])] = choice[i];
    }
    const Truth truth = of_cells_.empty() ? evaluator_.condition(slots_) : of_cells_.front().at(indices);
    if (truth == Truth::undecided && of_cells_.empty() && !may_not_know(condition_))
      throw SpecError(words_ + " cannot be decided at a grid point", pointer_);
    permitted_.push_back(truth == Truth::yes);
  } while (choice.advance());
}

AllowedPairs::AllowedPairs(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                           const std::optional<PackedPairs>& listed)
    : listed_(listed) {
  if (spec.controller.allow)
    allow_.emplace(spec, *spec.controller.allow, grid, inputs, "'allow'", "/controller/allow");
}

void AllowedPairs::go_to(std::int64_t cell) {
  cell_ = cell;
  if (allow_) allow_->go_to(cell);
}

}  // namespace coordreq
