#pragma once

#include <cstdint>
#include <vector>

#include "answers/analysis_context.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/invariance/invariance.hpp"
#include "base/thread_team.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The values of all cells of a results file, and the posts of its spec, as an analysis has them in memory:
/// S, K with its collision times, and the delays of one partition; and the silence of agents who follow
/// rules, if the spec has any. States are in the order of the spec; there is no engine.
class FileSets {
 public:
  /// Memory of an object, in bytes.
  [[nodiscard]] static double bytes(const ResultsReader& results);

  /// @throws ResultsError; SpecError
  FileSets(const ResultsReader& results, std::size_t partition, ThreadTeam& team);

  [[nodiscard]] const AnalysisContext& context() const { return context_; }
  [[nodiscard]] const Invariance& invariance() const { return invariance_; }
  [[nodiscard]] const DelayLayers& layers() const { return layers_; }
  /// @pre the spec has `silence`
  [[nodiscard]] const DelayLayers& silence() const;
  /// 0 outside S, 1 in S but not in K', LevelMap::kTop in K'.
  [[nodiscard]] const LevelMap& lost() const { return lost_; }
  /// [dimension]: what one index adds to a cell's number.
  [[nodiscard]] std::vector<std::int64_t> number_stride() const;

 private:
  void read_cells(std::size_t partition);
  void read_silence(std::size_t partition);
  void read_listed();

  const ResultsReader& results_;
  Model model_;
  AnalysisContext context_;
  Invariance invariance_;
  DelayLayers layers_;
  DelayLayers silence_;
  LevelMap lost_;
};

}  // namespace coordreq
