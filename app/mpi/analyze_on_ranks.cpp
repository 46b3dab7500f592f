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
  for (std::string* const part : {&source.text, &source.name, &source.folder})
    *part = text_of(ranks.from_first(bytes_of(*part)));
  ProblemSpec spec = read_spec(source);
  if (!options.settings.empty())
    spec.written = std::make_shared<WrittenSpec>();  // not all have what was written
  return spec;
}

Run declare_analyze(Options& options, Ranks& ranks, const std::function<void()>& watch) {
  const auto own = std::make_shared<AnalyzeOptions>();
  own->ranks = &ranks;
  own->sharers = ranks.on_this_machine();
  own->watch = watch;
  own->threads = 1;
  options.arguments(own->specs, "SPEC", kSpecDescription);
  declare_files(options, *own);
  declare_checkpoint(options, own->checkpoint, "FOLDER");
  declare_progress(options, own->progress);
  declare_threads(options, own->threads, "Threads per rank (default: 1)");
  declare_common(options, *own, {.threads = false});
  return [own] {
    if (own->ranks->rank() != 0) {
      own->quiet = true;
      own->progress.mode = ProgressMode::none;
    }
    if (own->is_batch()) return run_batch_on_ranks(*own);
    return analyze_and_print(shared_spec(*own, *own->ranks), *own);
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
