#include "analysis/compose_results.hpp"

#include <algorithm>
#include <numeric>

#include "analysis/result_arrays.hpp"
#include "answers/invariance/action_bits.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/requirements/answer.hpp"
#include "model/uniform_grid.hpp"
#include "spec/partition_names.hpp"

namespace coordreq {
namespace {

/// One type for all partitions, which share an array.
ElementType delay_type(const std::vector<DelayLayers>& partitions) {
  std::int64_t greatest = 0;
  for (const DelayLayers& layers : partitions) {
    // In Z_F and not in Z_{F+1} is nobody: the greatest finite delay is F - 1, or what stopped the
    // iteration.
    const std::int64_t last = static_cast<std::int64_t>(layers.sizes.size()) - 1;
    greatest = std::max(greatest, layers.truncated ? last : last - 1);
  }
  return level_type(greatest);
}

}  // namespace

ResultContent ResultComposer::content() {
  const ProblemSpec& spec = ground_.spec;
  const auto& invariance = answers_.get<Invariance>();
  const LevelMap& collision_time = invariance.collision_time;
  const std::int64_t iterations = invariance.iterations;
  ResultContent content{
      .name = spec.name,
      .spec_text = spec.text,
      .guarantee = guarantee_of(spec),
      .period = nearest_double(spec.dynamics.period),
      .period_unit = spec.dynamics.unit,
      .connection_delay = spec.coordination.connection_delay,
      .triggers_are_delays = spec.coordination.connection_delay == 0,
      .axes = axes(),
      .safe_cells = static_cast<std::uint64_t>(ground_.safe.count()),
      .invariant_cells = static_cast<std::uint64_t>(invariance.invariant.count()),
      .safe = safe_array(collision_time, *ground_.order),
      .invariant = invariant_array(collision_time, *ground_.order),
      .collision_time = collision_array(collision_time, *ground_.order, level_type(iterations - 1)),
      .iterations = iterations};
  const std::vector<DelayLayers>& partitions = answers_.get<PartitionLayers>().partitions;
  for (std::size_t p = 0; p < partitions.size(); ++p)
    content.partitions.push_back(partition_content(p, delay_type(partitions)));
  if (spec.output.controller) {
    content.controller =
        bits(groupings_.emplace_back(
                 *ground_.engine, std::vector<InputClass>{whole_class(ground_.abstraction->inputs)}, team_),
             0, "");
  }
  if (ground_.listed) {
    content.listed = listed_bits();
    content.listed_sha256 = ground_.listed->sha256;
  }
  if (const auto* convention = answers_.find<ConventionAnswer>()) add_convention(*convention, content);
  if (spec.output.abstraction) content.abstraction = tables();
  if (const auto* network = answers_.find<NetworkSafety>()) add_network(*network, content);
  if (const auto* map = answers_.find<CoalitionMap>()) add_coalitions(answers_, *map, content);
  if (const auto* verdicts = answers_.find<RequirementVerdicts>())
    content.requirements = verdicts->requirements;
  return content;
}

void ResultComposer::add_network(const NetworkSafety& network, ResultContent& content) const {
  ResultNames& modes = content.names.emplace_back(
      ResultNames{.name = "mode", .long_name = "mode of the network", .names = {}});
  ResultMap& map = content.maps.emplace_back(
      ResultMap{.name = "network_safe",
                .long_name = "from here the agents stay safe if the network is in this mode",
                .leading = "mode",
                .flags = {{0, "not_safe"}, {1, "safe"}},
                .values = sets_array(network.safe, *ground_.order)});
  for (const NetworkModeSpec& mode : ground_.spec.network->modes) modes.names.push_back(mode.name);
  for (const CellSet& safe : network.safe) map.cells.push_back(safe.count());
}

std::vector<ResultAxis> ResultComposer::axes() const {
  const ProblemSpec& spec = ground_.spec;
  std::vector<ResultAxis> result;
  const UniformGrid grid = make_grid(spec);
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const GridDimension& dimension = grid[i];
    ResultAxis& axis = result.emplace_back(ResultAxis{
        .name = dimension.name, .unit = spec.states[i].unit, .step = nearest_double(dimension.step)});
    for (std::int64_t k = 0; k < dimension.count; ++k)
      axis.points.push_back(nearest_double(dimension.point(k)));
  }
  for (const InputSpec& input : spec.inputs) {
    ResultAxis& axis =
        result.emplace_back(ResultAxis{.name = input.name, .unit = input.unit, .is_state = false});
    if (input.grid) axis.step = nearest_double(input.grid->step);
    for (const Rational& value : input.values) axis.points.push_back(nearest_double(value));
  }
  return result;
}

