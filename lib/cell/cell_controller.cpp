#include "cell/cell_controller.hpp"

#include <algorithm>
#include <utility>

#include "answers/paths.hpp"
#include "answers/plan.hpp"
#include "base/error.hpp"
#include "base/index.hpp"
#include "model/input_class.hpp"
#include "reach/table_shapes.hpp"
#include "reach/thread_memory.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

CellPolicy::Numbers numbers_of(const std::vector<bool>& members) {
  CellPolicy::Numbers numbers;
  for (std::size_t u = 0; u < members.size(); ++u) {
    if (members[u]) numbers.push_back(static_cast<std::int64_t>(u));
  }
  return numbers;
}

/// Tubes are not stored.
bool is_stored(const ResultsReader& results) {
  return results.has_abstraction() && !results.spec().abstraction.between_samples;
}

std::optional<Abstraction> stored_abstraction(const ResultsReader& results) {
  if (!is_stored(results)) return std::nullopt;
  return results.abstraction();
}

}  // namespace

double abstraction_bytes(const ResultsReader& results) {
  double bytes = 0, entries = 0, most = 0;
  for (const TableShape& shape : table_shapes(results.spec())) {
    bytes += shape.bytes;
    const double choices = choices_of(results.spec(), shape.states, shape.inputs);
    entries += choices;
    most = std::max(most, choices);
  }
  if (is_stored(results)) return (entries + most) * sizeof(IndexRange);  // and both ends of one while read
  return results.spec().abstraction.between_samples ? 2 * bytes : bytes;
}

std::vector<bool> unpacked(const std::vector<std::uint8_t>& bytes, std::int64_t count) {
  std::vector<bool> bits(at(count));
  for (std::size_t a = 0; a < bits.size(); ++a) bits[a] = (bytes[a / 8] >> (a % 8) & 1U) != 0;
  return bits;
}

double controller_bytes(const ResultsReader& results, bool for_all_cells) {
  constexpr double kBytesOfInput = 64;  // sets of them, and where their posts lie
  const double inputs = kBytesOfInput * static_cast<double>(results.inputs().count());
  const double sums = for_all_cells ? static_cast<double>(results.grid().cells()) : 0;
  const double windows = results.spec().abstraction.between_samples ? 2 : 1;
  const std::vector<TableShape> shapes = table_shapes(results.spec());
  const bool is_whole =
      for_all_cells || is_stored(results) ||
      std::any_of(shapes.begin(), shapes.end(), [](const TableShape& shape) { return shape.sum; });
  return inputs + windows * sums * (sizeof(std::int32_t) + 1) + (is_whole ? abstraction_bytes(results) : 0);
}

MemoryDemand controller_demand(const ResultsReader& results, bool for_all_cells) {
  return {.once = results.reading_bytes() + controller_bytes(results, for_all_cells),
          .of_thread = is_stored(results) ? 0 : kBytesOfPostThread};
}

CellController::CellController(const ResultsReader& results, ThreadTeam& team)
    : results_(results),
      policies_(answer_policies(results.spec())),
      posts_(results.spec(), results.grid(), results.inputs(), team, stored_abstraction(results)),
      invariant_(results.grid(),
                 [&results](const CellBlock& block) { return results.members(paths::kInvariant, block); }),
      safe_(results.grid(),
            [&results](const CellBlock& block) { return results.members(paths::kSafe, block); }),
      admissible_(results.spec(), posts_, sets(team)) {}

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
    listed_ =
        unpacked(results_.bits(paths::kListed, one_cell(results_.grid(), cell)), results_.inputs().count());
    listed_cell_ = cell;
  }
  return listed_[at(u)];
}

void CellController::prepare_all() {
  const ProblemSpec& spec = results_.spec();
  if (spec.output.controller || spec.output.actions || spec.controller.synthesis == Synthesis::given) return;
  posts_.prepare_all();
  invariant_.cover_all();
  if (posts_.has_tubes()) safe_.cover_all();
}

