#include "app/mpi/analyze_on_ranks.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "analysis/analyze.hpp"
#include "app/analysis_text.hpp"
#include "app/analyze_options.hpp"
#include "app/analyze_run.hpp"
#include "app/files_in_use.hpp"
#include "app/load_spec.hpp"
#include "app/option_values.hpp"
#include "app/print_answer.hpp"
#include "app/print_warnings.hpp"
#include "app/standard_streams.hpp"
#include "results/version.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

void declare(Options& options, AnalyzeOptions& own) {
  options.argument(own.specs.emplace_back(), "SPEC", kSpecDescription);
  options.option(own.output, "-o,--output", "FILE", "Results file (default: NAME.h5 in the current folder)",
                 file_name);
  declare_settings(options, own.settings);
  declare_progress(options, own.progress);
  constexpr int kMostThreads = 1024;
  own.threads = 1;
  options.option(own.threads, "--threads", "N", "Threads that each rank works with (default: 1)",
                 WholeNumber<int>{1, kMostThreads});
  declare_common(options, own, {.threads = false, .memory = false});
}

/// What is typed; or text to print instead of any work.
std::optional<std::string> parse(int argc, const char* const* argv, AnalyzeOptions& own) {
  CLI::App app{"The analysis of coordreq on the processes that mpirun starts", "coordreq-mpi"};
  bool version = false;
  app.add_flag("--version", version, "Print the version")->disable_flag_override();
  app.footer("Example:\n  mpirun -n 4 coordreq-mpi analyze circle.json");
  app.require_subcommand(0, 1);
  CLI::App& analysis = *app.add_subcommand(
      "analyze", "Run the whole analysis and write the results file that coordreq analyze would write");
  Options options(analysis);
  declare(options, own);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app.help();
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  if (version) return fmt::format("coordreq-mpi {} ({})\n", program_version(), program_git_sha1());
  if (!analysis.parsed()) throw UsageError("no command, expected analyze");
  options.read_values();
  return std::nullopt;
}

void check_output_of(const ProblemSpec& spec, const AnalyzeOptions& own, const std::string& output) {
  FilesInUse files;
  add_read_files(own.specs.front(), &spec, files);
  files.writes(output, "the results", "--output");
}

Bytes bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The spec that the first rank reads.
ProblemSpec shared_spec(const AnalyzeOptions& own, Ranks& ranks) {
  SpecSource source;
  if (ranks.rank() == 0) {
    source = with_settings(load_source(own.specs.front(), std::nullopt), own.settings);
    // Before anybody else knows of it: whatever is wrong is said once.
    const ProblemSpec spec = read_spec(source);
    if (ranks.count() > 1) check_divisible(spec);
    check_output_of(spec, own, own.output.value_or(spec.name + ".h5"));
  }
  for (std::string* const part : {&source.text, &source.name, &source.folder})
    *part = text_of(ranks.from_first(bytes_of(*part)));
  return read_spec(source);
}

}  // namespace

ExitCode analyze_on_ranks(int argc, const char* const* argv, Ranks& ranks,
                          const std::function<void()>& watch) {
  AnalyzeOptions own;
  if (const std::optional<std::string> text = parse(argc, argv, own)) {
    if (ranks.rank() == 0) write_output(*text);
    return ExitCode::success;
  }
  own.ranks = &ranks;
  own.watch = watch;
  if (ranks.rank() != 0) own.quiet = true;
  if (ranks.rank() != 0) own.progress.mode = ProgressMode::none;
  const ProblemSpec spec = shared_spec(own, ranks);
  const std::string output = own.output.value_or(spec.name + ".h5");
  const std::shared_ptr<const Json> summary = analyze_with_progress(spec, output, own, "");
  if (ranks.rank() != 0) return ExitCode::success;
  PrintedWarnings(own).print((*summary)["warnings"]);
  print_answer(own, *summary, [&spec](const Json& found) { return summary_text(found, spec); });
  return verdict(*summary);
}

}  // namespace coordreq
