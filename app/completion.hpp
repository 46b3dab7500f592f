#pragma once

#include <string>

#include "app/program_help.hpp"

/// Scripts that make a shell complete commands, options, their words, and files by their kind. What they
/// offer is in the help that they are made of; nothing is asked of the program while the user types.
namespace coordreq {

/// For bash 4 or newer; needs no package bash-completion.
[[nodiscard]] std::string bash_completion(const ProgramHelp& help);

/// For zsh: to be found as _coordreq in $fpath, or to be evaluated after compinit.
[[nodiscard]] std::string zsh_completion(const ProgramHelp& help);

/// For fish 3 or newer.
[[nodiscard]] std::string fish_completion(const ProgramHelp& help);

}  // namespace coordreq
