#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/tube_sets.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// One end of one dimension.
struct DomainSide {
  std::size_t dimension = 0;
  bool above = false;
  [[nodiscard]] bool operator==(const DomainSide&) const = default;
};

/// f(x, u), with the reason where it is empty.
struct CellPost {
  enum class Blocked : std::uint8_t {
    no,
    left_domain,             ///< through an unsafe side, at the sample or on the way there
    unsafe_between_samples,  ///< the tube is not safe
  };
  Blocked blocked = Blocked::no;
  std::vector<DomainSide> sides;  ///< unsafe sides through which the post leaves, if `left_domain`
  bool all_left = false;          ///< the post has left through a safe side: f(x, u) = {T}
  std::vector<IndexRange> box;    ///< else f(x, u), unless blocked; ends as in ResolvedRange::inside
};

/// The posts of one cell after another: from a finite abstraction, or computed from a spec, at first for the
/// requested cells alone. When this has cost as much as the whole abstraction would, the whole is computed.
/// (Whole rows are read by PostReader.)
///
/// Not thread-safe.
class CellPosts {
 public:
  /// @pre unchecked: `abstraction` outlives this object.
  explicit CellPosts(const Abstraction& abstraction)
      : grid_(&abstraction.grid), inputs_(&abstraction.inputs), whole_(&abstraction) {}
  /// @param stored the abstraction, if it is known. @pre unchecked: the other arguments outlive this object
  CellPosts(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs, ThreadTeam& team,
            std::optional<Abstraction> stored);
  CellPosts(const CellPosts&) = delete;
  CellPosts& operator=(const CellPosts&) = delete;
  ~CellPosts() = default;

  /// Computes the whole abstraction now; for callers that ask for all cells.
  void prepare_all() { static_cast<void>(whole()); }
  /// The whole abstraction, computed if it is not there.
  [[nodiscard]] const Abstraction& whole();

  [[nodiscard]] const UniformGrid& grid() const { return *grid_; }
  [[nodiscard]] const InputSpace& inputs() const { return *inputs_; }
  /// The inputs that the next value of state `i` can depend on, ascending.
  [[nodiscard]] const std::vector<std::int32_t>& inputs_of(std::size_t i) const;
  /// Whether there are tubes, as safety is required between the samples.
  [[nodiscard]] bool has_tubes() const;

  /// Goes to a cell. @throws SpecError as build_abstraction()
  void move_to(std::int64_t cell);
  /// The cells where state `i` can be next under joint input `u`. @pre unchecked: move_to() was called
  [[nodiscard]] ResolvedRange resolved(std::size_t i, std::int64_t u) const;
  /// The range of state `i` before the rules for leaving the domain.
  [[nodiscard]] IndexRange raw(std::size_t i, std::int64_t u) const;
  /// The cells of the tube of state `i` under `u`, see Abstraction. @pre has_tubes()
  [[nodiscard]] ResolvedRange resolved_tube(std::size_t i, std::int64_t u) const;
  [[nodiscard]] IndexRange raw_tube(std::size_t i, std::int64_t u) const;
  /// Number of entries of tables that have been computed so far.
  [[nodiscard]] std::int64_t entries_built() const;
  /// f(x, u) of all states. @param tubes the sets in which tubes must stay
  [[nodiscard]] CellPost post(std::int64_t u, const TubeSets& tubes) const;

 private:
  /// The spec from which posts are computed, and the tables computed so far.
  struct Source {
    const SystemSpec& spec;
    ThreadTeam& team;
    AffineDynamics dynamics;
    double all_entries;   ///< of the whole abstraction
    double most_entries;  ///< entries to compute one by one before the whole is computed
    /// [state] The abstraction of a grid that has only this cell's index where the state's table does not
    /// need more; only its tables of that state are filled.
    std::vector<Abstraction> by_state;
    std::vector<std::int64_t> position;  ///< [state] the cell's linear index in the grid of its abstraction
    double entries_built = 0;            ///< so far
    std::optional<Abstraction> whole;
  };

  void build_by_state(std::int64_t cell);
  [[nodiscard]] Abstraction abstraction_of(std::size_t state, std::int64_t cell) const;

  void follow_tube(std::int64_t u, const TubeSets& tubes, CellPost& post) const;

  const UniformGrid* grid_;
  const InputSpace* inputs_;
  std::unique_ptr<Source> source_;      ///< null if the abstraction was given
  const Abstraction* whole_ = nullptr;  ///< null until the whole is known
  std::int64_t cell_ = -1;
};

}  // namespace coordreq
