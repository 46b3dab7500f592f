#include "answers/risk/answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "answers/checking/all_checks.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/kept_levels.hpp"
#include "answers/network/network_problem.hpp"
#include "answers/paths.hpp"
#include "answers/risk/risk_levels.hpp"
#include "answers/silence/silent_actions.hpp"
#include "answers/work_json.hpp"
#include "choices/projection_bytes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Whether risks are possible ones: probabilities, and outside K certainty.
bool are_possible(const RiskRows& risks, const CellSet& invariant, const RowShare* share) {
  bool possible = true;
  for (const RowShare::Range run : held_rows(share, risks.rows())) {
    for (std::int64_t row = run.begin; row < run.end; ++row) {
      for (std::int64_t x = 0; x < risks.row_length(); ++x) {
        const std::uint32_t level = risks.row(row)[x];
        const bool is_invariant = invariant.test(row * risks.row_length() + x);
        possible =
            possible && (is_invariant ? level >= kCertain<std::uint32_t> : level == kCertain<std::uint32_t>);
      }
    }
  }
  return possible;
}

/// Loads the state after some steps; after the last one there is a rate, too.
void load_state(Archive& archive, const AnalysisContext& context, const CellSet& invariant, RiskState& state,
                double& rate) {
  archive.number(state.steps);
  archive.number(rate);
  archive.expect(state.steps >= 0 && state.steps <= context.spec.risk->horizon, "there are too many steps");
  archive.expect(rate >= 0 && rate <= 1, "a rate is no probability");
  for (RiskRows& risks : state.risks) {
    serialise_rows(archive, context.shared_rows(), rows_of(risks));
    archive.expect(are_possible(risks, invariant, context.shared_rows()),
                   "a cell has a risk that it cannot have");
  }
}

void save_state(Archive& archive, const RowShare* share, std::int64_t steps, double rate,
                std::span<const NumberRows> state) {
  archive.number(steps);
  archive.number(rate);
  for (const NumberRows& risks : state) serialise_rows(archive, share, risks);
}

void find_risks(Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  const RowShare* const share = context.shared_rows();
  const CellSet& invariant = answers.get<Invariance>().invariant;
  RiskAnswer& answer = answers.add(RiskAnswer{});
  Risk& result = answer.risk;
  RiskState state;
  double rate = 0;
  const auto load = [&](Archive& archive) {
    state.risks = first_risks(invariant, context.spec.network->modes.size(), share);
    load_state(archive, context, invariant, state, rate);
  };
  const StageStore::Kept kept = work.store == nullptr ? StageStore::Kept::nothing : work.store->take(load);
  if (kept == StageStore::Kept::finished) {
    result.risks = std::move(state.risks);
    result.rate = rate;
  } else {
    std::int64_t steps = 0;
    const SaveState save = [&steps, share](Archive& archive, std::span<const NumberRows> rows) {
      save_state(archive, share, steps, 0, rows);
    };
    const auto step = step_of(work, *context.engine, save);
    const RiskWatch watch{.step =
                              [&](const WaveStep& inner_step, std::int64_t done) {
                                steps = done;
                                step(inner_step);
                              },
                          .resumed = kept == StageStore::Kept::unfinished ? &state : nullptr};
    const ExpectedRisks expected(*context.spec.network);
    RiskProblem problem{.network = network_problem(answers),
                        .expected = &expected,
                        .horizon = context.spec.risk->horizon,
                        .is_safest = context.spec.risk->is_safest};
    std::optional<RuleModes> rules;
    if (context.spec.silence)
      problem.network.rules =
          rules.emplace(answers, network_partitions(*context.spec.network), work.team).projections();
    result = find_risk(problem, watch, work.team);
  }
  for (const RiskRows& risks : result.risks)
    answer.figures.push_back(risk_figures(risks, invariant, share, work.team));
  if (context.spec.risk->is_drawn) {
    const ExpectedRisks expected(*context.spec.network);
    answer.drawn = drawn_risks(expected.different[expected.of_mode.front()], result.risks, share, work.team);
    answer.drawn_figures = risk_figures(*answer.drawn, invariant, share, work.team);
  }
  if (work.store == nullptr) return;
  work.store->finish([&answers](Archive& archive) {
    const Risk& risk = answers.get<RiskAnswer>().risk;
    std::vector<NumberRows> rows;
    for (const RiskRows& risk_rows : risk.risks) rows.push_back(rows_of(risk_rows));
    save_state(archive, answers.context.shared_rows(), answers.context.spec.risk->horizon, risk.rate, rows);
  });
}

