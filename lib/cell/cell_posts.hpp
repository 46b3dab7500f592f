#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The posts of one cell after another: from a finite abstraction; or of a results file, from the abstraction
/// if all of it is stored there (tubes are not), else computed from the embedded spec, and then at first only
/// for the cells asked for. When that has cost as much as the whole abstraction would, all of it is computed.
///
/// Not thread-safe.
class CellPosts {
 public:
  /// REQUIRES: `abstraction` outlives this object.
  explicit CellPosts(const Abstraction& abstraction) : grid_(&abstraction.grid), whole_(&abstraction) {}
  /// REQUIRES: `results` and `team` outlive this object.
  CellPosts(const ResultsReader& results, ThreadTeam& team);
  CellPosts(const CellPosts&) = delete;
  CellPosts& operator=(const CellPosts&) = delete;
  ~CellPosts() = default;

  /// Computes all of it now, for whoever asks for all cells.
  void prepare_all() { static_cast<void>(whole()); }
  /// All of it.
  [[nodiscard]] const Abstraction& whole();

  [[nodiscard]] const UniformGrid& grid() const { return *grid_; }
  [[nodiscard]] const InputSpace& inputs() const { return whole_ ? whole_->inputs : file_->results.inputs(); }
  /// The inputs that the next value of state `i` can depend on, ascending.
  [[nodiscard]] const std::vector<std::int32_t>& inputs_of(std::size_t i) const;
  /// Safety is asked for between the samples, so that there are tubes.
  [[nodiscard]] bool has_tubes() const;

  /// Goes to a cell. @throws SpecError as build_abstraction()
  void move_to(std::int64_t cell);
  /// The cells where state `i` can be next under joint input `u`. REQUIRES: move_to() was called.
  [[nodiscard]] ResolvedRange resolved(std::size_t i, std::int64_t u) const;
  /// The same of its tube: see Abstraction. REQUIRES: has_tubes().
  [[nodiscard]] ResolvedRange resolved_tube(std::size_t i, std::int64_t u) const;
  [[nodiscard]] IndexRange raw_tube(std::size_t i, std::int64_t u) const;

 private:
  /// What posts are computed from, and what of them is computed so far.
  struct File {
    const ResultsReader& results;
    ThreadTeam& team;
    AffineDynamics dynamics;
    double most_entries;
    /// One a state: the abstraction of a grid that has only this cell's index where the state's table does
    /// not need more; its tables of that state alone are filled.
    std::vector<Abstraction> parts;
    std::vector<std::int64_t> place;  ///< the cell's linear index in each part
    double entries_built = 0;         ///< of tables of parts, so far
    std::optional<Abstraction> whole;
  };

  void build_parts(std::int64_t cell);
  [[nodiscard]] Abstraction part_of(std::size_t state, std::int64_t cell) const;

  const UniformGrid* grid_;
  std::unique_ptr<File> file_;          ///< null if there is an abstraction from the start
  const Abstraction* whole_ = nullptr;  ///< null until there is one
  std::int64_t cell_ = -1;
};

}  // namespace coordreq
