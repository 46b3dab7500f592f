#include "app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <list>
#include <optional>
#include <utility>

#include "app/file_beside_program.hpp"
#include "app/program_help.hpp"
#include "app/text.hpp"
#include "results/version.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

/// The end of a help.
std::string examples_text(const std::array<const char*, 2>& examples) {
  const std::optional<std::string> page =
      file_beside_program("share/doc/coordreq/docs/README.md", "docs/README.md");
  return fmt::format("Examples:\n  {}\n\nDocumentation: {}", fmt::join(examples, "\n  "),
                     page ? printable(*page) : "man coordreq");
}

struct Command {
  Command(CLI::App& command_app, const CommandInfo& info)
      : app(command_app), name(info.name), options(command_app), run(info.declare(options)) {}

  CLI::App& app;
  std::string name;
  Options options;
  Run run;
};

/// The parser with everything that may be typed.
struct Parser {
  explicit Parser(const ProgramInfo& about) : program(about), app(about.description, about.name) {
    app.add_flag("--version", version, "Print the version")->disable_flag_override();
    app.require_subcommand(0, 1);
    app.allow_extras();
    app.footer(examples_text(program.examples));
    for (const CommandInfo& info : program.commands) {
      CLI::App& command = *app.add_subcommand(info.name, info.description)->allow_extras();
      command.footer(examples_text(info.examples));
      commands.emplace_back(command, info);
    }
  }

  const ProgramInfo& program;
  CLI::App app;
  bool version = false;
  std::list<Command> commands;
};

std::vector<std::string> command_names(const ProgramInfo& program) {
  std::vector<std::string> names;
  for (const CommandInfo& info : program.commands) names.emplace_back(info.name);
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional()) names.push_back("--" + option->get_lnames().front());
  }
  return names;
}

/// ", did you mean ...?", or what there is.
std::string hint(const std::string& typed, const std::vector<std::string>& known) {
  const std::string nearest = suggestion(typed, known);
  return nearest.empty() ? fmt::format(", expected one of {}", fmt::join(known, ", ")) : nearest;
}

[[noreturn]] void fail_command(const ProgramInfo& program, const std::string& typed) {
  const std::vector<std::string> names = command_names(program);
  for (const auto& [ending, command] : {std::pair(".json", "analyze"), std::pair(".h5", "info")}) {
    if (!typed.ends_with(ending) || std::ranges::find(names, command) == names.end()) continue;
    const std::string line = fmt::format("{} {} {}", program.name, command, typed);
    throw UsageError(fmt::format("no command before {}, did you mean {}?", echoed(typed), echoed(line)));
  }
  if (typed == "plot")
    throw UsageError("no command 'plot', expected coordreq-plot (scripts/plot) to draw pictures");
  throw UsageError(fmt::format("unknown command {}{}", echoed(typed), hint(typed, names)));
}

/// @param typed perhaps "--option=value"
[[noreturn]] void fail_option(const CLI::App& command, const std::string& typed) {
  throw UsageError(fmt::format("unknown option {} of {}{}", echoed(typed), command.get_name(),
                               hint(typed.substr(0, typed.find('=')), option_names(command))));
}

bool looks_like_option(const std::string& argument) {
  return argument.size() > 1 && argument.front() == '-';
}

[[noreturn]] void fail_without_command(const Parser& parser) {
  const std::vector<std::string> extra = parser.app.remaining();
  const std::vector<std::string> names = command_names(parser.program);
  if (extra.empty()) {
    throw UsageError(
        fmt::format("no command, expected {}{}", names.size() == 1 ? "" : "one of ", fmt::join(names, ", ")));
  }
  if (looks_like_option(extra.front())) {
    throw UsageError(fmt::format("unknown option {}, expected a command ({}) or {}", echoed(extra.front()),
                                 fmt::join(names, ", "), fmt::join(option_names(parser.app), ", ")));
  }
  fail_command(parser.program, extra.front());
}

/// "compare A B"
std::string usage(const Command& command) {
  std::string text = command.name;
  for (const Options::Argument& argument : command.options.argument_list()) {
    const std::string name = argument.name + (argument.all != nullptr ? "..." : "");
    text += " " + (argument.is_required ? name : "[" + name + "]");
  }
  return text;
}

