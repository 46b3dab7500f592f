#include "answers/network/answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "answers/checking/all_checks.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/kept_levels.hpp"
#include "answers/network/network_problem.hpp"
#include "answers/paths.hpp"
#include "answers/silence/silent_actions.hpp"
#include "answers/work_json.hpp"
#include "choices/projection_bytes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Saves or loads the sets of all modes, each a part of K.
void serialise(Archive& archive, const RowShare* share, const CellSet& invariant,
               std::vector<CellSet>& sets) {
  for (CellSet& set : sets) serialise(archive, share, invariant, set);
}

void find_safe_sets(Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  const CellSet& invariant = answers.get<Invariance>().invariant;
  NetworkSafety& result = answers.add(NetworkSafety{});
  std::vector<CellSet> sets;
  const auto load = [&](Archive& archive) {
    sets.assign(context.spec.network->modes.size(), CellSet(invariant.rows(), invariant.row_length()));
    serialise(archive, context.shared_rows(), invariant, sets);
  };
  const StageStore::Kept kept = work.store == nullptr ? StageStore::Kept::nothing : work.store->take(load);
  if (kept == StageStore::Kept::finished) {
    result.safe = std::move(sets);
  } else {
    const SaveState save = [share = context.shared_rows()](Archive& archive,
                                                           std::span<const NumberRows> state) {
      for (const NumberRows& set : state) serialise_rows(archive, share, set);
    };
    const NetworkWatch watch{.step = step_of(work, *context.engine, save),
                             .resumed = kept == StageStore::Kept::unfinished ? &sets : nullptr};
    NetworkProblem problem = network_problem(answers);
    std::optional<RuleModes> rules;
    if (context.spec.network->acts_by_rule)
      problem.rules =
          rules.emplace(answers, network_partitions(*context.spec.network), work.team).projections();
    result = find_network_safety(problem, watch, work.team);
  }
  if (work.store == nullptr) return;
  work.store->finish([&](Archive& archive) {
    serialise(archive, answers.context.shared_rows(), answers.get<Invariance>().invariant,
              answers.get<NetworkSafety>().safe);
  });
}

/// The cells that are safe in every mode, in the rows held.
CellSet safe_in_every_mode(const NetworkSafety& safety, const RowShare* share) {
  const CellSet& first = safety.safe.front();
  CellSet every(first.rows(), first.row_length());
  for (const RowShare::Range run : held_rows(share, first.rows())) {
    for (std::int64_t row = run.begin; row < run.end; ++row) {
      std::ranges::copy(first.row(row), every.row(row).begin());
      for (const CellSet& safe : safety.safe) {
        for (std::size_t w = 0; w < every.row(row).size(); ++w) every.row(row)[w] &= safe.row(row)[w];
      }
    }
  }
  return every;
}

Json network_json(const AnalysisContext& context, const NetworkSafety& safety) {
  const NetworkSpec& spec = *context.spec.network;
  Json json;
  json["kind"] = network_kind_name(spec.kind);
  json["actions"] = spec.acts_by_rule ? "silence" : "independent";
  json["resynthesise"] = spec.resynthesise;
  json["initial"] = spec.modes.front().name;
  json["modes"] = Json::array();
  for (std::size_t mode = 0; mode < spec.modes.size(); ++mode) {
    json["modes"].push_back({{"name", spec.modes[mode].name},
                             {"partition", spec.modes[mode].partition.name},
                             {"cells", context.count(safety.safe[mode])}});
  }
  json["cells_in_every_mode"] = context.count(safe_in_every_mode(safety, context.shared_rows()));
  return json;
}

/// Adds NetworkSafety, if the spec has a network: "network".
std::vector<Stage> network_stages(const ProblemSpec& spec) {
  if (!spec.network) return {};
  return {{"network", find_safe_sets}};
}

void summarise_network(const Answers& answers, Json& summary, Json& work) {
  const auto* const safety = answers.find<NetworkSafety>();
  if (safety == nullptr) return;
  summary["network"] = network_json(answers.context, *safety);
  work["network"] = work_json(safety->counts);
}

/// Fails if the numbers of safe cells are not as many as modes.
void examine_network(const ProblemSpec& spec, const FieldSource& source) {
  if (spec.network && source.counted(paths::kNetworkSafe).size() != spec.network->modes.size())
    source.fail("the attribute cells does not hold a number a mode", paths::kNetworkSafe);
}

void describe_network(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  if (!spec.network) return;
  const std::vector<std::uint64_t> cells = source.counted(paths::kNetworkSafe);
  for (std::size_t mode = 0; mode < cells.size(); ++mode)
    info["modes"].push_back({{"name", spec.network->modes[mode].name}, {"cells", cells[mode]}});
}

/// Without the word "actions" it is not said that the safe sets leave the rule aside.
Warnings advise_on_network(const Answers& answers) {
  const ProblemSpec& spec = answers.context.spec;
  if (!spec.network || !spec.silence || spec.network->has_actions) return {};
  return {{"network", "/network",
           "the safe sets of the network do not use the communication-loss rule; "
           "set \"actions\": \"silence\" if agents follow it in lost steps, else \"independent\""}};
}

/// The sets of all modes, the levels of one target, which rows of each have changed, and the projections of
/// all partitions.
MemoryNeed network_memory(const EngineSizes& sizes, int threads) {
  const ProblemSpec& spec = sizes.model().spec();
  if (!spec.network) return {};
  const auto modes = static_cast<double>(spec.network->modes.size());
  MemoryNeed need{.kept = modes * sizes.set(), .array = modes * sizes.cells()};
  need.work = modes * (sizes.rows() / 8) + sizes.levels() + sizes.readers(threads);
  if (spec.network->resynthesise) need.work += modes * sizes.set();  // the rows that lose cells
  for (const PartitionSpec* partition : network_partitions(*spec.network)) {
    const std::vector<InputClass> classes = input_classes(spec, sizes.model().inputs(), *partition);
    need.work += sizes.groups(classes);
    if (!spec.network->resynthesise) need.work += projection_bytes(sizes, classes);
    if (spec.network->acts_by_rule && classes.size() > 1) need.work += silent_bytes(sizes, classes);
  }
  return need;
}

}  // namespace

const Answer network_answer = {.stages = network_stages,
                               .memory = network_memory,
                               .fields = network_fields,
                               .fill = fill_network_fields,
                               .summarise = summarise_network,
                               .examine = examine_network,
                               .describe = describe_network,
                               .advise = advise_on_network,
                               .check = check_network,
                               .check_memory = network_check_memory};

}  // namespace coordreq
