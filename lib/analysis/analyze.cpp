#include "analysis/analyze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "abstraction/build_abstraction.hpp"
#include "analysis/layout.hpp"
#include "analysis/result_arrays.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "coordination/action_bits.hpp"
#include "coordination/delay_layers.hpp"
#include "results/write_results.hpp"
#include "safety/invariance.hpp"
#include "safety/safe_set.hpp"
#include "safety/safe_tubes.hpp"

namespace coordreq {
namespace {

std::vector<InputClass> input_classes(const ProblemSpec& spec, const PartitionSpec& partition) {
  std::vector<InputClass> classes;
  for (const auto& agents : partition.classes) {
    InputClass inputs;
    for (const std::int32_t agent : agents) {
      const auto& own = spec.agents[static_cast<std::size_t>(agent)].inputs;
      inputs.insert(inputs.end(), own.begin(), own.end());
    }
    std::sort(inputs.begin(), inputs.end());
    classes.push_back(std::move(inputs));
  }
  return classes;
}

std::string class_name(const ProblemSpec& spec, const std::vector<std::int32_t>& agents) {
  std::string name;
  for (const std::int32_t agent : agents) {
    name += (name.empty() ? "" : "+") + spec.agents[static_cast<std::size_t>(agent)].name;
  }
  return name;
}

/// One partition with all that its arrays refer to while the results are written.
struct PartitionResult {
  const PartitionSpec* spec = nullptr;
  ActionGrouping grouping;
  DelayLayers layers;
};

/// The analysis from the spec to the results file, in the order of its stages.
class Analysis {
 public:
  Analysis(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team)
      : spec_(spec), options_(options), team_(team), layout_(choose_layout(spec)) {}

  AnalysisSummary run() {
    enter("abstraction");
    const ProblemSpec engine_spec = laid_out(spec_, layout_);
    const Abstraction abstraction = build_abstraction(engine_spec, team_);
    enter("safe set");
    const CellSet safe = safe_set(engine_spec, abstraction, team_);
    const std::optional<ConditionTable> allow = allow_table(engine_spec, abstraction, team_);
    const std::optional<CellSet> beyond = safe_beyond_limits(engine_spec, abstraction, safe, team_);
    const SafeTubes tubes{spec_.abstraction.between_samples ? &safe : nullptr, beyond ? &*beyond : nullptr};
    const RowEngine engine(abstraction, allow ? &*allow : nullptr, tubes);
    const RowHull hull(engine);
    enter("invariance");
    const Invariance invariance =
        find_invariance(engine, hull, safe, spec_.controller.synthesis, stepper("invariance"), team_);
    const Controller controller{&engine, &invariance.invariant, &invariance.collision_time,
                                spec_.controller.synthesis};
    std::deque<PartitionResult> partitions;  // a deque, so that references stay valid
    for (const PartitionSpec& partition : spec_.coordination.partitions) {
      const std::string stage = "layers " + partition.name;
      enter(stage);
      PartitionResult& result = partitions.emplace_back(
          PartitionResult{&partition, ActionGrouping(engine, input_classes(spec_, partition), team_), {}});
      const Projections projections(controller, result.grouping, hull, team_);
      result.layers = find_delay_layers(engine, hull, invariance.invariant, projections,
                                        spec_.coordination.max_delay, stepper(stage), team_);
    }
    enter("writing");
    add_work("invariance", invariance.counts);
    for (const PartitionResult& partition : partitions) {
      add_work("layers " + partition.spec->name, partition.layers.counts);
    }
    summarise(abstraction, safe, invariance, partitions);
    write(controller, abstraction, invariance, partitions);
    timer_.end();
    summary_.seconds = timer_.seconds();
    summary_.peak_memory_bytes = peak_memory_bytes();
    return std::move(summary_);
  }

 private:
  void enter(const std::string& stage) {
    timer_.begin(stage);
    report({.stage = stage});
  }

  void report(const Progress& progress) const {
    if (options_.progress) options_.progress(progress);
  }

  [[nodiscard]] std::function<void(std::int64_t, std::int64_t)> stepper(const std::string& stage) const {
    return [this, stage](std::int64_t sweep, std::int64_t rows) { report({stage, sweep, rows}); };
  }

