#include <fmt/format.h>

#include <memory>

#include "app/commands/all.hpp"
#include "app/program_help.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

std::string completion_script(const std::string& shell) {
  if (shell == "bash") return bash_completion(program_help());
  if (shell == "zsh") return zsh_completion(program_help());
  if (shell == "fish") return fish_completion(program_help());
  throw UsageError(fmt::format("no completion for {}, expected bash, zsh or fish", echoed(shell)));
}

}  // namespace

Run declare_completion(Options& options) {
  const auto shell = std::make_shared<std::string>();
  options.argument(*shell, "SHELL", "The shell", "bash|zsh|fish");
  return [shell] {
    write_output(completion_script(*shell));
    return ExitCode::success;
  };
}

}  // namespace coordreq