const std::vector<bool>& CellController::joint_inputs(std::int64_t cell) {
  if (cell == cell_) return joint_inputs_;
  const CellBlock block = one_cell(results_.grid(), cell);
  if (results_.has(paths::kController)) {
    joint_inputs_ = unpacked(results_.bits(paths::kController, block), results_.inputs().count());
  } else {
    joint_inputs_.assign(at(results_.inputs().count()), false);
    if (results_.members(paths::kInvariant, block).front() != 0) {
      for (const std::int64_t u : admissible_.of(cell)) joint_inputs_[at(u)] = true;
    }
  }
  cell_ = cell;
  return joint_inputs_;
}

std::vector<bool> CellController::joint_inputs(const AnswerPolicy& policy, std::int64_t cell) {
  PartitionPolicy& entry = policy_of(policy, 0);
  const CellPolicy::Numbers admissible = numbers_of(joint_inputs(cell));
  if (admissible.empty() || !entry.policy->holds(cell)) return joint_inputs(cell);
  std::vector<bool> result(joint_inputs(cell).size(), false);
  for (const std::int64_t u : entry.policy->together(cell, admissible)) result[at(u)] = true;
  return result;
}

ActionSets CellController::actions(const AnswerPolicy& policy, std::size_t partition, std::int64_t cell,
                                   std::int32_t countdown) {
  PartitionPolicy& entry = policy_of(policy, partition);
  const PartitionSpec& spec = results_.spec().coordination.partitions[partition];
  const CellBlock block = one_cell(results_.grid(), cell);
  const auto path = [&](std::size_t c) { return policy.stored(results_.spec(), spec, c); };
  const bool is_stored = policy.stored != nullptr && results_.has(path(0));
  ActionSets sets;
  for (std::size_t c = 0; is_stored && c < entry.classes.size(); ++c)
    sets.push_back(unpacked(results_.bits(path(c), block), entry.classes[c].actions()));
  if (is_stored) return sets;
  for (const InputClass& one : entry.classes) sets.emplace_back(at(one.actions()), false);
  const CellPolicy::Numbers admissible = numbers_of(joint_inputs(cell));
  const bool is_needed =
      policy.is_anywhere ? results_.members(paths::kSafe, block).front() != 0 : !admissible.empty();
  if (!is_needed || !entry.policy->holds(cell)) return sets;
  const CellPolicy::Numbers& together = entry.policy->together(cell, admissible);
  const auto actions = entry.policy->alone(cell, countdown, together, entry.classes);
  for (std::size_t c = 0; c < sets.size(); ++c) {
    for (const std::int64_t a : actions[c]) sets[c][at(a)] = true;
  }
  return sets;
}

CellController::PartitionPolicy& CellController::policy_of(const AnswerPolicy& policy,
                                                           std::size_t partition) {
  const auto [entry, is_new] = policies_of_.try_emplace({policy.name, policy.is_by_agent ? 0 : partition});
  PartitionPolicy& result = entry->second;
  if (!is_new) return result;
  const ProblemSpec& spec = results_.spec();
  result.classes = policy.is_by_agent
                       ? agent_classes(spec, results_.inputs())
                       : input_classes(spec, results_.inputs(), spec.coordination.partitions[partition]);
  result.policy =
      policy.make({.spec = &spec,
                   .partition = &spec.coordination.partitions[partition],
                   .tables = this,
                   .posts = &posts_,
                   .values = [this, partition](const auto& path) { return values(path, partition); }});
  return result;
}

std::int64_t CellController::length(const std::string& scale) const {
  return static_cast<std::int64_t>(results_.length(scale));
}

std::vector<std::uint8_t> CellController::bytes(const std::string& path,
                                                const std::vector<std::int64_t>& indices) const {
  return results_.bytes(results_.field(path), indices);
}

CellValue CellController::values(const std::string& path, std::size_t partition) {
  const Field& field = results_.field(path);
  const bool is_of_partition = field.axes.front() == "/partition";
  const auto leading = is_of_partition ? ResultsReader::Leading(partition) : std::nullopt;
  return [this, &field, leading, &known = values_[{path, leading.value_or(0)}]](std::int64_t cell) {
    const auto [entry, is_new] = known.try_emplace(cell, 0);
    if (is_new) entry->second = results_.values(field, leading, one_cell(results_.grid(), cell)).front();
    return entry->second;
  };
}

}  // namespace coordreq