  void add_work(const std::string& stage, const WaveCounts& counts) {
    summary_.work.push_back({stage, counts.sweeps, counts.rows_visited, counts.rows_skipped});
  }

  void summarise(const Abstraction& abstraction, const CellSet& safe, const Invariance& invariance,
                 const std::deque<PartitionResult>& partitions) {
    summary_.name = spec_.name;
    summary_.states = abstraction.grid.cells();
    summary_.inputs = abstraction.inputs.count();
    summary_.safe = safe.count();
    summary_.invariant = invariance.invariant.count();
    summary_.iterations = invariance.iterations;
    summary_.guarantee = guarantee_of(spec_);
    summary_.period = nearest_double(spec_.dynamics.period);
    summary_.period_unit = spec_.dynamics.unit;
    for (const PartitionResult& partition : partitions) summary_.partitions.push_back(summary_of(partition));
    summary_.output = options_.output;
    summary_.threads = team_.size();
  }

  [[nodiscard]] PartitionSummary summary_of(const PartitionResult& partition) const {
    const DelayLayers& layers = partition.layers;
    PartitionSummary result{.name = partition.spec->name,
                            .fixed_point_index = layers.fixed_point_index,
                            .fixed_point = layers.truncated ? 0 : layers.sizes.back(),
                            .layers = layers.sizes,
                            .truncated = layers.truncated};
    for (const auto& agents : partition.spec->classes) result.classes.push_back(class_name(spec_, agents));
    if (result.fixed_point == 0 && layers.sizes.front() > 0) {
      // Z_k shrinks strictly, so the last layer that is not empty holds the largest delay.
      const std::size_t steps = layers.sizes.size() - (layers.truncated ? 1 : 2);
      result.max_delay_time =
          nearest_double(spec_.dynamics.period * Rational(static_cast<unsigned long>(steps)));
    }
    return result;
  }

  void write(const Controller& controller, const Abstraction& abstraction, const Invariance& invariance,
             const std::deque<PartitionResult>& partitions) const {
    const CellOrder order(abstraction.grid, place_of_states());
    const LevelMap& collision_time = invariance.collision_time;
    ResultContent content{.name = spec_.name,
                          .spec_text = spec_.text,
                          .guarantee = guarantee_of(spec_),
                          .period = nearest_double(spec_.dynamics.period),
                          .period_unit = spec_.dynamics.unit,
                          .connection_delay = spec_.coordination.connection_delay,
                          .triggers_are_delays = spec_.coordination.connection_delay == 0,
                          .axes = axes(abstraction),
                          .safe_cells = static_cast<std::uint64_t>(summary_.safe),
                          .invariant_cells = static_cast<std::uint64_t>(summary_.invariant),
                          .safe = safe_array(collision_time, order),
                          .invariant = invariant_array(collision_time, order),
                          .iterations = invariance.iterations};
    content.collision_time = collision_array(collision_time, order, level_type(invariance.iterations - 1));
    for (const PartitionResult& partition : partitions) {
      content.partitions.push_back(partition_content(controller, partition, order, delay_type(partitions)));
    }
    std::optional<ActionGrouping> all_inputs;
    if (spec_.output.controller) {
      all_inputs.emplace(*controller.engine, std::vector<InputClass>{all_input_indices()}, team_);
      content.controller = bits(controller, *all_inputs, 0, "");
    }
    if (spec_.output.abstraction) content.abstraction = tables(abstraction);
    write_results(options_.output, content, team_);
  }

  /// One type for all partitions, which share an array.
  [[nodiscard]] static ElementType delay_type(const std::deque<PartitionResult>& partitions) {
    std::int64_t greatest = 0;
    for (const PartitionResult& partition : partitions) {
      // In Z_F and not in Z_{F+1} is nobody: the greatest finite delay is F - 1, or what stopped the
      // iteration.
      const DelayLayers& layers = partition.layers;
      const std::int64_t last = static_cast<std::int64_t>(layers.sizes.size()) - 1;
      greatest = std::max(greatest, layers.truncated ? last : last - 1);
    }
    return level_type(greatest);
  }

  /// Where each state of the spec stands in the grid.
  [[nodiscard]] std::vector<std::size_t> place_of_states() const {
    std::vector<std::size_t> place(layout_.size());
    for (std::size_t d = 0; d < layout_.size(); ++d) place[layout_[d]] = d;
    return place;
  }

