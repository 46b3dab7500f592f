#include "cell/cell_controller.hpp"

#include "answers/convention/convention.hpp"
#include "answers/field_parts.hpp"
#include "base/error.hpp"
#include "base/index.hpp"
#include "model/input_class.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

std::vector<bool> unpacked(const std::vector<std::uint8_t>& bytes, std::int64_t count) {
  std::vector<bool> bits(at(count));
  for (std::size_t a = 0; a < bits.size(); ++a) bits[a] = (bytes[a / 8] >> (a % 8) & 1U) != 0;
  return bits;
}

/// Tubes are not stored.
std::optional<Abstraction> stored_abstraction(const ResultsReader& results) {
  if (!results.has_abstraction() || results.spec().abstraction.between_samples) return std::nullopt;
  return results.abstraction();
}

}  // namespace

CellController::CellController(const ResultsReader& results, ThreadTeam& team)
    : results_(results),
      posts_(results.spec(), results.grid(), results.inputs(), team, stored_abstraction(results)),
      invariant_(results.grid(), [&results](const CellBlock& block) { return results.invariant(block); }),
      safe_(results.grid(), [&results](const CellBlock& block) { return results.safe(block); }),
      admissible_(results.spec(), posts_, sets(team)),
      progress_(results.spec(), posts_, [this](std::int64_t cell) { return arrival(cell); }) {}

AdmissibleInputs::Sets CellController::sets(ThreadTeam& team) {
  AdmissibleInputs::Sets sets{.invariant = &invariant_, .safe = &safe_, .safe_beyond = {}, .listed = {}};
  if (posts_.has_tubes()) {
    safe_beyond_.emplace(results_, posts_, team);
    sets.safe_beyond = [this] { return safe_beyond_->members(); };
  }
  if (results_.spec().controller.file)
    sets.listed = [this](std::int64_t cell, std::int64_t u) { return is_listed(cell, u); };
  return sets;
}

bool CellController::is_listed(std::int64_t cell, std::int64_t u) {
  if (cell != listed_cell_) {
    listed_ = unpacked(results_.listed_bits(one_cell(results_.grid(), cell)), results_.inputs().count());
    listed_cell_ = cell;
  }
  return listed_[at(u)];
}

void CellController::prepare_all() {
  const std::size_t partitions = results_.partitions().size();
  bool stored = partitions > 0;
  for (std::size_t p = 0; p < partitions; ++p) stored = stored && results_.has_actions(p);
  if (results_.has_controller() || stored || results_.spec().controller.synthesis == Synthesis::given) return;
  posts_.prepare_all();
  invariant_.cover_all();
  if (posts_.has_tubes()) safe_.cover_all();
}

const std::vector<bool>& CellController::joint_inputs(std::int64_t cell) {
  if (cell == cell_) return joint_inputs_;
  const CellBlock block = one_cell(results_.grid(), cell);
  if (results_.has_controller()) {
    joint_inputs_ = unpacked(results_.controller_bits(block), results_.inputs().count());
  } else {
    joint_inputs_.assign(at(results_.inputs().count()), false);
    if (results_.invariant(block).front() != 0) {
      for (const std::int64_t u : admissible_.of(cell)) joint_inputs_[at(u)] = true;
    }
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
    const InputClass one(results_.inputs(), inputs_of(results_.spec(), spec.classes[c]));
    std::vector<bool>& projection = result.emplace_back(at(stored.actions[c]), false);
    for (std::int64_t u = 0; u < results_.inputs().count(); ++u) {
      if (admissible[at(u)]) projection[at(one.action(u))] = true;
    }
  }
  return result;
}

std::int32_t CellController::arrival(std::int64_t cell) {
  const auto [place, is_new] = arrivals_.try_emplace(cell, 0);
  if (is_new) {
    const CellBlock block = one_cell(results_.grid(), cell);
    place->second = results_.values(results_.field("/arrival"), std::nullopt, block).front();
  }
  return place->second;
}

std::vector<bool> CellController::inputs_of_run(std::int64_t cell) {
  std::vector<bool> result = joint_inputs(cell);
  if (!results_.spec().goal || arrival(cell) <= 0 || arrival(cell) == ResultsReader::kNever) return result;
  std::vector<std::int64_t> admissible;
  for (std::size_t u = 0; u < result.size(); ++u) {
    if (result[u]) admissible.push_back(static_cast<std::int64_t>(u));
  }
  result.assign(result.size(), false);
  for (const std::int64_t u : progress_.of(cell, admissible)) result[at(u)] = true;
  return result;
}

std::vector<std::vector<bool>> CellController::approach_actions(std::size_t partition, std::int64_t cell) {
  const PartitionSpec& spec = results_.spec().coordination.partitions[partition];
  const bool is_on_the_way = arrival(cell) > 0 && arrival(cell) != ResultsReader::kNever;
  const std::vector<bool> joint = inputs_of_run(cell);
  std::vector<std::vector<bool>> result;
  for (const auto& agents : spec.classes) {
    const InputClass one(results_.inputs(), inputs_of(results_.spec(), agents));
    std::vector<bool>& projection = result.emplace_back(at(one.actions()), false);
    for (std::size_t u = 0; is_on_the_way && u < joint.size(); ++u) {
      if (joint[u]) projection[at(one.action(static_cast<std::int64_t>(u)))] = true;
    }
  }
  return result;
}

std::vector<std::vector<bool>> CellController::convention(std::int64_t cell) {
  const std::vector<InputClass> agents = agent_classes(results_.spec(), results_.inputs());
  if (!results_.has_convention()) return convention_at(inputs_of_run(cell), agents);
  std::vector<std::vector<bool>> result;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const CellBlock block = one_cell(results_.grid(), cell);
    result.push_back(unpacked(results_.convention_bits(i, block), agents[i].actions()));
  }
  return result;
}

}  // namespace coordreq
