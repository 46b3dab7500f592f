#include <algorithm>
#include <utility>
#include <vector>

#include "answers/blind/answer.hpp"
#include "answers/countdown/fields.hpp"
#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"

namespace coordreq {
namespace {

Field blind_steps(const std::string& name, const ProblemSpec& spec, std::string long_name,
                  FieldDisplay display) {
  return steps_field(name, spec, kOutsideSafe,
                     described(std::move(long_name)) +
                         std::vector<FieldAttribute>{flags({{kOutsideSafe, "not_safe"},
                                                            {kOutsideInvariant, "not_invariant"},
                                                            {kLargestValue, "unbounded"}})},
                     std::move(display), "/blind_fixed_point_index");
}

void add_table(Fields& fields, const ProblemSpec& spec, const PartitionSpec& partition, std::size_t c) {
  const std::string path = paths::silent(spec, partition, c);
  const std::vector<std::int32_t> inputs = inputs_of(spec, partition.classes[c]);
  const auto actions = static_cast<std::uint64_t>(joint_actions(spec, inputs));
  constexpr FieldSection kSection = FieldSection::actions;
  fields.push_back(bare_scale(path + ":byte", kSection, (actions + 7) / 8, (actions + 7) / 8));
  std::vector<std::string> axes{paths::kSilentLayer};
  for (const std::size_t i : seen_states(spec, partition.classes[c]))
    axes.push_back("/" + spec.states[i].name);
  axes.push_back(path + ":byte");
  std::string names;
  for (const std::int32_t i : inputs) names += (names.empty() ? "" : " ") + spec.inputs[at(i)].name;
  fields.push_back(
      {.path = path,
       .section = kSection,
       .types = {ElementType::uint8},
       .axes = std::move(axes),
       .most = UINT8_MAX,
       .attributes =
           described("joint actions that the class may take in silence, by what it sees, one bit each") +
           std::vector<FieldAttribute>{
               {"inputs", names}, {"actions", actions}, {"bitorder", std::string("little")}}});
}

/// Bytes [layer, fibre, byte] of a table; layers beyond the last one repeat it.
ResultArray table_array(const SilentTable& table, std::int64_t layers) {
  const std::int64_t bytes = (table.actions + 7) / 8;
  return {ElementType::uint8, [&table, layers, bytes](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* const target = static_cast<std::uint8_t*>(out);
            for (std::uint64_t i = 0; i < count; ++i) {
              const auto number = static_cast<std::int64_t>(begin + i);
              const std::int64_t fibre = number / bytes % table.fibres();
              const std::int64_t k = std::min(number / bytes / table.fibres() + 1, layers);
              const std::int64_t first = number % bytes * 8;
              unsigned bits = 0;
              for (std::int64_t a = first; a < std::min(first + 8, table.actions); ++a)
                bits |= (table.allows(fibre, a, k) ? 1U : 0U) << (a - first);
              target[i] = static_cast<std::uint8_t>(bits);
            }
          }};
}

void fill_tables(const Answers& answers, FieldValues& values) {
  const ProblemSpec& spec = answers.context.spec;
  const Blind* const blind = answers.find<Blind>();
  if (blind == nullptr) return;
  std::int64_t longest = 0;
  for (std::size_t p = 0; p < blind->partitions.size(); ++p) {
    const PartitionSpec& partition = spec.coordination.partitions[p];
    const BlindPartition& blind_partition = blind->partitions[p];
    for (std::size_t c = 0; c < blind_partition.tables.size(); ++c) {
      if (!has_silent_table(spec, partition, c)) continue;
      longest = std::max(longest, blind_partition.table_steps());
      values.entries[paths::silent(spec, partition, c)].array =
          table_array(blind_partition.tables[c], blind_partition.table_steps());
    }
  }
  if (longest > 0) values.lengths[paths::kSilentLayer] = static_cast<std::uint64_t>(longest);
}

}  // namespace

std::string paths::silent(const ProblemSpec& spec, const PartitionSpec& partition, std::size_t class_number) {
  return "/silent/" + partition.name + "/" + class_name(spec.agents, partition.classes[class_number]);
}

bool has_silent_table(const ProblemSpec& spec, const PartitionSpec& partition, std::size_t class_number) {
  return partition.classes.size() > 1 &&
         seen_states(spec, partition.classes[class_number]).size() < spec.states.size();
}

/// Blind delays and countdowns, sizes of blind layers, F_b, and the silent tables. None if all agents see
/// everything.
Fields blind_fields(const ProblemSpec& spec) {
  if (!has_limited_sight(spec)) return {};
  Fields fields;
  fields.push_back(
      blind_steps("blind_delay", spec,
                  "largest number of steps without coordination that is safe if agents see only what they "
                  "read themselves",
                  {.column = "blind_delay",
                   .compared = "blind delay",
                   .query = {.label = "blind delay"},
                   .map = {.kind = "blind_delay", .title = "Silence with own observations only"}}));
  fields.push_back(blind_steps("blind_countdown", spec,
                               "steps of silence that are left where agents no longer know the cell",
                               {.column = "blind_countdown", .query = {.label = "blind steps left"}}));
  add_sizes(fields, kBlindKind, cell_count(spec), spec);
  const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
  const bool has_tables = std::ranges::any_of(
      partitions, [&](const PartitionSpec& partition) { return has_limited_sight(spec, partition); });
  if (has_tables)
    fields.push_back(number_scale(paths::kSilentLayer, FieldSection::axes, 1, SilentTable::kMostSteps,
                                  "steps of silence that are left", 1));
  for (const PartitionSpec& partition : partitions) {
    for (std::size_t c = 0; c < partition.classes.size(); ++c) {
      if (has_silent_table(spec, partition, c)) add_table(fields, spec, partition, c);
    }
  }
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_blind_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const ProblemSpec& spec = answers.context.spec;
  if (!has_limited_sight(spec)) return;
  const LevelMap& times = answers.get<Invariance>().collision_time;
  const CellOrder& order = *answers.context.order;
  const std::size_t count = spec.coordination.partitions.size();
  LayersOfPartitions all;
  for (std::size_t p = 0; p < count; ++p) all.push_back(&blind_layers(answers, p));
  std::int64_t longest = 0;
  for (std::size_t p = 0; p < count; ++p)
    longest =
        std::max(longest, &blind_delays(answers, p) == all[p] ? longest_delay({all[p]})
                                                              : answers.get<Blind>().partitions[p].greatest);
  std::vector<ResultArray> delays;
  for (std::size_t p = 0; p < count; ++p)
    delays.push_back(delay_array(blind_delays(answers, p), times, order, level_type(longest)));
  values.entries[paths::kBlindDelay].array = stacked_array(cell_count(spec), std::move(delays));
  fill_steps(answers, all, paths::kBlindCountdown, "", values);
  fill_sizes(all, kBlindKind, values);
  fill_tables(answers, values);
}

const DelayLayers& blind_layers(const Answers& answers, std::size_t p) {
  const bool is_one_class = answers.context.spec.coordination.partitions[p].classes.size() == 1;
  return is_one_class ? answers.get<PartitionLayers>().partitions[p]
                      : answers.get<Blind>().partitions[p].layers;
}

const DelayLayers& blind_delays(const Answers& answers, std::size_t p) {
  const bool is_one_class = answers.context.spec.coordination.partitions[p].classes.size() == 1;
  return is_one_class ? answers.get<PartitionLayers>().partitions[p]
                      : answers.get<Blind>().partitions[p].delays;
}

}  // namespace coordreq
