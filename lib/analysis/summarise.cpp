#include "analysis/summarise.hpp"

#include <algorithm>

#include "spec/partition_names.hpp"

namespace coordreq {
namespace {

AnalysisSummary::Work work_of(const std::string& stage, const WaveCounts& counts) {
  return {stage, counts.sweeps, counts.rows_visited, counts.rows_skipped};
}

/// |Z_0 \ Z_D|, where a layer that is not known counts as empty.
std::int64_t cells_bound_to_connect(const DelayLayers& layers, std::int64_t connection_delay) {
  const auto known = static_cast<std::int64_t>(layers.sizes.size());
  if (connection_delay >= known && layers.truncated) return layers.sizes.front();
  return layers.sizes.front() - layers.sizes[static_cast<std::size_t>(std::min(connection_delay, known - 1))];
}

PartitionSummary summary_of(const ProblemSpec& spec, const PartitionResult& partition) {
  const DelayLayers& layers = partition.layers;
  PartitionSummary result{.name = partition.spec->name,
                          .fixed_point_index = layers.fixed_point_index,
                          .fixed_point = layers.truncated ? 0 : layers.sizes.back(),
                          .layers = layers.sizes,
                          .truncated = layers.truncated};
  for (const auto& agents : partition.spec->classes)
    result.classes.push_back(class_name(spec.agents, agents));
  result.never_without_connection = cells_bound_to_connect(layers, spec.coordination.connection_delay);
  if (result.fixed_point == 0 && layers.sizes.front() > 0) {
    // Z_k shrinks strictly, so the last layer that is not empty holds the largest delay.
    const std::size_t steps = layers.sizes.size() - (layers.truncated ? 1 : 2);
    result.max_delay_time =
        nearest_double(spec.dynamics.period * Rational(static_cast<unsigned long>(steps)));
  }
  return result;
}

NetworkSummary summary_of(const NetworkSpec& spec, const NetworkSafety& safety) {
  NetworkSummary result{.kind = network_kind_name(spec.kind), .resynthesise = spec.resynthesise};
  CellSet every = safety.safe.front();
  for (std::size_t mode = 0; mode < spec.modes.size(); ++mode) {
    const CellSet& safe = safety.safe[mode];
    result.modes.push_back({spec.modes[mode].name, spec.modes[mode].partition.name, safe.count()});
    for (std::size_t w = 0; w < safe.words().size(); ++w) every.words()[w] &= safe.words()[w];
  }
  result.every_mode = every.count();
  return result;
}

}  // namespace

AnalysisSummary summarise(const Solution& solution) {
  const ProblemSpec& spec = solution.spec;
  AnalysisSummary summary;
  summary.name = spec.name;
  summary.states = solution.abstraction.grid.points();
  summary.inputs = solution.abstraction.inputs.count();
  if (solution.listed) {
    summary.controller = {{*spec.controller.file, solution.listed->sha256, solution.listed->pairs.count()}};
  }
  summary.safe = solution.safe.count();
  summary.invariant = solution.invariance.invariant.count();
  summary.iterations = solution.invariance.iterations;
  summary.guarantee = guarantee_of(spec);
  summary.period = nearest_double(spec.dynamics.period);
  summary.period_unit = spec.dynamics.unit;
  summary.connection_delay = spec.coordination.connection_delay;
  summary.work.push_back(work_of("invariance", solution.invariance.counts));
  for (const PartitionResult& partition : solution.partitions) {
    summary.partitions.push_back(summary_of(spec, partition));
    summary.work.push_back(work_of("layers " + partition.spec->name, partition.layers.counts));
  }
  if (solution.network) {
    summary.network = summary_of(*spec.network, *solution.network);
    summary.work.push_back(work_of("network", solution.network->counts));
  }
  for (std::size_t i = 0; solution.convention && i < spec.agents.size(); ++i) {
    const ConventionFreedom::Agent& own = solution.convention->freedom.agents[i];
    summary.convention.push_back({.agent = spec.agents[i].name,
                                  .mean = own.mean,
                                  .full = own.full,
                                  .histogram = {own.histogram.begin(), own.histogram.end()}});
  }
  return summary;
}

}  // namespace coordreq
