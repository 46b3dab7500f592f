#include "analysis/analyze.hpp"

#include <nlohmann/json.hpp>

#include "analysis/advice.hpp"
#include "analysis/analysis_stages.hpp"
#include "analysis/checkpoint.hpp"
#include "analysis/stage_reporter.hpp"
#include "answers/field_table.hpp"
#include "answers/plan.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "results/write_results.hpp"

namespace coordreq {
namespace {

void open_checkpoint(const ProblemSpec& spec, const AnalysisOptions& options, StageReporter& reporter,
                     std::optional<Checkpoint>& checkpoint) {
  if (!options.checkpoint) return;
  const Checkpoint::Listener listener{
      .progress = [&reporter](bool has_temporary) { reporter.set_temporary(has_temporary); },
      .notice =
          [&options](const std::string& text) {
            if (options.notice) options.notice(text);
          }};
  reporter.enter("checkpoint");
  checkpoint.emplace(*options.checkpoint, spec, listener);
}

void find_answers(Answers& answers, StageReporter& reporter, Checkpoint* checkpoint, ThreadTeam& team) {
  const StageWork work{.team = team,
                       .part = [&reporter](const std::string& part) { reporter.enter_part(part); },
                       .step = [&reporter](const WaveStep& step,
                                           std::int64_t row_length) { reporter.step(step, row_length); }};
  const PlanWatch watch{.enter = [&reporter](const std::string& stage) { reporter.enter(stage); },
                        .store = [checkpoint](const std::string& stage) -> StageStore* {
                          return checkpoint == nullptr ? nullptr : checkpoint->enter(stage);
                        }};
  run_stages(analysis_stages(answers.ground.spec), answers, work, watch);
}

void write(const std::string& path, const Answers& answers, StageReporter& reporter, ThreadTeam& team) {
  reporter.enter("writing");
  reporter.enter_part("lists");
  FieldValues values = found_values(answers, team);
  reporter.watch_writing(answers.ground.spec, values);
  reporter.set_temporary(true);
  std::optional<RankChunks> ranks;
  if (answers.ground.share) ranks.emplace(team, *answers.ground.share, *answers.ground.order);
  write_results(path, answers.ground.spec, values, team, ranks ? &*ranks : nullptr);
}

/// What each answer says of itself. @param work what fixed points took
Json summarise(const Answers& answers, Json& work) {
  Json summary;
  for (const Answer& answer : all_answers()) answer.summarise(answers, summary, work);
  return summary;
}

}  // namespace

void check_divisible(const ProblemSpec& spec) {
  if (spec.output.layers)
    throw UsageError("'layers' cannot be divided between ranks yet, expected one rank", "/output/layers");
}

Json analyze(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team) {
  Ranks* const ranks = options.ranks != nullptr && options.ranks->count() > 1 ? options.ranks : nullptr;
  const bool is_first = ranks == nullptr || ranks->rank() == 0;
  if (ranks != nullptr) check_divisible(spec);
  if (!options.output.empty() && is_first) check_writable(options.output);
  if (options.checkpoint) check_checkpoint(*options.checkpoint);
  StageReporter reporter(options.progress, team);
  std::optional<Checkpoint> checkpoint;
  open_checkpoint(spec, options, reporter, checkpoint);
  Answers answers(spec, ranks);
  find_answers(answers, reporter, checkpoint ? &*checkpoint : nullptr, team);
  Json work = Json::object();
  Json summary = summarise(answers, work);
  if (!options.output.empty()) write(options.output, answers, reporter, team);
  if (checkpoint) checkpoint->remove();
  summary["output"] = options.output.empty() ? Json() : Json(options.output);
  summary["threads"] = team.size();
  summary["seconds"] = Json::object();
  for (const auto& [stage, seconds] : reporter.finish()) summary["seconds"][stage] = seconds;
  summary["work"] = std::move(work);
  const auto peak = static_cast<std::int64_t>(peak_memory_bytes());
  summary["peak_memory_bytes"] = ranks == nullptr ? peak : ranks->greatest(peak);
  summary["warnings"] = warnings_json(is_first ? advise(answers, team) : Warnings());
  return summary;
}

}  // namespace coordreq
