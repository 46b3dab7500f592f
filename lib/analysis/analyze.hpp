#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/checkpoint_options.hpp"
#include "analysis/progress.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "base/thread_team.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

struct AnalysisOptions {
  std::string output;  ///< path of the results file; empty: none
  /// Called from the calling thread only, when something begins and often in between; may be empty. What it
  /// throws ends the work, with nothing left behind.
  std::function<void(const Progress&)> progress;
  std::optional<CheckpointOptions> checkpoint;
  std::function<void(const std::string&)> notice;  ///< a line for the user; may be empty
};

struct PartitionSummary {
  std::string name;
  std::vector<std::string> classes;
  std::int32_t fixed_point_index = -1;  ///< F; -1 if `truncated`
  std::int64_t fixed_point = 0;         ///< |Z_F|
  std::vector<std::int64_t> layers;     ///< |Z_0|, ..., |Z_F|
  bool truncated = false;
  /// largest finite delay times period, in `period_unit`; none if some cell is unbounded or K is empty
  std::optional<double> max_delay_time;
  /// Cells of K of which it is not known that their delay is at least the connection delay D, |Z_0 \ Z_D|: a
  /// connection must stand there already. If max_delay came before D these are all cells of K.
  std::int64_t never_without_connection = 0;
};

/// Who must talk to whom, in numbers of cells of K.
struct CoalitionSummary {
  struct Choice {
    std::string partition;
    double cost = 0;         ///< of its cheapest network
    std::int64_t cells = 0;  ///< that are given it
  };
  std::int64_t horizon = 0;     ///< steps
  double horizon_time = 0;      ///< in the unit of the period
  std::vector<Choice> choices;  ///< all partitions, the most wanted first
  std::int64_t without = 0;     ///< cells for which no partition is enough
  std::vector<std::pair<std::string, std::int64_t>> critical_pairs;  ///< and where they are critical
};

/// What `controller.file` is.
struct ControllerSummary {
  std::string file;        ///< as in the spec
  std::string sha256;      ///< of the file
  std::int64_t pairs = 0;  ///< of cells and joint inputs that it lists
};

struct NetworkSummary {
  struct Mode {
    std::string name;
    std::string partition;
    std::int64_t cells = 0;  ///< |W(q)|
  };
  std::string kind;
  bool resynthesise = false;
  std::vector<Mode> modes;      ///< the initial one first
  std::int64_t every_mode = 0;  ///< cells that are in all W(q)
};

/// What a convention costs one agent (see ConventionFreedom).
struct ConventionSummary {
  std::string agent;
  double mean = 0;
  std::int64_t full = 0;
  std::vector<std::int64_t> histogram;
};

/// The JSON summary of the contract, section 3, as data.
struct AnalysisSummary {
  std::string name;
  std::int64_t states = 0;                      ///< cells
  std::int64_t inputs = 0;                      ///< joint inputs
  std::optional<ControllerSummary> controller;  ///< none without a file
  std::int64_t safe = 0;
  std::int64_t invariant = 0;
  std::int64_t iterations = 0;
  std::string guarantee;
  double period = 0;
  std::string period_unit;
  std::int64_t connection_delay = 0;  ///< D, steps
  std::vector<PartitionSummary> partitions;
  std::optional<CoalitionSummary> coalition;  ///< if the spec has a horizon
  std::optional<NetworkSummary> network;
  std::vector<ConventionSummary> convention;    ///< by agent; none without a convention
  std::vector<ResultRequirement> requirements;  ///< in the order of the spec
  std::string output;                           ///< empty if no file was written
  int threads = 1;
  std::vector<std::pair<std::string, double>> seconds;  ///< by stage, in order, wall time
  /// What each fixed point took, by the names of their stages, in order.
  struct Work {
    std::string stage;
    std::int64_t sweeps = 0;
    std::int64_t rows_visited = 0;
    std::int64_t rows_skipped = 0;
  };
  std::vector<Work> work;
  std::uint64_t peak_memory_bytes = 0;
};

/// The whole analysis: abstraction, S, K, layers, trigger tables, results file if one is asked for. The file
/// is the same to the byte whether or not the work was broken off and gone on with from a checkpoint; that is
/// removed in the end.
/// @throws SpecError for what only shows when the system is built (undecidable `allow`, a discrete state off
///   its grid, dynamics that this version cannot abstract); IoError
[[nodiscard]] AnalysisSummary analyze(const ProblemSpec& spec, const AnalysisOptions& options,
                                      ThreadTeam& team);

/// What `validate` prints, known before the analysis runs.
struct SpecReport {
  struct State {
    std::string name;
    std::string unit;
    std::int64_t points = 0;
    std::vector<std::string> states;  ///< that its next value depends on; likewise inputs and disturbances
    std::vector<std::string> inputs;
    std::vector<std::string> disturbances;
    bool shift = false;  ///< only as an offset to the present value, stored once for all present ones
    bool sum = false;    ///< a term for each state in which it is affine, plus a base over the rest
    std::uint64_t table_entries = 0;  ///< numbers of ranges or, in a sum, of pairs of summands
    std::uint64_t table_bytes = 0;
  };
  struct Input {
    std::string name;
    std::string unit;
    std::int64_t points = 0;
  };
  std::string name;
  std::vector<State> states;
  std::vector<Input> inputs;
  std::int64_t cells = 0;
  std::int64_t joint_inputs = 0;
  std::vector<std::string> partitions;
  std::vector<std::string> modes;  ///< of the network, the initial one first; none without one
  bool exact = false;              ///< posts are exact hulls
  std::string guarantee;           ///< as in AnalysisSummary
  std::uint64_t memory_bytes = 0;  ///< estimate of the peak of `analyze`
};

/// @param threads that an analysis would have; 0: all cores
[[nodiscard]] SpecReport inspect(const ProblemSpec& spec, int threads);

}  // namespace coordreq
