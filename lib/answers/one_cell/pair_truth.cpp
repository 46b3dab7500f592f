#include "answers/one_cell/pair_truth.hpp"

#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "model/condition_table.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

PairTruth::PairTruth(const ProblemSpec& spec, const Program& condition, const CellPosts& posts,
                     std::string words, std::string pointer)
    : spec_(spec),
      condition_(condition),
      posts_(posts),
      words_(std::move(words)),
      pointer_(std::move(pointer)),
      decider_(condition),
      fast_point_(spec.slot_count()),
      point_(spec.slot_count()) {
  const std::vector<std::uint32_t> slots = condition.variables();
  if (!slots.empty() && slots.back() >= spec.states.size() + spec.inputs.size())
    of_cells_ = std::make_unique<CellTruth>(condition, allow_axes(posts.grid(), posts.inputs()));
}

/// The truth where memories are asked of the whole cell.
bool PairTruth::holds_at_cell(std::int64_t x, std::int64_t u) {
  const UniformGrid& grid = posts_.grid();
  const InputSpace& inputs = posts_.inputs();
  std::vector<std::int64_t> indices(2 * grid.size() + inputs.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::int64_t index = grid.index(x, i);
    indices[grid.state(i)] = index;
    indices[grid.size() + inputs.size() + grid.state(i)] = index;
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) indices[grid.size() + i] = inputs.index(u, i);
  return of_cells_->at(indices) == Truth::yes;
}

bool PairTruth::holds(std::int64_t x, std::int64_t u) {
  if (of_cells_) return holds_at_cell(x, u);
  const auto set = [this](std::size_t slot, const Rational& value) {
    point_[slot] = {.lower = value, .upper = value};
    fast_point_[slot] = enclose(value);
  };
  const UniformGrid& grid = posts_.grid();
  const InputSpace& inputs = posts_.inputs();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    set(spec_.state_slot(grid.state(i)), grid[i].point(grid.index(x, i)));
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    set(spec_.input_slot(i), inputs[i].values[at(inputs.index(u, i))]);
  }
  const Truth truth =
      decider_.decide(fast_point_, [this]() -> std::span<const RationalInterval> { return point_; });
  if (truth == Truth::undecided && !may_not_know(condition_))
    throw SpecError(words_ + " cannot be decided at a cell", pointer_);
  return truth == Truth::yes;
}

}  // namespace coordreq
