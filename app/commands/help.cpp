#include <fmt/format.h>

#include <memory>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands/all.hpp"
#include "app/standard_streams.hpp"

namespace coordreq {
namespace {

struct HelpOptions : CommonOptions {
  std::string command;
};

}  // namespace

Run declare_help(Options& options) {
  const auto own = std::make_shared<HelpOptions>();
  std::vector<const char*> names;
  for (const CommandInfo& info : kCommands) names.push_back(info.name);
  options.optional_argument(own->command, "COMMAND", "The command", fmt::format("{}", fmt::join(names, "|")));
  declare_common(options, *own);
  return [own] {
    write_output(help_text(own->command));
    return ExitCode::success;
  };
}

}  // namespace coordreq
