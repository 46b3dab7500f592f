#include "app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/program_help.hpp"
#include "app/standard_streams.hpp"
#include "numeric/rational.hpp"
#include "results/version.hpp"

namespace coordreq {
namespace {

constexpr const char* kProgramName = "coordreq";
constexpr const char* kDescription = "When must agents that share a safety task communicate?";
constexpr int kMaxThreads = 1024;

/// What CLI11 hands over, before it is checked. Numbers stay text so that the messages are ours.
struct RawArguments {
  std::string path, output, junit, threads, max_memory, at, format, partition, sample;
  std::vector<std::string> slices, projections;
  bool json = false;
  bool quiet = false;
  bool version = false;
  SimulateArguments simulate;
  LongRunArguments long_run;
};

struct CommandInfo {
  const char* name;
  const char* description;
  const char* argument;  ///< the positional argument, empty if there is none
  const char* argument_description;
  ExitCode (*run)(const CommandLine&);
  const char* argument_words = "";  ///< what the argument may be; empty if it is a file
};

constexpr CommandInfo kCommands[] = {
    {"analyze", "Run the whole analysis and write a results file", "SPEC",
     "The problem spec, a JSON file; - reads standard input", run_analyze},
    {"validate", "Check a spec; print sizes, which state depends on what, and a memory estimate", "SPEC",
     "The problem spec, a JSON file; - reads standard input", run_validate},
    {"info", "Print what a results file holds", "RESULTS", "A file that analyze wrote", run_info},
    {"query", "Tell everything that is known at a state: delay, countdown, allowed actions", "RESULTS",
     "A file that analyze wrote", run_query},
    {"simulate", "Run the self-triggered closed loop on the system itself", "RESULTS",
     "A file that analyze wrote", run_simulate},
    {"verify", "Check a results file by an independent method", "RESULTS", "A file that analyze wrote",
     run_verify},
    {"export", "Write the result in the format of another tool", "RESULTS", "A file that analyze wrote",
     run_export},
    {"report", "Write one page for a browser: the answer, and pictures to look around in", "RESULTS",
     "A file that analyze wrote", run_report},
    {"schema", "Print the JSON Schema of specs", "", "", run_schema},
    {"completion", "Print what makes a shell complete commands, options and files", "SHELL", "The shell",
     run_completion, "bash|zsh|fish"},
};

std::string exit_codes() {
  std::string text = "Exit codes:";
  for (const ExitCodeHelp& code : kExitCodes) text += fmt::format("\n  {:<3} {}", code.code, code.meaning);
  return text;
}

void add_export_options(CLI::App& command, RawArguments& raw) {
  command
      .add_option("--format", raw.format, "The format to write; scs is that of SCOTS, vtk that of ParaView")
      ->type_name("csv|scs|c-header|vtk");
  command
      .add_option("-o,--output", raw.output,
                  "File to write (default: standard output; vtk: a name that ends in .vti or .vtkhdf)")
      ->type_name("FILE");
  command.add_option("--partition", raw.partition, "The partition to export (csv, vtk: default all)")
      ->type_name("NAME");
  command
      .add_option("--slice", raw.slices,
                  "csv, vtk: only the cells where a state has this value; may be repeated")
      ->type_name("STATE=VALUE")
      ->expected(1)
      ->take_all();
  command
      .add_option("--project", raw.projections,
                  "csv, vtk: the smallest or largest value along a state, min or max; may be repeated")
      ->type_name("STATE:KIND")
      ->expected(1)
      ->take_all();
}

void add_simulate_options(CLI::App& command, RawArguments& raw) {
  SimulateArguments& simulate = raw.simulate;
  const auto add = [&command](const char* name, auto& target, const char* text, const char* type) {
    command.add_option(name, target, text)->type_name(type);
  };
  add("--from", simulate.from, "State to start from, as x1=0.1,x2=0", "STATE");
  add("--start", simulate.start, "Start anywhere in the invariance set", "random");
  add("--steps", simulate.steps, "Length of a run", "N");
  add("--runs", simulate.runs, "Number of runs (default: 1)", "N");
  add("--seed", simulate.seed, "Seed of all that is random (default: 1)", "N");
  add("--policy", simulate.policy, "How agents choose (default: random)", "random|adversarial|prefer");
  add("--disturbance", simulate.disturbance,
      "How it varies (default: random); VALUES: constant, as w1=0.1,w2=0", "random|extremes|constant|VALUES");
  add("--partition", simulate.partition, "Partition (default: the only one)", "NAME");
  add("-o,--output", raw.output, "File for the runs (default: none)", "FILE");
}

void add_progress_options(CLI::App& command, LongRunArguments& long_run) {
  command
      .add_option("--progress", long_run.progress,
                  "auto: a bar on a terminal; bar: that, also with --quiet; log: lines (default: auto)")
      ->type_name("auto|bar|log|none");
  command
      .add_option("--progress-every", long_run.progress_every, "Between two lines of the log (default: 10)")
      ->type_name("SECONDS");
}

void add_checkpoint_options(CLI::App& command, LongRunArguments& long_run) {
  command
      .add_option("--checkpoint", long_run.checkpoint,
                  "Save the work there now and then; removed when the results are written")
      ->type_name("FILE");
  command.add_option("--checkpoint-every", long_run.checkpoint_every, "How often (default: 60)")
      ->type_name("SECONDS");
  command.add_flag("--resume", long_run.resume, "Go on from the checkpoint, if there is one")
      ->disable_flag_override();
}

void add_command(CLI::App& app, const CommandInfo& info, RawArguments& raw) {
  CLI::App* command = app.add_subcommand(info.name, info.description);
  if (*info.argument != '\0') {
    command->add_option(info.argument, raw.path, info.argument_description)
        ->required()
        ->type_name(info.argument_words);
  }
  if (info.run == run_analyze) {
    command->add_option("-o,--output", raw.output, "Results file (default: NAME.h5 in the current folder)")
        ->type_name("FILE");
    command->add_option("--junit", raw.junit, "Also write the requirements as a JUnit report")
        ->type_name("FILE");
    add_checkpoint_options(*command, raw.long_run);
  }
  if (info.run == run_report) {
    command->add_option("-o,--output", raw.output, "HTML file (default: NAME.html in the current folder)")
        ->type_name("FILE");
  }
  if (info.run == run_export) add_export_options(*command, raw);
  if (info.run == run_query) {
    command
        ->add_option("--at", raw.at,
                     "The state, as x1=0.1,x2=1/3 (default: many from standard input, CSV or JSON lines)")
        ->type_name("STATE");
  }
  if (info.run == run_simulate) add_simulate_options(*command, raw);
  if (info.run == run_verify) {
    command->add_option("--sample", raw.sample, "Look at so many cells, evenly drawn (default: all)")
        ->type_name("N");
  }
  if (info.run == run_analyze || info.run == run_simulate || info.run == run_verify)
    add_progress_options(*command, raw.long_run);
  command->add_option("--threads", raw.threads, "Threads to work with (default: all cores)")->type_name("N");
  command
      ->add_option("--max-memory", raw.max_memory,
                   "Refuse what would need more, as 500M or 1.5G (default: the memory of the machine)")
      ->type_name("SIZE");
  command->add_flag("--json", raw.json, "Print one JSON document instead of text")->disable_flag_override();
  command->add_flag("--quiet", raw.quiet, "No text summary and no progress")->disable_flag_override();
  command->allow_extras();
}

void add_everything(CLI::App& app, RawArguments& raw) {
  app.add_flag("--version", raw.version, "Print the version")->disable_flag_override();
  app.require_subcommand(0, 1);
  app.allow_extras();
  app.footer(exit_codes());
  for (const CommandInfo& info : kCommands) add_command(app, info, raw);
}

std::string command_names() {
  std::vector<std::string_view> names;
  for (const CommandInfo& info : kCommands) names.emplace_back(info.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional()) names.push_back("--" + option->get_lnames().front());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

bool looks_like_option(const std::string& argument) {
  return argument.size() > 1 && argument.front() == '-';
}

int parse_threads(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > kMaxThreads) {
    throw UsageError(fmt::format("expected a whole number from 1 to {}, found '{}'", kMaxThreads, text),
                     "--threads");
  }
  return value;
}

std::int64_t parse_sample(const std::string& text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1) {
    throw UsageError(fmt::format("expected a whole number from 1, found '{}'", text), "--sample");
  }
  return value;
}

void check_global_arguments(const CLI::App& app) {
  const std::vector<std::string> extra = app.remaining();
  if (extra.empty()) throw UsageError(fmt::format("no command, expected one of {}", command_names()));
  if (looks_like_option(extra.front())) {
    throw UsageError(fmt::format("unknown option '{}', expected a command ({}) or {}", extra.front(),
                                 command_names(), option_names(app)));
  }
  throw UsageError(fmt::format("unknown command '{}', expected one of {}", extra.front(), command_names()));
}

void check_command_arguments(const CLI::App& root, const CLI::App& command, const CommandInfo& info,
                             const RawArguments& raw) {
  const std::vector<std::string> before = root.remaining();
  if (!before.empty()) {
    throw UsageError(
        fmt::format("'{}' stands before the command {}, expected it after", before.front(), info.name));
  }
  const std::vector<std::string> extra = command.remaining();
  const auto unknown = std::find_if(extra.begin(), extra.end(), looks_like_option);
  if (unknown != extra.end()) {
    throw UsageError(fmt::format("unknown option '{}' of {}, expected one of {}", *unknown, info.name,
                                 option_names(command)));
  }
  const bool takes_argument = *info.argument != '\0';
  if (!extra.empty()) {
    const std::string expected =
        takes_argument ? fmt::format("one argument, {}", info.argument) : "no argument";
    throw UsageError(
        fmt::format("unexpected argument '{}', {} takes {}", extra.front(), info.name, expected));
  }
  if (takes_argument && raw.path.empty()) {
    const std::string words = info.argument_words;
    const std::string expected = words.empty() ? "the name of a file" : "one of " + words;
    throw UsageError(
        fmt::format("no {0}, expected {2}: coordreq {1} {0}", info.argument, info.name, expected));
  }
}

std::string file_name(const std::string& text, const std::string& option) {
  if (!text.empty() && text != "-") return text;
  throw UsageError(fmt::format("expected the name of a file, found '{}'", text), option);
}

CommandLine checked(const RawArguments& raw, const CommandInfo& info, const CLI::App& command) {
  CommandLine line;
  line.path = raw.path;
  line.json = raw.json;
  line.quiet = raw.quiet;
  line.command = info.run;
  if (command.count("--threads") > 0) line.threads = parse_threads(raw.threads);
  if (command.count("--max-memory") > 0) line.max_memory = parse_memory_size(raw.max_memory);
  if (info.run == run_query && command.count("--at") > 0) line.at = raw.at;
  if (info.run == run_verify && command.count("--sample") > 0) line.sample = parse_sample(raw.sample);
  if (info.run == run_export) {
    if (command.count("--format") == 0) throw UsageError("no --format, expected csv, scs, c-header or vtk");
    line.format = raw.format;
    if (command.count("--partition") > 0) line.partition = raw.partition;
    line.slices = raw.slices;
    line.projections = raw.projections;
  }
  line.simulate = raw.simulate;
  line.progress = progress_options(raw.long_run);
  line.checkpoint = checkpoint_options(raw.long_run);
  if (info.run == run_analyze && command.count("--junit") > 0) line.junit = file_name(raw.junit, "--junit");
  const bool has_output =
      info.run == run_analyze || info.run == run_export || info.run == run_report || info.run == run_simulate;
  if (has_output && command.count("--output") > 0) {
    line.output = file_name(raw.output, "--output");
  }
  return line;
}

CommandLine print_and_succeed(std::string text) {
  CommandLine line;
  line.command = [text = std::move(text)](const CommandLine&) {
    write_output(text);
    return ExitCode::success;
  };
  return line;
}

/// The parser's complaint as one of ours. Only options without their value, repeated options and flags with a
/// value are left to it; everything else is checked here.
UsageError translated(const CLI::ParseError& error) {
  const std::string what = error.what();
  const std::string option = what.substr(0, what.find_first_of(": "));
  const auto says = [&what](const char* part) { return what.find(part) != std::string::npos; };
  if (says(" required ") && says(" missing")) return UsageError("expected a value, found none", option);
  if (says("At Most 1 required but received")) return UsageError("given more than once", option);
  if (says("disallowed flag override")) return UsageError("expected no value, found one", "--" + option);
  return UsageError(what);
}

std::string version_text() {
  return fmt::format("coordreq {} ({})\n", program_version(), program_git_sha1());
}

}  // namespace

