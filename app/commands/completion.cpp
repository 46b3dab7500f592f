#include <fmt/format.h>

#include <memory>

#include "app/commands/all.hpp"
#include "app/completion.hpp"
#include "app/standard_streams.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

struct CompletionOptions : CommonOptions {
  std::string shell;
};

std::string completion_script(const std::string& shell) {
  if (shell == "bash") return bash_completion(program_help());
  if (shell == "zsh") return zsh_completion(program_help());
  if (shell == "fish") return fish_completion(program_help());
  throw UsageError(fmt::format("no completion for {}, expected bash, zsh or fish", echoed(shell)));
}

}  // namespace

Run declare_completion(Options& options) {
  const auto own = std::make_shared<CompletionOptions>();
  options.argument(own->shell, "SHELL", "The shell", "bash|zsh|fish");
  declare_common(options, *own);
  return [own] {
    write_output(completion_script(own->shell));
    return ExitCode::success;
  };
}

}  // namespace coordreq
