#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}
/// Scripts that make a shell complete commands, options, their literals, and files by their kind. What they
/// offer is in the help that they are made of; the program does not run while the user types.
namespace coordreq {

/// The help on the value of an option or an argument.
struct ValueHelp {
  /// As the help prints it: "FILE", "csv|scs", "random|VALUES". Terms in lower case are literals,
  /// those in capitals placeholders. Empty: it takes no value, it is a flag.
  std::string text;

  /// The terms that stand for themselves.
  [[nodiscard]] std::vector<std::string> literals() const;
  /// The files to offer, as a pattern for their names: "*.json" for SPEC, "*.h5" for RESULTS, "*" for FILE;
  /// empty if it is no file.
  [[nodiscard]] std::string file_pattern() const;
};

struct OptionHelp {
  std::vector<std::string> names;  ///< "-o", "--output"
  ValueHelp value;
  std::string description;
  bool repeatable = false;

  bool operator==(const OptionHelp& other) const {
    return names == other.names && description == other.description;
  }
};

struct ArgumentHelp {
  std::string name;  ///< "SPEC"
  ValueHelp value;
  std::string description;
  bool many = false;  ///< one or more of them
  bool required = true;
};

struct CommandHelp {
  std::string name;
  std::string description;
  std::vector<ArgumentHelp> arguments;  ///< in their order; only the last one may be many
  std::vector<OptionHelp> options;
};

/// Everything that `--help` says, as data: what the manual page and the completions of shells are made of.
struct ProgramHelp {
  std::string name;
  std::string description;
  std::vector<OptionHelp> options;  ///< of the program itself
  std::vector<CommandHelp> commands;

  /// The options that at least half of the commands have, described alike.
  [[nodiscard]] std::vector<OptionHelp> common_options() const;
};

/// Reads it off the parser.
[[nodiscard]] ProgramHelp read_help(const CLI::App& app);

/// The help of coordreq.
[[nodiscard]] ProgramHelp program_help();

struct ExitCodeHelp {
  int code;
  const char* meaning;
};

inline constexpr ExitCodeHelp kExitCodes[] = {
    {0, "done"},
    {1, "a requirement, a verification, a comparison or a run fails"},
    {2, "wrong usage"},
    {3, "invalid spec or results file"},
    {4, "a limit refused"},
    {5, "input or output failed"},
    {70, "a bug in coordreq"},
    {130, "interrupted"},
};

/// For bash 4 or newer; needs no package bash-completion.
[[nodiscard]] std::string bash_completion(const ProgramHelp& help);

/// For zsh: to be found as _coordreq in $fpath, or to be evaluated after compinit.
[[nodiscard]] std::string zsh_completion(const ProgramHelp& help);

/// For fish 3 or newer.
[[nodiscard]] std::string fish_completion(const ProgramHelp& help);

/// The page coordreq(1) for man: roff with the macros of man(7), from the same descriptions as `--help`.
[[nodiscard]] std::string man_page(const ProgramHelp& help, std::string_view version);

}  // namespace coordreq
