#include "app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "app/command_options.hpp"
#include "app/command_values.hpp"
#include "app/standard_streams.hpp"
#include "results/version.hpp"

namespace coordreq {
namespace {

std::string command_names() {
  std::vector<std::string_view> names;
  for (const CommandInfo& info : all_commands()) names.emplace_back(info.name);
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

void check_global_arguments(const CLI::App& app) {
  const std::vector<std::string> extra = app.remaining();
  if (extra.empty()) throw UsageError(fmt::format("no command, expected one of {}", command_names()));
  if (looks_like_option(extra.front())) {
    throw UsageError(fmt::format("unknown option '{}', expected a command ({}) or {}", extra.front(),
                                 command_names(), option_names(app)));
  }
  throw UsageError(fmt::format("unknown command '{}', expected one of {}", extra.front(), command_names()));
}

/// "compare A B"
std::string usage(const CommandInfo& info) {
  std::string text = info.name;
  for (const ArgumentInfo& argument : info.arguments) text += std::string(" ") + argument.name;
  return text + (info.many ? "..." : "");
}

/// "takes one argument, SPEC"
std::string taken(const CommandInfo& info) {
  const std::vector<ArgumentInfo>& arguments = info.arguments;
  if (arguments.empty()) return "takes no argument";
  if (arguments.size() == 1) return fmt::format("takes one argument, {}", arguments[0].name);
  return fmt::format("takes two arguments, {} and {}", arguments[0].name, arguments[1].name);
}

[[noreturn]] void fail_for_missing(const ArgumentInfo& argument, const CommandInfo& info) {
  const bool is_file = std::string_view(argument.takes).find('|') == std::string_view::npos;
  const std::string expected = is_file ? "the name of a file" : fmt::format("one of {}", argument.takes);
  throw UsageError(
      fmt::format("no {}, expected {}: {} {}", argument.name, expected, kProgramName, usage(info)));
}

void check_arguments_are_there(const CommandInfo& info, const RawArguments& raw) {
  const auto is_empty = [](const std::string& text) { return text.empty(); };
  if (info.many) {
    if (raw.paths.empty() || std::any_of(raw.paths.begin(), raw.paths.end(), is_empty))
      fail_for_missing(info.arguments[0], info);
    return;
  }
  for (std::size_t i = 0; i < info.arguments.size(); ++i) {
    if (raw.places[i].empty()) fail_for_missing(info.arguments[i], info);
  }
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
  if (!extra.empty()) {
    throw UsageError(fmt::format("unexpected argument '{}', {} {}", extra.front(), info.name, taken(info)));
  }
  check_arguments_are_there(info, raw);
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

CommandLine parse_command_line(int argc, const char* const* argv) {
  CLI::App app(kProgramDescription, kProgramName);
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
  for (const CommandInfo& info : all_commands()) {
    const CLI::App* command = app.get_subcommand(info.name);
    if (!command->parsed()) continue;
    check_command_arguments(app, *command, info, raw);
    return checked_values(raw, info, *command);
  }
  check_global_arguments(app);
  return {};
}

}  // namespace coordreq
