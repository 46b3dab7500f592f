#include "reach/update_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/requires.hpp"
#include "expression/tape_builder.hpp"
#include "model/condition_table.hpp"
#include "model/pieces.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// Branches of an update can double their number with every `if`.
constexpr std::size_t kMostUpdateValues = 4096;

/// The nodes that give the value, whatever the conditions say.
std::vector<bool> value_nodes(const Program& program) {
  std::vector<bool> needed(program.nodes.size(), false);
  needed.back() = true;
  for (std::size_t i = needed.size(); i-- > 0;) {
    const Program::Node& node = program.nodes[i];
    if (!needed[i]) continue;
    const std::size_t operands = operand_count(node.op);
    if (operands > 0 && node.op != Operator::if_else) needed[node.a] = true;
    if (operands > 1) needed[node.b] = true;
    if (operands > 2) needed[node.c] = true;
  }
  return needed;
}

/// What conditions are asked of: cells, inputs, and all that disturbances can be.
std::vector<ConditionAxis> axes_of(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                                   bool centres) {
  std::vector<ConditionAxis> axes =
      condition_axes(grid, inputs, centres ? Sampling::centres : Sampling::closed_cells);
  for (const DisturbanceSpec& disturbance : spec.disturbances) {
    const RationalInterval range{.lower = disturbance.lower, .upper = disturbance.upper};
    axes.push_back({1, [range](std::int64_t) -> ConditionAxis::Ranges { return {range}; }});
  }
  return axes;
}

/// Asked for before all else that needs it.
const UpdateSpec& update_of(const SystemSpec& spec, std::size_t state) {
  REQUIRES(spec.dynamics.update(state) != nullptr);
  return *spec.dynamics.update(state);
}

}  // namespace

UpdateRanges::UpdateRanges(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                           std::size_t state)
    : spec_(spec),
      state_(state),
      grid_(grid),
      inputs_(inputs),
      target_(grid[grid.dimension_of(state)]),
      program_(update_of(spec, state).value),
      needed_(value_nodes(program_)),
      condition_of_(program_.nodes.size(), 0),
      values_(program_.nodes.size()) {
  const UpdateSpec& update = update_of(spec, state);
  past_ = update.past ? &*update.past : nullptr;
  const bool centres = past_ != nullptr && spec.abstraction.safe == Membership::center;
  const std::vector<ConditionAxis> axes = axes_of(spec, grid, inputs, centres);
  if (past_ != nullptr) {
    conditions_.emplace_back(past_->first, axes);
    if (past_->kind == PastOperator::Kind::since) conditions_.emplace_back(past_->second, axes);
    return;
  }
  TapeBuilder tape;
  std::vector<TapeBuilder::Index> here;
  for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
    const Program::Node& node = program_.nodes[i];
    here.push_back(tape.copy(program_, node, here));
    if (!needed_[i] || node.op != Operator::if_else) continue;
    condition_of_[i] = conditions_.size();
    conditions_.emplace_back(tape.extract(here[node.a]), axes);
  }
}

IndexRange UpdateRanges::at(std::span<const std::int64_t> indices, bool is_new) {
  if (is_new) known_.clear();
  truths_.clear();
  for (CellTruth& condition : conditions_) truths_.push_back(condition.at(indices));
  if (past_ != nullptr) return kept(indices);
  const auto known = known_.find(truths_);
  if (known != known_.end()) return known->second;
  const std::vector<std::int64_t> all = indices_of(indices);
  return known_.emplace(truths_, raw_range(target_, all.front(), all.back())).first->second;
}

IndexRange UpdateRanges::kept(std::span<const std::int64_t> indices) const {
  const Truth one = truths_.front();
  const Truth other = truths_.back();
  const bool is_open = one == Truth::undecided || other == Truth::undecided;
  if (is_open && !past_->three_valued)
    throw SpecError(fmt::format("what {} keeps cannot be decided at a cell", target_.name), "/memory");
  const std::int64_t k = past_->next(one, other, indices[past_->slot]);
  return raw_range(target_, k, k);
}

