#include "cell/cell_controller.hpp"

#include <algorithm>

#include "answers/convention/convention.hpp"
#include "base/error.hpp"
#include "reach/counter.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

std::vector<bool> unpacked(const std::vector<std::uint8_t>& bytes, std::int64_t count) {
  std::vector<bool> bits(at(count));
  for (std::size_t a = 0; a < bits.size(); ++a) bits[a] = (bytes[a / 8] >> (a % 8) & 1U) != 0;
  return bits;
}

/// Number of the joint action that joint input u gives to a class: row-major over its inputs.
std::int64_t action_of(const InputSpace& space, std::int64_t u, const std::vector<std::int32_t>& inputs) {
  std::int64_t action = 0;
  for (const std::int32_t i : inputs) action = action * space[at(i)].count() + space.index(u, at(i));
  return action;
}

}  // namespace

std::vector<std::int32_t> inputs_of_class(const ProblemSpec& spec, const std::vector<std::int32_t>& agents) {
  std::vector<std::int32_t> inputs;
  for (const std::int32_t agent : agents) {
    const auto& own = spec.agents[at(agent)].inputs;
    inputs.insert(inputs.end(), own.begin(), own.end());
  }
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

CellController::CellController(const ResultsReader& results, ThreadTeam& team)
    : results_(results),
      posts_(results, team),
      invariant_(results.grid(), [&results](const CellBlock& block) { return results.invariant(block); }) {
  if (results.spec().abstraction.between_samples) tubes_.emplace(results, posts_, team);
  if (results.spec().controller.allow) allow_.emplace(*results.spec().controller.allow);
}

void CellController::prepare_all() {
  const std::size_t partitions = results_.partitions().size();
  bool stored = partitions > 0;
  for (std::size_t p = 0; p < partitions; ++p) stored = stored && results_.has_actions(p);
  if (results_.has_controller() || stored || results_.spec().controller.synthesis == Synthesis::given) return;
  posts_.prepare_all();
  invariant_.cover_all();
  if (tubes_) tubes_->prepare_all();
}

const std::vector<bool>& CellController::joint_inputs(std::int64_t cell) {
  if (cell == cell_) return joint_inputs_;
  const CellBlock block = one_cell(results_.grid(), cell);
  if (results_.has_controller()) {
    joint_inputs_ = unpacked(results_.controller_bits(block), results_.inputs().count());
  } else if (results_.invariant(block).front() == 0) {
    joint_inputs_.assign(at(results_.inputs().count()), false);
  } else {
    joint_inputs_ = compute(cell);
  }
  cell_ = cell;
  return joint_inputs_;
}

std::vector<std::vector<bool>> CellController::actions(std::size_t partition, std::int64_t cell) {
  const StoredPartition& stored = results_.partitions()[partition];
  const PartitionSpec& spec = results_.spec().coordination.partitions[partition];
  std::vector<std::vector<bool>> result;
  for (std::size_t c = 0; c < stored.classes.size(); ++c) {
    if (results_.has_actions(partition)) {
      const CellBlock block = one_cell(results_.grid(), cell);
      result.push_back(unpacked(results_.action_bits(partition, c, block), stored.actions[c]));
      continue;
    }
    const std::vector<bool>& admissible = joint_inputs(cell);
    const std::vector<std::int32_t> inputs = inputs_of_class(results_.spec(), spec.classes[c]);
    std::vector<bool>& projection = result.emplace_back(at(stored.actions[c]), false);
    for (std::int64_t u = 0; u < results_.inputs().count(); ++u) {
      if (admissible[at(u)]) projection[at(action_of(results_.inputs(), u, inputs))] = true;
    }
  }
  return result;
}

std::vector<std::vector<bool>> CellController::convention(std::int64_t cell) {
  const std::vector<InputClass> agents = agent_classes(results_.spec(), results_.inputs());
  if (!results_.has_convention()) return convention_at(joint_inputs(cell), agents);
  std::vector<std::vector<bool>> result;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const CellBlock block = one_cell(results_.grid(), cell);
    result.push_back(unpacked(results_.convention_bits(i, block), agents[i].actions()));
  }
  return result;
}

std::vector<bool> CellController::compute(std::int64_t cell) {
  std::vector<bool> candidates = allowed(cell);
  if (results_.spec().controller.synthesis == Synthesis::given) return candidates;
  posts_.move_to(cell);
  if (tubes_) candidates = tubes_->keep_safe(std::move(candidates));
  return keep_inside(invariant_, std::move(candidates),
                     [this](std::size_t i, std::int64_t u) { return posts_.resolved(i, u); });
}

bool CellController::is_allowed(std::vector<Interval>& box, std::vector<RationalInterval>& exact_box) {
  const Truth truth =
      allow_->decide(box, [&exact_box]() -> std::span<const RationalInterval> { return exact_box; });
  if (truth != Truth::undecided) return truth == Truth::yes;
  throw ResultsError("'allow' cannot be decided at a cell", results_.path());
}

std::vector<bool> CellController::allowed(std::int64_t cell) {
  const UniformGrid& grid = results_.grid();
  const InputSpace& inputs = results_.inputs();
  std::vector<bool> result(at(inputs.count()), true);
  if (results_.spec().controller.file)
    result = unpacked(results_.listed_bits(one_cell(grid, cell)), inputs.count());
  if (!allow_) return result;
  std::vector<Interval> box(results_.spec().slot_count());
  std::vector<RationalInterval> exact_box(box.size());
  const auto set = [&](std::size_t slot, const Rational& value) {
    box[slot] = {.lower = lower_double(value), .upper = upper_double(value)};
    exact_box[slot] = {.lower = value, .upper = value};
  };
  for (std::size_t i = 0; i < grid.size(); ++i) set(i, grid[i].point(grid.index(cell, i)));
  // Once for each choice of the inputs that it depends on; the others do not matter.
  std::vector<std::int32_t> used;
  std::vector<std::int64_t> counts;
  for (const std::uint32_t slot : results_.spec().controller.allow->variables()) {
    if (slot < grid.size()) continue;
    used.push_back(static_cast<std::int32_t>(slot - grid.size()));
    counts.push_back(inputs[at(used.back())].count());
  }
  std::vector<bool> decided;
  Counter choice(counts);
  do {
    for (std::size_t j = 0; j < used.size(); ++j) {
      const std::size_t i = at(used[j]);
      set(grid.size() + i, inputs[i].values[at(choice.indices()[j])]);
    }
    decided.push_back(is_allowed(box, exact_box));
  } while (choice.next());
  for (std::int64_t u = 0; u < inputs.count(); ++u)
    result[at(u)] = result[at(u)] && decided[at(action_of(inputs, u, used))];
  return result;
}

}  // namespace coordreq
