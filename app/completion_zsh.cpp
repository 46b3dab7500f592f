#include <fmt/format.h>

#include "app/program_help.hpp"

namespace coordreq {
namespace {

/// As the inside of single quotes.
std::string zsh_quoted(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result;
}

/// With a backslash before each of `special`, which mean something to _arguments or _describe.
std::string escaped(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return zsh_quoted(result);
}

/// ":MESSAGE:ACTION" of _arguments.
std::string value_action(const std::string& message, const ValueHelp& value) {
  std::string action = " ";
  if (const std::string pattern = value.file_pattern(); pattern == "*") {
    action = "_files";
  } else if (!pattern.empty()) {
    action = fmt::format("_files -g \"{}\"", pattern);
  } else if (const std::vector<std::string> literals = value.literals(); !literals.empty()) {
    action = fmt::format("({})", fmt::join(literals, " "));
  }
  return fmt::format(":{}:{}", escaped(message, ":\\"), action);
}

/// One specification a name: '(-o --output)--output=[description]:FILE:_files'.
std::string option_specifications(const OptionHelp& option) {
  std::string text;
  const std::string exclusion = option.repeatable ? "*" : fmt::format("({})", fmt::join(option.names, " "));
  const std::string description = escaped(option.description, "[]:\\");
  for (const std::string& name : option.names) {
    const bool is_long = name.rfind("--", 0) == 0;
    const std::string value = option.value.text.empty() ? "" : value_action(option.value.text, option.value);
    text += fmt::format(" \\\n        '{}{}{}[{}]{}'", exclusion, name,
                        value.empty() ? "" : (is_long ? "=" : "+"), description, value);
  }
  return text;
}

std::string command_case(const CommandHelp& command) {
  std::string text = fmt::format("    {})\n      _arguments -s", command.name);
  for (const OptionHelp& option : command.options) text += option_specifications(option);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const ArgumentHelp& argument = command.arguments[i];
    text += fmt::format(" \\\n        '{}{}'", argument.many ? "*" : std::to_string(i + 1),
                        value_action(argument.name, argument.value));
  }
  return text + "\n      ;;\n";
}

}  // namespace

std::string zsh_completion(const ProgramHelp& help) {
  std::string text = fmt::format(
      "#compdef {0}\n# Completion of {0} in zsh. In ~/.zshrc, after compinit: source <({0} completion "
      "zsh)\n\n"
      "_{0}() {{\n  local curcontext=$curcontext state line ret=1\n  typeset -A opt_args\n"
      "  _arguments -C",
      help.name);
  for (const OptionHelp& option : help.options) text += option_specifications(option);
  text +=
      " \\\n        '1:command:->command' \\\n        '*::argument:->argument' && ret=0\n"
      "  case $state in\n    command)\n      local -a commands=(\n";
  for (const CommandHelp& command : help.commands) {
    text += fmt::format("        '{}:{}'\n", command.name, escaped(command.description, ":\\"));
  }
  text +=
      "      )\n      _describe -t commands command commands && ret=0\n      ;;\n"
      "    argument)\n      curcontext=${curcontext%:*}-$words[1]:\n"
      "      _coordreq_command $words[1] && ret=0\n      ;;\n  esac\n  return ret\n}\n\n"
      "_coordreq_command() {\n  case $1 in\n";
  for (const CommandHelp& command : help.commands) text += command_case(command);
  return text +
         "  esac\n}\n\n"
         "# Found in $fpath this file is the function itself, when it is called for the first time.\n"
         "if [ \"$funcstack[1]\" = _coordreq ]; then\n  _coordreq \"$@\"\nelse\n  compdef _coordreq "
         "coordreq\n"
         "fi\n";
}

}  // namespace coordreq