  [[nodiscard]] std::vector<ResultAxis> axes(const Abstraction& abstraction) const {
    std::vector<ResultAxis> result;
    const std::vector<std::size_t> place = place_of_states();
    for (std::size_t i = 0; i < spec_.states.size(); ++i) {
      const GridDimension& dimension = abstraction.grid[place[i]];
      ResultAxis& axis = result.emplace_back(ResultAxis{
          .name = dimension.name, .unit = spec_.states[i].unit, .step = nearest_double(dimension.step)});
      for (std::int64_t k = 0; k < dimension.count; ++k)
        axis.points.push_back(nearest_double(dimension.point(k)));
    }
    for (const InputSpec& input : spec_.inputs) {
      ResultAxis& axis =
          result.emplace_back(ResultAxis{.name = input.name, .unit = input.unit, .is_state = false});
      if (input.grid) axis.step = nearest_double(input.grid->step);
      for (const Rational& value : input.values) axis.points.push_back(nearest_double(value));
    }
    return result;
  }

  [[nodiscard]] ResultPartition partition_content(const Controller& controller,
                                                  const PartitionResult& partition, const CellOrder& order,
                                                  ElementType type) const {
    const DelayLayers& layers = partition.layers;
    const LevelMap& collision_time = *controller.collision_time;
    ResultPartition result{
        .name = partition.spec->name,
        .layer_sizes = {layers.sizes.begin(), layers.sizes.end()},
        .fixed_point_index = layers.fixed_point_index,
        .truncated = layers.truncated,
        .unbounded = layers.truncated ? 0 : static_cast<std::uint64_t>(layers.sizes.back()),
        .delay = delay_array(layers, collision_time, order, type),
        .trigger = trigger_array(layers, collision_time, spec_.coordination.connection_delay, order, type)};
    for (const auto& agents : partition.spec->classes) result.classes.push_back(class_name(spec_, agents));
    if (spec_.output.layers) result.layers = layer_lists(layers, order);
    for (std::size_t c = 0; spec_.output.actions && c < result.classes.size(); ++c) {
      result.actions.push_back(bits(controller, partition.grouping, c, result.classes[c]));
    }
    return result;
  }

  [[nodiscard]] InputClass all_input_indices() const {
    InputClass all;
    for (std::size_t i = 0; i < spec_.inputs.size(); ++i) all.push_back(static_cast<std::int32_t>(i));
    return all;
  }

  [[nodiscard]] ResultBits bits(const Controller& controller, const ActionGrouping& grouping, std::size_t c,
                                const std::string& name) const {
    ResultBits result{.class_name = name, .actions = static_cast<std::uint64_t>(grouping.actions(c))};
    for (const std::int32_t i : grouping.inputs(c))
      result.inputs.push_back(spec_.inputs[static_cast<std::size_t>(i)].name);
    result.fill = [controller, &grouping, c](std::uint64_t begin, std::uint64_t count, void* out) {
      fill_action_bits(controller, grouping, c, begin, count, out);
    };
    return result;
  }

  [[nodiscard]] std::vector<ResultTable> tables(const Abstraction& abstraction) const {
    std::vector<ResultTable> result;
    for (std::size_t i = 0; i < abstraction.tables.size(); ++i) {
      const TransitionTable table = written_out(abstraction, i);
      ResultTable& stored = result.emplace_back(ResultTable{.state = abstraction.grid[i].name});
      for (const std::int32_t j : table.states)
        stored.depends_on.push_back(spec_.states[static_cast<std::size_t>(j)].name);
      for (const std::int32_t j : table.inputs)
        stored.depends_on.push_back(spec_.inputs[static_cast<std::size_t>(j)].name);
      for (const IndexRange& range : table.entries) {
        stored.first.push_back(range.first);
        stored.last.push_back(range.last);
      }
    }
    return result;
  }

  const ProblemSpec& spec_;
  const AnalysisOptions& options_;
  ThreadTeam& team_;
  std::vector<std::size_t> layout_;  ///< the state of each dimension of the engine
  StageTimer timer_;
  AnalysisSummary summary_;
};

}  // namespace

AnalysisSummary analyze(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team) {
  check_memory(spec, options.max_memory);
  check_writable(options.output);
  return Analysis(spec, options, team).run();
}

}  // namespace coordreq
