#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/long_run_options.hpp"
#include "app/simulate_arguments.hpp"
#include "app/sweep.hpp"
#include "base/error.hpp"

namespace coordreq {

/// What the user asked for, read and checked.
struct CommandLine {
  std::vector<std::string> paths;           ///< all arguments that are no options
  std::string path;                         ///< the first of them: SPEC or RESULTS
  std::vector<SpecSetting> settings;        ///< --set, in their order
  std::vector<Sweep> sweeps;                ///< --sweep, in their order
  std::optional<std::string> output;        ///< -o
  std::optional<std::string> junit;         ///< --junit
  std::optional<std::string> at;            ///< --at; none: states come from standard input
  std::string format;                       ///< --format
  std::optional<std::string> partition;     ///< --partition
  std::vector<std::string> slices;          ///< --slice
  std::vector<std::string> projections;     ///< --project
  int threads = 0;                          ///< 0: all cores
  std::optional<std::uint64_t> max_memory;  ///< bytes
  std::optional<std::int64_t> sample;       ///< --sample: cells that verify looks at
  std::optional<double> budget;             ///< --budget: seconds that verify may spend on what is hard
  bool strict = false;                      ///< --strict: what is not confirmed is a failure
  std::int64_t tolerance = 0;               ///< --tolerance: steps that a cell may lose
  std::size_t limit = 5;                    ///< --limit: cells that are named for each partition
  bool json = false;
  bool quiet = false;
  ProgressOptions progress;                     ///< --progress, --progress-every
  std::optional<CheckpointOptions> checkpoint;  ///< --checkpoint, --checkpoint-every, --resume
  SimulateArguments simulate;
  std::function<ExitCode(const CommandLine&)> command;

  /// Runs the command.
  [[nodiscard]] ExitCode run() const { return command(*this); }
};

/// Help and version are commands too: they print and succeed.
/// @throws UsageError saying what was found and what was expected
[[nodiscard]] CommandLine parse_command_line(int argc, const char* const* argv);

/// The bytes that "500M", "2G", "1.5GiB" or "1048576" stand for; K, M, G, T are powers of 1024, with or
/// without "B" or "iB", in either case. Rounded down.
/// @throws UsageError if it is no such text or less than one byte
[[nodiscard]] std::uint64_t parse_memory_size(const std::string& text);

}  // namespace coordreq
