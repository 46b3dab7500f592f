#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The finite abstraction at one cell after another: from the file if all of it is stored there (tubes are
/// not), else computed from the embedded spec, and then at first only for the cells asked for. When that has
/// cost as much as the whole abstraction would, all of it is computed.
///
/// Not thread-safe.
class CellPosts {
 public:
  /// REQUIRES: `results` and `team` outlive this object.
  CellPosts(const ResultsReader& results, ThreadTeam& team);

  /// Computes all of it now, for whoever asks for all cells.
  void prepare_all();
  /// All of it.
  [[nodiscard]] const Abstraction& whole();

  /// Goes to a cell. @throws SpecError as build_abstraction()
  void move_to(std::int64_t cell);
  /// The cells where state `i` can be next under joint input `u`. REQUIRES: move_to() was called.
  [[nodiscard]] ResolvedRange resolved(std::size_t i, std::int64_t u) const;
  /// The same of its tube: see Abstraction. REQUIRES: the spec asks for safety between the samples.
  [[nodiscard]] ResolvedRange resolved_tube(std::size_t i, std::int64_t u) const;
  [[nodiscard]] IndexRange raw_tube(std::size_t i, std::int64_t u) const;

 private:
  void build_parts(std::int64_t cell);
  [[nodiscard]] Abstraction part_of(std::size_t state, std::int64_t cell) const;

  const ResultsReader& results_;
  ThreadTeam& team_;
  AffineDynamics dynamics_;
  double most_entries_;
  std::int64_t cell_ = -1;
  std::optional<Abstraction> whole_;
  /// One a state: the abstraction of a grid that has only this cell's index where the state's table does not
  /// need more; its tables of that state alone are filled.
  std::vector<Abstraction> parts_;
  std::vector<std::int64_t> place_;  ///< the cell's linear index in each part
  double entries_built_ = 0;         ///< of tables of parts, so far
};

}  // namespace coordreq
