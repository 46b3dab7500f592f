#include "analysis/analyze.hpp"

#include "analysis/coalitions.hpp"
#include "analysis/compose_results.hpp"
#include "analysis/judge_requirements.hpp"
#include "analysis/solution.hpp"
#include "analysis/summarise.hpp"
#include "base/timer.hpp"
#include "results/write_results.hpp"

namespace coordreq {
namespace {

void write(const std::string& path, const Solution& solution, const std::optional<CoalitionMap>& coalitions,
           const AnalysisSummary& summary, ThreadTeam& team) {
  ResultComposer composer(solution, team);
  ResultContent content = composer.content();
  if (coalitions) add_coalitions(*coalitions, solution, content);
  content.requirements = summary.requirements;
  write_results(path, content, team);
}

}  // namespace

AnalysisSummary analyze(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team) {
  check_memory(spec, options.max_memory);
  if (!options.output.empty()) check_writable(options.output);
  StageTimer timer;
  const auto report = [&options](const Progress& progress) {
    if (options.progress) options.progress(progress);
  };
  const auto enter = [&timer, &report](const std::string& stage) {
    timer.begin(stage);
    report({.stage = stage});
  };
  if (!spec.requirements.empty()) {
    enter("regions");
    check_regions(spec, team);
  }
  const Solution solution(spec, team, enter,
                          [&report](const std::string& stage, std::int64_t sweep, std::int64_t rows) {
                            report({stage, sweep, rows});
                          });
  const std::optional<CoalitionMap> coalitions = coalitions_of(solution, team, enter);
  AnalysisSummary summary = summarise(solution);
  if (!spec.requirements.empty()) {
    enter("requirements");
    summary.requirements = judge_requirements(solution, team);
  }
  if (coalitions) summary.coalition = summary_of(*coalitions, spec);
  if (!options.output.empty()) {
    enter("writing");
    write(options.output, solution, coalitions, summary, team);
  }
  timer.end();
  summary.output = options.output;
  summary.threads = team.size();
  summary.seconds = timer.seconds();
  summary.peak_memory_bytes = peak_memory_bytes();
  return summary;
}

}  // namespace coordreq
