#include <fmt/format.h>

#include <memory>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands/all.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {
Run declare_help(Options& options) {
  const auto command = std::make_shared<std::string>();
  std::vector<const char*> names;
  for (const CommandInfo& info : kCommands) names.push_back(info.name);
  options.optional_argument(*command, "COMMAND", "The command", fmt::format("{}", fmt::join(names, "|")));
  return [command] {
    write_output(help_text(*command));
    return ExitCode::success;
  };
}

}  // namespace coordreq
