#include <chrono>
#include <memory>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/progress_display.hpp"
#include "app/reports.hpp"
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

Verification verify_with_progress(const ClaimedFile& file, const VerifyArguments& arguments,
                                  ThreadTeam& team) {
  ProgressDisplay display(arguments.progress, arguments.quiet);
  VerifyOptions options{.sample = arguments.sample};
  options.budget_seconds = arguments.budget;
  options.full = arguments.full;
  options.progress = [&](const VerifyProgress& progress) {
    display.update({.stage = "checking " + progress.stage, .done = progress.done, .all = progress.all});
  };
  Verification result = verify_file(file, options, team);
  display.finish();
  return result;
}

ExitCode run(const VerifyArguments& arguments) {
  if (arguments.full && (arguments.sample || arguments.budget))
    throw UsageError("expected --full alone, found --sample or --budget too", "--full");
  const Clock::time_point start = Clock::now();
  arguments.keep_to_memory();
  const ClaimedFile file = read_claims(arguments.results, arguments.memory());
  ThreadTeam team(arguments.threads_for("verifying needs", file.demand));
  const Verification result = verify_with_progress(file, arguments, team);
  print_verification(arguments, result, arguments.results, seconds_since(start), team.size());
  const bool passes = result.verdict() == Verdict::holds || (result.holds() && !arguments.strict);
  return passes ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace

Run declare_verify(Options& options) {
  const auto arguments = std::make_shared<VerifyArguments>();
  declare_results(options, arguments->results);
  options.option(arguments->sample, "--sample", "N", "Check N cells, the same ones each time (default: all)",
                 WholeNumber<std::int64_t>{1, INT64_MAX});
  options.option(arguments->budget, "--budget", "SECONDS",
                 "Processor time of each thread for enclosures; 0 confirms only exact sets (default: 60)",
                 seconds);
  options.flag(arguments->full, "--full", "Also recompute results that need many passes (risks)");
  options.flag(arguments->strict, "--strict", "Fail if something is not confirmed");
  declare_progress(options, arguments->progress);
  declare_common(options, *arguments);
  return [arguments] { return run(*arguments); };
}

}  // namespace coordreq
