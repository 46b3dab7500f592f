#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "spec/spec_types.hpp"

namespace coordreq {

/// Properties of a rule for leaving the domain through one side (contract, "Leaving the domain"). Code asks
/// for properties, not for rules by name, so that a new rule is one more row of the table below.
struct OutsideTraits {
  bool blocks = false;   ///< a post that leaves is empty
  bool arrives = false;  ///< what leaves is the absorbing cell T, in every set
  bool wins = false;     ///< and leaving there is reaching the goal
  bool clamps = false;   ///< what is beyond reads as the boundary cell
  bool wraps = false;    ///< what leaves comes in again on the other side
  bool resets = false;   ///< the flow may pass the limit, and the sample puts the state back on it
  bool stops = false;    ///< the flow itself never passes the limit

  /// At a sample the true state may be beyond the side.
  [[nodiscard]] constexpr bool is_open() const { return blocks || arrives; }
  /// A state that leaves is safe indefinitely, and never reaches the goal.
  [[nodiscard]] constexpr bool is_only_safe() const { return arrives && !wins; }
};

/// In the order of Outside.
inline constexpr std::array<OutsideTraits, 6> kOutsideTraits{{
    {.blocks = true},                  // unsafe
    {.arrives = true},                 // safe
    {.clamps = true, .resets = true},  // saturate
    {.clamps = true, .stops = true},   // stop
    {.wraps = true},                   // periodic
    {.arrives = true, .wins = true},   // goal
}};

[[nodiscard]] constexpr const OutsideTraits& traits(Outside rule) {
  return kOutsideTraits[static_cast<std::size_t>(rule)];
}

/// Grid indices first, ..., last of the cells that a post meets in one dimension, on the lattice that goes on
/// beyond the domain, so that they may be negative or too large ("raw"). Saturated to 32 bits. In a periodic
/// dimension an index stands for itself modulo the number of points.
struct IndexRange {
  std::int32_t first = 0;
  std::int32_t last = 0;
  [[nodiscard]] auto operator<=>(const IndexRange&) const = default;
};

/// Narrows to 32 bits, saturating: an index that far out has left the domain all the same.
[[nodiscard]] std::int32_t saturate_index(std::int64_t index);

/// The cells of a periodic dimension that a raw range means, with 0 <= first < count. {0, count - 1} for a
/// range as long as the period, and wherever 32 bits do not hold the index: an end that was saturated, or a
/// sum beyond them. @pre raw.first <= raw.last, count >= 1
[[nodiscard]] IndexRange wrap_range(IndexRange raw, std::int64_t count);

/// A raw range further up by `by` indices, 0 <= by < 2^31. What was saturated stays so.
[[nodiscard]] IndexRange moved(IndexRange raw, std::int64_t by);

/// A raw range after the rules of both sides.
struct ResolvedRange {
  bool blocked = false;  ///< left through an unsafe side: the pair has no post
  /// Cells of the domain that must be in the target; first > last if all has left safely. In a periodic
  /// dimension 0 <= first < count and `last` may be up to first + count - 2: index k >= count is cell k -
  /// count.
  IndexRange inside;

  [[nodiscard]] bool all_left() const { return inside.first > inside.last; }
};

/// Contract, "Leaving the domain": `unsafe` blocks, `safe` drops what left, `saturate` moves it to the
/// boundary cell. `stop` has done its work in the dynamics; what measurement errors still put beyond the
/// limit reads as the boundary cell, as with `saturate`. `periodic`: see wrap_range().
/// @pre raw.first <= raw.last, count >= 1, `periodic` on both sides or none
[[nodiscard]] ResolvedRange resolve(IndexRange raw, std::int64_t count, Outside below, Outside above);

/// A rule for leaving the domain as the spec has it: "saturate".
[[nodiscard]] const char* outside_name(Outside rule);

}  // namespace coordreq