std::uint64_t parse_memory_size(const std::string& text) {
  const auto fail = [&text] {
    return UsageError(
        fmt::format("expected a size such as 500M, 1.5GiB or a number of bytes, found '{}'", text),
        "--max-memory");
  };
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::optional<Rational> number = parse_decimal(std::string_view(text).substr(0, digits));
  std::string unit = text.substr(digits);
  for (char& c : unit) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  constexpr std::string_view kPrefixes = "KMGT";
  std::int64_t factor = 1;
  if (!unit.empty() && unit != "B") {
    const std::size_t power = kPrefixes.find(unit.front());
    const std::string rest = unit.substr(1);
    if (power == std::string_view::npos || !(rest.empty() || rest == "B" || rest == "IB")) throw fail();
    for (std::size_t i = 0; i <= power; ++i) factor *= 1024;
  }
  if (!number || *number * factor < 1) throw fail();
  return static_cast<std::uint64_t>(floor_to_int(*number * factor));
}

ProgramHelp program_help() {
  CLI::App app(kDescription, kProgramName);
  RawArguments raw;
  add_everything(app, raw);
  return read_help(app);
}

CommandLine parse_command_line(int argc, const char* const* argv) {
  CLI::App app(kDescription, kProgramName);
  RawArguments raw;
  add_everything(app, raw);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return print_and_succeed(app.help());
  } catch (const CLI::RequiredError&) {
    // Noticed again below, where the message can name the command.
  } catch (const CLI::ParseError& error) {
    throw translated(error);
  }
  if (raw.version) return print_and_succeed(version_text());
  for (const CommandInfo& info : kCommands) {
    const CLI::App* command = app.get_subcommand(info.name);
    if (!command->parsed()) continue;
    check_command_arguments(app, *command, info, raw);
    return checked(raw, info, *command);
  }
  check_global_arguments(app);
  return {};
}

}  // namespace coordreq
