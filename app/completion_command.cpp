#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

std::string completion_script(const std::string& shell) {
  if (shell == "bash") return bash_completion(program_help());
  if (shell == "zsh") return zsh_completion(program_help());
  if (shell == "fish") return fish_completion(program_help());
  throw UsageError(fmt::format("no completion for '{}', expected bash, zsh or fish", printable(shell)));
}

}  // namespace

ExitCode run_completion(const CommandLine& line) {
  write_output(completion_script(line.path));
  return ExitCode::success;
}

}  // namespace coordreq
