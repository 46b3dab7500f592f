#include "app/mpi/on_ranks.hpp"

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/analyze.hpp"
#include "app/analyze_options.hpp"
#include "app/analyze_run.hpp"
#include "app/command_line.hpp"
#include "app/load_spec.hpp"
#include "app/option_values.hpp"
#include "app/standard_streams.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// The spec that the first rank reads.
ProblemSpec shared_spec(const AnalyzeOptions& options, Ranks& ranks) {
  SpecSource source;
  if (ranks.rank() == 0) {
    const SpecSource written = load_source(options.specs.front(), options.memory());
    // Before anybody else knows of it: whatever is wrong is said once.
    static_cast<void>(read_with_settings(written, options.settings));
    source = with_settings(written, options.settings);
  }
  for (std::string* const text : {&source.text, &source.name, &source.folder})
    *text = text_of(ranks.from_first(bytes_of(*text)));
  ProblemSpec spec = read_spec(source);
  if (!options.settings.empty())
    spec.written = std::make_shared<WrittenSpec>();  // not all have what was written
  return spec;
}

Run declare_analyze(Options& options, Ranks& ranks, const std::function<void()>& watch) {
  const auto args = std::make_shared<AnalyzeOptions>();
  args->ranks = &ranks;
  args->sharers = ranks.on_this_machine();
  args->watch = watch;
  args->threads = 1;
  options.arguments(args->specs, "SPEC", kSpecDescription);
  declare_files(options, *args);
  declare_checkpoint(options, args->checkpoint, "FOLDER");
  declare_progress(options, args->progress);
  declare_threads(options, args->threads, "Threads per rank (default: 1)");
  declare_common(options, *args, {.threads = false});
  return [args] {
    if (args->ranks->rank() != 0) {
      args->quiet = true;
      args->progress.mode = ProgressMode::none;
    }
    if (args->is_batch()) return run_batch_on_ranks(*args);
    return analyze_and_print(shared_spec(*args, *args->ranks), *args);
  };
}

}  // namespace

ExitCode analyze_on_ranks(int argc, const char* const* argv, Ranks& ranks,
                          const std::function<void()>& watch) {
  const CommandInfo commands[] = {
      {"analyze",
       "Run the whole analysis and write the results file that coordreq analyze would write",
       [&](Options& options) { return declare_analyze(options, ranks, watch); },
       {"mpirun -n 4 coordreq-mpi analyze circle.json",
        "mpirun -n 8 coordreq-mpi analyze circle.json --refine 4 --threads 16"}}};
  const ProgramInfo program{
      .name = "coordreq-mpi",
      .description = "The analysis of coordreq on the processes that mpirun starts",
      .examples = {"mpirun -n 4 coordreq-mpi analyze circle.json", "coordreq-mpi --version"},
      .commands = commands,
      .write = [&ranks](const std::string& text) {
        if (ranks.rank() == 0) write_output(text);
      }};
  return parse_command_line(argc, argv, program)();
}

}  // namespace coordreq
