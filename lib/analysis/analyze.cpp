#include "analysis/analyze.hpp"

#include "analysis/analysis_stages.hpp"
#include "analysis/checkpoint.hpp"
#include "analysis/stage_reporter.hpp"
#include "analysis/summarise.hpp"
#include "answers/field_table.hpp"
#include "answers/plan.hpp"
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
  write_results(path, answers.ground.spec, values, team);
}

}  // namespace

AnalysisSummary analyze(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team) {
  if (!options.output.empty()) check_writable(options.output);
  if (options.checkpoint) check_checkpoint(*options.checkpoint);
  StageReporter reporter(options.progress, team);
  std::optional<Checkpoint> checkpoint;
  open_checkpoint(spec, options, reporter, checkpoint);
  Answers answers(spec);
  find_answers(answers, reporter, checkpoint ? &*checkpoint : nullptr, team);
  AnalysisSummary summary = summarise(answers);
  if (!options.output.empty()) write(options.output, answers, reporter, team);
  if (checkpoint) checkpoint->remove();
  summary.seconds = reporter.finish();
  summary.output = options.output;
  summary.threads = team.size();
  summary.peak_memory_bytes = peak_memory_bytes();
  return summary;
}

}  // namespace coordreq
