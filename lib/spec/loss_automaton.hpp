#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// Models of lossy connections unfolded into automata. A mode stands for a step and what of the past decides
// on the future; it is named by its last steps, the newest last: 1 connected, 0 lost.
namespace coordreq {

/// A mode is never without a successor. Mode 0 is the initial one.
struct LossAutomaton {
  std::vector<std::string> names;  ///< all different
  std::vector<std::pair<std::int32_t, std::int32_t>> transitions;

  /// Whether the step itself is connected.
  [[nodiscard]] bool is_up(std::size_t mode) const { return names[mode].back() == '1'; }
};

/// Lost for `steps` steps, then connected indefinitely: the modes 0, 00, ... and 1.
/// @returns nothing if that takes more than `most_modes` modes; likewise below
[[nodiscard]] std::optional<LossAutomaton> delay_automaton(std::int64_t steps, std::size_t most_modes);

/// All sequences with at most `length` lost steps in a row and at least `gap` connected ones between two such
/// bursts. Names have max(length, gap) letters; a loss that no longer matters is written 1.
/// @pre both >= 1
[[nodiscard]] std::optional<LossAutomaton> burst_automaton(std::int64_t length, std::int64_t gap,
                                                           std::size_t most_modes);

/// All sequences with at most `misses` lost steps among any `window` consecutive ones, the smallest
/// deterministic automaton of them (G. Bernat, A. Burns, A. Llamosi: Weakly hard real-time systems, IEEE
/// Transactions on Computers 50(4), 2001, doi:10.1109/12.919277, whose strings of met and missed deadlines
/// have the same letters). Names have as many letters as matter, at most window - 1; a loss that no longer
/// matters is written 1.
/// @pre 0 <= misses <= window, 1 <= window
[[nodiscard]] std::optional<LossAutomaton> weakly_hard_automaton(std::int64_t misses, std::int64_t window,
                                                                 std::size_t most_modes);

}  // namespace coordreq