ResultPartition ResultComposer::partition_content(std::size_t p, ElementType type) {
  const ProblemSpec& spec = ground_.spec;
  const PartitionSpec& partition = spec.coordination.partitions[p];
  const DelayLayers& layers = answers_.get<PartitionLayers>().partitions[p];
  const LevelMap& collision_time = answers_.get<Invariance>().collision_time;
  ResultPartition result{.name = partition.name,
                         .layer_sizes = {layers.sizes.begin(), layers.sizes.end()},
                         .fixed_point_index = layers.fixed_point_index,
                         .truncated = layers.truncated,
                         .unbounded = layers.truncated ? 0 : static_cast<std::uint64_t>(layers.sizes.back()),
                         .delay = delay_array(layers, collision_time, *ground_.order, type),
                         .trigger = trigger_array(layers, collision_time, spec.coordination.connection_delay,
                                                  *ground_.order, type)};
  for (const auto& agents : partition.classes) result.classes.push_back(class_name(spec.agents, agents));
  if (spec.output.layers) result.layers = layer_lists(layers, *ground_.order);
  if (!spec.output.actions) return result;
  const ActionGrouping& grouping = groupings_.emplace_back(
      *ground_.engine, input_classes(spec, ground_.abstraction->inputs, partition), team_);
  for (std::size_t c = 0; c < result.classes.size(); ++c)
    result.actions.push_back(bits(grouping, c, result.classes[c]));
  return result;
}

ResultBits ResultComposer::bits(const ActionGrouping& grouping, std::size_t c,
                                const std::string& name) const {
  ResultBits result{.class_name = name, .actions = static_cast<std::uint64_t>(grouping[c].actions())};
  for (const std::int32_t i : grouping[c].inputs())
    result.inputs.push_back(ground_.spec.inputs[static_cast<std::size_t>(i)].name);
  result.fill = [controller = answers_.get<Controller>(), &grouping, c](std::uint64_t begin,
                                                                        std::uint64_t count, void* out) {
    fill_action_bits(controller, grouping, c, begin, count, out);
  };
  return result;
}

void ResultComposer::add_convention(const ConventionAnswer& convention, ResultContent& content) const {
  ResultNames& agents =
      content.names.emplace_back(ResultNames{.name = "agent", .long_name = "agent", .names = {}});
  for (const AgentSpec& agent : ground_.spec.agents) agents.names.push_back(agent.name);
  content.maps.push_back(
      {.name = "convention_freedom",
       .long_name = "part of its admissible actions that an agent keeps under the convention",
       .leading = "agent",
       .flags = {},
       .values = freedom_array(convention.freedom, *ground_.order)});
  for (std::size_t i = 0; ground_.spec.output.actions && i < agents.names.size(); ++i) {
    ResultBits& own = content.convention.emplace_back(bits(convention.agents, i, agents.names[i]));
    own.fill = [this, &convention, i](std::uint64_t begin, std::uint64_t count, void* out) {
      fill_convention_bits(answers_.get<Controller>(), *ground_.hull, convention.agents, i, begin, count,
                           out);
    };
  }
}

ResultBits ResultComposer::listed_bits() const {
  const PackedPairs& pairs = ground_.listed->pairs;
  ResultBits result{.class_name = "", .actions = static_cast<std::uint64_t>(pairs.inputs)};
  for (const InputSpec& input : ground_.spec.inputs) result.inputs.push_back(input.name);
  result.fill = [&pairs](std::uint64_t begin, std::uint64_t count, void* out) {
    std::copy_n(pairs.bytes.begin() + static_cast<std::ptrdiff_t>(begin), count,
                static_cast<std::uint8_t*>(out));
  };
  return result;
}

std::vector<ResultTable> ResultComposer::tables() const {
  const ProblemSpec& spec = ground_.spec;
  std::vector<ResultTable> result;
  for (std::size_t i = 0; i < ground_.abstraction->tables.size(); ++i) {
    const TransitionTable table = written_out(*ground_.abstraction, i);
    ResultTable& stored = result.emplace_back(ResultTable{.state = ground_.abstraction->grid[i].name});
    for (const std::int32_t j : table.states)
      stored.depends_on.push_back(spec.states[static_cast<std::size_t>(j)].name);
    for (const std::int32_t j : table.inputs)
      stored.depends_on.push_back(spec.inputs[static_cast<std::size_t>(j)].name);
    for (const IndexRange& range : table.entries) {
      stored.first.push_back(range.first);
      stored.last.push_back(range.last);
    }
  }
  return result;
}

}  // namespace coordreq