/// "takes one argument, SPEC"
std::string argument_rule(const Command& command) {
  const std::list<Options::Argument>& arguments = command.options.argument_list();
  if (arguments.empty()) return "takes no argument";
  if (arguments.size() == 1) {
    const Options::Argument& only = arguments.front();
    return fmt::format("takes {}one argument, {}", only.is_required ? "" : "at most ", only.name);
  }
  return fmt::format("takes {}two arguments, {} and {}", arguments.back().is_required ? "" : "at most ",
                     arguments.front().name, arguments.back().name);
}

void check_arguments_are_there(const ProgramInfo& program, const Command& command) {
  for (const Options::Argument& argument : command.options.argument_list()) {
    const bool is_there = argument.one != nullptr ? !argument.one->empty()
                                                  : !argument.all->empty() &&
                                                        std::find(argument.all->begin(), argument.all->end(),
                                                                  "") == argument.all->end();
    if (is_there || !argument.is_required) continue;
    const bool is_file = argument.takes.find('|') == std::string::npos;
    throw UsageError(fmt::format("no {}, expected {}: {} {}", argument.name,
                                 is_file ? "the name of a file" : "one of " + argument.takes, program.name,
                                 usage(command)));
  }
}

void check_arguments(const Parser& parser, const Command& command) {
  if (const std::vector<std::string> before = parser.app.remaining(); !before.empty()) {
    throw UsageError(fmt::format("{} stands before the command {}, expected it after", echoed(before.front()),
                                 command.name));
  }
  const std::vector<std::string> extra = command.app.remaining();
  const auto unknown = std::find_if(extra.begin(), extra.end(), looks_like_option);
  if (unknown != extra.end()) fail_option(command.app, *unknown);
  if (!extra.empty()) {
    throw UsageError(fmt::format("unexpected argument {}, {} {}", echoed(extra.front()), command.name,
                                 argument_rule(command)));
  }
  check_arguments_are_there(parser.program, command);
}

Run print(const ProgramInfo& program, std::string text) {
  return [write = program.write, text = std::move(text)] {
    write(text);
    return ExitCode::success;
  };
}

/// The parser's complaint as one of ours. Only options without their value, repeated options and flags with a
/// value are left to it; everything else is checked here.
UsageError translated(const CLI::ParseError& error) {
  const std::string what = error.what();
  const std::string option = what.substr(0, what.find_first_of(": "));
  const auto says = [&what](const char* phrase) { return what.find(phrase) != std::string::npos; };
  if (says(" required ") && says(" missing")) return UsageError("expected a value, found none", option);
  if (says("At Most 1 required but received")) return UsageError("given more than once", option);
  if (says("disallowed flag override")) return UsageError("expected no value, found one", "--" + option);
  return UsageError(what);
}

}  // namespace

ProgramInfo coordreq_program() {
  return {.name = "coordreq",
          .description = "When must agents that share a safety task communicate?",
          .examples = {"coordreq init first.json", "coordreq analyze first.json"},
          .commands = kCommands};
}

Run parse_command_line(int argc, const char* const* argv, const ProgramInfo& program) {
  Parser parser(program);
  try {
    parser.app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return print(program, parser.app.help());
  } catch (const CLI::RequiredError&) {
    // Noticed again below, where the message can name the command.
  } catch (const CLI::ParseError& error) {
    throw translated(error);
  }
  if (parser.version) {
    return print(program, fmt::format("{} {} ({})\n", program.name, program_version(), program_git_sha1()));
  }
  for (Command& command : parser.commands) {
    if (!command.app.parsed()) continue;
    check_arguments(parser, command);
    command.options.read_values();
    return command.run;
  }
  fail_without_command(parser);
}

std::string help_text(const std::string& command) {
  const ProgramInfo program = coordreq_program();
  const Parser parser(program);
  if (command.empty()) return parser.app.help();
  for (const Command& candidate : parser.commands) {
    if (candidate.name == command) return candidate.app.help(program.name);
  }
  fail_command(program, command);
}

ProgramHelp program_help() {
  const ProgramInfo program = coordreq_program();
  return read_help(Parser(program).app);
}

}  // namespace coordreq
