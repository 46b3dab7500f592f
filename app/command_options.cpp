#include "app/command_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/commands.hpp"
#include "app/program_help.hpp"

namespace coordreq {
namespace {

constexpr ArgumentInfo kSpec = {"SPEC", "The problem spec, a JSON file; - reads standard input"};
constexpr ArgumentInfo kResults = {"RESULTS", "A file that analyze wrote"};

std::string exit_codes() {
  std::string text = "Exit codes:";
  for (const ExitCodeHelp& code : kExitCodes) text += fmt::format("\n  {:<3} {}", code.code, code.meaning);
  return text;
}

/// Adds options of one command.
class Adder {
 public:
  explicit Adder(CLI::App& command) : command_(command) {}

  void one(const char* names, std::string& target, const char* text, const char* type) const {
    command_.add_option(names, target, text)->type_name(type);
  }
  void many(const char* names, std::vector<std::string>& target, const char* text, const char* type) const {
    command_.add_option(names, target, text)->type_name(type)->expected(1)->take_all();
  }

 private:
  CLI::App& command_;
};

void add_set_option(const Adder& add, RawArguments& raw) {
  add.many("--set", raw.settings,
           "Take another value in the spec, as constants.R=0.7 or states.0.step=0.02; may be repeated",
           "PATH=VALUE");
}

void add_analyze_options(const Adder& add, RawArguments& raw) {
  add.one("-o,--output", raw.output,
          "Results file (default: NAME.h5 in the current folder), or a folder for several", "FILE");
  add.one("--junit", raw.junit, "Also write the requirements as a JUnit report", "FILE");
  add_set_option(add, raw);
  add.many("--sweep", raw.sweeps,
           "Analyse with each of these values and print a table; repeated: with each combination; results "
           "files are only written with -o",
           "PATH=VALUE,VALUE");
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

void add_export_options(const Adder& add, RawArguments& raw) {
  add.one("--format", raw.format, "The format to write; scs is that of SCOTS, vtk that of ParaView",
          "csv|scs|c-header|vtk");
  add.one("-o,--output", raw.output,
          "File to write (default: standard output; vtk: a name that ends in .vti or .vtkhdf)", "FILE");
  add.one("--partition", raw.partition, "The partition to export (csv, vtk: default all)", "NAME");
  add.many("--slice", raw.slices, "csv, vtk: only the cells where a state has this value; may be repeated",
           "STATE=VALUE");
  add.many("--project", raw.projections,
           "csv, vtk: the smallest or largest value along a state, min or max; may be repeated",
           "STATE:KIND");
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

void add_compare_options(const Adder& add, RawArguments& raw) {
  add.one("--tolerance", raw.tolerance,
          "Steps that a cell may lose, unless it leaves the invariance set or was unbounded (default: 0)",
          "N");
  add.one("--limit", raw.limit, "Cells to name for each partition (default: 5)", "N");
}

void add_verify_options(const Adder& add, CLI::App& command, RawArguments& raw) {
  add.one("--sample", raw.sample, "Look at so many cells, evenly drawn (default: all)", "N");
  add.one("--budget", raw.budget,
          "Time for reachable sets that are hard to confirm; 0: only a first look (default: 60)", "SECONDS");
  command.add_flag("--strict", raw.strict, "Fail if something is not confirmed")->disable_flag_override();
}

void add_arguments(CLI::App& command, const CommandInfo& info, RawArguments& raw) {
  for (std::size_t i = 0; i < info.arguments.size(); ++i) {
    const ArgumentInfo& argument = info.arguments[i];
    CLI::Option* const option = info.many
                                    ? command.add_option(argument.name, raw.paths, argument.description)
                                    : command.add_option(argument.name, raw.places[i], argument.description);
    option->required()->type_name(argument.takes);
  }
}

void add_own_options(CLI::App& command, const CommandInfo& info, RawArguments& raw) {
  const Adder add(command);
  if (info.run == run_analyze) {
    add_analyze_options(add, raw);
    add_checkpoint_options(command, raw.long_run);
  }
  if (info.run == run_validate) add_set_option(add, raw);
  if (info.run == run_report)
    add.one("-o,--output", raw.output, "HTML file (default: NAME.html in the current folder)", "FILE");
  if (info.run == run_compare) add_compare_options(add, raw);
  if (info.run == run_export) add_export_options(add, raw);
  if (info.run == run_query) {
    add.one("--at", raw.at,
            "The state, as x1=0.1,x2=1/3 (default: many from standard input, CSV or JSON lines)", "STATE");
  }
  if (info.run == run_simulate) add_simulate_options(command, raw);
  if (info.run == run_verify) add_verify_options(add, command, raw);
  if (info.run == run_analyze || info.run == run_compare || info.run == run_simulate ||
      info.run == run_verify)
    add_progress_options(command, raw.long_run);
}

void add_command(CLI::App& app, const CommandInfo& info, RawArguments& raw) {
  CLI::App* command = app.add_subcommand(info.name, info.description);
  add_arguments(*command, info, raw);
  add_own_options(*command, info, raw);
  const Adder add(*command);
  add.one("--threads", raw.threads, "Threads to work with (default: all cores)", "N");
  add.one("--max-memory", raw.max_memory,
          "Refuse what would need more, as 500M or 1.5G (default: the memory of the machine)", "SIZE");
  command->add_flag("--json", raw.json, "Print one JSON document instead of text")->disable_flag_override();
  command->add_flag("--quiet", raw.quiet, "No text summary and no progress")->disable_flag_override();
  command->allow_extras();
}

}  // namespace

const std::vector<CommandInfo>& all_commands() {
  static const std::vector<CommandInfo> commands = {
      {"analyze",
       "Run the whole analysis and write a results file, or one for each of several specs",
       run_analyze,
       {kSpec},
       true},
      {"validate",
       "Check a spec; print sizes, which state depends on what, and a memory estimate",
       run_validate,
       {kSpec}},
      {"info", "Print what a results file holds", run_info, {kResults}},
      {"query",
       "Tell everything that is known at a state: delay, countdown, allowed actions",
       run_query,
       {kResults}},
      {"simulate", "Run the self-triggered closed loop on the system itself", run_simulate, {kResults}},
      {"verify", "Check a results file by an independent method", run_verify, {kResults}},
      {"compare",
       "Tell which cells have lost delay from one results file to another of the same grid",
       run_compare,
       {{"A", "The earlier results file", "RESULTS"}, {"B", "The later results file", "RESULTS"}}},
      {"export", "Write the result in the format of another tool", run_export, {kResults}},
      {"report",
       "Write one page for a browser: the answer, and pictures to look around in",
       run_report,
       {kResults}},
      {"schema", "Print the JSON Schema of specs", run_schema, {}},
      {"completion",
       "Print what makes a shell complete commands, options and files",
       run_completion,
       {{"SHELL", "The shell", "bash|zsh|fish"}}},
  };
  return commands;
}

void add_everything(CLI::App& app, RawArguments& raw) {
  app.add_flag("--version", raw.version, "Print the version")->disable_flag_override();
  app.require_subcommand(0, 1);
  app.allow_extras();
  app.footer(exit_codes());
  for (const CommandInfo& info : all_commands()) add_command(app, info, raw);
}

ProgramHelp program_help() {
  CLI::App app(kProgramDescription, kProgramName);
  RawArguments raw;
  add_everything(app, raw);
  return read_help(app);
}

}  // namespace coordreq
