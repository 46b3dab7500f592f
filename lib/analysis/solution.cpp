#include "analysis/solution.hpp"

#include <algorithm>
#include <utility>

#include "analysis/network_problem.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/layers/projections.hpp"
#include "answers/layers/refinement.hpp"
#include "engine/join_rows.hpp"
#include "reach/build_abstraction.hpp"

namespace coordreq {
namespace {

/// Passes a value on after its stage has been entered: members are initialised one after the other.
template <class Make>
auto staged(const SolutionWatch& watch, const std::string& stage, const Make& make) {
  watch.enter(stage);
  return make();
}

/// First of all, for a file that does not fit is an error that nobody should wait for.
std::optional<ControllerFile> read_listed(const ProblemSpec& spec, const SolutionWatch& watch) {
  if (!spec.controller.file) return std::nullopt;
  return staged(watch, "controller", [&] { return read_controller_file(spec); });
}

/// In the order of the model. Rows run along several dimensions where they can, and all that the spec asks
/// for can be read off them.
Abstraction in_order(const Model& model, Abstraction abstraction) {
  abstraction = arranged(std::move(abstraction), model.order());
  if (!model.is_read_by_runs()) abstraction.grid = join_rows(abstraction);
  return abstraction;
}

/// Tells of every step, and saves it when it is time.
std::function<void(const WaveStep&)> stepper(const SolutionWatch& watch, const std::string& stage,
                                             const RowEngine& engine) {
  // Cells of a row, without its gaps.
  return [&watch, stage, row_length = engine.grid().points() / engine.rows()](const WaveStep& step) {
    watch.step(step, row_length);
    if (watch.checkpoint != nullptr) watch.checkpoint->step(stage, step.state);
  };
}

// What a checkpoint is told to keep is moved to its place only afterwards: the lists in it stay where they
// are.

Abstraction find_abstraction(const ProblemSpec& spec, ThreadTeam& team, const SolutionWatch& watch) {
  const std::string stage = "abstraction";
  watch.enter(stage);
  if (watch.checkpoint == nullptr) return build_abstraction(spec, team);
  std::optional<Abstraction> saved;
  const bool is_saved = watch.checkpoint->take_lists(stage, [&](const auto& numbers, const ReadList& read) {
    saved = load_abstraction(spec, numbers, read);
  });
  Abstraction abstraction = is_saved ? std::move(*saved) : build_abstraction(spec, team);
  watch.checkpoint->finish(stage, save(abstraction));
  return abstraction;
}

/// The levels of a stage: those that are saved if they are the last, else what `find` makes of them.
template <class Find>
LevelMap find_levels_of(const std::string& stage, const RowEngine& engine, const SolutionWatch& watch,
                        const Find& find) {
  WaveWatch wave{.step = stepper(watch, stage, engine)};
  if (watch.checkpoint == nullptr) return find(wave);
  std::optional<SavedState<LevelMap>> saved = watch.checkpoint->take_levels(stage, engine);
  if (saved) wave.resumed = &saved->state;
  LevelMap levels = saved && saved->is_finished ? std::move(saved->state) : find(wave);
  watch.checkpoint->finish(stage, levels);
  return levels;
}

}  // namespace

Solution::Solution(const ProblemSpec& problem, ThreadTeam& team, const SolutionWatch& watch)
    : spec(problem),
      model(problem, table_shapes(problem)),
      listed(read_listed(problem, watch)),
      abstraction(in_order(model, find_abstraction(problem, team, watch))),
      safe(staged(watch, "safe set", [&] { return safe_set(problem, abstraction, team); })),
      allow(allow_table(problem, abstraction, team, listed ? &listed->pairs : nullptr)),
      beyond(safe_beyond_limits(problem, abstraction, safe, team)),
      engine(abstraction, allow ? &*allow : nullptr,
             TubeSets{problem.abstraction.between_samples ? &safe : nullptr, beyond ? &*beyond : nullptr}),
      hull(engine),
      invariance(find_invariance_set(team, watch)),
      controller{&engine, &invariance.invariant, &invariance.collision_time, spec.controller.synthesis},
      order(abstraction.grid) {
  find_layers(team, watch);
  if (spec.network) find_network(team, watch);
  if (spec.coordination.convention) find_convention(team, watch);
}

/// REQUIRES: all members before `invariance` are there.
Invariance Solution::find_invariance_set(ThreadTeam& team, const SolutionWatch& watch) const {
  const std::string stage = "invariance";
  watch.enter(stage);
  WaveCounts counts;
  LevelMap levels = find_levels_of(stage, engine, watch, [&](const WaveWatch& wave) {
    Invariance found = find_invariance(engine, hull, safe, spec.controller.synthesis, wave, team);
    counts = found.counts;
    return std::move(found.collision_time);
  });
  Invariance result = invariance_of(std::move(levels), team);
  result.counts = counts;
  return result;
}

void Solution::find_network(ThreadTeam& team, const SolutionWatch& watch) {
  const std::string stage = "network";
  watch.enter(stage);
  NetworkWatch rounds{.step = stepper(watch, stage, engine)};
  std::optional<SavedState<std::vector<CellSet>>> saved;
  if (watch.checkpoint != nullptr) saved = watch.checkpoint->take_sets(stage, invariance.invariant);
  if (saved) rounds.resumed = &saved->state;
  network = saved && saved->is_finished
                ? NetworkSafety{std::move(saved->state), {}}
                : find_network_safety(network_problem(spec, controller, hull), rounds, team);
  if (watch.checkpoint != nullptr) watch.checkpoint->finish(stage, network->safe);
}

void Solution::find_convention(ThreadTeam& team, const SolutionWatch& watch) {
  const std::string stage = "convention";
  watch.enter(stage);
  convention.emplace(ConventionResult{ActionGrouping(engine, agent_classes(spec, model.inputs()), team), {}});
  ConventionFreedom& freedom = convention->freedom;
  const auto load = [&](const auto& numbers, const ReadList& read) {
    freedom = load_convention(spec.agents.size(), abstraction.grid.cells(), numbers, read);
  };
  const bool is_saved = watch.checkpoint != nullptr && watch.checkpoint->take_lists(stage, load);
  if (!is_saved) freedom = coordreq::find_convention(controller, hull, convention->agents, team);
  if (watch.checkpoint != nullptr) watch.checkpoint->finish(stage, save(freedom));
}

void Solution::find_layers(ThreadTeam& team, const SolutionWatch& watch) {
  for (const PartitionSpec& partition : spec.coordination.partitions) partitions.push_back({&partition, {}});
  for (const std::size_t p : coarsest_first(spec.coordination.partitions)) {
    const std::string stage = "layers " + partitions[p].spec->name;
    watch.enter(stage);
    partitions[p].layers = layers_of(p, stage, team, watch);
  }
}

/// REQUIRES: the layers of all coarser partitions are known.
DelayLayers Solution::layers_of(std::size_t p, const std::string& stage, ThreadTeam& team,
                                const SolutionWatch& watch) const {
  const std::optional<std::int64_t> max_delay = spec.coordination.max_delay;
  if (partitions[p].spec->classes.size() == 1)
    return coordinated_layers(engine, invariance.invariant, max_delay, team);
  WaveCounts counts;
  LevelMap levels = find_levels_of(stage, engine, watch, [&](const WaveWatch& wave) {
    watch.part("projections");
    const ActionGrouping grouping(engine, input_classes(spec, model.inputs(), *partitions[p].spec), team);
    const Projections projections(controller, grouping, hull, team);
    watch.part("");
    std::vector<const LevelMap*> coarser;
    for (const std::size_t q : next_coarser(spec.coordination.partitions, p))
      coarser.push_back(&partitions[q].layers.layers_of);
    DelayLayers found =
        find_delay_layers(engine, hull, invariance.invariant, projections, coarser, max_delay, wave, team);
    counts = found.counts;
    return std::move(found.layers_of);
  });
  DelayLayers result = layers_of_levels(std::move(levels), max_delay, team);
  result.counts = counts;
  return result;
}

}  // namespace coordreq
