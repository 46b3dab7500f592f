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
  std::vector<DomainSide> sides;  ///< unsafe ones that were left by, if `left_domain`
  bool all_left = false;          ///< through a safe side: f(x, u) = {T}
  std::vector<IndexRange> box;    ///< else f(x, u), unless blocked; ends as in ResolvedRange::inside
};

/// The posts of one cell after another: from a finite abstraction, or computed from a spec, and then at first
/// only for the cells asked for. When that has cost as much as the whole abstraction would, all of it is
/// computed. Whole rows are for PostReader.
///
/// Not thread-safe.
class CellPosts {
 public:
  /// @pre unchecked: `abstraction` outlives this object.
  explicit CellPosts(const Abstraction& abstraction)
      : grid_(&abstraction.grid), inputs_(&abstraction.inputs), whole_(&abstraction) {}
  /// @param stored the abstraction, if it is known. @pre unchecked: all others outlive this object
  CellPosts(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs, ThreadTeam& team,
            std::optional<Abstraction> stored);
  CellPosts(const CellPosts&) = delete;
  CellPosts& operator=(const CellPosts&) = delete;
  ~CellPosts() = default;

  /// Computes all of it now, for whoever asks for all cells.
  void prepare_all() { static_cast<void>(whole()); }
  /// All of it.
  [[nodiscard]] const Abstraction& whole();

  [[nodiscard]] const UniformGrid& grid() const { return *grid_; }
  [[nodiscard]] const InputSpace& inputs() const { return *inputs_; }
  /// The inputs that the next value of state `i` can depend on, ascending.
  [[nodiscard]] const std::vector<std::int32_t>& inputs_of(std::size_t i) const;
  /// Safety is asked for between the samples, so that there are tubes.
  [[nodiscard]] bool has_tubes() const;

  /// Goes to a cell. @throws SpecError as build_abstraction()
  void move_to(std::int64_t cell);
  /// The cells where state `i` can be next under joint input `u`. @pre unchecked: move_to() was called
  [[nodiscard]] ResolvedRange resolved(std::size_t i, std::int64_t u) const;
  /// The same before the rules for leaving the domain.
  [[nodiscard]] IndexRange raw(std::size_t i, std::int64_t u) const;
  /// The same of its tube: see Abstraction. @pre has_tubes()
  [[nodiscard]] ResolvedRange resolved_tube(std::size_t i, std::int64_t u) const;
  [[nodiscard]] IndexRange raw_tube(std::size_t i, std::int64_t u) const;
  /// How many entries of tables have been computed so far.
  [[nodiscard]] std::int64_t entries_built() const;
  /// f(x, u) of the whole state. @param tubes what tubes must stay in
  [[nodiscard]] CellPost post(std::int64_t u, const TubeSets& tubes) const;

 private:
  /// What posts are computed from, and what of them is computed so far.
  struct Source {
    const SystemSpec& spec;
    ThreadTeam& team;
    AffineDynamics dynamics;
    double all_entries;   ///< of the whole abstraction
    double most_entries;  ///< to compute one by one before the whole is computed
    /// One a state: the abstraction of a grid that has only this cell's index where the state's table does
    /// not need more; its tables of that state alone are filled.
    std::vector<Abstraction> parts;
    std::vector<std::int64_t> place;  ///< the cell's linear index in each part
    double entries_built = 0;         ///< so far
    std::optional<Abstraction> whole;
  };

  void build_parts(std::int64_t cell);
  [[nodiscard]] Abstraction part_of(std::size_t state, std::int64_t cell) const;

  void follow_tube(std::int64_t u, const TubeSets& tubes, CellPost& post) const;

  const UniformGrid* grid_;
  const InputSpace* inputs_;
  std::unique_ptr<Source> source_;      ///< null if there is an abstraction from the start
  const Abstraction* whole_ = nullptr;  ///< null until there is one
  std::int64_t cell_ = -1;
};

}  // namespace coordreq
