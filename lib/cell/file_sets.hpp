#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/analysis_context.hpp"
#include "answers/countdown/kinds.hpp"
#include "answers/counterexample/counterexample.hpp"
#include "base/thread_team.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Steps of a results file, read where they are needed, and kept. Not thread-safe.
class FileSteps {
 public:
  /// @pre unchecked: `results` outlive this object. @param partition nothing: the field is not by
  /// partitions
  FileSteps(const ResultsReader& results, const char* path, std::optional<std::size_t> partition);
  /// Those that a kind of countdown has in a partition.
  FileSteps(const ResultsReader& results, const CountdownKind& kind, std::size_t partition);

  [[nodiscard]] std::int32_t at(std::int64_t cell) const;
  /// Whether it is not known how many more steps a cell has, as `max_delay` ended the iteration.
  [[nodiscard]] bool is_lower_bound(std::int64_t cell) const;
  [[nodiscard]] bool is_bounded(std::int64_t cell) const;
  /// For how many steps cells are in layers: one more than in the file. @pre unchecked: this object outlives
  /// it
  [[nodiscard]] StepsFrom layers() const;

 private:
  const ResultsReader& results_;
  std::string path_;
  std::optional<std::size_t> partition_;
  std::int32_t deepest_;                                  ///< where the iteration was ended, else kUnbounded
  mutable std::vector<std::vector<std::int32_t>> pages_;  ///< so many cells each; empty: not read
};

/// What a results file has to find counterexamples in one partition, and the posts of its spec. States are in
/// the order of the spec; there is no engine.
class FileSets {
 public:
  /// Memory of an object, in bytes.
  [[nodiscard]] static double bytes(const ResultsReader& results);

  /// @throws ResultsError; SpecError
  FileSets(const ResultsReader& results, std::size_t partition, ThreadTeam& team);

  [[nodiscard]] const AnalysisContext& context() const { return context_; }
  [[nodiscard]] const FileSteps& delays() const { return delays_; }
  /// @pre the spec has `silence`
  [[nodiscard]] const FileSteps& silence() const;
  /// A problem without phases, for values of these. @pre unchecked: this object outlives it
  [[nodiscard]] CounterexampleProblem problem(const FileSteps& values) const;

 private:
  const ResultsReader& results_;
  std::size_t partition_;
  Model model_;
  AnalysisContext context_;
  FileSteps collision_time_, delays_;
  std::optional<FileSteps> silence_;
};

}  // namespace coordreq
