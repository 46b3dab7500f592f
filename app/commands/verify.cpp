#include <chrono>
#include <memory>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/progress_display.hpp"
#include "app/verify_report.hpp"
#include "verify/verify_file.hpp"

namespace coordreq {
namespace {

struct VerifyArguments : CommonOptions {
  std::string results;
  std::optional<std::int64_t> sample;
  std::optional<double> budget;
  bool full = false;
  bool strict = false;
  ProgressOptions progress;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Verification verify_with_progress(const ClaimedFile& file, const VerifyArguments& own, ThreadTeam& team) {
  ProgressDisplay shown(own.progress, own.quiet);
  VerifyOptions options{.sample = own.sample};
  options.budget_seconds = own.budget;
  options.full = own.full;
  options.progress = [&](const VerifyProgress& progress) {
    shown.update({.stage = "checking " + progress.stage, .done = progress.done, .all = progress.all});
  };
  Verification result = verify_file(file, options, team);
  shown.finish();
  return result;
}

ExitCode run(const VerifyArguments& own) {
  if (own.full && (own.sample || own.budget))
    throw UsageError("expected --full alone, found --sample or --budget too", "--full");
  const Clock::time_point start = Clock::now();
  own.keep_to_memory();
  const ClaimedFile file = read_claims(own.results, own.memory());
  ThreadTeam team(own.threads_for("verifying needs", file.demand));
  const Verification result = verify_with_progress(file, own, team);
  print_verification(own, result, own.results, seconds_since(start), team.size());
  const bool passes = result.verdict() == Verdict::holds || (result.holds() && !own.strict);
  return passes ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace

Run declare_verify(Options& options) {
  const auto own = std::make_shared<VerifyArguments>();
  declare_results(options, own->results);
  options.option(own->sample, "--sample", "N",
                 "Look at so many cells, the same ones each time (default: all)",
                 WholeNumber<std::int64_t>{1, INT64_MAX});
  options.option(own->budget, "--budget", "SECONDS",
                 "Processor time of each thread for enclosures; 0 confirms only exact posts (default: 60)",
                 seconds);
  options.flag(own->full, "--full", "Work out again, too, what takes many looks at all cells: risks");
  options.flag(own->strict, "--strict", "Fail if something is not confirmed");
  declare_progress(options, own->progress);
  declare_common(options, *own);
  return [own] { return run(*own); };
}

}  // namespace coordreq
