#include "answers/checking/allowed_pairs.hpp"

#include "base/error.hpp"
#include "base/index.hpp"
#include "model/condition_table.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

AllowedPairs::AllowedPairs(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                           const std::optional<PackedPairs>& listed)
    : spec_(spec), grid_(grid), inputs_(inputs), listed_(listed), slots_(spec.slot_count()) {
  if (!spec.controller.allow) return;
  evaluator_.emplace_back(*spec.controller.allow);
  const std::size_t points = grid.size() + inputs.size();
  for (const std::uint32_t slot : spec.controller.allow->variables()) {
    if (slot >= points) {
      if (of_cells_.empty()) of_cells_.emplace_back(*spec.controller.allow, allow_axes(grid, inputs));
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

void AllowedPairs::go_to(std::int64_t cell) {
  cell_ = cell;
  if (evaluator_.empty()) return;
  std::vector<std::int64_t> indices;
  for (const std::size_t i : states_) indices.push_back(grid_.index(cell, i));
  if (!permitted_.empty() && indices == indices_) return;
  indices_ = std::move(indices);
  evaluate_all();
}

void AllowedPairs::evaluate_all() {
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
    const Truth truth =
        of_cells_.empty() ? evaluator_.front().condition(slots_) : of_cells_.front().at(indices);
    if (truth == Truth::undecided && of_cells_.empty() && !may_not_know(*spec_.controller.allow))
      throw SpecError("'allow' cannot be decided at a grid point", "/controller/allow");
    permitted_.push_back(truth == Truth::yes);
  } while (choice.advance());
}

}  // namespace coordreq