template <class Number>
Json number_or_null(const std::optional<Number>& number) {
  return number ? Json(double{*number}) : Json();
}

Json figures_json(const std::string& name, const RiskFigures& figures) {
  return {{"name", name},
          {"worst", number_or_null(figures.worst)},
          {"mean", number_or_null(figures.mean)},
          {"within", figures.within}};
}

Json risk_json(const ProblemSpec& spec, const RiskAnswer& answer) {
  Json json{{"horizon", spec.risk->horizon}, {"rate", answer.risk.rate}, {"modes", Json::array()}};
  for (std::size_t mode = 0; mode < answer.figures.size(); ++mode)
    json["modes"].push_back(figures_json(spec.network->modes[mode].name, answer.figures[mode]));
  const RiskFigures& start = answer.drawn_figures ? *answer.drawn_figures : answer.figures[spec.risk->start];
  json["start"] =
      figures_json(spec.risk->is_drawn ? "drawn" : spec.network->modes[spec.risk->start].name, start);
  return json;
}

/// Adds RiskAnswer, if the spec asks for it: "risk".
std::vector<Stage> risk_stages(const ProblemSpec& spec) {
  if (!spec.risk) return {};
  return {{"risk", find_risks}};
}

void summarise_risk(const Answers& answers, Json& summary, Json& work) {
  const auto* const risk = answers.find<RiskAnswer>();
  if (risk == nullptr) return;
  summary["risk"] = risk_json(answers.context.spec, *risk);
  work["risk"] = work_json(risk->risk.counts);
}

/// Fails if the rate is no probability.
void examine_risk(const ProblemSpec& spec, const FieldSource& source) {
  if (!spec.risk) return;
  const double rate = source.number(paths::kRisk, "rate");
  if (!(rate >= 0 && rate <= 1)) source.fail("the rate is no probability", paths::kRisk);
}

void describe_risk(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  if (!spec.risk) return;
  info["risk"] = {{"horizon", source.attribute(paths::kRisk, "horizon")},
                  {"rate", source.number(paths::kRisk, "rate")}};
}

/// V of all modes, the levels of each E_q (for the rate of one in 64 bits), and the projections of all
/// partitions.
MemoryNeed risk_memory(const EngineSizes& sizes, int threads) {
  const ProblemSpec& spec = sizes.model().spec();
  if (!spec.risk) return {};
  const auto modes = static_cast<double>(spec.network->modes.size());
  const auto expected = static_cast<double>(ExpectedRisks(*spec.network).different.size());
  constexpr double kFloat = sizeof(std::uint32_t), kDouble = sizeof(std::uint64_t);
  const double arrays = modes + (spec.risk->is_drawn ? 1 : 0);
  MemoryNeed need{.kept = arrays * kFloat * sizes.lanes(), .array = modes * kFloat * sizes.cells()};
  need.work = std::max(expected * kFloat * sizes.levels() + sizes.readers(threads, kFloat),
                       kDouble * sizes.levels() + sizes.readers(threads, kDouble));
  need.work += (modes + expected) * sizes.rows();  // flags for rows that have changed
  for (const PartitionSpec* partition : network_partitions(*spec.network)) {
    const bool is_one = spec.risk->is_safest && partition->classes.size() == 1;
    const std::vector<InputClass> classes = is_one ? single_classes(sizes.model().inputs())
                                                   : input_classes(spec, sizes.model().inputs(), *partition);
    need.work += sizes.groups(classes);
    if (!is_one) need.work += projection_bytes(sizes, classes);
    if (spec.silence && partition->classes.size() > 1) need.work += silent_bytes(sizes, classes);
  }
  return need;
}

}  // namespace

const Answer risk_answer = {.stages = risk_stages,
                            .memory = risk_memory,
                            .fields = risk_fields,
                            .fill = fill_risk_fields,
                            .summarise = summarise_risk,
                            .examine = examine_risk,
                            .describe = describe_risk,
                            .check = check_risk,
                            .check_memory = risk_check_memory};

}  // namespace coordreq
