#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

#include "base/requires.hpp"
#include "model/input_space.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// A term of a table that is a sum (TransitionTable): the amount that one state adds to both ends of a next
/// range, in units of 2^-32 of a grid step, rounded outward.
struct TransitionTerm {
  std::int32_t state = 0;
  /// Position: sum of index * stride as in TransitionTable; that of `state` is 1.
  std::vector<std::int64_t> state_stride;
  std::vector<std::int64_t> input_stride;
  std::vector<std::int64_t> lower;
  std::vector<std::int64_t> upper;
};

/// Where one state can be at the next sample: the raw range of its grid indices, before `outside` is applied,
/// as a table over only those states and inputs that it depends on. It is stored in one of three forms.
///
/// - In full: one entry for every choice of them.
/// - As a shift, where the next index is the present one plus an offset that does not depend on it: entries
///   are relative to the state's own index, and the layout leaves out its own dimension.
/// - As a sum, where the next value is affine in some states with coefficients that do not depend on others:
///   one term for each of these, plus a base over the rest. Then lower and upper end are sums of 64-bit
///   integers of which the upper 32 bits are the index, so that a row of ranges is one vector addition. A sum
///   may be a shift, too.
///
/// Example: x(next) = x + u with cells of width 1, numbered 0, ..., 9, and u = 0.5 or -2. A cell moved by 0.5
/// meets itself and the next one; moved by -2 (half-open cells) exactly one other. In full that is an entry
/// for each of 10 cells and 2 inputs. As a shift it is one for each input,
///
///     u = 0.5   [0, 1]       cell 4 goes to raw indices 4..5, cell 9 to 9..10
///     u = -2    [-2, -2]     cell 4 goes to 2, cell 1 to -1
///
/// and `outside` says afterwards what 10 and -1 mean: resolve().
///
/// Read it through range() or, a row at a time, TableRows.
struct TransitionTable {
  std::vector<std::int32_t> states;      ///< that the next index depends on, the own one included; ascending
  std::vector<std::int32_t> inputs;      ///< ascending
  bool shift = false;                    ///< relative to the own index; only if `states` has it
  std::vector<IndexRange> entries;       ///< unless a sum: row-major over the states laid out, then `inputs`
  std::vector<TransitionTerm> terms;     ///< of a sum
  std::vector<std::int64_t> base_lower;  ///< of a sum, laid out like `entries`
  std::vector<std::int64_t> base_upper;
  std::int64_t before = 0;  ///< entries in front of those that are held (HeldCells)
  /// Position of an entry: sum of state index * state_stride over all states, plus the same over inputs; the
  /// stride of a variable that the entries do not depend on, or that has a term, is 0.
  std::vector<std::int64_t> state_stride;
  std::vector<std::int64_t> input_stride;

  [[nodiscard]] bool is_sum() const { return !terms.empty(); }
  /// In full and of all states: entries for every cell (HeldCells).
  /// @param all states there are
  [[nodiscard]] bool is_by_cells(std::size_t all) const {
    return !is_sum() && !shift && states.size() == all;
  }
  [[nodiscard]] bool has_term(std::size_t state) const;
  /// Size of the entries, in bytes.
  [[nodiscard]] std::uint64_t bytes() const;

  /// The entry at a position; null if it is not held.
  [[nodiscard]] IndexRange* held(std::int64_t position) {
    const std::int64_t index = position - before;
    return index >= 0 && index < std::ssize(entries) ? &entries[static_cast<std::size_t>(index)] : nullptr;
  }

  /// Raw range of state `target` where `state(i)` and `input(i)` are the indices of states and inputs.
  template <class State, class Input>
  [[nodiscard]] IndexRange range(std::size_t target, const State& state, const Input& input) const {
    const std::int64_t offset = shift ? state(target) : 0;
    const auto index = static_cast<std::size_t>(position(*this, state, input) - before);
    if (!is_sum()) return shift ? moved(entries[index], offset) : entries[index];
    std::int64_t lower = base_lower[index];
    std::int64_t upper = base_upper[index];
    for (const TransitionTerm& term : terms) {
      const auto at = static_cast<std::size_t>(position(term, state, input));
      lower += term.lower[at];
      upper += term.upper[at];
    }
    return sum_range(lower + (offset << kFractionBits), upper + (offset << kFractionBits));
  }

