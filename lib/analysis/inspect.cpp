#include <fmt/format.h>

#include "analysis/analyze.hpp"
#include "analysis/estimate_memory.hpp"
#include "answers/answers.hpp"
#include "answers/context/answer.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/share_context.hpp"
#include "engine/engine_sizes.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/table_shapes.hpp"
#include "results/controller_file.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

template <class Variable>
std::vector<std::string> names(const std::vector<Variable>& variables,
                               const std::vector<std::int32_t>& indices) {
  std::vector<std::string> result;
  for (const std::int32_t j : indices) result.push_back(variables[static_cast<std::size_t>(j)].name);
  return result;
}

SpecReport::Rows row_report(const Model& model) {
  SpecReport::Rows report;
  const std::size_t across = EngineSizes(model).grid().across();
  std::vector<std::size_t> along;
  for (std::size_t i = 0; i < model.order().size(); ++i) {
    const std::size_t state = model.order()[i];
    if (i >= across) along.push_back(state);
    (i < across ? report.across : report.along).push_back(model.spec().states[state].name);
  }
  report.sample = sample_rows(model.spec(), model.shapes(), along);
  return report;
}

std::uint64_t to_bytes(double bytes) {
  return bytes < 1.8e19 ? static_cast<std::uint64_t>(bytes) : UINT64_MAX;
}

}  // namespace

SpecReport inspect(const ProblemSpec& spec, int threads) {
  return inspect(make_model(spec), threads);
}

SpecReport inspect(const Model& model, int threads) {
  const ProblemSpec& spec = model.spec();
  if (spec.controller.file) check_controller_file(spec);
  SpecReport report{.name = spec.name, .cells = spec.cells(), .joint_inputs = 1};
  const std::vector<TableShape>& shapes = model.shapes();
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    report.states.push_back(
        SpecReport::State{.name = state.name,
                          .unit = state.unit,
                          .points = state.grid.count,
                          .below = state.below,
                          .above = state.above,
                          .states = names(spec.states, shapes[i].states),
                          .inputs = names(spec.inputs, shapes[i].inputs),
                          .disturbances = names(spec.disturbances, shapes[i].disturbances),
                          .shift = shapes[i].shift,
                          .sum = shapes[i].sum,
                          .table_entries = to_bytes(shapes[i].entries),
                          .table_bytes = to_bytes(shapes[i].bytes)});
  }
  for (const InputSpec& input : spec.inputs) {
    const auto points = static_cast<std::int64_t>(input.values.size());
    report.inputs.push_back({.name = input.name, .unit = input.unit, .points = points});
    report.joint_inputs *= points;
  }
  for (const PartitionSpec& partition : spec.coordination.partitions)
    report.partitions.push_back(partition.name);
  for (std::size_t mode = 0; spec.network && mode < spec.network->modes.size(); ++mode)
    report.modes.push_back(spec.network->modes[mode].name);
  report.rows = row_report(model);
  report.exact = check_dynamics(spec);
  ThreadTeam team(threads);
  check_discrete_states(spec, shapes, team);
  report.guarantee = guarantee_of(spec);
  report.motion = sample_motion(spec).states;
  report.memory_bytes = to_bytes(estimate_memory(model, threads));
  return report;
}

FullestRank inspect_ranks(const Model& model, int ranks, int threads, const RankLimits& limits,
                          ThreadTeam& team) {
  const ProblemSpec& spec = model.spec();
  const double before = memory_of_program() + kMpiBytes;
  const auto need = [&](const RowFractions& fractions) {
    return estimate_memory_of_rank(model, threads, before, fractions);
  };
  const auto check = [&](double needed, std::optional<std::uint64_t> limit, const std::string& by_whom) {
    if (limit) check_memory_limit(spec, needed, static_cast<double>(*limit), by_whom);
  };
  check(need({.held = 1.0 / ranks, .local = 1.0 / ranks}), limits.of_rank,
        fmt::format("on the fullest of {} ranks at least, ", ranks));
  check(need({.held = 0, .local = 0}), limits.here, "on each rank, however many, ");
  Answers answers(model);
  context_answer.stages(spec).front().run(answers, {.team = team});
  const auto all = static_cast<double>(answers.context.abstraction->grid.rows());
  FullestRank fullest;
  double most = 0;
  for (const RankRows& rows : rows_of_ranks(answers.context, ranks)) {
    const double needed = need({.held = static_cast<double>(rows.owned + rows.ghosts) / all,
                                .local = static_cast<double>(rows.owned) / all,
                                .slices = rows.slices});
    if (needed <= most) continue;
    most = needed;
    fullest = {.local_rows = rows.owned, .ghost_rows = rows.ghosts};
  }
  check(most, limits.of_rank, fmt::format("on the fullest of {} ranks, ", ranks));
  fullest.memory_bytes = to_bytes(most);
  return fullest;
}

}  // namespace coordreq
