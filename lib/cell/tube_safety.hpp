#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "cell/cell_posts.hpp"
#include "cell/set_window.hpp"
#include "engine/cell_set.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Whether the tubes from a cell are safe (see TubeSets), with S from a results file. Not thread-safe.
class TubeSafety {
 public:
  /// REQUIRES: all outlive this object; the spec asks for safety between the samples.
  TubeSafety(const ResultsReader& results, CellPosts& posts, ThreadTeam& team);
  TubeSafety(const TubeSafety&) = delete;
  TubeSafety& operator=(const TubeSafety&) = delete;
  ~TubeSafety() = default;

  /// Reads all of S now, for whoever asks for all cells.
  void prepare_all() { safe_.cover_all(); }
  /// Those of the candidate joint inputs under which the tube from the cell of `posts` is safe.
  [[nodiscard]] std::vector<bool> keep_safe(std::vector<bool> candidates);

 private:
  [[nodiscard]] bool passes_a_limit(std::int64_t u) const;
  [[nodiscard]] bool demands_more_beyond_limits();

  const ResultsReader& results_;
  CellPosts& posts_;
  ThreadTeam& team_;
  SetWindow safe_;
  std::optional<CellSet> beyond_cells_;  ///< safe_beyond_limits(), once known
  std::optional<SetWindow> beyond_;      ///< the same
  bool beyond_is_known_ = false;
};

}  // namespace coordreq
