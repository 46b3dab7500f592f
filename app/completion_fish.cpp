#include <fmt/format.h>

#include "app/program_help.hpp"

namespace coordreq {
namespace {

constexpr const char* kFishFunctions = R"fish(
complete -c coordreq -f

function __coordreq_no_command
    test (count (commandline -opc)) -eq 1
end

function __coordreq_in --argument-names command
    set -l words (commandline -opc)
    test (count $words) -gt 1; and test $words[2] = $command
end

# COMMAND FROM TO OPTION...: in COMMAND with at least FROM and fewer than TO arguments so far; each OPTION takes
# a value.
function __coordreq_wants
    __coordreq_in $argv[1]; or return
    set -l arguments 0
    set -l is_value 0
    for word in (commandline -opc)[3..]
        if test $is_value = 1
            set is_value 0
        else if contains -- $word $argv[4..]
            set is_value 1
        else if not string match -q -- '-?*' $word
            set arguments (math $arguments + 1)
        end
    end
    test $is_value = 0; and test $arguments -ge $argv[2]; and test $arguments -lt $argv[3]
end

# Folders, and files whose names end in ENDING.
function __coordreq_files --argument-names ending
    for path in (complete -C "'' "(commandline -ct))
        string match -q -- '*/' $path; or string match -q -- "*$ending" $path; and echo $path
    end
end

)fish";

/// A text as the inside of single quotes of fish.
std::string fish_quoted(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// Where the value comes from: for `complete` of fish either -a with the literals, or files.
std::string value_source(const ValueHelp& value) {
  const std::string pattern = value.file_pattern();
  if (pattern == "*") return "-r -F";
  if (!pattern.empty()) return fmt::format("-x -a '(__coordreq_files {})'", pattern.substr(1));
  const std::vector<std::string> literals = value.literals();
  return literals.empty() ? "-x" : fmt::format("-x -a '{}'", fmt::join(literals, " "));
}

std::string option_line(const std::string& condition, const OptionHelp& option) {
  std::string names;
  for (const std::string& name : option.names) {
    names += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return fmt::format("complete -c coordreq -n '{}'{}{} -d '{}'\n", condition, names,
                     option.value.text.empty() ? "" : " " + value_source(option.value),
                     fish_quoted(option.description));
}

/// The names of all options that take a value.
std::string value_options(const CommandHelp& command) {
  std::string names;
  for (const OptionHelp& option : command.options) {
    if (!option.value.text.empty()) names += fmt::format(" {}", fmt::join(option.names, " "));
  }
  return names;
}

std::string argument_lines(const CommandHelp& command) {
  constexpr std::size_t kMany = 1'000'000;
  std::string lines;
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const ArgumentHelp& argument = command.arguments[i];
    lines += fmt::format("complete -c coordreq -n '__coordreq_wants {} {} {}{}' {}\n", command.name, i,
                         argument.many ? kMany : i + 1, value_options(command), value_source(argument.value));
  }
  return lines;
}

}  // namespace

std::string fish_completion(const ProgramHelp& help) {
  std::string text =
      fmt::format("# Completion of {0} in fish: {0} completion fish > ~/.config/fish/completions/{0}.fish\n",
                  help.name) +
      kFishFunctions;
  for (const OptionHelp& option : help.options) text += option_line("__coordreq_no_command", option);
  for (const CommandHelp& command : help.commands) {
    text += fmt::format("\ncomplete -c coordreq -n __coordreq_no_command -a {} -d '{}'\n", command.name,
                        fish_quoted(command.description));
    text += argument_lines(command);
    for (const OptionHelp& option : command.options) {
      text += option_line("__coordreq_in " + command.name, option);
    }
  }
  return text;
}

}  // namespace coordreq