  /// The least range around range() under `inputs_count` joint choices of `inputs`, which is all of them:
  /// they stand side by side. @pre it is no sum
  template <class State>
  [[nodiscard]] IndexRange around_inputs(std::size_t target, const State& state,
                                         std::size_t inputs_count) const {
    REQUIRES(!is_sum());
    const auto first = static_cast<std::size_t>(
        position(*this, state, [](std::size_t) { return std::int64_t{0}; }) - before);
    IndexRange around = entries[first];
    for (std::size_t k = 1; k < inputs_count; ++k) {
      around.first = std::min(around.first, entries[first + k].first);
      around.last = std::max(around.last, entries[first + k].last);
    }
    return shift ? moved(around, state(target)) : around;
  }

  static constexpr int kFractionBits = 32;
  /// Ends of a sum as indices. Sums are below 2^30 steps in magnitude, indices of states too.
  [[nodiscard]] static IndexRange sum_range(std::int64_t lower, std::int64_t upper) {
    return {static_cast<std::int32_t>(lower >> kFractionBits),
            static_cast<std::int32_t>(upper >> kFractionBits)};
  }

 private:
  template <class Strides, class State, class Input>
  [[nodiscard]] std::int64_t position(const Strides& strides, const State& state, const Input& input) const {
    std::int64_t sum = 0;
    for (const std::int32_t i : states) {
      const auto s = static_cast<std::size_t>(i);
      if (strides.state_stride[s] != 0) sum += state(s) * strides.state_stride[s];
    }
    for (const std::int32_t i : inputs) {
      const auto s = static_cast<std::size_t>(i);
      if (strides.input_stride[s] != 0) sum += input(s) * strides.input_stride[s];
    }
    return sum;
  }
};

/// Tables in full that depend on all states have entries for every cell. Then cells come in this order, and
/// a process may hold no more than the entries of some neighbours.
struct HeldCells {
  std::vector<std::size_t> order;  ///< of the states, as for UniformGrid::arranged()
  std::int64_t begin = 0, end = 0;
};

/// The finite abstraction f: for every cell x and joint input u a box of cells that meets a guaranteed
/// enclosure of all states reachable at the next sample (contract, "Abstraction"). Immutable once built.
struct Abstraction {
  UniformGrid grid;
  InputSpace inputs;
  std::vector<TransitionTable> tables;  ///< one a state
  /// One a state if safety is asked for between the samples, else none: the fewest cells that together cover
  /// (cells_covering()) an enclosure of all states at any time in [0, tau]; laid out as `tables`, no sums.
  std::vector<TransitionTable> tubes;
  bool exact = true;                   ///< every post is the exact hull
  std::optional<HeldCells> held = {};  ///< nothing: all, in the order of the states

  /// Raw range of state `i` at the next sample from cell `x` (linear index) under joint input `u`.
  [[nodiscard]] IndexRange raw(std::size_t i, std::int64_t x, std::int64_t u) const;
  /// raw() after the rules for leaving the domain.
  [[nodiscard]] ResolvedRange resolved(std::size_t i, std::int64_t x, std::int64_t u) const;
  /// Raw range of the tube. @pre there are tubes
  [[nodiscard]] IndexRange raw_tube(std::size_t i, std::int64_t x, std::int64_t u) const;
  /// The cells that must be safe between the samples, likewise. The tube of a state that saturates may go on
  /// beyond the boundary cell: see safe_beyond_limits().
  [[nodiscard]] ResolvedRange resolved_tube(std::size_t i, std::int64_t x, std::int64_t u) const;
};

/// Fills in the strides of the table of `state`, whose `states`, `inputs`, `shift` and terms' states are set,
/// and returns its number of entries.
std::int64_t lay_out(TransitionTable& table, std::size_t state, const UniformGrid& grid,
                     const InputSpace& inputs);
/// lay_out() with the states in another order, for a table in full that depends on all of them.
std::int64_t lay_out_by_cells(TransitionTable& table, const std::vector<std::size_t>& order,
                              const UniformGrid& grid, const InputSpace& inputs);

/// The same abstraction with its states in another order, `order` as for UniformGrid::arranged(). Entries
/// stay where they are; only strides are exchanged.
[[nodiscard]] Abstraction arranged(Abstraction abstraction, const std::vector<std::size_t>& order);

/// The table of `state` with every entry written out: the same ranges in full.
[[nodiscard]] TransitionTable written_out(const Abstraction& abstraction, std::size_t state);

}  // namespace coordreq
