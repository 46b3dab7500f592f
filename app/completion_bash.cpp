#include <fmt/format.h>

#include "app/program_help.hpp"

namespace coordreq {
namespace {

/// What does not depend on the options. COMP_WORDS takes `--option=value` for three words.
constexpr const char* kBashFunctions = R"sh(
_coordreq_offer() {  # KIND of a value: words or files
  local word=$word
  case $1 in
    words\ *) mapfile -t COMPREPLY < <(compgen -W "${1#words }" -- "$word") ;;
    files\ *)
      word=${word#[\"\']}
      word=${word//\\/}
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X "!${1#files }" -- "$word" |
        while IFS= read -r file; do [ -d "$file" ] || printf '%s\n' "$file"; done) ;;
  esac
}

_coordreq() {
  local word=${COMP_WORDS[COMP_CWORD]} command= kind= name= repeatable= pending= given=' ' arguments=0 part i
  [ "$word" = '=' ] && word=
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    part=${COMP_WORDS[i]}
    if [ -n "$pending" ]; then
      [ "$part" = '=' ] || pending=
    elif [[ $part == -?* ]]; then
      _coordreq_option "$command $part"
      [ -n "$repeatable" ] || given+="$name "
      case $kind in '' | flag) ;; *) pending=$part ;; esac
    elif [ -z "$command" ]; then
      command=$part
    else
      arguments=$((arguments + 1))
    fi
  done
  if [ -n "$pending" ]; then
    _coordreq_offer "$kind"
  elif [[ $word == -* ]]; then
    local options
    _coordreq_options
    for part in $options; do
      case $given in *" $part "*) ;; *) [[ $part == "$word"* ]] && COMPREPLY+=("$part") ;; esac
    done
  elif [ -z "$command" ]; then
    _coordreq_offer "words $_coordreq_commands"
  else
    _coordreq_argument
    _coordreq_offer "$kind"
  fi
}

complete -F _coordreq coordreq
)sh";

std::string kind_of(const ValueHelp& value) {
  if (value.text.empty()) return "flag";
  if (const std::string pattern = value.file_pattern(); !pattern.empty()) return "files " + pattern;
  const std::vector<std::string> literals = value.literals();
  return literals.empty() ? "other" : fmt::format("words {}", fmt::join(literals, " "));
}

std::string option_case(const std::string& command, const OptionHelp& option) {
  std::string patterns;
  for (const std::string& name : option.names) {
    patterns += fmt::format("{}'{} {}'", patterns.empty() ? "" : " | ", command, name);
  }
  return fmt::format("    {}) kind='{}' name={} repeatable={} ;;\n", patterns, kind_of(option.value),
                     option.names.back(), option.repeatable ? "yes" : "");
}

/// kind, name and repeatable of "COMMAND OPTION".
std::string option_function(const ProgramHelp& help) {
  std::string text = "\n_coordreq_option() {\n  kind= name= repeatable=\n  case $1 in\n";
  for (const OptionHelp& option : help.options) text += option_case("", option);
  for (const CommandHelp& command : help.commands) {
    for (const OptionHelp& option : command.options) text += option_case(command.name, option);
  }
  return text + "  esac\n}\n";
}

std::string options_case(const std::string& command, const std::vector<OptionHelp>& options) {
  std::string names;
  for (const OptionHelp& option : options) names += (names.empty() ? "" : " ") + option.names.back();
  return fmt::format("    '{}') options='{}' ;;\n", command, names);
}

std::string options_function(const ProgramHelp& help) {
  std::string text =
      "\n_coordreq_options() {\n  options=\n  case $command in\n" + options_case("", help.options);
  for (const CommandHelp& command : help.commands) text += options_case(command.name, command.options);
  return text + "  esac\n}\n";
}

/// kind of the next argument of $command, of which there are $arguments already.
std::string argument_function(const ProgramHelp& help) {
  std::string text = "\n_coordreq_argument() {\n  kind=\n  case $command,$arguments in\n";
  for (const CommandHelp& command : help.commands) {
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
      const ArgumentHelp& argument = command.arguments[i];
      text += fmt::format("    {},{}) kind='{}' ;;\n", command.name, argument.many ? "*" : std::to_string(i),
                          kind_of(argument.value));
    }
  }
  return text + "  esac\n}\n";
}

}  // namespace

std::string bash_completion(const ProgramHelp& help) {
  std::string commands;
  for (const CommandHelp& command : help.commands) commands += (commands.empty() ? "" : " ") + command.name;
  return fmt::format("# Completion of {} in bash. In ~/.bashrc: source <({} completion bash)\n", help.name,
                     help.name) +
         fmt::format("\n_coordreq_commands='{}'\n", commands) + option_function(help) +
         options_function(help) + argument_function(help) + kBashFunctions;
}

}  // namespace coordreq
