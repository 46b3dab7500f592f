#include "analysis/analyze.hpp"

#include "analysis/checkpoint.hpp"
#include "analysis/coalitions.hpp"
#include "analysis/compose_results.hpp"
#include "analysis/field_values.hpp"
#include "analysis/judge_requirements.hpp"
#include "analysis/solution.hpp"
#include "analysis/stage_reporter.hpp"
#include "analysis/summarise.hpp"
#include "results/write_results.hpp"

namespace coordreq {
namespace {

void open_checkpoint(const ProblemSpec& spec, const AnalysisOptions& options, StageReporter& reporter,
                     ThreadTeam& team, std::optional<Checkpoint>& checkpoint) {
  if (!options.checkpoint) return;
  const Checkpoint::Listener listener{
      .progress = [&reporter](bool has_temporary) { reporter.set_temporary(has_temporary); },
      .notice =
          [&options](const std::string& text) {
            if (options.notice) options.notice(text);
          }};
  reporter.enter("checkpoint");
  checkpoint.emplace(*options.checkpoint, spec, team, listener);
}

SolutionWatch watch_of(StageReporter& reporter, Checkpoint* checkpoint) {
  return {
      .enter = [&reporter](const std::string& stage) { reporter.enter(stage); },
      .part = [&reporter](const std::string& part) { reporter.enter_part(part); },
      .step = [&reporter](const WaveStep& step, std::int64_t row_length) { reporter.step(step, row_length); },
      .checkpoint = checkpoint};
}

void write(const std::string& path, const Solution& solution, const std::optional<CoalitionMap>& coalitions,
           const AnalysisSummary& summary, StageReporter& reporter, ThreadTeam& team) {
  reporter.enter("writing");
  reporter.enter_part("lists");
  ResultComposer composer(solution, team);
  ResultContent content = composer.content();
  if (coalitions) add_coalitions(*coalitions, solution, content);
  content.requirements = summary.requirements;
  reporter.watch_writing(content);
  reporter.set_temporary(true);
  write_results(path, solution.spec, field_values(content), team);
}

}  // namespace

AnalysisSummary analyze(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team) {
  check_memory(spec, options.max_memory);
  if (!options.output.empty()) check_writable(options.output);
  if (options.checkpoint) check_checkpoint(*options.checkpoint);
  StageReporter reporter(options.progress, team);
  std::optional<Checkpoint> checkpoint;
  open_checkpoint(spec, options, reporter, team, checkpoint);
  const SolutionWatch watch = watch_of(reporter, checkpoint ? &*checkpoint : nullptr);
  if (!spec.requirements.empty()) {
    reporter.enter("regions");
    check_regions(spec, team);
  }
  const Solution solution(spec, team, watch);
  const std::optional<CoalitionMap> coalitions = coalitions_of(solution, team, watch.enter);
  AnalysisSummary summary = summarise(solution);
  if (!spec.requirements.empty()) {
    reporter.enter("requirements");
    summary.requirements = judge_requirements(solution, team);
  }
  if (coalitions) summary.coalition = summary_of(*coalitions, spec);
  if (!options.output.empty()) write(options.output, solution, coalitions, summary, reporter, team);
  if (checkpoint) checkpoint->remove();
  summary.seconds = reporter.finish();
  summary.output = options.output;
  summary.threads = team.size();
  summary.peak_memory_bytes = peak_memory_bytes();
  return summary;
}

}  // namespace coordreq
