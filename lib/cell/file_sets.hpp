#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/analysis_context.hpp"
#include "answers/countdown/kinds.hpp"
#include "answers/counterexample/counterexample.hpp"
#include "base/thread_team.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// A countdown of a results file, for all cells.
struct FileSteps {
  std::vector<std::int32_t> steps;  ///< [cell]
  std::int32_t deepest = 0;         ///< where `max_delay` ended the iteration, else kUnbounded

  /// Whether it is not known how many more steps a cell has.
  [[nodiscard]] bool is_lower_bound(std::int64_t cell) const;
  [[nodiscard]] bool is_bounded(std::int64_t cell) const;
  /// For how many steps cells are in layers: one more than in the file. @pre unchecked: this object outlives
  /// it
  [[nodiscard]] StepsFrom layers() const;
};

/// The values of all cells of a results file, and the posts of its spec, to find counterexamples: S, K with
/// its collision times, and the delays of one partition; and the silence of agents who follow rules, if the
/// spec has any. States are in the order of the spec; there is no engine.
class FileSets {
 public:
  /// Memory of an object, in bytes.
  [[nodiscard]] static double bytes(const ResultsReader& results);

  /// @throws ResultsError; SpecError
  FileSets(const ResultsReader& results, std::size_t partition, ThreadTeam& team);

  [[nodiscard]] const AnalysisContext& context() const { return context_; }
  [[nodiscard]] const FileSteps& delays() const { return delays_; }
  /// Only if the spec has `silence`.
  [[nodiscard]] const FileSteps& silence() const { return silence_; }
  /// A problem without phases, for values of these. @pre unchecked: this object outlives it
  [[nodiscard]] CounterexampleProblem problem(const FileSteps& values) const;

 private:
  [[nodiscard]] FileSteps read_steps(const CountdownKind& kind) const;

  const ResultsReader& results_;
  std::size_t partition_;
  Model model_;
  AnalysisContext context_;
  CellSet invariant_;
  std::vector<std::int32_t> collision_time_;  ///< [cell]
  FileSteps delays_, silence_;
};

}  // namespace coordreq
