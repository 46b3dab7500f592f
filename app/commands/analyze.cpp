#include <memory>

#include "app/analyze_batch.hpp"
#include "app/analyze_options.hpp"
#include "app/analyze_run.hpp"
#include "app/commands/all.hpp"
#include "app/load_spec.hpp"
#include "app/option_values.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

ExitCode run(const AnalyzeOptions& options) {
  options.hold_to_memory();
  if (options.is_batch()) return run_analyze_batch(options);
  const ProblemSpec spec = load_spec(options.specs.front(), options.settings, options.memory());
  return analyze_and_print(spec, options);
}

}  // namespace

Run declare_analyze(Options& options) {
  const auto args = std::make_shared<AnalyzeOptions>();
  options.arguments(args->specs, "SPEC", kSpecDescription);
  declare_files(options, *args);
  declare_checkpoint(options, args->checkpoint, "FILE");
  declare_progress(options, args->progress);
  declare_common(options, *args);
  return [args] { return run(*args); };
}

}  // namespace coordreq
