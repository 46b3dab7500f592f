#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "app/long_run_options.hpp"
#include "app/simulate_arguments.hpp"

namespace CLI {
class App;
}

// The commands and what each of them takes, as data and as options of the parser.
namespace coordreq {

inline constexpr const char* kProgramName = "coordreq";
inline constexpr const char* kProgramDescription = "When must agents that share a safety task communicate?";

/// What CLI11 hands over, before it is checked. Numbers stay text so that the messages are ours.
struct RawArguments {
  std::vector<std::string> paths;     ///< of a command that takes many
  std::array<std::string, 2> places;  ///< of one that takes each in its place
  std::string output, junit, threads, max_memory, at, format, partition, sample, budget, tolerance, limit;
  std::vector<std::string> slices, projections, settings, sweeps;
  bool json = false;
  bool quiet = false;
  bool strict = false;
  bool version = false;
  SimulateArguments simulate;
  LongRunArguments long_run;
};

/// An argument without the name of an option.
struct ArgumentInfo {
  const char* name;  ///< "SPEC"
  const char* description;
  const char* takes = "";  ///< words, or the kind of file; empty: the kind is the name
};

struct CommandInfo {
  const char* name;
  const char* description;
  ExitCode (*run)(const CommandLine&);
  std::vector<ArgumentInfo> arguments;  ///< at most two
  bool many = false;                    ///< of the only argument
};

/// In the order of the help.
[[nodiscard]] const std::vector<CommandInfo>& all_commands();

/// Tells the parser everything; `raw` must outlive it.
void add_everything(CLI::App& app, RawArguments& raw);

}  // namespace coordreq