std::vector<std::int64_t> UpdateRanges::all_at(std::span<const std::int64_t> indices) {
  truths_.clear();
  for (CellTruth& condition : conditions_) truths_.push_back(condition.at(indices));
  if (past_ != nullptr) return {std::int64_t{kept(indices).first}};
  return indices_of(indices);
}

/// @pre unchecked: truths_ are those at the cell
std::vector<std::int64_t> UpdateRanges::indices_of(std::span<const std::int64_t> indices) {
  for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
    if (!needed_[i]) continue;
    values_[i].clear();
    find_values(i, indices);
  }
  std::vector<std::int64_t> result;
  for (const RationalInterval& value : values_.back()) {
    const Rational index = (value.lower - target_.first) / target_.step;
    if (!value.is_point() || !is_integer(index)) fail(value, indices);
    result.push_back(floor_to_int(index));
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// From the values of the nodes before.
void UpdateRanges::find_values(std::size_t i, std::span<const std::int64_t> indices) {
  const Program::Node& node = program_.nodes[i];
  const std::size_t operands = operand_count(node.op);
  if (node.op == Operator::constant) {
    const Rational& value = program_.constants[node.a];
    add_value(i, {.lower = value, .upper = value});
  } else if (node.op == Operator::variable) {
    const Rational value = value_at(node.a, indices);
    add_value(i, {.lower = value, .upper = value});
  } else if (node.op == Operator::if_else) {
    const Truth truth = truths_[condition_of_[i]];
    if (truth != Truth::no) values_[i] = values_[node.b];
    if (truth == Truth::yes) return;
    for (const RationalInterval& value : values_[node.c]) add_value(i, value);
  } else {
    for (const RationalInterval& a : values_[node.a]) {
      if (operands == 1) add_value(i, apply(node.op, a));
      if (operands == 1) continue;
      for (const RationalInterval& b : values_[node.b]) add_value(i, apply(node.op, a, b));
    }
  }
}

void UpdateRanges::add_value(std::size_t node, const RationalInterval& value) {
  Values& values = values_[node];
  const auto is_same = [&](const RationalInterval& one) {
    return one.lower == value.lower && one.upper == value.upper && one.total == value.total &&
           one.bounded == value.bounded;
  };
  if (std::any_of(values.begin(), values.end(), is_same)) return;
  if (values.size() == kMostUpdateValues) {
    throw SpecError(fmt::format("the update of '{}' can have more than {} values from one cell, expected "
                                "fewer conditions that branch",
                                target_.name, kMostUpdateValues),
                    spec_.dynamics.pointer_of(target_.name, state_));
  }
  values.push_back(value);
}

Rational UpdateRanges::value_at(std::uint32_t slot, std::span<const std::int64_t> indices) const {
  if (slot < spec_.states.size()) return grid_[grid_.dimension_of(slot)].point(indices[slot]);
  return inputs_[slot - spec_.states.size()].values[static_cast<std::size_t>(indices[slot])];
}

void UpdateRanges::fail(const RationalInterval& value, std::span<const std::int64_t> indices) const {
  std::string location;
  for (const std::uint32_t slot : program_.variables()) {
    if (slot >= spec_.states.size() + spec_.inputs.size()) continue;  // a disturbance, of all its values
    const bool is_state = slot < spec_.states.size();
    location += fmt::format("{}{} = {}", location.empty() ? " at " : ", ",
                            is_state ? spec_.states[slot].name : inputs_[slot - spec_.states.size()].name,
                            to_text(value_at(slot, indices)));
  }
  const std::string found = value.is_point() ? to_text(value.lower) : "a number that is not known exactly";
  throw SpecError(
      fmt::format(
          "the next value of the discrete state '{}' can be {}{}, expected {} + k * {} with an integer k",
          target_.name, found, location, to_text(target_.first), to_text(target_.step)),
      spec_.dynamics.pointer_of(target_.name, state_));
}

}  // namespace coordreq
