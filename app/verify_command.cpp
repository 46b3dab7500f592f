#include <chrono>

#include "app/commands.hpp"
#include "app/memory_limit.hpp"
#include "app/progress_display.hpp"
#include "app/standard_streams.hpp"
#include "app/verify_report.hpp"
#include "verify/verify_file.hpp"

namespace coordreq {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Verification verify_with_progress(const ClaimedFile& file, const CommandLine& line, ThreadTeam& team) {
  ProgressDisplay shown(line.progress, line.quiet);
  VerifyOptions options{.sample = line.sample};
  if (line.budget) options.budget_seconds = *line.budget;
  options.progress = [&](const VerifyProgress& progress) {
    shown.update({.stage = "checking " + progress.stage, .done = progress.done, .all = progress.all});
  };
  Verification result = verify_file(file, options, team);
  shown.finish();
  return result;
}

}  // namespace

ExitCode run_verify(const CommandLine& line) {
  const Clock::time_point start = Clock::now();
  const ClaimedFile file = read_claims(line.path, line.max_memory ? line.max_memory : available_memory());
  ThreadTeam team(line.threads);
  const Verification result = verify_with_progress(file, line, team);
  if (line.json) {
    write_output(verification_json(result, line.path, seconds_since(start), team.size()));
  } else if (!line.quiet) {
    write_output(verification_text(result, line.path, seconds_since(start), team.size()));
  }
  if (result.verdict() == Verdict::not_confirmed) write_diagnostics(not_confirmed_line(result, line.path));
  const bool passes = result.verdict() == Verdict::holds || (result.holds() && !line.strict);
  return passes ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace coordreq
