#include "analysis/summarise.hpp"

#include <algorithm>

#include "answers/coalition/answer.hpp"
#include "answers/convention/answer.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/network/answer.hpp"
#include "answers/requirements/answer.hpp"
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

PartitionSummary summary_of(const ProblemSpec& spec, const PartitionSpec& partition,
                            const DelayLayers& layers) {
  PartitionSummary result{.name = partition.name,
                          .fixed_point_index = layers.fixed_point_index,
                          .fixed_point = layers.truncated ? 0 : layers.sizes.back(),
                          .layers = layers.sizes,
                          .truncated = layers.truncated};
  for (const auto& agents : partition.classes) result.classes.push_back(class_name(spec.agents, agents));
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

CoalitionSummary summary_of(const CoalitionMap& map, const ProblemSpec& spec) {
  const Rational steps(static_cast<long>(map.horizon));
  CoalitionSummary summary{.horizon = map.horizon,
                           .horizon_time = nearest_double(Rational(spec.dynamics.period * steps)),
                           .without = map.without};
  for (std::size_t i = 0; i < map.choices.size(); ++i) {
    const CoalitionChoice& choice = map.choices[i];
    summary.choices.push_back({.partition = spec.coordination.partitions[choice.partition].name,
                               .cost = nearest_double(choice.cost),
                               .cells = map.cells[i]});
  }
  for (std::size_t i = 0; i < map.pairs.size(); ++i)
    summary.critical_pairs.emplace_back(pair_name(spec, map.pairs[i]), map.critical_cells[i]);
  return summary;
}

}  // namespace

AnalysisSummary summarise(const Answers& answers) {
  const Ground& ground = answers.ground;
  const ProblemSpec& spec = ground.spec;
  AnalysisSummary summary;
  summary.name = spec.name;
  summary.states = ground.abstraction->grid.points();
  summary.inputs = ground.abstraction->inputs.count();
  if (ground.listed)
    summary.controller = {{*spec.controller.file, ground.listed->sha256, ground.listed->pairs.count()}};
  summary.safe = ground.safe.count();
  const auto& invariance = answers.get<Invariance>();
  summary.invariant = invariance.invariant.count();
  summary.iterations = invariance.iterations;
  summary.guarantee = guarantee_of(spec);
  summary.period = nearest_double(spec.dynamics.period);
  summary.period_unit = spec.dynamics.unit;
  summary.connection_delay = spec.coordination.connection_delay;
  summary.work.push_back(work_of("invariance", invariance.counts));
  for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p) {
    const PartitionSpec& partition = spec.coordination.partitions[p];
    const DelayLayers& layers = answers.get<PartitionLayers>().partitions[p];
    summary.partitions.push_back(summary_of(spec, partition, layers));
    summary.work.push_back(work_of("layers " + partition.name, layers.counts));
  }
  if (const auto* map = answers.find<CoalitionMap>()) summary.coalition = summary_of(*map, spec);
  if (const auto* network = answers.find<NetworkSafety>()) {
    summary.network = summary_of(*spec.network, *network);
    summary.work.push_back(work_of("network", network->counts));
  }
  const auto* const convention = answers.find<ConventionAnswer>();
  for (std::size_t i = 0; convention != nullptr && i < spec.agents.size(); ++i) {
    const ConventionFreedom::Agent& own = convention->freedom.agents[i];
    summary.convention.push_back({.agent = spec.agents[i].name,
                                  .mean = own.mean,
                                  .full = own.full,
                                  .histogram = {own.histogram.begin(), own.histogram.end()}});
  }
  if (const auto* verdicts = answers.find<RequirementVerdicts>())
    summary.requirements = verdicts->requirements;
  return summary;
}

}  // namespace coordreq
