#pragma once

#include <cstdint>
#include <vector>

#include "grid/input_space.hpp"
#include "grid/outside.hpp"
#include "grid/uniform_grid.hpp"

namespace coordreq {

/// Where one state can be at the next sample: the raw range of its grid indices, before `outside` is applied,
/// as a table over only those states and inputs that it depends on.
///
/// Where the next index is the present one plus an offset that does not depend on it (a shift), one entry
/// serves all present ones: entries are then relative to the state's own index, and the layout leaves out its
/// own dimension.
struct TransitionTable {
  std::vector<std::int32_t> states;  ///< that the next index depends on, the own one included; ascending
  std::vector<std::int32_t> inputs;  ///< ascending
  bool shift = false;                ///< entries are relative to the own index; only if `states` has it
  std::vector<IndexRange> entries;   ///< row-major over `states` (of a shift without the own), then `inputs`
  /// Position of an entry: sum of state index * state_stride over all states, plus the same over inputs; the
  /// stride of a variable that the entries do not depend on is 0.
  std::vector<std::int64_t> state_stride;
  std::vector<std::int64_t> input_stride;

  /// Raw range by the entry at `position`, where the state itself has index `own`.
  [[nodiscard]] IndexRange range(std::int64_t position, std::int64_t own) const {
    const IndexRange entry = entries[static_cast<std::size_t>(position)];
    return shift ? moved(entry, own) : entry;
  }
};

/// The finite abstraction f: for every cell x and joint input u a box of cells that meets a guaranteed
/// enclosure of all states reachable at the next sample (contract, "Abstraction"). Immutable once built.
struct Abstraction {
  UniformGrid grid;
  InputSpace inputs;
  std::vector<TransitionTable> tables;  ///< one a state
  /// One a state if safety is asked for between the samples, else none: the fewest cells that together cover
  /// (cells_covering()) an enclosure of all states at any time in [0, tau]; laid out as `tables`.
  std::vector<TransitionTable> tubes;
  bool exact = true;  ///< every post is the exact hull

  /// Raw range of state `i` at the next sample from cell `x` (linear index) under joint input `u`.
  [[nodiscard]] IndexRange raw(std::size_t i, std::int64_t x, std::int64_t u) const;
  /// The same after the rules for leaving the domain.
  [[nodiscard]] ResolvedRange resolved(std::size_t i, std::int64_t x, std::int64_t u) const;
  /// Raw range of the tube. REQUIRES: there are tubes.
  [[nodiscard]] IndexRange raw_tube(std::size_t i, std::int64_t x, std::int64_t u) const;
  /// The cells that must be safe between the samples, likewise. The tube of a state that saturates may go on
  /// beyond the boundary cell: see safe_beyond_limits().
  [[nodiscard]] ResolvedRange resolved_tube(std::size_t i, std::int64_t x, std::int64_t u) const;
};

/// Fills in the strides of the table of `state`, whose `states`, `inputs` and `shift` are set, and returns
/// its number of entries.
std::int64_t lay_out(TransitionTable& table, std::size_t state, const UniformGrid& grid,
                     const InputSpace& inputs);

/// The table of `state` with every entry written out: the same ranges, but no shift.
[[nodiscard]] TransitionTable written_out(const Abstraction& abstraction, std::size_t state);

}  // namespace coordreq
