#include "analysis/solution.hpp"

#include <algorithm>
#include <utility>

#include "abstraction/build_abstraction.hpp"
#include "analysis/layout.hpp"
#include "analysis/network_problem.hpp"
#include "coordination/projections.hpp"
#include "coordination/refinement.hpp"
#include "safety/safe_set.hpp"
#include "safety/safe_tubes.hpp"

namespace coordreq {
namespace {

/// Passes a value on after its stage has been entered: members are initialised one after the other.
template <class Make>
auto staged(const EnterStage& enter, const std::string& stage, const Make& make) {
  enter(stage);
  return make();
}

/// First of all, for a file that does not fit is an error that nobody should wait for.
std::optional<ControllerFile> read_listed(const ProblemSpec& spec, const EnterStage& enter) {
  if (!spec.controller.file) return std::nullopt;
  return staged(enter, "controller", [&] { return read_controller_file(spec); });
}

/// Where each state of the spec stands in the grid.
std::vector<std::size_t> place_of_states(const std::vector<std::size_t>& layout) {
  std::vector<std::size_t> place(layout.size());
  for (std::size_t d = 0; d < layout.size(); ++d) place[layout[d]] = d;
  return place;
}

std::function<void(const WaveStep&)> stepper(const StageSwept& swept, const std::string& stage) {
  return [&swept, stage](const WaveStep& step) { swept(stage, step.sweep, step.visited); };
}

}  // namespace

Solution::Solution(const ProblemSpec& problem, ThreadTeam& team, const EnterStage& enter,
                   const StageSwept& swept)
    : spec(problem),
      layout(choose_layout(problem)),
      engine_spec(laid_out(problem, layout)),
      listed(read_listed(problem, enter)),
      abstraction(staged(enter, "abstraction", [&] { return build_abstraction(engine_spec, team); })),
      safe(staged(enter, "safe set", [&] { return safe_set(engine_spec, abstraction, team); })),
      allow(allow_table(engine_spec, abstraction, team, listed ? &listed->pairs : nullptr)),
      beyond(safe_beyond_limits(engine_spec, abstraction, safe, team)),
      engine(abstraction, allow ? &*allow : nullptr,
             SafeTubes{problem.abstraction.between_samples ? &safe : nullptr, beyond ? &*beyond : nullptr}),
      hull(engine),
      invariance(staged(enter, "invariance",
                        [&] {
                          return find_invariance(engine, hull, safe, spec.controller.synthesis,
                                                 {.step = stepper(swept, "invariance")}, team);
                        })),
      controller{&engine, &invariance.invariant, &invariance.collision_time, spec.controller.synthesis},
      order(abstraction.grid, place_of_states(layout)) {
  find_layers(team, enter, swept);
  if (spec.network) {
    enter("network");
    network = find_network_safety(network_problem(spec, controller, hull),
                                  {.step = stepper(swept, "network")}, team);
  }
  if (spec.coordination.convention) find_convention(team, enter);
}

void Solution::find_convention(ThreadTeam& team, const EnterStage& enter) {
  enter("convention");
  std::vector<InputClass> classes;
  for (const AgentSpec& agent : spec.agents) classes.push_back(agent.inputs);
  convention.emplace(ConventionResult{ActionGrouping(engine, std::move(classes), team), {}});
  convention->freedom = coordreq::find_convention(controller, hull, convention->agents, team);
}

void Solution::find_layers(ThreadTeam& team, const EnterStage& enter, const StageSwept& swept) {
  for (const PartitionSpec& partition : spec.coordination.partitions) partitions.push_back({&partition, {}});
  for (const std::size_t p : coarsest_first(spec.coordination.partitions)) {
    const std::string stage = "layers " + partitions[p].spec->name;
    enter(stage);
    partitions[p].layers = layers_of(p, team, stepper(swept, stage));
  }
}

/// REQUIRES: the layers of all coarser partitions are known.
DelayLayers Solution::layers_of(std::size_t p, ThreadTeam& team,
                                const std::function<void(const WaveStep&)>& step) const {
  const std::optional<std::int64_t> max_delay = spec.coordination.max_delay;
  if (partitions[p].spec->classes.size() == 1)
    return coordinated_layers(engine, invariance.invariant, max_delay, team);
  const ActionGrouping grouping(engine, input_classes(spec, *partitions[p].spec), team);
  const Projections projections(controller, grouping, hull, team);
  std::vector<const LevelMap*> coarser;
  for (const std::size_t q : next_coarser(spec.coordination.partitions, p))
    coarser.push_back(&partitions[q].layers.layers_of);
  return find_delay_layers(engine, hull, invariance.invariant, projections, coarser, max_delay,
                           {.step = step}, team);
}

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

}  // namespace coordreq
