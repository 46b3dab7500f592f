#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/checkpoint_options.hpp"
#include "analysis/motion.hpp"
#include "analysis/progress.hpp"
#include "base/json.hpp"
#include "base/thread_team.hpp"
#include "model/model.hpp"
#include "model/row_sample.hpp"
#include "ranks/ranks.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

struct AnalysisOptions {
  std::string output;  ///< path of the results file; empty: none
  /// Called from the calling thread only, when something begins and often in between; may be empty. What it
  /// throws ends the work, with nothing left behind.
  std::function<void(const Progress&)> progress;
  std::optional<CheckpointOptions> checkpoint;
  std::function<void(const std::string&)> notice;  ///< a line for the user; may be empty
  /// The processes that share the work, each of which calls analyze() with the same spec; null: there is one.
  Ranks* ranks = nullptr;
  /// Memory that each of several processes may use, in bytes; compared as soon as the rows are divided.
  std::optional<std::uint64_t> max_memory;
};

/// The whole analysis: abstraction, S, K, layers, trigger tables, results file if one is requested. The file
/// is the same to the byte whether or not the work was broken off and gone on with from a checkpoint; that is
/// removed in the end.
/// @returns the summary of the contract, section 3: what each answer says of itself, and then `output` (null
///   if no file was written), `motion` (sample_motion(), by state), `threads`, `seconds` (wall time by
///   stage), `work` (of each fixed point, by stage), `peak_memory_bytes` (of several processes the largest),
///   and what is worth a warning, `warnings` (advice.hpp; in the first process only). Of several processes
///   the first writes the file
/// @throws LimitError if one of several processes needs more than `max_memory`
/// @throws SpecError for what only shows when the system is built (undecidable `allow`, a discrete state off
///   its grid, dynamics that this version cannot abstract); IoError
[[nodiscard]] Json analyze(const Model& model, const AnalysisOptions& options, ThreadTeam& team);
[[nodiscard]] Json analyze(const ProblemSpec& spec, const AnalysisOptions& options, ThreadTeam& team);

/// The report of `validate`, known before the analysis runs.
struct SpecReport {
  struct State {
    std::string name;
    std::string unit;
    std::int64_t points = 0;
    Outside below = Outside::unsafe;
    Outside above = Outside::unsafe;
    std::vector<std::string> states;  ///< that its next value depends on; likewise inputs and disturbances
    std::vector<std::string> inputs;
    std::vector<std::string> disturbances;
    bool shift = false;  ///< only as an offset to the present value, stored once for all present ones
    bool sum = false;    ///< a term for each state in which it is affine, plus a base of the rest
    std::uint64_t table_entries = 0;  ///< numbers of ranges or, in a sum, of pairs of summands
    std::uint64_t table_bytes = 0;
  };
  struct Input {
    std::string name;
    std::string unit;
    std::int64_t points = 0;
  };
  /// States that the engine's rows run across and along, the slowest first; and how many rows are different.
  struct Rows {
    std::vector<std::string> across;
    std::vector<std::string> along;
    RowSample sample;
  };
  std::string name;
  std::vector<State> states;
  Rows rows;
  std::vector<Input> inputs;
  std::int64_t cells = 0;
  std::int64_t joint_inputs = 0;
  std::vector<std::string> partitions;
  std::vector<std::string> modes;   ///< of the network, the initial one first; none without one
  bool exact = false;               ///< posts are exact hulls
  std::string guarantee;            ///< as guarantee_of() has it
  std::vector<StateMotion> motion;  ///< one a state
  std::uint64_t memory_bytes = 0;   ///< estimate of the peak of `analyze`
};

/// @param threads that an analysis would have; 0: all usable processors
[[nodiscard]] SpecReport inspect(const Model& model, int threads);
[[nodiscard]] SpecReport inspect(const ProblemSpec& spec, int threads);

/// The rows and the memory of the fullest of several processes.
struct FullestRank {
  std::int64_t local_rows = 0;
  std::int64_t ghost_rows = 0;
  std::uint64_t memory_bytes = 0;
};

/// Limits of memory, in bytes; empty: none.
struct RankLimits {
  std::optional<std::uint64_t> of_rank;  ///< of each of the processes
  std::optional<std::uint64_t> here;     ///< of this one: what is not divided is made here
};

/// Makes the abstraction as the processes would, and nothing that they divide.
/// @param threads that each would have
/// @throws LimitError if a limit is too low, before anything is made if that is known then
[[nodiscard]] FullestRank inspect_ranks(const Model& model, int ranks, int threads, const RankLimits& limits,
                                        ThreadTeam& team);

}  // namespace coordreq
