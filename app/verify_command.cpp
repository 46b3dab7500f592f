#include <fmt/format.h>

#include <chrono>

#include "app/commands.hpp"
#include "app/memory_limit.hpp"
#include "app/progress_line.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"
#include "app/verify_report.hpp"
#include "verify/verify_file.hpp"

namespace coordreq {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// "checking cells, 42 %, 17 s left".
std::string describe(const VerifyProgress& progress, Clock::time_point start) {
  if (progress.all == 0 || progress.done == 0) return "checking " + progress.stage;
  const double share = static_cast<double>(progress.done) / static_cast<double>(progress.all);
  const double left = seconds_since(start) * (1.0 / share - 1.0);
  return fmt::format("checking {}, {:.0f} %, {:.0f} s left", progress.stage, share * 100, left);
}

Verification verify_with_progress(const ClaimedFile& file, const CommandLine& line, ThreadTeam& team) {
  ProgressLine shown(!line.quiet);
  Clock::time_point stage_start = Clock::now();
  std::string stage;
  VerifyOptions options{.sample = line.sample};
  options.progress = [&](const VerifyProgress& progress) {
    if (progress.stage != stage) stage_start = Clock::now();
    stage = progress.stage;
    shown.update(describe(progress, stage_start));
  };
  return verify_file(file, options, team);
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
  return result.holds() ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace coordreq
